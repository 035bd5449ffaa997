/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is not known of a scene, and what that does to its figures. The scene is computed at points of what may be true, with the
 * same few rocks, and with one input at each end of its range; a surface through each figure says what it depends on
 * (surface.c). Each thread has a copy of the scene of its own, takes item by item, and writes to the item's own rows: so the bits
 * do not depend on the threads. An item is one list of variants, of which no two that are equal are simulated. */
#include "ceduo/doubt.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "ceduo/assess.h"
#include "ceduo/question.h"
#include "ceduo/variants.h"
#include "inputs.h"

/* Rows of inputs: two for each input, with it at its ends and all others NaN, then the points. */
struct rows {
    const struct ceduo_doubt_def *def;
    size_t ends, points, options;
    double *u;
    struct ceduo_groups *values; /* of each row, option and kind */
};

static struct ceduo_groups *values_of(const struct rows *r, size_t row, size_t option)
{
    return r->values + (row * r->options + option) * CEDUO_DOUBT_KINDS;
}

/* ---- the rows ---- */

struct rows_work {
    struct rows *rows;
    size_t from;                /* the first item's number */
    uint64_t before, all;       /* evaluations, for the progress */
    struct input_scene *copies; /* of the scene, for each thread */
    atomic_size_t done;
    atomic_bool failed; /* nothing more once any thread has failed */
    pthread_mutex_t talking;
};

/* Rows as variants: every option of each. */
struct item {
    struct rows_work *work;
    struct input_scene *copy;
    size_t row; /* the first */
};

static void report(struct rows_work *w)
{
    const struct ceduo_doubt_def *def = w->rows->def;
    size_t done = atomic_fetch_add(&w->done, 1) + 1;
    if (!def->progress || pthread_mutex_trylock(&w->talking) != 0)
        return;
    def->progress(def->context, w->before + done, w->all);
    pthread_mutex_unlock(&w->talking);
}

static enum ceduo_status make_variant(void *context, size_t i, struct ceduo_variant *variant)
{
    struct item *item = context;
    const struct rows *r = item->work->rows;
    const struct ceduo_scene *scene = &item->copy->scene;
    if (atomic_load(&item->work->failed))
        return CEDUO_CANCELLED;
    if (i % r->options == 0)
        ceduo_inputs_set(item->copy, r->u + (item->row + i / r->options) * r->def->inputs_count);
    variant->run = ceduo_run_def_default(scene);
    variant->run.option = &scene->options[i % r->options];
    variant->run.rocks_most = r->def->rocks;
    variant->run.arrivals_only = true;
    variant->run.cancel = r->def->cancel;
    variant->rocks = r->def->rocks;
    return CEDUO_OK;
}

/* What no rock decides is the same in all groups. */
static void end_variant(const struct item *item, size_t i)
{
    const struct rows *r = item->work->rows;
    const struct ceduo_scene *scene = &item->copy->scene;
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    struct ceduo_groups *values = values_of(r, item->row + i / r->options, i % r->options);
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[i % r->options], control, NAN);
    for (size_t g = 0; g < CEDUO_SURFACE_GROUPS; g++) {
        values[CEDUO_DOUBT_CONTACT].of[g] = 1 / index.worst_adc;
        values[CEDUO_DOUBT_FREE_RUN].of[g] = index.worst_free_run;
    }
    if (i % r->options + 1 == r->options)
        report(item->work);
}

static enum ceduo_status read_variant(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    (void)rocks;
    const struct item *item = context;
    const struct rows *r = item->work->rows;
    struct ceduo_groups *values = values_of(r, item->row + i / r->options, i % r->options);
    struct ceduo_brief briefs[CEDUO_SURFACE_GROUPS];
    ceduo_run_briefs(run, ceduo_scene_last_control(&item->copy->scene), CEDUO_SURFACE_GROUPS, briefs);
    for (size_t g = 0; g < CEDUO_SURFACE_GROUPS; g++) {
        values[CEDUO_DOUBT_REACH].of[g] = briefs[g].reach_probability;
        values[CEDUO_DOUBT_EXCEED].of[g] = briefs[g].exceed_probability;
        values[CEDUO_DOUBT_ENERGY].of[g] = briefs[g].energy_per_released;
    }
    end_variant(item, i);
    return CEDUO_OK;
}

static void same_variant(void *context, size_t i, size_t first)
{
    const struct item *item = context;
    const struct rows *r = item->work->rows;
    memcpy(values_of(r, item->row + i / r->options, i % r->options),
           values_of(r, item->row + first / r->options, first % r->options), CEDUO_DOUBT_SHOWN * sizeof(struct ceduo_groups));
    end_variant(item, i);
}

/* Item 0 is all ends, as they have most of their forests in common; the others are a point each. */
static int evaluate_item(void *context, size_t i, size_t thread)
{
    struct rows_work *w = context;
    size_t n = w->from + i == 0 ? w->rows->ends : 1;
    struct item item = {w, &w->copies[thread], w->from + i == 0 ? 0 : w->rows->ends + w->from + i - 1};
    enum ceduo_status status = ceduo_variants_run(&(const struct ceduo_variants){
        .n = n * w->rows->options, .make = make_variant, .read = read_variant, .same = same_variant, .context = &item});
    /* of threads that end because another one failed, none says so */
    return status == CEDUO_OK || atomic_exchange(&w->failed, true) ? CEDUO_OK : (int)status;
}

static enum ceduo_status open_rows(struct rows *r, const struct ceduo_doubt_def *def)
{
    size_t n = def->inputs_count;
    size_t most = def->points > CEDUO_DOUBT_POINTS_MAX ? def->points : CEDUO_DOUBT_POINTS_MAX;
    *r = (struct rows){.def = def, .ends = 2 * n, .options = def->scene->options_count};
    r->u = malloc((r->ends + most) * n * sizeof *r->u);
    r->values = malloc((r->ends + most) * r->options * CEDUO_DOUBT_KINDS * sizeof *r->values);
    if (!r->u || !r->values)
        return CEDUO_NO_MEMORY;
    for (size_t row = 0; row < r->ends; row++)
        for (size_t i = 0; i < n; i++)
            r->u[row * n + i] = i == row / 2 ? (double)(row % 2) : NAN;
    return ceduo_surface_points(def->scene->simulation.seed, most, n, r->u + r->ends * n);
}

/* Evaluates up to so many points. */
static enum ceduo_status extend(struct rows *r, size_t points)
{
    const struct ceduo_doubt_def *def = r->def;
    struct rows_work w = {.rows = r, .from = r->points > 0 ? r->points + 1 : 0, .all = r->ends + points};
    w.before = r->points > 0 ? r->ends + r->points : 0;
    w.copies = calloc(def->threads, sizeof *w.copies);
    pthread_mutex_init(&w.talking, NULL);
    r->points = points;
    enum ceduo_status status = w.copies ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < def->threads && status == CEDUO_OK; i++)
        status = ceduo_inputs_open(&w.copies[i], def->scene, def->inputs, def->inputs_count);
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){points + 1 - w.from, def->threads, evaluate_item, &w});
    for (size_t i = 0; w.copies && i < def->threads; i++)
        ceduo_inputs_release(&w.copies[i]);
    free(w.copies);
    pthread_mutex_destroy(&w.talking);
    return status;
}

/* ---- figures ---- */

static size_t figures_of(const struct ceduo_scene *scene)
{
    return (2 * scene->options_count - 1) * CEDUO_DOUBT_KINDS;
}

static size_t figure_at(size_t options, size_t option, enum ceduo_doubt_kind kind, bool difference)
{
    return (difference ? options + option - 1 : option) * CEDUO_DOUBT_KINDS + kind;
}

const struct ceduo_doubt_figure *ceduo_doubt_figure_of(const struct ceduo_doubt_answer *answer, size_t option,
                                                       enum ceduo_doubt_kind kind, bool difference)
{
    size_t options = (answer->figures_count / CEDUO_DOUBT_KINDS + 1) / 2;
    return &answer->figures[figure_at(options, option, kind, difference)];
}

/* Of groups that differ by a rock. */
static double mean_of(struct ceduo_groups y, uint64_t rocks)
{
    double sum = 0;
    for (uint64_t g = 0, groups = CEDUO_SURFACE_GROUPS; g < groups; g++)
        sum += y.of[g] * (double)(rocks * (g + 1) / groups - rocks * g / groups) / (double)rocks;
    return sum;
}

/* The value of a row; of a difference that of its option less that of `against`. */
static struct ceduo_groups value_at(const struct rows *r, size_t row, size_t option, size_t against, enum ceduo_doubt_kind kind,
                                    bool difference)
{
    struct ceduo_groups y = values_of(r, row, option)[kind];
    for (size_t g = 0; difference && g < CEDUO_SURFACE_GROUPS; g++)
        y.of[g] -= values_of(r, row, against)[kind].of[g];
    return y;
}

/* Whether an option has the input: it has no places in other options alone. */
static bool has_input(size_t option, const struct ceduo_input *input)
{
    for (size_t i = 0; i < input->places_count; i++) {
        const char *place = input->places[i];
        if (strncmp(place, "options[", 8) != 0 || strtoul(place + 8, NULL, 10) == option)
            return true;
    }
    return false;
}

/* The surfaces, and one figure after the other. */
struct reading {
    const struct rows *rows;
    const struct ceduo_surface *surface;
    struct ceduo_doubt_answer *answer;
    bool deciding; /* only the figures that decide whether there are points enough; otherwise only the others */
};

/* The indices of n values, the smallest first, equal ones in their order. */
static void sort_indices(const double *values, size_t n, size_t *order)
{
    for (size_t i = 0; i < n; i++) {
        size_t at = i;
        for (; at > 0 && values[order[at - 1]] > values[i]; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
}

static void order_inputs(const struct ceduo_doubt_def *def, const bool *uses, struct ceduo_doubt_figure *f, double *room)
{
    f->uses = 0;
    for (size_t i = 0; i < def->inputs_count; i++)
        room[i] = !uses[i] ? INFINITY : isnan(f->fit.left[i]) ? 0 : f->fit.left[i];
    sort_indices(room, def->inputs_count, f->order);
    for (size_t i = 0; i < def->inputs_count; i++)
        f->uses += uses[i];
}

static int read_figure(void *context, size_t item, size_t worker)
{
    (void)worker;
    const struct reading *reading = context;
    const struct rows *r = reading->rows;
    const struct ceduo_doubt_def *def = r->def;
    struct ceduo_doubt_figure *f = &reading->answer->figures[item];
    size_t n = def->inputs_count, at = item / CEDUO_DOUBT_KINDS;
    f->kind = (enum ceduo_doubt_kind)(item % CEDUO_DOUBT_KINDS);
    f->difference = at >= r->options;
    f->option = f->difference ? at - r->options + 1 : at;
    bool decides = !f->difference && f->kind == reading->answer->main;
    if (decides != reading->deciding)
        return CEDUO_OK;
    struct ceduo_groups *column = malloc(r->points * sizeof *column);
    bool *uses = calloc(n, sizeof *uses);
    double *room = malloc(n * sizeof *room);
    ceduo_surface_release(&f->fit);
    enum ceduo_status status = column && uses && room ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK) {
        for (size_t p = 0; p < r->points; p++)
            column[p] = value_at(r, r->ends + p, f->option, 0, f->kind, f->difference);
        for (size_t i = 0; i < n; i++) {
            uses[i] = has_input(f->option, &def->inputs[i]) || (f->difference && has_input(0, &def->inputs[i]));
            for (size_t end = 0; end < 2; end++)
                f->at[i][end] = mean_of(value_at(r, 2 * i + end, f->option, 0, f->kind, f->difference), def->rocks);
        }
        double max = f->kind == CEDUO_DOUBT_ENERGY || f->kind == CEDUO_DOUBT_CONTACT ? INFINITY : 1;
        status = ceduo_surface_fit(reading->surface, uses, column, f->difference ? -max : 0, max, &f->fit);
    }
    if (status == CEDUO_OK)
        order_inputs(def, uses, f, room);
    free(column);
    free(uses);
    free(room);
    return (int)status;
}

static enum ceduo_status read_figures(const struct rows *r, bool deciding, struct ceduo_doubt_answer *answer)
{
    struct ceduo_surface *surface;
    size_t n = r->def->inputs_count;
    enum ceduo_status status = ceduo_surface_open(r->def->inputs, n, r->u + r->ends * n, r->points, &surface);
    struct reading reading = {r, surface, answer, deciding};
    struct parallel work = {answer->figures_count, r->def->threads, read_figure, &reading};
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&work);
    ceduo_surface_free(surface);
    return status;
}

/* Whether more points would tell more: a surface of an option explains too little. */
static bool wants_more(const struct rows *r, const struct ceduo_doubt_answer *a)
{
    for (size_t i = 0; i < r->options; i++) {
        const struct ceduo_surface_fit *fit = &a->figures[i * CEDUO_DOUBT_KINDS + a->main].fit;
        if (fit->enough ? fit->explained < CEDUO_DOUBT_EXPLAINED : fit->variance > 0 && r->points >= CEDUO_DOUBT_POINTS)
            return true;
    }
    return false;
}

/* ---- the scene as it is ---- */

static void set_sampling(struct ceduo_doubt_figure *f, double value, double lo, double hi)
{
    f->value = value;
    f->sampling_lo = lo;
    f->sampling_hi = hi;
}

static void set_difference(struct ceduo_doubt_figure *f, struct ceduo_paired d)
{
    double half = d.below > 0 ? d.below : CEDUO_Z95 * d.se;
    set_sampling(f, d.mean, d.mean - half, d.mean + half);
}

static enum ceduo_status read_sampling(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *answer)
{
    struct ceduo_question q = ceduo_question_default(def->scene);
    struct ceduo_answer is;
    size_t options = def->scene->options_count;
    q.rocks = q.run.rocks_most = answer->own_rocks = def->own_rocks > 0 ? def->own_rocks : def->rocks;
    q.run.threads = def->threads;
    q.run.cancel = def->cancel;
    q.run.arrivals_only = true;
    enum ceduo_status status = ceduo_ask(&q, NULL, &is);
    for (size_t i = 0; status == CEDUO_OK && i < options; i++) {
        const struct ceduo_result *r = is.result;
        const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, i, r->last_control);
        const struct ceduo_arrivals *a = wooded ? wooded : &r->bare.arrivals[r->last_control];
        struct ceduo_doubt_figure *f = &answer->figures[i * CEDUO_DOUBT_KINDS];
        set_sampling(&f[CEDUO_DOUBT_REACH], a->reach_probability, a->reach_lo, a->reach_hi);
        set_sampling(&f[CEDUO_DOUBT_EXCEED], a->exceed_probability, a->exceed_lo, a->exceed_hi);
        double half = ceduo_half_width(a->energy_per_released_se, a->released);
        set_sampling(&f[CEDUO_DOUBT_ENERGY], a->energy_per_released, a->energy_per_released - half,
                     a->energy_per_released + half);
        if (i == 0)
            continue;
        f = &answer->figures[figure_at(options, i, CEDUO_DOUBT_REACH, true)];
        const struct ceduo_difference *d = &r->options[i].differences[r->last_control];
        set_difference(&f[CEDUO_DOUBT_REACH], d->reach_probability);
        set_difference(&f[CEDUO_DOUBT_EXCEED], d->exceed_probability);
        set_difference(&f[CEDUO_DOUBT_ENERGY], d->energy_per_released);
    }
    if (status == CEDUO_OK)
        answer->main = isnan(answer->figures[CEDUO_DOUBT_EXCEED].value) ? CEDUO_DOUBT_ENERGY : CEDUO_DOUBT_EXCEED;
    ceduo_answer_release(&is);
    return status;
}

/* ---- ranks ---- */

/* How two options compare where they differ by more than the rocks alone would make them: by the surface of their difference. */
static enum ceduo_status compare(const struct rows *r, const struct ceduo_surface *surface, enum ceduo_doubt_kind kind,
                                 struct ceduo_doubt_order *o)
{
    size_t n = r->def->inputs_count;
    struct ceduo_surface_fit fit = {0};
    struct ceduo_groups *column = malloc(r->points * sizeof *column);
    bool *uses = calloc(n, sizeof *uses);
    enum ceduo_status status = column && uses ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK) {
        for (size_t p = 0; p < r->points; p++)
            column[p] = value_at(r, r->ends + p, o->better, o->than, kind, true);
        for (size_t i = 0; i < n; i++)
            uses[i] = has_input(o->better, &r->def->inputs[i]) || has_input(o->than, &r->def->inputs[i]);
        status = ceduo_surface_fit(surface, uses, column, -INFINITY, INFINITY, &fit);
    }
    for (size_t p = 0; status == CEDUO_OK && p < r->points; p++) {
        double noise = CEDUO_Z95 * sqrt(fit.noise);
        *(fit.values[p] < -noise ? &o->probability : fit.values[p] > noise ? &o->worse : &o->equal) += 1 / (double)r->points;
    }
    ceduo_surface_release(&fit);
    free(column);
    free(uses);
    return status;
}

static enum ceduo_status read_orders(const struct rows *r, struct ceduo_doubt_answer *a)
{
    size_t options = r->options, n = r->def->inputs_count;
    struct ceduo_surface *surface;
    enum ceduo_status status = ceduo_surface_open(r->def->inputs, n, r->u + r->ends * n, r->points, &surface);
    size_t *ranks = calloc(options, sizeof *ranks);
    double *values = calloc(options, sizeof *values);
    a->orders = calloc(options, sizeof *a->orders);
    status = ranks && values && a->orders ? status : CEDUO_NO_MEMORY;
    for (size_t i = 0; status == CEDUO_OK && i < options; i++)
        values[i] = a->figures[i * CEDUO_DOUBT_KINDS + a->main].value;
    if (status == CEDUO_OK)
        sort_indices(values, options, ranks);
    for (size_t i = 0; status == CEDUO_OK && i + 1 < options; i++) {
        a->orders[i] = (struct ceduo_doubt_order){.better = ranks[i], .than = ranks[i + 1]};
        status = compare(r, surface, a->main, &a->orders[i]);
        a->orders_count = i + 1;
    }
    ceduo_surface_free(surface);
    free(ranks);
    free(values);
    return status;
}

/* ---- all of it ---- */

static enum ceduo_status open_answer(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *a)
{
    *a = (struct ceduo_doubt_answer){.figures = calloc(figures_of(def->scene), sizeof *a->figures)};
    if (!a->figures)
        return CEDUO_NO_MEMORY;
    for (; a->figures_count < figures_of(def->scene); a->figures_count++) {
        struct ceduo_doubt_figure *f = &a->figures[a->figures_count];
        f->at = malloc(def->inputs_count * sizeof *f->at);
        f->order = calloc(def->inputs_count, sizeof *f->order);
        set_sampling(f, NAN, NAN, NAN);
        if (!f->at || !f->order) {
            a->figures_count++;
            return CEDUO_NO_MEMORY;
        }
    }
    return read_sampling(def, a);
}

enum ceduo_status ceduo_doubt_ask(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *answer)
{
    struct rows rows;
    struct ceduo_doubt_def enough = *def;
    enough.rocks = def->rocks > CEDUO_SURFACE_GROUPS ? def->rocks : CEDUO_SURFACE_GROUPS;
    def = &enough;
    enum ceduo_status status = open_rows(&rows, def);
    if (status == CEDUO_OK)
        status = open_answer(def, answer);
    else
        *answer = (struct ceduo_doubt_answer){0};
    for (size_t points = def->points; status == CEDUO_OK; points *= 2) {
        status = extend(&rows, points);
        if (status == CEDUO_OK)
            status = read_figures(&rows, true, answer);
        if (2 * points > CEDUO_DOUBT_POINTS_MAX || !wants_more(&rows, answer))
            break;
    }
    if (status == CEDUO_OK)
        status = read_figures(&rows, false, answer);
    if (status == CEDUO_OK)
        status = read_orders(&rows, answer);
    answer->points = rows.points;
    answer->evaluations = rows.ends + rows.points;
    free(rows.u);
    free(rows.values);
    if (status != CEDUO_OK)
        ceduo_doubt_free(answer);
    return status;
}

void ceduo_doubt_free(struct ceduo_doubt_answer *answer)
{
    for (size_t i = 0; i < answer->figures_count; i++) {
        ceduo_surface_release(&answer->figures[i].fit);
        free(answer->figures[i].at);
        free(answer->figures[i].order);
    }
    free(answer->figures);
    free(answer->orders);
    *answer = (struct ceduo_doubt_answer){0};
}
