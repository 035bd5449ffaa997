/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol' indices of functions whose indices are known in closed form. */
#include "expect.h"

#include <stdlib.h>

#include "ceduo/doubt.h"

#define POINTS 1024

typedef double function(const double *u, size_t n);

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
    double product = 1;
    for (size_t i = 0; i < n; i++)
        product *= (fabs(4 * u[i] - 2) + g_weights[i]) / (1 + g_weights[i]);
    return product;
}

static double linear(const double *u, size_t n)
{
    double sum = 5;
    for (size_t i = 0; i < n; i++)
        sum += (double)(i + 1) * u[i];
    return sum;
}

/* A small generator of the test's own, for noise: splitmix64. */
static double normal(uint64_t *state)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        uint64_t z = *state += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        sum += (double)((z ^ z >> 31) >> 11) * 0x1p-53;
    }
    return sum;
}

static struct ceduo_indices indices_of(function *f, struct ceduo_design d, double noise)
{
    size_t evaluations = ceduo_design_evaluations(&d);
    double *u = malloc(evaluations * d.inputs * sizeof *u);
    struct ceduo_halves *y = malloc(evaluations * sizeof *y);
    struct ceduo_indices indices;
    uint64_t state = d.seed;
    assert_non_null(u);
    assert_non_null(y);
    EXPECT(ceduo_design_fill(&d, u), ==, CEDUO_OK);
    for (size_t e = 0; e < evaluations; e++)
        for (int h = 0; h < 2; h++)
            y[e].half[h] = f(u + e * d.inputs, d.inputs) + (noise > 0 ? noise * normal(&state) : 0);
    EXPECT(ceduo_design_read(&d, y, &indices), ==, CEDUO_OK);
    free(u);
    free(y);
    return indices;
}

static void expect_shares(const struct ceduo_share *found, const double *known, size_t n)
{
    for (size_t i = 0; i < n; i++)
        EXPECT_NEAR(found[i].value, known[i], 3 * found[i].se);
}

/* ---- closed forms ---- */

static void ishigami_has_its_indices(void **state)
{
    (void)state;
    const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 1, 3, NULL}, 0);
    expect_shares(found.first, first, 3);
    expect_shares(found.total, total, 3);
    double variance = 49.0 / 8 + 0.1 * pow(M_PI, 4) / 5 + 0.01 * pow(M_PI, 8) / 18 + 0.5; /* a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2 */
    EXPECT_NEAR(found.mean, 3.5, 3 * sqrt(variance / (2 * POINTS)));                      /* a/2 */
    EXPECT_NEAR(found.variance, variance, 3 * variance * sqrt(2.5 / (2 * POINTS)));       /* kurtosis 3.5 */
}

static void g_function_has_its_indices(void **state)
{
    (void)state;
    const double first[] = {0.7165, 0.1791, 0.0237, 0.0072, 0.0001, 0.0001, 0.0001, 0.0001};
    struct ceduo_indices found = indices_of(sobol_g, (struct ceduo_design){8, POINTS, 2, 8, NULL}, 0);
    for (size_t i = 0; i < 8; i++)
        EXPECT_NEAR(found.first[i].value, first[i], 3 * found.first[i].se + 5e-5); /* the figures have four decimals */
}

static void linear_function_has_shares_of_variance(void **state)
{
    (void)state;
    struct ceduo_indices found = indices_of(linear, (struct ceduo_design){4, POINTS, 3, 4, NULL}, 0);
    const double known[] = {1 / 30.0, 4 / 30.0, 9 / 30.0, 16 / 30.0};
    expect_shares(found.first, known, 4);
    expect_shares(found.total, known, 4);
    EXPECT_NEAR(found.variance, 30 / 12.0, 3 * 30 / 12.0 * sqrt(2.0 / (2 * POINTS)));
}

/* x1 and x3 act together; as one input they have what x2 leaves. */
static void inputs_of_a_group_move_together(void **state)
{
    (void)state;
    const size_t group[] = {0, 1, 0};
    const double known[] = {0.5576, 0.4424};
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 4, 2, group}, 0);
    expect_shares(found.first, known, 2);
    expect_shares(found.total, known, 2);
}

/* ---- errors ---- */

/* Of 200 seeds, 95 % intervals hold the truth in 90 to 98 %. */
static void errors_cover(void **state)
{
    (void)state;
    const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    double inside[2] = {0};
    for (uint64_t seed = 0; seed < 200; seed++) {
        struct ceduo_indices f = indices_of(ishigami, (struct ceduo_design){3, POINTS, seed, 3, NULL}, 0);
        for (int i = 0; i < 3; i++) {
            inside[0] += (fabs(f.first[i].value - first[i]) <= 1.96 * f.first[i].se) / 600.0;
            inside[1] += (fabs(f.total[i].value - total[i]) <= 1.96 * f.total[i].se) / 600.0;
        }
    }
    for (int k = 0; k < 2; k++) {
        EXPECT(inside[k], >=, 0.90);
        EXPECT(inside[k], <=, 0.98);
    }
}

static double constant(const double *u, size_t n)
{
    (void)u, (void)n;
    return 7;
}

/* The halves are of the same rocks at every point: a constant between them is neither noise nor variance. */
static void halves_may_differ_by_a_constant(void **state)
{
    (void)state;
    const double slopes[] = {2, 1}, known[] = {.8, .2};
    for (uint64_t seed = 1; seed <= 10; seed++) {
        struct ceduo_design d = {.inputs = 2, .points = 256, .seed = seed, .groups = 2};
        double u[256 * 4 * 2];
        struct ceduo_halves y[256 * 4];
        struct ceduo_indices found;
        EXPECT(ceduo_design_fill(&d, u), ==, CEDUO_OK);
        for (size_t e = 0; e < 256 * 4; e++)
            for (int h = 0; h < 2; h++)
                y[e].half[h] = 100 + slopes[0] * u[2 * e] + slopes[1] * u[2 * e + 1] + (h ? .9 : -.9);
        EXPECT(ceduo_design_read(&d, y, &found), ==, CEDUO_OK);
        EXPECT_NEAR(found.variance, 5. / 12, .03);
        EXPECT_NEAR(found.noise, 0, 1e-12);
        expect_shares(found.total, known, 2);
        expect_shares(found.first, known, 2);
    }
}

/* Noise of the rocks is not taken for an effect: not of a figure that depends on nothing, nor beside real effects. */
static void noise_is_taken_off(void **state)
{
    (void)state;
    const double total[] = {0.5576, 0.4424, 0.2437};
    double near = 0;
    for (uint64_t seed = 0; seed < 50; seed++) {
        struct ceduo_indices nothing = indices_of(constant, (struct ceduo_design){3, 256, seed, 3, NULL}, 2);
        for (int i = 0; i < 3; i++)
            near += (fabs(nothing.total[i].value) <= 2 * nothing.total[i].se) / 150.0;
    }
    EXPECT(near, >=, 0.88); /* 95 %, less 3 standard errors */
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 5, 3, NULL}, 2);
    expect_shares(found.total, total, 3);
    EXPECT_NEAR(found.noise, 2, 0.2); /* of the mean of two halves of variance 4 */
}

/* The doubt of a density with a large error: within 1 % of its mean, where a uniform law cut at 0 was 17 and 37 % above. */
static void gamma_laws_keep_the_mean(void **state)
{
    (void)state;
    for (double ratio = .34; ratio <= 1; ratio += .06) {
        const struct ceduo_input input = {.kind = CEDUO_INPUT_GAMMA, .mean = 50, .sd = 50 * ratio};
        double sum = 0, squares = 0;
        for (int i = 0; i < 2000; i++) {
            double x = ceduo_input_quantile(&input, (i + .5) / 2000);
            EXPECT(x, >, 0);
            sum += x / 2000;
            squares += x * x / 2000;
        }
        EXPECT_NEAR(sum, 50, .5);
        EXPECT_NEAR(sqrt(squares - sum * sum), 50 * ratio, .05 * 50 * ratio); /* what is cut off */
    }
}

/* A figure without noise that depends on nothing has no indices. */
static void nothing_varies(void **state)
{
    (void)state;
    struct ceduo_indices found = indices_of(constant, (struct ceduo_design){3, 64, 1, 3, NULL}, 0);
    assert_true(isnan(found.first[0].value) && isnan(found.total[2].se));
    EXPECT(found.mean, ==, 7);
    EXPECT(found.variance, ==, 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(ishigami_has_its_indices),
    cmocka_unit_test(g_function_has_its_indices),
    cmocka_unit_test(linear_function_has_shares_of_variance),
    cmocka_unit_test(inputs_of_a_group_move_together),
    cmocka_unit_test(errors_cover),
    cmocka_unit_test(noise_is_taken_off),
    cmocka_unit_test(halves_may_differ_by_a_constant),
    cmocka_unit_test(gamma_laws_keep_the_mean),
    cmocka_unit_test(nothing_varies),
};

int main(void)
{
    return cmocka_run_group_tests(tests, NULL, NULL);
}
