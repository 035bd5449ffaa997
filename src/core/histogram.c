/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "histogram.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BINS ((size_t)1 << HISTOGRAM_BITS)
#define LOWEST_EXPONENT (-64)

/* Octave and bin of a value, from its bits; false below the smallest octave. */
static bool place(double value, size_t *octave, size_t *bin)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int64_t exponent = (int64_t)(bits >> 52 & 0x7ff) - 1023 - LOWEST_EXPONENT;
    if (!(value > 0) || exponent < 0)
        return false;
    *octave = exponent < HISTOGRAM_OCTAVES ? (size_t)exponent : HISTOGRAM_OCTAVES - 1;
    *bin = (size_t)(bits >> (52 - HISTOGRAM_BITS) & (BINS - 1));
    return true;
}

static uint32_t *octave_of(struct histogram *h, size_t octave)
{
    if (!h->octave[octave])
        h->octave[octave] = calloc(BINS, sizeof(uint32_t));
    return h->octave[octave];
}

bool ceduo_histogram_add(struct histogram *h, double value)
{
    size_t octave, bin;
    if (!place(value, &octave, &bin)) {
        h->zeros++;
        h->n++;
        return true;
    }
    uint32_t *bins = octave_of(h, octave);
    if (!bins)
        return false;
    bins[bin]++;
    h->n++;
    return true;
}

bool ceduo_histogram_merge(struct histogram *into, const struct histogram *from)
{
    for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++) {
        if (!from->octave[o])
            continue;
        uint32_t *bins = octave_of(into, o);
        if (!bins)
            return false;
        for (size_t i = 0; i < BINS; i++)
            bins[i] += from->octave[o][i];
    }
    into->n += from->n;
    into->zeros += from->zeros;
    return true;
}

void ceduo_histogram_clear(struct histogram *h)
{
    for (size_t o = 0; o < HISTOGRAM_OCTAVES; o++)
        free(h->octave[o]);
    memset(h, 0, sizeof *h);
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

struct ceduo_distribution ceduo_distribution_binned(const struct histogram *h, const struct ceduo_moments *m)
{
    struct ceduo_distribution d = ceduo_distribution_none();
    size_t n = (size_t)h->n, lo, hi;
    if (n == 0)
        return d;
    ceduo_quantile_interval(n, 0.95, &lo, &hi);
    d.mean = m->mean;
    d.sd = ceduo_moments_sd(m);
    d.se = ceduo_moments_se(m);
    d.max = m->max;
    d.p50 = fmin(m->max, ceduo_histogram_value(h, ceduo_quantile_rank(n, 0.5)));
    d.p95 = fmin(m->max, ceduo_histogram_value(h, ceduo_quantile_rank(n, 0.95)));
    d.p99 = fmin(m->max, ceduo_histogram_value(h, ceduo_quantile_rank(n, 0.99)));
    d.p95_lo = lo > 0 ? fmin(m->max, ceduo_histogram_value(h, lo)) : NAN;
    d.p95_hi = hi <= n ? fmin(m->max, ceduo_histogram_value(h, hi)) : NAN;
    return d;
}
