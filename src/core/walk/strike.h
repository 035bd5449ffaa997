/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A contact with the ground and a hit of a stem. The code serves both the scalar walk and the lanes. */
#ifndef CEDUO_STRIKE_H
#define CEDUO_STRIKE_H

#include "ceduo/scene.h"
#include "flight.h"
#include "law_arm.h"
#include "law_crsp.h"
#include "law_lumped.h"

static const struct contact_law *const contact_laws[] = {
#define X(NAME, name) &law_##name,
    CEDUO_LAWS(X)
#undef X
};

/* Return the angle of a facet by its draw u. Facets `against` the rock have one sign only. */
FORCE_INLINE real facet_angle(bool against, real largest, real u)
{
    return largest * (against ? u : 2 * u - 1);
}

/* Set the struck facet, as sine and cosine of its angle to the segment. It faces a rock along +x, or is turned upward with
 * facets to both sides. If the rock moves away from the facet, it strikes the segment itself. */
FORCE_INLINE void facet_struck(bool against, struct velocity v, real *sine, real *cosine)
{
    real zero = splat(0);
    if (against)
        *sine = blend(greater_equal(v.along, zero), *sine, -*sine);
    mask leaves = less(zero, v.off * *cosine - v.along * *sine);
    *sine = zero_if(leaves, *sine);
    *cosine = blend(leaves, splat(1), *cosine);
}

/* Bound the loss of speed along the facet by friction times the normal impulse. Laws that scale Vt take a share of it even for
 * a tiny normal impulse. The impulse of friction changes spin towards rolling, never beyond. */
FORCE_INLINE struct impact bound_by_friction(struct impact in, struct impact out, const struct ground_point *point, bool spins)
{
    real limit = point->friction * (in.vn + out.vn), before = vabs(in.vt), after = vabs(out.vt);
    mask binds = less(limit, before - after);
    after = before - limit;
    if (spins) {
        real one = vcopysign(splat(1), in.vt), rim = one * (in.spin * point->radius), impulse = limit / point->k;
        rim = blend(less(rim, after), min(rim + impulse, after), max(rim - impulse, after));
        out.spin = blend(binds, one * rim / point->radius, out.spin);
    }
    out.vt = blend(binds, vcopysign(after, in.vt), out.vt);
    return out;
}

/* Return the velocity after a contact, in the segment's axes. A rolling rock has no speed off the ground. Speed into the ground
 * is lost. */
FORCE_INLINE struct velocity strike(const struct contact_law *law, const struct ground_point *point, real sine, real cosine,
                                    struct velocity v, real *spin)
{
    real zero = splat(0), inward = v.along * sine - v.off * cosine;
    struct impact in = {.vn = max(inward, zero), .vt = v.along * cosine + v.off * sine, .spin = *spin};
    struct impact out = law->struck(in, point);
    if (point->bound && !law->sections) /* a law with sections has its own friction */
        out = bound_by_friction(in, out, point, law->spins);
    real off = out.vt * sine + out.vn * cosine;
    *spin = out.spin;
    return (struct velocity){.along = out.vt * cosine - out.vn * sine, .off = max(off, zero)};
}

/* ---- stems ---- */

/* A hit: J, kinetic energy of the rock; J that the stem takes, if the rock has as much. */
struct hit {
    real energy, cost;
};

/* Return the energy (J) that the stem takes. */
FORCE_INLINE real energy_taken(struct hit h)
{
    return min(h.cost, h.energy);
}

/* Return the kinetic energy (J) of a rock in flight. */
FORCE_INLINE real flying_energy(real mass, real moment, real vx, real vz, real spin)
{
    return 0.5 * mass * (vx * vx + vz * vz) + 0.5 * moment * (spin * spin);
}

/* Return the remaining share of the rock's speed, 0 if the stem stops it. */
FORCE_INLINE real speed_kept(struct hit h)
{
    real taken = energy_taken(h);
    return blend(less(taken, h.energy), vsqrt(1 - taken / h.energy), splat(0));
}

#endif
