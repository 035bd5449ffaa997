/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Random scenes in bulk and difficult ones by name: rules for any ground (invariants.h), equal bits in a second run, no invalid
 * operation, and consistent counts.
 *
 * STRESS=SCENES STRESS_FIRST=FIRST test_stress default 15000 random scenes, 40000 with FULL; `make stress` has ten million
 *
 * An invalid operation, a division by zero or an overflow during a trajectory fails the test, except in flights with a
 * horizontal speed below 1e-150 m/s. There the time to the next vertex overflows by design, even to infinity. Times 0 this is
 * NaN, and a comparison with it counts as a contact. (Reading a scene may compare with NaN, which means "not given".) */
#include "ceduo/simulate.h"
#include "core/runs/run.h"
#include "expect.h"
#include "full.h"
#include "local.h"

#include <fenv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "invariants.h"
#include "runs.h"

#define LASTING_EVERY 5000
#define RUN_EVERY     64 /* one scene in this many is also simulated as a run */
#define CONTROLS      5
#define ROCKS         11 /* per difficult scene */

static uint64_t scenes, first = 1000000;
static uint64_t run_rocks = 40;
static int by_design; /* floating-point exceptions that are allowed */

/* ---- one scene ---- */

struct result {
    struct ceduo_trajectory trajectory;
    struct ceduo_crossing crossing;
};

/* Without -ffp-exception-behavior clang may compute the untaken branch: its exceptions mean nothing. */
#ifdef __clang__
#define RAISED 0
#else
#define RAISED (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
#endif

static void follow(const struct line_scene *s, uint64_t rock, struct result *r)
{
    memset(r, 0, sizeof *r);
    LOCAL(ceduo_tracer, follower) = ceduo_tracer_create(&s->scene, NULL);
    assert_non_null(follower);
    feclearexcept(FE_ALL_EXCEPT);
    enum ceduo_status status = ceduo_tracer_run(follower, rock, NULL, &r->trajectory, &r->crossing);
    int raised = fetestexcept(RAISED) & ~by_design;
    assert_int_equal(status, CEDUO_OK);
    if (raised)
        fail_msg("seed %ju: floating-point exceptions%s%s%s", (uintmax_t)s->scene.simulation.seed,
                 raised & FE_INVALID ? " invalid" : "", raised & FE_DIVBYZERO ? " division by zero" : "",
                 raised & FE_OVERFLOW ? " overflow" : "");
}

/* Return the trajectory; a second simulation gives the same bits. */
static struct ceduo_trajectory expect_the_same_again(const struct line_scene *s, uint64_t rock)
{
    struct result a, b;
    follow(s, rock, &a);
    follow(s, rock, &b);
    EXPECT_SAME(a.trajectory, b.trajectory, end, contacts, x, z);
    const struct ceduo_crossing *c = &a.crossing, *d = &b.crossing;
    EXPECT_SAME(*c, *d, reached, vx, vz, spin, height);
    return a.trajectory;
}

/* True if two trajectories are equal within rounding. */
static bool is_close(const struct ceduo_trajectory *a, const struct ceduo_trajectory *b)
{
    return a->end == b->end && a->contacts == b->contacts && fabs(a->x - b->x) <= 1e-6 * (1 + fabs(b->x));
}

static void expect_distribution(const struct ceduo_distribution *d, uint64_t n)
{
    if (n == 0)
        return;
    assert_true(isfinite(d->mean));
    assert_true(isfinite(d->max));
    ROWS(EXPECT, (d->mean, >=, 0), (d->mean, <=, d->max * (1 + 1e-12)), (d->p50, <=, d->p95), (d->p95, <=, d->max));
    assert_true(n == 1 || (isfinite(d->se) && d->se >= 0));
}

/* Simulate the scene as a run: ends sum to the rocks, and a later control is never reached by more rocks than an earlier
 * one. */
static void expect_counts(const struct line_scene *s)
{
    struct ceduo_scene scene = s->scene;
    struct ceduo_control controls[CONTROLS];
    double x0 = scene.release.x.mean, x1 = scene.slope.x[scene.slope.vertices - 1];
    size_t n = 0;
    for (size_t i = 0; i < CONTROLS; i++) {
        controls[n] =
            (struct ceduo_control){.x = x0 + (x1 - x0) * (double)(i + 1) / CONTROLS, .accepted = 1, .measured_speed = NAN};
        n += controls[n].x > x0 && controls[n].x <= x1;
    }
    scene.controls = controls;
    scene.controls_count = n;
    struct ceduo_run_def def = ceduo_run_def_default(&scene);
    def.rocks_max = run_rocks;
    LOCAL(ceduo_run, run);
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, run_rocks), CEDUO_OK);
    struct ceduo_ends ends = read_ends(run);
    uint64_t sum = 0, before = run_rocks;
    for (int i = 0; i < CEDUO_ENDS; i++)
        sum += ends.count[i];
    assert_int_equal(sum, run_rocks);
    for (size_t i = 0; i < n; i++) {
        struct ceduo_arrivals a = read_arrivals(run, i);
        ROWS(EXPECT, (a.released, ==, run_rocks), (a.reached, <=, before), (a.exceeded, <=, a.reached),
             (a.unfinished, <=, ends.count[CEDUO_END_UNFINISHED]), (a.reached + a.unfinished, <=, run_rocks));
        ROWS(expect_distribution, (&a.speed, a.reached), (&a.energy, a.reached), (&a.height, a.reached));
        before = a.reached;
    }
}

/* ---- random scenes ---- */

TEST(random_scenes)
{
    static struct line_scene scene;
    struct invariants_tally t = {0}, of_arm = {0};
    uint64_t parted = 0;
    by_design = FE_OVERFLOW; /* one rock in millions moves at 1e-166 m/s: t2 to the next vertex is infinite, it lands before */
    for (uint64_t number = first; number < first + scenes; number++) {
        line_scene_random(&scene, number, LASTING_EVERY);
        invariants_expect(&scene, number, &t);
        if (line_scene_lasts(&scene))
            continue;
        struct ceduo_trajectory unseen = expect_the_same_again(&scene, number % 11);
        parted += !is_close(&unseen, &t.last); /* without a callback rolls pass whole segments */
        if (number % RUN_EVERY == 0)
            expect_counts(&scene);
        if (number % 4 != 0)
            continue;
        line_scene_arm(&scene, number);
        invariants_expect(&scene, number, &of_arm);
    }
    uint64_t sum = 0;
    for (int i = 0; i < CEDUO_ENDS; i++)
        sum += t.ends[i];
    assert_int_equal(sum, scenes);
    if (scenes >= 1000) /* enough scenes for statistics */
        ROWS(EXPECT, (t.flights, >, 4 * scenes), (t.impacts, >, scenes), (t.ends[CEDUO_END_AT_REST], >, scenes / 10),
             (t.ends[CEDUO_END_LEFT_SLOPE], >, scenes / 10), (t.crossed, >, scenes / 10), (of_arm.crossed, >, scenes / 40));
    print_message("%ju scenes: %ju at rest, %ju left, %ju unfinished (%ju may last, %ju sink in a crack), %ju contacts; "
                  "%ju trajectories differ without callbacks\n",
                  (uintmax_t)scenes, (uintmax_t)t.ends[CEDUO_END_AT_REST], (uintmax_t)t.ends[CEDUO_END_LEFT_SLOPE],
                  (uintmax_t)t.ends[CEDUO_END_UNFINISHED], (uintmax_t)t.lasting, (uintmax_t)t.cracks, (uintmax_t)t.contacts,
                  (uintmax_t)parted);
    EXPECT(parted, <=, 2 + scenes / 1000);
    EXPECT(t.cracks, <=, 2 + scenes / 20000);
    by_design = 0;
}

/* ---- difficult scenes ---- */

static struct line_scene s;
static const struct line_ground earth = {.rn = .35, .rt = .85, .friction = .5};

/* Set the profile; the rest follows in try_release(). */
static void profile(size_t vertices, const double *x, const double *z, struct line_ground ground, double radius)
{
    line_scene_init(&s, vertices, x, z, ground, radius, CEDUO_LAW_LUMPED);
}

static void release(double x, double height, double vx, double vz)
{
    line_scene_release(&s, x, height, vx, vz, 0);
}

/* Simulate a release: both laws, facets to either side, smooth and rough, with and without the friction bound. */
static void try_release(double from, double height, double vx, double vz)
{
    struct invariants_tally t = {0};
    uint64_t number = 0;
    release(from, height, vx, vz);
    double end = s.x[s.scene.slope.vertices - 1], x = s.scene.release.x.mean;
    s.control = (struct ceduo_control){.x = x + .75 * (end - x), .accepted = NAN, .measured_speed = NAN};
    s.scene.controls_count = s.control.x > x;
    for (int kind = 0; kind < 16; kind++) {
        s.scene.simulation.law = kind & 1 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
        s.scene.simulation.friction_bound = kind & 8;
        s.scene.slope.facets = kind & 2 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
        for (size_t j = 0; j + 1 < s.scene.slope.vertices; j++) {
            s.segments[j].roughness_m = NAN;
            s.segments[j].roughness_rad = kind & 4 ? .4 : 0;
        }
        for (uint64_t rock = 0; rock < (kind & 4 ? ROCKS : 1); rock++, number++)
            invariants_expect(&s, rock, &t);
        expect_the_same_again(&s, 1);
        expect_counts(&s);
    }
    assert_int_equal(t.ends[CEDUO_END_AT_REST] + t.ends[CEDUO_END_LEFT_SLOPE] + t.ends[CEDUO_END_UNFINISHED], number);
}

TEST(grazing_contacts)
{
    const double x[] = {0, 20, 40, 60}, z[] = {0, -10, -20, -20};
    for (double v = 1e-3; v < 100; v *= 10) {
        for (double height = 1e-15; height < 1; height *= 1e3) {
            profile(4, x, z, earth, .3);
            try_release(1, height, v, -.5 * v);
        }
        for (int ulps = -2; ulps <= 2; ulps++) { /* along the ground within the last bits */
            profile(4, x, z, earth, .3);
            try_release(1, 0, v, -.5 * v * (1 + ulps * 0x1p-52));
        }
    }
}

TEST(launch_at_a_vertex)
{
    const double x[] = {0, 3, 7, 8, 12, 30}, z[] = {0, -2, -2.5, -5, -4.5, -9};
    for (size_t i = 0; i < LENGTH(x) - 1; i++)
        for (int turn = 0; turn < 16; turn++) {
            profile(LENGTH(x), x, z, earth, .3);
            try_release(x[i], 0, 4 * cos(turn * M_PI / 8), 4 * sin(turn * M_PI / 8));
        }
}

/* With g = 8 and vx = 1 a fall of 4 m takes 1 s and 1 m, without rounding. */
TEST(flights_through_a_vertex_to_the_last_bit)
{
    for (int ulps = -1; ulps <= 1; ulps++)
        for (int peak = 0; peak < 2; peak++) {
            double at = ulps < 0 ? nextafter(4, 0) : ulps > 0 ? nextafter(4, 8) : 4;
            const double x[] = {0, .5, 1, 1.5, 20}, z[] = {4, peak ? 0 : 4 - 1.5, at - 4, -6, -30};
            profile(5, x, z, earth, .05);
            s.scene.simulation.gravity = 8;
            try_release(0, 0, 1, 0);
        }
}

TEST(corners_of_one_degree)
{
    double half = 10 * tan(.5 * M_PI / 180);
    const double notch_x[] = {0, 10, 10 + half, 10 + 2 * half, 30}, notch_z[] = {0, -3, -13, -3, -9};
    const double peak_x[] = {0, 10, 10 + half, 10 + 2 * half, 30}, peak_z[] = {0, -3, 7, -3, -9};
    for (double r = 1e-3; r <= 1; r *= 10)
        for (double v = .5; v < 20; v *= 3) {
            profile(5, notch_x, notch_z, earth, r);
            try_release(9, .5, v, 0);
            profile(5, peak_x, peak_z, earth, r);
            try_release(9, 1, v, 14);
        }
}

TEST(almost_vertical_walls)
{
    for (double run = 1e-9; run < 1e-2; run *= 100) {
        const double x[] = {0, 5, 5 + run, 20, 20 + run, 40}, z[] = {0, -2, -102, -104, -54, -60};
        for (double v = 1e-3; v < 100; v *= 10) {
            profile(6, x, z, earth, .3);
            try_release(4, 0, v, 0);
            profile(6, x, z, earth, .3);
            try_release(19, 30, v, 3);
        }
    }
}

TEST(slivers)
{
    double x[41], z[41];
    for (int down = -1; down <= 1; down++) {
        for (size_t i = 0; i <= 40; i++) {
            x[i] = i == 0 ? 0 : x[i - 1] + (i % 2 ? 1 : 1e-12);
            z[i] = i == 0 ? 0 : z[i - 1] - (i % 2 ? .5 : down * 1e-12);
        }
        for (double v = 1e-3; v < 100; v *= 10) {
            profile(41, x, z, earth, .3);
            try_release(.5, .2, v, 0);
        }
    }
}

TEST(large_coordinates)
{
    for (double size = 1e3; size <= 1e7; size *= 100) {
        const double x[] = {0, .3 * size, .31 * size, .9 * size, size};
        const double z[] = {0, -.25 * size, -.24 * size, -.6 * size, -.61 * size};
        profile(5, x, z, earth, .3);
        try_release(.299 * size, 1, 5, 0);
        profile(5, x, z, earth, .3);
        try_release(size - 3, 1, -5, 0);
    }
}

TEST(little_and_much_gravity)
{
    const double x[] = {0, 10, 20, 40, 60}, z[] = {0, -8, -12, -30, -31};
    for (double g = 1e-3; g <= 1e3; g *= 10) {
        profile(5, x, z, earth, .3);
        s.scene.simulation.gravity = g;
        try_release(1, 2, 1, 0);
    }
}

/* If all shares are 1 rocks may never stop, and count as unfinished. */
TEST(shares_of_0_and_1)
{
    const double x[] = {0, 10, 20, 30}, z[] = {0, -8, -9, -9};
    run_rocks = 2;
    for (int rn = 0; rn < 2; rn++)
        for (int rt = 0; rt < 2; rt++) {
            profile(4, x, z, (struct line_ground){rn, rt, .5}, .3);
            try_release(1, 2, 1, 0);
        }
    run_rocks = 40;
}

TEST(small_and_large_rocks)
{
    const double x[] = {0, 10, 20, 40, 60}, z[] = {0, -8, -12, -30, -31};
    for (double r = 1e-3; r <= 100; r *= 10) {
        profile(5, x, z, earth, r);
        try_release(1, .2, 1, 0);
    }
}

TEST(slow_and_fast_rocks)
{
    const double x[] = {0, 10, 20, 40, 60}, z[] = {0, -8, -12, -30, -31};
    for (double v = 1e-12; v <= 1e3; v *= 10)
        for (int turn = 0; turn < 8; turn++) {
            profile(5, x, z, earth, .3);
            try_release(15, turn & 1 ? .5 : 0, v * cos(turn * M_PI / 4), v * sin(turn * M_PI / 4));
        }
    by_design = FE_OVERFLOW | FE_INVALID;
    static const double tiny[] = {0, 5e-324, 1e-310, 1e-300, 1e-200, 1e-150};
    for (size_t i = 0; i < LENGTH(tiny); i++)
        for (int side = -1; side <= 1; side += 2) {
            profile(5, x, z, earth, .3);
            try_release(15, .5, side * tiny[i], 0);
            profile(5, x, z, earth, .3);
            try_release(20, 0, side * tiny[i], 1);
        }
    by_design = 0;
}

TEST(roughness_up_to_89_degrees)
{
    const double x[] = {0, 10, 20, 40, 60}, z[] = {0, -8, -12, -30, -31};
    static const double degrees[] = {0, 1e-9, 1, 45, 80, 89};
    struct invariants_tally t = {0};
    for (size_t i = 0; i < LENGTH(degrees); i++)
        for (int kind = 0; kind < 8; kind++) {
            profile(5, x, z, earth, .3);
            release(1, .5, 1, 0);
            s.scene.simulation.law = kind & 1 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
            s.scene.simulation.friction_bound = kind & 4;
            s.scene.slope.facets = kind & 2 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
            for (size_t j = 0; j < 4; j++) {
                s.segments[j].roughness_m = NAN;
                s.segments[j].roughness_rad = degrees[i] * M_PI / 180;
            }
            for (uint64_t rock = 0; rock < ROCKS; rock++)
                invariants_expect(&s, rock, &t);
            expect_the_same_again(&s, 3);
            expect_counts(&s);
        }
}

TEST(rebounds_without_end)
{
    const double x[] = {0, 10}, z[] = {0, 0};
    profile(2, x, z, (struct line_ground){1, 1, .5}, .1);
    release(5, 2, 0, 0);
    struct result r;
    follow(&s, 0, &r);
    EXPECT_IS(r.trajectory, (end, CEDUO_END_UNFINISHED), (contacts, CEDUO_CONTACTS_MAX), (x, 5));
}

/* Random scenes in which a rock bounces in a crack of 12 or 42 micrometres, or of 8 nanometres. It hops along one wall at
 * times, or on the bottom with Rn = 1, at which the law takes less and less: more contacts than the limit. */
TEST(cracks)
{
    static const uint64_t numbers[] = {123445, 2688044, 5280488, 8903797};
    static struct line_scene scene;
    struct invariants_tally t = {0}, bound = {0};
    for (size_t i = 0; i < LENGTH(numbers); i++) {
        line_scene_random(&scene, numbers[i], LASTING_EVERY);
        scene.scene.simulation.friction_bound = true;
        invariants_expect(&scene, numbers[i], &bound);
        scene.scene.simulation.friction_bound = false; /* found with the published laws */
        invariants_expect(&scene, numbers[i], &t);
    }
    EXPECT(t.cracks, ==, LENGTH(numbers));
    EXPECT(t.ends[CEDUO_END_UNFINISHED], ==, LENGTH(numbers));
    line_scene_random(&scene, 3596987, LASTING_EVERY); /* a crack of 60 nm, in which it rests on the wall */
    scene.scene.simulation.friction_bound = false;
    invariants_expect(&scene, 3596987, &t);
    EXPECT(t.last.end, ==, CEDUO_END_AT_REST);
}

TEST(pits)
{
    for (double width = .01; width < 20; width *= 3)
        for (double depth = .01; depth < 20; depth *= 5)
            for (int flat = 0; flat < 2; flat++) {
                const double bottom = flat ? .3 * width : 0;
                const double x[] = {0, 5, 5 + width, 5 + width + bottom + 1e-3, 6 + 2 * width + bottom, 40};
                const double z[] = {0, -1, -1 - depth, -1 - depth, -1, -5};
                profile(6, x, z, earth, .3);
                try_release(4, .1, 2, 0);
                profile(6, x, z, (struct line_ground){.2, .99, 0}, .3);
                try_release(5 + width, 0, 0, 0);
            }
}

TEST(noise_of_every_size)
{
    const double radius = .3;
    struct line_random random = {.state = 4};
    for (double scale = radius / 100; scale <= 101 * radius; scale *= 10)
        for (double height = scale / 100; height <= 1.1 * scale; height *= 10)
            for (int style = 0; style < 2; style++) {
                double x[LINE_SEGMENTS_MAX + 1], z[LINE_SEGMENTS_MAX + 1];
                for (size_t i = 0; i <= LINE_SEGMENTS_MAX; i++) {
                    x[i] = scale * (double)i;
                    z[i] = -.7 * x[i] + height * (style ? (double)(i % 2) : line_uniform(&random, -1, 1));
                }
                profile(LINE_SEGMENTS_MAX + 1, x, z, earth, radius);
                try_release(scale * 3.3, .1, 2, 0);
            }
}

/* A million segments, finer than most tools can round. */
TEST(a_million_segments)
{
    const size_t vertices = 1000001;
    struct line_random random = {.state = 6};
    double *x = malloc(vertices * sizeof *x), *z = malloc(vertices * sizeof *z);
    struct ceduo_segment *segments = malloc(vertices * sizeof *segments);
    ROWS(assert_true, (x), (z), (segments));
    const double few_x[] = {0, 500}, few_z[] = {0, -300};
    profile(2, few_x, few_z, earth, .3);
    release(1, .5, 2, 0);
    for (size_t i = 0; i < vertices; i++) {
        x[i] = 5e-4 * (double)i;
        z[i] = -.6 * x[i] + 20 * sin(x[i] / 30) + 1e-4 * line_uniform(&random, -1, 1);
        segments[i] = s.segments[0];
    }
    s.scene.slope.vertices = vertices;
    s.scene.slope.x = x;
    s.scene.slope.z = z;
    s.scene.slope.segments = segments;
    assert_int_equal(ceduo_scene_check(&s.scene, NULL), CEDUO_OK);
    s.scene.controls_count = 0;
    expect_the_same_again(&s, 2);
    expect_counts(&s);
    free(x);
    free(z);
    free(segments);
}

static int set_up(void **state)
{
    (void)state;
    scenes = FULL_OR(40000, 15000);
    if (getenv("STRESS"))
        scenes = strtoull(getenv("STRESS"), NULL, 10);
    if (getenv("STRESS_FIRST"))
        first = strtoull(getenv("STRESS_FIRST"), NULL, 10);
    return 0;
}

AROUND_TESTS(set_up, NULL);
