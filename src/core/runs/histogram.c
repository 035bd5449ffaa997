/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "histogram.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BINS            ((size_t)1 << HISTOGRAM_BITS)
#define LOWEST_EXPONENT (-64)

static uint32_t *octave_of(struct histogram *h, size_t octave)
{
    if (!h->octave[octave])
        h->octave[octave] = calloc(BINS, sizeof(uint32_t));
    return h->octave[octave];
}

bool ceduo_histogram_add(struct histogram *h, double value)
{
    uint64_t bits; /* octave and bin follow from them */
    memcpy(&bits, &value, sizeof bits);
    int64_t octave = (int64_t)(bits >> 52 & 0x7ff) - 1023 - LOWEST_EXPONENT;
    bool counted = value > 0 && octave >= 0;
    uint32_t *bins = counted ? octave_of(h, octave < HISTOGRAM_OCTAVES ? (size_t)octave : HISTOGRAM_OCTAVES - 1) : NULL;
    if (counted && !bins)
        return false;
    if (counted)
        bins[bits >> (52 - HISTOGRAM_BITS) & (BINS - 1)]++;
    h->zeros += !counted;
    h->n++;
    return true;
}

void ceduo_histogram_clear(struct histogram *h)
{
    for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++)
        free(h->octave[o]);
    memset(h, 0, sizeof *h);
}

bool ceduo_histograms_reserve(struct histogram *into, const struct histogram *from, size_t n)
{
    for (size_t i = 0; i < n; i++)
        for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++)
            if (from[i].octave[o] && !octave_of(&into[i], o))
                return false;
    return true;
}

void ceduo_histograms_merge(struct histogram *into, const struct histogram *from, size_t n)
{
    for (; n > 0; n--, into++, from++) {
        for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++)
            for (size_t i = 0; from->octave[o] && i < BINS; i++)
                into->octave[o][i] += from->octave[o][i];
        into->n += from->n;
        into->zeros += from->zeros;
    }
}

void ceduo_histograms_free(struct histogram *all, size_t n)
{
    for (size_t i = 0; all && i < n; i++)
        ceduo_histogram_clear(&all[i]);
    free(all);
}

double ceduo_histogram_value(const struct histogram *h, uint64_t rank)
{
    uint64_t before = h->zeros;
    if (rank <= before)
        return 0;
    for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++) {
        if (!h->octave[o])
            continue;
        for (size_t i = 0; i < BINS; i++) {
            before += h->octave[o][i];
            if (before >= rank)
                return ldexp(1 + ((double)i + 0.5) / (double)BINS, (int)o + LOWEST_EXPONENT);
        }
    }
    return NAN;
}

static void values_of_ranks(void *context, const size_t *ranks, size_t count, double *values)
{
    const struct histogram *h = *(const struct histogram *const *)context;
    for (size_t i = 0; i < count; i++)
        values[i] = ceduo_histogram_value(h, ranks[i]);
}

struct ceduo_distribution ceduo_distribution_binned(const struct histogram *h, const struct ceduo_moments *m)
{
    return ceduo_distribution_by(values_of_ranks, &h, (size_t)h->n, m);
}
