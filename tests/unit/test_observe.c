/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What simulated rocks say of what was seen, against closed forms: rocks that are all alike fly over level ground before
 * they strike it, or roll down a smooth slope. */
#include "expect.h"
#include "local.h"

#include <gsl/gsl_statistics_double.h>
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
    LOCAL(ceduo_observer, observer);
    struct ceduo_counterpart c;
    EXPECT(ceduo_observer_create(&seen, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_look(observer, &g->scene, ROCKS, NULL, &c), ==, CEDUO_OK);
    return c;
}

static struct ceduo_observation something(enum ceduo_observed_kind kind)
{
    return (struct ceduo_observation){
        .kind = kind, .x = NAN, .from = NAN, .to = NAN, .mean = NAN, .sd = NAN, .share_seen = NAN};
}

/* ---- counts and classes ---- */

/* All 100 rocks pass: half a rock more in each class gives 100.5/101. Three of four were seen to. */
TEST(a_count_is_binomial)
{
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

TEST(stops_are_multinomial)
{
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
TEST(a_list_has_classes_of_its_own)
{
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
    double mostly[20];
    for (int i = 0; i < 20; i++)
        mostly[i] = i < 18 ? 30 : 31;
    o.n = 20;
    o.values = mostly;
    struct ceduo_counterpart c = look(&g, o); /* of four classes those with a bound of their own */
    EXPECT(c.classes, ==, 2);
    EXPECT(c.seen[0], ==, 18);
    EXPECT(c.seen[1], ==, 2);
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
TEST(means_are_normal)
{
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

/* Of rocks that differ, the error of the simulated mean counts as well. */
TEST(a_mean_has_the_error_of_both_sides)
{
    struct ground g;
    LOCAL(ceduo_observer, observer);
    struct ceduo_counterpart c;
    LOCAL_BYTES double *values;
    size_t n;
    make_ground(&g, 0, HIGH, FAST, 0);
    g.scene.release.vx.spread = 2;
    struct ceduo_observation o = something(CEDUO_OBSERVED_SPEED);
    o.x = 10;
    o.n = 400;
    o.sd = 2;
    o.mean = 15;
    EXPECT(ceduo_observer_create(&o, 1, &observer), ==, CEDUO_OK);
    EXPECT(ceduo_observer_look(observer, &g.scene, ROCKS, NULL, &c), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(observer, &g.scene, 0, ROCKS, &values, &n), ==, CEDUO_OK);
    EXPECT(n, ==, ROCKS);
    double mean = gsl_stats_mean(values, 1, n), variance = 0.01 + gsl_stats_variance(values, 1, n) / ROCKS;
    EXPECT(variance, >, 0.011);
    EXPECT_NEAR(c.variance, variance, 1e-12);
    EXPECT_NEAR(c.deviance, (15 - mean) * (15 - mean) / variance, 1e-9 * c.deviance);
}

TEST(no_rock_there_is_impossible)
{
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

TEST(the_largest_is_at_an_end_or_on_top)
{
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
TEST(means_along_a_flight)
{
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

/* The same to the other side: from 100 m back over the last 10 of them. */
TEST(a_flight_back)
{
    struct ground g;
    make_ground(&g, 0, HIGH, -FAST, 0);
    g.scene.release.x = ceduo_number(100);
    struct ceduo_observation o = something(CEDUO_OBSERVED_WAY_HEIGHT), largest = something(CEDUO_OBSERVED_LARGEST_HEIGHT);
    o.from = 90;
    o.to = 100;
    expect_mean(&g, o, HIGH - GRAVITY / 6, 1e-9);
    o.kind = CEDUO_OBSERVED_WAY_ENERGY;
    expect_mean(&g, o, mass() / 2 * (FAST * FAST + GRAVITY * GRAVITY / 3), 1e-5);
    expect_mean(&g, largest, HIGH, 1e-9);
}

/* Over an edge at 10 m, beyond which it falls 1 in 2: highest above the ground where the flight is parallel to the slope. */
TEST(a_flight_over_an_edge)
{
    struct ground g;
    static double x[3] = {0, 10, 200}, z[3] = {0, 0, -95};
    struct ceduo_segment two[2];
    double v = 2 * FAST, edge = 10 / v, top = v / 2 / GRAVITY;
    make_ground(&g, 0, 5, v, 0);
    two[0] = two[1] = g.segment;
    g.scene.slope = (struct ceduo_slope){.vertices = 3, .x = x, .z = z, .segments = two, .segments_given = 2};
    expect_mean(&g, something(CEDUO_OBSERVED_LARGEST_HEIGHT), 5 - GRAVITY / 2 * top * top + (v * top - 10) / 2, 1e-9);
    struct ceduo_observation o = something(CEDUO_OBSERVED_WAY_HEIGHT);
    o.from = 0;
    o.to = v * top;
    double sum = 5 * top - GRAVITY / 6 * top * top * top + v / 4 * (top - edge) * (top - edge);
    expect_mean(&g, o, sum / top, 1e-9);
    o.to = 10; /* up to the edge */
    expect_mean(&g, o, 5 - GRAVITY / 6 * edge * edge, 1e-9);
    g.scene.release.x = ceduo_number(10); /* and back from there */
    g.scene.release.vx = ceduo_number(-2);
    expect_mean(&g, something(CEDUO_OBSERVED_LARGEST_HEIGHT), 5, 1e-9);
}

/* A roll down 1 in 2 with friction 0.25: v² grows by 2 g (sin - mu cos) for each metre of ground. */
TEST(means_along_a_roll)
{
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

/* From rest: what it has lost in height and not to friction, m g (sin - mu cos)/cos for each metre, is in its speed and its spin. */
TEST(a_roll_from_rest)
{
    struct ground g;
    double cosine = 2 / sqrt(5), sine = 1 / sqrt(5), gain = GRAVITY * (sine - 0.25 * cosine) / cosine;
    static const enum ceduo_law laws[] = {CEDUO_LAW_LUMPED, CEDUO_LAW_CRSP};
    for (size_t i = 0; i < 2; i++) {
        make_ground(&g, 100, 0, 0, 0);
        g.scene.simulation.law = laws[i];
        struct ceduo_observation o = something(CEDUO_OBSERVED_WAY_ENERGY);
        o.from = 0;
        o.to = 50;
        expect_mean(&g, o, mass() * gain * 25, 1e-4);
        double k = laws[i] == CEDUO_LAW_LUMPED ? 0 : 0.4; /* of a sphere */
        o.kind = CEDUO_OBSERVED_WAY_SPEED;
        expect_mean(&g, o, 2. / 3 * sqrt(2 * gain / (1 + k) * 50), 1e-6);
    }
}

/* A fall straight down. */
TEST(a_fall)
{
    struct ground g;
    make_ground(&g, 0, HIGH, 0, 0);
    expect_mean(&g, something(CEDUO_OBSERVED_LARGEST_HEIGHT), HIGH, 1e-9);
    expect_mean(&g, something(CEDUO_OBSERVED_LARGEST_SPEED), sqrt(2 * GRAVITY * HIGH), 1e-9);
}

/* ---- rocks are those of a run ---- */

static void make_rough(struct ground *g)
{
    make_ground(g, 80, 1, 2, 0);
    g->scene.simulation.law = CEDUO_LAW_CRSP;
    g->segment.roughness_rad = 0.3;
    g->segment.rn = ceduo_number(0.4);
    g->segment.friction = 0.6;
}

/* A rough slope, so that rocks differ, and a law by which they spin: what is recorded of each rock is what its run keeps. */
TEST(recorded_rocks_are_those_of_a_run)
{
    struct ground g;
    make_rough(&g);
    struct ceduo_observation two[2] = {something(CEDUO_OBSERVED_STOPS), something(CEDUO_OBSERVED_LARGEST_SPEED)};
    double one = 50;
    two[0].n = 1;
    two[0].values = &one;
    two[1].n = 2;
    two[1].mean = two[1].sd = 1;
    LOCAL(ceduo_observer, both), *alone;
    LOCAL_BYTES double *recorded, *run;
    size_t n, m;
    EXPECT(ceduo_observer_create(two, 2, &both), ==, CEDUO_OK);
    EXPECT(ceduo_observer_create(two, 1, &alone), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(both, &g.scene, 0, ROCKS, &recorded, &n), ==, CEDUO_OK);
    EXPECT(ceduo_observer_values(alone, &g.scene, 0, ROCKS, &run, &m), ==, CEDUO_OK);
    EXPECT(n, ==, ROCKS);
    assert_memory_equal(recorded, run, ROCKS * sizeof *run);
}

/* Speed, height and energy at a place, of rocks that are followed and of those of a run. */
TEST(recorded_crossings_are_those_of_a_run)
{
    struct ground g;
    make_rough(&g);
    for (int k = 0; k < 3; k++) {
        struct ceduo_observation two[2] = {something((enum ceduo_observed_kind)(CEDUO_OBSERVED_SPEED + k)),
                                           something(CEDUO_OBSERVED_LARGEST_SPEED)};
        two[0].x = 60;
        two[0].n = two[1].n = 2;
        two[0].mean = two[0].sd = two[1].mean = two[1].sd = 1;
        LOCAL(ceduo_observer, both), *alone;
        LOCAL_BYTES double *recorded, *run;
        size_t n, m, reached = 0;
        EXPECT(ceduo_observer_create(two, 2, &both), ==, CEDUO_OK);
        EXPECT(ceduo_observer_create(two, 1, &alone), ==, CEDUO_OK);
        EXPECT(ceduo_observer_values(both, &g.scene, 0, ROCKS, &recorded, &n), ==, CEDUO_OK);
        EXPECT(ceduo_observer_values(alone, &g.scene, 0, ROCKS, &run, &m), ==, CEDUO_OK);
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

/* Places of one rock share its run; a rock and a release of its own, or another option, do not. By the index nothing is in the way. */
TEST(what_is_of_its_own)
{
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    struct ceduo_rock_def small = g.scene.rock;
    struct ceduo_release slow = g.scene.release;
    struct ceduo_observation o[6];
    struct ceduo_counterpart c[6];
    struct ceduo_option options[2] = {g.option, g.option};
    struct ceduo_stems tree = {.per_ha = 1e5, .dbh = 1, .height = 100, .volume = 10, .age = NAN};
    struct ceduo_belt belt = {.from = 1, .to = 100, .to_given = 100, .cut_year = NAN};
    small.diameter = ceduo_number(0.5);
    slow.vx = ceduo_number(FAST / 2);
    belt.stand = (struct ceduo_stand){.species = -1, .trees_count = 1, .trees = &tree, .u = 1e7, .fracture_ratio = NAN};
    options[1].belts = &belt;
    options[1].belts_count = 1;
    g.scene.options = options;
    g.scene.options_count = 2;
    for (int i = 0; i < 6; i++) {
        o[i] = something(i == 3 ? CEDUO_OBSERVED_SPEED : CEDUO_OBSERVED_ENERGY);
        o[i].x = i == 4 ? 5 : 10;
        o[i].mean = o[i].sd = 1;
        o[i].n = 2;
    }
    o[1].rock = &small;
    o[2].release = &slow;
    o[5].option = 1;
    double seconds[6] = {1, 1, 2, 1, 0.5, 1};
    for (int way = 0; way < 2; way++) {
        LOCAL(ceduo_observer, observer);
        if (way == 1)
            g.scene.simulation.contact_model = CEDUO_INDEX;
        EXPECT(ceduo_observer_create(o, 6, &observer), ==, CEDUO_OK);
        EXPECT(ceduo_observer_look(observer, &g.scene, ROCKS, NULL, c), ==, CEDUO_OK);
        for (int i = 0; i < 6; i++) {
            double v = i == 2 ? FAST / 2 : FAST, speed2 = v * v + GRAVITY * GRAVITY * seconds[i] * seconds[i];
            if (i == 5 && way == 0)
                EXPECT(c[i].rocks, ==, 0); /* stopped by stems */
            else
                EXPECT_NEAR(c[i].mean, i == 3 ? sqrt(speed2) : mass() / (i == 1 ? 8 : 1) * speed2 / 2, 1e-6);
        }
    }
    g.scene.simulation.contact_model = CEDUO_INDEX;
    struct ceduo_observation largest = something(CEDUO_OBSERVED_LARGEST_HEIGHT);
    largest.option = 1;
    expect_mean(&g, largest, HIGH, 1e-9);
}

/* Where the scene makes no sense, or nobody waits any longer, nothing is compared. */
TEST(what_cannot_be_looked_at)
{
    struct ground g;
    make_ground(&g, 0, HIGH, FAST, 0);
    struct ceduo_observation o[2] = {something(CEDUO_OBSERVED_SPEED), something(CEDUO_OBSERVED_LARGEST_SPEED)};
    o[0].x = 10;
    struct ceduo_observer *observer;
    struct ceduo_counterpart c[2];
    const atomic_bool cancelled = true;
    for (size_t i = 0; i < 2; i++) {
        double *values;
        size_t n;
        EXPECT(ceduo_observer_create(&o[i], 1, &observer), ==, CEDUO_OK);
        EXPECT(ceduo_observer_look(observer, &g.scene, ROCKS, &cancelled, c), ==, CEDUO_CANCELLED);
        g.scene.slope.vertices = 1;
        EXPECT(ceduo_observer_values(observer, &g.scene, 0, ROCKS, &values, &n), !=, CEDUO_OK);
        assert_null(values);
        g.scene.slope.vertices = 2;
        ceduo_observer_free(observer);
    }
    ceduo_observer_free(NULL);
}

/* ---- scars ---- */

TEST(scars_are_counted_and_measured)
{
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
    atomic_bool cancelled = true;
    def.cancel = &cancelled;
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_CANCELLED);
    assert_null(record.rocks);
    def.cancel = NULL;
    g.scene.release.height = ceduo_number(100); /* over the trees: met, not hit */
    belt.to = belt.to_given = 5;
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    EXPECT(record.blows_count, ==, 0);
    ceduo_record_release(&record);
}

/* Stems as strong as rock: where they stop a rock is where it lies. */
TEST(rocks_lie_where_stems_stop_them)
{
    struct ground g;
    struct ceduo_stems tree = {.per_ha = 1e5, .dbh = 1, .height = 15, .volume = 10, .age = NAN};
    struct ceduo_belt belt = {.from = 1, .to = 100, .to_given = 100, .cut_year = NAN};
    make_ground(&g, 80, 0, 5, -2);
    belt.stand = (struct ceduo_stand){.species = -1, .trees_count = 1, .trees = &tree, .u = 1e7, .fracture_ratio = NAN};
    g.option.belts = &belt;
    g.option.belts_count = 1;
    LOCAL_BY(ceduo_record_release) struct ceduo_record record;
    const struct ceduo_record_def def = {.scene = &g.scene, .option = &g.option, .rocks = 5, .blows = true};
    EXPECT(ceduo_record(&def, &record), ==, CEDUO_OK);
    EXPECT(record.blows_count, ==, 5);
    for (size_t i = 0; i < 5; i++)
        EXPECT_NEAR(record.rocks[i].stop_x, record.blows[i].x, 1e-9);
}
