/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "io/file.h"
#include "messages.h"

enum exit_status ceduo_output_write(const struct arguments *a, const struct text *text)
{
    const char *bytes = ceduo_text_string(text);
    ceduo_clear_progress();
    if (a->output ? ceduo_file_write(a->output, bytes, text->length)
                  : ceduo_file_write_all(STDOUT_FILENO, bytes, text->length, ceduo_interrupt_flag()))
        return EXIT_DONE;
    ceduo_print_message(a->output ? a->output : _("standard output"), ceduo_error_text(errno));
    return EXIT_OUTPUT;
}

bool ceduo_output_is(const char *output, const char *path)
{
    if (!output || !path || !ceduo_file_is_same(output, path))
        return false;
    ceduo_print_message(output, _("this file is an input of the run; write elsewhere"));
    return true;
}

bool ceduo_output_check(const struct arguments *a)
{
    LOCAL_ARENA(arena);
    bool good = !a->output || ceduo_file_can_write(a->output);
    if (!good)
        ceduo_print_message(*a->output ? a->output : "--output", *a->output ? ceduo_error_text(errno) : _("name a file"));
    for (size_t i = 0; a->output && good && i < a->scenes_count; i++) {
        const char *path = a->scenes[i];
        if (strcmp(path, "-") != 0)
            path = ceduo_file_find(&arena, path, NULL, "scenes");
        good = !ceduo_output_is(a->output, path);
    }
    return good && !(a->survey && ceduo_output_is(a->output, a->survey)) && !(a->each && ceduo_output_is(a->output, a->each));
}

/* ---- results of several scenes ---- */

#define WAITING_MAX ((size_t)1 << 20) /* bytes kept in memory */

static enum exit_status fail(const struct arguments *a)
{
    ceduo_print_message(a->output, ceduo_error_text(errno));
    return EXIT_OUTPUT;
}

enum exit_status ceduo_output_next(struct output *o, const struct arguments *a, struct text *text)
{
    if (text->length == 0 || (a->output && !o->begun && text->length < WAITING_MAX))
        return EXIT_DONE;
    if (a->output && !o->begun) {
        o->file = (struct pending_file){.path = a->output, .wait = true};
        ceduo_interrupt_catch();
        o->fd = ceduo_file_begin(&o->file);
        o->begun = o->fd >= 0;
        if (!o->begun) {
            enum exit_status status = fail(a);
            ceduo_file_abort(&o->file);
            return status;
        }
    }
    bool good = !a->output || ceduo_file_write_all(o->fd, text->bytes, text->length, ceduo_interrupt_flag());
    enum exit_status status = a->output ? (good || errno == EINTR ? EXIT_DONE : fail(a)) : ceduo_output_write(a, text);
    ceduo_text_cut(text, 0);
    return status;
}

enum exit_status ceduo_output_end(struct output *o, const struct arguments *a, struct text *text, bool whole)
{
    if (!o->begun)
        return a->output && whole ? ceduo_output_write(a, text) : EXIT_DONE;
    enum exit_status status = whole ? ceduo_output_next(o, a, text) : EXIT_DONE;
    whole = whole && status == EXIT_DONE && !atomic_load(ceduo_interrupt_flag());
    if (!whole)
        close(o->fd);
    else if (!ceduo_file_finish(&o->file, o->fd))
        status = fail(a);
    ceduo_file_abort(&o->file);
    ceduo_interrupt_release();
    return status;
}
