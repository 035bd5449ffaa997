/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The queue of jobs of the live program. */
#include "expect.h"

#include <stdlib.h>

#include "base/clock.h"
#include "model/jobs.h"

static struct scene_file file;
static struct jobs *jobs;

static int set_up(void **state)
{
    (void)state;
    struct problems problems = {0};
    assert_true(ceduo_scene_read(&file, "profiles/scenes/paper-site.yaml", NULL, 0, &problems));
    jobs = ceduo_jobs_create(2);
    assert_non_null(jobs);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    ceduo_jobs_free(jobs);
    ceduo_scene_release(&file);
    return 0;
}

static bool show(bool years)
{
    return ceduo_jobs_show(jobs, &file.scene, ceduo_jobs_key(&file.scene), 0, years);
}

static void release(struct jobs_news *news)
{
    ceduo_outlook_free(news->outlook);
    ceduo_jobs_free_years(news->years, news->years_count);
    ceduo_sought_free(news->sought);
    ceduo_doubted_free(news->doubted);
    free(news->others);
}

static struct seek seek_of(uint64_t rocks)
{
    return (struct seek){
        .file = &file,
        .search = {.path = "rock.diameter_m", .goal = CEDUO_GOAL_EXCEED, .target = .3, .lo = .2, .hi = 1.5, .rocks = rocks}};
}

static void figures_and_years_come_to_an_end(void **state)
{
    (void)state;
    assert_true(show(false));
    assert_false(show(false)); /* the same runs */
    assert_true(show(true));   /* and years */
    assert_true(ceduo_jobs_news(jobs).busy);
    ceduo_jobs_wait(jobs);
    struct jobs_news news = ceduo_jobs_news(jobs);
    assert_false(news.busy);
    assert_non_null(news.outlook);
    assert_int_equal(news.key, ceduo_jobs_key(&file.scene));
    assert_int_equal(news.outlook->bare->flown.rocks, FLIGHTS_MOST);
    assert_int_equal(news.outlook->wooded[0]->flown.rocks, FLIGHTS_MOST);
    assert_non_null(news.years);
    assert_int_equal(news.years_count, 1);
    assert_int_equal(news.years[0]->years[0].wooded.rocks, FLIGHTS_YEAR);
    assert_true(news.years[0]->key == ceduo_flights_years_key(&file.scene, 0));
    assert_int_equal(news.done, 1);
    assert_int_equal(news.all, 1);
    release(&news);
    assert_false(show(false));
    assert_false(show(true)); /* they are known */
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(show(true));
    news = ceduo_jobs_news(jobs);
    assert_true(news.busy);
    release(&news);
}

/* What was computed and not yet taken is of no use once the scene is another. */
static void nothing_of_an_older_scene_is_news(void **state)
{
    (void)state;
    assert_true(show(true));
    ceduo_jobs_wait(jobs);
    file.scene.rock.diameter.mean *= 1.1;
    assert_true(show(true));
    struct jobs_news news = ceduo_jobs_news(jobs);
    if (news.outlook)
        assert_true(news.key == ceduo_jobs_key(&file.scene));
    for (size_t i = 0; i < news.years_count; i++)
        if (news.years && news.years[i])
            assert_true(news.years[i]->key == ceduo_flights_years_key(&file.scene, i));
    release(&news);
}

/* Where nothing stands rocks do the same by every contact model, but by the index none is simulated. */
static void a_contact_model_makes_another_key(void **state)
{
    (void)state;
    uint64_t keys[3];
    file.scene.options[0].belts_count = 0;
    for (int i = 0; i < 3; i++) {
        file.scene.simulation.contact_model = (enum ceduo_contact_model)i;
        keys[i] = ceduo_jobs_key(&file.scene);
    }
    assert_true(keys[0] != keys[1] && keys[1] != keys[2] && keys[0] != keys[2]);
}

/* A search goes before the figures, which go on after it; it finds what it finds alone, and leaves the scene as it is. */
static void a_search_comes_first(void **state)
{
    (void)state;
    struct seek seek = seek_of(500);
    double diameter = file.scene.rock.diameter.mean;
    show(false);
    ceduo_jobs_seek(jobs, &seek);
    assert_true(ceduo_jobs_wait_seek(jobs));
    struct jobs_news news = ceduo_jobs_news(jobs);
    assert_non_null(news.sought);
    assert_int_equal(news.sought->status, CEDUO_OK);
    EXPECT(file.scene.rock.diameter.mean, ==, diameter);
    struct ceduo_found alone;
    struct problems problems = {0};
    seek.threads = 1;
    assert_int_equal(ceduo_seek(&seek, &alone, &problems), CEDUO_OK);
    assert_true(alone.found);
    EXPECT(alone.value, ==, news.sought->found.value);
    assert_int_equal(alone.evaluations, news.sought->found.evaluations);
    release(&news);
    assert_false(ceduo_jobs_wait_seek(jobs));
    ceduo_jobs_wait(jobs);
    news = ceduo_jobs_news(jobs);
    assert_non_null(news.outlook);
    assert_null(news.sought);
    release(&news);
}

/* The other energy law beside the figures: of as many rocks as said, and asked for again where it alone changes. */
static void the_other_law_comes_along(void **state)
{
    (void)state;
    show(false);
    ceduo_jobs_wait(jobs);
    struct jobs_news news = ceduo_jobs_news(jobs);
    assert_non_null(news.others);
    assert_int_equal(news.others_options, 1);
    assert_int_equal(news.others_controls, file.scene.controls_count);
    assert_true(news.others[0].known && news.others[0].stems);
    assert_int_equal(news.others[0].model, CEDUO_DORREN);
    double before = news.others[0].reach_probability;
    release(&news);
    for (size_t i = 0; i < 2; i++)
        file.scene.options[0].belts[i].stand.fracture_ratio = 3; /* the scene's own law does not know it */
    assert_true(show(false));
    ceduo_jobs_wait(jobs);
    news = ceduo_jobs_news(jobs);
    assert_non_null(news.others);
    EXPECT(news.others[0].reach_probability, <, before);
    assert_null(news.outlook);
    release(&news);
    file.scene.simulation.contact_model = CEDUO_INDEX;
    show(false);
    ceduo_jobs_wait(jobs);
    news = ceduo_jobs_news(jobs);
    assert_null(news.others);
    release(&news);
}

/* The doubt goes from level to level; the same scene is asked for once, more levels go on where it is, none stops it. */
static void the_doubt_comes_last(void **state)
{
    (void)state;
    assert_true(ceduo_jobs_doubt(jobs, &file, 1));
    assert_false(ceduo_jobs_doubt(jobs, &file, 1));
    ceduo_jobs_wait(jobs);
    struct jobs_news news = ceduo_jobs_news(jobs);
    assert_non_null(news.doubted);
    assert_int_equal(news.doubted->level, 0);
    assert_int_equal(news.doubted->inputs.n, 12);
    assert_true(news.doubted->file.root == file.root);
    EXPECT(news.doubted->answer.figures[CEDUO_DOUBT_EXCEED].p5, <, news.doubted->answer.figures[CEDUO_DOUBT_EXCEED].p95);
    release(&news);
    assert_true(ceduo_jobs_doubt(jobs, &file, 2));
    assert_false(ceduo_jobs_doubt(jobs, &file, 1)); /* fewer are enough */
    ceduo_jobs_doubt(jobs, &file, 0);
    ceduo_jobs_wait(jobs);
    news = ceduo_jobs_news(jobs);
    assert_null(news.doubted);
    release(&news);
    file.scene.controls_count = 0;
    assert_true(ceduo_jobs_doubt(jobs, &file, 2));
    ceduo_jobs_wait(jobs);
    news = ceduo_jobs_news(jobs);
    assert_non_null(news.doubted); /* without a control there is nothing to be in doubt of */
    assert_int_equal(news.doubted->inputs.n, 0);
    release(&news);
    file.scene.controls_count = 1;
}

/* What is stopped ends soon, and nothing comes of it. */
static void a_search_is_stopped(void **state)
{
    (void)state;
    struct seek seek = seek_of(CEDUO_ROCKS_MOST);
    ceduo_jobs_seek(jobs, &seek);
    struct timespec moment = {.tv_nsec = 200000000};
    nanosleep(&moment, NULL);
    assert_true(ceduo_jobs_news(jobs).busy);
    double start = ceduo_clock();
    ceduo_jobs_stop_seek(jobs);
    ceduo_jobs_wait(jobs);
    EXPECT(ceduo_clock() - start, <, 1); /* 0.1 s where nobody else wants the machine */
    struct jobs_news news = ceduo_jobs_news(jobs);
    assert_null(news.sought);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_search_comes_first, set_up, tear_down),
        cmocka_unit_test_setup_teardown(nothing_of_an_older_scene_is_news, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_contact_model_makes_another_key, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_search_is_stopped, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_other_law_comes_along, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_doubt_comes_last, set_up, tear_down),
        cmocka_unit_test_setup_teardown(figures_and_years_come_to_an_end, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
