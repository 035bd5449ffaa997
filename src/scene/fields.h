/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIELDS_H
#define CEDUO_FIELDS_H

/* How rows of the table of keys are written. */
#include <math.h>

#include "base/language.h"
#include "schema.h"

#define FAR 1e9 /* m: survey coordinates and more */

/* The member of a value, alone or with the member that belongs to it. */
#define AT(type, member)             offsetof(struct type, member), sizeof((struct type *)0)->member, 0
#define PAIR(type, member, other)    offsetof(struct type, member), sizeof((struct type *)0)->member, offsetof(struct type, other)
#define LIST(type, items, count)     PAIR(type, items, count)
#define PLACE(type, given, relative) PAIR(type, given, relative)
#define POINTS(type, x, count)       offsetof(struct type, x), 2 * sizeof((struct type *)0)->x, offsetof(struct type, count)
#define SAME                         0, 0, 0 /* a group whose members are of the structure around it */
#define NOWHERE                      0, 0, 0
/* Members of the draft for keys of the slope. */
#define IN_SLOPE(member)       (offsetof(struct scene_draft, member) - offsetof(struct scene_draft, scene.slope))
#define OF_SLOPE(items, count) IN_SLOPE(items), sizeof((struct scene_draft *)0)->items, IN_SLOPE(count)
_Static_assert(offsetof(struct ceduo_slope, z) == offsetof(struct ceduo_slope, x) + sizeof(double *), "points are x, z");

/* Flags of a row whose member is a pointer to text. It compiles only with a flag that keeps it out of the key of a run, which must not
 * hold an address. */
#define KEYLESS (FIELD_NOWHERE | FIELD_DRAFT | FIELD_NO_RUN)
#define TEXT_FLAGS(kind, flags)                                                                                                \
    ((flags) + 0 * sizeof(struct {                                                                                             \
                   _Static_assert(((kind) != FIELD_TEXT && (kind) != FIELD_FILE && (kind) != FIELD_WORDS) ||                   \
                                      ((flags)&KEYLESS),                                                                       \
                                  "text needs FIELD_NO_RUN: the key of a run would hold its address");                         \
                   int unused;                                                                                                 \
               }))

/* Rows by their kind; `at` is three members. */
#define ROW(...)                                                                                                               \
    {                                                                                                                          \
        __VA_ARGS__                                                                                                            \
    }
#define NUM(kind, key, says, at, unit, scale, lo, hi, flags, value, meaning)                                                   \
    ROW(key, kind, at, unit, scale, lo, hi, flags, value, meaning, NULL, NULL, says)
#define NUMBER(key, says, at, unit, lo, hi, flags, value, meaning)                                                             \
    ROW(key, FIELD_NUMBER, at, unit, 1, lo, hi, flags, value, meaning, NULL, NULL, says)
#define SPREAD(key, says, at, unit, lo, hi, flags, value, meaning)                                                             \
    ROW(key, FIELD_SPREAD, at, unit, 1, lo, hi, flags, value, meaning, NULL, NULL, says)
#define OTHER(kind, key, says, at, flags, value, meaning, choices, object)                                                     \
    ROW(key, kind, at, "", 1, -INFINITY, INFINITY, TEXT_FLAGS(kind, flags), value, meaning, choices, object, says)
#define WORD(key, says, at, flags, value, meaning, choices)                                                                    \
    ROW(key, FIELD_CHOICE, at, "", 1, -INFINITY, INFINITY, flags, value, meaning, choices, NULL, says)
/* A mapping, a list of mappings: the label is its meaning, unless a message or popup says more of it. */
#define GROUP_SAID(key, says, at, flags, meaning, object)                                                                      \
    ROW(key, FIELD_GROUP, at, "", 1, -INFINITY, INFINITY, flags, NULL, meaning, NULL, object, says)
#define ITEMS_SAID(key, says, at, flags, meaning, object)                                                                      \
    ROW(key, FIELD_LIST, at, "", 1, -INFINITY, INFINITY, flags, NULL, meaning, NULL, object, says)
#define GROUP(key, label, at, flags, object)                                                                                   \
    ROW(key, FIELD_GROUP, at, "", 1, -INFINITY, INFINITY, flags, NULL, label, NULL, object, NAMED(label))
#define ITEMS(key, label, at, flags, object)                                                                                   \
    ROW(key, FIELD_LIST, at, "", 1, -INFINITY, INFINITY, flags, NULL, label, NULL, object, NAMED(label))
#define TEXT(key, says, at, flags, meaning)                                                                                    \
    ROW(key, FIELD_TEXT, at, "", 1, -INFINITY, INFINITY, TEXT_FLAGS(FIELD_TEXT, flags), NULL, meaning, NULL, NULL, says)
#define TAG(value)                                                                                                             \
    ROW("ceduo", FIELD_TAG, NOWHERE, "", 1, 0, 0, REQUIRED | FIELD_NOWHERE, value, N_("what kind of file this is"), NULL,      \
        NULL, NAMED(N_("kind of file")))

/* How people see it: a label, a short one for the head of a column, the usual range in the file's unit, another unit. */
#define SHOWN(label, brief, least, most)       ROW(label, brief, NULL, 1, least, most)
#define NAMED(label)                           SHOWN(label, NULL, -INFINITY, INFINITY)
#define BRIEF(label, brief)                    SHOWN(label, brief, -INFINITY, INFINITY)
#define USUAL(label, least, most)              SHOWN(label, NULL, least, most)
#define CENTIMETRES(label, brief, least, most) ROW(label, brief, N_("cm"), 100, least, most)
#define OBJECT(type, fields, folder)           ROW(fields, sizeof fields / sizeof fields[0], sizeof(struct type), folder)
/* Fails at build if a popup cannot hold the fields of a mapping that it asks for. */
#define ASKED_AT_ONCE(fields)                                                                                                  \
    _Static_assert(sizeof fields / sizeof fields[0] <= CEDUO_ASKED_FIELDS_MAX, #fields ": more than a popup can ask for")
#define STRING(macro) TEXT_OF(macro)
#define TEXT_OF(text) #text

enum { REQUIRED = FIELD_REQUIRED, ABOVE = FIELD_ABOVE, ZERO = FIELD_ZERO, YEARS = FIELD_YEARS, NO_RUN = FIELD_NO_RUN };

/* The rock, its release, and what was observed of real rocks. */
extern const struct object ceduo_rock_object, ceduo_release_object, ceduo_observed_object;

#endif
