/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EACH_H
#define CEDUO_EACH_H

#include "arguments.h"
#include "io/csv.h"

/* What is computed one after the other: every scene of the command line, with --each once for each row of a table. A column whose
 * head is a path of --set changes the scene; all others are copied in front of what is printed, and say which row it is. */
struct each {
    struct arguments arguments; /* of the present scene: with the changes of its row */
    const char *path;           /* the present scene */
    const char *name;           /* as messages call it: its path, or "slopes.csv:17" */
    size_t at, count;           /* the present one, from 1; of how many */
    const struct arguments *given;
    struct arena arena;
    struct csv table; /* of --each */
    size_t heads_count, rows_count, columns_count;
    struct each_head *heads;
    struct each_row *rows; /* NULL: no --each */
    size_t *columns;       /* of --columns: numbers of cells, the copied ones first; NULL: all */
    bool resumed;          /* the head of the output stands there already */
    struct text failed;    /* names of those that failed */
    size_t failures;
    bool bad_rows; /* at least one row cannot be read */
};

/* Reads the table, and with --resume what stands in the output already. `header`: of the output in CSV; else empty. Another status
 * than EXIT_DONE where nothing can be computed; the reason has been told. */
enum exit_status ceduo_each_open(struct each *each, const struct arguments *arguments, const struct text *header);

/* Goes to the next scene that is to be computed; false after the last. What is wrong with a row is told, and the row is left out. */
bool ceduo_each_next(struct each *each);

/* Adds the line of heads of CSV, unless it stands in the output already; what is printed of the present scene. */
void ceduo_each_header(const struct each *each, const struct text *header, struct text *out);
void ceduo_each_add(const struct each *each, const struct text *answer, struct text *out);

/* Notes that the present scene has failed. */
void ceduo_each_fail(struct each *each);

/* Says how many of several failed, and which. */
void ceduo_each_close(struct each *each);

#endif
