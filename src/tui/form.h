/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FORM_H
#define CEDUO_FORM_H

#include "model/document.h"
#include "view/canvas.h"
#include "viewport.h"

/* A form: lines of fields of the document, made anew after each edit. Fields come from the table of parameters. */

#define FORM_COLUMNS 8

struct form_cell {
    const char *path; /* of the value, as in --set */
    const struct field *field;
    const char *text;    /* as it is shown, see view/typed.h */
    const char *written; /* a single word or number, as in the file; "": nothing, or more than that */
    bool given;          /* written in the scene, not a default */
    bool assumed;
};

enum form_kind { FORM_HEADING, FORM_COLUMNS_ROW, FORM_FIELDS, FORM_NOTE };

struct form_row {
    enum form_kind kind;
    const char *label;
    size_t n;
    struct form_cell cells[FORM_COLUMNS]; /* of the head of a table: the fields alone */
    const char *list;                     /* the list that the row is an item of; "": none */
    const char *group;                    /* of that item, which the row shows alone; NULL: the whole item */
    size_t index;
};

struct form {
    const struct document *document;
    struct arena arena; /* of its strings, which live until it is made anew */
    struct form_row *rows;
    size_t n, room;
    size_t row, column; /* the cursor */
    struct viewport lines;
    struct ceduo_area area; /* where it was drawn, for the mouse */
};

void ceduo_form_clear(struct form *form, const struct document *document); /* the cursor stays */

void ceduo_form_heading(struct form *form, const char *text);
void ceduo_form_note(struct form *form, const char *text);

/* Add a line with the value at a path; label NULL: that of the table of keys. Or a line for each of some keys, with blanks between,
 * after a prefix that ends in a dot or is "". Or for each field of a group (such as growth.shoots) that has none yet. */
void ceduo_form_field(struct form *form, const char *path, const char *label);
void ceduo_form_fields(struct form *form, const char *prefix, const char *keys);
void ceduo_form_rest(struct form *form, const char *group);

/* Add a table of the items of a list: column names, then a line for each item; keys with blanks between. With a group: only items
 * that have it; the keys are its own. An empty list has a line that explains how to add to it. Or a line for each point of a list. */
void ceduo_form_table(struct form *form, const char *list, const char *group, const char *keys);
void ceduo_form_points(struct form *form, const char *list);

/* Move the cursor, always to a line with fields: to the nearest; by lines and columns; to the next line whose name, or a cell whose
 * text or path holds a word, false if there is none; to item `index` of a list, or the last before it. */
void ceduo_form_clamp(struct form *form);
void ceduo_form_move(struct form *form, int lines, int columns);
bool ceduo_form_search(struct form *form, const char *word);
void ceduo_form_go(struct form *form, const char *list, size_t index);

/* The cell and the line under the cursor; NULL: none. */
struct form_cell *ceduo_form_cell(struct form *form);
struct form_row *ceduo_form_row(struct form *form);

/* Draw the lines, scrolled to the cursor. `edit`: text in the cell under the cursor instead of its own; may be NULL. */
void ceduo_form_draw(struct form *form, struct ceduo_cells *cells, struct ceduo_area area, const char *edit);

/* Move the cursor to the cell at a place of the screen; false if there is none. */
bool ceduo_form_click(struct form *form, int x, int y);

/* Explain the cell under the cursor: meaning, unit, range, default, source. */
void ceduo_form_explain(struct form *form, struct text *text);

/* Append its value one step up (+1) or down (-1), as it would be typed; false if the field has no steps. */
bool ceduo_form_step(struct form *form, int direction, struct text *value);

#endif
