/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "io/intl.h"
#include "plot_parts.h"

/* Strips along the slope. */

struct curve {
    const char *name;
    enum ceduo_role role;
    int every; /* 1: a line; otherwise a dot in every so many columns of dots */
    bool bare; /* of the rocks without forest */
    double (*of)(const struct ceduo_envelope *cell);
};

struct strip {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    const struct curve *curves; /* the highest first */
    int count;
    const char *unit, *caption;
    bool energy;
    struct ceduo_frame frame;
    double from, to; /* the stretch */
};

static double height_p50(const struct ceduo_envelope *e)
{
    return e->height.p50;
}

static double height_p95(const struct ceduo_envelope *e)
{
    return e->height.p95;
}

static double height_max(const struct ceduo_envelope *e)
{
    return e->height.max;
}

static double energy_mean(const struct ceduo_envelope *e)
{
    return e->mean_energy * KILO;
}

static double energy_p5(const struct ceduo_envelope *e)
{
    return e->energy.p5 * KILO;
}

static double energy_p50(const struct ceduo_envelope *e)
{
    return e->energy.p50 * KILO;
}

static double energy_p95(const struct ceduo_envelope *e)
{
    return e->energy.p95 * KILO;
}

static const struct curve height_curves[] = {
    {N_("max"), CEDUO_ROLE_BARE, 4, false, height_max},
    {N_("p95"), CEDUO_ROLE_ENVELOPE, 2, false, height_p95},
    {N_("p50"), CEDUO_ROLE_MEAN, 1, false, height_p50},
};

static const struct curve energy_curves[] = {
    {N_("p95"), CEDUO_ROLE_ENVELOPE, 2, false, energy_p95},
    {N_("mean"), CEDUO_ROLE_MEAN, 1, false, energy_mean},
    {N_("p50"), CEDUO_ROLE_BARE, 4, false, energy_p50},
    {N_("p5"), CEDUO_ROLE_ENVELOPE, 2, false, energy_p5},
};

/* Through the forest, with those of the bare slope behind. */
static const struct curve wooded_height_curves[] = {
    {N_("bare"), CEDUO_ROLE_BARE, 3, true, height_p95},
    {N_("p95"), CEDUO_ROLE_ENVELOPE, 2, false, height_p95},
    {N_("p50"), CEDUO_ROLE_MEAN, 1, false, height_p50},
};

static const struct curve wooded_energy_curves[] = {
    {N_("bare"), CEDUO_ROLE_BARE, 4, true, energy_p95},
    {N_("p95"), CEDUO_ROLE_ENVELOPE, 2, false, energy_p95},
    {N_("bare"), CEDUO_ROLE_BARE, 3, true, energy_mean},
    {N_("mean"), CEDUO_ROLE_MEAN, 1, false, energy_mean},
};

static const struct ceduo_envelope *cells_of(const struct strip *s, const struct curve *curve)
{
    return (curve->bare ? ceduo_plot_bare(s->picture) : ceduo_plot_sight(s->picture))->envelopes;
}

static bool shown(const struct strip *s, size_t cell)
{
    double x = s->picture->outlook->cell_x[cell];
    return x >= s->from && x <= s->to;
}

/* ---- the scale ---- */

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The largest value of the highest curve and where it is; the value that 85 % of the cells do not exceed. */
static size_t largest_of(const struct strip *s, double *largest, double *at, double *usual)
{
    const struct ceduo_outlook *o = s->picture->outlook;
    const struct ceduo_envelope *cells = cells_of(s, &s->curves[0]);
    double *values = malloc((o->cells + 1) * sizeof *values);
    size_t n = 0;
    *largest = *at = *usual = 0;
    for (size_t i = 0; values && i < o->cells; i++) {
        if (!shown(s, i) || cells[i].passed == 0)
            continue;
        double v = s->curves[0].of(&cells[i]);
        if (v > *largest)
            *at = o->cell_x[i];
        *largest = fmax(*largest, v);
        values[n++] = v;
    }
    if (n > 0) {
        qsort(values, n, sizeof *values, by_value);
        *usual = values[(n - 1) * 85 / 100];
    }
    free(values);
    return n;
}

/* What the things at risk bear, as far as the strip can show it. */
static double highest_accepted(const struct strip *s, double most)
{
    double highest = 0;
    for (size_t c = 0; c < s->picture->scene->controls_count; c++) {
        double accepted = s->picture->scene->controls[c].accepted * KILO;
        if (accepted <= most)
            highest = fmax(highest, accepted);
    }
    return highest;
}

/* The top of the scale: what is usual, where a few places (the foot of a wall) would flatten all the rest. */
static bool scale(struct strip *s, double *cut, double *cut_at)
{
    double largest, usual;
    if (largest_of(s, &largest, cut_at, &usual) == 0)
        return false;
    double top = largest > 1.5 * 1.15 * usual && usual > 0 ? 1.15 * usual : 1.05 * largest;
    *cut = top < largest ? largest : NAN;
    if (s->energy)
        top = fmax(top, 1.1 * highest_accepted(s, 2 * top));
    s->frame.y0 = 0;
    s->frame.y1 = top > 0 ? top : 1;
    return true;
}

/* ---- curves ---- */

static void draw_dots(struct strip *s, const struct curve *curve, double ax, double ay, double bx, double by)
{
    struct ceduo_frame *f = &s->frame;
    int dots = f->width * ceduo_canvas_dots_x(s->canvas->charset) - 1;
    double metres = (f->x1 - f->x0) / dots;
    for (double i = ceil((ax - f->x0) / metres); i * metres + f->x0 < bx; i++)
        if (fmod(i, curve->every) == 0)
            ceduo_canvas_point(s->canvas, f, curve->role, f->x0 + i * metres,
                               ay + (by - ay) * (f->x0 + i * metres - ax) / (bx - ax));
}

static void draw_curve(struct strip *s, const struct curve *curve)
{
    const struct ceduo_outlook *o = s->picture->outlook;
    const struct ceduo_envelope *cells = cells_of(s, curve);
    for (size_t i = 1; i < o->cells; i++) {
        double ax = o->cell_x[i - 1], bx = o->cell_x[i];
        double ay = curve->of(&cells[i - 1]), by = curve->of(&cells[i]);
        if (isnan(ay) || isnan(by))
            continue;
        if (curve->every == 1)
            ceduo_canvas_line(s->canvas, &s->frame, curve->role, ax, ay, bx, by);
        else
            draw_dots(s, curve, ax, ay, bx, by);
    }
}

/* The row in which a curve ends; -1 where it has no end inside the frame. */
static int end_row(const struct strip *s, const struct curve *curve)
{
    const struct ceduo_outlook *o = s->picture->outlook;
    for (size_t i = o->cells; i-- > 0;) {
        double y = curve->of(&cells_of(s, curve)[i]);
        int column, row;
        if (!shown(s, i) || isnan(y))
            continue;
        return ceduo_frame_cell(&s->frame, s->canvas->charset, o->cell_x[i], fmin(y, s->frame.y1), &column, &row) ? row
                                                                                                                  : -1;
    }
    return -1;
}

/* Each curve's name to the right of its end, none in the row of another. */
static void name_curves(const struct strip *s)
{
    int column = s->frame.left + s->frame.width + 1, room = s->area->left + s->area->width - column;
    int last = s->frame.top + s->frame.height - 1, next = s->frame.top;
    if (room < 4 || s->frame.height < s->count)
        return;
    for (int i = 0; i < s->count; i++) {
        int row = end_row(s, &s->curves[i]), lowest = last - (s->count - 1 - i);
        if (row < 0)
            continue;
        row = row < next ? next : row > lowest ? lowest : row;
        ceduo_plot_put(s->canvas, column, row, room, s->curves[i].role, _(s->curves[i].name));
        next = row + 1;
    }
}

/* ---- controls ---- */

static void draw_accepted(const struct strip *s, const struct ceduo_control *c)
{
    double accepted = c->accepted * KILO, reach = 0.03 * (s->frame.x1 - s->frame.x0);
    int column, row;
    if (isnan(accepted) || !ceduo_frame_cell(&s->frame, s->canvas->charset, c->x, accepted, &column, &row))
        return;
    ceduo_canvas_line(s->canvas, &s->frame, CEDUO_ROLE_BAD, c->x - reach, accepted, c->x + reach, accepted);
    struct text label = {0};
    ceduo_text_format(&label, _("bears %g kJ"), accepted);
    int width = label.bytes ? ceduo_canvas_label_width(s->canvas->charset, label.bytes) : 0;
    ceduo_frame_cell(&s->frame, s->canvas->charset, fmax(c->x - reach, s->frame.x0), accepted, &column, &row);
    if (column - 2 - width >= s->frame.left)
        ceduo_canvas_label_right(s->canvas, column - 2, row, CEDUO_ROLE_BAD, label.bytes);
    ceduo_text_free(&label);
}

static void draw_controls(const struct strip *s)
{
    const struct ceduo_scene *scene = s->picture->scene;
    for (size_t c = 0; c < scene->controls_count; c++) {
        ceduo_canvas_rule_x(s->canvas, &s->frame, CEDUO_ROLE_CONTROL, scene->controls[c].x);
        if (s->energy)
            draw_accepted(s, &scene->controls[c]);
    }
}

/* ---- the strip ---- */

static void place_frame(struct strip *s, const struct ceduo_span *span, bool axis)
{
    const struct ceduo_area *a = s->area;
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
    int labels = ceduo_frame_axis_width(&s->frame, s->canvas->charset);
    int names = a->width >= 40 ? 6 : 0;
    s->frame.left = a->left + labels;
    s->frame.width = a->width - labels - names;
    s->frame.x0 = s->from;
    s->frame.x1 = s->to;
}

static void put_caption(const struct strip *s, double cut, double cut_at)
{
    char value[PLOT_NUMBER_ROOM], at[PLOT_NUMBER_ROOM];
    int left = s->frame.left, room = s->area->left + s->area->width - left;
    if (s->frame.top == s->area->top)
        return;
    int used = ceduo_plot_put(s->canvas, left, s->area->top, room, CEDUO_ROLE_AXIS, s->caption);
    if (isnan(cut))
        return;
    ceduo_plot_say(s->canvas, left + used, s->area->top, room - used, CEDUO_ROLE_WARN,
                   _("; %s beyond the top: %s %s at %s m"), s->curves[0].name, ceduo_plot_number(cut, 3, value),
                   s->unit, ceduo_plot_number(cut_at + s->picture->scene->slope.origin_x, 3, at));
}

static void draw_strip(struct strip *s, const struct ceduo_span *span, bool axis)
{
    double cut, cut_at;
    ceduo_plot_stretch(s->picture, &s->from, &s->to);
    s->from = span ? span->x0 : s->from;
    s->to = span ? span->x1 : s->to;
    if (!ceduo_plot_sight(s->picture) || !ceduo_plot_bare(s->picture)) {
        ceduo_plot_words(s->canvas, s->area, _("not computed yet"));
        return;
    }
    if (!scale(s, &cut, &cut_at)) {
        ceduo_plot_words(s->canvas, s->area, _("no rock passes here"));
        return;
    }
    place_frame(s, span, axis);
    if (s->frame.width < 2 || s->frame.height < 1 || !(s->frame.x1 > s->frame.x0)) {
        ceduo_plot_words(s->canvas, s->area, _("too narrow"));
        return;
    }
    put_caption(s, cut, cut_at);
    for (int i = 0; i < s->count; i++)
        draw_curve(s, &s->curves[i]);
    draw_controls(s);
    name_curves(s);
    struct ceduo_frame given = s->frame;
    given.x0 += s->picture->scene->slope.origin_x;
    given.x1 += s->picture->scene->slope.origin_x;
    ceduo_canvas_axis_left(s->canvas, &given);
    if (axis)
        ceduo_canvas_axis_bottom(s->canvas, &given, _("m"));
}

void ceduo_plot_height(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture,
                       const struct ceduo_span *span, bool axis)
{
    bool wooded = ceduo_plot_wooded(picture);
    struct strip s = {.canvas = canvas,
                      .area = area,
                      .picture = picture,
                      .curves = wooded ? wooded_height_curves : height_curves,
                      .count = 3,
                      .unit = _("m"),
                      .caption = wooded ? _("height above the ground, m; bare: 95 %") : _("height above the ground, m")};
    draw_strip(&s, span, axis);
}

void ceduo_plot_energy(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture,
                       const struct ceduo_span *span, bool axis)
{
    bool wooded = ceduo_plot_wooded(picture);
    struct strip s = {.canvas = canvas,
                      .area = area,
                      .picture = picture,
                      .curves = wooded ? wooded_energy_curves : energy_curves,
                      .count = 4,
                      .energy = true,
                      .unit = _("kJ"),
                      .caption = wooded ? _("energy, kJ; bare: 95 % and mean") : _("energy, kJ")};
    draw_strip(&s, span, axis);
}
