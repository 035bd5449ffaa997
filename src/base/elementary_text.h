/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Logarithm, exponential, sine and cosine by their power series: the same bits with any libm, optimisation and lane. The
 * including file defines REAL, a double or a vector of doubles; BITS, the uint64_t of the same size; AS_BITS(p) and AS_REAL(p),
 * conversions of the bits; LESS(p, q) for a constant p; BLEND(m, p, q), p if m is set, otherwise q; ELEMENTARY(name), the name
 * of a function. All are undefined at the end. */

/* log(x) of a normal, finite x > 0, within an ulp. x = 2^k (1 + f) with 1 + f near 1; with s = f/(2 + f), log(1 + f) = 2(s +
 * s^3/3 + s^5/5 + …). */
static inline void ELEMENTARY(log)(const REAL *x, REAL *result)
{
    const uint64_t one = 0x3ff0000000000000, root_of_half = 0x3fe6a09e667f3bcd;
    const double ln2_hi = 0x1.62e42feep-1, ln2_lo = 0x1.a39ef35793c76p-33;
    BITS i = AS_BITS(*x) + (one - root_of_half);
    REAL k = AS_REAL(i >> 52 | 0x4330000000000000) - (0x1p52 + 1023); /* bits of 2^52 + an integer */
    REAL f = AS_REAL((i & 0xfffffffffffff) + root_of_half) - 1.0;
    REAL s = f / (f + 2.0), q = s * s, w = q * q;
    REAL odd = w * (2.0 / 19) + 2.0 / 15, even = w * (2.0 / 21) + 2.0 / 17;
    odd = odd * w + 2.0 / 11;
    even = even * w + 2.0 / 13;
    odd = odd * w + 2.0 / 7;
    even = even * w + 2.0 / 9;
    odd = odd * w + 2.0 / 3;
    even = even * w + 2.0 / 5;
    REAL series = odd * q + even * w, half = f * f * 0.5;
    *result = k * ln2_hi - ((half - (s * (half + series) + k * ln2_lo)) - f);
}

/* e^x = *e 2^*whole for |x| <= 746, *e near 1, within an ulp. With r = x - whole log(2), (e^r - 1 - r)/r2 by the series, added
 * in pairs so that few additions depend on each other. */
static inline void ELEMENTARY(exp_parts)(const REAL *x, REAL *e, REAL *whole)
{
    const double ln2_hi = 0x1.62e42feep-1, ln2_lo = 0x1.a39ef35793c76p-33;
    REAL k = (*x * 1.4426950408889634 + 0x1.8p52) - 0x1.8p52; /* rounds to an integer */
    REAL r = (*x - k * ln2_hi) - k * ln2_lo, r2 = r * r, r4 = r2 * r2;
    REAL low = (1.0 / 2 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
    REAL middle = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
    REAL high = (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
    *e = 1.0 + (r + r2 * (low + r4 * (middle + r4 * high)));
    *whole = k;
}

/* e^x for |x| <= 700, so that the result is a normal number. */
static inline void ELEMENTARY(exp)(const REAL *x, REAL *result)
{
    REAL e, k;
    ELEMENTARY(exp_parts)(x, &e, &k);
    *result = e * AS_REAL((AS_BITS(k + 0x1.8p52) + 1023) << 52); /* the lowest bits of the sum are the integer */
}

/* Sine and cosine of an angle in [-pi/4, pi/4], within 2e-16: polynomials of fdlibm (Sun Microsystems 1993), in an order that
 * needs few steps. */
static inline void ELEMENTARY(sincos_small)(const REAL *angle, REAL *sine, REAL *cosine)
{
    REAL y = *angle, q = y * y, w = q * q;
    REAL s = (-1.66666666666666324348e-01 + q * 8.33333333332248946124e-03) +
             w * ((-1.98412698298579493134e-04 + q * 2.75573137070700676789e-06) +
                  w * (-2.50507602534068634195e-08 + q * 1.58969099521155010221e-10));
    REAL c = (4.16666666666666019037e-02 + q * -1.38888888888741095749e-03) +
             w * ((2.48015872894767294178e-05 + q * -2.75573143513906633035e-07) +
                  w * (2.08757232129817482790e-09 + q * -1.13596475577881948265e-11));
    *sine = y + y * (q * s);
    *cosine = (1.0 - 0.5 * q) + w * c;
}

/* Likewise, of an angle in [-pi/2, pi/2]. */
static inline void ELEMENTARY(sincos)(const REAL *angle, REAL *sine, REAL *cosine)
{
    const double half_pi_hi = 1.5707963267948966, half_pi_lo = 6.123233995736766e-17;
    const uint64_t sign = 0x8000000000000000;
    REAL a = AS_REAL(AS_BITS(*angle) & ~sign), s, c;
    REAL y = BLEND(LESS(0.7853981633974483, a), (half_pi_hi - a) + half_pi_lo, a); /* sin a = cos(pi/2 - a) */
    ELEMENTARY(sincos_small)(&y, &s, &c);
    *cosine = BLEND(LESS(0.7853981633974483, a), s, c);
    *sine = AS_REAL(AS_BITS(BLEND(LESS(0.7853981633974483, a), c, s)) | (AS_BITS(*angle) & sign));
}

#undef REAL
#undef BITS
#undef AS_BITS
#undef AS_REAL
#undef LESS
#undef BLEND
#undef ELEMENTARY
