/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparison of observations with simulated rocks, in closed form. All rocks are equal: they fly over level ground before they
 * strike it, or roll down a smooth slope. */
#include "expect.h"
#include "local.h"
#include "study/observe.h"

#include <gsl/gsl_statistics_double.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "unit/ground.h"

#define ROCKS   100
#define GRAVITY 9.81
#define HEIGHT  100.0 /* m above ground, at the release */
#define SPEED   10.0  /* m/s, horizontal */

/* 200 m of level ground, or of a slope of 1 in 2 */
static struct ground g;

static void make_ground(double fall, double height, double vx, double vz)
{
    ground_make(&g, 200, fall, height, vx, vz);
}

static struct ceduo_observation_fit simulate(struct ceduo_observation observed)
{
    LOCAL(ceduo_observer, observer);
    struct ceduo_observation_fit c;
    EXPECT(ceduo_observer_create(&observed, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_simulate(observer, &g.scene, ROCKS, NULL, &c), ==, CEDUO_OK);
    return c;
}

static struct ceduo_observation make_observation(enum ceduo_observed_kind kind)
{
    return (struct ceduo_observation){
        .kind = kind, .x = NAN, .from = NAN, .to = NAN, .mean = NAN, .sd = NAN, .share_seen = NAN};
}

static struct ceduo_observation observe_at(enum ceduo_observed_kind kind, double x)
{
    struct ceduo_observation o = make_observation(kind);
    o.x = x;
    return o;
}

static struct ceduo_observation observe_along(enum ceduo_observed_kind kind, double from, double to)
{
    struct ceduo_observation o = make_observation(kind);
    o.from = from;
    o.to = to;
    return o;
}

static struct ceduo_observation set_mean(struct ceduo_observation o, size_t n, double mean, double sd)
{
    o.n = n;
    o.mean = mean;
    o.sd = sd;
    return o;
}

static struct ceduo_observation observe_stops(size_t n, double *values)
{
    struct ceduo_observation o = make_observation(CEDUO_OBSERVED_STOPS);
    o.n = n;
    o.values = values;
    return o;
}

/* Return the values of the first of n observations, one for each rock; caller frees. */
static double *simulate_values(const struct ceduo_observation *observed, size_t n)
{
    LOCAL(ceduo_observer, observer);
    double *values;
    size_t rocks;
    EXPECT(ceduo_observer_create(observed, n, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &g.scene, 0, ROCKS, &values, &rocks), ==, CEDUO_OK);
    EXPECT(rocks, ==, ROCKS);
    return values;
}

/* Return a belt from `from` to 100 m whose wood absorbs u for each cubic metre. For one scene at a time. */
static struct ceduo_belt *make_belt(double from, struct ceduo_stems stems, double u)
{
    static struct ceduo_stems tree;
    static struct ceduo_belt belt;
    tree = stems;
    belt = (struct ceduo_belt){.from = from, .to = 100, .to_given = 100, .cut_year = NAN};
    belt.stand = (struct ceduo_stand){.species = -1, .trees_count = 1, .trees = &tree, .u = u, .fracture_ratio = NAN};
    return &belt;
}

/* ---- counts and classes ---- */

/* All 100 simulated rocks pass: half a rock more in each class gives 100.5/101. Three of four observed rocks passed. */
TEST(a_count_is_binomial)
{
    make_ground(0, HEIGHT, SPEED, 0);
    struct ceduo_observation o = observe_at(CEDUO_OBSERVED_PASSED, 10);
    o.count = 3;
    o.released_count = 4;
    struct ceduo_observation_fit c = simulate(o);
    double p = 100.5 / 101;
    EXPECT(c.classes, ==, 2);
    EXPECT_NEAR(c.log_likelihood, log(4) + 3 * log(p) + log(1 - p), 1e-12);
    EXPECT_NEAR(c.deviance, 2 * (3 * log(0.75 / p) + log(0.25 / (1 - p))), 1e-12);
}

/* Return x of the stop of all rocks: v²/(2 g mu) beyond the point of the first contact. */
static double rest_x(void)
{
    double v = SPEED;
    return SPEED * sqrt(2 * HEIGHT / GRAVITY) + v * v / (2 * GRAVITY * 0.25);
}

TEST(stops_are_multinomial)
{
    double stop = rest_x(), values[10];
    make_ground(0, HEIGHT, SPEED, 0);
    for (int i = 0; i < 10; i++) /* five before it, five beyond; the median is 4 m beyond it */
        values[i] = stop + (i < 5 ? i - 5 : 5 + i);
    struct ceduo_observation o = observe_stops(10, values);
    struct ceduo_observation_fit c = simulate(o);
    double p[2] = {100.5 / 101, 0.5 / 101};
    EXPECT(c.classes, ==, 2);
    EXPECT(c.count[0], ==, 100);
    EXPECT_NEAR(c.mean, stop, 1e-9);
    EXPECT_NEAR(c.log_likelihood, log(252) + 5 * log(p[0]) + 5 * log(p[1]), 1e-10);
    EXPECT_NEAR(c.deviance, 2 * (5 * log(0.5 / p[0]) + 5 * log(0.5 / p[1])), 1e-10);
    o.released_count = 12; /* two more did not stop: an extra class */
    c = simulate(o);
    EXPECT(c.classes, ==, 3);
    EXPECT(c.observed[2], ==, 2);
    EXPECT(c.count[2], ==, 0);
    /* 12!/(5!5!2!) ways; 101.5 = 100 + 3/2 */
    EXPECT_NEAR(c.log_likelihood, log(16632) + 5 * log(100.5 / 101.5) + 5 * log(0.5 / 101.5) + 2 * log(0.5 / 101.5), 1e-10);
    o.from = stop + 1; /* simulated stops lie outside the surveyed part: no rock counts, and two classes need twenty rocks */
    o.released_count = 0;
    c = simulate(o);
    EXPECT(c.rocks, ==, 0);
    EXPECT_NEAR(c.log_likelihood, log(252) + 10 * log(0.5 / 21), 1e-10);
}

/* k = min(10, n/5) classes, at least two. */
TEST(lists_are_binned_at_their_quantiles)
{
    static const struct {
        size_t n, classes, first, last;
    } cases[] = {{1, 2, 1, 0}, {2, 2, 1, 1}, {9, 2, 5, 4}, {15, 3, 5, 5}, {48, 9, 5, 5}, {50, 10, 5, 5}, {200, 10, 20, 20}};
    make_ground(0, HEIGHT, SPEED, 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double values[200];
        for (size_t k = 0; k < cases[i].n; k++)
            values[k] = 20 + (double)k;
        struct ceduo_observation_fit c = simulate(observe_stops(cases[i].n, values));
        EXPECT(c.classes, ==, cases[i].classes);
        EXPECT(c.observed[0], ==, (double)cases[i].first);
        EXPECT(c.observed[c.classes - 1], ==, (double)cases[i].last);
    }
    double equal[10] = {30, 30, 30, 30, 30, 30, 30, 30, 30, 30};
    EXPECT(simulate(observe_stops(10, equal)).observed[0], ==, 10); /* equal values are not split */
    double two_values[20];
    for (int i = 0; i < 20; i++)
        two_values[i] = i < 18 ? 30 : 31;
    struct ceduo_observation_fit c =
        simulate(observe_stops(20, two_values)); /* only two of four classes have bounds of their own */
    EXPECT(c.classes, ==, 2);
    EXPECT(c.observed[0], ==, 18);
    EXPECT(c.observed[1], ==, 2);
}

/* ---- means ---- */

/* Observe a mean with a standard error equal to its distance from the simulated mean, which has no error: z = 1. */
static void expect_mean(struct ceduo_observation o, double mean, double tolerance)
{
    struct ceduo_observation_fit c = simulate(set_mean(o, 4, mean + 1, 2));
    EXPECT(c.classes, ==, 0);
    EXPECT(c.rocks, ==, ROCKS);
    EXPECT_NEAR(c.mean, mean, tolerance);
    EXPECT_NEAR(c.variance, 1, 1e-9);
    EXPECT_NEAR(c.deviance, 1, 2.1 * tolerance + 1e-9);
    EXPECT_NEAR(c.log_likelihood, -0.5 - log(2 * M_PI) / 2, 2.1 * tolerance + 1e-9);
}

static double rock_mass(void)
{
    return 2600 * M_PI / 6;
}

/* After 10 m in flight: one second. */
TEST(means_are_normal)
{
    make_ground(0, HEIGHT, SPEED, 0);
    double speed2 = SPEED * SPEED + GRAVITY * GRAVITY;
    expect_mean(observe_at(CEDUO_OBSERVED_SPEED, 10), sqrt(speed2), 1e-9);
    expect_mean(observe_at(CEDUO_OBSERVED_HEIGHT, 10), HEIGHT - GRAVITY / 2, 1e-9);
    expect_mean(observe_at(CEDUO_OBSERVED_ENERGY, 10), rock_mass() * speed2 / 2, 1e-6);
}

/* If rocks differ, the error of the simulated mean counts as well. */
TEST(a_mean_has_the_error_of_both_sides)
{
    make_ground(0, HEIGHT, SPEED, 0);
    g.scene.release.vx.spread = 2;
    struct ceduo_observation o = set_mean(observe_at(CEDUO_OBSERVED_SPEED, 10), 400, 15, 2);
    struct ceduo_observation_fit c = simulate(o);
    LOCAL_BYTES double *values = simulate_values(&o, 1);
    double mean = gsl_stats_mean(values, 1, ROCKS), variance = 0.01 + gsl_stats_variance(values, 1, ROCKS) / ROCKS;
    EXPECT(variance, >, 0.011);
    EXPECT_NEAR(c.variance, variance, 1e-12);
    EXPECT_NEAR(c.deviance, (15 - mean) * (15 - mean) / variance, 1e-9 * c.deviance);
}

TEST(a_mean_without_rocks_is_impossible)
{
    make_ground(0, HEIGHT, SPEED, 0);
    struct ceduo_observation_fit c = simulate(set_mean(observe_at(CEDUO_OBSERVED_SPEED, 190), 4, 10, 2));
    EXPECT(c.rocks, ==, 0);
    EXPECT(c.log_likelihood, <, -1000);
}

/* ---- along the trajectory ---- */

TEST(maxima_are_at_an_end_or_on_top)
{
    struct ceduo_observation speed = make_observation(CEDUO_OBSERVED_LARGEST_SPEED),
                             height = make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT);
    make_ground(0, HEIGHT, SPEED, 0);
    expect_mean(speed, sqrt(SPEED * SPEED + 2 * GRAVITY * HEIGHT), 1e-9);
    expect_mean(height, HEIGHT, 1e-9);
    make_ground(0, 1, SPEED, 5); /* thrown upwards: 5²/2g higher */
    expect_mean(height, 1 + 25 / (2 * GRAVITY), 1e-9);
    make_ground(100, 0, SPEED, SPEED); /* thrown off a slope of 1 in 2: highest above it when the flight is parallel to it */
    double t = (SPEED + SPEED / 2) / GRAVITY;
    expect_mean(height, SPEED * t - GRAVITY / 2 * t * t + SPEED / 2 * t, 1e-9);
}

/* Means over the first 10 m of a flight of one second, metre by metre. */
TEST(means_along_a_flight)
{
    make_ground(0, HEIGHT, SPEED, 0);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 0, 10), HEIGHT - GRAVITY / 6, 1e-9);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_ENERGY, 0, 10), rock_mass() / 2 * (SPEED * SPEED + GRAVITY * GRAVITY / 3),
                1e-5);
    double sum = 0; /* by Simpson's rule over small steps */
    for (int i = 0; i < 1000; i++)
        for (int k = 0; k < 3; k++) {
            double v = GRAVITY * (i + k / 2.0) / 1000;
            sum += (k == 1 ? 4 : 1) * sqrt(SPEED * SPEED + v * v) / 6000;
        }
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_SPEED, 0, 10), sum, 1e-9);
}

/* The same backwards: from 100 m, over the last 10 m before it. */
TEST(a_flight_back)
{
    make_ground(0, HEIGHT, -SPEED, 0);
    g.scene.release.x = ceduo_number(100);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 90, 100), HEIGHT - GRAVITY / 6, 1e-9);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_ENERGY, 90, 100), rock_mass() / 2 * (SPEED * SPEED + GRAVITY * GRAVITY / 3),
                1e-5);
    expect_mean(make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT), HEIGHT, 1e-9);
}

/* Flight over an edge at 10 m, beyond which the ground falls 1 in 2: the rock is highest above the ground when its flight is
 * parallel to the slope. */
TEST(a_flight_over_an_edge)
{
    static double x[3] = {0, 10, 200}, z[3] = {0, 0, -95};
    struct ceduo_segment two[2];
    double v = 2 * SPEED, edge = 10 / v, top = v / 2 / GRAVITY;
    make_ground(0, 5, v, 0);
    two[0] = two[1] = g.segment;
    g.scene.slope = (struct ceduo_slope){.vertices = 3, .x = x, .z = z, .segments = two, .segments_given = 2};
    expect_mean(make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT), 5 - GRAVITY / 2 * top * top + (v * top - 10) / 2, 1e-9);
    double sum = 5 * top - GRAVITY / 6 * top * top * top + v / 4 * (top - edge) * (top - edge);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 0, v * top), sum / top, 1e-9);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 0, 10), 5 - GRAVITY / 6 * edge * edge, 1e-9); /* up to the edge */
    g.scene.release.x = ceduo_number(10);                                                              /* and back from there */
    g.scene.release.vx = ceduo_number(-2);
    expect_mean(make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT), 5, 1e-9);
}

/* Roll down 1 in 2 with friction 0.25: v² grows by 2 g (sin - mu cos) for each metre of ground. */
TEST(means_along_a_roll)
{
    double cosine = 2 / sqrt(5), sine = 1 / sqrt(5), gain = 2 * GRAVITY * (sine - 0.25 * cosine) / cosine;
    make_ground(100, 0, SPEED * cosine, -SPEED * sine);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_ENERGY, 0, 50), rock_mass() / 2 * (SPEED * SPEED + gain * 25), 1e-4);
    double end2 = SPEED * SPEED + gain * 50;
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_SPEED, 0, 50), 2 / (3 * gain * 50) * (pow(end2, 1.5) - pow(SPEED, 3)), 1e-6);
    expect_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 0, 50), 0, 1e-9);
    EXPECT(simulate(set_mean(observe_along(CEDUO_OBSERVED_WAY_HEIGHT, 300, 310), 3, 1, 1)).rocks, ==,
           0); /* no rock reaches it */
}

/* From rest: the height lost, less friction, m g (sin - mu cos)/cos for each metre, is kinetic energy of motion and spin. */
TEST(a_roll_from_rest)
{
    double cosine = 2 / sqrt(5), sine = 1 / sqrt(5), gain = GRAVITY * (sine - 0.25 * cosine) / cosine;
    static const enum ceduo_law laws[] = {CEDUO_LAW_LUMPED, CEDUO_LAW_CRSP};
    for (size_t i = 0; i < 2; i++) {
        make_ground(100, 0, 0, 0);
        g.scene.simulation.law = laws[i];
        expect_mean(observe_along(CEDUO_OBSERVED_WAY_ENERGY, 0, 50), rock_mass() * gain * 25, 1e-4);
        double k = laws[i] == CEDUO_LAW_LUMPED ? 0 : 0.4; /* sphere */
        expect_mean(observe_along(CEDUO_OBSERVED_WAY_SPEED, 0, 50), 2. / 3 * sqrt(2 * gain / (1 + k) * 50), 1e-6);
    }
}

TEST(a_fall)
{
    make_ground(0, HEIGHT, 0, 0);
    expect_mean(make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT), HEIGHT, 1e-9);
    expect_mean(make_observation(CEDUO_OBSERVED_LARGEST_SPEED), sqrt(2 * GRAVITY * HEIGHT), 1e-9);
}

/* ---- recorded rocks ---- */

static void make_rough(void)
{
    make_ground(80, 1, 2, 0);
    g.scene.simulation.law = CEDUO_LAW_CRSP;
    g.segment.roughness_rad = 0.3;
    g.segment.rn = ceduo_number(0.4);
    g.segment.friction = 0.8;
}

/* On a rough slope, so that rocks differ, with a law that has spin: recorded stops are those of the run. */
TEST(recorded_rocks_are_those_of_a_run)
{
    make_rough();
    double one = 50;
    struct ceduo_observation two[2] = {observe_stops(1, &one),
                                       set_mean(make_observation(CEDUO_OBSERVED_LARGEST_SPEED), 2, 1, 1)};
    LOCAL_BYTES double *recorded = simulate_values(two, 2), *run = simulate_values(two, 1);
    assert_memory_equal(recorded, run, ROCKS * sizeof *run);
}

/* Speed, height and energy at a place of recorded rocks are those of the run. */
TEST(recorded_crossings_are_those_of_a_run)
{
    make_rough();
    for (int k = 0; k < 3; k++) {
        struct ceduo_observation two[2] = {
            set_mean(observe_at((enum ceduo_observed_kind)(CEDUO_OBSERVED_SPEED + k), 60), 2, 1, 1),
            set_mean(make_observation(CEDUO_OBSERVED_LARGEST_SPEED), 2, 1, 1)};
        LOCAL_BYTES double *recorded = simulate_values(two, 2), *run = simulate_values(two, 1);
        size_t reached = 0;
        for (size_t i = 0; i < ROCKS; i++) {
            assert_int_equal(isnan(recorded[i]), isnan(run[i]));
            reached += isnan(run[i]) ? 0 : 1;
            if (!isnan(run[i]))
                EXPECT_NEAR(recorded[i], run[i], 1e-12 * fabs(run[i]));
        }
        EXPECT(reached, >, 10);
        EXPECT(reached, <, ROCKS);
    }
}

/* Observations with the same rock, release and option share a run. By the index nothing stops a rock. */
TEST(runs_are_shared)
{
    make_ground(0, HEIGHT, SPEED, 0);
    struct ceduo_rock_def small = g.scene.rock;
    struct ceduo_release slow = g.scene.release;
    struct ceduo_observation o[6];
    struct ceduo_observation_fit c[6];
    struct ceduo_option options[2] = {g.option, g.option};
    small.diameter = ceduo_number(0.5);
    slow.vx = ceduo_number(SPEED / 2);
    options[1].belts =
        make_belt(1, (struct ceduo_stems){.per_ha = 1e5, .dbh = 1, .height = 100, .volume = 10, .age = NAN}, 1e7);
    options[1].belts_count = 1;
    g.scene.options = options;
    g.scene.options_count = 2;
    for (int i = 0; i < 6; i++)
        o[i] = set_mean(observe_at(i == 3 ? CEDUO_OBSERVED_SPEED : CEDUO_OBSERVED_ENERGY, i == 4 ? 5 : 10), 2, 1, 1);
    o[1].rock = &small;
    o[2].release = &slow;
    o[5].option = 1;
    double seconds[6] = {1, 1, 2, 1, 0.5, 1};
    for (int pass = 0; pass < 2; pass++) {
        LOCAL(ceduo_observer, observer);
        if (pass == 1)
            g.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
        EXPECT(ceduo_observer_create(o, 6, &observer), ==, CEDUO_OK);
        EXPECT(ceduo_observer_simulate(observer, &g.scene, ROCKS, NULL, c), ==, CEDUO_OK);
        for (int i = 0; i < 6; i++) {
            double v = i == 2 ? SPEED / 2 : SPEED, speed2 = v * v + GRAVITY * GRAVITY * seconds[i] * seconds[i];
            if (i == 5 && pass == 0)
                EXPECT(c[i].rocks, ==, 0); /* stopped by stems */
            else
                EXPECT_NEAR(c[i].mean, i == 3 ? sqrt(speed2) : rock_mass() / (i == 1 ? 8 : 1) * speed2 / 2, 1e-6);
        }
    }
    g.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    struct ceduo_observation largest = make_observation(CEDUO_OBSERVED_LARGEST_HEIGHT);
    largest.option = 1;
    expect_mean(largest, HEIGHT, 1e-9);
}

/* Observations are of one rock, also in a scene with block sizes. */
TEST(observations_are_of_one_rock)
{
    static double volumes[] = {.05, 1};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    make_ground(0, HEIGHT, SPEED, 0);
    g.scene.blocks = &blocks;
    g.scene.blocks_count = 1;
    struct ceduo_observation o = set_mean(observe_at(CEDUO_OBSERVED_ENERGY, 10), 2, 1, 1);
    o.rock = &g.scene.rock;
    struct ceduo_observation_fit c = simulate(o);
    EXPECT_NEAR(c.mean, rock_mass() * (SPEED * SPEED + GRAVITY * GRAVITY) / 2, 1e-6); /* after 1 s of free fall */
    EXPECT_NEAR(c.sd, 0, 1e-6);
}

/* An invalid scene or a cancelled simulation gives no comparison. */
TEST(invalid_scenes_are_not_compared)
{
    make_ground(0, HEIGHT, SPEED, 0);
    struct ceduo_observation o[2] = {observe_at(CEDUO_OBSERVED_SPEED, 10), make_observation(CEDUO_OBSERVED_LARGEST_SPEED)};
    struct ceduo_observer *observer;
    struct ceduo_observation_fit c[2];
    const atomic_bool cancelled = true;
    for (size_t i = 0; i < 2; i++) {
        double *values;
        size_t n;
        EXPECT(ceduo_observer_create(&o[i], 1, &observer), ==, CEDUO_OK);
        EXPECT(ceduo_observer_simulate(observer, &g.scene, ROCKS, &cancelled, c), ==, CEDUO_CANCELLED);
        g.scene.slope.vertices = 1;
        EXPECT(ceduo_observer_values(observer, &g.scene, 0, ROCKS, &values, &n), !=, CEDUO_OK);
        assert_null(values);
        g.scene.slope.vertices = 2;
        const struct {
            size_t which;
            uint64_t rocks;
        } bad[] = {{1, ROCKS}, {0, 0}, {0, CEDUO_ROCKS_MAX + 1}};
        for (size_t k = 0; k < LENGTH(bad); k++)
            EXPECT(ceduo_observer_values(observer, &g.scene, bad[k].which, bad[k].rocks, &values, &n), ==, CEDUO_BAD_ARGUMENT);
        ceduo_observer_free(observer);
    }
    o[0].option = 1; /* there is one option */
    EXPECT(ceduo_observer_create(o, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_simulate(observer, &g.scene, ROCKS, NULL, c), ==, CEDUO_BAD_ARGUMENT);
    ceduo_observer_free(observer);
    o[0] = observe_stops(1, &(double){NAN});
    EXPECT(ceduo_observer_create(o, 1, &observer), ==, CEDUO_BAD_ARGUMENT);
    assert_null(observer);
    ceduo_observer_free(NULL);
}

/* ---- scars ---- */

TEST(scars_are_counted_and_measured)
{
    const struct ceduo_stems tree = {.per_ha = 400, .dbh = 0.2, .height = 15, .volume = 0.2, .age = NAN};
    make_ground(80, 0, 5, -2);
    g.option.belts = make_belt(0, tree, 1000);
    g.option.belts_count = 1;
    struct ceduo_observation o = observe_along(CEDUO_OBSERVED_SCARS, 20, 60);
    double heights[3] = {0.4, 0.5, 0.6};
    o.n = 3;
    o.values = heights;
    struct ceduo_record record;
    struct ceduo_record_def def = {
        .size = sizeof(struct ceduo_record_def), .scene = &g.scene, .option = &g.option, .rocks = ROCKS, .blows = true};
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    double counts[ROCKS] = {0}, sum = 0, square = 0;
    for (size_t i = 0; i < record.blows_count; i++)
        counts[record.blows[i].rock] += record.blows[i].x >= 20 && record.blows[i].x <= 60;
    for (int i = 0; i < ROCKS; i++) {
        sum += counts[i];
        square += counts[i] * counts[i];
    }
    struct ceduo_observation_fit heights_alone = simulate(o);
    EXPECT(sum, >, 20);
    EXPECT((double)heights_alone.rocks, ==, sum);
    EXPECT_NEAR(heights_alone.mean, 0.5, 0.05); /* rocks roll: their centre is half a metre above the ground */
    assert_true(isnan(heights_alone.scars));
    o.released_count = 10;
    o.share_seen = 0.75;
    struct ceduo_observation_fit c = simulate(o);
    double mean = sum / ROCKS, variance = (square - sum * mean) / (ROCKS - 1);
    double expected = 10 * mean * 0.75, spread = 0.75 * 0.75 * variance * 10 * 1.1 + 10 * mean * 0.75 * 0.25;
    EXPECT_NEAR(c.scars, expected, 1e-9);
    EXPECT_NEAR(c.deviance - heights_alone.deviance, (3 - expected) * (3 - expected) / spread, 1e-9);
    o.share_seen = NAN; /* NaN: all scars were observed */
    EXPECT_NEAR(simulate(o).scars, 10 * mean, 1e-9);
    ceduo_record_release(&record);
    atomic_bool cancelled = true;
    def.cancel = &cancelled;
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_CANCELLED);
    assert_null(record.rocks);
    def.cancel = NULL;
    g.scene.release.height = ceduo_number(100); /* above the trees: no impacts */
    g.option.belts->to = g.option.belts->to_given = 5;
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    EXPECT(record.blows_count, ==, 0);
    ceduo_record_release(&record);
}

/* Stems as strong as rock: a rock lies at the stem that stopped it. */
TEST(rocks_lie_where_stems_stop_them)
{
    const struct ceduo_stems tree = {.per_ha = 1e5, .dbh = 1, .height = 15, .volume = 10, .age = NAN};
    make_ground(80, 0, 5, -2);
    g.option.belts = make_belt(1, tree, 1e7);
    g.option.belts_count = 1;
    LOCAL_BY(ceduo_record_release) struct ceduo_record record;
    const struct ceduo_record_def def = {
        .size = sizeof(struct ceduo_record_def), .scene = &g.scene, .option = &g.option, .rocks = 5, .blows = true};
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    EXPECT(record.blows_count, ==, 5);
    for (size_t i = 0; i < 5; i++)
        EXPECT_NEAR(record.rocks[i].stop_x, record.blows[i].x, 1e-9);
}
