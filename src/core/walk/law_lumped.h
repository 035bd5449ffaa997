/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LAW_LUMPED_H
#define CEDUO_LAW_LUMPED_H

#include "impact.h"

#define LUMPED_K 9.144 /* m/s, 30 ft/s: the speed that scales Rn in Pfeiffer & Higgins 1990 */

/* A point mass: each component of the velocity is scaled; no spin. */
FORCE_INLINE struct impact lumped_struck(struct impact in, const struct ground_point *point)
{
    real rn = point->rn, s = in.vn / LUMPED_K;
    if (point->scale_rn)
        rn = rn / (1 + s * s);
    return (struct impact){.vn = rn * in.vn, .vt = point->rt * in.vt, .spin = splat(0)};
}

static const struct contact_law law_lumped = {.struck = lumped_struck};

#endif
