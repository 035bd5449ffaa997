/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The four rounding modes of IEEE 754: closed forms agree to 1e-12, statistics within their error. bench_rounding.c measures
 * how far single trajectories diverge. */
#include "core/runs/run.h"
#include "expect.h"

#include <fenv.h>
#include <math.h>
#include <string.h>

#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"

#define ROCKS 8000
#define EXACT 1e-12

static const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

static void expect_near(double got, double wanted)
{
    if (!(fabs(got - wanted) <= EXACT * fabs(wanted)))
        fail_msg("%.17g, not %.17g", got, wanted);
}

/* Simulate rock 0 under a rounding mode, and everything else in the default one. */
static void follow(const struct line_scene *s, int mode, struct line_trace *trace)
{
    assert_int_equal(fesetround(mode), 0);
    enum ceduo_status status = line_scene_follow(s, trace);
    assert_int_equal(fesetround(FE_TONEAREST), 0);
    assert_int_equal(status, CEDUO_OK);
}

static struct line_scene scene;
static struct line_trace trace;

/* A flight to a slope at 45 degrees: x = t and -x = 3 - g/2 t2. */
TEST(a_flight_onto_a_slope)
{
    const double x[] = {0, 50}, z[] = {0, -50};
    for (size_t m = 0; m < LENGTH(modes); m++) {
        line_scene_init(&scene, 2, x, z, (struct line_ground){.5, .8, .5}, .1, CEDUO_LAW_LUMPED);
        line_scene_release(&scene, 1, 3, 1, 0, 0);
        follow(&scene, modes[m], &trace);
        double t = (1 + sqrt(1 + 2 * 9.81 * 3)) / 9.81, vz = -9.81 * t;
        ROWS(expect_near, (trace.pieces[0].seconds, t), (trace.pieces[0].x1, 1 + t), (trace.pieces[0].z1, -1 - t));
        double along = .8 * (1 - vz) / sqrt(2), off = .5 * -(vz + 1) / sqrt(2);
        expect_near(trace.pieces[1].vx, (along + off) / sqrt(2));
        expect_near(trace.pieces[1].vz, (off - along) / sqrt(2));
    }
}

/* A facet at 45 degrees turns a fall by half a right angle, however short: the rock leaves with the remaining energy. */
TEST(the_shortest_facet)
{
    static const double shortest[] = {5e-324, 1.5e-323, 1e-310, 1e-290, 1};
    for (size_t i = 0; i < LENGTH(shortest); i++)
        for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
            const double x[] = {0, shortest[i], 50}, z[] = {0, -shortest[i], -20};
            line_scene_init(&scene, 3, x, z, (struct line_ground){1, 1, 0}, 1, (enum ceduo_law)law);
            line_scene_release(&scene, 0, 5, 0, 0, 0);
            assert_int_equal(line_scene_follow(&scene, &trace), CEDUO_OK);
            double vx = trace.pieces[1].vx, vz = trace.pieces[1].vz;
            assert_true(vx > 0);
            assert_true(vx * vx + vz * vz <= 2 * 9.81 * 5 * (1 + EXACT));
            if (law == CEDUO_LAW_LUMPED)
                expect_near(vx, sqrt(2 * 9.81 * 5));
            const double wall[] = {0, -1, -20}; /* as steep as possible: a fall along it keeps all speed */
            line_scene_init(&scene, 3, x, wall, (struct line_ground){1, 1, 0}, 1, (enum ceduo_law)law);
            line_scene_release(&scene, 0, 5, 0, 0, 0);
            assert_int_equal(line_scene_follow(&scene, &trace), CEDUO_OK);
            vx = trace.pieces[1].vx, vz = trace.pieces[1].vz;
            assert_true(vx * vx + vz * vz <= 2 * 9.81 * 5 * (1 + EXACT));
        }
}

/* On level ground a rock without bounce stops after (1 + k) v2 / (2 g mu) from speed v, under every law. */
TEST(the_distance_to_a_stop)
{
    const double x[] = {0, 1000}, z[] = {0, 0};
    for (int law = 0; law < CEDUO_LAW_COUNT; law++)
        for (size_t m = 0; m < LENGTH(modes); m++) {
            line_scene_init(&scene, 2, x, z, (struct line_ground){.5, 1, .3}, 1, (enum ceduo_law)law);
            double k = law == CEDUO_LAW_LUMPED ? 0 : .4; /* a rolling sphere */
            line_scene_release(&scene, 10, 0, 5, 0, k > 0 ? 5 : 0);
            follow(&scene, modes[m], &trace);
            assert_int_equal(trace.trajectory.end, CEDUO_END_AT_REST);
            expect_near(trace.trajectory.x, 10 + (1 + k) * 25 / (2 * 9.81 * .3));
        }
}

/* Table 3 of the paper without roughness, the first two contacts of crsp: golden to four digits, and equal in every mode to
 * 1e-12. */
TEST(the_first_contacts_on_the_slope_of_table_3)
{
    static struct line_trace near;
    line_scene_init(&scene, PAPER_VERTICES, paper_x, paper_y, (struct line_ground){.31, .83, .5}, .34, CEDUO_LAW_CRSP);
    scene.scene.simulation.friction_bound = false; /* the golden figures belong to the published law */
    scene.segments[0].rt.mean = .87;
    line_scene_release(&scene, 5, 1, 1, 0, 0);
    follow(&scene, FE_TONEAREST, &near);
    ROWS(EXPECT_NEAR, (near.pieces[0].x1, 5.6993, 1e-4), (near.pieces[0].z1, 114.6014, 1e-4), (near.pieces[1].x1, 6.5113, 1e-4),
         (near.pieces[1].z1, 112.9774, 1e-4));
    for (size_t m = 1; m < LENGTH(modes); m++) {
        follow(&scene, modes[m], &trace);
        for (size_t i = 0; i < 3; i++) {
            ROWS(expect_near, (trace.pieces[i].x, near.pieces[i].x), (trace.pieces[i].z, near.pieces[i].z),
                 (trace.pieces[i].vx, near.pieces[i].vx));
            if (near.pieces[i].vz != 0)
                expect_near(trace.pieces[i].vz, near.pieces[i].vz);
        }
    }
}

/* ---- statistics ---- */

static struct ceduo_arrivals arrive(const struct ceduo_scene *s, int mode, double *contacts)
{
    struct ceduo_run_def def = ceduo_run_def_default(s);
    struct ceduo_run *run;
    def.threads = 1;
    def.rocks_max = ROCKS;
    assert_int_equal(fesetround(mode), 0);
    enum ceduo_status made = ceduo_run_create(&def, &run);
    enum ceduo_status done = made == CEDUO_OK ? ceduo_run_extend(run, ROCKS) : made;
    assert_int_equal(fesetround(FE_TONEAREST), 0);
    assert_int_equal(done, CEDUO_OK);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    *contacts = (double)ceduo_run_contacts(run) / ROCKS;
    ceduo_run_free(run);
    return a;
}

static void expect_within(const char *label, double got, double wanted, double error)
{
    if (!(fabs(got - wanted) <= error))
        fail_msg("%s: %.12g, not %.12g within %.3g", label, got, wanted, error);
}

TEST(statistics_agree_within_their_error)
{
    static struct paper_site site;
    for (int kind = 0; kind < 16; kind++) {
        paper_site_init(&site);
        site.scene.simulation.friction_bound = kind & 8;
        paper_site_read_theta(&site, kind & 2 ? PAPER_HEIGHT : PAPER_ANGLE);
        site.scene.slope.facets = kind & 4 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
        site.scene.simulation.law = kind & 1 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
        double contacts0, contacts, moved = 0;
        struct ceduo_arrivals near = arrive(&site.scene, FE_TONEAREST, &contacts0);
        for (size_t m = 1; m < LENGTH(modes); m++) {
            struct ceduo_arrivals a = arrive(&site.scene, modes[m], &contacts);
            expect_within("reach", a.reach.mean, near.reach.mean, (near.reach.hi - near.reach.lo) / 3.92);
            moved += fabs(contacts - contacts0);
            if (near.reached < 100) /* too few for a mean */
                continue;
            ROWS(expect_within, ("speed", a.speed.mean, near.speed.mean, near.speed.se),
                 ("energy", a.energy.mean, near.energy.mean, near.energy.se),
                 ("height", a.height.mean, near.height.mean, near.height.se));
            EXPECT(a.speed.mean, !=, near.speed.mean); /* the mode did change the result */
        }
        expect_within("contacts", moved / contacts0, 0, .01);
    }
}
