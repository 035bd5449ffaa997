/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws pictures as vectors. Lines that follow one another become one path, from which points are left out as long as
 * the path stays within TOLERANCE of them; paths are put in the order of their roles' ranks. A grid of cells is drawn
 * on along with it: it holds the text, and knows what is taken. */
#include "svg.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "svg_parts.h"

#define DOT        (SVG_CELL / 2.0) /* units: cells have 2 x 4 dots */
#define TOLERANCE  0.3              /* units */
#define TO_AND_FRO 400              /* lines of a way that gets no farther: by then all of it is to be seen */
#define BELOW      19               /* units from the top of the bottom axis to the foot of its labels */

enum style { PLAIN, DOTTED, CLOUD, FILLED, STYLES };

/* The path that is being drawn. Points from `start` to `last` lie within the tolerance of a straight line, as do all
 * that go on from `start` between the directions lo and hi. */
struct stroke {
    bool open;
    enum ceduo_role role;
    enum style style;
    struct ceduo_position start, last;
    double lo, hi;
    bool straight; /* lo and hi are set */
};

struct ceduo_svg {
    struct ceduo_canvas canvas;
    struct ceduo_cells *cells;
    struct text paths[CEDUO_ROLE_COUNT][STYLES];
    struct text axes, numbers; /* numbers: labels of the axes, elements */
    struct stroke stroke;
    double way_lo, way_hi; /* the stretch that the way drawn now has come through */
    int idle;              /* its lines since that grew by a unit */
};

/* Lightness and width tell roles apart, too. */
static const struct ceduo_svg_theme paper = {
    .font = "sans-serif", .looks = {[CEDUO_ROLE_BLANK] = {"#1c1c1c", 1, NULL},  [CEDUO_ROLE_TEXT] = {"#1c1c1c", 1.4, NULL},
                                    [CEDUO_ROLE_DIM] = {"#595959", 1, NULL},    [CEDUO_ROLE_TITLE] = {"#1c1c1c", 1.4, NULL},
                                    [CEDUO_ROLE_AXIS] = {"#4a4a4a", 1, NULL},   [CEDUO_ROLE_GROUND] = {"#4e3620", 2.4, NULL},
                                    [CEDUO_ROLE_CLOUD] = {"#3f678c", 1, NULL},  [CEDUO_ROLE_ENVELOPE] = {"#3f678c", 1.6, NULL},
                                    [CEDUO_ROLE_MEAN] = {"#111111", 2.2, NULL}, [CEDUO_ROLE_WAY] = {"#8a1c7c", 2, NULL},
                                    [CEDUO_ROLE_STEM] = {"#2f6b2f", 1.6, NULL}, [CEDUO_ROLE_STOOL] = {"#5b7f2a", 1, NULL},
                                    [CEDUO_ROLE_BELT] = {"#2f6b2f", 1.4, NULL}, [CEDUO_ROLE_CONTROL] = {"#a3161c", 1.6, NULL},
                                    [CEDUO_ROLE_GOOD] = {"#20702c", 1.6, NULL}, [CEDUO_ROLE_BAD] = {"#a3161c", 2, NULL},
                                    [CEDUO_ROLE_WARN] = {"#7a4a00", 1.6, NULL}, [CEDUO_ROLE_BARE] = {"#9a4a10", 2.6, NULL},
                                    [CEDUO_ROLE_WOOD] = {"#14532d", 2, NULL},   [CEDUO_ROLE_CURSOR] = {"#1c1c1c", 1.4, NULL}}};

/* ---- paths ---- */

static void put_point(struct text *path, char command, struct ceduo_position p)
{
    ceduo_text_char(path, command);
    ceduo_svg_number(path, p.x);
    ceduo_text_char(path, ' ');
    ceduo_svg_number(path, p.y);
}

static struct text *path_of(struct ceduo_svg *svg)
{
    return &svg->paths[svg->stroke.role][svg->stroke.style];
}

static void end_stroke(struct ceduo_svg *svg)
{
    struct stroke *s = &svg->stroke;
    if (!s->open)
        return;
    if (s->straight)
        put_point(path_of(svg), 'L', s->last);
    else
        ceduo_text_put(path_of(svg), "h0"); /* a dot */
    s->open = false;
}

static void begin_stroke(struct ceduo_svg *svg, enum ceduo_role role, enum style style, struct ceduo_position from)
{
    end_stroke(svg);
    svg->stroke = (struct stroke){.open = true, .role = role, .style = style, .start = from, .last = from};
    put_point(path_of(svg), 'M', from);
}

/* An angle seen from another, -pi..pi. */
static double turn(double from, double to)
{
    return remainder(to - from, 2 * M_PI);
}

/* Goes on to a point: the last one is left out where a straight line to this one passes all left out near enough. */
static void go_on(struct ceduo_svg *svg, struct ceduo_position to)
{
    struct stroke *s = &svg->stroke;
    double dx = to.x - s->start.x, dy = to.y - s->start.y, length = hypot(dx, dy);
    if (length < TOLERANCE)
        return;
    double angle = atan2(dy, dx), half = asin(fmin(TOLERANCE / length, 1));
    bool ahead = hypot(dx, dy) >= hypot(s->last.x - s->start.x, s->last.y - s->start.y);
    if (s->straight && (!ahead || turn(s->lo, angle) < 0 || turn(angle, s->hi) < 0)) {
        put_point(path_of(svg), 'L', s->last);
        s->start = s->last;
        s->straight = false;
        dx = to.x - s->start.x;
        dy = to.y - s->start.y;
        length = hypot(dx, dy);
        angle = atan2(dy, dx);
        half = asin(fmin(TOLERANCE / fmax(length, TOLERANCE), 1));
    }
    double lo = angle - half, hi = angle + half;
    s->lo = s->straight && turn(s->lo, lo) < 0 ? s->lo : lo;
    s->hi = s->straight && turn(hi, s->hi) < 0 ? s->hi : hi;
    s->straight = true;
    s->last = to;
}

static struct ceduo_position unit_of(const struct ceduo_raster *raster, struct ceduo_position p)
{
    return (struct ceduo_position){(raster->left + p.x + 0.5) * DOT, (raster->top + p.y + 0.5) * DOT};
}

static bool same(struct ceduo_position a, struct ceduo_position b)
{
    return fabs(a.x - b.x) < 0.01 && fabs(a.y - b.y) < 0.01;
}

/* ---- the surface ---- */

/* Whether a way adds something to see: a rock in a pit goes to and fro without end. */
static bool gets_on(struct ceduo_svg *svg, bool first, double from, double to)
{
    if (first)
        svg->way_lo = svg->way_hi = from;
    bool on = first || to < svg->way_lo - 1 || to > svg->way_hi + 1;
    svg->way_lo = on ? fmin(svg->way_lo, to) : svg->way_lo;
    svg->way_hi = on ? fmax(svg->way_hi, to) : svg->way_hi;
    svg->idle = on ? 0 : svg->idle + 1;
    return svg->idle <= TO_AND_FRO;
}

static void draw_line(void *to, struct ceduo_pen *pen, struct ceduo_position a, struct ceduo_position b)
{
    struct ceduo_svg *svg = to;
    struct stroke *s = &svg->stroke;
    enum style style = pen->stroke == CEDUO_STROKE_PLAIN ? PLAIN : pen->stroke == CEDUO_STROKE_DOTTED ? DOTTED : CLOUD;
    bool first = pen->last_x == INT_MIN;
    if (pen->role == CEDUO_ROLE_BLANK)
        return;
    ceduo_cells_surface.line(svg->cells, pen, a, b);
    pen->last_x = pen->last_x == INT_MIN ? 0 : pen->last_x;
    struct ceduo_position from = unit_of(&pen->raster, a), end = unit_of(&pen->raster, b);
    if (style == CLOUD && !gets_on(svg, first, from.x, end.x))
        return;
    if (!s->open || s->role != pen->role || s->style != style || !same(s->last, from) || (style == CLOUD && first))
        begin_stroke(svg, pen->role, style, from);
    go_on(svg, end);
}

static void draw_disc(void *to, const struct ceduo_raster *raster, enum ceduo_role role, struct ceduo_position centre,
                      struct ceduo_position radii)
{
    struct ceduo_svg *svg = to;
    struct text *path = &svg->paths[role][FILLED];
    struct ceduo_position c = unit_of(raster, centre), r = {fmax(radii.x * DOT, 1), fmax(radii.y * DOT, 1)};
    for (int half = 1; half >= -1; half -= 2) {
        if (half > 0)
            put_point(path, 'M', (struct ceduo_position){c.x - r.x, c.y});
        put_point(path, 'A', r);
        ceduo_text_put(path, " 0 0 0");
        put_point(path, ' ', (struct ceduo_position){c.x + half * r.x, c.y});
    }
    for (double y = c.y - r.y; y <= c.y + r.y; y += DOT)
        for (double x = c.x - r.x; x <= c.x + r.x; x += DOT)
            ceduo_cells_set_dot(svg->cells, (int)(x / DOT), (int)(y / DOT), role);
}

static int label_width(const void *to, const char *text)
{
    (void)to;
    return ceduo_cells_label_width(CEDUO_CHARSET_BRAILLE, text);
}

/* Cells of which the vectors show the content. */
static void mark_drawn(struct ceduo_svg *svg, int column, int row, int width)
{
    for (int i = 0; i < width; i++)
        ceduo_cells_set_code(svg->cells, column + i, row, CEDUO_ROLE_AXIS, SVG_DRAWN);
}

static void draw_bar(void *to, int column, int row, int width, double fraction, enum ceduo_role role)
{
    struct ceduo_svg *svg = to;
    struct text *path = &svg->paths[role][FILLED];
    double length = fmax(fraction * width * SVG_CELL, 1);
    put_point(path, 'M', (struct ceduo_position){column * SVG_CELL, row * 2 * SVG_CELL + 3});
    ceduo_text_char(path, 'h');
    ceduo_svg_number(path, length);
    ceduo_text_put(path, "v10h");
    ceduo_svg_number(path, -length);
    ceduo_text_char(path, 'z');
    mark_drawn(svg, column, row, (int)ceil(length / SVG_CELL));
}

/* The label of a tick; `anchor`: as SVG names it. */
static void put_number(struct ceduo_svg *svg, double x, double y, const char *anchor, const char *label)
{
    struct ceduo_html html = {.text = &svg->numbers};
    struct text across = {0}, down = {0};
    ceduo_svg_number(&across, x);
    ceduo_svg_number(&down, y);
    ceduo_html_leaf(&html, "text", label, "x", ceduo_text_string(&across), "y", ceduo_text_string(&down), "fill",
                    paper.looks[CEDUO_ROLE_AXIS].colour, "text-anchor", anchor, NULL);
    ceduo_text_free(&across);
    ceduo_text_free(&down);
}

static void draw_axis_left(void *to, const struct ceduo_frame *frame, int count, const struct ceduo_tick *ticks)
{
    struct ceduo_svg *svg = to;
    double x = frame->left * SVG_CELL - 2.5;
    ceduo_text_format(&svg->axes, "M%.1f %dV%d", x, frame->top * 2 * SVG_CELL, (frame->top + frame->height) * 2 * SVG_CELL);
    for (int i = 0; i < count; i++) {
        double y = floor(ticks[i].at * 2 * SVG_CELL) + 0.5;
        ceduo_text_format(&svg->axes, "M%.1f %.1fh-4", x, y);
        if (ticks[i].start < 0)
            continue;
        put_number(svg, x - 6, y + 4, "end", ticks[i].label);
        mark_drawn(svg, ticks[i].start, ticks[i].cell, (int)strlen(ticks[i].label));
    }
    for (int row = frame->top; row < frame->top + frame->height; row++)
        mark_drawn(svg, frame->left - 1, row, 1);
}

static void draw_axis_bottom(void *to, const struct ceduo_frame *frame, int count, const struct ceduo_tick *ticks)
{
    struct ceduo_svg *svg = to;
    int row = frame->top + frame->height;
    double y = row * 2 * SVG_CELL + 2.5;
    ceduo_text_format(&svg->axes, "M%.1f %.1fH%d", frame->left * SVG_CELL - 2.5, y, (frame->left + frame->width) * SVG_CELL);
    for (int i = 0; i < count; i++) {
        int length = (int)strlen(ticks[i].label);
        double x = floor(ticks[i].at * SVG_CELL) + 0.5;
        bool moved = ticks[i].start != ticks[i].cell - (length - 1) / 2;
        ceduo_text_format(&svg->axes, "M%.1f %.1fv4", x, y);
        put_number(svg, moved ? (ticks[i].start + length / 2.0) * SVG_CELL : x, row * 2 * SVG_CELL + BELOW, "middle",
                   ticks[i].label);
        mark_drawn(svg, ticks[i].start, row + 1, length);
    }
    mark_drawn(svg, frame->left, row, frame->width);
}

static void draw_axis_unit(void *to, int column, int row, const char *unit)
{
    struct ceduo_svg *svg = to;
    put_number(svg, column * SVG_CELL, (row - 1) * 2 * SVG_CELL + BELOW, "start", unit);
    mark_drawn(svg, column, row, label_width(NULL, unit));
}

static bool start_cloud(void *to)
{
    struct ceduo_svg *svg = to;
    return ceduo_cells_surface.cloud_start(svg->cells);
}

/* The ways stand on the page already, each as a thin line: where many pass it is dark. */
static void show_cloud(void *to, double quantile)
{
    struct ceduo_svg *svg = to;
    end_stroke(svg);
    ceduo_cells_surface.cloud_show(svg->cells, quantile);
}

static int put_label(void *to, int column, int row, enum ceduo_role role, const char *text)
{
    struct ceduo_svg *svg = to;
    return ceduo_cells_label(svg->cells, column, row, role, text);
}

static bool is_blank(const void *to, int column, int row)
{
    const struct ceduo_svg *svg = to;
    return ceduo_cells_glyph(svg->cells, column, row) == ' ';
}

static const struct ceduo_surface surface = {
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
    .disc = draw_disc,
};

/* ---- the picture ---- */

struct ceduo_svg *ceduo_svg_create(int width, int height)
{
    struct ceduo_svg *svg = calloc(1, sizeof *svg);
    if (!svg)
        return NULL;
    svg->cells = ceduo_cells_create(width, height, CEDUO_CHARSET_BRAILLE);
    if (!svg->cells) {
        free(svg);
        return NULL;
    }
    svg->canvas = (struct ceduo_canvas){&surface, svg, svg->cells->canvas.dots_x, svg->cells->canvas.dots_y};
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
    return &svg->canvas;
}

static void put_role(struct ceduo_html *html, struct ceduo_svg *svg, unsigned role)
{
    const struct ceduo_svg_look *look = &paper.looks[role];
    struct text *paths = svg->paths[role];
    html->text->failed |= paths[FILLED].failed;
    if (paths[FILLED].length > 0)
        ceduo_html_empty(html, "path", "fill", look->colour, "d", paths[FILLED].bytes, NULL);
    ceduo_svg_stroke(html, look, &paths[CLOUD], "stroke-opacity", ".3");
    ceduo_svg_stroke(html, look, &paths[DOTTED], "stroke-dasharray", "4 4");
    ceduo_svg_stroke(html, look, &paths[PLAIN], NULL, NULL);
}

static void put_marks(struct ceduo_html *html, struct ceduo_svg *svg)
{
    static const int ranks[CEDUO_ROLE_COUNT] = {
#define X(NAME, letter, rank) rank,
        CEDUO_ROLES(X)
#undef X
    };
    ceduo_html_open(html, "g", "stroke-linecap", "round", "stroke-linejoin", "round", NULL);
    for (int rank = 0; rank <= CEDUO_ROLE_COUNT; rank++)
        for (unsigned role = 0; role < CEDUO_ROLE_COUNT; role++)
            if (ranks[role] == rank)
                put_role(html, svg, role);
    ceduo_html_close(html);
    ceduo_svg_stroke(html, &paper.looks[CEDUO_ROLE_AXIS], &svg->axes, NULL, NULL);
}

/* The element with its title and description; a file of its own brings its size and its paper. */
static void open_picture(struct ceduo_html *html, const struct ceduo_svg *svg, const struct ceduo_svg_words *words)
{
    int width = svg->cells->width * SVG_CELL, height = svg->cells->height * 2 * SVG_CELL;
    char box[64], across[16], down[16], id[64];
    const char *file = words->id ? NULL : "http://www.w3.org/2000/svg";
    snprintf(box, sizeof box, "0 0 %d %d", width, height);
    snprintf(across, sizeof across, "%d", width);
    snprintf(down, sizeof down, "%d", height);
    snprintf(id, sizeof id, "%s-d", words->id ? words->id : "picture");
    ceduo_html_open(html, "svg", "viewBox", box, "role", "img", "aria-label", words->title, "aria-describedby", id,
                    file ? "xmlns" : "class", file, file ? "width" : "class", file ? across : NULL, file ? "height" : "class",
                    file ? down : NULL, NULL);
    ceduo_html_leaf(html, "title", words->title, NULL);
    ceduo_html_leaf(html, "desc", words->description, "id", id, NULL);
    if (file)
        ceduo_html_empty(html, "rect", "width", across, "height", down, "fill", "#fff", NULL);
}

double ceduo_svg_aspect(const struct ceduo_svg *svg)
{
    return 2.0 * svg->cells->height / svg->cells->width;
}

void ceduo_svg_put(struct ceduo_html *html, struct ceduo_svg *svg, const struct ceduo_svg_words *words)
{
    end_stroke(svg);
    open_picture(html, svg, words);
    put_marks(html, svg);
    ceduo_html_open(html, "g", "font-family", paper.font, "font-size", "12.5", NULL);
    ceduo_text_add(html->text, ceduo_text_string(&svg->numbers), svg->numbers.length);
    html->text->failed |= svg->numbers.failed;
    ceduo_svg_cells(html, svg->cells, &paper);
    ceduo_html_close(html);
    ceduo_html_close(html);
}
