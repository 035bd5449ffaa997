/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GROUND_H
#define CEDUO_GROUND_H

#include <stdbool.h>
#include <stddef.h>

#include "base/real.h"
#include "ceduo/scene.h"

/* A slope prepared for many rocks. Vertices and segments are stored in pairs, as lanes look them up; a segment is a cache
 * line. */
struct ground_vertex {
    double x, z;
};

struct ground_segment {
    double length;       /* m */
    double theta;        /* largest facet angle, for the radius of the mean rock */
    double c, s;         /* unit tangent along +x; the normal upward is (-s, c) */
    double rn, rt;       /* means */
    double mu, friction; /* Coulomb friction; rolling friction */
};

#ifndef GROUND_BITS
#define GROUND_BITS 3 /* a chunk has 2^3 segments, a chunk of the next level 2^3 chunks; affects only speed */
#endif
#define GROUND_LEVELS  16
#define GROUND_GROUP   (GROUND_BITS > 3 ? 1 << GROUND_BITS : 8) /* number read at once, possibly beyond the end */
#define GROUND_PADDING (1 + GROUND_GROUP)

/* Some neighbouring segments: their first vertex, the slope of the chord to the first vertex of the next chunk, and the maximum
 * rise of the ground above this chord, with a margin for rounding. A parabola that is higher above the chord than `rise` at two
 * places touches no segment between. */
struct ground_chunk {
    double x, z, m, rise;
};

/* Roughness of a ground: a height, m, or an angle, rad. */
struct ground_roughness {
    double height, angle; /* one of them is NaN */
};
#define ROUGHNESS_MAX 16

/* Return the largest facet angle, rad, under a rock of this radius, m. */
FORCE_INLINE double roughness_angle(struct ground_roughness r, double radius)
{
    return isnan(r.height) ? r.angle : ceduo_atan(r.height / radius);
}

/* Neighbouring segments of the slope on one line with the same ground are one segment here, so indices differ. */
struct ground {
    size_t n; /* segments */
    struct ground_vertex
        *vertices;        /* n + 1, between 1 and GROUND_PADDING infinite walls; a flight over the profile's end strikes one */
    double *x, *distance; /* n + 1; a copy of x for searches; metres along the ground from the first vertex */
    struct ground_segment *segments;     /* n, between 1 and 2 empty segments, which lanes beyond a wall read */
    const struct ceduo_segment **source; /* n: segments of the slope, for spreads and roughness heights */
    enum ceduo_facets facets;
    bool rn_varies, rt_varies, theta_varies; /* between rocks */
    size_t roughness_count;                  /* of the profile; 0: theta does not vary, or more than ROUGHNESS_MAX */
    struct ground_roughness roughness[ROUGHNESS_MAX];
    unsigned char *roughness_index; /* n: roughness of each segment; NULL if roughness_count is 0 */
    double gravity, half_g;
    int top; /* top level; level l >= 1 has only complete chunks of 2^(GROUND_BITS l) segments; 0: none */
    struct ground_chunk *levels[GROUND_LEVELS];
};

/* Build the ground of a checked slope, for the radius of the mean rock. False without memory. */
bool ceduo_ground_init(struct ground *ground, const struct ceduo_slope *slope, double gravity, double radius,
                       bool radius_varies);
void ceduo_ground_release(struct ground *ground);

/* Return the segment that contains x, the right-hand one at a vertex. */
size_t ceduo_ground_segment(const struct ground *ground, double x);

/* Return the slope dz/dx of segment j. */
FORCE_INLINE double ground_slope(const struct ground *g, size_t j)
{
    return (g->vertices[j + 1].z - g->vertices[j].z) / (g->vertices[j + 1].x - g->vertices[j].x);
}

/* Return the height of the ground at x on segment j. */
FORCE_INLINE double ground_height(const struct ground *g, size_t j, double x)
{
    if (x >= g->vertices[j + 1].x)
        return g->vertices[j + 1].z;
    return g->vertices[j].z + ground_slope(g, j) * (x - g->vertices[j].x);
}

/* Return the metres along segment j to x, from its first vertex: exactly 0 or its length at a vertex. */
FORCE_INLINE double ground_along(const struct ground *g, size_t j, double x)
{
    const struct ground_segment *s = &g->segments[j];
    double q = (x - g->vertices[j].x) / s->c;
    return x >= g->vertices[j + 1].x || q > s->length ? s->length : q; /* untaken: rounding */
}

/* Return the point of segment j at q metres along it. */
FORCE_INLINE struct ground_vertex ground_place(const struct ground *g, size_t j, double q)
{
    const struct ground_segment *s = &g->segments[j];
    if (q >= s->length)
        return g->vertices[j + 1];
    return (struct ground_vertex){g->vertices[j].x + s->c * q, g->vertices[j].z + s->s * q};
}

/* Return the metres along the ground between q on segment j and r on segment k. */
FORCE_INLINE double ground_between(const struct ground *g, size_t j, double q, size_t k, double r)
{
    if (j == k)
        return fabs(r - q);
    double up_to_j = j < k ? g->segments[j].length - q : q, from_k = j < k ? r : g->segments[k].length - r;
    return up_to_j + (j < k ? g->distance[k] - g->distance[j + 1] : g->distance[j] - g->distance[k + 1]) + from_k;
}

#endif
