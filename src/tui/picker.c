/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "picker.h"

#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/text.h"
#include "base/utf8.h"
#include "keys.h"

/* ---- the line ---- */

void ceduo_line_set(struct line *line, const char *text)
{
    size_t n = strlen(text);
    if (n >= sizeof line->text)
        n = 0; /* too long for a line */
    memcpy(line->text, text, n);
    line->text[n] = '\0';
    line->cursor = n;
    line->unedited = true;
    line->confirmed = false;
}

static void cut_line(struct line *line, size_t from, size_t to)
{
    memmove(line->text + from, line->text + to, strlen(line->text + to) + 1);
    line->cursor = from;
}

bool ceduo_line_handle_key(struct line *line, int key)
{
    bool was_unedited = line->unedited;
    line->unedited = line->confirmed = false;
    if (was_unedited && ((key >= ' ' && key < K_SPECIAL) || key == K_BACKSPACE))
        cut_line(line, 0, strlen(line->text));
    char bytes[4], *tail = line->text + line->cursor;
    size_t before = (size_t)(ceduo_utf8_back(line->text, tail) - line->text);
    size_t after = line->cursor + (*tail ? ceduo_utf8_step(tail) : 0);
    if (key == K_LEFT)
        line->cursor = before;
    else if (key == K_RIGHT)
        line->cursor = after;
    else if (key == K_HOME)
        line->cursor = 0;
    else if (key == K_END)
        line->cursor = strlen(line->text);
    else if (key == K_BACKSPACE)
        cut_line(line, before, line->cursor);
    else if (key == K_DELETE)
        cut_line(line, line->cursor, after);
    else if (key == K_CTRL_U)
        cut_line(line, 0, line->cursor);
    else if (key < K_SPECIAL && ceduo_utf8_printable((uint32_t)key)) {
        size_t n = ceduo_utf8_encode((uint32_t)key, bytes), rest = strlen(tail) + 1;
        if (line->cursor + rest + n > sizeof line->text)
            return true; /* full */
        memmove(tail + n, tail, rest);
        memcpy(tail, bytes, n);
        line->cursor += n;
    } else
        return false;
    return true;
}

bool ceduo_line_paste(struct line *line, const char *text)
{
    size_t n = strlen(text), old_length = line->unedited ? 0 : strlen(line->text);
    bool started = false, gap = false;
    if (old_length + n >= sizeof line->text)
        return false;
    for (size_t i = 0, step; i < n; i += step) {
        uint32_t code = 0;
        step = ceduo_utf8_decode(text + i, n - i, &code);
        step = step > 0 ? step : 1;
        gap |= code == '\n' || code == '\r' || code == '\t';
        if (!ceduo_utf8_printable(code))
            continue;
        if (started && gap)
            ceduo_line_handle_key(line, ' ');
        ceduo_line_handle_key(line, (int)code);
        started = true;
        gap = false;
    }
    return true;
}

/* ---- the list ---- */

void ceduo_picker_clear(struct picker *p)
{
    ceduo_arena_free(&p->arena);
    free(p->items);
    free(p->order);
    *p = (struct picker){0};
}

void ceduo_picker_add(struct picker *p, const char *text, const char *name, const char *value, bool is_current)
{
    LOCAL_TEXT(safe);
    p->items = ceduo_grow(p->items, p->count, &p->capacity, sizeof *p->items);
    p->order = ceduo_grow(p->order, p->count, &p->order_capacity, sizeof *p->order);
    ceduo_text_append_escaped(&safe, text);
    if (is_current)
        ceduo_text_append_joined(&safe, "  ", _("(now)"));
    p->items[p->count++] =
        (struct picker_item){ceduo_arena_string(&p->arena, ceduo_text_string(&safe)), ceduo_arena_string(&p->arena, value),
                             ceduo_arena_string(&p->arena, name), is_current, 0};
}

bool ceduo_picker_has(const struct picker *p, const char *value)
{
    for (size_t i = 0; i < p->count; i++)
        if (strcmp(p->items[i].value, value) == 0)
            return true;
    return false;
}

/* ---- matching ---- */

void ceduo_picker_filter(struct picker *p, const char *typed)
{
    p->matches = 0;
    for (size_t i = 0; i < p->count; i++) {
        struct picker_item *item = &p->items[i];
        size_t position = p->matches;
        item->match = ceduo_fuzzy_match(typed, item->name);
        if (item->match < 0)
            continue;
        for (; position > 0 && p->items[p->order[position - 1]].match < item->match; position--) /* keep better matches first */
            p->order[position] = p->order[position - 1];
        p->order[position] = i;
        p->matches++;
    }
    p->lines = (struct viewport){.count = (int)p->matches};
    for (size_t i = 0; !typed[0] && i < p->matches; i++)
        if (p->items[p->order[i]].is_current)
            p->lines.selected = (int)i;
}

void ceduo_picker_go_to(struct picker *p, const char *value)
{
    for (size_t i = 0; i < p->matches; i++)
        if (strcmp(p->items[p->order[i]].value, value) == 0)
            p->lines.selected = (int)i;
}

const struct picker_item *ceduo_picker_selected(const struct picker *p)
{
    return p->matches > 0 ? &p->items[p->order[p->lines.selected]] : NULL;
}

void ceduo_picker_draw(struct picker *p, struct ceduo_cells *cells, struct ceduo_area area)
{
    struct viewport *v = &p->lines;
    viewport_fit(v, area.height > 0 ? area.height : 0, (int)p->matches);
    viewport_show(v, v->selected, v->selected);
    for (int i = v->first; i < v->first + v->rows && i < v->count; i++)
        ceduo_canvas_draw_text(&cells->canvas, area.left, area.top + i - v->first, area.width,
                               i == v->selected ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, p->items[p->order[i]].text);
}

/* ---- files ---- */

#define FILES_MAX 2000 /* max. files listed of a folder */

bool ceduo_picker_is_file(const char *name, const char *endings)
{
    const char *dot = strrchr(name, '.'), *match = dot && dot > name && dot[1] ? strcasestr(endings, dot) : NULL;
    return match && strchr(" ", match[strlen(dot)]);
}

/* Add the entries of a folder with a rank: the first ending, the others, folders. */
static void add_entries(struct picker *p, const char *folder, struct dirent **entries, int count, const char *endings, int rank)
{
    LOCAL_TEXT(path);
    for (int i = 0; i < count && i < FILES_MAX; i++) {
        struct stat st;
        const char *name = entries[i]->d_name, *dot = strrchr(name, '.');
        path.length = 0;
        ceduo_text_format(&path, "%s%s", folder, name);
        bool is_folder = stat(path.bytes, &st) == 0 && S_ISDIR(st.st_mode);
        bool is_file = !is_folder && ceduo_picker_is_file(name, endings);
        if (is_folder)
            ceduo_text_append(&path, "/");
        if (name[0] != '.' && (rank == 2 ? is_folder : is_file && (strcasestr(endings, dot) != endings) == rank) &&
            !ceduo_picker_has(p, path.bytes))
            ceduo_picker_add(p, path.bytes, path.bytes, path.bytes, false);
    }
}

void ceduo_picker_add_files(struct picker *p, const char *typed, const char *endings)
{
    const char *slash = strrchr(typed, '/');
    LOCAL_TEXT(folder);
    struct dirent **entries = NULL;
    ceduo_text_append_n(&folder, typed, slash ? (size_t)(slash - typed) + 1 : 0);
    int count = scandir(folder.length ? folder.bytes : ".", &entries, NULL, alphasort);
    for (int rank = 0; rank <= 2; rank++)
        add_entries(p, ceduo_text_string(&folder), entries, count, endings, rank);
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
}

bool ceduo_picker_complete(const struct picker *p, struct line *line)
{
    const char *common = NULL;
    size_t n = 0, typed = strlen(line->text);
    for (size_t i = 0; i < p->count; i++) {
        const char *value = p->items[i].value;
        if (strncmp(value, line->text, typed) != 0)
            continue;
        size_t equal = 0;
        while (common && equal < n && common[equal] == value[equal])
            equal++;
        n = common ? equal : strlen(value);
        common = common ? common : value;
    }
    if (!common || n <= typed || n >= sizeof line->text)
        return false;
    char buf[sizeof line->text];
    snprintf(buf, sizeof buf, "%.*s", (int)n, common);
    ceduo_line_set(line, buf);
    line->unedited = false;
    return true;
}
