/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MANY_H
#define CEDUO_MANY_H

#include <stdint.h>
#include <string.h>

/* Some numbers at once in plain C, by the compilers' vectors: MANY of them, as fits the target for which the including
 * file is compiled. The bits are the same for each target. They go by pointers, as how they are passed by value
 * depends on the target. */
#ifndef MANY
#define MANY 8
#endif
#define MANY_INLINE static inline __attribute__((always_inline))
typedef double many_reals __attribute__((vector_size(8 * MANY)));
typedef uint64_t many_bits __attribute__((vector_size(8 * MANY)));

#define REAL             many_reals
#define BITS             many_bits
#define AS_BITS(p)       ((many_bits)(p))
#define AS_REAL(p)       ((many_reals)(p))
#define PICK(m, p, q)    ((many_reals)(((many_bits)(m) & (many_bits)(p)) | (~(many_bits)(m) & (many_bits)(q))))
#define ELEMENTARY(name) many_##name
#include "base/elementary_text.h"

/* n, n + step, n + 2 step … */
MANY_INLINE void many_from(uint64_t n, uint64_t step, many_bits *result)
{
    static const many_bits places = {
        0,
        1,
#if MANY > 2
        2,
        3,
#endif
#if MANY > 4
        4,
        5,
        6,
        7
#endif
    };
    *result = places * step + n;
}

/* As doubles; below 2^52. */
MANY_INLINE void many_of_integers(const many_bits *p, many_reals *result)
{
    *result = (many_reals)(*p | 0x4330000000000000) - 0x1p52;
}

/* Puts those of *from whose lane of *which is all ones at *to, in their order, without gaps; there is room for MANY. A
 * lane of *which that is not all ones is 0. */
#if defined MANY_AVX512
MANY_INLINE void many_keep(const many_bits *which, const many_bits *from, void *to)
{
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(_mm512_movepi64_mask((__m512i)*which), (__m512i)*from));
}

MANY_INLINE unsigned many_count(const many_bits *which)
{
    return (unsigned)__builtin_popcount(_mm512_movepi64_mask((__m512i)*which));
}
#elif defined MANY_AVX2
#define HALVES(lane) ((uint64_t)(2 * (lane) + 1) << 32 | 2 * (lane))
#define KEPT(a, b, c, d)                                                                                                       \
    {                                                                                                                          \
        HALVES(a), HALVES(b), HALVES(c), HALVES(d)                                                                             \
    }
MANY_INLINE void many_keep(const many_bits *which, const many_bits *from, void *to)
{
    static const many_bits kept[] = {KEPT(0, 0, 0, 0), KEPT(0, 0, 0, 0), KEPT(1, 0, 0, 0), KEPT(0, 1, 0, 0),
                                     KEPT(2, 0, 0, 0), KEPT(0, 2, 0, 0), KEPT(1, 2, 0, 0), KEPT(0, 1, 2, 0),
                                     KEPT(3, 0, 0, 0), KEPT(0, 3, 0, 0), KEPT(1, 3, 0, 0), KEPT(0, 1, 3, 0),
                                     KEPT(2, 3, 0, 0), KEPT(0, 2, 3, 0), KEPT(1, 2, 3, 0), KEPT(0, 1, 2, 3)};
    int mask = _mm256_movemask_pd((__m256d)*which);
    _mm256_storeu_si256(to, _mm256_permutevar8x32_epi32((__m256i)*from, (__m256i)kept[mask]));
}

MANY_INLINE unsigned many_count(const many_bits *which)
{
    return (unsigned)__builtin_popcount((unsigned)_mm256_movemask_pd((__m256d)*which));
}
#undef KEPT
#undef HALVES
#else
MANY_INLINE void many_keep(const many_bits *which, const many_bits *from, void *to)
{
    char *at = to;
    for (int i = 0; i < MANY; i++) {
        uint64_t one = (*from)[i];
        memcpy(at, &one, sizeof one);
        at += (*which)[i] & sizeof one;
    }
}

MANY_INLINE unsigned many_count(const many_bits *which)
{
    uint64_t n = 0;
    for (int i = 0; i < MANY; i++)
        n += (*which)[i] & 1;
    return (unsigned)n;
}
#endif

/* Threefry 2x64 of (*p, *q), keyed by seed and rock, as random.h has it for one. */
MANY_INLINE void many_threefry(uint64_t seed, uint64_t rock, many_bits *p, many_bits *q)
{
    const uint64_t a = seed, b = rock, c = 0x1BD11BDAA9FC1A22 ^ seed ^ rock;
    many_bits x = *p + a, y = *q + b;
#define ROUND(turn)                                                                                                            \
    x += y;                                                                                                                    \
    y = (y << turn | y >> (64 - turn)) ^ x
#define FOUR(r1, r2, r3, r4, key, next, n)                                                                                     \
    ROUND(r1);                                                                                                                 \
    ROUND(r2);                                                                                                                 \
    ROUND(r3);                                                                                                                 \
    ROUND(r4);                                                                                                                 \
    x += key;                                                                                                                  \
    y += next + n
    FOUR(16, 42, 12, 31, b, c, 1);
    FOUR(16, 32, 24, 21, c, a, 2);
    FOUR(16, 42, 12, 31, a, b, 3);
    FOUR(16, 32, 24, 21, b, c, 4);
    FOUR(16, 42, 12, 31, c, a, 5);
#undef FOUR
#undef ROUND
    *p = x;
    *q = y;
}

#endif
