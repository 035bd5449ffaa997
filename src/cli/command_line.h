/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_COMMAND_LINE_H
#define CEDUO_COMMAND_LINE_H

#include "arguments.h"

/* EXIT_DONE, or another status once the reason is told. Free the arguments in any case. */
enum exit_status ceduo_arguments_read(struct arguments *arguments, int argc, char **argv);
void ceduo_arguments_free(struct arguments *arguments);

/* The page of --help. */
void ceduo_arguments_help(struct text *text);

#endif
