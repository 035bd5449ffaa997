/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENVELOPE_H
#define CEDUO_ENVELOPE_H

#include "ceduo/run.h"

/* Coarse counts for pictures: 1/32 of an octave, 40 octaves; the first bin holds all that is smaller. */
#define ENVELOPE_BINS (40 * 32)
#define ENVELOPE_QUANTITIES 3 /* speed, height, energy */

#define ENVELOPE_WAITING 32

/* The bins of a few rocks wait beside the cell: a rock goes through all cells, and one bin in each of them, every time
 * in another place, is more than fits a fast cache. Read and merge a cell only once nothing waits. */
struct envelope_cell {
    uint64_t passed;
    double max[ENVELOPE_QUANTITIES];
    uint32_t waiting;
    uint16_t waits[ENVELOPE_WAITING][ENVELOPE_QUANTITIES];
    uint32_t bins[ENVELOPE_QUANTITIES][ENVELOPE_BINS];
};

void ceduo_envelope_add(struct envelope_cell *cell, double speed, double height, double energy);
/* Counts what waits. */
void ceduo_envelope_settle(struct envelope_cell *cell);
void ceduo_envelope_merge(struct envelope_cell *into, const struct envelope_cell *from);
void ceduo_envelope_read(const struct envelope_cell *cell, struct ceduo_envelope *envelope);

#endif
