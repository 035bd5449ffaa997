/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEW_CELLS_H
#define CEDUO_VIEW_CELLS_H

/*
 * A grid of character cells. It writes to no terminal and to no file: the terminal program shows its cells, the batch mode
 * prints its text, the tests compare that text.
 *
 * A cell holds a few dots (how many depends on the character set), one role, and perhaps one character of text.
 * - A cell has one role. Dots of several roles in one cell are all seen, in the role that ranks highest, whoever drew
 *   first.
 * - Text hides the dots of its cell, those drawn later too; a blank inside a text does so as well.
 *   Text over text: the last one stays.
 */

#include <stdint.h>

#include "base/text.h"

/* A role says what a mark is about; the surface chooses its colour. BLANK draws nothing. Each line: name, letter in dumps,
 * rank. Where marks meet in a cell the highest rank gives the role: thin marks win over those that fill. */
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
    X(WAY, 'w', 16) /* the trajectory of the selected rock */                                                                  \
    X(STEM, 's', 7)                                                                                                            \
    X(STOOL, 'S', 6)                                                                                                           \
    X(BELT, 'b', 5) /* a stretch of forest along the slope */                                                                  \
    X(CONTROL, 'C', 15)                                                                                                        \
    X(GOOD, 'G', 12)                                                                                                           \
    X(BAD, 'B', 14)                                                                                                            \
    X(WARN, 'W', 13)                                                                                                           \
    X(BARE, 'r', 9)  /* a curve of the bare slope */                                                                           \
    X(WOOD, 'o', 10) /* the same curve of the wooded slope */                                                                  \
    X(CURSOR, 'x', 17)

enum ceduo_role {
#define X(NAME, letter, rank) CEDUO_ROLE_##NAME,
    CEDUO_ROLES(X)
#undef X
        CEDUO_ROLE_COUNT, /* how many roles there are, not a role */
};

extern const uint8_t ceduo_role_ranks[CEDUO_ROLE_COUNT];

/* A rectangle of cells. */
struct ceduo_area {
    int left, top, width, height;
};

/* Pictures draw on it (canvas.h). */
struct ceduo_canvas {
    const struct ceduo_surface *surface;
    struct ceduo_cells *cells; /* its text, and what is taken */
    void *to;                  /* what the surface's functions get */
    int dots_x, dots_y;        /* dots across and down one cell: the finest that can be told apart */
    bool words_alone;          /* pictures leave their area blank */
};

enum {
    CEDUO_CANVAS_MAX_WIDTH = 1000, /* cells */
    CEDUO_CANVAS_MAX_HEIGHT = 500, /* cells */
};

enum ceduo_charset {
    CEDUO_CHARSET_BRAILLE, /* UTF-8, 2 x 4 dots a cell, square where a cell is twice as high as wide */
    CEDUO_CHARSET_BLOCK,   /* UTF-8, 2 x 2 dots a cell, each twice as high as wide */
    CEDUO_CHARSET_ASCII,   /* 1 x 2 dots a cell (' . :), square; text is control_means down to ASCII too */
};

struct ceduo_cell {
    uint32_t code; /* Unicode code point of the text here, 0 where there is none */
    uint8_t dots;  /* bit (y * dots across + x), y down from the top of the cell */
    uint8_t role;  /* enum ceduo_role */
};

struct ceduo_cells {
    int width, height;
    enum ceduo_charset charset;
    struct ceduo_canvas canvas; /* to draw pictures on it */
    struct ceduo_cell *cell;    /* width * height, row after row */
    uint32_t *density;          /* of trajectories, one count a dot, row after row; NULL before a cloud is started */
};

/* A new, blank grid of width x height cells (1..CEDUO_CANVAS_MAX_WIDTH, 1..CEDUO_CANVAS_MAX_HEIGHT), to be freed by
 * ceduo_cells_free. NULL if a size is out of range. */
struct ceduo_cells *ceduo_cells_create(int width, int height, enum ceduo_charset charset);

/* Free a grid and what belongs to it. NULL is allowed. */
void ceduo_cells_free(struct ceduo_cells *cells);

/* Make every cell blank, and every count of the density 0. */
void ceduo_cells_clear(struct ceduo_cells *cells);
void ceduo_cells_clear_area(struct ceduo_cells *cells, struct ceduo_area area); /* of it what lies on the grid */

/* ---- Text ---- */

/* Write UTF-8 text from a cell on; returns the number of cells it takes, cut off or not. One '?' each for an invalid byte, a
 * control character, and a character that takes no cell (combining marks) or two (East Asian, emoji). In ASCII the others
 * become a near equivalent, of up to three characters, or '?'. */
int ceduo_cells_label(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, const char *text);

/* Write the end of a text that fits into `most` cells; returns the cells it took. */
int ceduo_cells_label_end(struct ceduo_cells *cells, int column, int row, int most, enum ceduo_role role, const char *text);

/* Whether a digit of a text is the power of a metre, as in m3 and m2/ha, and not part of a key: cells show m³ outside ASCII. */
bool ceduo_is_power(const char *string, const char *at);

/* Adds a text as it is written in ASCII. */
void ceduo_cells_ascii(struct text *text, const char *string);

/* The number of cells a text takes in a character set. */
int ceduo_cells_label_width(enum ceduo_charset charset, const char *text);

/* ---- For surfaces ---- */

extern const struct ceduo_surface ceduo_cells_surface; /* in canvas.c */

/* The cell at a place; NULL outside the grid. */
struct ceduo_cell *ceduo_cells_at(const struct ceduo_cells *cells, int column, int row);

/* The number of dots of the whole grid. */
size_t ceduo_cells_dots(const struct ceduo_cells *cells);

/* Draw one dot, counted in dots of the whole grid; write one character. */
void ceduo_cells_set_dot(struct ceduo_cells *cells, int x, int y, enum ceduo_role role);
void ceduo_cells_set_code(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, uint32_t code);

/* ---- Output ---- */

/* What a cell shows: a code point, ' ' where it is empty or outside the grid; and its role. */
uint32_t ceduo_cells_glyph(const struct ceduo_cells *cells, int column, int row);
enum ceduo_role ceduo_cells_role(const struct ceduo_cells *cells, int column, int row);

/* Adds one row as UTF-8 without its trailing blanks; nothing for a row outside the grid. */
void ceduo_cells_text(const struct ceduo_cells *cells, int row, struct text *text);

/* All rows as one UTF-8 string, each ended by a newline; to be freed by the caller. */
char *ceduo_cells_dump(const struct ceduo_cells *cells);

/* The role of each cell as its letter, in rows like those of ceduo_cells_dump; to be freed by the caller. */
char *ceduo_cells_roles(const struct ceduo_cells *cells);

#endif
