/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef INVARIANTS_H
#define INVARIANTS_H

#include <stdint.h>

#include "line_scene.h"

/* What was seen over many scenes. */
struct invariants_tally {
    uint64_t ends[CEDUO_ENDS], contacts, pieces, flights, impacts, lasting, crossed, cracks;
    struct ceduo_trajectory last; /* the last way */
};

/* Follows one rock of a scene and fails the test where something does not hold that holds on any ground: never below it,
 * no energy gained, no gap in the way, no end but those of the model, nothing that is not a number. `number` names it. */
void invariants_expect(struct line_scene *scene, uint64_t number, struct invariants_tally *tally);

#endif
