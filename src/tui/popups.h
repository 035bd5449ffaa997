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
/* Copies what the view says, as text without its pictures, to the terminal's clipboard. */
void ceduo_popup_copy(struct app *app);
void ceduo_popup_find(struct app *app);
void ceduo_popup_counts(struct app *app);

/* Asks for the fields of a new item of a list, or of one group that it has (NULL: of all of it), and adds it at the end.
 * `offered`: what stands in the first fields. */
void ceduo_popup_item_of(struct app *app, const char *list, const char *group, const char *const *offered, size_t n);

/* Treatments of the option under the cursor as items of a list. The other two return false if the item is none of them. */
void ceduo_popup_offer_treatments(struct app *app, struct popup *popup);
bool ceduo_popup_preview_treatment(struct app *app, struct popup *popup);
bool ceduo_popup_chose_treatment(struct app *app, const char *value);

/* What the search came to that ceduo_popup_find() started. */
void ceduo_popup_found(struct app *app, struct search_answer *sought);

/* ---- saving, and unsaved work (popup_save.c) ---- */

/* Saves to the scene's own file; asks for a name where there is none, and what to do where the file has changed. */
void ceduo_popup_save(struct app *app);
void ceduo_popup_save_as(struct app *app);

/* Ends the program, once the work is saved or given up. */
void ceduo_popup_quit(struct app *app);

/* Goes on with `then`; asks first (save, discard, stay) where there is unsaved work. */
void ceduo_popup_once_saved(struct app *app, void (*then)(struct app *app));

/* Lists unsaved work that earlier processes left behind, where some of it is on this document or has no file. */
void ceduo_popup_recover(struct app *app);
/* Adds all of it to a list; takes up the one that was chosen, false where the value is none. */
void ceduo_popup_offer_recoveries(const struct app *app, struct popup *popup);
bool ceduo_popup_take_recovery(struct app *app, const char *value);

/* ---- what fields of popups may hold ---- */

/* Files with the popup's endings, and folders. */
void ceduo_popup_offer_files(struct app *app, struct popup *popup);

#define STAND_COUNTED _("from a sample plot") /* in the place of a stand: what a sample plot counts */
#define STAND_SURVEY  _("from a survey")      /* what a CSV file of plots holds */
/* Replace the stand of the belt shown. Says which growth and cutting are dropped, and that the year of its cut stays. */
bool ceduo_popup_replace_stand(struct app *app, const char *path, const char *value);
void ceduo_popup_survey(struct app *app); /* asks for that file */

/* A scene of nothing but the stand, with the rock of this one; false if it is no stand. The caller releases `file` in any case. */
bool ceduo_popup_read_stand(const struct app *app, const char *value, struct scene_file *file);

void ceduo_popup_offer_stands(struct app *app, struct popup *popup);
void ceduo_popup_offer_grounds(struct app *app, struct popup *popup);

#endif
