/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LAW_ARM_H
#define CEDUO_LAW_ARM_H

#include "impact.h"
#include "one_lane.h"
/* after the lane */
#include "arm_blow.h"

/* A rock that is not round, turned at random: Rn is the restitution of the work, Rt has no part in it. Nothing here knows
 * a scale of speed. */
static inline struct impact law_arm(struct impact in, const struct ground_point *at)
{
    const struct section *section = at->section;
    struct arm_blow blow = {.wide = section->wide,
                            .high = section->high,
                            .reach = section->reach,
                            .sine = at->sine,
                            .cosine = at->cosine,
                            .e = at->rn,
                            .mu = at->mu,
                            .friction = at->friction};
    struct arm_state to = {.along = in.vt, .off = -in.vn, .turn = -(in.spin * section->gyration)};
    to = arm_struck(&blow, to);
    return (struct impact){.vn = to.off, .vt = to.along, .spin = -(to.turn / section->gyration)};
}

#endif
