/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_USAGE_H
#define CEDUO_USAGE_H

#include "arguments.h"

/* Says on standard error what is wrong with the command line, or with this option of it. EXIT_USAGE; EXIT_RUN without
 * memory. */
enum exit_status ceduo_usage(const char *option, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Says that there is no memory. EXIT_RUN. */
enum exit_status ceduo_usage_no_memory(void);

#endif
