/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LAW_CRSP_H
#define CEDUO_LAW_CRSP_H

#include <math.h>

#include "impact.h"

/* Pfeiffer & Higgins 1990; CRSP 3.0 (Pfeiffer et al. 1993). The speeds are 20, 30 and 250 ft/s. */
#define CRSP_A 6.096
#define CRSP_K 9.144
#define CRSP_C 76.2

static inline double crsp_friction(double rt, double slip)
{
    double s = slip / CRSP_A;
    return rt + (1 - rt) / (s * s + 1.2);
}

static inline double crsp_scaling(double rn, double rt, double vn)
{
    if (rn == 0) /* the limit of the expression below */
        return vn == 0 ? rt : 0;
    double s = vn / (CRSP_C * rn);
    return rt / (s * s + 1);
}

static inline struct impact law_crsp(struct impact in, const struct ground_point *at)
{
    double roll = in.spin * at->radius; /* speed of the rock's rim */
    double f = crsp_friction(at->rt, in.vt - roll);
    double sf = crsp_scaling(at->rn, at->rt, in.vn);
    double vt = sqrt((at->k * (roll * roll) + in.vt * in.vt) * (f * sf) / (1 + at->k));
    double s = in.vn / CRSP_K;
    vt = copysign(vt, in.vt != 0 ? in.vt : in.spin);
    return (struct impact){.vn = at->rn * in.vn / (1 + s * s), .vt = vt, .spin = vt / at->radius};
}

#endif
