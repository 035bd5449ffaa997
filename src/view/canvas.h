/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEW_CANVAS_H
#define CEDUO_VIEW_CANVAS_H

/*
 * A canvas turns data into a grid of character cells. It writes to no terminal and to no file: the
 * terminal program shows its cells, the batch mode prints its text, the tests compare that text.
 *
 * A cell holds a few dots (how many depends on the character set), one role, and perhaps one
 * character of text. A role says what a cell is about; the colour is for whoever shows it.
 * - A cell has one role. Dots of several roles in one cell are all seen, in the role that ranks
 *   highest, whoever drew first: cursor > way > control > bad > warn > good > mean > wood > bare >
 *   envelope > stem > stool > belt > ground > cloud > axis > dim. Dots drawn as title or text
 *   rank above all of these.
 * - Text hides the dots of its cell, those drawn later too; a blank inside a text does so as well.
 *   Text over text: the last one stays.
 *
 * Columns and rows are cells, counted from 0 at the top left. What falls outside the canvas is cut
 * off. Data points that are not finite are never drawn. No function here keeps a pointer it is
 * given, except to the canvas's own memory.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    CEDUO_CANVAS_MAX_WIDTH = 1000, /* cells */
    CEDUO_CANVAS_MAX_HEIGHT = 500, /* cells */
    CEDUO_TICKS_MAX = 64,          /* ticks of one axis */
    CEDUO_TICK_LABEL_SIZE = 32,    /* bytes that hold every label of a tick, with the final NUL */
};

enum ceduo_charset {
    CEDUO_CHARSET_BRAILLE, /* UTF-8, 2 x 4 dots a cell, square where a cell is twice as high as wide */
    CEDUO_CHARSET_BLOCK,   /* UTF-8, 2 x 2 dots a cell, each twice as high as wide */
    CEDUO_CHARSET_ASCII,   /* 1 x 2 dots a cell (' . :), square; text is brought down to ASCII too */
};

enum ceduo_role {
    CEDUO_ROLE_BLANK, /* nothing; drawing with this role draws nothing */
    CEDUO_ROLE_TEXT,
    CEDUO_ROLE_DIM,
    CEDUO_ROLE_TITLE,
    CEDUO_ROLE_AXIS,
    CEDUO_ROLE_GROUND,
    CEDUO_ROLE_CLOUD,    /* all ways together */
    CEDUO_ROLE_ENVELOPE, /* quantiles of the ways */
    CEDUO_ROLE_MEAN,
    CEDUO_ROLE_WAY, /* the way of the selected rock */
    CEDUO_ROLE_STEM,
    CEDUO_ROLE_STOOL,
    CEDUO_ROLE_BELT, /* a stretch of wood along the slope */
    CEDUO_ROLE_CONTROL,
    CEDUO_ROLE_GOOD,
    CEDUO_ROLE_BAD,
    CEDUO_ROLE_WARN,
    CEDUO_ROLE_BARE, /* a curve of the bare slope */
    CEDUO_ROLE_WOOD, /* the same curve of the wooded slope */
    CEDUO_ROLE_CURSOR,
    CEDUO_ROLE_COUNT, /* how many roles there are, not a role */
};

struct ceduo_canvas_cell {
    uint32_t code; /* Unicode code point of the text here, 0 where there is none */
    uint8_t dots;  /* bit (y * dots across + x), y down from the top of the cell */
    uint8_t role;  /* enum ceduo_role */
};

struct ceduo_canvas {
    int width, height; /* cells */
    enum ceduo_charset charset;
    struct ceduo_canvas_cell *cells; /* width * height, row after row */
    uint32_t *density;               /* one count a dot, row after row; NULL before density_start */
};

/*
 * A plot area: a rectangle of cells and the data shown in it. The leftmost column of dots stands at
 * x0 and the rightmost at x1, the lowest row of dots at y0 and the highest at y1. A point belongs
 * to the nearest dot; it is inside if that dot is. x0 > x1 or y0 > y1 turns the axis round.
 * A frame that is narrower than 2 or lower than 1 cell, larger than the largest canvas, further
 * than that outside it, or whose ranges are empty or not finite, draws nothing.
 */
struct ceduo_frame {
    int left, top;     /* cell of the upper left corner; may lie outside the canvas */
    int width, height; /* cells; 2..CEDUO_CANVAS_MAX_WIDTH, 1..CEDUO_CANVAS_MAX_HEIGHT */
    double x0, x1;     /* data at the left and the right edge */
    double y0, y1;     /* data at the bottom and the top edge */
};

/* ---- The canvas ---- */

/*
 * A new, blank canvas of width x height cells (1..CEDUO_CANVAS_MAX_WIDTH, 1..CEDUO_CANVAS_MAX_HEIGHT),
 * to be freed by ceduo_canvas_free. NULL if there is no memory or a size is out of range.
 */
struct ceduo_canvas *ceduo_canvas_create(int width, int height, enum ceduo_charset charset);

/* Free a canvas and what belongs to it. NULL is allowed. */
void ceduo_canvas_free(struct ceduo_canvas *canvas);

/* Make every cell blank, and every count of the density 0. */
void ceduo_canvas_clear(struct ceduo_canvas *canvas);

/* Dots across and down one cell of a character set. */
int ceduo_canvas_dots_x(enum ceduo_charset charset);
int ceduo_canvas_dots_y(enum ceduo_charset charset);

/* ---- Frames ---- */

/*
 * Set the ranges of a frame, whose cells are given, so that one metre is as long across as upwards
 * on a terminal whose cells are twice as high as wide, that x_lo..x_hi and y_lo..y_hi (metres) just
 * fit, and that they lie in the middle. False, and the frame as it was, if its cells are out of range,
 * an extent is not finite or runs backwards, or both are empty.
 */
bool ceduo_frame_true_scale(struct ceduo_frame *frame, enum ceduo_charset charset, double x_lo, double x_hi,
                            double y_lo, double y_hi);

/*
 * How many times longer a metre is upwards than across: 1 at true scale, 2 if heights look doubled.
 * Always positive. NaN for a frame that draws nothing.
 */
double ceduo_frame_exaggeration(const struct ceduo_frame *frame, enum ceduo_charset charset);

/* The cell in which the data point (x, y) is drawn. False, and nothing written, if outside the frame. */
bool ceduo_frame_cell(const struct ceduo_frame *frame, enum ceduo_charset charset, double x, double y, int *column,
                      int *row);

/*
 * Columns that ceduo_canvas_axis_left takes to the left of this frame: the widest label and the line.
 * Depends on the height and the y range only, so that `left` can be set from it. 0 for a frame that
 * draws nothing.
 */
int ceduo_frame_axis_width(const struct ceduo_frame *frame, enum ceduo_charset charset);

/* ---- Drawing data: every function cuts at the edges of the frame ---- */

void ceduo_canvas_point(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x,
                        double y);

/* The straight line from (ax, ay) to (bx, by); drawn too where it only crosses the frame. */
void ceduo_canvas_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double ax,
                       double ay, double bx, double by);

/* Straight lines through n points. One that is not finite breaks the line; one left alone is a dot. */
void ceduo_canvas_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                           const double *x, const double *y);

/*
 * A step line: y[i] holds from x[i] to x[i + 1], where the line goes upright to y[i + 1]. The last
 * point ends it. One that is not finite breaks the line.
 */
void ceduo_canvas_steps(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                        const double *x, const double *y);

/*
 * Fill from the polyline through n points (n >= 2) down to the lower edge of the frame; for y0 > y1
 * that is the edge of y0 too. Columns that the curve does not reach stay empty.
 */
void ceduo_canvas_fill_below(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                             size_t n, const double *x, const double *y);

/* A dotted line across the frame at height y, or up it at x: every second dot. */
void ceduo_canvas_rule_y(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double y);
void ceduo_canvas_rule_x(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x);

/*
 * A horizontal bar, `fraction` (0..1) of `width` cells long, to an eighth of a cell, in ASCII to a cell.
 * Above 1 it is full. 0, less and NaN give nothing, but what is above 0 always shows something.
 */
void ceduo_canvas_bar(struct ceduo_canvas *canvas, int column, int row, int width, double fraction,
                      enum ceduo_role role);

/* ---- Density: many ways in one picture ---- */

/*
 * Ready the canvas to count how many ways pass each dot, all counts 0. False if there is no memory;
 * then, as before this call, adding and showing do nothing.
 */
bool ceduo_canvas_density_start(struct ceduo_canvas *canvas);

/* Count one way, a line or the lines through n points, in the dots it passes. Draws nothing. */
void ceduo_canvas_density_add_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, double ax, double ay,
                                   double bx, double by);
void ceduo_canvas_density_add_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, size_t n,
                                       const double *x, const double *y);

/*
 * Draw, as CEDUO_ROLE_CLOUD, the dots that were passed at least as often as the given quantile (0..1)
 * of all dots that were passed: 0 shows every one, 0.9 the most travelled tenth, 1 those passed most.
 * Returns that least count, 0 if nothing was counted.
 */
uint32_t ceduo_canvas_density_show(struct ceduo_canvas *canvas, double quantile);

/* ---- Text ---- */

/*
 * Write UTF-8 text from a cell on; returns the number of cells it takes, cut off or not. One '?' each
 * for an invalid byte, a control character, and a character known to take no cell (combining marks)
 * or two (East Asian, emoji). In ASCII the others become a near equivalent, of up to three
 * characters, or '?'.
 */
int ceduo_canvas_label(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* The same, with the last character in cell `column`. */
int ceduo_canvas_label_right(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* The number of cells a text takes in a character set. */
int ceduo_canvas_label_width(enum ceduo_charset charset, const char *text);

/* ---- Axes ---- */

/*
 * Round values within lo..hi (or hi..lo), ascending, at most max_count (1..CEDUO_TICKS_MAX; cut to
 * that) of them, apart by the least possible step of 1, 2 or 5 times a power of ten. Returns how
 * many are in out, which has room for max_count, and their step in *step (step may be NULL).
 * Where lo and hi are equal, or too near to tell apart, the one tick is lo and the step 0. Returns 0
 * if max_count < 1, or a bound is not finite, or the range is beyond 1e300. Never gives -0.
 */
int ceduo_ticks(double lo, double hi, int max_count, double *out, double *step);

/*
 * Write a tick's value with the decimals its step (1, 2 or 5 times a power of ten, from ceduo_ticks)
 * needs; large and tiny ones as 2e11 or 5e-9. A step of 0 writes six digits at most. Never "-0".
 * `size` bytes of buffer; CEDUO_TICK_LABEL_SIZE is always enough. Returns the length written.
 */
size_t ceduo_tick_label(double value, double step, size_t size, char *buffer);

/*
 * The y axis in the column left of the frame, its labels right-aligned before it, as many as stand
 * clear of each other. A number that has not enough columns is left out, never cut.
 */
void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame);

/*
 * The x axis in the row below the frame, its labels in the row below that, within the frame and the
 * column left of it, never touching. The unit (may be NULL) stands after the last number or, where
 * there is no room, after the first; where there is none either it is left out. Meets the left axis
 * in a corner if that was drawn before.
 */
void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit);

/* ---- Output ---- */

/* What a cell shows: a code point, ' ' where it is empty or outside the canvas; and its role. */
uint32_t ceduo_canvas_glyph(const struct ceduo_canvas *canvas, int column, int row);
enum ceduo_role ceduo_canvas_role(const struct ceduo_canvas *canvas, int column, int row);

/*
 * Write one row as UTF-8 without its trailing blanks. Writes at most size bytes, the final NUL among
 * them (unless size is 0), and no part of a character. Returns the bytes the whole row needs without
 * the NUL, as snprintf does; 0 for a row outside the canvas.
 */
size_t ceduo_canvas_text(const struct ceduo_canvas *canvas, int row, size_t size, char *buffer);

/* All rows as one UTF-8 string, each ended by a newline; to be freed by the caller. NULL: no memory. */
char *ceduo_canvas_dump(const struct ceduo_canvas *canvas);

/*
 * The role of each cell as a letter, in rows like those of ceduo_canvas_dump; to be freed by the
 * caller. NULL: no memory. Blank is a blank, the others are in the order of enum ceduo_role:
 * t text, d dim, T title, a axis, g ground, c cloud, e envelope, m mean, w way, s stem, S stool,
 * b belt, C control, G good, B bad, W warn, r bare, o wood, x cursor.
 */
char *ceduo_canvas_roles(const struct ceduo_canvas *canvas);

#endif
