/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INPUTS_H
#define CEDUO_INPUTS_H

#include "base/arena.h"
#include "ceduo/uncertainty.h"

/* A copy of a scene whose inputs can be set repeatedly, without further memory. */
struct input_place;
struct input_scene {
    struct arena arena;
    struct ceduo_scene scene;
    const struct ceduo_scene *given; /* the original */
    const struct ceduo_input *inputs;
    size_t inputs_count;
    struct input_place *places; /* all places of the first input, then of the next */
};

/* Return CEDUO_OK, CEDUO_NO_MEMORY, or CEDUO_BAD_PLACE if the scene has no such place. The caller releases *copy in any
 * case. */
enum ceduo_status ceduo_inputs_open(struct input_scene *copy, const struct ceduo_scene *scene, const struct ceduo_input *inputs,
                                    size_t n);
void ceduo_inputs_release(struct input_scene *copy);

/* True if the input affects an option: at least one place is not in another option. */
bool ceduo_input_affects(const struct ceduo_input *input, size_t option);

/* True if the input changes only future years: its places are numbers of growth, age or cuts. */
bool ceduo_input_is_future(const struct ceduo_input *input);

/* Set each input to its quantile u[i], 0…1; NaN: as given. The density of shoots given per stool is updated, unless their
 * per_ha is an input. The number of stools is limited to that of the shoots. */
void ceduo_inputs_set(struct input_scene *copy, const double *u);

/* Return the quantile u (0…1) of an input that is a range, normal or gamma. */
double ceduo_input_quantile(const struct ceduo_input *input, double u);

#endif
