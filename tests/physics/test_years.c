/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: threads */
/* An option year by year, compared with the same stands grown, simulated and assessed one by one. */
#include "core/runs/assess.h"
#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/year_runs.h"
#include "core/stand/rotation.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "paper_site.h"
#include "runs.h"

#define ROCKS    1300 /* more than a batch */
#define BELTS    3
#define CONTROLS 3
#define ROTATION 9

/* ---- a forest that grows and is cut ---- */

struct wood {
    struct paper_site site;
    struct ceduo_control controls[CONTROLS];
    struct ceduo_belt belts[BELTS];
    struct ceduo_option option;
    struct ceduo_stems shoots, trees[2];
    double stay[2];
};

static struct wood wood; /* contains pointers into itself */

/* A coppice cut in year 4, a selection coppice, and one without growth. */
static void init(void)
{
    static char names[BELTS][4] = {"one", "two", "old"};
    paper_site_init(&wood.site);
    struct ceduo_scene *scene = &wood.site.scene;
    scene->rocks_per_year = NAN;
    wood.shoots = paper_stems(7500, .05, 6);
    wood.trees[0] = paper_stems(40, .15, 9);
    wood.trees[1] = paper_stems(20, .30, 14);
    wood.stay[0] = 30;
    wood.stay[1] = 10;
    struct ceduo_stand stand = paper_coppice(&wood.shoots, wood.trees, 2, ROTATION, wood.stay);
    for (int i = 0; i < BELTS; i++) {
        double from = 40 * i, to = 40 * i + 35;
        wood.belts[i] = (struct ceduo_belt){.from = from,
                                            .to = to,
                                            .from_given = from,
                                            .to_given = to,
                                            .name = names[i],
                                            .cut_year = i == 0 ? 4 : NAN,
                                            .stand = stand};
    }
    wood.belts[1].stand.cutting.cohorts = 3;
    wood.belts[2].stand.growth = (struct ceduo_growth){.sdi_max = 0};
    wood.option = (struct ceduo_option){.belts_count = BELTS, .belts = wood.belts};
    wood.controls[0] = (struct ceduo_control){.x = 60, .x_given = 60, .accepted = NAN, .measured_speed = NAN};
    wood.controls[1] = (struct ceduo_control){.x = 135, .x_given = 135, .accepted = 50e3, .measured_speed = NAN};
    wood.controls[2] = (struct ceduo_control){.x = 100, .x_given = 100, .accepted = 20e3, .measured_speed = 9};
    scene->controls = wood.controls;
    scene->controls_count = CONTROLS;
    scene->options = &wood.option;
    scene->options_count = 1;
}

/* Set-up of each test. */
static int fresh(void **state)
{
    (void)state;
    init();
    return 0;
}

static struct ceduo_pool *make_pool(unsigned threads, const atomic_bool *cancel)
{
    struct ceduo_run_def def = ceduo_run_def_default(&wood.site.scene);
    def.threads = threads;
    def.cancel = cancel;
    def.rocks_max = CEDUO_ROCKS_MAX;
    struct ceduo_pool *pool;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    return pool;
}

static struct ceduo_years *grow_years(unsigned first, unsigned last, unsigned step)
{
    struct ceduo_years *years;
    assert_int_equal(ceduo_years_create(&wood.site.scene, &wood.option,
                                        (struct ceduo_window){.first = first, .last = last, .step = step}, &years),
                     CEDUO_OK);
    return years;
}

static struct ceduo_simulated simulate_bare(uint64_t rocks)
{
    LOCAL(ceduo_run, run) = run_option(&wood.site.scene, NULL, rocks, 1);
    struct ceduo_simulated bare;
    assert_int_equal(ceduo_simulated_read(run, &wood.site.scene, NULL, &bare), CEDUO_OK);
    return bare;
}

/* Grow and simulate with a temporary pool. */
static struct ceduo_years *simulate_years(unsigned first, unsigned last, unsigned step, unsigned threads, uint64_t rocks)
{
    struct ceduo_years *years = grow_years(first, last, step);
    LOCAL(ceduo_pool, pool) = make_pool(threads, NULL);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(rocks);
    assert_int_equal(ceduo_years_simulate(years, pool, &bare, rocks), CEDUO_OK);
    return years;
}

/* ---- equal bits ---- */

static void expect_same(const char *label, double a, double b)
{
    if (memcmp(&a, &b, sizeof a) != 0 && !(isnan(a) && isnan(b)))
        fail_msg("%s: %.17g is not %.17g", label, a, b);
}

/* Compare numbers of the same members in two structs bit by bit. */
#define EXPECT_FIELD_BITS_IN(a, b, field) expect_same(#field, (a)->field, (b)->field);
#define EXPECT_FIELD_BITS(both, field)    WITH_UNWRAPPED(EXPECT_FIELD_BITS_IN, UNWRAP both, field)
#define EXPECT_BITS(a, b, ...)                                                                                                 \
    do {                                                                                                                       \
        EACH(EXPECT_FIELD_BITS, (a, b), __VA_ARGS__)                                                                           \
    } while (0)

static void expect_same_distribution(const struct ceduo_distribution *a, const struct ceduo_distribution *b)
{
    EXPECT_BITS(a, b, mean, se, sd, p50, p95, p95_lo, p95_hi, p99, max);
}

static void expect_same_arrivals(const struct ceduo_arrivals *a, const struct ceduo_arrivals *b)
{
    EXPECT_SAME(*a, *b, released, reached, exceeded, unfinished);
    EXPECT_BITS(a, b, reach.mean, reach.lo, reach.hi, exceed.mean, exceed.lo, exceed.hi);
    ROWS(expect_same_distribution, (&a->speed, &b->speed), (&a->energy, &b->energy), (&a->translation, &b->translation),
         (&a->height, &b->height));
    EXPECT_BITS(a, b, energy_per_released.mean, energy_per_released.se, contacts.mean, contacts.se);
}

static void expect_same_ends(const struct ceduo_ends *a, const struct ceduo_ends *b)
{
    assert_memory_equal(a->count, b->count, sizeof a->count);
    EXPECT_BITS(a, b, stop_p50, stop_p95, stop_max);
}

static void expect_same_index(const struct ceduo_index *a, const struct ceduo_index *b)
{
    EXPECT_BITS(a, b, length, longest_gap, contacts, dissipated, meet_nothing_probability, worst_adc, worst_free_run, residual,
                measured);
    EXPECT_SAME(*a, *b, exhausted, contact, free_run, energy);
}

static void expect_same_stand(const struct ceduo_stand_result *a, const struct ceduo_stand_result *b)
{
    EXPECT_BITS(a, b, length, stems_per_ha, stools_per_ha, trees_per_ha, basal_area, adc_m, free_run_probability, contacts,
                energy_per_contact, dissipated);
    assert_true(a->bare || a->rule == b->rule);
    EXPECT_SAME(*a, *b, bare, passes_threshold, warnings);
}

static void expect_same_year(const struct ceduo_year *a, const struct ceduo_year *b)
{
    ROWS(EXPECT, (a->cut, ==, b->cut), (a->option.belts_count, ==, b->option.belts_count),
         (a->wooded.rocks, ==, b->wooded.rocks));
    for (size_t i = 0; i < a->option.belts_count; i++)
        expect_same_stand(&a->stands[i], &b->stands[i]);
    for (size_t c = 0; c < CONTROLS; c++) {
        expect_same_index(&a->controls[c], &b->controls[c]);
        if (a->wooded.rocks > 0)
            expect_same_arrivals(&a->wooded.arrivals[c], &b->wooded.arrivals[c]);
    }
    if (a->wooded.rocks > 0)
        expect_same_ends(&a->wooded.ends, &b->wooded.ends);
}

/* ---- comparison with separate runs ---- */

/* Simulate one year directly: stands, one run, its results. */
static void expect_direct(const struct ceduo_year *y, const struct ceduo_simulated *bare)
{
    const struct ceduo_scene *scene = &wood.site.scene;
    struct ceduo_grown_stand stands[BELTS];
    struct ceduo_belt belts[BELTS];
    bool cut = false;
    for (int i = 0; i < BELTS; i++) {
        assert_int_equal(ceduo_stand_at(&wood.belts[i].stand, wood.belts[i].cut_year, y->year, &stands[i]), CEDUO_OK);
        belts[i] = wood.belts[i];
        belts[i].stand = stands[i].stand;
        bool felled = ceduo_stand_is_cut_year(&wood.belts[i].stand, wood.belts[i].cut_year, y->year);
        EXPECT(y->option.belts[i].felled, ==, felled);
        cut |= felled;
    }
    EXPECT(y->cut, ==, cut);
    EXPECT(y->option.belts_count, ==, BELTS);
    struct ceduo_option option = {.belts_count = BELTS, .belts = belts};
    LOCAL(ceduo_run, run) = run_option(&wood.site.scene, &option, ROCKS, 1);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated direct;
    assert_int_equal(ceduo_simulated_read(run, &wood.site.scene, NULL, &direct), CEDUO_OK);
    EXPECT(y->wooded.rocks, ==, ROCKS);
    EXPECT(direct.rocks, ==, ROCKS);
    expect_same_ends(&y->wooded.ends, &direct.ends);
    for (int i = 0; i < BELTS; i++) {
        struct ceduo_stand_result stand = ceduo_assess_stand(scene, &belts[i]);
        expect_same_stand(&y->stands[i], &stand);
    }
    for (size_t c = 0; c < CONTROLS; c++) {
        expect_same_arrivals(&y->wooded.arrivals[c], &direct.arrivals[c]);
        struct ceduo_index index = ceduo_assess_index(scene, &option, &scene->controls[c], bare->arrivals[c].energy.mean);
        index.energy = ceduo_energy_light(&direct.arrivals[c]);
        expect_same_index(&y->controls[c], &index);
    }
    for (int i = 0; i < BELTS; i++)
        ceduo_grown_stand_release(&stands[i]);
}

TEST_WITH(years_equal_separate_runs, fresh, NULL)
{
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(ROCKS);
    LOCAL(ceduo_years, years) = simulate_years(0, 26, 1, 2, ROCKS);
    assert_int_equal(years->count, 27);
    unsigned cuts = 0;
    for (size_t i = 0; i < years->count; i++) {
        assert_int_equal(years->years[i].year, i);
        cuts += years->years[i].cut;
        expect_direct(&years->years[i], &bare);
    }
    assert_int_equal(cuts, 5); /* 4, 13 and 22 of the coppice; 10 and 19 of the selection coppice, then 27 years old */
}

TEST_WITH(year_0_is_the_result, fresh, NULL)
{
    LOCAL(ceduo_pool, pool) = make_pool(1, NULL);
    LOCAL(ceduo_result, result);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_extend(pool, ROCKS), CEDUO_OK);
    assert_int_equal(ceduo_result_create(&wood.site.scene, pool, &result), CEDUO_OK);
    LOCAL(ceduo_years, years) = grow_years(0, 0, 1);
    assert_int_equal(ceduo_years_simulate(years, pool, &result->bare, ROCKS), CEDUO_OK);
    const struct ceduo_year *y = &years->years[0];
    for (size_t c = 0; c < CONTROLS; c++) {
        expect_same_arrivals(&y->wooded.arrivals[c], &result->options[0].wooded.arrivals[c]);
        expect_same_index(&y->controls[c], &result->options[0].controls[c]);
    }
    for (int i = 0; i < BELTS; i++)
        expect_same_stand(&y->stands[i], &result->options[0].stands[i]);
    assert_int_equal(ceduo_pool_work(pool).runs, 2); /* without forest, and the existing run */
}

TEST_WITH(steps_and_stretches_pick_from_all, fresh, NULL)
{
    LOCAL(ceduo_years, all) = simulate_years(0, 20, 1, 1, 300);
    static const unsigned stretches[][3] = {{3, 3, 1}, {2, 20, 6}, {0, 19, 7}, {5, 6, 50}};
    for (size_t k = 0; k < sizeof stretches / sizeof stretches[0]; k++) {
        unsigned first = stretches[k][0], last = stretches[k][1], step = stretches[k][2];
        LOCAL(ceduo_years, some) = simulate_years(first, last, step, 1, 300);
        assert_int_equal(some->count, (last - first) / step + 1);
        for (size_t i = 0; i < some->count; i++) {
            assert_int_equal(some->years[i].year, first + i * step);
            expect_same_year(&some->years[i], &all->years[some->years[i].year]);
        }
    }
}

TEST_WITH(threads_and_steps_change_nothing, fresh, NULL)
{
    LOCAL(ceduo_years, one) = simulate_years(0, 5, 1, 1, 3000);
    LOCAL(ceduo_years, two) = simulate_years(0, 5, 1, 2, 3000);
    LOCAL(ceduo_years, steps) = grow_years(0, 5, 1);
    LOCAL(ceduo_pool, pool) = make_pool(2, NULL);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(3000);
    static const uint64_t rocks[] = {1, 1024, 1500, 3000, 2000}; /* runs never shrink */
    for (size_t i = 0; i < sizeof rocks / sizeof rocks[0]; i++)
        assert_int_equal(ceduo_years_simulate(steps, pool, &bare, rocks[i]), CEDUO_OK);
    for (size_t i = 0; i < one->count; i++) {
        expect_same_year(&one->years[i], &two->years[i]);
        expect_same_year(&one->years[i], &steps->years[i]);
    }
}

TEST_WITH(a_forest_is_simulated_once, fresh, NULL)
{
    wood.belts[1].stand.cutting.cohorts = 1;
    wood.belts[1].cut_year = 7;
    LOCAL(ceduo_years, years) = grow_years(0, 40, 1);
    LOCAL(ceduo_pool, pool) = make_pool(2, NULL);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(100);
    assert_int_equal(ceduo_years_simulate(years, pool, &bare, 100), CEDUO_OK);
    struct ceduo_work work = ceduo_pool_work(pool);
    ROWS(EXPECT, (work.runs, ==, 7 + ROTATION), (work.runs + work.reused, ==, 41), (work.rocks, ==, 100 * work.runs));
    for (size_t i = 7; i + ROTATION < years->count; i++)
        expect_same_year(&years->years[i], &years->years[i + ROTATION]);
}

/* ---- sums ---- */

#define SUMMED 400 /* rocks */

/* Sums over the years at each control, from single trajectories. The judged share at the last control has the error of each
 * rock's own mean; the other figures have the error of all years as one. */
struct by_hand {
    double reach, exceed, energy, reach_se, exceed_se, energy_se, worst;
    unsigned worst_year;
};

static double read_energy(const struct ceduo_rock *rock, const struct ceduo_crossing *at)
{
    return .5 * rock->mass * (at->vx * at->vx + at->vz * at->vz) + .5 * rock->moment * at->spin * at->spin;
}

static double read_error(double sum, double squares)
{
    return sqrt((squares - sum * sum / SUMMED) / (SUMMED - 1) / SUMMED);
}

/* Add one year at control c; `own` sums each rock's share. */
static void add_year(struct by_hand *to, const struct ceduo_years *years, size_t i, size_t c, double own[SUMMED])
{
    const struct ceduo_scene *scene = &years->scene;
    double accepted = scene->controls[c].accepted, n = (double)years->count, reach = 0, exceed = 0, sum = 0, squares = 0;
    LOCAL(ceduo_tracer, f) = ceduo_tracer_create(scene, &years->years[i].option);
    assert_non_null(f);
    for (uint64_t r = 0; r < SUMMED; r++) {
        struct ceduo_crossing at[CONTROLS];
        struct ceduo_trajectory trajectory;
        assert_int_equal(ceduo_tracer_run(f, r, NULL, &trajectory, at), CEDUO_OK);
        double energy = at[c].reached ? read_energy(&trajectory.rock, &at[c]) : 0;
        bool above = at[c].reached && energy > accepted;
        reach += at[c].reached;
        exceed += above;
        sum += energy;
        squares += energy * energy;
        own[r] += (isnan(accepted) ? at[c].reached : above) / n;
    }
    reach /= SUMMED, exceed /= SUMMED;
    double share = isnan(accepted) ? reach : exceed;
    to->reach += reach / n;
    to->exceed += isnan(accepted) ? NAN : exceed / n;
    to->energy += sum / SUMMED / n;
    to->reach_se += sqrt(reach * (1 - reach) / SUMMED) / n;
    to->exceed_se += isnan(accepted) ? NAN : sqrt(exceed * (1 - exceed) / SUMMED) / n;
    to->energy_se += read_error(sum, squares) / n;
    if (share > to->worst) {
        to->worst = share;
        to->worst_year = years->years[i].year;
    }
}

static struct by_hand sum_by_hand(const struct ceduo_years *years, size_t c)
{
    struct by_hand h = {.worst = -1};
    double own[SUMMED] = {0}, sum = 0, squares = 0;
    for (size_t i = 0; i < years->count; i++)
        add_year(&h, years, i, c, own);
    for (size_t r = 0; r < SUMMED; r++) {
        sum += own[r];
        squares += own[r] * own[r];
    }
    if (c == years->last_control)
        *(isnan(h.exceed) ? &h.reach_se : &h.exceed_se) = read_error(sum, squares);
    return h;
}

static void expect_sum(const struct ceduo_years *years, size_t c)
{
    struct ceduo_years_summary s = ceduo_years_summarize(years, c);
    struct by_hand h = sum_by_hand(years, c);
    size_t contact = 0, free_run = 0, light = 0;
    for (size_t i = 0; i < years->count; i++) {
        contact += years->years[i].controls[c].contact == CEDUO_LIGHT_FAIL;
        free_run += years->years[i].controls[c].free_run == CEDUO_LIGHT_FAIL;
        light += years->years[i].controls[c].energy == CEDUO_LIGHT_FAIL;
    }
    EXPECT_IS(s, (years, years->count), (simulated, years->count), (worst_year, h.worst_year), (unprotected_contact, contact),
              (unprotected_free_run, free_run), (unprotected_energy, light));
    const double pairs[][2] = {{s.worst, h.worst},
                               {s.reach.mean, h.reach},
                               {s.reach.se, h.reach_se},
                               {s.exceed.mean, h.exceed},
                               {s.exceed.se, h.exceed_se},
                               {s.energy_per_released.mean, h.energy},
                               {s.energy_per_released.se, h.energy_se},
                               {s.passes_per_year, h.reach * years->scene.rocks_per_year},
                               {s.exceeds_per_year, h.exceed * years->scene.rocks_per_year}};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++)
        if (!(fabs(pairs[i][0] - pairs[i][1]) <= 1e-12 * fabs(pairs[i][1])) && !(isnan(pairs[i][0]) && isnan(pairs[i][1])))
            fail_msg("control %zu, figure %zu: %.17g is not %.17g", c, i, pairs[i][0], pairs[i][1]);
}

TEST(sums_over_the_years)
{
    for (int rate = 0; rate < 2; rate++) {
        init();
        wood.site.scene.rocks_per_year = rate ? 2.5 : NAN;
        LOCAL(ceduo_years, years) = simulate_years(0, 22, 2, 2, SUMMED);
        for (size_t c = 0; c < CONTROLS; c++)
            expect_sum(years, c);
        assert_true(isnan(ceduo_years_summarize(years, 0).exceed.mean)); /* no accepted energy */
    }
}

/* For blocks of all sizes the shares of years are weighted; the error is the residual of a regression on the weights. */
TEST(years_of_blocks)
{
    enum { FEW = 300 };
    static double volumes[] = {.05, 1}, marks[2][FEW];
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    struct ceduo_years *years[2];
    double weights[FEW];
    init();
    wood.site.scene.blocks = &blocks;
    wood.site.scene.blocks_count = 1;
    for (int i = 0; i < 2; i++) {
        wood.belts[1].stand.stools_per_ha = i == 0 ? 2500 : 600;
        years[i] = simulate_years(3, 7, 2, 1, FEW);
        for (size_t r = 0; r < FEW; r++)
            marks[i][r] = 0;
        for (size_t y = 0; y < years[i]->count; y++) {
            LOCAL(ceduo_run, run) = run_option(&wood.site.scene, &years[i]->years[y].option, FEW, 1);
            const double *energies = ceduo_run_samples(run, years[i]->last_control, CEDUO_SAMPLE_ENERGY);
            for (size_t r = 0; r < FEW; r++) {
                marks[i][r] += (energies[r] > 50e3) / 3.;
                weights[r] = ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT)[r];
            }
        }
    }
    for (int which = 0; which < 3; which++) { /* each of the two, and their difference */
        double w1 = 0, x1 = 0, ww = 0, wx = 0, xx = 0, x[FEW];
        for (size_t r = 0; r < FEW; r++) {
            x[r] = weights[r] * (which < 2 ? marks[which][r] : marks[0][r] - marks[1][r]);
            w1 += weights[r] / FEW;
            x1 += x[r] / FEW;
        }
        for (size_t r = 0; r < FEW; r++) {
            ww += (weights[r] - w1) * (weights[r] - w1);
            wx += (weights[r] - w1) * (x[r] - x1);
            xx += (x[r] - x1) * (x[r] - x1);
        }
        struct ceduo_estimate found = which < 2 ? ceduo_years_summarize(years[which], years[which]->last_control).exceed
                                                : ceduo_years_difference(years[0], years[1]);
        EXPECT_NEAR(found.mean, x1 / w1, 1e-12);
        EXPECT_NEAR(found.se, sqrt((xx - wx * wx / ww) / FEW / (FEW - 1)) / w1, 1e-12);
        EXPECT(fabs(found.mean), >, 0);
    }
    ceduo_years_free(years[0]);
    ceduo_years_free(years[1]);
}

TEST_WITH(metres_felled, fresh, NULL)
{
    double whole = 0;
    for (int i = 0; i < BELTS; i++) { /* all three equal, each in another year */
        wood.belts[i].stand = wood.belts[0].stand;
        wood.belts[i].cut_year = 4 - 7 * i;
        whole += wood.belts[i].to - wood.belts[i].from;
    }
    for (unsigned first = 9; first < 20; first++) {
        LOCAL(ceduo_years, years) = grow_years(first, first + 3 * ROTATION - 1, 1);
        EXPECT(ceduo_years_felled(years), ==, 3 * whole);
        double by_hand = 0;
        for (size_t i = 0; i < years->count; i++)
            for (int k = 0; k < BELTS; k++)
                by_hand += years->years[i].option.belts[k].stand.stools_per_ha == 0 ? wood.belts[k].to - wood.belts[k].from : 0;
        EXPECT(by_hand, ==, 3 * whole); /* no stools stand just after the cut */
    }
    LOCAL(ceduo_years, years) = grow_years(5, 6, 1);                              /* freed without a simulation */
    EXPECT(ceduo_years_felled(years), ==, wood.belts[1].to - wood.belts[1].from); /* -3: 6 */
}

TEST_WITH(by_the_index_alone, fresh, NULL)
{
    wood.site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    LOCAL(ceduo_years, years) = grow_years(0, 15, 1);
    LOCAL(ceduo_pool, pool) = make_pool(1, NULL);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(200);
    assert_int_equal(ceduo_years_simulate(years, pool, &bare, 200), CEDUO_OK);
    assert_int_equal(ceduo_pool_work(pool).runs, 0);
    double worst = 0;
    unsigned worst_year = 0;
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *y = &years->years[i];
        EXPECT(y->wooded.rocks, ==, 0);
        EXPECT(y->controls[1].energy, ==, CEDUO_LIGHT_UNKNOWN);
        if (y->controls[1].worst_adc > worst) {
            worst = y->controls[1].worst_adc;
            worst_year = y->year;
        }
    }
    struct ceduo_years_summary s = ceduo_years_summarize(years, 1);
    EXPECT_IS(s, (years, 16), (simulated, 0), (worst_year, worst_year), (worst, worst));
    EXPECT(worst_year, ==, 4);
    EXPECT_NAN(s.reach.mean, s.exceed.mean, s.passes_per_year);
    EXPECT(s.unprotected_energy, ==, 0);
}

TEST_WITH(no_forest_is_the_bare_run, fresh, NULL)
{
    wood.option.belts_count = 0;
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(500);
    LOCAL(ceduo_years, years) = simulate_years(0, 3, 1, 1, 500);
    for (size_t i = 0; i < years->count; i++) {
        assert_false(years->years[i].cut);
        for (size_t c = 0; c < CONTROLS; c++) {
            struct ceduo_arrivals a = years->years[i].wooded.arrivals[c];
            a.contacts = CEDUO_NO_ESTIMATE;
            expect_same_arrivals(&a, &bare.arrivals[c]);
        }
    }
    EXPECT(ceduo_years_felled(years), ==, 0);
    ceduo_years_free(NULL);
}

TEST_WITH(no_stem_is_hit_in_a_year_without_stems, fresh, NULL)
{
    wood.option.belts_count = 1;
    wood.belts[0].stand.cutting.retained_count = 0;
    LOCAL(ceduo_years, years) = simulate_years(3, 5, 1, 1, 200);
    const struct ceduo_year *y = &years->years[1];
    bool cut = y->cut && y->stands[0].bare && y->wooded.arrivals[1].reached > 0;
    double contacts = y->wooded.arrivals[1].contacts.mean;
    assert_true(cut);
    EXPECT(contacts, ==, 0); /* exactly 0, not unknown */
}

static void expect_window(enum ceduo_window_kind kind, unsigned first, unsigned last)
{
    struct ceduo_window w = ceduo_window_compute(&wood.option);
    EXPECT_IS(w, (kind, kind), (first, first), (last, last), (step, 1));
}

/* One whole rotation after all belts have been cut; the scene may give others. */
TEST_WITH(whole_rotations, fresh, NULL)
{
    expect_window(CEDUO_WINDOW_ROTATION, 10, 10 + ROTATION - 1); /* the selection coppice's first cut: 10 */
    wood.belts[0].cut_year = 40;
    expect_window(CEDUO_WINDOW_ROTATION, 40, 40 + ROTATION - 1);
    for (int i = 0; i < 2; i++) { /* they start together every 899 years: then the longer one counts */
        wood.belts[i].stand.cutting.rotation = 29;
        wood.belts[1 - i].stand.cutting.rotation = 31;
        struct ceduo_window w = ceduo_window_compute(&wood.option);
        EXPECT(w.last - w.first, ==, 31 - 1);
    }
    wood.belts[1].stand.cutting.rotation = ROTATION;
    wood.belts[0].stand.cutting.rotation = 2 * ROTATION; /* two rotations that start together every 2 ROTATION years */
    expect_window(CEDUO_WINDOW_ROTATION, 40, 40 + 2 * ROTATION - 1);
    wood.site.scene.year_first = 3;
    wood.site.scene.year_last = NAN;
    struct ceduo_window w = ceduo_scene_window(&wood.site.scene);
    EXPECT_IS(w, (kind, CEDUO_WINDOW_GIVEN), (first, 3), (last, 3 + 20 - 1)); /* both rotations are shorter than 20 years */
    wood.site.scene.year_last = 5;
    w = ceduo_scene_window(&wood.site.scene);
    EXPECT(w.last, ==, 5);
    wood.site.scene.year_last = 2; /* before the first cut: only that year */
    w = ceduo_scene_window(&wood.site.scene);
    EXPECT_IS(w, (first, 3), (last, 3));
    wood.site.scene.year_last = 3 + CEDUO_YEARS_MAX - 1;
    EXPECT(ceduo_scene_window(&wood.site.scene).step, ==, 1);
    wood.site.scene.year_last = 48700;
    w = ceduo_scene_window(&wood.site.scene);
    EXPECT(w.step, ==, 49); /* 48 698 years, at most 1000 */
    EXPECT(w.last, ==, 48700);
    wood.belts[0].cut_year = wood.belts[1].cut_year = INFINITY; /* never */
    expect_window(CEDUO_WINDOW_AHEAD, 1, CEDUO_YEARS_AHEAD_MIN);
    wood.belts[0].stand.growth = wood.belts[1].stand.growth = (struct ceduo_growth){0};
    expect_window(CEDUO_WINDOW_CONSTANT, 0, 0);
    wood.option.belts_count = 0;
    expect_window(CEDUO_WINDOW_CONSTANT, 0, 0);
}

static void expect_ahead(enum ceduo_window_kind kind, unsigned first, unsigned last)
{
    struct ceduo_window w = ceduo_scene_window(&wood.site.scene);
    EXPECT_IS(w, (kind, kind), (first, first), (last, last), (step, 1));
}

/* One window for all options: the longest rotation, 20 to 60 years, from year 1 on. */
TEST_WITH(one_window_for_all_options, fresh, NULL)
{
    struct ceduo_option two[2] = {wood.option, wood.option};
    struct ceduo_belt second = wood.belts[0];
    wood.site.scene.options = two;
    wood.site.scene.options_count = 2;
    wood.site.scene.year_first = wood.site.scene.year_last = NAN;
    two[1].belts = &second;
    two[1].belts_count = 1;
    for (int i = 0; i < 2; i++)
        wood.belts[i].stand.cutting.rotation = 13;
    second.stand.cutting.rotation = 15;
    expect_ahead(CEDUO_WINDOW_AHEAD, 1, 20);
    second.stand.cutting.rotation = 40;
    expect_ahead(CEDUO_WINDOW_AHEAD, 1, 40);
    second.stand.cutting.rotation = 90;
    expect_ahead(CEDUO_WINDOW_AHEAD, 1, 60);
    second.cut_year = INFINITY; /* never cut: the rotation does not count */
    expect_ahead(CEDUO_WINDOW_AHEAD, 1, 20);
    second.stand.growth = (struct ceduo_growth){0}; /* as long as anything grows */
    expect_ahead(CEDUO_WINDOW_AHEAD, 1, 20);
    two[0] = two[1];
    expect_ahead(CEDUO_WINDOW_CONSTANT, 0, 0);
}

/* ---- early end ---- */

struct stop {
    atomic_bool cancel;
    unsigned runs, after;
};

static void count_run(void *context, uint64_t rocks)
{
    struct stop *stop = context;
    (void)rocks;
    if (++stop->runs == stop->after)
        atomic_store(&stop->cancel, true);
}

TEST_WITH(a_cancelled_simulation_can_continue, fresh, NULL)
{
    LOCAL(ceduo_years, whole) = simulate_years(0, 8, 1, 2, ROCKS);
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = simulate_bare(ROCKS);
    for (unsigned after = 0; after < 10; after += 3) {
        struct stop stop = {.cancel = after == 0, .after = after};
        struct ceduo_run_def def = ceduo_run_def_default(&wood.site.scene);
        def.threads = 2;
        def.rocks_max = ROCKS;
        def.cancel = &stop.cancel;
        def.progress = count_run;
        def.context = &stop;
        LOCAL(ceduo_pool, pool);
        assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
        LOCAL(ceduo_years, years) = grow_years(0, 8, 1);
        enum ceduo_status status = ceduo_years_simulate(years, pool, &bare, ROCKS);
        assert_int_equal(status, after < 9 ? CEDUO_CANCELLED : CEDUO_OK);
        for (size_t i = 0; i < years->count; i++) {
            EXPECT(years->years[i].wooded.rocks, ==, (i < after ? ROCKS : 0));
            if (i < after)
                expect_same_year(&years->years[i], &whole->years[i]);
        }
        atomic_store(&stop.cancel, false);
        assert_int_equal(ceduo_years_simulate(years, pool, &bare, ROCKS), CEDUO_OK);
        for (size_t i = 0; i < years->count; i++)
            expect_same_year(&years->years[i], &whole->years[i]);
    }
}
