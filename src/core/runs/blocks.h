/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BLOCKS_H
#define CEDUO_BLOCKS_H

#include "ceduo/simulate.h"

/* Return the rock scaled by `factor` in every dimension, with the same shape and density. Spreads are scaled with the sizes. */
struct ceduo_rock_def ceduo_rock_scaled(const struct ceduo_rock_def *def, double factor);

struct ceduo_sizes_def {
    const struct ceduo_scene *scene;
    const struct ceduo_option *option;
    size_t control;
    uint64_t rocks; /* per size */
    /* Work limit per size, in contacts plus stems drawn. A size over the limit gets fewer blocks. It is skipped if fewer than
     * 10 fit, or if blocks meet hundreds of times as many stems as the scene's own. */
    double effort;
    const struct ceduo_arrivals *own; /* of the scene's own block, used if at least `rocks` were simulated; may be NULL */
    unsigned threads;                 /* at most CEDUO_THREADS_MAX; 0: one */
    const ceduo_flag *cancel;         /* may be NULL */
};

/* Return the default: last control, first option, the scene's number of rocks, no work limit. */
struct ceduo_sizes_def ceduo_sizes_def_default(const struct ceduo_scene *scene);

/* Simulate blocks of each size through the forest to the control; sorted by volume. With the contact model index no rock is
 * simulated. Return CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or a status of ceduo_run_create(). */
enum ceduo_status ceduo_sizes_simulate(const struct ceduo_sizes_def *def, struct ceduo_size_result blocks[CEDUO_SIZES]);

#endif
