/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "base/clock.h"
#include "check.h"
#include "core/forest/kernel.h"
#include "core/walk/walk.h"
#include "run.h"
#include "run_state.h"
#include "scene/derived.h"

#define CHUNK_SECONDS 0.5 /* target duration of a chunk, so that progress is reported regularly */

struct ceduo_run_def ceduo_run_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_run_def){.scene = scene, .threads = 1, .rocks_max = scene->simulation.rocks};
}

enum ceduo_status ceduo_run_extend(struct ceduo_run *run, uint64_t rocks)
{
    if (rocks > run->def.rocks_max)
        rocks = run->def.rocks_max;
    if (rocks <= run->rocks)
        return CEDUO_OK;
    if (!ceduo_run_samples_reserve(run, rocks))
        return CEDUO_NO_MEMORY;
    while (run->rocks < rocks) {
        uint64_t batch = run->rocks / CEDUO_BATCH_ROCKS, end = (batch + run->chunk) * CEDUO_BATCH_ROCKS;
        double start = ceduo_clock();
        enum ceduo_status status = ceduo_run_simulate_chunk(run, end < rocks ? end : rocks);
        if (status != CEDUO_OK)
            return status;
        /* The next chunk is to take CHUNK_SECONDS at the speed of this one. It has at most twice as many batches, and a
         * multiple of the number of threads, so that threads do not wait at its end. Results do not depend on it. */
        size_t batches = (size_t)(run->rocks / CEDUO_BATCH_ROCKS - batch), threads = run->def.threads, max = 2 * run->chunk;
        double seconds = ceduo_clock() - start;
        double target = seconds > 0 ? (double)batches * CHUNK_SECONDS / seconds : (double)max; /* untaken: system */
        size_t next = target < (double)max ? (size_t)target : max;
        next = (next + threads - 1) / threads * threads;
        next = next < threads ? threads : next;
        run->chunk = next > CHUNK_BATCHES ? CHUNK_BATCHES : next;
        if (run->def.progress)
            run->def.progress(run->def.context, run->rocks);
    }
    return CEDUO_OK;
}

/* ---- making and freeing ---- */

enum ceduo_status ceduo_run_create(const struct ceduo_run_def *def, struct ceduo_run **out)
{
    *out = NULL;
    enum ceduo_status status = ceduo_check_run_def(def);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_run *run = calloc(1, sizeof *run);
    if (!run)
        return CEDUO_NO_MEMORY;
    run->def = *def;
    run->def.threads = def->threads > 0 ? def->threads : 1;
    run->controls = def->scene->controls_count;
    run->stems_from = def->option ? ceduo_option_forest_begin(def->option) : INFINITY;
    run->weighted = def->scene->blocks_count > 0;
    bool one_energy = def->scene->simulation.law == CEDUO_LAW_LUMPED && !ceduo_scene_rock_varies(def->scene);
    run->quantities = one_energy ? ENERGY + 1 : QUANTITIES;
    run->columns = run->controls * (size_t)run->quantities + 1;
    uint64_t batches = run->def.rocks_max / CEDUO_BATCH_ROCKS + 1;
    run->slots_count = batches < CHUNK_BATCHES ? (size_t)batches : CHUNK_BATCHES;
    run->chunk = run->def.threads < CHUNK_BATCHES ? run->def.threads : CHUNK_BATCHES;
    run->walk_lanes = ceduo_kernel(def->kernel)->walk;
    run->lanes = run->walk_lanes ? LANES : 1;
    run->slots = calloc(run->slots_count, sizeof *run->slots);
    bool good =
        run->slots && ceduo_run_batch_init(&run->complete, run->controls) && ceduo_run_batch_init(&run->tail, run->controls);
    for (size_t i = 0; good && i < run->slots_count; i++)
        good = ceduo_run_batch_init(&run->slots[i], run->controls);
    good = good && ceduo_prepared_init(&run->prepared, def->scene, def->option) == CEDUO_OK;
    run->lanes_ground = good && run->walk_lanes ? ceduo_lanes_ground_create(&run->prepared.ground) : NULL;
    if (!good || (run->walk_lanes && !run->lanes_ground)) {
        ceduo_run_free(run);
        return CEDUO_NO_MEMORY;
    }
    run->identical = run->prepared.forest.bare && ceduo_walk_is_identical(&run->prepared);
    *out = run;
    return status;
}

void ceduo_run_free(struct ceduo_run *run)
{
    if (!run)
        return;
    free(run->complete.controls);
    free(run->tail.controls);
    for (size_t i = 0; run->slots && i < run->slots_count; i++)
        free(run->slots[i].controls);
    free(run->slots);
    ceduo_run_samples_free(run);
    free(run->lanes_ground);
    ceduo_prepared_release(&run->prepared);
    free(run);
}

/* ---- reading ---- */

uint64_t ceduo_run_rocks(const struct ceduo_run *run)
{
    return run->rocks;
}

size_t ceduo_run_sample_bytes(const struct ceduo_run *run)
{
    return (size_t)run->capacity * run->columns * sizeof(double);
}

uint64_t ceduo_run_contacts(const struct ceduo_run *run)
{
    return run->complete.contacts + run->tail.contacts;
}

struct ceduo_stem_counts ceduo_run_stems(const struct ceduo_run *run)
{
    const struct ceduo_stem_counts *a = &run->complete.stems, *b = &run->tail.stems;
    return (struct ceduo_stem_counts){a->drawn + b->drawn, a->hit + b->hit, a->met + b->met};
}
