/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROGRAM_H
#define CEDUO_PROGRAM_H

#include "app.h"

/* Keys and mouse. A popup gets a key first, then the open field, then the view; the program handles the rest. */

/* As ceduo_app_create(); also offers abandoned work. */
bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery);

/* In a window that is too small for the screen, only keys that end the program or the tour without a question act. */
void ceduo_program_key(struct app *app, int key);
void ceduo_program_interrupt(struct app *app);               /* Ctrl-C: leaves a popup, or quits */
void ceduo_program_paste(struct app *app, const char *text); /* into the open input line; otherwise ignored */
void ceduo_program_click(struct app *app, int x, int y);
void ceduo_program_wheel(struct app *app, int x, int y, int lines);
bool ceduo_program_poll(struct app *app); /* take the results of the jobs; return true if the screen has changed */

/* Start the tour (tour.c). At its end open the scene at `path` (NULL: the site of the paper), and offer abandoned work. */
void ceduo_tour_start(struct app *app, const char *path);

/* True if a key has an effect in the tour. Handle it, and return the key that the program handles; K_NONE: none. */
bool ceduo_tour_accepts(const struct app *app, int key);
int ceduo_tour_key(struct app *app, int key);
bool ceduo_tour_is_end(int key); /* true if a key ends the tour */

/* Run a script without a terminal, one command per line (see ceduo-terminal(7)). Errors go to standard error. */
enum script_end { SCRIPT_DONE, SCRIPT_WRONG, SCRIPT_UNREADABLE, SCRIPT_UNWRITTEN };
enum script_end ceduo_script_run(struct app *app, const char *path);

/* ---- a terminal (terminal.c) ---- */

enum terminal_end {
    TERMINAL_DONE,
    TERMINAL_NONE,  /* no usable terminal; nothing was changed */
    TERMINAL_FAILED /* no pipe available */
};

/* Return NULL if standard input and output are a terminal and TERM can address its cells; otherwise the reason. */
const char *ceduo_terminal_missing(void);

/* Show the program on the terminal until it ends, then restore the terminal. A signal that ended it is raised again. */
enum terminal_end ceduo_terminal_run(struct app *app);

/* Restore the terminal before the program ends, from a signal handler or any thread. Return false if no screen is shown. */
bool ceduo_terminal_restore(void);

#endif
