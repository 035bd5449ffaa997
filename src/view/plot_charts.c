/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts of all options with a legend: frequency of energies, classes of fences, and protection against yield. */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "core/runs/run.h"
#include "plot.h"
#include "report.h"
#include "scene/derived.h"

struct chart_size {
    int axis, below;   /* columns of the left axis, rows of the bottom axis */
    int legend;        /* columns */
    int width, height; /* minimum size of the picture */
};

/* Place the frame of a chart (ranges stay 0) and its legend of `lines` lines: on the right of a wide area, otherwise below,
 * or nowhere if the chart would be lower than `height`. False if the area is too small. */
static bool set_chart_frame(struct ceduo_drawing *d, const struct chart_size *size, size_t lines)
{
    const struct ceduo_area *a = &d->area;
    bool at_right = a->width >= size->width + size->axis + size->legend + 16;
    int below = !at_right && a->height - (int)lines >= size->height + 3 ? (int)lines : 0;
    d->frame = (struct ceduo_frame){.left = a->left + size->axis,
                                    .top = a->top + 1,
                                    .width = a->width - size->axis - 1 - (at_right ? size->legend + 2 : 0),
                                    .height = a->height - 1 - size->below - below};
    d->legend = (struct ceduo_area){a->left, a->top + a->height - below, a->width, below};
    if (at_right)
        d->legend = (struct ceduo_area){a->left + a->width - size->legend, a->top + 1, size->legend, a->height - 1};
    return a->width >= size->width && a->height >= size->height;
}

/* Draw a sign at a point or next to it; lower if the cell is occupied. */
static void draw_sign(const struct ceduo_drawing *d, double x, double y, bool at_right, enum ceduo_role role, const char *sign)
{
    const struct ceduo_frame *f = &d->frame;
    int column, row, width = ceduo_canvas_label_width(d->canvas, sign);
    if (!ceduo_frame_cell(f, d->canvas, x, y, &column, &row))
        return;
    if (at_right)
        column += column + 1 + width > f->left + f->width ? -width : 1;
    while (row + 1 < f->top + f->height && !ceduo_canvas_is_blank(d->canvas, column, row))
        row++;
    ceduo_canvas_label(d->canvas, column, row, role, sign);
}

/* Return the arrivals without forest (item 0) or of option item - 1; NULL: unknown. */
static const struct ceduo_arrivals *find_arrivals(const struct ceduo_drawing *d, size_t item)
{
    const struct ceduo_run_snapshot *run = item == 0 ? d->bare : ceduo_snapshot_find(d->picture->snapshot, d->scene, item - 1);
    return ceduo_plot_arrivals(run, d->picture->control);
}

static enum ceduo_role get_role(size_t item)
{
    return item == 0 ? CEDUO_ROLE_BARE : CEDUO_ROLE_FOREST;
}

/* Role of the sign and the name of an item: the option under the cursor is marked. */
static enum ceduo_role get_sign_role(const struct ceduo_drawing *d, size_t item)
{
    return item == d->picture->option + 1 ? CEDUO_ROLE_CURSOR : get_role(item);
}

/* Name an item in the legend. */
static void draw_name(const struct ceduo_drawing *d, size_t item)
{
    if ((int)item < d->legend.height)
        ceduo_plot_print(d->canvas, d->legend.left, d->legend.top + (int)item, d->legend.width, get_sign_role(d, item),
                         "%zu %s", item, item == 0 ? _("without forest") : d->scene->options[item - 1].name);
}

/* ---- frequency ---- */

/* Return period of exceeding an energy at a control, upwards the more frequent, both axes logarithmic. Curves of the slope
 * without forest and of each option by number; the limits of Swiss practice are rules. Return periods above 1000 years are
 * not shown. */

#define RATE_MIN     (-3) /* log10 of the lowest rate shown, 1/year */
#define FIRST_ENERGY 10   /* index of 1 kJ in the energies */

static const struct chart_size hazard_size = {.axis = 8, .below = 1, .legend = 30, .width = 24, .height = 8};

static const struct ceduo_hazard *find_hazard(const struct ceduo_drawing *d, size_t item)
{
    const struct ceduo_hazard *h = ceduo_hazard_find(find_arrivals(d, item));
    return h && h->curve ? h : NULL;
}

/* Return log10; a rate of 0 is below the frame. */
static double logarithm(double value)
{
    return value > 0 ? log10(value) : 2 * RATE_MIN;
}

static double log_kJ(const struct ceduo_hazard_point *e)
{
    return log10(e->energy * J_TO_KJ);
}

/* Draw a curve, vertical down to 0; with intervals for the picture's option. */
static void draw_curve(const struct ceduo_drawing *d, size_t item)
{
    const struct ceduo_hazard *h = find_hazard(d, item);
    const struct ceduo_frame *f = &d->frame;
    for (size_t i = FIRST_ENERGY; h && i + 1 < h->curve->count && h->curve->points[i].rate.mean > 0; i++) {
        const struct ceduo_hazard_point *a = &h->curve->points[i], *b = a + 1;
        ceduo_canvas_line(d->canvas, f, get_role(item), log_kJ(a), logarithm(a->rate.mean), log_kJ(b->rate.mean > 0 ? b : a),
                          logarithm(b->rate.mean));
    }
    for (size_t i = FIRST_ENERGY; h && item == d->picture->option + 1 && i < h->curve->count; i += 2) {
        const struct ceduo_hazard_point *e = &h->curve->points[i];
        double x = log_kJ(e);
        if (x >= f->x0 && logarithm(e->rate.hi) > RATE_MIN)
            ceduo_canvas_line(d->canvas, f, CEDUO_ROLE_MEAN, x, fmax(RATE_MIN, logarithm(e->rate.lo)), x,
                              fmin(f->y1, logarithm(e->rate.hi)));
    }
}

static void draw_years_label(const struct ceduo_drawing *d, double years)
{
    const struct ceduo_frame *f = &d->frame;
    int column, row;
    if (!ceduo_frame_cell(f, d->canvas, f->x0, -log10(years), &column, &row))
        return;
    if (ceduo_canvas_is_blank(d->canvas, f->left - 2, row))
        ceduo_plot_print(d->canvas, f->left - 2, row, 2 - hazard_size.axis, CEDUO_ROLE_AXIS, _("%g y"), years);
}

static void draw_energy_label(const struct ceduo_drawing *d, double kJ)
{
    const struct ceduo_frame *f = &d->frame;
    int column, row;
    if (!ceduo_frame_cell(f, d->canvas, log10(kJ), RATE_MIN, &column, &row))
        return;
    ceduo_plot_print(d->canvas, column, f->top + f->height, 12, CEDUO_ROLE_AXIS, kJ == 1 ? _("%g kJ") : "%g", kJ);
}

const char *ceduo_plot_hazard(struct ceduo_drawing *d)
{
    static const double energies[] = {30, 300}, years[] = {30, 100, 300};
    bool blocks = d->scene->blocks_count > 0;
    const struct ceduo_hazard *bare = blocks ? find_hazard(d, 0) : NULL;
    size_t items = d->wooded ? d->scene->options_count + 1 : 1, last = bare ? bare->curve->count : 0;
    if (!bare)
        return blocks ? _("not computed yet") : _("the scene has no 'blocks'");
    if (!set_chart_frame(d, &hazard_size, items))
        return _("too narrow");
    while (last > 0 && logarithm(bare->curve->points[last - 1].rate.mean) < RATE_MIN)
        last--;
    d->frame.x1 = last > 0 ? log10(bare->curve->points[last - 1].energy * J_TO_KJ * 1.3) : 0;
    d->frame.y0 = RATE_MIN;
    d->frame.y1 = ceil(logarithm(bare->reach.mean) + 1e-9);
    if (!(d->frame.x1 > 0 && d->frame.y1 > RATE_MIN))
        return _("rocks arrive less than once in a thousand years");
    ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS, "%s",
                     _("return period of a rock above this energy, years"));
    for (int i = 0; i < 2; i++) {
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_AXIS, log10(energies[i]));
        draw_energy_label(d, energies[i]);
    }
    for (int i = 0; i < 3; i++) {
        ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, -log10(years[i]));
        draw_years_label(d, years[i]);
    }
    for (int decade = (int)d->frame.y1; decade >= RATE_MIN; decade--)
        draw_years_label(d, pow(10, -decade));
    for (int decade = 0; decade <= (int)d->frame.x1; decade++)
        draw_energy_label(d, pow(10, decade));
    for (size_t i = 0; i < items; i++)
        draw_curve(d, i);
    for (size_t i = 0; i < items; i++) {
        const struct ceduo_hazard *h = find_hazard(d, i);
        char sign[24];
        size_t point = 14 + 4 * i; /* label with the option's number */
        snprintf(sign, sizeof sign, "%zu", i);
        while (h && point > 0 && (point >= h->curve->count || logarithm(h->curve->points[point].rate.mean) < RATE_MIN))
            point--;
        if (h)
            draw_sign(d, log_kJ(&h->curve->points[point]), logarithm(h->curve->points[point].rate.mean), false,
                      get_sign_role(d, i), sign);
        draw_name(d, i);
    }
    return NULL;
}

/* ---- classes of fences ---- */

/* Rocks of 1000 that defeat a fence of the control's height (y), by its class (x), without forest and for each option. The rule
 * is the limit. */
const char *ceduo_plot_fence(struct ceduo_drawing *d)
{
    static const struct chart_size size = {.axis = 6, .below = 2, .legend = 30, .width = 24, .height = 6};
    bool stands = d->control && ceduo_fence_stands(&d->control->fence);
    size_t items = d->wooded ? d->scene->options_count + 1 : 1;
    double max = 0;
    if (!stands || !ceduo_fence_find(d->bare_arrivals))
        return stands ? _("not computed yet") : _("the control has no 'fence'");
    if (!set_chart_frame(d, &size, items))
        return _("too narrow");
    double limit = 1000 * ceduo_exceed_limit(d->scene, d->control);
    for (size_t i = 0; i < items; i++) {
        const struct ceduo_fence_arrivals *f = ceduo_fence_find(find_arrivals(d, i));
        max = fmax(max, f ? 1000 * f->by_class[0] : 0);
    }
    d->frame.x1 = CEDUO_FENCE_CLASSES - 1;
    d->frame.y1 = 1.1 * fmax(max, fmin(limit, 1000));
    ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS,
                     _("of 1000 that defeat a fence of %s m, by its class"), LOCALIZED(d->control->fence.height));
    ceduo_plot_axes(d, 0, 0, _("class"));
    if (limit < d->frame.y1)
        ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, limit);
    for (size_t i = 0; i < items; i++) {
        const struct ceduo_fence_arrivals *f = ceduo_fence_find(find_arrivals(d, i));
        for (size_t k = 0; f && k + 1 < CEDUO_FENCE_CLASSES; k++)
            ceduo_canvas_line(d->canvas, &d->frame, get_role(i), (double)k, 1000 * f->by_class[k], (double)k + 1,
                              1000 * f->by_class[k + 1]);
    }
    for (size_t i = 0; i < items; i++) { /* signs over all lines */
        const struct ceduo_fence_arrivals *f = ceduo_fence_find(find_arrivals(d, i));
        char sign[24];
        snprintf(sign, sizeof sign, "%zu", i);
        if (f)
            draw_sign(d, 0, 1000 * f->by_class[0], true, get_sign_role(d, i), sign);
        draw_name(d, i);
    }
    return NULL;
}

/* ---- protection against yield ---- */

/* Judged share of an option over its rotation (y) against its yield per year (x). The lower right corner is best. Options
 * dominated by another one are in brackets. */

static bool is_known(const struct ceduo_choice *c)
{
    return !isnan(c->mean.mean) && !isnan(c->yield.cut_per_year);
}

const char *ceduo_plot_tradeoff(struct ceduo_drawing *d)
{
    static const struct chart_size size = {.axis = 6, .below = 2, .legend = 34, .width = 24, .height = 6};
    const struct ceduo_verdict *v = d->picture->verdict;
    double yield = 0, share = 0;
    size_t known = 0;
    if (!v || !v->wooded)
        return !v ? _("not computed yet") : _("nothing to compare: no rocks are simulated among stems");
    if (!set_chart_frame(d, &size, v->n + 1))
        return _("too narrow");
    for (size_t i = 0; i < v->n; i++) {
        const struct ceduo_choice *c = &v->choices[i];
        if (!is_known(c))
            continue;
        known++;
        yield = fmax(yield, c->yield.cut_per_year);
        share = fmax(share, 1000 * (c->mean.mean + c->mean.half));
    }
    if (known == 0)
        return isnan(v->choices[0].mean.mean) ? _("not computed yet") : _("no option has growth and cutting data");
    d->frame.x1 = yield > 0 ? 1.15 * yield : 1;
    d->frame.y1 = share > 0 ? 1.1 * share : 1;
    ceduo_plot_print(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS, "%s",
                     v->accepted ? _("dangerous of 1000, against m\xc2\xb3 per ha and year")
                                 : _("arriving of 1000, against m\xc2\xb3 per ha and year"));
    ceduo_plot_axes(d, 0, 0, _("m\xc2\xb3"));
    for (size_t i = 0; i < v->n; i++) {
        const struct ceduo_choice *c = &v->choices[i];
        if (is_known(c))
            ceduo_canvas_line(d->canvas, &d->frame, CEDUO_ROLE_MEAN, c->yield.cut_per_year,
                              1000 * (c->mean.mean - c->mean.half), c->yield.cut_per_year,
                              1000 * (c->mean.mean + c->mean.half));
    }
    for (size_t i = 0; i <= v->n; i++) { /* signs and names over all error bars */
        const struct ceduo_choice *c = &v->choices[i];
        int row = d->legend.top + (int)i, width = (int)i < d->legend.height ? d->legend.width : 0;
        char sign[24];
        if (i == v->n) {
            ceduo_plot_print(d->canvas, d->legend.left, row, width, CEDUO_ROLE_AXIS, _("( ) another is better in both"));
        } else if (is_known(c)) {
            enum ceduo_role role = i == d->picture->option ? CEDUO_ROLE_CURSOR : c->beaten ? CEDUO_ROLE_BAD : CEDUO_ROLE_GOOD;
            snprintf(sign, sizeof sign, c->beaten ? "(%zu)" : "%zu", i + 1);
            draw_sign(d, c->yield.cut_per_year, 1000 * c->mean.mean, true, role, sign);
            ceduo_plot_print(d->canvas, d->legend.left, row, width, role, "%s %s", sign, d->scene->options[i].name);
        } else {
            ceduo_plot_print(d->canvas, d->legend.left, row, width, CEDUO_ROLE_AXIS, _("- %s: no yield known"),
                             d->scene->options[i].name);
        }
    }
    return NULL;
}
