/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOT_H
#define CEDUO_PLOT_H

#include "base/text.h"
#include "canvas.h"
#include "ceduo/years.h"
#include "study/seen.h"
#include "study/snapshot.h"
#include "study/verdict.h"

/* The pictures. Each one draws into a rectangle of a canvas and leaves the rest of it alone: what has no room is left out,
 * never squeezed. None has a title of its own; ceduo_plot_title() says what stands above it. */

/* The columns that show the slope and the metres at their edges (relative), so that pictures can stand above each other on one
 * axis. */
struct ceduo_span {
    int left, width;
    double x0, x1;
};

/* What a picture shows. */
struct ceduo_doubt_report;
struct ceduo_page;
struct ceduo_picture {
    const struct ceduo_scene *scene;       /* checked */
    const struct ceduo_snapshot *snapshot; /* NULL: nothing is computed yet */
    size_t option, belt, control;          /* indices; where there is none, the picture says so */
    const struct ceduo_polyline *selected; /* one rock's trajectory, shown before all others; NULL: none */
    const double *mark;                    /* a place along the slope that the profile marks, m, relative; NULL: none */
    double from, to;                       /* the stretch of slope shown, m, relative; from = to: all of it */
    const struct ceduo_stem_passed *stems; /* those that the selected rock came to, in its order; NULL: not known */
    size_t stems_count;
    const struct ceduo_years *years;     /* of the option; NULL: not computed */
    size_t year;                         /* index of the one under the cursor; beyond them all: none */
    const struct ceduo_verdict *verdict; /* of all options; NULL: not computed */
    struct ceduo_span *span; /* where the slope stands: a profile writes it, strips stand in it; NULL: the area's own */
    const struct ceduo_doubt_report *doubt; /* NULL: not computed */
    bool no_x_axis;                         /* of a strip that another one stands below */
    bool ways;                              /* in the strip of heights each trajectory, too */
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
    X(PROFILE, profile, CEDUO_PICTURE_OF_ROCKS, N_("slope, forest, and ways"))                                                 \
    X(ENERGY, energy, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_CELLS, N_("energy of the rocks"))                                 \
    X(HEIGHT, height, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_CELLS, N_("height of the rocks above the ground"))                \
    X(HISTOGRAM, histogram, CEDUO_PICTURE_OF_ROCKS | CEDUO_PICTURE_PAGE, N_("energy at %s"))                                   \
    X(ROTATION, rotation, CEDUO_PICTURE_RUN, N_("year by year, up to %s"))                                                     \
    X(STAND, stand, 0, N_("%s, from above"))                                                                                   \
    X(COMPARE, compare, CEDUO_PICTURE_OF_ALL | CEDUO_PICTURE_PAGE, N_("Options side by side, up to %s"))                       \
    X(TRADEOFF, tradeoff, CEDUO_PICTURE_OF_ALL, N_("Protection and yield of the options, up to %s"))                           \
    X(DOUBT, doubt, CEDUO_PICTURE_PAGE, N_("how sure it is at %s"))                                                            \
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
void ceduo_plot_seen(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_seen_stops *stops,
                     double origin);

/* One line that says what the picture shows. */
void ceduo_plot_title(struct text *text, enum ceduo_plot plot, const struct ceduo_picture *picture);

/* The colour and the sign of a light. */
enum ceduo_role ceduo_plot_light_role(enum ceduo_light light);
const char *ceduo_plot_light_mark(enum ceduo_light light);

#endif
