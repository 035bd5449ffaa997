/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MANY_H
#define CEDUO_MANY_H

#include <stdint.h>
#include <string.h>

/* Some numbers at once in plain C, by the compilers' vectors: MANY of them, as fits the target for which the including file is
 * compiled. The bits are the same for each target. They go by pointers, as how they are passed
 * by value depends on the target. */
#ifndef MANY
#define MANY 8
#endif
typedef double many_reals __attribute__((vector_size(8 * MANY)));
typedef uint64_t many_bits __attribute__((vector_size(8 * MANY)));

#define REAL many_reals
#define BITS many_bits
#define AS_BITS(p) ((many_bits)(p))
#define AS_REAL(p) ((many_reals)(p))
#define PICK(m, p, q) ((many_reals)(((many_bits)(m) & (many_bits)(p)) | (~(many_bits)(m) & (many_bits)(q))))
#define ELEMENTARY(name) many_##name
#include "base/elementary_text.h"
#undef REAL
#undef BITS
#undef AS_BITS
#undef AS_REAL
#undef PICK
#undef ELEMENTARY

/* n, n + step, n + 2 step … */
static inline void many_from(uint64_t n, uint64_t step, many_bits *result)
{
    static const many_bits places = {0, 1,
#if MANY > 2
                                     2, 3,
#endif
#if MANY > 4
                                     4, 5, 6, 7
#endif
    };
    *result = places * step + n;
}

/* As doubles; below 2^52. */
static inline void many_of_integers(const many_bits *p, many_reals *result)
{
    *result = (many_reals)(*p | 0x4330000000000000) - 0x1p52;
}

static inline void many_threefry_round(many_bits *p, many_bits *q, int turn)
{
    *p += *q;
    *q = (*q << turn | *q >> (64 - turn)) ^ *p;
}

/* Threefry 2x64 of (*p, *q), keyed by seed and rock, as random.h has it for one. */
static inline void many_threefry(uint64_t seed, uint64_t rock, many_bits *p, many_bits *q)
{
    static const int turns[2][4] = {{16, 42, 12, 31}, {16, 32, 24, 21}};
    const uint64_t key[3] = {seed, rock, 0x1BD11BDAA9FC1A22 ^ seed ^ rock};
    *p += key[0];
    *q += key[1];
    for (unsigned i = 1; i <= 5; i++) {
        for (unsigned k = 0; k < 4; k++)
            many_threefry_round(p, q, turns[(i + 1) % 2][k]);
        *p += key[i % 3];
        *q += key[(i + 1) % 3] + i;
    }
}

#endif
