/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program's walk and the slow one, rock by rock, with the same facet draws.
 *
 * Trajectories are chaotic: a rounding error grows from contact to contact, and a decision on the knife's edge changes the
 * rest. A difference is therefore is_excused only in three cases: - the slow walk with start, rock and draws changed by 1e-13
 * of their size differs from itself equally at the same contact; - the rock's energy was below the rounding of its height, so
 * that a double cannot tell if it passes the next vertex; - rounding alone decides the direction of a roll (Rt = 0 leaves no
 * speed along the ground). Few rocks may need an excuse. */
#include "ceduo/simulate.h"
#include "expect.h"
#include "scene/rock.h"
#include "scene/slope.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "line_scene.h"
#include "paper_site.h"
#include "slow_scene.h"

#define CONTACTS   3000 /* compared per trajectory; a longer one is cut off */
#define SAME       1e-6 /* relative difference that counts as equal */
#define SAME_FIRST 1e-9 /* the same at the first contact */
#define PERTURBED  24   /* perturbed slow walks */
#define CHANGE     1e-13
#define STILL      1e-14 /* in units of g × length: less energy than this per kilogram vanishes in the rounding of the height */

/* State of a rock after a contact. The program reports the speed of the roll if one begins. */
struct state {
    bool known, rolls;
    double v[5]; /* x, z, vx, vz, spin */
};

/* A trajectory, from either walk. */
struct trace {
    struct state after[CONTACTS + 1];
    uint64_t contacts;
    int end; /* enum ceduo_end; -1: cut off */
    double x, z;
    bool reached;
    double crossing[4]; /* vx, vz, spin, height */
};

static struct trace fast, slow, changed;

/* ---- program's walk ---- */

static void note_piece(void *context, const struct ceduo_trajectory_segment *p)
{
    struct trace *t = context;
    if (p->contacts == 0 || p->contacts > CONTACTS || t->after[p->contacts].known)
        return;
    t->after[p->contacts] = (struct state){true, p->rolls, {p->x, p->z, p->vx, p->vz, p->spin}};
}

static void trace_fast(const struct ceduo_scene *scene, uint64_t rock, struct trace *t)
{
    struct ceduo_trajectory trajectory;
    struct ceduo_crossing c;
    memset(t, 0, sizeof *t);
    assert_int_equal(ceduo_trajectory_run(scene, NULL, rock,
                                          &(struct ceduo_trajectory_callbacks){.segment = note_piece, .context = t},
                                          &trajectory, &c),
                     CEDUO_OK);
    t->contacts = trajectory.contacts;
    t->end = trajectory.contacts > CONTACTS ? -1 : (int)trajectory.end;
    t->x = trajectory.x;
    t->z = trajectory.z;
    t->reached = c.reached;
    memcpy(t->crossing, (double[4]){c.vx, c.vz, c.spin, c.height}, sizeof t->crossing);
}

/* ---- slow walk ---- */

struct slow_context {
    struct trace *t;
    uint64_t seed, rock, contact;
    struct line_random *change; /* NULL: no perturbation */
};

static double nudge(double v, struct line_random *r)
{
    return r ? v * (1 + CHANGE * line_uniform(r, -1, 1)) : v;
}

static double draw(void *context, uint64_t contact)
{
    struct slow_context *c = context;
    c->contact = contact;
    return nudge(line_facet_draw(c->seed, c->rock, contact), c->change);
}

static void note_contact(void *context, double x, double z, double vx, double vz, double spin)
{
    struct slow_context *c = context;
    if (c->contact + 1 <= CONTACTS)
        c->t->after[c->contact + 1] = (struct state){true, false, {x, z, vx, vz, spin}};
}

/* Return the height that rounds to that of the ground at x, for a rock that lies on it. */
static double on_ground(const struct ceduo_slope *s, double x)
{
    size_t j = ceduo_slope_segment(s, x);
    long double m = ((long double)s->z[j + 1] - s->z[j]) / ((long double)s->x[j + 1] - s->x[j]);
    return (double)(s->z[j] + m * ((long double)x - s->x[j]));
}

static void trace_slow(const struct ceduo_scene *scene, uint64_t rock, struct line_random *change, struct trace *t)
{
    static struct slow_segment segments[LINE_SEGMENTS_MAX];
    const struct ceduo_slope *slope = &scene->slope;
    struct slow_context context = {t, scene->simulation.seed, rock, 0, change};
    struct slow_def def = slow_scene(scene, segments);
    memset(t, 0, sizeof *t);
    def.uniform = draw;
    def.context = &context;
    def.max_contacts = CONTACTS;
    def.on_contact = note_contact;
    def.x0 = nudge(def.x0, change);
    const double height = scene->release.height.mean;
    def.z0 = height > 0 ? ceduo_slope_height(slope, def.x0) + nudge(height, change) : on_ground(slope, def.x0);
    double *others[] = {&def.gravity, &def.radius, &def.vx0, &def.vz0, &def.spin0};
    for (size_t i = 0; i < LENGTH(others); i++)
        *others[i] = nudge(*others[i], change);
    const struct slow_trajectory trajectory = slow_walk(&def);
    const struct slow_crossing *c = &trajectory.crossing;
    static const int ends[] = {[SLOW_REST] = CEDUO_END_AT_REST, [SLOW_LEFT] = CEDUO_END_LEFT_SLOPE, [SLOW_UNFINISHED] = -1};
    t->end = ends[trajectory.end];
    t->contacts = t->end < 0 ? CONTACTS + 1 : trajectory.contacts;
    t->x = trajectory.x;
    t->z = trajectory.z;
    t->reached = c->reached;
    memcpy(t->crossing, (double[4]){c->vx, c->vz, c->spin, c->height}, sizeof t->crossing);
}

/* ---- comparison ---- */

struct sizes {
    double length, speed, radius, k;
};

static double larger(double a, double b)
{
    return isnan(a) || isnan(b) ? INFINITY : fmax(a, b);
}

/* Compare the speed with which the contact that left with b begins a roll, with that of the roll a. */
static double roll_distance(const struct state *a, const struct state *b, const struct sizes *s)
{
    double u = hypot(a->v[2], a->v[3]);
    if (!(u > 0))
        return 0;
    double along = (b->v[2] * a->v[2] + b->v[3] * a->v[3]) / u;
    double spin = (a->v[2] > 0 ? 1 : -1) * s->k * b->v[4] * s->radius;
    return fabs(u - (along + spin) / (1 + s->k));
}

/* Return the distance of two states relative to their sizes; only the first may be a roll. */
static double distance(const struct state *a, const struct state *b, const struct sizes *s)
{
    double d = larger(fabs(a->v[0] - b->v[0]), fabs(a->v[1] - b->v[1])) / s->length;
    if (a->rolls)
        return larger(d, roll_distance(a, b, s) / s->speed);
    for (int i = 2; i < 4; i++)
        d = larger(d, fabs(a->v[i] - b->v[i]) / s->speed);
    return larger(d, fabs(a->v[4] - b->v[4]) * s->radius / s->speed);
}

/* Return the contact at which two traces differ by more than `limit`, and set the distance; contacts + 1 means the end and the
 * control; 0: they agree. A contact of only one of them is an infinite distance. */
static uint64_t find_difference(const struct trace *a, const struct trace *b, const struct sizes *s, double limit,
                                double *difference)
{
    uint64_t n = a->contacts < b->contacts ? a->contacts : b->contacts;
    n = n < CONTACTS ? n : CONTACTS;
    for (uint64_t i = 1; i <= n; i++) {
        *difference = a->after[i].known && b->after[i].known ? distance(&a->after[i], &b->after[i], s) : 0;
        if (!(*difference <= limit))
            return i;
    }
    *difference = INFINITY;
    if (a->end < 0 && b->end < 0) /* both cut off, at their own places */
        return 0;
    if (a->end != b->end || a->reached != b->reached || (a->end >= 0 && a->contacts != b->contacts))
        return n + 1;
    *difference = larger(fabs(a->x - b->x), fabs(a->z - b->z)) / s->length;
    if (a->reached) {
        *difference = larger(*difference,
                             larger(fabs(a->crossing[0] - b->crossing[0]), fabs(a->crossing[1] - b->crossing[1])) / s->speed);
        *difference = larger(*difference, fabs(a->crossing[2] - b->crossing[2]) * s->radius / s->speed);
        *difference = larger(*difference, fabs(a->crossing[3] - b->crossing[3]) / s->length);
    }
    return *difference <= limit ? 0 : n + 1;
}

/* True if perturbations of rounding size make the slow walk differ from itself by the same distance, no later. */
static bool is_excused(const struct ceduo_scene *scene, uint64_t rock, const struct sizes *s, uint64_t at, double difference)
{
    struct line_random r = {.state = rock + 99};
    for (int i = 0; i < PERTURBED; i++) {
        double d;
        trace_slow(scene, rock, &r, &changed);
        uint64_t parted = find_difference(&slow, &changed, s, fmin(difference / 10, 1e-3), &d);
        if (parted != 0 && parted <= at)
            return true;
    }
    return false;
}

/* Return the slow walk's last contact before the difference; NULL if there is none. */
static const struct state *last_before(uint64_t at)
{
    uint64_t i = at - 1 < CONTACTS ? at - 1 : CONTACTS;
    while (i > 0 && !slow.after[i].known)
        i--;
    return i > 0 ? &slow.after[i] : NULL;
}

/* True if the rock had hardly any energy left there. */
static bool is_still(const struct ceduo_scene *scene, const struct sizes *s, uint64_t at)
{
    const struct state *last = last_before(at);
    if (!last)
        return false;
    double u2 = last->v[2] * last->v[2] + last->v[3] * last->v[3] + last->v[4] * last->v[4] * s->radius * s->radius;
    return u2 / 2 < STILL * scene->simulation.gravity * s->length;
}

/* True if the rock left along the normal of the ground, so that its roll begins at speed 0. */
static bool is_aimless(const struct ceduo_scene *scene, uint64_t at)
{
    const struct state *last = last_before(at);
    if (!last || last->v[4] != 0)
        return false;
    const struct ceduo_slope *p = &scene->slope;
    size_t j = ceduo_slope_segment(p, last->v[0]);
    double dx = p->x[j + 1] - p->x[j], dz = p->z[j + 1] - p->z[j];
    double along = (last->v[2] * dx + last->v[3] * dz) / hypot(dx, dz);
    return fabs(along) <= 1e-15 * hypot(last->v[2], last->v[3]);
}

static struct sizes read_sizes(const struct ceduo_scene *scene)
{
    const struct ceduo_slope *p = &scene->slope;
    struct ceduo_rock body;
    struct sizes s = {.length = 1};
    assert_int_equal(ceduo_rock_from_means(&scene->rock, &body), CEDUO_OK);
    double low = 0, high = 0;
    for (size_t i = 0; i < p->vertices; i++) {
        s.length = fmax(s.length, fmax(p->x[i], fabs(p->z[i])));
        low = fmin(low, p->z[i]);
        high = fmax(high, p->z[i]);
    }
    const struct ceduo_release *r = &scene->release;
    s.radius = body.radius;
    s.k = scene->simulation.law == CEDUO_LAW_CRSP ? body.k : 0;
    s.speed = 1 + hypot(r->vx.mean, r->vz.mean) + fabs(r->spin.mean) * s.radius +
              sqrt(2 * scene->simulation.gravity * (high - low + r->height.mean));
    return s;
}

struct tally {
    uint64_t rocks, same, excused, still, aimless, cut_short, contacts, first_apart;
};

static void compare(const struct ceduo_scene *scene, uint64_t rock, struct tally *tally)
{
    struct sizes s = read_sizes(scene);
    double difference;
    trace_fast(scene, rock, &fast);
    trace_slow(scene, rock, NULL, &slow);
    tally->rocks++;
    tally->contacts += slow.contacts;
    tally->cut_short += slow.end < 0;
    uint64_t at = find_difference(&fast, &slow, &s, SAME, &difference);
    if (at == 0 && fast.after[1].known && slow.after[1].known && distance(&fast.after[1], &slow.after[1], &s) > SAME_FIRST) {
        at = 1;
        difference = SAME_FIRST;
    }
    if (at == 0) {
        tally->same++;
        return;
    }
    tally->first_apart += at == 1;
    if (is_still(scene, &s, at)) {
        tally->still++;
        return;
    }
    if (is_aimless(scene, at)) {
        tally->aimless++;
        return;
    }
    if (!is_excused(scene, rock, &s, at, difference))
        fail_msg("seed %ju rock %ju: parts at contact %ju of %ju and %ju by %g", (uintmax_t)scene->simulation.seed,
                 (uintmax_t)rock, (uintmax_t)at, (uintmax_t)fast.contacts, (uintmax_t)slow.contacts, difference);
    tally->excused++;
}

static void expect_agreement(const struct tally *t, const char *label)
{
    print_message("%s: %ju rocks, %ju contacts: %ju the same, %ju apart by growth of rounding (%ju at the first contact), "
                  "%ju with no more energy than rounding, %ju sent off by rounding alone; %ju longer than %d contacts\n",
                  label, (uintmax_t)t->rocks, (uintmax_t)t->contacts, (uintmax_t)t->same, (uintmax_t)t->excused,
                  (uintmax_t)t->first_apart, (uintmax_t)t->still, (uintmax_t)t->aimless, (uintmax_t)t->cut_short, CONTACTS);
    ROWS(EXPECT, (t->same + t->excused + t->still + t->aimless, ==, t->rocks), ((double)t->same, >=, .99 * (double)t->rocks),
         ((double)t->first_apart, <=, .001 * (double)t->rocks));
}

/* Laws, facets and readings of theta, each with and without the friction bound. */
TEST(sixteen_combinations_on_the_slope_of_table_3)
{
    static struct paper_site site;
    for (int i = 0; i < 16; i++) {
        paper_site_init(&site);
        paper_site_read_theta(&site, i & 1 ? PAPER_HEIGHT : PAPER_ANGLE);
        site.scene.slope.facets = i & 2 ? CEDUO_FACETS_BOTH : CEDUO_FACETS_AGAINST;
        site.scene.simulation.law = i & 4 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED;
        site.scene.simulation.friction_bound = i & 8;
        struct tally tally = {0};
        for (uint64_t rock = 0; rock < 300; rock++)
            compare(&site.scene, rock, &tally);
        static const char *const names[] = {"lumped against angle", "lumped against height", "lumped both angle",
                                            "lumped both height",   "crsp against angle",    "crsp against height",
                                            "crsp both angle",      "crsp both height"};
        char name[64];
        snprintf(name, sizeof name, "%s%s", names[i & 7], i & 8 ? ", friction bound" : "");
        expect_agreement(&tally, name);
    }
}

/* line_scene_random() draws the bound; here it is set for every scene. */
static void compare_random_scenes(bool friction_bound, const char *label)
{
    static struct line_scene scene;
    struct tally tally = {0};
    for (uint64_t number = 0; number < 3000; number++) {
        line_scene_random(&scene, number, 0);
        scene.scene.simulation.friction_bound = friction_bound;
        compare(&scene.scene, number % 7, &tally);
    }
    expect_agreement(&tally, label);
}

TEST(random_scenes)
{
    compare_random_scenes(false, "random scenes");
    compare_random_scenes(true, "random scenes, friction bound");
}
