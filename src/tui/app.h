/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_APP_H
#define CEDUO_APP_H

#include "form.h"
#include "keys.h"
#include "model/document.h"
#include "model/live.h"
#include "picker.h"
#include "view/cells.h"
#include "view/pane.h"
#include "view/plot.h"
#include "view/report.h"

/* The terminal program without a terminal: its state and shared functions. Popups, editing, views, the screen and the
 * program build on it, in layers. The terminal shows the cells; a script dumps them. */

enum view_number {
#define V(NAME, name, key, word, help) VIEW_##NAME,
    VIEWS(V)
#undef V
        VIEW_COUNT
};

struct app;
struct popup; /* overlay: help, list or fields */

/* A key binding: a handler with an argument, or a plain handler. A table ends with an empty row. */
struct key_binding {
    enum action action;
    void (*handler)(struct app *app, int step);
    int step;
    void (*plain)(struct app *app);
};

/* A row of a table of bindings. */
#define KEY(NAME, ...)                                                                                                         \
    {                                                                                                                          \
        ACTION_##NAME, __VA_ARGS__                                                                                             \
    }

#define VIEW_PANES 4

/* A view: its content and its keys. */
struct view {
    int panes;                                         /* number of panes for Tab; the first is the form */
    bool uncertainty;                                  /* request uncertainty from the first visit on */
    bool observed;                                     /* compare with observations while the view is open */
    bool result;                                       /* draw nothing before the first result */
    size_t private_size;                               /* bytes of private state, see ceduo_app_private_state() */
    void (*build)(struct app *app, struct form *form); /* NULL: no form */
    void (*draw)(struct app *app, struct ceduo_area area);
    const struct key_binding *bindings[VIEW_PANES]; /* own bindings of each pane; NULL: none */
    void (*after_key)(struct app *app);             /* called after each key; may be NULL */
    struct {
        enum action action;
        const char *word;                                         /* label, marked for translation; NULL ends the list */
    } bar[8];                                                     /* own keys in the bar, by importance */
    bool (*is_listed)(const struct app *app, enum action action); /* false: not in the bar now; NULL: all are */
};

#define V(NAME, name, key, word, help) extern const struct view ceduo_view_##name;
VIEWS(V)
#undef V
extern const struct view *const ceduo_views[VIEW_COUNT];

/* State of a view. */
struct view_state {
    struct form form;
    int pane;
    struct viewport text; /* text longer than its pane */
    void *private_state;  /* zeroed when a document is opened */
};

/* A segment of a trajectory: a flight, or a roll along the ground. */
struct rock_segment {
    struct ceduo_trajectory_segment segment;
    size_t stems; /* number of stems met up to its end */
};

/* The trajectory of one rock, in segments. */
struct rock_trajectory {
    uint64_t key, rock;        /* key of the run, number of the rock */
    size_t n, capacity, shown; /* segments; number of segments shown, 0: all */
    struct rock_segment *segments;
    struct ceduo_stem_encounter *stems; /* stems met */
    size_t stems_count, stems_capacity;
    double start_time; /* s, start of the computation */
    bool cut_short;    /* stopped at the time limit */
    struct ceduo_trajectory whole;
    struct ceduo_polyline line; /* the part shown */
};

#define PICTURES_MAX 4
#define HITS_MAX     64

/* An area that reacts to the mouse, recorded while it is drawn. The last one under the pointer counts. */
struct hit {
    struct ceduo_area area;
    int key;                                         /* pressed by a click; K_NONE: `click` is called */
    void (*click)(struct app *app, int x, int line); /* column and line from the corner of the area; may be NULL */
    int first;                                       /* line of a list in the first row of the area */
    void (*wheel)(struct app *app, int lines);       /* may be NULL */
};

/* The last screen with up-to-date figures, and its subject. */
struct last_screen {
    struct ceduo_cells *cells; /* NULL: none */
    enum view_number view;
    size_t option, year;
};

#define TOUR_LINES 3 /* last lines of the screen, for the tour */

/* Position in the tour (tour.c). */
struct tour {
    const struct tour_step *step; /* NULL: no tour */
    const char *keys;             /* remaining keys of the step */
    const char *path;             /* scene to open at the end; NULL: the site of the paper */
    bool no_recovery;             /* value to restore at the end */
};

struct app {
    struct document document;
    struct arena *scratch; /* strings that live until the next key */
    struct live live;
    struct ceduo_cells *cells;
    struct last_screen last_screen;
    struct ceduo_area pictures[PICTURES_MAX]; /* areas of figures on the screen */
    size_t pictures_count;
    struct hit hits[HITS_MAX];
    size_t hits_count;
    bool drawn;        /* neither input nor results since the screen was drawn: the hits are up to date */
    int width, height; /* size of the program: the cells without the lines of a tour */
    enum ceduo_charset charset;
    int theme; /* 0 dark, 1 light, 2 none */
    enum view_number view;
    struct view_state views[VIEW_COUNT];
    size_t option, belt;               /* shown in the views */
    size_t year;                       /* index of the selected year */
    bool rotation_mean;                /* view 7: mean over the rotation instead of today */
    uint64_t rock;                     /* number of the rock shown */
    struct rock_trajectory trajectory; /* trajectory of `rock` */
    char message[512];                 /* message of the last action; shown until the next key */
    bool message_is_warning;
    char search[128];
    struct popup *popup;
    struct tour tour;
    bool plain;                          /* started without a scene, and no key was pressed outside a popup */
    bool just_opened;                    /* a document was just opened: offer abandoned work */
    bool no_recovery;                    /* for scripts: offer no unsaved work, keep no copy */
    bool uncertainty_on;                 /* compute uncertainty; in a script, from the first visit of view 7 on */
    void (*after_save)(struct app *app); /* continuation after saving; NULL: none */
    bool quit, redraw;                   /* redraw: repaint the whole terminal */
    bool (*copy)(const char *text);      /* copy to the clipboard; false: too long. NULL: no clipboard */
};

/* Open a scene; NULL: the site of the paper. False with the reason in app->document.problems. Always free the app. */
bool ceduo_app_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery);
void ceduo_app_free(struct app *app);

/* Open a file, or the text of a new scene, in place of this document. The caller has confirmed unsaved work. */
bool ceduo_app_open(struct app *app, const char *path, const char *text);

void ceduo_popup_close(struct app *app); /* close the open popup, if any (popup.c) */

/* Set the size of the cells. */
void ceduo_app_resize(struct app *app, int width, int height);

/* Return a string that lives until the next key. Return a path in words. */
char *ceduo_app_format(const struct app *app, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *ceduo_app_path(const struct app *app, const char *path);
const char *ceduo_app_scalar(const struct app *app, const char *text); /* as YAML */

void ceduo_app_show_problem(struct app *app, bool bad, const char *format, ...) __attribute__((format(printf, 3, 4)));
#define ceduo_app_show_message(app, ...) ceduo_app_show_problem(app, false, __VA_ARGS__)
#define ceduo_app_warn(app, ...)         ceduo_app_show_problem(app, true, __VA_ARGS__)

/* End an edit: update form and figures if it was good, otherwise show the reason. Return `good`. */
bool ceduo_app_finish_edit(struct app *app, bool good);

/* Set the text to search for in views and texts. */
void ceduo_app_set_search(struct app *app, const char *text);

/* Set a value, written as in a file, and remove conflicting values. */
bool ceduo_app_set(struct app *app, const char *path, const char *value);

/* ---- content of the views ---- */

void ceduo_app_show(struct app *app, enum view_number view);
void ceduo_app_show_option(struct app *app, size_t option);
void ceduo_app_show_belt(struct app *app, size_t belt);
void ceduo_app_sync_belt(struct app *app); /* show the belt under the cursor of the form */
void ceduo_app_refresh(struct app *app);   /* update form and figures after a change of the content */

struct view_state *ceduo_app_state(struct app *app); /* state of the open view */
struct form *ceduo_app_form(struct app *app);
void *ceduo_app_private_state(const struct app *app); /* private state of the open view */

/* Collect the results for a picture, a page (may have no result) or a pane of n lines. Pages and panes live until the next
 * key. */
struct ceduo_picture ceduo_app_picture(const struct app *app);
struct ceduo_report *ceduo_app_report(const struct app *app);
struct ceduo_pane ceduo_app_pane(const struct app *app, int height);

/* Get the uncertainty of the figures. Return false if it is not computed yet. Without inputs it has no answer. */
bool ceduo_app_uncertainty(const struct app *app, struct ceduo_uncertainty_report *report);

/* Return the option shown, the path of its forest, "options[2].forest", or of its stand. Paths live until the next key. */
const struct ceduo_option *ceduo_app_option(const struct app *app);
const struct ceduo_belt *ceduo_app_belt(const struct app *app); /* NULL: the option has none */
const char *ceduo_app_forest(const struct app *app);
const char *ceduo_app_stand(const struct app *app);

/* Return the arrivals of the right column, through the forest shown or by the index. NULL before the first rocks. */
const struct ceduo_arrivals *ceduo_app_arrivals(const struct app *app);

/* ---- the trajectory of a rock (rock_trajectory.c) ---- */

/* Compute the trajectory of the rock shown in the option shown, unless it is known. */
bool ceduo_app_trace_rock(struct app *app);

/* Show the trajectory of the rock n further on, or n segments more, and describe it. */
void ceduo_app_next_rock(struct app *app, int step);
void ceduo_app_step_rock(struct app *app, int step);

/* Return the number of stems on the part shown. */
size_t ceduo_rock_trajectory_stems(const struct rock_trajectory *trajectory);
void ceduo_rock_trajectory_free(struct rock_trajectory *trajectory);

/* ---- the field or the item under the cursor of the form (edit.c) ---- */

void ceduo_edit_start(struct app *app); /* open the field, as a line or as a list of choices */
void ceduo_edit_step(struct app *app, int direction);
void ceduo_items_add(struct app *app);
void ceduo_items_add_blocks(struct app *app); /* ask for a class of blocks, wherever the cursor is */
void ceduo_items_delete(struct app *app);
void ceduo_items_duplicate(struct app *app);
void ceduo_items_move(struct app *app, int step);
/* Split item `index` of a list at `x` along the slope (m, as in the file), or add a control there. */
void ceduo_items_add_at(struct app *app, const char *list, size_t index, double x);
/* Return the segment of the profile that holds x, both as in the file of the slope. */
size_t ceduo_items_find_segment(const struct app *app, double x_written);

/* ---- drawing ---- */

/* Draw the screen on app->cells (screen.c). */
void ceduo_screen_draw(struct app *app);
bool ceduo_screen_is_too_small(const struct app *app); /* true: only the needed size is drawn */

/* Draw the text of the tour below the screen, if one is played (tour.c). */
void ceduo_tour_draw(struct app *app);

/* Let the mouse act on an area that was drawn. */
void ceduo_app_add_hit(struct app *app, struct hit hit);

/* Return the number of a line, with marks of lines above or below; "" if all lines are visible. It lives until the next key. */
const char *ceduo_app_position(const struct app *app, const struct viewport *lines, int line);

/* Draw wrapped text in a rectangle, without the first `skip` lines. Return the number of lines; the second only counts. */
int ceduo_app_draw_wrapped(struct app *app, struct ceduo_area area, enum ceduo_role role, const char *text, int skip);
int ceduo_app_count_lines(struct app *app, const char *text, int width);

/* Return the line of a wrapped text that holds `place`, a pointer into the text. */
int ceduo_app_find_line(const char *text, int width, const char *place);

/* Shorten a text to n lines, with an ellipsis. */
void ceduo_app_shorten(struct app *app, struct text *text, int width, int lines);

/* Draw a text, shortened to its area, and free it. */
void ceduo_app_draw_text(struct app *app, struct ceduo_area area, enum ceduo_role role, struct text *text);
void ceduo_app_draw_label(struct app *app, int x, int y, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Explain the keys of a pane until the next message, unless a popup is open. */
void ceduo_app_show_hint(struct app *app, const char *text);

/* Draw a page as the text of the view, and free it. Its position stands in the line below. Scroll it by n lines. */
void ceduo_app_draw_page(struct app *app, struct ceduo_area area, struct ceduo_page *page);
void ceduo_app_scroll_text(struct app *app, int step);

/* Draw a picture of figures. It is dimmed while the figures are stale. */
void ceduo_app_draw_plot(struct app *app, enum ceduo_plot plot, struct ceduo_area area, const struct ceduo_picture *picture);

/* Draw the form of the open view below a line of its position; nothing without height. */
void ceduo_app_draw_form(struct app *app, struct ceduo_area area);

#endif
