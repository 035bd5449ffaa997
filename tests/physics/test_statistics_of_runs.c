/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow threads */
/* Runs of many rocks: their means compared with independent implementations; only the scene affects them. */
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "expect.h"
#include "local.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <string.h>

#include "core/walk/envelope.h"

#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"

static struct paper_site site;

/* Return a run of `scene` with n rocks on this many threads. */
static struct ceduo_run *run_scene(struct ceduo_scene *scene, uint64_t rocks, unsigned threads)
{
    scene->simulation.rocks = rocks;
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = threads;
    return make_run(&def, rocks);
}

/* Expect agreement within four combined standard errors plus half of the last printed digit. */
static void expect_mean(const char *label, double value, double se, double expected, double expected_se, double digit)
{
    double tolerance = 4 * hypot(se, expected_se) + digit / 2;
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%s: %.6g ± %.3g is not %.6g ± %.3g", label, value, se, expected, expected_se);
}

/* ---- Table 5 ---- */

/* Means at x = 135 of 2·10^5 rocks (the first of 10^6) by independent implementations of the same model. Table 5 of the paper
 * has 20.94 m/s and 122 kJ. */
struct combination {
    enum ceduo_law law;
    enum ceduo_facets facets;
    enum paper_theta theta;
    uint64_t rocks;
    double speed, speed_se, speed_digit, energy, energy_se, energy_digit, pass, pass_se, pass_digit;
};

static const struct combination combinations[] = {
    {CEDUO_LAW_LUMPED, CEDUO_FACETS_AGAINST, PAPER_ANGLE, 200000, 20.612, .005, .001, 114.69, .05, .01, 99.13, .009, .01},
    {CEDUO_LAW_LUMPED, CEDUO_FACETS_AGAINST, PAPER_HEIGHT, 200000, 24.441, .007, .001, 155.56, .09, .01, 100, 0, .01},
    {CEDUO_LAW_LUMPED, CEDUO_FACETS_BOTH, PAPER_HEIGHT, 100000, 17.383, .018, .001, 89.40, .15, .01, 75.5, .1, .1},
    {CEDUO_LAW_LUMPED, CEDUO_FACETS_BOTH, PAPER_ANGLE, 60000, 14.10, .02, .01, 65.8, .1, .1, 7.79, .02, .01},
    {CEDUO_LAW_CRSP, CEDUO_FACETS_AGAINST, PAPER_HEIGHT, 200000, 10.926, .003, .001, 42.92, .02, .01, 100, 0, .01},
    {CEDUO_LAW_CRSP, CEDUO_FACETS_AGAINST, PAPER_ANGLE, 100000, 6.670, .006, .001, 18.86, .03, .01, 88.1, .07, .1},
    {CEDUO_LAW_CRSP, CEDUO_FACETS_BOTH, PAPER_HEIGHT, 100000, 5.946, .009, .001, 15.84, .04, .01, 59.2, .11, .1},
};

static void choose(const struct combination *c)
{
    paper_site_init(&site);
    paper_site_read_theta(&site, c->theta);
    site.scene.slope.facets = c->facets;
    site.scene.simulation.law = c->law;
}

TEST(means_of_the_combinations_beside_table_5)
{
    for (size_t i = 0; i < LENGTH(combinations); i++) {
        const struct combination *c = &combinations[i];
        choose(c);
        LOCAL(ceduo_run, run) = run_scene(&site.scene, c->rocks, 2);
        struct ceduo_arrivals a = read_arrivals(run, 0);
        double p = a.reach.mean, n = (double)c->rocks;
        ROWS(expect_mean, ("mean speed", a.speed.mean, a.speed.se, c->speed, c->speed_se, c->speed_digit),
             ("mean energy", a.energy.mean / 1e3, a.energy.se / 1e3, c->energy, c->energy_se, c->energy_digit),
             ("share that passes", 100 * p, 100 * sqrt(p * (1 - p) / n), c->pass, c->pass_se, c->pass_digit));
        if (i == 0)
            expect_mean("sd of speed", a.speed.sd, a.speed.sd / sqrt(2 * n), 4.78, 4.78 / sqrt(2e6), .01);
        EXPECT_IS(a, (released, c->rocks), (unfinished, 0));
    }
}

TEST(hardly_any_rock_passes_crsp_with_facets_to_both_sides)
{
    choose(&(struct combination){.law = CEDUO_LAW_CRSP, .facets = CEDUO_FACETS_BOTH, .theta = PAPER_ANGLE});
    LOCAL(ceduo_run, run) = run_scene(&site.scene, 20000, 2);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(a.reached, <=, 3); /* 1 in 10^5: more than 3 of 20 000 has probability 6e-5 */
    EXPECT(a.reach.lo, <=, 1e-5);
    EXPECT(a.reach.hi, >=, 1e-5);
}

TEST(figures_of_an_arrival_are_consistent)
{
    choose(&combinations[3]);
    LOCAL(ceduo_run, run) = run_scene(&site.scene, 5000, 2);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    static double energies[5000];
    size_t n = ceduo_run_energies(run, 0, energies, LENGTH(energies)), exceeded = 0;
    assert_int_equal(n, a.reached);
    double sum = 0, largest = 0;
    for (size_t i = 0; i < n; i++) {
        sum += energies[i];
        largest = fmax(largest, energies[i]);
        exceeded += energies[i] > 50e3;
    }
    EXPECT_NEAR(a.energy.mean / (sum / (double)n), 1, 1e-12);
    EXPECT_NEAR(a.energy.max / largest, 1, 1e-15);
    assert_int_equal(exceeded, a.exceeded);
    EXPECT(a.exceed.mean, ==, (double)a.exceeded / 5000);
    EXPECT_NEAR(a.energy_per_released.mean / (sum / 5000), 1, 1e-12);
    double squares = 0;
    for (size_t i = 0; i < n; i++)
        squares += energies[i] * energies[i];
    double variance = (squares - sum * sum / 5000) / 4999;
    EXPECT_NEAR(a.energy_per_released.se / sqrt(variance / 5000), 1, 1e-9);
    double reach = (double)a.reached / 5000, exceed = (double)a.exceeded / 5000;
    EXPECT_IS(a, (reach.lo, ceduo_wilson(reach, reach, 5000).lo), (reach.hi, ceduo_wilson(reach, reach, 5000).hi),
              (exceed.lo, ceduo_wilson(exceed, exceed, 5000).lo), (exceed.hi, ceduo_wilson(exceed, exceed, 5000).hi));
    ROWS(EXPECT, (a.energy.p50, <=, a.energy.p95_lo), (a.energy.p95_lo, <=, a.energy.p95), (a.energy.p95, <=, a.energy.p95_hi),
         (a.energy.p95, <=, a.energy.p99), (a.energy.p99, <=, a.energy.max));
    EXPECT(a.translation.mean, ==, a.energy.mean); /* lumped: no spin */
    uint64_t reached;
    struct ceduo_estimate mean = ceduo_run_energy(run, 0, &reached);
    ROWS(EXPECT, (reached, ==, a.reached), (mean.mean, ==, a.energy.mean), (mean.se, ==, a.energy.se));
    struct ceduo_ends ends = read_ends(run);
    assert_int_equal(ends.count[CEDUO_END_AT_REST] + ends.count[CEDUO_END_LEFT_SLOPE] + ends.count[CEDUO_END_UNFINISHED], 5000);
    assert_int_equal(ends.stop_x.n, ends.count[CEDUO_END_AT_REST]);
    ROWS(EXPECT, (ends.stop_p50, <=, ends.stop_p95), (ends.stop_p95, <=, ends.stop_max), (ends.stop_max, ==, ends.stop_x.max));
}

TEST(a_run_equals_single_trajectories)
{
    choose(&combinations[5]);
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    EXPECT(expect_as_followed(def, 1500).reached, >, 1000);
}

/* ---- equal bits ---- */

TEST(the_same_bits_with_any_number_of_threads_and_steps)
{
    static const size_t rows[] = {0, 3, 5};
    for (size_t r = 0; r < LENGTH(rows); r++) {
        choose(&combinations[rows[r]]);
        site.scene.simulation.rocks = 20000;
        expect_same_however(ceduo_run_def_default(&site.scene), 20000);
    }
}

TEST(a_run_stops_at_the_requested_length)
{
    choose(&combinations[0]);
    site.scene.simulation.rocks = 500;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    LOCAL(ceduo_run, run) = make_run(&def, 300);
    assert_int_equal(ceduo_run_extend(run, 100), CEDUO_OK); /* nothing to do */
    assert_int_equal(ceduo_run_rocks(run), 300);
    assert_int_equal(ceduo_run_extend(run, 9999), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), 500);
    ceduo_run_free(NULL);
}

TEST(other_seeds_give_other_rocks)
{
    choose(&combinations[0]);
    LOCAL(ceduo_run, one) = run_scene(&site.scene, 50000, 2);
    struct ceduo_arrivals a = read_arrivals(one, 0);
    site.scene.simulation.seed = 2;
    LOCAL(ceduo_run, two) = run_scene(&site.scene, 50000, 2);
    struct ceduo_arrivals b = read_arrivals(two, 0);
    EXPECT(a.speed.mean, !=, b.speed.mean);
    expect_mean("mean speed", a.speed.mean, a.speed.se, b.speed.mean, b.speed.se, 0);
}

/* ---- envelopes ---- */

/* Return the value of rank p in a sorted sample as textbooks define it: the smallest value that at most a share p is below. */
static double value_of_rank(const double *values, size_t n, double p)
{
    double sorted[CEDUO_ENVELOPE_ROCKS];
    memcpy(sorted, values, n * sizeof *sorted);
    gsl_sort(sorted, 1, n);
    size_t i = 0;
    while ((double)(i + 1) < p * (double)n)
        i++;
    return sorted[i];
}

static void expect_spread(const struct ceduo_cell_quantiles *s, const double *values, size_t n)
{
    EXPECT_IS(*s, (p5, value_of_rank(values, n, .05)), (p50, value_of_rank(values, n, .5)),
              (p95, value_of_rank(values, n, .95)), (max, value_of_rank(values, n, 1)));
}

/* Envelopes at a place equal ranks of a control there: a run stores and sorts the values of each. */
TEST(envelopes_are_ranks_over_rocks)
{
    static const double places[] = {1, 20, 70, 134.5, 135, 150};
    static const uint64_t rocks[] = {1, 2, 20, 21, 2000};
    choose(&combinations[5]);
    site.scene.simulation.rocks = CEDUO_ENVELOPE_ROCKS;
    for (size_t k = 0; k < LENGTH(rocks); k++) {
        struct ceduo_envelope e[LENGTH(places)];
        double heights[CEDUO_ENVELOPE_ROCKS], energies[CEDUO_ENVELOPE_ROCKS];
        const struct ceduo_envelopes_def envelopes = {
            .scene = &site.scene, .rocks = rocks[k], .places = LENGTH(places), .x = places};
        assert_int_equal(ceduo_envelopes(&envelopes, e), CEDUO_OK);
        for (size_t i = 0; i < LENGTH(places); i++) {
            site.control.x = places[i];
            struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
            LOCAL(ceduo_run, run) = make_run(&def, rocks[k]);
            const double *height = ceduo_run_samples(run, 0, CEDUO_SAMPLE_HEIGHT);
            const double *energy = ceduo_run_samples(run, 0, CEDUO_SAMPLE_ENERGY);
            size_t n = 0;
            for (size_t r = 0; r < rocks[k]; r++)
                if (!isnan(energy[r])) {
                    heights[n] = height[r];
                    energies[n++] = energy[r];
                }
            assert_int_equal(e[i].passed, n);
            if (n == 0)
                continue;
            expect_spread(&e[i].height, heights, n);
            EXPECT_NEAR(e[i].energy.p5, value_of_rank(energies, n, .05), 1e-12 * e[i].energy.p5);
            EXPECT_NEAR(e[i].energy.p95, value_of_rank(energies, n, .95), 1e-12 * e[i].energy.p95);
            EXPECT_NEAR(e[i].mean_energy, gsl_stats_mean(energies, 1, n), 1e-12 * e[i].mean_energy);
        }
    }
}

/* ---- cancellation ---- */

struct canceller {
    atomic_bool flag;
    uint64_t last, calls;
};

static void raise_flag(void *context, uint64_t rocks)
{
    struct canceller *c = context;
    c->last = rocks;
    c->calls++;
    atomic_store(&c->flag, true);
}

TEST(a_cancelled_run_can_continue)
{
    static struct canceller c;
    choose(&combinations[1]);
    site.scene.simulation.rocks = 600000;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.threads = 2;
    def.cancel = &c.flag;
    def.progress = raise_flag;
    def.context = &c;
    LOCAL(ceduo_run, run);
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, 600000), CEDUO_CANCELLED);
    uint64_t done = ceduo_run_rocks(run);
    ROWS(EXPECT, (c.calls, >=, 1), (done, >=, c.last), (done, <, 600000));
    assert_int_equal(read_arrivals(run, 0).released, done);
    assert_int_equal(ceduo_run_extend(run, 600000), CEDUO_CANCELLED); /* flag still set */
    assert_int_equal(ceduo_run_rocks(run), done);
    struct ceduo_run_def plain = ceduo_run_def_default(&site.scene);
    plain.threads = 2;
    LOCAL(ceduo_run, second) = make_run(&plain, done);
    expect_same_run(run, second);
    atomic_store(&c.flag, false);
    assert_int_equal(ceduo_run_extend(run, done + 3000), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(second, done + 3000), CEDUO_OK);
    expect_same_run(run, second);
}

/* ---- spreads ---- */

struct drawn {
    struct ceduo_moments x, height, vx, vz, spin, radius, mass;
};

static struct drawn draw_releases(const struct ceduo_scene *scene, uint64_t rocks)
{
    struct drawn d = {0};
    for (uint64_t rock = 0; rock < rocks; rock++) {
        struct ceduo_trajectory w;
        assert_int_equal(ceduo_trajectory_run(scene, NULL, rock, NULL, &w, NULL), CEDUO_OK);
        ceduo_moments_add(&d.x, w.x0);
        ceduo_moments_add(&d.height, w.z0 - ceduo_slope_height(&scene->slope, w.x0));
        ceduo_moments_add(&d.vx, w.vx0);
        ceduo_moments_add(&d.vz, w.vz0);
        ceduo_moments_add(&d.spin, w.spin0);
        ceduo_moments_add(&d.radius, w.rock.radius);
        ceduo_moments_add(&d.mass, w.rock.mass);
    }
    return d;
}

static void expect_moments(const char *label, const struct ceduo_moments *m, double mean, double sd)
{
    expect_mean(label, m->mean, ceduo_moments_se(m), mean, 0, 0);
    expect_mean(label, ceduo_moments_sd(m), sd / sqrt(2 * (double)m->n), sd, 0, 0);
}

#define CUT_SD 0.98657839256 /* sd of the normal law truncated at three of its own: sqrt(1 - 6 phi(3)/(2 Phi(3) - 1)) */

TEST(releases_and_rocks_follow_their_distributions)
{
    choose(&combinations[4]);
    struct ceduo_scene *s = &site.scene;
    s->release.x = (struct ceduo_number){2, 1.5, CEDUO_SPREAD_UNIFORM};
    s->release.height = (struct ceduo_number){1, .3, CEDUO_SPREAD_NORMAL};
    s->release.vx = (struct ceduo_number){1, .5, CEDUO_SPREAD_NORMAL};
    s->release.vz = (struct ceduo_number){-1, .5, CEDUO_SPREAD_UNIFORM};
    s->release.spin = (struct ceduo_number){2, 3, CEDUO_SPREAD_NORMAL};
    s->rock = ceduo_scene_default().rock;
    s->rock.diameter = (struct ceduo_number){.68, .1, CEDUO_SPREAD_NORMAL};
    assert_int_equal(ceduo_scene_check(s, NULL), CEDUO_OK);
    struct drawn d = draw_releases(s, 20000);
    const double even = 1 / sqrt(3);
    ROWS(expect_moments, ("x", &d.x, 2, 1.5 * even), ("height", &d.height, 1, .3 * CUT_SD), ("vx", &d.vx, 1, .5 * CUT_SD),
         ("vz", &d.vz, -1, .5 * even), ("spin", &d.spin, 2, 3 * CUT_SD), ("radius", &d.radius, .34, .05 * CUT_SD));
    /* the mean of the cube: m3 + 3 m sd2 */
    double cube = pow(.68, 3) + 3 * .68 * .01 * CUT_SD * CUT_SD;
    expect_mean("mass", d.mass.mean, ceduo_moments_se(&d.mass), 2600 * acos(-1) / 6 * cube, 0, 0);
    LOCAL(ceduo_run, run) = run_scene(s, 5000, 2);
    LOCAL(ceduo_run, again) = run_scene(s, 5000, 16);
    expect_same_run(run, again);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(a.reached, >, 4000);
    EXPECT(a.translation.mean, <, a.energy.mean);
}

TEST(a_lumped_rock_with_many_masses_has_its_own_energies)
{
    choose(&combinations[0]);
    site.scene.rock.density = (struct ceduo_number){2600, 300, CEDUO_SPREAD_UNIFORM};
    LOCAL(ceduo_run, run) = run_scene(&site.scene, 50000, 2);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    /* the trajectory does not depend on the mass */
    expect_mean("mean speed", a.speed.mean, a.speed.se, 20.612, .005, .001);
    expect_mean("mean energy", a.energy.mean / 1e3, a.energy.se / 1e3, 114.69, .05, .01);
    expect_relative(a.energy.mean, a.translation.mean, 1e-12);
}

/* On level ground a rock dropped with vx leaves its first contact with Rt·vx and Rn·vz. */
struct first_contact {
    struct ceduo_moments rn, rt;
    double vz;
    bool done;
};

static void check_first_contact(void *context, const struct ceduo_trajectory_segment *p)
{
    struct first_contact *f = context;
    if (p->contacts == 0)
        f->vz = p->vz1;
    if (p->contacts != 1 || f->done)
        return;
    f->done = true;
    ceduo_moments_add(&f->rn, p->vz / -f->vz);
    ceduo_moments_add(&f->rt, p->vx / 4);
}

static struct first_contact first_contacts(const struct ceduo_scene *scene)
{
    struct first_contact f = {0};
    for (uint64_t rock = 0; rock < 20000; rock++) {
        const struct ceduo_trajectory_callbacks watch = {.segment = check_first_contact, .context = &f};
        struct ceduo_trajectory w;
        f.done = false;
        assert_int_equal(ceduo_trajectory_run(scene, NULL, rock, &watch, &w, NULL), CEDUO_OK);
        assert_true(f.done);
    }
    return f;
}

TEST(grounds_follow_their_distributions)
{
    static struct line_scene flat;
    const double x[] = {0, 1000}, z[] = {0, 0};
    line_scene_init(&flat, 2, x, z, (struct line_ground){.3, .8, .5}, .01, CEDUO_LAW_LUMPED);
    flat.segments[0].rn = (struct ceduo_number){.3, .05, CEDUO_SPREAD_NORMAL};
    flat.segments[0].rt = (struct ceduo_number){.8, .1, CEDUO_SPREAD_UNIFORM};
    line_scene_release(&flat, 500, 10, 4, 0, 0);
    struct first_contact f = first_contacts(&flat.scene);
    expect_moments("Rn", &f.rn, .3, .05 * CUT_SD);
    expect_moments("Rt", &f.rt, .8, .1 / sqrt(3));
    flat.segments[0].rn = (struct ceduo_number){.95, .2, CEDUO_SPREAD_NORMAL}; /* truncated at 1 as well */
    f = first_contacts(&flat.scene);
    double a = -3, b = .25, pi = acos(-1), p = (erfc(-b / sqrt(2)) - erfc(-a / sqrt(2))) / 2;
    double shift = (exp(-a * a / 2) - exp(-b * b / 2)) / sqrt(2 * pi) / p;
    expect_mean("cut Rn", f.rn.mean, ceduo_moments_se(&f.rn), .95 + .2 * shift, 0, 0);
    EXPECT(f.rn.max, <=, 1 + 1e-15);
}

TEST(a_spread_of_0_changes_nothing)
{
    choose(&combinations[5]);
    LOCAL(ceduo_run, one) = run_scene(&site.scene, 3000, 2);
    for (size_t j = 0; j < PAPER_SEGMENTS; j++)
        site.segments[j].rn.kind = site.segments[j].rt.kind = CEDUO_SPREAD_UNIFORM;
    site.scene.release.x.kind = site.scene.release.vx.kind = site.scene.rock.diameter.kind = CEDUO_SPREAD_UNIFORM;
    LOCAL(ceduo_run, two) = run_scene(&site.scene, 3000, 2);
    expect_same_run(one, two);
}

/* ---- no arrival ---- */

static bool nothing_known(const struct ceduo_distribution *d)
{
    return isnan(d->mean) && isnan(d->se) && isnan(d->sd) && isnan(d->p50) && isnan(d->p95) && isnan(d->p95_lo) &&
           isnan(d->p95_hi) && isnan(d->p99) && isnan(d->max);
}

TEST(a_control_without_arrivals)
{
    for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
        choose(&combinations[0]);
        site.scene.simulation.law = (enum ceduo_law)law;
        for (size_t j = 0; j < PAPER_SEGMENTS; j++) {
            site.segments[j].friction = 5;
            site.segments[j].rt = ceduo_number(.1);
        }
        site.scene.simulation.rocks = 999;
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        LOCAL(ceduo_run, run) = make_run(&def, 999);
        struct ceduo_arrivals a = read_arrivals(run, 0);
        EXPECT_IS(a, (reached, 0), (reach.mean, 0), (reach.lo, 0));
        ROWS(EXPECT, (a.reach.hi, >, .0038), (a.reach.hi, <, .004), (a.exceed.hi, ==, a.reach.hi));
        ROWS(assert_true, (nothing_known(&a.speed)), (nothing_known(&a.energy)), (nothing_known(&a.translation)),
             (nothing_known(&a.height)));
        EXPECT_IS(a, (energy_per_released.mean, 0), (energy_per_released.se, 0));
        uint64_t reached;
        double energy;
        struct ceduo_estimate mean = ceduo_run_energy(run, 0, &reached);
        EXPECT(reached, ==, 0);
        EXPECT_NAN(mean.mean, mean.se);
        assert_int_equal(ceduo_run_energies(run, 0, &energy, 1), 0);
    }
}

TEST(a_control_without_an_accepted_energy)
{
    choose(&combinations[0]);
    site.control.accepted = NAN;
    LOCAL(ceduo_run, run) = run_scene(&site.scene, 999, 1);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(a.exceeded, ==, 0);
    EXPECT_NAN(a.exceed.mean, a.exceed.lo, a.exceed.hi);
}

TEST(unfinished_rocks_count_for_the_upper_bound)
{
    static struct line_scene flat;
    const double x[] = {0, 1000}, z[] = {0, 0};
    line_scene_init(&flat, 2, x, z, (struct line_ground){1, 1, 0}, .1, CEDUO_LAW_LUMPED);
    line_scene_release(&flat, 500, 1, 0, 0, 0);
    flat.control = (struct ceduo_control){.x = 600, .accepted = 1, .measured_speed = NAN};
    flat.scene.controls_count = 1;
    LOCAL(ceduo_run, run) = run_scene(&flat.scene, 5, 2);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT_IS(a, (unfinished, 5), (reached, 0), (reach.hi, 1), (reach.lo, 0), (exceed.hi, 1));
    struct ceduo_ends ends = read_ends(run);
    assert_int_equal(ends.count[CEDUO_END_UNFINISHED], 5);
    EXPECT_NAN(ends.stop_p50, ends.stop_max);
}

/* Blocks of all sizes fall on one of two grounds: on one they stop, on the other they bounce for ever. None reaches the
 * control. The upper bound counts (sum of weights)^2 / sum of their squares equal rocks. The unfinished ones arrive by their
 * weights; or they arrive and no others do, if that is more. */
TEST(unfinished_blocks_count_with_their_weights)
{
    enum { ROCKS = 60 };
    static struct line_scene flat;
    static double volumes[] = {.05, 5};
    const double x[] = {0, 100, 1000}, z[] = {0, 0, 0};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    line_scene_init(&flat, 3, x, z, (struct line_ground){1, 1, 0}, .1, CEDUO_LAW_LUMPED);
    flat.segments[0].rn = flat.segments[0].rt = ceduo_number(0);
    flat.segments[0].friction = 1;
    line_scene_release(&flat, 100, 1, 0, 0, 0);
    flat.scene.release.x = (struct ceduo_number){.mean = 100, .spread = 50, .kind = CEDUO_SPREAD_UNIFORM};
    flat.control = (struct ceduo_control){.x = 600, .accepted = NAN, .measured_speed = NAN};
    flat.scene.controls_count = 1;
    flat.scene.blocks = &blocks;
    flat.scene.blocks_count = 1;
    LOCAL(ceduo_run, run) = run_scene(&flat.scene, ROCKS, 2);
    LOCAL(ceduo_tracer, f) = ceduo_tracer_create(&flat.scene, NULL);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    const double *weights = ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT);
    double all = 0, squares = 0, unfinished = 0;
    for (uint64_t r = 0; r < ROCKS; r++) {
        struct ceduo_trajectory trajectory;
        struct ceduo_crossing crossing;
        assert_int_equal(ceduo_tracer_run(f, r, NULL, &trajectory, &crossing), CEDUO_OK);
        all += weights[r];
        squares += weights[r] * weights[r];
        unfinished += trajectory.end == CEDUO_END_UNFINISHED ? weights[r] : 0;
    }
    ROWS(EXPECT, (a.reached, ==, 0), (a.unfinished, >, ROCKS / 4), (a.unfinished, <, ROCKS * 3 / 4));
    EXPECT(fabs(unfinished / all - (double)a.unfinished / ROCKS), >, .01); /* weights matter */
    const double z2 = 1.959963984540054 * 1.959963984540054;
    double of_equal = ceduo_wilson(unfinished / all, unfinished / all, all * all / squares).hi;
    double hi = fmax(of_equal, unfinished / all + z2 / (ROCKS + z2));
    EXPECT_NEAR(a.missed[CEDUO_END_UNFINISHED], unfinished / all, 1e-12);
    EXPECT_NEAR(a.reach.hi, hi, 1e-12);
}
