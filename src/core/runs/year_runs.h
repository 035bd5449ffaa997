/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YEAR_RUNS_H
#define CEDUO_YEAR_RUNS_H

#include "ceduo/years.h"
#include "fence.h"

/* Return at most `max` (> 0) of its years, evenly spread. */
struct ceduo_window ceduo_window_thinned(struct ceduo_window window, unsigned max);

/* Grow the stands of an option to the years of a window, without simulating or assessing. Everything that the option points to
 * must outlive the years. Return CEDUO_NO_MEMORY, CEDUO_BAD_STAND, CEDUO_BAD_ARGUMENT (a window without a year, with more than
 * CEDUO_YEARS_MAX, or beyond CEDUO_YEAR_MAX) or CEDUO_OK. */
enum ceduo_status ceduo_years_create(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                     struct ceduo_window window, struct ceduo_years **years);
void ceduo_years_free(struct ceduo_years *years);

/* Simulate `rocks` rocks in every year with the runs of the pool, once for years with the same forest. Then assess every year;
 * `bare` are the results without forest. With the contact model index, or 0 rocks, no rock is simulated. On CEDUO_CANCELLED or
 * CEDUO_NO_MEMORY only the earlier years are assessed. */
enum ceduo_status ceduo_years_simulate(struct ceduo_years *years, struct ceduo_pool *pool, const struct ceduo_simulated *bare,
                                       uint64_t rocks);

/* As ceduo_years_simulate(), but each year has independent rocks. A year has the same rocks in every window. The errors cancel
 * out in the mean over the years, so that few rocks suffice. `def` is of the scene. Requires a scene without blocks. */
enum ceduo_status ceduo_years_simulate_independent(struct ceduo_years *years, const struct ceduo_run_def *def,
                                                   const struct ceduo_simulated *bare, uint64_t rocks);

/* Assess simulated years again, for a scene that differs only in settings that do not affect trajectories: threshold, rule of
 * the ADC, rocks per year. Requires controls at the same places; `bare` belongs to them. */
void ceduo_years_assess(struct ceduo_years *years, const struct ceduo_scene *scene, const struct ceduo_simulated *bare);

/* Read the years at the fence of a control; `today`: arrivals with the forest of today. The loads are known without a fence,
 * too, if the scene requests design values. */
struct ceduo_fence_years ceduo_years_fence(const struct ceduo_years *years, size_t control, const struct ceduo_arrivals *today);

/* Return the felled length of belts, m, summed over all cuts in the computed years: m2 per metre of width. */
double ceduo_years_felled(const struct ceduo_years *years);

#endif
