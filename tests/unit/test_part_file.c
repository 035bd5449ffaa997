/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of parts: what is written is read back, what is none is refused. */
#include "expect.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "io/part_file.h"

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])

static struct text part_line(void)
{
    static const unsigned char bytes[] = "seven!\n";
    char name[] = "a \"scene\" \xc3\xa0 \x01 \xc2\x85 \xe2\x80\xa8 \xf0\x9f\xbf\xbe";
    struct part part = {.scene = name,
                        .shard = 1,
                        .shards = 2,
                        .place = 3,
                        .rocks = 10,
                        .points = 8,
                        .seconds = 0.5,
                        .inputs = bytes,
                        .runs = bytes,
                        .inputs_length = 7,
                        .runs_length = 5};
    struct text text = {0};
    ceduo_part_write(&text, &part);
    text.bytes[--text.length] = '\0'; /* without its end */
    return text;
}

static enum part_fault read_line(const char *line, size_t n, struct part *part, struct arena *arena)
{
    char *copy = malloc(n + 1); /* of its own size: nothing may be read beyond it */
    assert_non_null(copy);
    memcpy(copy, line, n);
    *part = (struct part){0};
    enum part_fault fault = ceduo_part_read(arena, part, copy, n);
    free(copy);
    return fault;
}

static void parts_are_read_back(void **state)
{
    (void)state;
    struct text line = part_line();
    struct arena arena = {0};
    struct part part;
    char *copy = strdup(line.bytes);
    assert_int_equal(ceduo_part_read(&arena, &part, copy, line.length), PART_GOOD);
    assert_string_equal(part.scene, "a \"scene\" \xc3\xa0 \x01 \xc2\x85 \xe2\x80\xa8 \xf0\x9f\xbf\xbe");
    EXPECT(part.shard, ==, 1);
    EXPECT(part.shards, ==, 2);
    EXPECT(part.place, ==, 3);
    EXPECT(part.rocks, ==, 10);
    EXPECT(part.points, ==, 8);
    EXPECT(part.seconds, ==, 0.5);
    EXPECT(part.inputs_length, ==, 7);
    EXPECT(part.runs_length, ==, 5);
    assert_memory_equal(part.inputs, "seven!\n", 7);
    assert_memory_equal(part.runs, "seven", 5);
    free(copy);
    assert_int_equal(read_line("", 0, &part, &arena), PART_NONE);
    assert_int_equal(read_line("{}", 2, &part, &arena), PART_NONE);
    for (size_t n = 1; n < line.length; n++)
        assert_int_equal(read_line(line.bytes, n, &part, &arena), PART_CUT);
    char *other = strdup(line.bytes);
    for (size_t i = 0; i < line.length; i++) {
        other[i] ^= 1;
        assert_int_not_equal(read_line(other, line.length, &part, &arena), PART_GOOD);
        other[i] ^= 1;
    }
    free(other);
    ceduo_arena_free(&arena);
    ceduo_text_free(&line);
}

/* The line with one word replaced, and its sum that of what it says now. */
static enum part_fault changed(const struct text *line, const char *from, const char *to)
{
    static const char sum[] = ", \"sum\": \"";
    const char *at = strstr(line->bytes, from), *end = strstr(line->bytes, sum);
    assert_true(at);
    assert_true(end);
    assert_true(at < end);
    struct text text = {0};
    struct arena arena = {0};
    struct part part;
    ceduo_text_add(&text, line->bytes, (size_t)(at - line->bytes));
    ceduo_text_put(&text, to);
    ceduo_text_add(&text, at + strlen(from), (size_t)(end - at) - strlen(from));
    uint64_t now = hash_bytes(text.bytes, text.length);
    ceduo_text_format(&text, "%s%016" PRIx64 "\"}", sum, now);
    enum part_fault fault = read_line(text.bytes, text.length, &part, &arena);
    ceduo_arena_free(&arena);
    ceduo_text_free(&text);
    return fault;
}

static void parts_of_another_kind(void **state)
{
    (void)state;
    struct text line = part_line();
    assert_int_equal(changed(&line, "\"place\"", "\"place\""), PART_GOOD);
    assert_int_equal(changed(&line, "\"points\": 8, ", ""), PART_GOOD); /* as parts of runs have it */
    assert_int_equal(changed(&line, "ceduo-part-1", "ceduo-part-2"), PART_FORMAT);
    assert_int_equal(changed(&line, "\"version\": \"", "\"version\": \"9"), PART_VERSION);
    const char *const rows[][2] = {{"\"scene\"", "\"Scene\""},
                                   {"\"place\": 3", "\"place\": 0"},
                                   {"\"place\": 3", "\"place\": "},
                                   {"\"place\": 3", "\"place\": 2.5"},
                                   {"\"place\": 3", "\"place\": 3000000000"},
                                   {"\"place\": 3", "\"place\": 1111111111111111111111111111111"},
                                   {"\"shard\": 1", "\"shard\": 3"},
                                   {"\"shard\": 1", "\"hard\": 1"},
                                   {"\"shards\": 2", "\"shards\": x"},
                                   {"\"rocks\": 10", "\"rocks\": 0"},
                                   {"\"rocks\": 10", "\"rocks\": 1e99"},
                                   {"\"points\": 8", "\"points\": 1"},
                                   {"\"points\": 8", "\"points\": x"},
                                   {"c2V2ZW4=\"", "c2V2ZW4=\", \"x\": 1"},
                                   {"\"seconds\"", "\"second\""},
                                   {"\"seconds\": 0.5", "\"seconds\": -1"},
                                   {"\"seconds\": 0.5", "\"seconds\": x"},
                                   {"\"seconds\": 0.5", "\"seconds\": 0.50000000000000000000000000000000000000"},
                                   {"\"hash\"", "\"Hash\""},
                                   {"\"hash\": \"0", "\"hash\": \"g"},
                                   {"\"inputs\"", "\"Inputs\""},
                                   {"\"runs\"", "\"Runs\""},
                                   {"\"inputs\": \"", "\"inputs\": \"!!!!"},
                                   {"\"inputs\": \"", "\"inputs\": \"a"},
                                   {"c2V2ZW4=", "c2V2ZW4"},
                                   {"\"runs\": \"", "\"runs\": \"===="},
                                   {"\\u0001", "\\u0000"},
                                   {"\\u0001", "\\u00g1"},
                                   {"\\u0001", "\\u00"}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        if (changed(&line, rows[i][0], rows[i][1]) != PART_CHANGED)
            fail_msg("%s for %s", rows[i][1], rows[i][0]);
    ceduo_text_free(&line);
}

/* A part up to some byte, or with a NUL in it, is none even if its sum is right. */
static void parts_that_are_cut_within(void **state)
{
    (void)state;
    static const char sum[] = ", \"sum\": \"";
    struct text line = part_line();
    struct arena arena = {0};
    struct part part;
    size_t length = (size_t)(strstr(line.bytes, sum) - line.bytes),
           place = (size_t)(strstr(line.bytes, "\"place\"") - line.bytes);
    for (int nul = 0; nul < 2; nul++)
        for (size_t i = nul ? place : 0; i < length; i++) {
            struct text text = {0};
            ceduo_text_add(&text, line.bytes, nul ? length : i);
            if (nul)
                text.bytes[i] = '\0';
            uint64_t now = hash_bytes(ceduo_text_string(&text), text.length);
            ceduo_text_format(&text, "%s%016" PRIx64 "\"}", sum, now);
            assert_int_not_equal(read_line(text.bytes, text.length, &part, &arena), PART_GOOD);
            ceduo_text_free(&text);
        }
    ceduo_arena_free(&arena);
    ceduo_text_free(&line);
}

/* Any beginning of the inputs is none, and none of their bytes can be changed into something that is read beyond its end. */
static void inputs_are_refused(void **state)
{
    (void)state;
    const char *sets[] = {"a=1"}, *options[] = {"one", "two", ""};
    struct arena arena = {0};
    struct part_inputs in = {.path = "scene.yaml", .sets = {sets, 1}, .options = {options, 3}}, back;
    assert_true(ceduo_shelf_find(&arena, &in.shelf, "s", NULL, "stands", "/s.yaml"));
    assert_true(ceduo_shelf_file(&arena, &in.shelf, "/s.yaml", "text", 4));
    size_t n;
    unsigned char *bytes = ceduo_part_inputs(&in, &n);
    assert_true(ceduo_part_inputs_read(&arena, &back, bytes, n));
    assert_string_equal(back.options.items[1], "two");
    assert_string_equal(back.options.items[2], "");
    assert_null(back.shelf.finds->beside);
    assert_string_equal(back.shelf.finds->folder, "stands");
    assert_memory_equal(back.shelf.files->bytes, "text", 5);
    for (size_t less = 0; less < n; less++) {
        unsigned char *copy = malloc(less + 1);
        memcpy(copy, bytes, less);
        assert_false(ceduo_part_inputs_read(&arena, &back, copy, less));
        free(copy);
    }
    for (size_t i = 0; i < n; i++)
        for (unsigned bit = 0; bit < 8; bit++) {
            bytes[i] ^= (unsigned char)(1u << bit);
            if (ceduo_part_inputs_read(&arena, &back, bytes, n)) {
                size_t m;
                unsigned char *again = ceduo_part_inputs(&back, &m);
                assert_int_equal(m, n);
                assert_memory_equal(again, bytes, n);
                free(again);
            }
            bytes[i] ^= (unsigned char)(1u << bit);
        }
    free(bytes);
    ceduo_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_read_back),
        cmocka_unit_test(parts_of_another_kind),
        cmocka_unit_test(parts_that_are_cut_within),
        cmocka_unit_test(inputs_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
