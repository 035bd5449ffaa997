/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PART_FILE_H
#define CEDUO_PART_FILE_H

#include "file.h"
#include "scene_file.h"

#define SHARDS_MOST 100000

/* One shard of one scene as a line of JSON, "ceduo-part-1". The first shard of a scene has with it every text that the
 * scene was read from, so that the shards can be joined where none of these files is. */
struct part {
    const char *file; /* that it was read from, and its line there */
    size_t line;
    char *scene;                   /* as it was given */
    uint64_t shard, shards, place; /* from 1; place: of the scene among those that were given */
    uint64_t rocks, key;           /* of the whole run, or of each evaluation of a sensitivity; ceduo_part_key() */
    uint64_t points;               /* base points of a sensitivity; 0: a part of a run */
    double seconds;
    const unsigned char *inputs, *runs; /* ceduo_part_inputs(), ceduo_pool_save() or ceduo_doubt_ask_part(); no inputs:
                                         * length 0 */
    size_t inputs_length, runs_length;
};

enum part_fault {
    PART_GOOD,
    PART_NONE,    /* something else */
    PART_FORMAT,  /* of another format than this */
    PART_CUT,     /* its end is missing */
    PART_CHANGED, /* not as it was written */
    PART_VERSION, /* by another version: `scene` is that version */
    PART_MEMORY
};

/* Adds the line with its end. */
void ceduo_part_write(struct text *out, const struct part *part);

/* Reads a line of n bytes, without its end. What it holds is decoded in place; `scene` is in the arena. */
enum part_fault ceduo_part_read(struct arena *arena, struct part *part, char *line, size_t n);

/* A number for all that a result depends on: the scene as it was read, its numbers, how many rocks and base points.
 * 0 without memory. */
uint64_t ceduo_part_key(const struct scene_file *file, uint64_t rocks, uint64_t points);

/* How a scene was read. */
struct part_words {
    const char **items;
    size_t n;
};
struct part_inputs {
    const char *path;                /* as it was given */
    struct part_words sets, options; /* PATH=VALUE; names */
    struct shelf shelf;
};

/* Its bytes, for the caller to free; NULL without memory. */
unsigned char *ceduo_part_inputs(const struct part_inputs *inputs, size_t *n);

/* Reads them into the arena. False where they are none, or without memory. */
bool ceduo_part_inputs_read(struct arena *arena, struct part_inputs *inputs, const unsigned char *bytes, size_t n);

#endif
