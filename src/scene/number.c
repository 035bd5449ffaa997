/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/rock.h"

#include <math.h>

#include "base/elementary.h"

#define CUT_SD    3.0                   /* a normal law is cut here */
#define BELOW_CUT 0.0013498980316300946 /* chance of less than -CUT_SD */

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
    double lowest = ceduo_number_lowest(n), highest = ceduo_number_highest(n);
    lo = fmax(lo, lowest);
    hi = fmin(hi, highest);
    if (n.kind == CEDUO_UNIFORM)
        return lo + u * (hi - lo);
    double p_lo = lo == lowest ? BELOW_CUT : ceduo_normal_chance((lo - n.mean) / n.spread);
    double p_hi = hi == highest ? 1 - BELOW_CUT : ceduo_normal_chance((hi - n.mean) / n.spread);
    double x = n.mean + n.spread * ceduo_normal_quantile(p_lo + u * (p_hi - p_lo));
    return fmin(fmax(x, lo), hi);
}
