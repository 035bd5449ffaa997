/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots of runs for pictures. */
#include "ceduo/simulate.h"
#include "core/runs/pool.h"
#include "core/runs/run.h"
#include "expect.h"
#include "local.h"

#include <gsl/gsl_statistics_double.h>

#include "unit/site.h"

static struct site s; /* set up again before each test, with stems or with the index */

static int set_up_stems(void **state)
{
    (void)state;
    wooded_site_init(&s);
    return 0;
}

static int set_up_index(void **state)
{
    (void)state;
    site_init(&s);
    return 0;
}

/* Return the simulated runs of the scene. */
static struct ceduo_pool *make_pool(uint64_t rocks)
{
    struct ceduo_run_def def = ceduo_run_def_default(&s.scene);
    struct ceduo_pool *pool;
    def.rocks_max = 5000;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_extend(pool, rocks), CEDUO_OK);
    return pool;
}

static struct ceduo_snapshot *make_snapshot(const struct ceduo_snapshot_def *def)
{
    struct ceduo_snapshot *snapshot;
    assert_int_equal(ceduo_snapshot_create(def, &snapshot), CEDUO_OK);
    return snapshot;
}

/* Return the snapshot of a pool. */
static struct ceduo_snapshot *make_pool_snapshot(struct ceduo_pool *pool, size_t trajectories)
{
    return make_snapshot(&(struct ceduo_snapshot_def){.scene = &s.scene, .runs = pool, .trajectories = trajectories});
}

TEST_WITH(envelopes_lie_beyond_the_release, set_up_index, NULL)
{
    s.scene.release.x = (struct ceduo_number){10, 2, CEDUO_SPREAD_UNIFORM};
    LOCAL(ceduo_pool, pool) = make_pool(10);
    LOCAL(ceduo_snapshot, snapshot) =
        make_snapshot(&(struct ceduo_snapshot_def){.scene = &s.scene, .runs = pool, .envelope_rocks = 10});
    assert_int_equal(snapshot->cells, CEDUO_SNAPSHOT_CELLS);
    for (size_t i = 0; i < snapshot->cells; i++) {
        EXPECT(snapshot->cell_x[i], >, i > 0 ? snapshot->cell_x[i - 1] : 12);
        EXPECT(snapshot->cell_x[i], <=, 100);
    }
}

static void expect_run(const struct ceduo_run_snapshot *snapshot, const struct ceduo_run *run)
{
    assert_non_null(snapshot);
    assert_int_equal(snapshot->simulated.rocks, ceduo_run_rocks(run));
    assert_int_equal(snapshot->envelope_rocks, ceduo_run_rocks(run));
    for (size_t c = 0; c < 2; c++) {
        const struct ceduo_arrivals *found = &snapshot->simulated.arrivals[c];
        struct ceduo_arrivals a;
        assert_int_equal(ceduo_run_arrivals(run, c, &a), CEDUO_OK);
        EXPECT(a.reached, >, 0);
        assert_int_equal(found->reached, a.reached);
        assert_int_equal(snapshot->energies[c].n, a.reached);
        EXPECT_NEAR(found->energy.mean, a.energy.mean, 1e-12 * a.energy.mean);
        /* Energies are kept as floats. */
        EXPECT_NEAR(gsl_stats_sd(snapshot->energies[c].values, 1, a.reached), found->energy.sd, 1e-6 * found->energy.sd);
    }
    for (size_t i = 1; i < CEDUO_SNAPSHOT_CELLS; i++)
        EXPECT(snapshot->envelopes[i].passed, <=, snapshot->envelopes[i - 1].passed);
    EXPECT(snapshot->envelopes[0].passed, >, 0);
}

TEST_WITH(snapshots_have_the_results_of_the_runs, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    LOCAL(ceduo_snapshot, snapshot) = make_snapshot(&(struct ceduo_snapshot_def){
        .scene = &s.scene, .runs = pool, .envelope_rocks = CEDUO_ENVELOPE_ROCKS, .trajectories = 20});
    assert_int_equal(snapshot->cells, CEDUO_SNAPSHOT_CELLS);
    assert_int_equal(snapshot->controls, 2);
    assert_int_equal(snapshot->options, 2);
    expect_run(snapshot->bare, ceduo_pool_find(pool, NULL));
    expect_run(snapshot->wooded[0], ceduo_pool_find(pool, &s.options[0]));
    EXPECT(snapshot->wooded[0]->simulated.arrivals[1].reached, <, snapshot->bare->simulated.arrivals[1].reached);
    assert_int_equal(snapshot->bare->trajectories_count, 20);
    assert_int_equal(snapshot->wooded[0]->trajectories_count, 20);
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &s.scene, 0), snapshot->wooded[0]);
    assert_null(ceduo_snapshot_find(snapshot, &s.scene, 2));
    assert_null(ceduo_snapshot_find(NULL, &s.scene, 0));
    ceduo_snapshot_free(NULL);
}

/* Without stems rocks move as without forest: both share one simulation and one result. */
TEST_WITH(a_forest_without_stems_has_the_result_without_forest, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 0);
    assert_int_equal(ceduo_pool_work(pool).runs, 2);
    assert_ptr_equal(snapshot->wooded[1], snapshot->bare);
    assert_ptr_not_equal(snapshot->wooded[0], snapshot->bare);
    for (size_t c = 0; c < 2; c++) {
        EXPECT(snapshot->differences[c].reach.mean, ==, 0);
        double difference =
            snapshot->bare->simulated.arrivals[c].reach.mean - snapshot->wooded[0]->simulated.arrivals[c].reach.mean;
        EXPECT_NEAR(snapshot->differences[2 + c].reach.mean, difference, 1e-12);
    }
}

/* With the contact model index all options share the result without forest. */
TEST_WITH(the_index_has_the_result_without_forest, set_up_index, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 0);
    assert_int_equal(ceduo_pool_work(pool).runs, 1);
    assert_null(snapshot->wooded[0]);
    assert_null(snapshot->wooded[1]);
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &s.scene, 0), snapshot->bare);
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &s.scene, 1), snapshot->bare);
}

/* Runs that are not simulated yet leave gaps. */
TEST_WITH(runs_not_simulated_yet_leave_gaps, set_up_stems, NULL)
{
    struct ceduo_run_def run_def = ceduo_run_def_default(&s.scene);
    LOCAL(ceduo_pool, pool);
    struct ceduo_run *run;
    assert_int_equal(ceduo_pool_create(&run_def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_run(pool, NULL, &run), CEDUO_OK);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool};
    struct ceduo_snapshot *snapshot = make_snapshot(&def);
    assert_null(snapshot->bare);
    ceduo_snapshot_free(snapshot);
    assert_int_equal(ceduo_pool_extend(pool, 100), CEDUO_OK);
    snapshot = make_snapshot(&def);
    assert_non_null(snapshot->bare);
    assert_null(snapshot->wooded[0]);
    assert_ptr_equal(snapshot->wooded[1], snapshot->bare);
    for (size_t i = 0; i < 4; i++)
        assert_true(isnan(snapshot->differences[i].reach.mean));
    ceduo_snapshot_free(snapshot);
}

/* Envelopes use the requested number of rocks; the last snapshot's are kept if they have enough. */
TEST_WITH(envelopes_are_kept, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .envelope_rocks = 400};
    const uint64_t rocks[] = {300, 400, 400};
    struct ceduo_snapshot *snapshot[3];
    for (int i = 0; i < 3; i++) {
        assert_int_equal(ceduo_pool_extend(pool, 300 * (uint64_t)(i + 1)), CEDUO_OK);
        def.last = i > 0 ? snapshot[i - 1] : NULL;
        snapshot[i] = make_snapshot(&def);
        assert_int_equal(snapshot[i]->bare->simulated.rocks, 300 * (i + 1));
        assert_int_equal(snapshot[i]->bare->envelope_rocks, rocks[i]);
        assert_int_equal(snapshot[i]->bare->envelopes[0].passed, rocks[i]);
    }
    assert_memory_equal(snapshot[1]->wooded[0]->envelopes, snapshot[2]->wooded[0]->envelopes,
                        snapshot[1]->cells * sizeof(struct ceduo_envelope));
    for (int i = 0; i < 3; i++)
        ceduo_snapshot_free(snapshot[i]);
}

/* A forest that was just changed shows its former result, unless this is now the forest of another option. A new option shows
 * nothing. */
TEST_WITH(a_changed_forest_shows_its_former_result, set_up_stems, NULL)
{
    static struct site b;
    wooded_site_init(&b);
    LOCAL(ceduo_pool, pool) = make_pool(100);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 0);
    struct ceduo_option options[4] = {b.options[0], b.options[1], s.options[0], b.options[0]};
    b.scene.options = options;
    b.belts[0].stand.u = 50e3;
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &b.scene, 0), snapshot->wooded[0]);
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &b.scene, 1), snapshot->wooded[1]);
    b.scene.options_count = 4;
    assert_null(ceduo_snapshot_find(snapshot, &b.scene, 0));
    assert_ptr_equal(ceduo_snapshot_find(snapshot, &b.scene, 2), snapshot->wooded[0]);
    assert_null(ceduo_snapshot_find(snapshot, &b.scene, 3));
}

/* Results that have not changed since the last snapshot are shared, and can be freed in any order. */
TEST(unchanged_results_are_shared)
{
    static struct site b;
    for (int order = 0; order < 2; order++) {
        set_up_stems(NULL);
        wooded_site_init(&b);
        b.belts[1].stand = b.belts[0].stand; /* trees instead of no stems */
        b.belts[1].stand.shoots_count = 0;
        struct ceduo_pool *pool = make_pool(300);
        struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .trajectories = 5};
        struct ceduo_snapshot *first = make_snapshot(&def);
        ceduo_pool_set_scene(pool, &b.scene);
        def.scene = &b.scene;
        def.last = first;
        struct ceduo_snapshot *partial = make_snapshot(&def);
        assert_null(partial->wooded[1]);
        assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
        assert_int_equal(ceduo_pool_extend(pool, 300), CEDUO_OK);
        def.last = partial;
        struct ceduo_snapshot *second = make_snapshot(&def);
        assert_ptr_equal(second->bare, first->bare);
        assert_ptr_equal(second->wooded[0], first->wooded[0]);
        assert_non_null(second->wooded[1]);
        assert_ptr_not_equal(second->wooded[1], first->wooded[1]);
        assert_int_equal(atomic_load(&first->wooded[0]->references), 3);
        ceduo_snapshot_free(order ? first : second);
        ceduo_snapshot_free(partial);
        struct ceduo_snapshot *remaining = order ? second : first;
        assert_int_equal(remaining->wooded[0]->trajectories_count, 5);
        assert_int_equal(atomic_load(&remaining->wooded[0]->references), 1);
        EXPECT(remaining->wooded[0]->trajectories[4].n, >=, 2);
        ceduo_snapshot_free(remaining);
        ceduo_pool_free(pool);
    }
}

TEST_WITH(longer_runs_are_read_again, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool};
    LOCAL(ceduo_snapshot, first) = make_snapshot(&def);
    assert_int_equal(ceduo_pool_extend(pool, 301), CEDUO_OK);
    def.last = first;
    LOCAL(ceduo_snapshot, second) = make_snapshot(&def);
    assert_ptr_not_equal(second->bare, first->bare);
    assert_ptr_not_equal(second->wooded[0], first->wooded[0]);
    assert_int_equal(second->wooded[0]->simulated.rocks, 301);
}

/* A fence changes no run, but the rocks that pass it: results with the old fence are not shared. */
TEST_WITH(another_fence_is_read_again, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(300);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool};
    LOCAL(ceduo_snapshot, first) = make_snapshot(&def);
    s.controls[0].fence = (struct ceduo_fence){.height = 3, .energy = 1e5};
    def.last = first;
    LOCAL(ceduo_snapshot, second) = make_snapshot(&def);
    EXPECT_NAN(first->bare->simulated.arrivals[0].fence->defeated.mean);
    EXPECT(second->bare->simulated.arrivals[0].fence->defeated.mean, >, 0);
}

/* A trajectory has the start and the end of its rock, and is never far below the ground. */
TEST_WITH(trajectories_follow_the_rocks, set_up_stems, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(20);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 20);
    uint64_t hit = 0;
    for (uint64_t i = 0; i < 40; i++) {
        const struct ceduo_option *option = i % 2 ? &s.options[0] : NULL;
        const struct ceduo_polyline t = (option ? snapshot->wooded[0] : snapshot->bare)->trajectories[i / 2];
        struct ceduo_trajectory trajectory;
        assert_int_equal(ceduo_trajectory_run(&s.scene, option, i / 2, NULL, &trajectory, NULL), CEDUO_OK);
        hit += trajectory.stems_hit;
        EXPECT(t.n, >=, 2);
        EXPECT(t.x[0], ==, trajectory.x0);
        EXPECT(t.z[0], ==, trajectory.z0);
        EXPECT(t.x[t.n - 1], ==, trajectory.x);
        EXPECT(t.z[t.n - 1], ==, trajectory.z);
        for (size_t k = 0; k < t.n; k++)
            if (t.x[k] >= 0 && t.x[k] <= 100)
                EXPECT(t.z[k], >, ceduo_slope_height(&s.scene.slope, t.x[k]) - 0.1);
    }
    EXPECT(hit, >, 0);
}

/* Throw a rock far: every point of its polyline, and the middle of every chord, lies on the parabola. */
TEST_WITH(flights_are_sampled_finely, set_up_index, NULL)
{
    s.scene.release.vx = ceduo_number(10);
    s.scene.release.vz = ceduo_number(10);
    LOCAL(ceduo_pool, pool) = make_pool(1);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 1);
    const struct ceduo_polyline t = snapshot->bare->trajectories[0];
    size_t checked = 0;
    for (size_t i = 1; i < t.n && t.x[i] < 20; i++, checked++) {
        double z = (t.z[i - 1] + t.z[i]) / 2, seconds = (t.x[i - 1] + t.x[i]) / 2 / 10;
        EXPECT_NEAR(z, (10 - 0.5 * CEDUO_GRAVITY * seconds) * seconds, 0.06); /* step: 0.05 m */
    }
    EXPECT(checked, >, 3);
}

/* A rock that bounces in its place, 20 m high, until the contact limit. All its points would be millions. */
static int set_up_endless(void **state)
{
    set_up_index(state);
    for (int i = 0; i < 3; i++)
        s.z[i] = 0;
    for (int i = 0; i < 2; i++)
        s.segments[i] = (struct ceduo_segment){
            .rn = ceduo_number(1), .rt = ceduo_number(1), .roughness_m = NAN, .roughness_rad = 0, .friction = .5};
    s.scene.release = (struct ceduo_release){.x = ceduo_number(25), .height = ceduo_number(20)};
    s.scene.simulation.law = CEDUO_LAW_LUMPED;
    return 0;
}

TEST_WITH(an_endless_trajectory_is_drawn_in_part, set_up_endless, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(1);
    LOCAL(ceduo_snapshot, snapshot) = make_pool_snapshot(pool, 1);
    const struct ceduo_polyline t = snapshot->bare->trajectories[0];
    struct ceduo_trajectory trajectory;
    assert_int_equal(ceduo_trajectory_run(&s.scene, NULL, 0, NULL, &trajectory, NULL), CEDUO_OK);
    assert_int_equal(trajectory.contacts, CEDUO_CONTACTS_MAX);
    EXPECT(t.n, >, 10000);
    EXPECT(t.n, <=, 20001);
    EXPECT(t.x[t.n - 1], ==, trajectory.x);
    EXPECT(t.z[t.n - 1], ==, trajectory.z);
}

TEST_WITH(an_endless_trajectory_can_be_cancelled, set_up_endless, NULL)
{
    atomic_bool cancel = true;
    LOCAL(ceduo_pool, pool) = make_pool(1);
    struct ceduo_snapshot_def def = {.scene = &s.scene, .runs = pool, .trajectories = 1, .cancel = &cancel};
    LOCAL(ceduo_snapshot, snapshot);
    assert_int_equal(ceduo_snapshot_create(&def, &snapshot), CEDUO_CANCELLED);
    assert_null(snapshot);
    cancel = false;
    snapshot = make_snapshot(&def);
    assert_int_equal(snapshot->bare->trajectories_count, 1);
}
