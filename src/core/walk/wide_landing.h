/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From one contact of the wide walk to the next, in flight or rolling: the same operations in the same order as in
 * landing.h and rolling.h. */
#ifndef CEDUO_WIDE_LANDING_H
#define CEDUO_WIDE_LANDING_H

#include "wide_far.h"

/* ---- landing ---- */

LANE reals height_at(const struct wide *k, const struct rocks *r, reals t)
{
    return add(r->z, mul(sub(r->vz, mul(all(k->g->half_g), t)), t));
}

/* Flights that are above vertex p, on to the next. */
struct search {
    ints p, step;
    flags going;
    reals inv;
};

LANE void search_on(struct form form, const struct wide *k, const struct rocks *r, struct search *s)
{
    ints q = add_ints(s->p, s->step);
    reals x, z;
    look_up(&k->ground->place, form.wraps ? q : pick_ints(s->going, q, s->p), form.small, &x, &z);
    reals t = mul(sub(x, r->x), s->inv);
    s->going = both(s->going, at_least(sub(height_at(k, r, t), z), all(0)));
    s->p = pick_ints(s->going, q, s->p);
}

/* Leaves those out that have come to where blocks of segments begin; returns them. */
LANE unsigned leave_far(struct search *s)
{
    flags far = both(s->going, same(and_ints(s->p, all_ints(((uint64_t)1 << GROUND_BITS) - 1)), all_ints(1)));
    s->going = but(s->going, far);
    return bits_of(far);
}

/* Which segment each flight lands on, not yet where. As land_towards() and land_beyond(). */
LANE struct landings find_segments(struct form form, const struct wide *k, const struct rocks *r)
{
    ints one = all_ints(1), none = all_ints(0), back = all_ints(UINT64_MAX);
    reals zero = all(0), inv = over(all(1), r->vx);
    flags forth = less(zero, r->vx);
    reals t = mul(sub(pick(forth, r->x1, r->x0), r->x), inv);
    flags clear = at_least(sub(r->vz, mul(r->m, r->vx)), mul(all(k->g->half_g), t));
    if (form.wood && k->aloft) {
        flags above = at_least(sub(height_at(k, r, t), pick(forth, r->z1, r->z0)), zero);
        clear = pick_flags(flags_of(k->aloft), above, clear);
    }
    struct landings l = {.inv = inv};
    l.far = k->live & ~bits_of(either(forth, less(r->vx, zero)));
    clear = both(clear, flags_of(k->live & ~l.far));
    /* the vertex that the flight comes to, if it is on the ground before that is the end of its segment */
    struct search s = {.step = pick_ints(forth, one, back), .going = clear, .inv = inv};
    s.p = add_ints(r->segment, pick_ints(forth, none, one));
    s.p = add_ints(s.p, pick_ints(clear, s.step, none));
    if (k->far) {
        flags on = both(s.going, forth);
        s.going = but(s.going, forth);
        s.p = search_far_lanes(k, r, inv, bits_of(on), s.p);
        while (l.far |= leave_far(&s), bits_of(s.going))
            search_on(form, k, r, &s);
    } else { /* mostly not more than three: no wrong guess of a branch */
        search_on(form, k, r, &s);
        search_on(form, k, r, &s);
        search_on(form, k, r, &s);
        while (bits_of(s.going))
            search_on(form, k, r, &s);
    }
    l.segment = add_ints(s.p, pick_ints(forth, none, back));
    l.left = either(same(l.segment, none), same(l.segment, all_ints(k->g->n + 1)));
    return l;
}

/* As later_root(). */
LANE reals later_root_lanes(const struct wide *k, reals c, reals b)
{
    reals zero = all(0), g = all(k->g->gravity);
    reals d = add(mul(b, b), mul(all(2 * k->g->gravity), c));
    reals root = pick(less(zero, d), root_of(d), zero);
    flags up = at_least(b, zero), some = either(up, less(zero, c));
    reals t = over(pick(up, add(b, root), mul(all(2), c)), pick(up, g, sub(root, b)));
    return pick(some, t, zero);
}

/* As clamp(v, a, b) with a <= b. */
LANE reals clamp_lanes(reals v, reals a, reals b)
{
    return least(b, most(a, v));
}

/* Where the flights land on their segments. As land_on() and land_at(). */
LANE void land_lanes(struct form form, const struct wide *k, const struct rocks *r, struct landings *l)
{
    ints behind = add_ints(l->segment, all_ints(1));
    flags here = same(l->segment, r->segment);
    if (form.wood)
        here = but(here, flags_of(k->aloft));
    look_up(&k->ground->slope, l->segment, form.small, &l->m, &l->theta);
    look_up(&k->ground->place, l->segment, form.small, &l->x0, &l->z0);
    look_up(&k->ground->place, behind, form.small, &l->x1, &l->z1);
    reals latest = mul(sub(pick(less(all(0), r->vx), l->x1, l->x0), r->x), l->inv);
    reals c = sub(r->z, add(l->z0, mul(l->m, sub(r->x, l->x0))));
    reals t = later_root_lanes(k, pick(here, all(0), c), sub(r->vz, mul(l->m, r->vx)));
    l->t = t = least(latest, t);
    reals x = clamp_lanes(add(r->x, mul(r->vx, t)), l->x0, l->x1);
    reals z = pick(at_least(x, l->x1), l->z1, add(l->z0, mul(l->m, sub(x, l->x0))));
    flags steep = less(all(1), size_of_each(l->m));
    if (bits_of(steep)) {
        reals lo = least(l->z0, l->z1), hi = most(l->z1, l->z0);
        reals sz = clamp_lanes(height_at(k, r, t), lo, hi);
        reals sx = clamp_lanes(add(l->x0, over(sub(sz, l->z0), l->m)), l->x0, l->x1);
        sx = pick(equal(sz, l->z1), l->x1, sx);
        x = pick(steep, sx, x);
        z = pick(steep, sz, z);
    }
    l->x = x;
    l->z = z;
}

/* Those that fly over an end of the profile. */
LANE void leave_lanes(const struct wide *k, const struct rocks *r, struct landings *l)
{
    reals end = pick(less(all(0), r->vx), l->x0, l->x1);
    reals t = mul(sub(end, r->x), l->inv);
    l->t = pick(l->left, t, l->t);
    l->x = pick(l->left, end, l->x);
    l->z = pick(l->left, height_at(k, r, t), l->z);
}

/* ---- rolling ---- */

/* Whether x, z is less than a radius of ground away, surely, or more, surely: without a division, and not told where
 * rounding might matter. As ground_length() against the radius. */
LANE void is_within(const struct rocks *r, flags steep, reals x, reals z, reals radius, flags *less_far, flags *farther)
{
    const double margin = 0x1p-48;
    reals d = size_of_each(pick(steep, sub(z, r->z), sub(x, r->x)));
    reals reach = size_of_each(mul(radius, pick(steep, r->s, r->c)));
    *less_far = less(d, mul(reach, all(1 - margin)));
    *farther = less(mul(reach, all(1 + margin)), d);
}

/* Those that roll, as is_roll(); `unsure`: where the scalar walk looks again, as those that land on another segment. */
LANE unsigned rolling(struct form form, const struct wide *k, const struct rocks *r, reals off, const struct landings *l,
                      flags steep, unsigned *unsure)
{
    reals radius = load(k->radius);
    unsigned lands = k->live & ~in_the_air(form, k);
    flags near = but(less(size_of_each(sub(l->x, r->x)), radius), l->left);
    flags low = less(mul(off, off), mul(radius, mul(all(2 * k->g->gravity), r->c)));
    flags may = both(near, low), here = same(l->segment, r->segment), less_far, farther;
    is_within(r, steep, l->x, l->z, radius, &less_far, &farther);
    flags rolls = both(both(may, here), less_far);
    *unsure = bits_of(but(but(may, rolls), both(here, farther))) & lands;
    return bits_of(rolls) & lands;
}

/* The point a roll of a radius further; as roll_point(). */
LANE void roll_point_lanes(const struct rocks *r, flags steep, reals c, reals s, reals radius, reals *x, reals *z)
{
    reals fx = clamp_lanes(add(r->x, mul(c, radius)), r->x0, r->x1);
    reals fz = pick(at_least(fx, r->x1), r->z1, add(r->z0, mul(r->m, sub(fx, r->x0))));
    *x = fx;
    *z = fz;
    if (bits_of(steep)) {
        reals lo = least(r->z0, r->z1), hi = most(r->z1, r->z0);
        reals sz = clamp_lanes(add(r->z, mul(s, radius)), lo, hi);
        reals sx = clamp_lanes(add(r->x0, over(sub(sz, r->z0), r->m)), r->x0, r->x1);
        *x = pick(steep, sx, fx);
        *z = pick(steep, sz, fz);
    }
}

/* Rolls those of `rolls` that stay on their segment, do not stop and meet nothing, for a radius to the next contact; as
 * roll_on(). Returns them. */
LANE unsigned roll_lanes(struct form form, struct wide *k, struct rocks *r, reals along, flags steep, unsigned rolls,
                         struct landings *l)
{
    reals zero = all(0), radius = load(k->radius), u = along, share = all(1);
    if (form.law != CEDUO_LAW_LUMPED) {
        reals spin = load(k->spin), inertia = load(k->k);
        share = add(all(1), inertia);
        u = over(add(along, mul(mul(inertia, spin), radius)), share);
    }
    flags forth = less(zero, u);
    reals dir = pick(forth, all(1), all(-1));
    flags ends, stays;
    is_within(r, steep, pick(forth, r->x1, r->x0), pick(forth, r->z1, r->z0), radius, &ends, &stays);
    reals s = mul(dir, r->s), c = mul(dir, r->c), up = mul(pick(forth, all(-1), all(1)), r->s);
    reals mu, friction;
    look_up(&k->ground->grip, r->segment, form.small, &mu, &friction);
    reals rate = mul(all(2 * k->g->gravity), sub(up, mul(friction, r->c)));
    if (form.law != CEDUO_LAW_LUMPED)
        rate = over(rate, share);
    reals u2 = add(mul(u, u), mul(rate, radius)), x, z;
    roll_point_lanes(r, both(steep, flags_of(rolls)), c, s, radius, &x, &z);
    flags meets = pick_flags(forth, either(at_least(x, load(k->next_x)), at_least(x, load(k->stem_ahead))),
                             at_least(load(k->stem_behind), x));
    flags good = but(both(stays, less(zero, u2)), either(meets, equal(u, zero)));
    rolls &= bits_of(good);
    flags which = flags_of(rolls);
    u = mul(dir, root_of(u2));
    l->t = pick(which, zero, l->t);
    l->x = pick(which, x, l->x);
    l->z = pick(which, z, l->z);
    r->x = pick(which, x, r->x);
    r->z = pick(which, z, r->z);
    store(k->along, u);
    store(k->vx, pick(which, mul(u, r->c), r->vx));
    store(k->vz, pick(which, mul(u, r->s), r->vz));
    if (form.law != CEDUO_LAW_LUMPED)
        store(k->spin, pick(which, over(u, radius), load(k->spin)));
    return rolls;
}

#endif
