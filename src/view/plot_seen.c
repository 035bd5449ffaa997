/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stops: the share of the rocks that lie farther down, as it was seen, over the band of the simulated rocks. */
#include "base/language.h"
#include "plot_parts.h"

#define WIDTH_LEAST  30
#define HEIGHT_LEAST 6

void ceduo_plot_seen(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_seen_stops *s,
                     double origin)
{
    if (canvas->words_alone)
        return;
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST) {
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
