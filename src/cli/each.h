/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EACH_H
#define CEDUO_EACH_H

#include "arguments.h"
#include "base/arena.h"
#include "base/json.h"
#include "io/csv.h"
#include "io/scene_file.h"
#include "scene/schema.h"
#include "view/figures.h"

/* A column of --each. */
struct each_head {
    const char *name;     /* "": the column is ignored */
    enum path_value sets; /* kind of the value that it sets; PATH_UNKNOWN: copied */
};

#define NO_COLUMN SIZE_MAX

/* Decide for each head of the table if its column is set or copied. Report duplicate heads and heads that look like a wrong
 * path, and return false. */
bool ceduo_each_heads(const struct csv *table, struct arena *arena, struct each_head *heads);

struct each_row {
    struct csv_place place;
    bool bad;       /* it cannot be read */
    size_t repeats; /* line of an earlier row with the same key; 0: none */
};

/* The scenes to compute: all on the command line; with --each, once for each row of a table. */
struct each {
    const struct arguments *given;
    struct arguments arguments; /* of the present scene, with the changes of its row */
    const char *path;           /* of the present scene */
    const char *name;           /* of the present scene in messages: its path, "slopes.csv:17" or "slopes.csv:17 (key)" */
    size_t current, count;      /* number of the present scene, from 1; of all scenes */
    struct arena arena, row_arena;
    struct csv table;
    size_t heads_count, rows_count;
    struct each_head *heads;
    struct each_row *rows;      /* NULL: no --each */
    size_t key;                 /* column that names a row; NO_COLUMN: none */
    size_t wkt, x, y;           /* columns of the geometry, if --format geojson needs it; NO_COLUMN: none */
    const char **cells;         /* cells of the current row, one for each head */
    const struct each_row *row; /* current row; NULL: no --each */
    bool names_files;           /* cells may name files that the scene reads */
    bool bad_rows;              /* at least one row cannot be read */
    struct text failed;         /* names of the scenes that failed */
    size_t failures;
};

/* Read the table if there is one. Report an error and return its status if nothing can be computed. */
enum exit_status ceduo_each_open(struct each *each, const struct arguments *arguments);

/* Go to the next scene; false after the last. */
bool ceduo_each_next(struct each *each);

/* True if a column is copied to the output: its head is no path, or it is the key. */
bool ceduo_each_is_copied(const struct each *each, size_t column);

/* True if a column is printed unless --columns chooses: it is copied, and with --key it is the key. */
bool ceduo_each_is_shown(const struct each *each, size_t column);

/* Append the first error of the current row in English if the row is bad. */
void ceduo_each_reason(struct each *each, struct text *reason);

/* Count the current scene as failed. */
void ceduo_each_note_failed(struct each *each);

/* Append the object "row" with the copied cells. A cell becomes a number only if that prints as the text of the cell. */
void ceduo_each_json(const struct each *each, struct json *json);

void ceduo_each_json_cell(struct json *json, const char *name, const char *cell);

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

struct chosen_column {
    size_t column;
    const char *name; /* head in the output */
};

/* Columns of a table: the copied cells of --each, the state of the row, then the cells of the result. --columns chooses among
 * them. */
struct columns {
    struct each *each;
    size_t count, copied_count, result_begin;
    const char **names; /* name of each column */
    bool *texts;        /* the column holds text */
    size_t *copied;     /* column of the table of each copied column */
    size_t capacity, texts_capacity;
    size_t chosen_count;
    struct chosen_column *chosen;
    bool run_wanted;        /* the column `run` is chosen */
    struct csv_span *cells; /* cells of the current line */
    struct text failed;     /* line of the result of a row that failed */
};

/* Choose the columns. `figures`: columns of the result; NULL: the output is no table. A copied column has the prefix row. if
 * the result has such a name, too. Report an unknown name in --columns and return EXIT_USAGE. */
enum exit_status ceduo_columns_open(struct columns *columns, struct each *each, const struct ceduo_figure *figures);
void ceduo_columns_close(struct columns *columns);

/* Append the head of the output. */
void ceduo_columns_head(const struct columns *columns, struct text *out);

/* Set columns->cells to those of each line of the result, with the cells of the current row, and call `visit`. A row that
 * failed has one line. */
void ceduo_columns_visit(struct columns *columns, const struct text *lines, const struct ceduo_row_state *state,
                         void (*visit)(const struct columns *columns, void *context), void *context);

/* Append the chosen cells as a line of CSV to `out`, a struct text. */
void ceduo_columns_print(const struct columns *columns, void *out);

/* ---- geojson.c ---- */

/* Find the columns of the geometry. Report that there are none, and return false. */
bool ceduo_geometry_find(struct each *each);

/* Append the geometry of the present record. False if it has none. */
bool ceduo_geometry_print(const struct each *each, struct text *out);

/* As ceduo_geometry_print(), but report an error. */
bool ceduo_geometry_check(const struct each *each);

/* Append the chosen cells as a feature, followed by a comma and a line end, to `out`, a struct text. */
void ceduo_geojson_print(const struct columns *columns, void *out);

#endif
