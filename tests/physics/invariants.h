/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef INVARIANTS_H
#define INVARIANTS_H

#include <stdint.h>

#include "ceduo/simulate.h"
#include "line_scene.h"

/* Totals over many scenes. */
struct invariants_tally {
    uint64_t ends[CEDUO_ENDS], contacts, pieces, flights, impacts, lasting, crossed, cracks;
    struct ceduo_trajectory last; /* last trajectory */
};

/* Simulate one rock of a scene and check what holds on any ground: never below it, no energy gained, no gap in the trajectory,
 * no end unknown to the model, no NaN. `number` names the scene. */
void invariants_expect(struct line_scene *scene, uint64_t number, struct invariants_tally *tally);

#endif
