/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENES_H
#define CEDUO_SCENES_H

#include "ceduo/question.h"
#include "io/scene_file.h"
#include "progress.h"

struct shelf;

/* Reads a scene with the changes of the command line; what is wrong with it goes to standard error. EXIT_OUTPUT where
 * --output is one of the files that it was read from. `shelf`: see io/file.h; may be NULL. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct shelf *shelf,
                                  struct scene_file *file);

/* Keeps only the options that --option names. EXIT_USAGE where there is none of that name. */
enum exit_status ceduo_batch_choose(const struct arguments *arguments, struct scene_file *file);

/* Says that a scene has no option of this name, and which it has. EXIT_USAGE. */
enum exit_status ceduo_batch_no_option(const struct scene_file *file, const char *name);

/* What the command line asks of a scene: rocks as -n, -e or the scene says, threads, years. `progress` may be NULL. */
struct ceduo_question ceduo_batch_question(const struct arguments *arguments, const struct scene_file *file,
                                           struct progress *progress);

/* Says why there is no answer; an interruption says nothing. EXIT_RUN. */
enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status);

#endif
