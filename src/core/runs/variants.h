/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VARIANTS_H
#define CEDUO_VARIANTS_H

#include "ceduo/simulate.h"

/* Simulates variants of a scene: years, other sizes of the rock, plausible scenes. Each is made, simulated and read, one after
 * the other. A caller with many variants of few rocks runs several lists at once. */
struct ceduo_variant {
    struct ceduo_run_def run; /* scene, option, and how rocks are simulated; with a pool only the option is used */
    uint64_t rocks;           /* at the first call of read() */
    bool skip;                /* true: neither simulate nor read it */
};

struct ceduo_variants {
    size_t n;
    /* Makes variant i; its scene must stay valid until the variant is read. */
    enum ceduo_status (*make)(void *context, size_t i, struct ceduo_variant *variant);
    /* Reads variant i. *rocks is its number of rocks; set to a larger number, the run is extended and read again. */
    enum ceduo_status (*read)(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks);
    /* Called if variant i has the trajectories of variant `first`, which has been read. May be NULL. */
    void (*same)(void *context, size_t i, size_t first);
    struct ceduo_pool *pool; /* pool of the scene, which keeps the runs; NULL: a run is freed once it is read */
    void *context;
};

/* Return CEDUO_OK, or the first other status, which stops the work. */
enum ceduo_status ceduo_variants_run(const struct ceduo_variants *variants);

#endif
