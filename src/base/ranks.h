/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANKS_H
#define CEDUO_RANKS_H

#include <stddef.h>

/* A rank, 1 for the smallest value, and the destination of its value. */
struct rank {
    size_t rank;
    double *to;
};

/* Write the values of some ranks, 1…n in ascending order, of n > 0 values without NaN. Reorders the values, and changes the
 * ranks. */
void ceduo_ranks_select(double *values, size_t n, struct rank *ranks, size_t ranks_count);

#endif
