/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The answer for an option over the coming years and today. Years, shares and ranges are made by hand, so that each answer
 * follows from the rule: yes if no year is above the limit, no if one is above it in every plausible case. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "core/runs/run.h"
#include "expect.h"
#include "study/verdict.h"
#include "test.h"
#include "view/report.h"
#include "view/words.h"

static struct ceduo_scene scene;
static struct ceduo_control control;
static struct ceduo_option option;
static struct ceduo_belt belt;
static struct ceduo_size_class blocks;
static struct ceduo_arrivals bare, wooded;
static struct ceduo_stand_result stand;
static struct ceduo_index index_;
static struct ceduo_option_result option_result;
static struct ceduo_alternative_energy other;
static struct ceduo_result result;
static struct ceduo_years_summary years;
static struct ceduo_choice choice;
static struct ceduo_verdict verdict;
static struct ceduo_uncertainty_figure figures[CEDUO_UNCERTAINTY_KINDS];
static struct ceduo_uncertainty_result answer;

static void set_share(struct ceduo_arrivals *a, double share, double lo, double hi)
{
    *a = (struct ceduo_arrivals){.released = 1000,
                                 .reached = 900,
                                 .reach.mean = .9,
                                 .exceed.mean = share,
                                 .exceed.lo = lo,
                                 .exceed.hi = hi,
                                 .limit = .05};
    a->hazard.per_year = NAN;
}

/* Today 31 in 1000 exceed the limit, without forest 300. */
static int open_site(void **state)
{
    (void)state;
    static double volumes[2] = {.1, 1};
    static char name[] = "a";
    control = (struct ceduo_control){.x = 80, .x_given = 80, .accepted = 50e3, .measured_speed = NAN};
    belt = (struct ceduo_belt){.to = 80};
    option = (struct ceduo_option){.name = name, .belts_count = 1, .belts = &belt};
    blocks = (struct ceduo_size_class){.per_year = 2, .volumes_count = 2, .volumes = volumes};
    scene = (struct ceduo_scene){.controls = &control, .controls_count = 1, .options = &option, .options_count = 1};
    scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    set_share(&bare, .3, .28, .32);
    set_share(&wooded, .031, .022, .043);
    stand = (struct ceduo_stand_result){0};
    option_result = (struct ceduo_option_result){

        .stands = &stand,
        .controls = &index_,
        .alternatives = &other,
        .wooded = {.rocks = 1000, .controls = 1, .arrivals = &wooded}};
    result = (struct ceduo_result){.scene = &scene,
                                   .wooded = true,
                                   .bare = {.rocks = 1000, .controls = 1, .arrivals = &bare},
                                   .options_count = 1,
                                   .options = &option_result};
    years =
        (struct ceduo_years_summary){.years = 25, .simulated = 25, .exceed = {.19, .01, 0, 0}, .worst = .489, .worst_year = 1};
    choice = (struct ceduo_choice){
        .summaries = &years, .last_summary = &years, .window = {CEDUO_WINDOW_AHEAD, 1, 25, 1}, .energy_known = true};
    verdict = (struct ceduo_verdict){.wooded = true, .accepted = true, .n = 1, .choices = &choice};
    memset(figures, 0, sizeof figures);
    answer = (struct ceduo_uncertainty_result){.figures = figures, .figures_count = CEDUO_UNCERTAINTY_KINDS, .rotation = true};
    return 0;
}

/* Set the years above the limit: by their shares, and by the ends of their intervals. */
static void set_failing(size_t failing, size_t lo, size_t hi)
{
    years.unprotected_energy = failing;
    years.failing_lo = lo;
    years.failing_hi = hi;
}

static void set_range(enum ceduo_uncertainty_kind kind, double p5, double p95)
{
    figures[kind].fit = (struct ceduo_surface_fit){.p5 = p5, .p95 = p95};
}

static struct ceduo_outcome judge(bool uncertainty)
{
    return ceduo_outcome_compute(&result, &verdict, uncertainty ? &answer : NULL, 0, 0);
}

TEST_WITH(the_years_decide_before_today, open_site, NULL)
{
    set_failing(17, 15, 19);
    struct ceduo_outcome o = judge(false);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_NO), (today, CEDUO_JUDGEMENT_YES));
    set_failing(0, 0, 0);
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_YES);
    set_failing(0, 0, 1); /* sampling error allows one year */
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_NOT_DECIDED);
    set_failing(1, 0, 2);
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_NOT_DECIDED);
    o = ceduo_outcome_compute(&result, NULL, NULL, 0, 0); /* today is all that is known */
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_YES), (over_years, false));
    verdict.n = 0; /* a new option is not in the verdict yet */
    o = judge(false);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_YES), (over_years, false));
    verdict.n = 1;
    choice.window.kind = CEDUO_WINDOW_CONSTANT;
    set_failing(1, 1, 1);
    o = judge(false);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_YES), (over_years, false));
}

TEST_WITH(uncertain_inputs_leave_the_answer_open, open_site, NULL)
{
    const struct {
        size_t failing, lo, hi;
        double p5, p95;
        enum ceduo_judgement answer;
    } rows[] = {{17, 15, 19, 12, 25, CEDUO_JUDGEMENT_NO},      {17, 15, 19, 0, 25, CEDUO_JUDGEMENT_DEPENDS},
                {0, 0, 0, 0, 0, CEDUO_JUDGEMENT_YES},          {0, 0, 0, 0, 12, CEDUO_JUDGEMENT_DEPENDS},
                {4, 2, 6, 0, 12, CEDUO_JUDGEMENT_DEPENDS},     {0, 0, 2, 0, 0, CEDUO_JUDGEMENT_NOT_DECIDED},
                {1, 0, 2, 1, 12, CEDUO_JUDGEMENT_NOT_DECIDED}, {17, 15, 19, NAN, NAN, CEDUO_JUDGEMENT_NO}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        set_failing(rows[i].failing, rows[i].lo, rows[i].hi);
        set_range(CEDUO_UNCERTAINTY_FAILING, rows[i].p5, rows[i].p95);
        struct ceduo_outcome o = judge(true);
        assert_int_equal(o.answer, rows[i].answer);
        EXPECT(o.failing_lo, <=, o.failing);
        EXPECT(o.failing_hi, >=, o.failing);
    }
}

/* Without years today's range decides. */
TEST_WITH(today_may_depend, open_site, NULL)
{
    set_failing(17, 15, 19);
    set_range(CEDUO_UNCERTAINTY_FAILING, 12, 25);
    set_range(CEDUO_UNCERTAINTY_EXCEED, .004, .126);
    struct ceduo_outcome o = judge(true);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_NO), (today, CEDUO_JUDGEMENT_DEPENDS));
    set_range(CEDUO_UNCERTAINTY_EXCEED, .004, .05);
    assert_int_equal(judge(true).today, CEDUO_JUDGEMENT_YES);
}

/* Two blocks a year: one in 100 years above the accepted energy is a share of .005. */
TEST_WITH(blocks_are_judged_by_how_often, open_site, NULL)
{
    scene.blocks = &blocks;
    scene.blocks_count = 1;
    EXPECT_NEAR(ceduo_exceed_limit(&scene, &control), .005, 1e-15);
    control.accepted_return = 250;
    EXPECT_NEAR(ceduo_exceed_limit(&scene, &control), .002, 1e-15);
    control.accepted_return = 100;
    wooded.limit = bare.limit = .005;
    set_failing(25, 25, 25);
    const struct {
        double lo, hi, p5, p95; /* events per year; shares at two released per year */
        enum ceduo_judgement answer;
    } rows[] = {{.005, .01, NAN, NAN, CEDUO_JUDGEMENT_YES},       {.005, .0101, NAN, NAN, CEDUO_JUDGEMENT_NOT_DECIDED},
                {.0101, .02, NAN, NAN, CEDUO_JUDGEMENT_NO},       {.005, .009, .002, .0051, CEDUO_JUDGEMENT_DEPENDS},
                {.005, .009, .002, .005, CEDUO_JUDGEMENT_YES},    {.0101, .02, .0051, .01, CEDUO_JUDGEMENT_NO},
                {.0101, .02, .0049, .01, CEDUO_JUDGEMENT_DEPENDS}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        years.rate = (struct ceduo_estimate){(rows[i].lo + rows[i].hi) / 2, NAN, rows[i].lo, rows[i].hi};
        set_range(CEDUO_UNCERTAINTY_MEAN, rows[i].p5, rows[i].p95);
        assert_int_equal(judge(true).answer, rows[i].answer);
    }
    assert_int_equal(judge(true).answer, CEDUO_JUDGEMENT_DEPENDS);
    answer.rotation = false; /* the range is unknown: the interval of the rate, above the limit, decides */
    assert_int_equal(judge(true).answer, CEDUO_JUDGEMENT_NO);
    result.wooded = false; /* nothing is simulated through the forest */
    set_share(&bare, .001, 0, .002);
    bare.limit = .005;
    struct ceduo_outcome o = ceduo_outcome_compute(&result, NULL, NULL, 0, 0);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_YES), (also_bare, true));
    EXPECT_NAN(o.rate.mean);
}

static void print_answer(struct text *text, size_t at, size_t width)
{
    const struct ceduo_report report = {.result = &result, .verdict = &verdict};
    const struct ceduo_subject subject = ceduo_subject_find(&report, 0, at);
    ceduo_words_answer(text, &subject, width);
}

/* An impossible basal area cannot support a yes; a no stands. */
TEST_WITH(an_impossible_stand_supports_no_yes, open_site, NULL)
{
    LOCAL_TEXT(text);
    stand.warnings = CEDUO_WARNING_BASAL_AREA;
    set_failing(0, 0, 0);
    struct ceduo_outcome o = judge(false);
    EXPECT_IS(o, (answer, CEDUO_JUDGEMENT_CANNOT_JUDGE), (impossible, true));
    print_answer(&text, 0, 200);
    assert_non_null(strstr(text.bytes, "more stems than a forest can hold"));
    set_failing(17, 15, 19);
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_NO);
    stand.warnings = CEDUO_WARNING_THICK;
    set_failing(0, 0, 0);
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_YES);
    stand.warnings = CEDUO_WARNING_BASAL_AREA;
    belt.from = control.x; /* after the control */
    assert_int_equal(judge(false).answer, CEDUO_JUDGEMENT_YES);
}

static void expect_words(size_t at, size_t width, const char *wanted)
{
    LOCAL_TEXT(text);
    print_answer(&text, at, width);
    assert_string_equal(text.bytes, wanted);
}

TEST_WITH(the_answer_names_years_cuts_and_places, open_site, NULL)
{
    set_failing(17, 15, 19);
    expect_words(
        0, 200,
        "✘ NO: in 17 of 25 years more than 50 of 1000 rocks exceed 50 kJ: mean 190, worst 489 in year 1; today 31 (YES)");
    expect_words(0, 80, "✘ NO: in 17 of 25 years more than 50 of 1000 rocks exceed 50 kJ; today 31 (YES)");
    expect_words(0, 78, "✘ NO: in 17 of 25 years more than 50 of 1000 exceed 50 kJ; today 31");
    expect_words(0, 60, "✘ NO: above the limit in 17 of 25 years; today 31 (YES)");
    set_share(&wooded, .47, .44, .5); /* the same answer today */
    expect_words(0, 51, "✘ NO: above the limit in 17 of 25 years; today 470");
    set_share(&wooded, .031, .022, .043);
    expect_words(0, 30, "✘ NO: in 17 of 25 years");
    expect_words(0, 10, "✘ NO");
    choice.cut = 3; /* overdue, and it changes the answer */
    expect_words(0, 120, "✔ YES today; ✘ NO after the cut: 489 of 1000 in year 1, more than 50 of 1000 in 17 of 25 years");
    expect_words(0, 84, "✔ YES today; ✘ NO after the cut: 489 of 1000 in year 1, above 50 in 17 of 25 years");
    expect_words(0, 60, "✔ YES today; ✘ NO after the cut: 489 of 1000 in year 1");
    set_failing(0, 0, 0);
    years.worst = .043;
    expect_words(0, 200, "✔ YES: in every year of 25 at most 43 of 1000 rocks exceed 50 kJ; today 31 (YES)");
    set_share(&bare, .004, .001, .01);
    expect_words(0, 200,
                 "✔ YES, also without forest: 4 of 1000 arrive with more than 50 kJ (at most 50 rocks accepted); 1–10 by "
                 "sampling error");
    struct ceduo_control two[2] = {control, control};
    struct ceduo_arrivals bares[2] = {bare, bare}, woodeds[2] = {wooded, wooded};
    struct ceduo_alternative_energy others[2] = {other, other};
    struct ceduo_index indices[2] = {index_, index_};
    struct ceduo_years_summary aheads[2] = {years, years};
    static char road[] = "road";
    two[1].name = road;
    scene.controls = two;
    scene.controls_count = 2;
    result.bare.arrivals = bares;
    result.bare.controls = 2;
    option_result.wooded.arrivals = woodeds;
    option_result.alternatives = others;
    option_result.controls = indices;
    choice.summaries = aheads;
    result.last_control = 1;
    expect_words(1, 60, "road (80 m): ✔ YES, also without forest: 4 of 1000 > 50 kJ");
    expect_words(1, 55, "road (80 m): ✔ YES, also without forest: 4 of 1000");
    static char lines[] = "ro\nd"; /* as wide as printed */
    two[1].name = lines;
    expect_words(1, 60, "ro\\x0ad (80 m): ✔ YES, also without forest: 4 of 1000");
}
