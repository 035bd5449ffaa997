/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks of other sizes: how a rock is scaled, the order of the sizes shown, and their mass in flight. */
#include "core/runs/blocks.h"
#include "core/runs/run.h"
#include "expect.h"
#include "local.h"
#include "scene/rock.h"

#include <math.h>

#include "line_scene.h"
#include "runs.h"
#include "unit/ground.h"

#define LIMESTONE    2600.0
#define BLOCKS_FLOWN 5

static const double volumes[] = {.05, .2, 1, 5}; /* classes of NaiS, and 1 m3 */

static void expect_near(const char *label, double found, double wanted)
{
    if (!(fabs(found - wanted) <= 1e-14 * fabs(wanted)))
        fail_msg("%s: %.17g is not %.17g", label, found, wanted);
}

/* ---- one rock ---- */

static struct ceduo_number number(double mean, double spread)
{
    return (struct ceduo_number){mean, spread, CEDUO_SPREAD_UNIFORM};
}

static void expect_scaled(const char *label, struct ceduo_number found, struct ceduo_number was, double factor)
{
    if (found.mean != factor * was.mean || found.spread != factor * was.spread || found.kind != was.kind)
        fail_msg("%s: %g ± %g, not %g times %g ± %g", label, found.mean, found.spread, factor, was.mean, was.spread);
}

/* A standard deviation scales with its mean, so the density's does not change. */
TEST(a_rock_twice_as_long_is_eight_times_as_heavy)
{
    const struct ceduo_rock_def was = {.shape = CEDUO_SHAPE_BLOCK,
                                       .diameter = number(.5, .125),
                                       .height = number(.75, .0625),
                                       .volume = number(.25, .03125),
                                       .mass = number(640, 64),
                                       .density = number(LIMESTONE, 100),
                                       .axes = {number(.5, .25), number(1, .5), number(1.5, .75)}};
    struct ceduo_rock_def after = ceduo_rock_scaled(&was, 2);
    assert_int_equal(after.shape, CEDUO_SHAPE_BLOCK);
    expect_scaled("diameter", after.diameter, was.diameter, 2);
    expect_scaled("height", after.height, was.height, 2);
    expect_scaled("volume", after.volume, was.volume, 8);
    expect_scaled("mass", after.mass, was.mass, 8);
    expect_scaled("density", after.density, was.density, 1);
    for (int i = 0; i < 3; i++)
        expect_scaled("axis", after.axes[i], was.axes[i], 2);
}

/* All descriptions of a rock. */
static const struct rock {
    const char *name;
    enum ceduo_shape shape;
    double diameter, height, volume, mass, axes[3];
} rocks[] = {
    {"sphere by its diameter", CEDUO_SHAPE_SPHERE, .7, NAN, NAN, NAN, {NAN, NAN, NAN}},
    {"sphere by its volume", CEDUO_SHAPE_SPHERE, NAN, NAN, .3, NAN, {NAN, NAN, NAN}},
    {"sphere by its mass", CEDUO_SHAPE_SPHERE, NAN, NAN, NAN, 700, {NAN, NAN, NAN}},
    {"sphere by diameter and mass", CEDUO_SHAPE_SPHERE, .7, NAN, NAN, 700, {NAN, NAN, NAN}},
    {"cylinder", CEDUO_SHAPE_CYLINDER, .56, .8, NAN, NAN, {NAN, NAN, NAN}},
    {"ellipsoid", CEDUO_SHAPE_ELLIPSOID, NAN, NAN, NAN, NAN, {.4, .9, 1.3}},
    {"block by its axes", CEDUO_SHAPE_BLOCK, NAN, NAN, NAN, NAN, {.4, .9, 1.3}},
    {"block by axes and mass", CEDUO_SHAPE_BLOCK, NAN, NAN, NAN, 900, {.4, .9, 1.3}},
};

static struct ceduo_rock_def make_def(const struct rock *r)
{
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    def.shape = r->shape;
    def.diameter = ceduo_number(r->diameter);
    def.height = ceduo_number(r->height);
    def.volume = ceduo_number(r->volume);
    def.mass = ceduo_number(r->mass);
    for (int i = 0; i < 3; i++)
        def.axes[i] = ceduo_number(r->axes[i]);
    return def;
}

TEST(every_description_keeps_shape_and_density)
{
    for (size_t i = 0; i < LENGTH(rocks); i++) {
        struct ceduo_rock_def def = make_def(&rocks[i]), second = ceduo_rock_scaled(&def, 2);
        struct ceduo_rock was, after;
        assert_int_equal(ceduo_rock_from_means(&def, &was), CEDUO_OK);
        assert_int_equal(ceduo_rock_from_means(&second, &after), CEDUO_OK);
        ROWS(expect_near, (rocks[i].name, after.mean_diameter, 2 * was.mean_diameter),
             (rocks[i].name, after.volume, 8 * was.volume), (rocks[i].name, after.mass, 8 * was.mass),
             (rocks[i].name, after.k, was.k));
        expect_near(rocks[i].name, after.moment, 32 * was.moment); /* mass times length squared */
    }
}

/* ---- the table ---- */

static struct line_scene scene;

static void drop(struct ceduo_rock_def rock, double accepted)
{
    line_scene_drop(&scene, 1, accepted);
    scene.scene.rock = rock;
}

static void size_up(const struct ceduo_arrivals *own, struct ceduo_size_result blocks[CEDUO_SIZES])
{
    const struct ceduo_sizes_def def = {
        .scene = &scene.scene, .option = &scene.option, .rocks = BLOCKS_FLOWN, .effort = INFINITY, .own = own, .threads = 1};
    assert_int_equal(ceduo_sizes_simulate(&def, blocks), CEDUO_OK);
}

/* A block of 1 m by 1 m by `volume` m, whose volume no rounding changes. */
static struct ceduo_rock_def slab(double volume)
{
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    def.shape = CEDUO_SHAPE_BLOCK;
    def.axes[0] = ceduo_number(volume);
    def.axes[1] = def.axes[2] = ceduo_number(1);
    return def;
}

/* Expect all sizes of the table and the own one, rising, once each, the own one marked. An own size equal to one of the table
 * comes before it. */
static void expect_sizes(double own, size_t place)
{
    struct ceduo_size_result b[CEDUO_SIZES];
    drop(slab(own), NAN);
    scene.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    size_up(NULL, b);
    for (size_t i = 0, row = 0; i < CEDUO_SIZES; i++) {
        if (b[i].own != (i == place))
            fail_msg("own volume %g: block %zu of %g m3 is %smarked", own, i, b[i].volume, b[i].own ? "" : "not ");
        assert_true(b[i].volume == (i == place ? own : volumes[row++]));
        assert_true(i == 0 || b[i - 1].volume <= b[i].volume);
    }
}

TEST(the_own_size_is_sorted_among_the_others)
{
    static const struct {
        double own;
        size_t place;
    } rows[] = {{.01, 0}, {.05, 0}, {.06, 1}, {.2, 1}, {.5, 2}, {1, 2}, {3, 3}, {5, 3}, {6, 4}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        expect_sizes(rows[i].own, rows[i].place);
}

TEST(blocks_have_the_mass_and_width_of_their_volume)
{
    for (size_t i = 0; i < LENGTH(rocks); i++) {
        struct ceduo_rock_def def = make_def(&rocks[i]);
        struct ceduo_size_result b[CEDUO_SIZES];
        struct ceduo_rock own;
        assert_int_equal(ceduo_rock_from_means(&def, &own), CEDUO_OK);
        drop(def, NAN);
        scene.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
        size_up(NULL, b);
        for (size_t k = 0; k < CEDUO_SIZES; k++) {
            expect_near(rocks[i].name, b[k].mass, own.mass / own.volume * b[k].volume);
            expect_near(rocks[i].name, b[k].diameter, own.mean_diameter * cbrt(b[k].volume / own.volume));
        }
    }
}

/* With the energy of mass M at 5 m/s accepted between two sizes, smaller blocks stay below it and larger ones exceed it. */
TEST(blocks_fly_with_their_own_mass)
{
    for (size_t bears = 0; bears < LENGTH(volumes); bears++) {
        struct ceduo_size_result b[CEDUO_SIZES];
        drop(slab(.5), 1.1 * volumes[bears] * LIMESTONE * 25 / 2);
        size_up(NULL, b);
        for (size_t i = 0; i < CEDUO_SIZES; i++) {
            EXPECT_IS(b[i].arrivals, (released, BLOCKS_FLOWN), (reached, BLOCKS_FLOWN), (reach.mean, 1));
            bool exceeds = b[i].volume > 1.1 * volumes[bears];
            assert_int_equal(b[i].arrivals.exceeded, exceeds ? BLOCKS_FLOWN : 0);
            EXPECT(b[i].arrivals.exceed.mean, ==, (exceeds ? 1 : 0));
        }
    }
}

/* The row of the own block has the results of the run itself, if it has enough rocks. */
TEST(the_own_block_is_not_simulated_twice)
{
    struct ceduo_size_result blocks[CEDUO_SIZES];
    for (uint64_t released = BLOCKS_FLOWN - 1; released <= BLOCKS_FLOWN; released++) {
        const struct ceduo_arrivals own = {.released = released, .reached = 77};
        drop(slab(0.5), 1e3);
        size_up(&own, blocks);
        for (size_t i = 0; i < CEDUO_SIZES; i++)
            EXPECT(blocks[i].arrivals.reached == 77, ==, (blocks[i].own && released == BLOCKS_FLOWN));
    }
}

/* ---- all sizes ---- */

/* Rocks of all sizes that stop long before the control. */
static struct ceduo_estimate rate_above_100_kj(double fall, double height)
{
    static double ends[] = {.05, 1};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = ends};
    static struct ground g;
    ground_make(&g, 400, fall, height, .5, 0);
    struct ceduo_control road = {.x = 300, .x_given = 300, .accepted = 100e3, .measured_speed = NAN};
    g.scene.controls = &road;
    g.scene.controls_count = 1;
    g.scene.blocks = &blocks;
    g.scene.blocks_count = 1;
    const struct ceduo_run_def def = ceduo_run_def_default(&g.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 1000);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(a.reached, ==, 0);
    return a.hazard.accepted;
}

/* A rock that falls 20 m from its release can have the energy of one that descends 20 m on the ground. */
TEST(a_fall_from_the_release_adds_energy)
{
    struct ceduo_estimate released_high = rate_above_100_kj(0, 20), steep = rate_above_100_kj(20, 0);
    EXPECT(released_high.mean, ==, 0);
    EXPECT(steep.hi, >, 1e-5);
    EXPECT_NEAR(released_high.hi, steep.hi, 1e-12);
}
