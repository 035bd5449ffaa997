/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SAY_H
#define CEDUO_SAY_H

#include <stdatomic.h>
#include <stdbool.h>

#include "arguments.h"
#include "io/file.h"

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

/* ---- output.c ---- */

/* Whether it can be written to where --output says, as far as that can be told, and that is none of the files given;
 * says why not. */
bool ceduo_output_check(const struct arguments *arguments);

/* Whether --output is this file, by whatever name. Says so. */
bool ceduo_output_is(const struct arguments *arguments, const char *path);

/* Writes to where --output says. EXIT_OUTPUT with the reason on standard error where that fails. */
enum exit_status ceduo_output_write(const struct arguments *arguments, const struct text *text);

/* The output of many scenes. With --output they wait for the last scene: in memory if they are few, otherwise in a file beside the
 * place of the output. From then on signals stay caught, so that this file is removed. */
struct output {
    struct pending_file file;
    int fd;
    bool begun; /* the file is open */
};

/* Write the text of a scene, and take it out of the text, unless it waits in memory. */
enum exit_status ceduo_output_next(struct output *output, const struct arguments *arguments, struct text *text);

/* Write the rest, and put the file in its place. `whole`: false if there must be no output. */
enum exit_status ceduo_output_end(struct output *output, const struct arguments *arguments, struct text *text, bool whole);

#endif
