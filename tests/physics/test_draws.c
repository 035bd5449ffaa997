/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers drawn for each rock: no two are correlated, and roughness uses the rock's own radius. All are computed from the
 * release and from the speed before and after the first contact with level ground. */
#include "expect.h"
#include "local.h"

#include <math.h>

#include "ceduo/ceduo.h"
#include "unit/ground.h"

#define ROCKS 4000

enum drawn { DIAMETER, DENSITY, X, HEIGHT, VX, VZ, SPIN, RN, RT, NUMBERS };
static const char *const names[NUMBERS] = {"diameter", "density", "x", "height", "vx", "vz", "spin", "rn", "rt"};

static struct ground g;

static struct ceduo_number uniform(double mean, double spread)
{
    return (struct ceduo_number){.mean = mean, .spread = spread, .kind = CEDUO_SPREAD_UNIFORM};
}

static void level_ground(enum ceduo_law law)
{
    ground_make(&g, 400, 0, 0, 0, 0);
    g.scene.simulation.law = law;
    g.scene.simulation.scale_rn = 0;
    g.scene.simulation.friction_bound = false;
    g.scene.release =
        (struct ceduo_release){uniform(20, 5), uniform(10, 5), uniform(8, 2), uniform(-2, 1), uniform(3, 1), false, 0};
}

/* The first two flights of a rock. */
struct flights {
    size_t n;
    struct ceduo_trajectory_segment segments[2];
};

static void note(void *context, const struct ceduo_trajectory_segment *piece)
{
    struct flights *f = context;
    if (f->n < 2)
        f->segments[f->n++] = *piece;
}

static struct ceduo_trajectory follow(struct ceduo_tracer *follower, uint64_t rock, struct flights *f)
{
    const struct ceduo_trajectory_callbacks watch = {.segment = note, .context = f};
    struct ceduo_trajectory trajectory;
    f->n = 0;
    assert_int_equal(ceduo_tracer_run(follower, rock, &watch, &trajectory, NULL), CEDUO_OK);
    EXPECT(f->n, ==, 2);
    return trajectory;
}

static double correlation(const double *a, const double *b)
{
    double a_mean = 0, b_mean = 0, aa = 0, bb = 0, ab = 0;
    for (int i = 0; i < ROCKS; i++) {
        a_mean += a[i] / ROCKS;
        b_mean += b[i] / ROCKS;
    }
    for (int i = 0; i < ROCKS; i++) {
        aa += (a[i] - a_mean) * (a[i] - a_mean);
        bb += (b[i] - b_mean) * (b[i] - b_mean);
        ab += (a[i] - a_mean) * (b[i] - b_mean);
    }
    return ab / sqrt(aa * bb);
}

/* Correlations of 4000 independent pairs are 0 within 4.5/sqrt(4000); one of 36 exceeds it with probability 0.0003. The spin is
 * measured under a law with spin, Rn and Rt under the law in which they are ratios of speeds. */
TEST(no_two_numbers_of_a_rock_go_together)
{
    static double drawn[NUMBERS][ROCKS];
    for (int spins = 0; spins < 2; spins++) {
        level_ground(spins ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED);
        g.scene.rock.diameter = uniform(1, .3);
        g.scene.rock.density = uniform(2600, 200);
        g.segment.rn = uniform(.5, .2);
        g.segment.rt = uniform(.8, .1);
        LOCAL(ceduo_tracer, follower) = ceduo_tracer_create(&g.scene, NULL);
        assert_non_null(follower);
        for (uint64_t r = 0; r < ROCKS; r++) {
            struct flights f;
            struct ceduo_trajectory trajectory = follow(follower, r, &f);
            if (spins) {
                drawn[SPIN][r] = trajectory.spin0;
                continue;
            }
            const double numbers[NUMBERS] = {[DIAMETER] = trajectory.rock.mean_diameter,
                                             [DENSITY] = trajectory.rock.mass / trajectory.rock.volume,
                                             [X] = trajectory.x0,
                                             [HEIGHT] = trajectory.z0,
                                             [VX] = trajectory.vx0,
                                             [VZ] = trajectory.vz0,
                                             [RN] = f.segments[1].vz / -f.segments[0].vz1,
                                             [RT] = f.segments[1].vx / f.segments[0].vx1};
            for (int i = 0; i < NUMBERS; i++)
                drawn[i][r] = numbers[i];
        }
    }
    for (int i = 0; i < NUMBERS; i++)
        for (int k = 0; k < i; k++) {
            double together = correlation(drawn[i], drawn[k]);
            if (!(fabs(together) < 4.5 / sqrt(ROCKS)))
                fail_msg("%s and %s: correlation %g", names[i], names[k], together);
        }
}

/* Ground that reverses all speed turns a rock by twice the facet's angle. The largest angles of 4000 rocks come close to
 * atan(roughness height / rock radius), and none exceeds it. Tested with few heights of roughness and with more than are
 * stored. The first of two segments is hit. */
TEST(the_radius_limits_the_steepness_of_facets)
{
    enum { MANY = 60 };
    static struct ceduo_segment segments[MANY];
    static double x[MANY + 1], z[MANY + 1];
    for (int many = 0; many < 2; many++) {
        double largest = 0;
        level_ground(CEDUO_LAW_LUMPED);
        g.scene.rock.diameter = uniform(1, .4);
        g.segment.rn = g.segment.rt = ceduo_number(1);
        g.segment.roughness_m = .2;
        g.segment.roughness_rad = NAN;
        for (int i = 0; i < MANY; i++) {
            x[i + 1] = 400 + i;
            segments[i] = g.segment;
            segments[i].roughness_m = .2 + .01 * i;
        }
        g.scene.slope = (struct ceduo_slope){.facets = CEDUO_FACETS_AGAINST,
                                             .vertices = many ? MANY + 1 : 3,
                                             .x = x,
                                             .z = z,
                                             .segments = segments,
                                             .segments_given = many ? MANY : 2};
        LOCAL(ceduo_tracer, follower) = ceduo_tracer_create(&g.scene, NULL);
        assert_non_null(follower);
        for (uint64_t r = 0; r < ROCKS; r++) {
            struct flights f;
            struct ceduo_trajectory trajectory = follow(follower, r, &f);
            double before = atan2(-f.segments[0].vz1, f.segments[0].vx1), after = atan2(f.segments[1].vz, f.segments[1].vx);
            double share = fabs(after - before) / 2 / atan(.2 / (trajectory.rock.mean_diameter / 2));
            EXPECT(share, <, 1 + 1e-9);
            largest = fmax(largest, share);
        }
        EXPECT(largest, >, .99);
    }
}
