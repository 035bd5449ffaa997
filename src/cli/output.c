/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "io/file.h"
#include "say.h"

/* First what the open file `before` holds (-1: nothing). */
static enum exit_status write_after(int before, const struct arguments *a, const struct text *text)
{
    const char *bytes = ceduo_text_string(text);
    const struct pending_file file = {.path = a->output, .before = before, .bytes = bytes, .n = text->length, .wait = true};
    ceduo_say_no_progress();
    bool good = a->output ? ceduo_file_save(file) : ceduo_file_fill(STDOUT_FILENO, bytes, text->length, ceduo_interrupt_flag());
    if (good)
        return EXIT_DONE;
    ceduo_say_why(a->output ? a->output : _("standard output"), strerror(errno));
    return EXIT_OUTPUT;
}

enum exit_status ceduo_output_write(const struct arguments *a, const struct text *text)
{
    return write_after(-1, a, text);
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
    struct arena arena = {0};
    bool good = !a->output || ceduo_file_can_write(a->output);
    if (!good)
        ceduo_say_why(*a->output ? a->output : "--output", *a->output ? strerror(errno) : _("name a file"));
    for (size_t i = 0; a->output && good && i < a->scenes_count; i++) {
        const char *path = a->scenes[i];
        if (strcmp(path, "-") != 0)
            path = ceduo_file_find(&arena, path, NULL, "scenes");
        good = !ceduo_output_is(a, path);
    }
    good = good && !(a->survey && ceduo_output_is(a, a->survey)) && !(a->each && ceduo_output_is(a, a->each));
    ceduo_arena_free(&arena);
    return good;
}

/* ---- results of several scenes ---- */

#define HELD_MOST ((size_t)256 * 1024) /* bytes of results that wait in memory */

/* Results that wait for the last scene go into a nameless file once they are large, so that thousands of scenes need no
 * more memory than one. Where there is no room for such a file they stay in memory. */
static void set_aside(struct output *o)
{
    if (o->text.length < HELD_MOST)
        return;
    if (!o->spool && (o->spool = tmpfile()))
        setvbuf(o->spool, NULL, _IONBF, 0);
    long end = o->spool ? ftell(o->spool) : -1;
    if (end < 0)
        return;
    if (fwrite(o->text.bytes, 1, o->text.length, o->spool) == o->text.length)
        o->text.length = 0;
    else if (fseek(o->spool, end, SEEK_SET) != 0 || ftruncate(fileno(o->spool), end) != 0)
        o->text.failed = true;
}

/* Whole lines, or none of them. */
static enum exit_status append(const struct arguments *a, const struct text *text)
{
    int fd = open(a->output, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    off_t end = fd >= 0 ? lseek(fd, 0, SEEK_END) : -1;
    bool good = end >= 0 && ceduo_file_fill(fd, text->bytes, text->length, NULL);
    int why = errno;
    if (end >= 0 && !good && ftruncate(fd, end) != 0)
        why = errno;
    if (fd >= 0 && close(fd) != 0 && good) {
        good = false;
        why = errno;
    }
    if (!good)
        ceduo_say_why(a->output, strerror(why));
    return good ? EXIT_DONE : EXIT_OUTPUT;
}

enum exit_status ceduo_output_next(struct output *o)
{
    bool resume = o->arguments->resume;
    if (o->arguments->output && !resume)
        set_aside(o);
    if (o->text.length == 0 || (o->arguments->output && !resume))
        return EXIT_DONE;
    enum exit_status status = resume ? append(o->arguments, &o->text) : ceduo_output_write(o->arguments, &o->text);
    o->text.length = 0;
    return status;
}

enum exit_status ceduo_output_end(struct output *o, bool writes)
{
    bool waits = o->arguments->output && !o->arguments->resume && writes;
    enum exit_status status = waits ? write_after(o->spool ? fileno(o->spool) : -1, o->arguments, &o->text) : EXIT_DONE;
    if (o->spool)
        fclose(o->spool);
    ceduo_text_free(&o->text);
    return status;
}
