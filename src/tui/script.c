/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "io/file.h"
#include "view/svg.h"

/* Report an error. Print at most `max` bytes of the word, because the file may not be a script. */
static enum script_end report_error(const char *path, size_t line, const char *what, const char *word, size_t max)
{
    LOCAL_TEXT(message);
    ceduo_text_append_escaped(&message, path);
    ceduo_text_format(&message, ":%zu: %s: ", line, what);
    ceduo_text_append_escaped_n(&message, word, ceduo_utf8_cut(word, max));
    fprintf(stderr, "%s\n", message.bytes);
    return SCRIPT_WRONG;
}

/* Press a key. A search or preview ends before the next key. */
static void press_key(struct app *app, int key)
{
    ceduo_program_key(app, key);
    if (ceduo_jobs_wait(app->live.jobs, false))
        ceduo_program_poll(app);
}

/* Write the screen as text, as letters of its roles, or as a drawing. */
static enum script_end dump_screen(struct app *app, const char *what, const char *name, const char *path, size_t line)
{
    LOCAL_TEXT(drawing);
    ceduo_program_poll(app);
    ceduo_screen_draw(app);
    if (strcmp(what, "draw") == 0) {
        ceduo_svg_screen(&drawing, app->cells, app->document.file.scene.title);
    } else {
        char *screen =
            ceduo_check_memory(strcmp(what, "roles") == 0 ? ceduo_cells_roles(app->cells) : ceduo_cells_dump(app->cells));
        ceduo_text_append(&drawing, screen);
        free(screen);
    }
    bool good = strcmp(name, "-") == 0 ? fputs(drawing.bytes, stdout) >= 0 && fflush(stdout) == 0
                                       : ceduo_file_write(name, drawing.bytes, drawing.length);
    if (!good)
        report_error(path, line, ceduo_error_text(errno), name, SIZE_MAX);
    return good ? SCRIPT_DONE : SCRIPT_UNWRITTEN;
}

static enum script_end run_command(struct app *app, char *command, const char *path, size_t line)
{
    command += strspn(command, " \t");
    if (command[0] == '\0' || command[0] == '#')
        return SCRIPT_DONE;
    char *rest = command + strcspn(command, " \t"), *save;
    if (*rest)
        *rest++ = '\0';
    if (strcmp(command, "key") == 0) {
        for (char *name = strtok_r(rest, " \t", &save); name; name = strtok_r(NULL, " \t", &save)) {
            int key = ceduo_key_find(name);
            if (key == K_NONE)
                return report_error(path, line, _("no such key"), name, CEDUO_FOREIGN_MAX);
            press_key(app, key);
        }
    } else if (strcmp(command, "type") == 0) {
        for (size_t i = 0, length, n = strlen(rest); i<n; i += length> 0 ? length : 1) {
            uint32_t code;
            length = ceduo_utf8_decode(rest + i, n - i, &code);
            if (length > 0)
                press_key(app, (int)code);
        }
    } else if (strcmp(command, "dump") == 0 || strcmp(command, "roles") == 0 || strcmp(command, "draw") == 0) {
        return dump_screen(app, command, rest, path, line);
    } else if (strcmp(command, "resize") == 0) {
        int width, height, used = 0;
        if (sscanf(rest, "%d %d%n", &width, &height, &used) != 2 || rest[used] || width < 1 || height < 1 ||
            width > CEDUO_CANVAS_MAX_WIDTH || height > CEDUO_CANVAS_MAX_HEIGHT)
            return report_error(path, line, _("width and height expected"), rest, CEDUO_FOREIGN_MAX);
        ceduo_app_resize(app, width, height);
    } else if (strcmp(command, "wait") == 0 && strcmp(rest, "idle") == 0) {
        ceduo_jobs_wait(app->live.jobs, true);
        ceduo_program_poll(app);
    } else {
        return report_error(path, line, _("key, type, resize, wait idle, dump, roles or draw expected"), command,
                            CEDUO_FOREIGN_MAX);
    }
    return SCRIPT_DONE;
}

enum script_end ceduo_script_run(struct app *app, const char *path)
{
    LOCAL_ARENA(arena);
    LOCAL_PROBLEMS(problems);
    const struct source *source = ceduo_file_read(&arena, path, YAML_BYTES_MAX, &problems);
    fputs(ceduo_problems_print(&problems), stderr);
    char *text = source ? ceduo_arena_copy(&arena, source->bytes, source->length) : NULL;
    ceduo_app_resize(app, 80, 24);
    enum script_end result = text ? SCRIPT_DONE : SCRIPT_UNREADABLE;
    for (size_t line = 1; result == SCRIPT_DONE && *text && !app->quit; line++) {
        char *end = text + strcspn(text, "\n");
        bool has_more = *end;
        *end = '\0';
        if (end > text && end[-1] == '\r')
            end[-1] = '\0';
        result = run_command(app, text, path, line);
        text = has_more ? end + 1 : end;
    }
    return result;
}
