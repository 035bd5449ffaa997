/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures that are read from counts in bins: the middle of a bin, never more than the largest value, and of a quantile
 * the value of its rank. */
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>

#include "core/runs/histogram.h"
#include "core/walk/envelope.h"

/* ---- cells along the slope: 32 bins an octave ---- */

/* What the second of three cells says of rocks whose speed is `values` and energy twice that; one more ends before it, and one
 * begins behind it. */
static struct ceduo_envelope cell_of(const double *values, size_t n)
{
    struct ceduo_envelope e;
    LOCAL_BY(ceduo_envelopes_release) struct envelopes all;
    LOCAL_BYTES struct envelope_cell *cells = calloc(3, sizeof *cells);
    assert_non_null(cells);
    assert_true(ceduo_envelopes_init(&all, 3, 2));
    for (size_t i = 0; i < n + 2; i++) {
        size_t from = i == n ? 0 : i == n + 1 ? 2 : 1;
        double value = i < n ? values[i] : 7;
        struct envelope_row row = ceduo_envelopes_begin(&all, i % 2, from);
        envelope_note(&row, from, (double[]){value, value / 2, 2 * value});
        ceduo_envelopes_end(&all, i % 2, from + 1);
    }
    ceduo_envelopes_merge(cells, &all);
    ceduo_envelope_read(&cells[1], &e);
    EXPECT(e.passed, ==, n);
    return e;
}

/* Of speeds p5, p50, p95 and the largest. */
static struct ceduo_envelope expect_speeds(const double *values, size_t n, double p5, double p50, double p95, double max)
{
    struct ceduo_envelope e = cell_of(values, n);
    EXPECT_IS(e.speed, (p5, p5), (p50, p50), (p95, p95), (max, max));
    return e;
}

/* 1.5 begins the bin from 48/32 to 49/32, whose middle is 97/64; that of a power of two is 65/64 of it. The middle of the last
 * bin lies above all that is in it. */
TEST(a_cell_reads_the_middle_of_a_bin_and_no_more_than_the_largest)
{
    const double values[] = {1.5, 2};
    struct ceduo_envelope e = expect_speeds(values, 2, 97. / 64, 97. / 64, 2, 2);
    EXPECT_IS(e.height, (p50, 97. / 128), (p95, 1));
    EXPECT_IS(e.energy, (p50, 2 * 97. / 64), (p95, 4));
    EXPECT(e.mean_energy, ==, (2 * 97. / 64 + 4 * 65. / 64) / 2);
    expect_speeds(values, 1, 1.5, 1.5, 1.5, 1.5);
}

/* Of 20 rocks 5, 50 and 95 % are the 1st, the 10th and the 19th; of 21 the 2nd, the 11th and the 20th. */
TEST(a_cell_reads_the_rock_of_the_rank)
{
    double values[21];
    for (int i = 0; i < 21; i++)
        values[i] = ldexp(1, i);
    expect_speeds(values, 20, 65. / 64, ldexp(65. / 64, 9), ldexp(65. / 64, 18), 0x1p19);
    expect_speeds(values, 21, 65. / 32, ldexp(65. / 64, 10), ldexp(65. / 64, 19), 0x1p20);
}

/* Speeds have 40 octaves from 2^-10 on: what is beyond them is in the last bin, from 2^29 63/32 to 2^30. What lies below is
 * read as 0, but for the largest; likewise where nothing is brought. */
TEST(a_cell_has_a_beginning_and_an_end)
{
    const double values[] = {0x1p40, 0x1p-11, 0}, last = 0x1p29 * (127. / 64);
    expect_speeds(values, 1, last, last, last, 0x1p40);
    expect_speeds(values + 1, 1, 0, 0, 0, 0x1p-11);
    EXPECT(expect_speeds(values + 2, 1, 0, 0, 0, 0).energy.max, ==, 0);
}

/* 1000 rocks of 1, 2, … 1000 m/s: more than wait at a time. The 50th, 500th and 950th lie in the bins of 50 to 51, 496 to 504
 * and 944 to 960. */
TEST(a_cell_counts_all_rocks)
{
    double values[1000];
    for (int i = 0; i < 1000; i++)
        values[i] = i + 1;
    EXPECT(expect_speeds(values, 1000, 50.5, 500, 952, 1000).height.max, ==, 500);
}

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
