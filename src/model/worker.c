/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "worker.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "ceduo/result.h"
#include "run_key.h"

struct worker {
    pthread_t thread;
    unsigned threads;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int pipe[2];
    atomic_bool cancel;
    /* under the lock */
    bool quit, requested, busy, failed;
    struct ceduo_scene scene; /* asked for last */
    uint64_t key;             /* of its run */
    struct ceduo_outlook *outlook;
    uint64_t rocks, runs, rocks_flown;
    double asked, seconds;
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void tell(struct worker *w)
{
    char byte = 0;
    if (write(w->pipe[1], &byte, 1) < 0)
        return; /* full: news is waiting to be read anyway */
}

static bool precise(const struct ceduo_outlook *o)
{
    if (o->rocks < WORKER_PICTURE_ROCKS) /* a chance is never known from so few */
        return false;
    for (size_t i = 0; i < o->controls; i++) {
        const struct ceduo_arrivals *a = &o->arrivals[i];
        if (a->reached >= CEDUO_FEW_ROCKS && !(CEDUO_Z95 * a->energy.se <= WORKER_TOLERANCE * a->energy.mean))
            return false;
    }
    return true;
}

/* The runs of one request: a short one with envelopes for the pictures, a long one for the figures. */
struct flight_plan {
    const struct ceduo_scene *scene;
    struct ceduo_run *pictures, *figures;
    double cells[CEDUO_OUTLOOK_CELLS];
    size_t cells_count;
};

/* Hands over what is known so far. */
static bool publish(struct worker *w, const struct flight_plan *plan, const struct ceduo_run *run, bool *enough)
{
    struct ceduo_outlook *o;
    if (ceduo_outlook_create(plan->scene, run, plan->pictures, plan->cells_count, plan->cells, CEDUO_OUTLOOK_TRAILS,
                             &o) != CEDUO_OK)
        return false;
    *enough = precise(o);
    pthread_mutex_lock(&w->lock);
    if (w->requested) { /* stale already */
        ceduo_outlook_free(o);
    } else {
        ceduo_outlook_free(w->outlook);
        w->outlook = o;
        w->rocks = o->rocks;
        w->seconds = now() - w->asked;
    }
    pthread_mutex_unlock(&w->lock);
    tell(w);
    return true;
}

static void count_rocks(struct worker *w, uint64_t rocks)
{
    pthread_mutex_lock(&w->lock);
    w->rocks_flown += rocks;
    pthread_mutex_unlock(&w->lock);
}

/* Flies one request in steps, each ten times the one before, until it is precise or stale. */
static bool fly_plan(struct worker *w, struct flight_plan *plan)
{
    bool enough = false;
    for (uint64_t rocks = WORKER_FIRST_ROCKS; !enough && !atomic_load(&w->cancel); rocks *= 10) {
        struct ceduo_run *run = rocks <= WORKER_PICTURE_ROCKS ? plan->pictures : plan->figures;
        uint64_t before = ceduo_run_rocks(run);
        enum ceduo_status status = ceduo_run_extend(run, rocks);
        count_rocks(w, ceduo_run_rocks(run) - before);
        if (status == CEDUO_CANCELLED)
            return true;
        if (status != CEDUO_OK || !publish(w, plan, run, &enough))
            return false;
        enough |= rocks * 10 > WORKER_ROCKS_MOST;
    }
    return true;
}

static bool fly(struct worker *w, const struct ceduo_scene *scene)
{
    struct flight_plan plan = {.scene = scene};
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = w->threads;
    def.rocks_most = WORKER_ROCKS_MOST;
    def.cancel = &w->cancel;
    bool good = ceduo_run_create(&def, &plan.figures) == CEDUO_OK;
    plan.cells_count = ceduo_outlook_places(scene, plan.cells);
    def.cells = plan.cells_count;
    def.cell_x = plan.cells;
    good = good && ceduo_run_create(&def, &plan.pictures) == CEDUO_OK && fly_plan(w, &plan);
    ceduo_run_free(plan.figures);
    ceduo_run_free(plan.pictures);
    return good;
}

static void *work(void *argument)
{
    struct worker *w = argument;
    pthread_mutex_lock(&w->lock);
    for (;;) {
        while (!w->quit && !w->requested) {
            w->busy = false;
            pthread_cond_broadcast(&w->changed);
            tell(w);
            pthread_cond_wait(&w->changed, &w->lock);
        }
        if (w->quit)
            break;
        struct ceduo_scene scene = w->scene;
        w->requested = false;
        w->runs++;
        atomic_store(&w->cancel, false);
        pthread_mutex_unlock(&w->lock);
        bool good = fly(w, &scene);
        pthread_mutex_lock(&w->lock);
        w->failed |= !good;
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

struct worker *ceduo_worker_create(unsigned threads)
{
    struct worker *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->threads = threads;
    if (pipe2(w->pipe, O_NONBLOCK | O_CLOEXEC) != 0) {
        free(w);
        return NULL;
    }
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    if (pthread_create(&w->thread, NULL, work, w) != 0) {
        close(w->pipe[0]);
        close(w->pipe[1]);
        free(w);
        return NULL;
    }
    return w;
}

void ceduo_worker_free(struct worker *w)
{
    if (!w)
        return;
    pthread_mutex_lock(&w->lock);
    w->quit = true;
    atomic_store(&w->cancel, true);
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
    pthread_join(w->thread, NULL);
    ceduo_outlook_free(w->outlook);
    pthread_mutex_destroy(&w->lock);
    pthread_cond_destroy(&w->changed);
    close(w->pipe[0]);
    close(w->pipe[1]);
    free(w);
}

unsigned ceduo_worker_threads(const struct worker *w)
{
    return w->threads;
}

void ceduo_worker_request(struct worker *w, const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_run_key(scene);
    pthread_mutex_lock(&w->lock);
    if (key != w->key || w->runs == 0) { /* otherwise nothing that the rocks meet has changed */
        w->scene = *scene;
        w->key = key;
        w->requested = w->busy = true;
        w->failed = false;
        w->asked = now();
        atomic_store(&w->cancel, true);
        ceduo_outlook_free(w->outlook); /* of what was asked before */
        w->outlook = NULL;
        pthread_cond_broadcast(&w->changed);
    }
    pthread_mutex_unlock(&w->lock);
}

int ceduo_worker_fd(const struct worker *w)
{
    return w->pipe[0];
}

struct worker_news ceduo_worker_news(struct worker *w)
{
    char bytes[64];
    while (read(w->pipe[0], bytes, sizeof bytes) > 0)
        ;
    pthread_mutex_lock(&w->lock);
    struct worker_news news = {.outlook = w->outlook,
                               .key = w->key,
                               .busy = w->busy,
                               .rocks = w->rocks,
                               .seconds = w->seconds,
                               .failed = w->failed};
    w->outlook = NULL;
    pthread_mutex_unlock(&w->lock);
    return news;
}

void ceduo_worker_wait(struct worker *w)
{
    pthread_mutex_lock(&w->lock);
    while (w->busy)
        pthread_cond_wait(&w->changed, &w->lock);
    pthread_mutex_unlock(&w->lock);
}

void ceduo_worker_counts(struct worker *w, uint64_t *runs, uint64_t *rocks)
{
    pthread_mutex_lock(&w->lock);
    *runs = w->runs;
    *rocks = w->rocks_flown;
    pthread_mutex_unlock(&w->lock);
}
