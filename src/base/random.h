/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANDOM_H
#define CEDUO_RANDOM_H

#include <stdint.h>

/* What a random number is for. A number depends on seed, rock, event and kind, on nothing else. */
enum random_kind {
    RANDOM_FACET,
    RANDOM_RELEASE,  /* events: x, height, vx, vz, spin */
    RANDOM_ROCK,     /* events: diameter, height, volume, mass, density, axes */
    RANDOM_GROUND,   /* events: Rn, Rt */
    RANDOM_STEM,     /* of a stool or tree: its gap, offset, mark and turn; events: stream, side, number */
    RANDOM_SHOOT,    /* cohorts of four shoots of a stool; which four from bit 8 on */
    RANDOM_DBH,      /* a stem's diameter; the shoot's number from bit 8 on, and from bit 32 on how many were used */
    RANDOM_SECTION,  /* which section of a rock meets the ground, of law arm */
    RANDOM_TURN,     /* how it is turned at a contact */
    RANDOM_SIZE,     /* where the sequence of sizes starts, of no rock */
    RANDOM_GROUP,    /* where a tree of a group stands; its number from bit 8 on */
    RANDOM_POINT,    /* where a study looks: rows and columns in the place of rocks and events */
    RANDOM_SAMPLE,   /* of its bootstrap likewise: samples and points */
    RANDOM_SEQUENCE, /* numbers one after the other: streams and numbers */
    RANDOM_SEED      /* seeds of variants of a scene, random_seed() */
};

/* Purposes of variants of a scene that have rocks of their own. */
enum random_variant {
    VARIANT_YEAR,       /* a year of a window, by its place in the window */
    VARIANT_POINT_YEAR, /* a year at each point of a study */
    VARIANT_PREDICTION  /* predictions of a fit */
};

#define HALF_TURN 3.141592653589793 /* rad */

/* Threefry 2x64 of 20 rounds (Salmon et al. 2011): turns x, an event, and y, a kind, into 2 x 64 bits by the key of seed a
 * and rock b; c: RANDOM_KEY(a, b). For numbers and for registers of them, so it is a macro. */
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
#define RANDOM_ROUND(x, y, turn) x += y, y = (y << turn | y >> (64 - turn)) ^ x
#define RANDOM_FOUR(x, y, r1, r2, r3, r4, key, next, n)                                                                        \
    RANDOM_ROUND(x, y, r1), RANDOM_ROUND(x, y, r2), RANDOM_ROUND(x, y, r3), RANDOM_ROUND(x, y, r4), x += key, y += next + n

struct random_pair {
    double u[2];
};

/* `kind`: an enum random_kind, in some with a number above its low eight bits. */
static inline void random_bits(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind, uint64_t bits[2])
{
    const uint64_t key = RANDOM_KEY(seed, rock);
    RANDOM_BITS(event, kind, seed, rock, key);
    bits[0] = event;
    bits[1] = kind;
}

/* Two uniform numbers in [0, 1). */
static inline struct random_pair random_pair(uint64_t seed, uint64_t rock, uint64_t event, uint64_t kind)
{
    uint64_t bits[2];
    random_bits(seed, rock, event, kind, bits);
    return (struct random_pair){{(double)(bits[0] >> 11) * 0x1p-53, (double)(bits[1] >> 11) * 0x1p-53}};
}

/* The seed of variant `number` of a scene with this seed. Different seeds, variants and numbers have unrelated seeds. */
static inline uint64_t random_seed(uint64_t seed, enum random_variant variant, uint64_t number)
{
    uint64_t bits[2];
    random_bits(seed, variant, number, RANDOM_SEED, bits);
    return bits[0];
}

/* One number of kind `kind`; never 0, so that every quantile of it is finite. */
static inline double random_open(uint64_t seed, uint64_t rock, uint64_t event, enum random_kind kind)
{
    return random_pair(seed, rock, event, kind).u[0] + 0x1p-54;
}

#endif
