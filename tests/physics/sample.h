/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples and their expected statistics: means and variances with their errors, Kolmogorov-Smirnov distances, Poisson counts.
 * Every figure is printed as a TAP comment. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include <stddef.h>
#include <stdint.h>

/* Sums of powers of values minus the first value, so that little cancels. */
struct spread {
    double origin, n, sum[5];
};

void spread_add(struct spread *s, double value);
double spread_mean(const struct spread *s);
double spread_variance(const struct spread *s);
double spread_se(const struct spread *s);
/* Standard error of the variance, from the fourth moment. */
double spread_variance_se(const struct spread *s);

/* Format like printf(); the text is valid for seven more calls. */
const char *named(const char *format, ...) __attribute__((format(printf, 1, 2)));

void expect_close(const char *label, double value, double se, double expected, double expected_se);
void expect_mean(const char *label, const struct spread *s, double expected);
void expect_variance(const char *label, const struct spread *s, double expected);
void expect_share(const char *label, uint64_t hits, uint64_t n, double expected);
/* Expect two numbers to be equal within rounding. */
void expect_exact(const char *label, double value, double expected, double relative);
void expect_chi_square(const char *label, double chi2, double freedom);
/* Compare a Kolmogorov-Smirnov statistic, D times the square root of the sample's size, with its limiting law. */
void expect_ks(const char *label, double d, double size);
/* Compare a sample with a law; sorts it. */
void expect_law(const char *label, double *values, size_t n, double (*cdf)(double x, const void *context), const void *context);

/* A sample with clumps of equal values has the effective size (sum of sizes)^2 / sum of their squares (Kish 1965). */
struct sample {
    double *values;
    size_t n, capacity;
    double squares; /* sum of squared clump sizes; 0: no clumps */
};

void sample_add(struct sample *s, double value);
void sample_clear(struct sample *s);
/* Compare the laws of two samples; sorts them. */
void expect_same_law(const char *label, struct sample *a, struct sample *b);

#define COUNTS_MAX 256
/* Compare counts with a Poisson law; rare counts are merged. */
void expect_poisson(const char *label, const uint64_t count[COUNTS_MAX], double mean);

#endif
