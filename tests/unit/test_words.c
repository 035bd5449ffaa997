/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sentences about figures: a rounded interval still contains the original, and an option is best only if it leads by more than
 * three standard errors. */
#include "core/runs/result.h"
#include "local.h"
#include "table.h"

#include <math.h>
#include <string.h>

#include "base/utf8.h"
#include "physics/line_scene.h"
#include "view/page_parts.h"
#include "view/report.h"
#include "view/words.h"

#define OPTIONS 3

/* n digits, without an exponent below 1e8; with one above, or if more than 6 decimals would be needed. */
TEST(numbers_are_shown_with_their_digits)
{
    for (TABLE(row, "unit/texts.txt", "digits"))
        assert_string_equal(SIG(strtod(row.at[0], NULL), atoi(row.at[1])), row.at[2]);
}

/* A figure near its limit is printed on the side on which it was judged; others have the usual digits. */
TEST(figures_lie_on_their_side_of_a_limit)
{
    for (TABLE(row, "unit/words.txt", "near a limit"))
        assert_string_equal(VS_LIMIT(strtod(row.at[0], NULL), 3, strtod(row.at[1], NULL)), row.at[2]);
    for (TABLE(row, "unit/words.txt", "percent near 10"))
        assert_string_equal(PERCENT_VS_LIMIT(strtod(row.at[0], NULL), .1), row.at[1]);
}

/* A share's estimate may lie below 0 or above 1; the printed one is clamped. */
TEST(shares_are_shown_between_0_and_1)
{
    struct ceduo_share totals[] = {{.value = -.02}, {.value = .37}, {.value = 1.04}};
    const double shown[] = {0, .37, 1};
    const struct ceduo_uncertainty_figure figure = {.fit = {.total = totals}};
    for (size_t g = 0; g < LENGTH(shown); g++)
        EXPECT(ceduo_uncertainty_share(&figure, g), ==, shown[g]);
}

/* Judged figures: kJ with three digits, whole numbers per 1000 released. */
TEST(judged_values_have_their_digits)
{
    static const struct {
        enum ceduo_uncertainty_kind kind;
        double value;
        const char *shown;
    } rows[] = {{CEDUO_UNCERTAINTY_ENERGY, 12345, "12.3"},
                {CEDUO_UNCERTAINTY_EXCEED, .4567, "457"},
                {CEDUO_UNCERTAINTY_REACH, .1234, "123"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_TEXT(text);
        ceduo_uncertainty_value(&text, rows[i].kind, rows[i].value);
        assert_string_equal(ceduo_text_string(&text), rows[i].shown);
    }
}

/* Three options without stems, whose figures and errors of the differences to the first are set by a test. */
static struct line_scene scene;
static struct ceduo_option options[OPTIONS];
static struct ceduo_arrivals arrivals[OPTIONS];
static struct ceduo_difference differences[OPTIONS];

static void open_scene(double accepted)
{
    static char names[OPTIONS][2] = {"a", "b", "c"};
    static const double x[] = {0, 100}, z[] = {0, -50};
    line_scene_init(&scene, 2, x, z, (struct line_ground){.3, .8, .5}, .5, CEDUO_LAW_LUMPED);
    scene.control = (struct ceduo_control){.x = 80, .x_given = 80, .accepted = accepted, .measured_speed = NAN};
    scene.scene.controls_count = 1;
    scene.scene.options = options;
    scene.scene.options_count = OPTIONS;
    memset(arrivals, 0, sizeof arrivals);
    memset(differences, 0, sizeof differences);
    for (int i = 0; i < OPTIONS; i++) {
        options[i] = (struct ceduo_option){.name = names[i]};
        arrivals[i].released = arrivals[i].reached = 1000;
        arrivals[i].reach.mean = 1;
        arrivals[i].exceed.mean = isnan(accepted) ? NAN : .5;
        arrivals[i].limit = CEDUO_EXCEED_MAX;
    }
}

static struct ceduo_result *assess(void)
{
    struct ceduo_simulated flown[OPTIONS];
    const struct ceduo_simulated *wooded[OPTIONS];
    struct ceduo_result *result;
    for (int i = 0; i < OPTIONS; i++) {
        flown[i] = (struct ceduo_simulated){.rocks = 1000, .controls = 1, .arrivals = &arrivals[i]};
        wooded[i] = &flown[i];
    }
    struct ceduo_arrivals more = arrivals[0]; /* without forest half of them have too much energy */
    more.exceed.mean = more.exceed.lo = more.exceed.hi = isnan(scene.control.accepted) ? NAN : .5;
    const struct ceduo_simulated bare = {.rocks = 1000, .controls = 1, .arrivals = &more};
    assert_int_equal(ceduo_result_assess(&scene.scene, &bare, wooded, differences, NULL, &result), CEDUO_OK);
    return result;
}

/* The figures by the other law may arrive before those of the scene's own, for all options or for some. */
TEST(the_other_law_is_compared_with_what_is_known)
{
    struct ceduo_alternative_energy others[OPTIONS];
    for (int known = 0; known <= OPTIONS; known++) {
        open_scene(50e3);
        memset(others, 0, sizeof others);
        struct ceduo_simulated simulated[OPTIONS];
        const struct ceduo_simulated *wooded[OPTIONS];
        for (int i = 0; i < OPTIONS; i++) {
            others[i] = (struct ceduo_alternative_energy){.known = true, .stems = true, .model = CEDUO_ENERGY_MODEL_DORREN};
            simulated[i] = (struct ceduo_simulated){.rocks = i < known ? 1000 : 0, .controls = 1, .arrivals = &arrivals[i]};
            wooded[i] = &simulated[i];
        }
        struct ceduo_simulated bare = {.rocks = 1000, .controls = 1, .arrivals = &arrivals[0]};
        struct ceduo_result *result;
        assert_int_equal(ceduo_result_assess(&scene.scene, &bare, wooded, differences, others, &result), CEDUO_OK);
        LOCAL_BY(ceduo_page_free) struct ceduo_page page = {.width = 80};
        LOCAL_TEXT(text);
        ceduo_page_laws(&page, &(struct ceduo_report){.result = result});
        ceduo_page_print(&text, &page, true);
        int rows = 0;
        for (const char *p = ceduo_text_string(&text); (p = strstr(p, "dorren")); p++)
            rows++;
        EXPECT(rows, ==, known);
        ceduo_result_free(result);
    }
}

/* A clear yes under one law and a clear no under the other: it depends, whichever is the scene's own. Otherwise both answers
 * are shown. */
TEST(an_answer_depends_where_the_laws_differ)
{
    static const double yes[] = {.01, 0, .02}, no[] = {.2, .15, .25}, open[] = {.05, .03, .07};
    static const struct {
        const double *own, *other;
        enum ceduo_judgement judged;
    } cases[] = {{yes, yes, CEDUO_JUDGEMENT_YES},          {yes, no, CEDUO_JUDGEMENT_DEPENDS},
                 {no, yes, CEDUO_JUDGEMENT_DEPENDS},       {no, no, CEDUO_JUDGEMENT_NO},
                 {open, yes, CEDUO_JUDGEMENT_YES},         {open, no, CEDUO_JUDGEMENT_NO},
                 {yes, open, CEDUO_JUDGEMENT_NOT_DECIDED}, {no, open, CEDUO_JUDGEMENT_NOT_DECIDED}};
    for (size_t i = 0; i < LENGTH(cases); i++) {
        struct ceduo_alternative_energy others[OPTIONS] = {0};
        struct ceduo_simulated simulated[OPTIONS];
        const struct ceduo_simulated *wooded[OPTIONS];
        struct ceduo_result *result;
        open_scene(50e3);
        for (int k = 0; k < OPTIONS; k++) {
            const double *own = cases[i].own, *other = cases[i].other;
            others[k] = (struct ceduo_alternative_energy){.known = true, .stems = true, .arrivals = arrivals[k]};
            arrivals[k].exceed.mean = own[0], arrivals[k].exceed.lo = own[1], arrivals[k].exceed.hi = own[2];
            others[k].arrivals.exceed.mean = other[0];
            others[k].arrivals.exceed.lo = other[1], others[k].arrivals.exceed.hi = other[2];
            simulated[k] = (struct ceduo_simulated){.rocks = 1000, .controls = 1, .arrivals = &arrivals[k]};
            wooded[k] = &simulated[k];
        }
        const struct ceduo_simulated bare = {.rocks = 1000, .controls = 1, .arrivals = &arrivals[0]};
        assert_int_equal(ceduo_result_assess(&scene.scene, &bare, wooded, differences, others, &result), CEDUO_OK);
        EXPECT(result->options[1].alternatives[0].judgement, ==, cases[i].judged);
        ceduo_result_free(result);
    }
}

/* ---- intervals ---- */

static void expect_sentence(double share, double lo, double hi, const char *wanted)
{
    LOCAL_TEXT(text);
    open_scene(50e3);
    arrivals[0].exceed.mean = share;
    arrivals[0].exceed.lo = lo;
    arrivals[0].exceed.hi = hi;
    LOCAL(ceduo_result, result) = assess();
    ceduo_words_test(&text, result, 0, 0, 2);
    if (!strstr(text.bytes, wanted))
        fail_msg("'%s' is missing in: %s", wanted, text.bytes);
}

/* Per 1000 the lower end is rounded down and the upper one up; whole numbers stay. */
TEST(an_interval_is_rounded_outward)
{
    for (TABLE(row, "unit/words.txt", "intervals"))
        expect_sentence(atof(row.at[0]), atof(row.at[1]), atof(row.at[2]), row.at[3]);
}

/* ---- one-line answer ---- */

/* Set the share of rocks through the forest of option a that exceed the limit, and its 90 % range; NaN: uncertainty not
 * computed. Expect this answer. */
static void expect_answer(double share, double p5, double p95, size_t width, const char *wanted)
{
    LOCAL_TEXT(text);
    struct ceduo_uncertainty_figure figures[(2 * OPTIONS - 1) * CEDUO_UNCERTAINTY_KINDS] = {0};
    struct ceduo_uncertainty_result answer = {.figures = figures, .figures_count = sizeof figures / sizeof figures[0]};
    struct scene_file file = {.scene = scene.scene};
    const struct ceduo_uncertainty_report uncertainty = {.file = &file, .answer = isnan(p5) ? NULL : &answer};
    for (size_t i = 0; i < answer.figures_count; i++)
        figures[i].fit = (struct ceduo_surface_fit){.p5 = p5, .p95 = p95};
    *(isnan(scene.control.accepted) ? &arrivals[0].reach.mean : &arrivals[0].exceed.mean) = share;
    arrivals[0].reach.lo = arrivals[0].exceed.lo = fmax(0, share - .01);
    arrivals[0].reach.hi = arrivals[0].exceed.hi = share + .01;
    LOCAL(ceduo_result, result) = assess();
    const struct ceduo_report report = {.result = result, .uncertainty = &uncertainty};
    const struct ceduo_subject subject = ceduo_subject_find(&report, 0, 0);
    ceduo_words_answer(&text, &subject, width);
    assert_string_equal(ceduo_text_string(&text), wanted);
}

/* In a narrower page whole clauses are dropped: the accepted energy, then the uncertainty, finally all but the verdict. */
TEST(an_answer_is_shortened_by_whole_clauses)
{
    static const char *const shorter[] = {
        "✘ NO: 479 of 1000 arrive with more than 50 kJ (at most 50 rocks accepted); range 234–748",
        "✘ NO: 479 of 1000 arrive with more than 50 kJ; range 234–748",
        "✘ NO: 479 of 1000 > 50 kJ; range 234–748",
        "✘ NO: 479 of 1000 > 50 kJ",
        "✘ NO: 479 of 1000",
        "✘ NO"};
    size_t form = 0, forms = sizeof shorter / sizeof shorter[0];
    open_scene(50e3);
    for (size_t width = 200; width > 0; width--) {
        while (form + 1 < forms && (size_t)ceduo_utf8_width(shorter[form]) > width)
            form++;
        expect_answer(.479, .234, .748, width, shorter[form]);
    }
}

/* 50 in 1000 are accepted: sampling error or uncertain inputs may include that limit. */
TEST(an_answer_depends_where_uncertainty_holds_the_limit)
{
    for (TABLE(row, "unit/words.txt", "answers")) {
        open_scene(strtod(row.at[0], NULL));
        expect_answer(atof(row.at[1]), strtod(row.at[2], NULL), strtod(row.at[3], NULL), (size_t)atoi(row.at[4]), row.at[5]);
    }
}

/* ---- best option ---- */

static void expect_best(const char *wanted)
{
    LOCAL_TEXT(text);
    LOCAL(ceduo_result, result) = assess();
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict verdict;
    assert_int_equal(ceduo_compare_options(result, NULL, NULL, &verdict), CEDUO_OK);
    ceduo_words_best(&text, result->scene, &verdict);
    assert_string_equal(ceduo_text_string(&text), wanted);
}

/* Set a share per 1000 with too much energy, or without an accepted energy of arrivals; and the error of its difference to the
 * first. */
static void set(size_t option, bool accepted, double share, double se)
{
    *(accepted ? &arrivals[option].exceed.mean : &arrivals[option].reach.mean) = share;
    struct ceduo_estimate *d = accepted ? &differences[option].exceed : &differences[option].reach;
    double first = accepted ? arrivals[0].exceed.mean : arrivals[0].reach.mean;
    *d = (struct ceduo_estimate){share - first, se, NAN, NAN};
}

/* All shares and errors are multiples of one power of two, so that there is no rounding. Errors of 3 and 4 to the first give 5
 * between the two: a difference of 15 is not clear, and the next double is. */
TEST(three_standard_errors_apart_is_not_clear)
{
    const double unit = 1. / 128;
    open_scene(50e3);
    EXPECT(hypot(3 * unit, 4 * unit), ==, 5 * unit);
    set(0, true, .5, 0);
    set(1, true, .25, 3 * unit);
    set(2, true, .25 + 15 * unit, 4 * unit);
    expect_best("Today 'b' and 'c' let the fewest dangerous rocks through and cannot be told apart: 250 and 367 of 1000.");
    set(2, true, nextafter(.25 + 15 * unit, 1), 4 * unit);
    expect_best("Today 'b' lets the fewest dangerous rocks through: 250 of 1000.");
    set(0, true, .25 + 9 * unit, 0);
    set(1, true, .25, 3 * unit);
    set(2, true, .5, 4 * unit);
    expect_best("Today 'a' and 'b' let the fewest dangerous rocks through and cannot be told apart: 320 and 250 of 1000.");
    set(2, true, .25 + 9 * unit, 4 * unit);
    expect_best("Today no option is clearly better than the others.");
}

/* Without an accepted energy there is no danger, and energies decide nothing. */
TEST(without_a_limit_there_is_no_judgement)
{
    open_scene(NAN);
    arrivals[1].energy_per_released.mean = -1000;
    set(0, false, .5, 0);
    set(1, false, .75, .015625);
    set(2, false, .25, .015625);
    expect_best("Today 'c' lets the fewest rocks through: 250 of 1000.");
}

/* A figure unknown for one option is unknown for all. */
TEST(unknown_is_never_best)
{
    open_scene(50e3);
    set(0, true, .5, 0);
    set(1, true, .25, .015625);
    differences[2].exceed = CEDUO_NO_ESTIMATE;
    expect_best("");
}

/* ---- over the years ---- */

static struct ceduo_choice choices[OPTIONS];
static bool rivals[2][OPTIONS];
static struct ceduo_verdict made;

static void make_verdict(const double mean[OPTIONS], const double today[OPTIONS], size_t best, size_t best_today)
{
    static const struct ceduo_years_summary over = {.years = 25, .simulated = 25};
    open_scene(50e3);
    memset(rivals, 0, sizeof rivals);
    made = (struct ceduo_verdict){.wooded = true,
                                  .accepted = true,
                                  .n = OPTIONS,
                                  .choices = choices,
                                  .today = {.known = true, .best = best_today, .rival = rivals[0]},
                                  .rotation = {.known = true, .best = best, .rival = rivals[1]}};
    for (size_t i = 0; i < OPTIONS; i++)
        choices[i] = (struct ceduo_choice){
            .mean = {mean[i], .01}, .today = {today[i], .01}, .last_summary = &over, .window = {CEDUO_WINDOW_AHEAD, 1, 25, 1}};
}

static void expect_made(const char *wanted)
{
    LOCAL_TEXT(text);
    ceduo_words_best(&text, &scene.scene, &made);
    assert_string_equal(ceduo_text_string(&text), wanted);
}

TEST(a_sentence_for_the_years_and_one_for_today)
{
    static const double mean[OPTIONS] = {.564, .352, .277}, today[OPTIONS] = {.127, .28, .224};
    make_verdict(mean, today, 2, 0);
    expect_made("In years 1 to 25 'c' lets the fewest dangerous rocks through: 277 of 1000.\n"
                "Today 'a' lets the fewest dangerous rocks through: 127 of 1000.");
    make_verdict(mean, mean, 2, 2);
    expect_made("In years 1 to 25 'c' lets the fewest dangerous rocks through, as it does today: 277 and 277 of 1000.");
    rivals[1][1] = true;
    made.rotation.rivals = 1;
    expect_made("In years 1 to 25 'b' and 'c' let the fewest dangerous rocks through and cannot be told apart: 352 and "
                "277 of 1000.\nToday 'c' lets the fewest dangerous rocks through: 277 of 1000.");
    made.rotation.known = false; /* not computed yet */
    expect_made("Today 'c' lets the fewest dangerous rocks through: 277 of 1000.");
    make_verdict(mean, today, 2, 0);
    for (size_t i = 0; i < OPTIONS; i++)
        choices[i].window.kind = CEDUO_WINDOW_CONSTANT; /* every year is as today */
    expect_made("Today 'a' lets the fewest dangerous rocks through: 127 of 1000.");
}

static void add_line(void *context, const char *sentence)
{
    ceduo_text_format(context, "%s\n", sentence);
}

TEST(reasons_for_no_rotation)
{
    static struct ceduo_stems trees = {.per_ha = 100, .dbh = .2, .height = 10};
    static char name[] = "old stand";
    static struct ceduo_belt belts[2] = {{.to = 10, .name = name, .stand = {.trees = &trees, .trees_count = 1}}};
    LOCAL_TEXT(text);
    open_scene(50e3);
    belts[1] = belts[0];
    belts[0].cut_year = belts[1].cut_year = INFINITY;
    belts[1].stand.growth.trees = (struct ceduo_curve){.5, .02, 20, .03};
    options[1].belts = &belts[0];
    options[2].belts = &belts[1];
    options[1].belts_count = options[2].belts_count = 1;
    ceduo_words_windows(&scene.scene, add_line, &text);
    assert_string_equal(ceduo_text_string(&text), "'a' does not change: it has no stems.\n"
                                                  "'b' does not change: stand 'old stand' has no growth and cutting data.\n"
                                                  "'c' grows and is never cut.\n");
    ceduo_text_free(&text);
    belts[0].stand.cutting.rotation = 25;
    ceduo_words_window(&text, &options[1]);
    assert_string_equal(ceduo_text_string(&text), "'b' does not change: stand 'old stand' has no growth data for its stems.");
}
