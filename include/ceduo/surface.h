/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURFACE_H
#define CEDUO_SURFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "status.h"

struct ceduo_input;

/* Polynomial chaos surrogate of a figure: a least-squares fit of functions that are orthonormal over the distribution of the
 * uncertain inputs, from its values at some hundred points (Sudret 2008; Le Gratiet, Marelli and Sudret 2017). The square of a
 * coefficient is the variance of its term. Sobol' shares of inputs are sums of these squares.
 *
 * Functions of one input with quantile u: Legendre polynomials of 2u - 1 of degree 1 and 2 for a range; contrasts for words;
 * values, orthonormalized over the rows, and their squares for calibration draws. Terms: these functions, products of
 * degree 1 of two inputs, and products of two words with another input. */

/* Set points in [0, 1), row by row: Sobol' points, shifted at random by the seed (Cranley and Patterson 1976). The first n
 * points do not depend on their number. Inputs beyond GSL's 40 dimensions are random. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_points(uint64_t seed, size_t points, size_t inputs, double *u);

/* Values of the functions at the points. Both arrays must outlive it. One thread at a time may use it: it caches the
 * decomposition that figures of the same inputs share. */
struct ceduo_surface;
enum ceduo_status ceduo_surface_open(const struct ceduo_input *inputs, size_t inputs_count, const double *u, size_t points,
                                     struct ceduo_surface **surface);
void ceduo_surface_free(struct ceduo_surface *surface);

/* A figure at one point for each group of the rocks. Groups have the same rocks at every point. Equal values: no noise. The
 * product of two groups has no bias by noise. */
#define CEDUO_SURFACE_GROUPS 16
struct ceduo_replicates {
    double value[CEDUO_SURFACE_GROUPS];
};

struct ceduo_share {
    double value, se; /* se: bootstrap over points and jackknife over rocks */
};

/* A figure at the points. */
struct ceduo_surface_figure {
    const struct ceduo_replicates *y; /* one per point */
    const bool *uses;                 /* inputs that it depends on; NULL: all */
    double lo, hi;                    /* bounds; surface values outside are clamped */
    double limit;                     /* compute the share of values at or below it, too; NaN: do not */
};

struct ceduo_surface_fit {
    double mean, variance; /* over the plausible cases, without sampling noise */
    double noise;          /* sampling variance of a value at a point */
    double q2;             /* share of the total variance that the surface predicts, by leave-one-out cross-validation */
    double explained;      /* share of the variance without noise that the surface explains */
    bool enough_points;    /* true if points suffice for the terms; otherwise shares are NaN */
    bool linear;           /* terms of degree 1 and their products only */
    struct ceduo_share unexplained;    /* unexplained share */
    double p5, p50, p95;               /* percentiles of the values */
    double p5_se, p95_se;              /* over other points and other rocks */
    struct ceduo_share share_below;    /* share of the values at or below the limit */
    double *values;                    /* for each point the surface plus its residual, shrunk by noise */
    struct ceduo_share *first, *total; /* for each input: alone, and with all interactions */
    double *width_if_known;            /* for each input the expected p95 - p5 if it were known; at most p95 - p5 */
};

/* Fit a figure. The caller releases *fit. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_fit(struct ceduo_surface *surface, const struct ceduo_surface_figure *figure,
                                    struct ceduo_surface_fit *fit);
void ceduo_surface_release(struct ceduo_surface_fit *fit);

/* Set only the values of n figures, one figure after the other. figure->y holds their n columns; the other members are shared.
 * changes[1] and on: the difference of the value by half of the rocks; the other half has its negative. Return CEDUO_NO_MEMORY
 * or CEDUO_OK. */
enum ceduo_status ceduo_surface_values(struct ceduo_surface *surface, const struct ceduo_surface_figure *figure, size_t n,
                                       double *values, struct ceduo_replicates *changes);

/* Set groups that have this mean, and the noise that the changes by half samples imply. */
void ceduo_replicates_from_half_samples(struct ceduo_replicates *groups, double value,
                                        const double changes[CEDUO_SURFACE_GROUPS]);

#endif
