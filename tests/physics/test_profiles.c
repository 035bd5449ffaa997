/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Long profiles: what makes them fast changes nothing. Neighbours on one line are one segment inside the core, flights
 * pass chunks of segments, rolls whole segments; each against the same without it. */
#include "ceduo/simulate.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/walk/landing.h"
#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"

#define VERTICES 100000
#define ROCKS    2000

/* ---- profiles ---- */

static void move_vertices(struct ceduo_slope *s, double step, uint64_t seed)
{
    struct line_random r = {.state = seed};
    for (size_t i = 1; i + 1 < s->vertices; i++)
        s->z[i] += step * line_uniform(&r, -1, 1);
}

static size_t segments_inside(const struct ceduo_slope *slope)
{
    struct ground g;
    assert_true(ceduo_ground_init(&g, slope, CEDUO_GRAVITY, 0.34, false));
    size_t n = g.n;
    ceduo_ground_release(&g);
    return n;
}

/* ---- collinear segments ---- */

static struct paper_site site;

static void init_site(enum ceduo_law law, bool friction_bound)
{
    paper_site_init(&site);
    site.scene.simulation.friction_bound = friction_bound;
    paper_site_read_theta(&site, law == CEDUO_LAW_CRSP ? PAPER_HEIGHT : PAPER_ANGLE);
    site.scene.simulation.law = law;
}

static void expect_same_trajectories(const struct ceduo_scene *a, const struct ceduo_scene *b)
{
    LOCAL(ceduo_tracer, f) = ceduo_tracer_create(a, NULL);
    LOCAL(ceduo_tracer, g) = ceduo_tracer_create(b, NULL);
    assert_true(f);
    assert_true(g);
    for (uint64_t rock = 0; rock < ROCKS; rock++) {
        struct ceduo_trajectory v = {0}, w = {0};
        struct ceduo_crossing c = {0}, d = {0};
        assert_int_equal(ceduo_tracer_run(f, rock, NULL, &v, &c), CEDUO_OK);
        assert_int_equal(ceduo_tracer_run(g, rock, NULL, &w, &d), CEDUO_OK);
        EXPECT_SAME(v, w, end, contacts, x, z);
        EXPECT_SAME(c, d, reached, vx, vz, spin);
        EXPECT_NEAR(c.height, d.height, 1e-12); /* above ground that was rounded when it was cut */
    }
}

static struct ceduo_arrivals arrivals(const struct ceduo_scene *scene)
{
    LOCAL(ceduo_run, run) = run_option(scene, NULL, ROCKS, 1);
    return read_arrivals(run, 0);
}

TEST(a_cut_slope_gives_the_same_trajectories_and_statistics)
{
    for (int kind = 0; kind < 2 * CEDUO_LAW_COUNT; kind++) {
        init_site((enum ceduo_law)(kind / 2), kind & 1);
        LOCAL_BY(slope_free) struct ceduo_slope fine = slope_cut(&site.scene.slope, VERTICES);
        assert_int_equal(segments_inside(&fine), PAPER_SEGMENTS);
        struct ceduo_scene scene = site.scene;
        scene.slope = fine;
        expect_same_trajectories(&site.scene, &scene);
        struct ceduo_arrivals a = arrivals(&site.scene), b = arrivals(&scene);
        EXPECT(a.reached, ==, b.reached);
        EXPECT_SAME(a.speed, b.speed, mean, se);
        EXPECT_SAME(a.energy, b.energy, mean, p95);
        EXPECT_NEAR(a.height.mean, b.height.mean, 1e-12);
    }
}

TEST(a_cut_slope_keeps_spreads_and_roughness_heights)
{
    init_site(CEDUO_LAW_CRSP, true);
    for (size_t j = 0; j < PAPER_SEGMENTS; j++) {
        site.segments[j].rn = (struct ceduo_number){.3, .01 * (double)(j % 4), CEDUO_SPREAD_NORMAL};
        site.segments[j].rt = (struct ceduo_number){.85, .01 * (double)(j % 3), CEDUO_SPREAD_UNIFORM};
    }
    site.scene.rock.density = (struct ceduo_number){2600, 100, CEDUO_SPREAD_NORMAL};
    site.scene.rock.diameter = (struct ceduo_number){.56, .05, CEDUO_SPREAD_NORMAL};
    LOCAL_BY(slope_free) struct ceduo_slope fine = slope_cut(&site.scene.slope, 5000);
    struct ceduo_scene scene = site.scene;
    scene.slope = fine;
    expect_same_trajectories(&site.scene, &scene);
}

/* Deviations from a line that a double can resolve stay: vertices moved by a nanometre, and a sliver as steep as it is
 * small. */
TEST(small_breaks_stay)
{
    init_site(CEDUO_LAW_LUMPED, false);
    LOCAL_BY(slope_free) struct ceduo_slope fine = slope_cut(&site.scene.slope, 10000);
    move_vertices(&fine, 1e-9, 5);
    EXPECT(segments_inside(&fine), >, 9000);
    LOCAL_BY(slope_free) struct ceduo_slope sliver = slope_new(4);
    memcpy(sliver.x, (double[4]){0, 50, nextafter(50, 51), 100}, sizeof(double[4]));
    memcpy(sliver.z, (double[4]){0, -25, nextafter(-25, -26), -50}, sizeof(double[4]));
    sliver.z[2] = nextafter(sliver.z[2], -26);
    for (size_t j = 0; j < 3; j++)
        sliver.segments[j] = site.segments[3];
    assert_int_equal(segments_inside(&sliver), 3);
}

/* A face keeps its foot for any width, down to the rounding of the profile's length. */
TEST(a_narrow_face_keeps_its_foot)
{
    init_site(CEDUO_LAW_LUMPED, false);
    for (double wide = 1; wide > 1e-18; wide /= 10)
        for (int up = 0; up < 2; up++) {
            LOCAL_BY(slope_free) struct ceduo_slope face = slope_new(3);
            memcpy(face.x, (double[3]){0, wide, 2}, sizeof(double[3]));
            memcpy(face.z, up ? (double[3]){0, 300, 299} : (double[3]){0, -300, -301}, sizeof(double[3]));
            for (size_t j = 0; j < 2; j++)
                face.segments[j] = site.segments[3];
            assert_int_equal(segments_inside(&face), 2);
        }
    LOCAL_BY(slope_free)
    struct ceduo_slope steep = slope_new(3); /* both parts are vertical within a hundredth of a micrometre */
    memcpy(steep.x, (double[3]){0, 1e-17, 1e-8}, sizeof(double[3]));
    memcpy(steep.z, (double[3]){0, -300, -600}, sizeof(double[3]));
    for (size_t j = 0; j < 2; j++)
        steep.segments[j] = site.segments[3];
    assert_int_equal(segments_inside(&steep), 2);
}

/* ---- flights over chunks ---- */

/* Make waves of many lengths. */
static struct ceduo_slope rough_slope(size_t vertices, double spacing, uint64_t seed)
{
    struct ceduo_slope s = slope_new(vertices);
    struct line_random r = {.state = seed};
    double x = 0, w[12][3];
    for (int k = 0; k < 12; k++) {
        w[k][0] = 6.3 / (spacing * pow(2.5, k + 1));
        w[k][1] = line_uniform(&r, 0, .3) / w[k][0];
        w[k][2] = line_uniform(&r, 0, 6.3);
    }
    for (size_t i = 0; i < vertices; i++) {
        s.x[i] = x;
        s.z[i] = -.6 * x;
        for (int k = 0; k < 12; k++)
            s.z[i] += w[k][1] * (sin(w[k][0] * x + w[k][2]) - sin(w[k][2]));
        s.segments[i] = site.segments[3];
        x += spacing * (line_chance(&r, .02) ? line_log_uniform(&r, 1e-6, 1e-2) : line_uniform(&r, .2, 2));
    }
    return s;
}

TEST(flights_land_as_without_blocks)
{
    init_site(CEDUO_LAW_LUMPED, false);
    struct line_random r = {.state = 7};
    uint64_t far = 0;
    for (size_t n = 0; n < 40; n++) {
        double spacing = line_log_uniform(&r, 1e-3, 1);
        LOCAL_BY(slope_free) struct ceduo_slope slope = rough_slope((size_t)line_log_uniform(&r, 17, 20000), spacing, n);
        LOCAL_BY(ceduo_ground_release) struct ground g;
        assert_true(ceduo_ground_init(&g, &slope, CEDUO_GRAVITY, .34, false));
        EXPECT(g.top, >, 0);
        struct ground plain = g;
        plain.top = 0;
        double end = g.x[g.n];
        for (int i = 0; i < 2000; i++) {
            double speed = sqrt(CEDUO_GRAVITY * end * line_log_uniform(&r, 1e-7, 1)), angle = line_uniform(&r, 0, 6.3);
            double x = line_chance(&r, .2) ? g.x[(size_t)line_uniform(&r, 0, (double)g.n)] : line_uniform(&r, 0, end);
            size_t j = ceduo_ground_segment(&g, x);
            struct landing a, b;
            if (line_chance(&r, .5)) {
                struct flight f = {.x = x,
                                   .z = ground_height(&g, j, x) + line_log_uniform(&r, 1e-6, 1) * end,
                                   .vx = speed * cos(angle),
                                   .vz = speed * sin(angle),
                                   .segment = j};
                a = next_landing(&g, &f);
                b = next_landing(&plain, &f);
            } else {
                struct contact contact = {j, ground_along(&g, j, x), speed * cos(angle), fabs(speed * sin(angle))};
                struct flight f = begin_flight(&g, &contact);
                a = next_contact(&g, &contact, &f, true);
                b = next_contact(&g, &contact, &f, false);
            }
            EXPECT_SAME(a, b, t, x, z, contact.segment, contact.q, contact.along, contact.off, off_slope);
            far += a.contact.segment > j + 100 || a.contact.segment + 100 < j;
        }
    }
    print_message("%ju flights of more than 100 segments\n", (uintmax_t)far);
    EXPECT(far, >, 1000); /* chunks were passed */
}

/* Return ground with teeth. Their tips lie on one line, each a few last digits higher or lower. The start of each chunk of
 * segments lies at the same depth below that line, so that the chords of chunks are parallel to it. */
static struct ceduo_slope toothed_slope(size_t vertices, struct line_random *r, double fall, double top)
{
    const size_t chunk = (size_t)1 << GROUND_BITS;
    struct ceduo_slope s = slope_new(vertices);
    double x = 0, depth = line_uniform(r, .1, 2);
    for (size_t i = 0; i < vertices; i++) {
        bool tooth = i % chunk != 0 && line_chance(r, .02);
        s.x[i] = x;
        s.z[i] = top - fall * x;
        if (!tooth)
            s.z[i] -= depth * (i % chunk == 0 ? 1 : line_uniform(r, 1, 2));
        for (int k = (int)line_uniform(r, -3, 3); tooth && k != 0; k -= k > 0 ? 1 : -1)
            s.z[i] = nextafter(s.z[i], k > 0 ? INFINITY : -INFINITY);
        s.segments[i] = site.segments[3];
        x += line_uniform(r, .2, 2);
    }
    return s;
}

/* Rounding decides if a flight that grazes many teeth touches one. Skipping a whole chunk must not change this: the margin of
 * the chunk's height ensures it. */
TEST(flights_along_teeth_touch_the_same_with_blocks)
{
    init_site(CEDUO_LAW_LUMPED, false);
    struct line_random r = {.state = 11};
    uint64_t touched = 0;
    for (size_t n = 0; n < 2000; n++) {
        double fall = line_uniform(&r, -2, 2), top = line_uniform(&r, -10, 10), speed = line_uniform(&r, 1, 50);
        LOCAL_BY(slope_free) struct ceduo_slope slope = toothed_slope(305, &r, fall, top);
        LOCAL_BY(ceduo_ground_release) struct ground g;
        assert_true(ceduo_ground_init(&g, &slope, 1e-30, .34, false));
        EXPECT(g.top, >, 0);
        struct ground plain = g;
        plain.top = 0;
        for (int dir = -1; dir <= 1; dir += 2) {
            double x = dir > 0 ? 0 : g.x[g.n];
            struct flight f = {
                .x = x, .z = top - fall * x, .vx = dir * speed, .vz = -fall * (dir * speed), .segment = dir > 0 ? 0 : g.n - 1};
            struct landing a = next_landing(&g, &f), b = next_landing(&plain, &f);
            EXPECT_SAME(a, b, t, x, z, contact.segment, contact.q, contact.along, contact.off, off_slope);
            touched += !b.off_slope;
        }
    }
    print_message("%ju of 4000 flights touch a tooth\n", (uintmax_t)touched);
    EXPECT(touched, >, 1000);
    EXPECT(touched, <, 3950);
}

/* ---- rolls over many segments ---- */

static void ignore_segment(void *context, const struct ceduo_trajectory_segment *piece)
{
    (void)context;
    (void)piece;
}

/* On a fine profile a rock has the same trajectory, to the bit, with a callback for its segments. */
TEST(a_callback_does_not_change_rolls)
{
    uint64_t equal = 0, all = 0;
    for (int kind = 0; kind < 2 * CEDUO_LAW_COUNT; kind++) {
        for (int step = -5; step < 0; step++) {
            init_site((enum ceduo_law)(kind / 2), kind & 1);
            LOCAL_BY(slope_free) struct ceduo_slope fine = slope_cut(&site.scene.slope, 20000);
            move_vertices(&fine, pow(10, step), 3);
            struct ceduo_scene scene = site.scene;
            scene.slope = fine;
            LOCAL(ceduo_tracer, f) = ceduo_tracer_create(&scene, NULL);
            assert_non_null(f);
            for (uint64_t rock = 0; rock < 100; rock++) {
                struct ceduo_trajectory v, w;
                struct ceduo_crossing c, d;
                struct ceduo_trajectory_callbacks watch = {.segment = ignore_segment};
                assert_int_equal(ceduo_tracer_run(f, rock, NULL, &v, &c), CEDUO_OK);
                assert_int_equal(ceduo_tracer_run(f, rock, &watch, &w, &d), CEDUO_OK);
                equal += v.end == w.end && v.contacts == w.contacts && v.x == w.x && v.z == w.z && c.reached == d.reached &&
                         (!c.reached || c.vx == d.vx);
                all++;
            }
        }
    }
    EXPECT(equal, ==, all);
}
