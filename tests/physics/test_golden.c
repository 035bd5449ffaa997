/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of Ciabocco, Boccia and Ripa 2009 and of their equations, to all known digits. The paper's figures belong to the
 * published laws: its scenes have no friction bound (paper_site_init()). */
#include "core/runs/assess.h"
#include "core/stand/adc.h"
#include "core/stand/energy.h"
#include "expect.h"
#include "scene/rock.h"
#include "scene/slope.h"
#include "scene/species.h"
#include "scene/stand.h"
#include "scene/volume.h"

#include <math.h>

#include "core/walk/strike.h"
#include "line_scene.h"
#include "paper_site.h"

static struct paper_site site;
static struct paper_plot one, two, plot;

/* Set-up of each test. */
static int open_paper(void **state)
{
    (void)state;
    paper_site_init(&site);
    paper_plot_init(&one, 1);
    paper_plot_init(&two, 2);
    paper_plot_init(&plot, 1);
    return 0;
}

/* The value rounds to `expected`, printed with this many decimals. */
static void expect_decimals(double value, double expected, int decimals)
{
    double off = 0.5 * pow(10, -decimals);
    if (!(fabs(value - expected) <= off * (1 + 1e-9)))
        fail_msg("%.17g is not %.*f", value, decimals, expected);
}

/* The value equals `expected` within the rounding of a few operations. */
static void expect_exact(double value, double expected)
{
    if (!(fabs(value - expected) <= 8e-16 * fabs(expected)))
        fail_msg("%.17g is not %.17g", value, expected);
}

static void expect_warned(const struct ceduo_stand *stand, unsigned set, unsigned clear)
{
    unsigned value = ceduo_stand_warnings(stand, PAPER_B, CEDUO_RULE_AUTO);
    if ((value & set) != set || (value & clear) != 0)
        fail_msg("warnings %#x, not with %#x and without %#x", value, set, clear);
}

/* ---- rock ---- */

TEST_WITH(rock_of_table_2, open_paper, NULL)
{
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_from_means(&site.scene.rock, &rock), CEDUO_OK);
    expect_decimals(rock.mass, 512.3058, 4);
    ROWS(expect_exact, (rock.mean_diameter, 0.68), (rock.radius, 0.34), (rock.k, 0.5),
         (rock.axes[0] + 2 * rock.axes[1] + 4 * rock.axes[2], 3 * 0.56 + 4 * 0.8),
         (rock.moment, 0.5 * rock.mass * 0.34 * 0.34));
    expect_decimals(0.5 * rock.mass * 20.94 * 20.94 / 1e3, 112.319, 3);              /* Table 5's mean speed */
    expect_decimals(0.5 * rock.mass * 15.6 * 15.6 / 1e3, 62.337, 3);                 /* speed in the video */
    expect_decimals(0.5 * rock.mass * (20.94 * 20.94 - 15.6 * 15.6) / 1e3, 50.0, 1); /* the same comparison as the paper's */
}

TEST_WITH(rock_shapes, open_paper, NULL)
{
    const double pi = acos(-1);
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_BAD_ROCK);
    def.volume = ceduo_number(pi / 6);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_OK);
    ROWS(expect_exact, (rock.mean_diameter, 1), (rock.k, 0.4), (rock.mass, 2600 * pi / 6));
    def = ceduo_scene_default().rock;
    def.mass = ceduo_number(2600 * pi / 6 * 8);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_OK);
    expect_exact(rock.mean_diameter, 2);
    expect_exact(rock.moment, 0.4 * rock.mass);
    def = ceduo_scene_default().rock;
    def.shape = CEDUO_SHAPE_ELLIPSOID;
    for (int i = 0; i < 3; i++)
        def.axes[i] = ceduo_number((double[]){0.5, 1.5, 1}[i]);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_OK);
    ROWS(expect_exact, (rock.volume, pi / 6 * 0.75), (rock.mean_diameter, 1), (rock.k, 0.4),
         (rock.axes[0] + 2 * rock.axes[1] + 4 * rock.axes[2], 0.5 + 2 * 1.5 + 4));
    def.shape = CEDUO_SHAPE_BLOCK;
    def.mass = ceduo_number(1000);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_OK);
    expect_exact(rock.mass, 1000);
    expect_exact(rock.volume, 0.75);
    expect_exact(rock.moment, 1000 * (0.25 + 1) / 12); /* about the longest axis */
    expect_exact(rock.k, (0.25 + 1) / 12 / 0.25);
    def.axes[2] = ceduo_number(0);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_BAD_ROCK);
}

/* ---- impacts ---- */

struct impact_row {
    double vn, vt, spin, rn, rt, k;
    double f, sf, vn_out, vt_out, spin_out;
};

TEST_WITH(impacts_of_pfeiffer_and_higgins, open_paper, NULL)
{
    static const struct impact_row rows[] = {
        {5, 10, 0, .31, .83, .4, .873691, .794408, 1.193228, 7.041038, 20.708937},
        {5, 10, 10 / .34, .31, .83, .4, .971667, .794408, 1.193228, 8.785784, 25.840540},
        {10, 5, 0, .31, .83, .4, .920776, .703860, 1.411664, 3.401936, 10.005693},
        {10, 20, 30, .40, .90, .4, .926424, .812539, 1.821502, 15.409390, 45.321734},
        {2, 3, 5, .31, .87, .4, .974378, .863808, .591694, 2.470982, 7.267594},
        {5, 10, 30, .31, .83, .5, .971540, .794408, 1.193228, 8.844166, 26.012252},
    };
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct impact_row *r = &rows[i];
        struct ground_point at = {.rn = r->rn, .rt = r->rt, .radius = 0.34, .k = r->k};
        struct impact in = {.vn = r->vn, .vt = r->vt, .spin = r->spin};
        struct impact out = law_crsp.struck(in, &at);
        ROWS(expect_decimals, (crsp_friction(r->rt, r->vt - r->spin * 0.34), r->f, 6),
             (crsp_scaling(r->rn, r->rt, r->vn), r->sf, 6), (out.vn, r->vn_out, 6), (out.vt, r->vt_out, 6),
             (out.spin, r->spin_out, 6));
        in.vt = -in.vt; /* the mirror image */
        in.spin = -in.spin;
        struct impact mirror = law_crsp.struck(in, &at);
        EXPECT(mirror.vn, ==, out.vn);
        EXPECT_IS(mirror, (vt, -out.vt), (spin, -out.spin));
    }
}

TEST_WITH(impacts_at_the_limits_of_crsp, open_paper, NULL)
{
    EXPECT(crsp_scaling(0, 0.8, 0), ==, 0.8);
    EXPECT(crsp_scaling(0, 0.8, 1e-9), ==, 0);
    struct ground_point at = {.rn = 0.3, .rt = 0.8, .radius = 0.5, .k = 0.4};
    struct impact out = law_crsp.struck((struct impact){1, 0, -10}, &at);
    EXPECT(out.vt, <, 0);
    EXPECT(out.spin, <, 0); /* without speed the spin sets the direction */
    out = law_crsp.struck((struct impact){1, -2, 10}, &at);
    EXPECT(out.vt, <, 0);
    out = law_crsp.struck((struct impact){9.144, 0, 0}, &at); /* 30 ft/s */
    expect_exact(out.vn, 0.3 * 9.144 / 2);
}

TEST_WITH(impacts_of_the_lumped_law, open_paper, NULL)
{
    struct ground_point at = {.rn = 0.31, .rt = 0.83, .radius = 0.34, .k = 0.4};
    struct impact out = law_lumped.struck((struct impact){5, -10, 7}, &at);
    expect_exact(out.vn, 1.55);
    expect_exact(out.vt, -8.3);
    EXPECT(out.spin, ==, 0);
    at.scale_rn = true;
    out = law_lumped.struck((struct impact){5, 10, 0}, &at);
    expect_decimals(out.vn, 1.193228, 6); /* as in Pfeiffer & Higgins 1990 */
    expect_exact(out.vt, 8.3);
}

struct bounded_row {
    const struct contact_law *law;
    struct impact in;
    double rn, rt, k, friction;
    double vn_out, vt_out, spin_out;
    bool as_published;
};

/* Apply the law and the friction bound on the segment itself. */
static struct impact strike_flat(const struct contact_law *law, const struct ground_point *at, struct impact in)
{
    double spin = in.spin;
    struct velocity out = strike(law, at, 0, 1, (struct velocity){.along = in.vt, .off = -in.vn}, &spin);
    return (struct impact){.vn = out.off, .vt = out.along, .spin = spin};
}

TEST_WITH(impacts_with_the_friction_bound, open_paper, NULL)
{
    static const struct bounded_row rows[] = {
        {&law_lumped, {1, 10, 0}, .31, .83, .4, .5, .310000, 9.345000, 0, false},
        {&law_lumped, {5, 10, 0}, .31, .83, .4, .5, 1.550000, 8.300000, 0, true},
        {&law_lumped, {.2, -6, 0}, .31, .83, .4, .6, .062000, -5.842800, 0, false},
        {&law_crsp, {1, 10, 0}, .31, .83, .4, .5, .306336, 9.346832, 4.802707, false},
        {&law_crsp, {1, 10, 29.411765}, .31, .83, .4, .5, .306336, 9.346832, 27.490682, false},
        {&law_crsp, {5, 10, 0}, .31, .83, .4, .5, 1.193228, 7.041038, 20.708937, true},
        {&law_crsp, {2, -12, -20}, .40, .90, .4, .6, .763476, -10.341915, -30.417396, false},
    };
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct bounded_row *r = &rows[i];
        struct ground_point at = {.rn = r->rn, .rt = r->rt, .radius = 0.34, .k = r->k, .friction = r->friction, .bound = true};
        struct impact out = strike_flat(r->law, &at, r->in), in = r->in;
        ROWS(expect_decimals, (out.vn, r->vn_out, 6), (out.vt, r->vt_out, 6), (out.spin, r->spin_out, 6));
        in.vt = -in.vt; /* the mirror image */
        in.spin = -in.spin;
        struct impact mirror = strike_flat(r->law, &at, in);
        EXPECT_IS(mirror, (vt, -out.vt), (spin, -out.spin), (vn, out.vn));
        at.bound = false;
        struct impact published = strike_flat(r->law, &at, r->in);
        EXPECT(published.vn, ==, out.vn);
        EXPECT(published.vt == out.vt && published.spin == out.spin, ==, r->as_published);
    }
}

/* ---- trajectories ---- */

TEST_WITH(slope_segments_chain_as_in_table_3, open_paper, NULL)
{
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_OK);
    static const double heights[] = {126, 106, 86, 76, 66, 61, 56, 46, 36, 26, 16, 6, 2, 0};
    for (size_t i = 0; i < LENGTH(heights); i++)
        EXPECT(ceduo_slope_height(&site.scene.slope, paper_x[i]) + PAPER_TOP, ==, heights[i]);
    expect_exact(ceduo_slope_height(&site.scene.slope, 5), 116 - PAPER_TOP);
    assert_int_equal(ceduo_slope_segment(&site.scene.slope, 10), 1);
    assert_int_equal(ceduo_slope_segment(&site.scene.slope, 9.99), 0);
}

static struct line_trace walked;

TEST_WITH(two_contacts_on_the_slope_of_table_3, open_paper, NULL)
{
    paper_site_sphere(&site);
    paper_site_smooth(&site);
    site.scene.simulation.law = CEDUO_LAW_CRSP;
    site.scene.release.x = ceduo_number(5);
    site.scene.release.height = ceduo_number(117 - 116);
    site.scene.release.vx = ceduo_number(1);
    site.scene.release.vz = ceduo_number(0);
    walked.count = 0;
    assert_int_equal(ceduo_trajectory_run(&site.scene, NULL, 0,
                                          &(struct ceduo_trajectory_callbacks){.segment = line_keep_piece, .context = &walked},
                                          &walked.trajectory, NULL),
                     CEDUO_OK);
    EXPECT(walked.count, >=, 3);
    const struct ceduo_trajectory_segment *p = walked.pieces;
    assert_false(p[0].rolls || p[1].rolls || p[2].rolls);
    EXPECT_IS(p[0], (x, 5), (z, 117 - PAPER_TOP), (vx, 1), (vz, 0));
    ROWS(expect_decimals, (p[0].x1, 5.6993, 4), (p[0].z1 + PAPER_TOP, 114.6014, 4), (p[1].vx, 2.7930, 4), (p[1].vz, -4.1600, 4),
         (p[1].x1, 6.5113, 4), (p[1].z1 + PAPER_TOP, 112.9774, 4), (p[2].vx, 2.9972, 4), (p[2].vz, -5.5545, 4));
}

static void rolling_and_resting(enum ceduo_law law, double x, uint64_t contacts)
{
    static const double px[] = {0, 8, 10, 11, 13, 14, 24, 25, 31};
    static const double pz[] = {0, -2, -2, -1.8, -3, -3, -3.2, -2.9, -2.9};
    struct line_scene s;
    line_scene_init(&s, LENGTH(px), px, pz, (struct line_ground){.3, .99, .1}, .34, law);
    s.scene.simulation.friction_bound = false; /* golden figures belong to the published laws and to CRSP's rolling */
    line_scene_release(&s, 1, 0, 0, 0, 0);
    assert_int_equal(line_scene_follow(&s, &walked), CEDUO_OK);
    assert_int_equal(walked.trajectory.end, CEDUO_END_AT_REST);
    expect_decimals(walked.trajectory.x, x, 6);
    assert_int_equal(walked.trajectory.contacts, contacts);
    size_t flights_from_11 = 0;
    for (size_t i = 0; i < walked.count; i++)
        flights_from_11 += !walked.pieces[i].rolls && walked.pieces[i].x == 11;
    assert_int_equal(flights_from_11, 1);
}

TEST_WITH(rolling_and_resting_on_a_polyline, open_paper, NULL)
{
    rolling_and_resting(CEDUO_LAW_LUMPED, 20.632084, 59);
    rolling_and_resting(CEDUO_LAW_CRSP, 22.158570, 63);
}

/* ---- ADC ---- */

TEST_WITH(adc_of_table_1, open_paper, NULL)
{
    struct ceduo_adc a = ceduo_adc(&one.stand, PAPER_B), b = ceduo_adc(&two.stand, PAPER_B);
    ROWS(expect_exact, (a.gsteiger_stools, 3.0408464743513717), (b.gsteiger_stools, 4.1072434112628),
         (a.interception, 1.9483462242414016), (b.interception, 2.6053723298516003), (a.gsteiger_stems, 1.4869189789743706),
         (b.gsteiger_stems, 2.9638349890797495));
    expect_decimals(a.crofton, 2.16747, 5);
    expect_decimals(b.crofton, 3.51373, 5);
    ROWS(EXPECT, (ceduo_adc_value(&a, CEDUO_RULE_GSTEIGER_STOOLS), ==, a.gsteiger_stools),
         (ceduo_adc_value(&a, CEDUO_RULE_INTERCEPTION), ==, a.interception),
         (ceduo_adc_value(&a, CEDUO_RULE_GSTEIGER_STEMS), ==, a.gsteiger_stems),
         (ceduo_adc_value(&a, CEDUO_RULE_CROFTON), ==, a.crofton));
    expect_decimals(1 / a.gsteiger_stems, .67253, 5); /* stems met per metre */
    expect_decimals(1 / b.gsteiger_stems, .33740, 5);
    expect_decimals(1 / a.crofton, .46137, 5); /* stools and trees met per metre */
    one.stand.trees_count = 0;
    expect_decimals(1 / ceduo_adc(&one.stand, PAPER_B).crofton, .40579, 5); /* stools alone */
}

TEST_WITH(the_rule_of_the_paper, open_paper, NULL)
{
    ROWS(assert_int_equal, (ceduo_adc_rule(&plot.stand, PAPER_B, CEDUO_RULE_AUTO), CEDUO_RULE_INTERCEPTION),
         (ceduo_adc_rule(&plot.stand, 0.5, CEDUO_RULE_AUTO), CEDUO_RULE_INTERCEPTION),
         (ceduo_adc_rule(&plot.stand, 0.49, CEDUO_RULE_AUTO), CEDUO_RULE_GSTEIGER_STEMS),
         (ceduo_adc_rule(&plot.stand, 0.49, CEDUO_RULE_CROFTON), CEDUO_RULE_CROFTON));
    plot.stand.stools_per_ha = 0;
    plot.stand.shoots_count = 0;
    assert_int_equal(ceduo_adc_rule(&plot.stand, PAPER_B, CEDUO_RULE_AUTO), CEDUO_RULE_GSTEIGER_STEMS);
}

/* Kilojoules over 67.5 m of ADS 1 and 67.5 m of ADS 2. */
static double energy_of_both_plots(enum ceduo_rule rule)
{
    double sum = 0;
    for (int number = 1; number <= 2; number++) {
        paper_plot_init(&plot, number);
        sum += 67.5 * ceduo_energy_per_metre(&plot.stand, PAPER_B, rule) / 1e3;
    }
    return sum;
}

static double three_decimals(double v)
{
    return round(v * 1e3) / 1e3;
}

TEST_WITH(energy_of_tables_7_and_8, open_paper, NULL)
{
    ROWS(expect_decimals, (energy_of_both_plots(CEDUO_RULE_GSTEIGER_STOOLS), 34.3844, 4),
         (energy_of_both_plots(CEDUO_RULE_GSTEIGER_STOOLS), 34, 0),
         (energy_of_both_plots(CEDUO_RULE_INTERCEPTION), 53.8216, 4));
    EXPECT(energy_of_both_plots(CEDUO_RULE_AUTO), ==, energy_of_both_plots(CEDUO_RULE_INTERCEPTION));
    expect_decimals(energy_of_both_plots(CEDUO_RULE_GSTEIGER_STEMS), 63.7469, 4);
    expect_decimals(energy_of_both_plots(CEDUO_RULE_INTERCEPTION) / 1.35, 39.87, 2); /* per 100 m */
    expect_decimals(energy_of_both_plots(CEDUO_RULE_INTERCEPTION) / 1.35, 40, 0);
    double printed = 0; /* the paper continues with ADC rounded to three decimals */
    for (int number = 1; number <= 2; number++) {
        paper_plot_init(&plot, number);
        double adc = three_decimals(ceduo_adc(&plot.stand, PAPER_B).interception);
        expect_decimals(adc, number == 1 ? 1.948 : 2.605, 9);
        printed += 67.5 / adc * ceduo_contact_energy(&plot.stand, &plot.shoots) / 1e3;
    }
    expect_decimals(printed, 53.831, 3);
}

TEST_WITH(energy_of_one_contact, open_paper, NULL)
{
    expect_exact(ceduo_contact_energy(&one.stand, &one.shoots), 1099.96); /* Eq. 3 */
    expect_exact(ceduo_contact_energy(&two.stand, &two.trees), 606.52);
}

/* All trees are gone: the rock meets only the stumps, in each form. */
TEST_WITH(stumps_without_trees, open_paper, NULL)
{
    struct ceduo_stems felled = {.per_ha = 0, .dbh = 0.20, .height = 14, .volume = NAN, .age = NAN};
    struct ceduo_stand stand = {.system = CEDUO_SYSTEM_SIMPLE_COPPICE,
                                .species = -1,
                                .trees_count = 1,
                                .trees = &felled,
                                .u = NAN,
                                .stumps = {.per_ha = 400, .diameter = 0.25, .height = 0.4}};
    struct ceduo_adc adc = ceduo_adc(&stand, 0.75);
    expect_exact(adc.gsteiger_stools, 25); /* 10 000 m2 / (400 x 1 m) */
    ROWS(expect_exact, (adc.gsteiger_stems, 25), (adc.interception, 25), (adc.crofton, 25));
}

TEST_WITH(reserves_after_a_cut, open_paper, NULL)
{
    struct ceduo_stems reserves = {.per_ha = 60, .dbh = 0.20, .height = 14, .volume = NAN, .age = NAN};
    struct ceduo_stand stand = {
        .system = CEDUO_SYSTEM_SIMPLE_COPPICE, .species = -1, .trees_count = 1, .trees = &reserves, .u = NAN};
    struct ceduo_adc adc = ceduo_adc(&stand, PAPER_B);
    expect_decimals(adc.gsteiger_stems, 189.394, 3);
    EXPECT_IS(adc, (gsteiger_stools, adc.gsteiger_stems), (interception, adc.gsteiger_stems), (crofton, adc.gsteiger_stems));
    reserves.per_ha = 378;
    assert_false(ceduo_adc(&stand, PAPER_B).gsteiger_stems < CEDUO_THRESHOLD_M);
    reserves.per_ha = 379;
    EXPECT(ceduo_adc(&stand, PAPER_B).gsteiger_stems, <, CEDUO_THRESHOLD_M);
}

TEST_WITH(the_threshold_in_a_belt, open_paper, NULL)
{
    struct ceduo_stems reserves = {.per_ha = 378, .dbh = 0.20, .height = 14, .volume = NAN, .age = NAN};
    struct ceduo_belt belt = {.from = 0, .to = 135, .stand = {.species = -1, .trees_count = 1, .trees = &reserves, .u = NAN}};
    assert_false(ceduo_assess_stand(&site.scene, &belt).passes_threshold);
    reserves.per_ha = 379;
    struct ceduo_stand_result r = ceduo_assess_stand(&site.scene, &belt);
    assert_true(r.passes_threshold);
    assert_int_equal(r.rule, CEDUO_RULE_GSTEIGER_STEMS);
    expect_exact(r.contacts, 135 * 379 * 0.88 / 1e4);
    EXPECT_IS(r, (stools_per_ha, 0), (trees_per_ha, 379), (stems_per_ha, 379));
}

/* The paper states ±0.03 m. */
TEST_WITH(sensitivity_to_the_spacing_of_the_shoots, open_paper, NULL)
{
    static const double change[2][2] = {{0.151, -0.131}, {0.206, -0.178}};
    for (int i = 0; i < 2; i++) {
        paper_plot_init(&plot, i + 1);
        double at = ceduo_adc(&plot.stand, PAPER_B).interception;
        plot.stand.spacing = 0.4;
        expect_decimals(ceduo_adc(&plot.stand, PAPER_B).interception - at, change[i][0], 3);
        plot.stand.spacing = 0.6;
        expect_decimals(ceduo_adc(&plot.stand, PAPER_B).interception - at, change[i][1], 3);
    }
}

TEST_WITH(stools_on_a_ring, open_paper, NULL)
{
    EXPECT(ceduo_stool_perimeter(1, 0.5), ==, 0);
    ROWS(expect_exact, (ceduo_stool_perimeter(2, 0.5), 1), (ceduo_stool_perimeter(3, 0.5), 1.5),
         (ceduo_stool_perimeter(4, 0.5), 2));
    expect_exact(ceduo_stool_perimeter(1.25, 0.5), 0.25); /* a quarter of the stools have two */
    expect_exact(ceduo_stool_perimeter(2.5, 0.5), 1.25);
    EXPECT(ceduo_stool_radius(1, 0.5), ==, 0);
    ROWS(expect_exact, (ceduo_stool_radius(2, 0.5), 0.25), (ceduo_stool_radius(3, 0.5), 0.5 / sqrt(3)),
         (ceduo_stool_radius(4, 0.5), 0.5 / sqrt(2)), (ceduo_stool_radius(6, 0.5), 0.5));
}

TEST_WITH(basal_area_of_table_1, open_paper, NULL)
{
    expect_decimals(ceduo_stand_basal_area(&one.stand), 26.52, 2); /* the paper prints 25.929 */
    expect_decimals(ceduo_stand_basal_area(&two.stand), 8.05, 2);  /* and 8.11 */
    expect_exact(ceduo_stand_shoots(&one.stand) + ceduo_stand_trees(&one.stand), 9076);
    expect_exact(ceduo_stand_shoots(&two.stand) + ceduo_stand_trees(&two.stand), 4641);
    one.trees.dbh_sd = 0.02; /* the mean of d2 is the squared mean plus the variance */
    expect_decimals(ceduo_stand_basal_area(&one.stand) - 750 * acos(-1) / 4 * 4e-4, 26.52, 2);
}

/* ---- energies of contacts ---- */

TEST_WITH(energies_of_dorren, open_paper, NULL)
{
    static const double cm[] = {4.7, 6.1, 8, 10}, kj[] = {1.381, 2.522, 4.719, 7.902};
    for (size_t i = 0; i < LENGTH(cm); i++)
        expect_decimals(ceduo_dorren_energy(cm[i] / 100, 1) / 1e3, kj[i], 3);
    ROWS(expect_decimals, (ceduo_dorren_energy(.15, 1) / 1e3, 20.16, 2), (ceduo_dorren_energy(.20, 1) / 1e3, 39.18, 2),
         (ceduo_dorren_energy(.30, 1) / 1e3, 99.97, 2), (ceduo_dorren_energy(.40, 1) / 1e3, 194.3, 1));
    expect_exact(ceduo_dorren_energy(.40, 1.7), 1.7 * ceduo_dorren_energy(.40, 1));
    ROWS(expect_decimals, (ceduo_dorren_share(0), .980, 3), (ceduo_dorren_share(.5), .789, 3),
         (ceduo_dorren_share(.58), .467, 3));
    EXPECT(ceduo_dorren_share(1), ==, 0); /* -0.046, clamped */
    expect_decimals(ceduo_dorren_mean_share(), .558, 3);
    double sum = 0;
    for (int i = 0; i < 100000; i++)
        sum += ceduo_dorren_share((i + 0.5) / 1e5);
    expect_decimals(ceduo_dorren_mean_share(), sum / 1e5, 8);
    plot.stand.energy = CEDUO_ENERGY_MODEL_DORREN;
    plot.stand.fracture_ratio = 1.5;
    expect_exact(ceduo_contact_energy(&plot.stand, &plot.shoots),
                 1.5 * ceduo_dorren_mean_share() * ceduo_dorren_energy(.061, 1));
}

struct volume_row {
    const char *species;
    double d_cm, h, litres;
    enum ceduo_volume_from from;
};

TEST_WITH(volumes_of_tabacchi, open_paper, NULL)
{
    static const struct volume_row rows[] = {
        {"acer", 22, 14, 252.958, CEDUO_VOLUME_EQUATION},
        {"ostrya-carpinifolia", 6.1, 6, -1.4983 + 0.038828 * 6.1 * 6.1 * 6, CEDUO_VOLUME_EQUATION}, /* 7.17 */
        {"fraxinus-ornus", 6.1, 6, -0.11137 + 0.039108 * 6.1 * 6.1 * 6, CEDUO_VOLUME_EQUATION},     /* 8.62 */
        {"quercus-cerris", 20, 15, -0.043221 + 0.038079 * 400 * 15, CEDUO_VOLUME_EQUATION},
        {"quercus-pubescens", 20, 12, 0.51025 + 0.045184 * 400 * 12 - 0.36026 * 20, CEDUO_VOLUME_EQUATION},
        {"quercus-ilex", 20, 12, -2.2219 + 0.039685 * 400 * 12 + 0.62762 * 20, CEDUO_VOLUME_EQUATION},
        {"fagus-sylvatica", 30, 20, 0.81151 + 0.038965 * 900 * 20, CEDUO_VOLUME_EQUATION},
        {"castanea-sativa", 20, 15, -2.001 + 0.036524 * 400 * 15 + 0.74466 * 20, CEDUO_VOLUME_EQUATION},
        {"robinia-pseudoacacia", 20, 15, -2.1214 + 0.037123 * 400 * 15 + 0.14296 * 20, CEDUO_VOLUME_EQUATION},
        {"picea-abies", 30, 20, -9.1298 + 0.034866 * 900 * 20 + 1.4633 * 30, CEDUO_VOLUME_EQUATION},
        /* to the limits of its rectangle */
        {"ostrya-carpinifolia", 20, 30, -1.4983 + 0.038828 * 400 * 30, CEDUO_VOLUME_EQUATION},
        {"castanea-sativa", 20, 5, -2.001 + 0.036524 * 400 * 5 + 0.74466 * 20, CEDUO_VOLUME_EQUATION},
        /* outside the rectangle d2 h times that of its nearest point */
        {"ostrya-carpinifolia", 4.7, 4, (-1.4983 + 0.038828 * 25 * 5) * (4.7 * 4.7 * 4) / (25 * 5), CEDUO_VOLUME_FORM_FACTOR},
        {"ostrya-carpinifolia", 36, 20, (-1.4983 + 0.038828 * 35 * 35 * 20) * (36 * 36.) / (35 * 35), CEDUO_VOLUME_FORM_FACTOR},
        {"castanea-sativa", 3, 40, (-2.001 + 0.036524 * 36 * 30 + 0.74466 * 6) * (9 * 40.) / (36 * 30),
         CEDUO_VOLUME_FORM_FACTOR},
        {"acer", 20, 25, (1.6905 + 0.037082 * 400 * 24) * 25 / 24, CEDUO_VOLUME_FORM_FACTOR},
    };
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct volume_row *r = &rows[i];
        struct ceduo_stand stand = {.species = ceduo_species_find(r->species), .u = NAN};
        EXPECT(stand.species, >=, 0);
        struct ceduo_stems stems = {.per_ha = 1, .dbh = r->d_cm / 100, .height = r->h, .volume = NAN};
        enum ceduo_volume_from from;
        expect_decimals(ceduo_stem_volume(&stand, &stems, &from) * 1e3, r->litres, i == 0 ? 3 : 9);
        assert_int_equal(from, r->from);
    }
    assert_int_equal(ceduo_species_find("sequoia"), -1);
}

/* A slightly thicker or taller stem never takes less: there is no jump at the edge of any species' data. */
TEST_WITH(volumes_have_no_jump, open_paper, NULL)
{
    size_t n;
    const struct ceduo_species *list = ceduo_species_list(&n);
    for (size_t i = 0; i < n; i++) {
        const double edges[][2] = {{list[i].d_lo, 12}, {list[i].d_hi, 12}, {20, list[i].h_lo}, {20, list[i].h_hi}};
        struct ceduo_stand stand = {.species = (int)i, .u = NAN};
        for (size_t e = 0; e < LENGTH(edges); e++) {
            double before = 0;
            for (int k = -1; k <= 1; k += 2) {
                double more = 1 + 1e-9 * k;
                struct ceduo_stems stems = {
                    .per_ha = 1, .volume = NAN, .dbh = edges[e][0] / 100 * more, .height = edges[e][1] * more};
                double volume = ceduo_stem_volume(&stand, &stems, NULL);
                if (k > 0) {
                    EXPECT(volume, >, before);
                    EXPECT_NEAR(volume / before, 1, 1e-7);
                }
                before = volume;
            }
        }
    }
}

TEST_WITH(energy_of_a_reserve_by_its_volume, open_paper, NULL)
{
    struct ceduo_stand stand = {.species = ceduo_species_find("ostrya-carpinifolia"), .u = NAN};
    struct ceduo_stems stems = {.per_ha = 60, .dbh = .20, .height = 14, .volume = NAN};
    expect_decimals(ceduo_contact_energy(&stand, &stems) / 1e3, 22.2, 1);
}

TEST_WITH(work_of_table_4, open_paper, NULL)
{
    struct ceduo_stand stand = {.species = ceduo_species_find("picea-abies"), .u = NAN};
    EXPECT(ceduo_stand_u(&stand), ==, 92213);
    stand.species = ceduo_species_find("fagus-sylvatica");
    EXPECT(ceduo_stand_u(&stand), ==, 102800);
    stand.species = ceduo_species_find("quercus-cerris");
    EXPECT(ceduo_stand_u(&stand), ==, 102800);
    stand.species = -1;
    EXPECT(ceduo_stand_u(&stand), ==, 102800);
    stand.u = 5e4;
    EXPECT(ceduo_stand_u(&stand), ==, 5e4);
}

/* ---- strata ---- */

TEST_WITH(each_stratum_takes_its_own_energy, open_paper, NULL)
{
    struct ceduo_stems shoots[2] = {{.per_ha = 3000, .dbh = .05, .height = 6, .volume = .01, .age = NAN},
                                    {.per_ha = 1000, .dbh = .10, .height = 9, .volume = .04, .age = NAN}};
    struct ceduo_stems trees[2] = {{.per_ha = 100, .dbh = .20, .height = 14, .volume = .2, .age = NAN},
                                   {.per_ha = 20, .dbh = .40, .height = 20, .volume = 1, .age = NAN}};
    struct ceduo_stand stand = {.species = -1,
                                .stools_per_ha = 2000,
                                .spacing = .3,
                                .shoots_count = 2,
                                .trees_count = 2,
                                .shoots = shoots,
                                .trees = trees,
                                .u = 1e5};
    const double b = .7, a = 1e4, dc = .0625, wc = 1e5 * .0175;
    const double d = (150 + 100 + 20 + 8) / 4120., t = (100 * .9 * 2e4 + 20 * 1.1 * 1e5) / a;
    ROWS(expect_exact, (ceduo_energy_per_metre(&stand, b, CEDUO_RULE_INTERCEPTION), 2000 * (b + dc + .3) * wc / a + t),
         (ceduo_energy_per_metre(&stand, b, CEDUO_RULE_CROFTON), 2000 * (b + dc + .6 / acos(-1)) * wc / a + t),
         (ceduo_energy_per_metre(&stand, b, CEDUO_RULE_GSTEIGER_STOOLS), (b + d) * (2000 * wc + 100 * 2e4 + 20 * 1e5) / a));
    expect_exact(ceduo_energy_per_metre(&stand, b, CEDUO_RULE_GSTEIGER_STEMS),
                 (3000 * (b + .05) * 1e3 + 1000 * (b + .1) * 4e3) / a + t);
    struct ceduo_adc adc = ceduo_adc(&stand, b);
    ROWS(expect_exact, (adc.gsteiger_stools, a / (2120 * (b + d))),
         (adc.gsteiger_stems, a / (3000 * .75 + 1000 * .8 + 100 * .9 + 20 * 1.1)),
         (adc.interception, a / (2120 * b + 2000 * (dc + .3) + 28)));
}

/* ---- warnings ---- */

TEST_WITH(warnings_of_the_plots, open_paper, NULL)
{
    /* ADS 2: s > (n - 1)(B + d), more contacts than stems */
    expect_warned(&two.stand, CEDUO_WARNING_BELOW_FREE_PATH, ~(unsigned)CEDUO_WARNING_BELOW_FREE_PATH);
    expect_warned(&one.stand, 0, ~0U);
}

TEST_WITH(a_warning_near_the_jump, open_paper, NULL)
{
    /* a tenth of the spacing: from .68/1.1 = .618 to .68/.9 = .756 m */
    static const double near[] = {.619, .68, .755}, far[] = {.617, .757};
    for (size_t i = 0; i < LENGTH(near); i++) {
        plot.stand.spacing = near[i];
        expect_warned(&plot.stand, CEDUO_WARNING_NEAR_JUMP, 0);
        EXPECT(ceduo_stand_warnings(&plot.stand, PAPER_B, CEDUO_RULE_CROFTON) & CEDUO_WARNING_NEAR_JUMP, ==, 0);
    }
    for (size_t i = 0; i < LENGTH(far); i++) {
        plot.stand.spacing = far[i];
        expect_warned(&plot.stand, 0, CEDUO_WARNING_NEAR_JUMP);
    }
}

TEST_WITH(warnings_of_energies_and_spacing, open_paper, NULL)
{
    plot.stand.energy = CEDUO_ENERGY_MODEL_DORREN;
    expect_warned(&plot.stand, CEDUO_WARNING_DORREN_THIN, CEDUO_WARNING_U_ASSUMED | CEDUO_WARNING_FORM_FACTOR);
    plot.stand.fracture_ratio = NAN; /* hop hornbeam has no ratio */
    expect_warned(&plot.stand, CEDUO_WARNING_RATIO_ASSUMED, CEDUO_WARNING_WIDE_SPACING);
    plot.shoots.dbh = plot.trees.dbh = .1;
    expect_warned(&plot.stand, 0, CEDUO_WARNING_DORREN_THIN);
    plot.trees.dbh = .099;
    expect_warned(&plot.stand, CEDUO_WARNING_DORREN_THIN, 0);
    paper_plot_init(&plot, 2);
    plot.shoots.volume = NAN; /* 4.7 cm and 4 m are outside the equation */
    expect_warned(&plot.stand, CEDUO_WARNING_FORM_FACTOR, 0);
    plot.stand.u = NAN; /* hop hornbeam is not in Table 4 */
    expect_warned(&plot.stand, CEDUO_WARNING_U_ASSUMED, 0);
    plot.stand.species = ceduo_species_find("fagus-sylvatica");
    expect_warned(&plot.stand, 0, CEDUO_WARNING_U_ASSUMED);
    plot.stand.spacing = .73; /* B + d = .727 */
    expect_warned(&plot.stand, CEDUO_WARNING_WIDE_SPACING, 0);
    plot.stand.spacing = .72;
    expect_warned(&plot.stand, 0, CEDUO_WARNING_WIDE_SPACING);
}

/* ---- index ---- */

TEST_WITH(free_runs_of_the_plots, open_paper, NULL)
{
    for (int i = 0; i < 2; i++) {
        struct ceduo_stand_result r = ceduo_assess_stand(&site.scene, &site.belts[i]);
        double crofton = i == 0 ? 2.16747 : 3.51373;
        EXPECT_NEAR(r.free_run_probability / exp(-30 / crofton), 1, 5e-5);
        expect_exact(r.free_run_probability, exp(-30 / r.adc.crofton));
        expect_exact(r.contacts, 67.5 / (i == 0 ? 1.9483462242414016 : 2.6053723298516003)); /* Eq. 2 */
        expect_exact(r.energy_per_contact, i == 0 ? 1099.96 : 606.52);
        expect_exact(r.dissipated, r.contacts * r.energy_per_contact); /* Eq. 4 */
        assert_true(r.passes_threshold);
        EXPECT(r.adc_m, ==, r.adc.interception);
    }
}

TEST_WITH(index_of_the_site, open_paper, NULL)
{
    struct ceduo_index i = ceduo_assess_index(&site.scene, &site.option, &site.control, 112.319e3);
    expect_decimals(i.dissipated / 1e3, 53.8216, 4);
    expect_decimals(i.residual / 1e3, 112.319 - 53.8216, 3); /* Eq. 5 */
    assert_false(i.exhausted);
    EXPECT_IS(i, (length, 135), (longest_gap, 0), (contact, CEDUO_LIGHT_PASS), (free_run, CEDUO_LIGHT_PASS));
    expect_decimals(i.measured / 1e3, 62.337, 3);
    double nothing = exp(-67.5 / 2.16747 - 67.5 / 3.51373);
    EXPECT_NEAR(i.meet_nothing_probability / nothing, 1, 2e-4);
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, 50e3);
    assert_true(i.exhausted);
    EXPECT(i.residual, ==, 0);
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, NAN);
    assert_true(isnan(i.residual));
    assert_false(i.exhausted);
}

TEST_WITH(meets_nothing_in_ten_metres_of_ads_1, open_paper, NULL)
{
    site.belts[0].to = 10;
    site.option.belts_count = 1;
    struct ceduo_index i = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e5);
    expect_decimals(i.meet_nothing_probability, .00992, 5);
    EXPECT_IS(i, (longest_gap, 125), (contact, CEDUO_LIGHT_FAIL));
}

TEST_WITH(index_without_forest, open_paper, NULL)
{
    site.option.belts_count = 0;
    site.control.measured_speed = NAN;
    struct ceduo_index i = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e5);
    EXPECT_IS(i, (length, 0), (longest_gap, 135), (dissipated, 0), (residual, 1e5), (meet_nothing_probability, 1),
              (worst_free_run, 1), (contact, CEDUO_LIGHT_FAIL), (free_run, CEDUO_LIGHT_FAIL));
    assert_true(isnan(i.measured));
    struct ceduo_belt bare = {.from = 0, .to = 135, .stand = {.system = CEDUO_SYSTEM_BARE, .species = -1, .u = NAN}};
    struct ceduo_stand_result r = ceduo_assess_stand(&site.scene, &bare);
    assert_true(r.bare);
    assert_true(isinf(r.adc_m));
    EXPECT_IS(r, (contacts, 0), (dissipated, 0));
    assert_true(isnan(r.energy_per_contact));
    EXPECT(r.free_run_probability, ==, 1);
    assert_false(r.passes_threshold);
    EXPECT_IS(r, (basal_area, 0), (warnings, 0));
}

TEST_WITH(a_young_coppice_passes_thirty_metres_and_stops_nothing, open_paper, NULL)
{
    struct ceduo_stems shoots = {.per_ha = 12000, .dbh = .02, .height = 3, .volume = NAN, .age = 5};
    struct ceduo_stand stand = {
        .species = -1, .stools_per_ha = 3000, .spacing = .2, .shoots_count = 1, .shoots = &shoots, .u = NAN};
    EXPECT(ceduo_adc(&stand, PAPER_B).interception, <, CEDUO_THRESHOLD_M);
    EXPECT(100 * ceduo_energy_per_metre(&stand, PAPER_B, CEDUO_RULE_AUTO), <, 2e3);
}

/* ---- checks of a scene ---- */
