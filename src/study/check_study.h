/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHECK_STUDY_H
#define CEDUO_CHECK_STUDY_H

#include "ceduo/calibrate.h"
#include "ceduo/find.h"
#include "ceduo/survey.h"
#include "ceduo/uncertainty.h"

/* As core/runs/check.h, for what callers fill in of studies. */

/* `placed`: their places are used, not only their laws. */
enum ceduo_status ceduo_check_inputs(const struct ceduo_input *inputs, size_t n, bool placed);
/* `options`: how many the scene has; 0: not known yet. */
enum ceduo_status ceduo_check_observations(const struct ceduo_observation *observations, size_t n, size_t options);
enum ceduo_status ceduo_check_uncertainty_def(const struct ceduo_uncertainty_def *def);
enum ceduo_status ceduo_check_calibration_def(const struct ceduo_calibration_def *def);
enum ceduo_status ceduo_check_find_def(const struct ceduo_find_def *def);
enum ceduo_status ceduo_check_survey(const struct ceduo_survey *survey);

#endif
