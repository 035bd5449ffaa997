/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SINCOS_H
#define CEDUO_SINCOS_H

#include <math.h>

/* Sine and cosine of an angle in [-pi/2, pi/2] by their power series, within 2e-16: the same bits with any libm, any
 * optimisation and in any lane. */
static inline void sincos_quarter(double angle, double *sine, double *cosine)
{
    const double half_pi_hi = 1.5707963267948966, half_pi_lo = 6.123233995736766e-17;
    double a = fabs(angle);
    int swap = a > 0.7853981633974483; /* sin a = cos(pi/2 - a) */
    double y = swap ? (half_pi_hi - a) + half_pi_lo : a;
    double q = y * y;
    double s = 1.0 / 355687428096000.0;
    s = s * q - 1.0 / 1307674368000.0;
    s = s * q + 1.0 / 6227020800.0;
    s = s * q - 1.0 / 39916800.0;
    s = s * q + 1.0 / 362880.0;
    s = s * q - 1.0 / 5040.0;
    s = s * q + 1.0 / 120.0;
    s = s * q - 1.0 / 6.0;
    s = y + y * (q * s);
    double c = 1.0 / 20922789888000.0;
    c = c * q - 1.0 / 87178291200.0;
    c = c * q + 1.0 / 479001600.0;
    c = c * q - 1.0 / 3628800.0;
    c = c * q + 1.0 / 40320.0;
    c = c * q - 1.0 / 720.0;
    c = c * q + 1.0 / 24.0;
    c = c * q - 1.0 / 2.0;
    c = 1.0 + q * c;
    *sine = copysign(swap ? c : s, angle);
    *cosine = swap ? s : c;
}

#endif
