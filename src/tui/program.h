/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROGRAM_H
#define CEDUO_PROGRAM_H

#include "app.h"

/* Takes keys and the mouse in. Only this decides what a key does; views and popups may have their own meaning for it. */

/* As ceduo_app_create() and ceduo_app_free(), popups and all. */
bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads,
                          bool no_recovery, struct problems *problems);
void ceduo_program_free(struct app *app);

void ceduo_program_key(struct app *app, int key);
void ceduo_program_click(struct app *app, int x, int y);
void ceduo_program_wheel(struct app *app, int by);

/* As ceduo_app_news(), and what a search found. */
bool ceduo_program_news(struct app *app);

#endif
