/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UTF8_H
#define CEDUO_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* UTF-8 as a terminal shows it. A byte that begins no character counts as a character of one column, so that any string
 * can be measured and cut. Characters and their columns come from libunistring. */

/* Bytes of the character at p (1…4), 0 where there is none within n bytes; `*code` is its code point. */
size_t ceduo_utf8_decode(const char *p, size_t n, uint32_t *code);

/* Whether a character is only shown: no control, nothing that breaks lines or turns the order of the text, and none of those that
 * Unicode keeps for no character, which no page may hold. */
bool ceduo_utf8_printable(uint32_t code);

/* True if a code point is a space that a keyboard or a spreadsheet puts in place of a blank: no-break, narrow, thin, of a figure. */
bool ceduo_utf8_is_space(uint32_t code);

/* Bytes of a blank, tab or such a space at p; 0: none within n bytes. */
size_t ceduo_utf8_blank(const char *p, size_t n);

/* Writes a code point as UTF-8; the number of bytes. */
size_t ceduo_utf8_encode(uint32_t code, char to[4]);

/* What is left of a word when case, blanks, hyphens and the like do not matter: its letters and digits, in lower case, and signs that
 * are no ASCII. At most `room` bytes with the NUL that ends it; what does not fit is cut off. Returns `to`. */
const char *ceduo_utf8_fold(const char *p, size_t n, char *to, size_t room);

/* Whether a byte is of a character that began before it. */
static inline bool ceduo_utf8_inside(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80;
}

/* Bytes of the character at p, which is not at the end of its string; at least 1. */
size_t ceduo_utf8_step(const char *p);

/* Where the character before `at` begins; `start` at the start of the string. */
const char *ceduo_utf8_back(const char *start, const char *at);

/* Columns of a code point: 0 for a mark on the character before it, 2 for a wide character; 1 for a control. */
size_t ceduo_utf8_columns(uint32_t code);

/* Columns of a string, or of its first n bytes, of which it must have as many. */
size_t ceduo_utf8_width(const char *string);
size_t ceduo_utf8_width_of(const char *string, size_t n);

/* The width that "%-*s" needs to fill so many columns with this string: it counts bytes. */
int ceduo_utf8_field(const char *string, int columns);

/* Bytes of a string that fit into so many columns. Never cuts a character. */
size_t ceduo_utf8_cut(const char *string, size_t columns);

/* Bytes of the first line of a text that is wrapped to so many columns (at least one character), and at `*next` where its
 * second begins. A line ends at a newline or a blank, so that 'kJ/m3' and '984–995' stay whole. A word that is longer
 * than a line ends where Unicode allows it (UAX 14), otherwise where the line is full. */
size_t ceduo_utf8_wrap(const char *text, size_t columns, const char **next);

#endif
