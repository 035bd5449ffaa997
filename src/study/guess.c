/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guess.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multilarge.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "ceduo/calibrate.h"

#define KNOWN_BY  3    /* times as many places as terms: those within reach of the best set how much a place counts */
#define SHARP     2.   /* of a log-likelihood: no place counts less for less than this */
#define BLOCK     256  /* places that are reduced at once */
#define RIDGE     1e-9 /* where the places do not tell all terms, what they do not tell stays 0 */
#define TERMS(d)  (1 + (d) + (d) * ((d) + 1) / 2)
#define TERMS_MAX TERMS(CEDUO_CALIBRATION_MAX)

struct guess ceduo_guess_begin(size_t d)
{
    return (struct guess){.dimensions = d, .terms = TERMS(d)};
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
    if (m <= k || n <= 2 * g->terms)
        return NAN;
    gsl_sort(down, 1, m);
    *best = -down[0];
    return fmax(SHARP, (down[k] - down[0]) / 2);
}

/* What least squares are computed with: rows of terms, their values, and what they come to. */
struct squares {
    gsl_matrix *rows;
    gsl_vector *values, *found;
    gsl_multilarge_linear_workspace *work;
};

static int solve(void *context)
{
    struct squares *s = context;
    double left, size;
    return gsl_multilarge_linear_solve(RIDGE, s->found, &left, &size, s->work);
}

/* By blocks, so that many places hold up nobody who ends the work. */
static enum ceduo_status add_places(const struct guess *g, const double *u, const double *values, size_t n, double best,
                                    double reach, const atomic_bool *cancel, struct squares *s)
{
    for (size_t i = 0, row = 0; i < n; i++) {
        if (isfinite(values[i])) {
            gsl_vector_view terms = gsl_matrix_row(s->rows, row);
            double root = exp((values[i] - best) / reach / 2);
            fill_terms(g, u + i * g->dimensions, terms.vector.data);
            gsl_vector_scale(&terms.vector, root);
            gsl_vector_set(s->values, row++, root * values[i]);
        }
        if (row < BLOCK && i + 1 < n)
            continue;
        if (ceduo_cancelled(cancel))
            return CEDUO_CANCELLED;
        if (row == 0) /* only the last block can be empty */
            break;
        gsl_matrix_view rows = gsl_matrix_submatrix(s->rows, 0, 0, row, g->terms);
        gsl_vector_view row_values = gsl_vector_subvector(s->values, 0, row);
        gsl_multilarge_linear_accumulate(&rows.matrix, &row_values.vector, s->work);
        row = 0;
    }
    return CEDUO_OK;
}

enum ceduo_status ceduo_guess_learn(struct guess *g, const double *u, const double *values, size_t n, const atomic_bool *cancel)
{
    double best = 0, *down = malloc((n + 1) * sizeof *down), reach = down ? reach_of(g, values, n, down, &best) : NAN;
    free(down);
    if (!down || isnan(reach))
        return down ? CEDUO_OK : CEDUO_NO_MEMORY;
    struct squares s = {gsl_matrix_alloc(BLOCK, g->terms), gsl_vector_alloc(BLOCK), gsl_vector_alloc(g->terms),
                        gsl_multilarge_linear_alloc(gsl_multilarge_linear_tsqr, g->terms)};
    double *kept = malloc(g->terms * sizeof *kept);
    enum ceduo_status status = s.rows && s.values && s.found && s.work && kept ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = add_places(g, u, values, n, best, reach, cancel, &s);
    int solved = status == CEDUO_OK ? ceduo_gsl_try(solve, &s) : GSL_FAILURE;
    if (solved == GSL_SUCCESS) {
        memcpy(kept, s.found->data, g->terms * sizeof *kept);
        free(g->coefficients);
        g->coefficients = kept;
    } else {
        free(kept);
    }
    gsl_matrix_free(s.rows);
    gsl_vector_free(s.values);
    gsl_vector_free(s.found);
    if (s.work)
        gsl_multilarge_linear_free(s.work);
    return solved == GSL_ENOMEM ? CEDUO_NO_MEMORY : status;
}

double ceduo_guess_at(const struct guess *g, const double *u)
{
    double sum = 0, terms[TERMS_MAX];
    if (!g->coefficients)
        return 0;
    fill_terms(g, u, terms);
    for (size_t i = 0; i < g->terms; i++)
        sum += g->coefficients[i] * terms[i];
    return sum;
}
