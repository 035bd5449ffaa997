/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Shares of uncertainty by a surface, for functions with shares in closed form. */
#include "expect.h"
#include "full.h"
#include "study/surface.h"

#include <stdlib.h>

#include "physics/line_scene.h"

#define SEEDS      FULL_OR(200u, 100u)
#define MAX_INPUTS 40

typedef double function(const double *u, size_t n);

static struct ceduo_input inputs[MAX_INPUTS];

/* Make n ranges; the first `words` inputs are choices among `each` words instead. */
static void make_inputs(size_t n, size_t words, size_t each)
{
    for (size_t i = 0; i < n; i++)
        inputs[i] = i < words ? (struct ceduo_input){.kind = CEDUO_INPUT_WORDS, .words_count = each}
                              : (struct ceduo_input){.kind = CEDUO_INPUT_RANGE, .hi = 1};
}

static double lower_bound = -INFINITY, limit = NAN;
static double level;        /* sd of the constant added to each group of rocks */
static double slope_change; /* coefficient of the first input, added to odd groups and subtracted from even ones */
static bool last_constant;  /* the last input is constant */

/* Fit a surface to values of the function with noise. */
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
    for (size_t p = 0; p < points && last_constant; p++)
        u[p * n + n - 1] = .5;
    double constants[CEDUO_SURFACE_GROUPS];
    for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++) /* added to all values of a group */
        constants[g] = level > 0 ? level * line_normal(&random) : g - (CEDUO_SURFACE_GROUPS - 1) / 2.;
    for (size_t p = 0; p < points; p++)
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].value[g] = f(u + p * n, n) + noise * line_normal(&random) + constants[g] +
                            (g % 2 ? slope_change : -slope_change) * u[p * n];
    EXPECT(ceduo_surface_open(inputs, n, u, points, &surface), ==, CEDUO_OK);
    EXPECT(ceduo_surface_fit(
               surface, &(const struct ceduo_surface_figure){.y = y, .lo = lower_bound, .hi = INFINITY, .limit = limit}, &fit),
           ==, CEDUO_OK);
    ceduo_surface_free(surface);
    free(u);
    free(y);
    return fit;
}

TEST(inputs_of_a_surface_are_checked)
{
    struct ceduo_surface *surface;
    const double u[2] = {.25, .75};
    make_inputs(1, 0, 0);
    inputs[0].hi = -1; /* below its lower end */
    EXPECT(ceduo_surface_open(inputs, 1, u, 2, &surface), ==, CEDUO_BAD_ARGUMENT);
    assert_null(surface);
}

/* ---- functions that a surface fits exactly ---- */

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
    EXPECT_NEAR(f.unexplained.value, 0, 1e-9);
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

TEST(both_inputs_of_a_product_have_all)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(product, 12, 256, 3, 0);
    for (size_t i = 0; i < 12; i++) {
        EXPECT_NEAR(f.first[i].value, 0, 1e-6);
        EXPECT_NEAR(f.total[i].value, i < 2 ? 1 : 0, 1e-6);
    }
    ceduo_surface_release(&f);
}

static double choose(const double *u, size_t n)
{
    (void)n;
    static const double effects[] = {0, 3, 9};
    int a = (int)(3 * u[0]), b = (int)(3 * u[1]);
    return effects[a] + (a == b ? 6 : 0) * (u[2] - .5);
}

/* Two choices among three words. The effects 0, 3, 9 have variance 14 (mean 4). If both words are equal, in a third of the
 * cases, u2 - ½ counts six-fold: 36/12/3 = 1. A ninth of 36/12 belongs to u2 alone, the rest to all three together. */
TEST(words_are_exact)
{
    make_inputs(3, 2, 3);
    struct ceduo_surface_fit f = fit_function(choose, 3, 256, 4, 0);
    const double first[] = {14 / 15., 0, 1 / 3. / 15}, total[] = {(14 + 2 / 3.) / 15, 2 / 3. / 15, 1 / 15.};
    for (size_t i = 0; i < 3; i++) {
        EXPECT_NEAR(f.first[i].value, first[i], 1e-6);
        EXPECT_NEAR(f.total[i].value, total[i], 1e-6);
    }
    EXPECT_NEAR(f.variance, 15, 1e-4);
    ceduo_surface_release(&f);
}

#define DRAWS  32 /* rows */
#define PLACES 7

static double rows[PLACES][DRAWS];

static double value_of_row(const double *u, size_t n)
{
    (void)n;
    return rows[0][(size_t)(DRAWS * u[0])];
}

/* A calibration with more values than functions uses the first ones. One with equal rows uses none, and alone gives no
 * shares. */
TEST(rows_of_a_calibration)
{
    static const double zeros[DRAWS] = {0};
    const double *draws[PLACES], *const constant_draws[] = {zeros};
    struct line_random random = {.state = 1};
    for (size_t k = 0; k < PLACES; k++) {
        for (size_t i = 0; i < DRAWS; i++)
            rows[k][i] = line_normal(&random);
        draws[k] = rows[k];
    }
    inputs[0] = (struct ceduo_input){.kind = CEDUO_INPUT_DRAWS, .places_count = PLACES, .draws_count = DRAWS, .draws = draws};
    inputs[1] =
        (struct ceduo_input){.kind = CEDUO_INPUT_DRAWS, .places_count = 1, .draws_count = DRAWS, .draws = constant_draws};
    struct ceduo_surface_fit f = fit_function(value_of_row, 2, 256, 1, 0);
    assert_true(f.enough_points);
    EXPECT_NEAR(f.first[0].value, 1, 1e-6);
    EXPECT_NEAR(f.total[0].value, 1, 1e-6);
    EXPECT_NEAR(f.total[1].value, 0, 1e-6);
    ceduo_surface_release(&f);
    inputs[0] = inputs[1];
    f = fit_function(value_of_row, 1, 256, 1, 0);
    assert_false(f.enough_points);
    assert_true(isnan(f.total[0].value));
    EXPECT(f.p95 - f.p5, >, 1);
    ceduo_surface_release(&f);
}

static double alternate(const double *u, size_t n)
{
    static int calls;
    (void)u, (void)n;
    return calls++ / CEDUO_SURFACE_GROUPS % 2;
}

/* It has no share, and does not change the shares of other inputs. Alone, as a choice of two words, it has no term that
 * varies. */
TEST(a_constant_input)
{
    make_inputs(3, 0, 0);
    last_constant = true;
    struct ceduo_surface_fit f = fit_function(linear, 3, 256, 1, 0);
    last_constant = false;
    const double share[] = {.2, .8, 0};
    for (size_t i = 0; i < 3; i++)
        EXPECT_NEAR(f.total[i].value, share[i], 1e-6);
    EXPECT_NEAR(f.q2, 1, 1e-9);
    ceduo_surface_release(&f);
    make_inputs(1, 1, 2);
    last_constant = true;
    f = fit_function(alternate, 1, 256, 1, 0);
    last_constant = false;
    assert_true(f.enough_points);
    EXPECT(f.total[0].value, ==, 0);
    EXPECT_NEAR(f.unexplained.value, 1, 1e-9);
    EXPECT_NEAR(f.p5, 0, 1e-9);
    EXPECT_NEAR(f.p95, 1, 1e-9);
    ceduo_surface_release(&f);
}

enum { FEW_POINTS = 128, FEW_INPUTS = 13 };

static struct ceduo_surface *open_few_points(const double *u)
{
    struct ceduo_surface *surface;
    EXPECT(ceduo_surface_open(inputs, FEW_INPUTS, u, FEW_POINTS, &surface), ==, CEDUO_OK);
    return surface;
}

/* Figures of one surface may depend on different inputs, and not all have products. Each has the same bits as alone. */
TEST(figures_of_one_surface)
{
    static double u[FEW_POINTS * FEW_INPUTS];
    static struct ceduo_replicates y[FEW_POINTS];
    make_inputs(FEW_INPUTS, 0, 0);
    EXPECT(ceduo_surface_points(1, FEW_POINTS, FEW_INPUTS, u), ==, CEDUO_OK);
    for (size_t p = 0; p < FEW_POINTS; p++)
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].value[g] = linear(u + p * FEW_INPUTS, FEW_INPUTS) + 99 * u[p * FEW_INPUTS + 10] * u[p * FEW_INPUTS + 12];
    struct ceduo_surface *together = open_few_points(u);
    for (size_t turn = 0; turn < 4; turn++) {
        size_t n = FEW_INPUTS - turn % 3;
        struct ceduo_surface *alone = open_few_points(u);
        struct ceduo_surface_fit f, g;
        bool uses[FEW_INPUTS];
        for (size_t i = 0; i < FEW_INPUTS; i++)
            uses[i] = i < n;
        const struct ceduo_surface_figure figure = {.y = y, .uses = uses, .lo = -INFINITY, .hi = INFINITY, .limit = NAN};
        EXPECT(ceduo_surface_fit(together, &figure, &f), ==, CEDUO_OK);
        EXPECT(ceduo_surface_fit(alone, &figure, &g), ==, CEDUO_OK);
        assert_true(f.enough_points);
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

static double two_inputs(const double *u, size_t n)
{
    (void)n;
    return 100 + 2 * u[0] + u[1];
}

/* Shares .8 and .2 within three errors for 20 seeds, though groups of the rocks differ by a constant. */
TEST(two_inputs_have_their_shares)
{
    double errors = 0;
    make_inputs(2, 0, 0);
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct ceduo_surface_fit f = fit_function(two_inputs, 2, 256, seed, .3 * sqrt(CEDUO_SURFACE_GROUPS / 2.));
        const double share[] = {.8, .2};
        for (size_t i = 0; i < 2; i++) {
            EXPECT_NEAR(f.first[i].value, share[i], 3 * f.first[i].se);
            EXPECT_NEAR(f.total[i].value, share[i], 3 * f.total[i].se);
            errors += f.total[i].se / 40;
        }
        EXPECT_NEAR(f.noise, .045, .005); /* standard error of the mean over groups */
        ceduo_surface_release(&f);
    }
    EXPECT(errors, <, .02); /* mean of all errors */
}

static double constant(const double *u, size_t n)
{
    (void)u, (void)n;
    return 7;
}

TEST(constants_have_no_shares)
{
    make_inputs(3, 0, 0);
    struct ceduo_surface_fit f = fit_function(constant, 3, 64, 1, 0);
    assert_true(isnan(f.first[0].value) && isnan(f.total[2].se) && isnan(f.width_if_known[1]));
    EXPECT_NEAR(f.mean, 7, 1e-12);
    EXPECT_NEAR(f.p95, 7, 1e-12);
    ceduo_surface_release(&f);
}

/* 95 % intervals of shares contain the truth in 90 to 97 % of the cases: many seeds of a function of 12 inputs with noise. */
TEST(errors_cover)
{
    make_inputs(12, 0, 0);
    double covered = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct ceduo_surface_fit f = fit_function(linear, 12, 256, seed, 3 * sqrt(CEDUO_SURFACE_GROUPS / 2.));
        for (size_t i = 0; i < 12; i++) {
            double share = (double)((i + 1) * (i + 1)) / 650;
            covered += (fabs(f.first[i].value - share) <= 1.96 * f.first[i].se) / (12. * SEEDS);
        }
        ceduo_surface_release(&f);
    }
    EXPECT(covered, >=, .90);
    EXPECT(covered, <=, .97);
}

/* Groups have coefficients 1 ± t of the first input, and 2 of the second. The first share, 1/5, changes by 2 * 1/5 * 4/5 times
 * the change of the mean of 1 ± t. This mean has variance t2 / 15, and Student's factor for 16 values. */
TEST(errors_of_rocks_are_those_of_a_mean)
{
    make_inputs(2, 0, 0);
    slope_change = 1e-3;
    struct ceduo_surface_fit f = fit_function(linear, 2, 256, 1, 0);
    EXPECT_NEAR(f.first[0].value, .2, 1e-5);
    EXPECT_NEAR(f.first[0].se / (.32 * slope_change / sqrt(15) * 2.13145 / 1.95996), 1, .01);
    slope_change = 0;
    ceduo_surface_release(&f);
}

/* ---- functions that no surface fits ---- */

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

TEST(misfit_is_unexplained)
{
    const double first[] = {0.3139, 0.4424, 0}, g_first[] = {0.7165, 0.1791, 0.0237, 0.0072, 0.0001, 0.0001, 0.0001, 0.0001};
    make_inputs(8, 0, 0);
    for (uint64_t seed = 1; seed <= 5; seed++) {
        struct ceduo_surface_fit f = fit_function(ishigami, 3, 1024, seed, 0);
        EXPECT(f.explained, <, .6);
        EXPECT(f.unexplained.value, >, .4);
        for (size_t i = 0; i < 3; i++)
            EXPECT(f.first[i].value, <=, first[i] + 3 * f.first[i].se);
        ceduo_surface_release(&f);
        f = fit_function(sobol_g, 8, 1024, seed, 0);
        EXPECT(f.explained, <, .95);
        EXPECT(f.unexplained.value, >, .03);
        for (size_t i = 0; i < 8; i++)
            EXPECT(f.first[i].value, <=, g_first[i] + 3 * f.first[i].se);
        ceduo_surface_release(&f);
    }
}

static double pseudo_random(const double *u, size_t n)
{
    (void)n;
    double turns = 43758.5453 * (1 + sin(12.9898 * u[0] + 78.233 * u[1] + 37.719 * u[2]));
    return turns - floor(turns);
}

/* Values without order, equal in all groups. With 12 inputs the terms are a third of 256 points; predictions of omitted points
 * are worse than the mean. */
TEST(chance_explains_nothing)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(pseudo_random, 12, 256, 1, 0);
    assert_true(f.enough_points && !f.linear);
    EXPECT_NEAR(f.variance, 1 / 12., 3 * sqrt(1 / 180. / 256)); /* 256 uniform values */
    EXPECT(f.explained, <, 0);
    ceduo_surface_release(&f);
}

/* Too few points for the terms give a range, but no shares. */
TEST(few_points_give_a_range)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(linear, 12, 29, 1, 0);
    assert_false(f.enough_points);
    assert_true(isnan(f.total[11].value));
    EXPECT_NEAR(f.p50, 44, 5);
    ceduo_surface_release(&f);
}

/* Enough points for terms of degree 1 only: shares of a linear figure are exact, 1, 4, 9 … of their sum. */
TEST(few_points_are_enough_for_lines)
{
    make_inputs(12, 0, 0);
    struct ceduo_surface_fit f = fit_function(linear, 12, 32, 1, 0);
    assert_true(f.enough_points);
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

/* Triangular distribution: p5 at sqrt(.1), p95 at 2 - sqrt(.1). If one input is known .9 remains; if the third, which has no
 * effect, all. */
TEST(range_and_remaining_width)
{
    make_inputs(3, 0, 0);
    struct ceduo_surface_fit f = fit_function(sum_of_two, 3, 1024, 1, .1);
    EXPECT_NEAR(f.p5, sqrt(.1), .02);
    EXPECT_NEAR(f.p50, 1, .02);
    EXPECT_NEAR(f.p95, 2 - sqrt(.1), .02);
    EXPECT_NEAR(f.width_if_known[0], .9, .02);
    EXPECT_NEAR(f.width_if_known[1], .9, .02);
    EXPECT_NEAR(f.width_if_known[2], 2 - 2 * sqrt(.1), .03);
    ceduo_surface_release(&f);
}

static double scaled(const double *u, size_t n)
{
    (void)n;
    return u[0] * (2 * u[1] - 1);
}

/* If U is known, 1.8 U remains of U(2V - 1), the width of its 90 % range: 0.9 in the mean over U. */
TEST(remaining_width_is_a_mean_over_the_known_input)
{
    make_inputs(2, 0, 0);
    struct ceduo_surface_fit f = fit_function(scaled, 2, 1024, 1, 0);
    EXPECT_NEAR(f.width_if_known[0], .9, .01);
    ceduo_surface_release(&f);
}

static double kinked(const double *u, size_t n)
{
    (void)n;
    return fmax(0, u[0] + u[1] - 1.5);
}

/* A share that is 0 almost everywhere. No surface is, but its range ends at 0. An eighth of the square is above 0, a twentieth
 * has U + V > 2 - sqrt(.1). */
TEST(ranges_stay_within_bounds)
{
    make_inputs(2, 0, 0);
    struct ceduo_surface_fit f = fit_function(kinked, 2, 256, 1, .2);
    EXPECT(f.p5, <, -1e-3);
    ceduo_surface_release(&f);
    lower_bound = 0;
    f = fit_function(kinked, 2, 256, 1, .2);
    lower_bound = -INFINITY;
    EXPECT(f.p5, ==, 0);
    EXPECT_NEAR(f.p95, .5 - sqrt(.1), .03);
    ceduo_surface_release(&f);
}

/* ---- errors of the range ---- */

static double ripple, turns[3]; /* a ripple that no surface fits */

static double rippled_sum(const double *u, size_t n)
{
    return sum_of_two(u, n) + ripple * sin(2 * M_PI * (turns[0] * u[0] + turns[1] * u[1] + turns[2] * u[2]));
}

/* Return the share of U + V + a·sin(2πW) up to x, with W in small steps. */
static double share_up_to(double x)
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
        *(share_up_to((lo + hi) / 2) < share ? &lo : &hi) = (lo + hi) / 2;
    return lo;
}

/* Coverage of 95 % intervals over many seeds: with and without a part that no surface fits, and with noise common to all points
 * or of each. Coverage is 95 % if the points sample that part like random points, and higher if they sample it more evenly. */
TEST(errors_of_the_range_cover)
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
        double low = value_at_share(.05), high = value_at_share(.95), share = share_up_to(limit = .9), covered = 0;
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            struct ceduo_surface_fit f = fit_function(rippled_sum, 3, 256, seed, cases[c].noise);
            covered += fabs(f.p5 - low) <= 1.96 * f.p5_se;
            covered += fabs(f.p95 - high) <= 1.96 * f.p95_se;
            covered += fabs(f.share_below.value - share) <= 1.96 * f.share_below.se;
            ceduo_surface_release(&f);
        }
        EXPECT(100 * covered / (3 * SEEDS), >=, 90);
        all += cases[c].even ? 0 : 100 * covered / (3 * SEEDS);
        n += !cases[c].even;
    }
    EXPECT(all / n, <=, 97);
    level = 0, limit = NAN;
}

/* ---- fitted values ---- */

/* Two figures with noise. The surface of 256 points has 6 terms: it keeps 6/256 of the noise variance, and little of the
 * residuals. */
TEST(fitted_values_have_little_noise)
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
            y[p].value[g] = two_inputs(u + 2 * (p % POINTS), 2) + noise * line_normal(&random);
    EXPECT(ceduo_surface_open(inputs, 2, u, POINTS, &surface), ==, CEDUO_OK);
    const struct ceduo_surface_figure figure = {.y = y, .lo = -INFINITY, .hi = INFINITY, .limit = NAN};
    EXPECT(ceduo_surface_values(surface, &figure, FIGURES, values, changes), ==, CEDUO_OK);
    for (size_t k = 0; k < FIGURES; k++) {
        double squares = 0;
        for (size_t p = 0; p < POINTS; p++)
            squares += pow(values[k * POINTS + p] - two_inputs(u + 2 * p, 2), 2) / POINTS;
        EXPECT(squares, <, .3 * noise * noise / CEDUO_SURFACE_GROUPS);
    }
    ceduo_surface_free(surface);
}

/* ---- many inputs ---- */

static double forty_inputs(const double *u, size_t n)
{
    return linear(u, n) + 400 * (u[38] - .5) * (u[39] - .5);
}

/* With forty inputs, the leading ones keep their products. */
TEST(leading_inputs_keep_their_products)
{
    make_inputs(40, 0, 0);
    struct ceduo_surface_fit f = fit_function(forty_inputs, 40, 512, 1, 0);
    double squares = 40 * 41 * 81 / 6. / 12, both = 400. * 400 / 144, all = squares + both;
    EXPECT_NEAR(f.total[38].value, (39 * 39 / 12. + both) / all, .01);
    EXPECT_NEAR(f.total[39].value, (40 * 40 / 12. + both) / all, .01);
    EXPECT_NEAR(f.first[39].value, 40 * 40 / 12. / all, .01);
    EXPECT_NEAR(f.total[20].value, 21 * 21 / 12. / all, .01);
    ceduo_surface_release(&f);
}
