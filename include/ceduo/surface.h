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

/* The functions at the points; both arrays must outlive it. */
struct ceduo_surface;
enum ceduo_status ceduo_surface_open(const struct ceduo_input *inputs, size_t inputs_count, const double *u, size_t points,
                                     struct ceduo_surface **surface);
void ceduo_surface_free(struct ceduo_surface *surface);

/* A figure at one point by each group of the rocks, the same rocks at every point; equal values have no noise. Products of two
 * groups carry none on the mean. */
#define CEDUO_SURFACE_GROUPS 16
struct ceduo_groups {
    double of[CEDUO_SURFACE_GROUPS];
};

struct ceduo_share {
    double value, se; /* se: of the points, by bootstrap, and of the rocks, by jackknife */
};

struct ceduo_surface_fit {
    double mean, variance;    /* over what may be true, without the noise of the rocks */
    double noise;             /* variance of a point's value by its rocks */
    double q2;                /* share of all variance that the surface predicts, leaving out one point after the other */
    double explained;         /* the same of the variance without noise */
    bool enough;              /* there are points enough for the terms; without, shares are NaN */
    struct ceduo_share whole; /* the share that the terms do not explain */
    double lo, hi;            /* bounds of the values */
    double p5, p50, p95;      /* of the values */
    double *values;           /* of each point: of the surface, and what of its remainder is not noise */
    struct ceduo_share *first, *total; /* of each input: of it alone, and of all terms that it is in */
    double *left;                      /* of each input: p95 - p5 that remains on the mean if it is known */
};

/* Fits the figure y of each point by the inputs that it may depend on (NULL: by all). A figure is never below lo nor above hi,
 * which a surface may be: its values are put there. The fit is to be released.
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_surface_fit(const struct ceduo_surface *surface, const bool *uses, const struct ceduo_groups *y,
                                    double lo, double hi, struct ceduo_surface_fit *fit);
void ceduo_surface_release(struct ceduo_surface_fit *fit);

#endif
