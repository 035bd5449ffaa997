/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENES_H
#define CEDUO_SCENES_H

#include "arguments.h"
#include "ceduo/question.h"
#include "io/scene_file.h"

/* Reads a scene with the changes and the options of the command line (with --find all of its options); what is wrong with
 * it goes to standard error. EXIT_OUTPUT where --output is one of the files that it was read from. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct scene_file *file);

/* The option of a name. EXIT_USAGE where there is none, once that is told. */
enum exit_status ceduo_batch_option(const struct scene_file *file, const char *name, size_t *index);

/* Says on standard error that nothing can be said of a scene, where hardly a rock arrives even without forest: for modes whose
 * answer is of something else. It looks at no more than LOOK_ROCKS. */
void ceduo_batch_warn(const struct arguments *arguments, const struct scene_file *file);

/* Rocks and seconds on standard error, once a second is over: a run's `progress`. */
struct progress {
    double start, shown;
    bool wanted;
};
struct progress ceduo_progress_begin(const struct arguments *arguments);
void ceduo_progress_show(void *progress, uint64_t rocks);
/* How many of all scenes are done, some of them now, and for how long the others may take. */
void ceduo_progress_scenes(struct progress *progress, size_t computed, size_t done, size_t all);
void ceduo_progress_steps(void *progress, uint64_t done, uint64_t all);
/* Whether it is time to show how far it is; `*seconds`: since the start. */
bool ceduo_progress_due(struct progress *progress, double *seconds);

/* What the command line asks of a scene: rocks as -n, -e or the scene says, threads, years. `progress` may be NULL. */
struct ceduo_question ceduo_batch_question(const struct arguments *arguments, const struct scene_file *file,
                                           struct progress *progress);

/* Says why there is no answer; an interruption says nothing. EXIT_RUN. */
enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status);

#endif
