/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures that are read from counts in bins: the middle of a bin, never more than the largest value, and of a quantile
 * the value of its rank. */
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>

#include "core/runs/histogram.h"

/* ---- histograms of long runs: 16384 bins an octave ---- */

/* The middle of the bin of a power of two, one of itself. */
#define MIDDLE (1 + 1. / 32768)

/* 1 and 3: the second lies at the edge of bin 8192 of the octave from 2 on. */
TEST(a_histogram_reads_the_middle_of_a_bin)
{
    struct histogram h = {0};
    assert_true(ceduo_histogram_add(&h, 1));
    assert_true(ceduo_histogram_add(&h, 3));
    EXPECT(ceduo_histogram_value(&h, 1), ==, MIDDLE);
    EXPECT(ceduo_histogram_value(&h, 2), ==, 2 * (1.5 + 1. / 32768));
    ceduo_histogram_clear(&h);
}

/* What lies below the smallest octave counts as 0. */
TEST(a_histogram_has_a_beginning)
{
    struct histogram h = {0};
    assert_true(ceduo_histogram_add(&h, nextafter(0x1p-64, 0)));
    EXPECT(h.zeros, ==, 1);
    assert_true(ceduo_histogram_add(&h, 0x1p-64));
    EXPECT(h.zeros, ==, 1);
    EXPECT(h.n, ==, 2);
    EXPECT(ceduo_histogram_value(&h, 1), ==, 0);
    EXPECT(ceduo_histogram_value(&h, 2), ==, 0x1p-64 * MIDDLE);
    ceduo_histogram_clear(&h);
}

static void expect_cut(const struct ceduo_distribution *d, double p50, double p95, double p99, double lo, double hi)
{
    EXPECT(d->p50, ==, p50);
    EXPECT(d->p95, ==, p95);
    EXPECT(d->p99, ==, p99);
    assert_true(isnan(lo) ? isnan(d->p95_lo) : d->p95_lo == lo);
    assert_true(isnan(hi) ? isnan(d->p95_hi) : d->p95_hi == hi);
}

/* Powers of two: of 2 values the first is the median and the second the rest; of 100 it is the 50th, 95th and 99th, the
 * 95th between the 90th and the 100th (as in tables of the binomial law). */
TEST(a_distribution_of_bins_has_no_more_than_the_largest)
{
    static const size_t sizes[] = {1, 2, 100};
    for (int k = 0; k < 3; k++) {
        struct histogram h = {0};
        struct ceduo_moments m = {0};
        for (size_t i = 0; i < sizes[k]; i++) {
            double value = ldexp(1, (int)i - 50);
            ceduo_moments_add(&m, value);
            assert_true(ceduo_histogram_add(&h, value));
        }
        struct ceduo_distribution d = ceduo_distribution_binned(&h, &m);
        double first = ldexp(1, -50);
        EXPECT(d.max, ==, ldexp(first, (int)sizes[k] - 1));
        if (sizes[k] == 1)
            expect_cut(&d, first, first, first, NAN, NAN);
        else if (sizes[k] == 2)
            expect_cut(&d, first * MIDDLE, 2 * first, 2 * first, first * MIDDLE, NAN);
        else
            expect_cut(&d, ldexp(first, 49) * MIDDLE, ldexp(first, 94) * MIDDLE, ldexp(first, 98) * MIDDLE,
                       ldexp(first, 89) * MIDDLE, ldexp(first, 99));
        ceduo_histogram_clear(&h);
    }
}
