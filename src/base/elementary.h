/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ELEMENTARY_H
#define CEDUO_ELEMENTARY_H

#include <stdint.h>
#include <string.h>

/* Elementary functions for trajectories and for stands of a year. Those of the C library differ between machines in the last
 * bit, because some have fused multiply-adds. These give the same bits everywhere. Errors: 1 ulp, atan 2, log1p and expm1 3. */
double ceduo_log(double x);
double ceduo_log1p(double x); /* log(1 + x), x > -1 */
double ceduo_exp(double x);
double ceduo_expm1(double x); /* e^x - 1 */
double ceduo_atan(double x);
double ceduo_cbrt(double x);

/* Return x to the power y, for x > 0; the relative error is at most 2^-52 (1 + |y log(x)|). */
double ceduo_pow(double x, double y);

/* Return sqrt(x2 + y2). Requires that neither square overflows. */
double ceduo_hypot(double x, double y);

/* Set the cosine and sine of 2 pi i/n. */
void ceduo_sincos_turn(uint64_t i, uint64_t n, double *cosine, double *sine);

/* Distribution function of the standard normal distribution for |z| <= 3, and its inverse for 0 < p < 1. */
double ceduo_normal_cdf(double z);
double ceduo_normal_quantile(double p);

static inline uint64_t elementary_bits(double x)
{
    uint64_t i;
    memcpy(&i, &x, sizeof i);
    return i;
}

static inline double elementary_real(uint64_t i)
{
    double x;
    memcpy(&x, &i, sizeof x);
    return x;
}

#define REAL             double
#define BITS             uint64_t
#define AS_BITS(p)       elementary_bits(p)
#define AS_REAL(p)       elementary_real(p)
#define LESS(p, q)       ((p) < (q))
#define BLEND(m, p, q)   ((m) ? (p) : (q))
#define ELEMENTARY(name) elementary_##name
#include "elementary_text.h"

#endif
