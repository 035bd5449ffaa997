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

/* Writes a result of several, unless it waits for the last of them: with --output all are written at the end, with --resume each is
 * added to what stands there. What is written is taken out of the text. */
enum exit_status ceduo_output_next(const struct arguments *arguments, struct text *text);

#endif
