/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCRIPT_H
#define CEDUO_SCRIPT_H

#include "app.h"

/* Feeds a script to the program without a terminal, a command on each line:
 *   key NAME…       keys by name: a, Enter, Up, F1, Ctrl-R, Space
 *   type TEXT       the characters of TEXT, to the end of the line
 *   resize W H      another size of the screen, 80 x 24 at the start
 *   wait idle       until the figures are as fine as they will be
 *   dump FILE       the screen as text (-: standard output)
 *   roles FILE      the roles of its cells, a letter each
 *   # …             a comment
 * What is wrong goes to standard error. */
enum script_end { SCRIPT_DONE, SCRIPT_WRONG, SCRIPT_UNREADABLE, SCRIPT_UNWRITTEN };
enum script_end ceduo_script_run(struct app *app, const char *path);

#endif
