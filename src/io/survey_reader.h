/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of a survey, and the state of its reader. */
#ifndef CEDUO_SURVEY_READER_H
#define CEDUO_SURVEY_READER_H

#include "csv.h"
#include "scene/choices.h"
#include "survey_file.h"

#define STEMS_MAX 200000

/* Columns of a plot, then of a stem, then numbers of stems, then names of sites. */
enum column {
    PLOT,
    AREA,
    RADIUS,
    SLOPE,
    STOOLS, /* number of stools on the plot */
    SPECIES,
    GENUS,
    KIND,
    STOOL,
    DBH,
    CIRCUMFERENCE,
    HEIGHT,
    SPACING,
    ENERGY,
    COUNT,
    SHOOTS,
    STANDARDS,
    TREES,
    STATUS,
    ID,
    YEAR, /* of the survey */
    SITE,
    SITE_LAST = SITE + 6,
    COLUMNS
};

#define SITES (SITE_LAST - SITE + 1)

/* Heads of each column. Manual and messages use `name`, which is marked for translation. */
extern const struct csv_head ceduo_survey_heads[COLUMNS];
#define HEAD(c) _(ceduo_survey_heads[c].name)

/* Kinds of stems, in the order of enum ceduo_survey_kind. */
extern const struct choices ceduo_survey_kind_words;

enum survey_status { SURVEY_LIVE, SURVEY_DEAD, SURVEY_CUT };
extern const struct choices ceduo_survey_status_words;

/* Find the head and the columns of a survey, and the units in the heads. Report missing columns, duplicate columns and wrong
 * units, and return false. */
bool ceduo_survey_find_columns(struct csv *csv, size_t columns[COLUMNS], enum csv_unit units[COLUMNS]);

/* True if the head of a column is ambiguous: h, d, n, alt. */
bool ceduo_survey_is_vague(const struct csv *csv, size_t column);

/* Return the value of a word in a cell; -1: unknown. */
int ceduo_survey_find_word(const struct choices *words, struct csv_cell cell);

/* Return the index of a species by its name, which may have an author or an abbreviated genus; -1: unknown. `genus` may be
 * empty. */
int ceduo_survey_find_species(struct csv_cell cell, struct csv_cell genus);

struct survey_plot {
    struct csv_cell name, sites[SITES], year;
    double number;             /* the name, as a whole number; NaN: another name */
    size_t line;               /* of its first row */
    size_t returned;           /* line of its first row after rows of other plots; 0: none */
    double values[STOOLS + 1]; /* AREA, RADIUS, SLOPE, STOOLS; NaN: not given */
    struct csv_place loose;    /* first row of a shoot without a stool */
    bool has_loose;
};

/* Shoot on a stool. Stools are numbered after all rows are read. */
struct survey_shoot {
    size_t plot, stem;
    struct csv_cell stool; /* empty: not given */
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
    enum csv_unit units[COLUMNS];    /* of the heads */
    struct csv_cell fields[COLUMNS]; /* of the current row; n = 0: no value */

    struct survey_plot *plots;
    size_t plots_count, plot; /* plot of the row above */
    struct ceduo_survey_stem *stems;
    size_t stems_count, stems_capacity;
    struct survey_shoot *shoots;
    size_t shoots_count, shoots_capacity;
    struct survey_id *ids;
    size_t ids_count, ids_capacity;
    size_t stools_count;

    bool bare_slopes, marked_slopes; /* some cells have no unit; some have one */
    size_t dead, cut;                /* stems left out */
    size_t unmarked;                 /* stems without a status, which count as live */
    size_t totals;                   /* rows */
    size_t filled;                   /* rows without a plot, which belong to the plot above */
    size_t repeated, repeated_line;  /* stems with a duplicate identifier; line of the first */
    bool split;                      /* some plot number occurs at several sites */
};

/* Return the area of a plot along the slope, m2; NaN: not given. */
double ceduo_survey_area(const struct survey_plot *plot);

/* Check the whole table: plots at several sites, basal area, diameters and heights. Report an error and return false if the
 * survey is refused. */
bool ceduo_survey_check(struct survey_reader *r, const struct ceduo_survey *survey);

/* Return one line on how the table was read. `name`: of the file. */
const char *ceduo_survey_describe(const struct survey_reader *r, const struct ceduo_survey *survey, const char *name);

#endif
