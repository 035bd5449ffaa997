/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FORM_H
#define CEDUO_FORM_H

#include "model/document.h"
#include "view/canvas.h"
#include "viewport.h"

/* A form: lines with fields of the document, rebuilt after each edit. Fields come from the schema. */

#define FORM_COLUMNS 8

struct form_cell {
    const char *path; /* path of the value, as in --set */
    const struct field *field;
    const char *text;    /* displayed value, see view/value_text.h */
    const char *written; /* scalar as in the file; "": none, or not a scalar */
    int columns;         /* columns that show it whole */
    bool given;          /* written in the scene, not a default */
    bool assumed;
};

enum form_kind { FORM_HEADING, FORM_COLUMNS_ROW, FORM_FIELDS, FORM_NOTE };

struct form_row {
    enum form_kind kind;
    const char *label;
    size_t n;
    struct form_cell cells[FORM_COLUMNS]; /* a table head has fields only */
    const char *list;                     /* list of the row's item; "": none */
    const int *columns;                   /* columns of a table's cells, then of its heads; NULL: all equal */
    const char *group;                    /* the only group of that item in this row; NULL: the whole item */
    size_t index;
};

struct form {
    const struct document *document;
    struct arena arena; /* strings; freed when the form is rebuilt */
    struct form_row *rows;
    size_t n, capacity;
    size_t row, column; /* the cursor */
    struct viewport lines;
    struct ceduo_area area; /* position on the screen */
};

void ceduo_form_clear(struct form *form, const struct document *document); /* the cursor stays */

void ceduo_form_heading(struct form *form, const char *text);
void ceduo_form_note(struct form *form, const char *text);

/* Add a line with the value at a path; label NULL: from the schema. Add a line for each key of a list separated by blanks,
 * after a prefix that is "" or ends in a dot. Add lines for the other fields of a group (growth.shoots). */
void ceduo_form_field(struct form *form, const char *path, const char *label);
void ceduo_form_fields(struct form *form, const char *prefix, const char *keys);
void ceduo_form_rest(struct form *form, const char *group);

/* Add a table of list items: column heads, then a line for each item. Keys are separated by blanks. With a group, show only
 * items that have it, with its keys. An empty list has one line of help. Add a line for each point of a list. */
void ceduo_form_table(struct form *form, const char *list, const char *group, const char *keys);
void ceduo_form_points(struct form *form, const char *list);

/* Move the cursor to a line with fields: the nearest; by lines and columns; to the next cell with a word in its
 * text, label, heading or column head, or else in its path (false: none); to item `index` of a list, or the last before it. */
void ceduo_form_clamp(struct form *form);
void ceduo_form_move(struct form *form, int lines, int columns);
bool ceduo_form_search(struct form *form, const char *word);
void ceduo_form_go_to_item(struct form *form, const char *list, size_t index);

/* Return the cell or the line under the cursor; NULL: none. */
struct form_cell *ceduo_form_cell(struct form *form);
struct form_row *ceduo_form_row(struct form *form);

/* Scroll to the cursor, for an area. */
void ceduo_form_scroll(struct form *form, struct ceduo_area area);

/* Draw the lines. Requires ceduo_form_scroll() for this area. `edit`: text shown in the cell under the cursor; may be NULL. */
void ceduo_form_draw(struct form *form, struct ceduo_cells *cells, struct ceduo_area area, const char *edit);

/* Move the cursor to the cell in a column of line `row`. Find the area of the cell under the cursor; false: not shown. */
void ceduo_form_click(struct form *form, int x, int row);
bool ceduo_form_find_cell(struct form *form, struct ceduo_area *area);

/* Explain the cell under the cursor: meaning, unit, range, default, source. */
void ceduo_form_explain(struct form *form, struct text *text);

/* Append its value one step up (1) or down (-1), as typed. Return false if the field has no steps. */
bool ceduo_form_step(struct form *form, int direction, struct text *value);

#endif
