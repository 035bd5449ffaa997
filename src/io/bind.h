/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BIND_H
#define CEDUO_BIND_H

#include "node.h"
#include "notes.h"
#include "scene/schema.h"

/* Reads the values of a document into the structures that the table of the scene names. */

#define CEDUO_BAD_MOST 100 /* with more, nobody asks what else does not fit */

/* Paths of values that could not be read, are missing or do not exist. */
struct bad_values {
    const char *paths[CEDUO_BAD_MOST];
    size_t n; /* more than there is room for: too many */
};

/* Fills `item` (already holding its defaults) from a mapping. What is wrong goes to `problems`, with the path of each
 * value; reading goes on, so that all problems of a file are found. `notes` collects every source, `bad` what is wrong. A
 * number that is wrong keeps its default. */
void ceduo_bind(struct arena *arena, const struct object *object, const struct node *node, void *item,
                struct problems *problems, const struct source_note **notes, struct bad_values *bad);

/* Room for n + 1 items in the arena. NULL without memory, which is told. */
void *ceduo_bind_take(struct arena *arena, size_t n, size_t size, struct problems *problems);

/* A list of n items with room for `more`; `*room` is how many it holds. NULL without memory, which is told. */
void *ceduo_bind_room(struct arena *arena, void *items, size_t n, size_t more, size_t *room, size_t size,
                      struct problems *problems);

/* Reports a problem at a node, with the path of the value within its file. */
void ceduo_node_problem(struct problems *problems, const struct node *node, const char *path, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
