/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "seen.h"

#include <gsl/gsl_randist.h>
#include <math.h>

/* How many of n sorted values lie beyond x. */
static size_t beyond(const double *values, size_t n, double x)
{
    size_t k = 0;
    while (k < n && values[k] <= x)
        k++;
    return n - k;
}

/* The least count that at least so much of the samples do not exceed. */
static double quantile(unsigned n, double p, double share)
{
    double sum = 0;
    for (unsigned k = 0; k < n; k++)
        if ((sum += gsl_ran_binomial_pdf(k, p, n)) >= share)
            return k;
    return n;
}

void ceduo_seen_stops_of(const struct ceduo_observation *o, const double *values, size_t n, size_t rocks,
                         struct ceduo_seen_stops *to)
{
    double first = fmin(values[0], o->values[0]), last = fmax(values[n - 1], o->values[o->n - 1]);
    size_t of = o->of > 0 ? (size_t)o->of : o->n, all = o->of > 0 ? rocks : n;
    to->known = last > first;
    for (size_t i = 0; i < CEDUO_SEEN_PLACES; i++) {
        double x = to->x[i] = first + (last - first) * (double)i / (CEDUO_SEEN_PLACES - 1);
        double p = (double)(beyond(values, n, x) + all - n) / (double)all;
        to->seen[i] = (double)(beyond(o->values, o->n, x) + of - o->n) / (double)of;
        to->lo[i] = quantile((unsigned)of, p, 0.025) / (double)of;
        to->hi[i] = quantile((unsigned)of, p, 0.975) / (double)of;
    }
}
