/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SAY_H
#define CEDUO_SAY_H

#include <stdatomic.h>
#include <stdbool.h>

#include "arguments.h"
#include "io/problem.h"

/* Prints to standard error, as ASCII where the terminal knows no more. */
void ceduo_say(struct text *text);

/* Prints what is wrong, and frees it. */
void ceduo_say_problems(struct problems *problems);

/* Shows how far it is, on standard error: on one line, over what was shown before. What else is printed takes it away, as does the
 * end of the program. */
void ceduo_say_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));
void ceduo_say_no_progress(void);

/* A line on standard error: what, and why. */
void ceduo_say_why(const char *what, const char *why);

/* Makes a text for people plain ASCII where the terminal knows no more. */
void ceduo_say_plainly(struct text *text);

/* Whether the locale is UTF-8. */
bool ceduo_say_utf8(void);

/* Says on standard error what is wrong with the command line, or with this option of it. EXIT_USAGE. */
enum exit_status ceduo_usage(const char *option, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The language and characters of the environment. Numbers have a dot in every language: LC_NUMERIC stays that of C. */
void ceduo_language_start(void);

/* Another language: "it" or "en". Where its translation is not found, text stays English. */
void ceduo_language_set(const char *language);

/* From here on SIGINT, SIGTERM and SIGHUP raise a flag instead of ending the program; a second one ends it. */
void ceduo_interrupt_catch(void);

/* The flag, for a run to look at. */
const atomic_bool *ceduo_interrupt_flag(void);

/* Lets signals act again, and ends the program by the one that was caught, if one was. */
void ceduo_interrupt_release(void);

#endif
