/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs among stems: the test site of Ciabocco, Boccia and Ripa 2009, several options, equal bits and equal rocks. */
#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <string.h>

#include "full.h"
#include "stems_scene.h"

/* ---- the paper's site ---- */

static struct paper_site site;

/* An independent implementation of the same model: energy (kJ) and speed of rocks that pass x = 135 m, shares (%) of all
 * released. In the paper a rock was filmed there with 62.3 kJ and 15.6 m/s. */
TEST(rocks_on_the_papers_site_arrive_as_in_an_independent_implementation)
{
    const struct {
        double energy, speed, pass, stopped;
    } other = {62.06, 14.67, 83.2, 15.4};
    const uint64_t rocks = FULL_OR(300000, 100000);
    paper_site_init(&site);
    LOCAL(ceduo_run, run) = run_option(&site.scene, &site.option, rocks, 2);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    struct ceduo_ends e = read_ends(run);
    double n = (double)rocks, pass = a.reach.mean;
    double stopped = (double)e.count[CEDUO_END_STOPPED_BY_STEMS] / n;
    expect_close("kJ at 135 m", a.energy.mean / 1e3, a.energy.se / 1e3, other.energy, .1);
    /* its error is not published: half of the energy's, relatively, plus half a digit */
    ROWS(expect_close, ("m/s at 135 m", a.speed.mean, a.speed.se, other.speed, other.speed * .05 / other.energy + .005 / 4),
         ("% that pass", 100 * pass, 100 * sqrt(pass * (1 - pass) / n), other.pass, .1),
         ("% stopped by stems", 100 * stopped, 100 * sqrt(stopped * (1 - stopped) / n), other.stopped, .1));
    uint64_t ended = 0;
    for (int k = 0; k < CEDUO_ENDS; k++)
        ended += e.count[k];
    assert_int_equal(ended, rocks);
}

/* ---- several options ---- */

/* The paper's site with a second option: the same stems, which take slightly more. */
static struct {
    struct ceduo_option options[2];
    struct ceduo_belt belts[2];
    struct paper_plot plots[2];
} sides;

static void open_sides(void)
{
    paper_site_init(&site);
    for (int i = 0; i < 2; i++) {
        paper_plot_init(&sides.plots[i], i + 1);
        sides.plots[i].shoots.volume *= 1.03;
        sides.belts[i] = site.belts[i];
        sides.belts[i].stand = sides.plots[i].stand;
    }
    sides.options[0] = site.option;
    sides.options[1] = (struct ceduo_option){.belts_count = 2, .belts = sides.belts};
    site.scene.options = sides.options;
    site.scene.options_count = LENGTH(sides.options);
}

/* Return the energy of each rock at the control; 0 and `reached` false if it does not arrive. */
static double simulate_energy(struct ceduo_tracer *f, uint64_t rock, bool *reached)
{
    struct ceduo_trajectory w;
    struct ceduo_crossing c;
    assert_int_equal(ceduo_tracer_run(f, rock, NULL, &w, &c), CEDUO_OK);
    *reached = c.reached;
    return c.reached ? (w.rock.mass * (c.vx * c.vx + c.vz * c.vz) + w.rock.moment * c.spin * c.spin) / 2 : 0;
}

struct pair_moments {
    struct ceduo_moments reach, exceed, energy;
};

static struct pair_moments read_pairs(const struct ceduo_option *a, const struct ceduo_option *b, uint64_t rocks)
{
    struct pair_moments m = {0};
    struct ceduo_tracer *f = ceduo_tracer_create(&site.scene, a), *g = ceduo_tracer_create(&site.scene, b);
    assert_true(f);
    assert_true(g);
    for (uint64_t rock = 0; rock < rocks; rock++) {
        bool p, q;
        double e = simulate_energy(f, rock, &p), h = simulate_energy(g, rock, &q);
        ceduo_moments_add(&m.reach, (double)p - (double)q);
        ceduo_moments_add(&m.exceed, (double)(e > site.control.accepted) - (double)(h > site.control.accepted));
        ceduo_moments_add(&m.energy, e - h);
    }
    ceduo_tracer_free(f);
    ceduo_tracer_free(g);
    return m;
}

static void expect_pair(const char *label, const struct ceduo_estimate *d, const struct ceduo_moments *m, double a, double b)
{
    print_message("# %s: %.6g ± %.3g\n", label, d->mean, d->se);
    if (fabs(d->mean - (a - b)) > 1e-12 * (fabs(a) + fabs(b)))
        fail_msg("%s: %.17g is not %.17g", label, d->mean, a - b);
    if (fabs(d->mean - m->mean) > 1e-12 * (fabs(a) + fabs(b)))
        fail_msg("%s: %.17g is not %.17g, rock by rock", label, d->mean, m->mean);
    expect_exact(label, d->se, ceduo_moments_se(m), 1e-9);
}

TEST(differences_have_the_error_of_differences_rock_by_rock)
{
    const uint64_t rocks = 6000;
    open_sides();
    for (int other = 0; other < 2; other++) { /* the small change; no forest */
        const struct ceduo_option *option = other ? NULL : &sides.options[1];
        LOCAL(ceduo_run, run) = run_option(&site.scene, option, rocks, 2);
        LOCAL(ceduo_run, base) = run_option(&site.scene, &sides.options[0], rocks, 2);
        struct ceduo_difference d = ceduo_run_difference(run, base, 0);
        struct pair_moments m = read_pairs(option, &sides.options[0], rocks);
        struct ceduo_arrivals a = read_arrivals(run, 0);
        struct ceduo_arrivals b = read_arrivals(base, 0);
        expect_pair("difference of shares that pass", &d.reach, &m.reach, a.reach.mean, b.reach.mean);
        expect_pair("difference of shares above what is accepted", &d.exceed, &m.exceed, a.exceed.mean, b.exceed.mean);
        expect_pair("difference of J per released", &d.energy_per_released, &m.energy, a.energy_per_released.mean,
                    b.energy_per_released.mean);
        double separate = hypot(a.energy_per_released.se, b.energy_per_released.se);
        EXPECT(d.energy_per_released.se, <, (other ? 1 : .5) * separate);
    }
}

TEST(the_same_bits_among_stems_with_any_number_of_threads_and_steps)
{
    open_sides();
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.option = &sides.options[1];
    expect_same_however(def, 5000);
}

TEST(a_run_among_stems_equals_single_trajectories)
{
    open_sides();
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.option = &sides.options[0];
    EXPECT(expect_as_followed(def, 3000).reached, >, 2000);
}

/* A rock aborted because of too many stems has reached the controls it passed before: from its release, and from a contact from
 * which many rocks fly together. */
TEST(an_aborted_rock_has_reached_earlier_controls)
{
    enum { ROCKS = 10 };
    clear_plane(20000);
    plane.line.scene.release.height.mean = 5;
    plant_trees(plant_belt(0, 20000, 0, 0), 1e6, .01)->height = 2; /* the rock flies over all of them */
    plane.line.scene.controls_count = 1;
    plane.line.control = (struct ceduo_control){.x = 10000, .accepted = NAN, .measured_speed = NAN};
    for (uint64_t contact = 0; contact < 2; contact++) {
        plane.line.scene.release.vz.mean = contact ? -1e5 : 0;
        LOCAL(ceduo_run, run) = run_option(&plane.line.scene, &plane.line.option, ROCKS, 1);
        struct ceduo_arrivals a = read_arrivals(run, 0);
        EXPECT_IS(a, (reached, ROCKS), (unfinished, 0));
        assert_int_equal(read_ends(run).count[CEDUO_END_UNFINISHED], ROCKS);
        struct ceduo_trajectory trajectory;
        struct ceduo_crossing c;
        assert_int_equal(ceduo_trajectory_run(&plane.line.scene, &plane.line.option, 0, NULL, &trajectory, &c), CEDUO_OK);
        EXPECT_IS(trajectory, (end, CEDUO_END_UNFINISHED), (contacts, contact));
        ROWS(EXPECT, (trajectory.x, >, 10000), (trajectory.x, <, 20000), (trajectory.z, >, 2));
        assert_true(c.reached);
    }
}

/* The same for a rolling rock, with a contact per radius: in wide groups most trees stand off its path, so that it is aborted
 * between two hits and within a radius. */
TEST(an_aborted_rock_has_reached_the_end_of_its_roll)
{
    clear_plane(20000);
    line_scene_release(&plane.line, 0, 0, 2e5, 0, 0);
    struct ceduo_stems *trees = plant_trees(plant_belt(0, 20000, 0, 0), 4000, .01);
    trees->group = 200;
    trees->group_radius = 100;
    sweep_one(0);
    EXPECT_IS(sweep.trajectory, (end, CEDUO_END_UNFINISHED), (stems_hit, sweep.count));
    double before = fmax(sweep.stems[sweep.count - 1].x, (double)(sweep.trajectory.contacts - 1) * (B / 2));
    ROWS(EXPECT, (before, >, 10000), (sweep.trajectory.x, >, before + 1e-6), (sweep.trajectory.x, <, before + B / 2));
    plane.line.scene.controls_count = 1;
    plane.line.control = (struct ceduo_control){.x = (before + sweep.trajectory.x) / 2, .accepted = NAN, .measured_speed = NAN};
    LOCAL(ceduo_run, run) = run_option(&plane.line.scene, &plane.line.option, 1, 1);
    EXPECT_IS(read_arrivals(run, 0), (reached, 1), (unfinished, 0));
}

/* The same for blocks of all sizes with their weights. The error of the mean is the residual of a regression on the weights
 * (Cochran 1977), and its spread between seeds. */
TEST(stems_hit_by_blocks)
{
    enum { ROCKS = 400, SEEDS = 200 };
    static double volumes[] = {.05, 1}, own[ROCKS];
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    struct ceduo_moments above = {0}, errors = {0};
    struct ceduo_arrivals a;
    open_sides();
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        site.scene.simulation.seed = seed;
        struct ceduo_run *run = run_option(&site.scene, &sides.options[0], ROCKS, 1);
        assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
        ceduo_moments_add(&above, a.contacts.mean);
        ceduo_moments_add(&errors, a.contacts.se);
        if (seed < SEEDS) {
            ceduo_run_free(run);
            continue;
        }
        const double *w = ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT);
        LOCAL(ceduo_tracer, f) = ceduo_tracer_create(&site.scene, &sides.options[0]);
        double all = 0, reached = 0, sum = 0, mean = 0, ww = 0, wx = 0, xx = 0;
        for (uint64_t rock = 0; rock < ROCKS; rock++) {
            struct ceduo_trajectory trajectory;
            struct ceduo_crossing c;
            assert_int_equal(ceduo_tracer_run(f, rock, NULL, &trajectory, &c), CEDUO_OK);
            own[rock] = c.reached ? (double)c.stems_hit : NAN;
            all += w[rock];
            reached += c.reached ? w[rock] : 0;
            sum += c.reached ? w[rock] * own[rock] : 0;
        }
        for (uint64_t rock = 0; rock < ROCKS; rock++) {
            own[rock] = isnan(own[rock]) ? 0 : w[rock] * (own[rock] - sum / reached);
            mean += own[rock] / ROCKS;
        }
        for (uint64_t rock = 0; rock < ROCKS; rock++) {
            double dw = w[rock] - all / ROCKS, dx = own[rock] - mean;
            ww += dw * dw;
            wx += dw * dx;
            xx += dx * dx;
        }
        expect_exact("mean contacts of blocks", a.contacts.mean, sum / reached, 1e-12);
        expect_exact("their error", a.contacts.se, sqrt((xx - wx * wx / ww) * ROCKS / (ROCKS - 1)) / reached, 1e-9);
        ceduo_run_free(run);
    }
    double ratio = ceduo_moments_sd(&above) / errors.mean;
    EXPECT_NEAR(ratio, 1, 4 / sqrt(2. * SEEDS));
}

/* Extending one run keeps its figures; the difference uses the rocks of both runs. */
TEST(a_longer_run_keeps_its_figures)
{
    open_sides();
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.rocks_max = 1500;
    struct ceduo_run *longer, *alone = run_option(&site.scene, &sides.options[1], 1500, 1);
    struct ceduo_run *few[] = {run_option(&site.scene, &sides.options[0], 600, 1),
                               run_option(&site.scene, &sides.options[1], 600, 1)};
    LOCAL(ceduo_pool, pool);
    LOCAL(ceduo_result, result);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_extend(pool, 600), CEDUO_OK);
    assert_int_equal(ceduo_pool_simulate(pool, &sides.options[1], 1500, &longer), CEDUO_OK);
    assert_int_equal(ceduo_result_create(&site.scene, pool, &result), CEDUO_OK);
    struct ceduo_arrivals wanted = read_arrivals(alone, 0);
    ROWS(EXPECT, (result->bare.rocks, ==, 600), (result->options[0].wooded.rocks, ==, 600),
         (result->options[1].wooded.rocks, ==, 1500));
    const struct ceduo_arrivals *a = ceduo_result_wooded(result, 1, 0);
    ROWS(EXPECT, (a->released, ==, 1500), (a->reached, ==, wanted.reached), (a->energy.mean, ==, wanted.energy.mean));
    EXPECT_SAME(*a, wanted, exceed.hi, contacts.mean);
    struct ceduo_difference d = result->options[1].differences[0], of_few = ceduo_run_difference(few[1], few[0], 0);
    EXPECT(d.energy_per_released.mean, <, 0);
    expect_exact("difference", d.energy_per_released.mean, of_few.energy_per_released.mean, 1e-9);
    expect_exact("its error", d.energy_per_released.se, of_few.energy_per_released.se, 1e-12);
    EXPECT_NEAR(d.exceed.mean, of_few.exceed.mean, 1e-12);
    ceduo_run_free(alone);
    ceduo_run_free(few[0]);
    ceduo_run_free(few[1]);
}

/* After every stem a flight or roll is computed again; a stem that takes no energy must not change it. */
TEST(stems_that_take_nothing_do_not_change_the_trajectory)
{
    const uint64_t rocks = 4000;
    uint64_t same = 0;
    struct spread met[2] = {0};
    paper_site_init(&site);
    for (int i = 0; i < 2; i++) {
        struct paper_plot *p = &site.plots[i];
        p->shoots.volume = p->trees.volume = 1e-25;
        p->shoots.height = p->trees.height = 1e3;
    }
    site.belts[0].from = -5; /* stools above the release reach over it */
    struct ceduo_tracer *f = ceduo_tracer_create(&site.scene, &site.option);
    struct ceduo_tracer *bare = ceduo_tracer_create(&site.scene, NULL);
    assert_true(f);
    assert_true(bare);
    for (uint64_t rock = 0; rock < rocks; rock++) {
        struct ceduo_trajectory v, w;
        struct ceduo_crossing c, d;
        assert_int_equal(ceduo_tracer_run(bare, rock, NULL, &v, &c), CEDUO_OK);
        sweep.count = 0;
        assert_int_equal(
            ceduo_tracer_run(f, rock, &(struct ceduo_trajectory_callbacks){.stem = note_stem, .context = &sweep}, &w, &d),
            CEDUO_OK);
        same += v.end == w.end && v.contacts == w.contacts && fabs(v.x - w.x) < 1e-6 && c.reached == d.reached &&
                fabs(c.vx - d.vx) < 1e-6 && fabs(c.vz - d.vz) < 1e-6 && fabs(c.height - d.height) < 1e-6;
        if (w.x < 137)
            continue;
        double first = 0;
        for (size_t i = 0; i < sweep.count; i++)
            first += sweep.stems[i].dbh == .061;
        spread_add(&met[0], first / 67.5);
        spread_add(&met[1], ((double)sweep.count - first) / 67.5);
    }
    ceduo_tracer_free(f);
    ceduo_tracer_free(bare);
    print_message("# %ju of %ju trajectories equal\n", (uintmax_t)same, (uintmax_t)rocks);
    EXPECT(same, >, rocks * 98 / 100); /* rounding turns some elsewhere */
    expect_mean("stems per metre of ADS 1 on the paper's site", &met[0], per_metre(9076, B + .061));
    expect_mean("stems per metre of ADS 2 on the paper's site", &met[1], per_metre(4641, B + .047));
}

TEST(options_with_the_same_stems_share_a_run)
{
    open_sides();
    struct ceduo_belt same[3], other[2];
    memcpy(&same[1], site.belts, sizeof site.belts);
    same[0] = (struct ceduo_belt){.from = -5, .to = 0, .name = "meadow"}; /* without stems */
    memcpy(other, site.belts, sizeof site.belts);
    other[1].to -= 1;
    struct ceduo_option options[] = {sides.options[0],
                                     {.name = "the same", .belts_count = 3, .belts = same},
                                     {.name = "shorter", .belts_count = 2, .belts = other},
                                     {.name = "meadow", .belts_count = 1, .belts = same}};
    site.scene.options = options;
    site.scene.options_count = LENGTH(options);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_pool, pool);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    struct ceduo_work work = ceduo_pool_work(pool);
    assert_int_equal(work.runs, 3);   /* without forest, the paper's forest, the shorter one */
    assert_int_equal(work.reused, 5); /* 4 options, each with and without its forest: 8 in all */
    assert_ptr_equal(ceduo_pool_find(pool, &options[1]), ceduo_pool_find(pool, &options[0]));
    assert_ptr_not_equal(ceduo_pool_find(pool, &options[2]), ceduo_pool_find(pool, &options[0]));
    assert_ptr_equal(ceduo_pool_find(pool, &options[3]), ceduo_pool_find(pool, NULL));
    assert_int_equal(ceduo_pool_extend(pool, 1000), CEDUO_OK);
    work = ceduo_pool_work(pool);
    assert_int_equal(work.rocks, 3000);
    struct ceduo_run *run = ceduo_pool_find(pool, &options[0]);
    LOCAL(ceduo_run, alone) = run_option(&site.scene, &options[1], 1000, 1);
    expect_same_run(run, alone);
}
