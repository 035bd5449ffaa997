/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANDOM_H
#define CEDUO_RANDOM_H

#include <stdint.h>

/* Random123's own header is not written for our warnings. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <Random123/threefry.h>
#pragma GCC diagnostic pop

/* What a random number is for. A number depends on seed, rock, event and kind, on nothing else. */
enum random_kind {
    RANDOM_FACET,
    RANDOM_RELEASE, /* events: x, height, vx, vz, spin */
    RANDOM_ROCK,    /* events: diameter, height, volume, mass, density, axes */
    RANDOM_GROUND,  /* events: Rn, Rt */
    RANDOM_STEM,    /* of a stool or tree: its gap, offset, mark and turn; events: stream, side, number */
    RANDOM_SHOOT,   /* cohorts of four shoots of a stool; which four from bit 8 on */
    RANDOM_DBH,     /* a stem's diameter; the shoot's number from bit 8 on, and from bit 32 on how many were used */
    RANDOM_SECTION, /* which section of a rock meets the ground, of law arm */
    RANDOM_TURN,    /* how it is turned at a contact */
    RANDOM_SIZE,    /* where the sequence of sizes starts, of no rock */
    RANDOM_GROUP    /* where a tree of a group stands; its number from bit 8 on */
};

#define HALF_TURN 3.141592653589793 /* rad */

struct random_pair {
    double u[2];
};

/* 2 x 64 bits: Threefry 2x64 keyed by seed and rock (Salmon et al. 2011). `kind`: an enum random_kind, in some with a
 * number above its low eight bits. */
static inline void random_bits(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind, uint64_t bits[2])
{
    threefry2x64_ctr_t c = {{event, kind}};
    threefry2x64_key_t k = {{seed, rock}};
    threefry2x64_ctr_t r = threefry2x64(c, k);
    bits[0] = r.v[0];
    bits[1] = r.v[1];
}

/* Two uniform numbers in [0, 1). */
static inline struct random_pair random_pair(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind)
{
    uint64_t bits[2];
    random_bits(seed, rock, event, kind, bits);
    return (struct random_pair){{(double)(bits[0] >> 11) * 0x1p-53, (double)(bits[1] >> 11) * 0x1p-53}};
}

/* One number of kind `kind`; never 0, so that every quantile of it is finite. */
static inline double random_open(uint64_t seed, uint64_t rock, uint64_t event, enum random_kind kind)
{
    return random_pair(seed, rock, event, kind).u[0] + 0x1p-54;
}

#endif
