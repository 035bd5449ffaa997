/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles simplified to a tolerance, and the angles from a place to the release. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "core/runs/assess.h"
#include "expect.h"
#include "scene/slope.h"

#define POINTS_MAX 400

/* A profile with one ground, or with two that meet at a point. Contains pointers into itself: never copy it. */
struct profile {
    struct ceduo_slope slope;
    double x[POINTS_MAX], z[POINTS_MAX];
    struct ceduo_segment segments[POINTS_MAX];
};

static struct ceduo_segment ground(double rn)
{
    struct ceduo_segment s = ceduo_segment_default();
    s.rn = ceduo_number(rn);
    s.rt = ceduo_number(.8);
    s.roughness_rad = .1;
    return s;
}

static void profile_make(struct profile *p, size_t n, const double (*points)[2], double tolerance)
{
    memset(p, 0, sizeof *p);
    for (size_t i = 0; i < n; i++) {
        p->x[i] = points[i][0];
        p->z[i] = points[i][1];
        p->segments[i] = ground(.3);
    }
    p->slope = (struct ceduo_slope){
        .vertices = n, .x = p->x, .z = p->z, .segments = p->segments, .segments_given = 1, .tolerance = tolerance};
}

static void simplify(const struct profile *p, double release_x, struct ceduo_slope *to)
{
    assert_int_equal(ceduo_slope_simplify(&p->slope, release_x, to), CEDUO_OK);
}

static bool has_vertex(const struct ceduo_slope *s, double x)
{
    for (size_t i = 0; i < s->vertices; i++)
        if (s->x[i] == x)
            return true;
    return false;
}

/* ---- simplification ---- */

TEST(all_points_are_used_without_a_tolerance)
{
    static const double points[][2] = {{0, 10}, {1, 9.01}, {2, 8}, {3, 7.01}};
    struct profile p;
    struct ceduo_slope to;
    profile_make(&p, LENGTH(points), points, 0);
    simplify(&p, 0, &to);
    assert_null(to.x);
    ceduo_slope_simplified_release(&to);
}

/* By hand: the point at 5 m is .4/sqrt(2) m off the line from 0 to 10 m; the one at 15 m is 1 m below the line from 10 to 20
 * m. */
TEST(a_point_within_the_tolerance_is_dropped)
{
    static const double points[][2] = {{0, 20}, {5, 15.4}, {10, 10}, {15, 9}, {20, 10}};
    static const double expected[][2] = {{0, 20}, {10, 10}, {15, 9}, {20, 10}};
    struct profile p;
    struct ceduo_slope to;
    profile_make(&p, LENGTH(points), points, .5);
    simplify(&p, 0, &to);
    assert_int_equal(to.vertices, LENGTH(expected));
    for (size_t i = 0; i < LENGTH(expected); i++) {
        EXPECT(to.x[i], ==, expected[i][0]);
        EXPECT(to.z[i], ==, expected[i][1]);
    }
    ceduo_slope_simplified_release(&to);
    p.slope.tolerance = .28; /* below .4/sqrt(2) = .2828 */
    simplify(&p, 0, &to);
    assert_int_equal(to.vertices, LENGTH(points));
    ceduo_slope_simplified_release(&to);
}

TEST(release_and_borders_of_grounds_stay)
{
    static const double points[][2] = {{0, 100}, {10, 90}, {20, 80}, {30, 70}, {40, 60}};
    struct profile p;
    struct ceduo_slope to;
    profile_make(&p, LENGTH(points), points, .5);
    p.segments[2] = p.segments[3] = ground(.4); /* from 20 m on */
    simplify(&p, 12.5, &to);
    assert_int_equal(to.vertices, 4);
    assert_true(has_vertex(&to, 12.5));
    assert_true(has_vertex(&to, 20));
    EXPECT(to.z[1], ==, 87.5);
    EXPECT(to.segments[0].rn.mean, ==, .3);
    EXPECT(to.segments[1].rn.mean, ==, .3);
    EXPECT(to.segments[2].rn.mean, ==, .4);
    ceduo_slope_simplified_release(&to);
}

/* A release at a vertex adds no vertex. */
TEST(a_release_at_a_vertex_keeps_it)
{
    static const double points[][2] = {{0, 100}, {10, 90}, {20, 80}, {30, 70}};
    for (size_t i = 0; i < LENGTH(points); i++) {
        struct profile p;
        struct ceduo_slope to;
        profile_make(&p, LENGTH(points), points, .5);
        simplify(&p, points[i][0], &to);
        EXPECT(to.vertices, ==, i == 0 || i + 1 == LENGTH(points) ? 2 : 3);
        assert_true(has_vertex(&to, points[i][0]));
        ceduo_slope_simplified_release(&to);
    }
}

/* Without a tolerance a simplified profile has all its original points again. */
TEST(without_a_tolerance_all_points_return)
{
    static const double points[][2] = {{0, 100}, {10, 90}, {20, 80}, {30, 70}};
    struct profile p;
    struct ceduo_slope to, again;
    profile_make(&p, LENGTH(points), points, .5);
    p.slope.points = p.slope.vertices;
    p.slope.points_x = p.slope.x;
    p.slope.points_z = p.slope.z;
    simplify(&p, 0, &to);
    EXPECT(to.vertices, ==, 2);
    to.tolerance = 0;
    assert_int_equal(ceduo_slope_simplify(&to, 0, &again), CEDUO_OK);
    EXPECT(again.vertices, ==, LENGTH(points));
    EXPECT(again.simplified_to, ==, 0);
    for (size_t i = 0; i < LENGTH(points); i++) {
        EXPECT(again.x[i], ==, points[i][0]);
        EXPECT(again.z[i], ==, points[i][1]);
    }
    ceduo_slope_simplified_release(&to);
    ceduo_slope_simplified_release(&again);
}

/* A linear congruential generator of 31 bits. */
static double draw(unsigned *state)
{
    *state = (*state * 1103515245u + 12345u) & 0x7fffffff;
    return *state / 2147483648.0;
}

static void profile_rough(struct profile *p, unsigned seed, double tolerance)
{
    double points[POINTS_MAX][2];
    size_t n = 20 + (size_t)(draw(&seed) * 300);
    double x = 0;
    for (size_t i = 0; i < n; i++) {
        points[i][0] = x;
        points[i][1] = 300 - .7 * x + 20 * sin(x / 30) + .6 * (draw(&seed) - .5);
        x += .2 + draw(&seed);
    }
    profile_make(p, n, (const double(*)[2])points, tolerance);
    size_t border = n / 3;
    for (size_t j = border; j < n; j++)
        p->segments[j] = ground(.4);
}

/* Return the distance of a point from the line through the ends of segment j. */
static double distance_from_line(const struct ceduo_slope *s, size_t j, double x, double z)
{
    double dx = s->x[j + 1] - s->x[j], dz = s->z[j + 1] - s->z[j];
    return fabs((z - s->z[j]) * dx - (x - s->x[j]) * dz) / hypot(dx, dz);
}

/* On 200 rough profiles no point is beyond the tolerance, each kept point is of the profile or the release, a larger tolerance
 * leaves fewer points, and simplifying twice changes nothing. */
TEST(no_point_is_farther_than_the_tolerance)
{
    static const double tolerances[] = {.1, .25, .5, 1};
    static struct profile p;
    for (unsigned seed = 1; seed <= 200; seed++) {
        size_t before = SIZE_MAX;
        for (size_t t = 0; t < LENGTH(tolerances); t++) {
            struct ceduo_slope to, again;
            profile_rough(&p, seed, tolerances[t]);
            double release = .37 * p.x[p.slope.vertices - 1];
            simplify(&p, release, &to);
            assert_non_null(to.x);
            for (size_t i = 0, j = 0; i < p.slope.vertices; i++) {
                while (p.x[i] > to.x[j + 1])
                    j++;
                EXPECT(distance_from_line(&to, j, p.x[i], p.z[i]), <=, tolerances[t] * (1 + 1e-9));
            }
            for (size_t k = 0, i = 0; k < to.vertices; k++) {
                while (p.x[i] < to.x[k])
                    i++;
                assert_true((p.x[i] == to.x[k] && p.z[i] == to.z[k]) || to.x[k] == release);
            }
            assert_true(has_vertex(&to, release));
            EXPECT(to.vertices, <=, before);
            before = to.vertices;
            assert_int_equal(ceduo_slope_simplify(&to, release, &again), CEDUO_OK);
            assert_null(again.x);
            ceduo_slope_simplified_release(&again);
            ceduo_slope_simplified_release(&to);
        }
        EXPECT(before, <, p.slope.vertices / 2);
    }
}

/* With another tolerance a profile is simplified from all its original points. */
TEST(another_tolerance_begins_with_all_points)
{
    static struct profile p;
    struct ceduo_slope coarse, fine, direct;
    profile_rough(&p, 7, 1);
    p.slope.points = p.slope.vertices;
    p.slope.points_x = p.x;
    p.slope.points_z = p.z;
    simplify(&p, 5, &coarse);
    coarse.tolerance = p.slope.tolerance = .25;
    assert_int_equal(ceduo_slope_simplify(&coarse, 5, &fine), CEDUO_OK);
    simplify(&p, 5, &direct);
    assert_int_equal(fine.vertices, direct.vertices);
    assert_memory_equal(fine.x, direct.x, fine.vertices * sizeof *fine.x);
    assert_memory_equal(fine.z, direct.z, fine.vertices * sizeof *fine.z);
    for (size_t j = 0; j + 1 < fine.vertices; j++)
        assert_true(ceduo_segment_same(&fine.segments[j], &direct.segments[j]));
    ceduo_slope_simplified_release(&direct);
    ceduo_slope_simplified_release(&fine);
    ceduo_slope_simplified_release(&coarse);
}

/* ---- topography ---- */

#define DEGREES (180 / M_PI)

/* A face of 63 degrees to (20, 60), talus to (80, 20), a bench of 12 m, and falling ground. */
static const double below_a_face[][2] = {{0, 100}, {20, 60}, {80, 20}, {92, 18}, {110, 8}};

TEST(angles_below_a_face)
{
    struct profile p;
    profile_make(&p, LENGTH(below_a_face), below_a_face, 0);
    struct ceduo_topography t = ceduo_slope_topography(&p.slope, 0, 0, 110);
    EXPECT_NEAR(t.reach * DEGREES, atan(92.0 / 110) * DEGREES, 1e-9);
    EXPECT_NEAR(t.shadow * DEGREES, atan(52.0 / 90) * DEGREES, 1e-9);
    EXPECT(t.foot, ==, 20);
    EXPECT(t.bench, ==, 12);
    t = ceduo_slope_topography(&p.slope, 10, 3, 86); /* from within the face, 3 m up, to the centre of the bench */
    EXPECT_NEAR(t.reach * DEGREES, atan(64.0 / 76) * DEGREES, 1e-9);
    EXPECT_NEAR(t.shadow * DEGREES, atan(41.0 / 66) * DEGREES, 1e-9);
    EXPECT(t.bench, ==, 6);
}

TEST(without_a_face_there_is_no_shadow)
{
    static const double talus[][2] = {{0, 80}, {100, 0}}, step[][2] = {{0, 50}, {40, 22}, {40.5, 18}, {100, -20}};
    struct profile p;
    profile_make(&p, LENGTH(talus), talus, 0);
    assert_true(isnan(ceduo_slope_topography(&p.slope, 0, 0, 100).shadow));
    profile_make(&p, LENGTH(step), step, 0); /* 4 m high: shorter than a face, though steep */
    assert_true(isnan(ceduo_slope_topography(&p.slope, 0, 0, 100).shadow));
    profile_make(&p, LENGTH(below_a_face), below_a_face, 0); /* the release is below the face */
    assert_true(isnan(ceduo_slope_topography(&p.slope, 25, 0, 110).shadow));
}

/* The smallest number is the distance of two points, so that the slope between them is infinite. */
TEST(a_segment_may_be_too_short_for_its_slope)
{
    static const double points[][2] = {{0, 1}, {5e-324, 0}};
    struct profile p;
    profile_make(&p, LENGTH(points), points, 0);
    EXPECT(ceduo_slope_topography(&p.slope, 0, 0, 5e-324).reach, ==, M_PI_2);
}

/* Two faces: the angle starts at the lower one. A ditch counts as level. */
TEST(the_lowest_face_counts)
{
    static const double points[][2] = {{0, 100}, {10, 80}, {60, 50}, {66, 38}, {70, 36}, {78, 37}, {120, 10}};
    struct profile p;
    profile_make(&p, LENGTH(points), points, 0);
    struct ceduo_topography t = ceduo_slope_topography(&p.slope, 0, 0, 120);
    EXPECT(t.foot, ==, 66);
    EXPECT_NEAR(t.shadow * DEGREES, atan(28.0 / 54) * DEGREES, 1e-9);
    EXPECT(t.bench, ==, 8); /* 66 to 70 m falls by 27 degrees */
}

/* ---- arrivals and topography ---- */

static enum ceduo_terrain terrain(double reach, double shadow, double bench, uint64_t released, uint64_t reached,
                                  uint64_t unfinished)
{
    const struct ceduo_arrivals a = {.released = released,
                                     .reached = reached,
                                     .unfinished = unfinished,
                                     .topography = {reach / DEGREES, shadow / DEGREES, 0, bench}};
    enum ceduo_terrain t = ceduo_terrain(&a);
    if (t == CEDUO_TERRAIN_CONTRADICTS)
        assert_true(ceduo_too_few_arrivals(&a));
    else
        assert_int_equal(ceduo_too_few_arrivals(&a), released > 0 && reached + unfinished == 0);
    return t;
}

TEST(few_rocks_at_a_steep_place_contradict_the_terrain)
{
    static const struct {
        double reach, shadow, bench;
        uint64_t released, reached, unfinished;
        enum ceduo_terrain wanted;
    } rows[] = {
        {37, NAN, 0, 1000, 9, 0, CEDUO_TERRAIN_CONTRADICTS}, {37, NAN, 0, 1000, 10, 0, CEDUO_TERRAIN_AGREES},
        {34.9, NAN, 0, 1000, 4, 0, CEDUO_TERRAIN_AGREES},    {34, 32.1, 0, 1000, 4, 0, CEDUO_TERRAIN_CONTRADICTS},
        {34, 31.9, 0, 1000, 4, 0, CEDUO_TERRAIN_AGREES},     {37, 35, 9.9, 1000, 4, 0, CEDUO_TERRAIN_CONTRADICTS},
        {37, 35, 10, 1000, 4, 0, CEDUO_TERRAIN_BENCH},       {37, NAN, 0, 1000, 4, 6, CEDUO_TERRAIN_AGREES},
        {37, NAN, 0, 0, 0, 0, CEDUO_TERRAIN_AGREES},         {30, 23.9, 0, 1000, 101, 0, CEDUO_TERRAIN_FAR},
        {30, 23.9, 0, 1000, 100, 0, CEDUO_TERRAIN_AGREES},   {30, 24.1, 0, 1000, 900, 0, CEDUO_TERRAIN_AGREES},
        {60, 3, 0, 1000, 900, 0, CEDUO_TERRAIN_AGREES}, /* just below the face */
        {30, NAN, 0, 1000, 900, 0, CEDUO_TERRAIN_AGREES},    {37, NAN, 0, 200, 1, 0, CEDUO_TERRAIN_CONTRADICTS},
    };
    for (size_t i = 0; i < LENGTH(rows); i++)
        if (terrain(rows[i].reach, rows[i].shadow, rows[i].bench, rows[i].released, rows[i].reached, rows[i].unfinished) !=
            rows[i].wanted)
            fail_msg("row %zu", i);
}
