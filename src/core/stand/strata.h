/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STRATA_H
#define CEDUO_STRATA_H

#define HECTARE 1e4 /* m2 */

/* Return the mean width (m) of a log of `length` m at a random angle, in addition to the rock's diameter (Buffon): 2 L/pi. */
double ceduo_log_width(double length);

/* Groups of n trees, each tree uniform in a disc of radius r around a centre. Centres are a Poisson process in the plane. A
 * strip has the width of the rock plus the diameter of a tree. */
struct group_shape {
    double n, radius, width;
};

/* Return the number of groups with at least one tree in the strip, for one centre per square metre: _along per `length` m of an
 * infinite strip; _within for all groups of the plane and a strip of finite length. */
double ceduo_groups_met_along(const struct group_shape *shape, double length);
double ceduo_groups_met_within(const struct group_shape *shape, double length);

#endif
