/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RESUME_H
#define CEDUO_RESUME_H

#include <sys/types.h>

#include "arguments.h"
#include "each.h"

/* Lines of one scene in the output of --resume. */
struct resume_part {
    uint64_t key;   /* hash of its input */
    uint64_t hash;  /* of its lines */
    size_t from, n; /* bytes */
    size_t lines;
    size_t used; /* only in the first part of a key: number of its parts that were used */
    enum exit_status status;
};

/* The growing output of --resume, and the side file FILE.resume with the input of each line. */
struct resume {
    const struct arguments *arguments;
    const struct text *head; /* head of the output */
    struct text identity;    /* of the run: first lines of the side file */
    char *side_path;
    int file, side; /* descriptors; -1: not open */
    size_t end;     /* bytes of the output */
    size_t old_count;
    struct resume_part *old_parts; /* parts of an earlier run, sorted by key, then by place */
    size_t order_count, order_capacity;
    struct resume_part *order; /* in the order of the rows */
};

/* Open and lock the output, and find its complete lines. `each`: before its first scene; `head`: of the output. Report an error
 * and return its status if the output belongs to another run or program, or is unusable. */
enum exit_status ceduo_resume_open(struct resume *resume, struct each *each, const struct text *head);

/* True if the output has the lines of the scene with this key. Sets *status to the exit status of the scene. */
bool ceduo_resume_has(struct resume *resume, uint64_t key, enum exit_status *status);

/* Append the lines of the scene with this key. */
enum exit_status ceduo_resume_add(struct resume *resume, uint64_t key, const struct text *lines, enum exit_status status);

/* Close the output. `whole`: all rows were computed; sort the lines by row. */
enum exit_status ceduo_resume_close(struct resume *resume, bool whole);

/* Return the hash of all that a scene was computed from: version, options, changes and files. */
uint64_t ceduo_resume_run(const struct arguments *arguments, const struct scene_file *file);

/* Return the hash of the files of a scene. */
uint64_t ceduo_resume_files(const struct scene_file *file);

#endif
