/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BLOCKS_H
#define CEDUO_BLOCKS_H

#include "flag.h"
#include "run.h"

/* The same scene with blocks of other sizes: what a forest does to small blocks it does not do to large ones. */
struct ceduo_size_result {
    double volume;         /* m3 */
    double mass, diameter; /* kg, m: of the mean rock */
    double adc;            /* m, by the scene's rule: the worst belt before the control; infinite where there is none */
    double contacts;       /* with stems up to the control, by that rule (Eq. 2 of Ciabocco et al. 2009) */
    struct ceduo_arrivals arrivals; /* through the forest; 0 released: not simulated, or left out as too dear */
    bool own;                       /* the scene's own block */
};

/* 0.05, 0.2, 1, 5 m3: the limits of the rock classes of the Swiss guideline NaiS (Frehner et al. 2005), and 1 m3 between;
 * and the scene's own. */
#define CEDUO_SIZES 5

/* A rock of the same shape and density `factor` times as long in every dimension; spreads are scaled with the sizes. */
struct ceduo_rock_def ceduo_rock_scaled(const struct ceduo_rock_def *def, double factor);

struct ceduo_blocks_def {
    const struct ceduo_scene *scene;
    const struct ceduo_option *option;
    size_t control;
    uint64_t rocks; /* of each size */
    /* A size may cost about so much, in contacts and stems drawn: where that is not enough it has fewer blocks, and below 10, or
     * where they meet hundreds of times as many stems as the scene's own, none. */
    double effort;
    const struct ceduo_arrivals *own; /* of the scene's own block, taken if at least as many were simulated; may be NULL */
    unsigned threads;                 /* at most CEDUO_THREADS_MAX; 0: one */
    const ceduo_flag *cancel;         /* may be NULL */
};

/* The last control, as many rocks as the scene says, whatever they cost; the option is the first. */
struct ceduo_blocks_def ceduo_blocks_def_default(const struct ceduo_scene *scene);

/* Simulates blocks of each size through the forest to the control; sorted by volume. With the contact model index none is
 * simulated. CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT, or what ceduo_run_create() says. */
enum ceduo_status ceduo_blocks(const struct ceduo_blocks_def *def, struct ceduo_size_result blocks[CEDUO_SIZES]);

#endif
