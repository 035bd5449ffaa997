/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and pools at their limits: parts, and rocks that cannot be drawn or never end. */
#include "core/runs/fence.h"
#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/variants.h"
#include "core/runs/year_runs.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "core/walk/envelope.h"
#include "physics/paper_site.h"
#include "physics/runs.h"

static struct paper_site site;

/* Some rocks are drawn too light to compute: exactly these are unfinished, at each control. */
TEST(rocks_that_cannot_be_drawn)
{
    paper_site_init(&site);
    site.scene.rock = ceduo_scene_default().rock;
    site.scene.rock.diameter.mean = .5;
    site.scene.rock.mass = (struct ceduo_number){.mean = 3e-322, .spread = 2.9e-322, .kind = CEDUO_SPREAD_UNIFORM};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct followed found = expect_as_followed(def, 300);
    EXPECT(found.bad, >, 50);
    EXPECT(found.bad, <, 250);
}

/* One number of the release has a spread: a run gives the same rocks as one by one. */
TEST(each_spread_is_drawn)
{
    for (int i = 0; i < 5; i++) {
        paper_site_init(&site);
        site.scene.simulation.law = CEDUO_LAW_CRSP;
        struct ceduo_release *r = &site.scene.release;
        r->x.mean = r->height.mean = 3;
        struct ceduo_number *const numbers[] = {&r->x, &r->height, &r->vx, &r->vz, &r->spin};
        numbers[i]->spread = .5;
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        EXPECT(expect_as_followed(def, 40).reached, >, 5);
    }
}

static void count_piece(void *context, const struct ceduo_trajectory_segment *piece)
{
    (void)piece;
    ++*(unsigned *)context;
}

static void count_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    (void)stem;
    *(unsigned *)context += 1000000;
}

/* Callbacks for segments, stems or nothing change no result. */
TEST(callbacks_change_nothing)
{
    unsigned count;
    const struct ceduo_trajectory_callbacks watches[] = {{NULL, count_piece, count_stem, &count},
                                                         {NULL, count_piece, NULL, &count},
                                                         {NULL, NULL, count_stem, &count},
                                                         {NULL, NULL, NULL, &count}};
    paper_site_init(&site);
    site.plots[0].shoots.height = site.plots[1].trees.height = .3; /* the rock flies over some */
    for (uint64_t rock = 0; rock < 60; rock++) {
        const struct ceduo_option *option = rock % 2 == 0 ? &site.option : NULL;
        struct ceduo_trajectory alone, trajectory;
        assert_int_equal(ceduo_trajectory_run(&site.scene, option, rock, NULL, &alone, NULL), CEDUO_OK);
        for (int i = 0; i < 4; i++) {
            count = 0;
            assert_int_equal(ceduo_trajectory_run(&site.scene, option, rock, &watches[i], &trajectory, NULL), CEDUO_OK);
            EXPECT(trajectory.x, ==, alone.x);
            EXPECT(trajectory.z, ==, alone.z);
            EXPECT(trajectory.end, ==, alone.end);
            EXPECT(trajectory.contacts, ==, alone.contacts);
            EXPECT(trajectory.stems_hit, ==, alone.stems_hit);
            EXPECT(trajectory.stems_drawn, ==, alone.stems_drawn);
            assert_int_equal(count % 1000000 > 0, i < 2);
            EXPECT(count / 1000000, >=, (i % 2 == 0 ? alone.stems_hit : 0));
            assert_true(i % 2 == 0 || count < 1000000);
        }
    }
}

/* A rock that bounces in place for ever is aborted, unfinished before the control; it is not in the cells. */
TEST(a_rock_without_end)
{
    static const double places[] = {50};
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    slope->vertices = 2;
    slope->z[1] = slope->z[0];
    site.option.belts_count = 0;
    slope->segments[0] = (struct ceduo_segment){ceduo_number(1), ceduo_number(1), NAN, 0, .5, .6};
    site.control.x = slope->x[1];
    site.scene.release =
        (struct ceduo_release){ceduo_number(.5), ceduo_number(1), ceduo_number(0), ceduo_number(0), ceduo_number(0), false, 0};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 1);
    struct ceduo_arrivals a;
    struct ceduo_envelope e;
    assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
    const struct ceduo_envelopes_def envelopes = {.scene = &site.scene, .rocks = 1, .places = 1, .x = places};
    assert_int_equal(ceduo_envelopes(&envelopes, &e), CEDUO_OK);
    EXPECT(a.unfinished, ==, 1);
    EXPECT(a.reached, ==, 0);
    EXPECT(e.passed, ==, 0);
    assert_int_equal(ceduo_run_contacts(run), CEDUO_CONTACTS_MAX);
}

struct variants_log {
    int read[3]; /* times that each is simulated */
    size_t as[3];
};

static enum ceduo_status make_variant(void *context, size_t i, struct ceduo_variant *variant)
{
    (void)context;
    variant->run = ceduo_run_def_default(&site.scene);
    variant->run.option = i == 1 ? &site.option : NULL;
    variant->rocks = 5;
    return CEDUO_OK;
}

static enum ceduo_status read_variant(void *context, size_t i, struct ceduo_run *run, uint64_t *more)
{
    (void)run, (void)more;
    ((struct variants_log *)context)->read[i]++;
    return CEDUO_OK;
}

static void same_variant(void *context, size_t i, size_t first)
{
    ((struct variants_log *)context)->as[i] = first;
}

/* Without forest, with forest, without forest: the third equals the first. */
TEST(equal_forests_are_simulated_once)
{
    struct variants_log variants_log = {0};
    paper_site_init(&site);
    assert_int_equal(ceduo_variants_run(&(struct ceduo_variants){
                         .n = 3, .context = &variants_log, .make = make_variant, .read = read_variant, .same = same_variant}),
                     CEDUO_OK);
    assert_true(variants_log.read[0] == 1 && variants_log.read[1] == 1 && variants_log.read[2] == 0);
    assert_int_equal(variants_log.as[2], 0);
    assert_int_equal(variants_log.as[1], 0);
}

/* Blocks of all sizes: the difference of two runs uses the rocks of both, whichever is longer. */
TEST(differences_of_blocks)
{
    static double volumes[] = {0.05, 1};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    paper_site_init(&site);
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    struct ceduo_run_def bare = ceduo_run_def_default(&site.scene), wood = bare;
    wood.option = &site.option;
    double none[1];
    struct ceduo_run *few = make_run(&wood, 50), *many = make_run(&wood, 120), *bare_few = make_run(&bare, 50),
                     *bare_many = make_run(&bare, 120);
    struct ceduo_run *empty = make_run(&bare, 0);
    struct ceduo_difference wanted = ceduo_run_difference(few, bare_few, 0);
    EXPECT(wanted.energy_per_released.mean, <, 0);
    struct ceduo_difference first = ceduo_run_difference(few, bare_many, 0), second = ceduo_run_difference(many, bare_few, 0);
    assert_memory_equal(&first, &wanted, sizeof wanted);
    assert_memory_equal(&second, &wanted, sizeof wanted);
    assert_true(isnan(ceduo_run_difference(empty, bare_many, 0).reach.mean));
    assert_true(isnan(ceduo_run_difference(few, empty, 0).reach.mean));
    EXPECT(ceduo_run_energies(empty, 0, none, 1), ==, 0);
    assert_null(ceduo_run_samples(empty, 0, CEDUO_SAMPLE_STOP)); /* no rocks */
    struct ceduo_run *runs[] = {few, many, bare_few, bare_many, empty};
    for (size_t i = 0; i < 5; i++)
        ceduo_run_free(runs[i]);
}

/* A hundred energies represent all blocks: in the order of the rocks, each at the centre of a hundredth of all weights. */
TEST(energies_of_blocks_are_even_quantiles)
{
    enum { ROCKS = 900, MOST = 100 };
    static double volumes[] = {0.05, 1}, some[MOST];
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    paper_site_init(&site);
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    struct ceduo_run_def wood = ceduo_run_def_default(&site.scene);
    wood.option = &site.option;
    LOCAL(ceduo_run, run) = make_run(&wood, ROCKS);
    const double *all = ceduo_run_samples(run, 0, CEDUO_SAMPLE_ENERGY);
    EXPECT(ceduo_run_energies(run, 0, some, MOST), ==, MOST);
    const double *weights = ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT);
    double sum = 0, to = 0;
    size_t n = 0;
    for (size_t r = 0; r < ROCKS; r++)
        sum += isnan(all[r]) ? 0 : weights[r];
    for (size_t r = 0; r < ROCKS; r++) {
        to += isnan(all[r]) ? 0 : weights[r] / sum * MOST;
        for (; n < (size_t)floor(to + .5) && n < MOST; n++) /* the centres of steps that its weight covers */
            EXPECT(some[n], ==, all[r]);
    }
    EXPECT(n, ==, MOST);
}

/* Group means equal the full statistics: for one block or all sizes, with and without an accepted energy. */
TEST(group_means_equal_the_statistics)
{
    static double volumes[] = {0.05, 1};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    for (int i = 0; i < 4; i++) {
        paper_site_init(&site);
        site.control.x = 20;
        site.control.accepted = i % 2 == 0 ? 1e3 : NAN;
        site.scene.blocks = &blocks;
        site.scene.blocks_count = i / 2 == 1;
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        LOCAL(ceduo_run, run) = make_run(&def, 300);
        struct ceduo_group_means brief;
        struct ceduo_arrivals a;
        ceduo_run_group_means(run, 0, 1, &brief);
        assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
        EXPECT_NEAR(brief.reach_probability, a.reach.mean, 1e-12);
        EXPECT(isnan(brief.exceed_probability), ==, i % 2);
        if (i % 2 == 0)
            EXPECT_NEAR(brief.exceed_probability, a.exceed.mean, 1e-12);
        EXPECT_NEAR(brief.energy, a.energy.mean, 1e-12 * a.energy.mean);
        EXPECT_NEAR(brief.energy_per_released, a.energy_per_released.mean, 1e-12 * a.energy_per_released.mean);
    }
}

/* Years before simulation have no arrivals. */
TEST(years_before_they_are_flown)
{
    paper_site_init(&site);
    site.scene.simulation.rocks = 20;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 20);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare;
    LOCAL(ceduo_years, years);
    assert_int_equal(ceduo_simulated_read(run, &site.scene, NULL, &bare), CEDUO_OK);
    assert_int_equal(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = 3, .step = 1}, &years),
                     CEDUO_OK);
    ceduo_years_assess(years, &site.scene, &bare);
    struct ceduo_years_summary s = ceduo_years_summarize(years, 0);
    EXPECT(s.years, ==, 4);
    EXPECT(s.simulated, ==, 0);
    assert_true(isnan(s.worst));
    assert_true(isnan(s.reach.mean));
    assert_true(isnan(s.exceed.mean));
    EXPECT(s.unprotected_contact, ==, 0);
    EXPECT(s.unprotected_energy, ==, 0);
    struct ceduo_fence_years f = ceduo_years_fence(years, 0, &bare.arrivals[0]);
    EXPECT(f.years, ==, 0);
    EXPECT_NAN(f.mean.mean, f.worst.mean, f.per_year);
}

/* A pool with fewer rocks than requested: each year has these. */
TEST(years_have_at_most_the_rocks_of_the_pool)
{
    paper_site_init(&site);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.rocks_max = 20;
    LOCAL(ceduo_run, run) = make_run(&def, 20);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare;
    LOCAL(ceduo_pool, pool);
    LOCAL(ceduo_years, years);
    assert_int_equal(ceduo_simulated_read(run, &site.scene, NULL, &bare), CEDUO_OK);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = 1, .step = 1}, &years),
                     CEDUO_OK);
    assert_int_equal(ceduo_years_simulate(years, pool, &bare, 30), CEDUO_OK);
    for (size_t i = 0; i < years->count; i++)
        EXPECT(years->years[i].wooded.rocks, ==, 20);
    EXPECT(years->rocks, ==, 20);
}

/* Three years equal to today: none needs a higher class, and all do if one class less is enough today. If no class is enough
 * today, no year is an exception. */
TEST(years_that_need_more_than_today)
{
    enum { YEARS = 3 };
    paper_site_init(&site);
    site.control.fence = (struct ceduo_fence){.energy = 100e3, .height = 3};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 100);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare;
    LOCAL(ceduo_pool, pool);
    LOCAL(ceduo_years, years);
    assert_int_equal(ceduo_simulated_read(run, &site.scene, NULL, &bare), CEDUO_OK);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = YEARS - 1, .step = 1}, &years),
                     CEDUO_OK);
    assert_int_equal(ceduo_years_simulate(years, pool, &bare, 100), CEDUO_OK);
    struct ceduo_fence_arrivals now = years->years[0].wooded.fences[0];
    const struct ceduo_arrivals today = {.fence = &now};
    EXPECT(ceduo_fence_smallest(now.enough)->class_index, >, 0);
    EXPECT(ceduo_years_fence(years, 0, &today).exceptions, ==, 0);
    for (size_t h = 0; h < CEDUO_FENCE_HEIGHTS; h++)
        now.enough[h].class_index--;
    EXPECT_IS(ceduo_years_fence(years, 0, &today), (exceptions, YEARS), (first_exception, 0), (last_exception, YEARS - 1));
    for (size_t h = 0; h < CEDUO_FENCE_HEIGHTS; h++)
        now.enough[h].class_index = CEDUO_FENCE_CLASSES;
    EXPECT(ceduo_years_fence(years, 0, &today).exceptions, ==, 0);
}

/* Return a run of 300 rocks without speed, which friction holds at their release. */
static struct ceduo_run *held_rocks(void)
{
    paper_site_init(&site);
    site.scene.simulation.rocks = 300;
    site.scene.slope.segments[0].friction = 9;
    site.scene.release =
        (struct ceduo_release){ceduo_number(.1), ceduo_number(0), ceduo_number(0), ceduo_number(0), ceduo_number(0), false, 0};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.threads = 0; /* means 1 */
    return make_run(&def, 300);
}

TEST(places_that_no_rock_reaches)
{
    static const double places[] = {20, 152};
    struct ceduo_envelope e[2];
    ceduo_run_free(held_rocks());
    const struct ceduo_envelopes_def def = {.scene = &site.scene, .rocks = 300, .places = 2, .x = places};
    assert_int_equal(ceduo_envelopes(&def, e), CEDUO_OK);
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(e[i].passed, 0);
        EXPECT_NAN(e[i].mean_energy, e[i].height.p5, e[i].energy.max);
    }
}

TEST(a_control_that_no_rock_reaches)
{
    LOCAL(ceduo_run, run) = held_rocks();
    uint64_t reached;
    struct ceduo_estimate energy = ceduo_run_energy(run, 0, &reached);
    EXPECT(reached, ==, 0);
    EXPECT_NAN(energy.mean, energy.se);
}

TEST(a_run_stops_at_its_capacity)
{
    LOCAL(ceduo_run, run) = held_rocks();
    assert_int_equal(ceduo_run_extend(run, 1000), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), 300);
}

/* Energies of arrivals, up to the stored number; none before the simulation. */
TEST(energies_of_the_stored_arrivals)
{
    double energies[8];
    paper_site_init(&site);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.rocks_max = 300;
    LOCAL(ceduo_run, run) = make_run(&def, 0);
    assert_int_equal(ceduo_run_energies(run, 0, energies, 8), 0);
    assert_int_equal(ceduo_run_extend(run, 300), CEDUO_OK);
    assert_int_equal(ceduo_run_energies(run, 0, energies, 8), 8);
}

/* A run in two steps allocates twice, up to its capacity, and has the bits of one step. */
TEST(a_run_allocates_twice)
{
    paper_site_init(&site);
    site.scene.simulation.rocks = 300;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_arrivals steps, once;
    LOCAL(ceduo_run, two) = make_run(&def, 200);
    assert_int_equal(ceduo_run_extend(two, 300), CEDUO_OK);
    assert_int_equal(ceduo_run_arrivals(two, 0, &steps), CEDUO_OK);
    LOCAL(ceduo_run, one) = make_run(&def, 300);
    assert_int_equal(ceduo_run_arrivals(one, 0, &once), CEDUO_OK);
    EXPECT(steps.reached, >, 0);
    assert_memory_equal(&steps, &once, sizeof steps);
}

/* A control that a run does not have, and a run without rocks, have no statistics. */
TEST(controls_that_do_not_exist)
{
    paper_site_init(&site);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 20);
    site.scene.controls_count = 0;
    LOCAL(ceduo_run, fewer) = make_run(&def, 20);
    site.scene.controls_count = 1;
    LOCAL(ceduo_run, empty) = make_run(&def, 0);
    struct ceduo_arrivals a;
    struct ceduo_group_means brief;
    struct ceduo_fence_arrivals fence;
    uint64_t reached = 9;
    EXPECT(ceduo_run_arrivals(run, 1, &a), ==, CEDUO_BAD_ARGUMENT);
    EXPECT(a.released, ==, 0);
    EXPECT_NAN(ceduo_run_energy(run, 1, &reached).mean);
    EXPECT(reached, ==, 0);
    EXPECT_NAN(ceduo_run_difference(run, fewer, 0).reach.mean, ceduo_run_difference(fewer, run, 0).reach.mean);
    ceduo_run_group_means(empty, 0, 1, &brief);
    EXPECT_NAN(brief.reach_probability, brief.exceed_probability, brief.defeated_probability, brief.energy);
    site.scene.controls_count = 0; /* the run has a control, the scene none */
    EXPECT(ceduo_run_fence(run, &site.scene, 0, NULL, &fence), ==, CEDUO_BAD_ARGUMENT);
}

/* One arrival has an energy, but no error. */
TEST(one_arrival_has_no_error)
{
    static double volumes[] = {0.05, 1};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    paper_site_init(&site);
    site.control.x = 20;
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    uint64_t reached;
    LOCAL(ceduo_run, run) = make_run(&def, 1);
    struct ceduo_estimate energy = ceduo_run_energy(run, 0, &reached);
    EXPECT(reached, ==, 1);
    EXPECT_NEAR(energy.mean, ceduo_run_samples(run, 0, CEDUO_SAMPLE_ENERGY)[0], 1e-9 * energy.mean);
    EXPECT_NAN(energy.se);
}

/* Without a control the ends of rocks are still counted. */
TEST(ends_without_a_control)
{
    paper_site_init(&site);
    site.scene.controls_count = 0;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_ends ends;
    LOCAL(ceduo_run, run) = make_run(&def, 300);
    assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK);
    uint64_t all = 0;
    for (int e = 0; e < CEDUO_ENDS; e++)
        all += ends.count[e];
    EXPECT(all, ==, 300);
    EXPECT(ends.stop_x.n, >, 0);
    const double *stops = ceduo_run_samples(run, 0, CEDUO_SAMPLE_STOP);
    size_t stopped = 0;
    for (size_t r = 0; r < 300; r++)
        stopped += stops[r] <= ends.stop_p50;
    EXPECT(stopped, ==, (ends.stop_x.n + 1) / 2);
    assert_null(ceduo_run_samples(run, 0, CEDUO_SAMPLE_SPEED));
}

TEST(a_slope_of_one_point_has_no_run)
{
    paper_site_init(&site);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_run *run;
    struct ceduo_pool *pool;
    site.scene.slope.vertices = 1;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_BAD_SLOPE);
    assert_null(run);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_BAD_SLOPE);
    assert_null(pool);
}

/* NULL lists of an option that is not the scene's. */
TEST(missing_lists_of_an_option_are_refused)
{
    paper_site_init(&site);
    struct ceduo_belt belts[2] = {site.belts[0], site.belts[1]};
    struct ceduo_option option = {.belts_count = 2, .belts = belts};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_record_def record_def = ceduo_record_def_default(&site.scene);
    struct ceduo_run *run;
    struct ceduo_record record;
    def.option = record_def.option = &option;
    record_def.rocks = 1;
    void *const pointers[] = {&option.belts, &belts[0].stand.shoots, &belts[0].stand.trees};
    for (size_t i = 0; i <= LENGTH(pointers); i++) {
        void *was = NULL, *missing = NULL;
        if (i < LENGTH(pointers)) {
            memcpy(&was, pointers[i], sizeof was);
            memcpy(pointers[i], &missing, sizeof missing);
        }
        enum ceduo_status wanted = i < LENGTH(pointers) ? CEDUO_BAD_ARGUMENT : CEDUO_OK; /* at last all lists exist */
        EXPECT(ceduo_run_create(&def, &run), ==, wanted);
        EXPECT(ceduo_record(&record_def, &record), ==, wanted);
        ceduo_run_free(run);
        ceduo_record_release(&record);
        if (i < LENGTH(pointers))
            memcpy(pointers[i], &was, sizeof was);
    }
}

/* Forests no longer in the scene: the last runs used stay, up to a limit. */
TEST(a_pool_drops_old_runs)
{
    paper_site_init(&site);
    site.scene.simulation.rocks = 10;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_pool, pool);
    struct ceduo_run *run;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    enum { MORE = CEDUO_POOL_SPARE + 5 };
    double to = site.belts[1].to;
    for (int i = 1; i <= MORE; i++) {
        site.belts[1].to = to - i;
        assert_int_equal(ceduo_pool_run(pool, &site.option, &run), CEDUO_OK);
    }
    site.belts[1].to = to - 1; /* the first one is used again */
    assert_int_equal(ceduo_pool_run(pool, &site.option, &run), CEDUO_OK);
    assert_int_equal(ceduo_pool_work(pool).reused, 1);
    site.belts[1].to = to;
    ceduo_pool_set_scene(pool, &site.scene);
    assert_int_equal(ceduo_pool_work(pool).runs, 2 + MORE); /* all runs made, including dropped ones */
    assert_non_null(ceduo_pool_find(pool, NULL));
    assert_non_null(ceduo_pool_find(pool, &site.option));
    for (int i = 1; i <= MORE; i++) {
        site.belts[1].to = to - i;
        assert_int_equal(ceduo_pool_find(pool, &site.option) != NULL, i == 1 || i > MORE - CEDUO_POOL_SPARE + 1);
    }
    site.belts[1].to = to;
}
