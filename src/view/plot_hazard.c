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
#define FIRST        10   /* of the energies: 1 kJ */

/* Item 0: without forest. NULL: not known. */
static const struct ceduo_hazard *hazard_of(const struct ceduo_picture *p, size_t item)
{
    struct ceduo_picture other = *p;
    other.option = item > 0 ? item - 1 : 0;
    const struct ceduo_arrivals *a =
        item == 0 ? ceduo_plot_bare_arrivals(&other, p->control) : ceduo_plot_arrivals(&other, p->control);
    return a && !isnan(a->hazard.per_year) ? &a->hazard : NULL;
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

static double log_kJ(const struct ceduo_exceeding *e)
{
    return log10(e->energy * J_TO_KJ);
}

/* The curve, cut where it leaves the frame downwards; with intervals, if the picture is of this option. */
static void draw_curve(const struct ceduo_chart *c, const struct ceduo_picture *p, size_t item)
{
    const struct ceduo_hazard *h = hazard_of(p, item);
    const struct ceduo_frame *f = &c->frame;
    for (size_t i = FIRST; h && i + 1 < h->energies; i++) {
        const struct ceduo_exceeding *a = &h->exceed[i], *b = a + 1;
        double x0 = log_kJ(a), y0 = logarithm(a->rate.rate), x1 = log_kJ(b), y1 = logarithm(b->rate.rate);
        if (y0 < RAREST)
            continue;
        if (y1 < RAREST) {
            x1 = b->rate.rate > 0 ? x0 + (x1 - x0) * (y0 - RAREST) / (y0 - y1) : x0;
            y1 = RAREST;
        }
        ceduo_canvas_line(c->canvas, f, role_of(item), x0, y0, x1, y1);
    }
    for (size_t i = FIRST; h && item == p->option + 1 && i < h->energies; i += 2) {
        const struct ceduo_exceeding *e = &h->exceed[i];
        double x = log_kJ(e);
        if (x >= f->x0 && logarithm(e->rate.hi) > RAREST)
            ceduo_canvas_line(c->canvas, f, CEDUO_ROLE_MEAN, x, fmax(RAREST, logarithm(e->rate.lo)), x,
                              fmin(f->y1, logarithm(e->rate.hi)));
    }
}

static void put_years(const struct ceduo_chart *c, double years, bool rule)
{
    const struct ceduo_frame *f = &c->frame;
    int column, row;
    if (!ceduo_frame_cell(f, c->canvas, f->x0, -log10(years), &column, &row))
        return;
    if (rule)
        ceduo_canvas_rule_y(c->canvas, f, CEDUO_ROLE_AXIS, -log10(years));
    if (ceduo_canvas_is_blank(c->canvas, f->left - 2, row))
        ceduo_plot_say_right(c->canvas, f->left - 2, row, AXIS_WIDTH - 2, CEDUO_ROLE_AXIS, _("%g y"), years);
}

static void put_energy(const struct ceduo_chart *c, double kJ, bool rule)
{
    const struct ceduo_frame *f = &c->frame;
    int column, row;
    if (!ceduo_frame_cell(f, c->canvas, log10(kJ), RAREST, &column, &row))
        return;
    if (rule)
        ceduo_canvas_rule_x(c->canvas, f, CEDUO_ROLE_AXIS, log10(kJ));
    ceduo_plot_say(c->canvas, column, f->top + f->height, 12, CEDUO_ROLE_AXIS, kJ == 1 ? _("%g kJ") : "%g", kJ);
}

const char *ceduo_plot_hazard(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_hazard *bare = picture->scene->blocks_count > 0 ? hazard_of(picture, 0) : NULL;
    size_t items = ceduo_plot_wooded(picture) ? picture->scene->options_count + 1 : 1;
    if (picture->scene->blocks_count == 0)
        return _("the scene does not say which blocks come down");
    if (!bare)
        return _("not computed yet");
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST)
        return _("too narrow");
    size_t last = bare->energies;
    while (last > 0 && logarithm(bare->exceed[last - 1].rate.rate) < RAREST)
        last--;
    struct ceduo_chart c = ceduo_chart_place(canvas, area,
                                             &(struct ceduo_chart_size){.axis = AXIS_WIDTH,
                                                                        .below = 1,
                                                                        .legend = LEGEND_WIDTH,
                                                                        .lines = (int)items,
                                                                        .width = WIDTH_LEAST,
                                                                        .height = HEIGHT_LEAST});
    c.frame.x1 = last > 0 ? log10(bare->exceed[last - 1].energy * J_TO_KJ * 1.3) : 0;
    c.frame.y0 = RAREST;
    c.frame.y1 = ceil(logarithm(bare->reach.rate) + 1e-9);
    if (!(c.frame.x1 > 0 && c.frame.y1 > RAREST))
        return _("rocks arrive less than once in a thousand years");
    ceduo_plot_say(canvas, area->left, area->top, area->width, CEDUO_ROLE_AXIS,
                   _("years from one rock with more than this energy to the next"));
    for (int i = 0; i < 2; i++)
        put_energy(&c, (double[]){30, 300}[i], true);
    for (int i = 0; i < 3; i++)
        put_years(&c, (double[]){30, 100, 300}[i], true);
    for (int decade = (int)c.frame.y1; decade >= RAREST; decade--)
        put_years(&c, pow(10, -decade), false);
    for (int decade = 0; decade <= (int)c.frame.x1; decade++)
        put_energy(&c, pow(10, decade), false);
    for (size_t i = 0; i < items; i++)
        draw_curve(&c, picture, i);
    for (size_t i = 0; i < items; i++) {
        const struct ceduo_hazard *h = hazard_of(picture, i);
        char sign[24];
        size_t at = 14 + 4 * i; /* its number on the curve */
        snprintf(sign, sizeof sign, "%zu", i);
        while (h && at > 0 && (at >= h->energies || logarithm(h->exceed[at].rate.rate) < RAREST))
            at--;
        if (h)
            ceduo_chart_sign(&c, log_kJ(&h->exceed[at]), logarithm(h->exceed[at].rate.rate), false, role_of(i), sign);
        if ((int)i < c.legend.height)
            ceduo_plot_say(canvas, c.legend.left, c.legend.top + (int)i, c.legend.width, role_of(i), "%zu %s", i,
                           i == 0 ? _("without forest") : picture->scene->options[i - 1].name);
    }
    return NULL;
}
