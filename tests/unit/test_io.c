/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts, trees, files and parts at their edges: what is written is read back, what is none is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* cmocka wants the four above first */
#include <cmocka.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "ceduo/part.h"
#include "io/emit.h"
#include "io/file.h"
#include "base/json.h"
#include "base/utf8.h"
#include "io/node.h"
#include "io/part_file.h"
#include "io/resolve.h"
#include "io/scene_file.h"
#include "scene/schema.h"

#define LENGTH(a) (sizeof(a) / sizeof(a)[0])

/* ---- texts ---- */

static void utf8_is_decoded(void **state)
{
    (void)state;
    const struct {
        const char *bytes;
        size_t length;
        uint32_t code;
    } rows[] = {{"a", 1, 'a'},
                {"\x7f", 1, 0x7f},
                {"\xc2\x80", 2, 0x80},
                {"\xdf\xbf", 2, 0x7ff},
                {"\xe0\xa0\x80", 3, 0x800},
                {"\xed\x9f\xbf", 3, 0xd7ff},
                {"\xee\x80\x80", 3, 0xe000},
                {"\xef\xbf\xbf", 3, 0xffff},
                {"\xf0\x90\x80\x80", 4, 0x10000},
                {"\xf4\x8f\xbf\xbf", 4, 0x10ffff},
                {"\x80", 0, 0},
                {"\xc1\xbf", 0, 0},         /* too long a form */
                {"\xe0\x9f\xbf", 0, 0},
                {"\xf0\x8f\xbf\xbf", 0, 0},
                {"\xed\xa0\x80", 0, 0},     /* half a pair */
                {"\xed\xbf\xbf", 0, 0},
                {"\xf4\x90\x80\x80", 0, 0}, /* beyond the last */
                {"\xf5\x80\x80\x80", 0, 0},
                {"\xc3", 0, 0},             /* cut */
                {"\xe2\x80", 0, 0},
                {"\xc3g", 0, 0},
                {"\xe2\x80g", 0, 0}};
    uint32_t code = 0;
    for (size_t i = 0; i < LENGTH(rows); i++) {
        assert_int_equal(ceduo_utf8_decode(rows[i].bytes, strlen(rows[i].bytes), &code), rows[i].length);
        if (rows[i].length > 0)
            assert_int_equal(code, rows[i].code);
    }
    assert_int_equal(ceduo_utf8_decode("", 0, &code), 0);
}

/* Code points that are shown as they are, by whether a terminal or a line of JSON could take them for more. */
static void no_character_does_anything(void **state)
{
    (void)state;
    const struct {
        const char *from, *safe, *json;
    } rows[] = {{"a b", "a b", "\"a b\""},
                {"\xc3\xa0", "\xc3\xa0", "\"\xc3\xa0\""},
                {"\x1b[2J", "\\x1b[2J", "\"\\u001b[2J\""},
                {"\x7f", "\\x7f", "\"\\u007f\""},
                {"\xc2\x80", "\\xc2\\x80", "\"\\u0080\""},
                {"\xc2\x9f", "\\xc2\\x9f", "\"\\u009f\""},
                {"\xc2\xa0", "\xc2\xa0", "\"\xc2\xa0\""},
                {"\xe2\x80\xa7", "\xe2\x80\xa7", "\"\xe2\x80\xa7\""},
                {"\xe2\x80\xa8", "\\xe2\\x80\\xa8", "\"\\u2028\""},
                {"\xe2\x80\xa9", "\\xe2\\x80\\xa9", "\"\\u2029\""},
                {"\xe2\x80\xaa", "\\xe2\\x80\\xaa", "\"\\u202a\""},
                {"\xe2\x80\xae", "\\xe2\\x80\\xae", "\"\\u202e\""},
                {"\xe2\x80\xaf", "\xe2\x80\xaf", "\"\xe2\x80\xaf\""},
                {"\xe2\x81\xa5", "\xe2\x81\xa5", "\"\xe2\x81\xa5\""},
                {"\xe2\x81\xa6", "\\xe2\\x81\\xa6", "\"\\u2066\""},
                {"\xe2\x81\xa9", "\\xe2\\x81\\xa9", "\"\\u2069\""},
                {"\xe2\x81\xaa", "\xe2\x81\xaa", "\"\xe2\x81\xaa\""},
                {"\"\\", "\"\\", "\"\\\"\\\\\""},
                {"\xff", "\\xff", "\"\\ufffd\""}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct text safe = {0}, line = {0};
        struct json json = {.text = &line};
        ceduo_text_safe(&safe, rows[i].from);
        ceduo_json_string(&json, NULL, rows[i].from);
        assert_string_equal(safe.bytes, rows[i].safe);
        assert_string_equal(line.bytes, rows[i].json);
        ceduo_text_free(&safe);
        ceduo_text_free(&line);
    }
}

/* Fewest digits with which %e reads back as the same. */
static int fewest_digits(double value)
{
    char room[64];
    for (int digits = 1;; digits++) {
        snprintf(room, sizeof room, "%.*e", digits - 1, value);
        if (strtod(room, NULL) == value)
            return digits;
    }
}

static void expect_shortest(double value)
{
    char room[CEDUO_NUMBER_ROOM];
    const char *text = ceduo_number_shortest(value, room);
    double back = 0;
    assert_int_equal(ceduo_number_read(text, &back), CEDUO_NUMBER_GOOD);
    if (back != value)
        fail_msg("%a is written as %s", value, text);
    if (fabs(value) >= 1e15 && fabs(value) < 1e17)
        return; /* whole, with all its digits */
    size_t from = strspn(text, "-0."), digits = 0, zeros = 0;
    for (const char *p = text + from; *p && *p != 'e'; p++) {
        digits += *p != '.';
        zeros = *p == '0' ? zeros + 1 : *p == '.' ? zeros : 0;
    }
    if ((int)(digits - zeros) > fewest_digits(value))
        fail_msg("%a is written as %s", value, text);
}

static void numbers_are_short(void **state)
{
    (void)state;
    const double few[] = {1, -1, .1, 1. / 3, 1e-5, 1e-6, 123456789, 1e14, 1e15, 1e16, 1e17, 12345678901234567., 1e22, 4.9e-324,
                          2.2250738585072014e-308, 1.7976931348623157e308, 9007199254740993., .3, 2.5e-310, 999999999999999.9};
    for (size_t i = 0; i < LENGTH(few); i++) {
        expect_shortest(few[i]);
        expect_shortest(-few[i]);
    }
    uint64_t bits = 1;
    for (int i = 0; i < 20000; i++) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        uint64_t mixed = bits ^ bits >> 31;
        double value;
        memcpy(&value, &mixed, sizeof value);
        if (isfinite(value) && value != 0)
            expect_shortest(value);
        expect_shortest(((double)(mixed >> 40) - 8e6 + .5) / (double)(1 + (mixed & 1023)));
    }
    char room[CEDUO_NUMBER_ROOM];
    assert_string_equal(ceduo_number_shortest(NAN, room), "null");
    assert_string_equal(ceduo_number_shortest(-INFINITY, room), "null");
    assert_string_equal(ceduo_number_shortest(-0., room), "0");
}

static void numbers_are_read(void **state)
{
    (void)state;
    const char *const good[] = {"0", "12", "-0.5", "+.5", "1.", "1e3", "1E-3", "1e+3", "0.0"};
    const char *const none[] = {"", "-", ".", "e3", "1e", "1e+", "1,5", "0x10", "010", "inf", "nan", " 1", "1 ", "1_0", "--1", "1e3x"};
    double value;
    uint64_t count;
    for (size_t i = 0; i < LENGTH(good); i++) {
        assert_int_equal(ceduo_number_read(good[i], &value), CEDUO_NUMBER_GOOD);
        assert_true(value == strtod(good[i], NULL));
    }
    for (size_t i = 0; i < LENGTH(none); i++) {
        assert_int_equal(ceduo_number_read(none[i], &value), CEDUO_NUMBER_NONE);
        assert_int_equal(ceduo_count_read(none[i], 0, 1e9, &count), CEDUO_NUMBER_NONE);
    }
    assert_int_equal(ceduo_number_read("1e999", &value), CEDUO_NUMBER_TOO_LARGE);
    const struct {
        const char *text;
        double hi;
        enum ceduo_number_reading reading;
        uint64_t value;
    } counts[] = {{"7", 9, CEDUO_NUMBER_GOOD, 7},
                  {"1e3", 1e9, CEDUO_NUMBER_GOOD, 1000},
                  {"2.0", 9, CEDUO_NUMBER_GOOD, 2},
                  {"2.5", 9, CEDUO_NUMBER_NONE, 0},
                  {"10", 9, CEDUO_NUMBER_TOO_LARGE, 0},
                  {"-1", 9, CEDUO_NUMBER_TOO_LARGE, 0},
                  {"1e999", 9, CEDUO_NUMBER_TOO_LARGE, 0},
                  {"9007199254740993", 9.1e15, CEDUO_NUMBER_GOOD, 9007199254740993u},
                  {"9007199254740993", 9007199254740992., CEDUO_NUMBER_TOO_LARGE, 0}};
    for (size_t i = 0; i < LENGTH(counts); i++) {
        assert_int_equal(ceduo_count_read(counts[i].text, 0, counts[i].hi, &count), counts[i].reading);
        if (counts[i].reading == CEDUO_NUMBER_GOOD)
            assert_int_equal(count, counts[i].value);
    }
}

static void no_word_is_near_a_long_one(void **state)
{
    (void)state;
    char word[65] = {0};
    memset(word, 'a', 64);
    const char *words[] = {word, "ab"};
    assert_null(ceduo_text_nearest("bb", words, 1));
    assert_string_equal(ceduo_text_nearest("bb", words, 2), "ab");
    assert_null(ceduo_text_nearest(word, words + 1, 1));
}

static void an_arena_says_that_it_is_full(void **state)
{
    (void)state;
    struct arena arena = {0};
    assert_non_null(ceduo_arena_take(&arena, 8));
    size_t before = arena.bytes;
    assert_false(arena.failed);
    assert_null(ceduo_arena_take(&arena, SIZE_MAX)); /* rounded up it would be 0 */
    assert_true(arena.failed && arena.bytes == before);
    ceduo_arena_free(&arena);
}

/* ---- trees ---- */

static const struct node *parse(struct arena *arena, const struct text *text)
{
    struct source *source = ceduo_arena_take(arena, sizeof *source);
    struct problems problems = {0};
    *source = (struct source){
        .name = "test", .bytes = ceduo_arena_copy(arena, text->bytes, text->length), .length = text->length};
    const struct node *root = ceduo_yaml_read(arena, source, &problems);
    if (!root)
        fail_msg("%s\n%s", text->bytes, problems.text.bytes);
    ceduo_problems_free(&problems);
    return root;
}

static const struct node *parsed(struct arena *arena, const char *bytes)
{
    struct text text = {.bytes = (char *)(uintptr_t)bytes, .length = strlen(bytes)};
    return parse(arena, &text);
}

/* Written in its two ways, a tree is read back as it is. */
static void expect_back(struct arena *arena, const struct node *node)
{
    for (int way = 0; way < 2; way++) {
        struct text text = {0};
        if (way == 0)
            ceduo_emit(&text, node);
        else
            ceduo_emit_flow(&text, node);
        const struct node *back = parse(arena, &text);
        if (!ceduo_node_equal(back, node) || (node->kind == NODE_SCALAR && strcmp(back->text, node->text) != 0))
            fail_msg("not read back: %s", text.bytes);
        ceduo_text_free(&text);
    }
}

static void scalars_are_read_back(void **state)
{
    (void)state;
    const char *const words[] = {
        "",     " a",   "a ",  "true", "false", "null", "yes", "~",    "y",   "-",   "- a", "-a",   "--",  "a-b", "a:b",
        "a: b", "#x",   "a #b", "\"q\"", "\\",  "\n",   "a\nb", "\x01", "\x7f", "0.5", "1e5", "007", "+1",  "\xc3\xa0", "[a]",
        "{a}",  "&a",   "*a",  "!a",   "%a",    "@a",   "`a`", "|",    ">",   "?",   "? a", ":",    "a,b", "=",   "<<",
        "_",    ".",    "/",   "a/b",  "..",    "---",  "...", "'",    "a'b", "AZaz09", "on", "null x", "a\tb", "\\n", "no",
        "a\xc2\x80", "a\xc2\x85z", "\xc2\x9f", "\xc2\xa0", "a\xe2\x80\xa8z", "\xe2\x80\xa9", "\xef\xbb\xbf" "a", "\xef\xbf\xbe", "\xef\xbf\xbf",
        "\xf4\x8f\xbf\xbf", "a\rb", "a  b", " ", "\t"};
    struct arena arena = {0};
    const struct node *empty = parsed(&arena, "{}");
    for (size_t i = 0; i < LENGTH(words); i++)
        for (int quoted = 0; quoted < 2; quoted++) {
            const struct node *word = ceduo_node_scalar(&arena, NULL, words[i], quoted);
            expect_back(&arena, ceduo_node_with(&arena, empty, "key", word));
            const struct node *list = parsed(&arena, "[a, [b], {c: d}]");
            expect_back(&arena, ceduo_node_replaced(&arena, list, 0, word));
            expect_back(&arena, ceduo_node_replaced(&arena, parsed(&arena, "[[a, b]]"), 0, ceduo_node_replaced(&arena, list, 2, word)));
        }
    ceduo_arena_free(&arena);
}

static void trees_are_read_back(void **state)
{
    (void)state;
    const char *const trees[] = {
        "a: {}\nb: []\n", "- - - 1\n    - 2\n  - []\n", "- {}\n- a: 1\n  b: [1, 2]\n",
        "a: [[1, 2], [3, 4], {b: [5, {c: 6}]}]\n",
        "a: [aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb, ccccccccccccccccccccccccccccccc]\n",
        "a: [[aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb, cccccccccccccccccccccccccccc], [], 1]\n",
        "- [[aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb, cccccccccccccccccccccccccccc], [], 1]\n",
        "- {a: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, b: bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb, c: ccccccccccc}\n"};
    struct arena arena = {0};
    for (size_t i = 0; i < LENGTH(trees); i++)
        expect_back(&arena, parsed(&arena, trees[i]));
    ceduo_arena_free(&arena);
}

static void trees_are_compared(void **state)
{
    (void)state;
    const struct {
        const char *a, *b;
        bool equal;
    } rows[] = {{"1", "1", true},           {"1", "1.0", false},     {"1", "'1'", false},      {"a", "'a'", true},
                {"a", "[a]", false},        {"[a]", "[a, b]", false}, {"[a, b]", "[a, c]", false}, {"{a: 1}", "{a: 1}", true},
                {"{a: 1}", "{b: 1}", false}, {"{a: 1}", "{a: 2}", false}, {"'1'", "'1'", true},  {"{a: 1}", "[1]", false}};
    struct arena arena = {0};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct node *a = parsed(&arena, rows[i].a), *b = parsed(&arena, rows[i].b);
        assert_int_equal(ceduo_node_equal(a, b), rows[i].equal);
        assert_int_equal(ceduo_node_equal(b, a), rows[i].equal);
        assert_true(ceduo_node_equal(a, a));
        assert_false(ceduo_node_equal(a, NULL));
        assert_false(ceduo_node_equal(NULL, a));
    }
    const struct node *map = parsed(&arena, "{a: 1, b: [1, 2, 3]}"), *b = ceduo_node_get(map, "b");
    assert_false(ceduo_node_equal(ceduo_node_renamed(&arena, b, NULL), b)); /* one has a key */
    assert_null(ceduo_node_get(NULL, "a"));
    assert_null(ceduo_node_get(b, "a"));
    assert_null(ceduo_node_text(map, "b"));
    assert_null(ceduo_node_text(map, "c"));
    assert_string_equal(ceduo_node_text(map, "a"), "1");
    assert_ptr_equal(ceduo_node_without(&arena, map, "c"), map);
    assert_true(ceduo_node_equal(ceduo_node_without(&arena, map, "b"), parsed(&arena, "{a: 1}")));
    const char *const less[] = {"[2, 3]", "[1, 3]", "[1, 2]"};
    const char *const more[] = {"[9, 1, 2, 3]", "[1, 9, 2, 3]", "[1, 2, 9, 3]", "[1, 2, 3, 9]"};
    const struct node *list = parsed(&arena, "[1, 2, 3]"), *nine = parsed(&arena, "9");
    for (size_t i = 0; i < 3; i++)
        assert_true(ceduo_node_equal(ceduo_node_removed(&arena, list, i), parsed(&arena, less[i])));
    for (size_t i = 0; i < 4; i++)
        assert_true(ceduo_node_equal(ceduo_node_inserted(&arena, list, i, nine), parsed(&arena, more[i])));
    ceduo_arena_free(&arena);
}

/* Values put into a text, the rest of it left as it is: NULL where more has changed than values. */
static void texts_are_patched(void **state)
{
    (void)state;
    const struct {
        const char *before, *now, *wanted;
    } rows[] = {
        {"a: 1 # c\n", "a: 2", "a: 2 # c\n"},
        {"\xef\xbb\xbf" "a: 1 # c\n", "a: 2", "\xef\xbb\xbf" "a: 2 # c\n"},
        {"'\xc3\xa0': 1 # c\nb: [1, 2] # d", "{'\xc3\xa0': 5, b: [1, 3]}", "'\xc3\xa0': 5 # c\nb: [1, 3] # d"},
        {"a: [1, 2] # c\n", "a: [1, 2, 3]", "a: [1, 2, 3] # c\n"},
        {"a: {b: 1} # c\n", "a: {c: 1}", "a: {c: 1} # c\n"},
        {"a: [1] # c\n", "a: x", "a: x # c\n"},
        {"a: 1 # c\n", "a: [x, z]", "a: [x, z] # c\n"},
        {"a: 1\n", "a: 1", "a: 1\n"},
        {"a: 1\n", "{a: 1, b: 2}", NULL},
        {"a:\n  b: 1\n", "a: {b: 1, c: 2}", NULL},
        {"a:\n  b: 1\n", "a: {c: 1}", NULL},
        {"a:\n  - 1\n", "a: x", NULL},
        {"5", "6", "6"},
        {"a: 1", "a: 2", "a: 2"},
        /* libyaml ends a line at U+2028, too: its places are others than those that are patched */
        {"# \xe2\x80\xa8# c\na: 1", "a: 2", NULL},
        {"# \xe2\x80\xa8# c\na: 1\n", "a: 2", NULL},
        {"#\xe2\x80\xa8#\na:                    1\nb: 2\n# a line of some length\n", "{a: 3, b: 4}", NULL},
        {"#\xe2\x80\xa8#\na:                    1\nb: [2]\n# a line of some length\n", "{a: 3, b: [2, 4]}", NULL},
        {"#\xe2\x80\xa8#\na:                    \"x\n y\"\n# a line of some length\n", "a: z", NULL},
    };
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct arena arena = {0};
        struct text text = {0};
        const struct node *old = parsed(&arena, rows[i].before), *now = parsed(&arena, rows[i].now);
        bool good = ceduo_emit_patched(&text, old->source, old, now);
        assert_int_equal(good, rows[i].wanted != NULL);
        if (good)
            assert_string_equal(text.bytes, rows[i].wanted);
        else
            assert_int_equal(text.length, 0);
        ceduo_text_free(&text);
        ceduo_arena_free(&arena);
    }
}

/* ---- parts ---- */

static struct text part_line(void)
{
    static const unsigned char bytes[] = "seven!\n";
    char name[] = "a \"scene\" \xc3\xa0 \x01 \xc2\x85 \xe2\x80\xa8";
    struct part part = {.scene = name, .shard = 1, .shards = 2, .place = 3, .rocks = 10, .seconds = 0.5, .inputs = bytes,
                        .runs = bytes, .inputs_length = 7, .runs_length = 5};
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
    assert_string_equal(part.scene, "a \"scene\" \xc3\xa0 \x01 \xc2\x85 \xe2\x80\xa8");
    assert_true(part.shard == 1 && part.shards == 2 && part.place == 3 && part.rocks == 10 && part.seconds == 0.5);
    assert_true(part.inputs_length == 7 && part.runs_length == 5);
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
    assert_true(at && end && at < end);
    struct text text = {0};
    struct arena arena = {0};
    struct part part;
    ceduo_text_add(&text, line->bytes, (size_t)(at - line->bytes));
    ceduo_text_put(&text, to);
    ceduo_text_add(&text, at + strlen(from), (size_t)(end - at) - strlen(from));
    uint64_t now = ceduo_bytes_sum(text.bytes, text.length);
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
    assert_int_equal(changed(&line, "ceduo-part-1", "ceduo-part-2"), PART_FORMAT);
    assert_int_equal(changed(&line, "\"version\": \"", "\"version\": \"9"), PART_VERSION);
    const char *const rows[][2] = {
        {"\"scene\"", "\"Scene\""},          {"\"place\": 3", "\"place\": 0"},    {"\"place\": 3", "\"place\": "},
        {"\"place\": 3", "\"place\": 2.5"},  {"\"place\": 3", "\"place\": 3000000000"},
        {"\"place\": 3", "\"place\": 1111111111111111111111111111111"},           {"\"shard\": 1", "\"shard\": 3"},
        {"\"shard\": 1", "\"hard\": 1"},     {"\"shards\": 2", "\"shards\": x"},  {"\"rocks\": 10", "\"rocks\": 0"},
        {"\"rocks\": 10", "\"rocks\": 1e99"}, {"\"seconds\"", "\"second\""},      {"\"seconds\": 0.5", "\"seconds\": -1"},
        {"\"seconds\": 0.5", "\"seconds\": x"},
        {"\"seconds\": 0.5", "\"seconds\": 0.50000000000000000000000000000000000000"}, {"\"hash\"", "\"Hash\""},
        {"\"hash\": \"0", "\"hash\": \"g"},  {"\"inputs\"", "\"Inputs\""},        {"\"runs\"", "\"Runs\""},
        {"\"inputs\": \"", "\"inputs\": \"!!!!"}, {"\"inputs\": \"", "\"inputs\": \"a"}, {"c2V2ZW4=", "c2V2ZW4"}, {"\"runs\": \"", "\"runs\": \"===="},
        {"\\u0001", "\\u0000"},              {"\\u0001", "\\u00g1"},              {"\\u0001", "\\u00"}};
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
    size_t length = (size_t)(strstr(line.bytes, sum) - line.bytes), place = (size_t)(strstr(line.bytes, "\"place\"") - line.bytes);
    for (int nul = 0; nul < 2; nul++)
        for (size_t i = nul ? place : 0; i < length; i++) {
            struct text text = {0};
            ceduo_text_add(&text, line.bytes, nul ? length : i);
            if (nul)
                text.bytes[i] = '\0';
            uint64_t now = ceduo_bytes_sum(text.bytes ? text.bytes : "", text.length);
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
    struct part_inputs in = {.path = "scene.yaml", .sets = sets, .options = options, .sets_count = 1, .options_count = 3}, back;
    assert_true(ceduo_shelf_find(&arena, &in.shelf, "s", NULL, "stands", "/s.yaml"));
    assert_true(ceduo_shelf_file(&arena, &in.shelf, "/s.yaml", "text", 4));
    size_t n;
    unsigned char *bytes = ceduo_part_inputs(&in, &n);
    assert_true(ceduo_part_inputs_read(&arena, &back, bytes, n));
    assert_string_equal(back.options[1], "two");
    assert_string_equal(back.options[2], "");
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

/* ---- files ---- */

static char folder[64];

static void in_folder(char path[256], const char *name)
{
    snprintf(path, 256, "%s/%s", folder, name);
}

static void put(const char *name, const char *text)
{
    char path[256];
    in_folder(path, name);
    assert_true(ceduo_file_write(path, text, strlen(text)));
}

static int set_up(void **state)
{
    (void)state;
    char path[256];
    snprintf(folder, sizeof folder, "/tmp/ceduo-test-XXXXXX");
    assert_non_null(mkdtemp(folder));
    const char *const folders[] = {"ceduo", "ceduo/stands", "ceduo/stands/folder.yaml"};
    for (size_t i = 0; i < LENGTH(folders); i++) {
        in_folder(path, folders[i]);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    setenv("XDG_DATA_HOME", folder, 1);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void files_are_found(void **state)
{
    (void)state;
    struct arena arena = {0};
    put("ceduo/stands/own.yaml", "x");
    put("ceduo/top.yaml", "x");
    put("beside.yaml", "x");
    char beside[256], wanted[256];
    in_folder(beside, "scene.yaml");
    const struct {
        const char *name, *found;
        bool folder;
    } rows[] = {{"beside.yaml", "beside.yaml", true},
                {"own.yaml", "ceduo/stands/own.yaml", true},
                {"own", "ceduo/stands/own.yaml", true},
                {"own", NULL, false},
                {"./top.yaml", "ceduo/top.yaml", true},
                {"../top.yaml", "ceduo/top.yaml", true},
                {"../.././stands/own.yaml", "ceduo/stands/own.yaml", false},
                {"stands/own", NULL, true},
                {"folder.yaml", NULL, true}, /* a folder is no file */
                {"nothing", NULL, true},
                {"/nothing", NULL, true}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const char *found = ceduo_file_find(&arena, rows[i].name, beside, rows[i].folder ? "stands" : NULL);
        if (!rows[i].found) {
            assert_null(found);
            continue;
        }
        in_folder(wanted, rows[i].found);
        assert_non_null(found);
        assert_string_equal(found, wanted);
    }
    in_folder(wanted, "beside.yaml");
    assert_string_equal(ceduo_file_find(&arena, wanted, NULL, NULL), wanted);
    ceduo_arena_free(&arena);
}

static void folders_of_the_environment(void **state)
{
    (void)state;
    char own[256], home[256], path[256];
    in_folder(own, "ceduo");
    in_folder(home, "home");
    const char *const parts[] = {"home", "home/.local", "home/.local/share", "home/.local/share/ceduo"};
    for (size_t i = 0; i < LENGTH(parts); i++) {
        in_folder(path, parts[i]);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    char file[256]; /* what should be the folder is a file */
    in_folder(file, "file");
    assert_int_equal(mkdir(file, 0700), 0);
    put("file/ceduo", "x");
    const struct {
        const char *data, *home, *first;
    } rows[] = {{folder, home, own}, {file, home, NULL}, {NULL, home, path}, {"relative", home, path}, {"", home, path}, {NULL, "", NULL}, {NULL, NULL, NULL}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct arena arena = {0};
        rows[i].data ? setenv("XDG_DATA_HOME", rows[i].data, 1) : unsetenv("XDG_DATA_HOME");
        rows[i].home ? setenv("HOME", rows[i].home, 1) : unsetenv("HOME");
        const char *const *folders = ceduo_file_folders(&arena);
        bool is_first = folders[0] && rows[i].first && strcmp(folders[0], rows[i].first) == 0;
        assert_int_equal(is_first, rows[i].first != NULL);
        for (size_t k = is_first; folders[k]; k++)
            assert_null(strstr(folders[k], folder));
        ceduo_arena_free(&arena);
    }
    setenv("XDG_DATA_HOME", folder, 1);
}

static void folders_are_listed(void **state)
{
    (void)state;
    struct arena arena = {0};
    char own[256];
    in_folder(own, "ceduo");
    size_t n = 1;
    assert_null(ceduo_file_list(&arena, own, "slopes", &n));
    assert_int_equal(n, 0);
    const char *const names[] = {"ceduo/stands/a-b.yaml", "ceduo/stands/a.yaml", "ceduo/stands/letter.txt", "ceduo/stands/.yaml",
                                 "ceduo/stands/.c.yaml", "ceduo/stands/B.yaml", "ceduo/stands/x", "ceduo/stands/aaaa.yaml",
                                 "ceduo/stands/aa.yaml", "ceduo/stands/aaaaa.yaml", "ceduo/stands/aaa.yaml"};
    for (size_t i = 0; i < LENGTH(names); i++)
        put(names[i], "x");
    const char *const wanted[] = {"B.yaml", "a.yaml", "a-b.yaml", "aa.yaml", "aaa.yaml", "aaaa.yaml", "aaaaa.yaml", "folder.yaml"};
    const char *const *list = ceduo_file_list(&arena, own, "stands", &n);
    assert_int_equal(n, LENGTH(wanted));
    for (size_t i = 0; i < n; i++)
        assert_string_equal(list[i], wanted[i]);
    for (int i = 0; i < 100; i++) { /* more than are first made room for */
        char name[64];
        snprintf(name, sizeof name, "ceduo/stands/n%02d.yaml", i);
        put(name, "x");
    }
    list = ceduo_file_list(&arena, own, "stands", &n);
    assert_int_equal(n, 108);
    for (size_t i = 8; i < n; i++)
        assert_int_equal(atoi(list[i] + 1), (int)i - 8);
    ceduo_arena_free(&arena);
}

/* Names as long as a file system takes them, of characters of two bytes: its temporary's name is cut between two. */
static void long_names_are_written(void **state)
{
    (void)state;
    char name[256] = "", path[512];
    for (int i = 0; i < 127; i++)
        strcat(name, "\xc3\xa4");
    for (int longer = 0; longer < 2; longer++) {
        snprintf(path, sizeof path, "%s/%s%s", folder, longer ? "x" : "", name);
        for (int twice = 0; twice < 2; twice++)
            assert_true(ceduo_file_write(path, "some", 4));
        assert_int_equal(access(path, F_OK), 0);
        char dead[512];
        snprintf(dead, sizeof dead, "%s/%s%.218s.ceduo-tmp-4194304-12", folder, longer ? "x" : "", name);
        int fd = open(dead, O_CREAT | O_WRONLY, 0600);
        assert_true(fd >= 0 && close(fd) == 0);
        ceduo_file_tidy(path);
        assert_int_equal(access(dead, F_OK), -1);
    }
}

/* Of what lies beside a file only that goes which bears the name of a temporary of this file and has no living writer. */
static void only_dead_temporaries_are_removed(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool goes;
    } rows[] = {{"out.ceduo-tmp-17-0", true},    {"out.ceduo-tmp-4194304-99", true}, {"out.ceduo-tmp-17-1", false},
                {"out.ceduo-tmp-17", false},     {"out.ceduo-tmp-17-", false},       {"out.ceduo-tmp--1", false},
                {"out.ceduo-tmp-17-0x", false},  {"out.ceduo-tmp-x-0", false},       {"out.ceduo-tmp-17-0.yaml", false},
                {"other.ceduo-tmp-17-0", false}, {"out.bak.ceduo-tmp-17-0", false},  {"out.AbCdEf", false},
                {"out.ceduo-tmp-12345678901234567890-12345678", false}};
    char path[256], link[256];
    int held = -1;
    for (size_t i = 0; i < LENGTH(rows); i++) {
        in_folder(path, rows[i].name);
        int fd = open(path, O_CREAT | O_WRONLY, 0600);
        assert_true(fd >= 0);
        if (i == 2) {
            assert_int_equal(flock(fd, LOCK_EX), 0); /* that of a living writer */
            held = fd;
        } else {
            close(fd);
        }
    }
    in_folder(path, "victim");
    in_folder(link, "out.ceduo-tmp-18-0");
    put("victim", "x");
    assert_int_equal(symlink(path, link), 0);
    in_folder(link, "out.ceduo-tmp-19-0");
    assert_int_equal(mkfifo(link, 0600), 0);
    in_folder(path, "out");
    ceduo_file_tidy(path); /* whether the file itself is there or not */
    for (int again = 0; again < 2; again++) {
        for (size_t i = 0; i < LENGTH(rows); i++) {
            char there[256];
            in_folder(there, rows[i].name);
            assert_int_equal(access(there, F_OK) == 0, !rows[i].goes);
        }
        for (int i = 0; i < 2; i++) {
            struct stat st;
            in_folder(link, i == 0 ? "out.ceduo-tmp-18-0" : "out.ceduo-tmp-19-0");
            assert_int_equal(lstat(link, &st), 0);
        }
        put("out", "x");
    }
    close(held);
    in_folder(link, "link");
    assert_int_equal(symlink("out", link), 0);
    ceduo_file_tidy(link); /* those of what a link leads to */
    in_folder(path, "out.ceduo-tmp-17-1");
    assert_int_equal(access(path, F_OK), -1);
}

static void files_are_taken(void **state)
{
    (void)state;
    char path[256], link[256], to[256];
    struct text text = {0};
    put("some", "twelve bytes");
    in_folder(path, "some");
    assert_true(ceduo_file_take(path, &text, 12));
    assert_string_equal(text.bytes, "twelve bytes");
    ceduo_text_free(&text);
    assert_false(ceduo_file_take(path, &text, 11));
    assert_int_equal(errno, EFBIG);
    ceduo_text_free(&text);
    assert_false(ceduo_file_take(folder, &text, 11));
    assert_int_equal(errno, EISDIR);
    in_folder(path, "none");
    assert_false(ceduo_file_take(path, &text, 11));
    assert_int_equal(errno, ENOENT);
    assert_false(ceduo_file_take("/proc/self/mem", &text, 11)); /* nothing is at address 0 */
    assert_int_equal(errno, EIO);
    /* through links to a file that is not there yet, by relative and absolute ways; one that leads to itself is refused */
    in_folder(link, "link");
    in_folder(to, "link2");
    assert_int_equal(symlink("link2", link), 0);
    in_folder(path, "target");
    assert_int_equal(symlink(path, to), 0);
    assert_true(ceduo_file_write(link, "x", 1));
    assert_true(ceduo_file_take(path, &text, 9));
    assert_string_equal(text.bytes, "x");
    ceduo_text_free(&text);
    in_folder(link, "loop");
    assert_int_equal(symlink("loop", link), 0);
    assert_false(ceduo_file_write(link, "x", 1));
    assert_int_equal(errno, ELOOP);
    /* without a folder in its name: in the one that is the present */
    char here[4096];
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(symlink("bare", "bare-link"), 0);
    assert_true(ceduo_file_write("bare-link", "y", 1));
    assert_true(ceduo_file_take("bare", &text, 9));
    assert_string_equal(text.bytes, "y");
    ceduo_text_free(&text);
    assert_int_equal(chdir(here), 0);
}

static void files_are_the_same(void **state)
{
    (void)state;
    char path[256], link[256], other[256], none[256];
    put("some", "x");
    put("other", "x");
    in_folder(path, "some");
    in_folder(link, "link");
    in_folder(other, "other");
    in_folder(none, "none");
    assert_int_equal(symlink("some", link), 0);
    assert_true(ceduo_file_same(path, path) && ceduo_file_same(path, link) && ceduo_file_same(link, path));
    assert_false(ceduo_file_same(path, other) || ceduo_file_same(path, none) || ceduo_file_same(none, path));
    assert_false(ceduo_file_same(folder, folder)); /* nothing is read from one, or written */
    int was = dup(STDIN_FILENO), fd = open(path, O_RDONLY);
    assert_int_equal(dup2(fd, STDIN_FILENO), STDIN_FILENO);
    close(fd);
    assert_true(ceduo_file_same(link, "-"));
    assert_false(ceduo_file_same(other, "-"));
    close(STDIN_FILENO);
    assert_false(ceduo_file_same(link, "-"));
    dup2(was, STDIN_FILENO);
    close(was);
}

/* What was set aside goes before: where it cannot be read, or there is no room for it, that is told. */
static void what_was_set_aside_goes_before(void **state)
{
    (void)state;
    char path[256];
    struct text text = {0};
    int ends[2];
    put("aside", "before ");
    in_folder(path, "aside");
    int aside = open(path, O_RDONLY);
    put("to", "old");
    in_folder(path, "to");
    assert_int_equal(pipe(ends), 0);
    assert_false(ceduo_file_write_after(ends[0], path, "after", 5)); /* a pipe has no place 0 */
    assert_int_equal(errno, ESPIPE);
    assert_true(ceduo_file_take(path, &text, 99));
    assert_string_equal(text.bytes, "old");
    ceduo_text_free(&text);
    assert_false(ceduo_file_write_after(aside, "/dev/full", "", 0));
    assert_int_equal(errno, ENOSPC);
    assert_true(ceduo_file_write_after(aside, path, "after", 5));
    assert_true(ceduo_file_take(path, &text, 99));
    assert_string_equal(text.bytes, "before after");
    ceduo_text_free(&text);
    close(aside);
    close(ends[0]);
    close(ends[1]);
}

/* A socket is no file, and one that may not be written is not replaced. */
static void what_cannot_be_written(void **state)
{
    (void)state;
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int s = socket(AF_UNIX, SOCK_STREAM, 0);
    snprintf(address.sun_path, sizeof address.sun_path, "%s/socket", folder);
    assert_int_equal(bind(s, (struct sockaddr *)&address, sizeof address), 0);
    assert_false(ceduo_file_write(address.sun_path, "x", 1));
    assert_int_equal(errno, ENXIO);
    close(s);
    char path[256];
    struct text text = {0};
    put("kept", "old");
    in_folder(path, "kept");
    assert_int_equal(chmod(folder, 0755), 0);
    for (int may = 0; may < 2; may++) {
        assert_int_equal(chmod(path, may ? 0666 : 0444), 0);
        bool root = geteuid() == 0; /* who may write anything: asked for as another user */
        if (root)
            assert_int_equal(setreuid(65534, 0), 0);
        bool written = ceduo_file_write(path, "new", 3);
        int why = errno;
        if (root)
            assert_int_equal(setreuid(0, 0), 0);
        assert_int_equal(written, may);
        if (!may)
            assert_int_equal(why, EACCES);
        assert_true(ceduo_file_take(path, &text, 9));
        assert_string_equal(text.bytes, may ? "new" : "old");
        ceduo_text_free(&text);
    }
}

static int pipe_in;

static void write_to_pipe(int signal)
{
    (void)signal;
    if (write(pipe_in, "late", 4) == 4)
        close(pipe_in);
}

/* A signal interrupts the reading, which goes on: what the pipe says is written by the signal's handler. */
static void an_interrupted_reader_goes_on(void **state)
{
    (void)state;
    int ends[2], was = dup(STDIN_FILENO);
    struct text text = {0};
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    pipe_in = ends[1];
    const struct sigaction action = {.sa_handler = write_to_pipe};
    const struct itimerval soon = {.it_value = {.tv_usec = 100000}};
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &soon, NULL), 0);
    assert_true(ceduo_file_take("-", &text, 100));
    assert_string_equal(text.bytes, "late");
    ceduo_text_free(&text);
    close(ends[0]);
    dup2(was, STDIN_FILENO);
    close(was);
}

static void a_closed_shelf_is_all_there_is(void **state)
{
    (void)state;
    char path[256];
    put("real.yaml", "1234567890");
    in_folder(path, "real.yaml");
    struct shelf shelf = {0};
    struct arena arena = {.shelf = &shelf};
    struct problems problems = {0};
    assert_null(ceduo_file_find(&arena, "nothing", path, NULL));
    assert_non_null(ceduo_file_find(&arena, "real.yaml", path, NULL));
    const struct source *first = ceduo_file_read(&arena, path, 100, &problems);
    put("real.yaml", "changed");
    shelf.closed = true;
    const struct source *again = ceduo_file_read(&arena, path, 100, &problems);
    assert_int_equal(again->length, 10);
    assert_ptr_equal(again->bytes, first->bytes);
    assert_null(ceduo_file_read(&arena, path, 9, &problems)); /* larger than is asked for */
    assert_non_null(strstr(problems.text.bytes, "larger than"));
    assert_null(ceduo_file_read(&arena, folder, 100, &problems));
    assert_non_null(strstr(problems.text.bytes, "cannot read it"));
    assert_non_null(ceduo_file_find(&arena, "real.yaml", path, NULL));
    assert_null(ceduo_file_find(&arena, "real.yaml", NULL, NULL));  /* other words */
    assert_null(ceduo_file_find(&arena, "real.yaml", path, "stands"));
    assert_null(ceduo_file_find(&arena, path, NULL, NULL));
    ceduo_problems_free(&problems);
    ceduo_arena_free(&arena);
}

/* ---- scenes ---- */

/* A scene that is good, and one line of it in the place of another. */
static char *scene_with(const char *line)
{
    static const char *const lines[] = {
        "ceduo: scene/1\n", "rock: {diameter_m: 0.5, density_kg_m3: 2600}\n", "release: {vx_m_s: 1}\n",
        "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], segments: [{rn: 0.3, rt: 0.8, friction: 0.5}]}\n",
        "controls: [{x_m: 90}]\n", "simulation: {rocks: 10}\n",
        "forest: [{from_m: 10, to_m: 80, stand: {stools: {per_ha: 2000, spacing_m: 0.4}, shoots: [{per_ha: 6000, dbh_m: "
        "0.06, height_m: 6}]}}]\n"};
    struct text text = {0};
    for (size_t i = 0; i < LENGTH(lines); i++) {
        size_t key = strcspn(lines[i], ":") + 1;
        bool other = strncmp(line, lines[i], key) == 0;
        ceduo_text_put(&text, other ? line : lines[i]);
        if (other)
            ceduo_text_char(&text, '\n');
    }
    return text.bytes;
}

/* The problems of a scene with that line, "" where there are none; to be freed. */
static char *problems_of(const char *line, bool *good)
{
    struct scene_file file;
    struct problems problems = {0};
    char *text = scene_with(line);
    *good = ceduo_scene_read_text(&file, "scene", text, &problems);
    ceduo_problems_close(&problems);
    assert_int_equal(*good, problems.text.length == 0);
    char *told = strdup(problems.text.bytes ? problems.text.bytes : "");
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    free(text);
    return told;
}

static const char long_word[] = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";

static void wrong_scenes_are_told(void **state)
{
    (void)state;
    const struct {
        const char *line, *told;
    } rows[] = {
        {"simulation: {rocks: [1]}", "simulation.rocks: a number is wanted here, not a list"},
        {"simulation: {rocks: 10.5}", "simulation.rocks: '10.5' is no whole number"},
        {"simulation: {law: [1]}", "simulation.law: a word is wanted here, not a list"},
        {"simulation: {law: lumpy}", "did you mean 'lumped'?"},
        {"simulation: {law: zzzzzzzzzz}", "'zzzzzzzzzz' is unknown; one of: lumped, crsp"},
        {"simulation: {scale_rn: {a: 1}}", "simulation.scale_rn: true or false is wanted here, not a mapping"},
        {"simulation: {scale_rn: 'true'}", "'true': true or false is wanted"},
        {"simulation: {scale_rn: yes}", "'yes': true or false is wanted"},
        {"simulation: 3", "simulation: a mapping is wanted here, not a single value"},
        {"ceduo: [scene/1]", "ceduo: scene/1 is wanted here, not a list"},
        {"ceduo: slope/1", "'slope/1': 'scene/1' is wanted here"},
        {"rock: {diameter_m: {mean: 0.5, wide: 1}}", "rock.diameter_m.wide: unknown key; known here: mean, spread, kind, source"},
        {"rock: {diameter_m: {spread: 0.1}}", "rock.diameter_m: 'mean' is missing"},
        {"rock: {diameter_m: {mean: 0.5, spread: 0.4}}", "the spread reaches from -0.7 to 1.7 m"},
        {"rock: {diameter_m: {mean: 999, spread: 1}}", "the spread reaches from 996 to 1002 m"},
        {"rock: {diameter_m: {mean: x, spread: 9}}", "rock.diameter_m.mean: 'x' is no number"},
        {"rock: {shape: block, axes_m: [1, 2]}", "rock.axes_m: a list of three numbers is wanted"},
        {"rock: {shape: block, axes_m: 1}", "rock.axes_m: a list of three numbers is wanted"},
        {"rock: {shape: cylinder, diameter_m: 1, height_m: 1, mass_kg: 9, density_kg_m3: 2600}",
         "rock.density_kg_m3: mass_kg says it already"},
        {"slope: {vertices_m: [[0, 50], [40, x], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}",
         "slope.vertices_m[1]: 'x' is no number"},
        {"slope: {vertices_m: 5, segments: [{rn: 0.3, rt: 0.8}]}", "slope.vertices_m: a list is wanted here, not a single value"},
        {"slope: {vertices_m: [[0, 50], [100, 0]], materials: [{from_m: 0, to_m: 90, material: cliff}]}",
         "90 ends before the profile, at 100"},
        {"slope: {vertices_m: [[0, 50], [100, 0]], materials: []}", "slope.materials: the list is empty"},
        {"forest: [{from_m: 10, to_m: 80, stand: {cutting: {rotation_years: 20, stay_per_ha: 5}}}]",
         "cutting.stay_per_ha: a list is wanted here, not a single value"},
        {"forest: [{from_m: 10, to_m: 80, stand: {growth: {shoots_young: 2, shoots_old: 3}}}]", "2 is below shoots_old, 3"},
        {"forest: [{from_m: 10, to_m: 80, stand: {stools: {per_ha: 1, spacing_m: 0.4}, shoots: [{per_ha: 20000, dbh_m: 0.06, "
         "height_m: 6}]}}]",
         "20000 shoots on each stool are more than the 10000"},
        {"forest: [{from_m: 10, to_m: 80, stand: {system: bare, trees: [{per_ha: 10, dbh_m: 0.2, height_m: 9}]}}]",
         "'bare', but there are stems"},
        {"forest: [{from_m: 10, to_m: 80, stand: {source: 3}}]", "source: a mapping {kind, text} is wanted"},
        {"forest: [{from_m: 10, to_m: 80, stand: {source: {kind: guessed}}}]", "'guessed' is unknown"},
        {"forest: [{from_m: 10, to_m: 80, stand: {source: {word: x}}}]", "unknown key; known here: kind, text"},
        {"forest: 5", "forest: a list is wanted here, not a single value"},
        {"forest: [{from_m: 10, to_m: 80, stand: {base: [1]}}]", "base: a path to a file is wanted"},
        {"slope: {base: other, vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}", "slope.base: unknown key"},
        {"forest: [5]", "forest[0]: a mapping is wanted here, not a single value"},
        {"controls: [{x_m: 90, *a : 1}]", "an alias; write the value out"},
        {"controls: [{x_m: 90, [a]: 1}]", "a key must be a plain word"},
        {"controls: [{x_m: 90, \"a\\0b\": 1}]", "a key must be a plain word"},
        {"controls: [{x_m: 90, name: \"a\\0b\"}]", "a NUL character in a text"},
    };
    bool good;
    for (size_t i = 0; i < LENGTH(rows); i++) {
        char *told = problems_of(rows[i].line, &good);
        if (!strstr(told, rows[i].told))
            fail_msg("%s\nis not told '%s' but:\n%s", rows[i].line, rows[i].told, told);
        free(told);
    }
    const char *const fine[] = {
        "simulation: {scale_rn: true}", "simulation: {scale_rn: false}", "release: {x_m: {spread: 0}}",
        "rock: {shape: cylinder, diameter_m: 1, height_m: 1, mass_kg: 9}",
        "rock: {diameter_m: {mean: 0.5, spread: 0.1, kind: uniform, source: {kind: measured}}}",
        "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], materials: [{from_m: 0, to_m: 40, material: cliff}, {from_m: 40, "
        "to_m: 120, material: talus}, {from_m: 120, to_m: 150, material: cliff}]}",
        "forest: [{from_m: 10, to_m: 80, stand: {name: none}}]", "forest: [{from_m: 10, to_m: 80, stand: {}}]"};
    for (size_t i = 0; i < LENGTH(fine); i++) {
        char *told = problems_of(fine[i], &good);
        if (!good)
            fail_msg("%s\nis told:\n%s", fine[i], told);
        free(told);
    }
}

/* One fault has one message: what follows from it is not told as well. */
static void one_fault_is_told_once(void **state)
{
    (void)state;
    const struct {
        const char *line, *told;
    } rows[] = {{"slope: {csv: [1]}", "slope.csv: a text is wanted here, not a list"},
                {"forest: [{from_m: 10, to_m: 80, stand: {growth: {shoots_young: x, shoots_old: 3}}}]",
                 "growth.shoots_young: 'x' is no number"},
                /* a line that ends at U+2028 ends later for the eye, so the place may lie behind its end */
                {"forest: [] # \xe2\x80\xa8#\nx:                                                                                   "
                 "                                                                                    @\n#",
                 "no value can start with this character"}};
    bool good;
    for (size_t i = 0; i < LENGTH(rows); i++) {
        char *told = problems_of(rows[i].line, &good), *first = strstr(told, "scene:");
        if (!first || strstr(first + 1, "scene:") || !strstr(told, rows[i].told))
            fail_msg("%s\nis not told '%s' alone but:\n%s", rows[i].line, rows[i].told, told);
        free(told);
    }
}

/* A file where a stand should be; a base that is an option's; a slope of which there is nothing. */
static void files_that_are_followed(void **state)
{
    (void)state;
    static const char rest[] = "ceduo: scene/1\nrock: {diameter_m: 0.5}\ncontrols: [{x_m: 90}]\n";
    static const char slope[] = "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n";
    static const char *const with_base[] = {"forest[0].stand={base: stand.yaml, stools: {per_ha: 1234}}"};
    const struct {
        const char *line, *told;
        const char *const *set;
    } rows[] = {{"forest: [{from_m: 10, to_m: 80, stand: five.yaml}]", "a mapping is wanted here, not a single value", NULL},
                {"forest: [{from_m: 10, to_m: 80, stand: list.yaml}]", "a mapping is wanted here, not a list", NULL},
                {"forest: [{from_m: 10, to_m: 80, stand: {base: five.yaml, name: x}}]",
                 "a mapping is wanted here, not a single value", NULL},
                {"forest: [{from_m: 10, to_m: 80, stand: {}}]", NULL, with_base}};
    put("five.yaml", "5\n");
    put("list.yaml", "- 5\n");
    put("stand.yaml", "ceduo: stand/1\nstools: {per_ha: 2000, spacing_m: 0.4}\nshoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\n");
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct scene_file file;
        struct problems problems = {0};
        struct text text = {0};
        char path[256];
        ceduo_text_format(&text, "%s%s%s\n", rest, slope, rows[i].line);
        put("scene.yaml", text.bytes);
        in_folder(path, "scene.yaml");
        bool good = ceduo_scene_read(&file, path, rows[i].set, rows[i].set != NULL, &problems);
        if (good != !rows[i].told || (!good && !strstr(problems.text.bytes, rows[i].told)))
            fail_msg("%s: %s", rows[i].line, problems.text.bytes);
        if (good) {
            const struct ceduo_stand *s = &file.scene.options[0].belts[0].stand;
            assert_true(s->stools_per_ha == 1234 && s->spacing == 0.4 && s->shoots_count == 1 && s->shoots[0].per_ha == 6000);
        }
        ceduo_text_free(&text);
        ceduo_problems_free(&problems);
        ceduo_scene_release(&file);
    }
    char path[256];
    struct scene_file file;
    struct problems problems = {0};
    const char *const facets[] = {"slope.facets=both"};
    put("scene.yaml", rest);
    in_folder(path, "scene.yaml");
    assert_false(ceduo_scene_read(&file, path, facets, 1, &problems));
    assert_non_null(strstr(problems.text.bytes, "'vertices_m' is missing: the profile"));
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

/* A word that no key is near to, and one longer than any key. */
static void long_words_are_told(void **state)
{
    (void)state;
    char line[512];
    bool good;
    snprintf(line, sizeof line, "simulation: {law: %s}", long_word);
    char *told = problems_of(line, &good);
    assert_non_null(strstr(told, "is unknown; one of: lumped, crsp"));
    free(told);
    snprintf(line, sizeof line, "simulation: {%s: 1}", long_word);
    told = problems_of(line, &good);
    assert_non_null(strstr(told, "unknown key; known here: "));
    free(told);
    struct scene_file file;
    struct problems problems = {0};
    char *text = scene_with("title: x");
    assert_true(ceduo_scene_read_text(&file, "scene", text, &problems));
    snprintf(line, sizeof line, "rock.%s=1", long_word);
    assert_false(ceduo_scene_set(&file, "--set", line, &problems));
    assert_non_null(strstr(problems.text.bytes, "unknown key"));
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    free(text);
}

/* Paths of --set that lead to nothing, and some that lead to what is not there yet. */
static void paths_are_told(void **state)
{
    (void)state;
    const struct {
        const char *set, *told;
    } rows[] = {{"forest[0]xto_m=5", "malformed path"},
                {"forest[].to_m=5", "malformed path"},
                {"forest[0=5", "malformed path"},
                {"rock..density_kg_m3=5", "malformed path"},
                {"forest[9].to_m=5", "'9': no such item"},
                {"forest[other].to_m=5", "'other': no such item"},
                {"forest.to_m=5", "there is no mapping here"},
                {"rock[0]=5", "there is no list here"},
                {"controls[0].x_m.spread=5", "there is no mapping here"},
                {"options[0].name=x", "there is none to change"},
                {"rock.axes_m[0]=5", "there is none to change"},
                {"rock.wide=5", "unknown key (ceduo --list-parameters)"},
                {"=5", "PATH=VALUE is wanted"},
                {"rock", "PATH=VALUE is wanted"},
                {"rock.diameter_m=0.6", NULL},
                {"rock.diameter_m.spread=0.01", NULL},
                {"release.height_m.mean=2", NULL},
                {"rock.source.kind=assumed", NULL},
                {"simulation.seed=7", NULL},
                {"forest[wood].stand.stools.per_ha=1500", NULL},
                {"slope.vertices_m[1][0]=41", NULL},
                {"forest[0].to_m=70", NULL}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct scene_file file;
        struct problems problems = {0};
        char *text = scene_with(
            "forest: [{from_m: 10, to_m: 80, stand: {name: wood, stools: {per_ha: 2000, spacing_m: 0.4}, shoots: [{per_ha: "
            "6000, dbh_m: 0.06, height_m: 6}]}}]");
        assert_true(ceduo_scene_read_text(&file, "scene", text, &problems));
        bool good = ceduo_scene_set(&file, "--set", rows[i].set, &problems);
        if (good != !rows[i].told || (!good && !strstr(problems.text.bytes, rows[i].told)))
            fail_msg("%s: %s", rows[i].set, problems.text.bytes);
        if (good && !ceduo_scene_bind(&file, &problems))
            fail_msg("%s: %s", rows[i].set, problems.text.bytes);
        ceduo_problems_free(&problems);
        ceduo_scene_release(&file);
        free(text);
    }
}

/* A change takes its value out of the source around it: where that is no such thing as should be there, it stays and is
 * told. A key that a change makes has no place in the file. */
static void sources_of_changes(void **state)
{
    (void)state;
    const struct {
        const char *source, *set, *told;
    } rows[] = {{"{kind: measured, except: [volume_m3]}", "rock.diameter_m=0.6", NULL},
                {"{kind: measured, except: {a: b}}", "rock.diameter_m=0.6", "source.except: a list of keys is wanted"},
                {"by hand", "rock.diameter_m=0.6", "source: a mapping {kind, text} is wanted"},
                {"{kind: measured, except: volume_m3}", "rock.diameter_m=0.6", "source.except: a list of keys is wanted"},
                {"{kind: measured, except: [[volume_m3]]}", "rock.diameter_m=0.6", "source.except: a key is wanted here, not a list"},
                {"{kind: measured}", "rock.source.wide=1", "--set:1:18: rock.source.wide: unknown key; known here: kind, text, except"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct scene_file file;
        struct problems problems = {0};
        struct text line = {0}, rock = {0};
        ceduo_text_format(&line, "rock: {diameter_m: 0.5, density_kg_m3: 2600, source: %s}", rows[i].source);
        char *text = scene_with(line.bytes);
        bool good = ceduo_scene_read_text(&file, "scene", text, &problems);
        ceduo_problems_free(&problems);
        assert_int_equal(good, i == 0 || i == 5);
        const struct node *before = ceduo_node_get(ceduo_node_get(file.root, "rock"), "source");
        assert_true(ceduo_scene_set(&file, "--set", rows[i].set, &problems));
        const struct node *now = ceduo_node_get(ceduo_node_get(file.root, "rock"), "source");
        assert_int_equal(now == before, i > 0 && i < 4); /* a list is added to, whatever is in it */
        assert_int_equal(ceduo_scene_bind(&file, &problems), !rows[i].told);
        if (rows[i].told && !strstr(problems.text.bytes, rows[i].told))
            fail_msg("%s: %s", rows[i].set, problems.text.bytes);
        if (!rows[i].told) {
            ceduo_emit_flow(&rock, ceduo_node_get(file.root, "rock"));
            assert_string_equal(rock.bytes, "{diameter_m: 0.6, density_kg_m3: 2600, source: {kind: measured, except: [volume_m3, "
                                            "diameter_m]}}");
        }
        ceduo_text_free(&rock);
        ceduo_text_free(&line);
        ceduo_problems_free(&problems);
        ceduo_scene_release(&file);
        free(text);
    }
}

/* A shape that a change sets does not go with the sizes of the file: what is proposed instead does. */
static void shapes_of_changes(void **state)
{
    (void)state;
    const struct {
        const char *rock, *set;
    } rows[] = {{"rock: {shape: cylinder, diameter_m: 1, height_m: 2}", "rock.shape=sphere"},
                {"rock: {shape: block, axes_m: [1, 2, 3]}", "rock.shape=cylinder"},
                {"rock: {volume_m3: 0.1}", "rock.shape=cylinder"},
                {"rock: {diameter_m: 1}", "rock.shape=block"},
                {"rock: {diameter_m: 1}", "rock.shape=ellipsoid"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct scene_file file;
        struct problems problems = {0};
        char *text = scene_with(rows[i].rock);
        assert_true(ceduo_scene_read_text(&file, "scene", text, &problems));
        assert_true(ceduo_scene_set(&file, "--set", rows[i].set, &problems));
        assert_false(ceduo_scene_bind(&file, &problems));
        char *proposed = strstr(problems.text.bytes, "give the whole rock: -s '");
        assert_non_null(proposed);
        proposed += strlen("give the whole rock: -s '");
        *strchr(proposed, '\'') = '\0';
        struct problems none = {0};
        if (!ceduo_scene_set(&file, "--set", proposed, &none) || !ceduo_scene_bind(&file, &none))
            fail_msg("%s: %s: %s", rows[i].rock, proposed, none.text.bytes);
        ceduo_problems_free(&problems);
        ceduo_scene_release(&file);
        free(text);
    }
}

static void walks_end_where_there_is_nothing(void **state)
{
    (void)state;
    struct arena arena = {0};
    const struct node *root = parsed(&arena, "{forest: [{to_m: 1}, {to_m: 2}], rock: {a: 3}}"), *forest = ceduo_node_get(root, "forest");
    const char *within;
    size_t used;
    assert_string_equal(ceduo_resolve_walk(root, "forest[1].to_m", &within, &used)->text, "2");
    assert_int_equal(used, strlen("forest[1].to_m"));
    assert_ptr_equal(ceduo_resolve_walk(root, "forest[2].to_m", &within, &used), forest);
    assert_int_equal(used, strlen("forest"));
    assert_ptr_equal(ceduo_resolve_walk(root, "rock.b", &within, &used), ceduo_node_get(root, "rock"));
    assert_int_equal(used, strlen("rock"));
    ceduo_arena_free(&arena);
}

/* Grounds that end where a vertex is, or behind the profile, split no segment; one that ends within does. */
static void grounds_split_segments(void **state)
{
    (void)state;
    const struct {
        const char *materials;
        size_t vertices;
    } rows[] = {{"{from_m: 0, to_m: 100, material: cliff}", 3},
                {"{from_m: 0, to_m: 40, material: cliff}, {from_m: 40, to_m: 100, material: talus}", 3},
                {"{from_m: 0, to_m: 50, material: cliff}, {from_m: 50, to_m: 100, material: talus}", 4},
                {"{from_m: 0, to_m: 100, material: cliff}, {from_m: 100, to_m: 120, material: talus}", 3},
                {"{from_m: 0, to_m: 10, material: cliff}, {from_m: 10, to_m: 30, material: talus}, {from_m: 30, to_m: 120, "
                 "material: colluvium}",
                 5}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct scene_file file;
        struct problems problems = {0};
        struct text line = {0};
        ceduo_text_format(&line, "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], materials: [%s]}", rows[i].materials);
        char *text = scene_with(line.bytes);
        assert_true(ceduo_scene_read_text(&file, "scene", text, &problems));
        const struct ceduo_slope *s = &file.scene.slope;
        assert_int_equal(s->vertices, rows[i].vertices);
        for (size_t v = 0; v < s->vertices; v++) {
            double x = s->x[v], z = x < 40 ? 50 - x * 30 / 40 : 20 - (x - 40) * 20 / 60;
            assert_true(fabs(s->z[v] + s->origin_z - z) < 1e-12);
        }
        assert_true(ceduo_scene_assumes_value(&file, "slope.materials[0].material"));
        assert_false(ceduo_scene_assumes_value(&file, "slope.vertices_m[0]"));
        free(text);
        ceduo_text_free(&line);
        ceduo_problems_free(&problems);
        ceduo_scene_release(&file);
    }
}

/* The same fault once; of a message without end the beginning and the end, whole characters; none beyond so many. */
static void problems_are_put_together(void **state)
{
    (void)state;
    struct problems problems = {0};
    const struct source source = {.name = "file", .bytes = "one\r\n\ttwo\n\nfour", .length = 15};
    ceduo_problem(&problems, &source, 1, 2, "a");
    ceduo_problem(&problems, &source, 1, 2, "a");
    ceduo_problem(&problems, &source, 2, 3, "b");
    ceduo_problem(&problems, &source, 3, 1, "empty");
    ceduo_problem(&problems, &source, 9, 1, "beyond");
    ceduo_problem(&problems, &source, 4, 90, "behind");
    ceduo_problem(&problems, &source, 4, 300, "far behind");
    ceduo_problem(&problems, &source, 0, 0, "whole");
    ceduo_problem(&problems, NULL, 3, 3, "nowhere");
    assert_string_equal(problems.text.bytes, "file:1:2: a\n  one\n   ^\nfile:2:3: b\n   two\n    ^\nfile:3:1: empty\n"
                                             "file:9:1: beyond\nfile:4:90: behind\n  four\n      ^\nfile:4:300: far behind\n  \n  ^\nfile: whole\nnowhere\n");
    assert_int_equal(problems.count, 8);
    assert_int_equal(problems.met, 9);
    ceduo_problems_free(&problems);
    for (int shift = 0; shift < 3; shift++) {
        struct text word = {0};
        for (int i = 0; i < shift; i++)
            ceduo_text_char(&word, 'x');
        for (int i = 0; i < 600; i++)
            ceduo_text_put(&word, "\xe2\x80\xa6");
        ceduo_problem(&problems, NULL, 0, 0, "%s end", word.bytes);
        assert_null(strstr(problems.text.bytes, "\\x"));
        assert_non_null(strstr(problems.text.bytes, "\xe2\x80\xa6 end\n"));
        assert_true(problems.text.length > 900 && problems.text.length < 1100);
        ceduo_text_free(&word);
        ceduo_problems_free(&problems);
    }
    char ends[1301] = {0}; /* of nothing but ends of characters neither beginning nor end is left */
    memset(ends, '\x80', sizeof ends - 1);
    ceduo_problem(&problems, NULL, 0, 0, "%s", ends);
    assert_string_equal(problems.text.bytes, "\xe2\x80\xa6\n");
    ceduo_problems_free(&problems);
    for (int i = 0; i < 5000; i++)
        ceduo_problem(&problems, NULL, 0, 0, "number %d", i);
    ceduo_problems_close(&problems);
    assert_non_null(strstr(problems.text.bytes, "number 19\n"));
    assert_null(strstr(problems.text.bytes, "number 20\n"));
    assert_non_null(strstr(problems.text.bytes, "4980 more problems\n"));
    ceduo_problems_free(&problems);
}

/* Where a value comes from is said by the innermost mapping on the way to it. */
static void notes_are_found(void **state)
{
    (void)state;
    struct scene_file file;
    struct problems problems = {0};
    char *text = scene_with(
        "forest: [{from_m: 10, to_m: 80, source: {kind: assumed, text: belt}, stand: {source: {kind: measured, text: stand}, "
        "stools: {per_ha: 2000, spacing_m: 0.4, source: {kind: assumed, text: stools}}, shoots: [{per_ha: 6000, dbh_m: 0.06, "
        "height_m: 6}]}}, "
        /* its own source goes before one that is not of it, whichever is given first */
        "{from_m: 80, to_m: 84, stand: {source: {kind: measured, except: [energy]}, energy: {source: {kind: assumed, text: own}}}}, "
        "{from_m: 84, to_m: 90, stand: {energy: {source: {kind: assumed, text: own}}, source: {kind: measured, except: [energy]}}}]");
    if (!ceduo_scene_read_text(&file, "scene", text, &problems))
        fail_msg("%s", problems.text.bytes);
    const struct {
        const char *path, *note;
        bool assumed;
    } rows[] = {{"forest[0].to_m", "belt", true},
                {"forest[0]", "belt", true},
                {"forest[0].stand", "stand", false},
                {"forest[0].stand.name", "stand", false},
                {"forest[0].standing", "belt", true},
                {"forest[0].stand.stools.per_ha", "stools", true},
                {"forest[0].stand.shoots[0].dbh_m", "stand", false},
                {"forest[1].to_m", NULL, false},
                {"forest[1].stand.energy.model", "own", true},
                {"forest[2].stand.energy.model", "own", true},
                {"release", NULL, false}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct source_note *note = ceduo_scene_note(&file, rows[i].path);
        assert_int_equal(note != NULL, rows[i].note != NULL);
        if (note)
            assert_string_equal(note->text, rows[i].note);
        assert_int_equal(ceduo_scene_assumes_value(&file, rows[i].path), rows[i].assumed);
    }
    assert_true(ceduo_scene_assumes(&file, "forest[0].stand") && ceduo_scene_assumes(&file, "forest"));
    assert_false(ceduo_scene_assumes(&file, "forest[0].stand.shoots") || ceduo_scene_assumes(&file, "forest[0].sta"));
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    free(text);
}

/* ---- the table of parameters ---- */

static void ranges_are_told(void **state)
{
    (void)state;
    const struct {
        double lo, hi;
        unsigned flags;
        const char *text;
    } rows[] = {{-INFINITY, INFINITY, 0, ""},  {0, INFINITY, 0, ">= 0"},      {0, INFINITY, FIELD_ABOVE, "> 0"},
                {0, 1, 0, "0\xe2\x80\xa6" "1"}, {0, 1, FIELD_ABOVE | FIELD_UNDER, ">0\xe2\x80\xa6<1"},
                {-INFINITY, 5, 0, "\xe2\x80\xa6" "5"}, {-1e9, 1e9, 0, "-1e+09\xe2\x80\xa6" "1e+09"},
                {0, 9007199254740992.0, 0, "0\xe2\x80\xa6" "9007199254740992"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        struct text text = {0};
        const struct field f = {.lo = rows[i].lo, .hi = rows[i].hi, .flags = rows[i].flags};
        assert_int_equal(ceduo_schema_range_text(&f, &text), rows[i].text[0] != '\0');
        assert_string_equal(text.bytes ? text.bytes : "", rows[i].text);
        ceduo_text_free(&text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(utf8_is_decoded),
        cmocka_unit_test(no_character_does_anything),
        cmocka_unit_test(numbers_are_short),
        cmocka_unit_test(numbers_are_read),
        cmocka_unit_test(no_word_is_near_a_long_one),
        cmocka_unit_test(an_arena_says_that_it_is_full),
        cmocka_unit_test(scalars_are_read_back),
        cmocka_unit_test(trees_are_read_back),
        cmocka_unit_test(trees_are_compared),
        cmocka_unit_test(texts_are_patched),
        cmocka_unit_test(parts_are_read_back),
        cmocka_unit_test(parts_of_another_kind),
        cmocka_unit_test(parts_that_are_cut_within),
        cmocka_unit_test(inputs_are_refused),
        cmocka_unit_test_setup_teardown(files_are_found, set_up, tear_down),
        cmocka_unit_test_setup_teardown(folders_of_the_environment, set_up, tear_down),
        cmocka_unit_test_setup_teardown(folders_are_listed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(long_names_are_written, set_up, tear_down),
        cmocka_unit_test_setup_teardown(only_dead_temporaries_are_removed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(files_are_taken, set_up, tear_down),
        cmocka_unit_test_setup_teardown(files_are_the_same, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_set_aside_goes_before, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_cannot_be_written, set_up, tear_down),
        cmocka_unit_test(an_interrupted_reader_goes_on),
        cmocka_unit_test_setup_teardown(a_closed_shelf_is_all_there_is, set_up, tear_down),
        cmocka_unit_test(wrong_scenes_are_told),
        cmocka_unit_test(one_fault_is_told_once),
        cmocka_unit_test_setup_teardown(files_that_are_followed, set_up, tear_down),
        cmocka_unit_test(long_words_are_told),
        cmocka_unit_test(paths_are_told),
        cmocka_unit_test(sources_of_changes),
        cmocka_unit_test(shapes_of_changes),
        cmocka_unit_test(walks_end_where_there_is_nothing),
        cmocka_unit_test(grounds_split_segments),
        cmocka_unit_test(problems_are_put_together),
        cmocka_unit_test(notes_are_found),
        cmocka_unit_test(ranges_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
