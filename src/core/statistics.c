/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/statistics.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

void ceduo_moments_merge(struct ceduo_moments *into, const struct ceduo_moments *from)
{
    if (from->n == 0)
        return;
    if (into->n == 0) {
        *into = *from;
        return;
    }
    double a = (double)into->n, b = (double)from->n, n = a + b;
    double d = from->mean - into->mean;
    into->mean += d * (b / n);
    into->m2 += from->m2 + d * d * (a * b / n);
    into->n += from->n;
    into->max = from->max > into->max ? from->max : into->max;
}

double ceduo_moments_sd(const struct ceduo_moments *m)
{
    return m->n < 2 ? NAN : sqrt(m->m2 / (double)(m->n - 1));
}

double ceduo_moments_se(const struct ceduo_moments *m)
{
    return m->n < 2 ? NAN : ceduo_moments_sd(m) / sqrt((double)m->n);
}

void ceduo_wilson(uint64_t hits, uint64_t n, double *lo, double *hi)
{
    *lo = 0;
    *hi = 1;
    if (n == 0)
        return;
    double z2 = CEDUO_Z95 * CEDUO_Z95, count = (double)n, p = (double)hits / count;
    double centre = p + z2 / (2 * count), scale = 1 + z2 / count;
    double half = CEDUO_Z95 * sqrt(p * (1 - p) / count + z2 / (4 * count * count));
    if (hits > 0)
        *lo = fmax(0, (centre - half) / scale);
    if (hits < n)
        *hi = fmin(1, (centre + half) / scale);
}

double ceduo_half_width(double se, uint64_t n)
{
    return n < 2 ? NAN : se * gsl_cdf_tdist_Pinv(0.975, (double)(n - 1));
}

double ceduo_half_width_of_share(double share, double se, uint64_t n)
{
    double lo, hi;
    if (share > 0 && share < 1)
        return CEDUO_Z95 * se;
    ceduo_wilson(share > 0 ? n : 0, n, &lo, &hi);
    return hi - lo;
}

size_t ceduo_quantile_rank(size_t n, double p)
{
    double k = ceil(p * (double)n - 1e-9);
    return k < 1 ? 1 : (size_t)k;
}

/* Smallest k with P(X <= k) >= q for X binomial(n, p), looked for near its normal approximation. */
static size_t binomial_quantile(size_t n, double p, double q)
{
    double count = (double)n, guess = count * p + gsl_cdf_ugaussian_Pinv(q) * sqrt(count * p * (1 - p));
    size_t k = guess < 0 ? 0 : guess > count ? n : (size_t)guess;
    while (k > 0 && gsl_cdf_binomial_P((unsigned)(k - 1), p, (unsigned)n) >= q)
        k--;
    while (k < n && gsl_cdf_binomial_P((unsigned)k, p, (unsigned)n) < q)
        k++;
    return k;
}

void ceduo_quantile_interval(size_t n, double p, size_t *lo, size_t *hi)
{
    /* The number of values below the quantile is binomial: [x(lo), x(hi)] holds it unless that number is below lo or at
     * least hi, each with a chance of at most 2.5 %. */
    *lo = binomial_quantile(n, p, 0.025);
    *hi = binomial_quantile(n, p, 0.975) + 1;
}

struct ceduo_distribution ceduo_distribution_none(void)
{
    return (struct ceduo_distribution){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

/* The rank-th smallest value; what lies before rank `from` is already smaller. */
static double select_rank(double *values, size_t n, size_t *from, size_t rank)
{
    size_t skip = *from > 0 ? *from - 1 : 0;
    double v = gsl_stats_select(values + skip, 1, n - skip, rank - 1 - skip);
    *from = rank;
    return v;
}

struct ceduo_distribution ceduo_distribution_exact(double *values, size_t n, const struct ceduo_moments *m)
{
    struct ceduo_distribution d = ceduo_distribution_none();
    if (n == 0)
        return d;
    d.mean = m->mean;
    d.sd = ceduo_moments_sd(m);
    d.se = ceduo_moments_se(m);
    d.max = m->max;
    size_t lo, hi, from = 0, r50 = ceduo_quantile_rank(n, 0.5), r95 = ceduo_quantile_rank(n, 0.95);
    ceduo_quantile_interval(n, 0.95, &lo, &hi);
    d.p50 = select_rank(values, n, &from, r50);
    d.p95_lo = lo > 0 ? select_rank(values, n, &from, lo) : NAN; /* not before the median, for any n */
    d.p95 = select_rank(values, n, &from, r95);
    size_t r99 = ceduo_quantile_rank(n, 0.99);
    bool hi_first = hi <= r99;
    if (hi_first)
        d.p95_hi = select_rank(values, n, &from, hi);
    d.p99 = select_rank(values, n, &from, r99);
    if (!hi_first)
        d.p95_hi = hi <= n ? select_rank(values, n, &from, hi) : NAN;
    return d;
}
