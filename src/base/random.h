/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANDOM_H
#define CEDUO_RANDOM_H

#include <stdint.h>

/* Purpose of a random number. A number depends only on seed, rock, event and kind. */
enum random_kind {
    RANDOM_FACET,
    RANDOM_RELEASE,  /* events: x, height, vx, vz, spin, choice of the release */
    RANDOM_ROCK,     /* events: diameter, height, volume, mass, density, axes */
    RANDOM_GROUND,   /* events: Rn, Rt */
    RANDOM_STEM,     /* gap, offset, mark and rotation of a stool or tree; events: stream, side, number */
    RANDOM_SHOOT,    /* cohorts of four shoots of a stool; index of the four from bit 8 on */
    RANDOM_DBH,      /* diameter of a stem; number of the shoot from bit 8 on, count of rejected draws from bit 32 on */
    RANDOM_SECTION,  /* section of a rock that meets the ground, in law arm */
    RANDOM_TURN,     /* orientation of the section at a contact */
    RANDOM_SIZE,     /* start of the sequence of sizes; not of a rock */
    RANDOM_GROUP,    /* place of a tree of a group; its number from bit 8 on */
    RANDOM_POINT,    /* points of a study: rows and columns instead of rocks and events */
    RANDOM_SAMPLE,   /* bootstrap of a study: samples and points instead of rocks and events */
    RANDOM_SEQUENCE, /* sequences: streams and numbers */
    RANDOM_SEED      /* seeds of variants of a scene, random_seed() */
};

/* Purposes of scene variants with independent rocks. */
enum random_variant {
    VARIANT_YEAR,       /* a year of a window, by its index in the window */
    VARIANT_POINT_YEAR, /* a year at each point of a study */
    VARIANT_PREDICTION  /* predictions of a fit */
};

#define HALF_TURN 3.141592653589793 /* rad */

/* Threefry 2x64 with 20 rounds (Salmon et al. 2011). Transforms x, an event, and y, a kind, into 2 × 64 bits by the key of seed
 * a and rock b; c is RANDOM_KEY(a, b). A macro, because it serves integers and registers. */
#define RANDOM_KEY(a, b) (0x1BD11BDAA9FC1A22 ^ (a) ^ (b))
#define RANDOM_BITS(x, y, a, b, c)                                                                                             \
    do {                                                                                                                       \
        x += a, y += b;                                                                                                        \
        RANDOM_FOUR(x, y, 16, 42, 12, 31, b, c, 1);                                                                            \
        RANDOM_FOUR(x, y, 16, 32, 24, 21, c, a, 2);                                                                            \
        RANDOM_FOUR(x, y, 16, 42, 12, 31, a, b, 3);                                                                            \
        RANDOM_FOUR(x, y, 16, 32, 24, 21, b, c, 4);                                                                            \
        RANDOM_FOUR(x, y, 16, 42, 12, 31, c, a, 5);                                                                            \
    } while (0)
#define RANDOM_ROUND(x, y, distance) x += y, y = (y << distance | y >> (64 - distance)) ^ x
#define RANDOM_FOUR(x, y, r1, r2, r3, r4, key, next, n)                                                                        \
    RANDOM_ROUND(x, y, r1), RANDOM_ROUND(x, y, r2), RANDOM_ROUND(x, y, r3), RANDOM_ROUND(x, y, r4), x += key, y += next + n

struct random_pair {
    double u[2];
};

/* `kind`: an enum random_kind, for some kinds with a number from bit 8 on. */
static inline void random_bits(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind, uint64_t bits[2])
{
    const uint64_t key = RANDOM_KEY(seed, rock);
    RANDOM_BITS(event, kind, seed, rock, key);
    bits[0] = event;
    bits[1] = kind;
}

/* Return two uniform numbers in [0, 1). */
static inline struct random_pair random_pair(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind)
{
    uint64_t bits[2];
    random_bits(seed, rock, event, kind, bits);
    return (struct random_pair){{(double)(bits[0] >> 11) * 0x1p-53, (double)(bits[1] >> 11) * 0x1p-53}};
}

/* Return the seed of variant `number` of a scene. Different seeds, variants and numbers give unrelated seeds. */
static inline uint64_t random_seed(uint64_t seed, enum random_variant variant, uint64_t number)
{
    uint64_t bits[2];
    random_bits(seed, variant, number, RANDOM_SEED, bits);
    return bits[0];
}

/* Return a uniform number in (0, 1); never 0, so that every quantile of it is finite. */
static inline double random_open(uint64_t seed, uint64_t rock, uint64_t event, enum random_kind kind)
{
    return random_pair(seed, rock, event, kind).u[0] + 0x1p-54;
}

#endif
