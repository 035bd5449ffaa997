/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From one contact of the lanes to the next, in flight or rolling: what landing.h and rolling.h do for one rock. */
#ifndef CEDUO_LANES_LANDING_H
#define CEDUO_LANES_LANDING_H

#include "lanes_far.h"

/* ---- landing ---- */

/* Flights that are above a vertex, on to the next. */
struct search {
    ints vertex, step;
    real x, z, vz, inv;
    mask going;
};

FORCE_INLINE void search_on(struct form form, const struct lanes *k, struct search *s)
{
    ints next = s->vertex + s->step;
    real x, z;
    look_up(&k->ground->place, form.small && LOOK_UP_WRAPS ? next : blend_ints(s->going, next, s->vertex), form.small, &x, &z);
    real t = (x - s->x) * s->inv;
    s->going &= at_least(height_after(s->z, s->vz, k->g->half_g, t) - z, splat(0));
    s->vertex = blend_ints(s->going, next, s->vertex);
}

/* A search as it stands, of the lanes from i on; `going` of them still are above theirs. */
FORCE_INLINE struct search search_of(const struct lanes *k, size_t i, unsigned going)
{
    mask forth = less(splat(0), load(&k->vx[i]));
    return (struct search){.vertex = load_ints(&k->vertex[i]),
                           .step = blend_ints(forth, splat_ints(1), splat_ints(UINT64_MAX)),
                           .x = load(&k->x[i]),
                           .z = load(&k->z[i]),
                           .vz = load(&k->vz[i]),
                           .inv = load(&k->inv[i]),
                           .going = lane_mask(going >> i)};
}

/* The vertex that each flight of the lanes from i on comes to, if it is on the ground before that the end of its segment; as
 * land_towards(). Returns which may go on; *far: to be looked for by the scalar walk. */
FORCE_INLINE mask begin_search(struct form form, struct lanes *k, size_t i, unsigned *far)
{
    const ints one = splat_ints(1);
    real zero = splat(0), x = load(&k->x[i]), vx = load(&k->vx[i]), vz = load(&k->vz[i]), inv = 1 / vx;
    mask forth = less(zero, vx);
    real t = (blend(forth, load(&k->on.x1[i]), load(&k->on.x0[i])) - x) * inv;
    mask clear = at_least(vz - load(&k->on.m[i]) * vx, k->g->half_g * t);
    if (form.wood && k->aloft) {
        mask aloft = lane_mask(k->aloft >> i);
        real end = blend(forth, load(&k->on.z1[i]), load(&k->on.z0[i]));
        mask above = at_least(height_after(load(&k->z[i]), vz, k->g->half_g, t) - end, zero);
        clear = (aloft & above) | and_not(clear, aloft);
    }
    unsigned still = (k->live >> i) & REGISTER & ~lane_bits(forth | less(vx, zero));
    clear &= lane_mask(k->live >> i & ~still);
    *far |= still << i;
    ints segment = load_ints(&k->segment[i]);
    ints to = blend_ints(forth, blend_ints(clear, segment + 1, segment), blend_ints(clear, segment, segment + one));
    store(&k->inv[i], inv);
    store_ints(&k->vertex[i], to);
    return clear;
}

/* Takes those that are going on from vertex to vertex. Where the ground has `blocks`, those that come back along -x to where
 * one begins are left to the scalar walk, which *far then has. */
FORCE_INLINE void search_further(struct form form, struct lanes *k, unsigned going, bool blocks, unsigned *far)
{
    while (going) {
        unsigned on = 0;
        EACH_REGISTER(i) {
            struct search s = search_of(k, i, going);
            if (blocks) {
                unsigned begins = lane_bits(s.going & equal_ints(s.vertex & (((uint64_t)1 << GROUND_BITS) - 1), splat_ints(1)));
                *far |= begins << i;
                s.going = and_not(s.going, lane_mask(begins));
            }
            search_on(form, k, &s);
            store_ints(&k->vertex[i], s.vertex);
            on |= lane_bits(s.going) << i;
        }
        going = on;
    }
}

/* Which segments the flights land on, not yet where; as land_beyond(). Mostly a flight passes no more than two vertices: so
 * many are looked at without a branch that the processor might guess wrongly. Returns those left to the scalar walk. */
FORCE_INLINE unsigned find_segments(struct form form, struct lanes *k)
{
    unsigned going = 0, far = 0;
    EACH_REGISTER(i) {
        mask clear = begin_search(form, k, i, &far);
        struct search s = search_of(k, i, 0);
        s.going = clear;
        search_on(form, k, &s);
        search_on(form, k, &s);
        store_ints(&k->vertex[i], s.vertex);
        going |= lane_bits(s.going) << i;
    }
    search_further(form, k, going, false, &far);
    return far;
}

/* The same where the ground has blocks. */
FORCE_INLINE unsigned find_segments_far(struct form form, struct lanes *k)
{
    unsigned going = 0, forth = 0, far = 0;
    EACH_REGISTER(i) {
        going |= lane_bits(begin_search(form, k, i, &far)) << i;
        forth |= lane_bits(less(splat(0), load(&k->vx[i]))) << i;
    }
    search_far(k, going & forth);
    search_further(form, k, going & ~forth, true, &far);
    return far;
}

/* Where the flights of the lanes from i on land on their segments, or leave the profile; as land_on() and land_nowhere().
 * Returns those that leave; *roll: those that land as near and with so little speed off the ground that they may roll. */
FORCE_INLINE unsigned land_lanes(struct form form, struct lanes *k, size_t i, unsigned *roll)
{
    const ints one = splat_ints(1);
    real zero = splat(0), x = load(&k->x[i]), z = load(&k->z[i]), vx = load(&k->vx[i]), vz = load(&k->vz[i]);
    real inv = load(&k->inv[i]), theta;
    mask forth = less(zero, vx);
    ints from = load_ints(&k->segment[i]), vertex = load_ints(&k->vertex[i]), to = blend_ints(forth, vertex, vertex - one);
    struct chord on = look_up_chord(form, k, to, &theta);
    mask here = equal_ints(to, from);
    if (form.wood)
        here = and_not(here, lane_mask(k->aloft >> i));
    real c = blend(here, zero, z - (on.z0 + on.m * (x - on.x0)));
    real t = min((blend(forth, on.x1, on.x0) - x) * inv, later_root(c, vz - on.m * vx, k->g->gravity));
    real to_x = x + vx * t, to_z = height_after(z, vz, k->g->half_g, t);
    onto_chord(&on, is_steep(on.m), k->steep, true, &to_x, &to_z);
    mask left = equal_ints(to, splat_ints(0)) | equal_ints(to, splat_ints(k->g->n + 1));
    real end = blend(forth, on.x0, on.x1), t_end = (end - x) * inv;
    t = blend(left, t_end, t);
    to_x = blend(left, end, to_x);
    to_z = blend(left, height_after(z, vz, k->g->half_g, t_end), to_z);
    mask near = and_not(less(vabs(to_x - x), load(&k->radius[i])), left);
    *roll |= lane_bits(near) << i;
    if (form.wood && k->waits) {
        mask waits = lane_mask(k->waits >> i);
        t = blend(waits, load(&k->t[i]), t);
        to_x = blend(waits, load(&k->to_x[i]), to_x);
        to_z = blend(waits, load(&k->to_z[i]), to_z);
        to = blend_ints(waits, load_ints(&k->to[i]), to);
        theta = blend(waits, load(&k->theta[i]), theta);
        on = pick_chord(waits, load_chord(&k->on, i), on);
    }
    store(&k->t[i], t);
    store(&k->to_x[i], to_x);
    store(&k->to_z[i], to_z);
    store_ints(&k->to[i], to);
    store(&k->theta[i], theta);
    store_chord(&k->on, i, on);
    return lane_bits(left) << i;
}

/* ---- rolling ---- */

/* Whether what is d away, along x or where that is steep along z, is nearer than `reach`, surely, or farther, surely: without a
 * division, and not told where rounding might matter. As ground_length() against the radius. */
FORCE_INLINE void is_within(real d, real reach, mask *less_far, mask *farther)
{
    const double margin = 0x1p-48;
    *less_far = less(d, reach * (1 - margin));
    *farther = less(reach * (1 + margin), d);
}

/* Of the lanes from i on that land `near`, those that roll, as is_roll(), and stay on their segment, do not stop and meet
 * nothing: for a radius to the next contact, as roll_on(). Returns them; *others: which the scalar walk looks at again, as those
 * that land on another segment. */
FORCE_INLINE unsigned roll_lanes(struct form form, struct lanes *k, size_t i, unsigned near, unsigned *others)
{
    const bool spins = form.law->spins;
    const struct chord on = load_chord(&k->on, i);
    real zero = splat(0), radius = load(&k->radius[i]), off = load(&k->off[i]), u = load(&k->along[i]), c, s, mu, friction;
    real x = load(&k->x[i]), z = load(&k->z[i]), to_x = load(&k->to_x[i]), to_z = load(&k->to_z[i]);
    ints segment = load_ints(&k->segment[i]);
    look_up(&k->ground->tilt, segment, form.small, &c, &s);
    mask may = lane_mask(near >> i) & less(off * off, radius * (2 * k->g->gravity * c));
    mask here = equal_ints(load_ints(&k->to[i]), segment), steep = is_steep(on.m), less_far, farther, ends, stays;
    real reach = vabs(radius * blend(steep, s, c));
    is_within(vabs(blend(steep, to_z - z, to_x - x)), reach, &less_far, &farther);
    mask rolls = may & here & less_far;
    *others |= lane_bits(and_not(may, here & farther)) << i;
    look_up(&k->ground->grip, segment, form.small, &mu, &friction);
    real spin = load(&k->spin[i]);
    if (k->rolled) {
        mask rolled = lane_mask(k->rolled >> i);
        u = blend(rolled, load(&k->before.along[i]), u);
        spin = blend(rolled, load(&k->before.spin[i]), spin);
    }
    if (spins)
        u = rolling_speed(u, load(&k->k[i]), spin, radius);
    mask forth = less(zero, u);
    real dir = blend(forth, splat(1), splat(-1));
    is_within(vabs(blend(steep, blend(forth, on.z1, on.z0) - z, blend(forth, on.x1, on.x0) - x)), reach, &ends, &stays);
    real rate = 2 * k->g->gravity * (-1 * dir * s - friction * c);
    if (spins)
        rate = rate / (1 + load(&k->k[i]));
    real u2 = u * u + rate * radius, x_end = x + dir * c * radius, z_end = z + dir * s * radius;
    onto_chord(&on, steep, any(steep & rolls), false, &x_end, &z_end);
    mask meets = at_least(x_end, load(&k->next_x[i])) | at_least(x_end, load(&k->stem_ahead[i]));
    meets = (forth & meets) | and_not(at_least(load(&k->stem_behind[i]), x_end), forth);
    rolls &= and_not(stays & less(zero, u2), meets | equal(u, zero));
    u = dir * vsqrt(u2);
    store(&k->t[i], blend(rolls, zero, load(&k->t[i])));
    store(&k->to_x[i], blend(rolls, x_end, to_x));
    store(&k->to_z[i], blend(rolls, z_end, to_z));
    store(&k->along[i], blend(rolls, u, load(&k->along[i])));
    if (spins)
        store(&k->spin[i], blend(rolls, u / radius, load(&k->spin[i])));
    return lane_bits(rolls) << i;
}

#endif
