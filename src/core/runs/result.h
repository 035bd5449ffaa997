/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RESULT_H
#define CEDUO_RESULT_H

#include "ceduo/simulate.h"

/* Read a run of a scene, which may differ from that of the run in fences, design values and return periods. `bare`: results
 * without forest; NULL: the run is without forest. Return CEDUO_NO_MEMORY, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_simulated_read(const struct ceduo_run *run, const struct ceduo_scene *scene,
                                       const struct ceduo_simulated *bare, struct ceduo_simulated *simulated);
/* Set unknown contacts to 0, for a forest without stems. */
void ceduo_simulated_set_no_contacts(struct ceduo_simulated *simulated);
/* Set the hazard relative to `bare`. */
void ceduo_simulated_compare(struct ceduo_simulated *simulated, const struct ceduo_simulated *bare);
void ceduo_simulated_release(struct ceduo_simulated *simulated);

/* Read the runs of a pool and assess every option. Results of runs missing from the pool are NaN. The scene must outlive the
 * result. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_pool *pool,
                                      struct ceduo_result **result);

/* Assess every option from results read earlier: `bare` without forest, `wooded` through the forest of each option, NULL if not
 * known yet. `differences` and `alternatives` (may be NULL) have one row per option and one entry per control. With the contact
 * model index `wooded`, `differences` and `alternatives` are ignored. */
enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, const struct ceduo_simulated *bare,
                                      const struct ceduo_simulated *const *wooded, const struct ceduo_difference *differences,
                                      const struct ceduo_alternative_energy *alternatives, struct ceduo_result **result);
void ceduo_result_free(struct ceduo_result *result);

/* Assess an option from its simulated rocks. Fills `stands` for each belt and `controls` for each control. `wooded` may be
 * empty. */
void ceduo_result_read(const struct ceduo_scene *scene, const struct ceduo_option *option, const struct ceduo_simulated *bare,
                       const struct ceduo_simulated *wooded, struct ceduo_stand_result *stands, struct ceduo_index *controls);

/* Return the number of rocks in each run, and the maximum number of unfinished rocks in a run. */
uint64_t ceduo_result_rocks(const struct ceduo_result *result);
uint64_t ceduo_result_unfinished(const struct ceduo_result *result);

#endif
