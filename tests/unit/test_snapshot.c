/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What runs give for pictures. */
#include "expect.h"
#include "local.h"

#include <gsl/gsl_statistics_double.h>

#include "unit/site.h"

static struct site s; /* before each test it is made anew, with wood or with the index */

static int wooded(void **state)
{
    (void)state;
    wooded_site_init(&s);
    return 0;
}

static int by_index(void **state)
{
    (void)state;
    site_init(&s);
    return 0;
}

/* The runs of the scene, flown. */
static struct ceduo_pool *pool_of(uint64_t rocks)
{
    struct ceduo_run_def def = ceduo_run_def_default(&s.scene);
    struct ceduo_pool *pool;
    def.rocks_max = 5000;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_extend(pool, rocks), CEDUO_OK);
    return pool;
}

static struct ceduo_snapshot *snapshot_of(const struct ceduo_snapshot_def *def)
{
    struct ceduo_snapshot *o;
    assert_int_equal(ceduo_snapshot_create(def, &o), CEDUO_OK);
    return o;
}

/* Of one pool. */
static struct ceduo_snapshot *snapshot_at(struct ceduo_pool *pool, size_t trajectories)
{
    return snapshot_of(&(struct ceduo_snapshot_def){.scene = &s.scene, .runs = pool, .trajectories = trajectories});
}

TEST_WITH(envelopes_lie_beyond_the_release, by_index, NULL)
{
    s.scene.release.x = (struct ceduo_number){10, 2, CEDUO_UNIFORM};
    LOCAL(ceduo_pool, pool) = pool_of(10);
    LOCAL(ceduo_snapshot, o) = snapshot_of(&(struct ceduo_snapshot_def){.scene = &s.scene, .runs = pool, .envelope_rocks = 10});
    assert_int_equal(o->cells, CEDUO_SNAPSHOT_CELLS);
    for (size_t i = 0; i < o->cells; i++) {
        EXPECT(o->cell_x[i], >, i > 0 ? o->cell_x[i - 1] : 12);
        EXPECT(o->cell_x[i], <=, 100);
    }
}

static void expect_sight(const struct ceduo_run_snapshot *sight, const struct ceduo_run *run)
{
    assert_non_null(sight);
    assert_int_equal(sight->simulated.rocks, ceduo_run_rocks(run));
    assert_int_equal(sight->envelope_rocks, ceduo_run_rocks(run));
    for (size_t c = 0; c < 2; c++) {
        const struct ceduo_arrivals *found = &sight->simulated.arrivals[c];
        struct ceduo_arrivals a;
        assert_int_equal(ceduo_run_arrivals(run, c, &a), CEDUO_OK);
        EXPECT(a.reached, >, 0);
        assert_int_equal(found->reached, a.reached);
        assert_int_equal(sight->energies[c].n, a.reached);
        EXPECT_NEAR(found->energy.mean, a.energy.mean, 1e-12 * a.energy.mean);
        /* Kept as floats. The deviation is as counted; the mean is not. */
        EXPECT_NEAR(gsl_stats_sd(sight->energies[c].values, 1, a.reached), found->energy.sd, 1e-6 * found->energy.sd);
    }
    for (size_t i = 1; i < CEDUO_SNAPSHOT_CELLS; i++)
        EXPECT(sight->envelopes[i].passed, <=, sight->envelopes[i - 1].passed);
    EXPECT(sight->envelopes[0].passed, >, 0);
}

TEST_WITH(snapshot_is_what_the_runs_say, wooded, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(300);
    LOCAL(ceduo_snapshot, o) = snapshot_of(&(struct ceduo_snapshot_def){
        .scene = &s.scene, .runs = pool, .envelope_rocks = CEDUO_ENVELOPE_ROCKS, .trajectories = 20});
    assert_int_equal(o->cells, CEDUO_SNAPSHOT_CELLS);
    assert_int_equal(o->controls, 2);
    assert_int_equal(o->options, 2);
    expect_sight(o->bare, ceduo_pool_find(pool, NULL));
    expect_sight(o->wooded[0], ceduo_pool_find(pool, &s.options[0]));
    EXPECT(o->wooded[0]->simulated.arrivals[1].reached, <, o->bare->simulated.arrivals[1].reached);
    assert_int_equal(o->bare->trajectories_count, 20);
    assert_int_equal(o->wooded[0]->trajectories_count, 20);
    assert_ptr_equal(ceduo_snapshot_find(o, &s.scene, 0), o->wooded[0]);
    assert_null(ceduo_snapshot_find(o, &s.scene, 2));
    assert_null(ceduo_snapshot_find(NULL, &s.scene, 0));
    ceduo_snapshot_free(NULL);
}

/* Without stems the rocks are those without forest: the same sight, and it is flown once. */
TEST_WITH(a_forest_without_stems_is_the_bare_slope, wooded, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(300);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 0);
    assert_int_equal(ceduo_pool_work(pool).runs, 2);
    assert_ptr_equal(o->wooded[1], o->bare);
    assert_ptr_not_equal(o->wooded[0], o->bare);
    for (size_t c = 0; c < 2; c++) {
        EXPECT(o->differences[c].reach.mean, ==, 0);
        double more = o->bare->simulated.arrivals[c].reach.mean - o->wooded[0]->simulated.arrivals[c].reach.mean;
        EXPECT_NEAR(o->differences[2 + c].reach.mean, more, 1e-12);
    }
}

/* With the contact model index there is one sight, that of all options. */
TEST_WITH(the_index_looks_at_the_bare_slope, by_index, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(300);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 0);
    assert_int_equal(ceduo_pool_work(pool).runs, 1);
    assert_null(o->wooded[0]);
    assert_null(o->wooded[1]);
    assert_ptr_equal(ceduo_snapshot_find(o, &s.scene, 0), o->bare);
    assert_ptr_equal(ceduo_snapshot_find(o, &s.scene, 1), o->bare);
}

/* Runs that are not there yet leave gaps. */
TEST_WITH(what_is_not_flown_yet_is_not_known, wooded, NULL)
{
    struct ceduo_run_def run_def = ceduo_run_def_default(&s.scene);
    LOCAL(ceduo_pool, pool);
    struct ceduo_run *run;
    assert_int_equal(ceduo_pool_create(&run_def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_run(pool, NULL, &run), CEDUO_OK);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool};
    struct ceduo_snapshot *o = snapshot_of(&def);
    assert_null(o->bare);
    ceduo_snapshot_free(o);
    assert_int_equal(ceduo_pool_extend(pool, 100), CEDUO_OK);
    o = snapshot_of(&def);
    assert_non_null(o->bare);
    assert_null(o->wooded[0]);
    assert_ptr_equal(o->wooded[1], o->bare);
    for (size_t i = 0; i < 4; i++)
        assert_true(isnan(o->differences[i].reach.mean));
    ceduo_snapshot_free(o);
}

/* Envelopes are of as many rocks as are asked for, and those of the last snapshot if it has as many. */
TEST_WITH(envelopes_are_kept, wooded, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(300);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .envelope_rocks = 400};
    const uint64_t rocks[] = {300, 400, 400};
    struct ceduo_snapshot *o[3];
    for (int i = 0; i < 3; i++) {
        assert_int_equal(ceduo_pool_extend(pool, 300 * (uint64_t)(i + 1)), CEDUO_OK);
        def.last = i > 0 ? o[i - 1] : NULL;
        o[i] = snapshot_of(&def);
        assert_int_equal(o[i]->bare->simulated.rocks, 300 * (i + 1));
        assert_int_equal(o[i]->bare->envelope_rocks, rocks[i]);
        assert_int_equal(o[i]->bare->envelopes[0].passed, rocks[i]);
    }
    assert_memory_equal(o[1]->wooded[0]->envelopes, o[2]->wooded[0]->envelopes, o[1]->cells * sizeof(struct ceduo_envelope));
    for (int i = 0; i < 3; i++)
        ceduo_snapshot_free(o[i]);
}

/* Of a forest that was just changed one sees what it was, but not where that is now the forest of another option; of an
 * option that was not there nothing. */
TEST_WITH(a_changed_forest_shows_what_it_was, wooded, NULL)
{
    static struct site b;
    wooded_site_init(&b);
    LOCAL(ceduo_pool, pool) = pool_of(100);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 0);
    struct ceduo_option options[4] = {b.options[0], b.options[1], s.options[0], b.options[0]};
    b.scene.options = options;
    b.belts[0].stand.u = 50e3;
    assert_ptr_equal(ceduo_snapshot_find(o, &b.scene, 0), o->wooded[0]);
    assert_ptr_equal(ceduo_snapshot_find(o, &b.scene, 1), o->wooded[1]);
    b.scene.options_count = 4;
    assert_null(ceduo_snapshot_find(o, &b.scene, 0));
    assert_ptr_equal(ceduo_snapshot_find(o, &b.scene, 2), o->wooded[0]);
    assert_null(ceduo_snapshot_find(o, &b.scene, 3));
}

/* What has not changed since the last snapshot is not read again but shared; who is freed first does not matter. */
TEST(sights_are_taken_over)
{
    static struct site b;
    for (int order = 0; order < 2; order++) {
        wooded(NULL);
        wooded_site_init(&b);
        b.belts[1].stand = b.belts[0].stand; /* trees where the other has none */
        b.belts[1].stand.shoots_count = 0;
        struct ceduo_pool *pool = pool_of(300);
        struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .trajectories = 5};
        struct ceduo_snapshot *first = snapshot_of(&def);
        ceduo_pool_set_scene(pool, &b.scene);
        def.scene = &b.scene;
        def.last = first;
        struct ceduo_snapshot *early = snapshot_of(&def);
        assert_null(early->wooded[1]);
        assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
        assert_int_equal(ceduo_pool_extend(pool, 300), CEDUO_OK);
        def.last = early;
        struct ceduo_snapshot *second = snapshot_of(&def);
        assert_ptr_equal(second->bare, first->bare);
        assert_ptr_equal(second->wooded[0], first->wooded[0]);
        assert_non_null(second->wooded[1]);
        assert_ptr_not_equal(second->wooded[1], first->wooded[1]);
        assert_int_equal(atomic_load(&first->wooded[0]->references), 3);
        ceduo_snapshot_free(order ? first : second);
        ceduo_snapshot_free(early);
        struct ceduo_snapshot *left = order ? second : first;
        assert_int_equal(left->wooded[0]->trajectories_count, 5);
        assert_int_equal(atomic_load(&left->wooded[0]->references), 1);
        EXPECT(left->wooded[0]->trajectories[4].n, >=, 2);
        ceduo_snapshot_free(left);
        ceduo_pool_free(pool);
    }
}

TEST_WITH(longer_runs_are_read_again, wooded, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(300);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool};
    LOCAL(ceduo_snapshot, first) = snapshot_of(&def);
    assert_int_equal(ceduo_pool_extend(pool, 301), CEDUO_OK);
    def.last = first;
    LOCAL(ceduo_snapshot, second) = snapshot_of(&def);
    assert_ptr_not_equal(second->bare, first->bare);
    assert_ptr_not_equal(second->wooded[0], first->wooded[0]);
    assert_int_equal(second->wooded[0]->simulated.rocks, 301);
}

/* Starts and ends where the rock does, never far below the ground, and never jumps. */
TEST_WITH(trajectories_follow_the_rocks, wooded, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(20);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 20);
    uint64_t hit = 0;
    for (uint64_t i = 0; i < 40; i++) {
        const struct ceduo_option *option = i % 2 ? &s.options[0] : NULL;
        const struct ceduo_polyline t = (option ? o->wooded[0] : o->bare)->trajectories[i / 2];
        struct ceduo_trajectory way;
        assert_int_equal(ceduo_trajectory_run(&s.scene, option, i / 2, NULL, &way, NULL), CEDUO_OK);
        hit += way.stems_hit;
        EXPECT(t.n, >=, 2);
        EXPECT(t.x[0], ==, way.x0);
        EXPECT(t.z[0], ==, way.z0);
        EXPECT(t.x[t.n - 1], ==, way.x);
        EXPECT(t.z[t.n - 1], ==, way.z);
        for (size_t k = 0; k < t.n; k++)
            if (t.x[k] >= 0 && t.x[k] <= 100)
                EXPECT(t.z[k], >, ceduo_slope_height(&s.scene.slope, t.x[k]) - 0.1);
    }
    EXPECT(hit, >, 0);
}

/* A rock thrown far: every point of its line and the middle of every chord lies on the parabola. */
TEST_WITH(flights_are_sampled_finely, by_index, NULL)
{
    s.scene.release.vx = ceduo_number(10);
    s.scene.release.vz = ceduo_number(10);
    LOCAL(ceduo_pool, pool) = pool_of(1);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 1);
    const struct ceduo_polyline t = o->bare->trajectories[0];
    size_t checked = 0;
    for (size_t i = 1; i < t.n && t.x[i] < 20; i++, checked++) {
        double z = (t.z[i - 1] + t.z[i]) / 2, seconds = (t.x[i - 1] + t.x[i]) / 2 / 10;
        EXPECT_NEAR(z, (10 - 0.5 * CEDUO_GRAVITY * seconds) * seconds, 0.06); /* a step is 0.05 m */
    }
    EXPECT(checked, >, 3);
}

/* A rock that bounces in its place, 20 m high, until it is given up: drawn whole it would have millions of points. */
static int endless(void **state)
{
    by_index(state);
    for (int i = 0; i < 3; i++)
        s.z[i] = 0;
    for (int i = 0; i < 2; i++)
        s.segments[i] = (struct ceduo_segment){
            .rn = ceduo_number(1), .rt = ceduo_number(1), .roughness_m = NAN, .roughness_rad = 0, .friction = .5};
    s.scene.release = (struct ceduo_release){.x = ceduo_number(25), .height = ceduo_number(20)};
    s.scene.simulation.law = CEDUO_LAW_LUMPED;
    return 0;
}

TEST_WITH(an_endless_trajectory_is_drawn_in_part, endless, NULL)
{
    LOCAL(ceduo_pool, pool) = pool_of(1);
    LOCAL(ceduo_snapshot, o) = snapshot_at(pool, 1);
    const struct ceduo_polyline t = o->bare->trajectories[0];
    struct ceduo_trajectory way;
    assert_int_equal(ceduo_trajectory_run(&s.scene, NULL, 0, NULL, &way, NULL), CEDUO_OK);
    assert_int_equal(way.contacts, CEDUO_CONTACTS_MAX);
    EXPECT(t.n, >, 10000);
    EXPECT(t.n, <=, 20001);
    EXPECT(t.x[t.n - 1], ==, way.x);
    EXPECT(t.z[t.n - 1], ==, way.z);
}

TEST_WITH(nobody_waits_for_an_endless_trajectory, endless, NULL)
{
    atomic_bool cancel = true;
    LOCAL(ceduo_pool, pool) = pool_of(1);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .trajectories = 1, .cancel = &cancel};
    LOCAL(ceduo_snapshot, o);
    assert_int_equal(ceduo_snapshot_create(&def, &o), CEDUO_CANCELLED);
    assert_null(o);
    cancel = false;
    o = snapshot_of(&def);
    assert_int_equal(o->bare->trajectories_count, 1);
}
