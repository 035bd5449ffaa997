/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GROUPS_H
#define CEDUO_GROUPS_H

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
