/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROCK_H
#define CEDUO_ROCK_H

#include "ceduo/scene.h"

/* Return the smallest and the largest value that can be drawn. */
double ceduo_number_min(struct ceduo_number n);
double ceduo_number_max(struct ceduo_number n);

/* Return quantile u (0 < u < 1) of the distribution, truncated to [lo, hi] as well. One draw replaces rejection sampling.
 * Requires that [lo, hi] overlaps the range of the distribution. */
double ceduo_number_draw(struct ceduo_number n, double u, double lo, double hi);

/* Compute the rock of mean sizes. CEDUO_BAD_ROCK if a size is missing or not above 0. */
enum ceduo_status ceduo_rock_from_means(const struct ceduo_rock_def *def, struct ceduo_rock *rock);

/* True if some size has a spread. */
bool ceduo_rock_varies(const struct ceduo_rock_def *def);

/* Compute the rock whose sizes are the quantiles u[0…7] of diameter, height, volume, mass, density and the three axes. */
enum ceduo_status ceduo_rock_draw(const struct ceduo_rock_def *def, const double u[8], struct ceduo_rock *rock);

#endif
