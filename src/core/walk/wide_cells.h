/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of envelopes that a flight passes, many at once: the same operations in the same order as in flying.h. */
#ifndef CEDUO_WIDE_CELLS_H
#define CEDUO_WIDE_CELLS_H

#include "lanes.h"
#include "walker.h"

/* As envelope_note(), without the largest: returns where that is less than what is noted. What is noted in cells that
 * are not passed is written over when the rock comes to them, or at its end. */
LANE part_flags note_part(const struct envelope_row *row, int q, size_t cell, part_reals value)
{
    part_reals within = PART_LEAST(PART_MOST(value, PART_ALL(envelope_least[q])), PART_ALL(envelope_most[q]));
    part_store_upper(&row->at[q][cell], within);
    return PART_LESS(PART_LOAD_ROW(&row->max[q][cell]), value);
}

LANE void keep_largest(const struct envelope_row *row, int q, size_t cell, part_flags in, part_reals value)
{
    part_reals old = PART_LOAD_ROW(&row->max[q][cell]);
    PART_STORE_ROW(&row->max[q][cell], PART_PICK(PART_BOTH(in, PART_LESS(old, value)), value, old));
}

/* The cells up to x that the flight from `at` passes, which lands after t_end. */
LANE void pass_cells(struct walker *w, const struct flight *at, double x, double t_end)
{
    const struct marks *marks = w->marks;
    const struct envelope_row row = w->row;
    part_reals half_mass = PART_ALL(0.5 * w->rock.mass), rotation = PART_ALL(0.5 * w->rock.moment * (w->spin * w->spin));
    part_reals vx2 = PART_ALL(at->vx * at->vx), vx = PART_ALL(at->vx), x0 = PART_ALL(at->x), end = PART_ALL(t_end);
    part_reals vz0 = PART_ALL(at->vz), z0 = PART_ALL(at->z);
    part_reals gravity = PART_ALL(w->g->gravity), half_g = PART_ALL(w->g->half_g);
    size_t cell = w->next_cell;
    unsigned passed;
    do {
        part_reals to = PART_LOAD_ROW(&marks->cell_x[cell]), ground = PART_LOAD_ROW(&marks->cell_z[cell]);
        part_flags in = PART_AT_LEAST(PART_ALL(x), to);
        part_reals t = PART_LEAST((to - x0) / vx, end), vz = vz0 - gravity * t;
        part_reals speed = PART_SQRT(vx2 + vz * vz), height = z0 + (vz0 - half_g * t) * t - ground;
        part_reals energy = half_mass * (speed * speed) + rotation;
        part_flags higher = PART_EITHER(note_part(&row, 0, cell, speed), note_part(&row, 1, cell, height));
        higher = PART_BOTH(PART_EITHER(higher, note_part(&row, 2, cell, energy)), in);
        if (PART_BITS(higher)) { /* seldom */
            keep_largest(&row, 0, cell, in, speed);
            keep_largest(&row, 1, cell, in, height);
            keep_largest(&row, 2, cell, in, energy);
        }
        passed = (unsigned)__builtin_popcount(PART_BITS(in));
        cell += passed;
    } while (passed == PART);
    w->next_cell = cell;
}

#endif
