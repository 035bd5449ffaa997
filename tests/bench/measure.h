/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef MEASURE_H
#define MEASURE_H

#include <stdlib.h>

#include "base/clock.h"

/* Compare numbers for qsort(), ascending. */
static inline int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Reorders the values. */
static inline double median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, by_value);
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

#endif
