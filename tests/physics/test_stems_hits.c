/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy taken by a hit, stems that a rock flies over, and rocks that stems stop. */
#include "core/runs/run.h"
#include "core/stand/energy.h"
#include "expect.h"
#include "local.h"

#include <math.h>

#include "stems_scene.h"

/* ---- energy of a hit ---- */

static void plant_dorren(double from, double to)
{
    struct ceduo_belt *belt = plant_belt(from, to, 800, .4);
    plant_trees(belt, 1500, .3);
    plant_shoots(belt, 3200, .12);
    belt->stand.energy = CEDUO_ENERGY_MODEL_DORREN;
    belt->stand.fracture_ratio = 1.7;
}

TEST(dorrens_hits_take_the_share_of_their_eccentricity)
{
    struct spread trees = {0}, shoots = {0};
    clear_plane(520);
    plant_dorren(10, 510);
    for (SWEEP(rock, 5000)) {
        assert_int_equal(sweep.trajectory.end, CEDUO_END_LEFT_SLOPE);
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
            double max = 1.7 * 38.7 * pow(100 * s->dbh, 2.31), u = fabs(s->y) / ((B + s->dbh) / 2);
            double share = printed_share(u);
            if (!(fabs(s->taken / max - share) <= 1e-12 * fmax(share, 1e-3)))
                fail_msg("u = %.17g takes %.17g of %.17g", u, s->taken, max);
            spread_add(s->shoot ? &shoots : &trees, s->taken / max);
        }
    }
    double mean = mean_printed_share();
    expect_exact("mean share", ceduo_dorren_mean_share(), mean, 1e-6);
    EXPECT_NEAR(mean, .558, .0005);
    expect_mean("share of trees", &trees, mean);
    expect_mean("share of shoots", &shoots, mean);
    EXPECT(trees.n + shoots.n, >, 1e6);
}

/* If brauner depends on eccentricity, a hit takes the printed share of V U, or all of a rock that has less. */
TEST(hits_off_centre_take_their_share)
{
    const double volume = 1000, u_J_m3 = 1e7; /* far more than a rock has, but at the edge of a stem */
    uint64_t whole = 0, ends[CEDUO_ENDS] = {0};
    clear_plane(520);
    struct ceduo_belt *belt = plant_belt(10, 510, 0, 0);
    plant_trees(belt, 300, .3);
    belt->stand.trees[0].volume = volume;
    belt->stand.energy = CEDUO_ENERGY_MODEL_BRAUNER;
    belt->stand.u = u_J_m3;
    belt->stand.offset = CEDUO_ENERGY_OFFSET_BY_ECCENTRICITY;
    for (SWEEP(rock, 2000)) {
        ends[sweep.trajectory.end]++;
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
            double u = fabs(s->y) / ((B + s->dbh) / 2), cost = printed_share(u) * volume * u_J_m3;
            if (s->hit)
                expect_exact("taken", s->taken, fmin(cost, s->before), 1e-9 * s->before);
            whole += s->hit && cost < s->before;
        }
    }
    EXPECT(whole, >, 100);
    EXPECT(ends[CEDUO_END_STOPPED_BY_STEMS], >, 1000);
}

/* The hit between two trajectory segments, and its effect on the speed. */
struct scaling {
    struct ceduo_trajectory_segment last;
    double left; /* share of the energy left by the previous hit; NaN: none */
    uint64_t hits, checked;
    double radius, mass, moment;
    bool spins;
};

static double last_spin(const struct scaling *s)
{
    return !s->last.rolls ? s->last.spin : s->spins ? s->last.vx1 / s->radius : 0;
}

static void after_hit(void *context, const struct ceduo_trajectory_segment *p)
{
    struct scaling *s = context;
    if (!isnan(s->left)) {
        double before = s->last.vx1 * s->last.vx1 + s->last.vz1 * s->last.vz1, after = p->vx * p->vx + p->vz * p->vz;
        expect_exact("v2 behind a stem", after / before, s->left, 1e-12);
        if (s->spins)
            expect_exact("spin2 behind a stem", p->spin * p->spin / (last_spin(s) * last_spin(s)), s->left, 1e-12);
        if (fabs(p->vz * s->last.vx1 - s->last.vz1 * p->vx) > 1e-12 * before)
            fail_msg("a stem turned the rock");
        s->checked++;
    }
    s->left = NAN;
    s->last = *p;
}

static void at_hit(void *context, const struct ceduo_stem_encounter *stem)
{
    struct scaling *s = context;
    double v2 = s->last.vx1 * s->last.vx1 + s->last.vz1 * s->last.vz1;
    expect_exact("energy before", stem->before, (s->mass * v2 + s->moment * last_spin(s) * last_spin(s)) / 2, 1e-12);
    assert_true(stem->hit);
    ROWS(EXPECT, (stem->taken, >=, 0), (stem->taken, <=, stem->before), (stem->x, ==, s->last.x1));
    s->left = 1 - stem->taken / stem->before;
    s->hits++;
}

TEST(a_hit_scales_speed_and_spin_with_the_remaining_energy)
{
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
                sweep_rock(0); /* sets the rock's mass */
            s.radius = sweep.trajectory.rock.radius;
            s.mass = sweep.trajectory.rock.mass;
            s.moment = spins ? sweep.trajectory.rock.moment : 0;
            s.left = NAN;
            sweep_watched(rock, &(struct ceduo_trajectory_callbacks){.segment = after_hit, .stem = at_hit, .context = &s});
            stopped += sweep.trajectory.end == CEDUO_END_STOPPED_BY_STEMS;
        }
        sweep_end();
        ROWS(EXPECT, (s.hits, >, 10000), (s.checked, >=, s.hits - 2000), (stopped, >, 100));
        assert_int_equal(s.hits - s.checked, stopped);
    }
}

/* Level ground, dorren's stems and one control. */
static void set_crossing(double x, bool rolls)
{
    clear_plane(400);
    plant_dorren(10, 400);
    line_scene_release(&plane.line, 0, rolls ? 0 : 30, 60, 0, 0);
    plane.line.control = (struct ceduo_control){.x = x, .x_given = x, .accepted = NAN, .measured_speed = NAN};
    plane.line.scene.controls_count = 1;
}

TEST(a_control_at_a_stem_is_passed_before_the_hit)
{
    for (uint64_t rock = 0; rock < 400; rock++) {
        bool rolls = rock % 2;
        set_crossing(400, rolls);
        sweep_one(rock);
        for (size_t i = 0; i < sweep.count && i < 4; i++) {
            struct ceduo_stem_encounter stem = sweep.stems[i];
            struct ceduo_trajectory trajectory;
            struct ceduo_crossing c;
            set_crossing(stem.x, rolls);
            assert_int_equal(ceduo_trajectory_run(&plane.line.scene, &plane.line.option, rock, NULL, &trajectory, &c),
                             CEDUO_OK);
            assert_true(c.reached);
            EXPECT(c.stems_hit, ==, i);
            expect_exact("energy at the control", trajectory.rock.mass / 2 * (c.vx * c.vx + c.vz * c.vz), stem.before, 1e-12);
        }
    }
}

/* ---- heights ---- */

TEST(rocks_fly_over_stems_that_are_lower)
{
    static const double heights[] = {4, 12, 25};
    const double fall = 30, v = 40, g = CEDUO_GRAVITY;
    struct spread come_to = {0}, hit = {0};
    clear_plane(400);
    line_scene_release(&plane.line, 0, fall, v, 0, 0);
    plane.line.segments[0].rn = ceduo_number(0); /* dead ground: the rock rolls after its landing */
    struct ceduo_belt *belt = plant_belt(0, 400, 1000, .4);
    plant_shoots(belt, 4000, .05)->height = heights[0];
    plant_trees(belt, 1500, .2)->height = heights[1];
    plant_trees(belt, 500, .4)->height = heights[2];
    double expected = 0, landing = v * sqrt(2 * fall / g);
    static const double per_ha[] = {4000, 1500, 500}, dbh[] = {.05, .2, .4};
    for (size_t i = 0; i < LENGTH(heights); i++)
        expected += per_metre(per_ha[i], B + dbh[i]) * (400 - v * sqrt(2 * (fall - heights[i]) / g));
    for (SWEEP(rock, 6000)) {
        uint64_t hits = 0;
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
            double above = s->x < landing ? fall - g / 2 * (s->x / v) * (s->x / v) : 0;
            if (s->hit != (s->clearance < s->height) || fabs(s->clearance - above) > 1e-9 ||
                (!s->hit && (s->taken != 0 || s->before != 0)))
                fail_msg("at %.17g the rock is %.17g high, not %.17g, a stem of %.3g m hit: %d", s->x, s->clearance, above,
                         s->height, s->hit);
            hits += s->hit;
        }
        if (hits != sweep.trajectory.stems_hit || count_different(false) != sweep.trajectory.stools_met)
            fail_msg("rock %ju: stems flown over are counted", (uintmax_t)rock);
        spread_add(&come_to, (double)sweep.count / 400);
        spread_add(&hit, (double)hits);
    }
    expect_mean("stems come to per metre", &come_to,
                per_metre(4000, B + .05) + per_metre(1500, B + .2) + per_metre(500, B + .4));
    expect_mean("stems hit", &hit, expected);
}

/* Clearance over a broken slope, computed from the trajectory segments. */
#define PIECES_MAX 4096
struct pieces {
    size_t count;
    struct ceduo_trajectory_segment piece[PIECES_MAX];
};

static void note_piece(void *context, const struct ceduo_trajectory_segment *piece)
{
    struct pieces *p = context;
    EXPECT(p->count, <, PIECES_MAX);
    p->piece[p->count++] = *piece;
}

static void stem_beside_pieces(void *context, const struct ceduo_stem_encounter *stem)
{
    (void)context;
    note_stem(&sweep, stem);
}

static double height_above_ground(const struct pieces *p, double x)
{
    size_t i = 0;
    while (i + 1 < p->count && x > p->piece[i].x1)
        i++;
    const struct ceduo_trajectory_segment *f = &p->piece[i];
    EXPECT(x, >=, f->x);
    EXPECT(x, <=, f->x1);
    if (f->rolls)
        return 0;
    double t = (x - f->x) / f->vx, z = f->z + f->vz * t - CEDUO_GRAVITY / 2 * t * t;
    return z - ceduo_slope_height(&plane.line.scene.slope, x);
}

TEST(a_stem_is_hit_if_the_rock_is_lower_over_a_broken_slope)
{
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
        sweep_watched(
            rock, &(struct ceduo_trajectory_callbacks){.segment = note_piece, .stem = stem_beside_pieces, .context = &pieces});
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *s = &sweep.stems[i];
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

/* ---- rocks that stems stop ---- */

/* Law of the first point of a Poisson process on `length` after `from`. */
struct first_stem {
    double from, length, rate;
};

static double first_stem_cdf(double x, const void *context)
{
    const struct first_stem *f = context;
    return expm1(-f->rate * (x - f->from)) / expm1(-f->rate * f->length);
}

static void expect_run_stopped(const struct sample *stops, uint64_t rocks)
{
    LOCAL(ceduo_run, run) = run_option(&plane.line.scene, &plane.line.option, rocks, 2);
    struct ceduo_ends ends = read_ends(run);
    ROWS(assert_int_equal, (ends.count[CEDUO_END_STOPPED_BY_STEMS], stops->n),
         (ends.count[CEDUO_END_LEFT_SLOPE], rocks - stops->n), (ends.stop_x.n, stops->n));
    double sum = 0;
    for (size_t i = 0; i < stops->n; i++)
        sum += stops->values[i];
    expect_exact("mean place of the stopped", ends.stop_x.mean, sum / (double)stops->n, 1e-12);
    EXPECT(ends.stop_max, ==, stops->values[stops->n - 1]); /* they are sorted */
    EXPECT(ends.stop_p50, ==, stops->values[(stops->n + 1) / 2 - 1]);
    struct ceduo_stem_counts counts = ceduo_run_stems(run);
    EXPECT_IS(counts, (hit, stops->n), (met, stops->n));
    EXPECT(counts.drawn, >=, counts.hit);
}

static void expect_stopped(const char *name, uint64_t rocks)
{
    struct sample stops = {0};
    struct first_stem law = {10, 500, per_metre(30, B + .2)};
    for (SWEEP(rock, rocks)) {
        if (sweep.count == 0) {
            assert_int_equal(sweep.trajectory.end, CEDUO_END_LEFT_SLOPE);
            continue;
        }
        const struct ceduo_stem_encounter *s = sweep.stems;
        if (sweep.count != 1 || sweep.trajectory.end != CEDUO_END_STOPPED_BY_STEMS || sweep.trajectory.x != s->x ||
            s->taken != s->before)
            fail_msg("%s: rock %ju is not stopped at %.17g", name, (uintmax_t)rock, s->x);
        sample_add(&stops, sweep.trajectory.x);
    }
    expect_share(named("%s, share stopped by stems", name), stops.n, rocks, -expm1(-law.rate * law.length));
    expect_law(named("%s, places, KS", name), stops.values, stops.n, first_stem_cdf, &law);
    expect_run_stopped(&stops, rocks);
    sample_clear(&stops);
}

TEST(rocks_stop_at_their_stem)
{
    for (int i = 0; i < 2; i++) {
        static const char *const names[] = {"in flight", "rolling"};
        clear_plane(520);
        plane.line.scene.simulation.seed = (uint64_t)i + 1;
        struct ceduo_belt *belt = plant_belt(10, 510, 0, 0);
        belt->stand.u = 1e7;
        plant_trees(belt, 30, .2)->volume = 1000;
        if (i == 1)
            line_scene_release(&plane.line, 0, 0, 5000, 0, 0);
        expect_stopped(names[i], i == 1 ? 10000 : 100000);
    }
}
