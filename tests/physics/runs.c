/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "runs.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"

#include <math.h>
#include <stdlib.h>

#include "expect.h"
#include "local.h"

struct ceduo_run *make_run(const struct ceduo_run_def *def, uint64_t rocks)
{
    struct ceduo_run *run;
    assert_int_equal(ceduo_run_create(def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), rocks);
    return run;
}

struct ceduo_run *run_option(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                             unsigned threads)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.option = option;
    def.rocks_max = rocks;
    def.threads = threads;
    return make_run(&def, rocks);
}

struct ceduo_arrivals read_arrivals(const struct ceduo_run *run, size_t control)
{
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_arrivals(run, control, &a), CEDUO_OK);
    return a;
}

struct ceduo_ends read_ends(const struct ceduo_run *run)
{
    struct ceduo_ends ends;
    assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK);
    return ends;
}

void expect_same_run(const struct ceduo_run *a, const struct ceduo_run *b)
{
    struct ceduo_arrivals x = read_arrivals(a, 0), y = read_arrivals(b, 0);
    assert_memory_equal(&x, &y, sizeof x);
    struct ceduo_ends p = read_ends(a), q = read_ends(b);
    assert_memory_equal(&p, &q, sizeof p);
    struct ceduo_stem_counts s = ceduo_run_stems(a), t = ceduo_run_stems(b);
    assert_memory_equal(&s, &t, sizeof s);
    assert_int_equal(ceduo_run_contacts(a), ceduo_run_contacts(b));
}

void expect_same_however(struct ceduo_run_def def, uint64_t rocks)
{
    static const unsigned threads[] = {2, 5, 16};
    const uint64_t to[] = {999, 1024, rocks / 4, rocks / 4, 3 * rocks / 5, rocks};
    def.rocks_max = rocks;
    def.threads = 1;
    LOCAL(ceduo_run, one) = make_run(&def, rocks);
    for (size_t t = 0; t < LENGTH(threads); t++) {
        def.threads = threads[t];
        LOCAL(ceduo_run, many) = make_run(&def, rocks);
        expect_same_run(one, many);
    }
    def.threads = 3;
    LOCAL(ceduo_run, steps) = make_run(&def, 100);
    for (size_t i = 0; i < LENGTH(to); i++)
        assert_int_equal(ceduo_run_extend(steps, to[i]), CEDUO_OK);
    expect_same_run(one, steps);
    const struct ceduo_difference d = ceduo_run_difference(steps, one, 0);
    EXPECT(d.energy_per_released.mean, ==, 0);
    assert_false(d.energy_per_released.se > 0); /* NaN if no pair differs */
}

/* Hits on a trajectory: all, and those before control 0. */
struct hits {
    double control;
    uint64_t all, before;
};

static void count_hit(void *context, const struct ceduo_stem_encounter *stem)
{
    struct hits *hits = context;
    hits->all += stem->hit;
    hits->before += stem->hit && stem->x < hits->control;
}

struct followed expect_as_followed(struct ceduo_run_def def, uint64_t rocks)
{
    def.rocks_max = rocks;
    LOCAL(ceduo_run, run) = make_run(&def, rocks);
    LOCAL(ceduo_tracer, f) = ceduo_tracer_create(def.scene, def.option);
    const double *energies = ceduo_run_samples(run, 0, CEDUO_SAMPLE_ENERGY);
    const double *speeds = ceduo_run_samples(run, 0, CEDUO_SAMPLE_SPEED);
    const double *heights = ceduo_run_samples(run, 0, CEDUO_SAMPLE_HEIGHT);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    struct ceduo_stem_counts sum = {0}, counts = ceduo_run_stems(run);
    struct ceduo_moments contacts = {0};
    struct followed found = {0};
    uint64_t all = 0;
    for (uint64_t rock = 0; rock < rocks; rock++) {
        struct ceduo_trajectory w;
        struct ceduo_crossing c;
        struct hits hits = {.control = def.scene->controls[0].x};
        enum ceduo_status status =
            ceduo_tracer_run(f, rock, &(struct ceduo_trajectory_callbacks){.stem = count_hit, .context = &hits}, &w, &c);
        assert_true(status == CEDUO_OK || status == CEDUO_BAD_ROCK);
        found.bad += status == CEDUO_BAD_ROCK;
        if (status != CEDUO_OK)
            continue;
        assert_int_equal(w.stems_hit, hits.all);
        all += w.contacts;
        sum.drawn += w.stems_drawn;
        sum.hit += w.stems_hit;
        sum.met += w.stools_met;
        EXPECT(isnan(energies[rock]), ==, !c.reached);
        if (!c.reached)
            continue;
        double speed = sqrt(c.vx * c.vx + c.vz * c.vz);
        EXPECT(energies[rock], ==, .5 * w.rock.mass * (speed * speed) + .5 * w.rock.moment * (c.spin * c.spin));
        EXPECT(speeds[rock], ==, speed);
        EXPECT(heights[rock], ==, c.height);
        assert_int_equal(c.stems_hit, hits.before);
        ceduo_moments_add(&contacts, (double)c.stems_hit);
        found.reached++;
    }
    assert_int_equal(ceduo_run_contacts(run), all);
    EXPECT_SAME(sum, counts, drawn, hit, met);
    EXPECT_IS(a, (reached, found.reached), (unfinished, found.bad));
    assert_int_equal(read_ends(run).count[CEDUO_END_UNFINISHED], found.bad);
    if (def.option) {
        EXPECT_NEAR(a.contacts.mean, contacts.mean, 1e-12 * contacts.mean);
        EXPECT_NEAR(a.contacts.se, ceduo_moments_se(&contacts), 1e-9 * a.contacts.se);
    }
    return found;
}
