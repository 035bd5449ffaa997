/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WALK_H
#define CEDUO_WALK_H

#include <stdatomic.h>
#include <stdint.h>

#include "ceduo/way.h"
#include "landing.h"
#include "marks.h"
#include "random.h"
#include "sincos.h"
#include "stems.h"

/* One rock under way. */
struct walker {
    const struct ground *g;
    const struct marks *marks;
    uint64_t seed, number;
    bool scale_rn;
    struct ceduo_rock rock;
    double k; /* 0 where the law knows no spin */
    double rn_u, rt_u; /* quantiles of this rock's ground */
    struct flight at; /* where it is now */
    double along;     /* after a roll: speed along the segment */
    double spin;
    uint64_t contacts;
    uint64_t pause;   /* contacts after which to look up: at the most, or whether to stop */
    uint64_t stems_pause; /* the same, of the effort spent on stems */
    size_t next_mark;
    double next_x;    /* of that mark, infinite behind the last */
    struct stems *stems;       /* NULL: no forest */
    double stem_ahead, stem_behind; /* x of the next stem either way; infinite: none */
    uint64_t stems_hit, stools_met;
    uint64_t facets_of;        /* i, of */
    struct random_pair facets; /* the draws of contacts 2i and 2i + 1 */
    void (*cross)(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *crossing);
    const struct ceduo_watch *watch; /* NULL: nobody looks */
    void *context;                   /* of cross */
    bool arrivals_only;        /* behind the last mark nobody asks on: the way ends soon after it, CEDUO_UNFINISHED */
    const atomic_bool *cancel; /* looked at now and then on long ways; may be NULL */
    bool cancelled;            /* it was raised, or memory ran out: the way is not at its end */
    bool gives_up;             /* among stems: cancelled, or there were too many */
};

/* Draws rock number `number` of the scene and puts it at its release. walker.stems and those who look on are the
 * caller's to set before. */
enum ceduo_status ceduo_walk_release(struct walker *w, const struct ceduo_scene *scene, const struct ground *g,
                                     const struct marks *marks, const struct ceduo_rock *mean, uint64_t number);

/* Whether all rocks of a scene without forest start alike; another such rock, from one at its release and a walker that
 * was released before. */
bool ceduo_walk_alike(const struct ceduo_scene *scene, const struct ground *g);
void ceduo_walk_release_again(struct walker *w, const struct walker *first, uint64_t number);

/* Follows it to its end. */
enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law);

/* ---- the way in pieces, for the wide walk ---- */

/* Velocity in the axes of the segment under the rock. */
struct velocity {
    double along, off;
};

/* Where a rock stands between two contacts: in flight to `l`, or on the ground at its next contact. */
struct course {
    struct flight at;
    bool flies;
    struct velocity v; /* on the ground */
    struct landing l;  /* in flight */
};

/* From the release to the first contact. In all of these false: the way ended before, at w->at. */
bool ceduo_walk_start(struct walker *w, struct course *c, enum ceduo_end *end);

/* Notes the marks that a flight passes up to x, where it lands after t. */
void ceduo_walk_pass_marks(struct walker *w, struct flight at, double x, double t);

/* To the next contact. */
bool ceduo_walk_come_down(struct walker *w, struct course *c, enum ceduo_end *end);

/* From behind a contact, which leaves the rock with velocity v, into flight or to the next contact. */
bool ceduo_walk_go_off(struct walker *w, struct course *c, enum ceduo_end *end);

/* From between two contacts to the end. */
enum ceduo_end ceduo_walk_on(struct walker *w, const struct course *c, enum ceduo_law law);

/* The ground of a segment as this rock meets it. */
void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle);

#endif
