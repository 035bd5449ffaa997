/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEQUENCE_H
#define CEDUO_SEQUENCE_H

#include <gsl/gsl_rng.h>
#include <stdint.h>

/* The program's one generator (base/random.h) as GSL draws from it: numbers one after the other, of a seed and one of many
 * streams. Nothing is allocated: the generator lasts as long as its sequence. */
struct sequence {
    uint64_t seed, stream, drawn;
};

gsl_rng ceduo_sequence(struct sequence *sequence, uint64_t seed, uint64_t stream);

#endif
