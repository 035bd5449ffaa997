/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "canvas.h"

#include <gsl/gsl_statistics_double.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/oom.h"
#include "base/text.h"
#include "base/utf8.h"

/* ---- Surface of cells: lines as dots, bars and axes as characters, clouds by the passes of each dot ---- */

/* Return the nearest of n dots. */
static int nearest(double position, int n)
{
    return (int)lround(fmin(fmax(position, 0.0), n - 1));
}

/* Draw a line in dots. Dashes of all lines of a frame are aligned: at the same columns, or rows if upright. */
static void cells_draw_line(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    static const struct {
        int drawn, period;
    } dashes[CEDUO_STROKES] = {
        [CEDUO_STROKE_TRAJECTORY] = {1, 1}, [CEDUO_STROKE_RULE] = {1, 2},   [CEDUO_STROKE_DOTS] = {1, 2},
        [CEDUO_STROKE_FEW] = {1, 4},        [CEDUO_STROKE_DASHES] = {4, 6}, [CEDUO_STROKE_PLAIN] = {1, 1}};
    const struct ceduo_raster *r = &pen->raster;
    struct ceduo_cells *cells = to;
    int across = cells->width * cells->canvas.dots_x, down = cells->height * cells->canvas.dots_y;
    int x = nearest(a.x, r->nx), y = nearest(a.y, r->ny);
    int dx = nearest(b.x, r->nx) - x, dy = nearest(b.y, r->ny) - y;
    int dots = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
    for (int i = 0; i <= dots; i++) {
        double part = dots > 0 ? (double)i / dots : 0;
        int in_x = x + (int)lround(part * dx), in_y = y + (int)lround(part * dy);
        int at_x = r->left + in_x, at_y = r->top + in_y, along = dx != 0 || dots == 0 ? in_x : in_y;
        if (along % dashes[pen->stroke].period >= dashes[pen->stroke].drawn)
            continue;
        if (pen->stroke != CEDUO_STROKE_TRAJECTORY) {
            ceduo_cells_set_dot(to, at_x, at_y, pen->role);
            continue;
        }
        bool repeated = at_x == pen->last_x && at_y == pen->last_y; /* end of one segment is start of the next: count it once */
        if (!cells->density || at_x < 0 || at_x >= across || at_y < 0 || at_y >= down || repeated)
            continue;
        pen->last_x = at_x;
        pen->last_y = at_y;
        uint32_t *count = &cells->density[(size_t)at_y * (size_t)across + (size_t)at_x];
        *count += *count < UINT32_MAX;
    }
}

/* Draw a bar with a resolution of 1/8 cell, or of a cell in ASCII. */
static void cells_draw_bar(void *to, int column, int row, int width, double fraction, enum ceduo_role role)
{
    enum { full_block = 0x2588, eighth_block = 0x258F };
    const struct ceduo_cells *cells = to;
    bool ascii = cells->charset == CEDUO_CHARSET_ASCII;
    int parts = ascii ? 1 : 8; /* per cell */
    int length = (int)lround(fraction * width * parts);
    length = length < 1 ? 1 : length;
    for (int i = 0; i < length / parts; ++i)
        ceduo_cells_set_code(to, column + i, row, role, ascii ? '#' : full_block);
    if (length % parts > 0)
        ceduo_cells_set_code(to, column + length / parts, row, role, (uint32_t)(eighth_block + 1 - length % parts));
}

/* Draw an axis. The bottom axis joins a left axis drawn before. */
static void cells_draw_axis(void *to, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks)
{
    int left = frame->left - 1, below = frame->top + frame->height;
    const struct ceduo_cell *above = ceduo_cells_at(to, left, below - 1);
    if (bottom && above && above->code != 0 && above->role == CEDUO_ROLE_AXIS)
        ceduo_cells_label(to, left, below, CEDUO_ROLE_AXIS, "\xe2\x94\x94");
    for (int i = 0; i < (bottom ? frame->width : frame->height); ++i)
        if (bottom)
            ceduo_cells_label(to, frame->left + i, below, CEDUO_ROLE_AXIS, "\xe2\x94\x80");
        else
            ceduo_cells_label(to, left, frame->top + i, CEDUO_ROLE_AXIS, "\xe2\x94\x82");
    for (const struct ceduo_tick *t = ticks; t < ticks + count; ++t) {
        int row = bottom ? below : t->cell;
        if (t->cell >= 0)
            ceduo_cells_label(to, bottom ? t->cell : left, row, CEDUO_ROLE_AXIS, bottom ? "\xe2\x94\xac" : "\xe2\x94\xa4");
        if (t->start >= 0)
            ceduo_cells_label(to, t->start, row + bottom, CEDUO_ROLE_AXIS, t->label);
    }
}

const struct ceduo_surface ceduo_cells_surface = {
    .margin = 0.5, .line = cells_draw_line, .bar = cells_draw_bar, .axis = cells_draw_axis};

/* ---- Frames ---- */

static bool are_cells_valid(const struct ceduo_frame *frame)
{
    return frame->width >= 2 && frame->width <= CEDUO_CANVAS_MAX_WIDTH && frame->height >= 1 &&
           frame->height <= CEDUO_CANVAS_MAX_HEIGHT && abs(frame->left) <= CEDUO_CANVAS_MAX_WIDTH &&
           abs(frame->top) <= CEDUO_CANVAS_MAX_HEIGHT;
}

static bool is_range_valid(double from, double to)
{
    return isfinite(from) && isfinite(to) && isfinite(to - from) && from != to;
}

static bool is_frame_valid(const struct ceduo_frame *frame)
{
    return are_cells_valid(frame) && is_range_valid(frame->x0, frame->x1) && is_range_valid(frame->y0, frame->y1);
}

/* Requires valid cells; an invalid frame may be arbitrarily large. */
static struct ceduo_raster make_raster(const struct ceduo_canvas *canvas, const struct ceduo_frame *frame)
{
    return (struct ceduo_raster){frame->left * canvas->dots_x, frame->top * canvas->dots_y, frame->width * canvas->dots_x,
                                 frame->height * canvas->dots_y};
}

/* Convert a data point to dots. Return false if the result is not finite. */
static bool convert_point(const struct ceduo_frame *frame, const struct ceduo_raster *raster, double x, double y,
                          struct ceduo_position *out)
{
    out->x = (x - frame->x0) / (frame->x1 - frame->x0) * (raster->nx - 1);
    out->y = (frame->y1 - y) / (frame->y1 - frame->y0) * (raster->ny - 1);
    return isfinite(out->x) && isfinite(out->y);
}

static bool is_inside(const struct ceduo_raster *raster, struct ceduo_position p)
{
    return p.x >= -0.5 && p.x <= raster->nx - 0.5 && p.y >= -0.5 && p.y <= raster->ny - 0.5;
}

bool ceduo_frame_true_scale(struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x_lo, double x_hi, double y_lo,
                            double y_hi)
{
    double x_range = x_hi - x_lo;
    double y_range = y_hi - y_lo;
    if (!are_cells_valid(frame) || !isfinite(x_range) || !isfinite(y_range) || x_range < 0.0 || y_range < 0.0)
        return false;
    struct ceduo_raster raster = make_raster(canvas, frame);
    double x_length = (raster.nx - 1) * (2.0 / canvas->dots_x); /* half cell widths */
    double y_length = (raster.ny - 1) * (4.0 / canvas->dots_y);
    double metres = fmax(x_range / x_length, y_range / y_length); /* m per unit of length */
    double x_spare = metres * x_length - x_range;
    double y_spare = metres * y_length - y_range;
    struct ceduo_frame scaled = *frame;
    scaled.x0 = x_lo - 0.5 * x_spare;
    scaled.x1 = x_hi + 0.5 * x_spare;
    scaled.y0 = y_lo - 0.5 * y_spare;
    scaled.y1 = y_hi + 0.5 * y_spare;
    if (!is_frame_valid(&scaled))
        return false;
    *frame = scaled;
    return true;
}

bool ceduo_frame_cell(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, double x, double y, int *column,
                      int *row)
{
    if (!is_frame_valid(frame))
        return false;
    struct ceduo_raster raster = make_raster(canvas, frame);
    struct ceduo_position p;
    if (!convert_point(frame, &raster, x, y, &p) || !is_inside(&raster, p))
        return false;
    *column = frame->left + nearest(p.x, raster.nx) / canvas->dots_x;
    *row = frame->top + nearest(p.y, raster.ny) / canvas->dots_y;
    return true;
}

/* ---- Lines ---- */

/* Clip the part lo..hi of a line to p t <= q: one edge of Liang and Barsky (1984). */
static bool clip_edge(double p, double q, double *lo, double *hi)
{
    if (p == 0.0)
        return q >= 0.0;
    double t = q / p;
    if (p < 0.0)
        *lo = fmax(*lo, t);
    else
        *hi = fmin(*hi, t);
    return *lo <= *hi;
}

static void draw_clipped(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, struct ceduo_pen *pen, double x0,
                         double y0, double x1, double y1)
{
    struct ceduo_position a, b;
    double lo = 0, hi = 1, margin = canvas->surface->margin;
    if (!convert_point(frame, &pen->raster, x0, y0, &a) || !convert_point(frame, &pen->raster, x1, y1, &b))
        return;
    double dx = b.x - a.x, dy = b.y - a.y;
    if (isfinite(dx) && isfinite(dy) && clip_edge(-dx, a.x + margin, &lo, &hi) &&
        clip_edge(dx, pen->raster.nx - 1 + margin - a.x, &lo, &hi) && clip_edge(-dy, a.y + margin, &lo, &hi) &&
        clip_edge(dy, pen->raster.ny - 1 + margin - a.y, &lo, &hi))
        canvas->surface->line(canvas->to, pen, (struct ceduo_position){a.x + lo * dx, a.y + lo * dy},
                              (struct ceduo_position){a.x + hi * dx, a.y + hi * dy});
}

void ceduo_canvas_polyline(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                           enum ceduo_stroke stroke, size_t n, const double *x, const double *y)
{
    if (!is_frame_valid(frame))
        return;
    struct ceduo_pen pen = {make_raster(canvas, frame), role, stroke, INT_MIN, INT_MIN};
    for (size_t i = 0; i < n; ++i) {
        bool follows = i > 0 && isfinite(x[i - 1]) && isfinite(y[i - 1]);
        size_t from = follows ? i - 1 : i;
        draw_clipped(canvas, frame, &pen, x[from], y[from], x[i], y[i]);
    }
}

/* Draw a straight line only if both ends are valid; a polyline would leave a dot. */
static void draw_straight(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role,
                          enum ceduo_stroke stroke, double x0, double y0, double x1, double y1)
{
    if (!is_frame_valid(frame))
        return;
    struct ceduo_pen pen = {make_raster(canvas, frame), role, stroke, INT_MIN, INT_MIN};
    draw_clipped(canvas, frame, &pen, x0, y0, x1, y1);
}

void ceduo_canvas_line(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x0, double y0,
                       double x1, double y1)
{
    draw_straight(canvas, frame, role, CEDUO_STROKE_PLAIN, x0, y0, x1, y1);
}

void ceduo_canvas_rule_y(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double y)
{
    draw_straight(canvas, frame, role, CEDUO_STROKE_RULE, frame->x0, y, frame->x1, y);
}

void ceduo_canvas_rule_x(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x)
{
    draw_straight(canvas, frame, role, CEDUO_STROKE_RULE, x, frame->y1, x, frame->y0);
}

void ceduo_canvas_stairs(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, size_t n,
                         const double *x, const double *y)
{
    for (size_t i = 0; i < n; ++i) {
        bool follows = i > 0 && isfinite(x[i - 1]) && isfinite(y[i - 1]) && isfinite(y[i]);
        double from = follows ? y[i - 1] : y[i];
        if (follows)
            ceduo_canvas_line(canvas, frame, role, x[i - 1], from, x[i], from);
        ceduo_canvas_line(canvas, frame, role, x[i], from, x[i], y[i]);
    }
}

void ceduo_canvas_disc(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, enum ceduo_role role, double x, double y,
                       double radius)
{
    if (!is_frame_valid(frame))
        return;
    struct ceduo_raster raster = make_raster(canvas, frame);
    struct ceduo_position centre;
    if (canvas->surface->disc && convert_point(frame, &raster, x, y, &centre) && is_inside(&raster, centre))
        canvas->surface->disc(canvas->to, &raster, role, centre,
                              (struct ceduo_position){fabs(radius / (frame->x1 - frame->x0)) * (raster.nx - 1),
                                                      fabs(radius / (frame->y1 - frame->y0)) * (raster.ny - 1)});
    if (canvas->surface->disc)
        return;
    double dot = fabs(frame->y1 - frame->y0) / (frame->height * canvas->dots_y - 1);
    int rows = (int)floor(radius / dot);
    for (int i = -rows; i <= rows; ++i) {
        double half_width = sqrt(fmax(radius * radius - i * dot * i * dot, 0));
        ceduo_canvas_line(canvas, frame, role, x - half_width, y + i * dot, x + half_width, y + i * dot);
    }
}

void ceduo_canvas_bar(struct ceduo_canvas *canvas, int column, int row, int width, double fraction, enum ceduo_role role)
{
    if (fraction > 0.0 && width >= 1 && width <= CEDUO_CANVAS_MAX_WIDTH)
        canvas->surface->bar(canvas->to, column, row, width, fmin(fraction, 1.0), role);
}

/* ---- Clouds ---- */

void ceduo_canvas_cloud_start(struct ceduo_canvas *canvas)
{
    free(canvas->cells->density);
    canvas->cells->density = ceduo_check_memory(calloc(ceduo_cells_dots(canvas->cells), sizeof *canvas->cells->density));
}

void ceduo_canvas_cloud_show(struct ceduo_canvas *canvas, double quantile)
{
    struct ceduo_cells *cells = canvas->cells;
    const uint32_t *count = cells->density;
    size_t across = (size_t)cells->width * (size_t)cells->canvas.dots_x, n = count ? ceduo_cells_dots(cells) : 0, passed = 0;
    double *counts = ceduo_check_memory(malloc((n + 1) * sizeof *counts));
    for (size_t i = 0; i < n; ++i)
        if (count[i] > 0)
            counts[passed++] = count[i];
    double rank = ceil(fmin(fmax(quantile, 0), 1) * (double)passed);
    double level = passed > 0 ? gsl_stats_select(counts, 1, passed, rank > 0 ? (size_t)rank - 1 : 0) : INFINITY;
    for (size_t i = 0; i < n; ++i)
        if (count[i] >= level)
            ceduo_cells_set_dot(cells, (int)(i % across), (int)(i / across), CEDUO_ROLE_CLOUD);
    free(counts);
}

/* ---- Text ---- */

int ceduo_canvas_label(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text)
{
    return ceduo_cells_label(canvas->cells, column, row, role, text);
}

int ceduo_canvas_label_width(const struct ceduo_canvas *canvas, const char *text)
{
    return ceduo_cells_label_width(canvas->cells->charset, text);
}

int ceduo_canvas_label_right(struct ceduo_canvas *canvas, int column, int row, enum ceduo_role role, const char *text)
{
    return ceduo_canvas_label(canvas, column + 1 - ceduo_canvas_label_width(canvas, text), row, role, text);
}

bool ceduo_canvas_is_blank(const struct ceduo_canvas *canvas, int column, int row)
{
    return ceduo_cells_glyph(canvas->cells, column, row) == ' ';
}

int ceduo_canvas_draw_text(struct ceduo_canvas *canvas, int column, int row, int max, enum ceduo_role role, const char *text)
{
    if (max < 1)
        return 0;
    if (ceduo_canvas_label_width(canvas, text) <= max)
        return ceduo_canvas_label(canvas, column, row, role, text);
    const char *mark = ceduo_canvas_label_width(canvas, "\xe2\x80\xa6") > 1 ? "~" : "\xe2\x80\xa6";
    LOCAL_TEXT(cut);
    ceduo_text_append(&cut, text);
    char *end = cut.bytes + cut.length;
    while (end > cut.bytes && ceduo_canvas_label_width(canvas, cut.bytes) > max - 1) {
        end = cut.bytes + (ceduo_utf8_back(cut.bytes, end) - cut.bytes);
        *end = '\0';
    }
    int cells = ceduo_canvas_label(canvas, column, row, role, cut.bytes);
    return cells + ceduo_canvas_label(canvas, column + cells, row, role, mark);
}

/* ---- Ticks ---- */

/* Return a multiple of the k-th round interval: …, 0.5, 1 (k = 0), 2 (1), 5 (2), 10, … Divides, because 3 / 10 is 0.3 and 3
 * * 0.1 is not. */
static double tick_value(double index, int k)
{
    static const int mantissas[] = {1, 2, 5};
    int exponent = (int)floor(k / 3.0);
    double tens = index * mantissas[k - 3 * exponent];
    return exponent < 0 ? tens / pow(10.0, -exponent) : tens * pow(10.0, exponent);
}

/* Find the first multiple of the interval in lo..hi; return their number. */
static double count_multiples(double lo, double hi, int k, double *first)
{
    const double slack = 1e-9; /* fraction of an interval: 0.3 belongs to 0..3 * 0.1 */
    double size = tick_value(1.0, k);
    *first = ceil(lo / size - slack);
    return floor(hi / size + slack) - *first + 1.0;
}

int ceduo_ticks(double lo, double hi, int max_count, double *out, double *interval)
{
    double from = fmin(lo, hi), to = fmax(lo, hi), range = to - from, first;
    *interval = 0.0;
    if (max_count < 1 || !isfinite(lo) || !isfinite(hi) || range > 1e300)
        return 0;
    if (range < 1e-300 || range < 1e-12 * fmax(fabs(from), fabs(to))) {
        *out = lo == 0.0 ? 0.0 : lo; /* never -0 */
        return 1;
    }
    max_count = max_count < CEDUO_TICKS_MAX ? max_count : CEDUO_TICKS_MAX;
    int k = 3 * (int)floor(log10(range / max_count));
    /* 6..8 has no multiple of 5: keep the only tick 6 */
    while (count_multiples(from, to, k, &first) > max_count && count_multiples(from, to, k + 1, &first) >= 1.0)
        k++;
    int n = (int)fmin(count_multiples(from, to, k, &first), max_count);
    for (int i = 0; i < n; ++i)
        out[i] = tick_value(first + i, k); /* ceil() may return -0; -0 + 0 is 0 */
    *interval = tick_value(1.0, k);
    return n;
}

void ceduo_tick_label(double value, double interval, char label[CEDUO_TICK_LABEL_SIZE])
{
    double convert_point = interval > 0.0 ? floor(log10(interval) + 1e-9) : 0.0; /* place of the last digit, power of 10 */
    double digits = value == 0.0 ? 1.0 : floor(log10(fabs(value)) + 1e-9) - convert_point + 1.0;
    if (!(interval > 0.0))
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.6g", value);
    else if (convert_point >= -6 && fabs(value) < 1e7)
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.*f", convert_point < 0 ? (int)-convert_point : 0, value);
    else
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.*g", (int)fmin(fmax(digits, 1.0), 17.0), value);
    char *exponent = strchr(label, 'e');
    if (exponent) { /* 2e+11 and 5e-09 as 2e11 and 5e-9 */
        char *to = exponent + 1 + (exponent[1] == '-'), *from = to + strspn(to, "+0");
        memmove(to, from, strlen(from) + 1);
    }
    if (*label == '-' && strpbrk(label, "123456789") == NULL) /* rounded to "-0.0": drop the sign */
        memmove(label, label + 1, strlen(label));
    ceduo_number_localize(label);
}

/* ---- Axes: labels at round numbers that do not touch ---- */

/* Ticks of an axis. */
struct axis_scale {
    int count;
    double interval;
    struct ceduo_tick tick[CEDUO_TICKS_MAX + 1]; /* one more for the unit */
};

/* Set at most n ticks, without the position of labels. Return false if a tick is outside the frame. */
static bool set_ticks(struct axis_scale *scale, const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, bool bottom,
                      int n)
{
    double value[CEDUO_TICKS_MAX];
    scale->count = bottom ? ceduo_ticks(frame->x0, frame->x1, n, value, &scale->interval)
                          : ceduo_ticks(frame->y0, frame->y1, n, value, &scale->interval);
    for (int i = 0; i < scale->count; ++i) {
        struct ceduo_tick *t = &scale->tick[i];
        double x = bottom ? value[i] : frame->x0, y = bottom ? frame->y0 : value[i];
        struct ceduo_raster raster = make_raster(canvas, frame);
        struct ceduo_position p;
        int column, row;
        if (!ceduo_frame_cell(frame, canvas, x, y, &column, &row) || !convert_point(frame, &raster, x, y, &p))
            return false;
        t->cell = bottom ? column : row;
        t->position = bottom ? (raster.left + p.x + 0.5) / canvas->dots_x : (raster.top + p.y + 0.5) / canvas->dots_y;
        ceduo_tick_label(value[i], scale->interval, t->label);
    }
    return true;
}

/* Return the scale with the most labels that do not touch. */
static struct axis_scale make_left_scale(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas)
{
    struct axis_scale scale = {0};
    int min_gap = frame->height > 3 ? 2 : 1;
    for (int n = frame->height / 2 + 1; n > 0; --n) {
        bool fits = set_ticks(&scale, frame, canvas, false, n);
        for (int i = 1; i < scale.count && fits; ++i)
            fits = abs(scale.tick[i].cell - scale.tick[i - 1].cell) >= min_gap;
        if (fits)
            return scale;
    }
    return (struct axis_scale){0};
}

int ceduo_frame_axis_width(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas)
{
    /* the columns are unknown yet; any valid columns and x range give the same labels */
    struct ceduo_frame rows = *frame;
    rows.left = 0;
    rows.width = 2;
    rows.x0 = 0.0;
    rows.x1 = 1.0;
    if (!is_frame_valid(&rows))
        return 0;
    struct axis_scale scale = make_left_scale(&rows, canvas);
    size_t widest = 0;
    for (int i = 0; i < scale.count; ++i) {
        size_t length = strlen(scale.tick[i].label);
        widest = length > widest ? length : widest;
    }
    return (int)widest + 1;
}

void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame)
{
    if (!is_frame_valid(frame))
        return;
    struct axis_scale scale = make_left_scale(frame, canvas);
    for (int i = 0; i < scale.count; ++i) {
        int length = (int)strlen(scale.tick[i].label);
        scale.tick[i].start = length < frame->left ? frame->left - 1 - length : -1;
    }
    canvas->surface->axis(canvas->to, frame, false, scale.count, scale.tick);
}

enum { LABEL_GAP = 2 }; /* blanks between labels */

static int find_label_end(const struct ceduo_tick *tick)
{
    return tick->start + (int)strlen(tick->label);
}

/* Set the position of each label. Return false if labels overlap or exceed the frame. */
static bool place_bottom_labels(struct axis_scale *scale, const struct ceduo_frame *frame)
{
    int min = frame->left > 0 ? frame->left - 1 : frame->left;
    int end = frame->left + frame->width;
    for (int i = 0; i < scale->count; ++i) {
        int length = (int)strlen(scale->tick[i].label), start = scale->tick[i].cell - (length - 1) / 2;
        start = start + length > end ? end - length : start;
        start = start < min && i == 0 ? min : start;
        if (start < min || start + length > end)
            return false;
        scale->tick[i].start = start;
        min = start + length + LABEL_GAP;
    }
    return true;
}

/* Return the scale with the most labels that leave space for the unit, at least 2; otherwise the one with the most labels. */
static struct axis_scale make_bottom_scale(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, const char *unit)
{
    struct axis_scale fallback = {0};
    int width = ceduo_canvas_label_width(canvas, unit);
    for (int n = frame->width / 3 + 1; n > 0; --n) {
        struct axis_scale scale = {0};
        bool is_inside = set_ticks(&scale, frame, canvas, true, n);
        bool fractional = frame->x_integer && scale.interval > 0 && scale.interval < 1;
        if (fractional || !is_inside || !place_bottom_labels(&scale, frame) || (scale.count < 2 && fallback.count > 1))
            continue;
        fallback = fallback.count == 0 ? scale : fallback;
        /* the unit goes after the last label, otherwise after the first; labels do not move */
        struct ceduo_tick unit_tick = {.cell = -1, .start = -1};
        if (scale.count > 0 && find_label_end(&scale.tick[scale.count - 1]) + 1 + width <= frame->left + frame->width)
            unit_tick.start = find_label_end(&scale.tick[scale.count - 1]) + 1;
        else if (scale.count > 1 && find_label_end(&scale.tick[0]) + 1 + width + LABEL_GAP <= scale.tick[1].start)
            unit_tick.start = find_label_end(&scale.tick[0]) + 1;
        snprintf(unit_tick.label, sizeof unit_tick.label, "%s", unit);
        if (width > 0 && unit_tick.start >= 0)
            scale.tick[scale.count++] = unit_tick;
        if (width == 0 || unit_tick.start >= 0)
            return scale;
    }
    return fallback;
}

void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit)
{
    if (!is_frame_valid(frame))
        return;
    struct axis_scale scale = make_bottom_scale(frame, canvas, unit ? unit : "");
    canvas->surface->axis(canvas->to, frame, true, scale.count, scale.tick);
}
