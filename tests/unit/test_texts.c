/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: brief */
/* Texts: numbers, similar words, a full arena. */
#include "local.h"
#include "table.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/utf8.h"
#include "io/node.h"

/* Code points are printed unchanged or escaped, depending on what a terminal or a JSON line could do with them. */
TEST(no_character_does_anything)
{
    for (TABLE(row, "unit/texts.txt", "characters")) {
        LOCAL_BY(ceduo_text_free) struct text safe = {0}, line = {0};
        struct json json = {.text = &line};
        ceduo_text_append_escaped(&safe, row.at[0]);
        ceduo_json_string(&json, NULL, row.at[0]);
        assert_string_equal(safe.bytes, row.at[1]);
        assert_string_equal(line.bytes, row.at[2]);
    }
}

/* Return the smallest number of digits with which %e reads back equal. */
static int fewest_digits(double value)
{
    char buf[64];
    for (int digits = 1;; digits++) {
        snprintf(buf, sizeof buf, "%.*e", digits - 1, value);
        if (strtod(buf, NULL) == value)
            return digits;
    }
}

static void expect_shortest(double value)
{
    char buf[CEDUO_NUMBER_SIZE];
    const char *text = ceduo_number_shortest(value, buf);
    double back = 0;
    assert_int_equal(ceduo_number_read(text, &back), CEDUO_NUMBER_GOOD);
    if (back != value)
        fail_msg("%a is written as %s", value, text);
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
    char buf[CEDUO_NUMBER_SIZE];
    assert_string_equal(ceduo_number_shortest(NAN, buf), "null");
    assert_string_equal(ceduo_number_shortest(-INFINITY, buf), "null");
    assert_string_equal(ceduo_number_shortest(-0., buf), "0");
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
    for (TABLE(row, "unit/texts.txt", "counts")) {
        enum ceduo_number_reading reading = ceduo_count_read(row.at[0], 0, strtod(row.at[1], NULL), &count);
        assert_int_equal(reading == CEDUO_NUMBER_NONE, strcmp(row.at[2], "none") == 0);
        assert_int_equal(reading == CEDUO_NUMBER_TOO_LARGE, strcmp(row.at[2], "too large") == 0);
        if (reading == CEDUO_NUMBER_GOOD)
            assert_int_equal(count, strtoull(row.at[2], NULL, 10));
    }
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral" /* a flag unknown to compilers */
static void format_any(struct text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(text, format, args);
    va_end(args);
}
#pragma GCC diagnostic pop

/* Only %'e, %'f and %'g are localised numbers. Text after the format is not read: it would be printed. */
static void expect_spoken(const char *format, double value, const char *wanted)
{
    LOCAL_BY(ceduo_text_free) struct text text = {0};
    char more[64] = {0};
    memcpy(more, format, strlen(format));
    memcpy(more + strlen(format) + 1, "beyond", sizeof "beyond");
    format_any(&text, more, value);
    assert_string_equal(text.bytes, wanted);
}

TEST(numbers_of_the_language)
{
    LOCAL_TEXT(whole);
    format_any(&whole, "%'d rocks", 5); /* a whole number has no decimal separator */
    assert_string_equal(whole.bytes, "5 rocks");
    expect_spoken("%'.1f m", 1.25, "1.2 m");
    expect_spoken("%'+8.3g|", 2.5, "    +2.5|");
    expect_spoken("%%' of %.1f", 2, "%' of 2.0");
    expect_spoken("%%'", 2, "%'");
    expect_spoken("%.1f %%'!", 2, "2.0 %'!");
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

TEST(a_full_arena_reports_it)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    assert_non_null(ceduo_arena_alloc(&arena, 8));
    size_t before = arena.bytes;
    assert_false(arena.failed);
    assert_null(ceduo_arena_alloc(&arena, SIZE_MAX)); /* would round up to 0 */
    assert_true(arena.failed);
    EXPECT(arena.bytes, ==, before);
}

TEST(quotes_for_a_shell)
{
    LOCAL_TEXT(text);
    ceduo_text_append_quoted(&text, "l'orto $x");
    assert_string_equal(ceduo_text_string(&text), "'l'\\''orto $x'");
}
