/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CONTACT_H
#define CEDUO_CONTACT_H

#include <stdbool.h>

/* The laws of an impact on the ground. A new law is a file like src/core/law_crsp.h and a line here. */
#define CEDUO_LAWS(X) \
    X(LUMPED, lumped) \
    X(CRSP, crsp)

enum ceduo_law {
#define X(NAME, name) CEDUO_LAW_##NAME,
    CEDUO_LAWS(X)
#undef X
        CEDUO_LAW_COUNT
};

/* One impact, in the axes of the facet. */
struct ceduo_impact {
    double vn, vt; /* m/s: speed into the facet (>= 0), speed along it */
    double spin;   /* rad/s, positive where the rock rolls forward */
};

/* What the law needs to know of rock and ground. */
struct ceduo_ground_point {
    double rn, rt;   /* 0…1 */
    double radius;   /* R, m */
    double k;        /* I/(MR2) */
    bool scale_rn;   /* lumped only: Rn divided by 1 + (Vn/K)2 */
};

/* The impact law of `law`: what comes in → what goes out (vn outward). crsp: Pfeiffer & Higgins 1990, CRSP 3.0. */
struct ceduo_impact ceduo_contact(enum ceduo_law law, struct ceduo_impact in, const struct ceduo_ground_point *at);

/* crsp's two factors, for those who want to see them: friction f and scaling SF. */
double ceduo_crsp_friction(double rt, double slip);
double ceduo_crsp_scaling(double rn, double rt, double vn);

#endif
