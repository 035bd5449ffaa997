/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANES_H
#define CEDUO_LANES_H

#include "walk.h"

/* The walk of walk.h for several rocks at once, one per lane of wide registers, with the same bits for every rock. Rare events
 * (marks, rolling over vertices and past stems, far landings on long slopes) are done lane by lane by the scalar walk. */

/* Two numbers per vertex or segment i, at [i + 1 << shift]; see lookup_at(). */
#define TABLE_SMALL   16
#define SEGMENT_SHIFT 2 /* in a table of segments */
struct lanes_table {
    _Alignas(64) double first[TABLE_SMALL], second[TABLE_SMALL]; /* copy of a small table */
    const double (*pairs)[2];
};

/* The ground as tables. They point into struct ground. */
struct lanes_ground {
    struct lanes_table vertices;     /* x, z of a vertex */
    struct lanes_table lengths;      /* length, largest facet angle */
    struct lanes_table tangents;     /* c, s */
    struct lanes_table restitutions; /* rn, rt */
    struct lanes_table frictions;    /* mu, friction */
    bool small;                      /* all tables fit TABLE_SMALL */
    bool small_facets;               /* the largest facet angles are at most pi/4 */
};

/* Return the tables; NULL without memory. Caller frees them before the ground. */
struct lanes_ground *ceduo_lanes_ground_create(const struct ground *g);

/* Number of lanes: several registers, so that one is computed while another waits for data. */
#define LANES 32

/* A job of many rocks. They may end in another order than they began. */
struct lanes_job {
    const struct lanes_ground *ground;
    enum ceduo_law law;
    bool identical;                           /* the rocks differ only in their numbers */
    struct walker *walkers;                   /* one per lane, all of one run */
    bool (*next)(void *context, size_t lane); /* releases the next rock in the walker of this lane; false: none left */
    void (*ended)(void *context, size_t lane, enum ceduo_end end);
    void *context;
};

#endif
