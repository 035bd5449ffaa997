/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A forest for the slow walk: all stems of the strip that a rock sweeps, drawn before its release and sorted. */
#ifndef PLAIN_FOREST_H
#define PLAIN_FOREST_H

#include "plane_map.h"
#include "slow_walk.h"

#define FOREST_STEMS_MAX 4096

struct plain_forest {
    const struct ceduo_option *option; /* Requires volumes and U. */
    gsl_rng *rng;
    struct map_stem map[FOREST_STEMS_MAX];
    struct slow_stem stems[FOREST_STEMS_MAX];
};

/* Draw another forest for the next rock. False if it has too many stems. */
static inline bool plain_forest_draw(struct plain_forest *f, struct slow_def *def)
{
    def->stems = f->stems;
    def->stems_count = plane_map_sweep(f->option, 2 * def->radius, def->x0, f->rng, f->map, FOREST_STEMS_MAX);
    for (size_t i = 0; i < def->stems_count && i < FOREST_STEMS_MAX; i++)
        f->stems[i] = (struct slow_stem){f->map[i].x, f->map[i].height, f->map[i].energy};
    return def->stems_count <= FOREST_STEMS_MAX;
}

#endif
