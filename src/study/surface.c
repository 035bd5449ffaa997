/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits a polynomial chaos surrogate to the values of a figure at points. Each input has basis functions with mean 0 and
 * variance 1; those of words and calibration draws are tables. Terms are products of functions, so the square of a coefficient
 * is a part of the variance. Terms are fitted by ridge regression; generalised cross-validation chooses the ridge. With too few
 * points for all terms a fit without products ranks the inputs, and only the leading inputs have products.
 *
 * The rocks form groups, the same at every point. Each group is fitted separately, because the product of two groups'
 * estimates is not biased by sampling noise. The residual of the terms is common to all groups; its contribution to a
 * squared coefficient is subtracted. Errors have two parts. The sampling error of the rocks is a jackknife over groups; more
 * points do not reduce it. The residuals of the terms give a wild bootstrap (Wu 1986). */

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/gsl_errors.h"
#include "base/random.h"
#include "check_study.h"
#include "core/runs/statistics.h"
#include "points.h"
#include "surface.h"

#define GROUPS          CEDUO_SURFACE_GROUPS
#define COORDINATES     40         /* dimensions of GSL's Sobol' points */
#define POINTS_PER_TERM 2.5        /* points that a term requires */
#define SAMPLES         64         /* bootstrap samples */
#define KNOWN_VALUES    8          /* values of an input that is assumed known */
#define TABLE_MAX       12         /* functions of an input with a table */
#define RIDGES          57         /* ridges tried */
#define COLLINEAR       1e-8       /* squared share of a column below which it is a combination of the others */
#define SHIFT           UINT64_MAX /* row of the random shifts of Sobol' points */

/* ---- points ---- */

enum ceduo_status ceduo_surface_points(uint64_t seed, size_t points, size_t inputs, double *u)
{
    GSL_RETURNS_ERRORS;
    double sobol[COORDINATES];
    size_t coordinates = inputs < COORDINATES ? inputs : COORDINATES;
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)coordinates);
    if (!sequence)
        return CEDUO_NO_MEMORY;
    for (size_t row = 0; row < points; row++) {
        gsl_qrng_get(sequence, sobol);
        for (size_t i = 0; i < inputs; i++) {
            double shift = random_pair(seed, i < coordinates ? SHIFT : row, i, RANDOM_POINT).u[0];
            double x = shift + (i < coordinates ? sobol[i] : 0);
            u[row * inputs + i] = x - floor(x);
        }
    }
    gsl_qrng_free(sequence);
    return CEDUO_OK;
}

/* ---- functions of one input ---- */

/* Basis functions of an input: `count` functions from `first`, the first `linear` of degree 1. */
struct basis {
    size_t first, count, linear, levels; /* levels: rows of the table; 0: a range */
    double *table;                       /* [level][TABLE_MAX] */
};

struct term {
    size_t n, f[3]; /* the functions multiplied */
};

struct terms {
    size_t n;
    struct term *items; /* NULL: count only */
};

/* Inputs of the terms, ranked if there are too few points for all products; see list_terms(). */
struct term_set {
    size_t *used, n, leading; /* the first `leading` inputs have products */
    bool enough_points;       /* points suffice for the terms without products */
    bool linear;              /* no functions of degree 2: too few points */
};

/* Terms with their centered values at the points, decomposed as U S V', and fitted to a figure. */
struct solution {
    const struct ceduo_surface *s;
    struct arena memory;
    struct term_set set;
    struct terms terms;
    gsl_matrix_view x; /* [point][term] */
    double *means;     /* mean of each term over the points */
    gsl_multifit_linear_workspace *workspace;
    double lambda, dof;                  /* ridge; residual degrees of freedom */
    double *coefficient, *mean;          /* [group][term]; mean: of the mean of the groups */
    double *residuals, *mean_residuals;  /* [group][point], with noise; residuals of the mean of the groups */
    double *leverage;                    /* one per point */
    double *delta;                       /* change of `mean` in a bootstrap sample */
    double *unit_variance;               /* variance of each coefficient for values of variance 1 */
    double residual_variance, shrinkage; /* without noise; factor that removes the noise of mean_residuals */
};

/* Values of a figure at the points, for each group and their mean (GROUPS), centered over the points: the same rocks at
 * every point shift a group by a constant. Without a fit `residuals` are the values themselves. */
struct response {
    const struct ceduo_surface_figure *figure;
    size_t points;
    double *y, means[GROUPS + 1];
    double variance, noise; /* variance of the mean without sampling noise; sampling variance */
    const double *residuals;
    double shrinkage;
};

/* Variance of each input's terms, first alone, then with interactions; last the residual variance. `explained`: of all
 * terms. */
struct variance_parts {
    size_t n;
    double *part, explained, *residual_variance;
};

struct ceduo_surface {
    const struct ceduo_input *inputs;
    const double *u;
    size_t points, inputs_count, functions_count;
    struct arena memory;
    struct basis *bases;
    size_t *input;                          /* input of each function */
    double *function_values;                /* [function][point] */
    double *multipliers;                    /* [sample][point], standard normal */
    struct solution solutions[2];           /* the last ones, without and with products */
    struct response response;               /* the current figure */
    struct variance_parts parts, resampled; /* parts of the figure, and of a jackknife or bootstrap sample */
    double *squares;                        /* sums of squared differences of their shares: jackknife, then bootstrap */
    size_t *used;                           /* buffer for term_set.used */
    double *scratch, *values;               /* buffers: functions at the points; one value per point */
};

/* Return a value of a column before orthonormalization. Words: an indicator for each but the last. Draws: standardized
 * values of each place, then their squares. */
static double table_value(const struct ceduo_input *input, size_t column, size_t level)
{
    if (input->kind == CEDUO_INPUT_WORDS)
        return level == column;
    size_t places = input->places_count, n = input->draws_count;
    const double *values = input->draws[column % places];
    double sd = gsl_stats_sd(values, 1, n), x = sd > 0 ? (values[level] - gsl_stats_mean(values, 1, n)) / sd : 0;
    return column < places ? x : x * x;
}

/* Orthonormalize a column against the constant and the `done` columns before it. Return false if it depends on them. */
static bool make_orthonormal(double *table, size_t levels, size_t done)
{
    gsl_matrix_view all = gsl_matrix_view_array(table, levels, TABLE_MAX);
    gsl_vector_view column = gsl_matrix_column(&all.matrix, done);
    gsl_vector_add_constant(&column.vector, -gsl_stats_mean(table + done, TABLE_MAX, levels));
    double before = gsl_blas_dnrm2(&column.vector), along, n = (double)levels;
    for (size_t k = 0; k < done; k++) {
        gsl_vector_view earlier = gsl_matrix_column(&all.matrix, k);
        gsl_blas_ddot(&earlier.vector, &column.vector, &along);
        gsl_blas_daxpy(-along / n, &earlier.vector, &column.vector);
    }
    double after = gsl_blas_dnrm2(&column.vector);
    gsl_vector_scale(&column.vector, sqrt(n) / after);
    return after * after > COLLINEAR * before * before;
}

/* Set the functions of an input at quantile u. */
static void evaluate_basis(const struct basis *basis, double u, double *values)
{
    if (basis->levels > 0) {
        size_t level = (size_t)fmin(u * (double)basis->levels, (double)(basis->levels - 1));
        memcpy(values, basis->table + level * TABLE_MAX, basis->count * sizeof *values);
        return;
    }
    double x = 2 * u - 1;
    values[0] = sqrt(3) * x;
    values[1] = sqrt(5) * (1.5 * x * x - .5);
}

/* Set the rows of an input's functions, [function][point]. `shift` is added to the quantiles, modulo 1. */
static void fill_basis(const struct ceduo_surface *s, size_t input, double shift, double *functions)
{
    const struct basis *basis = &s->bases[input];
    double values[TABLE_MAX];
    for (size_t p = 0; p < s->points; p++) {
        double u = s->u[p * s->inputs_count + input] + shift;
        evaluate_basis(basis, u - floor(u), values);
        for (size_t k = 0; k < basis->count; k++)
            functions[(basis->first + k) * s->points + p] = values[k];
    }
}

static void make_basis(struct ceduo_surface *s, size_t i)
{
    const struct ceduo_input *input = &s->inputs[i];
    struct basis *basis = &s->bases[i];
    bool words = input->kind == CEDUO_INPUT_WORDS, table = words || input->kind == CEDUO_INPUT_DRAWS;
    size_t columns = !table ? 2 : words ? input->words_count - 1 : 2 * input->places_count;
    *basis = (struct basis){.first = s->functions_count};
    if (table) {
        basis->levels = words ? input->words_count : input->draws_count;
        if (!(basis->table = ceduo_arena_alloc(&s->memory, basis->levels * TABLE_MAX * sizeof *basis->table)))
            return;
    }
    for (size_t c = 0; c < columns && c < TABLE_MAX; c++) {
        for (size_t l = 0; l < basis->levels; l++)
            basis->table[l * TABLE_MAX + basis->count] = table_value(input, c, l);
        bool independent = !table || make_orthonormal(basis->table, basis->levels, basis->count);
        s->input[s->functions_count] = i;
        s->functions_count += independent;
        basis->count += independent;
        basis->linear += independent && (words || c < (table ? input->places_count : 1));
    }
}

static void alloc_parts(struct ceduo_surface *s, struct variance_parts *parts)
{
    parts->n = 2 * s->inputs_count + 1;
    parts->part = ceduo_arena_alloc(&s->memory, parts->n * sizeof *parts->part);
    parts->residual_variance = parts->part ? parts->part + parts->n - 1 : NULL;
}

enum ceduo_status ceduo_surface_open(const struct ceduo_input *inputs, size_t n, const double *u, size_t points,
                                     struct ceduo_surface **made)
{
    GSL_RETURNS_ERRORS;
    *made = NULL;
    if (ceduo_check_inputs(inputs, n, false) != CEDUO_OK)
        return CEDUO_BAD_ARGUMENT;
    struct ceduo_surface *s = *made = calloc(1, sizeof *s);
    if (!s)
        return CEDUO_NO_MEMORY;
    *s = (struct ceduo_surface){.inputs = inputs, .u = u, .points = points, .inputs_count = n, .response.points = points};
    s->bases = ceduo_arena_alloc(&s->memory, (n + 1) * sizeof *s->bases);
    s->input = ceduo_arena_alloc(&s->memory, (n * TABLE_MAX + 1) * sizeof *s->input);
    s->multipliers = ceduo_arena_alloc(&s->memory, SAMPLES * points * sizeof *s->multipliers);
    s->response.y = ceduo_arena_alloc(&s->memory, (GROUPS + 1) * points * sizeof *s->response.y);
    s->used = ceduo_arena_alloc(&s->memory, (n + 1) * sizeof *s->used);
    s->values = ceduo_arena_alloc(&s->memory, points * sizeof *s->values);
    alloc_parts(s, &s->parts);
    alloc_parts(s, &s->resampled);
    s->squares = ceduo_arena_alloc(&s->memory, 2 * s->parts.n * sizeof *s->squares);
    for (size_t b = 0; !s->memory.failed && b < SAMPLES; b++)
        for (size_t p = 0; p < points; p++)
            s->multipliers[b * points + p] = gsl_cdf_ugaussian_Pinv(random_open(b, p, 0, RANDOM_SAMPLE));
    for (size_t i = 0; i < n && !s->memory.failed; i++)
        make_basis(s, i);
    s->function_values = ceduo_arena_alloc(&s->memory, (s->functions_count + 1) * points * sizeof *s->function_values);
    s->scratch = ceduo_arena_alloc(&s->memory, (s->functions_count + TABLE_MAX + 3) * points * sizeof *s->scratch);
    for (size_t i = 0; i < n && !s->memory.failed; i++)
        fill_basis(s, i, 0, s->function_values);
    return s->memory.failed ? CEDUO_NO_MEMORY : CEDUO_OK;
}

static void close_solution(struct solution *f)
{
    gsl_multifit_linear_free(f->workspace);
    ceduo_arena_free(&f->memory);
    *f = (struct solution){0};
}

void ceduo_surface_free(struct ceduo_surface *s)
{
    if (!s)
        return;
    close_solution(&s->solutions[0]);
    close_solution(&s->solutions[1]);
    ceduo_arena_free(&s->memory);
    free(s);
}

/* ---- terms ---- */

static void add_term(struct terms *t, struct term term)
{
    if (t->items)
        t->items[t->n] = term;
    t->n++;
}

static bool is_word(const struct ceduo_surface *s, size_t input)
{
    return s->inputs[input].kind == CEDUO_INPUT_WORDS;
}

/* Add the products of `term`, which has `words` words, with linear functions of the leading inputs from `begin` on. */
static void add_products(const struct ceduo_surface *s, const struct term_set *set, size_t begin, struct term term,
                         size_t words, struct terms *t)
{
    for (size_t c = begin; c < set->leading; c++) {
        const struct basis *basis = &s->bases[set->used[c]];
        size_t all_words = words + is_word(s, set->used[c]);
        if (term.n == 2 && all_words < 2)
            continue;
        for (size_t k = 0; k < basis->linear; k++) {
            struct term product = term;
            product.f[product.n++] = basis->first + k;
            if (product.n > 1)
                add_term(t, product);
            if (product.n < 3)
                add_products(s, set, c + 1, product, all_words, t);
        }
    }
}

/* List the functions of all inputs used, and the products of the leading ones. Return the number of terms. */
static size_t list_terms(const struct ceduo_surface *s, const struct term_set *set, struct terms *t)
{
    for (size_t c = 0; c < set->n; c++)
        for (size_t k = 0; k < (set->linear ? s->bases[set->used[c]].linear : s->bases[set->used[c]].count); k++)
            add_term(t, (struct term){1, {s->bases[set->used[c]].first + k}});
    add_products(s, set, 0, (struct term){0}, 0, t);
    return t->n;
}

/* True if the points suffice for all terms. */
static bool has_enough_points(const struct ceduo_surface *s, const struct term_set *set)
{
    return POINTS_PER_TERM * (double)list_terms(s, set, &(struct terms){0}) <= (double)s->points;
}

static double evaluate_term(const struct ceduo_surface *s, const double *functions, const struct term *term, size_t point)
{
    double x = 1;
    for (size_t k = 0; k < term->n; k++)
        x *= functions[term->f[k] * s->points + point];
    return x;
}

/* ---- one fit ---- */

static int decompose(void *solution)
{
    struct solution *f = solution;
    return gsl_multifit_linear_svd(&f->x.matrix, f->workspace);
}

/* List and decompose the terms, for which the points must suffice. Reuses the last solution of the same terms: the inputs
 * determine their degree. NULL on failure. */
static struct solution *find_solution(struct ceduo_surface *s, const struct term_set *set)
{
    struct solution *f = &s->solutions[set->leading > 0];
    size_t points = s->points, bytes = set->n * sizeof *set->used;
    if (f->set.used && f->set.n == set->n && f->set.leading == set->leading && memcmp(f->set.used, set->used, bytes) == 0)
        return f;
    close_solution(f);
    size_t *used = ceduo_arena_alloc(&f->memory, bytes + 1);
    f->s = s;
    f->terms.items = ceduo_arena_alloc(&f->memory, points * sizeof *f->terms.items);
    if (f->memory.failed)
        return NULL;
    size_t n = list_terms(s, set, &f->terms);
    double *x = ceduo_arena_alloc(&f->memory, points * n * sizeof *x);
    f->means = ceduo_arena_alloc(&f->memory, n * sizeof *f->means);
    f->coefficient = ceduo_arena_alloc(&f->memory, (GROUPS + 1) * n * sizeof *f->coefficient);
    f->delta = ceduo_arena_alloc(&f->memory, n * sizeof *f->delta);
    f->unit_variance = ceduo_arena_alloc(&f->memory, n * sizeof *f->unit_variance);
    f->residuals = ceduo_arena_alloc(&f->memory, (GROUPS + 1) * points * sizeof *f->residuals);
    f->leverage = ceduo_arena_alloc(&f->memory, points * sizeof *f->leverage);
    f->workspace = gsl_multifit_linear_alloc(points, n);
    if (!f->memory.failed)
        f->x = gsl_matrix_view_array(x, points, n);
    for (size_t j = 0; j < n && !f->memory.failed; j++) {
        for (size_t p = 0; p < points; p++)
            x[p * n + j] = evaluate_term(s, s->function_values, &f->terms.items[j], p);
        gsl_vector_view column = gsl_matrix_column(&f->x.matrix, j);
        f->means[j] = gsl_stats_mean(x + j, n, points);
        gsl_vector_add_constant(&column.vector, -f->means[j]);
    }
    if (!f->workspace || f->memory.failed || ceduo_gsl_try(decompose, f) != 0)
        return NULL;
    f->mean = f->coefficient + GROUPS * n;
    f->mean_residuals = f->residuals + GROUPS * points;
    f->set = (struct term_set){memcpy(used, set->used, bytes), set->n, set->leading, true, set->linear};
    return f;
}

/* Set the coefficients of values y at the points. */
static void solve(const struct solution *f, const double *y, double *coefficient)
{
    double ignored[2];
    gsl_vector_const_view values = gsl_vector_const_view_array(y, f->s->points);
    gsl_vector_view to = gsl_vector_view_array(coefficient, f->terms.n);
    gsl_multifit_linear_solve(f->lambda, &f->x.matrix, &values.vector, &to.vector, &ignored[0], &ignored[1], f->workspace);
}

/* Set the ridge with the smallest cross-validation score. GSL's own grid ends at the smallest singular value, which is too
 * strong for orthonormal functions. `scratch`: one number per term. */
static void choose_ridge(struct solution *f, const double *y, double *scratch)
{
    double tried[RIDGES], scores[RIDGES], delta, max = gsl_vector_get(f->workspace->S, 0);
    gsl_vector_view ridges = gsl_vector_view_array(tried, RIDGES), along = gsl_vector_view_array(scratch, f->terms.n);
    gsl_vector_view score = gsl_vector_view_array(scores, RIDGES);
    gsl_vector_const_view values = gsl_vector_const_view_array(y, f->s->points);
    gsl_multifit_linear_gcv_init(&values.vector, &ridges.vector, &along.vector, &delta, f->workspace);
    for (int i = 0; i < RIDGES; i++)
        tried[i] = max * pow(10, -7. * i / (RIDGES - 1));
    gsl_multifit_linear_gcv_curve(&ridges.vector, &along.vector, delta, &score.vector, f->workspace);
    f->lambda = tried[gsl_vector_min_index(&score.vector)];
}

/* Return the mean product of the values of two different groups. Leaves out group `without`; GROUPS: none. */
static double mean_cross_product(const double *values, size_t stride, size_t without)
{
    double sum = 0, squares = 0, n = without < GROUPS ? GROUPS - 1 : GROUPS;
    for (size_t g = 0; g < GROUPS; g++) {
        if (g == without)
            continue;
        sum += values[g * stride];
        squares += values[g * stride] * values[g * stride];
    }
    return (sum * sum - squares) / (n * (n - 1));
}

/* Return the residual variance without noise. Leaves out group `without`; GROUPS: none. */
static double estimate_residual_variance(const struct solution *f, size_t without)
{
    double residual_variance = 0;
    for (size_t p = 0; p < f->s->points; p++)
        residual_variance += mean_cross_product(f->residuals + p, f->s->points, without) / f->dof;
    return fmax(0, residual_variance);
}

/* Return the factor (0…1) by which n values of mean 0 are shrunk to this sum of squares. */
static double compute_shrinkage(double squares, const double *values, size_t n)
{
    double all = gsl_stats_tss_m(values, 1, n, 0);
    return all > 0 ? sqrt(fmin(1, fmax(0, squares) / all)) : 0;
}

/* Fit the current figure. NULL on failure. */
static struct solution *fit_terms(struct ceduo_surface *s, const struct term_set *set)
{
    struct solution *f = find_solution(s, set);
    if (!f)
        return NULL;
    size_t points = s->points, n = f->terms.n;
    const double *y = s->response.y;
    f->dof = (double)points - 1;
    memset(f->unit_variance, 0, n * sizeof *f->unit_variance);
    choose_ridge(f, y + GROUPS * points, f->delta);
    memset(f->delta, 0, n * sizeof *f->delta);
    for (size_t p = 0; p < points; p++)
        f->leverage[p] = 1 / (double)points;
    for (size_t k = 0; k < n && gsl_vector_get(f->workspace->S, k) > 0; k++) { /* sorted, largest first */
        double sigma = gsl_vector_get(f->workspace->S, k), ridge = sigma * sigma + f->lambda * f->lambda;
        double keep = sigma * sigma / ridge; /* ridge filter factor */
        f->dof -= keep * (2 - keep);
        for (size_t j = 0; j < n; j++)
            f->unit_variance[j] += pow(gsl_matrix_get(f->workspace->Q, j, k) * sigma / ridge, 2);
        for (size_t p = 0; p < points; p++)
            f->leverage[p] += pow(gsl_matrix_get(f->workspace->A, p, k), 2) * keep;
    }
    for (size_t p = 0; p < points; p++)
        f->leverage[p] = fmin(f->leverage[p], .99);
    for (size_t g = 0; g <= GROUPS; g++) {
        gsl_vector_const_view values = gsl_vector_const_view_array(y + g * points, points);
        gsl_vector_view coefficient = gsl_vector_view_array(f->coefficient + g * n, n);
        gsl_vector_view residuals = gsl_vector_view_array(f->residuals + g * points, points);
        solve(f, y + g * points, coefficient.vector.data);
        gsl_multifit_linear_residuals(&f->x.matrix, &values.vector, &coefficient.vector, &residuals.vector);
    }
    f->residual_variance = estimate_residual_variance(f, GROUPS);
    f->shrinkage = compute_shrinkage(f->residual_variance * f->dof, f->mean_residuals, points);
    return f;
}

/* ---- values ---- */

/* Set the current figure from the groups of each point. n figures are added up. */
static void set_response(struct response *c, const struct ceduo_replicates *groups, size_t n)
{
    double common = 0, *mean = c->y + GROUPS * c->points;
    memset(c->y, 0, (GROUPS + 1) * c->points * sizeof *c->y);
    c->means[GROUPS] = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        double *y = c->y + g * c->points;
        for (size_t i = 0; i < n * c->points; i++)
            y[i % c->points] += groups[i].value[g];
        c->means[g] = gsl_stats_mean(y, 1, c->points);
        c->means[GROUPS] += c->means[g] / GROUPS; /* exactly 0 if the groups cancel */
        for (size_t p = 0; p < c->points; p++) {
            y[p] -= c->means[g];
            mean[p] += y[p] / GROUPS;
        }
    }
    for (size_t p = 0; p < c->points; p++)
        common += mean_cross_product(c->y + p, c->points, GROUPS);
    c->variance = fmax(0, common) / ((double)c->points - 1);
    c->noise = fmax(0, gsl_stats_variance_m(mean, 1, c->points, 0) - common / ((double)c->points - 1));
    c->residuals = c->y;
    c->shrinkage = compute_shrinkage(common, mean, c->points);
}

static void clamp_values(const struct response *c, double *values)
{
    for (size_t i = 0; i < c->points; i++)
        values[i] = fmin(c->figure->hi, fmax(c->figure->lo, values[i]));
}

/* Set the value at each point: the mean of the groups with its residual shrunk. */
static void read_values(const struct response *c, double *values)
{
    for (size_t p = 0; p < c->points; p++)
        values[p] = c->means[GROUPS] + c->y[GROUPS * c->points + p] - (1 - c->shrinkage) * c->residuals[GROUPS * c->points + p];
    clamp_values(c, values);
}

/* Return 1 if a group is in a balanced half sample, otherwise -1. Half samples 1…GROUPS - 1 are orthogonal (Hadamard). */
static double half_sample_sign(size_t half, size_t group)
{
    return __builtin_parityll(half & group) ? -1 : 1;
}

/* Set the difference of the values of a half sample to those of all groups. The other half has the negative. */
static void read_half_sample(const struct response *c, size_t half, double *changes)
{
    memset(changes, 0, c->points * sizeof *changes);
    for (size_t g = 0; g < GROUPS; g++) {
        double side = half_sample_sign(half, g) / GROUPS;
        for (size_t p = 0; p < c->points; p++)
            changes[p] += side * (c->means[g] + c->y[g * c->points + p] - (1 - c->shrinkage) * c->residuals[g * c->points + p]);
    }
}

enum statistic { P5, P50, P95, BELOW, STATISTICS };

/* Set the quantiles of n values, and the share at or below `limit`. Sorts the values. */
static void read_statistics(double *values, size_t n, double limit, double statistics[STATISTICS])
{
    size_t below = 0;
    gsl_sort(values, 1, n);
    while (below < n && values[below] <= limit)
        below++;
    statistics[P5] = ceduo_quantile(values, n, .05), statistics[P50] = ceduo_quantile(values, n, .5);
    statistics[P95] = ceduo_quantile(values, n, .95), statistics[BELOW] = isnan(limit) ? NAN : (double)below / (double)n;
}

/* Return the factor of a variance estimated from GROUPS groups, so that 1.96 standard errors cover 95 % (Student's t). */
static double student_factor(void)
{
    return pow(gsl_cdf_tdist_Pinv(.975, GROUPS - 1) / CEDUO_Z95, 2);
}

/* Statistics of the values, for bootstrap samples of the points, and differences of complementary half samples of the rocks.
 * Half samples (McCarthy 1969) are used because a jackknife is inconsistent for quantiles. */
struct band {
    double statistics[STATISTICS], samples[SAMPLES][STATISTICS], halves[GROUPS - 1][STATISTICS];
};

static void read_band(const struct ceduo_surface *s, struct band *band)
{
    const struct response *c = &s->response;
    double *values = s->scratch, *changes = values + c->points, *shifted = changes + c->points, statistics[2][STATISTICS];
    read_values(c, values);
    for (size_t half = 1; half < GROUPS; half++) {
        read_half_sample(c, half, changes);
        for (int side = 0; side < 2; side++) {
            for (size_t p = 0; p < c->points; p++)
                shifted[p] = values[p] + (side ? -changes[p] : changes[p]);
            clamp_values(c, shifted);
            read_statistics(shifted, c->points, c->figure->limit, statistics[side]);
        }
        for (size_t i = 0; i < STATISTICS; i++)
            band->halves[half - 1][i] = statistics[0][i] - statistics[1][i];
    }
    read_statistics(values, c->points, c->figure->limit, band->statistics);
}

static double band_se(const struct band *b, enum statistic i)
{
    double sampling = gsl_stats_tss_m(&b->halves[0][i], STATISTICS, GROUPS - 1, 0) / 4 / (GROUPS - 1);
    return sqrt(gsl_stats_variance(&b->samples[0][i], STATISTICS, SAMPLES) + sampling * student_factor());
}

/* ---- shares ---- */

/* Return part i as a share of the variance. If the variance is below the noise, the noise is added: shares are then near 0. */
static double variance_share(const struct variance_parts *p, double noise, size_t i)
{
    double variance = fmax(0, p->explained) + *p->residual_variance;
    return p->part[i] / (variance + (variance < noise ? noise : 0));
}

/* Set the parts without one group (GROUPS: with all). `delta` changes the coefficients; may be NULL. */
static void set_parts(const struct solution *f, size_t without, double residual_variance, const double *delta,
                      struct variance_parts *parts)
{
    const struct ceduo_surface *s = f->s;
    memset(parts->part, 0, parts->n * sizeof *parts->part);
    parts->explained = 0;
    *parts->residual_variance = residual_variance;
    for (size_t j = 0; j < f->terms.n; j++) {
        const struct term *term = &f->terms.items[j];
        double variance = mean_cross_product(f->coefficient + j, f->terms.n, without) - residual_variance * f->unit_variance[j];
        if (delta)
            variance += delta[j] * (2 * f->mean[j] + delta[j]) - f->residual_variance * f->unit_variance[j];
        parts->explained += variance;
        for (size_t k = 0; k < term->n; k++) {
            size_t input = s->input[term->f[k]];
            parts->part[s->inputs_count + input] += variance;
            parts->part[input] += term->n == 1 ? variance : 0;
        }
    }
}

/* Set the parts of a wild bootstrap sample, and f->delta: the shrunk residuals are redrawn and fitted. */
static void bootstrap_parts(const struct solution *f, size_t sample, struct variance_parts *parts)
{
    const struct ceduo_surface *s = f->s;
    const double *multiplier = s->multipliers + sample * s->points;
    double residual_variance = 0;
    for (size_t p = 0; p < s->points; p++) {
        double drawn = f->shrinkage * f->mean_residuals[p] * multiplier[p];
        s->values[p] = drawn / sqrt(1 - f->leverage[p]);
        residual_variance += drawn * drawn / f->dof;
    }
    solve(f, s->values, f->delta);
    set_parts(f, GROUPS, f->residual_variance, f->delta, parts);
    *parts->residual_variance = residual_variance;
}

/* Set s->values to a bootstrap sample: the surface with f->delta at randomly shifted points, plus resampled residuals.
 * Without a fit (`f` NULL) resample `values`. */
static void bootstrap_values(const struct ceduo_surface *s, const struct solution *f, size_t sample, const double *values)
{
    for (size_t i = 0; f && i < f->set.n; i++) {
        size_t input = f->set.used[i];
        fill_basis(s, input, random_pair(sample, SHIFT, input, RANDOM_SAMPLE).u[0], s->scratch);
    }
    for (size_t p = 0; p < s->points; p++) {
        size_t q = (size_t)(random_pair(sample, p, 0, RANDOM_SAMPLE).u[1] * (double)s->points);
        s->values[p] =
            f ? s->response.means[GROUPS] + f->shrinkage * f->mean_residuals[q] / sqrt(1 - f->leverage[q]) : values[q];
    }
    for (size_t j = 0; f && j < f->terms.n; j++)
        for (size_t p = 0; p < s->points; p++)
            s->values[p] += (f->mean[j] + f->delta[j]) * (evaluate_term(s, s->scratch, &f->terms.items[j], p) - f->means[j]);
    clamp_values(&s->response, s->values);
}

/* ---- range if an input were known ---- */

/* Set the slope of the surface in each function of `input`, at each point. */
static void fill_slopes(const struct solution *f, size_t input, double *delta)
{
    const struct ceduo_surface *s = f->s;
    const struct basis *basis = &s->bases[input];
    memset(delta, 0, basis->count * s->points * sizeof *delta);
    for (size_t j = 0; j < f->terms.n; j++) {
        const struct term *term = &f->terms.items[j];
        for (size_t k = 0; k < term->n; k++) {
            if (s->input[term->f[k]] != input)
                continue;
            struct term rest = *term;
            rest.f[k] = rest.f[--rest.n];
            double *row = delta + (term->f[k] - basis->first) * s->points;
            for (size_t p = 0; p < s->points; p++)
                row[p] += f->mean[j] * evaluate_term(s, s->function_values, &rest, p);
        }
    }
}

/* Return the expected p95 - p5 of the values if an input were known. */
static double expected_width(const struct solution *f, const double *values, size_t input)
{
    const struct ceduo_surface *s = f->s;
    const struct basis *basis = &s->bases[input];
    double *delta = s->scratch, *shifted = delta + TABLE_MAX * s->points, functions[TABLE_MAX], statistics[STATISTICS],
           width = 0;
    size_t n = basis->levels > 0 && basis->levels < KNOWN_VALUES ? basis->levels : KNOWN_VALUES;
    fill_slopes(f, input, delta);
    for (size_t i = 0; i < n; i++) {
        evaluate_basis(basis, ((double)i + .5) / (double)n, functions);
        memcpy(shifted, values, s->points * sizeof *shifted);
        for (size_t k = 0; k < basis->count; k++)
            for (size_t p = 0; p < s->points; p++)
                shifted[p] +=
                    delta[k * s->points + p] * (functions[k] - s->function_values[(basis->first + k) * s->points + p]);
        clamp_values(&s->response, shifted);
        read_statistics(shifted, s->points, NAN, statistics);
        width += (statistics[P95] - statistics[P5]) / (double)n;
    }
    return width;
}

/* ---- the fit ---- */

static void read_quality(const struct solution *f, struct ceduo_surface_fit *fit)
{
    const double *y = f->s->response.y;
    size_t points = f->s->points;
    double left_out = 0, squares = 0, common[2] = {0};
    for (size_t p = 0; p < points; p++) {
        double keep = 1 - f->leverage[p];
        left_out += pow(f->mean_residuals[p] / keep, 2);
        squares += pow(y[GROUPS * points + p], 2);
        common[0] += mean_cross_product(f->residuals + p, points, GROUPS) / (keep * keep);
        common[1] += mean_cross_product(y + p, points, GROUPS);
    }
    fit->q2 = 1 - left_out / squares;
    fit->explained = 1 - fmax(0, common[0]) / common[1];
}

/* Add the squared differences of the shares. */
static void add_squares(const struct variance_parts *a, const struct variance_parts *b, double noise, double *sums)
{
    for (size_t i = 0; i < a->n; i++)
        sums[i] += pow(variance_share(a, noise, i) - variance_share(b, noise, i), 2);
}

/* Set the shares, the quantiles of the values, the errors of both, and the widths. `f` NULL: no surface. */
static void read_fit(struct ceduo_surface *s, struct solution *f, struct ceduo_surface_fit *fit)
{
    struct variance_parts *parts = &s->parts, *resampled = &s->resampled;
    double *jackknife = s->squares, *bootstrap = jackknife + parts->n;
    struct band band;
    memset(s->squares, 0, 2 * parts->n * sizeof *s->squares);
    if (f) {
        set_parts(f, GROUPS, f->residual_variance, NULL, parts);
        s->response.residuals = f->residuals, s->response.shrinkage = f->shrinkage;
        fit->variance = fmax(0, parts->explained) + f->residual_variance;
        read_quality(f, fit);
    }
    for (size_t g = 0; f && g < GROUPS; g++) {
        set_parts(f, g, estimate_residual_variance(f, g), NULL, resampled);
        add_squares(resampled, parts, fit->noise, jackknife);
    }
    read_band(s, &band);
    read_values(&s->response, fit->values);
    for (size_t b = 0; b < SAMPLES; b++) {
        if (f && f->shrinkage > 0) {
            bootstrap_parts(f, b, resampled);
            add_squares(resampled, parts, fit->noise, bootstrap);
        }
        bootstrap_values(s, f, b, fit->values);
        read_statistics(s->values, s->points, s->response.figure->limit, band.samples[b]);
    }
    fit->p5 = band.statistics[P5], fit->p50 = band.statistics[P50], fit->p95 = band.statistics[P95];
    fit->p5_se = band_se(&band, P5), fit->p95_se = band_se(&band, P95);
    fit->share_below = (struct ceduo_share){band.statistics[BELOW], band_se(&band, BELOW)};
    for (size_t i = 0; f && i < parts->n; i++)
        fit->first[i] =
            (struct ceduo_share){variance_share(parts, fit->noise, i),
                                 sqrt(jackknife[i] * student_factor() * (GROUPS - 1) / GROUPS + bootstrap[i] / SAMPLES)};
    fit->unexplained = fit->first[parts->n - 1];
    for (size_t i = 0; f && i < s->inputs_count; i++) /* the expected width cannot exceed the current one */
        fit->width_if_known[i] = fmin(expected_width(f, fit->values, i), fit->p95 - fit->p5);
}

/* Sort the inputs by their variance in a fit without products, largest first. Words come first, because they decide what
 * other inputs do. Return false on failure of memory. */
static bool rank_inputs(struct ceduo_surface *s, const struct term_set *set)
{
    const struct solution *f = fit_terms(s, &(const struct term_set){.used = set->used, .n = set->n, .linear = set->linear});
    double *total = s->parts.part + s->inputs_count;
    size_t *used = set->used;
    if (!f)
        return false;
    set_parts(f, GROUPS, f->residual_variance, NULL, &s->parts);
    for (size_t i = 0; i < set->n; i++) {
        total[used[i]] = is_word(s, used[i]) ? -INFINITY : -total[used[i]];
        ceduo_insert_index(total, used[i], i, used);
    }
    return true;
}

/* Choose the inputs with products. Return false on failure of memory. */
static bool choose_terms(struct ceduo_surface *s, struct term_set *set)
{
    const bool *uses = s->response.figure->uses;
    *set = (struct term_set){.used = s->used};
    for (size_t i = 0; i < s->inputs_count; i++)
        if ((!uses || uses[i]) && s->bases[i].count > 0)
            set->used[set->n++] = i;
    if (!(s->response.variance > 0) || set->n == 0)
        return true;
    set->linear = !has_enough_points(s, set);
    set->enough_points = has_enough_points(s, set);
    if (!set->enough_points)
        return true;
    struct term_set tried = *set;
    for (tried.leading = set->n; !has_enough_points(s, &tried);) /* ends at 0 */
        tried.leading--;
    set->leading = tried.leading;
    double best = -INFINITY;
    bool good = true, ranked = false;
    /* Products of unimportant inputs may alias important ones: try fewer, and keep the best fit. */
    for (; good && tried.leading > 0 && best < CEDUO_UNCERTAINTY_EXPLAINED; tried.leading /= 2) {
        struct ceduo_surface_fit fit = {.explained = -INFINITY};
        if (!ranked && tried.leading < set->n)
            good = ranked = rank_inputs(s, &tried);
        const struct solution *f = good ? fit_terms(s, &tried) : NULL;
        good = f;
        if (f)
            read_quality(f, &fit);
        if (fit.explained > best)
            best = fit.explained, set->leading = tried.leading;
    }
    return good;
}

/* Allocate the arrays of a fit in one block. */
static bool allocate_fit(struct ceduo_surface_fit *fit, size_t points, size_t n)
{
    fit->first = malloc((2 * n + 1) * sizeof *fit->first + (n + points) * sizeof(double));
    if (!fit->first)
        return false;
    fit->total = fit->first + n;
    fit->width_if_known = (double *)(fit->first + 2 * n + 1);
    fit->values = fit->width_if_known + n;
    for (size_t i = 0; i <= 2 * n; i++)
        fit->first[i] = (struct ceduo_share){NAN, NAN};
    for (size_t i = 0; i < n; i++)
        fit->width_if_known[i] = NAN;
    return true;
}

enum ceduo_status ceduo_surface_fit(struct ceduo_surface *s, const struct ceduo_surface_figure *figure,
                                    struct ceduo_surface_fit *fit)
{
    GSL_RETURNS_ERRORS;
    struct term_set set;
    struct solution *f = NULL;
    *fit = (struct ceduo_surface_fit){.q2 = NAN, .explained = NAN};
    s->response.figure = figure;
    set_response(&s->response, figure->y, 1);
    fit->mean = s->response.means[GROUPS], fit->variance = s->response.variance, fit->noise = s->response.noise;
    bool good = allocate_fit(fit, s->points, s->inputs_count) && choose_terms(s, &set);
    fit->enough_points = good && set.enough_points;
    fit->linear = good && set.linear;
    if (fit->enough_points)
        good = (f = fit_terms(s, &set));
    if (good)
        read_fit(s, f, fit);
    if (!good)
        ceduo_surface_release(fit);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

void ceduo_surface_release(struct ceduo_surface_fit *fit)
{
    free(fit->first);
    *fit = (struct ceduo_surface_fit){0};
}

/* ---- values alone ---- */

enum ceduo_status ceduo_surface_values(struct ceduo_surface *s, const struct ceduo_surface_figure *figure, size_t n,
                                       double *values, struct ceduo_replicates *changes)
{
    GSL_RETURNS_ERRORS;
    struct term_set set;
    s->response.figure = figure;
    set_response(&s->response, figure->y, n); /* choose terms by the sum of the figures */
    if (!choose_terms(s, &set))
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n; i++) {
        set_response(&s->response, figure->y + i * s->points, 1);
        if (set.enough_points && s->response.shrinkage > 0) {
            const struct solution *f = fit_terms(s, &set);
            if (!f)
                return CEDUO_NO_MEMORY;
            s->response.residuals = f->residuals, s->response.shrinkage = f->shrinkage;
        }
        read_values(&s->response, values + i * s->points);
        for (size_t half = 1; half < GROUPS; half++) {
            read_half_sample(&s->response, half, s->values);
            for (size_t p = 0; p < s->points; p++)
                changes[i * s->points + p].value[half] = s->values[p];
        }
    }
    return CEDUO_OK;
}

/* The half samples are orthogonal, so their differences determine those of the groups. */
void ceduo_replicates_from_half_samples(struct ceduo_replicates *groups, double value,
                                        const double changes[CEDUO_SURFACE_GROUPS])
{
    for (size_t g = 0; g < GROUPS; g++) {
        groups->value[g] = value;
        for (size_t half = 1; half < GROUPS; half++)
            groups->value[g] += half_sample_sign(half, g) * changes[half];
    }
}
