/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RELIABILITY_H
#define CEDUO_RELIABILITY_H

#include "goal.h"

/* Probability that an option reaches a goal under uncertain inputs. */
struct reliability_def {
    /* Scene, one option, its inputs (ceduo_input_affects()), points and rocks. CEDUO_GOAL_ENERGY excludes a rotation. The
     * number of points is not increased, and no progress is reported. */
    struct ceduo_uncertainty_def uncertainty;
    enum ceduo_goal goal;
    double target; /* the goal is reached at or below this value */
    double sure;   /* required probability, 0…1 */
};

struct reliability_result {
    struct ceduo_share share; /* probability that the goal is reached */
    /* Quantile `sure` of the goal minus the target, in the goal's unit (ADC: 1/m), with its 95 % interval by points and
     * rocks. At most 0 if the probability is at least `sure`. Unlike the probability it changes smoothly with the scene. */
    double above, above_lo, above_hi;
};

/* Compute the probability from a surface through the goal, which removes sampling noise. Without inputs it is 0 or 1. Return
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or the status of ceduo_scene_check(). */
enum ceduo_status ceduo_reliability_compute(const struct reliability_def *def, struct reliability_result *answer);

#endif
