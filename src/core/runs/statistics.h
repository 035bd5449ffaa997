/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STATISTICS_H
#define CEDUO_STATISTICS_H

#include "ceduo/simulate.h"

#define CEDUO_Z95 1.959963984540054 /* 97.5 % quantile of the normal distribution */

static inline void ceduo_moments_add(struct ceduo_moments *m, double value)
{
    m->n++;
    double d = value - m->mean;
    m->mean += d / (double)m->n;
    m->m2 += d * (value - m->mean);
    m->max = m->n == 1 || value > m->max ? value : m->max;
}
void ceduo_moments_merge(struct ceduo_moments *into, const struct ceduo_moments *from);

/* Return the standard deviation, or the standard error of the mean; NaN for fewer than two values. */
double ceduo_moments_sd(const struct ceduo_moments *m);
double ceduo_moments_se(const struct ceduo_moments *m);

/* Return the half-width of the 95 % interval of a mean of n values, from its standard error in any unit. Uses Student's
 * distribution with n - 1 degrees of freedom. NaN if n < CEDUO_INTERVAL_MIN_N. */
#define CEDUO_INTERVAL_MIN_N 10
double ceduo_half_width(double se, uint64_t n);

/* Return the standard error of a share of n values. */
double ceduo_share_se(double share, double n);

/* Return the half-width for a share of n rocks by the normal distribution. For shares 0 and 1, whose standard error is 0, it is
 * the width of Wilson's interval. Also valid for the difference of two equal shares. */
double ceduo_share_half_width(double share, double se, uint64_t n);

/* Return the estimate of a share of n rocks with its interval after Wilson (1927); se is NaN. n need not be whole. The upper
 * limit uses `max`, a share that includes rocks of unknown end. The interval is [0, 1] for n = 0. */
struct ceduo_estimate ceduo_wilson(double share, double max, double n);

/* Return the estimate of a mean with its interval by the normal distribution. */
struct ceduo_estimate ceduo_estimate_from_se(double mean, double se);

/* Return the estimate of a mean difference between pairs of rocks, with the spread of the pairs in `m`. If no pair differs, se
 * is NaN and the interval goes to the share of pairs that may differ all the same (Wilson). */
struct ceduo_estimate ceduo_estimate_from_pairs(double mean, const struct ceduo_moments *m, uint64_t rocks);

/* True if no pair of such an estimate differs. */
static inline bool ceduo_pairs_are_equal(const struct ceduo_estimate *difference)
{
    return isnan(difference->se) && difference->hi > 0;
}

/* Quantiles of type 1 of Hyndman and Fan 1996: quantile p of n values has the smallest rank k (1…n) with k >= pn. So each
 * quantile is one of the values. NaN if n is 0. */
size_t ceduo_quantile_rank(size_t n, double p);
double ceduo_quantile(const double *sorted, size_t n, double p);

/* Set the ranks of the 95 % interval of the true quantile (binomial distribution); 0 or n + 1 if no value bounds it. */
void ceduo_quantile_interval(size_t n, double p, size_t *lo, size_t *hi);

/* Compute a distribution from all values, which are reordered, and their moments. */
struct ceduo_distribution ceduo_distribution_exact(double *values, size_t n, const struct ceduo_moments *m);

/* Return a distribution without values: all NaN. */
struct ceduo_distribution ceduo_distribution_none(void);

/* One percentile of a distribution. */
#define PERCENTILES 3
struct percentile {
    double p, *value, *lo, *hi;
};
struct percentile ceduo_percentile_compute(struct ceduo_distribution *distribution, size_t k);

#endif
