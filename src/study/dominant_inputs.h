/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOMINANT_INPUTS_H
#define CEDUO_DOMINANT_INPUTS_H

#include "ceduo/uncertainty.h"

/* Find the inputs that decide a light of the last control: contact, free run, energy (CEDUO_UNCERTAINTY_EXCEED) or its fence.
 * Return the number of dominant inputs, 1 or 2, the largest share first. Return 0 if the light does not change within the 90 %
 * range, or if there are too few points. */
size_t ceduo_uncertainty_dominant_inputs(const struct ceduo_scene *scene, const struct ceduo_uncertainty_result *answer,
                                         size_t option, enum ceduo_uncertainty_kind light, size_t inputs[2]);

#endif
