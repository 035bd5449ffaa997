/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Requests for little, cancelled requests, and figures derived from their results. */
#include "core/runs/result.h"
#include "core/runs/year_runs.h"
#include "expect.h"
#include "local.h"

#include "physics/paper_site.h"
#include "study/goal.h"
#include "study/verdict.h"

static struct paper_site site;

static struct ceduo_request make_request(uint64_t rocks)
{
    paper_site_init(&site);
    struct ceduo_request q = ceduo_request_default(&site.scene);
    q.rocks = q.run.rocks_max = rocks;
    return q;
}

/* Stands and index need no rocks, with or without a requested precision. */
TEST(stands_need_no_rocks)
{
    struct ceduo_request q = make_request(0);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    q.tolerance = .1;
    q.years = true;
    q.window = (struct ceduo_window){.last = 2, .step = 1};
    q.years_independent = true;
    assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
    assert_int_equal(ceduo_result_rocks(answer.result), 0);
    assert_int_equal(answer.years[0]->rocks, 0);
    assert_null(ceduo_result_wooded(answer.result, 0, 0));
    assert_true(isnan(ceduo_share_to_first(answer.result, 0).mean));
    assert_false(answer.tolerance_met);
    EXPECT(answer.result->options[0].stands[0].adc_m, >, 0);
}

/* Without a control the arrivals are unknown, today and over years; the yields are known. */
static void expect_yields_alone(const struct ceduo_results *answer)
{
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict v;
    assert_int_equal(ceduo_compare_options(answer->result, answer->years, NULL, &v), CEDUO_OK);
    assert_false(v.wooded || v.accepted || v.today.known || v.rotation.known || v.choices[0].energy_known);
    assert_true(isnan(v.choices[0].today.mean) && isnan(v.choices[0].mean.mean));
    EXPECT(v.choices[0].yield.volume_today, >, 0);
    assert_true(isnan(ceduo_years_difference(answer->years[0], answer->years[0]).mean));
}

/* Without a control rocks are simulated all the same, and other sizes have no results. */
TEST(nothing_is_counted_without_a_control)
{
    for (int model = CEDUO_CONTACT_MODEL_INDEX; model <= CEDUO_CONTACT_MODEL_STEMS; model++) {
        struct ceduo_request q = make_request(20);
        LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
        site.scene.simulation.contact_model = (enum ceduo_contact_model)model;
        site.scene.controls_count = 0;
        q.block_rocks = 20;
        q.years = true;
        q.window = (struct ceduo_window){.last = 1, .step = 1};
        assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
        assert_null(answer.blocks);
        expect_yields_alone(&answer);
        assert_int_equal(ceduo_result_rocks(answer.result), 20);
        assert_int_equal(answer.result->options[0].wooded.rocks, 20);
        assert_int_equal(answer.result->options[0].wooded.controls, 0);
    }
}

/* All runs exist from the previous request: only the other sizes are simulated, and they are cancelled. */
TEST(other_sizes_are_cancelled)
{
    struct ceduo_request q = make_request(20);
    LOCAL(ceduo_pool, pool) = NULL;
    struct ceduo_results answer;
    atomic_bool cancel = true;
    assert_int_equal(ceduo_simulate_request(&q, &pool, &answer), CEDUO_OK);
    ceduo_results_release(&answer);
    q.run.cancel = &cancel;
    assert_int_equal(ceduo_simulate_request(&q, &pool, &answer), CEDUO_OK);
    ceduo_results_release(&answer);
    q.block_rocks = 20;
    assert_int_equal(ceduo_simulate_request(&q, &pool, &answer), CEDUO_CANCELLED);
    assert_null(answer.result);
    assert_null(answer.blocks);
    cancel = false;
    assert_int_equal(ceduo_simulate_request(&q, &pool, &answer), CEDUO_OK);
    assert_non_null(answer.blocks);
    ceduo_results_release(&answer);
}

/* One of two options is requested; the cost of the other's rocks is unknown. */
TEST(other_sizes_of_one_option)
{
    struct ceduo_request q = make_request(50);
    struct ceduo_option options[2] = {site.option, site.option};
    struct ceduo_results answers[2];
    site.scene.options = options;
    q.block_rocks = 50;
    q.only = 0;
    for (size_t i = 0; i < 2; i++) {
        site.scene.options_count = i + 1;
        assert_int_equal(ceduo_simulate_request(&q, NULL, &answers[i]), CEDUO_OK);
    }
    for (size_t b = 0; b < CEDUO_SIZES; b++)
        EXPECT(answers[0].blocks[b].arrivals.reached, ==, answers[1].blocks[b].arrivals.reached);
    ceduo_results_release(&answers[0]);
    ceduo_results_release(&answers[1]);
}

/* At the worse of two controls; NaN if either is NaN, in any order. */
TEST(the_worst_control_decides_a_goal)
{
    const double accepted[][2] = {{50e3, 50e3}, {NAN, 50e3}, {50e3, NAN}};
    for (size_t i = 0; i < LENGTH(accepted); i++) {
        struct ceduo_request q = make_request(200);
        LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
        struct ceduo_control controls[2] = {site.control, site.control};
        controls[0].x = controls[0].x_given = 20;
        for (int c = 0; c < 2; c++)
            controls[c].accepted = accepted[i][c];
        site.scene.controls = controls;
        site.scene.controls_count = 2;
        assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
        double reached = ceduo_goal_reached(CEDUO_GOAL_EXCEED, answer.result, 0, NULL);
        const struct ceduo_arrivals *a = answer.result->options[0].wooded.arrivals;
        EXPECT(ceduo_goal_reached(CEDUO_GOAL_ARRIVE, answer.result, 0, NULL), ==, fmax(a[0].reach.mean, a[1].reach.mean));
        if (i == 0)
            EXPECT(reached, ==, fmax(a[0].exceed.mean, a[1].exceed.mean));
        else
            assert_true(isnan(reached));
    }
}

/* Between two equal options the difference is 0 without error. */
TEST(options_that_are_the_same)
{
    struct ceduo_request q = make_request(200);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    struct ceduo_option options[2] = {site.option, site.option};
    site.control.accepted = 1e12;
    site.scene.options = options;
    site.scene.options_count = 2;
    assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
    struct ceduo_estimate difference = ceduo_share_to_first(answer.result, 1);
    EXPECT(difference.mean, ==, 0);
    EXPECT(difference.se, ==, 0);
    EXPECT(difference.hi, ==, 0);
}

/* Two objects at one place: the same rocks arrive, and each has its own limit. */
TEST(controls_at_one_place)
{
    struct ceduo_request q = make_request(200);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    struct ceduo_control controls[2] = {site.control, site.control};
    controls[1].accepted = 0;
    site.scene.controls = controls;
    site.scene.controls_count = 2;
    assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
    const struct ceduo_arrivals *a = ceduo_result_wooded(answer.result, 0, 0), *b = ceduo_result_wooded(answer.result, 0, 1);
    EXPECT(a->reached, >, 0);
    EXPECT(a->reached, ==, b->reached);
    EXPECT(a->energy.p95, ==, b->energy.p95);
    EXPECT(b->exceeded, ==, b->reached);
}

/* Years without rocks have no share, so no difference. */
TEST(years_without_rocks_have_no_difference)
{
    struct ceduo_request q = make_request(50);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    LOCAL(ceduo_years, empty);
    q.years = true;
    q.window = (struct ceduo_window){.last = 1, .step = 1};
    assert_int_equal(ceduo_simulate_request(&q, NULL, &answer), CEDUO_OK);
    assert_int_equal(ceduo_years_create(&site.scene, &site.option, q.window, &empty), CEDUO_OK);
    EXPECT(ceduo_years_difference(answer.years[0], answer.years[0]).mean, ==, 0);
    assert_true(isnan(ceduo_years_difference(answer.years[0], empty).mean));
    assert_true(isnan(ceduo_years_difference(empty, answer.years[0]).mean));
}

/* Three belts cut together, every ten years from year 2: by year, then along the slope. */
TEST(fellings_are_in_order)
{
    struct ceduo_belt belts[3];
    struct ceduo_option option = {.belts = belts, .belts_count = 3};
    LOCAL_BY(ceduo_yield_release) struct ceduo_yield yield;
    paper_site_init(&site);
    for (size_t i = 0; i < 3; i++) {
        belts[i] = site.belts[0];
        belts[i].stand.growth = paper_growth;
        belts[i].stand.cutting = (struct ceduo_cutting){.rotation = 10};
        belts[i].cut_year = 2;
    }
    assert_int_equal(ceduo_yield_compute(&option, 25, &yield), CEDUO_OK);
    EXPECT(yield.fellings_count, ==, 9);
    for (size_t i = 0; i < 9; i++) {
        EXPECT(yield.fellings[i].year, ==, 2 + i / 3 * 10);
        EXPECT(yield.fellings[i].belt, ==, i % 3);
    }
}

/* A coppice just after its cut has no stems today and a volume to cut later: half of the forest next to a permanently bare
 * half, which does not count. */
TEST(a_freshly_cut_stand_has_a_yield)
{
    static struct ceduo_stems empty[1];
    struct ceduo_belt belts[2];
    struct ceduo_option option = {.belts = belts, .belts_count = 1};
    LOCAL_BY(ceduo_yield_release) struct ceduo_yield alone, with_other;
    paper_site_init(&site);
    belts[0] = site.belts[0];
    belts[0].stand = (struct ceduo_stand){.species = site.belts[0].stand.species,
                                          .stools_per_ha = 2000,
                                          .spacing = 0.3,
                                          .shoots = empty,
                                          .fracture_ratio = NAN,
                                          .growth = paper_growth,
                                          .cutting = {.rotation = 10}};
    belts[0].cut_year = 10;
    belts[1] = belts[0];
    belts[1].stand = (struct ceduo_stand){.species = -1, .fracture_ratio = NAN};
    assert_int_equal(ceduo_yield_compute(&option, 25, &alone), CEDUO_OK);
    EXPECT(alone.volume_today, ==, 0);
    EXPECT(alone.cut_per_year, >, 0);
    option.belts_count = 2;
    assert_int_equal(ceduo_yield_compute(&option, 25, &with_other), CEDUO_OK);
    EXPECT(with_other.cut_per_year, ==, alone.cut_per_year);
}

/* The volume of belts is their mean weighted by length: 30 m and 90 m, one with twice the other's volume. */
TEST(volumes_of_belts_are_weighted_by_length)
{
    LOCAL_BY(ceduo_yield_release) struct ceduo_yield yield;
    paper_site_init(&site);
    for (size_t i = 0; i < 2; i++) {
        struct ceduo_stems *trees = &site.plots[i].trees;
        site.belts[i].stand.shoots_count = 0;
        site.belts[i].from = i == 0 ? 10 : 40;
        site.belts[i].to = i == 0 ? 40 : 130;
        trees->per_ha = 100;
        trees->volume = i == 0 ? 0.5 : 1;
    }
    assert_int_equal(ceduo_yield_compute(&site.option, 0, &yield), CEDUO_OK);
    EXPECT_NEAR(yield.volume_today, (30. * 50 + 90 * 100) / 120, 1e-12);
}
