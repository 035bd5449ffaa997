/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANKS_H
#define CEDUO_RANKS_H

#include <stddef.h>

/* A rank, 1 for the smallest value, and the destination of its value. */
struct rank {
    size_t rank;
    double *to;
};

/* Write the values of some ranks, in ascending order of the ranks. Reorders both arrays; no value may be NaN. */
void ceduo_ranks_select(double *values, size_t n, struct rank *ranks, size_t ranks_count);

#endif
