/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PICKER_H
#define CEDUO_PICKER_H

#include "base/arena.h"
#include "view/canvas.h"
#include "viewport.h"

/* An input line: a value, a file name, a search text. */
struct line {
    char text[1024];
    size_t cursor;  /* cursor, as a byte offset */
    bool unedited;  /* unedited: the first character replaces the text */
    bool confirmed; /* the user was asked: the next Enter confirms */
};

void ceduo_line_set(struct line *line, const char *text);
bool ceduo_line_handle_key(struct line *line, int key); /* return false if the key has no meaning here */

/* Insert pasted text. Line ends and tabs become one blank, control characters are dropped. False: it does not fit. */
bool ceduo_line_paste(struct line *line, const char *text);

/* ---- the list ---- */

/* A list to choose from. Typing filters the items, best match first. */

struct picker_item {
    const char *text, *value;
    const char *name; /* the searchable part of the text */
    bool is_current;  /* current value of the field */
    int match;
};

struct picker {
    struct arena arena;
    struct picker_item *items;
    size_t count, capacity;
    size_t *order; /* indices of matching items, best first, after ceduo_picker_filter() */
    size_t matches, order_capacity;
    struct viewport lines; /* viewport of the matching items */
};

void ceduo_picker_clear(struct picker *picker);

/* Add an item; unsafe bytes are shown as \xHH. Only `name` is searched. `is_current`: move the cursor to it. */
void ceduo_picker_add(struct picker *picker, const char *text, const char *name, const char *value, bool is_current);
bool ceduo_picker_has(const struct picker *picker, const char *value);

/* Keep the matching items; "": all, with the cursor on the current value. Move the cursor to a value if it is listed. */
void ceduo_picker_filter(struct picker *picker, const char *typed);
void ceduo_picker_go_to(struct picker *picker, const char *value);

/* Return the item under the cursor; NULL: no match. */
const struct picker_item *ceduo_picker_selected(const struct picker *picker);
void ceduo_picker_draw(struct picker *picker, struct ceduo_cells *cells, struct ceduo_area area);

/* ---- files ---- */

/* Add completions of a typed path: files with the first of the endings (".csv .txt"), with the others, then folders. */
void ceduo_picker_add_files(struct picker *picker, const char *typed, const char *endings);

/* True if a name has one of the endings, in lower or upper case. */
bool ceduo_picker_is_file(const char *name, const char *endings);

/* Complete a typed path up to the first ambiguity. Return false if nothing was added. */
bool ceduo_picker_complete(const struct picker *picker, struct line *line);

#endif
