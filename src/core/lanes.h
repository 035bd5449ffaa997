/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANES_H
#define CEDUO_LANES_H

#include <immintrin.h>
#include <stdbool.h>
#include <stdint.h>

#include "wide.h"

/* Many numbers at once, one for each lane. A file that includes this has set its target to AVX2, or to AVX-512 with DQ and
 * then WIDE_AVX512 too, and has 8 or 16 lanes: two registers each, so that one half works while the other waits. Every
 * operation is that of plain C, rounded the same, in each lane by itself. */

#ifdef WIDE_AVX512
#define LOOK_UP_WRAPS true /* a small table is looked up at i modulo 16, whatever i is */
#else
#define LOOK_UP_WRAPS false
#endif

#define LANE static inline __attribute__((always_inline))

/* ---- half of the lanes: one register ---- */

#ifdef WIDE_AVX512

#define HALF 8
typedef __m512d half_reals;
typedef __m512i half_ints;
typedef __mmask8 half_flags;

#define HALF_LESS(p, q) _mm512_cmp_pd_mask(p, q, _CMP_LT_OQ)
#define HALF_AT_LEAST(p, q) _mm512_cmp_pd_mask(p, q, _CMP_GE_OQ)
#define HALF_EQUAL(p, q) _mm512_cmp_pd_mask(p, q, _CMP_EQ_OQ)
#define HALF_SAME(p, q) _mm512_cmpeq_epi64_mask(p, q)
#define HALF_MORE(p, q) _mm512_cmpgt_epi64_mask(p, q)
#define HALF_BOTH(p, q) ((__mmask8)((p) & (q)))
#define HALF_EITHER(p, q) ((__mmask8)((p) | (q)))
#define HALF_BUT(p, q) ((__mmask8)((p) & ~(unsigned)(q)))
#define HALF_BITS(p) ((unsigned)(p))
#define HALF_FLAGS(bits) ((__mmask8)(bits))
#define HALF_PICK(m, p, q) _mm512_mask_blend_pd(m, q, p)
#define HALF_PICK_INTS(m, p, q) _mm512_mask_blend_epi64(m, q, p)
#define HALF_SQRT(p) _mm512_sqrt_pd(p)
#define HALF_LEAST(p, q) _mm512_min_pd(p, q)
#define HALF_MOST(p, q) _mm512_max_pd(p, q)
#define HALF_ALL(x) _mm512_set1_pd(x)
#define HALF_ALL_INTS(x) _mm512_set1_epi64((long long)(x))
#define HALF_LOAD(from) _mm512_load_pd(from)
#define HALF_LOAD_INTS(from) _mm512_load_si512(from)
#define HALF_STORE(to, p) _mm512_store_pd(to, p)
#define HALF_STORE_INTS(to, p) _mm512_store_si512(to, p)
#define HALF_AS_INTS(p) _mm512_castpd_si512(p)
#define HALF_AS_REALS(p) _mm512_castsi512_pd(p)
/* One of the first 16 numbers of a table. */
#define HALF_CHOOSE(table, i) _mm512_permutex2var_pd(_mm512_load_pd(table), i, _mm512_load_pd((table) + 8))

LANE half_reals half_of_ints(half_ints p)
{
    return _mm512_cvtepu64_pd(p);
}

#else

#define HALF 4
typedef __m256d half_reals;
typedef __m256i half_ints;
typedef __m256d half_flags; /* all bits of a lane set, or none */

#define HALF_LESS(p, q) _mm256_cmp_pd(p, q, _CMP_LT_OQ)
#define HALF_AT_LEAST(p, q) _mm256_cmp_pd(p, q, _CMP_GE_OQ)
#define HALF_EQUAL(p, q) _mm256_cmp_pd(p, q, _CMP_EQ_OQ)
#define HALF_SAME(p, q) _mm256_castsi256_pd(_mm256_cmpeq_epi64(p, q))
#define HALF_MORE(p, q) _mm256_castsi256_pd(_mm256_cmpgt_epi64(p, q))
#define HALF_BOTH(p, q) _mm256_and_pd(p, q)
#define HALF_EITHER(p, q) _mm256_or_pd(p, q)
#define HALF_BUT(p, q) _mm256_andnot_pd(q, p)
#define HALF_BITS(p) ((unsigned)_mm256_movemask_pd(p))
#define HALF_FLAGS(bits) \
    HALF_SAME(_mm256_and_si256(_mm256_set1_epi64x((long long)(bits)), _mm256_set_epi64x(8, 4, 2, 1)), \
              _mm256_set_epi64x(8, 4, 2, 1))
#define HALF_PICK(m, p, q) _mm256_blendv_pd(q, p, m)
#define HALF_PICK_INTS(m, p, q) _mm256_castpd_si256(HALF_PICK(m, _mm256_castsi256_pd(p), _mm256_castsi256_pd(q)))
#define HALF_SQRT(p) _mm256_sqrt_pd(p)
#define HALF_LEAST(p, q) _mm256_min_pd(p, q)
#define HALF_MOST(p, q) _mm256_max_pd(p, q)
#define HALF_ALL(x) _mm256_set1_pd(x)
#define HALF_ALL_INTS(x) _mm256_set1_epi64x((long long)(x))
#define HALF_LOAD(from) _mm256_load_pd(from)
#define HALF_LOAD_INTS(from) _mm256_load_si256((const __m256i *)(const void *)(from))
#define HALF_STORE(to, p) _mm256_store_pd(to, p)
#define HALF_STORE_INTS(to, p) _mm256_store_si256((__m256i *)(void *)(to), p)
#define HALF_AS_INTS(p) _mm256_castpd_si256(p)
#define HALF_AS_REALS(p) _mm256_castsi256_pd(p)

/* AVX2 does not convert 64-bit integers: the two 32-bit parts are put into doubles as bits. Exact below 2^53. */
LANE half_reals half_of_ints(half_ints p)
{
    half_ints high = _mm256_or_si256(_mm256_srli_epi64(p, 32), _mm256_castpd_si256(_mm256_set1_pd(0x1p84)));
    half_ints low = _mm256_blend_epi32(p, _mm256_castpd_si256(_mm256_set1_pd(0x1p52)), 0xaa);
    return (_mm256_castsi256_pd(high) - _mm256_set1_pd(0x1p84 + 0x1p52)) + _mm256_castsi256_pd(low);
}

#endif

/* ---- all lanes ---- */

#define LANES (2 * HALF)
#define ALL_LANES ((1u << LANES) - 1)

typedef struct {
    half_reals a, b;
} reals;
typedef struct {
    half_ints a, b;
} ints;
typedef struct {
    half_flags a, b;
} flags;

LANE reals all(double x)
{
    return (reals){HALF_ALL(x), HALF_ALL(x)};
}

LANE ints all_ints(uint64_t x)
{
    return (ints){HALF_ALL_INTS(x), HALF_ALL_INTS(x)};
}

LANE reals load(const double *from)
{
    return (reals){HALF_LOAD(from), HALF_LOAD(from + HALF)};
}

LANE ints load_ints(const uint64_t *from)
{
    return (ints){HALF_LOAD_INTS(from), HALF_LOAD_INTS(from + HALF)};
}

LANE void store(double *to, reals p)
{
    HALF_STORE(to, p.a);
    HALF_STORE(to + HALF, p.b);
}

LANE void store_ints(uint64_t *to, ints p)
{
    HALF_STORE_INTS(to, p.a);
    HALF_STORE_INTS(to + HALF, p.b);
}

LANE reals add(reals p, reals q)
{
    return (reals){p.a + q.a, p.b + q.b};
}

LANE reals sub(reals p, reals q)
{
    return (reals){p.a - q.a, p.b - q.b};
}

LANE reals mul(reals p, reals q)
{
    return (reals){p.a * q.a, p.b * q.b};
}

LANE reals over(reals p, reals q)
{
    return (reals){p.a / q.a, p.b / q.b};
}

LANE reals root_of(reals p)
{
    return (reals){HALF_SQRT(p.a), HALF_SQRT(p.b)};
}

/* p < q ? p : q and p > q ? p : q, to the letter. */
LANE reals least(reals p, reals q)
{
    return (reals){HALF_LEAST(p.a, q.a), HALF_LEAST(p.b, q.b)};
}

LANE reals most(reals p, reals q)
{
    return (reals){HALF_MOST(p.a, q.a), HALF_MOST(p.b, q.b)};
}

LANE flags less(reals p, reals q)
{
    return (flags){HALF_LESS(p.a, q.a), HALF_LESS(p.b, q.b)};
}

LANE flags at_least(reals p, reals q)
{
    return (flags){HALF_AT_LEAST(p.a, q.a), HALF_AT_LEAST(p.b, q.b)};
}

LANE flags equal(reals p, reals q)
{
    return (flags){HALF_EQUAL(p.a, q.a), HALF_EQUAL(p.b, q.b)};
}

LANE flags same(ints p, ints q)
{
    return (flags){HALF_SAME(p.a, q.a), HALF_SAME(p.b, q.b)};
}

/* p > q, as signed numbers. */
LANE flags more(ints p, ints q)
{
    return (flags){HALF_MORE(p.a, q.a), HALF_MORE(p.b, q.b)};
}

LANE flags both(flags p, flags q)
{
    return (flags){HALF_BOTH(p.a, q.a), HALF_BOTH(p.b, q.b)};
}

LANE flags either(flags p, flags q)
{
    return (flags){HALF_EITHER(p.a, q.a), HALF_EITHER(p.b, q.b)};
}

/* p and not q */
LANE flags but(flags p, flags q)
{
    return (flags){HALF_BUT(p.a, q.a), HALF_BUT(p.b, q.b)};
}

/* Bit i is lane i. */
LANE unsigned bits_of(flags p)
{
    return HALF_BITS(p.a) | HALF_BITS(p.b) << HALF;
}

LANE flags flags_of(unsigned bits)
{
    return (flags){HALF_FLAGS(bits), HALF_FLAGS(bits >> HALF)};
}

LANE reals pick(flags m, reals p, reals q)
{
    return (reals){HALF_PICK(m.a, p.a, q.a), HALF_PICK(m.b, p.b, q.b)};
}

LANE flags pick_flags(flags m, flags p, flags q)
{
    return either(both(m, p), but(q, m));
}

LANE ints pick_ints(flags m, ints p, ints q)
{
    return (ints){HALF_PICK_INTS(m.a, p.a, q.a), HALF_PICK_INTS(m.b, p.b, q.b)};
}

LANE ints add_ints(ints p, ints q)
{
    return (ints){p.a + q.a, p.b + q.b};
}

LANE ints and_ints(ints p, ints q)
{
    return (ints){p.a & q.a, p.b & q.b};
}

LANE ints or_ints(ints p, ints q)
{
    return (ints){p.a | q.a, p.b | q.b};
}

LANE ints xor_ints(ints p, ints q)
{
    return (ints){p.a ^ q.a, p.b ^ q.b};
}

LANE ints shift_left(ints p, int n)
{
    return (ints){p.a << n, p.b << n};
}

/* Without sign. */
LANE ints shift_right(ints p, int n)
{
#ifdef WIDE_AVX512
    return (ints){_mm512_srl_epi64(p.a, _mm_cvtsi32_si128(n)), _mm512_srl_epi64(p.b, _mm_cvtsi32_si128(n))};
#else
    return (ints){_mm256_srl_epi64(p.a, _mm_cvtsi32_si128(n)), _mm256_srl_epi64(p.b, _mm_cvtsi32_si128(n))};
#endif
}

LANE ints turn_left(ints p, int n)
{
    return or_ints(shift_left(p, n), shift_right(p, 64 - n));
}

/* Integers below 2^53. */
LANE reals reals_of(ints p)
{
    return (reals){half_of_ints(p.a), half_of_ints(p.b)};
}

LANE ints as_ints(reals p)
{
    return (ints){HALF_AS_INTS(p.a), HALF_AS_INTS(p.b)};
}

LANE reals as_reals(ints p)
{
    return (reals){HALF_AS_REALS(p.a), HALF_AS_REALS(p.b)};
}

LANE reals size_of_each(reals p)
{
    return as_reals(and_ints(as_ints(p), all_ints(INT64_MAX)));
}

/* The size of p with the sign of q. */
LANE reals with_sign(reals p, reals q)
{
    ints sign = and_ints(as_ints(q), all_ints((uint64_t)INT64_MIN));
    return as_reals(or_ints(as_ints(size_of_each(p)), sign));
}

/* Two rows, then four: loads by hand, which are faster than the machine's gathers. */
LANE __m256d rows(const double (*pairs)[2], uint64_t i, uint64_t j)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(pairs[i])), _mm_load_pd(pairs[j]), 1);
}

#ifdef WIDE_AVX512
LANE __m512d half_rows(const double (*pairs)[2], const uint64_t *i)
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(rows(pairs, i[0], i[2])), rows(pairs, i[4], i[6]), 1);
}
#define HALF_FIRST(p, q) _mm512_unpacklo_pd(p, q)
#define HALF_SECOND(p, q) _mm512_unpackhi_pd(p, q)
#else
LANE __m256d half_rows(const double (*pairs)[2], const uint64_t *i)
{
    return rows(pairs, i[0], i[2]);
}
#define HALF_FIRST(p, q) _mm256_unpacklo_pd(p, q)
#define HALF_SECOND(p, q) _mm256_unpackhi_pd(p, q)
#endif

/* The two numbers at i of a table for each lane; `small`: it has no more than 16. */
LANE void look_up(const struct wide_table *table, ints i, bool small, reals *first, reals *second)
{
#ifdef WIDE_AVX512
    if (small) { /* without going to memory lane by lane */
        *first = (reals){HALF_CHOOSE(table->first, i.a), HALF_CHOOSE(table->first, i.b)};
        *second = (reals){HALF_CHOOSE(table->second, i.a), HALF_CHOOSE(table->second, i.b)};
        return;
    }
#endif
    (void)small;
    _Alignas(64) uint64_t at[LANES];
    store_ints(at, i);
    const double(*pairs)[2] = (const double(*)[2])table->pairs;
    half_reals even = half_rows(pairs, at), odd = half_rows(pairs, at + 1);
    half_reals even_b = half_rows(pairs, at + HALF), odd_b = half_rows(pairs, at + HALF + 1);
    *first = (reals){HALF_FIRST(even, odd), HALF_FIRST(even_b, odd_b)};
    *second = (reals){HALF_SECOND(even, odd), HALF_SECOND(even_b, odd_b)};
}

#endif
