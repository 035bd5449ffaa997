/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "walk.h"

#include <float.h>

#include "law_crsp.h"
#include "law_lumped.h"

#ifndef PAUSE
#define PAUSE 4000 /* contacts, or stems */
#endif
#define PAUSE_SEGMENTS 64 /* a contact may pass over all segments: of a longer profile the pauses are shorter */
#ifndef ROUNDING
#define ROUNDING 1e-9 /* what is nearer to a limit is looked at more closely; only speed depends on it */
#endif
#ifndef STOP_ROUNDING
#define STOP_ROUNDING (4 * DBL_EPSILON) /* of the coordinates: a rock stops no nearer than this */
#endif
enum after_roll { ROLLED, TOOK_OFF, STANDS, ROLLED_OUT, STOPPED };

/* ---- release ---- */

static inline void set_next_x(struct walker *w)
{
    w->next_x = w->next_mark < w->marks->n ? w->marks->x[w->next_mark] : INFINITY;
}

static inline void end_at_last_mark(struct walker *w)
{
    if (w->arrivals_only && w->next_mark == w->marks->n)
        w->pause = 0;
}

static inline void set_next_stems(struct walker *w)
{
    w->stem_ahead = w->stems->side[0].next;
    w->stem_behind = -w->stems->side[1].next;
}

/* Whether nobody waits for the rock any more. */
static bool is_cancelled(const struct walker *w)
{
    return (w->cancel && atomic_load_explicit(w->cancel, memory_order_relaxed)) ||
           (w->watch && w->watch->enough && w->watch->enough(w->watch->context));
}

/* The contacts of the next pause: so near that the work up to there is done in a few milliseconds. */
static uint64_t next_pause(const struct walker *w)
{
    uint64_t pieces = w->g->n / PAUSE_SEGMENTS + 1, step = PAUSE / pieces + 1, next = w->contacts + step;
    return next < CEDUO_CONTACTS_MOST ? next : CEDUO_CONTACTS_MOST;
}

static enum ceduo_status draw_rock(struct walker *w, const struct ceduo_scene *scene, const struct ceduo_rock *mean)
{
    w->rock = *mean;
    if (!ceduo_rock_varies(&scene->rock))
        return CEDUO_OK;
    double u[8];
    for (uint64_t i = 0; i < 8; i++)
        u[i] = random_open(w->seed, w->number, i, RANDOM_ROCK);
    return ceduo_rock_draw(&scene->rock, u, &w->rock);
}

static double draw_release(const struct walker *w, struct ceduo_number n, uint64_t event)
{
    if (!(n.spread > 0))
        return n.mean;
    return ceduo_number_draw(n, random_open(w->seed, w->number, event, RANDOM_RELEASE), -INFINITY, INFINITY);
}

enum ceduo_status ceduo_walk_release(struct walker *w, const struct ceduo_scene *scene, const struct ground *g,
                                     const struct marks *marks, const struct ceduo_rock *mean, uint64_t number)
{
    w->g = g;
    w->marks = marks;
    w->seed = scene->simulation.seed;
    w->number = number;
    w->scale_rn = scene->simulation.scale_rn;
    enum ceduo_status status = draw_rock(w, scene, mean);
    if (status != CEDUO_OK)
        return status;
    w->rn_u = g->rn_varies ? random_open(w->seed, number, 0, RANDOM_GROUND) : 0;
    w->rt_u = g->rt_varies ? random_open(w->seed, number, 1, RANDOM_GROUND) : 0;
    double x = draw_release(w, scene->release.x, 0), height = draw_release(w, scene->release.height, 1);
    bool spins = scene->simulation.law != CEDUO_LAW_LUMPED;
    w->k = spins ? w->rock.k : 0;
    w->spin = spins ? draw_release(w, scene->release.spin, 4) : 0;
    size_t segment = ceduo_ground_segment(g, x);
    w->at = (struct flight){.x = x,
                            .z = ground_height(g, segment, x) + height,
                            .vx = draw_release(w, scene->release.vx, 2),
                            .vz = draw_release(w, scene->release.vz, 3),
                            .segment = segment,
                            .on_ground = !(height > 0)};
    w->contacts = 0;
    w->pause = next_pause(w);
    w->stems_pause = PAUSE;
    w->cancelled = w->gives_up = false;
    w->facets_of = UINT64_MAX;
    w->next_mark = 0;
    while (w->next_mark < marks->n && marks->x[w->next_mark] <= x)
        w->next_mark++;
    set_next_x(w);
    end_at_last_mark(w);
    w->stems_hit = w->stools_met = 0;
    w->stem_ahead = INFINITY;
    w->stem_behind = -INFINITY;
    if (w->stems) {
        ceduo_stems_begin(w->stems, w->seed, number, w->rock.mean_diameter, x);
        set_next_stems(w);
    }
    return CEDUO_OK;
}

bool ceduo_walk_alike(const struct ceduo_scene *scene, const struct ground *g)
{
    const struct ceduo_release *r = &scene->release;
    return !ceduo_rock_varies(&scene->rock) && !g->rn_varies && !g->rt_varies && !(r->x.spread > 0) &&
           !(r->height.spread > 0) && !(r->vx.spread > 0) && !(r->vz.spread > 0) && !(r->spin.spread > 0);
}

void ceduo_walk_release_again(struct walker *w, const struct walker *first, uint64_t number)
{
    w->number = number;
    w->spin = first->spin;
    w->at = first->at;
    w->contacts = 0;
    w->pause = first->pause;
    w->cancelled = false;
    w->facets_of = UINT64_MAX;
    w->next_mark = first->next_mark;
    w->next_x = first->next_x;
}

/* ---- flight ---- */

static inline void pass_mark(struct walker *w, double vx, double vz, double spin, double height)
{
    struct ceduo_crossing c = {.reached = true, .vx = vx, .vz = vz, .spin = spin, .height = height > 0 ? height : 0,
                               .stems_hit = w->stems_hit};
    w->cross(w->context, w, w->next_mark++, &c);
    set_next_x(w);
    end_at_last_mark(w);
}

/* The marks that the flight from `at` to `l` passes. */
SELDOM void pass_in_flight(struct walker *w, struct flight at, double x, double t_end)
{
    while (w->next_x <= x) {
        double t = (w->next_x - at.x) / at.vx;
        t = t < t_end ? t : t_end;
        double z = at.z + (at.vz - w->g->half_g * t) * t;
        pass_mark(w, at.vx, at.vz - w->g->gravity * t, w->spin, z - w->marks->z[w->next_mark]);
    }
}

SELDOM void show_flight(const struct walker *w, struct flight at, double x1, double z1, double vz1, double seconds)
{
    struct ceduo_piece p = {.rolls = false,
                            .x = at.x,
                            .z = at.z,
                            .vx = at.vx,
                            .vz = at.vz,
                            .x1 = x1,
                            .z1 = z1,
                            .vx1 = at.vx,
                            .vz1 = vz1,
                            .spin = w->spin,
                            .seconds = seconds,
                            .contacts = w->contacts};
    w->watch->piece(w->watch->context, &p);
}

HOT void fly(struct walker *w, struct flight *at, const struct landing *l)
{
    double vz = at->vz - w->g->gravity * l->t;
    if (w->next_x <= l->x && at->vx > 0)
        pass_in_flight(w, *at, l->x, l->t);
    if (w->watch && w->watch->piece)
        show_flight(w, *at, l->x, l->z, vz, l->t);
    at->x = l->x;
    at->z = l->z;
    at->vz = vz;
    at->segment = l->segment;
    at->on_ground = true;
}

/* ---- stems ---- */

SELDOM void show_stem(const struct walker *w, const struct stem *stem, double x, double clearance, double before,
                      double taken)
{
    struct ceduo_stem_passed p = {.x = x,
                                  .y = stem->y,
                                  .dbh = stem->dbh,
                                  .height = stem->kind->height,
                                  .shoot = stem->shoot,
                                  .stool = stem->stool,
                                  .hit = clearance < stem->kind->height,
                                  .clearance = clearance,
                                  .before = before,
                                  .taken = taken};
    w->watch->stem(w->watch->context, &p);
}

/* The next stem along +x (side 0) or -x, which is taken away; false where there is none after all, or the way is given
 * up. */
static bool take_stem(struct walker *w, int side, struct stem *stem)
{
    bool taken = ceduo_stems_take(w->stems, side, stem);
    set_next_stems(w);
    w->cancelled |= w->stems->no_memory;
    if (w->stems->effort >= w->stems_pause) {
        w->stems_pause = w->stems->effort + PAUSE;
        w->cancelled |= is_cancelled(w);
    }
    w->gives_up = w->cancelled || ceduo_stems_too_many(w->stems);
    return taken && !w->gives_up;
}

/* A stem is hit at x by a rock of kinetic energy `energy`: the share of its speed that is left, 0 where all is lost. */
static double hit_stem(struct walker *w, const struct stem *stem, double x, double clearance, double energy)
{
    double cost = ceduo_stem_energy(stem, w->rock.mean_diameter);
    w->stems_hit++;
    w->stools_met += ceduo_stems_meet(w->stems, stem);
    bool stops = !(cost < energy);
    if (w->watch && w->watch->stem)
        show_stem(w, stem, x, clearance, energy, stops ? energy : cost);
    return stops ? 0 : sqrt(1 - cost / energy);
}

/* The segment under x, which lies between segments a and b. */
static size_t segment_between(const struct ground *g, size_t a, size_t b, double x)
{
    size_t lo = a < b ? a : b, hi = (a < b ? b : a) + 1;
    while (hi - lo > 1) {
        size_t mid = lo + (hi - lo) / 2;
        if (g->x[mid] <= x)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

/* Flies past the stems between the rock and its landing `l`, which moves as stems are hit. True where one stops the rock
 * (or the way is given up), at `at`. Behind a hit no landing is looked for while the next stem stands over the same
 * segment and the rock is still above the ground there: the parabola is concave, so there was no contact before. */
static __attribute__((noinline)) bool fly_past_stems(struct walker *w, struct flight *at, struct landing *l)
{
    const struct ground *g = w->g;
    int side = at->vx > 0 ? 0 : 1;
    bool knows_landing = true;
    while (at->vx != 0) {
        double x = side == 0 ? w->stem_ahead : w->stem_behind;
        size_t j = at->segment;
        bool near = side == 0 ? x <= g->x[j + 1] : x >= g->x[j];
        if (!knows_landing && !near) {
            *l = next_landing(g, at);
            knows_landing = true;
        }
        if (knows_landing && (side == 0 ? !(x <= l->x) : !(x >= l->x)))
            return false;
        double t = (x - at->x) / at->vx;
        t = t < 0 ? 0 : knows_landing && t > l->t ? l->t : t;
        struct landing here = {.t = t, .x = x, .z = at->z + (at->vz - g->half_g * t) * t};
        here.segment = near ? j : segment_between(g, j, l->segment, x);
        double clearance = here.z - ground_height(g, here.segment, x);
        if (!knows_landing && !(clearance >= 0)) {
            *l = next_landing(g, at);
            knows_landing = true;
            continue;
        }
        struct stem stem;
        if (!take_stem(w, side, &stem)) {
            if (w->gives_up)
                return true;
            continue;
        }
        clearance = clearance > 0 ? clearance : 0;
        if (!(clearance < stem.kind->height)) {
            if (w->watch && w->watch->stem)
                show_stem(w, &stem, x, clearance, 0, 0);
            continue;
        }
        fly(w, at, &here);
        at->on_ground = false;
        double energy = 0.5 * w->rock.mass * (at->vx * at->vx + at->vz * at->vz) +
                        0.5 * w->rock.moment * (w->spin * w->spin);
        double share = hit_stem(w, &stem, x, clearance, energy);
        at->vx *= share;
        at->vz *= share;
        w->spin *= share;
        if (!(share > 0))
            return true;
        knows_landing = false;
    }
    if (!knows_landing)
        *l = next_landing(g, at);
    return false;
}

/* Whether a stem lies on the way to x, or perhaps does. */
HOT bool stem_on_way(const struct walker *w, double x)
{
    return x >= w->stem_ahead || x <= w->stem_behind;
}

/* ---- contact ---- */

HOT double facet_draw(struct walker *w)
{
    uint64_t n = w->contacts;
    if (w->facets_of != n >> 1) {
        w->facets_of = n >> 1;
        w->facets = random_pair(w->seed, w->number, n >> 1, RANDOM_FACET);
    }
    return w->facets.u[n & 1];
}

HOT double largest_facet(const struct walker *w, size_t j)
{
    if (!w->g->theta_varies)
        return w->g->segments[j].theta;
    const struct ceduo_segment *s = w->g->given[j];
    return s->roughness_m > 0 ? atan(s->roughness_m / w->rock.radius) : w->g->segments[j].theta;
}

HOT struct ground_point ground_point(const struct walker *w, size_t j)
{
    const struct ground_segment *s = &w->g->segments[j];
    struct ground_point p = {
        .rn = s->rn, .rt = s->rt, .radius = w->rock.radius, .k = w->k, .scale_rn = w->scale_rn};
    if (w->g->rn_varies)
        p.rn = ceduo_number_draw(w->g->given[j]->rn, w->rn_u, 0, 1);
    if (w->g->rt_varies)
        p.rt = ceduo_number_draw(w->g->given[j]->rt, w->rt_u, 0, 1);
    return p;
}

HOT struct velocity velocity_on(const struct ground_segment *s, const struct flight *at)
{
    return (struct velocity){.along = at->vx * s->c + at->vz * s->s, .off = at->vz * s->c - at->vx * s->s};
}

/* A facet: its turn from the segment, against a rock that goes along +x, or upwards with facets to both sides. */
struct facet {
    double angle, sine, cosine;
};

/* The facet of the next contact, if that is on segment j. Called before the flight to it as well, for the segment that
 * the flight leaves: mostly that is as rough as the next, and all is ready when the rock comes down. */
HOT void turn_facet(struct walker *w, size_t j, struct facet *f)
{
    double largest = largest_facet(w, j), angle = 0;
    if (largest > 0) {
        double u = facet_draw(w);
        angle = largest * (w->g->facets == CEDUO_BOTH ? 2 * u - 1 : u);
    }
    if (angle != f->angle) {
        f->angle = angle;
        sincos_quarter(angle, &f->sine, &f->cosine);
    }
}

/* The facet that the rock strikes, as sine and cosine of its turn from the segment. */
HOT void strike_facet(struct walker *w, size_t j, struct velocity v, struct facet *f, double *sine, double *cosine)
{
    turn_facet(w, j, f);
    *cosine = f->cosine;
    *sine = w->g->facets == CEDUO_AGAINST && !(v.along >= 0) ? -f->sine : f->sine;
    if (v.off * *cosine - v.along * *sine > 0) { /* the rock is leaving this facet */
        *sine = 0;
        *cosine = 1;
    }
}

/* A contact, in the segment's axes: what a rock that rolls brings has no part off the ground, exactly. */
HOT void strike(struct walker *w, struct flight *at, struct velocity *v, struct facet *facet, enum ceduo_law law)
{
    const struct ground_segment *s = &w->g->segments[at->segment];
    double sine, cosine;
    strike_facet(w, at->segment, *v, facet, &sine, &cosine);
    struct ground_point point = ground_point(w, at->segment);
    double inward = v->along * sine - v->off * cosine;
    struct impact in = {
        .vn = inward > 0 ? inward : 0, .vt = v->along * cosine + v->off * sine, .spin = w->spin};
    struct impact out;
    switch (law) {
#define X(NAME, name)            \
    case CEDUO_LAW_##NAME:       \
        out = law_##name(in, &point); \
        break;
        CEDUO_LAWS(X)
#undef X
    default:
        return;
    }
    v->along = out.vt * cosine - out.vn * sine;
    v->off = out.vt * sine + out.vn * cosine;
    if (!(v->off > 0)) /* into the segment: that part is lost */
        v->off = 0;
    at->vx = v->along * s->c - v->off * s->s;
    at->vz = v->along * s->s + v->off * s->c;
    w->spin = out.spin;
}

/* ---- rolling ---- */

/* Whether a free flight that ends at `l` is so short and flat that the rock rolls: less than R along the ground, and
 * less than R above the segment it starts from, which it leaves with speed `off`. */
HOT bool is_roll(const struct walker *w, const struct flight *f, double off, const struct landing *l)
{
    double r = w->rock.radius;
    if (l->left || fabs(l->x - f->x) >= r)
        return false;
    if (!(off * off < r * (2 * w->g->gravity * w->g->segments[f->segment].c)))
        return false;
    return ceduo_ground_between(w->g, f->segment, f->x, f->z, l->segment, l->x, l->z) < r;
}

/* A roll under way on segment `at.segment`: direction, square of the speed, metres to go. */
struct roll {
    int dir;
    double u2, left;
};

static inline void set_rolling_speed(struct walker *w, const struct roll *r)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    double u = r->dir * sqrt(r->u2);
    w->along = u;
    w->at.vx = u * s->c;
    w->at.vz = u * s->s;
    w->spin = w->k > 0 ? u / w->rock.radius : 0;
}

/* Where the roll is after ds metres of its segment; exactly at its end where `to_end`. */
static inline void roll_point(const struct walker *w, int dir, double ds, bool to_end, double *x, double *z)
{
    const struct ground *g = w->g;
    size_t j = w->at.segment;
    const struct ground_segment *s = &g->segments[j];
    if (to_end) {
        *x = g->x[dir > 0 ? j + 1 : j];
        *z = g->z[dir > 0 ? j + 1 : j];
    } else if (s->steep) {
        *z = clamp(w->at.z + dir * s->s * ds, g->z[j], g->z[j + 1]);
        *x = clamp(g->x[j] + (*z - g->z[j]) / s->m, g->x[j], g->x[j + 1]);
    } else {
        *x = clamp(w->at.x + dir * s->c * ds, g->x[j], g->x[j + 1]);
        *z = ground_height(g, j, *x);
    }
}

/* The marks that a roll of ds metres to x passes. */
SELDOM void pass_in_roll(struct walker *w, const struct roll *r, double ds, double u2_end, double x)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    double rate = ds > 0 ? (u2_end - r->u2) / ds : 0;
    while (w->next_x <= x) {
        double z = w->marks->z[w->next_mark];
        double u2 = r->u2 + rate * ground_length(s, w->at.x, w->at.z, w->next_x, z);
        double u = u2 > 0 ? sqrt(u2) : 0;
        pass_mark(w, u * s->c, u * s->s, w->k > 0 ? u / w->rock.radius : 0, 0);
    }
}

SELDOM void show_roll(struct walker *w, const struct roll *r, double u2_end, double x1, double z1)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    double u = r->dir * sqrt(r->u2), u1 = r->dir * sqrt(u2_end);
    struct ceduo_piece p = {.rolls = true,
                            .x = w->at.x,
                            .z = w->at.z,
                            .vx = u * s->c,
                            .vz = u * s->s,
                            .x1 = x1,
                            .z1 = z1,
                            .vx1 = u1 * s->c,
                            .vz1 = u1 * s->s,
                            .spin = w->k > 0 ? u / w->rock.radius : 0,
                            .contacts = w->contacts};
    w->watch->piece(w->watch->context, &p);
}

/* Moves along the segment by ds to a point and notes what is passed. */
static void roll_to(struct walker *w, struct roll *r, double ds, double u2_end, double x, double z)
{
    if (r->dir > 0 && w->next_x <= x)
        pass_in_roll(w, r, ds, u2_end, x);
    if (w->watch && w->watch->piece)
        show_roll(w, r, u2_end, x, z);
    r->u2 = u2_end;
    w->at.x = x;
    w->at.z = z;
    set_rolling_speed(w, r);
}

/* The same, exactly onto the segment's end where `to_end`. */
static void roll_piece(struct walker *w, struct roll *r, double ds, double u2_end, bool to_end)
{
    double x, z;
    roll_point(w, r->dir, ds, to_end, &x, &z);
    roll_to(w, r, ds, u2_end, x, z);
}

enum at_stem { NO_STEM, PASSED_STEM, STOPPED_AT_STEM };

/* Rolls to the next stem, if it is met within the next ds metres, over which u2 changes by `rate` a metre. The rest of
 * the roll goes on behind it. */
static __attribute__((noinline)) enum at_stem roll_to_stem(struct walker *w, struct roll *r, double ds, double rate)
{
    const struct ground *g = w->g;
    size_t j = w->at.segment;
    double x_end, z_end;
    roll_point(w, r->dir, ds, false, &x_end, &z_end);
    for (;;) {
        double x = r->dir > 0 ? w->stem_ahead : w->stem_behind;
        if (r->dir > 0 ? !(x <= x_end) : !(x >= x_end))
            return NO_STEM;
        struct stem stem;
        if (!take_stem(w, r->dir > 0 ? 0 : 1, &stem)) {
            if (w->gives_up)
                return STOPPED_AT_STEM;
            continue;
        }
        double z = ground_height(g, j, x), way = ground_length(&g->segments[j], w->at.x, w->at.z, x, z);
        double u2 = r->u2 + rate * way;
        roll_to(w, r, way, u2 > 0 ? u2 : 0, x, z);
        r->left -= way;
        double share = hit_stem(w, &stem, x, 0, 0.5 * w->rock.mass * r->u2 * (1 + w->k));
        r->u2 *= share * share;
        set_rolling_speed(w, r);
        return share > 0 ? PASSED_STEM : STOPPED_AT_STEM;
    }
}

/* At the end of the segment: onto the next one, off the profile, or into the air. `l` is set where it takes off. */
static enum after_roll roll_over_vertex(struct walker *w, struct roll *r, struct landing *l)
{
    const struct ground *g = w->g;
    size_t j = w->at.segment;
    if (r->dir > 0 ? j + 1 == g->n : j == 0)
        return ROLLED_OUT;
    size_t next = r->dir > 0 ? j + 1 : j - 1;
    const struct ground_segment *a = &g->segments[j], *b = &g->segments[next];
    double turn = r->dir * (a->c * b->s - a->s * b->c); /* > 0: the ground turns up, a concave vertex */
    if (turn > 0) {
        double cosine = a->c * b->c + a->s * b->s;
        r->u2 = cosine > 0 ? r->u2 * (cosine * cosine) : 0;
    }
    w->at.segment = next;
    if (turn < 0) {
        double u = r->dir * sqrt(r->u2);
        struct flight off = {
            .x = w->at.x, .z = w->at.z, .vx = u * a->c, .vz = u * a->s, .segment = next, .on_ground = true};
        *l = next_landing(g, &off);
        if (!is_roll(w, &off, off.vz * b->c - off.vx * b->s, l)) {
            w->at = off;
            return TOOK_OFF;
        }
    }
    return ROLLED;
}

/* Ground ahead of a roll: a vertex less than R away, when it was looked for the last such. */
struct ahead {
    bool known;
    size_t vertex;
};

static void look_ahead(const struct walker *w, int dir, size_t v, struct ahead *to)
{
    const double *along = w->g->along;
    size_t last = dir > 0 ? w->g->n : 0, step = 1;
    if (!to->known)
        to->vertex = v;
    to->known = true;
    double r = w->rock.radius * (1 - ROUNDING);
    for (;; step *= 2) { /* in ever larger steps, */
        size_t room = dir > 0 ? last - to->vertex : to->vertex;
        size_t next = dir > 0 ? to->vertex + step : to->vertex - step;
        if (step > room || !(fabs(along[next] - along[v]) < r))
            break;
        to->vertex = next;
    }
    for (; step > 0; step /= 2) { /* then smaller ones */
        size_t room = dir > 0 ? last - to->vertex : to->vertex;
        size_t next = dir > 0 ? to->vertex + step : to->vertex - step;
        if (step <= room && fabs(along[next] - along[v]) < r)
            to->vertex = next;
    }
}

/* Whether a rock that comes along segment j over its end v with speed u (u2 = u^2) surely rolls on at this convex vertex:
 * it rises little, and would be under the ground at a vertex less than R away. Looking at some vertices is enough, as most
 * often the farthest tells. */
static bool surely_rolls(const struct walker *w, int dir, size_t j, size_t v, double turn, double c_next, double u2,
                         struct ahead *ahead)
{
    const struct ground *g = w->g;
    const struct ground_segment *s = &g->segments[j];
    if (!(u2 * (turn * turn) < w->rock.radius * (2 * g->gravity * c_next) * (1 - ROUNDING)))
        return false;
    if (!ahead->known || !(fabs(g->along[ahead->vertex] - g->along[v]) > w->rock.radius / 2))
        look_ahead(w, dir, v, ahead);
    for (size_t far = dir > 0 ? ahead->vertex - v : v - ahead->vertex; far > 0; far /= 4) {
        size_t p = dir > 0 ? v + far : v - far;
        double dx = fabs(g->x[p] - g->x[v]), above = dir * s->s * dx - s->c * (g->z[p] - g->z[v]);
        if (2 * u2 * s->c * above < g->gravity * (dx * dx) * (1 - ROUNDING))
            return true;
    }
    return false;
}

/* Rolls over whole segments, from the vertex that `at` is on, as long as nothing but the speed changes: what may be a
 * standstill or a flight, a mark or the end of the roll is left to others, and those who look on see each segment. */
static void roll_over_segments(struct walker *w, struct roll *r)
{
    const struct ground *g = w->g;
    if (w->stems || (w->watch && w->watch->piece))
        return;
    int dir = r->dir;
    double pull = 2 * g->gravity / (1 + w->k);
    struct ahead ahead = {.known = false};
    for (;;) {
        size_t j = w->at.segment, v = dir > 0 ? j + 1 : j;
        double ds = g->along[j + 1] - g->along[j];
        if (v == (dir > 0 ? g->n : 0) || !(ds < r->left) || (dir > 0 && w->next_x <= g->x[v]))
            return;
        size_t next = dir > 0 ? j + 1 : j - 1;
        const struct ground_segment *a = &g->segments[j], *b = &g->segments[next];
        double u2 = r->u2 + pull * (dir * (g->z[j] - g->z[j + 1]) - a->mu * (g->x[j + 1] - g->x[j]));
        if (!(u2 > 0))
            return;
        double turn = dir * (a->c * b->s - a->s * b->c);
        if (turn > 0) {
            double cosine = a->c * b->c + a->s * b->s;
            u2 = cosine > 0 ? u2 * (cosine * cosine) : 0;
        } else if (turn < 0 && !surely_rolls(w, dir, j, v, turn, b->c, u2, &ahead)) {
            return;
        }
        r->u2 = u2;
        r->left -= ds;
        w->at.x = g->x[v];
        w->at.z = g->z[v];
        w->at.segment = next;
    }
}

/* Rolls for a length R along the ground from speed u; 0: downhill. */
SELDOM enum after_roll roll_on(struct walker *w, double u, struct landing *l)
{
    const struct ground *g = w->g;
    int downhill = g->segments[w->at.segment].m > 0 ? -1 : 1;
    struct roll r = {.dir = u > 0 ? 1 : u < 0 ? -1 : downhill, .u2 = u * u, .left = w->rock.radius};
    for (;;) {
        size_t j = w->at.segment, v = r.dir > 0 ? j + 1 : j;
        const struct ground_segment *s = &g->segments[j];
        double to_end = ground_length(s, w->at.x, w->at.z, g->x[v], g->z[v]);
        double ds = to_end < r.left ? to_end : r.left;
        double rate = 2 * g->gravity * (-r.dir * s->s - s->mu * s->c) / (1 + w->k);
        double u2 = r.u2 + rate * ds;
        bool stands = ds > 0 && rate <= 0 && !(u2 > 0);
        if (stands) {
            double stop = rate < 0 ? -r.u2 / rate : 0;
            if (stop <= STOP_ROUNDING * (fabs(w->at.x) + fabs(w->at.z)))
                stop = 0; /* not a place of its own: rounding must not lift the rock */
            ds = stop < ds ? stop : ds;
        }
        if (w->stems && ds > 0) {
            enum at_stem then = roll_to_stem(w, &r, ds, rate);
            if (then == STOPPED_AT_STEM)
                return STOPPED;
            if (then == PASSED_STEM && r.left > 0)
                continue;
            if (then == PASSED_STEM)
                return ROLLED;
        }
        if (stands) {
            roll_piece(w, &r, ds, 0, false);
            return STANDS;
        }
        roll_piece(w, &r, ds, u2, ds == to_end);
        r.left -= ds;
        if (!(r.left > 0))
            return ROLLED;
        enum after_roll then = roll_over_vertex(w, &r, l);
        if (then != ROLLED)
            return then;
        roll_over_segments(w, &r);
    }
}

/* Speed along the ground once a rock that comes with speed `along` rolls without slip. */
static inline double roll_speed(const struct walker *w, double along)
{
    return (along + w->k * w->spin * w->rock.radius) / (1 + w->k);
}

/* ---- resting ---- */

/* Whether the ground, from the start of segment j on towards dir, rises to height z before it falls. */
static bool rises_to(const struct ground *g, size_t j, int dir, double z)
{
    for (;;) {
        if (g->z[dir > 0 ? j + 1 : j] >= z)
            return true;
        if (dir > 0 ? j + 1 == g->n : j == 0)
            return false;
        j = dir > 0 ? j + 1 : j - 1;
        if (dir * g->segments[j].m < 0)
            return false;
    }
}

/* The first segment from j on towards dir that is not level, with the metres of level ground before it; false where the
 * profile ends. */
static bool past_level(const struct ground *g, size_t *j, int dir, double *level)
{
    *level = 0;
    for (;;) {
        if (dir > 0 ? *j + 1 == g->n : *j == 0)
            return false;
        *j = dir > 0 ? *j + 1 : *j - 1;
        if (g->segments[*j].m != 0)
            return true;
        *level += g->along[*j + 1] - g->along[*j];
    }
}

/* Whether the bottom of a pit lies less than R downhill: a vertex, or a level stretch shorter than R, between two sides
 * steeper than their friction, of which the far one leads up to where the rock stands. */
static bool in_pit(const struct ground *g, const struct walker *w)
{
    size_t j = w->at.segment;
    int dir = g->segments[j].m < 0 ? 1 : -1;
    double r = w->rock.radius, x = w->at.x, z = w->at.z, way = 0;
    for (;;) { /* segment j falls */
        const struct ground_segment *side = &g->segments[j];
        size_t v = dir > 0 ? j + 1 : j;
        double level;
        way += ground_length(side, x, z, g->x[v], g->z[v]);
        if (!(way < r) || !past_level(g, &j, dir, &level) || !(level < r))
            return false;
        const struct ground_segment *next = &g->segments[j];
        if (dir * next->m > 0)
            return fabs(side->m) > side->mu && fabs(next->m) > next->mu && rises_to(g, j, dir, w->at.z);
        if (level > 0) /* a terrace, no pit */
            return false;
        x = g->x[v];
        z = g->z[v];
    }
}

static bool rests(const struct walker *w)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    return !(fabs(s->m) > s->mu) || in_pit(w->g, w);
}

/* ---- the whole way ---- */

/* Whether a long way is to end here: too many contacts, or nobody waits for it any more. */
SELDOM bool has_enough(struct walker *w)
{
    if (w->arrivals_only && w->next_mark == w->marks->n)
        return true;
    w->pause = next_pause(w);
    w->cancelled = is_cancelled(w);
    return w->cancelled || w->contacts >= CEDUO_CONTACTS_MOST;
}

/* All that follows on the ground after a contact from which the rock rolls, to the next contact, flight or the end. */
enum after_ground { GROUND_CONTACT, GROUND_FLIES, GROUND_RESTS, GROUND_LEAVES, GROUND_STOPPED, GROUND_TOO_MANY };

SELDOM enum after_ground go_on_ground(struct walker *w, double along, struct landing *l)
{
    double u = roll_speed(w, along);
    if (u == 0 && rests(w))
        return GROUND_RESTS;
    enum after_roll then = roll_on(w, u, l);
    while (then == STANDS) {
        if (rests(w))
            return GROUND_RESTS;
        if (w->contacts >= w->pause && has_enough(w))
            return GROUND_TOO_MANY;
        w->contacts++;
        then = roll_on(w, 0, l);
    }
    if (then == STOPPED)
        return w->gives_up ? GROUND_TOO_MANY : GROUND_STOPPED;
    return then == TOOK_OFF ? GROUND_FLIES : then == ROLLED_OUT ? GROUND_LEAVES : GROUND_CONTACT;
}

/* Comes down at `l`, past what stands in the way; false where that ends it. */
HOT bool come_down(struct walker *w, struct flight *at, struct landing *l, enum ceduo_end *end)
{
    if (stem_on_way(w, l->x) && fly_past_stems(w, at, l)) {
        w->at = *at;
        *end = w->gives_up ? CEDUO_UNFINISHED : CEDUO_STOPPED_BY_STEMS;
        return false;
    }
    fly(w, at, l);
    if (l->left) {
        w->at = *at;
        *end = CEDUO_LEFT_SLOPE;
        return false;
    }
    return true;
}

/* The same for a rock that rolls after a contact which it leaves with `along`: to the next contact, or into a flight. */
static __attribute__((noinline)) bool roll_further(struct walker *w, double along, struct course *c,
                                                   enum ceduo_end *end)
{
    w->at = c->at;
    enum after_ground then = go_on_ground(w, along, &c->l);
    c->at = w->at;
    c->v = (struct velocity){.along = w->along, .off = 0};
    c->flies = then == GROUND_FLIES;
    *end = then == GROUND_RESTS    ? CEDUO_AT_REST
           : then == GROUND_LEAVES  ? CEDUO_LEFT_SLOPE
           : then == GROUND_STOPPED ? CEDUO_STOPPED_BY_STEMS
                                    : CEDUO_UNFINISHED;
    return then == GROUND_FLIES || then == GROUND_CONTACT;
}

HOT void start(const struct walker *w, struct course *c)
{
    c->at = w->at;
    c->v = velocity_on(&w->g->segments[c->at.segment], &c->at);
    c->flies = !c->at.on_ground || c->v.off > 0;
    if (c->flies)
        c->l = next_landing(w->g, &c->at);
}

HOT enum ceduo_end walk_by(struct walker *w, struct course c, enum ceduo_law law, bool blocks)
{
    struct flight at = c.at; /* w->at is brought up to date for those who are called */
    struct velocity v = c.v;
    struct facet facet = {.angle = 0, .sine = 0, .cosine = 1};
    struct landing l = c.l;
    bool flies = c.flies;
    enum ceduo_end end;
    for (;;) {
        if (flies) {
            if (!come_down(w, &at, &l, &end))
                return end;
            v = velocity_on(&w->g->segments[at.segment], &at);
        }
        if (w->contacts >= w->pause && has_enough(w)) {
            w->at = at;
            return CEDUO_UNFINISHED;
        }
        strike(w, &at, &v, &facet, law);
        w->contacts++;
        turn_facet(w, at.segment, &facet);
        at.on_ground = true;
        l = next_landing_over(w->g, &at, blocks);
        flies = !is_roll(w, &at, v.off, &l);
        if (flies)
            continue;
        c.at = at;
        if (!roll_further(w, v.along, &c, &end))
            return end;
        at = c.at;
        v = c.v;
        l = c.l;
        flies = c.flies;
    }
}

enum ceduo_end ceduo_walk_on(struct walker *w, const struct course *c, enum ceduo_law law)
{
    switch (law) {
#define X(NAME, name)                                                                                                      \
    case CEDUO_LAW_##NAME:                                                                                                 \
        return w->g->top > 0 ? walk_by(w, *c, CEDUO_LAW_##NAME, true) : walk_by(w, *c, CEDUO_LAW_##NAME, false);
        CEDUO_LAWS(X)
#undef X
    default:
        return CEDUO_UNFINISHED;
    }
}

enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law)
{
    struct course c = {.flies = false};
    start(w, &c);
    return ceduo_walk_on(w, &c, law);
}

/* ---- the way in pieces ---- */

void ceduo_walk_pass_marks(struct walker *w, struct flight at, double x, double t)
{
    pass_in_flight(w, at, x, t);
}

bool ceduo_walk_come_down(struct walker *w, struct course *c, enum ceduo_end *end)
{
    if (c->flies) {
        if (!come_down(w, &c->at, &c->l, end))
            return false;
        c->v = velocity_on(&w->g->segments[c->at.segment], &c->at);
        c->flies = false;
    }
    if (w->contacts >= w->pause && has_enough(w)) {
        w->at = c->at;
        *end = CEDUO_UNFINISHED;
        return false;
    }
    return true;
}

bool ceduo_walk_start(struct walker *w, struct course *c, enum ceduo_end *end)
{
    start(w, c);
    return ceduo_walk_come_down(w, c, end);
}

bool ceduo_walk_go_off(struct walker *w, struct course *c, enum ceduo_end *end)
{
    c->l = next_landing(w->g, &c->at);
    c->flies = !is_roll(w, &c->at, c->v.off, &c->l);
    return c->flies || roll_further(w, c->v.along, c, end);
}

void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle)
{
    struct ground_point p = ground_point(w, segment);
    *rn = p.rn;
    *rt = p.rt;
    *largest_angle = largest_facet(w, segment);
}
