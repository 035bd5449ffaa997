/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UNCERTAINTY_H
#define CEDUO_UNCERTAINTY_H

#include "ceduo/doubt.h"
#include "io/doubt_inputs.h"

/* What doubt does to the scene of the live program, in levels from coarse to fine; after those of today one that has the rotation
 * of each option as well (`rotation` of the answer, ceduo_doubt_verdict()) and takes some seconds. */
#define UNCERTAINTY_LEVELS   2
#define UNCERTAINTY_ROTATION 3

struct uncertainty {
    struct scene_file file; /* as it was; its nodes are the document's */
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer; /* without inputs: empty */
    size_t points, level;
    uint64_t rocks;
};

/* Computes one level. `file` must have an arena of its own, which is the answer's from then on, whatever comes of it.
 * Otherwise than CEDUO_OK: *uncertainty is NULL. */
enum ceduo_status ceduo_uncertainty_make(const struct scene_file *file, size_t level, unsigned threads,
                                         const atomic_bool *cancel, struct uncertainty **uncertainty);
void ceduo_uncertainty_free(struct uncertainty *uncertainty);

#endif
