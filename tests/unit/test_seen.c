/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is shown of things seen, against closed forms: the band of stops is binomial; a scene as it is has the band of a flight. */
#include "expect.h"

#include <stdlib.h>
#include <string.h>

#include "ceduo/calibrate.h"
#include "ceduo/ceduo.h"
#include "study/seen.h"

#define FIRST 0
#define LAST  (CEDUO_SEEN_PLACES - 1)

/* Of ten rocks that all stopped, half of the simulated lie beyond the middle: a binomial law of 10 and 1/2 has 0.0107 up to 1 and
 * 0.0547 up to 2, and is symmetric. */
static void half_of_ten(void **state)
{
    (void)state;
    double seen[10] = {0, 1, 1, 1, 1, 1, 9, 9, 9, 10}, simulated[4] = {0, 1, 9, 10};
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 10, .values = seen};
    struct ceduo_seen_stops s = {0};
    ceduo_seen_stops_of(&o, simulated, 4, 4, &s);
    size_t middle = CEDUO_SEEN_PLACES / 2;
    EXPECT(s.known, ==, true);
    EXPECT_NEAR(s.x[FIRST], 0, 1e-12);
    EXPECT_NEAR(s.x[LAST], 10, 1e-12);
    EXPECT_NEAR(s.seen[FIRST], 0.9, 1e-12);
    EXPECT_NEAR(s.seen[middle], 0.4, 1e-12);
    EXPECT_NEAR(s.seen[LAST], 0, 1e-12);
    EXPECT_NEAR(s.lo[middle], 0.2, 1e-12);
    EXPECT_NEAR(s.hi[middle], 0.8, 1e-12);
    EXPECT_NEAR(s.hi[LAST], 0, 1e-12);
}

/* Where it is known how many were released, those that went on lie farther: of the rocks seen 6 of 10, of the simulated 4 of 8. */
static void those_that_go_on_lie_farther(void **state)
{
    (void)state;
    double seen[4] = {2, 3, 4, 5}, simulated[4] = {1, 2, 3, 6};
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 4, .of = 10, .values = seen};
    struct ceduo_seen_stops s = {0};
    ceduo_seen_stops_of(&o, simulated, 4, 8, &s);
    EXPECT_NEAR(s.x[FIRST], 1, 1e-12);
    EXPECT_NEAR(s.x[LAST], 6, 1e-12);
    EXPECT_NEAR(s.seen[FIRST], 1, 1e-12);
    EXPECT_NEAR(s.seen[LAST], 0.6, 1e-12);
    EXPECT_NEAR(s.lo[LAST], 0.2, 1e-12);
    EXPECT_NEAR(s.hi[LAST], 0.8, 1e-12);
    EXPECT_NEAR(s.hi[FIRST], 1, 1e-12);
}

/* All at one place have no extent along the slope. */
static void one_place_has_no_picture(void **state)
{
    (void)state;
    double one = 5;
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_STOPS, .n = 1, .values = &one};
    struct ceduo_seen_stops s = {.known = true};
    ceduo_seen_stops_of(&o, &one, 1, 1, &s);
    EXPECT(s.known, ==, false);
}

/* Over level ground, from 100 m above it with 10 m/s along. */
static struct ceduo_scene flight(void)
{
    static double x[] = {0, 200}, z[] = {0, 0};
    static struct ceduo_segment segment;
    static struct ceduo_option option = {.name = (char *)(uintptr_t) "bare"};
    segment = (struct ceduo_segment){
        .rn = ceduo_number(0), .rt = ceduo_number(1), .roughness_m = NAN, .roughness_rad = 0, .friction = 0.25};
    struct ceduo_scene scene = ceduo_scene_default();
    scene.slope = (struct ceduo_slope){.vertices = 2, .x = x, .z = z, .segments = &segment, .segments_given = 1};
    scene.rock.shape = CEDUO_SPHERE;
    scene.rock.diameter = ceduo_number(1);
    scene.rock.density = ceduo_number(2600);
    scene.release.height = ceduo_number(100);
    scene.release.vx = ceduo_number(10);
    scene.options = &option;
    scene.options_count = 1;
    return scene;
}

/* Rocks that are alike fly 20 m in 2 s: hypot(10, 9.81 * 2) = 22.021 m/s. The band is that of the mean of five that differ by
 * 0.5 m/s; one that was seen 2 m/s below cannot be. All pass. */
static void a_flight_as_it_is(void **state)
{
    (void)state;
    struct ceduo_scene scene = flight();
    const struct ceduo_observation o[] = {
        {.kind = CEDUO_OBSERVED_SPEED, .x = 20, .n = 5, .mean = 22, .sd = 0.5},
        {.kind = CEDUO_OBSERVED_SPEED, .x = 20, .n = 5, .mean = 20, .sd = 0.5},
        {.kind = CEDUO_OBSERVED_PASSED, .x = 20, .count = 10, .of = 10},
    };
    const struct ceduo_calibration_scene asked = {.scene = &scene, .observations_count = 3, .observations = o};
    struct ceduo_predicted p[3];
    EXPECT(ceduo_calibration_as_it_is(&asked, 2000, NULL, p), ==, CEDUO_OK);
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
    scene.slope.vertices = 1;
    EXPECT(ceduo_calibration_as_it_is(&asked, 100, NULL, p), !=, CEDUO_OK);
}

/* Two shapes, both to be fitted, under the law that knows a shape. */
static void two_shapes_tell_mu(void **state)
{
    (void)state;
    struct ceduo_scene scene = ceduo_scene_default();
    scene.simulation.law = CEDUO_LAW_ARM;
    scene.rock.shape = CEDUO_BLOCK;
    for (int i = 0; i < 3; i++)
        scene.rock.axes[i] = ceduo_number(0.5);
    struct ceduo_rock_def plate = scene.rock, larger = scene.rock;
    plate.axes[1] = ceduo_number(0.1);
    for (int i = 0; i < 3; i++)
        larger.axes[i] = ceduo_number(0.8);
    struct ceduo_observation o[3] = {{.kind = CEDUO_OBSERVED_STOPS}, {.kind = CEDUO_OBSERVED_STOPS}, {.kind = CEDUO_OBSERVED_STOPS}};
    const struct ceduo_calibration_scene scenes[2] = {{.scene = &scene, .observations_count = 3, .observations = o},
                                                      {.scene = &scene, .observations_count = 1, .observations = o}};
    o[1].rock = &larger;
    assert_false(ceduo_calibration_tells_mu(scenes, 2)); /* of one shape */
    o[2].rock = &plate;
    assert_true(ceduo_calibration_tells_mu(scenes, 2));
    o[2].use = CEDUO_OBSERVED_CHECK;
    assert_false(ceduo_calibration_tells_mu(scenes, 2)); /* the other is not fitted */
    o[2].use = CEDUO_OBSERVED_FIT;
    scene.simulation.law = CEDUO_LAW_LUMPED;
    assert_false(ceduo_calibration_tells_mu(scenes, 2));
}

/* ---- a fit that is ended ---- */

struct ending {
    atomic_bool cancelled;
    enum ceduo_calibration_stage stage;
};

static void cancel_at(void *context, const struct ceduo_calibration_state *state)
{
    struct ending *e = context;
    if (state->stage >= e->stage)
        atomic_store(&e->cancelled, true);
}

/* Whenever it is ended, what is known so far is the answer, or nothing is where all was asked for. Rocks fly 20 m in 2 s with the
 * speed that is fitted: of hypot(v, 19.62) = 22.021 m/s the best v is 10 m/s. */
static void a_fit_is_ended(void **state)
{
    (void)state;
    static const char *const place = "release.vx_m_s";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 5, 15, .places_count = 1, .places = &place};
    struct ceduo_scene scene = flight();
    const struct ceduo_observation o = {.kind = CEDUO_OBSERVED_LARGEST_SPEED, .n = 5, .mean = hypot(10, sqrt(2 * 9.81 * 100)), .sd = 0.1};
    const struct ceduo_calibration_scene fitted = {&scene, &input, 1, &o};
    for (int stage = CEDUO_SEARCH; stage <= CEDUO_CHAINS; stage++)
        for (int whole = 0; whole < 2; whole++) {
            struct ending e = {false, (enum ceduo_calibration_stage)stage};
            struct ceduo_calibration a;
            const struct ceduo_calibration_def def = {.scenes_count = 1, .scenes = &fitted, .parameters_count = 1, .rocks = 2,
                                                      .seed = 1, .threads = 1, .cancel = &e.cancelled, .whole = whole == 1,
                                                      .progress = cancel_at, .context = &e};
            EXPECT(ceduo_calibrate(&def, &a), ==, whole == 1 ? CEDUO_CANCELLED : CEDUO_OK);
            if (whole == 1)
                continue;
            assert_false(a.complete);
            EXPECT(a.predicted_count, ==, 1);
            EXPECT_NEAR(a.parameters[0].best, 10, stage == CEDUO_SEARCH ? 5 : 0.05);
            ceduo_calibration_free(&a);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_of_ten),
        cmocka_unit_test(a_fit_is_ended),
        cmocka_unit_test(two_shapes_tell_mu),
        cmocka_unit_test(those_that_go_on_lie_farther),
        cmocka_unit_test(one_place_has_no_picture),
        cmocka_unit_test(a_flight_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
