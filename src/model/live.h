/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LIVE_H
#define CEDUO_LIVE_H

#include "jobs.h"
#include "study/verdict.h"

/* Figures of the scene, assessed again after each edit. Runs are requested only if an edit affects the rocks. */
struct live {
    struct jobs *jobs;
    union results results;          /* newest of each kind; stale ones stay until better ones arrive */
    struct ceduo_result *result;    /* current scene, by the newest snapshot; NULL: none yet */
    struct ceduo_verdict verdict;   /* verdict from the result and the years that fit the scene; n 0: none */
    const struct node *fitted_root; /* scene of the running or last fit */
    uint64_t requested_key;         /* key of the last requested runs */
    double uncertainty;             /* as in struct jobs_state */
    unsigned threads;
    bool busy, fitting;
};

/* Return false if no thread can be started. */
bool ceduo_live_create(struct live *live, unsigned threads);
void ceduo_live_free(struct live *live);

/* Update after a change of the scene or of the option shown. Uncertainty, comparison: levels, 0: none. Drop another fit. */
void ceduo_live_update(struct live *live, const struct scene_file *file, size_t option, size_t uncertainty, size_t comparison);

void ceduo_live_fit(struct live *live, const struct scene_file *file, const struct fit_request *request);
void ceduo_live_drop_fit(struct live *live);

/* Take the new results of the jobs. Return true if something has changed. */
bool ceduo_live_poll(struct live *live, const struct ceduo_scene *scene);

/* Return the results that fit this scene; NULL: none. An edit may have added a control since the request. */
const struct ceduo_snapshot *ceduo_live_snapshot(const struct live *live, const struct ceduo_scene *scene);
struct ceduo_years *ceduo_live_years(const struct live *live, const struct ceduo_scene *scene, size_t option);
const struct uncertainty *ceduo_live_uncertainty(const struct live *live, const struct scene_file *file);
const struct comparison *ceduo_live_comparison(const struct live *live, const struct scene_file *file);
const struct fit *ceduo_live_fitted(const struct live *live); /* a finished fit */

/* Share (0…1) computed of an option's uncertainty; NaN: done, or not requested. */
double ceduo_live_uncertainty_progress(const struct live *live, const struct scene_file *file, size_t option);

/* True if the option's figures are missing or belong to an earlier scene. */
bool ceduo_live_is_stale(const struct live *live, const struct ceduo_scene *scene, size_t option);

#endif
