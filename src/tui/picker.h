/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PICKER_H
#define CEDUO_PICKER_H

#include "base/arena.h"
#include "view/canvas.h"
#include "viewport.h"

/* A line that is typed: a value, a file name, something to search. */
struct line {
    char text[1024];
    size_t at;  /* byte of the cursor */
    bool fresh; /* nothing typed yet: the first character replaces it all */
    bool asked; /* it was asked whether this is meant */
};

void ceduo_line_set(struct line *line, const char *text);
bool ceduo_line_key(struct line *line, int key); /* false: the key means nothing to it */

/* Type a pasted text, line ends and tabs as one blank, no control characters. False: it does not fit, the line stays. */
bool ceduo_line_paste(struct line *line, const char *text);

/* ---- the list ---- */

/* A list to choose from: typing leaves the items that match, the best first. */

struct pick {
    const char *text, *value;
    const char *name; /* the part of the text that what is typed is held against */
    bool now;         /* what is there at present */
    int match;
};

struct picker {
    struct arena arena;
    struct pick *picks;
    size_t count, room;
    size_t *order; /* those that match, best first, after ceduo_picker_filter() */
    size_t matches, order_room;
    struct viewport lines; /* of those that match */
};

void ceduo_picker_clear(struct picker *picker);

/* Add an item; unsafe bytes are shown as \xHH. What is typed is searched for in `name` alone. `now`: the cursor goes there. */
void ceduo_picker_add(struct picker *picker, const char *text, const char *name, const char *value, bool now);
bool ceduo_picker_has(const struct picker *picker, const char *value);

/* Keep those that match; "": all, with the cursor on what is there at present. Or put the cursor on a value, if it is there. */
void ceduo_picker_filter(struct picker *picker, const char *typed);
void ceduo_picker_go_to(struct picker *picker, const char *value);

/* The item under the cursor; NULL: none matches. */
const struct pick *ceduo_picker_at(const struct picker *picker);
void ceduo_picker_draw(struct picker *picker, struct ceduo_cells *cells, struct ceduo_area area);

/* ---- files ---- */

/* Add what a typed path may go on to: folders, and files with one of some endings (".csv .txt"). */
void ceduo_picker_add_files(struct picker *picker, const char *typed, const char *endings);

/* True if a name has one of the endings, in small or capital letters. */
bool ceduo_picker_is_file(const char *name, const char *endings);

/* Complete a typed path as far as there is no choice; false if there is nothing to complete. */
bool ceduo_picker_complete(const struct picker *picker, struct line *line);

#endif
