/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Impacts of the laws lumped and crsp with the friction bound: rules for a million random impacts of each. Golden values are in
 * test_golden.c. */
#include "expect.h"

#include <math.h>

#include "core/walk/strike.h"
#include "line_scene.h"

#define IMPACTS  1000000
#define ROUNDING 1e-14

/* Ground, rock and an impact, in the axes of the facet. */
struct blow {
    struct ground_point at;
    struct impact in;
};

static struct blow random_blow(struct line_random *r, const struct contact_law *law)
{
    double radius = line_log_uniform(r, .005, 5), speed = line_log_uniform(r, 1e-3, 100);
    return (struct blow){.at = {.rn = line_chance(r, .1)   ? 0
                                      : line_chance(r, .1) ? 1
                                                           : line_uniform(r, 0, 1),
                                .rt = line_chance(r, .1)   ? 0
                                      : line_chance(r, .1) ? 1
                                                           : line_uniform(r, 0, 1),
                                .radius = radius,
                                .k = line_uniform(r, .1, .8),
                                .scale_rn = line_chance(r, .3),
                                .friction = line_chance(r, .1) ? 0 : line_uniform(r, 0, 2)},
                         .in = {.vn = line_chance(r, .2) ? 0 : speed * line_log_uniform(r, 1e-4, 10),
                                .vt = line_chance(r, .1) ? 0 : speed * line_uniform(r, -1, 1),
                                .spin = !law->spins || line_chance(r, .2) ? 0 : speed * line_uniform(r, -2, 2) / radius}};
}

/* Apply a law to an impact on the segment itself, with an unturned facet. */
static struct impact strike_flat(const struct contact_law *law, const struct blow *b, bool bound)
{
    struct ground_point at = b->at;
    double spin = b->in.spin;
    at.bound = bound;
    struct velocity out = strike(law, &at, 0, 1, (struct velocity){.along = b->in.vt, .off = -b->in.vn}, &spin);
    return (struct impact){.vn = out.off, .vt = out.along, .spin = spin};
}

static const struct contact_law *const laws[] = {&law_lumped, &law_crsp};

/* Return the energy per half of the mass. The lumped law has no rotation. */
static double energy(const struct contact_law *law, const struct ground_point *at, double along, double off, double spin)
{
    double rim = law->spins ? spin * at->radius : 0;
    return along * along + off * off + at->k * rim * rim;
}

/* On facets turned to either side, up to a right angle. */
TEST(no_impact_gains_energy)
{
    struct line_random r = {.state = 1};
    for (size_t l = 0; l < LENGTH(laws); l++)
        for (int i = 0; i < IMPACTS; i++) {
            struct blow b = random_blow(&r, laws[l]);
            double angle = line_chance(&r, .2) ? 0 : line_uniform(&r, -1.57, 1.57), sine = sin(angle), cosine = cos(angle);
            struct velocity v = {.along = b.in.vt, .off = -b.in.vn};
            facet_struck(false, v, &sine, &cosine);
            double before = energy(laws[l], &b.at, v.along, v.off, b.in.spin);
            for (int bound = 0; bound <= 1; bound++) {
                double spin = b.in.spin;
                b.at.bound = bound;
                struct velocity out = strike(laws[l], &b.at, sine, cosine, v, &spin);
                EXPECT(energy(laws[l], &b.at, out.along, out.off, spin), <=, before * (1 + ROUNDING));
                EXPECT(out.off, >=, 0);
            }
        }
}

/* Return the loss of speed along the facet, in the incoming direction. */
static double loss(struct impact in, struct impact out)
{
    return fabs(in.vt) - copysign(1, in.vt) * out.vt;
}

/* If the law takes at most friction times the normal impulse, its bits stay. Otherwise the loss is this bound, the rock keeps
 * its direction, and its spin follows the impulse towards rolling, never past it. The normal speed is always the law's. */
TEST(friction_bounds_the_loss_along_the_facet)
{
    struct line_random r = {.state = 2};
    for (size_t l = 0; l < LENGTH(laws); l++) {
        int binds = 0, rolls = 0;
        for (int i = 0; i < IMPACTS; i++) {
            struct blow b = random_blow(&r, laws[l]);
            struct impact in = b.in, law = strike_flat(laws[l], &b, false), out = strike_flat(laws[l], &b, true);
            double max = b.at.friction * (in.vn + law.vn), rounding = ROUNDING * (fabs(in.vt) + max);
            EXPECT(out.vn, ==, law.vn);
            if (in.vt != 0)
                EXPECT(loss(in, out), <=, max + rounding);
            if (in.vt == 0 || fabs(in.vt) - fabs(law.vt) <= max) {
                EXPECT_SAME(out, law, vt, spin);
                continue;
            }
            binds++;
            EXPECT_NEAR(loss(in, out), max, rounding);
            EXPECT(in.vt * out.vt, >=, 0);
            EXPECT(fabs(out.vt), >=, fabs(law.vt));
            if (!laws[l]->spins) {
                EXPECT(out.spin, ==, 0);
                continue;
            }
            double one = copysign(1, in.vt), rim = one * in.spin * b.at.radius, to = one * out.spin * b.at.radius;
            double rolling = fabs(out.vt), tolerance = ROUNDING * (fabs(in.vt) + fabs(rim) + max / b.at.k);
            EXPECT(fabs(to - rim), <=, max / b.at.k + tolerance);
            EXPECT(to, >=, fmin(rim, rolling) - tolerance);
            EXPECT(to, <=, fmax(rim, rolling) + tolerance);
            bool follows = fabs(fabs(to - rim) - max / b.at.k) <= tolerance, at_rolling = fabs(to - rolling) <= tolerance;
            assert_true(follows || at_rolling);
            rolls += at_rolling;
        }
        print_message("%d of %d impacts are bounded, %d of these leave rolling\n", binds, IMPACTS, rolls);
        EXPECT(binds, >, IMPACTS / 10);
        EXPECT(binds, <, IMPACTS * 9 / 10);
        EXPECT(rolls, >=, laws[l]->spins ? binds / 50 : 0);
    }
}

/* Without friction a law takes no speed along the facet. With very high friction every law is as published, unless the rock has
 * no normal speed. */
TEST(limits_of_the_bound)
{
    struct line_random r = {.state = 3};
    for (size_t l = 0; l < LENGTH(laws); l++)
        for (int i = 0; i < IMPACTS / 10; i++) {
            struct blow b = random_blow(&r, laws[l]);
            b.at.friction = 0;
            EXPECT(fabs(strike_flat(laws[l], &b, true).vt), >=, fabs(b.in.vt));
            b.at.friction = 1e9;
            struct impact law = strike_flat(laws[l], &b, false), out = strike_flat(laws[l], &b, true);
            if (b.in.vn > 0)
                EXPECT_SAME(out, law, vt, vn, spin);
            b.in.vn = 0; /* grazing: no impulse to take anything */
            EXPECT(fabs(strike_flat(laws[l], &b, true).vt), >=, fabs(b.in.vt));
        }
}

/* The law arm has its own friction. */
TEST(the_bound_does_not_affect_the_law_arm)
{
    struct line_random r = {.state = 4};
    for (int i = 0; i < IMPACTS / 10; i++) {
        struct blow b = random_blow(&r, &law_arm);
        double turn = line_uniform(&r, -1.5, 1.5);
        b.at.mu = line_uniform(&r, 0, 3);
        b.at.sine = sin(turn);
        b.at.cosine = cos(turn);
        b.at.section.wide = line_uniform(&r, 1, 3);
        b.at.section.high = line_uniform(&r, 1, 3);
        b.at.section.reach = 1.5;
        b.at.section.gyration = b.at.radius / 1.5;
        struct impact law = strike_flat(&law_arm, &b, false), out = strike_flat(&law_arm, &b, true);
        EXPECT_SAME(out, law, vt, vn, spin);
    }
}
