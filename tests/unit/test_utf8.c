/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Characters, columns and lines. What is right stands in RFC 3629, in Unicode's widths and in UAX 14. */
#include "expect.h"

#include <string.h>

#include "base/utf8.h"

TEST(decoding)
{
    static const struct {
        const char *bytes;
        size_t length;
        uint32_t code;
    } cases[] = {
        {"a", 1, 'a'},
        {"\x7f", 1, 0x7f},
        {"\xc2\x80", 2, 0x80},
        {"\xc3\xa0", 2, 0xe0},
        {"\xdf\xbf", 2, 0x7ff},
        {"\xe0\xa0\x80", 3, 0x800},
        {"\xe2\x80\xa6", 3, 0x2026},
        {"\xed\x9f\xbf", 3, 0xd7ff},
        {"\xee\x80\x80", 3, 0xe000},
        {"\xef\xbf\xbf", 3, 0xffff},
        {"\xf0\x90\x80\x80", 4, 0x10000},
        {"\xf0\x9f\x8c\xb3", 4, 0x1f333},
        {"\xf4\x8f\xbf\xbf", 4, 0x10ffff},
    };
    const char *none =
        "\x80|\xc3|\xc3(|\xc3g|\xe2\x80|\xe2\x80g|"                         /* cut */
        "\xc0\xaf|\xc1\xbf|\xe0\x80\xaf|\xe0\x9f\xbf|\xf0\x8f\xbf\xbf|"     /* too long a form */
        "\xed\xa0\x80|\xed\xbf\xbf|\xf4\x90\x80\x80|\xf5\x80\x80\x80|\xff"; /* surrogates; beyond the last; never */
    for (char bytes[64]; next_word(&none, bytes);) {
        uint32_t code = 0;
        assert_int_equal(ceduo_utf8_decode(bytes, strlen(bytes), &code), 0);
        assert_int_equal(code, 0);
    }
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint32_t code = 0;
        char back[4];
        assert_int_equal(ceduo_utf8_decode(cases[i].bytes, strlen(cases[i].bytes), &code), cases[i].length);
        assert_int_equal(code, cases[i].code);
        assert_int_equal(ceduo_utf8_encode(code, back), cases[i].length);
        assert_memory_equal(back, cases[i].bytes, cases[i].length);
    }
    uint32_t code;
    assert_int_equal(ceduo_utf8_decode("\xc3\xa0", 1, &code), 0); /* its second byte is not there */
    assert_int_equal(ceduo_utf8_decode("", 0, &code), 0);
    char to[4];
    assert_int_equal(ceduo_utf8_encode(0xd800, to), 0);
}

TEST(columns)
{
    assert_int_equal(ceduo_utf8_width("citt\xc3\xa0"), 5);
    assert_int_equal(ceduo_utf8_width("e\xcc\x80"), 1);        /* e and a grave accent on it */
    assert_int_equal(ceduo_utf8_width("\xe6\x9c\xa8"), 2);     /* a Chinese tree */
    assert_int_equal(ceduo_utf8_width("\xf0\x9f\x8c\xb3"), 2); /* a tree */
    assert_int_equal(ceduo_utf8_width("a\xff\x1b"), 3);        /* a byte that is no character, a control */
    assert_int_equal(ceduo_utf8_cut("\xe6\x9c\xa8\xe6\x9c\xa8", 3), 3);
    assert_int_equal(ceduo_utf8_cut("e\xcc\x80x", 1), 3);
    const char *text = "a\xc3\xa0\xff";
    assert_ptr_equal(ceduo_utf8_back(text, text + 4), text + 3);
    assert_ptr_equal(ceduo_utf8_back(text, text + 3), text + 1);
    assert_ptr_equal(ceduo_utf8_back(text, text), text);
    assert_int_equal(ceduo_utf8_step("\xc3\xa0x"), 2);
    assert_int_equal(ceduo_utf8_step("\xc3x"), 1);
}

static void lines_are(const char *text, size_t width, const char *const *wanted)
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
    lines_are("dell'acqua \xc3\xa8 cos\xc3\xac", 11, (const char *[]){"dell'acqua", "\xc3\xa8 cos\xc3\xac", NULL});
    lines_are("dell'acqua \xc3\xa8 cos\xc3\xac", 12, (const char *[]){"dell'acqua \xc3\xa8", "cos\xc3\xac", NULL});
    lines_are("one\ntwo", 20, (const char *[]){"one", "two", NULL});
    lines_are("of 984–995 kJ/m3", 8, (const char *[]){"of", "984–995", "kJ/m3", NULL});
    lines_are("coppice-with-standards", 10, (const char *[]){"coppice-", "with-", "standards", NULL});
    lines_are("abcdefgh", 3, (const char *[]){"abc", "def", "gh", NULL});
    lines_are(" abcdef", 3, (const char *[]){" ab", "cde", "f", NULL}); /* a blank alone is no line */
    lines_are("\xe6\x9c\xa8\xe6\x9c\xa8", 1, (const char *[]){"\xe6\x9c\xa8", "\xe6\x9c\xa8", NULL}); /* never none at all */
    lines_are("a\xff\xff"
              "b c",
              3, (const char *[]){"a\xff\xff", "b c", NULL});
}
