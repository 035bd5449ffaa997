/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sequence.h"

#include <limits.h>

#include "base/random.h"

static void set(void *state, unsigned long seed)
{
    *(struct sequence *)state = (struct sequence){.seed = seed};
}

static unsigned long get(void *state)
{
    struct sequence *s = state;
    uint64_t bits[2];
    random_bits(s->seed, s->stream, s->drawn++, RANDOM_SEQUENCE, bits);
    return bits[0];
}

static double get_double(void *state)
{
    return (double)(get(state) >> 11) * 0x1p-53;
}

gsl_rng ceduo_sequence_begin(struct sequence *sequence, uint64_t seed, uint64_t stream)
{
    static const gsl_rng_type threefry = {"threefry2x64", ULONG_MAX, 0, sizeof *sequence, set, get, get_double};
    *sequence = (struct sequence){.seed = seed, .stream = stream};
    return (gsl_rng){&threefry, sequence};
}
