/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TERMINAL_H
#define CEDUO_TERMINAL_H

#include "app.h"

enum terminal_end {
    TERMINAL_DONE,
    TERMINAL_NONE,  /* there is no terminal that a screen can be drawn on; nothing was touched */
    TERMINAL_FAILED /* the machine gives no pipe */
};

/* Returns NULL if there is a terminal to draw on: standard input and output are one, and TERM can address its cells.
 * Otherwise says why there is none. */
const char *ceduo_terminal_missing(void);

/* Shows the program on the terminal until it ends; restores the terminal. A signal that ends it is raised again. */
enum terminal_end ceduo_terminal_run(struct app *app);

/* Gives the terminal back as it was, from a signal handler or any thread, just before the program ends. False if no screen
 * is shown. */
bool ceduo_terminal_restore(void);

#endif
