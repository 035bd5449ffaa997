/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes and rocks that are refused, grounds and belts at their limits. */
#include "core/runs/assess.h"
#include "core/runs/blocks.h"
#include "expect.h"
#include "local.h"
#include "scene/rock.h"

#include <math.h>

#include "ceduo/ceduo.h"
#include "core/forest/forest.h"
#include "core/walk/ground.h"
#include "physics/paper_site.h"

/* ---- refused scenes ---- */

static struct paper_site site;

/* Change one number of a valid scene: refused with this error, or valid. */
struct change {
    double *number, value;
    enum ceduo_status wanted;
    size_t where; /* index of the control; 9: untouched */
};

static void expect_refused(const struct change *rows, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        size_t where = 9;
        double was = *rows[i].number;
        EXPECT(ceduo_scene_check(&site.scene, NULL), ==, CEDUO_OK);
        *rows[i].number = rows[i].value;
        enum ceduo_status found = ceduo_scene_check(&site.scene, &where);
        if (found != rows[i].wanted || found != ceduo_scene_check(&site.scene, NULL) ||
            (rows[i].where && where != rows[i].where))
            fail_msg("row %zu: status %d at %zu", i, found, where);
        *rows[i].number = was;
    }
}

TEST(scenes_are_refused)
{
    paper_site_init(&site);
    struct ceduo_scene *scene = &site.scene;
    struct ceduo_control controls[2] = {site.control, site.control};
    struct ceduo_release *release = &scene->release;
    struct ceduo_segment *s = &site.segments[3];
    struct ceduo_belt *b = site.belts;
    struct ceduo_stems *shoots = &site.plots[0].shoots;
    scene->controls = controls;
    scene->controls_count = 2;
    scene->rock.height.mean = 0.8;
    const double end = site.x[PAPER_SEGMENTS];
    const struct change rows[] = {{&scene->rock.diameter.mean, 0, CEDUO_BAD_ROCK, 9},
                                  {&scene->rock.height.mean, 0, CEDUO_BAD_ROCK, 9},
                                  {&release->x.mean, -1, CEDUO_RELEASE_OFF_SLOPE, 9},
                                  {&release->x.mean, NAN, CEDUO_RELEASE_OFF_SLOPE, 9},
                                  {&release->x.mean, end, CEDUO_RELEASE_OFF_SLOPE, 9},
                                  {&release->x.spread, 1, CEDUO_RELEASE_OFF_SLOPE, 9},
                                  {&release->height.mean, -.1, CEDUO_RELEASE_BELOW, 9},
                                  {&release->height.spread, 1, CEDUO_RELEASE_BELOW, 9},
                                  {&controls[1].x, end + 1, CEDUO_CONTROL_OFF_SLOPE, 1},
                                  {&controls[1].x, NAN, CEDUO_CONTROL_OFF_SLOPE, 1},
                                  {&controls[1].x, 0, CEDUO_CONTROL_BEHIND, 1},
                                  {&site.x[4], NAN, CEDUO_BAD_SLOPE, 0},
                                  {&site.z[4], INFINITY, CEDUO_BAD_SLOPE, 0},
                                  {&site.x[4], site.x[3], CEDUO_BAD_SLOPE, 0},
                                  {&s->rn.mean, 0, CEDUO_OK, 0},
                                  {&s->rt.mean, 1, CEDUO_OK, 0},
                                  {&s->roughness_rad, acos(0), CEDUO_BAD_SLOPE, 0}, /* a right angle */
                                  {&s->roughness_rad, 1.57, CEDUO_OK, 0},
                                  {&s->roughness_m, .1, CEDUO_BAD_SLOPE, 0}, /* given twice */
                                  {&shoots->dbh, -.06, CEDUO_BAD_STAND, 0},
                                  {&shoots->dbh, NAN, CEDUO_BAD_STAND, 0},
                                  {&shoots->per_ha, -1, CEDUO_BAD_STAND, 0},
                                  {&shoots->per_ha, NAN, CEDUO_BAD_STAND, 0},
                                  {&shoots->per_ha, 1e11, CEDUO_BAD_STAND, 0},
                                  {&shoots->height, 0, CEDUO_BAD_STAND, 0},
                                  {&site.plots[1].trees.per_ha, 1e300, CEDUO_BAD_STAND, 0},
                                  {&shoots->dbh_sd, -.01, CEDUO_BAD_STAND, 0},
                                  {&shoots->dbh_sd, NAN, CEDUO_BAD_STAND, 0},
                                  {&b[0].stand.counted_from, NAN, CEDUO_BAD_STAND, 0},
                                  {&b[0].stand.spacing, -1, CEDUO_BAD_STAND, 0},
                                  {&b[1].stand.stools_per_ha, NAN, CEDUO_BAD_STAND, 0},
                                  {&b[0].from, 100, CEDUO_BAD_BELT, 0},
                                  {&b[1].from, 20, CEDUO_BAD_BELT, 0},
                                  {&b[1].to, 1e4, CEDUO_BAD_BELT, 0},
                                  {&b[0].to, NAN, CEDUO_BAD_BELT, 0},
                                  {&scene->simulation.gravity, 0, CEDUO_BAD_NUMBER, 0},
                                  {&scene->simulation.threshold, NAN, CEDUO_BAD_NUMBER, 0}};
    scene->options = &site.option;
    scene->options_count = 1;
    expect_refused(rows, LENGTH(rows));
    struct ceduo_stumps *stumps = &b[0].stand.stumps;
    struct ceduo_logs *logs = &b[0].stand.logs;
    *stumps = (struct ceduo_stumps){.per_ha = 9, .diameter = .3, .height = .3, .energy = 9e3};
    *logs = (struct ceduo_logs){.per_ha = 9, .diameter = .3, .length = 5, .energy = 9e3};
    double *const low[] = {&stumps->diameter, &stumps->height, &stumps->energy, &logs->diameter, &logs->length, &logs->energy};
    for (size_t i = 0; i < LENGTH(low); i++)
        expect_refused(&(struct change){low[i], NAN, CEDUO_BAD_STAND, 0}, 1);
    double *const shares[] = {&s->rn.mean, &s->rt.mean}, *const sizes[] = {&s->rn.spread, &s->rt.spread, &s->friction, &s->mu,
                                                                           &s->roughness_rad};
    const double outside[] = {-.01, NAN, INFINITY, 1.01, -INFINITY};
    for (size_t i = 0; i < LENGTH(outside); i++) {
        for (size_t k = 0; k < LENGTH(shares); k++)
            expect_refused(&(struct change){shares[k], outside[i], CEDUO_BAD_SLOPE, 0}, 1);
        for (size_t k = 0; i < 3 && k < LENGTH(sizes); k++)
            expect_refused(&(struct change){sizes[k], outside[i], CEDUO_BAD_SLOPE, 0}, 1);
    }
    s->roughness_rad = NAN;
    s->roughness_m = .1;
    const struct change roughness[] = {{&s->roughness_m, 0, CEDUO_OK, 0}, {&s->roughness_m, -.1, CEDUO_BAD_SLOPE, 0}};
    expect_refused(roughness, LENGTH(roughness));
    b[0].stand.species = 999;
    EXPECT(ceduo_scene_check(scene, NULL), ==, CEDUO_BAD_STAND);
    b[0].stand.species = ceduo_species_find("no-such-tree");
    EXPECT(b[0].stand.species, ==, -1);
    b[0].stand.energy = (enum ceduo_energy_model)9;
    EXPECT(ceduo_scene_check(scene, NULL), ==, CEDUO_BAD_STAND);
    scene->options = NULL;
    scene->options_count = 0;
    scene->controls = NULL;
    scene->controls_count = 0; /* a slope without controls is valid */
    EXPECT(ceduo_scene_check(scene, NULL), ==, CEDUO_OK);
    scene->slope.vertices = 1;
    EXPECT(ceduo_scene_check(scene, NULL), ==, CEDUO_BAD_SLOPE);
}

TEST(releases_are_refused)
{
    paper_site_init(&site);
    struct ceduo_release releases[2] = {site.scene.release, site.scene.release};
    releases[0].share = releases[1].share = .5;
    site.scene.releases = releases;
    site.scene.releases_count = 2;
    const struct change rows[] = {{&releases[0].share, 0, CEDUO_BAD_NUMBER, 0},
                                  {&releases[1].share, NAN, CEDUO_BAD_NUMBER, 0},
                                  {&releases[0].x.mean, -1, CEDUO_RELEASE_OFF_SLOPE, 0},
                                  {&releases[1].height.mean, -1, CEDUO_RELEASE_BELOW, 0}};
    expect_refused(rows, LENGTH(rows));
}

TEST(blocks_are_refused)
{
    double volumes[2] = {0.1, 2};
    struct ceduo_size_class b[2] = {{1, 1, 2, volumes}, {1, 1, 2, volumes}};
    const struct change rows[] = {{&volumes[0], 0, CEDUO_BAD_ROCK, 0},      {&volumes[0], NAN, CEDUO_BAD_ROCK, 0},
                                  {&volumes[0], 2, CEDUO_BAD_ROCK, 0},      {&b[1].per_year, 0, CEDUO_BAD_ROCK, 0},
                                  {&b[1].per_year, NAN, CEDUO_BAD_ROCK, 0}, {&b[1].exponent, -1, CEDUO_BAD_ROCK, 0}};
    paper_site_init(&site);
    site.scene.blocks = b;
    site.scene.blocks_count = 2;
    expect_refused(rows, LENGTH(rows));
    b[1].volumes_count = 1;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_BAD_ROCK);
}

/* No other size of the rock is simulated, for any contact model. */
static void expect_no_blocks(void)
{
    struct ceduo_size_result blocks[CEDUO_SIZES];
    const struct ceduo_sizes_def def = {
        .scene = &site.scene, .option = &site.option, .rocks = 10, .effort = INFINITY, .threads = 1};
    for (int model = CEDUO_CONTACT_MODEL_INDEX; model <= CEDUO_CONTACT_MODEL_STEMS; model++) {
        site.scene.simulation.contact_model = (enum ceduo_contact_model)model;
        assert_int_equal(ceduo_sizes_simulate(&def, blocks), CEDUO_BAD_ROCK);
    }
}

/* An invalid rock has no figures and is not simulated. */
TEST(an_invalid_rock_has_no_figures)
{
    paper_site_init(&site);
    struct ceduo_trajectory trajectory;
    site.control.measured_speed = 10;
    assert_int_equal(ceduo_trajectory_run(&site.scene, NULL, 0, NULL, &trajectory, NULL), CEDUO_OK);
    site.scene.rock.diameter.mean = 0;
    struct ceduo_stand_result stand = ceduo_assess_stand(&site.scene, &site.belts[0]);
    assert_true(isnan(stand.adc_m) && isnan(stand.contacts) && isnan(stand.dissipated));
    assert_false(stand.passes_threshold);
    struct ceduo_index index = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e5);
    assert_true(isnan(index.measured));
    EXPECT(index.contact, !=, CEDUO_LIGHT_PASS);
    assert_int_equal(ceduo_trajectory_run(&site.scene, NULL, 0, NULL, &trajectory, NULL), CEDUO_BAD_ROCK);
    assert_null(ceduo_tracer_create(&site.scene, NULL));
    expect_no_blocks();
    /* valid itself, but too heavy at the size of the others */
    site.scene.rock = ceduo_scene_default().rock;
    site.scene.rock.diameter.mean = 1e-90;
    site.scene.rock.mass.mean = 1e200;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_OK);
    expect_no_blocks();
}

static void expect_rock(const struct ceduo_rock_def *def, enum ceduo_status wanted)
{
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_from_means(def, &rock), wanted);
}

TEST(rocks_are_refused)
{
    /* no size; and too small or too large: mass, moment or radius would be 0 or infinite */
    const double no_size[] = {0, -1, INFINITY, -INFINITY, 1e-120, 1e-100, 1e100, 1e103};
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.diameter.mean = 1;
    expect_rock(&def, CEDUO_OK);
    for (size_t i = 0; i < LENGTH(no_size); i++) {
        def.diameter.mean = no_size[i];
        expect_rock(&def, CEDUO_BAD_ROCK);
    }
    def.mass.mean = def.diameter.mean = 1;
    def.density.mean = INFINITY; /* even if nothing uses it */
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.density.mean = 2600;
    expect_rock(&def, CEDUO_OK);
    def.diameter.mean = 4e-324;
    expect_rock(&def, CEDUO_BAD_ROCK);

    def = ceduo_scene_default().rock;
    def.shape = CEDUO_SHAPE_CYLINDER;
    def.diameter.mean = 1;
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.height.mean = 1;
    expect_rock(&def, CEDUO_OK);
    def.diameter.mean = NAN;
    expect_rock(&def, CEDUO_BAD_ROCK);

    def = ceduo_scene_default().rock;
    for (int shape = CEDUO_SHAPE_ELLIPSOID; shape <= CEDUO_SHAPE_BLOCK; shape++) {
        def.shape = (enum ceduo_shape)shape;
        for (int all = 0; all < 8; all++) {
            for (int i = 0; i < 3; i++)
                def.axes[i].mean = all >> i & 1 ? 1 : NAN;
            expect_rock(&def, all == 7 ? CEDUO_OK : CEDUO_BAD_ROCK);
        }
        def.mass.mean = 1;
        for (int i = 0; i < 3; i++)
            def.axes[i].mean = 1e308;
        expect_rock(&def, CEDUO_BAD_ROCK); /* the sum of the axes is infinite */
        def.mass.mean = NAN;
    }
}

/* ---- grounds ---- */

/* Return how many segments the core makes of two collinear ones. */
static size_t segments_made(void)
{
    LOCAL_BY(ceduo_ground_release) struct ground g;
    assert_true(ceduo_ground_init(&g, &site.scene.slope, 9.81, .3, false));
    size_t n = g.n;
    return n;
}

TEST(collinear_segments_are_merged)
{
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    struct ceduo_segment *a = &slope->segments[0], *b = &slope->segments[1];
    slope->vertices = 3;
    for (int i = 0; i < 3; i++) {
        slope->x[i] = 10 * i;
        slope->z[i] = -5 * i;
    }
    *b = *a;
    assert_int_equal(segments_made(), 1);
    double *const numbers[] = {&b->rn.mean,       &b->rt.mean,   &b->friction,  &b->mu,
                               &b->roughness_rad, &b->rn.spread, &b->rt.spread, &slope->z[1]};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        double was = *numbers[i];
        *numbers[i] += .01;
        assert_int_equal(segments_made(), 2);
        *numbers[i] = was;
    }
    b->rn.kind = CEDUO_SPREAD_UNIFORM; /* without spread */
    assert_int_equal(segments_made(), 1);
    a->rn.spread = b->rn.spread = .01;
    assert_int_equal(segments_made(), 2);
    a->rn.kind = CEDUO_SPREAD_UNIFORM;
    assert_int_equal(segments_made(), 1);
    a->roughness_m = b->roughness_m = .1;
    a->roughness_rad = b->roughness_rad = NAN;
    assert_int_equal(segments_made(), 1);
    b->roughness_m = .2;
    assert_int_equal(segments_made(), 2);
    b->roughness_m = NAN;
    b->roughness_rad = .1;
    assert_int_equal(segments_made(), 2);
}

/* Rocks of different radius compute each roughness of a profile once, an angle or a height. */
TEST(equal_roughnesses_are_numbered_once)
{
    paper_site_init(&site);
    struct ceduo_segment *s = site.segments;
    const double angles[] = {.1, NAN, .1, NAN, .2}, heights[] = {NAN, .1, NAN, .1, NAN};
    const unsigned char numbers[] = {0, 1, 0, 1, 2};
    site.scene.slope.vertices = LENGTH(angles) + 1;
    for (size_t i = 0; i < LENGTH(angles); i++) {
        s[i].roughness_rad = angles[i];
        s[i].roughness_m = heights[i];
    }
    LOCAL_BY(ceduo_ground_release) struct ground g;
    assert_true(ceduo_ground_init(&g, &site.scene.slope, 9.81, .3, true));
    EXPECT(g.n, ==, LENGTH(angles));
    EXPECT(g.roughness_count, ==, 3);
    assert_memory_equal(g.roughness_index, numbers, LENGTH(numbers));
}

/* A short segment at more than the tolerated angle to the line stays separate, even if its end lies on the line. */
TEST(segments_at_an_angle_stay_separate)
{
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    const double x[] = {0, 1e-6, 1.1e-6, 1000};
    slope->vertices = 4;
    for (size_t i = 0; i < 4; i++) {
        slope->x[i] = x[i];
        slope->segments[i] = slope->segments[0];
    }
    slope->z[0] = slope->z[1] = 0;
    slope->z[3] = -500;
    slope->z[2] = 1.5e-7 * 1e-7; /* turned by 1.5e-7 rad */
    assert_int_equal(segments_made(), 3);
    slope->z[2] = .5e-7 * 1e-7;
    assert_int_equal(segments_made(), 2);
}

/* Stools so wide and many that a table of all stools around a rock would not fit into memory: the table has a limit. */
TEST(tables_of_stools_have_a_limit)
{
    paper_site_init(&site);
    const struct ceduo_simulation *simulation = &site.scene.simulation;
    const struct ceduo_rock rock = {.mean_diameter = .68};
    struct forest forest;
    assert_true(ceduo_forest_init(&forest, simulation, &site.option, &rock));
    EXPECT(forest.met_mask, >=, 63);
    EXPECT(forest.met_mask, <, 1000);
    ceduo_forest_release(&forest);
    site.belts[0].stand.stools_per_ha = 1e6;
    site.plots[0].shoots.per_ha = 1e10;
    site.belts[0].stand.spacing = 20;
    assert_true(ceduo_forest_init(&forest, simulation, &site.option, &rock));
    assert_int_equal(forest.met_mask, ((size_t)1 << 20) - 1); /* more than a million stems on one trajectory */
    ceduo_forest_release(&forest);
}

/* ---- index ---- */

TEST(belts_outside_the_trajectory)
{
    paper_site_init(&site);
    struct ceduo_belt *belts = site.belts;
    struct ceduo_control control = site.control;
    struct ceduo_index both = ceduo_assess_index(&site.scene, &site.option, &control, 1e5);
    control.x = belts[0].to; /* the second belt is after the control */
    struct ceduo_index first = ceduo_assess_index(&site.scene, &site.option, &control, 1e5);
    struct ceduo_stand_result of_first = ceduo_assess_stand(&site.scene, &belts[0]),
                              of_second = ceduo_assess_stand(&site.scene, &belts[1]);
    double before = belts[0].to - fmax(belts[0].from, site.scene.release.x.mean);
    EXPECT_NEAR(first.length, before, 1e-12);
    EXPECT(both.length, >, first.length);
    EXPECT_NEAR(first.contacts, before / of_first.adc_m, 1e-9);
    EXPECT(fabs(both.contacts - first.contacts - of_second.contacts), <, 1e-9);
    site.scene.release.x.mean = belts[0].to; /* the first belt is above the release */
    control.x = site.control.x;
    struct ceduo_index second = ceduo_assess_index(&site.scene, &site.option, &control, NAN);
    EXPECT_NEAR(second.contacts, of_second.contacts, 1e-9);
    assert_true(isnan(second.residual));
    assert_false(second.exhausted);
    control.measured_speed = 10;
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_from_means(&site.scene.rock, &rock), CEDUO_OK);
    second = ceduo_assess_index(&site.scene, &site.option, &control, NAN);
    EXPECT_NEAR(second.measured, 50 * rock.mass, 1e-6);
    assert_int_equal(ceduo_energy_light(NULL), CEDUO_LIGHT_UNKNOWN);
}
