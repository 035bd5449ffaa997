/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FOREST_H
#define CEDUO_FOREST_H

#include "core/stand/energy.h"

/* An option's forest, prepared belt by belt for drawing stems. */

/* Stems of one kind: a cohort of shoots, a class of trees, stumps or logs. */
struct forest_kind {
    /* Inputs, hashed by ceduo_forest_hash(): */
    double dbh;          /* m, mean; NaN: a log */
    double height;       /* m */
    double hit_below;    /* m: a hit takes no energy if the rock's centre is higher; infinite: no limit */
    double energy;       /* J per hit; NaN: depends on diameter or eccentricity, see hit_energy */
    double shape, scale; /* of the gamma distribution of diameters; shape 0: all equal */
    double share_to;     /* of shoots: cumulative share up to this cohort */
    /* Derived, or hashed separately: */
    double dbh_max; /* m: maximum dbh */
    struct stem_energy hit_energy;
    /* Derived: */
    double full_energy;   /* J that a centred hit of the mean stem takes */
    bool by_eccentricity; /* a hit takes the share ceduo_dorren_share() of it */
};

/* A Poisson process along x with base_rate + rate_per_b·b encounters per metre, for a rock of diameter b. */
struct forest_stratum {
    double base_rate, rate_per_b;   /* 1/m; 1/m2; hashed */
    const struct forest_kind *kind; /* NULL: stools */
    unsigned group;                 /* trees per group; 0: not grouped */
    double radius;                  /* m: radius of the disc of a group */
};

#define FOREST_RING_STEP 8 /* shoots of a ring that may be read at once */

/* The stools of a belt: a ring of n shoots, or of n + 1 with probability extra_chance. */
struct forest_stools {
    unsigned n;
    double extra_chance;
    double radius[2];      /* m: of the rings of n and n + 1 */
    const double *ring[2]; /* cosines of the shoots' angles, then, at ring_capacity, their sines */
    size_t ring_capacity;  /* a multiple of FOREST_RING_STEP, above n + 1 */
    double turn[2];        /* range of the random rotation of a ring, 2 pi/n; 0 for one shoot */
    double reach;          /* m: the larger radius */
    double dbh_max;        /* m: maximum dbh */
    bool dbh_varies;       /* diameters vary within a cohort */
    size_t cohorts;
    const struct forest_kind *kinds;
};

struct forest_belt {
    double from, to; /* m: x on side 0, -x on side 1 */
    const struct forest_stratum *strata;
    size_t strata_count;
    const struct forest_stools *stools; /* NULL: none */
};

struct forest {
    bool bare;            /* no contacts are possible */
    bool by_eccentricity; /* the energy of some kinds depends on eccentricity */
    size_t belts;
    struct forest_belt *sides[2]; /* belts for rocks moving along +x and -x, in the order they are reached */
    double reach;                 /* m: maximum radius of the rings */
    bool grouped;                 /* there are groups of trees */
    double group_reach;           /* m: maximum radius of the groups */
    double tallest;               /* m: maximum height of shoots and trees of groups */
    size_t met_mask;              /* 2^k - 1: size of stems.hit_stools, far more than the stools in reach of a rock */
    struct forest_kind *kinds;
    struct forest_stratum *strata_buffer;
    struct forest_stools *stools;
    double **rings;
};

/* Prepare a forest for the contact model of `simulation`. It is bare with `index`, or without an option. `mean`: the mean rock.
 * False without memory. */
bool ceduo_forest_init(struct forest *forest, const struct ceduo_simulation *simulation, const struct ceduo_option *option,
                       const struct ceduo_rock *mean);
void ceduo_forest_release(struct forest *forest);

/* Mix the inputs of such a forest into a hash. False if it is bare. */
bool ceduo_forest_hash(uint64_t *hash, const struct ceduo_simulation *simulation, const struct ceduo_option *option);

#endif
