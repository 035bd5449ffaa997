/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/statistics.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

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

void ceduo_wilson_share(double share, double n, double *lo, double *hi)
{
    double z2 = CEDUO_Z95 * CEDUO_Z95, centre = share + z2 / (2 * n), scale = 1 + z2 / n;
    double half = CEDUO_Z95 * sqrt(share * (1 - share) / n + z2 / (4 * n * n));
    *lo = share > 0 ? fmax(0, (centre - half) / scale) : 0;
    *hi = share < 1 ? fmin(1, (centre + half) / scale) : 1;
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
    return (struct ceduo_distribution){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

struct wanted {
    size_t rank;
    double *to;
};

static int by_rank(const void *a, const void *b)
{
    const struct wanted *x = a, *y = b;
    return (x->rank > y->rank) - (x->rank < y->rank);
}

struct ceduo_distribution ceduo_distribution_by(double (*value)(void *context, size_t rank), void *context, size_t n,
                                                const struct ceduo_moments *m)
{
    struct ceduo_distribution d = ceduo_distribution_none();
    if (n == 0)
        return d;
    d.mean = m->mean;
    d.sd = ceduo_moments_sd(m);
    d.se = ceduo_moments_se(m);
    d.max = m->max;
    const struct {
        double p, *at, *lo, *hi;
    } percentiles[] = {{0.5, &d.p50, &d.p50_lo, &d.p50_hi}, {0.95, &d.p95, &d.p95_lo, &d.p95_hi},
                       {0.99, &d.p99, &d.p99_lo, &d.p99_hi}};
    struct wanted wanted[9];
    for (size_t i = 0; i < 3; i++) {
        size_t lo, hi;
        ceduo_quantile_interval(n, percentiles[i].p, &lo, &hi);
        wanted[3 * i] = (struct wanted){ceduo_quantile_rank(n, percentiles[i].p), percentiles[i].at};
        wanted[3 * i + 1] = (struct wanted){lo, percentiles[i].lo};
        wanted[3 * i + 2] = (struct wanted){hi, percentiles[i].hi};
    }
    qsort(wanted, 9, sizeof wanted[0], by_rank);
    for (size_t i = 0; i < 9; i++)
        if (wanted[i].rank > 0 && wanted[i].rank <= n)
            *wanted[i].to = fmin(m->max, value(context, wanted[i].rank));
    return d;
}

/* Values that are sorted as far as ranks were asked for. */
struct selection {
    double *values;
    size_t n, from; /* what lies before rank `from` is smaller than what comes */
};

static double select_rank(void *context, size_t rank)
{
    struct selection *s = context;
    size_t skip = s->from > 0 ? s->from - 1 : 0;
    s->from = rank;
    return gsl_stats_select(s->values + skip, 1, s->n - skip, rank - 1 - skip);
}

struct ceduo_distribution ceduo_distribution_exact(double *values, size_t n, const struct ceduo_moments *m)
{
    struct selection selection = {.values = values, .n = n};
    return ceduo_distribution_by(select_rank, &selection, n, m);
}
