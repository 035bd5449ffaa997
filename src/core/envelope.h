/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENVELOPE_H
#define CEDUO_ENVELOPE_H

#include "ceduo/run.h"

/* Coarse counts for pictures: 1/32 of an octave, 40 octaves; the first bin holds all that is smaller. */
#define ENVELOPE_BINS (40 * 32)
#define ENVELOPE_QUANTITIES 3 /* speed, height, energy */

struct envelope_cell {
    uint64_t passed;
    double max[ENVELOPE_QUANTITIES];
    uint32_t bins[ENVELOPE_QUANTITIES][ENVELOPE_BINS];
};

void ceduo_envelope_add(struct envelope_cell *cell, double speed, double height, double energy);
void ceduo_envelope_merge(struct envelope_cell *into, const struct envelope_cell *from);
void ceduo_envelope_read(const struct envelope_cell *cell, struct ceduo_envelope *envelope);

#endif
