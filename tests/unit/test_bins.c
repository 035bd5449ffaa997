/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures that are read from counts in bins: the middle of a bin, never more than the largest value, and of a quantile
 * the value of its rank. */
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>

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
