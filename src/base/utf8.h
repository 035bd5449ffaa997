/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UTF8_H
#define CEDUO_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* UTF-8 as displayed by a terminal, by libunistring. An invalid byte counts as a character of one column. */

/* Return the length of the character at p, 1…4; 0 if none is complete within n bytes. Sets *code to its code point. */
size_t ceduo_utf8_decode(const char *p, size_t n, uint32_t *code);

/* True unless a code point is a control, breaks lines, changes the direction of text, or is a noncharacter. */
bool ceduo_utf8_printable(uint32_t code);

/* True if a code point is a space other than a blank: no-break, narrow, thin or figure space, as spreadsheets use. */
bool ceduo_utf8_is_space(uint32_t code);

/* Return the length of a blank, tab or such a space at p; 0 if there is none within n bytes. */
size_t ceduo_utf8_blank(const char *p, size_t n);

/* Write a code point as UTF-8. Returns the number of bytes. */
size_t ceduo_utf8_encode(uint32_t code, char to[4]);

/* Copy the letters, digits, % and non-ASCII characters of a word in lower case, to compare words regardless of case, blanks and
 * hyphens. Writes at most `size` bytes with the final NUL; the rest is cut off. Returns `to`. */
const char *ceduo_utf8_fold(const char *p, size_t n, char *to, size_t size);

/* True if a byte continues a character. */
static inline bool ceduo_utf8_is_continuation(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80;
}

/* Return the length of the character at p, at least 1. Requires that p is not at the end of its string. */
size_t ceduo_utf8_step(const char *p);

/* Return the start of the character before p; `start` at the start of the string. */
const char *ceduo_utf8_back(const char *start, const char *p);

/* Return the columns of a code point: 0 for a combining mark, 2 for a wide character, 1 for a control. */
size_t ceduo_utf8_columns(uint32_t code);

/* Return the columns of a string, or of its first n bytes. Requires n bytes. */
size_t ceduo_utf8_width(const char *string);
size_t ceduo_utf8_char_width(const char *string, size_t n);

/* Return the width for "%-*s", which counts bytes, so that this string fills `columns`. */
int ceduo_utf8_field(const char *string, int columns);

/* Return the bytes of a string that fit into `columns`. Never cuts a character. */
size_t ceduo_utf8_cut(const char *string, size_t columns);

/* Return the length of the first line of a text wrapped to `columns`, at least one character. Sets *next to the second line. A
 * line breaks at a newline or a blank, so that 'kJ/m3' and '984–995' stay whole. A word longer than a line breaks as Unicode
 * allows (UAX 14), otherwise at the end of the line. */
size_t ceduo_utf8_wrap(const char *text, size_t columns, const char **next);

#endif
