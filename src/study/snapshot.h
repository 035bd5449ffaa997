/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SNAPSHOT_H
#define CEDUO_SNAPSHOT_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "ceduo/simulate.h"
#include "core/walk/envelope.h"

/* Results of runs for pictures. A snapshot never changes, so that one thread may create it and another draw it. x and z are
 * relative to the first vertex of the slope. */

/* A trajectory as a polyline. */
struct ceduo_polyline {
    size_t n;
    double *x, *z; /* m */
};

/* Energies of rocks that reached a control, in order of the rocks. */
struct ceduo_energies {
    size_t n;
    double *values; /* J */
};

/* Copy of a run, reference-counted. */
struct ceduo_run_snapshot {
    atomic_uint references;
    struct arena memory;
    uint64_t key;       /* ceduo_option_key() of its forest */
    uint64_t fence_key; /* ceduo_controls_key() of its scene */
    struct ceduo_simulated simulated;
    uint64_t envelope_rocks;          /* rocks of the envelopes */
    struct ceduo_envelope *envelopes; /* one for each cell */
    struct ceduo_energies *energies;  /* one for each control, of the first CEDUO_SNAPSHOT_SAMPLE rocks at most */
    size_t trajectories_count;
    struct ceduo_polyline *trajectories; /* trajectories of the first rocks */
};

/* All runs of a scene. */
struct ceduo_snapshot {
    struct arena memory;
    size_t cells, controls, options;
    double *cell_x;
    struct ceduo_run_snapshot *bare;      /* without forest */
    struct ceduo_run_snapshot **wooded;   /* with the forest of each option; NULL: not simulated (yet) */
    struct ceduo_difference *differences; /* to the first option: [option][control] */
};

#define CEDUO_SNAPSHOT_CELLS        200    /* places with an envelope, evenly from the release to the end of the slope */
#define CEDUO_SNAPSHOT_TRAJECTORIES 200    /* trajectories of a dense picture */
#define CEDUO_SNAPSHOT_SAMPLE       100000 /* energies kept for a histogram */

struct ceduo_snapshot_def {
    const struct ceduo_scene *scene;
    const struct ceduo_pool *runs;     /* runs of options may be missing, or have no rocks yet */
    uint64_t envelope_rocks;           /* at most CEDUO_ENVELOPE_ROCKS; 0: no envelopes */
    size_t trajectories;               /* per run */
    const atomic_bool *cancel;         /* may be NULL */
    const struct ceduo_snapshot *last; /* shares its unchanged runs; its scene may differ in forests only; NULL: none */
};

/* Return CEDUO_OK, CEDUO_NO_MEMORY or CEDUO_CANCELLED. */
enum ceduo_status ceduo_snapshot_create(const struct ceduo_snapshot_def *def, struct ceduo_snapshot **snapshot);
void ceduo_snapshot_free(struct ceduo_snapshot *snapshot); /* may be NULL */

/* Return the latest snapshot of an option, with its forest; without forest if the contact model is index. If the forest has
 * just changed, return the old one, unless another option has it now. NULL: not simulated yet. */
const struct ceduo_run_snapshot *ceduo_snapshot_find(const struct ceduo_snapshot *snapshot, const struct ceduo_scene *scene,
                                                     size_t option);

#endif
