/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flights of lanes among stems: the same operations in the same order as in flying.h. Behind a hit a lane is
 * aloft: its landing is looked for when the next stem stands beyond its segment, together with those of the lanes that
 * come from a contact. */
#ifndef CEDUO_LANES_STEMS_H
#define CEDUO_LANES_STEMS_H

#include <gsl/gsl_interp.h>

#include "lanes_landing.h"

#ifndef TOO_FEW
#define TOO_FEW (LANES / 4) /* so few lanes among stems wait until there are more; only speed depends on it */
#endif

/* Flights on their way past stems. */
struct passing {
    /* of the stem that is before each */
    double to[LANES], t[LANES], z[LANES], cost[LANES];
    /* over which segments: the last that the flight may come to, and the one under the stem */
    uint64_t last[LANES], here[LANES];
    struct chords on;  /* that */
    double end[LANES]; /* x where the segment under the rock ends */
    /* bit i is lane i */
    unsigned under_way;
    unsigned knows;   /* its landing */
    unsigned moved;   /* was hit */
    unsigned stopped; /* by a stem */
    unsigned ended;   /* given up */
};

/* Go on, in the lanes `further` from i on, to the segment under their next stem by bisection: of a long profile it may be hundreds
 * of segments away. */
NOINLINE void search_segments(const struct lanes *k, struct passing *p, size_t i, mask further)
{
    for (unsigned left = lane_bits(further) << i; left; left &= left - 1) {
        size_t lane = (size_t)__builtin_ctz(left);
        p->here[lane] = gsl_interp_bsearch(k->g->x, k->stem_ahead[lane], p->here[lane] - 1, p->last[lane]) + 1;
    }
}

/* The segment under each stem at `to`, for flights that know where they land; as fly_past_stems(). */
FORCE_INLINE void go_to_segment(struct form form, const struct lanes *k, struct passing *p, size_t i, real to, struct chord *on)
{
    unsigned far = (p->under_way & p->knows) >> i & REGISTER & ~lane_bits(at_least(load(&p->end[i]), to));
    ints here = load_ints(&p->here[i]), last = load_ints(&p->last[i]);
    real theta;
    mask further = lane_mask(far) & at_least(to, on->x1) & greater_ints(last, here);
    while (any(further)) {
        if (k->far) {
            search_segments(k, p, i, further);
            here = load_ints(&p->here[i]);
        } else {
            here = blend_ints(further, here + 1, here);
            store_ints(&p->here[i], here);
        }
        *on = look_up_chord(form, k, here, &theta);
        store_chord(&p->on, i, *on);
        further &= at_least(to, on->x1) & greater_ints(last, here);
    }
}

/* The scalar walk takes the stem that is before each of `lanes`, past the marks up to it where it is hit or the rock
 * is given up. */
NOINLINE void take_stems_alone(struct lanes *k, struct passing *p, unsigned lanes, unsigned hit)
{
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        struct walker *w = &k->job->walkers[i];
        struct flight at = {.x = k->x[i], .z = k->z[i], .vx = k->vx[i], .vz = k->vz[i]};
        w->spin = k->spin[i];
        show_stems_met(k, i);
        if (!ceduo_walk_take_stem(w, hit >> i & 1, at, p->t[i]))
            p->ended |= 1u << i;
        load_stem(k, i);
        k->next_x[i] = w->next_x;
        k->pause[i] = w->pause;
    }
}

/* Which flights are above all that may wait when they pass `to` after t, and go on so over some of them: up to the end
 * of the segment, or to where the parabola comes down so far. */
FORCE_INLINE unsigned fly_over(struct lanes *k, size_t i, unsigned under_way, real to, real t, real clearance,
                               const struct chord *on)
{
    real zero = splat(0), over_all = clearance - k->tallest;
    mask high = less(zero, over_all) & less(zero, t) & less(load(&k->stem.after[i]), on->x1) & lane_mask(under_way >> i);
    if (!any(high))
        return 0;
    double g = k->g->gravity;
    real vx = load(&k->vx[i]), up = load(&k->vz[i]) - g * t - on->m * vx;
    real seconds = (up + vsqrt(up * up + 2 * g * over_all)) / g;
    store(&k->stem.free_to[i], min(on->x1, to + vx * seconds));
    return lane_bits(high) << i;
}

/* Takes the stem that is before each of `lanes`, where the one behind it waits and is next; of those that are `above`
 * all, more of them. No branch depends on what is hit. */
FORCE_INLINE void take_waiting(struct lanes *k, unsigned lanes, unsigned hit, unsigned above)
{
    uint64_t places = k->job->walkers[0].stems->wood->places;
    for (above &= lanes; above; above &= above - 1) {
        size_t i = (size_t)__builtin_ctz(above);
        const struct stem *stem = k->stem.next[i];
        while (stem[1].along < k->stem.free_to[i] && stem[2].along < k->stem.sure[i])
            stem++; /* to the last of those that wait and are next one after the other, and that it flies over */
        k->stem.next[i] = stem;
    }
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        const struct stem *stem = k->stem.next[i];
        uint64_t *place = &k->stem.met[i][stem->stool & places];
        bool is_hit = hit >> i & 1, shoot = is_hit & stem->shoot;
        k->stem.hit[i] += is_hit;
        k->stem.stools_met[i] += is_hit & !(shoot & (*place == stem->stool));
        *place = shoot ? stem->stool : *place;
        k->stem.next[i] = ++stem;
        k->stem.after[i] = stem[1].along;
        k->stem_ahead[i] = stem->along;
        k->stem.height[i] = stem->height;
        k->stem.cost[i] = stem->energy;
    }
}

/* Each flight under way takes the stem that is before it: as ceduo_walk_take_stem(), at once where the one after it
 * waits already, no mark is passed and no stool stands around the release. */
FORCE_INLINE void take_stems(struct lanes *k, struct passing *p, unsigned hit, unsigned above)
{
    unsigned marks = 0, waits = 0;
    EACH_REGISTER(i) {
        real to = load(&p->to[i]);
        marks |= lane_bits(at_least(to, load(&k->next_x[i]))) << i;
        waits |=
            lane_bits(and_not(less(load(&k->stem.after[i]), load(&k->stem.sure[i])), at_least(load(&k->stem.around[i]), to)))
            << i;
    }
    waits &= ~(marks & hit);
    take_waiting(k, p->under_way & waits, hit, above);
    if (p->under_way & ~waits)
        take_stems_alone(k, p, p->under_way & ~waits, hit);
}

/* How the flights from lane i on pass their next stem. Returns which hit it; those that are in the ground before have no way
 * on; *above: see fly_over(). */
FORCE_INLINE unsigned come_to_stem(struct form form, struct lanes *k, struct passing *p, size_t i, unsigned *above)
{
    real zero = splat(0), to = load(&k->stem_ahead[i]), vz = load(&k->vz[i]), latest = load(&k->t[i]);
    struct chord on = load_chord(&p->on, i);
    go_to_segment(form, k, p, i, to, &on);
    real t = (to - load(&k->x[i])) / load(&k->vx[i]);
    mask knows = lane_mask(p->knows >> i);
    t = blend(less(t, zero), zero, blend(knows & less(latest, t), latest, t));
    real z = height_after(load(&k->z[i]), vz, k->g->half_g, t), clearance = z - chord_height(&on, to);
    unsigned others = ~(REGISTER << i);
    p->under_way &= others | p->knows | lane_bits(at_least(clearance, zero)) << i;
    unsigned hit = p->under_way & lane_bits(less(max(clearance, zero), load(&k->stem.height[i]))) << i;
    store(&p->to[i], to);
    store(&p->t[i], t);
    store(&p->z[i], z);
    store(&p->cost[i], load(&k->stem.cost[i]));
    *above |= fly_over(k, i, p->under_way, to, t, clearance, &on);
    return hit;
}

/* What a hit does to those of the lanes from i on that are `hit`. */
FORCE_INLINE void hit_stem_lanes(struct lanes *k, struct passing *p, size_t i, unsigned hit)
{
    mask h = lane_mask(hit >> i);
    real vx = load(&k->vx[i]), vz = load(&k->vz[i]) - k->g->gravity * load(&p->t[i]), spin = load(&k->spin[i]);
    struct hit blow = {.energy = flying_energy(load(&k->mass[i]), load(&k->moment[i]), vx, vz, spin),
                       .cost = load(&p->cost[i])};
    real share = speed_kept(blow);
    store_ints(&k->segment[i], blend_ints(h, load_ints(&p->here[i]), load_ints(&k->segment[i])));
    store(&p->end[i], blend(h, load(&p->on.x1[i]), load(&p->end[i])));
    store(&k->x[i], blend(h, load(&p->to[i]), load(&k->x[i])));
    store(&k->z[i], blend(h, load(&p->z[i]), load(&k->z[i])));
    store(&k->vx[i], blend(h, vx * share, vx));
    store(&k->vz[i], blend(h, vz * share, load(&k->vz[i])));
    store(&k->spin[i], blend(h, spin * share, spin));
    p->stopped |= lane_bits(and_not(h, less(splat(0), share))) << i;
}

/* The next stem of each flight under way, whose landing comes behind it or is not known. */
FORCE_INLINE void pass_stem(struct form form, struct lanes *k, struct passing *p)
{
    unsigned hit = 0, above = 0, forth = 0, before = 0;
    EACH_REGISTER(i)
        hit |= come_to_stem(form, k, p, i, &above);
    if (!p->under_way)
        return;
    take_stems(k, p, hit, above);
    hit &= ~p->ended;
    p->under_way &= ~p->ended;
    if (hit)
        EACH_REGISTER(i)
            hit_stem_lanes(k, p, i, hit);
    p->moved |= hit;
    p->knows &= ~hit;
    EACH_REGISTER(i) {
        forth |= lane_bits(less(splat(0), load(&k->vx[i]))) << i;
        before |= lane_bits(at_least(load(&k->to_x[i]), load(&k->stem_ahead[i]))) << i;
    }
    p->under_way &= ~p->stopped & forth & (~p->knows | before);
}

/* Behind a hit a lane stands where it was hit, as if it had landed there. */
FORCE_INLINE void land_at_stems(struct form form, struct lanes *k, unsigned moved)
{
    EACH_REGISTER(i) {
        mask m = lane_mask(moved >> i);
        ints segment = load_ints(&k->segment[i]);
        real theta;
        const struct chord on = look_up_chord(form, k, segment, &theta);
        store(&k->t[i], blend(m, splat(0), load(&k->t[i])));
        store(&k->to_x[i], blend(m, load(&k->x[i]), load(&k->to_x[i])));
        store(&k->to_z[i], blend(m, load(&k->z[i]), load(&k->to_z[i])));
        store_ints(&k->to[i], blend_ints(m, segment, load_ints(&k->to[i])));
        store_chord(&k->on, i, pick_chord(m, on, load_chord(&k->on, i)));
    }
    k->left &= ~moved;
}

/* All flights along +x that come to a stem before they land, up to their landing, or to where it must be known.
 * Returns those of which the scalar walk does the rest. */
FORCE_INLINE unsigned pass_stems(struct form form, struct lanes *k)
{
    struct passing p;
    const ints n = splat_ints(k->g->n);
    unsigned begin = 0, alone = 0;
    EACH_REGISTER(i)
        begin |= lane_bits(at_least(load(&k->to_x[i]), load(&k->stem_ahead[i])) & less(splat(0), load(&k->vx[i]))) << i;
    begin &= k->live & ~k->there; /* they come to a stem before they land */
    p.knows = begin & ~k->lost;
    p.under_way = begin | k->lost;
    p.moved = p.stopped = p.ended = 0;
    k->aloft = k->waits = k->lost = 0;
    if (!p.under_way)
        return 0;
    EACH_REGISTER(i) {
        ints here = load_ints(&k->segment[i]), to = load_ints(&k->to[i]);
        real theta;
        const struct chord on = look_up_chord(form, k, here, &theta);
        store_ints(&p.here[i], here);
        store_chord(&p.on, i, on);
        store(&p.end[i], on.x1);
        store_ints(&p.last[i], blend_ints(greater_ints(to, n), n, to));
    }
    unsigned lost = p.under_way & ~p.knows;
    do {
        /* whose landing is not known goes on while the stem stands over the same segment */
        unsigned over = 0;
        EACH_REGISTER(i)
            over |= lane_bits(at_least(load(&p.end[i]), load(&k->stem_ahead[i]))) << i;
        p.under_way &= p.knows | over;
        alone |= p.under_way & k->paused;
        p.under_way &= ~k->paused;
        if (p.under_way)
            pass_stem(form, k, &p);
    } while (__builtin_popcount(p.under_way) > TOO_FEW);
    land_at_stems(form, k, p.moved);
    k->waits = p.under_way;
    k->lost = p.under_way & ~p.knows;
    k->aloft = (p.moved | lost) & ~p.stopped & ~p.ended & ~k->waits;
    for (unsigned done = p.stopped | p.ended; done; done &= done - 1) {
        size_t i = (size_t)__builtin_ctz(done);
        end_alone(k, i, k->x[i], k->z[i], p.stopped >> i & 1 ? CEDUO_STOPPED_BY_STEMS : CEDUO_UNFINISHED);
    }
    return alone;
}

#endif
