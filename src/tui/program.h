/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROGRAM_H
#define CEDUO_PROGRAM_H

#include "app.h"

/* Handles keys and the mouse. A popup gets a key first, then the open field, then the view; what is left is done here. */

/* As ceduo_app_create(); offers unsaved work that was left behind. */
bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery);

void ceduo_program_key(struct app *app, int key);
void ceduo_program_paste(struct app *app, const char *text); /* into the line that is being typed; otherwise nowhere */
void ceduo_program_click(struct app *app, int x, int y);
void ceduo_program_wheel(struct app *app, int by);
bool ceduo_program_poll(struct app *app); /* takes the results of the jobs; true if the screen has changed */

/* Plays a script without a terminal, a command on each line (see ceduo-terminal(7)). Errors go to standard error. */
enum script_end { SCRIPT_DONE, SCRIPT_WRONG, SCRIPT_UNREADABLE, SCRIPT_UNWRITTEN };
enum script_end ceduo_script_run(struct app *app, const char *path);

/* ---- a terminal (terminal.c) ---- */

enum terminal_end {
    TERMINAL_DONE,
    TERMINAL_NONE,  /* there is no terminal that a screen can be drawn on; nothing was touched */
    TERMINAL_FAILED /* the machine gives no pipe */
};

/* NULL if standard input and output are a terminal and TERM can address its cells, otherwise why not. */
const char *ceduo_terminal_missing(void);

/* Shows the program on the terminal until it ends; restores the terminal. A signal that ends it is raised again. */
enum terminal_end ceduo_terminal_run(struct app *app);

/* Restores the terminal before the program ends, from a signal handler or any thread. False if no screen is shown. */
bool ceduo_terminal_restore(void);

#endif
