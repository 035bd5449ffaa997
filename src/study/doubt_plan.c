/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluations. Each thread has a copy of the scene of its own, takes item by item, and writes to the item's own rows: so the
 * bits do not depend on the threads. Of the evaluations of one item most share something: an input that moves one stand
 * changes no other option, and one that only one energy law reads changes nothing under the other. An item
 * is therefore one list of variants, of which no two that are equal are simulated. */
#include "doubt_plan.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "ceduo/assess.h"
#include "ceduo/variants.h"
#include "inputs.h"

size_t ceduo_plan_figures(const struct ceduo_scene *scene)
{
    return (2 * scene->options_count - 1) * CEDUO_DOUBT_KINDS;
}

size_t ceduo_plan_figure(size_t options, size_t option, enum ceduo_doubt_kind kind, bool difference)
{
    return (difference ? options + option - 1 : option) * CEDUO_DOUBT_KINDS + kind;
}

/* ---- the plan ---- */

size_t ceduo_plan_evaluations(const struct plan *p)
{
    return ceduo_design_evaluations(&p->design) + 2 * p->ends;
}

/* The first evaluation of an item; `*n`: how many it has. */
static size_t item_start(const struct plan *p, size_t item, size_t *n)
{
    size_t stride = p->design.groups + 2;
    *n = item == 0 ? 2 * p->ends : stride;
    return item == 0 ? p->rows : (item - 1) * stride;
}

enum ceduo_status ceduo_plan_fill(const struct ceduo_doubt_def *def, struct plan *p)
{
    size_t n = p->design.inputs;
    p->rows = ceduo_design_evaluations(&p->design);
    size_t evaluations = ceduo_plan_evaluations(p);
    p->u = malloc(evaluations * n * sizeof *p->u);
    p->values = calloc(evaluations * ceduo_plan_figures(def->scene), sizeof *p->values);
    if (!p->u || !p->values)
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < 2 * p->ends * n; i++)
        p->u[p->rows * n + i] = NAN;
    for (size_t i = 0; i < n; i++) {
        size_t g = p->design.group[i];
        for (size_t end = 0; g < p->ends && end < 2; end++)
            p->u[(p->rows + 2 * g + end) * n + i] = (double)end;
    }
    return ceduo_design_fill(&p->design, p->u);
}

void ceduo_plan_release(struct plan *p)
{
    free(p->u);
    free(p->values);
}

void ceduo_plan_column(const struct plan *p, size_t figures, size_t figure, struct ceduo_halves *column)
{
    for (size_t e = 0; e < p->rows; e++)
        column[e] = p->values[e * figures + figure];
}

/* ---- threads ---- */

struct work {
    const struct ceduo_doubt_def *def;
    const struct plan *plan;
    size_t from;
    uint64_t before, all; /* for the progress: of all calls together */
    atomic_size_t done;
    atomic_bool failed;         /* nothing more once any thread has failed */
    struct input_scene *copies; /* [thread] */
    pthread_mutex_t talking;
};

static void tell(struct work *w)
{
    size_t done = atomic_fetch_add(&w->done, 1) + 1;
    if (!w->def->progress || pthread_mutex_trylock(&w->talking) != 0)
        return;
    w->def->progress(w->def->context, w->before + done, w->all);
    pthread_mutex_unlock(&w->talking);
}

/* An item as variants: every option of every evaluation. */
struct item {
    struct work *work;
    struct input_scene *copy;
    const double *u;             /* of its first evaluation */
    struct ceduo_halves *values; /* likewise */
};

/* The figures of an option in an evaluation. */
static struct ceduo_halves *values_of(const struct item *item, size_t i)
{
    size_t options = item->copy->scene.options_count;
    return item->values + i / options * ceduo_plan_figures(&item->copy->scene) + i % options * CEDUO_DOUBT_KINDS;
}

static enum ceduo_status make_variant(void *context, size_t i, struct ceduo_variant *variant)
{
    struct item *item = context;
    const struct ceduo_doubt_def *def = item->work->def;
    const struct ceduo_scene *scene = &item->copy->scene;
    if (atomic_load(&item->work->failed))
        return CEDUO_CANCELLED;
    if (i % scene->options_count == 0)
        ceduo_inputs_set(item->copy, item->u + i / scene->options_count * def->inputs_count);
    variant->run = ceduo_run_def_default(scene);
    variant->run.option = &scene->options[i % scene->options_count];
    variant->run.rocks_most = def->rocks;
    variant->run.arrivals_only = true;
    variant->run.cancel = def->cancel;
    variant->rocks = def->rocks / 2;
    return CEDUO_OK;
}

/* What no rock decides is the same in both halves. After the last option come the differences to the first. */
static void end_variant(const struct item *item, size_t i)
{
    const struct ceduo_scene *scene = &item->copy->scene;
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    size_t options = scene->options_count, option = i % options;
    struct ceduo_halves *values = values_of(item, i), *all = values_of(item, i - option);
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[option], control, NAN);
    for (int h = 0; h < 2; h++) {
        values[CEDUO_DOUBT_CONTACT].half[h] = 1 / index.worst_adc;
        values[CEDUO_DOUBT_FREE_RUN].half[h] = index.worst_free_run;
    }
    if (option + 1 < options)
        return;
    for (size_t o = 1; o < options; o++)
        for (size_t k = 0; k < CEDUO_DOUBT_KINDS; k++)
            for (int h = 0; h < 2; h++)
                all[ceduo_plan_figure(options, o, (enum ceduo_doubt_kind)k, true)].half[h] =
                    all[o * CEDUO_DOUBT_KINDS + k].half[h] - all[k].half[h];
    tell(item->work);
}

/* The figures of the first and the second half of the rocks. Shares and means over all released come from sums. */
static enum ceduo_status read_variant(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    struct item *item = context;
    uint64_t all = item->work->def->rocks, now = *rocks, before = now < all ? 0 : all / 2;
    struct ceduo_halves *values = values_of(item, i);
    struct ceduo_brief brief = ceduo_run_brief(run, ceduo_scene_last_control(&item->copy->scene));
    const double means[CEDUO_DOUBT_SHOWN] = {[CEDUO_DOUBT_REACH] = brief.reach_probability,
                                             [CEDUO_DOUBT_EXCEED] = brief.exceed_probability,
                                             [CEDUO_DOUBT_ENERGY] = brief.energy_per_released};
    for (size_t k = 0; k < CEDUO_DOUBT_SHOWN; k++) {
        double first = now < all ? 0 : values[k].half[0] * (double)before;
        values[k].half[now < all ? 0 : 1] = (means[k] * (double)now - first) / (double)(now - before);
    }
    *rocks = all;
    if (now == all)
        end_variant(item, i);
    return CEDUO_OK;
}

static void same_variant(void *context, size_t i, size_t first)
{
    struct item *item = context;
    memcpy(values_of(item, i), values_of(item, first), CEDUO_DOUBT_SHOWN * sizeof(struct ceduo_halves));
    end_variant(item, i);
}

static int run_item(void *context, size_t i, size_t thread)
{
    struct work *w = context;
    size_t n, start = item_start(w->plan, w->from + i, &n);
    struct item item = {w, &w->copies[thread], w->plan->u + start * w->def->inputs_count,
                        w->plan->values + start * ceduo_plan_figures(w->def->scene)};
    enum ceduo_status status = ceduo_variants_run(&(const struct ceduo_variants){.n = n * w->def->scene->options_count,
                                                                                 .make = make_variant,
                                                                                 .read = read_variant,
                                                                                 .same = same_variant,
                                                                                 .context = &item});
    /* of threads that end because another one failed, none says so */
    return status == CEDUO_OK || atomic_exchange(&w->failed, true) ? CEDUO_OK : (int)status;
}

enum ceduo_status ceduo_plan_run(const struct ceduo_doubt_def *def, struct plan *p, size_t from, uint64_t *done, uint64_t all)
{
    struct work w = {.def = def, .plan = p, .from = from, .before = *done, .all = all};
    pthread_mutex_init(&w.talking, NULL);
    w.copies = calloc(def->threads, sizeof *w.copies);
    enum ceduo_status status = w.copies ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < def->threads && status == CEDUO_OK; i++)
        status = ceduo_inputs_open(&w.copies[i], def->scene, def->inputs, def->inputs_count);
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){p->design.points + 1 - from, def->threads, run_item, &w});
    for (size_t i = 0; w.copies && i < def->threads; i++)
        ceduo_inputs_release(&w.copies[i]);
    free(w.copies);
    pthread_mutex_destroy(&w.talking);
    *done += atomic_load(&w.done);
    return status;
}
