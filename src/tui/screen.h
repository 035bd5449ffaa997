/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCREEN_H
#define CEDUO_SCREEN_H

#include "app.h"

/* Draws everything on app->cells: titles of the views, the view that is open, the column of figures, what the cursor is
 * on, the bar of keys, and a popup over them. */
void ceduo_screen_draw(struct app *app);

/* The view whose title stands in this column of the top row; VIEW_COUNT where there is none. */
enum view_number ceduo_screen_view_at(int column);

#endif
