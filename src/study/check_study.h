/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHECK_STUDY_H
#define CEDUO_CHECK_STUDY_H

#include "ceduo/calibrate.h"
#include "ceduo/survey.h"

/* Checks of the definitions that callers of studies fill in, as core/runs/check.h. Return CEDUO_OK, CEDUO_BAD_ARGUMENT or
 * the status of ceduo_scene_check(). */

/* `has_places`: check the places, too, not only the distributions. */
enum ceduo_status ceduo_check_inputs(const struct ceduo_input *inputs, size_t n, bool has_places);
/* `options`: number of options of the scene; 0: unknown. */
enum ceduo_status ceduo_check_observations(const struct ceduo_observation *observations, size_t n, size_t options);
enum ceduo_status ceduo_check_uncertainty_def(const struct ceduo_uncertainty_def *def);
enum ceduo_status ceduo_check_calibration_def(const struct ceduo_calibration_def *def);
enum ceduo_status ceduo_check_find_def(const struct ceduo_find_def *def);
enum ceduo_status ceduo_check_survey(const struct ceduo_survey *survey);

#endif
