/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEY_H
#define CEDUO_KEY_H

#include "ceduo/scene.h"

/* Hashes of all inputs of a run. If they are equal, the same rocks have the same trajectories. */

/* Return the hash of all but the forest: rock, release, slope, controls, law, seed, gravity. */
uint64_t ceduo_scene_key(const struct ceduo_scene *scene);

/* Return the hash of fences, accepted return periods and the request for design values. They change no trajectory, but figures
 * read from a run. */
uint64_t ceduo_controls_key(const struct ceduo_scene *scene);

/* Return the hash of the forest of an option as rocks meet it by the scene's contact model. 0 without contacts: no option, no
 * stems, or the model `index`. */
uint64_t ceduo_option_key(const struct ceduo_scene *scene, const struct ceduo_option *option);

/* Return the hash of a forest's future: growth, cuts and the present stand, whatever the contact model. */
uint64_t ceduo_years_key(const struct ceduo_option *option);

#endif
