/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CLOCK_H
#define CEDUO_CLOCK_H

#include <time.h>

/* Return the seconds of a monotonic clock. */
static inline double ceduo_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
