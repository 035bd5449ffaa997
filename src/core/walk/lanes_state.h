/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lanes: what each holds of its rock, and how the scalar walk does for one lane what happens
 * seldom. */
#ifndef CEDUO_LANES_LANE_H
#define CEDUO_LANES_LANE_H

#include <math.h>
#include <stddef.h>

#include "base/real.h"
#include "impact.h"
#include "lanes.h"

#define EACH_REGISTER(i) for (size_t i = 0; i < LANES; i += REAL_LANES)
#define ALL_LANES        ((unsigned)(((uint64_t)1 << LANES) - 1))

#ifdef LOOK_UP_16
#define LOOK_UP_WRAPS true /* a small table is looked up at i modulo 16, whatever i is */
#else
#define LOOK_UP_WRAPS false
#endif

/* The two numbers at i of a table for each lane; `small`: it has no more than 16. */
FORCE_INLINE void look_up(const struct lanes_table *table, ints i, bool small, real *first, real *second)
{
#ifdef LOOK_UP_16
    /* untaken 2: machine */
    if (small) { /* without going to memory lane by lane */
        *first = look_up_16(table->first, i);
        *second = look_up_16(table->second, i);
        return;
    }
#endif
    (void)small;
    uint64_t at[REAL_LANES];
    store_ints(at, i << table->shift);
    gather_pairs(table->pairs, at, first, second);
}

/* A chord in each lane. */
struct chords {
    double x0[LANES], z0[LANES], x1[LANES], z1[LANES], m[LANES];
};

FORCE_INLINE struct chord load_chord(const struct chords *from, size_t i)
{
    return (struct chord){load(&from->x0[i]), load(&from->z0[i]), load(&from->x1[i]), load(&from->z1[i]), load(&from->m[i])};
}

FORCE_INLINE void store_chord(struct chords *to, size_t i, struct chord on)
{
    store(&to->x0[i], on.x0);
    store(&to->z0[i], on.z0);
    store(&to->x1[i], on.x1);
    store(&to->z1[i], on.z1);
    store(&to->m[i], on.m);
}

FORCE_INLINE struct chord pick_chord(mask m, struct chord p, struct chord q)
{
    return (struct chord){blend(m, p.x0, q.x0), blend(m, p.z0, q.z0), blend(m, p.x1, q.x1), blend(m, p.z1, q.z1),
                          blend(m, p.m, q.m)};
}

/* What is known before the first step, so that the steps are compiled for it. */
struct form {
    const struct contact_law *law;
    bool small; /* the tables have 16 numbers */
    bool wood;  /* there are stems */
};

/* All rocks in the lanes, as they come round to the next contact. `segment` and `to` count from 1, as the tables of
 * struct lanes_ground do; 0 and n + 1 lie off the slope. */
struct lanes {
    const struct lanes_job *job;
    const struct lanes_ground *ground;
    const struct ground *g;
    uint64_t seed;
    bool far;    /* the ground has blocks */
    bool varies; /* the ground from rock to rock, */
    bool sized;  /* or only the largest facet angle, with the rock's radius */
    bool against, scale_rn, friction_bound;
    bool steep; /* so is the ground */

    _Alignas(64) double x[LANES], z[LANES], vx[LANES], vz[LANES], spin[LANES];
    uint64_t segment[LANES];
    /* the landing to come, with the ends, slope and largest facet angle of its segment */
    double t[LANES], to_x[LANES], to_z[LANES];
    uint64_t to[LANES];
    struct chords on;
    double theta[LANES];
    double along[LANES], off[LANES]; /* velocity on the segment, behind a contact */
    struct {
        double along[LANES], spin[LANES];
    } before;               /* velocity and spin before the contact, of lanes that rolled to it */
    double inv[LANES];      /* 1/vx */
    uint64_t vertex[LANES]; /* from 1; which the search for the landing has come to */
    double draw[3][LANES];  /* for the facets of the next contacts, */
    struct {
        double sine[LANES], cosine[LANES];
    } facet, turned;       /* of the facets, and of the sections */
    double turn[3][LANES]; /* and for how the sections are turned there */
    struct {
        double wide[LANES], high[LANES], reach[LANES], gyration[LANES];
    } section;
    double next_x[LANES], stem_ahead[LANES], stem_behind[LANES];
    struct {
        double height[LANES];           /* of the next ahead; */
        double cost[LANES];             /* energy that a hit of it takes: see struct hit */
        const struct stem *next[LANES]; /* NULL where it does not wait, or is not known */
        double after[LANES];            /* where the stem stands that waits behind it, which is next if that is */
        double sure[LANES];             /* before here */
        double around[LANES];           /* so far reach stools that stand around the release */
        double free_to[LANES];          /* before here the flight is above `tallest` */
        uint64_t *met[LANES];           /* of struct stems */
        uint64_t hit[LANES], stools_met[LANES];
    } stem; /* counts and `next` go back to the walker and its stems by show_stems_met() */
    double radius[LANES], k[LANES], mass[LANES], moment[LANES];
    double rn[LANES], rt[LANES]; /* where the ground varies */
    uint64_t contacts[LANES], pause[LANES], number[LANES];
    double tallest; /* m: all stems that may wait are less tall */

    /* bit i is lane i */
    unsigned live;   /* has a rock */
    unsigned there;  /* is at its next contact already, at to_x, to_z */
    unsigned rolls;  /* of these: with speed `along` on the ground, which vx, vz do not know yet */
    unsigned rolled; /* rolled to its last contact, and goes on as before if it still rolls */
    unsigned left;   /* lands off the slope */
    unsigned fresh;  /* has no draws yet */
    unsigned aloft;  /* behind a stem: where it lands is looked for now */
    unsigned waits;  /* among stems: it stays as it is while others land */
    unsigned lost;   /* of these: where it lands is not known */
    unsigned paused; /* what stands next is not known */
    bool empty;      /* no rock waits */
    bool same_start; /* every rock comes to its first contact as `start`, without passing a mark */
    struct course start;
};

_Static_assert(offsetof(struct lanes, contacts) % 64 == 0, "what is for lanes is loaded from whole lines of the cache");

/* Segments, and their largest facet angles. */
FORCE_INLINE struct chord look_up_chord(struct form form, const struct lanes *k, ints segment, real *theta)
{
    struct chord on;
    look_up(&k->ground->place, segment, form.small, &on.x0, &on.z0);
    look_up(&k->ground->place, segment + 1, form.small, &on.x1, &on.z1);
    look_up(&k->ground->slope, segment, form.small, &on.m, theta);
    return on;
}

/* Lanes that come to no contact in this step. */
FORCE_INLINE unsigned in_the_air(struct form form, const struct lanes *k)
{
    return form.wood ? k->aloft | k->waits : 0;
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

/* What a rock has met, and which stem comes next, as its lane knows it. */
static inline void show_stems_met(const struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    if (!w->stems)
        return;
    w->stems_hit = k->stem.hit[i];
    w->stools_met = k->stem.stools_met[i];
    if (!k->stem.next[i])
        return;
    struct stems_side *side = &w->stems->side[0];
    side->first = (size_t)(k->stem.next[i] - side->waiting);
    w->stem_ahead = side->next = k->stem_ahead[i];
}

/* The next stem ahead, if there is one. */
static void load_stem(struct lanes *k, size_t i)
{
    const struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    k->stem_ahead[i] = w->stem_ahead;
    k->paused &= ~bit;
    if (!w->stems)
        return;
    struct stems_side *side = &w->stems->side[0];
    k->stem.hit[i] = w->stems_hit;
    k->stem.stools_met[i] = w->stools_met;
    k->stem.met[i] = w->stems->met;
    k->stem.around[i] = w->stems->start + 2 * w->stems->wood->reach;
    k->stem.next[i] = NULL;
    k->stem.after[i] = k->stem.sure[i] = INFINITY;
    if (w->stem_ahead == INFINITY)
        return;
    if (!side->next_known) {
        k->paused |= bit;
        return;
    }
    k->stem.height[i] = ceduo_stems_next(side)->height;
    k->stem.cost[i] = ceduo_stems_next(side)->energy;
    if (side->next_waits) {
        side->waiting[side->end].along = INFINITY;
        k->stem.next[i] = &side->waiting[side->first];
        k->stem.after[i] = k->stem.next[i][1].along;
        k->stem.sure[i] = side->sure;
    }
}

/* A course, with what the walker knows of itself and the scalar walk may have changed. */
static void load_course(struct lanes *k, size_t i, const struct course *c)
{
    const struct lanes_ground *ground = k->ground;
    const struct walker *w = &k->job->walkers[i];
    k->spin[i] = w->spin;
    k->next_x[i] = w->next_x;
    k->stem_behind[i] = w->stem_behind;
    k->contacts[i] = w->contacts;
    k->pause[i] = w->pause;
    load_stem(k, i);
    k->x[i] = c->at.x;
    k->z[i] = c->at.z;
    k->vx[i] = c->at.vx;
    k->vz[i] = c->at.vz;
    k->segment[i] = c->at.segment + 1;
    k->t[i] = c->flies ? c->l.t : 0;
    k->to_x[i] = c->flies ? c->l.x : c->at.x;
    k->to_z[i] = c->flies ? c->l.z : c->at.z;
    k->along[i] = c->along;
    uint64_t j = c->flies ? c->l.segment + 1 : c->at.segment + 1;
    k->to[i] = j;
    k->on.x0[i] = ground->place.pairs[j][0];
    k->on.z0[i] = ground->place.pairs[j][1];
    k->on.x1[i] = ground->place.pairs[j + 1][0];
    k->on.z1[i] = ground->place.pairs[j + 1][1];
    const double *slope = ground->slope.pairs[j << ground->slope.shift];
    k->on.m[i] = slope[0];
    k->theta[i] = slope[1];
}

/* The walker brought up to date, and the lane's course. */
static struct course course_of(struct lanes *k, size_t i)
{
    struct walker *w = &k->job->walkers[i];
    unsigned bit = 1u << i;
    bool left = k->left & bit;
    size_t to = left ? (k->vx[i] < 0 ? 0 : w->g->n - 1) : k->to[i] - 1;
    w->spin = k->spin[i];
    w->contacts = k->contacts[i];
    show_stems_met(k, i);
    bool there = k->there & bit, rolls = k->rolls & bit;
    const struct ground_segment *s = &k->g->segments[k->segment[i] - 1];
    return (struct course){.at = {.x = there ? k->to_x[i] : k->x[i],
                                  .z = there ? k->to_z[i] : k->z[i],
                                  .vx = rolls ? k->along[i] * s->c : k->vx[i],
                                  .vz = rolls ? k->along[i] * s->s : k->vz[i],
                                  .segment = k->segment[i] - 1,
                                  .on_ground = !((k->aloft | k->lost) & bit)},
                           .flies = !there,
                           .aloft = (k->aloft | k->lost) & bit,
                           .rolled = rolls,
                           .along = k->along[i],
                           .l = {.t = k->t[i], .x = k->to_x[i], .z = k->to_z[i], .segment = to, .left = left}};
}

/* The next rock, at its first contact. */
static void refill(struct lanes *k, size_t i)
{
    const struct lanes_job *job = k->job;
    struct walker *w = &job->walkers[i];
    unsigned bit = 1u << i;
    k->left &= ~bit;
    k->rolls &= ~bit;
    k->there |= bit;
    while (job->next(job->context, i)) {
        enum ceduo_end end;
        double mark = w->next_x;
        bool known = k->same_start;
        if (known || ceduo_walk_start(w, &k->start, &end)) {
            load_course(k, i, &k->start);
            k->radius[i] = w->rock.radius;
            k->k[i] = w->k;
            k->mass[i] = w->rock.mass;
            k->moment[i] = w->rock.moment;
            k->number[i] = w->number;
            k->section.wide[i] = w->section.wide;
            k->section.high[i] = w->section.high;
            k->section.reach[i] = w->section.reach;
            k->section.gyration[i] = w->section.gyration;
            k->fresh |= bit;
            k->same_start = known || (job->alike && w->next_x == mark);
            return;
        }
        job->ended(job->context, i, end);
    }
    /* An idle lane is computed like the others; its results are ignored. */
    k->empty = true;
    k->live &= ~bit;
    k->paused &= ~bit;
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

/* ---- what happens seldom ---- */

/* A flight that comes to stems which are left to the scalar walk, or a rock of many contacts. */
NOINLINE void come_down_alone(struct lanes *k, size_t i)
{
    struct course c = course_of(k, i);
    unsigned bit = 1u << i;
    enum ceduo_end end;
    if (!ceduo_walk_come_down(&k->job->walkers[i], &c, &end)) {
        k->aloft &= ~bit;
        finish(k, i, end);
        return;
    }
    load_course(k, i, &c);
    k->there |= bit;
    k->aloft &= ~bit;
    k->left &= ~bit;
}

/* A flight that ends at (x, z). */
NOINLINE void end_alone(struct lanes *k, size_t i, double x, double z, enum ceduo_end end)
{
    struct walker *w = &k->job->walkers[i];
    w->contacts = k->contacts[i];
    show_stems_met(k, i);
    w->at.x = x;
    w->at.z = z;
    finish(k, i, end);
}

/* A flight passes marks up to x, which it reaches after t. */
FORCE_INLINE void pass_marks(struct lanes *k, size_t i, const struct flight *at, double x, double t, double spin)
{
    struct walker *w = &k->job->walkers[i];
    w->spin = spin;
    show_stems_met(k, i);
    ceduo_walk_pass_marks(w, *at, x, t);
    k->next_x[i] = w->next_x;
    k->pause[i] = w->pause;
}

/* A flight that passes marks and goes on in its lane. */
NOINLINE void pass_marks_alone(struct lanes *k, size_t i)
{
    struct flight at = {.x = k->x[i], .z = k->z[i], .vx = k->vx[i], .vz = k->vz[i]};
    pass_marks(k, i, &at, k->to_x[i], k->t[i], k->spin[i]);
}

/* Behind a contact: a rock that rolls or flies straight up, or where the search for its landing is long. */
NOINLINE void go_off_alone(struct lanes *k, size_t i, bool knows_landing)
{
    struct walker *w = &k->job->walkers[i];
    struct course c = course_of(k, i);
    unsigned bit = 1u << i;
    uint64_t contacts = w->contacts;
    enum ceduo_end end;
    c.off = k->off[i];
    bool rolls = ceduo_walk_rolls(w, &c, knows_landing);
    if (!rolls && knows_landing) /* as the lane has it */
        return;
    const struct rolling before = {k->before.along[i], k->before.spin[i]};
    if (rolls && !ceduo_walk_roll(w, &c, k->rolled & bit ? &before : NULL, &end)) {
        finish(k, i, end);
        return;
    }
    load_course(k, i, &c);
    if (w->contacts != contacts)
        load_draws(k, i);
    k->left &= ~bit;
    if (c.flies) {
        k->left |= c.l.left ? bit : 0;
    } else {
        k->there |= bit;
        k->rolls |= bit;
    }
}

#endif
