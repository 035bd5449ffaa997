/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit.h"
#include "study/predict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "scene/ranges.h"
#include "scene/value.h"

/* ---- grounds of the library ---- */

#define GROUND   "slope.materials["
#define SEGMENTS "slope.segments["

/* Return the path that sets a ground of the library in its rows of `materials`. NULL: rows have no such key, or the ground is a
 * single stretch. */
static const char *find_rows_path(struct arena *arena, const struct scene_file *file, const struct ceduo_input *input)
{
    const char *path = input->path, *dot = strrchr(path, '.');
    bool all = strncmp(path, SEGMENTS "*].", sizeof SEGMENTS + 2) == 0;
    if (!ceduo_schema_row(ceduo_arena_format(arena, GROUND "0]%s", dot)) ||
        (!all && strncmp(path, GROUND, sizeof GROUND - 1) != 0))
        return NULL;
    return all ? ceduo_arena_format(arena, GROUND "%s]%s", file->ground_assumed ? ceduo_material_talus()->name : "*", dot)
               : path;
}

/* ---- values that can be fitted ---- */

static void offer_value(const struct scene_file *file, struct fit_request *request, const char *path, double lo, double hi)
{
    struct scene_file own = *file;
    struct ceduo_input input = {0};
    own.arena = (struct arena){0};
    const struct field *field = ceduo_input_find(&own, path, &input);
    bool exists = field && input.places_count > 0;
    const struct ceduo_calibration_scene scene = {
        .observations_count = file->observations_count, .observations = file->observations, .scene = &file->scene};
    if (exists &&
        strcmp(field->key, "mu") == 0) /* mu acts through the shape of the rock: only rocks of two shapes determine it */
        exists = ceduo_calibration_identifies_mu(&scene, 1);
    exists = exists && (!ceduo_input_is_library_ground(&own.scene, &input) || find_rows_path(&own.arena, &own, &input));
    ceduo_arena_free(&own.arena);
    if (!exists || request->n == CEDUO_CALIBRATION_MAX || strlen(path) >= FIT_PATH_MAX || !(lo < hi))
        return;
    struct fit_value *value = &request->values[request->n++];
    *value = (struct fit_value){.lo = lo, .hi = hi};
    strcpy(value->path, path);
}

static const char *const keys[] = {"rn", "rt", "roughness_m", "friction"};
#define KEYS (sizeof keys / sizeof keys[0])

/* Return the range of the scene's values, from their own row of ranges. */
static struct range range_around(const struct scene_file *file, const char *key)
{
    const struct field *field = ceduo_schema_field(ceduo_schema_segment(), key);
    struct range range = *ceduo_range_find(field);
    double lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i + 1 < file->scene.slope.vertices; i++) {
        struct ceduo_segment one = file->scene.slope.segments[i];
        struct value v = {.field = field, .member = (char *)&one + field->offset};
        lo = fmin(lo, ceduo_value_get(&v));
        hi = fmax(hi, ceduo_value_get(&v));
    }
    if (range.kind == CEDUO_INPUT_FACTOR) {
        range.lo = fmax(field->lo, range.lo * lo);
        range.hi = fmin(field->hi, range.hi * hi);
    }
    return range;
}

/* Offer one ground for all segments (rows NULL), or each ground of the library that the scene names. An assumed ground has
 * the range of talus; a given one those of the library and of the scene. Angles have no library. */
static void offer_ground(const struct scene_file *file, const struct node *rows, struct fit_request *request)
{
    size_t n;
    const struct ceduo_material *library = ceduo_materials(&n);
    bool angle = !rows && isnan(file->scene.slope.segments[0].roughness_m);
    for (size_t m = 0; m < (rows ? n : 1); m++) {
        bool exists = !rows;
        for (size_t i = 0; rows && i < rows->n; i++) {
            const char *name = ceduo_node_text(rows->items[i], "material");
            exists |= name && ceduo_choice_find(&ceduo_material_words, name) == (int)m;
        }
        for (size_t k = 0; exists && k < KEYS; k++) {
            const char *key = k == 2 && angle ? "roughness_rad" : keys[k];
            char path[FIT_PATH_MAX];
            struct range range = rows                   ? ceduo_range_find_material(&library[m], key)
                                 : file->ground_assumed ? ceduo_range_find_material(ceduo_material_talus(), key)
                                                        : range_around(file, key);
            for (size_t i = 0; i < n && !rows && !file->ground_assumed && key == keys[k]; i++) {
                struct range library_range = ceduo_range_find_material(&library[i], key);
                range.lo = fmin(range.lo, library_range.lo);
                range.hi = fmax(range.hi, library_range.hi);
            }
            if (rows)
                snprintf(path, sizeof path, "slope.materials[%s].%s", library[m].name, key);
            else
                snprintf(path, sizeof path, "slope.segments[*].%s", key);
            if (strcmp(key, "rt") != 0 || file->scene.simulation.law != CEDUO_LAW_ARM) /* the arm law has no Rt */
                offer_value(file, request, path, range.lo, range.hi);
        }
    }
}

void ceduo_fit_offer(const struct scene_file *file, struct fit_request *request)
{
    const struct node *rows = ceduo_node_get(ceduo_node_get(file->root, "slope"), "materials");
    uint64_t own = file->scene.simulation.rocks;
    *request = (struct fit_request){.rocks = own > 0 && own < CEDUO_CALIBRATION_ROCKS ? own : CEDUO_CALIBRATION_ROCKS};
    for (size_t i = 0; i < file->inputs_of_scene; i++) {
        const struct ceduo_input *input = &file->inputs[i];
        if (input->kind == CEDUO_INPUT_RANGE && input->places_count > 0)
            offer_value(file, request, input->path, input->lo, input->hi);
    }
    if (request->n > 0)
        return;
    bool named = !file->ground_assumed && file->scene.slope.segments_given == 0 && rows && rows->kind == NODE_LIST;
    offer_ground(file, named ? rows : NULL, request);
}

bool ceduo_fit_has_observations(const struct scene_file *file)
{
    for (size_t i = 0; i < file->observations_count; i++)
        if (file->observations[i].use == CEDUO_OBSERVED_USE_FIT)
            return true;
    return false;
}

/* ---- fitting ---- */

enum ceduo_status ceduo_fit_compute(const struct scene_file *file, const struct fit_request *request,
                                    const struct ceduo_calibration_def *options, struct fit *f)
{
    *f = (struct fit){.file = *file, .request = *request, .done = true};
    for (size_t i = 0; i < request->n; i++) {
        const struct fit_value *value = &f->request.values[i];
        ceduo_input_find(&f->file, value->path, &f->inputs[i]); /* a fit offers only paths that exist */
        f->inputs[i].lo = value->lo;
        f->inputs[i].hi = value->hi;
    }
    const struct ceduo_calibration_scene scene = {&f->file.scene, f->inputs, file->observations_count, file->observations};
    struct ceduo_calibration_def def = *options;
    def.scenes_count = 1;
    def.scenes = &scene;
    def.parameters_count = request->n;
    def.rocks = request->rocks;
    def.seed = file->scene.simulation.seed;
    enum ceduo_status status = ceduo_calibrate(&def, &f->answer);
    if (status == CEDUO_OK && !f->answer.converged)
        f->undetermined_count = ceduo_calibration_unidentified(&f->answer, f->undetermined);
    return status;
}

void ceduo_fit_free(void *fit)
{
    struct fit *f = fit;
    ceduo_calibration_release(&f->answer);
    ceduo_arena_free(&f->file.arena);
    free(f);
}

/* ---- a fit into a document ---- */

/* True if a path of find_rows_path() selects a row. */
static bool selects_row(const char *path, const struct node *row)
{
    const char *name = path + sizeof GROUND - 1, *ground = ceduo_node_text(row, "material");
    size_t n = strcspn(name, "]");
    LOCAL_TEXT(selected);
    ceduo_text_append_n(&selected, name, n);
    return *name == '*' || (ground && ceduo_choice_find(&ceduo_material_words, ceduo_text_string(&selected)) ==
                                          ceduo_choice_find(&ceduo_material_words, ground));
}

/* True if an input has a place that is not fitted. */
static bool has_unfitted_place(const struct ceduo_input *input, const struct ceduo_input *fitted, size_t n)
{
    for (size_t k = 0; k < input->places_count; k++)
        if (!ceduo_inputs_have(fitted, n, input->places[k]))
            return true;
    return false;
}

static bool overlaps_any(const struct ceduo_input *input, const struct ceduo_input *fitted, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (ceduo_input_overlaps(input, &fitted[i]))
            return true;
    return false;
}

bool ceduo_fit_can_apply(const struct scene_file *file, const struct ceduo_input *inputs, size_t n, struct text *reason)
{
    LOCAL_ARENA(arena);
    const char *table = ceduo_node_text(ceduo_node_get(file->root, "uncertainty"), "draws");
    for (size_t i = 0; i < n; i++)
        if (ceduo_input_is_library_ground(&file->scene, &inputs[i]) && !find_rows_path(&arena, file, &inputs[i])) {
            ceduo_text_format(
                reason,
                _("'%s' cannot be written into 'materials'; fit slope.materials[NAME].KEY, or give the ground as 'segments'"),
                inputs[i].path);
            return false;
        }
    for (size_t i = 0; i < file->inputs_of_scene; i++) {
        const struct ceduo_input *input = &file->inputs[i];
        bool draws = input->kind == CEDUO_INPUT_DRAWS;
        if (!has_unfitted_place(input, inputs, n) || (!draws && !overlaps_any(input, inputs, n)))
            continue;
        if (draws)
            ceduo_text_format(reason,
                              _("'%s' has draws of other values, which the new scene would lose; fit all of them together, or "
                                "remove 'draws' from uncertainty"),
                              table);
        else
            ceduo_text_format(
                reason, _("the row '%s' of uncertainty also names values that are not fitted; give these a row of their own"),
                input->path);
        return false;
    }
    return true;
}

/* ---- fitted entries of mappings ---- */

/* A fitted entry of the document. */
struct entry {
    const char *mapping, *key; /* "slope.segments[0]" and "friction"; the key may continue: "axes_m[0]" */
};

/* A fit that is written into a document. */
struct writing {
    struct document *document;
    struct arena *arena;
    const struct fit_values *fit;
    struct changes changes;
    size_t n, capacity;
    struct entry *entries; /* by mapping */
};

static void add_entry(struct writing *w, const char *mapping, const char *key)
{
    w->entries = ceduo_check_memory(ceduo_arena_grow(w->arena, w->entries, w->n, 1, &w->capacity, sizeof *w->entries));
    w->entries[w->n++] = (struct entry){mapping, key};
}

static int compare_mappings(const void *a, const void *b)
{
    return strcmp(((const struct entry *)a)->mapping, ((const struct entry *)b)->mapping);
}

/* Return the first fitted entry of a mapping; NULL: none. */
static const struct entry *find_entries(const struct writing *w, const char *mapping)
{
    const struct entry wanted = {mapping, NULL};
    const struct entry *found = w->n > 0 ? bsearch(&wanted, w->entries, w->n, sizeof wanted, compare_mappings) : NULL;
    while (found && found > w->entries && strcmp(found[-1].mapping, mapping) == 0)
        found--;
    return found;
}

static const struct entry *next_entry(const struct writing *w, const struct entry *e)
{
    return e + 1 < w->entries + w->n && strcmp(e[1].mapping, e->mapping) == 0 ? e + 1 : NULL;
}

/* Set a ground of the library in its rows. */
static void set_rows(struct writing *w, struct changes *values, const struct ceduo_input *input, const char *value)
{
    const struct scene_file *file = &w->document->file;
    const struct node *rows = ceduo_node_get(ceduo_node_get(file->root, "slope"), "materials");
    const char *path = find_rows_path(w->arena, file, input);
    if (!path) /* ceduo_fit_can_apply() refuses it */
        return;
    ceduo_changes_add(values, CHANGE_SET, path, value);
    for (size_t i = 0; i < (file->ground_assumed ? 1 : rows->n); i++)
        if (file->ground_assumed || selects_row(path, rows->items[i]))
            add_entry(w, ceduo_arena_format(w->arena, GROUND "%zu]", i), strrchr(path, '.') + 1);
}

static void set_places(struct writing *w, struct changes *values, const struct ceduo_input *input, const char *value)
{
    for (size_t k = 0; k < input->places_count; k++) {
        const char *place = input->places[k], *dot = strrchr(place, '.');
        struct value v;
        bool spread = ceduo_value_find(&w->document->file.scene, place, &v) && v.field->type == FIELD_SPREAD &&
                      ((const struct ceduo_number *)v.member)->spread > 0;
        ceduo_changes_add(values, CHANGE_SET, spread ? ceduo_arena_format(w->arena, "%s.mean", place) : place, value);
        if (dot) /* a top-level value has no source */
            add_entry(w, ceduo_arena_copy(w->arena, place, (size_t)(dot - place)), dot + 1);
    }
}

/* ---- sources ---- */

/* True if the source of a fit would wrongly include an entry of the mapping: its value is not fitted, and has no own source. */
static bool is_exception(const struct writing *w, const struct entry *fitted, const struct node *entry)
{
    bool in_rows = strncmp(fitted->mapping, GROUND, sizeof GROUND - 1) == 0;
    const char *path = ceduo_arena_format(w->arena, "%s.%s", fitted->mapping, entry->key);
    const struct field *field = ceduo_schema_row(path);
    const struct source_note *note = ceduo_notes_find(w->document->file.notes, path);
    if (!field || field->type <= FIELD_FILE || (in_rows && field->flags & FIELD_REQUIRED)) /* names, borders of rows */
        return false;
    for (const struct entry *e = fitted; e; e = next_entry(w, e))
        if (ceduo_path_leads_to(entry->key, e->key))
            return false;
    return !note || strcmp(note->path, path) != 0 || strcmp(note->kind, "changed") == 0;
}

/* Set the source of a mapping with fitted values. Other values of the mapping are exceptions. */
static void set_source(struct writing *w, const struct entry *fitted)
{
    const struct node *map = ceduo_document_node(w->document, fitted->mapping);
    bool excepts = false;
    LOCAL_TEXT(source);
    ceduo_text_append(&source, "{kind: calibrated, text: ");
    ceduo_emit_scalar(&source, w->fit->source, true);
    for (size_t i = 0; map && map->kind == NODE_MAP && i < map->n; i++)
        if (is_exception(w, fitted, map->items[i])) {
            ceduo_text_format(&source, "%s%s", excepts ? ", " : ", except: [", map->items[i]->key);
            excepts = true;
        }
    ceduo_text_append(&source, excepts ? "]}" : "}");
    ceduo_changes_set(&w->changes, ceduo_arena_format(w->arena, "%s.source", fitted->mapping), "%s", source.bytes);
}

/* True if a mapping has no source, but is in a mapping with a source. */
static bool inherits_source(const struct writing *w, const char *mapping)
{
    const struct node *map = ceduo_document_node(w->document, mapping);
    bool outer = ceduo_node_get(w->document->file.root, "source") != NULL;
    for (const char *dot = strchr(mapping, '.'); dot && !outer; dot = strchr(dot + 1, '.'))
        outer = ceduo_node_get(ceduo_document_node(w->document, ceduo_arena_copy(w->arena, mapping, (size_t)(dot - mapping))),
                               "source");
    return outer && map && map->kind == NODE_MAP && !ceduo_node_get(map, "source");
}

/* Set the sources of all mappings with fitted values. `inherited`: only of mappings that inherit one. They need it before their
 * values are set: a changed value would be excepted from the outer source, with its neighbours in a list. */
static void set_sources(struct writing *w, bool inherited)
{
    for (size_t i = 0; i < w->n; i++) {
        bool first = i == 0 || compare_mappings(&w->entries[i - 1], &w->entries[i]) != 0;
        if (first && (!inherited || inherits_source(w, w->entries[i].mapping)))
            set_source(w, &w->entries[i]);
    }
}

/* ---- uncertainty ---- */

/* True if the source of the fit replaces the one that marks a value as assumed: its range must be written. */
static bool loses_range(const struct writing *w, const char *place)
{
    const struct source_note *note = ceduo_notes_find(w->document->file.notes, place);
    bool lost = false;
    for (const char *dot = strchr(place, '.'); note && dot; dot = strchr(dot + 1, '.')) {
        size_t n = (size_t)(dot - place);
        const struct entry *e = strlen(note->path) <= n ? find_entries(w, ceduo_arena_copy(w->arena, place, n)) : NULL;
        lost |= e != NULL;
        for (; e; e = next_entry(w, e))
            if (strcmp(e->key, dot + 1) == 0) /* fitted */
                return false;
    }
    return lost;
}

/* Append the range of an assumed value as a row. */
static void append_range(struct text *rows, const struct ceduo_input *input, const char *path, const struct value *v)
{
    double factor = input->kind == CEDUO_INPUT_FACTOR ? ceduo_value_get(v) : 1;
    ceduo_text_append(rows, rows->length > 0 ? ", {path: " : "{path: ");
    ceduo_emit_scalar(rows, path, true);
    if (input->kind != CEDUO_INPUT_WORDS)
        ceduo_text_format(rows, ", lo: %.12g, hi: %.12g", fmax(v->field->lo, input->lo * factor),
                          fmin(v->field->hi, input->hi * factor));
    for (size_t i = 0; i < input->words_count; i++)
        ceduo_text_format(rows, "%s%s%s", i > 0 ? ", " : ", one_of: [", v->field->choices->names[input->words[i]],
                          i + 1 < input->words_count ? "" : "]");
    ceduo_text_append_char(rows, '}');
}

/* Append the ranges of assumed values that lose their source. An input stays one row if one path names all its places, their ranges
 * are equal, and none is fitted. */
static void append_ranges(struct writing *w, struct text *rows)
{
    struct scene_file *file = &w->document->file;
    struct scene_inputs inputs;
    size_t given = 0;
    for (size_t i = 0; i < file->inputs_count; i++)
        given += file->inputs[i].places_count > 0;
    if (!ceduo_inputs_collect(file, &inputs)) /* memory: the edit fails */
        return;
    for (size_t i = given; i < inputs.n; i++) {
        const struct ceduo_input *input = &inputs.items[i];
        struct value first, v;
        size_t lost = 0, places = input->places_count;
        bool equal = ceduo_value_find(&file->scene, input->places[0], &first) &&
                     !overlaps_any(input, w->fit->inputs, w->fit->answer->parameters_count);
        for (size_t k = 0; k < places; k++) {
            lost += loses_range(w, input->places[k]);
            equal = equal && ceduo_value_find(&file->scene, input->places[k], &v) &&
                    (input->kind != CEDUO_INPUT_FACTOR || ceduo_value_get(&v) == ceduo_value_get(&first));
        }
        if (lost > 0 && equal && ceduo_input_count_places(file, input->path) == places)
            append_range(rows, input, input->path, &first);
        else
            for (size_t k = 0; k < places && lost > 0; k++)
                if (loses_range(w, input->places[k]) && ceduo_value_find(&file->scene, input->places[k], &v))
                    append_range(rows, input, ceduo_input_path(file, input->places[k]), &v);
    }
}

/* True if a row of uncertainty is about a fitted value. */
static bool is_fitted(const struct writing *w, const struct node *row)
{
    const struct scene_file *file = &w->document->file;
    const char *path = ceduo_node_text(row, "path");
    for (size_t i = 0; path && i < file->inputs_of_scene; i++)
        if (strcmp(file->inputs[i].path, path) == 0 &&
            overlaps_any(&file->inputs[i], w->fit->inputs, w->fit->answer->parameters_count))
            return true;
    return false;
}

/* Write the draws, which replace the rows about fitted values, and the ranges that lose their source. */
static void set_uncertainty(struct writing *w)
{
    const struct node *given = ceduo_node_get(w->document->file.root, "uncertainty");
    bool map = given && given->kind == NODE_MAP;
    const struct node *list = map ? ceduo_node_get(given, "rows") : given;
    LOCAL_TEXT(rows);
    LOCAL_TEXT(draws);
    for (size_t i = 0; list && list->kind == NODE_LIST && i < list->n; i++) {
        if (w->fit->draws && is_fitted(w, list->items[i]))
            continue;
        ceduo_text_append(&rows, rows.length > 0 ? ", " : "");
        ceduo_emit_flow(&rows, list->items[i]);
    }
    size_t kept = rows.length;
    append_ranges(w, &rows);
    if (!w->fit->draws && rows.length == kept)
        return;
    if (!w->fit->draws) {
        ceduo_changes_set(&w->changes, map ? "uncertainty.rows" : "uncertainty", "[%s]", rows.bytes);
        return;
    }
    ceduo_emit_scalar(&draws, w->fit->draws, true);
    ceduo_changes_set(&w->changes, "uncertainty", rows.length > 0 ? "{draws: %s, rows: [%s]}" : "{draws: %s}", draws.bytes,
                      ceduo_text_string(&rows));
}

bool ceduo_apply_fit(struct document *d, const struct fit_values *fit)
{
    struct writing w = {.document = d, .arena = &d->file.arena, .fit = fit, .changes = {.document = d}};
    struct changes values = {.document = d};
    for (size_t i = 0; i < fit->answer->parameters_count; i++) {
        const char *best = ceduo_arena_string(w.arena, ROUNDTRIP(fit->answer->parameters[i].best));
        if (ceduo_input_is_library_ground(&d->file.scene, &fit->inputs[i]))
            set_rows(&w, &values, &fit->inputs[i], best);
        else
            set_places(&w, &values, &fit->inputs[i], best);
    }
    if (w.n > 0)
        qsort(w.entries, w.n, sizeof *w.entries, compare_mappings);
    set_sources(&w, true);
    for (size_t i = 0; i < values.n; i++)
        ceduo_changes_add(&w.changes, values.items[i].kind, values.items[i].path, values.items[i].value);
    set_sources(&w, false);
    set_uncertainty(&w);
    return ceduo_changes_apply(&w.changes, _("fitted values"));
}
