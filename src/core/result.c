/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool assess_option(const struct ceduo_scene *scene, const struct ceduo_option *option,
                          const struct ceduo_arrivals *bare, struct ceduo_option_result *to)
{
    to->stands = calloc(option->belts_count + 1, sizeof *to->stands);
    to->controls = calloc(scene->controls_count + 1, sizeof *to->controls);
    if (!to->stands || !to->controls)
        return false;
    for (size_t i = 0; i < option->belts_count; i++)
        to->stands[i] = ceduo_assess_stand(scene, &option->belts[i]);
    for (size_t i = 0; i < scene->controls_count; i++)
        to->controls[i] = ceduo_assess_index(scene, option, &scene->controls[i], bare[i].energy.mean);
    return true;
}

static bool assess_all(struct ceduo_result *r)
{
    const struct ceduo_scene *scene = r->scene;
    r->options_count = scene->options_count;
    for (size_t i = 0; i < scene->controls_count; i++)
        if (scene->controls[i].x > scene->controls[r->last_control].x)
            r->last_control = i;
    for (size_t i = 0; i < scene->options_count; i++)
        if (!assess_option(scene, &scene->options[i], r->bare, &r->options[i]))
            return false;
    return true;
}

/* With room for everything, nothing in it yet. */
static struct ceduo_result *new_result(const struct ceduo_scene *scene)
{
    struct ceduo_result *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->scene = scene;
    r->bare = calloc(scene->controls_count + 1, sizeof *r->bare);
    r->options = calloc(scene->options_count + 1, sizeof *r->options);
    if (r->bare && r->options && ceduo_rock_of_means(&scene->rock, &r->rock) == CEDUO_OK)
        return r;
    ceduo_result_free(r);
    return NULL;
}

enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                      struct ceduo_result **result)
{
    struct ceduo_result *r = *result = new_result(scene);
    bool good = r != NULL;
    for (size_t i = 0; good && i < scene->controls_count; i++)
        good = ceduo_run_arrivals(run, i, &r->bare[i]) == CEDUO_OK;
    if (good) {
        r->rocks = ceduo_run_rocks(run);
        r->contacts = ceduo_run_contacts(run);
        good = assess_all(r) && ceduo_run_ends(run, &r->ends) == CEDUO_OK;
    }
    if (good)
        return CEDUO_OK;
    ceduo_result_free(r);
    *result = NULL;
    return CEDUO_NO_MEMORY;
}

enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, uint64_t rocks, uint64_t contacts,
                                      const struct ceduo_arrivals *bare, const struct ceduo_ends *ends,
                                      struct ceduo_result **result)
{
    struct ceduo_result *r = *result = new_result(scene);
    if (!r)
        return CEDUO_NO_MEMORY;
    memcpy(r->bare, bare, scene->controls_count * sizeof *bare);
    r->rocks = rocks;
    r->contacts = contacts;
    r->ends = *ends;
    if (assess_all(r))
        return CEDUO_OK;
    ceduo_result_free(r);
    *result = NULL;
    return CEDUO_NO_MEMORY;
}

void ceduo_result_free(struct ceduo_result *result)
{
    if (!result)
        return;
    for (size_t i = 0; result->options && i < result->options_count; i++) {
        free(result->options[i].stands);
        free(result->options[i].controls);
    }
    free(result->options);
    free(result->bare);
    free(result);
}

static bool precise(const struct ceduo_run *run, size_t controls, double tolerance)
{
    for (size_t i = 0; i < controls; i++) {
        uint64_t reached;
        double mean, se;
        ceduo_run_energy(run, i, &reached, &mean, &se);
        if (reached >= CEDUO_FEW_ROCKS && !(CEDUO_Z95 * se <= tolerance * mean))
            return false;
    }
    return true;
}

enum ceduo_status ceduo_run_until(struct ceduo_run *run, size_t controls, double tolerance, uint64_t most, bool *met)
{
    *met = false;
    for (uint64_t rocks = CEDUO_BLOCK_ROCKS; !*met; rocks *= 2) {
        enum ceduo_status status = ceduo_run_extend(run, rocks < most ? rocks : most);
        if (status != CEDUO_OK)
            return status;
        *met = precise(run, controls, tolerance);
        if (rocks >= most)
            break;
    }
    return CEDUO_OK;
}
