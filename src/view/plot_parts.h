/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOT_PARTS_H
#define CEDUO_PLOT_PARTS_H

#include "page.h"
#include "plot.h"
#include "words.h"

/* What the pictures share. */

/* A picture that is being drawn, with what its indices name: NULL where there is none. What is to be seen of its option
 * (through the forest; bare with the contact model index), and without forest, is NULL where it is not known. */
struct ceduo_drawing {
    struct ceduo_canvas *canvas; /* NULL for a page */
    struct ceduo_area area;
    struct ceduo_page *page;  /* to which the picture adds its blocks, … */
    int height;               /* … of about so many lines */
    struct ceduo_frame frame; /* set by the picture */
    struct ceduo_area legend; /* of a chart; of no height where it has no room */
    const struct ceduo_picture *picture;
    const struct ceduo_scene *scene;
    const struct ceduo_option *option;
    const struct ceduo_belt *belt;
    const struct ceduo_control *control;
    const struct ceduo_run_snapshot *sight, *bare;
    const struct ceduo_arrivals *arrivals, *bare_arrivals; /* at the control */
    bool wooded;                                           /* rocks go through the forest: not with the contact model index */
    double from, to;                                       /* the stretch of slope to show */
};

/* Each returns NULL, or why there is nothing to draw. */
typedef const char *ceduo_plot_function(struct ceduo_drawing *drawing);
#define X(NAME, name, flags, title) ceduo_plot_function ceduo_plot_##name;
CEDUO_PLOT_LIST(X)
#undef X

/* Arrivals of a run at a control; NULL where they are not known. */
const struct ceduo_arrivals *ceduo_plot_arrivals(const struct ceduo_run_snapshot *run, size_t control);

/* A cell with the sign of a light. */
void ceduo_page_light(struct ceduo_page *page, enum ceduo_light light);

/* A text of at most `most` cells from a cell on, or, where `most` is negative, up to it; returns the cells it took. */
int ceduo_plot_say(struct ceduo_canvas *canvas, int column, int row, int most, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* The name of a stand with a star where something of it is assumed. */
void ceduo_plot_belt_name(struct text *text, const struct ceduo_belt *belt);

/* True if any stem stands in the option's belts. */
bool ceduo_plot_has_stems(const struct ceduo_option *option);

/* The axes of the frame in the user's coordinates, which begin at x, y: the left one, and the bottom one in `unit` (NULL: none). */
struct ceduo_frame ceduo_plot_given(const struct ceduo_frame *frame, double x, double y);
void ceduo_plot_axes(const struct ceduo_drawing *drawing, double x, double y, const char *unit);

/* The largest 1, 2 or 5 times a power of ten that is not above a value, or the least that is not below. */
double ceduo_plot_round(double value, bool up);

#endif
