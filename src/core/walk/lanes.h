/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANES_H
#define CEDUO_LANES_H

#include <immintrin.h>
#include <stdbool.h>
#include <stdint.h>

#include "wide.h"

/* Many numbers at once, one for each lane. A file that includes this has set its target to AVX2, or to AVX-512 with DQ
 * and then WIDE_AVX512 too, and has 8 or 32 lanes: two or four registers, so that one works while another waits. Of the 16
 * registers of AVX2 more than two at a time would mostly be kept in memory. Every operation is that of plain C, rounded the
 * same, in each lane by itself. */

#ifdef WIDE_AVX512
#define LOOK_UP_WRAPS true /* a small table is looked up at i modulo 16, whatever i is */
#else
#define LOOK_UP_WRAPS false
#endif

#define LANE static inline __attribute__((always_inline))

/* ---- a part of the lanes: one register ---- */

#ifdef WIDE_AVX512

#define PART 8
typedef __m512d part_reals;
typedef __m512i part_ints;
typedef __mmask8 part_flags;
typedef uint64_t part_bits __attribute__((vector_size(64))); /* for sums and shifts, which wrap */

#define PART_LESS(p, q)         _mm512_cmp_pd_mask(p, q, _CMP_LT_OQ)
#define PART_AT_LEAST(p, q)     _mm512_cmp_pd_mask(p, q, _CMP_GE_OQ)
#define PART_EQUAL(p, q)        _mm512_cmp_pd_mask(p, q, _CMP_EQ_OQ)
#define PART_SAME(p, q)         _mm512_cmpeq_epi64_mask(p, q)
#define PART_MORE(p, q)         _mm512_cmpgt_epi64_mask(p, q)
#define PART_BOTH(p, q)         ((__mmask8)((p) & (q)))
#define PART_EITHER(p, q)       ((__mmask8)((p) | (q)))
#define PART_BUT(p, q)          ((__mmask8)((p) & ~(unsigned)(q)))
#define PART_BITS(p)            ((unsigned)(p))
#define PART_FLAGS(bits)        ((__mmask8)(bits))
#define PART_PICK(m, p, q)      _mm512_mask_blend_pd(m, q, p)
#define PART_PICK_INTS(m, p, q) _mm512_mask_blend_epi64(m, q, p)
#define PART_SQRT(p)            _mm512_sqrt_pd(p)
#define PART_LEAST(p, q)        _mm512_min_pd(p, q)
#define PART_MOST(p, q)         _mm512_max_pd(p, q)
#define PART_ALL(x)             _mm512_set1_pd(x)
#define PART_ALL_INTS(x)        _mm512_set1_epi64((long long)(x))
#define PART_LOAD(from)         _mm512_load_pd(from)
#define PART_LOAD_INTS(from)    _mm512_load_si512(from)
#define PART_STORE(to, p)       _mm512_store_pd(to, p)
#define PART_STORE_INTS(to, p)  _mm512_store_si512(to, p)
#define PART_AS_INTS(p)         _mm512_castpd_si512(p)
#define PART_AS_REALS(p)        _mm512_castsi512_pd(p)
/* One of the first 16 numbers of a table. */
#define PART_CHOOSE(table, i) _mm512_permutex2var_pd(_mm512_load_pd(table), i, _mm512_load_pd((table) + 8))

LANE part_reals part_of_ints(part_ints p)
{
    return _mm512_cvtepu64_pd(p);
}

#else

#define PART 4
typedef __m256d part_reals;
typedef __m256i part_ints;
typedef uint64_t part_bits __attribute__((vector_size(32))); /* for sums and shifts, which wrap */
typedef __m256d part_flags;                                  /* all bits of a lane set, or none */

#define PART_LESS(p, q)     _mm256_cmp_pd(p, q, _CMP_LT_OQ)
#define PART_AT_LEAST(p, q) _mm256_cmp_pd(p, q, _CMP_GE_OQ)
#define PART_EQUAL(p, q)    _mm256_cmp_pd(p, q, _CMP_EQ_OQ)
#define PART_SAME(p, q)     _mm256_castsi256_pd(_mm256_cmpeq_epi64(p, q))
#define PART_MORE(p, q)     _mm256_castsi256_pd(_mm256_cmpgt_epi64(p, q))
#define PART_BOTH(p, q)     _mm256_and_pd(p, q)
#define PART_EITHER(p, q)   _mm256_or_pd(p, q)
#define PART_BUT(p, q)      _mm256_andnot_pd(q, p)
#define PART_BITS(p)        ((unsigned)_mm256_movemask_pd(p))
#define PART_FLAGS(bits)                                                                                                       \
    PART_SAME(_mm256_and_si256(_mm256_set1_epi64x((long long)(bits)), _mm256_set_epi64x(8, 4, 2, 1)),                          \
              _mm256_set_epi64x(8, 4, 2, 1))
#define PART_PICK(m, p, q)      _mm256_blendv_pd(q, p, m)
#define PART_PICK_INTS(m, p, q) _mm256_castpd_si256(PART_PICK(m, _mm256_castsi256_pd(p), _mm256_castsi256_pd(q)))
#define PART_SQRT(p)            _mm256_sqrt_pd(p)
#define PART_LEAST(p, q)        _mm256_min_pd(p, q)
#define PART_MOST(p, q)         _mm256_max_pd(p, q)
#define PART_ALL(x)             _mm256_set1_pd(x)
#define PART_ALL_INTS(x)        _mm256_set1_epi64x((long long)(x))
#define PART_LOAD(from)         _mm256_load_pd(from)
#define PART_LOAD_INTS(from)    _mm256_load_si256((const __m256i *)(const void *)(from))
#define PART_STORE(to, p)       _mm256_store_pd(to, p)
#define PART_STORE_INTS(to, p)  _mm256_store_si256((__m256i *)(void *)(to), p)
#define PART_AS_INTS(p)         _mm256_castpd_si256(p)
#define PART_AS_REALS(p)        _mm256_castsi256_pd(p)

/* AVX2 does not convert 64-bit integers: the two 32-bit parts are put into doubles as bits. Exact below 2^53. */
LANE part_reals part_of_ints(part_ints p)
{
    part_ints high = _mm256_or_si256(_mm256_srli_epi64(p, 32), _mm256_castpd_si256(_mm256_set1_pd(0x1p84)));
    part_ints low = _mm256_blend_epi32(p, _mm256_castpd_si256(_mm256_set1_pd(0x1p52)), 0xaa);
    return (_mm256_castsi256_pd(high) - _mm256_set1_pd(0x1p84 + 0x1p52)) + _mm256_castsi256_pd(low);
}

#endif

/* ---- all lanes ---- */

/* `macro` with each part, its first lane, and more. */
#ifdef WIDE_AVX512
#define PARTS      4
#define PART_NAMES a, b, c, d
#define OF_EACH(macro, ...)                                                                                                    \
    macro(a, 0, __VA_ARGS__) macro(b, PART, __VA_ARGS__) macro(c, 2 * PART, __VA_ARGS__) macro(d, 3 * PART, __VA_ARGS__)
#else
#define PARTS               2
#define PART_NAMES          a, b
#define OF_EACH(macro, ...) macro(a, 0, __VA_ARGS__) macro(b, PART, __VA_ARGS__)
#endif

#define LANES     (PARTS * PART)
#define ALL_LANES ((unsigned)(((uint64_t)1 << LANES) - 1))

typedef struct {
    part_reals PART_NAMES;
} reals;
typedef struct {
    part_ints PART_NAMES;
} ints;
typedef struct {
    part_flags PART_NAMES;
} flags;

/* Defines a function that does the same with each part: EACH(result, name, (parameters), what with part P of each). */
#define EACH(result, name, parameters, ...)                                                                                    \
    LANE result name parameters                                                                                                \
    {                                                                                                                          \
        return (result){OF_EACH(ONE_OF, __VA_ARGS__)};                                                                         \
    }
#define ONE_OF(part, first, macro, ...) macro(part, first, __VA_ARGS__),

/* What a macro makes of part `x`, whose first lane is lane `at`. */
#define OF_ONE(x, at, op)        op(p.x)
#define OF_TWO(x, at, op)        op(p.x, q.x)
#define OF_THREE(x, at, op)      op(m.x, p.x, q.x)
#define OF_SCALAR(x, at, op)     op(s)
#define OF_PLACE(x, at, op)      op(from + (at))
#define OF_BITS(x, at, op)       op(bits >> (at))
#define OF_SIGN(x, at, sign)     p.x sign q.x
#define OF_WRAPPING(x, at, sign) (part_ints)((part_bits)p.x sign(part_bits) q.x)
#define OF_SHIFT(x, at, sign)    (part_ints)((part_bits)p.x sign n)

EACH(reals, all, (double s), OF_SCALAR, PART_ALL)
EACH(ints, all_ints, (uint64_t s), OF_SCALAR, PART_ALL_INTS)
EACH(reals, load, (const double *from), OF_PLACE, PART_LOAD)
EACH(ints, load_ints, (const uint64_t *from), OF_PLACE, PART_LOAD_INTS)

#define STORE_ONE(x, at, op) op(to + (at), p.x);

LANE void store(double *to, reals p){OF_EACH(STORE_ONE, PART_STORE)}

LANE void store_ints(uint64_t *to, ints p){OF_EACH(STORE_ONE, PART_STORE_INTS)}

EACH(reals, add, (reals p, reals q), OF_SIGN, +) EACH(reals, sub, (reals p, reals q), OF_SIGN, -)
    EACH(reals, mul, (reals p, reals q), OF_SIGN, *) EACH(reals, over, (reals p, reals q), OF_SIGN, /)
        EACH(reals, root_of, (reals p), OF_ONE, PART_SQRT)

            LANE void add_to(double *to, reals p)
{
    store(to, add(load(to), p));
}

/* p < q ? p : q and p > q ? p : q, to the letter. */
EACH(reals, least, (reals p, reals q), OF_TWO, PART_LEAST)
EACH(reals, most, (reals p, reals q), OF_TWO, PART_MOST)

EACH(flags, less, (reals p, reals q), OF_TWO, PART_LESS)
EACH(flags, at_least, (reals p, reals q), OF_TWO, PART_AT_LEAST)
EACH(flags, equal, (reals p, reals q), OF_TWO, PART_EQUAL)
EACH(flags, same, (ints p, ints q), OF_TWO, PART_SAME)
EACH(flags, more, (ints p, ints q), OF_TWO, PART_MORE) /* p > q, as signed numbers */
EACH(flags, both, (flags p, flags q), OF_TWO, PART_BOTH)
EACH(flags, either, (flags p, flags q), OF_TWO, PART_EITHER)
EACH(flags, but, (flags p, flags q), OF_TWO, PART_BUT) /* p and not q */

/* Bit i is lane i. */
LANE unsigned bits_of(flags p)
{
#define BITS_OF_ONE(x, at, op) | op(p.x) << (at)
    return 0 OF_EACH(BITS_OF_ONE, PART_BITS);
}

/* Whether there is a lane of which it holds. */
LANE bool any(flags p)
{
    return bits_of(p) != 0;
}

EACH(flags, flags_of, (unsigned bits), OF_BITS, PART_FLAGS)
EACH(reals, pick, (flags m, reals p, reals q), OF_THREE, PART_PICK)
EACH(ints, pick_ints, (flags m, ints p, ints q), OF_THREE, PART_PICK_INTS)

LANE flags pick_flags(flags m, flags p, flags q)
{
    return either(both(m, p), but(q, m));
}

EACH(ints, add_ints, (ints p, ints q), OF_WRAPPING, +)
EACH(ints, and_ints, (ints p, ints q), OF_SIGN, &)
EACH(ints, or_ints, (ints p, ints q), OF_SIGN, |)
EACH(ints, xor_ints, (ints p, ints q), OF_SIGN, ^)
EACH(ints, shift_left, (ints p, int n), OF_SHIFT, <<)
EACH(ints, shift_right, (ints p, int n), OF_SHIFT, >>)

LANE ints turn_left(ints p, int n)
{
    return or_ints(shift_left(p, n), shift_right(p, 64 - n));
}

EACH(reals, reals_of, (ints p), OF_ONE, part_of_ints) /* integers below 2^53 */
EACH(ints, as_ints, (reals p), OF_ONE, PART_AS_INTS)
EACH(reals, as_reals, (ints p), OF_ONE, PART_AS_REALS)

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

/* Loads by hand, which are faster than the machine's gathers: two rows, and what stands at i[0], i[1] … */
LANE __m256d rows(const double (*pairs)[2], uint64_t i, uint64_t j)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(pairs[i])), _mm_load_pd(pairs[j]), 1);
}

#ifdef WIDE_AVX512
LANE __m512d part_rows(const double (*pairs)[2], const uint64_t *i)
{
    return _mm512_insertf64x4(_mm512_castpd256_pd512(rows(pairs, i[0], i[2])), rows(pairs, i[4], i[6]), 1);
}

LANE void part_pair(const double (*pairs)[2], const uint64_t *i, part_reals *first, part_reals *second)
{
    __m512d even = part_rows(pairs, i), odd = part_rows(pairs, i + 1);
    *first = _mm512_unpacklo_pd(even, odd);
    *second = _mm512_unpackhi_pd(even, odd);
}
#else
LANE void part_pair(const double (*pairs)[2], const uint64_t *i, part_reals *first, part_reals *second)
{
    __m256d even = rows(pairs, i[0], i[2]), odd = rows(pairs, i[1], i[3]);
    *first = _mm256_unpacklo_pd(even, odd);
    *second = _mm256_unpackhi_pd(even, odd);
}
#endif

#ifdef WIDE_AVX512
#define OF_TABLE(x, at, op) op(table, p.x)
EACH(reals, choose, (const double *table, ints p), OF_TABLE, PART_CHOOSE)
#endif

/* ---- one part alone: a row of neighbours ---- */

#ifdef WIDE_AVX512
#define PART_NONE_BUT(p)      ((unsigned)(uint8_t) ~(p)) /* bits of those that are not */
#define PART_LOAD_ROW(from)   _mm512_loadu_pd(from)
#define PART_STORE_ROW(to, p) _mm512_storeu_pd(to, p)

/* The upper 17 bits of each, which are below 2^16. */
LANE void part_store_upper(uint16_t *to, part_reals p)
{
    _mm_storeu_si128((__m128i *)to, _mm512_cvtepi64_epi16(_mm512_srli_epi64(PART_AS_INTS(p), 47)));
}

/* PART pairs, or fours, from an address on, by columns. */
LANE void part_of_pairs(const double (*from)[2], part_reals *first, part_reals *second)
{
    part_reals p = _mm512_loadu_pd(from[0]), q = _mm512_loadu_pd(from[4]);
    *first = _mm512_permutex2var_pd(p, _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), q);
    *second = _mm512_permutex2var_pd(p, _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), q);
}

LANE void part_of_fours(const double *from, part_reals *a, part_reals *b, part_reals *c, part_reals *d)
{
    part_ints even = _mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13), odd = _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15);
    part_reals p = _mm512_loadu_pd(from), q = _mm512_loadu_pd(from + 8);
    part_reals r = _mm512_loadu_pd(from + 16), s = _mm512_loadu_pd(from + 24);
    part_reals ab = _mm512_permutex2var_pd(p, even, q), cd = _mm512_permutex2var_pd(p, odd, q);
    part_reals ab2 = _mm512_permutex2var_pd(r, even, s), cd2 = _mm512_permutex2var_pd(r, odd, s);
    *a = _mm512_shuffle_f64x2(ab, ab2, 0x44);
    *b = _mm512_shuffle_f64x2(ab, ab2, 0xee);
    *c = _mm512_shuffle_f64x2(cd, cd2, 0x44);
    *d = _mm512_shuffle_f64x2(cd, cd2, 0xee);
}

/* Without its first number, and with another at its end. */
LANE part_reals part_shifted(part_reals p, double last)
{
    return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(PART_ALL(last)), _mm512_castpd_si512(p), 1));
}
#else
#define PART_NONE_BUT(p)      (~PART_BITS(p) & 15)
#define PART_LOAD_ROW(from)   _mm256_loadu_pd(from)
#define PART_STORE_ROW(to, p) _mm256_storeu_pd(to, p)

LANE void part_store_upper(uint16_t *to, part_reals p)
{
    __m256i upper = _mm256_srli_epi64(PART_AS_INTS(p), 47);
    __m128i row = _mm_packus_epi32(_mm256_castsi256_si128(upper), _mm256_extracti128_si256(upper, 1));
    _mm_storel_epi64((__m128i *)to, _mm_packus_epi32(row, row));
}

LANE void part_of_pairs(const double (*from)[2], part_reals *first, part_reals *second)
{
    part_reals p = _mm256_loadu_pd(from[0]), q = _mm256_loadu_pd(from[2]);
    *first = _mm256_permute4x64_pd(_mm256_unpacklo_pd(p, q), 0xd8);
    *second = _mm256_permute4x64_pd(_mm256_unpackhi_pd(p, q), 0xd8);
}

LANE void part_of_fours(const double *from, part_reals *a, part_reals *b, part_reals *c, part_reals *d)
{
    part_reals p = _mm256_loadu_pd(from), q = _mm256_loadu_pd(from + 4);
    part_reals r = _mm256_loadu_pd(from + 8), s = _mm256_loadu_pd(from + 12);
    part_reals ac = _mm256_unpacklo_pd(p, q), bd = _mm256_unpackhi_pd(p, q);
    part_reals ac2 = _mm256_unpacklo_pd(r, s), bd2 = _mm256_unpackhi_pd(r, s);
    *a = _mm256_permute2f128_pd(ac, ac2, 0x20);
    *b = _mm256_permute2f128_pd(bd, bd2, 0x20);
    *c = _mm256_permute2f128_pd(ac, ac2, 0x31);
    *d = _mm256_permute2f128_pd(bd, bd2, 0x31);
}

LANE part_reals part_shifted(part_reals p, double last)
{
    return _mm256_blend_pd(_mm256_permute4x64_pd(p, 0x39), PART_ALL(last), 8);
}
#endif

/* ---- tables ---- */

/* The two numbers at i of a table for each lane; `small`: it has no more than 16. */
LANE void look_up(const struct wide_table *table, ints i, bool small, reals *first, reals *second)
{
#ifdef WIDE_AVX512
    if (small) { /* without going to memory lane by lane */
        *first = choose(table->first, i);
        *second = choose(table->second, i);
        return;
    }
#endif
    (void)small;
    _Alignas(64) uint64_t at[LANES];
    store_ints(at, shift_left(i, table->shift));
    const double(*pairs)[2] = table->pairs;
#define LOOK_UP_ONE(x, from, op) op(pairs, at + (from), &first->x, &second->x);
    OF_EACH(LOOK_UP_ONE, part_pair)
}

#endif
