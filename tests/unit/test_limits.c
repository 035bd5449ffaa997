/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edges of what the core takes: scenes that it refuses, few values, values beyond every bin. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka wants the four above first */
#include <cmocka.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/ceduo.h"
#include "base/bytes.h"
#include "core/envelope.h"
#include "core/ground.h"
#include "core/histogram.h"
#include "core/run_pack.h"
#include "core/wood.h"
#include "physics/paper_site.h"

/* ---- scenes that are refused ---- */

static struct paper_site site;

static void expect_slope(double *where, double value, enum ceduo_status wanted)
{
    double was = *where;
    *where = value;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), wanted);
    *where = was;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_OK);
}

static void slopes_are_refused(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    struct ceduo_segment *s = &slope->segments[3];
    const double outside[] = {-.01, 1.01, NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 5; i++) {
        expect_slope(&s->rn.mean, outside[i], CEDUO_BAD_SLOPE);
        expect_slope(&s->rt.mean, outside[i], CEDUO_BAD_SLOPE);
    }
    const double negative[] = {-.01, NAN, INFINITY};
    for (size_t i = 0; i < 3; i++) {
        expect_slope(&s->rn.spread, negative[i], CEDUO_BAD_SLOPE);
        expect_slope(&s->rt.spread, negative[i], CEDUO_BAD_SLOPE);
        expect_slope(&s->friction, negative[i], CEDUO_BAD_SLOPE);
        expect_slope(&s->roughness_rad, negative[i], CEDUO_BAD_SLOPE);
    }
    expect_slope(&s->rn.mean, 0, CEDUO_OK);
    expect_slope(&s->rt.mean, 1, CEDUO_OK);
    expect_slope(&s->roughness_rad, 1.5707963267948968, CEDUO_BAD_SLOPE); /* a right angle */
    expect_slope(&s->roughness_rad, 1.57, CEDUO_OK);
    expect_slope(&s->roughness_m, .1, CEDUO_BAD_SLOPE); /* said twice */
    s->roughness_rad = NAN;
    s->roughness_m = .1;
    expect_slope(&s->roughness_m, 0, CEDUO_OK);
    expect_slope(&s->roughness_m, -.1, CEDUO_BAD_SLOPE);
    expect_slope(&slope->x[4], NAN, CEDUO_BAD_SLOPE);
    expect_slope(&slope->z[4], INFINITY, CEDUO_BAD_SLOPE);
    expect_slope(&slope->x[4], slope->x[3], CEDUO_BAD_SLOPE);
    slope->vertices = 1;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_BAD_SLOPE);
}

static void scenes_are_refused(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_scene *scene = &site.scene;
    struct ceduo_control controls[2] = {site.control, site.control};
    scene->controls = controls;
    scene->controls_count = 2;
    double end = scene->slope.x[scene->slope.vertices - 1];
    const struct {
        double *number, value;
        enum ceduo_status wanted;
        size_t where;
    } rows[] = {{&scene->rock.diameter.mean, 0, CEDUO_BAD_ROCK, 9},
                {&scene->release.x.mean, -1, CEDUO_RELEASE_OFF_SLOPE, 9},
                {&scene->release.x.mean, NAN, CEDUO_RELEASE_OFF_SLOPE, 9},
                {&scene->release.x.mean, end, CEDUO_RELEASE_OFF_SLOPE, 9},
                {&scene->release.x.spread, 1, CEDUO_RELEASE_OFF_SLOPE, 9},
                {&scene->release.height.mean, -1, CEDUO_RELEASE_BELOW, 9},
                {&scene->release.height.spread, 1, CEDUO_RELEASE_BELOW, 9},
                {&controls[0].x, end + 1, CEDUO_CONTROL_OFF_SLOPE, 0},
                {&controls[1].x, NAN, CEDUO_CONTROL_OFF_SLOPE, 1},
                {&controls[1].x, 0, CEDUO_CONTROL_BEHIND, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        size_t where = 9;
        double was = *rows[i].number;
        *rows[i].number = rows[i].value;
        assert_int_equal(ceduo_scene_check(scene, &where), rows[i].wanted);
        assert_int_equal(where, rows[i].where);
        assert_int_equal(ceduo_scene_check(scene, NULL), rows[i].wanted);
        *rows[i].number = was;
        assert_int_equal(ceduo_scene_check(scene, NULL), CEDUO_OK);
    }
    assert_int_equal(ceduo_species_find("no-such-tree"), -1);
}

/* Of a rock that is none nothing is known, and none is flown. */
static void no_rock_no_figures(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_block blocks[CEDUO_BLOCKS];
    struct ceduo_way way;
    site.control.measured_speed = 10;
    assert_int_equal(ceduo_way_follow(&site.scene, NULL, 0, NULL, &way, NULL), CEDUO_OK);
    site.scene.rock.diameter.mean = 0;
    struct ceduo_stand_result stand = ceduo_assess_stand(&site.scene, &site.belts[0]);
    assert_true(isnan(stand.adc_m) && isnan(stand.contacts) && isnan(stand.dissipated) && !stand.passes_threshold);
    struct ceduo_index index = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e5);
    assert_true(isnan(index.measured) && index.contact != CEDUO_PASS);
    assert_int_equal(ceduo_way_follow(&site.scene, NULL, 0, NULL, &way, NULL), CEDUO_BAD_ROCK);
    for (int model = CEDUO_INDEX; model <= CEDUO_STEMS; model++) {
        site.scene.simulation.contact_model = (enum ceduo_contact_model)model;
        assert_int_equal(ceduo_blocks(&site.scene, &site.option, 0, 10, 1, NULL, blocks), CEDUO_BAD_ROCK);
    }
    /* good itself, but too heavy when it is as large as the others */
    site.scene.rock = ceduo_scene_default().rock;
    site.scene.rock.diameter.mean = 1e-90;
    site.scene.rock.mass.mean = 1e200;
    assert_int_equal(ceduo_scene_check(&site.scene, NULL), CEDUO_OK);
    for (int model = CEDUO_INDEX; model <= CEDUO_STEMS; model++) {
        site.scene.simulation.contact_model = (enum ceduo_contact_model)model;
        assert_int_equal(ceduo_blocks(&site.scene, &site.option, 0, 10, 1, NULL, blocks), CEDUO_BAD_ROCK);
    }
}

static void expect_rock(const struct ceduo_rock_def *def, enum ceduo_status wanted)
{
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_of_means(def, &rock), wanted);
}

static void rocks_are_refused(void **state)
{
    (void)state;
    const double no_size[] = {0, -1, INFINITY, -INFINITY};
    struct ceduo_rock_def def = ceduo_scene_default().rock;
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.diameter.mean = 1;
    expect_rock(&def, CEDUO_OK);
    for (size_t i = 0; i < 4; i++) {
        def.diameter.mean = no_size[i];
        expect_rock(&def, CEDUO_BAD_ROCK);
    }
    /* too small or too large: mass, moment or radius would be 0 or infinite */
    const double sizes[] = {1e-120, 1e-100, 1e100, 1e103};
    for (size_t i = 0; i < 4; i++) {
        def.diameter.mean = sizes[i];
        expect_rock(&def, CEDUO_BAD_ROCK);
    }
    def.mass.mean = def.diameter.mean = 1;
    def.density.mean = INFINITY; /* even where nothing needs it */
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.density.mean = 2600;
    expect_rock(&def, CEDUO_OK);
    def.diameter.mean = 4e-324;
    expect_rock(&def, CEDUO_BAD_ROCK);

    def = ceduo_scene_default().rock;
    def.shape = CEDUO_CYLINDER;
    def.diameter.mean = 1;
    expect_rock(&def, CEDUO_BAD_ROCK);
    def.height.mean = 1;
    expect_rock(&def, CEDUO_OK);
    def.diameter.mean = NAN;
    expect_rock(&def, CEDUO_BAD_ROCK);

    def = ceduo_scene_default().rock;
    for (int shape = CEDUO_ELLIPSOID; shape <= CEDUO_BLOCK; shape++) {
        def.shape = (enum ceduo_shape)shape;
        for (int all = 0; all < 8; all++) {
            for (int i = 0; i < 3; i++)
                def.axes[i].mean = all >> i & 1 ? 1 : NAN;
            expect_rock(&def, all == 7 ? CEDUO_OK : CEDUO_BAD_ROCK);
        }
        def.mass.mean = 1;
        for (int i = 0; i < 3; i++)
            def.axes[i].mean = 1e308;
        expect_rock(&def, CEDUO_BAD_ROCK); /* the sum of the axes is infinite */
        def.mass.mean = NAN;
    }
}

/* ---- few values ---- */

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Chance that at most k of n, by its definition. */
static double binomial(size_t n, double p, size_t k)
{
    double sum = 0;
    for (size_t i = 0; i <= k; i++)
        sum += exp(lgamma((double)n + 1) - lgamma((double)i + 1) - lgamma((double)(n - i) + 1) + (double)i * log(p) +
                   (double)(n - i) * log1p(-p));
    return sum;
}

static void intervals_of_few_values(void **state)
{
    (void)state;
    const double p[] = {.01, .05, .5, .95, .99};
    for (size_t i = 0; i < 5; i++)
        for (size_t n = 1; n <= 120; n++) {
            size_t lo, hi;
            ceduo_quantile_interval(n, p[i], &lo, &hi);
            assert_true(lo <= n && hi >= 1 && hi <= n + 1);
            assert_true(lo == 0 || binomial(n, p[i], lo - 1) < .025 + 1e-9);
            assert_true(binomial(n, p[i], lo) > .025 - 1e-9);
            assert_true(hi < 2 || binomial(n, p[i], hi - 2) < .975 + 1e-9);
            assert_true(binomial(n, p[i], hi - 1) > .975 - 1e-9);
        }
    assert_int_equal(ceduo_quantile_rank(10, 0), 1);
    assert_int_equal(ceduo_quantile_rank(10, 1), 10);
}

static void expect_near(double found, double wanted, double relative)
{
    if (isnan(wanted))
        assert_true(isnan(found));
    else
        assert_true(fabs(found - wanted) <= relative * wanted);
}

/* Values of all sizes, some of them 0: exact as sorted, binned but for the width of a bin. */
static void distributions_of_few_values(void **state)
{
    (void)state;
    uint64_t bits = 1;
    for (size_t n = 0; n <= 200; n++) {
        double values[200], sorted[200];
        struct ceduo_moments m = {0};
        struct histogram h = {0};
        for (size_t i = 0; i < n; i++) {
            bits = bits * 6364136223846793005u + 1442695040888963407u;
            values[i] = bits >> 62 == 0 ? 0 : ldexp(1 + (double)(bits >> 12 & 1023) / 1024, (int)(bits >> 40 & 31) - 16);
            sorted[i] = values[i];
            ceduo_moments_add(&m, values[i]);
            assert_true(ceduo_histogram_add(&h, values[i]));
        }
        qsort(sorted, n, sizeof *sorted, by_value);
        struct ceduo_distribution binned = ceduo_distribution_binned(&h, &m),
                                  exact = ceduo_distribution_exact(values, n, &m);
        size_t lo = 0, hi = 0;
        if (n > 0)
            ceduo_quantile_interval(n, .95, &lo, &hi);
        const double wanted[] = {n > 0 ? sorted[ceduo_quantile_rank(n, .5) - 1] : NAN,
                                 n > 0 ? sorted[ceduo_quantile_rank(n, .95) - 1] : NAN,
                                 n > 0 ? sorted[ceduo_quantile_rank(n, .99) - 1] : NAN,
                                 lo > 0 ? sorted[lo - 1] : NAN,
                                 n > 0 && hi <= n ? sorted[hi - 1] : NAN};
        const double of_exact[] = {exact.p50, exact.p95, exact.p99, exact.p95_lo, exact.p95_hi};
        const double of_binned[] = {binned.p50, binned.p95, binned.p99, binned.p95_lo, binned.p95_hi};
        for (size_t i = 0; i < 5; i++) {
            expect_near(of_exact[i], wanted[i], 0);
            expect_near(of_binned[i], wanted[i], 3.1e-5);
        }
        expect_near(exact.max, n > 0 ? sorted[n - 1] : NAN, 0);
        double squares = 0;
        for (size_t i = 0; i < n; i++)
            squares += (sorted[i] - m.mean) * (sorted[i] - m.mean);
        expect_near(exact.sd, n > 1 ? sqrt(squares / (double)(n - 1)) : NAN, 1e-12);
        expect_near(exact.se, n > 1 ? exact.sd / sqrt((double)n) : NAN, 1e-12);
        ceduo_histogram_clear(&h);
    }
}

static void values_beyond_every_bin(void **state)
{
    (void)state;
    struct histogram h = {0}, more = {0};
    const double values[] = {1e-300, 0, 5.5e-20, 1, 1e300};
    for (size_t i = 0; i < 5; i++)
        assert_true(ceduo_histogram_add(&h, values[i]));
    assert_int_equal(h.n, 5);
    assert_int_equal(h.zeros, 2);
    assert_true(ceduo_histogram_value(&h, 2) == 0);
    expect_near(ceduo_histogram_value(&h, 3), 5.5e-20, 3.1e-5);
    expect_near(ceduo_histogram_value(&h, 4), 1, 3.1e-5);
    assert_true(ceduo_histogram_value(&h, 5) > 9e18); /* in the last octave */
    assert_true(isnan(ceduo_histogram_value(&h, 6)));
    assert_true(ceduo_histogram_reserve(&more, &h));
    ceduo_histogram_merge(&more, &h);
    ceduo_histogram_merge(&more, &h);
    assert_int_equal(more.n, 10);
    for (uint64_t rank = 1; rank <= 10; rank++)
        assert_true(ceduo_histogram_value(&more, rank) == ceduo_histogram_value(&h, (rank + 1) / 2));
    ceduo_histogram_clear(&more);
    struct bytes b = {0};
    assert_true(ceduo_histogram_pack(&h, &b, 0));
    for (size_t n = 0; n <= b.length; n++)
        for (uint64_t most = 0; most < 7; most++) { /* short of bytes, or more values than there may be */
            struct bytes from = {.reads = true, .from = b.to, .length = n};
            bool good = ceduo_histogram_pack(&more, &from, most);
            assert_int_equal(good, n == b.length && most >= 5);
            assert_true(!good || (more.n == 5 && more.zeros == 2));
            ceduo_histogram_clear(&more);
        }
    free(b.to);
    ceduo_histogram_clear(&h);
}

static void columns_are_refused(void **state)
{
    (void)state;
    double column[11], back[11];
    uint64_t there, again;
    for (size_t i = 0; i < 11; i++)
        column[i] = i % 3 == 0 ? NAN : (double)i;
    struct bytes b = {0};
    assert_true(ceduo_bytes_column(&b, column, 11, &there));
    assert_int_equal(there, 7);
    assert_int_equal(b.length, 2 + 7 * 8);
    for (size_t n = 0; n <= b.length; n++) {
        struct bytes from = {.reads = true, .from = b.to, .length = n};
        assert_int_equal(ceduo_bytes_column(&from, back, 11, &again), n == b.length);
    }
    for (size_t i = 0; i < 11; i++)
        assert_true(isnan(column[i]) ? isnan(back[i]) : back[i] == column[i]);
    const struct {
        size_t at;
        unsigned char bytes[2];
    } rows[] = {{0, {0xb6, 0x0c}},     /* as many bits, one of them behind the last */
                {0, {0xb7, 0x05}},     /* one more */
                {2 + 6, {0xf0, 0x7f}}}; /* infinite */
    for (size_t i = 0; i < 3; i++) {
        unsigned char was[2];
        memcpy(was, b.to + rows[i].at, 2);
        memcpy(b.to + rows[i].at, rows[i].bytes, 2);
        struct bytes from = {.reads = true, .from = b.to, .length = b.length};
        assert_false(ceduo_bytes_column(&from, back, 11, &again));
        memcpy(b.to + rows[i].at, was, 2);
    }
    free(b.to);
}

/* The highest and fastest of all: its size is kept, whatever its bin. */
static void cells_take_any_value(void **state)
{
    (void)state;
    struct envelope_cell *cell = calloc(1, sizeof *cell);
    struct ceduo_envelope e;
    assert_non_null(cell);
    ceduo_envelope_add(cell, 1e200, 1e-200, 1e300);
    ceduo_envelope_settle(cell);
    ceduo_envelope_read(cell, &e);
    assert_int_equal(e.passed, 1);
    assert_true(e.speed.max == 1e200 && e.energy.max == 1e300 && e.height.max == 1e-200);
    assert_true(e.speed.p50 > 1e4 && e.energy.p50 > 1e9 && e.height.p50 == 0);
    free(cell);
}

/* ---- grounds and growth ---- */

/* Two segments on one line: how many are made of them. */
static size_t segments_made(void)
{
    struct ground g;
    assert_true(ceduo_ground_init(&g, &site.scene.slope, 9.81, .3, false));
    size_t n = g.n;
    ceduo_ground_release(&g);
    return n;
}

static void alike_neighbours_are_one(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    struct ceduo_segment *a = &slope->segments[0], *b = &slope->segments[1];
    slope->vertices = 3;
    for (int i = 0; i < 3; i++) {
        slope->x[i] = 10 * i;
        slope->z[i] = -5 * i;
    }
    *b = *a;
    assert_int_equal(segments_made(), 1);
    double *const numbers[] = {&b->rn.mean, &b->rt.mean, &b->friction, &b->roughness_rad, &b->rn.spread, &b->rt.spread, &slope->z[1]};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        double was = *numbers[i];
        *numbers[i] += .01;
        assert_int_equal(segments_made(), 2);
        *numbers[i] = was;
    }
    b->rn.kind = CEDUO_UNIFORM; /* of no spread */
    assert_int_equal(segments_made(), 1);
    a->rn.spread = b->rn.spread = .01;
    assert_int_equal(segments_made(), 2);
    a->rn.kind = CEDUO_UNIFORM;
    assert_int_equal(segments_made(), 1);
    a->roughness_m = b->roughness_m = .1;
    a->roughness_rad = b->roughness_rad = NAN;
    assert_int_equal(segments_made(), 1);
    b->roughness_m = .2;
    assert_int_equal(segments_made(), 2);
    b->roughness_m = NAN;
    b->roughness_rad = .1;
    assert_int_equal(segments_made(), 2);
}

/* A short segment that is turned from the line further than one may be is no part of it, be its end on it or not. */
static void turned_segments_are_their_own(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    const double x[] = {0, 1e-6, 1.1e-6, 1000};
    slope->vertices = 4;
    for (size_t i = 0; i < 4; i++) {
        slope->x[i] = x[i];
        slope->segments[i] = slope->segments[0];
    }
    slope->z[0] = slope->z[1] = 0;
    slope->z[3] = -500;
    slope->z[2] = 1.5e-7 * 1e-7; /* turned by 1.5e-7 rad */
    assert_int_equal(segments_made(), 3);
    slope->z[2] = .5e-7 * 1e-7;
    assert_int_equal(segments_made(), 2);
}

/* Stools so wide and so many that a table for all that a rock can be among would not fit into memory: there is a most. */
static void tables_of_stools_have_an_end(void **state)
{
    (void)state;
    paper_site_init(&site);
    const struct ceduo_simulation *simulation = &site.scene.simulation;
    struct wood wood;
    assert_true(ceduo_wood_init(&wood, simulation, &site.option, .68));
    assert_true(wood.places >= 63 && wood.places < 1000);
    ceduo_wood_release(&wood);
    site.belts[0].stand.stools_per_ha = 1e6;
    site.plots[0].shoots.per_ha = 1e10;
    site.belts[0].stand.spacing = 20;
    assert_true(ceduo_wood_init(&wood, simulation, &site.option, .68));
    assert_int_equal(wood.places, ((size_t)1 << 20) - 1); /* more than the million stems of a way */
    ceduo_wood_release(&wood);
}

/* A stand of whose growth something is not known stays as it is; and is never cut. */
static void growth_is_known_or_not(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_stand *stand = &site.belts[0].stand;
    struct ceduo_curve *shoots = &stand->growth.shoots;
    struct ceduo_grown_stand grown;
    stand->growth = paper_growth;
    stand->growth.sdi_most = 0;
    stand->cutting = (struct ceduo_cutting){.rotation = 25};
    double *const numbers[] = {&shoots->dbh_most, &shoots->dbh_rate, &shoots->height_most, &shoots->height_rate};
    stand->shoots[0].age = 10;
    for (size_t i = 0; i <= 4; i++) {
        double was = i < 4 ? *numbers[i] : 0;
        if (i < 4)
            *numbers[i] = 0;
        assert_int_equal(ceduo_stand_at(stand, NAN, 5, &grown), CEDUO_OK);
        bool grows = grown.stand.shoots[0].dbh > stand->shoots[0].dbh;
        assert_int_equal(grows, i == 4);
        assert_int_equal(ceduo_first_cut(stand, 3) != CEDUO_NEVER, i == 4);
        ceduo_grown_stand_release(&grown);
        if (i < 4)
            *numbers[i] = was;
    }
    site.scene.options = &site.option; /* what is shown of it: up to a rotation after the cut, where that is not too far */
    site.scene.options_count = 1;
    site.belts[1].stand.cutting.rotation = 0;
    const unsigned usual[][2] = {{3, 29}, {100, 120}, {119, 120}, {130, 10}};
    for (size_t i = 0; i < 4; i++) {
        site.belts[0].cut_year = usual[i][0];
        assert_int_equal(ceduo_years_usual(&site.scene), usual[i][1]);
    }
    stand->growth.shoots_old = 0;
    assert_int_equal(ceduo_first_cut(stand, 3), CEDUO_NEVER);
    stand->shoots_count = 0; /* trees alone: cut when they are old enough, if that is known */
    stand->stools_per_ha = 0;
    stand->growth = (struct ceduo_growth){.sdi_most = 0};
    assert_true(stand->trees_count == 1);
    stand->trees[0].age = NAN;
    assert_int_equal(ceduo_first_cut(stand, NAN), CEDUO_NEVER);
    stand->trees[0].age = 10;
    assert_int_equal(ceduo_first_cut(stand, NAN), 15);
    stand->cutting.rotation = 0;
    assert_int_equal(ceduo_first_cut(stand, 3), CEDUO_NEVER);
}

/* ---- the index ---- */

static void belts_beside_the_way(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_belt *belts = site.belts;
    struct ceduo_control control = site.control;
    struct ceduo_index both = ceduo_assess_index(&site.scene, &site.option, &control, 1e5);
    control.x = belts[0].to; /* the second belt lies behind the control */
    struct ceduo_index first = ceduo_assess_index(&site.scene, &site.option, &control, 1e5);
    struct ceduo_stand_result of_first = ceduo_assess_stand(&site.scene, &belts[0]),
                              of_second = ceduo_assess_stand(&site.scene, &belts[1]);
    double before = belts[0].to - fmax(belts[0].from, site.scene.release.x.mean);
    assert_true(fabs(first.length - before) < 1e-12 && both.length > first.length);
    assert_true(fabs(first.contacts - before / of_first.adc_m) < 1e-9);
    assert_true(fabs(both.contacts - first.contacts - of_second.contacts) < 1e-9);
    site.scene.release.x.mean = belts[0].to; /* the first lies behind the release */
    control.x = site.control.x;
    struct ceduo_index second = ceduo_assess_index(&site.scene, &site.option, &control, NAN);
    assert_true(fabs(second.contacts - of_second.contacts) < 1e-9);
    assert_true(isnan(second.residual) && !second.exhausted);
    control.measured_speed = 10;
    struct ceduo_rock rock;
    assert_int_equal(ceduo_rock_of_means(&site.scene.rock, &rock), CEDUO_OK);
    second = ceduo_assess_index(&site.scene, &site.option, &control, NAN);
    assert_true(fabs(second.measured - 50 * rock.mass) < 1e-6);
    assert_int_equal(ceduo_energy_light(NULL), CEDUO_UNKNOWN);
}

/* ---- keys ---- */

static uint64_t key_of(void)
{
    return ceduo_option_key(&site.scene, &site.option);
}

/* Whether a number matters to the rocks: it is changed, and put back. */
static bool matters(double *number, double value)
{
    uint64_t before = key_of();
    double was = *number;
    *number = value;
    bool other = key_of() != before;
    *number = was;
    assert_true(key_of() == before);
    return other;
}

static void keys_tell_what_rocks_meet(void **state)
{
    (void)state;
    paper_site_init(&site);
    struct ceduo_stand *stand = &site.belts[0].stand;
    struct ceduo_stems *shoots = &stand->shoots[0];
    assert_true(matters(&shoots->dbh, .123) && matters(&shoots->per_ha, 1234) && matters(&shoots->dbh_sd, .01));
    assert_true(matters(&stand->spacing, .123) && matters(&site.belts[0].to, 50));
    assert_true(matters(&shoots->volume, 1.5) && matters(&stand->u, 12345));
    assert_false(matters(&stand->fracture_ratio, 9) || matters(&shoots->age, 50));
    stand->energy = CEDUO_DORREN;
    assert_true(matters(&stand->fracture_ratio, 9));
    assert_false(matters(&shoots->volume, 1.5) || matters(&stand->u, 12345));
    stand->energy = CEDUO_BRAUNER;
    size_t trees = stand->trees_count;
    stand->trees_count = 0; /* half the volume and twice the work take the same */
    stand->u = 1000;
    shoots->volume = 2;
    uint64_t key = key_of();
    stand->u = 2000;
    shoots->volume = 1;
    assert_true(key_of() == key);
    stand->trees_count = trees;
    /* where diameters differ, a volume that is given goes with them, and one that is not is the species' */
    shoots->dbh_sd = .01;
    assert_true(matters(&shoots->volume, NAN));
    int species = stand->species;
    key = key_of();
    stand->species = ceduo_species_find("acer");
    assert_true(key_of() != key);
    stand->species = species;
    site.scene.simulation.contact_model = CEDUO_POISSON;
    key = key_of();
    site.scene.simulation.rule = CEDUO_CROFTON;
    assert_true(key_of() != key);
    site.scene.simulation.contact_model = CEDUO_INDEX;
    assert_true(key_of() == 0);
    site.scene.simulation.contact_model = CEDUO_STEMS;
    for (size_t i = 0; i < 2; i++)
        site.belts[i].stand.shoots_count = site.belts[i].stand.trees_count = 0;
    assert_true(key_of() == 0); /* bare: as without forest */
    site.belts[1].stand.shoots_count = 1;
    key = key_of();
    site.belts[0].to -= 1;
    assert_true(key != 0 && key_of() == key);
}

/* ---- runs ---- */

static struct ceduo_run *run_of(const struct ceduo_run_def *def, uint64_t rocks)
{
    struct ceduo_run *run;
    assert_int_equal(ceduo_run_create(def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    return run;
}

static void runs_that_take_no_part(void **state)
{
    (void)state;
    static const double cells[] = {10};
    paper_site_init(&site);
    site.scene.simulation.rocks = 1500;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene), part = def, other;
    part.part = true;
    struct ceduo_run *from = run_of(&part, 1024), *to;
    unsigned char *bytes;
    size_t n;
    assert_int_equal(paper_run_save(from, &bytes, &n), CEDUO_OK);
    to = run_of(&def, 0);
    assert_int_equal(ceduo_run_adopt(to, bytes, n), CEDUO_OK);
    ceduo_run_free(to);
    for (int i = 0; i < 3; i++) {
        other = i == 0 ? part : def;
        other.cells = i == 1 ? 1 : 0;
        other.cell_x = cells;
        to = run_of(&other, i == 2 ? 10 : 0);
        assert_int_equal(ceduo_run_adopt(to, bytes, n), CEDUO_BAD_PART); /* a part; with cells; within a block */
        ceduo_run_free(to);
    }
    free(bytes);
    ceduo_run_free(from);
}

/* Rocks of which some are drawn too light to compute with: these, and only these, are unfinished, at each control. */
static void rocks_that_cannot_be_drawn(void **state)
{
    (void)state;
    static const double cells[] = {50};
    paper_site_init(&site);
    site.scene.simulation.rocks = 300;
    site.scene.rock = ceduo_scene_default().rock;
    site.scene.rock.diameter.mean = .5;
    site.scene.rock.mass = (struct ceduo_number){.mean = 3e-322, .spread = 2.9e-322, .kind = CEDUO_UNIFORM};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.cells = 1;
    def.cell_x = cells;
    struct ceduo_run *run = run_of(&def, 300);
    struct ceduo_follower *follower = ceduo_follower_create(&site.scene, NULL);
    uint64_t bad = 0, reached = 0;
    for (uint64_t rock = 0; rock < 300; rock++) {
        struct ceduo_way way;
        struct ceduo_crossing crossing;
        enum ceduo_status status = ceduo_follower_follow(follower, rock, NULL, &way, &crossing);
        assert_true(status == CEDUO_OK || status == CEDUO_BAD_ROCK);
        bad += status == CEDUO_BAD_ROCK;
        reached += status == CEDUO_OK && crossing.reached;
    }
    ceduo_follower_free(follower);
    struct ceduo_ends e;
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_ends(run, &e), CEDUO_OK);
    assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
    assert_true(bad > 50 && bad < 250);
    assert_int_equal(e.count[CEDUO_UNFINISHED], bad);
    assert_int_equal(a.unfinished, bad);
    assert_int_equal(a.reached, reached);
    ceduo_run_free(run);
}

/* One number of the release has a spread: a run flies its rocks as they are followed one by one. */
static void each_spread_is_drawn(void **state)
{
    (void)state;
    enum { ROCKS = 40 };
    for (int i = 0; i < 5; i++) {
        paper_site_init(&site);
        site.scene.simulation.law = CEDUO_LAW_CRSP;
        struct ceduo_release *r = &site.scene.release;
        r->x.mean = r->height.mean = 3;
        struct ceduo_number *const numbers[] = {&r->x, &r->height, &r->vx, &r->vz, &r->spin};
        numbers[i]->spread = .5;
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        struct ceduo_run *run = run_of(&def, ROCKS);
        struct ceduo_follower *follower = ceduo_follower_create(&site.scene, NULL);
        double energies[ROCKS];
        size_t n = ceduo_run_energies(run, 0, energies, ROCKS), reached = 0;
        for (uint64_t rock = 0; rock < ROCKS; rock++) {
            struct ceduo_way way;
            struct ceduo_crossing c;
            assert_int_equal(ceduo_follower_follow(follower, rock, NULL, &way, &c), CEDUO_OK);
            if (!c.reached)
                continue;
            double speed = sqrt(c.vx * c.vx + c.vz * c.vz);
            double energy = .5 * way.rock.mass * (speed * speed) + .5 * way.rock.moment * (c.spin * c.spin);
            assert_true(reached < n && energies[reached++] == energy);
        }
        assert_true(reached == n && n > 5);
        ceduo_follower_free(follower);
        ceduo_run_free(run);
    }
}

static void count_piece(void *context, const struct ceduo_piece *piece)
{
    (void)piece;
    ++*(unsigned *)context;
}

static void count_stem(void *context, const struct ceduo_stem_passed *stem)
{
    (void)stem;
    *(unsigned *)context += 1000000;
}

/* Whoever looks on, at pieces, at stems or at nothing, changes nothing. */
static void looking_on_changes_nothing(void **state)
{
    (void)state;
    unsigned seen;
    const struct ceduo_watch watches[] = {{NULL, count_piece, count_stem, &seen},
                                          {NULL, count_piece, NULL, &seen},
                                          {NULL, NULL, count_stem, &seen},
                                          {NULL, NULL, NULL, &seen}};
    paper_site_init(&site);
    site.plots[0].shoots.height = site.plots[1].trees.height = .3; /* some are flown over */
    for (uint64_t rock = 0; rock < 60; rock++) {
        const struct ceduo_option *option = rock % 2 == 0 ? &site.option : NULL;
        struct ceduo_way alone, way;
        assert_int_equal(ceduo_way_follow(&site.scene, option, rock, NULL, &alone, NULL), CEDUO_OK);
        for (int i = 0; i < 4; i++) {
            seen = 0;
            assert_int_equal(ceduo_way_follow(&site.scene, option, rock, &watches[i], &way, NULL), CEDUO_OK);
            assert_true(way.x == alone.x && way.z == alone.z && way.end == alone.end && way.contacts == alone.contacts);
            assert_true(way.stems_hit == alone.stems_hit && way.stems_drawn == alone.stems_drawn);
            assert_int_equal(seen % 1000000 > 0, i < 2);
            assert_true(seen / 1000000 >= (i % 2 == 0 ? alone.stems_hit : 0) && (i % 2 == 0 || seen < 1000000));
        }
    }
}

/* A rock that bounces in its place for ever is given up, unfinished before the control; the cells do not see it. */
static void a_rock_without_end(void **state)
{
    (void)state;
    static const double cells[] = {1, 50};
    paper_site_init(&site);
    struct ceduo_slope *slope = &site.scene.slope;
    slope->vertices = 2;
    slope->z[1] = slope->z[0];
    slope->segments[0] = (struct ceduo_segment){ceduo_number(1), ceduo_number(1), NAN, 0, .5};
    site.control.x = slope->x[1];
    site.scene.release = (struct ceduo_release){ceduo_number(.5), ceduo_number(1), ceduo_number(0), ceduo_number(0), ceduo_number(0)};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.cells = 2;
    def.cell_x = cells;
    struct ceduo_run *run = run_of(&def, 1);
    struct ceduo_arrivals a;
    struct ceduo_envelope e;
    assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
    ceduo_run_envelope(run, 0, &e);
    assert_true(a.unfinished == 1 && a.reached == 0 && e.passed == 0);
    assert_int_equal(ceduo_run_contacts(run), CEDUO_CONTACTS_MOST);
    ceduo_run_free(run);
}

/* Where samples are kept no more, differences come from the first so many rocks: their error is as that of all. */
static void differences_of_the_first_rocks(void **state)
{
    (void)state;
    enum { ROCKS = CEDUO_PAIRED_ROCKS + 70000 };
    paper_site_init(&site);
    site.scene.simulation.rocks = ROCKS;
    site.scene.release.vx = (struct ceduo_number){.mean = 5, .spread = 2, .kind = CEDUO_UNIFORM};
    site.control.x = 1;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.arrivals_only = true;
    struct ceduo_scene slower = site.scene;
    slower.release.vx.mean = 4;
    struct ceduo_run_def other = def;
    other.scene = &slower;
    struct ceduo_run *exact[2] = {run_of(&def, ROCKS), run_of(&other, ROCKS)}, *binned[2];
    def.exact_bytes = other.exact_bytes = (CEDUO_PAIRED_ROCKS + 40000) * 3 * sizeof(double);
    binned[0] = run_of(&def, CEDUO_PAIRED_ROCKS + 30000); /* with samples until here */
    assert_int_equal(ceduo_run_extend(binned[0], ROCKS), CEDUO_OK);
    binned[1] = run_of(&other, ROCKS);
    struct ceduo_difference all = ceduo_run_difference(exact[0], exact[1], 0), first = ceduo_run_difference(binned[0], binned[1], 0);
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_arrivals(binned[0], 0, &a), CEDUO_OK);
    assert_true(!a.exact && a.reached == ROCKS);
    assert_true(first.energy_per_released.mean == all.energy_per_released.mean && all.energy_per_released.mean > 0);
    expect_near(first.energy_per_released.se, all.energy_per_released.se, .01);
    for (int i = 0; i < 2; i++) {
        ceduo_run_free(exact[i]);
        ceduo_run_free(binned[i]);
    }
}

/* Years that were not flown yet say nothing of what arrives. */
static void years_before_they_are_flown(void **state)
{
    (void)state;
    paper_site_init(&site);
    site.scene.simulation.rocks = 20;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_run *run = run_of(&def, 20);
    struct ceduo_flown bare;
    struct ceduo_years *years;
    assert_int_equal(ceduo_flown_read(run, 1, &bare), CEDUO_OK);
    assert_int_equal(ceduo_years_create(&site.scene, &site.option, 0, 3, 1, &years), CEDUO_OK);
    ceduo_years_assess(years, &site.scene, &bare);
    struct ceduo_years_summary s = ceduo_years_sum(years, 0);
    assert_true(s.years == 4 && s.flown == 0 && isnan(s.worst) && isnan(s.reach.mean) && isnan(s.exceed.mean));
    assert_true(s.unprotected_contact == 0 && s.unprotected_energy == 0);
    ceduo_years_free(years);
    ceduo_flown_free(&bare);
    ceduo_run_free(run);
}

static void little_is_asked_of_a_run(void **state)
{
    (void)state;
    static const double cells[] = {20, 152};
    double energies[8];
    paper_site_init(&site);
    site.scene.simulation.rocks = 300;
    site.scene.slope.segments[0].friction = 9; /* holds all that are released without speed */
    site.scene.release = (struct ceduo_release){ceduo_number(.1), ceduo_number(0), ceduo_number(0), ceduo_number(0),
                                                ceduo_number(0)};
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.threads = 0; /* as one */
    def.cells = 2;
    def.cell_x = cells;
    struct ceduo_run *run = run_of(&def, 300);
    for (size_t i = 0; i < 2; i++) {
        struct ceduo_envelope e;
        ceduo_run_envelope(run, i, &e);
        assert_int_equal(e.passed, 0);
        assert_true(isnan(e.mean_energy) && isnan(e.speed.p5) && isnan(e.energy.max));
    }
    uint64_t reached;
    double mean, se;
    ceduo_run_energy(run, 0, &reached, &mean, &se);
    assert_true(reached == 0 && isnan(mean) && isnan(se));
    assert_int_equal(ceduo_run_extend(run, 1000), CEDUO_OK); /* as long as it was made for */
    assert_int_equal(ceduo_run_rocks(run), 300);
    ceduo_run_free(run);

    paper_site_init(&site);
    def = ceduo_run_def_default(&site.scene);
    def.rocks_most = 300;
    run = run_of(&def, 0);
    assert_int_equal(ceduo_run_energies(run, 0, energies, 8), 0);
    assert_int_equal(ceduo_run_extend(run, 300), CEDUO_OK);
    assert_int_equal(ceduo_run_energies(run, 0, energies, 8), 8);
    ceduo_run_free(run);
    def.exact_bytes = 100;
    run = run_of(&def, 300);
    assert_int_equal(ceduo_run_energies(run, 0, energies, 8), 0);
    ceduo_run_free(run);
    struct ceduo_arrivals steps, once; /* room is taken twice over, where that fits */
    const double of_control[] = {site.control.x};
    def.exact_bytes = 4 * sizeof(double) * 300; /* speed, height, stops, and room to sort */
    def.cells = 1;
    def.cell_x = of_control;
    run = run_of(&def, 200);
    assert_int_equal(ceduo_run_extend(run, 300), CEDUO_OK);
    assert_int_equal(ceduo_run_arrivals(run, 0, &steps), CEDUO_OK);
    struct ceduo_envelope at_control; /* a cell where a control is */
    ceduo_run_envelope(run, 0, &at_control);
    assert_int_equal(at_control.passed, steps.reached);
    assert_true(at_control.speed.max == steps.speed.max && at_control.energy.max == steps.energy.max);
    ceduo_run_free(run);
    def.cells = 0;
    run = run_of(&def, 300);
    assert_int_equal(ceduo_run_arrivals(run, 0, &once), CEDUO_OK);
    assert_true(steps.exact && once.exact && steps.reached > 0);
    assert_memory_equal(&steps, &once, offsetof(struct ceduo_arrivals, exact));
    ceduo_run_free(run);
    site.scene.controls_count = 0; /* nobody asks what arrives; where they stop is told all the same */
    def.exact_bytes = 100;
    struct ceduo_ends binned, exact;
    run = run_of(&def, 300);
    assert_int_equal(ceduo_run_ends(run, &binned), CEDUO_OK);
    ceduo_run_free(run);
    def.exact_bytes = CEDUO_EXACT_BYTES;
    run = run_of(&def, 300);
    assert_int_equal(ceduo_run_ends(run, &exact), CEDUO_OK);
    ceduo_run_free(run);
    assert_memory_equal(binned.count, exact.count, sizeof exact.count);
    assert_true(exact.stop_x.n > 0);
    expect_near(binned.stop_p50, exact.stop_p50, 3.1e-5);

    struct ceduo_pool *pool;
    site.scene.slope.vertices = 1;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_BAD_SLOPE);
    assert_null(run);
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_BAD_SLOPE);
    assert_null(pool);
}

/* The pool of a scene as it flies it, or as a part of that. */
static struct ceduo_pool *pool_of(bool part)
{
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_pool *pool;
    def.part = part;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    return pool;
}

static void pools_of_another_kind(void **state)
{
    (void)state;
    paper_site_init(&site);
    site.scene.simulation.rocks = 20;
    site.scene.options = &site.option;
    site.scene.options_count = 1;
    struct ceduo_pool *part = pool_of(true);
    unsigned char *bytes;
    size_t n;
    assert_int_equal(ceduo_pool_extend(part, 20), CEDUO_OK);
    assert_int_equal(ceduo_pool_save(part, &bytes, &n), CEDUO_OK);
    bytes = realloc(bytes, n + 1);
    assert_non_null(bytes);
    bytes[n] = 0;
    for (int i = 0; i < 5; i++) { /* as it is; of other runs, of another forest, shorter, longer */
        struct ceduo_pool *whole = pool_of(false);
        bytes[0] ^= i == 1;
        bytes[8] ^= i == 2;
        size_t length = i == 3 ? n - 1 : i == 4 ? n + 1 : n;
        assert_int_equal(ceduo_pool_adopt(whole, bytes, length), i == 0 ? CEDUO_OK : CEDUO_BAD_PART);
        bytes[0] ^= i == 1;
        bytes[8] ^= i == 2;
        ceduo_pool_free(whole);
    }
    free(bytes);
    ceduo_pool_free(part);
    site.scene.controls_count = 0; /* and a result of no control at all */
    struct ceduo_pool *pool = pool_of(false);
    struct ceduo_result *result;
    assert_int_equal(ceduo_pool_extend(pool, 20), CEDUO_OK);
    assert_int_equal(ceduo_result_create(&site.scene, pool, &result), CEDUO_OK);
    assert_int_equal(ceduo_result_rocks(result), 20);
    ceduo_result_free(result);
    ceduo_pool_free(pool);
}

/* Forests that the scene has no more: the runs asked for last stay, so many of them. */
static void a_pool_forgets_what_is_old(void **state)
{
    (void)state;
    paper_site_init(&site);
    site.scene.simulation.rocks = 10;
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    struct ceduo_pool *pool;
    struct ceduo_run *run;
    assert_int_equal(ceduo_pool_create(&def, &pool), CEDUO_OK);
    assert_int_equal(ceduo_pool_fill(pool), CEDUO_OK);
    enum { MORE = CEDUO_POOL_SPARE + 5 };
    double to = site.belts[1].to;
    for (int i = 1; i <= MORE; i++) {
        site.belts[1].to = to - i;
        assert_int_equal(ceduo_pool_run(pool, &site.option, &run), CEDUO_OK);
    }
    site.belts[1].to = to - 1; /* the first is asked for once more */
    assert_int_equal(ceduo_pool_run(pool, &site.option, &run), CEDUO_OK);
    assert_int_equal(ceduo_pool_work(pool).reused, 1);
    site.belts[1].to = to;
    ceduo_pool_turn(pool, &site.scene);
    assert_int_equal(ceduo_pool_work(pool).runs, 2 + MORE); /* made; those that are forgotten count */
    assert_non_null(ceduo_pool_find(pool, NULL));
    assert_non_null(ceduo_pool_find(pool, &site.option));
    for (int i = 1; i <= MORE; i++) {
        site.belts[1].to = to - i;
        assert_int_equal(ceduo_pool_find(pool, &site.option) != NULL, i == 1 || i > MORE - CEDUO_POOL_SPARE + 1);
    }
    site.belts[1].to = to;
    unsigned char *bytes;
    size_t n;
    assert_int_equal(ceduo_pool_save(pool, &bytes, &n), CEDUO_OK);
    assert_int_equal(ceduo_pool_adopt(pool, bytes, 8), CEDUO_BAD_PART);
    free(bytes);
    ceduo_pool_free(pool);
}

/* ---- looking for a value that is given up ---- */

static atomic_bool cancel;
static unsigned looked;

static enum ceduo_status give_up(void *context, double value, double *goal)
{
    const unsigned *when = context;
    *goal = 1 / value;
    atomic_store(&cancel, ++looked >= *when);
    return CEDUO_OK;
}

static enum ceduo_status refuse(void *context, double value, double *goal)
{
    const unsigned *when = context;
    *goal = 1 / value;
    return ++looked >= *when ? CEDUO_BAD_SLOPE : CEDUO_OK;
}

/* Wherever the search stands: no value is looked at after it, and none is found. */
static void a_search_ends_at_once(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) { /* where nothing passes, all is looked through */
        struct ceduo_found found;
        double target = kind < 2 ? .3 : -1;
        struct ceduo_find_def def = {.lo = 1, .hi = 1000, .whole = kind % 2, .target = target, .cancel = &cancel};
        unsigned when = UINT32_MAX;
        def.context = &when;
        def.goal = give_up;
        looked = 0;
        atomic_store(&cancel, false);
        assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
        unsigned all = looked;
        assert_true(found.found == (kind < 2) && all > 5);
        for (when = 1; when < all; when++)
            for (int k = 0; k < 2; k++) {
                def.goal = k == 0 ? give_up : refuse;
                looked = 0;
                atomic_store(&cancel, false);
                assert_int_equal(ceduo_find(&def, &found), k == 0 ? CEDUO_CANCELLED : CEDUO_BAD_SLOPE);
                assert_int_equal(looked, when);
                assert_false(found.found);
            }
    }
}

/* Goals without end, and one that is met exactly: by halves. */
static enum ceduo_status steps_down(void *context, double value, double *goal)
{
    const double *levels = context;
    *goal = value < 3 ? levels[0] : levels[1];
    return CEDUO_OK;
}

static void goals_without_end(void **state)
{
    (void)state;
    const double levels[][2] = {{INFINITY, -INFINITY}, {1, -INFINITY}, {INFINITY, 0}, {1, .5}, {NAN, 0}};
    for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++) {
        struct ceduo_found found;
        double pair[2] = {levels[i][0], levels[i][1]};
        const struct ceduo_find_def def = {.lo = 1, .hi = 9, .target = .5, .goal = steps_down, .context = pair};
        assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
        assert_true(found.found && found.value >= 3 && found.value < 3 + 1e-7);
        assert_true(found.goal_at_value == levels[i][1] && found.side == CEDUO_SMALLEST);
    }
}

static enum ceduo_status falls(void *context, double value, double *goal)
{
    const double *top = context;
    *goal = *top - value;
    return CEDUO_OK;
}

/* A tolerance that is met by the first step; and a range so large that halving does not come to an end: given up. */
static void few_values_and_too_many(void **state)
{
    (void)state;
    struct ceduo_found found;
    double top = 10;
    struct ceduo_find_def def = {.lo = 1, .hi = 9, .target = 5.5, .goal = falls, .context = &top, .tolerance = .5};
    assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
    assert_true(found.found && found.value >= 4.5 && found.value < 4.5 + 4 && found.side == CEDUO_SMALLEST);
    assert_int_equal(found.evaluations, 3);
    def = (struct ceduo_find_def){.lo = 0, .hi = 1e300, .whole = true, .target = 5.5, .goal = falls, .context = &top};
    assert_int_equal(ceduo_find(&def, &found), CEDUO_OK);
    assert_true(found.found && found.value >= 5 && found.goal_at_value <= 5.5);
    assert_true(found.evaluations > 55 && found.evaluations < 200);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_are_refused),
        cmocka_unit_test(scenes_are_refused),
        cmocka_unit_test(no_rock_no_figures),
        cmocka_unit_test(rocks_are_refused),
        cmocka_unit_test(intervals_of_few_values),
        cmocka_unit_test(distributions_of_few_values),
        cmocka_unit_test(values_beyond_every_bin),
        cmocka_unit_test(columns_are_refused),
        cmocka_unit_test(cells_take_any_value),
        cmocka_unit_test(alike_neighbours_are_one),
        cmocka_unit_test(turned_segments_are_their_own),
        cmocka_unit_test(tables_of_stools_have_an_end),
        cmocka_unit_test(growth_is_known_or_not),
        cmocka_unit_test(goals_without_end),
        cmocka_unit_test(belts_beside_the_way),
        cmocka_unit_test(keys_tell_what_rocks_meet),
        cmocka_unit_test(runs_that_take_no_part),
        cmocka_unit_test(rocks_that_cannot_be_drawn),
        cmocka_unit_test(each_spread_is_drawn),
        cmocka_unit_test(looking_on_changes_nothing),
        cmocka_unit_test(a_rock_without_end),
        cmocka_unit_test(differences_of_the_first_rocks),
        cmocka_unit_test(years_before_they_are_flown),
        cmocka_unit_test(little_is_asked_of_a_run),
        cmocka_unit_test(a_pool_forgets_what_is_old),
        cmocka_unit_test(pools_of_another_kind),
        cmocka_unit_test(a_search_ends_at_once),
        cmocka_unit_test(few_values_and_too_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
