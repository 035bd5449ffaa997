/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "plot_parts.h"

/* How often which energy is exceeded at a control: years from one such rock to the next, upwards the more often, against
 * energy, both by decades. The slope without forest and each option by its number; the limits of Swiss practice are rules.
 * Rarer than once in a thousand years nothing is shown. */

#define AXIS_WIDTH   8
#define LEGEND_WIDTH 30
#define WIDTH_LEAST  24
#define HEIGHT_LEAST 8
#define RAREST       (-3) /* log10 of the lowest rate shown, 1/y */

struct hazard_plot {
    struct ceduo_canvas *canvas;
    const struct ceduo_picture *picture;
    struct ceduo_frame frame;
    struct ceduo_area legend;
};

/* Item 0: without forest. NULL: not known. */
static const struct ceduo_hazard *hazard_of(const struct ceduo_picture *p, size_t item)
{
    struct ceduo_picture other = *p;
    other.option = item > 0 ? item - 1 : 0;
    const struct ceduo_arrivals *a =
        item == 0 ? ceduo_plot_bare_arrivals(&other, p->control) : ceduo_plot_arrivals(&other, p->control);
    return a && !isnan(a->hazard.per_year) ? &a->hazard : NULL;
}

static size_t items(const struct ceduo_picture *p)
{
    return ceduo_plot_wooded(p) ? p->scene->options_count + 1 : 1;
}

static enum ceduo_role role_of(size_t item)
{
    return item == 0 ? CEDUO_ROLE_BARE : CEDUO_ROLE_WOOD;
}

/* log10, of a rate of 0 as if it lay below the frame. */
static double logarithm(double value)
{
    return value > 0 ? log10(value) : 2 * RAREST;
}

/* One segment of a curve, cut where it leaves the frame downwards. */
static void draw_step(const struct hazard_plot *h, enum ceduo_role role, const struct ceduo_exceeding *a,
                      const struct ceduo_exceeding *b)
{
    double x0 = log10(a->energy * J_TO_KJ), y0 = logarithm(a->rate.rate), x1 = log10(b->energy * J_TO_KJ);
    double y1 = logarithm(b->rate.rate);
    if (y0 < RAREST)
        return;
    if (y1 < RAREST) {
        x1 = b->rate.rate > 0 ? x0 + (x1 - x0) * (y0 - RAREST) / (y0 - y1) : x0;
        y1 = RAREST;
    }
    ceduo_canvas_line(h->canvas, &h->frame, role, x0, y0, x1, y1);
}

static void draw_interval(const struct hazard_plot *h, const struct ceduo_exceeding *e)
{
    double x = log10(e->energy * J_TO_KJ);
    if (x >= h->frame.x0 && logarithm(e->rate.hi) > RAREST)
        ceduo_canvas_line(h->canvas, &h->frame, CEDUO_ROLE_MEAN, x, fmax(RAREST, logarithm(e->rate.lo)), x,
                          fmin(h->frame.y1, logarithm(e->rate.hi)));
}

/* Its number beside the curve, a little lower where another stands there. */
static void draw_sign(const struct hazard_plot *h, const struct ceduo_hazard *hazard, size_t item)
{
    char sign[24];
    int column, row;
    size_t i = 14 + 4 * item;
    snprintf(sign, sizeof sign, "%zu", item);
    while (i > 0 && (i >= hazard->energies || logarithm(hazard->exceed[i].rate.rate) < RAREST))
        i--;
    if (!ceduo_frame_cell(&h->frame, h->canvas, log10(hazard->exceed[i].energy * J_TO_KJ),
                          logarithm(hazard->exceed[i].rate.rate), &column, &row))
        return;
    while (row + 1 < h->frame.top + h->frame.height && !ceduo_canvas_is_blank(h->canvas, column, row))
        row++;
    ceduo_canvas_label(h->canvas, column, row, role_of(item), sign);
}

static void draw_curve(const struct hazard_plot *h, size_t item)
{
    const struct ceduo_hazard *hazard = hazard_of(h->picture, item);
    for (size_t i = 10; hazard && i + 1 < hazard->energies; i++) /* from 1 kJ on */
        draw_step(h, role_of(item), &hazard->exceed[i], &hazard->exceed[i + 1]);
    for (size_t i = 10; hazard && item == h->picture->option + 1 && i < hazard->energies; i += 2)
        draw_interval(h, &hazard->exceed[i]);
}

/* ---- axes ---- */

static void draw_axes(const struct hazard_plot *h)
{
    static const double kJ[] = {30, 300}, years[] = {30, 100, 300};
    const struct ceduo_frame *f = &h->frame;
    int column, row;
    for (size_t i = 0; i < sizeof kJ / sizeof kJ[0]; i++)
        if (ceduo_frame_cell(f, h->canvas, log10(kJ[i]), RAREST, &column, &row)) {
            ceduo_canvas_rule_x(h->canvas, f, CEDUO_ROLE_AXIS, log10(kJ[i]));
            ceduo_plot_say(h->canvas, column, f->top + f->height, 12, CEDUO_ROLE_AXIS, "%g", kJ[i]);
        }
    for (size_t i = 0; i < sizeof years / sizeof years[0]; i++) {
        if (!ceduo_frame_cell(f, h->canvas, f->x0, -log10(years[i]), &column, &row))
            continue;
        ceduo_canvas_rule_y(h->canvas, f, CEDUO_ROLE_AXIS, -log10(years[i]));
        if (ceduo_canvas_is_blank(h->canvas, f->left - 2, row))
            ceduo_plot_say_right(h->canvas, f->left - 2, row, AXIS_WIDTH - 2, CEDUO_ROLE_AXIS, _("%g y"), years[i]);
    }
    for (int decade = (int)f->y1; decade >= RAREST; decade--)
        if (ceduo_frame_cell(f, h->canvas, f->x0, decade, &column, &row) && ceduo_canvas_is_blank(h->canvas, f->left - 2, row))
            ceduo_plot_say_right(h->canvas, f->left - 2, row, AXIS_WIDTH - 2, CEDUO_ROLE_AXIS, _("%g y"), pow(10, -decade));
    for (int decade = 0; decade <= (int)f->x1; decade++)
        if (ceduo_frame_cell(f, h->canvas, decade, RAREST, &column, &row))
            ceduo_plot_say(h->canvas, column, f->top + f->height, 12, CEDUO_ROLE_AXIS, decade == 0 ? _("%g kJ") : "%g",
                           pow(10, decade));
}

static void draw_legend(const struct hazard_plot *h)
{
    const struct ceduo_area *a = &h->legend;
    for (size_t i = 0; i < items(h->picture) && (int)i < a->height; i++)
        ceduo_plot_say(h->canvas, a->left, a->top + (int)i, a->width, role_of(i), "%zu %s", i,
                       i == 0 ? _("without forest") : h->picture->scene->options[i - 1].name);
}

static bool place(struct hazard_plot *h, const struct ceduo_area *area)
{
    const struct ceduo_hazard *bare = hazard_of(h->picture, 0);
    int n = (int)items(h->picture);
    bool beside = area->width >= WIDTH_LEAST + AXIS_WIDTH + LEGEND_WIDTH + 16;
    int below = beside ? 0 : area->height - n >= HEIGHT_LEAST + 3 ? n : 0;
    size_t last = bare->energies;
    while (last > 0 && logarithm(bare->exceed[last - 1].rate.rate) < RAREST)
        last--;
    h->frame = (struct ceduo_frame){.left = area->left + AXIS_WIDTH,
                                    .top = area->top + 1,
                                    .width = area->width - AXIS_WIDTH - 1 - (beside ? LEGEND_WIDTH + 2 : 0),
                                    .height = area->height - 2 - below,
                                    .x0 = 0,
                                    .x1 = last > 0 ? log10(bare->exceed[last - 1].energy * J_TO_KJ * 1.3) : 0,
                                    .y0 = RAREST,
                                    .y1 = ceil(logarithm(bare->reach.rate) + 1e-9)};
    h->legend =
        beside ? (struct ceduo_area){area->left + area->width - LEGEND_WIDTH, area->top + 1, LEGEND_WIDTH, area->height - 1}
               : (struct ceduo_area){area->left, area->top + area->height - below, area->width, below};
    return h->frame.x1 > 0 && h->frame.y1 > RAREST;
}

const char *ceduo_plot_hazard(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    struct hazard_plot h = {.canvas = canvas, .picture = picture};
    if (picture->scene->blocks_count == 0)
        return _("the scene does not say which blocks come down");
    if (!hazard_of(picture, 0))
        return _("not computed yet");
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST)
        return _("too narrow");
    if (!place(&h, area))
        return _("rocks arrive less than once in a thousand years");
    ceduo_plot_say(canvas, area->left, area->top, area->width, CEDUO_ROLE_AXIS,
                   _("years from one rock with more than this energy to the next"));
    draw_axes(&h);
    for (size_t i = 0; i < items(picture); i++)
        draw_curve(&h, i);
    for (size_t i = 0; i < items(picture); i++)
        if (hazard_of(picture, i))
            draw_sign(&h, hazard_of(picture, i), i);
    draw_legend(&h);
    return NULL;
}
