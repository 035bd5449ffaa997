/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact of the wide walk: the same operations in the same order as in flying.h, law_*.h, random.h and
 * elementary.h. */
#ifndef CEDUO_WIDE_CONTACT_H
#define CEDUO_WIDE_CONTACT_H

#include "law_crsp.h"
#include "law_lumped.h"
#include "wide_lane.h"
/* after the lanes */
#include "arm_blow.h"

/* ---- random numbers ---- */

LANE void threefry_round(ints *p, ints *q, int turn)
{
    *p = add_ints(*p, *q);
    *q = xor_ints(turn_left(*q, turn), *p);
}

LANE void threefry_key(ints *p, ints *q, ints a, ints b, uint64_t n)
{
    *p = add_ints(*p, a);
    *q = add_ints(*q, add_ints(b, all_ints(n)));
}

LANE reals unit(ints p)
{
    return mul(reals_of(shift_right(p, 11)), all(0x1p-53));
}

/* As random_pair(). */
LANE void draw_pair(uint64_t seed, ints rock, ints event, uint64_t kind, reals *u0, reals *u1)
{
    ints a = all_ints(seed), b = rock, c = xor_ints(all_ints(0x1BD11BDAA9FC1A22 ^ seed), rock);
    ints p = add_ints(event, a), q = add_ints(all_ints(kind), b);
#define FOUR(r1, r2, r3, r4)                                                                                                   \
    threefry_round(&p, &q, r1);                                                                                                \
    threefry_round(&p, &q, r2);                                                                                                \
    threefry_round(&p, &q, r3);                                                                                                \
    threefry_round(&p, &q, r4)
    FOUR(16, 42, 12, 31);
    threefry_key(&p, &q, b, c, 1);
    FOUR(16, 32, 24, 21);
    threefry_key(&p, &q, c, a, 2);
    FOUR(16, 42, 12, 31);
    threefry_key(&p, &q, a, b, 3);
    FOUR(16, 32, 24, 21);
    threefry_key(&p, &q, b, c, 4);
    FOUR(16, 42, 12, 31);
    threefry_key(&p, &q, c, a, 5);
#undef FOUR
    *u0 = unit(p);
    *u1 = unit(q);
}

/* Draws two contacts ahead for every lane, in every second step. A lane at an odd contact has its next draw already. */
LANE void draw_ahead(struct wide *k, enum random_kind kind, double draws[3][LANES])
{
    ints contacts = load_ints(k->contacts), one = all_ints(1);
    flags odd = same(and_ints(contacts, one), one);
    reals u0, u1, first = load(draws[0]);
    draw_pair(k->seed, load_ints(k->number), shift_right(add_ints(contacts, one), 1), kind, &u0, &u1);
    store(draws[0], pick(odd, first, u0));
    store(draws[1], pick(odd, u0, u1));
    store(draws[2], u1);
}

LANE void draw_ahead_of(struct form form, struct wide *k)
{
    draw_ahead(k, RANDOM_FACET, k->draw);
    if (form.law == CEDUO_LAW_ARM)
        draw_ahead(k, RANDOM_TURN, k->turn);
}

/* Those in the air keep theirs. */
LANE reals next_draw(struct form form, const struct wide *k, double draws[3][LANES])
{
    reals u = load(draws[0]), v = load(draws[1]), w = load(draws[2]);
    if (in_the_air(form, k)) {
        flags air = flags_of(in_the_air(form, k));
        w = pick(air, v, w);
        v = pick(air, u, v);
    }
    store(draws[0], v);
    store(draws[1], w);
    return u;
}

/* ---- facet ---- */

LANE reals step_series(reals sum, reals q, double term)
{
    return add(mul(sum, q), all(term));
}

/* As elementary_sincos(). */
LANE void sincos_lanes(reals angle, reals *sine, reals *cosine)
{
    const double half_pi_hi = 1.5707963267948966, half_pi_lo = 6.123233995736766e-17;
    reals a = size_of_each(angle);
    flags swap = less(all(0.7853981633974483), a);
    reals y = pick(swap, add(sub(all(half_pi_hi), a), all(half_pi_lo)), a);
    reals q = mul(y, y);
    reals s = step_series(all(1.0 / 355687428096000.0), q, -1.0 / 1307674368000.0);
    s = step_series(s, q, 1.0 / 6227020800.0);
    s = step_series(s, q, -1.0 / 39916800.0);
    s = step_series(s, q, 1.0 / 362880.0);
    s = step_series(s, q, -1.0 / 5040.0);
    s = step_series(s, q, 1.0 / 120.0);
    s = step_series(s, q, -1.0 / 6.0);
    s = add(y, mul(y, mul(q, s)));
    reals c = step_series(all(1.0 / 20922789888000.0), q, -1.0 / 87178291200.0);
    c = step_series(c, q, 1.0 / 479001600.0);
    c = step_series(c, q, -1.0 / 3628800.0);
    c = step_series(c, q, 1.0 / 40320.0);
    c = step_series(c, q, -1.0 / 720.0);
    c = step_series(c, q, 1.0 / 24.0);
    c = step_series(c, q, -1.0 / 2.0);
    c = add(all(1.0), mul(q, c));
    *sine = with_sign(pick(swap, c, s), angle);
    *cosine = pick(swap, s, c);
}

/* As turn_facet(). */
LANE reals turn_lanes(const struct wide *k, reals u, reals largest)
{
    reals zero = all(0);
    if (!k->against)
        u = sub(mul(all(2), u), all(1));
    return pick(less(zero, largest), mul(largest, u), zero);
}

/* The facet that each rock strikes, as strike_facet(). */
LANE void facet_lanes(const struct wide *k, reals angle, reals along, reals off, reals *sine, reals *cosine)
{
    reals zero = all(0);
    sincos_lanes(angle, sine, cosine);
    if (k->against)
        *sine = pick(at_least(along, zero), *sine, as_reals(xor_ints(as_ints(*sine), all_ints((uint64_t)INT64_MIN))));
    flags leaves = less(zero, sub(mul(off, *cosine), mul(along, *sine)));
    *sine = pick(leaves, zero, *sine);
    *cosine = pick(leaves, all(1), *cosine);
}

/* ---- the laws ---- */

struct impact_lanes {
    reals vn, vt, spin;
};

LANE struct impact_lanes lumped_lanes(struct impact_lanes in, reals rn, reals rt, bool scale_rn)
{
    if (scale_rn) {
        reals s = over(in.vn, all(LUMPED_K));
        rn = over(rn, add(all(1), mul(s, s)));
    }
    return (struct impact_lanes){mul(rn, in.vn), mul(rt, in.vt), all(0)};
}

LANE struct impact_lanes crsp_lanes(struct impact_lanes in, reals rn, reals rt, reals radius, reals k)
{
    reals zero = all(0), one = all(1);
    reals roll = mul(in.spin, radius);
    reals s = over(sub(in.vt, roll), all(CRSP_A));
    reals f = add(rt, over(sub(one, rt), add(mul(s, s), all(1.2))));
    s = over(in.vn, mul(all(CRSP_C), rn));
    reals sf = over(rt, add(mul(s, s), one));
    sf = pick(equal(rn, zero), pick(equal(in.vn, zero), rt, zero), sf);
    reals energy = add(mul(k, mul(roll, roll)), mul(in.vt, in.vt));
    reals vt = root_of(over(mul(energy, mul(f, sf)), add(one, k)));
    s = over(in.vn, all(CRSP_K));
    vt = with_sign(vt, pick(equal(in.vt, zero), in.spin, in.vt));
    return (struct impact_lanes){over(mul(rn, in.vn), add(one, mul(s, s))), vt, over(vt, radius)};
}

/* As law_arm(), turned by turn_section(). */
LANE struct impact_lanes arm_lanes(struct form form, struct wide *k, struct impact_lanes in, ints segment, reals e)
{
    reals gyration = load(k->section.gyration), minus = all(-1);
    struct arm_blow blow = {
        .wide = load(k->section.wide), .high = load(k->section.high), .reach = load(k->section.reach), .e = e};
    look_up(&k->ground->grip, segment, form.small, &blow.mu, &blow.friction);
    reals angle = mul(sub(next_draw(form, k, k->turn), all(0.5)), all(HALF_TURN));
    sincos_lanes(angle, &blow.sine, &blow.cosine);
    struct arm_state to = {.along = in.vt, .off = mul(minus, in.vn), .turn = mul(minus, mul(in.spin, gyration))};
    to = arm_struck(&blow, to);
    return (struct impact_lanes){to.off, to.along, mul(minus, over(to.turn, gyration))};
}

LANE struct impact_lanes law_lanes(struct form form, struct wide *k, struct impact_lanes in, ints segment, reals rn, reals rt)
{
    if (form.law == CEDUO_LAW_LUMPED)
        return lumped_lanes(in, rn, rt, k->scale_rn);
    if (form.law == CEDUO_LAW_ARM)
        return arm_lanes(form, k, in, segment, rn);
    return crsp_lanes(in, rn, rt, load(k->radius), load(k->k));
}

/* ---- one contact in every lane ---- */

/* A rock in each lane, on its trajectory. */
struct rocks {
    reals x, z, vx, vz;
    ints segment;
    reals x0, z0, x1, z1, m, c, s; /* of the segment */
};

struct velocities {
    reals along, off;
};

struct landings {
    reals t, x, z, inv; /* inv: 1/vx */
    ints segment;
    reals x0, z0, x1, z1, m, theta;
    flags left;
    unsigned far; /* to be looked for by the scalar walk */
};

/* Those that the scalar walk brings to the next contact. Of the others: which pass a mark, which leave the slope. */
LANE unsigned disturbed(struct form form, const struct wide *k, unsigned *pass, unsigned *leave)
{
    reals x = load(k->to_x);
    flags mark = both(at_least(x, load(k->next_x)), less(all(0), load(k->vx)));
    flags stem = either(at_least(x, load(k->stem_ahead)), at_least(load(k->stem_behind), x));
    unsigned lands = k->live & ~in_the_air(form, k), flies = lands & ~k->there;
    unsigned many = ~bits_of(more(load_ints(k->pause), load_ints(k->contacts)));
    unsigned alone = (bits_of(stem) & flies) | (many & lands);
    *pass = bits_of(mark) & flies & ~alone;
    *leave = k->left & lands & ~alone;
    return alone;
}

/* All lanes come down. */
LANE struct rocks rocks_down(struct form form, const struct wide *k)
{
    struct rocks r = {.x = load(k->to_x),
                      .z = load(k->to_z),
                      .vx = load(k->vx),
                      .vz = sub(load(k->vz), mul(all(k->g->gravity), load(k->t))),
                      .segment = load_ints(k->to),
                      .x0 = load(k->x0),
                      .z0 = load(k->z0),
                      .x1 = load(k->x1),
                      .z1 = load(k->z1),
                      .m = load(k->m)};
    look_up(&k->ground->tilt, r.segment, form.small, &r.c, &r.s);
    return r;
}

LANE struct velocities velocities_on(const struct wide *k, const struct rocks *r)
{
    struct velocities v = {.along = add(mul(r->vx, r->c), mul(r->vz, r->s)), .off = sub(mul(r->vz, r->c), mul(r->vx, r->s))};
    if (k->rolls) {
        flags rolls = flags_of(k->rolls);
        v.along = pick(rolls, load(k->along), v.along);
        v.off = pick(rolls, all(0), v.off);
    }
    return v;
}

/* The ground that each rock strikes, where that varies from rock to rock. */
static __attribute__((noinline)) void ground_alone(struct form form, struct wide *k)
{
    for (size_t i = 0; i < LANES; i++)
        if ((k->live & ~in_the_air(form, k)) >> i & 1)
            ceduo_walk_ground(&k->job->walkers[i], k->to[i] - 1, &k->rn[i], &k->rt[i], &k->theta[i]);
}

LANE void strike_lanes(struct form form, struct wide *k, struct rocks *r, struct velocities *v)
{
    reals rn, rt, sine, cosine, zero = all(0);
    if (k->varies) {
        ground_alone(form, k);
        rn = load(k->rn);
        rt = load(k->rt);
    } else {
        look_up(&k->ground->share, r->segment, form.small, &rn, &rt);
    }
    reals angle = turn_lanes(k, next_draw(form, k, k->draw), load(k->theta));
    facet_lanes(k, angle, v->along, v->off, &sine, &cosine);
    reals inward = sub(mul(v->along, sine), mul(v->off, cosine));
    struct impact_lanes in = {.vn = pick(less(zero, inward), inward, zero),
                              .vt = add(mul(v->along, cosine), mul(v->off, sine)),
                              .spin = load(k->spin)};
    struct impact_lanes out = law_lanes(form, k, in, r->segment, rn, rt);
    v->along = sub(mul(out.vt, cosine), mul(out.vn, sine));
    v->off = add(mul(out.vt, sine), mul(out.vn, cosine));
    v->off = pick(less(zero, v->off), v->off, zero);
    r->vx = sub(mul(v->along, r->c), mul(v->off, r->s));
    r->vz = add(mul(v->along, r->s), mul(v->off, r->c));
    if (in_the_air(form, k)) { /* they strike nothing */
        flags air = flags_of(in_the_air(form, k));
        r->vx = pick(air, load(k->vx), r->vx);
        r->vz = pick(air, load(k->vz), r->vz);
        out.spin = pick(air, load(k->spin), out.spin);
    }
    store(k->spin, out.spin);
    store(k->vx, r->vx);
    store(k->vz, r->vz);
}

#endif
