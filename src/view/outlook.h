/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OUTLOOK_H
#define CEDUO_OUTLOOK_H

#include <stddef.h>
#include <stdint.h>

#include "ceduo/run.h"

/* What a run gives for pictures: plain columns, never changed once they are made, so that one thread may make them and
 * another draw them. All x and z are relative to the slope's first vertex. */

/* A rock's way as a polyline, its flights sampled finely enough for any picture. */
struct ceduo_trail {
    size_t n;
    double *x, *z; /* m */
};

/* Energies of rocks that reached a control, in the order of the rocks. */
struct ceduo_energies {
    size_t n;
    double *values; /* J */
};

struct ceduo_outlook {
    uint64_t rocks, contacts; /* of the run */
    size_t cells;
    double *cell_x;
    struct ceduo_envelope *envelopes; /* one for each cell */
    size_t controls;                  /* of the scene, when it was made */
    struct ceduo_arrivals *arrivals;  /* one for each control */
    struct ceduo_energies *energies;  /* one for each control: the first CEDUO_OUTLOOK_SAMPLE at most */
    struct ceduo_ends ends;
    size_t trails_count;
    struct ceduo_trail *trails; /* of the first rocks */
};

#define CEDUO_OUTLOOK_CELLS  200    /* places along the slope where a run should keep envelopes */
#define CEDUO_OUTLOOK_TRAILS 200    /* ways that make a dense picture */
#define CEDUO_OUTLOOK_SAMPLE 100000 /* energies kept for a histogram */

/* Writes CEDUO_OUTLOOK_CELLS places, evenly from the release to the end of the slope, for a run's cells; returns how
 * many: none where the release may lie at the end. */
size_t ceduo_outlook_places(const struct ceduo_scene *scene, double *x);

/* Reads a run of `scene`, and follows its first `trails` rocks. The envelopes come from `with_cells`, a run of the same
 * rocks that was made with these cells and may be shorter: they make a run five times as slow, and a picture needs no
 * more than some thousand rocks. NULL: `run` itself. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_outlook_create(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                       const struct ceduo_run *with_cells, size_t cells, const double *cell_x,
                                       size_t trails, struct ceduo_outlook **outlook);
void ceduo_outlook_free(struct ceduo_outlook *outlook); /* NULL is allowed */

/* The way of one rock, the one that a run of the scene flies under this number. CEDUO_NO_MEMORY or CEDUO_OK; free the
 * trail in any case. */
enum ceduo_status ceduo_trail_follow(const struct ceduo_scene *scene, uint64_t rock, struct ceduo_trail *trail);
void ceduo_trail_free(struct ceduo_trail *trail);

#endif
