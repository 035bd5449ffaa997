/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of few values, without values, and of values outside all bins; an aborted search for a value. */
#include "core/runs/statistics.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "bench/measure.h"
#include "ceduo/ceduo.h"

/* ---- few values ---- */

static void expect_near(double found, double wanted, double relative)
{
    if (isnan(wanted))
        assert_true(isnan(found));
    else
        EXPECT_NEAR(found, wanted, relative * wanted);
}

/* Values of all sizes, some 0: equal to sorted values. */
TEST(distributions_of_few_values)
{
    uint64_t bits = 1;
    for (size_t n = 0; n <= 200; n++) {
        double values[200], sorted[200];
        struct ceduo_moments m = {0};
        for (size_t i = 0; i < n; i++) {
            bits = bits * 6364136223846793005u + 1442695040888963407u;
            values[i] = bits >> 62 == 0 ? 0 : ldexp(1 + (double)(bits >> 12 & 1023) / 1024, (int)(bits >> 40 & 31) - 16);
            sorted[i] = values[i];
            ceduo_moments_add(&m, values[i]);
        }
        qsort(sorted, n, sizeof *sorted, by_value);
        struct ceduo_distribution exact = ceduo_distribution_exact(values, n, &m);
        size_t lo = 0, hi = 0;
        if (n > 0)
            ceduo_quantile_interval(n, .95, &lo, &hi);
        const double wanted[] = {n > 0 ? sorted[ceduo_quantile_rank(n, .5) - 1] : NAN,
                                 n > 0 ? sorted[ceduo_quantile_rank(n, .95) - 1] : NAN,
                                 n > 0 ? sorted[ceduo_quantile_rank(n, .99) - 1] : NAN, lo > 0 ? sorted[lo - 1] : NAN,
                                 n > 0 && hi <= n ? sorted[hi - 1] : NAN};
        const double of_exact[] = {exact.p50, exact.p95, exact.p99, exact.p95_lo, exact.p95_hi};
        for (size_t i = 0; i < 5; i++)
            expect_near(of_exact[i], wanted[i], 0);
        expect_near(exact.max, n > 0 ? sorted[n - 1] : NAN, 0);
        double squares = 0;
        for (size_t i = 0; i < n; i++)
            squares += (sorted[i] - m.mean) * (sorted[i] - m.mean);
        expect_near(exact.sd, n > 1 ? sqrt(squares / (double)(n - 1)) : NAN, 1e-12);
        expect_near(exact.se, n > 1 ? exact.sd / sqrt((double)n) : NAN, 1e-12);
    }
}

/* ---- aborted search ---- */

static atomic_bool cancel;
static unsigned looked;

static enum ceduo_status give_up(void *context, double value, double *goal)
{
    const unsigned *when = context;
    *goal = 1 / value;
    atomic_store(&cancel, ++looked >= *when);
    return CEDUO_OK;
}

static enum ceduo_status refuse(void *context, double value, double *goal)
{
    const unsigned *when = context;
    *goal = 1 / value;
    return ++looked >= *when ? CEDUO_BAD_SLOPE : CEDUO_OK;
}

/* At any stage: no further value is evaluated, and none is found. */
TEST(a_search_ends_at_once)
{
    for (int kind = 0; kind < 4; kind++) { /* if nothing passes, all values are tried */
        struct ceduo_found found;
        double target = kind < 2 ? .3 : -1;
        struct ceduo_find_def def = {
            .size = sizeof(struct ceduo_find_def), .lo = 1, .hi = 1000, .whole = kind % 2, .target = target, .cancel = &cancel};
        unsigned when = UINT32_MAX;
        def.context = &when;
        def.goal = give_up;
        looked = 0;
        atomic_store(&cancel, false);
        assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
        unsigned all = looked;
        EXPECT(found.found, ==, (kind < 2));
        EXPECT(all, >, 5);
        for (when = 1; when < all; when++)
            for (int k = 0; k < 2; k++) {
                def.goal = k == 0 ? give_up : refuse;
                looked = 0;
                atomic_store(&cancel, false);
                assert_int_equal(ceduo_find(&def, &found), k == 0 ? CEDUO_CANCELLED : CEDUO_BAD_SLOPE);
                assert_int_equal(looked, when);
                assert_false(found.found);
            }
    }
}

/* Unbounded goals, and one that is met exactly, by bisection. */
static enum ceduo_status decrease_by_steps(void *context, double value, double *goal)
{
    const double *levels = context;
    *goal = value < 3 ? levels[0] : levels[1];
    return CEDUO_OK;
}

TEST(goals_without_end)
{
    const double levels[][2] = {{INFINITY, -INFINITY}, {1, -INFINITY}, {INFINITY, 0}, {1, .5}, {NAN, 0}};
    for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++) {
        struct ceduo_found found;
        double pair[2] = {levels[i][0], levels[i][1]};
        const struct ceduo_find_def def = {
            .size = sizeof(struct ceduo_find_def), .lo = 1, .hi = 9, .target = .5, .goal = decrease_by_steps, .context = pair};
        assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
        assert_true(found.found);
        EXPECT(found.value, >=, 3);
        EXPECT(found.value, <, 3 + 1e-7);
        EXPECT(found.goal_at_value, ==, levels[i][1]);
        EXPECT(found.side, ==, CEDUO_SIDE_SMALLEST);
    }
}

static enum ceduo_status decrease(void *context, double value, double *goal)
{
    const double *top = context;
    *goal = *top - value;
    return CEDUO_OK;
}

/* A tolerance met by the first step; and a range so large that bisection does not end: aborted. */
TEST(few_values_and_too_many)
{
    struct ceduo_found found;
    double top = 10;
    struct ceduo_find_def def = {.size = sizeof(struct ceduo_find_def),
                                 .lo = 1,
                                 .hi = 9,
                                 .target = 5.5,
                                 .goal = decrease,
                                 .context = &top,
                                 .tolerance = .5};
    assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
    assert_true(found.found);
    EXPECT(found.value, >=, 4.5);
    EXPECT(found.value, <, 4.5 + 4);
    EXPECT(found.side, ==, CEDUO_SIDE_SMALLEST);
    assert_int_equal(found.evaluations, 3);
    def = (struct ceduo_find_def){.size = sizeof(struct ceduo_find_def),
                                  .lo = 0,
                                  .hi = 1e300,
                                  .whole = true,
                                  .target = 5.5,
                                  .goal = decrease,
                                  .context = &top};
    assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
    assert_true(found.found);
    EXPECT(found.value, >=, 5);
    EXPECT(found.goal_at_value, <=, 5.5);
    EXPECT(found.evaluations, >, 55);
    EXPECT(found.evaluations, <, 200);
}
