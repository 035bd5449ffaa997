/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/slope.h"

#include <gsl/gsl_interp.h>
#include <math.h>

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
    return pz[j] + (pz[j + 1] - pz[j]) / (px[j + 1] - px[j]) * (x - px[j]);
}

double ceduo_slope_mirrored(const struct ceduo_slope *slope, double x)
{
    return slope->reversed ? 2 * slope->origin_x + slope->x[slope->vertices - 1] - x : x;
}

static double fall(const struct ceduo_slope *s, size_t j)
{
    return (s->z[j] - s->z[j + 1]) / (s->x[j + 1] - s->x[j]);
}

double ceduo_slope_fall(const struct ceduo_slope *slope, double x)
{
    return fall(slope, ceduo_slope_segment(slope, x));
}

double ceduo_slope_face(const struct ceduo_slope *slope)
{
    for (size_t j = 0; j + 1 < slope->vertices; j++)
        if (fall(slope, j) > CEDUO_FACE_FALL)
            return slope->x[j];
    return NAN;
}

enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope)
{
    if (slope->vertices < 2 || !slope->x || !slope->z || !slope->segments)
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
