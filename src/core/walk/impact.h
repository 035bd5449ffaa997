/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_IMPACT_H
#define CEDUO_IMPACT_H

#include <stdbool.h>

#include "section.h"

/* One impact on the ground, in the axes of the facet. A law turns what comes in into what goes out (vn outward). */
struct impact {
    double vn, vt; /* m/s: speed into the facet (>= 0), speed along it */
    double spin;   /* rad/s, positive where the rock rolls forward */
};

/* What a law needs to know of rock and ground. */
struct ground_point {
    double rn, rt;                 /* 0…1 */
    double radius;                 /* R, m */
    double k;                      /* I/(MR2) */
    bool scale_rn;                 /* lumped only: Rn divided by 1 + (Vn/K)2 */
    double mu, friction;           /* arm only */
    const struct section *section; /* arm only, and how that is turned: */
    double sine, cosine;
};

#endif
