/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Näslund's curve: a line through d/sqrt(h - 1.3) begins the search, and least squares of the heights end it. */
#include "ceduo/naslund.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/gsl_errors.h"

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

/* The line d/sqrt(h - 1.3) = a + b d. False where there is none. */
static bool begin(const struct pairs *p, double *x)
{
    double *d = malloc(2 * p->n * sizeof *d), ignored[4];
    if (!d)
        return false;
    for (size_t i = 0; i < p->n; i++) {
        d[i] = p->dbh[i] * 100;
        d[p->n + i] = d[i] / sqrt(p->height[i] - CEDUO_BREAST_HEIGHT);
    }
    gsl_fit_linear(d, 1, d + p->n, 1, p->n, &x[0], &x[1], &ignored[0], &ignored[1], &ignored[2], &ignored[3]);
    free(d);
    return true;
}

enum ceduo_status ceduo_naslund_fit(size_t n, const double *dbh, const double *height, struct ceduo_naslund *curve)
{
    GSL_RETURNS_ERRORS;
    struct pairs pairs = {n, dbh, height};
    double x[2];
    if (n < CEDUO_NASLUND_MIN || !(gsl_stats_max(dbh, 1, n) > gsl_stats_min(dbh, 1, n)))
        return CEDUO_NO_FIT;
    if (!begin(&pairs, x))
        return CEDUO_NO_MEMORY;
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, n, 2);
    if (!w)
        return CEDUO_NO_MEMORY;
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .n = n, .p = 2, .params = &pairs};
    gsl_vector_view start = gsl_vector_view_array(x, 2);
    int why;
    gsl_multifit_nlinear_init(&start.vector, &fdf, w);
    gsl_multifit_nlinear_driver(STEPS_MAX, EXACT, EXACT, 0, NULL, NULL, &why, w);
    curve->a = gsl_vector_get(gsl_multifit_nlinear_position(w), 0);
    curve->b = gsl_vector_get(gsl_multifit_nlinear_position(w), 1);
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double left = ceduo_naslund_height(curve, dbh[i]) - height[i];
        sum += left * left;
    }
    curve->rmse = sqrt(sum / (double)n);
    gsl_multifit_nlinear_free(w);
    return curve->a >= 0 && curve->b > 0 && isfinite(curve->rmse) ? CEDUO_OK : CEDUO_NO_FIT;
}
