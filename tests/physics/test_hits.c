/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A single hit: a rock that flies over a stem does not hit it. Each stem takes energy by its own diameter, so that the mean of
 * many is the value given for the mean diameter. */
#include "ceduo/simulate.h"
#include "expect.h"

#include <math.h>

#include "line_scene.h"

#define STEMS_MAX 8192
#define WORK      1e5 /* J/m3 */

/* Level ground, one belt of one kind of stem. */
static struct line_scene scene;
static struct ceduo_stems kind;
static struct ceduo_belt belt;

static void plant(double metres, double radius, bool shoots)
{
    const double x[] = {0, metres}, z[] = {0, 0};
    line_scene_init(&scene, 2, x, z, (struct line_ground){.3, .8, .3}, radius, CEDUO_LAW_LUMPED);
    kind = (struct ceduo_stems){.per_ha = 4000, .dbh = .25, .height = 90, .volume = .4, .age = NAN};
    belt = (struct ceduo_belt){.from = 10, .to = metres - 10, .stand = {.species = -1, .u = WORK}};
    if (shoots) {
        belt.stand.stools_per_ha = 1000;
        belt.stand.spacing = .4;
        belt.stand.shoots_count = 1;
        belt.stand.shoots = &kind;
    } else {
        belt.stand.trees_count = 1;
        belt.stand.trees = &kind;
    }
    scene.option = (struct ceduo_option){.belts_count = 1, .belts = &belt};
}

static struct passed {
    size_t count;
    struct ceduo_stem_encounter stems[STEMS_MAX];
    struct ceduo_trajectory trajectory;
} passed;

static void note_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    struct passed *to = context;
    EXPECT(to->count, <, STEMS_MAX);
    to->stems[to->count++] = *stem;
}

static void follow(uint64_t rock)
{
    const struct ceduo_trajectory_callbacks watch = {.stem = note_stem, .context = &passed};
    passed.count = 0;
    assert_int_equal(ceduo_trajectory_run(&scene.scene, &scene.option, rock, &watch, &passed.trajectory, NULL), CEDUO_OK);
}

/* ---- diameters ---- */

/* With brauner a stem of diameter d, in a law of mean m and deviation s, takes V·U·d2/(m2 + s2): the mean of d2 by the gamma
 * law of shape (m/s)2 and scale s2/m is shape(shape + 1)scale2 = m2 + s2. Rocks meet a stem with probability proportional to B
 * + d: with the inverse weight the hit stems have the forest's law and take V·U on average. */
static void expect_mean_of_all_stems(bool shoots)
{
    const double radius = 1.5, sd = .1, given = .4 * WORK;
    double n = 0, sum = 0, squares = 0;
    plant(520, radius, shoots);
    kind.dbh_sd = sd;
    line_scene_release(&scene, 0, 1, 700, 0, 0);
    for (uint64_t rock = 0; rock < 200; rock++) {
        follow(rock);
        for (size_t i = 0; i < passed.count; i++) {
            const struct ceduo_stem_encounter *s = &passed.stems[i];
            double wanted = given * s->dbh * s->dbh / (.25 * .25 + sd * sd);
            assert_true(s->hit);
            EXPECT(s->shoot, ==, shoots);
            if (!(fabs(s->taken - wanted) <= 1e-12 * wanted))
                fail_msg("a stem of %g m takes %.17g J, not %.17g", s->dbh, s->taken, wanted);
            double off = (s->taken - given) / (2 * radius + s->dbh);
            n++;
            sum += off;
            squares += off * off;
        }
    }
    double mean = sum / n, se = sqrt((squares / n - mean * mean) / n);
    double one_percent = .01 * given / (2 * radius + .25);
    print_message("# %.0f stems, off by %.3g ± %.2g of V·U\n", n, .01 * mean / one_percent, .01 * se / one_percent);
    ROWS(EXPECT, (n, >, 1e5), (se, <, one_percent), (fabs(mean), <=, 4 * se));
}

TEST(stems_of_many_diameters_take_their_mean_volume)
{
    expect_mean_of_all_stems(false);
    expect_mean_of_all_stems(true);
}

/* ---- heights ---- */

/* Return stem number i of a rock's trajectory if all stems have this height. */
static struct ceduo_stem_encounter find_stem(uint64_t rock, size_t i, double height)
{
    uint64_t hits = 0;
    kind.height = height;
    follow(rock);
    EXPECT(i, <, passed.count);
    for (size_t k = 0; k < passed.count; k++)
        hits += passed.stems[k].hit;
    assert_int_equal(passed.trajectory.stems_hit, hits);
    for (size_t k = 0; k < i; k++) /* the rock falls: it is higher over earlier stems */
        assert_false(passed.stems[k].hit);
    return passed.stems[i];
}

TEST(a_stem_as_high_as_the_rock_flies_is_not_hit)
{
    for (int shoots = 0; shoots < 2; shoots++)
        for (uint64_t rock = 0; rock < 20; rock++) {
            plant(200, .3, shoots);
            line_scene_release(&scene, 0, 30, 40, 0, 0);
            for (size_t i = 0; i < 5; i++) {
                struct ceduo_stem_encounter low = find_stem(rock, i, 1);
                assert_false(low.hit);
                EXPECT(low.clearance, >, 1);
                struct ceduo_stem_encounter at = find_stem(rock, i, low.clearance);
                EXPECT_SAME(at, low, x, clearance);
                EXPECT(at.clearance, ==, at.height);
                assert_false(at.hit);
                EXPECT(at.taken, ==, 0);
                struct ceduo_stem_encounter higher = find_stem(rock, i, nextafter(low.clearance, INFINITY));
                EXPECT_SAME(higher, low, x, clearance);
                assert_true(higher.hit);
                EXPECT(higher.taken, >, 0);
            }
        }
}

/* If stems are hit only below a height, the height is that of the rock's centre: it passes over any stem below it. */
TEST(a_rock_with_a_centre_above_the_stems_hits_none)
{
    const double radius = .3;
    for (uint64_t rock = 0; rock < 20; rock++) {
        plant(200, radius, false);
        line_scene_release(&scene, 0, 30, 40, 0, 0);
        double middle = find_stem(rock, 0, 1).clearance + radius;
        belt.stand.hit_below = middle * (1 - 1e-12);
        assert_false(find_stem(rock, 0, 90).hit);
        belt.stand.hit_below = middle * (1 + 1e-12);
        assert_true(find_stem(rock, 0, 90).hit);
    }
}
