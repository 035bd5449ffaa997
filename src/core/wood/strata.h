/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STRATA_H
#define CEDUO_STRATA_H

#include "ceduo/adc.h"

#define HECTARE 1e4 /* m2 */

/* One term of a form's denominator: what is met as one, how wide each stands beyond the rock's own diameter, and what a
 * contact with it takes. For a rock of diameter b it is met per_ha (b + width)/HECTARE times a metre. */
struct stratum {
    double per_ha, width /* m */;
    double energy; /* J; NaN: not known, for a contact takes a share */
    double share;  /* of the energy of the rock */
};

/* The strata of a stand by a form of the ADC (not AUTO): the stools, or with gsteiger-stems each cohort of shoots, then
 * each class of trees, stumps and logs. `mass`: of the rock, kg. */
size_t ceduo_strata_count(const struct ceduo_stand *stand, enum ceduo_rule rule);
struct stratum ceduo_stratum(const struct ceduo_stand *stand, enum ceduo_rule rule, size_t i, double mass);

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
