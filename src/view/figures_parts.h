/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIGURES_PARTS_H
#define CEDUO_FIGURES_PARTS_H

/* Macros for rows of figures. */
#include "figures.h"

#include <math.h>

#define NO_VALUE  ((struct ceduo_value){.kind = CEDUO_NULL})
#define NUMBER(x) ((struct ceduo_value){.kind = CEDUO_VALUE_NUMBER, .number = (x)})
#define COUNT(x)  ((struct ceduo_value){.kind = CEDUO_VALUE_COUNT, .count = (x)})
#define FLAG(x)   ((struct ceduo_value){.kind = CEDUO_VALUE_FLAG, .flag = (x)})
#define WORD(x)   ((struct ceduo_value){.kind = CEDUO_VALUE_TEXT, .text = (x)})

static inline const void *get_member(const struct ceduo_figure *f, const void *object)
{
    return (const char *)object + f->offset;
}

/* Define a reader for `value`: m is a member of type `type`; `kind` is NUMBER, COUNT, FLAG or TEXT. */
#define READ(name, type, kind, result)                                                                                         \
    static inline struct ceduo_value name##_read(const struct ceduo_figure *f, const void *object)                             \
    {                                                                                                                          \
        type const m = *(type const *)get_member(f, object);                                                                   \
        return result;                                                                                                         \
    }                                                                                                                          \
    static const struct ceduo_reader name[1] = {{name##_read, CEDUO_VALUE_##kind}};
READ(number_at, double, NUMBER, NUMBER(m))
READ(count_at, uint64_t, COUNT, COUNT(m))
READ(unsigned_at, unsigned, COUNT, COUNT(m))
READ(flag_at, bool, FLAG, FLAG(m))
READ(text_at, char *, TEXT, WORD(m))
READ(fixed_text_at, char const *, TEXT, WORD(m))

/* Row of a struct member, read by its type; a nested table. */
#define MEMBER(object, member)                                                                                                 \
    .value = _Generic(((struct ceduo_##object *)0)->member, double: number_at, uint64_t: count_at,                     \
                      unsigned: unsigned_at, bool: flag_at, char *: text_at, const char *: fixed_text_at),             \
    .offset = offsetof(struct ceduo_##object, member)
#define IN(object, member, rows) .table = rows, .offset = offsetof(struct ceduo_##object, member)
#define END                                                                                                                    \
    {                                                                                                                          \
        .key = NULL                                                                                                            \
    }

/* Define a reader for `value`: o is the object, f the row. */
#define VALUE(name, type, kind, result)                                                                                        \
    static struct ceduo_value name##_read(const struct ceduo_figure *f, const void *object)                                    \
    {                                                                                                                          \
        const struct ceduo_##type *o = object;                                                                                 \
        (void)f, (void)o;                                                                                                      \
        return result;                                                                                                         \
    }                                                                                                                          \
    static const struct ceduo_reader name[1] = {{name##_read, CEDUO_VALUE_##kind}};

/* Define a function for `from`: o is the current object, the result the object to read. */
#define OBJECT(name, type, object)                                                                                             \
    static const void *name(const void *from)                                                                                  \
    {                                                                                                                          \
        const struct ceduo_##type *o = from;                                                                                   \
        return object;                                                                                                         \
    }

/* Define a function for `enter`: p->member iterates over n items. */
#define ENTER(name, member, n)                                                                                                 \
    static bool name(struct ceduo_place *p, size_t i)                                                                          \
    {                                                                                                                          \
        p->member = i;                                                                                                         \
        return i < (n);                                                                                                        \
    }

#define VERSION                                                                                                                \
    {                                                                                                                          \
        "version", "", "version of the program", .value = version_of                                                           \
    }
VALUE(version_of, place, TEXT, WORD(CEDUO_VERSION))

/* Conditions for null. */
#define NO_ROCK  "no rock arrives"
#define TOO_FEW  "fewer than two rocks arrive"
#define NO_LIMIT "the control has no accepted_kJ"

#endif
