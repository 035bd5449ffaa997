/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EDIT_H
#define CEDUO_EDIT_H

#include "app.h"

/* Edits the field or the list item under the cursor of the form. */

/* Opens the field, as a line or with the list of its choices. */
void ceduo_edit_start(struct app *app);
/* Handles a key while the line is open. */
void ceduo_edit_key(struct app *app, int key);
/* Changes the value by one step up (+1) or down (-1). */
void ceduo_edit_step(struct app *app, int direction);

void ceduo_items_add(struct app *app);
/* Splits item `index` of a list `at` a place along the slope, m as given, or adds a control there. */
void ceduo_items_add_at(struct app *app, const char *list, size_t index, double at);
/* The stretch between points of the profile that holds x, both as the file of the slope has them. */
size_t ceduo_items_stretch_of(const struct app *app, double x_written);
/* Asks for a class of blocks, wherever the cursor is. */
void ceduo_items_add_blocks(struct app *app);
void ceduo_items_delete(struct app *app);
void ceduo_items_duplicate(struct app *app);
void ceduo_items_move(struct app *app, int by);

#endif
