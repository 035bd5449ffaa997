/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCHEMA_H
#define CEDUO_SCHEMA_H

#include "base/text.h"
#include "ceduo/scene.h"
#include "choices.h"

/* The table of the scene: one row for each key of the files, with the member of the scene that holds its value. Everything
 * that knows keys reads it here: the files' reader, --set, --list-parameters, the manual, the forms, typed get and put
 * (value.h), the keys of runs. The rows are in fields.c. */

/* Paths of values: keys joined by '.', items of lists as [0] or [name]: forest[0].stand.trees[oak].per_ha */

/* One step of a path: a key, or what stands in brackets. */
struct path_step {
    const char *p;
    size_t n;
    bool bracket;
};

/* The step at *at, which then is behind it; false at the end or where the path is malformed (then *at stays). */
bool ceduo_path_next(const char *path, size_t length, size_t *at, struct path_step *step);

bool ceduo_path_is(const struct path_step *step, const char *word);

/* Whether a step is a place in a list. */
bool ceduo_path_index(const struct path_step *step, size_t *index);

/* The terminal program asks for all fields of some mappings in one popup, and for one of the kinds of observations by a digit. */
#define CEDUO_ASKED_FIELDS_MAX 16
#define CEDUO_ASKED_KINDS_MAX  9

#define CEDUO_ITEMS_MOST 1000 /* controls; options; belts: each is computed and printed by itself */

enum field_type {
    FIELD_TAG,     /* the file's kind, such as stand/1 */
    FIELD_TEXT,    /* char * */
    FIELD_FILE,    /* a path */
    FIELD_NUMBER,  /* double */
    FIELD_SPREAD,  /* struct ceduo_number: a number or {mean, spread, kind} */
    FIELD_SPREADS, /* struct ceduo_number[3] */
    FIELD_COUNT,   /* uint64_t or unsigned, by its size */
    FIELD_CHOICE,  /* int or an enum: index into choices; -1: not said */
    FIELD_FLAG,    /* bool */
    FIELD_NUMBERS, /* double *, and a count beside */
    FIELD_WORDS,   /* char **, and a count beside */
    FIELD_POINTS,  /* double *x, *z, and a count beside */
    FIELD_GROUP,   /* a mapping of its own */
    FIELD_LIST     /* a pointer to items, and a count beside */
};

enum field_flag {
    FIELD_REQUIRED = 1 << 0,
    FIELD_ABOVE = 1 << 1,    /* lo itself is outside */
    FIELD_UNDER = 1 << 2,    /* hi itself is outside */
    FIELD_FOLLOWS = 1 << 3,  /* a group that may be a path to a file holding it */
    FIELD_MEANLESS = 1 << 4, /* a spread may leave its mean out */
    FIELD_ZERO = 1 << 5,     /* 0 where it is not given; without it and without a default NaN */
    FIELD_ONE_OF = 1 << 6,   /* another key may be given instead: the default holds where neither is */
    FIELD_PLACE = 1 << 7,    /* an x in the slope's coordinates; relative to its first vertex beside, or itself */
    FIELD_NOWHERE = 1 << 8,  /* no member holds it: what reads the files takes it from them */
    FIELD_DRAFT = 1 << 9,    /* as the files have it: the scene holds what follows from it */
    FIELD_WOOD = 1 << 10,    /* it decides about stems, not about trajectories without them */
    FIELD_YEARS = 1 << 11,   /* it decides about the years to come */
    FIELD_OR_NONE = 1 << 13, /* a list instead of which the word none may stand */
    FIELD_OR_ONE = 1 << 14,  /* a list instead of which its only item may stand */
    FIELD_NO_RUN = 1 << 12,  /* it decides about no rock: a name, a limit that figures are held against */
    /* no answer is in doubt because of it or what it holds: how much is computed or shown, what was seen */
    FIELD_SETTLED = 1 << 15
};

struct object;

/* How people read and type a value, where files say it otherwise: see view/typed.h. */
struct field_shown {
    const char *label, *brief; /* marked for translation; brief: for the head of a column, NULL: the label */
    const char *unit;          /* NULL: the file's */
    double per;                /* so many of it are one of the file's */
    double least, most;        /* usual, in the file's unit: beyond it a person is asked back, and a reader warns */
};

struct field {
    const char *key;
    enum field_type type;
    size_t offset, size, beside; /* of the member; beside: of the count of items, or of the relative place */
    const char *unit;            /* "" for a pure number */
    double scale;                /* SI per unit of the file */
    double lo, hi;               /* in the file's unit */
    unsigned flags;
    const char *value;   /* the default as it would be written; NULL: none */
    const char *meaning; /* marked for translation */
    const struct choices *choices;
    const struct object *object;
    struct field_shown shown;
};

struct object {
    const struct field *fields;
    size_t n;
    size_t size;        /* of the structure that it fills */
    const char *folder; /* of profiles, where it may be a file of its own */
};

struct material_belt {
    double from, to;
    int material;
    double rn, rt, roughness, friction, mu; /* instead of the library's; NaN: that */
};

/* What a scene says of a value that is not known: lo and hi, mean and sd, or one_of. */
struct doubt {
    char *path;
    double lo, hi, mean, sd; /* NaN: not given */
    size_t one_of_count;
    char **one_of;
};

/* Something that was observed, as a scene says it: values, or what they have in common. */
struct observed_values {
    double x, from, to; /* m; NaN: not given, as all numbers here */
    size_t values_count;
    double *values;
    char *csv, *column, *only; /* where they stand instead */
    double mean, sd;
    uint64_t n, count, of; /* 0: not given */
    double seen_from, share_seen;
};

/* One row of `observed`: at least one of the kinds. */
struct observed {
    char *name, *name_it, *option;
    int use;
    struct ceduo_rock_def rock;
    struct ceduo_release release;
    double way_from, way_to;
    struct observed_values values[CEDUO_OBSERVED_KINDS];
};

/* A scene as its files give it. Behind struct ceduo_scene stands what the files may say in another form. */
struct scene_draft {
    struct ceduo_scene scene;
    size_t materials_count, controls_m_count, belts_count, doubts_count, observed_count;
    struct material_belt *materials; /* instead of segments */
    double *controls_m;              /* instead of controls */
    struct ceduo_belt *belts;        /* instead of options */
    struct doubt *doubts;
    struct observed *observed;
};

/* The scene, the root of all: it fills a struct scene_draft. */
const struct object *ceduo_schema_scene(void);
const struct object *ceduo_schema_slope(void);
const struct object *ceduo_schema_segment(void);
const struct object *ceduo_schema_belt(void);
const struct object *ceduo_schema_stand(void);

const struct field *ceduo_schema_field(const struct object *object, const char *key);
/* The key that says the same in another way, so that only one of the two may stand there; NULL: there is none. Who sets one
 * of two numbers takes the other out. */
const char *ceduo_schema_other(const struct object *object, const char *key);
/* The same where one member holds both: a value in another unit. */
const struct field *ceduo_schema_unit(const struct object *object, const struct field *field);

/* Whether two paths are of one value: they are the same, or end in such keys of the same mapping. */
bool ceduo_schema_same(const char *a, const char *b);

const struct field *ceduo_schema_step(const struct object *object, const struct path_step *step);

/* The row of the value at a path of a scene; NULL where none is there, or the path goes on within it. */
const struct field *ceduo_schema_at(const char *path);
/* The same of a value that is fitted, which may be of a ground of the library: slope.materials[NAME].KEY. */
const struct field *ceduo_schema_fitted(const char *path);
/* The same, also where it is a group or a list. */
const struct field *ceduo_schema_row(const char *path);

/* Kind of what --set can change at a path: a value, a part of one such as rock.diameter_m.mean or slope.vertices_m[0][1], a mapping,
 * a list, or one of its items. */
enum path_value {
    PATH_UNKNOWN, /* --set knows no such path */
    PATH_TEXT,
    PATH_FILE, /* the name of a file, or the mapping that it holds */
    PATH_NUMBER,
    PATH_WORD, /* one of several words, or a flag */
    PATH_OTHER
};
enum path_value ceduo_schema_value(const char *path);

/* Whether the row of that value, or one around it, has FIELD_SETTLED. */
bool ceduo_schema_is_settled(const char *path);

/* Whether it is a place along the slope, which may be told from its end: x_m, from_m, to_m, controls_m. */
bool ceduo_schema_is_place(const struct field *field);

/* Reads such a place, "end" or "end-10": so many metres before the end of the profile. False where it is none. */
bool ceduo_schema_place_read(const char *text, double *back);

/* Fills an item with its defaults. */
void ceduo_schema_init(const struct object *object, void *item);

/* Sets a FIELD_COUNT. */
void ceduo_schema_set_count(const struct field *field, void *to, uint64_t count);

/* The default of a number in SI; NaN or 0 where it has none. */
double ceduo_schema_default(const struct field *field);

/* Whether a number, in the file's unit, lies in the field's range. */
bool ceduo_schema_in_range(const struct field *field, double value);

/* True if a number, in the file's unit, is usual, or 0. Who types or writes another one may have meant another unit. */
bool ceduo_schema_is_usual(const struct field *field, double value);

/* Whether all that can be drawn of a number, in SI, lies in the range; what is cut at 0 and 1 need not. */
bool ceduo_schema_spread_fits(const struct field *field, struct ceduo_number number);

/* Whether all numbers and words of an item, and of what it holds, lie in the ranges of their fields, and its lists are there. A
 * number without a default may be NaN or 0: whether it must be given is for others to check. So are spreads: those of a rock, its
 * release and the ground. */
bool ceduo_schema_holds(const struct object *object, const void *item);
bool ceduo_schema_field_holds(const struct field *field, const void *item);

/* Check the belts of an option that may not be of a scene. */
enum ceduo_status ceduo_check_stands(const struct ceduo_option *option);

/* True if the lists of an option are there. Its numbers may be any, as in a year that no scene has. `option` may be NULL. */
bool ceduo_option_has_lists(const struct ceduo_option *option);

/* Adds the range of a field; false where it has none. */
bool ceduo_schema_range_text(const struct field *field, struct text *text);

/* Calls `visit` for each parameter with its whole path, groups and lists unfolded. */
void ceduo_schema_visit(const struct object *object, const char *prefix,
                        void (*visit)(void *context, const char *path, const struct field *field), void *context);

#endif
