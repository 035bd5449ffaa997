/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of one number, compared with the C library in long double, on grids and at random points. */
#include "expect.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <math.h>

#define REAL_LANES 2
#include "base/elementary.h"
#include "base/random.h"
#include "base/real.h"
/* This header does not compile with our warnings. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <Random123/threefry.h>
#pragma GCC diagnostic pop

#define PLACES 200000

static uint64_t state = 1;

static double uniform(void)
{
    state = state * 6364136223846793005U + 1442695040888963407U;
    return (double)(state >> 11) * 0x1p-53;
}

/* Return point i: first on a grid, then random. */
static double place(size_t i, double lo, double hi)
{
    double u = i < PLACES / 2 ? (double)i / (PLACES / 2) : uniform();
    return lo + (hi - lo) * u;
}

/* Error in units of the last place of the exact value. */
static double ulps(double value, long double exact)
{
    int exponent;
    frexpl(exact, &exponent);
    return (double)(fabsl((long double)value - exact) / ldexpl(1, exponent - DBL_MANT_DIG));
}

static void expect_near(const char *label, double at, double value, long double exact, double max)
{
    double off = ulps(value, exact);
    if (!(off <= max))
        fail_msg("%s(%.17g) is %.17g, %.2f ulp off", label, at, value, off);
}

TEST(logarithms)
{
    for (size_t i = 1; i < PLACES; i++) {
        double near = place(i, 0.5, 2), far = exp2(place(i, -1070, 1023.9)), share = place(i, 0, 1);
        expect_near("log", near, ceduo_log(near), logl(near), 1);
        expect_near("log", far, ceduo_log(far), logl(far), 1);
        expect_near("log", share, ceduo_log(share), logl(share), 1);
    }
    for (size_t i = 0; i < PLACES; i++) {
        double x = exp2(place(i, -80, 60)), below = -exp2(place(i, -80, -0.01));
        expect_near("log1p", x, ceduo_log1p(x), log1pl(x), 3);
        expect_near("log1p", below, ceduo_log1p(below), log1pl(below), 3);
    }
    EXPECT(ceduo_log1p(INFINITY), ==, INFINITY);
    EXPECT(ceduo_log(1), ==, 0);
    EXPECT(ceduo_log(0), ==, -INFINITY);
    EXPECT(ceduo_log(INFINITY), ==, INFINITY);
    assert_true(isnan(ceduo_log(-1)) && isnan(ceduo_log(NAN)));
}

/* As computed by Threefry's authors. */
TEST(random_bits_are_those_of_random123)
{
    for (uint64_t n = 0; n < PLACES / 10; n++) {
        uint64_t seed = n * 0x9e3779b97f4a7c15, rock = n << n % 60, event = n * n, kind = ~n, bits[2];
        threefry2x64_ctr_t c = {{event, kind}};
        threefry2x64_key_t k = {{seed, rock}};
        threefry2x64_ctr_t r = threefry2x64(c, k);
        random_bits(seed, rock, event, kind, bits);
        assert_true(bits[0] == r.v[0] && bits[1] == r.v[1]);
    }
}

/* Neighbouring seeds, variants and numbers are unrelated: seed 2^53 in a year is not seed 0 in the next one. */
TEST(variants_have_their_own_seeds)
{
    enum { NUMBERS = 40, VARIANTS = VARIANT_PREDICTION + 1 };
    const uint64_t given[] = {0, 1, 2, 1ull << 52, 1ull << 53, (1ull << 53) - 1, 1ull << 54, 0x5eed};
    uint64_t seeds[LENGTH(given) * VARIANTS * NUMBERS], n = 0;
    for (size_t s = 0; s < LENGTH(given); s++)
        for (int v = 0; v < VARIANTS; v++)
            for (uint64_t i = 0; i < NUMBERS; i++)
                seeds[n++] = random_seed(given[s], (enum random_variant)v, i);
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < a; b++) {
            assert_true(seeds[a] != seeds[b]);
            EXPECT(__builtin_popcountll(seeds[a] ^ seeds[b]), >, 5); /* about half of 64 bits differ */
        }
}

/* A register gives the bits of the scalar function in each lane. */
TEST(lanes)
{
    for (uint64_t n = 0; n < PLACES / REAL_LANES; n++) {
        const uint64_t key = RANDOM_KEY(11, n);
        ints events = count_from(3 * n, 5), kinds = splat_ints(n % 7);
        RANDOM_BITS(events, kinds, 11, n, key);
        real u = to_real_small(events >> 12) * 0x1p-52 + 0x1p-53, angle = (u - 0.5) * 3.14159, exponent = (u - 0.5) * 1400.0;
        real log, sine, cosine, power;
        lanes_log(&u, &log);
        lanes_exp(&exponent, &power);
        lanes_sincos(&angle, &sine, &cosine);
        EACH_LANE(i) {
            double one = u[i], turn = angle[i], l, s, c;
            uint64_t bits[2];
            random_bits(11, n, 3 * n + 5 * i, n % 7, bits);
            assert_true(bits[0] == events[i] && bits[1] == kinds[i]);
            assert_true(one == (double)(bits[0] >> 12) * 0x1p-52 + 0x1p-53);
            elementary_log(&one, &l);
            elementary_sincos(&turn, &s, &c);
            assert_true(l == log[i] && s == sine[i] && c == cosine[i]);
            assert_true(ceduo_exp(exponent[i]) == power[i]);
        }
    }
}

TEST(powers)
{
    for (size_t i = 0; i < PLACES; i++) {
        double x = place(i, -708, 709.7), base = place(i, 0.1, 200), y = place(i, -5, 5);
        expect_near("exp", x, ceduo_exp(x), expl(x), 1);
        double change = place(i, -700, 709.7), small = exp2(place(i, -80, -0.01));
        expect_near("expm1", change, ceduo_expm1(change), expm1l(change), 3);
        expect_near("expm1", small, ceduo_expm1(small), expm1l(small), 3);
        expect_near("expm1", -small, ceduo_expm1(-small), expm1l(-small), 3);
        assert_true(fabsl(ceduo_pow(base, y) / powl(base, y) - 1) <= 0x1p-52L * (1 + fabsl(y * logl(base))));
    }
    EXPECT(ceduo_exp(0), ==, 1);
    EXPECT(ceduo_exp(-745), ==, 0x1p-1074);
    EXPECT(ceduo_exp(-1e9), ==, 0);
    EXPECT(ceduo_exp(1e9), ==, INFINITY);
    assert_true(isnan(ceduo_exp(NAN)));
    EXPECT(ceduo_expm1(0), ==, 0);
    EXPECT(ceduo_expm1(-INFINITY), ==, -1);
    EXPECT(ceduo_expm1(-1e9), ==, -1);
    EXPECT(ceduo_expm1(1e9), ==, INFINITY);
    assert_true(isnan(ceduo_expm1(NAN)));
}

TEST(angles)
{
    for (size_t i = 0; i < PLACES; i++) {
        double angle = place(i, -M_PI_2, M_PI_2), near = place(i, -1.5, 1.5), far = exp2(place(i, -60, 60)), s, c;
        elementary_sincos(&angle, &s, &c);
        assert_true(fabsl(s - sinl(angle)) <= 2.5e-16L && fabsl(c - cosl(angle)) <= 2.5e-16L);
        expect_near("atan", near, ceduo_atan(near), atanl(near), 2);
        expect_near("atan", far, ceduo_atan(far), atanl(far), 2);
    }
    EXPECT(ceduo_atan(INFINITY), ==, M_PI_2);
    assert_true(isnan(ceduo_atan(NAN)));
    for (uint64_t n = 1; n < 200; n++)
        for (uint64_t i = 0; i < n; i++) {
            double c, s;
            ceduo_sincos_turn(i, n, &c, &s);
            long double turn = 2 * acosl(-1) * (long double)i / (long double)n;
            assert_true(fabsl(c - cosl(turn)) <= 4e-16L && fabsl(s - sinl(turn)) <= 4e-16L);
        }
}

TEST(roots)
{
    for (size_t i = 0; i < PLACES; i++) {
        double near = place(i, -10, 10), far = exp2(place(i, -1070, 1023));
        expect_near("cbrt", near, ceduo_cbrt(near), cbrtl(near), 1);
        expect_near("cbrt", far, ceduo_cbrt(far), cbrtl(far), 1);
    }
    EXPECT(ceduo_cbrt(0), ==, 0);
    EXPECT(ceduo_cbrt(-INFINITY), ==, -INFINITY);
    assert_true(isnan(ceduo_cbrt(NAN)));
    EXPECT(ceduo_hypot(3, -4), ==, 5);
    EXPECT(ceduo_hypot(3e-320, 4e-320), ==, 5e-320); /* their squares are 0 */
    EXPECT(ceduo_hypot(0, 5e-324), ==, 5e-324);
}

TEST(normal_law)
{
    for (size_t i = 1; i < PLACES / 4; i++) {
        double z = place(i, -3, 3), p = place(i, 0, 1), small = exp2(place(i, -300, -1));
        assert_true(fabs(ceduo_normal_cdf(z) - gsl_cdf_ugaussian_P(z)) <= 1e-15);
        double q = ceduo_normal_quantile(p), tail = ceduo_normal_quantile(small);
        assert_true(fabsl(0.5L * erfcl(-q / sqrtl(2)) - p) <= 1e-15L * p + 3e-16L);
        assert_true(fabsl(0.5L * erfcl(-tail / sqrtl(2)) / small - 1) <= 2e-15L * (1 + (long double)(tail * tail)));
    }
    EXPECT(ceduo_normal_quantile(0.5), ==, 0);
}
