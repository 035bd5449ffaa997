/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run per different forest of a scene, found by the key of the forest (key.c). The pool owns the runs, and frees runs that
 * its scene no longer needs, least recently used first. */

#include <stdlib.h>

#include "alternative_law.h"
#include "base/oom.h"
#include "check.h"
#include "key.h"
#include "pool.h"
#include "run.h"
#include "statistics.h"

struct pooled {
    uint64_t key;
    uint64_t last_used; /* time of last use */
    bool is_alt_law;    /* only for the other energy law: always needed, and ignored by tolerances */
    bool needed;        /* by the scene; set by free_spare() */
    struct ceduo_run *run;
};

struct ceduo_pool {
    struct ceduo_run_def def;
    struct ceduo_scene scene;
    uint64_t scene_key;
    bool filled;
    size_t count, capacity;
    struct pooled *runs;
    uint64_t reused, last_used;
    struct ceduo_work freed; /* work of freed runs */
};

enum ceduo_status ceduo_pool_create(const struct ceduo_run_def *def, struct ceduo_pool **out)
{
    *out = NULL;
    enum ceduo_status status = ceduo_check_run_def(def);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_pool *pool = calloc(1, sizeof *pool);
    if (!pool)
        return CEDUO_NO_MEMORY;
    pool->def = *def;
    pool->scene = *def->scene;
    pool->def.scene = &pool->scene;
    pool->scene_key = ceduo_scene_key(def->scene);
    *out = pool;
    return CEDUO_OK;
}

void ceduo_pool_free(struct ceduo_pool *pool)
{
    if (!pool)
        return;
    for (size_t i = 0; i < pool->count; i++)
        ceduo_run_free(pool->runs[i].run);
    free(pool->runs);
    free(pool);
}

enum ceduo_status ceduo_pool_reuse_or_create(const struct ceduo_run_def *def, struct ceduo_pool **pool)
{
    if (*pool && (*pool)->scene_key == ceduo_scene_key(def->scene)) {
        ceduo_pool_set_scene(*pool, def->scene);
        return CEDUO_OK;
    }
    ceduo_pool_free(*pool);
    return ceduo_pool_create(def, pool);
}

/* Add a run; the option of `def` is ignored. */
static enum ceduo_status add_run(struct ceduo_pool *pool, struct ceduo_run_def def, const struct ceduo_option *option,
                                 uint64_t key, struct ceduo_run **run)
{
    struct pooled *runs = ceduo_grow(pool->runs, pool->count, &pool->capacity, sizeof *runs);
    if (!runs)
        return CEDUO_NO_MEMORY;
    pool->runs = runs;
    def.option = key != 0 ? option : NULL;
    enum ceduo_status status = ceduo_run_create(&def, run);
    if (status == CEDUO_OK)
        pool->runs[pool->count++] = (struct pooled){.key = key, .last_used = ++pool->last_used, .run = *run};
    return status;
}

static struct pooled *find_run(const struct ceduo_pool *pool, uint64_t key)
{
    for (size_t i = 0; i < pool->count; i++)
        if (pool->runs[i].key == key)
            return &pool->runs[i];
    return NULL;
}

struct ceduo_run *ceduo_pool_find(const struct ceduo_pool *pool, const struct ceduo_option *option)
{
    const struct pooled *p = find_run(pool, ceduo_option_key(&pool->scene, option));
    return p ? p->run : NULL;
}

enum ceduo_status ceduo_pool_run(struct ceduo_pool *pool, const struct ceduo_option *option, struct ceduo_run **run)
{
    uint64_t key = ceduo_option_key(&pool->scene, option);
    struct pooled *p = find_run(pool, key);
    if (!p)
        return add_run(pool, pool->def, option, key, run);
    p->last_used = ++pool->last_used;
    pool->reused++;
    *run = p->run;
    return CEDUO_OK;
}

enum ceduo_status ceduo_pool_simulate(struct ceduo_pool *pool, const struct ceduo_option *option, uint64_t rocks,
                                      struct ceduo_run **run)
{
    enum ceduo_status status = ceduo_pool_run(pool, option, run);
    return status == CEDUO_OK ? ceduo_run_extend(*run, rocks) : status;
}

static void add_work(struct ceduo_work *work, const struct ceduo_run *run)
{
    struct ceduo_stem_counts stems = ceduo_run_stems(run);
    work->rocks += ceduo_run_rocks(run);
    work->contacts += ceduo_run_contacts(run);
    work->stems.drawn += stems.drawn;
    work->stems.hit += stems.hit;
    work->stems.met += stems.met;
}

/* Free runs that the scene does not need, least recently used first, while there are more than `spare_max` of them and all
 * samples have at least `bytes_max` bytes. */
static void free_spare(struct ceduo_pool *pool, size_t spare_max, size_t bytes_max)
{
    size_t spare = pool->count, bytes = 0;
    for (size_t i = 0; i < pool->count; i++) {
        struct pooled *p = &pool->runs[i];
        p->needed = p->is_alt_law || p->key == 0;
        bytes += ceduo_run_sample_bytes(p->run);
    }
    for (size_t i = 0; i < pool->scene.options_count; i++) {
        struct pooled *p = find_run(pool, ceduo_option_key(&pool->scene, &pool->scene.options[i]));
        if (p)
            p->needed = true;
    }
    for (size_t i = 0; i < pool->count; i++)
        spare -= pool->runs[i].needed;
    for (; spare > spare_max && bytes >= bytes_max; spare--) {
        struct pooled *oldest = pool->runs;
        for (struct pooled *p = pool->runs; p < pool->runs + pool->count; p++)
            if (!p->needed && (oldest->needed || p->last_used < oldest->last_used))
                oldest = p;
        bytes -= ceduo_run_sample_bytes(oldest->run);
        add_work(&pool->freed, oldest->run);
        pool->freed.runs++;
        ceduo_run_free(oldest->run);
        *oldest = pool->runs[--pool->count];
    }
}

void ceduo_pool_set_scene(struct ceduo_pool *pool, const struct ceduo_scene *scene)
{
    pool->scene = *scene;
    for (size_t i = 0; i < scene->options_count && scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX; i++)
        pool->filled &= ceduo_pool_find(pool, &scene->options[i]) != NULL;
    free_spare(pool, CEDUO_POOL_SPARE, 0);
}

void ceduo_pool_trim(struct ceduo_pool *pool)
{
    free_spare(pool, 0, CEDUO_POOL_BYTES + 1);
}

enum ceduo_status ceduo_pool_fill(struct ceduo_pool *pool)
{
    size_t n = pool->scene.options_count;
    bool wooded = pool->scene.simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    enum ceduo_status status = CEDUO_OK;
    struct ceduo_run *run;
    for (size_t i = 0; i < n && status == CEDUO_OK && !pool->filled; i++) {
        status = ceduo_pool_run(pool, NULL, &run);
        if (status == CEDUO_OK && wooded)
            status = ceduo_pool_run(pool, &pool->scene.options[i], &run);
    }
    /* under the other law only arrivals are needed */
    struct ceduo_run_def def = pool->def;
    def.arrivals_only = true;
    def.rocks_max = def.rocks_max > CEDUO_ALT_LAW_ROCKS ? CEDUO_ALT_LAW_ROCKS : def.rocks_max;
    struct ceduo_scene alt_scene = {0};
    if (status == CEDUO_OK && !pool->filled && wooded && def.alternative_energy)
        status = ceduo_alternative_scene(&pool->scene, &alt_scene) ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; status == CEDUO_OK && i < alt_scene.options_count; i++) {
        uint64_t key = ceduo_option_key(&pool->scene, &alt_scene.options[i]);
        if (key == 0 || find_run(pool, key))
            continue;
        status = add_run(pool, def, &alt_scene.options[i], key, &run);
        if (status == CEDUO_OK)
            pool->runs[pool->count - 1].is_alt_law = true;
    }
    ceduo_alternative_scene_release(&alt_scene);
    pool->filled = status == CEDUO_OK;
    return status;
}

enum ceduo_status ceduo_pool_extend(struct ceduo_pool *pool, uint64_t rocks)
{
    enum ceduo_status status = CEDUO_OK;
    for (size_t i = 0; i < pool->count && status == CEDUO_OK; i++)
        status = ceduo_run_extend(pool->runs[i].run, rocks);
    return status;
}

bool ceduo_mean_is_precise(uint64_t reached, struct ceduo_estimate mean, double tolerance)
{
    return reached < CEDUO_ARRIVALS_MIN || CEDUO_Z95 * mean.se <= tolerance * mean.mean;
}

/* The numbers of rocks are fixed and close to each other, so that few rocks are wasted. */
enum ceduo_status ceduo_pool_run_to_tolerance(struct ceduo_pool *pool, double tolerance, uint64_t max, bool *met)
{
    *met = false;
    for (uint64_t rocks = CEDUO_BATCH_ROCKS; !*met; rocks += rocks / 8) {
        enum ceduo_status status = ceduo_pool_extend(pool, rocks < max ? rocks : max);
        if (status != CEDUO_OK)
            return status;
        *met = true;
        for (size_t i = 0; i < pool->count; i++)
            for (size_t c = 0; c < pool->scene.controls_count && *met && !pool->runs[i].is_alt_law; c++) {
                uint64_t reached;
                struct ceduo_estimate mean = ceduo_run_energy(pool->runs[i].run, c, &reached);
                *met = ceduo_mean_is_precise(reached, mean, tolerance);
            }
        if (rocks >= max)
            break;
    }
    return CEDUO_OK;
}

struct ceduo_work ceduo_pool_work(const struct ceduo_pool *pool)
{
    struct ceduo_work work = pool->freed;
    work.runs += pool->count;
    work.reused = pool->reused;
    for (size_t i = 0; i < pool->count; i++)
        add_work(&work, pool->runs[i].run);
    return work;
}
