/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From one contact of the lanes to the next, in flight or rolling, as landing.h and rolling.h for one rock. Lanes that stay on
 * their segment need no coordinates. Flights that leave it are listed without gaps, so that no lane of a register is idle. */
#ifndef CEDUO_LANES_LANDING_H
#define CEDUO_LANES_LANDING_H

#include "lanes_far.h"

/* ---- on the segment ---- */

/* Append the lanes `listed` from i on to the flights that leave their segment. */
FORCE_INLINE void list_flights(struct leaving *f, mask listed, real x, real z, real vx, real vz, real reach, ints segment)
{
    const unsigned n = f->n;
    compress(listed, as_ints(x), &f->x[n]);
    compress(listed, as_ints(z), &f->z[n]);
    compress(listed, as_ints(vx), &f->vx[n]);
    compress(listed, as_ints(vz), &f->vz[n]);
    compress(listed, as_ints(reach), &f->reach[n]);
    compress(listed, segment, &f->segment[n]);
    f->n = n + (unsigned)__builtin_popcount(lane_bits(listed));
}

/* Move the lanes from i on, except those in the air, to their next contact on the same segment: in flight, or rolling a radius,
 * as roll_on(). List those that leave the segment, and return them. Add to *scalar the lanes left to the scalar walk: those that
 * may roll and then stop or meet something, and those at the end of a segment, because x is that of the next vertex there. */
FORCE_INLINE unsigned hop_lanes(struct kernel_params params, struct lanes *k, size_t i, unsigned *scalar)
{
    const bool spins = params.law->spins;
    const double g = k->g->gravity;
    const unsigned air = in_the_air(params, k) >> i;
    real x0, z0, t, zero = splat(0), radius = load(&k->radius[i]);
    ints segment = load_ints(&k->segment[i]);
    lookup_at(&k->ground->vertices, &k->segment[i], 0, params.small, &x0, &z0);
    const struct axes axes = {load(&k->c[i]), load(&k->s[i]), load(&k->length[i])};
    const struct motion from = {load(&k->to.q[i]), load(&k->after.along[i]), load(&k->after.off[i])};
    mask leaves;
    struct motion to = hop(&axes, g, from, &t, &leaves);
    real x = x0 + axes.c * from.q, z = z0 + axes.s * from.q, to_x = x0 + axes.c * to.q;
    real vx = from.along * axes.c - from.off * axes.s, vz = from.along * axes.s + from.off * axes.c;
    mask low = less(from.off * from.off, radius * (2 * g * axes.c));
    mask odd = greater_equal(from.q, axes.length) | and_not(greater_equal(to.q, axes.length), leaves);
    mask listed = and_not(leaves, odd), near = and_not(low & less(vabs(to.q - from.q), radius), leaves);
    real reach = blend(low, radius, zero);
    ints next = segment + blend_ints(less(zero, vx), splat_ints(1), splat_ints(UINT64_MAX));
    if (air) {
        mask in_air = lane_mask(air);
        x = blend(in_air, load(&k->x[i]), x);
        z = blend(in_air, load(&k->z[i]), z);
        vx = blend(in_air, load(&k->vx[i]), vx);
        vz = blend(in_air, load(&k->vz[i]), vz);
        t = blend(in_air, load(&k->t[i]), t);
        to_x = blend(in_air, load(&k->to_x[i]), to_x);
        segment = blend_ints(in_air, load_ints(&k->from[i]), segment);
        next = blend_ints(in_air, segment, next);
        reach = blend(in_air, zero, reach);
        to.q = blend(in_air, from.q, to.q);
        to.along = blend(in_air, load(&k->to.along[i]), to.along);
        to.off = blend(in_air, load(&k->to.off[i]), to.off);
        near = and_not(near, in_air);
        odd = and_not(odd, in_air);
        listed = and_not(listed, in_air) | lane_mask(k->after_hit >> i);
    }
    store_ints(&k->from[i], segment);
    store(&k->x[i], x);
    store(&k->z[i], z);
    store(&k->vx[i], vx);
    store(&k->vz[i], vz);
    store(&k->t[i], t);
    store(&k->to_x[i], to_x);
    store(&k->after.q[i], from.q);
    list_flights(&k->leaving, listed, x, z, vx, vz, reach, next);
    /* roll */
    real u = from.along, spin = load(&k->spin[i]), spin_before = spin;
    if (k->rolled) {
        mask rolled = lane_mask(k->rolled >> i);
        u = blend(rolled, load(&k->before_contact.along[i]), u);
        spin = blend(rolled, load(&k->before_contact.spin[i]), spin);
    }
    if (spins)
        u = rolling_speed(u, load(&k->k[i]), spin, radius);
    mask forward = less(zero, u);
    real dir = vcopysign(splat(1), u), rate = 2 * g * (-1 * dir * axes.s - load(&k->friction[i]) * axes.c);
    if (spins)
        rate = rate / (1 + load(&k->k[i]));
    real u2 = u * u + rate * radius, roll_q = from.q + dir * radius, roll_x = x0 + axes.c * roll_q;
    mask meets = forward & greater_equal(roll_x, load(&k->next_x[i]));
    if (params.stems)
        meets |= (forward & greater_equal(roll_x, load(&k->stem_ahead[i]))) |
                 and_not(greater_equal(load(&k->stem_behind[i]), roll_x), forward);
    mask rolls = near & less(radius, blend(forward, axes.length - from.q, from.q)) & less(zero, u2);
    rolls = and_not(rolls, meets | equal(u, zero) | odd);
    u = dir * vsqrt(u2);
    store(&k->to.q[i], blend(rolls, roll_q, to.q));
    store(&k->to.along[i], blend(rolls, u, to.along));
    store(&k->to.off[i], zero_if(rolls, to.off));
    if (spins)
        store(&k->spin[i], blend(rolls, u / radius, spin_before));
    k->rolling |= lane_bits(rolls) << i;
    *scalar |= lane_bits(odd | and_not(near, rolls)) << i;
    return lane_bits(listed) << i;
}

/* ---- beyond the segment ---- */

#define EACH_LEAVING(j) for (size_t j = 0; j < k->leaving.n; j += REAL_LANES)

/* Return the first n - j lanes. */
FORCE_INLINE unsigned lanes_up_to(unsigned n, size_t j)
{
    return n - j >= REAL_LANES ? REGISTER : (1u << (n - j)) - 1;
}

/* Move the flights `going` from j on to the segment after the next vertex, if they clear it. Return these flights. */
FORCE_INLINE mask pass_vertex(struct kernel_params params, const struct lanes *k, const struct leaving *f, size_t j, mask going,
                              ints *segment)
{
    real x, z;
    mask forward = less(splat(0), load(&f->vx[j]));
    ints step = blend_ints(forward, splat_ints(1), splat_ints(UINT64_MAX));
    lookup_vertices(&k->ground->vertices, *segment + blend_ints(forward, splat_ints(1), splat_ints(0)), params.small, &x, &z);
    real t = (x - load(&f->x[j])) * load(&f->inv[j]);
    going &= greater_equal(height_at_time(load(&f->z[j]), load(&f->vz[j]), k->g->half_g, t) - z, splat(0));
    *segment = blend_ints(going, *segment + step, *segment);
    return going;
}

/* Search the segment of one landing vertex by vertex. False if the scalar walk must search it, along -x at the start of a
 * chunk. */
FORCE_INLINE bool search_one(const struct lanes *k, struct leaving *f, size_t j)
{
    uint64_t segment = f->segment[j], far_end = f->vx[j] > 0, step = far_end ? 1 : UINT64_MAX;
    for (;; segment += step) {
        const double *vertex = k->ground->vertices.pairs[segment + far_end], t = (vertex[0] - f->x[j]) * f->inv[j];
        f->segment[j] = segment;
        if (k->has_chunks && (segment & ((1 << GROUND_BITS) - 1)) == 0)
            return false;
        if (!(f->z[j] + (f->vz[j] - k->g->half_g * t) * t - vertex[1] >= 0))
            return true;
    }
}

/* Find the segments on which the flights land, as land_from_vertex(). Most flights pass at most two vertices, so two are tested
 * without a branch, which might be mispredicted. Return the flights left to the scalar walk. */
FORCE_INLINE unsigned find_segments(struct kernel_params params, struct lanes *k)
{
    struct leaving *f = &k->leaving;
    unsigned going = 0, far = 0, unfound = 0;
    EACH_LEAVING(j)
    {
        mask searching = lane_mask(lanes_up_to(f->n, j));
        ints segment = load_ints(&f->segment[j]);
        store(&f->inv[j], 1 / load(&f->vx[j]));
        if (k->has_chunks) {
            far |= lane_bits(searching & less(splat(0), load(&f->vx[j]))) << j;
        } else {
            searching = pass_vertex(params, k, f, j, searching, &segment);
            searching = pass_vertex(params, k, f, j, searching, &segment);
            store_ints(&f->segment[j], segment);
        }
        going |= lane_bits(searching) << j;
    }
    if (far)
        search_far(k, far);
    for (going &= ~far; going; going &= going - 1) {
        size_t j = (size_t)__builtin_ctz(going);
        unfound |= search_one(k, f, j) ? 0 : 1u << j;
    }
    return unfound;
}

/* Land flights from j on on their segments, or beyond the profile, as land_on() and land_off_slope(). Add to *near those that
 * land so near that they may roll, to *out those that leave the slope. */
FORCE_INLINE void land_flights(struct kernel_params params, struct lanes *k, size_t j, unsigned *near, unsigned *out)
{
    struct leaving *f = &k->leaving;
    real x0, z0, x1, theta, t, x = load(&f->x[j]), z = load(&f->z[j]), vx = load(&f->vx[j]), vz = load(&f->vz[j]);
    ints segment = load_ints(&f->segment[j]);
    struct axes axes;
    lookup_at(&k->ground->vertices, &f->segment[j], 0, params.small, &x0, &z0);
    lookup_next_x(&k->ground->vertices, &f->segment[j], params.small, &x1);
    lookup_segments(&k->ground->tangents, &f->segment[j], params.small, &axes.c, &axes.s);
    lookup_segments(&k->ground->lengths, &f->segment[j], params.small, &axes.length, &theta);
    mask forward = less(splat(0), vx);
    real inv = load(&f->inv[j]), latest = (blend(forward, x1, x0) - x) * inv;
    const struct motion to = come_down_on(&axes, k->g->gravity, x - x0, z - z0, vx, vz, latest, &t);
    real to_x = blend(greater_equal(to.q, axes.length), x1, x0 + axes.c * to.q);
    mask off_slope = equal_ints(segment, splat_ints(0)) | equal_ints(segment, splat_ints(k->g->n + 1));
    real end = blend(forward, x0, x1);
    to_x = blend(off_slope, end, to_x);
    store(&f->t[j], blend(off_slope, (end - x) * inv, t));
    store(&f->to_x[j], to_x);
    store(&f->q[j], to.q);
    store(&f->along[j], to.along);
    store(&f->off[j], to.off);
    *out |= lane_bits(off_slope) << j;
    *near |= lane_bits(and_not(less(vabs(to_x - x), load(&f->reach[j])), off_slope)) << j;
}

/* Return the lanes of some listed flights. */
FORCE_INLINE unsigned lanes_of(unsigned flights, unsigned listed)
{
    unsigned lanes = 0;
    for (; flights; flights >>= 1, listed &= listed - 1)
        lanes |= flights & 1 ? listed & -listed : 0;
    return lanes;
}

/* Land the lanes `listed`. Return those left to the scalar walk. */
FORCE_INLINE unsigned land_lanes(struct kernel_params params, struct lanes *k, unsigned listed)
{
    const struct leaving *f = &k->leaving;
    unsigned near = find_segments(params, k), out = 0, all = f->n < 32 ? (1u << f->n) - 1 : UINT32_MAX;
    EACH_LEAVING(j)
    land_flights(params, k, j, &near, &out);
    k->off_slope |= lanes_of(out & all, listed);
    const double *segment = (const double *)f->segment;
    EACH_REGISTER(i) {
        unsigned lanes = listed >> i & REGISTER;
        size_t j = (size_t)__builtin_popcount(listed & ((1u << i) - 1));
        mask lands = lane_mask(lanes);
        store(&k->to.q[i], blend(lands, expand(lanes, &f->q[j]), load(&k->to.q[i])));
        store(&k->to.along[i], blend(lands, expand(lanes, &f->along[j]), load(&k->to.along[i])));
        store(&k->to.off[i], blend(lands, expand(lanes, &f->off[j]), load(&k->to.off[i])));
        store(&k->t[i], blend(lands, expand(lanes, &f->t[j]), load(&k->t[i])));
        store(&k->to_x[i], blend(lands, expand(lanes, &f->to_x[j]), load(&k->to_x[i])));
        store_ints(&k->segment[i], blend_ints(lands, as_ints(expand(lanes, &segment[j])), load_ints(&k->segment[i])));
    }
    return lanes_of(near & all, listed);
}

#endif
