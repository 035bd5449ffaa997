/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "plot.h"
#include "report.h"

/* ---- scale ---- */

#define RARE_QUANTILE 0.2  /* quantile of passed dots below which they are not drawn */
#define USED_MIN      0.45 /* min share of the area for the slope at true scale */

struct extent {
    double x_lo, x_hi, y_lo, y_hi;
};

static void widen_extent(struct extent *r, double z)
{
    r->y_lo = fmin(r->y_lo, z);
    r->y_hi = fmax(r->y_hi, z);
}

static void include_line(struct extent *r, const struct ceduo_polyline *t)
{
    for (size_t i = 0; i < t->n; i++)
        if (t->x[i] >= r->x_lo && t->x[i] <= r->x_hi)
            widen_extent(r, t->z[i]);
}

/* Widen by the ground between two positions, plus the height of stems. */
static void include_ground(struct extent *r, const struct ceduo_slope *slope, double from, double to, double tall)
{
    from = fmax(from, r->x_lo);
    to = fmin(to, r->x_hi);
    if (!(to > from))
        return;
    widen_extent(r, ceduo_slope_height(slope, from) + tall);
    widen_extent(r, ceduo_slope_height(slope, to) + tall);
    for (size_t i = 0; i < slope->vertices; i++)
        if (slope->x[i] > from && slope->x[i] < to)
            widen_extent(r, slope->z[i] + tall);
}

static bool is_part(const struct ceduo_drawing *d)
{
    return d->picture->to > d->picture->from;
}

/* Returns the height of the tallest stem, 0 without stems. */
static double find_tallest(const struct ceduo_stand *stand)
{
    double tallest = 0;
    for (size_t i = 0; i < stand->shoots_count; i++)
        tallest = fmax(tallest, stand->shoots[i].per_ha > 0 ? stand->shoots[i].height : 0);
    for (size_t i = 0; i < stand->trees_count; i++)
        tallest = fmax(tallest, stand->trees[i].per_ha > 0 ? stand->trees[i].height : 0);
    return tallest;
}

/* Include the trajectories of an option and, unless a part of the slope is shown, its stems. */
static void include_option(struct extent *r, const struct ceduo_drawing *d, size_t index)
{
    const struct ceduo_option *option = index < d->scene->options_count ? &d->scene->options[index] : NULL;
    const struct ceduo_run_snapshot *run = ceduo_snapshot_find(d->picture->snapshot, d->scene, index);
    for (size_t i = 0; run && i < run->trajectories_count; i++)
        include_line(r, &run->trajectories[i]);
    for (size_t i = 0; option && !is_part(d) && i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        include_ground(r, &d->scene->slope, belt->from, belt->to, find_tallest(&belt->stand));
    }
}

/* Return the extent of ground, release, trajectories and stems. In a part of the slope stems may exceed the top. */
static struct extent find_extent(const struct ceduo_drawing *d)
{
    const struct ceduo_release *release = &d->scene->release;
    struct extent r = {d->from, d->to, INFINITY, -INFINITY};
    include_ground(&r, &d->scene->slope, d->from, d->to, 0);
    if (release->x.mean >= r.x_lo && release->x.mean <= r.x_hi)
        widen_extent(&r, ceduo_slope_height(&d->scene->slope, release->x.mean) + release->height.mean);
    include_option(&r, d, d->picture->option);
    if (d->picture->compared)
        include_option(&r, d, *d->picture->compared);
    if (d->picture->selected)
        include_line(&r, d->picture->selected);
    return r;
}

/* Set the frame's ranges with heights scaled by `factor`. */
static bool set_ranges(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct extent *r, double factor)
{
    if (!ceduo_frame_true_scale(f, canvas, r->x_lo, r->x_hi, factor * r->y_lo, factor * r->y_hi))
        return false;
    f->y0 /= factor;
    f->y1 /= factor;
    return true;
}

/* Return 1 if true scale uses the area well, otherwise a round factor that does. `fill`: the slope must be as wide as the
 * frame. */
static double height_factor(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, const struct extent *r,
                            bool fill)
{
    static const double round[] = {0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    const int one = 9, n = sizeof round / sizeof round[0];
    struct ceduo_frame f = *frame;
    if (!set_ranges(&f, canvas, r, 1))
        return 1;
    double across = (r->x_hi - r->x_lo) / (f.x1 - f.x0), up = (r->y_hi - r->y_lo) / (f.y1 - f.y0);
    int i = one;
    if (fill && across < 1)
        return across > 0.1 ? floor(across * 10) / 10 : across;
    if (up < USED_MIN)
        while (i + 1 < n && round[i + 1] * up <= 1)
            i++;
    else if (across < USED_MIN)
        while (i > 0 && across / round[i] < USED_MIN)
            i--;
    return round[i];
}

/* Fit the ranges: ground at the bottom, start of the slope at the left; drops empty columns. A part of the slope is always
 * true to scale. Return the factor of heights, NaN if the frame is too small. */
static double set_scale(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct extent *r, bool part, bool fill)
{
    double factor = part ? 1 : height_factor(f, canvas, r, fill);
    if (!set_ranges(f, canvas, r, factor))
        return NAN;
    int needed = (int)ceil(f->width * (r->x_hi - r->x_lo) / (f->x1 - f->x0));
    if (needed < f->width && needed >= 2) {
        f->width = needed;
        set_ranges(f, canvas, r, factor);
    }
    f->x1 = r->x_lo + (f->x1 - f->x0);
    f->x0 = r->x_lo;
    f->y1 = r->y_lo + (f->y1 - f->y0);
    f->y0 = r->y_lo;
    return factor;
}

/* ---- objects on the slope ---- */

/* Draw a row of stems at their mean distance, or at the smallest distinguishable one. */
static void draw_stem_row(const struct ceduo_drawing *d, const struct ceduo_belt *belt, const struct ceduo_stems *stems,
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

/* Draw the stems that the selected rock encountered, or those of the belts. */
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
            draw_stem_row(d, belt, &belt->stand.shoots[k], CEDUO_ROLE_STOOL);
        for (size_t k = 0; k < belt->stand.trees_count; k++)
            draw_stem_row(d, belt, &belt->stand.trees[k], CEDUO_ROLE_STEM);
    }
}

/* ---- names ---- */

#define NAME_ROWS  4
#define FOREST_MIN 12 /* min columns for the name of a forest */

/* True if a text fits in free cells with a blank on either side. */
static bool is_clear_space(const struct ceduo_canvas *canvas, const struct ceduo_area *area, int column, int row, int width)
{
    bool is_clear = row >= area->top && row < area->top + area->height && column >= area->left &&
                    column + width <= area->left + area->width;
    for (int i = -1; is_clear && i <= width; i++)
        is_clear = ceduo_canvas_is_blank(canvas, column + i, row);
    return is_clear;
}

/* Find the highest free row right or left of the rule of a control, of the first `rows`, and the first column of the text. False
 * if none is free. */
static bool find_rule_space(const struct ceduo_drawing *d, double x, const char *text, int rows, int *start, int *row)
{
    int column, width = ceduo_canvas_label_width(d->canvas, text);
    if (!ceduo_frame_cell(&d->frame, d->canvas, x, d->frame.y0, &column, row))
        return false;
    for (int i = 0; i < 2 * rows && i < 2 * d->area.height; i++) {
        *start = i % 2 ? column - 1 - width : column + 2;
        *row = d->area.top + i / 2;
        if (is_clear_space(d->canvas, &d->area, *start, *row, width))
            return true;
    }
    return false;
}

/* Write the name of a control next to its rule, if there is space. */
static void label_control(const struct ceduo_drawing *d, const struct ceduo_control *control)
{
    LOCAL_TEXT(name);
    int column, row, start, unused;
    ceduo_words_place(&name, control);
    if (!find_rule_space(d, control->x, name.bytes, NAME_ROWS, &start, &row))
        return;
    bool marked = d->picture->mark && fabs(*d->picture->mark - control->x) < 1e-9;
    ceduo_canvas_label(d->canvas, start, row, marked ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_CONTROL, name.bytes);
    ceduo_frame_cell(&d->frame, d->canvas, control->x, d->frame.y0, &column, &unused);
    if (row == d->area.top && ceduo_canvas_is_blank(d->canvas, column, row)) /* another name may occupy the cell */
        ceduo_canvas_label(d->canvas, column, row, CEDUO_ROLE_CONTROL, "\xe2\x96\xbc");
}

/* Draw the line of an angle from a point to the control, and write its name with a sample of the line. */
static void draw_angle(const struct ceduo_drawing *d, enum ceduo_stroke stroke, double x, double height, const char *name)
{
    const struct ceduo_slope *slope = &d->scene->slope;
    const double xs[2] = {x, d->control->x},
                 zs[2] = {ceduo_slope_height(slope, x) + height, ceduo_slope_height(slope, d->control->x)};
    int start, row;
    ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_TITLE, stroke, 2, xs, zs);
    if (find_rule_space(d, d->control->x, name, d->area.height / 2, &start, &row))
        ceduo_canvas_label(d->canvas, start, row, CEDUO_ROLE_TITLE, name);
}

/* Draw the reach angle and the shadow angle of the control. */
static void draw_angles(const struct ceduo_drawing *d)
{
    const struct ceduo_release *release = &d->scene->release;
    const struct ceduo_topography *t = d->bare_arrivals ? ceduo_topography_find(d->bare_arrivals) : NULL;
    LOCAL_TEXT(reach);
    LOCAL_TEXT(shadow);
    if (!t)
        return;
    ceduo_text_append(&reach, "\xe2\x94\x80 \xe2\x94\x80 ");
    ceduo_text_format(&reach, _("reach angle %.0f\xc2\xb0"), t->reach * DEGREES);
    draw_angle(d, CEDUO_STROKE_DASHES, release->x.mean, release->height.mean, reach.bytes);
    ceduo_text_append(&shadow, "\xe2\x94\x84\xe2\x94\x84\xe2\x94\x84 ");
    ceduo_text_format(&shadow, _("shadow angle %.0f\xc2\xb0"), t->shadow * DEGREES);
    if (!isnan(t->shadow))
        draw_angle(d, CEDUO_STROKE_RULE, t->foot, 0, shadow.bytes);
}

/* Write the forest of the trajectories right-aligned in the row with the most free cells. */
static void label_forest(const struct ceduo_drawing *d)
{
    if (!d->run || !d->option || !d->option->name)
        return;
    LOCAL_TEXT(name);
    ceduo_text_format(&name, _("rocks: %s"), d->wooded ? d->option->name : _("without forest"));
    int end = d->area.left + d->area.width, width = ceduo_canvas_label_width(d->canvas, name.bytes), max = 0, row = 0;
    for (int i = 0; i < NAME_ROWS && i < d->area.height; i++) {
        int column = end; /* first blank column at the right end */
        while (column > d->area.left && ceduo_canvas_is_blank(d->canvas, column - 1, d->area.top + i))
            column--;
        int space = end - column - 1;
        space = space < width ? space : width;
        row = space > max ? i : row;
        max = space > max ? space : max;
    }
    if (max == width || max >= FOREST_MIN)
        ceduo_plot_print(d->canvas, end - 1, d->area.top + row, -max, CEDUO_ROLE_CLOUD, "%s", name.bytes);
}

/* Draw ├── ADS 1 ──┤ below the axis, and ╞══ ADS 2 ══╡ for the belt under the cursor. */
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
        bool marked = d->picture->mark_belt && i == d->picture->belt;
        for (int column = from; column < to; column++)
            ceduo_canvas_label(d->canvas, column, row, CEDUO_ROLE_BELT,
                               to - from == 1     ? marked ? "\xe2\x95\x91" : "\xe2\x94\x82"
                               : column == from   ? marked ? "\xe2\x95\x9e" : "\xe2\x94\x9c"
                               : column == to - 1 ? marked ? "\xe2\x95\xa1" : "\xe2\x94\xa4"
                               : marked           ? "\xe2\x95\x90"
                                                  : "\xe2\x94\x80");
        ceduo_text_append_char(&name, ' ');
        ceduo_plot_belt_name(&name, belt);
        ceduo_text_append_char(&name, ' ');
        int width = ceduo_canvas_label_width(d->canvas, name.bytes), space = to - from - 2;
        int start = width < space ? from + 1 + (space - width) / 2 : from + 1;
        ceduo_canvas_draw_text(d->canvas, start, row, space, CEDUO_ROLE_BELT, name.bytes);
    }
}

/* ---- picture ---- */

/* Place the frame; return the factor of heights, NaN if it is too small. */
static double set_profile_frame(struct ceduo_drawing *d, bool names, bool belts)
{
    struct extent r = find_extent(d);
    double factor = NAN;
    int axis = 0, needed = 1;
    while (axis < needed) { /* the axis takes columns, and the columns determine its labels */
        axis = needed;
        d->frame = (struct ceduo_frame){.left = d->area.left + axis,
                                        .top = d->area.top + names,
                                        .width = d->area.width - axis,
                                        .height = d->area.height - names - belts - (d->picture->no_x_axis ? 0 : 2)};
        factor = set_scale(&d->frame, d->canvas, &r, is_part(d), d->picture->paper);
        if (isnan(factor))
            break;
        struct ceduo_frame given = ceduo_plot_user_frame(&d->frame, d->scene->slope.origin_x, d->scene->slope.origin_z);
        needed = ceduo_frame_axis_width(&given, d->canvas);
    }
    if (d->picture->span)
        *d->picture->span = (struct ceduo_span){d->frame.left, d->frame.width, d->frame.x0, d->frame.x1};
    return factor;
}

#define MARKS_APART 3 /* columns; closer marks would hide the ground */

/* Mark the points kept by simplification, if others were dropped and the marks fit. */
static void mark_points(struct ceduo_drawing *d, const struct ceduo_slope *slope)
{
    int column, row, last = -MARKS_APART;
    if (slope->points <= slope->vertices || (int)slope->vertices > d->area.width / MARKS_APART || d->picture->paper)
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
    const struct ceduo_polyline *rock = d->picture->selected;
    bool names = d->area.height >= 8, belts = d->area.height >= 6;
    double factor = set_profile_frame(d, names, belts), z = ceduo_slope_height(slope, release->x.mean) + release->height.mean;
    int column, row;
    if (isnan(factor))
        return _("too narrow");
    draw_forest(d);
    ceduo_canvas_cloud_start(d->canvas);
    for (size_t i = 0; d->run && i < d->run->trajectories_count; i++) {
        const struct ceduo_polyline *t = &d->run->trajectories[i];
        ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_TRAJECTORY, t->n, t->x, t->z);
    }
    ceduo_canvas_cloud_show(d->canvas, RARE_QUANTILE);
    if (rock)
        ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_TRAJECTORY, CEDUO_STROKE_PLAIN, rock->n, rock->x, rock->z);
    ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_GROUND, CEDUO_STROKE_PLAIN, slope->vertices, slope->x, slope->z);
    mark_points(d, slope);
    if (ceduo_frame_cell(&d->frame, d->canvas, release->x.mean, z, &column, &row) && row - 1 >= d->area.top)
        ceduo_canvas_draw_text(d->canvas, column, row - 1, d->area.left + d->area.width - column, CEDUO_ROLE_TEXT,
                               _("\xe2\x96\xbc release"));
    if (d->picture->mark)
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_TITLE, *d->picture->mark);
    if (factor != 1) /* not true to scale */
        ceduo_plot_print(d->canvas, d->area.left + d->area.width - 1, d->area.top, -d->area.width / 2, CEDUO_ROLE_WARN,
                         d->area.width >= 30 ? _("heights drawn %g times") : "\xc3\x97%g", factor);
    for (size_t c = 0; names && c < d->scene->controls_count; c++)
        label_control(d, &d->scene->controls[c]);
    for (size_t c = 0; c < d->scene->controls_count; c++)
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_CONTROL, d->scene->controls[c].x);
    if (d->picture->paper)
        draw_angles(d);
    if (names && !d->picture->paper)
        label_forest(d);
    ceduo_plot_axes(d, slope->origin_x, slope->origin_z, d->picture->no_x_axis ? NULL : _("m"));
    if (belts)
        draw_belts(d);
    return NULL;
}
