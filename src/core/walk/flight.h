/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Landing of a flight on a segment, and end of a roll on it. The code serves both the scalar walk and the lanes. */
#ifndef CEDUO_FLIGHT_H
#define CEDUO_FLIGHT_H

#include <stddef.h>

#include "base/real.h"

/* A flight in the vertical plane. If on_ground, it starts on the ground of `segment`. */
struct flight {
    double x, z, vx, vz;
    size_t segment;
    bool on_ground;
};

/* End of a flight: on the ground, or beyond an end of the profile. */
struct landing {
    double t, x, z; /* s after the start; m, on the ground or above the profile's end */
    size_t segment;
    bool off_slope;
};

/* ---- for numbers and registers ---- */

/* A segment of the ground. */
struct chord {
    real x0, z0, x1, z1, m;
};

FORCE_INLINE real height_at_time(real z, real vz, double half_g, real t)
{
    return z + (vz - half_g * t) * t;
}

/* Return the later root of c + b t - g/2 t2, without cancellation. Requires c >= 0 apart from rounding. */
FORCE_INLINE real later_root(real c, real b, double g)
{
    real zero = splat(0), d = b * b + 2 * g * c, root = blend(less(zero, d), vsqrt(d), zero);
    mask up = greater_equal(b, zero);
    real t = blend(up, b + root, 2 * c) / blend(up, splat(g), root - b);
    return blend(up | less(zero, c), t, zero);
}

/* Return the height of a chord at x. Requires x on the chord. */
FORCE_INLINE real chord_height(const struct chord *s, real x)
{
    return blend(greater_equal(x, s->x1), s->z1, s->z0 + s->m * (x - s->x0));
}

/* Move a nearby point onto the chord: keep x, or z if the chord is steeper than 45 degrees (`steep`), and compute the other
 * coordinate. `any_steep`: some lane is steep. `snap_upper`: a steep point at the height of vertex 1 becomes vertex 1. */
FORCE_INLINE void snap_to_chord(const struct chord *s, mask steep, bool any_steep, bool snap_upper, real *x, real *z)
{
    real flat_x = clamp(*x, s->x0, s->x1), flat_z = chord_height(s, flat_x);
    if (any_steep) {
        real steep_z = clamp(*z, min(s->z0, s->z1), max(s->z1, s->z0));
        real steep_x = clamp(s->x0 + (steep_z - s->z0) / s->m, s->x0, s->x1);
        if (snap_upper)
            steep_x = blend(equal(steep_z, s->z1), s->x1, steep_x);
        flat_x = blend(steep, steep_x, flat_x);
        flat_z = blend(steep, steep_z, flat_z);
    }
    *x = flat_x;
    *z = flat_z;
}

FORCE_INLINE mask is_steep(real m)
{
    return less(splat(1), vabs(m));
}

/* Return the speed along the ground when a rock of speed `along` begins to roll without slip. */
FORCE_INLINE real rolling_speed(real along, real k, real spin, real radius)
{
    return (along + k * spin * radius) / (1 + k);
}

#endif
