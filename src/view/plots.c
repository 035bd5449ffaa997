/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "core/runs/run.h"
#include "plot.h"
#include "scene/stand.h"

/* ---- pictures ---- */

const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS] = {
#define X(NAME, name, flags, title) [CEDUO_PLOT_##NAME] = {#name, title, flags},
    CEDUO_PLOT_LIST(X)
#undef X
};

#define X(NAME, name, flags, title) ", " #name
const char *const ceduo_plot_names = &(CEDUO_PLOT_LIST(X))[2];
#undef X

enum ceduo_plot ceduo_plot_find(const char *name)
{
    for (int i = CEDUO_PLOT_NONE + 1; i < CEDUO_PLOTS; i++)
        if (strcmp(ceduo_plot_kinds[i].name, name) == 0)
            return (enum ceduo_plot)i;
    return CEDUO_PLOT_NONE;
}

const struct ceduo_arrivals *ceduo_plot_arrivals(const struct ceduo_run_snapshot *run, size_t control)
{
    return run && control < run->simulated.controls ? &run->simulated.arrivals[control] : NULL;
}

double ceduo_plot_year_share(const struct ceduo_year *year, size_t control)
{
    return year->wooded.rocks > 0 ? 1000 * ceduo_judged_share(&year->wooded.arrivals[control]).mean : NAN;
}

static struct ceduo_drawing make_drawing(const struct ceduo_picture *p)
{
    const struct ceduo_scene *s = p->scene;
    const struct ceduo_slope *slope = &s->slope;
    const double *last = &slope->x[slope->vertices - 1];
    bool all = !(p->to > p->from);
    struct ceduo_drawing d = {.picture = p,
                              .scene = s,
                              .option = p->option < s->options_count ? &s->options[p->option] : NULL,
                              .control = p->control < s->controls_count ? &s->controls[p->control] : NULL,
                              .run = ceduo_snapshot_find(p->snapshot, s, p->option),
                              .bare = p->snapshot ? p->snapshot->bare : NULL,
                              .wooded = s->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX,
                              .from = all ? slope->x[0] : fmax(p->from, slope->x[0]),
                              .to = all ? *last : fmin(p->to, *last)};
    d.belt = d.option && p->belt < d.option->belts_count ? &d.option->belts[p->belt] : NULL;
    d.arrivals = ceduo_plot_arrivals(d.run, p->control);
    d.bare_arrivals = ceduo_plot_arrivals(d.bare, p->control);
    return d;
}

static const char *draw_picture(enum ceduo_plot plot, struct ceduo_drawing *drawing)
{
    static ceduo_plot_function *const functions[CEDUO_PLOTS] = {
#define X(NAME, name, flags, title) [CEDUO_PLOT_##NAME] = ceduo_plot_##name,
        CEDUO_PLOT_LIST(X)
#undef X
    };
    return functions[plot](drawing);
}

bool ceduo_plot_add(enum ceduo_plot plot, struct ceduo_page *page, const struct ceduo_picture *picture, int height)
{
    struct ceduo_drawing d = make_drawing(picture);
    d.page = page;
    d.height = height;
    const char *reason = draw_picture(plot, &d);
    if (reason)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, "%s", reason);
    return !reason;
}

#define PAGE_WIDTH_MIN 30 /* min columns for text next to bars */

void ceduo_plot_draw(enum ceduo_plot plot, struct ceduo_canvas *canvas, const struct ceduo_area *area,
                     const struct ceduo_picture *picture)
{
    LOCAL_PAGE(page, (size_t)area->width);
    struct ceduo_drawing d = make_drawing(picture);
    bool is_page = ceduo_plot_kinds[plot].flags & CEDUO_PICTURE_PAGE;
    if (canvas->text_only)
        return;
    d.canvas = canvas;
    d.area = *area;
    d.page = &page;
    d.height = area->height;
    const char *reason = draw_picture(plot, &d);
    if (is_page && !reason && area->width < PAGE_WIDTH_MIN)
        reason = _("too narrow");
    if (is_page && !reason)
        ceduo_page_draw(&page, canvas, *area, 0);
    if (!reason)
        return;
    int width = ceduo_canvas_label_width(canvas, reason), column = width < area->width ? (area->width - width) / 2 : 0;
    ceduo_canvas_draw_text(canvas, area->left + column, area->top + (area->height - 1) / 2, area->width, CEDUO_ROLE_TEXT,
                           reason);
}

/* Share of rocks that stop farther down: observed curve over the band of simulated rocks. */
#define SEEN_WIDTH  30
#define SEEN_HEIGHT 6

void ceduo_plot_observed(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_observed_stops *s,
                         double origin)
{
    struct ceduo_drawing d = {.canvas = canvas,
                              .frame = {.left = area->left,
                                        .top = area->top + 1,
                                        .width = area->width,
                                        .height = area->height - 3,
                                        .x0 = s->x[0],
                                        .x1 = s->x[CEDUO_STOPS_PLACES - 1],
                                        .y1 = 1}};
    int axis = ceduo_frame_axis_width(&d.frame, canvas);
    if (canvas->text_only)
        return;
    if (area->width < SEEN_WIDTH || area->height < SEEN_HEIGHT) {
        ceduo_canvas_draw_text(canvas, area->left, area->top, area->width, CEDUO_ROLE_TEXT, _("too narrow"));
        return;
    }
    ceduo_canvas_draw_text(canvas, area->left, area->top, area->width, CEDUO_ROLE_AXIS,
                           _("lies farther: line seen, shaded simulated"));
    d.frame.left += axis;
    d.frame.width -= axis;
    for (size_t i = 0; i < CEDUO_STOPS_PLACES; i++)
        ceduo_canvas_line(canvas, &d.frame, CEDUO_ROLE_DIM, s->x[i], s->lo[i], s->x[i], s->hi[i]);
    ceduo_canvas_polyline(canvas, &d.frame, CEDUO_ROLE_ENVELOPE, CEDUO_STROKE_PLAIN, CEDUO_STOPS_PLACES, s->x, s->lo);
    ceduo_canvas_polyline(canvas, &d.frame, CEDUO_ROLE_ENVELOPE, CEDUO_STROKE_PLAIN, CEDUO_STOPS_PLACES, s->x, s->hi);
    ceduo_canvas_stairs(canvas, &d.frame, CEDUO_ROLE_MEAN, CEDUO_STOPS_PLACES, s->x, s->observed);
    ceduo_plot_axes(&d, origin, 0, "m");
}

void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *picture)
{
    const struct ceduo_drawing d = make_drawing(picture);
    const struct ceduo_plot_kind *kind = &ceduo_plot_kinds[plot];
    LOCAL_TEXT(place);
    if (plot == CEDUO_PLOT_STAND)
        ceduo_text_append(&place, d.belt && d.belt->name ? d.belt->name : _("no forest"));
    else if (d.control)
        ceduo_words_place(&place, d.control);
    else
        ceduo_text_append(&place, _("no control"));
    if (!(kind->flags & CEDUO_PICTURE_ALL_OPTIONS))
        ceduo_text_format(text, "%s: ", d.option && d.option->name ? d.option->name : "");
    ceduo_text_append_with(text, _(kind->title), ceduo_text_string(&place));
    if ((kind->flags & CEDUO_PICTURE_ROCKS) && !d.wooded)
        ceduo_text_append_joined(text, ", ", _("without forest"));
}

/* ---- text ---- */

int ceduo_plot_print(struct ceduo_canvas *canvas, int column, int row, int max, enum ceduo_role role, const char *format, ...)
{
    LOCAL_TEXT(text);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    int width = ceduo_canvas_label_width(canvas, ceduo_text_string(&text));
    width = width < abs(max) ? width : abs(max);
    return ceduo_canvas_draw_text(canvas, max < 0 ? column + 1 - width : column, row, width, role, ceduo_text_string(&text));
}

void ceduo_plot_belt_name(struct text *text, const struct ceduo_belt *belt)
{
    ceduo_text_append(text, belt->name ? belt->name : _("stand"));
    ceduo_text_append(text, belt->assumed ? "*" : "");
}

enum ceduo_role ceduo_plot_light_role(enum ceduo_light light)
{
    return light == CEDUO_LIGHT_PASS ? CEDUO_ROLE_GOOD : light == CEDUO_LIGHT_FAIL ? CEDUO_ROLE_BAD : CEDUO_ROLE_DIM;
}

const char *ceduo_plot_light_mark(enum ceduo_light light)
{
    return light == CEDUO_LIGHT_PASS ? "\xe2\x9c\x94" : light == CEDUO_LIGHT_FAIL ? "\xe2\x9c\x98" : "?";
}

void ceduo_page_light(struct ceduo_page *page, enum ceduo_light light)
{
    ceduo_page_cell_role(page, ceduo_plot_light_role(light), ceduo_plot_light_mark(light));
}

/* ---- forests ---- */

bool ceduo_plot_has_stems(const struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++)
        if (!ceduo_stand_is_bare(&option->belts[i].stand))
            return true;
    return false;
}

/* ---- frames ---- */

struct ceduo_frame ceduo_plot_user_frame(const struct ceduo_frame *frame, double x, double y)
{
    struct ceduo_frame given = *frame;
    given.x0 += x;
    given.x1 += x;
    given.y0 += y;
    given.y1 += y;
    return given;
}

void ceduo_plot_axes(const struct ceduo_drawing *d, double x, double y, const char *unit)
{
    struct ceduo_frame given = ceduo_plot_user_frame(&d->frame, x, y);
    ceduo_canvas_axis_left(d->canvas, &given);
    if (unit)
        ceduo_canvas_axis_bottom(d->canvas, &given, unit);
}

double ceduo_plot_round(double value, bool up)
{
    static const double round[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(value))), prev = power;
    for (int i = 0; i < 4; i++) {
        double step = round[i] * power;
        if (step * (1 + 1e-9) >= value)
            return up || step <= value * (1 + 1e-9) ? step : prev;
        prev = step;
    }
    return prev;
}
