/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HISTOGRAM_H
#define CEDUO_HISTOGRAM_H

#include <stdbool.h>
#include <stdint.h>

#include "ceduo/statistics.h"

/* Counts of values >= 0 in bins of equal relative width, 1/16384 of an octave (6.1e-5), an octave's bins made when it is
 * first met. Counts only: histograms merge in any order to the same bits. */
#define HISTOGRAM_OCTAVES 128
#define HISTOGRAM_BITS    14

struct histogram {
    uint64_t n, zeros;                   /* zeros: values below the smallest octave, 2^-64 */
    uint32_t *octave[HISTOGRAM_OCTAVES]; /* NULL: none */
};

/* False without memory; the value is then not counted. */
bool ceduo_histogram_add(struct histogram *h, double value);

void ceduo_histogram_clear(struct histogram *h);

/* For n of them: make room for all that others have, false without memory; then add those, which does not fail; free the
 * array too, which may be NULL. */
bool ceduo_histograms_reserve(struct histogram *into, const struct histogram *from, size_t n);
void ceduo_histograms_merge(struct histogram *into, const struct histogram *from, size_t n);
void ceduo_histograms_free(struct histogram *all, size_t n);

/* The value of rank 1…n: the middle of its bin. */
double ceduo_histogram_value(const struct histogram *h, uint64_t rank);

/* As ceduo_distribution_exact(). */
struct ceduo_distribution ceduo_distribution_binned(const struct histogram *h, const struct ceduo_moments *m);

#endif
