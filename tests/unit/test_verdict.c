/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Verdict while rocks are simulated: it appears with the first thousand rocks, stays known while figures are refined, and is
 * never reversed once clear. */
#include "core/runs/run.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <poll.h>

#include "model/live.h"
#include "view/page_parts.h"

static struct scene_file file;
static struct live live;

static void open_scene(const char *path)
{
    struct problems problems = {0};
    assert_true(ceduo_scene_load(&file, path, NULL, 0, &problems));
    assert_true(ceduo_live_create(&live, 2));
}

static void close_scene(void)
{
    ceduo_live_free(&live);
    ceduo_scene_release(&file);
}

/* Return the option that is clearly best; SIZE_MAX: none. */
static size_t find_clear_best(const struct ceduo_leader *leader)
{
    return leader->known && leader->rivals == 0 ? leader->best : SIZE_MAX;
}

struct progress {
    bool known;
    size_t best;
    uint64_t rocks; /* when first known */
};

/* Check that a known verdict stays known, and a clear one names the same option. */
static void check_progress(struct progress *w, const struct ceduo_leader *leader, uint64_t rocks)
{
    size_t best = find_clear_best(leader);
    if (w->known)
        assert_true(leader->known);
    else if (leader->known)
        w->rocks = rocks;
    if (best != SIZE_MAX && w->best != SIZE_MAX)
        assert_int_equal(best, w->best);
    w->known = leader->known;
    w->best = best != SIZE_MAX ? best : w->best;
}

static uint64_t min_rocks(void)
{
    uint64_t rocks = UINT64_MAX;
    for (size_t i = 0; i < live.result->options_count; i++)
        if (live.result->options[i].wooded.rocks < rocks)
            rocks = live.result->options[i].wooded.rocks;
    return rocks;
}

static void expect_beaten(const struct ceduo_verdict *v)
{
    assert_true(v->choices[0].beaten && v->choices[1].beaten);
    assert_false(v->choices[2].beaten || v->choices[3].beaten); /* one yields more, the other one protects better */
}

TEST(a_clear_verdict_stays)
{
    struct progress today = {.best = SIZE_MAX}, rotation = {.best = SIZE_MAX};
    size_t updates = 0, shares = 0;
    open_scene("profiles/scenes/rotation.yaml");
    ceduo_live_update(&live, &file, 1, 0, 0);
    while (live.busy) {
        struct pollfd fd = {.fd = ceduo_jobs_fd(live.jobs), .events = POLLIN};
        poll(&fd, 1, 1000);
        if (!ceduo_live_poll(&live, &file.scene) || !live.result)
            continue;
        size_t known = 0;
        for (size_t i = 0; i < live.verdict.n; i++)
            known += isnan(live.verdict.choices[i].mean.mean) ? 0 : 1;
        assert_true(known >= shares); /* no share becomes unknown again */
        shares = known;
        check_progress(&today, &live.verdict.today, min_rocks());
        check_progress(&rotation, &live.verdict.rotation, live.results.years ? live.results.years->rocks : 0);
        updates++;
    }
    assert_true(today.known && rotation.known);
    EXPECT(today.rocks, ==, RUNS_FIRST); /* known with the first thousand rocks */
    EXPECT(rotation.rocks, <=, 10 * RUNS_FIRST);
    EXPECT(today.best, ==, 3);    /* option 3, large reserves, is best */
    EXPECT(rotation.best, ==, 3); /* today and over the rotation */
    EXPECT(updates, >, 6);        /* progress is shown */
    EXPECT(live.results.years->done, ==, 4);
    expect_beaten(&live.verdict);
    close_scene();
}

/* After an edit of one stand the years of other options stay, and the years of the old stand do not count. */
TEST(an_edit_requests_only_its_years)
{
    open_scene("profiles/scenes/rotation.yaml");
    file.scene.options_count = 2;
    ceduo_live_update(&live, &file, 0, 0, 0);
    ceduo_jobs_wait(live.jobs, true);
    ceduo_live_poll(&live, &file.scene);
    assert_true(live.verdict.rotation.known);
    struct ceduo_belt *belt = &file.scene.options[1].belts[0];
    double before = live.verdict.choices[1].mean.mean;
    belt->stand.cutting.stay_per_ha[1] *= 4;
    ceduo_live_update(&live, &file, 0, 0, 0);
    EXPECT(live.verdict.choices[0].mean.mean, >, 0);
    assert_true(isnan(live.verdict.choices[1].mean.mean)); /* not the mean of the old stand */
    assert_false(live.verdict.rotation.known);
    ceduo_jobs_wait(live.jobs, true);
    ceduo_live_poll(&live, &file.scene);
    assert_true(live.verdict.rotation.known);
    EXPECT(live.verdict.choices[1].mean.mean, <, before); /* four times the trees of the second oldest class */
    close_scene();
}

static void update_and_wait(void)
{
    ceduo_live_update(&live, &file, 0, 0, 0);
    ceduo_jobs_wait(live.jobs, true);
    ceduo_live_poll(&live, &file.scene);
}

/* After an edit of the energy law, figures of the alternative law become those of the scene's law, and no longer count as the
 * alternative. */
TEST(an_edit_of_the_law_keeps_no_alternative)
{
    open_scene("profiles/scenes/paper-site.yaml");
    update_and_wait();
    const struct ceduo_alternative_energy *other = &live.result->options[0].alternatives[0];
    assert_true(other->known);
    EXPECT(other->model, ==, CEDUO_ENERGY_MODEL_DORREN);
    for (size_t i = 0; i < file.scene.options[0].belts_count; i++)
        file.scene.options[0].belts[i].stand.energy = CEDUO_ENERGY_MODEL_DORREN;
    ceduo_live_update(&live, &file, 0, 0, 0);
    assert_false(live.result->options[0].alternatives[0].known);
    update_and_wait();
    other = &live.result->options[0].alternatives[0];
    assert_true(other->known);
    EXPECT(other->model, ==, CEDUO_ENERGY_MODEL_BRAUNER);
    close_scene();
}

/* After an edit of the contact model, years of rocks among stems do not count for the index. */
TEST(an_edit_of_the_contact_model_keeps_no_years)
{
    open_scene("profiles/scenes/paper-site.yaml");
    update_and_wait();
    EXPECT(live.verdict.choices[0].mean.mean, >, 0);
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    ceduo_live_update(&live, &file, 0, 0, 0);
    EXPECT(live.verdict.choices[0].last_summary->years, ==, 0);
    update_and_wait();
    EXPECT(live.verdict.choices[0].last_summary->years, >, 0);
    EXPECT(live.verdict.choices[0].last_summary->simulated, ==, 0);
    EXPECT_NAN(live.verdict.choices[0].mean.mean);
    close_scene();
}

/* ---- invented results ---- */

#define OPTIONS 3
#define ROCKS   1000

/* Options with the first option's forest and invented results. Contains pointers into itself. */
struct made_results {
    struct ceduo_option options[OPTIONS];
    struct ceduo_arrivals bare, wooded[OPTIONS];
    struct ceduo_difference differences[OPTIONS];
    struct ceduo_alternative_energy alternatives[OPTIONS];
    struct ceduo_option_result found[OPTIONS];
    struct ceduo_stand_result stands[2]; /* for the belts of each option */
    struct ceduo_result result;
    struct ceduo_year year[OPTIONS];
    struct ceduo_index index;
    uint16_t marks[OPTIONS][ROCKS];
    struct ceduo_years years[OPTIONS], *year_pointers[OPTIONS];
};

static struct made_results made;

/* Make equal results: half of the rocks exceed the limit, today, under the other law and in the one year. */
static void make_equal_results(void)
{
    made = (struct made_results){.bare = {.released = ROCKS, .reached = ROCKS, .reach.mean = 1, .exceed.mean = 1}};
    made.result = (struct ceduo_result){.scene = &file.scene,
                                        .wooded = true,
                                        .bare = {.rocks = ROCKS, .controls = 1, .arrivals = &made.bare},
                                        .options_count = OPTIONS,
                                        .options = made.found};
    for (size_t i = 0; i < OPTIONS; i++) {
        made.options[i] = file.scene.options[0];
        made.wooded[i] = (struct ceduo_arrivals){
            .released = ROCKS, .reached = ROCKS / 2, .reach.mean = .5, .exceed.mean = .5, .hazard = {.per_year = NAN}};
        made.differences[i] = ceduo_difference_zero(50e3);
        made.alternatives[i] =
            (struct ceduo_alternative_energy){.known = true, .stems = true, .to_first = ceduo_difference_zero(50e3)};
        made.found[i] = (struct ceduo_option_result){.wooded = {.rocks = ROCKS, .controls = 1, .arrivals = &made.wooded[i]},
                                                     .stands = made.stands,
                                                     .differences = &made.differences[i],
                                                     .alternatives = &made.alternatives[i]};
        made.year[i] = (struct ceduo_year){.controls = &made.index, .wooded = made.found[i].wooded};
        for (size_t r = 0; r < ROCKS; r++)
            made.marks[i][r] = r % 2;
        made.years[i] = (struct ceduo_years){
            .scene = file.scene, .window.step = 1, .count = 1, .years = &made.year[i], .rocks = ROCKS, .marks = made.marks[i]};
        made.year_pointers[i] = &made.years[i];
    }
    file.scene.options = made.options;
    file.scene.options_count = OPTIONS;
    made.index.contact = CEDUO_LIGHT_FAIL;
}

static struct ceduo_verdict make_verdict(struct ceduo_years *const *years)
{
    struct ceduo_verdict v;
    EXPECT(ceduo_compare_options(&made.result, years, NULL, &v), ==, CEDUO_OK);
    return v;
}

static struct scene_file original;

static int open_results(void **state)
{
    (void)state;
    struct problems problems = {0};
    assert_true(ceduo_scene_load(&file, "profiles/scenes/rotation.yaml", NULL, 0, &problems));
    EXPECT(file.scene.controls_count, ==, 1);
    original = file;
    make_equal_results();
    return 0;
}

static int close_results(void **state)
{
    (void)state;
    ceduo_scene_release(&original);
    return 0;
}

/* Half-width of a share: by the normal distribution; by Wilson's interval z²/(n + z²) if it is 0; by its own interval with
 * weighted rocks. */
TEST(half_width_of_a_share)
{
    const double z = 1.959963984540054;
    struct ceduo_arrivals a = {.released = 400, .reach.mean = .5, .exceed.mean = .2, .hazard = {.per_year = NAN}};
    EXPECT_NEAR(ceduo_share_judged(&a).mean, .2, 0);
    EXPECT_NEAR(ceduo_share_judged(&a).half, z * .02, 1e-12); /* sqrt(.2·.8/400) */
    a.exceed.mean = 0;
    EXPECT_NEAR(ceduo_share_judged(&a).half, z * z / (400 + z * z), 1e-12);
    a.hazard.per_year = 3;
    a.exceed.lo = .01, a.exceed.hi = .05, a.reach.lo = .4, a.reach.hi = .5;
    EXPECT_NEAR(ceduo_share_judged(&a).half, .02, 1e-12);
    a.exceed.mean = NAN;
    EXPECT_NEAR(ceduo_share_judged(&a).mean, .5, 0);
    EXPECT_NEAR(ceduo_share_judged(&a).half, .05, 1e-12);
}

/* The first of two equal options is best; the other is a rival, and equal. */
TEST_WITH(the_first_of_two_equal_options_is_best, open_results, close_results)
{
    for (size_t i = 1; i < OPTIONS; i++)
        made.differences[i].exceed = (struct ceduo_estimate){-.2, .01, NAN, NAN};
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v = make_verdict(NULL);
    EXPECT(v.today.best, ==, 1);
    EXPECT(v.today.rivals, ==, 1);
    assert_true(v.today.rival[2] && v.today.equal);
}

/* The ranking is reversed if the difference exceeds 3 errors under one law, and 1 error in the opposite direction under the
 * other. */
TEST_WITH(a_ranking_is_reversed_by_more_than_an_error, open_results, close_results)
{
    static const struct {
        double today, other; /* difference in errors: option 1 worse today, better under the other law */
        size_t reversed;
        enum ceduo_energy_model law; /* the other law of option 1; laws that differ are not compared */
    } cases[] = {{4, .5, 0, CEDUO_ENERGY_MODEL_BRAUNER},    {.5, 4, 0, CEDUO_ENERGY_MODEL_BRAUNER},
                 {4, 1.5, 1, CEDUO_ENERGY_MODEL_BRAUNER},   {1.5, 4, 1, CEDUO_ENERGY_MODEL_BRAUNER},
                 {2.5, 2.5, 0, CEDUO_ENERGY_MODEL_BRAUNER}, {4, -4, 0, CEDUO_ENERGY_MODEL_BRAUNER},
                 {4, 1.5, 0, CEDUO_ENERGY_MODEL_DORREN}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        made.differences[1].exceed = (struct ceduo_estimate){cases[i].today * .01, .01, NAN, NAN};
        made.alternatives[1].to_first.exceed = (struct ceduo_estimate){-cases[i].other * .01, .01, NAN, NAN};
        made.alternatives[0].model = CEDUO_ENERGY_MODEL_BRAUNER;
        made.alternatives[1].model = cases[i].law;
        made.differences[2].exceed = made.alternatives[2].to_first.exceed = (struct ceduo_estimate){9, .01, NAN, NAN};
        LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v = make_verdict(NULL);
        EXPECT(v.reversals_count, ==, cases[i].reversed);
        if (v.reversals_count > 0)
            assert_true(v.reversals[0].better == 0 && v.reversals[0].worse == 1);
    }
}

/* The cut that is due is the first of all belts. */
TEST_WITH(the_next_cut_is_the_first_of_all_belts, open_results, close_results)
{
    const struct ceduo_belt belt = made.options[1].belts[0];
    struct ceduo_belt two[2] = {belt, belt};
    two[0].cut_year = 3;
    two[1].cut_year = 2;
    made.options[1].belts = two;
    made.options[1].belts_count = 2;
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v = make_verdict(NULL);
    EXPECT(v.choices[0].cut, ==, 1);
    EXPECT(v.choices[1].cut, ==, 2);
}

/* With equal yields, 500 of 1000 rocks through the first option are clearly more than 300; 305 are not. If all options let the
 * same number through, none is beaten. */
TEST_WITH(beaten_by_an_option_of_equal_yield, open_results, close_results)
{
    struct ceduo_verdict v = make_verdict(made.year_pointers);
    EXPECT(v.choices[0].yield.cut_per_year, >, 0);
    assert_false(v.choices[0].beaten || v.choices[1].beaten || v.choices[2].beaten);
    ceduo_verdict_release(&v);
    for (size_t r = 0; r < ROCKS; r++) {
        made.marks[1][r] = r % 1000 >= 700;
        made.marks[2][r] = r % 1000 < 305;
    }
    v = make_verdict(made.year_pointers);
    assert_true(v.choices[0].beaten);
    assert_false(v.choices[1].beaten || v.choices[2].beaten);
    ceduo_verdict_release(&v);
}

/* Return how often the pane of options prints "worst": above the column of the worst year, and after an option. */
static int count_worst(const struct ceduo_verdict *v)
{
    const struct ceduo_report report = {.file = &file, .result = &made.result, .verdict = v, .years_ahead = made.year_pointers};
    LOCAL_BY(ceduo_page_free) struct ceduo_page page = {.width = 120};
    LOCAL_TEXT(text);
    int n = 0;
    ceduo_page_options(&page, &report, CEDUO_OPTIONS_PANE, made.result.last_control, 0, 0, OPTIONS);
    ceduo_page_print(&text, &page, false);
    for (const char *p = ceduo_text_string(&text); (p = strstr(p, "worst")); p++)
        n++;
    return n;
}

/* An option is the worst if its interval lies above all others, not if it is only the larger of two that overlap. */
TEST_WITH(the_worst_exceeds_all_others, open_results, close_results)
{
    static const struct {
        double mean[OPTIONS], half[OPTIONS];
        int worst;
    } cases[] = {{{.3, .1, .5}, {.05, .02, .05}, 1},
                 {{.44, .1, .5}, {.05, .02, .05}, 0},
                 {{.3, .1, .29}, {.02, .02, .02}, 0},
                 {{.39, .1, .5}, {.05, .02, .05}, 1},
                 {{.9, .1, .5}, {.05, .02, .05}, 1}};
    struct ceduo_verdict v = make_verdict(made.year_pointers);
    for (size_t i = 0; i < OPTIONS; i++)
        made.found[i].controls = &made.index;
    v.rotation = (struct ceduo_leader){.known = true, .best = 1, .rival = v.rotation.rival};
    for (size_t c = 0; c < LENGTH(cases); c++) {
        for (size_t i = 0; i < OPTIONS; i++)
            v.choices[i].mean = (struct ceduo_mean_share){cases[c].mean[i], cases[c].half[i]};
        assert_int_equal(count_worst(&v), 1 + cases[c].worst);
    }
    ceduo_verdict_release(&v);
}
