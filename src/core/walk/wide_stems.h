/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flights of the wide walk among stems: the same operations in the same order as in flying.h. Behind a hit a lane is
 * aloft: its landing is looked for when the next stem stands beyond its segment, together with those of the lanes that
 * come from a contact. */
#ifndef CEDUO_WIDE_STEMS_H
#define CEDUO_WIDE_STEMS_H

#include "hit.h"
#include "wide_landing.h"

#ifndef TOO_FEW
#define TOO_FEW (LANES / 4) /* so few lanes among stems wait until there are more; only speed depends on it */
#endif

/* Flights on their way past stems, and over which segments. */
struct passing {
    reals x, z, vx, vz, spin;
    ints segment, last;      /* under the rock; the last that its flight may come to */
    ints here;               /* under the stem */
    reals end;               /* x where `segment` ends */
    reals x0, z0, x1, z1, m; /* of `here` */
    /* bit i is lane i */
    unsigned under_way;
    unsigned knows;   /* its landing */
    unsigned moved;   /* was hit */
    unsigned stopped; /* by a stem */
    unsigned ended;   /* given up */
};

LANE void look_here(struct form form, const struct wide *k, struct passing *p)
{
    reals theta;
    look_up(&k->ground->place, p->here, form.small, &p->x0, &p->z0);
    look_up(&k->ground->place, add_ints(p->here, all_ints(1)), form.small, &p->x1, &p->z1);
    look_up(&k->ground->slope, p->here, form.small, &p->m, &theta);
}

/* The segment under each stem at `to`, for flights that know where they land; as segment_between(). */
LANE void go_to_segment(struct form form, const struct wide *k, struct passing *p, reals to)
{
    unsigned far = p->under_way & p->knows & ~bits_of(at_least(p->end, to));
    unsigned on = far & bits_of(both(at_least(to, p->x1), more(p->last, p->here)));
    while (on) {
        p->here = pick_ints(flags_of(on), add_ints(p->here, all_ints(1)), p->here);
        look_here(form, k, p);
        on &= bits_of(both(at_least(to, p->x1), more(p->last, p->here)));
    }
}

/* The scalar walk takes the stem that is before lane i. */
static void take_stem_alone(struct wide *k, struct passing *p, size_t i, bool hit, struct flight at, double t)
{
    struct walker *w = &k->job->walkers[i];
    if (!ceduo_walk_take_stem(w, hit, at, t))
        p->ended |= 1u << i;
    load_stem(k, i);
}

/* The same for each of `lanes`, of which no flight passes a mark. */
static __attribute__((noinline)) void take_stems_alone(struct wide *k, struct passing *p, unsigned lanes, unsigned hit)
{
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        show_stems_met(k, i);
        take_stem_alone(k, p, i, hit >> i & 1, (struct flight){0}, 0);
    }
}

/* Of each of `lanes`, whose flights pass marks up to the stem that they hit. */
static __attribute__((noinline)) void take_stems_past_marks(struct wide *k, struct passing *p, unsigned lanes, reals t)
{
    _Alignas(64) double x[LANES], z[LANES], vx[LANES], vz[LANES], spin[LANES], seconds[LANES];
    store(x, p->x);
    store(z, p->z);
    store(vx, p->vx);
    store(vz, p->vz);
    store(spin, p->spin);
    store(seconds, t);
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        struct walker *w = &k->job->walkers[i];
        struct flight at = {.x = x[i], .z = z[i], .vx = vx[i], .vz = vz[i]};
        w->spin = spin[i];
        show_stems_met(k, i);
        take_stem_alone(k, p, i, true, at, seconds[i]);
        k->next_x[i] = w->next_x;
        k->pause[i] = w->pause;
    }
}

/* Which flights are above all that may wait when they pass `to` after t, and go on so over some of them: up to the end
 * of the segment, or to where the parabola comes down so far. */
LANE unsigned fly_over(struct wide *k, const struct passing *p, reals to, reals t, reals clearance)
{
    reals over_all = sub(clearance, all(k->tallest));
    flags high = both(both(less(all(0), over_all), less(all(0), t)), less(load(k->stem.after), p->x1));
    unsigned above = p->under_way & bits_of(high);
    if (!above)
        return 0;
    reals g = all(k->g->gravity), up = sub(sub(p->vz, mul(g, t)), mul(p->m, p->vx));
    reals seconds = over(add(up, root_of(add(mul(up, up), mul(mul(all(2), g), over_all)))), g);
    store(k->stem.free_to, least(p->x1, add(to, mul(p->vx, seconds))));
    return above;
}

/* The last of those that wait and are next one after the other, and that lane i flies over from its next stem on. */
LANE const struct stem *last_below(const struct wide *k, size_t i)
{
    const struct stem *stem = k->stem.next[i];
    while (stem[1].along < k->stem.free_to[i] && stem[2].along < k->stem.sure[i])
        stem++;
    return stem;
}

/* Takes the stem that is before each of `lanes`, where the one behind it waits and is next; of those that are `above`
 * all, more of them. No branch depends on what is hit. */
LANE void take_waiting(struct wide *k, unsigned lanes, unsigned hit, unsigned above)
{
    const struct wood *wood = k->job->walkers[0].stems->wood;
    uint64_t places = wood->places;
    unsigned shares = wood->shares ? lanes : 0;
    for (above &= lanes; above; above &= above - 1) {
        size_t i = (size_t)__builtin_ctz(above);
        k->stem.next[i] = last_below(k, i);
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
    for (; shares; shares &= shares - 1) {
        size_t i = (size_t)__builtin_ctz(shares);
        load_hit(k, i, k->stem.next[i]);
    }
}

/* Each flight under way takes the stem that is before it: as ceduo_walk_take_stem(), at once where the one after it
 * waits already, no mark is passed and no stool stands around the release. */
LANE void take_stems(struct wide *k, struct passing *p, unsigned hit, unsigned above, reals t)
{
    reals to = load(k->stem_ahead);
    unsigned marks = hit & bits_of(at_least(to, load(k->next_x)));
    unsigned waits = bits_of(but(less(load(k->stem.after), load(k->stem.sure)), at_least(load(k->stem.around), to)));
    unsigned alone = p->under_way & ~marks & ~waits;
    take_waiting(k, p->under_way & ~marks & waits, hit, above);
    if (alone)
        take_stems_alone(k, p, alone, hit);
    if (marks)
        take_stems_past_marks(k, p, marks, t);
}

/* The next stem of each flight under way, whose landing comes behind it or is not known. */
LANE void pass_stem(struct form form, struct wide *k, struct passing *p)
{
    reals zero = all(0), to = load(k->stem_ahead), height = load(k->stem.height);
    reals cost = load(k->stem.cost), part = load(k->stem.part);
    flags knows = flags_of(p->knows);
    go_to_segment(form, k, p, to);
    reals t = over(sub(to, p->x), p->vx), latest = load(k->t);
    t = pick(less(t, zero), zero, pick(both(knows, less(latest, t)), latest, t));
    reals z = add(p->z, mul(sub(p->vz, mul(all(k->g->half_g), t)), t));
    reals ground = pick(at_least(to, p->x1), p->z1, add(p->z0, mul(p->m, sub(to, p->x0))));
    reals clearance = sub(z, ground);
    p->under_way &= p->knows | bits_of(at_least(clearance, zero));
    unsigned hit = p->under_way & bits_of(less(most(clearance, zero), height));
    if (!p->under_way)
        return;
    take_stems(k, p, hit, fly_over(k, p, to, t, clearance), t);
    hit &= ~p->ended;
    p->under_way &= ~p->ended;
    if (hit) {
        flags h = flags_of(hit);
        p->segment = pick_ints(h, p->here, p->segment);
        p->end = pick(h, p->x1, p->end);
        p->x = pick(h, to, p->x);
        p->z = pick(h, z, p->z);
        p->vz = pick(h, sub(p->vz, mul(all(k->g->gravity), t)), p->vz);
        struct hit blow = {
            .energy = flying_energy(load(k->mass), load(k->moment), p->vx, p->vz, p->spin), .cost = cost, .part = part};
        reals share = speed_kept(blow);
        p->vx = pick(h, mul(p->vx, share), p->vx);
        p->vz = pick(h, mul(p->vz, share), p->vz);
        p->spin = pick(h, mul(p->spin, share), p->spin);
        p->stopped |= hit & ~bits_of(less(zero, share));
        p->moved |= hit;
        p->knows &= ~hit;
    }
    p->under_way &= ~p->stopped & bits_of(less(zero, p->vx));
    p->under_way &= ~p->knows | bits_of(at_least(load(k->to_x), load(k->stem_ahead)));
}

/* Behind a hit a lane stands where it was hit, as if it had landed there. */
LANE void store_passing(struct form form, struct wide *k, struct passing *p)
{
    flags moved = flags_of(p->moved);
    reals theta;
    p->here = p->segment;
    look_here(form, k, p);
    look_up(&k->ground->slope, p->segment, form.small, &p->m, &theta);
    store(k->x, pick(moved, p->x, load(k->x)));
    store(k->z, pick(moved, p->z, load(k->z)));
    store(k->vx, pick(moved, p->vx, load(k->vx)));
    store(k->vz, pick(moved, p->vz, load(k->vz)));
    store(k->spin, pick(moved, p->spin, load(k->spin)));
    store_ints(k->segment, pick_ints(moved, p->segment, load_ints(k->segment)));
    store(k->t, pick(moved, all(0), load(k->t)));
    store(k->to_x, pick(moved, p->x, load(k->to_x)));
    store(k->to_z, pick(moved, p->z, load(k->to_z)));
    store_ints(k->to, pick_ints(moved, p->segment, load_ints(k->to)));
    store(k->x0, pick(moved, p->x0, load(k->x0)));
    store(k->z0, pick(moved, p->z0, load(k->z0)));
    store(k->x1, pick(moved, p->x1, load(k->x1)));
    store(k->z1, pick(moved, p->z1, load(k->z1)));
    store(k->m, pick(moved, p->m, load(k->m)));
    k->left &= ~p->moved;
}

/* All flights along +x that come to a stem before they land, up to their landing, or to where it must be known.
 * Returns those of which the scalar walk does the rest. */
LANE unsigned pass_stems(struct form form, struct wide *k)
{
    reals zero = all(0);
    struct passing p;
    p.vx = load(k->vx);
    flags way = both(at_least(load(k->to_x), load(k->stem_ahead)), less(zero, p.vx));
    unsigned begin = bits_of(way) & k->live & ~k->there, alone = 0;
    p.knows = begin & ~k->lost;
    p.under_way = begin | k->lost;
    p.moved = p.stopped = p.ended = 0;
    k->aloft = k->waits = k->lost = 0;
    if (!p.under_way)
        return 0;
    p.x = load(k->x);
    p.z = load(k->z);
    p.vz = load(k->vz);
    p.spin = load(k->spin);
    p.here = p.segment = load_ints(k->segment);
    ints n = all_ints(k->g->n), to = load_ints(k->to);
    p.last = pick_ints(more(to, n), n, to);
    look_here(form, k, &p);
    p.end = p.x1;
    unsigned lost = p.under_way & ~p.knows;
    do {
        /* whose landing is not known goes on while the stem stands over the same segment */
        p.under_way &= p.knows | bits_of(at_least(p.end, load(k->stem_ahead)));
        alone |= p.under_way & k->paused;
        p.under_way &= ~k->paused;
        if (p.under_way)
            pass_stem(form, k, &p);
    } while (__builtin_popcount(p.under_way) > TOO_FEW);
    store_passing(form, k, &p);
    k->waits = p.under_way;
    k->lost = p.under_way & ~p.knows;
    k->aloft = (p.moved | lost) & ~p.stopped & ~p.ended & ~k->waits;
    for (unsigned done = p.stopped | p.ended; done; done &= done - 1) {
        size_t i = (size_t)__builtin_ctz(done);
        stop_alone(k, i, p.stopped >> i & 1 ? CEDUO_STOPPED_BY_STEMS : CEDUO_UNFINISHED);
    }
    return alone;
}

#endif
