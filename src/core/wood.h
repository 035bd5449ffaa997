/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WOOD_H
#define CEDUO_WOOD_H

#include "ceduo/scene.h"

/* An option's forest made ready for many rocks: what the drawing of stems needs, belt by belt. */

/* Stems of one kind as rocks meet them: a cohort of shoots, a class of trees, or all that one stratum of a form of the
 * ADC stands for. */
struct wood_kind {
    const struct ceduo_stand *stand; /* NULL: a contact of a Poisson process, always with the same energy */
    const struct ceduo_stems *stems;
    double dbh;     /* m, mean */
    double most;    /* m: no stem is thicker */
    double height;  /* m; infinite where height does not matter */
    double energy;  /* J that every hit takes; NaN: it depends on diameter or eccentricity */
    double shape, scale; /* of the gamma law of diameters; shape 0: all alike */
    double share_to;     /* of shoots: the share of all that this cohort and those before it make up */
};

/* What is met at random places along the way: so many per metre for a rock of diameter b: still + per_b·b. */
struct wood_stratum {
    double still, per_b;
    const struct wood_kind *kind; /* NULL: stools */
};

/* The stools of a belt: a ring of n shoots, or with chance `more` of one shoot more. */
struct wood_stools {
    unsigned n;
    double more;
    double radius[2];      /* m: of the ring of n, of n + 1 */
    const double *ring[2]; /* cosine and sine of each shoot's place on it */
    double reach;          /* m: the larger radius */
    double most;           /* m: no shoot is thicker */
    size_t cohorts;
    const struct wood_kind *kinds;
};

struct wood_belt {
    double from, to; /* m along the way: x going +x, -x going the other way */
    const struct wood_stratum *strata;
    size_t strata_count;
    const struct wood_stools *stools; /* NULL: none */
};

struct wood {
    bool bare; /* nothing to be met */
    size_t belts;
    struct wood_belt *along[2]; /* the same belts for a way along +x and along -x, in the order they are come to */
    size_t strata;              /* the most of any belt */
    double reach;               /* m: the largest radius of any ring */
    struct wood_kind *kinds;
    struct wood_stratum *strata_room;
    struct wood_stools *stools;
    double **rings;
};

/* For the contact model of `simulation`; with `index`, or without an option, there is nothing to be met. `b`: mean
 * diameter of the mean rock, which decides the rule of `poisson`. False without memory. */
bool ceduo_wood_init(struct wood *wood, const struct ceduo_simulation *simulation, const struct ceduo_option *option,
                     double b);
void ceduo_wood_release(struct wood *wood);

#endif
