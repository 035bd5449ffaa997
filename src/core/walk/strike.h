/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact with the ground and the hit of a stem, in one text for the walk of one rock and for lanes. */
#ifndef CEDUO_STRIKE_H
#define CEDUO_STRIKE_H

#include "ceduo/scene.h"
#include "law_arm.h"
#include "law_crsp.h"
#include "law_lumped.h"

static const struct contact_law *const contact_laws[] = {
#define X(NAME, name) &law_##name,
    CEDUO_LAWS(X)
#undef X
};

/* Velocity in the axes of a segment, of unit tangent (c, s). */
struct velocity {
    real along, off;
};

FORCE_INLINE struct velocity velocity_on(real c, real s, real vx, real vz)
{
    return (struct velocity){.along = vx * c + vz * s, .off = vz * c - vx * s};
}

/* The turn of a facet by its draw u; facets `against` the rock lie on one side only. */
FORCE_INLINE real facet_angle(bool against, real largest, real u)
{
    return largest * (against ? u : 2 * u - 1);
}

/* The facet that a rock strikes, as sine and cosine of its turn from the segment: against a rock that goes along +x, or
 * upwards with facets to both sides; the segment itself where the rock is leaving the facet. */
FORCE_INLINE void facet_struck(bool against, struct velocity v, real *sine, real *cosine)
{
    real zero = splat(0);
    if (against)
        *sine = blend(at_least(v.along, zero), *sine, -*sine);
    mask leaves = less(zero, v.off * *cosine - v.along * *sine);
    *sine = blend(leaves, zero, *sine);
    *cosine = blend(leaves, splat(1), *cosine);
}

/* Bound the loss of speed along the facet by friction times the normal impulse. Laws that scale Vt take a share of it however
 * small the normal impulse is. Spin follows the impulse of friction towards rolling, never past it. */
FORCE_INLINE struct impact bound_by_friction(struct impact in, struct impact out, const struct ground_point *at, bool spins)
{
    real limit = at->friction * (in.vn + out.vn), before = vabs(in.vt), after = vabs(out.vt);
    mask binds = less(limit, before - after);
    after = before - limit;
    if (spins) {
        real one = vcopysign(splat(1), in.vt), rim = one * (in.spin * at->radius), impulse = limit / at->k;
        rim = blend(less(rim, after), min(rim + impulse, after), max(rim - impulse, after));
        out.spin = blend(binds, one * rim / at->radius, out.spin);
    }
    out.vt = blend(binds, vcopysign(after, in.vt), out.vt);
    return out;
}

/* The contact, in the segment's axes: what a rock that rolls brings has no part off the ground, exactly, and what goes into
 * the segment is lost. */
FORCE_INLINE struct velocity strike(const struct contact_law *law, const struct ground_point *at, real sine, real cosine,
                                    struct velocity v, real *spin)
{
    real zero = splat(0), inward = v.along * sine - v.off * cosine;
    struct impact in = {.vn = blend(less(zero, inward), inward, zero), .vt = v.along * cosine + v.off * sine, .spin = *spin};
    struct impact out = law->struck(in, at);
    if (at->bound && !law->sections) /* a law of sections has friction of its own */
        out = bound_by_friction(in, out, at, law->spins);
    real off = out.vt * sine + out.vn * cosine;
    *spin = out.spin;
    return (struct velocity){.along = out.vt * cosine - out.vn * sine, .off = blend(less(zero, off), off, zero)};
}

/* ---- stems ---- */

/* A hit: the kinetic energy of the rock (J), and the energy that the stem takes of a rock that has as much (J). */
struct hit {
    real energy, cost;
};

/* J that the stem takes. */
FORCE_INLINE real energy_taken(struct hit h)
{
    return min(h.cost, h.energy);
}

/* Kinetic energy (J) of a rock in flight. */
FORCE_INLINE real flying_energy(real mass, real moment, real vx, real vz, real spin)
{
    return 0.5 * mass * (vx * vx + vz * vz) + 0.5 * moment * (spin * spin);
}

/* The share of its speed that the rock keeps, 0 where the stem stops it. */
FORCE_INLINE real speed_kept(struct hit h)
{
    real taken = energy_taken(h);
    return blend(less(taken, h.energy), vsqrt(1 - taken / h.energy), splat(0));
}

#endif
