/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Vector kernels give the same bits as the scalar one in every figure of a run, and the speeds of the slow walk. */
#include "ceduo/simulate.h"
#include "core/runs/run.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "full.h"
#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"
#include "slow_scene.h"

#define SCENES        FULL_OR(1200u, 700u) /* in scene 689 a rock flies back to a stem before the low end, its exit */
#define LASTING_EVERY 600                  /* one scene in this many may never end */
#define CONTROLS_MAX  4
#define LONG_VERTICES 4097
#define KINDS_MAX     3 /* cohorts, classes of trees */

static const enum ceduo_kernel lanes[] = {CEDUO_KERNEL_BEST, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512};
#define LANES (sizeof lanes / sizeof lanes[0])

/* ---- comparison ---- */

static void expect_same_bits(const char *scene, const char *label, const void *a, const void *b, size_t bytes)
{
    if (memcmp(a, b, bytes) != 0)
        fail_msg("%s: other bits in %s", scene, label);
}

static void compare_control(const char *scene, const struct ceduo_run *a, const struct ceduo_run *b, size_t control)
{
    struct ceduo_arrivals p = read_arrivals(a, control);
    struct ceduo_arrivals q = read_arrivals(b, control);
    expect_same_bits(scene, "arrivals", &p, &q, sizeof p);
    static double energies[2][5000];
    size_t n = ceduo_run_energies(a, control, energies[0], 5000);
    assert_int_equal(n, ceduo_run_energies(b, control, energies[1], 5000));
    expect_same_bits(scene, "energies", energies[0], energies[1], n * sizeof(double));
    struct ceduo_difference d = ceduo_run_difference(b, a, control);
    if (ceduo_run_rocks(a) > 0 && (d.energy_per_released.mean != 0 || d.energy_per_released.se > 0))
        fail_msg("%s: a rock fares differently", scene);
}

static void compare_places(const char *scene, const struct ceduo_run *a, const struct ceduo_run *b,
                           const struct ceduo_run_def *def)
{
    for (size_t c = 0; c < def->scene->controls_count; c++)
        compare_control(scene, a, b, c);
}

static void compare(const char *scene, const struct ceduo_run *a, const struct ceduo_run *b, const struct ceduo_run_def *def)
{
    assert_int_equal(ceduo_run_rocks(a), ceduo_run_rocks(b));
    if (ceduo_run_contacts(a) != ceduo_run_contacts(b))
        fail_msg("%s: %ju contacts, scalar %ju", scene, (uintmax_t)ceduo_run_contacts(b), (uintmax_t)ceduo_run_contacts(a));
    struct ceduo_stem_counts s = ceduo_run_stems(a), t = ceduo_run_stems(b);
    expect_same_bits(scene, "stems", &s, &t, sizeof s);
    struct ceduo_ends e = read_ends(a);
    struct ceduo_ends f = read_ends(b);
    expect_same_bits(scene, "ends", &e, &f, sizeof e);
    compare_places(scene, a, b, def);
}

static struct ceduo_run *run_with(struct ceduo_run_def def, enum ceduo_kernel kernel, uint64_t first, uint64_t rocks)
{
    struct ceduo_run *run;
    def.kernel = kernel;
    def.rocks_max = rocks;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, first), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    return run;
}

/* Expect equal arrivals if trajectories end after the last control. Returns the contacts saved. */
static uint64_t expect_same_arrivals(const char *scene, const struct ceduo_run *whole, const struct ceduo_run_def *def,
                                     enum ceduo_kernel kernel)
{
    struct ceduo_run_def short_def = *def;
    short_def.arrivals_only = true;
    struct ceduo_run *run = run_with(short_def, kernel, ceduo_run_rocks(whole), ceduo_run_rocks(whole));
    EXPECT(ceduo_run_contacts(run), <=, ceduo_run_contacts(whole));
    compare_places(scene, whole, run, def);
    struct ceduo_ends ends = read_ends(run);
    EXPECT(ends.count[CEDUO_END_LEFT_SLOPE], ==, 0);
    assert_true(isnan(ends.stop_max));
    uint64_t saved = ceduo_run_contacts(whole) - ceduo_run_contacts(run);
    ceduo_run_free(run);
    return saved;
}

static uint64_t saved; /* contacts */

/* Compare runs in two steps, on one thread if scalar. Returns the contacts. */
static uint64_t expect_same(const char *scene, const struct ceduo_run_def *def, uint64_t first, uint64_t rocks)
{
    struct ceduo_run_def one = *def;
    one.threads = 1;
    struct ceduo_run *scalar = run_with(one, CEDUO_KERNEL_SCALAR, rocks, rocks);
    static unsigned long times; /* the best kernel is one of the others: sometimes is enough */
    for (size_t i = times++ % 8 > 0; i < LANES; i++) {
        LOCAL(ceduo_run, vector) = run_with(*def, lanes[i], first, rocks);
        compare(scene, scalar, vector, def);
    }
    uint64_t contacts = ceduo_run_contacts(scalar);
    saved += expect_same_arrivals(scene, scalar, &one, CEDUO_KERNEL_SCALAR);
    expect_same_arrivals(scene, scalar, def, CEDUO_KERNEL_BEST);
    ceduo_run_free(scalar);
    return contacts;
}

/* ---- random scenes ---- */

struct wild {
    struct line_scene line;
    struct ceduo_control controls[CONTROLS_MAX];
    struct paper_plot plots[2];
    struct ceduo_stems shoots[2][KINDS_MAX], trees[2][KINDS_MAX];
    struct ceduo_belt belts[2];
    struct ceduo_run_def def;
    uint64_t first, rocks;
};

static void add_spreads(struct wild *w, struct line_random *r)
{
    struct ceduo_scene *scene = &w->line.scene;
    enum ceduo_spread_kind kind = line_chance(r, 0.5) ? CEDUO_SPREAD_NORMAL : CEDUO_SPREAD_UNIFORM;
    if (line_chance(r, 0.5)) {
        scene->rock.diameter.spread = scene->rock.diameter.mean * line_uniform(r, 0.01, 0.25);
        scene->rock.diameter.kind = kind;
    }
    if (line_chance(r, 0.5)) {
        scene->release.vx.spread = line_uniform(r, 0, 3);
        scene->release.vz.spread = line_uniform(r, 0, 3);
        scene->release.spin.spread = line_uniform(r, 0, 3);
    }
    if (line_chance(r, 0.3)) {
        scene->release.height.mean += 1;
        scene->release.height.spread = 0.3;
    }
    bool rn = line_chance(r, 0.4), rt = line_chance(r, 0.4);
    for (size_t j = 0; j + 1 < scene->slope.vertices; j++) {
        if (rn)
            w->line.segments[j].rn.spread = line_uniform(r, 0, 0.2);
        if (rt)
            w->line.segments[j].rt.spread = line_uniform(r, 0, 0.2);
    }
}

static void add_places(struct wild *w, struct line_random *r)
{
    struct ceduo_scene *scene = &w->line.scene;
    double end = w->line.x[scene->slope.vertices - 1], at = scene->release.x.mean;
    scene->controls_count = (size_t)line_uniform(r, 0, CONTROLS_MAX + 0.999);
    scene->controls = w->controls;
    for (size_t i = 0; i < scene->controls_count; i++) {
        w->controls[i] = w->line.control;
        w->controls[i].x = at + (end - at) * line_uniform(r, 0.01, 1);
        w->controls[i].accepted = line_chance(r, 0.5) ? NAN : line_log_uniform(r, 1, 1e6);
    }
}

/* Add up to three kinds of stems like a pattern. */
static size_t add_kinds(struct line_random *r, const struct ceduo_stems *pattern, struct ceduo_stems kinds[KINDS_MAX])
{
    size_t n = (size_t)line_uniform(r, 0, KINDS_MAX + 0.999);
    for (size_t i = 0; i < n; i++) {
        kinds[i] = *pattern;
        kinds[i].per_ha = pattern->per_ha * line_log_uniform(r, 0.1, 2);
        kinds[i].dbh = line_uniform(r, 0.02, 0.3);
        kinds[i].group = line_chance(r, 0.5) ? pattern->group : 1;
        kinds[i].height = line_log_uniform(r, 0.3, 20);
        kinds[i].volume = line_chance(r, 0.5) ? pattern->volume : NAN;
        kinds[i].dbh_sd = line_chance(r, 0.3) ? kinds[i].dbh * line_uniform(r, 0.01, 1) : 0;
    }
    return n;
}

/* Add a plot of the paper as it is, or with several cohorts and classes, and few to very many shoots per stool. */
static void add_stand(struct wild *w, struct line_random *r, int i)
{
    struct ceduo_stand *stand = &w->plots[i].stand;
    paper_plot_init(&w->plots[i], i + 1);
    stand->energy = (enum ceduo_energy_model)line_uniform(r, CEDUO_ENERGY_MODEL_BRAUNER, CEDUO_ENERGY_MODEL_DORREN + 0.999);
    stand->offset = line_chance(r, 0.5) ? CEDUO_ENERGY_OFFSET_WHOLE : CEDUO_ENERGY_OFFSET_BY_ECCENTRICITY;
    stand->hit_below = line_chance(r, 0.3) ? line_uniform(r, 0.2, 3) : 0;
    if (line_chance(r, 0.3))
        stand->stumps = (struct ceduo_stumps){.per_ha = line_uniform(r, 1, 2000),
                                              .diameter = line_uniform(r, 0.05, 0.4),
                                              .height = line_uniform(r, 0.1, 1),
                                              .energy = line_log_uniform(r, 10, 1e4)};
    if (line_chance(r, 0.3))
        stand->logs = (struct ceduo_logs){.per_ha = line_uniform(r, 1, 300),
                                          .length = line_uniform(r, 1, 12),
                                          .diameter = line_uniform(r, 0.1, 0.8),
                                          .energy = line_log_uniform(r, 10, 1e4)};
    w->plots[i].trees.group = line_chance(r, 0.4) ? (unsigned)line_uniform(r, 2, 30) : 1;
    w->plots[i].trees.group_radius = line_chance(r, 0.2) ? 0 : line_log_uniform(r, 0.1, 40);
    if (line_chance(r, 0.3))
        return;
    stand->shoots_count = add_kinds(r, &w->plots[i].shoots, w->shoots[i]);
    stand->trees_count = add_kinds(r, &w->plots[i].trees, w->trees[i]);
    stand->shoots = w->shoots[i];
    stand->trees = w->trees[i];
    double shoots = 0;
    for (size_t k = 0; k < stand->shoots_count; k++)
        shoots += w->shoots[i][k].per_ha;
    stand->stools_per_ha = shoots / line_log_uniform(r, 1, line_chance(r, 0.2) ? 100 : 8);
}

/* Add belts, some starting before the release, so that stools stand on both sides of it. */
static void add_stems(struct wild *w, struct line_random *r)
{
    struct ceduo_scene *scene = &w->line.scene;
    double end = w->line.x[scene->slope.vertices - 1], middle = end * line_uniform(r, 0.1, 0.9);
    const double from[] = {end * line_uniform(r, 0, 0.1), middle}, to[] = {middle, end};
    for (int i = 0; i < 2; i++) {
        add_stand(w, r, i);
        w->belts[i] = (struct ceduo_belt){.from = from[i], .to = to[i], .stand = w->plots[i].stand};
    }
    w->line.option.belts = w->belts;
    w->line.option.belts_count = line_chance(r, 0.5) ? 1 : 2;
    w->def.option = &w->line.option;
    if (line_chance(r, 0.5)) { /* released in the forest, perhaps uphill */
        scene->release.x.mean = from[0] + (middle - from[0]) * line_uniform(r, 0, 1);
        scene->release.vx.mean = line_uniform(r, -8, 8);
    }
}

static void wild_init(struct wild *w, uint64_t number, bool arm)
{
    struct line_random random = {.state = number * 0x9e3779b97f4a7c15U + 5}, *r = &random;
    line_scene_random(&w->line, number, LASTING_EVERY);
    if (arm)
        line_scene_arm(&w->line, number);
    w->def = ceduo_run_def_default(&w->line.scene);
    w->def.threads = (unsigned)line_uniform(r, 1, 3.999);
    if (line_chance(r, 0.4))
        add_spreads(w, r);
    add_places(w, r);
    if (line_chance(r, 0.3))
        add_stems(w, r);
    bool long_one = line_chance(r, 0.02), lasts = line_scene_lasts(&w->line);
    w->rocks = lasts ? 2 : long_one ? 2200 : (uint64_t)line_uniform(r, 1, 90);
    w->first = (uint64_t)line_uniform(r, 0, (double)w->rocks);
}

static void compare_random_scenes(uint64_t count, bool arm)
{
    static struct wild w;
    uint64_t contacts = 0, scenes = 0;
    for (uint64_t number = 0; number < count; number++) {
        char name[40];
        snprintf(name, sizeof name, "scene %ju", (uintmax_t)number);
        wild_init(&w, number, arm);
        if (ceduo_scene_check(&w.line.scene, NULL) != CEDUO_OK)
            continue; /* a spread reaches beyond the slope */
        contacts += expect_same(name, &w.def, w.first, w.rocks);
        scenes++;
    }
    print_message("%ju scenes, %ju contacts; ending after the last control and cell saves %ju\n", (uintmax_t)scenes,
                  (uintmax_t)contacts, (uintmax_t)saved);
    ROWS(EXPECT, (saved, >, contacts / 100), (scenes, >, count * 9 / 10), (contacts, >, 500 * count));
}

TEST(random_scenes)
{
    compare_random_scenes(SCENES, false);
}

TEST(random_scenes_of_rocks_that_are_not_round)
{
    compare_random_scenes(SCENES / 2, true);
}

/* ---- particular scenes ---- */

/* All readings of the paper's site: laws, theta, facets, scaled Rn, forest, with and without the friction bound. */
TEST(the_papers_site)
{
    const uint64_t rocks = FULL_OR(3000, 320);
    for (unsigned i = 0; i < CEDUO_LAW_COUNT * 2 * 2 * 2 * 4 * 2; i++) {
        struct paper_site site;
        char name[40];
        snprintf(name, sizeof name, "paper's site %u", i);
        paper_site_init(&site);
        struct ceduo_simulation *simulation = &site.scene.simulation;
        simulation->law = (enum ceduo_law)(i % CEDUO_LAW_COUNT);
        unsigned reading = i / CEDUO_LAW_COUNT, forest = reading >> 3 & 3;
        paper_site_read_theta(&site, reading & 1 ? PAPER_HEIGHT : PAPER_ANGLE);
        site.scene.slope.facets = reading & 2 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
        simulation->scale_rn = reading & 4;
        simulation->friction_bound = reading >> 5;
        if (forest == 3)
            site.scene.rock.density = (struct ceduo_number){2600, 100, CEDUO_SPREAD_NORMAL};
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        def.option = forest == 0 ? NULL : &site.option;
        def.threads = 2;
        expect_same(name, &def, rocks / 2, rocks);
    }
}

/* Make rock and ground values, and the largest facet, vary between rocks. */
static void vary(struct ceduo_scene *scene)
{
    scene->rock.diameter.spread = .25 * scene->rock.diameter.mean;
    scene->rock.diameter.kind = CEDUO_SPREAD_UNIFORM;
    for (size_t j = 0; j + 1 < scene->slope.vertices; j++) {
        struct ceduo_segment *to = &scene->slope.segments[j];
        to->rn = (struct ceduo_number){.4, .1, CEDUO_SPREAD_NORMAL};
        to->rt = (struct ceduo_number){.9, .05, CEDUO_SPREAD_UNIFORM};
        to->roughness_rad = NAN;
        to->roughness_m = .02 + .01 * (double)(j % 5);
    }
}

/* A profile with several levels of blocks, and steep places. */
static void compare_on_a_long_profile(bool friction_bound, bool varies)
{
    static struct ceduo_segment segments[LONG_VERTICES - 1];
    static double x[LONG_VERTICES], z[LONG_VERTICES];
    struct line_random r = {.state = 3};
    for (size_t i = 0; i < LONG_VERTICES; i++) {
        x[i] = i == 0 ? 0 : x[i - 1] + line_uniform(&r, 0.05, 0.4);
        z[i] = -0.8 * x[i] + line_uniform(&r, -0.05, 0.05) + 20 * sin(x[i] / 40);
        if (line_chance(&r, 0.01))
            z[i] -= 1;
    }
    for (size_t j = 0; j + 1 < LONG_VERTICES; j++)
        segments[j] = (struct ceduo_segment){
            .rn = ceduo_number(0.4), .rt = ceduo_number(0.9), .roughness_m = NAN, .roughness_rad = 0.2, .friction = 0.4};
    for (int law = 0; law < CEDUO_LAW_COUNT; law++) {
        struct line_scene line;
        line_scene_init(&line, 2, x, z, (struct line_ground){0.4, 0.9, 0.4}, 0.3, (enum ceduo_law)law);
        line_scene_release(&line, 1, 3, 5, 0, 0);
        line.scene.slope =
            (struct ceduo_slope){.facets = CEDUO_FACETS_BOTH, .vertices = LONG_VERTICES, .x = x, .z = z, .segments = segments};
        line.control = (struct ceduo_control){.x = x[LONG_VERTICES / 2], .accepted = 1e3, .measured_speed = NAN};
        line.scene.controls_count = 1;
        line.scene.simulation.friction_bound = friction_bound;
        if (varies)
            vary(&line.scene);
        struct ceduo_run_def def = ceduo_run_def_default(&line.scene);
        EXPECT(expect_same("long profile", &def, 100, 400), >, 5000);

        static struct paper_site site; /* uphill at first, among stems; each stem restarts the search for the landing */
        double middle = x[LONG_VERTICES / 2];
        paper_site_init(&site);
        site.scene.slope = line.scene.slope;
        site.scene.simulation.law = (enum ceduo_law)law;
        site.scene.simulation.friction_bound = friction_bound;
        site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
        if (varies)
            site.scene.rock.density = (struct ceduo_number){2600, 100, CEDUO_SPREAD_NORMAL};
        site.scene.release = (struct ceduo_release){.x = ceduo_number(middle),
                                                    .height = ceduo_number(1),
                                                    .vx = ceduo_number(-25),
                                                    .vz = ceduo_number(12),
                                                    .spin = ceduo_number(0)};
        site.belts[0].from = 0;
        site.belts[0].to = site.belts[1].from = middle - 10;
        site.belts[1].to = x[LONG_VERTICES - 1];
        site.control.x = middle + 20;
        def = ceduo_run_def_default(&site.scene);
        def.option = &site.option;
        EXPECT(expect_same("uphill among stems", &def, 100, 400), >, 1000);
    }
}

TEST(a_long_profile)
{
    for (int kind = 0; kind < 4; kind++)
        compare_on_a_long_profile(kind & 1, kind & 2);
}

/* Rolls of many radii that end at a stem, at a break or at rest, on planes steeper than friction, gentler, and rising. With
 * little roughness the friction bound keeps the motion of the roll in nearly all contacts. */
TEST(rocks_that_roll_among_stems)
{
    static const double x[] = {0, 40, 55, 90, 100, 140}, z[] = {0, -28, -30, -55, -53, -75};
    uint64_t contacts = 0;
    for (unsigned kind = 0; kind < CEDUO_LAW_COUNT * 16; kind++) {
        static struct line_scene line;
        static struct paper_site site;
        char name[40];
        snprintf(name, sizeof name, "rolling rocks %u", kind);
        unsigned reading = kind / CEDUO_LAW_COUNT;
        line_scene_init(&line, LENGTH(x), x, z, (struct line_ground){.315, .835, .45}, .4,
                        (enum ceduo_law)(kind % CEDUO_LAW_COUNT));
        line_scene_release(&line, 1, 0, 1, 0, 0);
        line.scene.simulation.friction_bound = reading & 1;
        line.control = (struct ceduo_control){.x = 120, .accepted = 1e3, .measured_speed = NAN};
        line.scene.controls_count = 1;
        for (size_t j = 0; j + 1 < LENGTH(x); j++)
            line.segments[j].roughness_m = .02;
        if (reading & 2)
            vary(&line.scene);
        if (reading & 4)
            line.scene.release.vx = (struct ceduo_number){2, 1, CEDUO_SPREAD_UNIFORM};
        paper_site_init(&site);
        site.belts[1].to = site.belts[1].to_given = 140;
        line.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
        struct ceduo_run_def def = ceduo_run_def_default(&line.scene);
        def.option = reading & 8 ? &site.option : NULL;
        def.threads = 2;
        contacts += expect_same(name, &def, 500, 1500);
    }
    EXPECT(contacts, >, 1000000);
}

/* ---- comparison with the slow walk ---- */

struct facets {
    uint64_t seed, rock;
};

static double slow_draw(void *context, uint64_t contact)
{
    const struct facets *f = context;
    return line_facet_draw(f->seed, f->rock, contact);
}

/* Return the speed at the control of a rock on the paper's slope without forest, by the walk that shares no code with the
 * program; NaN: it does not arrive. */
static double slow_speed(const struct ceduo_scene *scene, uint64_t rock)
{
    struct slow_segment segments[PAPER_SEGMENTS];
    struct facets facets = {scene->simulation.seed, rock};
    struct slow_def def = slow_scene(scene, segments);
    def.uniform = slow_draw;
    def.context = &facets;
    const struct slow_trajectory trajectory = slow_walk(&def);
    return trajectory.crossing.reached ? hypot(trajectory.crossing.vx, trajectory.crossing.vz) : NAN;
}

/* Trajectories are chaotic: the rounding of doubles may change one in a hundred (test_slow_walk.c). */
TEST(lanes_match_the_slow_walk)
{
    enum { ROCKS = 500 };
    for (int law = 0; law < 2; law++)
        for (size_t k = 0; k < LANES; k++) {
            struct paper_site site;
            int equal = 0, arrive = 0;
            paper_site_init(&site);
            site.scene.simulation.law = law ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
            site.scene.release.height = ceduo_number(1);
            const struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
            LOCAL(ceduo_run, run) = run_with(def, lanes[k], ROCKS, ROCKS);
            const double *speeds = ceduo_run_samples(run, 0, CEDUO_SAMPLE_SPEED);
            for (uint64_t r = 0; r < ROCKS; r++) {
                double slow = slow_speed(&site.scene, r);
                arrive += !isnan(slow);
                equal += fabs(speeds[r] - slow) <= 1e-6 * slow || (isnan(speeds[r]) && isnan(slow));
            }
            EXPECT(arrive, >, ROCKS / 10);
            EXPECT(equal, >=, .99 * ROCKS);
        }
}

/* ---- stopping ---- */

static void *raise_soon(void *flag)
{
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    atomic_store((atomic_bool *)flag, true);
    return NULL;
}

/* Rocks that hop on level ground for ever: they see the flag on their trajectory, and the block is discarded. */
TEST(rocks_stop_at_a_raised_flag)
{
    const double x[] = {0, 1e9}, z[] = {0, 0};
    for (size_t i = 0; i < LANES; i++) {
        struct line_scene line;
        line_scene_init(&line, 2, x, z, (struct line_ground){1, 1, 0}, 0.3, CEDUO_LAW_LUMPED);
        line_scene_release(&line, 1, 3, 5, 0, 0);
        atomic_bool flag = false;
        pthread_t thread;
        struct ceduo_run_def def = ceduo_run_def_default(&line.scene);
        def.cancel = &flag;
        def.kernel = lanes[i];
        def.rocks_max = 10000;
        LOCAL(ceduo_run, run);
        assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
        assert_int_equal(pthread_create(&thread, NULL, raise_soon, &flag), 0);
        assert_int_equal(ceduo_run_extend(run, 10000), CEDUO_CANCELLED);
        pthread_join(thread, NULL);
        assert_int_equal(ceduo_run_rocks(run), 0);
        assert_int_equal(ceduo_run_contacts(run), 0);
        flag = false;
        assert_int_equal(ceduo_run_extend(run, 3), CEDUO_OK);
        LOCAL(ceduo_run, scalar) = run_with(def, CEDUO_KERNEL_SCALAR, 3, 3);
        compare("after a flag", scalar, run, &def);
        assert_int_equal(ceduo_run_contacts(run), 3 * CEDUO_CONTACTS_MAX);
    }
}
