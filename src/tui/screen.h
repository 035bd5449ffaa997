/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCREEN_H
#define CEDUO_SCREEN_H

#include "app.h"

/* Draws everything on app->cells: titles of the views, the open view, the column of figures, the explanation of the field
 * under the cursor, the bar of keys, and the popup over them. */
void ceduo_screen_draw(struct app *app);

/* Returns the view whose title stands in this column of the top row; VIEW_COUNT if there is none. */
enum view_number ceduo_screen_view_at(const struct app *app, int column);

/* Draws the column of the newest figures, which stands still in every view (column.c). `titled`: the scene's title stands above
 * them. */
void ceduo_column_draw(struct app *app, struct ceduo_area area, bool titled);

/* Adds the scene's title in one line, with a mark of unsaved work. */
void ceduo_screen_title(struct app *app, struct ceduo_page *page);

#endif
