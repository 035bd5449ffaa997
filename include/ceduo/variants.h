/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VARIANTS_H
#define CEDUO_VARIANTS_H

#include "pool.h"

/* The one engine for scenes that are variants of another: years, other sizes of the rock, what uncertainty says they may be. Each is
 * made, simulated and read, one after the other. A caller that has many variants of few rocks runs several lists at once. */
struct ceduo_variant {
    struct ceduo_run_def run; /* its scene and option, and how its rocks are simulated; of a pool: the option alone */
    uint64_t rocks;           /* when it is read first */
    bool skip;                /* it is neither simulated nor read */
};

struct ceduo_variants {
    size_t n;
    /* Makes variant i; the scene that it points to must last until it is read. */
    enum ceduo_status (*make)(void *context, size_t i, struct ceduo_variant *variant);
    /* Reads variant i. `*rocks`: as many as it has; set to more, it is made so long and read again. */
    enum ceduo_status (*read)(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks);
    /* The rocks of variant i meet the same as those of `first`, which has been read. NULL: nobody asks. */
    void (*same)(void *context, size_t i, size_t first);
    struct ceduo_pool *pool; /* of the scene of all variants; it keeps their runs. NULL: a run is freed once it is read */
    void *context;
};

/* CEDUO_OK, or the first other status, which ends it. */
enum ceduo_status ceduo_variants_run(const struct ceduo_variants *variants);

#endif
