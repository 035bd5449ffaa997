/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_IMPACT_H
#define CEDUO_IMPACT_H

#include "base/real.h"

/* One impact on the ground, in the axes of the facet. A law turns what comes in into what goes out (vn outward). */
struct impact {
    real vn, vt; /* m/s: speed into the facet (>= 0), speed along it */
    real spin;   /* rad/s, positive where the rock rolls forward */
};

/* What a law needs to know of rock and ground. */
struct ground_point {
    real rn, rt;   /* 0…1 */
    real radius;   /* R, m */
    real k;        /* I/(MR2) */
    bool scale_rn; /* lumped only: Rn divided by 1 + (Vn/K)2 */
    bool bound;    /* by friction: see bound_by_friction() */
    real friction; /* tan of an angle; unused unless `bound`, or the law has sections */
    real mu;       /* of laws of sections, which are turned: */
    real sine, cosine;
    struct {
        real wide, high, reach, gyration; /* of struct section */
    } section;
};

/* A law of contacts, of CEDUO_LAWS: a header law_NAME.h defines law_NAME. */
struct contact_law {
    struct impact (*struck)(struct impact in, const struct ground_point *at);
    bool spins;    /* it knows spin; otherwise the rock is a point mass */
    bool sections; /* it needs a section of the rock, turned at random at each contact */
};

#endif
