/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts: numbers, words that are near to others, an arena that is full. */
#include "expect.h"
#include "local.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/utf8.h"
#include "io/node.h"

/* Code points that are shown as they are, by whether a terminal or a line of JSON could take them for more. */
TEST(no_character_does_anything)
{
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
                {"\xef\xb7\x8f", "\xef\xb7\x8f", "\"\xef\xb7\x8f\""}, /* beside what Unicode keeps for no character */
                {"\xef\xb7\x90", "\\xef\\xb7\\x90", "\"\\ufdd0\""},
                {"\xef\xb7\xaf", "\\xef\\xb7\\xaf", "\"\\ufdef\""},
                {"\xef\xb7\xb0", "\xef\xb7\xb0", "\"\xef\xb7\xb0\""},
                {"\xef\xbf\xbd", "\xef\xbf\xbd", "\"\xef\xbf\xbd\""},
                {"\xef\xbf\xbe", "\\xef\\xbf\\xbe", "\"\\ufffe\""},
                {"\xef\xbf\xbf", "\\xef\\xbf\\xbf", "\"\\uffff\""},
                {"\xf0\x90\x80\x80", "\xf0\x90\x80\x80", "\"\xf0\x90\x80\x80\""},
                {"\xf0\x9f\xbf\xbe", "\\xf0\\x9f\\xbf\\xbe", "\"\\ud83f\\udffe\""}, /* of JSON two halves (RFC 8259, 7) */
                {"\xf4\x8f\xbf\xbf", "\\xf4\\x8f\\xbf\\xbf", "\"\\udbff\\udfff\""},
                {"\"\\", "\"\\", "\"\\\"\\\\\""},
                {"\xff", "\\xff", "\"\\ufffd\""}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_text_free) struct text safe = {0}, line = {0};
        struct json json = {.text = &line};
        ceduo_text_safe(&safe, rows[i].from);
        ceduo_json_string(&json, NULL, rows[i].from);
        assert_string_equal(safe.bytes, rows[i].safe);
        assert_string_equal(line.bytes, rows[i].json);
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

TEST(numbers_are_short)
{
    const char *few = "1|.1|.3333333333333333|1e-5|1e-6|123456789|1e14|1e15|1e16|1e17|12345678901234567|1e22|4.9e-324|"
                      "2.2250738585072014e-308|1.7976931348623157e308|9007199254740993|.3|2.5e-310|999999999999999.9";
    for (char number[64]; next_word(&few, number);) {
        expect_shortest(strtod(number, NULL));
        expect_shortest(-strtod(number, NULL));
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

TEST(numbers_are_read)
{
    const char *const good[] = {"0", "12", "-0.5", "+.5", "1.", "1e3", "1E-3", "1e+3", "0.0"};
    const char *const none[] = {"",    "-",   ".",   "e3", "1e", "1e+", "1,5", "0x10",
                                "010", "inf", "nan", " 1", "1 ", "1_0", "--1", "1e3x"};
    double value;
    uint64_t count;
    for (size_t i = 0; i < LENGTH(good); i++) {
        assert_int_equal(ceduo_number_read(good[i], &value), CEDUO_NUMBER_GOOD);
        EXPECT(value, ==, strtod(good[i], NULL));
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

TEST(no_word_is_near_a_long_one)
{
    char word[65] = {0};
    memset(word, 'a', 64);
    const char *words[] = {word, "ab"};
    assert_null(ceduo_text_nearest("bb", words, 1));
    assert_string_equal(ceduo_text_nearest("bb", words, 2), "ab");
    assert_null(ceduo_text_nearest(word, words + 1, 1));
}

TEST(an_arena_says_that_it_is_full)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    assert_non_null(ceduo_arena_take(&arena, 8));
    size_t before = arena.bytes;
    assert_false(arena.failed);
    assert_null(ceduo_arena_take(&arena, SIZE_MAX)); /* rounded up it would be 0 */
    assert_true(arena.failed);
    EXPECT(arena.bytes, ==, before);
}

TEST(quotes_for_a_shell)
{
    LOCAL_TEXT(text);
    ceduo_text_quoted(&text, "l'orto $x");
    assert_string_equal(ceduo_text_string(&text), "'l'\\''orto $x'");
}
