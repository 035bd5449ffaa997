/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads take items, each with its own copy of the scene, and write only to the rows of the item. So the result does not
 * depend on the number of threads, bit for bit. An item is a list of variants; equal variants are simulated once. */
#include "points.h"
#include "core/runs/variants.h"
#include "core/runs/year_runs.h"

#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "base/random.h"
#include "inputs.h"

struct work {
    const struct points *points;
    size_t from, shared_rows;   /* first row; rows of the first item */
    size_t each, today;         /* variants of a row, and of them those of today, which come first */
    struct point *variants;     /* option and slot of each variant of a row */
    struct input_scene *copies; /* one for each thread */
    _Atomic uint64_t effort;    /* sum over the simulated variants */
    atomic_bool failed;         /* a thread has failed: the others stop */
};

struct item {
    struct work *work;
    struct control_means *control_means; /* [variant][control] */
    struct input_scene *copy;
    size_t row, each;          /* first row; variants of a row */
    struct point point;        /* current point */
    struct ceduo_scene scene;  /* scene of a year, with its own rocks */
    struct ceduo_years *years; /* years of the current option */
};

static struct ceduo_window find_window(const struct ceduo_uncertainty_def *def, const struct ceduo_scene *scene)
{
    return def->window.step > 0 ? def->window : ceduo_scene_window(scene);
}

/* Set the forest of a point's year, and its scene. */
static enum ceduo_status set_year(struct item *item, struct point *point)
{
    const struct ceduo_uncertainty_def *def = item->work->points->def;
    const struct ceduo_scene *scene = &item->copy->scene;
    size_t years = ceduo_points_years(def), year = point->slot - 1;
    if (year == 0) {
        ceduo_years_free(item->years);
        enum ceduo_status status =
            ceduo_years_create(scene, &scene->options[point->option], find_window(def, scene), &item->years);
        if (status != CEDUO_OK)
            return status;
    }
    item->scene = *scene;
    if (item->years->window.kind != CEDUO_WINDOW_CONSTANT) /* otherwise the years equal today, with the rocks of today */
        item->scene.simulation.seed = random_seed(scene->simulation.seed, VARIANT_POINT_YEAR, year);
    point->scene = &item->scene;
    point->forest =
        &item->years->years[(2 * year + 1) * item->years->count / (2 * years)].option; /* the middle year of each part */
    return CEDUO_OK;
}

static struct control_means *find_means(const struct item *item, size_t i)
{
    return item->control_means + i * item->work->points->def->scene->controls_count;
}

static void report_variant(const struct item *item, size_t i, bool simulated)
{
    const struct points *p = item->work->points;
    if (p->read)
        p->read(p->context, &item->point, simulated ? find_means(item, i) : NULL);
    if (i % item->each + 1 == item->each && p->done)
        p->done(p->context);
}

static enum ceduo_status make_variant(void *context, size_t i, struct ceduo_variant *variant)
{
    struct item *item = context;
    const struct points *p = item->work->points;
    struct point *point = &item->point;
    enum ceduo_status status = atomic_load(&item->work->failed) ? CEDUO_CANCELLED : CEDUO_OK;
    if (i % item->each == 0)
        ceduo_inputs_set(item->copy, p->u + (item->row + i / item->each) * p->def->inputs_count);
    *point = item->work->variants[i % item->each];
    point->row = item->row + i / item->each;
    point->scene = &item->copy->scene;
    point->forest = &point->scene->options[point->option];
    if (status == CEDUO_OK && point->slot > 0)
        status = set_year(item, point);
    variant->run = ceduo_run_def_default(point->scene);
    variant->run.option = point->forest;
    variant->skip = p->def->rocks == 0;
    variant->rocks = variant->run.rocks_max = point->slot > 0 ? CEDUO_UNCERTAINTY_YEAR_ROCKS : p->def->rocks;
    variant->run.arrivals_only = true;
    variant->run.cancel = p->def->cancel;
    if (status == CEDUO_OK && variant->skip)
        report_variant(item, i, false);
    return status;
}

static enum ceduo_status read_variant(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    (void)rocks;
    const struct item *item = context;
    for (size_t c = 0; c < item->work->points->def->scene->controls_count; c++)
        ceduo_run_group_means(run, c, CEDUO_SURFACE_GROUPS, find_means(item, i)[c].group);
    report_variant(item, i, true);
    uint64_t effort = ceduo_points_met(ceduo_run_contacts(run), ceduo_run_stems(run));
    uint64_t max = item->work->points->def->effort_max;
    effort += atomic_fetch_add(&item->work->effort, effort);
    return max > 0 && effort > max ? CEDUO_CANCELLED : CEDUO_OK;
}

static void copy_variant(void *context, size_t i, size_t first)
{
    const struct item *item = context;
    memcpy(find_means(item, i), find_means(item, first),
           item->work->points->def->scene->controls_count * sizeof *item->control_means);
    report_variant(item, i, true);
}

static int run_item(void *context, size_t i, size_t thread)
{
    struct work *w = context;
    bool shared_rows = i == 0 && w->shared_rows > 0;
    size_t each = shared_rows ? w->today : w->each;
    struct item item = {.work = w,
                        .copy = &w->copies[thread],
                        .row = w->from + i + (!shared_rows && w->shared_rows > 0 ? w->shared_rows - 1 : 0),
                        .each = each};
    size_t n = (shared_rows ? w->shared_rows : 1) * each;
    item.control_means = malloc((n * w->points->def->scene->controls_count + 1) * sizeof *item.control_means);
    struct ceduo_variants list = {.n = n, .make = make_variant, .read = read_variant, .same = copy_variant, .context = &item};
    enum ceduo_status status = item.control_means ? ceduo_variants_run(&list) : CEDUO_NO_MEMORY;
    ceduo_years_free(item.years);
    free(item.control_means);
    /* a thread stopped by the failure of another returns CEDUO_OK: only the first failure is reported */
    return status == CEDUO_OK || atomic_exchange(&w->failed, true) ? CEDUO_OK : (int)status;
}

/* List the variants of a row: all options today, then their years. Return false on failure of memory. */
static bool list_variants(struct work *w)
{
    const struct ceduo_uncertainty_def *def = w->points->def;
    w->variants = calloc(def->scene->options_count * (1 + CEDUO_UNCERTAINTY_YEARS_MAX), sizeof *w->variants);
    for (int later = !w->points->today; w->variants && later < (def->rotation ? 2 : 1); later++) {
        for (size_t i = 0; i < def->scene->options_count; i++) {
            size_t slots = later ? ceduo_points_years(def) : 1;
            for (size_t slot = 0; (!def->one_option || i == def->option) && slot < slots; slot++)
                w->variants[w->each++] = (struct point){.option = i, .slot = slot + (later > 0)};
        }
        w->today = later ? w->today : w->each;
    }
    return w->variants;
}

enum ceduo_status ceduo_points_run(const struct points *p, size_t from, size_t to, size_t shared_rows)
{
    struct work w = {.points = p, .from = from, .shared_rows = shared_rows};
    unsigned threads = p->def->threads > 0 ? p->def->threads : 1;
    size_t items = to - from - (shared_rows > 0 ? shared_rows - 1 : 0);
    w.copies = calloc(threads, sizeof *w.copies);
    enum ceduo_status status = w.copies && list_variants(&w) ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < threads && status == CEDUO_OK; i++)
        status = ceduo_inputs_open(&w.copies[i], p->def->scene, p->def->inputs, p->def->inputs_count);
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){items, threads, run_item, &w});
    for (size_t i = 0; w.copies && i < threads; i++)
        ceduo_inputs_release(&w.copies[i]);
    free(w.copies);
    free(w.variants);
    if (p->effort)
        *p->effort = atomic_load(&w.effort);
    return status;
}

size_t ceduo_points_window(const struct ceduo_uncertainty_def *def)
{
    struct ceduo_window w = find_window(def, def->scene);
    return (w.last - w.first) / w.step + 1;
}

size_t ceduo_points_years(const struct ceduo_uncertainty_def *def)
{
    size_t count = ceduo_points_window(def), max = def->years_max > 0 ? def->years_max : CEDUO_UNCERTAINTY_YEARS_MAX;
    return count < max ? count : max;
}

void ceduo_insert_index(const double *values, size_t index, size_t n, size_t *order)
{
    for (; n > 0 && values[order[n - 1]] > values[index]; n--)
        order[n] = order[n - 1];
    order[n] = index;
}

double ceduo_groups_mean(const struct ceduo_replicates *y, uint64_t rocks)
{
    double sum = 0;
    for (uint64_t g = 0, groups = CEDUO_SURFACE_GROUPS; g < groups; g++)
        sum += y->value[g] * (double)(rocks * (g + 1) / groups - rocks * g / groups) / (double)rocks;
    return sum;
}
