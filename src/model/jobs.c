/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One thread takes the coarsest step of all jobs and works on a copy of the job without the lock. It publishes the result
 * unless the job was replaced. A new job cancels the running step. The queue owns results until they are taken. */
#include "jobs.h"
#include "core/runs/alternative_law.h"
#include "core/runs/key.h"
#include "core/runs/year_runs.h"
#include "study/observe.h"
#include "study/predict.h"

#include <fcntl.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "base/text.h"
#include "study/effort.h"

#define LEVELS_MAX 9

struct job {
    enum job_kind kind;
    uint64_t number; /* number of the request; 0: none; results of other numbers are stale */
    uint64_t key;    /* key of the last request; 0: none */
    double request_time;
    size_t option;
    size_t level, levels; /* next level, number of levels */
    struct scene_file file;
    struct ceduo_search search;
    struct fit_request fit;
    char path[JOB_TEXT], value[JOB_TEXT]; /* path of a search or preview; value of a preview */
};

struct jobs {
    pthread_t thread;
    unsigned threads;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int pipe[2];
    atomic_bool cancel;
    struct runs *runs;  /* owned by the thread */
    uint64_t rocks_max; /* limit of rocks per level; 0: unlimited */
    /* guarded by the lock */
    bool quit;
    enum job_kind running; /* running job; JOB_KINDS: none */
    double uncertainty;    /* share (0…1) computed of the running level */
    uint64_t requests;
    struct job jobs[JOB_KINDS];
    union results unread;
};

/* Functions of each kind. A step works on a copy of its job in the thread. It sets *result, or publishes its results. */
struct kind {
    enum ceduo_status (*step)(struct jobs *jobs, struct job *job, void **result);
    void (*free)(void *result);
};
static const struct kind kinds[JOB_KINDS];

/* ---- results ---- */

static void free_search(void *result)
{
    struct search_answer *answer = result;
    ceduo_problems_free(&answer->problems);
    free(answer);
}

static void free_snapshot(void *result)
{
    struct snapshot *snapshot = result;
    ceduo_snapshot_free(snapshot->snapshot);
    free(snapshot);
}

static void free_years(void *result)
{
    struct option_years *y = result;
    for (size_t i = 0; i < y->n; i++)
        ceduo_years_free(y->items[i]);
    free(y);
}

static void free_uncertainty(void *result)
{
    struct uncertainty *u = result;
    if (u->answer.figures)
        ceduo_uncertainty_release(&u->answer);
    ceduo_arena_free(&u->file.arena);
    free(u);
}

static void free_comparison(void *result)
{
    struct comparison *c = result;
    free(c->predicted);
    free(c->stops);
    ceduo_arena_free(&c->file.arena);
    free(c);
}

static void free_result(enum job_kind kind, void *result)
{
    if (result)
        kinds[kind].free(result);
}

/* Store a result in a slot. Keep the years of options that it lacks. */
static void store_result(union results *results, enum job_kind kind, void *result)
{
    struct option_years *old = results->years, *years = result;
    for (size_t i = 0; kind == JOB_YEARS && old && old->n == years->n && i < years->n; i++)
        if (!years->items[i]) {
            years->items[i] = old->items[i];
            old->items[i] = NULL;
        }
    free_result(kind, results->slots[kind]);
    results->slots[kind] = result;
}

void ceduo_job_results_drop(union results *results, enum job_kind kind)
{
    free_result(kind, results->slots[kind]);
    results->slots[kind] = NULL;
}

void ceduo_job_results_free(union results *results)
{
    for (enum job_kind k = 0; k < JOB_KINDS; k++)
        ceduo_job_results_drop(results, k);
}

static void notify(struct jobs *q)
{
    char byte = 0;
    if (write(q->pipe[1], &byte, 1) < 0)
        return; /* full: a notification is pending already */
}

/* Publish a result of the job, unless the job was replaced or stopped. */
static void publish(struct jobs *q, const struct job *job, void *result)
{
    pthread_mutex_lock(&q->lock);
    bool current = q->jobs[job->kind].number == job->number;
    if (current)
        store_result(&q->unread, job->kind, result);
    pthread_mutex_unlock(&q->lock);
    if (!current)
        free_result(job->kind, result);
    else
        notify(q);
}

/* ---- steps ---- */

/* Return the number of rocks of a level. */
static uint64_t level_rocks(const struct jobs *q, size_t level)
{
    uint64_t rocks = RUNS_FIRST * (level > 1 ? 100 : level > 0 ? 10 : 1);
    return q->rocks_max > 0 && rocks > q->rocks_max ? q->rocks_max : rocks;
}

static enum ceduo_status step_search(struct jobs *q, struct job *job, void **result)
{
    struct search_answer *answer = *result = ceduo_check_memory(calloc(1, sizeof *answer));
    job->search.path = job->path;
    enum ceduo_status status = ceduo_search(&job->file, &job->search, q->threads, &q->cancel, answer);
    ceduo_arena_free(&job->file.arena);
    answer->status = status; /* an invalid request is done, too */
    return status == CEDUO_CANCELLED || status == CEDUO_NO_MEMORY ? status : CEDUO_OK;
}

static enum ceduo_status step_preview(struct jobs *q, struct job *job, void **result)
{
    struct preview *preview = *result = ceduo_check_memory(calloc(1, sizeof *preview));
    return ceduo_preview(&job->file, job->path, job->value, job->option, q->threads, &q->cancel, preview);
}

struct publisher {
    struct jobs *queue;
    const struct job *job;
    double last;
};

static void publish_snapshot(void *context, struct ceduo_snapshot *snapshot)
{
    const struct publisher *p = context;
    struct snapshot *s = ceduo_check_memory(calloc(1, sizeof *s));
    *s = (struct snapshot){snapshot, p->job->key, ceduo_clock() - p->job->request_time};
    publish(p->queue, p->job, s);
}

static enum ceduo_status step_snapshot(struct jobs *q, struct job *job, void **result)
{
    (void)result;
    struct publisher publisher = {.queue = q, .job = job};
    struct runs_step step = {&job->file.scene, job->option, level_rocks(q, job->level), publish_snapshot, &publisher, false};
    enum ceduo_status status = ceduo_runs_figures(q->runs, &step);
    job->level = step.enough ? LEVELS_MAX : job->level;
    return status;
}

static enum ceduo_status step_alternatives(struct jobs *q, struct job *job, void **result)
{
    size_t options = job->file.scene.options_count, controls = job->file.scene.controls_count;
    struct alternatives *alternatives = *result =
        ceduo_check_memory(calloc(1, sizeof *alternatives + options * controls * sizeof alternatives->items[0]));
    alternatives->options = options;
    alternatives->controls = controls;
    return ceduo_runs_alternative_energies(q->runs, &job->file.scene, level_rocks(q, job->level), alternatives->items);
}

static enum ceduo_status step_years(struct jobs *q, struct job *job, void **result)
{
    const struct ceduo_scene *scene = &job->file.scene;
    size_t n = scene->options_count;
    enum ceduo_status status = CEDUO_OK;
    for (size_t k = 0; k < n && status == CEDUO_OK; k++) {
        struct option_years *years = *result = ceduo_check_memory(calloc(1, sizeof *years + n * sizeof years->items[0]));
        size_t option = (job->option + k) % n;
        *years = (struct option_years){.n = n, .done = k + 1, .rocks = level_rocks(q, job->level)};
        status = ceduo_runs_years(q->runs, scene, option, years->rocks, &years->items[option]);
        if (status == CEDUO_OK && k + 1 < n)
            publish(q, job, years);
    }
    return status;
}

const char *ceduo_uncertainty_no_rotation(const struct ceduo_scene *scene)
{
    if (scene->simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX)
        return N_("not computed: years by the index have no uncertainty");
    return ceduo_scene_window(scene).kind == CEDUO_WINDOW_CONSTANT ? N_("not computed: all years are the same") : NULL;
}

#define PROGRESS_STEP 0.01 /* report progress in steps of this share */

static void note_progress(void *context, uint64_t done, uint64_t all)
{
    struct jobs *q = context;
    double share = all > 0 ? (double)done / (double)all : 0;
    pthread_mutex_lock(&q->lock);
    bool changed = share >= q->uncertainty + PROGRESS_STEP || share < q->uncertainty; /* falls if more points are taken */
    if (changed)
        q->uncertainty = share;
    pthread_mutex_unlock(&q->lock);
    if (changed)
        notify(q);
}

static enum ceduo_status step_uncertainty(struct jobs *q, struct job *job, void **result)
{
    struct uncertainty *u = *result = ceduo_check_memory(calloc(1, sizeof *u));
    struct ceduo_scene *scene = &u->file.scene;
    *u = (struct uncertainty){.file = job->file, .level = job->level, .option = job->option};
    if (!ceduo_inputs_collect(&u->file, &u->inputs))
        return CEDUO_NO_MEMORY;
    if (ceduo_uncertainty_no_rotation(scene))
        ceduo_inputs_keep_today(&u->inputs);
    if (scene->controls_count == 0)
        u->inputs.n = 0;
    if (u->level == 0 && scene->options_count == 1)
        u->level = UNCERTAINTY_LEVELS - 1;
    u->last = u->inputs.n == 0 || u->level + 1 == UNCERTAINTY_LEVELS;
    job->level = u->last ? LEVELS_MAX : u->level;
    if (u->inputs.n == 0)
        return CEDUO_OK;
    struct ceduo_uncertainty_def def = {
        .size = sizeof def, .scene = scene, .inputs_count = u->inputs.n, .inputs = u->inputs.items, .brief = true};
    def.points = CEDUO_UNCERTAINTY_POINTS;
    def.rocks = CEDUO_UNCERTAINTY_ROCKS;
    def.rotation = !ceduo_uncertainty_no_rotation(scene);
    def.option = job->option;
    def.threads = q->threads;
    def.cancel = &q->cancel;
    def.progress = note_progress;
    def.context = q;
    enum ceduo_status status = ceduo_effort_bound(&def, NULL); /* bound all levels equally, so that figures do not move */
    if (status != CEDUO_OK)
        return status;
    if (def.points == 0) /* never skip: the screen must not wait */
        def.points = def.points_max = CEDUO_UNCERTAINTY_MIN;
    def.effort_max = 0;
    def.one_option = u->level == 0;
    return ceduo_uncertainty_compute(&def, &u->answer);
}

static enum ceduo_status step_comparison(struct jobs *q, struct job *job, void **result)
{
    static const uint64_t comparison_rocks[COMPARISON_LEVELS] = {200, 2000};
    struct comparison *c = *result = ceduo_check_memory(calloc(1, sizeof *c));
    *c = (struct comparison){.file = job->file, .rocks = comparison_rocks[job->level]};
    size_t count = c->file.observations_count;
    const struct ceduo_observation *o = c->file.observations;
    c->predicted = ceduo_check_memory(calloc(count + 1, sizeof *c->predicted));
    c->stops = ceduo_check_memory(calloc(count + 1, sizeof *c->stops));
    const struct ceduo_calibration_scene scene = {.scene = &c->file.scene, .observations_count = count, .observations = o};
    struct ceduo_observer *observer = NULL;
    enum ceduo_status status = ceduo_compare_with_observations(&scene, c->rocks, &q->cancel, c->predicted);
    if (status == CEDUO_OK)
        status = ceduo_observer_create(o, count, &observer);
    for (size_t i = 0; i < count && status == CEDUO_OK; i++) {
        double *values = NULL;
        size_t rocks, n = 0;
        if (o[i].kind != CEDUO_OBSERVED_STOPS || !o[i].values)
            continue;
        status = atomic_load(&q->cancel) ? CEDUO_CANCELLED
                                         : ceduo_observer_values(observer, &c->file.scene, i, c->rocks, &values, &rocks);
        for (size_t k = 0; status == CEDUO_OK && k < rocks; k++)
            if (!isnan(values[k]))
                values[n++] = values[k];
        gsl_sort(values, 1, n);
        if (n > 0)
            ceduo_observed_stops_find(&o[i], values, n, rocks, &c->stops[i]);
        free(values);
    }
    ceduo_observer_free(observer);
    return status;
}

/* Publish progress at most ten times a second. */
static void publish_progress(void *context, const struct ceduo_calibration_state *state)
{
    struct publisher *p = context;
    double now = ceduo_clock();
    if (now - p->last < 0.1)
        return;
    p->last = now;
    struct fit *fit = ceduo_check_memory(calloc(1, sizeof *fit));
    *fit = (struct fit){.request = p->job->fit, .state = *state};
    publish(p->queue, p->job, fit);
}

static enum ceduo_status step_fit(struct jobs *q, struct job *job, void **result)
{
    struct publisher publisher = {.queue = q, .job = job};
    const struct ceduo_calibration_def def = {
        .size = sizeof def, .threads = q->threads, .cancel = &q->cancel, .progress = publish_progress, .context = &publisher};
    struct fit *fit = *result = ceduo_check_memory(calloc(1, sizeof *fit));
    return ceduo_fit_compute(&job->file, &job->fit, &def, fit);
}

static const struct kind kinds[JOB_KINDS] = {
#define X(NAME, name, type, free) [JOB_##NAME] = {step_##name, free},
    JOBS(X)
#undef X
};

/* ---- the thread ---- */

static bool is_pending(const struct job *job)
{
    return job->level < job->levels;
}

/* Rocks of the next step: the job with the fewest runs next. Years have many forests. The uncertainty takes longer than the
 * second level of all others. */
static uint64_t step_rocks(const struct jobs *q, const struct job *job)
{
    if (job->kind == JOB_SEARCH || job->kind == JOB_PREVIEW)
        return 0;
    size_t level = job->kind == JOB_UNCERTAINTY && job->level == 0 ? 1 : job->level;
    return level_rocks(q, level) * (job->kind == JOB_YEARS && job->level > 0 ? 2 : 1);
}

static enum job_kind next_job(const struct jobs *q)
{
    enum job_kind next = JOB_KINDS;
    for (enum job_kind k = 0; k < JOB_KINDS; k++)
        if (is_pending(&q->jobs[k]) && (next == JOB_KINDS || step_rocks(q, &q->jobs[k]) < step_rocks(q, &q->jobs[next])))
            next = k;
    return next;
}

static void *work(void *argument)
{
    struct jobs *q = argument;
    pthread_mutex_lock(&q->lock);
    while (!q->quit) {
        enum job_kind kind = q->running = next_job(q);
        if (kind == JOB_KINDS) {
            pthread_cond_broadcast(&q->changed);
            notify(q);
            pthread_cond_wait(&q->changed, &q->lock);
            continue;
        }
        struct job job = q->jobs[kind];
        q->uncertainty = 0;
        atomic_store(&q->cancel, false);
        pthread_mutex_unlock(&q->lock);
        void *result = NULL;
        enum ceduo_status status = kinds[kind].step(q, &job, &result);
        if (status == CEDUO_NO_MEMORY)
            ceduo_oom_set_flag();
        if (status == CEDUO_OK && result)
            publish(q, &job, result);
        else
            free_result(kind, result);
        pthread_mutex_lock(&q->lock);
        if (q->jobs[kind].number == job.number && status != CEDUO_CANCELLED) /* otherwise the step is repeated */
            q->jobs[kind].level = status == CEDUO_OK ? job.level + 1 : LEVELS_MAX;
        if (kind == JOB_SEARCH || kind == JOB_PREVIEW)
            pthread_cond_broadcast(&q->changed);
    }
    pthread_mutex_unlock(&q->lock);
    return NULL;
}

/* ---- creating and freeing ---- */

static void free_jobs(struct jobs *q)
{
    ceduo_runs_free(q->runs);
    ceduo_job_results_free(&q->unread);
    if (q->pipe[0] >= 0) {
        close(q->pipe[0]);
        close(q->pipe[1]);
    }
    free(q);
}

struct jobs *ceduo_jobs_create(unsigned threads)
{
    struct jobs *q = ceduo_check_memory(calloc(1, sizeof *q));
    q->threads = threads;
    q->running = JOB_KINDS;
    const char *rocks = getenv("CEDUO_ROCKS");
    if (!rocks || ceduo_count_read(rocks, 1, CEDUO_ROCKS_MAX, &q->rocks_max) != CEDUO_NUMBER_GOOD)
        q->rocks_max = 0;
    q->runs = ceduo_runs_create(threads, &q->cancel);
    q->pipe[0] = -1;
    pthread_mutex_init(&q->lock, NULL);
    pthread_cond_init(&q->changed, NULL);
    if (pipe2(q->pipe, O_NONBLOCK | O_CLOEXEC) != 0 || pthread_create(&q->thread, NULL, work, q) != 0) {
        free_jobs(q);
        return NULL;
    }
    return q;
}

void ceduo_jobs_free(struct jobs *q)
{
    if (!q)
        return;
    pthread_mutex_lock(&q->lock);
    q->quit = true;
    atomic_store(&q->cancel, true);
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
    pthread_join(q->thread, NULL);
    pthread_mutex_destroy(&q->lock);
    pthread_cond_destroy(&q->changed);
    free_jobs(q);
}

/* ---- requests ---- */

uint64_t ceduo_jobs_key(const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_scene_key(scene);
    hash_count(&key, ceduo_controls_key(scene));
    for (size_t i = 0; i < scene->options_count; i++)
        hash_count(&key, ceduo_option_key(scene, &scene->options[i]));
    hash_count(&key, (uint64_t)scene->simulation.contact_model);
    return key;
}

uint64_t ceduo_jobs_nodes_key(const struct node *root)
{
    static const char *const titles[] = {"title", "title_it", "page"};
    uint64_t key = HASH_START;
    for (size_t i = 0; i < root->n; i++) {
        bool counts = true;
        for (size_t k = 0; k < sizeof titles / sizeof titles[0]; k++)
            counts &= strcmp(root->items[i]->key, titles[k]) != 0;
        if (counts)
            hash_count(&key, (uint64_t)(uintptr_t)root->items[i]);
    }
    return key;
}

/* Return a job on a snapshot of the scene. The job owns the snapshot's memory. */
static struct job make_job(enum job_kind kind, const struct scene_file *file, size_t option, size_t levels)
{
    struct job job = {.kind = kind, .option = option, .levels = levels, .file = *file};
    job.file.arena = (struct arena){0};
    return job;
}

/* Drop a job and its result. Requires the lock. */
static void drop_job(struct jobs *q, enum job_kind kind)
{
    ceduo_job_results_drop(&q->unread, kind);
    q->jobs[kind] = (struct job){.kind = kind};
    if (q->running == kind)
        atomic_store(&q->cancel, true);
}

/* Replace the job of this kind. One with the same key continues up to these levels. True if there is work. */
static bool enqueue(struct jobs *q, const struct job *job)
{
    pthread_mutex_lock(&q->lock);
    struct job *now = &q->jobs[job->kind];
    bool queued = job->levels > 0;
    if (!queued) {
        if (is_pending(now))
            drop_job(q, job->kind);
    } else if (job->key != 0 && now->key == job->key) {
        queued = !is_pending(now) && now->level < job->levels;
        now->levels = job->levels;
        if (q->running == job->kind && !is_pending(now))
            atomic_store(&q->cancel, true);
    } else {
        ceduo_job_results_drop(&q->unread, job->kind);
        *now = *job;
        now->number = ++q->requests;
        now->request_time = ceduo_clock();
        atomic_store(&q->cancel, true);
    }
    if (queued)
        pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
    return queued;
}

bool ceduo_jobs_request_figures(struct jobs *q, const struct scene_file *file, size_t shown)
{
    bool index = file->scene.simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX; /* the index uses no other energy law */
    struct job figures = make_job(JOB_SNAPSHOT, file, shown, RUNS_LEVELS);
    struct job alternatives = make_job(JOB_ALTERNATIVES, file, shown, index ? 0 : RUNS_LEVELS - 1);
    struct job years = make_job(JOB_YEARS, file, shown, RUNS_LEVELS - 1);
    struct ceduo_scene alternative_scene;
    figures.key = years.key = ceduo_jobs_key(&file->scene);
    if (!index) {
        if (!ceduo_alternative_scene(&file->scene, &alternative_scene))
            ceduo_oom_set_flag();
        alternatives.key = figures.key;
        hash_count(&alternatives.key, JOB_ALTERNATIVES); /* otherwise two laws would have the same key as after a swap */
        hash_count(&alternatives.key, ceduo_jobs_key(&alternative_scene));
        ceduo_alternative_scene_release(&alternative_scene);
    }
    for (size_t i = 0; i < file->scene.options_count; i++)
        hash_count(&years.key, ceduo_runs_years_key(&file->scene, i));
    bool queued = enqueue(q, &figures); /* false: no rock meets anything new */
    if (queued)
        ceduo_jobs_stop(q, JOB_YEARS);
    queued |= enqueue(q, &alternatives);
    queued |= enqueue(q, &years);
    return queued;
}

bool ceduo_jobs_request(struct jobs *q, const struct job_request *r)
{
    struct job job = make_job(r->kind, r->file, r->option, r->levels);
    snprintf(job.path, sizeof job.path, "%s", r->search ? r->search->path : r->path ? r->path : "");
    snprintf(job.value, sizeof job.value, "%s", r->value ? r->value : "");
    if (r->search)
        job.search = *r->search;
    if (r->fit)
        job.fit = *r->fit;
    if (r->kind == JOB_UNCERTAINTY || r->kind == JOB_COMPARISON)
        job.key = ceduo_jobs_nodes_key(r->file->root);
    return enqueue(q, &job);
}

void ceduo_jobs_stop(struct jobs *q, enum job_kind kind)
{
    pthread_mutex_lock(&q->lock);
    drop_job(q, kind);
    pthread_mutex_unlock(&q->lock);
}

/* ---- notifications ---- */

int ceduo_jobs_fd(const struct jobs *q)
{
    return q->pipe[0];
}

struct jobs_state ceduo_jobs_collect(struct jobs *q, union results *results)
{
    char bytes[64];
    while (read(q->pipe[0], bytes, sizeof bytes) > 0)
        ;
    pthread_mutex_lock(&q->lock);
    struct jobs_state state = {.busy = q->running != JOB_KINDS || next_job(q) != JOB_KINDS,
                               .fitting = is_pending(&q->jobs[JOB_FIT]),
                               .uncertainty = is_pending(&q->jobs[JOB_UNCERTAINTY]) ? q->uncertainty : NAN};
    for (enum job_kind k = 0; k < JOB_KINDS; k++)
        if (q->unread.slots[k]) {
            state.new_kinds |= 1u << k;
            store_result(results, k, q->unread.slots[k]);
            q->unread.slots[k] = NULL;
        }
    pthread_mutex_unlock(&q->lock);
    return state;
}

bool ceduo_jobs_wait(struct jobs *q, bool all)
{
    pthread_mutex_lock(&q->lock);
    while (all ? q->running != JOB_KINDS || next_job(q) != JOB_KINDS
               : is_pending(&q->jobs[JOB_SEARCH]) || is_pending(&q->jobs[JOB_PREVIEW]))
        pthread_cond_wait(&q->changed, &q->lock);
    bool changed = q->unread.search || q->unread.preview;
    pthread_mutex_unlock(&q->lock);
    return changed;
}
