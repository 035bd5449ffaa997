/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEWPORT_H
#define CEDUO_VIEWPORT_H

#include "view/cells.h"

/* A window of `rows` lines onto a list or text of `count` lines. */
struct viewport {
    int first;    /* line on top; from the end -1, -2, … until viewport_fit(): keys may come before the text is drawn */
    int selected; /* line of the cursor */
    int rows, count;
};

#define ALL_LINES 1000000 /* a step of so many lines goes to the first or the last one */

/* Move the window by n lines. */
static inline void viewport_scroll(struct viewport *v, int by)
{
    int moved = v->first + by;
    v->first = by >= ALL_LINES ? -1 : by <= -ALL_LINES ? 0 : (v->first < 0) == (moved < 0) ? moved : v->first < 0 ? -1 : 0;
}

/* Move the cursor by n lines, within the list. */
static inline void viewport_move(struct viewport *v, int by)
{
    int at = v->selected + by < v->count ? v->selected + by : v->count - 1;
    v->selected = at > 0 ? at : 0;
}

/* Set the lengths of both, and keep the window within the list. */
static inline void viewport_fit(struct viewport *v, int rows, int count)
{
    int max = count > rows ? count - rows : 0, first = v->first < 0 ? max + 1 + v->first : v->first;
    *v = (struct viewport){first > max ? max : first > 0 ? first : 0, v->selected, rows, count};
}

/* Scroll so that lines `from` to `to` are seen, of too many the last. */
static inline void viewport_show(struct viewport *v, int from, int to)
{
    int first = v->first < from ? v->first : from;
    v->first = first + v->rows > to ? first : to + 1 - v->rows;
}

static inline bool viewport_has_more(const struct viewport *v)
{
    return v->first + v->rows < v->count;
}

/* Cut the lowest or the uppermost lines off an area, and return them. */
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
