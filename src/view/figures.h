/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIGURES_H
#define CEDUO_FIGURES_H

#include "report.h"

/* The figures of an answer: one table for each kind of object. JSON nests the tables as they name each other, CSV joins
 * their keys with dots, the manual lists them. To add a figure, add a member to its struct and a row to figures_result.c. */

enum ceduo_value_kind {
    CEDUO_NULL,
    CEDUO_VALUE_ANY,
    CEDUO_VALUE_NUMBER,
    CEDUO_VALUE_COUNT,
    CEDUO_VALUE_FLAG,
    CEDUO_VALUE_TEXT
};

struct ceduo_value {
    enum ceduo_value_kind kind;
    union {
        double number; /* not finite: as null */
        uint64_t count;
        bool flag;
        const char *text; /* NULL: as null */
    };
};

/* A place in one of the three reports. The figures of an option, a belt, a control or a year are read from it; of a sensitivity
 * those of a figure, an input or a pair of options; of a calibration those of a value or an observation. */
struct ceduo_place {
    const struct ceduo_report *report;
    const struct ceduo_uncertainty_report *uncertainty;
    const struct ceduo_calibration_report *calibration;
    size_t option, belt, control, felling;
    size_t item, column, figure, input; /* item, column: in a list of the last two reports */
    const struct ceduo_year *year;      /* NULL: the stands as filed */
    struct ceduo_years_summary sum;     /* of the option's years, where they are asked for */
};

struct ceduo_figure;

/* Reads a value from an object, and says of which kind it is where it is not null; CEDUO_VALUE_ANY: a number or a text. */
struct ceduo_reader {
    struct ceduo_value (*read)(const struct ceduo_figure *figure, const void *object);
    enum ceduo_value_kind kind;
};

/* A row is a value, an object or list of objects (`of`), or sentences (`say`). A row with none of them ends a table. */
struct ceduo_figure {
    const char *key;                         /* NULL: the figures of `of` stand here without an object of their own */
    const char *unit;                        /* "": none */
    const char *meaning;                     /* for the manual, as is */
    const char *null;                        /* when it is null, also of a list; NULL: never */
    const void *(*from)(const void *object); /* the object to read from; NULL: the same */
    const struct ceduo_reader *value;
    size_t offset; /* in the object */
    double scale;  /* of numbers, and of all numbers in `of`; 0: 1 */
    const struct ceduo_figure *of;
    bool (*enter)(struct ceduo_place *place, size_t i); /* a list: goes to item i; false after the last */
    const void *(*item)(const void *object, size_t i);  /* a list within any object; NULL after the last */
    size_t columns; /* of such a list: its items in CSV, whose heads are name[0] and so on */
    void (*say)(const struct ceduo_place *place, ceduo_sentence_sink *say, void *context);
    bool one;     /* of sentences: there is one, and JSON has it as text, not as a list */
    bool details; /* of a list: null where details are not asked for */
    bool plain;   /* of a list: its items are values, not objects */
};

static inline bool ceduo_figure_is_end(const struct ceduo_figure *f)
{
    return !f->value && !f->of && !f->say;
}

/* Writes what a table says of an object as one line of JSON, with lists that are long or without. */
void ceduo_figures_json(struct text *text, const struct ceduo_figure *figures, const void *object, bool details);

/* A table as CSV: a row for each item of the lists that are entered one within the other, without such a list for the object. */
#define CEDUO_CSV_LEVELS 3
struct ceduo_csv {
    const struct ceduo_figure *columns;
    bool (*enter[CEDUO_CSV_LEVELS])(struct ceduo_place *place, size_t i);
};
void ceduo_csv_head(struct text *text, const struct ceduo_csv *csv);
void ceduo_csv_rows(struct text *text, const struct ceduo_csv *csv, const void *object);

/* JSON Schema (draft 2020-12) of what ceduo_figures_json() writes, on one line; its $id ends in the format's name. `row`: with
 * --each the output also has the object "row". */
void ceduo_figures_schema(struct text *text, const char *format, const struct ceduo_figure *figures, bool row);

/* A line for each column of CSV: path, type, unit, when it is empty, meaning, with tabs between them; or their `heads`, the paths
 * alone, with a comma behind each. */
void ceduo_figures_columns(struct text *rows, const struct ceduo_figure *columns, bool heads);

/* The whole of a result, a sensitivity and a calibration, read from a struct ceduo_place; and of a search, read from a struct
 * ceduo_find_report. */
extern const struct ceduo_figure ceduo_result_figures[], ceduo_find_figures[];
extern const struct ceduo_figure ceduo_uncertainty_figures[], ceduo_calibration_figures[];

/* Of a result a row for each option and control, its years or its stands; of a sensitivity for each figure and input; of a
 * calibration for each value; of a search one. They are read from the same objects. */
extern const struct ceduo_csv ceduo_control_csv, ceduo_year_csv, ceduo_stand_csv;
extern const struct ceduo_csv ceduo_uncertainty_csv, ceduo_calibration_csv, ceduo_find_csv;
static inline const struct ceduo_csv *ceduo_result_csv(bool stands, bool years)
{
    return stands ? &ceduo_stand_csv : years ? &ceduo_year_csv : &ceduo_control_csv;
}

/* Tables with a list of their own in the manual: they are long, or part of several objects. */
struct ceduo_figure_list {
    const char *title; /* NULL: the end */
    const struct ceduo_figure *figures;
};
extern const struct ceduo_figure_list ceduo_figure_lists[];

#endif
