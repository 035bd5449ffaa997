/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "elementary.h"

#include <math.h>
#include <stdbool.h>

double ceduo_log(double x)
{
    if (!(x > 0))
        return x == 0 ? -INFINITY : NAN;
    if (isinf(x))
        return x;
    bool small = x < 0x1p-1022;
    double scaled = small ? x * 0x1p54 : x, result;
    elementary_log(&scaled, &result);
    return small ? result - 54 * 0.6931471805599453 : result;
}

/* The rounding errors of 1 + x and of its logarithm are proportional, and cancel out (W. Kahan). */
double ceduo_log1p(double x)
{
    double y = 1 + x;
    return y == 1 || isinf(y) ? x : ceduo_log(y) * (x / (y - 1));
}

/* Return 2^k. Requires a normal result. */
static double power_of_two(int k)
{
    return elementary_real((uint64_t)(k + 1023) << 52);
}

double ceduo_exp(double x)
{
    if (!(x > -746))
        return isnan(x) ? x : 0;
    if (x > 710)
        return INFINITY;
    double e, whole;
    elementary_exp_parts(&x, &e, &whole);
    int k = (int)whole, half = k / 2; /* 2^k may overflow or be subnormal although the result is normal */
    return e * power_of_two(half) * power_of_two(k - half);
}

/* As with log1p, the quotient cancels the rounding error of e^x. */
double ceduo_expm1(double x)
{
    double e = ceduo_exp(x);
    if (e == 1)
        return x;
    return e == 0 || isinf(e) ? e - 1 : (e - 1) * (x / ceduo_log(e));
}

double ceduo_pow(double x, double y)
{
    return ceduo_exp(y * ceduo_log(x));
}

/* atan(x) = atan(c) + atan((x - c)/(1 + x c)) with the nearest c = i/8 for x <= 1; for x > 1 pi/2 - atan(1/x). */
double ceduo_atan(double x)
{
    static const double atan_of_eighths[] = {0,
                                             0.12435499454676144,
                                             0.24497866312686415,
                                             0.35877067027057225,
                                             0.46364760900080615,
                                             0.5585993153435624,
                                             0.6435011087932844,
                                             0.7188299996216245,
                                             0.7853981633974483};
    double a = fabs(x);
    if (isnan(x))
        return x;
    bool large = a > 1;
    if (large)
        a = 1 / a;
    int i = (int)(a * 8 + 0.5);
    double c = i / 8.0, t = (a - c) / (1 + a * c), q = t * t, sum = 1.0 / 13;
    for (int n = 11; n >= 3; n -= 2)
        sum = 1.0 / n - sum * q;
    double y = atan_of_eighths[i] + (t - t * (q * sum));
    if (large)
        y = (1.5707963267948966 - y) + 6.123233995736766e-17;
    return copysign(y, x);
}

/* Newton's method, starting from a third of the exponent. */
double ceduo_cbrt(double x)
{
    if (x == 0 || !isfinite(x))
        return x;
    double a = fabs(x), scale = 1;
    if (a < 0x1p-1000) {
        a *= 0x1p120;
        scale = 0x1p-40;
    }
    double y = elementary_real(elementary_bits(a) / 3 + 0x2a9f789300000000);
    for (int i = 0; i < 5; i++)
        y -= (y - a / (y * y)) / 3;
    return copysign(y * scale, x);
}

double ceduo_hypot(double x, double y)
{
    double square = x * x + y * y;
    if (square < 0x1p-900) /* squares that lose digits are scaled */
        return sqrt((x * 0x1p600) * (x * 0x1p600) + (y * 0x1p600) * (y * 0x1p600)) * 0x1p-600;
    return sqrt(square);
}

void ceduo_sincos_turn(uint64_t i, uint64_t n, double *cosine, double *sine)
{
    uint64_t quarter = 4 * i / n;
    double angle = 1.5707963267948966 * ((double)(4 * i % n) / (double)n), c, s;
    elementary_sincos(&angle, &s, &c);
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
}

/* 1/2 + phi(z) (z + z3/3 + z5/(3 5) + …), without cancellation. */
double ceduo_normal_cdf(double z)
{
    double term = z, sum = z;
    for (int n = 3; n < 100; n += 2) {
        term *= z * z / n;
        sum += term;
    }
    return 0.5 + sum * 0.3989422804014327 * ceduo_exp(-0.5 * (z * z));
}

static double rational(const double numerator[8], const double denominator[8], double r)
{
    double p = numerator[7], q = denominator[7];
    for (int i = 6; i >= 0; i--) {
        p = p * r + numerator[i];
        q = q * r + denominator[i];
    }
    return p / q;
}

/* Algorithm AS 241, PPND16 (Wichura 1988). */
double ceduo_normal_quantile(double p)
{
    static const double middle[2][8] = {
        {3.3871328727963666080e0, 1.3314166789178437745e+2, 1.9715909503065514427e+3, 1.3731693765509461125e+4,
         4.5921953931549871457e+4, 6.7265770927008700853e+4, 3.3430575583588128105e+4, 2.5090809287301226727e+3},
        {1, 4.2313330701600911252e+1, 6.8718700749205790830e+2, 5.3941960214247511077e+3, 2.1213794301586595867e+4,
         3.9307895800092710610e+4, 2.8729085735721942674e+4, 5.2264952788528545610e+3}};
    static const double side[2][8] = {
        {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0, 3.64784832476320460504e0,
         1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4},
        {1, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1, 1.48103976427480074590e-1,
         1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9}};
    static const double tail[2][8] = {
        {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0, 2.96560571828504891230e-1,
         2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7},
        {1, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2, 7.86869131145613259100e-4,
         1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15}};
    double q = p - 0.5;
    if (fabs(q) <= 0.425)
        return q * rational(middle[0], middle[1], 0.180625 - q * q);
    double r = sqrt(-ceduo_log(q < 0 ? p : 1 - p));
    double z = r <= 5 ? rational(side[0], side[1], r - 1.6) : rational(tail[0], tail[1], r - 5);
    return q < 0 ? -z : z;
}
