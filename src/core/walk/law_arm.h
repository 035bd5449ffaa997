/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rock that is not round, with random orientation: its section is an ellipse of half-axes a, b. The ground acts at the end of
 * an arm from the centre, (r, -h) in the facet's axes, so that an impact also turns the rock. Rn is the energetic restitution;
 * Rt is not used. Lengths are in radii of gyration, and spin is a speed at this radius, so that the inverse masses at the point
 * of contact are 1 + r2, r h and 1 + h2. The law has no scale of speed. */
#ifndef CEDUO_LAW_ARM_H
#define CEDUO_LAW_ARM_H

#include "impact.h"

/* State changed by an impact: speed of the centre along the ground and off it, and spin as a speed. `turn` has the opposite
 * sign of spin: positive if the rock turns from the normal to -x. */
struct arm_state {
    real along, off, turn;
};

/* Impulses of an impact per mass. */
struct arm_impulse {
    real normal, along;
};

FORCE_INLINE real arm_clamp(real p, real lo, real hi)
{
    return blend(less(p, lo), lo, blend(less(hi, p), hi, p));
}

/* Compute the arm to the point of contact: of the ellipse, or straight down if its end does not approach the ground. */
FORCE_INLINE void arm_compute(const struct ground_point *point, const struct arm_state *in, real *r, real *h)
{
    real wide = point->section.wide, high = point->section.high, zero = splat(0);
    real h2 = wide * (point->sine * point->sine) + high * (point->cosine * point->cosine);
    *h = blend(less(zero, h2), vsqrt(h2), point->section.reach);
    *r = (wide - high) * (point->sine * point->cosine) / *h;
    mask meets = less(in->off + in->turn * *r, zero);
    *r = blend(meets, *r, zero);
    *h = blend(meets, *h, point->section.reach);
}

/* Normal speed of the point of contact as a function of the normal impulse: from `un` with slope `slipping` while the point
 * slips, up to impulse `stop`; from there `un_stop` with slope `after`. */
struct arm_course {
    real un, slipping, stop, un_stop, after;
};

/* Return the impulse from `stop` to the end of an impact that does not end before. The work of the normal impulse during
 * compression is restored times e2 (Stronge 1990). */
FORCE_INLINE real arm_impulse_after_stop(const struct arm_course *c, real e)
{
    real zero = splat(0), stop2 = c->un_stop * c->un_stop, e2 = e * e;
    /* the work of compression is 2 (un + un_stop) stop + un_stop2/after, or lies entirely within the slip */
    real late = e2 * (stop2 - (c->un + c->un_stop) * c->stop * c->after);
    real early = stop2 + c->after / c->slipping * (e2 * (c->un * c->un) - stop2);
    real end2 = blend(less(zero, c->un_stop), early, late);
    return (vsqrt(blend(less(zero, end2), end2, zero)) - c->un_stop) / c->after;
}

/* Phases after Routh. The point slips against friction until it stops or the impact ends. Then it sticks if friction can hold
 * it, or slips in the opposite direction. */
FORCE_INLINE struct arm_impulse arm_strike(const struct ground_point *point, const struct arm_state *in, real r, real h)
{
    real zero = splat(0), mu = point->mu, ut = in->along + in->turn * h, forth = blend(less(ut, zero), splat(-1), splat(1));
    real nn = 1 + r * r, tt = 1 + h * h, nt = forth * (r * h);
    real slip = forth * ut, slows = mu * tt - nt, holds = arm_clamp(nt / tt, 0 - mu, mu);
    struct arm_course c = {.un = in->off + in->turn * r, .slipping = nn - mu * nt};
    c.stop = slip / slows;
    c.un_stop = c.un + c.slipping * c.stop;
    c.after = nn - holds * nt;
    real whole = (-1 - point->rn) * c.un / c.slipping;
    mask slips = and_not(less(zero, c.slipping), less(slip, whole * slows));
    real more = arm_impulse_after_stop(&c, point->rn);
    real normal = blend(slips, whole, c.stop + more);
    real along = blend(slips, mu * whole, mu * c.stop + holds * more);
    return (struct arm_impulse){normal, 0 - forth * along};
}

/* Rolling friction: a moment of at most friction R times the normal impulse, against the spin. */
FORCE_INLINE real arm_slow(const struct ground_point *point, real normal, real turn)
{
    real max = point->friction * point->section.reach * normal;
    return turn - arm_clamp(turn, 0 - max, max);
}

/* The centre still moves down: a second impact without restitution, straight below it. Friction and moment are the impulses
 * within their bounds that leave the least energy. */
FORCE_INLINE struct arm_state arm_stop(const struct ground_point *point, struct arm_state s)
{
    real h = point->section.reach, normal = 0 - s.off, hold = point->mu * normal;
    real max = point->friction * h * normal, slip = s.along + h * s.turn;
    real moment = arm_clamp(s.turn - h * s.along, 0 - max, max);
    real along = arm_clamp((h * moment - slip) / (1 + h * h), 0 - hold, hold);
    return (struct arm_state){.along = s.along + along, .off = splat(0), .turn = arm_slow(point, normal, s.turn + h * along)};
}

FORCE_INLINE struct impact arm_struck(struct impact in, const struct ground_point *point)
{
    real r, h, gyration = point->section.gyration;
    struct arm_state s = {.along = in.vt, .off = -1 * in.vn, .turn = -1 * (in.spin * gyration)};
    arm_compute(point, &s, &r, &h);
    struct arm_impulse j = arm_strike(point, &s, r, h);
    s.along = s.along + j.along;
    s.off = s.off + j.normal;
    s.turn = arm_slow(point, j.normal, s.turn + (r * j.normal + h * j.along));
    mask down = less(s.off, splat(0));
    /* untaken 2: constant */
    if (REAL_LANES > 1 || any(down)) { /* with several lanes mostly true */
        struct arm_state second = arm_stop(point, s);
        s.along = blend(down, second.along, s.along);
        s.turn = blend(down, second.turn, s.turn);
        s.off = blend(down, second.off, s.off);
    }
    return (struct impact){.vn = s.off, .vt = s.along, .spin = -1 * (s.turn / gyration)};
}

static const struct contact_law law_arm = {.struck = arm_struck, .spins = true, .sections = true};

#endif
