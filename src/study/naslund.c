/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits Näslund's curve by nonlinear least squares of the heights. */

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

#include "base/gsl_errors.h"
#include "naslund.h"

#define STEPS_MAX 200
#define EXACT     1e-12

struct pairs {
    size_t n;
    const double *dbh, *height; /* m */
};

double ceduo_naslund_height(const struct ceduo_naslund *curve, double dbh)
{
    double d = dbh * 100, root = d / (curve->a + curve->b * d);
    return CEDUO_BREAST_HEIGHT + root * root;
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *f)
{
    const struct pairs *p = context;
    const struct ceduo_naslund curve = {.a = gsl_vector_get(x, 0), .b = gsl_vector_get(x, 1)};
    for (size_t i = 0; i < p->n; i++)
        gsl_vector_set(f, i, ceduo_naslund_height(&curve, p->dbh[i]) - p->height[i]);
    return GSL_SUCCESS;
}

enum ceduo_status ceduo_naslund_fit(size_t n, const double *dbh, const double *height, struct ceduo_naslund *curve)
{
    GSL_RETURNS_ERRORS;
    struct pairs pairs = {n, dbh, height};
    double x[2] = {.5, .15}; /* a typical curve */
    if (n < CEDUO_NASLUND_MIN || !(gsl_stats_max(dbh, 1, n) > gsl_stats_min(dbh, 1, n)))
        return CEDUO_NO_FIT;
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, 2);
    if (!w)
        return CEDUO_NO_MEMORY;
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .n = n, .p = 2, .params = &pairs};
    gsl_vector_view start = gsl_vector_view_array(x, 2);
    int reason;
    gsl_multifit_nlinear_init(&start.vector, &fdf, w);
    gsl_multifit_nlinear_driver(STEPS_MAX, EXACT, EXACT, 0, NULL, NULL, &reason, w);
    const gsl_vector *found = gsl_multifit_nlinear_position(w);
    double sign = gsl_vector_get(found, 1) < 0 ? -1 : 1; /* -a and -b give the same curve */
    curve->a = sign * gsl_vector_get(found, 0);
    curve->b = sign * gsl_vector_get(found, 1);
    curve->rmse = gsl_blas_dnrm2(gsl_multifit_nlinear_residual(w)) / sqrt((double)n);
    gsl_multifit_nlinear_free(w);
    return curve->a >= 0 && curve->b > 0 && isfinite(curve->rmse) ? CEDUO_OK : CEDUO_NO_FIT; /* untaken: rounding */
}
