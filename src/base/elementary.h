/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ELEMENTARY_H
#define CEDUO_ELEMENTARY_H

#include <stdint.h>
#include <string.h>

/* Functions of one number that a rock's trajectory depends on, or the stand of a year through which it flies. The C
 * library's differ between machines in the last bit, as some have fused multiply-adds; these give the same bits
 * everywhere, within an ulp, atan within two, log1p and expm1 within three. */
double ceduo_log(double x);
double ceduo_log1p(double x); /* log(1 + x), x > -1 */
double ceduo_exp(double x);
double ceduo_expm1(double x); /* e^x - 1 */
double ceduo_atan(double x);
double ceduo_cbrt(double x);

/* x to the power y, for x > 0, within 2^-52 (1 + |y log(x)|) of itself. */
double ceduo_pow(double x, double y);

/* sqrt(x2 + y2), where neither square is too large for a double. */
double ceduo_length(double x, double y);

/* sin and cos of 2 pi i/n. */
void ceduo_sincos_turn(uint64_t i, uint64_t n, double *cosine, double *sine);

/* The normal law: the chance of less than z, for |z| <= 3; and the z of which p is the chance, for 0 < p < 1. */
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
#define PICK(m, p, q)    ((m) ? (p) : (q))
#define ELEMENTARY(name) elementary_##name
#include "elementary_text.h"

#endif
