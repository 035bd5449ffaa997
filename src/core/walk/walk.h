/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WALK_H
#define CEDUO_WALK_H

#include "walker.h"

/* Draws rock number `number` of the scene and puts it at its release. walker.stems and those who look on are the
 * caller's to set before. */
enum ceduo_status ceduo_walk_release(struct walker *w, const struct prepared *ready, uint64_t number);

/* Whether all rocks of a scene without forest start alike; another such rock, from one at its release and a walker that
 * was released before. */
bool ceduo_walk_alike(const struct prepared *ready);
void ceduo_walk_release_again(struct walker *w, const struct walker *first, uint64_t number);

/* Follows it to its end. */
enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law);

/* ---- the trajectory in pieces, for the walk of lanes ---- */

/* From the release to the first contact. All of these return false where the trajectory ended before, at w->at. */
bool ceduo_walk_start(struct walker *w, struct course *c, enum ceduo_end *end);

/* Notes the marks that a flight passes up to x, where it lands after t. */
void ceduo_walk_pass_marks(struct walker *w, struct flight at, double x, double t);

/* Takes the next stem ahead, and if it is hit, passes the marks up to it by the flight that leads there in t. False
 * where the rock is not to be followed further. */
bool ceduo_walk_take_stem(struct walker *w, bool hit, struct flight at, double t);

/* To the next contact. */
bool ceduo_walk_come_down(struct walker *w, struct course *c, enum ceduo_end *end);

/* Whether a rock rolls behind a contact, which leaves it with velocity v; else it flies to l, which may be known. */
bool ceduo_walk_rolls(const struct walker *w, struct course *c, bool knows_landing);

/* If so: into flight or to the next contact. */
bool ceduo_walk_roll(struct walker *w, struct course *c, enum ceduo_end *end);

/* From between two contacts to the end. */
enum ceduo_end ceduo_walk_on(struct walker *w, const struct course *c, enum ceduo_law law);

/* The ground of a segment as this rock meets it. */
void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle);

#endif
