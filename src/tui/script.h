/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCRIPT_H
#define CEDUO_SCRIPT_H

#include "app.h"

/* Feeds a script to the program without a terminal, a command on each line, as ceduo-terminal(7) has them. What is wrong goes to
 * standard error. */
enum script_end { SCRIPT_DONE, SCRIPT_WRONG, SCRIPT_UNREADABLE, SCRIPT_UNWRITTEN };
enum script_end ceduo_script_run(struct app *app, const char *path);

#endif
