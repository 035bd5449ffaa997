/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SAY_H
#define CEDUO_SAY_H

#include <stdbool.h>

#include "base/text.h"

/* Prints to standard error, as ASCII where the terminal knows no more. */
void ceduo_say(struct text *text);

/* A line on standard error: what, and why. */
void ceduo_say_why(const char *what, const char *why);

/* Makes a text for people plain ASCII where the terminal knows no more. */
void ceduo_say_plainly(struct text *text);

/* Whether the locale is UTF-8. */
bool ceduo_say_utf8(void);

#endif
