/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCHEMA_H
#define CEDUO_SCHEMA_H

#include "node.h"
#include "scene/words.h"

#define CEDUO_ITEMS_MOST 1000 /* controls; options; belts: each is computed and printed by itself */

/* What a file may hold: one table of parameters, read by the files' reader, --set, --list-parameters, the manual and the
 * forms. */

enum field_type {
    FIELD_TAG,     /* the file's kind, such as stand/1 */
    FIELD_TEXT,    /* const char * */
    FIELD_FILE,    /* const char *: a path */
    FIELD_NUMBER,  /* double */
    FIELD_SPREAD,  /* struct ceduo_number: a number or {mean, spread, kind} */
    FIELD_SPREADS, /* struct ceduo_number[3] */
    FIELD_COUNT,   /* uint64_t */
    FIELD_CHOICE,  /* int: index into choices */
    FIELD_FLAG,    /* bool */
    FIELD_NUMBERS, /* struct numbers */
    FIELD_POINTS,  /* struct points */
    FIELD_GROUP,   /* a mapping of its own, fields at offset */
    FIELD_LIST     /* struct list of such mappings */
};

struct numbers {
    double *values;
    size_t n;
};

struct points {
    double *x, *z;
    size_t n;
};

/* Read items, each of the object's size, in the arena. */
struct list {
    void *items;
    size_t n;
};

enum field_flag {
    FIELD_REQUIRED = 1,
    FIELD_ABOVE = 2,  /* lo itself is outside */
    FIELD_UNDER = 4,  /* hi itself is outside */
    FIELD_DEFAULTS = 16, /* a spread may leave its mean out */
    FIELD_FOLLOWS = 8 /* a group that may be a path to a file holding it */
};

struct object;

struct field {
    const char *key;
    enum field_type type;
    size_t offset;
    const char *unit; /* "" for a pure number */
    double scale;     /* SI per unit of the file */
    double lo, hi;    /* in the file's unit */
    unsigned flags;
    const char *value;   /* the default as it would be written; NULL: none */
    const char *meaning; /* marked for translation */
    const struct choices *choices;
    const struct object *object;
};

struct object {
    const char *name;
    const struct field *fields;
    size_t n;
    size_t size;
    void (*init)(void *item); /* the defaults */
    const char *folder;       /* of profiles, where it may be a file of its own */
};

/* The scene, the root of all. */
const struct object *ceduo_schema_scene(void);
const struct object *ceduo_schema_slope(void);
const struct object *ceduo_schema_stand(void);

const struct field *ceduo_schema_field(const struct object *object, const char *key);

/* A note of where a value comes from. */
struct source_note {
    const char *path; /* of the mapping that it stands in, or of a value in it that it is not of */
    const char *kind; /* measured, literature, assumed; changed: of a value that the source around it is not of */
    const char *text;
    bool made; /* by the program, not in the files */
    const struct source_note *before;
};

#define CEDUO_BAD_MOST 100 /* with more, nobody asks what else does not fit */

/* Paths of values that could not be read, are missing or do not exist. */
struct bad_values {
    const char *paths[CEDUO_BAD_MOST];
    size_t n; /* more than there is room for: too many */
};

/* Fills `item` (already holding its defaults) from a mapping. What is wrong goes to `problems`, with the path of each
 * value; reading goes on, so that all problems of a file are found. `notes` collects every source, `bad` what is wrong. A number that is
 * wrong is NaN where it has no default. */
void ceduo_schema_bind(struct arena *arena, const struct object *object, const struct node *node, void *item,
                       struct problems *problems, const struct source_note **notes, struct bad_values *bad);

/* One field's value as a whole, the way ceduo_schema_bind() would; for checking a single edit. */
bool ceduo_schema_range_text(const struct field *field, char *buffer, size_t size);

/* Calls `visit` for each parameter with its whole path, groups and lists unfolded. */
void ceduo_schema_visit(const struct object *object, const char *prefix,
                        void (*visit)(void *context, const char *path, const struct field *field), void *context);

/* Reports a problem at a node, with the path of the value within its file. */
void ceduo_node_problem(struct problems *problems, const struct node *node, const char *path, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
