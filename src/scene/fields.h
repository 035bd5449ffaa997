/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIELDS_H
#define CEDUO_FIELDS_H

/* Macros for rows of the table of keys. */
#include <math.h>

#include "base/language.h"
#include "schema.h"

#define COORDINATE_MAX 1e9 /* m: beyond any survey coordinate */

/* The member that holds a value, alone or with its associated member. */
#define MEMBER(type, member)         offsetof(struct type, member), sizeof((struct type *)0)->member, 0
#define PAIR(type, a, b)             offsetof(struct type, a), sizeof((struct type *)0)->a, offsetof(struct type, b)
#define LIST(type, items, count)     PAIR(type, items, count)
#define PLACE(type, given, relative) PAIR(type, given, relative)
#define POINTS(type, x, count)       offsetof(struct type, x), 2 * sizeof((struct type *)0)->x, offsetof(struct type, count)
#define EMBEDDED                     0, 0, 0 /* a group whose members belong to the enclosing structure */
#define NO_MEMBER                    0, 0, 0
/* Members of the draft, as offsets from the slope. */
#define SLOPE_OFFSET(member)     (offsetof(struct scene_draft, member) - offsetof(struct scene_draft, scene.slope))
#define SLOPE_LIST(items, count) SLOPE_OFFSET(items), sizeof((struct scene_draft *)0)->items, SLOPE_OFFSET(count)
_Static_assert(offsetof(struct ceduo_slope, z) == offsetof(struct ceduo_slope, x) + sizeof(double *), "points are x, z");

/* Flags of a row whose member is a pointer to text. Compiles only with a flag that excludes the row from the key of a run,
 * which must not contain an address. */
#define KEYLESS (FIELD_NO_MEMBER | FIELD_FILE_ONLY | FIELD_NO_RUN)
#define TEXT_FLAGS(kind, flags)                                                                                                \
    ((flags) + 0 * sizeof(struct {                                                                                             \
                   _Static_assert(((kind) != FIELD_TEXT && (kind) != FIELD_FILE && (kind) != FIELD_WORDS) ||                   \
                                      ((flags)&KEYLESS),                                                                       \
                                  "text needs FIELD_NO_RUN: the key of a run would hold its address");                         \
                   int unused;                                                                                                 \
               }))

/* Rows by their kind; `member` expands to three initialisers. */
#define ROW(...)                                                                                                               \
    {                                                                                                                          \
        __VA_ARGS__                                                                                                            \
    }
#define NUM(kind, key, display, member, unit, scale, lo, hi, flags, value, meaning)                                            \
    ROW(key, kind, member, unit, scale, lo, hi, flags, value, meaning, NULL, NULL, display)
#define NUMBER(key, display, member, unit, lo, hi, flags, value, meaning)                                                      \
    ROW(key, FIELD_NUMBER, member, unit, 1, lo, hi, flags, value, meaning, NULL, NULL, display)
#define SPREAD(key, display, member, unit, lo, hi, flags, value, meaning)                                                      \
    ROW(key, FIELD_SPREAD, member, unit, 1, lo, hi, flags, value, meaning, NULL, NULL, display)
#define KIND_ROW(kind, key, display, member, flags, value, meaning, choices, object)                                           \
    ROW(key, kind, member, "", 1, -INFINITY, INFINITY, TEXT_FLAGS(kind, flags), value, meaning, choices, object, display)
#define WORD(key, display, member, flags, value, meaning, choices)                                                             \
    ROW(key, FIELD_CHOICE, member, "", 1, -INFINITY, INFINITY, flags, value, meaning, choices, NULL, display)
/* A mapping, or a list of mappings. Its label serves as meaning, unless _LABELLED gives both. */
#define GROUP_LABELLED(key, display, member, flags, meaning, object)                                                           \
    ROW(key, FIELD_GROUP, member, "", 1, -INFINITY, INFINITY, flags, NULL, meaning, NULL, object, display)
#define ITEMS_LABELLED(key, display, member, flags, meaning, object)                                                           \
    ROW(key, FIELD_LIST, member, "", 1, -INFINITY, INFINITY, flags, NULL, meaning, NULL, object, display)
#define GROUP(key, label, member, flags, object)                                                                               \
    ROW(key, FIELD_GROUP, member, "", 1, -INFINITY, INFINITY, flags, NULL, label, NULL, object, NAMED(label))
#define ITEMS(key, label, member, flags, object)                                                                               \
    ROW(key, FIELD_LIST, member, "", 1, -INFINITY, INFINITY, flags, NULL, label, NULL, object, NAMED(label))
#define TEXT(key, display, member, flags, meaning)                                                                             \
    ROW(key, FIELD_TEXT, member, "", 1, -INFINITY, INFINITY, TEXT_FLAGS(FIELD_TEXT, flags), NULL, meaning, NULL, NULL, display)
#define TAG(value)                                                                                                             \
    ROW("ceduo", FIELD_TAG, NO_MEMBER, "", 1, 0, 0, REQUIRED | FIELD_NO_MEMBER, value, N_("what kind of file this is"), NULL,  \
        NULL, NAMED(N_("kind of file")))

/* Display of a value: label, brief label for the head of a column, usual range in the file's unit, other unit. */
#define SHOWN(label, brief, usual_lo, usual_hi)       ROW(label, brief, NULL, 1, usual_lo, usual_hi)
#define NAMED(label)                                  SHOWN(label, NULL, -INFINITY, INFINITY)
#define BRIEF(label, brief)                           SHOWN(label, brief, -INFINITY, INFINITY)
#define USUAL(label, usual_lo, usual_hi)              SHOWN(label, NULL, usual_lo, usual_hi)
#define CENTIMETRES(label, brief, usual_lo, usual_hi) ROW(label, brief, N_("cm"), 100, usual_lo, usual_hi)
#define OBJECT(type, fields, folder)                  ROW(fields, sizeof fields / sizeof fields[0], sizeof(struct type), folder)
/* Require at build that a popup can hold all fields of a mapping. */
#define ASKED_AT_ONCE(fields)                                                                                                  \
    _Static_assert(sizeof fields / sizeof fields[0] <= CEDUO_ASKED_FIELDS_MAX, #fields ": more than a popup can ask for")
#define STRING(macro) TEXT_OF(macro)
#define TEXT_OF(text) #text

enum { REQUIRED = FIELD_REQUIRED, ABOVE = FIELD_ABOVE, ZERO = FIELD_ZERO, YEARS = FIELD_YEARS, NO_RUN = FIELD_NO_RUN };

/* Keys of the rock, its release, and observations of real rocks. */
extern const struct object ceduo_rock_object, ceduo_release_object, ceduo_observed_object;

#endif
