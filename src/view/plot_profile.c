/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "plot.h"

/* ---- the scale ---- */

#define RARE       0.2  /* share of the passed dots that so few trajectories pass that they are left out */
#define LEAST_USED 0.45 /* share of the area that the slope should take at true scale */

struct range {
    double x_lo, x_hi, y_lo, y_hi;
};

static void widen(struct range *r, double z)
{
    r->y_lo = fmin(r->y_lo, z);
    r->y_hi = fmax(r->y_hi, z);
}

static void widen_by_line(struct range *r, const struct ceduo_polyline *t)
{
    for (size_t i = 0; i < t->n; i++)
        if (t->x[i] >= r->x_lo && t->x[i] <= r->x_hi)
            widen(r, t->z[i]);
}

/* By the ground from x to x, and what stands on it. */
static void widen_by_ground(struct range *r, const struct ceduo_slope *slope, double from, double to, double tall)
{
    from = fmax(from, r->x_lo);
    to = fmin(to, r->x_hi);
    if (!(to > from))
        return;
    widen(r, ceduo_slope_height(slope, from) + tall);
    widen(r, ceduo_slope_height(slope, to) + tall);
    for (size_t i = 0; i < slope->vertices; i++)
        if (slope->x[i] > from && slope->x[i] < to)
            widen(r, slope->z[i] + tall);
}

static bool is_stretch(const struct ceduo_drawing *d)
{
    return d->picture->to > d->picture->from;
}

/* Returns the height of the tallest stem, 0 without stems. */
static double tallest_of(const struct ceduo_stand *stand)
{
    double tallest = 0;
    for (size_t i = 0; i < stand->shoots_count; i++)
        tallest = fmax(tallest, stand->shoots[i].per_ha > 0 ? stand->shoots[i].height : 0);
    for (size_t i = 0; i < stand->trees_count; i++)
        tallest = fmax(tallest, stand->trees[i].per_ha > 0 ? stand->trees[i].height : 0);
    return tallest;
}

/* All that is to be seen: ground, release, trajectories, stems; of a stretch stems may reach beyond the top. */
static struct range range_of(const struct ceduo_drawing *d)
{
    const struct ceduo_release *release = &d->scene->release;
    struct range r = {d->from, d->to, INFINITY, -INFINITY};
    widen_by_ground(&r, &d->scene->slope, d->from, d->to, 0);
    if (release->x.mean >= r.x_lo && release->x.mean <= r.x_hi)
        widen(&r, ceduo_slope_height(&d->scene->slope, release->x.mean) + release->height.mean);
    for (size_t i = 0; d->sight && i < d->sight->trajectories_count; i++)
        widen_by_line(&r, &d->sight->trajectories[i]);
    if (d->picture->selected)
        widen_by_line(&r, d->picture->selected);
    for (size_t i = 0; d->option && !is_stretch(d) && i < d->option->belts_count; i++) {
        const struct ceduo_belt *belt = &d->option->belts[i];
        widen_by_ground(&r, &d->scene->slope, belt->from, belt->to, tallest_of(&belt->stand));
    }
    return r;
}

/* Sets the frame's ranges with heights drawn `factor` times as long as lengths. */
static bool fit(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct range *r, double factor)
{
    if (!ceduo_frame_true_scale(f, canvas, r->x_lo, r->x_hi, factor * r->y_lo, factor * r->y_hi))
        return false;
    f->y0 /= factor;
    f->y1 /= factor;
    return true;
}

/* 1 where true scale makes use of the area, otherwise a round factor with which the slope does. */
static double height_factor(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, const struct range *r)
{
    static const double round[] = {0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    const int one = 9, n = sizeof round / sizeof round[0];
    struct ceduo_frame f = *frame;
    if (!fit(&f, canvas, r, 1))
        return 1;
    double across = (r->x_hi - r->x_lo) / (f.x1 - f.x0), up = (r->y_hi - r->y_lo) / (f.y1 - f.y0);
    int i = one;
    if (up < LEAST_USED)
        while (i + 1 < n && round[i + 1] * up <= 1)
            i++;
    else if (across < LEAST_USED)
        while (i > 0 && across / round[i] < LEAST_USED)
            i--;
    return round[i];
}

/* Fits the ranges, the ground at the bottom, the slope's start at the left; gives up columns without slope. A stretch is always
 * true to scale. Returns the factor of heights, NaN where nothing can be drawn. */
static double scale(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct range *r, bool stretch)
{
    double factor = stretch ? 1 : height_factor(f, canvas, r);
    if (!fit(f, canvas, r, factor))
        return NAN;
    int needed = (int)ceil(f->width * (r->x_hi - r->x_lo) / (f->x1 - f->x0));
    if (needed < f->width && needed >= 2) {
        f->width = needed;
        fit(f, canvas, r, factor);
    }
    f->x1 = r->x_lo + (f->x1 - f->x0);
    f->x0 = r->x_lo;
    f->y1 = r->y_lo + (f->y1 - f->y0);
    f->y0 = r->y_lo;
    return factor;
}

/* ---- what stands on the slope ---- */

/* A row of stems at their mean distance in the stand, but no closer than can be told apart. */
static void draw_stems(const struct ceduo_drawing *d, const struct ceduo_belt *belt, const struct ceduo_stems *stems,
                       enum ceduo_role role)
{
    const struct ceduo_slope *slope = &d->scene->slope;
    double dot = (d->frame.x1 - d->frame.x0) / (d->frame.width * d->canvas->dots_x - 1);
    double step = fmax(sqrt(1e4 / stems->per_ha), 4 * dot);
    double from = fmax(belt->from, d->frame.x0), to = fmin(belt->to, fmin(d->frame.x1, slope->x[slope->vertices - 1]));
    double first = ceil((from - belt->from) / step - 0.5);
    for (double i = fmax(first, 0); belt->from + (i + 0.5) * step < to; i++) {
        double x = belt->from + (i + 0.5) * step, z = ceduo_slope_height(slope, x);
        ceduo_canvas_line(d->canvas, &d->frame, role, x, z, x, z + stems->height);
    }
}

/* The stems that the selected rock came to, where they stand, or those of the belts. */
static void draw_forest(const struct ceduo_drawing *d)
{
    const struct ceduo_slope *slope = &d->scene->slope;
    const struct ceduo_option *option = d->option;
    for (size_t i = 0; i < d->picture->stems_count; i++) {
        const struct ceduo_stem_encounter *stem = &d->picture->stems[i];
        double z = ceduo_slope_height(slope, stem->x);
        if (!(stem->x >= slope->x[0] && stem->x <= slope->x[slope->vertices - 1]))
            continue;
        ceduo_canvas_line(d->canvas, &d->frame, stem->hit ? CEDUO_ROLE_STEM : CEDUO_ROLE_DIM, stem->x, z, stem->x,
                          z + stem->height);
    }
    for (size_t i = 0; d->picture->stems_count == 0 && option && i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        for (size_t k = 0; k < belt->stand.shoots_count; k++)
            draw_stems(d, belt, &belt->stand.shoots[k], CEDUO_ROLE_STOOL);
        for (size_t k = 0; k < belt->stand.trees_count; k++)
            draw_stems(d, belt, &belt->stand.trees[k], CEDUO_ROLE_STEM);
    }
}

/* ---- names ---- */

#define NAME_ROWS  4
#define FOREST_MIN 12 /* columns that make the name of a forest worth while */

/* Whether a text has room in an area, and a blank on either side, so that it is no part of a curve. */
static bool is_free(const struct ceduo_canvas *canvas, const struct ceduo_area *area, int column, int row, int width)
{
    bool free = row >= area->top && row < area->top + area->height && column >= area->left &&
                column + width <= area->left + area->width;
    for (int i = -1; free && i <= width; i++)
        free = ceduo_canvas_is_blank(canvas, column + i, row);
    return free;
}

/* Beside its rule, to the right or the left, in the highest row that has room; nowhere where none has. */
static void name_control(const struct ceduo_drawing *d, const struct ceduo_control *control)
{
    int column, row;
    if (!ceduo_frame_cell(&d->frame, d->canvas, control->x, d->frame.y0, &column, &row))
        return;
    LOCAL_TEXT(name);
    ceduo_words_place(&name, control);
    int width = ceduo_canvas_label_width(d->canvas, name.bytes);
    for (int i = 0; i < 2 * NAME_ROWS && i < 2 * d->area.height; i++) {
        int start = i % 2 ? column - 1 - width : column + 2, y = d->area.top + i / 2;
        if (!is_free(d->canvas, &d->area, start, y, width))
            continue;
        ceduo_canvas_label(d->canvas, start, y, CEDUO_ROLE_CONTROL, name.bytes);
        if (i < 2 && ceduo_canvas_is_blank(d->canvas, column, y)) /* another word may stand there */
            ceduo_canvas_label(d->canvas, column, y, CEDUO_ROLE_CONTROL, "\xe2\x96\xbc");
        break;
    }
}

/* Writes whose forest the trajectories go through at the right end of the highest row that has most room. */
static void name_forest(const struct ceduo_drawing *d)
{
    if (!d->sight || !d->option || !d->option->name)
        return;
    LOCAL_TEXT(name);
    ceduo_text_format(&name, _("trajectories: %s"), d->wooded ? d->option->name : _("without forest"));
    int end = d->area.left + d->area.width, width = ceduo_canvas_label_width(d->canvas, name.bytes), most = 0, row = 0;
    for (int i = 0; i < NAME_ROWS && i < d->area.height; i++) {
        int column = end; /* where the blank columns at the right end begin, but for one */
        while (column > d->area.left && ceduo_canvas_is_blank(d->canvas, column - 1, d->area.top + i))
            column--;
        int room = end - column - 1;
        room = room < width ? room : width;
        row = room > most ? i : row;
        most = room > most ? room : most;
    }
    if (most == width || most >= FOREST_MIN)
        ceduo_plot_say(d->canvas, end - 1, d->area.top + row, -most, CEDUO_ROLE_CLOUD, "%s", name.bytes);
}

/* ├── ADS 1 ──┤ below the axis. */
static void draw_belts(const struct ceduo_drawing *d)
{
    const struct ceduo_frame *f = &d->frame;
    double per_metre = f->width / (f->x1 - f->x0);
    int row = d->area.top + d->area.height - 1;
    if (d->option && d->option->belts_count == 0)
        ceduo_canvas_draw_text(d->canvas, f->left, row, d->area.left + d->area.width - f->left, CEDUO_ROLE_BELT,
                               _("no forest"));
    for (size_t i = 0; d->option && i < d->option->belts_count; i++) {
        const struct ceduo_belt *belt = &d->option->belts[i];
        int from = f->left + (int)lround((fmax(belt->from, f->x0) - f->x0) * per_metre);
        int to = f->left + (int)lround((fmin(belt->to, f->x1) - f->x0) * per_metre);
        LOCAL_TEXT(name);
        for (int column = from; column < to; column++)
            ceduo_canvas_label(d->canvas, column, row, CEDUO_ROLE_BELT,
                               to - from == 1     ? "\xe2\x94\x82"
                               : column == from   ? "\xe2\x94\x9c"
                               : column == to - 1 ? "\xe2\x94\xa4"
                                                  : "\xe2\x94\x80");
        ceduo_text_char(&name, ' ');
        ceduo_plot_belt_name(&name, belt);
        ceduo_text_char(&name, ' ');
        int width = ceduo_canvas_label_width(d->canvas, name.bytes), room = to - from - 2;
        int start = width < room ? from + 1 + (room - width) / 2 : from + 1;
        ceduo_canvas_draw_text(d->canvas, start, row, room, CEDUO_ROLE_BELT, name.bytes);
    }
}

/* ---- the picture ---- */

/* Returns the factor of heights, NaN where nothing can be drawn. */
static double place_frame(struct ceduo_drawing *d, bool names, bool belts)
{
    struct range r = range_of(d);
    double factor = NAN;
    int axis = 0, needed = 1;
    while (axis < needed) { /* the axis takes columns, and they decide its labels */
        axis = needed;
        d->frame = (struct ceduo_frame){.left = d->area.left + axis,
                                        .top = d->area.top + names,
                                        .width = d->area.width - axis,
                                        .height = d->area.height - names - belts - 2};
        factor = scale(&d->frame, d->canvas, &r, is_stretch(d));
        if (isnan(factor))
            break;
        struct ceduo_frame given = ceduo_plot_given(&d->frame, d->scene->slope.origin_x, d->scene->slope.origin_z);
        needed = ceduo_frame_axis_width(&given, d->canvas);
    }
    if (d->picture->span)
        *d->picture->span = (struct ceduo_span){d->frame.left, d->frame.width, d->frame.x0, d->frame.x1};
    return factor;
}

#define MARKS_APART 3 /* columns: nearer marks would hide the ground */

/* Mark the points that simplifying keeps, if it leaves out others and there is room. */
static void mark_points(struct ceduo_drawing *d, const struct ceduo_slope *slope)
{
    int column, row, last = -MARKS_APART;
    if (slope->points <= slope->vertices || (int)slope->vertices > d->area.width / MARKS_APART)
        return;
    for (size_t i = 0; i < slope->vertices; i++)
        if (ceduo_frame_cell(&d->frame, d->canvas, slope->x[i], slope->z[i], &column, &row) && column - last >= MARKS_APART) {
            ceduo_canvas_draw_text(d->canvas, column, row, 1, CEDUO_ROLE_GROUND, "o");
            last = column;
        }
}

const char *ceduo_plot_profile(struct ceduo_drawing *d)
{
    const struct ceduo_slope *slope = &d->scene->slope;
    const struct ceduo_release *release = &d->scene->release;
    const struct ceduo_polyline *way = d->picture->selected;
    bool names = d->area.height >= 8, belts = d->area.height >= 6;
    double factor = place_frame(d, names, belts), z = ceduo_slope_height(slope, release->x.mean) + release->height.mean;
    int column, row;
    if (isnan(factor))
        return _("too narrow");
    draw_forest(d);
    ceduo_canvas_cloud_start(d->canvas);
    for (size_t i = 0; d->sight && i < d->sight->trajectories_count; i++) {
        const struct ceduo_polyline *t = &d->sight->trajectories[i];
        ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_WAY, t->n, t->x, t->z);
    }
    ceduo_canvas_cloud_show(d->canvas, RARE);
    if (way)
        ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_WAY, CEDUO_STROKE_PLAIN, way->n, way->x, way->z);
    ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_GROUND, CEDUO_STROKE_PLAIN, slope->vertices, slope->x, slope->z);
    mark_points(d, slope);
    if (ceduo_frame_cell(&d->frame, d->canvas, release->x.mean, z, &column, &row) && row - 1 >= d->area.top)
        ceduo_canvas_draw_text(d->canvas, column, row - 1, d->area.left + d->area.width - column, CEDUO_ROLE_TEXT,
                               _("\xe2\x96\xbc release"));
    if (d->picture->mark)
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_TITLE, *d->picture->mark);
    if (factor != 1) /* heights are not true to scale */
        ceduo_plot_say(d->canvas, d->area.left + d->area.width - 1, d->area.top, -d->area.width / 2, CEDUO_ROLE_WARN,
                       d->area.width >= 30 ? _("heights drawn %g times") : "\xc3\x97%g", factor);
    for (size_t c = 0; names && c < d->scene->controls_count; c++)
        name_control(d, &d->scene->controls[c]);
    for (size_t c = 0; c < d->scene->controls_count; c++)
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_CONTROL, d->scene->controls[c].x);
    if (names)
        name_forest(d);
    ceduo_plot_axes(d, slope->origin_x, slope->origin_z, _("m"));
    if (belts)
        draw_belts(d);
    return NULL;
}
