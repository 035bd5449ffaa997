/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EACH_H
#define CEDUO_EACH_H

#include "arguments.h"
#include "base/arena.h"
#include "base/json.h"
#include "io/csv.h"
#include "io/scene_file.h"
#include "scene/schema.h"

/* A column of --each. */
struct each_head {
    const char *name;     /* "": the column is ignored */
    const char *printed;  /* name of a copied column in CSV */
    enum path_value sets; /* kind of the value that it sets; PATH_UNKNOWN: copied */
};

static inline bool ceduo_each_is_copied(const struct each_head *head)
{
    return head->sets == PATH_UNKNOWN && head->name[0];
}

/* Decide for each head of the table if its column is set or copied. Report duplicate heads and heads that look like a wrong path, and
 * return false. */
bool ceduo_each_heads(const struct csv *table, struct arena *arena, struct each_head *heads);

struct each_row {
    struct csv_place place;
    bool bad;
};

/* The scenes to compute: all on the command line; with --each, once for each row of a table. */
struct each {
    const struct arguments *given;
    struct arguments arguments; /* of the present scene, with the changes of its row */
    const char *path;           /* of the present scene */
    const char *name;           /* of the present scene in messages: its path, or "slopes.csv:17" */
    size_t current, count;      /* number of the present scene, from 1; of all scenes */
    struct arena arena, row_arena;
    struct csv table;
    size_t heads_count, rows_count;
    struct each_head *heads;
    struct each_row *rows; /* NULL: no --each */
    const char **cells;    /* of the current row, one for each head */
    bool names_files;      /* cells may name files that the scene reads */
    bool bad_rows;         /* at least one row cannot be read */
    struct text failed;    /* names of the scenes that failed */
    size_t failures;
};

/* Read the table if there is one. Report an error and return its status if nothing can be computed. */
enum exit_status ceduo_each_open(struct each *each, const struct arguments *arguments);

/* Go to the next scene; false after the last. Skips scenes of bad rows and counts them as failed. */
bool ceduo_each_next(struct each *each);

/* Count the current scene as failed. */
void ceduo_each_note_failed(struct each *each);

/* Append the object "row" with the copied cells. A cell becomes a number only if that prints as the text of the cell. */
void ceduo_each_json(const struct each *each, struct json *json);

/* Append a line with the name of the current row, before its page. */
void ceduo_each_page(const struct each *each, struct text *page);

/* Return the hash of the path of the current scene and the cells of its row. */
uint64_t ceduo_each_hash(const struct each *each);

/* Report the failed scenes and their number, and free all. */
void ceduo_each_close(struct each *each);

/* ---- columns.c ---- */

/* A cell of a line of CSV, with its quotes. */
struct csv_span {
    const char *p;
    size_t n;
};

/* Columns of CSV: the copied cells of --each, then the cells of the result. --columns chooses among both. */
struct columns {
    struct each *each;
    size_t count;   /* of copied columns and columns of the result */
    size_t *chosen; /* indices of columns; NULL: all */
    size_t chosen_count;
    struct csv_span *cells; /* of the current line */
};

/* Choose the columns. `header`: head of the result; empty if the output is not CSV. Sets the printed names of copied columns, with
 * the prefix row. if the result has such a name, too. Report an unknown name in --columns and return EXIT_USAGE. */
enum exit_status ceduo_columns_open(struct columns *columns, struct each *each, const struct text *header);

/* Append the head of the output. */
void ceduo_columns_head(const struct columns *columns, const struct text *header, struct text *out);

/* Append lines of the result, with the copied cells of the current row. */
void ceduo_columns_lines(const struct columns *columns, const struct text *lines, struct text *out);

#endif
