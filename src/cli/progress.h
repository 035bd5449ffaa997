/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PROGRESS_H
#define CEDUO_PROGRESS_H

#include "arguments.h"

/* Rocks and seconds on standard error, once a second is over: a run's `progress`. */
struct progress {
    double start, shown;
    bool wanted, open;
};
struct progress ceduo_progress_begin(const struct arguments *arguments);
void ceduo_progress_show(void *progress, uint64_t rocks);
void ceduo_progress_end(const struct progress *progress);

#endif
