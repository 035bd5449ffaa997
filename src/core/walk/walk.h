/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WALK_H
#define CEDUO_WALK_H

#include <math.h>
#include <stdatomic.h>
#include <stdint.h>

#include "base/elementary.h"
#include "base/random.h"
#include "ceduo/trajectory.h"
#include "core/wood/stems.h"
#include "flight.h"
#include "prepared.h"

/* The section in which a rock meets the ground under the law arm: an ellipse whose half-axes are one of the three pairs of
 * the rock's, so scaled that their mean over the pairs is R. */
struct section {
    double wide, high; /* squares of the half-axes over that of the radius of gyration: together 5 */
    double reach;      /* R over the radius of gyration */
    double gyration;   /* m */
};

/* That of pair 0, 1 or 2. */
static inline struct section section_of(const struct ceduo_rock *rock, int pair)
{
    const double *axes = rock->axes;
    double a = axes[pair], b = axes[(pair + 1) % 3], longer = a < b ? b : a;
    double mean = (axes[0] + axes[1] + axes[2]) / 3, size = longer / mean * rock->radius;
    double a2 = (a / longer) * (a / longer), b2 = (b / longer) * (b / longer), sum = a2 + b2;
    double gyration = size * sqrt(sum / 5);
    return (struct section){.wide = 5 * a2 / sum, .high = 5 * b2 / sum, .reach = rock->radius / gyration, .gyration = gyration};
}

/* One rock on its trajectory. */
struct walker {
    const struct ground *g;
    const struct marks *marks;
    uint64_t seed, number;
    bool scale_rn, friction_bound;
    struct ceduo_rock rock;
    double k;         /* 0 where the law knows no spin */
    bool has_section; /* under the law arm */
    struct section section;
    double rn_u, rt_u;           /* quantiles of this rock's ground */
    double theta[ROUGHNESS_MAX]; /* largest facet angle of this rock on each roughness of the ground */
    struct flight at;            /* where it is now */
    double along;                /* after a roll: speed along the segment */
    double spin;
    uint64_t contacts;
    uint64_t pause;       /* contacts after which to look up: at the most, or whether to stop */
    uint64_t stems_pause; /* the same, of the effort spent on stems */
    size_t next_mark;
    double next_x;                  /* of that mark, infinite behind the last */
    struct stems *stems;            /* NULL: no forest */
    double stem_ahead, stem_behind; /* x of the next stem in either direction; infinite: none */
    uint64_t stems_hit, stools_met;
    struct contact_draws {
        uint64_t of;
        struct random_pair pair; /* of contacts 2 of and 2 of + 1 */
    } facets, turns;             /* turns: of the section */
    /* at a control */
    void (*cross)(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *crossing);
    const struct ceduo_trajectory_callbacks *watch; /* NULL: nobody looks */
    void *context;                                  /* of cross */
    bool arrivals_only;        /* nothing is asked behind the last mark: it stops soon after, CEDUO_UNFINISHED */
    const atomic_bool *cancel; /* looked at now and then on long trajectories; may be NULL */
    bool cancelled;            /* it was raised, or memory ran out: the trajectory is not at its end */
    bool gives_up;             /* among stems: cancelled, or there were too many */
};

/* Where a rock stands between two contacts: in flight to `l`, or on the ground at its next contact. */
struct course {
    struct flight at;
    bool flies;
    bool aloft;        /* and `l` is not known yet, behind a stem */
    bool rolled;       /* on the ground: it rolled to here, with speed `along` */
    double along, off; /* velocity, on the ground */
    struct landing l;  /* in flight */
};

/* ---- what is next ---- */

static inline bool is_behind_marks(const struct walker *w)
{
    return w->next_mark == w->marks->n;
}

static inline void set_next_x(struct walker *w)
{
    w->next_x = is_behind_marks(w) ? INFINITY : w->marks->at[w->next_mark].x;
    if (w->arrivals_only && is_behind_marks(w))
        w->pause = 0;
}

/* ---- the walk ---- */

/* Draws rock number `number` of the scene and puts it at its release. walker.stems and those who look on are the
 * caller's to set before. */
enum ceduo_status ceduo_walk_release(struct walker *w, const struct prepared *ready, uint64_t number);

/* Whether all rocks of a scene without forest start alike; another such rock, from one at its release and a walker that
 * was released before. */
bool ceduo_walk_is_equal(const struct prepared *ready);
void ceduo_walk_release_again(struct walker *w, const struct walker *first, uint64_t number);

/* Follows it to its end. */
enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law);

/* ---- the trajectory in pieces, for the walk of lanes ---- */

/* From the release to the first contact. All of these return false where the trajectory ended before, at w->at. */
bool ceduo_walk_start(struct walker *w, struct course *c, enum ceduo_end *end);

/* Notes the marks that a flight passes up to x, where it lands after t. */
void ceduo_walk_pass_marks(struct walker *w, struct flight at, double x, double t);

/* Takes the next stem ahead. False where the rock is not to be followed further; there, and if it is hit, the marks up to it are
 * passed by the flight that leads there in t. */
bool ceduo_walk_hit_stem(struct walker *w, bool hit, struct flight at, double t);

/* To the next contact. */
bool ceduo_walk_land(struct walker *w, struct course *c, enum ceduo_end *end);

/* Whether a rock rolls behind a contact, which leaves it with velocity v; else it flies to l, which may be known. */
bool ceduo_walk_rolls(const struct walker *w, struct course *c, bool knows_landing);

/* Roll on from such a contact, into flight or to the next contact. `before`: the motion that a rock keeps which rolled to
 * the contact; NULL: the contact was an impact. */
struct rolling {
    double along, spin; /* m/s, rad/s */
};
bool ceduo_walk_roll(struct walker *w, struct course *c, const struct rolling *before, enum ceduo_end *end);

/* From between two contacts to the end. */
enum ceduo_end ceduo_walk_continue(struct walker *w, const struct course *c, enum ceduo_law law);

/* The ground of a segment as this rock meets it. */
void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle);

#endif
