/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stands through the years: closed forms, and rules for any stand. */
#include "core/stand/adc.h"
#include "core/stand/rotation.h"
#include "expect.h"
#include "local.h"
#include "scene/stand.h"

#include <math.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "line_scene.h"
#include "paper_site.h"

#define STANDS      3000
#define YEARS       90
#define COHORTS_MAX 4
#define B           0.68 /* m: the paper's rock */

/* ---- a growing stand ---- */

struct sample {
    struct ceduo_stand stand;
    struct ceduo_stems shoots[COHORTS_MAX], trees[COHORTS_MAX];
    double stay[COHORTS_MAX];
};

static struct sample s; /* reset before each test that uses it; contains pointers into itself */

/* Ostrya, 2500 stools with 7500 shoots of 5 cm and 60 trees of 20 cm, cut every 25 years. */
static void init(void)
{
    memset(&s, 0, sizeof s);
    s.shoots[0] = paper_stems(7500, .05, 6);
    s.trees[0] = paper_stems(60, .20, 12);
    s.stay[0] = s.stay[1] = 30;
    s.stand = paper_coppice(s.shoots, s.trees, 1, 25, s.stay);
}

static int fresh(void **state)
{
    (void)state;
    init();
    return 0;
}

static struct ceduo_grown_stand grow_stand(double first_cut, unsigned year)
{
    struct ceduo_grown_stand grown;
    assert_int_equal(ceduo_stand_at(&s.stand, first_cut, year, &grown), CEDUO_OK);
    return grown;
}

static void expect_same_stems(const struct ceduo_stems *a, const struct ceduo_stems *b, size_t n)
{
    if (n > 0)
        assert_memory_equal(a, b, n * sizeof *a);
}

/* Expect two stands to be equal bit by bit. */
static void expect_same_stand(const struct ceduo_stand *a, const struct ceduo_stand *b)
{
    assert_int_equal(a->shoots_count, b->shoots_count);
    assert_int_equal(a->trees_count, b->trees_count);
    expect_same_stems(a->shoots, b->shoots, a->shoots_count);
    expect_same_stems(a->trees, b->trees, a->trees_count);
    assert_memory_equal(&a->stools_per_ha, &b->stools_per_ha, sizeof a->stools_per_ha);
    assert_memory_equal(&a->spacing, &b->spacing, sizeof a->spacing);
    assert_memory_equal(&a->u, &b->u, sizeof a->u);
    assert_memory_equal(&a->fracture_ratio, &b->fracture_ratio, sizeof a->fracture_ratio);
    EXPECT_SAME(*a, *b, system, species, energy);
}

/* ---- before the first cut ---- */

TEST_WITH(year_0_is_the_stand_of_the_file, fresh, NULL)
{
    s.stand.growth.sdi_max = 1; /* a measured stand is not thinned */
    struct ceduo_grown_stand grown = grow_stand(3, 0);
    expect_same_stand(&grown.stand, &s.stand);
    EXPECT(grown.stand.growth.sdi_max, ==, 0);
    EXPECT(grown.stand.cutting.rotation, ==, 0);
    ceduo_grown_stand_release(&grown);
    assert_null(grown.stems);
    init();
    memset(&s.stand.growth, 0, sizeof s.stand.growth); /* NaN: for ever */
    assert_int_equal(ceduo_first_cut(&s.stand, 3), CEDUO_NEVER);
    for (unsigned year = 0; year < 60; year += 3) {
        grown = grow_stand(3, year);
        expect_same_stand(&grown.stand, &s.stand);
        ceduo_grown_stand_release(&grown);
    }
}

TEST_WITH(an_inventory_grows_along_its_curves, fresh, NULL)
{
    s.shoots[0].volume = .004;
    s.shoots[0].dbh_sd = .01;
    s.stand.growth.sdi_max = 0;
    double a = -log(1 - 5. / 16) / .022, b = -log(1 - 20. / 45) / .014;
    for (unsigned t = 1; t < 200; t += 7) {
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(INFINITY, t);
        const struct ceduo_stems *shoot = &grown.stand.shoots[0], *tree = &grown.stand.trees[0];
        double d = .16 * (1 - exp(-.022 * (a + t))), h = 6 * (1 - exp(-.035 * (a + t))) / (1 - exp(-.035 * a));
        ROWS(expect_relative, (shoot->dbh, d, 1e-13), (shoot->height, h, 1e-13), (shoot->dbh_sd, .01 * d / .05, 1e-13),
             (shoot->volume, .004 * d * d * h / (.05 * .05 * 6), 1e-13), (shoot->age, a + t, 1e-13),
             (shoot->per_ha, 7500 * (3 + 13 * exp(-(a + t) / 5)) / (3 + 13 * exp(-a / 5)), 1e-13),
             (tree->dbh, .45 * (1 - exp(-.014 * (b + t))), 1e-13),
             (tree->height, 12 * (1 - exp(-.03 * (b + t))) / (1 - exp(-.03 * b)), 1e-13));
        EXPECT(tree->per_ha, ==, 60);
        assert_true(isnan(tree->volume));
        EXPECT(tree->dbh_sd, ==, 0);
        EXPECT(grown.stand.stools_per_ha, ==, 2500);
    }
}

TEST_WITH(a_given_age_overrides_the_curve, fresh, NULL)
{
    s.shoots[0].age = 8;
    s.trees[0].age = 70;
    s.stand.growth.sdi_max = 0;
    struct ceduo_grown_stand grown = grow_stand(INFINITY, 10);
    ROWS(expect_relative, (grown.stand.shoots[0].dbh, .05 * (1 - exp(-.022 * 18)) / (1 - exp(-.022 * 8)), 1e-14),
         (grown.stand.shoots[0].per_ha, 7500 * (3 + 13 * exp(-18. / 5)) / (3 + 13 * exp(-8. / 5)), 1e-14),
         (grown.stand.trees[0].dbh, .2 * (1 - exp(-.014 * 80)) / (1 - exp(-.014 * 70)), 1e-14));
    EXPECT(grown.stand.shoots[0].age, ==, 18);
    EXPECT(grown.stand.trees[0].age, ==, 80);
    ceduo_grown_stand_release(&grown);
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), 17);
    s.shoots[0].age = 0; /* no stem has a diameter at age 0: ignored */
    grown = grow_stand(INFINITY, 10);
    expect_relative(grown.stand.shoots[0].dbh, .16 * (1 - 11. / 16 * exp(-.22)), 1e-14);
    ceduo_grown_stand_release(&grown);
}

/* If an old stool should have no shoots, they decrease by e in 5 years; if it began with none, it stays so. */
TEST_WITH(no_old_shoots, fresh, NULL)
{
    s.stand.growth.sdi_max = 0;
    s.stand.growth.shoots_old = 0;
    s.stand.stools_per_ha = 1;
    assert_int_equal(ceduo_first_cut(&s.stand, 3), CEDUO_NEVER); /* nothing would sprout */
    struct ceduo_grown_stand grown = grow_stand(3, 10);
    expect_relative(grown.stand.shoots[0].per_ha, 7500 * exp(-2), 1e-13);
    ceduo_grown_stand_release(&grown);
    s.stand.growth.shoots_young = 0;
    grown = grow_stand(3, 10);
    EXPECT(grown.stand.shoots[0].per_ha, ==, 7500);
    EXPECT(grown.stand.shoots[0].dbh, >, .05);
    ceduo_grown_stand_release(&grown);
    s.stand.shoots_count = 0; /* just cut */
    assert_false(ceduo_stand_sprouts(&s.stand));
    s.stand.growth.shoots_old = 3;
    assert_true(ceduo_stand_sprouts(&s.stand));
}

/* After some 3500 years e^(-t/5) underflows, but each stool keeps a shoot. */
TEST_WITH(each_stool_keeps_a_shoot_for_ages, fresh, NULL)
{
    s.stand.growth.shoots_old = 0;
    s.stand.growth.sdi_max = 0;
    for (unsigned t = 3400; t < 4000; t += 5) {
        struct ceduo_grown_stand grown = grow_stand(INFINITY, t);
        expect_relative(ceduo_stand_shoots(&grown.stand), 2500, 1e-13);
        ceduo_grown_stand_release(&grown);
    }
}

/* On its curve a stem of 1e-320 m is some 1e-318 years old; its later width once overflowed. */
TEST(a_tiny_stem_grows_like_a_new_one)
{
    static const double given[][2] = {{1e-320, NAN}, {5e-324, NAN}, {.05, 5e-324}, {.05, 1e-300}};
    for (size_t i = 0; i < LENGTH(given); i++) {
        init();
        s.shoots[0].dbh = s.trees[0].dbh = given[i][0];
        s.shoots[0].age = s.trees[0].age = given[i][1];
        s.shoots[0].volume = s.trees[0].volume = 1;
        s.stand.growth.sdi_max = 0;
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(INFINITY, 10);
        const struct ceduo_stems *shoot = &grown.stand.shoots[0], *tree = &grown.stand.trees[0];
        ROWS(expect_relative, (shoot->dbh, .16 * (1 - exp(-.22)), 1e-13), (shoot->height, 14 * (1 - exp(-.35)), 1e-13),
             (tree->dbh, .45 * (1 - exp(-.14)), 1e-13), (tree->height, 20 * (1 - exp(-.3)), 1e-13));
        EXPECT_NAN(shoot->volume, tree->volume);
        EXPECT(shoot->age, ==, 10);
        EXPECT_IS(*tree, (age, 10), (per_ha, 60));
        EXPECT(shoot->per_ha, <, 7500);
    }
}

/* With one rate for both, height and diameter have the same share of their maxima. */
TEST(a_curve_gives_heights_by_diameters)
{
    const struct ceduo_curve curve = {.4, .03, 20, .03}, faster = {.4, .03, 20, .06};
    for (double share = 0; share < 1; share += .1) {
        EXPECT_NEAR(ceduo_curve_height(&curve, .4 * share), 20 * share, 1e-12);
        EXPECT_NEAR(ceduo_curve_height(&faster, .4 * share), 20 * (1 - (1 - share) * (1 - share)), 1e-12);
    }
    assert_true(isnan(ceduo_curve_height(&curve, .4)));
    assert_true(isnan(ceduo_curve_height(&(struct ceduo_curve){.4, .03, 0, .03}, .1)));
}

TEST_WITH(a_stem_thicker_than_its_curve_stops_growing, fresh, NULL)
{
    s.shoots[0] = paper_stems(4000, .16, 9);
    s.trees[0] = paper_stems(60, .60, 18);
    s.stand.growth.sdi_max = 0;
    LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(INFINITY, 40);
    expect_same_stand(&grown.stand, &s.stand);
}

TEST_WITH(a_stratum_without_a_curve_stays, fresh, NULL)
{
    s.stand.growth.trees.height_rate = 0;
    assert_int_equal(ceduo_first_cut(&s.stand, 5), CEDUO_NEVER); /* the retained class has no size */
    LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(5, 30);
    expect_same_stems(grown.stand.trees, s.trees, 1);
    EXPECT(grown.stand.shoots[0].dbh, >, .05);
    s.stand.cutting.retained_count = 0;
    assert_int_equal(ceduo_first_cut(&s.stand, 5), 5);
    struct ceduo_curve *shoots = &s.stand.growth.shoots;
    double *const numbers[] = {&shoots->dbh_max, &shoots->dbh_rate, &shoots->height_max, &shoots->height_rate};
    for (size_t i = 0; i < LENGTH(numbers); i++) {
        double was = *numbers[i];
        *numbers[i] = 0;
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand as_filed = grow_stand(5, 3);
        expect_same_stems(as_filed.stand.shoots, s.shoots, 1);
        assert_int_equal(ceduo_first_cut(&s.stand, 5), CEDUO_NEVER);
        *numbers[i] = was;
    }
}

TEST_WITH(never_less_than_one_shoot_a_stool, fresh, NULL)
{
    s.stand.shoots_count = 2; /* 1.2 per stool */
    s.shoots[0] = paper_stems(2000, .01, 1);
    s.shoots[1] = paper_stems(1000, .08, 7);
    s.stand.growth.sdi_max = 0;
    bool reached = false;
    for (unsigned t = 1; t < 60; t++) {
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(INFINITY, t);
        double sum = ceduo_stand_shoots(&grown.stand);
        EXPECT(sum, >=, 2500);
        EXPECT(grown.stand.stools_per_ha, ==, 2500);
        EXPECT(sum, <=, 3000);
        reached |= sum < 2500 * (1 + 1e-12);
    }
    assert_true(reached);
}

/* ---- cuts ---- */

TEST_WITH(the_years_of_cuts, fresh, NULL)
{
    const struct ceduo_stand *stand = &s.stand;
    static const double given[] = {0, 7, 6.2, 30, -1, -5, -25, -26, -50.5, -75}, first[] = {0, 7, 7, 30, 24, 20, 0, 24, 0, 0};
    for (size_t i = 0; i < LENGTH(given); i++)
        assert_int_equal(ceduo_first_cut(stand, given[i]), (unsigned)first[i]);
    EXPECT(ceduo_first_cut(stand, INFINITY), ==, CEDUO_NEVER);
    EXPECT(ceduo_first_cut(stand, 1e12), ==, CEDUO_NEVER);
    assert_false(ceduo_stand_is_cut_year(stand, INFINITY, CEDUO_NEVER));
    for (unsigned year = 0; year < 120; year++)
        EXPECT(ceduo_stand_is_cut_year(stand, -5, year), ==, (year % 25 == 20));
    assert_false(ceduo_stand_is_cut_year(stand, 30, 5)); /* the first cut is the first */
    s.stand.cutting.rotation = 0;
    EXPECT(ceduo_first_cut(stand, 0), ==, CEDUO_NEVER);
    assert_false(ceduo_stand_is_cut_year(stand, 0, 0));
}

TEST_WITH(the_datum_that_a_cut_lacks, fresh, NULL)
{
    const struct ceduo_growth whole = s.stand.growth;
    EXPECT(ceduo_cut_lack(&s.stand, NAN), ==, CUT_LACKS_NOTHING);
    s.stand.growth.shoots_old = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_SHOOTS);
    s.stand.growth = whole;
    s.stand.growth.shoots.dbh_max = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_SHOOTS);
    s.stand.stools_per_ha = 0; /* only trees */
    s.stand.shoots_count = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_NOTHING);
    s.stand.growth.trees.dbh_max = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_TREES);
    s.stay[0] = s.stay[1] = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_NOTHING);
    EXPECT(ceduo_cut_lack(&s.stand, NAN), ==, CUT_LACKS_AGE);
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), CEDUO_NEVER);
    s.trees[0].age = 20;
    EXPECT(ceduo_cut_lack(&s.stand, NAN), ==, CUT_LACKS_NOTHING);
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), 5);
    s.stand.trees_count = 0; /* nothing to cut */
    EXPECT(ceduo_cut_lack(&s.stand, NAN), ==, CUT_LACKS_NOTHING);
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), CEDUO_NEVER);
    s.stand.cutting.rotation = 0;
    EXPECT(ceduo_cut_lack(&s.stand, 3), ==, CUT_LACKS_CUTTING);
}

TEST_WITH(by_default_a_stand_is_cut_at_rotation_age, fresh, NULL)
{
    /* 5 cm: 17.03 years */
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), (unsigned)ceil(25 + log(1 - 5. / 16) / .022));
    s.stand.cutting.cohorts = 3;
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), (unsigned)ceil(75 + log(1 - 5. / 16) / .022));
    s.stand.cutting.cohorts = 0;
    for (unsigned age = 1; age <= 25; age++) { /* within rounding */
        s.shoots[0].dbh = .16 * (1 - exp(-.022 * age));
        assert_int_equal(ceduo_first_cut(&s.stand, NAN), age < 25 ? 25 - age : 1);
    }
    s.shoots[0].dbh = .12; /* too old, but year 0 is the stand of the file */
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), 1);
    s.shoots[0].dbh = .3;
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), 1);
    s.stand.shoots_count = 0; /* only trees; retained ones are cut when they are three rotations old */
    s.stand.stools_per_ha = 0;
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), (unsigned)ceil(75 + log(1 - 20. / 45) / .014));
    s.stay[1] = 0;
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), (unsigned)ceil(50 + log(1 - 20. / 45) / .014));
    s.stand.growth = (struct ceduo_growth){.sdi_max = 0};
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), CEDUO_NEVER);
    s.stand.cutting.retained_count = 0;
    s.trees[0].age = 10; /* known without a curve */
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), 15);
    s.stand.trees_count = 0;
    assert_int_equal(ceduo_first_cut(&s.stand, NAN), CEDUO_NEVER);
}

TEST_WITH(a_simple_coppice_after_its_cuts, fresh, NULL)
{
    s.stand.growth.sdi_max = 0;
    for (unsigned tau = 0; tau < 25; tau++) {
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(4, 4 + tau);
        const struct ceduo_stand *g = &grown.stand;
        assert_int_equal(g->trees_count, 2);
        for (unsigned j = 0; j < 2; j++) {
            double age = 25 * (j + 1) + tau;
            expect_relative(g->trees[j].dbh, .45 * (1 - exp(-.014 * age)), 1e-14);
            expect_relative(g->trees[j].height, 20 * (1 - exp(-.03 * age)), 1e-14);
            EXPECT_IS(g->trees[j], (per_ha, 30), (age, age));
            assert_true(isnan(g->trees[j].volume));
        }
        assert_int_equal(g->shoots_count, tau > 0);
        EXPECT_IS(*g, (stools_per_ha, (tau > 0 ? 2500 : 0)), (spacing, .35));
        if (tau > 0) {
            ROWS(expect_relative, (g->shoots[0].dbh, .16 * (1 - exp(-.022 * tau)), 1e-14),
                 (g->shoots[0].height, 14 * (1 - exp(-.035 * tau)), 1e-14),
                 (g->shoots[0].per_ha, 2500 * (3 + 13 * exp(-.2 * tau)), 1e-14));
            EXPECT(g->shoots[0].dbh_sd, ==, 0);
            assert_true(isnan(g->shoots[0].volume));
        }
    }
}

TEST_WITH(a_selection_coppice_always_has_shoots, fresh, NULL)
{
    s.stand.cutting = (struct ceduo_cutting){13, 3, 2, s.stay};
    s.stay[0] = 0; /* no class */
    s.stand.growth.shoots_old = 6;
    s.stand.growth.sdi_max = 0;
    for (unsigned year = 0; year < 100; year++) {
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(0, year);
        const struct ceduo_stand *g = &grown.stand;
        unsigned tau = year % 13, missing = tau == 0;
        EXPECT_IS(*g, (shoots_count, 3 - missing), (stools_per_ha, 2500));
        for (unsigned i = 0; i < 3 - missing; i++) {
            double age = 13 * (i + missing) + tau;
            expect_relative(g->shoots[i].dbh, .16 * (1 - exp(-.022 * age)), 1e-14);
            expect_relative(g->shoots[i].per_ha, 2500 * (2 + (16. / 3 - 2) * exp(-age / 5)), 1e-14);
        }
        EXPECT(g->trees_count, ==, 1);
        EXPECT(g->trees[0].age, ==, 26 + tau);
    }
    s.stand.growth.shoots_young = s.stand.growth.shoots_old = 1; /* two of three cohorts: less than one per stool */
    LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(0, 13);
    expect_relative(ceduo_stand_shoots(&grown.stand), 2500, 1e-14);
    EXPECT(ceduo_stand_shoots(&grown.stand), >=, 2500);
}

TEST_WITH(a_cut_in_year_0_is_past, fresh, NULL)
{
    struct ceduo_grown_stand now = grow_stand(0, 0), later = grow_stand(0, 25), rhythm = grow_stand(-50, 0);
    EXPECT_IS(now.stand, (shoots_count, 0), (stools_per_ha, 0), (trees_count, 2));
    expect_same_stand(&now.stand, &later.stand);
    expect_same_stand(&now.stand, &rhythm.stand);
    ceduo_grown_stand_release(&now);
    ceduo_grown_stand_release(&later);
    ceduo_grown_stand_release(&rhythm);
    s.stand.cutting.retained_count = 0; /* no tree is retained */
    now = grow_stand(0, 0);
    assert_true(ceduo_stand_is_bare(&now.stand));
    assert_false(now.stems);
    EXPECT(ceduo_stems_sdi(now.stand.trees, now.stand.trees_count), ==, 0);
    ceduo_grown_stand_release(&now);
}

TEST_WITH(a_stand_without_cuts_grows_for_ever, fresh, NULL)
{
    LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand infinite = grow_stand(INFINITY, 1000);
    s.stand.cutting.rotation = 0;
    LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand never = grow_stand(3, 1000);
    expect_same_stand(&never.stand, &infinite.stand);
    expect_relative(never.stand.shoots[0].dbh, .16, 1e-6);
    expect_relative(never.stand.trees[0].dbh, .45, 1e-6);
}

/* ---- density ---- */

static double index_by_hand(const struct ceduo_stems *stems, size_t count)
{
    double n = 0, squares = 0;
    for (const struct ceduo_stems *x = stems; x < stems + count; x++) {
        n += x->per_ha;
        squares += x->per_ha * (x->dbh * x->dbh + x->dbh_sd * x->dbh_sd);
    }
    return n > 0 ? n * pow(100 * sqrt(squares / n) / 25.4, 1.605) : 0;
}

TEST(the_density_index)
{
    struct paper_plot plot; /* one mean diameter each */
    paper_plot_init(&plot, 1);
    expect_relative(ceduo_stems_sdi(&plot.shoots, 1), plot.shoots.per_ha * pow(6.1 / 25.4, 1.605), 1e-13);
    paper_plot_init(&plot, 2);
    expect_relative(ceduo_stems_sdi(&plot.trees, 1), plot.trees.per_ha * pow(4.7 / 25.4, 1.605), 1e-13);
    init();
    s.trees[0].dbh_sd = .02;
    expect_relative(ceduo_stems_sdi(s.trees, 2), index_by_hand(s.trees, 2), 1e-13);
    s.stand.growth.sdi_max = 800;
    expect_relative(ceduo_growing_space_used(&s.stand.growth, &s.stand), index_by_hand(s.trees, s.stand.trees_count) / 280,
                    1e-13);
    s.stand.growth.trees_sdi_max = 500;
    expect_relative(ceduo_growing_space_used(&s.stand.growth, &s.stand), index_by_hand(s.trees, s.stand.trees_count) / 500,
                    1e-13);
}

TEST_WITH(shoots_are_thinned_to_the_density, fresh, NULL)
{
    s.stand.trees_count = s.stand.cutting.retained_count = 0;
    s.stand.growth.sdi_max = 250;
    unsigned thinned = 0, died = 0;
    for (unsigned tau = 1; tau < 25; tau++) { /* without trees the index is proportional to the number */
        LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(0, tau);
        double n = 2500 * (3 + 13 * exp(-.2 * tau)), dbh = 16 * (1 - exp(-.022 * tau));
        double max = 250 * pow(25.4 / dbh, 1.605);
        expect_relative(ceduo_stand_shoots(&grown.stand), fmin(n, max), 1e-12);
        expect_relative(grown.stand.stools_per_ha, fmin(2500, max), 1e-12); /* each with at least one shoot */
        thinned += max < n;
        died += max < 2500;
    }
    EXPECT(thinned, >, 5);
    EXPECT(thinned, <, 20);
    EXPECT(died, >, 0);
    EXPECT(died, <, thinned);
    init();
    s.stand.growth.sdi_max = 600; /* the trees use their part of it */
    s.stand.growth.trees_sdi_max = 400;
    struct ceduo_grown_stand grown = grow_stand(0, 24);
    EXPECT(grown.stand.trees[0].per_ha, ==, 30);
    EXPECT(grown.stand.trees[1].per_ha, ==, 30);
    double trees = index_by_hand(grown.stand.trees, 2);
    EXPECT(trees, >, 50);
    expect_relative(index_by_hand(grown.stand.shoots, grown.stand.shoots_count), 600 * (1 - trees / 400), 1e-12);
    ceduo_grown_stand_release(&grown);
    s.stand.growth.trees_sdi_max = trees / 2; /* the trees alone exceed it */
    grown = grow_stand(0, 24);
    EXPECT(ceduo_stand_shoots(&grown.stand), ==, 0);
    EXPECT(grown.stand.stools_per_ha, ==, 0);
    EXPECT(grown.stand.shoots_count, ==, 0);
    EXPECT(grown.stand.trees[0].per_ha, ==, 30);
    EXPECT(ceduo_growing_space_used(&s.stand.growth, &grown.stand), >, 1);
    ceduo_grown_stand_release(&grown);
}

/* ---- any stand ---- */

static struct line_random random_numbers = {.state = 1};

static double uniform(double lo, double hi)
{
    return line_uniform(&random_numbers, lo, hi);
}

static struct ceduo_curve random_curve(double dbh)
{
    return (struct ceduo_curve){uniform(.7, 1.3) * dbh, uniform(.005, .08), uniform(5, 30), uniform(.005, .08)};
}

static void random_stand(void)
{
    memset(&s, 0, sizeof s);
    double old = uniform(1, 8);
    struct ceduo_stand *stand = &s.stand;
    *stand =
        (struct ceduo_stand){.species = -1,
                             .stools_per_ha = uniform(0, 1) < .1 ? 0 : uniform(200, 4000),
                             .spacing = .3,
                             .trees_count = (size_t)uniform(0, 5),
                             .shoots = s.shoots,
                             .trees = s.trees,
                             .u = NAN,
                             .growth = {random_curve(.16), random_curve(.45), old + uniform(0, 15), old, uniform(-500, 2000),
                                        uniform(0, 1) < .5 ? 0 : uniform(100, 2000), 0},
                             .cutting = {(unsigned)uniform(1, 40), (unsigned)uniform(0, 5), (size_t)uniform(0, 5), s.stay}};
    stand->growth.sdi_max = fmax(0, stand->growth.sdi_max);
    stand->shoots_count = stand->stools_per_ha > 0 ? (size_t)uniform(1, 5) : 0;
    for (size_t i = 0; i < stand->shoots_count; i++)
        s.shoots[i] = paper_stems(stand->stools_per_ha * uniform(1, 6) / (double)stand->shoots_count, uniform(.01, .18), 5);
    for (size_t i = 0; i < stand->trees_count; i++)
        s.trees[i] = paper_stems(uniform(1, 300), uniform(.05, .7), 14);
    for (size_t i = 0; i < stand->cutting.retained_count; i++)
        s.stay[i] = uniform(0, 1) < .3 ? 0 : uniform(0, 200);
}

static bool has_new_shoots(const struct ceduo_stand *stand, double first_cut, unsigned year)
{
    return year > 0 && (ceduo_stand_is_cut_year(stand, first_cut, year) || ceduo_stand_is_cut_year(stand, first_cut, year - 1));
}

TEST(no_stand_gains_stems_by_growing)
{
    for (int i = 0; i < STANDS; i++) {
        random_stand();
        double first_cut = uniform(-60, 60), before = INFINITY;
        for (unsigned year = 0; year < YEARS; year++) {
            LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(first_cut, year);
            double shoots = ceduo_stand_shoots(&grown.stand), sum = shoots + ceduo_stand_trees(&grown.stand);
            bool sprouts = year == 1 && ceduo_stand_sprouts(&s.stand);
            if (sum > before * (1 + 1e-12) && !sprouts && !has_new_shoots(&s.stand, first_cut, year))
                fail_msg("stand %d, year %u: %.17g stems after %.17g", i, year, sum, before);
            EXPECT(shoots, >=, grown.stand.stools_per_ha);
            for (size_t j = 0; j < grown.stand.shoots_count; j++) {
                EXPECT(grown.stand.shoots[j].per_ha, >, 0);
                EXPECT(grown.stand.shoots[j].dbh, >, 0);
            }
            before = sum;
        }
    }
}

TEST(no_computed_stand_is_too_dense)
{
    unsigned thinned = 0, died = 0;
    for (int i = 0; i < STANDS; i++) {
        random_stand();
        const struct ceduo_growth *g = &s.stand.growth;
        for (unsigned year = 1; g->sdi_max > 0 && year < YEARS; year += 4) {
            LOCAL_BY(ceduo_grown_stand_release) struct ceduo_grown_stand grown = grow_stand(NAN, year);
            double all = g->trees_sdi_max > 0 ? g->trees_sdi_max : .35 * g->sdi_max;
            double max = g->sdi_max * fmax(0, 1 - index_by_hand(grown.stand.trees, grown.stand.trees_count) / all);
            double sdi = index_by_hand(grown.stand.shoots, grown.stand.shoots_count), shoots = ceduo_stand_shoots(&grown.stand);
            EXPECT(sdi, <=, max * (1 + 1e-9));
            thinned += max > 0 && fabs(sdi - max) < 1e-9 * max;
            if (shoots > 0 &&
                grown.stand.stools_per_ha < s.stand.stools_per_ha * (1 - 1e-9)) { /* each living stool has one shoot */
                expect_relative(grown.stand.stools_per_ha, shoots, 1e-12);
                expect_relative(sdi, max, 1e-9);
                died++;
            }
        }
    }
    EXPECT(thinned, >, 1000);
    EXPECT(died, >, 1000);
}

TEST(the_stand_repeats_after_a_rotation)
{
    for (int i = 0; i < STANDS; i++) {
        random_stand();
        double given = i % 2 ? NAN : floor(uniform(-60, 60));
        unsigned first = ceduo_first_cut(&s.stand, given), rotation = s.stand.cutting.rotation;
        if (first == CEDUO_NEVER)
            continue;
        unsigned year = first + (unsigned)uniform(0, 60);
        LOCAL_BY(ceduo_grown_stand_release)
        struct ceduo_grown_stand now = grow_stand(given, year), later = grow_stand(given, year + 3 * rotation);
        expect_same_stand(&now.stand, &later.stand);
    }
}

/* ---- systems ---- */

static double adc_just_cut(const char *name, double stools, struct ceduo_cutting cutting, double spacing, double old)
{
    init();
    s.stand.stools_per_ha = stools;
    s.stand.cutting = cutting;
    s.stand.spacing = spacing;
    s.stand.growth.shoots_old = old;
    struct ceduo_grown_stand grown = grow_stand(0, 0);
    struct ceduo_adc adc = ceduo_adc(&grown.stand, B);
    double value = ceduo_adc_value(&adc, ceduo_adc_rule(&grown.stand, B, CEDUO_RULE_AUTO));
    print_message("%s, just cut: ADC %.4f m\n", name, value);
    ceduo_grown_stand_release(&grown);
    return value;
}

/* Ciabocco et al. 2009: just after its cut only the selection coppice has contacts less than 30 m apart. */
TEST(just_cut_only_the_selection_coppice_protects)
{
    double simple[] = {30, 30}, standards[] = {100, 50, 20, 10}, selection[] = {40}, large[] = {125, 125};
    double a = adc_just_cut("simple coppice", 2500, (struct ceduo_cutting){25, 1, 2, simple}, .35, 3);
    double b = adc_just_cut("coppice with standards", 1500, (struct ceduo_cutting){25, 1, 4, standards}, .35, 3);
    double c = adc_just_cut("selection coppice", 1200, (struct ceduo_cutting){13, 3, 1, selection}, .30, 6);
    double d = adc_just_cut("coppice with large reserves", 1500, (struct ceduo_cutting){25, 1, 2, large}, .35, 3);
    ROWS(EXPECT, (a, >, 30), (b, >, 30), (d, >, 30), (c, <, 30));
    double d1 = .45 * (1 - exp(-.35)), d2 = .45 * (1 - exp(-.7));
    expect_relative(a, 1e4 / (30 * (2 * B + d1 + d2)), 1e-13);
    expect_relative(d, 1e4 / (125 * (2 * B + d1 + d2)), 1e-13);
}
