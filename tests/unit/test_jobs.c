/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow threads */
/* The queue of jobs of the live program. */
#include "expect.h"

#include <stdlib.h>

#include "base/clock.h"
#include "model/jobs.h"

static struct scene_file file;
static struct jobs *jobs;
static union results results;

static int set_up(void **state)
{
    (void)state;
    struct problems problems = {0};
    assert_true(ceduo_scene_load(&file, "profiles/scenes/paper-site.yaml", NULL, 0, &problems));
    jobs = ceduo_jobs_create(2);
    assert_non_null(jobs);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    ceduo_result_list_free(&results);
    ceduo_jobs_free(jobs);
    ceduo_scene_release(&file);
    return 0;
}

static bool show(void)
{
    return ceduo_jobs_show(jobs, &file, 0);
}

static struct jobs_state take_results(void)
{
    ceduo_result_list_free(&results);
    return ceduo_jobs_take(jobs, &results);
}

static struct ceduo_search make_search(uint64_t rocks)
{
    return (struct ceduo_search){
        .path = "rock.diameter_m", .goal = CEDUO_GOAL_EXCEED, .target = .3, .lo = .2, .hi = 1.5, .rocks = rocks};
}

TEST_WITH(figures_and_years_come_to_an_end, set_up, tear_down)
{
    assert_true(show());
    assert_false(show()); /* same runs */
    assert_true(take_results().busy);
    ceduo_jobs_wait(jobs, true);
    assert_false(take_results().busy);
    assert_non_null(results.snapshot);
    assert_int_equal(results.snapshot->key, ceduo_jobs_key(&file.scene));
    assert_int_equal(results.snapshot->snapshot->bare->flown.rocks, RUNS_MAX);
    assert_int_equal(results.snapshot->snapshot->wooded[0]->flown.rocks, RUNS_MAX);
    EXPECT(results.snapshot->snapshot->bare->envelope_rocks, ==, CEDUO_ENVELOPE_ROCKS);
    EXPECT(results.snapshot->snapshot->wooded[0]->envelope_rocks, ==, CEDUO_ENVELOPE_ROCKS);
    assert_non_null(results.years);
    assert_int_equal(results.years->n, 1);
    assert_int_equal(results.years->items[0]->years[0].wooded.rocks, 10 * RUNS_FIRST);
    assert_true(results.years->items[0]->key == ceduo_runs_years_key(&file.scene, 0));
    assert_int_equal(results.years->done, 1);
    assert_int_equal(results.years->rocks, 10 * RUNS_FIRST);
    assert_false(show()); /* already computed */
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(show());
    assert_true(take_results().busy);
}

/* Results that were not fetched are dropped when the scene changes. */
TEST_WITH(results_of_an_older_scene_are_dropped, set_up, tear_down)
{
    assert_true(show());
    ceduo_jobs_wait(jobs, true);
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(show());
    take_results();
    if (results.snapshot)
        assert_true(results.snapshot->key == ceduo_jobs_key(&file.scene));
    for (size_t i = 0; results.years && i < results.years->n; i++)
        if (results.years->items[i])
            assert_true(results.years->items[i]->key == ceduo_runs_years_key(&file.scene, i));
}

/* Without stems all contact models give the same rocks, but the index simulates none. */
TEST_WITH(each_contact_model_has_its_own_key, set_up, tear_down)
{
    static const enum ceduo_contact_model models[] = {CEDUO_INDEX, CEDUO_STEMS};
    uint64_t keys[2], years[2];
    file.scene.options[0].belts_count = 0;
    for (int i = 0; i < 2; i++) {
        file.scene.simulation.contact_model = models[i];
        keys[i] = ceduo_jobs_key(&file.scene);
        years[i] = ceduo_runs_years_key(&file.scene, 0);
    }
    assert_true(keys[0] != keys[1]);
    assert_true(years[0] != years[1]);
}

/* A search precedes the figures, which continue after it; its result is independent of them, and the scene does not change. */
TEST_WITH(a_search_comes_first, set_up, tear_down)
{
    struct ceduo_search search = make_search(500);
    double diameter = file.scene.rock.diameter.mean;
    show();
    ceduo_jobs_ask(jobs, &(struct job_request){JOB_SEARCH, &file, .levels = 1, .search = &search});
    assert_true(ceduo_jobs_wait(jobs, false));
    take_results();
    assert_non_null(results.search);
    assert_int_equal(results.search->status, CEDUO_OK);
    EXPECT(file.scene.rock.diameter.mean, ==, diameter);
    struct search_answer alone;
    assert_int_equal(ceduo_search(&file, &search, 1, NULL, &alone), CEDUO_OK);
    assert_true(alone.found.found);
    EXPECT(alone.found.value, ==, results.search->found.value);
    assert_int_equal(alone.found.evaluations, results.search->found.evaluations);
    assert_false(ceduo_jobs_wait(jobs, false));
    ceduo_jobs_wait(jobs, true);
    take_results();
    assert_non_null(results.snapshot);
    assert_null(results.search);
}

/* A preview has priority like a search. */
TEST_WITH(a_preview_comes_first, set_up, tear_down)
{
    ceduo_jobs_ask(jobs, &(struct job_request){JOB_PREVIEW, &file, 0, 1, "rock.diameter_m", "0.6", NULL, NULL});
    assert_true(ceduo_jobs_wait(jobs, false));
    take_results();
    assert_non_null(results.preview);
}

/* The other energy law in addition to the figures: with the same number of rocks, and repeated if only its inputs change. */
TEST_WITH(the_other_law_is_computed_as_well, set_up, tear_down)
{
    show();
    ceduo_jobs_wait(jobs, true);
    take_results();
    assert_non_null(results.others);
    assert_int_equal(results.others->options, 1);
    assert_int_equal(results.others->controls, file.scene.controls_count);
    assert_true(results.others->items[0].known && results.others->items[0].stems);
    assert_int_equal(results.others->items[0].model, CEDUO_DORREN);
    double before = results.others->items[0].arrivals.reach.mean;
    for (size_t i = 0; i < 2; i++)
        file.scene.options[0].belts[i].stand.fracture_ratio = 3; /* the scene's own law does not use it */
    assert_true(show());
    ceduo_jobs_wait(jobs, true);
    take_results();
    assert_non_null(results.others);
    EXPECT(results.others->items[0].arrivals.reach.mean, <, before);
    assert_null(results.snapshot);
    file.scene.simulation.contact_model = CEDUO_INDEX;
    show();
    ceduo_jobs_wait(jobs, true);
    take_results();
    assert_null(results.others);
}

static const struct uncertainty *uncertainty(size_t shown, size_t levels)
{
    assert_true(ceduo_jobs_ask(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, shown, .levels = levels}));
    assert_false(ceduo_jobs_ask(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, shown, .levels = levels}));
    ceduo_jobs_wait(jobs, true);
    take_results();
    assert_non_null(results.uncertainty);
    assert_true(results.uncertainty->file.root == file.root);
    return results.uncertainty;
}

/* With one option, only the first level exists. */
TEST_WITH(the_uncertainty_comes_last, set_up, tear_down)
{
    const struct uncertainty *u = uncertainty(0, 1);
    assert_int_equal(u->level, UNCERTAINTY_LEVELS - 1);
    assert_int_equal(u->inputs.n,
                     12 + 12); /* today's inputs, and growth: two curves of four constants, two numbers of shoots, two
                                * densities */
    assert_int_equal(u->answer.points, CEDUO_UNCERTAINTY_POINTS);
    EXPECT(u->answer.figures[CEDUO_UNCERTAINTY_EXCEED].fit.p5, <, u->answer.figures[CEDUO_UNCERTAINTY_EXCEED].fit.p95);
    assert_false(ceduo_jobs_ask(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, 0, .levels = UNCERTAINTY_LEVELS}));
    assert_true(u->answer.rotation);
    ceduo_jobs_stop(jobs, JOB_UNCERTAINTY); /* the same nodes: another scene would need a new run */
    file.scene.controls_count = 0;
    u = uncertainty(0, UNCERTAINTY_LEVELS); /* without a control there is no uncertainty */
    assert_int_equal(u->inputs.n, 0);
    file.scene.controls_count = 1;
}

/* Three options over two years. */
static int set_up_options(void **state)
{
    static const char *const sets[] = {"years.first=1", "years.last=2"};
    struct problems problems = {0};
    (void)state;
    assert_true(ceduo_scene_load(&file, "profiles/scenes/staggered.yaml", sets, 2, &problems));
    jobs = ceduo_jobs_create(2);
    assert_non_null(jobs);
    return 0;
}

/* The shown option comes first: its figures stay when the others arrive. */
TEST_WITH(the_shown_option_has_its_uncertainty_first, set_up_options, tear_down)
{
    const size_t shown = 1, n = 3;
    const struct ceduo_uncertainty_result *a = &uncertainty(shown, 1)->answer;
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, false);
    double p5 = f->fit.p5, p95 = f->fit.p95, leaves = f->fit.left[f->order[0]];
    EXPECT(p5, <, p95);
    for (size_t i = 0; i < n; i++)
        if (i != shown)
            EXPECT_NAN(ceduo_uncertainty_find_figure(a, i, CEDUO_UNCERTAINTY_EXCEED, false)->fit.p5);
    EXPECT_NAN(ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, true)->fit.p95);
    assert_int_equal(a->orders_count, 0);
    a = &uncertainty(shown, UNCERTAINTY_LEVELS)->answer;
    f = ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, false);
    EXPECT(f->fit.p5, ==, p5);
    EXPECT(f->fit.p95, ==, p95);
    EXPECT(f->fit.left[f->order[0]], ==, leaves);
    for (size_t i = 0; i < n; i++)
        EXPECT(ceduo_uncertainty_find_figure(a, i, CEDUO_UNCERTAINTY_EXCEED, false)->fit.p5, >, 0);
    assert_int_equal(a->orders_count, n - 1);
    assert_true(a->rotation);
}

/* A stopped job ends soon, without a result. */
TEST_WITH(a_search_can_be_stopped, set_up, tear_down)
{
    struct ceduo_search search = make_search(CEDUO_ROCKS_MAX);
    ceduo_jobs_ask(jobs, &(struct job_request){JOB_SEARCH, &file, .levels = 1, .search = &search});
    struct timespec moment = {.tv_nsec = 200000000};
    nanosleep(&moment, NULL);
    assert_true(take_results().busy);
    double start = ceduo_clock();
    ceduo_jobs_stop(jobs, JOB_SEARCH);
    ceduo_jobs_wait(jobs, true);
    EXPECT(ceduo_clock() - start, <, 1); /* 0.1 s on an idle machine */
    take_results();
    assert_null(results.search);
}
