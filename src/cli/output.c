/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "io/file.h"
#include "say.h"

enum exit_status ceduo_output_write(const struct arguments *a, const struct text *text)
{
    const char *bytes = ceduo_text_string(text);
    ceduo_say_no_progress();
    if (a->output ? ceduo_file_write(a->output, bytes, text->length)
                  : ceduo_file_fill(STDOUT_FILENO, bytes, text->length, ceduo_interrupt_flag()))
        return EXIT_DONE;
    ceduo_say_why(a->output ? a->output : _("standard output"), strerror(errno));
    return EXIT_OUTPUT;
}

bool ceduo_output_is(const struct arguments *a, const char *path)
{
    if (!a->output || !path || !ceduo_file_same(a->output, path))
        return false;
    ceduo_say_why(a->output, _("it is read in this run; write elsewhere"));
    return true;
}

bool ceduo_output_check(const struct arguments *a)
{
    LOCAL_ARENA(arena);
    bool good = !a->output || ceduo_file_can_write(a->output);
    if (!good)
        ceduo_say_why(*a->output ? a->output : "--output", *a->output ? strerror(errno) : _("name a file"));
    for (size_t i = 0; a->output && good && i < a->scenes_count; i++) {
        const char *path = a->scenes[i];
        if (strcmp(path, "-") != 0)
            path = ceduo_file_find(&arena, path, NULL, "scenes");
        good = !ceduo_output_is(a, path);
    }
    return good && !(a->survey && ceduo_output_is(a, a->survey)) && !(a->each && ceduo_output_is(a, a->each));
}

/* ---- results of several scenes ---- */

enum exit_status ceduo_output_next(const struct arguments *a, struct text *text)
{
    if (text->length == 0 || a->output)
        return EXIT_DONE;
    enum exit_status status = ceduo_output_write(a, text);
    ceduo_text_cut(text, 0);
    return status;
}
