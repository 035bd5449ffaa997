/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "plot_parts.h"

/* Protection against yield: what an option lets through over its rotation, upwards, and the wood it gives a year, to the right.
 * The best corner is below on the right. An option that another beats in both stands in brackets. */

static bool is_known(const struct ceduo_choice *c)
{
    return !isnan(c->mean.mean) && !isnan(c->yield.cut_per_year);
}

const char *ceduo_plot_tradeoff(struct ceduo_drawing *d)
{
    static const struct ceduo_chart_size size = {.axis = 6, .below = 2, .legend = 34, .width = 24, .height = 6};
    const struct ceduo_verdict *v = d->picture->verdict;
    double yield = 0, share = 0;
    size_t known = 0;
    if (!v || !v->wooded)
        return !v ? _("not computed yet") : _("without rocks among stems there is nothing to compare");
    if (!ceduo_plot_chart(d, &size, v->n + 1))
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
        return isnan(v->choices[0].mean.mean) ? _("not computed yet") : _("no option says how it grows and is cut");
    d->frame.x1 = yield > 0 ? 1.15 * yield : 1;
    d->frame.y1 = share > 0 ? 1.1 * share : 1;
    ceduo_plot_say(d->canvas, d->area.left, d->area.top, d->area.width, CEDUO_ROLE_AXIS, "%s",
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
    for (size_t i = 0; i <= v->n; i++) { /* signs and names, after all errors */
        const struct ceduo_choice *c = &v->choices[i];
        int row = d->legend.top + (int)i, width = (int)i < d->legend.height ? d->legend.width : 0;
        char sign[24];
        if (i == v->n) {
            ceduo_plot_say(d->canvas, d->legend.left, row, width, CEDUO_ROLE_AXIS, _("( ) another is better in both"));
        } else if (is_known(c)) {
            enum ceduo_role role = c->beaten ? CEDUO_ROLE_BAD : CEDUO_ROLE_GOOD;
            snprintf(sign, sizeof sign, c->beaten ? "(%zu)" : "%zu", i + 1);
            ceduo_plot_sign(d, c->yield.cut_per_year, 1000 * c->mean.mean, true, role, sign);
            ceduo_plot_say(d->canvas, d->legend.left, row, width, role, "%s %s", sign, d->scene->options[i].name);
        } else {
            ceduo_plot_say(d->canvas, d->legend.left, row, width, CEDUO_ROLE_AXIS, _("- %s: no yield known"),
                           d->scene->options[i].name);
        }
    }
    return NULL;
}
