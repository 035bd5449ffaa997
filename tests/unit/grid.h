/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A grid of cells to draw on, and its expected content. */
#ifndef GRID_H
#define GRID_H

#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "view/canvas.h"

#define BRAILLE CEDUO_CHARSET_BRAILLE
#define BLOCK   CEDUO_CHARSET_BLOCK
#define ASCII   CEDUO_CHARSET_ASCII

/* Last character set, for loops over all of them. */
#define LAST_CHARSET CEDUO_CHARSET_ASCII

static inline struct ceduo_cells *cells_in(int width, int height, enum ceduo_charset charset)
{
    struct ceduo_cells *cells = ceduo_cells_create(width, height, charset);
    assert_non_null(cells);
    return cells;
}

/* Return a frame over the whole grid with x and y in dots from the lower left. */
static inline struct ceduo_frame frame_in_dots(const struct ceduo_cells *cells)
{
    return (struct ceduo_frame){
        .width = cells->width,
        .height = cells->height,
        .x1 = cells->width * cells->canvas.dots_x - 1,
        .y1 = cells->height * cells->canvas.dots_y - 1,
    };
}

/* Return a canvas with this character set, as frames see it. */
static inline const struct ceduo_canvas *find_canvas(enum ceduo_charset charset)
{
    static struct ceduo_canvas canvas;
    canvas = (struct ceduo_canvas){.dots_x = charset == ASCII ? 1 : 2, .dots_y = charset == BRAILLE ? 4 : 2};
    return &canvas;
}

static inline void draw_point(struct ceduo_cells *cells, const struct ceduo_frame *frame, enum ceduo_role role, double x,
                              double y)
{
    ceduo_canvas_line(&cells->canvas, frame, role, x, y, x, y);
}

static inline void expect_text(const struct ceduo_cells *cells, const char *expected)
{
    char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static inline void expect_roles(const struct ceduo_cells *cells, const char *expected)
{
    char *roles = ceduo_cells_roles(cells);
    assert_non_null(roles);
    assert_string_equal(roles, expected);
    free(roles);
}

/* Compare the grid, then clear it for the next picture. */
static inline void expect_and_clear(struct ceduo_cells *cells, const char *expected)
{
    expect_text(cells, expected);
    ceduo_cells_clear(cells);
}

#endif
