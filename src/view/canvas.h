/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VIEW_CANVAS_H
#define CEDUO_VIEW_CANVAS_H

#include "cells.h"

/*
 * Pictures draw on a canvas. A picture is laid out in character cells, counted from 0 at the top left, and draws its data
 * in frames of such cells. Its text, and what is taken, stands in a grid of cells; a surface shows its lines: as dots of those
 * cells, or as vectors on a page whose unit is a cell. A surface is one table of functions, so that each picture is written once.
 *
 * Whatever falls outside the surface is cut off. Data points that are not finite are never drawn. No function here keeps
 * a pointer it is given.
 */

/* A plot area: a rectangle of cells and the data shown in it. The leftmost column of dots stands at x0 and the rightmost at x1,
 * the lowest row of dots at y0 and the highest at y1. A point belongs to the nearest dot; it is inside if that dot is. y0 > y1
 * turns the axis round. A frame that is narrower than 2 or lower than 1 cell, larger than the largest surface, further than
 * that outside it, or whose ranges are empty or not finite, draws nothing. */
struct ceduo_frame {
    int left, top;     /* cell of the upper left corner; may lie outside the surface */
    int width, height; /* cells; 2..CEDUO_CANVAS_MAX_WIDTH, 1..CEDUO_CANVAS_MAX_HEIGHT */
    double x0, x1;     /* data at the left and the right edge */
    bool x_whole;      /* labels at the bottom are whole numbers: years */
    double y0, y1;     /* data at the bottom and the top edge */
};

enum {
    CEDUO_TICKS_MAX = 64,       /* ticks of one axis */
    CEDUO_TICK_LABEL_SIZE = 32, /* bytes that hold every label of a tick, with the final NUL */
};

/* ---- For surfaces ---- */

/* A frame in dots: its corner on the surface, and how many there are. */
struct ceduo_raster {
    int left, top, nx, ny;
};

/* A position in dots from the corner of a raster, y down; whole numbers are the middles of dots. */
struct ceduo_position {
    double x, y;
};

/* How a line is drawn, from what lies below to what lies above; of rules and curves every second column of dots, every fourth,
 * four of six. */
enum ceduo_stroke {
    CEDUO_STROKE_TRAJECTORY, /* one of many: a part of the cloud */
    CEDUO_STROKE_RULE,
    CEDUO_STROKE_DOTS,
    CEDUO_STROKE_FEW,
    CEDUO_STROKE_DASHES,
    CEDUO_STROKE_PLAIN,
    CEDUO_STROKES
};

/* What lines are drawn with: one pen for each line of several parts. */
struct ceduo_pen {
    struct ceduo_raster raster;
    enum ceduo_role role;
    enum ceduo_stroke stroke;
    int last_x, last_y; /* for the surface; INT_MIN before its first line */
};

/* A tick of an axis. */
struct ceduo_tick {
    int cell;  /* column or row; -1 for the unit, which stands among the labels of the bottom axis */
    double at; /* the same in parts of a cell: 3.5 is the middle of cell 3 */
    int start; /* column where the label begins, -1 where it has no room */
    char label[CEDUO_TICK_LABEL_SIZE];
};

struct ceduo_surface {
    double margin; /* dots that a line may reach beyond the middles of the outermost ones: on cells half of one */
    void (*line)(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b); /* within the raster */
    void (*bar)(void *to, int column, int row, int width, double fraction, enum ceduo_role role);
    /* A line with ticks, in the column left of the frame or in the row below it, and the ticks' labels beside it. */
    void (*axis)(void *to, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks);
    /* A disc, its radii across and down in dots; NULL: it is drawn as lines. */
    void (*disc)(void *to, const struct ceduo_raster *raster, enum ceduo_role role, struct ceduo_position centre,
                 struct ceduo_position radii);
};

/* ---- Frames ---- */

/* Set the ranges of a frame, whose cells are given, so that one metre is as long across as upwards where cells are twice as
 * high as wide, that x_lo..x_hi and y_lo..y_hi (metres) just fit, and that they lie in the middle. False, and the frame as it
 * was, if its cells are out of range, an extent is not finite or runs backwards, or both are empty. */
bool ceduo_frame_true_scale(struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x_lo, double x_hi, double y_lo,
                            double y_hi);

/* The cell in which the data point (x, y) is drawn. False, and nothing written, if outside the frame. */
bool ceduo_frame_cell(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x, double y, int *column,
                      int *row);

/* ---- Drawing data: every function cuts at the edges of the frame ---- */

/* The straight line from (ax, ay) to (bx, by); drawn too where it only crosses the frame. */
void ceduo_canvas_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double ax, double ay,
                       double bx, double by);

/* Straight lines through n points. One that is not finite breaks the line; one left alone is a dot. */
void ceduo_canvas_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                           enum ceduo_stroke stroke, size_t n, const double *x, const double *y);

/* Stairs: y[i] holds from x[i] to x[i + 1], where the line goes upright to y[i + 1]. The last point ends it. One that is not
 * finite breaks the line. */
void ceduo_canvas_stairs(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                         const double *x, const double *y);

/* A dotted line across the frame at height y, or up it at x. */
void ceduo_canvas_rule_y(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double y);
void ceduo_canvas_rule_x(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x);

/* A disc of at least one dot; its radius is of the scale of each axis. */
void ceduo_canvas_disc(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x, double y,
                       double radius);

/* A horizontal bar, `fraction` (0..1) of `width` cells long. Above 1 it is full. 0, less and NaN give nothing, but what is
 * above 0 always shows something. */
void ceduo_canvas_bar(struct ceduo_canvas *canvas, int column, int row, int width, double fraction, enum ceduo_role role);

/* A cloud of many trajectories. Start it, draw trajectories with CEDUO_STROKE_TRAJECTORY, which shows nothing, and show it: the dots
 * that were passed at least as often as the given quantile (0..1) of all dots that were passed. 0 shows every one, 0.9 the most
 * travelled tenth, 1 those passed most. */
void ceduo_canvas_cloud_start(struct ceduo_canvas *canvas);
void ceduo_canvas_cloud_show(struct ceduo_canvas *canvas, double quantile);

/* ---- Text ---- */

/* Write UTF-8 text from a cell on; returns the number of cells it takes, cut off or not. */
int ceduo_canvas_label(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* The same, with the last character in cell `column`. */
int ceduo_canvas_label_right(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text);

/* The number of cells a text takes. */
int ceduo_canvas_label_width(const struct ceduo_canvas *canvas, const char *text);

/* Whether nothing is drawn in a cell; one outside the surface is blank. */
bool ceduo_canvas_is_blank(const struct ceduo_canvas *canvas, int column, int row);

/* A text of at most `most` cells, cut with a mark where it is longer; returns the cells it took. */
int ceduo_canvas_draw_text(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *text);

/* ---- Axes ---- */

/* Round values within lo..hi (or hi..lo), ascending, at most max_count (1..CEDUO_TICKS_MAX; cut to that) of them, apart by the
 * least possible interval of 1, 2 or 5 times a power of ten. Returns how many are in out, which has room for max_count, and
 * their interval. Where lo and hi are equal, or too near to tell apart, the one tick is lo and the interval 0. Returns 0 if
 * max_count < 1, or a bound is not finite, or the range is beyond 1e300. Never gives -0. */
int ceduo_ticks(double lo, double hi, int max_count, double *out, double *interval);

/* Writes a tick's value with the decimals its interval (1, 2 or 5 times a power of ten, from ceduo_ticks) needs; large and tiny
 * ones as 2e11 or 5e-9. An interval of 0 writes six digits at most. Never "-0". */
void ceduo_tick_label(double value, double interval, char label[CEDUO_TICK_LABEL_SIZE]);

/* Columns that ceduo_canvas_axis_left takes to the left of this frame: the widest label and the line. Depends on the height and
 * the y range only, so that `left` can be set from it. 0 for a frame that draws nothing. */
int ceduo_frame_axis_width(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas);

/* The y axis in the column left of the frame, its labels right-aligned before it, as many as stand clear of each other. A
 * number that has not enough columns is left out, never cut. */
void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame);

/* The x axis in the row below the frame, its labels in the row below that, within the frame and the column left of it, never
 * touching. The unit (may be NULL) stands after the last number or, where there is no room, after the first; where there is
 * none either it is left out. Meets the left axis in a corner if that was drawn before. */
void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit);

#endif
