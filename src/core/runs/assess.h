/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ASSESS_H
#define CEDUO_ASSESS_H

#include "ceduo/simulate.h"

/* True if the contact or free-run light would differ counting thick stems only. */
bool ceduo_index_depends_on_thin_stems(const struct ceduo_index *index);

/* Return CEDUO_LIGHT_PASS if the share of the released rocks that exceed the accepted energy is at most the limit of the
 * control. Unknown for NULL, without an accepted energy, or if unfinished rocks decide it. */
enum ceduo_light ceduo_energy_light(const struct ceduo_arrivals *arrivals);

/* Limits of the mean speed (m/s) and of the 95th percentile of the height (m) at a control. Above them a page warns.
 * Assumed. */
#define CEDUO_SPEED_USUAL  35.0
#define CEDUO_HEIGHT_USUAL 10.0

/* True if the forest cannot be judged. Either too few rocks arrive even without it: none, or fewer than one in
 * CEDUO_ARRIVE_MIN if at least that many were simulated. Or the ground contradicts the terrain (CEDUO_TERRAIN_CONTRADICTS).
 * Unfinished rocks count as arriving. False if no rock was simulated. */
bool ceduo_too_few_arrivals(const struct ceduo_arrivals *bare);

/* Compare the rocks that arrive without forest with the terrain. Rocks usually reach places under a steep reach or shadow
 * angle, and rarely reach places under a flat one. Evans and Hungr (1993) suggest 27.5 degrees as minimum shadow angle. Limits
 * assumed. */
#define CEDUO_REACH_STEEP  35.0 /* degrees */
#define CEDUO_SHADOW_STEEP 32.0
#define CEDUO_SHADOW_FLAT  24.0
#define CEDUO_ARRIVE_FEW   0.01 /* share of the released below which few arrive at a steep place */
#define CEDUO_ARRIVE_MANY  0.1  /* share above which many arrive at a flat place */
#define CEDUO_BENCH_LENGTH 10.0 /* m: a bench or ditch of this length may hold rocks */
enum ceduo_terrain { CEDUO_TERRAIN_AGREES, CEDUO_TERRAIN_CONTRADICTS, CEDUO_TERRAIN_BENCH, CEDUO_TERRAIN_FAR };
/* AGREES: nothing is unusual, or no rock was simulated. CONTRADICTS: few arrive at a steep place. BENCH: likewise, but a bench
 * lies before it. FAR: many arrive at a flat place. */
enum ceduo_terrain ceduo_terrain(const struct ceduo_arrivals *bare);

/* Judge whether a share is at most a limit; CEDUO_JUDGEMENT_NOT_DECIDED if its interval holds the limit. */
enum ceduo_judgement ceduo_judge_share(struct ceduo_estimate share, double limit);

/* Assess one belt. */
struct ceduo_stand_result ceduo_assess_stand(const struct ceduo_scene *scene, const struct ceduo_belt *belt);

/* Assess the belts of `option` between the mean release and the control. `bare_mean` is the mean energy (J) of the rocks that
 * reach the control without forest; NaN: none does. */
struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean);

#endif
