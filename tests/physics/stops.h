/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where rocks stopped, seen and simulated: the distance of Kolmogorov and Smirnov. */
#ifndef STOPS_H
#define STOPS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/measure.h"
#include "ceduo/observe.h"

/* The 95 % point for n values (Stephens 1974). */
static inline double stops_band(size_t n)
{
    double root = sqrt((double)n);
    return 1.358 / (root + 0.12 + 0.11 / root);
}

/* A rock without a stop lies beyond all. Sorts `simulated` and sets the mean of those that stopped. NaN without memory. */
static inline double stops_distance(const struct ceduo_observation *seen, double *simulated, size_t n, double *mean)
{
    double sum = 0, stopped = 0, most = 0;
    for (size_t i = 0; i < n; i++)
        if (isnan(simulated[i])) {
            simulated[i] = INFINITY;
        } else {
            sum += simulated[i];
            stopped++;
        }
    *mean = sum / stopped;
    double *values = malloc(seen->n * sizeof *values);
    if (!values)
        return NAN;
    memcpy(values, seen->values, seen->n * sizeof *values);
    qsort(simulated, n, sizeof *simulated, by_value);
    qsort(values, seen->n, sizeof *values, by_value);
    size_t below = 0;
    for (size_t i = 0; i < seen->n; i++) {
        while (below < n && simulated[below] < values[i])
            below++;
        double share = (double)below / (double)n, of = (double)seen->released_count;
        most = fmax(most, fmax(fabs(share - (double)i / of), fabs(share - (double)(i + 1) / of)));
    }
    free(values);
    return most;
}

#endif
