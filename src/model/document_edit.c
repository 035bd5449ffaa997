/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edits. Each makes a changed tree, which shares all but the nodes on the path to the change, and commits it as a new
 * state. All nodes lie in the arena of the document's file. */
#include "document.h"
#include "doubt_rows.h"

#include <stdlib.h>
#include <string.h>

#include "io/file.h"
#include "io/resolve.h"

/* ---- trees ---- */

/* The node of a tree at a path, NULL where there is none. */
static const struct node *node_at(const struct node *root, const char *path)
{
    const char *within;
    size_t used = 0;
    const struct node *node = ceduo_resolve_walk(root, path, &within, &used);
    return used == strlen(path) ? node : NULL;
}

const struct node *ceduo_document_node(const struct document *d, const char *path)
{
    return node_at(d->file.root, path);
}

/* root with the node at path replaced. */
static const struct node *put(struct document *d, const struct node *root, const char *path, const struct node *value,
                              struct problems *problems)
{
    const struct source *source =
        ceduo_source_keep(&d->file.arena, (struct source){.name = path, .bytes = path, .is_option = true}, problems);
    return source && value ? ceduo_resolve_set(&d->file.arena, root, source, source->length, value, problems) : NULL;
}

/* Splits "a.b[3]" or "a.b" before its last step; false where it has only one. */
static bool split_path(struct document *d, const char *path, char **parent, char **last)
{
    const char *dot = strrchr(path, '.'), *bracket = strrchr(path, '[');
    const char *cut = bracket && (!dot || bracket > dot) ? bracket : dot;
    *parent = ceduo_arena_copy(&d->file.arena, path, cut ? (size_t)(cut - path) : 0);
    *last = ceduo_arena_string(&d->file.arena, cut ? cut + 1 : path);
    if (*last && cut == bracket && bracket)
        (*last)[strcspn(*last, "]")] = '\0';
    return *parent && *last;
}

/* What became of an item of a list: one was put in before `from` (by 1), or that one was taken out (by -1), or moved to
 * another place (by 0). */
struct shift {
    size_t from, to;
    int by;
};

static const struct node *shifted(struct document *d, const struct node *root, const char *list, struct shift s)
{
    return s.by == 0 ? ceduo_doubt_moved(&d->file.arena, root, list, s.from, s.to)
                     : ceduo_doubt_shifted(&d->file.arena, root, list, s.from, s.by);
}

/* Rows of doubt about the items of a list go along with them: those of the scene, and those of the stand that the list is
 * in. A stand without rows says so, for the file that it starts from may have some. */
static const struct node *shift_doubts(struct document *d, const struct node *root, const char *list, struct shift shift,
                                       struct problems *problems)
{
    struct arena *arena = &d->file.arena;
    const char *within = strstr(list, ".stand.");
    root = shifted(d, root, list, shift);
    if (!root || !within)
        return root;
    const char *path = ceduo_arena_copy(arena, list, (size_t)(within - list) + strlen(".stand"));
    const struct node *stand = path ? node_at(root, path) : NULL;
    const struct node *now = shifted(d, stand, within + strlen(".stand."), shift);
    if (!now || now == stand)
        return now ? root : NULL;
    if (!ceduo_node_get(now, "doubt")) {
        const struct node *none = ceduo_node_scalar(arena, stand->source, "none", false);
        now = none ? ceduo_node_with(arena, now, "doubt", none) : NULL;
    }
    if (now)
        ceduo_node_keep_written(now, stand);
    return now ? put(d, root, path, now, problems) : NULL;
}

/* root without the entry of a mapping or the item of a list. A list that is empty then is taken out whole, unless it is
 * that of options: `*path` is what was taken out. */
static const struct node *without(struct document *d, const struct node *root, const char **path, struct problems *problems)
{
    char *parent, *last;
    if (!split_path(d, *path, &parent, &last))
        return NULL;
    const struct node *holder = parent[0] ? node_at(root, parent) : root, *less = NULL;
    if (holder && holder->kind == NODE_LIST) {
        size_t i = (size_t)strtoul(last, NULL, 10);
        less = i < holder->n ? ceduo_node_removed(&d->file.arena, holder, i) : NULL;
    } else if (holder && holder->kind == NODE_MAP) {
        less = ceduo_node_without(&d->file.arena, holder, last);
    }
    if (!less)
        return NULL;
    if (less->kind == NODE_LIST && less->n == 0 && strcmp(parent, "options") != 0) {
        *path = parent;
        root = shift_doubts(d, root, parent, (struct shift){strtoul(last, NULL, 10), 0, -1}, problems);
        return root ? without(d, root, path, problems) : NULL;
    }
    ceduo_node_keep_written(less, holder);
    root = parent[0] ? put(d, root, parent, less, problems) : less;
    bool item = root && less->kind == NODE_LIST;
    return item ? shift_doubts(d, root, parent, (struct shift){strtoul(last, NULL, 10), 0, -1}, problems) : root;
}

/* root with an item put into a list, which is made where there is none. */
static const struct node *with_item(struct document *d, const struct node *root, const char *list, size_t index,
                                    const struct node *item, struct problems *problems)
{
    const struct node *holder = node_at(root, list);
    holder = holder ? holder : ceduo_document_parse(d, list, "[]", problems);
    if (!holder || holder->kind != NODE_LIST || !item)
        return NULL;
    const struct node *plain = ceduo_node_renamed(&d->file.arena, item, NULL);
    index = index > holder->n ? holder->n : index;
    const struct node *more = plain ? ceduo_node_inserted(&d->file.arena, holder, index, plain) : NULL;
    root = put(d, root, list, more, problems);
    return root ? shift_doubts(d, root, list, (struct shift){index, 0, 1}, problems) : NULL;
}

/* root with PATH=VALUE, or PATH:=VALUE, or without PATH. */
static const struct node *with_set(struct document *d, const struct node *root, const char *set, struct problems *problems)
{
    const char *equals = strchr(set, '=');
    if (!equals)
        return without(d, root, &set, problems);
    bool keeps = equals > set && equals[-1] == ':';
    char *path = ceduo_arena_copy(&d->file.arena, set, (size_t)(equals - set) - keeps);
    const struct node *value = path ? ceduo_document_parse(d, path, equals + 1, problems) : NULL;
    const struct node *old = value && keeps ? node_at(root, path) : NULL;
    if (old)
        value = ceduo_node_scalar(&d->file.arena, old->source, value->text, false);
    return value ? put(d, root, path, value, problems) : NULL;
}

/* ---- values ---- */

bool ceduo_document_set(struct document *d, const char *path, const char *value, struct problems *problems)
{
    const struct node *node = ceduo_document_parse(d, path, value, problems);
    return node && ceduo_document_commit(d, put(d, d->file.root, path, node, problems), path, problems);
}

bool ceduo_document_set_all(struct document *d, const char *const *sets, size_t n, const char *what, struct problems *problems)
{
    const struct node *root = d->file.root;
    for (size_t i = 0; root && i < n; i++)
        root = with_set(d, root, sets[i], problems);
    return ceduo_document_commit(d, root, what, problems);
}

bool ceduo_document_delete(struct document *d, const char *path, struct problems *problems)
{
    const struct node *root = without(d, d->file.root, &path, problems);
    return ceduo_document_commit(d, root, path, problems);
}

/* ---- lists ---- */

bool ceduo_document_insert(struct document *d, const char *list, size_t index, const char *text, struct problems *problems)
{
    const struct node *item = ceduo_document_parse(d, list, text, problems);
    return item && ceduo_document_commit(d, with_item(d, d->file.root, list, index, item, problems), list, problems);
}

/* Bytes of a name without the number of a copy, " (2)", and that number: 1 where there is none. A larger one is a year. */
static size_t name_of_copy(const char *name, unsigned *number)
{
    const char *open = strrchr(name, '(');
    size_t digits = open ? strspn(open + 1, "0123456789") : 0;
    bool copy = open && open > name + 1 && open[-1] == ' ' && digits > 0 && digits < 4 && strcmp(open + 1 + digits, ")") == 0;
    *number = copy ? (unsigned)strtoul(open + 1, NULL, 10) : 1;
    return copy ? (size_t)(open - 1 - name) : strlen(name);
}

/* A copy gets a name of its own where names must differ. */
static const struct node *with_new_name(struct document *d, const struct node *list, const struct node *item)
{
    const char *name = ceduo_node_text(item, "name");
    unsigned first;
    if (!name)
        return item;
    size_t n = name_of_copy(name, &first);
    for (unsigned i = first; i < first + 1000; i++) {
        struct text text = {0};
        if (i == first)
            ceduo_text_put(&text, name);
        else
            ceduo_text_format(&text, "%.*s (%u)", (int)n, name, i);
        bool taken = false;
        for (size_t k = 0; text.bytes && k < list->n; k++) {
            const char *other = ceduo_node_text(list->items[k], "name");
            taken |= other && strcmp(other, text.bytes) == 0;
        }
        const struct node *scalar =
            taken || !text.bytes ? NULL : ceduo_node_scalar(&d->file.arena, item->source, text.bytes, true);
        ceduo_text_free(&text);
        if (!taken)
            return scalar ? ceduo_node_with(&d->file.arena, item, "name", scalar) : NULL;
    }
    return NULL;
}

bool ceduo_document_duplicate(struct document *d, const char *list, size_t index, struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    if (!holder || holder->kind != NODE_LIST || index >= holder->n)
        return ceduo_document_commit(d, NULL, list, problems);
    const struct node *item = holder->items[index];
    if (strcmp(list, "options") == 0)
        item = with_new_name(d, holder, item);
    return item && ceduo_document_commit(d, with_item(d, d->file.root, list, index + 1, item, problems), list, problems);
}

bool ceduo_document_move(struct document *d, const char *list, size_t from, size_t to, struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    if (!holder || holder->kind != NODE_LIST || from >= holder->n || to >= holder->n || from == to)
        return true;
    const struct node *less = ceduo_node_removed(&d->file.arena, holder, from);
    const struct node *moved = less ? ceduo_node_inserted(&d->file.arena, less, to, holder->items[from]) : NULL;
    const struct node *root = moved ? put(d, d->file.root, list, moved, problems) : NULL;
    root = root ? shift_doubts(d, root, list, (struct shift){from, to, 0}, problems) : NULL;
    return ceduo_document_commit(d, root, list, problems);
}

bool ceduo_document_split(struct document *d, const char *list, size_t index, const char *first, const char *second,
                          struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    const struct node *item = holder && index < holder->n ? holder->items[index] : NULL;
    const struct node *root = with_item(d, d->file.root, list, index + 1, item, problems);
    root = root ? with_set(d, root, first, problems) : NULL;
    root = root ? with_set(d, root, second, problems) : NULL;
    return ceduo_document_commit(d, root, list, problems);
}

static const char vertices_list[] = "slope.vertices_m", ground_list[] = "slope.segments";

/* root with the one ground of all segments as one for each of n. */
static const struct node *with_grounds(struct document *d, const struct node *root, size_t n, struct problems *problems)
{
    const struct node *item = node_at(root, ground_list)->items[0];
    for (size_t i = 1; root && i < n; i++)
        root = with_item(d, root, ground_list, i, item, problems);
    return root;
}

bool ceduo_document_split_segment(struct document *d, size_t index, const char *vertex, bool apart, struct problems *problems)
{
    const struct node *item = ceduo_document_parse(d, vertices_list, vertex, problems);
    const struct node *root = with_item(d, d->file.root, vertices_list, index + 1, item, problems);
    const struct node *vertices = ceduo_document_node(d, vertices_list);
    const struct node *segments = ceduo_document_node(d, ground_list);
    if (root && segments && segments->n > 1)
        root = with_item(d, root, ground_list, index + 1, segments->items[index], problems);
    else if (root && segments && vertices && apart)
        root = with_grounds(d, root, vertices->n, problems);
    return ceduo_document_commit(d, root, vertices_list, problems);
}

/* Without a vertex, and without the ground of one of the segments beside it. */
static bool remove_vertex(struct document *d, size_t vertex, size_t segment, struct problems *problems)
{
    const struct node *vertices = ceduo_document_node(d, vertices_list);
    const struct node *segments = ceduo_document_node(d, ground_list);
    if (!vertices || vertices->n < 3 || vertex >= vertices->n)
        return ceduo_document_commit(d, NULL, vertices_list, problems);
    const struct node *less = ceduo_node_removed(&d->file.arena, vertices, vertex);
    const struct node *root = put(d, d->file.root, vertices_list, less, problems);
    if (root && segments && segments->n > 1)
        root = put(d, root, ground_list, ceduo_node_removed(&d->file.arena, segments, segment), problems);
    if (root && segments && segments->n > 1)
        root = ceduo_doubt_shifted(&d->file.arena, root, ground_list, segment, -1);
    return ceduo_document_commit(d, root, vertices_list, problems);
}

bool ceduo_document_join_segments(struct document *d, size_t index, struct problems *problems)
{
    const struct node *vertices = ceduo_document_node(d, vertices_list);
    return remove_vertex(d, vertices && index + 2 < vertices->n ? index + 1 : index, index, problems);
}

bool ceduo_document_remove_vertex(struct document *d, size_t vertex, struct problems *problems)
{
    const struct node *vertices = ceduo_document_node(d, vertices_list);
    return remove_vertex(d, vertex, vertices && vertex + 1 < vertices->n ? vertex : vertex - (vertex > 0), problems);
}

/* A scene whose forest is the one option "current". */
static const struct node *with_options(struct document *d, const struct node *root, struct problems *problems)
{
    if (ceduo_node_get(root, "options"))
        return root;
    const struct node *options = ceduo_document_parse(d, "options", "[{name: current}]", problems);
    const struct node *forest = ceduo_node_get(root, "forest");
    const struct node *item = options ? options->items[0] : NULL;
    if (item && forest)
        item = ceduo_node_with(&d->file.arena, item, "forest", forest);
    options = item ? ceduo_node_replaced(&d->file.arena, options, 0, item) : NULL;
    root = options ? ceduo_node_without(&d->file.arena, root, "forest") : NULL;
    root = root ? ceduo_doubt_of_options(&d->file.arena, root) : NULL;
    return root ? ceduo_node_with(&d->file.arena, root, "options", options) : NULL;
}

bool ceduo_document_add_option(struct document *d, const char *stand, struct problems *problems)
{
    const struct ceduo_option *first = &d->file.scene.options[0];
    const struct ceduo_control *c = d->file.scene.controls;
    struct text yaml = {0};
    ceduo_text_format(&yaml, "{name: \"%s\", forest: [", stand);
    for (size_t i = 0; i < first->belts_count; i++)
        ceduo_text_format(&yaml, "%s{from_m: %.10g, to_m: %.10g, stand: %s}", i ? ", " : "", first->belts[i].from_given,
                          first->belts[i].to_given, stand);
    if (first->belts_count == 0)
        ceduo_text_format(&yaml, "{from_m: %.10g, to_m: %.10g, stand: %s}", d->file.scene.slope.origin_x, c->x_given, stand);
    ceduo_text_put(&yaml, "]}");
    const struct node *item = yaml.bytes ? ceduo_document_parse(d, "options", yaml.bytes, problems) : NULL;
    const struct node *root = item ? with_options(d, d->file.root, problems) : NULL;
    const struct node *list = root ? ceduo_node_get(root, "options") : NULL;
    if (list)
        item = with_new_name(d, list, item);
    ceduo_text_free(&yaml);
    return ceduo_document_commit(d, list ? with_item(d, root, "options", list->n, item, problems) : NULL, stand, problems);
}

bool ceduo_document_copy_option(struct document *d, size_t index, struct problems *problems)
{
    const struct node *root = with_options(d, d->file.root, problems);
    const struct node *list = root ? ceduo_node_get(root, "options") : NULL;
    const struct node *item = list && index < list->n ? with_new_name(d, list, list->items[index]) : NULL;
    return ceduo_document_commit(d, item ? with_item(d, root, "options", index + 1, item, problems) : NULL, "options",
                                 problems);
}

/* A node with every `option: old` in it as `name`; NULL without memory. */
static const struct node *with_option_named(struct arena *arena, const struct node *node, const char *old,
                                            const struct node *name)
{
    for (size_t i = 0; node && node->kind != NODE_SCALAR && i < node->n; i++) {
        const struct node *item = node->items[i];
        bool same = item->kind == NODE_SCALAR && item->key && strcmp(item->key, "option") == 0 && strcmp(item->text, old) == 0;
        const struct node *now = same ? ceduo_node_renamed(arena, name, "option") : with_option_named(arena, item, old, name);
        if (now != item)
            node = now ? ceduo_node_replaced(arena, node, i, now) : NULL;
    }
    return node;
}

bool ceduo_document_rename_option(struct document *d, size_t index, const char *name, struct problems *problems)
{
    struct arena *arena = &d->file.arena;
    const struct node *root = d->file.root, *list = ceduo_node_get(root, "options");
    const struct node *item = list && index < list->n ? list->items[index] : NULL;
    const struct node *scalar = item ? ceduo_node_scalar(arena, item->source, name, true) : NULL;
    const char *old = item ? ceduo_node_text(item, "name") : NULL;
    const struct node *seen = ceduo_node_get(root, "observed");
    item = scalar ? ceduo_node_with(arena, item, "name", scalar) : NULL;
    list = item ? ceduo_node_replaced(arena, list, index, item) : NULL;
    root = list ? ceduo_node_with(arena, root, "options", list) : NULL;
    root = root && old ? ceduo_doubt_unnamed(arena, root, "options", old, index) : root;
    seen = root && seen && old ? with_option_named(arena, seen, old, scalar) : NULL;
    root = seen ? ceduo_node_with(arena, root, "observed", seen) : root;
    return ceduo_document_commit(d, root, "options", problems);
}
