/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "utf8.h"

#include <string.h>
#include <unicase.h>
#include <unilbrk.h>
#include <unistr.h>
#include <uniwidth.h>

#define WORD_BYTES_MAX 4096 /* bytes of a word that are searched for a line break: more than the width of any terminal */

static const uint8_t *as_bytes(const char *string)
{
    return (const uint8_t *)string;
}

size_t ceduo_utf8_decode(const char *p, size_t n, uint32_t *code)
{
    ucs4_t c = 0;
    int length = n > 0 ? u8_mbtoucr(&c, as_bytes(p), n) : 0;
    if (length <= 0)
        return 0;
    *code = c;
    return (size_t)length;
}

bool ceduo_utf8_printable(uint32_t code)
{
    bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    bool bidi = code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
                (code >= 0x2066 && code <= 0x2069);
    bool noncharacter = (code & 0xfffe) == 0xfffe || (code >= 0xfdd0 && code <= 0xfdef);
    return !control && !bidi && !noncharacter;
}

bool ceduo_utf8_is_space(uint32_t code)
{
    return code == 0xa0 || (code >= 0x2000 && code <= 0x200a) || code == 0x202f || code == 0x205f || code == 0x3000;
}

size_t ceduo_utf8_blank(const char *p, size_t n)
{
    uint32_t code;
    if (n > 0 && (*p == ' ' || *p == '\t'))
        return 1;
    size_t length = ceduo_utf8_decode(p, n, &code);
    return length > 1 && ceduo_utf8_is_space(code) ? length : 0;
}

size_t ceduo_utf8_encode(uint32_t code, char to[4])
{
    int length = u8_uctomb((uint8_t *)to, code, 4);
    return length > 0 ? (size_t)length : 0;
}

const char *ceduo_utf8_fold(const char *p, size_t n, char *to, size_t size)
{
    size_t used = 0;
    uint32_t code;
    for (size_t length; n > 0; p += length, n -= length) {
        char one[4];
        length = ceduo_utf8_decode(p, n, &code);
        if (length == 0) /* invalid UTF-8 is ignored in comparisons */
            length = code = 1;
        bool dropped =
            code < 0x80 ? !strchr("%0123456789abcdefghijklmnopqrstuvwxyz", (int)uc_tolower(code)) : ceduo_utf8_is_space(code);
        size_t m = dropped ? 0 : ceduo_utf8_encode(uc_tolower(code), one);
        if (used + m >= size)
            break;
        memcpy(to + used, one, m);
        used += m;
    }
    to[used] = '\0';
    return to;
}

/* Return the length of one character, and set its columns. */
static size_t decode_step(const char *p, size_t *columns)
{
    uint32_t code;
    size_t length = ceduo_utf8_decode(p, strnlen(p, 4), &code);
    *columns = length > 0 ? ceduo_utf8_columns(code) : 1;
    return length > 0 ? length : 1;
}

size_t ceduo_utf8_step(const char *p)
{
    size_t columns;
    return decode_step(p, &columns);
}

const char *ceduo_utf8_back(const char *start, const char *p)
{
    const uint8_t *before = u8_prev(&(ucs4_t){0}, as_bytes(p), as_bytes(start));
    return before ? (const char *)before : p > start ? p - 1 : start;
}

size_t ceduo_utf8_columns(uint32_t code)
{
    int width = uc_width(code, "UTF-8");
    return width < 0 ? 1 : (size_t)width;
}

size_t ceduo_utf8_width_of(const char *string, size_t n)
{
    size_t width = 0, columns;
    for (const char *end = string + n; string < end; width += columns)
        string += decode_step(string, &columns);
    return width;
}

size_t ceduo_utf8_width(const char *string)
{
    return ceduo_utf8_width_of(string, strlen(string));
}

int ceduo_utf8_field(const char *string, int columns)
{
    return columns + (int)strlen(string) - (int)ceduo_utf8_width(string);
}

size_t ceduo_utf8_cut(const char *string, size_t columns)
{
    size_t n = 0, one;
    for (size_t length; string[n] && (length = decode_step(string + n, &one), one <= columns); n += length)
        columns -= one;
    return n;
}

size_t ceduo_utf8_wrap(const char *text, size_t columns, const char **next)
{
    size_t n = strcspn(text, "\n"), fits = ceduo_utf8_cut(text, columns);
    if (fits < n) {
        n = fits;
        while (n > 0 && text[n] != ' ')
            n--;
        if (n == 0) { /* at the last possible break of the word, otherwise where the line is full */
            char breaks[WORD_BYTES_MAX];
            size_t length = strcspn(text, " \n");
            n = fits > 0 ? fits : ceduo_utf8_step(text);
            length = length < WORD_BYTES_MAX ? length : WORD_BYTES_MAX;
            u8_possible_linebreaks(as_bytes(text), length, "UTF-8", breaks);
            size_t end = n < length ? n : length > 0 ? length - 1 : 0;
            while (end > 0 && breaks[end] != UC_BREAK_POSSIBLE)
                end--;
            n = end > 0 ? end : n;
        }
    }
    *next = text + n + (text[n] == ' ' || text[n] == '\n');
    return n;
}
