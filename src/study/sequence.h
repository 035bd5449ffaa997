/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEQUENCE_H
#define CEDUO_SEQUENCE_H

#include <gsl/gsl_rng.h>
#include <stdint.h>

/* The random numbers of base/random.h as a generator of GSL, by seed and stream. Allocates nothing. The generator is valid
 * as long as `sequence`. */
struct sequence {
    uint64_t seed, stream, drawn;
};

gsl_rng ceduo_sequence_begin(struct sequence *sequence, uint64_t seed, uint64_t stream);

#endif
