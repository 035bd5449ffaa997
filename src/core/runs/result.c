/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Results, read from the runs of a pool or from earlier results, with the assessment of every option. A result owns all its
 * arrays and points to the scene. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "alternative_law.h"
#include "assess.h"
#include "hazard.h"
#include "result.h"
#include "run.h"
#include "run_state.h"
#include "scene/derived.h"

/* ---- results of a run ---- */

static bool allocate_simulated(struct ceduo_simulated *f, size_t controls, bool curves, bool fences)
{
    *f = (struct ceduo_simulated){.controls = controls, .arrivals = calloc(controls + 1, sizeof *f->arrivals)};
    f->curves = f->arrivals && curves ? calloc(controls + 1, sizeof *f->curves) : NULL;
    f->fences = f->arrivals && fences ? calloc(controls + 1, sizeof *f->fences) : NULL;
    if (f->arrivals && (f->curves || !curves) && (f->fences || !fences))
        return true;
    ceduo_simulated_release(f);
    return false;
}

enum ceduo_status ceduo_simulated_read(const struct ceduo_run *run, const struct ceduo_scene *scene,
                                       const struct ceduo_simulated *bare, struct ceduo_simulated *f)
{
    size_t controls = scene->controls_count;
    bool fences = ceduo_design_is_requested(&scene->design);
    for (size_t c = 0; c < controls; c++)
        fences |= ceduo_fence_stands(&scene->controls[c].fence);
    if (!allocate_simulated(f, controls, ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT), fences))
        return CEDUO_NO_MEMORY;
    f->rocks = ceduo_run_rocks(run);
    enum ceduo_status status = ceduo_run_ends(run, &f->ends);
    for (size_t c = 0; c < controls && status == CEDUO_OK; c++) {
        struct ceduo_arrivals *a = &f->arrivals[c];
        status = ceduo_run_hazard(run, c, a, f->curves ? &f->curves[c] : NULL);
        ceduo_arrivals_set_limit(a, scene, c);
        if (status == CEDUO_OK && fences)
            status = ceduo_run_fence(run, scene, c, bare ? &bare->arrivals[c] : NULL, &f->fences[c]);
        a->fence = fences ? &f->fences[c] : NULL;
    }
    if (status != CEDUO_OK)
        ceduo_simulated_release(f);
    return status;
}

static enum ceduo_status copy_simulated(const struct ceduo_simulated *from, struct ceduo_simulated *to)
{
    if (!allocate_simulated(to, from->controls, from->curves, from->fences))
        return CEDUO_NO_MEMORY;
    to->rocks = from->rocks;
    to->ends = from->ends;
    for (size_t c = 0; c < from->controls; c++) {
        to->arrivals[c] = from->arrivals[c];
        if (from->curves)
            to->curves[c] = from->curves[c];
        if (from->fences)
            to->fences[c] = from->fences[c];
        to->arrivals[c].hazard.curve = from->curves ? &to->curves[c] : NULL;
        to->arrivals[c].fence = from->fences ? &to->fences[c] : NULL;
    }
    return CEDUO_OK;
}

void ceduo_simulated_release(struct ceduo_simulated *f)
{
    free(f->arrivals);
    free(f->curves);
    free(f->fences);
    *f = (struct ceduo_simulated){0};
}

/* ---- results ---- */

void ceduo_simulated_set_no_contacts(struct ceduo_simulated *f)
{
    for (size_t c = 0; c < f->controls; c++) {
        struct ceduo_arrivals *a = &f->arrivals[c];
        if (a->reached > 0 && isnan(a->contacts.mean))
            a->contacts = (struct ceduo_estimate){0, 0, NAN, NAN};
    }
}

void ceduo_simulated_compare(struct ceduo_simulated *f, const struct ceduo_simulated *bare)
{
    for (size_t c = 0; f->arrivals && c < f->controls; c++) /* NULL if memory ran out */
        ceduo_hazard_compare(&f->arrivals[c].hazard, &bare->arrivals[c].hazard);
}

void ceduo_result_read(const struct ceduo_scene *scene, const struct ceduo_option *option, const struct ceduo_simulated *bare,
                       const struct ceduo_simulated *wooded, struct ceduo_stand_result *stands, struct ceduo_index *controls)
{
    for (size_t k = 0; k < option->belts_count; k++)
        stands[k] = ceduo_assess_stand(scene, &option->belts[k]);
    for (size_t c = 0; c < scene->controls_count; c++) {
        controls[c] = ceduo_assess_index(scene, option, &scene->controls[c], bare->arrivals[c].energy.mean);
        controls[c].energy = ceduo_energy_light(wooded->rocks > 0 ? &wooded->arrivals[c] : NULL);
        if (!ceduo_too_few_arrivals(&bare->arrivals[c]))
            continue;
        /* if rocks do not arrive even without forest, a passing light would wrongly credit the forest */
        controls[c].contact = controls[c].free_run = controls[c].energy = CEDUO_LIGHT_UNKNOWN;
        controls[c].thick.contact = controls[c].thick.free_run = CEDUO_LIGHT_UNKNOWN;
    }
}

static struct ceduo_result *allocate_result(const struct ceduo_scene *scene)
{
    struct ceduo_result *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    *r = (struct ceduo_result){.scene = scene,
                               .rock = ceduo_rock_mean(&scene->rock),
                               .wooded = scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX,
                               .options = calloc(scene->options_count + 1, sizeof *r->options)};
    r->options_count = r->options ? scene->options_count : 0;
    bool good = r->options != NULL;
    for (size_t i = 0; i < scene->options_count && good; i++) {
        struct ceduo_option_result *o = &r->options[i];
        o->stands = calloc(scene->options[i].belts_count + 1, sizeof *o->stands);
        o->controls = calloc(scene->controls_count + 1, sizeof *o->controls);
        o->differences = calloc(scene->controls_count + 1, sizeof *o->differences);
        o->alternatives = calloc(scene->controls_count + 1, sizeof *o->alternatives);
        good = o->stands && o->controls && o->differences && o->alternatives;
    }
    r->last_control = ceduo_scene_last_control(scene);
    if (good)
        return r;
    ceduo_result_free(r);
    return NULL;
}

/* Assess every option of a result whose runs were read; free the result if `status` is an error. */
static enum ceduo_status assess_options(struct ceduo_result *r, enum ceduo_status status, struct ceduo_result **result)
{
    const struct ceduo_scene *scene = r->scene;
    const struct ceduo_simulated none = {0};
    for (size_t i = 0; i < r->options_count && status == CEDUO_OK; i++) {
        struct ceduo_option_result *o = &r->options[i];
        if (r->wooded)
            ceduo_simulated_set_no_contacts(&o->wooded);
        else
            status = copy_simulated(&r->bare, &o->wooded);
        ceduo_simulated_compare(&o->wooded, &r->bare);
        for (size_t c = 0; c < scene->controls_count; c++) {
            struct ceduo_alternative_energy *alt = &o->alternatives[c];
            if (!r->wooded)
                o->differences[c] = ceduo_difference_zero(scene->controls[c].accepted);
            if (!r->wooded || !alt->known)
                continue;
            enum ceduo_judgement judgement = ceduo_judge_control(&r->bare.arrivals[c], ceduo_result_wooded(r, i, c));
            const struct ceduo_arrivals *a = &alt->arrivals;
            enum ceduo_judgement alt_judgement = ceduo_judge_share(a->exceed, a->limit);
            bool differ = (judgement == CEDUO_JUDGEMENT_YES && alt_judgement == CEDUO_JUDGEMENT_NO) ||
                          (judgement == CEDUO_JUDGEMENT_NO && alt_judgement == CEDUO_JUDGEMENT_YES);
            alt->judgement = judgement == CEDUO_JUDGEMENT_CANNOT_JUDGE ? judgement
                             : differ                                  ? CEDUO_JUDGEMENT_DEPENDS
                                                                       : alt_judgement;
        }
        ceduo_result_read(scene, &scene->options[i], &r->bare, r->wooded ? &o->wooded : &none, o->stands, o->controls);
    }
    if (status == CEDUO_OK)
        *result = r;
    else
        ceduo_result_free(r);
    return status;
}

enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, const struct ceduo_simulated *bare,
                                      const struct ceduo_simulated *const *wooded, const struct ceduo_difference *differences,
                                      const struct ceduo_alternative_energy *alternatives, struct ceduo_result **result)
{
    size_t controls = scene->controls_count;
    struct ceduo_result *r = allocate_result(scene);
    *result = NULL;
    if (!r)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = copy_simulated(bare, &r->bare);
    for (size_t i = 0; i < r->options_count && r->wooded && status == CEDUO_OK; i++) {
        if (differences)
            memcpy(r->options[i].differences, differences + i * controls, controls * sizeof *differences);
        if (alternatives)
            memcpy(r->options[i].alternatives, alternatives + i * controls, controls * sizeof *alternatives);
        if (wooded[i])
            status = copy_simulated(wooded[i], &r->options[i].wooded);
    }
    return assess_options(r, status, result);
}

enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_pool *pool,
                                      struct ceduo_result **result)
{
    size_t controls = scene->controls_count;
    const struct ceduo_run *bare = ceduo_pool_find(pool, NULL), *baseline = ceduo_pool_find(pool, &scene->options[0]);
    struct ceduo_result *r = allocate_result(scene);
    *result = NULL;
    if (!r)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = bare ? ceduo_simulated_read(bare, scene, NULL, &r->bare) : CEDUO_OK;
    if (!bare && !allocate_simulated(&r->bare, controls, false, false))
        status = CEDUO_NO_MEMORY;
    for (size_t c = 0; !bare && status == CEDUO_OK && c < controls; c++) { /* missing run: NaN */
        r->bare.arrivals[c].energy = ceduo_distribution_none();
        r->bare.arrivals[c].hazard = ceduo_hazard_none();
    }
    for (size_t i = 0; i < r->options_count && r->wooded && status == CEDUO_OK; i++) {
        const struct ceduo_run *run = ceduo_pool_find(pool, &scene->options[i]);
        for (size_t c = 0; c < controls; c++)
            r->options[i].differences[c] = ceduo_run_difference(run, baseline, c);
        if (run) /* an option without stems has the run without forest */
            status = run == bare ? copy_simulated(&r->bare, &r->options[i].wooded)
                                 : ceduo_simulated_read(run, scene, &r->bare, &r->options[i].wooded);
    }
    struct ceduo_scene alt = {0}; /* with the other energy law */
    if (r->wooded && status == CEDUO_OK && !ceduo_alternative_scene(scene, &alt))
        status = CEDUO_NO_MEMORY;
    for (size_t i = 0; i < r->options_count && r->wooded && status == CEDUO_OK; i++) {
        const struct ceduo_run *first = ceduo_pool_find(pool, &alt.options[0]);
        const struct ceduo_run *run = ceduo_pool_find(pool, &alt.options[i]);
        for (size_t c = 0; c < controls && status == CEDUO_OK; c++)
            status = ceduo_alternative_read(scene, i, run, first, c, &r->options[i].alternatives[c]);
    }
    ceduo_alternative_scene_release(&alt);
    return assess_options(r, status, result);
}

void ceduo_result_free(struct ceduo_result *result)
{
    if (!result)
        return;
    for (size_t i = 0; i < result->options_count; i++) {
        free(result->options[i].stands);
        free(result->options[i].controls);
        free(result->options[i].differences);
        free(result->options[i].alternatives);
        ceduo_simulated_release(&result->options[i].wooded);
    }
    free(result->options);
    ceduo_simulated_release(&result->bare);
    free(result);
}

const struct ceduo_arrivals *ceduo_result_wooded(const struct ceduo_result *result, size_t option, size_t control)
{
    if (option >= result->options_count || control >= result->bare.controls)
        return NULL;
    const struct ceduo_simulated *f = &result->options[option].wooded;
    return result->wooded && f->rocks > 0 ? &f->arrivals[control] : NULL;
}

uint64_t ceduo_result_rocks(const struct ceduo_result *result)
{
    return result->bare.rocks;
}

uint64_t ceduo_result_unfinished(const struct ceduo_result *result)
{
    uint64_t max = result->bare.ends.count[CEDUO_END_UNFINISHED];
    for (size_t i = 0; i < result->options_count; i++) {
        uint64_t n = result->options[i].wooded.ends.count[CEDUO_END_UNFINISHED];
        max = n > max ? n : max;
    }
    return max;
}

const struct ceduo_index *ceduo_result_last_index(const struct ceduo_result *result, size_t option)
{
    bool known = option < result->options_count && result->last_control < result->bare.controls;
    return known ? &result->options[option].controls[result->last_control] : NULL;
}
