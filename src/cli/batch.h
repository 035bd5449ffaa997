/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "each.h"
#include "scenes.h"
#include "view/figures.h"

/* Each prints to standard output or to --output and returns the exit status. */
enum exit_status ceduo_batch_run(const struct arguments *arguments);
enum exit_status ceduo_batch_find(const struct arguments *arguments);
enum exit_status ceduo_batch_sensitivity(const struct arguments *arguments);
enum exit_status ceduo_batch_report(const struct arguments *arguments);
enum exit_status ceduo_batch_calibrate(const struct arguments *arguments);
enum exit_status ceduo_batch_check(const struct arguments *arguments);
enum exit_status ceduo_batch_parameters(const struct arguments *arguments);
enum exit_status ceduo_batch_profiles(const struct arguments *arguments);
enum exit_status ceduo_batch_columns(const struct arguments *arguments);
enum exit_status ceduo_batch_schema(const struct arguments *arguments);
enum exit_status ceduo_batch_survey(const struct arguments *arguments);

/* What a mode prints of one scene. */
typedef enum exit_status ceduo_batch_answer(const struct arguments *arguments, struct scene_file *file, struct text *out);

/* Prints the answer of each scene; `header` begins a CSV. Nothing is printed of what is interrupted. */
enum exit_status ceduo_batch_each(const struct arguments *arguments, const struct ceduo_csv *csv, ceduo_batch_answer *answer);

/* Opens the terminal program, or feeds it the script that was given. */
enum exit_status ceduo_interactive_run(const struct arguments *arguments);

#endif
