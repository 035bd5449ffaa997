/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CSV_H
#define CEDUO_CSV_H

#include "base/arena.h"
#include "base/text.h"
#include "problem.h"

/* Tables as offices write them: RFC 4180, and what spreadsheets, GIS and forms make of it. Cells are separated by ; tab , | or,
 * if the caller permits it, blanks. Text is UTF-8, or UTF-16 or Windows-1252, which are recognized. A table is read right or
 * refused by line. */

/* A cell of the present record. */
struct csv_cell {
    const char *p;  /* value without quotes and without blanks around it; valid as long as the arena */
    size_t n;       /* bytes */
    const char *at; /* first byte in the file */
    bool quoted;
    bool numeric; /* of a head: its column holds numbers */
};

/* A record as a place to return to. */
struct csv_place {
    size_t at, line;
};

struct csv {
    struct source *source;
    struct arena *arena;
    struct problems *problems; /* NULL: nothing is reported */
    char separator;            /* ' ': blanks */
    bool blanks;               /* blanks may separate */
    bool comments;             /* records that begin with # or > are skipped */

    struct csv_place place, next; /* present record, next one */
    struct csv_cell *cells;       /* of the present record */
    size_t cells_count, cells_capacity;
    bool bad; /* the present record is broken or has the wrong number of cells, which is reported */

    struct csv_place head_place;
    struct csv_cell *heads; /* with the unit below a head in brackets after it */
    size_t heads_count;
    bool headless;

    /* Properties of the whole table: ceduo_csv_scan(). */
    size_t width;  /* cells that a record must have */
    size_t rows;   /* records below the head that are not blank */
    size_t longer; /* records with more cells than `width` */
    size_t longer_by_one;
    char decimal;        /* ',' or '.'; '\0': no number shows it */
    size_t decimal_line; /* that shows it */
    bool grouped;        /* at least one number has a decimal sign and a thousands separator */
};

/* Read a file. Report an error and return false if it cannot be read, if its encoding is broken, or if it is no text. */
bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems);

#define CEDUO_CSV_NOT_FOUND SIZE_MAX
#define CEDUO_CSV_DUPLICATE (SIZE_MAX - 1)

enum csv_unit {
    CSV_UNIT_NONE,
    CSV_UNIT_USUAL, /* the unit in the name of the manual: cm, m2, degrees */
    CSV_UNIT_OTHER  /* mm, percent */
};

/* Names and units of a column. Those of `also` and the units are separated by |. */
struct csv_head {
    const char *name;  /* the best; NULL: no column is meant */
    const char *also;  /* other names, the best first; NULL: none */
    const char *units; /* NULL: any unit in brackets is ignored */
    const char *other; /* among them: those of another scale; NULL: none */
    const char *unit;  /* for messages; its translation is marked */
    double lo, hi;     /* range of its numbers, in the usual unit */
};

/* Column with one of n known heads; CEDUO_CSV_NOT_FOUND; CEDUO_CSV_DUPLICATE. Case, blanks and punctuation do not matter. A unit may
 * follow the name, in brackets or without. Earlier names win. */
size_t ceduo_csv_column(const struct csv *csv, const struct csv_head *head, const char *units);

/* Find the head of a table: the line among the first 20, and the separator, with most of n known heads. Reads a row of units
 * below it. Sets columns[i] for each head. Reports columns that occur twice. The file is foreign until a head is known. */
void ceduo_csv_find_head(struct csv *csv, const struct csv_head *heads, size_t n, size_t *columns);

/* Take the first line that is not blank as the head. Reports an empty file and returns false. */
bool ceduo_csv_read_head(struct csv *csv);

/* Take a table without a head: the first record that is not blank is its first row. */
void ceduo_csv_begin_headless(struct csv *csv, char separator);

/* Mark a column as one of numbers, if there is such a column. */
static inline void ceduo_csv_mark_numeric(struct csv *csv, size_t column)
{
    if (column < csv->heads_count)
        csv->heads[column].numeric = true;
}

/* Read the whole table once: number of cells a record has, rows, decimal sign of the columns that are marked as numeric. Call it
 * before the first ceduo_csv_next_row(). */
void ceduo_csv_scan(struct csv *csv);

/* Read the next record that is not blank; false at the end. A broken record is reported and marked bad. */
bool ceduo_csv_next_row(struct csv *csv);

/* Read a record again. */
void ceduo_csv_reread(struct csv *csv, struct csv_place place);

/* Cell of the present record; an empty cell at its end if it has fewer. */
struct csv_cell ceduo_csv_cell(const struct csv *csv, size_t column);

/* True if a text is one of the words, separated by |. Case, blanks and punctuation do not matter. */
bool ceduo_csv_matches(const char *p, size_t n, const char *words);

/* Order of two cells as of memcmp(); 0: they have the same bytes. */
int ceduo_csv_compare(struct csv_cell a, struct csv_cell b);

/* True if a cell is a word; case does not matter. */
bool ceduo_csv_equals(struct csv_cell cell, const char *word);

/* True if a cell has no value: empty, -, ., NA, NaN, NULL, n.d., n.r., #N/A, #N/D. */
bool ceduo_csv_is_empty(struct csv_cell cell);

/* True if a quote stands within a cell that is not in quotes itself. */
bool ceduo_csv_has_stray_quote(struct csv_cell cell);

/* Append the end of the line that says how a table was read: decimal commas, `notes`, and the heads that are not among the n columns
 * used. */
void ceduo_csv_describe(const struct csv *csv, const size_t *used, size_t n, const char *notes, struct text *line);

/* Append name number *n, from 0, of a list that shows ten, and count it. */
void ceduo_csv_append_name(struct text *names, size_t *n, const char *name, size_t length);
/* Append how many of n names the list does not show. */
void ceduo_csv_append_rest(struct text *names, size_t n);

/* Append all heads, separated by commas; of a foreign file the beginning only. */
void ceduo_csv_append_heads(const struct csv *csv, struct text *names);

enum csv_numeral { CSV_NUMERAL_GOOD, CSV_NUMERAL_NONE, CSV_NUMERAL_TWO_WAYS, CSV_NUMERAL_TWO_NUMBERS, CSV_NUMERAL_OTHER_SIGN };

/* Write a number with a dot for decimals and without thousands separators to `to`. */
#define CSV_NUMERAL_CAPACITY 128
enum csv_numeral ceduo_csv_normalize_number(const struct csv *csv, struct csv_cell cell, char to[CSV_NUMERAL_CAPACITY]);

/* Remove the unit that follows the number in a cell, one of `units` (may be NULL), separated by |. False if there is none. */
bool ceduo_csv_split_unit(struct csv_cell *cell, const char *units);

/* Set *value if a cell is a number; false if it is not. Reports nothing. */
bool ceduo_csv_value(const struct csv *csv, struct csv_cell cell, double *value);

/* Number in a cell, lo <= number <= hi, in `unit`, which may follow it. Reports an error and returns false otherwise. */
bool ceduo_csv_number(const struct csv *csv, struct csv_cell cell, double lo, double hi, const char *unit, double *value);

/* Note the decimal sign of the present record, if it shows one. */
void ceduo_csv_note_decimal(struct csv *csv);

/* Report why a cell is not the number that ceduo_csv_normalize_number() looks for; returns false. */
bool ceduo_csv_report_number(const struct csv *csv, struct csv_cell cell, enum csv_numeral why);

/* Report a problem at a cell of the present record; returns false. */
bool ceduo_csv_error(const struct csv *csv, struct csv_cell cell, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Line of a cell of the present record. */
size_t ceduo_csv_line(const struct csv *csv, struct csv_cell cell);

/* ---- profiles (csv_slope.c) ---- */

/* A profile as its file gives it. */
struct points {
    double *x, *z; /* m */
    size_t n;
    const char *understood; /* one line for the user, in the arena; NULL: from no table */
    const char *lines;      /* names of the lines, if the file is refused because it holds several; else NULL */
};

/* Read a profile: distance and elevation, x, y and elevation of a line on the map, WKT, or the output of GRASS or GMT.
 * `layer`: which line of a file that holds several; NULL: the only one. Returns false if the file is refused, which is
 * reported. */
bool ceduo_csv_slope_read(struct arena *arena, const char *path, const char *layer, struct points *points,
                          struct problems *problems);

#endif
