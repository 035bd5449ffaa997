/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STATISTICS_H
#define CEDUO_STATISTICS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CEDUO_Z95 1.959963984540054 /* the normal law's 97.5 % quantile */

/* Count, mean and sum of squares about the mean, added one by one (Welford 1962) and merged (Chan et al. 1979). */
struct ceduo_moments {
    uint64_t n;
    double mean, m2, max;
};

static inline void ceduo_moments_add(struct ceduo_moments *m, double value)
{
    m->n++;
    double d = value - m->mean;
    m->mean += d / (double)m->n;
    m->m2 += d * (value - m->mean);
    m->max = m->n == 1 || value > m->max ? value : m->max;
}
void ceduo_moments_merge(struct ceduo_moments *into, const struct ceduo_moments *from);

/* Standard deviation and standard error of the mean; NaN below two values. */
double ceduo_moments_sd(const struct ceduo_moments *m);
double ceduo_moments_se(const struct ceduo_moments *m);

/* A value with its sampling error. */
struct ceduo_estimate {
    double mean;   /* NaN: not known */
    double se;     /* standard error; NaN: not known */
    double lo, hi; /* 95 % interval; NaN: not known */
};
#define CEDUO_NO_ESTIMATE ((struct ceduo_estimate){NAN, NAN, NAN, NAN})

/* Half the width of the 95 % interval of a mean of n values, by Student's law with n - 1 degrees of freedom, from its standard
 * error in any unit; NaN for n < CEDUO_INTERVAL_MIN_N, of which it would say too little. */
#define CEDUO_INTERVAL_MIN_N 10
double ceduo_half_width(double se, uint64_t n);

/* The standard error of a share of n. */
double ceduo_share_se(double share, double n);

/* The same of a share of n rocks, by the normal law; of none or all of them what Wilson's interval leaves, as their standard
 * error is 0. Also of the difference of two such shares that are alike. */
double ceduo_half_width_of_share(double share, double se, uint64_t n);

/* Return the estimate of a share of n rocks with its interval after Wilson (1927); se is NaN. n need not be whole. The upper end is
 * that of `max`, which counts in the rocks whose end is unknown. The interval is [0, 1] for n = 0. */
struct ceduo_estimate ceduo_wilson(double share, double max, double n);

/* Return the estimate of a mean with its interval by the normal law. */
struct ceduo_estimate ceduo_estimate_by_se(double mean, double se);

/* Return the estimate of a mean difference between pairs of rocks, with the spread of the pairs in `m`. If no pair differs, se is
 * NaN and the interval goes to the share of pairs that may differ all the same (Wilson). */
struct ceduo_estimate ceduo_estimate_of_pairs(double mean, const struct ceduo_moments *m, uint64_t rocks);

/* True if no pair of such an estimate differs. */
static inline bool ceduo_pairs_are_equal(const struct ceduo_estimate *difference)
{
    return isnan(difference->se) && difference->hi > 0;
}

/* The one rule for quantiles, type 1 of Hyndman and Fan 1996: quantile p of n values is that of rank k (1…n), the smallest with
 * k >= pn. So each is a value that was found. NaN of none. */
size_t ceduo_quantile_rank(size_t n, double p);
double ceduo_quantile(const double *sorted, size_t n, double p);

/* The ranks between which the true quantile lies with 95 % (binomial law); 0 or n + 1 where no value bounds it. */
void ceduo_quantile_interval(size_t n, double p, size_t *lo, size_t *hi);

/* A distribution as it is reported; NaN where a figure does not exist. */
struct ceduo_distribution {
    double mean, se, sd, p50, p95, p95_lo, p95_hi, p99, max;
    double p50_lo, p50_hi, p99_lo, p99_hi;
};

/* From exact values, which are reordered, and their moments. */
struct ceduo_distribution ceduo_distribution_exact(double *values, size_t n, const struct ceduo_moments *m);

/* A distribution of which nothing is known: all NaN. */
struct ceduo_distribution ceduo_distribution_none(void);

#endif
