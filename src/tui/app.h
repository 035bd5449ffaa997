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

/* The terminal program without a terminal: its state, and the calls that all its parts share. Popups, editing, views, the screen
 * and the program stand on it, in layers. The terminal shows the cells; a script dumps them. */

enum view_number {
#define V(NAME, name, key, word, help) VIEW_##NAME,
    VIEWS(V)
#undef V
        VIEW_COUNT
};

struct app;
struct popup; /* what lies over the views: help, lists, questions */

/* What an action does: a function with a number, or one without; a table of them ends with neither. */
struct act {
    enum action action;
    void (*function)(struct app *app, int by);
    int by;
    void (*plain)(struct app *app);
};

/* A row of a table of keys. */
#define KEY(NAME, ...)                                                                                                         \
    {                                                                                                                          \
        ACTION_##NAME, __VA_ARGS__                                                                                             \
    }

#define VIEW_PANES 3

/* Describes a view: what it shows and how it handles keys. */
struct view {
    int panes;                                         /* that Tab goes through; the first is the form */
    bool uncertainty;                                  /* compute it from here on, whatever view is open */
    bool observed;                                     /* compare with what was observed while it is open */
    bool result;                                       /* it shows nothing before the first result */
    size_t own;                                        /* bytes of its own state, see ceduo_app_own() */
    void (*build)(struct app *app, struct form *form); /* NULL: it has no form */
    void (*draw)(struct app *app, struct ceduo_area area);
    const struct act *acts[VIEW_PANES]; /* its own keys in each pane; NULL: none */
    void (*follow)(struct app *app);    /* after each key; NULL: nothing */
    struct {
        enum action action;
        const char *word; /* what it does there, marked for translation; NULL ends them */
    } bar[8];             /* its own keys, the most needed first */
};

#define V(NAME, name, key, word, help) extern const struct view ceduo_view_##name;
VIEWS(V)
#undef V
extern const struct view *const ceduo_views[VIEW_COUNT];

/* The state of a view. */
struct view_state {
    struct form form;
    int pane;
    struct viewport text; /* that is longer than its pane */
    void *own;            /* zeroed as a document is opened */
};

/* A piece of a trajectory: a flight, or a roll along the ground. */
struct rock_piece {
    struct ceduo_trajectory_segment piece;
    size_t stems; /* that it has come to, up to its end */
};

/* The trajectory of one rock, piece by piece. */
struct rock_trajectory {
    uint64_t key, rock; /* of the run and the rock that they were followed for */
    size_t n, room, at; /* pieces; how many of them are shown, 0: all */
    struct rock_piece *pieces;
    struct ceduo_stem_encounter *stems; /* that it comes to */
    size_t stems_count, stems_room;
    double begun;   /* s: when the following began */
    bool cut_short; /* it took too long to be followed to its end */
    struct ceduo_trajectory whole;
    struct ceduo_polyline line; /* what is shown of it */
};

#define PICTURES_MAX 3

/* The last screen whose figures were those of its scene, and what it was of. */
struct kept {
    struct ceduo_cells *cells; /* NULL: none */
    enum view_number view;
    size_t option, year;
};

struct app {
    struct document document;
    struct arena *scratch; /* strings until the next key */
    struct live live;
    struct ceduo_cells *cells;
    struct kept kept;
    struct ceduo_area pictures[PICTURES_MAX]; /* of figures, on the screen */
    size_t pictures_count;
    int width, height;
    enum ceduo_charset charset;
    int theme; /* 0 dark, 1 light, 2 none */
    enum view_number view;
    struct view_state views[VIEW_COUNT];
    size_t option, belt;               /* that the views show */
    size_t year;                       /* index of the one under the cursor */
    bool over;                         /* view 7: the mean over the rotation, not today */
    uint64_t rock;                     /* whose trajectory is shown */
    struct rock_trajectory trajectory; /* that trajectory */
    char message[512];                 /* of the last action; shown until the next key */
    bool message_bad;
    char search[128];
    struct popup *popup;
    bool opened;                         /* a document was just opened: offer unsaved work that was left behind */
    bool no_recovery;                    /* for a script: offer no unsaved work and keep no copy */
    bool uncertainties;                  /* compute the uncertainty behind the figures; a script does so once it was shown */
    void (*once_saved)(struct app *app); /* what goes on once the scene is saved; NULL: nothing */
    bool quit, redraw;                   /* redraw: paint the whole terminal again */
    bool (*copy)(const char *text);      /* to the terminal's clipboard; false: it is too long. NULL: there is none */
};

/* Open a scene; NULL: the site of the paper. False with the reason in app->document.problems; free it in any case. */
bool ceduo_app_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery);
void ceduo_app_free(struct app *app);

/* Open a file, or the text of a new scene, instead of this document, which must be saved or given up before. */
bool ceduo_app_open(struct app *app, const char *path, const char *text);

void ceduo_popup_close(struct app *app); /* the one that is open, if there is any (popup.c) */

void ceduo_app_resize(struct app *app, int width, int height);

/* A string that lives until the next key; a path in words, likewise. */
char *ceduo_app_format(const struct app *app, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *ceduo_app_path(const struct app *app, const char *path);
const char *ceduo_app_scalar(const struct app *app, const char *text); /* as YAML */

void ceduo_app_show_problem(struct app *app, bool bad, const char *format, ...) __attribute__((format(printf, 3, 4)));
#define ceduo_app_show_message(app, ...) ceduo_app_show_problem(app, false, __VA_ARGS__)
#define ceduo_app_warn(app, ...)         ceduo_app_show_problem(app, true, __VA_ARGS__)

/* End an edit: update form and figures if it was good, otherwise show why it was refused. Returns `good`. */
bool ceduo_app_edited(struct app *app, bool good);

/* Set a value, written as in a file, and remove what would then be given twice. */
bool ceduo_app_set(struct app *app, const char *path, const char *value);

/* ---- what is shown ---- */

void ceduo_app_show(struct app *app, enum view_number view);
void ceduo_app_show_option(struct app *app, size_t option);
void ceduo_app_show_belt(struct app *app, size_t belt);
void ceduo_app_follow_belt(struct app *app); /* show the belt under the cursor of the form */
void ceduo_app_refresh(struct app *app);     /* update form and figures after a change of what is shown */

struct view_state *ceduo_app_state(struct app *app); /* of the view that is open */
struct form *ceduo_app_form(struct app *app);
void *ceduo_app_own(const struct app *app); /* the own state of the view that is open */

/* All that is known of the scene as it is now: for a picture; for pages, where the result may be missing; for a pane of n lines.
 * Pages and panes live until the next key. */
struct ceduo_picture ceduo_app_picture(const struct app *app);
struct ceduo_report *ceduo_app_report(const struct app *app);
struct ceduo_pane ceduo_app_pane(const struct app *app, int height);

/* The uncertainty of the figures; false if it is not known yet. Without inputs it has no answer. */
bool ceduo_app_uncertainty(const struct app *app, struct ceduo_uncertainty_report *report);

/* The option shown; path of its forest, "options[2].forest", and of the stand of the belt shown, until the next key. */
const struct ceduo_option *ceduo_app_option(const struct app *app);
const struct ceduo_belt *ceduo_app_belt(const struct app *app); /* NULL: the option has none */
const char *ceduo_app_forest(const struct app *app);
const char *ceduo_app_stand(const struct app *app);

/* Arrivals of the column on the right: through the forest of the option shown, or by the index. NULL before the first rocks. */
const struct ceduo_arrivals *ceduo_app_shown(const struct app *app);

/* ---- the trajectory of a rock (rock_trajectory.c) ---- */

/* Follow the rock shown through the forest of the option shown, unless its trajectory is known. */
bool ceduo_app_follow_rock(struct app *app);

/* Show the trajectory of the rock `by` further, or `by` pieces more of it, and say what happens there. */
void ceduo_app_next_rock(struct app *app, int by);
void ceduo_app_step_rock(struct app *app, int by);

/* Number of stems on the part that is shown. */
size_t ceduo_rock_trajectory_stems(const struct rock_trajectory *trajectory);
void ceduo_rock_trajectory_free(struct rock_trajectory *trajectory);

/* ---- the field or the item under the cursor of the form (edit.c) ---- */

void ceduo_edit_start(struct app *app); /* opens the field, as a line or with the list of its choices */
void ceduo_edit_step(struct app *app, int direction);
void ceduo_items_add(struct app *app);
void ceduo_items_add_blocks(struct app *app); /* asks for a class of blocks, wherever the cursor is */
void ceduo_items_delete(struct app *app);
void ceduo_items_duplicate(struct app *app);
void ceduo_items_move(struct app *app, int by);
/* Split item `index` of a list `at` a place along the slope, m as given, or add a control there. */
void ceduo_items_add_at(struct app *app, const char *list, size_t index, double at);
/* The stretch between points of the profile that holds x, both as the file of the slope has them. */
size_t ceduo_items_stretch_of(const struct app *app, double x_written);

/* ---- drawing ---- */

/* Draw everything on app->cells (screen.c). */
void ceduo_screen_draw(struct app *app);

/* The view whose title stands in this column of the top row; VIEW_COUNT: none. */
enum view_number ceduo_screen_view_at(const struct app *app, int column);

/* Draw wrapped text in a rectangle, without its first `skip` lines. Returns the number of its lines; the second draws nothing. */
int ceduo_app_text(struct app *app, struct ceduo_area area, enum ceduo_role role, const char *text, int skip);
int ceduo_app_text_lines(struct app *app, const char *text, int width);

/* Cut a text to n lines; what is too long ends in a sign of more. */
void ceduo_app_shorten(struct app *app, struct text *text, int width, int lines);

/* Draw a text, cut to its area, and free it. */
void ceduo_app_set_cursor(struct app *app, struct ceduo_area area, enum ceduo_role role, struct text *text);
void ceduo_app_label(struct app *app, int x, int y, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Explain the keys of a pane until something else is said; not below a popup. */
void ceduo_app_hint(struct app *app, const char *text);

/* Draw a page as the text of the view, and free it; a mark stands to the right if more follows below. Scroll it by n lines. */
void ceduo_app_page(struct app *app, struct ceduo_area area, struct ceduo_page *page);
void ceduo_app_continue_form(struct app *app, int by);

/* Draw a picture of figures, which is dimmed while these are those of an earlier scene. */
void ceduo_app_plot(struct app *app, enum ceduo_plot plot, struct ceduo_area area, const struct ceduo_picture *picture);

/* Draw the form of the view that is open; nothing in an area without height. */
void ceduo_app_draw_form(struct app *app, struct ceduo_area area);

#endif
