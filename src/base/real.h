/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REAL_H
#define CEDUO_REAL_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "elementary.h"

/* A number, or as many as one register holds: a text that is written for `real` serves both, with the same bits in each
 * lane. + - * / and, of `ints`, & | ^ << >> are those of C; the rest is named here. A file that includes this says how many
 * by REAL_LANES: 1; 8 where it has set its target to AVX-512 with DQ; 4, AVX2; 2, any other. */
#ifndef REAL_LANES
#define REAL_LANES 1
#endif

/* The walk is one body from contact to contact, so that a flight stays in registers; what happens seldom is called. */
#define FORCE_INLINE  static inline __attribute__((always_inline))
#define NOINLINE_COLD static __attribute__((noinline))

#define SIGN_BIT 0x8000000000000000

/* Defines a function of one expression. */
#define OP(result, name, parameters, ...)                                                                                      \
    FORCE_INLINE result name parameters                                                                                        \
    {                                                                                                                          \
        return __VA_ARGS__;                                                                                                    \
    }

#if REAL_LANES == 1

typedef double real;
typedef uint64_t ints;
typedef bool mask; /* masks are joined by & and |, and by but() */

OP(real, all, (double s), s)
OP(ints, as_ints, (real p), elementary_bits(p))
OP(real, as_real, (ints p), elementary_real(p))
OP(mask, less, (real p, real q), p < q)
OP(mask, at_least, (real p, real q), p >= q)
OP(mask, equal, (real p, real q), p == q)
OP(mask, but, (mask p, mask q), p && !q)
OP(bool, any, (mask p), p)
FORCE_INLINE real pick(mask m, real p, real q) /* p where m holds, q elsewhere */
{
    if (m) {
#ifdef __x86_64__
        __asm__("" : "+x"(p)); /* a branch, which the processor guesses: a choice of both would have to wait for them */
#endif
        return p;
    }
    return q;
}
OP(real, root_of, (real p), sqrt(p))
OP(real, min, (real p, real q), p < q ? p : q) /* p < q ? p : q to the letter */
OP(real, max, (real p, real q), p > q ? p : q)
OP(real, clamp, (real v, real a, real b), (v < a) ? a : (v > b) ? b : v) /* within a…b, a <= b */
OP(real, absolute, (real p), fabs(p))
OP(real, with_sign, (real p, real q), copysign(p, q)) /* the size of p with the sign of q */

#else

/* ---- registers ---- */

typedef double real __attribute__((vector_size(8 * REAL_LANES)));
typedef uint64_t ints __attribute__((vector_size(8 * REAL_LANES)));
#define EACH_LANE(i) for (size_t i = 0; i < REAL_LANES; i++)
#define REGISTER     ((1u << REAL_LANES) - 1) /* a bit for each lane */

/* Numbers of two registers by their places. Before version 12 gcc has another word for it. */
#if defined(__clang__) || __GNUC__ >= 12
#define SHUFFLED(p, q, ...) __builtin_shufflevector(p, q, __VA_ARGS__)
#else
#define SHUFFLED(p, q, ...) __builtin_shuffle(p, q, (ints){__VA_ARGS__})
#endif

OP(ints, as_ints, (real p), (ints)p)
OP(real, as_real, (ints p), (real)p)
OP(ints, all_ints, (uint64_t s), (ints){0} + s)
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

/* The pairs at i and j, loaded by hand, which is faster than the machine's gathers. */
FORCE_INLINE __m256d two_rows(const double (*pairs)[2], uint64_t i, uint64_t j)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(pairs[i])), _mm_loadu_pd(pairs[j]), 1);
}

#endif

#if REAL_LANES == 8

typedef __mmask8 mask;

OP(real, all, (double s), _mm512_set1_pd(s))
OP(mask, less, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_LT_OQ))
OP(mask, at_least, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_GE_OQ))
OP(mask, equal, (real p, real q), _mm512_cmp_pd_mask(p, q, _CMP_EQ_OQ))
OP(mask, same, (ints p, ints q), _mm512_cmpeq_epi64_mask((__m512i)p, (__m512i)q))
OP(mask, more, (ints p, ints q), _mm512_cmpgt_epi64_mask((__m512i)p, (__m512i)q)) /* p > q, as signed numbers */
OP(mask, but, (mask p, mask q), (mask)(p & ~(unsigned)q))                         /* p and not q */
OP(unsigned, lanes_of, (mask p), p)                                               /* bit i is lane i */
OP(mask, mask_of, (unsigned lanes), (mask)lanes)
OP(real, pick, (mask m, real p, real q), _mm512_mask_blend_pd(m, q, p))
OP(ints, pick_ints, (mask m, ints p, ints q), (ints)_mm512_mask_blend_epi64(m, (__m512i)q, (__m512i)p))
OP(real, root_of, (real p), _mm512_sqrt_pd(p))
OP(real, min, (real p, real q), _mm512_min_pd(p, q))
OP(real, max, (real p, real q), _mm512_max_pd(p, q))
OP(real, real_of, (ints p), _mm512_cvtepu64_pd((__m512i)p)) /* of integers below 2^53 */
/* Puts those of p at *to without gaps; there is room for a register. */
FORCE_INLINE void keep(mask which, ints p, void *to)
{
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(which, (__m512i)p));
}

/* One of the first 16 numbers of a table, at i modulo 16. */
#define LOOK_UP_16
OP(real, look_up_16, (const double *table, ints i), _mm512_permutex2var_pd(load(table), (__m512i)i, load(table + 8)))

#define EVEN(p, q) SHUFFLED(p, q, 0, 2, 4, 6, 8, 10, 12, 14)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3, 5, 7, 9, 11, 13, 15)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2, 3, 4, 5, 6, 7, 8)
/* The pairs at i[0], i[1] … */
FORCE_INLINE real four_rows(const double (*pairs)[2], const uint64_t *i)
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(two_rows(pairs, i[0], i[2])), two_rows(pairs, i[4], i[6]), 1);
}
FORCE_INLINE void load_pairs_at(const double (*pairs)[2], const uint64_t *i, real *a, real *b)
{
    real even = four_rows(pairs, i), odd = four_rows(pairs, i + 1);
    *a = _mm512_unpacklo_pd(even, odd);
    *b = _mm512_unpackhi_pd(even, odd);
}

#elif REAL_LANES == 4

typedef int64_t mask __attribute__((vector_size(32))); /* all bits of a lane, or none */

OP(real, all, (double s), _mm256_set1_pd(s))
OP(real, pick, (mask m, real p, real q), _mm256_blendv_pd(q, p, (real)m))
OP(unsigned, lanes_of, (mask p), (unsigned)_mm256_movemask_pd((__m256d)p))
OP(real, root_of, (real p), _mm256_sqrt_pd(p))
OP(real, min, (real p, real q), _mm256_min_pd(p, q))
OP(real, max, (real p, real q), _mm256_max_pd(p, q))

#define HALVES(lane) ((uint64_t)(2 * (lane) + 1) << 32 | 2 * (lane))
#define KEPT(a, b, c, d)                                                                                                       \
    {                                                                                                                          \
        HALVES(a), HALVES(b), HALVES(c), HALVES(d)                                                                             \
    }
FORCE_INLINE void keep(mask which, ints p, void *to)
{
    static const ints kept[] = {KEPT(0, 0, 0, 0), KEPT(0, 0, 0, 0), KEPT(1, 0, 0, 0), KEPT(0, 1, 0, 0),
                                KEPT(2, 0, 0, 0), KEPT(0, 2, 0, 0), KEPT(1, 2, 0, 0), KEPT(0, 1, 2, 0),
                                KEPT(3, 0, 0, 0), KEPT(0, 3, 0, 0), KEPT(1, 3, 0, 0), KEPT(0, 1, 3, 0),
                                KEPT(2, 3, 0, 0), KEPT(0, 2, 3, 0), KEPT(1, 2, 3, 0), KEPT(0, 1, 2, 3)};
    _mm256_storeu_si256(to, _mm256_permutevar8x32_epi32((__m256i)p, (__m256i)kept[lanes_of(which)]));
}

#define EVEN(p, q) SHUFFLED(p, q, 0, 2, 4, 6)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3, 5, 7)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2, 3, 4)
FORCE_INLINE void load_pairs_at(const double (*pairs)[2], const uint64_t *i, real *a, real *b)
{
    real even = two_rows(pairs, i[0], i[2]), odd = two_rows(pairs, i[1], i[3]);
    *a = _mm256_unpacklo_pd(even, odd);
    *b = _mm256_unpackhi_pd(even, odd);
}

#else

typedef int64_t mask __attribute__((vector_size(8 * REAL_LANES)));

OP(real, all, (double s), (real){0} + s)
OP(real, pick, (mask m, real p, real q), (real)(((ints)m & (ints)p) | (~(ints)m & (ints)q)))
FORCE_INLINE unsigned lanes_of(mask p)
{
    unsigned lanes = 0;
    EACH_LANE(i)
        lanes |= (unsigned)(p[i] & 1) << i;
    return lanes;
}
FORCE_INLINE real root_of(real p)
{
    EACH_LANE(i)
        p[i] = sqrt(p[i]);
    return p;
}
OP(real, min, (real p, real q), pick((mask)(p < q), p, q))
OP(real, max, (real p, real q), pick((mask)(p > q), p, q))
FORCE_INLINE void keep(mask which, ints p, void *to)
{
    char *at = to;
    EACH_LANE(i) {
        uint64_t one = p[i];
        memcpy(at, &one, sizeof one);
        at += (uint64_t)which[i] & sizeof one;
    }
}

#define EVEN(p, q) SHUFFLED(p, q, 0, 2)
#define ODD(p, q)  SHUFFLED(p, q, 1, 3)
#define NEXT(p, q) SHUFFLED(p, q, 1, 2)

#endif

/* ---- what is the same for them ---- */

#if REAL_LANES < 8

OP(mask, less, (real p, real q), (mask)(p < q))
OP(mask, at_least, (real p, real q), (mask)(p >= q))
OP(mask, equal, (real p, real q), (mask)(p == q))
OP(mask, same, (ints p, ints q), (mask)(p == q))
OP(mask, more, (ints p, ints q), (mask)((mask)p > (mask)q))
OP(mask, but, (mask p, mask q), p & ~q)
OP(ints, pick_ints, (mask m, ints p, ints q), (ints)pick(m, (real)p, (real)q))
FORCE_INLINE mask mask_of(unsigned lanes)
{
    ints p, place;
    EACH_LANE(i)
        place[i] = (uint64_t)1 << i;
    p = ((ints){0} + lanes) & place;
    return (mask)(p == place);
}
/* The two 32-bit parts are put into doubles as bits: exact below 2^53. */
FORCE_INLINE real real_of(ints p)
{
    real high = (real)(p >> 32 | 0x4530000000000000), low = (real)((p & 0xffffffff) | 0x4330000000000000);
    return (high - (0x1p84 + 0x1p52)) + low;
}

#endif

/* Pairs and fours of numbers from an address on, by columns. */
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
OP(real, shifted, (real p, double last), NEXT(p, all(last))) /* without its first number, and with another at its end */

OP(bool, any, (mask p), lanes_of(p) != 0)
OP(real, real_of_small, (ints p), as_real(p | 0x4330000000000000) - 0x1p52) /* of integers below 2^52 */
/* n, n + step, n + 2 step … */
FORCE_INLINE ints count_from(uint64_t n, uint64_t step)
{
    ints p;
    EACH_LANE(i)
        p[i] = i;
    return p * step + n;
}
OP(real, clamp, (real v, real a, real b), min(b, max(a, v)))
OP(real, absolute, (real p), as_real(as_ints(p) & ~SIGN_BIT))
OP(real, with_sign, (real p, real q), as_real(as_ints(absolute(p)) | (as_ints(q) & SIGN_BIT)))

/* The elementary functions of base/elementary.h for registers: lanes_log() … */
#define REAL             real
#define BITS             ints
#define AS_BITS(p)       as_ints(p)
#define AS_REAL(p)       as_real(p)
#define LESS(p, q)       less(all(p), q)
#define PICK(m, p, q)    pick(m, p, q)
#define ELEMENTARY(name) lanes_##name
#include "elementary_text.h"

#endif

#endif
