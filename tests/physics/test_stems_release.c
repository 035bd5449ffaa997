/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stems around a release in the forest, and ground covered twice: as dense as elsewhere, each stem met once. */
#include "ceduo/simulate.h"
#include "expect.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "stems_scene.h"

/* ---- bins ---- */

/* Stems in bins along x, rock by rock. Stems of one stool are not independent, so the covariance of the bins over rocks is
 * kept. */
#define BINS_MAX 64
struct bins {
    size_t k;
    double from, width, n;
    double now[BINS_MAX], sum[BINS_MAX], cross[BINS_MAX][BINS_MAX];
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

/* Expect equal means of all bins: chi-square of the means with their covariance (Hotelling 1931, many rocks). */
static void expect_even(const char *label, const struct bins *b, double per_bin)
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
    expect_chi_square(label, chi2, (double)b->k);
}

/* ---- ground covered twice ---- */

/* Ground already covered; a new stem must lie at its edge. */
struct cover {
    double lo, hi;
    uint64_t turns;
    int dir;
};

static void cover_piece(void *context, const struct ceduo_trajectory_segment *p)
{
    struct cover *c = context;
    c->lo = fmin(c->lo, p->x1);
    c->hi = fmax(c->hi, p->x1);
    int dir = p->x1 > p->x ? 1 : p->x1 < p->x ? -1 : c->dir;
    c->turns += dir != c->dir;
    c->dir = dir;
}

static void cover_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    const struct cover *c = context;
    if (stem->x > c->lo + 1e-9 && stem->x < c->hi - 1e-9)
        fail_msg("a stem at %.17g, on ground covered from %.17g to %.17g", stem->x, c->lo, c->hi);
    note_stem(&sweep, stem);
}

static int by_place(const void *a, const void *b)
{
    const struct ceduo_stem_encounter *p = a, *q = b;
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

/* A smooth valley in which a rock rolls to and fro, on the left higher than its release. */
TEST(ground_covered_twice_has_its_stems_once)
{
    const double from = 381.3, slope = tan(15 * M_PI / 180), v = 31.3;
    struct spread left = {0}, right = {0};
    clear_ground(3, (double[]){0, 400, 800}, (double[]){0, -400 * slope, 0}, .5, 0);
    plant_plot(1, 0, 800);
    line_scene_release(&plane.line, from, 0, v * cos(atan(slope)), -v * sin(atan(slope)), 0);
    sweep_begin();
    for (uint64_t rock = 0; rock < 2500; rock++) {
        struct cover c = {from, from, 0, 1};
        sweep_watched(rock, &(struct ceduo_trajectory_callbacks){.segment = cover_piece, .stem = cover_stem, .context = &c});
        assert_int_equal(sweep.trajectory.end, CEDUO_END_AT_REST);
        ROWS(EXPECT, (c.turns, >, 10), (c.lo, >, 200), (c.lo, <, 320), (c.hi, >, 500));
        size_t after = 0;
        for (size_t i = 0; i < sweep.count; i++)
            after += sweep.stems[i].x < from;
        spread_add(&left, (double)after / (from - c.lo));
        spread_add(&right, (double)(sweep.count - after) / (c.hi - from));
        expect_each_stem_once();
    }
    sweep_end();
    expect_mean("stems per metre behind the release", &left, per_metre(9076, B + .061));
    expect_mean("stems per metre before the release", &right, per_metre(9076, B + .061));
}

/* ---- a release in the forest ---- */

/* Level ground with a wall that throws the rock back across its release. */
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
    for (SWEEP(rock, rocks)) {
        assert_int_equal(sweep.trajectory.end, CEDUO_END_LEFT_SLOPE);
        assert_true(out != AHEAD_AND_BACK || sweep.trajectory.x == 0);
        for (size_t i = 0; i < sweep.count; i++)
            bins_note(&bins, sweep.stems[i].x);
        bins_end_rock(&bins);
    }
    expect_even(name, &bins, per_m * bins.width);
}

/* Count stems on 8 m by their density per metre; the belt reaches beyond by more than any ring. */
static void court_of_the_paper(enum way_out out)
{
    clear_court(out);
    plant_plot(1, RELEASE - 6, RELEASE + 10);
}

TEST(stems_are_equally_dense_around_a_release_in_the_forest)
{
    static const char *const names[] = {"from the release on", "ahead and then back", "back and then ahead"};
    for (enum way_out out = AHEAD; out <= BACK_AND_AHEAD; out++) {
        court_of_the_paper(out);
        plane.line.scene.simulation.seed += out == BACK_AND_AHEAD;
        expect_even_court(names[out], out, 9076 * (B + .061) / 1e4, 190000);
        clear_court(out); /* rings of 200 */
        plant_shoots(plant_belt(RELEASE - 9, RELEASE + 13, 100, .1), 20000, .06);
        plane.line.scene.simulation.seed += out == BACK_AND_AHEAD;
        expect_even_court(names[out], out, 20000 * (B + .06) / 1e4, 86000);
    }
}

/* A stool on both sides of the release is one stool, whichever way the rock goes first. */
TEST(stems_around_a_release_do_not_depend_on_the_first_direction)
{
    static struct ceduo_stem_encounter stems[STEMS_MAX];
    uint64_t astride = 0;
    for (uint64_t rock = 0; rock < 2000; rock++) {
        court_of_the_paper(AHEAD_AND_BACK);
        sweep_one(rock);
        expect_each_stem_once();
        size_t n = sweep.count, met = sweep.trajectory.stools_met;
        memcpy(stems, sweep.stems, n * sizeof *stems);
        assert_int_equal(met, count_different(false));
        court_of_the_paper(BACK_AND_AHEAD);
        sweep_one(rock);
        expect_each_stem_once();
        assert_int_equal(n, sweep.count);
        assert_int_equal(met, sweep.trajectory.stools_met);
        for (size_t i = 0; i < n; i++)
            if (by_place(&stems[i], &sweep.stems[i]) != 0 || stems[i].dbh != sweep.stems[i].dbh)
                fail_msg("rock %ju: the stem at %.17g is another", (uintmax_t)rock, stems[i].x);
        for (size_t i = 1; i < n; i++)
            astride += stems[i - 1].x < RELEASE && stems[i].x >= RELEASE && stems[i - 1].stool == stems[i].stool;
    }
    EXPECT(astride, >, 40); /* there were some */
}

/* Rings of 200 shoots with a radius of 30 m: enough around the release to pause drawing. */
TEST(dense_stools_around_a_release)
{
    struct spread met = {0};
    clear_plane(120);
    plant_shoots(plant_belt(10, 110, 500, 60 * sin(M_PI / 200)), 1e5, .3);
    line_scene_release(&plane.line, 60, 1, -1200, 0, 0);
    for (SWEEP(rock, 300)) {
        size_t n = 0;
        for (size_t i = 0; i < sweep.count; i++)
            n += sweep.stems[i].x > 52; /* all their stools stand in the belt */
        spread_add(&met, (double)n / 8);
    }
    expect_mean("per metre behind the release", &met, per_metre(1e5, B + .3));
}

/* Far ahead and back: many other stools lie between the two hits of a stool at the release. */
TEST(a_stool_at_the_release_stays_one_after_a_long_trajectory)
{
    uint64_t wrong = 0, rocks = 2000;
    clear_court(AHEAD_AND_BACK);
    plant_plot(1, RELEASE - 6, RELEASE + 145);
    for (SWEEP(rock, rocks))
        wrong += sweep.trajectory.stools_met != count_different(false);
    if (wrong > 0)
        fail_msg("%ju of %ju rocks count a stool twice", (uintmax_t)wrong, (uintmax_t)rocks);
}
