/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <stdlib.h>

#include "blocks.h"
#include "check.h"
#include "pool.h"
#include "result.h"
#include "run.h"
#include "year_runs.h"

struct ceduo_request ceduo_request_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_request){.size = sizeof(struct ceduo_request),
                                  .run = ceduo_run_def_default(scene),
                                  .rocks = scene->simulation.rocks,
                                  .only = CEDUO_ALL_OPTIONS};
}

/* ---- simulating ---- */

/* Simulate the years of each requested option, or its whole rotation if `rotation`. */
static enum ceduo_status simulate_years(const struct ceduo_request *q, struct ceduo_pool *pool, bool rotation,
                                        struct ceduo_results *a)
{
    const struct ceduo_scene *scene = q->run.scene;
    const struct ceduo_simulated *bare = &a->result->bare;
    uint64_t rocks = q->only == CEDUO_ALL_OPTIONS ? bare->rocks : q->rocks;
    rocks = q->year_rocks > 0 && q->year_rocks < rocks ? q->year_rocks : rocks;
    bool separate = q->years_independent && rocks > 0 && scene->blocks_count == 0 &&
                    scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    struct ceduo_years **years = calloc(scene->options_count + 1, sizeof *years);
    *(rotation ? &a->rotations : &a->years) = years;
    enum ceduo_status status = years ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < scene->options_count && status == CEDUO_OK; i++) {
        const struct ceduo_option *option = &scene->options[i];
        if (q->only != CEDUO_ALL_OPTIONS && q->only != i)
            continue;
        struct ceduo_window window = rotation             ? ceduo_window_compute(option)
                                     : q->window.step > 0 ? q->window
                                                          : ceduo_scene_window(scene);
        window = q->years_max > 0 ? ceduo_window_thinned(window, q->years_max) : window;
        status = ceduo_years_create(scene, option, window, &years[i]);
        if (status == CEDUO_OK) /* a constant window is year 0, today: its run exists */
            status = separate && window.kind != CEDUO_WINDOW_CONSTANT
                         ? ceduo_years_simulate_independent(years[i], &q->run, bare, rocks)
                         : ceduo_years_simulate(years[i], pool, bare, rocks);
    }
    return status;
}

/* Return the work of an option's run, in contacts plus stems drawn. */
static double get_effort(const struct ceduo_pool *pool, const struct ceduo_option *option)
{
    const struct ceduo_run *run = ceduo_pool_find(pool, option);
    return run ? (double)ceduo_run_contacts(run) + (double)ceduo_run_stems(run).drawn : 0;
}

/* The work limit of each size is the work of the runs without and through the forest. A splinter too thin has no sizes. */
static enum ceduo_status simulate_sizes(const struct ceduo_request *q, const struct ceduo_pool *pool, struct ceduo_results *a)
{
    const struct ceduo_scene *scene = q->run.scene;
    uint64_t all_rocks = ceduo_result_rocks(a->result), rocks = all_rocks < q->block_rocks ? all_rocks : q->block_rocks;
    a->blocks = calloc(scene->options_count * CEDUO_SIZES + 1, sizeof *a->blocks);
    enum ceduo_status status = a->blocks ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < scene->options_count && status == CEDUO_OK; i++)
        status = ceduo_sizes_simulate(
            &(const struct ceduo_sizes_def){.scene = scene,
                                            .option = &scene->options[i],
                                            .control = a->result->last_control,
                                            .rocks = rocks,
                                            .effort = get_effort(pool, NULL) + get_effort(pool, &scene->options[i]),
                                            .own = ceduo_result_wooded(a->result, i, a->result->last_control),
                                            .threads = q->run.threads,
                                            .cancel = q->run.cancel},
            &a->blocks[i * CEDUO_SIZES]);
    if (status == CEDUO_OK || status == CEDUO_NO_MEMORY || status == CEDUO_CANCELLED)
        return status;
    free(a->blocks);
    a->blocks = NULL;
    return CEDUO_OK;
}

enum ceduo_status ceduo_simulate_request(const struct ceduo_request *q, struct ceduo_pool **shared_pool,
                                         struct ceduo_results *a)
{
    *a = (struct ceduo_results){0};
    enum ceduo_status status = ceduo_check_request(q);
    if (status != CEDUO_OK)
        return status;
    const struct ceduo_scene *scene = q->run.scene;
    struct ceduo_pool *own_pool = NULL, **pool = shared_pool ? shared_pool : &own_pool;
    struct ceduo_run *run;
    struct ceduo_run_def def = q->run;
    def.rocks_max = def.rocks_max < q->rocks ? q->rocks : def.rocks_max;
    status = ceduo_pool_reuse_or_create(&def, pool);
    if (status == CEDUO_OK && q->only != CEDUO_ALL_OPTIONS) {
        if (q->rocks > 0)
            status = ceduo_pool_simulate(*pool, &scene->options[q->only], q->rocks, &run);
    } else if (status == CEDUO_OK && (status = ceduo_pool_fill(*pool)) == CEDUO_OK) {
        status = q->tolerance > 0 && q->rocks > 0
                     ? ceduo_pool_run_to_tolerance(*pool, q->tolerance, q->rocks, &a->tolerance_met)
                     : ceduo_pool_extend(*pool, q->rocks);
    }
    if (status == CEDUO_OK)
        status = ceduo_result_create(scene, *pool, &a->result);
    a->years_count = scene->options_count;
    struct ceduo_work today = *pool ? ceduo_pool_work(*pool) : a->work;
    if (status == CEDUO_OK && q->years)
        status = simulate_years(q, *pool, false, a);
    if (status == CEDUO_OK && q->rotations)
        status = simulate_years(q, *pool, true, a);
    a->work = *pool && !q->years_independent ? ceduo_pool_work(*pool) : today;
    if (status == CEDUO_OK && q->block_rocks > 0 && scene->controls_count > 0)
        status = simulate_sizes(q, *pool, a);
    ceduo_pool_free(own_pool);
    if (status != CEDUO_OK)
        ceduo_results_release(a);
    return status;
}

void ceduo_results_release(struct ceduo_results *a)
{
    for (size_t i = 0; i < a->years_count; i++) {
        ceduo_years_free(a->years ? a->years[i] : NULL);
        ceduo_years_free(a->rotations ? a->rotations[i] : NULL);
    }
    free(a->years);
    free(a->rotations);
    free(a->blocks);
    ceduo_result_free(a->result);
    *a = (struct ceduo_results){0};
}
