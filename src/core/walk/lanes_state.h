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

#ifdef LOOKUP_16
#define LOOKUP_WRAPS true /* lookup() in a small table uses i modulo 16 */
#else
#define LOOKUP_WRAPS false
#endif

/* Look up the two numbers at i of a table, for each lane. `small`: the table has at most 16 entries. */
FORCE_INLINE void lookup(const struct lanes_table *table, ints i, bool small, real *first, real *second)
{
#ifdef LOOKUP_16
    /* untaken 2: machine */
    if (small) { /* in registers */
        *first = lookup_16(table->first, i);
        *second = lookup_16(table->second, i);
        return;
    }
#endif
    (void)small;
    uint64_t index[REAL_LANES];
    store_ints(index, i << table->shift);
    gather_pairs(table->pairs, index, first, second);
}

/* A chord in each lane. */
struct chords {
    double x0[LANES], z0[LANES], x1[LANES], z1[LANES], m[LANES];
};

FORCE_INLINE struct chord load_chord(const struct chords *from, size_t i)
{
    return (struct chord){load(&from->x0[i]), load(&from->z0[i]), load(&from->x1[i]), load(&from->z1[i]), load(&from->m[i])};
}

FORCE_INLINE void store_chord(struct chords *to, size_t i, struct chord chord)
{
    store(&to->x0[i], chord.x0);
    store(&to->z0[i], chord.z0);
    store(&to->x1[i], chord.x1);
    store(&to->z1[i], chord.z1);
    store(&to->m[i], chord.m);
}

FORCE_INLINE struct chord blend_chord(mask m, struct chord p, struct chord q)
{
    return (struct chord){blend(m, p.x0, q.x0), blend(m, p.z0, q.z0), blend(m, p.x1, q.x1), blend(m, p.z1, q.z1),
                          blend(m, p.m, q.m)};
}

/* Compile-time parameters of the step functions. */
struct kernel_params {
    const struct contact_law *law;
    bool small; /* the tables have at most 16 entries */
    bool stems; /* there are stems */
};

/* State of all rocks in the lanes between two contacts. `segment` and `to` count from 1, as the tables of struct lanes_ground;
 * 0 and n + 1 lie off the slope. */
struct lanes {
    const struct lanes_job *job;
    const struct lanes_ground *ground;
    const struct ground *g;
    uint64_t seed;
    bool has_chunks;    /* the ground has chunks */
    bool ground_varies; /* the ground varies between rocks */
    bool theta_varies;  /* or only the largest facet angle, with the rock's radius */
    bool against, scale_rn, friction_bound;
    bool steep; /* some segment is steeper than 45 degrees */

    _Alignas(64) double x[LANES], z[LANES], vx[LANES], vz[LANES], spin[LANES];
    uint64_t segment[LANES];
    /* next landing, with the ends, slope and largest facet angle of its segment */
    double t[LANES], to_x[LANES], to_z[LANES];
    uint64_t to[LANES];
    struct chords chords;
    double theta[LANES];
    double along[LANES], off[LANES]; /* m/s: velocity in the segment's axes after a contact */
    struct {
        double along[LANES], spin[LANES];
    } before_contact;       /* of lanes that rolled to the contact */
    double inv[LANES];      /* 1/vx */
    uint64_t vertex[LANES]; /* from 1; vertex reached by the search for the landing */
    double draw[3][LANES];  /* draws for the facets of the next contacts */
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
    unsigned at_contact;      /* has reached its next contact, at to_x, to_z */
    unsigned rolling;         /* likewise, rolling with speed `along`; vx, vz are not set */
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

/* Look up segments, and their largest facet angles. */
FORCE_INLINE struct chord lookup_chord(struct kernel_params params, const struct lanes *k, ints segment, real *theta)
{
    struct chord chord;
    lookup(&k->ground->vertices, segment, params.small, &chord.x0, &chord.z0);
    lookup(&k->ground->vertices, segment + 1, params.small, &chord.x1, &chord.z1);
    lookup(&k->ground->slopes, segment, params.small, &chord.m, theta);
    return chord;
}

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
    k->stem_ahead[i] = w->stem_ahead;
    k->stem_unknown &= ~bit;
    if (!w->stems)
        return;
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
    const struct lanes_ground *ground = k->ground;
    const struct walker *w = &k->job->walkers[i];
    k->spin[i] = w->spin;
    k->next_x[i] = w->next_x;
    k->stem_behind[i] = w->stem_behind;
    k->contacts[i] = w->contacts;
    k->pause[i] = w->pause;
    load_stem(k, i);
    k->x[i] = c->flight.x;
    k->z[i] = c->flight.z;
    k->vx[i] = c->flight.vx;
    k->vz[i] = c->flight.vz;
    k->segment[i] = c->flight.segment + 1;
    k->t[i] = c->flies ? c->l.t : 0;
    k->to_x[i] = c->flies ? c->l.x : c->flight.x;
    k->to_z[i] = c->flies ? c->l.z : c->flight.z;
    k->along[i] = c->along;
    uint64_t j = c->flies ? c->l.segment + 1 : c->flight.segment + 1;
    k->to[i] = j;
    k->chords.x0[i] = ground->vertices.pairs[j][0];
    k->chords.z0[i] = ground->vertices.pairs[j][1];
    k->chords.x1[i] = ground->vertices.pairs[j + 1][0];
    k->chords.z1[i] = ground->vertices.pairs[j + 1][1];
    const double *slope = ground->slopes.pairs[j << ground->slopes.shift];
    k->chords.m[i] = slope[0];
    k->theta[i] = slope[1];
}

/* Save a lane to its walker, and return its state. */
static struct rock_state save_lane(struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    bool off_slope = k->off_slope & bit;
    size_t to = off_slope ? (k->vx[i] < 0 ? 0 : w->g->n - 1) : k->to[i] - 1;
    w->spin = k->spin[i];
    w->contacts = k->contacts[i];
    save_stems(k, i);
    bool at_contact = k->at_contact & bit, rolling = k->rolling & bit;
    const struct ground_segment *s = &k->g->segments[k->segment[i] - 1];
    return (struct rock_state){.flight = {.x = at_contact ? k->to_x[i] : k->x[i],
                                          .z = at_contact ? k->to_z[i] : k->z[i],
                                          .vx = rolling ? k->along[i] * s->c : k->vx[i],
                                          .vz = rolling ? k->along[i] * s->s : k->vz[i],
                                          .segment = k->segment[i] - 1,
                                          .on_ground = !((k->after_hit | k->landing_unknown) & bit)},
                               .flies = !at_contact,
                               .landing_unknown = (k->after_hit | k->landing_unknown) & bit,
                               .rolled = rolling,
                               .along = k->along[i],
                               .l = {.t = k->t[i], .x = k->to_x[i], .z = k->to_z[i], .segment = to, .off_slope = off_slope}};
}

/* Load the next rock, at its first contact. */
static void refill(struct lanes *k, size_t i)
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
        bool is_shared = k->shared_start;
        if (is_shared || ceduo_walk_start(w, &k->start, &end)) {
            load_state(k, i, &k->start);
            k->radius[i] = w->rock.radius;
            k->k[i] = w->k;
            k->mass[i] = w->rock.mass;
            k->moment[i] = w->rock.moment;
            k->number[i] = w->number;
            k->section.wide[i] = w->section.wide;
            k->section.high[i] = w->section.high;
            k->section.reach[i] = w->section.reach;
            k->section.gyration[i] = w->section.gyration;
            k->need_draws |= bit;
            k->shared_start = is_shared || (job->identical && w->next_x == mark);
            return;
        }
        job->ended(job->context, i, end);
    }
    /* An idle lane is computed like any other lane; its results are ignored. */
    k->exhausted = true;
    k->live &= ~bit;
    k->stem_unknown &= ~bit;
    k->segment[i] = k->to[i] = 1;
    k->next_x[i] = k->stem_ahead[i] = INFINITY;
    k->stem_behind[i] = -INFINITY;
    k->contacts[i] = 0;
    k->pause[i] = INT64_MAX;
}

static void finish(struct lanes *k, size_t i, enum ceduo_end end)
{
    k->job->ended(k->job->context, i, end);
    refill(k, i);
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

/* End a flight at (x, z). */
NOINLINE void end_lane(struct lanes *k, size_t i, double x, double z, enum ceduo_end end)
{
    struct walker *w = &k->job->walkers[i];
    w->contacts = k->contacts[i];
    save_stems(k, i);
    w->flight.x = x;
    w->flight.z = z;
    finish(k, i, end);
}

/* Report the marks that a flight passes up to x, which it reaches after t. */
FORCE_INLINE void pass_marks(struct lanes *k, size_t i, const struct flight *flight, double x, double t, double spin)
{
    struct walker *w = &k->job->walkers[i];
    w->spin = spin;
    save_stems(k, i);
    ceduo_walk_pass_marks(w, *flight, x, t);
    k->next_x[i] = w->next_x;
    k->pause[i] = w->pause;
}

/* Report the marks that a flight passes before its landing. */
NOINLINE void pass_marks_scalar(struct lanes *k, size_t i)
{
    struct flight flight = {.x = k->x[i], .z = k->z[i], .vx = k->vx[i], .vz = k->vz[i]};
    pass_marks(k, i, &flight, k->to_x[i], k->t[i], k->spin[i]);
}

/* Continue after a contact, if the rock rolls or flies vertically, or if the search for its landing is long. */
NOINLINE void depart_scalar(struct lanes *k, size_t i, bool landing_known)
{
    struct walker *w = &k->job->walkers[i];
    struct rock_state c = save_lane(k, i);
    unsigned bit = 1u << i;
    uint64_t contacts = w->contacts;
    enum ceduo_end end;
    c.off = k->off[i];
    bool rolling = ceduo_walk_rolls(w, &c, landing_known);
    if (!rolling && landing_known) /* as in the lane */
        return;
    const struct rolling before = {k->before_contact.along[i], k->before_contact.spin[i]};
    if (rolling && !ceduo_walk_roll(w, &c, k->rolled & bit ? &before : NULL, &end)) {
        finish(k, i, end);
        return;
    }
    load_state(k, i, &c);
    if (w->contacts != contacts)
        load_draws(k, i);
    k->off_slope &= ~bit;
    if (c.flies) {
        k->off_slope |= c.l.off_slope ? bit : 0;
    } else {
        k->at_contact |= bit;
        k->rolling |= bit;
    }
}

#endif
