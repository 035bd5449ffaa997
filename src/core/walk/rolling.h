/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk on the ground: rolling along segments and over vertices, past stems, and resting. Included only by walk.c. */
#ifndef CEDUO_ROLLING_H
#define CEDUO_ROLLING_H

#include "flying.h"

enum roll_outcome { ROLLED, LIFTED_OFF, STANDS, ROLLED_OUT, STOPPED };

/* ---- rolling ---- */

/* True if a free flight from a contact to `l` is so short and flat that the rock rolls: less than R along the ground, and less
 * than R above the segment of its start. */
FORCE_INLINE bool is_roll(const struct walker *w, const struct contact *contact, const struct flight *f,
                          const struct landing *l)
{
    double r = w->rock.radius;
    if (l->off_slope || !(contact->off * contact->off < r * (2 * w->g->gravity * w->g->segments[contact->segment].c)))
        return false;
    if (l->contact.segment != contact->segment && fabs(l->x - f->x) >= r)
        return false;
    return ground_between(w->g, contact->segment, contact->q, l->contact.segment, l->contact.q) < r;
}

/* A roll on segment w->at.segment: direction, squared speed, remaining metres. */
struct roll {
    int dir;
    double u2, remaining;
};

static inline void set_rolling_speed(struct walker *w, const struct roll *r)
{
    w->contact.along = r->dir * sqrt(r->u2);
    w->spin = w->k > 0 ? w->contact.along / w->rock.radius : 0;
}

/* Report the marks that a roll to x passes, over which u2 changes by `rate` per metre. */
NOINLINE void pass_in_roll(struct walker *w, const struct roll *r, double rate, double x)
{
    size_t j = w->contact.segment;
    const struct ground_segment *s = &w->g->segments[j];
    for (; w->next_x <= x; set_next_x(w)) {
        double u2 = r->u2 + rate * fabs(ground_along(w->g, j, w->next_x) - w->contact.q), u = u2 > 0 ? sqrt(u2) : 0;
        pass_mark(w, u * s->c, u * s->s, w->k > 0 ? u / w->rock.radius : 0, 0);
    }
}

NOINLINE void report_roll(struct walker *w, const struct roll *r, double u2_end, struct ground_vertex to)
{
    const struct ground_segment *s = &w->g->segments[w->contact.segment];
    const struct ground_vertex from = ground_place(w->g, w->contact.segment, w->contact.q);
    double u = r->dir * sqrt(r->u2), u1 = r->dir * sqrt(u2_end);
    const struct ceduo_trajectory_segment p = {true, from.x,     from.z,    u * s->c,  u * s->s,
                                               to.x, to.z,       u1 * s->c, u1 * s->s, w->k > 0 ? u / w->rock.radius : 0,
                                               0,    w->contacts};
    w->callbacks->segment(w->callbacks->context, &p);
}

/* Roll by ds along the segment to q, and report passed marks. */
static void roll_to(struct walker *w, struct roll *r, double ds, double u2_end, double q)
{
    const struct ground_vertex to = ground_place(w->g, w->contact.segment, q);
    if (r->dir > 0 && w->next_x <= to.x)
        pass_in_roll(w, r, ds > 0 ? (u2_end - r->u2) / ds : 0, to.x); /* untaken: rounding */
    if (ds > 0 && w->callbacks && w->callbacks->segment)
        report_roll(w, r, u2_end, to);
    r->u2 = u2_end;
    w->contact.q = q;
    set_rolling_speed(w, r);
}

enum stem_outcome { NO_STEM, PASSED_STEM, STOPPED_AT_STEM };

/* Roll to the next stem, if it stands before q, over which u2 changes by `rate` per metre. */
static __attribute__((noinline)) enum stem_outcome roll_to_stem(struct walker *w, struct roll *r, double q, double rate)
{
    size_t j = w->contact.segment;
    double x_end = ground_place(w->g, j, q).x;
    for (;;) {
        double x = r->dir > 0 ? w->stem_ahead : w->stem_behind;
        if (r->dir > 0 ? !(x <= x_end) : !(x >= x_end))
            return NO_STEM;
        struct stem stem;
        bool taken = consume_stem(w, r->dir > 0 ? 0 : 1, &stem);
        if (!taken && !w->aborted)
            continue;
        double to = ground_along(w->g, j, x), distance = fabs(to - w->contact.q), u2 = r->u2 + rate * distance;
        roll_to(w, r, distance, u2 > 0 ? u2 : 0, to); /* untaken: rounding */
        r->remaining -= distance;
        if (!taken)
            return STOPPED_AT_STEM;
        double share = hit_stem(w, &stem, x, 0, 0.5 * w->rock.mass * r->u2 * (1 + w->k));
        r->u2 *= share * share;
        set_rolling_speed(w, r);
        return share > 0 ? PASSED_STEM : STOPPED_AT_STEM;
    }
}

/* Pass the end of the segment: onto the next segment, off the profile, or into flight, which sets `l`. */
static enum roll_outcome roll_over_vertex(struct walker *w, struct roll *r, struct landing *l)
{
    const struct ground *g = w->g;
    size_t j = w->contact.segment;
    if (r->dir > 0 ? j + 1 == g->n : j == 0)
        return ROLLED_OUT;
    size_t next = r->dir > 0 ? j + 1 : j - 1;
    const struct ground_segment *a = &g->segments[j], *b = &g->segments[next];
    double turn = r->dir * (a->c * b->s - a->s * b->c); /* > 0: the ground turns up, a concave vertex */
    double cosine = a->c * b->c + a->s * b->s;
    if (turn > 0)
        r->u2 = cosine > 0 ? r->u2 * (cosine * cosine) : 0;
    w->contact.segment = next;
    w->contact.q = r->dir > 0 ? 0 : b->length;
    if (turn < 0) {
        double u = r->dir * sqrt(r->u2);
        const struct velocity v = velocity_on(b->c, b->s, u * a->c, u * a->s);
        const struct contact contact = {next, w->contact.q, v.along, v.off};
        const struct flight flight = begin_flight(g, &contact);
        *l = next_contact(g, &contact, &flight, g->top > 0);
        if (!is_roll(w, &contact, &flight, l)) {
            w->contact = contact;
            return LIFTED_OFF;
        }
    }
    return ROLLED;
}

/* Roll a length R along the ground from speed u; 0: downhill. */
NOINLINE enum roll_outcome roll_on(struct walker *w, double u, struct landing *l)
{
    const struct ground *g = w->g;
    int downhill = g->segments[w->contact.segment].s > 0 ? -1 : 1;
    struct roll r = {.dir = u > 0 ? 1 : u < 0 ? -1 : downhill, .u2 = u * u, .remaining = w->rock.radius};
    for (;;) {
        const struct ground_segment *s = &g->segments[w->contact.segment];
        double to_end = r.dir > 0 ? s->length - w->contact.q : w->contact.q, ds = to_end < r.remaining ? to_end : r.remaining;
        double rate = 2 * g->gravity * (-r.dir * s->s - s->friction * s->c) / (1 + w->k);
        double u2 = r.u2 + rate * ds;
        bool stands = ds > 0 && rate <= 0 && !(u2 > 0);
        if (stands) {
            double stop = rate < 0 ? -r.u2 / rate : 0;
            ds = stop < ds ? stop : ds;
            u2 = 0;
        }
        double q = ds == to_end ? (r.dir > 0 ? s->length : 0) : w->contact.q + r.dir * ds;
        if (w->stems && ds > 0) {
            enum stem_outcome outcome = roll_to_stem(w, &r, q, rate);
            if (outcome == STOPPED_AT_STEM)
                return STOPPED;
            if (outcome == PASSED_STEM && r.remaining > 0) /* untaken: rounding */
                continue;
            if (outcome == PASSED_STEM) /* untaken: rounding */
                return ROLLED;
        }
        roll_to(w, &r, ds, u2, q);
        if (stands)
            return STANDS;
        r.remaining -= ds;
        if (!(r.remaining > 0))
            return ROLLED;
        enum roll_outcome outcome = roll_over_vertex(w, &r, l);
        if (outcome != ROLLED)
            return outcome;
    }
}

/* ---- resting ---- */

/* True if the ground, from the start of segment j on towards dir, rises to height z before it falls. */
static bool rises_to(const struct ground *g, size_t j, int dir, double z)
{
    for (;;) {
        if (g->vertices[dir > 0 ? j + 1 : j].z >= z)
            return true;
        if (dir > 0 ? j + 1 == g->n : j == 0)
            return false;
        j = dir > 0 ? j + 1 : j - 1;
        if (dir * g->segments[j].s < 0)
            return false;
    }
}

/* Set *j to the next segment towards dir that is not level, and *level to the level metres before it. False at the end. */
static bool past_level(const struct ground *g, size_t *j, int dir, double *level)
{
    *level = 0;
    for (;;) {
        if (dir > 0 ? *j + 1 == g->n : *j == 0)
            return false;
        *j = dir > 0 ? *j + 1 : *j - 1;
        if (g->segments[*j].s != 0)
            return true;
        *level += g->segments[*j].length;
    }
}

FORCE_INLINE bool exceeds_friction(const struct ground *g, size_t j)
{
    return fabs(ground_slope(g, j)) > g->segments[j].friction;
}

/* True if the bottom of a pit lies less than R downhill. The bottom is a vertex, or a level stretch shorter than R, between two
 * sides steeper than their friction. The far side must rise to the height of the rock. */
static bool in_pit(const struct ground *g, const struct walker *w)
{
    size_t j = w->contact.segment;
    int dir = g->segments[j].s < 0 ? 1 : -1;
    double r = w->rock.radius, distance = dir > 0 ? g->segments[j].length - w->contact.q : w->contact.q;
    for (;; distance += g->segments[j].length) { /* segment j falls */
        size_t side = j;
        double level;
        if (!(distance < r) || !past_level(g, &j, dir, &level) || !(level < r))
            return false;
        if (dir * g->segments[j].s > 0)
            return exceeds_friction(g, side) && exceeds_friction(g, j) &&
                   rises_to(g, j, dir, ground_place(g, w->contact.segment, w->contact.q).z);
        if (level > 0) /* a terrace, no pit */
            return false;
    }
}

static bool rests(const struct walker *w)
{
    return !exceeds_friction(w->g, w->contact.segment) || in_pit(w->g, w);
}

#endif
