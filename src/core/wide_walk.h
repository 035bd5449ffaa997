/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WIDE_WALK_H
#define CEDUO_WIDE_WALK_H

/* The wide walk on the lanes of lanes.h; see wide.h. What is computed here is computed by walk.c, landing.h, law_*.h,
 * random.h and elementary.h for one rock: the same operations in the same order. */

#include <math.h>

#include "lanes.h"
#include "law_crsp.h"
#include "law_lumped.h"
#include "wide.h"

/* What is known before the first step, so that the steps are compiled for it. */
struct form {
    enum ceduo_law law;
    bool small; /* the tables have 16 numbers */
    bool wraps; /* and what is looked up beyond them does no harm */
};

/* All rocks in the lanes, as they come round to the next contact. `segment` and `to` count from 1, as the tables of struct
 * wide_ground do; 0 and n + 1 lie off the slope. */
struct wide {
    const struct wide_job *job;
    const struct wide_ground *ground;
    const struct ground *g;
    uint64_t seed;
    bool far;    /* the ground has blocks */
    bool varies; /* the ground from rock to rock */
    bool against, scale_rn;

    _Alignas(64) double x[LANES], z[LANES], vx[LANES], vz[LANES], spin[LANES];
    uint64_t segment[LANES];
    /* the landing to come, with the ends, slope and largest facet angle of its segment */
    double t[LANES], to_x[LANES], to_z[LANES];
    uint64_t to[LANES];
    double x0[LANES], z0[LANES], x1[LANES], z1[LANES], m[LANES], theta[LANES];
    double along[LANES];   /* of those that roll */
    double draw[3][LANES]; /* for the facets of the next contacts */
    double next_x[LANES], stem_ahead[LANES], stem_behind[LANES];
    double radius[LANES], k[LANES];
    double rn[LANES], rt[LANES]; /* where the ground varies */
    uint64_t contacts[LANES], pause[LANES], number[LANES];

    /* bit i is lane i */
    unsigned live;  /* has a rock */
    unsigned there; /* is at its next contact already */
    unsigned rolls; /* of these: with speed `along` on the ground */
    unsigned left;  /* lands off the slope */
    unsigned fresh; /* has no draws yet */
    bool empty;     /* no rock waits */
    bool same_start; /* every rock comes to its first contact as `start`, without passing a mark */
    struct course start;
};

/* ---- one lane and its walker ---- */

static void load_draws(struct wide *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    struct random_pair pair = random_pair(w->seed, w->number, w->contacts >> 1, RANDOM_FACET);
    k->draw[0][i] = pair.u[w->contacts & 1];
    k->draw[1][i] = pair.u[1];
}

/* What the walker knows of itself and the scalar walk may have changed. */
static void load_walker(struct wide *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    k->spin[i] = w->spin;
    k->next_x[i] = w->next_x;
    k->stem_ahead[i] = w->stem_ahead;
    k->stem_behind[i] = w->stem_behind;
    k->contacts[i] = w->contacts;
    k->pause[i] = w->pause;
}

static void load_course(struct wide *k, size_t i, const struct course *c)
{
    const struct wide_ground *ground = k->ground;
    load_walker(k, i);
    k->x[i] = c->at.x;
    k->z[i] = c->at.z;
    k->vx[i] = c->at.vx;
    k->vz[i] = c->at.vz;
    k->segment[i] = c->at.segment + 1;
    k->t[i] = c->flies ? c->l.t : 0;
    k->to_x[i] = c->flies ? c->l.x : c->at.x;
    k->to_z[i] = c->flies ? c->l.z : c->at.z;
    k->along[i] = c->v.along;
    uint64_t j = c->flies ? c->l.segment + 1 : c->at.segment + 1;
    k->to[i] = j;
    k->x0[i] = ground->place.pairs[j][0];
    k->z0[i] = ground->place.pairs[j][1];
    k->x1[i] = ground->place.pairs[j + 1][0];
    k->z1[i] = ground->place.pairs[j + 1][1];
    k->m[i] = ground->slope.pairs[j][0];
    k->theta[i] = ground->slope.pairs[j][1];
}

/* The walker brought up to date, and the lane's course. */
static struct course course_of(struct wide *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    bool left = k->left & bit;
    size_t to = left ? (k->to[i] == 0 ? 0 : w->g->n - 1) : k->to[i] - 1;
    w->spin = k->spin[i];
    w->contacts = k->contacts[i];
    return (struct course){.at = {.x = k->x[i],
                                  .z = k->z[i],
                                  .vx = k->vx[i],
                                  .vz = k->vz[i],
                                  .segment = k->segment[i] - 1,
                                  .on_ground = true},
                           .flies = !(k->there & bit),
                           .v = {.along = k->along[i], .off = 0},
                           .l = {.t = k->t[i],
                                 .x = k->to_x[i],
                                 .z = k->to_z[i],
                                 .segment = to,
                                 .left = left}};
}

/* An empty lane goes through the motions where it is, and is never looked at. */
static void empty_lane(struct wide *k, size_t i)
{
    k->empty = true;
    k->live &= ~(1u << i);
    k->segment[i] = k->to[i] = 1;
    k->next_x[i] = k->stem_ahead[i] = INFINITY;
    k->stem_behind[i] = -INFINITY;
    k->contacts[i] = 0;
    k->pause[i] = INT64_MAX;
}

/* The next rock, at its first contact. */
static void refill(struct wide *k, size_t i)
{
    const struct wide_job *job = k->job;
    struct walker *w = &job->walkers[i];
    unsigned bit = 1u << i;
    k->left &= ~bit;
    k->rolls &= ~bit;
    k->there |= bit;
    while (job->next(job->context, i)) {
        enum ceduo_end end;
        size_t mark = w->next_mark;
        bool known = k->same_start;
        if (known || ceduo_walk_start(w, &k->start, &end)) {
            load_course(k, i, &k->start);
            k->radius[i] = w->rock.radius;
            k->k[i] = w->k;
            k->number[i] = w->number;
            k->fresh |= bit;
            k->same_start = known || (job->alike && w->next_mark == mark);
            return;
        }
        job->ended(job->context, i, end);
    }
    empty_lane(k, i);
}

/* ---- what happens seldom ---- */

/* A flight that comes to a stem, or a rock of many contacts. */
static __attribute__((noinline)) void come_down_alone(struct wide *k, size_t i)
{
    struct course c = course_of(k, i);
    unsigned bit = 1u << i;
    enum ceduo_end end;
    if (!ceduo_walk_come_down(&k->job->walkers[i], &c, &end)) {
        k->job->ended(k->job->context, i, end);
        refill(k, i);
        return;
    }
    load_course(k, i, &c);
    k->there |= bit;
}

/* A flight that leaves the slope. */
static __attribute__((noinline)) void leave_alone(struct wide *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    w->contacts = k->contacts[i];
    w->at.x = k->to_x[i];
    w->at.z = k->to_z[i];
    k->job->ended(k->job->context, i, CEDUO_LEFT_SLOPE);
    refill(k, i);
}

/* A flight that passes marks and goes on in its lane. */
static __attribute__((noinline)) void pass_marks_alone(struct wide *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    w->spin = k->spin[i];
    struct flight at = {.x = k->x[i], .z = k->z[i], .vx = k->vx[i], .vz = k->vz[i]};
    ceduo_walk_pass_marks(w, at, k->to_x[i], k->t[i]);
    k->next_x[i] = w->next_x;
    k->pause[i] = w->pause;
}

/* Behind a contact: a rock that rolls or flies straight up, or where the search for its landing is long. */
static __attribute__((noinline)) void go_off_alone(struct wide *k, size_t i, double off)
{
    struct walker *w = &k->job->walkers[i];
    struct course c = course_of(k, i);
    unsigned bit = 1u << i;
    uint64_t contacts = w->contacts;
    enum ceduo_end end;
    c.v.off = off;
    if (!ceduo_walk_go_off(w, &c, &end)) {
        k->job->ended(k->job->context, i, end);
        refill(k, i);
        return;
    }
    load_course(k, i, &c);
    if (w->contacts != contacts)
        load_draws(k, i);
    k->left &= ~bit;
    if (c.flies) {
        k->left |= c.l.left ? bit : 0;
    } else {
        k->there |= bit;
        k->rolls |= bit;
    }
}

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
#define FOUR(r1, r2, r3, r4)      \
    threefry_round(&p, &q, r1); \
    threefry_round(&p, &q, r2); \
    threefry_round(&p, &q, r3); \
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
LANE void draw_ahead(struct wide *k)
{
    ints contacts = load_ints(k->contacts), one = all_ints(1);
    flags odd = same(and_ints(contacts, one), one);
    reals u0, u1, first = load(k->draw[0]);
    draw_pair(k->seed, load_ints(k->number), shift_right(add_ints(contacts, one), 1), RANDOM_FACET, &u0, &u1);
    store(k->draw[0], pick(odd, first, u0));
    store(k->draw[1], pick(odd, u0, u1));
    store(k->draw[2], u1);
}

LANE reals next_draw(struct wide *k)
{
    reals u = load(k->draw[0]);
    store(k->draw[0], load(k->draw[1]));
    store(k->draw[1], load(k->draw[2]));
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

/* The facet that each rock strikes, as turn_facet() and strike_facet(). */
LANE void facet_lanes(const struct wide *k, reals u, reals largest, reals along, reals off, reals *sine, reals *cosine)
{
    reals zero = all(0);
    if (!k->against)
        u = sub(mul(all(2), u), all(1));
    reals angle = pick(less(zero, largest), mul(largest, u), zero);
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

LANE struct impact_lanes law_lanes(const struct wide *k, enum ceduo_law law, struct impact_lanes in, reals rn, reals rt)
{
    if (law == CEDUO_LAW_LUMPED)
        return lumped_lanes(in, rn, rt, k->scale_rn);
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
LANE unsigned disturbed(const struct wide *k, unsigned *pass, unsigned *leave)
{
    reals x = load(k->to_x);
    flags mark = both(at_least(x, load(k->next_x)), less(all(0), load(k->vx)));
    flags stem = either(at_least(x, load(k->stem_ahead)), at_least(load(k->stem_behind), x));
    unsigned flies = k->live & ~k->there;
    unsigned many = ~bits_of(more(load_ints(k->pause), load_ints(k->contacts)));
    unsigned alone = (bits_of(stem) & flies) | (many & k->live);
    *pass = bits_of(mark) & flies & ~alone;
    *leave = k->left & ~alone;
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
    struct velocities v = {.along = add(mul(r->vx, r->c), mul(r->vz, r->s)),
                           .off = sub(mul(r->vz, r->c), mul(r->vx, r->s))};
    if (k->rolls) {
        flags rolls = flags_of(k->rolls);
        v.along = pick(rolls, load(k->along), v.along);
        v.off = pick(rolls, all(0), v.off);
    }
    return v;
}

/* The ground that each rock strikes, where that varies from rock to rock. */
static __attribute__((noinline)) void ground_alone(struct wide *k)
{
    for (size_t i = 0; i < LANES; i++)
        if (k->live >> i & 1)
            ceduo_walk_ground(&k->job->walkers[i], k->to[i] - 1, &k->rn[i], &k->rt[i], &k->theta[i]);
}

LANE void strike_lanes(struct form form, struct wide *k, struct rocks *r, struct velocities *v)
{
    reals rn, rt, sine, cosine, zero = all(0);
    if (k->varies) {
        ground_alone(k);
        rn = load(k->rn);
        rt = load(k->rt);
    } else {
        look_up(&k->ground->share, r->segment, form.small, &rn, &rt);
    }
    facet_lanes(k, next_draw(k), load(k->theta), v->along, v->off, &sine, &cosine);
    reals inward = sub(mul(v->along, sine), mul(v->off, cosine));
    struct impact_lanes in = {.vn = pick(less(zero, inward), inward, zero),
                              .vt = add(mul(v->along, cosine), mul(v->off, sine)),
                              .spin = load(k->spin)};
    struct impact_lanes out = law_lanes(k, form.law, in, rn, rt);
    v->along = sub(mul(out.vt, cosine), mul(out.vn, sine));
    v->off = add(mul(out.vt, sine), mul(out.vn, cosine));
    v->off = pick(less(zero, v->off), v->off, zero);
    r->vx = sub(mul(v->along, r->c), mul(v->off, r->s));
    r->vz = add(mul(v->along, r->s), mul(v->off, r->c));
    store(k->spin, out.spin);
    store(k->vx, r->vx);
    store(k->vz, r->vz);
}

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
    struct landings l = {.inv = inv};
    l.far = k->live & ~bits_of(either(forth, less(r->vx, zero)));
    clear = both(clear, flags_of(k->live & ~l.far));
    /* the vertex that the flight comes to, if it is on the ground before that is the end of its segment */
    struct search s = {.step = pick_ints(forth, one, back), .going = clear, .inv = inv};
    s.p = add_ints(r->segment, pick_ints(forth, none, one));
    s.p = add_ints(s.p, pick_ints(clear, s.step, none));
    if (k->far) {
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
LANE unsigned rolling(const struct wide *k, const struct rocks *r, reals off, const struct landings *l, flags steep,
                      unsigned *unsure)
{
    reals radius = load(k->radius);
    flags near = but(less(size_of_each(sub(l->x, r->x)), radius), l->left);
    flags low = less(mul(off, off), mul(radius, mul(all(2 * k->g->gravity), r->c)));
    flags may = both(near, low), here = same(l->segment, r->segment), less_far, farther;
    is_within(r, steep, l->x, l->z, radius, &less_far, &farther);
    flags rolls = both(both(may, here), less_far);
    *unsure = bits_of(but(but(may, rolls), both(here, farther))) & k->live;
    return bits_of(rolls) & k->live;
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
LANE unsigned roll_lanes(struct form form, struct wide *k, struct rocks *r, reals along, flags steep,
                         unsigned rolls, struct landings *l)
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
    reals brake, none;
    look_up(&k->ground->brake, r->segment, form.small, &brake, &none);
    reals rate = mul(all(2 * k->g->gravity), sub(up, brake));
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

/* ---- all contacts ---- */

LANE void store_lanes(struct wide *k, const struct rocks *r, const struct landings *l)
{
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

LANE void step_lanes(struct form form, struct wide *k, bool even)
{
    unsigned pass, leave, alone = disturbed(k, &pass, &leave);
    for (; pass; pass &= pass - 1)
        pass_marks_alone(k, (size_t)__builtin_ctz(pass));
    for (; leave; leave &= leave - 1)
        leave_alone(k, (size_t)__builtin_ctz(leave));
    for (; alone; alone &= alone - 1)
        come_down_alone(k, (size_t)__builtin_ctz(alone));
    if (even)
        draw_ahead(k);
    else
        for (; k->fresh; k->fresh &= k->fresh - 1)
            load_draws(k, (size_t)__builtin_ctz(k->fresh));
    k->fresh = 0;
    struct rocks r = rocks_down(form, k);
    struct velocities v = velocities_on(k, &r);
    strike_lanes(form, k, &r, &v);
    store_ints(k->contacts, add_ints(load_ints(k->contacts), all_ints(1)));
    struct landings l = find_segments(form, k, &r);
    land_lanes(form, k, &r, &l);
    k->left = bits_of(l.left) & k->live;
    leave_lanes(k, &r, &l);
    flags steep = less(all(1), size_of_each(r.m));
    unsigned unsure, rolls = rolling(k, &r, v.off, &l, steep, &unsure) & ~l.far;
    alone = l.far | unsure | rolls;
    k->rolls = rolls ? roll_lanes(form, k, &r, v.along, steep, rolls, &l) : 0;
    k->there = k->rolls;
    alone &= ~k->rolls;
    store_lanes(k, &r, &l);
    if (!alone)
        return;
    _Alignas(64) double along[LANES], off[LANES];
    store(along, v.along);
    store(off, v.off);
    for (; alone; alone &= alone - 1) {
        size_t i = (size_t)__builtin_ctz(alone);
        k->along[i] = along[i];
        go_off_alone(k, i, off[i]);
    }
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
        k->job->ended(k->job->context, i, ceduo_walk_on(w, &c, k->job->law));
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
    if (job->law == CEDUO_LAW_LUMPED && small)
        walk_lanes((struct form){CEDUO_LAW_LUMPED, true, LOOK_UP_WRAPS}, &k);
    else if (job->law == CEDUO_LAW_LUMPED)
        walk_lanes((struct form){CEDUO_LAW_LUMPED, false, false}, &k);
    else if (small)
        walk_lanes((struct form){CEDUO_LAW_CRSP, true, LOOK_UP_WRAPS}, &k);
    else
        walk_lanes((struct form){CEDUO_LAW_CRSP, false, false}, &k);
}

#endif
