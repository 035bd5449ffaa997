/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluations. Each thread has a copy of the scene of its own, takes item by item, and writes to the item's own rows: so the
 * bits do not depend on the threads. Of the evaluations of one item most share something: an input that moves one stand
 * changes no other option, and one that only one energy law reads changes nothing under the other. A thread therefore keeps
 * what it found in its item, by the keys of scene and forest, and simulates nothing twice. */
#include "doubt_plan.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "ceduo/assess.h"
#include "ceduo/key.h"
#include "ceduo/run.h"
#include "inputs.h"

size_t ceduo_plan_figures(const struct ceduo_scene *scene)
{
    return (2 * scene->options_count - 1) * CEDUO_DOUBT_KINDS;
}

size_t ceduo_plan_figure(size_t options, size_t option, enum ceduo_doubt_kind kind, bool difference)
{
    return (difference ? options + option - 1 : option) * CEDUO_DOUBT_KINDS + kind;
}

/* ---- one evaluation ---- */

/* What is known of a forest: the figures of both halves of the rocks. */
struct known {
    uint64_t scene, forest;
    struct ceduo_halves values[CEDUO_DOUBT_SHOWN];
};

struct memory {
    size_t n;
    struct known *items;
};

/* The figures of the first and the second half of the rocks. Shares and means over all released come from sums. */
static enum ceduo_status fly(const struct ceduo_doubt_def *def, const struct ceduo_scene *scene,
                             const struct ceduo_option *option, struct ceduo_halves *values)
{
    struct ceduo_run_def run_def = ceduo_run_def_default(scene);
    struct ceduo_run *run;
    uint64_t before = 0;
    run_def.option = option;
    run_def.rocks_most = def->rocks;
    run_def.arrivals_only = true;
    run_def.cancel = def->cancel;
    enum ceduo_status status = ceduo_run_create(&run_def, &run);
    for (int h = 0; h < 2 && status == CEDUO_OK; h++) {
        uint64_t rocks = h == 0 ? def->rocks / 2 : def->rocks;
        status = ceduo_run_extend(run, rocks);
        if (status != CEDUO_OK)
            break;
        struct ceduo_brief brief = ceduo_run_brief(run, ceduo_scene_last_control(scene));
        const double means[CEDUO_DOUBT_SHOWN] = {[CEDUO_DOUBT_REACH] = brief.reach_probability,
                                                 [CEDUO_DOUBT_EXCEED] = brief.exceed_probability,
                                                 [CEDUO_DOUBT_ENERGY] = brief.energy_per_released};
        for (size_t k = 0; k < CEDUO_DOUBT_SHOWN; k++) {
            double first = h == 0 ? 0 : values[k].half[0] * (double)before;
            values[k].half[h] = (means[k] * (double)rocks - first) / (double)(rocks - before);
        }
        before = rocks;
    }
    ceduo_run_free(run);
    return status;
}

static struct known *find(struct memory *memory, uint64_t scene, uint64_t forest)
{
    for (size_t i = 0; i < memory->n; i++)
        if (memory->items[i].scene == scene && memory->items[i].forest == forest)
            return &memory->items[i];
    return NULL;
}

/* What no rock decides: the same in both halves. */
static void read_lights(const struct ceduo_scene *scene, size_t option, struct ceduo_halves *values)
{
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[option], control, NAN);
    for (int h = 0; h < 2; h++) {
        values[CEDUO_DOUBT_CONTACT].half[h] = 1 / index.worst_adc;
        values[CEDUO_DOUBT_FREE_RUN].half[h] = index.worst_free_run;
    }
}

static enum ceduo_status evaluate(const struct ceduo_doubt_def *def, const struct ceduo_scene *scene, struct memory *memory,
                                  struct ceduo_halves *values)
{
    size_t options = scene->options_count;
    uint64_t key = ceduo_scene_key(scene);
    for (size_t i = 0; i < options; i++) {
        uint64_t forest = ceduo_option_key(scene, &scene->options[i]);
        struct known *known = find(memory, key, forest);
        if (!known) {
            known = &memory->items[memory->n];
            *known = (struct known){key, forest, {{{0}}}};
            enum ceduo_status status = fly(def, scene, forest != 0 ? &scene->options[i] : NULL, known->values);
            if (status != CEDUO_OK)
                return status;
            memory->n++;
        }
        memcpy(&values[i * CEDUO_DOUBT_KINDS], known->values, sizeof known->values);
        read_lights(scene, i, &values[i * CEDUO_DOUBT_KINDS]);
    }
    for (size_t i = 1; i < options; i++)
        for (size_t k = 0; k < CEDUO_DOUBT_KINDS; k++)
            for (int h = 0; h < 2; h++)
                values[ceduo_plan_figure(options, i, (enum ceduo_doubt_kind)k, true)].half[h] =
                    values[i * CEDUO_DOUBT_KINDS + k].half[h] - values[k].half[h];
    return CEDUO_OK;
}

/* ---- the plan ---- */

size_t ceduo_plan_items(const struct plan *p)
{
    return p->design.points + 1;
}

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
    struct memory *memories;
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

static int run_item(void *context, size_t item, size_t thread)
{
    struct work *w = context;
    const struct ceduo_doubt_def *def = w->def;
    struct memory *memory = &w->memories[thread];
    size_t figures = ceduo_plan_figures(def->scene), n, start = item_start(w->plan, w->from + item, &n);
    enum ceduo_status status = CEDUO_OK;
    memory->n = 0;
    for (size_t e = start; e < start + n && status == CEDUO_OK && !atomic_load(&w->failed); e++) {
        ceduo_inputs_set(&w->copies[thread], w->plan->u + e * def->inputs_count);
        status = evaluate(def, &w->copies[thread].scene, memory, w->plan->values + e * figures);
        tell(w);
    }
    if (status != CEDUO_OK)
        atomic_store(&w->failed, true);
    return (int)status;
}

/* What each thread has for itself: a copy of the scene, and what it knows of an item. */
static enum ceduo_status open_threads(struct work *w)
{
    const struct ceduo_doubt_def *def = w->def;
    size_t stride = w->plan->design.groups + 2, most = stride > 2 * w->plan->ends ? stride : 2 * w->plan->ends;
    enum ceduo_status status = CEDUO_OK;
    w->copies = calloc(def->threads, sizeof *w->copies);
    w->memories = calloc(def->threads, sizeof *w->memories);
    for (size_t i = 0; w->copies && w->memories && i < def->threads && status == CEDUO_OK; i++) {
        status = ceduo_inputs_open(&w->copies[i], def->scene, def->inputs, def->inputs_count);
        w->memories[i].items = calloc(most * def->scene->options_count, sizeof *w->memories[i].items);
        if (!w->memories[i].items)
            status = CEDUO_NO_MEMORY;
    }
    return w->copies && w->memories ? status : CEDUO_NO_MEMORY;
}

static void close_threads(struct work *w)
{
    for (size_t i = 0; w->copies && w->memories && i < w->def->threads; i++) {
        ceduo_inputs_release(&w->copies[i]);
        free(w->memories[i].items);
    }
    free(w->copies);
    free(w->memories);
}

enum ceduo_status ceduo_plan_run(const struct ceduo_doubt_def *def, struct plan *p, size_t from, size_t to, uint64_t *done,
                                 uint64_t all)
{
    struct work w = {.def = def, .plan = p, .from = from, .before = *done, .all = all};
    pthread_mutex_init(&w.talking, NULL);
    enum ceduo_status status = open_threads(&w);
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){to - from, def->threads, run_item, &w});
    close_threads(&w);
    pthread_mutex_destroy(&w.talking);
    *done += atomic_load(&w.done);
    return status;
}
