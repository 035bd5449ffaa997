/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EFFORT_H
#define CEDUO_EFFORT_H

#include "ceduo/pool.h"
#include "ceduo/uncertainty.h"

/* Bounds the uncertainty of a page by its effort. A unit is the time of one contact or stem, some 17 ns of a processor. The bound
 * counts what is simulated, never time, so that the same input gives the same page. */
#define CEDUO_EFFORT_TIMES 30    /* the effort of the scene as it is */
#define CEDUO_EFFORT_MIN   6e7   /* one second: a quick scene may always have so much */
#define CEDUO_EFFORT_MAX   1.8e8 /* three seconds */

/* Effort of runs of a scene. */
double ceduo_effort_compute(const struct ceduo_scene *scene, const struct ceduo_work *work);

/* Reduces points, rocks and years of the definition until its effort keeps within the bound, and sets effort_max. A rotation
 * that cannot have CEDUO_UNCERTAINTY_MIN points is left out. Sets `points` to 0 if today cannot have them either. `own`: runs of the
 * scene as it is; NULL: CEDUO_EFFORT_MAX alone is the bound. Returns CEDUO_CANCELLED, CEDUO_NO_MEMORY or what ceduo_scene_check()
 * returns. */
enum ceduo_status ceduo_effort_bound(struct ceduo_uncertainty_def *def, const struct ceduo_work *own);

#endif
