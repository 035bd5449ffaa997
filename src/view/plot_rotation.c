/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "core/runs/run.h"
#include "plot.h"

/* An option over the years: ADC and limit, judged share, lights and cuts on one axis. */

#define LIGHTS    3
#define ADC_TOP   2.0 /* top of the scale in limits; larger values are clipped */
#define STRIP_MIN 3

/* Draw stairs of a value per year, under a caption. */
static void draw_year_strip(struct ceduo_drawing *d, int top, int height, double max, double limit, const char *caption,
                            const double *x, const double *y)
{
    const struct ceduo_years *years = d->picture->years;
    ceduo_canvas_draw_text(d->canvas, d->frame.left, top, d->area.left + d->area.width - d->frame.left, CEDUO_ROLE_AXIS,
                           caption);
    d->frame.top = top + 1;
    d->frame.height = height - 1;
    d->frame.y1 = max;
    if (!isnan(limit))
        ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_CONTROL, limit);
    if (d->picture->year < years->count)
        ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_CURSOR, x[d->picture->year]);
    ceduo_canvas_stairs(d->canvas, &d->frame, CEDUO_ROLE_MEAN, years->count, x, y);
    ceduo_canvas_axis_left(d->canvas, &d->frame);
}

/* Draw the judged share over the years, and above it the ADC if both strips fit. */
static void draw_year_strips(struct ceduo_drawing *d, int height, const double *x, double *y)
{
    const struct ceduo_years *years = d->picture->years;
    int top = d->area.top + 1, first = height < 2 * STRIP_MIN ? 0 : height / 2;
    double threshold = d->scene->simulation.threshold, accepted = d->control->accepted * J_TO_KJ, max = 0;
    double limit = 1000 * ceduo_exceed_limit(d->scene, d->control);
    LOCAL_TEXT(adc);
    LOCAL_TEXT(share);
    ceduo_text_format(&adc, _("ADC of the worst belt, m (limit %g)"), threshold);
    for (size_t i = 0; i < years->count; i++)
        y[i] = fmin(years->years[i].controls[d->picture->control].worst_adc, ADC_TOP * threshold);
    if (first > 0)
        draw_year_strip(d, top, first, ADC_TOP * threshold, threshold, ceduo_text_string(&adc), x, y);
    if (!d->wooded)
        ceduo_text_append(&share, _("stems could take, kJ per 100 m (Eq. 4)"));
    else if (isnan(accepted))
        ceduo_text_append(&share, _("of 1000 released arrive"));
    else
        ceduo_text_format(&share, _("of 1000 released with > %g kJ (limit %g)"), accepted, limit);
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *year = &years->years[i];
        y[i] = d->wooded ? ceduo_plot_year_share(year, d->picture->control)
                         : year->controls[d->picture->control].per_100m * J_TO_KJ;
        max = fmax(max, 1.1 * y[i]);
    }
    max = d->wooded ? 1000 : max > 0 ? max : 1;
    draw_year_strip(d, top + first, height - first, max, d->wooded && !isnan(accepted) ? limit : NAN, ceduo_text_string(&share),
                    x, y);
}

static int find_column(const struct ceduo_drawing *d, double year)
{
    int column, row;
    return ceduo_frame_cell(&d->frame, d->canvas, year, d->frame.y0, &column, &row) ? column : -1;
}

const char *ceduo_plot_rotation(struct ceduo_drawing *d)
{
    static const char *const names[LIGHTS] = {NP_("light", "C"), NP_("light", "F"), NP_("light", "E")};
    const struct ceduo_years *years = d->picture->years;
    const struct ceduo_area *a = &d->area;
    int lights = a->height >= 1 + STRIP_MIN + 2 + LIGHTS ? LIGHTS : 0; /* 0 if only the curves fit */
    if (!years || !d->control)
        return !d->control ? _("no control") : _("not computed yet");
    if (a->height < 1 + STRIP_MIN + 2 || a->width < 24)
        return _("too narrow");
    double *x = ceduo_check_memory(malloc((years->count + 1) * sizeof *x)),
           *y = ceduo_check_memory(malloc((years->count + 1) * sizeof *y));
    for (size_t i = 0; i < years->count; i++)
        x[i] = years->years[i].year;
    double last = x[years->count - 1];
    d->frame = (struct ceduo_frame){
        .left = a->left + 6, .width = a->width - 8, .x0 = x[0], .x_integer = true, .x1 = last > x[0] ? last : x[0] + 1};
    /* use an integer number of columns per year, if possible, for evenly spaced marks */
    int steps = (int)years->count - 1, step = steps > 0 ? (d->frame.width - 1) / steps : 0;
    if (step > 0)
        d->frame.width = step * steps + 1;
    if (d->picture->span)
        *d->picture->span = (struct ceduo_span){d->frame.left, d->frame.width, d->frame.x0, d->frame.x1};
    draw_year_strips(d, a->height - 3 - lights, x, y);
    ceduo_canvas_axis_bottom(d->canvas, &d->frame, _("years"));
    if (d->picture->year < years->count)
        ceduo_canvas_label(d->canvas, find_column(d, x[d->picture->year]), d->frame.top + d->frame.height, CEDUO_ROLE_CURSOR,
                           "\xe2\x96\xb2");
    for (int k = 0; k < lights; k++) { /* one mark per year; years in one column show the worst */
        int row = a->top + a->height - lights + k;
        ceduo_canvas_label(d->canvas, a->left, row, CEDUO_ROLE_AXIS, ceduo_translate_in(names[k]));
        for (size_t i = 0; i < 2 * years->count; i++) {
            size_t year = i % years->count;
            const struct ceduo_index *s = &years->years[year].controls[d->picture->control];
            enum ceduo_light light = k == 0 ? s->contact : k == 1 ? s->free_run : s->energy;
            int column = find_column(d, x[year]);
            if (column >= 0 && (light == CEDUO_LIGHT_FAIL) == (i >= years->count))
                ceduo_canvas_label(d->canvas, column, row, ceduo_plot_light_role(light), ceduo_plot_light_mark(light));
        }
    }
    /* mark each year of a cut, with a label if it does not touch the next mark */
    const char *word = _("cut");
    int min_gap = (int)ceduo_utf8_width(word) + 2, next = a->left + a->width;
    for (size_t i = years->count; i-- > 0;) {
        int column = years->years[i].cut ? find_column(d, x[i]) : -1;
        if (column < 0)
            continue;
        ceduo_canvas_label(d->canvas, column, a->top, CEDUO_ROLE_WARN, "\xe2\x96\xbc");
        if (next - column >= min_gap)
            ceduo_canvas_label(d->canvas, column + 1, a->top, CEDUO_ROLE_WARN, word);
        next = column;
    }
    free(x);
    free(y);
    return NULL;
}
