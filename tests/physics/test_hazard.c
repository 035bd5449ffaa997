/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes and weights: their laws in closed form; equal weights change no statistics. */
#include "core/runs/hazard.h"
#include "core/runs/statistics.h"
#include "expect.h"
#include "local.h"
#include "scene/rock.h"

#include <math.h>
#include <stdlib.h>

#include "core/runs/weighted.h"
#include "core/walk/prepared.h"

#define ROCKS 100000

/* ---- sizes ---- */

static double first[] = {0.02, 0.5}, second[] = {0.5, 40};

static struct ceduo_scene make_scene(struct ceduo_size_class *classes, size_t n)
{
    struct ceduo_scene scene = ceduo_scene_default();
    scene.blocks = classes;
    scene.blocks_count = n;
    return scene;
}

/* Return the blocks per year of a class above volume v. */
static double rate_above(const struct ceduo_size_class *c, double v)
{
    double lo = c->volumes[0], hi = c->volumes[1], b = c->exponent;
    v = fmin(fmax(v, lo), hi);
    double share = b > 0 ? (pow(v, -b) - pow(hi, -b)) / (pow(lo, -b) - pow(hi, -b)) : log(hi / v) / log(hi / lo);
    return c->per_year * share;
}

/* Weights sum to the frequency of blocks above any volume; volumes have evenly spaced logarithms. */
TEST(weights_sum_to_the_frequency_of_blocks)
{
    struct ceduo_size_class classes[] = {{3, 1.1, 2, first}, {0.05, 0, 2, second}};
    struct ceduo_scene scene = make_scene(classes, 2);
    LOCAL_BY(ceduo_sizes_release) struct sizes sizes;
    assert_true(ceduo_sizes_init(&sizes, &scene));
    EXPECT_NEAR(sizes.per_year, 3.05, 1e-12);
    for (double v = 0.02; v < 40; v *= 1.3) {
        double rate = 0, larger = 0;
        for (uint64_t r = 0; r < ROCKS; r++) {
            struct size s = ceduo_rock_size(&sizes, r);
            rate += s.volume > v ? s.weight * sizes.per_year / ROCKS : 0;
            larger += s.volume > v;
        }
        EXPECT_NEAR(rate, rate_above(&classes[0], v) + rate_above(&classes[1], v), 1e-3 * rate + 1e-4);
        EXPECT_NEAR(larger / ROCKS, log(40 / v) / log(40 / 0.02), 1e-3);
    }
}

/* Any 100 consecutive rocks include some from every tenth of the range. */
TEST(every_few_rocks_have_all_sizes)
{
    struct ceduo_size_class class = {1, 1, 2, second};
    struct ceduo_scene scene = make_scene(&class, 1);
    struct sizes sizes;
    for (uint64_t seed = 1; seed < 20; seed++) {
        scene.simulation.seed = seed;
        assert_true(ceduo_sizes_init(&sizes, &scene));
        for (uint64_t from = 0; from < 3000; from += 137) {
            int in[10] = {0};
            for (uint64_t r = from; r < from + 100; r++) {
                double along = log(ceduo_rock_size(&sizes, r).volume / 0.5) / log(80);
                EXPECT(along, >, 0);
                EXPECT(along, <, 1);
                in[(int)(10 * along)]++;
            }
            for (int i = 0; i < 10; i++)
                EXPECT(in[i], >=, 7);
        }
        ceduo_sizes_release(&sizes);
    }
}

/* Typical rocks have the natural frequencies of sizes. */
TEST(typical_rocks_have_the_frequencies_of_blocks)
{
    struct ceduo_size_class class = {1, 0.8, 2, second}, both[2] = {{3, 1.1, 2, first}, {0.5, 0.8, 2, second}};
    struct ceduo_scene scene = make_scene(&class, 1);
    struct sizes sizes;
    assert_true(ceduo_sizes_init(&sizes, &scene));
    double n = 0, larger = 0;
    for (uint64_t r = 0; r < ROCKS; r++)
        if (ceduo_rock_is_typical(&sizes, scene.simulation.seed, r)) {
            n++;
            larger += ceduo_rock_size(&sizes, r).volume > 2;
        }
    double p = rate_above(&class, 2);
    EXPECT_NEAR(larger / n, p, 4 * sqrt(p * (1 - p) / n));
    ceduo_sizes_release(&sizes);
    scene = make_scene(both, 2); /* two classes; the second is rarer in each range */
    assert_true(ceduo_sizes_init(&sizes, &scene));
    n = larger = 0;
    for (uint64_t r = 0; r < ROCKS; r++)
        if (ceduo_rock_is_typical(&sizes, scene.simulation.seed, r)) {
            n++;
            larger += ceduo_rock_size(&sizes, r).volume > 0.5;
        }
    EXPECT_NEAR(larger / n, 0.5 / 3.5, 4 * sqrt(0.5 / 3.5 * 3 / 3.5 / n));
    ceduo_sizes_release(&sizes);
}

/* A cylinder keeps its shape and its density. */
TEST(a_rock_is_scaled_as_a_whole)
{
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    struct ceduo_rock rock;
    def.shape = CEDUO_SHAPE_CYLINDER;
    def.diameter = ceduo_number(0.56);
    def.height = ceduo_number(0.80);
    def.density = ceduo_number(2600);
    assert_int_equal(ceduo_rock_from_means(&def, &rock), CEDUO_OK);
    double volume = rock.volume;
    ceduo_rock_resize(&rock, 8 * volume);
    ROWS(EXPECT_NEAR, (rock.mean_diameter, 2 * 0.68, 1e-15), (rock.radius, 0.68, 1e-15), (rock.mass, 8 * 512.3058, 1e-3),
         (rock.moment, 0.5 * rock.mass * 0.68 * 0.68, 1e-12 * rock.moment), (rock.volume, 8 * volume, 1e-15),
         (rock.axes[0], 1.12, 1e-15), (rock.axes[2], 1.6, 1e-15));
}

/* ---- weights ---- */

#define N 1000

/* Fill unordered values; 1 - share of the rocks arrive. */
static size_t fill_values(struct weighted *values, double weight, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint32_t x = (uint32_t)i * 2654435761u + 12345u;
        values[i] = (struct weighted){1 + (double)(x >> 8) / 1e6, weight};
    }
    return n;
}

/* Equal weights of any size give the results without weights. */
TEST(equal_weights_change_nothing)
{
    static struct weighted values[N];
    for (size_t n = 0; n <= N; n += 125) {
        const double weight = 3;
        struct weight_totals all = {.n = N, .w = N * weight, .ww = N * weight * weight, .per_year = 1};
        struct weighted_sum ones = {0};
        fill_values(values, weight, n);
        for (size_t i = 0; i < n; i++)
            weighted_sum_add(&ones, weight, 1);
        struct ceduo_estimate wilson = ceduo_wilson((double)n / N, (double)n / N, N);
        struct ceduo_estimate share = ceduo_weighted_share(&all, &ones, -1);
        ROWS(EXPECT_NEAR, (share.mean, (double)n / N, 1e-12), (share.lo, wilson.lo, 1e-9), (share.hi, wilson.hi, 1e-9));
        struct ceduo_moments m = {0};
        double plain[N];
        for (size_t i = 0; i < n; i++) {
            ceduo_moments_add(&m, values[i].value);
            plain[i] = values[i].value;
        }
        struct ceduo_distribution a = ceduo_weighted_distribution(&all, values, n);
        struct ceduo_distribution b = ceduo_distribution_exact(plain, n, &m);
        if (n == 0) {
            assert_true(isnan(a.mean) && isnan(a.p50) && isnan(a.max));
            continue;
        }
        EXPECT_NEAR(a.mean, b.mean, 1e-12);
        EXPECT_NEAR(a.sd, b.sd, 1e-9);
        double m1 = (double)(n - 1) / (double)n, all1 = (double)(N - 1) / N; /* divided by n - 1, and by N - 1 */
        ROWS(EXPECT_NEAR, (a.se, b.se * sqrt(m1 / all1), 1e-9), (a.p50, b.p50, 0), (a.p95, b.p95, 0), (a.p99, b.p99, 0));
        EXPECT_NEAR(a.p50_lo, b.p50_lo, 0.15); /* the normal law instead of the binomial one: one or two ranks apart */
        EXPECT_NEAR(a.p50_hi, b.p50_hi, 0.15);
        if (n == N) /* enough if all count */
            ROWS(EXPECT_NEAR, (a.p95_lo, b.p95_lo, 0.05), (a.p95_hi, b.p95_hi, 0.05), (a.p99_lo, b.p99_lo, 0.05),
                 (a.p99_hi, b.p99_hi, 0.05));
        EXPECT_NEAR(a.max, b.max, 0);
    }
}

/* A share that the weights explain has no error: with a weight of all rocks it is 1, with no weight 0. */
TEST(weights_explain_without_error)
{
    struct weight_totals all = {.n = N, .per_year = 1};
    struct weighted_sum ones = {0}, zeros = {0}, fives = {0};
    for (size_t i = 0; i < N; i++) {
        double w = i % 2 ? 0.5 : 1.5;
        all.w += w;
        all.ww += w * w;
        weighted_sum_add(&ones, w, 1);
        weighted_sum_add(&fives, w, 5);
    }
    EXPECT_NEAR(ceduo_weighted_se(&all, &ones), 0, 0);
    EXPECT_NEAR(ceduo_weighted_se(&all, &fives), 0, 0);
    struct ceduo_estimate all_of_them = ceduo_weighted_share(&all, &ones, -1), nobody = ceduo_weighted_share(&all, &zeros, -1);
    EXPECT_NEAR(all_of_them.mean, 1, 0);
    EXPECT_NEAR(all_of_them.hi, 1, 0);
    assert_true(all_of_them.lo > 0.99 && all_of_them.lo < 1);
    EXPECT_NEAR(nobody.mean, 0, 0);
    EXPECT_NEAR(nobody.lo, 0, 0);
    EXPECT_NEAR(nobody.hi, 3.8414588 / (N + 3.8414588), 1e-8); /* Wilson's bound of 0 among N rocks */
    struct weighted_sum heavy = {0};
    for (size_t i = 0; i < N; i += 2)
        weighted_sum_add(&heavy, 1.5, 1); /* all heavy rocks and no others: the weights explain all of it */
    struct ceduo_estimate known = ceduo_weighted_share(&all, &heavy, -1);
    double equal_rocks = all.w * all.w / all.ww;
    assert_int_equal(equal_rocks, 800);
    ROWS(EXPECT_NEAR, (known.mean, 0.75, 1e-12), (known.lo, ceduo_wilson(.75, .75, 800).lo, 1e-9),
         (known.hi, ceduo_wilson(.75, .75, 800).hi, 1e-9));
    all.missing = all.w / 10;
    EXPECT_NEAR(ceduo_weighted_share(&all, &zeros, -1).hi, ceduo_wilson(.1, .1, 800).hi, 1e-12);
    all.n = 1;
    assert_true(isnan(ceduo_weighted_se(&all, &ones)));
}

TEST(quantiles_by_hand)
{
    const struct weighted values[] = {{1, 1}, {2, 2}, {3, 1}};
    EXPECT_NEAR(ceduo_weighted_quantile(values, 3, 0.25), 1, 0); /* a share that is reached exactly is its last value */
    ROWS(EXPECT_NEAR, (ceduo_weighted_quantile(values, 3, 0.26), 2, 0), (ceduo_weighted_quantile(values, 3, 0.75), 2, 0),
         (ceduo_weighted_quantile(values, 3, 0.76), 3, 0));
    EXPECT_NEAR(ceduo_weighted_quantile(values, 3, 1.1), 3, 0); /* above all values */
    assert_true(isnan(ceduo_weighted_quantile(values, 0, 0.5)));
    const struct weight_totals all = {.n = 3, .w = 4, .ww = 6, .per_year = 1};
    struct weighted one = {5, 1};
    struct ceduo_distribution d = ceduo_weighted_distribution(&all, &one, 1);
    EXPECT_NEAR(d.mean, 5, 0);
    EXPECT_NEAR(d.p99, 5, 0);
    assert_true(isnan(d.sd) && isnan(d.se));
}

/* ---- hazard ---- */

TEST(energies_and_classes_match_their_names)
{
    static const struct {
        double energy;
        int class;
    } rows[] = {{0, 0}, {29999, 0}, {30000, 1}, {299999, 1}, {3e5, 2}, {1e12, 2}, {NAN, -1}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        assert_int_equal(ceduo_intensity_find(rows[i].energy), rows[i].class);
    ROWS(EXPECT_NEAR, (ceduo_hazard_energy(0), 100, 0), (ceduo_hazard_energy(15), 3000, 0),
         (ceduo_hazard_energy(CEDUO_HAZARD_ENERGIES - 1), 1e9, 0));
    for (size_t i = 1; i < CEDUO_HAZARD_ENERGIES; i++)
        EXPECT(ceduo_hazard_energy(i), >, ceduo_hazard_energy(i - 1));
}

/* Three rocks of a thousand arrive, one block falls in two years. */
TEST(few_rocks_give_bounds)
{
    const struct weight_totals all = {.n = N, .w = N, .ww = N, .per_year = 0.5};
    struct weighted energies[] = {{4e5, 1}, {2e4, 1}, {1e5, 1}};
    struct ceduo_hazard h;
    assert_true(ceduo_hazard_read(&all, energies, 3, 5e4, &h, NULL));
    ROWS(EXPECT_NEAR, (h.reach.mean, 0.0015, 1e-15), (h.accepted.mean, 0.001, 1e-15),
         (ceduo_hazard_judged_rate(&h).mean, 0.001, 1e-15));
    for (size_t i = 0; i < CEDUO_INTENSITIES; i++)
        EXPECT_NEAR(h.intensity[i].rate.mean, 0.0005, 1e-15);
    assert_true(isnan(h.returns[3].energy.mean) &&
                isnan(h.returns[3].energy.lo));  /* 0.0015 a year: less than one in 300 years */
    EXPECT_NEAR(h.returns[3].energy.hi, 1e5, 0); /* 1/150 of the blocks: Wilson's bound of one in N is above, of two below */
    assert_true(isnan(h.returns[1].energy.hi));  /* one in 30 years exceeds the upper bound of all three */
    assert_true(ceduo_hazard_read(&all, energies, 3, NAN, &h, NULL));
    assert_true(isnan(h.accepted.mean));
    EXPECT_NEAR(ceduo_hazard_judged_rate(&h).mean, 0.0015, 1e-15);
    struct ceduo_hazard zeros = ceduo_hazard_none();
    ceduo_hazard_compare(&h, &zeros);
    assert_true(isnan(h.remaining_share) && isnan(h.intensity[0].remaining_share));
}

/* Kish's effective number: 500 rocks of weight 1.9 and 500 of 0.1 equal 1000²/(500 (1.9² + 0.1²)) rocks of equal weight. */
TEST(rocks_count_by_their_weights)
{
    const struct weight_totals all = {.n = N, .w = N, .ww = 500 * (1.9 * 1.9 + .1 * .1), .per_year = 1};
    struct ceduo_hazard h;
    assert_true(ceduo_hazard_read(&all, NULL, 0, 5, &h, NULL));
    EXPECT_NEAR(h.effective, 1e6 / 1810, 1e-9);
}

/* The last energy of the curve is its maximum. */
TEST(a_curve_ends_at_its_last_energy)
{
    const struct weight_totals all = {.n = 2, .w = 2, .ww = 2, .per_year = 1};
    struct weighted energies[] = {{1e10, 1}, {1e10, 1}};
    struct ceduo_hazard h;
    struct ceduo_hazard_curve curve;
    assert_true(ceduo_hazard_read(&all, energies, 2, NAN, &h, &curve));
    assert_int_equal(curve.count, CEDUO_HAZARD_ENERGIES);
    EXPECT_NEAR(curve.points[CEDUO_HAZARD_ENERGIES - 1].rate.mean, 1, 0);
}

/* A rock does not exceed its own energy; a class includes its lower limit; a rate equal to 1/period meets a return period: one
 * of a thousand blocks and ten a year, 1/100. */
TEST(at_a_limit)
{
    const struct weight_totals all = {.n = N, .w = N, .ww = N, .per_year = 10};
    struct weighted energies[] = {{3e5, 1}, {3e4, 1}};
    struct ceduo_hazard h;
    struct ceduo_hazard_curve curve;
    assert_true(ceduo_hazard_read(&all, energies, 2, 3e5, &h, &curve));
    ROWS(EXPECT_NEAR, (h.accepted.mean, 0, 0), (h.intensity[0].rate.mean, 0, 0), (h.intensity[1].rate.mean, 0.01, 1e-15),
         (h.intensity[2].rate.mean, 0.01, 1e-15));
    for (size_t i = 0; i < curve.count; i++)
        EXPECT_NEAR(curve.points[i].rate.mean,
                    curve.points[i].energy < 3e4   ? 0.02
                    : curve.points[i].energy < 3e5 ? 0.01
                                                   : 0,
                    1e-15);
    assert_int_equal(h.returns[2].years, 100);
    EXPECT_NEAR(h.returns[2].energy.mean, 3e5, 0);
    assert_true(isnan(h.returns[2].energy.hi)); /* none of 1000 allows up to 0.038 per year: no upper energy */
    assert_true(ceduo_hazard_read(&all, energies, 2, nextafter(3e5, 0), &h, &curve));
    EXPECT_NEAR(h.accepted.mean, 0.01, 1e-15);
}

/* None of two hundred rocks arrives: only upper bounds are known. */
TEST(no_rock_arrives)
{
    const struct weight_totals all = {.n = 200, .w = 200, .ww = 200, .per_year = 1};
    struct ceduo_hazard h;
    struct ceduo_hazard_curve curve;
    assert_true(ceduo_hazard_read(&all, NULL, 0, 5e4, &h, &curve));
    EXPECT_NEAR(h.reach.mean, 0, 0);
    EXPECT_NEAR(h.reach.hi, 3.8414588 / (200 + 3.8414588), 1e-8); /* Wilson's bound of 0 among 200 */
    assert_int_equal(curve.count, 1);
    for (size_t i = 0; i < CEDUO_RETURNS; i++)
        assert_true(isnan(h.returns[i].energy.mean) && isnan(h.returns[i].energy.lo) && isnan(h.returns[i].energy.hi));
    assert_true(isnan(h.remaining_share));
}

/* A thousand rocks: half small, each for 1.9 blocks, half large, each for 0.1. None in a thousand is at most 38 of 10000. Only
 * large ones could have more than 5 J: none of 500 is at most 5 % of 76 of 10000. The upper bound is at least this large
 * however few large ones arrive, and increases with each arrival. */
TEST(fewer_arrivals_raise_no_upper_end)
{
    static struct weighted could[N];
    struct weighted energies[] = {{6, 0.1}, {7, 0.1}, {8, 0.1}, {9, 0.1}, {9.5, 0.1}};
    struct weight_totals all = {.n = N, .per_year = 1, .max_energies = could};
    double of_all = 3.8414588 / (N + 3.8414588), of_large = 0.05 * 3.8414588 / (N / 2 + 3.8414588), before = 0;
    for (size_t i = 0; i < N; i++) {
        could[i] = i % 2 ? (struct weighted){10, 0.1} : (struct weighted){5, 1.9};
        all.w += could[i].weight;
        all.ww += could[i].weight * could[i].weight;
    }
    ceduo_weighted_bound(could, N);
    ROWS(EXPECT_NEAR, (could[0].weight, N, 1e-9), (could[N / 2].weight, 50, 1e-9), (could[N - 1].weight, 0.1, 1e-12));
    for (size_t n = 0; n <= LENGTH(energies); n++) {
        struct ceduo_hazard h;
        assert_true(ceduo_hazard_read(&all, energies, n, 5, &h, NULL));
        EXPECT_NEAR(h.reach.hi, of_all, 1e-8);
        if (n == 0)
            EXPECT_NEAR(h.accepted.hi, of_large, 1e-9);
        EXPECT(h.accepted.hi, >=, before);
        before = h.accepted.hi;
        assert_true(ceduo_hazard_read(&all, energies, n, 10, &h, NULL)); /* the bound of no arrival */
        EXPECT_NEAR(h.accepted.hi, 0, 0);
    }
    EXPECT(before, >, 1.5 * of_large);
}
