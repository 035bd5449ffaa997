/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BLOCKS_H
#define CEDUO_BLOCKS_H

#include "flag.h"
#include "run.h"

/* A scene with blocks of other sizes. A forest that stops small blocks need not stop large ones. */
struct ceduo_size_result {
    double volume;                  /* m3 */
    double mass, diameter;          /* kg, m: of the mean rock */
    double adc;                     /* m, by the scene's rule: worst belt before the control; infinite without a belt */
    double contacts;                /* with stems up to the control, by the same rule (Eq. 2 of Ciabocco et al. 2009) */
    struct ceduo_arrivals arrivals; /* through the forest; released == 0: not simulated, or skipped as too expensive */
    bool own;                       /* the scene's own block */
};

/* Number of sizes: 0.05, 0.2, 1, 5 m3, and the scene's own. They are the limits of the rock classes of the Swiss guideline NaiS
 * (Frehner et al. 2005), with 1 m3 added. */
#define CEDUO_SIZES 5

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
