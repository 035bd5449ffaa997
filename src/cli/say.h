/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SAY_H
#define CEDUO_SAY_H

#include <stdatomic.h>
#include <stdbool.h>

#include "arguments.h"
#include "io/file.h"

/* Print to standard error, as ASCII if the locale is not UTF-8. */
void ceduo_print_message(struct text *text);

/* Print problems, and free them. */
void ceduo_print_problems(struct problems *problems);

/* Show progress on one line of standard error, over the line before. Other output and the end of the program remove it. */
void ceduo_print_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));
void ceduo_clear_progress(void);

/* Print a line "what: why" to standard error. */
void ceduo_print_error(const char *what, const char *why);

/* Make a text plain ASCII if the locale is not UTF-8. */
void ceduo_to_terminal_charset(struct text *text);

/* True if the locale is UTF-8. */
bool ceduo_print_utf8(void);

/* Report an error of the command line. `option` may be NULL. Returns EXIT_USAGE. */
enum exit_status ceduo_usage(const char *option, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Set language and characters from the environment. LC_NUMERIC stays that of C: numbers have a dot in every language. */
void ceduo_language_start(void);

/* Set the language "it" or "en". Text stays English if the translation is not found. */
void ceduo_language_set(const char *language);

/* Make SIGINT, SIGTERM and SIGHUP raise a flag; a second signal ends the program. */
void ceduo_interrupt_catch(void);

/* The flag, for runs. */
const atomic_bool *ceduo_interrupt_flag(void);

/* Let signals act again. Ends the program by a signal that was caught. */
void ceduo_interrupt_release(void);

/* ---- output.c ---- */

/* True if --output can probably be written and is none of the files on the command line. Reports the reason otherwise. */
bool ceduo_output_check(const struct arguments *arguments);

/* True if --output is this file, by any name, which is reported. */
bool ceduo_output_is(const struct arguments *arguments, const char *path);

/* Write to --output. EXIT_OUTPUT on failure, which is reported. */
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
