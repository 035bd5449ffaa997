/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws pictures on cells: lines as dots, bars and axes as characters, clouds by how often a dot is passed. */
#include "cells.h"

#include <math.h>
#include <stdlib.h>

#include "base/must.h"

/* The nearest of n dots. */
static int nearest(double position, int n)
{
    return (int)lround(fmin(fmax(position, 0.0), n - 1));
}

/* Counts how many trajectories pass a dot; one where a part of a trajectory ends and the next begins counts once. */
static void count_dot(struct ceduo_cells *cells, struct ceduo_pen *pen, int x, int y)
{
    int width = cells->width * cells->canvas.dots_x, height = cells->height * cells->canvas.dots_y;
    if (!cells->density || x < 0 || x >= width || y < 0 || y >= height || (x == pen->last_x && y == pen->last_y))
        return;
    pen->last_x = x;
    pen->last_y = y;
    uint32_t *count = &cells->density[(size_t)y * (size_t)width + (size_t)x];
    *count += *count < UINT32_MAX;
}

static void draw_line(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    const struct ceduo_raster *r = &pen->raster;
    int x = nearest(a.x, r->nx), y = nearest(a.y, r->ny);
    int dx = nearest(b.x, r->nx) - x, dy = nearest(b.y, r->ny) - y;
    int dots = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
    for (int i = 0; i <= dots; i += pen->stroke == CEDUO_STROKE_DOTTED ? 2 : 1) {
        double part = dots > 0 ? (double)i / dots : 0;
        int at_x = r->left + x + (int)lround(part * dx), at_y = r->top + y + (int)lround(part * dy);
        if (pen->stroke == CEDUO_STROKE_WAY)
            count_dot(to, pen, at_x, at_y);
        else
            ceduo_cells_set_dot(to, at_x, at_y, pen->role);
    }
}

/* To an eighth of a cell, in ASCII to a cell. */
static void draw_bar(void *to, int column, int row, int width, double fraction, enum ceduo_role role)
{
    enum { full_block = 0x2588, eighth_block = 0x258F };
    const struct ceduo_cells *cells = to;
    bool ascii = cells->charset == CEDUO_CHARSET_ASCII;
    int parts = ascii ? 1 : 8; /* of a cell */
    int length = (int)lround(fraction * width * parts);
    length = length < 1 ? 1 : length;
    for (int i = 0; i < length / parts; ++i)
        ceduo_cells_set_code(to, column + i, row, role, ascii ? '#' : full_block);
    if (length % parts > 0)
        ceduo_cells_set_code(to, column + length / parts, row, role, (uint32_t)(eighth_block + 1 - length % parts));
}

static void draw_axis_left(void *to, const struct ceduo_frame *frame, int count, const struct ceduo_tick *ticks)
{
    for (int row = frame->top; row < frame->top + frame->height; ++row)
        ceduo_cells_label(to, frame->left - 1, row, CEDUO_ROLE_AXIS, "\xe2\x94\x82");
    for (int i = 0; i < count; ++i) {
        ceduo_cells_label(to, frame->left - 1, ticks[i].cell, CEDUO_ROLE_AXIS, "\xe2\x94\xa4");
        if (ticks[i].start >= 0)
            ceduo_cells_label(to, ticks[i].start, ticks[i].cell, CEDUO_ROLE_AXIS, ticks[i].label);
    }
}

/* Meets the left axis in a corner if that was drawn before. */
static void draw_axis_bottom(void *to, const struct ceduo_frame *frame, int count, const struct ceduo_tick *ticks)
{
    int row = frame->top + frame->height;
    const struct ceduo_cell *above = ceduo_cells_at(to, frame->left - 1, row - 1);
    if (above && above->code != 0 && above->role == CEDUO_ROLE_AXIS)
        ceduo_cells_label(to, frame->left - 1, row, CEDUO_ROLE_AXIS, "\xe2\x94\x94");
    for (int column = frame->left; column < frame->left + frame->width; ++column)
        ceduo_cells_label(to, column, row, CEDUO_ROLE_AXIS, "\xe2\x94\x80");
    for (int i = 0; i < count; ++i) {
        ceduo_cells_label(to, ticks[i].cell, row, CEDUO_ROLE_AXIS, "\xe2\x94\xac");
        ceduo_cells_label(to, ticks[i].start, row + 1, CEDUO_ROLE_AXIS, ticks[i].label);
    }
}

static void draw_axis_unit(void *to, int column, int row, const char *unit)
{
    ceduo_cells_label(to, column, row, CEDUO_ROLE_AXIS, unit);
}

static void start_cloud(void *to)
{
    struct ceduo_cells *cells = to;
    free(cells->density);
    cells->density = ceduo_must(calloc(ceduo_cells_dots(cells), sizeof *cells->density));
}

/* How many dots were passed, but no more than `limit` times. */
static size_t passed_dots(const struct ceduo_cells *cells, uint32_t limit)
{
    size_t n = ceduo_cells_dots(cells);
    size_t passed = 0;
    for (size_t i = 0; i < n; ++i)
        passed += cells->density[i] > 0 && cells->density[i] <= limit;
    return passed;
}

/* Halves the range of counts rather than sorting them: no memory, and few passes. */
static uint32_t density_level(const struct ceduo_cells *cells, double quantile)
{
    size_t all = passed_dots(cells, UINT32_MAX), n = ceduo_cells_dots(cells);
    uint32_t lo = 1, hi = 0;
    for (size_t i = 0; i < n; ++i)
        hi = cells->density[i] > hi ? cells->density[i] : hi;
    if (hi == 0)
        return 0;
    double wanted = quantile > 0.0 ? fmax(fmin(quantile, 1.0) * (double)all, 1.0) : 1.0;
    while (lo < hi) {
        uint32_t middle = lo + (hi - lo) / 2;
        if ((double)passed_dots(cells, middle) >= wanted)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

static void show_cloud(void *to, double quantile)
{
    struct ceduo_cells *cells = to;
    uint32_t level = cells->density ? density_level(cells, quantile) : 0;
    int width = cells->width * cells->canvas.dots_x, height = cells->height * cells->canvas.dots_y;
    const uint32_t *count = cells->density;
    for (int y = 0; level > 0 && y < height; ++y)
        for (int x = 0; x < width; ++x, ++count)
            if (*count >= level)
                ceduo_cells_set_dot(cells, x, y, CEDUO_ROLE_CLOUD);
}

static int put_label(void *to, int column, int row, enum ceduo_role role, const char *text)
{
    return ceduo_cells_label(to, column, row, role, text);
}

static int label_width(const void *to, const char *text)
{
    const struct ceduo_cells *cells = to;
    return ceduo_cells_label_width(cells->charset, text);
}

static bool is_blank(const void *to, int column, int row)
{
    return ceduo_cells_glyph(to, column, row) == ' ';
}

const struct ceduo_surface ceduo_cells_surface = {
    .label = put_label,
    .label_width = label_width,
    .is_blank = is_blank,
    .line = draw_line,
    .bar = draw_bar,
    .axis_left = draw_axis_left,
    .axis_bottom = draw_axis_bottom,
    .axis_unit = draw_axis_unit,
    .cloud_start = start_cloud,
    .cloud_show = show_cloud,
};
