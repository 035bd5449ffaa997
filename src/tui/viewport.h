/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEWPORT_H
#define CEDUO_VIEWPORT_H

#include "view/cells.h"

/* A viewport of `rows` lines onto a list or text of `count` lines. */
struct viewport {
    int first;    /* top line; -1, -2, … count from the end until viewport_fit(), because keys may precede drawing */
    int selected; /* line of the cursor */
    int rows, count;
};

#define ALL_LINES 1000000 /* a step of this size goes to the first or last line */

/* Scroll by n lines. */
static inline void viewport_scroll(struct viewport *v, int n)
{
    int moved = v->first + n;
    v->first = n >= ALL_LINES ? -1 : n <= -ALL_LINES ? 0 : (v->first < 0) == (moved < 0) ? moved : v->first < 0 ? -1 : 0;
}

/* Move the cursor by n lines, within the list. */
static inline void viewport_move(struct viewport *v, int n)
{
    int line = v->selected + n < v->count ? v->selected + n : v->count - 1;
    v->selected = line > 0 ? line : 0;
}

/* Set both sizes, and keep the viewport within the list. */
static inline void viewport_fit(struct viewport *v, int rows, int count)
{
    int max = count > rows ? count - rows : 0, first = v->first < 0 ? max + 1 + v->first : v->first;
    *v = (struct viewport){first > max ? max : first > 0 ? first : 0, v->selected, rows, count};
}

/* Scroll so that lines `from` to `to` are visible; if there are too many, the last ones. */
static inline void viewport_show(struct viewport *v, int from, int to)
{
    int first = v->first < from ? v->first : from;
    v->first = first + v->rows > to ? first : to + 1 - v->rows;
}

static inline bool viewport_has_more(const struct viewport *v)
{
    return v->first + v->rows < v->count;
}

/* Cut lines from the bottom or the top of an area, and return them. */
static inline struct ceduo_area cut_bottom(struct ceduo_area *area, int lines)
{
    area->height -= lines;
    return (struct ceduo_area){area->left, area->top + area->height, area->width, lines};
}

static inline struct ceduo_area cut_top(struct ceduo_area *area, int lines)
{
    area->top += lines;
    area->height -= lines;
    return (struct ceduo_area){area->left, area->top - lines, area->width, lines};
}

#endif
