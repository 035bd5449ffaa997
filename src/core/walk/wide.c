/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wide.h"

#include <stdlib.h>

#include "kernel.h"

#define SEGMENT_SHIFT 2
_Static_assert(sizeof(struct ground_vertex) == 16, "a vertex is a pair of numbers");
_Static_assert(sizeof(struct ground_segment) == (size_t)16 << SEGMENT_SHIFT, "a segment is pairs of numbers");

/* A table of `entries` pairs that begin at `first`, `1 << shift` pairs from one to the next. */
static void set_table(struct wide_table *t, const void *first, int shift, size_t entries)
{
    t->pairs = (const double(*)[2])first;
    t->shift = shift;
    for (size_t i = 0; i < entries && i < TABLE_SMALL; i++) {
        t->first[i] = t->pairs[i << shift][0];
        t->second[i] = t->pairs[i << shift][1];
    }
}

struct wide_ground *ceduo_wide_ground_create(const struct ground *g)
{
    struct wide_ground *wide = aligned_alloc(_Alignof(struct wide_ground), sizeof *wide);
    if (!wide)
        return NULL;
    *wide = (struct wide_ground){0};
    size_t entries = g->n + 3;
    wide->small = entries <= TABLE_SMALL;
    const struct ground_segment *before = g->segments - 1;
    set_table(&wide->place, g->at - 1, 0, entries);
    set_table(&wide->slope, &before->m, SEGMENT_SHIFT, entries);
    set_table(&wide->tilt, &before->c, SEGMENT_SHIFT, entries);
    set_table(&wide->share, &before->rn, SEGMENT_SHIFT, entries);
    set_table(&wide->grip, &before->mu, SEGMENT_SHIFT, entries);
    return wide;
}

wide_walk_fn *ceduo_wide_walk(enum ceduo_kernel kernel, size_t *lanes)
{
#if defined(__x86_64__) && defined(__GNUC__)
    kernel = ceduo_kernel_here(kernel);
    if (kernel == CEDUO_KERNEL_AVX512) {
        *lanes = 32;
        return ceduo_wide_walk_avx512;
    }
    if (kernel == CEDUO_KERNEL_AVX2) {
        *lanes = 8;
        return ceduo_wide_walk_avx2;
    }
#else
    (void)kernel;
#endif
    *lanes = 1;
    return NULL;
}
