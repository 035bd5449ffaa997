/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kolmogorov-Smirnov distance between observed and simulated stops. */
#ifndef STOPS_H
#define STOPS_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/measure.h"
#include "ceduo/calibrate.h"

/* Return the 95 % point of the distance for n values (Stephens 1974). */
static inline double stops_critical_distance(size_t n)
{
    double root = sqrt((double)n);
    return 1.358 / (root + 0.12 + 0.11 / root);
}

/* Sort `simulated` and set the mean of the rocks that stopped; a rock that did not stop lies beyond all others. Return the
 * distance, NaN if memory fails. */
static inline double stops_distance(const struct ceduo_observation *observed, double *simulated, size_t n, double *mean)
{
    double sum = 0, stopped = 0, distance = 0;
    for (size_t i = 0; i < n; i++)
        if (isnan(simulated[i])) {
            simulated[i] = INFINITY;
        } else {
            sum += simulated[i];
            stopped++;
        }
    *mean = sum / stopped;
    double *values = malloc(observed->n * sizeof *values);
    if (!values)
        return NAN;
    memcpy(values, observed->values, observed->n * sizeof *values);
    qsort(simulated, n, sizeof *simulated, by_value);
    qsort(values, observed->n, sizeof *values, by_value);
    size_t below = 0;
    for (size_t i = 0; i < observed->n; i++) {
        while (below < n && simulated[below] < values[i])
            below++;
        double share = (double)below / (double)n, released = (double)observed->released_count;
        distance = fmax(distance, fmax(fabs(share - (double)i / released), fabs(share - (double)(i + 1) / released)));
    }
    free(values);
    return distance;
}

#endif
