/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_IMPACT_H
#define CEDUO_IMPACT_H

#include "base/real.h"

/* Motion at an impact, in the axes of the facet. A law maps the incoming to the outgoing motion (vn outward). */
struct impact {
    real vn, vt; /* m/s: speed into the facet (>= 0), speed along it */
    real spin;   /* rad/s, positive if the rock rolls forward */
};

/* Parameters of rock and ground for a law. */
struct ground_point {
    real rn, rt;       /* 0…1 */
    real radius;       /* R, m */
    real k;            /* I/(MR2) */
    bool scale_rn;     /* lumped only: Rn divided by 1 + (Vn/K)2 */
    bool bound;        /* see bound_by_friction() */
    real friction;     /* tan of the rolling friction angle; used only if `bound`, or by a law with sections */
    real mu;           /* Coulomb friction, only for laws with sections */
    real sine, cosine; /* orientation of the section */
    struct {
        real wide, high, reach, gyration; /* of struct section */
    } section;
};

/* A contact law of CEDUO_LAWS; law_NAME.h defines law_NAME. */
struct contact_law {
    struct impact (*struck)(struct impact in, const struct ground_point *point);
    bool spins;    /* uses spin; false: the rock is a point mass */
    bool sections; /* needs a section of the rock, with a random orientation at each contact */
};

#endif
