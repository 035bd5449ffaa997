/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "progress.h"

#include <stdio.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/intl.h"

struct progress ceduo_progress_begin(const struct arguments *a)
{
    return (struct progress){.start = ceduo_clock(), .wanted = !a->quiet && isatty(STDERR_FILENO)};
}

void ceduo_progress_show(void *context, uint64_t rocks)
{
    struct progress *p = context;
    double t = ceduo_clock();
    if (!p->wanted || t - p->start < 1 || t - p->shown < 0.2)
        return;
    fprintf(stderr, _("\r%llu rocks, %.0f s"), (unsigned long long)rocks, t - p->start);
    p->shown = t;
    p->open = true;
}

void ceduo_progress_end(const struct progress *p)
{
    if (p->open)
        fputs("\r                              \r", stderr);
}
