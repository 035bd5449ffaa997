/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Characters, columns and lines, according to RFC 3629, Unicode's widths and UAX 14. */
#include "table.h"

#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"

#define WORD 5000 /* bytes */

TEST(decoding)
{
    const char *none =
        "\x80|\xc3|\xc3(|\xc3g|\xe2\x80|\xe2\x80g|"                         /* cut */
        "\xc0\xaf|\xc1\xbf|\xe0\x80\xaf|\xe0\x9f\xbf|\xf0\x8f\xbf\xbf|"     /* overlong forms */
        "\xed\xa0\x80|\xed\xbf\xbf|\xf4\x90\x80\x80|\xf5\x80\x80\x80|\xff"; /* surrogates; beyond the last; never */
    for (char bytes[64]; next_word(&none, bytes);) {
        uint32_t code = 0;
        assert_int_equal(ceduo_utf8_decode(bytes, strlen(bytes), &code), 0);
        assert_int_equal(code, 0);
    }
    for (TABLE(row, "unit/texts.txt", "decoding")) {
        uint32_t code = 0;
        size_t length = strlen(row.at[0]);
        char back[4];
        assert_int_equal(ceduo_utf8_decode(row.at[0], length, &code), length);
        assert_int_equal(code, strtoul(row.at[1], NULL, 16));
        assert_int_equal(ceduo_utf8_encode(code, back), length);
        assert_memory_equal(back, row.at[0], length);
    }
    uint32_t code;
    assert_int_equal(ceduo_utf8_decode("\xc3\xa0", 1, &code), 0); /* the second byte is missing */
    assert_int_equal(ceduo_utf8_decode("", 0, &code), 0);
    char to[4];
    assert_int_equal(ceduo_utf8_encode(0xd800, to), 0);
}

TEST(columns)
{
    assert_int_equal(ceduo_utf8_width("citt\xc3\xa0"), 5);
    assert_int_equal(ceduo_utf8_width("e\xcc\x80"), 1);        /* e with a combining grave accent */
    assert_int_equal(ceduo_utf8_width("\xe6\x9c\xa8"), 2);     /* a Chinese tree */
    assert_int_equal(ceduo_utf8_width("\xf0\x9f\x8c\xb3"), 2); /* a tree */
    assert_int_equal(ceduo_utf8_width("a\xff\x1b"), 3);        /* an invalid byte, a control character */
    assert_int_equal(ceduo_utf8_cut("\xe6\x9c\xa8\xe6\x9c\xa8", 3), 3);
    assert_int_equal(ceduo_utf8_cut("e\xcc\x80x", 1), 3);
    const char *text = "a\xc3\xa0\xff";
    assert_ptr_equal(ceduo_utf8_back(text, text + 4), text + 3);
    assert_ptr_equal(ceduo_utf8_back(text, text + 3), text + 1);
    assert_ptr_equal(ceduo_utf8_back(text, text), text);
    assert_int_equal(ceduo_utf8_step("\xc3\xa0x"), 2);
    assert_int_equal(ceduo_utf8_step("\xc3x"), 1);
}

/* The blanks of Unicode (Zs) but U+1680, and no others. */
TEST(blanks)
{
    static const char *const blanks[] = {
        " ", "\t", "\xc2\xa0", "\xe2\x80\x80", "\xe2\x80\x8a", "\xe2\x80\xaf", "\xe2\x81\x9f", "\xe3\x80\x80"};
    static const char *const others[] = {"", "a", "\n", "\xa0", "\xe2\x80\x8b", "\xe2\x80\xb0", "\xe2\x81\xa0", "\xe3\x80\x81"};
    for (size_t i = 0; i < LENGTH(blanks); i++)
        EXPECT(ceduo_utf8_blank(blanks[i], strlen(blanks[i])), ==, strlen(blanks[i]));
    for (size_t i = 0; i < LENGTH(others); i++)
        EXPECT(ceduo_utf8_blank(others[i], strlen(others[i])), ==, 0);
}

static void expect_lines(const char *text, size_t width, const char *const *wanted)
{
    for (; *text; wanted++) {
        const char *next;
        size_t n = ceduo_utf8_wrap(text, width, &next);
        assert_non_null(*wanted);
        assert_int_equal(n, strlen(*wanted));
        assert_memory_equal(text, *wanted, n);
        assert_true(next > text);
        text = next;
    }
    assert_null(*wanted);
}

TEST(lines)
{
    expect_lines("dell'acqua \xc3\xa8 cos\xc3\xac", 11, (const char *[]){"dell'acqua", "\xc3\xa8 cos\xc3\xac", NULL});
    expect_lines("dell'acqua \xc3\xa8 cos\xc3\xac", 12, (const char *[]){"dell'acqua \xc3\xa8", "cos\xc3\xac", NULL});
    expect_lines("one\ntwo", 20, (const char *[]){"one", "two", NULL});
    expect_lines("of 984–995 kJ/m3", 8, (const char *[]){"of", "984–995", "kJ/m3", NULL});
    expect_lines("coppice-with-standards", 10, (const char *[]){"coppice-", "with-", "standards", NULL});
    expect_lines("abcdefgh", 3, (const char *[]){"abc", "def", "gh", NULL});
    expect_lines(" abcdef", 3, (const char *[]){" ab", "cde", "f", NULL}); /* a blank alone makes no line */
    expect_lines("\xe6\x9c\xa8\xe6\x9c\xa8", 1,
                 (const char *[]){"\xe6\x9c\xa8", "\xe6\x9c\xa8", NULL}); /* always at least one */
    expect_lines("a\xff\xff"
                 "b c",
                 3, (const char *[]){"a\xff\xff", "b c", NULL});

    static char word[WORD + 1];
    memset(word, 'a', WORD);
    const char *next;
    assert_int_equal(ceduo_utf8_wrap(word, 3, &next), 3); /* longer than the search for a break */
}

/* Invalid bytes are ignored in comparisons. */
TEST(folding)
{
    char to[16];
    assert_string_equal(ceduo_utf8_fold("A\xff-\xc3\x80\xc3", 6, to, sizeof to), "a\xc3\xa0");
}
