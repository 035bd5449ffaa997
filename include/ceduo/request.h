/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REQUEST_H
#define CEDUO_REQUEST_H

#include "blocks.h"
#include "years.h"

/* The only interface for runs: simulate a scene and read its results.
 *
 *     struct ceduo_request request = ceduo_request_default(&scene);
 *     struct ceduo_results results;
 *     request.rocks = request.run.rocks_max = 10000;
 *     if (ceduo_simulate_request(&request, NULL, &results) == CEDUO_OK)
 *         printf("%g\n", results.result->options[0].wooded.arrivals[0].reach.mean);
 *     ceduo_results_release(&results); */
struct ceduo_request {
    struct ceduo_run_def run; /* the scene, and how its rocks are simulated; its option is ignored */
    uint64_t rocks;           /* per run, at most CEDUO_ROCKS_MAX; 0: only stands and index are computed */
    double tolerance; /* > 0: stop as soon as mean energies reach this relative precision, see ceduo_pool_run_to_tolerance() */
    /* Simulate this option only: through its forest, with contact model index without forest. Results of all other runs are
     * unknown. CEDUO_ALL_OPTIONS: without forest and through each. */
    size_t only;
    bool years;                 /* also each option year by year */
    struct ceduo_window window; /* the years; step 0: ceduo_scene_window() */
    bool rotations;             /* also the whole rotation of each option: ceduo_window_compute() */
    uint64_t year_rocks;        /* rocks per year, at most `rocks`; 0: `rocks` */
    bool years_independent;     /* each year has independent rocks, see ceduo_years_simulate_independent(); not with blocks */
    unsigned years_max;         /* > 0: at most this many years, evenly spread */
    uint64_t block_rocks; /* > 0: at most n blocks of each other size, to the last control, for at most the work of the runs */
};
#define CEDUO_ALL_OPTIONS SIZE_MAX

/* Return the default: all options, the scene's number of rocks, no years, no other sizes. */
struct ceduo_request ceduo_request_default(const struct ceduo_scene *scene);

struct ceduo_results {
    struct ceduo_result *result;
    bool tolerance_met;
    size_t years_count;               /* options */
    struct ceduo_years **years;       /* one per option, NULL if excluded by `only`; NULL: not requested */
    struct ceduo_years **rotations;   /* likewise */
    struct ceduo_size_result *blocks; /* CEDUO_SIZES per option; NULL: not requested, or the rock has no other sizes */
    struct ceduo_work work;           /* of all runs of the pool; without blocks and years_independent */
};

/* Simulate and read a scene. `pool` (may be NULL) keeps the runs between calls, see ceduo_pool_reuse_or_create(). *pool is NULL at first;
 * caller frees it. Everything that the scene points to must outlive results and pool. Return CEDUO_CANCELLED, CEDUO_NO_MEMORY,
 * CEDUO_BAD_ARGUMENT (no such option, too many rocks or threads, an invalid window, a scene without options) or a status of
 * ceduo_scene_check(). The results are empty then. Caller releases them in any case. */
enum ceduo_status ceduo_simulate_request(const struct ceduo_request *request, struct ceduo_pool **pool,
                                         struct ceduo_results *results);
void ceduo_results_release(struct ceduo_results *results);

#endif
