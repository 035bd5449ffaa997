/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STEMS_H
#define CEDUO_STEMS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "ceduo/run.h"
#include "ceduo/trajectory.h"
#include "stems_state.h"

/* The stems in one rock's path, drawn as it reaches them. Stools and trees are Poisson processes in the plane, of
 * which the rock sweeps a strip as wide as itself: what stands beside the strip is never drawn, and what is drawn is
 * distributed as on a full map. Ahead of the release (side 0, along +x) and behind it (side 1) there is one such strip
 * each; places along side 1 are -x. Ground is covered once: a stem that was passed is gone. */

/* Whether a rock has met too many stems to be followed further. */
static inline bool ceduo_stems_too_many(const struct stems *stems)
{
    return stems->effort > CEDUO_STEMS_MAX;
}

/* `stems` is zeroed: it is large, and mostly never touched. False without memory. */
bool ceduo_stems_init(struct stems *stems, const struct wood *wood, enum ceduo_kernel kernel);
void ceduo_stems_release(struct stems *stems);

/* Begins the trajectory of rock `number`, of mean diameter b, released at x. */
void ceduo_stems_begin(struct stems *stems, uint64_t seed, uint64_t number, double b, double x);

/* The next stem of a side, where next_known. */
static inline struct stem *ceduo_stems_next(struct stems_side *side)
{
    return side->next_waits ? &side->waiting[side->first] : &side->single;
}

/* Takes that stem away and looks for the one after it. Where it was not known, no stem is taken, and side[].next has
 * moved on. Each call does a bounded amount of work. */
void ceduo_stems_advance(struct stems *stems, int side);

static inline void ceduo_stems_consume(struct stems *stems, int i)
{
    struct stems_side *side = &stems->side[i];
    size_t second = side->first + 1; /* mostly both it and the first wait already */
    if (side->next_known && side->next_waits && second < side->end && side->waiting[second].along < side->sure)
        side->next = side->waiting[++side->first].along;
    else
        ceduo_stems_advance(stems, i);
}

/* A stool astride of the release was hit: its shoots that wait behind know of it, however late the rock comes to them.
 * */
void ceduo_stems_next_hit_behind(struct stems *stems, uint64_t stool);

/* Notes that a stem was hit; whether its stool or tree was not hit before. */
static inline bool ceduo_stems_next_hit(struct stems *stems, const struct stem *stem)
{
    if (!stem->shoot)
        return true;
    uint64_t *place = &stems->met[stem->stool & stems->wood->places];
    bool first = (*place != stem->stool) & !stem->met; /* as likely as not: no branch depends on it */
    *place = stem->stool;
    if (stem->along <= stems->start + 2 * stems->wood->reach && first && !(stem->stool & 1))
        ceduo_stems_next_hit_behind(stems, stem->stool);
    return first;
}

/* How far off its middle a rock of diameter b hits this stem, 0…1; 0 for a log. */
static inline double ceduo_stem_eccentricity(const struct stem *stem, double b)
{
    return isnan(stem->dbh) ? 0 : 2 * fabs(stem->y) / (b + stem->dbh);
}

#endif
