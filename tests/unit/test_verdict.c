/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The live verdict: it comes with the first thousand rocks, what is known stays known while figures become finer, and
 * what was clear is not taken back. */
#include "expect.h"

#include <math.h>
#include <poll.h>

#include "tui/figures.h"

static struct scene_file file;
static struct figures figures;

static void open_scene(const char *path)
{
    struct problems problems = {0};
    assert_true(ceduo_scene_read(&file, path, NULL, 0, &problems));
    assert_true(ceduo_figures_create(&figures, 2));
}

static void close_scene(void)
{
    ceduo_figures_free(&figures);
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
    for (size_t i = 0; i < figures.result->options_count; i++)
        if (figures.result->options[i].wooded.rocks < fewest)
            fewest = figures.result->options[i].wooded.rocks;
    return fewest;
}

/* Marked where another yields more and lets fewer rocks through. */
static void expect_beaten(const struct ceduo_verdict *v)
{
    for (size_t i = 0; i < v->n; i++) {
        bool beaten = false;
        for (size_t k = 0; k < v->n; k++)
            beaten = beaten || (k != i && v->choices[k].yield.cut_per_year > v->choices[i].yield.cut_per_year &&
                                v->choices[k].mean.mean < v->choices[i].mean.mean);
        assert_int_equal(v->choices[i].beaten, beaten);
    }
    assert_true(v->choices[0].beaten && v->choices[1].beaten);
    assert_false(v->choices[2].beaten || v->choices[3].beaten); /* one yields more, the other protects better */
}

static void what_is_clear_stays(void **state)
{
    (void)state;
    struct watch today = {.best = SIZE_MAX}, rotation = {.best = SIZE_MAX};
    size_t looks = 0, shares = 0;
    bool failed;
    open_scene("profiles/scenes/rotation.yaml");
    ceduo_figures_follow(&figures, &file.scene, 1, true);
    while (figures.busy) {
        struct pollfd fd = {.fd = ceduo_jobs_fd(figures.jobs), .events = POLLIN};
        poll(&fd, 1, 1000);
        if (!ceduo_figures_news(&figures, &file.scene, &failed) || !figures.result)
            continue;
        assert_false(failed);
        size_t known = 0;
        for (size_t i = 0; i < figures.verdict.n; i++)
            known += isnan(figures.verdict.choices[i].mean.mean) ? 0 : 1;
        assert_true(known >= shares); /* no share goes back to unknown */
        shares = known;
        watch(&today, &figures.verdict.today, fewest_rocks());
        watch(&rotation, &figures.verdict.rotation, figures.rocks);
        looks++;
    }
    assert_true(today.known && rotation.known);
    EXPECT(today.rocks, ==, FLIGHTS_FIRST); /* told from the first thousand rocks */
    EXPECT(rotation.rocks, ==, FLIGHTS_FIRST);
    EXPECT(today.best, ==, 0);    /* the simple coppice before its cut, */
    EXPECT(rotation.best, ==, 3); /* the large reserves over the rotation: 127 and 277 of 1000 */
    EXPECT(looks, >, 6);          /* progress is shown */
    EXPECT(figures.done, ==, figures.all);
    expect_beaten(&figures.verdict);
    close_scene();
}

/* An edit of one stand: the others' years stay, those of the old stand do not count. */
static void an_edit_asks_for_its_years_alone(void **state)
{
    (void)state;
    bool failed;
    open_scene("profiles/scenes/rotation.yaml");
    file.scene.options_count = 2;
    ceduo_figures_follow(&figures, &file.scene, 0, true);
    ceduo_jobs_wait(figures.jobs);
    ceduo_figures_news(&figures, &file.scene, &failed);
    assert_true(figures.verdict.rotation.known);
    struct ceduo_belt *belt = &file.scene.options[1].belts[0];
    double before = figures.verdict.choices[1].mean.mean;
    belt->stand.cutting.stay_per_ha[1] *= 4;
    ceduo_figures_follow(&figures, &file.scene, 0, true);
    EXPECT(figures.verdict.choices[0].mean.mean, >, 0);
    assert_true(isnan(figures.verdict.choices[1].mean.mean)); /* not that of the stand before */
    assert_false(figures.verdict.rotation.known);
    ceduo_jobs_wait(figures.jobs);
    ceduo_figures_news(&figures, &file.scene, &failed);
    assert_true(figures.verdict.rotation.known);
    EXPECT(figures.verdict.choices[1].mean.mean, <, before); /* four times as many of the second oldest */
    close_scene();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_clear_stays),
        cmocka_unit_test(an_edit_asks_for_its_years_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
