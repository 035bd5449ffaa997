/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lanes.h"

#include <stdlib.h>

_Static_assert(sizeof(struct ground_vertex) == 16, "a vertex is a pair of numbers");
_Static_assert(sizeof(struct ground_segment) == (size_t)16 << SEGMENT_SHIFT, "a segment is pairs of numbers");

/* Set a table of `entries` pairs from `first` on, with a stride of `1 << shift` pairs. */
static void set_table(struct lanes_table *t, const void *first, int shift, size_t entries)
{
    t->pairs = (const double(*)[2])first;
    for (size_t i = 0; i < entries && i < TABLE_SMALL; i++) {
        t->first[i] = t->pairs[i << shift][0];
        t->second[i] = t->pairs[i << shift][1];
    }
}

struct lanes_ground *ceduo_lanes_ground_create(const struct ground *g)
{
    struct lanes_ground *lanes = aligned_alloc(_Alignof(struct lanes_ground), sizeof *lanes);
    if (!lanes)
        return NULL;
    *lanes = (struct lanes_ground){0};
    size_t entries = g->n + 3;
    lanes->small = entries <= TABLE_SMALL;
    const struct ground_segment *before = g->segments - 1;
    set_table(&lanes->vertices, g->vertices - 1, 0, entries);
    set_table(&lanes->lengths, &before->length, SEGMENT_SHIFT, entries);
    set_table(&lanes->tangents, &before->c, SEGMENT_SHIFT, entries);
    set_table(&lanes->restitutions, &before->rn, SEGMENT_SHIFT, entries);
    set_table(&lanes->frictions, &before->mu, SEGMENT_SHIFT, entries);
    lanes->small_facets = true;
    for (size_t j = 0; j < g->n; j++)
        lanes->small_facets &= g->segments[j].theta <= HALF_TURN / 4;
    return lanes;
}
