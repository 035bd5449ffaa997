/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "envelope.h"

#include <math.h>
#include <string.h>

/* Exponents of the smallest octave: speeds and heights from a millimetre, energies from 1/16 J. */
static const int lowest[ENVELOPE_QUANTITIES] = {-10, -10, -4};

static uint16_t bin_of(int quantity, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int64_t i = (int64_t)(bits >> 47) - ((int64_t)(1023 + lowest[quantity]) << 5);
    if (!(value > 0) || i < 0)
        return 0;
    return (uint16_t)(i < ENVELOPE_BINS ? i : ENVELOPE_BINS - 1);
}

static double middle_of(int quantity, size_t bin)
{
    return bin == 0 ? 0 : ldexp(1 + ((double)(bin & 31) + 0.5) / 32, (int)(bin >> 5) + lowest[quantity]);
}

void ceduo_envelope_settle(struct envelope_cell *cell)
{
    for (int q = 0; q < ENVELOPE_QUANTITIES; q++)
        for (uint32_t i = 0; i < cell->waiting; i++)
            cell->bins[q][cell->waits[i][q]]++;
    cell->waiting = 0;
}

void ceduo_envelope_add(struct envelope_cell *cell, double speed, double height, double energy)
{
    const double values[ENVELOPE_QUANTITIES] = {speed, height, energy};
    cell->passed++;
    for (int q = 0; q < ENVELOPE_QUANTITIES; q++) {
        cell->waits[cell->waiting][q] = bin_of(q, values[q]);
        cell->max[q] = values[q] > cell->max[q] ? values[q] : cell->max[q];
    }
    if (++cell->waiting == ENVELOPE_WAITING)
        ceduo_envelope_settle(cell);
}

void ceduo_envelope_merge(struct envelope_cell *into, const struct envelope_cell *from)
{
    into->passed += from->passed;
    for (int q = 0; q < ENVELOPE_QUANTITIES; q++) {
        into->max[q] = fmax(into->max[q], from->max[q]);
        for (size_t i = 0; i < ENVELOPE_BINS; i++)
            into->bins[q][i] += from->bins[q][i];
    }
}

static struct ceduo_spread_of_cell spread_of(const struct envelope_cell *cell, int q)
{
    struct ceduo_spread_of_cell s = {NAN, NAN, NAN, NAN};
    if (cell->passed == 0)
        return s;
    const double p[3] = {0.05, 0.5, 0.95};
    double *to[3] = {&s.p5, &s.p50, &s.p95};
    uint64_t before = 0;
    int next = 0;
    for (size_t i = 0; i < ENVELOPE_BINS && next < 3; i++) {
        before += cell->bins[q][i];
        while (next < 3 && (double)before >= p[next] * (double)cell->passed)
            *to[next++] = fmin(middle_of(q, i), cell->max[q]);
    }
    s.max = cell->max[q];
    return s;
}

void ceduo_envelope_read(const struct envelope_cell *cell, struct ceduo_envelope *envelope)
{
    envelope->passed = cell->passed;
    envelope->speed = spread_of(cell, 0);
    envelope->height = spread_of(cell, 1);
    envelope->energy = spread_of(cell, 2);
    double sum = 0;
    for (size_t i = 0; i < ENVELOPE_BINS; i++)
        sum += middle_of(2, i) * cell->bins[2][i];
    envelope->mean_energy = cell->passed > 0 ? sum / (double)cell->passed : NAN;
}
