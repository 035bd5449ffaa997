/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WALK_H
#define CEDUO_WALK_H

#include <math.h>
#include <stdatomic.h>
#include <stdint.h>

#include "base/elementary.h"
#include "base/random.h"
#include "core/forest/stems.h"
#include "flight.h"
#include "prepared.h"

/* Section of a rock that meets the ground under the arm law: an ellipse with one of the three pairs of half-axes of the rock,
 * scaled so that their mean over the pairs is R. */
struct section {
    double wide, high; /* squared half-axes over the squared radius of gyration; their sum is 5 */
    double reach;      /* R over the radius of gyration */
    double gyration;   /* m */
};

/* Return the section of pair 0, 1 or 2. */
static inline struct section make_section(const struct ceduo_rock *rock, int pair)
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
    const struct ceduo_release *release; /* release of this rock */
    bool scale_rn, friction_bound;
    struct ceduo_rock rock;
    double k;         /* 0 if the law has no spin */
    bool has_section; /* under the arm law */
    struct section section;
    double rn_u, rt_u;           /* quantiles of rn and rt for this rock */
    double theta[ROUGHNESS_MAX]; /* largest facet angle of this rock on each roughness of the ground */
    struct flight flight;        /* at the release, and at the end */
    bool on_ground;              /* released on the ground */
    struct contact contact;      /* during a roll */
    double spin;
    uint64_t contacts;
    uint64_t pause;       /* contact count at which limits and cancellation are checked next */
    uint64_t stems_pause; /* likewise, of stems->effort */
    size_t next_mark;
    double next_x;                  /* m, of this mark; infinite after the last */
    struct stems *stems;            /* NULL: no forest */
    double stem_ahead, stem_behind; /* x of the next stem in either direction; infinite: none */
    uint64_t stems_hit, stools_met;
    struct contact_draws {
        uint64_t index;
        struct random_pair pair; /* for contacts 2 index and 2 index + 1 */
    } facets, turns;             /* turns: orientation of the section */
    /* called at a control */
    void (*cross)(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *crossing);
    const struct ceduo_trajectory_callbacks *callbacks; /* may be NULL */
    void *context;                                      /* of cross */
    bool arrivals_only;                                 /* stop soon after the last mark, with CEDUO_END_UNFINISHED */
    const atomic_bool *cancel;                          /* checked regularly on long trajectories; may be NULL */
    bool cancelled;                                     /* cancelled or out of memory: the trajectory is incomplete */
    bool aborted;                                       /* among stems: cancelled, or too many stems */
};

/* State of a rock between two contacts: in flight to `l`, or on the ground at its next contact. */
struct rock_state {
    struct contact contact; /* on the ground */
    bool flies;
    bool landing_unknown; /* in flight after a stem, `l` is not set */
    bool rolled;          /* on the ground, reached by rolling */
    struct flight flight; /* in flight */
    struct landing l;     /* likewise */
};

/* ---- next mark ---- */

static inline bool is_behind_marks(const struct walker *w)
{
    return w->next_mark == w->marks->n;
}

static inline void set_next_x(struct walker *w)
{
    w->next_x = is_behind_marks(w) ? INFINITY : w->marks->items[w->next_mark].x;
    if (w->arrivals_only && is_behind_marks(w))
        w->pause = 0;
}

/* ---- the walk ---- */

/* Draw rock `number` of the scene and place it at its release. Caller sets stems and callbacks before. */
enum ceduo_status ceduo_walk_release(struct walker *w, const struct prepared_scene *prepared, uint64_t number);

/* True if all rocks of a scene without forest start identically. Then ceduo_walk_release_identical() releases another rock by
 * copying `first`, a walker at its release; `w` must have been released before. */
bool ceduo_walk_is_identical(const struct prepared_scene *prepared);
void ceduo_walk_release_identical(struct walker *w, const struct walker *first, uint64_t number);

/* Simulate a released rock to its end. */
enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law);

/* ---- steps of a trajectory, for the walk of lanes ---- */

/* Move from the release to the first contact. This and the next functions return false if the trajectory ends, at w->flight. */
bool ceduo_walk_start(struct walker *w, struct rock_state *c, enum ceduo_end *end);

/* Report the marks that a flight passes up to its landing, at x after t. */
void ceduo_walk_pass_marks(struct walker *w, const struct flight *flight, double x, double t);

/* Consume the next stem ahead, which the flight reaches after t. False if the trajectory is aborted. Then, or if the stem is
 * hit, the marks before it are passed. */
bool ceduo_walk_hit_stem(struct walker *w, bool hit, const struct flight *flight, double t);

/* Move to the next contact. */
bool ceduo_walk_land(struct walker *w, struct rock_state *c, enum ceduo_end *end);

/* True if a rock rolls after a contact; otherwise it flies, and the flight is set. */
bool ceduo_walk_rolls(const struct walker *w, struct rock_state *c);

/* Roll from such a contact, into flight or to the next contact. `before`: motion of a rock that rolled to the contact, which
 * continues; NULL: the contact was an impact. */
struct rolling {
    double along, spin; /* m/s, rad/s */
};
bool ceduo_walk_roll(struct walker *w, struct rock_state *c, const struct rolling *before, enum ceduo_end *end);

/* Continue from between two contacts to the end. */
enum ceduo_end ceduo_walk_continue(struct walker *w, const struct rock_state *c, enum ceduo_law law);

/* Set the ground of a segment for this rock. */
void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle);

#endif
