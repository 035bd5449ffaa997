/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GROUND_H
#define CEDUO_GROUND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/real.h"
#include "ceduo/slope.h"

/* A slope made ready for many rocks: what the walk needs at each vertex and segment, in pairs as lanes look them
 * up, a segment in one line of the cache. */
struct ground_vertex {
    double x, z;
};

struct ground_segment {
    double m;            /* dz/dx */
    double theta;        /* largest facet angle, for the radius of the mean rock */
    double c, s;         /* unit tangent along +x; the normal upward is (-s, c) */
    double rn, rt;       /* means */
    double mu, friction; /* Coulomb's; of a rolling rock */
};

#ifndef GROUND_BITS
#define GROUND_BITS 3 /* 2^3 segments are a block, 2^3 blocks one of the next level; only speed depends on it */
#endif
#define GROUND_LEVELS 16
#define GROUND_GROUP  (GROUND_BITS > 3 ? 1 << GROUND_BITS : 8) /* so many are read at once, be they there or not */
#define GROUND_BEHIND (1 + GROUND_GROUP)

/* Some neighbouring segments: their first vertex, the slope of the chord to the first of the next block, and how high
 * the ground rises above that chord, with a margin for rounding. A parabola that is as high above the chord at two places
 * touches no segment between. */
struct ground_block {
    double x, z, m, rise;
};

/* The roughness of a ground: a height, m, or an angle. */
struct ground_roughness {
    double height, angle; /* one of them is NaN */
};
#define ROUGHNESS_MAX 16

/* The largest facet angle under a rock of this radius, m. */
FORCE_INLINE double roughness_angle(struct ground_roughness r, double radius)
{
    return isnan(r.height) ? r.angle : ceduo_atan(r.height / radius);
}

/* Neighbours on one line with the same ground are one segment here, so its numbers are not those of the slope. */
struct ground {
    size_t n;                 /* segments */
    struct ground_vertex *at; /* n + 1; with one before and GROUND_BEHIND behind: walls without top, so that a flight over
                               * the profile's end is one that strikes a wall */
    double *x, *along;        /* n + 1; x once more, for searches; along: metres of ground from the first vertex */
    struct ground_segment *segments;    /* n; with an empty one before and two behind, which lanes beyond a wall read */
    const struct ceduo_segment **given; /* n: the slope's, for spreads and roughness heights */
    enum ceduo_facets facets;
    bool rn_varies, rt_varies, theta_varies; /* from rock to rock */
    size_t roughness_count; /* of the profile; 0: theta does not vary, or there are more than the array holds */
    struct ground_roughness roughness[ROUGHNESS_MAX];
    unsigned char *rough; /* n: the roughness of each segment; NULL if there is no count */
    double gravity, half_g;
    int top; /* level; level l has blocks of 2^(GROUND_BITS l) segments, from 1 on, and only whole ones */
    struct ground_block *levels[GROUND_LEVELS];
};

/* Builds `ground` for a checked slope; radius of the mean rock; whether radii differ. False without memory. */
bool ceduo_ground_init(struct ground *ground, const struct ceduo_slope *slope, double gravity, double radius,
                       bool radius_varies);
void ceduo_ground_release(struct ground *ground);

/* The segment that x lies on, the right-hand one at a vertex. */
size_t ceduo_ground_segment(const struct ground *ground, double x);

/* Whether z tells better than x where a point lies. */
FORCE_INLINE bool ground_is_steep(const struct ground_segment *s)
{
    return s->m > 1 || s->m < -1;
}

/* Height of the ground at x on segment j. */
FORCE_INLINE double ground_height(const struct ground *g, size_t j, double x)
{
    if (x >= g->at[j + 1].x)
        return g->at[j + 1].z;
    return g->at[j].z + g->segments[j].m * (x - g->at[j].x);
}

/* Metres of ground between two points of one segment. */
FORCE_INLINE double ground_length(const struct ground_segment *s, double x0, double z0, double x1, double z1)
{
    double d = ground_is_steep(s) ? (z1 - z0) / s->s : (x1 - x0) / s->c;
    return d < 0 ? -d : d;
}

/* Metres of ground between a point on segment j and one on segment k. */
double ceduo_ground_between(const struct ground *g, size_t j, double x0, double z0, size_t k, double x1, double z1);

#endif
