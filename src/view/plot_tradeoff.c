/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "plot_parts.h"

/* Protection against yield: what an option lets through over its rotation, upwards, and the wood it gives a year, to
 * the right. The best corner is below on the right. An option that another beats in both stands in brackets. */

#define AXIS_WIDTH   6
#define LEGEND_WIDTH 34 /* columns of the names beside the picture */
#define WIDTH_LEAST  24
#define HEIGHT_LEAST 6

static bool is_known(const struct ceduo_choice *c)
{
    return !isnan(c->mean.mean) && !isnan(c->yield.cut_per_year);
}

static enum ceduo_role role_of(const struct ceduo_choice *c)
{
    return c->beaten ? CEDUO_ROLE_BAD : CEDUO_ROLE_GOOD;
}

/* Signs, names and errors of the options; `signs`: after all errors. */
static void draw_option(const struct ceduo_chart *t, const struct ceduo_choice *c, size_t i, const char *name, bool signs)
{
    char sign[24];
    snprintf(sign, sizeof sign, c->beaten ? "(%zu)" : "%zu", i + 1);
    int row = t->legend.top + (int)i, width = (int)i < t->legend.height ? t->legend.width : 0;
    if (!is_known(c) && signs)
        ceduo_plot_say(t->canvas, t->legend.left, row, width, CEDUO_ROLE_AXIS, _("- %s: no yield known"), name);
    if (!is_known(c))
        return;
    double x = c->yield.cut_per_year;
    if (!signs) {
        ceduo_canvas_line(t->canvas, &t->frame, CEDUO_ROLE_MEAN, x, 1000 * (c->mean.mean - c->mean.half), x,
                          1000 * (c->mean.mean + c->mean.half));
        return;
    }
    ceduo_chart_sign(t, x, 1000 * c->mean.mean, true, role_of(c), sign);
    ceduo_plot_say(t->canvas, t->legend.left, row, width, role_of(c), "%s %s", sign, name);
}

const char *ceduo_plot_tradeoff(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_verdict *v = picture->verdict;
    if (!v || !v->wooded)
        return !v ? _("not computed yet") : _("without rocks among stems there is nothing to compare");
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST)
        return _("too narrow");
    struct ceduo_chart t = ceduo_chart_place(canvas, area,
                                             &(struct ceduo_chart_size){.axis = AXIS_WIDTH,
                                                                        .below = 2,
                                                                        .legend = LEGEND_WIDTH,
                                                                        .lines = (int)v->n + 1,
                                                                        .width = WIDTH_LEAST,
                                                                        .height = HEIGHT_LEAST});
    double yield = 0, share = 0;
    size_t known = 0;
    for (size_t i = 0; i < v->n; i++) {
        const struct ceduo_choice *c = &v->choices[i];
        if (!is_known(c))
            continue;
        known++;
        yield = fmax(yield, c->yield.cut_per_year);
        share = fmax(share, 1000 * (c->mean.mean + c->mean.half));
    }
    if (known == 0)
        return isnan(v->choices[0].mean.mean) ? _("not computed yet") : _("no option says how it grows and is cut");
    t.frame.x1 = yield > 0 ? 1.15 * yield : 1;
    t.frame.y1 = share > 0 ? 1.1 * share : 1;
    ceduo_plot_say_fitting(canvas, area->left, area->top, area->width, CEDUO_ROLE_AXIS,
                           v->accepted
                               ? _("dangerous rocks of 1000 over a rotation, against wood felled, m\xc2\xb3 per ha and year")
                               : _("rocks of 1000 that arrive over a rotation, against wood felled, m\xc2\xb3 per ha and year"),
                           v->accepted ? _("dangerous of 1000, against m\xc2\xb3 per ha and year")
                                       : _("arriving of 1000, against m\xc2\xb3 per ha and year"));
    ceduo_canvas_axis_left(canvas, &t.frame);
    ceduo_canvas_axis_bottom(canvas, &t.frame, _("m\xc2\xb3"));
    for (size_t i = 0; i < 2 * v->n; i++)
        draw_option(&t, &v->choices[i % v->n], i % v->n, picture->scene->options[i % v->n].name, i >= v->n);
    if ((int)v->n < t.legend.height)
        ceduo_plot_say(canvas, t.legend.left, t.legend.top + (int)v->n, t.legend.width, CEDUO_ROLE_AXIS,
                       _("( ) another is better in both"));
    return NULL;
}
