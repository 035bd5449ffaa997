/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other obstacles in a stand: stumps, lying logs, trees in groups. */
#include "ceduo/years.h"
#include "core/runs/assess.h"
#include "expect.h"
#include "scene/stand.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "stems_scene.h"

/* ---- stumps and logs ---- */

/* Rocks meet stumps as they meet trees of that height, whatever the law of the stems; stumps take their own energy. */
TEST(stumps_are_met_as_low_trees)
{
    struct spread met = {0};
    for (int low = 0; low < 2; low++) {
        clear_plane(520); /* the rock's underside is at .95 to 1 m */
        struct ceduo_belt *belt = plant_belt(10, 510, 0, 0);
        belt->stand.energy = CEDUO_ENERGY_MODEL_DORREN;
        belt->stand.stumps = (struct ceduo_stumps){.per_ha = 900, .diameter = .25, .height = low ? .9 : 1.1, .energy = 1500};
        for (SWEEP(number, 800)) {
            for (size_t i = 0; i < sweep.count; i++) {
                const struct ceduo_stem_encounter *s = &sweep.stems[i];
                EXPECT(s->hit, ==, !low);
                EXPECT(fabs(s->y), <=, (B + .25) / 2);
                expect_exact("taken", s->taken, low ? 0 : 1500, 1e-12);
            }
            if (!low)
                spread_add(&met, (double)sweep.count / 500);
        }
    }
    expect_mean("stumps per metre", &met, per_metre(900, B + .25));
}

/* Return how many of N logs per square metre, at random angles, touch a strip as wide as the rock: Buffon. */
static double drawn_logs_per_metre(double per_ha, double length, gsl_rng *rng)
{
    const double along = 4000, half = (B + length) / 2;
    unsigned n = gsl_ran_poisson(rng, per_ha / 1e4 * along * 2 * half), met = 0;
    for (unsigned i = 0; i < n; i++) {
        double y = (2 * gsl_rng_uniform(rng) - 1) * half, tilt = M_PI * gsl_rng_uniform(rng);
        met += fabs(y) <= B / 2 + length / 2 * sin(tilt);
    }
    return met / along;
}

TEST(logs_are_met_as_buffons_needles)
{
    const double per_ha = 150, length = 4, wanted = per_metre(per_ha, 2 * length / M_PI + B);
    struct spread met = {0}, drawn = {0};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    clear_plane(520);
    struct ceduo_belt *belt = plant_belt(10, 510, 0, 0);
    belt->stand.logs = (struct ceduo_logs){.per_ha = per_ha, .length = length, .diameter = 1.2, .energy = 700};
    for (SWEEP(number, 2000)) {
        spread_add(&met, (double)sweep.count / 500);
        if (number < 500)
            spread_add(&drawn, drawn_logs_per_metre(per_ha, length, rng));
        for (size_t i = 0; i < sweep.count; i++)
            expect_exact("taken", sweep.stems[i].taken, 700, 1e-12);
    }
    gsl_rng_free(rng);
    expect_mean("logs per metre", &met, wanted);
    expect_mean("logs drawn", &drawn, wanted);
    belt->stand.logs.diameter = .9; /* below the height of the rock */
    sweep_one(1);
    EXPECT(sweep.count, >, 0);
    EXPECT(sweep.trajectory.stems_hit, ==, 0);
}

/* In the index they are separate strata in every form of the ADC; poisson takes the same energy; the lights ignore them. */
TEST(the_index_has_stumps_and_logs)
{
    struct paper_site site;
    paper_site_init(&site);
    struct ceduo_belt belt = site.belts[0];
    struct ceduo_stand_result before = ceduo_assess_stand(&site.scene, &belt);
    belt.stand.stumps = (struct ceduo_stumps){.per_ha = 500, .diameter = .2, .height = .1, .energy = 3e3};
    belt.stand.logs = (struct ceduo_logs){.per_ha = 80, .length = 6, .diameter = .3, .energy = 8e3};
    struct ceduo_stand_result r = ceduo_assess_stand(&site.scene, &belt);
    double stumps = per_metre(500, B + .2), logs = per_metre(80, B + 12 / M_PI);
    ROWS(EXPECT_NEAR, (1 / r.adc_m, 1 / before.adc_m + stumps + logs, 1e-12),
         (1 / r.adc.crofton, 1 / before.adc.crofton + stumps + logs, 1e-12),
         (1 / r.adc.gsteiger_stems, 1 / before.adc.gsteiger_stems + stumps + logs, 1e-12),
         (r.dissipated, before.dissipated + 67.5 * (stumps * 3e3 + logs * 8e3), 1e-6));
    EXPECT(r.free_run_probability, ==, before.free_run_probability);
    EXPECT_IS(r, (stumps_per_ha, 500), (logs_per_ha, 80));
    assert_true(r.warnings & CEDUO_WARNING_LOW);
    site.belts[0] = belt;
    site.scene.simulation.contact_dbh = .065; /* nor do the paper's stems count */
    struct ceduo_index i = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e5);
    EXPECT(i.contact, ==, CEDUO_LIGHT_FAIL);
    site.scene.simulation.contact_dbh = 0;
    belt.stand.shoots_count = belt.stand.trees_count = 0; /* a clearing */
    belt.stand.stools_per_ha = 0;
    assert_false(ceduo_stand_is_bare(&belt.stand));
    r = ceduo_assess_stand(&site.scene, &belt);
    EXPECT_NEAR(1 / r.adc_m, stumps + logs, 1e-12);
    EXPECT(r.free_run_probability, ==, 1);
    assert_false(r.passes_threshold);
    site.belts[0] = site.belts[1] = belt;
    site.belts[1].from = site.belts[0].to;
    site.belts[1].to = 135;
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e6);
    EXPECT_IS(i, (meet_nothing_probability, 1), (longest_gap, 135));
    EXPECT_NEAR(i.dissipated, 135 * (stumps * 3e3 + logs * 8e3), 1e-6);
    EXPECT_NEAR(i.residual, 1e6 - i.dissipated, 1e-6);
    belt.stand.stumps.per_ha = 0; /* logs alone */
    r = ceduo_assess_stand(&site.scene, &belt);
    EXPECT_NEAR(1 / r.adc_m, logs, 1e-12);
    assert_true(r.warnings & CEDUO_WARNING_LOW);
}

/* ---- groups ---- */

#define TREE 0.3 /* m */

static struct ceduo_belt *plant_groups(double from, double to, double per_ha, unsigned n, double radius)
{
    struct ceduo_belt *belt = plant_belt(from, to, 0, 0);
    struct ceduo_stems *trees = plant_trees(belt, per_ha, TREE);
    trees->group = n;
    trees->group_radius = radius;
    return belt;
}

/* Return how many trees of groups a strip of `length` m meets, all drawn in the plane, inside the forest. */
static unsigned drawn_trees(double per_ha, unsigned n, double radius, double length, gsl_rng *rng)
{
    const double half = (B + TREE) / 2, wide = 2 * (half + radius), far = length + 2 * radius;
    unsigned groups = gsl_ran_poisson(rng, per_ha / n / 1e4 * wide * far), met = 0;
    for (unsigned g = 0; g < groups; g++) {
        double x = gsl_rng_uniform(rng) * far - radius, y = (gsl_rng_uniform(rng) - .5) * wide;
        for (unsigned i = 0; i < n; i++) {
            double u, v;
            do {
                u = 2 * gsl_rng_uniform(rng) - 1;
                v = 2 * gsl_rng_uniform(rng) - 1;
            } while (u * u + v * v > 1);
            met += x + radius * u >= 0 && x + radius * u <= length && fabs(y + radius * v) <= half;
        }
    }
    return met;
}

struct group_case {
    unsigned n;
    double radius, per_ha, threshold;
};

/* The probability of a free run by quadrature, in 10^5 strips drawn in the plane, and for rocks; and the number of encounters,
 * with the variance of clumps. */
TEST(free_runs_past_groups)
{
    static const struct group_case cases[] = {{2, .1, 600, 10}, {5, 2, 400, 30},  {6, 4, 300, 20},
                                              {10, 8, 500, 30}, {5, 12, 300, 15}, {30, 3, 900, 4}};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t k = 0; k < LENGTH(cases); k++) {
        const struct group_case *c = &cases[k];
        uint64_t free = 0, free_rocks = 0, strips = 100000, rocks = 10000;
        struct spread met = {0}, drawn = {0};
        clear_plane(120);
        struct ceduo_belt *belt = plant_groups(10, 110, c->per_ha, c->n, c->radius);
        plane.line.scene.simulation.threshold = c->threshold;
        double wanted = ceduo_assess_stand(&plane.line.scene, belt).free_run_probability;
        for (uint64_t i = 0; i < strips; i++) {
            unsigned n = drawn_trees(c->per_ha, c->n, c->radius, c->threshold, rng);
            free += n == 0;
            spread_add(&drawn, n);
        }
        expect_share(named("%u trees in %g m, %g m drawn", c->n, c->radius, c->threshold), free, strips, wanted);
        for (SWEEP(number, rocks)) {
            size_t n = 0;
            for (size_t i = 0; i < sweep.count; i++)
                n += sweep.stems[i].x >= 60 - c->threshold / 2 && sweep.stems[i].x <= 60 + c->threshold / 2;
            free_rocks += n == 0;
            spread_add(&met, (double)n);
        }
        const char *label = named("%u trees in %g m, flown", c->n, c->radius);
        expect_share(label, free_rocks, rocks, wanted);
        expect_mean(label, &met, c->threshold * per_metre(c->per_ha, B + TREE));
        expect_close(label, spread_variance(&met), spread_variance_se(&met), spread_variance(&drawn),
                     spread_variance_se(&drawn));
    }
    gsl_rng_free(rng);
}

/* A belt is as dense at its ends as elsewhere, and all its trees stand inside. The summary has the probability to meet nothing
 * in the whole belt. */
TEST(groups_keep_to_their_belt)
{
    struct spread first = {0}, last = {0}, all = {0};
    uint64_t missed = 0;
    const uint64_t rocks = 20000;
    clear_plane(80);
    plant_groups(20, 50, 400, 5, 4);
    plane.line.scene.release.x.mean = 0;
    struct ceduo_control end = {.x = 60, .accepted = NAN, .measured_speed = NAN};
    struct ceduo_index index = ceduo_assess_index(&plane.line.scene, &plane.line.option, &end, 1e5);
    for (SWEEP(number, rocks)) {
        size_t a = 0, b = 0;
        for (size_t i = 0; i < sweep.count; i++) {
            EXPECT(sweep.stems[i].x, >=, 20);
            EXPECT(sweep.stems[i].x, <=, 50);
            a += sweep.stems[i].x < 22;
            b += sweep.stems[i].x > 48;
        }
        missed += sweep.count == 0;
        spread_add(&first, (double)a / 2);
        spread_add(&last, (double)b / 2);
        spread_add(&all, (double)sweep.count / 30);
        assert_int_equal(sweep.trajectory.stools_met, sweep.count); /* each tree is single */
        assert_int_equal(count_different(false), sweep.count);
    }
    ROWS(expect_mean, ("per metre", &all, per_metre(400, B + TREE)),
         ("per metre at the first end", &first, per_metre(400, B + TREE)),
         ("per metre at the last end", &last, per_metre(400, B + TREE)));
    expect_share("nothing met in the belt", missed, rocks, index.meet_nothing_probability);
}

/* Groups around the release: equally many trees above and below, whichever way the rock goes. */
TEST(groups_stand_around_the_release)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        struct spread met = {0};
        clear_plane(120);
        plant_groups(10, 110, 400, 5, 6);
        line_scene_release(&plane.line, 60, 1, direction * 1200., 0, 0);
        for (SWEEP(number, 10000)) {
            size_t n = 0;
            for (size_t i = 0; i < sweep.count; i++) {
                double on = (sweep.stems[i].x - 60) * direction;
                EXPECT(on, >=, 0);
                n += on < 8;
            }
            spread_add(&met, (double)n / 8);
        }
        expect_mean("per metre beside the release", &met, per_metre(400, B + TREE));
    }
    /* enough around it to pause drawing */
    clear_plane(120);
    plant_groups(10, 110, 1e5, 200, 30);
    line_scene_release(&plane.line, 60, 1, -1200, 0, 0);
    struct spread met = {0};
    for (SWEEP(number, 300)) {
        EXPECT(sweep.trajectory.end, ==, CEDUO_END_LEFT_SLOPE);
        spread_add(&met, (double)sweep.count / 50);
    }
    expect_mean("per metre behind the release, dense", &met, per_metre(1e5, B + TREE));
}

/* radius 0: n trees at one place; a very large radius: single trees. */
TEST(limits_of_groups)
{
    clear_plane(520);
    const double rate = per_metre(400, B + TREE);
    struct ceduo_belt *belt = plant_groups(10, 510, 400, 5, 0);
    struct ceduo_control end = {.x = 515, .accepted = NAN, .measured_speed = NAN};
    plane.line.scene.simulation.threshold = 12;
    struct ceduo_stand_result r = ceduo_assess_stand(&plane.line.scene, belt);
    EXPECT_NEAR(r.free_run_probability, exp(-12 * rate / 5), 1e-12);
    EXPECT(r.grouped_per_ha, ==, 400);
    EXPECT_NEAR(ceduo_assess_index(&plane.line.scene, &plane.line.option, &end, 1e5).meet_nothing_probability,
                exp(-500 * rate / 5), 1e-12);
    EXPECT_NEAR(1 / r.adc_m, rate, 1e-12); /* contacts are those of single trees */
    for (SWEEP(number, 200)) {
        EXPECT(sweep.count % 5, ==, 0);
        for (size_t i = 0; i < sweep.count; i++)
            EXPECT(sweep.stems[i].x, ==, sweep.stems[i - i % 5].x);
    }
    belt->stand.trees[0].group_radius = 1e-4;
    EXPECT_NEAR(ceduo_assess_stand(&plane.line.scene, belt).free_run_probability, exp(-12 * rate / 5), 1e-4);
    belt->stand.trees[0].group_radius = 100;
    EXPECT_NEAR(ceduo_assess_stand(&plane.line.scene, belt).free_run_probability, exp(-12 * rate), 1e-3);
    belt->stand.trees[0].group = 1; /* each single */
    EXPECT(ceduo_assess_stand(&plane.line.scene, belt).free_run_probability, ==, exp(-12 / r.adc.crofton));
    belt->stand.trees[0].group = 5; /* thinner than the counted minimum */
    plane.line.scene.simulation.contact_dbh = .5;
    EXPECT(ceduo_assess_stand(&plane.line.scene, belt).free_run_probability, ==, 1);
    plant_trees(belt, 200, .6); /* thicker single trees: only these count */
    EXPECT_NEAR(ceduo_assess_stand(&plane.line.scene, belt).free_run_probability, exp(-12 * per_metre(200, B + .6)), 1e-12);
}

/* With varying diameters rocks meet as many as of single trees. */
TEST(groups_of_trees_that_differ)
{
    struct spread met = {0};
    clear_plane(520);
    struct ceduo_belt *belt = plant_groups(10, 510, 300, 4, 5);
    belt->stand.trees[0].dbh_sd = .12;
    plant_shoots(belt, 900, .1); /* with stools among them, */
    belt->stand.stools_per_ha = 300;
    belt->stand.spacing = .4;
    for (SWEEP(number, 2000)) {
        size_t n = 0;
        for (size_t i = 0; i < sweep.count; i++) {
            n += !sweep.stems[i].shoot;
            EXPECT(fabs(sweep.stems[i].y), <=, (B + sweep.stems[i].dbh) / 2);
            EXPECT(sweep.stems[i].x, >=, sweep.stems[i > 0 ? i - 1 : 0].x); /* in the order of position */
        }
        spread_add(&met, (double)n / 500);
    }
    expect_mean("trees per metre", &met, per_metre(300, B + TREE));
}

/* ---- years ---- */

TEST(stumps_and_groups_over_the_years)
{
    static double stay[] = {40};
    const struct ceduo_curve curve = {.dbh_max = .3, .dbh_rate = .03, .height_max = 15, .height_rate = .05};
    struct ceduo_stems shoots = {.per_ha = 4000, .dbh = .06, .height = 6, .volume = NAN, .age = 4};
    struct ceduo_stems trees[] = {
        {.per_ha = 20, .dbh = .4, .height = 15, .volume = NAN, .age = 60},
        {.per_ha = 40, .dbh = .2, .height = 12, .volume = NAN, .age = 30, .group = 8, .group_radius = 3}};
    struct ceduo_stand stand = {
        .species = -1,
        .stools_per_ha = 1000,
        .spacing = .3,
        .shoots = &shoots,
        .shoots_count = 1,
        .trees = trees,
        .trees_count = 2,
        .growth = {.shoots = curve, .trees = curve, .shoots_young = 6, .shoots_old = 3, .stump_years = 7},
        .cutting = {.rotation = 20, .retained_count = 1, .stay_per_ha = stay},
        .stumps = {.per_ha = 900, .diameter = .1, .height = .2, .energy = 1e3}};
    struct ceduo_grown_stand grown;
    for (unsigned year = 0; year < 40; year++) {
        assert_int_equal(ceduo_stand_at(&stand, NAN, year, &grown), CEDUO_OK);
        /* the last cut was 4 years before year 0; the next is in year 16 */
        unsigned since = year < 16 ? year + 4 : (year - 16) % 20;
        EXPECT(grown.stand.stumps.per_ha, ==, year == 0 || since < 7 ? 900 : 0);
        const struct ceduo_stems *last = &grown.stand.trees[grown.stand.trees_count - 1];
        EXPECT_IS(*last, (group, 8), (group_radius, 3));
        ceduo_grown_stand_release(&grown);
    }
    stand.growth.stump_years = 0;
    assert_int_equal(ceduo_stand_at(&stand, NAN, 0, &grown), CEDUO_OK);
    EXPECT(grown.stand.stumps.per_ha, ==, 900); /* as in the file */
    ceduo_grown_stand_release(&grown);
    assert_int_equal(ceduo_stand_at(&stand, NAN, 16, &grown), CEDUO_OK);
    EXPECT(grown.stand.stumps.per_ha, ==, 0);
    ceduo_grown_stand_release(&grown);
    stand.growth.stump_years = 7;
    shoots.age = NAN;
    shoots.dbh = .5; /* at maximum diameter: the last cut was long ago */
    assert_int_equal(ceduo_stand_at(&stand, INFINITY, 1, &grown), CEDUO_OK);
    EXPECT(grown.stand.stumps.per_ha, ==, 0);
    ceduo_grown_stand_release(&grown);
    stand.shoots_count = 0; /* cut just before year 0 */
    assert_int_equal(ceduo_stand_at(&stand, INFINITY, 6, &grown), CEDUO_OK);
    EXPECT(grown.stand.stumps.per_ha, ==, 900);
    ceduo_grown_stand_release(&grown);
    memset(&stand.growth, 0, sizeof stand.growth); /* unknown: all stay */
    assert_int_equal(ceduo_stand_at(&stand, INFINITY, 30, &grown), CEDUO_OK);
    EXPECT(grown.stand.stumps.per_ha, ==, 900);
    ceduo_grown_stand_release(&grown);
    stand.growth.stump_years = 7;
    stand.growth.trees = curve;
    stand.growth.shoots = curve;
    stand.growth.shoots_old = 3;
    stand.trees_count = 1; /* single standards stay single */
    assert_int_equal(ceduo_stand_at(&stand, 5, 5, &grown), CEDUO_OK);
    EXPECT(grown.stand.trees[0].group, ==, 0);
    EXPECT(grown.stand.stumps.per_ha, ==, 900);
    ceduo_grown_stand_release(&grown);
}
