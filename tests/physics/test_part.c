/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs in parts: joined they are one run, bit for bit; and bytes that are no part change nothing. */
#include "expect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/run_pack.h"
#include "paper_site.h"

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])
#define ROCKS     5500 /* five blocks and a half */
#define FEW_BYTES 60000

static struct paper_site site;

struct saved {
    unsigned char *bytes;
    size_t n;
};

static void init(enum ceduo_contact_model model, enum ceduo_law law)
{
    paper_site_init(&site);
    site.scene.simulation.contact_model = model;
    site.scene.simulation.law = law;
    site.scene.simulation.rocks = ROCKS;
    site.control.accepted = 50e3;
}

static struct ceduo_run_def def_of(size_t exact_bytes, bool wood)
{
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.option = wood ? &site.option : NULL;
    def.exact_bytes = exact_bytes;
    return def;
}

static struct ceduo_run *run_of(struct ceduo_run_def def, uint64_t rocks)
{
    struct ceduo_run *run;
    assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    return run;
}

static struct saved part_of(struct ceduo_run_def def, uint64_t part, uint64_t parts, unsigned steps)
{
    uint64_t end;
    struct saved s;
    def.part = true;
    def.threads = part % 2 == 0 ? 2 : 1;
    ceduo_part_range(ROCKS, part, parts, &def.first, &end);
    struct ceduo_run *run = run_of(def, def.first);
    for (unsigned i = 1; i <= steps; i++)
        assert_int_equal(ceduo_run_extend(run, def.first + (end - def.first) * i / steps), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), end);
    assert_int_equal(paper_run_save(run, &s.bytes, &s.n), CEDUO_OK);
    ceduo_run_free(run);
    return s;
}

static struct ceduo_run *joined(struct ceduo_run_def def, uint64_t parts)
{
    struct ceduo_run *run = run_of(def, 0);
    for (uint64_t i = 1; i <= parts; i++) {
        struct saved s = part_of(def, i, parts, 1);
        assert_int_equal(ceduo_run_adopt(run, s.bytes, s.n), CEDUO_OK);
        free(s.bytes);
    }
    return run;
}

/* No padding is compared: these hold doubles and 64-bit counts alone, but for `exact`. */
static void expect_same(const struct ceduo_run *a, const struct ceduo_run *b)
{
    struct ceduo_arrivals x, y;
    struct ceduo_ends e, f;
    assert_int_equal(ceduo_run_rocks(a), ceduo_run_rocks(b));
    assert_int_equal(ceduo_run_contacts(a), ceduo_run_contacts(b));
    assert_int_equal(ceduo_run_stems(a).drawn, ceduo_run_stems(b).drawn);
    assert_int_equal(ceduo_run_arrivals(a, 0, &x), CEDUO_OK);
    assert_int_equal(ceduo_run_arrivals(b, 0, &y), CEDUO_OK);
    assert_memory_equal(&x, &y, offsetof(struct ceduo_arrivals, exact));
    EXPECT(x.exact, ==, y.exact);
    assert_int_equal(ceduo_run_ends(a, &e), CEDUO_OK);
    assert_int_equal(ceduo_run_ends(b, &f), CEDUO_OK);
    assert_memory_equal(&e, &f, sizeof e);
}

static void expect_same_difference(const struct ceduo_run *a, const struct ceduo_run *bare_a, const struct ceduo_run *b,
                                   const struct ceduo_run *bare_b)
{
    struct ceduo_difference d = ceduo_run_difference(a, bare_a, 0), e = ceduo_run_difference(b, bare_b, 0);
    assert_memory_equal(&d, &e, sizeof d);
}

static void parts_cover_the_rocks(void **state)
{
    (void)state;
    const uint64_t rocks[] = {1, 1023, 1024, 1025, ROCKS, 1000000, CEDUO_ROCKS_MOST};
    for (size_t r = 0; r < LENGTH(rocks); r++)
        for (uint64_t parts = 1; parts < 40; parts++) {
            uint64_t at = 0, first, end;
            for (uint64_t i = 1; i <= parts; i++) {
                ceduo_part_range(rocks[r], i, parts, &first, &end);
                assert_int_equal(first, at);
                EXPECT(end, >=, first);
                assert_true(end % CEDUO_BLOCK_ROCKS == 0 || end == rocks[r]);
                at = end;
            }
            assert_int_equal(at, rocks[r]);
        }
}

static void joined_is_one_run(void **state)
{
    (void)state;
    const enum ceduo_contact_model models[] = {CEDUO_STEMS, CEDUO_POISSON};
    const size_t exact[] = {CEDUO_EXACT_BYTES, FEW_BYTES};
    const uint64_t parts[] = {1, 2, 3, 7, 20};
    for (size_t m = 0; m < LENGTH(models); m++)
        for (size_t x = 0; x < LENGTH(exact); x++) {
            init(models[m], m == 0 ? CEDUO_LAW_CRSP : CEDUO_LAW_LUMPED);
            struct ceduo_run_def bare_def = def_of(exact[x], false), def = def_of(exact[x], true);
            struct ceduo_run *bare = run_of(bare_def, ROCKS), *wooded = run_of(def, ROCKS);
            struct ceduo_arrivals a;
            assert_int_equal(ceduo_run_arrivals(wooded, 0, &a), CEDUO_OK);
            EXPECT(a.exact, ==, (x == 0));
            EXPECT(a.reached, >, 100);
            EXPECT(a.reached, <, ROCKS);
            for (size_t p = 0; p < LENGTH(parts); p++) {
                struct ceduo_run *again = joined(def, parts[p]), *bare_again = joined(bare_def, parts[p]);
                expect_same(again, wooded);
                expect_same(bare_again, bare);
                expect_same_difference(again, bare_again, wooded, bare);
                ceduo_run_free(again);
                ceduo_run_free(bare_again);
            }
            ceduo_run_free(bare);
            ceduo_run_free(wooded);
        }
}

/* Blocks that are merged before they are saved are summed in another order: the test above can tell. */
static void the_order_of_the_sums_matters(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_CRSP);
    struct ceduo_run *run = run_of(def_of(CEDUO_EXACT_BYTES, true), ROCKS);
    struct ceduo_moments halves[2] = {{0}, {0}}, all = {0};
    double *energies = malloc(ROCKS * sizeof *energies);
    size_t n = ceduo_run_energies(run, 0, energies, ROCKS);
    for (size_t i = 0; i < n; i++) {
        ceduo_moments_add(&halves[2 * i >= n], energies[i]);
        ceduo_moments_add(&all, energies[i]);
    }
    ceduo_moments_merge(&halves[0], &halves[1]);
    EXPECT(halves[0].n, ==, all.n);
    assert_true(halves[0].m2 != all.m2 || halves[0].mean != all.mean);
    free(energies);
    ceduo_run_free(run);
}

static void steps_of_a_part_change_nothing(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_CRSP);
    struct saved one = part_of(def_of(FEW_BYTES, true), 2, 2, 1), more = part_of(def_of(FEW_BYTES, true), 2, 2, 7);
    assert_int_equal(one.n, more.n);
    assert_memory_equal(one.bytes, more.bytes, one.n);
    free(one.bytes);
    free(more.bytes);
}

static void wrong_parts_are_refused(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_CRSP);
    struct ceduo_run_def def = def_of(CEDUO_EXACT_BYTES, true), other = def;
    struct saved first = part_of(def, 1, 2, 1), second = part_of(def, 2, 2, 1);
    struct saved bare = part_of(def_of(CEDUO_EXACT_BYTES, false), 1, 2, 1);
    struct saved binned = part_of(def_of(FEW_BYTES, true), 1, 2, 1);
    struct ceduo_run *run = run_of(def, 0);
    assert_int_equal(ceduo_run_adopt(run, second.bytes, second.n), CEDUO_BAD_PART); /* not its turn */
    assert_int_equal(ceduo_run_adopt(run, bare.bytes, bare.n), CEDUO_BAD_PART);
    assert_int_equal(ceduo_run_adopt(run, binned.bytes, binned.n), CEDUO_BAD_PART);
    assert_int_equal(ceduo_run_rocks(run), 0);
    assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_OK);
    assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_BAD_PART); /* once more */
    assert_int_equal(ceduo_run_adopt(run, second.bytes, second.n), CEDUO_OK);
    struct ceduo_run *whole = run_of(def, ROCKS);
    expect_same(run, whole);
    ceduo_run_free(run);
    other.rocks_most = ROCKS + 1;
    run = run_of(other, 0);
    assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_BAD_PART);
    ceduo_run_free(run);
    ceduo_run_free(whole);
    free(first.bytes);
    free(second.bytes);
    free(bare.bytes);
    free(binned.bytes);
}

/* A part's bytes, in whole numbers and doubles of eight. */
static void put_double(struct saved *s, size_t at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (size_t i = 0; i < 8; i++)
        s->bytes[at + i] = (unsigned char)(bits >> 8 * i);
}

static void put_count(struct saved *s, size_t at, uint64_t value)
{
    for (size_t i = 0; i < 8; i++)
        s->bytes[at + i] = (unsigned char)(value >> 8 * i);
}

/* Behind the head its first block: contacts, ends, two counts of them and stems, then moments of four numbers each, of the
 * stops, and at the control of four quantities and of the stems hit before; then how many exceed, and ends. */
enum {
    AT_END = 8,
    AT_UPHILL = 8 * 8 + 8 * (1 + CEDUO_ENDS),
    AT_STOPS = AT_UPHILL + 8 * (2 + 3),
    AT_CONTROL = AT_STOPS + 4 * 8,
    AT_HITS = AT_CONTROL + 4 * 4 * 8
};

static void figures_that_are_none_are_refused(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_run_def def = def_of(CEDUO_EXACT_BYTES, false);
    struct saved first = part_of(def, 1, 2, 1), second = part_of(def, 2, 2, 1);
    struct ceduo_run *run = run_of(def, 0);
    const struct {
        size_t at;
        double value;
    } rows[] = {{AT_CONTROL + 8, NAN},       {AT_CONTROL + 8, INFINITY}, {AT_CONTROL + 16, NAN},
                {AT_CONTROL + 16, INFINITY}, {AT_CONTROL + 16, -1},      {AT_CONTROL + 24, NAN},
                {AT_CONTROL + 24, INFINITY}, {AT_STOPS + 24, NAN}, /* without forest none is hit: plain zeros */
                {AT_HITS + 8, -0.},          {AT_HITS + 16, 1},          {AT_HITS + 24, -0.}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        unsigned char was[8];
        memcpy(was, first.bytes + rows[i].at, 8);
        put_double(&first, rows[i].at, rows[i].value);
        assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_BAD_PART);
        memcpy(first.bytes + rows[i].at, was, 8);
    }
    for (size_t i = 0; i < 2; i++) { /* more that leave uphill than leave, more that are stopped early than are stopped */
        put_count(&first, AT_UPHILL + 8 * i, ROCKS);
        assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_BAD_PART);
        put_count(&first, AT_UPHILL + 8 * i, 0);
    }
    assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_OK);
    /* before the first rock, or behind the last */
    const uint64_t ends[] = {0, CEDUO_BLOCK_ROCKS, 6 * CEDUO_BLOCK_ROCKS, ROCKS + 1};
    for (size_t i = 0; i < LENGTH(ends); i++) {
        put_count(&second, AT_END, ends[i]);
        assert_int_equal(ceduo_run_adopt(run, second.bytes, second.n), CEDUO_BAD_PART);
    }
    put_count(&second, AT_END, ROCKS);
    assert_int_equal(ceduo_run_adopt(run, second.bytes, second.n), CEDUO_OK);
    ceduo_run_free(run);
    free(first.bytes);
    free(second.bytes);
}

/* With blocks of all sizes the weights of the ends come behind the stops, and at the control, behind what it has without, those of the
 * rocks that did not come there, and three sums of those that did. */
enum {
    AT_ENDED = AT_STOPS + 4 * 8,
    AT_MISSED = AT_ENDED + 8 * CEDUO_ENDS + 5 * 4 * 8 + 8 + 8 * CEDUO_ENDS,
    AT_SUMS = AT_MISSED + 8 * CEDUO_ENDS
};

static void weights_that_are_none_are_refused(void **state)
{
    (void)state;
    static double volumes[] = {0.05, 1};
    struct ceduo_block_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    init(CEDUO_STEMS, CEDUO_LAW_LUMPED);
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    struct ceduo_run_def def = def_of(CEDUO_EXACT_BYTES, true);
    struct saved first = part_of(def, 1, 2, 1);
    struct ceduo_run *run = run_of(def, 0);
    const size_t places[] = {AT_ENDED,    AT_ENDED + 8 * (CEDUO_ENDS - 1), AT_MISSED, AT_SUMS - 8, AT_SUMS, AT_SUMS + 8,
                             AT_SUMS + 16};
    const double none[] = {-1, NAN, INFINITY, -0.};
    for (size_t i = 0; i < LENGTH(places); i++)
        for (size_t k = 0; k < LENGTH(none); k++) {
            unsigned char was[8];
            memcpy(was, first.bytes + places[i], 8);
            put_double(&first, places[i], none[k]);
            assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_BAD_PART);
            memcpy(first.bytes + places[i], was, 8);
        }
    struct ceduo_ends ends;
    assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK); /* of no rocks yet */
    assert_true(isnan(ends.stop_p50));
    assert_int_equal(ceduo_run_adopt(run, first.bytes, first.n), CEDUO_OK);
    ceduo_run_free(run);
    free(first.bytes);
}

/* Where samples are not kept the energies of the first rocks come last: no more of them than rocks that arrived. */
static void more_energies_than_arrivals_are_refused(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_arrivals a = {.reached = 0};
    struct saved s;
    struct ceduo_run *from = NULL;
    while (a.reached == 0 || a.reached == 8) { /* of eight rocks some */
        ceduo_run_free(from);
        site.scene.simulation.seed++;
        struct ceduo_run_def part = def_of(64, true);
        part.rocks_most = 8;
        part.part = true;
        from = run_of(part, 8);
        assert_int_equal(ceduo_run_arrivals(from, 0, &a), CEDUO_OK);
    }
    struct ceduo_run_def def = def_of(64, true);
    def.rocks_most = 8;
    struct ceduo_run *to = run_of(def, 0);
    assert_int_equal(paper_run_save(from, &s.bytes, &s.n), CEDUO_OK);
    size_t at = s.n - 8 * (size_t)a.reached - 1; /* their bits */
    unsigned lacks = ~(unsigned)s.bytes[at] & 0xff;
    struct saved more = {malloc(s.n + 8), s.n + 8};
    assert_non_null(more.bytes);
    memcpy(more.bytes, s.bytes, s.n);
    more.bytes[at] = (unsigned char)(s.bytes[at] | (lacks & -lacks)); /* one more of them */
    put_double(&more, s.n, 1000);
    assert_int_equal(ceduo_run_adopt(to, more.bytes, more.n), CEDUO_BAD_PART);
    more.bytes[at] = s.bytes[at];
    assert_int_equal(ceduo_run_adopt(to, more.bytes, more.n), CEDUO_BAD_PART); /* too long */
    assert_int_equal(ceduo_run_adopt(to, s.bytes, s.n), CEDUO_OK);
    free(more.bytes);
    free(s.bytes);
    ceduo_run_free(from);
    ceduo_run_free(to);
}

/* Small numbers, from which the bytes to be hurt are drawn. */
static uint64_t next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return *state >> 33;
}

/* Every length of the bytes, and many with some of them changed: refused, or read to the end of the run, and never more. */
static void hostile_bytes_do_no_harm(void **state)
{
    (void)state;
    uint64_t random = 1;
    unsigned refused = 0;
    init(CEDUO_STEMS, CEDUO_LAW_LUMPED);
    for (int k = 0; k < 2; k++) {
        struct ceduo_run_def def = def_of(k == 0 ? CEDUO_EXACT_BYTES : FEW_BYTES, true);
        struct saved s = part_of(def, 1, 1, 1);
        unsigned char *copy = malloc(s.n);
        for (int i = 0; i < 400; i++) {
            size_t n = i < 100 ? next_random(&random) % s.n : s.n;
            memcpy(copy, s.bytes, s.n);
            for (int changes = i < 100 ? 0 : 1 + i % 3; changes > 0; changes--) {
                size_t most = i % 2 == 0 ? s.n : 512, at = next_random(&random) % most; /* also in the head */
                copy[at] = (unsigned char)(i % 5 == 0 ? 0xff : next_random(&random));
            }
            struct ceduo_run *run = run_of(def, 0);
            enum ceduo_status status = ceduo_run_adopt(run, copy, n);
            assert_true(status == CEDUO_OK || status == CEDUO_BAD_PART);
            assert_int_equal(ceduo_run_rocks(run), status == CEDUO_OK ? ROCKS : 0);
            refused += status != CEDUO_OK;
            struct ceduo_arrivals a;
            struct ceduo_ends e;
            assert_int_equal(ceduo_run_arrivals(run, 0, &a), CEDUO_OK);
            assert_int_equal(ceduo_run_ends(run, &e), CEDUO_OK);
            ceduo_run_free(run);
        }
        free(copy);
        free(s.bytes);
    }
    EXPECT(refused, >, 300);
}

/* Each byte of a part of few rocks changed, in two ways: what is adopted even so is no other part than those bytes. */
static void nothing_is_read_otherwise_than_written(void **state)
{
    (void)state;
    init(CEDUO_STEMS, CEDUO_LAW_LUMPED);
    for (int k = 0; k < 4; k++) {
        struct ceduo_run_def def = def_of(k < 2 ? CEDUO_EXACT_BYTES : 64, k % 2 == 0);
        def.rocks_most = 40;
        struct ceduo_run_def part = def;
        part.part = true;
        struct ceduo_run *flown = run_of(part, def.rocks_most);
        struct saved s, again;
        unsigned adopted = 0;
        assert_int_equal(paper_run_save(flown, &s.bytes, &s.n), CEDUO_OK);
        for (size_t i = 0; i < 2 * s.n; i++) {
            const unsigned char was = s.bytes[i / 2];
            s.bytes[i / 2] = was ^ (i % 2 == 0 ? 1 : 0xff);
            struct ceduo_run *run = run_of(def, 0);
            if (ceduo_run_adopt(run, s.bytes, s.n) == CEDUO_OK) {
                assert_int_equal(paper_run_save(run, &again.bytes, &again.n), CEDUO_OK);
                assert_int_equal(again.n, s.n);
                assert_memory_equal(again.bytes, s.bytes, s.n);
                free(again.bytes);
                adopted++;
            }
            ceduo_run_free(run);
            s.bytes[i / 2] = was;
        }
        EXPECT(adopted, >, 100); /* the figures themselves may be any */
        free(s.bytes);
        ceduo_run_free(flown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_cover_the_rocks),
        cmocka_unit_test(joined_is_one_run),
        cmocka_unit_test(the_order_of_the_sums_matters),
        cmocka_unit_test(steps_of_a_part_change_nothing),
        cmocka_unit_test(wrong_parts_are_refused),
        cmocka_unit_test(figures_that_are_none_are_refused),
        cmocka_unit_test(weights_that_are_none_are_refused),
        cmocka_unit_test(more_energies_than_arrivals_are_refused),
        cmocka_unit_test(hostile_bytes_do_no_harm),
        cmocka_unit_test(nothing_is_read_otherwise_than_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
