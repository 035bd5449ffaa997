/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From one contact of the lanes to the next, in flight or rolling, as landing.h and rolling.h for one rock. */
#ifndef CEDUO_LANES_LANDING_H
#define CEDUO_LANES_LANDING_H

#include "lanes_far.h"

/* ---- landing ---- */

/* Search of flights that clear a vertex, for their next vertex. */
struct search {
    ints vertex, step;
    real x, z, vz, inv;
    mask going;
};

FORCE_INLINE void advance_search(struct kernel_params params, const struct lanes *k, struct search *s)
{
    ints next = s->vertex + s->step;
    real x, z;
    lookup(&k->ground->vertices, params.small && LOOKUP_WRAPS ? next : blend_ints(s->going, next, s->vertex), params.small, &x,
           &z);
    real t = (x - s->x) * s->inv;
    s->going &= greater_equal(height_at_time(s->z, s->vz, k->g->half_g, t) - z, splat(0));
    s->vertex = blend_ints(s->going, next, s->vertex);
}

/* Load the search of the lanes from i on. The lanes `going` still clear their vertex. */
FORCE_INLINE struct search load_search(const struct lanes *k, size_t i, unsigned going)
{
    mask forward = less(splat(0), load(&k->vx[i]));
    return (struct search){.vertex = load_ints(&k->vertex[i]),
                           .step = blend_ints(forward, splat_ints(1), splat_ints(UINT64_MAX)),
                           .x = load(&k->x[i]),
                           .z = load(&k->z[i]),
                           .vz = load(&k->vz[i]),
                           .inv = load(&k->inv[i]),
                           .going = lane_mask(going >> i)};
}

/* Begin the search of the lanes from i on, as land_towards(): set the first vertex of each flight, at the end of its segment if
 * it is above the ground there. Return the lanes that continue. Add to *scalar the lanes left to the scalar walk. */
FORCE_INLINE mask begin_search(struct kernel_params params, struct lanes *k, size_t i, unsigned *scalar)
{
    const ints one = splat_ints(1);
    real zero = splat(0), x = load(&k->x[i]), vx = load(&k->vx[i]), vz = load(&k->vz[i]), inv = 1 / vx;
    mask forward = less(zero, vx);
    real t = (blend(forward, load(&k->chords.x1[i]), load(&k->chords.x0[i])) - x) * inv;
    mask clear = greater_equal(vz - load(&k->chords.m[i]) * vx, k->g->half_g * t);
    if (params.stems && k->after_hit) {
        mask aloft = lane_mask(k->after_hit >> i);
        real end = blend(forward, load(&k->chords.z1[i]), load(&k->chords.z0[i]));
        mask above = greater_equal(height_at_time(load(&k->z[i]), vz, k->g->half_g, t) - end, zero);
        clear = (aloft & above) | and_not(clear, aloft);
    }
    unsigned vertical = (k->live >> i) & REGISTER & ~lane_bits(forward | less(vx, zero));
    clear &= lane_mask(k->live >> i & ~vertical);
    *scalar |= vertical << i;
    ints segment = load_ints(&k->segment[i]);
    ints to = blend_ints(forward, blend_ints(clear, segment + 1, segment), blend_ints(clear, segment, segment + one));
    store(&k->inv[i], inv);
    store_ints(&k->vertex[i], to);
    return clear;
}

/* Advance the lanes `going` from vertex to vertex. If the ground has `chunks`, lanes that move along -x to the start of a chunk
 * are added to *scalar, for the scalar walk. */
FORCE_INLINE void finish_search(struct kernel_params params, struct lanes *k, unsigned going, bool chunks, unsigned *scalar)
{
    while (going) {
        unsigned next_going = 0;
        EACH_REGISTER(i) {
            struct search s = load_search(k, i, going);
            if (chunks) {
                unsigned begins = lane_bits(s.going & equal_ints(s.vertex & (((uint64_t)1 << GROUND_BITS) - 1), splat_ints(1)));
                *scalar |= begins << i;
                s.going = and_not(s.going, lane_mask(begins));
            }
            advance_search(params, k, &s);
            store_ints(&k->vertex[i], s.vertex);
            next_going |= lane_bits(s.going) << i;
        }
        going = next_going;
    }
}

/* Find the segments on which the flights land, as land_from_vertex(). Most flights pass at most two vertices, so two are tested
 * without a branch, which might be mispredicted. Return the lanes left to the scalar walk. */
FORCE_INLINE unsigned find_segments(struct kernel_params params, struct lanes *k)
{
    unsigned going = 0, scalar = 0;
    EACH_REGISTER(i) {
        mask clear = begin_search(params, k, i, &scalar);
        struct search s = load_search(k, i, 0);
        s.going = clear;
        advance_search(params, k, &s);
        advance_search(params, k, &s);
        store_ints(&k->vertex[i], s.vertex);
        going |= lane_bits(s.going) << i;
    }
    finish_search(params, k, going, false, &scalar);
    return scalar;
}

/* As find_segments(), if the ground has chunks. */
FORCE_INLINE unsigned find_segments_far(struct kernel_params params, struct lanes *k)
{
    unsigned going = 0, forward = 0, scalar = 0;
    EACH_REGISTER(i) {
        going |= lane_bits(begin_search(params, k, i, &scalar)) << i;
        forward |= lane_bits(less(splat(0), load(&k->vx[i]))) << i;
    }
    search_far(k, going & forward);
    finish_search(params, k, going & ~forward, true, &scalar);
    return scalar;
}

/* Land the lanes from i on on their segments, or beyond the profile, as land_on() and land_off_slope(). Return the lanes that
 * leave. Add to *roll the lanes that land so near that they may roll. */
FORCE_INLINE unsigned land_lanes(struct kernel_params params, struct lanes *k, size_t i, unsigned *roll)
{
    const ints one = splat_ints(1);
    real zero = splat(0), x = load(&k->x[i]), z = load(&k->z[i]), vx = load(&k->vx[i]), vz = load(&k->vz[i]);
    real inv = load(&k->inv[i]), theta;
    mask forward = less(zero, vx);
    ints from = load_ints(&k->segment[i]), vertex = load_ints(&k->vertex[i]), to = blend_ints(forward, vertex, vertex - one);
    struct chord chord = lookup_chord(params, k, to, &theta);
    mask same_segment = equal_ints(to, from);
    if (params.stems)
        same_segment = and_not(same_segment, lane_mask(k->after_hit >> i));
    real c = blend(same_segment, zero, z - (chord.z0 + chord.m * (x - chord.x0)));
    real t = min((blend(forward, chord.x1, chord.x0) - x) * inv, later_root(c, vz - chord.m * vx, k->g->gravity));
    real to_x = x + vx * t, to_z = height_at_time(z, vz, k->g->half_g, t);
    snap_to_chord(&chord, is_steep(chord.m), k->steep, true, &to_x, &to_z);
    mask off_slope = equal_ints(to, splat_ints(0)) | equal_ints(to, splat_ints(k->g->n + 1));
    real end = blend(forward, chord.x0, chord.x1), t_end = (end - x) * inv;
    t = blend(off_slope, t_end, t);
    to_x = blend(off_slope, end, to_x);
    to_z = blend(off_slope, height_at_time(z, vz, k->g->half_g, t_end), to_z);
    mask near = and_not(less(vabs(to_x - x), load(&k->radius[i])), off_slope);
    *roll |= lane_bits(near) << i;
    if (params.stems && k->waiting) {
        mask waiting = lane_mask(k->waiting >> i);
        t = blend(waiting, load(&k->t[i]), t);
        to_x = blend(waiting, load(&k->to_x[i]), to_x);
        to_z = blend(waiting, load(&k->to_z[i]), to_z);
        to = blend_ints(waiting, load_ints(&k->to[i]), to);
        theta = blend(waiting, load(&k->theta[i]), theta);
        chord = blend_chord(waiting, load_chord(&k->chords, i), chord);
    }
    store(&k->t[i], t);
    store(&k->to_x[i], to_x);
    store(&k->to_z[i], to_z);
    store_ints(&k->to[i], to);
    store(&k->theta[i], theta);
    store_chord(&k->chords, i, chord);
    return lane_bits(off_slope) << i;
}

/* ---- rolling ---- */

/* Classify d, along x, or along z on steep ground, as certainly below reach, certainly above, or neither within rounding.
 * Replaces ground_length() against the radius, without division. */
FORCE_INLINE void classify_distance(real d, real reach, mask *nearer, mask *farther)
{
    const double margin = 0x1p-48;
    *nearer = less(d, reach * (1 - margin));
    *farther = less(reach * (1 + margin), d);
}

/* Roll the lanes from i on that `may_roll`: those that roll, as is_roll(), stay on their segment, do not stop and meet nothing.
 * They roll a radius to the next contact, as roll_on(). Return them. Add to *scalar all lanes that do not certainly fly; of
 * these, the scalar walk handles those that are not returned. */
FORCE_INLINE unsigned roll_lanes(struct kernel_params params, struct lanes *k, size_t i, unsigned may_roll, unsigned *scalar)
{
    const bool spins = params.law->spins;
    const struct chord chord = load_chord(&k->chords, i);
    real zero = splat(0), radius = load(&k->radius[i]), off = load(&k->off[i]), u = load(&k->along[i]), c, s, mu, friction;
    real x = load(&k->x[i]), z = load(&k->z[i]), to_x = load(&k->to_x[i]), to_z = load(&k->to_z[i]);
    ints segment = load_ints(&k->segment[i]);
    lookup(&k->ground->tangents, segment, params.small, &c, &s);
    mask slow = lane_mask(may_roll >> i) & less(off * off, radius * (2 * k->g->gravity * c));
    mask same_segment = equal_ints(load_ints(&k->to[i]), segment), steep = is_steep(chord.m), nearer, farther, ends, stays;
    real reach = vabs(radius * blend(steep, s, c));
    classify_distance(vabs(blend(steep, to_z - z, to_x - x)), reach, &nearer, &farther);
    mask rolls = slow & same_segment & nearer;
    *scalar |= lane_bits(and_not(slow, same_segment & farther)) << i;
    lookup(&k->ground->frictions, segment, params.small, &mu, &friction);
    real spin = load(&k->spin[i]);
    if (k->rolled) {
        mask rolled = lane_mask(k->rolled >> i);
        u = blend(rolled, load(&k->before_contact.along[i]), u);
        spin = blend(rolled, load(&k->before_contact.spin[i]), spin);
    }
    if (spins)
        u = rolling_speed(u, load(&k->k[i]), spin, radius);
    mask forward = less(zero, u);
    real dir = blend(forward, splat(1), splat(-1));
    classify_distance(vabs(blend(steep, blend(forward, chord.z1, chord.z0) - z, blend(forward, chord.x1, chord.x0) - x)), reach,
                      &ends, &stays);
    real rate = 2 * k->g->gravity * (-1 * dir * s - friction * c);
    if (spins)
        rate = rate / (1 + load(&k->k[i]));
    real u2 = u * u + rate * radius, x_end = x + dir * c * radius, z_end = z + dir * s * radius;
    snap_to_chord(&chord, steep, any(steep & rolls), false, &x_end, &z_end);
    mask meets = greater_equal(x_end, load(&k->next_x[i])) | greater_equal(x_end, load(&k->stem_ahead[i]));
    meets = (forward & meets) | and_not(greater_equal(load(&k->stem_behind[i]), x_end), forward);
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
