/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LIVE_H
#define CEDUO_LIVE_H

#include "jobs.h"
#include "study/verdict.h"

/* The figures of the scene, assessed again after each edit. Runs are requested only if the rocks meet other things. */
struct live {
    struct jobs *jobs;
    union results results;        /* newest of each kind; what the scene has no longer stays until better is known */
    struct ceduo_result *result;  /* the scene as it is now, by the newest snapshot; NULL before the first */
    struct ceduo_verdict verdict; /* of the result and of the years that fit the scene; n 0: none */
    const struct node *fit_of;    /* the scene that is fitted, or was last */
    uint64_t asked;               /* key of the runs that were asked for last */
    double uncertainty;           /* as in struct jobs_state */
    unsigned threads;
    bool busy, fitting;
};

/* False where no thread can be started. */
bool ceduo_live_create(struct live *live, unsigned threads);
void ceduo_live_free(struct live *live);

/* Follow a change of the scene or of the option shown. Uncertainty and comparison: levels that are wanted, 0: none. A fit of
 * another scene is forgotten. */
void ceduo_live_follow(struct live *live, const struct scene_file *file, size_t option, size_t uncertainty, size_t comparison);

void ceduo_live_fit(struct live *live, const struct scene_file *file, const struct fit_request *request);
void ceduo_live_drop_fit(struct live *live);

/* Takes the new results of the jobs; true where something has changed. */
bool ceduo_live_poll(struct live *live, const struct ceduo_scene *scene);

/* What fits this scene, to which an edit may have added a control since it was asked for. NULL: nothing. */
const struct ceduo_snapshot *ceduo_live_snapshot(const struct live *live, const struct ceduo_scene *scene);
struct ceduo_years *ceduo_live_years(const struct live *live, const struct ceduo_scene *scene, size_t option);
const struct uncertainty *ceduo_live_uncertainty(const struct live *live, const struct scene_file *file);
const struct comparison *ceduo_live_comparison(const struct live *live, const struct scene_file *file);
const struct fit *ceduo_live_fitted(const struct live *live); /* a fit that is done */

/* Share (0…1) that is computed of the uncertainty of an option of this scene; NaN: it is known, or not asked for. */
double ceduo_live_awaits_uncertainty(const struct live *live, const struct scene_file *file, size_t option);

/* True if the figures of the option are still those of an earlier scene, or not there yet. */
bool ceduo_live_is_stale(const struct live *live, const struct ceduo_scene *scene, size_t option);

#endif
