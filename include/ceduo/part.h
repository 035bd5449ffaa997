/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PART_H
#define CEDUO_PART_H

#include "pool.h"

/* A run in parts that are simulated apart, maybe on several machines, and joined to the very same run. A part keeps the sums
 * of each of its blocks by itself: joining adds them in the order of the blocks, as one run does, and only then are the
 * figures the same to the last bit. With them go what arrived at each control, rock by rock, or beyond exact_bytes (of
 * the whole run) the histograms and the first rocks' energies.
 *
 * To make one: a def with rocks_most of the whole run, `part` and `first`; then extend it to `end`. Such a run is to be
 * saved, not read; it counts its rocks from the first of the whole run. To join: a run or a pool of the same scene
 * without rocks, with rocks_most and exact_bytes as they were; then adopt every part in the order of the rocks. */

/* The rocks of part 1…parts: whole blocks of CEDUO_BLOCK_ROCKS, but for the last of the run; none (first = end) where
 * there are more parts than blocks. */
void ceduo_part_range(uint64_t rocks, uint64_t part, uint64_t parts, uint64_t *first, uint64_t *end);

/* The bytes of all runs of a pool that ceduo_pool_fill() has filled, for the caller to free. CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_pool_save(const struct ceduo_pool *pool, unsigned char **bytes, size_t *n);

/* Continues a pool's runs with what was saved. The bytes may come from anywhere: every count in them is checked before it
 * is used. CEDUO_BAD_PART where they are not whole, not of such runs, or do not begin where these stand. After an error the
 * pool is only to be freed. */
enum ceduo_status ceduo_pool_adopt(struct ceduo_pool *pool, const unsigned char *bytes, size_t n);

#endif
