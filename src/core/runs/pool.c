/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One run for each different forest of a scene. Runs are found by the key of their forest (key.c); the pool owns them, and
 * drops those that its scene no longer needs, the one asked for longest ago first. */
#include "ceduo/pool.h"

#include <stdlib.h>

#include "base/must.h"
#include "ceduo/key.h"
#include "ceduo/other.h"
#include "check.h"

struct pooled {
    uint64_t key;
    uint64_t asked; /* when it was asked for last */
    bool beside;    /* of the other energy law alone: it goes with the scene, and no tolerance waits for it */
    bool needed;    /* by the scene, as drop_spare() found */
    struct ceduo_run *run;
};

struct ceduo_pool {
    struct ceduo_run_def def;
    struct ceduo_scene scene;
    uint64_t scene_key;
    bool filled;
    size_t count, room;
    struct pooled *runs;
    uint64_t reused, asked;
    struct ceduo_work dropped; /* what the runs did that are freed */
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

/* `def` without its option. */
static enum ceduo_status add_run(struct ceduo_pool *pool, struct ceduo_run_def def, const struct ceduo_option *option,
                                 uint64_t key, struct ceduo_run **run)
{
    struct pooled *runs = ceduo_grow(pool->runs, pool->count, &pool->room, sizeof *runs);
    if (!runs)
        return CEDUO_NO_MEMORY;
    pool->runs = runs;
    def.option = key != 0 ? option : NULL;
    enum ceduo_status status = ceduo_run_create(&def, run);
    if (status == CEDUO_OK)
        pool->runs[pool->count++] = (struct pooled){.key = key, .asked = ++pool->asked, .run = *run};
    return status;
}

static struct pooled *find(const struct ceduo_pool *pool, uint64_t key)
{
    for (size_t i = 0; i < pool->count; i++)
        if (pool->runs[i].key == key)
            return &pool->runs[i];
    return NULL;
}

struct ceduo_run *ceduo_pool_find(const struct ceduo_pool *pool, const struct ceduo_option *option)
{
    const struct pooled *p = find(pool, ceduo_option_key(&pool->scene, option));
    return p ? p->run : NULL;
}

enum ceduo_status ceduo_pool_run(struct ceduo_pool *pool, const struct ceduo_option *option, struct ceduo_run **run)
{
    uint64_t key = ceduo_option_key(&pool->scene, option);
    struct pooled *p = find(pool, key);
    if (!p)
        return add_run(pool, pool->def, option, key, run);
    p->asked = ++pool->asked;
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

/* Frees runs that the scene does not need, the one asked for longest ago first, while there are more than `most` of them and
 * the samples of all have `bytes_most` or more. */
static void drop_spare(struct ceduo_pool *pool, size_t most, size_t bytes_most)
{
    size_t spare = pool->count, bytes = 0;
    for (size_t i = 0; i < pool->count; i++) {
        struct pooled *p = &pool->runs[i];
        p->needed = p->beside || p->key == 0;
        bytes += ceduo_run_sample_bytes(p->run);
    }
    for (size_t i = 0; i < pool->scene.options_count; i++) {
        struct pooled *p = find(pool, ceduo_option_key(&pool->scene, &pool->scene.options[i]));
        if (p)
            p->needed = true;
    }
    for (size_t i = 0; i < pool->count; i++)
        spare -= pool->runs[i].needed;
    for (; spare > most && bytes >= bytes_most; spare--) {
        struct pooled *oldest = pool->runs;
        for (struct pooled *p = pool->runs; p < pool->runs + pool->count; p++)
            if (!p->needed && (oldest->needed || p->asked < oldest->asked))
                oldest = p;
        bytes -= ceduo_run_sample_bytes(oldest->run);
        add_work(&pool->dropped, oldest->run);
        pool->dropped.runs++;
        ceduo_run_free(oldest->run);
        *oldest = pool->runs[--pool->count];
    }
}

void ceduo_pool_set_scene(struct ceduo_pool *pool, const struct ceduo_scene *scene)
{
    pool->scene = *scene;
    for (size_t i = 0; i < scene->options_count && scene->simulation.contact_model != CEDUO_INDEX; i++)
        pool->filled &= ceduo_pool_find(pool, &scene->options[i]) != NULL;
    drop_spare(pool, CEDUO_POOL_SPARE, 0);
}

void ceduo_pool_trim(struct ceduo_pool *pool)
{
    drop_spare(pool, 0, CEDUO_POOL_BYTES + 1);
}

enum ceduo_status ceduo_pool_fill(struct ceduo_pool *pool)
{
    size_t n = pool->scene.options_count;
    bool wooded = pool->scene.simulation.contact_model != CEDUO_INDEX;
    enum ceduo_status status = CEDUO_OK;
    struct ceduo_run *run;
    for (size_t i = 0; i < n && status == CEDUO_OK && !pool->filled; i++) {
        status = ceduo_pool_run(pool, NULL, &run);
        if (status == CEDUO_OK && wooded)
            status = ceduo_pool_run(pool, &pool->scene.options[i], &run);
    }
    /* of the other law arrivals are asked for alone */
    struct ceduo_run_def def = pool->def;
    def.arrivals_only = true;
    def.rocks_most = def.rocks_most > CEDUO_OTHER_ROCKS ? CEDUO_OTHER_ROCKS : def.rocks_most;
    struct ceduo_scene other = {0};
    if (status == CEDUO_OK && !pool->filled && wooded && def.other_energy)
        status = ceduo_alternative_scene(&pool->scene, &other) ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; status == CEDUO_OK && i < other.options_count; i++) {
        uint64_t key = ceduo_option_key(&pool->scene, &other.options[i]);
        if (key == 0 || find(pool, key))
            continue;
        status = add_run(pool, def, &other.options[i], key, &run);
        if (status == CEDUO_OK)
            pool->runs[pool->count - 1].beside = true;
    }
    ceduo_alternative_scene_release(&other);
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

/* The counts are fixed, and near to each other: few rocks are simulated in vain. */
enum ceduo_status ceduo_pool_run_to_tolerance(struct ceduo_pool *pool, double tolerance, uint64_t max, bool *met)
{
    *met = false;
    for (uint64_t rocks = CEDUO_BATCH_ROCKS; !*met; rocks += rocks / 8) {
        enum ceduo_status status = ceduo_pool_extend(pool, rocks < max ? rocks : max);
        if (status != CEDUO_OK)
            return status;
        *met = true;
        for (size_t i = 0; i < pool->count; i++)
            for (size_t c = 0; c < pool->scene.controls_count && *met && !pool->runs[i].beside; c++) {
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
    struct ceduo_work work = pool->dropped;
    work.runs += pool->count;
    work.reused = pool->reused;
    for (size_t i = 0; i < pool->count; i++)
        add_work(&work, pool->runs[i].run);
    return work;
}
