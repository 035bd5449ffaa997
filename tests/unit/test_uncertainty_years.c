/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Uncertainty over a rotation, compared with a separate simulation of every point with many more rocks. */
#include "core/runs/statistics.h"
#include "expect.h"
#include "study/surface.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>
#include <string.h>

#include "io/scene_file.h"
#include "study/inputs.h"

#define OPTIONS 2
#define POINTS  64
#define ROCKS   500 /* per year of a separate point */

static const char scene[] = "ceduo: scene/1\n"
                            "rock: {shape: sphere, diameter_m: 0.68, density_kg_m3: 2600}\n"
                            "release: {vx_m_s: 0.3, vz_m_s: -0.3}\n"
                            "slope: slopes/paper.yaml\n"
                            "controls: [{x_m: 135, accepted_kJ: 90}]\n"
                            "options:\n"
                            "  - {name: a, forest: [{from_m: 0, to_m: 135, stand: stands/simple-coppice.yaml}]}\n"
                            "  - {name: b, forest: [{from_m: 0, to_m: 135, stand: stands/coppice-with-standards.yaml}]}\n"
                            "simulation: {law: lumped, friction_bound: false, seed: 3, rocks: 500}\n";

static struct scene_file file;
static struct scene_inputs inputs;
static struct ceduo_uncertainty_result answer;

/* Separate points: the mean over the years of each option and of the difference; the failing years, and the variance of their
 * number by the rocks of both: the separate point's, and the few per year of a joint one. */
static double means[OPTIONS + 1][POINTS], failing[OPTIONS][POINTS], failing_variance[OPTIONS][POINTS];
static size_t years_count;

/* A share of n rocks near the limit has variance limit(1 - limit)/n. All years of a separate point share their rocks, so their
 * shares are too high or too low together; in a joint run each year has independent rocks, and exceeds the limit by chance. */
static double variance_of_failing(const struct ceduo_years *years)
{
    const double limit = CEDUO_EXCEED_MAX, sd = sqrt(limit * (1 - limit) / ROCKS),
                 few = sqrt(limit * (1 - limit) / CEDUO_UNCERTAINTY_YEAR_ROCKS);
    double lo = 0, hi = 0, apart = 0;
    for (size_t k = 0; k < years->count; k++) {
        double share = years->years[k].wooded.arrivals[years->last_control].exceed.mean;
        double above = erfc((limit - share) / few / sqrt(2)) / 2;
        lo += share - CEDUO_Z95 * sd > limit;
        hi += share + CEDUO_Z95 * sd > limit;
        apart += above * (1 - above);
    }
    return pow((hi - lo) / 2 / CEDUO_Z95, 2) + apart;
}

static void simulate_point(struct input_scene *copy, const double *u, size_t point)
{
    struct ceduo_results own;
    ceduo_inputs_set(copy, u);
    struct ceduo_request q = ceduo_request_default(&copy->scene);
    q.rocks = q.run.rocks_max = ROCKS;
    q.run.threads = 2;
    q.run.arrivals_only = true;
    q.years = true;
    EXPECT(ceduo_simulate_request(&q, NULL, &own), ==, CEDUO_OK);
    for (size_t i = 0; i < OPTIONS; i++) {
        struct ceduo_years_summary s = ceduo_years_summarize(own.years[i], own.years[i]->last_control);
        means[i][point] = s.exceed.mean;
        failing[i][point] = (double)s.unprotected_energy;
        failing_variance[i][point] = variance_of_failing(own.years[i]);
        years_count = own.years[i]->count;
    }
    means[OPTIONS][point] = means[1][point] - means[0][point];
    ceduo_results_release(&own);
}

static struct ceduo_uncertainty_def make_def(unsigned threads, size_t points)
{
    return (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def),
                                          .scene = &file.scene,
                                          .inputs_count = inputs.n,
                                          .inputs = inputs.items,
                                          .points = points,
                                          .rocks = CEDUO_SURFACE_GROUPS,
                                          .own_rocks = ROCKS,
                                          .rotation = true,
                                          .threads = threads};
}

static void ask(unsigned threads, size_t points, struct ceduo_uncertainty_result *to)
{
    const struct ceduo_uncertainty_def def = make_def(threads, points);
    EXPECT(ceduo_uncertainty_compute(&def, to), ==, CEDUO_OK);
}

static void open_scene(void)
{
    struct problems problems = {0};
    bool good = ceduo_scene_load_text(&file, "profiles/wood.yaml", scene, &problems) && ceduo_scene_bind(&file, &problems);
    if (!good || problems.met > 0)
        fail_msg("%s", ceduo_problems_print(&problems));
    assert_true(ceduo_inputs_collect(&file, &inputs));
}

/* Simulate every point separately. */
static void simulate_points(void)
{
    double *u = malloc(POINTS * inputs.n * sizeof *u);
    struct input_scene copy;
    EXPECT(ceduo_surface_points(file.scene.simulation.seed, POINTS, inputs.n, u), ==, CEDUO_OK);
    EXPECT(ceduo_inputs_open(&copy, &file.scene, inputs.items, inputs.n), ==, CEDUO_OK);
    for (size_t p = 0; p < POINTS; p++)
        simulate_point(&copy, u + p * inputs.n, p);
    ceduo_inputs_release(&copy);
    free(u);
}

static const struct ceduo_uncertainty_figure *compute_mean(size_t i)
{
    return ceduo_uncertainty_find_figure(&answer, i < OPTIONS ? i : 1, CEDUO_UNCERTAINTY_MEAN, i == OPTIONS);
}

static double mean(const double *values)
{
    double sum = 0;
    for (size_t p = 0; p < POINTS; p++)
        sum += values[p] / POINTS;
    return sum;
}

/* Return the variance of a mean over years by the rocks of both, at share p: 500 rocks for all years, and 32 others per year.
 * That of a difference is at most the sum of two, because the same rocks meet both forests. */
static double variance_of_mean(size_t i)
{
    if (i == OPTIONS)
        return variance_of_mean(0) + variance_of_mean(1);
    double p = mean(means[i]);
    return p * (1 - p) * (1. / ROCKS + 1. / (double)(CEDUO_UNCERTAINTY_YEAR_ROCKS * years_count));
}

/* For each option, and the difference of two: the mean over all points agrees within three errors. After subtracting it, every
 * point agrees within the sampling error. */
static void expect_means(void)
{
    for (size_t i = 0; i <= OPTIONS; i++) {
        const struct ceduo_uncertainty_figure *f = compute_mean(i);
        double off = 0, spread = 0, shift = mean(f->fit.values) - mean(means[i]);
        EXPECT_NEAR(shift, 0, 3 * sqrt(variance_of_mean(i)));
        for (size_t p = 0; p < POINTS; p++) {
            off += pow(f->fit.values[p] - means[i][p] - shift, 2) / POINTS;
            spread += pow(means[i][p] - mean(means[i]), 2) / POINTS;
        }
        EXPECT(off, <, variance_of_mean(i));
        if (i != 1) /* known poorly: five times the sampling error */
            EXPECT(off, <, .2 * spread);
    }
}

static double percentile(const double *values, double share)
{
    double sorted[POINTS];
    memcpy(sorted, values, sizeof sorted);
    gsl_sort(sorted, 1, POINTS);
    return ceduo_quantile(sorted, POINTS, share);
}

/* Failing years: their mean agrees within two sampling errors of both, the ends of their band within three. After subtracting
 * it, the points agree within sampling error and a tenth of their variance, which a surface need not explain. */
static void expect_failing(void)
{
    for (size_t i = 0; i < OPTIONS; i++) {
        const struct ceduo_surface_fit *fit = &ceduo_uncertainty_find_figure(&answer, i, CEDUO_UNCERTAINTY_FAILING, false)->fit;
        double error = sqrt(mean(failing_variance[i])), shift = mean(fit->values) - mean(failing[i]), off = 0, spread = 0;
        for (size_t p = 0; p < POINTS; p++) {
            off += pow(fit->values[p] - failing[i][p] - shift, 2) / POINTS;
            spread += pow(failing[i][p] - mean(failing[i]), 2) / POINTS;
        }
        EXPECT_NEAR(shift, 0, CEDUO_Z95 * error);
        EXPECT_NEAR(fit->p5, percentile(failing[i], .05), 3 * error);
        EXPECT_NEAR(fit->p95, percentile(failing[i], .95), 3 * error);
        EXPECT(off, <, error * error + (1 - CEDUO_UNCERTAINTY_EXPLAINED) * spread);
    }
}

/* The order over the rotation is that of most points. */
static void expect_order(void)
{
    double better = 0;
    for (size_t p = 0; p < POINTS; p++)
        better += (means[OPTIONS][p] < 0) / (double)POINTS;
    assert_true(answer.rotation);
    EXPECT(answer.orders_count, ==, 1);
    const struct ceduo_uncertainty_order *o = answer.orders;
    EXPECT(o->better, ==, 1);
    EXPECT(o->than, ==, 0);
    EXPECT_NEAR(o->probability + o->equal + o->worse, 1, 1e-12);
    EXPECT(better, >=, o->probability - .1);
    EXPECT(better, <=, o->probability + o->equal + .1);
}

TEST(a_rotation_equals_separate_points)
{
    open_scene();
    simulate_points();
    ask(2, POINTS, &answer);
    assert_true(answer.rotation);
    expect_means();
    expect_failing();
    expect_order();
    ceduo_uncertainty_release(&answer);
    ceduo_scene_release(&file);
}

TEST(threads_do_not_change_a_rotation)
{
    open_scene();
    for (unsigned threads = 1; threads <= 3; threads++) {
        struct ceduo_uncertainty_result other;
        ask(threads, 16, threads == 1 ? &answer : &other);
        for (size_t i = 0; threads > 1 && i < answer.figures_count; i++) {
            const struct ceduo_uncertainty_figure *f = &answer.figures[i], *g = &other.figures[i];
            assert_true(!f->fit.values == !g->fit.values);
            if (f->fit.values) /* the scene has no fence to defeat */
                assert_memory_equal(f->fit.values, g->fit.values, answer.points * sizeof *f->fit.values);
            assert_memory_equal(&f->fit.p5_se, &g->fit.p5_se, sizeof f->fit.p5_se);
        }
        if (threads > 1)
            ceduo_uncertainty_release(&other);
    }
    ceduo_uncertainty_release(&answer);
    ceduo_scene_release(&file);
}

/* One option alone has the bits that it has with others, without surfaces for those; also at points without growth. */
TEST(one_option_alone_over_a_rotation)
{
    struct ceduo_uncertainty_result alone;
    open_scene();
    struct ceduo_uncertainty_def def = make_def(2, 16);
    ask(2, 16, &answer);
    def.one_option = true;
    def.option = 1;
    def.points_max = 8;
    EXPECT(ceduo_uncertainty_compute(&def, &alone), ==, CEDUO_OK);
    EXPECT(alone.points, ==, 16);
    for (int kind = 0; kind < CEDUO_UNCERTAINTY_KINDS; kind++) {
        const struct ceduo_surface_fit
            *f = &ceduo_uncertainty_find_figure(&answer, 1, (enum ceduo_uncertainty_kind)kind, false)->fit,
            *g = &ceduo_uncertainty_find_figure(&alone, 1, (enum ceduo_uncertainty_kind)kind, false)->fit;
        assert_true(!f->values == !g->values);
        if (f->values)
            assert_memory_equal(f->values, g->values, 16 * sizeof *f->values);
        assert_null(ceduo_uncertainty_find_figure(&alone, 0, (enum ceduo_uncertainty_kind)kind, false)->fit.values);
    }
    EXPECT(alone.orders_count, ==, 0);
    ceduo_uncertainty_release(&alone);
    ceduo_uncertainty_release(&answer);
    ceduo_scene_release(&file);
}

/* By sampling, the second option has at least its minimum of failing years minus the first's maximum, and at most its maximum
 * minus the first's minimum. */
TEST(failing_years_differ_by_both_intervals)
{
    open_scene();
    file.scene.controls[0].accepted = 150e3;
    ask(2, 4, &answer);
    const struct ceduo_uncertainty_figure *first = ceduo_uncertainty_find_figure(&answer, 0, CEDUO_UNCERTAINTY_FAILING, false),
                                          *second = ceduo_uncertainty_find_figure(&answer, 1, CEDUO_UNCERTAINTY_FAILING, false),
                                          *difference =
                                              ceduo_uncertainty_find_figure(&answer, 1, CEDUO_UNCERTAINTY_FAILING, true);
    EXPECT(first->sampling_lo, <, first->sampling_hi); /* some years are near the limit */
    EXPECT_NEAR(difference->sampling_lo, second->sampling_lo - first->sampling_hi, 1e-12);
    EXPECT_NEAR(difference->sampling_hi, second->sampling_hi - first->sampling_lo, 1e-12);
    ceduo_uncertainty_release(&answer);
    ceduo_scene_release(&file);
}

/* Without an accepted energy the share that arrives is evaluated, and no year fails. The index simulates no rock, and has
 * nothing over a rotation. */
TEST(figures_over_a_rotation)
{
    open_scene();
    file.scene.controls[0].accepted = NAN;
    ask(2, 24, &answer);
    const struct ceduo_uncertainty_figure *mean = ceduo_uncertainty_find_figure(&answer, 0, CEDUO_UNCERTAINTY_MEAN, false),
                                          *years = ceduo_uncertainty_find_figure(&answer, 0, CEDUO_UNCERTAINTY_FAILING, false);
    EXPECT(mean->value, >, .5); /* most arrive just after the cut */
    EXPECT_NEAR(mean->value, mean->fit.p50, .2);
    assert_true(isnan(years->value));
    assert_null(years->fit.values);
    ceduo_uncertainty_release(&answer);
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    ask(2, 8, &answer);
    assert_false(answer.rotation);
    assert_null(ceduo_uncertainty_find_figure(&answer, 0, CEDUO_UNCERTAINTY_MEAN, false)->fit.values);
    ceduo_uncertainty_release(&answer);
    ceduo_scene_release(&file);
}
