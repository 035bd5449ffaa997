/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said of figures: an interval holds all that lies in it once it is rounded, and an option is worse than another
 * only where they are more than two standard errors apart; what was not simulated is not compared. */
#include "expect.h"

#include <math.h>
#include <string.h>

#include "physics/line_scene.h"
#include "study/compare.h"
#include "view/words.h"

#define OPTIONS 3

/* Three options without stems, of which no more is known than what a test says: the figures of each, and the errors of
 * their differences to the first. */
static struct line_scene scene;
static struct ceduo_option options[OPTIONS];
static struct ceduo_arrivals arrivals[OPTIONS];
static struct ceduo_difference differences[OPTIONS];

static void open_scene(double accepted)
{
    static char names[OPTIONS][2] = {"a", "b", "c"};
    static const double x[] = {0, 100}, z[] = {0, -50};
    line_scene_init(&scene, 2, x, z, (struct line_ground){.3, .8, .5}, .5, CEDUO_LAW_LUMPED);
    scene.control = (struct ceduo_control){.x = 80, .x_given = 80, .accepted = accepted, .measured_speed = NAN};
    scene.scene.controls_count = 1;
    scene.scene.options = options;
    scene.scene.options_count = OPTIONS;
    memset(arrivals, 0, sizeof arrivals);
    memset(differences, 0, sizeof differences);
    for (int i = 0; i < OPTIONS; i++) {
        options[i] = (struct ceduo_option){.name = names[i]};
        arrivals[i].released = arrivals[i].reached = 1000;
        arrivals[i].reach_probability = 1;
        arrivals[i].exceed_probability = isnan(accepted) ? NAN : .5;
    }
}

/* Of the first `known` options something is known. */
static struct ceduo_result *assess_first(size_t known)
{
    struct ceduo_flown flown[OPTIONS];
    const struct ceduo_flown *wooded[OPTIONS];
    struct ceduo_result *result;
    for (size_t i = 0; i < OPTIONS; i++) {
        flown[i] =
            (struct ceduo_flown){.rocks = 1000, .controls = scene.scene.controls_count, .arrivals = &arrivals[i]};
        wooded[i] = i < known ? &flown[i] : NULL;
    }
    assert_int_equal(ceduo_result_assess(&scene.scene, &flown[0], wooded, differences, &result), CEDUO_OK);
    return result;
}

static struct ceduo_result *assess(void)
{
    return assess_first(OPTIONS);
}

/* ---- intervals ---- */

static void expect_said(double share, double lo, double hi, const char *wanted)
{
    struct text text = {0};
    open_scene(50e3);
    arrivals[0].exceed_probability = share;
    arrivals[0].exceed_lo = lo;
    arrivals[0].exceed_hi = hi;
    struct ceduo_result *result = assess();
    ceduo_words_energy(&text, result, 0, 0);
    if (!strstr(text.bytes, wanted))
        fail_msg("'%s' is missing in: %s", wanted, text.bytes);
    ceduo_text_free(&text);
    ceduo_result_free(result);
}

/* Of 1000, the lower end is rounded down and the upper one up; what is whole stays. */
static void an_interval_is_rounded_outward(void **state)
{
    (void)state;
    expect_said(.5, .4699, .5301,
                " 500 (469\xe2\x80\x93"
                "531) of 1000 ");
    expect_said(.0001, 0, .0004,
                " 0 (0\xe2\x80\x93"
                "1) of 1000 ");
    expect_said(.9999, .9996, 1,
                " 1000 (999\xe2\x80\x93"
                "1000) of 1000 ");
    expect_said(.5, .46875, .53125,
                " 500 (468\xe2\x80\x93"
                "532) of 1000 ");
    expect_said(.5, .25, .75,
                " 500 (250\xe2\x80\x93"
                "750) of 1000 ");
}

/* ---- which is worse ---- */

static bool is_worse(size_t option, size_t than)
{
    struct ceduo_result *result = assess();
    bool worse = ceduo_compare_worse(result, option, than);
    ceduo_result_free(result);
    return worse;
}

static void expect_best(const char *wanted)
{
    struct text text = {0};
    struct ceduo_result *result = assess();
    ceduo_words_best(&text, result);
    assert_string_equal(ceduo_text_string(&text), wanted);
    ceduo_text_free(&text);
    ceduo_result_free(result);
}

/* The figure of an option by energy, and the error of its difference to the first: shares where it is said what a place
 * bears, otherwise energies. */
static void set(size_t option, bool shares, double value, double se)
{
    *(shares ? &arrivals[option].exceed_probability : &arrivals[option].energy_per_released) = value;
    *(shares ? &differences[option].exceed_probability.se : &differences[option].energy_per_released.se) = se;
}

/* Errors of 3 and 4 to the first make 5 of one to the other: 10 apart is not worse, and the next double is. All are
 * multiples of the same power of two, so that no rounding is in it. */
static void two_standard_errors_apart_is_not_worse(void **state)
{
    (void)state;
    for (int shares = 0; shares < 2; shares++) {
        const double unit = shares ? 1. / 64 : 1024, base = 20 * unit;
        open_scene(shares ? 50e3 : NAN);
        EXPECT(hypot(3 * unit, 4 * unit), ==, 5 * unit);
        set(0, shares, base, 0);
        set(1, shares, base, 3 * unit);
        set(2, shares, base + 10 * unit, 4 * unit);
        assert_false(is_worse(2, 1) || is_worse(1, 2));
        set(2, shares, nextafter(base + 10 * unit, INFINITY), 4 * unit);
        assert_true(is_worse(2, 1));
        assert_false(is_worse(1, 2));
        set(2, shares, nextafter(base + 10 * unit, 0), 4 * unit);
        assert_false(is_worse(2, 1) || is_worse(1, 2));
        set(2, shares, base + 8 * unit, 4 * unit); /* beside the first its own error counts alone */
        assert_false(is_worse(2, 0) || is_worse(0, 2));
        set(2, shares, nextafter(base + 8 * unit, INFINITY), 4 * unit);
        assert_true(is_worse(2, 0));
        assert_false(is_worse(2, 1));
    }
}

static void nothing_is_best_within_two_standard_errors(void **state)
{
    (void)state;
    open_scene(50e3);
    set(0, true, .25 + .0625, 0);
    set(1, true, .25, .03125);
    set(2, true, .25 + .0625, .03125);
    expect_best("");
    set(0, true, nextafter(.25 + .0625, 1), 0);
    expect_best(
        "By energy 'b' is best, though not clearly before all others; contact does not tell the options apart.");
    set(2, true, .5, .03125);
    expect_best("By energy 'b' is best; contact does not tell the options apart.");
    set(0, true, .25 + .0625, 0);
    expect_best(
        "By energy 'b' is best, though not clearly before all others; contact does not tell the options apart.");
}

/* ---- what is compared ---- */

/* The difference of two shares has a margin of 1.96 standard errors; of two that are both 0, whose error is 0, it has
 * Wilson's: none of n is at most z2/(n + z2). */
static void a_difference_of_nothing_has_the_margin_of_a_share(void **state)
{
    (void)state;
    double half;
    open_scene(50e3);
    set(0, true, 0, 0);
    set(1, true, 0, 0);
    set(2, true, .25, .03125);
    differences[2].exceed_probability.mean = .25;
    struct ceduo_result *result = assess();
    EXPECT(ceduo_compare_difference(result, 1, &half), ==, 0);
    EXPECT_NEAR(half, CEDUO_Z95 * CEDUO_Z95 / (1000 + CEDUO_Z95 * CEDUO_Z95), 1e-15);
    EXPECT(ceduo_compare_difference(result, 2, &half), ==, .25);
    EXPECT(half, ==, CEDUO_Z95 * .03125);
    EXPECT(ceduo_compare_share(result, 2, &half), ==, .25);
    EXPECT_NEAR(half, CEDUO_Z95 * sqrt(.25 * .75 / 1000), 1e-15);
    ceduo_result_free(result);
}

static void what_was_not_simulated_is_not_compared(void **state)
{
    (void)state;
    double half = 0;
    open_scene(50e3);
    differences[2] = (struct ceduo_difference){{NAN, NAN}, {NAN, NAN}, {NAN, NAN}};
    struct ceduo_result *result = assess_first(2);
    assert_true(isnan(ceduo_compare_share(result, 2, &half)) && isnan(half));
    half = 0;
    assert_true(isnan(ceduo_compare_difference(result, 2, &half)) && isnan(half));
    assert_false(ceduo_compare_worse(result, 2, 0) || ceduo_compare_worse(result, 0, 2));
    assert_false(ceduo_compare_best(result).known);
    ceduo_result_free(result);
}

static void expect_known(bool wanted)
{
    struct ceduo_result *result = assess();
    assert_int_equal(ceduo_compare_best(result).known, wanted);
    ceduo_result_free(result);
}

/* It takes two options, rocks among their stems and a place where they are counted. */
static void the_best_of_nothing_is_not_known(void **state)
{
    (void)state;
    open_scene(50e3);
    expect_known(true);
    scene.scene.options_count = 1;
    expect_known(false);
    scene.scene.options_count = OPTIONS;
    scene.scene.controls_count = 0;
    expect_known(false);
    scene.scene.controls_count = 1;
    scene.scene.simulation.contact_model = CEDUO_INDEX;
    expect_known(false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_interval_is_rounded_outward),
        cmocka_unit_test(two_standard_errors_apart_is_not_worse),
        cmocka_unit_test(nothing_is_best_within_two_standard_errors),
        cmocka_unit_test(a_difference_of_nothing_has_the_margin_of_a_share),
        cmocka_unit_test(what_was_not_simulated_is_not_compared),
        cmocka_unit_test(the_best_of_nothing_is_not_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
