/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what a run found ---- */

static bool allocate_flown(struct ceduo_flown *f, size_t controls)
{
    *f = (struct ceduo_flown){.controls = controls, .arrivals = calloc(controls + 1, sizeof *f->arrivals)};
    return f->arrivals != NULL;
}

enum ceduo_status ceduo_flown_read(const struct ceduo_run *run, size_t controls, struct ceduo_flown *f)
{
    if (!allocate_flown(f, controls))
        return CEDUO_NO_MEMORY;
    f->rocks = ceduo_run_rocks(run);
    enum ceduo_status status = ceduo_run_ends(run, &f->ends);
    for (size_t c = 0; c < controls && status == CEDUO_OK; c++)
        status = ceduo_run_arrivals(run, c, &f->arrivals[c]);
    if (status != CEDUO_OK)
        ceduo_flown_free(f);
    return status;
}

/* Of a run that is not there nothing is known. */
static enum ceduo_status read_if_there(const struct ceduo_run *run, size_t controls, struct ceduo_flown *f)
{
    if (run)
        return ceduo_flown_read(run, controls, f);
    if (!allocate_flown(f, controls))
        return CEDUO_NO_MEMORY;
    for (size_t c = 0; c < controls; c++)
        f->arrivals[c].energy = ceduo_distribution_none();
    return CEDUO_OK;
}

enum ceduo_status ceduo_flown_copy(const struct ceduo_flown *from, struct ceduo_flown *to)
{
    if (!allocate_flown(to, from->controls))
        return CEDUO_NO_MEMORY;
    to->rocks = from->rocks;
    to->ends = from->ends;
    if (from->controls > 0)
        memcpy(to->arrivals, from->arrivals, from->controls * sizeof *to->arrivals);
    return CEDUO_OK;
}

void ceduo_flown_free(struct ceduo_flown *f)
{
    free(f->arrivals);
    *f = (struct ceduo_flown){0};
}

/* ---- results ---- */

void ceduo_flown_meets_nothing(struct ceduo_flown *f)
{
    for (size_t c = 0; c < f->controls; c++) {
        struct ceduo_arrivals *a = &f->arrivals[c];
        if (a->reached > 0 && isnan(a->contacts))
            a->contacts = a->contacts_se = 0;
    }
}

/* Between the same flights. */
static struct ceduo_difference no_difference(double accepted)
{
    struct ceduo_difference d = {{0, 0}, {0, 0}, {0, 0}};
    if (isnan(accepted))
        d.exceed_probability = (struct ceduo_paired){NAN, NAN};
    return d;
}

static bool assess_option(struct ceduo_result *r, size_t i, const struct ceduo_flown *wooded,
                          const struct ceduo_difference *differences)
{
    const struct ceduo_scene *scene = r->scene;
    const struct ceduo_option *option = &scene->options[i];
    struct ceduo_option_result *to = &r->options[i];
    to->stands = calloc(option->belts_count + 1, sizeof *to->stands);
    to->controls = calloc(scene->controls_count + 1, sizeof *to->controls);
    to->differences = calloc(scene->controls_count + 1, sizeof *to->differences);
    if (!to->stands || !to->controls || !to->differences)
        return false;
    if (wooded && ceduo_flown_copy(wooded, &to->wooded) != CEDUO_OK)
        return false;
    if (r->wooded)
        ceduo_flown_meets_nothing(&to->wooded);
    for (size_t k = 0; k < option->belts_count; k++)
        to->stands[k] = ceduo_assess_stand(scene, &option->belts[k]);
    for (size_t c = 0; c < scene->controls_count; c++) {
        to->controls[c] = ceduo_assess_index(scene, option, &scene->controls[c], r->bare.arrivals[c].energy.mean);
        to->controls[c].energy = ceduo_energy_light(ceduo_result_wooded(r, i, c));
        to->differences[c] = differences ? differences[c] : no_difference(scene->controls[c].accepted);
    }
    return true;
}

enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, const struct ceduo_flown *bare,
                                      const struct ceduo_flown *const *wooded,
                                      const struct ceduo_difference *differences, struct ceduo_result **result)
{
    *result = NULL;
    struct ceduo_result *r = calloc(1, sizeof *r);
    if (!r)
        return CEDUO_NO_MEMORY;
    r->scene = scene;
    r->wooded = scene->simulation.contact_model != CEDUO_INDEX;
    r->options = calloc(scene->options_count + 1, sizeof *r->options);
    r->rock = ceduo_rock_mean(&scene->rock);
    bool good = r->options && ceduo_flown_copy(bare, &r->bare) == CEDUO_OK;
    if (good)
        r->options_count = scene->options_count;
    for (size_t i = 1; i < scene->controls_count; i++)
        if (scene->controls[i].x > scene->controls[r->last_control].x)
            r->last_control = i;
    for (size_t i = 0; i < scene->options_count && good; i++)
        good = assess_option(r, i, r->wooded ? wooded[i] : &r->bare,
                             r->wooded ? differences + i * scene->controls_count : NULL);
    if (good) {
        *result = r;
        return CEDUO_OK;
    }
    ceduo_result_free(r);
    return CEDUO_NO_MEMORY;
}

enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_pool *pool,
                                      struct ceduo_result **result)
{
    *result = NULL;
    bool flies = scene->simulation.contact_model != CEDUO_INDEX;
    size_t n = flies ? scene->options_count : 0, controls = scene->controls_count;
    struct ceduo_flown bare = {0}, *wooded = calloc(n + 1, sizeof *wooded);
    const struct ceduo_flown **all = calloc(n + 1, sizeof *all);
    struct ceduo_difference *differences = calloc(n * controls + 1, sizeof *differences);
    bool room = wooded && all && differences;
    const struct ceduo_run *baseline = ceduo_pool_find(pool, &scene->options[0]);
    enum ceduo_status status =
        room ? read_if_there(ceduo_pool_find(pool, NULL), controls, &bare) : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        const struct ceduo_run *run = ceduo_pool_find(pool, &scene->options[i]);
        all[i] = run ? &wooded[i] : NULL;
        status = read_if_there(run, controls, &wooded[i]);
        for (size_t c = 0; c < controls; c++)
            differences[i * controls + c] = ceduo_run_difference(run, baseline, c);
    }
    if (status == CEDUO_OK)
        status = ceduo_result_assess(scene, &bare, all, differences, result);
    ceduo_flown_free(&bare);
    for (size_t i = 0; wooded && i < n; i++)
        ceduo_flown_free(&wooded[i]);
    free(wooded);
    free(all);
    free(differences);
    return status;
}

void ceduo_result_free(struct ceduo_result *result)
{
    if (!result)
        return;
    for (size_t i = 0; i < result->options_count; i++) {
        free(result->options[i].stands);
        free(result->options[i].controls);
        free(result->options[i].differences);
        ceduo_flown_free(&result->options[i].wooded);
    }
    free(result->options);
    ceduo_flown_free(&result->bare);
    free(result);
}

const struct ceduo_arrivals *ceduo_result_wooded(const struct ceduo_result *result, size_t option, size_t control)
{
    const struct ceduo_flown *f = &result->options[option].wooded;
    return result->wooded && f->rocks > 0 ? &f->arrivals[control] : NULL;
}

uint64_t ceduo_result_rocks(const struct ceduo_result *result)
{
    return result->bare.rocks;
}

uint64_t ceduo_result_unfinished(const struct ceduo_result *result)
{
    uint64_t most = result->bare.ends.count[CEDUO_UNFINISHED];
    for (size_t i = 0; i < result->options_count; i++) {
        uint64_t n = result->options[i].wooded.ends.count[CEDUO_UNFINISHED];
        most = n > most ? n : most;
    }
    return most;
}
