/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "picker.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/language.h"
#include "base/must.h"
#include "base/text.h"

void ceduo_picker_clear(struct picker *p)
{
    ceduo_arena_free(&p->arena);
    free(p->picks);
    free(p->order);
    *p = (struct picker){0};
}

void ceduo_picker_add(struct picker *p, const char *text, const char *name, const char *value, bool now)
{
    LOCAL_TEXT(safe);
    p->picks = ceduo_grow(p->picks, p->count, &p->room, sizeof *p->picks);
    p->order = ceduo_grow(p->order, p->count, &p->order_room, sizeof *p->order);
    ceduo_text_safe(&safe, text);
    if (now)
        ceduo_text_then(&safe, "  ", _("(now)"));
    p->picks[p->count++] = (struct pick){ceduo_arena_string(&p->arena, ceduo_text_string(&safe)),
                                         ceduo_arena_string(&p->arena, value), ceduo_arena_string(&p->arena, name), now, 0};
}

bool ceduo_picker_has(const struct picker *p, const char *value)
{
    for (size_t i = 0; i < p->count; i++)
        if (strcmp(p->picks[i].value, value) == 0)
            return true;
    return false;
}

/* ---- matching ---- */

void ceduo_picker_filter(struct picker *p, const char *typed)
{
    p->matches = p->at = 0;
    p->top = 0;
    for (size_t i = 0; i < p->count; i++) {
        struct pick *pick = &p->picks[i];
        size_t at = p->matches;
        pick->match = ceduo_fuzzy_match(typed, pick->name);
        if (pick->match < 0)
            continue;
        for (; at > 0 && p->picks[p->order[at - 1]].match < pick->match; at--) /* before those that match less well */
            p->order[at] = p->order[at - 1];
        p->order[at] = i;
        p->matches++;
    }
    for (size_t i = 0; !typed[0] && i < p->matches; i++)
        if (p->picks[p->order[i]].now)
            p->at = i;
}

void ceduo_picker_go_to(struct picker *p, const char *value)
{
    for (size_t i = 0; i < p->matches; i++)
        if (strcmp(p->picks[p->order[i]].value, value) == 0)
            p->at = i;
}

void ceduo_picker_move(struct picker *p, int by)
{
    long at = (long)p->at + by, last = (long)p->matches - 1;
    at = at > last ? last : at;
    p->at = at > 0 ? (size_t)at : 0;
}

const struct pick *ceduo_picker_at(const struct picker *p)
{
    return p->at < p->matches ? &p->picks[p->order[p->at]] : NULL;
}

int ceduo_picker_draw(struct picker *p, struct ceduo_cells *cells, struct ceduo_area area)
{
    int at = (int)p->at, n = (int)p->matches, height = area.height;
    if (height < 1)
        return 0;
    p->top = at < p->top ? at : at >= p->top + height ? at + 1 - height : p->top;
    for (int i = p->top; i < p->top + height && i < n; i++)
        ceduo_canvas_put(&cells->canvas, area.left, area.top + i - p->top, area.width,
                         i == at ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, p->picks[p->order[i]].text);
    return (p->top > 0) + 2 * (p->top + height < n);
}

/* ---- files ---- */

#define FILES_MAX 2000 /* of a folder: more nobody looks through */

bool ceduo_picker_is_file(const char *name, const char *endings)
{
    const char *dot = strrchr(name, '.'), *at = dot && dot > name && dot[1] ? strcasestr(endings, dot) : NULL;
    return at && strchr(" ", at[strlen(dot)]);
}

void ceduo_picker_add_files(struct picker *p, const char *typed, const char *endings)
{
    const char *slash = strrchr(typed, '/');
    LOCAL_TEXT(folder);
    LOCAL_TEXT(path);
    struct dirent **entries = NULL;
    ceduo_text_add(&folder, typed, slash ? (size_t)(slash - typed) + 1 : 0);
    int count = scandir(folder.length ? folder.bytes : ".", &entries, NULL, alphasort);
    for (int i = 0; i < count; i++) {
        struct stat st;
        const char *name = entries[i]->d_name;
        path.length = 0;
        ceduo_text_format(&path, "%s%s", ceduo_text_string(&folder), name);
        bool is_folder = stat(path.bytes, &st) == 0 && S_ISDIR(st.st_mode);
        if (is_folder)
            ceduo_text_put(&path, "/");
        if (i < FILES_MAX && name[0] != '.' && (is_folder || ceduo_picker_is_file(name, endings)) &&
            !ceduo_picker_has(p, path.bytes))
            ceduo_picker_add(p, path.bytes, path.bytes, path.bytes, false);
        free(entries[i]);
    }
    free(entries);
}

bool ceduo_picker_complete(const struct picker *p, struct line *line)
{
    const char *common = NULL;
    size_t n = 0, typed = strlen(line->text);
    for (size_t i = 0; i < p->count; i++) {
        const char *value = p->picks[i].value;
        if (strncmp(value, line->text, typed) != 0)
            continue;
        size_t same = 0;
        while (common && same < n && common[same] == value[same])
            same++;
        n = common ? same : strlen(value);
        common = common ? common : value;
    }
    if (!common || n <= typed || n >= sizeof line->text)
        return false;
    char room[sizeof line->text];
    snprintf(room, sizeof room, "%.*s", (int)n, common);
    ceduo_line_set(line, room);
    line->fresh = false;
    return true;
}
