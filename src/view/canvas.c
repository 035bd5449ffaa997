/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "canvas.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The canvas ---- */

int ceduo_canvas_dots_x(enum ceduo_charset charset)
{
    return charset == CEDUO_CHARSET_ASCII ? 1 : 2;
}

int ceduo_canvas_dots_y(enum ceduo_charset charset)
{
    return charset == CEDUO_CHARSET_BRAILLE ? 4 : 2;
}

static size_t cell_count(const struct ceduo_canvas *canvas)
{
    return (size_t)canvas->width * (size_t)canvas->height;
}

static size_t dot_count(const struct ceduo_canvas *canvas)
{
    int per_cell = ceduo_canvas_dots_x(canvas->charset) * ceduo_canvas_dots_y(canvas->charset);
    return cell_count(canvas) * (size_t)per_cell;
}

struct ceduo_canvas *ceduo_canvas_create(int width, int height, enum ceduo_charset charset)
{
    if (width < 1 || width > CEDUO_CANVAS_MAX_WIDTH || height < 1 || height > CEDUO_CANVAS_MAX_HEIGHT) {
        return NULL;
    }
    struct ceduo_canvas *canvas = calloc(1, sizeof *canvas);
    if (canvas == NULL) {
        return NULL;
    }
    canvas->width = width;
    canvas->height = height;
    canvas->charset = charset;
    canvas->cells = calloc(cell_count(canvas), sizeof *canvas->cells);
    if (canvas->cells == NULL) {
        free(canvas);
        return NULL;
    }
    return canvas;
}

void ceduo_canvas_free(struct ceduo_canvas *canvas)
{
    if (canvas == NULL) {
        return;
    }
    free(canvas->density);
    free(canvas->cells);
    free(canvas);
}

void ceduo_canvas_clear(struct ceduo_canvas *canvas)
{
    memset(canvas->cells, 0, cell_count(canvas) * sizeof *canvas->cells);
    if (canvas->density != NULL) {
        memset(canvas->density, 0, dot_count(canvas) * sizeof *canvas->density);
    }
}

/* NULL outside the canvas. */
static struct ceduo_canvas_cell *cell_at(const struct ceduo_canvas *canvas, int column, int row)
{
    if (column < 0 || column >= canvas->width || row < 0 || row >= canvas->height) {
        return NULL;
    }
    return &canvas->cells[(size_t)row * (size_t)canvas->width + (size_t)column];
}

/* The higher rank gives the cell its role: what is thin and asked for wins over what fills. */
static int role_rank(unsigned role)
{
    static const uint8_t ranks[CEDUO_ROLE_COUNT] = {
        [CEDUO_ROLE_BLANK] = 0,    [CEDUO_ROLE_DIM] = 1,     [CEDUO_ROLE_AXIS] = 2,   [CEDUO_ROLE_CLOUD] = 3,
        [CEDUO_ROLE_GROUND] = 4,   [CEDUO_ROLE_BELT] = 5,    [CEDUO_ROLE_STOOL] = 6,  [CEDUO_ROLE_STEM] = 7,
        [CEDUO_ROLE_ENVELOPE] = 8, [CEDUO_ROLE_BARE] = 9,    [CEDUO_ROLE_WOOD] = 10,  [CEDUO_ROLE_MEAN] = 11,
        [CEDUO_ROLE_GOOD] = 12,    [CEDUO_ROLE_WARN] = 13,   [CEDUO_ROLE_BAD] = 14,   [CEDUO_ROLE_CONTROL] = 15,
        [CEDUO_ROLE_WAY] = 16,     [CEDUO_ROLE_CURSOR] = 17, [CEDUO_ROLE_TITLE] = 18, [CEDUO_ROLE_TEXT] = 19,
    };
    assert(role < CEDUO_ROLE_COUNT);
    return ranks[role];
}

/* x and y in dots of the whole canvas. */
static void set_dot(struct ceduo_canvas *canvas, int x, int y, enum ceduo_role role)
{
    if (x < 0 || y < 0 || role == CEDUO_ROLE_BLANK) {
        return;
    }
    int across = ceduo_canvas_dots_x(canvas->charset);
    int down = ceduo_canvas_dots_y(canvas->charset);
    struct ceduo_canvas_cell *cell = cell_at(canvas, x / across, y / down);
    if (cell == NULL) {
        return;
    }
    unsigned bit = (unsigned)(y % down * across + x % across);
    cell->dots = (uint8_t)(cell->dots | 1U << bit);
    if (cell->code == 0 && role_rank(role) > role_rank(cell->role)) {
        cell->role = (uint8_t)role;
    }
}

static void set_code(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, uint32_t code)
{
    struct ceduo_canvas_cell *cell = cell_at(canvas, column, row);
    if (cell == NULL || role == CEDUO_ROLE_BLANK) {
        return;
    }
    cell->code = code;
    cell->role = (uint8_t)role;
}

/* ---- Frames ---- */

static bool frame_cells_valid(const struct ceduo_frame *frame)
{
    return frame->width >= 2 && frame->width <= CEDUO_CANVAS_MAX_WIDTH && frame->height >= 1 &&
           frame->height <= CEDUO_CANVAS_MAX_HEIGHT && abs(frame->left) <= CEDUO_CANVAS_MAX_WIDTH &&
           abs(frame->top) <= CEDUO_CANVAS_MAX_HEIGHT;
}

static bool range_valid(double from, double to)
{
    return isfinite(from) && isfinite(to) && isfinite(to - from) && from != to;
}

static bool frame_valid(const struct ceduo_frame *frame)
{
    return frame_cells_valid(frame) && range_valid(frame->x0, frame->x1) && range_valid(frame->y0, frame->y1);
}

/* The dots of a frame: its corner in dots of the canvas, and how many there are. */
struct raster {
    const struct ceduo_frame *frame;
    int left, top, nx, ny;
};

/* A position in dots from the corner of a raster, y down; whole numbers are the middles of dots. */
struct position {
    double x, y;
};

static struct raster raster_of(const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    int across = ceduo_canvas_dots_x(charset);
    int down = ceduo_canvas_dots_y(charset);
    return (struct raster){frame, frame->left * across, frame->top * down, frame->width * across, frame->height * down};
}

/* False if the point is not finite, or too far off for its place to be. */
static bool place(const struct raster *raster, double x, double y, struct position *out)
{
    const struct ceduo_frame *frame = raster->frame;
    out->x = (x - frame->x0) / (frame->x1 - frame->x0) * (raster->nx - 1);
    out->y = (frame->y1 - y) / (frame->y1 - frame->y0) * (raster->ny - 1);
    return isfinite(out->x) && isfinite(out->y);
}

static bool inside(const struct raster *raster, struct position p)
{
    return p.x >= -0.5 && p.x <= raster->nx - 0.5 && p.y >= -0.5 && p.y <= raster->ny - 0.5;
}

/* The nearest of n dots. */
static int nearest(double position, int n)
{
    if (position <= 0.0) {
        return 0;
    }
    return position >= n - 1 ? n - 1 : (int)lround(position);
}

/* The width and height of a dot, in halves of a cell's width, where a cell is twice as high as wide. */
static double dot_width(enum ceduo_charset charset)
{
    return 2.0 / ceduo_canvas_dots_x(charset);
}

static double dot_height(enum ceduo_charset charset)
{
    return 4.0 / ceduo_canvas_dots_y(charset);
}

bool ceduo_frame_true_scale(struct ceduo_frame *frame, enum ceduo_charset charset, double x_lo, double x_hi,
                            double y_lo, double y_hi)
{
    double x_range = x_hi - x_lo;
    double y_range = y_hi - y_lo;
    if (!frame_cells_valid(frame) || !isfinite(x_range) || !isfinite(y_range) || x_range < 0.0 || y_range < 0.0) {
        return false;
    }
    struct raster raster = raster_of(frame, charset);
    double x_length = (raster.nx - 1) * dot_width(charset);
    double y_length = (raster.ny - 1) * dot_height(charset);
    double metres = fmax(x_range / x_length, y_range / y_length); /* per unit of length */
    double x_spare = metres * x_length - x_range;
    double y_spare = metres * y_length - y_range;
    struct ceduo_frame scaled = *frame;
    scaled.x0 = x_lo - 0.5 * x_spare;
    scaled.x1 = x_hi + 0.5 * x_spare;
    scaled.y0 = y_lo - 0.5 * y_spare;
    scaled.y1 = y_hi + 0.5 * y_spare;
    if (!frame_valid(&scaled)) {
        return false;
    }
    *frame = scaled;
    return true;
}

double ceduo_frame_exaggeration(const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    if (!frame_valid(frame)) {
        return (double)NAN;
    }
    struct raster raster = raster_of(frame, charset);
    double x_metres = fabs(frame->x1 - frame->x0) / ((raster.nx - 1) * dot_width(charset));
    double y_metres = fabs(frame->y1 - frame->y0) / ((raster.ny - 1) * dot_height(charset));
    return x_metres / y_metres;
}

bool ceduo_frame_cell(const struct ceduo_frame *frame, enum ceduo_charset charset, double x, double y, int *column,
                      int *row)
{
    if (!frame_valid(frame)) {
        return false;
    }
    struct raster raster = raster_of(frame, charset);
    struct position p;
    if (!place(&raster, x, y, &p) || !inside(&raster, p)) {
        return false;
    }
    *column = frame->left + nearest(p.x, raster.nx) / ceduo_canvas_dots_x(charset);
    *row = frame->top + nearest(p.y, raster.ny) / ceduo_canvas_dots_y(charset);
    return true;
}

/* ---- Drawing data ---- */

/* Draws dots, or counts them; a way counts once in a dot in which one of its segments ends. */
struct pen {
    struct ceduo_canvas *canvas;
    struct raster raster;
    enum ceduo_role role;
    bool counts;
    int last_x, last_y;
};

static struct pen pen_of(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role)
{
    return (struct pen){canvas, raster_of(frame, canvas->charset), role, false, INT_MIN, INT_MIN};
}

static void count_dot(struct pen *pen, int x, int y)
{
    int width = pen->canvas->width * ceduo_canvas_dots_x(pen->canvas->charset);
    int height = pen->canvas->height * ceduo_canvas_dots_y(pen->canvas->charset);
    if (x < 0 || x >= width || y < 0 || y >= height || (x == pen->last_x && y == pen->last_y)) {
        return;
    }
    pen->last_x = x;
    pen->last_y = y;
    uint32_t *count = &pen->canvas->density[(size_t)y * (size_t)width + (size_t)x];
    if (*count < UINT32_MAX) {
        ++*count;
    }
}

/* x and y in dots of the frame. */
static void pen_dot(struct pen *pen, int x, int y)
{
    x += pen->raster.left;
    y += pen->raster.top;
    if (pen->counts) {
        count_dot(pen, x, y);
    } else {
        set_dot(pen->canvas, x, y, pen->role);
    }
}

/* One edge of Liang and Barsky's clipping (1984): keeps the part lo..hi of the line with p t <= q. */
static bool clip_edge(double p, double q, double *lo, double *hi)
{
    if (p == 0.0) {
        return q >= 0.0;
    }
    double t = q / p;
    if (p < 0.0) {
        *lo = fmax(*lo, t);
    } else {
        *hi = fmin(*hi, t);
    }
    return *lo <= *hi;
}

static bool clip(const struct raster *raster, struct position *a, struct position *b)
{
    double dx = b->x - a->x;
    double dy = b->y - a->y;
    double lo = 0.0;
    double hi = 1.0;
    if (!isfinite(dx) || !isfinite(dy) || !clip_edge(-dx, a->x + 0.5, &lo, &hi) ||
        !clip_edge(dx, raster->nx - 0.5 - a->x, &lo, &hi) || !clip_edge(-dy, a->y + 0.5, &lo, &hi) ||
        !clip_edge(dy, raster->ny - 0.5 - a->y, &lo, &hi)) {
        return false;
    }
    *b = (struct position){a->x + hi * dx, a->y + hi * dy};
    *a = (struct position){a->x + lo * dx, a->y + lo * dy};
    return true;
}

static void pen_line(struct pen *pen, double ax, double ay, double bx, double by)
{
    const struct raster *raster = &pen->raster;
    struct position a, b;
    if (!place(raster, ax, ay, &a) || !place(raster, bx, by, &b) || !clip(raster, &a, &b)) {
        return;
    }
    int x = nearest(a.x, raster->nx);
    int y = nearest(a.y, raster->ny);
    int dx = nearest(b.x, raster->nx) - x;
    int dy = nearest(b.y, raster->ny) - y;
    int steps = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
    pen_dot(pen, x, y);
    for (int i = 1; i <= steps; ++i) {
        double part = (double)i / steps;
        pen_dot(pen, x + (int)lround(part * dx), y + (int)lround(part * dy));
    }
}

static void pen_polyline(struct pen *pen, size_t n, const double *x, const double *y)
{
    for (size_t i = 0; i < n; ++i) {
        bool follows = i > 0 && isfinite(x[i - 1]) && isfinite(y[i - 1]);
        size_t from = follows ? i - 1 : i;
        pen_line(pen, x[from], y[from], x[i], y[i]);
    }
}

void ceduo_canvas_point(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x,
                        double y)
{
    ceduo_canvas_line(canvas, frame, role, x, y, x, y);
}

void ceduo_canvas_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double ax,
                       double ay, double bx, double by)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    pen_line(&pen, ax, ay, bx, by);
}

void ceduo_canvas_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                           const double *x, const double *y)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    pen_polyline(&pen, n, x, y);
}

void ceduo_canvas_steps(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                        const double *x, const double *y)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    for (size_t i = 0; i < n; ++i) {
        bool follows = i > 0 && isfinite(x[i - 1]) && isfinite(y[i - 1]) && isfinite(y[i]);
        if (follows) {
            pen_line(&pen, x[i - 1], y[i - 1], x[i], y[i - 1]);
            pen_line(&pen, x[i], y[i - 1], x[i], y[i]);
        } else {
            pen_line(&pen, x[i], y[i], x[i], y[i]);
        }
    }
}

/* The height of a curve's segment at column x; of an upright segment the upper end, so that a cliff is filled. */
static double height_at(struct position a, struct position b, double x)
{
    if (!(b.x > a.x)) {
        return fmin(a.y, b.y);
    }
    double part = fmin(fmax((x - a.x) / (b.x - a.x), 0.0), 1.0);
    return a.y + part * (b.y - a.y);
}

static void fill_segment(struct pen *pen, struct position a, struct position b)
{
    /* The ends of a range come out of floating point a little beside their dots. */
    const double slack = 1e-6;
    const struct raster *raster = &pen->raster;
    if (a.x > b.x) {
        struct position c = a;
        a = b;
        b = c;
    }
    double first = fmax(ceil(a.x - slack), 0.0);
    double last = fmin(floor(b.x + slack), raster->nx - 1);
    if (first > last) {
        return;
    }
    for (int x = (int)first; x <= (int)last; ++x) {
        double top = height_at(a, b, x);
        if (!(top <= raster->ny - 0.5)) {
            continue;
        }
        for (int y = nearest(top, raster->ny); y < raster->ny; ++y) {
            pen_dot(pen, x, y);
        }
    }
}

void ceduo_canvas_fill_below(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                             size_t n, const double *x, const double *y)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    for (size_t i = 1; i < n; ++i) {
        struct position a, b;
        if (place(&pen.raster, x[i - 1], y[i - 1], &a) && place(&pen.raster, x[i], y[i], &b)) {
            fill_segment(&pen, a, b);
        }
    }
}

void ceduo_canvas_rule_y(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double y)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    struct position p;
    if (!place(&pen.raster, frame->x0, y, &p) || !inside(&pen.raster, p)) {
        return;
    }
    for (int x = 0; x < pen.raster.nx; x += 2) {
        pen_dot(&pen, x, nearest(p.y, pen.raster.ny));
    }
}

void ceduo_canvas_rule_x(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x)
{
    if (!frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, role);
    struct position p;
    if (!place(&pen.raster, x, frame->y1, &p) || !inside(&pen.raster, p)) {
        return;
    }
    for (int y = 0; y < pen.raster.ny; y += 2) {
        pen_dot(&pen, nearest(p.x, pen.raster.nx), y);
    }
}

void ceduo_canvas_bar(struct ceduo_canvas *canvas, int column, int row, int width, double fraction,
                      enum ceduo_role role)
{
    enum { full_block = 0x2588, eighth_block = 0x258F };
    if (!(fraction > 0.0) || width < 1 || width > CEDUO_CANVAS_MAX_WIDTH) {
        return;
    }
    bool ascii = canvas->charset == CEDUO_CHARSET_ASCII;
    int parts = ascii ? 1 : 8; /* of a cell */
    int length = (int)lround(fmin(fraction, 1.0) * width * parts);
    if (length < 1) {
        length = 1;
    }
    for (int i = 0; i < length / parts; ++i) {
        set_code(canvas, column + i, row, role, ascii ? '#' : full_block);
    }
    int rest = length % parts;
    if (rest > 0) {
        set_code(canvas, column + length / parts, row, role, (uint32_t)(eighth_block + 1 - rest));
    }
}

/* ---- Density ---- */

bool ceduo_canvas_density_start(struct ceduo_canvas *canvas)
{
    free(canvas->density);
    canvas->density = calloc(dot_count(canvas), sizeof *canvas->density);
    return canvas->density != NULL;
}

void ceduo_canvas_density_add_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, double ax, double ay,
                                   double bx, double by)
{
    const double x[] = {ax, bx};
    const double y[] = {ay, by};
    /* As a polyline, a line with one bad end would still count its good one. */
    bool finite = isfinite(ax) && isfinite(ay) && isfinite(bx) && isfinite(by);
    ceduo_canvas_density_add_polyline(canvas, frame, finite ? 2 : 0, x, y);
}

void ceduo_canvas_density_add_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, size_t n,
                                       const double *x, const double *y)
{
    if (canvas->density == NULL || !frame_valid(frame)) {
        return;
    }
    struct pen pen = pen_of(canvas, frame, CEDUO_ROLE_CLOUD);
    pen.counts = true;
    pen_polyline(&pen, n, x, y);
}

/* How many dots were passed, but no more than `limit` times. */
static size_t passed_dots(const struct ceduo_canvas *canvas, uint32_t limit)
{
    size_t n = dot_count(canvas);
    size_t passed = 0;
    for (size_t i = 0; i < n; ++i) {
        passed += canvas->density[i] > 0 && canvas->density[i] <= limit;
    }
    return passed;
}

/* Halves the range of counts rather than sorting them: no memory, and at most 32 passes. */
static uint32_t density_level(const struct ceduo_canvas *canvas, double quantile)
{
    size_t all = passed_dots(canvas, UINT32_MAX);
    if (all == 0) {
        return 0;
    }
    double wanted = quantile > 0.0 ? fmax(fmin(quantile, 1.0) * (double)all, 1.0) : 1.0;
    uint32_t lo = 1;
    uint32_t hi = UINT32_MAX;
    while (lo < hi) {
        uint32_t middle = lo + (hi - lo) / 2;
        if ((double)passed_dots(canvas, middle) >= wanted) {
            hi = middle;
        } else {
            lo = middle + 1;
        }
    }
    return lo;
}

uint32_t ceduo_canvas_density_show(struct ceduo_canvas *canvas, double quantile)
{
    uint32_t level = canvas->density == NULL ? 0 : density_level(canvas, quantile);
    if (level == 0) {
        return 0;
    }
    int width = canvas->width * ceduo_canvas_dots_x(canvas->charset);
    int height = canvas->height * ceduo_canvas_dots_y(canvas->charset);
    const uint32_t *count = canvas->density;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, ++count) {
            if (*count >= level) {
                set_dot(canvas, x, y, CEDUO_ROLE_CLOUD);
            }
        }
    }
    return level;
}

/* ---- Text ---- */

/* Reads one code point of UTF-8 (RFC 3629); an invalid byte is read alone, as '?'. */
static uint32_t decode(const char **text)
{
    const unsigned char *s = (const unsigned char *)*text;
    ++*text;
    if (s[0] < 0x80) {
        return s[0];
    }
    int more = s[0] >= 0xC2 && s[0] < 0xE0 ? 1 : s[0] >= 0xE0 && s[0] < 0xF0 ? 2 : s[0] >= 0xF0 && s[0] < 0xF5 ? 3 : 0;
    if (more == 0) {
        return '?';
    }
    uint32_t code = s[0] & (0x3FU >> more);
    for (int i = 1; i <= more; ++i) {
        if ((s[i] & 0xC0) != 0x80) {
            return '?';
        }
        code = code << 6 | (s[i] & 0x3FU);
    }
    bool overlong = (more == 2 && code < 0x800) || (more == 3 && code < 0x10000);
    if (overlong || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF) {
        return '?';
    }
    *text += more;
    return code;
}

/*
 * Characters of no width or of two cells would shift the rest of their row. These are the common
 * ranges of both; marks of scripts beyond Latin, Greek, Cyrillic, Hebrew and Arabic are not told apart.
 */
static bool takes_one_cell(uint32_t code)
{
    static const uint32_t others[][2] = {
        {0x00, 0x1F},       {0x7F, 0x9F},       {0xAD, 0xAD},       {0x300, 0x36F},     {0x483, 0x489},
        {0x591, 0x5BD},     {0x610, 0x61A},     {0x64B, 0x65F},     {0x1100, 0x11FF},   {0x1AB0, 0x1AFF},
        {0x1DC0, 0x1DFF},   {0x200B, 0x200F},   {0x2028, 0x202E},   {0x2060, 0x206F},   {0x20D0, 0x20FF},
        {0x231A, 0x231B},   {0x2329, 0x232A},   {0x23E9, 0x23EC},   {0x23F0, 0x23F0},   {0x23F3, 0x23F3},
        {0x25FD, 0x25FE},   {0x2614, 0x2615},   {0x2648, 0x2653},   {0x267F, 0x267F},   {0x2693, 0x2693},
        {0x26A1, 0x26A1},   {0x26AA, 0x26AB},   {0x26BD, 0x26BE},   {0x26C4, 0x26C5},   {0x26CE, 0x26CE},
        {0x26D4, 0x26D4},   {0x26EA, 0x26EA},   {0x26F2, 0x26F3},   {0x26F5, 0x26F5},   {0x26FA, 0x26FA},
        {0x26FD, 0x26FD},   {0x2705, 0x2705},   {0x270A, 0x270B},   {0x2728, 0x2728},   {0x274C, 0x274C},
        {0x274E, 0x274E},   {0x2753, 0x2755},   {0x2757, 0x2757},   {0x2795, 0x2797},   {0x27B0, 0x27B0},
        {0x27BF, 0x27BF},   {0x2B1B, 0x2B1C},   {0x2B50, 0x2B50},   {0x2B55, 0x2B55},   {0x2E80, 0x303E},
        {0x3041, 0xA4CF},   {0xA960, 0xA97F},   {0xAC00, 0xD7FF},   {0xF900, 0xFAFF},   {0xFE00, 0xFE6F},
        {0xFEFF, 0xFF60},   {0xFFE0, 0xFFE6},   {0x16FE0, 0x18DFF}, {0x1AFF0, 0x1B2FF}, {0x1F004, 0x1F004},
        {0x1F0CF, 0x1F0CF}, {0x1F18E, 0x1F18E}, {0x1F191, 0x1F19A}, {0x1F200, 0x1F64F}, {0x1F680, 0x1F6FF},
        {0x1F7E0, 0x1F7F0}, {0x1F900, 0x1FAFF}, {0x20000, 0x3FFFF}, {0xE0000, 0xE0FFF},
    };
    for (size_t i = 0; i < sizeof others / sizeof others[0] && others[i][0] <= code; ++i) {
        if (code <= others[i][1]) {
            return false;
        }
    }
    return true;
}

/* What stands for a character that is not ASCII; of the degree a blank, as "35o" reads like 350. */
static const char *ascii_for(uint32_t code)
{
    static const struct {
        uint16_t first, last;
        char text[4];
    } table[] = {
        {0xA0, 0xA0, " "},      {0xAB, 0xAB, "\""},     {0xB0, 0xB0, " "},       {0xB1, 0xB1, "+-"},
        {0xB2, 0xB2, "2"},      {0xB3, 0xB3, "3"},      {0xB5, 0xB5, "u"},       {0xB7, 0xB7, "."},
        {0xBB, 0xBB, "\""},     {0xC0, 0xC3, "A"},      {0xC4, 0xC4, "Ae"},      {0xC5, 0xC5, "A"},
        {0xC6, 0xC6, "AE"},     {0xC7, 0xC7, "C"},      {0xC8, 0xCB, "E"},       {0xCC, 0xCF, "I"},
        {0xD1, 0xD1, "N"},      {0xD2, 0xD5, "O"},      {0xD6, 0xD6, "Oe"},      {0xD7, 0xD7, "x"},
        {0xD8, 0xD8, "O"},      {0xD9, 0xDB, "U"},      {0xDC, 0xDC, "Ue"},      {0xDD, 0xDD, "Y"},
        {0xDF, 0xDF, "ss"},     {0xE0, 0xE3, "a"},      {0xE4, 0xE4, "ae"},      {0xE5, 0xE5, "a"},
        {0xE6, 0xE6, "ae"},     {0xE7, 0xE7, "c"},      {0xE8, 0xEB, "e"},       {0xEC, 0xEF, "i"},
        {0xF1, 0xF1, "n"},      {0xF2, 0xF5, "o"},      {0xF6, 0xF6, "oe"},      {0xF7, 0xF7, "/"},
        {0xF8, 0xF8, "o"},      {0xF9, 0xFB, "u"},      {0xFC, 0xFC, "ue"},      {0xFD, 0xFD, "y"},
        {0xFF, 0xFF, "y"},      {0x2002, 0x200A, " "},  {0x2010, 0x2015, "-"},   {0x2018, 0x2019, "'"},
        {0x201C, 0x201E, "\""}, {0x2022, 0x2022, "*"},  {0x2026, 0x2026, "..."}, {0x202F, 0x202F, " "},
        {0x2032, 0x2032, "'"},  {0x2190, 0x2190, "<-"}, {0x2191, 0x2191, "^"},   {0x2192, 0x2192, "->"},
        {0x2193, 0x2193, "v"},  {0x2205, 0x2205, "O"},  {0x2212, 0x2212, "-"},   {0x221E, 0x221E, "inf"},
        {0x2248, 0x2248, "~"},  {0x2260, 0x2260, "!="}, {0x2264, 0x2264, "<="},  {0x2265, 0x2265, ">="},
        {0x2500, 0x2501, "-"},  {0x2502, 0x2503, "|"},  {0x250C, 0x254B, "+"},   {0x2550, 0x2550, "="},
        {0x2551, 0x2551, "|"},  {0x2552, 0x2570, "+"},  {0x2580, 0x2590, "#"},   {0x2591, 0x2591, "."},
        {0x2592, 0x2592, ":"},  {0x2593, 0x2593, "#"},  {0x25A0, 0x25A0, "#"},   {0x25B2, 0x25B3, "^"},
        {0x25B6, 0x25B8, ">"},  {0x25BC, 0x25BD, "v"},  {0x25C0, 0x25C2, "<"},   {0x25C6, 0x25C7, "*"},
        {0x25CB, 0x25CB, "o"},  {0x25CF, 0x25CF, "o"},  {0x2660, 0x2660, "Y"},   {0x2663, 0x2663, "Y"},
        {0x26A0, 0x26A0, "!"},  {0x2713, 0x2714, "+"},  {0x2717, 0x2718, "x"},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i) {
        if (code >= table[i].first && code <= table[i].last) {
            return table[i].text;
        }
    }
    return "?";
}

/* Walks through a text as it will be written, one cell after the other. */
struct reader {
    enum ceduo_charset charset;
    const char *text;
    const char *pending; /* the rest of an ASCII equivalent, in a constant table */
};

/* 0 at the end. */
static uint32_t next_code(struct reader *reader)
{
    if (*reader->pending != '\0') {
        return (uint32_t)*reader->pending++;
    }
    if (*reader->text == '\0') {
        return 0;
    }
    uint32_t code = decode(&reader->text);
    if (!takes_one_cell(code)) {
        return '?';
    }
    if (reader->charset != CEDUO_CHARSET_ASCII || code < 0x80) {
        return code;
    }
    reader->pending = ascii_for(code);
    return (uint32_t)*reader->pending++;
}

int ceduo_canvas_label(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text)
{
    struct reader reader = {canvas->charset, text, ""};
    int cells = 0;
    uint32_t code;
    while (cells < INT_MAX && (code = next_code(&reader)) != 0) {
        if (column < canvas->width) {
            set_code(canvas, column++, row, role, code);
        }
        ++cells;
    }
    return cells;
}

int ceduo_canvas_label_right(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text)
{
    return ceduo_canvas_label(canvas, column + 1 - ceduo_canvas_label_width(canvas->charset, text), row, role, text);
}

int ceduo_canvas_label_width(enum ceduo_charset charset, const char *text)
{
    struct reader reader = {charset, text, ""};
    int cells = 0;
    while (cells < INT_MAX && next_code(&reader) != 0) {
        ++cells;
    }
    return cells;
}

/* ---- Ticks ---- */

/* A step of 1, 2 or 5 times a power of ten, kept in parts: 3 / 10 is 0.3, but 3 * 0.1 is not. */
struct step {
    int mantissa, exponent;
};

static double tick_value(double index, struct step step)
{
    double steps = index * step.mantissa;
    return step.exponent < 0 ? steps / pow(10.0, -step.exponent) : steps * pow(10.0, step.exponent);
}

static struct step coarser(struct step step)
{
    switch (step.mantissa) {
    case 1:
        return (struct step){2, step.exponent};
    case 2:
        return (struct step){5, step.exponent};
    default:
        return (struct step){1, step.exponent + 1};
    }
}

/* The first and last multiple of the step in lo..hi; returns how many there are. */
static double multiples(double lo, double hi, struct step step, double *first)
{
    const double slack = 1e-9; /* of a step: 0.3 belongs to 0..3 * 0.1 */
    double size = tick_value(1.0, step);
    *first = ceil(lo / size - slack);
    return floor(hi / size + slack) - *first + 1.0;
}

static int one_tick(double value, double *out, double *step)
{
    *out = value == 0.0 ? 0.0 : value;
    *step = 0.0;
    return 1;
}

int ceduo_ticks(double lo, double hi, int max_count, double *out, double *step)
{
    double ignored;
    step = step == NULL ? &ignored : step;
    *step = 0.0;
    double from = fmin(lo, hi);
    double to = fmax(lo, hi);
    double range = to - from;
    if (max_count < 1 || !isfinite(lo) || !isfinite(hi) || range > 1e300) {
        return 0;
    }
    if (range < 1e-300 || range < 1e-12 * fmax(fabs(from), fabs(to))) {
        return one_tick(lo, out, step);
    }
    max_count = max_count < CEDUO_TICKS_MAX ? max_count : CEDUO_TICKS_MAX;
    struct step size = {1, (int)floor(log10(range / max_count))};
    double first;
    double count = multiples(from, to, size, &first);
    while (count > max_count) {
        double next_first;
        double next = multiples(from, to, coarser(size), &next_first);
        if (next < 1.0) {
            break; /* 6..8 has no multiple of 5; a tick at 6 alone is better than none */
        }
        size = coarser(size);
        count = next;
        first = next_first;
    }
    int n = (int)fmin(count, max_count);
    for (int i = 0; i < n; ++i) {
        out[i] = tick_value(first + i, size); /* ceil may have made first -0; -0 + 0 is 0 */
    }
    *step = tick_value(1.0, size);
    return n;
}

/* 2e+11 and 5e-09 as 2e11 and 5e-9. */
static void shorten_exponent(char *text)
{
    char *exponent = strchr(text, 'e');
    if (exponent == NULL) {
        return;
    }
    char *to = exponent + 1;
    const char *from = to;
    if (*from == '-') {
        ++to;
        ++from;
    }
    from += strspn(from, "+0");
    memmove(to, from, strlen(from) + 1);
}

size_t ceduo_tick_label(double value, double step, size_t size, char *buffer)
{
    char text[CEDUO_TICK_LABEL_SIZE];
    double place_of_step = step > 0.0 ? floor(log10(step) + 1e-9) : 0.0;
    int decimals = place_of_step < 0.0 ? (int)-place_of_step : 0;
    if (!(step > 0.0)) {
        snprintf(text, sizeof text, "%.6g", value);
    } else if (decimals <= 6 && fabs(value) < 1e7) {
        snprintf(text, sizeof text, "%.*f", decimals, value);
    } else {
        double digits = value == 0.0 ? 1.0 : floor(log10(fabs(value)) + 1e-9) - place_of_step + 1.0;
        snprintf(text, sizeof text, "%.*g", (int)fmin(fmax(digits, 1.0), 17.0), value);
    }
    shorten_exponent(text);
    const char *from = text;
    if (*from == '-' && strpbrk(from, "123456789in") == NULL) {
        ++from; /* rounded to "-0.0" */
    }
    size_t length = strlen(from);
    if (size == 0) {
        return 0;
    }
    length = length < size ? length : size - 1;
    memcpy(buffer, from, length);
    buffer[length] = '\0';
    return length;
}

/* ---- Axes ---- */

enum {
    BOX_HORIZONTAL = 0x2500,
    BOX_VERTICAL = 0x2502,
    BOX_CORNER = 0x2514,
    BOX_TICK_LEFT = 0x2524,
    BOX_TICK_DOWN = 0x252C,
};

static void set_line(struct ceduo_canvas *canvas, int column, int row, uint32_t box)
{
    uint32_t code = canvas->charset == CEDUO_CHARSET_ASCII ? (uint32_t)*ascii_for(box) : box;
    set_code(canvas, column, row, CEDUO_ROLE_AXIS, code);
}

/* The labels of an axis: where each tick is (column or row), and on the bottom axis the columns of its text. */
struct scale {
    int count;
    double step;
    double value[CEDUO_TICKS_MAX];
    int tick[CEDUO_TICKS_MAX];
    int start[CEDUO_TICKS_MAX], end[CEDUO_TICKS_MAX];
};

/* False if two labels would stand closer than they should. */
static bool left_scale_fits(struct scale *scale, const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    int apart = frame->height > 3 ? 2 : 1;
    for (int i = 0; i < scale->count; ++i) {
        int column;
        if (!ceduo_frame_cell(frame, charset, frame->x0, scale->value[i], &column, &scale->tick[i])) {
            return false;
        }
        if (i > 0 && abs(scale->tick[i] - scale->tick[i - 1]) < apart) {
            return false;
        }
    }
    return true;
}

static struct scale left_scale(const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    struct scale scale = {0};
    for (int n = frame->height / 2 + 1; n > 0; --n) {
        scale.count = ceduo_ticks(frame->y0, frame->y1, n, scale.value, &scale.step);
        if (left_scale_fits(&scale, frame, charset)) {
            return scale;
        }
    }
    scale.count = 0;
    return scale;
}

int ceduo_frame_axis_width(const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    /* The columns are still to be found: any valid ones, and any x, give the same labels. */
    struct ceduo_frame rows = *frame;
    rows.left = 0;
    rows.width = 2;
    rows.x0 = 0.0;
    rows.x1 = 1.0;
    if (!frame_valid(&rows)) {
        return 0;
    }
    struct scale scale = left_scale(&rows, charset);
    size_t widest = 0;
    for (int i = 0; i < scale.count; ++i) {
        char text[CEDUO_TICK_LABEL_SIZE];
        size_t length = ceduo_tick_label(scale.value[i], scale.step, sizeof text, text);
        widest = length > widest ? length : widest;
    }
    return (int)widest + 1;
}

void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame)
{
    if (!frame_valid(frame)) {
        return;
    }
    int column = frame->left - 1;
    for (int row = frame->top; row < frame->top + frame->height; ++row) {
        set_line(canvas, column, row, BOX_VERTICAL);
    }
    struct scale scale = left_scale(frame, canvas->charset);
    for (int i = 0; i < scale.count; ++i) {
        char text[CEDUO_TICK_LABEL_SIZE];
        int length = (int)ceduo_tick_label(scale.value[i], scale.step, sizeof text, text);
        set_line(canvas, column, scale.tick[i], BOX_TICK_LEFT);
        if (length <= column) {
            ceduo_canvas_label_right(canvas, column - 1, scale.tick[i], CEDUO_ROLE_AXIS, text);
        }
    }
}

/* Which label stands i-th from the left. */
static int from_left(const struct scale *scale, const struct ceduo_frame *frame, int i)
{
    return frame->x0 > frame->x1 ? scale->count - 1 - i : i;
}

enum { LABEL_GAP = 2 }; /* blanks between labels */

/* Sets where each label goes; false if two would collide or one leave the frame. */
static bool bottom_scale_fits(struct scale *scale, const struct ceduo_frame *frame, enum ceduo_charset charset)
{
    int least = frame->left > 0 ? frame->left - 1 : frame->left;
    int end = frame->left + frame->width;
    for (int i = 0; i < scale->count; ++i) {
        int k = from_left(scale, frame, i);
        char text[CEDUO_TICK_LABEL_SIZE];
        int length = (int)ceduo_tick_label(scale->value[k], scale->step, sizeof text, text);
        int row;
        if (!ceduo_frame_cell(frame, charset, scale->value[k], frame->y0, &scale->tick[k], &row)) {
            return false;
        }
        int start = scale->tick[k] - (length - 1) / 2;
        start = start + length > end ? end - length : start;
        start = start < least && i == 0 ? least : start;
        if (start < least || start + length > end) {
            return false;
        }
        scale->start[k] = start;
        scale->end[k] = start + length;
        least = start + length + LABEL_GAP;
    }
    return true;
}

/* Where the unit goes: after the last number or else after the first, moving none. -1 if neither has room. */
static int unit_column(const struct scale *scale, const struct ceduo_frame *frame, int unit_width)
{
    if (scale->count < 1) {
        return -1;
    }
    int after_last = scale->end[from_left(scale, frame, scale->count - 1)] + 1;
    if (after_last + unit_width <= frame->left + frame->width) {
        return after_last;
    }
    int after_first = scale->end[from_left(scale, frame, 0)] + 1;
    if (scale->count > 1 && after_first + unit_width + LABEL_GAP <= scale->start[from_left(scale, frame, 1)]) {
        return after_first;
    }
    return -1;
}

/* The most labels that leave room for the unit too, but two at least; the most of all if there is no such. */
static struct scale bottom_scale(const struct ceduo_frame *frame, enum ceduo_charset charset, int unit_width,
                                 int *unit_start)
{
    struct scale most = {0};
    *unit_start = -1;
    for (int n = frame->width / 3 + 1; n > 0; --n) {
        struct scale scale = {0};
        scale.count = ceduo_ticks(frame->x0, frame->x1, n, scale.value, &scale.step);
        if (!bottom_scale_fits(&scale, frame, charset) || (scale.count < 2 && most.count > 1)) {
            continue;
        }
        most = most.count == 0 ? scale : most;
        *unit_start = unit_column(&scale, frame, unit_width);
        if (unit_width == 0 || *unit_start >= 0) {
            return scale;
        }
    }
    return most;
}

void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit)
{
    if (!frame_valid(frame)) {
        return;
    }
    int row = frame->top + frame->height;
    const struct ceduo_canvas_cell *above = cell_at(canvas, frame->left - 1, row - 1);
    if (above != NULL && above->code != 0 && above->role == CEDUO_ROLE_AXIS) {
        set_line(canvas, frame->left - 1, row, BOX_CORNER);
    }
    for (int column = frame->left; column < frame->left + frame->width; ++column) {
        set_line(canvas, column, row, BOX_HORIZONTAL);
    }
    int unit_start;
    int unit_width = unit == NULL ? 0 : ceduo_canvas_label_width(canvas->charset, unit);
    struct scale scale = bottom_scale(frame, canvas->charset, unit_width, &unit_start);
    for (int i = 0; i < scale.count; ++i) {
        char text[CEDUO_TICK_LABEL_SIZE];
        ceduo_tick_label(scale.value[i], scale.step, sizeof text, text);
        set_line(canvas, scale.tick[i], row, BOX_TICK_DOWN);
        ceduo_canvas_label(canvas, scale.start[i], row + 1, CEDUO_ROLE_AXIS, text);
    }
    if (unit != NULL && unit_start >= 0) {
        ceduo_canvas_label(canvas, unit_start, row + 1, CEDUO_ROLE_AXIS, unit);
    }
}

/* ---- Output ---- */

static uint32_t braille_glyph(unsigned dots)
{
    /* Braille counts its upper six dots column by column, and the lowest two after them. */
    static const uint8_t bits[8] = {0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80};
    uint32_t code = 0x2800;
    for (unsigned i = 0; i < 8; ++i) {
        if (dots >> i & 1U) {
            code |= bits[i];
        }
    }
    return code;
}

static uint32_t block_glyph(unsigned dots)
{
    /* Bits: 1 upper left, 2 upper right, 4 lower left, 8 lower right. */
    static const uint16_t glyphs[16] = {' ',    0x2598, 0x259D, 0x2580, 0x2596, 0x258C, 0x259E, 0x259B,
                                        0x2597, 0x259A, 0x2590, 0x259C, 0x2584, 0x2599, 0x259F, 0x2588};
    return glyphs[dots & 15U];
}

static uint32_t glyph_of(const struct ceduo_canvas_cell *cell, enum ceduo_charset charset)
{
    if (cell->code != 0) {
        return cell->code;
    }
    if (cell->dots == 0) {
        return ' ';
    }
    switch (charset) {
    case CEDUO_CHARSET_BRAILLE:
        return braille_glyph(cell->dots);
    case CEDUO_CHARSET_BLOCK:
        return block_glyph(cell->dots);
    case CEDUO_CHARSET_ASCII:
        break;
    }
    return (uint32_t) " '.:"[cell->dots & 3U];
}

uint32_t ceduo_canvas_glyph(const struct ceduo_canvas *canvas, int column, int row)
{
    const struct ceduo_canvas_cell *cell = cell_at(canvas, column, row);
    return cell == NULL ? ' ' : glyph_of(cell, canvas->charset);
}

enum ceduo_role ceduo_canvas_role(const struct ceduo_canvas *canvas, int column, int row)
{
    const struct ceduo_canvas_cell *cell = cell_at(canvas, column, row);
    return cell == NULL ? CEDUO_ROLE_BLANK : (enum ceduo_role)cell->role;
}

/* Writes the UTF-8 of a code point; returns its length in bytes. */
static size_t encode(uint32_t code, char bytes[4])
{
    if (code < 0x80) {
        bytes[0] = (char)code;
        return 1;
    }
    size_t more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    for (size_t i = more; i > 0; --i) {
        bytes[i] = (char)(0x80U | (code & 0x3FU));
        code >>= 6;
    }
    bytes[0] = (char)((0xFF00U >> (more + 1) & 0xFFU) | code);
    return more + 1;
}

size_t ceduo_canvas_text(const struct ceduo_canvas *canvas, int row, size_t size, char *buffer)
{
    int end = canvas->width;
    while (end > 0 && ceduo_canvas_glyph(canvas, end - 1, row) == ' ') {
        --end;
    }
    size_t needed = 0;
    size_t written = 0;
    for (int column = 0; column < end; ++column) {
        char bytes[4];
        size_t length = encode(ceduo_canvas_glyph(canvas, column, row), bytes);
        needed += length;
        if (needed < size) {
            memcpy(buffer + written, bytes, length);
            written = needed;
        }
    }
    if (size > 0) {
        buffer[written] = '\0';
    }
    return needed;
}

char *ceduo_canvas_dump(const struct ceduo_canvas *canvas)
{
    size_t size = 1;
    for (int row = 0; row < canvas->height; ++row) {
        size += ceduo_canvas_text(canvas, row, 0, NULL) + 1;
    }
    char *dump = malloc(size);
    if (dump == NULL) {
        return NULL;
    }
    char *to = dump;
    for (int row = 0; row < canvas->height; ++row) {
        to += ceduo_canvas_text(canvas, row, size - (size_t)(to - dump), to);
        *to++ = '\n';
    }
    *to = '\0';
    return dump;
}

char *ceduo_canvas_roles(const struct ceduo_canvas *canvas)
{
    static const char letters[] = " tdTagcemwsSbCGBWrox";
    static_assert(sizeof letters == CEDUO_ROLE_COUNT + 1, "a letter for each role");
    char *roles = malloc(((size_t)canvas->width + 1) * (size_t)canvas->height + 1);
    if (roles == NULL) {
        return NULL;
    }
    char *to = roles;
    for (int row = 0; row < canvas->height; ++row) {
        char *end = to;
        for (int column = 0; column < canvas->width; ++column) {
            *to++ = letters[ceduo_canvas_role(canvas, column, row)];
            end = to[-1] == ' ' ? end : to;
        }
        to = end;
        *to++ = '\n';
    }
    *to = '\0';
    return roles;
}
