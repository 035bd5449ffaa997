/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* The live verdict: it comes with the first thousand rocks, what is known stays known while figures become finer, and
 * what was clear is not taken back. */
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

/* The option that is clearly best: SIZE_MAX where none is. */
static size_t clear_best(const struct ceduo_leader *leader)
{
    return leader->known && leader->rivals == 0 ? leader->best : SIZE_MAX;
}

struct watch {
    bool known;
    size_t best;
    uint64_t rocks; /* of the first sentence */
};

/* Once known it stays known; once clear it stays that option. */
static void watch(struct watch *w, const struct ceduo_leader *leader, uint64_t rocks)
{
    size_t best = clear_best(leader);
    if (w->known)
        assert_true(leader->known);
    else if (leader->known)
        w->rocks = rocks;
    if (best != SIZE_MAX && w->best != SIZE_MAX)
        assert_int_equal(best, w->best);
    w->known = leader->known;
    w->best = best != SIZE_MAX ? best : w->best;
}

static uint64_t fewest_rocks(void)
{
    uint64_t fewest = UINT64_MAX;
    for (size_t i = 0; i < live.result->options_count; i++)
        if (live.result->options[i].wooded.rocks < fewest)
            fewest = live.result->options[i].wooded.rocks;
    return fewest;
}

static void expect_beaten(const struct ceduo_verdict *v)
{
    assert_true(v->choices[0].beaten && v->choices[1].beaten);
    assert_false(v->choices[2].beaten || v->choices[3].beaten); /* one yields more, the other protects better */
}

TEST(what_is_clear_stays)
{
    struct watch today = {.best = SIZE_MAX}, rotation = {.best = SIZE_MAX};
    size_t looks = 0, shares = 0;
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
        assert_true(known >= shares); /* no share goes back to unknown */
        shares = known;
        watch(&today, &live.verdict.today, fewest_rocks());
        watch(&rotation, &live.verdict.rotation, live.results.years ? live.results.years->rocks : 0);
        looks++;
    }
    assert_true(today.known && rotation.known);
    EXPECT(today.rocks, ==, RUNS_FIRST); /* told from the first thousand rocks */
    EXPECT(rotation.rocks, <=, 10 * RUNS_FIRST);
    EXPECT(today.best, ==, 3);    /* the large reserves, whose standards are as thick as their curve has them, */
    EXPECT(rotation.best, ==, 3); /* today and over the years */
    EXPECT(looks, >, 6);          /* progress is shown */
    EXPECT(live.results.years->done, ==, 4);
    expect_beaten(&live.verdict);
    close_scene();
}

/* An edit of one stand: the others' years stay, those of the old stand do not count. */
TEST(an_edit_asks_for_its_years_alone)
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
    assert_true(isnan(live.verdict.choices[1].mean.mean)); /* not that of the stand before */
    assert_false(live.verdict.rotation.known);
    ceduo_jobs_wait(live.jobs, true);
    ceduo_live_poll(&live, &file.scene);
    assert_true(live.verdict.rotation.known);
    EXPECT(live.verdict.choices[1].mean.mean, <, before); /* four times as many of the second oldest */
    close_scene();
}

static void follow_to_the_end(void)
{
    ceduo_live_update(&live, &file, 0, 0, 0);
    ceduo_jobs_wait(live.jobs, true);
    ceduo_live_poll(&live, &file.scene);
}

/* An edit of the energy law: what was known by the other law is now known by the scene's own, and no longer stands for the other. */
TEST(an_edit_of_the_law_leaves_no_figures_of_the_other)
{
    open_scene("profiles/scenes/paper-site.yaml");
    follow_to_the_end();
    const struct ceduo_alternative_energy *other = &live.result->options[0].alternatives[0];
    assert_true(other->known);
    EXPECT(other->model, ==, CEDUO_DORREN);
    for (size_t i = 0; i < file.scene.options[0].belts_count; i++)
        file.scene.options[0].belts[i].stand.energy = CEDUO_DORREN;
    ceduo_live_update(&live, &file, 0, 0, 0);
    assert_false(live.result->options[0].alternatives[0].known);
    follow_to_the_end();
    other = &live.result->options[0].alternatives[0];
    assert_true(other->known);
    EXPECT(other->model, ==, CEDUO_BRAUNER);
    close_scene();
}

/* An edit of the contact model: years of rocks among stems are no years of the index. */
TEST(an_edit_of_the_contact_model_leaves_no_years)
{
    open_scene("profiles/scenes/paper-site.yaml");
    follow_to_the_end();
    EXPECT(live.verdict.choices[0].mean.mean, >, 0);
    file.scene.simulation.contact_model = CEDUO_INDEX;
    ceduo_live_update(&live, &file, 0, 0, 0);
    EXPECT(live.verdict.choices[0].last_summary->years, ==, 0);
    follow_to_the_end();
    EXPECT(live.verdict.choices[0].last_summary->years, >, 0);
    EXPECT(live.verdict.choices[0].last_summary->simulated, ==, 0);
    EXPECT_NAN(live.verdict.choices[0].mean.mean);
    close_scene();
}

/* ---- made by hand ---- */

#define OPTIONS 3
#define ROCKS   1000

/* Options with the forest of the first, and what rocks are said to have done there. It points into itself. */
struct made {
    struct ceduo_option options[OPTIONS];
    struct ceduo_arrivals bare, wooded[OPTIONS];
    struct ceduo_difference differences[OPTIONS];
    struct ceduo_alternative_energy alternatives[OPTIONS];
    struct ceduo_option_result found[OPTIONS];
    struct ceduo_stand_result stands[2]; /* of the belts of each */
    struct ceduo_result result;
    struct ceduo_year year[OPTIONS];
    struct ceduo_index index;
    uint16_t marks[OPTIONS][ROCKS];
    struct ceduo_years years[OPTIONS], *of[OPTIONS];
};

static struct made made;

/* All alike: of the rocks half arrive with too much, today, under the other law and in the one year. */
static void make_alike(void)
{
    made = (struct made){.bare = {.released = ROCKS, .reached = ROCKS, .reach.mean = 1, .exceed.mean = 1}};
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
        made.of[i] = &made.years[i];
    }
    file.scene.options = made.options;
    file.scene.options_count = OPTIONS;
    made.index.contact = CEDUO_FAIL;
}

static struct ceduo_verdict verdict_of_made(struct ceduo_years *const *years)
{
    struct ceduo_verdict v;
    EXPECT(ceduo_compare_options(&made.result, years, NULL, &v), ==, CEDUO_OK);
    return v;
}

static struct scene_file kept;

static int open_made(void **state)
{
    (void)state;
    struct problems problems = {0};
    assert_true(ceduo_scene_load(&file, "profiles/scenes/rotation.yaml", NULL, 0, &problems));
    EXPECT(file.scene.controls_count, ==, 1);
    kept = file;
    make_alike();
    return 0;
}

static int close_made(void **state)
{
    (void)state;
    ceduo_scene_release(&kept);
    return 0;
}

/* A share by the normal law; of none by Wilson's interval, z²/(n + z²); of rocks with weights by its own interval. */
TEST(half_of_a_share)
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

/* Of two that are equal the first; the other is a rival, and equal. */
TEST_WITH(of_two_equal_options_the_first, open_made, close_made)
{
    for (size_t i = 1; i < OPTIONS; i++)
        made.differences[i].exceed = (struct ceduo_estimate){-.2, .01, NAN, NAN};
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v = verdict_of_made(NULL);
    EXPECT(v.today.best, ==, 1);
    EXPECT(v.today.rivals, ==, 1);
    assert_true(v.today.rival[2] && v.today.equal);
}

/* Turned: the order is clear under one law, by 3 errors, and the other way round under the other, by one. */
TEST_WITH(an_order_is_turned_by_more_than_an_error, open_made, close_made)
{
    static const struct {
        double today, other; /* errors by which option 1 is worse today, better under the other law */
        size_t turned;
    } cases[] = {{4, .5, 0}, {.5, 4, 0}, {4, 1.5, 1}, {1.5, 4, 1}, {2.5, 2.5, 0}, {4, -4, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        made.differences[1].exceed = (struct ceduo_estimate){cases[i].today * .01, .01, NAN, NAN};
        made.alternatives[1].to_first.exceed = (struct ceduo_estimate){-cases[i].other * .01, .01, NAN, NAN};
        made.differences[2].exceed = made.alternatives[2].to_first.exceed = (struct ceduo_estimate){9, .01, NAN, NAN};
        LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v = verdict_of_made(NULL);
        EXPECT(v.reversals_count, ==, cases[i].turned);
        if (v.reversals_count > 0)
            assert_true(v.reversals[0].better == 0 && v.reversals[0].worse == 1);
    }
}

/* Of options that yield as much, 500 rocks of 1000 through the first are clearly more than 300, which 305 are not. Where all let as
 * many through, none is beaten. */
TEST_WITH(beaten_by_one_of_equal_yield, open_made, close_made)
{
    struct ceduo_verdict v = verdict_of_made(made.of);
    EXPECT(v.choices[0].yield.cut_per_year, >, 0);
    assert_false(v.choices[0].beaten || v.choices[1].beaten || v.choices[2].beaten);
    ceduo_verdict_release(&v);
    for (size_t r = 0; r < ROCKS; r++) {
        made.marks[1][r] = r % 1000 >= 700;
        made.marks[2][r] = r % 1000 < 305;
    }
    v = verdict_of_made(made.of);
    assert_true(v.choices[0].beaten);
    assert_false(v.choices[1].beaten || v.choices[2].beaten);
    ceduo_verdict_release(&v);
}

/* How often the pane of options says "worst": above the column of the worst year, and beside an option. */
static int count_worst(const struct ceduo_verdict *v)
{
    const struct ceduo_report report = {.file = &file, .result = &made.result, .verdict = v, .years_ahead = made.of};
    LOCAL_BY(ceduo_page_free) struct ceduo_page page = {.width = 120};
    LOCAL_TEXT(text);
    int n = 0;
    ceduo_page_options(&page, &report, CEDUO_OPTIONS_PANE, made.result.last_control, 0, 0, OPTIONS);
    ceduo_page_print(&text, &page, false);
    for (const char *p = ceduo_text_string(&text); (p = strstr(p, "worst")); p++)
        n++;
    return n;
}

/* An option is the worst if its interval lies above all others, and not if it is only the largest of two that overlap. */
TEST_WITH(the_worst_is_apart_from_all_others, open_made, close_made)
{
    static const struct {
        double mean[OPTIONS], half[OPTIONS];
        int worst;
    } cases[] = {{{.3, .1, .5}, {.05, .02, .05}, 1},
                 {{.44, .1, .5}, {.05, .02, .05}, 0},
                 {{.3, .1, .29}, {.02, .02, .02}, 0},
                 {{.39, .1, .5}, {.05, .02, .05}, 1},
                 {{.9, .1, .5}, {.05, .02, .05}, 1}};
    struct ceduo_verdict v = verdict_of_made(made.of);
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
