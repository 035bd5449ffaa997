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

#include "base/arena.h"
#include "base/gsl_errors.h"
#include "base/random.h"
#include "ceduo/statistics.h"
#include "ceduo/uncertainty.h"
#include "check_study.h"
#include "points.h"

#define GROUPS      CEDUO_SURFACE_GROUPS
#define COORDINATES 40  /* of GSL's Sobol' points */
#define PER_TERM    2.5 /* points that a term needs */
#define SAMPLES     64  /* of the bootstrap */
#define CLASSES     8   /* values of an input that is taken as known */
#define TABLE_MAX   12  /* functions of an input that is a table */
#define RIDGES      57  /* that are tried */
#define SAME        1e-8
#define SHIFT       UINT64_MAX /* the row of the shifts of Sobol' points */
#define ENOUGH      CEDUO_UNCERTAINTY_EXPLAINED

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

/* An input's functions, `count` from `first` on, those of degree 1 before all others. */
struct inputs_functions {
    size_t first, count, linear, levels; /* levels: of a table; 0: a range */
    double *table;                       /* a row of functions for each level */
};

struct term {
    size_t n, f[3]; /* functions that it is the product of */
};

struct terms {
    size_t n;
    struct term *items; /* NULL: they are counted only */
};

/* The inputs that terms are made of, in order of rank where there are too many for all products; see list_terms(). */
struct chosen {
    size_t *used, n, leading;
    bool enough; /* points for single terms */
    bool linear; /* without functions of degree 2, as there are too few points for them */
};

/* Terms with their values at the points, less their means, decomposed as U S V', and fitted to the values of a figure. */
struct solution {
    const struct ceduo_surface *s;
    struct arena memory;
    struct chosen chosen;
    struct terms terms;
    gsl_matrix_view x; /* a row for each point */
    double *means;
    gsl_multifit_linear_workspace *work;
    double lambda, freedom;
    double *coefficient, *mean; /* of each group's terms, then of their mean */
    double *remains, *left;     /* of each group at each point, then of their mean */
    double *leverage;           /* of each point */
    double *change;             /* of the coefficients of the mean in a sample of the bootstrap */
    double *spread;             /* the variance of each coefficient where the values have variance 1 */
    double spare, kept;         /* the variance that the terms leave without noise; how much of the mean's remains is that */
};

/* A figure's values at the points, of each group and of their mean (GROUPS), less their means over the points: as the same rocks
 * are at every point, groups differ by a constant. Of what remains of them (without terms: of all) so much is kept that is no
 * noise. */
struct column {
    const struct ceduo_surface_figure *figure;
    size_t points;
    double *y, means[GROUPS + 1];
    double variance, noise; /* of the mean: without the noise of the rocks, and that */
    const double *remains;
    double kept;
};

/* The variance of each input's terms, alone and then with others, and last what the terms leave; that of all terms. */
struct parts {
    size_t n;
    double *of, all, *spare;
};

struct ceduo_surface {
    const struct ceduo_input *inputs;
    const double *u;
    size_t points, inputs_count, functions_count;
    struct arena memory;
    struct inputs_functions *of;
    size_t *input;                /* of each function */
    double *at;                   /* of each function its value at each point */
    double *multipliers;          /* of the bootstrap: normal, of each sample for each point */
    struct solution solutions[2]; /* the last ones, without and with products */
    struct column c;              /* the figure at hand */
    struct parts found, other;    /* of it, and of a part of the rocks or of other points */
    double *squares;              /* sums of squared differences of their shares, by the rocks and by the points */
    size_t *used;                 /* room for the inputs that are chosen, */
    double *room, *values;        /* for values of functions, and for one at each point */
};

/* Values of a table's column: of words one for each but the last, of rows the values of each place and their squares. */
static double column_at(const struct ceduo_input *input, size_t column, size_t level)
{
    if (input->kind == CEDUO_INPUT_WORDS)
        return level == column;
    size_t places = input->places_count, n = input->draws_count;
    const double *values = input->draws[column % places];
    double sd = gsl_stats_sd(values, 1, n), x = sd > 0 ? (values[level] - gsl_stats_mean(values, 1, n)) / sd : 0;
    return column < places ? x : x * x;
}

/* Make a column orthonormal to the constant and to the `done` columns before it. False if nothing of it is left. */
static bool make_orthonormal(double *table, size_t levels, size_t done)
{
    gsl_matrix_view all = gsl_matrix_view_array(table, levels, TABLE_MAX);
    gsl_vector_view column = gsl_matrix_column(&all.matrix, done);
    gsl_vector_add_constant(&column.vector, -gsl_stats_mean(table + done, TABLE_MAX, levels));
    double before = gsl_blas_dnrm2(&column.vector), along, n = (double)levels;
    for (size_t k = 0; k < done; k++) {
        gsl_vector_view other = gsl_matrix_column(&all.matrix, k);
        gsl_blas_ddot(&other.vector, &column.vector, &along);
        gsl_blas_daxpy(-along / n, &other.vector, &column.vector);
    }
    double after = gsl_blas_dnrm2(&column.vector);
    gsl_vector_scale(&column.vector, sqrt(n) / after);
    return after * after > SAME * before * before;
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

/* The values of an input's functions at the points, shifted, to the rows of `at`. */
static void fill_functions(const struct ceduo_surface *s, size_t input, double shift, double *at)
{
    const struct inputs_functions *of = &s->of[input];
    double values[TABLE_MAX];
    for (size_t p = 0; p < s->points; p++) {
        double u = s->u[p * s->inputs_count + input] + shift;
        functions_at(of, u - floor(u), values);
        for (size_t k = 0; k < of->count; k++)
            at[(of->first + k) * s->points + p] = values[k];
    }
}

/* Makes the functions of an input. */
static void make_functions(struct ceduo_surface *s, size_t i)
{
    const struct ceduo_input *input = &s->inputs[i];
    struct inputs_functions *of = &s->of[i];
    bool words = input->kind == CEDUO_INPUT_WORDS, table = words || input->kind == CEDUO_INPUT_DRAWS;
    size_t columns = !table ? 2 : words ? input->words_count - 1 : 2 * input->places_count;
    *of = (struct inputs_functions){.first = s->functions_count};
    if (table) {
        of->levels = words ? input->words_count : input->draws_count;
        if (!(of->table = ceduo_arena_alloc(&s->memory, of->levels * TABLE_MAX * sizeof *of->table)))
            return;
    }
    for (size_t c = 0; c < columns && c < TABLE_MAX; c++) {
        for (size_t l = 0; l < of->levels; l++)
            of->table[l * TABLE_MAX + of->count] = column_at(input, c, l);
        bool kept = !table || make_orthonormal(of->table, of->levels, of->count);
        s->input[s->functions_count] = i;
        s->functions_count += kept;
        of->count += kept;
        of->linear += kept && (words || c < (table ? input->places_count : 1));
    }
}

static void take_parts(struct ceduo_surface *s, struct parts *parts)
{
    parts->n = 2 * s->inputs_count + 1;
    parts->of = ceduo_arena_alloc(&s->memory, parts->n * sizeof *parts->of);
    parts->spare = parts->of ? parts->of + parts->n - 1 : NULL;
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
    *s = (struct ceduo_surface){.inputs = inputs, .u = u, .points = points, .inputs_count = n, .c.points = points};
    s->of = ceduo_arena_alloc(&s->memory, (n + 1) * sizeof *s->of);
    s->input = ceduo_arena_alloc(&s->memory, (n * TABLE_MAX + 1) * sizeof *s->input);
    s->multipliers = ceduo_arena_alloc(&s->memory, SAMPLES * points * sizeof *s->multipliers);
    s->c.y = ceduo_arena_alloc(&s->memory, (GROUPS + 1) * points * sizeof *s->c.y);
    s->used = ceduo_arena_alloc(&s->memory, (n + 1) * sizeof *s->used);
    s->values = ceduo_arena_alloc(&s->memory, points * sizeof *s->values);
    take_parts(s, &s->found);
    take_parts(s, &s->other);
    s->squares = ceduo_arena_alloc(&s->memory, 2 * s->found.n * sizeof *s->squares);
    for (size_t b = 0; !s->memory.failed && b < SAMPLES; b++)
        for (size_t p = 0; p < points; p++)
            s->multipliers[b * points + p] = gsl_cdf_ugaussian_Pinv(random_open(b, p, 0, RANDOM_SAMPLE));
    for (size_t i = 0; i < n && !s->memory.failed; i++)
        make_functions(s, i);
    s->at = ceduo_arena_alloc(&s->memory, (s->functions_count + 1) * points * sizeof *s->at);
    s->room = ceduo_arena_alloc(&s->memory, (s->functions_count + TABLE_MAX + 3) * points * sizeof *s->room);
    for (size_t i = 0; i < n && !s->memory.failed; i++)
        fill_functions(s, i, 0, s->at);
    return s->memory.failed ? CEDUO_NO_MEMORY : CEDUO_OK;
}

static void close_solution(struct solution *f)
{
    gsl_multifit_linear_free(f->work);
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

/* Products of the functions of degree 1 of the leading inputs from `at` on with those of `term`, which has so many words. */
static void add_products(const struct ceduo_surface *s, const struct chosen *chosen, size_t at, struct term term, size_t words,
                         struct terms *t)
{
    for (size_t c = at; c < chosen->leading; c++) {
        const struct inputs_functions *of = &s->of[chosen->used[c]];
        size_t all_words = words + is_word(s, chosen->used[c]);
        if (term.n == 2 && all_words < 2)
            continue;
        for (size_t k = 0; k < of->linear; k++) {
            struct term product = term;
            product.f[product.n++] = of->first + k;
            if (product.n > 1)
                add_term(t, product);
            if (product.n < 3)
                add_products(s, chosen, c + 1, product, all_words, t);
        }
    }
}

/* All terms of the inputs used, in order of rank; only the leading ones have products. */
static size_t list_terms(const struct ceduo_surface *s, const struct chosen *chosen, struct terms *t)
{
    for (size_t c = 0; c < chosen->n; c++)
        for (size_t k = 0; k < (chosen->linear ? s->of[chosen->used[c]].linear : s->of[chosen->used[c]].count); k++)
            add_term(t, (struct term){1, {s->of[chosen->used[c]].first + k}});
    add_products(s, chosen, 0, (struct term){0}, 0, t);
    return t->n;
}

/* Whether there are points enough for all terms. */
static bool is_enough(const struct ceduo_surface *s, const struct chosen *chosen)
{
    return PER_TERM * (double)list_terms(s, chosen, &(struct terms){0}) <= (double)s->points;
}

/* From the values of the functions. */
static double term_at(const struct ceduo_surface *s, const double *at, const struct term *term, size_t point)
{
    double x = 1;
    for (size_t k = 0; k < term->n; k++)
        x *= at[term->f[k] * s->points + point];
    return x;
}

/* ---- one fit ---- */

static int decompose(void *solution)
{
    struct solution *f = solution;
    return gsl_multifit_linear_svd(&f->x.matrix, f->work);
}

/* Lists the terms, for which there are points enough, and decomposes their values; what was made last is taken again where it is of
 * the same. NULL without memory. */
static struct solution *solution_of(struct ceduo_surface *s, const struct chosen *chosen)
{
    struct solution *f = &s->solutions[chosen->leading > 0];
    size_t points = s->points, bytes = chosen->n * sizeof *chosen->used;
    if (f->chosen.used && f->chosen.n == chosen->n && f->chosen.leading == chosen->leading &&
        f->chosen.linear == chosen->linear && memcmp(f->chosen.used, chosen->used, bytes) == 0)
        return f;
    close_solution(f);
    size_t *used = ceduo_arena_alloc(&f->memory, bytes + 1);
    f->s = s;
    f->terms.items = ceduo_arena_alloc(&f->memory, points * sizeof *f->terms.items);
    if (f->memory.failed)
        return NULL;
    size_t n = list_terms(s, chosen, &f->terms);
    double *x = ceduo_arena_alloc(&f->memory, points * n * sizeof *x);
    f->means = ceduo_arena_alloc(&f->memory, n * sizeof *f->means);
    f->coefficient = ceduo_arena_alloc(&f->memory, (GROUPS + 1) * n * sizeof *f->coefficient);
    f->change = ceduo_arena_alloc(&f->memory, n * sizeof *f->change);
    f->spread = ceduo_arena_alloc(&f->memory, n * sizeof *f->spread);
    f->remains = ceduo_arena_alloc(&f->memory, (GROUPS + 1) * points * sizeof *f->remains);
    f->leverage = ceduo_arena_alloc(&f->memory, points * sizeof *f->leverage);
    f->work = gsl_multifit_linear_alloc(points, n);
    if (!f->memory.failed)
        f->x = gsl_matrix_view_array(x, points, n);
    for (size_t j = 0; j < n && !f->memory.failed; j++) {
        for (size_t p = 0; p < points; p++)
            x[p * n + j] = term_at(s, s->at, &f->terms.items[j], p);
        gsl_vector_view column = gsl_matrix_column(&f->x.matrix, j);
        f->means[j] = gsl_stats_mean(x + j, n, points);
        gsl_vector_add_constant(&column.vector, -f->means[j]);
    }
    if (!f->work || f->memory.failed || ceduo_gsl_try(decompose, f) != 0)
        return NULL;
    f->mean = f->coefficient + GROUPS * n;
    f->left = f->remains + GROUPS * points;
    f->chosen = (struct chosen){memcpy(used, chosen->used, bytes), chosen->n, chosen->leading, true, chosen->linear};
    return f;
}

/* Set the coefficients of values y at the points. */
static void solve(const struct solution *f, const double *y, double *coefficient)
{
    double ignored[2];
    gsl_vector_const_view values = gsl_vector_const_view_array(y, f->s->points);
    gsl_vector_view to = gsl_vector_view_array(coefficient, f->terms.n);
    gsl_multifit_linear_solve(f->lambda, &f->x.matrix, &values.vector, &to.vector, &ignored[0], &ignored[1], f->work);
}

/* Set the ridge of the least score. GSL's own ridges end at the smallest singular value, which is a strong ridge if functions are
 * orthonormal. `room`: n. */
static void choose_ridge(struct solution *f, const double *y, double *room)
{
    double tried[RIDGES], scores[RIDGES], delta, max = gsl_vector_get(f->work->S, 0);
    gsl_vector_view ridges = gsl_vector_view_array(tried, RIDGES), along = gsl_vector_view_array(room, f->terms.n);
    gsl_vector_view score = gsl_vector_view_array(scores, RIDGES);
    gsl_vector_const_view values = gsl_vector_const_view_array(y, f->s->points);
    gsl_multifit_linear_gcv_init(&values.vector, &ridges.vector, &along.vector, &delta, f->work);
    for (int i = 0; i < RIDGES; i++)
        tried[i] = max * pow(10, -7. * i / (RIDGES - 1));
    gsl_multifit_linear_gcv_curve(&ridges.vector, &along.vector, delta, &score.vector, f->work);
    f->lambda = tried[gsl_vector_min_index(&score.vector)];
}

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

/* The variance that the terms leave, from all groups or without one. */
static double spare_of(const struct solution *f, size_t without)
{
    double spare = 0;
    for (size_t p = 0; p < f->s->points; p++)
        spare += common_of(f->remains + p, f->s->points, without) / f->freedom;
    return fmax(0, spare);
}

/* The factor that leaves of n values, whose mean is 0, so much of their squares. */
static double kept_of(double squares, const double *values, size_t n)
{
    double all = gsl_stats_tss_m(values, 1, n, 0);
    return all > 0 ? sqrt(fmin(1, fmax(0, squares) / all)) : 0; /* untaken: rounding */
}

/* Fits the figure at hand by terms. NULL without memory. */
static struct solution *fit_terms(struct ceduo_surface *s, const struct chosen *chosen)
{
    struct solution *f = solution_of(s, chosen);
    if (!f)
        return NULL;
    size_t points = s->points, n = f->terms.n;
    const double *y = s->c.y;
    f->freedom = (double)points - 1;
    memset(f->spread, 0, n * sizeof *f->spread);
    choose_ridge(f, y + GROUPS * points, f->change);
    memset(f->change, 0, n * sizeof *f->change);
    for (size_t p = 0; p < points; p++)
        f->leverage[p] = 1 / (double)points;
    for (size_t k = 0; k < n && gsl_vector_get(f->work->S, k) > 0; k++) { /* the largest are the first */
        double sigma = gsl_vector_get(f->work->S, k), ridge = sigma * sigma + f->lambda * f->lambda;
        double keep = sigma * sigma / ridge; /* share of a singular value that the ridge leaves */
        f->freedom -= keep * (2 - keep);
        for (size_t j = 0; j < n; j++)
            f->spread[j] += pow(gsl_matrix_get(f->work->Q, j, k) * sigma / ridge, 2);
        for (size_t p = 0; p < points; p++)
            f->leverage[p] += pow(gsl_matrix_get(f->work->A, p, k), 2) * keep;
    }
    for (size_t p = 0; p < points; p++)
        f->leverage[p] = fmin(f->leverage[p], .99);
    for (size_t g = 0; g <= GROUPS; g++) {
        gsl_vector_const_view values = gsl_vector_const_view_array(y + g * points, points);
        gsl_vector_view coefficient = gsl_vector_view_array(f->coefficient + g * n, n);
        gsl_vector_view remains = gsl_vector_view_array(f->remains + g * points, points);
        solve(f, y + g * points, coefficient.vector.data);
        gsl_multifit_linear_residuals(&f->x.matrix, &values.vector, &coefficient.vector, &remains.vector);
    }
    f->spare = spare_of(f, GROUPS);
    f->kept = kept_of(f->spare * f->freedom, f->left, points);
    return f;
}

/* ---- values ---- */

/* Make a figure the one at hand: `groups` of each point, of n figures their sum. */
static void fill_column(struct column *c, const struct ceduo_replicates *groups, size_t n)
{
    double common = 0, *mean = c->y + GROUPS * c->points;
    memset(c->y, 0, (GROUPS + 1) * c->points * sizeof *c->y);
    c->means[GROUPS] = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        double *y = c->y + g * c->points;
        for (size_t i = 0; i < n * c->points; i++)
            y[i % c->points] += groups[i].of[g];
        c->means[g] = gsl_stats_mean(y, 1, c->points);
        c->means[GROUPS] += c->means[g] / GROUPS; /* exactly 0 if groups cancel out */
        for (size_t p = 0; p < c->points; p++) {
            y[p] -= c->means[g];
            mean[p] += y[p] / GROUPS;
        }
    }
    for (size_t p = 0; p < c->points; p++)
        common += common_of(c->y + p, c->points, GROUPS);
    c->variance = fmax(0, common) / ((double)c->points - 1);
    c->noise = fmax(0, gsl_stats_variance_m(mean, 1, c->points, 0) - common / ((double)c->points - 1));
    c->remains = c->y;
    c->kept = kept_of(common, mean, c->points);
}

static void bound(const struct column *c, double *values)
{
    for (size_t i = 0; i < c->points; i++)
        values[i] = fmin(c->figure->hi, fmax(c->figure->lo, values[i]));
}

/* At each point the mean of the groups less what of the remainder is noise. */
static void read_values(const struct column *c, double *values)
{
    for (size_t p = 0; p < c->points; p++)
        values[p] = c->means[GROUPS] + c->y[GROUPS * c->points + p] - (1 - c->kept) * c->remains[GROUPS * c->points + p];
    bound(c, values);
}

/* Half of the groups, 1…GROUPS - 1: any two halves have half of theirs in common. */
static double side_of(size_t half, size_t group)
{
    return __builtin_parityll(half & group) ? -1 : 1;
}

/* What the values of half of the groups are above those of all; those of the other half are as much below. */
static void read_changes(const struct column *c, size_t half, double *changes)
{
    memset(changes, 0, c->points * sizeof *changes);
    for (size_t g = 0; g < GROUPS; g++) {
        double side = side_of(half, g) / GROUPS;
        for (size_t p = 0; p < c->points; p++)
            changes[p] += side * (c->means[g] + c->y[g * c->points + p] - (1 - c->kept) * c->remains[g * c->points + p]);
    }
}

/* What is read of values; `values` are sorted. */
enum end { P5, P50, P95, BELOW, ENDS };

static void read_ends(double *values, size_t n, double limit, double ends[ENDS])
{
    size_t below = 0;
    gsl_sort(values, 1, n);
    while (below < n && values[below] <= limit)
        below++;
    ends[P5] = ceduo_quantile(values, n, .05), ends[P50] = ceduo_quantile(values, n, .5);
    ends[P95] = ceduo_quantile(values, n, .95), ends[BELOW] = isnan(limit) ? NAN : (double)below / (double)n;
}

/* The error of a mean of so few groups: 1.96 of it hold 95 %. */
static double student(void)
{
    return pow(gsl_cdf_tdist_Pinv(.975, GROUPS - 1) / CEDUO_Z95, 2);
}

/* What is read of the values; of samples of the points, and of halves of the rocks less the other halves, from which its errors
 * are read, as what is read of sorted values turns at single ones (balanced half samples, McCarthy 1969). */
struct band {
    double ends[ENDS], samples[SAMPLES][ENDS], halves[GROUPS - 1][ENDS];
};

static void read_band(const struct ceduo_surface *s, struct band *band)
{
    const struct column *c = &s->c;
    double *values = s->room, *changes = values + c->points, *changed = changes + c->points, ends[2][ENDS];
    read_values(c, values);
    for (size_t half = 1; half < GROUPS; half++) {
        read_changes(c, half, changes);
        for (int other = 0; other < 2; other++) {
            for (size_t p = 0; p < c->points; p++)
                changed[p] = values[p] + (other ? -changes[p] : changes[p]);
            bound(c, changed);
            read_ends(changed, c->points, c->figure->limit, ends[other]);
        }
        for (size_t i = 0; i < ENDS; i++)
            band->halves[half - 1][i] = ends[0][i] - ends[1][i];
    }
    read_ends(values, c->points, c->figure->limit, band->ends);
}

static double band_se(const struct band *b, enum end i)
{
    double of_rocks = gsl_stats_tss_m(&b->halves[0][i], ENDS, GROUPS - 1, 0) / 4 / (GROUPS - 1);
    return sqrt(gsl_stats_variance(&b->samples[0][i], ENDS, SAMPLES) + of_rocks * student());
}

/* ---- shares ---- */

/* The share of the variance that part i is. */
static double share_of(const struct parts *p, double noise, size_t i)
{
    double whole = fmax(0, p->all) + *p->spare;
    return p->of[i] / (whole + (whole < noise ? noise : 0)); /* of what is less than the noise it is close to 0 */
}

/* The parts without one group (GROUPS: of all), of which the terms leave `spare`; with coefficients that change. */
static void fill_parts(const struct solution *f, size_t without, double spare, const double *change, struct parts *parts)
{
    const struct ceduo_surface *s = f->s;
    memset(parts->of, 0, parts->n * sizeof *parts->of);
    parts->all = 0;
    *parts->spare = spare;
    for (size_t j = 0; j < f->terms.n; j++) {
        const struct term *term = &f->terms.items[j];
        double variance = common_of(f->coefficient + j, f->terms.n, without) - spare * f->spread[j];
        if (change)
            variance += change[j] * (2 * f->mean[j] + change[j]) - f->spare * f->spread[j];
        parts->all += variance;
        for (size_t k = 0; k < term->n; k++) {
            size_t input = s->input[term->f[k]];
            parts->of[s->inputs_count + input] += variance;
            parts->of[input] += term->n == 1 ? variance : 0;
        }
    }
}

/* With what the terms leave at each point, without noise, drawn anew: the coefficients change by f->change. */
static void draw_parts(const struct solution *f, size_t sample, struct parts *parts)
{
    const struct ceduo_surface *s = f->s;
    const double *multiplier = s->multipliers + sample * s->points;
    double spare = 0;
    for (size_t p = 0; p < s->points; p++) {
        double drawn = f->kept * f->left[p] * multiplier[p];
        s->values[p] = drawn / sqrt(1 - f->leverage[p]);
        spare += drawn * drawn / f->freedom;
    }
    solve(f, s->values, f->change);
    fill_parts(f, GROUPS, f->spare, f->change, parts);
    *parts->spare = spare;
}

/* Set s->values to those of the surface at points shifted at random, with its coefficients changed and the remainder of any point;
 * without a surface to `values` of points drawn anew. */
static void draw_values(const struct ceduo_surface *s, const struct solution *f, size_t sample, const double *values)
{
    for (size_t i = 0; f && i < f->chosen.n; i++) {
        size_t input = f->chosen.used[i];
        fill_functions(s, input, random_pair(sample, SHIFT, input, RANDOM_SAMPLE).u[0], s->room);
    }
    for (size_t p = 0; p < s->points; p++) {
        size_t other = (size_t)(random_pair(sample, p, 0, RANDOM_SAMPLE).u[1] * (double)s->points);
        s->values[p] = f ? s->c.means[GROUPS] + f->kept * f->left[other] / sqrt(1 - f->leverage[other]) : values[other];
    }
    for (size_t j = 0; f && j < f->terms.n; j++)
        for (size_t p = 0; p < s->points; p++)
            s->values[p] += (f->mean[j] + f->change[j]) * (term_at(s, s->room, &f->terms.items[j], p) - f->means[j]);
    bound(&s->c, s->values);
}

/* ---- what is left ---- */

/* What a function of `input` changes at each point: the sum of the terms that it is in, divided by it. */
static void add_changes(const struct solution *f, size_t input, double *change)
{
    const struct ceduo_surface *s = f->s;
    const struct inputs_functions *of = &s->of[input];
    memset(change, 0, of->count * s->points * sizeof *change);
    for (size_t j = 0; j < f->terms.n; j++) {
        const struct term *term = &f->terms.items[j];
        for (size_t k = 0; k < term->n; k++) {
            if (s->input[term->f[k]] != input)
                continue;
            struct term rest = *term;
            rest.f[k] = rest.f[--rest.n];
            double *row = change + (term->f[k] - of->first) * s->points;
            for (size_t p = 0; p < s->points; p++)
                row[p] += f->mean[j] * term_at(s, s->at, &rest, p);
        }
    }
}

/* p95 - p5 of what remains of the values, on the mean, if an input is known. */
static double left_of(const struct solution *f, const double *values, size_t input)
{
    const struct ceduo_surface *s = f->s;
    const struct inputs_functions *of = &s->of[input];
    double *change = s->room, *changed = change + TABLE_MAX * s->points, at[TABLE_MAX], ends[ENDS], width = 0;
    size_t n = of->levels > 0 && of->levels < CLASSES ? of->levels : CLASSES;
    add_changes(f, input, change);
    for (size_t i = 0; i < n; i++) {
        functions_at(of, ((double)i + .5) / (double)n, at);
        memcpy(changed, values, s->points * sizeof *changed);
        for (size_t k = 0; k < of->count; k++)
            for (size_t p = 0; p < s->points; p++)
                changed[p] += change[k * s->points + p] * (at[k] - s->at[(of->first + k) * s->points + p]);
        bound(&s->c, changed);
        read_ends(changed, s->points, NAN, ends);
        width += (ends[P95] - ends[P5]) / (double)n;
    }
    return width;
}

/* ---- the fit ---- */

static void read_quality(const struct solution *f, struct ceduo_surface_fit *fit)
{
    const double *y = f->s->c.y;
    size_t points = f->s->points;
    double left_out = 0, squares = 0, common[2] = {0};
    for (size_t p = 0; p < points; p++) {
        double keep = 1 - f->leverage[p];
        left_out += pow(f->left[p] / keep, 2);
        squares += pow(y[GROUPS * points + p], 2);
        common[0] += common_of(f->remains + p, points, GROUPS) / (keep * keep);
        common[1] += common_of(y + p, points, GROUPS);
    }
    fit->q2 = 1 - left_out / squares;
    fit->explained = 1 - fmax(0, common[0]) / common[1];
}

/* Adds the squares of what the shares of one differ from those of the other. */
static void add_squares(const struct parts *a, const struct parts *b, double noise, double *sums)
{
    for (size_t i = 0; i < a->n; i++)
        sums[i] += pow(share_of(a, noise, i) - share_of(b, noise, i), 2);
}

/* Set shares with their errors, the range of the values with its own, and what is left of it. `f` NULL: the points alone. */
static void read_solution(struct ceduo_surface *s, struct solution *f, struct ceduo_surface_fit *fit)
{
    struct parts *found = &s->found, *other = &s->other;
    double *of_rocks = s->squares, *of_points = of_rocks + found->n;
    struct band band;
    memset(s->squares, 0, 2 * found->n * sizeof *s->squares);
    if (f) {
        fill_parts(f, GROUPS, f->spare, NULL, found);
        s->c.remains = f->remains, s->c.kept = f->kept;
        fit->variance = fmax(0, found->all) + f->spare;
        read_quality(f, fit);
    }
    for (size_t g = 0; f && g < GROUPS; g++) {
        fill_parts(f, g, spare_of(f, g), NULL, other);
        add_squares(other, found, fit->noise, of_rocks);
    }
    read_band(s, &band);
    read_values(&s->c, fit->values);
    for (size_t b = 0; b < SAMPLES; b++) {
        if (f && f->kept > 0) {
            draw_parts(f, b, other);
            add_squares(other, found, fit->noise, of_points);
        }
        draw_values(s, f, b, fit->values);
        read_ends(s->values, s->points, s->c.figure->limit, band.samples[b]);
    }
    fit->p5 = band.ends[P5], fit->p50 = band.ends[P50], fit->p95 = band.ends[P95];
    fit->p5_se = band_se(&band, P5), fit->p95_se = band_se(&band, P95);
    fit->below = (struct ceduo_share){band.ends[BELOW], band_se(&band, BELOW)};
    for (size_t i = 0; f && i < found->n; i++)
        fit->first[i] = (struct ceduo_share){share_of(found, fit->noise, i),
                                             sqrt(of_rocks[i] * student() * (GROUPS - 1) / GROUPS + of_points[i] / SAMPLES)};
    fit->whole = fit->first[found->n - 1];
    for (size_t i = 0; f && i < s->inputs_count; i++) /* in the mean no more than now: what seems more is error */
        fit->left[i] = fmin(left_of(f, fit->values, i), fit->p95 - fit->p5);
}

/* Sorts the inputs by the variance that they bring in a fit without products, the most first; words before all, as they decide
 * what others do. False without memory. */
static bool rank(struct ceduo_surface *s, const struct chosen *chosen)
{
    const struct solution *f =
        fit_terms(s, &(const struct chosen){.used = chosen->used, .n = chosen->n, .linear = chosen->linear});
    double *total = s->found.of + s->inputs_count;
    size_t *used = chosen->used;
    if (!f)
        return false;
    fill_parts(f, GROUPS, f->spare, NULL, &s->found);
    for (size_t i = 0; i < chosen->n; i++) {
        total[used[i]] = is_word(s, used[i]) ? -INFINITY : -total[used[i]];
        ceduo_insert_index(total, used[i], i, used);
    }
    return true;
}

/* Chooses the inputs that have products, at the most so many as there are points for. False without memory. */
static bool choose(struct ceduo_surface *s, struct chosen *chosen)
{
    const bool *uses = s->c.figure->uses;
    *chosen = (struct chosen){.used = s->used};
    for (size_t i = 0; i < s->inputs_count; i++)
        if ((!uses || uses[i]) && s->of[i].count > 0)
            chosen->used[chosen->n++] = i;
    if (!(s->c.variance > 0) || chosen->n == 0)
        return true;
    chosen->linear = !is_enough(s, chosen);
    chosen->enough = is_enough(s, chosen);
    if (!chosen->enough)
        return true;
    struct chosen tried = *chosen;
    for (tried.leading = chosen->n; !is_enough(s, &tried);) /* without products there are enough */
        tried.leading--;
    chosen->leading = tried.leading;
    double best = -INFINITY;
    bool good = true, ranked = false;
    /* products of inputs that do nothing may stand for those of others: fewer are tried */
    for (; good && tried.leading > 0 && best < ENOUGH; tried.leading /= 2) {
        struct ceduo_surface_fit fit = {.explained = -INFINITY};
        if (!ranked && tried.leading < chosen->n)
            good = ranked = rank(s, &tried);
        const struct solution *f = good ? fit_terms(s, &tried) : NULL;
        good = f;
        if (f)
            read_quality(f, &fit);
        if (fit.explained > best)
            best = fit.explained, chosen->leading = tried.leading;
    }
    return good;
}

/* Room for what is told of each point and input, in one piece. */
static bool allocate_fit(struct ceduo_surface_fit *fit, size_t points, size_t n)
{
    fit->first = malloc((2 * n + 1) * sizeof *fit->first + (n + points) * sizeof(double));
    if (!fit->first)
        return false;
    fit->total = fit->first + n;
    fit->left = (double *)(fit->first + 2 * n + 1);
    fit->values = fit->left + n;
    for (size_t i = 0; i <= 2 * n; i++)
        fit->first[i] = (struct ceduo_share){NAN, NAN};
    for (size_t i = 0; i < n; i++)
        fit->left[i] = NAN;
    return true;
}

enum ceduo_status ceduo_surface_fit(struct ceduo_surface *s, const struct ceduo_surface_figure *figure,
                                    struct ceduo_surface_fit *fit)
{
    GSL_RETURNS_ERRORS;
    struct chosen chosen;
    struct solution *f = NULL;
    *fit = (struct ceduo_surface_fit){.q2 = NAN, .explained = NAN};
    s->c.figure = figure;
    fill_column(&s->c, figure->y, 1);
    fit->mean = s->c.means[GROUPS], fit->variance = s->c.variance, fit->noise = s->c.noise;
    bool good = allocate_fit(fit, s->points, s->inputs_count) && choose(s, &chosen);
    fit->enough = good && chosen.enough;
    fit->linear = good && chosen.linear;
    if (fit->enough)
        good = (f = fit_terms(s, &chosen));
    if (good)
        read_solution(s, f, fit);
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
    struct chosen chosen;
    s->c.figure = figure;
    fill_column(&s->c, figure->y, n); /* the sum of the figures says by what terms */
    if (!choose(s, &chosen))
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n; i++) {
        fill_column(&s->c, figure->y + i * s->points, 1);
        if (chosen.enough && s->c.kept > 0) {
            const struct solution *f = fit_terms(s, &chosen);
            if (!f)
                return CEDUO_NO_MEMORY;
            s->c.remains = f->remains, s->c.kept = f->kept;
        }
        read_values(&s->c, values + i * s->points);
        for (size_t half = 1; half < GROUPS; half++) {
            read_changes(&s->c, half, s->values);
            for (size_t p = 0; p < s->points; p++)
                changes[i * s->points + p].of[half] = s->values[p];
        }
    }
    return CEDUO_OK;
}

/* Sums over the halves are sums over the groups again. */
void ceduo_replicates_from_half_samples(struct ceduo_replicates *groups, double value,
                                        const double changes[CEDUO_SURFACE_GROUPS])
{
    for (size_t g = 0; g < GROUPS; g++) {
        groups->of[g] = value;
        for (size_t half = 1; half < GROUPS; half++)
            groups->of[g] += side_of(half, g) * changes[half];
    }
}
