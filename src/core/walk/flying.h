/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The part of the walk above the ground: from one contact to the next, past marks and stems, and the contact itself.
 * walk.c alone includes this, after walk.h, so that the compiler sees the whole walk at once. */
#ifndef CEDUO_FLYING_H
#define CEDUO_FLYING_H

#include <gsl/gsl_interp.h>

#include "base/parallel.h"
#include "landing.h"
#include "strike.h"

#ifndef PAUSE
#define PAUSE 4000 /* contacts, or stems */
#endif
#define PAUSE_SEGMENTS 64 /* a contact may pass over all segments: of a longer profile the pauses are shorter */

/* ---- what is next ---- */

static inline void set_next_stems(struct walker *w)
{
    w->stem_ahead = w->stems->side[0].next;
    w->stem_behind = -w->stems->side[1].next;
}

/* Whether nobody waits for the rock any more. */
static bool is_cancelled(const struct walker *w)
{
    return ceduo_cancelled(w->cancel) || (w->watch && w->watch->enough && w->watch->enough(w->watch->context));
}

/* The contacts of the next pause: so near that the work up to there is done in a few milliseconds. */
static uint64_t next_pause(const struct walker *w)
{
    uint64_t pieces = w->g->n / PAUSE_SEGMENTS + 1, step = PAUSE / pieces + 1, next = w->contacts + step;
    return next < CEDUO_CONTACTS_MOST ? next : CEDUO_CONTACTS_MOST;
}

/* ---- flight ---- */

static inline void pass_mark(struct walker *w, double vx, double vz, double spin, double height)
{
    struct ceduo_crossing c = {
        .reached = true, .vx = vx, .vz = vz, .spin = spin, .height = height > 0 ? height : 0, .stems_hit = w->stems_hit};
    w->cross(w->context, w, w->next_mark++, &c);
}

/* A flight `at` when it comes to a place. */
static inline struct flight flight_to(const struct walker *w, const struct flight *at, double x, double t_end)
{
    double t = (x - at->x) / at->vx;
    t = t < t_end ? t : t_end;
    return (struct flight){.vx = at->vx, .vz = at->vz - w->g->gravity * t, .z = height_after(at->z, at->vz, w->g->half_g, t)};
}

void ceduo_walk_pass_marks(struct walker *w, struct flight at, double x, double t_end)
{
    for (; w->next_x <= x; set_next_x(w)) {
        struct flight f = flight_to(w, &at, w->next_x, t_end);
        pass_mark(w, f.vx, f.vz, w->spin, f.z - w->marks->at[w->next_mark].z);
    }
}

NOINLINE void show_flight(const struct walker *w, struct flight at, double x1, double z1, double vz1, double seconds)
{
    const struct ceduo_piece p = {false, at.x, at.z, at.vx, at.vz, x1, z1, at.vx, vz1, w->spin, seconds, w->contacts};
    w->watch->piece(w->watch->context, &p);
}

FORCE_INLINE void fly(struct walker *w, struct flight *at, const struct landing *l)
{
    double vz = at->vz - w->g->gravity * l->t;
    if (w->next_x <= l->x && at->vx > 0) /* untaken: rounding */
        ceduo_walk_pass_marks(w, *at, l->x, l->t);
    if (w->watch && w->watch->piece)
        show_flight(w, *at, l->x, l->z, vz, l->t);
    at->x = l->x;
    at->z = l->z;
    at->vz = vz;
    at->segment = l->segment;
    at->on_ground = true;
}

/* ---- stems ---- */

NOINLINE void show_stem(const struct walker *w, const struct stem *stem, double x, double clearance, double before,
                        double taken)
{
    const struct ceduo_stem_passed p = {
        x, stem->y, stem->dbh, stem->height, stem->shoot, stem->stool, clearance < stem->height, clearance, before, taken};
    w->watch->stem(w->watch->context, &p);
}

/* Takes the next stem of a side away; sets gives_up where the rock is not to be followed further. */
static inline void go_to_next_stem(struct walker *w, int side)
{
    ceduo_stems_take(w->stems, side);
    set_next_stems(w);
    w->cancelled |= w->stems->no_memory;
    if (w->stems->effort >= w->stems_pause) {
        w->stems_pause = w->stems->effort + PAUSE;
        w->cancelled |= is_cancelled(w);
    }
    w->gives_up = w->cancelled || ceduo_stems_too_many(w->stems);
}

/* The next stem along +x (side 0) or -x, which is taken away; false where there is none after all, or the trajectory
 * is given up. */
static bool take_stem(struct walker *w, int side, struct stem *stem)
{
    bool taken = w->stems->side[side].next_known;
    if (taken)
        *stem = *ceduo_stems_next(&w->stems->side[side]);
    go_to_next_stem(w, side);
    return taken && !w->gives_up;
}

static inline void count_hit(struct walker *w, const struct stem *stem)
{
    w->stems_hit++;
    w->stools_met += ceduo_stems_meet(w->stems, stem);
}

/* A stem is hit at x by a rock of kinetic energy `energy`: the share of its speed that is left, 0 where all is lost. */
static double hit_stem(struct walker *w, struct stem *stem, double x, double clearance, double energy)
{
    struct hit hit = {.energy = energy, .cost = stem->energy};
    count_hit(w, stem);
    double share = speed_kept(hit);
    if (w->watch && w->watch->stem)
        show_stem(w, stem, x, clearance, energy, energy_taken(hit));
    return share;
}

/* Flies past the stems between the rock and its landing `l`, which moves as stems are hit, and may not be known yet.
 * True where one stops the rock (or the trajectory is given up), at `at`. Behind a hit no landing is looked for while
 * the next stem stands over the same segment and the rock is still above the ground there: the parabola is concave, so
 * there was no contact before. */
static __attribute__((noinline)) bool fly_past_stems(struct walker *w, struct flight *at, struct landing *l, bool knows_landing)
{
    const struct ground *g = w->g;
    int side = at->vx > 0 ? 0 : 1;
    while (at->vx != 0) {
        double x = side == 0 ? w->stem_ahead : w->stem_behind;
        size_t j = at->segment;
        bool near = side == 0 ? x <= g->at[j + 1].x : x >= g->at[j].x;
        if (!knows_landing && !near) {
            *l = next_landing(g, at);
            knows_landing = true;
        }
        if (knows_landing && (side == 0 ? !(x <= l->x) : !(x >= l->x)))
            return false;
        double t = (x - at->x) / at->vx;
        t = t < 0 ? 0 : knows_landing && t > l->t ? l->t : t;
        struct landing here = {.t = t, .x = x, .z = height_after(at->z, at->vz, g->half_g, t)};
        here.segment =
            near ? j : gsl_interp_bsearch(g->x, x, j < l->segment ? j : l->segment, (j < l->segment ? l->segment : j) + 1);
        double clearance = here.z - ground_height(g, here.segment, x);
        if (!knows_landing && !(clearance >= 0)) {
            *l = next_landing(g, at);
            knows_landing = true;
            continue;
        }
        struct stem stem;
        if (!take_stem(w, side, &stem)) {
            if (w->gives_up) {
                fly(w, at, &here); /* past the marks before */
                return true;
            }
            continue;
        }
        clearance = clearance > 0 ? clearance : 0;
        if (!(clearance < stem.height)) {
            if (w->watch && w->watch->stem)
                show_stem(w, &stem, x, clearance, 0, 0);
            continue;
        }
        fly(w, at, &here);
        at->on_ground = false;
        double energy = flying_energy(w->rock.mass, w->rock.moment, at->vx, at->vz, w->spin);
        double share = hit_stem(w, &stem, x, clearance, energy);
        at->vx *= share;
        at->vz *= share;
        w->spin *= share;
        if (!(share > 0))
            return true;
        knows_landing = false;
    }
    if (!knows_landing) /* untaken: rounding */
        *l = next_landing(g, at);
    return false;
}

/* Whether a stem stands before x, or perhaps does. */
FORCE_INLINE bool stem_on_way(const struct walker *w, double x)
{
    return x >= w->stem_ahead || x <= w->stem_behind;
}

/* ---- contact ---- */

/* The draw of this contact, of two contacts at a time. */
FORCE_INLINE double contact_draw(const struct walker *w, struct contact_draws *draws, enum random_kind kind)
{
    uint64_t n = w->contacts;
    if (draws->of != n >> 1) {
        draws->of = n >> 1;
        draws->pair = random_pair(w->seed, w->number, n >> 1, kind);
    }
    return draws->pair.u[n & 1];
}

/* The section and how it is turned at this contact: by an angle in [-pi/2, pi/2), as half a turn changes nothing. */
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
    if (w->g->rough)
        return w->theta[w->g->rough[j]];
    const struct ceduo_segment *s = w->g->given[j];
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
        p.rn = ceduo_number_draw(w->g->given[j]->rn, w->rn_u, 0, 1);
    if (w->g->rt_varies)
        p.rt = ceduo_number_draw(w->g->given[j]->rt, w->rt_u, 0, 1);
    return p;
}

FORCE_INLINE struct velocity velocity_at(const struct walker *w, const struct flight *at)
{
    const struct ground_segment *s = &w->g->segments[at->segment];
    return velocity_on(s->c, s->s, at->vx, at->vz);
}

/* A facet: its turn from the segment, against a rock that goes along +x, or upwards with facets to both sides. */
struct facet {
    double angle, sine, cosine;
};

/* The facet of the next contact, if that is on segment j. Called before the flight to it as well, for the segment that
 * the flight leaves: mostly that is as rough as the next, and all is ready when the rock comes down. */
FORCE_INLINE void turn_facet(struct walker *w, size_t j, struct facet *f)
{
    double largest = largest_facet(w, j), angle = 0;
    if (largest > 0)
        angle = facet_angle(w->g->facets == CEDUO_AGAINST, largest, contact_draw(w, &w->facets, RANDOM_FACET));
    if (angle != f->angle) {
        f->angle = angle;
        elementary_sincos(&angle, &f->sine, &f->cosine);
    }
}

/* A contact. */
FORCE_INLINE void strike_ground(struct walker *w, struct flight *at, struct velocity *v, struct facet *facet,
                                const struct contact_law *law)
{
    const struct ground_segment *s = &w->g->segments[at->segment];
    turn_facet(w, at->segment, facet);
    double sine = facet->sine, cosine = facet->cosine;
    facet_struck(w->g->facets == CEDUO_AGAINST, *v, &sine, &cosine);
    struct ground_point point = ground_point(w, at->segment);
    if (law->sections)
        turn_section(w, &point);
    *v = strike(law, &point, sine, cosine, *v, &w->spin);
    at->vx = v->along * s->c - v->off * s->s;
    at->vz = v->along * s->s + v->off * s->c;
}

#endif
