/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURE_H
#define CEDUO_SURE_H

#include "ceduo/uncertainty.h"
#include "goal.h"

/* In how much of what may be true of a scene an option reaches a goal. */
struct reliability_def {
    /* the scene, one option alone, the inputs that it has (ceduo_input_is_of()), points and rocks; over a rotation: not of
     * CEDUO_GOAL_ENERGY. More points are never taken, and progress is not told */
    struct ceduo_uncertainty_def uncertainty;
    enum ceduo_goal goal;
    double target; /* a goal up to it is reached; */
    double sure;   /* in so much of what may be true */
};

struct reliability_result {
    struct ceduo_share share; /* of what may be true in which the goal is reached */
    /* how far the goal of that much of what may be true is above the target, in the goal's unit (of an ADC in that of its inverse): at
     * most 0 where the share is at least `sure`; it is no share, so that it changes smoothly with the scene */
    double above, above_lo, above_hi; /* with its 95 % interval by the points and the rocks */
};

/* From a surface through the goal at the points, so that the noise of the rocks is taken off. Without inputs the share is 0 or 1.
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or what ceduo_scene_check() says. */
enum ceduo_status ceduo_reliability_compute(const struct reliability_def *def, struct reliability_result *answer);

#endif
