/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guess.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "base/gsl_errors.h"

#define KNOWN_BY 3   /* times as many places as terms: those within reach of the best set how much a place counts */
#define SHARP    2.  /* of a log-likelihood: no place counts less for less than this */
#define BLOCK    256 /* places that are reduced at once */

struct known {
    const double *u, *values;
    size_t n;
    double best, reach;
    const atomic_bool *cancel;
};

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

/* What is known is reduced to a triangle of as many rows as there are terms, with what is left of the values beside it: the
 * least squares are the same. By blocks, so that many places hold up nobody who ends the work. */
static enum ceduo_status reduce(const struct guess *g, const struct known *known, gsl_matrix *rows, gsl_vector *tau)
{
    size_t columns = g->terms + 1, row = columns;
    for (size_t i = 0; i < known->n; i++) {
        if (isfinite(known->values[i])) {
            double *to = gsl_matrix_ptr(rows, row++, 0), root = exp((known->values[i] - known->best) / known->reach / 2);
            fill_terms(g, known->u + i * g->dimensions, to);
            to[g->terms] = known->values[i];
            for (size_t k = 0; k < columns; k++)
                to[k] *= root;
        }
        if (row < rows->size1 && i + 1 < known->n)
            continue;
        if (ceduo_cancelled(known->cancel))
            return CEDUO_CANCELLED;
        gsl_linalg_QR_decomp(rows, tau);
        for (row = 1; row < rows->size1; row++) /* below the triangle */
            memset(gsl_matrix_ptr(rows, row, 0), 0, (row < columns ? row : columns) * sizeof(double));
        row = columns;
    }
    return CEDUO_OK;
}

/* The arguments of gsl_multifit_linear(). */
struct squares {
    gsl_matrix_view triangle;
    gsl_vector_view values;
    gsl_vector *c;
    gsl_matrix *covariance;
    gsl_multifit_linear_workspace *work;
};

static int fit_squares(void *context)
{
    struct squares *s = context;
    double chisq;
    return gsl_multifit_linear(&s->triangle.matrix, &s->values.vector, s->c, s->covariance, &chisq, s->work);
}

static enum ceduo_status solve(struct guess *g, gsl_matrix *rows)
{
    gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(g->terms, g->terms);
    gsl_vector *c = gsl_vector_alloc(g->terms);
    gsl_matrix *covariance = gsl_matrix_alloc(g->terms, g->terms);
    double *kept = malloc(g->terms * sizeof *kept);
    bool good = work && c && covariance && kept; /* untaken 3: gsl */
    if (good) {
        struct squares squares = {gsl_matrix_submatrix(rows, 0, 0, g->terms, g->terms),
                                  gsl_matrix_subcolumn(rows, g->terms, 0, g->terms), c, covariance, work};
        int status = ceduo_gsl_try(fit_squares, &squares);
        good = status != GSL_ENOMEM; /* untaken: gsl */
        if (status == 0) {           /* untaken: gsl */
            for (size_t i = 0; i < g->terms; i++)
                kept[i] = gsl_vector_get(c, i);
            free(g->coefficients);
            g->coefficients = kept;
            kept = NULL;
        }
    }
    free(kept);
    gsl_multifit_linear_free(work);
    gsl_vector_free(c);
    gsl_matrix_free(covariance);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

enum ceduo_status ceduo_guess_learn(struct guess *g, const double *u, const double *values, size_t n, const atomic_bool *cancel)
{
    struct known known = {u, values, n, .cancel = cancel};
    double *down = malloc((n + 1) * sizeof *down);
    if (!down)
        return CEDUO_NO_MEMORY;
    known.reach = n > 2 * g->terms ? reach_of(g, values, n, down, &known.best) : NAN;
    free(down);
    if (isnan(known.reach))
        return CEDUO_OK;
    gsl_matrix *rows = gsl_matrix_calloc(g->terms + 1 + BLOCK, g->terms + 1);
    gsl_vector *tau = gsl_vector_alloc(g->terms + 1);
    enum ceduo_status status = rows && tau ? reduce(g, &known, rows, tau) : CEDUO_NO_MEMORY; /* untaken 2: gsl */
    if (status == CEDUO_OK)
        status = solve(g, rows);
    gsl_matrix_free(rows);
    gsl_vector_free(tau);
    return status;
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
