/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of the reader of a survey, for the checks of the whole table. */
#ifndef CEDUO_SURVEY_READER_H
#define CEDUO_SURVEY_READER_H

#include <string.h>

#include "survey_columns.h"
#include "survey_file.h"

struct survey_plot {
    struct csv_cell name, sites[SITES], year;
    size_t line;               /* of its first row */
    size_t returned;           /* line of a row after rows of other plots; 0: none */
    double values[STOOLS + 1]; /* AREA, RADIUS, SLOPE, STOOLS; NaN: not given */
    struct csv_place loose;    /* first row of a shoot without a stool */
    bool has_loose;
};

static inline bool ceduo_survey_is_same(struct csv_cell a, struct csv_cell b)
{
    return a.n == b.n && memcmp(a.p, b.p, a.n) == 0;
}

/* Shoot on a stool. The stools get numbers after all rows are read. */
struct survey_shoot {
    size_t plot, stem;
    struct csv_cell stool; /* empty: without a name */
};

/* Identifier of a stem. */
struct survey_id {
    size_t plot, line;
    int kind;
    struct csv_cell stool, id;
};

struct survey_reader {
    struct csv csv;
    struct arena *arena;
    struct problems *problems;
    struct survey_answers *answers; /* never NULL */
    size_t columns[COLUMNS];
    enum survey_unit units[COLUMNS]; /* of the heads */
    struct csv_cell fields[COLUMNS]; /* of the present row; n = 0: no value */

    struct survey_plot *plots;
    size_t plots_count, plot; /* plot of the row above */
    struct ceduo_survey_stem *stems;
    size_t stems_count, stems_capacity;
    struct survey_shoot *shoots;
    size_t shoots_count, shoots_capacity;
    struct survey_id *ids;
    size_t ids_count, ids_capacity;
    size_t stools_count;

    bool bare_slopes, marked_slopes; /* cells without and with a unit */
    size_t dead, cut;                /* stems that are left out */
    size_t unmarked;                 /* stems without a status, which count as live */
    size_t totals;                   /* rows */
    size_t filled;                   /* rows without a plot, which belong to the plot above */
    size_t repeated, repeated_line;  /* stems whose identifier occurs twice, and the line of the first */
    bool split;                      /* the same plot number occurs at several sites */
};

/* Check what only the whole table shows: plots at several sites, basal area, diameters and heights. Returns false if the survey is
 * refused, which is reported. */
bool ceduo_survey_check(struct survey_reader *r, const struct ceduo_survey *survey);

/* Describe in one line how the table was understood. `name`: of the file. */
const char *ceduo_survey_understand(const struct survey_reader *r, const struct ceduo_survey *survey, const char *name);

#endif
