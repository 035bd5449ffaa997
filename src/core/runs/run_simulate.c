/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One chunk of a run, on several threads. Workers take blocks of CEDUO_BLOCK_ROCKS from a common counter. Each owns its
 * walkers and stems, and writes samples of its rocks into the columns of the run, where no two rocks share a place.
 * A block is summed in the order of its rocks, blocks are merged in their order: the result does not depend on threads. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "core/walk/walk.h"
#include "run_state.h"

/* What a rock brings to a control; all 0 where it does not arrive. */
struct arrival {
    double of[QUANTITIES], stems_hit;
    bool arrives, exceeds; /* exceeds: with more than is accepted */
};

/* One thread's work on a chunk. The rocks of a block may end in any order: what they bring is kept, and summed when all
 * have ended. */
struct worker {
    struct ceduo_run *run;
    struct walker *walkers; /* one for each lane */
    struct stems *stems;    /* likewise; NULL: no forest */
    struct walker first;    /* a rock at its release: where all are alike, they are as this one */
    struct block *block;
    uint64_t from, next, to;               /* rocks of the block: the first, the next to begin, behind the last */
    struct arrival *arrivals;              /* [control][CEDUO_BLOCK_ROCKS] */
    double stops[CEDUO_BLOCK_ROCKS];       /* NaN: it did not stop */
    unsigned char ends[CEDUO_BLOCK_ROCKS]; /* enum ceduo_end, where rocks have weights */
    bool no_memory;
    struct chunk *chunk;
};

struct chunk {
    uint64_t first, end; /* rocks */
    size_t blocks;
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
    bool exceeds = energy > w->run->prepared.scene.controls[control].accepted; /* never, where that is NaN */
    w->arrivals[control * CEDUO_BLOCK_ROCKS + (walker->number - w->from)] =
        (struct arrival){.of = {[SPEED] = speed, [HEIGHT] = c->height, [ENERGY] = energy, [TRANSLATION] = translation},
                         .stems_hit = (double)c->stems_hit,
                         .arrives = true,
                         .exceeds = exceeds};
}

static void note_end(void *context, size_t lane, enum ceduo_end end)
{
    struct worker *w = context;
    const struct walker *walker = &w->walkers[lane];
    if (walker->stems) {
        w->no_memory |= walker->stems->no_memory;
        w->block->stems.drawn += walker->stems->drawn;
        w->block->stems.hit += walker->stems_hit;
        w->block->stems.met += walker->stools_met;
    }
    w->block->contacts += walker->contacts;
    w->block->ends[end]++;
    w->block->uphill += end == CEDUO_LEFT_SLOPE && !(walker->flight.x > 0);
    w->block->early +=
        end == CEDUO_STOPPED_BY_STEMS && walker->flight.x < w->run->prepared.scene.release.x.mean + CEDUO_EARLY_M;
    w->ends[walker->number - w->from] = (unsigned char)end;
    const struct marks *marks = &w->run->prepared.marks;
    for (size_t m = walker->next_mark; m < marks->n; m++) /* it counts at each control that it did not reach */
        w->block->controls[marks->items[m].control].ended[end]++;
    if (end == CEDUO_AT_REST || end == CEDUO_STOPPED_BY_STEMS)
        w->stops[walker->number - w->from] = walker->flight.x;
    if (walker->cancelled)
        atomic_store(&w->chunk->stop, true);
}

/* ---- many rocks ---- */

/* The next rock of the block at its release; false where none is left. */
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
        if (!drawn) { /* it has no trajectory: it is unfinished before every control */
            w->block->ends[CEDUO_UNFINISHED]++;
            for (size_t c = 0; c < run->controls; c++)
                w->block->controls[c].ended[CEDUO_UNFINISHED]++;
            continue;
        }
        return true;
    }
    return false;
}

/* Sum what the rocks bring to a control, in their order, and keep samples. */
static void sum_arrivals(struct worker *w, size_t control)
{
    struct ceduo_run *run = w->run;
    const struct arrival *arrivals = &w->arrivals[control * CEDUO_BLOCK_ROCKS];
    struct sums *to = &w->block->controls[control];
    size_t n = (size_t)(w->to - w->from), from = (size_t)w->from;
    bool spins = run->kept == QUANTITIES; /* otherwise all energy is translation */
    for (size_t i = 0; i < n; i++) {
        if (!arrivals[i].arrives)
            continue;
        for (int q = 0; q < (spins ? QUANTITIES : TRANSLATION); q++)
            ceduo_moments_add(&to->of[q], arrivals[i].of[q]);
        if (w->stems)
            ceduo_moments_add(&to->contacts, arrivals[i].stems_hit);
        to->exceeded += arrivals[i].exceeds;
    }
    if (!spins)
        to->of[TRANSLATION] = to->of[ENERGY];
    for (int q = 0; q < run->kept; q++) {
        double *column = samples_of(run, control, q) + from;
        for (size_t i = 0; i < n; i++)
            column[i] = arrivals[i].arrives ? arrivals[i].of[q] : NAN;
    }
}

static void sum_block(struct worker *w)
{
    struct ceduo_run *run = w->run;
    size_t n = (size_t)(w->to - w->from);
    for (size_t i = 0; run->sized && i < n; i++) { /* how the rocks ended, by their weights */
        double weight = run->weights[w->from + i];
        w->block->ended[w->ends[i]] += weight;
        for (size_t c = 0; c < run->controls; c++) {
            const struct arrival *a = &w->arrivals[c * CEDUO_BLOCK_ROCKS + i];
            if (a->arrives)
                weighted_sum_add(&w->block->controls[c].hits, weight, a->stems_hit);
            else
                w->block->controls[c].missed[w->ends[i]] += weight;
        }
    }
    memcpy(stops_of(run) + w->from, w->stops, n * sizeof *w->stops);
    for (size_t c = 0; c < run->controls; c++)
        sum_arrivals(w, c);
    for (size_t i = 0; i < n; i++)
        if (!isnan(w->stops[i]))
            ceduo_moments_add(&w->block->stop_x, w->stops[i]);
}

/* Simulates the rocks of a block, or those of them that belong to the chunk. */
static int take_block(void *context, size_t i, size_t worker)
{
    struct chunk *chunk = context;
    struct worker *w = &chunk->workers[worker];
    struct ceduo_run *run = w->run;
    enum ceduo_law law = run->prepared.scene.simulation.law;
    uint64_t from = (chunk->first / CEDUO_BLOCK_ROCKS + i) * CEDUO_BLOCK_ROCKS, to = from + CEDUO_BLOCK_ROCKS;
    w->from = w->next = from < chunk->first ? chunk->first : from;
    w->to = to > chunk->end ? chunk->end : to;
    w->block = &run->slots[i];
    memset(w->arrivals, 0, run->controls * CEDUO_BLOCK_ROCKS * sizeof *w->arrivals);
    memset(w->ends, CEDUO_UNFINISHED, sizeof w->ends);
    for (size_t k = 0; k < CEDUO_BLOCK_ROCKS; k++)
        w->stops[k] = NAN;
    const struct lanes_job job = {.ground = run->ground_of_lanes,
                                  .law = law,
                                  .identical = run->identical,
                                  .walkers = w->walkers,
                                  .next = next_rock,
                                  .ended = note_end,
                                  .context = w};
    if (run->lanes_walk)
        run->lanes_walk(&job);
    else
        while (next_rock(w, 0))
            note_end(w, 0, ceduo_walk(&w->walkers[0], law));
    if (atomic_load_explicit(&chunk->stop, memory_order_relaxed))
        return CEDUO_CANCELLED;
    sum_block(w);
    return CEDUO_OK;
}

/* ---- threads ---- */

static bool worker_init(struct worker *w, struct ceduo_run *run, struct chunk *chunk)
{
    *w = (struct worker){.run = run, .chunk = chunk};
    w->walkers = calloc(run->lanes, sizeof *w->walkers);
    w->arrivals = malloc((run->controls + 1) * CEDUO_BLOCK_ROCKS * sizeof *w->arrivals);
    if (!w->walkers || !w->arrivals)
        return false;
    for (size_t i = 0; i < run->lanes; i++)
        w->walkers[i] = (struct walker){
            .cross = on_cross, .context = w, .arrivals_only = run->def.arrivals_only, .cancel = run->def.cancel};
    if (!run->prepared.wood.bare && !(w->stems = calloc(run->lanes, sizeof *w->stems)))
        return false;
    for (size_t i = 0; w->stems && i < run->lanes; i++) {
        if (!ceduo_stems_init(&w->stems[i], &run->prepared.wood, run->def.kernel))
            return false;
        w->walkers[i].stems = &w->stems[i];
    }
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
    /* nothing fails from here on: a chunk is there or leaves no trace */
    for (size_t i = 0; i < chunk->blocks; i++) {
        bool full = i + 1 < chunk->blocks || chunk->end % CEDUO_BLOCK_ROCKS == 0;
        struct block tail = run->tail;
        if (full) {
            ceduo_run_block_merge(&run->whole, &run->slots[i], run->controls);
        } else {
            run->tail = run->slots[i];
            run->slots[i] = tail;
        }
        ceduo_run_block_clear(&run->slots[i], run->controls);
    }
    run->rocks = chunk->end;
    return CEDUO_OK;
}

enum ceduo_status ceduo_run_simulate_chunk(struct ceduo_run *run, uint64_t end)
{
    uint64_t first_block = run->rocks / CEDUO_BLOCK_ROCKS;
    uint64_t last_block = (end - 1) / CEDUO_BLOCK_ROCKS;
    struct chunk chunk = {.first = run->rocks, .end = end, .blocks = (size_t)(last_block - first_block + 1)};
    unsigned n = run->def.threads < chunk.blocks ? run->def.threads : (unsigned)chunk.blocks;
    struct worker *workers = chunk.workers = calloc(n, sizeof *workers);
    if (!workers)
        return CEDUO_NO_MEMORY;
    bool ready = true;
    for (unsigned i = 0; i < n; i++)
        ready &= worker_init(&workers[i], run, &chunk);
    /* the first block goes on where the tail stands; a copy, so that a cancelled chunk leaves no trace */
    ceduo_run_block_clear(&run->slots[0], run->controls);
    if (run->rocks % CEDUO_BLOCK_ROCKS != 0)
        ceduo_run_block_merge(&run->slots[0], &run->tail, run->controls);
    enum ceduo_status status = CEDUO_NO_MEMORY;
    if (ready) {
        ceduo_parallel(&(struct parallel){chunk.blocks, n, take_block, &chunk});
        status = finish_chunk(run, &chunk, n);
    }
    if (status != CEDUO_OK)
        for (size_t i = 0; i < chunk.blocks; i++)
            ceduo_run_block_clear(&run->slots[i], run->controls);
    for (struct worker *w = workers; w < workers + n; w++) {
        for (size_t i = 0; w->stems && i < run->lanes; i++)
            ceduo_stems_release(&w->stems[i]);
        free(w->stems);
        free(w->walkers);
        free(w->arrivals);
    }
    free(workers);
    return status;
}
