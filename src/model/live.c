/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "live.h"
#include "core/runs/alternative_law.h"
#include "core/runs/result.h"
#include "core/runs/year_runs.h"

#include <math.h>

#include "base/oom.h"

bool ceduo_live_create(struct live *l, unsigned threads)
{
    *l = (struct live){.jobs = ceduo_jobs_create(threads), .uncertainty = NAN, .threads = threads};
    return l->jobs != NULL;
}

void ceduo_live_free(struct live *l)
{
    ceduo_jobs_free(l->jobs);
    ceduo_result_free(l->result);
    ceduo_verdict_release(&l->verdict);
    ceduo_job_results_free(&l->results);
    *l = (struct live){0};
}

const struct ceduo_snapshot *ceduo_live_snapshot(const struct live *l, const struct ceduo_scene *scene)
{
    const struct ceduo_snapshot *o = l->results.snapshot ? l->results.snapshot->snapshot : NULL;
    return o && o->controls == scene->controls_count ? o : NULL;
}

struct ceduo_years *ceduo_live_years(const struct live *l, const struct ceduo_scene *scene, size_t option)
{
    const struct option_years *known = l->results.years;
    struct ceduo_years *years = known && option < known->n ? known->items[option] : NULL;
    return years && years->scene.controls_count == scene->controls_count ? years : NULL;
}

/* True if the results of one file are those of another. */
static bool has_same_nodes(const struct scene_file *a, const struct scene_file *b)
{
    return a->root == b->root || ceduo_jobs_nodes_key(a->root) == ceduo_jobs_nodes_key(b->root);
}

const struct uncertainty *ceduo_live_uncertainty(const struct live *l, const struct scene_file *file)
{
    const struct uncertainty *u = l->results.uncertainty;
    return u && has_same_nodes(&u->file, file) ? u : NULL;
}

double ceduo_live_uncertainty_progress(const struct live *l, const struct scene_file *file, size_t option)
{
    const struct uncertainty *u = ceduo_live_uncertainty(l, file);
    if (ceduo_node_text(file->root, "uncertainty") || (u && (u->inputs.n == 0 || u->level > 0 || u->option == option)))
        return NAN; /* "uncertainty: none" */
    return l->uncertainty;
}

bool ceduo_live_is_stale(const struct live *l, const struct ceduo_scene *scene, size_t option)
{
    const struct ceduo_snapshot *o = ceduo_live_snapshot(l, scene);
    bool wooded = scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    return !o || l->results.snapshot->key != l->requested_key || (wooded && !(option < o->options && o->wooded[option]));
}

const struct comparison *ceduo_live_comparison(const struct live *l, const struct scene_file *file)
{
    const struct comparison *c = l->results.comparison;
    return c && has_same_nodes(&c->file, file) ? c : NULL;
}

const struct fit *ceduo_live_fitted(const struct live *l)
{
    return l->results.fit && l->results.fit->done ? l->results.fit : NULL;
}

/* ---- assessing the current scene ---- */

/* Return the figures of the other energy law if they fit the scene. Keep stale ones unless they are of another law. */
static const struct ceduo_alternative_energy *fitting_alternatives(struct live *l, const struct ceduo_scene *scene)
{
    struct alternatives *o = l->results.alternatives;
    if (!o || o->options != scene->options_count || o->controls != scene->controls_count)
        return NULL;
    for (size_t i = 0; i < o->options * o->controls; i++)
        o->items[i].known &= o->items[i].model == ceduo_alternative_law(&scene->options[i / o->controls]);
    return o->items;
}

/* Assess the scene by its forests, and judge it by its years. Years of an earlier scene are shown, but do not count. */
static void assess(struct live *l, const struct ceduo_scene *scene)
{
    const struct ceduo_snapshot *o = ceduo_live_snapshot(l, scene);
    size_t n = scene->options_count, controls = scene->controls_count;
    ceduo_result_free(l->result);
    l->result = NULL;
    ceduo_verdict_release(&l->verdict);
    if (!o || !o->bare)
        return;
    const struct ceduo_simulated **wooded = ceduo_check_memory(calloc(n + 1, sizeof *wooded));
    struct ceduo_difference *differences = ceduo_check_memory(calloc(n * controls + 1, sizeof *differences));
    struct ceduo_years **known = ceduo_check_memory(calloc(n + 1, sizeof *known));
    bool in_order = o->options == n;
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_run_snapshot *run = ceduo_snapshot_find(o, scene, i);
        struct ceduo_years *years = ceduo_live_years(l, scene, i);
        wooded[i] = run ? &run->simulated : NULL;
        in_order = in_order && run == o->wooded[i];
        known[i] = years && years->key == ceduo_runs_years_key(scene, i) ? years : NULL;
        if (years)
            ceduo_years_assess(years, scene, &o->bare->simulated);
    }
    const struct ceduo_difference none = {CEDUO_NO_ESTIMATE, CEDUO_NO_ESTIMATE, CEDUO_NO_ESTIMATE};
    for (size_t i = 0; i < n * controls; i++)
        differences[i] = in_order ? o->differences[i] : none;
    if (ceduo_result_assess(scene, &o->bare->simulated, wooded, differences, fitting_alternatives(l, scene), &l->result) !=
        CEDUO_OK)
        l->result = NULL;
    if (l->result && ceduo_compare_options(l->result, known, NULL, &l->verdict) != CEDUO_OK) {
        ceduo_result_free(l->result);
        l->result = NULL;
    }
    free(known);
    free(differences);
    free(wooded);
}

/* ---- requests and notifications ---- */

void ceduo_live_update(struct live *l, const struct scene_file *file, size_t option, size_t uncertainty, size_t comparison)
{
    bool requested = ceduo_jobs_request_figures(l->jobs, file, option);
    l->requested_key = ceduo_jobs_key(&file->scene);
    l->busy |= requested;
    if (requested && l->results.years)
        l->results.years->done = l->results.years->n; /* that step has ended */
    assess(l, &file->scene);
    requested = ceduo_jobs_request(l->jobs, &(struct job_request){JOB_UNCERTAINTY, file, option, .levels = uncertainty});
    l->uncertainty = requested ? 0 : uncertainty == 0 ? NAN : l->uncertainty;
    if (l->fitted_root != file->root)
        ceduo_live_drop_fit(l);
    l->busy |= requested | ceduo_jobs_request(l->jobs, &(struct job_request){JOB_COMPARISON, file, .levels = comparison});
}

void ceduo_live_fit(struct live *l, const struct scene_file *file, const struct fit_request *request)
{
    ceduo_live_drop_fit(l);
    l->fitted_root = file->root;
    ceduo_jobs_request(l->jobs, &(struct job_request){JOB_FIT, file, .levels = 1, .fit = request});
    l->busy = l->fitting = true;
}

void ceduo_live_drop_fit(struct live *l)
{
    ceduo_jobs_stop(l->jobs, JOB_FIT);
    ceduo_job_results_drop(&l->results, JOB_FIT);
    l->fitting = false;
}

bool ceduo_live_poll(struct live *l, const struct ceduo_scene *scene)
{
    struct jobs_state state = ceduo_jobs_collect(l->jobs, &l->results);
    bool computes = !isnan(state.uncertainty), computed = !isnan(l->uncertainty);
    bool changed = state.new_kinds != 0 || state.busy != l->busy || computes != computed ||
                   (computes && state.uncertainty != l->uncertainty);
    l->busy = state.busy;
    l->uncertainty = state.uncertainty;
    l->fitting = state.fitting;
    if (state.new_kinds & (1u << JOB_SNAPSHOT | 1u << JOB_YEARS | 1u << JOB_ALTERNATIVES))
        assess(l, scene);
    return changed;
}
