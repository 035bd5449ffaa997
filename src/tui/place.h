/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLACE_H
#define CEDUO_PLACE_H

#include "app.h"

/* The cursor along the slope of view 1: what stands there, what rocks do there, and how near the picture is. */

/* Where it is, m, relative: in the middle of the slope until it is moved. */
double ceduo_place_x(const struct app *app);

/* The stretch of slope that the picture shows, m, relative: around the cursor once it is nearer than the whole. */
void ceduo_place_stretch(const struct app *app, double *from, double *to);

/* Moves it by a hundredth of what is shown, onto a round number; to the next of all points, borders and controls. */
void ceduo_place_move(struct app *app, int by);
void ceduo_place_jump(struct app *app, int by);

/* Twice as near (+1) or as far (-1), which is said where it ends. */
void ceduo_place_zoom(struct app *app, int by);

/* Says where it is and what passes there. */
void ceduo_place_say(struct app *app);

/* The stretch between points of the profile that holds x, both as the file of the slope has them. */
size_t ceduo_place_stretch_of(const struct app *app, double x_written);

/* Lists what it stands on, to be edited, and what can be put there. */
void ceduo_place_choose(struct app *app);

#endif
