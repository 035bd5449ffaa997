/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fences: closed forms of the shares that defeat one, of percentiles and rates, and the choice of class and height. */
#include "ceduo/ceduo.h"
#include "core/runs/fence.h"
#include "core/runs/run.h"

#include <math.h>
#include <stdlib.h>

#include "expect.h"
#include "line_scene.h"
#include "local.h"
#include "runs.h"

#define ROCKS  40000
#define SIGMAS 4 /* largest distance of a sampled share from the true one, in standard errors */

/* A sphere of 1000 kg and 2600 kg/m3 falls over an edge of 8 m at 8 to 12 m/s. The control is in its flight, at x = 10. */
#define DIAMETER cbrt(6 * 1000 / (2600 * M_PI)) /* 0.902283 m */
static struct line_scene scene;

static void throw(double fall)
{
    const double x[] = {0, .01, 30}, z[] = {8, 0, 29.99 * fall};
    line_scene_init(&scene, 3, x, z, (struct line_ground){.3, .8, .5}, DIAMETER / 2, CEDUO_LAW_LUMPED);
    scene.scene.rock.density = ceduo_number(2600);
    line_scene_release(&scene, 0, 0, 10, 0, 0);
    scene.scene.release.vx.spread = 2;
    scene.scene.release.vx.kind = CEDUO_SPREAD_UNIFORM;
    scene.control = (struct ceduo_control){.x = 10, .x_given = 10, .accepted = NAN, .measured_speed = NAN};
    scene.scene.controls_count = 1;
    scene.scene.design = (struct ceduo_design_values){CEDUO_QUALITY_GOOD, CEDUO_QUALITY_GOOD, NAN};
}

static struct ceduo_fence_arrivals read_fence(const struct ceduo_run *run, double energy, double height,
                                              const struct ceduo_arrivals *bare)
{
    struct ceduo_fence_arrivals f;
    scene.control.fence = (struct ceduo_fence){.energy = energy, .height = height};
    assert_int_equal(ceduo_run_fence(run, &scene.scene, 0, bare, &f), CEDUO_OK);
    scene.control.fence = (struct ceduo_fence){0};
    return f;
}

static void expect_share(struct ceduo_estimate found, double wanted)
{
    EXPECT_NEAR(found.mean, wanted, SIGMAS * sqrt(wanted * (1 - wanted) / ROCKS) + 1e-12);
    EXPECT(found.lo, <=, found.mean);
    EXPECT(found.mean, <=, found.hi);
}

/* ---- the closed forms ---- */

TEST(shares_over_and_through_have_closed_forms)
{
    static const struct {
        double height, over;
    } heights[] = {{2, .892522}, {3, .720973}, {4, .499307}, {5, .197148}, {6, 0}};
    static const struct {
        double energy, through;
    } energies[] = {{99e3, .664590}, {100e3, .512660}, {104e3, .141222}, {250e3, 0}};
    throw(0);
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    for (size_t i = 0; i < LENGTH(heights); i++)
        expect_share(read_fence(run, 100e3, heights[i].height, NULL).above, heights[i].over);
    for (size_t i = 0; i < LENGTH(energies); i++)
        expect_share(read_fence(run, energies[i].energy, 3, NULL).through, energies[i].through);
    const struct ceduo_fence_arrivals f = read_fence(run, 100e3, 3, NULL);
    expect_share(f.both, .268233);
    expect_share(f.defeated, .965400);
    expect_share(f.worn, .034600);
    EXPECT_NEAR(f.defeated.mean, f.above.mean + f.through.mean - f.both.mean, 1e-12);
    EXPECT_NEAR(f.by_class[0], f.defeated.mean, 1e-12);
    EXPECT_NEAR(f.by_class[1], f.above.mean, 1e-12);
    EXPECT(isnan(f.per_year) && isnan(f.in_life), ==, true);
}

/* The fence is the next class that the limit allows: 6 m of class 1; with a limit of a fifth 5 m. */
TEST(the_smallest_class_has_the_lowest_height)
{
    throw(0);
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    struct ceduo_fence_arrivals f = read_fence(run, 100e3, 3, NULL);
    for (size_t h = 0; h < CEDUO_FENCE_HEIGHTS; h++) {
        EXPECT_IS(f.enough[h], (height, h + 2), (class_index, h < 4 ? CEDUO_FENCE_CLASSES : 1), (decided, true));
        EXPECT(isnan(f.enough[h].energy), ==, h < 4);
    }
    EXPECT_IS(*ceduo_fence_smallest(f.enough), (height, 6), (class_index, 1), (energy, 250e3), (defeated, 0));
    ceduo_fence_choose(&f.grid, .2, f.enough);
    EXPECT_IS(*ceduo_fence_smallest(f.enough), (height, 5), (class_index, 1), (energy, 250e3));
    ceduo_fence_choose(&f.grid, .1, f.enough);
    EXPECT(ceduo_fence_smallest(f.enough)->height, ==, 6);
}

/* A floor of 45 degrees turns only the clearance: the top is h/sqrt(2) + B. */
TEST(height_is_perpendicular_to_the_ground)
{
    throw(-1);
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    const double *height = ceduo_run_samples(run, 0, CEDUO_SAMPLE_HEIGHT);
    for (double h = 7; h < 12; h++) {
        size_t over = 0;
        for (size_t r = 0; r < ROCKS; r++)
            over += height[r] / M_SQRT2 + DIAMETER > h;
        EXPECT_NEAR(read_fence(run, 100e3, h, NULL).above.mean * ROCKS, (double)over, 1e-6);
    }
    const struct ceduo_fence_load load = read_fence(run, 100e3, 3, NULL).arriving;
    EXPECT_NEAR(load.top - load.middle, DIAMETER / 2, 1e-6);
    EXPECT_NEAR(load.top, (18 - .01 - 490.5 / (11.8 * 11.8)) / M_SQRT2 + DIAMETER, .01);
}

TEST(a_control_on_a_vertex_has_the_ground_before_it)
{
    const double x[] = {0, .01, 10, 30}, z[] = {8, 0, 0, -20};
    throw(0);
    struct line_scene flat = scene;
    line_scene_init(&scene, 4, x, z, (struct line_ground){.3, .8, .5}, DIAMETER / 2, CEDUO_LAW_LUMPED);
    scene.scene.release = flat.scene.release;
    scene.control = flat.control;
    scene.scene.controls_count = 1;
    scene.scene.design = (struct ceduo_design_values){-1, -1, NAN};
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    expect_share(read_fence(run, 100e3, 4, NULL).above, .499307);
}

TEST(bounds)
{
    throw(0);
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    const struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(read_fence(run, 1e12, 1e6, NULL).defeated.mean, ==, 0);
    const struct ceduo_fence_arrivals weak = read_fence(run, 0, 1e6, NULL), low = read_fence(run, 1e12, 1e-9, NULL);
    EXPECT_IS(weak.through, (mean, a.reach.mean), (lo, a.reach.lo), (hi, a.reach.hi));
    EXPECT_IS(low.above, (mean, a.reach.mean));
    EXPECT_IS(weak.above, (mean, 0));
    LOCAL(ceduo_run, fewer) = run_option(&scene.scene, NULL, ROCKS / 16, 1);
    const struct ceduo_fence_arrivals wide = read_fence(fewer, 100e3, 3, NULL), narrow = read_fence(run, 100e3, 3, NULL);
    EXPECT(narrow.above.hi - narrow.above.lo, <, (wide.above.hi - wide.above.lo) / 3);
    struct ceduo_fence_arrivals none;
    scene.scene.design = (struct ceduo_design_values){-1, -1, NAN};
    assert_int_equal(ceduo_run_fence(run, &scene.scene, 0, NULL, &none), CEDUO_OK);
    EXPECT(isnan(none.defeated.mean) && isnan(none.arriving.energy), ==, true);
    assert_int_equal(ceduo_run_fence(run, &scene.scene, 1, NULL, &none), CEDUO_BAD_ARGUMENT);
}

/* A limit that is met is not exceeded: a fence holds what equals its energy and height. */
TEST(what_equals_the_limit_is_held)
{
    line_scene_drop(&scene, 1, NAN); /* 5 m/s, underside 48 m up: E and top are known */
    scene.scene.design = (struct ceduo_design_values){-1, -1, NAN};
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, 10, 1);
    double energy = ceduo_run_samples(run, 0, CEDUO_SAMPLE_ENERGY)[0],
           top = ceduo_run_samples(run, 0, CEDUO_SAMPLE_HEIGHT)[0] + 2;
    EXPECT(read_fence(run, energy, top, NULL).defeated.mean, ==, 0);
    EXPECT(read_fence(run, nextafter(energy, 0), top, NULL).through.mean, ==, 1);
    EXPECT(read_fence(run, energy, nextafter(top, 0), NULL).above.mean, ==, 1);
    EXPECT(read_fence(run, 3 * energy * (1 + 1e-9), top, NULL).worn.mean, ==, 0);
    EXPECT(read_fence(run, 3 * energy * (1 - 1e-9), top, NULL).worn.mean, ==, 1);
}

/* ---- percentiles and design ---- */

/* Masses from 0 to 2 t in one trajectory: the energy is uniform. The forest lets 80 or 40 of 1000 rocks through that arrive
 * without it. */
TEST(percentiles_of_the_arrivals_and_of_the_system)
{
    line_scene_drop(&scene, 1, NAN);
    scene.scene.design = (struct ceduo_design_values){CEDUO_QUALITY_GOOD, CEDUO_QUALITY_GOOD, 1.2};
    scene.scene.rock.diameter = ceduo_number(NAN);
    scene.scene.rock.mass = (struct ceduo_number){.mean = 1000, .spread = 999.999, .kind = CEDUO_SPREAD_UNIFORM};
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    double largest = 2000 * 25 / 2.0, error = SIGMAS * largest * sqrt(.05 * .95 / ROCKS);
    struct ceduo_arrivals bare = {.reach.mean = 1000 / 80.0};
    const struct ceduo_fence_arrivals f = read_fence(run, 1, 1, &bare);
    EXPECT_NEAR(f.arriving.energy, .95 * largest, error);
    EXPECT_NEAR(f.system.energy, largest * (1 - 50 / 80.0), SIGMAS * largest * sqrt(.375 * .625 / ROCKS));
    bare.reach.mean = 1000 / 40.0;
    const struct ceduo_fence_arrivals fewer = read_fence(run, 1, 1, &bare);
    EXPECT(fewer.arriving.energy, ==, f.arriving.energy);
    EXPECT_IS(fewer.system, (energy, 0), (speed, 0), (top, 0), (middle, 0));
    bare.reach.mean = 1; /* no stem stops a rock */
    const struct ceduo_fence_arrivals all = read_fence(run, 1, 1, &bare);
    EXPECT_IS(all.system, (energy, all.arriving.energy), (speed, all.arriving.speed), (top, all.arriving.top));
    bare.reach.mean = NAN; /* unknown: no rock counts as stopped */
    const struct ceduo_fence_arrivals unknown = read_fence(run, 1, 1, &bare);
    EXPECT_IS(unknown.system, (energy, all.arriving.energy), (speed, all.arriving.speed), (top, all.arriving.top));
}

TEST(design_values)
{
    const struct ceduo_fence_factors good = {1.02, 1.10, 1.02, NAN}, factored = {1.02, 1.10, 1.02, 1.2};
    const struct ceduo_fence_load one = {20, 200e3, 2.702, 2.251}, high = {20, 285e3, 3.5, 2.5}, system = {20, 112.5e3, 1, 1},
                                  none = {0, 0, 0, 0}, unknown = {NAN, NAN, NAN, NAN};
    struct ceduo_fence_design d = ceduo_fence_design(&one, &factored);
    EXPECT_NEAR(d.speed, 22.44, 1e-12);
    EXPECT_NEAR(d.energy, 256.812e3, 1);
    EXPECT_NEAR(d.height, 2.751, 1e-12);
    EXPECT_IS(d, (class_index, 2), (class_factored, 2));
    d = ceduo_fence_design(&high, &factored);
    EXPECT_NEAR(d.energy, 365.96e3, 5);
    EXPECT_IS(d, (class_index, 2), (class_factored, 2), (height, 3.5));
    d = ceduo_fence_design(&system, &factored);
    EXPECT_NEAR(d.energy, 144.46e3, 5);
    EXPECT_IS(d, (class_index, 1), (class_factored, 1));
    EXPECT_IS(ceduo_fence_design(&system, &good), (class_index, 1), (class_factored, -1));
    EXPECT_IS(ceduo_fence_design(&none, &factored), (energy, 0), (height, 0), (class_index, -1), (class_factored, -1));
    EXPECT_IS(ceduo_fence_design(&unknown, &factored), (class_index, -1), (class_factored, -1));
}

TEST(classes)
{
    static const double limits[] = {100e3, 250e3, 500e3, 1000e3, 1500e3, 2000e3, 3000e3, 4500e3};
    for (int i = 0; i < (int)LENGTH(limits); i++) {
        EXPECT(ceduo_fence_class_energy[i], ==, limits[i]);
        EXPECT(ceduo_fence_class(limits[i]), ==, i);
        EXPECT(ceduo_fence_class(nextafter(limits[i], INFINITY)), ==, i + 1);
    }
    EXPECT(ceduo_fence_class(NAN), ==, -1);
}

TEST(the_last_class_needs_the_largest_energy)
{
    struct ceduo_fence_grid grid = {.energy = {[1] = 6e6}};
    struct ceduo_fence_choice choices[CEDUO_FENCE_HEIGHTS];
    for (size_t h = 0; h < CEDUO_FENCE_HEIGHTS; h++)
        for (size_t i = 0; i < CEDUO_FENCE_CLASSES; i++)
            grid.defeated[h][i] = (struct ceduo_estimate){h == 1 && i == 8 ? .05 : .2, NAN, .04, .3};
    ceduo_fence_choose(&grid, .05, choices);
    EXPECT_IS(*ceduo_fence_smallest(choices), (height, 3), (class_index, 8), (energy, 6e6), (decided, false));
    grid.defeated[1][8].mean = nextafter(.05, 1);
    ceduo_fence_choose(&grid, .05, choices);
    assert_null(ceduo_fence_smallest(choices));
}

/* ---- blocks ---- */

static double volumes[2];
static struct ceduo_size_class blocks = {.per_year = .02, .volumes_count = 2, .volumes = volumes};

/* Blocks of one size are rocks of this size, with rates. */
TEST(blocks_of_one_size_are_rocks)
{
    throw(0);
    LOCAL(ceduo_run, run) = run_option(&scene.scene, NULL, ROCKS, 1);
    const struct ceduo_fence_arrivals rocks = read_fence(run, 100e3, 3, NULL);
    volumes[0] = 1000 / 2600.0;
    volumes[1] = volumes[0] * (1 + 1e-9);
    scene.scene.blocks = &blocks;
    scene.scene.blocks_count = 1;
    LOCAL(ceduo_run, weighted) = run_option(&scene.scene, NULL, ROCKS, 1);
    const struct ceduo_fence_arrivals f = read_fence(weighted, 100e3, 3, NULL), weak = read_fence(weighted, 0, 3, NULL);
    const struct ceduo_estimate found[] = {f.above, f.through, f.both, f.defeated, f.worn},
                                wanted[] = {rocks.above, rocks.through, rocks.both, rocks.defeated, rocks.worn};
    for (size_t i = 0; i < LENGTH(found); i++) {
        EXPECT_NEAR(found[i].mean, wanted[i].mean, 1.5 / ROCKS);
        EXPECT_NEAR(found[i].lo, wanted[i].lo, 1e-4);
        EXPECT_NEAR(found[i].hi, wanted[i].hi, 1e-4);
    }
    EXPECT_NEAR(f.arriving.energy, rocks.arriving.energy, 1e-6 * rocks.arriving.energy);
    EXPECT_NEAR(f.per_year, .02 * f.defeated.mean, 1e-15);
    EXPECT_NEAR(weak.in_life, .632121, 1e-6); /* one in 50 years; all defeat it */
    scene.control.fence = (struct ceduo_fence){.height = 3, .life = 100};
    struct ceduo_fence_arrivals longer;
    assert_int_equal(ceduo_run_fence(weighted, &scene.scene, 0, NULL, &longer), CEDUO_OK);
    EXPECT_NEAR(longer.in_life, 1 - exp(-2), 1e-12);
}
