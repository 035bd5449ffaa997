/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slope, prepared. Vertices on one line with the same ground are merged; then blocks of 2^GROUND_BITS segments, and
 * blocks of those, each get a bound of how far the ground rises above their chord, so that a long flight passes a whole block
 * at once. The ground owns its columns but points to the slope's segments. */
#include "ground.h"

#include <float.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"

#ifndef MARGIN
#define MARGIN 1e-10 /* of the slope's size; only speed depends on it */
#endif
#ifndef ON_LINE
#define ON_LINE (4 * DBL_EPSILON) /* of the slope's size: a vertex this near to a line is on it but for rounding */
#endif
#ifndef NO_BREAK
#define NO_BREAK 1e-7 /* rad; a segment turned no further from the line costs a rolling rock nothing that a double shows */
#endif

/* ---- vertices that matter ---- */

/* Lines from one vertex: steepest and gentlest that pass as near to all vertices so far as rounding allows, and likewise
 * the slopes that no segment so far is turned from. */
struct lines {
    double lo, hi;
};

static void narrow(struct lines *l, double m, double by)
{
    l->lo = fmax(l->lo, m - by);
    l->hi = fmin(l->hi, m + by);
}

/* The last vertex of the line that segment j begins: all vertices on the way are on it, and all ground is alike. */
static size_t end_of_line(const struct ceduo_slope *slope, size_t j, double near)
{
    const double *x = slope->x, *z = slope->z;
    struct lines l = {-INFINITY, INFINITY};
    size_t end = j + 1;
    for (; end + 1 < slope->vertices; end++) {
        double m = (z[end] - z[end - 1]) / (x[end] - x[end - 1]), next = (z[end + 1] - z[end]) / (x[end + 1] - x[end]);
        double turn = NO_BREAK * (1 + m * next); /* less than 0 beyond a right angle */
        if (!(fabs(next - m) <= 2 * turn))       /* by far the most of a rough profile */
            break;
        if (!ceduo_segment_same(&slope->segments[j], &slope->segments[end]))
            break;
        double dx = x[end] - x[j], far = x[end + 1] - x[j], chord = (z[end + 1] - z[j]) / far;
        narrow(&l, m, turn);
        narrow(&l, (z[end] - z[j]) / dx, near * (1 + fmin(fabs(m), fabs(next))) / dx);
        if (!(chord >= l.lo && chord <= l.hi && fabs(chord - next) <= turn))
            break;
    }
    return end;
}

/* Sets n and the vertices, and what ground each segment is given. */
static void keep_vertices(struct ground *g, const struct ceduo_slope *slope, double size)
{
    size_t n = 0, i = 0;
    while (i + 1 < slope->vertices) {
        g->x[n] = slope->x[i];
        g->at[n] = (struct ground_vertex){slope->x[i], slope->z[i]};
        g->given[n++] = &slope->segments[i];
        i = end_of_line(slope, i, ON_LINE * size);
    }
    g->x[n] = slope->x[i];
    g->at[n] = (struct ground_vertex){slope->x[i], slope->z[i]};
    g->n = n;
    g->at[-1] = (struct ground_vertex){g->at[0].x - 1, INFINITY};
    for (size_t behind = 1; behind <= GROUND_BEHIND; behind++)
        g->at[n + behind] = (struct ground_vertex){g->at[n].x + 1, INFINITY};
}

/* ---- segments ---- */

static void prepare_segment(struct ground *g, size_t j, double radius)
{
    const struct ceduo_segment *from = g->given[j];
    struct ground_segment *to = &g->segments[j];
    double dx = g->at[j + 1].x - g->at[j].x, dz = g->at[j + 1].z - g->at[j].z;
    /* a length of few bits would make c and s longer than 1 together, and a contact would give energy */
    double shortest = DBL_MIN / DBL_EPSILON, scale = fabs(dx) < shortest && fabs(dz) < shortest ? 0x1p600 : 1;
    double length = ceduo_length(dx * scale, dz * scale);
    to->m = dz / dx;
    to->c = dx * scale / length;
    to->s = dz * scale / length;
    to->friction = from->friction;
    to->mu = from->mu;
    to->rn = from->rn.mean;
    to->rt = from->rt.mean;
    if (j > 0 && ceduo_segment_same(from, g->given[j - 1]))
        to->theta = g->segments[j - 1].theta;
    else
        to->theta = roughness_angle((struct ground_roughness){from->roughness_m, from->roughness_rad}, radius);
    g->along[j + 1] = g->along[j] + length / scale;
    g->rn_varies |= from->rn.spread > 0;
    g->rt_varies |= from->rt.spread > 0;
}

/* Number the roughnesses of a profile where rocks differ in radius, so that each rock has the angle of each from its release on.
 * False without memory. */
static bool number_roughnesses(struct ground *g)
{
    if (!g->theta_varies)
        return true;
    g->rough = malloc(g->n);
    if (!g->rough)
        return false;
    for (size_t j = 0; j < g->n; j++) {
        const struct ceduo_segment *s = g->given[j];
        size_t k = 0;
        while (k < g->roughness_count && g->roughness[k].height != s->roughness_m && g->roughness[k].angle != s->roughness_rad)
            k++;
        if (k == ROUGHNESS_MAX) {
            free(g->rough);
            g->rough = NULL;
            g->roughness_count = 0;
            return true;
        }
        if (k == g->roughness_count)
            g->roughness[g->roughness_count++] = (struct ground_roughness){s->roughness_m, s->roughness_rad};
        g->rough[j] = (unsigned char)k;
    }
    return true;
}

/* ---- blocks ---- */

/* The blocks of each level from the blocks, or the vertices, of the level below: no more than a bound of what rises. */
static bool build_levels(struct ground *g, double margin)
{
    for (int level = 1; level < GROUND_LEVELS && g->n >> (GROUND_BITS * level) >= 2; level++) { /* untaken: large */
        size_t blocks = g->n >> (GROUND_BITS * level);
        struct ground_block *to = calloc(blocks + 1 + GROUND_GROUP, sizeof *to);
        if (!to)
            return false;
        g->levels[level] = to;
        g->top = level;
        for (size_t i = 0; i <= blocks; i++) {
            size_t vertex = i << (GROUND_BITS * level);
            to[i] = (struct ground_block){.x = g->at[vertex].x, .z = g->at[vertex].z};
        }
        for (size_t i = 0; i < blocks; i++) {
            to[i].m = (to[i + 1].z - to[i].z) / (to[i + 1].x - to[i].x);
            for (size_t j = i << GROUND_BITS; j < (i + 1) << GROUND_BITS; j++) {
                const struct ground_block *block = &to[i], *below = level > 1 ? &g->levels[level - 1][j] : NULL;
                double x0 = below ? below[0].x : g->at[j].x, z0 = below ? below[0].z : g->at[j].z;
                double x1 = below ? below[1].x : g->at[j + 1].x, z1 = below ? below[1].z : g->at[j + 1].z;
                double above0 = z0 - (block->z + block->m * (x0 - block->x));
                double above1 = z1 - (block->z + block->m * (x1 - block->x));
                to[i].rise = max(block->rise, max(above0, above1) + (below ? below->rise : 0));
            }
            to[i].rise += margin;
        }
    }
    return true;
}

bool ceduo_ground_init(struct ground *ground, const struct ceduo_slope *slope, double gravity, double radius,
                       bool radius_varies)
{
    memset(ground, 0, sizeof *ground);
    ground->facets = slope->facets;
    ground->gravity = gravity;
    ground->half_g = gravity / 2;
    double size = 0;
    for (size_t i = 0; i < slope->vertices; i++)
        size = max(size, max(fabs(slope->x[i]), fabs(slope->z[i])));
    struct ground_vertex *vertices = malloc((1 + slope->vertices + GROUND_BEHIND) * sizeof *vertices);
    ground->at = vertices ? vertices + 1 : NULL;
    ground->x = malloc(slope->vertices * sizeof *ground->x);
    ground->given = malloc(slope->vertices * sizeof *ground->given);
    if (!ground->at || !ground->x || !ground->given)
        goto fail;
    keep_vertices(ground, slope, size);
    ground->along = malloc((ground->n + 1) * sizeof(double));
    struct ground_segment *segments = aligned_alloc(sizeof *segments, (ground->n + 3) * sizeof *segments);
    ground->segments = segments ? &segments[1] : NULL;
    if (!ground->along || !segments)
        goto fail;
    memset(segments, 0, sizeof *segments);
    memset(segments + ground->n + 1, 0, 2 * sizeof *segments);
    ground->along[0] = 0;
    for (size_t j = 0; j < ground->n; j++) {
        prepare_segment(ground, j, radius);
        ground->theta_varies |= radius_varies && ground->given[j]->roughness_m > 0;
    }
    if (number_roughnesses(ground) && build_levels(ground, MARGIN * size))
        return true;
fail:
    ceduo_ground_release(ground);
    return false;
}

size_t ceduo_ground_segment(const struct ground *ground, double x)
{
    return gsl_interp_bsearch(ground->x, x, 0, ground->n);
}

void ceduo_ground_release(struct ground *ground)
{
    if (ground->at)
        free(ground->at - 1);
    free(ground->x);
    free(ground->along);
    if (ground->segments)
        free(ground->segments - 1);
    free(ground->given);
    free(ground->rough);
    for (int l = 0; l < GROUND_LEVELS; l++)
        free(ground->levels[l]);
    memset(ground, 0, sizeof *ground);
}

double ceduo_ground_between(const struct ground *g, size_t j, double x0, double z0, size_t k, double x1, double z1)
{
    if (j == k)
        return ground_length(&g->segments[j], x0, z0, x1, z1);
    if (j > k)
        return ceduo_ground_between(g, k, x1, z1, j, x0, z0);
    double before = ground_length(&g->segments[j], x0, z0, g->at[j + 1].x, g->at[j + 1].z);
    double after = ground_length(&g->segments[k], g->at[k].x, g->at[k].z, x1, z1);
    return before + (g->along[k] - g->along[j + 1]) + after;
}
