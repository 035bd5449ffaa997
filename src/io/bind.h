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

/* Where what is read goes. */
struct binding {
    struct arena *arena;
    struct problems *problems;        /* what is wrong, with the path of each value; reading goes on, so that all is found */
    struct problems *unusual;         /* numbers beyond what is usual; may be NULL */
    const struct source_note **notes; /* every source */
    struct bad_values *bad;           /* what is wrong */
    /* Where the profile ends, m in its own coordinates, for places such as end-10: asked once, when a file has one. NaN as the
     * answer: such places cannot be read. NULL where the object has no place. */
    double (*end)(void *context);
    void *context;
};

/* Fills `item` (already holding its defaults) from a mapping. A number that is wrong keeps its default. */
void ceduo_bind(const struct binding *to, const struct object *object, const struct node *node, void *item);

/* Says that an object has no such key: which was meant, or which there are. The one that was meant, or NULL. */
const char *ceduo_bind_unknown_key(const struct object *object, const char *key, struct text *said);

#endif
