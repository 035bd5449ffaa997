/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_COLUMN_H
#define CEDUO_COLUMN_H

#include "app.h"

/* Draws the column of the newest figures. */
void ceduo_column_draw(struct app *app, struct ceduo_area area);

#endif
