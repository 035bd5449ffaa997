/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_COLUMNS_H
#define CEDUO_COLUMNS_H

#include "each.h"

/* A cell of a line of CSV, with its quotes. */
struct csv_span {
    const char *p;
    size_t n;
};

/* Columns of CSV: the copied cells of --each, then the cells of the result. --columns chooses among both. */
struct columns {
    struct each *each;
    size_t count;   /* copied columns and those of the result */
    size_t *chosen; /* numbers of columns; NULL: all */
    size_t chosen_count;
    struct csv_span *cells; /* of the present line */
};

/* Choose the columns. `header`: head of the result, empty if the output is not CSV. Sets the printed names of the copied columns: row.
 * precedes a name that the result has, too. Returns EXIT_USAGE if --columns names an unknown one, which is reported. */
enum exit_status ceduo_columns_open(struct columns *columns, struct each *each, const struct text *header);

/* Append the head of the output. */
void ceduo_columns_head(const struct columns *columns, const struct text *header, struct text *out);

/* Append lines of the result with the copied cells of the present row. */
void ceduo_columns_lines(const struct columns *columns, const struct text *lines, struct text *out);

#endif
