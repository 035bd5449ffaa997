/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANES_H
#define CEDUO_LANES_H

#include "ceduo/run.h"
#include "walk.h"

/* The walk of walk.h for some rocks at once, one in each lane of wide registers: the same bits for every rock. What
 * happens seldom (marks, rolling over vertices and past stems, far landings on long slopes) is done lane by lane by
 * the scalar walk. */

/* Two numbers for each vertex or segment i, at [i + 1 << shift]: look_up() of lanes.h. */
#define TABLE_SMALL 16
struct lanes_table {
    _Alignas(64) double first[TABLE_SMALL], second[TABLE_SMALL]; /* of a small table, once more */
    const double (*pairs)[2];
    int shift;
};

/* The ground in tables, which are read where it has them. */
struct lanes_ground {
    struct lanes_table place; /* x, z of a vertex */
    struct lanes_table slope; /* m, largest facet angle */
    struct lanes_table tilt;  /* c, s */
    struct lanes_table share; /* rn, rt */
    struct lanes_table grip;  /* mu, friction */
    bool steep;               /* some segments are steeper than 45 degrees */
    bool small;               /* all fit TABLE_SMALL */
};

/* To be freed before the ground is released; NULL without memory. */
struct lanes_ground *ceduo_lanes_ground_create(const struct ground *g);

/* So many rocks at once: more than a register holds, so that one works while another waits. */
#define LANES 32

/* Many rocks to be followed. They end in another order than they began. */
struct lanes_job {
    const struct lanes_ground *ground;
    enum ceduo_law law;
    bool alike;                               /* the rocks differ in nothing but their numbers */
    struct walker *walkers;                   /* one for each lane, all of one run */
    bool (*next)(void *context, size_t lane); /* releases the next rock into that lane's walker; false: none left */
    void (*ended)(void *context, size_t lane, enum ceduo_end end);
    void *context;
};

#endif
