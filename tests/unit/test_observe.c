/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What simulated rocks say of what was seen, against closed forms: rocks that are all alike fly over level ground before
 * they strike it, or roll down a smooth slope. */
#include "expect.h"

#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"

#define ROCKS   100
#define GRAVITY 9.81
#define HIGH    100.0 /* m above ground, at the release */
#define FAST    10.0  /* m/s, along */

/* 200 m of level ground; or one slope of 1 in 2. */
struct ground {
    struct ceduo_scene scene;
    double x[2], z[2];
    struct ceduo_segment segment;
    struct ceduo_option option;
};

static void make_ground(struct ground *g, double fall, double height, double vx, double vz)
{
    *g = (struct ground){.scene = ceduo_scene_default(), .x = {0, 200}, .z = {0, -fall}};
    g->segment = (struct ceduo_segment){
        .rn = ceduo_number(0), .rt = ceduo_number(1), .roughness_m = NAN, .roughness_rad = 0, .friction = 0.25};
    g->scene.slope = (struct ceduo_slope){.vertices = 2, .x = g->x, .z = g->z, .segments = &g->segment, .segments_given = 1};
    g->scene.rock.shape = CEDUO_SPHERE;
    g->scene.rock.diameter = ceduo_number(1);
    g->scene.rock.density = ceduo_number(2600);
    g->scene.release.height = ceduo_number(height);
    g->scene.release.vx = ceduo_number(vx);
    g->scene.release.vz = ceduo_number(vz);
    g->option = (struct ceduo_option){.name = (char *)(uintptr_t) "bare"};
    g->scene.options = &g->option;
    g->scene.options_count = 1;
}

static struct ceduo_counterpart look(const struct ground *g, struct ceduo_observation seen)
{
    struct ceduo_observer *observer;
    struct ceduo_counterpart c;
    EXPECT(ceduo_observer_create(&seen, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_look(observer, &g->scene, ROCKS, NULL, &c), ==, CEDUO_OK);
    ceduo_observer_free(observer);
    return c;
}

static struct ceduo_observation something(enum ceduo_observed_kind kind)
{
    return (struct ceduo_observation){.kind = kind, .x = NAN, .from = NAN, .to = NAN, .mean = NAN, .sd = NAN, .share_seen = NAN};
}

/* ---- counts and classes ---- */

/* All 100 rocks pass: half a rock more in each class gives 100.5/101. Three of four were seen to. */
static void a_count_is_binomial(void **state)
{
    (void)state;
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    struct ceduo_observation o = something(CEDUO_OBSERVED_PASSED);
    o.x = 10;
    o.count = 3;
    o.of = 4;
    struct ceduo_counterpart c = look(&g, o);
    double p = 100.5 / 101;
    EXPECT(c.classes, ==, 2);
    EXPECT_NEAR(c.log_likelihood, log(4) + 3 * log(p) + log(1 - p), 1e-12);
    EXPECT_NEAR(c.deviance, 2 * (3 * log(0.75 / p) + log(0.25 / (1 - p))), 1e-12);
}

/* All rocks come to rest at one place: where they strike the ground, and v²/(2 g mu) further. */
static double rest_x(void)
{
    double v = FAST;
    return FAST * sqrt(2 * HIGH / GRAVITY) + v * v / (2 * GRAVITY * 0.25);
}

static void stops_are_multinomial(void **state)
{
    (void)state;
    struct ground g;
    double at = rest_x(), values[10];
    make_ground(&g, 0, HIGH, FAST, 0);
    for (int i = 0; i < 10; i++) /* five before it, five behind; the median is 4 m behind it */
        values[i] = at + (i < 5 ? i - 5 : 5 + i);
    struct ceduo_observation o = something(CEDUO_OBSERVED_STOPS);
    o.n = 10;
    o.values = values;
    struct ceduo_counterpart c = look(&g, o);
    double p[2] = {100.5 / 101, 0.5 / 101};
    EXPECT(c.classes, ==, 2);
    EXPECT(c.count[0], ==, 100);
    EXPECT_NEAR(c.mean, at, 1e-9);
    EXPECT_NEAR(c.log_likelihood, log(252) + 5 * log(p[0]) + 5 * log(p[1]), 1e-10);
    EXPECT_NEAR(c.deviance, 2 * (5 * log(0.5 / p[0]) + 5 * log(0.5 / p[1])), 1e-10);
    o.of = 12; /* two more did not stop: a class of their own */
    c = look(&g, o);
    EXPECT(c.classes, ==, 3);
    EXPECT(c.seen[2], ==, 2);
    EXPECT(c.count[2], ==, 0);
    /* 12!/(5!5!2!) ways; 101.5 = 100 + 3/2 */
    EXPECT_NEAR(c.log_likelihood, log(16632) + 5 * log(100.5 / 101.5) + 5 * log(0.5 / 101.5) + 2 * log(0.5 / 101.5), 1e-10);
    o.from = at + 1; /* nobody looked where they lie: none is of it, and two classes want twenty rocks */
    o.of = 0;
    c = look(&g, o);
    EXPECT(c.rocks, ==, 0);
    EXPECT_NEAR(c.log_likelihood, log(252) + 10 * log(0.5 / 21), 1e-10);
}

/* k = min(10, n/5) classes, and two at the least. */
static void a_list_has_classes_of_its_own(void **state)
{
    (void)state;
    static const struct {
        size_t n, classes, first, last;
    } cases[] = {{1, 2, 1, 0}, {2, 2, 1, 1}, {9, 2, 5, 4}, {15, 3, 5, 5}, {48, 9, 5, 5}, {50, 10, 5, 5}, {200, 10, 20, 20}};
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double values[200];
        for (size_t k = 0; k < cases[i].n; k++)
            values[k] = 20 + (double)k;
        struct ceduo_observation o = something(CEDUO_OBSERVED_STOPS);
        o.n = cases[i].n;
        o.values = values;
        struct ceduo_counterpart c = look(&g, o);
        EXPECT(c.classes, ==, cases[i].classes);
        EXPECT(c.seen[0], ==, (double)cases[i].first);
        EXPECT(c.seen[c.classes - 1], ==, (double)cases[i].last);
    }
    double alike[10] = {30, 30, 30, 30, 30, 30, 30, 30, 30, 30};
    struct ceduo_observation o = something(CEDUO_OBSERVED_STOPS);
    o.n = 10;
    o.values = alike;
    EXPECT(look(&g, o).seen[0], ==, 10); /* nothing is split that is alike */
}

/* ---- means ---- */

/* Seen with an error that equals its distance to the simulated mean, which has none: z = 1. */
static void expect_mean(const struct ground *g, struct ceduo_observation o, double mean, double within)
{
    o.n = 4;
    o.sd = 2;
    o.mean = mean + 1;
    struct ceduo_counterpart c = look(g, o);
    EXPECT(c.classes, ==, 0);
    EXPECT(c.rocks, ==, ROCKS);
    EXPECT_NEAR(c.mean, mean, within);
    EXPECT_NEAR(c.variance, 1, 1e-9);
    EXPECT_NEAR(c.deviance, 1, 2.1 * within + 1e-9);
    EXPECT_NEAR(c.log_likelihood, -0.5 - log(2 * M_PI) / 2, 2.1 * within + 1e-9);
}

static double mass(void)
{
    return 2600 * M_PI / 6;
}

/* After 10 m in flight: one second. */
static void means_are_normal(void **state)
{
    (void)state;
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    double speed2 = FAST * FAST + GRAVITY * GRAVITY;
    struct ceduo_observation o = something(CEDUO_OBSERVED_SPEED);
    o.x = 10;
    expect_mean(&g, o, sqrt(speed2), 1e-9);
    o.kind = CEDUO_OBSERVED_HEIGHT;
    expect_mean(&g, o, HIGH - GRAVITY / 2, 1e-9);
    o.kind = CEDUO_OBSERVED_ENERGY;
    expect_mean(&g, o, mass() * speed2 / 2, 1e-6);
}

static void no_rock_there_is_impossible(void **state)
{
    (void)state;
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    struct ceduo_observation o = something(CEDUO_OBSERVED_SPEED);
    o.x = 190;
    o.n = 4;
    o.mean = 10;
    o.sd = 2;
    struct ceduo_counterpart c = look(&g, o);
    EXPECT(c.rocks, ==, 0);
    EXPECT(c.log_likelihood, <, -1000);
}

/* ---- on the way ---- */

static void the_largest_is_at_an_end_or_on_top(void **state)
{
    (void)state;
    struct ground g;
    struct ceduo_observation speed = something(CEDUO_OBSERVED_LARGEST_SPEED), height = something(CEDUO_OBSERVED_LARGEST_HEIGHT);
    make_ground(&g, 0, HIGH, FAST, 0);
    expect_mean(&g, speed, sqrt(FAST * FAST + 2 * GRAVITY * HIGH), 1e-9);
    expect_mean(&g, height, HIGH, 1e-9);
    make_ground(&g, 0, 1, FAST, 5); /* thrown up: 5²/2g higher */
    expect_mean(&g, height, 1 + 25 / (2 * GRAVITY), 1e-9);
    make_ground(&g, 100, 0, FAST, FAST); /* off a slope of 1 in 2: highest above it where the flight is parallel to it */
    double t = (FAST + FAST / 2) / GRAVITY;
    expect_mean(&g, height, FAST * t - GRAVITY / 2 * t * t + FAST / 2 * t, 1e-9);
}

/* Over the first 10 m of a flight of one second, metre by metre. */
static void means_along_a_flight(void **state)
{
    (void)state;
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    struct ceduo_observation o = something(CEDUO_OBSERVED_WAY_HEIGHT);
    o.from = 0;
    o.to = 10;
    expect_mean(&g, o, HIGH - GRAVITY / 6, 1e-9);
    o.kind = CEDUO_OBSERVED_WAY_ENERGY;
    expect_mean(&g, o, mass() / 2 * (FAST * FAST + GRAVITY * GRAVITY / 3), 1e-5);
    o.kind = CEDUO_OBSERVED_WAY_SPEED;
    double sum = 0; /* by Simpson's rule over small steps */
    for (int i = 0; i < 1000; i++)
        for (int k = 0; k < 3; k++) {
            double v = GRAVITY * (i + k / 2.0) / 1000;
            sum += (k == 1 ? 4 : 1) * sqrt(FAST * FAST + v * v) / 6000;
        }
    expect_mean(&g, o, sum, 1e-9);
}

/* A roll down 1 in 2 with friction 0.25: v² grows by 2 g (sin - mu cos) for each metre of ground. */
static void means_along_a_roll(void **state)
{
    (void)state;
    struct ground g;
    double cosine = 2 / sqrt(5), sine = 1 / sqrt(5), gain = 2 * GRAVITY * (sine - 0.25 * cosine) / cosine;
    make_ground(&g, 100, 0, FAST * cosine, -FAST * sine);
    struct ceduo_observation o = something(CEDUO_OBSERVED_WAY_ENERGY);
    o.from = 0;
    o.to = 50;
    expect_mean(&g, o, mass() / 2 * (FAST * FAST + gain * 25), 1e-4);
    o.kind = CEDUO_OBSERVED_WAY_SPEED;
    double end2 = FAST * FAST + gain * 50;
    expect_mean(&g, o, 2 / (3 * gain * 50) * (pow(end2, 1.5) - pow(FAST, 3)), 1e-6);
    o.kind = CEDUO_OBSERVED_WAY_HEIGHT;
    expect_mean(&g, o, 0, 1e-9);
    o.from = 300; /* nobody comes there */
    o.to = 310;
    o.n = 3;
    o.mean = o.sd = 1;
    EXPECT(look(&g, o).rocks, ==, 0);
}

/* ---- rocks are those of a run ---- */

/* A rough slope, so that rocks differ: what is recorded of each rock is what its run keeps. */
static void recorded_rocks_are_those_of_a_run(void **state)
{
    (void)state;
    struct ground g;
    make_ground(&g, 80, 1, 2, 0);
    g.segment.roughness_rad = 0.3;
    g.segment.rn = ceduo_number(0.4);
    g.segment.friction = 0.6;
    struct ceduo_observation two[2] = {something(CEDUO_OBSERVED_STOPS), something(CEDUO_OBSERVED_LARGEST_SPEED)};
    double one = 50;
    two[0].n = 1;
    two[0].values = &one;
    two[1].n = 2;
    two[1].mean = two[1].sd = 1;
    struct ceduo_observer *both, *alone;
    double *recorded, *run;
    size_t n, m;
    EXPECT(ceduo_observer_create(two, 2, &both), ==, CEDUO_OK);
    EXPECT(ceduo_observer_create(two, 1, &alone), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(both, &g.scene, 0, ROCKS, &recorded, &n), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(alone, &g.scene, 0, ROCKS, &run, &m), ==, CEDUO_OK);
    EXPECT(n, ==, ROCKS);
    assert_memory_equal(recorded, run, ROCKS * sizeof *run);
    free(recorded);
    free(run);
    ceduo_observer_free(both);
    ceduo_observer_free(alone);
}

/* ---- scars ---- */

static void scars_are_counted_and_measured(void **state)
{
    (void)state;
    struct ground g;
    struct ceduo_stems tree = {.per_ha = 400, .dbh = 0.2, .height = 15, .volume = 0.2, .age = NAN};
    struct ceduo_belt belt = {.from = 0, .to = 100, .to_given = 100, .cut_year = NAN};
    make_ground(&g, 80, 0, 5, -2);
    belt.stand = (struct ceduo_stand){.species = -1, .trees_count = 1, .trees = &tree, .u = 1000, .fracture_ratio = NAN};
    g.option.belts = &belt;
    g.option.belts_count = 1;
    struct ceduo_observation o = something(CEDUO_OBSERVED_SCARS);
    double heights[3] = {0.4, 0.5, 0.6};
    o.n = 3;
    o.values = heights;
    o.from = 20;
    o.to = 60;
    struct ceduo_record record;
    struct ceduo_record_def def = {.scene = &g.scene, .option = &g.option, .rocks = ROCKS, .blows = true};
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    double of[ROCKS] = {0}, sum = 0, square = 0;
    for (size_t i = 0; i < record.blows_count; i++)
        of[record.blows[i].rock] += record.blows[i].x >= 20 && record.blows[i].x <= 60;
    for (int i = 0; i < ROCKS; i++) {
        sum += of[i];
        square += of[i] * of[i];
    }
    struct ceduo_counterpart heights_alone = look(&g, o);
    EXPECT(sum, >, 20);
    EXPECT((double)heights_alone.rocks, ==, sum);
    EXPECT_NEAR(heights_alone.mean, 0.5, 0.05); /* rocks roll: their centre is half a metre above the ground */
    assert_true(isnan(heights_alone.scars));
    o.of = 10;
    o.share_seen = 0.75;
    struct ceduo_counterpart c = look(&g, o);
    double mean = sum / ROCKS, variance = (square - sum * mean) / (ROCKS - 1);
    double expected = 10 * mean * 0.75, spread = 0.75 * 0.75 * variance * 10 * 1.1 + 10 * mean * 0.75 * 0.25;
    EXPECT_NEAR(c.scars, expected, 1e-9);
    EXPECT_NEAR(c.deviance - heights_alone.deviance, (3 - expected) * (3 - expected) / spread, 1e-9);
    ceduo_record_release(&record);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_count_is_binomial),
        cmocka_unit_test(stops_are_multinomial),
        cmocka_unit_test(a_list_has_classes_of_its_own),
        cmocka_unit_test(means_are_normal),
        cmocka_unit_test(no_rock_there_is_impossible),
        cmocka_unit_test(the_largest_is_at_an_end_or_on_top),
        cmocka_unit_test(means_along_a_flight),
        cmocka_unit_test(means_along_a_roll),
        cmocka_unit_test(recorded_rocks_are_those_of_a_run),
        cmocka_unit_test(scars_are_counted_and_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
