/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROGRAM_H
#define CEDUO_PROGRAM_H

#include "app.h"

/* Handles keys and the mouse. A popup gets a key first, then the open field, then the view; what is left is done here. */

/* Same as ceduo_app_create() and ceduo_app_free(), including popups. */
bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery,
                          struct problems *problems);
void ceduo_program_free(struct app *app);

void ceduo_program_key(struct app *app, int key);
void ceduo_program_paste(struct app *app, const char *text); /* into the line that is being typed; otherwise nowhere */
void ceduo_program_click(struct app *app, int x, int y);
void ceduo_program_wheel(struct app *app, int by);

/* Takes the news of the jobs, and what a search found. True where the screen has changed. */
bool ceduo_program_news(struct app *app);

#endif
