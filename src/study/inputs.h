/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INPUTS_H
#define CEDUO_INPUTS_H

#include "base/arena.h"
#include "ceduo/uncertainty.h"

/* A copy of a scene whose inputs can be set again and again. It uses no more memory for that. */
struct input_place;
struct input_scene {
    struct arena arena;
    struct ceduo_scene scene;
    const struct ceduo_scene *given; /* what it is a copy of */
    const struct ceduo_input *inputs;
    size_t inputs_count;
    struct input_place *places; /* of all inputs, one after the other */
};

/* CEDUO_NO_MEMORY; CEDUO_BAD_SLOPE where a place is not one of the scene's. Release it in any case. */
enum ceduo_status ceduo_inputs_open(struct input_scene *copy, const struct ceduo_scene *scene, const struct ceduo_input *inputs,
                                    size_t n);
void ceduo_inputs_release(struct input_scene *copy);

/* Whether an option has the input: it has a place elsewhere than in other options. */
bool ceduo_input_affects(const struct ceduo_input *input, size_t option);

/* True if the input changes years to come alone, and no figure of today: its values are numbers of growth, age or cuts. */
bool ceduo_input_is_future(const struct ceduo_input *input);

/* Sets each input to the value at u[i] of its range, 0…1; NaN: as the scene has it. Shoots that are given per stool follow
 * the stools, unless their per_ha is an input. A stand whose stools would be more than its shoots has as many stools as
 * shoots. */
void ceduo_inputs_set(struct input_scene *copy, const double *u);

#endif
