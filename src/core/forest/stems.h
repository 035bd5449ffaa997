/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STEMS_H
#define CEDUO_STEMS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "ceduo/simulate.h"
#include "stems_state.h"

/* Stems in the path of one rock, drawn as it reaches them. Stools and trees are Poisson processes in the plane. The rock sweeps
 * a strip as wide as itself. Stems outside the strip are never drawn; stems inside are distributed as on a full map. There is
 * one strip ahead of the release (side 0, along +x) and one behind it (side 1, places are -x). Each place is drawn once: a
 * passed stem is discarded. */

/* True if a rock has met too many stems and its trajectory must be abandoned. */
static inline bool ceduo_stems_too_many(const struct stems *stems)
{
    return stems->effort > CEDUO_STEMS_MAX;
}

/* Allocate the stems of one rock at a time. NULL without memory. `forest` must live as long. */
struct stems *ceduo_stems_create(const struct forest *forest, enum ceduo_kernel kernel);
void ceduo_stems_free(struct stems *stems);

/* Begin the trajectory of rock `number`, of mean diameter b (m), released at x. */
void ceduo_stems_begin(struct stems *stems, uint64_t seed, uint64_t number, double b, double x);

/* Return the next stem of a side. Requires next_known. */
static inline struct stem *ceduo_stems_next(struct stems_side *side)
{
    return side->next_queued ? &side->queue[side->first] : &side->single;
}

/* Remove the next stem of a side and find the following one. If it was not known, no stem is removed, and side[].next advances.
 * The work per call is bounded. */
void ceduo_stems_advance(struct stems *stems, int side);

static inline void ceduo_stems_consume(struct stems *stems, int i)
{
    struct stems_side *side = &stems->side[i];
    size_t second = side->first + 1; /* mostly both stems are in the queue */
    if (side->next_known && side->next_queued && second < side->end && side->queue[second].along < side->certain_to)
        side->next = side->queue[++side->first].along;
    else
        ceduo_stems_advance(stems, i);
}

/* A stool on both sides of the release was hit: mark its queued shoots behind. */
void ceduo_stems_mark_hit_behind(struct stems *stems, uint64_t stool);

/* Record a hit. True if it is the first hit of the stool or tree. */
static inline bool ceduo_stems_record_hit(struct stems *stems, const struct stem *stem)
{
    if (!stem->shoot)
        return true;
    uint64_t *place = &stems->hit_stools[stem->stool & stems->forest->met_mask];
    bool first = (*place != stem->stool) & !stem->stool_hit; /* unpredictable: no branch depends on it */
    *place = stem->stool;
    if (stem->along <= stems->start + 2 * stems->forest->reach && first && !(stem->stool & 1))
        ceduo_stems_mark_hit_behind(stems, stem->stool);
    return first;
}

/* Return the eccentricity of a hit by a rock of diameter b, 0…1; 0 for a log. */
static inline double ceduo_stem_eccentricity(const struct stem *stem, double b)
{
    return isnan(stem->dbh) ? 0 : 2 * fabs(stem->y) / (b + stem->dbh);
}

#endif
