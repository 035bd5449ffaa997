/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One thread takes the coarsest step of all jobs, works on a copy of the job without the lock, and hands the result
 * over if the job was not replaced meanwhile. A new job cancels the step under way. The queue owns results until they
 * are fetched. */
#include "jobs.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/must.h"
#include "ceduo/key.h"

/* Of two steps as coarse the first goes first. */
enum kind { SEEK, FORESEE, FIGURES, OTHERS, LOOK, FIT, YEARS, DOUBT, KINDS, NONE = KINDS };

struct job {
    bool wanted;     /* not done */
    uint64_t number; /* of the request; 0: none. A result of another number is stale */
    uint64_t key;    /* of what was asked for last; 0: nothing */
    uint64_t rocks;  /* of the next step; a search has one, and goes first */
    double asked;
    size_t option;
    size_t level, levels; /* of the doubt and of a look at what was seen: the next, and so many */
    struct ceduo_scene scene;
    struct seek seek;
    struct fit_wish wish;
    struct scene_file file; /* of all but the runs: what the search changes, for one */
    char path[1024];        /* of the search; the change that is foreseen */
};

struct jobs {
    pthread_t thread;
    unsigned threads;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int pipe[2];
    atomic_bool cancel;
    struct flights *flights; /* the thread's own */
    /* under the lock */
    bool quit;
    enum kind working;
    uint64_t requests;
    struct job jobs[KINDS];
    struct jobs_news news;
};

static void tell(struct jobs *q)
{
    char byte = 0;
    if (write(q->pipe[1], &byte, 1) < 0)
        return; /* full: news is waiting to be read anyway */
}

/* ---- steps, in the thread: each works on a copy of its job ---- */

/* Takes the lock for a result of the job; false, and no lock, where it is stale. */
static bool lock_result(struct jobs *q, enum kind kind, uint64_t number)
{
    pthread_mutex_lock(&q->lock);
    if (q->jobs[kind].number == number)
        return true;
    pthread_mutex_unlock(&q->lock);
    return false;
}

static void unlock_result(struct jobs *q)
{
    pthread_mutex_unlock(&q->lock);
    tell(q);
}

struct publisher {
    struct jobs *queue;
    const struct job *job;
};

static void publish(void *context, struct ceduo_outlook *outlook)
{
    const struct publisher *p = context;
    struct jobs_news *news = &p->queue->news;
    if (!lock_result(p->queue, FIGURES, p->job->number)) {
        ceduo_outlook_free(outlook);
        return;
    }
    ceduo_outlook_free(news->outlook);
    news->outlook = outlook;
    news->key = p->job->key;
    news->seconds = ceduo_clock() - p->job->asked;
    unlock_result(p->queue);
}

static enum ceduo_status step_figures(struct jobs *q, struct job *job)
{
    struct publisher publisher = {q, job};
    bool enough = false;
    enum ceduo_status status =
        ceduo_flights_figures(q->flights, &job->scene, job->option, job->rocks, publish, &publisher, &enough);
    job->wanted = !enough;
    return status;
}

static enum ceduo_status step_others(struct jobs *q, struct job *job)
{
    size_t options = job->scene.options_count, controls = job->scene.controls_count;
    struct ceduo_other_energy *others = calloc(options * controls + 1, sizeof *others);
    enum ceduo_status status = others ? ceduo_flights_others(q->flights, &job->scene, job->rocks, others) : CEDUO_NO_MEMORY;
    job->wanted = job->rocks < FLIGHTS_OTHERS;
    if (status != CEDUO_OK || !lock_result(q, OTHERS, job->number)) {
        free(others);
        return status;
    }
    free(q->news.others);
    q->news.others = others;
    q->news.others_options = options;
    q->news.others_controls = controls;
    unlock_result(q);
    return CEDUO_OK;
}

void ceduo_jobs_free_years(struct ceduo_years **years, size_t n)
{
    for (size_t i = 0; years && i < n; i++)
        ceduo_years_free(years[i]);
    free(years);
}

static void drop_years(struct jobs_news *news)
{
    ceduo_jobs_free_years(news->years, news->years_count);
    news->years = NULL;
    news->years_count = news->done = news->all = 0;
}

/* Puts the years of an option in the place of its older ones. */
static bool keep_years(struct jobs_news *news, size_t options, size_t option, struct ceduo_years *years)
{
    if (!news->years)
        news->years = calloc(options + 1, sizeof *news->years);
    if (!news->years)
        return false;
    news->years_count = options;
    ceduo_years_free(news->years[option]);
    news->years[option] = years;
    return true;
}

static enum ceduo_status step_years(struct jobs *q, struct job *job)
{
    size_t n = job->scene.options_count;
    enum ceduo_status status = CEDUO_OK;
    job->wanted = job->rocks < FLIGHTS_YEAR;
    for (size_t k = 0; k < n && status == CEDUO_OK; k++) {
        size_t option = (job->option + k) % n;
        struct ceduo_years *years;
        status = ceduo_flights_years(q->flights, &job->scene, option, job->rocks, &years);
        if (status != CEDUO_OK)
            break;
        if (!lock_result(q, YEARS, job->number)) {
            ceduo_years_free(years);
            return CEDUO_OK;
        }
        if (!keep_years(&q->news, n, option, years)) {
            ceduo_years_free(years);
            status = CEDUO_NO_MEMORY;
        }
        q->news.done = k + 1;
        q->news.all = n;
        q->news.rocks = job->rocks;
        unlock_result(q);
    }
    return status;
}

void ceduo_sought_free(struct sought *sought)
{
    if (sought)
        ceduo_problems_free(&sought->problems);
    free(sought);
}

/* A search that finds fault with what was asked is done, too. */
static enum ceduo_status step_seek(struct jobs *q, struct job *job)
{
    struct sought *sought = calloc(1, sizeof *sought);
    if (!sought)
        return CEDUO_NO_MEMORY;
    job->seek.file = &job->file;
    job->seek.search.path = job->path;
    job->seek.threads = q->threads;
    job->seek.cancel = &q->cancel;
    sought->status = ceduo_seek(&job->seek, &sought->found, &sought->problems);
    sought->target = job->seek.search.target;
    sought->rotation = job->seek.search.rotation;
    sought->yield = job->seek.yield;
    ceduo_arena_free(&job->file.arena);
    job->wanted = false;
    if (sought->status == CEDUO_CANCELLED || !lock_result(q, SEEK, job->number)) {
        ceduo_sought_free(sought);
        return CEDUO_CANCELLED;
    }
    ceduo_sought_free(q->news.sought);
    q->news.sought = sought;
    unlock_result(q);
    return CEDUO_OK;
}

static enum ceduo_status step_foresee(struct jobs *q, struct job *job)
{
    struct foreseen foreseen;
    enum ceduo_status status = ceduo_foresee(&job->file, job->path, job->option, q->threads, &q->cancel, &foreseen);
    job->wanted = false;
    if (status != CEDUO_OK || !lock_result(q, FORESEE, job->number))
        return status;
    q->news.foresaw = true;
    q->news.foreseen = foreseen;
    unlock_result(q);
    return CEDUO_OK;
}

static enum ceduo_status step_doubt(struct jobs *q, struct job *job)
{
    struct doubted *doubted;
    enum ceduo_status status = ceduo_doubted_make(&job->file, job->level, q->threads, &q->cancel, &doubted);
    if (status != CEDUO_OK)
        return status;
    if (!lock_result(q, DOUBT, job->number)) {
        ceduo_doubted_free(doubted);
        return CEDUO_OK;
    }
    struct job *asked = &q->jobs[DOUBT];
    asked->level = doubted->inputs.n > 0 ? job->level + 1 : DOUBT_LEVELS; /* without inputs there is nothing finer */
    ceduo_doubted_free(q->news.doubted);
    q->news.doubted = doubted;
    unlock_result(q);
    return CEDUO_OK;
}

static enum ceduo_status step_look(struct jobs *q, struct job *job)
{
    struct sighted *sighted;
    enum ceduo_status status = ceduo_sighted_make(&job->file, job->level, &q->cancel, &sighted);
    if (status != CEDUO_OK)
        return status;
    if (!lock_result(q, LOOK, job->number)) {
        ceduo_sighted_free(sighted);
        return CEDUO_OK;
    }
    q->jobs[LOOK].level = job->level + 1;
    ceduo_sighted_free(q->news.sighted);
    q->news.sighted = sighted;
    unlock_result(q);
    return CEDUO_OK;
}

struct teller {
    struct jobs *queue;
    const struct job *job;
    double told;
};

/* Ten times a second is enough to look at. */
static void tell_fit(void *context, const struct ceduo_calibration_state *state)
{
    struct teller *t = context;
    double now = ceduo_clock();
    if (now - t->told < 0.1 || !lock_result(t->queue, FIT, t->job->number))
        return;
    t->told = now;
    t->queue->news.fit_state = *state;
    unlock_result(t->queue);
}

static enum ceduo_status step_fit(struct jobs *q, struct job *job)
{
    struct teller teller = {.queue = q, .job = job};
    const struct fit_run run = {q->threads, &q->cancel, tell_fit, &teller};
    struct fit *fit;
    enum ceduo_status status = ceduo_fit_make(&job->file, &job->wish, &run, &fit);
    job->wanted = false;
    if (status != CEDUO_OK)
        return status;
    if (!lock_result(q, FIT, job->number)) {
        ceduo_fit_free(fit);
        return CEDUO_OK;
    }
    ceduo_fit_free(q->news.fit);
    q->news.fit = fit;
    unlock_result(q);
    return CEDUO_OK;
}

/* ---- the thread ---- */

static enum kind next_kind(const struct jobs *q)
{
    enum kind next = NONE;
    for (enum kind k = SEEK; k < KINDS; k++)
        if (q->jobs[k].wanted && (next == NONE || q->jobs[k].rocks < q->jobs[next].rocks))
            next = k;
    return next;
}

/* The first look at the doubt goes after the first figures and years, all else of it after all of theirs. */
static uint64_t rocks_before(size_t level)
{
    return level == 0 ? FLIGHTS_FIRST : 10 * FLIGHTS_MOST;
}

static bool has_levels(enum kind kind)
{
    return kind == DOUBT || kind == LOOK;
}

/* What comes of a step: the job is done, goes on finer, or with the same step where it was interrupted. */
static void end_step(struct jobs *q, enum kind kind, const struct job *done, enum ceduo_status status)
{
    struct job *job = &q->jobs[kind];
    if (status == CEDUO_NO_MEMORY)
        ceduo_no_memory();
    if (job->number != done->number || status == CEDUO_CANCELLED)
        return;
    job->wanted = status == CEDUO_OK && (has_levels(kind) ? job->level < job->levels : done->wanted);
    job->rocks = kind == DOUBT ? rocks_before(job->level) : job->rocks * 10;
}

static void *work(void *argument)
{
    static enum ceduo_status (*const steps[KINDS])(struct jobs * q, struct job * job) = {
        step_seek, step_foresee, step_figures, step_others, step_look, step_fit, step_years, step_doubt};
    struct jobs *q = argument;
    pthread_mutex_lock(&q->lock);
    while (!q->quit) {
        enum kind kind = q->working = next_kind(q);
        if (kind == NONE) {
            pthread_cond_broadcast(&q->changed);
            tell(q);
            pthread_cond_wait(&q->changed, &q->lock);
            continue;
        }
        struct job job = q->jobs[kind];
        atomic_store(&q->cancel, false);
        pthread_mutex_unlock(&q->lock);
        enum ceduo_status status = steps[kind](q, &job);
        pthread_mutex_lock(&q->lock);
        end_step(q, kind, &job, status);
        if (kind == SEEK || kind == FORESEE)
            pthread_cond_broadcast(&q->changed);
    }
    pthread_mutex_unlock(&q->lock);
    return NULL;
}

/* ---- making and freeing ---- */

static void release(struct jobs *q)
{
    ceduo_flights_free(q->flights);
    ceduo_outlook_free(q->news.outlook);
    drop_years(&q->news);
    free(q->news.others);
    ceduo_doubted_free(q->news.doubted);
    ceduo_sighted_free(q->news.sighted);
    ceduo_fit_free(q->news.fit);
    ceduo_sought_free(q->news.sought);
    if (q->pipe[0] >= 0) {
        close(q->pipe[0]);
        close(q->pipe[1]);
    }
    free(q);
}

struct jobs *ceduo_jobs_create(unsigned threads)
{
    struct jobs *q = calloc(1, sizeof *q);
    if (!q)
        return NULL;
    q->threads = threads;
    q->working = NONE;
    q->flights = ceduo_flights_create(threads, &q->cancel);
    q->pipe[0] = -1;
    pthread_mutex_init(&q->lock, NULL);
    pthread_cond_init(&q->changed, NULL);
    if (!q->flights || pipe2(q->pipe, O_NONBLOCK | O_CLOEXEC) != 0 || pthread_create(&q->thread, NULL, work, q) != 0) {
        release(q);
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
    release(q);
}

unsigned ceduo_jobs_threads(const struct jobs *q)
{
    return q->threads;
}

/* ---- asking ---- */

uint64_t ceduo_jobs_key(const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_scene_key(scene);
    for (size_t i = 0; i < scene->options_count; i++)
        key = key * 1099511628211u ^ ceduo_option_key(scene, &scene->options[i]);
    return key * 1099511628211u ^ scene->options_count ^ (uint64_t)scene->simulation.contact_model << 32;
}

/* Puts a job in the place of the one before; under the lock. */
static void ask(struct jobs *q, enum kind kind, const struct job *job)
{
    q->jobs[kind] = *job;
    q->jobs[kind].wanted = true;
    q->jobs[kind].number = ++q->requests;
    q->jobs[kind].asked = ceduo_clock();
    atomic_store(&q->cancel, true);
    pthread_cond_broadcast(&q->changed);
}

/* A job that is not done; under the lock. */
static void drop(struct jobs *q, enum kind kind)
{
    if (!q->jobs[kind].wanted)
        return;
    q->jobs[kind] = (struct job){0};
    if (q->working == kind)
        atomic_store(&q->cancel, true);
}

/* A number for all that decides about the other energy law; 0: it is not asked for, or there is no memory. */
static uint64_t others_key(const struct ceduo_scene *scene, uint64_t key)
{
    struct ceduo_scene other;
    bool wooded = scene->simulation.contact_model != CEDUO_INDEX, good = ceduo_other_scene(scene, &other);
    uint64_t all = wooded && good ? key * 1099511628211u ^ ceduo_jobs_key(&other) : 0;
    ceduo_other_scene_release(&other);
    return all;
}

bool ceduo_jobs_show(struct jobs *q, const struct ceduo_scene *scene, uint64_t key, size_t shown, bool years)
{
    struct job figures = {.key = key, .rocks = FLIGHTS_FIRST, .option = shown, .scene = *scene}, coming = figures;
    struct job others = figures;
    others.key = others_key(scene, key);
    for (size_t i = 0; years && i < scene->options_count; i++)
        coming.key = coming.key * 1099511628211u ^ ceduo_flights_years_key(scene, i);
    pthread_mutex_lock(&q->lock);
    uint64_t before = q->requests;
    if (q->jobs[FIGURES].number == 0 || q->jobs[FIGURES].key != key) { /* otherwise the rocks meet the same */
        ceduo_outlook_free(q->news.outlook);                           /* of what was asked before */
        q->news.outlook = NULL;
        ask(q, FIGURES, &figures);
    }
    if (others.key == 0)
        drop(q, OTHERS);
    else if (q->jobs[OTHERS].number == 0 || q->jobs[OTHERS].key != others.key)
        ask(q, OTHERS, &others);
    if (!years)
        drop(q, YEARS);
    else if (q->jobs[YEARS].number == 0 || q->jobs[YEARS].key != coming.key)
        ask(q, YEARS, &coming);
    bool asked = q->requests != before;
    if (asked)
        drop_years(&q->news);
    pthread_mutex_unlock(&q->lock);
    return asked;
}

bool ceduo_jobs_doubt(struct jobs *q, const struct scene_file *file, size_t levels)
{
    struct job job = {.key = (uint64_t)(uintptr_t)file->root, .levels = levels, .rocks = rocks_before(0), .file = *file};
    job.file.arena = (struct arena){.shelf = file->arena.shelf};
    pthread_mutex_lock(&q->lock);
    struct job *now = &q->jobs[DOUBT];
    uint64_t before = q->requests;
    if (levels == 0) {
        drop(q, DOUBT);
    } else if (now->number == 0 || now->key != job.key) {
        ceduo_doubted_free(q->news.doubted); /* of what was asked before */
        q->news.doubted = NULL;
        ask(q, DOUBT, &job);
    } else if (levels > now->levels) { /* goes on where it is */
        now->levels = levels;
        if (!now->wanted && now->level < levels) {
            now->wanted = true;
            now->number = ++q->requests;
            now->rocks = rocks_before(now->level);
            pthread_cond_broadcast(&q->changed);
        }
    } else {
        now->levels = levels;
    }
    bool asked = q->requests != before;
    pthread_mutex_unlock(&q->lock);
    return asked;
}

/* A fit that is under way, or that nobody has taken; under the lock. */
static void forget_fit(struct jobs *q)
{
    drop(q, FIT);
    ceduo_fit_free(q->news.fit);
    q->news.fit = NULL;
}

static struct job job_of(const struct scene_file *file)
{
    struct job job = {.key = (uint64_t)(uintptr_t)file->root, .rocks = FLIGHTS_FIRST, .file = *file};
    job.file.arena = (struct arena){.shelf = file->arena.shelf};
    return job;
}

bool ceduo_jobs_look(struct jobs *q, const struct scene_file *file, size_t levels)
{
    struct job job = job_of(file);
    job.levels = levels;
    pthread_mutex_lock(&q->lock);
    struct job *now = &q->jobs[LOOK];
    bool asked = levels > 0 && (now->number == 0 || now->key != job.key);
    if (q->jobs[FIT].key != job.key)
        forget_fit(q);
    if (asked) {
        ceduo_sighted_free(q->news.sighted); /* of what was asked before */
        q->news.sighted = NULL;
        ask(q, LOOK, &job);
    } else if (levels == 0) {
        drop(q, LOOK);
    }
    pthread_mutex_unlock(&q->lock);
    return asked;
}

void ceduo_jobs_fit(struct jobs *q, const struct scene_file *file, const struct fit_wish *wish)
{
    struct job job = job_of(file);
    job.wish = *wish;
    pthread_mutex_lock(&q->lock);
    forget_fit(q);
    q->news.fit_state = (struct ceduo_calibration_state){0};
    ask(q, FIT, &job);
    pthread_mutex_unlock(&q->lock);
}

void ceduo_jobs_stop_fit(struct jobs *q)
{
    pthread_mutex_lock(&q->lock);
    forget_fit(q);
    pthread_mutex_unlock(&q->lock);
}

void ceduo_jobs_seek(struct jobs *q, const struct seek *seek)
{
    struct job job = {.seek = *seek, .file = *seek->file};
    snprintf(job.path, sizeof job.path, "%s", seek->search.path);
    job.file.arena = (struct arena){.shelf = seek->file->arena.shelf};
    pthread_mutex_lock(&q->lock);
    ask(q, SEEK, &job);
    pthread_mutex_unlock(&q->lock);
}

void ceduo_jobs_foresee(struct jobs *q, const struct scene_file *file, const char *set, size_t option)
{
    struct job job = {.file = *file, .option = option};
    snprintf(job.path, sizeof job.path, "%s", set);
    job.file.arena = (struct arena){.shelf = file->arena.shelf};
    pthread_mutex_lock(&q->lock);
    q->news.foresaw = false;
    ask(q, FORESEE, &job);
    pthread_mutex_unlock(&q->lock);
}

void ceduo_jobs_stop_seek(struct jobs *q)
{
    pthread_mutex_lock(&q->lock);
    drop(q, SEEK);
    ceduo_sought_free(q->news.sought);
    q->news.sought = NULL;
    pthread_mutex_unlock(&q->lock);
}

/* ---- news ---- */

int ceduo_jobs_fd(const struct jobs *q)
{
    return q->pipe[0];
}

struct jobs_news ceduo_jobs_news(struct jobs *q)
{
    char bytes[64];
    while (read(q->pipe[0], bytes, sizeof bytes) > 0)
        ;
    pthread_mutex_lock(&q->lock);
    q->news.busy = q->working != NONE || next_kind(q) != NONE;
    q->news.fitting = q->jobs[FIT].wanted;
    struct jobs_news news = q->news;
    q->news.outlook = NULL;
    q->news.years = NULL;
    q->news.years_count = 0;
    q->news.others = NULL;
    q->news.doubted = NULL;
    q->news.sighted = NULL;
    q->news.fit = NULL;
    q->news.sought = NULL;
    q->news.foresaw = false;
    pthread_mutex_unlock(&q->lock);
    return news;
}

void ceduo_jobs_wait(struct jobs *q)
{
    pthread_mutex_lock(&q->lock);
    while (q->working != NONE || next_kind(q) != NONE)
        pthread_cond_wait(&q->changed, &q->lock);
    pthread_mutex_unlock(&q->lock);
}

bool ceduo_jobs_wait_seek(struct jobs *q)
{
    pthread_mutex_lock(&q->lock);
    while (q->jobs[SEEK].wanted || q->jobs[FORESEE].wanted)
        pthread_cond_wait(&q->changed, &q->lock);
    bool news = q->news.sought || q->news.foresaw;
    pthread_mutex_unlock(&q->lock);
    return news;
}
