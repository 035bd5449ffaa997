/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Control variates: their mean is 0 whatever the rock meets, the regression is that of a closed form, adjusted figures hold
 * what is true as often as they say, fit together and are the same however they are computed. */
#include "expect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/variates.h"
#include "core/walk.h"
#include "paper_site.h"

static struct paper_site site, half;

static void init(void)
{
    paper_site_init(&site);
    paper_site_init(&half);
    site.control.accepted = 50e3;
    for (int i = 0; i < 2; i++) {
        half.plots[i].stand.stools_per_ha /= 2;
        half.plots[i].shoots.per_ha /= 2;
        half.plots[i].trees.per_ha /= 2;
        half.belts[i].stand = half.plots[i].stand;
    }
}

/* ---- the regression ---- */

/* Numbers in (-1/2, 1/2) of mean next to 0. */
static double spread_number(unsigned i, unsigned k)
{
    double x = (i + 1) * sqrt(2.0 + 3 * k);
    return x - floor(x) - 0.5;
}

enum { EXPLAINED = 1000 };

/* Of which y tells of the first and the fifth; the last but one tells nothing new, and the last is 0. */
static struct variate_row explained_row(unsigned i)
{
    struct variate_row row = {.x = {[VARIATES] = 1}};
    for (unsigned k = 0; k + 2 < VARIATES; k++)
        row.x[k] = spread_number(i, k) * pow(10, k);
    row.x[VARIATES - 2] = 2 * row.x[0] - row.x[1];
    return row;
}

static void what_variates_explain_is_taken_out(void **state)
{
    (void)state;
    static struct variate_row rows[EXPLAINED];
    static _Alignas(64) double brought[EXPLAINED][VARIED_ROW];
    double sum = 0, square = 0;
    for (unsigned i = 0; i < EXPLAINED; i++) {
        rows[i] = explained_row(i);
        double y = brought[i][VARIED_SPEED] = 7 + 3 * rows[i].x[0] - 2e-3 * rows[i].x[4];
        sum += y;
        square += y * y;
    }
    const struct variates_kernel *kernel = ceduo_variates_kernel(CEDUO_KERNEL_BEST);
    struct variate_sums x = {{{{0}}}};
    struct varied_sums s = {.ended = {{0}}};
    kernel->add(&x, rows, EXPLAINED);
    kernel->add_with(&s, brought[0], rows, EXPLAINED);
    struct variate_fit fit;
    assert_true(ceduo_variates_fit(&x, EXPLAINED, &fit));
    EXPECT(fit.used, ==, VARIATES - 2);
    struct varied_sum y = ceduo_variates_sum(&fit, &s, VARIED_SPEED, sum);
    EXPECT_NEAR(ceduo_varied_mean(&fit, &y), 7, 1e-10);
    EXPECT_NEAR(ceduo_varied_variance(&fit, &y, square - sum * sum / EXPLAINED), 0, 1e-12);
    double slopes[VARIATES];
    ceduo_varied_slopes(&fit, &y, slopes);
    for (unsigned k = 0; k < VARIATES; k++)
        EXPECT_NEAR(slopes[k] * pow(10, k), k == 0 ? 3 : k == 4 ? -20 : 0, 1e-6);
    struct varied_sum none = ceduo_varied_less(y, 1, y);
    EXPECT(ceduo_varied_mean(&fit, &none), ==, 0);
}

enum { SUMMED = 301, SUMMED_FIRST = 100 };

/* What sums are of. */
static struct {
    struct variate_row rows[SUMMED];
    _Alignas(64) double brought[SUMMED][VARIED_ROW];
    double x[VARIATES], xx[VARIATES][VARIATES], xy[VARIED][VARIATES];
} summed;

/* Rock by rock, product by product; each ends in every way. */
static void sum_one_by_one(void)
{
    memset(&summed, 0, sizeof summed);
    for (unsigned i = 0; i < SUMMED; i++) {
        const double *x = summed.rows[i].x;
        summed.rows[i] = explained_row(i);
        for (unsigned k = 0; k < VARIED_ENDED; k++)
            summed.brought[i][k] = spread_number(k, i);
        for (unsigned j = 0; j < VARIATES; j++) {
            summed.x[j] += x[j];
            for (unsigned k = 0; k <= j; k++)
                summed.xx[j][k] += x[j] * x[k];
            for (unsigned k = 0; k < VARIED; k++)
                summed.xy[k][j] += k < VARIED_ENDED ? summed.brought[i][k] * x[j] : x[j];
        }
    }
}

/* No more than `off` from those, as a part of what they can be. */
static void expect_summed(struct variate_sums *s, const struct varied_sums *with, double off)
{
    for (unsigned j = 0; j < VARIATES; j++) {
        double most = off * sqrt(summed.xx[j][j] * SUMMED);
        EXPECT_NEAR(*variate_sum(s, j), summed.x[j], most);
        for (unsigned k = 0; k <= j; k++)
            EXPECT_NEAR(*variate_product(s, j, k), summed.xx[j][k], off * sqrt(summed.xx[j][j] * summed.xx[k][k]));
        for (unsigned k = 0; k < VARIED_ENDED; k++)
            EXPECT_NEAR(with->with[j][k], summed.xy[k][j], most);
        for (unsigned e = 0; e < CEDUO_ENDS; e++)
            EXPECT_NEAR(with->ended[e][j], summed.xy[VARIED_ENDED + e][j], most);
    }
}

/* In two steps they have the same bits, by each kind of registers; merged, their last ones may differ. */
static void sums_are_those_of_single_rocks(void **state)
{
    (void)state;
    const enum ceduo_kernel kernels[] = {CEDUO_KERNEL_SCALAR, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512, CEDUO_KERNEL_BEST};
    const size_t from[] = {0, SUMMED_FIRST, SUMMED};
    sum_one_by_one();
    for (int k = 0; k < 4; k++) {
        const struct variates_kernel *by = ceduo_variates_kernel(kernels[k]);
        struct variate_sums s[2] = {{{{{0}}}}};
        struct varied_sums with[2] = {{.ended = {{0}}}};
        bool merges = k == 3;
        for (int step = 0; step < 2; step++) {
            const struct variate_row *rows = &summed.rows[from[step]];
            size_t n = from[step + 1] - from[step];
            int to = merges ? step : 0;
            by->add(&s[to], rows, n);
            by->add_with(&with[to], summed.brought[from[step]], rows, n);
            for (int e = 0; e < CEDUO_ENDS; e++)
                for (size_t i = 0; i < n; i++)
                    ceduo_variates_add_ended(&with[to], (enum ceduo_end)e, &rows[i]);
        }
        ceduo_variates_merge(&s[0], &s[1]);
        ceduo_varied_merge(&with[0], &with[1]);
        expect_summed(&s[0], &with[0], merges ? 1e-13 : 0);
    }
}

static void nothing_that_varies_is_no_regression(void **state)
{
    (void)state;
    struct variate_sums s = {{{{0}}}};
    struct variate_fit fit;
    assert_false(ceduo_variates_fit(&s, 1000, &fit));
    assert_false(ceduo_variates_fit(&s, 0, &fit));
    *variate_product(&s, 0, 0) = INFINITY;
    assert_false(ceduo_variates_fit(&s, 1000, &fit));
    *variate_product(&s, 0, 0) = NAN;
    assert_false(ceduo_variates_fit(&s, 1000, &fit));
}

/* ---- their means ---- */

static void pass(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *c)
{
    (void)mark, (void)c;
    memcpy(context, w->variates, sizeof w->variates);
}

/* Up to the control or the end; within five standard errors of 0. */
static void expect_no_mean(const char *what, const struct ceduo_option *option, uint64_t rocks)
{
    struct prepared ready;
    struct stems stems;
    double x[VARIATES], last[VARIATES];
    struct ceduo_moments m[VARIATES] = {{0}};
    assert_int_equal(ceduo_prepared_init(&ready, &site.scene, option, 0, NULL), CEDUO_OK);
    struct walker w = {.cross = pass, .context = last};
    if (option) {
        assert_true(ceduo_stems_init(&stems, &ready.wood, false, CEDUO_KERNEL_BEST));
        w.stems = &stems;
    }
    for (uint64_t r = 0; r < rocks; r++) {
        last[0] = NAN;
        assert_int_equal(ceduo_walk_release(&w, &ready, r), CEDUO_OK);
        ceduo_walk(&w, site.scene.simulation.law);
        memcpy(x, isnan(last[0]) ? w.variates : last, sizeof x);
        for (int k = 0; k < VARIATES; k++)
            ceduo_moments_add(&m[k], x[k]);
    }
    for (int k = 0; k < VARIATES; k++)
        if (!(fabs(m[k].mean) <= 5 * ceduo_moments_se(&m[k]) && m[k].m2 > 0))
            fail_msg("%s: variate %d has the mean %g, its error is %g", what, k, m[k].mean, ceduo_moments_se(&m[k]));
    if (option)
        ceduo_stems_release(&stems);
    ceduo_prepared_release(&ready);
}

static void variates_have_no_mean(void **state)
{
    (void)state;
    for (int law = 0; law < CEDUO_LAW_COUNT; law++)
        for (int facets = 0; facets < 2; facets++)
            for (int wood = 0; wood < 2; wood++) {
                char what[80];
                init();
                snprintf(what, sizeof what, "law %d, facets %d, wood %d", law, facets, wood);
                site.scene.simulation.law = (enum ceduo_law)law;
                site.scene.slope.facets = facets ? CEDUO_BOTH : CEDUO_AGAINST;
                if (law == CEDUO_LAW_ARM)
                    for (int i = 0; i < PAPER_SEGMENTS; i++)
                        site.segments[i].mu = 0.3;
                site.scene.release.vx.spread = wood ? 0.1 : 0;
                site.scene.rock.diameter.spread = wood ? 0.05 : 0;
                expect_no_mean(what, wood ? &site.option : NULL, 2500);
            }
}

/* ---- figures ---- */

static struct ceduo_run *fly(struct paper_site *from, const struct ceduo_option *option, uint64_t rocks, bool plain)
{
    struct ceduo_run_def def = ceduo_run_def_default(&from->scene);
    struct ceduo_run *run;
    def.option = option;
    def.rocks_most = rocks;
    def.plain = plain;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    return run;
}

static struct ceduo_arrivals read(const struct ceduo_run *run)
{
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
    return a;
}

static struct ceduo_arrivals figures(const struct ceduo_option *option, uint64_t rocks, bool plain)
{
    struct ceduo_run *run = fly(&site, option, rocks, plain);
    struct ceduo_arrivals a = read(run);
    ceduo_run_free(run);
    return a;
}

/* Over many seeds: how often an interval holds what is true, how far the mean of the figures is off, in its errors. */
struct held {
    double truth, count;
    struct ceduo_moments found;
};

static void hold(struct held *h, double value, double lo, double hi)
{
    h->count += lo <= h->truth && h->truth <= hi;
    ceduo_moments_add(&h->found, value);
}

static void expect_held(const char *what, const struct held *h, double truth_se)
{
    double n = (double)h->found.n, off = fabs(h->found.mean - h->truth), error = ceduo_moments_se(&h->found);
    if (!(off <= 4 * hypot(error, truth_se) + 0.15 * ceduo_moments_sd(&h->found)))
        fail_msg("%s: the mean of %g seeds is %g, true is %g", what, n, h->found.mean, h->truth);
    if (!(h->count >= 0.90 * n)) /* 360 of 400 by chance: once in 10^5, of an interval that holds 95 of 100 */
        fail_msg("%s: held by %g of %g intervals", what, h->count, n);
}

static void intervals_hold_what_is_true(void **state)
{
    (void)state;
    init();
    struct ceduo_arrivals is = figures(NULL, 400000, true);
    struct held reach = {.truth = is.reach_probability}, exceed = {.truth = is.exceed_probability},
                energy = {.truth = is.energy.mean}, released = {.truth = is.energy_per_released};
    for (uint64_t seed = 1; seed <= 400; seed++) {
        site.scene.simulation.seed = seed << 20;
        struct ceduo_arrivals a = figures(NULL, 600, false);
        assert_true(a.adjusted);
        hold(&reach, a.reach_probability, a.reach_lo, a.reach_hi);
        hold(&exceed, a.exceed_probability, a.exceed_lo, a.exceed_hi);
        hold(&energy, a.energy.mean, a.energy.mean - 1.96 * a.energy.se, a.energy.mean + 1.96 * a.energy.se);
        hold(&released, a.energy_per_released, a.energy_per_released - 1.96 * a.energy_per_released_se,
             a.energy_per_released + 1.96 * a.energy_per_released_se);
    }
    expect_held("reach", &reach, is.reach_se);
    expect_held("exceed", &exceed, is.exceed_se);
    expect_held("energy", &energy, is.energy.se);
    expect_held("energy per released", &released, is.energy_per_released_se);
    EXPECT(ceduo_moments_sd(&energy.found) * sqrt(600.0 * 1.5), <, is.energy.sd); /* 1.5 times fewer rocks at least */
}

static void expect_fitting(const struct ceduo_arrivals *a)
{
    double all = a->reach_probability;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        EXPECT(a->missed[e], >=, 0);
        all += a->missed[e];
    }
    EXPECT_NEAR(all, 1, 1e-12);
    EXPECT(0, <=, a->exceed_lo);
    EXPECT(a->exceed_lo, <=, a->exceed_probability);
    EXPECT(a->exceed_probability, <=, a->exceed_hi);
    EXPECT(a->exceed_probability, <=, a->reach_probability);
    EXPECT(a->reach_lo, <=, a->reach_probability);
    EXPECT(a->reach_probability, <=, a->reach_hi);
    EXPECT(a->reach_hi, <=, 1);
    EXPECT_NEAR(a->energy_per_released / (a->energy.mean * a->reach_probability), 1, 1e-12);
    EXPECT(a->energy.mean, <=, a->energy.max);
}

static void figures_fit_together(void **state)
{
    (void)state;
    init();
    const double places[] = {5, 60, 100, 135}, accepted[] = {1, 50e3, 200e3, 1e9};
    for (size_t i = 0; i < 4; i++)
        for (int wood = 0; wood < 2; wood++) {
            site.control.x = places[i];
            site.control.accepted = accepted[i];
            struct ceduo_arrivals a = figures(wood ? &site.option : NULL, 1500, false);
            struct ceduo_arrivals b = figures(wood ? &site.option : NULL, 1500, true);
            expect_fitting(&a);
            expect_fitting(&b);
            assert_false(b.adjusted);
            EXPECT(b.reach_probability, ==, (double)b.reached / 1500);
            assert_int_equal(a.reached, b.reached);
            assert_int_equal(a.exceeded, b.exceeded);
            EXPECT(a.energy.p95, ==, b.energy.p95);
            EXPECT(a.energy.sd, ==, b.energy.sd);
            if (a.exceeded == 0)
                EXPECT(a.exceed_hi, ==, b.exceed_hi);
            if (a.reached == 1500)
                EXPECT(a.reach_lo, ==, b.reach_lo);
        }
}

/* One weight a rock for all controls and ends: no more rocks arrive farther down, none is stopped before a control and not on the
 * whole profile. */
static void controls_and_ends_agree(void **state)
{
    (void)state;
    init();
    struct ceduo_control controls[] = {site.control, site.control, site.control, site.control};
    const double x[] = {100, 30, 135, 134.5};
    static const int order[] = {1, 0, 3, 2}; /* down the slope */
    for (size_t i = 0; i < 4; i++)
        controls[i].x = x[i];
    site.scene.controls = controls;
    site.scene.controls_count = 4;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        site.scene.simulation.seed = seed << 20;
        struct ceduo_run *run = fly(&site, &site.option, 1000, false);
        struct ceduo_arrivals a[4];
        struct ceduo_ends ends;
        double all = 0;
        assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK);
        for (size_t i = 0; i < 4; i++) {
            assert_int_equal(ceduo_run_arrivals(run, i, &a[i]), CEDUO_OK);
            assert_true(a[i].adjusted);
        }
        for (size_t i = 1; i < 4; i++)
            EXPECT(a[order[i]].reach_probability, <=, a[order[i - 1]].reach_probability + 1e-12);
        for (int e = 0; e < CEDUO_ENDS; e++) {
            for (size_t i = 0; i < 4; i++)
                EXPECT(a[i].missed[e], <=, ends.share[e] + 1e-12);
            all += ends.share[e];
        }
        EXPECT_NEAR(all, 1, 1e-12);
        ceduo_run_free(run);
    }
}

/* Of few rocks, or few that arrive, figures are as counted; and on a smooth slope, where nothing varies. */
static void few_rocks_are_counted(void **state)
{
    (void)state;
    init();
    for (uint64_t rocks = 1; rocks < 200; rocks += 66)
        assert_false(figures(NULL, rocks, false).adjusted);
    assert_true(figures(NULL, 200, false).adjusted);
    paper_site_smooth(&site);
    assert_false(figures(NULL, 1000, false).adjusted);
    paper_site_init(&site);
    site.scene.slope.facets = CEDUO_BOTH; /* 8 of 100 arrive */
    struct ceduo_arrivals a = figures(NULL, 1000, false);
    EXPECT(a.reached, <, 100);
    assert_false(a.adjusted);
}

static void differences_are_those_of_the_figures(void **state)
{
    (void)state;
    init();
    half.control.accepted = site.control.accepted;
    struct ceduo_difference d[2];
    for (int plain = 0; plain < 2; plain++) {
        struct ceduo_run *wood = fly(&site, &site.option, 3000, plain), *less = fly(&site, &half.option, 3000, plain);
        struct ceduo_arrivals a = read(less), b = read(wood);
        d[plain] = ceduo_run_difference(less, wood, 0);
        EXPECT_NEAR(d[plain].reach_probability.mean, a.reach_probability - b.reach_probability, 1e-12);
        EXPECT_NEAR(d[plain].exceed_probability.mean, a.exceed_probability - b.exceed_probability, 1e-12);
        EXPECT_NEAR(d[plain].energy_per_released.mean, a.energy_per_released - b.energy_per_released, 1e-6);
        struct ceduo_difference none = ceduo_run_difference(wood, wood, 0);
        EXPECT(none.reach_probability.se, ==, 0);
        EXPECT(none.energy_per_released.mean, ==, 0);
        ceduo_run_free(wood);
        ceduo_run_free(less);
    }
    EXPECT(d[0].reach_probability.se, <, d[1].reach_probability.se);
    EXPECT(d[0].exceed_probability.se, <, d[1].exceed_probability.se);
    EXPECT(d[0].energy_per_released.se, <, d[1].energy_per_released.se);
    EXPECT(fabs(d[0].reach_probability.mean - d[1].reach_probability.mean), <, 4 * d[1].reach_probability.se);
}

/* The same bits by each kernel, any number of threads and steps. */
static void all_ways_give_the_same(void **state)
{
    (void)state;
    init();
    const enum ceduo_kernel kernels[] = {CEDUO_KERNEL_SCALAR, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512, CEDUO_KERNEL_BEST};
    for (int law = 0; law < CEDUO_LAW_COUNT; law++)
        for (int wood = 0; wood < 2; wood++) {
            struct ceduo_arrivals first = {0};
            site.scene.simulation.law = (enum ceduo_law)law;
            for (unsigned k = 0; k < 4; k++) {
                struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
                struct ceduo_run *run;
                def.option = wood ? &site.option : NULL;
                def.rocks_most = 2500;
                def.kernel = kernels[k];
                def.threads = 1 + k;
                assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
                for (uint64_t n = k > 0 ? 700 : 2500; n <= 2500; n += 600)
                    assert_int_equal(ceduo_run_extend(run, n), CEDUO_OK);
                struct ceduo_arrivals a = read(run);
                assert_true(a.adjusted);
                if (k == 0)
                    first = a;
                assert_memory_equal(&a, &first, offsetof(struct ceduo_arrivals, exact));
                ceduo_run_free(run);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_variates_explain_is_taken_out),
        cmocka_unit_test(sums_are_those_of_single_rocks),
        cmocka_unit_test(nothing_that_varies_is_no_regression),
        cmocka_unit_test(variates_have_no_mean),
        cmocka_unit_test(intervals_hold_what_is_true),
        cmocka_unit_test(figures_fit_together),
        cmocka_unit_test(controls_and_ends_agree),
        cmocka_unit_test(few_rocks_are_counted),
        cmocka_unit_test(differences_are_those_of_the_figures),
        cmocka_unit_test(all_ways_give_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
