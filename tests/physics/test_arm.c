/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The impact of a rock that is not round: closed forms, and a calculation that follows the impulse in small steps. */
#include "ceduo/simulate.h"
#include "expect.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdbool.h>

#include "core/walk/law_arm.h"
#include "line_scene.h"

#define BLOWS   1000000
#define STEPPED 1500
#define ROCKS   20000

/* An impact in plain units: half-axes and R, rotation of the section, ground, and incoming motion. */
struct blow {
    double a, b, radius, turn, e, mu, friction;
    struct impact in;
};

static struct impact apply_impact(const struct blow *c)
{
    double k2 = (c->a * c->a + c->b * c->b) / 5, gyration = sqrt(k2);
    struct ground_point at = {
        .rn = c->e,
        .mu = c->mu,
        .friction = c->friction,
        .sine = sin(c->turn),
        .cosine = cos(c->turn),
        .section = {.wide = c->a * c->a / k2, .high = c->b * c->b / k2, .reach = c->radius / gyration, .gyration = gyration}};
    return law_arm.struck(c->in, &at);
}

static double compute_energy(const struct blow *c, struct impact v)
{
    double k2 = (c->a * c->a + c->b * c->b) / 5;
    return v.vn * v.vn + v.vt * v.vt + k2 * v.spin * v.spin;
}

static struct blow random_blow(struct line_random *r)
{
    double radius = line_log_uniform(r, 0.05, 2), ratio = line_uniform(r, 1, 5);
    double a = 2 * radius * ratio / (1 + ratio), b = a / ratio;
    bool high = line_chance(r, 0.5);
    return (struct blow){.a = high ? b : a,
                         .b = high ? a : b,
                         .radius = radius * line_uniform(r, 0.8, 1.2), /* other pairs of axes count as well */
                         .turn = line_uniform(r, -M_PI / 2, M_PI / 2),
                         .e = line_chance(r, 0.1)   ? 0
                              : line_chance(r, 0.1) ? 1
                                                    : line_uniform(r, 0, 1),
                         .mu = line_chance(r, 0.1) ? 0 : line_uniform(r, 0, 3),
                         .friction = line_chance(r, 0.3) ? 0 : line_uniform(r, 0, 2),
                         .in = {.vn = line_chance(r, 0.1) ? 0 : line_uniform(r, 0, 20),
                                .vt = line_chance(r, 0.1) ? 0 : line_uniform(r, -30, 30),
                                .spin = line_chance(r, 0.1) ? 0 : line_uniform(r, -30, 30) / radius}};
}

/* ---- closed forms ---- */

TEST(a_round_rock_that_sticks)
{
    struct line_random r = {.state = 1};
    for (int i = 0; i < 1000; i++) {
        double radius = line_log_uniform(&r, 0.05, 2), vn = line_uniform(&r, 1, 20), e = line_uniform(&r, 0, 1);
        double vt = line_uniform(&r, -1, 1) * vn, spin = line_uniform(&r, -1, 1) * vn / radius, k = 0.4;
        struct blow c = {radius, radius, radius, line_uniform(&r, -1.5, 1.5), e, 3, 0, {vn, vt, spin}};
        struct impact out = apply_impact(&c);
        double along = (vt + k * spin * radius) / (1 + k);
        ROWS(EXPECT_NEAR, (out.vt, along, 1e-14 * vn), (out.spin * radius, along, 1e-14 * vn), (out.vn, e * vn, 1e-14 * vn));
        c.in.vt = -vt;
        c.in.spin = -spin;
        c.turn = -c.turn;
        struct impact mirror = apply_impact(&c);
        EXPECT_IS(mirror, (vt, -out.vt), (spin, -out.spin));
        EXPECT(mirror.vn, ==, out.vn);
    }
}

/* Arm and speed of the contact point in plain units; positive spin rolls forward. */
struct point {
    double r, h, k2, un, ut;
};

static struct point contact_point(const struct blow *c, struct impact v, double vn)
{
    struct point p = {.k2 = (c->a * c->a + c->b * c->b) / 5};
    p.h = sqrt(c->a * c->a * sin(c->turn) * sin(c->turn) + c->b * c->b * cos(c->turn) * cos(c->turn));
    p.r = (c->a * c->a - c->b * c->b) * sin(c->turn) * cos(c->turn) / p.h;
    if (!(-c->in.vn - c->in.spin * p.r < 0)) {
        p.r = 0;
        p.h = c->radius;
    }
    p.un = vn - v.spin * p.r;
    p.ut = v.vt - v.spin * p.h;
    return p;
}

TEST(without_friction_only_the_normal_impulse_acts)
{
    struct line_random r = {.state = 2};
    for (int i = 0; i < 10000; i++) {
        struct blow c = random_blow(&r);
        c.mu = c.friction = 0;
        struct impact out = apply_impact(&c);
        struct point p = contact_point(&c, c.in, -c.in.vn);
        double impulse = -(1 + c.e) * p.un / (1 + p.r * p.r / p.k2), size = sqrt(compute_energy(&c, c.in)) * 1e-14;
        EXPECT_NEAR(out.vn, fmax(0, -c.in.vn + impulse), size); /* a second impact stops the centre */
        EXPECT_NEAR(out.vt, c.in.vt, size);
        EXPECT_NEAR(out.spin * sqrt(p.k2), (c.in.spin - p.r * impulse / p.k2) * sqrt(p.k2), size);
    }
}

/* A round rock that slips freely: the moment impulse of rolling friction is at most friction R times the normal impulse. It
 * acts against the spin and never reverses it. */
TEST(rolling_friction_takes_spin)
{
    struct line_random r = {.state = 3};
    int held = 0;
    for (int i = 0; i < 10000; i++) {
        double radius = line_log_uniform(&r, 0.05, 2), vn = line_uniform(&r, 1, 20), e = line_uniform(&r, 0, 1);
        double spin = line_uniform(&r, -5, 5) * vn / radius, friction = line_uniform(&r, 0, 1);
        struct blow c = {radius, radius, radius, line_uniform(&r, -1.5, 1.5), e, 0, friction, {vn, vn, spin}};
        struct impact out = apply_impact(&c);
        double max = friction * radius * (1 + e) * vn / (0.4 * radius * radius), rest = fmax(fabs(spin) - max, 0);
        EXPECT_NEAR(out.spin * radius, copysign(rest, spin) * radius, 1e-13 * vn);
        EXPECT_NEAR(out.vt, vn, 1e-14 * vn);
        held += rest == 0;
    }
    EXPECT(held, >, 1000);
    EXPECT(held, <, 9000);
}

TEST(a_sticking_point_without_bounce_stops)
{
    struct line_random r = {.state = 3};
    int still = 0;
    for (int i = 0; i < 10000; i++) {
        struct blow c = random_blow(&r);
        c.e = c.friction = 0;
        c.mu = 3;
        c.in.vn = 10;
        c.in.vt = line_uniform(&r, -10, 10);
        c.in.spin = line_uniform(&r, -5, 5) / c.radius;
        struct impact out = apply_impact(&c);
        struct point p = contact_point(&c, out, out.vn);
        if (out.vn == 0)
            continue; /* the centre still moved down: there was a second impact */
        EXPECT_NEAR(p.un, 0, 1e-13);
        EXPECT_NEAR(p.ut, 0, 1e-13);
        still++;
    }
    EXPECT(still, >, 500);
}

/* A round rock without bounce lands again and again after a short free fall. If both frictions hold, an impact keeps 1/(1 + k)
 * of its speed and no spin: its speed stays below 1/k of the gain in one fall. It stops however short the fall; on steeper
 * ground it accelerates. */
TEST(a_rock_stops_if_both_frictions_hold_it)
{
    struct line_random r = {.state = 4};
    for (int i = 0; i < 2000; i++) {
        struct blow c = random_blow(&r);
        c.a = c.b = c.radius;
        c.e = 0;
        double min = fmin(c.mu, c.friction), slope = line_uniform(&r, 0, 3), vt = 0, spin = 0;
        if (fabs(slope - min) < 0.01)
            continue;
        for (int n = 0; n < 2000; n++) {
            c.in = (struct impact){.vn = 1, .vt = vt + slope, .spin = spin};
            struct impact out = apply_impact(&c);
            EXPECT(out.vn, ==, 0);
            vt = out.vt;
            spin = out.spin;
        }
        if (slope < min)
            EXPECT(vt, <=, 2.5 * slope * (1 + 1e-12));
        else
            EXPECT(vt, >, 2);
    }
}

/* ---- energy ---- */

TEST(no_arm_impact_gains_energy)
{
    struct line_random r = {.state = 5};
    for (int i = 0; i < BLOWS; i++) {
        struct blow c = random_blow(&r);
        struct impact out = apply_impact(&c);
        EXPECT(out.vn, >=, 0);
        EXPECT(compute_energy(&c, out), <=, compute_energy(&c, c.in) * (1 + 1e-13));
    }
}

/* ---- numerical integration ---- */

/* Follow an impact in small steps of the normal impulse. A step is shortened if the slip ends or the normal speed reverses.
 * With `newton` restitution is by speed, otherwise by work. */
struct stepper {
    long double vt, vn, spin, r, h, k2, mu;
    long double impulse, work, compression;
};

static long double normal_speed(const struct stepper *s)
{
    return s->vn - s->spin * s->r;
}

static long double slip_speed(const struct stepper *s)
{
    return s->vt - s->spin * s->h;
}

/* Return the friction per normal impulse. */
static long double compute_friction(const struct stepper *s)
{
    long double nt = s->r * s->h / s->k2, tt = 1 + s->h * s->h / s->k2, ut = slip_speed(s);
    if (fabsl(ut) > 1e-15L)
        return ut > 0 ? -s->mu : s->mu;
    return fmaxl(-s->mu, fminl(s->mu, -nt / tt));
}

static void step(struct stepper *s, long double dp, long double friction)
{
    long double before = normal_speed(s);
    s->vn += dp;
    s->vt += friction * dp;
    s->spin -= (s->r * dp + s->h * friction * dp) / s->k2;
    s->work += (before + normal_speed(s)) / 2 * dp;
    s->impulse += dp;
}

/* Return the largest step with constant friction. */
static long double until_slip_ends(const struct stepper *s, long double friction, long double dp)
{
    long double ut = slip_speed(s);
    struct stepper next = *s;
    step(&next, dp, friction);
    if (fabsl(ut) > 1e-15L && ut * slip_speed(&next) < 0)
        return dp * ut / (ut - slip_speed(&next));
    return dp;
}

static void follow(struct stepper *s, long double e, bool newton)
{
    long double start = normal_speed(s), dp = fmaxl(fabsl(start), fabsl(slip_speed(s))) / 500;
    bool restores = false;
    while (start < 0) {
        long double friction = compute_friction(s), d = until_slip_ends(s, friction, dp), un = normal_speed(s);
        struct stepper next = *s;
        step(&next, d, friction);
        if (!restores && un < 0 && normal_speed(&next) >= 0) {
            step(s, d * un / (un - normal_speed(&next)), friction);
            s->compression = s->work;
            restores = true;
            if (e == 0)
                return;
            continue;
        }
        bool done = newton ? normal_speed(&next) >= -e * start : next.work >= s->compression * (1 - e * e);
        if (restores && done) {
            long double lo = 0, hi = d;
            for (int i = 0; i < 60; i++) {
                long double middle = (lo + hi) / 2;
                next = *s;
                step(&next, middle, friction);
                bool far = newton ? normal_speed(&next) >= -e * start : next.work >= s->compression * (1 - e * e);
                *(far ? &hi : &lo) = middle;
            }
            step(s, hi, friction);
            return;
        }
        *s = next;
        if (fabsl(slip_speed(s)) < 1e-15L) /* exactly 0, so that it sticks */
            s->vt -= slip_speed(s);
    }
}

/* Minimise the energy by the impulses along the ground and the moment, within bounds: one at a time, many times. */
static void minimise_energy(struct stepper *s, long double h, long double lo, long double hi, long double max)
{
    long double along = 0, moment = 0, vt = s->vt, spin = -s->spin;
    for (int i = 0; i < 20000; i++) {
        long double last = along;
        long double free = -(vt + h * (spin + moment / s->k2)) / (1 + h * h / s->k2);
        along = fmaxl(lo, fminl(hi, free));
        moment = fmaxl(-max, fminl(max, -(s->k2 * spin + h * along)));
        if (i > 10 && fabsl(along - last) < 1e-17L)
            break;
    }
    s->vt = vt + along;
    s->spin = -(spin + (h * along + moment) / s->k2);
}

static struct stepper make_stepper(const struct blow *c)
{
    struct point p = contact_point(c, c->in, -c->in.vn);
    return (struct stepper){.vt = c->in.vt, .vn = -c->in.vn, .spin = c->in.spin, .r = p.r, .h = p.h, .k2 = p.k2, .mu = c->mu};
}

static struct stepper integrate_impact(const struct blow *c)
{
    struct stepper s = make_stepper(c);
    follow(&s, c->e, false);
    minimise_energy(&s, s.h, 0, 0, c->friction * c->radius * s.impulse);
    long double down = fmaxl(0, -s.vn);
    s.vn += down;
    if (down > 0)
        minimise_energy(&s, c->radius, -s.mu * down, s.mu * down, c->friction * c->radius * down);
    return s;
}

TEST(impacts_equal_integration_in_small_steps)
{
    struct line_random r = {.state = 6};
    for (int i = 0; i < STEPPED; i++) {
        struct blow c = random_blow(&r);
        struct impact out = apply_impact(&c);
        struct stepper s = integrate_impact(&c);
        double size = sqrt(compute_energy(&c, c.in)) * 1e-8;
        ROWS(EXPECT_NEAR, (out.vn, (double)s.vn, size), (out.vt, (double)s.vt, size),
             (out.spin * c.radius, (double)s.spin * c.radius, size));
    }
}

/* If the slip reverses, restitution by speed may return more energy than came in (Kane's paradox); by work it never does. */
TEST(restitution_by_speed_would_gain_energy)
{
    struct line_random r = {.state = 7};
    int gains = 0;
    for (int i = 0; i < STEPPED; i++) {
        struct blow c = random_blow(&r);
        c.friction = 0;
        c.e = 0.95;
        struct stepper s = make_stepper(&c);
        follow(&s, c.e, true);
        double k2 = (double)s.k2, before = compute_energy(&c, c.in);
        double after = (double)(s.vn * s.vn + s.vt * s.vt + s.k2 * s.spin * s.spin);
        if (!(after > before * (1 + 1e-9)) || !(k2 > 0))
            continue;
        gains++;
        EXPECT(compute_energy(&c, apply_impact(&c)), <=, before * (1 + 1e-13));
    }
    EXPECT(gains, >, 0);
    print_message("%d of %d blows would gain energy\n", gains, STEPPED);
}

/* ---- trajectories ---- */

struct drop {
    struct blow blow;
    double axes[3];
};

static double speed_off(double turn, void *context)
{
    struct blow c = *(const struct blow *)context;
    c.turn = turn;
    return apply_impact(&c).vn;
}

/* Return the mean over the pairs of axes and all rotations. */
static double mean_speed_off(const struct drop *d)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    double sum = 0;
    for (int pair = 0; pair < 3; pair++) {
        struct blow c = d->blow;
        double mean, error;
        c.a = d->axes[pair] / 2;
        c.b = d->axes[(pair + 1) % 3] / 2;
        gsl_function f = {.function = speed_off, .params = &c};
        gsl_integration_qag(&f, 0, M_PI, 1e-6, 1e-6, 1000, GSL_INTEG_GAUSS21, space, &mean, &error);
        sum += mean / M_PI / 3;
    }
    gsl_integration_workspace_free(space);
    return sum;
}

/* A long rock that falls on level ground, almost weightless, so that a slow one still flies off. */
TEST(speed_after_an_impact_is_the_mean_over_all_rotations)
{
    static struct line_scene s;
    static struct line_trace trace;
    const struct drop d = {.blow = {.radius = 0.4, .e = 0.4, .mu = 0.5, .friction = 0.3, .in = {.vn = 8, .vt = 6, .spin = 5}},
                           .axes = {1.2, 0.8, 0.4}};
    const double x[] = {0, 1e6}, z[] = {0, 0};
    line_scene_init(&s, 2, x, z, (struct line_ground){0.4, 0.9, 0.3}, 0.4, CEDUO_LAW_ARM);
    line_scene_release(&s, 10, 0.01, 6, -8, 5);
    s.segments[0].mu = 0.5;
    s.scene.rock.shape = CEDUO_SHAPE_ELLIPSOID;
    for (int i = 0; i < 3; i++)
        s.scene.rock.axes[i] = ceduo_number(d.axes[i]);
    s.scene.simulation.gravity = 1e-9;
    double sum = 0, squares = 0;
    for (uint64_t rock = 0; rock < ROCKS; rock++) {
        trace.count = 0;
        struct ceduo_trajectory_callbacks watch = {.segment = line_keep_piece, .context = &trace};
        assert_int_equal(ceduo_trajectory_run(&s.scene, NULL, rock, &watch, &trace.trajectory, &trace.crossing), CEDUO_OK);
        double vz = trace.pieces[1].rolls ? 0 : trace.pieces[1].vz;
        sum += vz;
        squares += vz * vz;
    }
    double mean = sum / ROCKS, sd = sqrt(squares / ROCKS - mean * mean);
    EXPECT_NEAR(mean, mean_speed_off(&d), 4 * sd / sqrt(ROCKS));
    EXPECT(sd, >, 0.5);
}
