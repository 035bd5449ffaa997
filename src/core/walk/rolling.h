/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk on the ground: rolling along segments and over vertices, past stems, and resting. Included only by walk.c. */
#ifndef CEDUO_ROLLING_H
#define CEDUO_ROLLING_H

#include <float.h>

#include "flying.h"

#ifndef STOP_ROUNDING
#define STOP_ROUNDING (4 * DBL_EPSILON) /* of the coordinates: minimum distance to a stop */
#endif

enum roll_outcome { ROLLED, LIFTED_OFF, STANDS, ROLLED_OUT, STOPPED };

/* ---- rolling ---- */

/* True if a free flight to `l` is so short and flat that the rock rolls: less than R along the ground, and less than R above
 * the segment of its start, which it leaves with speed `off`. */
FORCE_INLINE bool is_roll(const struct walker *w, const struct flight *f, double off, const struct landing *l)
{
    double r = w->rock.radius;
    if (l->off_slope || fabs(l->x - f->x) >= r)
        return false;
    if (!(off * off < r * (2 * w->g->gravity * w->g->segments[f->segment].c)))
        return false;
    return ceduo_ground_between(w->g, f->segment, f->x, f->z, l->segment, l->x, l->z) < r;
}

/* A roll on segment flight.segment: direction, squared speed, remaining metres. */
struct roll {
    int dir;
    double u2, remaining;
};

static inline void set_rolling_speed(struct walker *w, const struct roll *r)
{
    const struct ground_segment *s = &w->g->segments[w->flight.segment];
    double u = r->dir * sqrt(r->u2);
    w->along = u;
    w->flight.vx = u * s->c;
    w->flight.vz = u * s->s;
    w->spin = w->k > 0 ? u / w->rock.radius : 0;
}

/* Set the point of a roll after ds metres of its segment; `to_end`: exactly the end of the segment. */
static inline void roll_point(const struct walker *w, int dir, double ds, bool to_end, double *x, double *z)
{
    const struct ground *g = w->g;
    size_t j = w->flight.segment;
    const struct ground_segment *s = &g->segments[j];
    if (to_end) {
        *x = g->vertices[dir > 0 ? j + 1 : j].x;
        *z = g->vertices[dir > 0 ? j + 1 : j].z;
    } else {
        const struct chord chord = chord_at(g, j, s->m);
        *x = w->flight.x + dir * s->c * ds;
        *z = w->flight.z + dir * s->s * ds;
        snap_to_chord(&chord, is_steep(s->m), is_steep(s->m), false, x, z);
    }
}

/* Return the speed of a roll at (x, z); u2 changes by `rate` per metre. */
static inline double speed_at(const struct walker *w, const struct roll *r, double rate, double x, double z)
{
    double u2 = r->u2 + rate * ground_length(&w->g->segments[w->flight.segment], w->flight.x, w->flight.z, x, z);
    return u2 > 0 ? sqrt(u2) : 0;
}

/* Report the marks that a roll of ds metres to x passes. */
NOINLINE void pass_in_roll(struct walker *w, const struct roll *r, double ds, double u2_end, double x)
{
    const struct ground_segment *s = &w->g->segments[w->flight.segment];
    double rate = ds > 0 ? (u2_end - r->u2) / ds : 0; /* untaken: rounding */
    for (; w->next_x <= x; set_next_x(w)) {
        double u = speed_at(w, r, rate, w->next_x, w->marks->items[w->next_mark].z);
        pass_mark(w, u * s->c, u * s->s, w->k > 0 ? u / w->rock.radius : 0, 0);
    }
}

NOINLINE void report_roll(struct walker *w, const struct roll *r, double u2_end, double x1, double z1)
{
    const struct ground_segment *s = &w->g->segments[w->flight.segment];
    double u = r->dir * sqrt(r->u2), u1 = r->dir * sqrt(u2_end);
    const struct ceduo_trajectory_segment p = {true, w->flight.x, w->flight.z, u * s->c,  u * s->s,
                                               x1,   z1,          u1 * s->c,   u1 * s->s, w->k > 0 ? u / w->rock.radius : 0,
                                               0,    w->contacts};
    w->callbacks->segment(w->callbacks->context, &p);
}

/* Roll along the segment by ds to a point, and report passed marks. */
static void roll_to(struct walker *w, struct roll *r, double ds, double u2_end, double x, double z)
{
    if (r->dir > 0 && w->next_x <= x)
        pass_in_roll(w, r, ds, u2_end, x);
    if (w->callbacks && w->callbacks->segment)
        report_roll(w, r, u2_end, x, z);
    r->u2 = u2_end;
    w->flight.x = x;
    w->flight.z = z;
    set_rolling_speed(w, r);
}

/* As roll_to(), with a computed point; `to_end`: exactly the end of the segment. */
static void roll_piece(struct walker *w, struct roll *r, double ds, double u2_end, bool to_end)
{
    double x, z;
    roll_point(w, r->dir, ds, to_end, &x, &z);
    roll_to(w, r, ds, u2_end, x, z);
}

enum stem_outcome { NO_STEM, PASSED_STEM, STOPPED_AT_STEM };

/* Roll to the next stem, if it stands within the next ds metres, over which u2 changes by `rate` per metre. */
static __attribute__((noinline)) enum stem_outcome roll_to_stem(struct walker *w, struct roll *r, double ds, double rate)
{
    const struct ground *g = w->g;
    size_t j = w->flight.segment;
    double x_end, z_end;
    roll_point(w, r->dir, ds, false, &x_end, &z_end);
    for (;;) {
        double x = r->dir > 0 ? w->stem_ahead : w->stem_behind;
        if (r->dir > 0 ? !(x <= x_end) : !(x >= x_end))
            return NO_STEM;
        struct stem stem;
        bool taken = consume_stem(w, r->dir > 0 ? 0 : 1, &stem);
        if (!taken && !w->aborted)
            continue;
        double z = ground_height(g, j, x), distance = ground_length(&g->segments[j], w->flight.x, w->flight.z, x, z);
        double u2 = r->u2 + rate * distance;
        roll_to(w, r, distance, u2 > 0 ? u2 : 0, x, z); /* untaken: rounding */
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
    size_t j = w->flight.segment;
    if (r->dir > 0 ? j + 1 == g->n : j == 0)
        return ROLLED_OUT;
    size_t next = r->dir > 0 ? j + 1 : j - 1;
    const struct ground_segment *a = &g->segments[j], *b = &g->segments[next];
    double turn = r->dir * (a->c * b->s - a->s * b->c); /* > 0: the ground turns up, a concave vertex */
    if (turn > 0) {
        double cosine = a->c * b->c + a->s * b->s;
        r->u2 = cosine > 0 ? r->u2 * (cosine * cosine) : 0;
    }
    w->flight.segment = next;
    if (turn < 0) {
        double u = r->dir * sqrt(r->u2);
        struct flight flight = {
            .x = w->flight.x, .z = w->flight.z, .vx = u * a->c, .vz = u * a->s, .segment = next, .on_ground = true};
        *l = next_landing(g, &flight);
        if (!is_roll(w, &flight, flight.vz * b->c - flight.vx * b->s, l)) {
            w->flight = flight;
            return LIFTED_OFF;
        }
    }
    return ROLLED;
}

/* Roll a length R along the ground from speed u; 0: downhill. */
NOINLINE enum roll_outcome roll_on(struct walker *w, double u, struct landing *l)
{
    const struct ground *g = w->g;
    int downhill = g->segments[w->flight.segment].m > 0 ? -1 : 1;
    struct roll r = {.dir = u > 0 ? 1 : u < 0 ? -1 : downhill, .u2 = u * u, .remaining = w->rock.radius};
    for (;;) {
        size_t j = w->flight.segment, v = r.dir > 0 ? j + 1 : j;
        const struct ground_segment *s = &g->segments[j];
        double to_end = ground_length(s, w->flight.x, w->flight.z, g->vertices[v].x, g->vertices[v].z);
        double ds = to_end < r.remaining ? to_end : r.remaining;
        double rate = 2 * g->gravity * (-r.dir * s->s - s->friction * s->c) / (1 + w->k);
        double u2 = r.u2 + rate * ds;
        bool stands = ds > 0 && rate <= 0 && !(u2 > 0);
        if (stands) {
            double stop = rate < 0 ? -r.u2 / rate : 0;
            if (stop <= STOP_ROUNDING * (fabs(w->flight.x) + fabs(w->flight.z)))
                stop = 0; /* stop here, because rounding must not lift the rock */
            ds = stop < ds ? stop : ds;
        }
        if (w->stems && ds > 0) {
            enum stem_outcome outcome = roll_to_stem(w, &r, ds, rate);
            if (outcome == STOPPED_AT_STEM)
                return STOPPED;
            if (outcome == PASSED_STEM && r.remaining > 0) /* untaken: rounding */
                continue;
            if (outcome == PASSED_STEM) /* untaken: rounding */
                return ROLLED;
        }
        if (stands) {
            roll_piece(w, &r, ds, 0, false);
            return STANDS;
        }
        roll_piece(w, &r, ds, u2, ds == to_end);
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
        if (dir * g->segments[j].m < 0)
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
        if (g->segments[*j].m != 0)
            return true;
        *level += g->distance[*j + 1] - g->distance[*j];
    }
}

/* True if the bottom of a pit lies less than R downhill. The bottom is a vertex, or a level stretch shorter than R, between two
 * sides steeper than their friction. The far side must rise to the height of the rock. */
static bool in_pit(const struct ground *g, const struct walker *w)
{
    size_t j = w->flight.segment;
    int dir = g->segments[j].m < 0 ? 1 : -1;
    double r = w->rock.radius, x = w->flight.x, z = w->flight.z, distance = 0;
    for (;;) { /* segment j falls */
        const struct ground_segment *side = &g->segments[j];
        size_t v = dir > 0 ? j + 1 : j;
        double level;
        distance += ground_length(side, x, z, g->vertices[v].x, g->vertices[v].z);
        if (!(distance < r) || !past_level(g, &j, dir, &level) || !(level < r))
            return false;
        const struct ground_segment *next = &g->segments[j];
        if (dir * next->m > 0)
            return fabs(side->m) > side->friction && fabs(next->m) > next->friction && rises_to(g, j, dir, w->flight.z);
        if (level > 0) /* a terrace, no pit */
            return false;
        x = g->vertices[v].x;
        z = g->vertices[v].z;
    }
}

static bool rests(const struct walker *w)
{
    const struct ground_segment *s = &w->g->segments[w->flight.segment];
    return !(fabs(s->m) > s->friction) || in_pit(w->g, w);
}

#endif
