/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/run.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "run_pack.h"
#include "ceduo/part.h"
#include "envelope.h"
#include "histogram.h"
#include "walk.h"
#include "wide.h"

#ifndef CHUNK_BLOCKS
#define CHUNK_BLOCKS 256 /* blocks in work at a time: what bounds the memory of their sums */
#endif
#define CHUNK_SECONDS 0.5 /* about so long they take: somebody waits for a sign of progress */

enum quantity { SPEED, HEIGHT, ENERGY, TRANSLATION, QUANTITIES };

/* What is summed at one control. Released rocks that do not arrive are known from the counts. */
struct sums {
    struct ceduo_moments of[QUANTITIES], contacts; /* contacts: stems hit before */
    uint64_t exceeded, unfinished;
};

/* Rocks done in order, summed in order: blocks are summed rock by rock and merged block by block. */
struct block {
    uint64_t contacts, ends[CEDUO_ENDS];
    struct ceduo_stem_counts stems;
    struct ceduo_moments stop_x;
    struct sums *controls;
};

struct ceduo_run {
    struct ceduo_run_def def;
    struct ceduo_scene scene;
    struct ceduo_rock mean;
    struct ground ground;
    struct marks marks;
    struct wood wood;
    struct wide_ground *wide;
    wide_walk_fn *wide_walk; /* NULL: rocks are flown one by one */
    size_t lanes;            /* rocks that a thread flies at once */
    size_t controls;
    int kept;              /* quantities whose samples are kept; without spin and spread, energy follows from speed */
    uint64_t rocks;        /* done; of a part: with those before it */
    uint64_t first;        /* rocks before a part, otherwise 0 */
    struct block *kept_blocks; /* of a part: the whole blocks one by one */
    size_t kept_count, kept_room;
    size_t chunk;          /* blocks to take on next */
    struct block whole;    /* all whole blocks */
    struct block tail;     /* the block that is not full yet */
    struct block *slots;   /* CHUNK_BLOCKS in work */
    bool alike;            /* the rocks differ in nothing but their numbers */
    bool exact;            /* samples are kept; otherwise histograms */
    uint64_t room;         /* rocks that the samples have room for */
    double **samples;      /* [control, quantity][room], NaN where a rock did not arrive; then one of the stops: NaN where
                            * it did not stop */
    uint64_t pairs_room;   /* where samples are not kept: the first rocks' energies, for differences */
    double *pairs;         /* [control][pairs_room], NaN where a rock did not arrive */
    struct histogram *bins; /* [control][quantity], then one of the stops */
    struct envelope_cell *cells;
};

/* What a rock brings to a control. */
struct arrival {
    double values[QUANTITIES], stems_hit; /* stems_hit < 0: it does not arrive */
};

/* One thread's work on a chunk. The rocks of a block may end in any order: what they bring is kept, and summed when all
 * have ended. */
struct worker {
    struct ceduo_run *run;
    struct walker *walkers; /* one for each lane */
    struct stems *stems;    /* likewise; NULL: no forest */
    struct walker first;    /* a rock at its release: where all are alike, they are as this one */
    struct block *block;
    uint64_t from, next, to; /* rocks of the block: the first, the next to begin, behind the last */
    struct arrival *arrivals; /* [control][CEDUO_BLOCK_ROCKS] */
    double stops[CEDUO_BLOCK_ROCKS]; /* NaN: it did not stop */
    struct histogram *bins;
    struct envelope_cell *cells;
    bool no_memory;
    struct chunk *chunk;
};

struct chunk {
    uint64_t first, end; /* rocks */
    size_t blocks;
    atomic_size_t next;
    atomic_bool stop;
};

struct ceduo_run_def ceduo_run_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_run_def){
        .scene = scene, .threads = 1, .rocks_most = scene->simulation.rocks, .exact_bytes = CEDUO_EXACT_BYTES};
}

/* ---- blocks ---- */

static bool block_init(struct block *b, size_t controls)
{
    *b = (struct block){.controls = calloc(controls + 1, sizeof(struct sums))};
    return b->controls != NULL;
}

static void block_clear(struct block *b, size_t controls)
{
    struct sums *keep = b->controls;
    memset(keep, 0, controls * sizeof *keep);
    *b = (struct block){.controls = keep};
}

static void block_merge(struct block *into, const struct block *from, size_t controls)
{
    into->contacts += from->contacts;
    into->stems.drawn += from->stems.drawn;
    into->stems.hit += from->stems.hit;
    into->stems.met += from->stems.met;
    for (int e = 0; e < CEDUO_ENDS; e++)
        into->ends[e] += from->ends[e];
    ceduo_moments_merge(&into->stop_x, &from->stop_x);
    for (size_t c = 0; c < controls; c++) {
        for (int q = 0; q < QUANTITIES; q++)
            ceduo_moments_merge(&into->controls[c].of[q], &from->controls[c].of[q]);
        ceduo_moments_merge(&into->controls[c].contacts, &from->controls[c].contacts);
        into->controls[c].exceeded += from->controls[c].exceeded;
        into->controls[c].unfinished += from->controls[c].unfinished;
    }
}

static void block_swap(struct block *a, struct block *b)
{
    struct block t = *a;
    *a = *b;
    *b = t;
}

/* ---- one rock ---- */

static double *samples_of(const struct ceduo_run *run, size_t control, int quantity)
{
    return run->samples[control * (size_t)run->kept + (size_t)quantity];
}

static double *stops_of(const struct ceduo_run *run)
{
    return run->samples[run->controls * (size_t)run->kept];
}

static struct histogram *bins_of(struct histogram *bins, const struct ceduo_run *run, size_t control, int quantity)
{
    return &bins[control * (size_t)run->kept + (size_t)quantity];
}

static void keep_sample(struct worker *w, uint64_t rock, size_t control, const double values[QUANTITIES])
{
    struct ceduo_run *run = w->run;
    for (int q = 0; q < run->kept; q++) {
        if (run->exact)
            samples_of(run, control, q)[rock - run->first] = values[q];
        else if (!ceduo_histogram_add(bins_of(w->bins, run, control, q), values[q]))
            w->no_memory = true;
    }
    if (rock < run->pairs_room)
        run->pairs[control * run->pairs_room + rock] = values[ENERGY];
}

static void on_cross(void *context, const struct walker *walker, size_t mark, const struct ceduo_crossing *c)
{
    struct worker *w = context;
    struct ceduo_run *run = w->run;
    const struct ceduo_rock *rock = &walker->rock;
    size_t what = run->marks.what[mark];
    double speed = sqrt(c->vx * c->vx + c->vz * c->vz);
    double translation = 0.5 * rock->mass * (speed * speed);
    double energy = translation + 0.5 * rock->moment * (c->spin * c->spin);
    if (what >= run->controls) {
        ceduo_envelope_add(&w->cells[what - run->controls], speed, c->height, energy);
        return;
    }
    struct arrival *a = &w->arrivals[what * CEDUO_BLOCK_ROCKS + (walker->number - w->from)];
    *a = (struct arrival){{speed, c->height, energy, translation}, (double)c->stems_hit};
    keep_sample(w, walker->number, what, a->values);
}

/* An unfinished rock counts at each control that it did not reach. */
static void note_unfinished(struct worker *w, const struct walker *walker)
{
    for (size_t m = walker->next_mark; m < w->run->marks.n; m++)
        if (w->run->marks.what[m] < w->run->controls)
            w->block->controls[w->run->marks.what[m]].unfinished++;
}

static void clear_samples(struct ceduo_run *run, uint64_t rock)
{
    for (size_t c = 0; rock < run->pairs_room && c < run->controls; c++)
        run->pairs[c * run->pairs_room + rock] = NAN;
    if (!run->exact)
        return;
    for (size_t c = 0; c < run->controls; c++)
        for (int q = 0; q < run->kept; q++)
            samples_of(run, c, q)[rock - run->first] = NAN;
    stops_of(run)[rock - run->first] = NAN;
}

static void note_stop(struct worker *w, uint64_t rock, double x)
{
    struct ceduo_run *run = w->run;
    w->stops[rock - w->from] = x;
    if (run->exact)
        stops_of(run)[rock - run->first] = x;
    else if (!ceduo_histogram_add(&w->bins[run->controls * (size_t)run->kept], x))
        w->no_memory = true;
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
    if (end == CEDUO_UNFINISHED)
        note_unfinished(w, walker);
    if (end == CEDUO_AT_REST || end == CEDUO_STOPPED_BY_STEMS)
        note_stop(w, walker->number, walker->at.x);
    if (walker->cancelled)
        atomic_store(&w->chunk->stop, true);
}

/* ---- many rocks ---- */

static bool cancelled(const struct ceduo_run *run)
{
    return run->def.cancel && atomic_load_explicit(run->def.cancel, memory_order_relaxed);
}

/* Whether to go on with the next rock. */
static bool goes_on(struct worker *w)
{
    if (cancelled(w->run) || w->no_memory)
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
    enum ceduo_status status =
        ceduo_walk_release(walker, &run->scene, &run->ground, &run->marks, &run->mean, number);
    if (run->alike)
        w->first = *walker;
    return status;
}

/* A rock that cannot be drawn has no way: it is unfinished before every control. */
static void note_undrawn(struct worker *w)
{
    w->block->ends[CEDUO_UNFINISHED]++;
    for (size_t c = 0; c < w->run->controls; c++)
        w->block->controls[c].unfinished++;
}

/* The next rock of the block at its release; false where none is left. */
static bool next_rock(void *context, size_t lane)
{
    struct worker *w = context;
    struct ceduo_run *run = w->run;
    while (w->next < w->to && goes_on(w)) {
        uint64_t number = w->next++;
        clear_samples(run, number);
        if (release(w, &w->walkers[lane], number) == CEDUO_OK)
            return true;
        note_undrawn(w);
    }
    return false;
}

static void clear_block(struct worker *w)
{
    size_t n = w->run->controls * CEDUO_BLOCK_ROCKS;
    for (size_t i = 0; i < n; i++)
        w->arrivals[i].stems_hit = -1;
    for (size_t i = 0; i < CEDUO_BLOCK_ROCKS; i++)
        w->stops[i] = NAN;
}

static void sum_arrivals(struct worker *w, size_t control)
{
    const struct arrival *arrivals = &w->arrivals[control * CEDUO_BLOCK_ROCKS];
    struct sums *to = &w->block->controls[control], sums = *to;
    double accepted = w->run->scene.controls[control].accepted;
    for (uint64_t i = 0; i < w->to - w->from; i++) {
        const struct arrival *a = &arrivals[i];
        if (a->stems_hit < 0)
            continue;
        for (int q = 0; q < QUANTITIES; q++)
            ceduo_moments_add(&sums.of[q], a->values[q]);
        if (w->stems)
            ceduo_moments_add(&sums.contacts, a->stems_hit);
        sums.exceeded += a->values[ENERGY] > accepted; /* never, where that is NaN */
    }
    *to = sums;
}

static void sum_block(struct worker *w)
{
    for (size_t c = 0; c < w->run->controls; c++)
        sum_arrivals(w, c);
    for (uint64_t i = 0; i < w->to - w->from; i++)
        if (!isnan(w->stops[i]))
            ceduo_moments_add(&w->block->stop_x, w->stops[i]);
}

/* Flies the rocks of a block from w->from to before w->to; false where it was stopped. */
static bool fly_block(struct worker *w)
{
    struct ceduo_run *run = w->run;
    enum ceduo_law law = run->scene.simulation.law;
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

static void *work(void *argument)
{
    struct worker *w = argument;
    struct chunk *chunk = w->chunk;
    uint64_t first_block = chunk->first / CEDUO_BLOCK_ROCKS;
    for (size_t i; (i = atomic_fetch_add(&chunk->next, 1)) < chunk->blocks;) {
        uint64_t from = (first_block + i) * CEDUO_BLOCK_ROCKS, to = from + CEDUO_BLOCK_ROCKS;
        w->from = from < chunk->first ? chunk->first : from;
        w->to = to > chunk->end ? chunk->end : to;
        w->block = &w->run->slots[i];
        if (!fly_block(w))
            return NULL;
    }
    return NULL;
}

static bool init_stems(struct worker *w)
{
    struct ceduo_run *run = w->run;
    w->stems = calloc(run->lanes, sizeof *w->stems);
    if (!w->stems)
        return false;
    for (size_t i = 0; i < run->lanes; i++) {
        if (!ceduo_stems_init(&w->stems[i], &run->wood, run->scene.simulation.contact_model == CEDUO_POISSON))
            return false;
        w->walkers[i].stems = &w->stems[i];
    }
    return true;
}

static bool worker_init(struct worker *w, struct ceduo_run *run, struct chunk *chunk)
{
    *w = (struct worker){.run = run, .chunk = chunk};
    w->walkers = calloc(run->lanes, sizeof *w->walkers);
    w->arrivals = malloc((run->controls * CEDUO_BLOCK_ROCKS + 1) * sizeof *w->arrivals);
    if (!w->walkers || !w->arrivals)
        return false;
    for (size_t i = 0; i < run->lanes; i++)
        w->walkers[i] = (struct walker){
            .cross = on_cross, .context = w, .arrivals_only = run->def.arrivals_only, .cancel = run->def.cancel};
    if (!run->wood.bare && !init_stems(w))
        return false;
    size_t bins = run->controls * (size_t)run->kept + 1;
    if (!run->exact && !(w->bins = calloc(bins, sizeof *w->bins)))
        return false;
    return run->def.cells == 0 || (w->cells = calloc(run->def.cells, sizeof *w->cells));
}

static void worker_release(struct worker *w)
{
    size_t bins = w->run->controls * (size_t)w->run->kept + 1;
    for (size_t i = 0; w->bins && i < bins; i++)
        ceduo_histogram_clear(&w->bins[i]);
    free(w->bins);
    free(w->cells);
    for (size_t i = 0; w->stems && i < w->run->lanes; i++)
        ceduo_stems_release(&w->stems[i]);
    free(w->stems);
    free(w->walkers);
    free(w->arrivals);
}

/* Room for what a worker brings. */
static bool worker_reserve(const struct worker *w)
{
    struct ceduo_run *run = w->run;
    size_t bins = run->controls * (size_t)run->kept + 1;
    for (size_t i = 0; w->bins && i < bins; i++)
        if (!ceduo_histogram_reserve(&run->bins[i], &w->bins[i]))
            return false;
    return true;
}

static void worker_merge(struct worker *w)
{
    struct ceduo_run *run = w->run;
    size_t bins = run->controls * (size_t)run->kept + 1;
    for (size_t i = 0; w->bins && i < bins; i++)
        ceduo_histogram_merge(&run->bins[i], &w->bins[i]);
    for (size_t i = 0; w->cells && i < run->def.cells; i++) {
        ceduo_envelope_settle(&w->cells[i]);
        ceduo_envelope_merge(&run->cells[i], &w->cells[i]);
    }
}

/* Runs a chunk on as many threads as can be started; this one works too. */
static void run_workers(struct worker *workers, unsigned n)
{
    pthread_t *threads = n > 1 ? malloc((n - 1) * sizeof *threads) : NULL;
    unsigned started = 0;
    while (threads && started < n - 1 && pthread_create(&threads[started], NULL, work, &workers[started + 1]) == 0)
        started++;
    work(&workers[0]);
    for (unsigned i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    free(threads);
}

/* Room for the blocks of a chunk; only a part keeps them. */
static bool grow_kept(struct ceduo_run *run, size_t more)
{
    if (!run->def.part || run->kept_count + more <= run->kept_room)
        return true;
    size_t room = 2 * run->kept_room + more;
    struct block *blocks = realloc(run->kept_blocks, room * sizeof *blocks);
    if (!blocks)
        return false;
    run->kept_blocks = blocks;
    for (; run->kept_room < room; run->kept_room++)
        if (!block_init(&blocks[run->kept_room], run->controls))
            return false;
    return true;
}

static enum ceduo_status finish_chunk(struct ceduo_run *run, struct chunk *chunk, struct worker *workers, unsigned n)
{
    bool no_memory = false;
    for (unsigned i = 0; i < n; i++)
        no_memory |= workers[i].no_memory;
    if (no_memory)
        return CEDUO_NO_MEMORY;
    if (atomic_load(&chunk->stop))
        return CEDUO_CANCELLED;
    if (!grow_kept(run, chunk->blocks))
        return CEDUO_NO_MEMORY;
    for (unsigned i = 0; i < n; i++)
        if (!worker_reserve(&workers[i]))
            return CEDUO_NO_MEMORY;
    for (unsigned i = 0; i < n; i++) /* nothing fails from here on: a chunk is there or leaves no trace */
        worker_merge(&workers[i]);
    for (size_t i = 0; i < chunk->blocks; i++) {
        bool full = i + 1 < chunk->blocks || chunk->end % CEDUO_BLOCK_ROCKS == 0;
        if (full && run->def.part)
            block_merge(&run->kept_blocks[run->kept_count++], &run->slots[i], run->controls);
        if (full)
            block_merge(&run->whole, &run->slots[i], run->controls);
        else
            block_swap(&run->tail, &run->slots[i]);
        block_clear(&run->slots[i], run->controls);
    }
    run->rocks = chunk->end;
    return CEDUO_OK;
}

/* One chunk, from where the run stands. */
static enum ceduo_status fly_chunk(struct ceduo_run *run, uint64_t end)
{
    uint64_t first_block = run->rocks / CEDUO_BLOCK_ROCKS;
    uint64_t last_block = (end - 1) / CEDUO_BLOCK_ROCKS;
    struct chunk chunk = {.first = run->rocks, .end = end, .blocks = (size_t)(last_block - first_block + 1)};
    unsigned n = run->def.threads < chunk.blocks ? run->def.threads : (unsigned)chunk.blocks;
    struct worker *workers = calloc(n, sizeof *workers);
    if (!workers)
        return CEDUO_NO_MEMORY;
    bool ready = true;
    for (unsigned i = 0; i < n; i++)
        ready &= worker_init(&workers[i], run, &chunk);
    /* the first block goes on where the tail stands; a copy, so that a cancelled chunk leaves no trace */
    block_clear(&run->slots[0], run->controls);
    if (run->rocks % CEDUO_BLOCK_ROCKS != 0)
        block_merge(&run->slots[0], &run->tail, run->controls);
    enum ceduo_status status = CEDUO_NO_MEMORY;
    if (ready) {
        run_workers(workers, n);
        status = finish_chunk(run, &chunk, workers, n);
    }
    if (status != CEDUO_OK)
        for (size_t i = 0; i < chunk.blocks; i++)
            block_clear(&run->slots[i], run->controls);
    for (unsigned i = 0; i < n; i++)
        worker_release(&workers[i]);
    free(workers);
    return status;
}

/* ---- samples ---- */

static size_t columns(const struct ceduo_run *run)
{
    return run->controls * (size_t)run->kept + 1; /* and the stops */
}

/* With one column more, in which they are sorted. */
static bool fits_exact(const struct ceduo_run *run, uint64_t rocks)
{
    return (double)rocks * (double)(columns(run) + 1) * sizeof(double) <= (double)run->def.exact_bytes;
}

/* Makes room for the samples of `rocks` rocks. Each column grows by itself: never are all there twice. */
static bool grow_samples(struct ceduo_run *run, uint64_t rocks)
{
    rocks -= run->first;
    if (rocks <= run->room)
        return true;
    uint64_t room = 2 * run->room;
    room = room < rocks || !fits_exact(run, room) ? rocks : room;
    if (!run->samples && !(run->samples = calloc(columns(run), sizeof *run->samples)))
        return false;
    for (size_t i = 0; i < columns(run); i++) {
        double *grown = realloc(run->samples[i], (size_t)room * sizeof(double));
        if (!grown)
            return false;
        run->samples[i] = grown;
    }
    run->room = room;
    return true;
}

static void free_samples(struct ceduo_run *run)
{
    for (size_t i = 0; run->samples && i < columns(run); i++)
        free(run->samples[i]);
    free(run->samples);
    run->samples = NULL;
    run->room = 0;
}

/* Energy of a rock at a control, from the samples; NaN where it did not arrive. */
static double energy_of(const struct ceduo_run *run, size_t control, uint64_t rock)
{
    if (run->kept == QUANTITIES)
        return samples_of(run, control, ENERGY)[rock];
    double speed = samples_of(run, control, SPEED)[rock];
    return 0.5 * run->mean.mass * (speed * speed);
}

/* Where samples are kept no more, the first rocks' energies stay. */
static bool keep_pairs(struct ceduo_run *run)
{
    if (run->controls == 0)
        return true;
    uint64_t room = run->def.exact_bytes / sizeof(double) / run->controls;
    room = room < CEDUO_PAIRED_ROCKS ? room : CEDUO_PAIRED_ROCKS;
    run->pairs = malloc(((size_t)room * run->controls + 1) * sizeof(double));
    if (!run->pairs)
        return false;
    run->pairs_room = room;
    for (size_t c = 0; c < run->controls; c++)
        for (uint64_t r = 0; run->room > 0 && r < run->rocks && r < room; r++)
            run->pairs[c * room + r] = energy_of(run, c, r);
    return true;
}

static void free_bins(struct histogram *bins, size_t n)
{
    for (size_t i = 0; bins && i < n; i++)
        ceduo_histogram_clear(&bins[i]);
    free(bins);
}

static bool fill_bins(const struct ceduo_run *run, struct histogram *bins)
{
    for (size_t i = 0; run->room > 0 && i < columns(run); i++)
        for (uint64_t r = 0; r < run->rocks; r++) {
            double v = run->samples[i][r];
            if (!isnan(v) && !ceduo_histogram_add(&bins[i], v))
                return false;
        }
    return true;
}

/* From samples to histograms: there are now too many rocks to keep. */
static bool bin_samples(struct ceduo_run *run)
{
    struct histogram *bins = calloc(columns(run), sizeof *bins);
    if (!bins || !fill_bins(run, bins) || !keep_pairs(run)) {
        free_bins(bins, columns(run));
        return false;
    }
    free_samples(run);
    run->bins = bins;
    run->exact = false;
    return true;
}

static bool prepare_samples(struct ceduo_run *run, uint64_t rocks)
{
    if (!run->exact)
        return true;
    return fits_exact(run, rocks) ? grow_samples(run, rocks) : bin_samples(run);
}

static double seconds_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The next chunk after one of so many blocks: as many as take CHUNK_SECONDS by its speed, at most twice as many, and as
 * many for each thread, so that none waits long for the others at its end. What is found does not depend on it. */
static void choose_chunk(struct ceduo_run *run, size_t blocks, double seconds)
{
    size_t threads = run->def.threads, most = 2 * run->chunk;
    double wanted = seconds > 0 ? (double)blocks * CHUNK_SECONDS / seconds : (double)most;
    run->chunk = wanted < (double)most ? (size_t)wanted : most;
    run->chunk = (run->chunk + threads - 1) / threads * threads;
    run->chunk = run->chunk < threads ? threads : run->chunk;
    run->chunk = run->chunk > CHUNK_BLOCKS ? CHUNK_BLOCKS : run->chunk;
}

enum ceduo_status ceduo_run_extend(struct ceduo_run *run, uint64_t rocks)
{
    if (rocks > run->def.rocks_most)
        rocks = run->def.rocks_most;
    if (rocks <= run->rocks)
        return CEDUO_OK;
    if (!prepare_samples(run, rocks))
        return CEDUO_NO_MEMORY;
    while (run->rocks < rocks) {
        uint64_t block = run->rocks / CEDUO_BLOCK_ROCKS, end = (block + run->chunk) * CEDUO_BLOCK_ROCKS;
        double start = seconds_now();
        enum ceduo_status status = fly_chunk(run, end < rocks ? end : rocks);
        if (status != CEDUO_OK)
            return status;
        choose_chunk(run, (size_t)(run->rocks / CEDUO_BLOCK_ROCKS - block), seconds_now() - start);
        if (run->def.progress)
            run->def.progress(run->def.context, run->rocks);
    }
    return CEDUO_OK;
}

/* ---- making and freeing ---- */

/* A part keeps what the whole run would keep. */
static bool begin_part(struct ceduo_run *run)
{
    run->rocks = run->first = run->def.first;
    return fits_exact(run, run->def.rocks_most) || bin_samples(run);
}

/* Among stems the scalar walk is faster: nearly all is done for the stems, rock by rock, and those of one rock alone
 * fit the fastest cache. */
static void choose_kernel(struct ceduo_run *run)
{
    bool stems = !run->wood.bare && run->def.kernel == CEDUO_KERNEL_BEST;
    run->wide_walk = ceduo_wide_walk(stems ? CEDUO_KERNEL_SCALAR : run->def.kernel, &run->lanes);
}

static bool allocate(struct ceduo_run *run)
{
    const struct ceduo_run_def *def = &run->def;
    const struct ceduo_scene *scene = &run->scene;
    bool ok = block_init(&run->whole, run->controls) && block_init(&run->tail, run->controls);
    run->slots = calloc(CHUNK_BLOCKS, sizeof *run->slots);
    ok = ok && run->slots;
    for (size_t i = 0; ok && i < CHUNK_BLOCKS; i++)
        ok = block_init(&run->slots[i], run->controls);
    if (def->cells > 0)
        ok = ok && (run->cells = calloc(def->cells, sizeof *run->cells));
    ok = ok && ceduo_wood_init(&run->wood, &scene->simulation, def->option, run->mean.mean_diameter);
    choose_kernel(run);
    ok = ok && ceduo_marks_init(&run->marks, scene, def->cells, def->cell_x);
    ok = ok && ceduo_ground_init(&run->ground, &scene->slope, scene->simulation.gravity, run->mean.radius,
                                 ceduo_rock_varies(&scene->rock));
    return ok && (!run->wide_walk || (run->wide = ceduo_wide_ground_create(&run->ground)));
}

enum ceduo_status ceduo_run_create(const struct ceduo_run_def *def, struct ceduo_run **out)
{
    *out = NULL;
    enum ceduo_status status = ceduo_scene_check(def->scene, NULL);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_run *run = calloc(1, sizeof *run);
    if (!run)
        return CEDUO_NO_MEMORY;
    run->def = *def;
    run->def.threads = def->threads > 0 ? def->threads : 1;
    run->scene = *def->scene;
    run->controls = def->scene->controls_count;
    run->exact = true;
    bool one_energy = def->scene->simulation.law == CEDUO_LAW_LUMPED && !ceduo_rock_varies(&def->scene->rock);
    run->kept = one_energy ? HEIGHT + 1 : QUANTITIES;
    run->chunk = run->def.threads < CHUNK_BLOCKS ? run->def.threads : CHUNK_BLOCKS;
    status = ceduo_rock_of_means(&def->scene->rock, &run->mean);
    if (!allocate(run) || (def->part && !begin_part(run))) {
        ceduo_run_free(run);
        return CEDUO_NO_MEMORY;
    }
    run->alike = run->wood.bare && ceduo_walk_alike(&run->scene, &run->ground);
    *out = run;
    return status;
}

void ceduo_run_free(struct ceduo_run *run)
{
    if (!run)
        return;
    free(run->whole.controls);
    free(run->tail.controls);
    for (size_t i = 0; run->slots && i < CHUNK_BLOCKS; i++)
        free(run->slots[i].controls);
    free(run->slots);
    for (size_t i = 0; i < run->kept_room; i++)
        free(run->kept_blocks[i].controls);
    free(run->kept_blocks);
    free_bins(run->bins, columns(run));
    free_samples(run);
    free(run->pairs);
    free(run->cells);
    ceduo_wood_release(&run->wood);
    ceduo_marks_release(&run->marks);
    ceduo_wide_ground_free(run->wide);
    ceduo_ground_release(&run->ground);
    free(run);
}

/* ---- reading ---- */

uint64_t ceduo_run_rocks(const struct ceduo_run *run)
{
    return run->rocks;
}

size_t ceduo_run_sample_bytes(const struct ceduo_run *run)
{
    return (size_t)(run->room * columns(run) + run->pairs_room * run->controls) * sizeof(double);
}

uint64_t ceduo_run_contacts(const struct ceduo_run *run)
{
    return run->whole.contacts + run->tail.contacts;
}

struct ceduo_stem_counts ceduo_run_stems(const struct ceduo_run *run)
{
    const struct ceduo_stem_counts *a = &run->whole.stems, *b = &run->tail.stems;
    return (struct ceduo_stem_counts){a->drawn + b->drawn, a->hit + b->hit, a->met + b->met};
}

static struct sums sums_at(const struct ceduo_run *run, size_t control)
{
    struct sums s = run->whole.controls[control];
    const struct sums *tail = &run->tail.controls[control];
    for (int q = 0; q < QUANTITIES; q++)
        ceduo_moments_merge(&s.of[q], &tail->of[q]);
    ceduo_moments_merge(&s.contacts, &tail->contacts);
    s.exceeded += tail->exceeded;
    s.unfinished += tail->unfinished;
    return s;
}

/* The values of a column that are there, in the order of the rocks. */
static size_t gather(const struct ceduo_run *run, const double *column, double *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = column[r];
    return n;
}

static struct ceduo_distribution distribution(const struct ceduo_run *run, size_t control, int q,
                                              const struct ceduo_moments *m, double *scratch)
{
    if (!run->exact)
        return ceduo_distribution_binned(&run->bins[control * (size_t)run->kept + (size_t)q], m);
    size_t n = run->room > 0 ? gather(run, samples_of(run, control, q), scratch) : 0;
    return ceduo_distribution_exact(scratch, n, m);
}

/* Energy where one mass and no spin make it follow from speed. */
static struct ceduo_distribution energy_from_speed(const struct ceduo_distribution *speed, double mass,
                                                   const struct ceduo_moments *m)
{
    struct ceduo_distribution d = {.mean = speed->mean, .se = ceduo_moments_se(m), .sd = ceduo_moments_sd(m)};
    const double from[5] = {speed->p50, speed->p95, speed->p95_lo, speed->p95_hi, speed->p99};
    double *to[5] = {&d.p50, &d.p95, &d.p95_lo, &d.p95_hi, &d.p99};
    for (int i = 0; i < 5; i++)
        *to[i] = 0.5 * mass * (from[i] * from[i]);
    d.mean = m->n > 0 ? m->mean : NAN;
    d.max = m->n > 0 ? m->max : NAN;
    return d;
}

/* Mean and standard error over all released, of whom those that do not arrive bring nothing. */
static void per_released(const struct ceduo_moments *m, uint64_t released, double *mean, double *se)
{
    double n = (double)released, share = (double)m->n / n;
    *mean = m->mean * share;
    double m2 = m->m2 + m->mean * m->mean * (double)m->n * (1 - share);
    *se = released < 2 ? NAN : sqrt(m2 / (n - 1) / n);
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    struct sums s = sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.of[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.unfinished,
                                 .exact = run->exact};
    double unused;
    double released = (double)run->rocks;
    a->reach_probability = (double)a->reached / released;
    ceduo_wilson(a->reached, run->rocks, &a->reach_lo, &a->reach_hi);
    if (s.unfinished > 0)
        ceduo_wilson(a->reached + s.unfinished, run->rocks, &unused, &a->reach_hi);
    a->exceed_probability = a->exceed_lo = a->exceed_hi = NAN;
    if (!isnan(run->scene.controls[control].accepted)) {
        a->exceed_probability = (double)a->exceeded / released;
        ceduo_wilson(a->exceeded, run->rocks, &a->exceed_lo, &a->exceed_hi);
        if (s.unfinished > 0)
            ceduo_wilson(a->exceeded + s.unfinished, run->rocks, &unused, &a->exceed_hi);
    }
    per_released(&s.of[ENERGY], run->rocks, &a->energy_per_released, &a->energy_per_released_se);
    a->contacts = !run->wood.bare && s.contacts.n > 0 ? s.contacts.mean : NAN;
    a->contacts_se = run->wood.bare ? NAN : ceduo_moments_se(&s.contacts);
    double *scratch = malloc(((size_t)run->rocks + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s.of[SPEED], scratch);
    a->height = distribution(run, control, HEIGHT, &s.of[HEIGHT], scratch);
    if (run->kept == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s.of[ENERGY], scratch);
        a->translation = distribution(run, control, TRANSLATION, &s.of[TRANSLATION], scratch);
    } else {
        a->energy = a->translation = energy_from_speed(&a->speed, run->mean.mass, &s.of[ENERGY]);
    }
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached, double *mean, double *se)
{
    struct sums s = sums_at(run, control);
    *reached = s.of[ENERGY].n;
    *mean = *reached > 0 ? s.of[ENERGY].mean : NAN;
    *se = ceduo_moments_se(&s.of[ENERGY]);
}

/* ---- differences ---- */

/* Of the rocks whose energies are known. */
static uint64_t paired_rocks(const struct ceduo_run *run)
{
    return run->exact || run->rocks < run->pairs_room ? run->rocks : run->pairs_room;
}

static double paired_energy(const struct ceduo_run *run, size_t control, uint64_t rock)
{
    return run->exact ? energy_of(run, control, rock) : run->pairs[control * run->pairs_room + rock];
}

/* A mean of all rocks with the spread of those that are paired. */
static struct ceduo_paired paired(double mean, const struct ceduo_moments *m, uint64_t rocks)
{
    return (struct ceduo_paired){mean, ceduo_moments_sd(m) / sqrt((double)rocks)};
}

struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline,
                                             size_t control)
{
    struct ceduo_moments reach = {0}, exceed = {0}, energy = {0};
    double accepted = run->scene.controls[control].accepted, n = (double)run->rocks;
    const struct ceduo_paired unknown = {NAN, NAN};
    if (run->rocks != baseline->rocks)
        return (struct ceduo_difference){unknown, unknown, unknown};
    uint64_t a = paired_rocks(run), b = paired_rocks(baseline), rocks = a < b ? a : b;
    for (uint64_t r = 0; r < rocks; r++) {
        double e = paired_energy(run, control, r), f = paired_energy(baseline, control, r);
        ceduo_moments_add(&reach, (double)!isnan(e) - (double)!isnan(f));
        ceduo_moments_add(&exceed, (double)(e > accepted) - (double)(f > accepted));
        ceduo_moments_add(&energy, (isnan(e) ? 0 : e) - (isnan(f) ? 0 : f));
    }
    struct sums s = sums_at(run, control), t = sums_at(baseline, control);
    const struct ceduo_moments *e = &s.of[ENERGY], *f = &t.of[ENERGY];
    struct ceduo_difference d = {
        .reach_probability = paired(((double)e->n - (double)f->n) / n, &reach, run->rocks),
        .exceed_probability = paired(((double)s.exceeded - (double)t.exceeded) / n, &exceed, run->rocks),
        .energy_per_released = paired((e->mean * (double)e->n - f->mean * (double)f->n) / n, &energy, run->rocks)};
    if (isnan(accepted))
        d.exceed_probability = unknown;
    return d;
}

enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    *ends = (struct ceduo_ends){.stop_p50 = NAN, .stop_p95 = NAN, .stop_max = NAN};
    if (run->def.arrivals_only)
        return CEDUO_OK;
    ends->stop_x = run->whole.stop_x;
    for (int e = 0; e < CEDUO_ENDS; e++)
        ends->count[e] = run->whole.ends[e] + run->tail.ends[e];
    ceduo_moments_merge(&ends->stop_x, &run->tail.stop_x);
    if (ends->stop_x.n == 0)
        return CEDUO_OK;
    ends->stop_max = ends->stop_x.max;
    size_t n = (size_t)ends->stop_x.n;
    size_t r50 = ceduo_quantile_rank(n, 0.5), r95 = ceduo_quantile_rank(n, 0.95);
    if (!run->exact) {
        const struct histogram *h = &run->bins[columns(run) - 1];
        ends->stop_p50 = ceduo_histogram_value(h, r50);
        ends->stop_p95 = ceduo_histogram_value(h, r95);
        return CEDUO_OK;
    }
    double *scratch = malloc((n + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    gather(run, stops_of(run), scratch);
    struct ceduo_distribution d = ceduo_distribution_exact(scratch, n, &ends->stop_x);
    ends->stop_p50 = d.p50;
    ends->stop_p95 = d.p95;
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_envelope(const struct ceduo_run *run, size_t cell, struct ceduo_envelope *envelope)
{
    ceduo_envelope_read(&run->cells[cell], envelope);
}

size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t most)
{
    size_t n = 0;
    if (run->room == 0)
        return 0;
    bool from_speed = run->kept != QUANTITIES;
    const double *column = samples_of(run, control, from_speed ? SPEED : ENERGY);
    for (uint64_t r = 0; r < run->rocks && n < most; r++)
        if (!isnan(column[r]))
            to[n++] = from_speed ? 0.5 * run->mean.mass * (column[r] * column[r]) : column[r];
    return n;
}

/* ---- parts ---- */

static void pack_moments(struct bytes *b, struct ceduo_moments *m)
{
    ceduo_bytes_count(b, &m->n);
    ceduo_bytes_number(b, &m->mean);
    ceduo_bytes_number(b, &m->m2);
    ceduo_bytes_number(b, &m->max);
}

static void pack_block(struct bytes *b, struct block *block, size_t controls)
{
    ceduo_bytes_count(b, &block->contacts);
    for (int e = 0; e < CEDUO_ENDS; e++)
        ceduo_bytes_count(b, &block->ends[e]);
    ceduo_bytes_count(b, &block->stems.drawn);
    ceduo_bytes_count(b, &block->stems.hit);
    ceduo_bytes_count(b, &block->stems.met);
    pack_moments(b, &block->stop_x);
    for (size_t c = 0; c < controls; c++) {
        struct sums *s = &block->controls[c];
        for (int q = 0; q < QUANTITIES; q++)
            pack_moments(b, &s->of[q]);
        pack_moments(b, &s->contacts);
        ceduo_bytes_count(b, &s->exceeded);
        ceduo_bytes_count(b, &s->unfinished);
    }
}

static bool is_plain_zero(double value)
{
    return value == 0 && !signbit(value);
}

/* Of nothing they are 0: anything else would get lost where they are merged. */
static bool good_moments(const struct ceduo_moments *m, uint64_t n)
{
    if (m->n == 0 && !(is_plain_zero(m->mean) && is_plain_zero(m->m2) && is_plain_zero(m->max)))
        return false;
    return m->n == n && isfinite(m->mean) && isfinite(m->m2) && isfinite(m->max) && m->m2 >= 0;
}

/* Whether the counts of a block agree with each other: of so many rocks, and so many that hit stems where there are. */
static bool good_block(const struct ceduo_run *run, const struct block *block, uint64_t rocks)
{
    uint64_t ends = 0, stops = block->ends[CEDUO_AT_REST] + block->ends[CEDUO_STOPPED_BY_STEMS];
    for (int e = 0; e < CEDUO_ENDS; e++) {
        if (block->ends[e] > rocks)
            return false;
        ends += block->ends[e];
    }
    if (ends != rocks || !good_moments(&block->stop_x, stops))
        return false;
    for (size_t c = 0; c < run->controls; c++) {
        const struct sums *s = &block->controls[c];
        uint64_t reached = s->of[SPEED].n;
        if (reached > rocks || s->unfinished > rocks - reached || s->exceeded > reached ||
            !good_moments(&s->contacts, run->wood.bare ? 0 : reached))
            return false;
        for (int q = 0; q < QUANTITIES; q++)
            if (!good_moments(&s->of[q], reached))
                return false;
    }
    return true;
}

/* What a part begins with: its rocks, and what decides the shape of the rest. */
struct part_head {
    uint64_t first, end, rocks, controls, kept, bare, exact, pairs;
};

static void pack_head(struct bytes *b, struct part_head *h)
{
    uint64_t *const counts[] = {&h->first, &h->end, &h->rocks, &h->controls, &h->kept, &h->bare, &h->exact, &h->pairs};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        ceduo_bytes_count(b, counts[i]);
}

static struct part_head head_of(const struct ceduo_run *run, uint64_t first, uint64_t end)
{
    return (struct part_head){first,
                              end,
                              run->def.rocks_most,
                              run->controls,
                              (uint64_t)run->kept,
                              run->wood.bare,
                              run->exact,
                              run->pairs_room};
}

/* The first rocks' energies that lie in a part. */
static uint64_t pairs_of(const struct ceduo_run *run, uint64_t first, uint64_t end)
{
    uint64_t to = end < run->pairs_room ? end : run->pairs_room;
    return to > first ? to - first : 0;
}

/* The samples of rocks first…end - 1, or the histograms, in `bins`. `reached[control]`, then the stops: how many there
 * are; where they are read, how many there must be. False: not those, or no memory. */
static bool pack_samples(struct ceduo_run *run, struct bytes *b, uint64_t first, uint64_t end, struct histogram *bins,
                         uint64_t *reached)
{
    size_t n = (size_t)(end - first), from = (size_t)(first - run->first);
    uint64_t there;
    for (size_t c = 0; c <= run->controls; c++) {
        int kept = c < run->controls ? run->kept : 1;
        double *column = run->exact ? samples_of(run, c, SPEED) + from : NULL;
        if (run->exact && (!ceduo_bytes_column(b, column, n, &there) || (b->reads && there != reached[c])))
            return false;
        for (int q = 0; q < kept; q++) {
            if (run->exact && q > 0 && !ceduo_bytes_column_as(b, column, samples_of(run, c, q) + from, n))
                return false;
            struct histogram *h = run->exact ? NULL : bins_of(bins, run, c, q);
            if (h && (!ceduo_histogram_pack(h, b, n) || (b->reads && h->n != reached[c])))
                return false;
        }
    }
    n = (size_t)pairs_of(run, first, end);
    for (size_t c = 0; n > 0 && c < run->controls; c++)
        if (!ceduo_bytes_column(b, &run->pairs[c * run->pairs_room + first], n, &there) ||
            (b->reads && there > reached[c]))
            return false;
    return true;
}

/* The blocks of a part: those that are kept, and the one that is not full. */
static void save_blocks(const struct ceduo_run *run, struct bytes *b)
{
    for (size_t i = 0; i < run->kept_count; i++)
        pack_block(b, &run->kept_blocks[i], run->controls);
    struct block tail = run->tail;
    if (run->rocks % CEDUO_BLOCK_ROCKS != 0)
        pack_block(b, &tail, run->controls);
}

enum ceduo_status ceduo_run_pack(const struct ceduo_run *run, struct bytes *b)
{
    struct ceduo_run from = *run; /* it is only read */
    struct part_head head = head_of(run, run->first, run->rocks);
    uint64_t *reached = calloc(run->controls + 1, sizeof *reached);
    pack_head(b, &head);
    save_blocks(run, b);
    bool good = reached && (run->rocks == run->first ||
                            pack_samples(&from, b, run->first, run->rocks, from.bins, reached));
    free(reached);
    return good && !b->no_memory ? CEDUO_OK : CEDUO_NO_MEMORY;
}

/* Reads the blocks of a part into `block`, one after the other. Merges them where `merges`; otherwise checks them and
 * adds up what reached each control, and the stops. */
static bool read_blocks(struct ceduo_run *run, struct bytes *b, const struct part_head *head, struct block *block,
                        uint64_t *reached, bool merges)
{
    for (uint64_t at = head->first; at < head->end; at += CEDUO_BLOCK_ROCKS) {
        uint64_t rocks = head->end - at < CEDUO_BLOCK_ROCKS ? head->end - at : CEDUO_BLOCK_ROCKS;
        block_clear(block, run->controls);
        pack_block(b, block, run->controls);
        if (merges) {
            block_merge(rocks == CEDUO_BLOCK_ROCKS ? &run->whole : &run->tail, block, run->controls);
            continue;
        }
        if (b->bad || !good_block(run, block, rocks))
            return false;
        for (size_t c = 0; c < run->controls; c++)
            reached[c] += block->controls[c].of[SPEED].n;
        reached[run->controls] += block->stop_x.n;
    }
    return true;
}

static bool good_head(const struct ceduo_run *run, const struct part_head *h)
{
    struct part_head own = head_of(run, run->rocks, h->end);
    bool whole_blocks = h->first % CEDUO_BLOCK_ROCKS == 0 && (h->end % CEDUO_BLOCK_ROCKS == 0 || h->end == h->rocks);
    return memcmp(h, &own, sizeof own) == 0 && whole_blocks && h->end >= h->first && h->end <= h->rocks;
}

/* Everything is read and checked before the run is changed; samples behind its last rock are nobody's yet. */
static enum ceduo_status adopt(struct ceduo_run *run, struct bytes *b, struct block *block, struct histogram *bins,
                               uint64_t *reached)
{
    struct part_head head;
    pack_head(b, &head);
    if (b->bad || !good_head(run, &head))
        return CEDUO_BAD_PART;
    struct bytes blocks = *b;
    bool good = read_blocks(run, b, &head, block, reached, false) &&
                (head.end == head.first || pack_samples(run, b, head.first, head.end, bins, reached));
    if (b->no_memory)
        return CEDUO_NO_MEMORY;
    if (!good || b->bad || ceduo_bytes_left(b) > 0)
        return CEDUO_BAD_PART;
    for (size_t i = 0; !run->exact && i < columns(run); i++)
        if (!ceduo_histogram_reserve(&run->bins[i], &bins[i]))
            return CEDUO_NO_MEMORY;
    for (size_t i = 0; !run->exact && i < columns(run); i++)
        ceduo_histogram_merge(&run->bins[i], &bins[i]);
    read_blocks(run, &blocks, &head, block, reached, true);
    run->rocks = head.end;
    return CEDUO_OK;
}

enum ceduo_status ceduo_run_adopt(struct ceduo_run *run, const unsigned char *bytes, size_t n)
{
    bool fits = fits_exact(run, run->def.rocks_most);
    if (run->def.part || run->def.cells > 0)
        return CEDUO_BAD_PART;
    if (run->exact && !(fits ? grow_samples(run, run->def.rocks_most) : bin_samples(run)))
        return CEDUO_NO_MEMORY;
    struct bytes b = {.reads = true, .from = bytes, .length = n};
    struct block block;
    struct histogram *bins = calloc(columns(run), sizeof *bins);
    uint64_t *reached = calloc(run->controls + 1, sizeof *reached);
    bool ready = block_init(&block, run->controls) && bins && reached;
    enum ceduo_status status = ready ? adopt(run, &b, &block, bins, reached) : CEDUO_NO_MEMORY;
    free_bins(bins, columns(run));
    free(reached);
    free(block.controls);
    return status;
}
