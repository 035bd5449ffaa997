/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "seen.h"

#include <math.h>

#include "ceduo/statistics.h"

/* How many of n sorted values lie beyond x. */
static size_t beyond(const double *values, size_t n, double x)
{
    size_t k = 0;
    while (k < n && values[k] <= x)
        k++;
    return n - k;
}

void ceduo_observed_stops_find(const struct ceduo_observation *o, const double *values, size_t n, size_t rocks,
                               struct ceduo_observed_stops *to)
{
    double first = fmin(values[0], o->values[0]), last = fmax(values[n - 1], o->values[o->n - 1]);
    size_t of = o->released > 0 ? (size_t)o->released : o->n, all = o->released > 0 ? rocks : n;
    to->known = last > first;
    for (size_t i = 0; i < CEDUO_SEEN_PLACES; i++) {
        double x = to->x[i] = first + (last - first) * (double)i / (CEDUO_SEEN_PLACES - 1);
        double p = (double)(beyond(values, n, x) + all - n) / (double)all;
        to->observed[i] = (double)(beyond(o->values, o->n, x) + of - o->n) / (double)of;
        size_t lo, hi; /* of how many lie beyond, which is binomial */
        ceduo_quantile_interval(of, p, &lo, &hi);
        to->lo[i] = (double)lo / (double)of;
        to->hi[i] = (double)(hi - 1) / (double)of;
    }
}
