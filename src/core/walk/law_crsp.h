/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LAW_CRSP_H
#define CEDUO_LAW_CRSP_H

#include "impact.h"

/* 20, 30 and 250 ft/s in m/s. */
#define CRSP_A 6.096
#define CRSP_K 9.144
#define CRSP_C 76.2

FORCE_INLINE real crsp_friction(real rt, real slip)
{
    real s = slip / CRSP_A;
    return rt + (1 - rt) / (s * s + 1.2);
}

FORCE_INLINE real crsp_scaling(real rn, real rt, real vn)
{
    real s = vn / (CRSP_C * rn), zero = splat(0);
    return blend(equal(rn, zero), blend(equal(vn, zero), rt, zero), rt / (s * s + 1)); /* the limit if Rn is 0 */
}

/* Pfeiffer & Higgins 1990; CRSP 3.0 (Pfeiffer et al. 1993). */
FORCE_INLINE struct impact crsp_struck(struct impact in, const struct ground_point *point)
{
    real roll = in.spin * point->radius; /* m/s at the rim of the rock */
    real f = crsp_friction(point->rt, in.vt - roll), sf = crsp_scaling(point->rn, point->rt, in.vn), s = in.vn / CRSP_K;
    real vt = vsqrt((point->k * (roll * roll) + in.vt * in.vt) * (f * sf) / (1 + point->k));
    vt = vcopysign(vt, blend(equal(in.vt, splat(0)), in.spin, in.vt));
    return (struct impact){.vn = point->rn * in.vn / (1 + s * s), .vt = vt, .spin = vt / point->radius};
}

static const struct contact_law law_crsp = {.struck = crsp_struck, .spins = true};

#endif
