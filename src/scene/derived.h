/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DERIVED_H
#define CEDUO_DERIVED_H

#include "ceduo/scene.h"

/* True if there is a fence. */
static inline bool ceduo_fence_stands(const struct ceduo_fence *fence)
{
    return fence->height > 0;
}

/* Return its life, years. */
static inline double ceduo_fence_life(const struct ceduo_fence *fence)
{
    return fence->life > 0 ? fence->life : CEDUO_FENCE_LIFE;
}

/* Return the accepted return period of a control, years. */
static inline double ceduo_accepted_return(const struct ceduo_control *control)
{
    return control->accepted_return > 0 ? control->accepted_return : CEDUO_ACCEPTED_RETURN;
}

/* True if design values are requested. */
static inline bool ceduo_design_is_requested(const struct ceduo_design_values *design)
{
    return design->survey >= 0 && design->blocks >= 0;
}

/* True if rocks differ in size, mass or shape. */
bool ceduo_scene_rock_varies(const struct ceduo_scene *scene);

/* Set `release` to the mean of several releases, weighted by their shares. Call it after a change of them. */
void ceduo_scene_average_releases(struct ceduo_scene *scene);

/* Return the releases, and their number n: `releases`, or `release` alone. */
const struct ceduo_release *ceduo_scene_releases(const struct ceduo_scene *scene, size_t *n);

/* Return the largest x at which a rock can start (m, relative to the slope's first vertex). */
double ceduo_scene_release_last(const struct ceduo_scene *scene);

/* Return the index of the control farthest along x, or 0 if there is none. */
size_t ceduo_scene_last_control(const struct ceduo_scene *scene);

/* Return the start of the first belt that is not bare (m, relative to the slope's first vertex); infinite if all are bare. */
double ceduo_option_forest_begin(const struct ceduo_option *option);

#endif
