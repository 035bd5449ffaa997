/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rocks among stems: what they meet and lose beside closed forms (Cauchy, Crofton, Poisson), beside a full map in the
 * plane, and beside the test site of Ciabocco, Boccia and Ripa 2009. Every figure is written as a comment of the TAP. */
#include "expect.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "line_scene.h"
#include "paper_site.h"
#include "plane_map.h"

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])
#define B         PAPER_B /* m, mean diameter of the rock of all sweeps */
#define CHANCE    1e-4    /* of a test of fit to fail though all is right; four standard errors are 6e-5 */

/* ---- what is expected of a sample ---- */

/* Sums of powers of values less the first one, so that little cancels. */
struct spread {
    double origin, n, sum[5];
};

static void spread_add(struct spread *s, double value)
{
    if (!(s->n > 0))
        s->origin = value;
    double d = value - s->origin, power = 1;
    for (int k = 1; k < 5; k++)
        s->sum[k] += power *= d;
    s->n++;
}

static double spread_mean(const struct spread *s)
{
    return s->origin + s->sum[1] / s->n;
}

static double spread_variance(const struct spread *s)
{
    double m = s->sum[1] / s->n;
    return s->sum[2] / s->n - m * m;
}

static double spread_se(const struct spread *s)
{
    return sqrt(spread_variance(s) / s->n);
}

/* Of the variance, from the fourth moment. */
static double spread_variance_se(const struct spread *s)
{
    double m = s->sum[1] / s->n, m2 = s->sum[2] / s->n, v = spread_variance(s);
    double fourth = s->sum[4] / s->n - 4 * m * s->sum[3] / s->n + 6 * m * m * m2 - 3 * m * m * m * m;
    return sqrt((fourth - v * v) / s->n);
}

static void expect_close(const char *what, double value, double se, double expected, double expected_se)
{
    double both = hypot(se, expected_se);
    print_message("# %s: %.6g ± %.2g, expected %.6g (%+.1f se)\n", what, value, se, expected,
                  (value - expected) / both);
    if (!(fabs(value - expected) <= 4 * both))
        fail_msg("%s: %.8g ± %.3g is not %.8g", what, value, se, expected);
}

static void expect_mean(const char *what, const struct spread *s, double expected)
{
    expect_close(what, spread_mean(s), spread_se(s), expected, 0);
}

static void expect_variance(const char *what, const struct spread *s, double expected)
{
    expect_close(what, spread_variance(s), spread_variance_se(s), expected, 0);
}

static void expect_share(const char *what, uint64_t hits, uint64_t n, double expected)
{
    expect_close(what, (double)hits / (double)n, sqrt(expected * (1 - expected) / (double)n), expected, 0);
}

/* Whether two numbers differ by no more than rounding. */
static void expect_exact(const char *what, double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%s: %.17g is not %.17g", what, value, expected);
}

static void expect_chi_square(const char *what, double chi2, double freedom)
{
    double p = gsl_cdf_chisq_Q(chi2, freedom);
    print_message("# %s: chi-square %.1f on %.0f, p = %.3g\n", what, chi2, freedom, p);
    if (!(p > CHANCE))
        fail_msg("%s: chi-square %.1f on %.0f, p = %.2g", what, chi2, freedom, p);
}

/* Of a statistic of Kolmogorov and Smirnov, D times the root of the sample's size: its limiting law. */
static void expect_ks(const char *what, double d, double size)
{
    double most = sqrt(-log(CHANCE / 2) / 2);
    print_message("# %s: D = %.2e, D sqrt(n) = %.3f of at most %.3f\n", what, d, d * sqrt(size), most);
    if (!(d * sqrt(size) < most))
        fail_msg("%s: D = %.3g of %.0f", what, d, size);
}

static int by_value(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* One sample, which is sorted, against a law. */
static void expect_law(const char *what, double *values, size_t n, double (*cdf)(double x, const void *of),
                       const void *of)
{
    qsort(values, n, sizeof *values, by_value);
    double d = 0;
    for (size_t i = 0; i < n; i++) {
        double f = cdf(values[i], of);
        d = fmax(d, fmax(f - (double)i / (double)n, (double)(i + 1) / (double)n - f));
    }
    expect_ks(what, d, (double)n);
}

/* Values that come in clumps of a kind are worth fewer: (sum of sizes)^2 / sum of their squares (Kish 1965). */
struct sample {
    double *values;
    size_t n, room;
    double squares; /* of the sizes of clumps; 0: all for themselves */
};

static void sample_add(struct sample *s, double value)
{
    if (s->n == s->room) {
        s->room = s->room > 0 ? 2 * s->room : 1024;
        s->values = realloc(s->values, s->room * sizeof *s->values);
        assert_non_null(s->values);
    }
    s->values[s->n++] = value;
}

static void sample_clear(struct sample *s)
{
    free(s->values);
    *s = (struct sample){0};
}

static double sample_worth(const struct sample *s)
{
    return s->squares > 0 ? (double)s->n * (double)s->n / s->squares : (double)s->n;
}

/* Two samples, which are sorted, of one law? */
static void expect_same_law(const char *what, struct sample *a, struct sample *b)
{
    qsort(a->values, a->n, sizeof *a->values, by_value);
    qsort(b->values, b->n, sizeof *b->values, by_value);
    double d = 0;
    for (size_t i = 0, j = 0; i < a->n && j < b->n;) {
        double v = fmin(a->values[i], b->values[j]);
        while (i < a->n && a->values[i] <= v)
            i++;
        while (j < b->n && b->values[j] <= v)
            j++;
        d = fmax(d, fabs((double)i / (double)a->n - (double)j / (double)b->n));
    }
    double p = sample_worth(a), q = sample_worth(b);
    expect_ks(what, d, p * q / (p + q));
}

/* Counts against the Poisson law of a mean; rare ones are taken together. */
#define COUNTS_MOST 256
static void expect_poisson(const char *what, const uint64_t count[COUNTS_MOST], double mean)
{
    double n = 0, chi2 = 0, seen = 0, expected = 0, left = 1;
    int cells = 0;
    for (int k = 0; k < COUNTS_MOST; k++)
        n += (double)count[k];
    for (unsigned k = 0; k < COUNTS_MOST; k++) {
        double p = gsl_ran_poisson_pdf(k, mean);
        seen += (double)count[k];
        expected += n * p;
        left -= p;
        bool last = n * left < 10; /* the tail joins the last cell */
        if (last)
            for (expected += n * left; ++k < COUNTS_MOST;)
                seen += (double)count[k];
        if (expected < 10)
            continue;
        chi2 += (seen - expected) * (seen - expected) / expected;
        cells++;
        seen = expected = 0;
    }
    expect_chi_square(what, chi2, cells - 1);
}

/* Stems in bins along x, rock by rock. Those of one stool are no independent events, so the bins' covariance over the
 * rocks is kept as well. */
#define BINS_MOST 64
struct bins {
    size_t k;
    double from, width, n;
    double now[BINS_MOST], sum[BINS_MOST], cross[BINS_MOST][BINS_MOST];
};

static void bins_note(struct bins *b, double x)
{
    double place = floor((x - b->from) / b->width);
    if (place >= 0 && place < (double)b->k)
        b->now[(size_t)place]++;
}

static void bins_end_rock(struct bins *b)
{
    for (size_t i = 0; i < b->k; i++) {
        b->sum[i] += b->now[i];
        for (size_t j = 0; j <= i && b->now[i] > 0; j++)
            b->cross[i][j] += b->now[i] * b->now[j];
    }
    memset(b->now, 0, sizeof b->now);
    b->n++;
}

/* Every bin has the same mean: chi-square of the means with their covariance (Hotelling 1931, many rocks). */
static void expect_even(const char *what, const struct bins *b, double per_bin)
{
    gsl_matrix *s = gsl_matrix_alloc(b->k, b->k);
    gsl_vector *d = gsl_vector_alloc(b->k), *x = gsl_vector_alloc(b->k);
    for (size_t i = 0; i < b->k; i++) {
        gsl_vector_set(d, i, b->sum[i] / b->n - per_bin);
        for (size_t j = 0; j <= i; j++) {
            double covariance = (b->cross[i][j] - b->sum[i] * b->sum[j] / b->n) / b->n / b->n;
            gsl_matrix_set(s, i, j, covariance);
            gsl_matrix_set(s, j, i, covariance);
        }
    }
    assert_int_equal(gsl_linalg_cholesky_decomp1(s), 0);
    assert_int_equal(gsl_linalg_cholesky_solve(s, d, x), 0);
    double chi2 = 0;
    for (size_t i = 0; i < b->k; i++)
        chi2 += gsl_vector_get(d, i) * gsl_vector_get(x, i);
    gsl_matrix_free(s);
    gsl_vector_free(d);
    gsl_vector_free(x);
    expect_chi_square(what, chi2, (double)b->k);
}

/* ---- a plane to sweep ---- */

/* Level ground over which a rock flies so fast and low, among stems so tall and light, that its way is a straight line.
 * It points into itself. */
#define KINDS_MOST 3
struct plane {
    struct line_scene line;
    struct ceduo_belt belts[2];
    struct ceduo_stems shoots[2][KINDS_MOST], trees[2][KINDS_MOST];
};

static struct plane plane;

static void clear_ground(size_t vertices, const double *x, const double *z, double rn, double friction)
{
    line_scene_init(&plane.line, vertices, x, z, (struct line_ground){rn, 1, friction}, B / 2, CEDUO_LAW_LUMPED);
    memset(plane.belts, 0, sizeof plane.belts);
    plane.line.option.belts = plane.belts;
}

/* Without a forest yet. The rock starts at x = 0 and falls 5 cm on its way. */
static void clear_plane(double length)
{
    clear_ground(2, (double[]){0, length}, (double[]){0, 0}, .5, 0);
    line_scene_release(&plane.line, 0, 1, 10 * length, 0, 0);
}

static struct ceduo_belt *plant_belt(double from, double to, double stools, double spacing)
{
    size_t i = plane.line.option.belts_count++;
    plane.belts[i] = (struct ceduo_belt){.from = from,
                                         .to = to,
                                         .stand = {.species = -1,
                                                   .stools_per_ha = stools,
                                                   .spacing = spacing,
                                                   .shoots = plane.shoots[i],
                                                   .trees = plane.trees[i],
                                                   .energy = CEDUO_BRAUNER,
                                                   .u = 1,
                                                   .fracture_ratio = 1}};
    return &plane.belts[i];
}

static struct ceduo_stems light(double per_ha, double dbh)
{
    return (struct ceduo_stems){.per_ha = per_ha, .dbh = dbh, .height = 1e3, .volume = 1e-12, .age = NAN};
}

static struct ceduo_stems *plant_shoots(struct ceduo_belt *belt, double per_ha, double dbh)
{
    struct ceduo_stems *s = &belt->stand.shoots[belt->stand.shoots_count++];
    *s = light(per_ha, dbh);
    return s;
}

static struct ceduo_stems *plant_trees(struct ceduo_belt *belt, double per_ha, double dbh)
{
    struct ceduo_stems *s = &belt->stand.trees[belt->stand.trees_count++];
    *s = light(per_ha, dbh);
    return s;
}

/* A plot of the paper's Table 1, its stems tall and light. */
static void plant_plot(int number, double from, double to)
{
    struct paper_plot plot;
    paper_plot_init(&plot, number);
    struct ceduo_belt *belt = plant_belt(from, to, plot.stand.stools_per_ha, plot.stand.spacing);
    plant_shoots(belt, plot.shoots.per_ha, plot.shoots.dbh);
    plant_trees(belt, plot.trees.per_ha, plot.trees.dbh);
}

/* Things of which so many stand on a hectare, met by a strip of such a width: per metre. */
static double per_metre(double per_ha, double width)
{
    return per_ha * width / 1e4;
}

/* Perimeter of the hull of n shoots on a ring. */
static double perimeter(unsigned n, double spacing)
{
    return n < 2 ? 0 : n * spacing;
}

/* ---- sweeping it ---- */

#define STEMS_MOST 4096
struct sweep {
    struct ceduo_follower *follower;
    struct ceduo_way way;
    size_t count;
    struct ceduo_stem_passed stems[STEMS_MOST];
};

static struct sweep sweep;

static void note_stem(void *context, const struct ceduo_stem_passed *stem)
{
    struct sweep *s = context;
    if (s->count == STEMS_MOST)
        fail_msg("more than %d stems", STEMS_MOST);
    s->stems[s->count++] = *stem;
}

static void sweep_begin(void)
{
    assert_int_equal(ceduo_scene_check(&plane.line.scene, NULL), CEDUO_OK);
    sweep.follower = ceduo_follower_create(&plane.line.scene, &plane.line.option);
    assert_non_null(sweep.follower);
}

static void sweep_end(void)
{
    ceduo_follower_free(sweep.follower);
    sweep.follower = NULL;
}

static void sweep_watched(uint64_t rock, const struct ceduo_watch *watch)
{
    sweep.count = 0;
    assert_int_equal(ceduo_follower_follow(sweep.follower, rock, watch, &sweep.way, NULL), CEDUO_OK);
}

static void sweep_rock(uint64_t rock)
{
    sweep_watched(rock, &(struct ceduo_watch){.stem = note_stem, .context = &sweep});
}

static void sweep_one(uint64_t rock)
{
    sweep_begin();
    sweep_rock(rock);
    sweep_end();
}

static int by_number(const void *a, const void *b)
{
    const uint64_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* Different numbers among the stems that were hit, all or of shoots only. */
static size_t different(bool shoots_only)
{
    static uint64_t numbers[STEMS_MOST];
    size_t n = 0, found = 0;
    for (size_t i = 0; i < sweep.count; i++)
        if (sweep.stems[i].hit && (sweep.stems[i].shoot || !shoots_only))
            numbers[n++] = sweep.stems[i].stool;
    qsort(numbers, n, sizeof *numbers, by_number);
    for (size_t i = 0; i < n; i++)
        found += i == 0 || numbers[i] != numbers[i - 1];
    return found;
}

/* What rocks meet of the forest that was planted, per metre of it. */
struct met {
    struct spread stems, both, stools; /* stools and trees; stools alone */
    struct spread sum;                 /* stems and stools, for their covariance */
};

static struct met meet(uint64_t rocks, double metres)
{
    struct met m = {0};
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        size_t both = different(false);
        if (sweep.way.stems_hit != sweep.count || sweep.way.stools_met != both || sweep.way.end != CEDUO_LEFT_SLOPE ||
            sweep.way.stems_drawn < sweep.count)
            fail_msg("rock %ju: its way's counts are not those of the stems on it", (uintmax_t)rock);
        spread_add(&m.stems, (double)sweep.count / metres);
        spread_add(&m.both, (double)both / metres);
        double stools = (double)different(true) / metres;
        spread_add(&m.stools, stools);
        spread_add(&m.sum, (double)sweep.count / metres + stools);
    }
    sweep_end();
    return m;
}

static void expect_stems_per_stool(const char *what, const struct met *m, double expected)
{
    double ratio = spread_mean(&m->stems) / spread_mean(&m->stools);
    double stems = spread_variance(&m->stems), stools = spread_variance(&m->stools);
    double both = (spread_variance(&m->sum) - stems - stools) / 2; /* covariance */
    double variance = fmax(0, stems - 2 * ratio * both + ratio * ratio * stools) / m->sum.n;
    expect_close(what, ratio, sqrt(variance) / spread_mean(&m->stools), expected, 1e-12);
}

/* ---- how many are met ---- */

/* Stems of Eq. 1 with every stem, stools and trees by Crofton's formula, per metre. */
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
    char what[80];
    struct met m = meet(rocks, 500);
    /* the printed figures have five digits */
    snprintf(what, sizeof what, "ADS %d %s, stems per metre", r->number, how);
    expect_close(what, spread_mean(&m.stems), spread_se(&m.stems), r->stems, .5e-5 / 4);
    snprintf(what, sizeof what, "ADS %d %s, stools and trees per metre", r->number, how);
    expect_close(what, spread_mean(&m.both), spread_se(&m.both), r->both, .5e-5 / 4);
    snprintf(what, sizeof what, "ADS %d %s, stools per metre", r->number, how);
    expect_mean(what, &m.stools, r->stools);
}

static void stems_met_per_metre_are_those_of_equation_1_and_stools_those_of_crofton(void **state)
{
    (void)state;
    static const uint64_t rocks[] = {3100, 6200};
    for (size_t i = 0; i < LENGTH(plot_rates); i++) {
        clear_plane(520);
        plane.line.scene.simulation.seed = i + 1;
        plant_plot(plot_rates[i].number, 10, 510);
        expect_plot(&plot_rates[i], rocks[i], "in flight");
    }
}

static void a_rolling_rock_meets_as_many_and_rolls_on_as_if_there_were_none(void **state)
{
    (void)state;
    struct ceduo_way bare;
    clear_plane(520);
    plane.line.scene.simulation.seed = 3;
    plant_plot(1, 10, 510);
    line_scene_release(&plane.line, 0, 0, 5000, 0, 0);
    expect_plot(&plot_rates[0], 1000, "rolling");
    assert_int_equal(ceduo_way_follow(&plane.line.scene, NULL, 0, NULL, &bare, NULL), CEDUO_OK);
    /* a hit leaves the rest of a roll's length R to go */
    assert_int_equal(sweep.way.contacts, bare.contacts);
    assert_int_equal(bare.contacts, ceil(520 / (B / 2)));
}

static void rocks_of_many_sizes_meet_as_many_as_their_mean(void **state)
{
    (void)state;
    clear_plane(520);
    plant_plot(1, 10, 510);
    plane.line.scene.rock.diameter = (struct ceduo_number){B, .3, CEDUO_UNIFORM};
    struct met m = meet(3100, 500);
    expect_mean("stems per metre, B .38 to .98 m", &m.stems, per_metre(9076, B + .061));
}

static void counts_of_trees_in_a_stretch_are_poisson(void **state)
{
    (void)state;
    static uint64_t count[COUNTS_MOST];
    struct spread s = {0};
    clear_plane(40);
    struct ceduo_belt *belt = plant_belt(10, 30, 0, 0);
    plant_trees(belt, 2500, .2);
    plant_trees(belt, 500, .45);
    double mean = 20 * (per_metre(2500, B + .2) + per_metre(500, B + .45));
    memset(count, 0, sizeof count);
    sweep_begin();
    for (uint64_t rock = 0; rock < 200000; rock++) {
        sweep_rock(rock);
        count[sweep.count]++;
        spread_add(&s, (double)sweep.count);
    }
    sweep_end();
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

/* Of each way the same number of gaps, few enough that it has them: others would be too short on average. */
#define GAPS 150
static void gaps_between_trees_are_exponential_and_offsets_uniform(void **state)
{
    (void)state;
    struct sample gaps = {0}, offsets = {0};
    clear_plane(1000);
    struct ceduo_belt *belt = plant_belt(0, 1000, 0, 0);
    plant_trees(belt, 2500, .2);
    plant_trees(belt, 500, .45);
    sweep_begin();
    for (uint64_t rock = 0; rock < 7000; rock++) {
        sweep_rock(rock);
        EXPECT(sweep.count, >, GAPS);
        for (size_t i = 0; i < GAPS; i++) {
            const struct ceduo_stem_passed *s = &sweep.stems[i];
            sample_add(&gaps, s->x - (i > 0 ? s[-1].x : 0));
            sample_add(&offsets, .5 + s->y / (B + s->dbh));
        }
    }
    sweep_end();
    double rate = per_metre(2500, B + .2) + per_metre(500, B + .45);
    expect_law("gaps between trees, KS", gaps.values, gaps.n, exponential_cdf, &rate);
    expect_law("offsets of trees, KS", offsets.values, offsets.n, uniform_cdf, NULL);
    sample_clear(&gaps);
    sample_clear(&offsets);
}

static void the_chance_to_meet_nothing_of_ten_metres_is_that_of_crofton(void **state)
{
    (void)state;
    const uint64_t rocks = 1000000;
    uint64_t free_runs = 0;
    clear_plane(20);
    plant_plot(1, 5, 15);
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        free_runs += sweep.way.stems_hit == 0;
    }
    sweep_end();
    expect_share("nothing met of those centred in 10 m", free_runs, rocks, exp(-10 / 2.16747));
    EXPECT_NEAR(exp(-10 / 2.16747), .00992, .5e-5);
}

/* ---- contacts as a Poisson process ---- */

/* Four kinds of stem, each with a work of its own (J). */
enum { YOUNG, OLD, STANDARD, RESERVE, KINDS };
static const double kind_per_ha[KINDS] = {3000, 2400, 300, 120}, kind_dbh[KINDS] = {.05, .11, .15, .30},
                    kind_work[KINDS] = {1e-6, 3e-6, 7e-6, 20e-6};
#define STOOLS 1500.

static void plant_kinds(double from, double to, double spacing)
{
    struct ceduo_belt *belt = plant_belt(from, to, STOOLS, spacing);
    for (int k = 0; k < KINDS; k++) {
        struct ceduo_stems *s = (k < STANDARD ? plant_shoots : plant_trees)(belt, kind_per_ha[k], kind_dbh[k]);
        s->volume = kind_work[k];
        s->height = .01; /* does not matter */
    }
}

/* What is met as one: its rate per metre and its work. */
struct strata {
    size_t n;
    double rate[KINDS], work[KINDS];
};

static void add_stratum(struct strata *s, double rate, double work)
{
    s->rate[s->n] = rate;
    s->work[s->n++] = work;
}

static double mean_dbh(int kinds)
{
    double n = 0, sum = 0;
    for (int k = 0; k < kinds; k++) {
        n += kind_per_ha[k];
        sum += kind_per_ha[k] * kind_dbh[k];
    }
    return sum / n;
}

/* By the equations of the paper and Crofton's formula. */
static struct strata strata_of(enum ceduo_rule rule, double spacing)
{
    struct strata s = {0};
    const double *n = kind_per_ha, *d = kind_dbh, *w = kind_work;
    if (rule == CEDUO_GSTEIGER_STEMS) {
        for (int k = 0; k < KINDS; k++)
            add_stratum(&s, per_metre(n[k], B + d[k]), w[k]);
        return s;
    }
    double work = (n[YOUNG] * w[YOUNG] + n[OLD] * w[OLD]) / (n[YOUNG] + n[OLD]), width = B + mean_dbh(STANDARD);
    bool alike = rule == CEDUO_GSTEIGER_STOOLS; /* Eq. 1: all as thick as the mean of all stems */
    if (alike)
        width = B + mean_dbh(KINDS);
    else if (rule == CEDUO_INTERCEPTION) /* Eq. 6 */
        width += spacing;
    else
        width += spacing * (n[YOUNG] + n[OLD]) / STOOLS / M_PI;
    add_stratum(&s, per_metre(STOOLS, width), work);
    for (int k = STANDARD; k < KINDS; k++)
        add_stratum(&s, per_metre(n[k], B + (alike ? mean_dbh(KINDS) : d[k])), w[k]);
    return s;
}

static void count_strata(const struct strata *strata, double counts[KINDS], double *work)
{
    *work = 0;
    memset(counts, 0, KINDS * sizeof *counts);
    for (size_t i = 0; i < sweep.count; i++) {
        const struct ceduo_stem_passed *s = &sweep.stems[i];
        size_t k = 0;
        while (k < strata->n && !(fabs(s->taken / strata->work[k] - 1) < 1e-12))
            k++;
        if (k == strata->n || !s->hit || !isnan(s->y) || !isnan(s->dbh) || !isinf(s->height))
            fail_msg("a contact that takes %.15g J", s->taken);
        counts[k]++;
        *work += s->taken;
    }
}

static void expect_compound(const char *name, const struct strata *strata, double metres, uint64_t rocks)
{
    static uint64_t count[COUNTS_MOST];
    struct spread all = {0}, work = {0}, each[KINDS] = {0};
    memset(count, 0, sizeof count);
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        double counts[KINDS], sum;
        sweep_rock(rock);
        count_strata(strata, counts, &sum);
        count[sweep.count]++;
        spread_add(&all, (double)sweep.count);
        spread_add(&work, sum);
        for (size_t k = 0; k < strata->n; k++)
            spread_add(&each[k], counts[k]);
    }
    sweep_end();
    double contacts = 0, mean = 0, variance = 0;
    for (size_t k = 0; k < strata->n; k++) {
        contacts += metres * strata->rate[k];
        mean += metres * strata->rate[k] * strata->work[k];
        variance += metres * strata->rate[k] * strata->work[k] * strata->work[k];
    }
    char what[80];
    for (size_t k = 0; k < strata->n; k++) {
        snprintf(what, sizeof what, "%s, contacts of stratum %zu", name, k);
        expect_mean(what, &each[k], metres * strata->rate[k]);
    }
    snprintf(what, sizeof what, "%s, contacts", name);
    expect_mean(what, &all, contacts);
    snprintf(what, sizeof what, "%s, variance of contacts", name);
    expect_variance(what, &all, contacts);
    snprintf(what, sizeof what, "%s, counts", name);
    expect_poisson(what, count, contacts);
    snprintf(what, sizeof what, "%s, J taken", name);
    expect_mean(what, &work, mean);
    snprintf(what, sizeof what, "%s, variance of J taken", name);
    expect_variance(what, &work, variance);
}

static void contacts_of_every_rule_are_poisson_and_take_each_stratums_work(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum ceduo_rule rule, meant;
        double spacing;
    } rows[] = {{"gsteiger-stools", CEDUO_GSTEIGER_STOOLS, CEDUO_GSTEIGER_STOOLS, .4},
                {"gsteiger-stems", CEDUO_GSTEIGER_STEMS, CEDUO_GSTEIGER_STEMS, .4},
                {"interception", CEDUO_INTERCEPTION, CEDUO_INTERCEPTION, .4},
                {"crofton", CEDUO_CROFTON, CEDUO_CROFTON, .4},
                {"auto, B > s", CEDUO_RULE_AUTO, CEDUO_INTERCEPTION, .4},
                {"auto, B < s", CEDUO_RULE_AUTO, CEDUO_GSTEIGER_STEMS, .7}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        clear_plane(520);
        plane.line.scene.simulation.contact_model = CEDUO_POISSON;
        plane.line.scene.simulation.rule = rows[i].rule;
        plane.line.scene.simulation.seed = i + 1;
        plant_kinds(100, 300, rows[i].spacing);
        struct strata strata = strata_of(rows[i].meant, rows[i].spacing);
        double contacts = 0;
        for (size_t k = 0; k < strata.n; k++)
            contacts += 200 * strata.rate[k];
        expect_compound(rows[i].name, &strata, 200, (uint64_t)(1.02e6 / contacts));
    }
}

/* ---- rings ---- */

static void a_ring_is_met_as_wide_as_its_hull_is_on_average(void **state)
{
    (void)state;
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
        char what[80];
        snprintf(what, sizeof what, "stools of %u, %.3f m apart, per metre", rings[i].n, rings[i].spacing);
        expect_mean(what, &m.stools, per_metre(stools, width));
        snprintf(what, sizeof what, "stems of stools of %u, %.3f m apart, per metre", rings[i].n, rings[i].spacing);
        expect_mean(what, &m.stems, per_metre(stools * n, B + d));
        snprintf(what, sizeof what, "stems per stool of %u met, %.3f m apart", rings[i].n, rings[i].spacing);
        expect_stems_per_stool(what, &m, n * (B + d) / width);
    }
}

/* Mean width from which both of two shoots `apart` metres from one another are met, over all directions. */
static double width_of_both(double width, double apart)
{
    double angle = apart > width ? asin(width / apart) : M_PI / 2;
    return 2 / M_PI * (width * angle - apart * (1 - cos(angle)));
}

/* Sum of that over all pairs of a ring, each counted twice: what clumping adds to the variance. */
static double pairs_of_ring(unsigned n, double spacing, double width)
{
    double sum = 0, r = spacing / 2 / sin(M_PI / n);
    for (unsigned i = 1; i < n; i++)
        sum += n * width_of_both(width, 2 * r * sin(M_PI * i / n));
    return sum;
}

static void clumping_changes_the_spread_but_not_the_mean(void **state)
{
    (void)state;
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
    expect_variance("variance on 50 m, stools of 6", &clumped,
                    mean + 50 * per_metre(1000, pairs_of_ring(6, spacing, B + d)));
    EXPECT(spread_variance(&clumped), >,
           spread_variance(&single) + 10 * hypot(spread_variance_se(&single), spread_variance_se(&clumped)));
}

/* ---- beside a full map ---- */

/* What is compared: places along the way and across it, gaps, and how many. */
struct swept {
    struct sample per_way, stools_per_way, gap, per_stool, x, y, dbh;
};

static int by_stool(const void *a, const void *b)
{
    const struct map_stem *p = a, *q = b;
    return (p->stool > q->stool) - (p->stool < q->stool);
}

/* One way's stems, in the order of x. */
static void swept_add(struct swept *s, struct map_stem *stems, size_t n)
{
    sample_add(&s->per_way, (double)n);
    for (size_t i = 0; i < n; i++) {
        sample_add(&s->x, stems[i].x);
        sample_add(&s->y, stems[i].y);
        sample_add(&s->dbh, stems[i].dbh);
        if (i > 0)
            sample_add(&s->gap, stems[i].x - stems[i - 1].x);
    }
    qsort(stems, n, sizeof *stems, by_stool);
    double stools = 0;
    for (size_t i = 0, j; i < n; i = j) {
        for (j = i; j < n && stems[j].stool == stems[i].stool; j++)
            ;
        double size = (double)(j - i), square = size * size;
        stools++;
        s->x.squares += square;
        s->y.squares += square;
        s->dbh.squares += square;
        s->gap.squares += square;
        if (stems[i].shoot)
            sample_add(&s->per_stool, size);
    }
    sample_add(&s->stools_per_way, stools);
}

static void swept_clear(struct swept *s)
{
    struct sample *all[] = {&s->per_way, &s->stools_per_way, &s->gap, &s->per_stool, &s->x, &s->y, &s->dbh};
    for (size_t i = 0; i < LENGTH(all); i++)
        sample_clear(all[i]);
}

static void sweep_ways(struct swept *to, uint64_t rocks)
{
    static struct map_stem stems[STEMS_MOST];
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_passed *p = &sweep.stems[i];
            stems[i] = (struct map_stem){p->x, p->y, p->dbh, p->shoot, p->stool};
            if (i > 0 && !(p->x >= p[-1].x))
                fail_msg("rock %ju comes to stems in the wrong order", (uintmax_t)rock);
        }
        swept_add(to, stems, sweep.count);
    }
    sweep_end();
}

static void sweep_maps(struct swept *to, uint64_t maps, unsigned long seed)
{
    static struct map_stem stems[STEMS_MOST];
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    for (uint64_t map = 0; map < maps; map++) {
        size_t n = plane_map_sweep(&plane.line.option, B, plane.line.scene.release.x.mean, rng, stems, STEMS_MOST);
        EXPECT(n, <=, STEMS_MOST);
        swept_add(to, stems, n);
    }
    gsl_rng_free(rng);
}

static void expect_same_as_map(const char *name, uint64_t ways, unsigned long seed)
{
    struct swept program = {0}, map = {0};
    sweep_ways(&program, ways);
    sweep_maps(&map, ways, seed);
    const struct {
        const char *what;
        struct sample *a, *b;
    } pairs[] = {{"hits per way", &program.per_way, &map.per_way},
                 {"stools and trees per way", &program.stools_per_way, &map.stools_per_way},
                 {"gaps", &program.gap, &map.gap},
                 {"hits per stool", &program.per_stool, &map.per_stool},
                 {"places", &program.x, &map.x},
                 {"offsets", &program.y, &map.y},
                 {"diameters", &program.dbh, &map.dbh}};
    for (size_t i = 0; i < LENGTH(pairs); i++) {
        char what[100];
        snprintf(what, sizeof what, "%s, %s", name, pairs[i].what);
        if (pairs[i].a->n + pairs[i].b->n > 0)
            expect_same_law(what, pairs[i].a, pairs[i].b);
    }
    swept_clear(&program);
    swept_clear(&map);
}

static void stems_met_are_those_of_a_full_map_in_the_plane(void **state)
{
    (void)state;
    clear_plane(70);
    plant_plot(1, 10, 60);
    expect_same_as_map("ADS 1", 20000, 1);
}

static void stems_of_many_kinds_are_those_of_a_full_map_in_the_plane(void **state)
{
    (void)state;
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(10, 60, 1200, .45);
    plant_shoots(belt, 3500, .05);
    plant_shoots(belt, 1600, .25);
    plant_trees(belt, 700, .1);
    plant_trees(belt, 300, .6);
    expect_same_as_map("two cohorts, two classes", 20000, 2);
}

static void stems_beside_a_gap_are_those_of_a_full_map_in_the_plane(void **state)
{
    (void)state;
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(10, 25, 900, 1.1); /* rings that reach far into the gap */
    plant_shoots(belt, 900 * 7.5, .08);
    plant_trees(belt, 400, .2);
    belt = plant_belt(28, 60, 1500, .3);
    plant_shoots(belt, 1500 * 1.6, .12);
    expect_same_as_map("two belts and a gap", 20000, 3);
}

static void stems_after_a_release_in_the_forest_are_those_of_a_full_map_in_the_plane(void **state)
{
    (void)state;
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(30, 60, 700, .4);
    plant_shoots(belt, 700 * 12, .07);
    plant_trees(belt, 300, .3);
    line_scene_release(&plane.line, 40, 1, 700, 0, 0);
    expect_same_as_map("released in a belt", 25000, 4);
}

/* ---- diameters ---- */

/* Diameters of met stems when all have a gamma law: a stem is met from a strip B + d wide, so that thick ones are met
 * more often, with density proportional to (B + d)f(d): f itself with weight B, and f weighted by d, again a gamma law
 * with one more in its shape, with weight mean d. */
struct biased {
    double mean, shape, scale;
};

static struct biased biased_of(double mean, double sd)
{
    return (struct biased){mean, mean * mean / (sd * sd), sd * sd / mean};
}

static double biased_cdf(double d, const void *of)
{
    const struct biased *l = of;
    return (B * gsl_cdf_gamma_P(d, l->shape, l->scale) + l->mean * gsl_cdf_gamma_P(d, l->shape + 1, l->scale)) /
           (B + l->mean);
}

/* The k-th moment of the gamma law. */
static double gamma_moment(const struct biased *l, int k)
{
    double m = 1;
    for (int i = 0; i < k; i++)
        m *= l->scale * (l->shape + i);
    return m;
}

static void expect_biased(const char *name, double per_ha, double mean, double sd, uint64_t rocks, double metres)
{
    struct biased law = biased_of(mean, sd);
    struct spread per = {0}, dbh = {0};
    struct sample all = {0};
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        spread_add(&per, (double)sweep.count / metres);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_passed *s = &sweep.stems[i];
            if (!(fabs(s->y) <= (B + s->dbh) / 2))
                fail_msg("%s: a stem %.17g m thick is met %.17g m off", name, s->dbh, s->y);
            spread_add(&dbh, s->dbh);
            if (i % 4 == 0) /* enough of them */
                sample_add(&all, s->dbh);
        }
    }
    sweep_end();
    char what[80];
    snprintf(what, sizeof what, "%s, met per metre", name);
    expect_mean(what, &per, per_metre(per_ha, B + mean));
    double first = (B * mean + gamma_moment(&law, 2)) / (B + mean);
    double second = (B * gamma_moment(&law, 2) + gamma_moment(&law, 3)) / (B + mean);
    snprintf(what, sizeof what, "%s, mean dbh of those met", name);
    expect_mean(what, &dbh, first);
    snprintf(what, sizeof what, "%s, variance of it", name);
    expect_variance(what, &dbh, second - first * first);
    snprintf(what, sizeof what, "%s, law of it, KS", name);
    expect_law(what, all.values, all.n, biased_cdf, &law);
    sample_clear(&all);
}

static void thick_stems_are_met_more_often(void **state)
{
    (void)state;
    clear_plane(520);
    plant_trees(plant_belt(10, 510, 0, 0), 4000, .2)->dbh_sd = .1;
    expect_biased("trees .2 ± .1 m", 4000, .2, .1, 5800, 500);
    clear_plane(520);
    plant_trees(plant_belt(10, 510, 0, 0), 4000, .3)->dbh_sd = .36; /* most of them thin */
    expect_biased("trees .3 ± .36 m", 4000, .3, .36, 5200, 500);
    clear_plane(520);
    plant_shoots(plant_belt(10, 510, 2000, .3), 9000, .1)->dbh_sd = .04;
    expect_biased("shoots .1 ± .04 m", 9000, .1, .04, 2900, 500);
}

static void expect_same_stems(const struct ceduo_stem_passed *a, size_t n)
{
    assert_int_equal(n, sweep.count);
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_stem_passed *p = &a[i], *q = &sweep.stems[i];
        if (p->x != q->x || p->y != q->y || p->dbh != q->dbh || p->height != q->height || p->shoot != q->shoot ||
            p->stool != q->stool || p->hit != q->hit || p->before != q->before || p->taken != q->taken)
            fail_msg("stem %zu is another", i);
    }
}

/* A spread of 0 is none, and one of nearly nothing moves diameters and offsets by as little. */
static void diameters_without_spread_change_nothing(void **state)
{
    (void)state;
    static struct ceduo_stem_passed plain[STEMS_MOST];
    for (uint64_t rock = 0; rock < 200; rock++) {
        clear_plane(520);
        plant_plot(1, 10, 510);
        sweep_one(rock);
        size_t n = sweep.count;
        struct ceduo_way way = sweep.way;
        memcpy(plain, sweep.stems, n * sizeof *plain);
        plane.trees[0][0].dbh_sd = plane.shoots[0][0].dbh_sd = 0;
        sweep_one(rock);
        expect_same_stems(plain, n);
        assert_memory_equal(&way, &sweep.way, sizeof way);
        plane.trees[0][0].dbh_sd = 1e-9;
        sweep_one(rock);
        assert_int_equal(n, sweep.count);
        for (size_t i = 0; i < n; i++)
            if (plain[i].x != sweep.stems[i].x || fabs(plain[i].y - sweep.stems[i].y) > 1e-8 ||
                fabs(plain[i].dbh - sweep.stems[i].dbh) > 1e-8)
                fail_msg("stem %zu moves", i);
    }
}

/* ---- what a hit takes ---- */

/* The share of the largest energy by eccentricity as Dorren et al. 2006 print it, cut to 0…1. */
static double printed_share(double u)
{
    double e = -.046 + (.98 + .046) / (1 + pow(10, (.58 - u) * -8.007));
    return e < 0 ? 0 : e > 1 ? 1 : e;
}

/* Its mean by Simpson's rule. */
static double mean_printed_share(void)
{
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; i++)
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * printed_share((double)i / n);
    return sum / (3 * n);
}

static void plant_dorren(double from, double to)
{
    struct ceduo_belt *belt = plant_belt(from, to, 800, .4);
    plant_trees(belt, 1500, .3);
    plant_shoots(belt, 3200, .12);
    belt->stand.energy = CEDUO_DORREN;
    belt->stand.fracture_ratio = 1.7;
}

static void dorrens_hits_take_the_share_of_their_eccentricity(void **state)
{
    (void)state;
    struct spread trees = {0}, shoots = {0};
    clear_plane(520);
    plant_dorren(10, 510);
    sweep_begin();
    for (uint64_t rock = 0; rock < 5000; rock++) {
        sweep_rock(rock);
        assert_int_equal(sweep.way.end, CEDUO_LEFT_SLOPE);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_passed *s = &sweep.stems[i];
            double most = 1.7 * 38.7 * pow(100 * s->dbh, 2.31), u = fabs(s->y) / ((B + s->dbh) / 2);
            double share = printed_share(u);
            if (!(fabs(s->taken / most - share) <= 1e-12 * fmax(share, 1e-3)))
                fail_msg("u = %.17g takes %.17g of %.17g", u, s->taken, most);
            spread_add(s->shoot ? &shoots : &trees, s->taken / most);
        }
    }
    sweep_end();
    double mean = mean_printed_share();
    expect_exact("mean share", ceduo_dorren_mean_share(), mean, 1e-6);
    EXPECT_NEAR(mean, .558, .0005);
    expect_mean("share of trees", &trees, mean);
    expect_mean("share of shoots", &shoots, mean);
    EXPECT(trees.n + shoots.n, >, 1e6);
}

/* A stem's hit between two pieces of the way, and what it does to the speed. */
struct scaling {
    struct ceduo_piece last;
    double left; /* share of the energy that the hit before leaves; NaN: none */
    uint64_t hits, checked;
    double radius, mass, moment;
    bool spins;
};

static double last_spin(const struct scaling *s)
{
    return !s->last.rolls ? s->last.spin : s->spins ? s->last.vx1 / s->radius : 0;
}

static void after_hit(void *context, const struct ceduo_piece *p)
{
    struct scaling *s = context;
    if (!isnan(s->left)) {
        double was = s->last.vx1 * s->last.vx1 + s->last.vz1 * s->last.vz1, is = p->vx * p->vx + p->vz * p->vz;
        expect_exact("v2 behind a stem", is / was, s->left, 1e-12);
        if (s->spins)
            expect_exact("spin2 behind a stem", p->spin * p->spin / (last_spin(s) * last_spin(s)), s->left, 1e-12);
        if (fabs(p->vz * s->last.vx1 - s->last.vz1 * p->vx) > 1e-12 * was)
            fail_msg("a stem turned the rock");
        s->checked++;
    }
    s->left = NAN;
    s->last = *p;
}

static void at_hit(void *context, const struct ceduo_stem_passed *stem)
{
    struct scaling *s = context;
    double v2 = s->last.vx1 * s->last.vx1 + s->last.vz1 * s->last.vz1;
    expect_exact("energy before", stem->before, (s->mass * v2 + s->moment * last_spin(s) * last_spin(s)) / 2, 1e-12);
    assert_true(stem->hit);
    EXPECT(stem->taken, >=, 0);
    EXPECT(stem->taken, <=, stem->before);
    EXPECT(stem->x, ==, s->last.x1);
    s->left = 1 - stem->taken / stem->before;
    s->hits++;
}

static void a_hit_scales_speed_and_spin_by_what_is_left_of_the_energy(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        bool rolls = i & 1, spins = i & 2;
        clear_plane(400);
        plant_dorren(10, 400);
        plane.line.scene.simulation.law = spins ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
        line_scene_release(&plane.line, 0, rolls ? 0 : 30, 60, 0, spins ? 60 / (B / 2) : 0);
        struct scaling s = {.left = NAN, .spins = spins};
        uint64_t stopped = 0;
        sweep_begin();
        for (uint64_t rock = 0; rock < 2000; rock++) {
            if (rock == 0)
                sweep_rock(0); /* for the rock's mass */
            s.radius = sweep.way.rock.radius;
            s.mass = sweep.way.rock.mass;
            s.moment = spins ? sweep.way.rock.moment : 0;
            s.left = NAN;
            sweep_watched(rock, &(struct ceduo_watch){.piece = after_hit, .stem = at_hit, .context = &s});
            stopped += sweep.way.end == CEDUO_STOPPED_BY_STEMS;
        }
        sweep_end();
        EXPECT(s.hits, >, 10000);
        EXPECT(s.checked, >=, s.hits - 2000);
        EXPECT(stopped, >, 100);
        assert_int_equal(s.hits - s.checked, stopped);
    }
}

/* Level ground, dorren's stems and one control. */
static void cross_at(double x, bool rolls)
{
    clear_plane(400);
    plant_dorren(10, 400);
    line_scene_release(&plane.line, 0, rolls ? 0 : 30, 60, 0, 0);
    plane.line.control = (struct ceduo_control){.x = x, .x_given = x, .accepted = NAN, .measured_speed = NAN};
    plane.line.scene.controls_count = 1;
}

static void a_control_where_a_stem_stands_is_passed_before_the_hit(void **state)
{
    (void)state;
    for (uint64_t rock = 0; rock < 400; rock++) {
        bool rolls = rock % 2;
        cross_at(400, rolls);
        sweep_one(rock);
        for (size_t i = 0; i < sweep.count && i < 4; i++) {
            struct ceduo_stem_passed stem = sweep.stems[i];
            struct ceduo_way way;
            struct ceduo_crossing c;
            cross_at(stem.x, rolls);
            assert_int_equal(ceduo_way_follow(&plane.line.scene, &plane.line.option, rock, NULL, &way, &c), CEDUO_OK);
            assert_true(c.reached);
            EXPECT(c.stems_hit, ==, i);
            expect_exact("energy at the control", way.rock.mass / 2 * (c.vx * c.vx + c.vz * c.vz), stem.before, 1e-12);
        }
    }
}

/* ---- heights ---- */

static void rocks_fly_over_stems_that_are_lower(void **state)
{
    (void)state;
    static const double heights[] = {4, 12, 25};
    const double fall = 30, v = 40, g = CEDUO_GRAVITY;
    struct spread come_to = {0}, hit = {0};
    clear_plane(400);
    line_scene_release(&plane.line, 0, fall, v, 0, 0);
    plane.line.segments[0].rn = ceduo_number(0); /* dead ground: the rock rolls from its landing on */
    struct ceduo_belt *belt = plant_belt(0, 400, 1000, .4);
    plant_shoots(belt, 4000, .05)->height = heights[0];
    plant_trees(belt, 1500, .2)->height = heights[1];
    plant_trees(belt, 500, .4)->height = heights[2];
    double expected = 0, landing = v * sqrt(2 * fall / g);
    static const double per_ha[] = {4000, 1500, 500}, dbh[] = {.05, .2, .4};
    for (size_t i = 0; i < LENGTH(heights); i++)
        expected += per_metre(per_ha[i], B + dbh[i]) * (400 - v * sqrt(2 * (fall - heights[i]) / g));
    sweep_begin();
    for (uint64_t rock = 0; rock < 6000; rock++) {
        sweep_rock(rock);
        uint64_t hits = 0;
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_passed *s = &sweep.stems[i];
            double above = s->x < landing ? fall - g / 2 * (s->x / v) * (s->x / v) : 0;
            if (s->hit != (s->clearance < s->height) || fabs(s->clearance - above) > 1e-9 ||
                (!s->hit && (s->taken != 0 || s->before != 0)))
                fail_msg("at %.17g the rock is %.17g high, not %.17g, a stem of %.3g m hit: %d", s->x, s->clearance,
                         above, s->height, s->hit);
            hits += s->hit;
        }
        if (hits != sweep.way.stems_hit || different(false) != sweep.way.stools_met)
            fail_msg("rock %ju: stems flown over are counted", (uintmax_t)rock);
        spread_add(&come_to, (double)sweep.count / 400);
        spread_add(&hit, (double)hits);
    }
    sweep_end();
    expect_mean("stems come to per metre", &come_to,
                per_metre(4000, B + .05) + per_metre(1500, B + .2) + per_metre(500, B + .4));
    expect_mean("stems hit", &hit, expected);
}

/* Clearance over a broken slope, from the pieces of the way themselves. */
#define PIECES_MOST 4096
struct pieces {
    size_t count;
    struct ceduo_piece piece[PIECES_MOST];
};

static void note_piece(void *context, const struct ceduo_piece *piece)
{
    struct pieces *p = context;
    EXPECT(p->count, <, PIECES_MOST);
    p->piece[p->count++] = *piece;
}

static void stem_beside_pieces(void *context, const struct ceduo_stem_passed *stem)
{
    (void)context;
    note_stem(&sweep, stem);
}

static double height_above_ground(const struct pieces *p, double x)
{
    size_t i = 0;
    while (i + 1 < p->count && x > p->piece[i].x1)
        i++;
    const struct ceduo_piece *f = &p->piece[i];
    EXPECT(x, >=, f->x);
    EXPECT(x, <=, f->x1);
    if (f->rolls)
        return 0;
    double t = (x - f->x) / f->vx, z = f->z + f->vz * t - CEDUO_GRAVITY / 2 * t * t;
    return z - ceduo_slope_height(&plane.line.scene.slope, x);
}

static void a_stem_is_hit_where_the_rock_is_lower_above_a_broken_slope(void **state)
{
    (void)state;
    static struct pieces pieces;
    static const double x[] = {0, 30, 45, 60, 61, 120, 200}, z[] = {0, -20, -22, -45, -60, -80, -130};
    uint64_t hits = 0, over = 0;
    clear_ground(LENGTH(x), x, z, .6, .3);
    line_scene_release(&plane.line, 2, 5, 8, 3, 0);
    struct ceduo_belt *belt = plant_belt(0, 200, 1000, .4);
    plant_shoots(belt, 4000, .05)->height = 3;
    plant_trees(belt, 1500, .2)->height = 10;
    sweep_begin();
    for (uint64_t rock = 0; rock < 1000; rock++) {
        pieces.count = 0;
        sweep_watched(rock, &(struct ceduo_watch){.piece = note_piece, .stem = stem_beside_pieces, .context = &pieces});
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_passed *s = &sweep.stems[i];
            double above = height_above_ground(&pieces, s->x);
            if (s->hit != (s->clearance < s->height) || fabs(s->clearance - above) > 1e-9)
                fail_msg("at %.17g: %.17g is not %.17g", s->x, s->clearance, above);
            hits += s->hit;
            over += !s->hit;
        }
    }
    sweep_end();
    EXPECT(hits, >, 10000);
    EXPECT(over, >, 10000);
}

/* ---- ground that is covered twice, and the release ---- */

/* The ground covered so far; a stem must lie at its edge. */
struct cover {
    double lo, hi;
    uint64_t turns;
    int dir;
};

static void cover_piece(void *context, const struct ceduo_piece *p)
{
    struct cover *c = context;
    c->lo = fmin(c->lo, p->x1);
    c->hi = fmax(c->hi, p->x1);
    int dir = p->x1 > p->x ? 1 : p->x1 < p->x ? -1 : c->dir;
    c->turns += dir != c->dir;
    c->dir = dir;
}

static void cover_stem(void *context, const struct ceduo_stem_passed *stem)
{
    const struct cover *c = context;
    if (stem->x > c->lo + 1e-9 && stem->x < c->hi - 1e-9)
        fail_msg("a stem at %.17g, on ground covered from %.17g to %.17g", stem->x, c->lo, c->hi);
    note_stem(&sweep, stem);
}

static int by_place(const void *a, const void *b)
{
    const struct ceduo_stem_passed *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return (p->stool > q->stool) - (p->stool < q->stool);
}

static void expect_each_stem_once(void)
{
    qsort(sweep.stems, sweep.count, sizeof *sweep.stems, by_place);
    for (size_t i = 1; i < sweep.count; i++)
        if (by_place(&sweep.stems[i - 1], &sweep.stems[i]) == 0)
            fail_msg("the stem at %.17g, %.17g is met twice", sweep.stems[i].x, sweep.stems[i].y);
}

/* A smooth valley in which a rock rolls to and fro, higher on the left than it was released. */
static void ground_that_is_covered_twice_holds_its_stems_once(void **state)
{
    (void)state;
    const double from = 381.3, slope = tan(15 * M_PI / 180), v = 31.3;
    struct spread left = {0}, right = {0};
    clear_ground(3, (double[]){0, 400, 800}, (double[]){0, -400 * slope, 0}, .5, 0);
    plant_plot(1, 0, 800);
    line_scene_release(&plane.line, from, 0, v * cos(atan(slope)), -v * sin(atan(slope)), 0);
    sweep_begin();
    for (uint64_t rock = 0; rock < 2500; rock++) {
        struct cover c = {from, from, 0, 1};
        sweep_watched(rock, &(struct ceduo_watch){.piece = cover_piece, .stem = cover_stem, .context = &c});
        assert_int_equal(sweep.way.end, CEDUO_AT_REST);
        EXPECT(c.turns, >, 10);
        EXPECT(c.lo, >, 200);
        EXPECT(c.lo, <, 320);
        EXPECT(c.hi, >, 500);
        size_t behind = 0;
        for (size_t i = 0; i < sweep.count; i++)
            behind += sweep.stems[i].x < from;
        spread_add(&left, (double)behind / (from - c.lo));
        spread_add(&right, (double)(sweep.count - behind) / (c.hi - from));
        expect_each_stem_once();
    }
    sweep_end();
    expect_mean("stems per metre behind the release", &left, per_metre(9076, B + .061));
    expect_mean("stems per metre before the release", &right, per_metre(9076, B + .061));
}

/* Level ground with a wall that throws the rock back over the place where it started. */
enum way_out { AHEAD, AHEAD_AND_BACK, BACK_AND_AHEAD };
#define RELEASE 150.
static void clear_court(enum way_out out)
{
    static const double right[] = {0, 300, 300.01, 310}, left[] = {0, 10, 10.01, 310};
    static const double rise[] = {0, 0, 1000, 1000}, fall[] = {0, 0, -1000, -1000};
    if (out == BACK_AND_AHEAD)
        clear_ground(4, left, fall, 1, 0);
    else
        clear_ground(out == AHEAD ? 2 : 4, right, rise, 1, 0);
    line_scene_release(&plane.line, RELEASE, 1, out == BACK_AND_AHEAD ? -1e4 : 1e4, 0, 0);
}

static void expect_even_court(const char *name, enum way_out out, double per_m, uint64_t rocks)
{
    static struct bins bins;
    const double reach = 4;
    memset(&bins, 0, sizeof bins);
    bins.width = .25;
    bins.from = out == AHEAD ? RELEASE : RELEASE - reach;
    bins.k = out == AHEAD ? 32 : (size_t)(2 * reach / bins.width);
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        assert_int_equal(sweep.way.end, CEDUO_LEFT_SLOPE);
        assert_true(out != AHEAD_AND_BACK || sweep.way.x == 0);
        for (size_t i = 0; i < sweep.count; i++)
            bins_note(&bins, sweep.stems[i].x);
        bins_end_rock(&bins);
    }
    sweep_end();
    expect_even(name, &bins, per_m * bins.width);
}

/* Stems are looked for on 8 m of so many per metre; the belt reaches beyond them by more than any ring. */
static void court_of_the_paper(enum way_out out)
{
    clear_court(out);
    plant_plot(1, RELEASE - 6, RELEASE + 10);
}

static void court_of_large_rings(enum way_out out)
{
    clear_court(out);
    plant_shoots(plant_belt(RELEASE - 9, RELEASE + 13, 100, .1), 20000, .06);
}

#define PAPER_PER_M (9076 * (B + .061) / 1e4)
#define RINGS_PER_M (20000 * (B + .06) / 1e4)

static void stems_stand_as_dense_right_from_a_release_in_the_forest_on(void **state)
{
    (void)state;
    court_of_the_paper(AHEAD);
    expect_even_court("ADS 1 from the release on", AHEAD, PAPER_PER_M, 190000);
    court_of_large_rings(AHEAD);
    expect_even_court("rings of 200 from the release on", AHEAD, RINGS_PER_M, 86000);
}

static void stems_stand_as_dense_on_both_sides_of_a_release_in_the_forest(void **state)
{
    (void)state;
    court_of_the_paper(AHEAD_AND_BACK);
    expect_even_court("ADS 1, ahead and then back", AHEAD_AND_BACK, PAPER_PER_M, 190000);
    court_of_large_rings(AHEAD_AND_BACK);
    expect_even_court("rings of 200, ahead and then back", AHEAD_AND_BACK, RINGS_PER_M, 86000);
    court_of_the_paper(BACK_AND_AHEAD);
    plane.line.scene.simulation.seed = 2;
    expect_even_court("ADS 1, back and then ahead", BACK_AND_AHEAD, PAPER_PER_M, 190000);
    court_of_large_rings(BACK_AND_AHEAD);
    plane.line.scene.simulation.seed = 2;
    expect_even_court("rings of 200, back and then ahead", BACK_AND_AHEAD, RINGS_PER_M, 86000);
}

/* A stool astride of the release is one stool, whichever way the rock goes first. */
static void the_stems_about_a_release_do_not_depend_on_where_the_rock_goes_first(void **state)
{
    (void)state;
    static struct ceduo_stem_passed ahead[STEMS_MOST];
    uint64_t astride = 0;
    for (uint64_t rock = 0; rock < 2000; rock++) {
        court_of_the_paper(AHEAD_AND_BACK);
        sweep_one(rock);
        expect_each_stem_once();
        size_t n = sweep.count, met = sweep.way.stools_met;
        memcpy(ahead, sweep.stems, n * sizeof *ahead);
        assert_int_equal(met, different(false));
        court_of_the_paper(BACK_AND_AHEAD);
        sweep_one(rock);
        expect_each_stem_once();
        assert_int_equal(n, sweep.count);
        assert_int_equal(met, sweep.way.stools_met);
        for (size_t i = 0; i < n; i++)
            if (by_place(&ahead[i], &sweep.stems[i]) != 0 || ahead[i].dbh != sweep.stems[i].dbh)
                fail_msg("rock %ju: the stem at %.17g is another", (uintmax_t)rock, ahead[i].x);
        for (size_t i = 1; i < n; i++)
            astride += ahead[i - 1].x < RELEASE && ahead[i].x >= RELEASE && ahead[i - 1].stool == ahead[i].stool;
    }
    EXPECT(astride, >, 40); /* some were there */
}

/* Far ahead and back again: many other stools lie between the two hits of one astride of the release. */
static void a_stool_astride_of_the_release_is_one_however_far_the_rock_went_between(void **state)
{
    (void)state;
    uint64_t wrong = 0, rocks = 2000;
    clear_court(AHEAD_AND_BACK);
    plant_plot(1, RELEASE - 6, RELEASE + 145);
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        wrong += sweep.way.stools_met != different(false);
    }
    sweep_end();
    if (wrong > 0)
        fail_msg("%ju of %ju rocks count a stool twice", (uintmax_t)wrong, (uintmax_t)rocks);
}

/* ---- rocks that stems stop ---- */

static struct ceduo_run *run_of(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                                unsigned threads, size_t exact_bytes)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.option = option;
    def.rocks_most = rocks;
    def.threads = threads;
    def.exact_bytes = exact_bytes;
    struct ceduo_run *run;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), rocks);
    return run;
}

/* Where the first point of a Poisson process lies, if there is one on `length` from `from` on. */
struct first_stem {
    double from, length, rate;
};

static double first_stem_cdf(double x, const void *of)
{
    const struct first_stem *f = of;
    return expm1(-f->rate * (x - f->from)) / expm1(-f->rate * f->length);
}

static void expect_run_stopped(const struct sample *stops, uint64_t rocks)
{
    struct ceduo_run *run = run_of(&plane.line.scene, &plane.line.option, rocks, 2, CEDUO_EXACT_BYTES);
    struct ceduo_ends ends;
    assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK);
    assert_int_equal(ends.count[CEDUO_STOPPED_BY_STEMS], stops->n);
    assert_int_equal(ends.count[CEDUO_LEFT_SLOPE], rocks - stops->n);
    assert_int_equal(ends.stop_x.n, stops->n);
    double sum = 0;
    for (size_t i = 0; i < stops->n; i++)
        sum += stops->values[i];
    expect_exact("mean place of the stopped", ends.stop_x.mean, sum / (double)stops->n, 1e-12);
    EXPECT(ends.stop_max, ==, stops->values[stops->n - 1]); /* they are sorted */
    EXPECT(ends.stop_p50, ==, stops->values[(stops->n + 1) / 2 - 1]);
    struct ceduo_stem_counts counts = ceduo_run_stems(run);
    EXPECT(counts.hit, ==, stops->n);
    EXPECT(counts.met, ==, stops->n);
    EXPECT(counts.drawn, >=, counts.hit);
    ceduo_run_free(run);
}

static void expect_stopped(const char *name, uint64_t rocks)
{
    struct sample stops = {0};
    struct first_stem law = {10, 500, per_metre(30, B + .2)};
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        sweep_rock(rock);
        if (sweep.count == 0) {
            assert_int_equal(sweep.way.end, CEDUO_LEFT_SLOPE);
            continue;
        }
        const struct ceduo_stem_passed *s = sweep.stems;
        if (sweep.count != 1 || sweep.way.end != CEDUO_STOPPED_BY_STEMS || sweep.way.x != s->x || s->taken != s->before)
            fail_msg("%s: rock %ju is not stopped at %.17g", name, (uintmax_t)rock, s->x);
        sample_add(&stops, sweep.way.x);
    }
    sweep_end();
    char what[80];
    snprintf(what, sizeof what, "%s, share stopped by stems", name);
    expect_share(what, stops.n, rocks, -expm1(-law.rate * law.length));
    snprintf(what, sizeof what, "%s, places, KS", name);
    expect_law(what, stops.values, stops.n, first_stem_cdf, &law);
    expect_run_stopped(&stops, rocks);
    sample_clear(&stops);
}

static void rocks_are_stopped_where_their_stem_stands(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        static const char *const names[] = {"in flight", "rolling", "poisson"};
        clear_plane(520);
        plane.line.scene.simulation.seed = (uint64_t)i + 1;
        plant_trees(plant_belt(10, 510, 0, 0), 30, .2)->volume = 1e30;
        if (i == 1)
            line_scene_release(&plane.line, 0, 0, 5000, 0, 0);
        if (i == 2)
            plane.line.scene.simulation.contact_model = CEDUO_POISSON;
        expect_stopped(names[i], i == 1 ? 10000 : 100000);
    }
}

/* ---- the paper's site ---- */

static struct paper_site site;

/* Independent implementations of the same model, rule auto; energies (kJ) and speeds of those that pass x = 135 m, shares
 * (%) of all released. In the paper a rock was filmed there with 62.3 kJ and 15.6 m/s. */
struct site_row {
    enum ceduo_contact_model model;
    double energy, speed, pass, stopped;
};

static void rocks_on_the_papers_site_arrive_as_in_independent_implementations(void **state)
{
    (void)state;
    static const struct site_row rows[] = {{CEDUO_POISSON, 66.75, 15.29, 83.9, 15.2},
                                           {CEDUO_STEMS, 62.06, 14.67, 83.2, 15.4}};
    const uint64_t rocks = 300000;
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct site_row *r = &rows[i];
        paper_site_init(&site);
        site.scene.simulation.contact_model = r->model;
        struct ceduo_run *run = run_of(&site.scene, &site.option, rocks, 2, CEDUO_EXACT_BYTES);
        struct ceduo_arrivals a;
        struct ceduo_ends e;
        assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
        assert_int_equal(ceduo_run_ends(run, &e), CEDUO_OK);
        double n = (double)rocks, pass = a.reach_probability;
        double stopped = (double)e.count[CEDUO_STOPPED_BY_STEMS] / n;
        expect_close("kJ at 135 m", a.energy.mean / 1e3, a.energy.se / 1e3, r->energy, .1);
        /* its error is not printed: half of that of the energy, as shares go, and half a digit */
        expect_close("m/s at 135 m", a.speed.mean, a.speed.se, r->speed, r->speed * .05 / r->energy + .005 / 4);
        expect_close("% that pass", 100 * pass, 100 * sqrt(pass * (1 - pass) / n), r->pass, .1);
        expect_close("% stopped by stems", 100 * stopped, 100 * sqrt(stopped * (1 - stopped) / n), r->stopped, .1);
        uint64_t ended = 0;
        for (int k = 0; k < CEDUO_ENDS; k++)
            ended += e.count[k];
        assert_int_equal(ended, rocks);
        ceduo_run_free(run);
    }
}

/* ---- options side by side ---- */

/* The paper's site, another option beside it: the same stems, which take a little more. */
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

/* Energy of each rock at the control, 0 where it does not arrive, whose `reached` is false. */
static double energy_of_rock(struct ceduo_follower *f, uint64_t rock, bool *reached)
{
    struct ceduo_way w;
    struct ceduo_crossing c;
    assert_int_equal(ceduo_follower_follow(f, rock, NULL, &w, &c), CEDUO_OK);
    *reached = c.reached;
    return c.reached ? (w.rock.mass * (c.vx * c.vx + c.vz * c.vz) + w.rock.moment * c.spin * c.spin) / 2 : 0;
}

struct pair_moments {
    struct ceduo_moments reach, exceed, energy;
};

static struct pair_moments pairs_of(const struct ceduo_option *a, const struct ceduo_option *b, uint64_t rocks)
{
    struct pair_moments m = {0};
    struct ceduo_follower *f = ceduo_follower_create(&site.scene, a), *g = ceduo_follower_create(&site.scene, b);
    assert_true(f);
    assert_true(g);
    for (uint64_t rock = 0; rock < rocks; rock++) {
        bool p, q;
        double e = energy_of_rock(f, rock, &p), h = energy_of_rock(g, rock, &q);
        ceduo_moments_add(&m.reach, (double)p - (double)q);
        ceduo_moments_add(&m.exceed, (double)(e > site.control.accepted) - (double)(h > site.control.accepted));
        ceduo_moments_add(&m.energy, e - h);
    }
    ceduo_follower_free(f);
    ceduo_follower_free(g);
    return m;
}

static void expect_pair(const char *what, const struct ceduo_paired *d, const struct ceduo_moments *m, double a,
                        double b)
{
    print_message("# %s: %.6g ± %.3g\n", what, d->mean, d->se);
    if (fabs(d->mean - (a - b)) > 1e-12 * (fabs(a) + fabs(b)))
        fail_msg("%s: %.17g is not %.17g", what, d->mean, a - b);
    if (fabs(d->mean - m->mean) > 1e-12 * (fabs(a) + fabs(b)))
        fail_msg("%s: %.17g is not %.17g, rock by rock", what, d->mean, m->mean);
    expect_exact(what, d->se, ceduo_moments_se(m), 1e-9);
}

static void differences_have_the_error_of_differences_rock_by_rock(void **state)
{
    (void)state;
    const uint64_t rocks = 6000;
    open_sides();
    for (int other = 0; other < 2; other++) { /* the small change, no forest */
        const struct ceduo_option *option = other ? NULL : &sides.options[1];
        struct ceduo_run *run = run_of(&site.scene, option, rocks, 2, CEDUO_EXACT_BYTES);
        struct ceduo_run *base = run_of(&site.scene, &sides.options[0], rocks, 2, CEDUO_EXACT_BYTES);
        struct ceduo_difference d = ceduo_run_difference(run, base, 0);
        struct pair_moments m = pairs_of(option, &sides.options[0], rocks);
        struct ceduo_arrivals a, b;
        assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
        assert_int_equal(ceduo_run_arrivals(base, 0, &b), CEDUO_OK);
        expect_pair("difference of shares that pass", &d.reach_probability, &m.reach, a.reach_probability,
                    b.reach_probability);
        expect_pair("difference of shares above what is accepted", &d.exceed_probability, &m.exceed,
                    a.exceed_probability, b.exceed_probability);
        expect_pair("difference of J per released", &d.energy_per_released, &m.energy, a.energy_per_released,
                    b.energy_per_released);
        double apart = hypot(a.energy_per_released_se, b.energy_per_released_se);
        EXPECT(d.energy_per_released.se, <, (other ? 1 : .5) * apart);
        ceduo_run_free(base);
        ceduo_run_free(run);
    }
}

static bool same_pair(const struct ceduo_paired *a, const struct ceduo_paired *b)
{
    return fabs(a->mean - b->mean) <= 1e-15 * fabs(a->mean) && fabs(a->se / b->se - 1) < 1e-9;
}

static void differences_without_all_samples_are_the_same(void **state)
{
    (void)state;
    const uint64_t rocks = 5000;
    static const size_t bytes[] = {CEDUO_EXACT_BYTES, 5000 * sizeof(double), 2500 * sizeof(double), 0};
    struct ceduo_difference d[LENGTH(bytes)];
    open_sides();
    for (size_t i = 0; i < LENGTH(bytes); i++) {
        struct ceduo_run *run = run_of(&site.scene, &sides.options[1], rocks, 2, bytes[i]);
        struct ceduo_run *base = run_of(&site.scene, &sides.options[0], rocks, 2, bytes[i]);
        struct ceduo_arrivals a;
        assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
        EXPECT(a.exact, ==, (i == 0));
        d[i] = ceduo_run_difference(run, base, 0);
        ceduo_run_free(base);
        ceduo_run_free(run);
        EXPECT(d[i].energy_per_released.mean, ==, d[0].energy_per_released.mean);
        EXPECT(d[i].reach_probability.mean, ==, d[0].reach_probability.mean);
        EXPECT(d[i].exceed_probability.mean, ==, d[0].exceed_probability.mean);
    }
    /* energies of all rocks are kept, though not all samples */
    assert_true(same_pair(&d[1].energy_per_released, &d[0].energy_per_released));
    assert_true(same_pair(&d[1].reach_probability, &d[0].reach_probability));
    assert_true(same_pair(&d[1].exceed_probability, &d[0].exceed_probability));
    /* of half of them: the spread is known a little worse */
    EXPECT_NEAR(d[2].energy_per_released.se / d[0].energy_per_released.se, 1, .1);
}

static void expect_same_bits(const struct ceduo_run *a, const struct ceduo_run *b)
{
    struct ceduo_arrivals x, y;
    struct ceduo_ends p, q;
    assert_int_equal(ceduo_run_arrivals(a, 0, &x), CEDUO_OK);
    assert_int_equal(ceduo_run_arrivals(b, 0, &y), CEDUO_OK);
    assert_memory_equal(&x, &y, offsetof(struct ceduo_arrivals, exact)); /* behind it is padding */
    assert_int_equal(ceduo_run_ends(a, &p), CEDUO_OK);
    assert_int_equal(ceduo_run_ends(b, &q), CEDUO_OK);
    assert_memory_equal(&p, &q, sizeof p);
    struct ceduo_stem_counts s = ceduo_run_stems(a), t = ceduo_run_stems(b);
    assert_memory_equal(&s, &t, sizeof s);
}

static void the_same_bits_among_stems_with_any_number_of_threads_and_steps(void **state)
{
    (void)state;
    const uint64_t rocks = 5000;
    static const size_t bytes[] = {CEDUO_EXACT_BYTES, 5000 * sizeof(double)};
    static const unsigned threads[] = {2, 5};
    static const uint64_t to[] = {999, 1024, 3000, 3000, 4096, 5000};
    open_sides();
    for (size_t e = 0; e < LENGTH(bytes); e++) {
        struct ceduo_run *base = run_of(&site.scene, &sides.options[0], rocks, 1, bytes[e]);
        struct ceduo_run *one = run_of(&site.scene, &sides.options[1], rocks, 1, bytes[e]);
        struct ceduo_difference d = ceduo_run_difference(one, base, 0), f;
        for (size_t t = 0; t < LENGTH(threads); t++) {
            struct ceduo_run *many = run_of(&site.scene, &sides.options[1], rocks, threads[t], bytes[e]);
            expect_same_bits(one, many);
            f = ceduo_run_difference(many, base, 0);
            assert_memory_equal(&d, &f, sizeof d);
            ceduo_run_free(many);
        }
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        def.option = &sides.options[1];
        def.rocks_most = rocks;
        def.threads = 5;
        def.exact_bytes = bytes[e];
        struct ceduo_run *steps;
        assert_int_equal(ceduo_run_create(&def, &steps), CEDUO_OK);
        for (size_t i = 0; i < LENGTH(to); i++)
            assert_int_equal(ceduo_run_extend(steps, to[i]), CEDUO_OK);
        expect_same_bits(one, steps);
        f = ceduo_run_difference(steps, base, 0);
        assert_memory_equal(&d, &f, sizeof d);
        f = ceduo_run_difference(one, one, 0);
        EXPECT(f.energy_per_released.mean, ==, 0);
        EXPECT(f.energy_per_released.se, ==, 0);
        ceduo_run_free(steps);
        ceduo_run_free(one);
        ceduo_run_free(base);
    }
}

/* Hits on a way, all and before the control. */
struct before {
    uint64_t all, control;
};

static void count_before(void *context, const struct ceduo_stem_passed *stem)
{
    struct before *b = context;
    b->all += stem->hit;
    b->control += stem->hit && stem->x < site.control.x;
}

static void a_run_among_stems_flies_the_rocks_that_can_be_followed(void **state)
{
    (void)state;
    const uint64_t rocks = 3000;
    open_sides();
    struct ceduo_run *run = run_of(&site.scene, &sides.options[0], rocks, 2, CEDUO_EXACT_BYTES);
    struct ceduo_follower *f = ceduo_follower_create(&site.scene, &sides.options[0]);
    struct ceduo_moments energy = {0}, hits = {0};
    struct ceduo_stem_counts sum = {0}, counts = ceduo_run_stems(run);
    for (uint64_t rock = 0; rock < rocks; rock++) {
        struct ceduo_way w;
        struct ceduo_crossing c;
        struct before before = {0};
        assert_int_equal(ceduo_follower_follow(f, rock, &(struct ceduo_watch){.stem = count_before, .context = &before}, &w, &c),
                         CEDUO_OK);
        assert_int_equal(w.stems_hit, before.all);
        assert_true(!c.reached || c.stems_hit == before.control);
        sum.drawn += w.stems_drawn;
        sum.hit += w.stems_hit;
        sum.met += w.stools_met;
        if (!c.reached)
            continue;
        ceduo_moments_add(&energy, (w.rock.mass * (c.vx * c.vx + c.vz * c.vz)) / 2);
        ceduo_moments_add(&hits, (double)c.stems_hit);
    }
    ceduo_follower_free(f);
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
    EXPECT(sum.drawn, ==, counts.drawn);
    EXPECT(sum.hit, ==, counts.hit);
    EXPECT(sum.met, ==, counts.met);
    assert_int_equal(a.reached, energy.n);
    expect_exact("mean energy", a.energy.mean, energy.mean, 1e-12);
    expect_exact("mean contacts", a.contacts, hits.mean, 1e-12);
    expect_exact("their error", a.contacts_se, ceduo_moments_se(&hits), 1e-9);
    ceduo_run_free(run);
}

/* Behind every stem a flight or roll is computed afresh; where the stem takes nothing that must not show. */
static void stems_that_take_nothing_leave_the_way_as_it_is(void **state)
{
    (void)state;
    const uint64_t rocks = 4000;
    uint64_t same = 0;
    struct spread met[2] = {0};
    paper_site_init(&site);
    for (int i = 0; i < 2; i++) {
        struct paper_plot *p = &site.plots[i];
        p->shoots.volume = p->trees.volume = 1e-25;
        p->shoots.height = p->trees.height = 1e3;
    }
    site.belts[0].from = -5; /* stools before the release reach over it */
    struct ceduo_follower *f = ceduo_follower_create(&site.scene, &site.option);
    struct ceduo_follower *bare = ceduo_follower_create(&site.scene, NULL);
    assert_true(f);
    assert_true(bare);
    for (uint64_t rock = 0; rock < rocks; rock++) {
        struct ceduo_way v, w;
        struct ceduo_crossing c, d;
        assert_int_equal(ceduo_follower_follow(bare, rock, NULL, &v, &c), CEDUO_OK);
        sweep.count = 0;
        assert_int_equal(
            ceduo_follower_follow(f, rock, &(struct ceduo_watch){.stem = note_stem, .context = &sweep}, &w, &d),
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
    ceduo_follower_free(f);
    ceduo_follower_free(bare);
    print_message("# %ju of %ju ways the same\n", (uintmax_t)same, (uintmax_t)rocks);
    EXPECT(same, >, rocks * 98 / 100); /* some turn elsewhere by rounding */
    expect_mean("stems per metre of ADS 1 on the paper's site", &met[0], per_metre(9076, B + .061));
    expect_mean("stems per metre of ADS 2 on the paper's site", &met[1], per_metre(4641, B + .047));
}

static void options_with_the_same_stems_share_a_run(void **state)
{
    (void)state;
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
    struct ceduo_pool *pool;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    struct ceduo_work work = ceduo_pool_work(pool);
    assert_int_equal(work.runs, 3);   /* without forest, the paper's, the shorter */
    assert_int_equal(work.reused, 5); /* of 4 options, each with its forest and without, 8 in all */
    assert_ptr_equal(ceduo_pool_find(pool, &options[1]), ceduo_pool_find(pool, &options[0]));
    assert_ptr_not_equal(ceduo_pool_find(pool, &options[2]), ceduo_pool_find(pool, &options[0]));
    assert_ptr_equal(ceduo_pool_find(pool, &options[3]), ceduo_pool_find(pool, NULL));
    assert_int_equal(ceduo_pool_extend(pool, 1000), CEDUO_OK);
    work = ceduo_pool_work(pool);
    assert_int_equal(work.rocks, 3000);
    struct ceduo_run *run = ceduo_pool_find(pool, &options[0]);
    struct ceduo_run *alone = run_of(&site.scene, &options[1], 1000, 1, CEDUO_EXACT_BYTES);
    expect_same_bits(run, alone);
    ceduo_run_free(alone);
    ceduo_pool_free(pool);
}

/* The key of the other option when its first plot has stems of many diameters and something of it is changed. */
enum change { NOTHING, DBH, DBH_SD, HEIGHT, VOLUME, PER_HA, SPACING, STOOLS_PER_HA, WORK, TO, CHANGES };

static uint64_t key_with(enum change change)
{
    open_sides();
    struct paper_plot *p = &sides.plots[0];
    struct ceduo_stand *stand = &sides.belts[0].stand;
    p->shoots.dbh_sd = p->trees.dbh_sd = .02;
    double *const changed[CHANGES] = {NULL,
                                      &p->shoots.dbh,
                                      &p->shoots.dbh_sd,
                                      &p->shoots.height,
                                      &p->trees.volume,
                                      &p->trees.per_ha,
                                      &stand->spacing,
                                      &stand->stools_per_ha,
                                      &stand->u,
                                      &sides.belts[0].to};
    if (changed[change])
        *changed[change] *= .9;
    return ceduo_option_key(&site.scene.simulation, &sides.options[1]);
}

static void whatever_decides_about_stems_makes_another_run(void **state)
{
    (void)state;
    for (int i = 0; i < CHANGES; i++)
        for (int j = 0; j < CHANGES; j++)
            if ((key_with((enum change)i) == key_with((enum change)j)) != (i == j))
                fail_msg("changes %d and %d", i, j);
}

/* ---- extremes ---- */

static void expect_stems_per_metre(const char *what, double expected, uint64_t rocks, double metres)
{
    struct met m = meet(rocks, metres);
    expect_mean(what, &m.stems, expected);
}

static void extreme_stands_are_met_as_they_should_be(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stems_met_per_metre_are_those_of_equation_1_and_stools_those_of_crofton),
        cmocka_unit_test(a_rolling_rock_meets_as_many_and_rolls_on_as_if_there_were_none),
        cmocka_unit_test(rocks_of_many_sizes_meet_as_many_as_their_mean),
        cmocka_unit_test(counts_of_trees_in_a_stretch_are_poisson),
        cmocka_unit_test(gaps_between_trees_are_exponential_and_offsets_uniform),
        cmocka_unit_test(the_chance_to_meet_nothing_of_ten_metres_is_that_of_crofton),
        cmocka_unit_test(contacts_of_every_rule_are_poisson_and_take_each_stratums_work),
        cmocka_unit_test(a_ring_is_met_as_wide_as_its_hull_is_on_average),
        cmocka_unit_test(clumping_changes_the_spread_but_not_the_mean),
        cmocka_unit_test(stems_met_are_those_of_a_full_map_in_the_plane),
        cmocka_unit_test(stems_of_many_kinds_are_those_of_a_full_map_in_the_plane),
        cmocka_unit_test(stems_beside_a_gap_are_those_of_a_full_map_in_the_plane),
        cmocka_unit_test(stems_after_a_release_in_the_forest_are_those_of_a_full_map_in_the_plane),
        cmocka_unit_test(thick_stems_are_met_more_often),
        cmocka_unit_test(diameters_without_spread_change_nothing),
        cmocka_unit_test(dorrens_hits_take_the_share_of_their_eccentricity),
        cmocka_unit_test(a_hit_scales_speed_and_spin_by_what_is_left_of_the_energy),
        cmocka_unit_test(a_control_where_a_stem_stands_is_passed_before_the_hit),
        cmocka_unit_test(rocks_fly_over_stems_that_are_lower),
        cmocka_unit_test(a_stem_is_hit_where_the_rock_is_lower_above_a_broken_slope),
        cmocka_unit_test(ground_that_is_covered_twice_holds_its_stems_once),
        cmocka_unit_test(stems_stand_as_dense_right_from_a_release_in_the_forest_on),
        cmocka_unit_test(stems_stand_as_dense_on_both_sides_of_a_release_in_the_forest),
        cmocka_unit_test(the_stems_about_a_release_do_not_depend_on_where_the_rock_goes_first),
        cmocka_unit_test(a_stool_astride_of_the_release_is_one_however_far_the_rock_went_between),
        cmocka_unit_test(rocks_are_stopped_where_their_stem_stands),
        cmocka_unit_test(rocks_on_the_papers_site_arrive_as_in_independent_implementations),
        cmocka_unit_test(differences_have_the_error_of_differences_rock_by_rock),
        cmocka_unit_test(differences_without_all_samples_are_the_same),
        cmocka_unit_test(the_same_bits_among_stems_with_any_number_of_threads_and_steps),
        cmocka_unit_test(a_run_among_stems_flies_the_rocks_that_can_be_followed),
        cmocka_unit_test(stems_that_take_nothing_leave_the_way_as_it_is),
        cmocka_unit_test(options_with_the_same_stems_share_a_run),
        cmocka_unit_test(whatever_decides_about_stems_makes_another_run),
        cmocka_unit_test(extreme_stands_are_met_as_they_should_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
