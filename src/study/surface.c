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

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_qrng.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
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
#define ENOUGH      CEDUO_DOUBT_EXPLAINED

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
    GSL_RETURNS_ERRORS;
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

struct term {
    size_t n, f[3]; /* functions that it is the product of */
};

struct terms {
    size_t n, room;
    struct term *items;
};

/* Terms with their values at the points, less their means, decomposed as U S V'. */
struct basis {
    size_t *used, used_count, leading; /* of which inputs, see list_terms() */
    struct terms terms;
    gsl_matrix *x;
    gsl_multifit_linear_workspace *work;
    double *means;
};

struct ceduo_surface {
    const struct ceduo_input *inputs;
    const double *u;
    size_t points, inputs_count, functions_count;
    struct inputs_functions *of;
    struct function *functions;
    double *values;        /* of all functions */
    double *multipliers;   /* of the bootstrap: normal, of each sample for each point */
    struct basis bases[2]; /* the last ones, without and with products */
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
    GSL_RETURNS_ERRORS;
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

static void close_basis(struct basis *b)
{
    free(b->used);
    free(b->terms.items);
    gsl_matrix_free(b->x);
    gsl_multifit_linear_free(b->work);
    free(b->means);
    *b = (struct basis){0};
}

void ceduo_surface_free(struct ceduo_surface *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < 2; i++)
        close_basis(&s->bases[i]);
    for (size_t i = 0; s->of && i < s->inputs_count; i++)
        free(s->of[i].table);
    free(s->of);
    free(s->functions);
    free(s->values);
    free(s->multipliers);
    free(s);
}

/* ---- terms ---- */

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

/* Terms that are fitted to the values of a figure. */
struct solution {
    const struct ceduo_surface *s;
    struct basis b; /* the surface's */
    double lambda;
    double *coefficient; /* of each group's terms, then of their mean */
    double *remains;     /* of each group at each point, then of their mean */
    double *leverage;    /* of each point */
    double *spread;      /* the variance of each coefficient where the values have variance 1 */
    double *room;        /* as many as there are terms */
    double freedom;
};

static double filter(const struct solution *f, size_t k)
{
    double sigma = gsl_vector_get(f->b.work->S, k);
    return sigma > 0 ? sigma * sigma / (sigma * sigma + f->lambda * f->lambda) : 0;
}

static void fill_matrix(const struct ceduo_surface *s, struct basis *b)
{
    for (size_t j = 0; j < b->terms.n; j++) {
        b->means[j] = 0;
        for (size_t p = 0; p < s->points; p++) {
            double value = term_at(s, &b->terms.items[j], p);
            gsl_matrix_set(b->x, p, j, value);
            b->means[j] += value / (double)s->points;
        }
        for (size_t p = 0; p < s->points; p++)
            *gsl_matrix_ptr(b->x, p, j) -= b->means[j];
    }
}

/* The arguments of gsl_multifit_linear_svd(). */
struct decomposed {
    gsl_matrix *x;
    gsl_multifit_linear_workspace *work;
};

static int decompose(void *context)
{
    struct decomposed *d = context;
    return gsl_multifit_linear_svd(d->x, d->work);
}

/* The basis of these terms: the one that was made last, or a new one. */
static enum ceduo_status open_basis(struct ceduo_surface *s, const size_t *used, size_t used_count, size_t leading,
                                    struct basis *out)
{
    struct basis *b = &s->bases[leading > 0];
    if (b->work && b->used_count == used_count && b->leading == leading &&
        memcmp(b->used, used, used_count * sizeof *used) == 0) {
        *out = *b;
        return CEDUO_OK;
    }
    close_basis(b);
    *b = (struct basis){.used_count = used_count, .leading = leading};
    list_terms(s, used, used_count, leading, &b->terms);
    size_t n = b->terms.room = b->terms.n;
    b->used = calloc(used_count + 1, sizeof *b->used);
    b->terms.items = calloc(n, sizeof *b->terms.items);
    b->x = gsl_matrix_alloc(s->points, n);
    b->means = malloc(n * sizeof *b->means);
    gsl_multifit_linear_workspace *work = gsl_multifit_linear_alloc(s->points, n);
    if (b->used && b->terms.items && b->x && b->means && work) {
        memcpy(b->used, used, used_count * sizeof *used);
        list_terms(s, used, used_count, leading, &b->terms);
        fill_matrix(s, b);
        if (ceduo_gsl_try(decompose, &(struct decomposed){b->x, work}) == 0)
            b->work = work;
    }
    if (!b->work)
        gsl_multifit_linear_free(work);
    *out = *b;
    return b->work ? CEDUO_OK : CEDUO_NO_MEMORY;
}

/* Coefficients of values y at the points: V filter(S)/S U' y. */
static void solve(const struct solution *f, const double *y, double *coefficient)
{
    size_t n = f->b.terms.n;
    gsl_vector_const_view values = gsl_vector_const_view_array(y, f->s->points);
    gsl_vector_view along = gsl_vector_view_array(f->room, n), to = gsl_vector_view_array(coefficient, n);
    gsl_blas_dgemv(CblasTrans, 1, f->b.work->A, &values.vector, 0, &along.vector);
    for (size_t k = 0; k < n; k++)
        f->room[k] *= filter(f, k) > 0 ? filter(f, k) / gsl_vector_get(f->b.work->S, k) : 0;
    gsl_blas_dgemv(CblasNoTrans, 1, f->b.work->Q, &along.vector, 0, &to.vector);
}

static void close_solution(struct solution *f)
{
    free(f->coefficient);
    free(f->remains);
}

/* Takes the ridge of the least score. GSL's own search ends at the smallest singular value, which of orthonormal functions is a
 * strong ridge already. False without memory. */
static bool choose_ridge(struct solution *f, const double *y)
{
    gsl_vector *room = gsl_vector_alloc(RIDGES), *along = gsl_vector_alloc(f->b.terms.n);
    gsl_vector_const_view view = gsl_vector_const_view_array(y, f->s->points);
    double delta, best = INFINITY, max = gsl_vector_get(f->b.work->S, 0);
    bool good = room && along && gsl_multifit_linear_gcv_init(&view.vector, room, along, &delta, f->b.work) == 0;
    for (int i = 0; good && i <= RIDGES; i++) {
        double lambda = max * pow(10, -7. * i / RIDGES), score = gsl_multifit_linear_gcv_calc(lambda, along, delta, f->b.work);
        if (score < best) {
            best = score;
            f->lambda = lambda;
        }
    }
    gsl_vector_free(room);
    gsl_vector_free(along);
    return good;
}

static double *coefficients_of(const struct solution *f, size_t group)
{
    return f->coefficient + group * f->b.terms.n;
}

static double *remains_of(const struct solution *f, size_t group)
{
    return f->remains + group * f->s->points;
}

/* Fits the values y of each group and of their mean, which have mean 0, by terms; close it in any case. */
static enum ceduo_status open_solution(struct solution *f, struct ceduo_surface *s, const size_t *used, size_t used_count,
                                       size_t leading, const double *y)
{
    size_t points = s->points;
    *f = (struct solution){.s = s, .freedom = (double)points - 1};
    enum ceduo_status status = open_basis(s, used, used_count, leading, &f->b);
    if (status != CEDUO_OK)
        return status;
    size_t n = f->b.terms.n;
    f->coefficient = malloc((GROUPS + 1 + 2) * n * sizeof *f->coefficient);
    f->remains = malloc((GROUPS + 2) * points * sizeof *f->remains);
    if (!f->coefficient || !f->remains || !choose_ridge(f, y + GROUPS * points))
        return CEDUO_NO_MEMORY;
    f->spread = f->coefficient + (GROUPS + 1) * n, f->room = f->spread + n;
    f->leverage = f->remains + (GROUPS + 1) * points;
    for (size_t k = 0; k < n; k++)
        f->freedom -= filter(f, k) * (2 - filter(f, k));
    for (size_t j = 0; j < n; j++) {
        f->spread[j] = 0;
        for (size_t k = 0; k < n && filter(f, k) > 0; k++) { /* the smallest singular values are the last */
            double x = gsl_matrix_get(f->b.work->Q, j, k) * filter(f, k) / gsl_vector_get(f->b.work->S, k);
            f->spread[j] += x * x;
        }
    }
    for (size_t p = 0; p < points; p++) {
        f->leverage[p] = 1 / (double)points;
        for (size_t k = 0; k < n; k++)
            f->leverage[p] += gsl_matrix_get(f->b.work->A, p, k) * gsl_matrix_get(f->b.work->A, p, k) * filter(f, k);
        f->leverage[p] = fmin(f->leverage[p], .99);
    }
    for (size_t g = 0; g <= GROUPS; g++) {
        double *coefficient = coefficients_of(f, g), *remains = remains_of(f, g);
        solve(f, y + g * points, coefficient);
        for (size_t p = 0; p < points; p++) {
            remains[p] = y[g * points + p];
            for (size_t j = 0; j < n; j++)
                remains[p] -= gsl_matrix_get(f->b.x, p, j) * coefficient[j];
        }
    }
    return CEDUO_OK;
}

/* ---- values ---- */

static void bound(double *values, size_t n, double lo, double hi)
{
    for (size_t i = 0; i < n; i++)
        values[i] = fmin(hi, fmax(lo, values[i]));
}

/* A figure's values at the points, of each group and of their mean (GROUPS), less their means over the points: as the same rocks
 * are at every point, groups differ by a constant. */
struct column {
    double *y, means[GROUPS + 1];
};

/* At each point the mean of the groups less what of the remainder is noise. */
static void read_values(const struct column *c, size_t points, const double *remains, double kept,
                        const struct ceduo_surface_figure *figure, double *values)
{
    for (size_t p = 0; p < points; p++)
        values[p] = c->means[GROUPS] + c->y[GROUPS * points + p] - (1 - kept) * remains[GROUPS * points + p];
    bound(values, points, figure->lo, figure->hi);
}

/* Half of the groups, 1…GROUPS - 1: any two halves have half of theirs in common. */
static double side_of(size_t half, size_t group)
{
    return __builtin_parityll(half & group) ? -1 : 1;
}

/* What the values of half of the groups are above those of all; those of the other half are as much below. */
static void read_changes(const struct column *c, size_t points, const double *remains, double kept, size_t half,
                         double *changes)
{
    memset(changes, 0, points * sizeof *changes);
    for (size_t g = 0; g < GROUPS; g++) {
        double side = side_of(half, g) / GROUPS;
        for (size_t p = 0; p < points; p++)
            changes[p] += side * (c->means[g] + c->y[g * points + p] - (1 - kept) * remains[g * points + p]);
    }
}

/* What is read of values. */
enum end { P5, P50, P95, BELOW, ENDS };
struct ends {
    double of[ENDS];
};

static struct ends read_ends(double *values, size_t n, double limit)
{
    size_t below = 0;
    gsl_sort(values, 1, n);
    while (below < n && values[below] <= limit)
        below++;
    return (struct ends){{ceduo_quantile(values, n, .05), ceduo_quantile(values, n, .5), ceduo_quantile(values, n, .95),
                          isnan(limit) ? NAN : (double)below / (double)n}};
}

/* The error of a mean of so few groups: 1.96 of it hold 95 %. */
static double student(void)
{
    return pow(gsl_cdf_tdist_Pinv(.975, GROUPS - 1) / CEDUO_Z95, 2);
}

/* Errors of what is read of the values: by samples of the points, and by halves of the rocks against each other, as what is read
 * of sorted values turns at single ones (balanced half samples, McCarthy 1969). */
struct ends_errors {
    double sum[ENDS], squares[ENDS], of_rocks[ENDS];
};

static void add_sample(struct ends_errors *e, struct ends found, struct ends other)
{
    for (size_t i = 0; i < ENDS; i++) {
        double change = other.of[i] - found.of[i];
        e->sum[i] += change;
        e->squares[i] += change * change;
    }
}

static double ends_se(const struct ends_errors *e, size_t i)
{
    double mean = e->sum[i] / SAMPLES, of_points = fmax(0, e->squares[i] / SAMPLES - mean * mean) * SAMPLES / (SAMPLES - 1);
    return sqrt(of_points + e->of_rocks[i] * student());
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

/* The variance of each input's terms, alone and then with others, and last what the terms leave; that of all terms. */
struct parts {
    size_t inputs;
    double *of, all, *spare;
};
#define PARTS(inputs) (2 * (inputs) + 1)

static struct parts parts_in(double *room, size_t inputs)
{
    return (struct parts){inputs, room, 0, room + 2 * inputs};
}

/* The share of the variance that part i is. */
static double share_of(const struct parts *p, double noise, size_t i)
{
    double whole = fmax(0, p->all) + *p->spare;
    return p->of[i] / (whole + (whole < noise ? noise : 0)); /* of what is less than the noise it is close to 0 */
}

static void add_part(const struct solution *f, size_t j, double variance, struct parts *parts)
{
    const struct term *term = &f->b.terms.items[j];
    parts->all += variance;
    for (size_t k = 0; k < term->n; k++) {
        size_t input = f->s->functions[term->f[k]].input;
        parts->of[parts->inputs + input] += variance;
        if (term->n == 1)
            parts->of[input] += variance;
    }
}

static void clear_parts(struct parts *parts)
{
    memset(parts->of, 0, PARTS(parts->inputs) * sizeof *parts->of);
    parts->all = 0;
}

/* What the terms leave, from all groups, or but for one. */
static double spare_of(const struct solution *f, size_t without)
{
    double spare = 0;
    for (size_t p = 0; p < f->s->points; p++)
        spare += common_of(f->remains + p, f->s->points, without) / f->freedom;
    return fmax(0, spare);
}

static void fill_parts(const struct solution *f, size_t without, struct parts *parts)
{
    clear_parts(parts);
    *parts->spare = spare_of(f, without);
    for (size_t j = 0; j < f->b.terms.n; j++)
        add_part(f, j, common_of(f->coefficient + j, f->b.terms.n, without) - *parts->spare * f->spread[j], parts);
}

/* With what the terms leave at each point drawn anew; `kept` is its part of the remains, without noise. */
static void draw_parts(const struct solution *f, size_t sample, double kept, double *drawn, double *coefficient,
                       const struct parts *found, struct parts *parts)
{
    const struct ceduo_surface *s = f->s;
    const double *mean = remains_of(f, GROUPS), *multiplier = s->multipliers + sample * s->points;
    clear_parts(parts);
    for (size_t p = 0; p < s->points; p++) {
        drawn[p] = kept * mean[p] / sqrt(1 - f->leverage[p]) * multiplier[p];
        *parts->spare += kept * kept * mean[p] * mean[p] * multiplier[p] * multiplier[p] / f->freedom;
    }
    solve(f, drawn, coefficient);
    for (size_t j = 0; j < f->b.terms.n; j++) {
        double change = coefficient[j] * (2 * coefficients_of(f, GROUPS)[j] + coefficient[j]) - *found->spare * f->spread[j];
        add_part(f, j, common_of(f->coefficient + j, f->b.terms.n, GROUPS) - *found->spare * f->spread[j] + change, parts);
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

/* Values of the surface at points shifted at random, with its coefficients changed and the remainder of any point. */
static void draw_values(const struct solution *f, size_t sample, double kept, const double *change,
                        const struct ceduo_surface_figure *figure, double mean, double *room, double *values)
{
    const struct ceduo_surface *s = f->s;
    size_t points = s->points;
    for (size_t c = 0; c < f->b.used_count; c++) {
        const struct inputs_functions *of = &s->of[f->b.used[c]];
        double shift = hashed(sample, UINT64_MAX, f->b.used[c]), at[TABLE_MAX];
        for (size_t p = 0; p < points; p++) {
            double u = s->u[p * s->inputs_count + f->b.used[c]] + shift;
            functions_at(of, u - floor(u), at);
            for (size_t k = 0; k < of->count; k++)
                room[(of->first + k) * points + p] = at[k];
        }
    }
    for (size_t p = 0; p < points; p++) {
        size_t other = (size_t)(hashed(sample, p, 1) * (double)points);
        values[p] = mean + kept * remains_of(f, GROUPS)[other] / sqrt(1 - f->leverage[other]);
    }
    for (size_t j = 0; j < f->b.terms.n; j++) {
        const struct term *term = &f->b.terms.items[j];
        double coefficient = coefficients_of(f, GROUPS)[j] + change[j];
        const double *at[3];
        for (size_t k = 0; k < term->n; k++)
            at[k] = room + term->f[k] * points;
        for (size_t p = 0; p < points; p++) {
            double x = at[0][p];
            for (size_t k = 1; k < term->n; k++)
                x *= at[k][p];
            values[p] += coefficient * (x - f->b.means[j]);
        }
    }
    bound(values, points, figure->lo, figure->hi);
}

/* Where the errors of a fit are computed. */
struct errors_room {
    double *drawn, *change, *functions, *values, *of_rocks, *of_points;
};

/* Shares with their errors, and those of what is read of the values. */
static void read_shares(const struct solution *f, struct parts *found, struct parts *other, double kept,
                        const struct ceduo_surface_figure *figure, const struct errors_room *room,
                        struct ceduo_surface_fit *fit, struct ends ends, struct ends_errors *errors)
{
    size_t parts = PARTS(f->s->inputs_count), n = f->b.terms.n;
    memset(room->of_rocks, 0, parts * sizeof *room->of_rocks);
    memset(room->of_points, 0, parts * sizeof *room->of_points);
    for (size_t g = 0; g < GROUPS; g++) {
        fill_parts(f, g, other);
        for (size_t i = 0; i < parts; i++)
            room->of_rocks[i] += pow(share_of(other, fit->noise, i) - share_of(found, fit->noise, i), 2);
    }
    memset(room->change, 0, n * sizeof *room->change);
    for (size_t b = 0; b < SAMPLES; b++) {
        if (kept > 0) {
            draw_parts(f, b, kept, room->drawn, room->change, found, other);
            for (size_t i = 0; i < parts; i++)
                room->of_points[i] += pow(share_of(other, fit->noise, i) - share_of(found, fit->noise, i), 2);
        }
        draw_values(f, b, kept, room->change, figure, fit->mean, room->functions, room->values);
        add_sample(errors, ends, read_ends(room->values, f->s->points, figure->limit));
    }
    for (size_t i = 0; i < parts; i++)
        fit->first[i] =
            (struct ceduo_share){share_of(found, fit->noise, i),
                                 sqrt(room->of_rocks[i] * student() * (GROUPS - 1) / GROUPS + room->of_points[i] / SAMPLES)};
    fit->whole = fit->first[parts - 1];
}

/* ---- what is left ---- */

/* What a function of `input` changes at each point: the sum of the terms that it is in, divided by it. */
static void add_changes(const struct solution *f, size_t input, double *change)
{
    const struct ceduo_surface *s = f->s;
    const struct inputs_functions *of = &s->of[input];
    memset(change, 0, of->count * s->points * sizeof *change);
    for (size_t j = 0; j < f->b.terms.n; j++) {
        const struct term *term = &f->b.terms.items[j];
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
        bound(changed, s->points, fit->lo, fit->hi);
        struct ends ends = read_ends(changed, s->points, NAN);
        width += (ends.of[P95] - ends.of[P5]) / (double)n;
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

/* What is read of the values, and its errors by the rocks; `room`: three values for each point. */
static struct ends read_band(const struct column *c, size_t points, const double *remains, double kept,
                             const struct ceduo_surface_figure *figure, double *room, struct ends_errors *errors)
{
    double *values = room, *changes = room + points, *changed = room + 2 * points;
    read_values(c, points, remains, kept, figure, values);
    for (size_t half = 1; half < GROUPS; half++) {
        struct ends ends[2];
        read_changes(c, points, remains, kept, half, changes);
        for (int other = 0; other < 2; other++) {
            for (size_t p = 0; p < points; p++)
                changed[p] = values[p] + (other ? -changes[p] : changes[p]);
            bound(changed, points, figure->lo, figure->hi);
            ends[other] = read_ends(changed, points, figure->limit);
        }
        for (size_t i = 0; i < ENDS; i++) {
            double between = ends[0].of[i] - ends[1].of[i];
            errors->of_rocks[i] += between * between / 4 / (GROUPS - 1);
        }
    }
    return read_ends(values, points, figure->limit);
}

static void set_band(struct ceduo_surface_fit *fit, struct ends ends, const struct ends_errors *errors)
{
    fit->p5 = ends.of[P5], fit->p50 = ends.of[P50], fit->p95 = ends.of[P95];
    fit->p5_se = ends_se(errors, P5), fit->p95_se = ends_se(errors, P95);
    fit->below = (struct ceduo_share){ends.of[BELOW], ends_se(errors, BELOW)};
}

static enum ceduo_status read_solution(const struct solution *f, const struct column *c,
                                       const struct ceduo_surface_figure *figure, struct ceduo_surface_fit *fit)
{
    size_t points = f->s->points, inputs = f->s->inputs_count, n = f->b.terms.n;
    size_t parts = PARTS(inputs);
    double *room = malloc(((f->s->functions_count + TABLE_MAX + 5) * points + n + 4 * parts) * sizeof *room);
    if (!room)
        return CEDUO_NO_MEMORY;
    struct parts found = parts_in(room, inputs), other = parts_in(room + parts, inputs);
    double *rest = room + 2 * parts, *change = rest + 2 * parts;
    const struct errors_room errors_room = {.of_rocks = rest,
                                            .of_points = rest + parts,
                                            .change = change,
                                            .drawn = change + n,
                                            .values = change + n + points,
                                            .functions = change + n + 2 * points};
    struct ends_errors errors = {0};
    fill_parts(f, GROUPS, &found);
    double kept = kept_of(f, *found.spare);
    fit->variance = fmax(0, found.all) + *found.spare;
    read_quality(f, c->y, fit);
    struct ends ends = read_band(c, points, f->remains, kept, figure, errors_room.functions, &errors);
    read_shares(f, &found, &other, kept, figure, &errors_room, fit, ends, &errors);
    set_band(fit, ends, &errors);
    read_values(c, points, f->remains, kept, figure, fit->values);
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

/* Sorts the inputs by the variance that they bring in a fit without products, the most first; words before all, as they decide
 * what others do. */
static enum ceduo_status rank(struct ceduo_surface *s, const double *y, size_t *used, size_t used_count)
{
    struct solution f;
    enum ceduo_status status = open_solution(&f, s, used, used_count, 0, y);
    double *room = malloc(PARTS(s->inputs_count) * sizeof *room);
    if (status == CEDUO_OK && room) {
        struct parts parts = parts_in(room, s->inputs_count);
        double *total = room + s->inputs_count;
        fill_parts(&f, GROUPS, &parts);
        for (size_t i = 0; i < used_count; i++)
            if (is_word(s, used[i]))
                total[used[i]] = INFINITY;
        for (size_t i = 0; i < used_count; i++) {
            size_t input = used[i], at = i;
            for (; at > 0 && total[used[at - 1]] < total[input]; at--)
                used[at] = used[at - 1];
            used[at] = input;
        }
    }
    status = room ? status : CEDUO_NO_MEMORY;
    free(room);
    close_solution(&f);
    return status;
}

/* The inputs that terms are made of, in order of rank where there are too many for all products. */
struct chosen {
    size_t *used, n, leading;
    bool enough; /* points for single terms */
};

static enum ceduo_status try_terms(struct ceduo_surface *s, const struct chosen *chosen, size_t leading, const double *y,
                                   double *explained)
{
    struct solution f;
    struct ceduo_surface_fit fit;
    enum ceduo_status status = open_solution(&f, s, chosen->used, chosen->n, leading, y);
    if (status == CEDUO_OK)
        read_quality(&f, y, &fit);
    *explained = fit.explained;
    close_solution(&f);
    return status;
}

static enum ceduo_status choose(struct ceduo_surface *s, const bool *uses, const double *y, bool varies, struct chosen *chosen)
{
    struct terms singles = {0};
    *chosen = (struct chosen){.used = calloc(s->inputs_count + 1, sizeof *chosen->used)};
    if (!chosen->used)
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < s->inputs_count; i++)
        if ((!uses || uses[i]) && s->of[i].count > 0)
            chosen->used[chosen->n++] = i;
    list_terms(s, chosen->used, chosen->n, 0, &singles);
    chosen->enough = varies && singles.n > 0 && PER_TERM * (double)singles.n <= (double)s->points;
    size_t leading = chosen->leading = leading_of(s, chosen->used, chosen->n);
    if (!chosen->enough)
        return CEDUO_OK;
    double best = -INFINITY;
    bool ranked = false;
    enum ceduo_status status = CEDUO_OK;
    if (leading < chosen->n)
        status = rank(s, y, chosen->used, chosen->n), ranked = true;
    /* products of inputs that do nothing may stand for those of others: fewer are tried */
    for (double explained = 0; status == CEDUO_OK && leading > 0 && best < ENOUGH; leading /= 2) {
        if (best > -INFINITY && !ranked)
            status = rank(s, y, chosen->used, chosen->n), ranked = true;
        status = status == CEDUO_OK ? try_terms(s, chosen, leading, y, &explained) : status;
        if (status == CEDUO_OK && explained > best)
            best = explained, chosen->leading = leading;
    }
    return status;
}

/* What varies, without noise, and what of that is the noise of the rocks. */
struct spread {
    double variance, noise, kept; /* kept: the share of the values' distance from their mean that is no noise */
};

static struct spread fill_column(const struct ceduo_surface *s, const struct ceduo_groups *groups, struct column *c)
{
    double points = (double)s->points, squares = 0, common = 0;
    memset(c->y, 0, (GROUPS + 1) * s->points * sizeof *c->y);
    c->means[GROUPS] = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        c->means[g] = 0;
        for (size_t p = 0; p < s->points; p++)
            c->means[g] += groups[p].of[g] / points;
        c->means[GROUPS] += c->means[g] / GROUPS;
        for (size_t p = 0; p < s->points; p++) {
            c->y[g * s->points + p] = groups[p].of[g] - c->means[g];
            c->y[GROUPS * s->points + p] += (groups[p].of[g] - c->means[g]) / GROUPS;
        }
    }
    for (size_t p = 0; p < s->points; p++) {
        squares += pow(c->y[GROUPS * s->points + p], 2);
        common += common_of(c->y + p, s->points, GROUPS);
    }
    return (struct spread){fmax(0, common) / (points - 1), fmax(0, squares - common) / (points - 1),
                           squares > 0 ? sqrt(fmin(1, fmax(0, common) / squares)) : 0};
}

/* Without a surface: the points alone, drawn anew. */
static enum ceduo_status read_points(const struct ceduo_surface *s, const struct column *c, double kept,
                                     const struct ceduo_surface_figure *figure, struct ceduo_surface_fit *fit)
{
    struct ends_errors errors = {0};
    double *room = malloc(3 * s->points * sizeof *room);
    if (!room)
        return CEDUO_NO_MEMORY;
    struct ends ends = read_band(c, s->points, c->y, kept, figure, room, &errors);
    read_values(c, s->points, c->y, kept, figure, fit->values);
    for (size_t b = 0; b < SAMPLES; b++) {
        for (size_t p = 0; p < s->points; p++)
            room[p] = fit->values[(size_t)(hashed(b, p, 1) * (double)s->points)];
        add_sample(&errors, ends, read_ends(room, s->points, figure->limit));
    }
    set_band(fit, ends, &errors);
    free(room);
    return CEDUO_OK;
}

static bool allocate_fit(struct ceduo_surface_fit *fit, size_t points, size_t n)
{
    fit->values = malloc(points * sizeof *fit->values);
    fit->first = calloc(2 * n + 1, sizeof *fit->first);
    fit->left = calloc(n + 1, sizeof *fit->left);
    fit->total = fit->first + n;
    for (size_t i = 0; fit->first && fit->left && i < n; i++) {
        fit->first[i] = fit->total[i] = (struct ceduo_share){NAN, NAN};
        fit->left[i] = NAN;
    }
    return fit->values && fit->first && fit->left;
}

enum ceduo_status ceduo_surface_fit(struct ceduo_surface *s, const struct ceduo_surface_figure *figure,
                                    struct ceduo_surface_fit *fit)
{
    GSL_RETURNS_ERRORS;
    struct chosen chosen = {0};
    struct column c = {.y = malloc((GROUPS + 1) * s->points * sizeof *c.y)};
    *fit = (struct ceduo_surface_fit){.lo = figure->lo, .hi = figure->hi, .q2 = NAN, .explained = NAN, .whole = {NAN, NAN}};
    enum ceduo_status status = allocate_fit(fit, s->points, s->inputs_count) && c.y ? CEDUO_OK : CEDUO_NO_MEMORY;
    struct spread spread = {0};
    if (status == CEDUO_OK) {
        spread = fill_column(s, figure->y, &c);
        fit->mean = c.means[GROUPS], fit->variance = spread.variance, fit->noise = spread.noise;
        status = choose(s, figure->uses, c.y, spread.variance > 0, &chosen);
    }
    if (status == CEDUO_OK && chosen.enough) {
        struct solution f;
        fit->enough = true;
        status = open_solution(&f, s, chosen.used, chosen.n, chosen.leading, c.y);
        if (status == CEDUO_OK)
            status = read_solution(&f, &c, figure, fit);
        close_solution(&f);
    } else if (status == CEDUO_OK) {
        status = read_points(s, &c, spread.kept, figure, fit);
    }
    free(c.y);
    free(chosen.used);
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

/* ---- values alone ---- */

/* The values of a figure, and how far they are from those of halves of the rocks, by the terms of `chosen`. */
static enum ceduo_status read_figure(struct ceduo_surface *s, const struct chosen *chosen, struct column *c, double kept,
                                     const struct ceduo_surface_figure *figure, double *values, struct ceduo_groups *changes,
                                     double *room)
{
    struct solution f = {0};
    const double *remains = c->y;
    if (chosen->enough && kept > 0) {
        enum ceduo_status status = open_solution(&f, s, chosen->used, chosen->n, chosen->leading, c->y);
        if (status != CEDUO_OK) {
            close_solution(&f);
            return status;
        }
        kept = kept_of(&f, spare_of(&f, GROUPS));
        remains = f.remains;
    }
    read_values(c, s->points, remains, kept, figure, values);
    for (size_t half = 1; half < GROUPS; half++) {
        read_changes(c, s->points, remains, kept, half, room);
        for (size_t p = 0; p < s->points; p++)
            changes[p].of[half] = room[p];
    }
    close_solution(&f);
    return CEDUO_OK;
}

enum ceduo_status ceduo_surface_values(struct ceduo_surface *s, const struct ceduo_surface_figure *figure, size_t n,
                                       double *values, struct ceduo_groups *changes)
{
    GSL_RETURNS_ERRORS;
    struct chosen chosen = {0};
    struct column c = {.y = malloc((GROUPS + 1) * s->points * sizeof *c.y)};
    double *room = malloc(s->points * sizeof *room);
    struct ceduo_groups *sum = calloc(s->points, sizeof *sum); /* of the figures, at each point */
    enum ceduo_status status = c.y && room && sum ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK) {
        for (size_t i = 0; i < n * s->points; i++)
            for (size_t g = 0; g < GROUPS; g++)
                sum[i % s->points].of[g] += figure->y[i].of[g];
        struct spread spread = fill_column(s, sum, &c);
        status = choose(s, figure->uses, c.y, spread.variance > 0, &chosen);
    }
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        double kept = fill_column(s, figure->y + i * s->points, &c).kept;
        status = read_figure(s, &chosen, &c, kept, figure, values + i * s->points, changes + i * s->points, room);
    }
    free(chosen.used);
    free(c.y);
    free(room);
    free(sum);
    return status;
}

/* Sums over the halves are sums over the groups again. */
void ceduo_groups_set(struct ceduo_groups *groups, double value, const double changes[CEDUO_SURFACE_GROUPS])
{
    for (size_t g = 0; g < GROUPS; g++) {
        groups->of[g] = value;
        for (size_t half = 1; half < GROUPS; half++)
            groups->of[g] += side_of(half, g) * changes[half];
    }
}
