/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/language.h"
#include "plot_parts.h"

const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS] = {
#define X(NAME, name, needs_run, needs_cells, by_option) [CEDUO_PLOT_##NAME] = {#name, needs_run, needs_cells, by_option},
    CEDUO_PLOT_LIST(X)
#undef X
};

#define X(NAME, name, needs_run, needs_cells, by_option) ", " #name
const char *const ceduo_plot_names = &(CEDUO_PLOT_LIST(X))[2];
#undef X

enum ceduo_plot ceduo_plot_find(const char *name)
{
    for (int i = CEDUO_PLOT_NONE + 1; i < CEDUO_PLOTS; i++)
        if (strcmp(ceduo_plot_kinds[i].name, name) == 0)
            return (enum ceduo_plot)i;
    return CEDUO_PLOT_NONE;
}

/* How a picture is drawn; what it shows, %s: where, or which belt; `run`: it is of rocks, without forest where none go through
 * one. */
static const struct {
    ceduo_plot_function *draw;
    ceduo_blocks_function *blocks;
    const char *title;
    bool whole, run; /* whole: of all options, so that none stands before it */
} plots[CEDUO_PLOTS] = {
    [CEDUO_PLOT_PROFILE] = {ceduo_plot_profile, NULL, N_("slope, forest, and ways"), false, true},
    [CEDUO_PLOT_ENERGY] = {ceduo_plot_energy, NULL, N_("energy of the rocks"), false, true},
    [CEDUO_PLOT_HEIGHT] = {ceduo_plot_height, NULL, N_("height of the rocks above the ground"), false, true},
    [CEDUO_PLOT_HISTOGRAM] = {NULL, ceduo_blocks_histogram, N_("energy at %s"), false, true},
    [CEDUO_PLOT_ADC] = {NULL, ceduo_blocks_adc, N_("average distance between contacts, m"), false, false},
    [CEDUO_PLOT_ROTATION] = {ceduo_plot_rotation, NULL, N_("year by year, up to %s"), false, false},
    [CEDUO_PLOT_STAND] = {ceduo_plot_stand, NULL, N_("%s, from above"), false, false},
    [CEDUO_PLOT_COMPARE] = {NULL, ceduo_blocks_compare, N_("Options side by side, up to %s"), true, false},
    [CEDUO_PLOT_TRADEOFF] = {ceduo_plot_tradeoff, NULL, N_("Protection and yield of the options, up to %s"), true, false},
    [CEDUO_PLOT_DOUBT] = {NULL, ceduo_blocks_doubt, N_("how sure it is at %s"), false, false},
    [CEDUO_PLOT_HAZARD] = {ceduo_plot_hazard, NULL, N_("How often, and with how much, at %s"), true, false}};

#define WIDTH_MIN 30 /* columns below which words and bars have no room beside one another */

static const char *draw_page(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture,
                             ceduo_blocks_function *blocks)
{
    struct ceduo_page page = {.width = (size_t)area->width};
    const char *why = blocks(&page, picture, area->height);
    if (!why && area->width < WIDTH_MIN)
        why = _("too narrow");
    if (!why)
        ceduo_page_draw(&page, canvas, *area, 0);
    ceduo_page_free(&page);
    return why;
}

void ceduo_plot_draw(enum ceduo_plot plot, struct ceduo_canvas *canvas, const struct ceduo_area *area,
                     const struct ceduo_picture *picture)
{
    if (canvas->words_alone)
        return;
    const char *why =
        plots[plot].blocks ? draw_page(canvas, area, picture, plots[plot].blocks) : plots[plot].draw(canvas, area, picture);
    if (!why)
        return;
    int width = ceduo_canvas_label_width(canvas, why);
    int column = width < area->width ? (area->width - width) / 2 : 0;
    ceduo_canvas_put(canvas, area->left + column, area->top + (area->height - 1) / 2, area->width, CEDUO_ROLE_TEXT, why);
}

/* The share of the rocks that lie farther down, as it was seen, over the band of the simulated rocks. */
#define SEEN_WIDTH  30
#define SEEN_HEIGHT 6

void ceduo_plot_seen(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_seen_stops *s,
                     double origin)
{
    if (canvas->words_alone)
        return;
    if (area->width < SEEN_WIDTH || area->height < SEEN_HEIGHT) {
        ceduo_canvas_put(canvas, area->left, area->top, area->width, CEDUO_ROLE_TEXT, _("too narrow"));
        return;
    }
    struct ceduo_frame frame = {.left = area->left,
                                .top = area->top + 1,
                                .width = area->width,
                                .height = area->height - 3,
                                .x0 = s->x[0],
                                .x1 = s->x[CEDUO_SEEN_PLACES - 1],
                                .y1 = 1};
    int axis = ceduo_frame_axis_width(&frame, canvas);
    frame.left += axis;
    frame.width -= axis;
    ceduo_plot_say_fitting(canvas, area->left, area->top, area->width, CEDUO_ROLE_AXIS,
                           _("share that lies farther: a line what was seen, shaded 95 % of simulated samples"),
                           _("lies farther: line seen, shaded simulated"));
    for (size_t i = 0; i < CEDUO_SEEN_PLACES; i++)
        ceduo_canvas_line(canvas, &frame, CEDUO_ROLE_DIM, s->x[i], s->lo[i], s->x[i], s->hi[i]);
    ceduo_canvas_polyline(canvas, &frame, CEDUO_ROLE_ENVELOPE, CEDUO_SEEN_PLACES, s->x, s->lo);
    ceduo_canvas_polyline(canvas, &frame, CEDUO_ROLE_ENVELOPE, CEDUO_SEEN_PLACES, s->x, s->hi);
    ceduo_canvas_stairs(canvas, &frame, CEDUO_ROLE_MEAN, CEDUO_SEEN_PLACES, s->x, s->seen);
    ceduo_plot_axes(canvas, &frame, origin, 0, "m");
}

void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *p)
{
    const struct ceduo_control *control = ceduo_plot_control(p);
    const struct ceduo_option *option = ceduo_plot_option(p);
    const struct ceduo_belt *belt = ceduo_plot_belt(p);
    LOCAL_TEXT(place);
    if (plot == CEDUO_PLOT_STAND)
        ceduo_text_put(&place, belt && belt->name ? belt->name : _("no forest"));
    else if (control)
        ceduo_plot_control_name(&place, control);
    else
        ceduo_text_put(&place, _("no control"));
    if (!plots[plot].whole)
        ceduo_text_format(text, "%s: ", option && option->name ? option->name : "");
    ceduo_append_with(text, _(plots[plot].title), ceduo_text_string(&place));
    if (plots[plot].run && !ceduo_plot_wooded(p))
        ceduo_text_then(text, ", ", _("without forest"));
}
