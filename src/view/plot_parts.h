/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOT_PARTS_H
#define CEDUO_PLOT_PARTS_H

#include "page.h"
#include "plot.h"
#include "words.h"

/* What several pictures share. */

/* The pictures but for those that are pages. Each returns NULL, or why there is nothing to draw. */
typedef const char *ceduo_plot_function(struct ceduo_canvas *canvas, const struct ceduo_area *area,
                                        const struct ceduo_picture *picture);
ceduo_plot_function ceduo_plot_profile, ceduo_plot_energy, ceduo_plot_height, ceduo_plot_rotation, ceduo_plot_stand,
    ceduo_plot_tradeoff, ceduo_plot_hazard;

/* A picture of rows with words and bars is a page: these add its blocks, of about `height` lines, for a pane to show among others.
 * Each returns NULL, or why there is nothing. */
typedef const char *ceduo_blocks_function(struct ceduo_page *page, const struct ceduo_picture *picture, int height);
ceduo_blocks_function ceduo_blocks_adc, ceduo_blocks_histogram, ceduo_blocks_compare, ceduo_blocks_doubt;

/* A cell with the sign of a light. */
void ceduo_page_light(struct ceduo_page *page, enum ceduo_light light);

/* As ceduo_canvas_put(), formatted. */
int ceduo_plot_say(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* The same, its last cell in column `column`. */
void ceduo_plot_say_right(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *format,
                          ...) __attribute__((format(printf, 6, 7)));

/* The first of `count` texts that has room, the last one cut where none has. Frees them all. */
int ceduo_plot_put_fitting(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, size_t count,
                           struct text *texts);
int ceduo_plot_say_fitting(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *words,
                           const char *fewer);

/* "end of the forest (135 m)", or "135 m". */
void ceduo_plot_control_name(struct text *text, const struct ceduo_control *control);

/* NULL where the picture's index names none. */
const struct ceduo_option *ceduo_plot_option(const struct ceduo_picture *picture);
const struct ceduo_belt *ceduo_plot_belt(const struct ceduo_picture *picture);
const struct ceduo_control *ceduo_plot_control(const struct ceduo_picture *picture);
/* What is to be seen of the picture's option (through its forest; bare with the contact model index), and without
 * forest; NULL where it is not known. The arrivals likewise. */
const struct ceduo_run_snapshot *ceduo_plot_sight(const struct ceduo_picture *picture);
const struct ceduo_run_snapshot *ceduo_plot_bare(const struct ceduo_picture *picture);
const struct ceduo_arrivals *ceduo_plot_arrivals(const struct ceduo_picture *picture, size_t control);
const struct ceduo_arrivals *ceduo_plot_bare_arrivals(const struct ceduo_picture *picture, size_t control);

/* Whether rocks go through the forest: false with the contact model index. */
bool ceduo_plot_wooded(const struct ceduo_picture *picture);

/* Whether any stem stands in the option's belts. */
bool ceduo_plot_has_stems(const struct ceduo_option *option);

/* The stretch of slope to show. */
void ceduo_plot_stretch(const struct ceduo_picture *picture, double *from, double *to);

/* A frame in the user's coordinates, for its axes: those of the data and what is added to them. */
struct ceduo_frame ceduo_plot_given(const struct ceduo_frame *frame, double x, double y);

/* The left axis of a frame in the user's coordinates, and the bottom axis in `unit` (NULL: none). */
void ceduo_plot_axes(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, double x, double y, const char *unit);

/* A frame with a legend: beside it where the area is wide, otherwise below it, and nowhere where that leaves no `height`. */
struct ceduo_chart {
    struct ceduo_canvas *canvas;
    struct ceduo_frame frame; /* its ranges are 0 */
    struct ceduo_area legend; /* of no height: it has no room */
};
struct ceduo_chart_size {
    int axis, below;   /* columns of the left axis, rows of the bottom axis */
    int legend, lines; /* columns and rows of the legend */
    int width, height; /* the least of the picture */
};
struct ceduo_chart ceduo_chart_place(struct ceduo_canvas *canvas, const struct ceduo_area *area,
                                     const struct ceduo_chart_size *size);

/* A sign at a point, or beside it; a little lower where another stands there. */
void ceduo_chart_sign(const struct ceduo_chart *chart, double x, double y, bool beside, enum ceduo_role role, const char *sign);

/* The largest 1, 2 or 5 times a power of ten that is not above a value, or the least that is not below. */
double ceduo_plot_round(double value, bool up);

/* The height of the tallest stem; 0 in a bare stand. */
double ceduo_plot_tallest(const struct ceduo_stand *stand);

/* The name of a stand with a star where something of it is assumed. */
void ceduo_plot_belt_name(struct text *text, const struct ceduo_belt *belt);

#endif
