/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/emit.h"
#include "io/file.h"
#include "base/intl.h"
#include "io/resolve.h"
#include "recovery.h"

/* ---- states ---- */

/* Room for one more state. */
static bool reserve_state(struct document *d)
{
    if (d->count < d->room)
        return true;
    size_t room = d->room ? 2 * d->room : 64;
    struct document_state *states = realloc(d->states, room * sizeof *states);
    if (!states)
        return false;
    d->states = states;
    d->room = room;
    return true;
}

static void push_state(struct document *d, const struct node *root, const char *what)
{
    if (d->at + 1 < d->count && d->saved > d->at && d->saved < d->count)
        d->saved = SIZE_MAX; /* the state on disk can no longer be reached by redo */
    if (d->count > 0)
        d->count = d->at + 1;
    d->states[d->count] = (struct document_state){root, what};
    d->at = d->count++;
}

/* History may grow by DOCUMENT_HISTORY_BYTES: then the older half of it is forgotten. What memory it took is given back
 * only when the document closes, so the limit is on states, measured by what the arena has grown since. */
static void trim_history(struct document *d)
{
    if (d->file.arena.bytes - d->trimmed < DOCUMENT_HISTORY_BYTES || d->count < 4)
        return;
    d->trimmed = d->file.arena.bytes;
    size_t drop = d->at / 2;
    memmove(d->states, d->states + drop, (d->count - drop) * sizeof *d->states);
    d->count -= drop;
    d->at -= drop;
    d->saved = d->saved >= drop && d->saved != SIZE_MAX ? d->saved - drop : SIZE_MAX;
}

/* Makes `root` the scene, if it is one; otherwise everything stays. */
static bool adopt(struct document *d, const struct node *root, struct problems *problems)
{
    struct scene_file before = d->file;
    const struct node *resolved = ceduo_resolve_scene(&d->file.arena, root, problems);
    bool good = false;
    if (resolved && problems->count == 0) {
        d->file.root = resolved;
        good = ceduo_scene_bind(&d->file, problems);
    }
    if (!good) {
        struct arena arena = d->file.arena; /* it has grown */
        d->file = before;
        d->file.arena = arena;
    }
    return good;
}

static bool commit(struct document *d, const struct node *root, const char *what, struct problems *problems)
{
    if (!root) {
        if (problems->count == 0)
            ceduo_problem_memory(problems);
        return false;
    }
    const struct node *before = d->file.root;
    const char *kept = ceduo_arena_string(&d->file.arena, what);
    if (!kept || !reserve_state(d)) { /* before anything changes */
        ceduo_problem_memory(problems);
        return false;
    }
    if (!adopt(d, root, problems))
        return false;
    if (ceduo_node_equal(before, d->file.root)) { /* nothing has changed: no state for it */
        d->file.root = before;
        return true;
    }
    push_state(d, d->file.root, kept);
    trim_history(d);
    ceduo_document_keep(d);
    return true;
}

/* ---- opening ---- */

/* A folder of profiles that is the user's own. */
static bool is_own(const char *folder)
{
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    return (data && data[0] == '/' && strncmp(folder, data, strlen(data)) == 0) ||
           (home && strstr(folder, "/.local/share/ceduo") && strncmp(folder, home, strlen(home)) == 0);
}

bool ceduo_document_is_shipped(const char *path)
{
    struct arena arena = {0};
    const char *const *folders = ceduo_file_folders(&arena);
    char *real = realpath(path, NULL);
    bool shipped = false;
    for (size_t i = 0; real && folders && folders[i] && !shipped; i++) {
        char *folder = realpath(folders[i], NULL);
        size_t n = folder ? strlen(folder) : 0;
        shipped = folder && !is_own(folders[i]) && strncmp(real, folder, n) == 0 && real[n] == '/';
        free(folder);
    }
    free(real);
    ceduo_arena_free(&arena);
    return shipped;
}

static void note_disk(struct document *d)
{
    struct stat st;
    if (d->path && stat(d->path, &st) == 0) {
        d->modified = st.st_mtim;
        d->size = st.st_size;
    }
}

static void put_backup(struct text *name, const char *path)
{
    ceduo_text_format(name, "%s.bak", path);
}

/* A save that was killed may have left something behind. */
static void tidy(const char *path)
{
    struct text backup = {0};
    put_backup(&backup, path);
    ceduo_file_tidy(path);
    if (!backup.failed)
        ceduo_file_tidy(backup.bytes);
    ceduo_text_free(&backup);
}

bool ceduo_document_open(struct document *d, const char *path, struct problems *problems)
{
    *d = (struct document){0};
    if (!ceduo_scene_read(&d->file, path, NULL, 0, problems)) {
        ceduo_document_close(d);
        return false;
    }
    d->raw = d->file.raw;
    d->path = strcmp(path, "-") == 0 ? NULL : strdup(d->file.path);
    d->shipped = d->path && ceduo_document_is_shipped(d->path);
    if (d->path && !d->shipped)
        tidy(d->path);
    note_disk(d);
    d->recovery = ceduo_recovery_path(d->path);
    if (!reserve_state(d)) {
        ceduo_problem_memory(problems);
        ceduo_document_close(d);
        return false;
    }
    push_state(d, d->file.root, "");
    return true;
}

bool ceduo_document_new(struct document *d, const char *text, struct problems *problems)
{
    *d = (struct document){.saved = SIZE_MAX};
    bool good = ceduo_scene_read_text(&d->file, _("new scene"), text, problems);
    if (good && !reserve_state(d)) {
        ceduo_problem_memory(problems);
        good = false;
    }
    if (!good) {
        ceduo_document_close(d);
        return false;
    }
    push_state(d, d->file.root, "");
    d->raw = NULL;
    d->recovery = ceduo_recovery_path(NULL);
    ceduo_document_keep(d);
    return true;
}

void ceduo_document_close(struct document *d)
{
    ceduo_scene_release(&d->file);
    free(d->states);
    free(d->path);
    free(d->recovery);
    *d = (struct document){0};
}

/* ---- editing ---- */

const struct node *ceduo_document_node(const struct document *d, const char *path)
{
    const char *within;
    size_t used = 0;
    const struct node *node = ceduo_resolve_walk(d->file.root, path, &within, &used);
    return used == strlen(path) ? node : NULL;
}

/* root with the node at path replaced. */
static const struct node *put(struct document *d, const struct node *root, const char *path, const struct node *value,
                              struct problems *problems)
{
    struct source *source = ceduo_arena_take(&d->file.arena, sizeof *source);
    char *copy = ceduo_arena_string(&d->file.arena, path);
    if (!source || !copy || !value)
        return NULL;
    *source = (struct source){.name = copy, .bytes = copy, .length = strlen(copy), .is_option = true};
    return ceduo_resolve_set(&d->file.arena, root, source, strlen(copy), value, problems);
}

static const struct node *parse(struct document *d, const char *name, const char *text, struct problems *problems)
{
    struct source *source = ceduo_arena_take(&d->file.arena, sizeof *source);
    char *copy = ceduo_arena_string(&d->file.arena, text);
    char *title = ceduo_arena_string(&d->file.arena, name);
    /* a copy: the document may be saved elsewhere, what was typed is looked for where it was typed */
    char *beside = d->path ? ceduo_arena_string(&d->file.arena, d->path) : NULL;
    if (!source || !copy || !title) {
        ceduo_problem_memory(problems);
        return NULL;
    }
    *source = (struct source){
        .name = title, .bytes = copy, .length = strlen(copy), .is_option = true, .beside = beside};
    return ceduo_yaml_read(&d->file.arena, source, problems);
}

static const struct node *with_set(struct document *d, const struct node *root, const char *set,
                                   struct problems *problems);

bool ceduo_document_set(struct document *d, const char *path, const char *value, struct problems *problems)
{
    const struct node *node = parse(d, path, value, problems);
    return node && commit(d, put(d, d->file.root, path, node, problems), path, problems);
}

bool ceduo_document_set_all(struct document *d, const char *const *sets, size_t n, const char *what,
                            struct problems *problems)
{
    const struct node *root = d->file.root;
    for (size_t i = 0; root && i < n; i++)
        root = with_set(d, root, sets[i], problems);
    return commit(d, root, what, problems);
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

bool ceduo_document_delete(struct document *d, const char *path, struct problems *problems)
{
    char *parent, *last;
    if (!split_path(d, path, &parent, &last))
        return commit(d, NULL, path, problems);
    const struct node *holder = parent[0] ? ceduo_document_node(d, parent) : d->file.root;
    const struct node *less = NULL;
    if (holder && holder->kind == NODE_LIST) {
        size_t i = (size_t)strtoul(last, NULL, 10);
        less = i < holder->n ? ceduo_node_removed(&d->file.arena, holder, i) : NULL;
    } else if (holder && holder->kind == NODE_MAP) {
        less = ceduo_node_without(&d->file.arena, holder, last);
    }
    if (!less)
        return commit(d, NULL, path, problems);
    /* a list that is empty now is taken out whole, unless it is the list of options or belts */
    if (less->kind == NODE_LIST && less->n == 0 && strcmp(parent, "options") != 0)
        return ceduo_document_delete(d, parent, problems);
    ceduo_node_keep_written(less, holder);
    return commit(d, parent[0] ? put(d, d->file.root, parent, less, problems) : less, path, problems);
}

static bool insert_node(struct document *d, const char *list, size_t index, const struct node *item,
                        struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    if (!holder) {
        holder = parse(d, list, "[]", problems);
        index = 0;
    }
    if (!holder || holder->kind != NODE_LIST || !item)
        return commit(d, NULL, list, problems);
    const struct node *plain = ceduo_node_renamed(&d->file.arena, item, NULL);
    const struct node *more =
        plain ? ceduo_node_inserted(&d->file.arena, holder, index > holder->n ? holder->n : index, plain) : NULL;
    return commit(d, more ? put(d, d->file.root, list, more, problems) : NULL, list, problems);
}

bool ceduo_document_insert(struct document *d, const char *list, size_t index, const char *text,
                           struct problems *problems)
{
    const struct node *item = parse(d, list, text, problems);
    return item && insert_node(d, list, index, item, problems);
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
        return commit(d, NULL, list, problems);
    const struct node *item = holder->items[index];
    if (strcmp(list, "options") == 0)
        item = with_new_name(d, holder, item);
    return item && insert_node(d, list, index + 1, item, problems);
}

bool ceduo_document_move(struct document *d, const char *list, size_t from, size_t to, struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    if (!holder || holder->kind != NODE_LIST || from >= holder->n || to >= holder->n || from == to)
        return true;
    const struct node *less = ceduo_node_removed(&d->file.arena, holder, from);
    const struct node *moved = less ? ceduo_node_inserted(&d->file.arena, less, to, holder->items[from]) : NULL;
    return commit(d, moved ? put(d, d->file.root, list, moved, problems) : NULL, list, problems);
}

bool ceduo_document_delete_both(struct document *d, const char *map, const char *first, const char *second,
                                struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, map);
    const struct node *less = holder ? ceduo_node_without(&d->file.arena, holder, first) : NULL;
    less = less ? ceduo_node_without(&d->file.arena, less, second) : NULL;
    if (less && less != holder)
        ceduo_node_keep_written(less, holder);
    return commit(d, less ? put(d, d->file.root, map, less, problems) : NULL, map, problems);
}

/* root with an item put into a list. */
static const struct node *with_item(struct document *d, const struct node *root, const char *list, size_t index,
                                    const struct node *item, struct problems *problems)
{
    const char *within;
    size_t used;
    const struct node *holder = ceduo_resolve_walk(root, list, &within, &used);
    if (used != strlen(list) || holder->kind != NODE_LIST || index > holder->n || !item)
        return NULL;
    const struct node *plain = ceduo_node_renamed(&d->file.arena, item, NULL);
    return put(d, root, list, plain ? ceduo_node_inserted(&d->file.arena, holder, index, plain) : NULL, problems);
}

/* root without the entry of a mapping. */
static const struct node *without(struct document *d, const struct node *root, const char *path,
                                  struct problems *problems)
{
    char *parent, *last;
    const char *within;
    size_t used;
    if (!split_path(d, path, &parent, &last))
        return NULL;
    const struct node *holder = ceduo_resolve_walk(root, parent, &within, &used);
    const struct node *less = used == strlen(parent) ? ceduo_node_without(&d->file.arena, holder, last) : NULL;
    if (less && less != holder)
        ceduo_node_keep_written(less, holder);
    return less && parent[0] ? put(d, root, parent, less, problems) : less;
}

/* root with PATH=VALUE, or without PATH. */
static const struct node *with_set(struct document *d, const struct node *root, const char *set,
                                   struct problems *problems)
{
    const char *equals = strchr(set, '=');
    if (!equals)
        return without(d, root, set, problems);
    char *path = equals ? ceduo_arena_copy(&d->file.arena, set, (size_t)(equals - set)) : NULL;
    const struct node *value = path ? parse(d, path, equals + 1, problems) : NULL;
    return value ? put(d, root, path, value, problems) : NULL;
}

bool ceduo_document_split(struct document *d, const char *list, size_t index, const char *first, const char *second,
                          struct problems *problems)
{
    const struct node *holder = ceduo_document_node(d, list);
    const struct node *item = holder && index < holder->n ? holder->items[index] : NULL;
    const struct node *root = with_item(d, d->file.root, list, index + 1, item, problems);
    root = root ? with_set(d, root, first, problems) : NULL;
    root = root ? with_set(d, root, second, problems) : NULL;
    return commit(d, root, list, problems);
}

bool ceduo_document_split_segment(struct document *d, size_t index, const char *vertex, struct problems *problems)
{
    const char *list = "slope.vertices_m", *ground = "slope.segments";
    const struct node *root = with_item(d, d->file.root, list, index + 1, parse(d, list, vertex, problems), problems);
    const struct node *segments = ceduo_document_node(d, ground);
    if (root && segments && segments->n > 1)
        root = with_item(d, root, ground, index + 1, segments->items[index], problems);
    return commit(d, root, list, problems);
}

bool ceduo_document_join_segments(struct document *d, size_t index, struct problems *problems)
{
    const char *list = "slope.vertices_m", *ground = "slope.segments";
    const struct node *vertices = ceduo_document_node(d, list), *segments = ceduo_document_node(d, ground);
    if (!vertices || !segments || vertices->n < 3)
        return commit(d, NULL, ground, problems);
    size_t vertex = index + 2 < vertices->n ? index + 1 : index;
    const struct node *root = put(d, d->file.root, list, ceduo_node_removed(&d->file.arena, vertices, vertex), problems);
    if (root && segments->n > 1)
        root = put(d, root, ground, ceduo_node_removed(&d->file.arena, segments, index), problems);
    return commit(d, root, ground, problems);
}

/* A scene whose forest is the one option "current". */
static const struct node *with_options(struct document *d, const struct node *root, struct problems *problems)
{
    if (ceduo_node_get(root, "options"))
        return root;
    const struct node *options = parse(d, "options", "[{name: current}]", problems);
    const struct node *forest = ceduo_node_get(root, "forest");
    const struct node *item = options ? options->items[0] : NULL;
    if (item && forest)
        item = ceduo_node_with(&d->file.arena, item, "forest", forest);
    options = item ? ceduo_node_replaced(&d->file.arena, options, 0, item) : NULL;
    root = options ? ceduo_node_without(&d->file.arena, root, "forest") : NULL;
    return root ? ceduo_node_with(&d->file.arena, root, "options", options) : NULL;
}

bool ceduo_document_add_option(struct document *d, const char *stand, struct problems *problems)
{
    const struct ceduo_option *first = &d->file.scene.options[0];
    const struct ceduo_control *c = d->file.scene.controls;
    struct text yaml = {0};
    ceduo_text_format(&yaml, "{name: \"%s\", forest: [", stand);
    for (size_t i = 0; i < first->belts_count; i++)
        ceduo_text_format(&yaml, "%s{from_m: %.10g, to_m: %.10g, stand: %s}", i ? ", " : "",
                          first->belts[i].from_given, first->belts[i].to_given, stand);
    if (first->belts_count == 0)
        ceduo_text_format(&yaml, "{from_m: %.10g, to_m: %.10g, stand: %s}", d->file.origin_x, c->x_given, stand);
    ceduo_text_put(&yaml, "]}");
    const struct node *item = yaml.bytes ? parse(d, "options", yaml.bytes, problems) : NULL;
    const struct node *root = item ? with_options(d, d->file.root, problems) : NULL;
    const struct node *list = root ? ceduo_node_get(root, "options") : NULL;
    if (list)
        item = with_new_name(d, list, item);
    ceduo_text_free(&yaml);
    return commit(d, list ? with_item(d, root, "options", list->n, item, problems) : NULL, stand, problems);
}

bool ceduo_document_copy_option(struct document *d, size_t index, struct problems *problems)
{
    const struct node *root = with_options(d, d->file.root, problems);
    const struct node *list = root ? ceduo_node_get(root, "options") : NULL;
    const struct node *item = list && index < list->n ? with_new_name(d, list, list->items[index]) : NULL;
    return commit(d, item ? with_item(d, root, "options", index + 1, item, problems) : NULL, "options", problems);
}

/* ---- undo ---- */

static bool go_to(struct document *d, size_t state)
{
    struct problems problems = {0};
    bool good = adopt(d, d->states[state].root, &problems);
    if (good)
        d->at = state;
    ceduo_problems_free(&problems);
    if (ceduo_document_unsaved(d))
        ceduo_document_keep(d);
    else
        ceduo_document_forget(d);
    return good;
}

bool ceduo_document_undo(struct document *d)
{
    return d->at > 0 && go_to(d, d->at - 1);
}

bool ceduo_document_redo(struct document *d)
{
    return d->at + 1 < d->count && go_to(d, d->at + 1);
}

bool ceduo_document_unsaved(const struct document *d)
{
    return d->count > 0 && d->at != d->saved;
}

/* ---- saving ---- */

/* A path to a file as it must be written in a scene that lies at `to`: as it is where it leads to the same file from
 * there, otherwise whole. It stays a path of the file that it was read from, wherever the scene was saved since. NULL
 * without memory. */
static const struct node *reference_from(struct document *d, const struct node *node, const char *folder, const char *to)
{
    const struct source *s = node->source;
    if (s && !s->is_option && strcmp(s->name, to) == 0)
        return node;
    struct arena found = {0};
    const char *now = ceduo_resolve_path(&found, node, folder);
    const char *then = now ? ceduo_file_find(&found, node->text, to, folder) : NULL;
    bool stays = !found.failed && (!now || (then && ceduo_file_same(now, then)));
    char *whole = found.failed || stays ? NULL : realpath(now, NULL);
    const struct node *scalar = whole ? ceduo_node_scalar(&d->file.arena, s, whole, false) : NULL;
    free(whole);
    ceduo_arena_free(&found);
    return stays ? node : scalar ? ceduo_node_renamed(&d->file.arena, scalar, node->key) : NULL;
}

/* All paths of an unresolved tree, for a scene that lies at `to`. */
static const struct node *references_from(struct document *d, const struct node *node, const char *to)
{
    static const char *const keys[][2] = {{"slope", "slopes"}, {"stand", "stands"}, {"base", "stands"}, {"csv", "slopes"}};
    for (size_t i = 0; i < 4 && node->kind == NODE_SCALAR && node->key; i++)
        if (strcmp(node->key, keys[i][0]) == 0)
            return reference_from(d, node, keys[i][1], to);
    const struct node *out = node;
    for (size_t i = 0; node->kind != NODE_SCALAR && out && i < node->n; i++) {
        const struct node *item = references_from(d, node->items[i], to);
        if (item != node->items[i])
            out = item ? ceduo_node_replaced(&d->file.arena, out, i, item) : NULL;
    }
    return out;
}

/* Whether the file is laid out as the program does it: then nothing is lost when that is done again. */
static bool has_own_layout(const struct node *raw)
{
    struct text text = {0};
    ceduo_emit(&text, raw);
    bool same = !text.failed && text.length == raw->source->length &&
                memcmp(text.bytes, raw->source->bytes, text.length) == 0;
    ceduo_text_free(&text);
    return same;
}

static bool fill_text(struct document *d, const char *to, struct text *text, bool *laid_out_anew)
{
    const struct node *root = ceduo_emit_unresolve(&d->file.arena, d->file.root);
    root = root && to ? references_from(d, root, to) : root;
    *laid_out_anew = false;
    if (!root)
        return false;
    (void)ceduo_text_lost(); /* what was shown before does not matter */
    if (!d->raw || !ceduo_emit_patched(text, d->raw->source, d->raw, root)) {
        *laid_out_anew = d->raw && !has_own_layout(d->raw);
        ceduo_emit(text, root);
    }
    return !text->failed && !ceduo_text_lost();
}

void ceduo_document_text(struct document *d, struct text *text)
{
    bool anew;
    if (!fill_text(d, d->path ? d->path : d->recovery, text, &anew))
        text->failed = true;
}

bool ceduo_document_changed_on_disk(const struct document *d)
{
    struct stat st;
    if (!d->path || d->modified.tv_sec == 0)
        return false;
    if (stat(d->path, &st) != 0)
        return errno == ENOENT;
    return st.st_size != d->size || st.st_mtim.tv_sec != d->modified.tv_sec ||
           st.st_mtim.tv_nsec != d->modified.tv_nsec;
}

static bool keep_backup(const struct document *d, const char *path)
{
    struct text backup = {0};
    put_backup(&backup, path);
    bool good = !backup.failed && ceduo_file_write(backup.bytes, d->raw->source->bytes, d->raw->source->length);
    ceduo_text_free(&backup);
    return good;
}

bool ceduo_document_save(struct document *d, const char *path, bool *laid_out_anew)
{
    struct text text = {0};
    bool good = fill_text(d, path, &text, laid_out_anew);
    if (!good)
        errno = ENOMEM;
    bool same = d->path && strcmp(path, d->path) == 0;
    if (good && *laid_out_anew && same)
        good = keep_backup(d, path);
    good = good && ceduo_file_write(path, text.bytes, text.length);
    int why = errno;
    if (good) {
        /* from now on this text is what lies on disk */
        struct problems problems = {0};
        char *copy = strdup(path);
        const struct node *raw = parse(d, path, text.bytes, &problems);
        if (raw && copy) {
            free(d->path);
            d->path = copy;
            d->raw = raw;
            d->shipped = false;
        } else {
            free(copy);
        }
        ceduo_problems_free(&problems);
        d->saved = d->at;
        note_disk(d);
        ceduo_document_forget(d);
        if (d->recovery && !same) { /* what is unsaved from now on is this file's */
            free(d->recovery);
            d->recovery = ceduo_recovery_path(d->path);
        }
    }
    ceduo_text_free(&text);
    errno = why;
    return good;
}

/* ---- recovery ---- */

void ceduo_document_keep(struct document *d)
{
    struct text text = {0};
    if (!d->recovery)
        return;
    ceduo_document_text(d, &text);
    if (!text.failed && text.bytes)
        ceduo_recovery_write(d->recovery, d->path, text.bytes, text.length);
    ceduo_text_free(&text);
}

void ceduo_document_forget(struct document *d)
{
    if (d->recovery)
        unlink(d->recovery);
}

char *ceduo_document_left_behind(const char *path, char **file)
{
    return ceduo_recovery_find(path, file);
}

bool ceduo_document_recover(struct document *d, const char *text, struct problems *problems)
{
    const struct node *root = parse(d, d->path ? d->path : "recovered", text, problems);
    return root && commit(d, root, _("recovered work"), problems);
}
