/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOUBT_INPUTS_H
#define CEDUO_DOUBT_INPUTS_H

#include "ceduo/doubt.h"
#include "scene_file.h"

/* The inputs of a scene: what its `doubt` names, and every value that is marked as assumed and has a range (ranges.h).
 * Values that come from one line of one file are one input, as are all energy laws, and for each species the strength of its wood and its growth, as all stands grow on one slope. Inputs that
 * change today's figures come first. */
struct scene_inputs {
    size_t n;
    struct ceduo_input *items; /* in the arena of the scene's file */
};

/* False without memory. `doubt: none`: there are none. */
bool ceduo_inputs_of(struct scene_file *file, struct scene_inputs *inputs);

/* Removes the inputs that change years to come alone. */
void ceduo_inputs_keep_today(struct scene_inputs *inputs);

/* The places of a path that is to be fitted, to input->places: [*] stands for all items, slope.materials[NAME].KEY for a ground.
 * NULL where it is not a number of any scene; the scene may have no such place. */
const struct field *ceduo_input_find(struct scene_file *file, const char *path, struct ceduo_input *input);

/* Number of places of a path, which may have [*]; 0: not every item has such a value, so that it cannot be set. */
size_t ceduo_input_count(struct scene_file *file, const char *path);

/* Whether one of n inputs has a place, written either way. */
bool ceduo_inputs_have(const struct ceduo_input *inputs, size_t n, const char *place);

/* Whether some place is of both. */
bool ceduo_input_shares(const struct ceduo_input *a, const struct ceduo_input *b);

/* The belt that a place is in, forest[0].stand… or options[2].forest[0].stand…; NULL: it is in none. */
const struct ceduo_belt *ceduo_input_belt(const struct ceduo_scene *scene, const char *place);

/* Paths of the segments of a ground of the library, one for each stretch; returns how many. `root` NULL: talus was taken for all.
 * `assumed`: only stretches for which the scene does not say the value itself. */
size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, bool assumed, const char **places);

/* The path of a place of the scene as --set has it, which knows all options of the file. NULL without memory. */
const char *ceduo_input_path(struct scene_file *file, const char *place);

#endif
