/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* ---- sums ---- */

bool ceduo_run_block_init(struct block *b, size_t controls)
{
    *b = (struct block){.controls = calloc(controls + 1, sizeof(struct sums))};
    return b->controls != NULL;
}

void ceduo_run_block_clear(struct block *b, size_t controls)
{
    struct sums *keep = b->controls;
    memset(keep, 0, controls * sizeof *keep);
    *b = (struct block){.controls = keep};
}

static void merge_sums(struct sums *into, const struct sums *from)
{
    for (int q = 0; q < QUANTITIES; q++)
        ceduo_moments_merge(&into->of[q], &from->of[q]);
    ceduo_moments_merge(&into->contacts, &from->contacts);
    into->exceeded += from->exceeded;
    into->hits.t += from->hits.t;
    into->hits.tt += from->hits.tt;
    into->hits.tw += from->hits.tw;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        into->ended[e] += from->ended[e];
        into->missed[e] += from->missed[e];
    }
}

void ceduo_run_block_merge(struct block *into, const struct block *from, size_t controls)
{
    into->contacts += from->contacts;
    into->uphill += from->uphill;
    into->early += from->early;
    into->stems.drawn += from->stems.drawn;
    into->stems.hit += from->stems.hit;
    into->stems.met += from->stems.met;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        into->ends[e] += from->ends[e];
        into->ended[e] += from->ended[e];
    }
    ceduo_moments_merge(&into->stop_x, &from->stop_x);
    for (size_t c = 0; c < controls; c++)
        merge_sums(&into->controls[c], &from->controls[c]);
}

struct sums ceduo_run_sums_at(const struct ceduo_run *run, size_t control)
{
    struct sums s = run->whole.controls[control];
    merge_sums(&s, &run->tail.controls[control]);
    return s;
}

/* ---- samples ---- */

bool ceduo_run_samples_reserve(struct ceduo_run *run, uint64_t rocks)
{
    if (rocks <= run->capacity)
        return true;
    uint64_t capacity = 2 * run->capacity < run->def.rocks_most ? 2 * run->capacity : run->def.rocks_most;
    capacity = capacity < rocks ? rocks : capacity;
    double *weights = run->sized ? realloc(run->weights, (size_t)capacity * sizeof *weights) : NULL;
    if (run->sized && !weights)
        return false;
    run->weights = weights;
    for (uint64_t i = run->capacity; run->sized && i < capacity; i++)
        weights[i] = ceduo_rock_size(&run->prepared.sizes, i).weight;
    if (!run->samples && !(run->samples = calloc(run->columns, sizeof *run->samples)))
        return false;
    for (size_t i = 0; i < run->columns; i++) { /* each by itself: never are all there twice */
        double *grown = realloc(run->samples[i], (size_t)capacity * sizeof(double));
        if (!grown)
            return false;
        run->samples[i] = grown;
    }
    run->capacity = capacity;
    return true;
}

void ceduo_run_samples_free(struct ceduo_run *run)
{
    for (size_t i = 0; run->samples && i < run->columns; i++)
        free(run->samples[i]);
    free(run->samples);
    free(run->weights);
}
