/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is not known of a scene, and what that does to its figures. The scene is computed at points of what may be true, with the
 * same few rocks (points.c), and with one input at each end of its range; a surface through each figure says what it depends on
 * (surface.c). Over a rotation each year has a surface of its own, whose values at the points are without the noise of the few
 * rocks; they say which years fail. */
#include "ceduo/uncertainty.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "ceduo/assess.h"
#include "ceduo/question.h"
#include "check_study.h"
#include "inputs.h"
#include "points.h"

#define GROUPS CEDUO_SURFACE_GROUPS
#define ALSO   0.5 /* a second input is named where its share is at least this of the first one's */

/* Rows of inputs: two for each input, with it at its ends and all others NaN, then the points. */
struct rows {
    const struct ceduo_uncertainty_def *def;
    struct ceduo_uncertainty_result *answer;
    struct arena memory;
    size_t ends, points, options, most; /* most: points */
    double *u;
    struct ceduo_replicates *values; /* of each row, option and kind */
    enum ceduo_uncertainty_kind judged;
    double released;                 /* J: mean energy per released rock without forest */
    size_t years;                    /* of each option; 0: not asked for */
    double year_count;               /* years that these stand for */
    struct ceduo_replicates *shares; /* of each option, year and point */
    bool deciding; /* only figures that decide whether there are points enough are read; otherwise only the others */
    size_t all;    /* evaluations, for the progress */
    atomic_size_t done;
    struct talk talk;
};

static bool is_asked(const struct rows *r, size_t option)
{
    return !r->def->alone || option == r->def->option;
}

static struct ceduo_replicates *values_of(const struct rows *r, size_t row, size_t option)
{
    return r->values + (row * r->options + option) * CEDUO_UNCERTAINTY_KINDS;
}

/* ---- the rows ---- */

static void report(void *context)
{
    struct rows *r = context;
    const struct ceduo_uncertainty_def *def = r->def;
    size_t done = atomic_fetch_add(&r->done, 1) + 1;
    if (!def->progress || !ceduo_talk_begin(&r->talk))
        return;
    def->progress(def->context, done, r->all);
    ceduo_talk_end(&r->talk);
}

/* Of the share that a scene's last control is judged by. */
static double limit_of(const struct ceduo_scene *scene)
{
    return ceduo_exceed_limit(scene, &scene->controls[ceduo_scene_last_control(scene)]);
}

static void read_point(void *context, const struct point *point, const struct control_means *at)
{
    const struct rows *r = context;
    size_t last = ceduo_scene_last_control(point->scene);
    struct ceduo_replicates *values = values_of(r, point->row, point->option);
    /* With blocks a share means a rate: if more come down, as large a share is more. */
    double weight = limit_of(r->def->scene) / limit_of(point->scene);
    for (size_t g = 0; g < GROUPS && point->slot > 0; g++) {
        const struct ceduo_group_means *b = &at[last].of[g];
        double share = r->judged == CEDUO_UNCERTAINTY_EXCEED ? weight * b->exceed_probability : b->reach_probability;
        double *mean = &values[CEDUO_UNCERTAINTY_MEAN].of[g]; /* of the years, added up as they come */
        r->shares[(point->option * r->years + point->slot - 1) * r->most + point->row - r->ends].of[g] = share;
        *mean = (point->slot == 1 ? 0 : *mean) + share / (double)r->years;
    }
    if (point->slot > 0)
        return;
    struct ceduo_index index = ceduo_assess_index(point->scene, point->forest, &point->scene->controls[last], NAN);
    for (size_t g = 0; g < GROUPS; g++) {
        values[CEDUO_UNCERTAINTY_REACH].of[g] = at[last].of[g].reach_probability;
        values[CEDUO_UNCERTAINTY_EXCEED].of[g] = weight * at[last].of[g].exceed_probability;
        values[CEDUO_UNCERTAINTY_ENERGY].of[g] = at[last].of[g].energy_per_released;
        values[CEDUO_UNCERTAINTY_CONTACT].of[g] = 1 / index.worst_adc; /* no rock decides it: the same in all groups */
        values[CEDUO_UNCERTAINTY_FREE_RUN].of[g] = index.worst_free_run;
    }
}

/* Room for all rows, and for the years of a rotation. */
static enum ceduo_status open_rows(struct rows *r, const struct ceduo_uncertainty_def *def,
                                   struct ceduo_uncertainty_result *answer)
{
    size_t n = def->inputs_count;
    *r = (struct rows){.def = def, .answer = answer, .ends = def->brief ? 0 : 2 * n, .options = def->scene->options_count};
    r->most = def->points_max > 0 ? def->points_max : CEDUO_UNCERTAINTY_POINTS_MAX;
    r->most = def->points > r->most ? def->points : r->most;
    r->u = ceduo_arena_alloc(&r->memory, (r->ends + r->most) * n * sizeof *r->u);
    r->values = ceduo_arena_alloc(&r->memory, (r->ends + r->most) * r->options * CEDUO_UNCERTAINTY_KINDS * sizeof *r->values);
    r->years = def->rotation ? ceduo_points_years(def) : 0;
    r->year_count = def->rotation ? (double)ceduo_points_window(def) : 0;
    r->shares = ceduo_arena_alloc(&r->memory, r->options * r->years * r->most * sizeof *r->shares);
    if (r->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t row = 0; row < r->ends; row++)
        for (size_t i = 0; i < n; i++)
            r->u[row * n + i] = i == row / 2 ? (double)(row % 2) : NAN;
    return ceduo_surface_points(def->scene->simulation.seed, r->most, n, r->u + r->ends * n);
}

/* Evaluates up to so many points, and first the ends, which have most of their forests in common. */
static enum ceduo_status extend(struct rows *r, size_t points)
{
    size_t from = r->points > 0 ? r->ends + r->points : 0;
    const struct points p = {.def = r->def, .u = r->u, .today = true, .read = read_point, .done = report, .context = r};
    r->all = r->ends + points;
    atomic_store(&r->done, from);
    enum ceduo_status status = ceduo_points_run(&p, from, r->ends + points, from == 0 ? r->ends : 0);
    r->points = points;
    return status;
}

/* ---- figures ---- */

static size_t figure_at(size_t options, size_t option, enum ceduo_uncertainty_kind kind, bool difference)
{
    return (difference ? options + option - 1 : option) * CEDUO_UNCERTAINTY_KINDS + kind;
}

const struct ceduo_uncertainty_figure *ceduo_uncertainty_find_figure(const struct ceduo_uncertainty_result *answer,
                                                                     size_t option, enum ceduo_uncertainty_kind kind,
                                                                     bool difference)
{
    size_t options = (answer->figures_count / CEDUO_UNCERTAINTY_KINDS + 1) / 2;
    if (option >= options || kind >= CEDUO_UNCERTAINTY_KINDS || (difference && option == 0))
        return NULL;
    return &answer->figures[figure_at(options, option, kind, difference)];
}

/* What a surface is made of: an option, or its difference to another one, which inputs they have, and room for a figure at the
 * points and for what is left of it. */
struct subject {
    size_t option, against; /* the same: no difference */
    struct arena memory;
    struct ceduo_surface *surface;
    bool *has, *uses; /* inputs of the options; those that the figure at hand may depend on */
    double *left;     /* of each input */
    struct ceduo_replicates *column;
};

static enum ceduo_status open_subject(const struct rows *r, size_t option, size_t against, struct subject *s)
{
    size_t n = r->def->inputs_count;
    *s = (struct subject){.option = option, .against = against};
    s->has = ceduo_arena_alloc(&s->memory, n * sizeof *s->has);
    s->uses = ceduo_arena_alloc(&s->memory, n * sizeof *s->uses);
    s->left = ceduo_arena_alloc(&s->memory, n * sizeof *s->left);
    s->column = ceduo_arena_alloc(&s->memory, r->points * sizeof *s->column);
    enum ceduo_status status = ceduo_surface_open(r->def->inputs, n, r->u + r->ends * n, r->points, &s->surface);
    if (s->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n; i++)
        s->has[i] = ceduo_input_is_of(&r->def->inputs[i], option) || ceduo_input_is_of(&r->def->inputs[i], against);
    return status;
}

static void close_subject(struct subject *s)
{
    ceduo_surface_free(s->surface);
    ceduo_arena_free(&s->memory);
}

/* What a row has of a subject: of a difference that of its option less that of the other. */
static struct ceduo_replicates value_at(const struct rows *r, const struct subject *s, size_t row,
                                        enum ceduo_uncertainty_kind kind)
{
    struct ceduo_replicates y = values_of(r, row, s->option)[kind];
    for (size_t g = 0; s->option != s->against && g < GROUPS; g++)
        y.of[g] -= values_of(r, row, s->against)[kind].of[g];
    return y;
}

static bool is_rotation(enum ceduo_uncertainty_kind kind)
{
    return kind == CEDUO_UNCERTAINTY_MEAN || kind == CEDUO_UNCERTAINTY_FAILING;
}

/* Figures of today do not depend on inputs of the years. */
static void choose_inputs(const struct rows *r, const struct subject *s, enum ceduo_uncertainty_kind kind)
{
    for (size_t i = 0; i < r->def->inputs_count; i++)
        s->uses[i] = s->has[i] && (is_rotation(kind) || !ceduo_input_is_of_years(&r->def->inputs[i]));
}

/* Fits what the points have of a subject; `figure`: within what bounds. */
static enum ceduo_status fit_points(const struct rows *r, const struct subject *s, enum ceduo_uncertainty_kind kind,
                                    struct ceduo_surface_figure figure, struct ceduo_surface_fit *fit)
{
    for (size_t p = 0; p < r->points; p++)
        s->column[p] = value_at(r, s, r->ends + p, kind);
    choose_inputs(r, s, kind);
    figure.y = s->column;
    figure.uses = s->uses;
    return ceduo_surface_fit(s->surface, &figure, fit);
}

/* Widens the range until it holds the value of the scene as it is (NaN: unknown); of too few points there is none. */
static void set_range(const struct rows *r, double value, struct ceduo_surface_fit *fit)
{
    if (r->points < CEDUO_UNCERTAINTY_MIN) {
        fit->p5 = fit->p50 = fit->p95 = fit->p5_se = fit->p95_se = NAN;
        for (size_t i = 0; i < r->def->inputs_count; i++)
            fit->left[i] = NAN;
        return;
    }
    if (!isnan(value))
        fit->p5 = fmin(fit->p5, value), fit->p95 = fmax(fit->p95, value);
}

static enum ceduo_status read_figure(const struct rows *r, const struct subject *s, struct ceduo_uncertainty_figure *f)
{
    const struct ceduo_uncertainty_def *def = r->def;
    bool judged =
        !f->difference && (f->kind == r->judged || f->kind == CEDUO_UNCERTAINTY_MEAN) && r->judged == CEDUO_UNCERTAINTY_EXCEED;
    double max = f->kind == CEDUO_UNCERTAINTY_ENERGY || f->kind == CEDUO_UNCERTAINTY_CONTACT ? INFINITY : 1;
    if (f->kind == CEDUO_UNCERTAINTY_FAILING)
        max = r->year_count;
    for (size_t row = 0; row < r->ends; row++) {
        const struct ceduo_replicates y = value_at(r, s, row, f->kind);
        f->at[row / 2][row % 2] = is_rotation(f->kind) ? NAN : ceduo_groups_mean(&y, def->rocks);
    }
    ceduo_surface_release(&f->fit);
    const struct ceduo_surface_figure figure = {
        .lo = f->difference ? -max : 0, .hi = max, .limit = judged ? limit_of(def->scene) : NAN};
    enum ceduo_status status = fit_points(r, s, f->kind, figure, &f->fit);
    if (status != CEDUO_OK)
        return status;
    set_range(r, f->value, &f->fit);
    f->uses = 0;
    for (size_t i = 0; i < def->inputs_count; i++) {
        f->uses += s->uses[i];
        s->left[i] = !s->uses[i] ? INFINITY : isnan(f->fit.left[i]) ? 0 : f->fit.left[i];
        ceduo_insert_index(s->left, i, i, f->order);
    }
    return CEDUO_OK;
}

/* True if a kind of figure is computed. Years fail by what the place withstands. */
static bool is_there(const struct rows *r, enum ceduo_uncertainty_kind kind)
{
    if (is_rotation(kind))
        return r->years > 0 && (kind == CEDUO_UNCERTAINTY_MEAN || r->judged == CEDUO_UNCERTAINTY_EXCEED);
    bool share = kind == CEDUO_UNCERTAINTY_REACH || kind == CEDUO_UNCERTAINTY_EXCEED;
    return !r->def->brief || (share ? kind == r->judged : kind != CEDUO_UNCERTAINTY_ENERGY || kind == r->answer->main);
}

/* An option, or behind them a difference to the first one: its figures one after the other, as their surfaces have the terms in
 * common. */
static int read_figures_of(void *context, size_t item, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    bool difference = item >= r->options;
    size_t option = difference ? item - r->options + 1 : item;
    struct subject s;
    if (!is_asked(r, option) || (difference && (r->def->alone || r->def->brief)))
        return CEDUO_OK;
    enum ceduo_status status = open_subject(r, option, difference ? 0 : option, &s);
    for (size_t kind = 0; kind < CEDUO_UNCERTAINTY_KINDS && status == CEDUO_OK; kind++) {
        struct ceduo_uncertainty_figure *f = &r->answer->figures[item * CEDUO_UNCERTAINTY_KINDS + kind];
        f->kind = (enum ceduo_uncertainty_kind)kind;
        f->difference = difference;
        f->option = option;
        bool decides = !difference && (f->kind == r->answer->main || f->kind == CEDUO_UNCERTAINTY_MEAN);
        if (is_there(r, f->kind) && decides == r->deciding)
            status = read_figure(r, &s, f);
    }
    close_subject(&s);
    return (int)status;
}

static enum ceduo_status read_figures(struct rows *r, bool deciding)
{
    size_t items = deciding ? r->options : r->answer->figures_count / CEDUO_UNCERTAINTY_KINDS;
    r->deciding = deciding;
    return (enum ceduo_status)ceduo_parallel(&(struct parallel){items, r->def->threads, read_figures_of, r});
}

/* ---- which years fail ---- */

/* At each point the years whose surface is above what is allowed. Groups have that number as their mean, and its
 * noise by halves of the rocks. */
static int count_years(void *context, size_t option, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    if (!is_asked(r, option))
        return CEDUO_OK;
    size_t years = r->years, points = r->points;
    double limit = limit_of(r->def->scene), each = r->year_count / (double)years;
    struct subject s;
    enum ceduo_status status = open_subject(r, option, option, &s);
    double *values = ceduo_arena_alloc(&s.memory, years * points * sizeof *values);
    struct ceduo_replicates *y = ceduo_arena_alloc(&s.memory, years * points * sizeof *y);
    struct ceduo_replicates *changes = ceduo_arena_alloc(&s.memory, years * points * sizeof *changes);
    status = s.memory.failed ? CEDUO_NO_MEMORY : status;
    if (status == CEDUO_OK) {
        choose_inputs(r, &s, CEDUO_UNCERTAINTY_FAILING);
        for (size_t k = 0; k < years; k++)
            memcpy(y + k * points, r->shares + (option * years + k) * r->most, points * sizeof *y);
        const struct ceduo_surface_figure figure = {.y = y, .uses = s.uses, .hi = 1, .limit = NAN};
        status = ceduo_surface_values(s.surface, &figure, years, values, changes);
    }
    for (size_t p = 0; p < points && status == CEDUO_OK; p++) {
        struct ceduo_replicates *failing = &values_of(r, r->ends + p, option)[CEDUO_UNCERTAINTY_FAILING];
        double all = 0, halves[GROUPS] = {0};
        for (size_t k = p; k < years * points; k += points) {
            all += each * (values[k] > limit);
            for (size_t half = 1; half < GROUPS; half++)
                halves[half] +=
                    each / 2 * ((values[k] + changes[k].of[half] > limit) - (values[k] - changes[k].of[half] > limit));
        }
        ceduo_replicates_from_half_samples(failing, all, halves);
    }
    close_subject(&s);
    return (int)status;
}

/* Whether more points would tell more: a surface of an option explains too little. */
static bool wants_more(const struct rows *r)
{
    const struct ceduo_uncertainty_result *a = r->answer;
    for (size_t i = 0; i < r->options; i++)
        for (size_t over = is_asked(r, i) ? 0 : 2; over < (r->years > 0 ? 2 : 1); over++) {
            const struct ceduo_surface_fit *fit =
                &ceduo_uncertainty_find_figure(a, i, over ? CEDUO_UNCERTAINTY_MEAN : a->main, false)->fit;
            if (fit->enough && !fit->linear ? fit->explained < CEDUO_UNCERTAINTY_EXPLAINED
                                            : fit->variance > 0 && r->points >= CEDUO_UNCERTAINTY_POINTS)
                return true;
        }
    return false;
}

/* ---- the scene as it is ---- */

static void set_sampling(struct ceduo_uncertainty_figure *f, struct ceduo_estimate estimate)
{
    f->value = estimate.mean;
    f->sampling_lo = estimate.lo;
    f->sampling_hi = estimate.hi;
}

static void set_years(const struct rows *r, struct ceduo_years *const *years, bool judges)
{
    struct ceduo_uncertainty_result *answer = r->answer;
    double first[3] = {0};
    for (size_t i = 0, options = r->options; i < options; i++) {
        size_t control = years[i]->last_control;
        double each = r->year_count / (double)years[i]->count; /* years that one year stands for */
        struct ceduo_years_summary s = ceduo_years_sum(years[i], control);
        struct ceduo_uncertainty_figure *f = &answer->figures[i * CEDUO_UNCERTAINTY_KINDS],
                                        *d = &answer->figures[figure_at(options, i, CEDUO_UNCERTAINTY_REACH, i > 0)];
        struct ceduo_estimate mean = judges ? s.exceed : s.reach;
        double counts[3] = {0};
        mean = ceduo_estimate_by_se(mean.mean, mean.se);
        mean.lo = fmax(0, mean.lo);
        mean.hi = fmin(1, mean.hi);
        set_sampling(&f[CEDUO_UNCERTAINTY_MEAN], mean);
        if (i > 0)
            set_sampling(&d[CEDUO_UNCERTAINTY_MEAN], ceduo_years_difference(years[i], years[0]));
        if (!judges)
            continue;
        for (size_t k = 0; k < years[i]->count; k++) { /* by the ends of their intervals, and by their shares */
            const struct ceduo_arrivals *a = &years[i]->years[k].wooded.arrivals[control];
            counts[0] += each * (a->exceed.lo > a->limit);
            counts[1] += each * (a->exceed.mean > a->limit);
            counts[2] += each * (a->exceed.hi > a->limit);
        }
        set_sampling(&f[CEDUO_UNCERTAINTY_FAILING], (struct ceduo_estimate){counts[1], NAN, counts[0], counts[2]});
        if (i > 0)
            set_sampling(&d[CEDUO_UNCERTAINTY_FAILING],
                         (struct ceduo_estimate){counts[1] - first[1], NAN, counts[0] - first[2], counts[2] - first[0]});
        else
            memcpy(first, counts, sizeof first);
    }
}

static enum ceduo_status read_sampling(struct rows *rows)
{
    const struct ceduo_uncertainty_def *def = rows->def;
    struct ceduo_uncertainty_result *answer = rows->answer;
    struct ceduo_request q = ceduo_request_default(def->scene);
    struct ceduo_results asked = {0};
    const struct ceduo_results *is = def->own ? def->own : &asked;
    size_t options = def->scene->options_count;
    q.rocks = q.run.rocks_most = def->own_rocks > 0 ? def->own_rocks : def->rocks;
    q.run.threads = def->threads;
    q.run.cancel = def->cancel;
    q.run.arrivals_only = true;
    q.years = rows->years > 0;
    q.window = def->window;
    q.year_rocks = CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS;
    enum ceduo_status status = def->own ? CEDUO_OK : ceduo_simulate_request(&q, NULL, &asked);
    answer->own_rocks = status == CEDUO_OK ? ceduo_result_rocks(is->result) : 0;
    for (size_t i = 0; status == CEDUO_OK && i < options; i++) {
        const struct ceduo_result *r = is->result;
        const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, i, r->last_control);
        const struct ceduo_arrivals *a = wooded ? wooded : &r->bare.arrivals[r->last_control];
        struct ceduo_uncertainty_figure *f = &answer->figures[i * CEDUO_UNCERTAINTY_KINDS];
        set_sampling(&f[CEDUO_UNCERTAINTY_REACH], a->reach);
        set_sampling(&f[CEDUO_UNCERTAINTY_EXCEED], a->exceed);
        struct ceduo_estimate energy = a->energy_per_released;
        double half = ceduo_half_width(energy.se, a->released);
        set_sampling(&f[CEDUO_UNCERTAINTY_ENERGY],
                     (struct ceduo_estimate){energy.mean, energy.se, energy.mean - half, energy.mean + half});
        if (i == 0)
            continue;
        f = &answer->figures[figure_at(options, i, CEDUO_UNCERTAINTY_REACH, true)];
        const struct ceduo_difference *d = &r->options[i].differences[r->last_control];
        set_sampling(&f[CEDUO_UNCERTAINTY_REACH], d->reach);
        set_sampling(&f[CEDUO_UNCERTAINTY_EXCEED], d->exceed);
        set_sampling(&f[CEDUO_UNCERTAINTY_ENERGY], d->energy_per_released);
    }
    if (status == CEDUO_OK) {
        bool judges = !isnan(answer->figures[CEDUO_UNCERTAINTY_EXCEED].value);
        answer->main = judges ? CEDUO_UNCERTAINTY_EXCEED : CEDUO_UNCERTAINTY_ENERGY;
        rows->judged = judges ? CEDUO_UNCERTAINTY_EXCEED : CEDUO_UNCERTAINTY_REACH;
        rows->released = is->result->bare.arrivals[is->result->last_control].energy_per_released.mean;
        if (rows->years > 0)
            set_years(rows, is->years, judges);
    }
    ceduo_results_release(&asked);
    return status;
}

/* ---- ranks ---- */

static double value_of(const struct rows *r, size_t option, enum ceduo_uncertainty_kind kind)
{
    return ceduo_uncertainty_find_figure(r->answer, option, kind, false)->value;
}

/* How two options compare, by the surface of their difference. */
static int compare_pair(void *context, size_t item, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    struct ceduo_uncertainty_order *o = &r->answer->orders[item];
    enum ceduo_uncertainty_kind kind = r->answer->rotation ? CEDUO_UNCERTAINTY_MEAN : r->answer->main;
    struct subject s;
    struct ceduo_surface_fit found = {0};
    enum ceduo_status status = open_subject(r, o->better, o->than, &s);
    if (status == CEDUO_OK)
        status = fit_points(r, &s, kind, (struct ceduo_surface_figure){.lo = -INFINITY, .hi = INFINITY, .limit = NAN}, &found);
    if (status == CEDUO_OK)
        set_range(r, value_of(r, o->better, kind) - value_of(r, o->than, kind), &found);
    o->p5 = found.p5;
    o->p95 = found.p95;
    size_t better = 0, worse = 0; /* counts: shares added up one by one may come to more than 1 */
    for (size_t p = 0; status == CEDUO_OK && p < r->points; p++) {
        double whole = kind == CEDUO_UNCERTAINTY_ENERGY ? r->released : limit_of(r->def->scene) / CEDUO_EXCEED_MAX;
        double within = CEDUO_UNCERTAINTY_EQUAL * whole, value = found.values[p];
        better += value < -within;
        worse += value > within;
    }
    o->probability = (double)better / (double)r->points;
    o->worse = (double)worse / (double)r->points;
    o->equal = (double)(r->points - better - worse) / (double)r->points;
    ceduo_surface_release(&found);
    close_subject(&s);
    return (int)status;
}

static enum ceduo_status rank_options(struct rows *r)
{
    struct ceduo_uncertainty_result *a = r->answer;
    size_t options = r->options, *ranks = ceduo_arena_alloc(&r->memory, options * sizeof *ranks);
    double *values = ceduo_arena_alloc(&r->memory, options * sizeof *values);
    a->orders = calloc(options, sizeof *a->orders);
    if (r->memory.failed || !a->orders)
        return CEDUO_NO_MEMORY;
    a->orders_count = options - 1;
    for (size_t i = 0; i < options; i++) {
        values[i] = value_of(r, i, a->rotation ? CEDUO_UNCERTAINTY_MEAN : a->main);
        ceduo_insert_index(values, i, i, ranks);
    }
    for (size_t i = 0; i < a->orders_count; i++)
        a->orders[i] = (struct ceduo_uncertainty_order){.better = ranks[i], .than = ranks[i + 1]};
    return (enum ceduo_status)ceduo_parallel(&(struct parallel){a->orders_count, r->def->threads, compare_pair, r});
}

/* ---- all of it ---- */

/* Room for all figures, with what they say of each input behind them. */
static enum ceduo_status open_answer(struct rows *r)
{
    struct ceduo_uncertainty_result *a = r->answer;
    size_t n = r->def->inputs_count, count = (2 * r->options - 1) * CEDUO_UNCERTAINTY_KINDS;
    a->figures = calloc(count, sizeof *a->figures + n * (sizeof *a->figures->at + sizeof *a->figures->order));
    if (!a->figures)
        return CEDUO_NO_MEMORY;
    double(*at)[2] = (void *)(a->figures + count);
    size_t *order = (void *)(at + count * n);
    for (; a->figures_count < count; a->figures_count++) {
        struct ceduo_uncertainty_figure *f = &a->figures[a->figures_count];
        f->at = at + a->figures_count * n;
        f->order = order + a->figures_count * n;
        set_sampling(f, CEDUO_NO_ESTIMATE);
        f->fit.p5 = f->fit.p95 = NAN;
        for (size_t i = 0; i < n; i++)
            f->at[i][0] = f->at[i][1] = NAN;
    }
    return read_sampling(r);
}

struct ceduo_uncertainty_def ceduo_uncertainty_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_uncertainty_def){
        .scene = scene, .points = CEDUO_UNCERTAINTY_POINTS, .rocks = CEDUO_UNCERTAINTY_ROCKS, .threads = 1};
}

enum ceduo_status ceduo_uncertainty_compute(const struct ceduo_uncertainty_def *def, struct ceduo_uncertainty_result *answer)
{
    GSL_RETURNS_ERRORS;
    struct rows rows;
    struct ceduo_uncertainty_def enough = *def;
    *answer = (struct ceduo_uncertainty_result){0};
    enum ceduo_status status = ceduo_check_uncertainty_def(def);
    if (status != CEDUO_OK)
        return status;
    enough.threads = def->threads > 0 ? def->threads : 1;
    enough.rocks = def->rocks > GROUPS ? def->rocks : GROUPS;
    enough.rotation = def->rotation && def->scene->simulation.contact_model != CEDUO_INDEX;
    status = open_rows(&rows, &enough, answer);
    if (status == CEDUO_OK)
        status = open_answer(&rows);
    for (size_t points = def->points; status == CEDUO_OK; points *= 2) {
        status = extend(&rows, points);
        if (status == CEDUO_OK)
            status = read_figures(&rows, true);
        if (2 * points > rows.most || !wants_more(&rows))
            break;
    }
    answer->rotation = rows.years > 0;
    if (status == CEDUO_OK && rows.years > 0 && rows.judged == CEDUO_UNCERTAINTY_EXCEED)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){rows.options, def->threads, count_years, &rows});
    if (status == CEDUO_OK)
        status = read_figures(&rows, false);
    if (status == CEDUO_OK && !def->alone)
        status = rank_options(&rows);
    answer->points = rows.points;
    answer->rocks = enough.rocks;
    answer->evaluations = rows.ends + rows.points;
    ceduo_arena_free(&rows.memory);
    if (status != CEDUO_OK)
        ceduo_uncertainty_free(answer);
    return status;
}

void ceduo_uncertainty_free(struct ceduo_uncertainty_result *answer)
{
    for (size_t i = 0; i < answer->figures_count; i++)
        ceduo_surface_release(&answer->figures[i].fit);
    free(answer->figures);
    free(answer->orders);
    *answer = (struct ceduo_uncertainty_result){0};
}

/* ---- what a light hangs on ---- */

size_t ceduo_uncertainty_dominant_inputs(const struct ceduo_scene *scene, const struct ceduo_uncertainty_result *a,
                                         size_t option, enum ceduo_uncertainty_kind light, size_t inputs[2])
{
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(a, option, light, false);
    if (!f)
        return 0;
    double limit = light == CEDUO_UNCERTAINTY_EXCEED    ? limit_of(scene)
                   : light == CEDUO_UNCERTAINTY_CONTACT ? 1 / scene->simulation.threshold
                                                        : CEDUO_FREE_RUN_MAX;
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    double gap = ceduo_assess_index(scene, &scene->options[option], control, NAN).longest_gap;
    bool decided = light != CEDUO_UNCERTAINTY_EXCEED && gap > scene->simulation.threshold; /* whatever the stands are */
    if (decided || !f->fit.enough || !(f->fit.p5 <= limit && f->fit.p95 > limit))
        return 0;
    const struct ceduo_share *total = f->fit.total;
    size_t first = SIZE_MAX, second = SIZE_MAX;
    for (size_t i = 0; i < f->uses; i++) {
        size_t at = f->order[i];
        if (first == SIZE_MAX || total[at].value > total[first].value)
            second = first, first = at;
        else if (second == SIZE_MAX || total[at].value > total[second].value)
            second = at;
    }
    inputs[0] = first;
    inputs[1] = second;
    return second != SIZE_MAX && total[second].value >= ALSO * total[first].value ? 2 : 1;
}
