/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FENCE_H
#define CEDUO_FENCE_H

#include <stddef.h>

#include "statistics.h"

/* Rocks at a net fence (struct ceduo_fence): the shares that defeat it, the fence that would be enough, and design values. */

/* Classes of ETAG 027 by the energy (MEL) of the tested kit, J. The last has no upper limit: infinite. */
#define CEDUO_FENCE_CLASSES 9
extern const double ceduo_fence_class_energy[CEDUO_FENCE_CLASSES];

/* Return the smallest class that holds an energy; -1 for NaN. */
int ceduo_fence_class(double energy);

/* Heights of a planned fence: 2, 3 … 8 m. */
#define CEDUO_FENCE_HEIGHTS 7
#define CEDUO_FENCE_LOWEST  2 /* m */

/* Shares of the released that would defeat a fence, by its height and class. */
struct ceduo_fence_grid {
    struct ceduo_estimate defeated[CEDUO_FENCE_HEIGHTS][CEDUO_FENCE_CLASSES];
    double energy[CEDUO_FENCE_HEIGHTS]; /* J: largest energy of a rock that does not pass above; 0: none */
};

/* The smallest class of a height that is enough. */
struct ceduo_fence_choice {
    unsigned height; /* m */
    int class_index; /* CEDUO_FENCE_CLASSES: no class is enough */
    double energy;   /* J: energy of the class, or for the last class the largest energy of a rock; NaN: no class is enough */
    double defeated; /* share of the released rocks; for the last class if no class is enough */
    bool decided;    /* the sampling error does not change the class */
};

/* 95th percentiles; 0 if fewer rocks arrive. */
struct ceduo_fence_load {
    double speed, energy; /* m/s; J, of translation */
    double top, middle;   /* m, perpendicular to the ground */
};

/* Rocks at a fence. Shares are of the released. */
struct ceduo_fence_arrivals {
    struct ceduo_estimate above, through, both, defeated; /* NaN: no fence, and all members but the loads are invalid */
    struct ceduo_estimate worn;           /* held with more than a third of its energy: the service energy level (SEL) */
    double by_class[CEDUO_FENCE_CLASSES]; /* defeated fences of this height */
    struct ceduo_fence_grid grid;
    struct ceduo_fence_choice enough[CEDUO_FENCE_HEIGHTS];
    double per_year, in_life; /* rocks that defeat the fence: per year; probability in its life; NaN: no blocks */
    /* `arriving`: rocks that arrive. `system`: rocks that arrive without forest; a rock that the forest stops counts as 0. NaN:
     * design values are not requested, or no rock arrives. */
    struct ceduo_fence_load arriving, system;
};

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
