/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HAZARD_H
#define CEDUO_HAZARD_H

#include <stdbool.h>
#include <stddef.h>

#include "statistics.h"

/* How often, and with how much: what arrives at a control in a year where the scene says which blocks come down. Energies
 * in J, rates in events a year, each with its 95 % interval. */

/* Energy that is reached or exceeded once in some years; NaN if the sample does not reach so far. */
struct ceduo_return {
    unsigned years;
    struct ceduo_estimate energy; /* se: NaN */
};

/* Classes of intensity and of return period of Swiss practice: below 30 kJ, 30 to 300 kJ, above 300 kJ (BAFU 2016); to 30,
 * to 100, to 300 years. */
#define CEDUO_INTENSITIES 3
#define CEDUO_RETURNS     4                                      /* 10 years beside them */
extern const double ceduo_intensity_from[CEDUO_INTENSITIES + 1]; /* J; the last is infinite */
extern const unsigned ceduo_return_years[CEDUO_RETURNS];

/* The class of an energy, 0 the weakest; -1 of NaN. */
int ceduo_intensity_find(double energy);

struct ceduo_intensity {
    const char *word;              /* weak, medium, strong */
    double from, to;               /* J; to: infinite of the last */
    struct ceduo_estimate within;  /* rocks of this intensity a year */
    double left;                   /* share of those without forest; NaN: there are none */
    bool of_return[CEDUO_RETURNS]; /* whether the energy of that return period is of this intensity */
};

/* Energies at which the curve of rates is given: ten to a decade, 0.1 kJ to 10^6 kJ. */
#define CEDUO_HAZARD_ENERGIES 71
double ceduo_hazard_energy(size_t i);

/* Rocks that arrive with more than an energy. */
struct ceduo_exceeding {
    double energy;
    struct ceduo_estimate rate;
};

/* Rates of exceeding energies, up to the first that no rock exceeds. */
struct ceduo_hazard_curve {
    size_t count;
    struct ceduo_exceeding at[CEDUO_HAZARD_ENERGIES];
};

struct ceduo_hazard {
    double per_year;  /* blocks that come down a year; NaN: the scene does not say, and nothing else holds */
    double effective; /* effective sample size (Kish): (sum w)^2/sum w^2 */
    const struct ceduo_hazard_curve *curve; /* of the struct ceduo_simulated that holds it; NULL: not read */
    struct ceduo_return returns[CEDUO_RETURNS];
    struct ceduo_estimate reach;    /* rocks that arrive */
    struct ceduo_estimate accepted; /* rocks that arrive with more than the accepted energy; NaN: none is given */
    double accepted_return;         /* years: ceduo_accepted_return() of the control */
    double left;                    /* share of the rate without forest of what is feared; NaN: it is 0 there, or not known */
    struct ceduo_intensity intensity[CEDUO_INTENSITIES];
};

/* Nothing is known. */
struct ceduo_hazard ceduo_hazard_none(void);

/* The rate of what is feared at a place: more than it accepts, or any rock where that is not said. */
struct ceduo_estimate ceduo_hazard_feared(const struct ceduo_hazard *hazard);

/* Sets what is left of the rates of `bare`, which may be the same. */
void ceduo_hazard_compare(struct ceduo_hazard *hazard, const struct ceduo_hazard *bare);

#endif
