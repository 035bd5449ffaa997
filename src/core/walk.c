/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "walk.h"

#include <float.h>

#include "law_crsp.h"
#include "law_lumped.h"

enum after_roll { ROLLED, TOOK_OFF, STANDS, ROLLED_OUT };

/* ---- release ---- */

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
    size_t segment = ceduo_slope_segment(g->slope, x);
    w->at = (struct flight){.x = x,
                            .z = ground_height(g, segment, x) + height,
                            .vx = draw_release(w, scene->release.vx, 2),
                            .vz = draw_release(w, scene->release.vz, 3),
                            .segment = segment,
                            .on_ground = !(height > 0)};
    w->contacts = 0;
    w->rolls = w->cancelled = false;
    w->facets_of = UINT64_MAX;
    w->next_mark = 0;
    while (w->next_mark < marks->n && marks->x[w->next_mark] <= x)
        w->next_mark++;
    return CEDUO_OK;
}

/* ---- passing marks ---- */

static inline void pass_mark(struct walker *w, double vx, double vz, double spin, double height)
{
    struct ceduo_crossing c = {.reached = true, .vx = vx, .vz = vz, .spin = spin, .height = height > 0 ? height : 0};
    w->cross(w->context, w->next_mark++, &c);
}

static inline void pass_in_flight(struct walker *w, const struct landing *l)
{
    if (!(w->at.vx > 0))
        return;
    while (w->next_mark < w->marks->n && w->marks->x[w->next_mark] <= l->x) {
        double t = (w->marks->x[w->next_mark] - w->at.x) / w->at.vx;
        t = t < l->t ? t : l->t;
        double z = w->at.z + (w->at.vz - w->g->half_g * t) * t;
        pass_mark(w, w->at.vx, w->at.vz - w->g->gravity * t, w->spin, z - w->marks->z[w->next_mark]);
    }
}

/* ---- flight ---- */

static inline void fly(struct walker *w, const struct landing *l)
{
    pass_in_flight(w, l);
    double vz = w->at.vz - w->g->gravity * l->t;
    if (w->visit) {
        struct ceduo_piece p = {.rolls = false,
                                .x = w->at.x,
                                .z = w->at.z,
                                .vx = w->at.vx,
                                .vz = w->at.vz,
                                .x1 = l->x,
                                .z1 = l->z,
                                .vx1 = w->at.vx,
                                .vz1 = vz,
                                .spin = w->spin,
                                .seconds = l->t,
                                .contacts = w->contacts};
        w->visit(w->context, &p);
    }
    w->at.x = l->x;
    w->at.z = l->z;
    w->at.vz = vz;
    w->at.segment = l->segment;
    w->at.on_ground = true;
    w->rolls = false;
}

/* ---- contact ---- */

static inline double facet_draw(struct walker *w)
{
    uint64_t n = w->contacts;
    if (w->facets_of != n >> 1) {
        w->facets_of = n >> 1;
        w->facets = random_pair(w->seed, w->number, n >> 1, RANDOM_FACET);
    }
    return w->facets.u[n & 1];
}

static inline double largest_facet(const struct walker *w)
{
    size_t j = w->at.segment;
    if (!w->g->theta_varies)
        return w->g->segments[j].theta;
    const struct ceduo_segment *s = &w->g->slope->segments[j];
    return s->roughness_m > 0 ? atan(s->roughness_m / w->rock.radius) : w->g->segments[j].theta;
}

static inline struct ceduo_ground_point ground_point(const struct walker *w)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    struct ceduo_ground_point p = {
        .rn = s->rn, .rt = s->rt, .radius = w->rock.radius, .k = w->k, .scale_rn = w->scale_rn};
    const struct ceduo_segment *from = &w->g->slope->segments[w->at.segment];
    if (w->g->rn_varies)
        p.rn = ceduo_number_draw(from->rn, w->rn_u, 0, 1);
    if (w->g->rt_varies)
        p.rt = ceduo_number_draw(from->rt, w->rt_u, 0, 1);
    return p;
}

/* The facet that the rock strikes, as sine and cosine of its turn from the segment. (along, off) is the velocity in the
 * segment's axes. */
static inline void facet_turn(struct walker *w, double along, double off, double *sine, double *cosine)
{
    *sine = 0;
    *cosine = 1;
    double largest = largest_facet(w);
    if (!(largest > 0))
        return;
    double u = facet_draw(w), angle;
    if (w->g->facets == CEDUO_BOTH)
        angle = largest * (2 * u - 1);
    else
        angle = along >= 0 ? largest * u : -(largest * u);
    double s, c;
    sincos_quarter(angle, &s, &c);
    if (off * c - along * s > 0) /* the rock is leaving this facet */
        return;
    *sine = s;
    *cosine = c;
}

/* A contact, in the segment's axes: what a rock that rolls brings has no part off the ground, exactly. */
static inline __attribute__((always_inline)) void strike(struct walker *w, enum ceduo_law law)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    double along = w->rolls ? w->along : w->at.vx * s->c + w->at.vz * s->s;
    double off = w->rolls ? 0 : w->at.vz * s->c - w->at.vx * s->s;
    double sine, cosine;
    facet_turn(w, along, off, &sine, &cosine);
    struct ceduo_ground_point point = ground_point(w);
    double inward = along * sine - off * cosine;
    struct ceduo_impact in = {
        .vn = inward > 0 ? inward : 0, .vt = along * cosine + off * sine, .spin = w->spin};
    struct ceduo_impact out;
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
    along = out.vt * cosine - out.vn * sine;
    off = out.vt * sine + out.vn * cosine;
    if (!(off > 0)) /* into the segment: that part is lost */
        off = 0;
    w->along = along;
    w->off = off;
    w->at.vx = along * s->c - off * s->s;
    w->at.vz = along * s->s + off * s->c;
    w->spin = out.spin;
}

/* ---- rolling ---- */

/* Whether a free flight that ends at `l` is so short and flat that the rock rolls: less than R along the ground, and
 * less than R above the segment it starts from, which it leaves with speed `off`. */
static inline bool is_roll(const struct walker *w, const struct flight *f, double off, const struct landing *l)
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
    w->rolls = true;
    w->along = u;
    w->at.vx = u * s->c;
    w->at.vz = u * s->s;
    w->spin = w->k > 0 ? u / w->rock.radius : 0;
}

/* Moves along the segment by ds and notes what is passed; exactly onto its end where `to_end`. */
static void roll_piece(struct walker *w, struct roll *r, double ds, double u2_end, bool to_end)
{
    const struct ground *g = w->g;
    size_t j = w->at.segment;
    const struct ground_segment *s = &g->segments[j];
    set_rolling_speed(w, r);
    struct ceduo_piece p = {.rolls = true,
                            .x = w->at.x,
                            .z = w->at.z,
                            .vx = w->at.vx,
                            .vz = w->at.vz,
                            .spin = w->spin,
                            .contacts = w->contacts};
    double x, z;
    size_t v = r->dir > 0 ? j + 1 : j;
    if (to_end) {
        x = g->x[v];
        z = g->z[v];
    } else if (s->steep) {
        z = clamp(w->at.z + r->dir * s->s * ds, g->z[j], g->z[j + 1]);
        x = clamp(g->x[j] + (z - g->z[j]) / s->m, g->x[j], g->x[j + 1]);
    } else {
        x = clamp(w->at.x + r->dir * s->c * ds, g->x[j], g->x[j + 1]);
        z = ground_height(g, j, x);
    }
    double rate = ds > 0 ? (u2_end - r->u2) / ds : 0;
    while (r->dir > 0 && w->next_mark < w->marks->n && w->marks->x[w->next_mark] <= x) {
        size_t m = w->next_mark;
        double u2 = r->u2 + rate * ground_length(s, w->at.x, w->at.z, w->marks->x[m], w->marks->z[m]);
        double u = u2 > 0 ? sqrt(u2) : 0;
        pass_mark(w, u * s->c, u * s->s, w->k > 0 ? u / w->rock.radius : 0, 0);
    }
    r->u2 = u2_end;
    w->at.x = x;
    w->at.z = z;
    set_rolling_speed(w, r);
    if (w->visit) {
        p.x1 = x;
        p.z1 = z;
        p.vx1 = w->at.vx;
        p.vz1 = w->at.vz;
        w->visit(w->context, &p);
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

/* Rolls for a length R along the ground from speed u; 0: downhill. */
static enum after_roll roll_on(struct walker *w, double u, struct landing *l)
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
        if (ds > 0 && rate <= 0 && !(u2 > 0)) {
            double stop = rate < 0 ? -r.u2 / rate : 0;
            if (stop <= 4 * DBL_EPSILON * (fabs(w->at.x) + fabs(w->at.z)))
                stop = 0; /* not a place of its own: rounding must not lift the rock */
            roll_piece(w, &r, stop < ds ? stop : ds, 0, false);
            return STANDS;
        }
        roll_piece(w, &r, ds, u2, ds == to_end);
        r.left -= ds;
        if (!(r.left > 0))
            return ROLLED;
        enum after_roll then = roll_over_vertex(w, &r, l);
        if (then != ROLLED)
            return then;
    }
}

/* Speed along the ground once the rock rolls without slip. */
static inline double roll_speed(const struct walker *w)
{
    return (w->along + w->k * w->spin * w->rock.radius) / (1 + w->k);
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

/* Looks at the flag once in so many contacts: a rock may have a million before it. */
static inline bool is_cancelled(struct walker *w)
{
    if ((w->contacts & 0xfff) != 0xfff || !w->cancel)
        return false;
    w->cancelled = atomic_load_explicit(w->cancel, memory_order_relaxed);
    return w->cancelled;
}

enum contact_then { CONTACT_FLIES, CONTACT_RESTS, CONTACT_LEAVES, CONTACT_TOO_MANY };

/* From a contact on the ground through all that follows on the ground, to the next flight or the end. */
static inline __attribute__((always_inline)) enum contact_then touch(struct walker *w, struct landing *l,
                                                                     enum ceduo_law law)
{
    for (;;) {
        if (w->contacts >= CEDUO_CONTACTS_MOST || is_cancelled(w))
            return CONTACT_TOO_MANY;
        strike(w, law);
        w->contacts++;
        w->at.on_ground = true;
        *l = next_landing(w->g, &w->at);
        if (!is_roll(w, &w->at, w->off, l))
            return CONTACT_FLIES;
        double u = roll_speed(w);
        if (u == 0 && rests(w))
            return CONTACT_RESTS;
        enum after_roll then = roll_on(w, u, l);
        while (then == STANDS) {
            if (rests(w))
                return CONTACT_RESTS;
            if (w->contacts >= CEDUO_CONTACTS_MOST)
                return CONTACT_TOO_MANY;
            w->contacts++;
            then = roll_on(w, 0, l);
        }
        if (then == TOOK_OFF)
            return CONTACT_FLIES;
        if (then == ROLLED_OUT)
            return CONTACT_LEAVES;
    }
}

static inline __attribute__((always_inline)) enum ceduo_end walk_by(struct walker *w, enum ceduo_law law)
{
    const struct ground_segment *s = &w->g->segments[w->at.segment];
    bool flies = !w->at.on_ground || w->at.vz * s->c - w->at.vx * s->s > 0;
    struct landing l = flies ? next_landing(w->g, &w->at) : (struct landing){0};
    for (;;) {
        if (flies) {
            fly(w, &l);
            if (l.left)
                return CEDUO_LEFT_SLOPE;
        }
        switch (touch(w, &l, law)) {
        case CONTACT_FLIES:
            flies = true;
            break;
        case CONTACT_RESTS:
            return CEDUO_AT_REST;
        case CONTACT_LEAVES:
            return CEDUO_LEFT_SLOPE;
        case CONTACT_TOO_MANY:
            return CEDUO_UNFINISHED;
        }
    }
}

enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law)
{
    switch (law) {
#define X(NAME, name)      \
    case CEDUO_LAW_##NAME: \
        return walk_by(w, CEDUO_LAW_##NAME);
        CEDUO_LAWS(X)
#undef X
    default:
        return CEDUO_UNFINISHED;
    }
}
