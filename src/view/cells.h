/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEW_CELLS_H
#define CEDUO_VIEW_CELLS_H

/* Grid of character cells. It does no output itself: the terminal program shows cells, batch mode prints the text, tests
 * compare it. A cell has dots (their number depends on the character set), one role, and at most one character. Dots of
 * several roles in a cell take the role with the highest rank, in any order of drawing. Text hides the dots of its cell,
 * also later ones and also under blanks; later text replaces text. */

#include <stdint.h>

#include "base/text.h"
#include "study/surface.h"

/* Meaning of a mark; the surface chooses its colour. BLANK draws nothing. Each line: name, letter in dumps, rank. The
 * highest rank in a cell wins: thin marks win over filling marks. */
#define CEDUO_ROLES(X)                                                                                                         \
    X(BLANK, ' ', 0)                                                                                                           \
    X(TEXT, 't', 19)                                                                                                           \
    X(DIM, 'd', 1)                                                                                                             \
    X(TITLE, 'T', 18)                                                                                                          \
    X(AXIS, 'a', 2)                                                                                                            \
    X(GROUND, 'g', 4)                                                                                                          \
    X(CLOUD, 'c', 3)    /* all trajectories together */                                                                        \
    X(ENVELOPE, 'e', 8) /* quantiles of the trajectories */                                                                    \
    X(MEAN, 'm', 11)                                                                                                           \
    X(TRAJECTORY, 'w', 16) /* trajectory of the selected rock */                                                               \
    X(STEM, 's', 7)                                                                                                            \
    X(STOOL, 'S', 6)                                                                                                           \
    X(BELT, 'b', 5) /* stretch of forest along the slope */                                                                    \
    X(CONTROL, 'C', 15)                                                                                                        \
    X(GOOD, 'G', 12)                                                                                                           \
    X(BAD, 'B', 14)                                                                                                            \
    X(WARN, 'W', 13)                                                                                                           \
    X(BARE, 'r', 9)    /* curve of the bare slope */                                                                           \
    X(FOREST, 'o', 10) /* curve of the forested slope */                                                                       \
    X(CURSOR, 'x', 17)

enum ceduo_role {
#define X(NAME, letter, rank) CEDUO_ROLE_##NAME,
    CEDUO_ROLES(X)
#undef X
        CEDUO_ROLE_COUNT, /* number of roles */
};

extern const uint8_t ceduo_role_ranks[CEDUO_ROLE_COUNT];

/* A rectangle of cells. */
struct ceduo_area {
    int left, top, width, height;
};

/* Target of pictures (canvas.h). */
struct ceduo_canvas {
    const struct ceduo_surface *surface;
    struct ceduo_cells *cells; /* text and occupied cells */
    void *to;                  /* argument of the surface's functions */
    int dots_x, dots_y;        /* dots per cell: the finest resolution */
    bool text_only;            /* pictures leave their area blank */
};

enum {
    CEDUO_CANVAS_MAX_WIDTH = 1000, /* cells */
    CEDUO_CANVAS_MAX_HEIGHT = 500, /* cells */
};

enum ceduo_charset {
    CEDUO_CHARSET_BRAILLE, /* UTF-8, 2 x 4 dots per cell, square if cells are twice as high as wide */
    CEDUO_CHARSET_BLOCK,   /* UTF-8, 2 x 2 dots per cell, twice as high as wide */
    CEDUO_CHARSET_ASCII,   /* 1 x 2 dots per cell (' . :), square; text is converted to ASCII, too */
};

struct ceduo_cell {
    uint32_t code; /* Unicode code point of the text; 0: none */
    uint8_t dots;  /* bit (y * dots across + x), y down from the top of the cell */
    uint8_t role;  /* enum ceduo_role */
};

struct ceduo_cells {
    int width, height;
    enum ceduo_charset charset;
    struct ceduo_canvas canvas; /* for pictures */
    struct ceduo_cell *cell;    /* width * height, row by row */
    uint32_t *density;          /* passes of trajectories, one count per dot, row by row; NULL before a cloud is started */
};

/* Create a blank grid (1..CEDUO_CANVAS_MAX_WIDTH x 1..CEDUO_CANVAS_MAX_HEIGHT); caller frees. NULL if a size is out of
 * range. */
struct ceduo_cells *ceduo_cells_create(int width, int height, enum ceduo_charset charset);

/* Free a grid; may be NULL. */
void ceduo_cells_free(struct ceduo_cells *cells);

/* Clear all cells and the density. */
void ceduo_cells_clear(struct ceduo_cells *cells);
void ceduo_cells_clear_area(struct ceduo_cells *cells, struct ceduo_area area); /* clipped to the grid */

/* ---- Text ---- */

/* Draw UTF-8 text from a cell on. Return its width in cells, also if clipped. Invalid bytes, control characters, and
 * characters of width 0 or 2 become '?'. ASCII uses near equivalents of up to three characters, or '?'. */
int ceduo_cells_label(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, const char *text);

/* Draw the end of a text that fits into `max` cells; return its cells. */
int ceduo_cells_label_end(struct ceduo_cells *cells, int column, int row, int max, enum ceduo_role role, const char *text);

/* True if a digit is the power of a metre, as in m3 and m2/ha, and not part of a key. Outside ASCII cells show m³. */
bool ceduo_is_power(const char *string, const char *digit);

/* Append a text converted to ASCII. */
void ceduo_cells_ascii(struct text *text, const char *string);

/* Return the width of a text in cells in a character set. */
int ceduo_cells_label_width(enum ceduo_charset charset, const char *text);

/* ---- For surfaces ---- */

extern const struct ceduo_surface ceduo_cells_surface; /* in canvas.c */

/* Return a cell; NULL outside the grid. */
struct ceduo_cell *ceduo_cells_at(const struct ceduo_cells *cells, int column, int row);

/* Return the number of dots of the grid. */
size_t ceduo_cells_dots(const struct ceduo_cells *cells);

/* Draw a dot at dot coordinates of the grid; draw a character. */
void ceduo_cells_set_dot(struct ceduo_cells *cells, int x, int y, enum ceduo_role role);
void ceduo_cells_set_code(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, uint32_t code);

/* ---- Output ---- */

/* Return the code point of a cell, ' ' if empty or outside the grid; its role. */
uint32_t ceduo_cells_glyph(const struct ceduo_cells *cells, int column, int row);
enum ceduo_role ceduo_cells_role(const struct ceduo_cells *cells, int column, int row);

/* Append a row as UTF-8 without trailing blanks; nothing if outside the grid. */
void ceduo_cells_text(const struct ceduo_cells *cells, int row, struct text *text);

/* Return all rows as UTF-8, each with a newline; caller frees. */
char *ceduo_cells_dump(const struct ceduo_cells *cells);

/* Return the role letter of each cell, in rows as ceduo_cells_dump(); caller frees. */
char *ceduo_cells_roles(const struct ceduo_cells *cells);

#endif
