/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WIDE_WALK_H
#define CEDUO_WIDE_WALK_H

/* The wide walk on the lanes of lanes.h; see wide.h. What is computed here and in wide_*.h is computed by walk.c for
 * one rock: the same operations in the same order. */

#include "wide_landing.h"
#include "wide_stems.h"

/* ---- all contacts ---- */

/* Those that wait stay as they are. */
LANE void store_lanes(struct form form, struct wide *k, struct rocks *r, struct landings *l)
{
    if (form.wood && k->waits) {
        flags waits = flags_of(k->waits);
        r->x = pick(waits, load(k->x), r->x);
        r->z = pick(waits, load(k->z), r->z);
        r->segment = pick_ints(waits, load_ints(k->segment), r->segment);
        l->t = pick(waits, load(k->t), l->t);
        l->x = pick(waits, load(k->to_x), l->x);
        l->z = pick(waits, load(k->to_z), l->z);
        l->segment = pick_ints(waits, load_ints(k->to), l->segment);
        l->x0 = pick(waits, load(k->x0), l->x0);
        l->z0 = pick(waits, load(k->z0), l->z0);
        l->x1 = pick(waits, load(k->x1), l->x1);
        l->z1 = pick(waits, load(k->z1), l->z1);
        l->m = pick(waits, load(k->m), l->m);
        l->theta = pick(waits, load(k->theta), l->theta);
    }
    store(k->x, r->x);
    store(k->z, r->z);
    store_ints(k->segment, r->segment);
    store(k->t, l->t);
    store(k->to_x, l->x);
    store(k->to_z, l->z);
    store_ints(k->to, l->segment);
    store(k->x0, l->x0);
    store(k->z0, l->z0);
    store(k->x1, l->x1);
    store(k->z1, l->z1);
    store(k->m, l->m);
    store(k->theta, l->theta);
}

/* Of `lanes`, `far` do not know where they land. */
LANE void go_off_one_by_one(struct wide *k, unsigned lanes, unsigned far, const struct velocities *v)
{
    _Alignas(64) double along[LANES], off[LANES];
    store(along, v->along);
    store(off, v->off);
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        k->along[i] = along[i];
        go_off_alone(k, i, off[i], !(far >> i & 1));
    }
}

LANE void step_lanes(struct form form, struct wide *k, bool even)
{
    unsigned pass, leave, alone = form.wood ? pass_stems(form, k) : 0;
    alone |= disturbed(form, k, &pass, &leave);
    pass &= ~alone;
    leave &= ~alone;
    for (; pass; pass &= pass - 1)
        pass_marks_alone(k, (size_t)__builtin_ctz(pass));
    for (; leave; leave &= leave - 1)
        leave_alone(k, (size_t)__builtin_ctz(leave));
    for (; alone; alone &= alone - 1)
        come_down_alone(k, (size_t)__builtin_ctz(alone));
    if (even)
        draw_ahead_of(form, k);
    else
        for (; k->fresh; k->fresh &= k->fresh - 1)
            load_draws(k, (size_t)__builtin_ctz(k->fresh));
    k->fresh = 0;
    struct rocks r = rocks_down(form, k);
    struct velocities v = velocities_on(k, &r);
    strike_lanes(form, k, &r, &v);
    ints one = all_ints(1);
    if (form.wood)
        one = pick_ints(flags_of(in_the_air(form, k)), all_ints(0), one);
    store_ints(k->contacts, add_ints(load_ints(k->contacts), one));
    struct landings l = find_segments(form, k, &r);
    land_lanes(form, k, &r, &l);
    unsigned waits = form.wood ? k->waits : 0;
    k->left = (bits_of(l.left) & k->live & ~waits) | (k->left & waits);
    l.far &= ~waits;
    leave_lanes(k, &r, &l);
    flags steep = less(all(1), size_of_each(r.m));
    unsigned unsure, rolls = rolling(form, k, &r, v.off, &l, steep, &unsure) & ~l.far;
    alone = l.far | unsure | rolls;
    k->rolls = rolls ? roll_lanes(form, k, &r, v.along, steep, rolls, &l) : 0;
    k->there = k->rolls;
    alone &= ~k->rolls;
    store_lanes(form, k, &r, &l);
    unsigned still_aloft = form.wood ? alone & k->aloft : 0;
    alone &= ~still_aloft;
    k->aloft = still_aloft;
    for (; still_aloft; still_aloft &= still_aloft - 1) /* untaken: rounding */
        come_down_alone(k, (size_t)__builtin_ctz(still_aloft));
    if (alone)
        go_off_one_by_one(k, alone, l.far, &v);
}

/* Few are left: one after the other to its end. */
static void finish_alone(struct wide *k)
{
    for (; k->live; k->live &= k->live - 1) {
        size_t i = (size_t)__builtin_ctz(k->live);
        struct walker *w = &k->job->walkers[i];
        struct course c = course_of(k, i);
        if (!c.flies && !(k->rolls >> i & 1)) { /* a rock that has just begun */
            const struct ground_segment *s = &k->g->segments[c.at.segment];
            c.v = (struct velocity){.along = c.at.vx * s->c + c.at.vz * s->s, .off = c.at.vz * s->c - c.at.vx * s->s};
        }
        enum ceduo_end end;
        if (!c.aloft || ceduo_walk_come_down(w, &c, &end))
            end = ceduo_walk_on(w, &c, k->job->law);
        k->job->ended(k->job->context, i, end);
    }
}

HOT void walk_lanes(struct form form, struct wide *k)
{
    for (uint64_t step = 0;; step++) {
        if (k->empty && __builtin_popcount(k->live) <= LANES / 4)
            break;
        step_lanes(form, k, step % 2 == 0);
    }
    finish_alone(k);
}

/* With what is known of the ground and the law compiled in. */
HOT void walk_among(enum ceduo_law law, bool small, bool wood, struct wide *k)
{
    if (law == CEDUO_LAW_LUMPED && small)
        walk_lanes((struct form){CEDUO_LAW_LUMPED, true, LOOK_UP_WRAPS, wood}, k);
    else if (law == CEDUO_LAW_LUMPED)
        walk_lanes((struct form){CEDUO_LAW_LUMPED, false, false, wood}, k);
    else if (law == CEDUO_LAW_CRSP && small)
        walk_lanes((struct form){CEDUO_LAW_CRSP, true, LOOK_UP_WRAPS, wood}, k);
    else if (law == CEDUO_LAW_CRSP)
        walk_lanes((struct form){CEDUO_LAW_CRSP, false, false, wood}, k);
    else if (small)
        walk_lanes((struct form){CEDUO_LAW_ARM, true, LOOK_UP_WRAPS, wood}, k);
    else
        walk_lanes((struct form){CEDUO_LAW_ARM, false, false, wood}, k);
}

static void wide_walk(const struct wide_job *job)
{
    const struct walker *w = &job->walkers[0];
    struct wide k = {.job = job, .ground = job->ground, .live = ALL_LANES};
    for (size_t i = 0; i < LANES; i++) {
        k.radius[i] = 1;
        refill(&k, i);
    }
    if (!k.live)
        return;
    k.g = w->g;
    k.seed = w->seed;
    bool small = job->ground->small;
    k.far = k.g->top > 0;
    k.varies = k.g->rn_varies || k.g->rt_varies || k.g->theta_varies;
    k.against = k.g->facets == CEDUO_AGAINST;
    k.scale_rn = w->scale_rn;
    k.tallest = w->stems ? w->stems->wood->tallest + 1e-6 : 0; /* more than rounding can make of a height */
    if (w->stems)
        walk_among(job->law, small, true, &k);
    else
        walk_among(job->law, small, false, &k);
}

#endif
