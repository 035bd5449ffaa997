/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_H
#define CEDUO_RUN_H

#include "ceduo/simulate.h"

/* Return the default: without forest, one thread, the scene's number of rocks. */
struct ceduo_run_def ceduo_run_def_default(const struct ceduo_scene *scene);

/* Create a run without rocks. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or a status of ceduo_scene_check(). */
enum ceduo_status ceduo_run_create(const struct ceduo_run_def *def, struct ceduo_run **run);
void ceduo_run_free(struct ceduo_run *run);

/* Simulate rocks until `rocks` are done. The result does not depend on the number of threads and of steps. On CEDUO_CANCELLED
 * or CEDUO_NO_MEMORY the run keeps the finished rocks, and can be read and extended. */
enum ceduo_status ceduo_run_extend(struct ceduo_run *run, uint64_t rocks);

size_t ceduo_run_sample_bytes(const struct ceduo_run *run); /* memory of the values of single rocks */
uint64_t ceduo_run_contacts(const struct ceduo_run *run);   /* ground contacts of all rocks */

struct ceduo_stem_counts ceduo_run_stems(const struct ceduo_run *run);

/* Return this maximum share for a control. With blocks it is the share that gives one such rock per accepted return period;
 * above 1 if fewer blocks come down. */
double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control);

/* Return the share by which a control is judged: exceed, or reach without an accepted energy. */
static inline struct ceduo_estimate ceduo_judged_share(const struct ceduo_arrivals *arrivals)
{
    return isnan(arrivals->exceed.mean) ? arrivals->reach : arrivals->exceed;
}

/* Read the arrivals at a control, an index in the scene's order. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals);

/* As ceduo_run_arrivals(). For a run with blocks also fill `curve`, to which the arrivals then point. */
enum ceduo_status ceduo_run_hazard(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals,
                                   struct ceduo_hazard_curve *curve);

/* Read the rocks at the fence of a control. `scene` may differ from that of the run in its fences and design values. `bare`:
 * arrivals at this control without forest; NULL: the run is without forest. ceduo_fence_none() if the scene has neither a fence
 * there nor design values. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_run_fence(const struct ceduo_run *run, const struct ceduo_scene *scene, size_t control,
                                  const struct ceduo_arrivals *bare, struct ceduo_fence_arrivals *fence);

/* Return the mean energy (J) of the rocks that reach a control, without interval, and set how many do. It is cheap. */
struct ceduo_estimate ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached);

/* Shares and means for `groups` consecutive groups of nearly equal size. Cheap, too. Requires at least `groups` rocks. */
struct ceduo_group_means {
    double reach_probability, exceed_probability; /* of the released; exceed: NaN without an accepted energy */
    double defeated_probability;                  /* share of the released; NaN without a fence */
    double energy;                                /* mean of the rocks that reach, J; NaN if none does */
    double energy_per_released;                   /* J */
};
void ceduo_run_group_means(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs);

/* Return `run` less `baseline`, two runs of one scene; all NaN if one is NULL. If one is longer, only rocks that both have
 * count. Both simulate the same rocks. The error of the difference is small if the forests are similar. */
struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control);

/* Return the difference of a run to itself: 0 without error. `exceed` is NaN if `accepted` is. */
struct ceduo_difference ceduo_difference_zero(double accepted);

/* Read the ends. In a run with arrivals_only all counts are 0 and all places NaN. */
enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends);

/* Write the energies (J) of the first `max` rocks that reach a control, for a histogram. With blocks an energy is repeated in
 * proportion to its weight. Return the number written. */
size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max);

#endif
