/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "slope.h"

size_t ceduo_slope_segment(const struct ceduo_slope *slope, double x)
{
    return gsl_interp_bsearch(slope->x, x, 0, slope->vertices - 1);
}

double ceduo_slope_height(const struct ceduo_slope *slope, double x)
{
    size_t j = ceduo_slope_segment(slope, x);
    const double *px = slope->x, *pz = slope->z;
    if (x >= px[j + 1])
        return pz[j + 1];
    if (x <= px[j]) /* exact even if the segment is too short for its slope */
        return pz[j];
    return pz[j] + (pz[j + 1] - pz[j]) / (px[j + 1] - px[j]) * (x - px[j]);
}

double ceduo_slope_mirrored(const struct ceduo_slope *slope, double x)
{
    return slope->reversed ? 2 * slope->origin_x + slope->x[slope->vertices - 1] - x : x;
}

static double segment_fall(const struct ceduo_slope *s, size_t j)
{
    return (s->z[j] - s->z[j + 1]) / (s->x[j + 1] - s->x[j]);
}

double ceduo_slope_fall(const struct ceduo_slope *slope, double x)
{
    return segment_fall(slope, ceduo_slope_segment(slope, x));
}

double ceduo_slope_face(const struct ceduo_slope *slope)
{
    for (size_t j = 0; j + 1 < slope->vertices; j++)
        if (segment_fall(slope, j) > CEDUO_FACE_FALL)
            return slope->x[j];
    return NAN;
}

/* ---- topography ---- */

/* Return the end of the last face in (from, to]; NaN if there is none. */
static double find_foot(const struct ceduo_slope *s, double from, double to)
{
    double foot = NAN, length = 0; /* m, of the preceding steep segments */
    for (size_t j = 0; j + 1 < s->vertices && s->x[j + 1] <= to; j++) {
        double dx = s->x[j + 1] - s->x[j], dz = s->z[j + 1] - s->z[j];
        length = segment_fall(s, j) > CEDUO_FACE_FALL ? length + sqrt(dx * dx + dz * dz) : 0;
        if (length >= CEDUO_FACE_LENGTH && s->x[j + 1] > from)
            foot = s->x[j + 1];
    }
    return foot;
}

static double longest_bench(const struct ceduo_slope *s, double from, double to)
{
    double longest = 0, length = 0;
    for (size_t j = 0; j + 1 < s->vertices; j++) {
        double a = fmax(s->x[j], from), b = fmin(s->x[j + 1], to);
        if (!(b > a))
            continue;
        length = segment_fall(s, j) <= CEDUO_BENCH_INCLINATION ? length + (b - a) : 0;
        longest = fmax(longest, length);
    }
    return longest;
}

struct ceduo_topography ceduo_slope_topography(const struct ceduo_slope *slope, double release_x, double release_height,
                                               double x)
{
    double z = ceduo_slope_height(slope, x), start = ceduo_slope_height(slope, release_x) + release_height;
    double foot = find_foot(slope, release_x, x);
    struct ceduo_topography t = {.reach = ceduo_atan((start - z) / (x - release_x)), .shadow = NAN, .foot = foot};
    if (foot < x)
        t.shadow = ceduo_atan((ceduo_slope_height(slope, foot) - z) / (x - foot));
    t.bench = longest_bench(slope, isnan(foot) ? release_x : foot, x);
    return t;
}

/* ---- simplification ---- */

static bool numbers_equal(struct ceduo_number a, struct ceduo_number b)
{
    return a.mean == b.mean && a.spread == b.spread && (a.kind == b.kind || a.spread == 0);
}

bool ceduo_segment_same(const struct ceduo_segment *a, const struct ceduo_segment *b)
{
    bool roughness = isnan(a->roughness_m) ? isnan(b->roughness_m) && a->roughness_rad == b->roughness_rad
                                           : a->roughness_m == b->roughness_m;
    return roughness && a->friction == b->friction && a->mu == b->mu && numbers_equal(a->rn, b->rn) &&
           numbers_equal(a->rt, b->rt);
}

/* Points of a profile during simplification, with flags of kept points. */
struct points {
    size_t n;
    double *x, *z;
    bool *kept;
};

/* Keep the point at x; insert it into its segment if there is none. */
static void keep_at(struct points *p, double x)
{
    if (!(x >= p->x[0]) || !(x <= p->x[p->n - 1]))
        return;
    size_t i = gsl_interp_bsearch(p->x, x, 0, p->n - 1);
    double share = (x - p->x[i]) / (p->x[i + 1] - p->x[i]);
    if (share > 0 && share < 1) {
        double z = p->z[i] + share * (p->z[i + 1] - p->z[i]);
        size_t after = p->n - ++i;
        memmove(p->x + i + 1, p->x + i, after * sizeof *p->x);
        memmove(p->z + i + 1, p->z + i, after * sizeof *p->z);
        memmove(p->kept + i + 1, p->kept + i, after * sizeof *p->kept);
        p->x[i] = x;
        p->z[i] = z;
        p->n++;
    } else if (share > 0) {
        i++;
    }
    p->kept[i] = true;
}

/* Keep the point farthest from the line between two kept points if its distance exceeds `tolerance`, then repeat on both sides.
 * `stack` has capacity for all points. */
static void keep_farthest(struct points *p, double tolerance, size_t *stack)
{
    size_t depth = 0, from = 0;
    for (size_t i = p->n - 1; i > 0; i--)
        if (p->kept[i])
            stack[depth++] = i;
    while (depth > 0) {
        size_t to = stack[depth - 1], farthest = from;
        double dx = p->x[to] - p->x[from], dz = p->z[to] - p->z[from], max = tolerance * sqrt(dx * dx + dz * dz);
        for (size_t i = from + 1; i < to; i++) {
            double distance = fabs((p->z[i] - p->z[from]) * dx - (p->x[i] - p->x[from]) * dz);
            if (distance > max) {
                max = distance;
                farthest = i;
            }
        }
        if (farthest > from) {
            p->kept[farthest] = true;
            stack[depth++] = farthest;
        } else {
            from = to;
            depth--;
        }
    }
}

enum ceduo_status ceduo_slope_simplify(const struct ceduo_slope *slope, double release_x, struct ceduo_slope *to)
{
    *to = *slope;
    to->x = to->z = NULL;
    to->segments = NULL;
    bool unchanged = slope->tolerance == 0 || slope->simplified_at == release_x;
    if (slope->tolerance == slope->simplified_to && unchanged)
        return CEDUO_OK;
    bool has_points = slope->points > 0;
    size_t n = has_points ? slope->points : slope->vertices, capacity = n + slope->vertices + 1;
    const double *x = has_points ? slope->points_x : slope->x, *z = has_points ? slope->points_z : slope->z;
    struct points p = {.n = n};
    p.x = to->x = malloc(capacity * sizeof *to->x);
    p.z = to->z = malloc(capacity * sizeof *to->z);
    to->segments = malloc(capacity * sizeof *to->segments);
    p.kept = calloc(capacity, sizeof *p.kept);
    size_t *stack = malloc(capacity * sizeof *stack);
    bool good = p.x && p.z && to->segments && p.kept && stack;
    if (good) {
        memcpy(p.x, x, n * sizeof *x);
        memcpy(p.z, z, n * sizeof *z);
        p.kept[0] = p.kept[n - 1] = true;
        keep_at(&p, release_x);
        for (size_t j = 1; j + 1 < slope->vertices; j++)
            if (!ceduo_segment_same(&slope->segments[j - 1], &slope->segments[j]))
                keep_at(&p, slope->x[j]);
        if (slope->tolerance > 0)
            keep_farthest(&p, slope->tolerance, stack);
        to->vertices = 0;
        for (size_t i = 0; i < p.n; i++)
            if (p.kept[i] || slope->tolerance == 0) {
                to->x[to->vertices] = p.x[i];
                to->z[to->vertices++] = p.z[i];
            }
        for (size_t j = 0; j + 1 < to->vertices; j++)
            to->segments[j] = slope->segments[ceduo_slope_segment(slope, (to->x[j] + to->x[j + 1]) / 2)];
        to->simplified_to = slope->tolerance;
        to->simplified_at = release_x;
    }
    free(p.kept);
    free(stack);
    if (good)
        return CEDUO_OK;
    ceduo_slope_simplified_release(to);
    return CEDUO_NO_MEMORY;
}

void ceduo_slope_simplified_release(struct ceduo_slope *slope)
{
    free(slope->x);
    free(slope->z);
    free(slope->segments);
    slope->x = slope->z = NULL;
    slope->segments = NULL;
}

enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope)
{
    if (slope->vertices < 2 || !slope->x || !slope->z || !slope->segments || !(slope->tolerance >= 0) ||
        !isfinite(slope->tolerance))
        return CEDUO_BAD_SLOPE;
    for (size_t i = 0; i < slope->vertices; i++)
        if (!isfinite(slope->x[i]) || !isfinite(slope->z[i]))
            return CEDUO_BAD_SLOPE;
    for (size_t i = 0; i + 1 < slope->vertices; i++) {
        const struct ceduo_segment *s = &slope->segments[i];
        const struct ceduo_number *const restitutions[] = {&s->rn, &s->rt};
        bool good = isnan(s->roughness_m) ? s->roughness_rad >= 0 && s->roughness_rad < M_PI_2
                                          : s->roughness_m >= 0 && isnan(s->roughness_rad);
        for (int k = 0; k < 2; k++) {
            struct ceduo_number n = *restitutions[k];
            good = good && n.mean >= 0 && n.mean <= 1 && n.spread >= 0 && isfinite(n.spread);
        }
        good = good && s->friction >= 0 && isfinite(s->friction) && s->mu >= 0 && isfinite(s->mu);
        if (!good || !(slope->x[i + 1] > slope->x[i]))
            return CEDUO_BAD_SLOPE;
    }
    return CEDUO_OK;
}
