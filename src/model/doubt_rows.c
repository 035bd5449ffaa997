/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "doubt_rows.h"

#include <stdlib.h>
#include <string.h>

static const struct node *with_path(struct arena *arena, const struct node *row, struct text *path)
{
    const struct node *scalar = path->bytes ? ceduo_node_scalar(arena, row->source, path->bytes, true) : NULL;
    ceduo_text_free(path);
    return scalar ? ceduo_node_with(arena, row, "path", scalar) : NULL;
}

/* Which item of a list a row is about, and in `*rest` what of it; false where it is about something else. */
static bool is_about(const struct node *row, const char *list, size_t *index, const char **rest)
{
    const char *path = ceduo_node_text(row, "path");
    size_t n = strlen(list);
    char *end;
    if (!path || strncmp(path, list, n) != 0 || path[n] != '[' || path[n + 1] < '0' || path[n + 1] > '9')
        return false;
    *index = strtoul(path + n + 1, &end, 10);
    *rest = end;
    return *end == ']';
}

/* The row about another item of its list. */
static const struct node *with_index(struct arena *arena, const struct node *row, const char *list, size_t index,
                                     const char *rest)
{
    struct text path = {0};
    ceduo_text_format(&path, "%s[%zu%s", list, index, rest);
    return with_path(arena, row, &path);
}

const struct node *ceduo_doubt_shifted(struct arena *arena, const struct node *root, const char *list, size_t index, int by)
{
    const struct node *rows = ceduo_node_get(root, "doubt"), *left = rows;
    if (!root || !rows || rows->kind != NODE_LIST)
        return root;
    for (size_t i = rows->n; left && i-- > 0;) {
        size_t at;
        const char *rest;
        if (!is_about(rows->items[i], list, &at, &rest) || at < index)
            continue;
        if (by < 0 && at == index) {
            left = ceduo_node_removed(arena, left, i);
            continue;
        }
        const struct node *row = with_index(arena, rows->items[i], list, by < 0 ? at - 1 : at + 1, rest);
        left = row ? ceduo_node_replaced(arena, left, i, row) : NULL;
    }
    if (left == rows)
        return root;
    if (left && left->n == 0)
        return ceduo_node_without(arena, root, "doubt");
    return left ? ceduo_node_with(arena, root, "doubt", left) : NULL;
}

const struct node *ceduo_doubt_moved(struct arena *arena, const struct node *root, const char *list, size_t from, size_t to)
{
    const struct node *rows = ceduo_node_get(root, "doubt"), *moved = rows;
    size_t lo = from < to ? from : to, hi = from < to ? to : from;
    if (!root || !rows || rows->kind != NODE_LIST)
        return root;
    for (size_t i = 0; moved && i < rows->n; i++) {
        size_t at;
        const char *rest;
        if (!is_about(rows->items[i], list, &at, &rest) || at < lo || at > hi)
            continue;
        size_t then = at == from ? to : from < to ? at - 1 : at + 1;
        const struct node *row = with_index(arena, rows->items[i], list, then, rest);
        moved = row ? ceduo_node_replaced(arena, moved, i, row) : NULL;
    }
    return moved ? ceduo_node_with(arena, root, "doubt", moved) : NULL;
}

const struct node *ceduo_doubt_unnamed(struct arena *arena, const struct node *root, const char *list, const char *name,
                                       size_t index)
{
    const struct node *rows = ceduo_node_get(root, "doubt"), *left = rows;
    struct text start = {0};
    ceduo_text_format(&start, "%s[%s]", list, name);
    for (size_t i = 0; start.bytes && rows && rows->kind == NODE_LIST && left && i < rows->n; i++) {
        const char *path = ceduo_node_text(rows->items[i], "path");
        if (!path || strncmp(path, start.bytes, start.length) != 0)
            continue;
        const struct node *row = with_index(arena, rows->items[i], list, index, path + start.length - 1);
        left = row ? ceduo_node_replaced(arena, left, i, row) : NULL;
    }
    bool good = start.bytes && (left || !rows);
    ceduo_text_free(&start);
    return !good ? NULL : left == rows ? root : ceduo_node_with(arena, root, "doubt", left);
}

/* A row about the forest as one about options; the row itself where it is about something else. */
static const struct node *of_options(struct arena *arena, const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    struct text moved = {0};
    if (!path || strncmp(path, "forest[", 7) != 0)
        return row;
    ceduo_text_format(&moved, "options[%s].%s", strncmp(path, "forest[*]", 9) == 0 ? "*" : "current", path);
    return with_path(arena, row, &moved);
}

const struct node *ceduo_doubt_of_options(struct arena *arena, const struct node *root)
{
    const struct node *rows = ceduo_node_get(root, "doubt"), *moved = rows;
    if (!rows || rows->kind != NODE_LIST)
        return root;
    for (size_t i = 0; moved && i < rows->n; i++) {
        const struct node *row = of_options(arena, rows->items[i]);
        moved = row ? ceduo_node_replaced(arena, moved, i, row) : NULL;
    }
    return moved ? ceduo_node_with(arena, root, "doubt", moved) : NULL;
}
