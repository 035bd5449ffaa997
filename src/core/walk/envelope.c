/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "envelope.h"

#include <math.h>
#include <stdlib.h>

#define WAITING 128 /* rows */
#define AT_ONCE 8   /* cells whose bins fit the fastest cache */

static double middle_of(int quantity, size_t bin)
{
    return bin == 0 ? 0 : ldexp(1 + ((double)(bin & 31) + 0.5) / 32, (int)(bin >> 5)) * envelope_min[quantity];
}

/* ---- rows ---- */

bool ceduo_envelopes_init(struct envelopes *e, size_t cells, size_t lanes)
{
    size_t width = (cells + ENVELOPE_VECTOR + 31) / 32 * 32, rows = lanes + WAITING;
    *e = (struct envelopes){.n = cells, .lanes = lanes};
    e->rows = malloc(rows * sizeof *e->rows);
    e->cells = calloc(cells, sizeof *e->cells);
    e->places = malloc(rows * ENVELOPE_QUANTITIES * width * sizeof *e->places);
    e->max = calloc(ENVELOPE_QUANTITIES * width, sizeof *e->max);
    if (!e->rows || !e->cells || !e->places || !e->max)
        return false;
    for (size_t i = 0; i < rows; i++)
        for (size_t q = 0; q < ENVELOPE_QUANTITIES; q++) {
            e->rows[i].at[q] = &e->places[(i * ENVELOPE_QUANTITIES + q) * width];
            e->rows[i].max[q] = &e->max[q * width];
        }
    return true;
}

void ceduo_envelopes_release(struct envelopes *e)
{
    free(e->rows);
    free(e->cells);
    free(e->places);
    free(e->max);
}

/* Where the rock of a row does not pass. */
static void leave_out(struct envelope_row *row, size_t from, size_t to)
{
    for (int q = 0; q < ENVELOPE_QUANTITIES; q++)
        for (size_t i = from; i < to; i++)
            row->at[q][i] = (uint16_t)(envelope_place(q, 0) + ENVELOPE_BINS);
}

/* Counts some cells of the rows that wait, from `cell` on. */
static inline __attribute__((always_inline)) void count(struct envelopes *e, int q, size_t cell, size_t n)
{
    const struct envelope_row *rows = e->rows + e->lanes;
    uint32_t *bins = e->cells[cell].bins[q];
    const size_t first = envelope_place(q, 0), step = sizeof *e->cells / sizeof *bins;
    for (size_t i = 0; i < e->waiting; i++) {
        const uint16_t *at = &rows[i].at[q][cell];
#pragma GCC unroll 8
        for (size_t k = 0; k < n; k++)
            bins[k * step + at[k] - first]++;
    }
}

static void settle(struct envelopes *e)
{
    size_t cell = 0;
    for (; cell + AT_ONCE <= e->n; cell += AT_ONCE)
        for (int q = 0; q < ENVELOPE_QUANTITIES; q++)
            count(e, q, cell, AT_ONCE);
    for (; cell < e->n; cell++)
        for (int q = 0; q < ENVELOPE_QUANTITIES; q++)
            count(e, q, cell, 1);
    e->waiting = 0;
}

struct envelope_row ceduo_envelopes_begin(struct envelopes *e, size_t lane, size_t first)
{
    leave_out(&e->rows[lane], 0, first);
    return e->rows[lane];
}

void ceduo_envelopes_end(struct envelopes *e, size_t lane, size_t behind)
{
    struct envelope_row ended = e->rows[lane], *to = &e->rows[e->lanes + e->waiting];
    leave_out(&ended, behind, e->n);
    e->rows[lane] = *to;
    *to = ended;
    if (++e->waiting == WAITING)
        settle(e);
}

/* ---- cells ---- */

void ceduo_envelopes_merge(struct envelope_cell *into, struct envelopes *from)
{
    settle(from);
    for (size_t cell = 0; cell < from->n; cell++)
        for (int q = 0; q < ENVELOPE_QUANTITIES; q++) {
            double max = from->rows[0].max[q][cell];
            size_t last = envelope_place(q, max) - envelope_place(q, 0); /* of those that are not empty */
            into[cell].max[q] = fmax(into[cell].max[q], max);
            for (size_t i = 0; i <= last; i++)
                into[cell].bins[q][i] += from->cells[cell].bins[q][i];
        }
}

static struct ceduo_spread_of_cell spread_of(const struct envelope_cell *cell, int q, uint64_t passed)
{
    struct ceduo_spread_of_cell s = {NAN, NAN, NAN, NAN};
    if (passed == 0)
        return s;
    const double p[3] = {0.05, 0.5, 0.95};
    double *to[3] = {&s.p5, &s.p50, &s.p95};
    uint64_t before = 0;
    int next = 0;
    for (size_t i = 0; i < ENVELOPE_BINS && next < 3; i++) {
        before += cell->bins[q][i];
        while (next < 3 && (double)before >= p[next] * (double)passed)
            *to[next++] = fmin(middle_of(q, i), cell->max[q]);
    }
    s.max = cell->max[q];
    return s;
}

void ceduo_envelope_read(const struct envelope_cell *cell, struct ceduo_envelope *envelope)
{
    uint64_t passed = 0;
    double energy = 0;
    for (size_t i = 0; i < ENVELOPE_BINS; i++) {
        passed += cell->bins[2][i];
        energy += cell->bins[2][i] > 0 ? middle_of(2, i) * cell->bins[2][i] : 0;
    }
    envelope->passed = passed;
    envelope->speed = spread_of(cell, 0, passed);
    envelope->height = spread_of(cell, 1, passed);
    envelope->energy = spread_of(cell, 2, passed);
    envelope->mean_energy = passed > 0 ? energy / (double)passed : NAN;
}
