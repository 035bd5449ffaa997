/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of envelopes that a flight passes, a register of them at once: the same operations in the same order as in
 * flying.h. */
#ifndef CEDUO_LANES_CELLS_H
#define CEDUO_LANES_CELLS_H

#include "base/real.h"
#include "walker.h"

/* As envelope_note(), without the largest: returns where that is less than what is noted. What is noted in cells that
 * are not passed is written over when the rock comes to them, or at its end. */
HOT mask note_cells(const struct envelope_row *row, int q, size_t cell, real value)
{
    typedef uint16_t places __attribute__((vector_size(2 * REAL_LANES)));
    real within = min(max(value, all(envelope_min[q])), all(envelope_max[q]));
    places upper = __builtin_convertvector(as_ints(within) >> ENVELOPE_SHIFT, places);
    memcpy(&row->at[q][cell], &upper, sizeof upper);
    return less(load(&row->max[q][cell]), value);
}

HOT void keep_largest(const struct envelope_row *row, int q, size_t cell, mask in, real value)
{
    real old = load(&row->max[q][cell]);
    store(&row->max[q][cell], pick(in & less(old, value), value, old));
}

/* The cells up to x that the flight from `at` passes, which lands after t_end. */
HOT void pass_cells(struct walker *w, const struct flight *at, double x, double t_end)
{
    const struct marks *marks = w->marks;
    const struct envelope_row row = w->row;
    double half_mass = 0.5 * w->rock.mass, rotation = 0.5 * w->rock.moment * (w->spin * w->spin), vx2 = at->vx * at->vx;
    size_t cell = w->next_cell;
    unsigned passed;
    do {
        real to = load(&marks->cell_x[cell]), ground = load(&marks->cell_z[cell]);
        mask in = at_least(all(x), to);
        real t = min((to - at->x) / at->vx, all(t_end)), vz = at->vz - w->g->gravity * t;
        real speed = root_of(vx2 + vz * vz), height = height_after(all(at->z), all(at->vz), w->g->half_g, t) - ground;
        real energy = half_mass * (speed * speed) + rotation;
        mask higher = note_cells(&row, 0, cell, speed) | note_cells(&row, 1, cell, height) | note_cells(&row, 2, cell, energy);
        if (any(higher & in)) { /* seldom */
            keep_largest(&row, 0, cell, in, speed);
            keep_largest(&row, 1, cell, in, height);
            keep_largest(&row, 2, cell, in, energy);
        }
        passed = (unsigned)__builtin_popcount(lanes_of(in));
        cell += passed;
    } while (passed == REAL_LANES);
    w->next_cell = cell;
}

#endif
