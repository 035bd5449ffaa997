/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trajectories and statistics with results in closed form or in published tables. */
#include "ceduo/simulate.h"
#include "core/runs/statistics.h"
#include "scene/rock.h"
#include "table.h"

#include <math.h>
#include <stdlib.h>

#include "bench/measure.h"
#include "line_scene.h"
#include "paper_site.h"

#define G CEDUO_GRAVITY

static struct line_scene scene;
static struct line_trace trace, second;

static void follow(void)
{
    assert_int_equal(ceduo_scene_check(&scene.scene, NULL), CEDUO_OK);
    assert_int_equal(line_scene_follow(&scene, &trace), CEDUO_OK);
}

static void release(double x, double height, double vx, double vz, double spin)
{
    line_scene_release(&scene, x, height, vx, vz, spin);
    follow();
}

/* One straight slope from x = 0 to 1000 that rises by `rise` per metre. */
static void straight(double rise, struct line_ground ground, double radius, enum ceduo_law law)
{
    const double x[] = {0, 1000}, z[] = {0, 1000 * rise};
    line_scene_init(&scene, 2, x, z, ground, radius, law);
}

/* Use the published laws, which have no friction bound, and CRSP's rolling. */
static void publish(void)
{
    scene.scene.simulation.friction_bound = false;
}

/* ---- flight ---- */

TEST(free_fall)
{
    straight(0, (struct line_ground){.5, .5, .5}, .1, CEDUO_LAW_LUMPED);
    release(500, 20, 0, 0, 0);
    const struct ceduo_trajectory_segment *p = &trace.pieces[0];
    expect_relative(p->seconds, sqrt(2 * 20 / G), 1e-15);
    expect_relative(p->vz1, -sqrt(2 * G * 20), 1e-15);
    EXPECT_IS(*p, (x1, 500), (z1, 0), (vx1, 0));
}

TEST(projectiles_on_a_slope)
{
    static const double rises[] = {0, -.5, .5, -3, 2};
    for (size_t i = 0; i < LENGTH(rises); i++) {
        straight(rises[i], (struct line_ground){.5, .5, .5}, .1, CEDUO_LAW_LUMPED);
        release(500, 5, -4, 3, 0);
        double b = 3 + 4 * rises[i], t = (b + sqrt(b * b + 2 * G * 5)) / G; /* 5 + b t = g t2/2 */
        const struct ceduo_trajectory_segment *p = &trace.pieces[0];
        ROWS(expect_relative, (p->seconds, t, 1e-12), (p->x1, 500 - 4 * t, 1e-12), (p->z1, rises[i] * (500 - 4 * t), 1e-12),
             (p->vz1, 3 - G * t, 1e-12));
    }
}

TEST(a_control_sees_the_flight_over_it)
{
    straight(-.5, (struct line_ground){.5, .5, .5}, .1, CEDUO_LAW_LUMPED);
    line_scene_release(&scene, 0, 50, 10, 0, 0);
    scene.control.x = 8;
    scene.scene.controls_count = 1;
    follow();
    assert_true(trace.crossing.reached);
    EXPECT(trace.crossing.vx, ==, 10);
    expect_relative(trace.crossing.vz, -G * .8, 1e-15);
    expect_relative(trace.crossing.height, 50 + 4 - G * .32, 1e-14);
    line_scene_release(&scene, 0, 0, -.1, 0, 0); /* leaves the other way */
    assert_int_equal(line_scene_follow(&scene, &trace), CEDUO_OK);
    assert_false(trace.crossing.reached);
    assert_int_equal(trace.trajectory.end, CEDUO_END_LEFT_SLOPE);
}

/* ---- bouncing ---- */

TEST(a_vertical_drop_rebounds_to_rn2_h)
{
    const double rn = .75, radius = .1;
    straight(0, (struct line_ground){rn, .5, .5}, radius, CEDUO_LAW_LUMPED);
    release(500, 10, 0, 0, 0);
    double h = 10;
    size_t i = 1;
    while ((h *= rn * rn) > radius) {
        EXPECT(i, <, trace.count);
        const struct ceduo_trajectory_segment *p = &trace.pieces[i++];
        assert_false(p->rolls);
        expect_relative(p->vz * p->vz / (2 * G), h, 1e-13);
    }
    assert_int_equal(i, trace.count); /* the next bounce is lower than R */
    assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
    EXPECT_IS(trace.trajectory, (x, 500), (z, 0), (contacts, i));
}

TEST(an_oblique_impact_on_the_flat)
{
    straight(0, (struct line_ground){.5, .5, .5}, .1, CEDUO_LAW_LUMPED);
    release(500, 0, 2, -4, 0);
    const struct ceduo_trajectory_segment *p = &trace.pieces[0];
    assert_false(p->rolls);
    EXPECT_IS(*p, (x, 500), (vx, 1), (vz, 2), (contacts, 1));
    expect_relative(p->x1, 500 + 4 / G, 1e-15);
    release(500, 0, -2, -4, 0);
    EXPECT_IS(trace.pieces[0], (vx, -1), (vz, 2));
}

TEST(a_bounce_without_loss_is_aborted_and_reported)
{
    straight(0, (struct line_ground){1, 1, 0}, .1, CEDUO_LAW_LUMPED);
    release(500, 1, 0, 0, 0);
    EXPECT_IS(trace.trajectory, (end, CEDUO_END_UNFINISHED), (contacts, CEDUO_CONTACTS_MAX), (x, 500));
    straight(0, (struct line_ground){0, 1, 0}, 1e-4, CEDUO_LAW_CRSP); /* rolls, 100 m in 10^6 radii */
    release(500, 0, 1, 0, 1e4);
    EXPECT_IS(trace.trajectory, (end, CEDUO_END_UNFINISHED), (contacts, CEDUO_CONTACTS_MAX));
    expect_relative(trace.trajectory.x, 600, 1e-9);
}

TEST(a_release_that_leaves_the_ground_has_no_contact)
{
    straight(0, (struct line_ground){.5, .5, .5}, .1, CEDUO_LAW_LUMPED);
    release(500, 0, 2, 4, 0);
    const struct ceduo_trajectory_segment *p = &trace.pieces[0];
    EXPECT_IS(*p, (contacts, 0), (vx, 2), (vz, 4));
    EXPECT_IS(p[1], (vx, 1), (contacts, 1));
    expect_relative(p[1].vz, 2, 1e-15);
}

/* ---- rolling ---- */

static void roll_stops(enum ceduo_law law, double k, double v0)
{
    const double mu = .25;
    straight(0, (struct line_ground){.5, 1, mu}, .34, law);
    release(500, 0, v0, 0, v0 / .34);
    expect_relative(fabs(trace.trajectory.x - 500), (1 + k) * v0 * v0 / (2 * G * mu), 1e-12);
    EXPECT((trace.trajectory.x > 500), ==, (v0 > 0));
    assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
    for (size_t i = 0; i < trace.count; i++)
        assert_true(trace.pieces[i].rolls);
    assert_int_equal(trace.trajectory.contacts, ceil(fabs(trace.trajectory.x - 500) / .34)); /* one contact per radius */
}

TEST(a_roll_on_the_flat_stops_by_friction)
{
    roll_stops(CEDUO_LAW_LUMPED, 0, 5);
    roll_stops(CEDUO_LAW_LUMPED, 0, -5);
    roll_stops(CEDUO_LAW_CRSP, .4, 5);
    roll_stops(CEDUO_LAW_CRSP, .4, -5);
}

/* Friction 1/2 and gravity 1 use up speed 1 over exactly 1 m: the rock arrives at a control there without energy. */
TEST(a_roll_stops_just_at_the_control)
{
    for (double radius = 1; radius <= 2; radius++) { /* a roll of one radius: ends at it, or within it */
        straight(0, (struct line_ground){0, 1, .5}, radius, CEDUO_LAW_LUMPED);
        scene.scene.simulation.gravity = 1;
        line_scene_release(&scene, 1, 0, 1, 0, 0);
        scene.control.x = 2;
        scene.scene.controls_count = 1;
        follow();
        assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
        EXPECT(trace.trajectory.x, ==, 2);
        assert_true(trace.crossing.reached);
        EXPECT_IS(trace.crossing, (vx, 0), (vz, 0));
    }
}

static void roll_accelerates(enum ceduo_law law, double k, double rise, double mu)
{
    straight(rise, (struct line_ground){.5, 1, mu}, .34, law);
    release(500, 0, 0, 0, 0);
    double c = 1 / sqrt(1 + rise * rise), a = G * (fabs(rise) - mu) * c / (1 + k);
    assert_int_equal(trace.trajectory.end, CEDUO_END_LEFT_SLOPE);
    EXPECT(trace.trajectory.x, ==, (rise < 0 ? 1000 : 0));
    for (size_t i = 0; i < trace.count; i++) {
        const struct ceduo_trajectory_segment *p = &trace.pieces[i];
        assert_true(p->rolls);
        double ds = hypot(p->x1 - 500, p->z1 - 500 * rise);
        expect_relative(p->vx1 * p->vx1 + p->vz1 * p->vz1, 2 * a * ds, 1e-11);
        if (i > 0 && k > 0)
            expect_relative(p->spin * .34, (rise < 0 ? 1 : -1) * hypot(p->vx, p->vz), 1e-14);
    }
}

/* A sphere without friction accelerates at (5/7) g sin(slope). */
TEST(a_roll_down_a_slope)
{
    roll_accelerates(CEDUO_LAW_CRSP, .4, -.3, 0);
    roll_accelerates(CEDUO_LAW_CRSP, .4, .3, 0);
    roll_accelerates(CEDUO_LAW_CRSP, .4, -1.5, .25);
    roll_accelerates(CEDUO_LAW_LUMPED, 0, -.3, 0);
    roll_accelerates(CEDUO_LAW_LUMPED, 0, 1.5, .25);
}

TEST(spin_and_speed_share_their_momentum_in_a_roll)
{
    straight(0, (struct line_ground){0, 1, .5}, .5, CEDUO_LAW_CRSP);
    release(500, 0, 0, 0, 8); /* a spinning sphere put on the ground */
    /* f = 1, SF = 1 at Rt = 1: the energy of the spin becomes that of a roll */
    expect_relative(trace.pieces[0].vx, sqrt(.4 * 16 / 1.4), 1e-15);
    expect_relative(trace.pieces[0].spin * .5, trace.pieces[0].vx, 1e-15);
}

/* In a roll Vn is 0 and there is no slip: each contact leaves Rt·f of the energy, f = Rt + (1 - Rt)/1.2, for any Rn. */
TEST(a_contact_in_a_roll_costs_the_same_for_any_rn)
{
    static const double shares[] = {0, 1e-12, .3, 1};
    const double rt = .9;
    for (size_t i = 0; i < LENGTH(shares); i++)
        for (int slope = 0; slope < 60; slope++) {
            straight(-.025 * slope, (struct line_ground){shares[i], rt, 0}, .34, CEDUO_LAW_CRSP);
            publish();
            release(1, 0, 3, -.025 * slope * 3, 3 / .34 * sqrt(1 + pow(.025 * slope, 2)));
            for (size_t j = 1; j < trace.count && j < 40; j++) {
                const struct ceduo_trajectory_segment *before = &trace.pieces[j - 1], *p = &trace.pieces[j];
                double u2 = before->vx1 * before->vx1 + before->vz1 * before->vz1;
                assert_true(p->rolls);
                expect_relative(p->vx * p->vx + p->vz * p->vz, rt * (rt + (1 - rt) / 1.2) * u2, 1e-9);
            }
            EXPECT(trace.count, >=, 40);
        }
}

/* Rt = 0 leaves no speed along the ground: each roll starts downhill from 0, one contact per radius. */
TEST(without_tangential_restitution_each_roll_begins_downhill)
{
    for (int slope = 1; slope < 60; slope++)
        for (int dir = -1; dir <= 1; dir += 2) {
            straight(.025 * slope * dir, (struct line_ground){.3, 0, 0}, 1, CEDUO_LAW_LUMPED);
            publish();
            release(500, 0, 1, -1 - .025 * slope, 0);
            for (size_t j = 0; j < trace.count; j++) {
                assert_true(trace.pieces[j].rolls);
                EXPECT(dir * trace.pieces[j].vx, <=, 0);
                EXPECT(dir * trace.pieces[j].vx1, <, 0);
            }
            double radii = 500 * sqrt(1 + pow(.025 * slope, 2));
            EXPECT_NEAR((double)trace.trajectory.contacts, radii, 1 + 1e-9);
        }
}

TEST(a_concave_vertex_takes_the_part_into_the_ground)
{
    const double x[] = {0, 1, 9}, z[] = {0, 0, 6}; /* cosine 4/5 */
    line_scene_init(&scene, 3, x, z, (struct line_ground){0, 1, 0}, 1.5, CEDUO_LAW_LUMPED);
    release(.5, 0, 2, 0, 0);
    EXPECT_IS(trace.pieces[0], (vx1, 2), (x1, 1));
    expect_relative(hypot(trace.pieces[1].vx, trace.pieces[1].vz), 1.6, 1e-15);
    expect_relative(trace.pieces[1].vz / trace.pieces[1].vx, .75, 1e-15);
}

TEST(a_rock_rolls_or_flies_over_a_convex_vertex)
{
    const double x[] = {0, 10, 20}, z[] = {0, 0, -5};
    for (int fast = 0; fast <= 1; fast++) {
        line_scene_init(&scene, 3, x, z, (struct line_ground){0, 1, 0}, .5, CEDUO_LAW_LUMPED);
        release(9.9, 0, fast ? 3 : .3, 0, 0);
        assert_true(trace.pieces[0].rolls);
        EXPECT(trace.pieces[0].x1, ==, 10);
        EXPECT_IS(trace.pieces[1], (rolls, !fast), (x, 10));
        double v = hypot(trace.pieces[1].vx, trace.pieces[1].vz); /* no energy is lost */
        expect_relative(v, fast ? 3 : .3, 1e-15);
        if (fast) /* z = -g t2/2 meets z = -x/2 */
            expect_relative(trace.pieces[1].x1, 10 + 3 * 3 / G, 1e-14);
    }
}

/* ---- resting ---- */

TEST(a_resting_rock_starts_if_the_slope_exceeds_friction)
{
    for (int dir = -1; dir <= 1; dir += 2)
        for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
            straight(.3 * dir, (struct line_ground){.5, .5, .31}, .34, (enum ceduo_law)law);
            release(500, 0, 0, 0, 0);
            EXPECT_IS(trace.trajectory, (end, CEDUO_END_AT_REST), (x, 500), (contacts, 1));
            straight(.3 * dir, (struct line_ground){.5, .5, .29}, .34, (enum ceduo_law)law);
            release(500, 0, 0, 0, 0);
            EXPECT_IS(trace.trajectory, (end, CEDUO_END_LEFT_SLOPE), (x, (dir < 0 ? 1000 : 0)));
        }
}

static void released_in_a_pit(double radius, double level, double beyond, bool stays)
{
    const double x[] = {0, 2, 2 + level, 4 + level, 10}, z[] = {0, -1, -1, -1 + beyond, -1 + beyond};
    line_scene_init(&scene, LENGTH(x), x, z, (struct line_ground){.2, .5, .2}, radius, CEDUO_LAW_LUMPED);
    release(1.8, 0, 0, 0, 0);
    assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
    EXPECT((fabs(trace.trajectory.x - 1.8) < 1e-15), ==, stays);
}

TEST(a_rock_rests_in_a_pit_within_its_radius)
{
    const double bottom = hypot(.2, .1);
    released_in_a_pit(bottom * 1.01, .001, 1, true);
    released_in_a_pit(bottom * .99, .001, 1, false);
    released_in_a_pit(.5, .49, 1, true);
    released_in_a_pit(.5, .51, 1, false);                          /* a level stretch of at least R is no pit */
    const double x[] = {0, 2, 4, 10}, z[] = {0, -1, -1 + .08, -5}; /* the far side is lower than the rock */
    line_scene_init(&scene, 4, x, z, (struct line_ground){.2, .5, .01}, .5, CEDUO_LAW_LUMPED);
    release(1.8, 0, 0, 0, 0);
    EXPECT(trace.trajectory.x, !=, 1.8);
    const double gentle[] = {0, -1, -1 + .3, -5}; /* the far side, less steep than its friction, holds the rock */
    line_scene_init(&scene, 4, x, gentle, (struct line_ground){.2, .5, .2}, .5, CEDUO_LAW_LUMPED);
    release(1.8, 0, 0, 0, 0);
    EXPECT(trace.trajectory.x, !=, 1.8);
}

/* ---- vertices and ends ---- */

/* Two level segments that meet at x = 1, of Rn = Rt = 1/2 and 1/4. */
static void two_grounds(double radius)
{
    const double x[] = {0, 1, 100}, z[] = {0, 0, 0};
    line_scene_init(&scene, 3, x, z, (struct line_ground){.5, .5, 0}, radius, CEDUO_LAW_LUMPED);
    scene.segments[1].rn = scene.segments[1].rt = ceduo_number(.25);
    scene.scene.simulation.gravity = 8;
    publish();
}

TEST(a_release_on_a_vertex_is_on_the_right)
{
    two_grounds(.01);
    for (int dir = -1; dir <= 1; dir++) {
        release(1, 0, dir * 4, -8, 0);
        EXPECT_IS(trace.pieces[0], (vz, 2), (vx, dir));
    }
    release(1, 4, 0, 0, 0); /* dropped onto it */
    EXPECT(trace.pieces[0].vz1, ==, -8);
    EXPECT(trace.pieces[1].vz, ==, 2);
    release(0, 0, 0, -8, 0); /* first vertex */
    EXPECT(trace.pieces[0].vz, ==, 4);
}

TEST(a_flight_exactly_through_a_vertex_is_on_the_segment_ahead)
{
    two_grounds(.01);
    release(0, 1, 2, 0, 0); /* 1 - 4 t2 = 0 at t = 1/2, x = 1 */
    EXPECT_IS(trace.pieces[0], (x1, 1), (z1, 0), (vz1, -4));
    EXPECT_IS(trace.pieces[1], (vz, 1), (vx, .5));
    release(2, 1, -2, 0, 0); /* from the other side */
    EXPECT(trace.pieces[0].x1, ==, 1);
    EXPECT_IS(trace.pieces[1], (vz, 2), (vx, -1));
}

TEST(a_roll_that_ends_on_a_vertex_is_on_the_segment_it_came_along)
{
    two_grounds(.5);
    release(.5, 0, 1, 0, 0);
    assert_true(trace.pieces[0].rolls);
    EXPECT_IS(trace.pieces[0], (x1, 1), (vx, .5));
    for (size_t i = 1; i < trace.count; i++) { /* Rt = 1/2 again at x = 1, 1/4 after it */
        const struct ceduo_trajectory_segment *p = &trace.pieces[i];
        assert_true(p->contacts != 2 || (p->vx == .25 && p->x == 1));
        assert_true(p->contacts != 3 || (p->vx == .0625 && p->x == 1.5));
    }
}

TEST(a_trajectory_ends_at_either_end_of_the_slope)
{
    for (int dir = -1; dir <= 1; dir += 2) {
        straight(0, (struct line_ground){.5, 1, .1}, .1, CEDUO_LAW_LUMPED);
        double x = dir < 0 ? 1 : 999, end = dir < 0 ? 0 : 1000;
        release(x, 10, dir * 50, 0, 0); /* flies out */
        EXPECT_IS(trace.trajectory, (end, CEDUO_END_LEFT_SLOPE), (x, end), (contacts, 0));
        expect_relative(trace.trajectory.z, 10 - G / 2 / 2500, 1e-15);
        release(x, 0, dir * 3, 0, 0); /* rolls out */
        EXPECT_IS(trace.trajectory, (end, CEDUO_END_LEFT_SLOPE), (x, end), (z, 0));
        assert_true(trace.pieces[trace.count - 1].rolls);
        release(x, 0, dir * 1.4, 0, 0); /* stops within the last metre: v2 < 2 g mu */
        assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
        expect_relative(fabs(trace.trajectory.x - x), 1.4 * 1.4 / (2 * G * .1), 1e-11);
    }
}

TEST(a_final_wall_is_left_at_its_foot_only_backwards)
{
    const double x[] = {0, 20, 20.001}, z[] = {0, -10, 90};
    line_scene_init(&scene, 3, x, z, (struct line_ground){.3, .8, .5}, .34, CEDUO_LAW_CRSP);
    line_scene_release(&scene, 1, 1, 5, 0, 0);
    scene.control.x = 20;
    scene.scene.controls_count = 1;
    follow();
    assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
    EXPECT(trace.trajectory.x, <=, 20.001);
    EXPECT(trace.trajectory.x, >, 10);
}

/* ---- units of length and origin ---- */

static bool same_pieces(const struct line_trace *a, const struct line_trace *b, double length, double speed)
{
    bool equal =
        a->count == b->count && a->trajectory.end == b->trajectory.end && a->trajectory.contacts == b->trajectory.contacts;
    for (size_t i = 0; equal && i < a->count; i++) {
        const struct ceduo_trajectory_segment *p = &a->pieces[i], *q = &b->pieces[i];
        equal = p->rolls == q->rolls && p->x * length == q->x && p->z * length == q->z && p->x1 * length == q->x1 &&
                p->z1 * length == q->z1 && p->vx * speed == q->vx && p->vz * speed == q->vz && p->vx1 * speed == q->vx1 &&
                p->vz1 * speed == q->vz1 && p->contacts == q->contacts && p->seconds * (length / speed) == q->seconds;
    }
    return equal;
}

/* A profile in survey coordinates, relative to its first vertex, is the profile itself if no bit is lost. */
TEST(a_shift_that_loses_no_bit_changes_no_bit)
{
    for (uint64_t n = 0; n < 2000; n++) {
        line_scene_random(&scene, n, 0);
        size_t vertices = scene.scene.slope.vertices;
        for (size_t i = 0; i < vertices; i++) /* multiples of 2^-12 m */
            scene.x[i] = ldexp((double)i + rint(ldexp(scene.x[i], 12)), -12);
        line_scene_release(&scene, scene.x[(vertices - 1) / 2], .5, 1, 0, 0);
        scene.scene.controls_count = 0;
        follow();
        double origin = 480000.25;
        for (size_t i = 0; i < vertices; i++)
            scene.x[i] += origin;
        for (size_t i = vertices; i-- > 0;)
            scene.x[i] -= scene.x[0];
        scene.scene.slope.origin_x = origin;
        assert_int_equal(line_scene_follow(&scene, &second), CEDUO_OK);
        assert_true(same_pieces(&trace, &second, 1, 1));
    }
}

/* Lengths × 4 and speeds × 2 keep v2/(g l); the laws lumped and arm have no speed scale. */
static void expect_scaled_trajectories(bool arm)
{
    size_t bounces = 0;
    for (uint64_t n = 0; n < 3000; n++) {
        line_scene_random(&scene, n, 0);
        struct ceduo_scene *s = &scene.scene;
        s->simulation.law = CEDUO_LAW_LUMPED;
        s->simulation.scale_rn = false;
        if (arm)
            line_scene_arm(&scene, n);
        for (size_t j = 0; j + 1 < s->slope.vertices; j++)
            scene.segments[j].rt.mean = fmin(scene.segments[j].rt.mean, .9);
        follow();
        bounces += trace.count;
        for (size_t i = 0; i < s->slope.vertices; i++) {
            scene.x[i] *= 4;
            scene.z[i] *= 4;
            scene.segments[i < s->slope.vertices - 1 ? i : 0].roughness_m *= i < s->slope.vertices - 1 ? 4 : 1;
        }
        s->rock.diameter.mean *= 4;
        s->rock.height.mean *= 4;
        for (int i = 0; i < 3; i++)
            s->rock.axes[i].mean *= 4;
        struct ceduo_release *r = &s->release;
        line_scene_release(&scene, r->x.mean * 4, r->height.mean * 4, r->vx.mean * 2, r->vz.mean * 2, r->spin.mean / 2);
        scene.control.x *= 4;
        struct ceduo_crossing before = trace.crossing;
        assert_int_equal(line_scene_follow(&scene, &second), CEDUO_OK);
        assert_true(same_pieces(&trace, &second, 4, 2));
        ROWS(EXPECT, (before.reached, ==, second.crossing.reached), (before.height * 4, ==, second.crossing.height),
             (before.vx * 2, ==, second.crossing.vx), (before.vz * 2, ==, second.crossing.vz));
    }
    EXPECT(bounces, >, 10000);
}

TEST(four_times_the_lengths_and_twice_the_speeds_give_the_same_trajectory)
{
    expect_scaled_trajectories(false);
    expect_scaled_trajectories(true);
}

/* ---- probabilities ---- */

/* Newcombe 1998, Table I, method 3, to its four decimals; the others by hand from Wilson 1927. */
TEST(intervals_of_wilson)
{
    for (TABLE(row, "physics/statistics.txt", "Wilson")) {
        double hits = atof(row.at[0]), n = atof(row.at[1]), p = hits / n;
        struct ceduo_estimate share = ceduo_wilson(p, p, n);
        double lo = share.lo, hi = share.hi;
        EXPECT(share.mean, ==, p);
        EXPECT_NEAR(lo, atof(row.at[2]), .5e-4 + 1e-12);
        EXPECT_NEAR(hi, atof(row.at[3]), .5e-4 + 1e-12);
        assert_true(hits > 0 || lo == 0);
        assert_true(hits < n || hi == 1);
        /* each bound p solves (hits/n - p)2 = z2 p(1 - p)/n */
        double z2 = 1.959963984540054 * 1.959963984540054;
        if (hits > 0)
            expect_relative((p - lo) * (p - lo), z2 * lo * (1 - lo) / n, 1e-9);
        if (hits < n)
            expect_relative((p - hi) * (p - hi), z2 * hi * (1 - hi) / n, 1e-9);
    }
    ROWS(EXPECT, (ceduo_wilson(0, 0, 0).lo, ==, 0), (ceduo_wilson(0, 0, 0).hi, ==, 1), (ceduo_wilson(0, 0, 999).hi, <, .004));
    EXPECT(ceduo_wilson(0, 0, 999).hi, >, .0038);                         /* "below 0.4 %" */
    EXPECT(ceduo_wilson(.2, .3, 50).lo, ==, ceduo_wilson(.2, .2, 50).lo); /* a tenth may be a hit or not */
    EXPECT(ceduo_wilson(.2, .3, 50).hi, ==, ceduo_wilson(.3, .3, 50).hi);
}

/* Student 1908; the 97.5 % quantiles of any table. */
TEST(student_widths)
{
    for (TABLE(row, "physics/statistics.txt", "Student"))
        EXPECT_NEAR(ceduo_half_width(2, (uint64_t)atof(row.at[0])), 2 * atof(row.at[1]), 1e-3);
    for (uint64_t n = 0; n < 10; n++) /* n too small */
        assert_true(isnan(ceduo_half_width(1, n)));
    expect_relative(ceduo_share_half_width(0.25, 0.1, 50), 0.1959963984540054, 1e-15);
    EXPECT_NEAR(ceduo_share_half_width(0, 0, 20), .1611, .5e-4); /* Newcombe 1998, Table I */
    EXPECT_NEAR(ceduo_share_half_width(1, 0, 29), .1170, .5e-4);
    EXPECT_NEAR(ceduo_share_half_width(1, 0, 29), ceduo_share_half_width(0, 0, 29), 1e-15);
}

/* In n equal pairs up to 3.841/(n + 3.841) may differ: Wilson's upper bound of 0 in n. */
TEST(pairs_that_do_not_differ)
{
    struct ceduo_moments m = {0};
    struct ceduo_estimate p = ceduo_estimate_from_pairs(.5, &m, 100); /* no single rock is stored */
    EXPECT(p.mean, ==, .5);
    assert_true(isnan(p.se));
    assert_false(ceduo_pairs_are_equal(&p));
    for (int i = 0; i < 999; i++)
        ceduo_moments_add(&m, 0);
    p = ceduo_estimate_from_pairs(0, &m, 999);
    EXPECT(p.mean, ==, 0);
    assert_true(isnan(p.se));
    EXPECT_NEAR(p.hi, 3.841459 / (999 + 3.841459), 1e-9);
    ceduo_moments_add(&m, -1); /* one in 1000 */
    p = ceduo_estimate_from_pairs(-1e-3, &m, 1000);
    EXPECT(p.mean, ==, -1e-3);
    EXPECT_NEAR(p.se, 1e-3, 1e-6);
    assert_false(ceduo_pairs_are_equal(&p));
    m = (struct ceduo_moments){0};
    for (int i = 0; i < 20; i++)
        ceduo_moments_add(&m, 0.5); /* all differ equally */
    p = ceduo_estimate_from_pairs(0.5, &m, 20);
    EXPECT_IS(p, (se, 0), (lo, .5), (hi, .5));
}

TEST(ranks_of_quantiles)
{
    for (TABLE(row, "physics/statistics.txt", "ranks"))
        assert_int_equal(ceduo_quantile_rank((size_t)atof(row.at[0]), atof(row.at[1])), atof(row.at[2]));
}

/* P(X <= k) of the binomial law by direct summation. */
static long double binomial_below(size_t n, long double p, size_t k)
{
    long double sum = 0, term = powl(1 - p, (long double)n);
    for (size_t i = 0; i <= k; i++) {
        sum += term;
        term *= (long double)(n - i) / (long double)(i + 1) * p / (1 - p);
    }
    return sum;
}

/* The 95 % limits of a median are in many tables: 8 and 18 of 25, 18 and 33 of 50, 40 and 61 of 100 (Conover 1999). */
TEST(intervals_of_quantiles)
{
    for (TABLE(row, "physics/statistics.txt", "intervals of quantiles")) {
        size_t lo, hi;
        ceduo_quantile_interval((size_t)atof(row.at[0]), atof(row.at[1]), &lo, &hi);
        assert_int_equal(lo, atof(row.at[2]));
        assert_int_equal(hi, atof(row.at[3]));
    }
    assert_true(isnan(ceduo_quantile(NULL, 0, .5)));
    const double shares[] = {.01, .05, .5, .95, .99};
    for (size_t i = 0; i < LENGTH(shares); i++)
        for (size_t n = 1; n <= 300; n++) { /* neither tail exceeds 2.5 %; one rank further in it would */
            size_t lo, hi;
            long double p = shares[i];
            ceduo_quantile_interval(n, shares[i], &lo, &hi);
            ROWS(assert_true, (lo == 0 || binomial_below(n, p, lo - 1) < .025L), (lo == n || binomial_below(n, p, lo) >= .025L),
                 (hi > n || binomial_below(n, p, hi - 1) >= .975L * (1 - 1e-15L)),
                 (hi < 2 || binomial_below(n, p, hi - 2) < .975L), (hi >= 1 && hi <= n + 1));
        }
}

/* Return value i of a sample shape, up to shapes that no intervals divide evenly. */
static double many_valued(size_t shape, size_t i, struct line_random *r)
{
    switch (shape) {
    case 0:
        return line_uniform(r, -3, 5);
    case 1:
        return line_log_uniform(r, 1e-300, 1e300);
    case 2: /* one far from all others */
        return i == 777 ? 1e9 : line_uniform(r, 20, 21);
    case 3:
        return i % 2 == 0 ? 7 : 8;
    case 4: /* some differ in the last bit */
        return i % 3 == 0 ? nextafter(1, 2) : 1;
    case 5:
        return (double)(i % 5) * 0x1p-1074;
    case 6:
        return i % 4 == 0 ? -1.7e308 : 1.7e308;
    default:
        return 42;
    }
}

/* Percentiles of many values are searched among near values only. They equal those of sorted values, and no value is lost. */
TEST(percentiles_of_many_values)
{
    static const size_t sizes[] = {32767, 32768, 100003};
    static double values[100003], sorted[100003];
    struct line_random r = {.state = 11};
    for (size_t shape = 0; shape < 8; shape++)
        for (size_t s = 0; s < (shape == 0 ? 40 : LENGTH(sizes)); s++) { /* every rank reaches an interval's end */
            size_t n = s < LENGTH(sizes) ? sizes[s] : 32768 + 101 * s;
            struct ceduo_moments m = {0};
            for (size_t i = 0; i < n; i++) {
                values[i] = sorted[i] = many_valued(shape, i, &r);
                ceduo_moments_add(&m, values[i]);
            }
            qsort(sorted, n, sizeof *sorted, by_value);
            struct ceduo_distribution d = ceduo_distribution_exact(values, n, &m);
            const struct {
                double p, at, lo, hi;
            } percentiles[] = {
                {.5, d.p50, d.p50_lo, d.p50_hi}, {.95, d.p95, d.p95_lo, d.p95_hi}, {.99, d.p99, d.p99_lo, d.p99_hi}};
            for (size_t i = 0; i < 3; i++) {
                size_t lo, hi;
                ceduo_quantile_interval(n, percentiles[i].p, &lo, &hi);
                EXPECT_IS(percentiles[i], (at, sorted[ceduo_quantile_rank(n, percentiles[i].p) - 1]), (lo, sorted[lo - 1]),
                          (hi, sorted[hi - 1]));
            }
            qsort(values, n, sizeof *values, by_value);
            assert_memory_equal(values, sorted, n * sizeof *values);
        }
}

TEST(moments_added_and_merged)
{
    static double values[10000];
    const size_t n = LENGTH(values);
    struct line_random r = {.state = 3};
    long double sum = 0, squares = 0;
    double largest = -INFINITY;
    for (size_t i = 0; i < n; i++) {
        values[i] = line_uniform(&r, -1, 1) - 1e4; /* far from 0, all negative */
        sum += values[i];
        largest = fmax(largest, values[i]);
    }
    long double mean = sum / (long double)n;
    for (size_t i = 0; i < n; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    static const size_t cuts[] = {1, 2, 7, 1000, 10000};
    for (size_t c = 0; c < LENGTH(cuts); c++) {
        struct ceduo_moments all = {0};
        for (size_t i = 0; i < n;) {
            struct ceduo_moments part = {0};
            for (size_t j = 0; j < cuts[c] && i < n; j++)
                ceduo_moments_add(&part, values[i++]);
            ceduo_moments_merge(&all, &part);
        }
        struct ceduo_moments empty = {0};
        ceduo_moments_merge(&all, &empty);
        assert_int_equal(all.n, n);
        EXPECT(all.max, ==, largest);
        ROWS(expect_relative, (all.mean, (double)mean, 1e-14), (all.m2, (double)squares, 1e-9),
             (ceduo_moments_sd(&all), (double)sqrtl(squares / (long double)(n - 1)), 1e-9),
             (ceduo_moments_se(&all), (double)sqrtl(squares / (long double)(n - 1) / (long double)n), 1e-9));
    }
    struct ceduo_moments one = {0};
    assert_true(isnan(ceduo_moments_sd(&one)));
    ceduo_moments_add(&one, 4);
    EXPECT_NAN(ceduo_moments_sd(&one), ceduo_moments_se(&one));
    EXPECT_IS(one, (mean, 4), (max, 4));
}

/* ---- numbers that vary between rocks ---- */

static double density(double z)
{
    return exp(-z * z / 2) / sqrt(2 * acos(-1));
}

static double below(double z)
{
    return erfc(-z / sqrt(2)) / 2;
}

struct summary {
    double mean, sd, lowest, highest;
};

/* Draw by n evenly spaced quantiles (n > 0) or by 10^6 random ones. */
static struct summary draw_many(struct ceduo_number number, double lo, double hi, size_t n)
{
    struct line_random r = {.state = 11};
    struct ceduo_moments m = {0};
    struct summary summary = {.lowest = INFINITY, .highest = -INFINITY};
    size_t count = n > 0 ? n : 1000000;
    for (size_t i = 0; i < count; i++) {
        double u = n > 0 ? ((double)i + .5) / (double)n : line_uniform(&r, 0, 1) + 0x1p-54;
        double v = ceduo_number_draw(number, u, lo, hi);
        ceduo_moments_add(&m, v);
        summary.lowest = fmin(summary.lowest, v);
        summary.highest = fmax(summary.highest, v);
    }
    summary.mean = m.mean;
    summary.sd = ceduo_moments_sd(&m);
    return summary;
}

/* Compare with the normal law truncated at [a, b] standard deviations from its mean. */
static void expect_cut_normal(double mean, double sd, double lo, double hi)
{
    struct ceduo_number n = {.mean = mean, .spread = sd, .kind = CEDUO_SPREAD_NORMAL};
    double a = fmax(-3, (lo - mean) / sd), b = fmin(3, (hi - mean) / sd), p = below(b) - below(a);
    double shift = (density(a) - density(b)) / p;
    double variance = 1 + (a * density(a) - b * density(b)) / p - shift * shift;
    double expected = mean + sd * shift, width = sd * sqrt(variance);
    struct summary even = draw_many(n, lo, hi, 200000), random = draw_many(n, lo, hi, 0);
    EXPECT_NEAR(even.mean, expected, 1e-5 * sd);
    EXPECT_NEAR(even.sd, width, 1e-4 * sd);
    EXPECT_NEAR(random.mean, expected, 4 * width / 1e3); /* 4 standard errors of 10^6 draws */
    EXPECT_NEAR(random.sd, width, 4 * width / 1e3);      /* its own error is smaller: no long tails */
    ROWS(EXPECT, (even.lowest, >=, mean + a * sd - 1e-15), (even.lowest, <, mean + (a + .05) * sd),
         (even.highest, <=, mean + b * sd + 1e-15), (even.highest, >, mean + (b - .05) * sd));
}

TEST(a_normal_law_is_truncated)
{
    expect_cut_normal(.5, .05, -INFINITY, INFINITY); /* at three standard deviations */
    expect_cut_normal(.9, .1, 0, 1);
    expect_cut_normal(.05, .1, 0, 1);
    expect_cut_normal(.5, .5, 0, 1);
    struct ceduo_number n = {.mean = 2, .spread = .5, .kind = CEDUO_SPREAD_NORMAL};
    EXPECT(ceduo_number_min(n), ==, .5);
    EXPECT(ceduo_number_max(n), ==, 3.5);
    expect_relative(ceduo_number_draw(n, .5, -INFINITY, INFINITY), 2, 1e-14);
}

TEST(a_uniform_spread)
{
    struct ceduo_number n = {.mean = 2, .spread = .5, .kind = CEDUO_SPREAD_UNIFORM};
    EXPECT(ceduo_number_min(n), ==, 1.5);
    EXPECT(ceduo_number_max(n), ==, 2.5);
    struct summary all = draw_many(n, -INFINITY, INFINITY, 0), cut = draw_many(n, 0, 2, 0);
    EXPECT_NEAR(all.mean, 2, 4 * .5 / sqrt(3) / 1e3);
    EXPECT_NEAR(all.sd, .5 / sqrt(3), 1e-3);
    ROWS(EXPECT, (all.lowest, >=, 1.5), (all.highest, <=, 2.5), (all.lowest, <, 1.501), (all.highest, >, 2.499));
    EXPECT_NEAR(cut.mean, 1.75, 4 * .25 / sqrt(3) / 1e3);
    EXPECT(cut.highest, <=, 2);
    EXPECT(cut.lowest, >=, 1.5);
    struct ceduo_number fixed = ceduo_number(.3);
    EXPECT(ceduo_number_draw(fixed, .01, 0, 1), ==, .3);
    EXPECT(ceduo_number_min(fixed), ==, .3);
}

/* ---- facet draws ---- */

TEST(facet_draws_are_uniform_and_depend_on_all_inputs)
{
    const uint64_t n = 200000;
    double sum = 0, squares = 0, product = 0, last = .5;
    for (uint64_t i = 0; i < n; i++) {
        double u = line_facet_draw(1, i / 20, i % 20);
        EXPECT(u, >=, 0);
        EXPECT(u, <, 1);
        sum += u;
        squares += u * u;
        product += (u - .5) * (last - .5);
        last = u;
    }
    double count = (double)n, se = sqrt(1 / 12. / count);
    EXPECT_NEAR(sum / count, .5, 4 * se);
    EXPECT_NEAR(squares / count, 1 / 3., 4 * sqrt(4 / 45. / count));
    EXPECT(fabs(product / count), <, 4 / 12. / sqrt(count));
    double u = line_facet_draw(1, 2, 3);
    ROWS(EXPECT, (u, ==, line_facet_draw(1, 2, 3)), (u, !=, line_facet_draw(2, 2, 3)), (u, !=, line_facet_draw(1, 3, 3)),
         (u, !=, line_facet_draw(1, 2, 2)));
}
