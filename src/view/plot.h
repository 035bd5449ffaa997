/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOT_H
#define CEDUO_PLOT_H

#include "canvas.h"
#include "page.h"
#include "study/observed_stops.h"
#include "study/snapshot.h"
#include "words.h"

/* Pictures. Each draws inside its rectangle of a canvas. Parts that do not fit are dropped. No picture draws its title, see
 * ceduo_plot_title(). */

/* Columns of the slope and metres at their edges (relative), shared by pictures that are stacked on one axis. */
struct ceduo_span {
    int left, width;
    double x0, x1;
};

/* Input of a picture. */
struct ceduo_uncertainty_report;
struct ceduo_picture {
    const struct ceduo_scene *scene;          /* checked */
    const struct ceduo_snapshot *snapshot;    /* NULL: not computed yet */
    size_t option, belt, control;             /* indices; out of range: the picture reports it */
    const struct ceduo_polyline *selected;    /* trajectory of the selected rock, drawn on top; may be NULL */
    bool mark_belt;                           /* mark the belt in the profile */
    const double *mark;                       /* position to mark in the profile, m, relative; may be NULL */
    double from, to;                          /* part of the slope to show, m, relative; from == to: all */
    const struct ceduo_stem_encounter *stems; /* encountered by the selected rock, in its order; NULL: unknown */
    size_t stems_count;
    const struct ceduo_years *years;     /* years of the option; NULL: not computed */
    size_t year;                         /* index of the year under the cursor; out of range: none */
    const struct ceduo_verdict *verdict; /* verdict on all options; NULL: not computed */
    struct ceduo_span *span; /* columns of the slope: set by profile and rotation, used by strips; NULL: from the area */
    const struct ceduo_uncertainty_report *uncertainty; /* NULL: not computed */
    bool no_legend;                                     /* the options' names and numbers stand elsewhere */
    bool bands;                                         /* strips shade what the forest lets through: mean to p95, p50 to p95 */
    bool no_x_axis;                                     /* another picture of the slope is below */
    bool trajectories;                                  /* the strip of heights shows each trajectory, too */
    bool paper; /* for a printed page: as wide as the area, with the angles of the control and the limit, in plain words */
    const size_t *compared;                      /* option whose values set the scales, too; NULL: none */
    struct ceduo_years *const *years_of_options; /* one per option; NULL, or an element NULL: not computed */
};

/* The pictures: name, word, flags, title (%s: the control or the belt).
 * profile: slope, density of trajectories, the option's belts, release and controls. Belts show rows of stems at their mean
 * distance, or the stems that the selected rock encountered. True to scale; heights are scaled, and the factor is written,
 * if most of the area would be empty.
 * energy, height: strips along the slope, of rocks that pass, with and without forest. Curves are p50 and p95 of the height,
 * mean and p95 of the energy; in small areas only p95 of the height and the mean energy. With the contact model index,
 * without forest: p50, p95 and max; mean, p5, p50 and p95. Curves are named on the right if there is space.
 * histogram: distribution of energies at the control, with forest (bars) and without (marks). With the contact model index
 * without forest only.
 * The files of the other pictures describe them. */
#define CEDUO_PLOT_LIST(X)                                                                                                     \
    X(PROFILE, profile, CEDUO_PICTURE_ROCKS_RUN, N_("slope, forest, and trajectories"))                                        \
    X(ENERGY, energy, CEDUO_PICTURE_ROCKS_RUN | CEDUO_PICTURE_CELLS, N_("energy of the rocks"))                                \
    X(HEIGHT, height, CEDUO_PICTURE_ROCKS_RUN | CEDUO_PICTURE_CELLS, N_("height of the rocks above the ground"))               \
    X(HISTOGRAM, histogram, CEDUO_PICTURE_ROCKS_RUN | CEDUO_PICTURE_PAGE, N_("energy at %s"))                                  \
    X(ROTATION, rotation, CEDUO_PICTURE_YEARS_RUN, N_("year by year, up to %s"))                                               \
    X(YEARS, years, CEDUO_PICTURE_ALL_OPTIONS | CEDUO_PICTURE_YEARS_RUN, N_("Over the years, up to %s"))                       \
    X(STAND, stand, 0, N_("%s, from above"))                                                                                   \
    X(COMPARE, compare, CEDUO_PICTURE_ALL_OPTIONS_RUN | CEDUO_PICTURE_PAGE, N_("Options side by side, up to %s"))              \
    X(AHEAD, ahead, CEDUO_PICTURE_ALL_OPTIONS | CEDUO_PICTURE_YEARS_RUN, N_("Options over the years ahead, up to %s"))         \
    X(TRADEOFF, tradeoff, CEDUO_PICTURE_ALL_OPTIONS | CEDUO_PICTURE_YEARS_RUN,                                                 \
      N_("Protection and yield of the options, up to %s"))                                                                     \
    X(UNCERTAINTY, uncertainty, CEDUO_PICTURE_PAGE, N_("how sure it is at %s"))                                                \
    X(HAZARD, hazard, CEDUO_PICTURE_ALL_OPTIONS_RUN, N_("How often, and with how much, at %s"))                                \
    X(FENCE, fence, CEDUO_PICTURE_ALL_OPTIONS_RUN, N_("Which class of fence is enough at %s"))

enum ceduo_picture_flag {
    CEDUO_PICTURE_RUN = 1 << 0,         /* requires a run */
    CEDUO_PICTURE_CELLS = 1 << 1,       /* requires envelopes */
    CEDUO_PICTURE_ALL_OPTIONS = 1 << 2, /* one picture for all options */
    CEDUO_PICTURE_ALL_OPTIONS_RUN = CEDUO_PICTURE_ALL_OPTIONS | CEDUO_PICTURE_RUN,
    CEDUO_PICTURE_ROCKS = 1 << 3, /* shows rocks; without forest if none is simulated through it */
    CEDUO_PICTURE_ROCKS_RUN = CEDUO_PICTURE_ROCKS | CEDUO_PICTURE_RUN,
    CEDUO_PICTURE_PAGE = 1 << 4,  /* rows of text and bars */
    CEDUO_PICTURE_YEARS = 1 << 5, /* requires the years of the options */
    CEDUO_PICTURE_YEARS_RUN = CEDUO_PICTURE_YEARS | CEDUO_PICTURE_RUN
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

extern const struct ceduo_plot_kind ceduo_plot_kinds[CEDUO_PLOTS]; /* the entry of CEDUO_PLOT_NONE is empty */

/* Return the picture of that name; CEDUO_PLOT_NONE if there is none. */
enum ceduo_plot ceduo_plot_find(const char *name);

/* "profile, energy, …": all names. */
extern const char *const ceduo_plot_names;

/* Append a page-like picture as blocks, of about `height` lines, or the reason for its absence. */
bool ceduo_plot_add(enum ceduo_plot plot, struct ceduo_page *page, const struct ceduo_picture *picture, int height);

/* Draw a picture, or in the middle of the area the reason for its absence. */
void ceduo_plot_draw(enum ceduo_plot plot, struct ceduo_canvas *canvas, const struct ceduo_area *area,
                     const struct ceduo_picture *picture);

/* Draw observed stops next to simulated ones; requires no run. `origin`: x of the slope's start in the user's coordinates. */
void ceduo_plot_observed(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_observed_stops *stops,
                         double origin);

/* Return the rows of small pictures of the years in a wide area. */
int ceduo_plot_years_down(size_t options);

/* Append one line that describes the picture. */
void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *picture);

/* Colour and sign of a light. */
enum ceduo_role ceduo_plot_light_role(enum ceduo_light light);
const char *ceduo_plot_light_mark(enum ceduo_light light);

/* ---- shared by the pictures ---- */

/* A picture in progress, with the objects of its indices (NULL: none). `run` is that of the option (through the forest; bare
 * with the contact model index), `bare` without forest; NULL: unknown. */
struct ceduo_drawing {
    struct ceduo_canvas *canvas; /* NULL for a page */
    struct ceduo_area area;
    struct ceduo_page *page;  /* target of the picture's blocks … */
    int height;               /* … with about n lines */
    struct ceduo_frame frame; /* set by the picture */
    struct ceduo_area legend; /* legend of a chart; height 0 if it does not fit */
    const struct ceduo_picture *picture;
    const struct ceduo_scene *scene;
    const struct ceduo_option *option;
    const struct ceduo_belt *belt;
    const struct ceduo_control *control;
    const struct ceduo_run_snapshot *run, *bare;
    const struct ceduo_arrivals *arrivals, *bare_arrivals; /* at the control */
    bool wooded;     /* rocks are simulated through the forest; false with the contact model index */
    double from, to; /* part of the slope to show */
};

/* Draw; return NULL, or the reason why there is nothing to draw. */
typedef const char *ceduo_plot_function(struct ceduo_drawing *drawing);
#define X(NAME, name, flags, title) ceduo_plot_function ceduo_plot_##name;
CEDUO_PLOT_LIST(X)
#undef X

/* Return the judged share of a year at a control, in rocks of 1000 released; NaN: not simulated. */
double ceduo_plot_year_share(const struct ceduo_year *year, size_t control);

/* Return the arrivals of a run at a control; NULL if unknown. */
const struct ceduo_arrivals *ceduo_plot_arrivals(const struct ceduo_run_snapshot *run, size_t control);

/* Append a cell with the sign of a light. */
void ceduo_page_light(struct ceduo_page *page, enum ceduo_light light);

/* Draw a text of at most `max` cells, starting at `column`; if `max` < 0, ending there. Return its cells. */
int ceduo_plot_print(struct ceduo_canvas *canvas, int column, int row, int max, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

/* Append the name of a stand, with a star if any of its values is assumed. */
void ceduo_plot_belt_name(struct text *text, const struct ceduo_belt *belt);

/* True if any stem stands in the option's belts. */
bool ceduo_plot_has_stems(const struct ceduo_option *option);

/* Draw the axes in the user's coordinates, which begin at x, y: left, and bottom with `unit` (may be NULL). */
struct ceduo_frame ceduo_plot_user_frame(const struct ceduo_frame *frame, double x, double y);
void ceduo_plot_axes(const struct ceduo_drawing *drawing, double x, double y, const char *unit);

/* Return 1, 2 or 5 times a power of ten: the largest <= value, or if `up` the smallest >= value. */
double ceduo_plot_round(double value, bool up);

#endif
