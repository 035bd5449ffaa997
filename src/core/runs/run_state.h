/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_STATE_H
#define CEDUO_RUN_STATE_H

#include "core/walk/lanes.h"
#include "core/walk/prepared.h"
#include "statistics.h"
#include "weighted.h"

/* Internals of a run; included only by run*.c.
 *
 *     run.c          creates, extends and frees a run, chunk by chunk
 *     run_simulate.c simulates the rocks of one chunk on several threads
 *     run_samples.c  sums of a batch, merged in order; samples of each rock
 *     run_read.c     arrivals, differences and ends, from sums and samples; with weights only from samples
 *     run_fence.c    arrivals at a fence, from samples */

#ifndef CHUNK_BATCHES
#define CHUNK_BATCHES 256 /* maximum batches per chunk; bounds the memory of their sums */
#endif

enum quantity { SPEED, HEIGHT, ENERGY, TRANSLATION, QUANTITIES };

/* Sums at one control. The number of rocks that do not arrive follows from the counts. */
struct sums {
    struct ceduo_moments moments[QUANTITIES], contacts; /* contacts: stems hit before the control */
    uint64_t exceeded, end_counts[CEDUO_ENDS];          /* end_counts: rocks that did not arrive, by their end */
    double end_weights[CEDUO_ENDS];                     /* likewise, sums of weights; 0 if rocks have no weights */
    struct weighted_sum hits;                           /* contacts, with weights */
};

/* Sums of a batch: summed rock by rock and merged batch by batch, in order. */
struct batch {
    uint64_t contacts, ends[CEDUO_ENDS];
    uint64_t uphill, early;         /* see struct ceduo_ends */
    double end_weights[CEDUO_ENDS]; /* sums of weights per end; 0 if rocks have no weights */
    struct ceduo_stem_counts stems;
    struct ceduo_moments stop_x;
    struct sums *controls;
};

struct ceduo_run {
    struct ceduo_run_def def;
    struct prepared_scene prepared;
    struct lanes_ground *lanes_ground;
    void (*walk_lanes)(const struct lanes_job *job); /* NULL: simulate rocks one by one */
    size_t lanes;                                    /* rocks simulated at once by a thread */
    size_t controls;
    double stems_from;     /* ceduo_option_forest_begin(), because the option may be freed before the run is read */
    int quantities;        /* number of quantities with samples; without spin and spread all energy is translational */
    size_t columns;        /* columns of samples: controls × quantities, then the stops */
    uint64_t rocks;        /* finished */
    size_t chunk;          /* batches of the next chunk */
    struct batch complete; /* sum of all complete batches */
    struct batch tail;     /* the last, incomplete batch */
    struct batch *slots;   /* [slots_count]; batches of the current chunk */
    size_t slots_count;    /* CHUNK_BATCHES, or fewer for a short run */
    bool weighted;         /* rocks have weights */
    double *weights;       /* [capacity] */
    bool identical;        /* the rocks differ only in their numbers */
    uint64_t capacity;     /* of the samples, in rocks */
    double **samples;      /* [columns][capacity]; NaN: did not arrive, or did not stop */
};

/* Return a column of samples; NULL before the first rock. */
static inline double *get_samples(const struct ceduo_run *run, size_t control, int quantity)
{
    return run->samples ? run->samples[control * (size_t)run->quantities + (size_t)quantity] : NULL;
}

static inline double *get_stops(const struct ceduo_run *run)
{
    return run->samples ? run->samples[run->columns - 1] : NULL;
}

static inline double get_weight(const struct ceduo_run *run, uint64_t rock)
{
    return run->weighted ? run->weights[rock] : 1;
}

/* ---- sums ---- */

bool ceduo_run_batch_init(struct batch *b, size_t controls); /* false without memory */
void ceduo_run_batch_clear(struct batch *b, size_t controls);
void ceduo_run_batch_merge(struct batch *into, const struct batch *from, size_t controls);
/* Return the sums over all rocks of the run. */
struct sums ceduo_run_sums_at(const struct ceduo_run *run, size_t control);

/* Return the totals of all released rocks of a run with weights. `missing`: weight of unfinished rocks. */
struct weight_totals ceduo_run_weight_totals(const struct ceduo_run *run, double missing);

/* Return a share of n rocks; the upper limit counts unfinished rocks as hits. */
static inline struct ceduo_estimate ceduo_run_share(uint64_t hits, uint64_t unfinished, uint64_t n)
{
    return ceduo_wilson((double)hits / (double)n, (double)(hits + unfinished) / (double)n, (double)n);
}

/* Set the limits of arrivals by a scene, which may differ from that of the run in its accepted return periods. */
void ceduo_arrivals_set_limit(struct ceduo_arrivals *arrivals, const struct ceduo_scene *scene, size_t control);

struct ceduo_group_means;

/* Set the defeated shares of the groups of ceduo_run_group_means(). Requires a fence at the control. */
void ceduo_run_group_defeats(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs);

/* ---- samples ---- */

bool ceduo_run_samples_reserve(struct ceduo_run *run, uint64_t rocks); /* false without memory */
void ceduo_run_samples_free(struct ceduo_run *run);

/* ---- simulating ---- */

/* Simulate one chunk, up to rock `end`. On failure the run is unchanged. */
enum ceduo_status ceduo_run_simulate_chunk(struct ceduo_run *run, uint64_t end);

#endif
