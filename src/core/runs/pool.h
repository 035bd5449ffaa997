/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POOL_H
#define CEDUO_POOL_H

#include "ceduo/simulate.h"

/* Create a pool for the scene of `def`; its `option` is ignored. Return CEDUO_NO_MEMORY or a status of ceduo_scene_check(). */
enum ceduo_status ceduo_pool_create(const struct ceduo_run_def *def, struct ceduo_pool **pool);

/* Reuse *pool for the scene of `def` by ceduo_pool_set_scene() if only the forests differ; otherwise free and recreate it.
 * *pool may be NULL; it is NULL unless CEDUO_OK is returned. A reused pool keeps its threads, cancel and progress. */
enum ceduo_status ceduo_pool_reuse_or_create(const struct ceduo_run_def *def, struct ceduo_pool **pool);

/* Get the run through the forest of `option` (NULL: without forest) at its current length. The pool owns it. */
enum ceduo_status ceduo_pool_run(struct ceduo_pool *pool, const struct ceduo_option *option, struct ceduo_run **run);

/* Create all runs that the results need: one without forest and, unless the contact model is index, one through each forest. If
 * `alternative_energy` is set, each forest also gets a run under the other energy law. Calling it again for the same scene has
 * no effect. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_pool_fill(struct ceduo_pool *pool);

/* Get the run through the forest of `option` (NULL: without forest) with at least `rocks` rocks. */
enum ceduo_status ceduo_pool_simulate(struct ceduo_pool *pool, const struct ceduo_option *option, uint64_t rocks,
                                      struct ceduo_run **run);

/* Extend every run of the pool to `rocks`, as ceduo_run_extend(). */
enum ceduo_status ceduo_pool_extend(struct ceduo_pool *pool, uint64_t rocks);

#define CEDUO_ARRIVALS_MIN 100 /* with fewer arrivals the tolerance is ignored */

/* True if the 95 % half-width of a mean of `reached` arrivals is at most `tolerance` × the mean, or if there are too few. */
bool ceduo_mean_is_precise(uint64_t reached, struct ceduo_estimate mean, double tolerance);

/* Extend all runs, from one batch on by an eighth each time, until the mean energies are precise or `max` rocks are done. At
 * every control with at least CEDUO_ARRIVALS_MIN arrivals the 95 % half-width must be below `tolerance` × the mean. Sets
 * *met. */
enum ceduo_status ceduo_pool_run_to_tolerance(struct ceduo_pool *pool, double tolerance, uint64_t max, bool *met);

/* Switch the pool to a scene that differs only in forests, options, names and titles. Frees runs of forests that the scene no
 * longer has, except the CEDUO_POOL_SPARE most recently used. */
#define CEDUO_POOL_SPARE 16
void ceduo_pool_set_scene(struct ceduo_pool *pool, const struct ceduo_scene *scene);

/* Free runs that the scene does not need, such as runs of years, oldest first, until all samples fit into CEDUO_POOL_BYTES. */
#define CEDUO_POOL_BYTES ((size_t)256 * 1024 * 1024)
void ceduo_pool_trim(struct ceduo_pool *pool);

struct ceduo_work ceduo_pool_work(const struct ceduo_pool *pool);

#endif
