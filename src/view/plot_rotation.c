/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"
#include "plot_parts.h"
#include "study/verdict.h"

/* An option over the years: ADC against its limit, how many come through with too much energy, the lights, the cuts, on
 * one axis. */

#define LIGHTS      3
#define ADC_TOP     2.0 /* of the scale, in limits: how far beyond the limit a bad year lies says nothing more */
#define STRIP_LEAST 3

struct rotation {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    const struct ceduo_years *years;
    const struct ceduo_control *control;
    size_t c; /* the control's index */
    bool flown;
    struct ceduo_frame frame;
    double *x, *y;
};

static double adc_of(const struct rotation *r, const struct ceduo_year *year)
{
    return fmin(year->controls[r->c].worst_adc, ADC_TOP * r->picture->scene->simulation.threshold);
}

/* Of 1000 released; by the index kJ per 100 m. */
static double share_of(const struct rotation *r, const struct ceduo_year *year)
{
    const struct ceduo_index *index = &year->controls[r->c];
    if (!r->flown)
        return index->per_100m * J_TO_KJ;
    if (year->wooded.rocks == 0)
        return NAN;
    return 1000 * ceduo_share_of(&year->wooded.arrivals[r->c]);
}

static void draw_strip(struct rotation *r, int top, int height, double most, double limit, const char *caption,
                       double (*of)(const struct rotation *, const struct ceduo_year *))
{
    ceduo_canvas_put(r->canvas, r->frame.left, top, r->area->left + r->area->width - r->frame.left, CEDUO_ROLE_AXIS, caption);
    r->frame.top = top + 1;
    r->frame.height = height - 1;
    r->frame.y0 = 0;
    r->frame.y1 = most;
    for (size_t i = 0; i < r->years->count; i++)
        r->y[i] = of(r, &r->years->years[i]);
    if (!isnan(limit))
        ceduo_canvas_rule_y(r->canvas, &r->frame, CEDUO_ROLE_CONTROL, limit);
    if (r->picture->year < r->years->count)
        ceduo_canvas_rule_x(r->canvas, &r->frame, CEDUO_ROLE_CURSOR, r->x[r->picture->year]);
    ceduo_canvas_stairs(r->canvas, &r->frame, CEDUO_ROLE_MEAN, r->years->count, r->x, r->y);
    ceduo_canvas_axis_left(r->canvas, &r->frame);
}

static int column_of(const struct rotation *r, double year)
{
    int column, row;
    return ceduo_frame_cell(&r->frame, r->canvas, year, r->frame.y0, &column, &row) ? column : -1;
}

static void draw(struct rotation *r)
{
    static const char *const names[LIGHTS] = {NP_("light", "C"), NP_("light", "F"), NP_("light", "E")};
    const struct ceduo_area *a = r->area;
    double threshold = r->picture->scene->simulation.threshold;
    int lights = a->height >= 1 + STRIP_LEAST + 2 + LIGHTS ? LIGHTS : 0; /* no room: the curve alone */
    int strips = a->height - 1 - 2 - lights, first = strips / 2;
    LOCAL_TEXT(adc);
    LOCAL_TEXT(share);
    if (a->width >= 60)
        ceduo_text_format(&adc, _("ADC of the worst belt, m (limit %g; at the top: %g or more)"), threshold,
                          ADC_TOP * threshold);
    else
        ceduo_text_format(&adc, _("ADC of the worst belt, m (limit %g)"), threshold);
    if (!r->flown)
        ceduo_text_put(&share, _("stems could take, kJ per 100 m (Eq. 4)"));
    else if (isnan(r->control->accepted))
        ceduo_text_put(&share, _("of 1000 released arrive"));
    else
        ceduo_text_format(&share,
                          r->area->width >= 60 ? _("of 1000 released with more than %g kJ (limit %g)")
                                               : _("of 1000 released with > %g kJ (limit %g)"),
                          r->control->accepted * J_TO_KJ, CEDUO_EXCEED_MOST * 1000);
    if (strips < 2 * STRIP_LEAST) /* room for one: what gets through */
        first = 0;
    else
        draw_strip(r, a->top + 1, first, ADC_TOP * threshold, threshold, ceduo_text_string(&adc), adc_of);
    double most = 0;
    for (size_t i = 0; i < r->years->count; i++)
        most = fmax(most, 1.1 * share_of(r, &r->years->years[i]));
    most = r->flown ? 1000 : most > 0 ? most : 1;
    draw_strip(r, a->top + 1 + first, strips - first, most,
               r->flown && !isnan(r->control->accepted) ? CEDUO_EXCEED_MOST * 1000 : NAN, ceduo_text_string(&share), share_of);
    ceduo_canvas_axis_bottom(r->canvas, &r->frame, _("years"));
    for (int k = 0; k < lights; k++) { /* a mark for each year; of years that share a column the worst is shown */
        int row = a->top + a->height - lights + k;
        ceduo_canvas_label(r->canvas, a->left, row, CEDUO_ROLE_AXIS, ceduo_translate_in(names[k]));
        for (size_t i = 0; i < 2 * r->years->count; i++) {
            size_t year = i % r->years->count;
            const struct ceduo_index *s = &r->years->years[year].controls[r->c];
            enum ceduo_light light = k == 0 ? s->contact : k == 1 ? s->free_run : s->energy;
            int column = column_of(r, r->x[year]);
            if (column >= 0 && (light == CEDUO_FAIL) == (i >= r->years->count))
                ceduo_canvas_label(r->canvas, column, row, ceduo_plot_light_role(light), ceduo_plot_light_mark(light));
        }
    }
    /* a mark above each year of a cut, and a word behind it where that does not run into the next */
    const char *word = _("cut");
    int room = (int)ceduo_utf8_width(word) + 2, next = a->left + a->width;
    for (size_t i = r->years->count; i-- > 0;) {
        int column = r->years->years[i].cut ? column_of(r, r->x[i]) : -1;
        if (column < 0)
            continue;
        ceduo_canvas_label(r->canvas, column, a->top, CEDUO_ROLE_WARN, "\xe2\x96\xbc");
        if (next - column >= room)
            ceduo_canvas_label(r->canvas, column + 1, a->top, CEDUO_ROLE_WARN, word);
        next = column;
    }
}

const char *ceduo_plot_rotation(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_years *years = picture->years;
    struct rotation r = {.canvas = canvas,
                         .area = area,
                         .picture = picture,
                         .years = years,
                         .control = ceduo_plot_control(picture),
                         .c = picture->control,
                         .flown = ceduo_plot_wooded(picture)};
    if (!years || !r.control)
        return !r.control ? _("no control") : _("not computed yet");
    if (area->height < 1 + STRIP_LEAST + 2 || area->width < 24)
        return _("too narrow");
    r.x = ceduo_must(malloc((years->count + 1) * sizeof *r.x));
    r.y = ceduo_must(malloc((years->count + 1) * sizeof *r.y));
    for (size_t i = 0; i < years->count; i++)
        r.x[i] = years->years[i].year;
    double last = r.x[years->count - 1];
    r.frame = (struct ceduo_frame){.left = area->left + 6,
                                   .width = area->width - 8,
                                   .x0 = r.x[0],
                                   .x_whole = true,
                                   .x1 = last > r.x[0] ? last : r.x[0] + 1};
    /* a whole number of columns for each year, where there are as many, so that marks stand at even distances */
    int steps = (int)years->count - 1, step = steps > 0 ? (r.frame.width - 1) / steps : 0;
    if (step > 0)
        r.frame.width = step * steps + 1;
    draw(&r);
    free(r.x);
    free(r.y);
    return NULL;
}
