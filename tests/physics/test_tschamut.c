/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Validation of the law arm at Tschamut: one ground fits the observed stops of three blocks of different shape. Without their
 * shapes it does not. */
#include "expect.h"
#include "study/observe.h"

#include "io/scene_file.h"
#include "stops.h"

#define BLOCKS 3
#define ROCKS  3000

static struct scene_file file;

static int read_scene(void **state)
{
    (void)state;
    struct problems problems = {0};
    return ceduo_scene_load(&file, "profiles/scenes/tschamut-arm.yaml", NULL, 0, &problems) ? 0 : -1;
}

static int free_scene(void **state)
{
    (void)state;
    ceduo_scene_release(&file);
    return 0;
}

/* Set the distances and mean stops of the blocks. */
static void compare_stops(const struct ceduo_observation *observed, double distance[BLOCKS], double mean[BLOCKS])
{
    struct ceduo_observer *observer;
    assert_int_equal(ceduo_observer_create(observed, BLOCKS, &observer), CEDUO_OK);
    for (size_t b = 0; b < BLOCKS; b++) {
        double *values;
        size_t n;
        assert_int_equal(ceduo_observer_values(observer, &file.scene, b, ROCKS, &values, &n), CEDUO_OK);
        distance[b] = stops_distance(&observed[b], values, n, &mean[b]);
        free(values);
    }
    ceduo_observer_free(observer);
}

TEST(one_ground_fits_three_blocks)
{
    double distance[BLOCKS], mean[BLOCKS];
    assert_int_equal(file.observations_count, BLOCKS);
    const size_t counts[BLOCKS] = {29, 25, 26}; /* Volkwein and Gerber 2018 */
    compare_stops(file.observations, distance, mean);
    for (size_t b = 0; b < BLOCKS; b++) {
        EXPECT(file.observations[b].n, ==, counts[b]);
        EXPECT(distance[b], <, stops_critical_distance(counts[b]));
    }
}

/* Spheres of the same mean diameter all stop at one place. */
TEST(a_plate_simulated_as_a_sphere_goes_too_far)
{
    struct ceduo_observation round[BLOCKS];
    struct ceduo_rock_def rocks[BLOCKS];
    double distance[BLOCKS], mean[BLOCKS];
    for (size_t b = 0; b < BLOCKS; b++) {
        round[b] = file.observations[b];
        const struct ceduo_rock_def *rock = round[b].rock ? round[b].rock : &file.scene.rock;
        rocks[b] = ceduo_scene_default().rock;
        rocks[b].diameter = ceduo_number(ceduo_rock_mean(rock).mean_diameter);
        round[b].rock = &rocks[b];
    }
    compare_stops(round, distance, mean);
    EXPECT(distance[2], >, 2 * stops_critical_distance(round[2].n));
    EXPECT_NEAR(mean[2], mean[0], 1.5);
}

AROUND_TESTS(read_scene, free_scene);
