/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What doubt does to the figures of a scene. A plan (doubt_plan.c) holds the evaluations: a design (sensitivity.c), and the
 * scene with one input at each end of its range. Here a plan is made, computed and read. With more inputs than can have an
 * index, a first look ranks them, and the least move together. */
#include "ceduo/doubt.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/question.h"
#include "doubt_plan.h"

#define GROUPS       CEDUO_SENSITIVITY_GROUPS
#define COARSE       4  /* times fewer rocks in a first look, */
#define COARSE_LEAST 50 /* but so many */

static const struct ceduo_arrivals *arrivals_of(const struct ceduo_result *r, size_t option)
{
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, r->last_control);
    return wooded ? wooded : &r->bare.arrivals[r->last_control];
}

/* ---- a first look at many inputs ---- */

static size_t first_points(const struct ceduo_doubt_def *def)
{
    return def->first > 0 ? def->first : CEDUO_DOUBT_FIRST;
}

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
    return x->weight != y->weight ? (x->weight < y->weight) - (x->weight > y->weight)
                                  : (x->input > y->input) - (x->input < y->input);
}

/* Ranks the inputs in lots of as many as a design has groups, all others moving together beside them, and gives the
 * heaviest a group each, the others the last one. */
static enum ceduo_status rank_inputs(const struct ceduo_doubt_def *def, size_t main, uint64_t all, uint64_t *done,
                                     size_t *group)
{
    enum ceduo_status status = CEDUO_OK;
    size_t n = def->inputs_count, figures = ceduo_plan_figures(def->scene);
    struct ranked *ranked = calloc(n, sizeof *ranked);
    struct ceduo_doubt_def coarse = *def; /* enough rocks to rank */
    coarse.rocks = def->rocks > COARSE_LEAST * COARSE ? def->rocks / COARSE : def->rocks;
    for (size_t from = 0; ranked && status == CEDUO_OK && from < n; from += GROUPS - 1) {
        size_t own = n - from < GROUPS - 1 ? n - from : GROUPS - 1;
        struct plan plan = {.design = {n, first_points(def), def->scene->simulation.seed + from, own + 1, group}};
        for (size_t i = 0; i < n; i++)
            group[i] = i >= from && i < from + own ? i - from : own;
        status = ceduo_plan_fill(&coarse, &plan);
        if (status == CEDUO_OK)
            status = ceduo_plan_run(&coarse, &plan, 1, done, all);
        struct ceduo_halves *column = status == CEDUO_OK ? malloc(plan.rows * sizeof *column) : NULL;
        if (column)
            ceduo_plan_column(&plan, figures, main, column);
        for (size_t i = 0; column && i < own; i++)
            ranked[from + i] = (struct ranked){from + i, weight_of(column, &plan.design, i)};
        status = status == CEDUO_OK && !column ? CEDUO_NO_MEMORY : status;
        free(column);
        ceduo_plan_release(&plan);
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

static double width_of(double *values, size_t n)
{
    gsl_sort(values, 1, n);
    return ceduo_quantile(values, n, 0.95) - ceduo_quantile(values, n, 0.05);
}

#define KNOWN_CLASSES 8

/* p95 - p5 within classes of samples that follow one another, on the mean. */
static double width_of_classes(const struct sample *samples, size_t n, double *room)
{
    size_t classes = n / 4 < KNOWN_CLASSES ? n / 4 : KNOWN_CLASSES;
    double width = 0;
    for (size_t c = 0; c < classes; c++) {
        size_t from = c * n / classes, to = (c + 1) * n / classes;
        for (size_t i = from; i < to; i++)
            room[i - from] = samples[i].y;
        width += width_of(room, to - from) / (double)classes;
    }
    return width;
}

/* The share of p95 - p5 that is left among samples whose input is nearly the same. Classes are small, and few samples spread
 * less than many: they are compared with classes of any samples. */
static double left_if_known(struct sample *samples, size_t n, double *room)
{
    double any = width_of_classes(samples, n, room);
    qsort(samples, n, sizeof *samples, by_input);
    return any > 0 ? width_of_classes(samples, n, room) / any : 1;
}

/* Room for reading one figure: `points` rows of A and of B. */
struct figure_room {
    struct ceduo_halves *column;
    double *sorted, *room;
    struct sample *samples;
};

/* Percentiles over rows of A and B, and what is left of them once a group is known. */
static void read_spread(const struct plan *p, const size_t *input, struct figure_room *r, struct ceduo_doubt_figure *f)
{
    size_t n = 2 * p->design.points, stride = p->design.groups + 2;
    for (size_t i = 0; i < n; i++)
        r->sorted[i] = mean_of(r->column[i / 2 * stride + i % 2]);
    gsl_sort(r->sorted, 1, n);
    f->p5 = ceduo_quantile(r->sorted, n, 0.05);
    f->p50 = ceduo_quantile(r->sorted, n, 0.5);
    f->p95 = ceduo_quantile(r->sorted, n, 0.95);
    for (size_t g = 0; g < p->design.groups; g++) {
        for (size_t i = 0; i < n; i++) {
            size_t e = i / 2 * stride + i % 2;
            r->samples[i] = (struct sample){p->u[e * p->design.inputs + input[g]], mean_of(r->column[e])};
        }
        f->left[g] = g < p->ends ? (f->p95 - f->p5) * left_if_known(r->samples, n, r->room) : NAN;
    }
}

static enum ceduo_status read_figures(const struct ceduo_doubt_def *def, const struct plan *p,
                                      struct ceduo_doubt_answer *answer)
{
    size_t samples = 2 * p->design.points;
    struct figure_room r = {.column = malloc(p->rows * sizeof *r.column),
                            .sorted = malloc(samples * sizeof *r.sorted),
                            .room = malloc(samples * sizeof *r.room),
                            .samples = malloc(samples * sizeof *r.samples)};
    enum ceduo_status status = r.column && r.sorted && r.room && r.samples ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t k = 0; status == CEDUO_OK && k < answer->figures_count; k++) {
        struct ceduo_doubt_figure *f = &answer->figures[k];
        size_t n = answer->figures_count, options = def->scene->options_count, at = k / CEDUO_DOUBT_KINDS;
        f->kind = (enum ceduo_doubt_kind)(k % CEDUO_DOUBT_KINDS);
        f->difference = at >= options;
        f->option = f->difference ? at - options + 1 : at;
        ceduo_plan_column(p, n, k, r.column);
        read_spread(p, answer->input, &r, f);
        for (size_t g = 0; g < GROUPS; g++)
            for (size_t end = 0; end < 2; end++)
                f->at[g][end] = g < p->ends ? mean_of(p->values[(p->rows + 2 * g + end) * n + k]) : NAN;
        status = ceduo_design_read(&p->design, r.column, &f->indices);
    }
    free(r.column);
    free(r.sorted);
    free(r.room);
    free(r.samples);
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
    double half = d.below > 0 ? d.below : CEDUO_Z95 * d.se;
    put_sampling(f, d.mean, d.mean - half, d.mean + half);
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
        double half = ceduo_half_width(a->energy_per_released_se, a->released);
        put_sampling(&f[CEDUO_DOUBT_ENERGY], a->energy_per_released, a->energy_per_released - half,
                     a->energy_per_released + half);
        if (i == 0)
            continue;
        f = &answer->figures[ceduo_plan_figure(options, i, CEDUO_DOUBT_REACH, true)];
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

/* The difference of two options at a sample of a plan, by each half of the rocks. */
static struct ceduo_halves difference_at(const struct plan *p, const struct ceduo_doubt_answer *a, size_t s, size_t i, size_t k)
{
    const struct ceduo_halves *y = p->values + (s / 2 * (p->design.groups + 2) + s % 2) * a->figures_count + a->main;
    struct ceduo_halves d;
    for (int h = 0; h < 2; h++)
        d.half[h] = y[i * CEDUO_DOUBT_KINDS].half[h] - y[k * CEDUO_DOUBT_KINDS].half[h];
    return d;
}

/* How two options compare where they differ by more than the rocks alone would make them: both halves have the same rocks
 * everywhere, so that what varies between them is noise. */
static struct ceduo_doubt_order compare(const struct plan *p, const struct ceduo_doubt_answer *a, size_t better, size_t than)
{
    struct ceduo_doubt_order o = {.better = better, .than = than};
    struct ceduo_moments apart = {0};
    size_t n = 2 * p->design.points;
    for (size_t s = 0; s < n; s++) {
        struct ceduo_halves d = difference_at(p, a, s, better, than);
        ceduo_moments_add(&apart, (d.half[0] - d.half[1]) / 2);
    }
    double noise = CEDUO_Z95 * ceduo_moments_sd(&apart);
    for (size_t s = 0; s < n; s++) {
        double d = mean_of(difference_at(p, a, s, better, than));
        *(d < -noise ? &o.probability : d > noise ? &o.worse : &o.equal) += 1 / (double)n;
    }
    return o;
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
        a->orders[a->orders_count++] = compare(p, a, better, than);
    }
    free(ranks);
    return CEDUO_OK;
}

void ceduo_doubt_order_of(const struct ceduo_doubt_answer *a, const struct ceduo_doubt_figure *f, size_t *order)
{
    struct ranked ranks[GROUPS];
    for (size_t g = 0; g < a->groups; g++)
        ranks[g] = (struct ranked){g, isnan(f->left[g]) ? -INFINITY : -f->left[g]};
    qsort(ranks, a->groups, sizeof *ranks, heavier_first);
    for (size_t g = 0; g < a->groups; g++)
        order[g] = ranks[g].input;
}

/* ---- all of it ---- */

static uint64_t evaluations_of(const struct ceduo_doubt_def *def, size_t groups)
{
    uint64_t all = def->points * (groups + 2) + 2 * groups, n = def->inputs_count;
    if (n > GROUPS)
        all += (n + GROUPS - 2) / (GROUPS - 1) * first_points(def) * (GROUPS + 2);
    return all;
}

/* Names the input of each group; of those that move together all. False without memory. */
static bool name_groups(struct ceduo_doubt_answer *a, const size_t *group, size_t n)
{
    a->moved = calloc(n + 1, sizeof *a->moved);
    for (size_t i = 0; a->moved && i < n; i++)
        if (n > GROUPS && group[i] == GROUPS - 1)
            a->moved[a->together++] = i;
        else
            a->input[group[i]] = i;
    return a->moved != NULL;
}

enum ceduo_status ceduo_doubt_ask(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *a)
{
    size_t n = def->inputs_count, *group = calloc(n + 1, sizeof *group);
    struct plan plan = {.design = {n, def->points, def->scene->simulation.seed, n > GROUPS ? GROUPS : n, group}};
    uint64_t done = 0;
    *a = (struct ceduo_doubt_answer){.figures_count = ceduo_plan_figures(def->scene), .groups = plan.design.groups};
    a->figures = calloc(a->figures_count, sizeof *a->figures);
    a->evaluations = evaluations_of(def, a->groups);
    for (size_t i = 0; group && i < n; i++)
        group[i] = i;
    enum ceduo_status status = group && a->figures ? read_sampling(def, a) : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK && n > GROUPS)
        status = rank_inputs(def, (size_t)a->main, a->evaluations, &done, group);
    if (status == CEDUO_OK && !name_groups(a, group, n))
        status = CEDUO_NO_MEMORY;
    plan.ends = a->together > 0 ? a->groups - 1 : a->groups;
    if (status == CEDUO_OK)
        status = ceduo_plan_fill(def, &plan);
    if (status == CEDUO_OK)
        status = ceduo_plan_run(def, &plan, 0, &done, a->evaluations);
    if (status == CEDUO_OK)
        status = read_figures(def, &plan, a);
    if (status == CEDUO_OK)
        status = read_orders(def, &plan, a);
    ceduo_plan_release(&plan);
    free(group);
    if (status != CEDUO_OK)
        ceduo_doubt_free(a);
    return status;
}

void ceduo_doubt_free(struct ceduo_doubt_answer *answer)
{
    free(answer->figures);
    free(answer->orders);
    free(answer->moved);
    *answer = (struct ceduo_doubt_answer){0};
}

const struct ceduo_doubt_figure *ceduo_doubt_figure_of(const struct ceduo_doubt_answer *answer, size_t option,
                                                       enum ceduo_doubt_kind kind, bool difference)
{
    size_t options = (answer->figures_count / CEDUO_DOUBT_KINDS + 1) / 2;
    return &answer->figures[ceduo_plan_figure(options, option, kind, difference)];
}
