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

#endif
