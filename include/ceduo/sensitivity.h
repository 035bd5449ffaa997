/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SENSITIVITY_H
#define CEDUO_SENSITIVITY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "status.h"

/* Global sensitivity: which inputs make a figure uncertain. Base points A and B are rows of Sobol' points in the unit
 * cube; each input in turn is taken from B and all others from A (Saltelli et al. 2010). A figure is asked for at every
 * such point. From its values come the first-order index S of each input (the share of the variance that this input alone
 * explains; Saltelli et al. 2010, Table 2 b) and its total index S_T (the share that it causes alone or with others; Jansen 1999).
 *
 * A figure that is itself computed from random rocks has noise. So each is given twice, from the first and the second half
 * of the rocks: products of two halves, whose noise is independent, carry none of it on the mean. */

#define CEDUO_SENSITIVITY_GROUPS 20 /* Sobol' points of GSL have 40 coordinates, and A and B need one each */

struct ceduo_design {
    size_t inputs;       /* >= 1 */
    size_t points;       /* N >= 2: rows of A and of B */
    uint64_t seed;       /* of the random shift of the Sobol' points */
    size_t groups;       /* 1…CEDUO_SENSITIVITY_GROUPS: what gets an index; inputs of one group move together */
    const size_t *group; /* of each input; NULL: each input is a group of its own */
};

/* A design is a list of N·(groups + 2) evaluations: for each base point that of A, that of B, and that of A with the
 * inputs of each group from B. */
size_t ceduo_design_evaluations(const struct ceduo_design *design);

/* Fills `u`, one number in [0, 1) for each input and evaluation, in rows by evaluation. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_design_fill(const struct ceduo_design *design, double *u);

/* A figure at one evaluation, from each half of the rocks; without noise both are the same. */
struct ceduo_halves {
    double half[2];
};

/* A share of the variance and its standard error (bootstrap over blocks of base points). NaN where the figure does not vary. */
struct ceduo_share {
    double value, se;
};

struct ceduo_indices {
    double mean, variance; /* of the figure over the inputs, without noise */
    double noise;          /* variance of the mean of both halves by the rocks alone */
    struct ceduo_share first[CEDUO_SENSITIVITY_GROUPS], total[CEDUO_SENSITIVITY_GROUPS];
};

/* Reads the indices from a figure's values, in the order of the evaluations. Where the inputs move the figure by no more
 * than its noise hides, shares are of the variance with noise, and so close to 0. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_design_read(const struct ceduo_design *design, const struct ceduo_halves *values,
                                    struct ceduo_indices *indices);

#endif
