/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "utf8.h"

#include <string.h>
#include <unicase.h>
#include <unilbrk.h>
#include <unistr.h>
#include <uniwidth.h>

#define WORD_MAX 4096 /* bytes of a word in which a place to break it is looked for: more than any terminal is wide */

static const uint8_t *bytes_of(const char *string)
{
    return (const uint8_t *)string;
}

size_t ceduo_utf8_decode(const char *p, size_t n, uint32_t *code)
{
    ucs4_t c = 0;
    int length = n > 0 ? u8_mbtoucr(&c, bytes_of(p), n) : 0;
    if (length <= 0)
        return 0;
    *code = c;
    return (size_t)length;
}

bool ceduo_utf8_printable(uint32_t code)
{
    bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    bool turns = code == 0x61c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
                 (code >= 0x2066 && code <= 0x2069);
    bool none = (code & 0xfffe) == 0xfffe || (code >= 0xfdd0 && code <= 0xfdef);
    return !control && !turns && !none;
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

const char *ceduo_utf8_fold(const char *p, size_t n, char *to, size_t room)
{
    size_t used = 0;
    uint32_t code;
    for (size_t length; n > 0; p += length, n -= length) {
        char one[4];
        length = ceduo_utf8_decode(p, n, &code);
        if (length == 0) /* no UTF-8: nothing that a word is compared by */
            length = code = 1;
        bool dropped =
            code < 0x80 ? !strchr("%0123456789abcdefghijklmnopqrstuvwxyz", (int)uc_tolower(code)) : ceduo_utf8_is_space(code);
        size_t m = dropped ? 0 : ceduo_utf8_encode(uc_tolower(code), one);
        if (used + m >= room)
            break;
        memcpy(to + used, one, m);
        used += m;
    }
    to[used] = '\0';
    return to;
}

/* One character, and its columns. */
static size_t step(const char *p, size_t *columns)
{
    uint32_t code;
    size_t length = ceduo_utf8_decode(p, strnlen(p, 4), &code);
    *columns = length > 0 ? ceduo_utf8_columns(code) : 1;
    return length > 0 ? length : 1;
}

size_t ceduo_utf8_step(const char *p)
{
    size_t columns;
    return step(p, &columns);
}

const char *ceduo_utf8_back(const char *start, const char *at)
{
    const uint8_t *before = u8_prev(&(ucs4_t){0}, bytes_of(at), bytes_of(start));
    return before ? (const char *)before : at > start ? at - 1 : start;
}

size_t ceduo_utf8_columns(uint32_t code)
{
    int width = uc_width(code, "UTF-8");
    return width < 0 ? 1 : (size_t)width;
}

size_t ceduo_utf8_char_width(const char *string, size_t n)
{
    size_t width = 0, columns;
    for (const char *end = string + n; string < end; width += columns)
        string += step(string, &columns);
    return width;
}

size_t ceduo_utf8_width(const char *string)
{
    return ceduo_utf8_char_width(string, strlen(string));
}

int ceduo_utf8_field(const char *string, int columns)
{
    return columns + (int)strlen(string) - (int)ceduo_utf8_width(string);
}

size_t ceduo_utf8_cut(const char *string, size_t columns)
{
    size_t n = 0, one;
    for (size_t length; string[n] && (length = step(string + n, &one), one <= columns); n += length)
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
        if (n == 0) { /* after the last byte where a word may be broken; where it is full if it may not */
            char breaks[WORD_MAX];
            size_t length = strcspn(text, " \n");
            n = fits > 0 ? fits : ceduo_utf8_step(text);
            length = length < WORD_MAX ? length : WORD_MAX;
            u8_possible_linebreaks(bytes_of(text), length, "UTF-8", breaks);
            size_t at = n < length ? n : length > 0 ? length - 1 : 0;
            while (at > 0 && breaks[at] != UC_BREAK_POSSIBLE)
                at--;
            n = at > 0 ? at : n;
        }
    }
    *next = text + n + (text[n] == ' ' || text[n] == '\n');
    return n;
}
