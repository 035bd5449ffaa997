/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INTERACTIVE_H
#define CEDUO_INTERACTIVE_H

#include "arguments.h"

/* Opens the terminal program, or feeds it the script that was given. */
enum exit_status ceduo_interactive_run(const struct arguments *arguments);

#endif
