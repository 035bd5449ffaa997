/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENVELOPE_H
#define CEDUO_ENVELOPE_H

#include <string.h>

#include "ceduo/run.h"

/* Coarse counts for pictures: 1/32 of an octave, 40 octaves; the first bin holds all that is smaller, the last all that is
 * larger. */
#define ENVELOPE_BINS       (40 * 32)
#define ENVELOPE_QUANTITIES 3 /* speed, height, energy */
#define ENVELOPE_VECTOR     8 /* numbers that a vector may read or write behind the last cell */

/* The smallest octaves begin at a millimetre, or a millimetre a second, and at 1/16 J. */
static const double envelope_min[ENVELOPE_QUANTITIES] = {0x1p-10, 0x1p-10, 0x1p-4};
static const double envelope_max[ENVELOPE_QUANTITIES] = {0x1.fffffffffffffp29, 0x1.fffffffffffffp29, 0x1.fffffffffffffp35};

/* What is counted of a value within them: its exponent, and the first 5 bits behind the point. */
#define ENVELOPE_SHIFT 47

/* All that was counted in a cell, the last place of `bins` for rocks that did not pass. */
struct envelope_cell {
    double max[ENVELOPE_QUANTITIES];
    uint32_t bins[ENVELOPE_QUANTITIES][ENVELOPE_BINS + 1];
};

/* A rock's way through all cells: what is counted in each. */
struct envelope_row {
    uint16_t *at[ENVELOPE_QUANTITIES]; /* [cell], and room for a vector; NULL: it is not shown */
    double *max[ENVELOPE_QUANTITIES];  /* likewise: the largest of all rocks */
};

/* One thread's envelopes. Rows wait until there are some: a rock goes through all cells, and one bin in each of them, every
 * time in another place, is more than fits a fast cache. */
struct envelopes {
    size_t n, lanes, waiting;
    struct envelope_row *rows;   /* those of the rocks under way, then those that wait, and others without use */
    struct envelope_cell *cells; /* their `max` is not used here */
    uint16_t *places;
    double *max;
};

/* False without memory; release it in any case. */
bool ceduo_envelopes_init(struct envelopes *e, size_t cells, size_t lanes);
void ceduo_envelopes_release(struct envelopes *e);

/* The row of the rock in a lane, which passes no cell before `first`; and its end: none from `behind` on. */
struct envelope_row ceduo_envelopes_begin(struct envelopes *e, size_t lane, size_t first);
void ceduo_envelopes_end(struct envelopes *e, size_t lane, size_t behind);

/* Adds up cells, once no rock is under way. */
void ceduo_envelopes_merge(struct envelope_cell *into, struct envelopes *from);

void ceduo_envelope_read(const struct envelope_cell *cell, struct ceduo_envelope *envelope);

/* What is counted of a value. */
static inline uint16_t envelope_place(int quantity, double value)
{
    double min = envelope_min[quantity], max = envelope_max[quantity];
    uint64_t bits;
    value = value > min ? value : min;
    value = value < max ? value : max;
    memcpy(&bits, &value, sizeof bits);
    return (uint16_t)(bits >> ENVELOPE_SHIFT);
}

/* Notes what a rock brings to a cell. */
static inline void envelope_note(const struct envelope_row *row, size_t cell, const double values[ENVELOPE_QUANTITIES])
{
    for (int q = 0; q < ENVELOPE_QUANTITIES; q++) {
        row->at[q][cell] = envelope_place(q, values[q]);
        row->max[q][cell] = values[q] > row->max[q][cell] ? values[q] : row->max[q][cell];
    }
}

#endif
