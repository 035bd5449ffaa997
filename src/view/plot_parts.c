/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"

/* ---- text ---- */

int ceduo_plot_put_fitting(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, size_t count,
                           struct text *texts)
{
    size_t i = 0;
    while (i + 1 < count && ceduo_canvas_label_width(canvas, ceduo_text_string(&texts[i])) > most)
        i++;
    int cells = ceduo_canvas_put(canvas, column, row, most, role, ceduo_text_string(&texts[i]));
    for (i = 0; i < count; i++)
        ceduo_text_free(&texts[i]);
    return cells;
}

int ceduo_plot_say(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *format, ...)
{
    struct text text = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    return ceduo_plot_put_fitting(canvas, column, row, most, role, 1, &text);
}

void ceduo_plot_say_right(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *format,
                          ...)
{
    struct text text = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    int width = ceduo_canvas_label_width(canvas, ceduo_text_string(&text));
    width = width < most ? width : most;
    ceduo_plot_put_fitting(canvas, column + 1 - width, row, width, role, 1, &text);
}

int ceduo_plot_say_fitting(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *words,
                           const char *fewer)
{
    bool fits = ceduo_canvas_label_width(canvas, words) <= most;
    return ceduo_canvas_put(canvas, column, row, most, role, fits ? words : fewer);
}

void ceduo_plot_control_name(struct text *text, const struct ceduo_control *control)
{
    if (control->name)
        ceduo_text_format(text, _("%s (%s m)"), NAME_OF(control), SHORTEST(control->x_given));
    else
        ceduo_text_format(text, _("%s m"), SHORTEST(control->x_given));
}

void ceduo_plot_belt_name(struct text *text, const struct ceduo_belt *belt)
{
    ceduo_text_put(text, belt->name ? belt->name : _("stand"));
    ceduo_text_put(text, belt->assumed ? "*" : "");
}

void ceduo_page_light(struct ceduo_page *page, enum ceduo_light light)
{
    ceduo_page_mark(page, ceduo_plot_light_role(light), ceduo_plot_light_mark(light));
}

/* ---- what a picture shows ---- */

const struct ceduo_option *ceduo_plot_option(const struct ceduo_picture *p)
{
    return p->option < p->scene->options_count ? &p->scene->options[p->option] : NULL;
}

const struct ceduo_belt *ceduo_plot_belt(const struct ceduo_picture *p)
{
    const struct ceduo_option *option = ceduo_plot_option(p);
    return option && p->belt < option->belts_count ? &option->belts[p->belt] : NULL;
}

const struct ceduo_control *ceduo_plot_control(const struct ceduo_picture *p)
{
    return p->control < p->scene->controls_count ? &p->scene->controls[p->control] : NULL;
}

const struct ceduo_run_snapshot *ceduo_plot_sight(const struct ceduo_picture *p)
{
    return ceduo_snapshot_of(p->snapshot, p->scene, p->option);
}

const struct ceduo_run_snapshot *ceduo_plot_bare(const struct ceduo_picture *p)
{
    return p->snapshot ? p->snapshot->bare : NULL;
}

static const struct ceduo_arrivals *arrivals_of(const struct ceduo_run_snapshot *s, size_t control)
{
    return s && control < s->flown.controls ? &s->flown.arrivals[control] : NULL;
}

const struct ceduo_arrivals *ceduo_plot_arrivals(const struct ceduo_picture *p, size_t control)
{
    return arrivals_of(ceduo_plot_sight(p), control);
}

const struct ceduo_arrivals *ceduo_plot_bare_arrivals(const struct ceduo_picture *p, size_t control)
{
    return arrivals_of(ceduo_plot_bare(p), control);
}

bool ceduo_plot_wooded(const struct ceduo_picture *p)
{
    return p->scene->simulation.contact_model != CEDUO_INDEX;
}

bool ceduo_plot_has_stems(const struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++)
        if (!ceduo_stand_is_bare(&option->belts[i].stand))
            return true;
    return false;
}

void ceduo_plot_stretch(const struct ceduo_picture *p, double *from, double *to)
{
    const struct ceduo_slope *slope = &p->scene->slope;
    bool whole = !(p->to > p->from);
    *from = whole ? slope->x[0] : fmax(p->from, slope->x[0]);
    *to = whole ? slope->x[slope->vertices - 1] : fmin(p->to, slope->x[slope->vertices - 1]);
}

struct ceduo_frame ceduo_plot_given(const struct ceduo_frame *frame, double x, double y)
{
    struct ceduo_frame given = *frame;
    given.x0 += x;
    given.x1 += x;
    given.y0 += y;
    given.y1 += y;
    return given;
}

void ceduo_plot_axes(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, double x, double y, const char *unit)
{
    struct ceduo_frame given = ceduo_plot_given(frame, x, y);
    ceduo_canvas_axis_left(canvas, &given);
    if (unit)
        ceduo_canvas_axis_bottom(canvas, &given, unit);
}

struct ceduo_chart ceduo_chart_place(struct ceduo_canvas *canvas, const struct ceduo_area *area,
                                     const struct ceduo_chart_size *size)
{
    bool beside = area->width >= size->width + size->axis + size->legend + 16;
    int below = !beside && area->height - size->lines >= size->height + 3 ? size->lines : 0;
    struct ceduo_chart c = {.canvas = canvas,
                            .frame = {.left = area->left + size->axis,
                                      .top = area->top + 1,
                                      .width = area->width - size->axis - 1 - (beside ? size->legend + 2 : 0),
                                      .height = area->height - 1 - size->below - below},
                            .legend = {area->left, area->top + area->height - below, area->width, below}};
    if (beside)
        c.legend = (struct ceduo_area){area->left + area->width - size->legend, area->top + 1, size->legend, area->height - 1};
    return c;
}

void ceduo_chart_sign(const struct ceduo_chart *c, double x, double y, bool beside, enum ceduo_role role, const char *sign)
{
    const struct ceduo_frame *f = &c->frame;
    int column, row, width = ceduo_canvas_label_width(c->canvas, sign);
    if (!ceduo_frame_cell(f, c->canvas, x, y, &column, &row))
        return;
    if (beside)
        column += column + 1 + width > f->left + f->width ? -width : 1;
    while (row + 1 < f->top + f->height && !ceduo_canvas_is_blank(c->canvas, column, row))
        row++;
    ceduo_canvas_label(c->canvas, column, row, role, sign);
}

double ceduo_plot_round(double value, bool up)
{
    static const double round[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(value))), before = power;
    for (int i = 0; i < 4; i++) {
        double here = round[i] * power;
        if (here * (1 + 1e-9) >= value)
            return up || here <= value * (1 + 1e-9) ? here : before;
        before = here;
    }
    return before;
}

enum ceduo_role ceduo_plot_light_role(enum ceduo_light light)
{
    return light == CEDUO_PASS ? CEDUO_ROLE_GOOD : light == CEDUO_FAIL ? CEDUO_ROLE_BAD : CEDUO_ROLE_DIM;
}

const char *ceduo_plot_light_mark(enum ceduo_light light)
{
    return light == CEDUO_PASS ? "\xe2\x9c\x94" : light == CEDUO_FAIL ? "\xe2\x9c\x98" : "?";
}

double ceduo_plot_tallest(const struct ceduo_stand *stand)
{
    double tallest = 0;
    for (size_t i = 0; i < stand->shoots_count; i++)
        tallest = fmax(tallest, stand->shoots[i].per_ha > 0 ? stand->shoots[i].height : 0);
    for (size_t i = 0; i < stand->trees_count; i++)
        tallest = fmax(tallest, stand->trees[i].per_ha > 0 ? stand->trees[i].height : 0);
    return tallest;
}
