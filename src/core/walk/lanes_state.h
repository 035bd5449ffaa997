/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of the lanes, and rare events that the scalar walk handles for one lane. */
#ifndef CEDUO_LANES_LANE_H
#define CEDUO_LANES_LANE_H

#include <math.h>
#include <stddef.h>

#include "base/real.h"
#include "impact.h"
#include "lanes.h"

#define EACH_REGISTER(i) for (size_t i = 0; i < LANES; i += REAL_LANES)
#define ALL_LANES        ((unsigned)(((uint64_t)1 << LANES) - 1))

/* Look up the two numbers of a table at each of some segments or vertices. `small`: the table has at most 16 entries. */
FORCE_INLINE void lookup_at(const struct lanes_table *table, const uint64_t *i, int shift, bool small, real *first,
                            real *second)
{
#ifdef LOOKUP_16
    /* untaken 2: machine */
    if (small) { /* in registers */
        *first = lookup_16(table->first, load_ints(i));
        *second = lookup_16(table->second, load_ints(i));
        return;
    }
#endif
    (void)small;
    gather_pairs(table->pairs, i, shift, first, second);
}

FORCE_INLINE void lookup_segments(const struct lanes_table *table, const uint64_t *i, bool small, real *first, real *second)
{
    lookup_at(table, i, SEGMENT_SHIFT, small, first, second);
}

/* Look up the x of the vertices after `i`. */
FORCE_INLINE void lookup_next_x(const struct lanes_table *table, const uint64_t *i, bool small, real *x)
{
#ifdef LOOKUP_16
    /* untaken 2: machine */
    if (small) {
        *x = lookup_16(table->first, load_ints(i) + 1);
        return;
    }
#endif
    (void)small;
    real z;
    gather_pairs(table->pairs + 1, i, 0, x, &z);
}

FORCE_INLINE void lookup_vertices(const struct lanes_table *table, ints i, bool small, real *first, real *second)
{
    uint64_t index[REAL_LANES];
    store_ints(index, i);
    lookup_at(table, index, 0, small, first, second);
}

/* Compile-time parameters of the step functions. */
struct kernel_params {
    const struct contact_law *law;
    bool small; /* the tables have at most 16 entries */
    bool stems; /* there are stems */
};

/* Flights that leave the segment of their start, one after the other without gaps. */
struct leaving {
    _Alignas(64) double x[LANES], z[LANES], vx[LANES], vz[LANES];
    double inv[LANES];       /* 1/vx */
    double reach[LANES];     /* m along x: a flight that lands nearer may be a roll */
    uint64_t segment[LANES]; /* of the search, finally of the landing */
    double t[LANES], to_x[LANES], q[LANES], along[LANES], off[LANES];
    unsigned n;
};

/* State of all rocks in the lanes between two contacts. Segments count from 1, as the tables of struct lanes_ground; 0 and
 * n + 1 lie off the slope. */
struct lanes {
    const struct lanes_job *job;
    const struct lanes_ground *ground;
    const struct ground *g;
    uint64_t seed;
    bool has_chunks;    /* the ground has chunks */
    bool ground_varies; /* the ground varies between rocks */
    bool theta_varies;  /* or only the largest facet angle, with the rock's radius */
    bool small_facets;  /* facet angles are at most pi/4 */
    bool against, scale_rn, friction_bound;

    /* next contact, and the motion after the last one, on segment `from` */
    _Alignas(64) uint64_t segment[LANES], from[LANES];
    struct motions {
        double q[LANES], along[LANES], off[LANES];
    } to, after;
    double spin[LANES];
    double x[LANES], z[LANES], vx[LANES], vz[LANES], t[LANES], to_x[LANES];  /* the flight to it, unless at_contact */
    double c[LANES], s[LANES], length[LANES], theta[LANES], friction[LANES]; /* of the ground at the contact */
    struct {
        double along[LANES], spin[LANES];
    } before_contact; /* of lanes that rolled to the contact */
    struct leaving leaving;
    double draw[3][LANES]; /* draws for the facets of the next contacts */
    struct {
        double sine[LANES], cosine[LANES];
    } facet, section_turn; /* orientations of facet and section */
    double turn[3][LANES]; /* draws for the orientations of the sections */
    struct {
        double wide[LANES], high[LANES], reach[LANES], gyration[LANES];
    } section;
    double next_x[LANES], stem_ahead[LANES], stem_behind[LANES];
    struct {
        double height[LANES];           /* m, of the next stem ahead */
        double cost[LANES];             /* J that a hit takes, see struct hit */
        const struct stem *next[LANES]; /* NULL: not in the queue, or unknown */
        double second_x[LANES];         /* x of the following queued stem; it is next if before certain_to */
        double certain_to[LANES];       /* x up to which only queued stems stand */
        double overlap_to[LANES];       /* x up to which stools around the release may reach */
        double clear_to[LANES];         /* x up to which the flight is above `tallest` */
        uint64_t *hit_stools[LANES];    /* of struct stems */
        uint64_t hit[LANES], stools_met[LANES];
    } stem; /* save_stems() returns counts and `next` to the walker and its stems */
    double radius[LANES], k[LANES], mass[LANES], moment[LANES];
    double rn[LANES], rt[LANES]; /* if ground_varies */
    uint64_t contacts[LANES], pause[LANES], number[LANES];
    double tallest; /* m: above the height of any stem */

    /* bit i is lane i */
    unsigned live;            /* has a rock */
    unsigned at_contact;      /* has reached its next contact without a flight */
    unsigned rolling;         /* likewise, by rolling */
    unsigned rolled;          /* rolled to its last contact; if it still rolls, its motion continues */
    unsigned off_slope;       /* lands off the slope */
    unsigned need_draws;      /* has no draws yet */
    unsigned after_hit;       /* after a hit: its landing is searched in this step */
    unsigned waiting;         /* among stems: unchanged while other lanes land */
    unsigned landing_unknown; /* likewise, its landing is unknown */
    unsigned stem_unknown;    /* its next stem is unknown */
    bool exhausted;           /* no rocks are left */
    bool shared_start;        /* every rock reaches its first contact in state `start`, without passing a mark */
    struct rock_state start;
};

_Static_assert(offsetof(struct lanes, contacts) % 64 == 0, "what is for lanes is loaded from whole lines of the cache");

/* Return the lanes without a contact in this step. */
FORCE_INLINE unsigned in_the_air(struct kernel_params params, const struct lanes *k)
{
    return params.stems ? k->after_hit | k->waiting : 0;
}

/* ---- one lane and its walker ---- */

static void load_draws_of(const struct walker *w, enum random_kind kind, double draws[3][LANES], size_t i)
{
    struct random_pair pair = random_pair(w->seed, w->number, w->contacts >> 1, kind);
    draws[0][i] = pair.u[w->contacts & 1];
    draws[1][i] = pair.u[1];
}

static void load_draws(struct lanes *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    load_draws_of(w, RANDOM_FACET, k->draw, i);
    if (w->has_section)
        load_draws_of(w, RANDOM_TURN, k->turn, i);
}

/* Save hits and next stem of a lane to its walker. */
static inline void save_stems(const struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    if (!w->stems)
        return;
    w->stems_hit = k->stem.hit[i];
    w->stools_met = k->stem.stools_met[i];
    if (!k->stem.next[i])
        return;
    struct stems_side *side = &w->stems->side[0];
    side->first = (size_t)(k->stem.next[i] - side->queue);
    w->stem_ahead = side->next = k->stem_ahead[i];
}

/* Load the next stem ahead, if there is one. */
static void load_stem(struct lanes *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    k->stem_behind[i] = w->stem_behind;
    k->stem_ahead[i] = w->stem_ahead;
    k->stem_unknown &= ~bit;
    struct stems_side *side = &w->stems->side[0];
    k->stem.hit[i] = w->stems_hit;
    k->stem.stools_met[i] = w->stools_met;
    k->stem.hit_stools[i] = w->stems->hit_stools;
    k->stem.overlap_to[i] = w->stems->start + 2 * w->stems->forest->reach;
    k->stem.next[i] = NULL;
    k->stem.second_x[i] = k->stem.certain_to[i] = INFINITY;
    if (w->stem_ahead == INFINITY)
        return;
    if (!side->next_known) {
        k->stem_unknown |= bit;
        return;
    }
    k->stem.height[i] = ceduo_stems_next(side)->height;
    k->stem.cost[i] = ceduo_stems_next(side)->energy;
    if (side->next_queued) {
        side->queue[side->end].along = INFINITY;
        k->stem.next[i] = &side->queue[side->first];
        k->stem.second_x[i] = k->stem.next[i][1].along;
        k->stem.certain_to[i] = side->certain_to;
    }
}

/* Load a state, and the members of the walker that the scalar walk may have changed. */
static void load_state(struct lanes *k, size_t i, const struct rock_state *c)
{
    const struct walker *w = &k->job->walkers[i];
    const struct contact *contact = c->flies ? &c->l.contact : &c->contact;
    k->spin[i] = w->spin;
    k->next_x[i] = w->next_x;
    k->contacts[i] = w->contacts;
    k->pause[i] = w->pause;
    if (w->stems)
        load_stem(k, i);
    k->segment[i] = contact->segment + 1;
    k->to.q[i] = contact->q;
    k->to.along[i] = contact->along;
    k->to.off[i] = contact->off;
    if (!c->flies)
        return;
    k->x[i] = c->flight.x;
    k->z[i] = c->flight.z;
    k->vx[i] = c->flight.vx;
    k->vz[i] = c->flight.vz;
    k->from[i] = c->flight.segment + 1;
    k->t[i] = c->l.t;
    k->to_x[i] = c->l.x;
}

static struct flight flight_of(const struct lanes *k, size_t i)
{
    return (struct flight){k->x[i], k->z[i], k->vx[i], k->vz[i], (size_t)k->from[i] - 1};
}

/* Return the height of a flight after t. */
static double height_of(const struct lanes *k, size_t i, double t)
{
    return k->z[i] + (k->vz[i] - k->g->half_g * t) * t;
}

/* Save a lane to its walker, and return its state. */
static struct rock_state save_lane(struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    w->spin = k->spin[i];
    w->contacts = k->contacts[i];
    save_stems(k, i);
    struct rock_state c = {.contact = {(size_t)k->segment[i] - 1, k->to.q[i], k->to.along[i], k->to.off[i]},
                           .flies = !(k->at_contact & bit),
                           .landing_unknown = (k->after_hit | k->landing_unknown) & bit,
                           .rolled = k->rolling & bit,
                           .flight = flight_of(k, i)};
    c.l = (struct landing){k->t[i], k->to_x[i], height_of(k, i, k->t[i]), c.contact, k->off_slope & bit};
    if (c.l.off_slope)
        c.l.contact.segment = k->vx[i] > 0 ? k->g->n - 1 : 0;
    return c;
}

static void load_rock(struct lanes *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    k->radius[i] = w->rock.radius;
    k->k[i] = w->k;
    k->mass[i] = w->rock.mass;
    k->moment[i] = w->rock.moment;
    k->section.wide[i] = w->section.wide;
    k->section.high[i] = w->section.high;
    k->section.reach[i] = w->section.reach;
    k->section.gyration[i] = w->section.gyration;
}

/* Load the next rock, at its first contact. `shared`: its start and, unless it has a section, the rock are those of the rock
 * before. */
static void refill(struct lanes *k, size_t i, bool shared)
{
    const struct lanes_job *job = k->job;
    struct walker *w = &job->walkers[i];
    unsigned bit = 1u << i;
    k->off_slope &= ~bit;
    k->rolling &= ~bit;
    k->at_contact |= bit;
    while (job->next(job->context, i)) {
        enum ceduo_end end;
        double mark = w->next_x;
        if (shared || ceduo_walk_start(w, &k->start, &end)) {
            load_state(k, i, &k->start);
            if (!shared || w->has_section)
                load_rock(k, i);
            k->number[i] = w->number;
            k->need_draws |= bit;
            k->shared_start = job->identical && w->next_x == mark;
            return;
        }
        job->ended(job->context, i, end);
    }
    /* An idle lane is computed like any other lane; its results are ignored. It stands still, so that it stays on the slope. */
    k->exhausted = true;
    k->live &= ~bit;
    k->stem_unknown &= ~bit;
    k->segment[i] = 1;
    k->to.q[i] = k->to.along[i] = k->to.off[i] = k->spin[i] = 0;
    k->next_x[i] = k->stem_ahead[i] = INFINITY;
    k->stem_behind[i] = -INFINITY;
    k->contacts[i] = 0;
    k->pause[i] = INT64_MAX;
}

static void finish(struct lanes *k, size_t i, enum ceduo_end end)
{
    k->job->ended(k->job->context, i, end);
    refill(k, i, k->shared_start);
}

/* ---- rare events ---- */

/* Land a flight that meets stems left to the scalar walk, or a rock with many contacts. */
NOINLINE void land_scalar(struct lanes *k, size_t i)
{
    struct rock_state c = save_lane(k, i);
    unsigned bit = 1u << i;
    enum ceduo_end end;
    if (!ceduo_walk_land(&k->job->walkers[i], &c, &end)) {
        k->after_hit &= ~bit;
        finish(k, i, end);
        return;
    }
    load_state(k, i, &c);
    k->at_contact |= bit;
    k->after_hit &= ~bit;
    k->off_slope &= ~bit;
}

/* End a flight after t, at x. */
NOINLINE void end_lane(struct lanes *k, size_t i, double x, double t, enum ceduo_end end)
{
    struct walker *w = &k->job->walkers[i];
    w->contacts = k->contacts[i];
    save_stems(k, i);
    w->flight.x = x;
    w->flight.z = height_of(k, i, t);
    finish(k, i, end);
}

/* Report the marks that a flight passes before its landing. */
NOINLINE void pass_marks_scalar(struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    const struct flight flight = flight_of(k, i);
    w->spin = k->spin[i];
    save_stems(k, i);
    if (flight.vx > 0) /* untaken: rounding */
        ceduo_walk_pass_marks(w, &flight, k->to_x[i], k->t[i]);
    k->next_x[i] = w->next_x;
    k->pause[i] = w->pause;
}

/* Continue after a contact, if the rock may roll, or if the search for its landing is long. */
NOINLINE void depart_scalar(struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    struct rock_state c = save_lane(k, i);
    unsigned bit = 1u << i;
    uint64_t contacts = w->contacts;
    enum ceduo_end end;
    c.contact = (struct contact){(size_t)k->from[i] - 1, k->after.q[i], k->after.along[i], k->after.off[i]};
    const struct rolling before = {k->before_contact.along[i], k->before_contact.spin[i]};
    if (ceduo_walk_rolls(w, &c) && !ceduo_walk_roll(w, &c, k->rolled & bit ? &before : NULL, &end)) {
        finish(k, i, end);
        return;
    }
    load_state(k, i, &c);
    if (w->contacts != contacts)
        load_draws(k, i);
    if (c.flies) {
        k->off_slope |= c.l.off_slope ? bit : 0;
    } else {
        k->at_contact |= bit;
        k->rolling |= bit;
    }
}

#endif
