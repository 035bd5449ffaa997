/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOT_H
#define CEDUO_PLOT_H

#include "canvas.h"
#include "page.h"
#include "study/seen.h"
#include "study/snapshot.h"
#include "words.h"

/* The pictures. Each one draws into a rectangle of a canvas and leaves the rest of it alone: what has no room is left out,
 * never squeezed. None has a title of its own; ceduo_plot_title() says what stands above it. */

/* The columns that show the slope and the metres at their edges (relative), so that pictures can stand above each other on one
 * axis. */
struct ceduo_span {
    int left, width;
    double x0, x1;
};

/* What a picture shows. */
struct ceduo_uncertainty_report;
struct ceduo_picture {
    const struct ceduo_scene *scene;          /* checked */
    const struct ceduo_snapshot *snapshot;    /* NULL: nothing is computed yet */
    size_t option, belt, control;             /* indices; where there is none, the picture says so */
    const struct ceduo_polyline *selected;    /* one rock's trajectory, shown before all others; NULL: none */
    const double *mark;                       /* a place along the slope that the profile marks, m, relative; NULL: none */
    double from, to;                          /* the stretch of slope shown, m, relative; from = to: all of it */
    const struct ceduo_stem_encounter *stems; /* those that the selected rock came to, in its order; NULL: not known */
    size_t stems_count;
    const struct ceduo_years *years;     /* of the option; NULL: not computed */
    size_t year;                         /* index of the one under the cursor; beyond them all: none */
    const struct ceduo_verdict *verdict; /* of all options; NULL: not computed */
    struct ceduo_span *span; /* where the slope stands: a profile writes it, strips stand in it; NULL: the area's own */
    const struct ceduo_uncertainty_report *uncertainty; /* NULL: not computed */
    bool no_x_axis;                                     /* of a strip that another one stands below */
    bool ways;                                          /* in the strip of heights each trajectory, too */
};

/* The pictures: name, word, CEDUO_PICTURE_… of it, title (%s: where, or which belt).
 *
 * profile: the slope with rocks' trajectories as density, the option's belts, release and controls. In the belts stand
 *   rows of stems at their mean distance, or if known those that the selected rock came to. True to scale; where
 *   that would leave most of the area empty, heights are stretched or pressed, and the factor is written.
 * energy, height: strips along the slope, of the rocks that pass, the height above the ground (p50, p95) and the energy
 *   (mean, p95), through the forest and without; where there is little room p95 of the height, the mean of the energy.
 *   With the contact model index without forest: p50, p95 and max; mean, p5, p50 and p95. The names of the curves stand
 *   to the right, where the area has room.
 * histogram: how the energies of the rocks that reach the control are spread, through the forest (bars) and without
 *   (marks); with the contact model index without forest alone.
 * The files of the others say what they show. */
#define CEDUO_PLOT_LIST(X)                                                                                                     \
    X(PROFILE, profile, CEDUO_PICTURE_OF_ROCKS, N_("slope, forest, and trajectories"))                                                 \
    X(ENERGY, energy, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_CELLS, N_("energy of the rocks"))                                 \
    X(HEIGHT, height, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_CELLS, N_("height of the rocks above the ground"))                \
    X(HISTOGRAM, histogram, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_PAGE, N_("energy at %s"))                                   \
    X(ROTATION, rotation, CEDUO_PICTURE_RUN, N_("year by year, up to %s"))                                                     \
    X(STAND, stand, 0, N_("%s, from above"))                                                                                   \
    X(COMPARE, compare, CEDUO_PICTURE_OF_ALL | CEDUO_PICTURE_PAGE, N_("Options side by side, up to %s"))                       \
    X(TRADEOFF, tradeoff, CEDUO_PICTURE_OF_ALL, N_("Protection and yield of the options, up to %s"))                           \
    X(UNCERTAINTY, uncertainty, CEDUO_PICTURE_PAGE, N_("how sure it is at %s"))                                                \
    X(HAZARD, hazard, CEDUO_PICTURE_OF_ALL, N_("How often, and with how much, at %s"))

enum ceduo_picture_flag {
    CEDUO_PICTURE_RUN = 1 << 0,   /* needs one */
    CEDUO_PICTURE_CELLS = 1 << 1, /* needs envelopes of it */
    CEDUO_PICTURE_WHOLE = 1 << 2, /* of all options at once: there is one, not one for each */
    CEDUO_PICTURE_OF_ALL = CEDUO_PICTURE_WHOLE | CEDUO_PICTURE_RUN,
    CEDUO_PICTURE_WAYS = 1 << 3, /* of rocks, without forest where none go through one */
    CEDUO_PICTURE_OF_ROCKS = CEDUO_PICTURE_WAYS | CEDUO_PICTURE_RUN,
    CEDUO_PICTURE_PAGE = 1 << 4 /* rows of words and bars */
};

enum ceduo_plot {
    CEDUO_PLOT_NONE,
#define X(NAME, name, flags, title) CEDUO_PLOT_##NAME,
    CEDUO_PLOT_LIST(X)
#undef X
        CEDUO_PLOTS
};

struct ceduo_plot_kind {
    const char *name, *title;
    unsigned flags;
};

extern const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS]; /* that of CEDUO_PLOT_NONE is empty */

/* CEDUO_PLOT_NONE for a word that names none. */
enum ceduo_plot ceduo_plot_find(const char *name);

/* "profile, energy, …": all names. */
extern const char *const ceduo_plot_names;

/* Adds a picture that is a page as blocks, of about `height` lines, among others, or the reason why there is none. */
bool ceduo_plot_add(enum ceduo_plot plot, struct ceduo_page *page, const struct ceduo_picture *picture, int height);

/* Draws a picture, or says in the middle of the area why there is none. */
void ceduo_plot_draw(enum ceduo_plot plot, struct ceduo_canvas *canvas, const struct ceduo_area *area,
                     const struct ceduo_picture *picture);

/* Stops beside simulated ones, not among the pictures above as it needs no run; `origin`: where the slope begins in the user's
 * coordinates. */
void ceduo_plot_observed(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_observed_stops *stops,
                         double origin);

/* One line that says what the picture shows. */
void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *picture);

/* The colour and the sign of a light. */
enum ceduo_role ceduo_plot_light_role(enum ceduo_light light);
const char *ceduo_plot_light_mark(enum ceduo_light light);

/* ---- what the pictures share ---- */

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
