/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENVELOPE_H
#define CEDUO_ENVELOPE_H

#include <stdatomic.h>
#include <stddef.h>

#include "ceduo/scene.h"

/* Order statistics of rocks along the slope. */

#define CEDUO_ENVELOPE_ROCKS 2000

struct ceduo_envelopes_def {
    const struct ceduo_scene *scene;   /* checked */
    const struct ceduo_option *option; /* NULL: without forest */
    uint64_t rocks;                    /* at most CEDUO_ENVELOPE_ROCKS */
    size_t places;
    const double *x;           /* m, increasing, on the slope, below each release */
    const atomic_bool *cancel; /* may be NULL */
};

/* Quantiles 5, 50 and 95 %, and maximum, of the rocks that pass a place; NaN if none passes. */
struct ceduo_spread_of_cell {
    double p5, p50, p95, max;
};
struct ceduo_envelope {
    uint64_t passed;                            /* number of rocks */
    double mean_energy;                         /* J, of the rocks that pass; NaN: none */
    struct ceduo_spread_of_cell height, energy; /* m, J */
};

/* Simulate rocks and write an envelope for each place. With blocks, uses only rocks drawn with natural size frequencies.
 * Returns CEDUO_NO_MEMORY, CEDUO_CANCELLED or CEDUO_OK. */
enum ceduo_status ceduo_envelopes(const struct ceduo_envelopes_def *def, struct ceduo_envelope *envelopes);

#endif
