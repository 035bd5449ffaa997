/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SNAPSHOT_H
#define CEDUO_SNAPSHOT_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "ceduo/result.h"
#include "core/walk/envelope.h"

/* What runs give for pictures: plain columns, never changed once they are made, so that one thread may make them and
 * another draw them. All x and z are relative to the slope's first vertex. */

/* A trajectory as a polyline, its flights sampled finely enough for any picture. */
struct ceduo_polyline {
    size_t n;
    double *x, *z; /* m */
};

/* Energies of rocks that reached a control, in the order of the rocks. */
struct ceduo_energies {
    size_t n;
    double *values; /* J */
};

/* One run, as it was at some moment. It is shared: each who keeps it has a reference. */
struct ceduo_run_snapshot {
    atomic_uint references;
    struct arena memory; /* of envelopes, energies and trajectories */
    uint64_t key;        /* ceduo_option_key() of its forest */
    struct ceduo_simulated simulated;
    uint64_t envelope_rocks;          /* of the envelopes */
    struct ceduo_envelope *envelopes; /* one for each cell */
    struct ceduo_energies *energies;  /* one for each control: the first CEDUO_SNAPSHOT_SAMPLE at most */
    size_t trajectories_count;
    struct ceduo_polyline *trajectories; /* of the first rocks */
};

/* All runs of a scene. */
struct ceduo_snapshot {
    struct arena memory;
    size_t cells, controls, options;
    double *cell_x;
    struct ceduo_run_snapshot *bare;      /* without forest */
    struct ceduo_run_snapshot **wooded;   /* through the forest of each option; NULL: not known (yet) */
    struct ceduo_difference *differences; /* of those to the first option: options × controls, in rows by option */
};

#define CEDUO_SNAPSHOT_CELLS        200    /* places along the slope with an envelope */
#define CEDUO_SNAPSHOT_TRAJECTORIES 200    /* trajectories that make a dense picture */
#define CEDUO_SNAPSHOT_SAMPLE       100000 /* energies kept for a histogram */

/* What a snapshot is made from. */
struct ceduo_snapshot_def {
    const struct ceduo_scene *scene;
    const struct ceduo_pool *runs; /* those of options may be missing, or have no rocks yet */
    uint64_t
        envelope_rocks;  /* at most CEDUO_ENVELOPE_ROCKS; 0: no envelopes. They lie evenly from the release to the end of the
                              * slope */
    size_t trajectories; /* trajectories that are followed for each */
    const atomic_bool *cancel; /* may be NULL; raised by another thread: the call returns soon */
    const struct ceduo_snapshot
        *last; /* whose snapshots of runs are taken over where nothing has changed; NULL: none. It must be
                                        * of the same scene but for its forests */
};

/* CEDUO_NO_MEMORY, CEDUO_CANCELLED or CEDUO_OK. */
enum ceduo_status ceduo_snapshot_create(const struct ceduo_snapshot_def *def, struct ceduo_snapshot **snapshot);
void ceduo_snapshot_free(struct ceduo_snapshot *snapshot); /* NULL is allowed */

/* What is to be seen of an option of the scene as it is now: through its forest, with the contact model index without
 * forest; where its forest was just changed, what was seen of it before, unless that is another option's. NULL: not known
 * yet. */
const struct ceduo_run_snapshot *ceduo_snapshot_find(const struct ceduo_snapshot *snapshot, const struct ceduo_scene *scene,
                                                     size_t option);

#endif
