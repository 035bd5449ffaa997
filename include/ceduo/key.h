/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEY_H
#define CEDUO_KEY_H

#include <stdint.h>

#include "scene.h"

/* Hashes of all that decides a run: where they are equal, the same rocks have the same trajectories. */

/* Of what lies outside the forest: rock, release, slope, controls, law, seed, gravity. */
uint64_t ceduo_scene_key(const struct ceduo_scene *scene);

/* Of the forest of an option as rocks meet it by the scene's contact model; 0 where they meet nothing: no option, no stems,
 * or the model `index`. */
uint64_t ceduo_option_key(const struct ceduo_scene *scene, const struct ceduo_option *option);

/* Of what becomes of the forest of an option in the years to come: growth, cuts, and the forest itself whatever the contact
 * model. */
uint64_t ceduo_years_key(const struct ceduo_option *option);

#endif
