/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CSV_H
#define CEDUO_CSV_H

#include "base/arena.h"
#include "base/text.h"
#include "problem.h"

/* Tables as people export them: a header that names the columns, then rows; separated by semicolon, tab or comma, what
 * is in double quotes whole. Where commas do not separate, they may stand for the decimals. In UTF-8, or UTF-16 or Windows-1252,
 * which are recognised. */

/* A part of a line. */
struct csv_span {
    const char *p;
    size_t n;
};

struct csv {
    struct source *source;
    struct problems *problems; /* where what is wrong is reported */
    size_t at, number;         /* bytes read; number of the present line, from 1 */
    struct csv_span line;      /* the present line */
    struct csv_span header;
    size_t header_number;
    char separator;
    char decimal; /* ',' or '.', once a number has shown it; '\0' before */
};

/* Reads a file and its header. False where that fails, which is told. The file is foreign until a column is known. */
bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems);

#define CEDUO_CSV_NONE  SIZE_MAX
#define CEDUO_CSV_TWICE (SIZE_MAX - 1)

/* What a column may be called, best first and ended by NULL, and the units in which its values may be, with | between them. */
struct csv_head {
    const char *names[12];
    const char *units; /* NULL: whatever stands in brackets is none */
};

/* The column of the first of some names, ended by NULL, that the header has; case, blanks, hyphens and the like do not matter, and
 * a unit, one of `units`, may stand behind it or in brackets. CEDUO_CSV_NONE: it has none; CEDUO_CSV_TWICE: it has that name twice. */
size_t ceduo_csv_column(const struct csv *csv, const char *const *names, const char *units);

/* The columns of a table whose header may stand below a title: goes to the line that has most of them. One that is there twice
 * is reported. */
void ceduo_csv_find(struct csv *csv, const struct csv_head *heads, size_t n, size_t *columns);

/* How many columns the header has, and the names of all, with a comma between them; of a foreign file the beginning of that. */
size_t ceduo_csv_columns(const struct csv *csv, struct text *names);

/* The next row that is not blank; false at the end. */
bool ceduo_csv_next(struct csv *csv);

/* How many lines the file has at the most. */
size_t ceduo_csv_lines(const struct csv *csv);

/* The first field of what is left of a line, as it stands there, which it takes off; false where nothing is left. A line without
 * a byte has one field. */
bool ceduo_csv_cell(struct csv_span *left, char separator, struct csv_span *field);

/* The same of a row or of the header, without blanks and quotes around it. */
bool ceduo_csv_step(const struct csv *csv, struct csv_span *left, struct csv_span *field);

/* A field of the present row, without blanks and quotes around it; false where the row has fewer. */
bool ceduo_csv_field(const struct csv *csv, size_t column, struct csv_span *field);

bool ceduo_csv_is(struct csv_span field, const char *word);

/* The number in a field of the present row, no smaller than lo and no larger than hi; of `unit` in messages. What is wrong
 * with it is told. */
bool ceduo_csv_number(struct csv *csv, struct csv_span field, double lo, double hi, const char *unit, double *value);

/* Reports a problem with a field of the present row; false. */
bool ceduo_csv_complain(const struct csv *csv, struct csv_span field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* ---- profiles (csv_slope.c) ---- */

/* A profile as its files give it. */
struct points {
    double *x, *z;
    size_t n;
    bool commas; /* for the decimals, as spreadsheets write them in Italian or German */
};

/* A profile from a CSV file as QGIS writes it: a header with the columns distance and elevation (x and z will do),
 * separated by comma, semicolon or tab. Where they are not separated by commas, commas may stand for the decimals. With x, y and
 * elevation it is a line on the map, and distances are along it.
 * False where that fails, which is reported. */
bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems);

#endif
