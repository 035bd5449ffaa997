/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POPUP_H
#define CEDUO_POPUP_H

#include <stdio.h>

#include "app.h"
#include "picker.h"

enum popup_kind { POPUP_TEXT, POPUP_LIST, POPUP_FIELDS };

#define POPUP_FIELDS_MAX 16

/* An item was chosen; the popup is off the screen already, and freed after the call. */
typedef void popup_chosen(struct app *app, struct popup *popup, const char *value);

/* The fields were filled. False: app->message says what is wrong, and it stays open. */
typedef bool popup_filled(struct app *app, struct popup *popup);

/* Adds to the picker what goes with the text that is typed into the line under the cursor. */
typedef void popup_offer(struct app *app, struct popup *popup, const char *typed);

struct popup {
    enum popup_kind kind;
    char title[128];
    struct arena arena;
    struct text text; /* to read; over a list or fields: what it is about */
    char labels[POPUP_FIELDS_MAX][40];
    struct line fields[POPUP_FIELDS_MAX];  /* to fill; of a list the first: what is searched for */
    popup_offer *offers[POPUP_FIELDS_MAX]; /* NULL: none; of a list: its items stay the same */
    size_t fields_count;
    size_t at;             /* the field under the cursor */
    struct picker picker;  /* of the list, or of the field under the cursor */
    const char *endings;   /* of files that may be typed: ".yaml"; NULL: none */
    bool asks;             /* a list of few answers: the first letter of each chooses it, nothing is searched for */
    bool ready;            /* what is offered was listed once */
    bool moved;            /* the cursor was moved in the picker */
    bool typed_wins;       /* a new name: what is typed stays, unless the cursor was moved in the picker */
    int top;               /* the first line shown of a text, or field */
    struct ceduo_area box; /* where it was drawn */
    char message[256];
    char path[1024]; /* what a choice is for */
    char *kept;      /* a text that goes with it */
    popup_chosen *chosen;
    popup_chosen *preview; /* puts `text` anew for the item under the cursor; NULL: it stays */
    char previewed[256];   /* the item that `text` is about */
    struct preview ahead;  /* what it would do to the lights, once that is computed */
    bool ahead_known;
    popup_filled *filled;
    void (*picture)(struct app *app, struct popup *popup, struct ceduo_area area); /* below fields, where nothing is offered */
    bool (*check)(struct app *app, struct popup *popup, size_t field); /* as a field is left; false: it is said why */
    void (*then)(struct app *app);                                     /* what goes on once unsaved work is saved or given up */
};

/* Each opens a popup in place of any other. */
struct popup *ceduo_popup_text(struct app *app, const char *title);
struct popup *ceduo_popup_list(struct app *app, const char *title, popup_chosen *chosen);
struct popup *ceduo_popup_fields(struct app *app, const char *title, popup_filled *filled);
void ceduo_popup_item(struct popup *popup, const char *text, const char *value);
/* An answer that a key gives, which stands before its words; all items of the list must be such. */
void ceduo_popup_answer(struct popup *popup, char key, const char *text, const char *value);
void ceduo_popup_field(struct popup *popup, const char *label, const char *value);
/* A field with a list of what may stand in it; what matches what is typed is taken. */
void ceduo_popup_choice(struct popup *popup, const char *label, const char *value, popup_offer *offer);

/* Reads a number that was typed into a field, with a dot or a comma; false where it is none, which is said. */
bool ceduo_popup_number(struct app *app, const struct popup *popup, size_t field, double *value);

/* Reads a value that was typed as its field is shown, which may be NULL, into the unit of the file; false where it is none or
 * out of range, which is said. */
bool ceduo_popup_value(struct app *app, const struct field *field, const char *typed, double *value);

/* Returns whether the file named in the first field may be written. For an existing file it asks for Enter once more. */
bool ceduo_popup_may_write(struct app *app, struct popup *popup);

/* ---- the one that is open ---- */

void ceduo_popup_draw(struct app *app);

/* After a key: the note over a list is about the item under the cursor. */
void ceduo_popup_look(struct app *app);
/* What that item would do to the lights is known. */
void ceduo_popup_previewed(struct app *app, const struct preview *preview);
const char *ceduo_popup_bar(const struct app *app); /* its keys */
void ceduo_popup_key(struct app *app, int key);
bool ceduo_popup_paste(struct app *app, const char *text); /* false: nothing is typed there */
void ceduo_popup_close(struct app *app);

#endif
