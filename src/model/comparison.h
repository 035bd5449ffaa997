/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_COMPARISON_H
#define CEDUO_COMPARISON_H

#include "ceduo/calibrate.h"
#include "io/scene_file.h"
#include "study/seen.h"

/* The scene of the live program, as it is, compared with what was observed there; in levels from coarse to fine. */
#define COMPARISON_LEVELS 2

struct comparison {
    struct scene_file file;            /* as it was; its nodes are the document's */
    uint64_t rocks;                    /* of each setting */
    struct ceduo_predicted *predicted; /* one for each observation */
    struct ceduo_seen_stops *stops;    /* likewise: empty for all that is no list of stops */
};

/* Computes one level. `file` must have an arena of its own, which is the answer's from then on. To be freed in any case. */
enum ceduo_status ceduo_comparison_make(const struct scene_file *file, size_t level, const atomic_bool *cancel,
                                        struct comparison *comparison);
void ceduo_comparison_free(void *comparison);

#endif
