/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edits. Each makes a changed tree, which shares all nodes off the path of the change, and commits it as a new state. Rows
 * of `uncertainty` name values by path; their paths follow a value that moves or is copied. */
#include "document.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"

/* ---- an edit under way ---- */

struct edit {
    struct document *d;
    struct arena *arena;
    const struct node *root; /* changed tree; NULL: the edit has failed */
};

static struct edit begin_edit(struct document *d)
{
    ceduo_problems_free(&d->problems);
    return (struct edit){d, &d->file.arena, d->file.root};
}

static bool commit_edit(const struct edit *e, const char *edit_name)
{
    return e->root && ceduo_document_commit(e->d, e->root, edit_name);
}

const struct node *ceduo_document_node(const struct document *d, const char *path)
{
    return ceduo_resolve_at(d->file.root, path);
}

double ceduo_document_read_place(const struct document *d, const char *written)
{
    const struct ceduo_slope *s = &d->file.scene.slope;
    double value;
    if (written && ceduo_schema_place_read(written, &value))
        return s->origin_x + s->x[s->vertices - 1] - value;
    return written && ceduo_number_read(written, &value) == CEDUO_NUMBER_GOOD ? value : NAN;
}

double ceduo_document_get_place(const struct document *d, const char *path)
{
    const struct node *node = ceduo_document_node(d, path);
    return node && node->kind == NODE_SCALAR ? ceduo_document_read_place(d, node->text) : NAN;
}

/* Replace the node at a path. */
static void replace_node(struct edit *e, const char *path, const struct node *value)
{
    const struct source *source = ceduo_source_copy(e->arena, (struct source){.name = path, .bytes = path, .is_option = true});
    bool good = e->root && value;
    e->root = good ? ceduo_resolve_set(e->arena, e->root, source, source->length, value, &e->d->problems) : NULL;
}

/* ---- rows of uncertainty ---- */

/* Return the new path for one path of a row: unchanged, another one, several separated by blanks, or NULL to remove it. `only`:
 * the row has no other path. */
typedef const char *path_change(struct arena *arena, const char *path, bool only, const void *context);

/* Append paths to others, unless they are there already. */
static void append_paths(struct arena *arena, struct text *to, const char *paths)
{
    size_t n, m;
    for (const char *rest = paths, *path; (path = ceduo_paths_next(&rest, &n));) {
        bool added = false;
        for (const char *row = ceduo_text_string(to), *next; (next = ceduo_paths_next(&row, &m));)
            added |= n == m && memcmp(path, next, n) == 0;
        if (!added)
            ceduo_text_format(to, "%s%s", to->length > 0 ? " " : "", ceduo_arena_copy(arena, path, n));
    }
}

/* Return the paths of a row, each changed; NULL: none is left. */
static const char *change_row(struct arena *arena, const char *paths, path_change *change, const void *context)
{
    LOCAL_TEXT(all);
    size_t n, count = 0;
    for (const char *rest = paths; ceduo_paths_next(&rest, &n);)
        count++;
    for (const char *rest = paths, *path; (path = ceduo_paths_next(&rest, &n));) {
        const char *changed = change(arena, ceduo_arena_copy(arena, path, n), count == 1, context);
        if (changed)
            append_paths(arena, &all, changed);
    }
    return strcmp(ceduo_text_string(&all), paths) == 0 ? paths : all.length > 0 ? ceduo_arena_string(arena, all.bytes) : NULL;
}

/* Change the paths of all rows. `root`: a scene, or a stand. */
static const struct node *change_paths(struct arena *arena, const struct node *root, path_change *change, const void *context)
{
    const struct node *uncertainty = ceduo_node_get(root, "uncertainty");
    bool draws = uncertainty && uncertainty->kind == NODE_MAP; /* a calibration, whose rows are below */
    const struct node *rows = draws ? ceduo_node_get(uncertainty, "rows") : uncertainty, *now = rows;
    if (!rows || rows->kind != NODE_LIST)
        return root;
    for (size_t i = rows->n; i-- > 0;) {
        const struct node *row = rows->items[i];
        const char *path = ceduo_node_text(row, "path"), *changed = path ? change_row(arena, path, change, context) : path;
        if (path && !changed)
            now = ceduo_node_removed(arena, now, i);
        else if (changed != path)
            now = ceduo_node_replaced(
                arena, now, i, ceduo_node_with(arena, row, "path", ceduo_node_scalar(arena, row->source, changed, true)));
    }
    if (now == rows)
        return root;
    if (draws)
        now = now->n == 0 ? ceduo_node_without(arena, uncertainty, "rows") : ceduo_node_with(arena, uncertainty, "rows", now);
    return now->n == 0 ? ceduo_node_without(arena, root, "uncertainty") : ceduo_node_with(arena, root, "uncertainty", now);
}

/* Return the rest of a path below a list; NULL: it leads elsewhere. The path may name items of the list's path, or have [*] for
 * one; *star: the first [*]; NULL: none. */
static const char *find_below_list(const struct node *root, const char *path, const char *list, const char **star)
{
    size_t length = strlen(list), pos = 0, end = 0, index, item;
    struct path_step step, own;
    *star = NULL;
    for (size_t before = 0; ceduo_path_next(list, length, &pos, &own); before = pos) {
        if (!ceduo_path_next(path, strlen(path), &end, &step) || step.bracket != own.bracket)
            return NULL;
        bool same = step.n == own.n && memcmp(step.p, own.p, own.n) == 0;
        if (!same && step.bracket && ceduo_path_is(&step, "*")) {
            *star = *star ? *star : step.p - 1;
        } else if (!same) {
            LOCAL_TEXT(holder);
            ceduo_text_append_n(&holder, list, before);
            const struct node *items = step.bracket ? ceduo_resolve_at(root, ceduo_text_string(&holder)) : NULL;
            if (!items || !ceduo_path_index(&own, &index) || !ceduo_resolve_item(items, &step, &item) || item != index)
                return NULL;
        }
    }
    return path + end;
}

/* Read the first step of a path below a list. True if it is an item, by index or name; sets its position, and *rest to the text
 * after it. */
static bool read_item(const struct node *root, const char *list, const char *below, size_t *position, bool *named,
                      const char **rest)
{
    struct path_step step;
    size_t end = 0;
    const struct node *items = ceduo_resolve_at(root, list);
    if (!ceduo_path_next(below, strlen(below), &end, &step) || !step.bracket || ceduo_path_is(&step, "*"))
        return false;
    *rest = below + end;
    *named = !ceduo_path_index(&step, position);
    return !*named || (items && items->kind == NODE_LIST && ceduo_resolve_item(items, &step, position));
}

/* An item of a list was inserted before `from` (1), removed (-1), or moved to `to` (0). */
struct shift {
    const struct node *before; /* scene, or stand, before the change */
    const char *list;
    size_t from, to;
    int delta;
};

/* A path with [*] for an item above the list gets a path for each of these items, because only one list has changed. */
static const char *shift_path(struct arena *arena, const char *path, bool only, const void *context)
{
    const struct shift *s = context;
    const char *star, *rest, *below = find_below_list(s->before, path, s->list, &star);
    size_t position, now;
    bool named;
    if (!below || !read_item(s->before, s->list, below, &position, &named, &rest))
        return path;
    bool removed = s->delta < 0 && position == s->from;
    now = position;
    if (s->delta != 0)
        now = position < s->from ? position : s->delta < 0 ? position - 1 : position + 1;
    else if (position == s->from)
        now = s->to;
    else if (position >= (s->from < s->to ? s->from : s->to) && position <= (s->from < s->to ? s->to : s->from))
        now = s->from < s->to ? position - 1 : position + 1;
    if (named) /* a single path stays for the next item with this name */
        return removed && !only ? NULL : path;
    if (now == position && !removed)
        return path;
    if (!star)
        return removed ? NULL : ceduo_arena_format(arena, "%.*s[%zu]%s", (int)(below - path), path, now, rest);
    LOCAL_TEXT(all);
    const char *above = ceduo_arena_copy(arena, path, (size_t)(star - path));
    const struct node *items = ceduo_resolve_at(s->before, above);
    for (size_t i = 0; items && i < items->n; i++) {
        const char *one = shift_path(arena, ceduo_arena_format(arena, "%s[%zu]%s", above, i, star + strlen("[*]")), false, s);
        append_paths(arena, &all, one ? one : "");
    }
    return all.length > 0 ? ceduo_arena_string(arena, all.bytes) : NULL;
}

/* Adjust rows about the items of a list, in the scene and in the stand of the list. `before`: the scene before the change.
 * Without rows left, write "none": the file of the stand may have rows. */
static void shift_uncertainties(struct edit *e, const struct node *before, const char *list, size_t from, size_t to, int delta)
{
    const char *in_stand = strstr(list, ".stand.");
    if (!e->root)
        return;
    e->root = change_paths(e->arena, e->root, shift_path, &(struct shift){before, list, from, to, delta});
    const char *path = in_stand ? ceduo_arena_copy(e->arena, list, (size_t)(in_stand - list) + strlen(".stand")) : NULL;
    const struct node *stand = path ? ceduo_resolve_at(e->root, path) : NULL;
    if (!stand)
        return;
    const struct node *now =
        change_paths(e->arena, stand, shift_path,
                     &(struct shift){ceduo_resolve_at(before, path), in_stand + strlen(".stand."), from, to, delta});
    if (now == stand)
        return;
    if (!ceduo_node_get(now, "uncertainty"))
        now = ceduo_node_with(e->arena, now, "uncertainty", ceduo_node_scalar(e->arena, stand->source, "none", false));
    ceduo_node_keep_text(now, stand);
    replace_node(e, path, now);
}

/* An item of a list and its copy. */
struct copied {
    const struct node *root;
    const char *list;
    size_t from, to;
};

static const char *copy_path(struct arena *arena, const char *path, bool only, const void *context)
{
    const struct copied *c = context;
    const char *star, *rest, *below = find_below_list(c->root, path, c->list, &star);
    size_t position;
    bool named;
    (void)only;
    if (!below || !read_item(c->root, c->list, below, &position, &named, &rest) || position != c->from)
        return path;
    return ceduo_arena_format(arena, "%s %s[%zu]%s", path, c->list, c->to, rest);
}

/* Let the rows about an item count for its copy, too: the stems or the ground are the same, so the input is the same. */
static void copy_uncertainties(struct edit *e, const char *list, size_t from, size_t to)
{
    if (e->root)
        e->root = change_paths(e->arena, e->root, copy_path, &(struct copied){e->root, list, from, to});
}

/* The scene before and after a value was set. */
struct values {
    const struct node *before, *now;
};

static const char *drop_changed(struct arena *arena, const char *path, bool only, const void *context)
{
    const struct values *v = context;
    (void)arena;
    bool one = !only && !strstr(path, "[*]");
    return one && !ceduo_node_equal(ceduo_resolve_at(v->before, path), ceduo_resolve_at(v->now, path)) ? NULL : path;
}

/* Remove the path of a changed value from rows with several paths, whose values are no longer the same. */
static void drop_changed_values(struct edit *e, const struct node *before)
{
    if (e->root)
        e->root = change_paths(e->arena, e->root, drop_changed, &(struct values){before, e->root});
}

/* A new prefix for paths: the number of an option for its name, or an option for the forest. */
struct prefix_change {
    const char *from, *to;
};

static const char *change_prefix(struct arena *arena, const char *path, bool only, const void *context)
{
    const struct prefix_change *b = context;
    size_t n = strlen(b->from);
    (void)only;
    return strncmp(path, b->from, n) == 0 ? ceduo_arena_format(arena, "%s%s", b->to, path + n) : path;
}

/* ---- changes of a tree ---- */

/* Remove an entry or an item, also its list if it becomes empty, except options. Set `*path` to what was removed. */
static void remove_entry(struct edit *e, const char **path)
{
    const char *dot = strrchr(*path, '.'), *bracket = strrchr(*path, '[');
    const char *cut = bracket && (!dot || bracket > dot) ? bracket : dot, *last = cut ? cut + 1 : *path;
    const char *parent = ceduo_arena_copy(e->arena, *path, cut ? (size_t)(cut - *path) : 0);
    const struct node *holder = parent[0] ? ceduo_resolve_at(e->root, parent) : e->root, *reduced = NULL;
    const struct node *before = e->root;
    size_t index = strtoul(last, NULL, 10);
    bool list = holder && holder->kind == NODE_LIST;
    if (list && index < holder->n)
        reduced = ceduo_node_removed(e->arena, holder, index);
    else if (holder && holder->kind == NODE_MAP)
        reduced = ceduo_node_without(e->arena, holder, ceduo_arena_copy(e->arena, last, strcspn(last, "]")));
    if (list && reduced && reduced->n == 0 && strcmp(parent, "options") != 0) {
        *path = parent;
        shift_uncertainties(e, before, parent, index, 0, -1);
        remove_entry(e, path);
        return;
    }
    if (reduced)
        ceduo_node_keep_text(reduced, holder);
    if (parent[0])
        replace_node(e, parent, reduced);
    else
        e->root = reduced;
    if (list)
        shift_uncertainties(e, before, parent, index, 0, -1);
}

/* Insert an item into a list; create the list if it is missing. */
static void insert_item(struct edit *e, const char *list, size_t index, const struct node *item)
{
    const struct node *holder = ceduo_resolve_at(e->root, list);
    holder = holder ? holder : ceduo_document_parse(e->d, list, "[]");
    if (holder->kind != NODE_LIST || !item) {
        e->root = NULL;
        return;
    }
    index = index > holder->n ? holder->n : index;
    const struct node *before = e->root;
    replace_node(e, list, ceduo_node_inserted(e->arena, holder, index, ceduo_node_renamed(e->arena, item, NULL)));
    shift_uncertainties(e, before, list, index, 0, 1);
}

/* Insert a copy of item `from`, with its uncertainty. */
static void insert_copy(struct edit *e, const char *list, size_t from, size_t to, const struct node *item)
{
    insert_item(e, list, to, item);
    copy_uncertainties(e, list, from, to);
}

/* Apply changes whose paths are relative to `prefix`. */
static void apply_changes(struct edit *e, const char *prefix, const struct changes *changes)
{
    for (size_t i = 0; e->root && i < changes->n; i++) {
        const struct change *c = &changes->items[i];
        const char *path = ceduo_arena_format(e->arena, "%s%s", prefix, c->path);
        const struct node *old = ceduo_resolve_at(e->root, path);
        if (c->kind == CHANGE_DELETE) {
            if (old)
                remove_entry(e, &path);
            continue;
        }
        const struct node *value = ceduo_document_parse(e->d, path, c->value), *before = e->root;
        bool keeps = value && old && c->kind == CHANGE_KEEP_SOURCE;
        replace_node(e, path, keeps ? ceduo_node_scalar(e->arena, old->source, value->text, false) : value);
        drop_changed_values(e, before);
    }
}

void ceduo_changes_add(struct changes *c, enum change_kind kind, const char *path, const char *value)
{
    struct arena *arena = &c->document->file.arena;
    c->items = ceduo_check_memory(ceduo_arena_grow(arena, c->items, c->n, 1, &c->capacity, sizeof *c->items));
    c->items[c->n++] = (struct change){kind, ceduo_arena_string(arena, path), value ? ceduo_arena_string(arena, value) : NULL};
}

void ceduo_changes_set(struct changes *c, const char *path, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_changes_add(c, CHANGE_SET, path, ceduo_arena_vformat(&c->document->file.arena, format, args));
    va_end(args);
}

bool ceduo_changes_apply(const struct changes *c, const char *edit_name)
{
    struct edit e = begin_edit(c->document);
    apply_changes(&e, "", c);
    return commit_edit(&e, edit_name);
}

/* ---- values ---- */

bool ceduo_document_set(struct document *d, const char *path, const char *value)
{
    struct edit e = begin_edit(d);
    const struct node *before = e.root;
    replace_node(&e, path, ceduo_document_parse(d, path, value));
    drop_changed_values(&e, before);
    return commit_edit(&e, path);
}

bool ceduo_document_delete(struct document *d, const char *path)
{
    struct edit e = begin_edit(d);
    remove_entry(&e, &path);
    return commit_edit(&e, path);
}

/* ---- lists ---- */

static const struct node *with_name(const struct edit *e, const struct node *item, const char *name)
{
    item = ceduo_node_without(e->arena, item, "name_it");
    return ceduo_node_with(e->arena, item, "name", ceduo_node_scalar(e->arena, item->source, name, true));
}

bool ceduo_document_insert(struct document *d, const char *list, size_t index, const char *text)
{
    struct edit e = begin_edit(d);
    insert_item(&e, list, index, ceduo_document_parse(d, list, text));
    return commit_edit(&e, list);
}

/* Give a copy a unique name: increment its number, " (2)". A larger number is a year. */
static const struct node *with_new_name(struct edit *e, const struct node *list, const struct node *item)
{
    const char *given = ceduo_node_text(item, "name"), *name = ceduo_in_language(given, ceduo_node_text(item, "name_it"));
    const char *open = name ? strrchr(name, '(') : NULL, *own = name;
    size_t digits = open ? strspn(open + 1, "0123456789") : 0;
    bool copy = open && open > name + 1 && open[-1] == ' ' && digits > 0 && digits < 4 && strcmp(open + 1 + digits, ")") == 0;
    if (!name)
        return ceduo_node_without(e->arena, item, "name_it");
    int n = copy ? (int)(open - 1 - name) : (int)strlen(name);
    for (unsigned i = copy ? (unsigned)strtoul(open + 1, NULL, 10) : 1;;
         own = ceduo_arena_format(e->arena, "%.*s (%u)", n, name, ++i)) {
        bool in_use = false;
        for (size_t k = 0; k < list->n; k++) {
            const char *existing = ceduo_node_text(list->items[k], "name"),
                       *italian = ceduo_node_text(list->items[k], "name_it");
            in_use |= existing && (strcmp(existing, own) == 0 || strcmp(ceduo_in_language(existing, italian), own) == 0);
        }
        if (!in_use)
            return with_name(e, item, own);
    }
}

bool ceduo_document_move(struct document *d, const char *list, size_t from, size_t to)
{
    struct edit e = begin_edit(d);
    const struct node *holder = ceduo_document_node(d, list);
    if (!holder || holder->kind != NODE_LIST || from >= holder->n || to >= holder->n || from == to)
        return true;
    const struct node *reduced = ceduo_node_removed(e.arena, holder, from), *before = e.root;
    replace_node(&e, list, ceduo_node_inserted(e.arena, reduced, to, holder->items[from]));
    shift_uncertainties(&e, before, list, from, to, 0);
    return commit_edit(&e, list);
}

/* ---- the profile ---- */

static const char vertices_list[] = "slope.vertices_m", ground_list[] = "slope.segments";

bool ceduo_document_split_segment(struct document *d, size_t index, const char *vertex, bool split_ground)
{
    struct edit e = begin_edit(d);
    const struct node *vertices = ceduo_document_node(d, vertices_list), *grounds = ceduo_document_node(d, ground_list);
    insert_item(&e, vertices_list, index + 1, ceduo_document_parse(d, vertices_list, vertex));
    if (e.root && grounds && grounds->n > 1)
        insert_copy(&e, ground_list, index, index + 1, grounds->items[index]);
    for (size_t i = 1; e.root && grounds && grounds->n == 1 && vertices && split_ground && i < vertices->n; i++)
        insert_copy(&e, ground_list, 0, i, grounds->items[0]);
    return commit_edit(&e, vertices_list);
}

bool ceduo_document_remove_vertex(struct document *d, size_t vertex, size_t segment)
{
    const struct node *vertices = ceduo_document_node(d, vertices_list), *grounds = ceduo_document_node(d, ground_list);
    struct changes c = {.document = d};
    ceduo_problems_free(&d->problems);
    if (!vertices || vertices->n <= 2 || vertex >= vertices->n)
        return false;
    ceduo_changes_add(&c, CHANGE_DELETE, ceduo_arena_format(&d->file.arena, "%s[%zu]", vertices_list, vertex), NULL);
    if (grounds && grounds->n > 1)
        ceduo_changes_add(&c, CHANGE_DELETE, ceduo_arena_format(&d->file.arena, "%s[%zu]", ground_list, segment), NULL);
    return ceduo_changes_apply(&c, vertices_list);
}

/* ---- options ---- */

/* Return the list of options. A scene without options gets one, "current", with its forest. */
static const struct node *ensure_options(struct edit *e)
{
    const struct node *options = ceduo_node_get(e->root, "options"), *forest = ceduo_node_get(e->root, "forest");
    if (options)
        return options;
    const char *name = _("current");
    options = ceduo_document_parse(e->d, "options", "[{name: current}]");
    options = ceduo_node_replaced(e->arena, options, 0, with_name(e, options->items[0], name));
    if (forest)
        options = ceduo_node_replaced(e->arena, options, 0, ceduo_node_with(e->arena, options->items[0], "forest", forest));
    e->root = ceduo_node_without(e->arena, e->root, "forest");
    e->root = change_paths(e->arena, e->root, change_prefix, &(struct prefix_change){"forest[*]", "options[*].forest[*]"});
    e->root = change_paths(e->arena, e->root, change_prefix,
                           &(struct prefix_change){"forest[", ceduo_arena_format(e->arena, "options[%s].forest[", name)});
    e->root = ceduo_node_with(e->arena, e->root, "options", options);
    return options;
}

void ceduo_document_append_belts(const struct document *d, const char *stand, bool cut_years, struct text *yaml)
{
    const struct ceduo_scene *s = &d->file.scene;
    size_t n = s->options[0].belts_count;
    const struct ceduo_belt none = {.from_given = s->slope.origin_x, .to_given = s->controls->x_given, .cut_year = NAN};
    const struct ceduo_belt *belts = n > 0 ? s->options[0].belts : &none;
    for (size_t i = 0; i == 0 || i < n; i++) {
        ceduo_text_format(yaml, "%s{from_m: %.10g, to_m: %.10g, ", i ? ", " : "[", belts[i].from_given, belts[i].to_given);
        if (cut_years && !isnan(belts[i].cut_year))
            ceduo_text_format(yaml, "cut_year: %.10g, ", belts[i].cut_year);
        ceduo_text_append(yaml, "stand: ");
        ceduo_emit_scalar(yaml, stand, true);
        ceduo_text_append_char(yaml, '}');
    }
    ceduo_text_append_char(yaml, ']');
}

static bool append_option(struct document *d, const char *stand, const char *name, bool cut_years)
{
    struct edit e = begin_edit(d);
    LOCAL_TEXT(yaml);
    ceduo_text_append(&yaml, "{name: new, forest: ");
    ceduo_document_append_belts(d, stand, cut_years, &yaml);
    ceduo_text_append_char(&yaml, '}');
    const struct node *item = ceduo_document_parse(d, "options", yaml.bytes), *list = ensure_options(&e);
    insert_item(&e, "options", list->n, item ? with_new_name(&e, list, with_name(&e, item, name)) : NULL);
    return commit_edit(&e, stand);
}

bool ceduo_document_add_option(struct document *d, const char *stand, const char *name)
{
    return append_option(d, stand, name, true) || append_option(d, stand, name, false); /* a stand without cutting */
}

/* True for an item of the slope or the forest that ends at a place. */
static bool is_stretch(const struct node *item)
{
    return ceduo_node_get(item, "from_m") || ceduo_node_get(item, "to_m");
}

bool ceduo_document_duplicate(struct document *d, const char *list, size_t index, const struct changes *changes)
{
    struct edit e = begin_edit(d);
    bool options = strcmp(list, "options") == 0;
    const struct node *holder = options ? ensure_options(&e) : ceduo_document_node(d, list);
    const struct node *item = holder && holder->kind == NODE_LIST && index < holder->n ? holder->items[index] : NULL;
    const struct node *copy = item && options ? with_new_name(&e, holder, item) : item;
    if (options || is_stretch(copy))
        insert_copy(&e, list, index, index + 1, copy);
    else /* stems and rocks in addition to the others */
        insert_item(&e, list, index + 1, copy);
    if (changes)
        apply_changes(&e, "", changes);
    return commit_edit(&e, list);
}

bool ceduo_document_vary_option(struct document *d, size_t index, const char *name, const struct changes *changes)
{
    struct edit e = begin_edit(d);
    const struct node *options = ensure_options(&e), *item = options->items[index];
    insert_copy(&e, "options", index, options->n, with_new_name(&e, options, with_name(&e, item, name)));
    apply_changes(&e, ceduo_arena_format(e.arena, "options[%zu].", options->n), changes);
    return commit_edit(&e, name);
}

/* Return a node in which each `option: old` is `name`. */
static const struct node *with_option_named(struct arena *arena, const struct node *node, const char *old,
                                            const struct node *name)
{
    for (size_t i = 0; node->kind != NODE_SCALAR && i < node->n; i++) {
        const struct node *item = node->items[i];
        bool same = item->kind == NODE_SCALAR && item->key && strcmp(item->key, "option") == 0 && strcmp(item->text, old) == 0;
        const struct node *now = same ? ceduo_node_renamed(arena, name, "option") : with_option_named(arena, item, old, name);
        if (now != item)
            node = ceduo_node_replaced(arena, node, i, now);
    }
    return node;
}

bool ceduo_document_rename_option(struct document *d, size_t index, const char *name)
{
    struct edit e = begin_edit(d);
    const struct node *list = ceduo_node_get(e.root, "options"), *observed = ceduo_node_get(e.root, "observed");
    if (!list || index >= list->n)
        return false;
    const char *old = ceduo_node_text(list->items[index], "name");
    const struct node *item = with_name(&e, list->items[index], name), *scalar = ceduo_node_get(item, "name");
    e.root = ceduo_node_with(e.arena, e.root, "options", ceduo_node_replaced(e.arena, list, index, item));
    if (old)
        e.root = change_paths(e.arena, e.root, change_prefix,
                              &(struct prefix_change){ceduo_arena_format(e.arena, "options[%s]", old),
                                                      ceduo_arena_format(e.arena, "options[%zu]", index)});
    if (old && observed)
        e.root = ceduo_node_with(e.arena, e.root, "observed", with_option_named(e.arena, observed, old, scalar));
    return commit_edit(&e, "options");
}
