/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Resolves references: a reference is replaced by the tree of its file, which keeps the original node in `written`. A stand is
 * merged over its base. Then paths: finding a node, and setting a value, which copies the nodes from the root to it. All nodes
 * are in the caller's arena. A returned node never changes. */
#include "bind.h"
#include "scene/material.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "file.h"
#include "scene/choices.h"
#include "scene/schema.h"

#define FIRST     "-1e9" /* m: before the begin of any profile */
#define BASES_MAX 8
#define FILES_MAX 1000

/* Cache of files already read: a thousand belts may name one stand. */
struct known_file {
    const char *path;
    const struct node *root; /* NULL: unreadable, already reported */
    const struct known_file *before;
};

struct resolver {
    struct arena *arena;
    struct problems *problems;
    const struct known_file *files;
    size_t files_count;
    /* only for a change: */
    const struct source *set; /* PATH=VALUE */
    size_t length;            /* of PATH */
    const struct node *value;
    bool source_done; /* the source around the value is marked, or need not be */
};

/* ---- files ---- */

/* Copy `found` to the place of the reference `place`. */
static struct node *replace_node(struct arena *arena, const struct node *found, const struct node *place)
{
    struct node *copy = ceduo_arena_alloc(arena, sizeof *copy);
    if (!copy)
        return NULL;
    *copy = *found;
    copy->key = place->key;
    copy->key_line = place->key_line;
    copy->key_column = place->key_column;
    copy->written = place;
    copy->followed = copy;
    return copy;
}

const char *ceduo_resolve_path(struct arena *arena, const struct node *node, const char *folder)
{
    const struct source *s = node->source;
    const char *path = ceduo_file_find(arena, node->text, s->is_option ? s->base_file : s->name, folder);
    if (!path && s->is_option)
        path = ceduo_file_find(arena, node->text, NULL, folder);
    return path;
}

static const struct node *load_reference(struct resolver *r, const struct object *object, const struct node *node, int depth);

/* Copy a node with an unreadable reference and mark it, so that the rest is still read. NULL on failure. */
static const struct node *copy_broken(struct resolver *r, const struct node *node)
{
    struct node *copy = ceduo_arena_alloc(r->arena, sizeof *copy);
    if (copy) {
        *copy = *node;
        copy->broken = true;
    }
    return copy;
}

/* Remove the translation of a replaced text from a mapping, unless `changes` (may be NULL) has a new one. NULL on failure. */
static const struct node *without_translation(struct arena *arena, const struct node *map, const char *key,
                                              const struct node *changes)
{
    LOCAL_TEXT(name);
    ceduo_text_format(&name, "%s_it", key);
    return ceduo_node_get(changes, ceduo_text_string(&name)) ? map : ceduo_node_without(arena, map, ceduo_text_string(&name));
}

/* Merge the entries of `changes` into `base`. Mappings are merged, other values replaced. */
static const struct node *merge(struct arena *arena, const struct node *base, const struct node *changes)
{
    const struct node *merged = base;
    for (size_t i = 0; merged && i < changes->n; i++) {
        const struct node *entry = changes->items[i], *old = ceduo_node_get(merged, entry->key);
        if (strcmp(entry->key, "base") == 0)
            continue;
        if (old && old->kind == NODE_MAP && entry->kind == NODE_MAP)
            entry = merge(arena, old, entry);
        else if (old)
            merged = without_translation(arena, merged, entry->key, changes);
        merged = entry ? ceduo_node_with(arena, merged, entry->key, entry) : NULL;
    }
    return merged;
}

static const struct node *merge_base(struct resolver *r, const struct object *object, const struct node *node, int depth)
{
    const struct node *base = ceduo_node_get(node, "base");
    if (!base || object != ceduo_schema_stand())
        return node;
    if (base->kind != NODE_SCALAR) {
        ceduo_problem_at(r->problems, ceduo_node_place(base, "base"), _("expected a path to a file"));
        return copy_broken(r, node);
    }
    const struct node *below = load_reference(r, object, base, depth + 1);
    if (!below)
        return copy_broken(r, node);
    if (below->kind != NODE_MAP) /* ceduo_bind() reports it */
        return replace_node(r->arena, below, node);
    const struct node *merged = merge(r->arena, below, node);
    struct node *placed = merged ? replace_node(r->arena, merged, node) : NULL;
    if (placed) { /* report problems at the reference, not in the file of the base */
        placed->source = node->source;
        placed->line = node->line;
        placed->column = node->column;
    }
    return placed;
}

/* Read the document in a file, at most once. */
static const struct node *read_file(struct resolver *r, const struct node *node, const char *path)
{
    for (const struct known_file *f = r->files; f; f = f->before)
        if (strcmp(f->path, path) == 0) {
            r->problems->met += !f->root;
            return f->root;
        }
    if (r->files_count == FILES_MAX) {
        ceduo_problem_at(r->problems, ceduo_node_place(node, node->key), _("more than %d files in one scene"), FILES_MAX);
        return NULL;
    }
    struct known_file *file = ceduo_arena_alloc(r->arena, sizeof *file);
    if (!file)
        return NULL;
    const struct source *source = ceduo_file_read(r->arena, path, YAML_BYTES_MAX, r->problems);
    *file = (struct known_file){
        .path = path, .root = source ? ceduo_yaml_read(r->arena, source, r->problems) : NULL, .before = r->files};
    r->files = file;
    r->files_count++;
    return file->root;
}

static const struct node *load_reference(struct resolver *r, const struct object *object, const struct node *node, int depth)
{
    static const char *const tables[] = {".csv", ".gpx", ".kml",
                                         ".xml"}; /* the CSV reader explains how to convert the others */
    if (depth > BASES_MAX) {
        ceduo_problem_at(r->problems, ceduo_node_place(node, node->key),
                         _("more than %d files in a chain of 'base'; do they form a loop?"), BASES_MAX);
        return NULL;
    }
    if (node->kind != NODE_SCALAR)
        return merge_base(r, object, node, depth);
    const char *end = strrchr(node->text, '.');
    for (size_t i = 0; end && object == ceduo_schema_slope() && i < sizeof tables / sizeof tables[0]; i++)
        if (strcasecmp(end, tables[i]) == 0) { /* becomes {csv: FILE} */
            const struct node map = {.kind = NODE_MAP, .line = node->line, .column = node->column, .source = node->source};
            const struct node *filled = ceduo_node_with(r->arena, &map, "csv", node);
            return filled ? replace_node(r->arena, filled, node) : NULL;
        }
    if (end && strcmp(object->folder, "stands") == 0 && strcasecmp(end, ".csv") == 0) {
        ceduo_problem_at(r->problems, ceduo_node_place(node, node->key),
                         _("'%s' is a table; convert a survey to a stand with ceduo --survey %s -o FILE.yaml"), node->text,
                         node->text);
        return NULL;
    }
    const char *path = ceduo_resolve_path(r->arena, node, object->folder);
    if (!path)
        ceduo_problem_at(r->problems, ceduo_node_place(node, node->key),
                         _("cannot find '%s' next to this file or among the profiles (ceduo --list-profiles)"), node->text);
    const struct node *found = path ? read_file(r, node, path) : NULL;
    if (found && found->kind == NODE_MAP)
        found = merge_base(r, object, found, depth);
    return found ? replace_node(r->arena, found, node) : NULL;
}

static const struct node *resolve_map(struct resolver *r, const struct object *object, const struct node *map);

/* Resolve all references at and below the items of a list. The list is copied once, not for each item. */
static const struct node *resolve_items(struct resolver *r, const struct object *object, const struct node *list)
{
    bool copied = false;
    for (size_t i = 0; list && i < list->n; i++) {
        const struct node *item = list->items[i]->kind == NODE_MAP ? resolve_map(r, object, list->items[i]) : list->items[i];
        if (item == list->items[i])
            continue;
        if (copied && item)
            ((const struct node **)(uintptr_t)list->items)[i] = item;
        else
            list = ceduo_node_replaced(r->arena, list, i, item);
        copied = true;
    }
    return list;
}

/* Resolve all references at and below a mapping that `object` describes. NULL on failure. */
static const struct node *resolve_map(struct resolver *r, const struct object *object, const struct node *map)
{
    for (size_t i = 0; map && i < map->n; i++) {
        const struct node *entry = map->items[i], *found = entry;
        const struct field *f = ceduo_schema_field(object, entry->key);
        if (f && f->type == FIELD_GROUP && f->flags & FIELD_FOLLOWS) {
            found = load_reference(r, f->object, entry, 0);
            found = found ? found : copy_broken(r, entry);
        } else if (f && f->type == FIELD_LIST && entry->kind == NODE_LIST) {
            bool too_long = strcmp(f->key, "forest") == 0 && entry->n > CEDUO_ITEMS_MAX; /* before all its files are read */
            if (too_long)
                ceduo_problem_at(r->problems, ceduo_node_place(entry, f->key), _("%zu items; at most %d can be computed"),
                                 entry->n, CEDUO_ITEMS_MAX);
            found = too_long ? copy_broken(r, entry) : resolve_items(r, f->object, entry);
        }
        if (found == entry)
            continue;
        const struct node *replaced = ceduo_node_replaced(r->arena, map, i, found);
        if (replaced)
            ceduo_node_keep_text(replaced, map);
        map = replaced;
    }
    return map;
}

const struct node *ceduo_resolve_scene(struct arena *arena, const struct node *root, struct problems *problems)
{
    struct resolver r = {.arena = arena, .problems = problems};
    return root->kind == NODE_MAP ? resolve_map(&r, ceduo_schema_scene(), root) : root;
}

/* ---- paths ---- */

/* Return the name of an item. A belt has the name of its stand, a stretch of ground that of its material. NULL: none. */
static const char *find_name(const struct node *item)
{
    const char *name = ceduo_node_text(item, "name"), *ground = ceduo_node_text(item, "material");
    return name ? name : ground ? ground : ceduo_node_text(ceduo_node_get(item, "stand"), "name");
}

/* Return the index of the ground of the library that a step names; -1: none. */
static int find_ground(const struct path_step *step)
{
    LOCAL_TEXT(name);
    ceduo_text_append_n(&name, step->p, step->n);
    return step->bracket ? ceduo_choice_find(&ceduo_material_words, ceduo_text_string(&name)) : -1;
}

/* True if a step selects an item: [*] selects all, [GROUND] all stretches of a ground. */
static bool matches(const struct path_step *step, const struct object *object, const struct node *item)
{
    const char *ground = object && ceduo_schema_field(object, "material") ? ceduo_node_text(item, "material") : NULL;
    int known = ground ? ceduo_choice_find(&ceduo_material_words, ground) : -1;
    return ceduo_path_is(step, "*") || (known >= 0 && known == find_ground(step));
}

bool ceduo_resolve_item(const struct node *list, const struct path_step *step, size_t *index)
{
    if (ceduo_path_index(step, index))
        return *index < list->n;
    for (*index = 0; *index < list->n; ++*index)
        if (ceduo_path_is(step, find_name(list->items[*index])))
            return true;
    return false;
}

const struct node *ceduo_resolve_walk(const struct node *root, const char *path, const char **file_path, size_t *used)
{
    size_t offset = 0, length = strlen(path);
    struct path_step step;
    *file_path = path;
    *used = 0;
    while (ceduo_path_next(path, length, &offset, &step)) {
        const struct node *next = NULL;
        size_t i;
        if (step.bracket && root->kind == NODE_LIST && ceduo_resolve_item(root, &step, &i))
            next = root->items[i];
        for (i = 0; !step.bracket && root->kind == NODE_MAP && i < root->n; i++)
            if (ceduo_path_is(&step, root->items[i]->key))
                next = root->items[i];
        if (!next)
            break;
        root = next;
        *used = offset;
        if (root->kind == NODE_MAP && root->written && root->written->kind == NODE_SCALAR)
            *file_path = path[offset] == '.' ? path + offset + 1 : path + offset;
    }
    return root;
}

const struct node *ceduo_resolve_at(const struct node *root, const char *path)
{
    const char *file_path;
    size_t used = 0;
    const struct node *node = root ? ceduo_resolve_walk(root, path, &file_path, &used) : NULL;
    return path[used] == '\0' ? node : NULL;
}

/* ---- changing ---- */

static const struct node *set_in(struct resolver *s, const struct field *f, const struct object *object,
                                 const struct node *node, size_t offset);

static const struct node *fail_at(struct resolver *s, const struct path_step *step, const char *problem)
{
    LOCAL_TEXT(word);
    ceduo_text_append_n(&word, step->p, step->n);
    ceduo_problem(s->problems, s->set, 1, (size_t)(step->p - s->set->bytes) + 1, "'%s': %s", ceduo_text_string(&word), problem);
    return NULL;
}

/* Add the path of a changed value to `except` of the nearest `source`. Stop the path at a list index, because indices
 * change. */
static const struct node *mark_source(struct resolver *s, const struct node *map, const struct path_step *step)
{
    const struct node *source = ceduo_node_get(map, "source"), *list = ceduo_node_get(source, "except");
    if (s->source_done || !source)
        return map;
    s->source_done = true;
    if (source->kind != NODE_MAP || (list && list->kind != NODE_LIST))
        return map; /* checked later */
    size_t n = 0, max = s->length - (size_t)(step->p - s->set->bytes);
    while (n < max && step->p[n] != '[')
        n++;
    const struct path_step path = {step->p, n, false};
    for (size_t i = 0; list && i < list->n; i++)
        if (list->items[i]->kind == NODE_SCALAR && ceduo_path_is(&path, list->items[i]->text))
            return map;
    list = list ? list : ceduo_node_empty(s->arena, NODE_LIST, source->source);
    char *text = ceduo_arena_copy(s->arena, step->p, n);
    const struct node *item = text ? ceduo_node_scalar(s->arena, s->set, text, false) : NULL;
    list = list && item ? ceduo_node_inserted(s->arena, list, list->n, item) : NULL;
    source = list ? ceduo_node_with(s->arena, source, "except", list) : NULL;
    return source ? ceduo_node_with(s->arena, map, "source", source) : NULL;
}

/* True if a change does not affect the source: the value is equal or only moved, or is a name, a source or a setting of the
 * simulation. */
static bool keeps_source(const struct resolver *s, const struct field *f, const char *key, const struct node *old)
{
    struct node before = old ? *old : (struct node){0}, now = *s->value;
    before.key = now.key = NULL;
    return strcmp(key, "source") == 0 || strcmp(key, "simulation") == 0 || (f && f->type <= FIELD_TEXT) ||
           !now.source->is_option || (old && ceduo_node_equal(&before, &now));
}

/* True if the next step of the path names the assumed ground. */
static bool names_assumed_ground(const struct resolver *s, size_t offset)
{
    struct path_step step;
    int known = ceduo_path_next(s->set->bytes, s->length, &offset, &step) ? find_ground(&step) : -1;
    return known >= 0 && strcmp(ceduo_material_words.names[known], ceduo_material_talus()->name) == 0;
}

/* Return the assumed ground as a list; NULL on failure. */
static const struct node *make_assumed_ground(struct resolver *s)
{
    const struct ceduo_material *talus = ceduo_material_talus();
    const char *const entries[][2] = {{"from_m", FIRST}, {"to_m", "end"}, {"material", talus->name}};
    const struct node *row = ceduo_node_empty(s->arena, NODE_MAP, s->set),
                      *list = ceduo_node_empty(s->arena, NODE_LIST, s->set);
    /* untaken: memory */
    for (size_t i = 0; row && i < sizeof entries / sizeof entries[0]; i++) {
        const struct node *value = ceduo_node_scalar(s->arena, s->set, entries[i][1], false);
        row = value ? ceduo_node_with(s->arena, row, entries[i][0], value) : NULL; /* untaken: memory */
    }
    return row && list ? ceduo_node_inserted(s->arena, list, 0, row) : NULL; /* untaken 2: memory */
}

static const struct node *set_entry(struct resolver *s, const struct object *object, const struct node *map,
                                    const struct path_step *step, size_t offset)
{
    char key[64];
    if (step->n >= sizeof key)
        return fail_at(s, step, _("unknown key"));
    memcpy(key, step->p, step->n);
    key[step->n] = '\0';
    const struct field *f = object ? ceduo_schema_field(object, key) : NULL;
    if (f && step->p[step->n] == '[' && ceduo_schema_list(object, f))
        f = ceduo_schema_list(object, f);
    bool free_form = !object || strcmp(key, "source") == 0;
    const char *removed = object ? ceduo_removed_hint(key) : NULL;
    if (removed)
        return fail_at(s, step, _(removed));
    LOCAL_TEXT(message);
    if (!f && !free_form) {
        ceduo_bind_unknown_key(object, key, &message);
        return fail_at(s, step, ceduo_text_string(&message));
    }
    const struct node *child = ceduo_node_get(map, key);
    bool last = offset >= s->length;
    if (!last && f && f->flags & FIELD_FOLLOWS && child && !(child = load_reference(s, f->object, child, 0)))
        return NULL;
    if (!last && f && f->type == FIELD_SPREAD && (!child || child->kind == NODE_SCALAR)) {
        const struct node *parts = ceduo_node_empty(s->arena, NODE_MAP, s->set); /* a number becomes {mean: number} */
        child = parts && child ? ceduo_node_with(s->arena, parts, "mean", child) : parts;
    } else if (!last && !child && f && f->object && ceduo_schema_field(f->object, "material") &&
               !ceduo_node_get(map, "segments") && names_assumed_ground(s, offset))
        child = make_assumed_ground(s);
    else if (!last && !child && (!f || f->type == FIELD_GROUP))
        child = ceduo_node_empty(s->arena, NODE_MAP, s->set);
    else if (!last && !child) {
        bool root = step->p == s->set->bytes;
        if (root && strcmp(key, "forest") == 0 && ceduo_node_get(map, "options"))
            ceduo_problem(s->problems, s->set, 1, 1, _("this scene has options; write options[0].%.*s, or a name instead of 0"),
                          (int)s->length, step->p);
        else
            ceduo_problem(s->problems, s->set, 1, (size_t)(step->p - s->set->bytes) + 1, _("there is no '%s' here"), key);
    }
    if (!last && !child)
        return NULL;
    s->source_done |= keeps_source(s, f, key, last ? child : NULL);
    child = set_in(s, f, f && f->type == FIELD_GROUP ? f->object : NULL, child, offset);
    map = child ? mark_source(s, map, step) : NULL;
    const char *rival = f && f->type == FIELD_NUMBER ? ceduo_schema_alternative(object, key) : NULL;
    if (map && rival)
        map = ceduo_node_without(s->arena, map, rival);
    map = map && last ? without_translation(s->arena, map, key, NULL) : map;
    return map ? ceduo_node_with(s->arena, map, key, child) : NULL;
}

#define ITEMS_SHOWN 12

static const struct node *set_item(struct resolver *s, const struct field *f, const struct node *list,
                                   const struct path_step *step, size_t offset)
{
    const struct object *object = f && f->type == FIELD_LIST ? f->object : NULL;
    size_t first, index, n = 0;
    LOCAL_TEXT(items);
    LOCAL_TEXT(message);
    /* a belt has the name of its stand: load it first */
    if (object && !(list = resolve_items(s, object, list)))
        return NULL;
    while (n < list->n && !matches(step, object, list->items[n]))
        n++;
    if (n < list->n) { /* mark the source around the list unless each item has one */
        bool before = s->source_done, all_marked = true;
        for (size_t i = n; list && i < list->n; i++) {
            if (!matches(step, object, list->items[i]))
                continue;
            s->source_done = before;
            list = ceduo_node_replaced(s->arena, list, i, set_in(s, NULL, object, list->items[i], offset));
            all_marked &= s->source_done;
        }
        s->source_done = all_marked;
        return list;
    }
    n = 0;
    if (!ceduo_resolve_item(list, step, &first)) {
        for (size_t i = 0; i < list->n && i < ITEMS_SHOWN; i++) {
            const char *name = find_name(list->items[i]);
            ceduo_text_format(&items, "%s[%zu]%s%s", i > 0 ? ", " : "", i, name ? " " : "", name ? name : "");
        }
        ceduo_text_append(&items, list->n > ITEMS_SHOWN ? ", \xe2\x80\xa6" : "");
        ceduo_text_format(&message, _("no such item; there are: %s"), ceduo_text_string(&items));
        return fail_at(s, step, list->n > 0 ? ceduo_text_string(&message) : _("the list is empty"));
    }
    for (size_t i = first; i < list->n && !ceduo_path_index(step, &index); i++)
        if (ceduo_path_is(step, find_name(list->items[i])))
            ceduo_text_format(&items, "%s[%zu]", n++ > 0 ? ", " : "", i);
    ceduo_text_format(&message, _("several items have this name; use one of: %s"), ceduo_text_string(&items));
    if (n > 1)
        return fail_at(s, step, ceduo_text_string(&message));
    return ceduo_node_replaced(s->arena, list, first, set_in(s, NULL, object, list->items[first], offset));
}

/* Return a copy of the node with the value set along the path from byte `at` on. A resolved reference stays marked. */
static const struct node *set_in(struct resolver *s, const struct field *f, const struct object *object,
                                 const struct node *node, size_t offset)
{
    if (offset >= s->length)
        return s->value;
    struct path_step step;
    size_t from = offset;
    if (!ceduo_path_next(s->set->bytes, s->length, &offset, &step)) {
        ceduo_problem(s->problems, s->set, 1, from + 1, _("malformed path; keys are joined by '.', items are [0] or [name]"));
        return NULL;
    }
    if (step.bracket && node->kind != NODE_LIST)
        return fail_at(s, &step, _("there is no list here"));
    if (!step.bracket && node->kind != NODE_MAP)
        return fail_at(s, &step, _("there is no mapping here"));
    const struct node *changed = step.bracket ? set_item(s, f, node, &step, offset) : set_entry(s, object, node, &step, offset);
    if (!changed)
        return NULL;
    ceduo_node_keep_text(changed, node);
    return changed;
}

const struct node *ceduo_resolve_set(struct arena *arena, const struct node *root, const struct source *set, size_t path_length,
                                     const struct node *value, struct problems *problems)
{
    struct resolver s = {.arena = arena, .set = set, .length = path_length, .value = value, .problems = problems};
    return set_in(&s, NULL, ceduo_schema_scene(), root, 0);
}
