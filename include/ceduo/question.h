/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_QUESTION_H
#define CEDUO_QUESTION_H

#include "blocks.h"
#include "years.h"

/* The one way to ask for runs: simulate this scene so far, and read it.
 *
 *     struct ceduo_request question = ceduo_request_default(&scene);
 *     struct ceduo_results answer;
 *     question.rocks = question.run.rocks_most = 10000;
 *     if (ceduo_simulate_request(&question, NULL, &answer) == CEDUO_OK)
 *         printf("%g\n", answer.result->options[0].wooded.arrivals[0].reach.mean);
 *     ceduo_results_release(&answer); */
struct ceduo_request {
    struct ceduo_run_def run;   /* the scene, and how its rocks are simulated; its option is not looked at */
    uint64_t rocks;             /* in each run, at most CEDUO_ROCKS_MAX; 0: none, for what stands and index say without */
    double tolerance;           /* > 0: fewer, as soon as ceduo_pool_run_to_tolerance() knows the mean energies to this */
    size_t only;                /* the run of this option alone: through its forest, by the index without forest. Of what
                               * was not simulated nothing is known. CEDUO_ALL_OPTIONS: without forest and through each */
    bool years;                 /* each option year by year, with as many rocks */
    struct ceduo_window window; /* those years; step 0: those of ceduo_window_in() */
    bool rotations;             /* the whole rotation of each option as well: ceduo_window_compute() */
    uint64_t year_rocks;        /* rocks of each year, at most as many as in a run; 0: as many */
    bool years_apart;           /* each year has rocks of its own, see ceduo_years_simulate_independent(); not with blocks */
    unsigned years_most;        /* > 0: at most this many years, evenly spread over those */
    uint64_t block_rocks;       /* > 0: blocks of other sizes to the last control, at the most so many of each, and no dearer
                           * than the runs without forest and through it */
};
#define CEDUO_ALL_OPTIONS SIZE_MAX

/* All options of the scene, as many rocks as it says, no years, no other sizes. */
struct ceduo_request ceduo_request_default(const struct ceduo_scene *scene);

struct ceduo_results {
    struct ceduo_result *result;
    bool tolerance_met;
    size_t years_count;               /* options */
    struct ceduo_years **years;       /* one for each option, NULL of those that `only` leaves out; NULL: not asked for */
    struct ceduo_years **rotations;   /* likewise */
    struct ceduo_size_result *blocks; /* CEDUO_SIZES for each option; NULL: not asked for, or the rock has no other sizes */
    struct ceduo_work work;           /* of all runs of the pool; without the blocks, and without years_apart's years */
};

/* `pool` (may be NULL) keeps the runs from one question to the next, see ceduo_pool_reuse_or_create(): *pool is NULL at first, and
 * the caller's to free. What the scene points to must outlive answer and pool. CEDUO_CANCELLED, CEDUO_NO_MEMORY,
 * CEDUO_BAD_ARGUMENT (no such option, too many rocks or threads, a window that is none, a scene without options) or what
 * ceduo_scene_check() says: then the answer is empty. Release it in any case. */
enum ceduo_status ceduo_simulate_request(const struct ceduo_request *question, struct ceduo_pool **pool,
                                         struct ceduo_results *answer);
void ceduo_results_release(struct ceduo_results *answer);

#endif
