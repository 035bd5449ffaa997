/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_statistics_double.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/must.h"
#include "plot_parts.h"

/* Strips along the slope: curves of what the rocks that pass each place have in height or energy. */

struct curve {
    const char *name;
    enum ceduo_role role;
    int on, of_dots; /* a stroke of `on` columns of dots in each `of_dots`; 1, 1: a line */
    bool bare;       /* of the rocks without forest */
    size_t offset;   /* of its value in a cell */
};

#define CURVES_MOST 4

/* What a strip shows. */
struct content {
    const char *caption;
    int count;
    struct curve curves[CURVES_MOST];
};

struct strip {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    const struct ceduo_run_snapshot *sight, *bare;
    const struct content *content;
    bool energy, legend; /* legend: of bare and wooded curves */
    struct ceduo_frame frame;
    double from, to; /* the stretch */
};

#define OF(member) offsetof(struct ceduo_envelope, member)

/* Of heights and of energies: without forest alone; both; both where there is no room to tell four curves apart. Curves
 * through the forest are strokes, those without it dots, so that the two differ without colour. */
static const struct content contents[2][3] = {
    {{N_("underside above the ground, m"),
      3,
      {{N_("max"), CEDUO_ROLE_BARE, 1, 4, false, OF(height.max)},
       {N_("p95"), CEDUO_ROLE_ENVELOPE, 1, 2, false, OF(height.p95)},
       {N_("p50"), CEDUO_ROLE_MEAN, 1, 1, false, OF(height.p50)}}},
     {N_("underside, m up"),
      4,
      {{N_("bare p95"), CEDUO_ROLE_BARE, 1, 4, true, OF(height.p95)},
       {N_("wood p95"), CEDUO_ROLE_WOOD, 4, 6, false, OF(height.p95)},
       {N_("bare p50"), CEDUO_ROLE_BARE, 1, 2, true, OF(height.p50)},
       {N_("wood p50"), CEDUO_ROLE_WOOD, 1, 1, false, OF(height.p50)}}},
     {N_("underside p95, m"),
      2,
      {{N_("bare"), CEDUO_ROLE_BARE, 1, 2, true, OF(height.p95)}, {N_("wood"), CEDUO_ROLE_WOOD, 1, 1, false, OF(height.p95)}}}},
    {{N_("energy, kJ"),
      4,
      {{N_("p95"), CEDUO_ROLE_ENVELOPE, 1, 2, false, OF(energy.p95)},
       {N_("mean"), CEDUO_ROLE_MEAN, 1, 1, false, OF(mean_energy)},
       {N_("p50"), CEDUO_ROLE_BARE, 1, 4, false, OF(energy.p50)},
       {N_("p5"), CEDUO_ROLE_ENVELOPE, 1, 2, false, OF(energy.p5)}}},
     {N_("energy, kJ"),
      4,
      {{N_("bare p95"), CEDUO_ROLE_BARE, 1, 4, true, OF(energy.p95)},
       {N_("wood p95"), CEDUO_ROLE_WOOD, 4, 6, false, OF(energy.p95)},
       {N_("bare mean"), CEDUO_ROLE_BARE, 1, 2, true, OF(mean_energy)},
       {N_("wood mean"), CEDUO_ROLE_WOOD, 1, 1, false, OF(mean_energy)}}},
     {N_("mean energy, kJ"),
      2,
      {{N_("bare"), CEDUO_ROLE_BARE, 1, 2, true, OF(mean_energy)},
       {N_("wood"), CEDUO_ROLE_WOOD, 1, 1, false, OF(mean_energy)}}}},
};

static double value_at(const struct strip *s, const struct curve *curve, size_t cell)
{
    const struct ceduo_envelope *e = &(curve->bare ? s->bare : s->sight)->envelopes[cell];
    return *(const double *)(const void *)((const char *)e + curve->offset) * (s->energy ? J_TO_KJ : 1);
}

/* Columns for the names of the curves and a blank on either side. */
static int name_columns(const struct ceduo_canvas *canvas, const struct content *content)
{
    int widest = 4;
    for (int i = 0; i < content->count; i++) {
        int width = ceduo_canvas_label_width(canvas, _(content->curves[i].name));
        widest = width > widest ? width : widest;
    }
    return widest + 2;
}

/* ---- the scale ---- */

/* What decides the scale. */
struct peak {
    double largest, at, usual; /* the largest value and where it is; what 85 % of the cells do not exceed */
    const char *curve;         /* whose it is */
};

/* Takes in one curve; returns how many cells it has. */
static size_t add_peak(const struct strip *s, const struct curve *curve, struct peak *peak)
{
    const struct ceduo_snapshot *o = s->picture->snapshot;
    const struct ceduo_envelope *cells = (curve->bare ? s->bare : s->sight)->envelopes;
    double *values = ceduo_must(malloc((o->cells + 1) * sizeof *values));
    size_t n = 0;
    for (size_t i = 0; i < o->cells; i++) {
        double v = value_at(s, curve, i);
        if (o->cell_x[i] < s->from || o->cell_x[i] > s->to || cells[i].passed == 0 || isnan(v))
            continue;
        if (v > peak->largest)
            *peak = (struct peak){v, o->cell_x[i], peak->usual, curve->name};
        values[n++] = v;
    }
    if (n > 0)
        peak->usual = fmax(peak->usual, gsl_stats_select(values, 1, n, (n - 1) * 85 / 100));
    free(values);
    return n;
}

/* The top of the scale: what is usual, where a few places (the foot of a wall) would flatten all the rest. False where
 * no rock passes. */
static bool scale(struct strip *s, struct peak *peak)
{
    size_t cells = 0;
    *peak = (struct peak){0};
    for (int i = 0; i < s->content->count; i++)
        cells += add_peak(s, &s->content->curves[i], peak);
    bool cut = peak->largest > 1.5 * 1.15 * peak->usual && peak->usual > 0;
    double top = cut ? 1.15 * peak->usual : 1.05 * peak->largest;
    double most = s->energy ? 2 * top : 0; /* what the things at risk bear, as far as the strip can show it */
    for (size_t c = 0; c < s->picture->scene->controls_count; c++) {
        double accepted = s->picture->scene->controls[c].accepted * J_TO_KJ;
        top = accepted <= most ? fmax(top, 1.1 * accepted) : top;
    }
    s->frame.y0 = 0;
    s->frame.y1 = top > 0 ? top : 1;
    return cells > 0;
}

/* ---- curves ---- */

/* What of the strokes, which lie at the same columns for all curves, falls on a piece of the curve. */
static void draw_strokes(struct strip *s, const struct curve *curve, double ax, double ay, double bx, double by)
{
    struct ceduo_frame *f = &s->frame;
    int dots = f->width * s->canvas->dots_x - 1;
    double metres = (f->x1 - f->x0) / dots, step = curve->of_dots * metres, length = (curve->on - 1) * metres;
    double slope = (by - ay) / (bx - ax);
    for (double i = floor((ax - f->x0) / step); f->x0 + i * step < bx; i++) {
        double from = fmax(f->x0 + i * step, ax), to = fmin(f->x0 + i * step + length, bx);
        if (from <= to)
            ceduo_canvas_line(s->canvas, f, curve->role, from, ay + (from - ax) * slope, to, ay + (to - ax) * slope);
    }
}

static void draw_curve(struct strip *s, const struct curve *curve)
{
    const struct ceduo_snapshot *o = s->picture->snapshot;
    for (size_t i = 1; i < o->cells; i++) {
        double ax = o->cell_x[i - 1], bx = o->cell_x[i];
        double ay = value_at(s, curve, i - 1), by = value_at(s, curve, i);
        if (isnan(ay) || isnan(by))
            continue;
        if (curve->of_dots == 1)
            ceduo_canvas_line(s->canvas, &s->frame, curve->role, ax, ay, bx, by);
        else
            draw_strokes(s, curve, ax, ay, bx, by);
    }
}

/* The trajectories above the ground that they pass over. */
static void draw_ways(const struct strip *s)
{
    ceduo_canvas_cloud_start(s->canvas);
    for (size_t i = 0; i < s->sight->trajectories_count; i++) {
        const struct ceduo_polyline *t = &s->sight->trajectories[i];
        double *heights = ceduo_must(malloc((t->n + 1) * sizeof *heights));
        for (size_t k = 0; k < t->n; k++)
            heights[k] = fmax(t->z[k] - ceduo_slope_height(&s->picture->scene->slope, t->x[k]), 0);
        ceduo_canvas_cloud_add(s->canvas, &s->frame, t->n, t->x, heights);
        free(heights);
    }
    ceduo_canvas_cloud_show(s->canvas, 0);
}

/* Where a curve ends inside the frame: its value, cut at the top; NaN where no rock passes or it lies below. */
static double end_of(const struct strip *s, const struct curve *curve)
{
    const struct ceduo_snapshot *o = s->picture->snapshot;
    for (size_t i = o->cells; i-- > 0;) {
        double y = value_at(s, curve, i);
        int column, row;
        if (o->cell_x[i] < s->from || o->cell_x[i] > s->to || isnan(y))
            continue;
        y = fmin(y, s->frame.y1);
        return ceduo_frame_cell(&s->frame, s->canvas, o->cell_x[i], y, &column, &row) ? y : NAN;
    }
    return NAN;
}

/* The name of each curve that ends inside the frame to the right of its end, the highest first, none in the row of another. */
static void name_curves(const struct strip *s)
{
    const struct curve *sorted[CURVES_MOST];
    double ends[CURVES_MOST];
    int left = s->frame.left + s->frame.width + 1, room = s->area->left + s->area->width - left;
    int last = s->frame.top + s->frame.height - 1, next = s->frame.top, n = 0;
    if (room < 4 || s->frame.height < s->content->count)
        return;
    for (int i = 0; i < s->content->count; i++) {
        double end = end_of(s, &s->content->curves[i]);
        if (isnan(end))
            continue;
        int at = n++;
        for (; at > 0 && ends[at - 1] < end; at--) {
            sorted[at] = sorted[at - 1];
            ends[at] = ends[at - 1];
        }
        sorted[at] = &s->content->curves[i];
        ends[at] = end;
    }
    for (int i = 0; i < n; i++) {
        int column, row, lowest = last - (n - 1 - i);
        ceduo_frame_cell(&s->frame, s->canvas, s->frame.x0, ends[i], &column, &row);
        row = row < next ? next : row > lowest ? lowest : row;
        ceduo_canvas_put(s->canvas, left, row, room, sorted[i]->role, _(sorted[i]->name));
        next = row + 1;
    }
}

/* ---- controls ---- */

static bool is_free(const struct strip *s, int column, int row, int width)
{
    const struct ceduo_frame *f = &s->frame;
    bool inside = row >= f->top && row < f->top + f->height && column >= f->left && column + width <= f->left + f->width;
    for (int i = -1; inside && i <= width; i++) /* a blank on either side, so that it is no part of a curve */
        inside = ceduo_canvas_is_blank(s->canvas, column + i, row);
    return inside;
}

/* A place for a label beside a line at `row`, before it or behind it, in that row or the nearest that is free of
 * curves. False where there is none: what it says stands beside the pictures, too. */
static bool find_free(const struct strip *s, int before, int behind, int width, int *column, int *row)
{
    for (int i = 0; i < 2 * s->frame.height; i++) {
        int at = *row + (i % 2 ? -(i + 1) / 2 : i / 2);
        *column = is_free(s, before, at, width) ? before : behind;
        if (is_free(s, *column, at, width)) {
            *row = at;
            return true;
        }
    }
    return false;
}

static void draw_accepted(const struct strip *s, const struct ceduo_control *c)
{
    double accepted = c->accepted * J_TO_KJ, reach = 0.03 * (s->frame.x1 - s->frame.x0);
    int column, row;
    if (isnan(accepted) || !ceduo_frame_cell(&s->frame, s->canvas, c->x, accepted, &column, &row))
        return;
    ceduo_canvas_line(s->canvas, &s->frame, CEDUO_ROLE_BAD, c->x - reach, accepted, c->x + reach, accepted);
    LOCAL_TEXT(label);
    ceduo_text_format(&label, _("withstands %g kJ"), accepted);
    int width = ceduo_canvas_label_width(s->canvas, label.bytes), left, right;
    ceduo_frame_cell(&s->frame, s->canvas, fmax(c->x - reach, s->frame.x0), accepted, &left, &row);
    ceduo_frame_cell(&s->frame, s->canvas, fmin(c->x + reach, s->frame.x1), accepted, &right, &row);
    if (find_free(s, left - 1 - width, right + 2, width, &column, &row))
        ceduo_canvas_label(s->canvas, column, row, CEDUO_ROLE_BAD, label.bytes);
}

/* ---- the strip ---- */

static void place_frame(struct strip *s)
{
    const struct ceduo_area *a = s->area;
    const struct ceduo_span *span = s->picture->span;
    bool axis = !s->picture->no_x_axis;
    int caption = a->height - 2 * axis >= 4;
    s->frame.top = a->top + caption;
    s->frame.height = a->height - caption - 2 * axis;
    if (span) {
        s->frame.left = span->left;
        s->frame.width = span->width;
        s->frame.x0 = span->x0;
        s->frame.x1 = span->x1;
        return;
    }
    int labels = ceduo_frame_axis_width(&s->frame, s->canvas);
    int names = a->width >= 40 ? name_columns(s->canvas, s->content) : 0;
    s->frame.left = a->left + labels;
    s->frame.width = a->width - labels - names;
    s->frame.x0 = s->from;
    s->frame.x1 = s->to;
}

/* What is shown, how strokes tell the wooded curves from the bare ones, and what lies beyond the top, in as many words as there is
 * room for. */
static void put_caption(const struct strip *s, const struct peak *peak)
{
    static const struct {
        enum ceduo_role role;
        const char *text;
    } parts[] = {{CEDUO_ROLE_WOOD, N_("\xe2\x94\x80\xe2\x94\x80 wood")}, {CEDUO_ROLE_BARE, N_("\xc2\xb7\xc2\xb7 bare")}};
    int row = s->area->top, column = s->frame.left, end = s->area->left + s->area->width;
    if (s->frame.top == row)
        return;
    column += ceduo_canvas_put(s->canvas, column, row, end - column, CEDUO_ROLE_AXIS, _(s->content->caption));
    for (int i = 0; i < 2 && s->legend; i++) {
        column += ceduo_canvas_put(s->canvas, column, row, end - column, parts[i].role, "  ");
        column += ceduo_canvas_put(s->canvas, column, row, end - column, parts[i].role, _(parts[i].text));
    }
    if (!(peak->largest > s->frame.y1))
        return;
    const char *name = _(peak->curve), *unit = s->energy ? _("kJ") : _("m"), *value = WRITTEN(peak->largest, 3);
    struct text words[3] = {{0}};
    ceduo_text_then(&words[0], "; ", _("%s beyond the top: %s %s at %s m"), name, value, unit,
                    WRITTEN(peak->at + s->picture->scene->slope.origin_x, 3));
    ceduo_text_then(&words[1], "; ", _("%s up to %s %s"), name, value, unit);
    ceduo_text_then(&words[2], "; ", _("up to %s"), value);
    ceduo_plot_put_fitting(s->canvas, column, row, end - column, CEDUO_ROLE_WARN, 3, words);
}

#define FULL_ROWS  8  /* four curves need so many rows, */
#define FULL_WIDTH 56 /* so many columns, and names beside them */

static const char *draw_strip(struct strip *s)
{
    const struct ceduo_span *span = s->picture->span;
    const struct content *fitting = contents[s->energy];
    struct peak peak;
    s->legend = ceduo_plot_wooded(s->picture);
    int names = span ? s->area->left + s->area->width - span->left - span->width : INT_MAX;
    bool small = s->area->height - 1 - 2 * !s->picture->no_x_axis < FULL_ROWS || s->area->width < FULL_WIDTH ||
                 names < name_columns(s->canvas, &fitting[1]) - 1;
    s->content = &fitting[!s->legend ? 0 : small ? 2 : 1];
    s->sight = ceduo_plot_sight(s->picture);
    s->bare = ceduo_plot_bare(s->picture);
    ceduo_plot_stretch(s->picture, &s->from, &s->to);
    s->from = span ? span->x0 : s->from;
    s->to = span ? span->x1 : s->to;
    if (!s->sight || !s->bare)
        return _("not computed yet");
    if (!scale(s, &peak))
        return _("no rock passes here");
    place_frame(s);
    if (s->frame.width < 2 || s->frame.height < 1 || !(s->frame.x1 > s->frame.x0))
        return _("too narrow");
    put_caption(s, &peak);
    if (s->picture->ways && !s->energy)
        draw_ways(s);
    for (int i = 0; i < s->content->count; i++)
        draw_curve(s, &s->content->curves[i]);
    for (size_t c = 0; c < s->picture->scene->controls_count; c++) {
        const struct ceduo_control *control = &s->picture->scene->controls[c];
        ceduo_canvas_rule_x(s->canvas, &s->frame, CEDUO_ROLE_CONTROL, control->x);
        if (s->energy)
            draw_accepted(s, control);
    }
    name_curves(s);
    ceduo_plot_axes(s->canvas, &s->frame, s->picture->scene->slope.origin_x, 0, s->picture->no_x_axis ? NULL : _("m"));
    return NULL;
}

const char *ceduo_plot_height(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    return draw_strip(&(struct strip){.canvas = canvas, .area = area, .picture = picture});
}

const char *ceduo_plot_energy(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    return draw_strip(&(struct strip){.canvas = canvas, .area = area, .picture = picture, .energy = true});
}
