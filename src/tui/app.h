/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_APP_H
#define CEDUO_APP_H

#include "form.h"
#include "keys.h"
#include "model/document.h"
#include "model/worker.h"
#include "steps.h"
#include "view/canvas.h"
#include "study/outlook.h"
#include "view/plot.h"
#include "view/report.h"

/* The terminal program without a terminal: keys and sizes go in, a canvas of cells comes out. The terminal shows it, a
 * script dumps it. */

enum view_number { VIEW_SLOPE, VIEW_STAND, VIEW_ROCK, VIEW_RESULTS, VIEW_COMPARE, VIEW_ROTATION, VIEWS };

#define APP_WIDTH_LEAST 60
#define APP_HEIGHT_LEAST 20

struct app;

/* A view: data and a few functions. A new one is one file and one line in the table of app.c. */
struct app_view {
    const char *name; /* marked for translation */
    int panes;        /* that Tab goes through; the first is the form */
    void (*build)(struct app *app, struct form *form);
    void (*draw)(struct app *app, struct ceduo_area area);
    bool (*act)(struct app *app, enum action action); /* true: done; NULL: none of its own */
    void (*follow)(struct app *app);                  /* after each key; NULL: nothing */
};

/* A line that is typed: a value, a file name, something to search. */
struct line {
    char text[1024];
    size_t at;  /* byte of the cursor */
    bool fresh; /* nothing typed yet: the first character replaces it all */
};

struct popup; /* what lies over the views: help, lists, questions */

struct app {
    struct document document;
    struct worker *worker;
    struct ceduo_outlook *outlook;   /* newest; NULL before the first */
    struct ceduo_result *result;     /* the scene as it is now, by the newest outlook; NULL before the first */
    uint64_t outlook_key;            /* of the run that was asked for last */
    uint64_t shown_key;              /* of the one that is shown */
    struct ceduo_years *years;       /* to come, of option `years_option`; NULL: not computed */
    size_t years_option, year;       /* year: index of the one under the cursor */
    bool busy;
    double seconds;                  /* from the edit to the newest figures */
    struct ceduo_canvas *canvas;
    int width, height;
    enum ceduo_charset charset;
    int theme;                       /* 0 dark, 1 light, 2 none */
    enum view_number view;
    struct form forms[VIEWS];
    struct ceduo_area form_area;      /* where the form was drawn, for the mouse */
    int pane;
    size_t option, belt;             /* that the views show */
    uint64_t rock;                   /* whose way is shown */
    struct steps steps;              /* that way */
    int scroll;                      /* of text that is longer than its pane */
    bool editing;
    struct line line;                /* what is typed into the field */
    char message[512];               /* of the last action; shown until the next key */
    bool message_bad;
    char search[128];
    struct popup *popup;
    bool no_recovery;                /* a script: nothing is offered, no copy is kept */
    bool quit_once_saved;
    bool quit, redraw;               /* redraw: the terminal is to be painted anew */
    bool stopped;                    /* out of memory: cannot go on */
};

/* Opens a scene, or the shipped site of the paper where `path` is NULL. False with the reason in `problems`. */
bool ceduo_app_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads,
                      bool no_recovery, struct problems *problems);
void ceduo_app_free(struct app *app);

void ceduo_app_resize(struct app *app, int width, int height);
void ceduo_app_key(struct app *app, int key);
void ceduo_app_click(struct app *app, int x, int y);
void ceduo_app_wheel(struct app *app, int lines);

/* Takes the worker's news. True where the screen has changed. */
bool ceduo_app_news(struct app *app);

/* Draws everything on app->canvas. */
void ceduo_app_draw(struct app *app);

/* ---- for the views ---- */

void ceduo_app_say(struct app *app, const char *format, ...) __attribute__((format(printf, 2, 3)));
void ceduo_app_warn(struct app *app, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What a picture shows of the scene as it is now. */
struct ceduo_picture ceduo_app_picture(const struct app *app);

/* After an edit: good: forms and figures follow; otherwise the reason is shown. Frees the problems. */
bool ceduo_app_edited(struct app *app, bool good, struct problems *problems);

/* Sets a value (as it stands in a file), and takes out what would then be said twice. */
bool ceduo_app_set(struct app *app, const char *path, const char *value);

/* The path of the forest of the option shown: "forest" or "options[2].forest". */
void ceduo_app_forest(const struct app *app, char *path, size_t size);
const struct ceduo_option *ceduo_app_option(const struct app *app);
const struct ceduo_option_result *ceduo_app_found(const struct app *app);

/* What arrives at the last control in the column on the right: through the wood of the option shown, by the index on the
 * bare slope; NULL before the first rocks. */
const struct ceduo_arrivals *ceduo_app_shown(const struct app *app);

/* The cursor on a belt of the form shows that belt. */
void ceduo_app_follow_belt(struct app *app);

/* Follows the way of a rock through the forest of the option shown, unless it is that way already. */
bool ceduo_app_follow(struct app *app, uint64_t rock);

/* Shows the way of another rock, or `by` pieces more of it, and says what happens there. */
void ceduo_app_show_rock(struct app *app, uint64_t rock);
void ceduo_app_step_rock(struct app *app, int by);

/* Text in a rectangle, wrapped, from line `skip` on; returns the lines there are. */
int ceduo_app_text(struct app *app, struct ceduo_area area, enum ceduo_role role, const char *text, int skip);
void ceduo_app_label(struct app *app, int x, int y, enum ceduo_role role, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

extern const struct app_view ceduo_view_slope, ceduo_view_stand, ceduo_view_rock, ceduo_view_results,
    ceduo_view_compare, ceduo_view_rotation;
extern const struct app_view *const ceduo_views[VIEWS];

/* ---- popups (popup.c) ---- */

/* Each opens one over the views. */
void ceduo_popup_help(struct app *app);
void ceduo_popup_presets(struct app *app, bool new_option);
void ceduo_popup_choices(struct app *app, const struct form_cell *cell);
void ceduo_popup_open(struct app *app);
void ceduo_popup_new(struct app *app);
void ceduo_popup_save_as(struct app *app, const char *why); /* why the last attempt failed; NULL: none did */
void ceduo_popup_export(struct app *app);
void ceduo_popup_search(struct app *app);
void ceduo_popup_find(struct app *app);
void ceduo_popup_counts(struct app *app);
void ceduo_popup_quit(struct app *app);
/* Both strings are taken; `without_file`: it is a scene that was never saved, to be opened in place of this one. */
void ceduo_popup_recover(struct app *app, char *text, char *file, bool without_file);
void ceduo_popup_changed_on_disk(struct app *app);
void ceduo_popup_rename(struct app *app);

void ceduo_popup_draw(struct app *app);
const char *ceduo_popup_bar(const struct app *app); /* its keys */
void ceduo_popup_key(struct app *app, int key);
void ceduo_popup_close(struct app *app);

/* Opens another document in place of this one; it must be saved or given up before. */
bool ceduo_app_open(struct app *app, const char *path);
bool ceduo_app_open_text(struct app *app, const char *text);
void ceduo_app_save(struct app *app);
/* Writes where the scene came from; where that fails another name is asked for. */
void ceduo_app_write(struct app *app);
bool ceduo_app_save_to(struct app *app, const char *path); /* false: with errno set, and said */

/* A line that is typed: handles a key; false where the key means nothing to it. */
bool ceduo_line_key(struct line *line, int key);
void ceduo_line_set(struct line *line, const char *text);

#endif
