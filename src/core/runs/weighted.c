/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "weighted.h"
#include "statistics.h"

#include <math.h>
#include <stdlib.h>

#define ROUNDING 1e-12 /* relative rounding error of a variance */

/* Return the variance of one rock's term in a sum, less the part explained by its weight. */
static double variance(const struct weight_totals *totals, const struct weighted_sum *s)
{
    double n = totals->n, mt = s->t / n, mw = totals->w / n;
    double vt = s->tt / n - mt * mt, vw = totals->ww / n - mw * mw, c = s->tw / n - mt * mw;
    double residual = vw > ROUNDING * mw * mw ? vt - c * c / vw : vt;
    return residual > ROUNDING * s->tt / n ? residual : 0;
}

double ceduo_weighted_se(const struct weight_totals *totals, const struct weighted_sum *s)
{
    return totals->n < 2 ? NAN : sqrt(variance(totals, s) / (totals->n - 1)) * totals->n / totals->w;
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
        size_t mid = (lo + hi) / 2;
        if (rising[mid].value > value)
            hi = mid;
        else
            lo = mid + 1;
    }
    return lo;
}

/* Return Wilson's upper limit if no simulated rock exceeds an energy, for the rocks that could exceed it: by their number,
 * times their share. */
static double upper_limit_of_none(const struct weight_totals *totals, double energy)
{
    const double z2 = CEDUO_Z95 * CEDUO_Z95;
    size_t n = (size_t)totals->n, lo = totals->max_energies ? ceduo_weighted_upto(totals->max_energies, n, energy) : 0;
    if (lo == n)
        return 0;
    return (totals->max_energies ? totals->max_energies[lo].weight / totals->w : 1) * z2 / ((double)(n - lo) + z2);
}

struct ceduo_estimate ceduo_weighted_share(const struct weight_totals *totals, const struct weighted_sum *ones, double energy)
{
    double sum = ones->t / totals->w, p = sum < 1 - ROUNDING ? sum : 1; /* the order of summation differs */
    double mean = totals->w / totals->n, v = variance(totals, ones) / (mean * mean);
    double effective = totals->w * totals->w / totals->ww; /* number of equal rocks with the same error */
    double missing = totals->missing / totals->w, hi_min = fmin(1, missing + upper_limit_of_none(totals, energy));
    if (!(p > 0))
        return (struct ceduo_estimate){p, NAN, 0, missing > 0 ? fmax(hi_min, ceduo_wilson(0, missing, effective).hi) : hi_min};
    if (p < 1 && v > 0)
        effective = p * (1 - p) * totals->n / v;
    struct ceduo_estimate share = ceduo_wilson(p, fmin(1, p + missing), effective);
    share.hi = fmax(share.hi, hi_min);
    return share;
}

struct ceduo_estimate ceduo_weighted_paired(const struct weight_totals *totals, const struct weighted_sum *s)
{
    if (s->tt > 0)
        return ceduo_estimate_from_se(s->t / totals->w, ceduo_weighted_se(totals, s));
    double hi = ceduo_wilson(0, 0, totals->w * totals->w / totals->ww).hi;
    return (struct ceduo_estimate){0, NAN, -hi, hi};
}

/* ---- distributions ---- */

static int compare_values(const void *a, const void *b)
{
    const struct weighted *x = a, *y = b;
    return x->value != y->value ? (x->value > y->value) - (x->value < y->value)
                                : (x->weight > y->weight) - (x->weight < y->weight);
}

void ceduo_weighted_sort(struct weighted *values, size_t n)
{
    if (n > 0) /* the array may be NULL if n is 0 */
        qsort(values, n, sizeof *values, compare_values);
}

static double get_weight(const struct weighted *values, size_t n)
{
    double w = 0;
    for (size_t i = 0; i < n; i++)
        w += values[i].weight;
    return w;
}

double ceduo_weighted_quantile(const struct weighted *values, size_t n, double p)
{
    double target = p * get_weight(values, n) * (1 - ROUNDING), below = 0;
    for (size_t i = 0; i < n; i++)
        if ((below += values[i].weight) >= target)
            return values[i].value;
    return n > 0 ? values[n - 1].value : NAN;
}

struct ceduo_distribution ceduo_weighted_distribution(const struct weight_totals *totals, struct weighted *values, size_t n)
{
    struct ceduo_distribution d = ceduo_distribution_none();
    double w = get_weight(values, n), squares = 0;
    struct weighted_sum sum = {0}, deviations = {0};
    if (n == 0)
        return d;
    ceduo_weighted_sort(values, n);
    for (size_t i = 0; i < n; i++)
        weighted_sum_add(&sum, values[i].weight, values[i].value);
    d.mean = sum.t / w;
    for (size_t i = 0; i < n; i++) {
        double deviation = values[i].value - d.mean;
        weighted_sum_add(&deviations, values[i].weight, deviation);
        squares += values[i].weight * deviation * deviation;
    }
    if (n > 1) {
        d.sd = sqrt(squares / w * (double)n / (double)(n - 1));
        d.se = ceduo_weighted_se(totals, &deviations) * totals->w / w;
    }
    d.max = values[n - 1].value;
    for (size_t k = 0; k < PERCENTILES;
         k++) { /* the share below a value is a mean over the n values; its error bounds the percentile */
        struct percentile to = ceduo_percentile_compute(&d, k);
        double p = to.p, quantile = ceduo_weighted_quantile(values, n, p);
        struct weighted_sum below = {0};
        for (size_t i = 0; i < n; i++)
            weighted_sum_add(&below, values[i].weight, (values[i].value <= quantile) - p);
        double half = CEDUO_Z95 * ceduo_weighted_se(totals, &below) * totals->w / w;
        *to.value = quantile;
        *to.lo = p - half > 0 ? ceduo_weighted_quantile(values, n, p - half) : NAN;
        *to.hi = p + half < 1 ? ceduo_weighted_quantile(values, n, p + half) : NAN;
    }
    return d;
}
