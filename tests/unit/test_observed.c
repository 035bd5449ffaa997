/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Displays of observations, in closed form: the band of stops is binomial; a comparison without a fit has the band of a
 * flight. */
#include "expect.h"
#include "local.h"
#include "study/predict.h"

#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "study/observed_stops.h"
#include "unit/ground.h"

#define FIRST 0
#define LAST  (CEDUO_STOPS_PLACES - 1)

/* Ten stopped rocks, and half of the simulated ones beyond the median: the binomial law of 10 and 1/2 has 0.0107 up to 1 and
 * 0.0547 up to 2, and is symmetric. */
TEST(band_of_half_of_ten)
{
    double observed[10] = {0, 1, 1, 1, 1, 1, 9, 9, 9, 10}, simulated[4] = {0, 1, 9, 10};
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 10, .values = observed};
    struct ceduo_observed_stops s = {0};
    ceduo_observed_stops_find(&o, simulated, 4, 4, &s);
    size_t middle = CEDUO_STOPS_PLACES / 2;
    EXPECT(s.known, ==, true);
    EXPECT_NEAR(s.x[FIRST], 0, 1e-12);
    EXPECT_NEAR(s.x[LAST], 10, 1e-12);
    EXPECT_NEAR(s.observed[FIRST], 0.9, 1e-12);
    EXPECT_NEAR(s.observed[middle], 0.4, 1e-12);
    EXPECT_NEAR(s.observed[LAST], 0, 1e-12);
    EXPECT_NEAR(s.lo[middle], 0.2, 1e-12);
    EXPECT_NEAR(s.hi[middle], 0.8, 1e-12);
    EXPECT_NEAR(s.hi[LAST], 0, 1e-12);
    const struct ceduo_observation five = {.kind = CEDUO_OBSERVED_STOPS, .n = 5, .values = (double[]){0, 1, 1, 9, 10}};
    ceduo_observed_stops_find(&five, simulated, 4, 4, &s); /* none and all have probability 1/32: above 2.5 % */
    EXPECT_NEAR(s.lo[middle], 0, 1e-12);
    EXPECT_NEAR(s.hi[middle], 1, 1e-12);
}

/* If the number released is known, rocks that went on lie farther: 6 of 10 observed, 4 of 8 simulated. */
TEST(rocks_that_did_not_stop_lie_farther)
{
    double observed[4] = {2, 3, 4, 5}, simulated[4] = {1, 2, 3, 6};
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 4, .released_count = 10, .values = observed};
    struct ceduo_observed_stops s = {0};
    ceduo_observed_stops_find(&o, simulated, 4, 8, &s);
    EXPECT_NEAR(s.x[FIRST], 1, 1e-12);
    EXPECT_NEAR(s.x[LAST], 6, 1e-12);
    EXPECT_NEAR(s.observed[FIRST], 1, 1e-12);
    EXPECT_NEAR(s.observed[LAST], 0.6, 1e-12);
    EXPECT_NEAR(s.lo[LAST], 0.2, 1e-12);
    EXPECT_NEAR(s.hi[LAST], 0.8, 1e-12);
    EXPECT_NEAR(s.hi[FIRST], 1, 1e-12);
}

/* Stops at one place have no extent along the slope. */
TEST(one_place_has_no_picture)
{
    double one = 5;
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 1, .values = &one};
    struct ceduo_observed_stops s = {.known = true};
    ceduo_observed_stops_find(&o, &one, 1, 1, &s);
    EXPECT(s.known, ==, false);
}

/* Equal rocks fly 20 m in 2 s: hypot(10, 9.81 * 2) = 22.021 m/s. The band is the mean's of five that differ by 0.5 m/s; one
 * observed 2 m/s below is impossible. All pass. */
TEST(a_flight_without_a_fit)
{
    struct ground g;
    ground_make(&g, 200, 0, 100, 10, 0);
    const struct ceduo_observation o[] = {
        {.kind = CEDUO_OBSERVED_SPEED, .x = 20, .n = 5, .mean = 22, .sd = 0.5},
        {.kind = CEDUO_OBSERVED_SPEED, .x = 20, .n = 5, .mean = 20, .sd = 0.5},
        {.kind = CEDUO_OBSERVED_PASSED, .x = 20, .count = 10, .released_count = 10},
    };
    const struct ceduo_calibration_scene asked = {.scene = &g.scene, .observations_count = 3, .observations = o};
    struct ceduo_predicted p[3];
    EXPECT(ceduo_compare_with_observations(&asked, 2000, NULL, p), ==, CEDUO_OK);
    double speed = hypot(10, 9.81 * 2), half = 1.96 * 0.5 / sqrt(5);
    for (size_t i = 0; i < 2; i++) {
        EXPECT_NEAR(p[i].lo, speed - half, 0.06);
        EXPECT_NEAR(p[i].hi, speed + half, 0.06);
        EXPECT(p[i].observation, ==, i);
    }
    EXPECT(p[0].inside && p[0].p_value > 0.5, ==, true);
    EXPECT(p[1].inside || p[1].p_value > 0.001, ==, false);
    EXPECT_NEAR(p[2].lo, 10, 1e-12);
    EXPECT(p[2].inside, ==, true);
    EXPECT(ceduo_compare_with_observations(&asked, 0, NULL, p), ==, CEDUO_BAD_ARGUMENT);
    EXPECT(ceduo_compare_with_observations(&asked, CEDUO_ROCKS_MAX + 1, NULL, p), ==, CEDUO_BAD_ARGUMENT);
    g.scene.options_count = 0;
    EXPECT(ceduo_compare_with_observations(&asked, 100, NULL, p), ==, CEDUO_BAD_ARGUMENT);
    g.scene.options_count = 1;
    g.scene.slope.vertices = 1;
    EXPECT(ceduo_compare_with_observations(&asked, 100, NULL, p), !=, CEDUO_OK);
}

/* Two shapes, both fitted, under the law that uses the shape. */
TEST(two_shapes_identify_mu)
{
    struct ceduo_scene scene = ceduo_scene_default();
    scene.simulation.law = CEDUO_LAW_ARM;
    scene.rock.shape = CEDUO_SHAPE_BLOCK;
    for (int i = 0; i < 3; i++)
        scene.rock.axes[i] = ceduo_number(0.5);
    struct ceduo_rock_def plate = scene.rock, larger = scene.rock;
    plate.axes[1] = ceduo_number(0.1);
    for (int i = 0; i < 3; i++)
        larger.axes[i] = ceduo_number(0.8);
    struct ceduo_observation o[3] = {
        {.kind = CEDUO_OBSERVED_STOPS}, {.kind = CEDUO_OBSERVED_STOPS}, {.kind = CEDUO_OBSERVED_STOPS}};
    const struct ceduo_calibration_scene scenes[2] = {{.scene = &scene, .observations_count = 3, .observations = o},
                                                      {.scene = &scene, .observations_count = 1, .observations = o}};
    o[1].rock = &larger;
    assert_false(ceduo_calibration_identifies_mu(scenes, 2)); /* one shape */
    o[2].rock = &plate;
    assert_true(ceduo_calibration_identifies_mu(scenes, 2));
    assert_false(ceduo_calibration_identifies_mu(scenes, 0));
    o[2].use = CEDUO_OBSERVED_USE_CHECK;
    assert_false(ceduo_calibration_identifies_mu(scenes, 2)); /* the other one is not fitted */
    o[2].use = CEDUO_OBSERVED_USE_FIT;
    scene.simulation.law = CEDUO_LAW_LUMPED;
    assert_false(ceduo_calibration_identifies_mu(scenes, 2));
}

/* ---- a fit that is stopped ---- */

struct ending {
    atomic_bool cancelled;
    enum ceduo_calibration_stage stage;
};

static void cancel_at_stage(void *context, const struct ceduo_calibration_state *state)
{
    struct ending *e = context;
    if (state->stage >= e->stage)
        atomic_store(&e->cancelled, true);
}

/* Level ground, and rocks that fall 100 m: their final speed, hypot(v, sqrt(2 g h)), identifies v. */
static struct flight {
    struct ground ground;
    struct ceduo_observation observed;
} flights[2];

static const char *const speed = "release.vx_m_s", *const place = "release.x_m";

static struct ceduo_input range(const char *const *path, double lo, double hi)
{
    return (struct ceduo_input){*path, CEDUO_INPUT_RANGE, lo, hi, .places_count = 1, .places = path};
}

static void make_flight(struct flight *f, double v, double sd)
{
    ground_make(&f->ground, 200, 0, 100, 10, 0);
    f->observed = (struct ceduo_observation){
        .kind = CEDUO_OBSERVED_LARGEST_SPEED, .n = 5, .mean = hypot(v, sqrt(2 * 9.81 * 100)), .sd = sd};
}

static struct ceduo_calibration_def run_fit(const struct ceduo_calibration_scene *scenes, size_t n, size_t parameters)
{
    return (struct ceduo_calibration_def){.size = sizeof(struct ceduo_calibration_def),
                                          .scenes_count = n,
                                          .scenes = scenes,
                                          .parameters_count = parameters,
                                          .rocks = 2,
                                          .seed = 1,
                                          .threads = 1};
}

/* Stopped at any time, there is no result. */
TEST(a_fit_can_be_stopped)
{
    const struct ceduo_input input = range(&speed, 5, 15);
    make_flight(&flights[0], 10, 0.1);
    const struct ceduo_calibration_scene fitted = {&flights[0].ground.scene, &input, 1, &flights[0].observed};
    struct ceduo_calibration_def def = run_fit(&fitted, 1, 1);
    struct ceduo_calibration a;
    struct ending e;
    def.cancel = &e.cancelled;
    def.progress = cancel_at_stage;
    def.context = &e;
    for (int stage = CEDUO_CALIBRATION_STAGE_SEARCH; stage <= CEDUO_CALIBRATION_STAGE_CHAINS; stage++) {
        e = (struct ending){false, (enum ceduo_calibration_stage)stage};
        EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_CANCELLED);
    }
    e = (struct ending){true, CEDUO_CALIBRATION_STAGE_SEARCH}; /* before any result */
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_CANCELLED);
}

/* Chains of a given length stop there, converged or not: of two rounds the second half of each of four chains is used. If
 * cancelled at their end, there is no result. */
TEST(a_fit_of_few_steps)
{
    const struct ceduo_input input = range(&speed, 5, 15);
    make_flight(&flights[0], 10, 0.1);
    const struct ceduo_calibration_scene fitted = {&flights[0].ground.scene, &input, 1, &flights[0].observed};
    struct ceduo_calibration_def def = run_fit(&fitted, 1, 1);
    struct ceduo_calibration a;
    def.steps_max = 2 * 50 + 1;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    assert_false(a.converged);
    EXPECT(a.draws_count, ==, 4 * 51);
    ceduo_calibration_release(&a);
    def.steps_max = 1;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    assert_false(a.converged);
    EXPECT(a.draws_count, ==, 0);
    ceduo_calibration_release(&a);
    struct ending e = {false, CEDUO_CALIBRATION_STAGE_CHAINS};
    def.cancel = &e.cancelled;
    def.progress = cancel_at_stage;
    def.context = &e;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_CANCELLED);
}

/* Without draws two values have no correlation. */
TEST(two_values_without_draws)
{
    const struct ceduo_input inputs[2] = {range(&speed, 5, 15), range(&place, 0, 50)};
    make_flight(&flights[0], 10, 0.1);
    const struct ceduo_calibration_scene fitted = {&flights[0].ground.scene, inputs, 1, &flights[0].observed};
    struct ceduo_calibration_def def = run_fit(&fitted, 1, 2);
    LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a;
    def.steps_max = 1;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    EXPECT(a.correlation[0][0], ==, 1);
    EXPECT(a.correlation[1][1], ==, 1);
    assert_true(isnan(a.correlation[0][1]) && isnan(a.correlation[1][0]));
}

/* One of two scenes ends at 30 m. The other's observation is a fall over an edge at 60 m, which only rocks released beyond 40 m
 * reach. The fitted place must exist in both scenes, however badly it fits. */
TEST(a_place_exists_in_both_scenes)
{
    const struct ceduo_input input = range(&place, 0, 100);
    struct ceduo_calibration_scene fitted[2];
    struct ceduo_calibration a;
    double x[] = {0, 60, 61, 200}, z[] = {0, 0, -100, -100};
    struct ceduo_segment segments[3];
    for (size_t i = 0; i < 2; i++) {
        make_flight(&flights[i], 10, 0.1);
        flights[i].ground.segment.friction = 2;
        flights[i].ground.scene.release.height = ceduo_number(5);
        fitted[i] = (struct ceduo_calibration_scene){&flights[i].ground.scene, &input, 1, &flights[i].observed};
    }
    flights[0].ground.x[1] = 30;
    flights[0].observed.mean = hypot(10, sqrt(2 * 9.81 * 5));
    for (size_t i = 0; i < 3; i++)
        segments[i] = flights[1].ground.segment;
    flights[1].ground.scene.slope =
        (struct ceduo_slope){.vertices = 4, .x = x, .z = z, .segments = segments, .segments_given = 3};
    struct ceduo_calibration_def def = run_fit(fitted, 2, 1);
    def.steps_max = 1;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    EXPECT(a.parameters[0].best, <, 30);
    ceduo_calibration_release(&a);
    def = run_fit(&fitted[1], 1, 1);
    def.steps_max = 1;
    EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
    EXPECT(a.parameters[0].best, >, 40);
    ceduo_calibration_release(&a);
}

/* A value with half of its draws in the last 5 % of its bounds is at its bound, even if the best is 3 % away; at 10 % it is
 * not. */
TEST(half_of_the_draws_at_a_bound)
{
    const struct ceduo_input input = range(&speed, 5, 15);
    const double v[2] = {5.3, 6};
    for (int i = 0; i < 2; i++) {
        make_flight(&flights[0], v[i], 0.01);
        const struct ceduo_calibration_scene fitted = {&flights[0].ground.scene, &input, 1, &flights[0].observed};
        struct ceduo_calibration_def def = run_fit(&fitted, 1, 1);
        LOCAL_BY(ceduo_calibration_release) struct ceduo_calibration a;
        def.steps_max = 251;
        EXPECT(ceduo_calibrate(&def, &a), ==, CEDUO_OK);
        EXPECT_NEAR(a.parameters[0].best, v[i], 0.02);
        assert_true(a.parameters[0].identified);
        EXPECT(a.parameters[0].at_bound, ==, i == 0);
    }
}
