/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "node.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

const struct node *ceduo_node_get(const struct node *node, const char *key)
{
    if (!node || node->kind != NODE_MAP)
        return NULL;
    for (size_t i = 0; i < node->n; i++)
        if (strcmp(node->items[i]->key, key) == 0)
            return node->items[i];
    return NULL;
}

const char *ceduo_node_text(const struct node *node, const char *key)
{
    const struct node *entry = ceduo_node_get(node, key);
    return entry && entry->kind == NODE_SCALAR ? entry->text : NULL;
}

static double read_number(const char *text)
{
    double value;
    return text && ceduo_number_read(text, &value) == CEDUO_NUMBER_GOOD ? value : NAN;
}

double ceduo_node_number(const struct node *node, const char *key)
{
    return read_number(ceduo_node_text(node, key));
}

double ceduo_node_item_number(const struct node *list, size_t i)
{
    return list->kind == NODE_LIST && i < list->n && list->items[i]->kind == NODE_SCALAR ? read_number(list->items[i]->text)
                                                                                         : NAN;
}

/* Copy a node, with `removed` items from i on replaced by `inserted` (may be NULL). */
static const struct node *splice(struct arena *arena, const struct node *node, size_t i, size_t removed,
                                 const struct node *inserted)
{
    size_t n = node->n - removed + (inserted != NULL), after = node->n - i - removed;
    struct node *copy = ceduo_arena_alloc(arena, sizeof *copy);
    const struct node **items = ceduo_arena_alloc(arena, (n + 1) * sizeof *items);
    if (!copy || !items)
        return NULL;
    *copy = *node;
    copy->items = items;
    copy->n = n;
    copy->written = copy->followed = NULL;
    if (i > 0)
        memcpy(items, node->items, i * sizeof *items);
    if (inserted)
        items[i] = inserted;
    if (after > 0)
        memcpy(items + i + (inserted != NULL), node->items + i + removed, after * sizeof *items);
    return copy;
}

void ceduo_node_keep_text(const struct node *made, const struct node *from)
{
    struct node *node = (struct node *)(uintptr_t)made; /* still private, safe to modify */
    node->written = from->written;
    node->followed = from->followed;
}

const struct node *ceduo_node_replaced(struct arena *arena, const struct node *node, size_t i, const struct node *value)
{
    return value ? splice(arena, node, i, 1, value) : NULL;
}

const struct node *ceduo_node_inserted(struct arena *arena, const struct node *node, size_t i, const struct node *value)
{
    return splice(arena, node, i, 0, value);
}

const struct node *ceduo_node_removed(struct arena *arena, const struct node *node, size_t i)
{
    return splice(arena, node, i, 1, NULL);
}

const struct node *ceduo_node_renamed(struct arena *arena, const struct node *value, const char *key)
{
    struct node *copy = ceduo_arena_alloc(arena, sizeof *copy);
    if (!copy || !value)
        return NULL;
    *copy = *value;
    copy->key = key ? ceduo_arena_string(arena, key) : NULL;
    return key && !copy->key ? NULL : copy;
}

const struct node *ceduo_node_with(struct arena *arena, const struct node *map, const char *key, const struct node *value)
{
    const struct node *named = ceduo_node_renamed(arena, value, key);
    if (!map || !named)
        return NULL;
    for (size_t i = 0; i < map->n; i++)
        if (strcmp(map->items[i]->key, key) == 0)
            return ceduo_node_replaced(arena, map, i, named);
    return ceduo_node_inserted(arena, map, map->n, named);
}

const struct node *ceduo_node_without(struct arena *arena, const struct node *map, const char *key)
{
    for (size_t i = 0; map && i < map->n; i++) /* untaken: memory */
        if (strcmp(map->items[i]->key, key) == 0)
            return ceduo_node_removed(arena, map, i);
    return map;
}

const struct node *ceduo_node_empty(struct arena *arena, enum node_kind kind, const struct source *source)
{
    struct node *node = ceduo_arena_alloc(arena, sizeof *node);
    if (node)
        *node = (struct node){.kind = kind, .flow = kind == NODE_LIST, .source = source, .line = 1, .column = 1};
    return node;
}

const struct node *ceduo_node_scalar(struct arena *arena, const struct source *source, const char *text, bool quoted)
{
    struct node *node = ceduo_arena_alloc(arena, sizeof *node);
    if (!node)
        return NULL;
    *node = (struct node){.kind = NODE_SCALAR, .quoted = quoted, .source = source, .text = ceduo_arena_string(arena, text)};
    return node->text ? node : NULL;
}

struct problem_place ceduo_node_place(const struct node *node, const char *path)
{
    return (struct problem_place){.source = node->source, .line = node->line, .column = node->column, .path = path};
}

bool ceduo_node_equal(const struct node *a, const struct node *b)
{
    if (a == b)
        return true;
    if (!a || !b || a->kind != b->kind || a->n != b->n)
        return false;
    if ((a->key != NULL) != (b->key != NULL) || (a->key && strcmp(a->key, b->key) != 0))
        return false;
    if (a->kind == NODE_SCALAR) {
        double number; /* quotes matter only around a number: they make it text */
        bool numeric = ceduo_number_read(a->text, &number) == CEDUO_NUMBER_GOOD;
        return strcmp(a->text, b->text) == 0 && (a->quoted == b->quoted || !numeric);
    }
    for (size_t i = 0; i < a->n; i++)
        if (!ceduo_node_equal(a->items[i], b->items[i]))
            return false;
    return true;
}
