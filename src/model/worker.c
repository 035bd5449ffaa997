/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "worker.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "ceduo/key.h"

struct worker {
    pthread_t thread;
    unsigned threads;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    int pipe[2];
    atomic_bool cancel;
    /* under the lock */
    bool quit, requested, busy, failed, asked_before;
    struct ceduo_scene scene; /* asked for last */
    size_t shown;
    bool wants_years;
    uint64_t key;             /* of its runs */
    struct ceduo_years *years;
    size_t years_option;
    struct ceduo_outlook *outlook;
    uint64_t rocks;
    double asked, seconds;
    /* the thread's own: what is kept from request to request */
    struct flight_plan *plan;
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

/* ---- the runs of a scene ---- */

/* Short runs with envelopes for the pictures, long ones for the figures; and what was last made of them. */
struct flight_plan {
    struct ceduo_scene scene;
    uint64_t scene_key;
    struct ceduo_pool *pictures, *figures, *years;
    double cells[CEDUO_OUTLOOK_CELLS];
    size_t cells_count;
    struct ceduo_outlook *last;
};

static void free_plan(struct flight_plan *plan)
{
    if (!plan)
        return;
    ceduo_outlook_free(plan->last);
    ceduo_pool_free(plan->figures);
    ceduo_pool_free(plan->years);
    ceduo_pool_free(plan->pictures);
    free(plan);
}

static struct flight_plan *new_plan(struct worker *w, const struct ceduo_scene *scene)
{
    struct flight_plan *plan = calloc(1, sizeof *plan);
    if (!plan)
        return NULL;
    plan->scene = *scene;
    plan->scene_key = ceduo_scene_key(scene);
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = w->threads;
    def.rocks_most = WORKER_ROCKS_MOST;
    def.cancel = &w->cancel;
    bool good = ceduo_pool_create(&def, &plan->figures) == CEDUO_OK;
    def.arrivals_only = true;
    good = good && ceduo_pool_create(&def, &plan->years) == CEDUO_OK;
    def.arrivals_only = false;
    plan->cells_count = ceduo_outlook_places(scene, plan->cells);
    def.cells = plan->cells_count;
    def.cell_x = plan->cells;
    if (good && ceduo_pool_create(&def, &plan->pictures) == CEDUO_OK)
        return plan;
    free_plan(plan);
    return NULL;
}

/* The plan for a scene: the last one where only forests have changed. */
static bool prepare_plan(struct worker *w, const struct ceduo_scene *scene)
{
    struct flight_plan *plan = w->plan;
    if (plan && plan->scene_key == ceduo_scene_key(scene)) {
        plan->scene = *scene;
        ceduo_pool_turn(plan->figures, scene);
        ceduo_pool_turn(plan->pictures, scene);
        ceduo_pool_turn(plan->years, scene);
        return true;
    }
    free_plan(plan);
    w->plan = new_plan(w, scene);
    return w->plan != NULL;
}

/* ---- flying ---- */

static bool is_precise(const struct ceduo_sight *s)
{
    for (size_t i = 0; i < s->flown.controls; i++) {
        const struct ceduo_arrivals *a = &s->flown.arrivals[i];
        if (a->reached >= CEDUO_FEW_ROCKS && !(CEDUO_Z95 * a->energy.se <= WORKER_TOLERANCE * a->energy.mean))
            return false;
    }
    return true;
}

static bool precise(const struct ceduo_outlook *o)
{
    bool good = is_precise(o->bare);
    for (size_t i = 0; i < o->options; i++)
        good = good && (!o->wooded[i] || is_precise(o->wooded[i]));
    return good;
}

/* Hands over what is known so far. */
static enum ceduo_status publish(struct worker *w, struct ceduo_outlook **outlook)
{
    struct flight_plan *plan = w->plan;
    struct ceduo_outlook *o, *mine;
    struct ceduo_outlook_def def = {.scene = &plan->scene,
                                    .figures = plan->figures,
                                    .pictures = plan->pictures,
                                    .cells = plan->cells_count,
                                    .cell_x = plan->cells,
                                    .trails = CEDUO_OUTLOOK_TRAILS,
                                    .cancel = &w->cancel,
                                    .last = plan->last};
    enum ceduo_status status = ceduo_outlook_create(&def, &mine);
    if (status != CEDUO_OK)
        return status;
    ceduo_outlook_free(plan->last);
    def.last = plan->last = mine;
    status = ceduo_outlook_create(&def, &o);
    if (status != CEDUO_OK)
        return status;
    pthread_mutex_lock(&w->lock);
    if (w->requested) { /* stale already */
        ceduo_outlook_free(o);
    } else {
        ceduo_outlook_free(w->outlook);
        w->outlook = o;
        w->rocks = o->bare->flown.rocks;
        w->seconds = now() - w->asked;
    }
    pthread_mutex_unlock(&w->lock);
    tell(w);
    *outlook = mine;
    return CEDUO_OK;
}

/* Makes the run of one forest as long as `rocks`. */
static enum ceduo_status fly_forest(struct worker *w, const struct ceduo_option *option, uint64_t rocks)
{
    struct flight_plan *plan = w->plan;
    struct ceduo_pool *pool = rocks <= WORKER_PICTURE_ROCKS ? plan->pictures : plan->figures;
    struct ceduo_run *run, *pictures;
    enum ceduo_status status = ceduo_pool_run(pool, option, &run);
    if (status == CEDUO_OK)
        status = ceduo_pool_run(plan->pictures, option, &pictures);
    if (status != CEDUO_OK)
        return status;
    return ceduo_run_extend(run, rocks);
}

/* The years of the option shown, coarse first. */
static enum ceduo_status fly_years(struct worker *w, size_t shown, const struct ceduo_flown *bare)
{
    struct flight_plan *plan = w->plan;
    unsigned last = ceduo_years_usual(&plan->scene);
    for (uint64_t rocks = WORKER_FIRST_ROCKS; rocks <= WORKER_YEAR_ROCKS; rocks *= 10) {
        struct ceduo_years *years;
        enum ceduo_status status = ceduo_years_create(&plan->scene, &plan->scene.options[shown], 0, last, 1, &years);
        if (status == CEDUO_OK)
            status = ceduo_years_fly(years, plan->years, bare, rocks);
        if (status != CEDUO_OK) {
            ceduo_years_free(years);
            return status;
        }
        pthread_mutex_lock(&w->lock);
        if (w->requested) { /* stale already */
            ceduo_years_free(years);
        } else {
            ceduo_years_free(w->years);
            w->years = years;
            w->years_option = shown;
        }
        pthread_mutex_unlock(&w->lock);
        tell(w);
    }
    return CEDUO_OK;
}

/* Flies one request in steps, each ten times the one before, until it is precise or stale: what is looked at first. */
static enum ceduo_status fly_plan(struct worker *w, size_t shown, bool years)
{
    const struct ceduo_scene *scene = &w->plan->scene;
    bool wooded = scene->simulation.contact_model != CEDUO_INDEX;
    bool enough = false;
    struct ceduo_outlook *o;
    for (uint64_t rocks = WORKER_FIRST_ROCKS; !enough; rocks *= 10) {
        enum ceduo_status status = fly_forest(w, NULL, rocks);
        if (status == CEDUO_OK && wooded)
            status = fly_forest(w, &scene->options[shown], rocks);
        if (status == CEDUO_OK && wooded && scene->options_count > 1) {
            status = publish(w, &o);
            for (size_t i = 0; i < scene->options_count && status == CEDUO_OK; i++)
                status = fly_forest(w, &scene->options[i], rocks);
        }
        if (status == CEDUO_OK)
            status = publish(w, &o);
        if (status != CEDUO_OK)
            return status;
        if (atomic_load(&w->cancel))
            return CEDUO_CANCELLED;
        if (years && rocks == WORKER_FIRST_ROCKS) {
            status = fly_years(w, shown, &o->bare->flown);
            if (status != CEDUO_OK)
                return status;
        }
        enough = rocks * 10 > WORKER_ROCKS_MOST || (rocks >= WORKER_PICTURE_ROCKS && precise(o));
    }
    return CEDUO_OK;
}

static bool fly(struct worker *w, const struct ceduo_scene *scene, size_t shown, bool years)
{
    if (!prepare_plan(w, scene))
        return false;
    enum ceduo_status status = fly_plan(w, shown, years);
    return status == CEDUO_OK || status == CEDUO_CANCELLED;
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
        size_t shown = w->shown;
        bool years = w->wants_years;
        w->requested = false;
        atomic_store(&w->cancel, false);
        pthread_mutex_unlock(&w->lock);
        bool good = fly(w, &scene, shown, years);
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
    free_plan(w->plan);
    ceduo_outlook_free(w->outlook);
    ceduo_years_free(w->years);
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

uint64_t ceduo_worker_key(const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_scene_key(scene);
    for (size_t i = 0; i < scene->options_count; i++)
        key = key * 1099511628211u ^ ceduo_option_key(scene, &scene->options[i]);
    return key * 1099511628211u ^ scene->options_count ^ (uint64_t)scene->simulation.contact_model << 32;
}

uint64_t ceduo_worker_years_key(const struct ceduo_scene *scene, size_t shown)
{
    return ceduo_worker_key(scene) * 1099511628211u ^ ceduo_years_key(&scene->options[shown]) ^ shown;
}

void ceduo_worker_request(struct worker *w, const struct ceduo_scene *scene, size_t shown, bool years)
{
    uint64_t key = years ? ceduo_worker_years_key(scene, shown) : ceduo_worker_key(scene);
    pthread_mutex_lock(&w->lock);
    if (key != w->key || !w->asked_before) { /* otherwise nothing that the rocks meet has changed */
        w->scene = *scene;
        w->shown = shown;
        w->wants_years = years;
        w->key = key;
        w->asked_before = true;
        w->requested = w->busy = true;
        w->failed = false;
        w->asked = now();
        atomic_store(&w->cancel, true);
        ceduo_outlook_free(w->outlook); /* of what was asked before */
        w->outlook = NULL;
        ceduo_years_free(w->years);
        w->years = NULL;
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
                               .years = w->years,
                               .years_option = w->years_option,
                               .busy = w->busy,
                               .rocks = w->rocks,
                               .seconds = w->seconds,
                               .failed = w->failed};
    w->outlook = NULL;
    w->years = NULL;
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
