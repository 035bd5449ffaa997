/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preparation of a slope. Vertices on one line with the same ground are merged. Then chunks of 2^GROUND_BITS segments, and
 * chunks of chunks, get an upper bound of the rise of the ground above their chord, so that a long flight can skip a whole
 * chunk. The ground owns its columns but points to the slope's segments. */
#include "ground.h"
#include "scene/slope.h"

#include <float.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"

#ifndef MARGIN
#define MARGIN 1e-10 /* of the slope's size; affects only speed */
#endif
#ifndef ON_LINE
#define ON_LINE (4 * DBL_EPSILON) /* of the slope's size: a vertex this near to a line is on it, apart from rounding */
#endif
#ifndef NO_BREAK
#define NO_BREAK 1e-7 /* rad; a smaller angle between segment and line costs a rolling rock less than rounding */
#endif

/* ---- merging vertices ---- */

/* Slopes of lines from one vertex that pass all vertices so far within rounding, and turn from segments by at most NO_BREAK. */
struct lines {
    double lo, hi;
};

static void narrow(struct lines *l, double m, double margin)
{
    l->lo = fmax(l->lo, m - margin);
    l->hi = fmin(l->hi, m + margin);
}

/* Return the last vertex of the line that begins with segment j. All vertices between are on it, and all ground is the same. */
static size_t find_line_end(const struct ceduo_slope *slope, size_t j, double tolerance)
{
    const double *x = slope->x, *z = slope->z;
    struct lines l = {-INFINITY, INFINITY};
    size_t end = j + 1;
    for (; end + 1 < slope->vertices; end++) {
        double m = (z[end] - z[end - 1]) / (x[end] - x[end - 1]), next = (z[end + 1] - z[end]) / (x[end + 1] - x[end]);
        double turn = NO_BREAK * (1 + m * next); /* < 0 beyond a right angle */
        if (!(fabs(next - m) <= 2 * turn))       /* the usual exit on a rough profile */
            break;
        if (!ceduo_segment_same(&slope->segments[j], &slope->segments[end]))
            break;
        double dx = x[end] - x[j], dx_next = x[end + 1] - x[j], chord = (z[end + 1] - z[j]) / dx_next;
        narrow(&l, m, turn);
        narrow(&l, (z[end] - z[j]) / dx, tolerance * (1 + fmin(fabs(m), fabs(next))) / dx);
        if (!(chord >= l.lo && chord <= l.hi && fabs(chord - next) <= turn))
            break;
    }
    return end;
}

/* Set n, the vertices, and the source of each segment. */
static void keep_vertices(struct ground *g, const struct ceduo_slope *slope, double size)
{
    size_t n = 0, i = 0;
    while (i + 1 < slope->vertices) {
        g->x[n] = slope->x[i];
        g->vertices[n] = (struct ground_vertex){slope->x[i], slope->z[i]};
        g->source[n++] = &slope->segments[i];
        i = find_line_end(slope, i, ON_LINE * size);
    }
    g->x[n] = slope->x[i];
    g->vertices[n] = (struct ground_vertex){slope->x[i], slope->z[i]};
    g->n = n;
    g->vertices[-1] = (struct ground_vertex){g->vertices[0].x - 1, INFINITY};
    for (size_t k = 1; k <= GROUND_PADDING; k++)
        g->vertices[n + k] = (struct ground_vertex){g->vertices[n].x + 1, INFINITY};
}

/* ---- segments ---- */

static void prepare_segment(struct ground *g, size_t j, double radius)
{
    const struct ceduo_segment *from = g->source[j];
    struct ground_segment *to = &g->segments[j];
    double dx = g->vertices[j + 1].x - g->vertices[j].x, dz = g->vertices[j + 1].z - g->vertices[j].z;
    /* with a subnormal length c and s would not be a unit vector, and a contact would add energy */
    double shortest = DBL_MIN / DBL_EPSILON, scale = fabs(dx) < shortest && fabs(dz) < shortest ? 0x1p600 : 1;
    double length = ceduo_hypot(dx * scale, dz * scale);
    to->length = length / scale;
    to->c = dx * scale / length;
    to->s = dz * scale / length;
    to->friction = from->friction;
    to->mu = from->mu;
    to->rn = from->rn.mean;
    to->rt = from->rt.mean;
    if (j > 0 && ceduo_segment_same(from, g->source[j - 1]))
        to->theta = g->segments[j - 1].theta;
    else
        to->theta = roughness_angle((struct ground_roughness){from->roughness_m, from->roughness_rad}, radius);
    g->distance[j + 1] = g->distance[j] + to->length;
    g->rn_varies |= from->rn.spread > 0;
    g->rt_varies |= from->rt.spread > 0;
}

/* Index the roughnesses of a profile if rocks differ in radius, so that a rock computes each angle once. False without
 * memory. */
static bool number_roughnesses(struct ground *g)
{
    if (!g->theta_varies)
        return true;
    g->roughness_index = malloc(g->n);
    if (!g->roughness_index)
        return false;
    for (size_t j = 0; j < g->n; j++) {
        const struct ceduo_segment *s = g->source[j];
        size_t k = 0;
        while (k < g->roughness_count && g->roughness[k].height != s->roughness_m && g->roughness[k].angle != s->roughness_rad)
            k++;
        if (k == ROUGHNESS_MAX) {
            free(g->roughness_index);
            g->roughness_index = NULL;
            g->roughness_count = 0;
            return true;
        }
        if (k == g->roughness_count)
            g->roughness[g->roughness_count++] = (struct ground_roughness){s->roughness_m, s->roughness_rad};
        g->roughness_index[j] = (unsigned char)k;
    }
    return true;
}

/* ---- chunks ---- */

/* Build the chunks of each level from the chunks, or the vertices, of the level below. The rise is an upper bound. */
static bool build_levels(struct ground *g, double margin)
{
    for (int level = 1; level < GROUND_LEVELS && g->n >> (GROUND_BITS * level) >= 2; level++) { /* untaken: large */
        size_t chunks = g->n >> (GROUND_BITS * level);
        struct ground_chunk *to = calloc(chunks + 1 + GROUND_GROUP, sizeof *to);
        if (!to)
            return false;
        g->levels[level] = to;
        g->top = level;
        for (size_t i = 0; i <= chunks; i++) {
            size_t vertex = i << (GROUND_BITS * level);
            to[i] = (struct ground_chunk){.x = g->vertices[vertex].x, .z = g->vertices[vertex].z};
        }
        for (size_t i = 0; i < chunks; i++) {
            to[i].m = (to[i + 1].z - to[i].z) / (to[i + 1].x - to[i].x);
            for (size_t j = i << GROUND_BITS; j < (i + 1) << GROUND_BITS; j++) {
                const struct ground_chunk *chunk = &to[i], *child = level > 1 ? &g->levels[level - 1][j] : NULL;
                double x0 = child ? child[0].x : g->vertices[j].x, z0 = child ? child[0].z : g->vertices[j].z;
                double x1 = child ? child[1].x : g->vertices[j + 1].x, z1 = child ? child[1].z : g->vertices[j + 1].z;
                double above0 = z0 - (chunk->z + chunk->m * (x0 - chunk->x));
                double above1 = z1 - (chunk->z + chunk->m * (x1 - chunk->x));
                to[i].rise = max(chunk->rise, max(above0, above1) + (child ? child->rise : 0));
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
    struct ground_vertex *vertices = malloc((1 + slope->vertices + GROUND_PADDING) * sizeof *vertices);
    ground->vertices = vertices ? vertices + 1 : NULL;
    ground->x = malloc(slope->vertices * sizeof *ground->x);
    ground->source = malloc(slope->vertices * sizeof *ground->source);
    if (!ground->vertices || !ground->x || !ground->source)
        goto fail;
    keep_vertices(ground, slope, size);
    ground->distance = malloc((ground->n + 1) * sizeof(double));
    struct ground_segment *segments = aligned_alloc(sizeof *segments, (ground->n + 3) * sizeof *segments);
    ground->segments = segments ? &segments[1] : NULL;
    if (!ground->distance || !segments)
        goto fail;
    memset(segments, 0, sizeof *segments);
    memset(segments + ground->n + 1, 0, 2 * sizeof *segments);
    ground->distance[0] = 0;
    for (size_t j = 0; j < ground->n; j++) {
        prepare_segment(ground, j, radius);
        ground->theta_varies |= radius_varies && ground->source[j]->roughness_m > 0;
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
    if (ground->vertices)
        free(ground->vertices - 1);
    free(ground->x);
    free(ground->distance);
    if (ground->segments)
        free(ground->segments - 1);
    free(ground->source);
    free(ground->roughness_index);
    for (int l = 0; l < GROUND_LEVELS; l++)
        free(ground->levels[l]);
    memset(ground, 0, sizeof *ground);
}
