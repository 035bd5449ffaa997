/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PREDICT_H
#define CEDUO_PREDICT_H

#include "ceduo/calibrate.h"

/* True if the fitted observations cover two or more rock shapes. In the law arm mu acts only through the shape, so one shape
 * cannot identify it. */
bool ceduo_calibration_identifies_mu(const struct ceduo_calibration_scene *scenes, size_t n);

/* Compare a scene with its observations without fitting it. Sets to[] for each observation, with the p-value and the
 * interval of new samples of the observed size. Simulates `rocks` rocks for each setting on this thread. Return CEDUO_OK,
 * CEDUO_NO_MEMORY, CEDUO_CANCELLED or the status of ceduo_scene_check(). */
enum ceduo_status ceduo_compare_with_observations(const struct ceduo_calibration_scene *scene, uint64_t rocks,
                                                  const ceduo_flag *cancel, struct ceduo_predicted *to);

/* Select parameters to fix so that the observations identify the rest: first those that are not identified, then one of each
 * strongly correlated pair. If the chains have not converged and none is selected, select the one with the widest range. At
 * least one parameter stays. Return the number of selected parameters. */
size_t ceduo_calibration_unidentified(const struct ceduo_calibration *answer, bool selected[CEDUO_CALIBRATION_MAX]);

#endif
