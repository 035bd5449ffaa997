/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/number.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#define CUT_SD 3.0 /* a normal law is cut here */

struct ceduo_number ceduo_number(double mean)
{
    return (struct ceduo_number){.mean = mean, .spread = 0, .kind = CEDUO_NORMAL};
}

static double reach(struct ceduo_number n)
{
    return n.kind == CEDUO_NORMAL ? CUT_SD * n.spread : n.spread;
}

double ceduo_number_lowest(struct ceduo_number n)
{
    return n.mean - reach(n);
}

double ceduo_number_highest(struct ceduo_number n)
{
    return n.mean + reach(n);
}

double ceduo_number_draw(struct ceduo_number n, double u, double lo, double hi)
{
    if (!(n.spread > 0))
        return n.mean;
    lo = fmax(lo, ceduo_number_lowest(n));
    hi = fmin(hi, ceduo_number_highest(n));
    if (n.kind == CEDUO_UNIFORM)
        return lo + u * (hi - lo);
    double p_lo = gsl_cdf_ugaussian_P((lo - n.mean) / n.spread);
    double p_hi = gsl_cdf_ugaussian_P((hi - n.mean) / n.spread);
    double x = n.mean + n.spread * gsl_cdf_ugaussian_Pinv(p_lo + u * (p_hi - p_lo));
    return fmin(fmax(x, lo), hi);
}
