/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

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
    into->unfinished += from->unfinished;
}

void ceduo_run_block_merge(struct block *into, const struct block *from, size_t controls)
{
    into->contacts += from->contacts;
    into->stems.drawn += from->stems.drawn;
    into->stems.hit += from->stems.hit;
    into->stems.met += from->stems.met;
    for (int e = 0; e < CEDUO_ENDS; e++)
        into->ends[e] += from->ends[e];
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
