/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEEN_H
#define CEDUO_SEEN_H

#include "ceduo/observe.h"

/* Stops that were seen beside simulated ones: at places along the slope the share of the rocks that lie
 * farther, as it was seen, and the middle 95 % of samples as large from the simulated rocks. */
#define CEDUO_SEEN_PLACES 160

struct ceduo_observed_stops {
    bool known;
    double x[CEDUO_SEEN_PLACES]; /* m, relative, evenly apart */
    double observed[CEDUO_SEEN_PLACES], lo[CEDUO_SEEN_PLACES], hi[CEDUO_SEEN_PLACES];
};

/* `values`: sorted, of the n simulated rocks, of so many, that stopped where rocks were looked for. The others count
 * as farther where it is known how many rocks were released, and otherwise nowhere. */
void ceduo_observed_stops_find(const struct ceduo_observation *seen, const double *values, size_t n, size_t rocks,
                               struct ceduo_observed_stops *stops);

#endif
