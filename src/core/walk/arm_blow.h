/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The blow of a rock that is not round, in one text for the walk of one rock and for lanes: it is written with the
 * operations of one_lane.h or lanes.h, one of which was included before.
 *
 * The rock's section is an ellipse of half-axes a, b, turned at random. The ground strikes it at the end of an arm from
 * the centre, (r, -h) in the facet's axes, so that a blow also turns the rock. Lengths are in radii of gyration and spin in
 * speeds at that radius, so that the inverse masses at the point of contact are 1 + r2, r h and 1 + h2. */
#ifndef CEDUO_ARM_BLOW_H
#define CEDUO_ARM_BLOW_H

/* The rock's section and how it is turned, and the ground. */
struct arm_blow {
    reals wide, high;   /* a2 and b2 over the square of the radius of gyration: together 5 */
    reals reach;        /* R over the radius of gyration */
    reals sine, cosine; /* of the turn */
    reals e, mu;        /* restitution of the work, 0…1; Coulomb's friction */
    reals friction;     /* of a rolling rock */
};

/* What a blow changes: speed of the centre along the ground and off it, spin as a speed (its sign is the other one:
 * positive where the rock turns from the normal to -x). */
struct arm_state {
    reals along, off, turn;
};

/* The impulses of a blow per mass. */
struct arm_impulse {
    reals normal, along;
};

LANE reals arm_within(reals p, reals lo, reals hi)
{
    return pick(less(p, lo), lo, pick(less(hi, p), hi, p));
}

/* The arm to the point of contact: that of the ellipse, or straight down, where its end does not go into the ground. */
LANE void arm_of(const struct arm_blow *b, const struct arm_state *in, reals *r, reals *h)
{
    reals h2 = add(mul(b->wide, mul(b->sine, b->sine)), mul(b->high, mul(b->cosine, b->cosine)));
    *h = pick(less(all(0), h2), root_of(h2), b->reach);
    *r = over(mul(sub(b->wide, b->high), mul(b->sine, b->cosine)), *h);
    flags meets = less(add(in->off, mul(in->turn, *r)), all(0));
    *r = pick(meets, *r, all(0));
    *h = pick(meets, *h, b->reach);
}

/* The normal speed of the point of contact, as the normal impulse grows: from `un` with slope `slipping` while the point
 * slips, up to impulse `stop`; then `un_stop`, and with slope `after`. */
struct arm_course {
    reals un, slipping, stop, un_stop, after;
};

/* The impulse from `stop` to the end of a blow that does not end before. The work of the normal impulse up to where the point no
 * longer goes down comes back times e2 (Stronge 1990). */
LANE reals arm_after_stop(const struct arm_course *c, reals e)
{
    reals zero = all(0), stop2 = mul(c->un_stop, c->un_stop), e2 = mul(e, e);
    /* what went in is 2 (un + un_stop) stop, and un_stop2/after more; or all within the slip */
    reals late = mul(e2, sub(stop2, mul(mul(add(c->un, c->un_stop), c->stop), c->after)));
    reals left = sub(mul(e2, mul(c->un, c->un)), stop2);
    reals early = add(stop2, mul(over(c->after, c->slipping), left));
    reals end2 = pick(less(zero, c->un_stop), early, late);
    reals end = root_of(pick(less(zero, end2), end2, zero));
    return over(sub(end, c->un_stop), c->after);
}

/* Routh's phases: the point slips, against which friction acts, until it stops or the blow is over; then it sticks, if
 * friction can hold it, or slips the other way. */
LANE struct arm_impulse arm_strike(const struct arm_blow *b, const struct arm_state *in, reals r, reals h)
{
    reals one = all(1), ut = add(in->along, mul(in->turn, h)), forth = pick(less(ut, all(0)), all(-1), one);
    reals nn = add(one, mul(r, r)), tt = add(one, mul(h, h)), nt = mul(forth, mul(r, h));
    reals slip = mul(forth, ut), slows = sub(mul(b->mu, tt), nt), against = sub(all(0), b->mu);
    reals holds = arm_within(over(nt, tt), against, b->mu);
    struct arm_course c = {.un = add(in->off, mul(in->turn, r)), .slipping = sub(nn, mul(b->mu, nt))};
    c.stop = over(slip, slows);
    c.un_stop = add(c.un, mul(c.slipping, c.stop));
    c.after = sub(nn, mul(holds, nt));
    reals whole = over(mul(sub(all(-1), b->e), c.un), c.slipping);
    flags slips = but(less(all(0), c.slipping), less(slip, mul(whole, slows)));
    reals more = arm_after_stop(&c, b->e);
    reals normal = pick(slips, whole, add(c.stop, more));
    reals along = pick(slips, mul(b->mu, whole), add(mul(b->mu, c.stop), mul(holds, more)));
    return (struct arm_impulse){normal, sub(all(0), mul(forth, along))};
}

/* Rolling friction: a moment of at most friction R times the normal impulse, against the spin. */
LANE reals arm_slow(const struct arm_blow *b, reals normal, reals turn)
{
    reals most = mul(mul(b->friction, b->reach), normal);
    return sub(turn, arm_within(turn, sub(all(0), most), most));
}

/* The centre still goes down: a second blow without bounce, straight below it. Here friction and moment are one question:
 * the impulses within their bounds that leave the least energy. */
LANE void arm_stop(const struct arm_blow *b, struct arm_state *s)
{
    reals zero = all(0), h = b->reach, normal = sub(zero, s->off), hold = mul(b->mu, normal);
    reals most = mul(mul(b->friction, h), normal), slip = add(s->along, mul(h, s->turn));
    reals moment = arm_within(sub(s->turn, mul(h, s->along)), sub(zero, most), most);
    reals along = over(sub(mul(h, moment), slip), add(all(1), mul(h, h)));
    along = arm_within(along, sub(zero, hold), hold);
    s->along = add(s->along, along);
    s->off = zero;
    s->turn = arm_slow(b, normal, add(s->turn, mul(h, along)));
}

/* One contact. */
LANE struct arm_state arm_struck(const struct arm_blow *b, struct arm_state s)
{
    reals r, h, zero = all(0);
    arm_of(b, &s, &r, &h);
    struct arm_impulse j = arm_strike(b, &s, r, h);
    s.along = add(s.along, j.along);
    s.off = add(s.off, j.normal);
    s.turn = add(s.turn, add(mul(r, j.normal), mul(h, j.along)));
    s.turn = arm_slow(b, j.normal, s.turn);
    flags down = less(s.off, zero);
    if (any(down)) {
        struct arm_state second = s;
        arm_stop(b, &second);
        s.along = pick(down, second.along, s.along);
        s.turn = pick(down, second.turn, s.turn);
        s.off = pick(down, second.off, s.off);
    }
    return s;
}

#endif
