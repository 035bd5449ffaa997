/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ranks.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define BINS 4096 /* that narrow a selection; affects only speed */

/* Move the values that may have one of the ranks to the front, by one count of the values in equal bins, and set the ranks
 * among them. Return the number of these values. */
static size_t narrow_to_ranks(double *values, size_t n, struct rank *ranks, size_t ranks_count)
{
    double min = values[0], max = min;
    for (size_t i = 1; i < n; i++) {
        min = values[i] < min ? values[i] : min;
        max = values[i] > max ? values[i] : max;
    }
    const size_t bins = n < BINS ? n : BINS;
    double scale = (double)bins / (max - min);
    if (!(scale > 0 && scale < INFINITY))
        return n;
    uint32_t counts[BINS + 1];
    bool keep[BINS + 1];
    memset(counts, 0, (bins + 1) * sizeof counts[0]);
    memset(keep, 0, (bins + 1) * sizeof keep[0]);
    for (size_t i = 0; i < n; i++)
        counts[(int)((values[i] - min) * scale)]++;
    for (size_t i = 0, bin = 0, before = 0, dropped = 0; i < ranks_count;) {
        if (ranks[i].rank <= before + counts[bin]) {
            keep[bin] = true;
            ranks[i++].rank -= dropped;
        } else {
            before += counts[bin];
            dropped += keep[bin] ? 0 : counts[bin];
            bin++;
        }
    }
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) { /* without a branch, which would be mispredicted */
        double value = values[i];
        values[i] = values[kept];
        values[kept] = value;
        kept += keep[(int)((value - min) * scale)];
    }
    return kept;
}

void ceduo_ranks_select(double *values, size_t n, struct rank *ranks, size_t ranks_count)
{
    n = narrow_to_ranks(values, n, ranks, ranks_count);
    for (size_t i = 0, from = 0; i < ranks_count; i++) { /* search only above the previous rank */
        size_t index = ranks[i].rank - 1;
        *ranks[i].to = gsl_stats_select(values + from, 1, n - from, index - from);
        from = index;
    }
}
