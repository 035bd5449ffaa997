/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "observed_stops.h"
#include "core/runs/statistics.h"

#include <math.h>

/* Return the number of n sorted values above x. */
static size_t count_above(const double *values, size_t n, double x)
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
    size_t released = o->released_count > 0 ? (size_t)o->released_count : o->n, all = o->released_count > 0 ? rocks : n;
    to->known = last > first;
    for (size_t i = 0; i < CEDUO_STOPS_PLACES; i++) {
        double x = to->x[i] = first + (last - first) * (double)i / (CEDUO_STOPS_PLACES - 1);
        double p = (double)(count_above(values, n, x) + all - n) / (double)all;
        to->observed[i] = (double)(count_above(o->values, o->n, x) + released - o->n) / (double)released;
        size_t lo, hi; /* interval of the binomial number beyond x */
        ceduo_quantile_interval(released, p, &lo, &hi);
        to->lo[i] = (double)lo / (double)released;
        to->hi[i] = (double)(hi - 1) / (double)released;
    }
}
