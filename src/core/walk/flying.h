/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of the walk above the ground: from one contact to the next, past marks and stems, and the contact itself. Included
 * only by walk.c, after walk.h, so that the compiler optimises the walk as a whole. */
#ifndef CEDUO_FLYING_H
#define CEDUO_FLYING_H

#include <gsl/gsl_interp.h>

#include "base/parallel.h"
#include "ceduo/simulate.h"
#include "landing.h"
#include "scene/rock.h"
#include "strike.h"

#ifndef PAUSE
#define PAUSE 4000 /* contacts, or stems */
#endif
#define PAUSE_SEGMENTS 64 /* a flight may pass all segments, so that longer profiles have shorter pauses */

/* ---- next stem and pause ---- */

static inline void set_next_stems(struct walker *w)
{
    w->stem_ahead = w->stems->side[0].next;
    w->stem_behind = -w->stems->side[1].next;
}

/* True if the caller has cancelled the trajectory. */
static bool is_cancelled(const struct walker *w)
{
    return ceduo_cancelled(w->cancel) ||
           (w->callbacks && w->callbacks->is_cancelled && w->callbacks->is_cancelled(w->callbacks->context));
}

/* Return the contact count at which limits are checked next, a few milliseconds of work ahead. */
static uint64_t next_pause(const struct walker *w)
{
    uint64_t pieces = w->g->n / PAUSE_SEGMENTS + 1, step = PAUSE / pieces + 1, next = w->contacts + step;
    return next < CEDUO_CONTACTS_MAX ? next : CEDUO_CONTACTS_MAX;
}

/* ---- flight ---- */

static inline void pass_mark(struct walker *w, double vx, double vz, double spin, double height)
{
    struct ceduo_crossing c = {
        .reached = true, .vx = vx, .vz = vz, .spin = spin, .height = height > 0 ? height : 0, .stems_hit = w->stems_hit};
    w->cross(w->context, w, w->next_mark++, &c);
}

/* Return the flight when it reaches x. */
static inline struct flight flight_to(const struct walker *w, const struct flight *flight, double x, double t_end)
{
    double t = (x - flight->x) / flight->vx;
    t = t < t_end ? t : t_end;
    return (struct flight){
        .vx = flight->vx, .vz = flight->vz - w->g->gravity * t, .z = height_at_time(flight->z, flight->vz, w->g->half_g, t)};
}

void ceduo_walk_pass_marks(struct walker *w, const struct flight *flight, double x, double t_end)
{
    for (; w->next_x <= x; set_next_x(w)) {
        struct flight f = flight_to(w, flight, w->next_x, t_end);
        pass_mark(w, f.vx, f.vz, w->spin, f.z - w->marks->items[w->next_mark].z);
    }
}

NOINLINE void report_flight(const struct walker *w, struct flight flight, double x1, double z1, double vz1, double seconds)
{
    const struct ceduo_trajectory_segment p = {false, flight.x,  flight.z, flight.vx, flight.vz, x1,
                                               z1,    flight.vx, vz1,      w->spin,   seconds,   w->contacts};
    w->callbacks->segment(w->callbacks->context, &p);
}

FORCE_INLINE void fly(struct walker *w, struct flight *flight, const struct landing *l)
{
    double vz = flight->vz - w->g->gravity * l->t;
    if (w->next_x <= l->x && flight->vx > 0) /* untaken: rounding */
        ceduo_walk_pass_marks(w, flight, l->x, l->t);
    if (w->callbacks && w->callbacks->segment)
        report_flight(w, *flight, l->x, l->z, vz, l->t);
    flight->x = l->x;
    flight->z = l->z;
    flight->vz = vz;
    flight->segment = l->contact.segment;
}

/* ---- stems ---- */

NOINLINE void report_stem(const struct walker *w, const struct stem *stem, double x, double clearance, double energy_before,
                          double known)
{
    const struct ceduo_stem_encounter p = {
        x,         stem->y,       stem->dbh, stem->height, stem->shoot, stem->stool, clearance < stem->height,
        clearance, energy_before, known};
    w->callbacks->stem(w->callbacks->context, &p);
}

/* Consume the next stem on a side. Sets aborted if the trajectory must be abandoned. */
static inline void advance_stem(struct walker *w, int side)
{
    ceduo_stems_consume(w->stems, side);
    set_next_stems(w);
    w->cancelled |= w->stems->no_memory;
    if (w->stems->effort >= w->stems_pause) {
        w->stems_pause = w->stems->effort + PAUSE;
        w->cancelled |= is_cancelled(w);
    }
    w->aborted = w->cancelled || ceduo_stems_too_many(w->stems);
}

/* Consume the next stem along +x (side 0) or -x. False if there is none, or if the trajectory is aborted. */
static bool consume_stem(struct walker *w, int side, struct stem *stem)
{
    bool known = w->stems->side[side].next_known;
    if (known)
        *stem = *ceduo_stems_next(&w->stems->side[side]);
    advance_stem(w, side);
    return known && !w->aborted;
}

static inline void count_hit(struct walker *w, const struct stem *stem)
{
    w->stems_hit++;
    w->stools_met += ceduo_stems_record_hit(w->stems, stem);
}

/* Record a hit of a stem at x by a rock of kinetic energy `energy`. Return the remaining share of its speed; 0: stopped. */
static double hit_stem(struct walker *w, struct stem *stem, double x, double clearance, double energy)
{
    struct hit hit = {.energy = energy, .cost = stem->energy};
    count_hit(w, stem);
    double share = speed_kept(hit);
    if (w->callbacks && w->callbacks->stem)
        report_stem(w, stem, x, clearance, energy, energy_taken(hit));
    return share;
}

/* Fly past the stems before the landing `l`, which moves at each hit and may be unknown. True if a stem stops the rock or the
 * trajectory is aborted, at `flight`. After a hit the landing is not computed if the next stem stands over the same segment and
 * the rock is above the ground there. The parabola is concave, so there was no contact before. */
static __attribute__((noinline)) bool fly_past_stems(struct walker *w, struct flight *flight, struct landing *l,
                                                     bool landing_known)
{
    const struct ground *g = w->g;
    int side = flight->vx > 0 ? 0 : 1;
    while (flight->vx != 0) {
        double x = side == 0 ? w->stem_ahead : w->stem_behind;
        size_t j = flight->segment;
        bool same_segment = side == 0 ? x <= g->vertices[j + 1].x : x >= g->vertices[j].x;
        if (!landing_known && !same_segment) {
            *l = next_landing(g, flight);
            landing_known = true;
        }
        if (landing_known && (side == 0 ? !(x <= l->x) : !(x >= l->x)))
            return false;
        double t = (x - flight->x) / flight->vx;
        t = t < 0 ? 0 : landing_known && t > l->t ? l->t : t; /* untaken: rounding */
        struct landing at_stem = {.t = t, .x = x, .z = height_at_time(flight->z, flight->vz, g->half_g, t)};
        size_t to = l->contact.segment;
        at_stem.contact.segment = same_segment ? j : gsl_interp_bsearch(g->x, x, j < to ? j : to, (j < to ? to : j) + 1);
        double clearance = at_stem.z - ground_height(g, at_stem.contact.segment, x);
        if (!landing_known && !(clearance >= 0)) {
            *l = next_landing(g, flight);
            landing_known = true;
            continue;
        }
        struct stem stem;
        if (!consume_stem(w, side, &stem)) {
            if (w->aborted) {
                fly(w, flight, &at_stem); /* report the marks before */
                return true;
            }
            continue;
        }
        clearance = clearance > 0 ? clearance : 0; /* untaken: rounding */
        if (!(clearance < stem.height)) {
            if (w->callbacks && w->callbacks->stem)
                report_stem(w, &stem, x, clearance, 0, 0);
            continue;
        }
        fly(w, flight, &at_stem);
        double energy = flying_energy(w->rock.mass, w->rock.moment, flight->vx, flight->vz, w->spin);
        double share = hit_stem(w, &stem, x, clearance, energy);
        flight->vx *= share;
        flight->vz *= share;
        w->spin *= share;
        if (!(share > 0))
            return true;
        landing_known = false;
    }
    if (!landing_known) /* untaken: rounding */
        *l = next_landing(g, flight);
    return false;
}

/* True if a stem may stand before x (conservative). */
FORCE_INLINE bool stem_before(const struct walker *w, double x)
{
    return x >= w->stem_ahead || x <= w->stem_behind;
}

/* ---- contact ---- */

/* Return the draw of this contact. One random pair serves two contacts. */
FORCE_INLINE double contact_draw(const struct walker *w, struct contact_draws *draws, enum random_kind kind)
{
    uint64_t n = w->contacts;
    if (draws->index != n >> 1) {
        draws->index = n >> 1;
        draws->pair = random_pair(w->seed, w->number, n >> 1, kind);
    }
    return draws->pair.u[n & 1];
}

/* Set the section, with its orientation at this contact: an angle in [-pi/2, pi/2), because half a turn has no effect. */
FORCE_INLINE void turn_section(struct walker *w, struct ground_point *to)
{
    double angle = (contact_draw(w, &w->turns, RANDOM_TURN) - 0.5) * HALF_TURN;
    elementary_sincos(&angle, &to->sine, &to->cosine);
    to->section.wide = w->section.wide;
    to->section.high = w->section.high;
    to->section.reach = w->section.reach;
    to->section.gyration = w->section.gyration;
}

FORCE_INLINE double largest_facet(const struct walker *w, size_t j)
{
    if (!w->g->theta_varies)
        return w->g->segments[j].theta;
    if (w->g->roughness_index)
        return w->theta[w->g->roughness_index[j]];
    const struct ceduo_segment *s = w->g->source[j];
    return roughness_angle((struct ground_roughness){s->roughness_m, s->roughness_rad}, w->rock.radius);
}

FORCE_INLINE struct ground_point ground_point(const struct walker *w, size_t j)
{
    const struct ground_segment *s = &w->g->segments[j];
    struct ground_point p = {.rn = s->rn,
                             .rt = s->rt,
                             .radius = w->rock.radius,
                             .k = w->k,
                             .scale_rn = w->scale_rn,
                             .bound = w->friction_bound,
                             .mu = s->mu,
                             .friction = s->friction};
    if (w->g->rn_varies)
        p.rn = ceduo_number_draw(w->g->source[j]->rn, w->rn_u, 0, 1);
    if (w->g->rt_varies)
        p.rt = ceduo_number_draw(w->g->source[j]->rt, w->rt_u, 0, 1);
    return p;
}

/* A facet: its angle to the segment, against a rock that moves along +x, or upward with facets to both sides. */
struct facet {
    double angle, sine, cosine;
};

/* Set the facet of the next contact, assumed on segment j. It is first called before the flight, for the segment that the
 * flight leaves: the next segment mostly has the same roughness, and then the facet is ready at landing. */
FORCE_INLINE void turn_facet(struct walker *w, size_t j, struct facet *f)
{
    double largest = largest_facet(w, j), angle = 0;
    if (largest > 0)
        angle = facet_angle(w->g->facets == CEDUO_FACETS_AGAINST, largest, contact_draw(w, &w->facets, RANDOM_FACET));
    if (angle != f->angle) {
        f->angle = angle;
        elementary_sincos(&angle, &f->sine, &f->cosine);
    }
}

FORCE_INLINE void strike_ground(struct walker *w, struct contact *contact, struct facet *facet, const struct contact_law *law)
{
    turn_facet(w, contact->segment, facet);
    double sine = facet->sine, cosine = facet->cosine;
    struct velocity v = {contact->along, contact->off};
    facet_struck(w->g->facets == CEDUO_FACETS_AGAINST, v, &sine, &cosine);
    struct ground_point point = ground_point(w, contact->segment);
    if (law->sections)
        turn_section(w, &point);
    v = strike(law, &point, sine, cosine, v, &w->spin);
    contact->along = v.along;
    contact->off = v.off;
}

#endif
