/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIGURES_H
#define CEDUO_FIGURES_H

#include "report.h"

/* What a result says, figure by figure: one table for each kind of object. JSON nests the tables as they name each other,
 * CSV joins their keys with dots, and the manual lists them. A new figure is a member of its struct and a row in figures.c. */

enum ceduo_value_kind { CEDUO_NULL, CEDUO_VALUE_NUMBER, CEDUO_VALUE_COUNT, CEDUO_VALUE_FLAG, CEDUO_VALUE_TEXT };

struct ceduo_value {
    enum ceduo_value_kind kind;
    union {
        double number; /* not finite: as null */
        uint64_t count;
        bool flag;
        const char *text; /* NULL: as null */
    };
};

/* A place in a report: what the figures of an option, a belt, a control or a year are read from. */
struct ceduo_place {
    const struct ceduo_report *report;
    size_t option, belt, control;
    const struct ceduo_year *year;     /* NULL: the stands as filed */
    struct ceduo_years_summary sum;    /* of the option's years, where they are asked for */
};

/* A row. It is a value, an object or a list of objects by `of`, or sentences. A table ends with a row without any. */
struct ceduo_figure {
    const char *key;     /* NULL: the figures of `of` stand here, not in an object of their own */
    const char *unit;    /* "": none */
    const char *meaning; /* for the manual, as is */
    const char *null;    /* where it does not exist; NULL: it always does */
    const void *(*from)(const void *object); /* another object to read from, NULL where there is none; without: the same */
    struct ceduo_value (*value)(const struct ceduo_figure *figure, const void *object);
    size_t offset;       /* in the object */
    double scale;        /* of numbers, and of all numbers in `of`; 0: 1 */
    const struct ceduo_figure *of;
    bool (*enter)(struct ceduo_place *place, size_t i); /* a list: goes to item i, false beyond the last */
    void (*say)(const struct ceduo_place *place, ceduo_words_say *say, void *context);
    bool optional;       /* JSON leaves it out where it is null or empty */
};

static inline bool ceduo_figure_is_end(const struct ceduo_figure *f)
{
    return !f->value && !f->of && !f->say;
}

/* What a row of values is in an object, which may be NULL; `scale` is of the table. */
struct ceduo_value ceduo_figure_value(const struct ceduo_figure *figure, const void *object, double scale);

/* The object of a row with `of`, NULL where there is none; and the scale of its numbers. */
const void *ceduo_figure_object(const struct ceduo_figure *figure, const void *object);
double ceduo_figure_scale(const struct ceduo_figure *figure, double scale);

/* All of a result, of a struct ceduo_place; and of a search, of a struct ceduo_find_report. */
extern const struct ceduo_figure ceduo_result_figures[], ceduo_find_figures[];

/* Rows of CSV, of a struct ceduo_place: a control, a control in a year, a belt. */
extern const struct ceduo_figure ceduo_control_columns[], ceduo_year_columns[], ceduo_stand_columns[];
extern const struct ceduo_figure ceduo_find_columns[]; /* of a struct ceduo_find_report */

/* Tables that the manual lists by themselves, because they are long or stand in several objects. */
struct ceduo_figure_list {
    const char *title; /* NULL: the end */
    const struct ceduo_figure *figures;
};
extern const struct ceduo_figure_list ceduo_figure_lists[];

#endif
