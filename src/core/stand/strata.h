/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STRATA_H
#define CEDUO_STRATA_H

#include "ceduo/adc.h"

#define HECTARE 1e4 /* m2 */

/* m that a log of `length` m offers beyond the rock's diameter, at a random angle (Buffon): 2 L/pi. */
double ceduo_log_width(double length);

/* Groups of n trees, each uniform in a disc of radius r around a centre; centres are a Poisson process in the plane. What
 * a strip of width w (the rock's diameter and a tree's) meets of them. */
struct group_shape {
    double n, radius, width;
};

/* Groups of which at least one tree is met, for one centre to the square metre: of all on `length` m of a strip that goes
 * on in both directions; of all in the plane on a strip that is so long and no longer. */
double ceduo_groups_met_along(const struct group_shape *shape, double length);
double ceduo_groups_met_within(const struct group_shape *shape, double length);

#endif
