/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OUTPUT_H
#define CEDUO_OUTPUT_H

#include "arguments.h"
#include "base/text.h"

/* Whether it can be written to where --output says, as far as that can be told, and that is none of the files given;
 * says why not. */
bool ceduo_output_check(const struct arguments *arguments);

/* Whether --output is this file, by whatever name. Says so. */
bool ceduo_output_is(const struct arguments *arguments, const char *path);

/* Writes to where --output says. EXIT_OUTPUT with the reason on standard error where that fails. */
enum exit_status ceduo_output_write(const struct arguments *arguments, const struct text *text);

/* Write a result of several to standard output, and take it out of the text. With --output they are all written at the end. */
enum exit_status ceduo_output_next(const struct arguments *arguments, struct text *text);

#endif
