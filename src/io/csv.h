/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CSV_H
#define CEDUO_CSV_H

#include "base/arena.h"
#include "base/text.h"
#include "problem.h"

/* Tables as offices write them: RFC 4180 and its variants in spreadsheets, GIS and forms. Cells are separated by ; tab , | or,
 * if the caller permits it, blanks. UTF-8, UTF-16 and Windows-1252 are recognized. A table is read completely or refused, with
 * line numbers. */

/* A cell of the present record. */
struct csv_cell {
    const char *p;     /* value, without quotes and blanks around it; valid as long as the arena */
    size_t n;          /* bytes */
    const char *begin; /* in the file */
    bool quoted;
    bool numeric; /* only heads: the column holds numbers */
};

/* Place of a record in the file. */
struct csv_place {
    size_t offset, line;
};

struct csv {
    struct source *source;
    struct arena *arena;
    struct problems *problems; /* NULL: report nothing */
    char separator;            /* ' ': blanks */
    bool blanks;               /* blanks may separate */
    bool comments;             /* skip records that begin with # or > */

    struct csv_place place, next; /* present record, next one */
    struct csv_cell *cells;       /* of the present record */
    size_t cells_count, cells_capacity;
    bool bad; /* the present record is broken or has the wrong number of cells; already reported */

    struct csv_place head_place;
    struct csv_cell *heads; /* a unit below a head is appended in brackets */
    size_t heads_count;
    bool headless;

    /* Properties of the whole table, set by ceduo_csv_scan(). */
    size_t width;         /* required number of cells of a record */
    size_t rows;          /* records below the head, without blank ones */
    size_t longer;        /* records with more cells than `width` */
    size_t longer_by_one; /* records with width + 1 cells */
    char decimal;         /* ',' or '.'; '\0': undecided */
    size_t decimal_line;  /* line that decided it */
    bool grouped;         /* at least one number has a thousands separator */
};

/* Read a file. Report an error and return false if it is unreadable, has a broken encoding or is not text. */
bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems);

#define CEDUO_CSV_NOT_FOUND SIZE_MAX
#define CEDUO_CSV_DUPLICATE (SIZE_MAX - 1)

enum csv_unit {
    CSV_UNIT_NONE,
    CSV_UNIT_USUAL, /* unit of the manual: cm, m2, degrees */
    CSV_UNIT_OTHER  /* mm, percent */
};

/* Names and units of a column. Names in `also` and units are separated by |. */
struct csv_head {
    const char *name;        /* preferred name; NULL: no column */
    const char *also;        /* other names, preferred first; NULL: none */
    const char *units;       /* NULL: ignore a unit in brackets */
    const char *other_units; /* units of another scale, contained in `units`; NULL: none */
    const char *unit;        /* for messages, marked for translation */
    double lo, hi;           /* range of its numbers, in the usual unit */
};

/* Return the column with a head; CEDUO_CSV_NOT_FOUND; CEDUO_CSV_DUPLICATE. Ignores case, blanks and punctuation. A unit may
 * follow the name, with or without brackets. Earlier names win. */
size_t ceduo_csv_column(const struct csv *csv, const struct csv_head *head, const char *units);

/* Find the head of a table: the line among the first 20, and the separator, with the most of n known heads. Read a row of units
 * below it. Set columns[i] for each head. Report duplicate columns. The file stays foreign unless a head is found. */
void ceduo_csv_find_head(struct csv *csv, const struct csv_head *heads, size_t n, size_t *columns);

/* Read the first line that is not blank as the head. Report bad bytes and an empty file. Return false if there is no head. */
bool ceduo_csv_read_head(struct csv *csv);

/* Begin a table without a head: its first row is the first record that is not blank. */
void ceduo_csv_begin_headless(struct csv *csv, char separator);

/* Mark a column, if it exists, as numeric. */
static inline void ceduo_csv_mark_numeric(struct csv *csv, size_t column)
{
    if (column < csv->heads_count)
        csv->heads[column].numeric = true;
}

/* Read the whole table once to find its width, its number of rows and the decimal sign of its numeric columns. Call it before
 * the first ceduo_csv_next_row(). */
void ceduo_csv_scan(struct csv *csv);

/* Read the next record that is not blank; false at the end. Report a broken record and mark it bad. */
bool ceduo_csv_next_row(struct csv *csv);

/* Read a record again. */
void ceduo_csv_reread(struct csv *csv, struct csv_place place);

/* Return a cell of the present record; an empty cell at its end if it has fewer. */
struct csv_cell ceduo_csv_next_cell(const struct csv *csv, size_t column);

/* True if a text is one of the words, separated by |. Ignores case, blanks and punctuation. */
bool ceduo_csv_matches(const char *p, size_t n, const char *words);

/* Compare two cells like memcmp(); 0: equal bytes. */
int ceduo_csv_compare(struct csv_cell a, struct csv_cell b);

/* True if a cell is a word. Ignores case. */
bool ceduo_csv_equals(struct csv_cell cell, const char *word);

/* True if a cell has no value: empty, -, ., NA, NaN, NULL, n.d., n.r., #N/A, #N/D. */
bool ceduo_csv_is_empty(struct csv_cell cell);

/* True if a cell contains a quote but does not begin with one. */
bool ceduo_csv_has_stray_quote(struct csv_cell cell);

/* Append the end of the line on how a table was read: decimal commas, `notes` and the heads of columns that are not used. */
void ceduo_csv_describe(const struct csv *csv, const size_t *used, size_t n, const char *notes, struct text *line);

/* Append name *n (from 0) to a list that shows ten, and increase *n. */
void ceduo_csv_append_name(struct text *names, size_t *n, const char *name, size_t length);
/* Append the number of names that the list does not show. `n`: of all names. */
void ceduo_csv_append_rest(struct text *names, size_t n);

/* Append all heads, separated by commas; only the beginning if the file is foreign. */
void ceduo_csv_append_heads(const struct csv *csv, struct text *names);

enum csv_numeral { CSV_NUMERAL_GOOD, CSV_NUMERAL_NONE, CSV_NUMERAL_TWO_WAYS, CSV_NUMERAL_TWO_NUMBERS, CSV_NUMERAL_OTHER_SIGN };

/* Write a number with a dot for decimals and without thousands separators to `to`. */
#define CSV_NUMERAL_CAPACITY 128
enum csv_numeral ceduo_csv_normalize_number(const struct csv *csv, struct csv_cell cell, char to[CSV_NUMERAL_CAPACITY]);

/* Remove one of `units` (may be NULL), separated by |, after the number in a cell. False if there is none. */
bool ceduo_csv_split_unit(struct csv_cell *cell, const char *units);

/* Set *value if a cell is a number; false if it is not. Reports nothing. */
bool ceduo_csv_value(const struct csv *csv, struct csv_cell cell, double *value);

/* Read a number from a cell, lo <= number <= hi, in `unit`, which may follow it. Report an error and return false otherwise. */
bool ceduo_csv_number(const struct csv *csv, struct csv_cell cell, double lo, double hi, const char *unit, double *value);

/* Set the decimal sign of the table if the present record has one. */
void ceduo_csv_note_decimal(struct csv *csv);

/* Report the reason why ceduo_csv_normalize_number() failed. Return false. */
bool ceduo_csv_report_number(const struct csv *csv, struct csv_cell cell, enum csv_numeral reason);

/* Report an error at a cell of the present record. Return false. */
bool ceduo_csv_error(const struct csv *csv, struct csv_cell cell, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Return the line of a cell of the present record. */
size_t ceduo_csv_line(const struct csv *csv, struct csv_cell cell);

/* ---- profiles (csv_slope.c) ---- */

/* Points of a profile in a file. */
struct points {
    double *x, *z; /* m */
    size_t n;
    const char *understood; /* one line for the user, in the arena; NULL: not from a table */
    const char *lines;      /* names of the lines if the file was refused because it has several; else NULL */
};

/* Read a profile: distance and elevation, x, y and elevation of a line on the map, WKT, or the output of GRASS or GMT. `layer`:
 * name of the line in a file with several; NULL: the only line. Report an error and return false if the file is refused. */
bool ceduo_csv_slope_read(struct arena *arena, const char *path, const char *layer, struct points *points,
                          struct problems *problems);

#endif
