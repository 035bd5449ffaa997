/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Fits whose likelihood is known in closed form: a rock's speed as it leaves is the value that is fitted, so that a mean speed that
 * was seen is its normal law. And p of what the model itself has made. */
#include "expect.h"
#include "local.h"

#include <stdlib.h>
#include <string.h>

#include "ceduo/calibrate.h"
#include "ceduo/ceduo.h"
#include "unit/ground.h"

#define LO 10.
#define HI 20.

static const char *const place = "release.vx_m_s", *const density = "rock.density_kg_m3";
static struct ceduo_input input;

/* From 100 m above two metres of level ground, beyond which every rock leaves. */
static struct ceduo_scene flight(double spread)
{
    static struct ground g;
    ground_make(&g, 2, 0, 100, 15, 0);
    g.scene.release.vx.spread = spread;
    input =
        (struct ceduo_input){.path = place, .kind = CEDUO_INPUT_RANGE, .lo = LO, .hi = HI, .places_count = 1, .places = &place};
    return g.scene;
}

/* A mean speed where rocks leave, known to `sd`. */
static struct ceduo_observation speed(double mean, double sd)
{
    return (struct ceduo_observation){.kind = CEDUO_OBSERVED_SPEED, .x = 0.001, .n = 1, .mean = mean, .sd = sd};
}

/* All pass, whatever is fitted. */
static struct ceduo_observation all_pass(void)
{
    return (struct ceduo_observation){.kind = CEDUO_OBSERVED_PASSED, .x = 0.001, .count = 10, .released_count = 10};
}

static unsigned threads = 1;

static struct ceduo_calibration fit_of(const struct ceduo_scene *scene, const struct ceduo_observation *seen, size_t n,
                                       uint64_t rocks)
{
    const struct ceduo_calibration_scene of = {scene, &input, n, seen};
    const struct ceduo_calibration_def def = {
        .scenes_count = 1, .scenes = &of, .parameters_count = 1, .rocks = rocks, .seed = 1, .threads = threads};
    struct ceduo_calibration a;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    assert_true(a.converged);
    return a;
}

static struct ceduo_fitted fitted_to(double mean, double sd)
{
    struct ceduo_scene scene = flight(0);
    const struct ceduo_observation seen = speed(mean, sd);
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, &seen, 1, 2);
    struct ceduo_fitted p = a.parameters[0];
    return p;
}

static int rising(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The smallest of n sorted values that a share p does not exceed. */
static double quantile(const double *sorted, size_t n, double p)
{
    size_t k = 0;
    while ((double)(k + 1) < p * (double)n)
        k++;
    return sorted[k];
}

/* ---- what is not refuted ---- */

/* A normal law, of which a quantile of 200 independent draws is known to 0.19 (2.5 and 97.5 %) and 0.09 (the median) of its sd; and
 * the quantiles of the draws themselves. */
TEST(a_normal_law_is_found)
{
    struct ceduo_scene scene = flight(0);
    const struct ceduo_observation seen = speed(14, 1);
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, &seen, 1, 2);
    const struct ceduo_fitted *p = &a.parameters[0];
    EXPECT_NEAR(p->best, 14, 0.02);
    EXPECT_NEAR(p->p2_5, 14 - 1.96, 4 * 0.19);
    EXPECT_NEAR(p->p50, 14, 4 * 0.09);
    EXPECT_NEAR(p->p97_5, 14 + 1.96, 4 * 0.19);
    assert_true(p->identified && !p->at_bound);
    qsort(a.draws, a.draws_count, sizeof *a.draws, rising);
    EXPECT_NEAR(p->p2_5, quantile(a.draws, a.draws_count, .025), 1e-9);
    EXPECT_NEAR(p->p50, quantile(a.draws, a.draws_count, .5), 1e-9);
    EXPECT_NEAR(p->p97_5, quantile(a.draws, a.draws_count, .975), 1e-9);
}

/* A value lies at a bound where the best one is there, though half of the draws are farther than a twentieth from it (half a normal
 * law: its median is 0.67 sd); or where they are not, though the best one is. What is not determined lies nowhere. */
TEST(what_lies_at_a_bound)
{
    struct ceduo_fitted p = fitted_to(LO, 2);
    assert_true(p.identified && p.at_bound);
    EXPECT(p.best, <, LO + 0.01);
    EXPECT(p.p50, >, LO + 0.5);
    p = fitted_to(HI, 2);
    assert_true(p.identified && p.at_bound);
    EXPECT(p.p50, <, HI - 0.5);
    p = fitted_to(LO + 0.3, 0.1);
    assert_true(p.at_bound);
    EXPECT(p.best, >, LO + 0.2);
    assert_true(fitted_to(HI - 0.3, 0.1).at_bound);
    assert_false(fitted_to(LO + 0.8, 0.1).at_bound);
    p = fitted_to(LO, 20);
    assert_false(p.identified || p.at_bound);
}

/* More threads than chains change no bit. */
TEST(threads_change_nothing)
{
    struct ceduo_scene scene = flight(0);
    const struct ceduo_observation seen = speed(14, 1);
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration one = fit_of(&scene, &seen, 1, 2);
    threads = CEDUO_CALIBRATION_CHAINS + 1;
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration many = fit_of(&scene, &seen, 1, 2);
    threads = 1;
    EXPECT(many.draws_count, ==, one.draws_count);
    assert_memory_equal(many.draws, one.draws, one.draws_count * sizeof *one.draws);
    assert_memory_equal(many.parameters, one.parameters, sizeof *one.parameters);
}

/* What says nothing leaves the value as it was before, uniform: draws with variance 1/12 of the range squared. */
TEST(nothing_seen_leaves_a_uniform_law)
{
    struct ceduo_scene scene = flight(0);
    const struct ceduo_observation seen = all_pass();
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, &seen, 1, 2);
    const struct ceduo_fitted *p = &a.parameters[0];
    double sum = 0, squares = 0, n = (double)a.draws_count;
    for (size_t i = 0; i < a.draws_count; i++) {
        double u = (a.draws[i] - LO) / (HI - LO);
        EXPECT(u, >, 0);
        EXPECT(u, <, 1);
        sum += u / n;
        squares += u * u / n;
    }
    EXPECT_NEAR(sum, 0.5, 4 * sqrt(1. / 12 / 200)); /* of 200 independent draws */
    EXPECT_NEAR(squares - sum * sum, 1. / 12, 4 * sqrt(1. / 180 / 200));
    assert_false(p->identified || p->at_bound);
}

/* What fits better the faster, beyond the upper bound, too: the best value lies within the bounds. */
TEST(chains_stay_within_their_bounds)
{
    struct ceduo_scene scene = flight(0);
    const struct ceduo_observation seen = speed(25, 1);
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, &seen, 1, 2);
    EXPECT(a.parameters[0].best, >, HI - 0.01);
    EXPECT(a.parameters[0].best, <=, HI);
    for (size_t i = 0; i < a.draws_count; i++)
        EXPECT(a.draws[i], <=, HI);
}

/* ---- what the observations do not hold ---- */

/* Three values by whether they are determined, how much of its bounds each may be, and how they go together (1 with 0, 2 with 0, 2
 * with 1): of two that are known only together the one that is known worse is left, the closest two first; one value stays, and
 * without draws all. */
TEST(what_is_to_be_left_as_it_is)
{
    static const struct {
        bool determined[3];
        double width[3], together[3];
        size_t draws;
        bool loose[3];
    } cases[] = {{{true, true, true}, {.1, .3, .2}, {.9, 0, -.9}, 9, {false, true, false}}, /* not converged: the widest */
                 {{true, true, true}, {.1, .3, .2}, {.91, 0, 0}, 9, {false, true, false}},
                 {{true, true, true}, {.1, .2, .3}, {.9, 0, -.9}, 9, {false, false, false}},
                 {{true, true, true}, {.1, .2, .3}, {.91, 0, 0}, 9, {false, true, false}},
                 {{true, true, true}, {.2, .1, .3}, {-.91, 0, 0}, 9, {true, false, false}},
                 {{true, true, true}, {.1, .3, .2}, {.92, 0, -.99}, 9, {false, true, false}},
                 {{true, true, true}, {.1, .2, .3}, {.92, 0, -.99}, 9, {false, true, true}},
                 {{true, true, true}, {.1, .2, .3}, {.99, 0, -.92}, 9, {false, true, false}},
                 {{false, true, true}, {.9, .2, .3}, {.95, .95, 0}, 9, {true, false, false}},
                 {{false, false, false}, {.9, .9, .9}, {0, 0, 0}, 9, {true, true, false}},
                 {{false, false, false}, {NAN, NAN, NAN}, {NAN, NAN, NAN}, 0, {false, false, false}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct ceduo_calibration a = {.parameters_count = 3, .draws_count = cases[i].draws, .converged = i > 1};
        bool loose[CEDUO_CALIBRATION_MAX];
        size_t n = 0;
        for (size_t k = 0; k < 3; k++) {
            double hi = pow(10, -(double)k); /* the width is a share of it */
            a.parameters[k] = (struct ceduo_fitted){
                .hi = hi, .p2_5 = .05 * hi, .p97_5 = (.05 + cases[i].width[k]) * hi, .identified = cases[i].determined[k]};
            n += cases[i].loose[k];
        }
        a.correlation[1][0] = cases[i].together[0], a.correlation[2][0] = cases[i].together[1];
        a.correlation[2][1] = cases[i].together[2];
        EXPECT(ceduo_calibration_unidentified(&a, loose), ==, n);
        for (size_t k = 0; k < 3; k++)
            EXPECT(loose[k], ==, cases[i].loose[k]);
    }
}

/* ---- what is predicted ---- */

/* Of two things fitted, or to check the fit, one that the model cannot give is enough, wherever it stands. */
TEST(one_misfit_is_enough)
{
    struct ceduo_scene scene = flight(0);
    for (int first = 0; first < 2; first++)
        for (int check = 0; check < 2; check++) {
            struct ceduo_observation seen[3] = {all_pass(), all_pass(), all_pass()};
            seen[first] = speed(30, 1);
            seen[first].use = check ? CEDUO_OBSERVED_CHECK : CEDUO_OBSERVED_FIT;
            LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, seen, 3, 2);
            EXPECT(a.predicted[first].p_value, <, 0.001);
            EXPECT(a.predicted[2].p_value, >, 0.5);
            EXPECT(a.misfit, ==, !check);
            EXPECT(a.check_failed, ==, check);
        }
}

/* p is of other rocks than those of the fit: they differ from those of the scene as two samples do. */
TEST(other_rocks_than_those_of_the_fit)
{
    struct ceduo_scene scene = flight(2);
    input.path = density;
    input.places = &density;
    input.lo = 2500, input.hi = 2700;
    const struct ceduo_observation seen = speed(15, 1);
    struct ceduo_observation_fit own;
    LOCAL(ceduo_observer, observer);
    EXPECT(ceduo_observer_create(&seen, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_simulate(observer, &scene, 50, NULL, &own), ==, CEDUO_OK);
    LOCAL_BY(ceduo_calibration_free) struct ceduo_calibration a = fit_of(&scene, &seen, 1, 50);
    const struct ceduo_observation_fit *at_best = &a.predicted[0].at_best;
    EXPECT(at_best->mean, !=, own.mean);
    EXPECT_NEAR(at_best->mean, own.mean, 5 * hypot(at_best->sd, own.sd) / sqrt(50));
}

/* Two rocks of each of 200 draws are 400 single values, which tell 95 % of them; one of each is not enough. */
TEST(few_single_values_tell_nothing)
{
    struct ceduo_scene scene = flight(0);
    struct ceduo_observation seen[2] = {all_pass(), speed(15, 1)};
    struct ceduo_calibration a = fit_of(&scene, seen, 2, 2);
    assert_true(a.predicted[1].one_lo < 15 && a.predicted[1].one_hi > 15);
    ceduo_calibration_free(&a);
    seen[1].use = CEDUO_OBSERVED_CHECK; /* one rock has no spread to fit by */
    a = fit_of(&scene, seen, 2, 1);
    assert_true(isnan(a.predicted[1].one_lo) && isnan(a.predicted[1].one_hi));
    ceduo_calibration_free(&a);
}

#define SEEN   400 /* times */
#define VALUES 30

/* 400 lists of what rocks of another seed did, and 400 means of them: each p is as likely as any other, in ten classes by Pearson's
 * test with 9 degrees of freedom at one of a thousand. */
TEST(p_is_uniform_under_the_truth)
{
    static struct ceduo_observation seen[2 * SEEN];
    static struct ceduo_predicted p[2 * SEEN];
    struct ceduo_scene scene = flight(2), truth = scene;
    const struct ceduo_observation any = speed(15, 1);
    LOCAL(ceduo_observer, observer);
    LOCAL_BYTES double *values;
    size_t n;
    truth.simulation.seed = 99;
    EXPECT(ceduo_observer_create(&any, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &truth, 0, SEEN * VALUES, &values, &n), ==, CEDUO_OK);
    EXPECT(n, ==, SEEN * VALUES);
    for (size_t i = 0; i < SEEN; i++) {
        double *list = values + i * VALUES, sum = 0, squares = 0;
        qsort(list, VALUES, sizeof *list, rising);
        for (size_t k = 0; k < VALUES; k++) {
            sum += list[k] / VALUES;
            squares += (list[k] - 15) * (list[k] - 15) / VALUES;
        }
        seen[i] = seen[SEEN + i] = speed(sum, 2);
        seen[i].n = seen[SEEN + i].n = VALUES;
        seen[i].values = list;
        EXPECT(squares, >, 1);
    }
    const struct ceduo_calibration_scene of = {.scene = &scene, .observations_count = 2 * SEEN, .observations = seen};
    EXPECT(ceduo_compare_with_observations(&of, 20000, NULL, p), ==, CEDUO_OK);
    for (size_t kind = 0; kind < 2; kind++) {
        double counts[10] = {0}, chi2 = 0;
        for (size_t i = 0; i < SEEN; i++)
            counts[(size_t)fmin(9, 10 * p[kind * SEEN + i].p_value)]++;
        for (int c = 0; c < 10; c++)
            chi2 += (counts[c] - SEEN / 10.) * (counts[c] - SEEN / 10.) / (SEEN / 10.);
        EXPECT(chi2, <, 27.88);
    }
}

#define LISTS 1500
#define LONG  50 /* values of each list, in ten classes of five */

/* Bounds of classes that a list makes itself vary with it. The mean of 1500 p is one half, as that of uniform values is, within four
 * of their standard errors, sqrt(1/12/1500). */
TEST(p_of_lists_is_a_half_on_the_mean)
{
    static struct ceduo_observation seen[LISTS];
    static struct ceduo_predicted p[LISTS];
    struct ceduo_scene scene = flight(2), truth = scene;
    const struct ceduo_observation any = speed(15, 1);
    LOCAL(ceduo_observer, observer);
    LOCAL_BYTES double *values;
    size_t n;
    double mean = 0;
    truth.simulation.seed = 99;
    EXPECT(ceduo_observer_create(&any, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &truth, 0, LISTS * LONG, &values, &n), ==, CEDUO_OK);
    EXPECT(n, ==, LISTS * LONG);
    for (size_t i = 0; i < LISTS; i++) {
        qsort(values + i * LONG, LONG, sizeof *values, rising);
        seen[i] = speed(15, 2);
        seen[i].n = LONG;
        seen[i].values = values + i * LONG;
    }
    const struct ceduo_calibration_scene of = {.scene = &scene, .observations_count = LISTS, .observations = seen};
    EXPECT(ceduo_compare_with_observations(&of, 20000, NULL, p), ==, CEDUO_OK);
    for (size_t i = 0; i < LISTS; i++)
        mean += p[i].p_value / LISTS;
    EXPECT_NEAR(mean, .5, 4 * sqrt(1. / 12 / LISTS));
}
