/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIELDS_H
#define CEDUO_FIELDS_H

/* Macros for rows of the table of keys. */
#include <math.h>

#include "base/language.h"
#include "schema.h"

#define COORDINATE_MAX 1e9 /* m: beyond any survey coordinate */

/* The member that holds a value, alone or with its companion. Nothing for a group whose members belong to the enclosing
 * structure (EMBEDDED), or for a key without member. */
#define MEMBER(type, member)         .offset = offsetof(struct type, member), .size = sizeof((struct type *)0)->member
#define PAIR(type, a, b)             MEMBER(type, a), .companion_offset = offsetof(struct type, b)
#define LIST(type, items, count)     PAIR(type, items, count)
#define PLACE(type, given, relative) PAIR(type, given, relative)
#define POINTS(type, x, count)                                                                                                 \
    .offset = offsetof(struct type, x), .size = 2 * sizeof((struct type *)0)->x,                                               \
    .companion_offset = offsetof(struct type, count)
#define EMBEDDED  .offset = 0
#define NO_MEMBER .offset = 0
/* Members of the draft, as offsets from the slope. */
#define SLOPE_OFFSET(member) (offsetof(struct scene_draft, member) - offsetof(struct scene_draft, scene.slope))
#define SLOPE_LIST(items, count)                                                                                               \
    .offset = SLOPE_OFFSET(items), .size = sizeof((struct scene_draft *)0)->items, .companion_offset = SLOPE_OFFSET(count)
_Static_assert(offsetof(struct ceduo_slope, z) == offsetof(struct ceduo_slope, x) + sizeof(double *), "points are x, z");

/* Flags of a row whose member is a pointer to text. Compiles only with a flag that excludes the row from the key of a run,
 * which must not contain an address. */
#define KEYLESS(more_flags)                                                                                                    \
    ((more_flags) + 0 * sizeof(struct {                                                                                        \
                        _Static_assert((more_flags) & (FIELD_NO_MEMBER | FIELD_FILE_ONLY | FIELD_NO_RUN),                      \
                                       "text needs FIELD_NO_RUN: the key of a run would hold its address");                    \
                        int unused;                                                                                            \
                    }))

/* Unit of a number, its size `si` in SI units, and the range of the number in that unit. */
#define SCALED_RANGE(unit_name, si, min, max) .unit = unit_name, .scale = si, .lo = min, .hi = max
#define RANGE(unit_name, min, max)            SCALED_RANGE(unit_name, 1, min, max)
#define NO_RANGE                              RANGE("", -INFINITY, INFINITY)

/* Rows by their type: key, then .shown, a member, a range if it is a number, .flags, .value (the default) and .meaning. */
#define ROW(kind, name, ...)                                                                                                   \
    {                                                                                                                          \
        .key = name, .type = kind, __VA_ARGS__                                                                                 \
    }
#define NUMBER(name, ...) ROW(FIELD_NUMBER, name, __VA_ARGS__)
#define SPREAD(name, ...) ROW(FIELD_SPREAD, name, __VA_ARGS__)
#define WORD(name, ...)   ROW(FIELD_CHOICE, name, NO_RANGE, __VA_ARGS__)
#define FLAG(name, ...)   ROW(FIELD_FLAG, name, NO_RANGE, __VA_ARGS__)

/* Rows without a range and a default. */
#define TEXT(name, display, member, more_flags, about)                                                                         \
    ROW(FIELD_TEXT, name, NO_RANGE, .shown = display, member, .flags = KEYLESS(more_flags), .meaning = about)
#define FILE_NAME(name, display, member, more_flags, about)                                                                    \
    ROW(FIELD_FILE, name, NO_RANGE, .shown = display, member, .flags = KEYLESS(more_flags), .meaning = about)
#define WORD_LIST(name, display, member, more_flags, about)                                                                    \
    ROW(FIELD_WORDS, name, NO_RANGE, .shown = display, member, .flags = KEYLESS(more_flags), .meaning = about)
#define TAG(kind_name)                                                                                                         \
    ROW(FIELD_TAG, "ceduo", .shown = NAMED(N_("kind of file")), RANGE("", 0, 0), .flags = REQUIRED | FIELD_NO_MEMBER,          \
        .value = kind_name, .meaning = N_("what kind of file this is"))

/* A mapping, or a list of mappings. Its label serves as meaning, unless _LABELLED gives both. */
#define GROUP_LABELLED(name, display, member, more_flags, about, parts)                                                        \
    ROW(FIELD_GROUP, name, NO_RANGE, .shown = display, member, .flags = more_flags, .meaning = about, .object = parts)
#define ITEMS_LABELLED(name, display, member, more_flags, about, parts)                                                        \
    ROW(FIELD_LIST, name, NO_RANGE, .shown = display, member, .flags = more_flags, .meaning = about, .object = parts)
#define GROUP(name, title, member, more_flags, parts)                                                                          \
    ROW(FIELD_GROUP, name, NO_RANGE, .shown = NAMED(title), member, .flags = more_flags, .meaning = title, .object = parts)
#define ITEMS(name, title, member, more_flags, parts)                                                                          \
    ROW(FIELD_LIST, name, NO_RANGE, .shown = NAMED(title), member, .flags = more_flags, .meaning = title, .object = parts)

/* Display of a value: label, brief label for the head of a column, usual range in the file's unit, other unit. */
#define DISPLAY(title, head, unit_name, factor, min, max)                                                                      \
    {                                                                                                                          \
        .label = title, .brief = head, .unit = unit_name, .per = factor, .usual_min = min, .usual_max = max                    \
    }
#define SHOWN(title, head, min, max)       DISPLAY(title, head, NULL, 1, min, max)
#define NAMED(title)                       SHOWN(title, NULL, -INFINITY, INFINITY)
#define BRIEF(title, head)                 SHOWN(title, head, -INFINITY, INFINITY)
#define USUAL(title, min, max)             SHOWN(title, NULL, min, max)
#define CENTIMETRES(title, head, min, max) DISPLAY(title, head, N_("cm"), 100, min, max)
#define OBJECT(type, rows, profiles)                                                                                           \
    {                                                                                                                          \
        .fields = rows, .n = sizeof rows / sizeof rows[0], .size = sizeof(struct type), .folder = profiles                     \
    }
/* Require at build that a popup can hold all fields of a mapping. */
#define ASKED_AT_ONCE(fields)                                                                                                  \
    _Static_assert(sizeof fields / sizeof fields[0] <= CEDUO_ASKED_FIELDS_MAX, #fields ": more than a popup can ask for")
#define STRING(macro) TEXT_OF(macro)
#define TEXT_OF(text) #text

enum { REQUIRED = FIELD_REQUIRED, ABOVE = FIELD_ABOVE, ZERO = FIELD_ZERO, YEARS = FIELD_YEARS, NO_RUN = FIELD_NO_RUN };

/* Keys of the rock, its release, and observations of real rocks. */
extern const struct object ceduo_rock_object, ceduo_release_object, ceduo_observed_object;

#endif
