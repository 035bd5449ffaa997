/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "arguments.h"
#include "ceduo/years.h"

/* Each prints to standard output or to --output and returns the exit status. */
enum exit_status ceduo_batch_run(const struct arguments *arguments);
enum exit_status ceduo_batch_find(const struct arguments *arguments);
enum exit_status ceduo_batch_check(const struct arguments *arguments);
enum exit_status ceduo_batch_parameters(const struct arguments *arguments);
enum exit_status ceduo_batch_profiles(const struct arguments *arguments);

/* Writes to where --output says. EXIT_OUTPUT with the reason on standard error where that fails. */
enum exit_status ceduo_batch_write(const struct arguments *arguments, const struct text *text);

/* Reads a scene with the changes of the command line; what is wrong with it goes to standard error. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct scene_file *file);

/* A line on standard error: what, and why. */
void ceduo_batch_complain(const char *what, const char *why);

/* Prints to standard error, as ASCII where the terminal knows no more. */
void ceduo_batch_say(struct text *text);

/* Makes a text for people plain ASCII where the terminal knows no more. */
void ceduo_batch_localise(struct text *text);

#endif
