/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FENCE_H
#define CEDUO_FENCE_H

#include "ceduo/simulate.h"

/* Energies of the classes, J; the last is infinite. */
extern const double ceduo_fence_class_energy[CEDUO_FENCE_CLASSES];

/* Return the smallest class that holds an energy; -1 for NaN. */
int ceduo_fence_class(double energy);

/* Return arrivals without values. */
struct ceduo_fence_arrivals ceduo_fence_none(void);

/* Choose the smallest class for each height at which at most `limit` of the released defeat the fence. */
void ceduo_fence_choose(const struct ceduo_fence_grid *grid, double limit,
                        struct ceduo_fence_choice choices[CEDUO_FENCE_HEIGHTS]);

/* Return the choice of the smallest class, among equal classes the lowest; NULL if no class of any height is enough. */
const struct ceduo_fence_choice *ceduo_fence_smallest(const struct ceduo_fence_choice choices[CEDUO_FENCE_HEIGHTS]);

/* Partial factors of UNI 11211-4. */
struct ceduo_fence_factors {
    double survey, model, blocks; /* 1.02 or 1.10 */
    double energy;                /* factor of the energy of the fence; NaN: not given */
};

/* Design values of a fence. */
struct ceduo_fence_design {
    double speed, energy, height;    /* m/s; J; m, perpendicular to the ground */
    int class_index, class_factored; /* smallest class without and with `energy` of the factors; -1: unknown, or no load */
};

#define CEDUO_FENCE_FREE 0.5 /* m: minimum distance from the middle of a rock to the upper edge */

struct ceduo_fence_design ceduo_fence_design(const struct ceduo_fence_load *load, const struct ceduo_fence_factors *factors);

/* The years ahead at a fence. */
struct ceduo_fence_years {
    size_t years;                /* simulated; 0: unknown */
    struct ceduo_estimate mean;  /* defeated share; the interval is an upper bound */
    struct ceduo_estimate worst; /* defeated share of the worst year */
    unsigned worst_year;
    size_t failing;                                        /* years above the limit */
    double per_year, in_life;                              /* mean over the years; NaN: no blocks */
    struct ceduo_fence_choice enough[CEDUO_FENCE_HEIGHTS]; /* today and in all years */
    struct ceduo_fence_load arriving, system;              /* largest of all years */
    size_t exceptions;                                     /* years that need more than today's smallest choice */
    unsigned first_exception, last_exception;
};

#endif
