/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HAZARD_H
#define CEDUO_HAZARD_H

#include "ceduo/simulate.h"

/* Limits of the classes of intensity, and return periods in years. */
extern const double ceduo_intensity_from[CEDUO_INTENSITIES + 1]; /* J; the last is infinite */
extern const unsigned ceduo_return_years[CEDUO_RETURNS];

/* Return the class of an energy, 0 for the weakest; -1 for NaN. */
int ceduo_intensity_find(double energy);

/* Return energy i of the curve, J. */
double ceduo_hazard_energy(size_t i);

/* Return a hazard without values. */
struct ceduo_hazard ceduo_hazard_none(void);

/* Return the rate of harmful rocks at a control: above the accepted energy, or of any energy if none is given. */
struct ceduo_estimate ceduo_hazard_judged_rate(const struct ceduo_hazard *hazard);

/* Set `remaining_share` in `hazard` from the rates of `bare`, which may be `hazard` itself. */
void ceduo_hazard_compare(struct ceduo_hazard *hazard, const struct ceduo_hazard *bare);

#endif
