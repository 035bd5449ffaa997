/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POOL_H
#define CEDUO_POOL_H

#include "run.h"

/* The runs of a scene: one without forest and one for each forest, each made once however often it is asked for. All fly
 * the same rocks with the same random numbers, so that their differences are those of the forests. */
struct ceduo_pool;

/* A pool for the scene of `def`, whose `option` is not looked at. CEDUO_NO_MEMORY or what ceduo_scene_check() says. */
enum ceduo_status ceduo_pool_create(const struct ceduo_run_def *def, struct ceduo_pool **pool);
void ceduo_pool_free(struct ceduo_pool *pool);

/* A pool for the scene of `def` from what was kept: *pool is turned to it, see ceduo_pool_set_scene(), or freed and made anew
 * where its rocks meet anything else than a forest that differs. *pool may be NULL; it is NULL unless CEDUO_OK. A pool
 * that is kept simulates as it was made: threads, cancel and progress stay those. */
enum ceduo_status ceduo_pool_reuse_or_create(const struct ceduo_run_def *def, struct ceduo_pool **pool);

/* The run through the forest of `option` (NULL: without forest), as long as it is; the pool's. CEDUO_NO_MEMORY. */
enum ceduo_status ceduo_pool_run(struct ceduo_pool *pool, const struct ceduo_option *option, struct ceduo_run **run);

/* All that a scene's results need: for each option the run without forest, and unless the contact model is index that
 * through its forest, and where the pool is for that also under the other energy law. Once more for one scene it does nothing. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_pool_fill(struct ceduo_pool *pool);

/* The run of that forest if the pool has it, otherwise NULL. */
struct ceduo_run *ceduo_pool_find(const struct ceduo_pool *pool, const struct ceduo_option *option);

/* The run through the forest of `option` (NULL: without forest), made as long as `rocks`. */
enum ceduo_status ceduo_pool_simulate(struct ceduo_pool *pool, const struct ceduo_option *option, uint64_t rocks,
                                      struct ceduo_run **run);

/* Makes every run of the pool as long as `rocks`, as ceduo_run_extend(). */
enum ceduo_status ceduo_pool_extend(struct ceduo_pool *pool, uint64_t rocks);

#define CEDUO_ARRIVALS_MIN 100 /* arrivals below which a mean is not waited for */

/* Whether the 95 % half-width of a mean of so many arrivals is at most `tolerance` of it, or they are too few to wait for. */
bool ceduo_mean_is_precise(uint64_t reached, struct ceduo_estimate mean, double tolerance);

/* Makes them longer, from one block on by an eighth each time, until the 95 % half-width of the mean energy of every run at every
 * control that at least CEDUO_ARRIVALS_MIN of its rocks reach is below `tolerance` of it, or `max` rocks are done. `*met`:
 * whether it is. */
enum ceduo_status ceduo_pool_run_to_tolerance(struct ceduo_pool *pool, double tolerance, uint64_t max, bool *met);

/* Turns the pool to a scene that differs in nothing but its forests and options, names and titles. Runs of forests that
 * it has no more are freed, but for the CEDUO_POOL_SPARE that were asked for last. */
#define CEDUO_POOL_SPARE 16
void ceduo_pool_set_scene(struct ceduo_pool *pool, const struct ceduo_scene *scene);

/* Frees runs that the scene does not need, as those of years, the oldest first, until the samples of all runs take no
 * more than CEDUO_POOL_BYTES. */
#define CEDUO_POOL_BYTES ((size_t)256 * 1024 * 1024)
void ceduo_pool_trim(struct ceduo_pool *pool);

/* What was done so far. */
struct ceduo_work {
    uint64_t rocks, contacts; /* simulated, with the ground: of all runs */
    struct ceduo_stem_counts stems;
    uint64_t runs, reused; /* made; asked for once more */
};
struct ceduo_work ceduo_pool_work(const struct ceduo_pool *pool);

#endif
