/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BIND_H
#define CEDUO_BIND_H

#include "node.h"
#include "scene/schema.h"

/* ---- notes ---- */

#define CEDUO_NOTE_TABLE "table" /* kind of a note: what was understood of a table */

/* A note of where a value comes from. */
struct source_note {
    const char *path;           /* of the mapping that it stands in, or of a value in it that it is not of */
    const char *kind;           /* measured, literature, assumed; changed: of a value that the source around it is not of */
    const char *text, *text_it; /* in Italian; NULL: not said */
    bool made;                  /* by the program, not in the files */
    const struct source_note *before;
};

/* Call `say` with the text of each note of a kind, in the order of the files. */
void ceduo_notes_each(const struct source_note *notes, const char *kind, void (*say)(void *context, const char *text),
                      void *context);

/* Whether `outer` is `path` or leads to it. */
bool ceduo_path_leads_to(const char *outer, const char *path);

/* Whether a note is of growth or cutting: it matters to the years to come, not to the stand as it is. */
bool ceduo_note_of_years(const struct source_note *note);

/* True where some value below `path` is "assumed", "calibrated", …, but for growth and cutting. */
bool ceduo_notes_say(const struct source_note *notes, const char *kind, const char *path);

/* The note of the innermost mapping around a value; NULL where nothing is said. */
const struct source_note *ceduo_notes_find(const struct source_note *notes, const char *path);

/* ---- values ---- */

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
    bool warns;                       /* of numbers beyond what is usual */
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
