/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EFFORT_H
#define CEDUO_EFFORT_H

#include "ceduo/uncertainty.h"

/* Bounds the effort of the uncertainty of a page. The unit is one contact or stem, about 17 ns. The bound counts simulated
 * work, not time, so that the same input gives the same page. */
#define CEDUO_EFFORT_TIMES 30    /* times the effort of the scene as given */
#define CEDUO_EFFORT_MIN   6e7   /* one second: a quick scene is never bounded by less */
#define CEDUO_EFFORT_MAX   1.8e8 /* three seconds */

/* Return the effort of runs of a scene. */
double ceduo_effort_compute(const struct ceduo_scene *scene, const struct ceduo_work *work);

/* Reduce points, rocks and years of the definition until its effort is within the bound, and set effort_max. If the bound
 * does not allow CEDUO_UNCERTAINTY_MIN points, the rotation is dropped. If it still does not, `points` is set to 0. `own`:
 * runs of the scene as given; NULL: the bound is CEDUO_EFFORT_MAX. Return CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or the
 * status of ceduo_scene_check(). */
enum ceduo_status ceduo_effort_bound(struct ceduo_uncertainty_def *def, const struct ceduo_work *own);

#endif
