/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What doubt does to the figures of a scene. A list of evaluations is made: the rows of a design (sensitivity.c), then the
 * scene with one input at each end of its range. Threads take evaluations one by one, each with a copy of the scene of its
 * own, and write to the evaluation's own row: so the bits do not depend on them. With more inputs than can have an index, a
 * first look ranks them, and the least move together. */
#include "ceduo/doubt.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/question.h"
#include "inputs.h"

#define GROUPS CEDUO_SENSITIVITY_GROUPS
#define COARSE       4 /* times fewer rocks in a first look, */
#define COARSE_LEAST 50 /* but so many */

/* Figures of one evaluation: for each option and kind, then the differences of all options but the first. */
static size_t figures_of(const struct ceduo_scene *scene)
{
    return (2 * scene->options_count - 1) * CEDUO_DOUBT_KINDS;
}

static size_t figure_index(size_t options, size_t option, enum ceduo_doubt_kind kind, bool difference)
{
    return (difference ? options + option - 1 : option) * CEDUO_DOUBT_KINDS + kind;
}

/* ---- one evaluation ---- */

static const struct ceduo_arrivals *arrivals_of(const struct ceduo_result *r, size_t option)
{
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, r->last_control);
    return wooded ? wooded : &r->bare.arrivals[r->last_control];
}

/* Sums over all rocks released, from which shares and means come. */
static void read_option(const struct ceduo_result *r, size_t option, double *sums)
{
    const struct ceduo_arrivals *a = arrivals_of(r, option);
    sums[CEDUO_DOUBT_REACH] = a->reach_probability * (double)a->released;
    sums[CEDUO_DOUBT_EXCEED] = a->exceed_probability * (double)a->released;
    sums[CEDUO_DOUBT_ENERGY] = a->energy_per_released * (double)a->released;
}

/* The figures of the first and the second half of the rocks, to `halves`. */
static enum ceduo_status evaluate(const struct ceduo_doubt_def *def, const struct ceduo_scene *scene,
                                  struct ceduo_halves *halves)
{
    size_t options = scene->options_count;
    struct ceduo_question q = ceduo_question_default(scene);
    struct ceduo_pool *pool = NULL;
    enum ceduo_status status = CEDUO_OK;
    uint64_t before = 0;
    q.run.threads = 1;
    q.run.rocks_most = def->rocks;
    q.run.arrivals_only = true;
    q.run.cancel = def->cancel;
    for (int h = 0; h < 2 && status == CEDUO_OK; h++) {
        struct ceduo_answer answer;
        q.rocks = h == 0 ? def->rocks / 2 : def->rocks;
        status = ceduo_ask(&q, &pool, &answer);
        for (size_t i = 0; status == CEDUO_OK && i < options; i++) {
            double sums[CEDUO_DOUBT_KINDS];
            read_option(answer.result, i, sums);
            for (size_t k = 0; k < CEDUO_DOUBT_KINDS; k++) {
                struct ceduo_halves *y = &halves[i * CEDUO_DOUBT_KINDS + k];
                double first = h == 0 ? 0 : y->half[0] * (double)before;
                y->half[h] = (sums[k] - first) / (double)(q.rocks - before);
            }
        }
        ceduo_answer_release(&answer);
        before = q.rocks;
    }
    ceduo_pool_free(pool);
    for (size_t i = 1; i < options; i++)
        for (size_t k = 0; k < CEDUO_DOUBT_KINDS; k++)
            for (int h = 0; h < 2; h++)
                halves[figure_index(options, i, (enum ceduo_doubt_kind)k, true)].half[h] =
                    halves[i * CEDUO_DOUBT_KINDS + k].half[h] - halves[k].half[h];
    return status;
}

/* ---- many evaluations ---- */

struct work {
    const struct ceduo_doubt_def *def;
    size_t evaluations, figures;
    const double *u;             /* a row of inputs for each evaluation */
    struct ceduo_halves *values; /* a row of figures for each evaluation */
    uint64_t done_before, all;   /* for the progress: of all calls together */
    atomic_size_t next, done;
    atomic_int status;
    pthread_mutex_t talking;
};

static void tell(struct work *w)
{
    size_t done = atomic_fetch_add(&w->done, 1) + 1;
    if (!w->def->progress || pthread_mutex_trylock(&w->talking) != 0)
        return;
    w->def->progress(w->def->context, w->done_before + done, w->all);
    pthread_mutex_unlock(&w->talking);
}

static void *evaluate_all(void *context)
{
    struct work *w = context;
    const struct ceduo_doubt_def *def = w->def;
    struct input_scene copy;
    int good = CEDUO_OK, status = (int)ceduo_inputs_open(&copy, def->scene, def->inputs, def->inputs_count);
    for (size_t e; status == CEDUO_OK && atomic_load(&w->status) == CEDUO_OK &&
                   (e = atomic_fetch_add(&w->next, 1)) < w->evaluations;) {
        ceduo_inputs_set(&copy, w->u + e * def->inputs_count);
        status = (int)evaluate(def, &copy.scene, w->values + e * w->figures);
        tell(w);
    }
    ceduo_inputs_release(&copy);
    if (status != CEDUO_OK)
        atomic_compare_exchange_strong(&w->status, &good, status);
    return NULL;
}

/* Each row of `u` to a row of `values`. */
static enum ceduo_status run_all(struct work *w)
{
    unsigned n = w->def->threads, started = 0;
    pthread_t *threads = n > 1 ? calloc(n - 1, sizeof *threads) : NULL;
    atomic_init(&w->next, 0);
    atomic_init(&w->done, 0);
    atomic_init(&w->status, CEDUO_OK);
    pthread_mutex_init(&w->talking, NULL);
    while (threads && started < n - 1 && pthread_create(&threads[started], NULL, evaluate_all, w) == 0)
        started++;
    evaluate_all(w);
    while (started > 0)
        pthread_join(threads[--started], NULL);
    pthread_mutex_destroy(&w->talking);
    free(threads);
    return (enum ceduo_status)atomic_load(&w->status);
}

/* ---- the design of a scene ---- */

/* A design, its values, and the evaluations behind it with one group at each end, of `ends` groups. */
struct plan {
    struct ceduo_design design;
    size_t rows, ends;
    double *u;
    struct ceduo_halves *values;
};

static void plan_free(struct plan *p)
{
    free(p->u);
    free(p->values);
}

static enum ceduo_status fill_plan(struct plan *p)
{
    size_t n = p->design.inputs;
    for (size_t i = 0; i < 2 * p->ends * n; i++)
        p->u[p->rows * n + i] = NAN;
    for (size_t i = 0; i < n; i++) {
        size_t g = p->design.group[i];
        for (size_t end = 0; g < p->ends && end < 2; end++)
            p->u[(p->rows + 2 * g + end) * n + i] = (double)end;
    }
    return ceduo_design_fill(&p->design, p->u);
}

/* Makes the plan and computes it. */
static enum ceduo_status run_plan(const struct ceduo_doubt_def *def, struct plan *p, uint64_t done_before, uint64_t all)
{
    size_t figures = figures_of(def->scene);
    p->rows = ceduo_design_evaluations(&p->design);
    size_t evaluations = p->rows + 2 * p->ends;
    p->u = malloc(evaluations * def->inputs_count * sizeof *p->u);
    p->values = calloc(evaluations * figures, sizeof *p->values);
    if (!p->u || !p->values)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = fill_plan(p);
    struct work w = {.def = def,
                     .evaluations = evaluations,
                     .figures = figures,
                     .u = p->u,
                     .values = p->values,
                     .done_before = done_before,
                     .all = all};
    return status == CEDUO_OK ? run_all(&w) : status;
}

/* Values of one figure in the order of the design. */
static void column_of(const struct plan *p, size_t figures, size_t figure, struct ceduo_halves *column)
{
    for (size_t e = 0; e < p->rows; e++)
        column[e] = p->values[e * figures + figure];
}

/* ---- a first look at many inputs ---- */

/* The variance that an input brings (Jansen 1999), of the base points alone: enough to rank. */
static double weight_of(const struct ceduo_halves *values, const struct ceduo_design *d, size_t group)
{
    double sum = 0;
    for (size_t row = 0; row < d->points; row++) {
        const struct ceduo_halves *a = values + row * (d->groups + 2), *mixed = a + 2 + group;
        sum += (mixed->half[0] - a->half[0]) * (mixed->half[1] - a->half[1]);
    }
    return sum;
}

struct ranked {
    size_t input;
    double weight;
};

static int heavier_first(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    return x->weight != y->weight ? (x->weight < y->weight) - (x->weight > y->weight) : (x->input > y->input) - (x->input < y->input);
}

/* Ranks the inputs in lots of as many as a design has groups, all others moving together beside them, and gives the
 * heaviest a group each, the others the last one. */
static enum ceduo_status rank_inputs(const struct ceduo_doubt_def *def, size_t main, uint64_t all, uint64_t *done,
                                     size_t *group)
{
    enum ceduo_status status = CEDUO_OK;
    size_t n = def->inputs_count, figures = figures_of(def->scene);
    struct ranked *ranked = calloc(n, sizeof *ranked);
    struct ceduo_doubt_def coarse = *def; /* enough rocks to rank */
    coarse.rocks = def->rocks > COARSE_LEAST * COARSE ? def->rocks / COARSE : def->rocks;
    for (size_t from = 0; ranked && status == CEDUO_OK && from < n; from += GROUPS - 1) {
        size_t own = n - from < GROUPS - 1 ? n - from : GROUPS - 1;
        struct plan plan = {.design = {n, CEDUO_DOUBT_FIRST, def->scene->simulation.seed + from, own + 1, group}};
        for (size_t i = 0; i < n; i++)
            group[i] = i >= from && i < from + own ? i - from : own;
        status = run_plan(&coarse, &plan, *done, all);
        struct ceduo_halves *column = status == CEDUO_OK ? malloc(plan.rows * sizeof *column) : NULL;
        if (column)
            column_of(&plan, figures, main, column);
        for (size_t i = 0; column && i < own; i++)
            ranked[from + i] = (struct ranked){from + i, weight_of(column, &plan.design, i)};
        status = status == CEDUO_OK && !column ? CEDUO_NO_MEMORY : status;
        *done += plan.rows;
        free(column);
        plan_free(&plan);
    }
    if (ranked && status == CEDUO_OK) {
        qsort(ranked, n, sizeof *ranked, heavier_first);
        for (size_t i = 0; i < n; i++)
            group[ranked[i].input] = i < GROUPS - 1 ? i : GROUPS - 1;
    }
    status = ranked ? status : CEDUO_NO_MEMORY;
    free(ranked);
    return status;
}

/* ---- reading ---- */

static double quantile_of(const double *sorted, size_t n, double p)
{
    return gsl_stats_quantile_from_sorted_data(sorted, 1, n, p);
}

static double mean_of(struct ceduo_halves y)
{
    return (y.half[0] + y.half[1]) / 2;
}

struct sample {
    double u, y;
};

static int by_input(const void *a, const void *b)
{
    const struct sample *x = a, *y = b;
    return (x->u > y->u) - (x->u < y->u);
}

#define KNOWN_CLASSES 8

/* p95 - p5 among samples whose input is nearly the same, on the mean over such classes. */
static double width_if_known(struct sample *samples, size_t n, double *room)
{
    size_t classes = n / 4 < KNOWN_CLASSES ? n / 4 : KNOWN_CLASSES;
    double width = 0;
    if (classes == 0)
        return NAN;
    qsort(samples, n, sizeof *samples, by_input);
    for (size_t c = 0; c < classes; c++) {
        size_t from = c * n / classes, to = (c + 1) * n / classes;
        for (size_t i = from; i < to; i++)
            room[i - from] = samples[i].y;
        gsl_sort(room, 1, to - from);
        width += (quantile_of(room, to - from, 0.95) - quantile_of(room, to - from, 0.05)) / (double)classes;
    }
    return width;
}

/* Room for reading one figure: `points` rows of A and of B. */
struct reading {
    struct ceduo_halves *column;
    double *sorted, *room;
    struct sample *samples;
};

static bool reading_open(struct reading *r, const struct plan *p)
{
    size_t n = 2 * p->design.points;
    r->column = malloc(p->rows * sizeof *r->column);
    r->sorted = malloc(n * sizeof *r->sorted);
    r->room = malloc(n * sizeof *r->room);
    r->samples = malloc(n * sizeof *r->samples);
    return r->column && r->sorted && r->room && r->samples;
}

static void reading_close(struct reading *r)
{
    free(r->column);
    free(r->sorted);
    free(r->room);
    free(r->samples);
}

/* Percentiles over rows of A and B, and what is left of them once a group is known. */
static void read_spread(const struct plan *p, const size_t *input, struct reading *r, struct ceduo_doubt_figure *f)
{
    size_t n = 2 * p->design.points, stride = p->design.groups + 2;
    for (size_t i = 0; i < n; i++)
        r->sorted[i] = mean_of(r->column[i / 2 * stride + i % 2]);
    gsl_sort(r->sorted, 1, n);
    f->p5 = quantile_of(r->sorted, n, 0.05);
    f->p50 = quantile_of(r->sorted, n, 0.5);
    f->p95 = quantile_of(r->sorted, n, 0.95);
    for (size_t g = 0; g < p->design.groups; g++) {
        for (size_t i = 0; i < n; i++) {
            size_t e = i / 2 * stride + i % 2;
            r->samples[i] = (struct sample){p->u[e * p->design.inputs + input[g]], mean_of(r->column[e])};
        }
        f->left[g] = g < p->ends ? width_if_known(r->samples, n, r->room) : NAN;
    }
}

static enum ceduo_status read_figures(const struct ceduo_doubt_def *def, const struct plan *p,
                                      struct ceduo_doubt_answer *answer)
{
    enum ceduo_status status = CEDUO_OK;
    struct reading r = {0};
    if (!reading_open(&r, p))
        status = CEDUO_NO_MEMORY;
    for (size_t k = 0; status == CEDUO_OK && k < answer->figures_count; k++) {
        struct ceduo_doubt_figure *f = &answer->figures[k];
        size_t n = answer->figures_count, options = def->scene->options_count, at = k / CEDUO_DOUBT_KINDS;
        f->kind = (enum ceduo_doubt_kind)(k % CEDUO_DOUBT_KINDS);
        f->difference = at >= options;
        f->option = f->difference ? at - options + 1 : at;
        column_of(p, n, k, r.column);
        read_spread(p, answer->input, &r, f);
        for (size_t g = 0; g < GROUPS; g++)
            for (size_t end = 0; end < 2; end++)
                f->at[g][end] = g < p->ends ? mean_of(p->values[(p->rows + 2 * g + end) * n + k]) : NAN;
        status = ceduo_design_read(&p->design, r.column, &f->indices);
    }
    reading_close(&r);
    return status;
}

/* ---- the scene as it is ---- */

static void put_sampling(struct ceduo_doubt_figure *f, double value, double lo, double hi)
{
    f->value = value;
    f->sampling_lo = lo;
    f->sampling_hi = hi;
}

static void put_difference(struct ceduo_doubt_figure *f, struct ceduo_paired d)
{
    put_sampling(f, d.mean, d.mean - 1.96 * d.se, d.mean + 1.96 * d.se);
}

static enum ceduo_status read_sampling(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *answer)
{
    struct ceduo_question q = ceduo_question_default(def->scene);
    struct ceduo_answer is;
    size_t options = def->scene->options_count;
    q.rocks = q.run.rocks_most = def->rocks;
    q.run.threads = def->threads;
    q.run.cancel = def->cancel;
    q.run.arrivals_only = true;
    enum ceduo_status status = ceduo_ask(&q, NULL, &is);
    for (size_t i = 0; status == CEDUO_OK && i < options; i++) {
        const struct ceduo_result *r = is.result;
        const struct ceduo_arrivals *a = arrivals_of(r, i);
        struct ceduo_doubt_figure *f = &answer->figures[i * CEDUO_DOUBT_KINDS];
        put_sampling(&f[CEDUO_DOUBT_REACH], a->reach_probability, a->reach_lo, a->reach_hi);
        put_sampling(&f[CEDUO_DOUBT_EXCEED], a->exceed_probability, a->exceed_lo, a->exceed_hi);
        double half = 1.96 * a->energy_per_released_se;
        put_sampling(&f[CEDUO_DOUBT_ENERGY], a->energy_per_released, a->energy_per_released - half,
                     a->energy_per_released + half);
        if (i == 0)
            continue;
        f = &answer->figures[figure_index(options, i, CEDUO_DOUBT_REACH, true)];
        const struct ceduo_difference *d = &r->options[i].differences[r->last_control];
        put_difference(&f[CEDUO_DOUBT_REACH], d->reach_probability);
        put_difference(&f[CEDUO_DOUBT_EXCEED], d->exceed_probability);
        put_difference(&f[CEDUO_DOUBT_ENERGY], d->energy_per_released);
    }
    if (status == CEDUO_OK)
        answer->main = isnan(answer->figures[CEDUO_DOUBT_EXCEED].value) ? CEDUO_DOUBT_ENERGY : CEDUO_DOUBT_EXCEED;
    ceduo_answer_release(&is);
    return status;
}

/* ---- ranks ---- */

static double main_value(const struct ceduo_doubt_answer *a, size_t option)
{
    return a->figures[option * CEDUO_DOUBT_KINDS + a->main].value;
}

/* In how much of what may be true option `i` lets less through than option `k`; ties count half. */
static double share_better(const struct plan *p, const struct ceduo_doubt_answer *a, size_t i, size_t k)
{
    size_t stride = p->design.groups + 2, n = 2 * p->design.points;
    double better = 0;
    for (size_t s = 0; s < n; s++) {
        const struct ceduo_halves *y = p->values + (s / 2 * stride + s % 2) * a->figures_count + a->main;
        double one = mean_of(y[i * CEDUO_DOUBT_KINDS]), other = mean_of(y[k * CEDUO_DOUBT_KINDS]);
        better += one < other ? 1 : one == other ? 0.5 : 0;
    }
    return better / (double)n;
}

static enum ceduo_status read_orders(const struct ceduo_doubt_def *def, const struct plan *p, struct ceduo_doubt_answer *a)
{
    size_t n = def->scene->options_count;
    struct ranked *ranks = calloc(n, sizeof *ranks);
    a->orders = calloc(n, sizeof *a->orders);
    if (!ranks || !a->orders) {
        free(ranks);
        return CEDUO_NO_MEMORY;
    }
    for (size_t i = 0; i < n; i++)
        ranks[i] = (struct ranked){i, -main_value(a, i)};
    qsort(ranks, n, sizeof *ranks, heavier_first);
    for (size_t i = 0; i + 1 < n; i++) {
        size_t better = ranks[i].input, than = ranks[i + 1].input;
        a->orders[a->orders_count++] = (struct ceduo_doubt_order){better, than, share_better(p, a, better, than)};
    }
    free(ranks);
    return CEDUO_OK;
}

/* Groups by the largest total index that they have for the main figure of any option. */
static void order_groups(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *a)
{
    struct ranked ranks[GROUPS];
    for (size_t g = 0; g < a->groups; g++) {
        ranks[g] = (struct ranked){g, 0};
        for (size_t i = 0; i < def->scene->options_count; i++)
            ranks[g].weight = fmax(ranks[g].weight, a->figures[i * CEDUO_DOUBT_KINDS + a->main].indices.total[g].value);
    }
    qsort(ranks, a->groups, sizeof *ranks, heavier_first);
    for (size_t g = 0; g < a->groups; g++)
        a->order[g] = ranks[g].input;
}

/* ---- all of it ---- */

static uint64_t evaluations_of(const struct ceduo_doubt_def *def, size_t groups)
{
    uint64_t all = def->points * (groups + 2) + 2 * groups, n = def->inputs_count;
    if (n > GROUPS)
        all += (n + GROUPS - 2) / (GROUPS - 1) * CEDUO_DOUBT_FIRST * (GROUPS + 2);
    return all;
}

static void name_groups(struct ceduo_doubt_answer *a, const size_t *group, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (n > GROUPS && group[i] == GROUPS - 1)
            a->together++;
        else
            a->input[group[i]] = i;
}

static enum ceduo_status compute(const struct ceduo_doubt_def *def, size_t *group, struct ceduo_doubt_answer *a)
{
    uint64_t done = 0;
    a->groups = def->inputs_count > GROUPS ? GROUPS : def->inputs_count;
    a->evaluations = evaluations_of(def, a->groups);
    for (size_t i = 0; i < def->inputs_count; i++)
        group[i] = i;
    enum ceduo_status status = read_sampling(def, a);
    if (status == CEDUO_OK && def->inputs_count > GROUPS)
        status = rank_inputs(def, (size_t)a->main, a->evaluations, &done, group);
    if (status != CEDUO_OK)
        return status;
    name_groups(a, group, def->inputs_count);
    struct plan plan = {
        .design = {def->inputs_count, def->points, def->scene->simulation.seed, a->groups, group},
        .ends = a->together > 0 ? a->groups - 1 : a->groups};
    status = run_plan(def, &plan, done, a->evaluations);
    if (status == CEDUO_OK)
        status = read_figures(def, &plan, a);
    if (status == CEDUO_OK)
        status = read_orders(def, &plan, a);
    if (status == CEDUO_OK)
        order_groups(def, a);
    plan_free(&plan);
    return status;
}

enum ceduo_status ceduo_doubt_ask(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *answer)
{
    *answer = (struct ceduo_doubt_answer){.figures_count = figures_of(def->scene)};
    size_t *group = calloc(def->inputs_count + 1, sizeof *group);
    answer->figures = calloc(answer->figures_count, sizeof *answer->figures);
    enum ceduo_status status = group && answer->figures ? compute(def, group, answer) : CEDUO_NO_MEMORY;
    free(group);
    if (status != CEDUO_OK)
        ceduo_doubt_free(answer);
    return status;
}

void ceduo_doubt_free(struct ceduo_doubt_answer *answer)
{
    free(answer->figures);
    free(answer->orders);
    *answer = (struct ceduo_doubt_answer){0};
}

const struct ceduo_doubt_figure *ceduo_doubt_figure_of(const struct ceduo_doubt_answer *answer, size_t option,
                                                       enum ceduo_doubt_kind kind, bool difference)
{
    size_t options = (answer->figures_count / CEDUO_DOUBT_KINDS + 1) / 2;
    return &answer->figures[figure_index(options, option, kind, difference)];
}
