/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEW_CANVAS_H
#define CEDUO_VIEW_CANVAS_H

#include "cells.h"

/* Pictures draw on a canvas. Layout is in character cells from 0 at the top left; data are drawn in frames of cells. Text
 * and occupied cells are kept in a grid. A surface draws the lines: as dots of cells, or as vectors. It is a table of
 * functions, so each picture is written once. Drawing is clipped to the surface. Data points that are not finite are
 * skipped. No function keeps a pointer argument. */

/* Plot area: a rectangle of cells and its data range. x0 is the leftmost column of dots, x1 the rightmost, y0 the lowest
 * row, y1 the highest. A point is drawn at its nearest dot, and is inside if that dot is. y0 > y1 flips the axis. A frame
 * draws nothing if it is too small or too large, far outside, or its range is empty or not finite. */
struct ceduo_frame {
    int left, top;     /* upper left cell; may be outside the surface */
    int width, height; /* cells; 2..CEDUO_CANVAS_MAX_WIDTH, 1..CEDUO_CANVAS_MAX_HEIGHT */
    double x0, x1;     /* data at the left and the right edge */
    bool x_integer;    /* labels at the bottom are integers (years) */
    double y0, y1;     /* data at the bottom and the top edge */
};

enum {
    CEDUO_TICKS_MAX = 64,       /* ticks of one axis */
    CEDUO_TICK_LABEL_SIZE = 32, /* bytes of any label of a tick, including the final NUL */
};

/* ---- For surfaces ---- */

/* A frame in dots: its corner on the surface, and the number of dots. */
struct ceduo_raster {
    int left, top, nx, ny;
};

/* Position in dots from the corner of a raster, y down; integers are centres of dots. */
struct ceduo_position {
    double x, y;
};

/* Stroke styles in drawing order. RULE and DOTS draw every 2nd dot, FEW every 4th, DASHES 4 of 6. */
enum ceduo_stroke {
    CEDUO_STROKE_TRAJECTORY, /* one of many trajectories of a cloud */
    CEDUO_STROKE_RULE,
    CEDUO_STROKE_DOTS,
    CEDUO_STROKE_FEW,
    CEDUO_STROKE_DASHES,
    CEDUO_STROKE_PLAIN,
    CEDUO_STROKES
};

/* State of a line; one pen for each line of several parts. */
struct ceduo_pen {
    struct ceduo_raster raster;
    enum ceduo_role role;
    enum ceduo_stroke stroke;
    int last_x, last_y; /* for the surface; INT_MIN before its first line */
};

/* A tick of an axis. */
struct ceduo_tick {
    int cell;        /* column or row; -1: the unit among the bottom labels */
    double position; /* fractional cell: 3.5 is the middle of cell 3 */
    int start;       /* first column of the label; -1: does not fit */
    char label[CEDUO_TICK_LABEL_SIZE];
};

struct ceduo_surface {
    double margin; /* dots by which lines may exceed the centres of the outermost dots: 0.5 for cells */
    void (*line)(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b); /* inside the raster */
    void (*bar)(void *to, int column, int row, int width, double fraction, enum ceduo_role role);
    /* Draw a line with ticks and labels, in the column left of the frame or the row below it. */
    void (*axis)(void *to, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks);
    /* Draw a disc with radii across and down in dots; NULL: drawn as lines. */
    void (*disc)(void *to, const struct ceduo_raster *raster, enum ceduo_role role, struct ceduo_position centre,
                 struct ceduo_position radii);
};

/* ---- Frames ---- */

/* Set the ranges of a frame with given cells to true scale: x_lo..x_hi and y_lo..y_hi (m) just fit and are centred. Cells
 * are twice as high as wide. Return false, frame unchanged, if the cells are out of range, or an extent is not finite or
 * reversed, or both are empty. */
bool ceduo_frame_true_scale(struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x_lo, double x_hi, double y_lo,
                            double y_hi);

/* Find the cell of a data point. False, output unchanged, if outside the frame. */
bool ceduo_frame_cell(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x, double y, int *column,
                      int *row);

/* ---- Drawing data, clipped to the frame ---- */

/* Draw a straight line from (x0, y0) to (x1, y1), clipped. */
void ceduo_canvas_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x0, double y0,
                       double x1, double y1);

/* Draw lines through n points. A point that is not finite breaks the line; an isolated point is a dot. */
void ceduo_canvas_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                           enum ceduo_stroke stroke, size_t n, const double *x, const double *y);

/* Draw stairs: y[i] holds from x[i] to x[i + 1]. The last point ends the line. A point that is not finite breaks it. */
void ceduo_canvas_stairs(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                         const double *x, const double *y);

/* Draw a dotted line at height y, or at x. */
void ceduo_canvas_rule_y(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double y);
void ceduo_canvas_rule_x(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x);

/* Draw a disc of at least one dot. The radius is in data units, scaled per axis. */
void ceduo_canvas_disc(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x, double y,
                       double radius);

/* Draw a bar of `fraction` (0..1, clamped) of `width` cells. <= 0 or NaN: nothing; > 0: always visible. */
void ceduo_canvas_bar(struct ceduo_canvas *canvas, int column, int row, int width, double fraction, enum ceduo_role role);

/* Cloud of trajectories: start it, draw trajectories with CEDUO_STROKE_TRAJECTORY, show it. Shows dots passed at least as often
 * as the given quantile (0..1) of all passed dots. 0: all dots; 0.9: the top tenth; 1: the maximum. */
void ceduo_canvas_cloud_start(struct ceduo_canvas *canvas);
void ceduo_canvas_cloud_show(struct ceduo_canvas *canvas, double quantile);

/* ---- Text ---- */

/* Draw UTF-8 text from a cell on. Return its width in cells, also if clipped. */
int ceduo_canvas_label(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* Draw text that ends in cell `column`. */
int ceduo_canvas_label_right(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* Return the width of a text in cells. */
int ceduo_canvas_label_width(const struct ceduo_canvas *canvas, const char *text);

/* True if a cell is empty or outside the surface. */
bool ceduo_canvas_is_blank(const struct ceduo_canvas *canvas, int column, int row);

/* Draw a text of at most `max` cells, cut with a mark. Return its cells. */
int ceduo_canvas_draw_text(struct ceduo_canvas *canvas, int column, int row, int max, enum ceduo_role role, const char *text);

/* ---- Axes ---- */

/* Find round values in lo..hi (or hi..lo), ascending, at most max_count (1..CEDUO_TICKS_MAX; clamped). Their interval is the
 * smallest possible 1, 2 or 5 times a power of ten. Return their number; `out` has max_count elements. If lo and hi are
 * nearly equal, the only tick is lo and the interval 0. Return 0 if max_count < 1, a bound is not finite, or the range
 * exceeds 1e300. Never returns -0. */
int ceduo_ticks(double lo, double hi, int max_count, double *out, double *interval);

/* Format a tick with the decimals of its interval (from ceduo_ticks()); large and tiny values as 2e11 or 5e-9. Interval 0:
 * at most six digits. Never "-0". */
void ceduo_tick_label(double value, double interval, char label[CEDUO_TICK_LABEL_SIZE]);

/* Return the columns that ceduo_canvas_axis_left() needs: the widest label and the line. Depends on height and y range only.
 * 0 if the frame draws nothing. */
int ceduo_frame_axis_width(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas);

/* Draw the y axis in the column left of the frame. Labels are right-aligned and do not touch. A label that does not fit is
 * dropped. */
void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame);

/* Draw the x axis below the frame, labels in the next row, from the column left of the frame on. The unit (may be NULL)
 * follows the last label, or the first, or is dropped. Joins a left axis drawn before. */
void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit);

#endif
