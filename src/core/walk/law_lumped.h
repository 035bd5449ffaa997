/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LAW_LUMPED_H
#define CEDUO_LAW_LUMPED_H

#include "impact.h"

#define LUMPED_K 9.144 /* m/s, 30 ft/s: the speed that scales Rn in Pfeiffer & Higgins 1990 */

/* A point mass: each part of the velocity keeps its own share; no spin. */
static inline struct impact law_lumped(struct impact in, const struct ground_point *at)
{
    double rn = at->rn;
    if (at->scale_rn)
        rn /= 1 + (in.vn / LUMPED_K) * (in.vn / LUMPED_K);
    return (struct impact){.vn = rn * in.vn, .vt = at->rt * in.vt, .spin = 0};
}

#endif
