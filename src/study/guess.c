/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guess.h"

#include <gsl/gsl_multifit.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#define KNOWN_BY 3  /* times as many places as terms: those within reach of the best set how much a place counts */
#define SHARP    2. /* of a log-likelihood: no place counts less for less than this */

struct guess ceduo_guess_begin(size_t d)
{
    return (struct guess){.dimensions = d, .terms = 1 + d + d * (d + 1) / 2};
}

void ceduo_guess_release(struct guess *g)
{
    free(g->coefficients);
    g->coefficients = NULL;
}

/* Term number i: 1, then the coordinates, then their products. */
static void fill_terms(const struct guess *g, const double *u, double *terms)
{
    *terms++ = 1;
    for (size_t i = 0; i < g->dimensions; i++)
        *terms++ = u[i] - 0.5;
    for (size_t i = 0; i < g->dimensions; i++)
        for (size_t k = 0; k <= i; k++)
            *terms++ = (u[i] - 0.5) * (u[k] - 0.5);
}

/* How far below the best a place still counts; NaN where too few are known. `down`: room for n. */
static double reach_of(const struct guess *g, const double *values, size_t n, double *down, double *best)
{
    size_t k = KNOWN_BY * g->terms < n ? KNOWN_BY * g->terms : n - 1, m = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i]))
            down[m++] = -values[i];
    if (m <= k)
        return NAN;
    gsl_sort(down, 1, m);
    *best = -down[0];
    return fmax(SHARP, (down[k] - down[0]) / 2);
}

static bool solve(struct guess *g, gsl_matrix *x, gsl_vector *w, gsl_vector *y)
{
    gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(y->size, g->terms);
    gsl_vector *c = gsl_vector_alloc(g->terms);
    gsl_matrix *covariance = gsl_matrix_alloc(g->terms, g->terms);
    double chisq, *kept = malloc(g->terms * sizeof *kept);
    bool good = work && c && covariance && kept;
    if (good && gsl_multifit_wlinear(x, w, y, c, covariance, &chisq, work) == 0) {
        for (size_t i = 0; i < g->terms; i++)
            kept[i] = gsl_vector_get(c, i);
        free(g->coefficients);
        g->coefficients = kept;
        kept = NULL;
    }
    free(kept);
    gsl_multifit_linear_free(work);
    gsl_vector_free(c);
    gsl_matrix_free(covariance);
    return good;
}

bool ceduo_guess_learn(struct guess *g, const double *u, const double *values, size_t n)
{
    double best = 0, reach, *down = malloc((n + 1) * sizeof *down);
    if (!down)
        return false;
    reach = n > 2 * g->terms ? reach_of(g, values, n, down, &best) : NAN;
    free(down);
    if (isnan(reach))
        return true;
    gsl_matrix *x = gsl_matrix_alloc(n, g->terms);
    gsl_vector *w = gsl_vector_calloc(n), *y = gsl_vector_calloc(n);
    bool good = x && w && y;
    for (size_t i = 0; good && i < n; i++) {
        fill_terms(g, u + i * g->dimensions, gsl_matrix_ptr(x, i, 0));
        if (!isfinite(values[i]))
            continue;
        gsl_vector_set(w, i, exp((values[i] - best) / reach));
        gsl_vector_set(y, i, values[i]);
    }
    good = good && solve(g, x, w, y);
    gsl_matrix_free(x);
    gsl_vector_free(w);
    gsl_vector_free(y);
    return good;
}

double ceduo_guess_at(const struct guess *g, const double *u)
{
    double sum = 0;
    if (!g->coefficients)
        return 0;
    const double *c = g->coefficients;
    sum += *c++;
    for (size_t i = 0; i < g->dimensions; i++)
        sum += *c++ * (u[i] - 0.5);
    for (size_t i = 0; i < g->dimensions; i++)
        for (size_t k = 0; k <= i; k++)
            sum += *c++ * (u[i] - 0.5) * (u[k] - 0.5);
    return sum;
}
