/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LINE_H
#define CEDUO_LINE_H

#include <stdbool.h>
#include <stddef.h>

/* A line that is typed: a value, a file name, something to search. */
struct line {
    char text[1024];
    size_t at;  /* byte of the cursor */
    bool fresh; /* nothing typed yet: the first character replaces it all */
    bool asked; /* it was asked whether this is meant */
};

void ceduo_line_set(struct line *line, const char *text);

/* What is said where a paste does not fit. */
#define CEDUO_LINE_FULL N_("what was pasted is too long for this line, which stays as it was")

/* Types a pasted text: line ends and tabs as one blank, no control characters. False if it does not fit: the line stays as it
 * was. */
bool ceduo_line_paste(struct line *line, const char *text);

/* Handles a key; false where the key means nothing to it. */
bool ceduo_line_key(struct line *line, int key);

#endif
