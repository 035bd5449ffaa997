/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ground.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MARGIN 1e-10 /* of the slope's size; only speed depends on it */

static void prepare_segment(struct ground *g, size_t j, double radius)
{
    const struct ceduo_segment *from = &g->slope->segments[j];
    struct ground_segment *to = &g->segments[j];
    double dx = g->x[j + 1] - g->x[j], dz = g->z[j + 1] - g->z[j];
    double length = hypot(dx, dz);
    to->m = dz / dx;
    to->c = dx / length;
    to->s = dz / length;
    to->mu = from->friction;
    to->rn = from->rn.mean;
    to->rt = from->rt.mean;
    to->theta = isnan(from->roughness_m) ? from->roughness_rad : atan(from->roughness_m / radius);
    to->steep = fabs(to->m) > 1;
    g->along[j + 1] = g->along[j] + length;
    g->rn_varies |= from->rn.spread > 0;
    g->rt_varies |= from->rt.spread > 0;
}

static double size_of(const struct ground *g)
{
    double size = 0;
    for (size_t i = 0; i <= g->n; i++)
        size = fmax(size, fmax(fabs(g->x[i]), fabs(g->z[i])));
    return size;
}

/* How high the vertices of segments [a, b) rise above the chord from a to b. */
static double rise_above_chord(const struct ground *g, size_t a, size_t b)
{
    double m = (g->z[b] - g->z[a]) / (g->x[b] - g->x[a]);
    double rise = 0;
    for (size_t i = a + 1; i < b; i++)
        rise = fmax(rise, g->z[i] - (g->z[a] + m * (g->x[i] - g->x[a])));
    return rise;
}

static bool build_levels(struct ground *g)
{
    double margin = MARGIN * size_of(g);
    size_t span = GROUND_BLOCK;
    for (int level = 1; level < GROUND_LEVELS && 2 * span <= g->n; level++, span *= GROUND_BLOCK) {
        size_t blocks = g->n / span;
        g->levels[level] = malloc(blocks * sizeof(double));
        if (!g->levels[level])
            return false;
        for (size_t i = 0; i < blocks; i++)
            g->levels[level][i] = rise_above_chord(g, i * span, (i + 1) * span) + margin;
        g->top = level;
    }
    return true;
}

bool ceduo_ground_init(struct ground *ground, const struct ceduo_slope *slope, double gravity, double radius,
                       bool radius_varies)
{
    memset(ground, 0, sizeof *ground);
    size_t n = slope->vertices - 1;
    ground->n = n;
    ground->slope = slope;
    ground->facets = slope->facets;
    ground->gravity = gravity;
    ground->half_g = gravity / 2;
    ground->x = malloc((n + 1) * sizeof(double));
    ground->z = malloc((n + 1) * sizeof(double));
    ground->along = malloc((n + 1) * sizeof(double));
    ground->segments = calloc(n, sizeof *ground->segments);
    if (!ground->x || !ground->z || !ground->along || !ground->segments)
        goto fail;
    memcpy(ground->x, slope->x, (n + 1) * sizeof(double));
    memcpy(ground->z, slope->z, (n + 1) * sizeof(double));
    ground->along[0] = 0;
    for (size_t j = 0; j < n; j++) {
        prepare_segment(ground, j, radius);
        ground->theta_varies |= radius_varies && slope->segments[j].roughness_m > 0;
    }
    if (build_levels(ground))
        return true;
fail:
    ceduo_ground_release(ground);
    return false;
}

void ceduo_ground_release(struct ground *ground)
{
    free(ground->x);
    free(ground->z);
    free(ground->along);
    free(ground->segments);
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
    double before = ground_length(&g->segments[j], x0, z0, g->x[j + 1], g->z[j + 1]);
    double after = ground_length(&g->segments[k], g->x[k], g->z[k], x1, z1);
    return before + (g->along[k] - g->along[j + 1]) + after;
}
