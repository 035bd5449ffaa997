/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MESSAGES_H
#define CEDUO_MESSAGES_H

#include <stdatomic.h>
#include <stdbool.h>

#include "arguments.h"
#include "io/file.h"

/* Print to standard error, as ASCII if the locale is not UTF-8. */
void ceduo_print_error(struct text *text);

/* Print problems and free them. */
void ceduo_print_problems(struct problems *problems);

/* Show progress on one line of standard error, over the last progress. Other output, and the end of the program, clear it. */
void ceduo_show_progress(const char *format, ...) __attribute__((format(printf, 1, 2)));
void ceduo_clear_progress(void);

/* Print a line "subject: text" to standard error. */
void ceduo_print_message(const char *subject, const char *text);

/* Convert a text to ASCII if the locale is not UTF-8. */
void ceduo_fit_charset(struct text *text);

/* True if the locale is UTF-8. */
bool ceduo_is_utf8(void);

/* Report an error of the command line. `option` may be NULL. Return EXIT_USAGE. */
enum exit_status ceduo_usage_error(const char *option, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Set language and charset from the environment. LC_NUMERIC stays "C": numbers have a dot in every language. */
void ceduo_language_start(void);

/* Set the language, "it" or "en". Text stays English if there is no translation. */
void ceduo_language_set(const char *language);

/* Make SIGINT, SIGTERM and SIGHUP raise a flag; a second signal ends the program. */
void ceduo_interrupt_catch(void);

/* Return the flag, which cancels runs. */
const atomic_bool *ceduo_interrupt_flag(void);

/* Restore the default action of signals. A signal that was caught then ends the program. */
void ceduo_interrupt_release(void);

/* ---- output.c ---- */

/* True if --output is probably writable and is not a file on the command line; otherwise reports the reason. */
bool ceduo_output_check(const struct arguments *arguments);

/* Report that a file to write is this file, by any name, and return true; otherwise return false. `output` may be NULL. */
bool ceduo_output_is(const char *output, const char *path);

/* Write to --output. Report an error and return EXIT_OUTPUT. */
enum exit_status ceduo_output_write(const struct arguments *arguments, const struct text *text);

/* The output of many scenes. With --output it is kept until the last scene: in memory if it is small, otherwise in a temporary
 * file. While that exists, signals are caught, so that it is removed. */
struct output {
    struct pending_file file;
    int fd;
    bool begun; /* the file is open */
};

/* Write the text of a scene and clear `text`, unless the output is kept in memory. */
enum exit_status ceduo_output_next(struct output *output, const struct arguments *arguments, struct text *text);

/* Write the rest and rename the file. `whole`: false: discard the output. */
enum exit_status ceduo_output_end(struct output *output, const struct arguments *arguments, struct text *text, bool whole);

#endif
