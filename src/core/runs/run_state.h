/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_STATE_H
#define CEDUO_RUN_STATE_H

#include "ceduo/run.h"
#include "core/walk/lanes.h"
#include "core/walk/prepared.h"
#include "weighted.h"

/* A run from inside; only the run*.c include this.
 *
 *     run.c          makes, extends and frees a run, chunk by chunk
 *     run_simulate.c simulates the rocks of one chunk on several threads
 *     run_samples.c  sums of a block, merged in the order of the blocks; samples of each rock
 *     run_read.c     arrivals, differences and ends, read from sums and samples; if rocks have weights, from samples alone */

#ifndef CHUNK_BLOCKS
#define CHUNK_BLOCKS 256 /* blocks in work at a time: this bounds the memory of their sums */
#endif

enum quantity { SPEED, HEIGHT, ENERGY, TRANSLATION, QUANTITIES };

/* What is summed at one control. Released rocks that do not arrive are known from the counts. */
struct sums {
    struct ceduo_moments of[QUANTITIES], contacts; /* contacts: stems hit before */
    uint64_t exceeded, ended[CEDUO_ENDS];          /* ended: rocks that did not arrive, by how they ended */
    double missed[CEDUO_ENDS];                     /* the same by their weights, where rocks have any */
    struct weighted_sum hits;                      /* contacts by them */
};

/* Rocks done in order, summed in order: blocks are summed rock by rock and merged block by block. */
struct block {
    uint64_t contacts, ends[CEDUO_ENDS];
    uint64_t uphill, early;   /* of those that left the slope, and of those that stems stopped: see struct ceduo_ends */
    double ended[CEDUO_ENDS]; /* ends by the weights of the rocks, where they have any */
    struct ceduo_stem_counts stems;
    struct ceduo_moments stop_x;
    struct sums *controls;
};

struct ceduo_run {
    struct ceduo_run_def def;
    struct prepared_scene prepared;
    struct lanes_ground *ground_of_lanes;
    void (*lanes_walk)(const struct lanes_job *job); /* NULL: rocks are simulated one by one */
    size_t lanes;                                    /* rocks that a thread simulates at once */
    size_t controls;
    double stems_from;   /* as ceduo_option_stems_from(): the option may be gone when the run is read */
    int kept;            /* quantities that have samples: without spin and spread all energy is translation */
    size_t columns;      /* of samples: controls times kept, then the stops */
    uint64_t rocks;      /* done */
    size_t chunk;        /* blocks to take on next */
    struct block whole;  /* all whole blocks */
    struct block tail;   /* the block that is not full yet */
    struct block *slots; /* in work, `slots_count` */
    size_t slots_count;  /* CHUNK_BLOCKS, or as many as the run can have */
    bool sized;          /* rocks have weights */
    double *weights;     /* [capacity] */
    bool identical;      /* the rocks differ in nothing but their numbers */
    uint64_t capacity;   /* of the samples, in rocks */
    double **samples;    /* [columns][capacity]; NaN: the rock did not arrive, or did not stop */
};

/* NULL before the first rock. */
static inline double *samples_of(const struct ceduo_run *run, size_t control, int quantity)
{
    return run->samples ? run->samples[control * (size_t)run->kept + (size_t)quantity] : NULL;
}

static inline double *stops_of(const struct ceduo_run *run)
{
    return run->samples ? run->samples[run->columns - 1] : NULL;
}

/* ---- sums ---- */

bool ceduo_run_block_init(struct block *b, size_t controls); /* false without memory */
void ceduo_run_block_clear(struct block *b, size_t controls);
void ceduo_run_block_merge(struct block *into, const struct block *from, size_t controls);
/* All rocks of the run. */
struct sums ceduo_run_sums_at(const struct ceduo_run *run, size_t control);

/* ---- samples ---- */

bool ceduo_run_samples_reserve(struct ceduo_run *run, uint64_t rocks); /* false without memory */
void ceduo_run_samples_free(struct ceduo_run *run);

/* ---- simulating ---- */

/* Simulates one chunk, from where the run stands to rock `end`. On failure the run is as it was before. */
enum ceduo_status ceduo_run_simulate_chunk(struct ceduo_run *run, uint64_t end);

#endif
