/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface through a figure's values at points. Each input has functions with mean 0 and variance 1 over what it may be; those of
 * words and of a calibration's rows are tables. Terms are products of them, so that a coefficient's square is a part of the
 * variance. Terms are fitted by least squares; a ridge, chosen by generalised cross-validation, keeps many terms from following
 * the noise. Where there are too many terms for the points, a fit without products ranks the inputs, and only the leading ones
 * keep theirs.
 *
 * The rocks are in groups, the same at every point, and each group is fitted by itself: products of two groups' estimates have no
 * noise of the rocks on the mean. What the terms leave, all groups have in common; it is taken off by its own variance. Errors
 * are of two kinds. What the rocks leave open comes from leaving out one group after the other (jackknife); as the rocks are the
 * same everywhere, more points would not take it off. What the terms leave at a point comes from a bootstrap that draws its sign
 * and size (Wu 1986), as the fit is linear in it. */
#include "ceduo/surface.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "ceduo/doubt.h"
#include "ceduo/statistics.h"

#define GROUPS      CEDUO_SURFACE_GROUPS
#define COORDINATES 40  /* of GSL's Sobol' points */
#define PER_TERM    2.5 /* points that a term needs */
#define SAMPLES     64  /* of the bootstrap */
#define CLASSES     8   /* values of an input that is taken as known */
#define TABLE_MAX   12  /* functions of an input that is a table */
#define RIDGES      56  /* that are tried */
#define SAME        1e-8

/* ---- points ---- */

/* Uniform in [0, 1), by seed, row and column. */
static double hashed(uint64_t seed, uint64_t row, uint64_t column)
{
    uint64_t hash = HASH_START;
    hash_count(&hash, seed);
    hash_count(&hash, row);
    hash_count(&hash, column);
    hash_count(&hash, column); /* once more: the last one mixed in reaches the high bits only */
    return (double)(hash >> 11) * 0x1p-53;
}

enum ceduo_status ceduo_surface_points(uint64_t seed, size_t points, size_t inputs, double *u)
{
    double sobol[COORDINATES];
    size_t coordinates = inputs < COORDINATES ? inputs : COORDINATES;
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)coordinates);
    if (!sequence)
        return CEDUO_NO_MEMORY;
    for (size_t row = 0; row < points; row++) {
        gsl_qrng_get(sequence, sobol);
        for (size_t i = 0; i < inputs; i++) {
            double x = i < coordinates ? sobol[i] + hashed(seed, UINT64_MAX, i) : hashed(seed, row, i);
            u[row * inputs + i] = x - floor(x);
        }
    }
    gsl_qrng_free(sequence);
    return CEDUO_OK;
}

/* ---- functions of one input ---- */

struct function {
    size_t input;
    int degree;
    double *at; /* its value at each point */
};

/* An input's functions, `count` from `first` on. */
struct inputs_functions {
    size_t first, count, levels; /* levels: of a table; 0: a range */
    double *table;               /* a row of functions for each level */
};

struct ceduo_surface {
    const struct ceduo_input *inputs;
    const double *u;
    size_t points, inputs_count, functions_count;
    struct inputs_functions *of;
    struct function *functions;
    double *values;      /* of all functions */
    double *multipliers; /* of the bootstrap: normal, of each sample for each point */
};

static size_t levels_of(const struct ceduo_input *input)
{
    return input->kind == CEDUO_INPUT_WORDS ? input->words_count : input->kind == CEDUO_INPUT_DRAWS ? input->draws_count : 0;
}

/* Columns that functions are made of: of words one for each but the last, of rows the values of each place and their squares. */
static size_t columns_of(const struct ceduo_input *input)
{
    size_t n = input->kind == CEDUO_INPUT_WORDS ? input->words_count - 1 : 2 * input->places_count;
    return n < TABLE_MAX ? n : TABLE_MAX;
}

static double column_at(const struct ceduo_input *input, size_t column, size_t level)
{
    if (input->kind == CEDUO_INPUT_WORDS)
        return level == column;
    size_t places = input->places_count, n = input->draws_count;
    const double *values = input->draws[column % places];
    double sd = gsl_stats_sd(values, 1, n), x = sd > 0 ? (values[level] - gsl_stats_mean(values, 1, n)) / sd : 0;
    return column < places ? x : x * x;
}

/* Makes a column orthonormal to the constant and to the `done` columns before it; false where nothing of it is left. */
static bool make_orthonormal(double *table, size_t levels, size_t stride, size_t done)
{
    double before = 0, after = 0, mean = 0, n = (double)levels;
    for (size_t l = 0; l < levels; l++)
        mean += table[l * stride + done] / n;
    for (size_t l = 0; l < levels; l++) {
        table[l * stride + done] -= mean;
        before += table[l * stride + done] * table[l * stride + done] / n;
    }
    for (size_t k = 0; k < done; k++) {
        double along = 0;
        for (size_t l = 0; l < levels; l++)
            along += table[l * stride + k] * table[l * stride + done] / n;
        for (size_t l = 0; l < levels; l++)
            table[l * stride + done] -= along * table[l * stride + k];
    }
    for (size_t l = 0; l < levels; l++)
        after += table[l * stride + done] * table[l * stride + done] / n;
    for (size_t l = 0; l < levels; l++)
        table[l * stride + done] /= sqrt(after);
    return after > SAME * before && after > 0;
}

/* Fills the table of an input of levels and the degrees of its functions. */
static void fill_table(const struct ceduo_input *input, struct inputs_functions *of, struct function *functions)
{
    size_t columns = columns_of(input);
    of->count = 0;
    for (size_t c = 0; c < columns; c++) {
        for (size_t l = 0; l < of->levels; l++)
            of->table[l * TABLE_MAX + of->count] = column_at(input, c, l);
        if (!make_orthonormal(of->table, of->levels, TABLE_MAX, of->count))
            continue;
        functions[of->count].degree = input->kind == CEDUO_INPUT_WORDS || c < input->places_count ? 1 : 2;
        of->count++;
    }
}

/* The functions of an input at quantile u. */
static void functions_at(const struct inputs_functions *of, double u, double *values)
{
    if (of->levels > 0) {
        size_t level = (size_t)fmin(u * (double)of->levels, (double)(of->levels - 1));
        memcpy(values, of->table + level * TABLE_MAX, of->count * sizeof *values);
        return;
    }
    double x = 2 * u - 1;
    values[0] = sqrt(3) * x;
    values[1] = sqrt(5) * (1.5 * x * x - .5);
}

enum ceduo_status ceduo_surface_open(const struct ceduo_input *inputs, size_t n, const double *u, size_t points,
                                     struct ceduo_surface **made)
{
    size_t room = 0;
    for (size_t i = 0; i < n; i++)
        room += levels_of(&inputs[i]) > 0 ? columns_of(&inputs[i]) : 2;
    struct ceduo_surface *s = calloc(1, sizeof *s);
    if (!(*made = s))
        return CEDUO_NO_MEMORY;
    *s = (struct ceduo_surface){.inputs = inputs, .u = u, .points = points, .inputs_count = n};
    s->of = calloc(n, sizeof *s->of);
    s->functions = calloc(room + 1, sizeof *s->functions);
    s->values = malloc((room * points + 1) * sizeof *s->values);
    s->multipliers = malloc(SAMPLES * points * sizeof *s->multipliers);
    if (!s->of || !s->functions || !s->values || !s->multipliers)
        return CEDUO_NO_MEMORY;
    for (size_t b = 0; b < SAMPLES; b++)
        for (size_t p = 0; p < points; p++)
            s->multipliers[b * points + p] = gsl_cdf_ugaussian_Pinv(hashed(b, p, 0) * (1 - 0x1p-53) + 0x1p-54);
    for (size_t i = 0; i < n; i++) {
        struct inputs_functions *of = &s->of[i];
        *of = (struct inputs_functions){.first = s->functions_count, .count = 2, .levels = levels_of(&inputs[i])};
        struct function *functions = s->functions + of->first;
        functions[0].degree = 1, functions[1].degree = 2;
        if (of->levels > 0 && !(of->table = malloc(of->levels * TABLE_MAX * sizeof *of->table)))
            return CEDUO_NO_MEMORY;
        if (of->levels > 0)
            fill_table(&inputs[i], of, functions);
        for (size_t k = 0; k < of->count; k++) {
            functions[k].input = i;
            functions[k].at = s->values + (of->first + k) * points;
        }
        for (size_t p = 0; p < points; p++) {
            double values[TABLE_MAX];
            functions_at(of, u[p * n + i], values);
            for (size_t k = 0; k < of->count; k++)
                functions[k].at[p] = values[k];
        }
        s->functions_count += of->count;
    }
    return CEDUO_OK;
}

void ceduo_surface_free(struct ceduo_surface *s)
{
    for (size_t i = 0; s && s->of && i < s->inputs_count; i++)
        free(s->of[i].table);
    if (s) {
        free(s->of);
        free(s->functions);
        free(s->values);
        free(s->multipliers);
    }
    free(s);
}

/* ---- terms ---- */

struct term {
    size_t n, f[3]; /* functions that it is the product of */
};

struct terms {
    size_t n, room;
    struct term *items;
};

static void add_term(struct terms *t, struct term term)
{
    if (t->n < t->room)
        t->items[t->n] = term;
    t->n++;
}

static bool is_word(const struct ceduo_surface *s, size_t input)
{
    return s->inputs[input].kind == CEDUO_INPUT_WORDS;
}

/* Products of the functions of degree 1 of inputs from `at` on, in `chosen`, with those of `term`. */
static void add_products(const struct ceduo_surface *s, const size_t *chosen, size_t chosen_count, size_t at, struct term term,
                         size_t words, struct terms *t)
{
    for (size_t c = at; c < chosen_count; c++) {
        const struct inputs_functions *of = &s->of[chosen[c]];
        size_t all_words = words + is_word(s, chosen[c]);
        if (term.n == 2 && all_words < 2)
            continue;
        for (size_t k = 0; k < of->count; k++) {
            if (s->functions[of->first + k].degree > 1)
                continue;
            struct term product = term;
            product.f[product.n++] = of->first + k;
            if (product.n > 1)
                add_term(t, product);
            if (product.n < 3)
                add_products(s, chosen, chosen_count, c + 1, product, all_words, t);
        }
    }
}

/* All terms of the inputs `used`, in order of rank; only the first `leading` have products. More than there is room for are
 * counted only. */
static void list_terms(const struct ceduo_surface *s, const size_t *used, size_t used_count, size_t leading, struct terms *t)
{
    t->n = 0;
    for (size_t c = 0; c < used_count; c++)
        for (size_t k = 0; k < s->of[used[c]].count; k++)
            add_term(t, (struct term){1, {s->of[used[c]].first + k}});
    add_products(s, used, leading, 0, (struct term){0}, 0, t);
}

static double term_at(const struct ceduo_surface *s, const struct term *term, size_t point)
{
    double x = 1;
    for (size_t k = 0; k < term->n; k++)
        x *= s->functions[term->f[k]].at[point];
    return x;
}

/* ---- one fit ---- */

/* Terms with their values at the points, less their means, and the fit's decomposition U S V'. */
struct solution {
    const struct ceduo_surface *s;
    struct terms terms;
    gsl_matrix *x;
    gsl_multifit_linear_workspace *work;
    double lambda;
    double *means;       /* of the terms */
    double *coefficient; /* of each group's terms, then of their mean */
    double *remains;     /* of each group at each point, then of their mean */
    double *leverage;    /* of each point */
    double *spread;      /* the variance of each coefficient where the values have variance 1 */
    double *room;        /* as many as there are terms */
    double freedom;
};

static double filter(const struct solution *f, size_t k)
{
    double sigma = gsl_vector_get(f->work->S, k);
    return sigma > 0 ? sigma * sigma / (sigma * sigma + f->lambda * f->lambda) : 0;
}

static void fill_matrix(struct solution *f)
{
    size_t points = f->s->points;
    for (size_t j = 0; j < f->terms.n; j++) {
        f->means[j] = 0;
        for (size_t p = 0; p < points; p++) {
            double value = term_at(f->s, &f->terms.items[j], p);
            gsl_matrix_set(f->x, p, j, value);
            f->means[j] += value / (double)points;
        }
        for (size_t p = 0; p < points; p++)
            *gsl_matrix_ptr(f->x, p, j) -= f->means[j];
    }
}

/* Coefficients of values y at the points: V filter(S)/S U' y. */
static void solve(const struct solution *f, const double *y, double *coefficient)
{
    size_t n = f->terms.n, points = f->s->points;
    double *along = f->room;
    memset(along, 0, n * sizeof *along);
    for (size_t p = 0; p < points; p++) {
        const double *row = gsl_matrix_const_ptr(f->work->A, p, 0);
        for (size_t k = 0; k < n; k++)
            along[k] += row[k] * y[p];
    }
    for (size_t k = 0; k < n; k++)
        along[k] *= filter(f, k) > 0 ? filter(f, k) / gsl_vector_get(f->work->S, k) : 0;
    for (size_t j = 0; j < n; j++) {
        const double *row = gsl_matrix_const_ptr(f->work->Q, j, 0);
        coefficient[j] = 0;
        for (size_t k = 0; k < n; k++)
            coefficient[j] += row[k] * along[k];
    }
}

/* The variance of each coefficient where the values have variance 1. */
static double spread_of(const struct solution *f, size_t j)
{
    double sum = 0;
    for (size_t k = 0; k < f->terms.n; k++) {
        double x = filter(f, k) > 0 ? gsl_matrix_get(f->work->Q, j, k) * filter(f, k) / gsl_vector_get(f->work->S, k) : 0;
        sum += x * x;
    }
    return sum;
}

static void close_solution(struct solution *f)
{
    free(f->terms.items);
    if (f->x)
        gsl_matrix_free(f->x);
    if (f->work)
        gsl_multifit_linear_free(f->work);
    free(f->means);
    free(f->remains);
}

/* Takes the ridge of the least score. GSL's own search ends at the smallest singular value, which of orthonormal functions is a
 * strong ridge already. False without memory. */
static bool choose_ridge(struct solution *f, const double *y)
{
    gsl_vector *room = gsl_vector_alloc(RIDGES), *along = gsl_vector_alloc(f->terms.n);
    gsl_vector_const_view view = gsl_vector_const_view_array(y, f->s->points);
    double delta, best = INFINITY, max = gsl_vector_get(f->work->S, 0);
    bool good = room && along && gsl_multifit_linear_gcv_init(&view.vector, room, along, &delta, f->work) == 0;
    for (int i = 0; good && i <= RIDGES; i++) {
        double lambda = max * pow(10, -7. * i / RIDGES), score = gsl_multifit_linear_gcv_calc(lambda, along, delta, f->work);
        if (score < best) {
            best = score;
            f->lambda = lambda;
        }
    }
    if (room)
        gsl_vector_free(room);
    if (along)
        gsl_vector_free(along);
    return good;
}

static double *coefficients_of(const struct solution *f, size_t group)
{
    return f->coefficient + group * f->terms.n;
}

static double *remains_of(const struct solution *f, size_t group)
{
    return f->remains + group * f->s->points;
}

static bool allocate(struct solution *f, size_t points, size_t n)
{
    f->terms.items = calloc(n, sizeof *f->terms.items);
    f->x = gsl_matrix_alloc(points, n);
    f->work = gsl_multifit_linear_alloc(points, n);
    f->means = malloc((3 + GROUPS + 1) * n * sizeof *f->means);
    f->remains = malloc((GROUPS + 2) * points * sizeof *f->remains);
    if (!f->terms.items || !f->x || !f->work || !f->means || !f->remains)
        return false;
    f->terms.room = n;
    f->spread = f->means + n, f->room = f->means + 2 * n, f->coefficient = f->means + 3 * n;
    f->leverage = f->remains + (GROUPS + 1) * points;
    return true;
}

/* Fits the values y of each group and of their mean, which have mean 0, by terms; close it in any case. */
static enum ceduo_status open_solution(struct solution *f, const struct ceduo_surface *s, const size_t *used, size_t used_count,
                                       size_t leading, const double *y)
{
    size_t points = s->points;
    *f = (struct solution){.s = s, .freedom = (double)points - 1};
    list_terms(s, used, used_count, leading, &f->terms);
    size_t n = f->terms.n;
    if (!allocate(f, points, n))
        return CEDUO_NO_MEMORY;
    list_terms(s, used, used_count, leading, &f->terms);
    fill_matrix(f);
    if (gsl_multifit_linear_svd(f->x, f->work) != 0 || !choose_ridge(f, y + GROUPS * points))
        return CEDUO_NO_MEMORY;
    for (size_t k = 0; k < n; k++)
        f->freedom -= filter(f, k) * (2 - filter(f, k));
    for (size_t j = 0; j < n; j++)
        f->spread[j] = spread_of(f, j);
    for (size_t p = 0; p < points; p++) {
        f->leverage[p] = 1 / (double)points;
        for (size_t k = 0; k < n; k++)
            f->leverage[p] += gsl_matrix_get(f->work->A, p, k) * gsl_matrix_get(f->work->A, p, k) * filter(f, k);
        f->leverage[p] = fmin(f->leverage[p], .99);
    }
    for (size_t g = 0; g <= GROUPS; g++) {
        double *coefficient = coefficients_of(f, g), *remains = remains_of(f, g);
        solve(f, y + g * points, coefficient);
        for (size_t p = 0; p < points; p++) {
            remains[p] = y[g * points + p];
            for (size_t j = 0; j < n; j++)
                remains[p] -= gsl_matrix_get(f->x, p, j) * coefficient[j];
        }
    }
    return CEDUO_OK;
}

/* ---- shares ---- */

/* The mean of the products of two different groups' values, `stride` apart; `without`: but for those of one (GROUPS: of all). */
static double common_of(const double *values, size_t stride, size_t without)
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

/* The variance of each input's terms, alone and with others, of all terms, and what the terms leave. */
struct parts {
    double *first, *total, all, spare;
};

/* The share of the variance that part i is: of each input alone, of each input in all, and of what the terms leave. */
static double share_of(const struct parts *p, size_t inputs, double noise, size_t i)
{
    double whole = fmax(0, p->all) + p->spare, part = i < inputs       ? p->first[i]
                                                      : i < 2 * inputs ? p->total[i - inputs]
                                                                       : p->spare;
    return part / (whole + (whole < noise ? noise : 0)); /* of what is less than the noise it is close to 0 */
}

static void add_part(const struct solution *f, size_t j, double variance, struct parts *parts)
{
    const struct term *term = &f->terms.items[j];
    parts->all += variance;
    for (size_t k = 0; k < term->n; k++) {
        size_t input = f->s->functions[term->f[k]].input;
        parts->total[input] += variance;
        if (term->n == 1)
            parts->first[input] += variance;
    }
}

static void clear_parts(struct parts *parts, size_t inputs)
{
    memset(parts->first, 0, inputs * sizeof *parts->first);
    memset(parts->total, 0, inputs * sizeof *parts->total);
    parts->all = parts->spare = 0;
}

/* From all groups, or but for one. */
static void fill_parts(const struct solution *f, size_t without, struct parts *parts)
{
    clear_parts(parts, f->s->inputs_count);
    for (size_t p = 0; p < f->s->points; p++)
        parts->spare += common_of(f->remains + p, f->s->points, without) / f->freedom;
    parts->spare = fmax(0, parts->spare);
    for (size_t j = 0; j < f->terms.n; j++)
        add_part(f, j, common_of(f->coefficient + j, f->terms.n, without) - parts->spare * f->spread[j], parts);
}

/* With what the terms leave at each point drawn anew; `kept` is its part of the remains, without noise. */
static void draw_parts(const struct solution *f, size_t sample, double kept, double *drawn, double *coefficient,
                       const struct parts *found, struct parts *parts)
{
    const struct ceduo_surface *s = f->s;
    const double *mean = remains_of(f, GROUPS), *multiplier = s->multipliers + sample * s->points;
    clear_parts(parts, s->inputs_count);
    for (size_t p = 0; p < s->points; p++) {
        drawn[p] = kept * mean[p] / sqrt(1 - f->leverage[p]) * multiplier[p];
        parts->spare += kept * kept * mean[p] * mean[p] * multiplier[p] * multiplier[p] / f->freedom;
    }
    solve(f, drawn, coefficient);
    for (size_t j = 0; j < f->terms.n; j++) {
        double change = coefficient[j] * (2 * coefficients_of(f, GROUPS)[j] + coefficient[j]) - found->spare * f->spread[j];
        add_part(f, j, common_of(f->coefficient + j, f->terms.n, GROUPS) - found->spare * f->spread[j] + change, parts);
    }
}

/* How much of the remains of the mean is not noise. */
static double kept_of(const struct solution *f, double spare)
{
    double squares = 0;
    for (size_t p = 0; p < f->s->points; p++)
        squares += remains_of(f, GROUPS)[p] * remains_of(f, GROUPS)[p] / f->freedom;
    return squares > 0 ? sqrt(fmin(1, spare / squares)) : 0;
}

/* Shares with their errors. */
static void read_shares(const struct solution *f, struct parts *found, struct parts *other, double kept, double *room,
                        struct ceduo_surface_fit *fit)
{
    size_t inputs = f->s->inputs_count, points = f->s->points;
    for (size_t i = 0; i <= 2 * inputs; i++) {
        struct ceduo_share *share = i < inputs ? &fit->first[i] : i < 2 * inputs ? &fit->total[i - inputs] : &fit->whole;
        *share = (struct ceduo_share){share_of(found, inputs, fit->noise, i), 0};
    }
    double *of_rocks = room + points + f->terms.n, *of_points = of_rocks + 2 * inputs + 1;
    memset(of_rocks, 0, 2 * (2 * inputs + 1) * sizeof *of_rocks);
    for (size_t g = 0; g < GROUPS; g++) {
        fill_parts(f, g, other);
        for (size_t i = 0; i <= 2 * inputs; i++)
            of_rocks[i] += pow(share_of(other, inputs, fit->noise, i) - share_of(found, inputs, fit->noise, i), 2);
    }
    for (size_t b = 0; kept > 0 && b < SAMPLES; b++) {
        draw_parts(f, b, kept, room, room + points, found, other);
        for (size_t i = 0; i <= 2 * inputs; i++)
            of_points[i] += pow(share_of(other, inputs, fit->noise, i) - share_of(found, inputs, fit->noise, i), 2);
    }
    double student = pow(gsl_cdf_tdist_Pinv(.975, GROUPS - 1) / CEDUO_Z95, 2); /* of few groups: 1.96 errors hold 95 % */
    for (size_t i = 0; i <= 2 * inputs; i++) {
        struct ceduo_share *share = i < inputs ? &fit->first[i] : i < 2 * inputs ? &fit->total[i - inputs] : &fit->whole;
        share->se = sqrt(of_rocks[i] * student * (GROUPS - 1) / GROUPS + of_points[i] / SAMPLES);
    }
}

/* ---- what is left ---- */

static double quantile_of(const double *sorted, size_t n, double p)
{
    return gsl_stats_quantile_from_sorted_data(sorted, 1, n, p);
}

static double width_of(double *values, size_t n)
{
    gsl_sort(values, 1, n);
    return quantile_of(values, n, .95) - quantile_of(values, n, .05);
}

static void bound(double *values, size_t n, const struct ceduo_surface_fit *fit)
{
    for (size_t i = 0; i < n; i++)
        values[i] = fmin(fit->hi, fmax(fit->lo, values[i]));
}

/* What a function of `input` changes at each point: the sum of the terms that it is in, divided by it. */
static void add_changes(const struct solution *f, size_t input, double *change)
{
    const struct ceduo_surface *s = f->s;
    const struct inputs_functions *of = &s->of[input];
    memset(change, 0, of->count * s->points * sizeof *change);
    for (size_t j = 0; j < f->terms.n; j++) {
        const struct term *term = &f->terms.items[j];
        for (size_t k = 0; k < term->n; k++) {
            if (s->functions[term->f[k]].input != input)
                continue;
            struct term rest = *term;
            rest.f[k] = rest.f[--rest.n];
            double *row = change + (term->f[k] - of->first) * s->points;
            for (size_t p = 0; p < s->points; p++)
                row[p] += coefficients_of(f, GROUPS)[j] * term_at(s, &rest, p);
        }
    }
}

/* p95 - p5 of what remains, on the mean, if an input is known. */
static double left_of(const struct solution *f, const struct ceduo_surface_fit *fit, size_t input, double *room)
{
    const struct ceduo_surface *s = f->s;
    const struct inputs_functions *of = &s->of[input];
    double *change = room, *changed = room + TABLE_MAX * s->points, at[TABLE_MAX], width = 0;
    size_t n = of->levels > 0 && of->levels < CLASSES ? of->levels : CLASSES;
    add_changes(f, input, change);
    for (size_t c = 0; c < n; c++) {
        functions_at(of, ((double)c + .5) / (double)n, at);
        memcpy(changed, fit->values, s->points * sizeof *changed);
        for (size_t k = 0; k < of->count; k++)
            for (size_t p = 0; p < s->points; p++)
                changed[p] += change[k * s->points + p] * (at[k] - s->functions[of->first + k].at[p]);
        bound(changed, s->points, fit);
        width += width_of(changed, s->points) / (double)n;
    }
    return width;
}

/* ---- the fit ---- */

static void read_quality(const struct solution *f, const double *y, struct ceduo_surface_fit *fit)
{
    size_t points = f->s->points;
    double left_out = 0, squares = 0, common[2] = {0};
    for (size_t p = 0; p < points; p++) {
        double keep = 1 - f->leverage[p];
        left_out += pow(remains_of(f, GROUPS)[p] / keep, 2);
        squares += pow(y[GROUPS * points + p], 2);
        common[0] += common_of(f->remains + p, points, GROUPS) / (keep * keep);
        common[1] += common_of(y + p, points, GROUPS);
    }
    fit->q2 = 1 - left_out / squares;
    fit->explained = common[1] > 0 ? 1 - fmax(0, common[0]) / common[1] : 0;
}

static enum ceduo_status read_solution(const struct solution *f, const double *y, struct ceduo_surface_fit *fit)
{
    size_t points = f->s->points, inputs = f->s->inputs_count, n = f->terms.n;
    double *room = malloc(((TABLE_MAX + 1) * points + n + 8 * inputs + 2) * sizeof *room);
    if (!room)
        return CEDUO_NO_MEMORY;
    struct parts found = {.first = room, .total = room + inputs},
                 other = {.first = room + 2 * inputs, .total = room + 3 * inputs};
    fill_parts(f, GROUPS, &found);
    double kept = kept_of(f, found.spare), *rest = room + 4 * inputs;
    fit->variance = fmax(0, found.all) + found.spare;
    read_quality(f, y, fit);
    read_shares(f, &found, &other, kept, rest, fit);
    for (size_t p = 0; p < points; p++) /* the surface, and what of its remainder is not noise */
        fit->values[p] = fit->mean + y[GROUPS * points + p] - (1 - kept) * remains_of(f, GROUPS)[p];
    for (size_t i = 0; i < inputs; i++)
        fit->left[i] = left_of(f, fit, i, rest);
    free(room);
    return CEDUO_OK;
}

/* How many of the ranked inputs can have products. */
static size_t leading_of(const struct ceduo_surface *s, const size_t *used, size_t used_count)
{
    struct terms terms = {0};
    size_t leading = used_count;
    for (; leading > 0; leading--) {
        list_terms(s, used, used_count, leading, &terms);
        if (PER_TERM * (double)terms.n <= (double)s->points)
            break;
    }
    return leading;
}

/* Sorts the inputs by the variance that they bring in a fit without products, the most first. */
static enum ceduo_status rank(const struct ceduo_surface *s, const double *y, size_t *used, size_t used_count)
{
    struct solution f;
    enum ceduo_status status = open_solution(&f, s, used, used_count, 0, y);
    double *room = malloc(2 * s->inputs_count * sizeof *room);
    struct parts parts = {.first = room, .total = room + s->inputs_count};
    if (status == CEDUO_OK && room) {
        fill_parts(&f, GROUPS, &parts);
        for (size_t i = 0; i < used_count; i++) {
            size_t input = used[i], at = i;
            for (; at > 0 && parts.total[used[at - 1]] < parts.total[input]; at--)
                used[at] = used[at - 1];
            used[at] = input;
        }
    }
    status = room ? status : CEDUO_NO_MEMORY;
    free(room);
    close_solution(&f);
    return status;
}

static enum ceduo_status fit_terms(const struct ceduo_surface *s, size_t *used, size_t used_count, const double *y,
                                   struct ceduo_surface_fit *fit)
{
    struct solution f;
    bool all = leading_of(s, used, used_count) == used_count;
    enum ceduo_status status = all ? CEDUO_OK : rank(s, y, used, used_count);
    if (status != CEDUO_OK)
        return status;
    status = open_solution(&f, s, used, used_count, leading_of(s, used, used_count), y);
    if (status == CEDUO_OK)
        status = read_solution(&f, y, fit);
    close_solution(&f);
    return status;
}

/* The groups' values and their mean less their means over all points, as the same rocks are at every point and groups differ by
 * a constant; and the values alone: what varies, without noise. */
static void begin_fit(const struct ceduo_surface *s, const struct ceduo_groups *groups, double *y,
                      struct ceduo_surface_fit *fit)
{
    double points = (double)s->points, squares = 0, common = 0;
    memset(y, 0, (GROUPS + 1) * s->points * sizeof *y);
    for (size_t g = 0; g < GROUPS; g++) {
        double mean = 0;
        for (size_t p = 0; p < s->points; p++)
            mean += groups[p].of[g] / points;
        fit->mean += mean / GROUPS;
        for (size_t p = 0; p < s->points; p++) {
            y[g * s->points + p] = groups[p].of[g] - mean;
            y[GROUPS * s->points + p] += (groups[p].of[g] - mean) / GROUPS;
        }
    }
    for (size_t p = 0; p < s->points; p++) {
        squares += pow(y[GROUPS * s->points + p], 2);
        common += common_of(y + p, s->points, GROUPS);
    }
    fit->variance = fmax(0, common) / (points - 1);
    fit->noise = fmax(0, squares - common) / (points - 1);
    for (size_t p = 0; p < s->points; p++)
        fit->values[p] = fit->mean + (squares > 0 ? sqrt(fmin(1, fmax(0, common) / squares)) : 0) * y[GROUPS * s->points + p];
    for (size_t i = 0; i < s->inputs_count; i++) {
        fit->first[i] = fit->total[i] = (struct ceduo_share){NAN, NAN};
        fit->left[i] = NAN;
    }
}

enum ceduo_status ceduo_surface_fit(const struct ceduo_surface *s, const bool *uses, const struct ceduo_groups *groups,
                                    double lo, double hi, struct ceduo_surface_fit *fit)
{
    size_t points = s->points, n = s->inputs_count, used_count = 0;
    *fit = (struct ceduo_surface_fit){.lo = lo, .hi = hi, .q2 = NAN, .explained = NAN, .whole = {NAN, NAN}};
    double *y = malloc((GROUPS + 1) * points * sizeof *y);
    size_t *used = calloc(n + 1, sizeof *used);
    fit->values = malloc(points * sizeof *fit->values);
    fit->first = calloc(2 * n + 1, sizeof *fit->first);
    fit->left = calloc(n + 1, sizeof *fit->left);
    fit->total = fit->first + n;
    enum ceduo_status status = y && used && fit->values && fit->first && fit->left ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK) {
        struct terms singles = {0};
        begin_fit(s, groups, y, fit);
        for (size_t i = 0; i < n; i++)
            if ((!uses || uses[i]) && s->of[i].count > 0)
                used[used_count++] = i;
        list_terms(s, used, used_count, 0, &singles);
        fit->enough = singles.n > 0 && fit->variance > 0 && PER_TERM * (double)singles.n <= (double)points;
        if (fit->enough)
            status = fit_terms(s, used, used_count, y, fit);
    }
    if (status == CEDUO_OK) {
        bound(fit->values, points, fit);
        memcpy(y, fit->values, points * sizeof *y);
        gsl_sort(y, 1, points);
        fit->p5 = quantile_of(y, points, .05);
        fit->p50 = quantile_of(y, points, .5);
        fit->p95 = quantile_of(y, points, .95);
    }
    free(y);
    free(used);
    if (status != CEDUO_OK)
        ceduo_surface_release(fit);
    return status;
}

void ceduo_surface_release(struct ceduo_surface_fit *fit)
{
    free(fit->values);
    free(fit->first);
    free(fit->left);
    *fit = (struct ceduo_surface_fit){0};
}
