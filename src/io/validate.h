/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALIDATE_H
#define CEDUO_VALIDATE_H

#include "validator.h"

/* Makes a scene of the values in its files, and checks it: places become relative to the slope's first vertex, materials
 * become ground, controls_m controls, a forest an option. What is wrong is reported at the node that it comes from. False where
 * there is so much wrong, or no memory, that there is nothing to go on with. */
bool ceduo_validate(struct validator *v);

/* Its checks by subject, in the order in which the scene is built. */

void ceduo_validate_rock(struct validator *v, const char *path, const struct node *node, const struct ceduo_rock_def *def);
void ceduo_validate_blocks(struct validator *v);
void ceduo_validate_slope(struct validator *v);
double ceduo_validate_end(void *validator); /* the last x of the profile, before it is validated; NaN: not known */
void ceduo_validate_release(struct validator *v, const char *path, struct ceduo_release *release);
void ceduo_validate_controls(struct validator *v);
void ceduo_validate_options(struct validator *v);
void ceduo_validate_doubt(struct validator *v);
void ceduo_validate_observed(struct validator *v);

/* What was observed may be written in several forms: brings them into the one that the table of keys has. */
void ceduo_arrange_observed(struct validator *v);

#endif
