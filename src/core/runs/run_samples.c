/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
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

/* With one column more, in which they are sorted. */
static bool samples_fit(const struct ceduo_run *run, uint64_t rocks)
{
    return run->sized || (double)rocks * (double)(run->columns + 1) * sizeof(double) <= (double)run->def.exact_bytes;
}

/* Makes room for the samples of `rocks` rocks. Each column grows by itself: never are all there twice. */
static bool grow_samples(struct ceduo_run *run, uint64_t rocks)
{
    if (rocks <= run->room)
        return true;
    uint64_t room = 2 * run->room;
    room = room < rocks || !samples_fit(run, room) ? rocks : room;
    double *weights = run->sized ? realloc(run->weights, (size_t)room * sizeof *weights) : NULL;
    if (run->sized && !weights)
        return false;
    run->weights = weights;
    for (uint64_t i = run->room; run->sized && i < room; i++)
        weights[i] = ceduo_size_of(&run->ready.sizes, i).weight;
    if (!run->samples && !(run->samples = calloc(run->columns, sizeof *run->samples)))
        return false;
    for (size_t i = 0; i < run->columns; i++) {
        double *grown = realloc(run->samples[i], (size_t)room * sizeof(double));
        if (!grown)
            return false;
        run->samples[i] = grown;
    }
    run->room = room;
    return true;
}

void ceduo_run_samples_free(struct ceduo_run *run)
{
    for (size_t i = 0; run->samples && i < run->columns; i++)
        free(run->samples[i]);
    free(run->samples);
    free(run->weights);
    run->samples = NULL;
    run->weights = NULL;
    run->room = 0;
}

double ceduo_run_sample_energy(const struct ceduo_run *run, size_t control, uint64_t rock)
{
    if (run->kept == QUANTITIES)
        return samples_of(run, control, ENERGY)[rock];
    double speed = samples_of(run, control, SPEED)[rock];
    return 0.5 * run->ready.mean.mass * (speed * speed);
}

/* From samples to histograms: there are now too many rocks to keep. The first rocks' energies stay. */
static bool bin_samples(struct ceduo_run *run)
{
    size_t controls = run->controls;
    uint64_t room = controls > 0 ? run->def.exact_bytes / sizeof(double) / controls : 0;
    room = room < CEDUO_PAIRED_ROCKS ? room : CEDUO_PAIRED_ROCKS;
    struct histogram *bins = calloc(run->columns, sizeof *bins);
    double *pairs = malloc(((size_t)room * controls + 1) * sizeof *pairs);
    bool good = bins && pairs;
    for (size_t i = 0; run->room > 0 && i < run->columns; i++)
        for (uint64_t r = 0; good && r < run->rocks; r++)
            good = isnan(run->samples[i][r]) || ceduo_histogram_add(&bins[i], run->samples[i][r]);
    if (!good) {
        ceduo_histograms_free(bins, run->columns);
        free(pairs);
        return false;
    }
    for (size_t c = 0; c < controls; c++)
        for (uint64_t r = 0; run->room > 0 && r < run->rocks && r < room; r++) /* untaken: large */
            pairs[c * room + r] = ceduo_run_sample_energy(run, c, r);
    ceduo_run_samples_free(run);
    run->bins = bins;
    run->pairs = pairs;
    run->pairs_room = room;
    run->exact = false;
    return true;
}

bool ceduo_run_samples_prepare(struct ceduo_run *run, uint64_t rocks)
{
    if (!run->exact)
        return true;
    return samples_fit(run, rocks) ? grow_samples(run, rocks) : bin_samples(run);
}
