/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POPUP_H
#define CEDUO_POPUP_H

#include <stdio.h>

#include "app.h"

enum popup_kind { POPUP_TEXT, POPUP_LIST, POPUP_FIELDS };

#define POPUP_FIELDS_MOST 12

struct popup_item {
    const char *text, *value;
};

/* An item was chosen; the popup is off the screen already, and freed after the call. */
typedef void popup_chosen(struct app *app, struct popup *popup, const char *value);

/* The fields were filled. False: app->message says what is wrong, and it stays open. */
typedef bool popup_filled(struct app *app, struct popup *popup);

struct popup {
    enum popup_kind kind;
    char title[128];
    struct arena arena;
    struct text text;         /* to read; over a list or fields: what it is about */
    struct popup_item *items; /* to choose from */
    size_t items_count, items_room;
    char labels[POPUP_FIELDS_MOST][40];
    struct line fields[POPUP_FIELDS_MOST]; /* to fill */
    size_t fields_count;
    size_t at;            /* the item or field under the cursor */
    int top;              /* the first line shown */
    struct ceduo_area box; /* where it was drawn */
    char message[256];
    char path[1024];      /* what a choice is for */
    char *kept;           /* a text that goes with it */
    popup_chosen *chosen;
    popup_chosen *preview; /* puts `text` anew whenever it is drawn, for the item under the cursor; NULL: it stays */
    popup_filled *filled;
};

/* Each opens a popup in place of any other. NULL, with a warning, if there is no memory. */
struct popup *ceduo_popup_text(struct app *app, const char *title);
struct popup *ceduo_popup_list(struct app *app, const char *title, popup_chosen *chosen);
struct popup *ceduo_popup_fields(struct app *app, const char *title, popup_filled *filled);
/* Both do nothing for NULL. */
void ceduo_popup_item(struct popup *popup, const char *text, const char *value);
void ceduo_popup_field(struct popup *popup, const char *label, const char *value);

/* Returns whether the file named in the first field may be written. For an existing file it asks for Enter once more. */
bool ceduo_popup_may_write(struct app *app, struct popup *popup);

/* ---- the one that is open ---- */

void ceduo_popup_draw(struct app *app);
const char *ceduo_popup_bar(const struct app *app); /* its keys */
void ceduo_popup_key(struct app *app, int key);
void ceduo_popup_close(struct app *app);

#endif
