/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judged share of each option over the years: a small picture for each option, all on one scale. The rule is the limit, a
 * mark is a cut. */
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/oom.h"
#include "core/runs/run.h"
#include "plot.h"

#define PANEL_WIDTH  26 /* min columns of a small picture */
#define PANEL_HEIGHT 7  /* min rows: name, cuts, curve, axis */
#define PANELS_MAX   3  /* max small pictures in a row */

int ceduo_plot_years_down(size_t options)
{
    return ((int)options + PANELS_MAX - 1) / PANELS_MAX;
}

/* Return the top of the scale: the largest share of all options, and the limit. */
static double find_top(const struct ceduo_drawing *d, double limit)
{
    double top = isnan(limit) ? 0 : limit;
    for (size_t i = 0; i < d->scene->options_count; i++) {
        const struct ceduo_years *years = d->picture->years_of_options[i];
        for (size_t k = 0; k < years->count; k++)
            top = fmax(top, ceduo_plot_year_share(&years->years[k], d->picture->control));
    }
    return top > 0 ? fmin(1.1 * top, 1000) : 1;
}

/* Draw an option. `best`: it is marked. */
static void draw_panel(struct ceduo_drawing *d, const struct ceduo_area *area, size_t option, double top, double limit,
                       bool best)
{
    const struct ceduo_years *years = d->picture->years_of_options[option];
    double *x = ceduo_check_memory(malloc(2 * (years->count + 1) * sizeof *x)), *y = x + years->count + 1;
    for (size_t i = 0; i < years->count; i++) {
        x[i] = years->years[i].year;
        y[i] = ceduo_plot_year_share(&years->years[i], d->picture->control);
    }
    double last = x[years->count - 1];
    d->frame = (struct ceduo_frame){.left = area->left + 5,
                                    .top = area->top + 2,
                                    .width = area->width - 7,
                                    .height = area->height - 4,
                                    .x0 = x[0],
                                    .x1 = last > x[0] ? last : x[0] + 1,
                                    .x_integer = true,
                                    .y1 = top};
    if (d->scene->options_count > 1)
        ceduo_plot_print(d->canvas, area->left, area->top, area->width - 1, best ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT,
                         "%s%zu %s", best ? "\xe2\x96\xb8" : "", option + 1, d->scene->options[option].name);
    if (!isnan(limit))
        ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_CONTROL, limit);
    ceduo_canvas_stairs(d->canvas, &d->frame, CEDUO_ROLE_MEAN, years->count, x, y);
    for (size_t i = 0; i < years->count; i++) {
        int column, row;
        if (years->years[i].cut && ceduo_frame_cell(&d->frame, d->canvas, x[i], 0, &column, &row))
            ceduo_canvas_label(d->canvas, column, area->top + 1, CEDUO_ROLE_WARN, "\xe2\x96\xbc");
    }
    ceduo_plot_axes(d, 0, 0, _("years"));
    free(x);
}

const char *ceduo_plot_years(struct ceduo_drawing *d)
{
    const struct ceduo_verdict *v = d->picture->verdict;
    size_t n = d->scene->options_count;
    bool known = d->picture->years_of_options;
    for (size_t i = 0; known && i < n; i++)
        known = d->picture->years_of_options[i] && d->picture->years_of_options[i]->count > 0;
    if (!d->control || !known || !d->wooded)
        return !d->control ? _("no control")
               : !known    ? _("not computed yet")
                           : _("nothing to compare: no rocks are simulated among stems");
    int across = d->area.width / PANEL_WIDTH;
    across = across > PANELS_MAX ? PANELS_MAX : across;
    across = across > (int)n ? (int)n : across;
    int down = across > 0 ? ((int)n + across - 1) / across : 0, height = down > 0 ? (d->area.height - 2) / down : 0;
    if (height < PANEL_HEIGHT)
        return _("too narrow");
    double accepted = d->control->accepted * J_TO_KJ;
    double limit = isnan(accepted) ? NAN : 1000 * ceduo_exceed_limit(d->scene, d->control), top = find_top(d, limit);
    if (isnan(accepted))
        ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS, "%s",
                         _("of 1000 released arrive"));
    else
        ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS,
                         _("of 1000 released with > %g kJ (limit %g)"), accepted, limit);
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_area panel = {.left = d->area.left + (int)i % across * (d->area.width / across),
                                         .top = d->area.top + 2 + (int)i / across * height,
                                         .width = d->area.width / across,
                                         .height = height};
        draw_panel(d, &panel, i, top, limit, v && v->rotation.known && i == v->rotation.best);
    }
    return NULL;
}
