/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POPUPS_H
#define CEDUO_POPUPS_H

#include "app.h"

/* The popups that there are. Each call opens one, or says why it does not. */

void ceduo_popup_help(struct app *app);
void ceduo_popup_presets(struct app *app);
void ceduo_popup_new_option(struct app *app);
void ceduo_popup_choices(struct app *app, const struct form_cell *cell);
void ceduo_popup_open(struct app *app);
void ceduo_popup_new(struct app *app);
void ceduo_popup_export(struct app *app);
void ceduo_popup_find(struct app *app);
void ceduo_popup_counts(struct app *app);

/* What the search came to that ceduo_popup_find() started. */
void ceduo_popup_found(struct app *app, struct sought *sought);

/* ---- saving, and unsaved work (popup_save.c) ---- */

/* Saves to the scene's own file; asks for a name where there is none, and what to do where the file has changed. */
void ceduo_popup_save(struct app *app);
void ceduo_popup_save_as(struct app *app);

/* Ends the program; asks first if there is unsaved work. */
void ceduo_popup_quit(struct app *app);

/* Returns whether there is unsaved work, and warns that it must be saved before another scene is opened. */
bool ceduo_popup_unsaved(struct app *app);

/* Offers unsaved work on this document that an earlier process left behind. */
void ceduo_popup_recover(struct app *app);

#endif
