/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOUBTED_H
#define CEDUO_DOUBTED_H

#include "ceduo/doubt.h"
#include "io/inputs.h"

/* What doubt does to the scene of the live program, in levels from coarse to fine. */
#define DOUBT_LEVELS 3
#define DOUBT_BEHIND 2 /* levels that are computed behind the figures; the finest only where somebody looks at it */

struct doubted {
    struct scene_file file; /* as it was; its nodes are the document's */
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer; /* without inputs: empty */
    size_t points, level;
    uint64_t rocks;
};

/* Computes one level. `file` must have an arena of its own, which is the answer's from then on, whatever comes of it.
 * CEDUO_CANCELLED, CEDUO_NO_MEMORY: *doubted is NULL. */
enum ceduo_status ceduo_doubted_make(const struct scene_file *file, size_t level, unsigned threads, const atomic_bool *cancel,
                                     struct doubted **doubted);
void ceduo_doubted_free(struct doubted *doubted);

#endif
