/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions that ask for little, that nobody waits for any more, and what is read from their answers. */
#include "expect.h"

#include "physics/paper_site.h"
#include "study/goal.h"

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])

static struct paper_site site;

static struct ceduo_question question_of(uint64_t rocks)
{
    paper_site_init(&site);
    struct ceduo_question q = ceduo_question_default(&site.scene);
    q.rocks = q.run.rocks_most = rocks;
    return q;
}

/* Stands and index are assessed without a rock, be its precision asked for or not. */
static void no_rocks_are_not_precise(void **state)
{
    (void)state;
    struct ceduo_question q = question_of(0);
    struct ceduo_answer answer;
    q.tolerance = .1;
    assert_int_equal(ceduo_ask(&q, NULL, &answer), CEDUO_OK);
    assert_int_equal(ceduo_result_rocks(answer.result), 0);
    assert_null(ceduo_result_wooded(answer.result, 0, 0));
    assert_false(answer.tolerance_met);
    EXPECT(answer.result->options[0].stands[0].adc_m, >, 0);
    ceduo_answer_release(&answer);
}

/* Where rocks are counted nowhere they fly all the same, and there is nothing to say of other sizes. */
static void nothing_is_counted_without_a_control(void **state)
{
    (void)state;
    for (int model = CEDUO_INDEX; model <= CEDUO_STEMS; model++) {
        struct ceduo_question q = question_of(20);
        struct ceduo_answer answer;
        site.scene.simulation.contact_model = (enum ceduo_contact_model)model;
        site.scene.controls_count = 0;
        q.block_rocks = 20;
        assert_int_equal(ceduo_ask(&q, NULL, &answer), CEDUO_OK);
        assert_null(answer.blocks);
        assert_int_equal(ceduo_result_rocks(answer.result), 20);
        assert_int_equal(answer.result->options[0].wooded.rocks, 20);
        assert_int_equal(answer.result->options[0].wooded.controls, 0);
        ceduo_answer_release(&answer);
    }
}

/* All runs are there from the question before: only the other sizes fly, and nobody waits for them. */
static void other_sizes_are_cancelled(void **state)
{
    (void)state;
    struct ceduo_question q = question_of(20);
    struct ceduo_pool *pool = NULL;
    struct ceduo_answer answer;
    atomic_bool cancel = true;
    assert_int_equal(ceduo_ask(&q, &pool, &answer), CEDUO_OK);
    ceduo_answer_release(&answer);
    q.run.cancel = &cancel;
    assert_int_equal(ceduo_ask(&q, &pool, &answer), CEDUO_OK);
    ceduo_answer_release(&answer);
    q.block_rocks = 20;
    assert_int_equal(ceduo_ask(&q, &pool, &answer), CEDUO_CANCELLED);
    assert_null(answer.result);
    assert_null(answer.blocks);
    cancel = false;
    assert_int_equal(ceduo_ask(&q, &pool, &answer), CEDUO_OK);
    assert_non_null(answer.blocks);
    ceduo_answer_release(&answer);
    ceduo_pool_free(pool);
}

/* At the worst of two controls; not known where it is not of one of them, whichever comes first. */
static void a_goal_is_reached_at_the_worst_control(void **state)
{
    (void)state;
    const double accepted[][2] = {{50e3, 50e3}, {NAN, 50e3}, {50e3, NAN}};
    for (size_t i = 0; i < LENGTH(accepted); i++) {
        struct ceduo_question q = question_of(200);
        struct ceduo_answer answer;
        struct ceduo_control controls[2] = {site.control, site.control};
        controls[0].x = controls[0].x_given = 20;
        for (int c = 0; c < 2; c++)
            controls[c].accepted = accepted[i][c];
        site.scene.controls = controls;
        site.scene.controls_count = 2;
        assert_int_equal(ceduo_ask(&q, NULL, &answer), CEDUO_OK);
        double reached = ceduo_goal_reached(CEDUO_GOAL_EXCEED, answer.result, 0);
        const struct ceduo_arrivals *a = answer.result->options[0].wooded.arrivals;
        EXPECT(ceduo_goal_reached(CEDUO_GOAL_ARRIVE, answer.result, 0), ==,
               fmax(a[0].reach_probability, a[1].reach_probability));
        if (i == 0)
            EXPECT(reached, ==, fmax(a[0].exceed_probability, a[1].exceed_probability));
        else
            assert_true(isnan(reached));
        ceduo_answer_release(&answer);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_rocks_are_not_precise),
        cmocka_unit_test(nothing_is_counted_without_a_control),
        cmocka_unit_test(other_sizes_are_cancelled),
        cmocka_unit_test(a_goal_is_reached_at_the_worst_control),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
