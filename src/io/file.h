/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FILE_H
#define CEDUO_FILE_H

#include <limits.h>
#include <stdatomic.h>

#include "base/arena.h"
#include "problem.h"

#define YAML_BYTES_MAX ((size_t)16 * 1024 * 1024)
#define CSV_BYTES_MAX  ((size_t)64 * 1024 * 1024)

/* Copy a source, with its name and its bytes, into the arena. NULL on failure. */
const struct source *ceduo_source_copy(struct arena *arena, struct source source);

/* Read a whole file of at most `max` bytes; "-": standard input. Return NULL on error. Name and bytes are in the arena, which
 * lists the file among its `sources`. */
const struct source *ceduo_file_read(struct arena *arena, const char *path, size_t max, struct problems *problems);

/* Find a file. An absolute name is used as it is; another is relative to the file that names it (`base_file`, may be NULL).
 * Then the user's data folder, the installed folder and the source tree are searched, also in `folder` (scenes, slopes, stands)
 * and with .yaml appended. Return a path in the arena; NULL: none. */
const char *ceduo_file_find(struct arena *arena, const char *name, const char *base_file, const char *folder);

/* Return the name of a file without its folder. */
const char *ceduo_file_name(const char *path);

/* Return the folders of profiles, in the order of search; NULL ends the list. */
const char *const *ceduo_file_folders(struct arena *arena);

/* Return the names of the .yaml files in `folder`/`subfolder`, without .yaml, sorted. Set *n to their number. */
const char *const *ceduo_file_list(struct arena *arena, const char *folder, const char *subfolder, size_t *n);

/* Write all bytes to an open file. `cancel` (may be NULL) stops it at the next signal. Return false with errno set. */
bool ceduo_file_write_all(int fd, const char *bytes, size_t n, const atomic_bool *cancel);

/* Write a regular file atomically: a temporary file beside it, then a rename. Devices, and the target of a dangling link, are
 * written in place. Return false with errno set. */
bool ceduo_file_write(const char *path, const char *bytes, size_t n);

#define CEDUO_FILE_MARK     ".ceduo-tmp-XXXXXX"                 /* end of the name of a temporary file */
#define CEDUO_FILE_NAME_MAX (NAME_MAX - sizeof CEDUO_FILE_MARK) /* bytes; a longer name is shortened before the mark */

/* A temporary file that is written but not renamed. Write several, then rename them all. A device or FIFO is written by
 * ceduo_file_commit(); `bytes` must stay valid until then. */
struct pending_file {
    const char *path;
    const char *bytes;
    size_t n;
    bool wait;       /* ceduo_file_commit() returns after the disk has the new name */
    char *target;    /* NULL: write in place */
    char *temporary; /* TARGET.ceduo-tmp-…; NULL: none, or renamed */
};

/* Write the temporary file. The first four members must be set. Return false with errno set. Call ceduo_file_abort() even then.
 * */
bool ceduo_file_prepare(struct pending_file *file);
/* Rename it to its target. Return false with errno set. */
bool ceduo_file_commit(struct pending_file *file);
/* Open a file to be written piece by piece. Return its descriptor; -1 with errno set. Call ceduo_file_abort() even then. */
int ceduo_file_begin(struct pending_file *file);
/* Close it and rename it to its target. Return false with errno set. */
bool ceduo_file_finish(struct pending_file *file, int fd);
/* Remove the temporary file unless it was renamed, and free all. */
void ceduo_file_abort(struct pending_file *file);

/* True if two paths lead to one regular file. `b` may be "-", standard input. */
bool ceduo_file_is_same(const char *a, const char *b);

/* True if the name of a file is that of a page: it ends in .html or .htm. */
bool ceduo_file_is_html(const char *path);

/* True if ceduo_file_write() is expected to succeed; nothing is written. Return false with errno set. */
bool ceduo_file_can_write(const char *path);

#endif
