/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURFACE_H
#define CEDUO_SURFACE_H

#include "ceduo/uncertainty.h"

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

/* A figure at the points. */
struct ceduo_surface_figure {
    const struct ceduo_replicates *y; /* one per point */
    const bool *uses;                 /* inputs that it depends on; NULL: all */
    double lo, hi;                    /* bounds; surface values outside are clamped */
    double limit;                     /* compute the share of values at or below it, too; NaN: do not */
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
