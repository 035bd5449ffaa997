/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCREEN_H
#define CEDUO_SCREEN_H

#include "app.h"

/* Draws everything on app->cells: titles of the views, the open view, the column of figures, the explanation of the field
 * under the cursor, the bar of keys, and the popup over them. */
void ceduo_screen_draw(struct app *app);

/* Returns the view whose title stands in this column of the top row; VIEW_COUNT if there is none. */
enum view_number ceduo_screen_view_at(const struct app *app, int column);

#endif
