/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCHEMA_H
#define CEDUO_SCHEMA_H

#include "base/text.h"
#include "ceduo/scene.h"
#include "choices.h"

/* The table of keys: one row per key of the files, with the member of the scene that holds its value. It is used by the reader
 * of files, --set, --list-parameters, the manual, the forms, value.h and the keys of runs. The rows are in fields.c. */

/* Paths of values: keys joined by '.', items of lists as [0] or [name]: forest[0].stand.trees[oak].per_ha */

/* One step of a path: a key, or the text in brackets. */
struct path_step {
    const char *p;
    size_t n;
    bool bracket;
};

/* Read the step at *pos, and advance *pos. False at the end, or if the path is malformed; *pos is unchanged then. */
bool ceduo_path_next(const char *path, size_t length, size_t *pos, struct path_step *step);

/* Return the next of several paths, which are separated by blanks; NULL: none is left. Sets *n to its length, and advances
 * *rest. Blanks in brackets belong to a name. */
const char *ceduo_paths_next(const char **rest, size_t *n);

bool ceduo_path_is(const struct path_step *step, const char *word);

/* True if a step is the index of an item; sets *index. */
bool ceduo_path_index(const struct path_step *step, size_t *index);

/* A popup of the terminal program asks for all fields of some mappings, and selects a kind of observation by a digit. */
#define CEDUO_ASKED_FIELDS_MAX 16
#define CEDUO_ASKED_KINDS_MAX  9

#define CEDUO_ITEMS_MAX 1000 /* controls, options, belts: each is computed and printed on its own */

enum field_type {
    FIELD_TAG,     /* the file's kind, such as stand/1 */
    FIELD_TEXT,    /* char * */
    FIELD_FILE,    /* a path */
    FIELD_NUMBER,  /* double */
    FIELD_SPREAD,  /* struct ceduo_number: a number or {mean, spread, kind} */
    FIELD_SPREADS, /* struct ceduo_number[3] */
    FIELD_COUNT,   /* uint64_t or unsigned, by its size */
    FIELD_CHOICE,  /* int or an enum: index into choices; -1: not given */
    FIELD_FLAG,    /* bool */
    FIELD_NUMBERS, /* double *, and a count */
    FIELD_WORDS,   /* char **, and a count */
    FIELD_POINTS,  /* double *x, *z, and a count */
    FIELD_GROUP,   /* a nested mapping */
    FIELD_LIST     /* a pointer to items, and a count */
};

enum field_flag {
    FIELD_REQUIRED = 1 << 0,
    FIELD_ABOVE = 1 << 1,    /* lo itself is outside */
    FIELD_UNDER = 1 << 2,    /* hi itself is outside */
    FIELD_FOLLOWS = 1 << 3,  /* a group, or the path of its file */
    FIELD_MEANLESS = 1 << 4, /* a spread without mean is valid */
    FIELD_ZERO = 1 << 5,     /* 0 if not given; otherwise NaN, unless there is a default */
    FIELD_ONE_OF = 1 << 6,   /* another key may be given instead; the default holds if neither is given */
    /* an x in the slope's coordinates; the companion is the x relative to the first vertex; without it the member is */
    FIELD_PLACE = 1 << 7,
    FIELD_NO_MEMBER = 1 << 8,  /* no member; only the reader of files uses it */
    FIELD_FILE_ONLY = 1 << 9,  /* member of the draft; the scene holds derived values */
    FIELD_FOREST = 1 << 10,    /* affects stems, not trajectories without stems */
    FIELD_YEARS = 1 << 11,     /* affects future years */
    FIELD_OR_NONE = 1 << 13,   /* a list, or the word none */
    FIELD_SCALAR_OK = 1 << 14, /* a list, or its only item */
    FIELD_NO_RUN = 1 << 12,    /* affects no trajectory: a name, a limit */
    /* cannot be uncertain, with all its parts: a computation setting or an observation */
    FIELD_CERTAIN = 1 << 15
};

struct object;

/* Display and input of a value, see view/value_text.h. */
struct field_shown {
    const char *label, *brief;   /* marked for translation; brief: for the head of a column, NULL: the label */
    const char *unit;            /* NULL: the file's unit */
    double per;                  /* displayed units per unit of the file */
    double usual_min, usual_max; /* usual range, in the file's unit; outside, the form asks and the reader warns */
};

struct field {
    const char *key;
    enum field_type type;
    size_t offset, size;     /* position and size of the member, bytes */
    size_t companion_offset; /* position of the number of items, or of the relative place */
    const char *unit;        /* "" for a pure number */
    double scale;            /* SI per unit of the file */
    double lo, hi;           /* in the file's unit */
    unsigned flags;
    const char *value;   /* the default as in a file; NULL: none */
    const char *meaning; /* marked for translation */
    const struct choices *choices;
    const struct object *object;
    struct field_shown shown;
};

struct object {
    const struct field *fields;
    size_t n;
    size_t size;        /* of the filled structure, bytes */
    const char *folder; /* folder of profiles for its files; NULL: none */
};

struct material_belt {
    double from, to;
    int material;
    double rn, rt, roughness, friction, mu; /* override the library; NaN: as in the library */
};

/* Uncertainty of a value in a scene: lo and hi, mean and sd, or one_of. */
struct uncertainty_row {
    char *path;
    double lo, hi, mean, sd; /* NaN: not given */
    size_t one_of_count;
    char **one_of;
};

/* An observation in a scene: values, or their statistics. */
struct observed_values {
    double x, from, to; /* m; for all doubles here NaN: not given */
    size_t values_count;
    double *values;
    char *csv, *column, *only; /* table with the values */
    double mean, sd;
    uint64_t n, count, released_count; /* 0: not given */
    double seen_from, share_seen;
};

/* One row of `observed`, with at least one kind. */
struct observed {
    char *name, *name_it, *option;
    int use;
    struct ceduo_rock_def rock;
    struct ceduo_release release;
    double stretch_from, stretch_to;
    struct observed_values values[CEDUO_OBSERVED_KINDS];
};

/* A scene as in its files: struct ceduo_scene, and values that files may give in another form. */
struct scene_draft {
    struct ceduo_scene scene;
    size_t materials_count, controls_m_count, belts_count, uncertainties_count, observed_count;
    struct material_belt *materials; /* instead of segments */
    double *controls_m;              /* instead of controls */
    struct ceduo_belt *belts;        /* instead of options */
    struct uncertainty_row *uncertainties;
    struct observed *observed;
};

/* Return the root, which fills a struct scene_draft, or one of its parts. */
const struct object *ceduo_schema_scene(void);
const struct object *ceduo_schema_slope(void);
const struct object *ceduo_schema_segment(void);
const struct object *ceduo_schema_belt(void);
const struct object *ceduo_schema_stand(void);

const struct field *ceduo_schema_field(const struct object *object, const char *key);
/* Return the row of a list that a file may give instead of the mapping `field`, under the same key; NULL if none. */
const struct field *ceduo_schema_list(const struct object *object, const struct field *field);
/* Return the alternative key of a value, such as per_ha for per_stool; NULL if none. Only one of the two may be given. */
const char *ceduo_schema_alternative(const struct object *object, const char *key);
/* Return the row of the same member in another unit; NULL if none. */
const struct field *ceduo_schema_unit(const struct object *object, const struct field *field);

/* True if two paths are equal, or end in alternative keys of one mapping. */
bool ceduo_schema_same(const char *a, const char *b);

const struct field *ceduo_schema_step(const struct object *object, const struct path_step *step);

/* Return the row of the value at a path of a scene; NULL if the path is no value, or a part of a value. */
const struct field *ceduo_schema_at(const char *path);
/* As ceduo_schema_at(), also for slope.materials[NAME].KEY, a fitted ground of the library. Reads the first of several
 * paths. */
const struct field *ceduo_schema_fitted(const char *path);
/* As ceduo_schema_at(), also for a group or a list. */
const struct field *ceduo_schema_row(const char *path);

/* Kind of the target of --set at a path: a value, a part of a value such as rock.diameter_m.mean or slope.vertices_m[0][1], a
 * mapping, a list, or a list item. */
enum path_value {
    PATH_UNKNOWN, /* invalid path */
    PATH_TEXT,
    PATH_FILE, /* the name of a file, or the mapping in the file */
    PATH_NUMBER,
    PATH_WORD, /* one of several words, or a flag */
    PATH_OTHER
};
enum path_value ceduo_schema_value(const char *path);

/* True if the row of a path, or an enclosing row, has FIELD_CERTAIN. */
bool ceduo_schema_is_settled(const char *path);

/* True for a place along the slope, which may be relative to the end: x_m, from_m, to_m, controls_m. */
bool ceduo_schema_is_place(const struct field *field);

/* Parse "end" or "end-10", metres before the end of the profile. False if the text is neither. */
bool ceduo_schema_place_read(const char *text, double *back);

/* Fill an item with its defaults. */
void ceduo_schema_init(const struct object *object, void *item);

/* Set a FIELD_COUNT. */
void ceduo_schema_set_count(const struct field *field, void *to, uint64_t count);

/* Return the default of a number in SI; NaN or 0 if there is none. */
double ceduo_schema_default(const struct field *field);

/* True if a number, in the file's unit, lies in the field's range. */
bool ceduo_schema_in_range(const struct field *field, double value);

/* True if a number, in the file's unit, is usual, or 0. Other numbers are probably in a wrong unit. */
bool ceduo_schema_is_usual(const struct field *field, double value);

/* True if all numbers that can be drawn, in SI, lie in the range, or if draws are truncated to 0…1. */
bool ceduo_schema_spread_fits(const struct field *field, struct ceduo_number number);

/* True if all numbers and words of an item and its parts lie in their ranges, and its lists exist. A number without a default
 * may be NaN or 0. Spreads are not checked. */
bool ceduo_schema_holds(const struct object *object, const void *item);
bool ceduo_schema_field_holds(const struct field *field, const void *item);

/* Check the belts of an option outside a scene. */
enum ceduo_status ceduo_check_stands(const struct ceduo_option *option);

/* True if the lists of an option exist. Numbers are not checked: a year may exceed the ranges of files. `option` may be
 * NULL. */
bool ceduo_option_has_lists(const struct ceduo_option *option);

/* Append the range of a field; false if there is none. */
bool ceduo_schema_range_text(const struct field *field, struct text *text);

/* Call `visit` for each parameter below groups and lists, with its full path. */
void ceduo_schema_visit(const struct object *object, const char *prefix,
                        void (*visit)(void *context, const char *path, const struct field *field), void *context);

#endif
