/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BIND_H
#define CEDUO_BIND_H

#include "node.h"
#include "scene/schema.h"

/* ---- notes ---- */

#define CEDUO_NOTE_TABLE "table" /* kind of a note: how a table was read */

/* Source of a value. */
struct source_note {
    const char *path;    /* mapping that holds the source, or a value in it that has another source */
    const char *kind;    /* measured, literature, assumed, calibrated; changed: the source around the value no longer applies */
    const char *text;    /* in English */
    const char *text_it; /* in Italian; NULL: not given */
    bool made;           /* by the program, not in the files */
    const struct source_note *before;
};

/* Call `print` with the text of each note of a kind, in the order of the files. */
void ceduo_notes_each(const struct source_note *notes, const char *kind, void (*print)(void *context, const char *text),
                      void *context);

/* True if `outer` is `path` or leads to it. */
bool ceduo_path_leads_to(const char *outer, const char *path);

/* True if a note is about growth or cutting: it affects future years only. */
bool ceduo_note_years(const struct source_note *note);

/* True if a value below `path` has a note of this kind. Growth and cutting are ignored. */
bool ceduo_notes_print(const struct source_note *notes, const char *kind, const char *path);

/* Return the note of the innermost mapping around a value; NULL: none. */
const struct source_note *ceduo_notes_find(const struct source_note *notes, const char *path);

/* ---- values ---- */

/* Reads the values of a document into the structures that the table of keys names. */

#define CEDUO_INVALID_MAX 100 /* with more invalid values, cross-checks are skipped */

/* Paths of values that could not be read, are missing or do not exist. */
struct invalid_values {
    const char *paths[CEDUO_INVALID_MAX];
    size_t n; /* may exceed CEDUO_INVALID_MAX */
};

/* Destination of the values. */
struct binding {
    struct arena *arena;
    struct problems *problems;        /* errors, with the path of each value; reading continues after an error */
    bool warns;                       /* report numbers outside their usual range */
    const struct source_note **notes; /* all sources */
    struct invalid_values *invalid;
    /* Return x of the profile's end, m in the file's coordinates, for places such as end-10; NaN: unknown. Called at most once.
     * May be NULL if the object has no place. */
    double (*end)(void *context);
    void *context;
};

/* Fill `item`, which holds its defaults, from a mapping. An invalid number keeps its default. */
void ceduo_bind(const struct binding *to, const struct object *object, const struct node *node, void *item);

/* Warn about a number, in the unit of its field, outside the usual range. */
void ceduo_warn_unusual(struct problems *problems, struct problem_place place, const struct field *f, double value);

/* Append the message that an object has no such key, with the nearest key or all keys. Return the nearest key, or NULL. */
const char *ceduo_bind_unknown_key(const struct object *object, const char *key, struct text *message);

#endif
