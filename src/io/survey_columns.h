/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of a survey and the words of its cells. */
#ifndef CEDUO_SURVEY_COLUMNS_H
#define CEDUO_SURVEY_COLUMNS_H

#include "csv.h"
#include "scene/choices.h"

/* Columns of a plot, then of a stem, then numbers of stems, then names of places that hold plots. */
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

enum survey_unit {
    SURVEY_UNIT_NONE,
    SURVEY_UNIT_USUAL, /* the unit in the name of the manual: cm, m2, degrees */
    SURVEY_UNIT_OTHER  /* mm, percent */
};

/* Heads of each column. The first name is the name in the manual and in messages, marked for translation. */
extern const struct csv_head ceduo_survey_heads[COLUMNS];

/* Kinds of stems, in the order of enum ceduo_survey_kind. */
extern const struct choices ceduo_survey_kind_words;

enum survey_status { SURVEY_LIVE, SURVEY_DEAD, SURVEY_CUT };
extern const struct choices ceduo_survey_status_words;

/* Find the head and the columns of a survey, and the units that the heads name. Report columns that are missing, that occur twice,
 * or that have another unit, and return false. */
bool ceduo_survey_find_columns(struct csv *csv, size_t columns[COLUMNS], enum survey_unit units[COLUMNS]);

/* Remove the unit that follows the number in a cell, and return it. */
enum survey_unit ceduo_survey_split_unit(enum column column, struct csv_cell *cell);

/* True if the head of a column can have several meanings: h, d, n, alt. */
bool ceduo_survey_is_vague(const struct csv *csv, size_t column);

/* Value of a word in a cell; -1: unknown. */
int ceduo_survey_find_word(const struct choices *words, struct csv_cell cell);

/* Index of a species by its name, which may have an author or an abbreviated genus; -1: unknown. `genus` may be empty. */
int ceduo_survey_find_species(struct csv_cell cell, struct csv_cell genus);

/* True if a cell stands for species without a name: other, altre latifoglie. */
bool ceduo_survey_is_other_species(struct csv_cell cell);

/* True if a cell is the label of a row of totals or means. */
bool ceduo_survey_is_total(struct csv_cell cell);

#endif
