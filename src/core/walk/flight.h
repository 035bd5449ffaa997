/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flights from and to the line of a segment. The code serves both the scalar walk and the lanes. */
#ifndef CEDUO_FLIGHT_H
#define CEDUO_FLIGHT_H

#include <stddef.h>

#include "base/real.h"

/* A flight in the vertical plane, above `segment`. */
struct flight {
    double x, z, vx, vz;
    size_t segment;
};

/* A rock on the ground: metres from the first vertex of its segment, exactly 0 or the length at a vertex; velocity along the
 * segment and off it, m/s. */
struct contact {
    size_t segment;
    double q, along, off;
};

/* End of a flight: on the ground, or beyond an end of the profile. */
struct landing {
    double t, x, z;         /* s after the start; m, on the ground or above the profile's end */
    struct contact contact; /* on the profile */
    bool off_slope;
};

/* ---- for numbers and registers ---- */

/* Velocity in the axes of a segment, of unit tangent (c, s). */
struct velocity {
    real along, off;
};

FORCE_INLINE struct velocity velocity_on(real c, real s, real vx, real vz)
{
    return (struct velocity){.along = vx * c + vz * s, .off = vz * c - vx * s};
}

/* A segment's unit tangent along +x, and its length. */
struct axes {
    real c, s, length;
};

/* Motion of a rock on the line of a segment, as in struct contact. */
struct motion {
    real q, along, off;
};

FORCE_INLINE real height_at_time(real z, real vz, double half_g, real t)
{
    return z + (vz - half_g * t) * t;
}

/* Return the later root of c + b t - g/2 t2, without cancellation. Requires c >= 0 apart from rounding. */
FORCE_INLINE real later_root(real c, real b, real g)
{
    real zero = splat(0), d = b * b + 2 * g * c, root = vsqrt(max(d, zero));
    mask up = greater_equal(b, zero);
    real t = blend(up, b + root, 2 * c) / blend(up, g, root - b);
    return zero_if(and_not(less(b, zero), less(zero, c)), t);
}

/* Return the motion of a flight from a segment when it comes down on the line of this segment, after *t. *leaves: it flies
 * beyond an end of the segment, or through it. */
FORCE_INLINE struct motion hop(const struct axes *a, double g, struct motion m, real *t, mask *leaves)
{
    real zero = splat(0), gs = g * a->s, vx = m.along * a->c - m.off * a->s;
    *t = 2 * m.off / (g * a->c);
    real q = m.q + (m.along - 0.5 * gs * *t) * *t;
    mask forward = less(zero, vx), back = less(vx, zero), beyond = greater_equal(q, a->length), before = greater_equal(zero, q);
    *leaves = (beyond & forward) | (before & back);
    return (struct motion){.q = clamp(q, zero, a->length), .along = m.along - gs * *t, .off = -m.off};
}

/* Return the motion of a flight when it comes down on a segment, after *t, at the latest after `latest`. (dx, dz): from the
 * first vertex to the start of the flight. */
FORCE_INLINE struct motion come_down_on(const struct axes *a, double g, real dx, real dz, real vx, real vz, real latest,
                                        real *t)
{
    real gc = g * a->c, gs = g * a->s;
    struct velocity v = velocity_on(a->c, a->s, vx, vz);
    *t = min(latest, later_root(dz * a->c - dx * a->s, v.off, gc)); /* NaN possible if vx is tiny */
    real q = dx * a->c + dz * a->s + (v.along - 0.5 * gs * *t) * *t;
    return (struct motion){.q = clamp(q, splat(0), a->length), .along = v.along - gs * *t, .off = v.off - gc * *t};
}

/* Return the speed along the ground when a rock of speed `along` begins to roll without slip. */
FORCE_INLINE real rolling_speed(real along, real k, real spin, real radius)
{
    return (along + k * spin * radius) / (1 + k);
}

#endif
