/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/ranges.h"
#include "scene/value.h"

/* ---- what may be fitted ---- */

static void offer(const struct scene_file *file, struct fit_request *to, const char *path, double lo, double hi)
{
    struct scene_file own = *file;
    struct ceduo_input input = {0};
    own.arena = (struct arena){0};
    const struct field *field = ceduo_input_find(&own, path, &input);
    bool there = field && input.places_count > 0;
    const struct ceduo_calibration_scene scene = {
        .observations_count = file->observations_count, .observations = file->observations, .scene = &file->scene};
    if (there &&
        strcmp(field->key, "mu") == 0) /* it acts through the shape of the rock: only rocks of two shapes determine it */
        there = ceduo_calibration_tells_mu(&scene, 1);
    ceduo_arena_free(&own.arena);
    if (!there || to->n == CEDUO_CALIBRATION_MOST || strlen(path) >= FIT_PATH_ROOM || !(lo < hi))
        return;
    struct fit_value *value = &to->values[to->n++];
    *value = (struct fit_value){.lo = lo, .hi = hi};
    strcpy(value->path, path);
}

static const char *const keys[] = {"rn", "rt", "roughness_m", "friction"};
#define KEYS (sizeof keys / sizeof keys[0])

/* What the values that the scene has may be, by their own row of ranges. */
static struct range range_around(const struct scene_file *file, const char *key)
{
    const struct field *field = ceduo_schema_field(ceduo_schema_segment(), key);
    struct range range = *ceduo_range_of(field);
    double lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i + 1 < file->scene.slope.vertices; i++) {
        struct ceduo_segment one = file->scene.slope.segments[i];
        struct value v = {.field = field, .at = (char *)&one + field->offset};
        lo = fmin(lo, ceduo_value_get(&v));
        hi = fmax(hi, ceduo_value_get(&v));
    }
    if (range.kind == CEDUO_INPUT_FACTOR) {
        range.lo = fmax(field->lo, range.lo * lo);
        range.hi = fmin(field->hi, range.hi * hi);
    }
    return range;
}

/* The ground of all stretches as one (rows NULL), or each of the library that the scene names. What the one is, is known where
 * nothing was said of it: talus; otherwise it may be all that the library has, and what is near the scene's own values. Roughness as
 * an angle has no library. */
static void offer_ground(const struct scene_file *file, const struct node *rows, struct fit_request *to)
{
    size_t n;
    const struct ceduo_material *library = ceduo_materials(&n);
    bool angle = !rows && isnan(file->scene.slope.segments[0].roughness_m);
    for (size_t m = 0; m < (rows ? n : 1); m++) {
        bool there = !rows;
        for (size_t i = 0; rows && i < rows->n; i++) {
            const char *name = ceduo_node_text(rows->items[i], "material");
            there |= name && ceduo_choice_find(&ceduo_material_words, name) == (int)m;
        }
        for (size_t k = 0; there && k < KEYS; k++) {
            const char *key = k == 2 && angle ? "roughness_rad" : keys[k];
            char path[FIT_PATH_ROOM];
            struct range range = rows                   ? ceduo_range_of_material(&library[m], key)
                                 : file->ground_assumed ? ceduo_range_of_material(ceduo_material_talus(), key)
                                                        : range_around(file, key);
            for (size_t i = 0; i < n && !rows && !file->ground_assumed && key == keys[k]; i++) {
                struct range other = ceduo_range_of_material(&library[i], key);
                range.lo = fmin(range.lo, other.lo);
                range.hi = fmax(range.hi, other.hi);
            }
            if (rows)
                snprintf(path, sizeof path, "slope.materials[%s].%s", library[m].name, key);
            else
                snprintf(path, sizeof path, "slope.segments[*].%s", key);
            if (strcmp(key, "rt") != 0 || file->scene.simulation.law != CEDUO_LAW_ARM) /* which does not know it */
                offer(file, to, path, range.lo, range.hi);
        }
    }
}

void ceduo_fit_offer(const struct scene_file *file, struct fit_request *to)
{
    const struct node *rows = ceduo_node_get(ceduo_node_get(file->root, "slope"), "materials");
    uint64_t own = file->scene.simulation.rocks;
    *to = (struct fit_request){.rocks = own > 0 && own < CEDUO_CALIBRATION_ROCKS ? own : CEDUO_CALIBRATION_ROCKS};
    for (size_t i = 0; i < file->inputs_of_scene; i++) {
        const struct ceduo_input *input = &file->inputs[i];
        if (input->kind == CEDUO_INPUT_RANGE && input->places_count > 0)
            offer(file, to, input->path, input->lo, input->hi);
    }
    if (to->n > 0)
        return;
    bool named = !file->ground_assumed && file->scene.slope.segments_given == 0 && rows && rows->kind == NODE_LIST;
    offer_ground(file, named ? rows : NULL, to);
}

bool ceduo_fit_has_observations(const struct scene_file *file)
{
    for (size_t i = 0; i < file->observations_count; i++)
        if (file->observations[i].use == CEDUO_OBSERVED_FIT)
            return true;
    return false;
}

/* ---- fitting ---- */

#define FIRST_STEPS 200 /* of each chain: with the search before them some seconds */

enum ceduo_status ceduo_fit_make(const struct scene_file *file, const struct fit_request *request,
                                 const struct ceduo_calibration_def *how, struct fit_loose *loose, struct fit *f)
{
    *f = (struct fit){.file = *file, .request = *request, .done = true};
    for (size_t i = 0; i < request->n; i++) {
        const struct fit_value *value = &f->request.values[i];
        ceduo_input_find(&f->file, value->path, &f->inputs[i]); /* it was offered: it is there */
        f->inputs[i].lo = value->lo;
        f->inputs[i].hi = value->hi;
    }
    const struct ceduo_calibration_scene scene = {&f->file.scene, f->inputs, file->observations_count, file->observations};
    struct ceduo_calibration_def def = *how;
    def.scenes_count = 1;
    def.scenes = &scene;
    def.parameters_count = request->n;
    def.rocks = request->rocks;
    def.seed = file->scene.simulation.seed;
    if (request->n > 1) { /* what the observations do not hold */
        struct ceduo_calibration_def first = def;
        first.steps_most = FIRST_STEPS;
        enum ceduo_status status = ceduo_calibrate(&first, &f->answer);
        if (status != CEDUO_OK)
            return status;
        f->loose.n = ceduo_calibration_loose(&f->answer, f->loose.loose);
        ceduo_calibration_free(&f->answer);
    }
    *loose = f->loose;
    return ceduo_calibrate(&def, &f->answer);
}

void ceduo_fit_free(void *fit)
{
    struct fit *f = fit;
    ceduo_calibration_free(&f->answer);
    ceduo_arena_free(&f->file.arena);
    free(f);
}
