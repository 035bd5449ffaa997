/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a flight comes down on a segment, and where a roll ends on it, in one text for the walk of one rock and for lanes. */
#ifndef CEDUO_FLIGHT_H
#define CEDUO_FLIGHT_H

#include <stddef.h>

#include "base/real.h"

/* A flight in the vertical plane. On the ground it starts on segment `segment` itself. */
struct flight {
    double x, z, vx, vz;
    size_t segment;
    bool on_ground;
};

/* Where a flight ends: on the ground, or beyond an end of the profile. */
struct landing {
    double t, x, z; /* s after the start; the point, on the ground or above the profile's end */
    size_t segment;
    bool left;
};

/* ---- the text ---- */

/* A segment of the ground. */
struct chord {
    real x0, z0, x1, z1, m;
};

FORCE_INLINE real height_after(real z, real vz, double half_g, real t)
{
    return z + (vz - half_g * t) * t;
}

/* The later root of c + b t - g/2 t2, in the form that does not cancel; c >= 0 but for rounding. */
FORCE_INLINE real later_root(real c, real b, double g)
{
    real zero = splat(0), d = b * b + 2 * g * c, root = blend(less(zero, d), vsqrt(d), zero);
    mask up = at_least(b, zero);
    real t = blend(up, b + root, 2 * c) / blend(up, splat(g), root - b);
    return blend(up | less(zero, c), t, zero);
}

/* The height of a chord at x on it. */
FORCE_INLINE real chord_height(const struct chord *s, real x)
{
    return blend(at_least(x, s->x1), s->z1, s->z0 + s->m * (x - s->x0));
}

/* Onto the chord from nearby: where that is steeper than 45 degrees z is kept and x follows, elsewhere the other way. `some`
 * of them are `steep`; these end in their upper vertex, exactly, where `ends`. */
FORCE_INLINE void onto_chord(const struct chord *s, mask steep, bool some, bool ends, real *x, real *z)
{
    real flat_x = clamp(*x, s->x0, s->x1), flat_z = chord_height(s, flat_x);
    if (some) {
        real steep_z = clamp(*z, min(s->z0, s->z1), max(s->z1, s->z0));
        real steep_x = clamp(s->x0 + (steep_z - s->z0) / s->m, s->x0, s->x1);
        if (ends)
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

/* The speed along the ground once a rock that comes with speed `along` rolls without slip. */
FORCE_INLINE real rolling_speed(real along, real k, real spin, real radius)
{
    return (along + k * spin * radius) / (1 + k);
}

#endif
