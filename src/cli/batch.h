/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "arguments.h"
#include "ceduo/years.h"

struct shelf;

/* Each prints to standard output or to --output and returns the exit status. */
enum exit_status ceduo_batch_run(const struct arguments *arguments);
enum exit_status ceduo_batch_merge(const struct arguments *arguments);
enum exit_status ceduo_batch_find(const struct arguments *arguments);
enum exit_status ceduo_batch_check(const struct arguments *arguments);
enum exit_status ceduo_batch_parameters(const struct arguments *arguments);
enum exit_status ceduo_batch_profiles(const struct arguments *arguments);

/* Whether it can be written to where --output says, as far as that can be told, and that is none of the files given;
 * says why not. */
bool ceduo_batch_can_write(const struct arguments *arguments);

/* Writes to where --output says. EXIT_OUTPUT with the reason on standard error where that fails. */
enum exit_status ceduo_batch_write(const struct arguments *arguments, const struct text *text);

/* Reads a scene with the changes of the command line; what is wrong with it goes to standard error. EXIT_OUTPUT where
 * --output is one of the files that it was read from. `shelf`: see io/file.h; may be NULL. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct shelf *shelf,
                                  struct scene_file *file);

/* Keeps only the options that --option names. EXIT_USAGE where there is none of that name. */
enum exit_status ceduo_batch_choose(const struct arguments *arguments, struct scene_file *file);

/* Says that a scene has no option of this name, and which it has. EXIT_USAGE. */
enum exit_status ceduo_batch_no_option(const struct scene_file *file, const char *name);

/* The rocks to fly of a scene: -n, or what it says. */
uint64_t ceduo_batch_rocks(const struct arguments *arguments, const struct scene_file *file);

/* Adds what the runs of a pool come to. `start`: when they began; 0: report->seconds is known. */
enum exit_status ceduo_batch_report(const struct arguments *arguments, const struct scene_file *file,
                                    struct ceduo_pool *pool, struct ceduo_report *report, double start,
                                    struct text *out);

/* Adds the shard of a scene, the `place`-th given, that was read by way of a shelf. */
enum exit_status ceduo_batch_shard(const struct arguments *arguments, const char *path, const struct shelf *shelf,
                                   const struct scene_file *file, size_t place, struct text *out);

/* A clock that only goes forward, s. */
double ceduo_batch_now(void);

/* Rocks and seconds on standard error, once a second is over: a run's `progress`. */
struct progress {
    double start, shown;
    uint64_t before; /* rocks that others fly */
    bool wanted, open;
};
struct progress ceduo_progress_begin(const struct arguments *arguments, uint64_t before);
void ceduo_progress_show(void *progress, uint64_t rocks);
void ceduo_progress_end(const struct progress *progress);

/* A line on standard error: what, and why. */
void ceduo_batch_complain(const char *what, const char *why);

/* Prints to standard error, as ASCII where the terminal knows no more. */
void ceduo_batch_say(struct text *text);

/* Makes a text for people plain ASCII where the terminal knows no more. */
void ceduo_batch_localise(struct text *text);

#endif
