/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FILE_H
#define CEDUO_FILE_H

#include <stdatomic.h>

#include "base/arena.h"
#include "problem.h"

#define YAML_BYTES_MOST ((size_t)16 * 1024 * 1024)
#define CSV_BYTES_MAX   ((size_t)64 * 1024 * 1024)

/* A copy of a source with its name and its string of bytes, for as long as the arena. NULL without memory. */
const struct source *ceduo_source_keep(struct arena *arena, struct source source);

/* Reads a whole file, at most `max` bytes; "-" is standard input. NULL where that fails, with the reason in
 * `problems`. Name and bytes live in the arena, which lists it among its `sources`. */
const struct source *ceduo_file_read(struct arena *arena, const char *path, size_t max, struct problems *problems);

/* Where a file is looked for: as it is written, beside the file that names it, then in the user's data folder, the
 * installed one, the source tree; there also by its bare name within `folder` (scenes, slopes, stands) and with .yaml
 * added. A path in the arena; NULL where there is no such file. `beside` may be NULL. */
const char *ceduo_file_find(struct arena *arena, const char *name, const char *beside, const char *folder);

/* The name of a file without its folder. */
const char *ceduo_file_name(const char *path);

/* The folders of profiles, best first, ended by NULL. */
const char *const *ceduo_file_folders(struct arena *arena);

/* Names of the .yaml files in `folder`/`shelf` without this ending, sorted; `*n` of them. */
const char *const *ceduo_file_list(struct arena *arena, const char *folder, const char *shelf, size_t *n);

/* Writes all bytes to an open file; `cancel` (may be NULL) ends it at the next signal. False with errno set. */
bool ceduo_file_fill(int fd, const char *bytes, size_t n, const atomic_bool *cancel);

/* Writes a regular file whole or not at all (a temporary file beside it, then a rename); anything else, and through a link
 * that leads to nothing yet, straight.
 * False with errno set. */
bool ceduo_file_write(const char *path, const char *bytes, size_t n);

/* A file that is filled and not yet in its place, so that several can be filled before the first takes its. What is no regular
 * file is written when it is placed; until then `bytes` must stay. */
struct pending_file {
    const char *path;
    const char *bytes;
    size_t n;
    bool wait;       /* for the disk */
    char *target;    /* NULL: no regular file */
    char *temporary; /* TARGET.ceduo-tmp-…, until it takes its place */
};

/* Fills it, whose first four members are given, under a name of its own beside its place. False with errno set; to be dropped even
 * then. */
bool ceduo_file_prepare(struct pending_file *file);
/* False with errno set. */
bool ceduo_file_place(struct pending_file *file);
/* Begin a file that is written piece by piece to the descriptor that is returned; -1 with errno set. To be dropped even then. */
int ceduo_file_begin(struct pending_file *file);
/* Close it, and put it in its place. False with errno set. */
bool ceduo_file_finish(struct pending_file *file, int fd);
/* Takes away what has not taken its place. */
void ceduo_file_drop(struct pending_file *file);

/* Whether two paths lead to one regular file; `b` may be "-", standard input. */
bool ceduo_file_same(const char *a, const char *b);

/* Whether ceduo_file_write() could begin, as far as that can be told without writing. False with errno set. */
bool ceduo_file_can_write(const char *path);

#endif
