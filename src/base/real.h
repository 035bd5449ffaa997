/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REAL_H
#define CEDUO_REAL_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "elementary.h"

/* `real` is a number, or a register of numbers. Code written for `real` serves both, with the same bits in each lane. The
 * operators + - * / and, for `ints`, & | ^ << >> are those of C; all other operations are defined here. The including file sets
 * REAL_LANES: 1; 8 if its target is AVX-512 with DQ; 4 for AVX2; 2 for any other target. */
#ifndef REAL_LANES
#define REAL_LANES 1
#endif

/* The walk is one inlined body from contact to contact, so that a flight stays in registers. Rare paths are function calls. */
#define FORCE_INLINE static inline __attribute__((always_inline))
#define NOINLINE     static __attribute__((noinline))

#define SIGN_BIT 0x8000000000000000

/* Define a function of one expression. */
#define OP(result, name, parameters, ...)                                                                                      \
    FORCE_INLINE result name parameters                                                                                        \
    {                                                                                                                          \
        return __VA_ARGS__;                                                                                                    \
    }

#if REAL_LANES == 1

typedef double real;
typedef uint64_t ints;
typedef bool mask; /* combine masks by & and |, and by and_not() */

OP(real, splat, (double s), s)
OP(ints, as_ints, (real p), elementary_bits(p))
OP(real, as_real, (ints p), elementary_real(p))
OP(mask, less, (real p, real q), p < q)
OP(mask, greater_equal, (real p, real q), p >= q)
OP(mask, equal, (real p, real q), p == q)
OP(mask, and_not, (mask p, mask q), p && !q)
OP(real, zero_if, (mask m, real p), m ? 0 : p)
OP(bool, any, (mask p), p)
FORCE_INLINE real blend(mask m, real p, real q) /* p if m is set, otherwise q */
{
    if (m) {
#ifdef __x86_64__
        __asm__("" : "+x"(p)); /* force a branch, which is predicted; a conditional move would wait for both values */
#endif
        return p;
    }
    return q;
}
OP(real, vsqrt, (real p), sqrt(p))
OP(real, min, (real p, real q), p < q ? p : q) /* exactly this expression, for NaN and -0 */
OP(real, max, (real p, real q), p > q ? p : q)
OP(real, clamp, (real v, real a, real b), (v < a) ? a : (v > b) ? b : v) /* a <= b */
OP(real, vabs, (real p), fabs(p))
OP(real, vcopysign, (real p, real q), copysign(p, q)) /* magnitude of p with the sign of q */

#else

/* ---- registers ---- */

typedef double real __attribute__((vector_size(8 * REAL_LANES)));
typedef uint64_t ints __attribute__((vector_size(8 * REAL_LANES)));
#define EACH_LANE(i) for (size_t i = 0; i < REAL_LANES; i++)
#define REGISTER     ((1u << REAL_LANES) - 1) /* one bit per lane */

/* Select numbers of two registers by index. Before version 12 gcc has another builtin. */
#if defined(__clang__) || __GNUC__ >= 12
#define SHUFFLED(p, q, ...) __builtin_shufflevector(p, q, __VA_ARGS__)
#else
#define SHUFFLED(p, q, ...) __builtin_shuffle(p, q, (ints){__VA_ARGS__})
#endif

OP(ints, as_ints, (real p), (ints)p)
OP(real, as_real, (ints p), (real)p)
OP(ints, splat_ints, (uint64_t s), (ints){0} + s)
FORCE_INLINE real load(const double *from)
{
    real p;
    memcpy(&p, from, sizeof p);
    return p;
}
FORCE_INLINE ints load_ints(const uint64_t *from)
{
    ints p;
    memcpy(&p, from, sizeof p);
    return p;
}
FORCE_INLINE void store(double *to, real p)
{
    memcpy(to, &p, sizeof p);
}
FORCE_INLINE void store_ints(uint64_t *to, ints p)
{
    memcpy(to, &p, sizeof p);
}

#if REAL_LANES >= 4

#include <immintrin.h>

/* Load pairs i and j. Separate loads are faster than gather instructions. */
FORCE_INLINE __m256d load_pair_rows(const double (*pairs)[2], uint64_t i, uint64_t j)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(pairs[i])), _mm_loadu_pd(pairs[j]), 1);
}

#endif

#if REAL_LANES == 8

typedef __mmask8 mask;

OP(real, splat, (double s), _mm512_set1_pd(s))
OP(mask, less, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_LT_OQ))
OP(mask, greater_equal, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_GE_OQ))
OP(mask, equal, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_EQ_OQ))
OP(mask, equal_ints, (ints p, ints q), _mm512_cmpeq_epi64_mask((__m512i)p, (__m512i)q))
OP(mask, greater_ints, (ints p, ints q), _mm512_cmpgt_epi64_mask((__m512i)p, (__m512i)q)) /* p > q, as signed numbers */
OP(mask, and_not, (mask p, mask q), (mask)(p & ~(unsigned)q))                             /* p and not q */
OP(unsigned, lane_bits, (mask p), p)                                                      /* bit i is lane i */
OP(mask, lane_mask, (unsigned lanes), (mask)lanes)
OP(real, blend, (mask m, real p, real q), _mm512_mask_blend_pd(m, q, p))
OP(real, zero_if, (mask m, real p), _mm512_maskz_mov_pd((mask)~m, p))
OP(ints, blend_ints, (mask m, ints p, ints q), (ints)_mm512_mask_blend_epi64(m, (__m512i)q, (__m512i)p))
OP(real, vsqrt, (real p), _mm512_sqrt_pd(p))
OP(real, min, (real p, real q), _mm512_min_pd(p, q))
OP(real, max, (real p, real q), _mm512_max_pd(p, q))
OP(real, to_real, (ints p), _mm512_cvtepu64_pd((__m512i)p)) /* of integers below 2^53 */
/* Store the selected lanes of p to *to without gaps. Requires space for a register. */
FORCE_INLINE void compress(mask which, ints p, void *to)
{
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(which, (__m512i)p));
}
/* Load numbers without gaps into some lanes. */
OP(real, expand, (unsigned lanes, const double *from), _mm512_maskz_expandloadu_pd((mask)lanes, from))

/* Return number i modulo 16 of a table of 16. */
#define LOOKUP_16
OP(real, lookup_16, (const double *table, ints i), _mm512_permutex2var_pd(load(table), (__m512i)i, load(table + 8)))

#define EVEN(p, q) SHUFFLED(p, q, 0, 2, 4, 6, 8, 10, 12, 14)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3, 5, 7, 9, 11, 13, 15)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2, 3, 4, 5, 6, 7, 8)
/* Load the pairs at i[0], i[2], i[4] and i[6], shifted. */
FORCE_INLINE real load_four_rows(const double (*pairs)[2], const uint64_t *i, int shift)
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(load_pair_rows(pairs, i[0] << shift, i[2] << shift)),
                              load_pair_rows(pairs, i[4] << shift, i[6] << shift), 1);
}
FORCE_INLINE void gather_pairs(const double (*pairs)[2], const uint64_t *i, int shift, real *a, real *b)
{
    real even = load_four_rows(pairs, i, shift), odd = load_four_rows(pairs, i + 1, shift);
    *a = _mm512_unpacklo_pd(even, odd);
    *b = _mm512_unpackhi_pd(even, odd);
}

#elif REAL_LANES == 4

typedef int64_t mask __attribute__((vector_size(32))); /* all bits of a lane, or none */

OP(real, splat, (double s), _mm256_set1_pd(s))
OP(real, blend, (mask m, real p, real q), _mm256_blendv_pd(q, p, (real)m))
OP(mask, and_not, (mask p, mask q), (mask)_mm256_andnot_pd((real)q, (real)p)) /* the compiler would make a blend of p & ~q */
OP(unsigned, lane_bits, (mask p), (unsigned)_mm256_movemask_pd((__m256d)p))
OP(real, vsqrt, (real p), _mm256_sqrt_pd(p))
OP(real, min, (real p, real q), _mm256_min_pd(p, q))
OP(real, max, (real p, real q), _mm256_max_pd(p, q))

#define HALVES(lane) ((uint64_t)(2 * (lane) + 1) << 32 | 2 * (lane))
#define COMPRESS_ROW(a, b, c, d)                                                                                               \
    {                                                                                                                          \
        HALVES(a), HALVES(b), HALVES(c), HALVES(d)                                                                             \
    }
FORCE_INLINE void compress(mask which, ints p, void *to)
{
    static const ints permutations[] = {
        COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(1, 0, 0, 0), COMPRESS_ROW(0, 1, 0, 0),
        COMPRESS_ROW(2, 0, 0, 0), COMPRESS_ROW(0, 2, 0, 0), COMPRESS_ROW(1, 2, 0, 0), COMPRESS_ROW(0, 1, 2, 0),
        COMPRESS_ROW(3, 0, 0, 0), COMPRESS_ROW(0, 3, 0, 0), COMPRESS_ROW(1, 3, 0, 0), COMPRESS_ROW(0, 1, 3, 0),
        COMPRESS_ROW(2, 3, 0, 0), COMPRESS_ROW(0, 2, 3, 0), COMPRESS_ROW(1, 2, 3, 0), COMPRESS_ROW(0, 1, 2, 3)};
    _mm256_storeu_si256(to, _mm256_permutevar8x32_epi32((__m256i)p, (__m256i)permutations[lane_bits(which)]));
}
FORCE_INLINE real expand(unsigned lanes, const double *from)
{
    static const ints permutations[] = {
        COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 1, 0, 0),
        COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 0, 1, 0), COMPRESS_ROW(0, 0, 1, 0), COMPRESS_ROW(0, 1, 2, 0),
        COMPRESS_ROW(0, 0, 0, 0), COMPRESS_ROW(0, 0, 0, 1), COMPRESS_ROW(0, 0, 0, 1), COMPRESS_ROW(0, 1, 0, 2),
        COMPRESS_ROW(0, 0, 0, 1), COMPRESS_ROW(0, 0, 1, 2), COMPRESS_ROW(0, 0, 1, 2), COMPRESS_ROW(0, 1, 2, 3)};
    return (real)_mm256_permutevar8x32_epi32((__m256i)load(from), (__m256i)permutations[lanes & REGISTER]);
}

#define EVEN(p, q) SHUFFLED(p, q, 0, 2, 4, 6)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3, 5, 7)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2, 3, 4)
FORCE_INLINE void gather_pairs(const double (*pairs)[2], const uint64_t *i, int shift, real *a, real *b)
{
    real even = load_pair_rows(pairs, i[0] << shift, i[2] << shift), odd = load_pair_rows(pairs, i[1] << shift, i[3] << shift);
    *a = _mm256_unpacklo_pd(even, odd);
    *b = _mm256_unpackhi_pd(even, odd);
}

#else

typedef int64_t mask __attribute__((vector_size(8 * REAL_LANES)));

OP(real, splat, (double s), (real){0} + s)
OP(real, blend, (mask m, real p, real q), (real)(((ints)m & (ints)p) | (~(ints)m & (ints)q)))
OP(mask, and_not, (mask p, mask q), p & ~q)
FORCE_INLINE unsigned lane_bits(mask p)
{
    unsigned lanes = 0;
    EACH_LANE(i)
        lanes |= (unsigned)(p[i] & 1) << i;
    return lanes;
}
FORCE_INLINE real vsqrt(real p)
{
    EACH_LANE(i)
        p[i] = sqrt(p[i]);
    return p;
}
OP(real, min, (real p, real q), blend((mask)(p < q), p, q))
OP(real, max, (real p, real q), blend((mask)(p > q), p, q))
FORCE_INLINE void compress(mask which, ints p, void *to)
{
    char *next = to;
    EACH_LANE(i) {
        uint64_t one = p[i];
        memcpy(next, &one, sizeof one);
        next += (uint64_t)which[i] & sizeof one;
    }
}

#define EVEN(p, q) SHUFFLED(p, q, 0, 2)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2)

#endif

/* ---- common to all sizes ---- */

#if REAL_LANES < 8

OP(mask, less, (real p, real q), (mask)(p < q))
OP(mask, greater_equal, (real p, real q), (mask)(p >= q))
OP(mask, equal, (real p, real q), (mask)(p == q))
OP(mask, equal_ints, (ints p, ints q), (mask)(p == q))
OP(mask, greater_ints, (ints p, ints q), (mask)((mask)p > (mask)q))
OP(real, zero_if, (mask m, real p), (real)and_not((mask)p, m))
OP(ints, blend_ints, (mask m, ints p, ints q), (ints)blend(m, (real)p, (real)q))
FORCE_INLINE mask lane_mask(unsigned lanes)
{
    ints p, lane_bit;
    EACH_LANE(i)
        lane_bit[i] = (uint64_t)1 << i;
    p = ((ints){0} + lanes) & lane_bit;
    return (mask)(p == lane_bit);
}
/* Insert the two 32-bit parts into doubles as bits: exact below 2^53. */
FORCE_INLINE real to_real(ints p)
{
    real high = (real)(p >> 32 | 0x4530000000000000), low = (real)((p & 0xffffffff) | 0x4330000000000000);
    return (high - (0x1p84 + 0x1p52)) + low;
}

#endif

/* Load pairs, or groups of four, from an address on, one column per register. */
FORCE_INLINE void load_pairs(const double (*from)[2], real *a, real *b)
{
    real p = load(from[0]), q = load(from[REAL_LANES / 2]);
    *a = EVEN(p, q);
    *b = ODD(p, q);
}
FORCE_INLINE void load_fours(const double (*from)[2], real *a, real *b, real *c, real *d)
{
    real ac, bd, ac2, bd2;
    load_pairs(from, &ac, &bd);
    load_pairs(from + REAL_LANES, &ac2, &bd2);
    *a = EVEN(ac, ac2);
    *b = EVEN(bd, bd2);
    *c = ODD(ac, ac2);
    *d = ODD(bd, bd2);
}
OP(real, shift_in, (real p, double last), NEXT(p, splat(last))) /* drop the first number, append `last` */

OP(bool, any, (mask p), lane_bits(p) != 0)
OP(real, to_real_small, (ints p), as_real(p | 0x4330000000000000) - 0x1p52) /* of integers below 2^52 */
/* n, n + step, n + 2 step … */
FORCE_INLINE ints count_from(uint64_t n, uint64_t step)
{
    ints p;
    EACH_LANE(i)
        p[i] = i;
    return p * step + n;
}
OP(real, clamp, (real v, real a, real b), min(b, max(a, v)))
OP(real, vabs, (real p), as_real(as_ints(p) & ~SIGN_BIT))
OP(real, vcopysign, (real p, real q), as_real(as_ints(vabs(p)) | (as_ints(q) & SIGN_BIT)))

/* The elementary functions of base/elementary.h for registers: lanes_log() … */
#define REAL             real
#define BITS             ints
#define AS_BITS(p)       as_ints(p)
#define AS_REAL(p)       as_real(p)
#define LESS(p, q)       less(splat(p), q)
#define BLEND(m, p, q)   blend(m, p, q)
#define ELEMENTARY(name) lanes_##name
#include "elementary_text.h"

#endif

#endif
