/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All options over the years ahead: a curve of the judged share for each, from today on, with its number at the end. The
 * option under the cursor is thick. Strokes tell the others apart without colour. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/oom.h"
#include "core/runs/run.h"
#include "plot.h"

#define WIDTH_AHEAD  30 /* min. columns and lines */
#define HEIGHT_AHEAD 7
#define MARGIN       8  /* columns for numbers on the right of the curves */
#define LEGEND       34 /* columns of the names */

struct curve_ahead {
    size_t n;
    double *x, *y; /* years from today; rocks of 1000 */
};

static enum ceduo_role get_curve_role(const struct ceduo_drawing *d, size_t option)
{
    static const enum ceduo_role roles[] = {CEDUO_ROLE_FOREST, CEDUO_ROLE_BARE, CEDUO_ROLE_GROUND, CEDUO_ROLE_TRAJECTORY};
    return option == d->picture->option ? CEDUO_ROLE_MEAN : roles[option % 4];
}

static enum ceduo_stroke get_curve_stroke(const struct ceduo_drawing *d, size_t option)
{
    static const enum ceduo_stroke strokes[] = {CEDUO_STROKE_DASHES, CEDUO_STROKE_DOTS, CEDUO_STROKE_PLAIN, CEDUO_STROKE_FEW};
    return option == d->picture->option ? CEDUO_STROKE_PLAIN : strokes[(option + option / 4) % 4];
}

/* Read today and the years of an option; without its years the curve is empty. Caller frees. */
static struct curve_ahead read_curve_ahead(const struct ceduo_drawing *d, size_t option)
{
    const struct ceduo_years *years = d->picture->years_of_options ? d->picture->years_of_options[option] : NULL;
    const struct ceduo_run_snapshot *run = ceduo_snapshot_find(d->picture->snapshot, d->scene, option);
    const struct ceduo_arrivals *today = ceduo_plot_arrivals(run, d->picture->control);
    size_t count = years ? years->count : 0;
    struct curve_ahead c = {.x = ceduo_check_memory(calloc(count + 1, sizeof *c.x)),
                            .y = ceduo_check_memory(calloc(count + 1, sizeof *c.y))};
    if (count > 0 && years->years[0].year == 1 && today)
        c.y[c.n++] = 1000 * ceduo_judged_share(today).mean;
    for (size_t i = 0; i < count; i++) {
        double share = ceduo_plot_year_share(&years->years[i], d->picture->control);
        if (isnan(share))
            continue;
        c.x[c.n] = years->years[i].year;
        c.y[c.n++] = share;
    }
    return c;
}

/* Set the frame around all curves and the limit. Return false if there is no curve. */
static bool set_frame_ahead(struct ceduo_drawing *d, const struct curve_ahead *curves, double limit)
{
    const struct ceduo_area *a = &d->area;
    size_t options = d->scene->options_count;
    double max = isnan(limit) ? 0 : 1.2 * limit, from = INFINITY, to = -INFINITY;
    for (size_t i = 0; i < options; i++)
        for (size_t k = 0; k < curves[i].n; k++) {
            max = fmax(max, 1.1 * curves[i].y[k]);
            from = fmin(from, curves[i].x[k]);
            to = fmax(to, curves[i].x[k]);
        }
    bool at_right = !d->picture->no_legend && a->width >= WIDTH_AHEAD + LEGEND + MARGIN;
    int below = d->picture->no_legend || at_right || a->height - (int)options < HEIGHT_AHEAD ? 0 : (int)options;
    d->frame = (struct ceduo_frame){.top = a->top + 1,
                                    .height = a->height - 3 - below,
                                    .x0 = from,
                                    .x1 = to > from ? to : from + 1,
                                    .x_integer = true,
                                    .y1 = max > 1000 ? 1000
                                          : max > 0  ? max
                                                     : 1};
    int axis = ceduo_frame_axis_width(&d->frame, d->canvas);
    d->frame.left = a->left + axis;
    d->frame.width = a->width - axis - MARGIN - (at_right ? LEGEND : 0);
    d->legend = at_right ? (struct ceduo_area){a->left + a->width - LEGEND, a->top + 1, LEGEND, a->height - 1}
                         : (struct ceduo_area){a->left, a->top + a->height - below, a->width, below};
    return to >= from;
}

/* Draw a curve; the selected one is two dots thick. */
static void draw_curve_ahead(const struct ceduo_drawing *d, size_t option, const struct curve_ahead *c)
{
    struct ceduo_frame frame = d->frame;
    double dot = (frame.y1 - frame.y0) / (frame.height * d->canvas->dots_y - 1);
    for (int thick = option == d->picture->option; thick >= 0; thick--) {
        ceduo_canvas_polyline(d->canvas, &frame, get_curve_role(d, option), get_curve_stroke(d, option), c->n, c->x, c->y);
        frame.y0 -= dot;
        frame.y1 -= dot;
    }
}

/* Write the numbers at the ends of the curves, side by side if they end in one line, and the limit's name if its line is
 * free. */
static void label_curves_ahead(const struct ceduo_drawing *d, const struct curve_ahead *curves, double limit)
{
    const struct ceduo_frame *f = &d->frame;
    int right = f->left + f->width + MARGIN, column, row;
    for (size_t i = 0; i < d->scene->options_count; i++) {
        char sign[24];
        size_t n = curves[i].n;
        snprintf(sign, sizeof sign, "%zu", i + 1);
        if (n == 0 || !ceduo_frame_cell(f, d->canvas, curves[i].x[n - 1], fmin(curves[i].y[n - 1], f->y1), &column, &row))
            continue;
        int width = ceduo_canvas_label_width(d->canvas, sign);
        column = f->left + f->width + 1;
        while (column + width <= right && !ceduo_canvas_is_blank(d->canvas, column, row))
            column++;
        column += column > f->left + f->width + 1; /* a blank between numbers */
        if (column + width <= right)
            ceduo_canvas_label(d->canvas, column, row, i == d->picture->option ? CEDUO_ROLE_CURSOR : get_curve_role(d, i),
                               sign);
    }
    column = f->left + f->width + 1;
    if (!isnan(limit) && ceduo_frame_cell(f, d->canvas, f->x1, limit, &right, &row) &&
        ceduo_canvas_is_blank(d->canvas, column, row))
        ceduo_canvas_draw_text(d->canvas, column, row, MARGIN - 1, CEDUO_ROLE_CONTROL, _("limit"));
}

const char *ceduo_plot_ahead(struct ceduo_drawing *d)
{
    if (!d->control)
        return _("no control");
    if (!d->wooded)
        return _("nothing to compare: no rocks are simulated among stems");
    if (d->area.width < WIDTH_AHEAD || d->area.height < HEIGHT_AHEAD)
        return _("too narrow");
    size_t options = d->scene->options_count;
    double accepted = d->control->accepted * J_TO_KJ;
    double limit = isnan(accepted) ? NAN : 1000 * ceduo_exceed_limit(d->scene, d->control);
    struct curve_ahead *curves = ceduo_check_memory(calloc(options, sizeof *curves));
    for (size_t i = 0; i < options; i++)
        curves[i] = read_curve_ahead(d, i);
    const char *reason = set_frame_ahead(d, curves, limit) ? NULL : _("not computed yet");
    if (!reason) {
        const struct ceduo_frame *f = &d->frame;
        ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS,
                         isnan(accepted) ? _("of 1000 released arrive") : _("of 1000 released with > %g kJ (limit %g)"),
                         accepted, limit);
        ceduo_canvas_axis_left(d->canvas, f);
        ceduo_canvas_axis_bottom(d->canvas, f, NULL);
        ceduo_canvas_draw_text(d->canvas, f->left + f->width + 1, f->top + f->height + 1, MARGIN - 1, CEDUO_ROLE_AXIS,
                               _("years"));
        if (f->x0 == 0) {
            ceduo_canvas_rule_x(d->canvas, f, CEDUO_ROLE_TITLE, 0);
            int start = f->left + 1 - ceduo_canvas_label_width(d->canvas, _("today"));
            ceduo_canvas_label(d->canvas, start > d->area.left ? start : d->area.left, f->top + f->height + 1, CEDUO_ROLE_TITLE,
                               _("today"));
        }
        if (!isnan(limit))
            ceduo_canvas_rule_y(d->canvas, f, CEDUO_ROLE_CONTROL, limit);
        for (size_t i = 0; i < options; i++)
            draw_curve_ahead(d, i, &curves[i]);
        label_curves_ahead(d, curves, limit);
        for (size_t i = 0; i < options && (int)i < d->legend.height; i++)
            ceduo_plot_print(d->canvas, d->legend.left, d->legend.top + (int)i, d->legend.width,
                             i == d->picture->option ? CEDUO_ROLE_CURSOR : get_curve_role(d, i), "%zu %s", i + 1,
                             d->scene->options[i].name);
    }
    for (size_t i = 0; i < options; i++) {
        free(curves[i].x);
        free(curves[i].y);
    }
    free(curves);
    return reason;
}
