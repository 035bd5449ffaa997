/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit.h"
#include "study/predict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "scene/ranges.h"
#include "scene/value.h"

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

#define SEGMENTS "slope.segments["

static void append_number(struct text *t, const char *before, double value)
{
    ceduo_text_format(t, "%s%s", before, ROUNDTRIP(value));
}

/* True for a row of uncertainty about ground or points that the new scene no longer has. */
static bool concerns_library(const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    return path && (strcmp(path, "slope.tolerance_m") == 0 || strncmp(path, "slope.materials[", 16) == 0);
}

/* Return the rows of uncertainty, or NULL if there is no list. Set `list` to its path. */
static const struct node *uncertainty_rows(const struct document *d, const char **list)
{
    const struct node *uncertainty = ceduo_node_get(d->file.root, "uncertainty");
    bool map = uncertainty && uncertainty->kind == NODE_MAP;
    const struct node *rows = map ? ceduo_node_get(uncertainty, "rows") : uncertainty;
    *list = map ? "uncertainty.rows" : "uncertainty";
    return rows && rows->kind == NODE_LIST ? rows : NULL;
}

static void change_ground(struct changes *c, const struct document *d)
{
    const char *list;
    const struct node *rows = uncertainty_rows(d, &list);
    for (size_t i = rows ? rows->n : 0; i-- > 0;)
        if (concerns_library(rows->items[i]))
            ceduo_changes_add(c, CHANGE_DELETE, ceduo_arena_format(&c->document->file.arena, "%s[%zu]", list, i), NULL);
    static const char *const removed_keys[] = {"slope.materials", "slope.csv", "slope.reversed",
                                               "slope.tolerance_m"}; /* vertices are written as simulated */
    const struct ceduo_slope *s = &d->file.scene.slope;
    LOCAL_TEXT(vertices);
    LOCAL_TEXT(segments);
    for (size_t i = 0; i < sizeof removed_keys / sizeof removed_keys[0]; i++)
        ceduo_changes_add(c, CHANGE_DELETE, removed_keys[i], NULL);
    for (size_t i = 0; i < s->vertices; i++) {
        append_number(&vertices, i == 0 ? "[[" : ", [", s->x[i] + s->origin_x);
        append_number(&vertices, ", ", s->z[i] + s->origin_z);
        ceduo_text_append(&vertices, "]");
    }
    ceduo_changes_set(c, "slope.vertices_m", "%s]", vertices.bytes);
    for (size_t i = 0; i + 1 < s->vertices; i++) {
        const struct ceduo_segment *g = &s->segments[i];
        bool angle = isnan(g->roughness_m);
        append_number(&segments, i == 0 ? "[{rn: " : ", {rn: ", g->rn.mean);
        append_number(&segments, ", rt: ", g->rt.mean);
        append_number(&segments, angle ? ", roughness_rad: " : ", roughness_m: ", angle ? g->roughness_rad : g->roughness_m);
        append_number(&segments, ", friction: ", g->friction);
        ceduo_text_append(&segments, "}");
    }
    ceduo_changes_set(c, "slope.segments", "%s]", segments.bytes);
}

/* ---- values ---- */

/* Add the source of a value once for the mapping that holds it. A top-level value has no source. */
static void add_source(struct changes *c, const char *place, const char *source)
{
    const char *dot = strrchr(place, '.');
    if (!dot)
        return;
    const char *path = ceduo_arena_format(&c->document->file.arena, "%.*s.source", (int)(dot - place), place);
    for (size_t i = 0; i < c->n; i++)
        if (strcmp(c->items[i].path, path) == 0)
            return;
    LOCAL_TEXT(text);
    ceduo_emit_scalar(&text, source, true);
    ceduo_changes_set(c, path, "{kind: calibrated, text: %s}", text.bytes);
}

/* True if a row of uncertainty is about a fitted value. */
static bool is_fitted(const struct document *d, const struct fit_values *fit, const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    for (size_t i = 0; path && i < d->file.inputs_of_scene; i++)
        for (size_t k = 0; strcmp(d->file.inputs[i].path, path) == 0 && k < fit->answer->parameters_count; k++)
            if (ceduo_input_overlaps(&d->file.inputs[i], &fit->inputs[k]))
                return true;
    return false;
}

/* Add the table of draws to the rows of uncertainty. Drop the rows about fitted values. */
static void add_draws(struct changes *c, const struct document *d, const struct fit_values *fit, bool from_library)
{
    const char *list;
    const struct node *rows = uncertainty_rows(d, &list);
    LOCAL_TEXT(t);
    bool has_rows = false;
    ceduo_text_append(&t, "{draws: ");
    ceduo_emit_scalar(&t, fit->draws, true);
    for (size_t i = 0; rows && i < rows->n; i++) {
        if (is_fitted(d, fit, rows->items[i]) || (from_library && concerns_library(rows->items[i])))
            continue;
        ceduo_text_append(&t, has_rows ? ", " : ", rows: [");
        ceduo_emit_flow(&t, rows->items[i]);
        has_rows = true;
    }
    ceduo_text_append(&t, has_rows ? "]}" : "}");
    ceduo_changes_add(c, CHANGE_SET, "uncertainty", t.bytes);
}

bool ceduo_apply_fit(struct document *d, const struct fit_values *fit)
{
    struct changes c = {.document = d};
    bool in_segments = false;
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            in_segments |= strncmp(fit->inputs[i].places[k], SEGMENTS, sizeof SEGMENTS - 1) == 0;
    bool from_library = in_segments && d->file.scene.slope.segments_given == 0;
    if (from_library)
        change_ground(&c, d);
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++) {
            const char *place = fit->inputs[i].places[k];
            struct value v;
            bool spread = ceduo_value_find(&d->file.scene, place, &v) && v.field->type == FIELD_SPREAD &&
                          ((const struct ceduo_number *)v.member)->spread > 0;
            ceduo_changes_add(&c, CHANGE_SET, spread ? ceduo_arena_format(&d->file.arena, "%s.mean", place) : place,
                              ROUNDTRIP(fit->answer->parameters[i].best));
        }
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            add_source(&c, fit->inputs[i].places[k], fit->source);
    if (fit->draws)
        add_draws(&c, d, fit, from_library);
    return ceduo_changes_apply(&c, _("fitted values"));
}
