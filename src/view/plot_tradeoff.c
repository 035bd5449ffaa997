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

struct tradeoff {
    struct ceduo_canvas *canvas;
    const struct ceduo_picture *picture;
    const struct ceduo_verdict *verdict;
    struct ceduo_frame frame;
    struct ceduo_area legend;
};

static bool is_known(const struct ceduo_choice *c)
{
    return !isnan(c->mean.mean) && !isnan(c->yield.cut_per_year);
}

static void put_sign(const struct tradeoff *t, size_t i, char *sign, size_t size)
{
    snprintf(sign, size, t->verdict->choices[i].beaten ? "(%zu)" : "%zu", i + 1);
}

static enum ceduo_role role_of(const struct tradeoff *t, size_t i)
{
    return t->verdict->choices[i].beaten ? CEDUO_ROLE_BAD : CEDUO_ROLE_GOOD;
}

static void draw_error(const struct tradeoff *t, const struct ceduo_choice *c)
{
    ceduo_canvas_line(t->canvas, &t->frame, CEDUO_ROLE_MEAN, c->yield.cut_per_year, 1000 * (c->mean.mean - c->mean.half),
                      c->yield.cut_per_year, 1000 * (c->mean.mean + c->mean.half));
}

/* The number of an option beside its point; a little lower where another stands there. */
static void draw_sign(const struct tradeoff *t, size_t i)
{
    const struct ceduo_choice *c = &t->verdict->choices[i];
    char sign[24];
    int column, row, width;
    put_sign(t, i, sign, sizeof sign);
    width = ceduo_canvas_label_width(t->canvas, sign);
    if (!ceduo_frame_cell(&t->frame, t->canvas, c->yield.cut_per_year, 1000 * c->mean.mean, &column, &row))
        return;
    column += column + 1 + width > t->frame.left + t->frame.width ? -width : 1;
    while (row + 1 < t->frame.top + t->frame.height && !ceduo_canvas_is_blank(t->canvas, column, row))
        row++;
    ceduo_canvas_label(t->canvas, column, row, role_of(t, i), sign);
}

static void draw_legend(const struct tradeoff *t)
{
    const struct ceduo_area *a = &t->legend;
    for (size_t i = 0; i < t->verdict->n && (int)i < a->height; i++) {
        const struct ceduo_choice *c = &t->verdict->choices[i];
        const char *name = t->picture->scene->options[i].name;
        char sign[24];
        put_sign(t, i, sign, sizeof sign);
        if (is_known(c))
            ceduo_plot_say(t->canvas, a->left, a->top + (int)i, a->width, role_of(t, i), "%s %s", sign, name);
        else
            ceduo_plot_say(t->canvas, a->left, a->top + (int)i, a->width, CEDUO_ROLE_AXIS, _("- %s: no yield known"), name);
    }
    if ((int)t->verdict->n < a->height)
        ceduo_plot_say(t->canvas, a->left, a->top + (int)t->verdict->n, a->width, CEDUO_ROLE_AXIS,
                       _("( ) another is better in both"));
}

static size_t find_scales(struct tradeoff *t)
{
    double yield = 0, share = 0;
    size_t known = 0;
    for (size_t i = 0; i < t->verdict->n; i++) {
        const struct ceduo_choice *c = &t->verdict->choices[i];
        if (!is_known(c))
            continue;
        known++;
        yield = fmax(yield, c->yield.cut_per_year);
        share = fmax(share, 1000 * (c->mean.mean + c->mean.half));
    }
    t->frame.x1 = yield > 0 ? 1.15 * yield : 1;
    t->frame.y1 = share > 0 ? 1.1 * share : 1;
    return known;
}

static void place(struct tradeoff *t, const struct ceduo_area *area)
{
    int n = (int)t->verdict->n + 1;
    bool beside = area->width >= WIDTH_LEAST + AXIS_WIDTH + LEGEND_WIDTH + 16;
    int below = beside ? 0 : area->height - n >= HEIGHT_LEAST + 3 ? n : 0;
    t->frame.left = area->left + AXIS_WIDTH;
    t->frame.width = area->width - AXIS_WIDTH - 1 - (beside ? LEGEND_WIDTH + 2 : 0);
    t->frame.top = area->top + 1;
    t->frame.height = area->height - 3 - below;
    t->legend =
        beside ? (struct ceduo_area){area->left + area->width - LEGEND_WIDTH, area->top + 1, LEGEND_WIDTH, area->height - 1}
               : (struct ceduo_area){area->left, area->top + area->height - below, area->width, below};
}

static void put_caption(const struct tradeoff *t, const struct ceduo_area *a)
{
    struct text words[2] = {{0}};
    bool danger = t->verdict->accepted;
    ceduo_text_put(&words[0],
                   danger ? _("dangerous rocks of 1000 over a rotation, against wood felled, m\xc2\xb3 per ha and year")
                          : _("rocks of 1000 that arrive over a rotation, against wood felled, m\xc2\xb3 per ha and year"));
    ceduo_text_put(&words[1], danger ? _("dangerous of 1000, against m\xc2\xb3 per ha and year")
                                     : _("arriving of 1000, against m\xc2\xb3 per ha and year"));
    ceduo_plot_put_fitting(t->canvas, a->left, a->top, a->width, CEDUO_ROLE_AXIS, 2, words);
}

const char *ceduo_plot_tradeoff(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_verdict *v = picture->verdict;
    struct tradeoff t = {.canvas = canvas, .picture = picture, .verdict = v};
    if (!v || !v->wooded)
        return !v ? _("not computed yet") : _("without rocks among stems there is nothing to compare");
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST)
        return _("too narrow");
    place(&t, area);
    if (find_scales(&t) == 0)
        return isnan(v->choices[0].mean.mean) ? _("not computed yet") : _("no option says how it grows and is cut");
    put_caption(&t, area);
    ceduo_canvas_axis_left(canvas, &t.frame);
    ceduo_canvas_axis_bottom(canvas, &t.frame, _("m\xc2\xb3"));
    for (size_t i = 0; i < v->n; i++)
        if (is_known(&v->choices[i]))
            draw_error(&t, &v->choices[i]);
    for (size_t i = 0; i < v->n; i++)
        if (is_known(&v->choices[i]))
            draw_sign(&t, i);
    draw_legend(&t);
    return NULL;
}
