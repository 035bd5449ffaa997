/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WOOD_H
#define CEDUO_WOOD_H

#include "ceduo/scene.h"
#include "core/stand/energy.h"

/* An option's forest, prepared for many rocks: what drawing stems needs, belt by belt. */

/* Stems of one kind as rocks meet them: a cohort of shoots, a class of trees, stumps or logs. */
struct wood_kind {
    /* Doubles that decide what a rock meets: ceduo_wood_hash() lists them. */
    double dbh;          /* m, mean; NaN: a log */
    double height;       /* m */
    double below;        /* m: a hit takes nothing where the rock's centre is higher; infinite: any takes */
    double energy;       /* J that every hit takes; NaN: it depends on diameter or eccentricity, by_hit */
    double shape, scale; /* of the gamma law of diameters; shape 0: all alike */
    double share_to;     /* of shoots: the share of all that this cohort and those before it make up */
    /* Of those, or hashed in their own way. */
    double most; /* m: no stem is thicker */
    struct stem_energy by_hit;
    /* Made from those. */
    double whole;         /* J that a hit of the mean stem takes; */
    bool by_eccentricity; /* of that the share that ceduo_dorren_share() says */
};

/* What is met at random places along x: so many per metre for a rock of diameter b: still + per_b·b. */
struct wood_stratum {
    double still, per_b;          /* hashed as they stand */
    const struct wood_kind *kind; /* NULL: stools */
    unsigned group;               /* trees of a group; 0: each by itself */
    double radius;                /* m: of the disc in which they stand */
};

#define WOOD_RING_STEP 8 /* shoots of a ring may be read so many at a time */

/* The stools of a belt: a ring of n shoots, or with chance `greater_ints` of one shoot more. */
struct wood_stools {
    unsigned n;
    double more;
    double radius[2];      /* m: of the ring of n, of n + 1 */
    const double *ring[2]; /* cosines of the shoots' places on it, then, at ring_room, their sines */
    size_t ring_room;      /* a multiple of WOOD_RING_STEP, beyond n + 1 */
    double turn[2];        /* by how much a ring is turned at random, 2 pi/n; 0 for one shoot */
    double reach;          /* m: the larger radius */
    double most;           /* m: no shoot is thicker */
    bool spread;           /* diameters do */
    size_t cohorts;
    const struct wood_kind *kinds;
};

struct wood_belt {
    double from, to; /* m: x for a rock going +x, -x for one going back */
    const struct wood_stratum *strata;
    size_t strata_count;
    const struct wood_stools *stools; /* NULL: none */
};

struct wood {
    bool bare;            /* nothing to be met */
    bool by_eccentricity; /* what stems of some kinds take depends on where they are hit */
    size_t belts;
    struct wood_belt *along[2]; /* the same belts for rocks going +x and -x, in the order they are reached */
    double reach;               /* m: the largest radius of any ring */
    bool grouped;               /* there are groups of trees */
    double group_reach;         /* m: the largest radius of any of those */
    double tallest;             /* m: no shoot, nor tree of a group, is taller */
    size_t places;              /* 2^k - 1: far more stools than a rock can be among at a time */
    struct wood_kind *kinds;
    struct wood_stratum *strata_room;
    struct wood_stools *stools;
    double **rings;
};

/* For the contact model of `simulation`; with `index`, or without an option, there is nothing to be met. `mean`:
 * the mean rock. False without memory. */
bool ceduo_wood_init(struct wood *wood, const struct ceduo_simulation *simulation, const struct ceduo_option *option,
                     const struct ceduo_rock *mean);
void ceduo_wood_release(struct wood *wood);

/* Mixes in what such a forest would be made of; false where there is nothing to be met. */
bool ceduo_wood_hash(uint64_t *hash, const struct ceduo_simulation *simulation, const struct ceduo_option *option);

#endif
