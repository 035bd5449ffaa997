/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "plot_parts.h"

/* How often which energy is exceeded at a control: years from one such rock to the next, upwards the more often, against
 * energy, both by decades. The slope without forest and each option by its number; the limits of Swiss practice are rules.
 * Rarer than once in a thousand years nothing is shown. */

#define RAREST (-3) /* log10 of the lowest rate shown, 1/y */
#define FIRST  10   /* of the energies: 1 kJ */

static const struct ceduo_chart_size size = {.axis = 8, .below = 1, .legend = 30, .width = 24, .height = 8};

/* Item 0: without forest. NULL: not known. */
static const struct ceduo_hazard *hazard_of(const struct ceduo_drawing *d, size_t item)
{
    const struct ceduo_run_snapshot *run = item == 0 ? d->bare : ceduo_snapshot_of(d->picture->snapshot, d->scene, item - 1);
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(run, d->picture->control);
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

/* The curve, upright down to 0; with intervals, if the picture is of this option. */
static void draw_curve(const struct ceduo_drawing *d, size_t item)
{
    const struct ceduo_hazard *h = hazard_of(d, item);
    const struct ceduo_frame *f = &d->frame;
    for (size_t i = FIRST; h && i + 1 < h->energies && h->exceed[i].rate.mean > 0; i++) {
        const struct ceduo_exceeding *a = &h->exceed[i], *b = a + 1;
        ceduo_canvas_line(d->canvas, f, role_of(item), log_kJ(a), logarithm(a->rate.mean), log_kJ(b->rate.mean > 0 ? b : a),
                          logarithm(b->rate.mean));
    }
    for (size_t i = FIRST; h && item == d->picture->option + 1 && i < h->energies; i += 2) {
        const struct ceduo_exceeding *e = &h->exceed[i];
        double x = log_kJ(e);
        if (x >= f->x0 && logarithm(e->rate.hi) > RAREST)
            ceduo_canvas_line(d->canvas, f, CEDUO_ROLE_MEAN, x, fmax(RAREST, logarithm(e->rate.lo)), x,
                              fmin(f->y1, logarithm(e->rate.hi)));
    }
}

static void put_years(const struct ceduo_drawing *d, double years)
{
    const struct ceduo_frame *f = &d->frame;
    int column, row;
    if (!ceduo_frame_cell(f, d->canvas, f->x0, -log10(years), &column, &row))
        return;
    if (ceduo_canvas_is_blank(d->canvas, f->left - 2, row))
        ceduo_plot_say(d->canvas, f->left - 2, row, 2 - size.axis, CEDUO_ROLE_AXIS, _("%g y"), years);
}

static void put_energy(const struct ceduo_drawing *d, double kJ)
{
    const struct ceduo_frame *f = &d->frame;
    int column, row;
    if (!ceduo_frame_cell(f, d->canvas, log10(kJ), RAREST, &column, &row))
        return;
    ceduo_plot_say(d->canvas, column, f->top + f->height, 12, CEDUO_ROLE_AXIS, kJ == 1 ? _("%g kJ") : "%g", kJ);
}

const char *ceduo_plot_hazard(struct ceduo_drawing *d)
{
    static const double energies[] = {30, 300}, years[] = {30, 100, 300};
    bool blocks = d->scene->blocks_count > 0;
    const struct ceduo_hazard *bare = blocks ? hazard_of(d, 0) : NULL;
    size_t items = d->wooded ? d->scene->options_count + 1 : 1, last = bare ? bare->energies : 0;
    if (!bare)
        return blocks ? _("not computed yet") : _("the scene does not say which blocks come down");
    if (!ceduo_plot_chart(d, &size, items))
        return _("too narrow");
    while (last > 0 && logarithm(bare->exceed[last - 1].rate.mean) < RAREST)
        last--;
    d->frame.x1 = last > 0 ? log10(bare->exceed[last - 1].energy * J_TO_KJ * 1.3) : 0;
    d->frame.y0 = RAREST;
    d->frame.y1 = ceil(logarithm(bare->reach.mean) + 1e-9);
    if (!(d->frame.x1 > 0 && d->frame.y1 > RAREST))
        return _("rocks arrive less than once in a thousand years");
    ceduo_plot_say(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS, "%s",
                   _("years from one rock with more than this energy to the next"));
    for (int i = 0; i < 2; i++) {
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_AXIS, log10(energies[i]));
        put_energy(d, energies[i]);
    }
    for (int i = 0; i < 3; i++) {
        ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, -log10(years[i]));
        put_years(d, years[i]);
    }
    for (int decade = (int)d->frame.y1; decade >= RAREST; decade--)
        put_years(d, pow(10, -decade));
    for (int decade = 0; decade <= (int)d->frame.x1; decade++)
        put_energy(d, pow(10, decade));
    for (size_t i = 0; i < items; i++)
        draw_curve(d, i);
    for (size_t i = 0; i < items; i++) {
        const struct ceduo_hazard *h = hazard_of(d, i);
        char sign[24];
        size_t at = 14 + 4 * i; /* its number on the curve */
        snprintf(sign, sizeof sign, "%zu", i);
        while (h && at > 0 && (at >= h->energies || logarithm(h->exceed[at].rate.mean) < RAREST))
            at--;
        if (h)
            ceduo_plot_sign(d, log_kJ(&h->exceed[at]), logarithm(h->exceed[at].rate.mean), false, role_of(i), sign);
        if ((int)i < d->legend.height)
            ceduo_plot_say(d->canvas, d->legend.left, d->legend.top + (int)i, d->legend.width, role_of(i), "%zu %s", i,
                           i == 0 ? _("without forest") : d->scene->options[i - 1].name);
    }
    return NULL;
}
