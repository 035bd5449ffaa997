/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#include "base/gsl_errors.h"
#include "base/ranks.h"
#include "statistics.h"

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

struct ceduo_estimate ceduo_wilson(double share, double max, double n)
{
    struct ceduo_estimate r = {share, NAN, 0, 1};
    double z2 = CEDUO_Z95 * CEDUO_Z95, scale = 1 + z2 / n;
    if (!(n > 0))
        return r;
    if (share > 0)
        r.lo = fmax(0, (share + z2 / (2 * n) - CEDUO_Z95 * sqrt(share * (1 - share) / n + z2 / (4 * n * n))) / scale);
    if (max < 1)
        r.hi = fmin(1, (max + z2 / (2 * n) + CEDUO_Z95 * sqrt(max * (1 - max) / n + z2 / (4 * n * n))) / scale);
    return r;
}

double ceduo_half_width(double se, uint64_t n)
{
    GSL_RETURNS_ERRORS;
    return n < CEDUO_INTERVAL_MIN_N ? NAN : se * gsl_cdf_tdist_Pinv(0.975, (double)(n - 1));
}

double ceduo_share_half_width(double share, double se, uint64_t n)
{
    if (share > 0 && share < 1)
        return CEDUO_Z95 * se;
    struct ceduo_estimate all_or_none = ceduo_wilson(share > 0, share > 0, (double)n);
    return all_or_none.hi - all_or_none.lo;
}

double ceduo_share_se(double share, double n)
{
    return sqrt(share * (1 - share) / n);
}

struct ceduo_estimate ceduo_estimate_from_se(double mean, double se)
{
    return (struct ceduo_estimate){mean, se, mean - CEDUO_Z95 * se, mean + CEDUO_Z95 * se};
}

struct ceduo_estimate ceduo_estimate_from_pairs(double mean, const struct ceduo_moments *m, uint64_t rocks)
{
    if (m->n == 0 || m->mean != 0 || m->m2 > 0)
        return ceduo_estimate_from_se(mean, ceduo_moments_sd(m) / sqrt((double)rocks));
    double hi = ceduo_wilson(0, 0, (double)m->n).hi;
    return (struct ceduo_estimate){mean, NAN, mean - hi, mean + hi};
}

size_t ceduo_quantile_rank(size_t n, double p)
{
    double k = ceil(p * (double)n - 1e-9);
    return k < 1 ? 1 : (size_t)k;
}

double ceduo_quantile(const double *sorted, size_t n, double p)
{
    return n > 0 ? sorted[ceduo_quantile_rank(n, p) - 1] : NAN;
}

/* Return the smallest k with P(X <= k) >= q for X binomial(n, p). The search starts at the normal approximation. */
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
    GSL_RETURNS_ERRORS;
    /* The number of values below the quantile is binomial. [x(lo), x(hi)] contains the quantile unless this number is below lo
     * or at least hi, each with probability at most 2.5 %. */
    *lo = binomial_quantile(n, p, 0.025);
    *hi = binomial_quantile(n, p, 0.975) + 1;
}

struct ceduo_distribution ceduo_distribution_none(void)
{
    return (struct ceduo_distribution){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

struct percentile ceduo_percentile_compute(struct ceduo_distribution *d, size_t k)
{
    const struct percentile percentiles[PERCENTILES] = {{0.5, &d->p50, &d->p50_lo, &d->p50_hi},
                                                        {0.95, &d->p95, &d->p95_lo, &d->p95_hi},
                                                        {0.99, &d->p99, &d->p99_lo, &d->p99_hi}};
    return percentiles[k];
}

static int compare_ranks(const void *a, const void *b)
{
    const struct rank *x = a, *y = b;
    return (x->rank > y->rank) - (x->rank < y->rank);
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
    struct rank ranks[3 * PERCENTILES]; /* each percentile with its interval */
    size_t count = 0;
    for (size_t k = 0; k < PERCENTILES; k++) {
        struct percentile percentile = ceduo_percentile_compute(&d, k);
        size_t lo, hi;
        ceduo_quantile_interval(n, percentile.p, &lo, &hi);
        ranks[count++] = (struct rank){ceduo_quantile_rank(n, percentile.p), percentile.value};
        if (lo > 0)
            ranks[count++] = (struct rank){lo, percentile.lo};
        if (hi <= n)
            ranks[count++] = (struct rank){hi, percentile.hi};
    }
    qsort(ranks, count, sizeof ranks[0], compare_ranks);
    ceduo_ranks_select(values, n, ranks, count);
    for (size_t i = 0; i < count; i++)
        *ranks[i].to = fmin(m->max, *ranks[i].to);
    return d;
}
