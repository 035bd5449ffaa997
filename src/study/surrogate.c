/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "surrogate.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"

#define PER_TERM  3     /* points per term that the bandwidth must cover */
#define WIDTH_MIN 2.    /* smallest bandwidth, in log-likelihood */
#define BLOCK     256   /* points between two checks of `cancel` */
#define RIDGE     1e-13 /* relative; keeps the normal equations solvable if the points do not determine all terms */
#define TERMS(d)  (1 + (d) + (d) * ((d) + 1) / 2)
#define TERMS_MAX TERMS(CEDUO_CALIBRATION_MAX)

struct surrogate ceduo_surrogate_begin(size_t d)
{
    return (struct surrogate){.dimensions = d, .terms = TERMS(d)};
}

void ceduo_surrogate_free(struct surrogate *g)
{
    free(g->coefficients);
    g->coefficients = NULL;
}

/* Set the terms: 1, the coordinates relative to the center, their products. */
static void fill_terms(const struct surrogate *g, const double *u, double *terms)
{
    const double *first = terms + 1;
    *terms++ = 1;
    for (size_t i = 0; i < g->dimensions; i++)
        *terms++ = u[i] - g->center[i];
    for (size_t i = 0; i < g->dimensions; i++)
        for (size_t k = 0; k <= i; k++)
            *terms++ = first[i] * first[k];
}

/* Return the bandwidth of the weights, in log-likelihood below the best point; NaN: too few finite values. `down`: buffer
 * for n. */
static double find_bandwidth(const struct surrogate *g, const double *values, size_t n, double *down, size_t *best)
{
    size_t rank = PER_TERM * g->terms < n ? PER_TERM * g->terms : n - 1, count = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i])) {
            down[count++] = -values[i];
            *best = isfinite(values[*best]) && values[*best] >= values[i] ? *best : i;
        }
    if (count <= rank || n <= 2 * g->terms)
        return NAN;
    gsl_sort(down, 1, count);
    return fmax(WIDTH_MIN, (down[rank] - down[0]) / 2);
}

/* The normal equations are well conditioned because the terms are relative to the best point. */
enum ceduo_status ceduo_surrogate_train(struct surrogate *g, const double *u, const double *values, size_t n,
                                        const atomic_bool *cancel)
{
    size_t best = 0;
    double *down = malloc((n + 1) * sizeof *down), bandwidth = down ? find_bandwidth(g, values, n, down, &best) : NAN;
    free(down);
    if (!down || isnan(bandwidth))
        return down ? CEDUO_OK : CEDUO_NO_MEMORY;
    struct surrogate fitted = *g;
    double terms[TERMS_MAX];
    gsl_matrix *squares = gsl_matrix_calloc(g->terms, g->terms);
    fitted.coefficients = calloc(g->terms, sizeof *fitted.coefficients);
    memcpy(fitted.center, u + best * g->dimensions, g->dimensions * sizeof *u);
    enum ceduo_status status = squares && fitted.coefficients ? CEDUO_OK : CEDUO_NO_MEMORY;
    gsl_vector_view term = gsl_vector_view_array(terms, g->terms), solution = term;
    if (fitted.coefficients)
        solution = gsl_vector_view_array(fitted.coefficients, g->terms);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        double weight = isfinite(values[i]) ? exp((values[i] - values[best]) / bandwidth) : 0;
        if (weight > 0) {
            fill_terms(&fitted, u + i * g->dimensions, terms);
            gsl_blas_dsyr(CblasLower, weight, &term.vector, squares);
            gsl_blas_daxpy(weight * (values[i] - values[best]), &term.vector, &solution.vector);
        }
        if (i % BLOCK == 0 && ceduo_cancelled(cancel))
            status = CEDUO_CANCELLED;
    }
    if (status == CEDUO_OK) {
        gsl_vector_view diagonal = gsl_matrix_diagonal(squares);
        gsl_vector_scale(&diagonal.vector, 1 + RIDGE);
    }
    if (status == CEDUO_OK && gsl_linalg_cholesky_decomp1(squares) == 0) {
        gsl_linalg_cholesky_svx(squares, &solution.vector);
        fitted.coefficients[0] += values[best];
        ceduo_surrogate_free(g);
        *g = fitted;
    } else {
        free(fitted.coefficients);
    }
    gsl_matrix_free(squares);
    return status;
}

double ceduo_surrogate_evaluate(const struct surrogate *g, const double *u)
{
    double sum = 0, terms[TERMS_MAX];
    if (!g->coefficients)
        return 0;
    fill_terms(g, u, terms);
    for (size_t i = 0; i < g->terms; i++)
        sum += g->coefficients[i] * terms[i];
    return sum;
}
