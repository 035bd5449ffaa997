/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RESULT_H
#define CEDUO_RESULT_H

#include "assess.h"
#include "other.h"
#include "pool.h"

/* What a run found, read from it: plain columns, one entry for each control. */
struct ceduo_simulated {
    uint64_t rocks; /* 0: nothing is known */
    size_t controls;
    struct ceduo_arrivals *arrivals;
    struct ceduo_hazard_curve *curves; /* to which the arrivals point; NULL without blocks */
    struct ceduo_ends ends;
};

/* CEDUO_NO_MEMORY, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_simulated_read(const struct ceduo_run *run, size_t controls, struct ceduo_simulated *simulated);
/* Through a forest without stems nothing is hit: that is known. Sets contacts that are not to 0. */
void ceduo_simulated_meets_nothing(struct ceduo_simulated *simulated);
/* Sets what a forest leaves of the hazard of `bare`. */
void ceduo_simulated_compare(struct ceduo_simulated *simulated, const struct ceduo_simulated *bare);
void ceduo_simulated_free(struct ceduo_simulated *simulated);

/* What is found for one option. */
struct ceduo_option_result {
    struct ceduo_stand_result *stands;       /* one for each belt */
    struct ceduo_index *controls;            /* one for each control, in the scene's order */
    struct ceduo_simulated wooded;           /* through its forest; with the contact model index: without forest */
    struct ceduo_difference *differences;    /* of that to the first option; all NaN where not known */
    struct ceduo_alternative_energy *others; /* one for each control: the same rocks under the other energy law */
};

/* All that is found for a scene: plain columns, to be shown or written. */
struct ceduo_result {
    const struct ceduo_scene *scene;
    struct ceduo_rock rock;      /* of the means */
    bool wooded;                 /* rocks went through the forests; otherwise the contact model is index */
    struct ceduo_simulated bare; /* without forest, the same for all options */
    size_t last_control;         /* the one farthest along x */
    size_t options_count;
    struct ceduo_option_result *options;
};

/* Reads the runs of a pool and assesses every option; of a run that the pool has not got nothing is known. The scene
 * must outlive the result.
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_pool *pool,
                                      struct ceduo_result **result);

/* The same from what was read before: without forest, and of each option through its forest, NULL where that is not known
 * yet. `differences` and `others` (may be NULL): one for each option and control, in rows by option. With the contact model
 * index none of the three is looked at. */
enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, const struct ceduo_simulated *bare,
                                      const struct ceduo_simulated *const *wooded, const struct ceduo_difference *differences,
                                      const struct ceduo_alternative_energy *others, struct ceduo_result **result);
void ceduo_result_free(struct ceduo_result *result);

/* Assesses an option by what was simulated: each belt to `stands`, each control to `controls`. `wooded` without rocks: not
 * known. */
void ceduo_result_read(const struct ceduo_scene *scene, const struct ceduo_option *option, const struct ceduo_simulated *bare,
                       const struct ceduo_simulated *wooded, struct ceduo_stand_result *stands, struct ceduo_index *controls);

/* What arrives at a control through the forest of an option; NULL with the contact model index and where it is not known
 * yet. */
const struct ceduo_arrivals *ceduo_result_wooded(const struct ceduo_result *result, size_t option, size_t control);

/* Rocks simulated in each run, and the most that are unfinished in one of them. */
uint64_t ceduo_result_rocks(const struct ceduo_result *result);
uint64_t ceduo_result_unfinished(const struct ceduo_result *result);

/* The index of an option at the last control. */
const struct ceduo_index *ceduo_result_last_index(const struct ceduo_result *result, size_t option);

#endif
