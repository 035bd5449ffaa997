/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "guess.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"

#define KNOWN_BY  3     /* times as many places as terms: those within reach of the best set how much a place counts */
#define SHARP     2.    /* of a log-likelihood: no place counts less for less than this */
#define BLOCK     256   /* places between two looks at `cancel` */
#define RIDGE     1e-13 /* relative, where the places do not tell all terms */
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

/* Set the terms: 1, then the coordinates from the center, then their products. */
static void fill_terms(const struct guess *g, const double *u, double *terms)
{
    const double *first = terms + 1;
    *terms++ = 1;
    for (size_t i = 0; i < g->dimensions; i++)
        *terms++ = u[i] - g->center[i];
    for (size_t i = 0; i < g->dimensions; i++)
        for (size_t k = 0; k <= i; k++)
            *terms++ = first[i] * first[k];
}

/* How far below the best a place still counts; NaN where too few are known. `down`: room for n. */
static double reach_of(const struct guess *g, const double *values, size_t n, double *down, size_t *best)
{
    size_t k = KNOWN_BY * g->terms < n ? KNOWN_BY * g->terms : n - 1, m = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i])) {
            down[m++] = -values[i];
            *best = isfinite(values[*best]) && values[*best] >= values[i] ? *best : i;
        }
    if (m <= k || n <= 2 * g->terms)
        return NAN;
    gsl_sort(down, 1, m);
    return fmax(SHARP, (down[k] - down[0]) / 2);
}

/* Normal equations lose no digits, because the terms are those of the distance from the best place. */
enum ceduo_status ceduo_guess_learn(struct guess *g, const double *u, const double *values, size_t n, const atomic_bool *cancel)
{
    size_t best = 0;
    double *down = malloc((n + 1) * sizeof *down), reach = down ? reach_of(g, values, n, down, &best) : NAN;
    free(down);
    if (!down || isnan(reach))
        return down ? CEDUO_OK : CEDUO_NO_MEMORY;
    struct guess now = *g;
    double terms[TERMS_MAX];
    gsl_matrix *squares = gsl_matrix_calloc(g->terms, g->terms);
    now.coefficients = calloc(g->terms, sizeof *now.coefficients);
    memcpy(now.center, u + best * g->dimensions, g->dimensions * sizeof *u);
    enum ceduo_status status = squares && now.coefficients ? CEDUO_OK : CEDUO_NO_MEMORY;
    gsl_vector_view term = gsl_vector_view_array(terms, g->terms), found = term;
    if (now.coefficients)
        found = gsl_vector_view_array(now.coefficients, g->terms);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        double weight = isfinite(values[i]) ? exp((values[i] - values[best]) / reach) : 0;
        if (weight > 0) {
            fill_terms(&now, u + i * g->dimensions, terms);
            gsl_blas_dsyr(CblasLower, weight, &term.vector, squares);
            gsl_blas_daxpy(weight * (values[i] - values[best]), &term.vector, &found.vector);
        }
        if (i % BLOCK == 0 && ceduo_cancelled(cancel))
            status = CEDUO_CANCELLED;
    }
    if (status == CEDUO_OK) {
        gsl_vector_view diagonal = gsl_matrix_diagonal(squares);
        gsl_vector_scale(&diagonal.vector, 1 + RIDGE);
    }
    if (status == CEDUO_OK && gsl_linalg_cholesky_decomp1(squares) == 0) {
        gsl_linalg_cholesky_svx(squares, &found.vector);
        now.coefficients[0] += values[best];
        ceduo_guess_release(g);
        *g = now;
    } else {
        free(now.coefficients);
    }
    gsl_matrix_free(squares);
    return status;
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
