/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse search: the goal evaluated at the result meets the target. */
#include "core/stand/adc.h"
#include "expect.h"

#include <float.h>
#include <math.h>

#include "ceduo/ceduo.h"
#include "line_scene.h"

#define GOALS           1000
#define EVALUATIONS_MAX 60 /* maximum evaluations */

/* A goal, and the values at which it was evaluated. */
struct asked {
    double (*goal)(const struct asked *asked, double value);
    double p[4];
    double values[EVALUATIONS_MAX];
    unsigned count;
};

static enum ceduo_status evaluate(void *context, double value, double *goal)
{
    struct asked *a = context;
    EXPECT(a->count, <, EVALUATIONS_MAX);
    for (unsigned i = 0; i < a->count; i++)
        EXPECT(a->values[i], !=, value); /* no value twice */
    a->values[a->count++] = value;
    *goal = a->goal(a, value);
    return CEDUO_OK;
}

static bool is_passing(const struct asked *a, double target, double value)
{
    return a->goal(a, value) <= target;
}

static struct ceduo_found find_with(struct asked *a, double lo, double hi, bool whole, double target, double tolerance)
{
    struct ceduo_find_def def = {.size = sizeof def,
                                 .lo = lo,
                                 .hi = hi,
                                 .whole = whole,
                                 .target = target,
                                 .goal = evaluate,
                                 .context = a,
                                 .tolerance = tolerance};
    struct ceduo_found found;
    a->count = 0;
    assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
    assert_int_equal(found.evaluations, a->count);
    if (found.found) {
        assert_true(is_passing(a, target, found.value));
        ROWS(EXPECT, (found.goal_at_value, ==, a->goal(a, found.value)), (found.value, >=, lo), (found.value, <=, hi));
        assert_true((!whole || found.value == floor(found.value)));
    } else {
        EXPECT_NAN(found.value, found.goal_at_value);
    }
    return found;
}

static struct ceduo_found find(struct asked *a, double lo, double hi, bool whole, double target)
{
    return find_with(a, lo, hi, whole, target, 0);
}

static bool was_evaluated(const struct asked *a, double value)
{
    for (unsigned i = 0; i < a->count; i++)
        if (a->values[i] == value)
            return true;
    return false;
}

/* Expect an evaluation that fails at most `width` from the value, on its failing side. */
static void expect_edge(const struct asked *a, const struct ceduo_found *found, double target, double width)
{
    double out = found->side == CEDUO_SIDE_SMALLEST ? -1 : 1, nearest = INFINITY;
    for (unsigned i = 0; i < a->count; i++) {
        double away = (a->values[i] - found->value) * out;
        if (away > 0 && away < nearest && !is_passing(a, target, a->values[i]))
            nearest = away;
    }
    if (!(nearest <= width * (1 + 1e-12)))
        fail_msg("%g: the next that fails is %g away, more than %g", found->value, nearest, width);
}

/* ---- the paper's example ---- */

static double adc_of_reserves(const struct asked *a, double per_ha)
{
    struct ceduo_stems trees = {.per_ha = per_ha, .dbh = a->p[0], .height = 12, .volume = NAN, .age = NAN};
    struct ceduo_stand stand = {
        .system = CEDUO_SYSTEM_SIMPLE_COPPICE, .species = -1, .trees_count = per_ha > 0, .trees = &trees, .u = NAN};
    struct ceduo_adc adc = ceduo_adc(&stand, a->p[1]);
    return ceduo_adc_value(&adc, ceduo_adc_rule(&stand, a->p[1], CEDUO_RULE_AUTO));
}

/* 60 reserves of 20 cm are some 190 m apart (Ciabocco et al. 2009); 30 m need 379. */
TEST(reserves_for_30_m)
{
    static const struct {
        double b;
        double needed;
    } rocks[] = {{.56, 439}, {.68, 379}, {.80, 334}};
    for (size_t i = 0; i < LENGTH(rocks); i++) {
        struct asked a = {.goal = adc_of_reserves, .p = {.20, rocks[i].b}};
        assert_false(is_passing(&a, 30, 60));
        struct ceduo_found found = find(&a, 0, 5000, true, 30); /* infinite at 0 */
        assert_true(found.found);
        assert_true(found.monotone);
        assert_false(found.whole_range);
        EXPECT_IS(found, (side, CEDUO_SIDE_SMALLEST), (value, rocks[i].needed));
        assert_true(was_evaluated(&a, rocks[i].needed - 1));
        assert_false(is_passing(&a, 30, rocks[i].needed - 1));
        EXPECT(found.evaluations, <, 20);
        found = find(&a, 0, 5000, false, 30);
        assert_true(found.found);
        assert_true(found.monotone);
        EXPECT_NEAR(found.value, 1e4 / (30 * (rocks[i].b + .2)), 5000 * 1e-9);
        expect_edge(&a, &found, 30, 5000 * 1e-9);
    }
}

/* ---- any monotone goal ---- */

static struct line_random random_numbers = {.state = 1};

static double uniform(double lo, double hi)
{
    return line_uniform(&random_numbers, lo, hi);
}

/* p[0] is its sign and scale, p[1] its kind, p[2] and p[3] its shape. Values from 0 to 1000. */
static double curve(const struct asked *a, double value)
{
    double x = value / 1000, shape = a->p[2];
    switch ((int)a->p[1]) {
    case 0:
        return a->p[0] * pow(x, shape);
    case 1:
        return a->p[0] * expm1(shape * x);
    case 2:
        return a->p[0] / (1 + exp(-20 * shape * (x - a->p[3]))); /* flat, steep, flat */
    case 3:
        return a->p[0] * -1 / (x + 1e-3 * shape);
    case 4:
        return a->p[0] * log(x); /* infinite at 0 */
    case 5:
        return a->p[0] * floor(x * 20 * shape); /* steps */
    default:
        return a->p[0] * (x + (x < a->p[3] ? 0 : 10)); /* a jump */
    }
}

TEST(inverse_and_forward_agree)
{
    unsigned max = 0, sum = 0, crossings = 0;
    for (int i = 0; i < GOALS; i++) {
        struct asked a = {.goal = curve,
                          .p = {uniform(.1, 100) * (i % 2 ? -1 : 1), floor(uniform(0, 7)), uniform(.2, 4), uniform(0, 1)}};
        bool whole = uniform(0, 1) < .5;
        double lo = floor(uniform(0, 400)), hi = floor(uniform(lo, 1000));
        double target = curve(&a, uniform(lo - .05 * (hi - lo), hi + .05 * (hi - lo)));
        if (isnan(target)) /* for a value below 0 */
            target = curve(&a, (lo + hi) / 2);
        struct ceduo_found found = find(&a, lo, hi, whole, target);
        bool at_lo = is_passing(&a, target, lo), at_hi = is_passing(&a, target, hi);
        assert_true(found.monotone);
        assert_int_equal(found.found, at_lo || at_hi);
        assert_int_equal(found.whole_range, at_lo && at_hi);
        if (at_lo && at_hi) {
            EXPECT_IS(found, (value, lo), (side, CEDUO_SIDE_SMALLEST));
        } else if (found.found) {
            assert_int_equal(found.side, at_hi ? CEDUO_SIDE_SMALLEST : CEDUO_SIDE_LARGEST);
            expect_edge(&a, &found, target, whole ? 1 : 1e-9 * (hi - lo));
            crossings++;
            sum += found.evaluations;
        }
        max = found.evaluations > max ? found.evaluations : max;
    }
    EXPECT(crossings, >, GOALS / 2);
    print_message("%u crossings: %.1f evaluations each, %u at most\n", crossings, (double)sum / crossings, max);
}

static double line(const struct asked *a, double value)
{
    return a->p[0] * value;
}

static double parabola(const struct asked *a, double value)
{
    double x = value - a->p[0];
    return a->p[1] * x * x;
}

TEST(a_value_is_as_near_as_the_tolerance)
{
    struct asked a = {.goal = line, .p = {3}};
    struct ceduo_found found = find(&a, 0, 1, false, 1);
    EXPECT_NEAR(found.value, 1. / 3, 1e-9);
    EXPECT(found.side, ==, CEDUO_SIDE_LARGEST);
    EXPECT(found.evaluations, ==, 2 + 30); /* 2^-30 < 1e-9 */
    a = (struct asked){.goal = parabola, .p = {0, 1}};
    found = find_with(&a, 0, 10, false, 2, 1e-13);
    EXPECT_NEAR(found.value, sqrt(2), 1e-12);
    EXPECT(found.evaluations, ==, 2 + 44);
    expect_edge(&a, &found, 2, 1e-12);
    found = find_with(&a, 0, 10, false, 2, .1); /* no better than required */
    EXPECT_NEAR(found.value, sqrt(2), 1);
    EXPECT(found.evaluations, ==, 2 + 4);
}

/* ---- steps, jumps ---- */

static double steps(const struct asked *a, double value)
{
    return floor(value * a->p[0]) * a->p[1];
}

static double cliff(const struct asked *a, double value)
{
    return value < a->p[0] ? 1e-9 : 1e9; /* as asymmetric as possible */
}

TEST(steps_and_jumps)
{
    struct asked a = {.goal = steps, .p = {.37, -2}};
    struct ceduo_found found = find(&a, 0, 100, false, -10); /* floor(.37 v) >= 5 */
    assert_true(found.found);
    assert_true(found.monotone);
    EXPECT_NEAR(found.value, 5 / .37, 1e-7);
    expect_edge(&a, &found, -10, 1e-7);
    found = find(&a, 0, 100, true, -10);
    EXPECT(found.value, ==, 14);
    assert_true(was_evaluated(&a, 13));
    a = (struct asked){.goal = cliff, .p = {.123456}};
    found = find(&a, 0, 1, false, 1e-6);
    EXPECT(found.side, ==, CEDUO_SIDE_LARGEST);
    EXPECT(found.value, <, .123456);
    expect_edge(&a, &found, 1e-6, 1e-9);
    EXPECT(found.evaluations, <=, 55);
    found = find(&a, 0, 1, false, 1e-9); /* the whole lower step equals the target */
    assert_true(found.found);
    EXPECT(found.value, <, .123456);
    expect_edge(&a, &found, 1e-9, 1e-9);
}

TEST(large_whole_numbers)
{
    struct asked a = {.goal = line, .p = {-1}};
    struct ceduo_found found = find(&a, 0, 1e12, true, -123456789012);
    EXPECT(found.value, ==, 123456789012);
    assert_true(was_evaluated(&a, 123456789011));
    EXPECT(found.evaluations, <, 45);
    found = find(&a, .5, 3.5, true, -2.5); /* 1…3 */
    EXPECT(found.value, ==, 3);
    assert_true(was_evaluated(&a, 2));
    EXPECT(found.evaluations, <=, 3);
    found = find(&a, 2.2, 2.8, true, 0);
    assert_false(found.found);
    EXPECT(found.evaluations, ==, 0);
    assert_true(isnan(found.nearest));
}

/* ---- goals that are not monotone ---- */

TEST(goals_that_are_not_monotone)
{
    const struct {
        double middle, sign, target, edge, whole_edge;
    } rows[] = {{60, 1, 402, 60 - sqrt(402), 40},    /* is_passing between failing ends */
                {40, -1, -402, 40 + sqrt(402), 61}}; /* fails between passing ends */
    for (size_t i = 0; i < 2 * LENGTH(rows); i++) {
        bool whole = i % 2;
        struct asked a = {.goal = parabola, .p = {rows[i / 2].middle, rows[i / 2].sign}};
        struct ceduo_found found = find(&a, 0, 100, whole, rows[i / 2].target);
        assert_true(found.found);
        assert_false(found.monotone);
        assert_false(found.whole_range);
        EXPECT(found.side, ==, CEDUO_SIDE_SMALLEST);
        EXPECT_NEAR(found.value, (whole ? rows[i / 2].whole_edge : rows[i / 2].edge), 1e-7);
        expect_edge(&a, &found, rows[i / 2].target, whole ? 1 : 1e-7);
    }
    struct asked a = {.goal = parabola, .p = {60, 1}};
    struct ceduo_found found = find(&a, 0, 60, true, 2500); /* one side alone does not show the reversal */
    assert_true(found.monotone);
    EXPECT(found.value, ==, 10);
}

static double noisy(const struct asked *a, double value)
{
    return 1 + a->p[0] * sin(value);
}

TEST(rounding_is_no_rotation)
{
    struct asked a = {.goal = noisy, .p = {1e-14}};
    assert_true(find(&a, 0, 100, false, 0).monotone);
    a.p[0] = 1e-10;
    assert_false(find(&a, 0, 100, false, 0).monotone);
}

TEST(a_search_without_a_passing_value)
{
    struct asked a = {.goal = parabola, .p = {35, 1}};
    struct ceduo_found found = find(&a, 0, 90, false, -1); /* evaluated: every 10 */
    ROWS(assert_false, (found.found), (found.monotone), (found.whole_range));
    EXPECT_IS(found, (evaluations, 2 + CEDUO_FIND_SCAN), (nearest, 30));
    EXPECT(found.goal_at_nearest, ==, 25); /* 40 is equally near */
    found = find(&a, 0, 3, true, 3);
    assert_false(found.found);
    assert_true(found.monotone);
    EXPECT_IS(found, (evaluations, 4), (nearest, 3));
    found = find(&a, 0, 90, false, NAN);
    assert_false(found.found);
}

TEST(a_search_with_only_passing_values)
{
    struct asked a = {.goal = line, .p = {-1}};
    struct ceduo_found found = find(&a, 5, 90, false, 0);
    ROWS(assert_true, (found.found), (found.whole_range), (found.monotone));
    EXPECT_IS(found, (value, 5), (side, CEDUO_SIDE_SMALLEST), (nearest, 90), (goal_at_nearest, -90));
    found = find(&a, 7, 7, false, 0);
    assert_true(found.found);
    assert_true(found.whole_range);
    EXPECT_IS(found, (value, 7), (evaluations, 1));
    found = find(&a, 5, 90, true, INFINITY);
    assert_true(found.whole_range);
    EXPECT(found.value, ==, 5);
}

/* Numbers beyond 10^16 are 2 apart: between two neighbours nothing is evaluated. */
TEST(neighbouring_numbers)
{
    struct asked a = {.goal = line, .p = {1}};
    const double lo = 1e16;
    for (int i = 0; i < 2; i++) {
        struct ceduo_found found = find_with(&a, lo, lo + 4, false, lo + 2 * i, DBL_EPSILON);
        EXPECT_IS(found, (value, lo + 2 * i), (side, CEDUO_SIDE_LARGEST), (evaluations, 3));
        expect_edge(&a, &found, lo + 2 * i, 2);
    }
}

/* ---- goals that are not finite ---- */

static double broken_below(const struct asked *a, double value)
{
    return value < a->p[0] ? a->p[1] : 100 - value;
}

TEST(goals_that_are_not_finite)
{
    static const double bad[] = {INFINITY, NAN, -INFINITY};
    for (size_t i = 0; i < LENGTH(bad); i++) {
        struct asked a = {.goal = broken_below, .p = {20.5, bad[i]}};
        struct ceduo_found found = find(&a, 0, 100, false, 50);
        assert_true(found.found);
        EXPECT(found.monotone, ==, (i == 0));
        EXPECT_NEAR(found.value, 50, 1e-7);
        EXPECT(found.side, ==, CEDUO_SIDE_SMALLEST);
        expect_edge(&a, &found, 50, 1e-7);
        found = find(&a, 0, 100, false, 90); /* is_passing wherever it is a number; -inf from 0 on */
        assert_true(found.found);
        EXPECT(found.whole_range, ==, (i == 2));
        EXPECT_NEAR(found.value, (i == 2 ? 0 : 20.5), 1e-7);
    }
    struct asked a = {.goal = broken_below, .p = {1e9, INFINITY}};
    struct ceduo_found found = find(&a, 3, 100, false, 50);
    assert_false(found.found);
    assert_true(found.monotone);
    EXPECT_IS(found, (nearest, 3), (goal_at_nearest, INFINITY));
    a.p[1] = NAN;
    found = find(&a, 3, 100, false, INFINITY);
    assert_false(found.found);
    assert_false(found.monotone);
    EXPECT_NAN(found.nearest, found.goal_at_nearest);
}

/* Waves and steps, infinite or NaN if p[3] asks for it. */
static double wild(const struct asked *a, double value)
{
    double wave = sin(a->p[0] * value) + sin(a->p[1] * value * value);
    if (fabs(wave) < .3 * a->p[3])
        return wave < 0 ? NAN : INFINITY;
    return a->p[2] > 0 ? floor(wave / a->p[2]) : wave;
}

TEST(any_goal_at_all)
{
    unsigned count[2] = {0, 0};
    for (int i = 0; i < GOALS; i++) {
        struct asked a = {.goal = wild, .p = {uniform(0, .2), uniform(0, .01), uniform(-.5, .5), floor(uniform(0, 2))}};
        bool whole = uniform(0, 1) < .5;
        double lo = floor(uniform(-50, 0)), hi = floor(uniform(0, 50)), target = uniform(-2.5, 2);
        struct ceduo_found found = find(&a, lo, hi, whole, target);
        bool has_pass = false;
        for (unsigned j = 0; j < a.count; j++)
            has_pass |= is_passing(&a, target, a.values[j]);
        assert_int_equal(found.found, has_pass);
        if (found.found && !found.whole_range)
            expect_edge(&a, &found, target, whole ? 1 : 1e-9 * (hi - lo));
        count[found.found]++;
    }
    EXPECT(count[false], >, GOALS / 10);
    EXPECT(count[true], >, GOALS / 10);
}

/* ---- early end ---- */

static enum ceduo_status fails_at_5(void *context, double value, double *goal)
{
    unsigned *count = context;
    *goal = value;
    return ++*count == 5 ? CEDUO_NO_MEMORY : CEDUO_OK;
}

static enum ceduo_status cancels_at_5(void *context, double value, double *goal)
{
    struct cancelled {
        atomic_bool cancel;
        unsigned count;
    } *c = context;
    *goal = value;
    c->cancel = ++c->count == 5;
    return CEDUO_OK;
}

TEST(a_search_ends_if_the_goal_fails_or_is_cancelled)
{
    unsigned count = 0;
    struct ceduo_find_def def = {
        .size = sizeof def, .hi = 1e6, .whole = true, .target = 12345, .goal = fails_at_5, .context = &count};
    struct ceduo_found found;
    for (int whole = 0; whole < 2; whole++) {
        count = 0;
        def.whole = whole;
        assert_int_equal(ceduo_find(&def, &found), CEDUO_NO_MEMORY);
        assert_false(found.found);
        EXPECT(found.evaluations, ==, 4);
        assert_true(isnan(found.value));
        EXPECT(found.nearest, ==, 0);
    }
    struct {
        atomic_bool cancel;
        unsigned count;
    } cancelled = {false, 0};
    def.goal = cancels_at_5;
    def.context = &cancelled;
    def.cancel = &cancelled.cancel;
    assert_int_equal(ceduo_find(&def, &found), CEDUO_CANCELLED);
    assert_false(found.found);
    EXPECT(found.evaluations, ==, 5);
    EXPECT(cancelled.count, ==, 5);
}
