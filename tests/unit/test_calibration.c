/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Fits with a likelihood in closed form: the fitted value is a rock's initial speed, so an observed mean speed gives its normal
 * distribution. Also p of observations made by the model itself. */
#include "expect.h"
#include "local.h"
#include "study/observe.h"
#include "study/predict.h"

#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "unit/ground.h"

#define LO 10.
#define HI 20.

static const char *const speed_path = "release.vx_m_s", *const density_path = "rock.density_kg_m3";
static struct ceduo_input input;

/* Release rocks 100 m above two metres of level ground; all leave the slope. */
static struct ceduo_scene make_flight(double spread)
{
    static struct ground g;
    ground_make(&g, 2, 0, 100, 15, 0);
    g.scene.release.vx.spread = spread;
    input = (struct ceduo_input){
        .path = speed_path, .kind = CEDUO_INPUT_RANGE, .lo = LO, .hi = HI, .places_count = 1, .places = &speed_path};
    return g.scene;
}

/* Mean of one speed at the release, with standard deviation `sd`. */
static struct ceduo_observation mean_speed(double mean, double sd)
{
    return (struct ceduo_observation){.kind = CEDUO_OBSERVED_SPEED, .x = 0.001, .n = 1, .mean = mean, .sd = sd};
}

/* All rocks pass, whatever the fitted value. */
static struct ceduo_observation make_all_pass(void)
{
    return (struct ceduo_observation){.kind = CEDUO_OBSERVED_PASSED, .x = 0.001, .count = 10, .released_count = 10};
}

static unsigned threads = 1;

static struct ceduo_calibration fit(const struct ceduo_scene *scene, const struct ceduo_observation *observed, size_t n,
                                    uint64_t rocks)
{
    const struct ceduo_calibration_scene data = {scene, &input, n, observed};
    const struct ceduo_calibration_def def = {.size = sizeof def,
                                              .scenes_count = 1,
                                              .scenes = &data,
                                              .parameters_count = 1,
                                              .rocks = rocks,
                                              .seed = 1,
                                              .threads = threads};
    struct ceduo_calibration a;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    assert_true(a.converged);
    return a;
}

static struct ceduo_fitted fit_speed(double mean, double sd)
{
    struct ceduo_scene scene = make_flight(0);
    const struct ceduo_observation observed = mean_speed(mean, sd);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, &observed, 1, 2);
    struct ceduo_fitted p = a.parameters[0];
    return p;
}

static int compare_values(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Return the smallest of n sorted values with cumulative share p. */
static double quantile(const double *sorted, size_t n, double p)
{
    size_t k = 0;
    while ((double)(k + 1) < p * (double)n)
        k++;
    return sorted[k];
}

/* ---- fitted values ---- */

/* Compare with a normal distribution. A quantile of 200 independent draws has a standard error of 0.19 sd (2.5 and 97.5 %) or
 * 0.09 sd (median). Quantiles are those of the draws. */
TEST(a_normal_distribution_is_found)
{
    struct ceduo_scene scene = make_flight(0);
    const struct ceduo_observation observed = mean_speed(14, 1);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, &observed, 1, 2);
    const struct ceduo_fitted *p = &a.parameters[0];
    EXPECT_NEAR(p->best, 14, 0.02);
    EXPECT_NEAR(p->p2_5, 14 - 1.96, 4 * 0.19);
    EXPECT_NEAR(p->p50, 14, 4 * 0.09);
    EXPECT_NEAR(p->p97_5, 14 + 1.96, 4 * 0.19);
    assert_true(p->identified && !p->at_bound);
    qsort(a.draws, a.draws_count, sizeof *a.draws, compare_values);
    EXPECT_NEAR(p->p2_5, quantile(a.draws, a.draws_count, .025), 1e-9);
    EXPECT_NEAR(p->p50, quantile(a.draws, a.draws_count, .5), 1e-9);
    EXPECT_NEAR(p->p97_5, quantile(a.draws, a.draws_count, .975), 1e-9);
}

/* A value is at a bound if its best fit is there, even if half of the draws are farther than a twentieth of the range (half a
 * normal distribution: median 0.67 sd). It is at a bound, too, if the draws are near and the best fit is not. An unidentified
 * value is at no bound. */
TEST(values_at_a_bound)
{
    struct ceduo_fitted p = fit_speed(LO, 2);
    assert_true(p.identified && p.at_bound);
    EXPECT(p.best, <, LO + 0.01);
    EXPECT(p.p50, >, LO + 0.5);
    p = fit_speed(HI, 2);
    assert_true(p.identified && p.at_bound);
    EXPECT(p.p50, <, HI - 0.5);
    p = fit_speed(LO + 0.3, 0.1);
    assert_true(p.at_bound);
    EXPECT(p.best, >, LO + 0.2);
    assert_true(fit_speed(HI - 0.3, 0.1).at_bound);
    assert_false(fit_speed(LO + 0.8, 0.1).at_bound);
    p = fit_speed(LO, 20);
    assert_false(p.identified || p.at_bound);
}

/* More threads than chains change no bit. */
TEST(threads_change_nothing)
{
    struct ceduo_scene scene = make_flight(0);
    const struct ceduo_observation observed = mean_speed(14, 1);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration one = fit(&scene, &observed, 1, 2);
    threads = CEDUO_CALIBRATION_CHAINS + 1;
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration many = fit(&scene, &observed, 1, 2);
    threads = 1;
    EXPECT(many.draws_count, ==, one.draws_count);
    assert_memory_equal(many.draws, one.draws, one.draws_count * sizeof *one.draws);
    assert_memory_equal(many.parameters, one.parameters, sizeof *one.parameters);
}

/* Observations without information leave the uniform prior: variance 1/12 of the squared range. */
TEST(no_information_leaves_a_uniform_distribution)
{
    struct ceduo_scene scene = make_flight(0);
    const struct ceduo_observation observed = make_all_pass();
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, &observed, 1, 2);
    const struct ceduo_fitted *p = &a.parameters[0];
    double sum = 0, squares = 0, n = (double)a.draws_count;
    for (size_t i = 0; i < a.draws_count; i++) {
        double u = (a.draws[i] - LO) / (HI - LO);
        EXPECT(u, >, 0);
        EXPECT(u, <, 1);
        sum += u / n;
        squares += u * u / n;
    }
    EXPECT_NEAR(sum, 0.5, 4 * sqrt(1. / 12 / 200)); /* effective size 200 */
    EXPECT_NEAR(squares - sum * sum, 1. / 12, 4 * sqrt(1. / 180 / 200));
    assert_false(p->identified || p->at_bound);
}

/* The fit improves with speed even beyond the upper bound; the best value lies within the bounds. */
TEST(chains_stay_within_their_bounds)
{
    struct ceduo_scene scene = make_flight(0);
    const struct ceduo_observation observed = mean_speed(25, 1);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, &observed, 1, 2);
    EXPECT(a.parameters[0].best, >, HI - 0.01);
    EXPECT(a.parameters[0].best, <=, HI);
    for (size_t i = 0; i < a.draws_count; i++)
        EXPECT(a.draws[i], <=, HI);
}

/* ---- values to fix ---- */

/* Three values: identified or not, width of each as a share of its bounds, correlations (1 with 0, 2 with 0, 2 with 1). If two
 * values are strongly correlated, the one with the wider range is fixed; the closest pair comes first. One value always stays
 * free; without draws all do. */
TEST(unidentified_values_are_fixed)
{
    static const struct {
        bool identified[3];
        double width[3], correlation[3];
        size_t draws;
        bool fixed[3];
    } cases[] = {{{true, true, true}, {.1, .3, .2}, {.9, 0, -.9}, 9, {false, true, false}},  /* not converged: the widest */
                 {{true, true, true}, {.1, .3, .2}, {.9, 0, -.9}, 0, {false, false, false}}, /* without draws */
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
    struct ceduo_calibration one = {.parameters_count = 1, .draws_count = 9};
    bool selected[CEDUO_CALIBRATION_MAX];
    EXPECT(ceduo_calibration_unidentified(&one, selected), ==, 0);
    assert_false(selected[0]);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct ceduo_calibration a = {.parameters_count = 3, .draws_count = cases[i].draws, .converged = i > 2};
        bool fixed[CEDUO_CALIBRATION_MAX];
        size_t n = 0;
        for (size_t k = 0; k < 3; k++) {
            double hi = pow(10, -(double)k); /* upper bound */
            a.parameters[k] = (struct ceduo_fitted){
                .hi = hi, .p2_5 = .05 * hi, .p97_5 = (.05 + cases[i].width[k]) * hi, .identified = cases[i].identified[k]};
            n += cases[i].fixed[k];
        }
        a.correlation[1][0] = cases[i].correlation[0], a.correlation[2][0] = cases[i].correlation[1];
        a.correlation[2][1] = cases[i].correlation[2];
        EXPECT(ceduo_calibration_unidentified(&a, fixed), ==, n);
        for (size_t k = 0; k < 3; k++)
            EXPECT(fixed[k], ==, cases[i].fixed[k]);
    }
}

/* ---- predictions ---- */

/* One observation that the model cannot reproduce is enough, fitted or held back, first or second. */
TEST(one_misfit_is_enough)
{
    struct ceduo_scene scene = make_flight(0);
    for (int first = 0; first < 2; first++)
        for (int check = 0; check < 2; check++) {
            struct ceduo_observation observed[3] = {make_all_pass(), make_all_pass(), make_all_pass()};
            observed[first] = mean_speed(30, 1);
            observed[first].use = check ? CEDUO_OBSERVED_USE_CHECK : CEDUO_OBSERVED_USE_FIT;
            LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, observed, 3, 2);
            EXPECT(a.predicted[first].p_value, <, 0.001);
            EXPECT(a.predicted[2].p_value, >, 0.5);
            EXPECT(a.misfit, ==, !check);
            EXPECT(a.check_failed, ==, check);
        }
}

/* Predictions use rocks other than those of the fit; they differ from the scene's rocks like two samples. */
TEST(predictions_use_other_rocks_than_the_fit)
{
    struct ceduo_scene scene = make_flight(2);
    input.path = density_path;
    input.places = &density_path;
    input.lo = 2500, input.hi = 2700;
    const struct ceduo_observation observed = mean_speed(15, 1);
    struct ceduo_observation_fit unfitted;
    LOCAL(ceduo_observer, observer);
    EXPECT(ceduo_observer_create(&observed, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_simulate(observer, &scene, 50, NULL, &unfitted), ==, CEDUO_OK);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a = fit(&scene, &observed, 1, 50);
    const struct ceduo_observation_fit *at_best = &a.predicted[0].at_best;
    EXPECT(at_best->mean, !=, unfitted.mean);
    EXPECT_NEAR(at_best->mean, unfitted.mean, 5 * hypot(at_best->sd, unfitted.sd) / sqrt(50));
}

/* Two rocks of each of 200 draws are 400 single values, enough for a 95 % range; one rock of each is not. */
TEST(few_single_values_give_no_range)
{
    struct ceduo_scene scene = make_flight(0);
    struct ceduo_observation observed[2] = {make_all_pass(), mean_speed(15, 1)};
    struct ceduo_calibration a = fit(&scene, observed, 2, 2);
    assert_true(a.predicted[1].one_lo < 15 && a.predicted[1].one_hi > 15);
    ceduo_calibration_release(&a);
    observed[1].use = CEDUO_OBSERVED_USE_CHECK; /* one rock has no variance for a fit */
    a = fit(&scene, observed, 2, 1);
    assert_true(isnan(a.predicted[1].one_lo) && isnan(a.predicted[1].one_hi));
    ceduo_calibration_release(&a);
}

#define SAMPLES 400
#define VALUES  30 /* per sample */

/* 400 lists of values by rocks of another seed, and 400 means of them: p is uniform by Pearson's test with ten classes (9
 * degrees of freedom, level 0.001). */
TEST(p_is_uniform_under_the_truth)
{
    static struct ceduo_observation observed[2 * SAMPLES];
    static struct ceduo_predicted p[2 * SAMPLES];
    struct ceduo_scene scene = make_flight(2), truth = scene;
    const struct ceduo_observation observation = mean_speed(15, 1);
    LOCAL(ceduo_observer, observer);
    LOCAL_BYTES double *values;
    size_t n;
    truth.simulation.seed = 99;
    EXPECT(ceduo_observer_create(&observation, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &truth, 0, SAMPLES * VALUES, &values, &n), ==, CEDUO_OK);
    EXPECT(n, ==, SAMPLES * VALUES);
    for (size_t i = 0; i < SAMPLES; i++) {
        double *list = values + i * VALUES, sum = 0, squares = 0;
        qsort(list, VALUES, sizeof *list, compare_values);
        for (size_t k = 0; k < VALUES; k++) {
            sum += list[k] / VALUES;
            squares += (list[k] - 15) * (list[k] - 15) / VALUES;
        }
        observed[i] = observed[SAMPLES + i] = mean_speed(sum, 2);
        observed[i].n = observed[SAMPLES + i].n = VALUES;
        observed[i].values = list;
        EXPECT(squares, >, 1);
    }
    const struct ceduo_calibration_scene data = {.scene = &scene, .observations_count = 2 * SAMPLES, .observations = observed};
    EXPECT(ceduo_compare_with_observations(&data, 20000, NULL, p), ==, CEDUO_OK);
    for (size_t kind = 0; kind < 2; kind++) {
        double counts[10] = {0}, chi2 = 0;
        for (size_t i = 0; i < SAMPLES; i++)
            counts[(size_t)fmin(9, 10 * p[kind * SAMPLES + i].p_value)]++;
        for (int c = 0; c < 10; c++)
            chi2 += (counts[c] - SAMPLES / 10.) * (counts[c] - SAMPLES / 10.) / (SAMPLES / 10.);
        EXPECT(chi2, <, 27.88);
    }
}

#define LISTS       1500
#define LIST_VALUES 50 /* in ten classes of five */

/* A list's classes are bounded by its own quantiles, which vary with it. The mean of 1500 p is 1/2 like that of uniform values,
 * within four standard errors sqrt(1/12/1500). */
TEST(mean_p_of_lists_is_a_half)
{
    static struct ceduo_observation observed[LISTS];
    static struct ceduo_predicted p[LISTS];
    struct ceduo_scene scene = make_flight(2), truth = scene;
    const struct ceduo_observation observation = mean_speed(15, 1);
    LOCAL(ceduo_observer, observer);
    LOCAL_BYTES double *values;
    size_t n;
    double mean = 0;
    truth.simulation.seed = 99;
    EXPECT(ceduo_observer_create(&observation, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &truth, 0, LISTS * LIST_VALUES, &values, &n), ==, CEDUO_OK);
    EXPECT(n, ==, LISTS * LIST_VALUES);
    for (size_t i = 0; i < LISTS; i++) {
        qsort(values + i * LIST_VALUES, LIST_VALUES, sizeof *values, compare_values);
        observed[i] = mean_speed(15, 2);
        observed[i].n = LIST_VALUES;
        observed[i].values = values + i * LIST_VALUES;
    }
    const struct ceduo_calibration_scene data = {.scene = &scene, .observations_count = LISTS, .observations = observed};
    EXPECT(ceduo_compare_with_observations(&data, 20000, NULL, p), ==, CEDUO_OK);
    for (size_t i = 0; i < LISTS; i++)
        mean += p[i].p_value / LISTS;
    EXPECT_NEAR(mean, .5, 4 * sqrt(1. / 12 / LISTS));
}
