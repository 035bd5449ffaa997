/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Numbers of stems that rocks meet, on their trajectory and per stool, compared with closed forms (Cauchy, Crofton,
 * Poisson). */
#include "core/stand/adc.h"
#include "expect.h"
#include "scene/stand.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "stems_scene.h"

/* ---- numbers ---- */

/* Stems by Eq. 1 with every stem; stools and trees by Crofton's formula; per metre. */
struct plot_rates {
    int number;
    double stems, both, stools;
};

static const struct plot_rates plot_rates[] = {
    {1, .67253, .46137, 3688 * (.741 + .5 * 8326 / 3688 / M_PI) / 1e4},
    {2, .33740, 1 / 3.51373, 2807 * (.727 + .5 * (2 * (4099. / 2807 - 1)) / M_PI) / 1e4},
};

static void expect_plot(const struct plot_rates *r, uint64_t rocks, const char *how)
{
    struct met m = meet(rocks, 500);
    /* the printed figures have five digits */
    expect_close(named("ADS %d %s, stems per metre", r->number, how), spread_mean(&m.stems), spread_se(&m.stems), r->stems,
                 .5e-5 / 4);
    expect_close(named("ADS %d %s, stools and trees per metre", r->number, how), spread_mean(&m.both), spread_se(&m.both),
                 r->both, .5e-5 / 4);
    expect_mean(named("ADS %d %s, stools per metre", r->number, how), &m.stools, r->stools);
}

TEST(stems_met_per_metre_follow_equation_1_and_stools_crofton)
{
    static const uint64_t rocks[] = {3100, 6200};
    for (size_t i = 0; i < LENGTH(plot_rates); i++) {
        clear_plane(520);
        plane.line.scene.simulation.seed = i + 1;
        plant_plot(plot_rates[i].number, 10, 510);
        expect_plot(&plot_rates[i], rocks[i], "in flight");
    }
}

TEST(a_rolling_rock_meets_the_same_stems_and_continues_unchanged)
{
    struct ceduo_trajectory bare;
    clear_plane(520);
    plane.line.scene.simulation.seed = 3;
    plant_plot(1, 10, 510);
    line_scene_release(&plane.line, 0, 0, 5000, 0, 0);
    expect_plot(&plot_rates[0], 1000, "rolling");
    assert_int_equal(ceduo_trajectory_run(&plane.line.scene, NULL, 0, NULL, &bare, NULL), CEDUO_OK);
    /* a hit leaves the remaining length R of a roll */
    assert_int_equal(sweep.trajectory.contacts, bare.contacts);
    assert_int_equal(bare.contacts, ceil(520 / (B / 2)));
}

TEST(rocks_of_many_sizes_meet_the_stems_of_their_mean)
{
    clear_plane(520);
    plant_plot(1, 10, 510);
    plane.line.scene.rock.diameter = (struct ceduo_number){B, .3, CEDUO_SPREAD_UNIFORM};
    struct met m = meet(3100, 500);
    expect_mean("stems per metre, B .38 to .98 m", &m.stems, per_metre(9076, B + .061));
}

TEST(counts_of_trees_in_a_stretch_are_poisson)
{
    static uint64_t count[COUNTS_MAX];
    struct spread s = {0};
    clear_plane(40);
    struct ceduo_belt *belt = plant_belt(10, 30, 0, 0);
    plant_trees(belt, 2500, .2);
    plant_trees(belt, 500, .45);
    double mean = 20 * (per_metre(2500, B + .2) + per_metre(500, B + .45));
    memset(count, 0, sizeof count);
    for (SWEEP(rock, 200000)) {
        count[sweep.count]++;
        spread_add(&s, (double)sweep.count);
    }
    expect_mean("trees on 20 m, mean", &s, mean);
    expect_variance("trees on 20 m, variance", &s, mean);
    expect_poisson("trees on 20 m, counts", count, mean);
}

static double exponential_cdf(double x, const void *rate)
{
    return -expm1(-x * *(const double *)rate);
}

static double uniform_cdf(double x, const void *unused)
{
    (void)unused;
    return x;
}

/* The same number of gaps from each trajectory, few enough that all have them: otherwise gaps would be too short on average. */
#define GAPS 150
TEST(gaps_between_trees_are_exponential_and_offsets_uniform)
{
    struct sample gaps = {0}, offsets = {0};
    clear_plane(1000);
    struct ceduo_belt *belt = plant_belt(0, 1000, 0, 0);
    plant_trees(belt, 2500, .2);
    plant_trees(belt, 500, .45);
    for (SWEEP(rock, 7000)) {
        EXPECT(sweep.count, >, GAPS);
        for (size_t i = 0; i < GAPS; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
            sample_add(&gaps, s->x - (i > 0 ? s[-1].x : 0));
            sample_add(&offsets, .5 + s->y / (B + s->dbh));
        }
    }
    double rate = per_metre(2500, B + .2) + per_metre(500, B + .45);
    expect_law("gaps between trees, KS", gaps.values, gaps.n, exponential_cdf, &rate);
    expect_law("offsets of trees, KS", offsets.values, offsets.n, uniform_cdf, NULL);
    sample_clear(&gaps);
    sample_clear(&offsets);
}

TEST(the_probability_to_meet_no_stem_in_ten_metres_is_croftons)
{
    const uint64_t rocks = 1000000;
    uint64_t free_runs = 0;
    clear_plane(20);
    plant_plot(1, 5, 15);
    for (SWEEP(rock, rocks)) {
        free_runs += sweep.trajectory.stems_hit == 0;
    }
    expect_share("nothing met of those centred in 10 m", free_runs, rocks, exp(-10 / 2.16747));
    EXPECT_NEAR(exp(-10 / 2.16747), .00992, .5e-5);
}

/* ---- rings ---- */

/* Return the perimeter of the hull of n shoots on a ring. */
static double perimeter(unsigned n, double spacing)
{
    return n < 2 ? 0 : n * spacing;
}

static void expect_stems_per_stool(const char *label, const struct met *m, double expected)
{
    double ratio = spread_mean(&m->stems) / spread_mean(&m->stools);
    double stems = spread_variance(&m->stems), stools = spread_variance(&m->stools);
    double both = (spread_variance(&m->sum) - stems - stools) / 2; /* covariance */
    double variance = fmax(0, stems - 2 * ratio * both + ratio * ratio * stools) / m->sum.n;
    expect_close(label, ratio, sqrt(variance) / spread_mean(&m->stools), expected, 1e-12);
}

TEST(a_ring_is_met_at_the_mean_width_of_its_hull)
{
    static const struct {
        unsigned n;
        double spacing;
    } rings[] = {{1, .5}, {2, .3}, {2, .741}, {3, .5}, {4, .2}, {6, .5}, {9, .1}, {9, .7}};
    const double d = .061, stools = 1500, metres = 500;
    for (size_t i = 0; i < LENGTH(rings); i++) {
        double n = rings[i].n, width = B + d + perimeter(rings[i].n, rings[i].spacing) / M_PI;
        clear_plane(metres + 20);
        plane.line.scene.simulation.seed = i + 1;
        plant_shoots(plant_belt(10, 10 + metres, stools, rings[i].spacing), stools * n, d);
        struct met m = meet((uint64_t)(1.02e6 / metres / per_metre(stools * n, B + d)), metres);
        expect_mean(named("stools of %u, %.3f m apart, per metre", rings[i].n, rings[i].spacing), &m.stools,
                    per_metre(stools, width));
        expect_mean(named("stems of stools of %u, %.3f m apart, per metre", rings[i].n, rings[i].spacing), &m.stems,
                    per_metre(stools * n, B + d));
        expect_stems_per_stool(named("stems per stool of %u met, %.3f m apart", rings[i].n, rings[i].spacing), &m,
                               n * (B + d) / width);
    }
}

/* Return the mean width, over all directions, from which both of two shoots `distance` metres from one another are met. */
static double width_of_both(double width, double distance)
{
    double angle = distance > width ? asin(width / distance) : M_PI / 2;
    return 2 / M_PI * (width * angle - distance * (1 - cos(angle)));
}

/* Return that sum over all ordered pairs of a ring: the contribution of clumping to the variance. */
static double pairs_of_ring(unsigned n, double spacing, double width)
{
    double sum = 0, r = spacing / 2 / sin(M_PI / n);
    for (unsigned i = 1; i < n; i++)
        sum += n * width_of_both(width, 2 * r * sin(M_PI * i / n));
    return sum;
}

TEST(clumping_changes_the_spread_but_not_the_mean)
{
    const double d = .06, spacing = .5, mean = 50 * per_metre(6000, B + d);
    const uint64_t rocks = 50000;
    clear_plane(70);
    plant_trees(plant_belt(10, 60, 0, 0), 6000, d);
    struct spread single = meet(rocks, 1).stems;
    clear_plane(70);
    plane.line.scene.simulation.seed = 2;
    plant_shoots(plant_belt(10, 60, 1000, spacing), 6000, d);
    struct spread clumped = meet(rocks, 1).stems;
    expect_mean("hits on 50 m, single stems", &single, mean);
    expect_mean("hits on 50 m, stools of 6", &clumped, mean);
    expect_close("hits on 50 m, one beside the other", spread_mean(&clumped), spread_se(&clumped), spread_mean(&single),
                 spread_se(&single));
    expect_variance("variance on 50 m, single stems", &single, mean);
    expect_variance("variance on 50 m, stools of 6", &clumped, mean + 50 * per_metre(1000, pairs_of_ring(6, spacing, B + d)));
    EXPECT(spread_variance(&clumped), >,
           spread_variance(&single) + 10 * hypot(spread_variance_se(&single), spread_variance_se(&clumped)));
}

/* ---- diameters ---- */

/* Diameters of met stems if all have a gamma law. A stem is met from a strip B + d wide, so that thick ones are met more often,
 * with density proportional to (B + d)f(d). This is f with weight B plus f weighted by d, which is a gamma law with a shape
 * larger by one, with weight mean d. */
struct biased {
    double mean, shape, scale;
};

static struct biased make_biased(double mean, double sd)
{
    return (struct biased){mean, mean * mean / (sd * sd), sd * sd / mean};
}

static double biased_cdf(double d, const void *context)
{
    const struct biased *l = context;
    return (B * gsl_cdf_gamma_P(d, l->shape, l->scale) + l->mean * gsl_cdf_gamma_P(d, l->shape + 1, l->scale)) / (B + l->mean);
}

/* Return the k-th moment of the gamma law. */
static double gamma_moment(const struct biased *l, int k)
{
    double m = 1;
    for (int i = 0; i < k; i++)
        m *= l->scale * (l->shape + i);
    return m;
}

static void expect_biased(const char *name, double per_ha, double mean, double sd, uint64_t rocks, double metres)
{
    struct biased law = make_biased(mean, sd);
    struct spread per = {0}, dbh = {0};
    struct sample all = {0};
    for (SWEEP(rock, rocks)) {
        spread_add(&per, (double)sweep.count / metres);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
            if (!(fabs(s->y) <= (B + s->dbh) / 2))
                fail_msg("%s: a stem %.17g m thick is met %.17g m off", name, s->dbh, s->y);
            spread_add(&dbh, s->dbh);
            if (i % 4 == 0) /* enough of them */
                sample_add(&all, s->dbh);
        }
    }
    expect_mean(named("%s, met per metre", name), &per, per_metre(per_ha, B + mean));
    double first = (B * mean + gamma_moment(&law, 2)) / (B + mean);
    double second = (B * gamma_moment(&law, 2) + gamma_moment(&law, 3)) / (B + mean);
    expect_mean(named("%s, mean dbh of those met", name), &dbh, first);
    expect_variance(named("%s, variance of it", name), &dbh, second - first * first);
    expect_law(named("%s, law of it, KS", name), all.values, all.n, biased_cdf, &law);
    sample_clear(&all);
}

TEST(thick_stems_are_met_more_often)
{
    clear_plane(520);
    plant_trees(plant_belt(10, 510, 0, 0), 4000, .2)->dbh_sd = .1;
    expect_biased("trees .2 ± .1 m", 4000, .2, .1, 5800, 500);
    clear_plane(520);
    plant_trees(plant_belt(10, 510, 0, 0), 4000, .3)->dbh_sd = .36; /* mostly thin */
    expect_biased("trees .3 ± .36 m", 4000, .3, .36, 5200, 500);
    clear_plane(520);
    plant_shoots(plant_belt(10, 510, 2000, .3), 9000, .1)->dbh_sd = .04;
    expect_biased("shoots .1 ± .04 m", 9000, .1, .04, 2900, 500);
}

static void expect_same_stems(const struct ceduo_stem_encounter *a, size_t n)
{
    assert_int_equal(n, sweep.count);
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_stem_encounter *p = &a[i], *q = &sweep.stems[i];
        if (p->x != q->x || p->y != q->y || p->dbh != q->dbh || p->height != q->height || p->shoot != q->shoot ||
            p->stool != q->stool || p->hit != q->hit || p->before != q->before || p->taken != q->taken)
            fail_msg("stem %zu is another", i);
    }
}

/* A spread of 0 is no spread, and a tiny one moves diameters and offsets by a tiny amount. */
TEST(diameters_without_spread_change_nothing)
{
    static struct ceduo_stem_encounter plain[STEMS_MAX];
    for (uint64_t rock = 0; rock < 200; rock++) {
        clear_plane(520);
        plant_plot(1, 10, 510);
        sweep_one(rock);
        size_t n = sweep.count;
        struct ceduo_trajectory trajectory = sweep.trajectory;
        memcpy(plain, sweep.stems, n * sizeof *plain);
        plane.trees[0][0].dbh_sd = plane.shoots[0][0].dbh_sd = 0;
        sweep_one(rock);
        expect_same_stems(plain, n);
        assert_memory_equal(&trajectory, &sweep.trajectory, sizeof trajectory);
        plane.trees[0][0].dbh_sd = 1e-9;
        sweep_one(rock);
        assert_int_equal(n, sweep.count);
        for (size_t i = 0; i < n; i++)
            if (plain[i].x != sweep.stems[i].x || fabs(plain[i].y - sweep.stems[i].y) > 1e-8 ||
                fabs(plain[i].dbh - sweep.stems[i].dbh) > 1e-8)
                fail_msg("stem %zu moves", i);
    }
}

/* In a belt with varying diameters no met shoot has the mean, not even at the border to belts without variation. */
TEST(shoots_keep_their_diameters_beside_others)
{
    size_t near = 0;
    for (uint64_t rock = 0; rock < 300; rock++) {
        clear_plane(60);
        plant_shoots(plant_belt(10, 30, 2000, .5), 12000, .1)->dbh_sd = .04;
        plant_shoots(plant_belt(30, 50, 2000, .5), 8000, .05);
        sweep_one(rock);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *p = &sweep.stems[i];
            if (p->dbh == .1)
                fail_msg("a stem at %g m of rock %d has the mean diameter", p->x, (int)rock);
            near += p->x > 29 && p->dbh != .05;
        }
    }
    assert_in_range(near, 200, 100000);
}

/* Stools with all shoots at their centre: the rock meets the shoots one by one in the order of their draws, as if each were
 * inserted alone. */
TEST(shoots_at_one_place_are_met_in_their_order)
{
    static struct ceduo_stem_encounter plain[STEMS_MAX];
    for (uint64_t rock = 0; rock < 200; rock++) {
        clear_plane(520);
        struct ceduo_belt *few = plant_belt(10, 260, 800, 0), *many = plant_belt(260, 510, 800, 0);
        plant_shoots(few, 2400, .05);
        plant_shoots(few, 1000, .08);
        plant_shoots(many, 8000, .06);
        sweep_one(rock);
        size_t n = sweep.count;
        assert_true(n > 100);
        memcpy(plain, sweep.stems, n * sizeof *plain);
        plane.shoots[0][0].dbh_sd = plane.shoots[0][1].dbh_sd = plane.shoots[1][0].dbh_sd = 1e-9;
        sweep_one(rock);
        assert_int_equal(n, sweep.count);
        for (size_t i = 0; i < n; i++)
            if (fabs(plain[i].x - sweep.stems[i].x) > 1e-3 || plain[i].stool != sweep.stems[i].stool ||
                fabs(plain[i].dbh - sweep.stems[i].dbh) > 1e-7)
                fail_msg("stem %zu of rock %d is another", i, (int)rock);
    }
}

/* ---- belts of several kinds ---- */

/* Heights that identify a stem's kind: 1000 m plus one for each planted kind. */
static struct planted {
    const struct ceduo_belt *belt;
    const struct ceduo_stems *stems;
    bool shoots;
} planted[4 * KINDS_MAX];
static size_t planted_count;

static void plant_random(struct line_random *r, struct ceduo_belt *belt, bool shoots)
{
    double dbh = line_uniform(r, .03, .3);
    double per_ha = shoots ? belt->stand.stools_per_ha * line_uniform(r, .6, 9) : line_log_uniform(r, 10, 2000);
    struct ceduo_stems *s = shoots ? plant_shoots(belt, per_ha, dbh) : plant_trees(belt, per_ha, dbh);
    s->height = 100 + (double)planted_count;
    s->dbh_sd = line_chance(r, .4) ? dbh * line_uniform(r, .05, .9) : 0;
    if (!shoots && line_chance(r, .4)) {
        s->group = (unsigned)line_uniform(r, 2, 12);
        s->group_radius = line_uniform(r, .1, 4);
    }
    planted[planted_count++] = (struct planted){belt, s, shoots};
}

static void plant_belts_at_random(struct line_random *r)
{
    double border = line_uniform(r, 20, 40);
    planted_count = 0;
    for (int i = 0; i < 2; i++) {
        double stools = line_chance(r, .8) ? line_log_uniform(r, 100, 6000) : 0;
        double spacing = line_chance(r, .2) ? 0 : line_log_uniform(r, .02, 3);
        struct ceduo_belt *belt = plant_belt(i == 0 ? 5 : border, i == 0 ? border : 60, stools, spacing);
        for (double n = stools > 0 ? line_uniform(r, 1, 3.9) : 0; n >= 1; n--)
            plant_random(r, belt, true);
        for (double n = line_uniform(r, 0, 2.9); n >= 1; n--)
            plant_random(r, belt, false);
    }
}

static double per_stool(const struct ceduo_stand *stand)
{
    return ceduo_stand_shoots(stand) / stand->stools_per_ha;
}

/* Return the maximum distance of a shoot from the centre of its stool. */
static double ring_reach(const struct ceduo_stand *stand)
{
    unsigned n = (unsigned)floor(per_stool(stand));
    return fmax(ceduo_stool_radius(n, stand->spacing), ceduo_stool_radius(n + 1, stand->spacing));
}

static const struct planted *find_planted(const struct ceduo_stem_encounter *stem)
{
    size_t k = (size_t)(stem->height - 100);
    assert_true(k < planted_count);
    return &planted[k];
}

static void expect_one_of_those_planted(const struct ceduo_stem_encounter *stem)
{
    const struct planted *source = find_planted(stem);
    assert_int_equal(stem->shoot, source->shoots);
    if ((stem->dbh == source->stems->dbh) != (source->stems->dbh_sd == 0))
        fail_msg("a stem of %g m where %g ± %g m were planted", stem->dbh, source->stems->dbh, source->stems->dbh_sd);
    assert_true(fabs(stem->y) <= (B + stem->dbh) / 2);
    double reach = stem->shoot ? ring_reach(&source->belt->stand) * (1 + 1e-12) + 1e-12 : 0;
    assert_true(stem->x >= source->belt->from - reach && stem->x <= source->belt->to + reach);
}

/* Expect of each stool at most its number of shoots, all in one belt, and no tree number twice. */
static void expect_whole_stools(void)
{
    for (size_t i = 0; i < sweep.count; i++) {
        const struct ceduo_stem_encounter *p = &sweep.stems[i];
        const struct planted *source = find_planted(p);
        size_t equal = 0;
        for (size_t j = 0; j < sweep.count; j++)
            if (sweep.stems[j].stool == p->stool) {
                assert_ptr_equal(find_planted(&sweep.stems[j])->belt, source->belt);
                equal++;
            }
        assert_in_range(equal, 1, p->shoot ? (size_t)ceil(per_stool(&source->belt->stand)) : 1);
    }
}

TEST(stems_of_random_belts_are_planted_ones)
{
    struct line_random r = {.state = 17};
    size_t all = 0;
    for (unsigned i = 0; i < 300; i++) {
        clear_plane(70);
        plane.line.scene.simulation.seed = i;
        plant_belts_at_random(&r);
        if (line_chance(&r, .3)) /* mixed with them */
            line_scene_release(&plane.line, line_uniform(&r, 0, 50), 1, 5000, 0, 0);
        for (SWEEP(rock, 5)) {
            all += sweep.count;
            for (size_t k = 0; k < sweep.count; k++) {
                expect_one_of_those_planted(&sweep.stems[k]);
                assert_true(k == 0 || sweep.stems[k].x >= sweep.stems[k - 1].x);
            }
            expect_whole_stools();
        }
    }
    assert_in_range(all, 20000, 1000000);
}

/* ---- extremes ---- */

static void expect_stems_per_metre(const char *label, double expected, uint64_t rocks, double metres)
{
    struct met m = meet(rocks, metres);
    expect_mean(label, &m.stems, expected);
}

TEST(extreme_stands_have_the_expected_encounters)
{
    clear_plane(170);
    plant_shoots(plant_belt(10, 160, 5000, .1), 100000, .02);
    expect_stems_per_metre("100 000 shoots/ha", per_metre(100000, B + .02), 1000, 150);
    clear_plane(1.2e8);
    plant_trees(plant_belt(1e7, 1.1e8, 0, 0), .1, .3);
    expect_stems_per_metre("0.1 trees/ha", per_metre(.1, B + .3), 1050, 1e8);
    clear_plane(540);
    plant_shoots(plant_belt(20, 520, 1500, 3), 6000, .06); /* the rock passes between the shoots of a stool */
    expect_stems_per_metre("shoots 3 m apart", per_metre(6000, B + .06), 4600, 500);
    clear_plane(300);
    plant_shoots(plant_belt(20, 220, 50, .1), 10000, .05);
    expect_stems_per_metre("200 shoots .1 m apart", per_metre(10000, B + .05), 7000, 200);
    clear_plane(300);
    plant_shoots(plant_belt(50, 250, 50, .5), 10000, .05);
    expect_stems_per_metre("200 shoots .5 m apart", per_metre(10000, B + .05), 7000, 200);
}
