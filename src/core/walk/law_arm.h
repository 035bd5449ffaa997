/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rock that is not round, turned at random: its section is an ellipse of half-axes a, b. The ground strikes it at the end
 * of an arm from the centre, (r, -h) in the facet's axes, so that a blow also turns the rock. Rn is the restitution of the
 * work, Rt has no part in it. Lengths are in radii of gyration and spin in speeds at that radius, so that the inverse masses
 * at the point of contact are 1 + r2, r h and 1 + h2. Nothing here knows a scale of speed. */
#ifndef CEDUO_LAW_ARM_H
#define CEDUO_LAW_ARM_H

#include "impact.h"

/* What a blow changes: speed of the centre along the ground and off it, spin as a speed (its sign is the other one:
 * positive where the rock turns from the normal to -x). */
struct arm_state {
    real along, off, turn;
};

/* The impulses of a blow per mass. */
struct arm_impulse {
    real normal, along;
};

FORCE_INLINE real arm_within(real p, real lo, real hi)
{
    return blend(less(p, lo), lo, blend(less(hi, p), hi, p));
}

/* The arm to the point of contact: that of the ellipse, or straight down, where its end does not go into the ground. */
FORCE_INLINE void arm_of(const struct ground_point *at, const struct arm_state *in, real *r, real *h)
{
    real wide = at->section.wide, high = at->section.high, zero = splat(0);
    real h2 = wide * (at->sine * at->sine) + high * (at->cosine * at->cosine);
    *h = blend(less(zero, h2), vsqrt(h2), at->section.reach);
    *r = (wide - high) * (at->sine * at->cosine) / *h;
    mask meets = less(in->off + in->turn * *r, zero);
    *r = blend(meets, *r, zero);
    *h = blend(meets, *h, at->section.reach);
}

/* The normal speed of the point of contact, as the normal impulse grows: from `un` with slope `slipping` while the point
 * slips, up to impulse `stop`; then `un_stop`, and with slope `after`. */
struct arm_course {
    real un, slipping, stop, un_stop, after;
};

/* The impulse from `stop` to the end of a blow that does not end before. The work of the normal impulse up to where the point no
 * longer goes down comes back times e2 (Stronge 1990). */
FORCE_INLINE real arm_after_stop(const struct arm_course *c, real e)
{
    real zero = splat(0), stop2 = c->un_stop * c->un_stop, e2 = e * e;
    /* what went in is 2 (un + un_stop) stop, and un_stop2/after more; or all within the slip */
    real late = e2 * (stop2 - (c->un + c->un_stop) * c->stop * c->after);
    real early = stop2 + c->after / c->slipping * (e2 * (c->un * c->un) - stop2);
    real end2 = blend(less(zero, c->un_stop), early, late);
    return (vsqrt(blend(less(zero, end2), end2, zero)) - c->un_stop) / c->after;
}

/* Routh's phases: the point slips, against which friction acts, until it stops or the blow is over; then it sticks, if
 * friction can hold it, or slips the other way. */
FORCE_INLINE struct arm_impulse arm_strike(const struct ground_point *at, const struct arm_state *in, real r, real h)
{
    real zero = splat(0), mu = at->mu, ut = in->along + in->turn * h, forth = blend(less(ut, zero), splat(-1), splat(1));
    real nn = 1 + r * r, tt = 1 + h * h, nt = forth * (r * h);
    real slip = forth * ut, slows = mu * tt - nt, holds = arm_within(nt / tt, 0 - mu, mu);
    struct arm_course c = {.un = in->off + in->turn * r, .slipping = nn - mu * nt};
    c.stop = slip / slows;
    c.un_stop = c.un + c.slipping * c.stop;
    c.after = nn - holds * nt;
    real whole = (-1 - at->rn) * c.un / c.slipping;
    mask slips = and_not(less(zero, c.slipping), less(slip, whole * slows));
    real more = arm_after_stop(&c, at->rn);
    real normal = blend(slips, whole, c.stop + more);
    real along = blend(slips, mu * whole, mu * c.stop + holds * more);
    return (struct arm_impulse){normal, 0 - forth * along};
}

/* Rolling friction: a moment of at most friction R times the normal impulse, against the spin. */
FORCE_INLINE real arm_slow(const struct ground_point *at, real normal, real turn)
{
    real max = at->friction * at->section.reach * normal;
    return turn - arm_within(turn, 0 - max, max);
}

/* The centre still goes down: a second blow without bounce, straight below it. Here friction and moment are one question:
 * the impulses within their bounds that leave the least energy. */
FORCE_INLINE struct arm_state arm_stop(const struct ground_point *at, struct arm_state s)
{
    real h = at->section.reach, normal = 0 - s.off, hold = at->mu * normal;
    real max = at->friction * h * normal, slip = s.along + h * s.turn;
    real moment = arm_within(s.turn - h * s.along, 0 - max, max);
    real along = arm_within((h * moment - slip) / (1 + h * h), 0 - hold, hold);
    return (struct arm_state){.along = s.along + along, .off = splat(0), .turn = arm_slow(at, normal, s.turn + h * along)};
}

FORCE_INLINE struct impact arm_struck(struct impact in, const struct ground_point *at)
{
    real r, h, gyration = at->section.gyration;
    struct arm_state s = {.along = in.vt, .off = -1 * in.vn, .turn = -1 * (in.spin * gyration)};
    arm_of(at, &s, &r, &h);
    struct arm_impulse j = arm_strike(at, &s, r, h);
    s.along = s.along + j.along;
    s.off = s.off + j.normal;
    s.turn = arm_slow(at, j.normal, s.turn + (r * j.normal + h * j.along));
    mask down = less(s.off, splat(0));
    /* untaken 2: constant */
    if (REAL_LANES > 1 || any(down)) { /* among several lanes one is mostly */
        struct arm_state second = arm_stop(at, s);
        s.along = blend(down, second.along, s.along);
        s.turn = blend(down, second.turn, s.turn);
        s.off = blend(down, second.off, s.off);
    }
    return (struct impact){.vn = s.off, .vt = s.along, .spin = -1 * (s.turn / gyration)};
}

static const struct contact_law law_arm = {.struck = arm_struck, .spins = true, .sections = true};

#endif
