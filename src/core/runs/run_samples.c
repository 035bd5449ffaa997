/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* ---- sums ---- */

bool ceduo_run_batch_init(struct batch *b, size_t controls)
{
    *b = (struct batch){.controls = calloc(controls + 1, sizeof(struct sums))};
    return b->controls != NULL;
}

void ceduo_run_batch_clear(struct batch *b, size_t controls)
{
    struct sums *keep = b->controls;
    memset(keep, 0, controls * sizeof *keep);
    *b = (struct batch){.controls = keep};
}

static void merge_sums(struct sums *into, const struct sums *from)
{
    for (int q = 0; q < QUANTITIES; q++)
        ceduo_moments_merge(&into->moments[q], &from->moments[q]);
    ceduo_moments_merge(&into->contacts, &from->contacts);
    into->exceeded += from->exceeded;
    into->hits.t += from->hits.t;
    into->hits.tt += from->hits.tt;
    into->hits.tw += from->hits.tw;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        into->end_counts[e] += from->end_counts[e];
        into->end_weights[e] += from->end_weights[e];
    }
}

void ceduo_run_batch_merge(struct batch *into, const struct batch *from, size_t controls)
{
    into->contacts += from->contacts;
    into->uphill += from->uphill;
    into->early += from->early;
    into->stems.drawn += from->stems.drawn;
    into->stems.hit += from->stems.hit;
    into->stems.met += from->stems.met;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        into->ends[e] += from->ends[e];
        into->end_weights[e] += from->end_weights[e];
    }
    ceduo_moments_merge(&into->stop_x, &from->stop_x);
    for (size_t c = 0; c < controls; c++)
        merge_sums(&into->controls[c], &from->controls[c]);
}

struct sums ceduo_run_sums_at(const struct ceduo_run *run, size_t control)
{
    struct sums s = run->complete.controls[control];
    merge_sums(&s, &run->tail.controls[control]);
    return s;
}

/* ---- samples ---- */

bool ceduo_run_samples_reserve(struct ceduo_run *run, uint64_t rocks)
{
    if (rocks <= run->capacity)
        return true;
    uint64_t capacity = 2 * run->capacity < run->def.rocks_max ? 2 * run->capacity : run->def.rocks_max;
    capacity = capacity < rocks ? rocks : capacity;
    double *weights = run->weighted ? realloc(run->weights, (size_t)capacity * sizeof *weights) : NULL;
    if (run->weighted && !weights)
        return false;
    run->weights = weights;
    for (uint64_t i = run->capacity; run->weighted && i < capacity; i++)
        weights[i] = ceduo_rock_size(&run->prepared.sizes, i).weight;
    if (!run->samples && !(run->samples = calloc(run->columns, sizeof *run->samples)))
        return false;
    for (size_t i = 0; i < run->columns; i++) { /* one by one, so that at most one column exists twice */
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
