/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples and what is expected of them: means and variances beside their errors, laws beside those of Kolmogorov and
 * Smirnov, counts beside that of Poisson. Every figure is written as a comment of the TAP. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include <stddef.h>
#include <stdint.h>

/* Sums of powers of values less the first one, so that little cancels. */
struct spread {
    double origin, n, sum[5];
};

void spread_add(struct spread *s, double value);
double spread_mean(const struct spread *s);
double spread_variance(const struct spread *s);
double spread_se(const struct spread *s);
/* Of the variance, from the fourth moment. */
double spread_variance_se(const struct spread *s);

/* A text as printf() makes it, which stays for the next seven of them. */
const char *named(const char *format, ...) __attribute__((format(printf, 1, 2)));

void expect_close(const char *what, double value, double se, double expected, double expected_se);
void expect_mean(const char *what, const struct spread *s, double expected);
void expect_variance(const char *what, const struct spread *s, double expected);
void expect_share(const char *what, uint64_t hits, uint64_t n, double expected);
/* Whether two numbers differ by no more than rounding. */
void expect_exact(const char *what, double value, double expected, double relative);
void expect_chi_square(const char *what, double chi2, double freedom);
/* Of a statistic of Kolmogorov and Smirnov, D times the root of the sample's size: its limiting law. */
void expect_ks(const char *what, double d, double size);
/* One sample, which is sorted, against a law. */
void expect_law(const char *what, double *values, size_t n, double (*cdf)(double x, const void *of), const void *of);

/* Values that come in clumps of a kind are worth fewer: (sum of sizes)^2 / sum of their squares (Kish 1965). */
struct sample {
    double *values;
    size_t n, room;
    double squares; /* of the sizes of clumps; 0: all for themselves */
};

void sample_add(struct sample *s, double value);
void sample_clear(struct sample *s);
/* Two samples, which are sorted, of one law? */
void expect_same_law(const char *what, struct sample *a, struct sample *b);

#define COUNTS_MAX 256
/* Counts against the Poisson law of a mean; rare ones are taken together. */
void expect_poisson(const char *what, const uint64_t count[COUNTS_MAX], double mean);

#endif
