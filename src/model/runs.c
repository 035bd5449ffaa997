/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "runs.h"
#include "core/runs/alternative_law.h"
#include "core/runs/key.h"
#include "core/runs/pool.h"
#include "core/runs/run.h"
#include "core/runs/year_runs.h"

#include <stdlib.h>

#include "base/hash.h"
#include "base/oom.h"

struct runs {
    unsigned threads;
    const atomic_bool *cancel;
    uint64_t scene_key;
    struct ceduo_pool *figures, *years, *alternative_pool;
    struct ceduo_scene alternative_scene; /* scene of `alternative_pool` */
    struct ceduo_snapshot *last;          /* newest snapshot */
};

struct runs *ceduo_runs_create(unsigned threads, const atomic_bool *cancel)
{
    struct runs *r = ceduo_check_memory(calloc(1, sizeof *r));
    *r = (struct runs){.threads = threads, .cancel = cancel};
    return r;
}

void ceduo_runs_free(struct runs *r)
{
    if (!r)
        return;
    ceduo_snapshot_free(r->last);
    ceduo_pool_free(r->figures);
    ceduo_pool_free(r->years);
    ceduo_pool_free(r->alternative_pool);
    ceduo_alternative_scene_release(&r->alternative_scene);
    free(r);
}

static enum ceduo_status set_pool(struct runs *r, const struct ceduo_scene *scene, bool arrivals_only, struct ceduo_pool **pool)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = r->threads;
    def.rocks_max = RUNS_MAX;
    def.cancel = r->cancel;
    def.arrivals_only = arrivals_only;
    return ceduo_pool_reuse_or_create(&def, pool);
}

/* Set the pools to a scene. Drop the snapshot of another one. */
static enum ceduo_status set_pools(struct runs *r, const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_scene_key(scene);
    if (r->last && key != r->scene_key) {
        ceduo_snapshot_free(r->last);
        r->last = NULL;
    }
    r->scene_key = key;
    enum ceduo_status status = set_pool(r, scene, false, &r->figures);
    return status == CEDUO_OK ? set_pool(r, scene, true, &r->years) : status;
}

/* ---- figures ---- */

static bool is_precise(const struct ceduo_run_snapshot *s)
{
    for (size_t i = 0; s && i < s->simulated.controls; i++) {
        const struct ceduo_arrivals *a = &s->simulated.arrivals[i];
        if (!ceduo_mean_is_precise(a->reached, (struct ceduo_estimate){a->energy.mean, a->energy.se, NAN, NAN}, RUNS_TOLERANCE))
            return false;
    }
    return true;
}

/* Publish the newest results. Unchanged parts are shared with the last snapshot. */
static enum ceduo_status publish_figures(struct runs *r, const struct runs_step *step)
{
    struct ceduo_snapshot *own, *published;
    struct ceduo_snapshot_def def = {.scene = step->scene, .runs = r->figures, .cancel = r->cancel, .last = r->last};
    def.envelope_rocks = step->rocks > RUNS_FIRST ? CEDUO_ENVELOPE_ROCKS : RUNS_SKETCH;
    def.trajectories = CEDUO_SNAPSHOT_TRAJECTORIES;
    enum ceduo_status status = ceduo_snapshot_create(&def, &own);
    if (status != CEDUO_OK)
        return status;
    ceduo_snapshot_free(r->last);
    def.last = r->last = own;
    status = ceduo_snapshot_create(&def, &published);
    if (status == CEDUO_OK)
        step->publish(step->context, published);
    return status;
}

/* Publish after each forest: a figure with its error is shown until a better one arrives. */
enum ceduo_status ceduo_runs_figures(struct runs *r, struct runs_step *step)
{
    const struct ceduo_scene *scene = step->scene;
    bool wooded = scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    struct ceduo_run *run;
    enum ceduo_status status = set_pools(r, scene);
    if (status == CEDUO_OK)
        status = ceduo_pool_simulate(r->figures, NULL, step->rocks, &run);
    for (size_t k = 0, n = scene->options_count; wooded && k < n && status == CEDUO_OK; k++) {
        status = ceduo_pool_simulate(r->figures, &scene->options[(step->shown + k) % n], step->rocks, &run);
        bool publishes = k + 1 < n && (k == 0 || step->rocks >= RUNS_MAX);
        if (status == CEDUO_OK && publishes)
            status = publish_figures(r, step);
    }
    if (status == CEDUO_OK)
        status = publish_figures(r, step);
    if (status != CEDUO_OK)
        return status;
    bool precise = is_precise(r->last->bare);
    for (size_t i = 0; i < r->last->options; i++)
        precise = precise && is_precise(r->last->wooded[i]);
    step->enough = step->rocks * 10 > RUNS_MAX || (step->rocks >= RUNS_MIN && precise);
    return CEDUO_OK;
}

/* ---- the other energy law ---- */

enum ceduo_status ceduo_runs_alternative_energies(struct runs *r, const struct ceduo_scene *scene, uint64_t rocks,
                                                  struct ceduo_alternative_energy *energies)
{
    struct ceduo_scene alternative_scene, old = r->alternative_scene;
    size_t n = scene->options_count, controls = scene->controls_count;
    struct ceduo_run *first_run = NULL;
    if (!ceduo_alternative_scene(scene, &alternative_scene))
        ceduo_oom_set_flag();
    enum ceduo_status status = set_pool(r, &alternative_scene, true, &r->alternative_pool);
    r->alternative_scene = status == CEDUO_OK ? alternative_scene : old; /* scene of the pool */
    ceduo_alternative_scene_release(status == CEDUO_OK ? &old : &alternative_scene);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        struct ceduo_run *run;
        status = ceduo_pool_simulate(r->alternative_pool, &r->alternative_scene.options[i], rocks, &run);
        first_run = i == 0 ? run : first_run;
        for (size_t c = 0; c < controls && status == CEDUO_OK; c++)
            status = ceduo_alternative_read(scene, i, run, first_run, c, &energies[i * controls + c]);
    }
    return status;
}

/* ---- years ---- */

uint64_t ceduo_runs_years_key(const struct ceduo_scene *scene, size_t option)
{
    struct ceduo_window w = ceduo_scene_window(scene);
    uint64_t key = ceduo_scene_key(scene);
    const uint64_t parts[] = {ceduo_controls_key(scene),
                              ceduo_years_key(&scene->options[option]),
                              w.kind,
                              w.first,
                              w.last,
                              (uint64_t)scene->simulation.contact_model};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        hash_count(&key, parts[i]);
    return key;
}

enum ceduo_status ceduo_runs_years(struct runs *r, const struct ceduo_scene *scene, size_t option, uint64_t rocks,
                                   struct ceduo_years **years)
{
    *years = NULL;
    const struct ceduo_option *o = &scene->options[option];
    enum ceduo_status status = set_pools(r, scene);
    if (status == CEDUO_OK)
        status = r->last && r->last->bare ? ceduo_years_create(scene, o, ceduo_scene_window(scene), years) : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_years_simulate(*years, r->years, &r->last->bare->simulated, rocks);
    if (status == CEDUO_OK)
        (*years)->key = ceduo_runs_years_key(scene, option);
    if (status != CEDUO_OK) {
        ceduo_years_free(*years);
        *years = NULL;
    }
    return status;
}
