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
    size_t used; /* of the first part of a key: number of parts of this key that are used */
    enum exit_status status;
};

/* The output of --resume, which grows, and FILE.resume beside it, which says what each line was computed from. */
struct resume {
    const struct arguments *arguments;
    const struct text *head; /* head of the output */
    struct text identity;    /* first lines of the side file: what the run is */
    char *side_path;
    int file, side; /* descriptors; -1: not open */
    size_t end;     /* bytes of the output */
    size_t known_count;
    struct resume_part *known; /* parts that the output held before, by key, then by place */
    size_t order_count, order_capacity;
    struct resume_part *order; /* in the order of the rows */
};

/* Open and lock the output, and find the lines in it that are whole. `each`: before its first scene; `head`: head of the output.
 * Returns another status than EXIT_DONE if the output belongs to another run or program, or cannot be used, which is reported. */
enum exit_status ceduo_resume_open(struct resume *resume, struct each *each, const struct text *head);

/* True if the output holds the lines of the scene with this key. Sets *status to the exit status of the scene. */
bool ceduo_resume_has(struct resume *resume, uint64_t key, enum exit_status *status);

/* Append the lines of the scene with this key. */
enum exit_status ceduo_resume_add(struct resume *resume, uint64_t key, const struct text *lines, enum exit_status status);

/* Close the output. `whole`: all rows were computed: put the lines into their order if they are not. */
enum exit_status ceduo_resume_close(struct resume *resume, bool whole);

/* Hash of the files that a scene was read from. */
uint64_t ceduo_resume_files(const struct scene_file *file);

#endif
