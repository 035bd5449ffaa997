/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uncertain inputs of a scene and its stands: each row of `uncertainty` becomes an input with its places. Calibration draws are
 * one more input, from a table with a column for each fitted value. The head of a column is a path, or several separated by
 * blanks. A row of the table is one joint draw of all values. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "csv.h"
#include "file.h"
#include "scene/value.h"
#include "scene_file.h"
#include "study/inputs.h"
#include "validator.h"

/* A row of `uncertainty`. */
struct row {
    struct uncertainty_row uncertainty;
    const char *path;        /* of the row in the scene */
    const char *prefix;      /* of the paths in the row: "", or the path of a stand and a dot */
    const struct node *list; /* list of the stand; NULL: row of the scene */
    size_t index;            /* in the list */
    bool done;
};

/* Compare structs by the string that is their first member. */
static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* ---- places ---- */

struct places {
    struct validator *v;
    const char **items;
    size_t n, capacity;
};

/* Return the list at a path; NULL: none. */
static const struct node *find_list(const struct node *root, const char *path)
{
    const struct node *node = ceduo_resolve_at(root, path);
    return node && node->kind == NODE_LIST ? node : NULL;
}

/* Replace the names of items in a path by their indices, so that each place has one path. */
static const char *replace_names(struct validator *v, const char *path)
{
    struct path_step step;
    size_t offset = 0, index;
    while (ceduo_path_next(path, strlen(path), &offset, &step)) {
        if (!step.bracket || ceduo_path_index(&step, &index))
            continue;
        int before = (int)(step.p - path);
        const struct node *list = find_list(v->root, ceduo_asprintf(v, "%.*s", before - 1, path));
        if (list && ceduo_resolve_item(list, &step, &index))
            return replace_names(v, ceduo_asprintf(v, "%.*s%zu%s", before, path, index, step.p + step.n));
    }
    return path;
}

static void add_place(struct places *p, const char *path)
{
    const char **items = ceduo_arena_grow(p->v->arena, p->items, p->n, 1, &p->capacity, sizeof *items);
    if (!items)
        return;
    p->items = items;
    p->items[p->n++] = ceduo_asprintf(p->v, "%s", replace_names(p->v, path));
}

/* Add the path with [*] replaced by each item in turn. Return false if a list is missing or empty. */
static bool expand_path(struct places *p, const char *path)
{
    const char *star = strstr(path, "[*]");
    if (!star) {
        add_place(p, path);
        return true;
    }
    const char *before = ceduo_asprintf(p->v, "%.*s", (int)(star - path), path);
    const struct node *list = find_list(p->v->root, before);
    bool all = list && list->n > 0;
    for (size_t i = 0; list && i < list->n; i++)
        all &= expand_path(p, ceduo_asprintf(p->v, "%s[%zu]%s", before, i, star + 3));
    return all;
}

#define GROUND   "slope.materials["
#define SEGMENTS "slope.segments[*]."

/* Return the name in slope.materials[NAME].KEY and set *key; NULL: the path has another form. */
static const char *find_material(struct validator *v, const char *path, const char **key)
{
    const size_t before = sizeof GROUND - 1;
    const char *end = strchr(path, ']');
    if (strncmp(path, GROUND, before) != 0 || !end || end[1] != '.')
        return NULL;
    *key = end + 2;
    const char *name = ceduo_asprintf(v, "%.*s", (int)(end - path - (ptrdiff_t)before), path + before);
    int known = ceduo_choice_find(&ceduo_material_words, name);
    return known < 0 ? name : ceduo_material_words.names[known];
}

/* Translate the option of a path in the file to its index in the scene, which has only the options kept by --option. NULL: the
 * option was not kept. */
static const char *translate_option(struct validator *v, const char *path)
{
    const struct scene_file *file = v->file;
    size_t option, k = 0;
    if (!file->kept || sscanf(path, "options[%zu]", &option) != 1)
        return path;
    while (k < file->kept_count && file->kept[k] != option)
        k++;
    return k < file->kept_count ? ceduo_asprintf(v, "options[%zu%s", k, strchr(path, ']')) : NULL;
}

/* Add all places of a path in the scene. Ground without a list of segments has one place for each stretch. */
static void find_places(struct places *p, const char *path)
{
    struct validator *v = p->v;
    struct ceduo_scene *scene = &v->draft.scene;
    const char *key, *name = find_material(v, path, &key);
    struct value value;
    size_t n = p->n, stretches = scene->slope.vertices - 1;
    if (name && (p->items = ceduo_alloc(v, stretches, sizeof *p->items))) /* the first places of the list */
        p->n = ceduo_input_ground(v->arena, v->file->ground_assumed ? NULL : v->root, scene, name, key, false, p->items);
    else if (!name && scene->slope.segments_given == 0 && strncmp(path, SEGMENTS, sizeof SEGMENTS - 1) == 0)
        for (size_t j = 0; j < stretches; j++)
            add_place(p, ceduo_asprintf(v, "slope.segments[%zu].%s", j, path + sizeof SEGMENTS - 1));
    else if (!name)
        expand_path(p, path);
    for (size_t i = n; i < p->n; i++)
        if (p->items[i] && ceduo_value_find(scene, p->items[i], &value)) /* NULL: memory ran out */
            p->items[n++] = p->items[i];
    p->n = n;
}

/* Return the row of the table of keys for a path, even if the scene has no such item. NULL if the path is not a number or word
 * that affects a result. */
static const struct field *find_field(struct validator *v, const char *path)
{
    const char *key, *ground = find_material(v, path, &key);
    if (strcmp(path, "slope.tolerance_m") == 0 &&
        v->draft.scene.slope.segments_given > 1) /* such a profile is not simplified */
        return NULL;
    bool known = !ground || ceduo_choice_find(&ceduo_material_words, ground) >= 0;
    const struct field *f = known ? ceduo_schema_fitted(path) : NULL;
    bool value = f && !ceduo_schema_is_settled(path) &&
                 (f->type == FIELD_NUMBER || f->type == FIELD_SPREAD || f->type == FIELD_COUNT || f->type == FIELD_CHOICE);
    return value ? f : NULL;
}

/* Add the places of several paths, each once. Set *field to the row of their key; NULL: no option of them was kept. Return
 * false with the first path in *bad that has no row (*field is NULL), or another key than the paths before it. */
static bool find_all_places(struct places *p, const char *prefix, const char *paths, const struct field **field,
                            const char **bad)
{
    struct validator *v = p->v;
    size_t n;
    *field = NULL;
    *bad = paths;
    for (const char *rest = paths, *next; (next = ceduo_paths_next(&rest, &n));) {
        const char *written = ceduo_asprintf(v, "%s%.*s", prefix, (int)n, next);
        const char *path = prefix[0] ? written : translate_option(v, written);
        if (!path) /* the option was not kept */
            continue;
        const struct field *own = find_field(v, path);
        struct places found = {.v = v};
        *bad = path;
        if (own && *field && strcmp(own->key, (*field)->key) != 0)
            return false;
        *field = own;
        if (!own)
            return false;
        find_places(&found, path);
        size_t before = p->n;
        for (size_t i = 0; i < found.n; i++) {
            bool added = false;
            for (size_t k = 0; k < before; k++)
                added |= ceduo_schema_same(p->items[k], found.items[i]);
            if (!added)
                add_place(p, found.items[i]);
        }
    }
    return true;
}

/* ---- ranges ---- */

static bool read_range(struct validator *v, const struct row *row, const struct field *field, struct ceduo_input *input)
{
    double mean = row->uncertainty.mean, sd = row->uncertainty.sd;
    bool normal = !isnan(mean), gamma = normal && field->lo >= 0 && mean > 0 && sd > mean / 3;
    input->kind = gamma ? CEDUO_INPUT_GAMMA : normal ? CEDUO_INPUT_NORMAL : CEDUO_INPUT_RANGE;
    input->mean = mean;
    input->sd = sd;
    if (gamma && sd > CEDUO_GAMMA_MAX * mean)
        return ceduo_reject(v, row->path, "sd", _("sd is more than %g times the mean; give lo and hi"), CEDUO_GAMMA_MAX);
    input->lo = gamma ? ceduo_input_quantile(input, 0) : normal ? mean - 3 * sd : row->uncertainty.lo;
    input->hi = gamma ? ceduo_input_quantile(input, 1) : normal ? mean + 3 * sd : row->uncertainty.hi;
    if (!(input->lo < input->hi))
        return ceduo_reject(v, row->path, normal ? "sd" : "hi", _("the range is empty; make it larger"));
    const double ends[] = {input->lo, input->hi};
    const char *const keys[] = {normal ? "mean" : "lo", normal ? "sd" : "hi"};
    for (int i = 0; i < 2; i++)
        if (!ceduo_schema_in_range(field, ends[i]))
            return ceduo_reject(v, row->path, keys[i], _("%s is outside the range of %s: %s"), ROUNDTRIP(ends[i]), field->key,
                                ceduo_describe_range(v, field));
    for (int i = 0; i < (normal ? 1 : 2); i++)
        ceduo_warn_unusual(v->problems, ceduo_find_place(v, row->path, keys[i]), field, normal ? mean : ends[i]);
    return true;
}

static bool read_words(struct validator *v, const struct row *row, const struct field *field, struct ceduo_input *input)
{
    size_t n = row->uncertainty.one_of_count;
    int *words = ceduo_alloc(v, n, sizeof *words);
    input->kind = CEDUO_INPUT_WORDS;
    input->words = words;
    input->words_count = n;
    if (n < 2)
        ceduo_reject(v, row->path, "one_of", _("name at least two words"));
    for (size_t i = 0; words && i < n; i++) {
        const char *word = row->uncertainty.one_of[i], *removed = ceduo_removed_hint(word);
        const char *path = ceduo_asprintf(v, "%s.one_of[%zu]", row->path, i);
        words[i] = ceduo_choice_find(field->choices, word);
        if (removed)
            return ceduo_reject(v, path, "", "%s", _(removed));
        if (words[i] < 0)
            return ceduo_reject(v, path, "", _("'%s' is unknown; one of: %s"), word, ceduo_list_choices(v, field->choices));
        for (size_t k = 0; k < i; k++)
            if (words[k] == words[i])
                return ceduo_reject(v, path, "", _("'%s' is given twice"), word);
    }
    return words && n >= 2;
}

/* Warn that a path names nothing: it is misspelt, or the file has lost the item. --set may have exchanged it. */
static void warn_missing(struct validator *v, const struct row *row, const char *path)
{
    if (!(v->file->changed & ceduo_scene_list(path)))
        ceduo_warn(v, row->path, "path", _("'%s' names nothing in this scene, so its range is not used; check its spelling"),
                   row->uncertainty.path);
}

/* Make the input of a row, with its places. Return false on error, or if the scene has no such place. */
static bool make_input(struct validator *v, const struct row *row, struct places *places, struct ceduo_input *input)
{
    const struct uncertainty_row *d = &row->uncertainty;
    bool is_stand_row = row->prefix[0] != '\0';
    const struct field *field;
    const char *path = ceduo_asprintf(v, "%s%s", row->prefix, d->path), *bad;
    *places = (struct places){.v = v};
    bool good = find_all_places(places, row->prefix, d->path, &field, &bad);
    const char *removed = good ? NULL : ceduo_removed_hint(bad);
    if (removed)
        return ceduo_reject(v, row->path, "path", "%s", _(removed));
    if (!good && field)
        return ceduo_reject(v, row->path, "path", _("'%s' has another key than the paths before it; write a row for each key"),
                            bad);
    if (!good)
        return ceduo_reject(
            v, row->path, "path",
            _("'%s' affects no result; name a number or a word of the rock, its release, the slope, a stand or the law"),
            d->path);
    if (!field) /* no option of the row was kept */
        return false;
    if (places->n == 0) {
        warn_missing(v, row, path);
        return false;
    }
    /* exactly one of three forms is allowed */
    int range = !isnan(d->lo) + !isnan(d->hi), normal = !isnan(d->mean) + !isnan(d->sd);
    bool words = d->one_of != NULL, choice = field->type == FIELD_CHOICE;
    bool given = range == 2 ? normal == 0 && !words : normal == 2 ? range == 0 && !words : words && range + normal == 0;
    if (!given || words != choice)
        return ceduo_reject(v, row->path, "",
                            choice ? _("'%s' is a word; give one_of") : _("'%s' is a number; give lo and hi, or mean and sd"),
                            field->key);
    *input = (struct ceduo_input){.path = is_stand_row ? ceduo_input_path(v->file, places->items[0]) : d->path,
                                  .places = places->items,
                                  .places_count = places->n,
                                  .source = is_stand_row ? N_("uncertainty, in the stand") : N_("uncertainty, in the scene")};
    return choice ? read_words(v, row, field, input) : read_range(v, row, field, input);
}

static void add_input(struct validator *v, struct ceduo_input input, const char *path)
{
    size_t n = v->file->inputs_count;
    struct ceduo_input *inputs = ceduo_arena_grow(v->arena, v->file->inputs, n, 1, &v->inputs_capacity, sizeof *inputs);
    const char **rows = ceduo_arena_grow(v->arena, v->rows, n, 1, &v->rows_capacity, sizeof *rows);
    if (!inputs || !rows)
        return;
    v->file->inputs = inputs;
    v->rows = rows;
    v->rows[n] = path;
    v->file->inputs[v->file->inputs_count++] = input;
}

/* ---- stands ---- */

/* List all valid rows of the stands of all belts. */
static struct row *list_rows(struct validator *v, size_t *n)
{
    struct row *all = NULL;
    const struct node *options = ceduo_node_get(v->root, "options");
    size_t capacity = 0, several = options && options->kind == NODE_LIST ? options->n : 0;
    for (size_t o = 0; o < (several ? several : 1); o++) {
        const struct node *forest = ceduo_node_get(several ? options->items[o] : v->root, "forest");
        const char *option = several ? ceduo_asprintf(v, "options[%zu].", o) : "";
        for (size_t k = 0; forest && forest->kind == NODE_LIST && k < forest->n; k++) {
            const char *prefix = ceduo_asprintf(v, "%sforest[%zu].stand.", option, k);
            const struct node *list = ceduo_node_get(ceduo_node_get(forest->items[k], "stand"), "uncertainty");
            for (size_t i = 0; list && list->kind == NODE_LIST && i < list->n; i++) {
                const char *path = ceduo_asprintf(v, "%suncertainty[%zu]", prefix, i);
                if (!ceduo_is_valid_below(v, path))
                    continue;
                struct row *rows = ceduo_arena_grow(v->arena, all, *n, 1, &capacity, sizeof *all);
                if (!rows)
                    return NULL;
                all = rows;
                all[(*n)++] = (struct row){.path = path, .prefix = prefix, .list = list, .index = i};
            }
        }
    }
    return all;
}

/* Add the rows of stands. A row has places in all belts with its stand, except places that rows of the scene name. */
static void add_stand_rows(struct validator *v)
{
    size_t n = 0;
    struct row *rows = list_rows(v, &n);
    const struct object *object = ceduo_schema_field(ceduo_schema_stand(), "uncertainty")->object;
    for (struct row *r = rows; rows && r < rows + n; r++) {
        const struct node *node = r->list->items[r->index];
        const struct source_note *notes = NULL;
        struct places places;
        struct ceduo_input input;
        const struct field *field;
        const char *bad;
        bool duplicate = false;
        if (r->done)
            continue;
        ceduo_schema_init(object, &r->uncertainty);
        ceduo_bind(&(struct binding){.arena = v->arena, .problems = v->problems, .notes = &notes, .invalid = &v->invalid},
                   object, node, &r->uncertainty);
        for (size_t before = 0; before < r->index; before++) {
            const char *path = ceduo_node_text(r->list->items[before], "path");
            duplicate |= path && ceduo_schema_same(path, r->uncertainty.path);
        }
        if (duplicate)
            ceduo_reject(v, r->path, "path", _("'%s' is given twice"), r->uncertainty.path);
        bool good = !duplicate && make_input(v, r, &places, &input);
        for (struct row *same = r + 1; same < rows + n; same++)
            if (same->list->items[same->index] == node) {
                same->done = true;
                if (good)
                    find_all_places(&places, same->prefix, r->uncertainty.path, &field, &bad);
            }
        if (!good)
            continue;
        input.places = places.items;
        input.places_count = 0;
        for (size_t i = 0; i < places.n; i++)
            if (!ceduo_inputs_have(v->file->inputs, v->file->inputs_of_scene, places.items[i]))
                places.items[input.places_count++] = places.items[i];
        add_input(v, input, r->path);
    }
}

/* ---- draws of a calibration ---- */

/* A place and the column of its draws. */
struct drawn_place {
    const char *place;
    const struct field *field;
    size_t column;
};

struct draws {
    struct validator *v;
    struct csv csv;
    size_t columns, rows;
    double **values; /* [column][row] */
    size_t places_count, places_capacity;
    struct drawn_place *places; /* by column, later sorted by place */
};

/* Set input->places to all places of a fitted path. Return its field; NULL if it is not a number of a scene. */
static const struct field *find_fitted_places(struct validator *v, const char *path, struct ceduo_input *input)
{
    struct places p = {.v = v};
    const struct field *field;
    const char *bad;
    *input = (struct ceduo_input){.path = path, .kind = CEDUO_INPUT_RANGE};
    if (!find_all_places(&p, "", path, &field, &bad) || !field || field->type == FIELD_CHOICE)
        return NULL;
    input->places = p.items;
    input->places_count = p.n;
    return v->arena->failed ? NULL : field;
}

/* Find the places of the paths in the heads; each head must have one. Messages show only the beginning of a foreign head. */
static bool read_head(struct draws *t)
{
    struct validator *v = t->v;
    struct ceduo_input found;
    for (size_t c = 0; c < t->csv.heads_count; c++) {
        char *head = ceduo_arena_copy(v->arena, t->csv.heads[c].p, t->csv.heads[c].n), *rest = head;
        char *path = head ? strtok_r(head, " ", &rest) : NULL;
        if (!head)
            return false;
        path = path ? path : head;
        do {
            const struct field *f = path[0] ? find_fitted_places(v, path, &found) : NULL;
            t->csv.source->foreign &= f == NULL;
            if (!f || found.places_count == 0) {
                if (t->csv.source->foreign)
                    path[ceduo_utf8_cut(path, CEDUO_FOREIGN_MAX)] = '\0';
                return ceduo_problem_at(v->problems, ceduo_node_place(v->draws, "uncertainty.draws"),
                                        _("the column '%s' is not a value of this scene; rename it"), path);
            }
            t->places = ceduo_arena_grow(v->arena, t->places, t->places_count, found.places_count, &t->places_capacity,
                                         sizeof *t->places);
            if (!t->places)
                return false;
            for (size_t i = 0; i < found.places_count; i++)
                t->places[t->places_count++] = (struct drawn_place){found.places[i], f, c};
        } while ((path = strtok_r(NULL, " ", &rest)));
    }
    return true;
}

static bool read_table(struct draws *t, const char *path)
{
    struct problems *problems = t->v->problems;
    struct csv *csv = &t->csv;
    size_t before = problems->met;
    if (!ceduo_csv_open(csv, t->v->arena, path, problems) || !ceduo_csv_read_head(csv))
        return false;
    t->columns = csv->heads_count;
    t->values = ceduo_alloc(t->v, t->columns, sizeof *t->values);
    bool good = t->values != NULL;
    for (size_t c = 0; c < t->columns; c++)
        csv->heads[c].numeric = true;
    ceduo_csv_scan(csv);
    for (size_t c = 0; good && c < t->columns; c++)
        good = (t->values[c] = ceduo_alloc(t->v, csv->rows, sizeof **t->values)) != NULL;
    if (!good || !read_head(t))
        return false;
    for (; ceduo_csv_next_row(csv); t->rows++) {
        for (size_t c = 0, h = 0; c < t->columns && !csv->bad; c++) {
            struct csv_cell cell = ceduo_csv_next_cell(csv, c);
            double *to = &t->values[c][t->rows];
            bool number = ceduo_csv_number(csv, cell, -1e12, 1e12, "", to);
            for (; h < t->places_count && t->places[h].column == c; h++) {
                const struct field *f = t->places[h].field;
                if (number && !ceduo_schema_in_range(f, *to))
                    ceduo_csv_error(csv, cell, _("%s is outside the range of %s: %s"), ROUNDTRIP(*to), f->key,
                                    ceduo_describe_range(t->v, f));
            }
        }
    }
    qsort(t->places, t->places_count, sizeof *t->places, by_name);
    for (size_t i = 1; i < t->places_count; i++)
        if (by_name(&t->places[i - 1], &t->places[i]) == 0)
            ceduo_problem(problems, t->csv.source, 1, 1, _("'%s' is given twice"), t->places[i].place);
    if (t->rows == 0)
        ceduo_problem_at(problems, ceduo_node_place(t->v->draws, "uncertainty.draws"), _("the table has no row"));
    return problems->met == before;
}

/* Add the calibration draws as one input. */
static void add_draws(struct validator *v)
{
    struct draws t = {.v = v};
    if (v->draws->kind != NODE_SCALAR) {
        ceduo_problem_at(v->problems, ceduo_node_place(v->draws, "uncertainty.draws"), _("expected a path to a file"));
        return;
    }
    const char *path = ceduo_resolve_path(v->arena, v->draws, "scenes");
    if (!path)
        ceduo_problem_at(v->problems, ceduo_node_place(v->draws, "uncertainty.draws"),
                         _("cannot find '%s' next to this file or among the profiles (ceduo --list-profiles)"), v->draws->text);
    if (!path || !read_table(&t, path))
        return;
    const char **places = ceduo_alloc(v, t.places_count, sizeof *places);
    const double **draws = ceduo_alloc(v, t.places_count, sizeof *draws);
    for (size_t i = 0; places && draws && i < t.places_count; i++) {
        places[i] = t.places[i].place;
        draws[i] = t.values[t.places[i].column];
    }
    const struct ceduo_input input = {.path = "draws",
                                      .kind = CEDUO_INPUT_DRAWS,
                                      .lo = NAN,
                                      .hi = NAN,
                                      .places_count = t.places_count,
                                      .places = places,
                                      .draws_count = t.rows,
                                      .draws = draws,
                                      .source = N_("uncertainty, in the scene")};
    if (!places || !draws)
        return;
    add_input(v, input, NULL);
    LOCAL_TEXT(line);
    ceduo_text_append_escaped(&line, ceduo_file_name(path));
    ceduo_text_format(&line, _(": %zu joint draws of %zu values"), t.rows, t.columns);
    ceduo_add_table_note(v, "uncertainty.draws", ceduo_text_string(&line));
}

/* ---- all ---- */

/* True if a path of a row is among the paths of another row, with names or indices of items. */
static bool has_common_path(struct validator *v, const char *a, const char *b)
{
    size_t n, m;
    for (const char *rest = a, *path; (path = ceduo_paths_next(&rest, &n));) {
        const char *indexed = replace_names(v, ceduo_asprintf(v, "%.*s", (int)n, path));
        for (const char *row = b, *next; (next = ceduo_paths_next(&row, &m));)
            if (ceduo_schema_same(indexed, replace_names(v, ceduo_asprintf(v, "%.*s", (int)m, next))))
                return true;
    }
    return false;
}

void ceduo_validate_uncertainty(struct validator *v)
{
    size_t n = ceduo_is_valid_below(v, "uncertainty") ? v->draft.uncertainties_count : 0;
    if (!v->has_profile || ceduo_is_too_long(v, "uncertainty", n))
        return;
    if (v->draws)
        add_draws(v);
    for (size_t i = 0; i < n; i++) {
        const struct row row = {
            .uncertainty = v->draft.uncertainties[i], .path = ceduo_asprintf(v, "uncertainty[%zu]", i), .prefix = ""};
        struct places places;
        struct ceduo_input input;
        bool good = make_input(v, &row, &places, &input), duplicate = false;
        /* a duplicate has the same path, with names or indices of items, or draws for one of its places */
        for (size_t k = 0; good && k < v->file->inputs_count; k++) {
            const struct ceduo_input *b = &v->file->inputs[k];
            for (size_t p = 0; p < input.places_count && b->kind == CEDUO_INPUT_DRAWS; p++)
                duplicate |= bsearch(&input.places[p], b->places, b->places_count, sizeof *b->places, by_name) != NULL;
            duplicate |= b->kind != CEDUO_INPUT_DRAWS && has_common_path(v, b->path, input.path);
        }
        if (duplicate)
            ceduo_reject(v, row.path, "path", _("'%s' is given twice"), row.uncertainty.path);
        else if (good)
            add_input(v, input, row.path);
    }
    v->file->inputs_of_scene = v->file->inputs_count;
    add_stand_rows(v);
}

/* ---- ends of ranges ---- */

#define BORDERS_MAX 30 /* places along the slope; with more of them, pairs are not checked */

/* A copy of the scene, with inputs set to the ends of their ranges. */
struct ends {
    struct validator *v;
    struct input_scene copy;
    double *u; /* quantile of each input, 0…1; NaN: value of the scene */
};

/* Return the quantile, 0…1, of value k of n: one of the two ends of a range, or a word. */
static double get_quantile(size_t k, size_t n)
{
    return n == 2 ? (double)k : ((double)k + 0.5) / (double)n; /* u = 1 is the second of two words */
}

/* Count the values of an input to check: its two ends, or all its words. */
static size_t count_tries(const struct ceduo_input *input)
{
    return input->kind == CEDUO_INPUT_WORDS ? input->words_count : input->kind == CEDUO_INPUT_DRAWS ? 0 : 2;
}

/* Return value k of input i as text. */
static const char *value_text(struct validator *v, size_t i, size_t k)
{
    const struct ceduo_input *input = &v->file->inputs[i];
    const struct field *f = ceduo_schema_at(input->places[0]);
    if (input->kind == CEDUO_INPUT_WORDS)
        return f->choices->names[input->words[k]];
    const char *sign = input->kind == CEDUO_INPUT_NORMAL ? k == 0 ? " (mean - 3 sd)" : " (mean + 3 sd)" : "";
    /* untaken: table */
    return ceduo_asprintf(v, "%s%s%s%s", ROUNDTRIP(k == 0 ? input->lo : input->hi), f->unit[0] ? " " : "", f->unit, sign);
}

static const char *describe_status(enum ceduo_status status)
{
    switch (status) {
    case CEDUO_RELEASE_OFF_SLOPE:
        return _("the release lies outside the slope");
    case CEDUO_RELEASE_BELOW: /* untaken: table */
        return _("the release lies below the ground");
    case CEDUO_CONTROL_OFF_SLOPE:
        return _("a control lies outside the slope");
    case CEDUO_CONTROL_BEHIND:
        return _("a control lies before the release");
    case CEDUO_BAD_BELT:
        return _("a belt overlaps another, ends before it begins, or lies outside the slope");
    case CEDUO_BAD_ROCK:
        return _("the rock has no such size");
    default: /* untaken: table */
        return _("a number is outside its range");
    }
}

/* Report value k of input i if the scene cannot be computed with it. If j is not i, value m of input j is set, too. */
static void check_end(struct ends *e, size_t i, size_t k, size_t j, size_t m)
{
    struct validator *v = e->v;
    const struct ceduo_input *input = &v->file->inputs[i];
    e->u[j] = get_quantile(m, count_tries(&v->file->inputs[j]));
    e->u[i] = get_quantile(k, count_tries(input));
    ceduo_inputs_set(&e->copy, e->u);
    e->u[i] = e->u[j] = NAN;
    enum ceduo_status status = ceduo_scene_check(&e->copy.scene, NULL);
    if (status == CEDUO_OK)
        return;
    const char *key = input->kind == CEDUO_INPUT_WORDS   ? "one_of"
                      : input->kind != CEDUO_INPUT_RANGE ? "sd"
                      : k == 0                           ? "lo"
                                                         : "hi";
    if (i != j)
        ceduo_reject(v, v->rows[i], key, _("%s and %s of %s cannot be computed together: %s; make one of the ranges smaller"),
                     value_text(v, i, k), value_text(v, j, m), v->file->inputs[j].path, describe_status(status));
    else if (input->kind == CEDUO_INPUT_WORDS)
        ceduo_reject(v, v->rows[i], key, _("%s cannot be computed: %s; remove it"), value_text(v, i, k),
                     describe_status(status));
    else
        ceduo_reject(v, v->rows[i], key, _("%s cannot be computed: %s; make the range smaller"), value_text(v, i, k),
                     describe_status(status));
}

/* Report ranges with an end at which the scene cannot be computed: first of each input alone, then of each pair of places along
 * the slope. */
void ceduo_validate_ends(struct validator *v)
{
    size_t n = v->file->inputs_count, places_count = 0, before = v->problems->met;
    struct ends e = {.v = v, .u = ceduo_alloc(v, n, sizeof *e.u)};
    size_t *places = ceduo_alloc(v, n, sizeof *places);
    bool good = n > 0 && e.u && places && ceduo_scene_check(&v->draft.scene, NULL) == CEDUO_OK &&
                ceduo_inputs_open(&e.copy, &v->draft.scene, v->file->inputs, n) == CEDUO_OK;
    for (size_t i = 0; good && i < n; i++) {
        e.u[i] = NAN;
        const struct ceduo_input *input = &v->file->inputs[i];
        const struct field *f = input->places_count > 0 ? ceduo_schema_at(input->places[0]) : NULL;
        if (f && ceduo_schema_is_place(f))
            places[places_count++] = i;
    }
    for (size_t i = 0; good && i < n; i++)
        for (size_t k = 0; v->file->inputs[i].places_count > 0 && k < count_tries(&v->file->inputs[i]); k++)
            check_end(&e, i, k, i, k);
    good = good && v->problems->met == before && places_count <= BORDERS_MAX;
    for (size_t a = 1; good && a < places_count; a++)
        for (size_t b = 0; b < a; b++)
            for (size_t k = 0; k < 4; k++)
                check_end(&e, places[a], k / 2, places[b], k % 2);
    ceduo_inputs_release(&e.copy);
}

static struct validator make_validator(struct scene_file *file, struct problems *problems)
{
    struct validator v = {.file = file, .arena = &file->arena, .root = file->root, .problems = problems};
    v.draft.scene = file->scene;
    return v;
}

const struct field *ceduo_input_find(struct scene_file *file, const char *path, struct ceduo_input *input)
{
    struct problems problems = {0};
    struct validator v = make_validator(file, &problems);
    return find_fitted_places(&v, path, input);
}

size_t ceduo_input_count_places(struct scene_file *file, const char *path)
{
    struct problems problems = {0};
    struct validator v = make_validator(file, &problems);
    struct places p = {.v = &v};
    struct value value;
    bool all = expand_path(&p, path);
    for (size_t i = 0; i < p.n && all; i++)
        /* untaken: memory */
        all = p.items[i] && ceduo_value_find(&file->scene, p.items[i], &value);
    return all ? p.n : 0;
}
