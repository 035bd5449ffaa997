/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "weighted.h"

#include <math.h>
#include <stdlib.h>

#define ROUNDING 1e-12 /* of a variance: what is left of it by rounding alone */

/* The variance of one rock's part in a sum, less what its weight explains. */
static double variance(const struct released *all, const struct weighted_sum *s)
{
    double n = all->n, mt = s->t / n, mw = all->w / n;
    double vt = s->tt / n - mt * mt, vw = all->ww / n - mw * mw, c = s->tw / n - mt * mw;
    double left = vw > ROUNDING * mw * mw ? vt - c * c / vw : vt;
    return left > ROUNDING * s->tt / n ? left : 0;
}

double ceduo_weighted_se(const struct released *all, const struct weighted_sum *s)
{
    return all->n < 2 ? NAN : sqrt(variance(all, s) / (all->n - 1)) * all->n / all->w;
}

void ceduo_weighted_bound(struct weighted *rocks, size_t n)
{
    ceduo_weighted_sort(rocks, n);
    for (size_t i = n; i-- > 1;)
        rocks[i - 1].weight += rocks[i].weight;
}

size_t ceduo_weighted_upto(const struct weighted *rising, size_t n, double value)
{
    size_t lo = 0, hi = n;
    while (lo < hi) {
        size_t middle = (lo + hi) / 2;
        if (rising[middle].value > value)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

/* Wilson's upper end where none of the rocks is seen to have more than an energy: of those that could, so many as they are, and
 * for the share that they are. */
static double upper_of_none(const struct released *all, double energy)
{
    const double z2 = CEDUO_Z95 * CEDUO_Z95;
    size_t n = (size_t)all->n, lo = all->could ? ceduo_weighted_upto(all->could, n, energy) : 0;
    if (lo == n)
        return 0;
    return (all->could ? all->could[lo].weight / all->w : 1) * z2 / ((double)(n - lo) + z2);
}

struct ceduo_estimate ceduo_weighted_share(const struct released *all, const struct weighted_sum *ones, double energy)
{
    double sum = ones->t / all->w, p = sum < 1 - ROUNDING ? sum : 1; /* all are summed in another order */
    double mean = all->w / all->n, v = variance(all, ones) / (mean * mean);
    double effective = all->w * all->w / all->ww; /* so many equal rocks would have the same error */
    double missing = all->missing / all->w, least = fmin(1, missing + upper_of_none(all, energy));
    if (!(p > 0))
        return (struct ceduo_estimate){p, NAN, 0, missing > 0 ? fmax(least, ceduo_wilson(0, missing, effective).hi) : least};
    if (p < 1 && v > 0)
        effective = p * (1 - p) * all->n / v;
    struct ceduo_estimate share = ceduo_wilson(p, fmin(1, p + missing), effective);
    share.hi = fmax(share.hi, least);
    return share;
}

struct ceduo_estimate ceduo_weighted_paired(const struct released *all, const struct weighted_sum *s)
{
    if (s->tt > 0)
        return ceduo_estimate_by_se(s->t / all->w, ceduo_weighted_se(all, s));
    double hi = ceduo_wilson(0, 0, all->w * all->w / all->ww).hi;
    return (struct ceduo_estimate){0, NAN, -hi, hi};
}

/* ---- distributions ---- */

static int by_value(const void *a, const void *b)
{
    const struct weighted *x = a, *y = b;
    return x->value != y->value ? (x->value > y->value) - (x->value < y->value)
                                : (x->weight > y->weight) - (x->weight < y->weight);
}

void ceduo_weighted_sort(struct weighted *values, size_t n)
{
    if (n > 0) /* otherwise there is no array */
        qsort(values, n, sizeof *values, by_value);
}

static double weight_of(const struct weighted *values, size_t n)
{
    double w = 0;
    for (size_t i = 0; i < n; i++)
        w += values[i].weight;
    return w;
}

double ceduo_weighted_quantile(const struct weighted *values, size_t n, double p)
{
    double wanted = p * weight_of(values, n) * (1 - ROUNDING), below = 0;
    for (size_t i = 0; i < n; i++)
        if ((below += values[i].weight) >= wanted)
            return values[i].value;
    return n > 0 ? values[n - 1].value : NAN;
}

struct ceduo_distribution ceduo_weighted_distribution(const struct released *all, struct weighted *values, size_t n)
{
    struct ceduo_distribution d = ceduo_distribution_none();
    double w = weight_of(values, n), squares = 0;
    struct weighted_sum sum = {0}, about = {0};
    if (n == 0)
        return d;
    ceduo_weighted_sort(values, n);
    for (size_t i = 0; i < n; i++)
        weighted_sum_add(&sum, values[i].weight, values[i].value);
    d.mean = sum.t / w;
    for (size_t i = 0; i < n; i++) {
        double off = values[i].value - d.mean;
        weighted_sum_add(&about, values[i].weight, off);
        squares += values[i].weight * off * off;
    }
    if (n > 1) {
        d.sd = sqrt(squares / w * (double)n / (double)(n - 1));
        d.se = ceduo_weighted_se(all, &about) * all->w / w;
    }
    d.max = values[n - 1].value;
    for (size_t k = 0; k < PERCENTILES;
         k++) { /* the share below one is a mean over the n values, whose error moves it up and down */
        struct percentile to = ceduo_percentile_compute(&d, k);
        double p = to.p, at = ceduo_weighted_quantile(values, n, p);
        struct weighted_sum below = {0};
        for (size_t i = 0; i < n; i++)
            weighted_sum_add(&below, values[i].weight, (values[i].value <= at) - p);
        double half = CEDUO_Z95 * ceduo_weighted_se(all, &below) * all->w / w;
        *to.value = at;
        *to.lo = p - half > 0 ? ceduo_weighted_quantile(values, n, p - half) : NAN;
        *to.hi = p + half < 1 ? ceduo_weighted_quantile(values, n, p + half) : NAN;
    }
    return d;
}
