/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURFACE_H
#define CEDUO_SURFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "status.h"

struct ceduo_input;

/* How a figure depends on inputs that are not known, from its values at some hundred points: a least-squares surface of
 * functions that are orthonormal over what the inputs may be (Sudret 2008; Le Gratiet, Marelli and Sudret 2017). The square
 * of a coefficient is then the variance that its term brings, and the shares of the inputs are sums of such squares.
 *
 * Functions of one input, whose quantile is u: of a range the Legendre polynomials of 2u - 1 of degree 1 and 2; of words
 * contrasts; of the rows of a calibration its values, made orthonormal over the rows, and their squares. Terms: all of these,
 * products of functions of degree 1 of two inputs, and products of two words with another input. */

/* Points in [0, 1), row by row: Sobol' points, shifted at random by the seed (Cranley and Patterson 1976). The first n of
 * more points are the same. Inputs beyond GSL's 40 coordinates are drawn. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_points(uint64_t seed, size_t points, size_t inputs, double *u);

/* The functions at the points; both arrays must outlive it. One thread at a time uses it, as it keeps what the figures of the same
 * inputs have in common. */
struct ceduo_surface;
enum ceduo_status ceduo_surface_open(const struct ceduo_input *inputs, size_t inputs_count, const double *u, size_t points,
                                     struct ceduo_surface **surface);
void ceduo_surface_free(struct ceduo_surface *surface);

/* A figure at one point by each group of the rocks, the same rocks at every point; equal values have no noise. Products of two
 * groups carry none on the mean. */
#define CEDUO_SURFACE_GROUPS 16
struct ceduo_replicates {
    double of[CEDUO_SURFACE_GROUPS];
};

struct ceduo_share {
    double value, se; /* se: of the points, by bootstrap, and of the rocks, by jackknife */
};

/* A figure at the points. */
struct ceduo_surface_figure {
    const struct ceduo_replicates *y; /* of each point */
    const bool *uses;                 /* the inputs that it may depend on; NULL: all */
    double lo, hi;                    /* it is never below nor above, which a surface may be: its values are put there */
    double limit;                     /* how many values are at most this is read as well; NaN: it is not */
};

struct ceduo_surface_fit {
    double mean, variance;    /* over what may be true, without the noise of the rocks */
    double noise;             /* variance of a point's value by its rocks */
    double q2;                /* share of all variance that the surface predicts, leaving out one point after the other */
    double explained;         /* the same of the variance without noise */
    bool enough;              /* there are points enough for the terms; without, shares are NaN */
    bool linear;              /* with terms of degree 1 alone, and products of them */
    struct ceduo_share whole; /* the share that the terms do not explain */
    double p5, p50, p95;      /* of the values */
    double p5_se, p95_se;     /* of other points and other rocks */
    struct ceduo_share below; /* of the values the share that is at most the limit */
    double *values;           /* of each point: of the surface, and what of its remainder is not noise */
    struct ceduo_share *first, *total; /* of each input: of it alone, and of all terms that it is in */
    double *left;                      /* of each input: p95 - p5 that remains on the mean if it is known; at most p95 - p5 */
};

/* Fits a figure by its inputs. The fit is to be released. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_fit(struct ceduo_surface *surface, const struct ceduo_surface_figure *figure,
                                    struct ceduo_surface_fit *fit);
void ceduo_surface_release(struct ceduo_surface_fit *fit);

/* The values of n figures alone, at the points of one after the other: those of fits by the same terms. Of the figure only y is
 * others', row by row. `changes`: in 1 and on how much higher the value of half of the rocks is; that of the other half is as much
 * lower. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_values(struct ceduo_surface *surface, const struct ceduo_surface_figure *figure, size_t n,
                                       double *values, struct ceduo_replicates *changes);

/* Groups with this mean, and with the noise that such changes by halves of the rocks say. */
void ceduo_replicates_from_half_samples(struct ceduo_replicates *groups, double value,
                                        const double changes[CEDUO_SURFACE_GROUPS]);

#endif
