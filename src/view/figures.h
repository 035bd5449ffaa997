/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIGURES_H
#define CEDUO_FIGURES_H

#include "report.h"

/* Figures of an answer, one table for each kind of object. JSON nests tables, CSV joins keys with dots, the manual lists
 * them. To add a figure, add a member to its struct and a row to figures_result.c. */

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
        double number; /* not finite: null */
        uint64_t count;
        bool flag;
        const char *text; /* NULL: null */
    };
};

/* Cursor into a report: option, belt, control, year; figure, input or pair of options in an uncertainty
 * report; value or observation in a calibration report. */
struct ceduo_place {
    const struct ceduo_report *report;
    const struct ceduo_uncertainty_report *uncertainty;
    const struct ceduo_calibration_report *calibration;
    size_t option, belt, control, felling;
    size_t item, column, figure, input; /* item, column: in a list of the last two reports */
    const struct ceduo_year *year;      /* NULL: the stands of the file */
    struct ceduo_years_summary sum;     /* summary of the option's years, if requested */
    bool designed;                      /* the scene requests design values: */
    struct ceduo_designs designs;       /* those of the control */
};

struct ceduo_figure;

/* Reader of a value, and its kind if not null; CEDUO_VALUE_ANY: number or text. */
struct ceduo_reader {
    struct ceduo_value (*read)(const struct ceduo_figure *figure, const void *object);
    enum ceduo_value_kind kind;
};

/* A row is a value, an object or list of objects (`table`), or sentences (`sentences`). A row with none of them ends a
 * table. */
struct ceduo_figure {
    const char *key;                         /* NULL: the figures of `table` belong to the enclosing object */
    const char *unit;                        /* "": none */
    const char *meaning;                     /* for the manual */
    const char *null;                        /* condition for null, also of a list; NULL: never */
    const void *(*from)(const void *object); /* returns the object to read; NULL: unchanged */
    const struct ceduo_reader *value;
    size_t offset; /* in the object */
    double scale;  /* factor of numbers, also of all numbers in `table`; 0: 1 */
    const struct ceduo_figure *table;
    bool (*enter)(struct ceduo_place *place, size_t i); /* list: selects item i; false after the last */
    const void *(*item)(const void *object, size_t i);  /* list inside any object: item i; NULL after the last */
    size_t columns;                                     /* CSV: items of such a list, with heads name[0] and so on */
    void (*sentences)(const struct ceduo_place *place, ceduo_sentence_sink *sink, void *context);
    bool single;  /* one sentence, in JSON a text and not a list */
    bool details; /* a list that is null unless details are requested */
    bool plain;   /* a list of values, not objects */
};

static inline bool ceduo_figure_is_end(const struct ceduo_figure *f)
{
    return !f->value && !f->table && !f->sentences;
}

/* Append an object as one line of JSON; `details`: with long lists. */
void ceduo_figures_json(struct text *text, const struct ceduo_figure *figures, const void *object, bool details);

/* Find a number by its path in the JSON; an item of a list has its index or its name in brackets. Set the value and the ends of
 * its 95 % interval, NaN if null or unknown. */
enum ceduo_figure_found { CEDUO_FIGURE_FOUND, CEDUO_NO_FIGURE, CEDUO_NO_ITEM, CEDUO_NOT_A_NUMBER };
enum ceduo_figure_found ceduo_figures_get(const struct ceduo_figure *figures, const void *object, const char *path,
                                          double value[3]);

/* True if paths, in any notation, name figures of the years by which options are judged. */
bool ceduo_figures_need_years(const char *paths);

/* CSV table. Each item of the nested lists is a row; without a list the object is. */
#define CEDUO_CSV_LEVELS 3
struct ceduo_csv {
    const struct ceduo_figure *columns;
    bool (*enter[CEDUO_CSV_LEVELS])(struct ceduo_place *place, size_t i);
};
void ceduo_csv_head(struct text *text, const struct ceduo_csv *csv);
void ceduo_csv_rows(struct text *text, const struct ceduo_csv *csv, const void *object);

/* Append the JSON Schema (draft 2020-12) of ceduo_figures_json() as one line; its $id ends in `format`. `row`: the output
 * has the object "row" of --each, too. */
void ceduo_figures_schema(struct text *text, const char *format, const struct ceduo_figure *figures, bool row);

/* Append a line per CSV column, separated by tabs: path, type, unit, condition for empty, meaning. `heads`: only paths, each
 * followed by a comma. */
void ceduo_figures_columns(struct text *rows, const struct ceduo_figure *columns, bool heads);

/* All figures of a result, uncertainty or calibration (object: struct ceduo_place), and of a search (struct
 * ceduo_find_report). */
extern const struct ceduo_figure ceduo_result_figures[], ceduo_find_figures[];
extern const struct ceduo_figure ceduo_uncertainty_figures[], ceduo_calibration_figures[];

/* A row of --each. */
struct ceduo_row_state {
    const char *reason; /* reason of the failure; NULL: it did not fail */
    const char *run;    /* hash of its input; NULL: not requested */
};
/* Columns before those of the result; the answer of a row that failed; its columns that are not empty (object: struct
 * ceduo_row_state). */
extern const struct ceduo_figure ceduo_row_figures[], ceduo_failed_figures[], ceduo_failed_columns[];

/* CSV tables. Result: a row per option and control, year or stand; uncertainty: per figure and input; calibration: per
 * value; search: one row. */
extern const struct ceduo_csv ceduo_control_csv, ceduo_year_csv, ceduo_stand_csv;
extern const struct ceduo_csv ceduo_uncertainty_csv, ceduo_calibration_csv, ceduo_find_csv;
static inline const struct ceduo_csv *ceduo_result_csv(bool stands, bool years)
{
    return stands ? &ceduo_stand_csv : years ? &ceduo_year_csv : &ceduo_control_csv;
}

/* Tables with their own list in the manual, because they are long or used in several objects. */
struct ceduo_figure_list {
    const char *title; /* NULL: the end */
    const struct ceduo_figure *figures;
};
extern const struct ceduo_figure_list ceduo_figure_lists[];

#endif
