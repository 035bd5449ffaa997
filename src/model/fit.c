/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/must.h"
#include "io/doubt_inputs.h"
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
    to->fields[to->n] = field;
    snprintf(to->paths[to->n], FIT_PATH_ROOM, "%s", path);
    to->lo[to->n] = lo;
    to->hi[to->n++] = hi;
}

static const char *const keys[] = {"rn", "rt", "roughness_rad", "friction"};
#define KEYS (sizeof keys / sizeof keys[0])

static bool law_knows(const struct scene_file *file, size_t key)
{
    return key != 1 || file->scene.simulation.law != CEDUO_LAW_ARM;
}

static struct range hull(struct range a, struct range b)
{
    a.lo = fmin(a.lo, b.lo);
    a.hi = fmax(a.hi, b.hi);
    return a;
}

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

/* The ground of all stretches as one. What it is, is known where nothing was said of it: talus; otherwise it may be all that the
 * library has, and what is near the scene's own values. Roughness as a length has no library. */
static void offer_everywhere(const struct scene_file *file, struct fit_request *to)
{
    bool length = !isnan(file->scene.slope.segments[0].roughness_m);
    size_t library_count;
    const struct ceduo_material *library = ceduo_materials(&library_count);
    for (size_t k = 0; k < KEYS; k++) {
        char path[FIT_PATH_ROOM];
        const char *key = k == 2 && length ? "roughness_m" : keys[k];
        struct range range = range_around(file, key);
        if (file->ground_assumed)
            range = ceduo_range_of_material(ceduo_material_talus(), key);
        for (size_t i = 0; i < library_count && !file->ground_assumed && key == keys[k]; i++)
            range = hull(range, ceduo_range_of_material(&library[i], key));
        snprintf(path, sizeof path, "slope.segments[*].%s", key);
        if (law_knows(file, k))
            offer(file, to, path, range.lo, range.hi);
    }
}

static void offer_materials(const struct scene_file *file, const struct node *rows, struct fit_request *to)
{
    size_t n;
    const struct ceduo_material *library = ceduo_materials(&n);
    for (size_t m = 0; m < n; m++) {
        bool there = false;
        for (size_t i = 0; i < rows->n; i++) {
            const char *name = ceduo_node_text(rows->items[i], "material");
            there |= name && ceduo_choice_find(&ceduo_material_words, name) == (int)m;
        }
        for (size_t k = 0; there && k < KEYS; k++) {
            char path[FIT_PATH_ROOM];
            struct range range = ceduo_range_of_material(&library[m], keys[k]);
            snprintf(path, sizeof path, "slope.materials[%s].%s", library[m].name, keys[k]);
            if (law_knows(file, k))
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
    if (!file->ground_assumed && file->scene.slope.segments_given == 0 && rows && rows->kind == NODE_LIST)
        offer_materials(file, rows, to);
    else
        offer_everywhere(file, to);
}

bool ceduo_fit_has_observations(const struct scene_file *file)
{
    for (size_t i = 0; i < file->observations_count; i++)
        if (file->observations[i].use == CEDUO_OBSERVED_FIT)
            return true;
    return false;
}

/* ---- what the observations hold ---- */

#define FIRST_STEPS 200 /* of each chain: with the search before them some seconds */
static enum ceduo_status find_loose(const struct ceduo_calibration_def *def, struct fit_loose *loose)
{
    struct ceduo_calibration_def short_def = *def;
    struct ceduo_calibration answer;
    short_def.steps_most = FIRST_STEPS;
    enum ceduo_status status = ceduo_calibrate(&short_def, &answer);
    if (status != CEDUO_OK)
        return status;
    loose->n = ceduo_calibration_loose(&answer, loose->loose);
    ceduo_calibration_free(&answer);
    return CEDUO_OK;
}

/* ---- fitting ---- */

enum ceduo_status ceduo_fit_make(const struct scene_file *file, const struct fit_request *request, const struct fit_run *run,
                                 struct fit **fit)
{
    struct fit *f = *fit = ceduo_must(calloc(1, sizeof *f));
    *f = (struct fit){.file = *file, .request = *request, .done = true};
    for (size_t i = 0; i < request->n; i++) {
        f->paths[i] = f->request.paths[i];
        ceduo_input_find(&f->file, f->paths[i], &f->inputs[i]); /* it was offered: it is there */
        f->inputs[i].lo = request->lo[i];
        f->inputs[i].hi = request->hi[i];
    }
    const struct ceduo_calibration_scene scene = {&f->file.scene, f->inputs, file->observations_count, file->observations};
    const struct ceduo_calibration_def def = {.scenes_count = 1,
                                              .scenes = &scene,
                                              .parameters_count = request->n,
                                              .rocks = request->rocks,
                                              .seed = file->scene.simulation.seed,
                                              .threads = run->threads,
                                              .cancel = run->cancel,
                                              .progress = run->progress,
                                              .context = run->context};
    enum ceduo_status status = request->n > 1 ? find_loose(&def, &f->loose) : CEDUO_OK;
    *run->loose = f->loose;
    status = status == CEDUO_OK ? ceduo_calibrate(&def, &f->answer) : status;
    if (status != CEDUO_OK) {
        ceduo_fit_free(f);
        *fit = NULL;
    }
    return status;
}

void ceduo_fit_free(struct fit *f)
{
    ceduo_calibration_free(&f->answer);
    ceduo_arena_free(&f->file.arena);
    free(f);
}
