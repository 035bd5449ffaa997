/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One chunk of a run, on several threads. Workers take batches of CEDUO_BATCH_ROCKS from a common counter. Each worker owns its
 * walkers and stems, and writes the samples of its rocks into the columns of the run, at disjoint places. A batch is summed in
 * the order of its rocks, and batches are merged in order, so that the result does not depend on threads. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "core/walk/walk.h"
#include "run_state.h"

/* Arrival of a rock at a control; all 0 if it does not arrive. */
struct arrival {
    double values[QUANTITIES], stems_hit;
    bool arrives, exceeds; /* exceeds: above the accepted energy */
};

/* Work of one thread on a chunk. The rocks of a batch may end in any order: their arrivals are stored, and summed at the
 * end. */
struct worker {
    struct ceduo_run *run;
    struct walker *walkers; /* one per lane, with its stems, unless the chunk has fewer rocks than lanes */
    struct walker first;    /* a rock at its release, the template if all rocks are identical */
    struct batch *batch;
    uint64_t from, next, to;               /* rocks of the batch: first, next to release, one past the last */
    struct arrival *arrivals;              /* [control][CEDUO_BATCH_ROCKS] */
    double stops[CEDUO_BATCH_ROCKS];       /* m; NaN: did not stop */
    unsigned char ends[CEDUO_BATCH_ROCKS]; /* enum ceduo_end; used if rocks have weights */
    bool no_memory;
    struct chunk *chunk;
};

struct chunk {
    uint64_t first, end; /* rocks */
    size_t batches;
    atomic_bool stop;
    struct worker *workers;
};

/* ---- one rock ---- */

static void on_cross(void *context, const struct walker *walker, size_t mark, const struct ceduo_crossing *c)
{
    struct worker *w = context;
    const struct ceduo_rock *rock = &walker->rock;
    size_t control = w->run->prepared.marks.items[mark].control;
    double speed = sqrt(c->vx * c->vx + c->vz * c->vz);
    double translation = 0.5 * rock->mass * (speed * speed);
    double energy = translation + 0.5 * rock->moment * (c->spin * c->spin);
    bool exceeds = energy > w->run->prepared.scene.controls[control].accepted; /* false for NaN */
    w->arrivals[control * CEDUO_BATCH_ROCKS + (walker->number - w->from)] =
        (struct arrival){.values = {[SPEED] = speed, [HEIGHT] = c->height, [ENERGY] = energy, [TRANSLATION] = translation},
                         .stems_hit = (double)c->stems_hit,
                         .arrives = true,
                         .exceeds = exceeds};
}

static void on_end(void *context, size_t lane, enum ceduo_end end)
{
    struct worker *w = context;
    const struct walker *walker = &w->walkers[lane];
    if (walker->stems) {
        w->no_memory |= walker->stems->no_memory;
        w->batch->stems.drawn += walker->stems->drawn;
        w->batch->stems.hit += walker->stems_hit;
        w->batch->stems.met += walker->stools_met;
    }
    w->batch->contacts += walker->contacts;
    w->batch->ends[end]++;
    w->batch->uphill += end == CEDUO_END_LEFT_SLOPE && !(walker->flight.x > 0);
    w->batch->early += end == CEDUO_END_STOPPED_BY_STEMS && walker->flight.x < walker->release->x.mean + CEDUO_EARLY_M;
    w->ends[walker->number - w->from] = (unsigned char)end;
    const struct marks *marks = &w->run->prepared.marks;
    for (size_t m = walker->next_mark; m < marks->n; m++) /* count the end at each control that the rock did not reach */
        w->batch->controls[marks->items[m].control].end_counts[end]++;
    if (end == CEDUO_END_AT_REST || end == CEDUO_END_STOPPED_BY_STEMS)
        w->stops[walker->number - w->from] = walker->flight.x;
    if (walker->cancelled)
        atomic_store(&w->chunk->stop, true);
}

/* ---- many rocks ---- */

/* Release the next rock of the batch; false if none is left. */
static bool next_rock(void *context, size_t lane)
{
    struct worker *w = context;
    struct ceduo_run *run = w->run;
    struct walker *walker = &w->walkers[lane];
    while (w->next < w->to) {
        if (ceduo_cancelled(run->def.cancel) || w->no_memory)
            atomic_store(&w->chunk->stop, true);
        if (atomic_load_explicit(&w->chunk->stop, memory_order_relaxed))
            break;
        uint64_t number = w->next++;
        bool again = run->identical && walker->g;
        if (again)
            ceduo_walk_release_identical(walker, &w->first, number);
        bool drawn = again || ceduo_walk_release(walker, &run->prepared, number) == CEDUO_OK;
        if (run->identical && !again)
            w->first = *walker;
        if (!drawn) { /* no trajectory: unfinished before every control */
            w->batch->ends[CEDUO_END_UNFINISHED]++;
            for (size_t c = 0; c < run->controls; c++)
                w->batch->controls[c].end_counts[CEDUO_END_UNFINISHED]++;
            continue;
        }
        return true;
    }
    return false;
}

/* Sum the arrivals at a control, in the order of the rocks, and store samples. */
static void sum_arrivals(struct worker *w, size_t control)
{
    struct ceduo_run *run = w->run;
    const struct arrival *arrivals = &w->arrivals[control * CEDUO_BATCH_ROCKS];
    struct sums *to = &w->batch->controls[control];
    size_t n = (size_t)(w->to - w->from), from = (size_t)w->from;
    bool spins = run->quantities == QUANTITIES; /* otherwise all energy is translational */
    for (size_t i = 0; i < n; i++) {
        if (!arrivals[i].arrives)
            continue;
        for (int q = 0; q < (spins ? QUANTITIES : TRANSLATION); q++)
            ceduo_moments_add(&to->moments[q], arrivals[i].values[q]);
        if (!run->prepared.forest.bare)
            ceduo_moments_add(&to->contacts, arrivals[i].stems_hit);
        to->exceeded += arrivals[i].exceeds;
    }
    if (!spins)
        to->moments[TRANSLATION] = to->moments[ENERGY];
    for (int q = 0; q < run->quantities; q++) {
        double *column = get_samples(run, control, q) + from;
        for (size_t i = 0; i < n; i++)
            column[i] = arrivals[i].arrives ? arrivals[i].values[q] : NAN;
    }
}

static void sum_batch(struct worker *w)
{
    struct ceduo_run *run = w->run;
    size_t n = (size_t)(w->to - w->from);
    for (size_t i = 0; run->weighted && i < n; i++) { /* weights per end */
        double weight = run->weights[w->from + i];
        w->batch->end_weights[w->ends[i]] += weight;
        for (size_t c = 0; c < run->controls; c++) {
            const struct arrival *a = &w->arrivals[c * CEDUO_BATCH_ROCKS + i];
            if (a->arrives)
                weighted_sum_add(&w->batch->controls[c].hits, weight, a->stems_hit);
            else
                w->batch->controls[c].end_weights[w->ends[i]] += weight;
        }
    }
    memcpy(get_stops(run) + w->from, w->stops, n * sizeof *w->stops);
    for (size_t c = 0; c < run->controls; c++)
        sum_arrivals(w, c);
    for (size_t i = 0; i < n; i++)
        if (!isnan(w->stops[i]))
            ceduo_moments_add(&w->batch->stop_x, w->stops[i]);
}

/* Simulate the rocks of a batch that belong to the chunk. */
static int simulate_batch(void *context, size_t i, size_t worker)
{
    struct chunk *chunk = context;
    struct worker *w = &chunk->workers[worker];
    struct ceduo_run *run = w->run;
    enum ceduo_law law = run->prepared.scene.simulation.law;
    uint64_t from = (chunk->first / CEDUO_BATCH_ROCKS + i) * CEDUO_BATCH_ROCKS, to = from + CEDUO_BATCH_ROCKS;
    w->from = w->next = from < chunk->first ? chunk->first : from;
    w->to = to > chunk->end ? chunk->end : to;
    w->batch = &run->slots[i];
    for (size_t c = 0; c < run->controls; c++)
        memset(&w->arrivals[c * CEDUO_BATCH_ROCKS], 0, (size_t)(w->to - w->from) * sizeof *w->arrivals);
    memset(w->ends, CEDUO_END_UNFINISHED, sizeof w->ends);
    for (size_t k = 0; k < CEDUO_BATCH_ROCKS; k++)
        w->stops[k] = NAN;
    const struct lanes_job job = {.ground = run->lanes_ground,
                                  .law = law,
                                  .identical = run->identical,
                                  .walkers = w->walkers,
                                  .next = next_rock,
                                  .ended = on_end,
                                  .context = w};
    if (run->walk_lanes)
        run->walk_lanes(&job);
    else
        while (next_rock(w, 0))
            on_end(w, 0, ceduo_walk(&w->walkers[0], law));
    if (atomic_load_explicit(&chunk->stop, memory_order_relaxed))
        return CEDUO_CANCELLED;
    sum_batch(w);
    return CEDUO_OK;
}

/* ---- threads ---- */

static bool worker_init(struct worker *w, struct ceduo_run *run, struct chunk *chunk)
{
    *w = (struct worker){.run = run, .chunk = chunk};
    w->walkers = calloc(run->lanes, sizeof *w->walkers);
    w->arrivals = malloc((run->controls + 1) * CEDUO_BATCH_ROCKS * sizeof *w->arrivals);
    if (!w->walkers || !w->arrivals)
        return false;
    for (size_t i = 0; i < run->lanes; i++)
        w->walkers[i] = (struct walker){
            .cross = on_cross, .context = w, .arrivals_only = run->def.arrivals_only, .cancel = run->def.cancel};
    uint64_t rocks = run->prepared.forest.bare ? 0 : chunk->end - chunk->first;
    for (size_t i = 0; i < run->lanes && i < rocks; i++)
        if (!(w->walkers[i].stems = ceduo_stems_create(&run->prepared.forest, run->def.kernel)))
            return false;
    return true;
}

static enum ceduo_status finish_chunk(struct ceduo_run *run, struct chunk *chunk, unsigned n)
{
    struct worker *workers = chunk->workers;
    bool no_memory = false;
    for (unsigned i = 0; i < n; i++)
        no_memory |= workers[i].no_memory;
    if (no_memory)
        return CEDUO_NO_MEMORY;
    if (atomic_load(&chunk->stop))
        return CEDUO_CANCELLED;
    /* nothing can fail from here on: a chunk is complete or leaves no trace */
    for (size_t i = 0; i < chunk->batches; i++) {
        bool full = i + 1 < chunk->batches || chunk->end % CEDUO_BATCH_ROCKS == 0;
        struct batch tail = run->tail;
        if (full) {
            ceduo_run_batch_merge(&run->complete, &run->slots[i], run->controls);
        } else {
            run->tail = run->slots[i];
            run->slots[i] = tail;
        }
        ceduo_run_batch_clear(&run->slots[i], run->controls);
    }
    run->rocks = chunk->end;
    return CEDUO_OK;
}

enum ceduo_status ceduo_run_simulate_chunk(struct ceduo_run *run, uint64_t end)
{
    uint64_t first_batch = run->rocks / CEDUO_BATCH_ROCKS;
    uint64_t last_batch = (end - 1) / CEDUO_BATCH_ROCKS;
    struct chunk chunk = {.first = run->rocks, .end = end, .batches = (size_t)(last_batch - first_batch + 1)};
    unsigned n = run->def.threads < chunk.batches ? run->def.threads : (unsigned)chunk.batches;
    struct worker *workers = chunk.workers = calloc(n, sizeof *workers);
    if (!workers)
        return CEDUO_NO_MEMORY;
    bool ready = true;
    for (unsigned i = 0; i < n; i++)
        ready &= worker_init(&workers[i], run, &chunk);
    /* the first batch continues a copy of the tail, so that a cancelled chunk leaves no trace */
    ceduo_run_batch_clear(&run->slots[0], run->controls);
    if (run->rocks % CEDUO_BATCH_ROCKS != 0)
        ceduo_run_batch_merge(&run->slots[0], &run->tail, run->controls);
    enum ceduo_status status = CEDUO_NO_MEMORY;
    if (ready) {
        ceduo_parallel(&(struct parallel){chunk.batches, n, simulate_batch, &chunk});
        status = finish_chunk(run, &chunk, n);
    }
    if (status != CEDUO_OK)
        for (size_t i = 0; i < chunk.batches; i++)
            ceduo_run_batch_clear(&run->slots[i], run->controls);
    for (struct worker *w = workers; w < workers + n; w++) {
        for (size_t i = 0; w->walkers && i < run->lanes; i++)
            ceduo_stems_free(w->walkers[i].stems);
        free(w->walkers);
        free(w->arrivals);
    }
    free(workers);
    return status;
}
