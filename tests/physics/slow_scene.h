/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slope of a scene for the slow walk, without spreads. */
#ifndef SLOW_SCENE_H
#define SLOW_SCENE_H

#include <math.h>

#include "ceduo/scene.h"
#include "slow_walk.h"

/* Fill one segment for each stretch between two vertices. A roughness in m is an angle for a rock of this radius. */
static inline void slow_segments(const struct ceduo_slope *slope, double radius, struct slow_segment *to)
{
    for (size_t j = 0; j + 1 < slope->vertices; j++) {
        const struct ceduo_segment *s = &slope->segments[j];
        to[j] = slow_segment_between(slope->x[j], slope->z[j], slope->x[j + 1], slope->z[j + 1]);
        to[j].rn = s->rn.mean;
        to[j].rt = s->rt.mean;
        to[j].friction = s->friction;
        to[j].theta_max = isnan(s->roughness_rad) ? atan(s->roughness_m / radius) : s->roughness_rad;
    }
}

#endif
