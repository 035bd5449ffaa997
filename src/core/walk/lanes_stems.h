/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flights of lanes among stems, by the same operations in the same order as in flying.h. After a hit a landing is searched if
 * the next stem stands beyond the segment, together with the landings of lanes that leave a contact. */
#ifndef CEDUO_LANES_STEMS_H
#define CEDUO_LANES_STEMS_H

#include <gsl/gsl_interp.h>

#include "lanes_landing.h"

#ifndef WAITING_MAX
#define WAITING_MAX (LANES / 4) /* with at most n lanes among stems they wait for more; affects only speed */
#endif

/* A segment of the ground, with its slope dz/dx. */
struct chord {
    real x0, z0, x1, z1, m;
};

struct chords {
    double x0[LANES], z0[LANES], x1[LANES], z1[LANES], m[LANES];
};

FORCE_INLINE struct chord load_chord(const struct chords *from, size_t i)
{
    return (struct chord){load(&from->x0[i]), load(&from->z0[i]), load(&from->x1[i]), load(&from->z1[i]), load(&from->m[i])};
}

/* Flights past stems. */
struct passing {
    /* of the next stem */
    double stem_x[LANES], t[LANES], z[LANES], cost[LANES];
    /* last segment that the flight may reach, and segment under the stem */
    uint64_t last[LANES], segment[LANES];
    struct chords chords; /* of `segment` */
    double end[LANES];    /* x of the end of the segment under the rock */
    /* bit i is lane i */
    unsigned active;
    unsigned landing_known; /* its landing is known */
    unsigned hit;           /* has hit a stem */
    unsigned stopped;       /* stopped by a stem */
    unsigned aborted;       /* trajectory aborted */
};

/* Look up the chord of a segment, and store it. */
FORCE_INLINE struct chord lookup_chord(struct kernel_params params, const struct lanes *k, ints segment, struct chords *to,
                                       size_t i)
{
    struct chord chord;
    lookup_vertices(&k->ground->vertices, segment, params.small, &chord.x0, &chord.z0);
    lookup_vertices(&k->ground->vertices, segment + 1, params.small, &chord.x1, &chord.z1);
    chord.m = (chord.z1 - chord.z0) / (chord.x1 - chord.x0);
    store(&to->x0[i], chord.x0);
    store(&to->z0[i], chord.z0);
    store(&to->x1[i], chord.x1);
    store(&to->z1[i], chord.z1);
    store(&to->m[i], chord.m);
    return chord;
}

/* Find the segment under the next stem by bisection, for the lanes `advancing` from i on. It may be hundreds of segments
 * away. */
NOINLINE void search_segments(const struct lanes *k, struct passing *p, size_t i, mask advancing)
{
    for (unsigned remaining = lane_bits(advancing) << i; remaining; remaining &= remaining - 1) {
        size_t lane = (size_t)__builtin_ctz(remaining);
        p->segment[lane] = gsl_interp_bsearch(k->g->x, k->stem_ahead[lane], p->segment[lane] - 1, p->last[lane]) + 1;
    }
}

/* Find the segment under each stem at `to`, for flights with a known landing; as fly_past_stems(). */
FORCE_INLINE void go_to_segment(struct kernel_params params, const struct lanes *k, struct passing *p, size_t i, real to,
                                struct chord *chord)
{
    unsigned beyond = (p->active & p->landing_known) >> i & REGISTER & ~lane_bits(greater_equal(load(&p->end[i]), to));
    ints segment = load_ints(&p->segment[i]), last = load_ints(&p->last[i]);
    mask advancing = lane_mask(beyond) & greater_equal(to, chord->x1) & greater_ints(last, segment);
    while (any(advancing)) {
        if (k->has_chunks) {
            search_segments(k, p, i, advancing);
            segment = load_ints(&p->segment[i]);
        } else {
            segment = blend_ints(advancing, segment + 1, segment);
            store_ints(&p->segment[i], segment);
        }
        *chord = lookup_chord(params, k, segment, &p->chords, i);
        advancing &= greater_equal(to, chord->x1) & greater_ints(last, segment);
    }
}

/* Consume the next stem of each of `lanes` by the scalar walk. If it is hit or the rock aborted, pass the marks before it. */
NOINLINE void consume_stems_scalar(struct lanes *k, struct passing *p, unsigned lanes, unsigned hit)
{
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        struct walker *w = &k->job->walkers[i];
        const struct flight flight = flight_of(k, i);
        w->spin = k->spin[i];
        save_stems(k, i);
        if (!ceduo_walk_hit_stem(w, hit >> i & 1, &flight, p->t[i]))
            p->aborted |= 1u << i;
        load_stem(k, i);
        k->next_x[i] = w->next_x;
        k->pause[i] = w->pause;
    }
}

/* Return the flights that are above all stems when they pass `to` after t, and set clear_to: the end of the segment, or where
 * the parabola comes down to `tallest`. */
FORCE_INLINE unsigned fly_over(struct lanes *k, size_t i, unsigned active, real to, real t, real clearance,
                               const struct chord *chord)
{
    real zero = splat(0), above_tallest = clearance - k->tallest;
    mask high =
        less(zero, above_tallest) & less(zero, t) & less(load(&k->stem.second_x[i]), chord->x1) & lane_mask(active >> i);
    if (!any(high))
        return 0;
    double g = k->g->gravity;
    real vx = load(&k->vx[i]), up = load(&k->vz[i]) - g * t - chord->m * vx;
    real seconds = (up + vsqrt(up * up + 2 * g * above_tallest)) / g;
    store(&k->stem.clear_to[i], min(chord->x1, to + vx * seconds));
    return lane_bits(high) << i;
}

/* Consume the next stem of each of `lanes`, whose following stem is queued and is next. Lanes that are `above` all stems
 * consume several. No branch depends on the hits. */
FORCE_INLINE void consume_queued(struct lanes *k, unsigned lanes, unsigned hit, unsigned above)
{
    uint64_t places = k->job->walkers[0].stems->forest->met_mask;
    for (above &= lanes; above; above &= above - 1) {
        size_t i = (size_t)__builtin_ctz(above);
        const struct stem *stem = k->stem.next[i];
        while (stem[1].along < k->stem.clear_to[i] && stem[2].along < k->stem.certain_to[i])
            stem++; /* to the last of the queued stems in a row that it flies over */
        k->stem.next[i] = stem;
    }
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        const struct stem *stem = k->stem.next[i];
        uint64_t *place = &k->stem.hit_stools[i][stem->stool & places];
        bool is_hit = hit >> i & 1, shoot = is_hit & stem->shoot;
        k->stem.hit[i] += is_hit;
        k->stem.stools_met[i] += is_hit & !(shoot & (*place == stem->stool));
        *place = shoot ? stem->stool : *place;
        k->stem.next[i] = ++stem;
        k->stem.second_x[i] = stem[1].along;
        k->stem_ahead[i] = stem->along;
        k->stem.height[i] = stem->height;
        k->stem.cost[i] = stem->energy;
    }
}

/* Consume the next stem of each active flight, as ceduo_walk_hit_stem(). It is done in the lanes if the following stem is
 * queued, no mark is passed and no stool stands around the release. */
FORCE_INLINE void consume_stems(struct lanes *k, struct passing *p, unsigned hit, unsigned above)
{
    unsigned marks = 0, quick = 0;
    EACH_REGISTER(i) {
        real to = load(&p->stem_x[i]);
        marks |= lane_bits(greater_equal(to, load(&k->next_x[i]))) << i;
        quick |= lane_bits(and_not(less(load(&k->stem.second_x[i]), load(&k->stem.certain_to[i])),
                                   greater_equal(load(&k->stem.overlap_to[i]), to)))
                 << i;
    }
    quick &= ~(marks & hit);
    consume_queued(k, p->active & quick, hit, above);
    if (p->active & ~quick)
        consume_stems_scalar(k, p, p->active & ~quick, hit);
}

/* Move the flights from lane i on to their next stem. Return the lanes that hit it. Lanes that reach the ground before become
 * inactive. *above: see fly_over(). */
FORCE_INLINE unsigned come_to_stem(struct kernel_params params, struct lanes *k, struct passing *p, size_t i, unsigned *above)
{
    real zero = splat(0), to = load(&k->stem_ahead[i]), vz = load(&k->vz[i]), latest = load(&k->t[i]);
    struct chord chord = load_chord(&p->chords, i);
    go_to_segment(params, k, p, i, to, &chord);
    real t = (to - load(&k->x[i])) / load(&k->vx[i]);
    mask landing_known = lane_mask(p->landing_known >> i);
    t = blend(less(t, zero), zero, blend(landing_known & less(latest, t), latest, t));
    real z = height_at_time(load(&k->z[i]), vz, k->g->half_g, t),
         clearance = z - blend(greater_equal(to, chord.x1), chord.z1, chord.z0 + chord.m * (to - chord.x0));
    unsigned other_lanes = ~(REGISTER << i);
    p->active &= other_lanes | p->landing_known | lane_bits(greater_equal(clearance, zero)) << i;
    unsigned hit = p->active & lane_bits(less(max(clearance, zero), load(&k->stem.height[i]))) << i;
    store(&p->stem_x[i], to);
    store(&p->t[i], t);
    store(&p->z[i], z);
    store(&p->cost[i], load(&k->stem.cost[i]));
    *above |= fly_over(k, i, p->active, to, t, clearance, &chord);
    return hit;
}

/* Apply a hit to the lanes `hit` from i on. */
FORCE_INLINE void hit_stem_lanes(struct lanes *k, struct passing *p, size_t i, unsigned hit)
{
    mask h = lane_mask(hit >> i);
    real vx = load(&k->vx[i]), vz = load(&k->vz[i]) - k->g->gravity * load(&p->t[i]), spin = load(&k->spin[i]);
    struct hit collision = {.energy = flying_energy(load(&k->mass[i]), load(&k->moment[i]), vx, vz, spin),
                            .cost = load(&p->cost[i])};
    real share = speed_kept(collision);
    store_ints(&k->from[i], blend_ints(h, load_ints(&p->segment[i]), load_ints(&k->from[i])));
    store(&p->end[i], blend(h, load(&p->chords.x1[i]), load(&p->end[i])));
    store(&k->x[i], blend(h, load(&p->stem_x[i]), load(&k->x[i])));
    store(&k->z[i], blend(h, load(&p->z[i]), load(&k->z[i])));
    store(&k->vx[i], blend(h, vx * share, vx));
    store(&k->vz[i], blend(h, vz * share, load(&k->vz[i])));
    store(&k->spin[i], blend(h, spin * share, spin));
    p->stopped |= lane_bits(and_not(h, less(splat(0), share))) << i;
}

/* Pass the next stem of each active flight, whose landing is beyond it or unknown. */
FORCE_INLINE void pass_stem(struct kernel_params params, struct lanes *k, struct passing *p)
{
    unsigned hit = 0, above = 0, forward = 0, before_landing = 0;
    EACH_REGISTER(i)
        hit |= come_to_stem(params, k, p, i, &above);
    if (!p->active)
        return;
    consume_stems(k, p, hit, above);
    hit &= ~p->aborted;
    p->active &= ~p->aborted;
    if (hit)
        EACH_REGISTER(i)
            hit_stem_lanes(k, p, i, hit);
    p->hit |= hit;
    p->landing_known &= ~hit;
    EACH_REGISTER(i) {
        forward |= lane_bits(less(splat(0), load(&k->vx[i]))) << i;
        before_landing |= lane_bits(greater_equal(load(&k->to_x[i]), load(&k->stem_ahead[i]))) << i;
    }
    p->active &= ~p->stopped & forward & (~p->landing_known | before_landing);
}

/* Move all flights along +x that reach a stem before they land up to their landing, or until it must be known. Return the lanes
 * left to the scalar walk. */
FORCE_INLINE unsigned pass_stems(struct kernel_params params, struct lanes *k)
{
    struct passing p;
    const ints n = splat_ints(k->g->n);
    unsigned entering = 0, scalar = 0;
    EACH_REGISTER(i)
        entering |= lane_bits(greater_equal(load(&k->to_x[i]), load(&k->stem_ahead[i])) & less(splat(0), load(&k->vx[i]))) << i;
    entering &= k->live & ~k->at_contact; /* reach a stem before they land */
    p.landing_known = entering & ~k->landing_unknown;
    p.active = entering | k->landing_unknown;
    p.hit = p.stopped = p.aborted = 0;
    k->after_hit = k->waiting = k->landing_unknown = 0;
    if (!p.active)
        return 0;
    EACH_REGISTER(i) {
        ints segment = load_ints(&k->from[i]), to = load_ints(&k->segment[i]);
        store_ints(&p.segment[i], segment);
        store(&p.end[i], lookup_chord(params, k, segment, &p.chords, i).x1);
        store_ints(&p.last[i], blend_ints(greater_ints(to, n), n, to));
    }
    unsigned unknown = p.active & ~p.landing_known;
    do {
        /* with an unknown landing, continue while the stem stands over the same segment */
        unsigned over_segment = 0;
        EACH_REGISTER(i)
            over_segment |= lane_bits(greater_equal(load(&p.end[i]), load(&k->stem_ahead[i]))) << i;
        p.active &= p.landing_known | over_segment;
        scalar |= p.active & k->stem_unknown;
        p.active &= ~k->stem_unknown;
        if (p.active)
            pass_stem(params, k, &p);
    } while (__builtin_popcount(p.active) > WAITING_MAX);
    k->off_slope &= ~p.hit;
    k->waiting = p.active;
    k->landing_unknown = p.active & ~p.landing_known;
    k->after_hit = (p.hit | unknown) & ~p.stopped & ~p.aborted & ~k->waiting;
    for (unsigned done = p.stopped | p.aborted; done; done &= done - 1) {
        size_t i = (size_t)__builtin_ctz(done);
        end_lane(k, i, k->x[i], 0, p.stopped >> i & 1 ? CEDUO_END_STOPPED_BY_STEMS : CEDUO_END_UNFINISHED);
    }
    return scalar;
}

#endif
