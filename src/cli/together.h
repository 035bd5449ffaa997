/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TOGETHER_H
#define CEDUO_TOGETHER_H

#include "arguments.h"

/* Whether the options go together, and as many scenes are named as they want. EXIT_DONE, or EXIT_USAGE once the reason is
 * told. */
enum exit_status ceduo_arguments_check(struct arguments *arguments);

#endif
