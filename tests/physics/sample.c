/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sample.h"

#include "bench/measure.h"
#include "expect.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define FALSE_ALARM 1e-4 /* probability that a correct program fails a test of fit; four standard errors are 6e-5 */

void spread_add(struct spread *s, double value)
{
    if (!(s->n > 0))
        s->origin = value;
    double d = value - s->origin, power = 1;
    for (int k = 1; k < 5; k++)
        s->sum[k] += power *= d;
    s->n++;
}

double spread_mean(const struct spread *s)
{
    return s->origin + s->sum[1] / s->n;
}

double spread_variance(const struct spread *s)
{
    double m = s->sum[1] / s->n;
    return s->sum[2] / s->n - m * m;
}

double spread_se(const struct spread *s)
{
    return sqrt(spread_variance(s) / s->n);
}

double spread_variance_se(const struct spread *s)
{
    double m = s->sum[1] / s->n, m2 = s->sum[2] / s->n, v = spread_variance(s);
    double fourth = s->sum[4] / s->n - 4 * m * s->sum[3] / s->n + 6 * m * m * m2 - 3 * m * m * m * m;
    return sqrt((fourth - v * v) / s->n);
}

const char *named(const char *format, ...)
{
    static char texts[8][100];
    static unsigned turn;
    char *text = texts[turn++ % LENGTH(texts)];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof texts[0], format, values);
    va_end(values);
    return text;
}

void expect_close(const char *label, double value, double se, double expected, double expected_se)
{
    double total_se = hypot(se, expected_se);
    print_message("# %s: %.6g ± %.2g, expected %.6g (%+.1f se)\n", label, value, se, expected, (value - expected) / total_se);
    if (!(fabs(value - expected) <= 4 * total_se))
        fail_msg("%s: %.8g ± %.3g is not %.8g", label, value, se, expected);
}

void expect_mean(const char *label, const struct spread *s, double expected)
{
    expect_close(label, spread_mean(s), spread_se(s), expected, 0);
}

void expect_variance(const char *label, const struct spread *s, double expected)
{
    expect_close(label, spread_variance(s), spread_variance_se(s), expected, 0);
}

void expect_share(const char *label, uint64_t hits, uint64_t n, double expected)
{
    expect_close(label, (double)hits / (double)n, sqrt(expected * (1 - expected) / (double)n), expected, 0);
}

void expect_exact(const char *label, double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%s: %.17g is not %.17g", label, value, expected);
}

void expect_chi_square(const char *label, double chi2, double freedom)
{
    double p = gsl_cdf_chisq_Q(chi2, freedom);
    print_message("# %s: chi-square %.1f on %.0f, p = %.3g\n", label, chi2, freedom, p);
    if (!(p > FALSE_ALARM))
        fail_msg("%s: chi-square %.1f on %.0f, p = %.2g", label, chi2, freedom, p);
}

void expect_ks(const char *label, double d, double size)
{
    double max = sqrt(-log(FALSE_ALARM / 2) / 2);
    print_message("# %s: D = %.2e, D sqrt(n) = %.3f of at most %.3f\n", label, d, d * sqrt(size), max);
    if (!(d * sqrt(size) < max))
        fail_msg("%s: D = %.3g of %.0f", label, d, size);
}

void expect_law(const char *label, double *values, size_t n, double (*cdf)(double x, const void *context), const void *context)
{
    qsort(values, n, sizeof *values, by_value);
    double d = 0;
    for (size_t i = 0; i < n; i++) {
        double f = cdf(values[i], context);
        d = fmax(d, fmax(f - (double)i / (double)n, (double)(i + 1) / (double)n - f));
    }
    expect_ks(label, d, (double)n);
}

void sample_add(struct sample *s, double value)
{
    if (s->n == s->capacity) {
        s->capacity = s->capacity > 0 ? 2 * s->capacity : 1024;
        s->values = realloc(s->values, s->capacity * sizeof *s->values);
        assert_non_null(s->values);
    }
    s->values[s->n++] = value;
}

void sample_clear(struct sample *s)
{
    free(s->values);
    *s = (struct sample){0};
}

static double sample_worth(const struct sample *s)
{
    return s->squares > 0 ? (double)s->n * (double)s->n / s->squares : (double)s->n;
}

void expect_same_law(const char *label, struct sample *a, struct sample *b)
{
    qsort(a->values, a->n, sizeof *a->values, by_value);
    qsort(b->values, b->n, sizeof *b->values, by_value);
    double d = 0;
    for (size_t i = 0, j = 0; i < a->n && j < b->n;) {
        double v = fmin(a->values[i], b->values[j]);
        while (i < a->n && a->values[i] <= v)
            i++;
        while (j < b->n && b->values[j] <= v)
            j++;
        d = fmax(d, fabs((double)i / (double)a->n - (double)j / (double)b->n));
    }
    double p = sample_worth(a), q = sample_worth(b);
    expect_ks(label, d, p * q / (p + q));
}

void expect_poisson(const char *label, const uint64_t count[COUNTS_MAX], double mean)
{
    double n = 0, chi2 = 0, observed = 0, expected = 0, remaining = 1;
    int cells = 0;
    for (int k = 0; k < COUNTS_MAX; k++)
        n += (double)count[k];
    for (unsigned k = 0; k < COUNTS_MAX; k++) {
        double p = gsl_ran_poisson_pdf(k, mean);
        observed += (double)count[k];
        expected += n * p;
        remaining -= p;
        bool last = n * remaining < 10; /* the last cell includes the tail */
        if (last)
            for (expected += n * remaining; ++k < COUNTS_MAX;)
                observed += (double)count[k];
        if (expected < 10)
            continue;
        chi2 += (observed - expected) * (observed - expected) / expected;
        cells++;
        observed = expected = 0;
    }
    expect_chi_square(label, chi2, cells - 1);
}
