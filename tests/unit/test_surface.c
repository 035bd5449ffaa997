/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Shares of uncertainty by a surface, for functions whose shares have a closed form. */
#include "expect.h"
#include "full.h"

#include <stdlib.h>

#include "ceduo/surface.h"
#include "ceduo/uncertainty.h"
#include "physics/line_scene.h"

#define SEEDS      FULL_OR(200u, 100u)
#define MAX_INPUTS 40

typedef double function(const double *u, size_t n);

static struct ceduo_input inputs[MAX_INPUTS];

/* Make ranges, but the first `words` inputs with `each` words. */
static void make_inputs(size_t n, size_t words, size_t each)
{
    for (size_t i = 0; i < n; i++)
        inputs[i] = i < words ? (struct ceduo_input){.kind = CEDUO_INPUT_WORDS, .words_count = each}
                              : (struct ceduo_input){.kind = CEDUO_INPUT_RANGE, .hi = 1};
}

static double lowest = -INFINITY, limit = NAN;
static double level; /* sd of a group's contribution, equal at all points */
static double tilt;  /* additional effect of the first input in every second group, subtracted in the others */
static bool still;   /* the last input is constant */

/* Fit values of the function plus noise. */
static struct ceduo_surface_fit fit_function(function *f, size_t n, size_t points, uint64_t seed, double noise)
{
    double *u = malloc(points * n * sizeof *u);
    struct ceduo_replicates *y = malloc(points * sizeof *y);
    struct ceduo_surface *surface;
    struct ceduo_surface_fit fit;
    struct line_random random = {.state = seed + 1000};
    assert_non_null(u);
    assert_non_null(y);
    EXPECT(ceduo_surface_points(seed, points, n, u), ==, CEDUO_OK);
    for (size_t p = 0; p < points && still; p++)
        u[p * n + n - 1] = .5;
    double constants[CEDUO_SURFACE_GROUPS];
    for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++) /* group effects */
        constants[g] = level > 0 ? level * line_normal(&random) : g - (CEDUO_SURFACE_GROUPS - 1) / 2.;
    for (size_t p = 0; p < points; p++)
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].of[g] = f(u + p * n, n) + noise * line_normal(&random) + constants[g] + (g % 2 ? tilt : -tilt) * u[p * n];
    EXPECT(ceduo_surface_open(inputs, n, u, points, &surface), ==, CEDUO_OK);
    EXPECT(ceduo_surface_fit(surface,
                             &(const struct ceduo_surface_figure){.y = y, .lo = lowest, .hi = INFINITY, .limit = limit}, &fit),
           ==, CEDUO_OK);
    ceduo_surface_free(surface);
    free(u);
    free(y);
    return fit;
}

/* ---- functions in the surface's span ---- */

static double linear(const double *u, size_t n)
{
    double sum = 5;
    for (size_t i = 0; i < n; i++)
        sum += (double)(i + 1) * u[i];
    return sum;
}

TEST(linear_functions_are_exact)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(linear, 12, 256, 1, 0);
    for (size_t i = 0; i < 12; i++) {
        double share = (double)((i + 1) * (i + 1)) / 650; /* sum of squares from 1 to 12 */
        EXPECT_NEAR(f.first[i].value, share, 1e-6);
        EXPECT_NEAR(f.total[i].value, share, 1e-6);
    }
    EXPECT_NEAR(f.variance, 650 / 12., 1e-4);
    EXPECT_NEAR(f.mean, 5 + 39, 1e-1);
    EXPECT_NEAR(f.q2, 1, 1e-9);
    EXPECT_NEAR(f.whole.value, 0, 1e-9);
    ceduo_surface_release(&f);
}

static double quadratic(const double *u, size_t n)
{
    (void)n;
    double x = 2 * u[0] - 1, y = 2 * u[1] - 1;
    return x + x * x + 2 * x * y + 3 * y * y;
}

/* Variances: x 1/3, x² 4/45, 2xy 4/9, 3y² 36/45. */
TEST(quadratic_functions_are_exact)
{
    make_inputs(6, 0, 0);
    struct ceduo_surface_fit f = fit_function(quadratic, 6, 256, 2, 0);
    double x = 1 / 3. + 4 / 45., both = 4 / 9., y = 36 / 45., all = x + both + y;
    const double first[] = {x / all, y / all, 0, 0, 0, 0}, total[] = {(x + both) / all, (y + both) / all, 0, 0, 0, 0};
    for (size_t i = 0; i < 6; i++) {
        EXPECT_NEAR(f.first[i].value, first[i], 1e-6);
        EXPECT_NEAR(f.total[i].value, total[i], 1e-6);
    }
    ceduo_surface_release(&f);
}

static double product(const double *u, size_t n)
{
    (void)n;
    return (2 * u[0] - 1) * (2 * u[1] - 1);
}

TEST(a_product_gives_both_inputs_a_total_of_1)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(product, 12, 256, 3, 0);
    for (size_t i = 0; i < 12; i++) {
        EXPECT_NEAR(f.first[i].value, 0, 1e-6);
        EXPECT_NEAR(f.total[i].value, i < 2 ? 1 : 0, 1e-6);
    }
    ceduo_surface_release(&f);
}

static double worded(const double *u, size_t n)
{
    (void)n;
    static const double effects[] = {0, 3, 9};
    int a = (int)(3 * u[0]), b = (int)(3 * u[1]);
    return effects[a] + (a == b ? 6 : 0) * (u[2] - .5);
}

/* Three words each: the effects 0, 3, 9 have variance 14 (mean 4). If both are equal, in a third of cases, u2 - ½ counts
 * six-fold: 36/12/3 = 1; a ninth of 36/12 is u2 alone, the rest is the interaction of all three. */
TEST(words_are_exact)
{
    make_inputs(3, 2, 3);
    struct ceduo_surface_fit f = fit_function(worded, 3, 256, 4, 0);
    const double first[] = {14 / 15., 0, 1 / 3. / 15}, total[] = {(14 + 2 / 3.) / 15, 2 / 3. / 15, 1 / 15.};
    for (size_t i = 0; i < 3; i++) {
        EXPECT_NEAR(f.first[i].value, first[i], 1e-6);
        EXPECT_NEAR(f.total[i].value, total[i], 1e-6);
    }
    EXPECT_NEAR(f.variance, 15, 1e-4);
    ceduo_surface_release(&f);
}

#define DRAWN  32 /* rows */
#define PLACES 7

static double rows[PLACES][DRAWN];

static double use_rows(const double *u, size_t n)
{
    (void)n;
    return rows[0][(size_t)(DRAWN * u[0])];
}

/* A calibration of more values than there are functions has the first ones; one with equal rows has none, and alone explains
 * nothing. */
TEST(rows_of_a_calibration)
{
    static const double equal[DRAWN] = {0};
    const double *draws[PLACES], *const none[] = {equal};
    struct line_random random = {.state = 1};
    for (size_t k = 0; k < PLACES; k++) {
        for (size_t i = 0; i < DRAWN; i++)
            rows[k][i] = line_normal(&random);
        draws[k] = rows[k];
    }
    inputs[0] = (struct ceduo_input){.kind = CEDUO_INPUT_DRAWS, .places_count = PLACES, .draws_count = DRAWN, .draws = draws};
    inputs[1] = (struct ceduo_input){.kind = CEDUO_INPUT_DRAWS, .places_count = 1, .draws_count = DRAWN, .draws = none};
    struct ceduo_surface_fit f = fit_function(use_rows, 2, 256, 1, 0);
    assert_true(f.enough);
    EXPECT_NEAR(f.first[0].value, 1, 1e-6);
    EXPECT_NEAR(f.total[0].value, 1, 1e-6);
    EXPECT_NEAR(f.total[1].value, 0, 1e-6);
    ceduo_surface_release(&f);
    inputs[0] = inputs[1];
    f = fit_function(use_rows, 1, 256, 1, 0);
    assert_false(f.enough);
    assert_true(isnan(f.total[0].value));
    EXPECT(f.p95 - f.p5, >, 1);
    ceduo_surface_release(&f);
}

static double turning(const double *u, size_t n)
{
    static int calls;
    (void)u, (void)n;
    return calls++ / CEDUO_SURFACE_GROUPS % 2;
}

/* It has no effect, and takes nothing from others; alone, with two words, no term varies. */
TEST(a_constant_input)
{
    make_inputs(3, 0, 0);
    still = true;
    struct ceduo_surface_fit f = fit_function(linear, 3, 256, 1, 0);
    still = false;
    const double share[] = {.2, .8, 0};
    for (size_t i = 0; i < 3; i++)
        EXPECT_NEAR(f.total[i].value, share[i], 1e-6);
    EXPECT_NEAR(f.q2, 1, 1e-9);
    ceduo_surface_release(&f);
    make_inputs(1, 1, 2);
    still = true;
    f = fit_function(turning, 1, 256, 1, 0);
    still = false;
    assert_true(f.enough);
    EXPECT(f.total[0].value, ==, 0);
    EXPECT_NEAR(f.whole.value, 1, 1e-9);
    EXPECT_NEAR(f.p5, 0, 1e-9);
    EXPECT_NEAR(f.p95, 1, 1e-9);
    ceduo_surface_release(&f);
}

enum { FEW_POINTS = 128, FEW_INPUTS = 13 };

static struct ceduo_surface *use_few_points(const double *u)
{
    struct ceduo_surface *surface;
    EXPECT(ceduo_surface_open(inputs, FEW_INPUTS, u, FEW_POINTS, &surface), ==, CEDUO_OK);
    return surface;
}

/* Figures of one surface may depend on different inputs, some without products: each has the bits it has alone. */
TEST(figures_of_one_surface)
{
    static double u[FEW_POINTS * FEW_INPUTS];
    static struct ceduo_replicates y[FEW_POINTS];
    make_inputs(FEW_INPUTS, 0, 0);
    EXPECT(ceduo_surface_points(1, FEW_POINTS, FEW_INPUTS, u), ==, CEDUO_OK);
    for (size_t p = 0; p < FEW_POINTS; p++)
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].of[g] = linear(u + p * FEW_INPUTS, FEW_INPUTS) + 99 * u[p * FEW_INPUTS + 10] * u[p * FEW_INPUTS + 12];
    struct ceduo_surface *together = use_few_points(u);
    for (size_t turn = 0; turn < 4; turn++) {
        size_t n = FEW_INPUTS - turn % 3;
        struct ceduo_surface *alone = use_few_points(u);
        struct ceduo_surface_fit f, g;
        bool uses[FEW_INPUTS];
        for (size_t i = 0; i < FEW_INPUTS; i++)
            uses[i] = i < n;
        const struct ceduo_surface_figure figure = {.y = y, .uses = uses, .lo = -INFINITY, .hi = INFINITY, .limit = NAN};
        EXPECT(ceduo_surface_fit(together, &figure, &f), ==, CEDUO_OK);
        EXPECT(ceduo_surface_fit(alone, &figure, &g), ==, CEDUO_OK);
        assert_true(f.enough);
        EXPECT(f.explained > .99, ==, n == FEW_INPUTS);
        assert_memory_equal(f.values, g.values, FEW_POINTS * sizeof *f.values);
        assert_memory_equal(f.total, g.total, FEW_INPUTS * sizeof *f.total);
        ceduo_surface_release(&f);
        ceduo_surface_release(&g);
        ceduo_surface_free(alone);
    }
    ceduo_surface_free(together);
}

/* ---- with noise ---- */

static double two(const double *u, size_t n)
{
    (void)n;
    return 100 + 2 * u[0] + u[1];
}

/* Shares .8 and .2 within three errors for 20 seeds, although the groups of rocks differ by a constant. */
TEST(two_inputs_have_their_shares)
{
    double errors = 0;
    make_inputs(2, 0, 0);
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct ceduo_surface_fit f = fit_function(two, 2, 256, seed, .3 * sqrt(CEDUO_SURFACE_GROUPS / 2.));
        const double share[] = {.8, .2};
        for (size_t i = 0; i < 2; i++) {
            EXPECT_NEAR(f.first[i].value, share[i], 3 * f.first[i].se);
            EXPECT_NEAR(f.total[i].value, share[i], 3 * f.total[i].se);
            errors += f.total[i].se / 40;
        }
        EXPECT_NEAR(f.noise, .045, .005); /* variance of the mean over all groups */
        ceduo_surface_release(&f);
    }
    EXPECT(errors, <, .02); /* on average */
}

static double constant(const double *u, size_t n)
{
    (void)u, (void)n;
    return 7;
}

TEST(a_constant_figure_has_no_shares)
{
    make_inputs(3, 0, 0);
    struct ceduo_surface_fit f = fit_function(constant, 3, 64, 1, 0);
    assert_true(isnan(f.first[0].value) && isnan(f.total[2].se) && isnan(f.left[1]));
    EXPECT_NEAR(f.mean, 7, 1e-12);
    EXPECT_NEAR(f.p95, 7, 1e-12);
    ceduo_surface_release(&f);
}

/* 95 % intervals of shares contain the truth in 90 to 97 %: many seeds of a function of 12 inputs with noise. */
TEST(errors_cover)
{
    make_inputs(12, 0, 0);
    double inside = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct ceduo_surface_fit f = fit_function(linear, 12, 256, seed, 3 * sqrt(CEDUO_SURFACE_GROUPS / 2.));
        for (size_t i = 0; i < 12; i++) {
            double share = (double)((i + 1) * (i + 1)) / 650;
            inside += (fabs(f.first[i].value - share) <= 1.96 * f.first[i].se) / (12. * SEEDS);
        }
        ceduo_surface_release(&f);
    }
    EXPECT(inside, >=, .90);
    EXPECT(inside, <=, .97);
}

/* Groups have 1 ± t of the first input and 2 of the second. Its share, 1/5, changes by 2 * 1/5 * 4/5 of the change in the mean
 * of 1 ± t: its variance is t2 / 15, and its error that of 16 values by Student. */
TEST(errors_of_rocks_are_those_of_a_mean)
{
    make_inputs(2, 0, 0);
    tilt = 1e-3;
    struct ceduo_surface_fit f = fit_function(linear, 2, 256, 1, 0);
    EXPECT_NEAR(f.first[0].value, .2, 1e-5);
    EXPECT_NEAR(f.first[0].se / (.32 * tilt / sqrt(15) * 2.13145 / 1.95996), 1, .01);
    tilt = 0;
    ceduo_surface_release(&f);
}

/* ---- functions outside the surface's span ---- */

/* Ishigami and Homma 1990 with a = 7, b = 0.1, over -pi…pi. */
static double ishigami(const double *u, size_t n)
{
    (void)n;
    double x[3];
    for (int i = 0; i < 3; i++)
        x[i] = (2 * u[i] - 1) * M_PI;
    return sin(x[0]) + 7 * sin(x[1]) * sin(x[1]) + 0.1 * pow(x[2], 4) * sin(x[0]);
}

static const double g_weights[] = {0, 1, 4.5, 9, 99, 99, 99, 99};

/* Sobol's g function (Saltelli and Sobol' 1995). */
static double sobol_g(const double *u, size_t n)
{
    double value = 1;
    for (size_t i = 0; i < n; i++)
        value *= (fabs(4 * u[i] - 2) + g_weights[i]) / (1 + g_weights[i]);
    return value;
}

TEST(a_poor_surface_is_reported)
{
    const double first[] = {0.3139, 0.4424, 0}, g_first[] = {0.7165, 0.1791, 0.0237, 0.0072, 0.0001, 0.0001, 0.0001, 0.0001};
    make_inputs(8, 0, 0);
    for (uint64_t seed = 1; seed <= 5; seed++) {
        struct ceduo_surface_fit f = fit_function(ishigami, 3, 1024, seed, 0);
        EXPECT(f.explained, <, .6);
        EXPECT(f.whole.value, >, .4);
        for (size_t i = 0; i < 3; i++)
            EXPECT(f.first[i].value, <=, first[i] + 3 * f.first[i].se);
        ceduo_surface_release(&f);
        f = fit_function(sobol_g, 8, 1024, seed, 0);
        EXPECT(f.explained, <, .95);
        EXPECT(f.whole.value, >, .03);
        for (size_t i = 0; i < 8; i++)
            EXPECT(f.first[i].value, <=, g_first[i] + 3 * f.first[i].se);
        ceduo_surface_release(&f);
    }
}

static double by_chance(const double *u, size_t n)
{
    (void)n;
    double turns = 43758.5453 * (1 + sin(12.9898 * u[0] + 78.233 * u[1] + 37.719 * u[2]));
    return turns - floor(turns);
}

/* Random values, equal for all rocks. The terms of 12 inputs fit a third of 256 of them; predicting an omitted point is worse
 * than the mean. */
TEST(chance_explains_nothing)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(by_chance, 12, 256, 1, 0);
    assert_true(f.enough && !f.linear);
    EXPECT_NEAR(f.variance, 1 / 12., 3 * sqrt(1 / 180. / 256)); /* variance of 256 uniform values */
    EXPECT(f.explained, <, 0);
    ceduo_surface_release(&f);
}

/* Too few points for the terms: a band, and no shares. */
TEST(few_points_give_a_band)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(linear, 12, 29, 1, 0);
    assert_false(f.enough);
    assert_true(isnan(f.total[11].value));
    EXPECT_NEAR(f.p50, 44, 5);
    ceduo_surface_release(&f);
}

/* Points for terms of degree 1 alone: for a linear figure the shares are exact, 1, 4, 9 … of their sum. */
TEST(few_points_are_enough_for_lines)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(linear, 12, 32, 1, 0);
    assert_true(f.enough);
    for (size_t i = 0; i < 12; i++)
        EXPECT_NEAR(f.total[i].value, (double)((i + 1) * (i + 1)) / 650, 1e-6);
    ceduo_surface_release(&f);
}

/* ---- percentiles ---- */

static double sum_of_two(const double *u, size_t n)
{
    (void)n;
    return u[0] + u[1];
}

/* A triangular law: p5 at sqrt(.1), p95 at 2 - sqrt(.1). With one input known .9 remains; with the third, which has no effect,
 * all. */
TEST(band_and_remaining_width)
{
    make_inputs(3, 0, 0);
    struct ceduo_surface_fit f = fit_function(sum_of_two, 3, 1024, 1, .1);
    EXPECT_NEAR(f.p5, sqrt(.1), .02);
    EXPECT_NEAR(f.p50, 1, .02);
    EXPECT_NEAR(f.p95, 2 - sqrt(.1), .02);
    EXPECT_NEAR(f.left[0], .9, .02);
    EXPECT_NEAR(f.left[1], .9, .02);
    EXPECT_NEAR(f.left[2], 2 - 2 * sqrt(.1), .03);
    ceduo_surface_release(&f);
}

static double scaled(const double *u, size_t n)
{
    (void)n;
    return u[0] * (2 * u[1] - 1);
}

/* With U known 1.8 U of U(2V - 1) remains, the width of 90 % of it: 0.9 averaged over U. */
TEST(remaining_width_is_averaged_over_the_known_input)
{
    make_inputs(2, 0, 0);
    struct ceduo_surface_fit f = fit_function(scaled, 2, 1024, 1, 0);
    EXPECT_NEAR(f.left[0], .9, .01);
    ceduo_surface_release(&f);
}

static double kinked(const double *u, size_t n)
{
    (void)n;
    return fmax(0, u[0] + u[1] - 1.5);
}

/* A share that is 0 almost everywhere: the surface is not, but its band ends at 0. An eighth of the square is above 0, a
 * twentieth has U + V > 2 - sqrt(.1). */
TEST(a_band_keeps_within_bounds)
{
    make_inputs(2, 0, 0);
    struct ceduo_surface_fit f = fit_function(kinked, 2, 256, 1, .2);
    EXPECT(f.p5, <, -1e-3);
    ceduo_surface_release(&f);
    lowest = 0;
    f = fit_function(kinked, 2, 256, 1, .2);
    lowest = -INFINITY;
    EXPECT(f.p5, ==, 0);
    EXPECT_NEAR(f.p95, .5 - sqrt(.1), .03);
    ceduo_surface_release(&f);
}

/* ---- errors of the band ---- */

static double ripple, turns[3]; /* effect outside the surface's span */

static double rippled_sum(const double *u, size_t n)
{
    return sum_of_two(u, n) + ripple * sin(2 * M_PI * (turns[0] * u[0] + turns[1] * u[1] + turns[2] * u[2]));
}

/* Return the probability of U + V + a·sin(2πW) <= x, by small steps of W. */
static double probability_below(double x)
{
    double share = 0;
    for (int i = 0; i < 1000; i++) {
        double t = fmin(2, fmax(0, x - ripple * sin(2 * M_PI * (i + .5) / 1000)));
        share += (t < 1 ? t * t / 2 : 1 - (2 - t) * (2 - t) / 2) / 1000;
    }
    return share;
}

static double value_at_share(double share)
{
    double lo = -2, hi = 4;
    while (hi - lo > 1e-9)
        *(probability_below((lo + hi) / 2) < share ? &lo : &hi) = (lo + hi) / 2;
    return lo;
}

/* Coverage of 95 % intervals over many seeds: for functions in the surface's span and outside it, with rocks that differ at all
 * points or at each. A residual that the points spread like chance has the nominal coverage; a more even one has more. */
TEST(errors_of_the_band_hold_the_truth)
{
    static const struct {
        double ripple, turns[3], level, noise;
        bool even;
    } cases[] = {{.level = 0},
                 {.ripple = .3, .turns = {29, 31, 37}},
                 {.ripple = .3, .turns = {0, 0, 9}, .even = true},
                 {.level = .2},
                 {.noise = .5},
                 {.level = .1, .noise = .4}};
    double all = 0, n = 0;
    make_inputs(3, 0, 0);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        ripple = cases[c].ripple;
        memcpy(turns, cases[c].turns, sizeof turns);
        level = fmax(1e-12, cases[c].level);
        double low = value_at_share(.05), high = value_at_share(.95), share = probability_below(limit = .9), held = 0;
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            struct ceduo_surface_fit f = fit_function(rippled_sum, 3, 256, seed, cases[c].noise);
            held += fabs(f.p5 - low) <= 1.96 * f.p5_se;
            held += fabs(f.p95 - high) <= 1.96 * f.p95_se;
            held += fabs(f.below.value - share) <= 1.96 * f.below.se;
            ceduo_surface_release(&f);
        }
        EXPECT(100 * held / (3 * SEEDS), >=, 90);
        all += cases[c].even ? 0 : 100 * held / (3 * SEEDS);
        n += !cases[c].even;
    }
    EXPECT(all / n, <=, 97);
    level = 0, limit = NAN;
}

/* ---- values without noise ---- */

/* Two figures of few rocks. The surface of 256 points has 6 terms: it keeps 6/256 of the noise of a point's mean, and little of
 * the residual. */
TEST(values_have_no_noise_of_their_rocks)
{
    enum { POINTS = 256, FIGURES = 2 };
    static double u[2 * POINTS], values[FIGURES * POINTS];
    static struct ceduo_replicates y[FIGURES * POINTS], changes[FIGURES * POINTS];
    const double noise = .4;
    struct ceduo_surface *surface;
    struct line_random random = {.state = 1};
    make_inputs(2, 0, 0);
    EXPECT(ceduo_surface_points(1, POINTS, 2, u), ==, CEDUO_OK);
    for (size_t p = 0; p < FIGURES * POINTS; p++)
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].of[g] = two(u + 2 * (p % POINTS), 2) + noise * line_normal(&random);
    EXPECT(ceduo_surface_open(inputs, 2, u, POINTS, &surface), ==, CEDUO_OK);
    const struct ceduo_surface_figure figure = {.y = y, .lo = -INFINITY, .hi = INFINITY, .limit = NAN};
    EXPECT(ceduo_surface_values(surface, &figure, FIGURES, values, changes), ==, CEDUO_OK);
    for (size_t k = 0; k < FIGURES; k++) {
        double off = 0;
        for (size_t p = 0; p < POINTS; p++)
            off += pow(values[k * POINTS + p] - two(u + 2 * p, 2), 2) / POINTS;
        EXPECT(off, <, .3 * noise * noise / CEDUO_SURFACE_GROUPS);
    }
    ceduo_surface_free(surface);
}

/* ---- many inputs ---- */

static double even_40(const double *u, size_t n)
{
    return linear(u, n) + 400 * (u[38] - .5) * (u[39] - .5);
}

/* Forty inputs: the dominant ones keep their products. */
TEST(the_dominant_of_many_inputs_have_products)
{
    make_inputs(40, 0, 0);
    struct ceduo_surface_fit f = fit_function(even_40, 40, 512, 1, 0);
    double squares = 40 * 41 * 81 / 6. / 12, both = 400. * 400 / 144, all = squares + both;
    EXPECT_NEAR(f.total[38].value, (39 * 39 / 12. + both) / all, .01);
    EXPECT_NEAR(f.total[39].value, (40 * 40 / 12. + both) / all, .01);
    EXPECT_NEAR(f.first[39].value, 40 * 40 / 12. / all, .01);
    EXPECT_NEAR(f.total[20].value, 21 * 21 / 12. / all, .01);
    ceduo_surface_release(&f);
}
