/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow threads */
/* Queue of jobs of the interactive program. */
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
    ceduo_job_results_free(&results);
    ceduo_jobs_free(jobs);
    ceduo_scene_release(&file);
    return 0;
}

static bool request_figures(void)
{
    return ceduo_jobs_request_figures(jobs, &file, 0);
}

static struct jobs_state collect(void)
{
    ceduo_job_results_free(&results);
    return ceduo_jobs_collect(jobs, &results);
}

static struct ceduo_search make_search(uint64_t rocks)
{
    return (struct ceduo_search){
        .path = "rock.diameter_m", .goal = CEDUO_GOAL_EXCEED, .target = .3, .lo = .2, .hi = 1.5, .rocks = rocks};
}

TEST_WITH(figures_and_years_are_completed, set_up, tear_down)
{
    assert_true(request_figures());
    assert_false(request_figures()); /* same runs */
    assert_true(collect().busy);
    ceduo_jobs_wait(jobs, true);
    assert_false(collect().busy);
    assert_non_null(results.snapshot);
    assert_int_equal(results.snapshot->key, ceduo_jobs_key(&file.scene));
    assert_int_equal(results.snapshot->snapshot->bare->simulated.rocks, RUNS_MAX);
    assert_int_equal(results.snapshot->snapshot->wooded[0]->simulated.rocks, RUNS_MAX);
    EXPECT(results.snapshot->snapshot->bare->envelope_rocks, ==, CEDUO_ENVELOPE_ROCKS);
    EXPECT(results.snapshot->snapshot->wooded[0]->envelope_rocks, ==, CEDUO_ENVELOPE_ROCKS);
    assert_non_null(results.years);
    assert_int_equal(results.years->n, 1);
    assert_int_equal(results.years->items[0]->years[0].wooded.rocks, 10 * RUNS_FIRST);
    assert_true(results.years->items[0]->key == ceduo_runs_years_key(&file.scene, 0));
    assert_int_equal(results.years->done, 1);
    assert_int_equal(results.years->rocks, 10 * RUNS_FIRST);
    assert_false(request_figures()); /* already computed */
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(request_figures());
    assert_true(collect().busy);
}

/* Results not collected before the scene changes are dropped. */
TEST_WITH(results_of_an_older_scene_are_dropped, set_up, tear_down)
{
    assert_true(request_figures());
    ceduo_jobs_wait(jobs, true);
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(request_figures());
    collect();
    if (results.snapshot)
        assert_true(results.snapshot->key == ceduo_jobs_key(&file.scene));
    for (size_t i = 0; results.years && i < results.years->n; i++)
        if (results.years->items[i])
            assert_true(results.years->items[i]->key == ceduo_runs_years_key(&file.scene, i));
}

/* Without trees, rocks move in the same way by every contact model, but the index simulates none. */
TEST_WITH(a_contact_model_makes_another_key, set_up, tear_down)
{
    static const enum ceduo_contact_model models[] = {CEDUO_CONTACT_MODEL_INDEX, CEDUO_CONTACT_MODEL_STEMS};
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

/* A search runs before the figures, which continue after it. It finds the same value as alone, and does not change the
 * scene. */
TEST_WITH(a_search_runs_first, set_up, tear_down)
{
    struct ceduo_search search = make_search(500);
    double diameter = file.scene.rock.diameter.mean;
    request_figures();
    ceduo_jobs_request(jobs, &(struct job_request){JOB_SEARCH, &file, .levels = 1, .search = &search});
    assert_true(ceduo_jobs_wait(jobs, false));
    collect();
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
    collect();
    assert_non_null(results.snapshot);
    assert_null(results.search);
}

/* Waiting for a search also waits for a preview. */
TEST_WITH(a_preview_is_waited_for, set_up, tear_down)
{
    ceduo_jobs_request(jobs, &(struct job_request){JOB_PREVIEW, &file, 0, 1, "rock.diameter_m", "0.6", NULL, NULL});
    assert_true(ceduo_jobs_wait(jobs, false));
    collect();
    assert_non_null(results.preview);
}

/* The alternative energy law is computed with the figures and the same number of rocks. It is computed again if an edit changes
 * it alone. */
TEST_WITH(the_alternative_law_is_computed, set_up, tear_down)
{
    request_figures();
    ceduo_jobs_wait(jobs, true);
    collect();
    assert_non_null(results.alternatives);
    assert_int_equal(results.alternatives->options, 1);
    assert_int_equal(results.alternatives->controls, file.scene.controls_count);
    assert_true(results.alternatives->items[0].known && results.alternatives->items[0].stems);
    assert_int_equal(results.alternatives->items[0].model, CEDUO_ENERGY_MODEL_DORREN);
    double before = results.alternatives->items[0].arrivals.reach.mean;
    for (size_t i = 0; i < 2; i++)
        file.scene.options[0].belts[i].stand.fracture_ratio = 3; /* not used by the scene's own law */
    assert_true(request_figures());
    ceduo_jobs_wait(jobs, true);
    collect();
    assert_non_null(results.alternatives);
    EXPECT(results.alternatives->items[0].arrivals.reach.mean, <, before);
    assert_null(results.snapshot);
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    request_figures();
    ceduo_jobs_wait(jobs, true);
    collect();
    assert_null(results.alternatives);
}

static const struct uncertainty *compute_uncertainty(size_t shown, size_t levels)
{
    assert_true(ceduo_jobs_request(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, shown, .levels = levels}));
    assert_false(ceduo_jobs_request(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, shown, .levels = levels}));
    ceduo_jobs_wait(jobs, true);
    collect();
    assert_non_null(results.uncertainty);
    assert_true(results.uncertainty->file.root == file.root);
    return results.uncertainty;
}

/* With one option the first level is complete. */
TEST_WITH(uncertainty_is_computed_last, set_up, tear_down)
{
    const struct uncertainty *u = compute_uncertainty(0, 1);
    assert_int_equal(u->level, UNCERTAINTY_LEVELS - 1);
    assert_int_equal(u->inputs.n,
                     12 + 12); /* today, and growth: two curves of four constants, two numbers of shoots, two densities */
    assert_int_equal(u->answer.points, CEDUO_UNCERTAINTY_POINTS);
    EXPECT(u->answer.figures[CEDUO_UNCERTAINTY_EXCEED].fit.p5, <, u->answer.figures[CEDUO_UNCERTAINTY_EXCEED].fit.p95);
    assert_false(ceduo_jobs_request(jobs, &(struct job_request){JOB_UNCERTAINTY, &file, 0, .levels = UNCERTAINTY_LEVELS}));
    assert_true(u->answer.rotation);
    ceduo_jobs_stop(jobs, JOB_UNCERTAINTY); /* the nodes have not changed, so it would not be requested again */
    file.scene.controls_count = 0;
    u = compute_uncertainty(0, UNCERTAINTY_LEVELS); /* no control, no uncertain results */
    assert_int_equal(u->inputs.n, 0);
    file.scene.controls_count = 1;
}

/* Load three options over two years. */
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

/* The shown option is computed first; its figures stay when the other options follow. */
TEST_WITH(uncertainty_of_the_shown_option_is_first, set_up_options, tear_down)
{
    const size_t shown = 1, n = 3;
    const struct ceduo_uncertainty_result *a = &compute_uncertainty(shown, 1)->answer;
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, false);
    double p5 = f->fit.p5, p95 = f->fit.p95, width = f->fit.width_if_known[f->order[0]];
    EXPECT(p5, <, p95);
    for (size_t i = 0; i < n; i++)
        if (i != shown)
            EXPECT_NAN(ceduo_uncertainty_find_figure(a, i, CEDUO_UNCERTAINTY_EXCEED, false)->fit.p5);
    EXPECT_NAN(ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, true)->fit.p95);
    assert_int_equal(a->orders_count, 0);
    a = &compute_uncertainty(shown, UNCERTAINTY_LEVELS)->answer;
    f = ceduo_uncertainty_find_figure(a, shown, CEDUO_UNCERTAINTY_EXCEED, false);
    EXPECT(f->fit.p5, ==, p5);
    EXPECT(f->fit.p95, ==, p95);
    EXPECT(f->fit.width_if_known[f->order[0]], ==, width);
    for (size_t i = 0; i < n; i++)
        EXPECT(ceduo_uncertainty_find_figure(a, i, CEDUO_UNCERTAINTY_EXCEED, false)->fit.p5, >, 0);
    assert_int_equal(a->orders_count, n - 1);
    assert_true(a->rotation);
}

/* A stopped search ends soon, without a result. */
TEST_WITH(a_search_is_stopped, set_up, tear_down)
{
    struct ceduo_search search = make_search(CEDUO_ROCKS_MAX);
    ceduo_jobs_request(jobs, &(struct job_request){JOB_SEARCH, &file, .levels = 1, .search = &search});
    struct timespec moment = {.tv_nsec = 200000000};
    nanosleep(&moment, NULL);
    assert_true(collect().busy);
    double start = ceduo_clock();
    ceduo_jobs_stop(jobs, JOB_SEARCH);
    ceduo_jobs_wait(jobs, true);
    EXPECT(ceduo_clock() - start, <, 1); /* 0.1 s on an idle machine */
    collect();
    assert_null(results.search);
}
