/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the effect of uncertain inputs on the figures of a scene. Plausible scenes are simulated with the same few rocks
 * (points.c), also with each input at the ends of its range. A surface through each figure yields the shares of the inputs
 * (surface.c). Over a rotation each year has its own surface, whose values are free of sampling noise; they decide which
 * years fail. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "check_study.h"
#include "core/runs/assess.h"
#include "core/runs/result.h"
#include "core/runs/statistics.h"
#include "dominant_inputs.h"
#include "inputs.h"
#include "points.h"
#include "scene/derived.h"
#include "surface.h"

#define GROUPS CEDUO_SURFACE_GROUPS
#define SECOND 0.5 /* a second input is dominant, too, if its share is at least this part of the first one's */

/* Rows of input quantiles: two for each input, at its ends with all others NaN (as given), then the points. */
struct rows {
    const struct ceduo_uncertainty_def *def;
    struct ceduo_uncertainty_result *answer;
    struct arena memory;
    size_t ends, points, options, points_max; /* ends: rows before the points */
    double *u;
    struct ceduo_replicates *values; /* [row][option][kind] */
    enum ceduo_uncertainty_kind judged;
    double energy_bare;              /* J, mean per released rock without forest */
    size_t years;                    /* per option; 0: no rotation */
    double year_count;               /* years of the whole window */
    struct ceduo_replicates *shares; /* [option][year][point] */
    bool deciding; /* read only the figures that decide if there are enough points; otherwise only the others */
    size_t all;    /* rows, for the progress */
    atomic_size_t done;
    struct talk talk;
};

static bool is_asked(const struct rows *r, size_t option)
{
    return !r->def->one_option || option == r->def->option;
}

static struct ceduo_replicates *find_values(const struct rows *r, size_t row, size_t option)
{
    return r->values + (row * r->options + option) * CEDUO_UNCERTAINTY_KINDS;
}

/* ---- the rows ---- */

static void report_progress(void *context)
{
    struct rows *r = context;
    const struct ceduo_uncertainty_def *def = r->def;
    size_t done = atomic_fetch_add(&r->done, 1) + 1;
    if (!def->progress || !ceduo_guard_try_enter(&r->talk))
        return;
    def->progress(def->context, done, r->all);
    ceduo_guard_leave(&r->talk);
}

/* Return the limit of the judged share at the last control. */
static double judged_limit(const struct ceduo_scene *scene)
{
    return ceduo_exceed_limit(scene, &scene->controls[ceduo_scene_last_control(scene)]);
}

static void read_point(void *context, const struct point *point, const struct control_means *means)
{
    const struct rows *r = context;
    size_t last = ceduo_scene_last_control(point->scene);
    struct ceduo_replicates *values = find_values(r, point->row, point->option);
    /* With blocks the limit is a rate: shares are scaled by the frequency of release. */
    double weight = judged_limit(r->def->scene) / judged_limit(point->scene);
    for (size_t g = 0; g < GROUPS && point->slot > 0; g++) {
        const struct ceduo_group_means *b = &means[last].group[g];
        double share = r->judged == CEDUO_UNCERTAINTY_EXCEED ? weight * b->exceed_probability : b->reach_probability;
        double *mean = &values[CEDUO_UNCERTAINTY_MEAN].value[g]; /* accumulated over the years */
        r->shares[(point->option * r->years + point->slot - 1) * r->points_max + point->row - r->ends].value[g] = share;
        *mean = (point->slot == 1 ? 0 : *mean) + share / (double)r->years;
    }
    if (point->slot > 0)
        return;
    struct ceduo_index index = ceduo_assess_index(point->scene, point->forest, &point->scene->controls[last], NAN);
    for (size_t g = 0; g < GROUPS; g++) {
        values[CEDUO_UNCERTAINTY_REACH].value[g] = means[last].group[g].reach_probability;
        values[CEDUO_UNCERTAINTY_EXCEED].value[g] = weight * means[last].group[g].exceed_probability;
        values[CEDUO_UNCERTAINTY_DEFEATED].value[g] = weight * means[last].group[g].defeated_probability;
        values[CEDUO_UNCERTAINTY_ENERGY].value[g] = means[last].group[g].energy_per_released;
        values[CEDUO_UNCERTAINTY_CONTACT].value[g] = 1 / index.worst_adc; /* no sampling noise: equal in all groups */
        values[CEDUO_UNCERTAINTY_FREE_RUN].value[g] = index.worst_free_run;
    }
}

/* Allocate the rows, and set their quantiles. */
static enum ceduo_status open_rows(struct rows *r, const struct ceduo_uncertainty_def *def,
                                   struct ceduo_uncertainty_result *answer)
{
    size_t n = def->inputs_count;
    *r = (struct rows){.def = def, .answer = answer, .ends = def->brief ? 0 : 2 * n, .options = def->scene->options_count};
    r->points_max = def->points_max > 0 ? def->points_max : CEDUO_UNCERTAINTY_POINTS_MAX;
    r->points_max = def->points > r->points_max ? def->points : r->points_max;
    r->u = ceduo_arena_alloc(&r->memory, (r->ends + r->points_max) * n * sizeof *r->u);
    r->values =
        ceduo_arena_alloc(&r->memory, (r->ends + r->points_max) * r->options * CEDUO_UNCERTAINTY_KINDS * sizeof *r->values);
    r->years = def->rotation ? ceduo_points_years(def) : 0;
    r->year_count = def->rotation ? (double)ceduo_points_window(def) : 0;
    r->shares = ceduo_arena_alloc(&r->memory, r->options * r->years * r->points_max * sizeof *r->shares);
    if (r->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t row = 0; row < r->ends; row++)
        for (size_t i = 0; i < n; i++)
            r->u[row * n + i] = i == row / 2 ? (double)(row % 2) : NAN;
    return ceduo_surface_points(def->scene->simulation.seed, r->points_max, n, r->u + r->ends * n);
}

/* Simulate rows until there are n `points`; the first call includes the ends, which share most of their forests. */
static enum ceduo_status extend(struct rows *r, size_t points)
{
    size_t from = r->points > 0 ? r->ends + r->points : 0;
    const struct points p = {
        .def = r->def, .u = r->u, .today = true, .read = read_point, .done = report_progress, .context = r};
    r->all = r->ends + points;
    atomic_store(&r->done, from);
    enum ceduo_status status = ceduo_points_run(&p, from, r->ends + points, from == 0 ? r->ends : 0);
    r->points = points;
    return status;
}

/* ---- figures ---- */

static size_t figure_index(size_t options, size_t option, enum ceduo_uncertainty_kind kind, bool difference)
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
    return &answer->figures[figure_index(options, option, kind, difference)];
}

/* An option, or its difference to another one, with its surface and buffers. */
struct subject {
    size_t option, against; /* equal: no difference */
    struct arena memory;
    struct ceduo_surface *surface;
    bool *has, *uses; /* inputs of the options; inputs that affect the current figure */
    double *widths;   /* one per input, for the order */
    struct ceduo_replicates *column;
};

static enum ceduo_status open_subject(const struct rows *r, size_t option, size_t against, struct subject *s)
{
    size_t n = r->def->inputs_count;
    *s = (struct subject){.option = option, .against = against};
    s->has = ceduo_arena_alloc(&s->memory, n * sizeof *s->has);
    s->uses = ceduo_arena_alloc(&s->memory, n * sizeof *s->uses);
    s->widths = ceduo_arena_alloc(&s->memory, n * sizeof *s->widths);
    s->column = ceduo_arena_alloc(&s->memory, r->points * sizeof *s->column);
    enum ceduo_status status = ceduo_surface_open(r->def->inputs, n, r->u + r->ends * n, r->points, &s->surface);
    if (s->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n; i++)
        s->has[i] = ceduo_input_affects(&r->def->inputs[i], option) || ceduo_input_affects(&r->def->inputs[i], against);
    return status;
}

static void close_subject(struct subject *s)
{
    ceduo_surface_free(s->surface);
    ceduo_arena_free(&s->memory);
}

/* Return the value of a subject in a row: of the option, minus that of `against` if they differ. */
static struct ceduo_replicates subject_value(const struct rows *r, const struct subject *s, size_t row,
                                             enum ceduo_uncertainty_kind kind)
{
    struct ceduo_replicates y = find_values(r, row, s->option)[kind];
    for (size_t g = 0; s->option != s->against && g < GROUPS; g++)
        y.value[g] -= find_values(r, row, s->against)[kind].value[g];
    return y;
}

static bool is_rotation(enum ceduo_uncertainty_kind kind)
{
    return kind == CEDUO_UNCERTAINTY_MEAN || kind == CEDUO_UNCERTAINTY_FAILING;
}

/* Set the inputs that affect a figure: figures of today do not depend on inputs of future years. */
static void choose_inputs(const struct rows *r, const struct subject *s, enum ceduo_uncertainty_kind kind)
{
    for (size_t i = 0; i < r->def->inputs_count; i++)
        s->uses[i] = s->has[i] && (is_rotation(kind) || !ceduo_input_is_future(&r->def->inputs[i]));
}

/* Fit a figure of a subject. `figure` has the bounds and the limit. */
static enum ceduo_status fit_points(const struct rows *r, const struct subject *s, enum ceduo_uncertainty_kind kind,
                                    struct ceduo_surface_figure figure, struct ceduo_surface_fit *fit)
{
    for (size_t p = 0; p < r->points; p++)
        s->column[p] = subject_value(r, s, r->ends + p, kind);
    choose_inputs(r, s, kind);
    figure.y = s->column;
    figure.uses = s->uses;
    return ceduo_surface_fit(s->surface, &figure, fit);
}

/* Widen the range to include the value of the scene as given (NaN: unknown). Clear it if there are too few points. */
static void set_range(const struct rows *r, double value, struct ceduo_surface_fit *fit)
{
    if (r->points < CEDUO_UNCERTAINTY_MIN) {
        fit->p5 = fit->p50 = fit->p95 = fit->p5_se = fit->p95_se = NAN;
        for (size_t i = 0; i < r->def->inputs_count; i++)
            fit->width_if_known[i] = NAN;
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
        const struct ceduo_replicates y = subject_value(r, s, row, f->kind);
        f->at_ends[row / 2][row % 2] = is_rotation(f->kind) ? NAN : ceduo_groups_mean(&y, def->rocks);
    }
    ceduo_surface_release(&f->fit);
    const struct ceduo_surface_figure figure = {
        .lo = f->difference ? -max : 0, .hi = max, .limit = judged ? judged_limit(def->scene) : NAN};
    enum ceduo_status status = fit_points(r, s, f->kind, figure, &f->fit);
    if (status != CEDUO_OK)
        return status;
    set_range(r, f->value, &f->fit);
    f->uses = 0;
    for (size_t i = 0; i < def->inputs_count; i++) {
        f->uses += s->uses[i];
        s->widths[i] = !s->uses[i] ? INFINITY : isnan(f->fit.width_if_known[i]) ? 0 : f->fit.width_if_known[i];
        ceduo_insert_index(s->widths, i, i, f->order);
    }
    return CEDUO_OK;
}

/* True if a kind of figure is computed. The defeated share requires a fence. Failing years require an accepted energy. */
static bool is_computed(const struct rows *r, enum ceduo_uncertainty_kind kind)
{
    if (is_rotation(kind))
        return r->years > 0 && (kind == CEDUO_UNCERTAINTY_MEAN || r->judged == CEDUO_UNCERTAINTY_EXCEED);
    if (kind == CEDUO_UNCERTAINTY_DEFEATED) {
        const struct ceduo_scene *scene = r->def->scene;
        return ceduo_fence_stands(&scene->controls[ceduo_scene_last_control(scene)].fence);
    }
    bool share = kind == CEDUO_UNCERTAINTY_REACH || kind == CEDUO_UNCERTAINTY_EXCEED;
    return !r->def->brief || (share ? kind == r->judged : kind != CEDUO_UNCERTAINTY_ENERGY || kind == r->answer->main);
}

/* Read all figures of an item: an option or, after the options, a difference to the first one. They share the decomposition
 * of the surface. */
static int read_item(void *context, size_t item, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    bool difference = item >= r->options;
    size_t option = difference ? item - r->options + 1 : item;
    struct subject s;
    if (!is_asked(r, option) || (difference && (r->def->one_option || r->def->brief)))
        return CEDUO_OK;
    enum ceduo_status status = open_subject(r, option, difference ? 0 : option, &s);
    for (size_t kind = 0; kind < CEDUO_UNCERTAINTY_KINDS && status == CEDUO_OK; kind++) {
        struct ceduo_uncertainty_figure *f = &r->answer->figures[item * CEDUO_UNCERTAINTY_KINDS + kind];
        f->kind = (enum ceduo_uncertainty_kind)kind;
        f->difference = difference;
        f->option = option;
        bool decides = !difference && (f->kind == r->answer->main || f->kind == CEDUO_UNCERTAINTY_MEAN);
        if (is_computed(r, f->kind) && decides == r->deciding && !(difference && f->kind == CEDUO_UNCERTAINTY_DEFEATED))
            status = read_figure(r, &s, f);
    }
    close_subject(&s);
    return (int)status;
}

static enum ceduo_status read_figures(struct rows *r, bool deciding)
{
    size_t items = deciding ? r->options : r->answer->figures_count / CEDUO_UNCERTAINTY_KINDS;
    r->deciding = deciding;
    return (enum ceduo_status)ceduo_parallel(&(struct parallel){items, r->def->threads, read_item, r});
}

/* ---- which years fail ---- */

/* Count, at each point, the years whose surface exceeds the limit. The groups get this number as their mean, with the noise
 * implied by half samples of the rocks. */
static int count_years(void *context, size_t option, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    if (!is_asked(r, option))
        return CEDUO_OK;
    size_t years = r->years, points = r->points;
    double limit = judged_limit(r->def->scene), each = r->year_count / (double)years;
    struct subject s;
    enum ceduo_status status = open_subject(r, option, option, &s);
    double *values = ceduo_arena_alloc(&s.memory, years * points * sizeof *values);
    struct ceduo_replicates *y = ceduo_arena_alloc(&s.memory, years * points * sizeof *y);
    struct ceduo_replicates *changes = ceduo_arena_alloc(&s.memory, years * points * sizeof *changes);
    status = s.memory.failed ? CEDUO_NO_MEMORY : status;
    if (status == CEDUO_OK) {
        choose_inputs(r, &s, CEDUO_UNCERTAINTY_FAILING);
        for (size_t k = 0; k < years; k++)
            memcpy(y + k * points, r->shares + (option * years + k) * r->points_max, points * sizeof *y);
        const struct ceduo_surface_figure figure = {.y = y, .uses = s.uses, .hi = 1, .limit = NAN};
        status = ceduo_surface_values(s.surface, &figure, years, values, changes);
    }
    for (size_t p = 0; p < points && status == CEDUO_OK; p++) {
        struct ceduo_replicates *failing = &find_values(r, r->ends + p, option)[CEDUO_UNCERTAINTY_FAILING];
        double all = 0, halves[GROUPS] = {0};
        for (size_t k = p; k < years * points; k += points) {
            all += each * (values[k] > limit);
            for (size_t half = 1; half < GROUPS; half++)
                halves[half] +=
                    each / 2 * ((values[k] + changes[k].value[half] > limit) - (values[k] - changes[k].value[half] > limit));
        }
        ceduo_replicates_from_half_samples(failing, all, halves);
    }
    close_subject(&s);
    return (int)status;
}

/* True if more points are required: the surface of an option explains too little. */
static bool needs_more_points(const struct rows *r)
{
    const struct ceduo_uncertainty_result *a = r->answer;
    for (size_t i = 0; i < r->options; i++)
        for (size_t rotation = is_asked(r, i) ? 0 : 2; rotation < (r->years > 0 ? 2 : 1); rotation++) {
            const struct ceduo_surface_fit *fit =
                &ceduo_uncertainty_find_figure(a, i, rotation ? CEDUO_UNCERTAINTY_MEAN : a->main, false)->fit;
            if (fit->enough_points && !fit->linear ? fit->explained < CEDUO_UNCERTAINTY_EXPLAINED
                                                   : fit->variance > 0 && r->points >= CEDUO_UNCERTAINTY_POINTS)
                return true;
        }
    return false;
}

/* ---- the scene as given ---- */

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
        double each = r->year_count / (double)years[i]->count; /* years per computed year */
        struct ceduo_years_summary s = ceduo_years_summarize(years[i], control);
        struct ceduo_uncertainty_figure *f = &answer->figures[i * CEDUO_UNCERTAINTY_KINDS],
                                        *d = &answer->figures[figure_index(options, i, CEDUO_UNCERTAINTY_REACH, i > 0)];
        struct ceduo_estimate mean = judges ? s.exceed : s.reach;
        double counts[3] = {0};
        mean = ceduo_estimate_from_se(mean.mean, mean.se);
        mean.lo = fmax(0, mean.lo);
        mean.hi = fmin(1, mean.hi);
        set_sampling(&f[CEDUO_UNCERTAINTY_MEAN], mean);
        if (i > 0)
            set_sampling(&d[CEDUO_UNCERTAINTY_MEAN], ceduo_years_difference(years[i], years[0]));
        if (!judges)
            continue;
        for (size_t k = 0; k < years[i]->count; k++) { /* years above the limit by the lower end, the mean and the upper end */
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
    struct ceduo_results made = {0};
    const struct ceduo_results *own = def->own ? def->own : &made;
    size_t options = def->scene->options_count;
    q.rocks = q.run.rocks_max = def->own_rocks > 0 ? def->own_rocks : def->rocks;
    q.run.threads = def->threads;
    q.run.cancel = def->cancel;
    q.run.arrivals_only = true;
    q.years = rows->years > 0;
    q.window = def->window;
    q.year_rocks = CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS;
    enum ceduo_status status = def->own ? CEDUO_OK : ceduo_simulate_request(&q, NULL, &made);
    answer->own_rocks = status == CEDUO_OK ? ceduo_result_rocks(own->result) : 0;
    for (size_t i = 0; status == CEDUO_OK && i < options; i++) {
        const struct ceduo_result *r = own->result;
        const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, i, r->last_control);
        const struct ceduo_arrivals *a = wooded ? wooded : &r->bare.arrivals[r->last_control];
        struct ceduo_uncertainty_figure *f = &answer->figures[i * CEDUO_UNCERTAINTY_KINDS];
        set_sampling(&f[CEDUO_UNCERTAINTY_REACH], a->reach);
        set_sampling(&f[CEDUO_UNCERTAINTY_EXCEED], a->exceed);
        set_sampling(&f[CEDUO_UNCERTAINTY_DEFEATED], a->fence ? a->fence->defeated : CEDUO_NO_ESTIMATE);
        struct ceduo_estimate energy = a->energy_per_released;
        double half = ceduo_half_width(energy.se, a->released);
        set_sampling(&f[CEDUO_UNCERTAINTY_ENERGY],
                     (struct ceduo_estimate){energy.mean, energy.se, energy.mean - half, energy.mean + half});
        if (i == 0)
            continue;
        f = &answer->figures[figure_index(options, i, CEDUO_UNCERTAINTY_REACH, true)];
        const struct ceduo_difference *d = &r->options[i].differences[r->last_control];
        set_sampling(&f[CEDUO_UNCERTAINTY_REACH], d->reach);
        set_sampling(&f[CEDUO_UNCERTAINTY_EXCEED], d->exceed);
        set_sampling(&f[CEDUO_UNCERTAINTY_ENERGY], d->energy_per_released);
    }
    if (status == CEDUO_OK) {
        bool judges = !isnan(answer->figures[CEDUO_UNCERTAINTY_EXCEED].value);
        answer->main = judges ? CEDUO_UNCERTAINTY_EXCEED : CEDUO_UNCERTAINTY_ENERGY;
        rows->judged = judges ? CEDUO_UNCERTAINTY_EXCEED : CEDUO_UNCERTAINTY_REACH;
        rows->energy_bare = own->result->bare.arrivals[own->result->last_control].energy_per_released.mean;
        if (rows->years > 0)
            set_years(rows, own->years, judges);
    }
    ceduo_results_release(&made);
    return status;
}

/* ---- ranks ---- */

static double figure_value(const struct rows *r, size_t option, enum ceduo_uncertainty_kind kind)
{
    return ceduo_uncertainty_find_figure(r->answer, option, kind, false)->value;
}

/* Compare two options by the surface of their difference. */
static int compare_pair(void *context, size_t item, size_t worker)
{
    (void)worker;
    const struct rows *r = context;
    struct ceduo_uncertainty_order *o = &r->answer->orders[item];
    enum ceduo_uncertainty_kind kind = r->answer->rotation ? CEDUO_UNCERTAINTY_MEAN : r->answer->main;
    struct subject s;
    struct ceduo_surface_fit fit = {0};
    enum ceduo_status status = open_subject(r, o->better, o->than, &s);
    if (status == CEDUO_OK)
        status = fit_points(r, &s, kind, (struct ceduo_surface_figure){.lo = -INFINITY, .hi = INFINITY, .limit = NAN}, &fit);
    if (status == CEDUO_OK)
        set_range(r, figure_value(r, o->better, kind) - figure_value(r, o->than, kind), &fit);
    o->p5 = fit.p5;
    o->p95 = fit.p95;
    size_t better = 0, worse = 0; /* counts, so that the shares add up to exactly 1 */
    for (size_t p = 0; status == CEDUO_OK && p < r->points; p++) {
        double scale = kind == CEDUO_UNCERTAINTY_ENERGY ? r->energy_bare : judged_limit(r->def->scene) / CEDUO_EXCEED_MAX;
        double tolerance = CEDUO_UNCERTAINTY_EQUAL * scale, value = fit.values[p];
        better += value < -tolerance;
        worse += value > tolerance;
    }
    o->probability = (double)better / (double)r->points;
    o->worse = (double)worse / (double)r->points;
    o->equal = (double)(r->points - better - worse) / (double)r->points;
    ceduo_surface_release(&fit);
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
        values[i] = figure_value(r, i, a->rotation ? CEDUO_UNCERTAINTY_MEAN : a->main);
        ceduo_insert_index(values, i, i, ranks);
    }
    for (size_t i = 0; i < a->orders_count; i++)
        a->orders[i] = (struct ceduo_uncertainty_order){.better = ranks[i], .than = ranks[i + 1]};
    return (enum ceduo_status)ceduo_parallel(&(struct parallel){a->orders_count, r->def->threads, compare_pair, r});
}

/* ---- uncertainty ---- */

/* Allocate the figures and their arrays in one block, and read the scene as given. */
static enum ceduo_status open_answer(struct rows *r)
{
    struct ceduo_uncertainty_result *a = r->answer;
    size_t n = r->def->inputs_count, count = (2 * r->options - 1) * CEDUO_UNCERTAINTY_KINDS;
    a->figures = calloc(count, sizeof *a->figures + n * (sizeof *a->figures->at_ends + sizeof *a->figures->order));
    if (!a->figures)
        return CEDUO_NO_MEMORY;
    double(*ends)[2] = (void *)(a->figures + count);
    size_t *order = (void *)(ends + count * n);
    for (; a->figures_count < count; a->figures_count++) {
        struct ceduo_uncertainty_figure *f = &a->figures[a->figures_count];
        f->at_ends = ends + a->figures_count * n;
        f->order = order + a->figures_count * n;
        set_sampling(f, CEDUO_NO_ESTIMATE);
        f->fit.p5 = f->fit.p95 = NAN;
        for (size_t i = 0; i < n; i++)
            f->at_ends[i][0] = f->at_ends[i][1] = NAN;
    }
    return read_sampling(r);
}

struct ceduo_uncertainty_def ceduo_uncertainty_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def),
                                          .scene = scene,
                                          .points = CEDUO_UNCERTAINTY_POINTS,
                                          .rocks = CEDUO_UNCERTAINTY_ROCKS,
                                          .threads = 1};
}

enum ceduo_status ceduo_uncertainty_compute(const struct ceduo_uncertainty_def *def, struct ceduo_uncertainty_result *answer)
{
    GSL_RETURNS_ERRORS;
    struct rows rows;
    *answer = (struct ceduo_uncertainty_result){0};
    enum ceduo_status status = ceduo_check_uncertainty_def(def);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_uncertainty_def checked = *def;
    checked.threads = def->threads > 0 ? def->threads : 1;
    checked.rocks = def->rocks > GROUPS ? def->rocks : GROUPS;
    checked.rotation = def->rotation && def->scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    status = open_rows(&rows, &checked, answer);
    if (status == CEDUO_OK)
        status = open_answer(&rows);
    for (size_t points = def->points; status == CEDUO_OK; points *= 2) {
        status = extend(&rows, points);
        if (status == CEDUO_OK)
            status = read_figures(&rows, true);
        if (2 * points > rows.points_max || !needs_more_points(&rows))
            break;
    }
    answer->rotation = rows.years > 0;
    if (status == CEDUO_OK && rows.years > 0 && rows.judged == CEDUO_UNCERTAINTY_EXCEED)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){rows.options, def->threads, count_years, &rows});
    if (status == CEDUO_OK)
        status = read_figures(&rows, false);
    if (status == CEDUO_OK && !def->one_option)
        status = rank_options(&rows);
    answer->points = rows.points;
    answer->rocks = checked.rocks;
    answer->evaluations = rows.ends + rows.points;
    ceduo_arena_free(&rows.memory);
    if (status != CEDUO_OK)
        ceduo_uncertainty_release(answer);
    return status;
}

void ceduo_uncertainty_release(struct ceduo_uncertainty_result *answer)
{
    for (size_t i = 0; i < answer->figures_count; i++)
        ceduo_surface_release(&answer->figures[i].fit);
    free(answer->figures);
    free(answer->orders);
    *answer = (struct ceduo_uncertainty_result){0};
}

/* ---- dominant inputs ---- */

size_t ceduo_uncertainty_dominant_inputs(const struct ceduo_scene *scene, const struct ceduo_uncertainty_result *a,
                                         size_t option, enum ceduo_uncertainty_kind light, size_t inputs[2])
{
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(a, option, light, false);
    if (!f)
        return 0;
    bool share = light == CEDUO_UNCERTAINTY_EXCEED || light == CEDUO_UNCERTAINTY_DEFEATED;
    double limit = share                                ? judged_limit(scene)
                   : light == CEDUO_UNCERTAINTY_CONTACT ? 1 / scene->simulation.threshold
                                                        : CEDUO_FREE_RUN_MAX;
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    double gap = ceduo_assess_index(scene, &scene->options[option], control, NAN).longest_gap;
    bool decided = !share && gap > scene->simulation.threshold; /* a gap decides, whatever the stands */
    if (decided || !f->fit.enough_points || !(f->fit.p5 <= limit && f->fit.p95 > limit))
        return 0;
    const struct ceduo_share *total = f->fit.total;
    size_t first = SIZE_MAX, second = SIZE_MAX;
    for (size_t i = 0; i < f->uses; i++) {
        size_t input = f->order[i];
        if (first == SIZE_MAX || total[input].value > total[first].value)
            second = first, first = input;
        else if (second == SIZE_MAX || total[input].value > total[second].value)
            second = input;
    }
    inputs[0] = first;
    inputs[1] = second;
    return second != SIZE_MAX && total[second].value >= SECOND * total[first].value ? 2 : 1;
}
