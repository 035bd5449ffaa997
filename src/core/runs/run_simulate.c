/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One chunk of a run, on several threads. Workers take blocks of CEDUO_BLOCK_ROCKS from a common counter. Each owns its
 * walkers, stems and histograms, and writes samples of its rocks into the columns of the run, where no two rocks share a place.
 * A block is summed in the order of its rocks, blocks are merged in their order: the result does not depend on threads. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
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
    struct histogram *bins;
    struct envelopes cells;
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

/* Pictures along the slope show blocks as frequent as they come down. */
static bool is_shown(const struct ceduo_run *run, uint64_t rock)
{
    return !run->sized || ceduo_size_is_typical(&run->ready.sizes, run->ready.scene.simulation.seed, rock);
}

static struct arrival *arrival_of(const struct worker *w, size_t control, uint64_t rock)
{
    return &w->arrivals[control * CEDUO_BLOCK_ROCKS + (rock - w->from)];
}

static void on_cross(void *context, const struct walker *walker, size_t mark, const struct ceduo_crossing *c)
{
    struct worker *w = context;
    const struct ceduo_rock *rock = &walker->rock;
    size_t control = w->run->ready.marks.at[mark].what;
    double speed = sqrt(c->vx * c->vx + c->vz * c->vz);
    double translation = 0.5 * rock->mass * (speed * speed);
    double energy = translation + 0.5 * rock->moment * (c->spin * c->spin);
    bool exceeds = energy > w->run->ready.scene.controls[control].accepted; /* never, where that is NaN */
    *arrival_of(w, control, walker->number) =
        (struct arrival){.of = {[SPEED] = speed, [HEIGHT] = c->height, [ENERGY] = energy, [TRANSLATION] = translation},
                         .stems_hit = (double)c->stems_hit,
                         .arrives = true,
                         .exceeds = exceeds};
}

/* A rock counts at each control that it did not reach. */
static void note_missed(struct worker *w, const struct walker *walker, enum ceduo_end end)
{
    const struct marks *marks = &w->run->ready.marks;
    for (size_t m = walker->next_mark; m < marks->n; m++)
        w->block->controls[marks->at[m].what].ended[end]++;
}

/* At its release, and at its end: a rock that the pictures show has a row of cells. */
static void begin_row(struct worker *w, size_t lane)
{
    struct walker *walker = &w->walkers[lane];
    if (w->cells.n > 0)
        walker->row = is_shown(w->run, walker->number) ? ceduo_envelopes_begin(&w->cells, lane, walker->next_cell)
                                                       : (struct envelope_row){0};
}

static void end_row(struct worker *w, size_t lane)
{
    if (w->walkers[lane].row.at[0])
        ceduo_envelopes_end(&w->cells, lane, w->walkers[lane].next_cell);
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
    w->block->uphill += end == CEDUO_LEFT_SLOPE && !(walker->at.x > 0);
    w->block->early += end == CEDUO_STOPPED_BY_STEMS && walker->at.x < w->run->ready.scene.release.x.mean + CEDUO_EARLY_M;
    w->ends[walker->number - w->from] = (unsigned char)end;
    note_missed(w, walker, end);
    end_row(w, lane);
    if (end == CEDUO_AT_REST || end == CEDUO_STOPPED_BY_STEMS)
        w->stops[walker->number - w->from] = walker->at.x;
    if (walker->cancelled)
        atomic_store(&w->chunk->stop, true);
}

/* ---- many rocks ---- */

/* Whether to go on with the next rock. */
static bool goes_on(struct worker *w)
{
    if (ceduo_cancelled(w->run->def.cancel) || w->no_memory)
        atomic_store(&w->chunk->stop, true);
    return !atomic_load_explicit(&w->chunk->stop, memory_order_relaxed);
}

static enum ceduo_status release(struct worker *w, struct walker *walker, uint64_t number)
{
    struct ceduo_run *run = w->run;
    if (run->alike && walker->g) {
        ceduo_walk_release_again(walker, &w->first, number);
        return CEDUO_OK;
    }
    enum ceduo_status status = ceduo_walk_release(walker, &run->ready, number);
    if (run->alike)
        w->first = *walker;
    return status;
}

/* A rock that cannot be drawn has no trajectory: it is unfinished before every control. */
static void note_undrawn(struct worker *w)
{
    w->block->ends[CEDUO_UNFINISHED]++;
    for (size_t c = 0; c < w->run->controls; c++)
        w->block->controls[c].ended[CEDUO_UNFINISHED]++;
}

/* The next rock of the block at its release; false where none is left. */
static bool next_rock(void *context, size_t lane)
{
    struct worker *w = context;
    while (w->next < w->to && goes_on(w)) {
        uint64_t number = w->next++;
        if (release(w, &w->walkers[lane], number) == CEDUO_OK) {
            begin_row(w, lane);
            return true;
        }
        note_undrawn(w);
    }
    return false;
}

static void clear_block(struct worker *w)
{
    memset(w->arrivals, 0, w->run->controls * CEDUO_BLOCK_ROCKS * sizeof *w->arrivals);
    for (size_t i = 0; i < CEDUO_BLOCK_ROCKS; i++)
        w->stops[i] = NAN;
    memset(w->ends, CEDUO_UNFINISHED, sizeof w->ends);
}

/* What is summed in the order of the rocks, the quantities side by side. */
static void sum_arrivals(struct worker *w, size_t control)
{
    const struct arrival *arrivals = &w->arrivals[control * CEDUO_BLOCK_ROCKS];
    struct sums *to = &w->block->controls[control];
    struct ceduo_moments speed = to->of[SPEED], height = to->of[HEIGHT], energy = to->of[ENERGY],
                         translation = to->of[TRANSLATION];
    bool spins = w->run->kept == QUANTITIES; /* otherwise all energy is translation */
    for (uint64_t i = 0; i < w->to - w->from; i++) {
        const double *of = arrivals[i].of;
        if (!arrivals[i].arrives)
            continue;
        ceduo_moments_add(&speed, of[SPEED]);
        ceduo_moments_add(&height, of[HEIGHT]);
        ceduo_moments_add(&energy, of[ENERGY]);
        if (spins)
            ceduo_moments_add(&translation, of[TRANSLATION]);
        if (w->stems)
            ceduo_moments_add(&to->contacts, arrivals[i].stems_hit);
        to->exceeded += arrivals[i].exceeds;
    }
    to->of[SPEED] = speed;
    to->of[HEIGHT] = height;
    to->of[ENERGY] = energy;
    to->of[TRANSLATION] = spins ? translation : energy;
}

/* The samples of a column; NaN where a rock has none. False without memory. */
static bool bin_column(struct histogram *bins, const double *column, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isnan(column[i]) && !ceduo_histogram_add(bins, column[i]))
            return false;
    return true;
}

/* What single rocks bring to a control. */
static bool keep_arrivals(struct worker *w, size_t control)
{
    struct ceduo_run *run = w->run;
    const struct arrival *arrivals = &w->arrivals[control * CEDUO_BLOCK_ROCKS];
    size_t n = (size_t)(w->to - w->from), from = (size_t)w->from;
    for (int q = 0; q < run->kept; q++) {
        double block[CEDUO_BLOCK_ROCKS], *column = run->exact ? samples_of(run, control, q) + from : block;
        for (size_t i = 0; i < n; i++)
            column[i] = arrivals[i].arrives ? arrivals[i].of[q] : NAN;
        if (!run->exact && !bin_column(bins_of(w->bins, run, control, q), column, n))
            return false;
    }
    for (size_t i = 0; i < n && w->from + i < run->pairs_room; i++)
        run->pairs[control * run->pairs_room + w->from + i] = arrivals[i].arrives ? arrivals[i].of[ENERGY] : NAN;
    return true;
}

static bool keep_stops(struct worker *w)
{
    struct ceduo_run *run = w->run;
    size_t n = (size_t)(w->to - w->from);
    if (!run->exact)
        return bin_column(&w->bins[run->columns - 1], w->stops, n);
    memcpy(stops_of(run) + w->from, w->stops, n * sizeof *w->stops);
    return true;
}

/* How the rocks of a block ended, by their weights. */
static void weigh_ends(struct worker *w)
{
    struct ceduo_run *run = w->run;
    const double *weights = run->weights + w->from;
    for (uint64_t i = 0; i < w->to - w->from; i++) {
        w->block->ended[w->ends[i]] += weights[i];
        for (size_t c = 0; c < run->controls; c++) {
            const struct arrival *a = &w->arrivals[c * CEDUO_BLOCK_ROCKS + i];
            if (a->arrives)
                weighted_sum_add(&w->block->controls[c].hits, weights[i], a->stems_hit);
            else
                w->block->controls[c].missed[w->ends[i]] += weights[i];
        }
    }
}

static void sum_block(struct worker *w)
{
    if (w->run->sized)
        weigh_ends(w);
    bool kept = keep_stops(w);
    for (size_t c = 0; c < w->run->controls; c++) {
        sum_arrivals(w, c);
        kept = kept && keep_arrivals(w, c);
    }
    w->no_memory |= !kept;
    for (uint64_t i = 0; i < w->to - w->from; i++)
        if (!isnan(w->stops[i]))
            ceduo_moments_add(&w->block->stop_x, w->stops[i]);
}

/* Simulates the rocks of a block from w->from to before w->to; false where it was stopped. */
static bool simulate_block(struct worker *w)
{
    struct ceduo_run *run = w->run;
    enum ceduo_law law = run->ready.scene.simulation.law;
    clear_block(w);
    w->next = w->from;
    const struct wide_job job = {.ground = run->wide,
                                 .law = law,
                                 .alike = run->alike,
                                 .walkers = w->walkers,
                                 .next = next_rock,
                                 .ended = note_end,
                                 .context = w};
    if (run->wide_walk)
        run->wide_walk(&job);
    else
        while (next_rock(w, 0))
            note_end(w, 0, ceduo_walk(&w->walkers[0], law));
    if (atomic_load_explicit(&w->chunk->stop, memory_order_relaxed))
        return false;
    sum_block(w);
    return true;
}

static int take_block(void *context, size_t i, size_t worker)
{
    struct chunk *chunk = context;
    struct worker *w = &chunk->workers[worker];
    uint64_t from = (chunk->first / CEDUO_BLOCK_ROCKS + i) * CEDUO_BLOCK_ROCKS, to = from + CEDUO_BLOCK_ROCKS;
    w->from = from < chunk->first ? chunk->first : from;
    w->to = to > chunk->end ? chunk->end : to;
    w->block = &w->run->slots[i];
    return simulate_block(w) ? CEDUO_OK : CEDUO_CANCELLED;
}

/* ---- threads ---- */

static bool init_stems(struct worker *w)
{
    struct ceduo_run *run = w->run;
    w->stems = calloc(run->lanes, sizeof *w->stems);
    if (!w->stems)
        return false;
    for (size_t i = 0; i < run->lanes; i++) {
        if (!ceduo_stems_init(&w->stems[i], &run->ready.wood, run->ready.scene.simulation.contact_model == CEDUO_POISSON,
                              run->def.kernel))
            return false;
        w->walkers[i].stems = &w->stems[i];
    }
    return true;
}

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
    if (!run->ready.wood.bare && !init_stems(w))
        return false;
    if (!run->exact && !(w->bins = calloc(run->columns, sizeof *w->bins)))
        return false;
    return run->def.cells == 0 || ceduo_envelopes_init(&w->cells, run->def.cells, run->lanes);
}

static void worker_release(struct worker *w)
{
    ceduo_histograms_free(w->bins, w->run->columns);
    ceduo_envelopes_release(&w->cells);
    for (size_t i = 0; w->stems && i < w->run->lanes; i++)
        ceduo_stems_release(&w->stems[i]);
    free(w->stems);
    free(w->walkers);
    free(w->arrivals);
}

static void worker_merge(struct worker *w)
{
    struct ceduo_run *run = w->run;
    if (w->bins)
        ceduo_histograms_merge(run->bins, w->bins, run->columns);
    if (w->cells.n > 0)
        ceduo_envelopes_merge(run->cells, &w->cells);
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
    for (unsigned i = 0; i < n; i++)
        if (workers[i].bins && !ceduo_histograms_reserve(run->bins, workers[i].bins, run->columns))
            return CEDUO_NO_MEMORY;
    for (unsigned i = 0; i < n; i++) /* nothing fails from here on: a chunk is there or leaves no trace */
        worker_merge(&workers[i]);
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
    for (unsigned i = 0; i < n; i++)
        worker_release(&workers[i]);
    free(workers);
    return status;
}
