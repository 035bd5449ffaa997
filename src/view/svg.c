/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draw pictures as vectors. Connected lines become one path, simplified within TOLERANCE. Paths are written in order of the
 * roles' ranks. A grid of cells is drawn in parallel: it holds text and occupied cells. Characters, also of a screen, are
 * monospace <text> set to the width of their cells. */
#include "svg.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/oom.h"
#include "base/utf8.h"

#define CELL_WIDTH  8                  /* width of a cell, units */
#define CELL_HEIGHT (2 * CELL_WIDTH)   /* height of a cell */
#define BASELINE    12                 /* baseline of text in a cell */
#define DRAWN       0xE000             /* code of a cell drawn as a vector */
#define DOT         (CELL_WIDTH / 2.0) /* cells have 2 x 4 dots */
#define TOLERANCE   0.3                /* units */
#define STALL_MAX   400                /* max lines of a trajectory without progress */
#define BELOW       19                 /* units from the bottom axis to the baseline of its labels */

enum { FILLED = CEDUO_STROKES, STYLES }; /* path styles after the strokes */

/* Current path. Points from `start` to `last` are within TOLERANCE of a straight line, and so is any point between the
 * directions lo and hi. */
struct stroke {
    bool open;
    enum ceduo_role role;
    unsigned style;
    struct ceduo_position start, last;
    double lo, hi;
    bool straight; /* lo and hi are valid */
};

struct ceduo_svg {
    struct ceduo_cells *cells;
    struct text paths[CEDUO_ROLE_COUNT][STYLES];
    struct text axes, numbers; /* numbers: labels of axes as elements */
    struct stroke stroke;
    double trajectory_lo, trajectory_hi; /* x range of the current trajectory */
    int idle;                            /* lines since the range grew by a unit */
};

/* On paper, lightness and width distinguish roles; a dark terminal uses bold. Text has a contrast of at least 4.5 to its
 * background. */
#define DARK "#15181c"
static const struct paint {
    const char *colour;
    double width;                 /* width of lines, units */
    const char *on_dark, *weight; /* weight of text; NULL: normal */
} paints[CEDUO_ROLE_COUNT] = {
    [CEDUO_ROLE_BLANK] = {"#1c1c1c", 1, "#d6dbe1", NULL},    [CEDUO_ROLE_TEXT] = {"#1c1c1c", 1.4, "#d6dbe1", NULL},
    [CEDUO_ROLE_DIM] = {"#595959", 1, "#8d96a0", NULL},      [CEDUO_ROLE_TITLE] = {"#1c1c1c", 1.4, "#f2f5f8", "bold"},
    [CEDUO_ROLE_AXIS] = {"#4a4a4a", 1, "#8d96a0", NULL},     [CEDUO_ROLE_GROUND] = {"#4e3620", 2.4, "#d9b45b", NULL},
    [CEDUO_ROLE_CLOUD] = {"#2f4f6e", 0.9, "#56b6c2", NULL},  [CEDUO_ROLE_ENVELOPE] = {"#3f678c", 1.6, "#7aa7f0", NULL},
    [CEDUO_ROLE_MEAN] = {"#111111", 2.2, "#f2f5f8", "bold"}, [CEDUO_ROLE_TRAJECTORY] = {"#8a1c7c", 2, "#e08ce0", "bold"},
    [CEDUO_ROLE_STEM] = {"#2f6b2f", 1.6, "#7ec46b", NULL},   [CEDUO_ROLE_STOOL] = {"#5b7f2a", 1, "#7ec46b", NULL},
    [CEDUO_ROLE_BELT] = {"#2f6b2f", 1.4, "#7ec46b", NULL},   [CEDUO_ROLE_CONTROL] = {"#a3161c", 1.6, "#f2777a", NULL},
    [CEDUO_ROLE_GOOD] = {"#1f5c99", 1.6, "#8fd97a", "bold"}, [CEDUO_ROLE_BAD] = {"#b04a00", 2, "#ff8a85", "bold"},
    [CEDUO_ROLE_WARN] = {"#7a4a00", 1.6, "#d9b45b", NULL},   [CEDUO_ROLE_BARE] = {"#9a4a10", 2.6, "#56b6c2", NULL},
    [CEDUO_ROLE_FOREST] = {"#123f73", 2, "#7ec46b", NULL},   [CEDUO_ROLE_CURSOR] = {"#1c1c1c", 1.4, "#d6dbe1", NULL}};

/* ---- paths ---- */

static void append_number(struct text *text, double value)
{
    ceduo_text_format(text, "%g", round(value * 10) / 10 + 0.0); /* never -0 */
}

static void append_point(struct text *path, char command, struct ceduo_position p)
{
    ceduo_text_append_char(path, command);
    append_number(path, p.x);
    ceduo_text_append_char(path, ' ');
    append_number(path, p.y);
}

static struct text *current_path(struct ceduo_svg *svg)
{
    return &svg->paths[svg->stroke.role][svg->stroke.style];
}

static void end_stroke(struct ceduo_svg *svg)
{
    struct stroke *s = &svg->stroke;
    if (!s->open)
        return;
    if (s->straight)
        append_point(current_path(svg), 'L', s->last);
    else
        ceduo_text_append(current_path(svg), "h0"); /* dot */
    s->open = false;
}

/* Return the angle between two directions, -pi..pi. */
static double angle_between(double from, double to)
{
    return remainder(to - from, 2 * M_PI);
}

/* Extend the path; drop points within TOLERANCE of a straight line (cone test). */
static void extend_path(struct ceduo_svg *svg, struct ceduo_position to)
{
    struct stroke *s = &svg->stroke;
    if (hypot(to.x - s->start.x, to.y - s->start.y) < TOLERANCE)
        return;
    double angle, half;
    for (;;) {
        double dx = to.x - s->start.x, dy = to.y - s->start.y, length = hypot(dx, dy);
        angle = atan2(dy, dx);
        half = asin(fmin(TOLERANCE / length, 1));
        bool farther = length >= hypot(s->last.x - s->start.x, s->last.y - s->start.y);
        if (!s->straight || (farther && angle_between(s->lo, angle) >= 0 && angle_between(angle, s->hi) >= 0))
            break;
        append_point(current_path(svg), 'L', s->last);
        s->start = s->last;
        s->straight = false;
    }
    double lo = angle - half, hi = angle + half;
    s->lo = s->straight && angle_between(s->lo, lo) < 0 ? s->lo : lo;
    s->hi = s->straight && angle_between(hi, s->hi) < 0 ? s->hi : hi;
    s->straight = true;
    s->last = to;
}

static struct ceduo_position to_units(const struct ceduo_raster *raster, struct ceduo_position p)
{
    return (struct ceduo_position){(raster->left + p.x + 0.5) * DOT, (raster->top + p.y + 0.5) * DOT};
}

/* ---- surface ---- */

/* True if the trajectory makes progress. A rock in a pit oscillates without end. */
static bool makes_progress(struct ceduo_svg *svg, bool first, double from, double to)
{
    if (first)
        svg->trajectory_lo = svg->trajectory_hi = from;
    bool on = first || to < svg->trajectory_lo - 1 || to > svg->trajectory_hi + 1;
    svg->trajectory_lo = on ? fmin(svg->trajectory_lo, to) : svg->trajectory_lo;
    svg->trajectory_hi = on ? fmax(svg->trajectory_hi, to) : svg->trajectory_hi;
    svg->idle = on ? 0 : svg->idle + 1;
    return svg->idle <= STALL_MAX;
}

static void svg_draw_line(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    struct ceduo_svg *svg = to;
    struct stroke *s = &svg->stroke;
    bool first = pen->last_x == INT_MIN, trajectory = pen->stroke == CEDUO_STROKE_TRAJECTORY;
    if (pen->role == CEDUO_ROLE_BLANK)
        return;
    ceduo_cells_surface.line(svg->cells, pen, a, b);
    pen->last_x = pen->last_x == INT_MIN ? 0 : pen->last_x;
    struct ceduo_position from = to_units(&pen->raster, a), end = to_units(&pen->raster, b);
    if (trajectory && !makes_progress(svg, first, from.x, end.x))
        return;
    bool follows = fabs(s->last.x - from.x) < 0.01 && fabs(s->last.y - from.y) < 0.01 && !(trajectory && first);
    if (!s->open || s->role != pen->role || s->style != pen->stroke || !follows) {
        end_stroke(svg);
        *s = (struct stroke){.open = true, .role = pen->role, .style = pen->stroke, .start = from, .last = from};
        append_point(current_path(svg), 'M', from);
    }
    extend_path(svg, end);
}

static void svg_draw_disc(void *to, const struct ceduo_raster *raster, enum ceduo_role role, struct ceduo_position centre,
                          struct ceduo_position radii)
{
    struct ceduo_svg *svg = to;
    struct text *path = &svg->paths[role][FILLED];
    struct ceduo_position c = to_units(raster, centre), r = {fmax(radii.x * DOT, 1), fmax(radii.y * DOT, 1)};
    for (int half = 1; half >= -1; half -= 2) {
        if (half > 0)
            append_point(path, 'M', (struct ceduo_position){c.x - r.x, c.y});
        append_point(path, 'A', r);
        ceduo_text_append(path, " 0 0 0");
        append_point(path, ' ', (struct ceduo_position){c.x + half * r.x, c.y});
    }
    for (double y = c.y - r.y; y <= c.y + r.y; y += DOT)
        for (double x = c.x - r.x; x <= c.x + r.x; x += DOT)
            ceduo_cells_set_dot(svg->cells, (int)(x / DOT), (int)(y / DOT), role);
}

/* Mark cells as drawn by vectors. */
static void mark_drawn(struct ceduo_svg *svg, int column, int row, int width)
{
    for (int i = 0; i < width; i++)
        ceduo_cells_set_code(svg->cells, column + i, row, CEDUO_ROLE_AXIS, DRAWN);
}

static void svg_draw_bar(void *to, int column, int row, int width, double fraction, enum ceduo_role role)
{
    struct ceduo_svg *svg = to;
    struct text *path = &svg->paths[role][FILLED];
    double length = fmax(fraction * width * CELL_WIDTH, 1);
    append_point(path, 'M', (struct ceduo_position){column * CELL_WIDTH, row * CELL_HEIGHT + 3});
    ceduo_text_append_char(path, 'h');
    append_number(path, length);
    ceduo_text_append(path, "v10h");
    append_number(path, -length);
    ceduo_text_append_char(path, 'z');
    mark_drawn(svg, column, row, (int)ceil(length / CELL_WIDTH));
}

/* Append the label of a tick; `anchor`: SVG's text-anchor. */
static void append_label(struct ceduo_svg *svg, double x, double y, const char *anchor, const char *label)
{
    struct ceduo_html html = {.text = &svg->numbers};
    char across[16], down[16];
    snprintf(across, sizeof across, "%g", x);
    snprintf(down, sizeof down, "%g", y);
    ceduo_html_leaf(&html, "text", label, "x", across, "y", down, "fill", paints[CEDUO_ROLE_AXIS].colour, "text-anchor", anchor,
                    NULL);
}

static void svg_draw_axis(void *to, const struct ceduo_frame *frame, bool bottom, int count, const struct ceduo_tick *ticks)
{
    struct ceduo_svg *svg = to;
    int below = frame->top + frame->height;
    double left = frame->left * CELL_WIDTH - 2.5, top = below * CELL_HEIGHT + 2.5;
    if (bottom)
        ceduo_text_format(&svg->axes, "M%.1f %.1fH%d", left, top, (frame->left + frame->width) * CELL_WIDTH);
    else
        ceduo_text_format(&svg->axes, "M%.1f %dV%d", left, frame->top * CELL_HEIGHT, below * CELL_HEIGHT);
    for (const struct ceduo_tick *t = ticks; t < ticks + count; t++) {
        int length = ceduo_canvas_label_width(&svg->cells->canvas, t->label);
        double position = floor(t->position * (bottom ? CELL_WIDTH : CELL_HEIGHT)) + 0.5;
        bool unit = t->cell < 0, moved = t->start != t->cell - (length - 1) / 2;
        if (!unit && bottom)
            ceduo_text_format(&svg->axes, "M%.1f %.1fv4", position, top);
        else if (!unit)
            ceduo_text_format(&svg->axes, "M%.1f %.1fh-4", left, position);
        if (unit)
            append_label(svg, t->start * CELL_WIDTH, below * CELL_HEIGHT + BELOW, "start", t->label);
        else if (bottom)
            append_label(svg, moved ? (t->start + length / 2.0) * CELL_WIDTH : position, below * CELL_HEIGHT + BELOW, "middle",
                         t->label);
        else if (t->start >= 0)
            append_label(svg, left - 6, fmax(position + 4, frame->top * CELL_HEIGHT + 12), "end", t->label); /* below a title */
        mark_drawn(svg, t->start, bottom ? below + 1 : t->cell, t->start >= 0 ? length : 0);
    }
    if (bottom)
        mark_drawn(svg, frame->left, below, frame->width);
    for (int row = frame->top; row < below && !bottom; row++)
        mark_drawn(svg, frame->left - 1, row, 1);
}

static const struct ceduo_surface surface = {
    .line = svg_draw_line,
    .bar = svg_draw_bar,
    .axis = svg_draw_axis,
    .disc = svg_draw_disc,
};

/* ---- picture ---- */

struct ceduo_svg *ceduo_svg_create(int width, int height)
{
    struct ceduo_svg *svg = ceduo_check_memory(calloc(1, sizeof *svg));
    svg->cells = ceduo_cells_create(width, height, CEDUO_CHARSET_BRAILLE);
    svg->cells->canvas.surface = &surface;
    svg->cells->canvas.to = svg;
    return svg;
}

void ceduo_svg_free(struct ceduo_svg *svg)
{
    if (!svg)
        return;
    for (int role = 0; role < CEDUO_ROLE_COUNT; role++)
        for (int style = 0; style < STYLES; style++)
            ceduo_text_free(&svg->paths[role][style]);
    ceduo_text_free(&svg->axes);
    ceduo_text_free(&svg->numbers);
    ceduo_cells_free(svg->cells);
    free(svg);
}

struct ceduo_canvas *ceduo_svg_canvas(struct ceduo_svg *svg)
{
    return &svg->cells->canvas;
}

static void write_path(struct ceduo_html *html, const struct paint *paint, const struct text *path, const char *const extra[2])
{
    char width[16];
    snprintf(width, sizeof width, "%g", paint->width);
    if (path->length > 0)
        ceduo_html_empty(html, "path", "fill", "none", "stroke", paint->colour, "stroke-width", width, "d", path->bytes,
                         extra[0], extra[1], NULL);
}

static void write_marks(struct ceduo_html *html, struct ceduo_svg *svg)
{
    static const char *const strokes[CEDUO_STROKES][2] = {[CEDUO_STROKE_TRAJECTORY] = {"stroke-opacity", ".6"},
                                                          [CEDUO_STROKE_RULE] = {"stroke-dasharray", "4 4"},
                                                          [CEDUO_STROKE_DOTS] = {"stroke-dasharray", "0 8"},
                                                          [CEDUO_STROKE_FEW] = {"stroke-dasharray", "0 16"},
                                                          [CEDUO_STROKE_DASHES] = {"stroke-dasharray", "12 12"}};
    ceduo_html_open(html, "g", "stroke-linecap", "round", "stroke-linejoin", "round", NULL);
    for (int rank = 0; rank <= CEDUO_ROLE_COUNT; rank++)
        for (unsigned role = 0; role < CEDUO_ROLE_COUNT; role++) {
            const struct text *paths = svg->paths[role];
            if (ceduo_role_ranks[role] == rank && paths[FILLED].length > 0)
                ceduo_html_empty(html, "path", "fill", paints[role].colour, "d", paths[FILLED].bytes, NULL);
            for (int stroke = 0; ceduo_role_ranks[role] == rank && stroke < CEDUO_STROKES; stroke++)
                write_path(html, &paints[role], &paths[stroke], strokes[stroke]);
        }
    ceduo_html_close(html);
    write_path(html, &paints[CEDUO_ROLE_AXIS], &svg->axes, strokes[CEDUO_STROKE_PLAIN]);
}

/* ---- characters ---- */

/* Write a row: one element per run of a role, ended by two blanks. The cursor is reversed. */
static void write_text_row(struct ceduo_html *html, const struct ceduo_cells *cells, bool screen, int row)
{
    for (int from = 0, end; from < cells->width; from = end) {
        enum ceduo_role role = ceduo_cells_role(cells, from, row);
        const struct paint *paint = &paints[role];
        const char *colour = screen ? paint->on_dark : paint->colour;
        bool reversed = role == CEDUO_ROLE_CURSOR && ceduo_cells_at(cells, from, row)->code != 0;
        LOCAL_TEXT(word);
        char x[16], y[16], width[16];
        size_t length = 0; /* up to the last non-blank */
        int used = 0;
        for (end = from; end < cells->width && ceduo_cells_role(cells, end, row) == role; end++) {
            char bytes[4];
            uint32_t code = ceduo_cells_at(cells, end, row)->code; /* dots of a picture are vectors */
            code = code == DRAWN || (code == 0 && !screen) ? ' ' : ceduo_cells_glyph(cells, end, row);
            if (code == ' ' && !reversed && (used == 0 || end > from + used))
                break;
            ceduo_text_append_n(&word, bytes, ceduo_utf8_encode(code, bytes));
            if (code != ' ') {
                used = end + 1 - from;
                length = word.length;
            }
        }
        end += end == from;
        snprintf(x, sizeof x, "%d", from * CELL_WIDTH);
        if (reversed) {
            snprintf(y, sizeof y, "%d", row * CELL_HEIGHT);
            snprintf(width, sizeof width, "%d", (end - from) * CELL_WIDTH);
            ceduo_html_empty(html, "rect", "x", x, "y", y, "width", width, "height", "16", "fill", colour, NULL);
        }
        snprintf(y, sizeof y, "%d", row * CELL_HEIGHT + BASELINE);
        snprintf(width, sizeof width, "%d", used * CELL_WIDTH);
        if (used > 0) {
            word.bytes[length] = '\0';
            ceduo_html_leaf(html, "text", word.bytes, "x", x, "y", y, "textLength", width, "fill",
                            !reversed ? colour
                            : screen  ? DARK
                                      : "#fff",
                            "font-weight", screen ? paint->weight : NULL, NULL);
        }
    }
}

static void write_cells(struct ceduo_html *html, const struct ceduo_cells *cells, bool screen)
{
    for (int row = 0; row < cells->height; row++)
        write_text_row(html, cells, screen, row);
}

#define FONT "font-family", "monospace", "font-size", "13.3", "xml:space", "preserve"

void ceduo_svg_write(struct ceduo_html *html, struct ceduo_svg *svg, const char *id, const char *title, const char *description)
{
    char box[64], described[64];
    snprintf(box, sizeof box, "0 0 %d %d", svg->cells->width * CELL_WIDTH, svg->cells->height * CELL_HEIGHT);
    snprintf(described, sizeof described, "%s-d", id);
    end_stroke(svg);
    ceduo_html_open(html, "svg", "viewBox", box, "role", "img", "aria-label", title, "aria-describedby", described, NULL);
    ceduo_html_leaf(html, "title", title, NULL);
    ceduo_html_leaf(html, "desc", description, "id", described, NULL);
    write_marks(html, svg);
    ceduo_html_open(html, "g", FONT, NULL);
    ceduo_text_append_n(html->text, ceduo_text_string(&svg->numbers), svg->numbers.length);
    write_cells(html, svg->cells, false);
    ceduo_html_close(html);
    ceduo_html_close(html);
}

void ceduo_svg_screen(struct text *text, const struct ceduo_cells *cells, const char *title)
{
    struct ceduo_html html = {.text = text};
    char box[64], width[16], height[16];
    snprintf(width, sizeof width, "%d", (cells->width + 2) * CELL_WIDTH);
    snprintf(height, sizeof height, "%d", cells->height * CELL_HEIGHT + 2 * CELL_WIDTH);
    snprintf(box, sizeof box, "%d %d %s %s", -CELL_WIDTH, -CELL_WIDTH, width, height);
    ceduo_html_open(&html, "svg", "xmlns", "http://www.w3.org/2000/svg", "width", width, "height", height, "viewBox", box,
                    "role", "img", NULL);
    ceduo_html_leaf(&html, "title", title, NULL);
    ceduo_html_empty(&html, "rect", "x", "-8", "y", "-8", "width", width, "height", height, "rx", "6", "fill", DARK, NULL);
    ceduo_html_open(&html, "g", FONT, NULL);
    write_cells(&html, cells, true);
    ceduo_html_close(&html);
    ceduo_html_close(&html);
}
