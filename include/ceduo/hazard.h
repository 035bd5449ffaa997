/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HAZARD_H
#define CEDUO_HAZARD_H

#include <stdbool.h>
#include <stddef.h>

#include "statistics.h"

/* Annual frequency and energy of rocks at a control, for scenes with `blocks`. Energies in J, rates per year, with 95 %
 * intervals. */

/* Energy that is reached or exceeded once in `years`; NaN if the sample does not reach this return period. */
struct ceduo_return {
    unsigned years;
    struct ceduo_estimate energy; /* se: NaN */
};

/* Classes of intensity and of return period in Swiss practice: limits 30 and 300 kJ (BAFU 2016); 30, 100 and 300 years. */
#define CEDUO_INTENSITIES 3
#define CEDUO_RETURNS     4                                      /* and 10 years */
extern const double ceduo_intensity_from[CEDUO_INTENSITIES + 1]; /* J; the last is infinite */
extern const unsigned ceduo_return_years[CEDUO_RETURNS];

/* Return the class of an energy, 0 for the weakest; -1 for NaN. */
int ceduo_intensity_find(double energy);

struct ceduo_intensity {
    const char *word;              /* weak, medium, strong */
    double from, to;               /* J; `to` of the last is infinite */
    struct ceduo_estimate rate;    /* rocks of this intensity per year */
    double remaining_share;        /* share of the rate without forest; NaN: no such rocks without forest */
    bool of_return[CEDUO_RETURNS]; /* true if the energy of the return period has this intensity */
};

/* Energies of the curve of rates: ten per decade, 0.1 kJ to 10^6 kJ. */
#define CEDUO_HAZARD_ENERGIES 71
double ceduo_hazard_energy(size_t i);

/* Rocks that arrive with more than an energy. */
struct ceduo_hazard_point {
    double energy;
    struct ceduo_estimate rate;
};

/* Exceedance rates, up to the first energy that no rock exceeds. */
struct ceduo_hazard_curve {
    size_t count;
    struct ceduo_hazard_point points[CEDUO_HAZARD_ENERGIES];
};

struct ceduo_hazard {
    double per_year;  /* blocks that come down per year; NaN: not given, and all other members are invalid */
    double effective; /* effective sample size (Kish): (sum w)^2/sum w^2 */
    const struct ceduo_hazard_curve *curve; /* owned by struct ceduo_simulated; NULL: not read */
    struct ceduo_return returns[CEDUO_RETURNS];
    struct ceduo_estimate reach;    /* rocks that arrive */
    struct ceduo_estimate accepted; /* rocks that arrive with more than the accepted energy; NaN: none is given */
    double accepted_return;         /* years: ceduo_accepted_return() of the control */
    double remaining_share; /* ceduo_hazard_judged_rate() divided by its value without forest; NaN: that is 0 or unknown */
    struct ceduo_intensity intensity[CEDUO_INTENSITIES];
};

/* Return a hazard without values. */
struct ceduo_hazard ceduo_hazard_none(void);

/* Return the rate of harmful rocks at a control: above the accepted energy, or of any energy if none is given. */
struct ceduo_estimate ceduo_hazard_judged_rate(const struct ceduo_hazard *hazard);

/* Set `remaining_share` in `hazard` from the rates of `bare`, which may be `hazard` itself. */
void ceduo_hazard_compare(struct ceduo_hazard *hazard, const struct ceduo_hazard *bare);

#endif
