/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From plots to a stand: densities and their errors in a known forest, heights, classes, volumes. */
#include "local.h"

#include "folder.h"
#include "study/naslund.h"
#include "study/plots.h"

#include <math.h>
#include <stdlib.h>

#include "expect.h"
#include "io/survey_file.h"
#include "physics/line_scene.h"

#define SIDE    500.0 /* m, of the simulated forest */
#define STOOLS  20000
#define PLOTS   6
#define SAMPLES 200
#define RADIUS  8.0

static struct line_random state;

struct forest {
    double x[STOOLS], y[STOOLS];
    int shoots[STOOLS];
    double shoots_per_ha, stools_per_ha;
};

static void make_forest(struct forest *f)
{
    double shoots = 0;
    for (size_t i = 0; i < STOOLS; i++) {
        f->x[i] = line_uniform(&state, 0, SIDE);
        f->y[i] = line_uniform(&state, 0, SIDE);
        f->shoots[i] = 1 + (int)line_uniform(&state, 0, 4);
        shoots += f->shoots[i];
    }
    f->stools_per_ha = STOOLS / (SIDE * SIDE) * 10000;
    f->shoots_per_ha = shoots / (SIDE * SIDE) * 10000;
}

/* Sample the stems on plots at random places. */
static size_t sample_plots(const struct forest *f, struct ceduo_survey_stem *stems, size_t *stools)
{
    size_t n = 0;
    *stools = 0;
    for (size_t p = 0; p < PLOTS; p++) {
        double x = line_uniform(&state, RADIUS, SIDE - RADIUS), y = line_uniform(&state, RADIUS, SIDE - RADIUS);
        for (size_t i = 0; i < STOOLS; i++) {
            if (hypot(f->x[i] - x, f->y[i] - y) > RADIUS)
                continue;
            for (int k = 0; k < f->shoots[i]; k++)
                stems[n++] = (struct ceduo_survey_stem){.plot = p,
                                                        .kind = CEDUO_SURVEY_SHOOT,
                                                        .species = 0,
                                                        .stool = *stools,
                                                        .dbh = .06,
                                                        .height = 6,
                                                        .spacing = NAN};
            ++*stools;
        }
    }
    return n;
}

/* The 95 % interval contains the truth in 92 to 97 % of 200 surveys of six plots. */
TEST(intervals_hold_the_truth)
{
    LOCAL_BYTES struct forest *f = calloc(1, sizeof *f);
    LOCAL_BYTES struct ceduo_survey_stem *stems = calloc(100000, sizeof *stems);
    double areas[PLOTS];
    int shoots = 0, stools = 0;
    double mean = 0;
    assert_non_null(f);
    assert_non_null(stems);
    state.state = 20091122;
    make_forest(f);
    for (size_t p = 0; p < PLOTS; p++)
        areas[p] = M_PI * RADIUS * RADIUS;
    for (int i = 0; i < SAMPLES; i++) {
        struct ceduo_survey s = {.plots_count = PLOTS, .areas = areas, .stems = stems};
        LOCAL_BY(ceduo_survey_release) struct ceduo_survey_result a;
        s.stems_count = sample_plots(f, stems, &s.stools_count);
        assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
        const struct ceduo_estimate *n = &a.per_ha[CEDUO_SURVEY_SHOOT];
        shoots += n->lo <= f->shoots_per_ha && f->shoots_per_ha <= n->hi;
        stools += a.stools.lo <= f->stools_per_ha && f->stools_per_ha <= a.stools.hi;
        mean += n->mean / SAMPLES;
    }
    EXPECT(shoots, >=, 0.92 * SAMPLES);
    EXPECT(shoots, <=, 0.97 * SAMPLES);
    EXPECT(stools, >=, 0.92 * SAMPLES);
    EXPECT(stools, <=, 0.97 * SAMPLES);
    EXPECT(fabs(mean / f->shoots_per_ha - 1), <, 0.02); /* 1200 plots of some 43 shoots in clumps: 0.6 % */
}

/* Three plots of 100, 200 and 400 m2 with 2, 2 and 12 trees: 200, 100 and 300 per ha. */
TEST(densities_by_hand)
{
    const double areas[] = {100, 200, 400};
    const size_t count[] = {2, 2, 12};
    struct ceduo_survey_stem stems[16];
    size_t n = 0;
    for (size_t p = 0; p < 3; p++)
        for (size_t i = 0; i < count[p]; i++)
            stems[n++] = (struct ceduo_survey_stem){
                .plot = p, .kind = CEDUO_SURVEY_TREE, .species = -1, .dbh = .12, .height = 9, .spacing = NAN};
    struct ceduo_survey s = {.plots_count = 3, .areas = areas, .stems_count = n, .stems = stems};
    struct ceduo_survey_result a;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    const struct ceduo_estimate *e = &a.per_ha[CEDUO_SURVEY_TREE];
    EXPECT_NEAR(e->mean, 200, 1e-12);
    EXPECT_NEAR(e->se, 100 / sqrt(3), 1e-12);
    EXPECT_NEAR(e->hi - e->mean, .95 / sqrt(2 * .975 * .025) * 100 / sqrt(3), 1e-8); /* Student, 2 degrees of freedom */
    EXPECT_NEAR(e->mean - e->lo, .95 / sqrt(2 * .975 * .025) * 100 / sqrt(3), 1e-8);
    EXPECT_NEAR(a.per_ha[CEDUO_SURVEY_SHOOT].mean, 0, 0);
    EXPECT_NEAR(a.stools.mean, 0, 0);
    assert_int_equal(a.species, -1);
    assert_int_equal(a.classes_count, 1);
    assert_int_equal(a.classes[0].form_factor, 16);
    EXPECT_NEAR(a.classes[0].volume, 0.5 * M_PI / 4 * .12 * .12 * 9, 1e-12);
    ceduo_survey_release(&a);
    s.plots_count = 1;
    s.stems_count = 2;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    EXPECT_NEAR(a.per_ha[CEDUO_SURVEY_TREE].mean, 200, 1e-12);
    assert_true(isnan(a.per_ha[CEDUO_SURVEY_TREE].se));
    ceduo_survey_release(&a);
}

/* 400 m2 along a slope of 40 degrees are 306.418 m2 on the map. */
TEST(slopes_by_hand)
{
    EXPECT_NEAR(ceduo_survey_horizontal(400, 40 * M_PI / 180), 306.418, 5e-4);
    EXPECT_NEAR(ceduo_survey_horizontal(400, 0), 400, 0);
}

TEST(naslund_is_recovered)
{
    enum { N = 400 };
    const struct ceduo_naslund truth = {.a = 1.3, .b = 0.21};
    double dbh[N], height[N], noisy[N];
    struct ceduo_naslund found;
    state.state = 7;
    for (size_t i = 0; i < N; i++) {
        dbh[i] = line_uniform(&state, 0.02, 0.32);
        height[i] = 1.3 + pow(100 * dbh[i] / (truth.a + truth.b * 100 * dbh[i]), 2);
        noisy[i] = height[i] + 0.4 * line_uniform(&state, -sqrt(3), sqrt(3)); /* sd 0.4 m */
        EXPECT_NEAR(ceduo_naslund_height(&truth, dbh[i]), height[i], 1e-12);
    }
    assert_int_equal(ceduo_naslund_fit(N, dbh, height, &found), CEDUO_OK);
    EXPECT_NEAR(found.a, truth.a, 1e-8);
    EXPECT_NEAR(found.b, truth.b, 1e-8);
    EXPECT(found.rmse, <, 1e-8);
    assert_int_equal(ceduo_naslund_fit(5, dbh, height, &found), CEDUO_OK);
    EXPECT_NEAR(found.a, truth.a, 1e-7);
    assert_int_equal(ceduo_naslund_fit(N, dbh, noisy, &found), CEDUO_OK);
    EXPECT_NEAR(found.rmse, 0.4, 0.06);
    for (double d = 0.04; d < 0.32; d += 0.04) /* the mean of 400 heights is known to some 0.03 m */
        EXPECT_NEAR(ceduo_naslund_height(&found, d), ceduo_naslund_height(&truth, d), 0.12);
}

/* Six heights and a curve: the root mean square distance. At least squares the sum does not change with a and b. */
TEST(residual_of_six_heights)
{
    const double dbh[] = {.05, .1, .15, .2, .25, .3}, height[] = {5.2, 7.6, 10.7, 11.4, 12.9, 13.1};
    struct ceduo_naslund c;
    double squares = 0, by_a = 0, by_b = 0;
    assert_int_equal(ceduo_naslund_fit(6, dbh, height, &c), CEDUO_OK);
    for (size_t i = 0; i < 6; i++) {
        double d = 100 * dbh[i], root = d / (c.a + c.b * d), left = height[i] - 1.3 - root * root;
        squares += left * left;
        by_a += left * root * root * root / d;
        by_b += left * root * root * root;
    }
    EXPECT_NEAR(by_a, 0, 1e-6);
    EXPECT_NEAR(by_b, 0, 1e-6);
    EXPECT(squares, >, 0.1);
    EXPECT_NEAR(c.rmse, sqrt(squares / 6), 1e-12);
}

/* No curve: too few heights, a single diameter, or decreasing heights. */
TEST(naslund_is_refused)
{
    const double dbh[] = {.05, .1, .15, .2, .25}, same[] = {.1, .1, .1, .1, .1};
    const double rises[] = {5, 8, 10, 11, 12}, falls[] = {12, 9, 6, 4, 2}, runs_away[] = {1.35, 1.7, 2.65, 4.5, 7.55};
    struct ceduo_naslund curve;
    assert_int_equal(ceduo_naslund_fit(4, dbh, rises, &curve), CEDUO_NO_FIT);
    assert_int_equal(ceduo_naslund_fit(5, same, rises, &curve), CEDUO_NO_FIT);
    assert_int_equal(ceduo_naslund_fit(5, dbh, falls, &curve), CEDUO_NO_FIT);
    assert_int_equal(ceduo_naslund_fit(5, dbh, runs_away, &curve), CEDUO_NO_FIT); /* as d3: b is below 0 */
    assert_int_equal(ceduo_naslund_fit(5, dbh, rises, &curve), CEDUO_OK);
}

/* Tall stems in a column that may hold altitudes: refused, then read as the user answers. */
TEST_WITH(heights_are_asked_about, folder_set_up, folder_tear_down)
{
    char path[256];
    struct survey_answers answers = {0};
    folder_write("plots.csv", "plot,area_m2,kind,dbh,alt\n1,400,tree,60,120\n");
    in_folder(path, "plots.csv");
    for (int answer = 0; answer <= 2; answer++) {
        LOCAL_ARENA(arena);
        LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
        struct survey_file file;
        answers.given[SURVEY_HEIGHTS] = answer;
        EXPECT(ceduo_survey_read(&file, &arena, path, &answers, &problems), ==, answer > 0);
        EXPECT(answers.asked[SURVEY_HEIGHTS], ==, answer == 0);
        if (answer == 1)
            EXPECT_NEAR(file.survey.stems[0].height, 120, 0);
        if (answer == 2)
            assert_true(isnan(file.survey.stems[0].height));
    }
}

static struct ceduo_survey_stem stem(enum ceduo_survey_kind kind, int species, double dbh, double height)
{
    return (struct ceduo_survey_stem){
        .kind = kind, .species = species, .dbh = dbh, .height = height, .spacing = NAN, .energy = NAN};
}

/* Classes of 5 cm, each kind separately, with mean, sd and stem volumes by species. */
TEST(classes_by_hand)
{
    const int cerris = ceduo_species_find("quercus-cerris"), beech = ceduo_species_find("fagus-sylvatica");
    const double area = 100;
    struct ceduo_survey_stem stems[] = {
        stem(CEDUO_SURVEY_STANDARD, cerris, .15, 10), stem(CEDUO_SURVEY_STANDARD, beech, .19, 12),
        stem(CEDUO_SURVEY_TREE, cerris, .16, 11),     stem(CEDUO_SURVEY_SHOOT, beech, .049, 4),
        stem(CEDUO_SURVEY_SHOOT, beech, .03, 3),      stem(CEDUO_SURVEY_STUMP, beech, .4, .2),
        stem(CEDUO_SURVEY_STUMP, -1, 80, NAN)};
    stems[3].stool = stems[4].stool = 0;
    stems[4].spacing = .3;
    stems[5].energy = 3000;
    struct ceduo_survey s = {.plots_count = 1, .areas = &area, .stools_count = 1, .stems_count = 7, .stems = stems};
    LOCAL_BY(ceduo_survey_release) struct ceduo_survey_result a;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    assert_int_equal(a.species, cerris);
    assert_int_equal(a.classes_count, 5);
    const struct ceduo_survey_class *c = a.classes;
    assert_int_equal(c[0].kind, CEDUO_SURVEY_SHOOT);
    assert_int_equal(c[0].stems, 2);
    assert_int_equal(c[0].form_factor, 2);
    assert_int_equal(c[0].form_factor_main, 0);
    EXPECT_NEAR(c[0].height, 3.5, 1e-12);
    assert_int_equal(c[1].kind, CEDUO_SURVEY_STANDARD);
    EXPECT_NEAR(c[1].from, .15, 1e-12);
    EXPECT_NEAR(c[1].per_ha.mean, 200, 1e-9);
    EXPECT_NEAR(c[1].dbh, .17, 1e-12);
    EXPECT_NEAR(c[1].dbh_sd, .04 / sqrt(2), 1e-12);
    /* Tabacchi et al. 2011 */
    double v1 = (-0.043221 + 0.038079 * 225 * 10) / 1000, v2 = (0.81151 + 0.038965 * 361 * 12) / 1000;
    EXPECT_NEAR(c[1].volume, (v1 + v2) / 2, 1e-12);
    assert_int_equal(c[1].form_factor, 0);
    assert_int_equal(c[2].kind, CEDUO_SURVEY_TREE);
    EXPECT_NEAR(c[2].dbh_sd, 0, 0);
    assert_int_equal(c[4].kind, CEDUO_SURVEY_STUMP);
    assert_true(isnan(c[4].volume));
    EXPECT_NEAR(a.stump_height, .2, 1e-12);
    EXPECT_NEAR(a.stump_diameter, 40.2, 1e-12);
    EXPECT_NEAR(a.stump_energy, 3000, 1e-9);
    EXPECT_NEAR(a.spacing.mean, .3, 1e-12);
    EXPECT_NEAR(a.stools.mean, 100, 1e-9);
}

/* Missing heights: from the curve with at least five, otherwise the mean; shoots and trees separately. */
TEST(missing_heights)
{
    const struct ceduo_naslund truth = {.a = 1.1, .b = 0.26};
    const double area = 1000;
    struct ceduo_survey_stem stems[9];
    for (size_t i = 0; i < 6; i++) {
        double dbh = .051 + .007 * (double)i;
        stems[i] = stem(CEDUO_SURVEY_SHOOT, 0, dbh, i == 5 ? NAN : ceduo_naslund_height(&truth, dbh));
        stems[i].stool = i;
    }
    stems[6] = stem(CEDUO_SURVEY_TREE, 0, .2, 12);
    stems[7] = stem(CEDUO_SURVEY_STANDARD, 0, .3, 15);
    stems[8] = stem(CEDUO_SURVEY_TREE, 0, .4, NAN);
    struct ceduo_survey s = {.plots_count = 1, .areas = &area, .stools_count = 6, .stems_count = 9, .stems = stems};
    struct ceduo_survey_result a;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    assert_int_equal(a.shoots.from, CEDUO_SURVEY_HEIGHTS_CURVE);
    assert_int_equal(a.shoots.given, 5);
    assert_int_equal(a.shoots.missing, 1);
    double sum = 0;
    for (size_t i = 0; i < 6; i++)
        sum += ceduo_naslund_height(&truth, stems[i].dbh) / 6;
    EXPECT_NEAR(a.classes[0].height, sum, 1e-7);
    assert_int_equal(a.trees.from, CEDUO_SURVEY_HEIGHTS_MEAN);
    EXPECT_NEAR(a.trees.mean, 13.5, 1e-12);
    EXPECT_NEAR(a.classes[a.classes_count - 1].height, 13.5, 1e-12);
    ceduo_survey_release(&a);
    s.stems_count = 5;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    assert_int_equal(a.shoots.from, CEDUO_SURVEY_HEIGHTS_MEASURED);
    assert_true(isnan(a.trees.mean));
    ceduo_survey_release(&a);
}

/* Change one number of a valid stem at a time. */
TEST(each_bad_stem_is_refused)
{
    size_t species;
    ceduo_species_list(&species);
    const double area = 100;
    const struct ceduo_survey_stem good = stem(CEDUO_SURVEY_TREE, 0, .2, 12);
    struct ceduo_survey_stem bad[] = {good, good, good, good, good};
    bad[0].species = (int)species;
    bad[1].dbh = INFINITY;
    bad[2].plot = 1;
    bad[3].kind = CEDUO_SURVEY_SHOOT; /* there is no stool */
    bad[4].dbh = 0;
    struct ceduo_survey s = {.plots_count = 1, .areas = &area, .stems_count = 1, .stems = &good};
    struct ceduo_survey_result a;
    assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_OK);
    ceduo_survey_release(&a);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        s.stems = &bad[i];
        assert_int_equal(ceduo_survey_compute(&s, &a), CEDUO_BAD_ARGUMENT);
    }
}
