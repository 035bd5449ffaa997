/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OBSERVED_STOPS_H
#define CEDUO_OBSERVED_STOPS_H

#include "ceduo/calibrate.h"

/* Observed and simulated stops: at places along the slope the share of the rocks that stop farther, as observed, and the
 * central 95 % of samples of the observed size from the simulated rocks. */
#define CEDUO_STOPS_PLACES 160

struct ceduo_observed_stops {
    bool known;                   /* the stops are not all at one place */
    double x[CEDUO_STOPS_PLACES]; /* m, relative, evenly apart */
    double observed[CEDUO_STOPS_PLACES], lo[CEDUO_STOPS_PLACES], hi[CEDUO_STOPS_PLACES];
};

/* `values`: sorted stops of the n simulated rocks, among `rocks`, that stopped in the surveyed part. The other rocks count
 * as farther if the number released is given, and are left out otherwise. */
void ceduo_observed_stops_find(const struct ceduo_observation *observation, const double *values, size_t n, size_t rocks,
                               struct ceduo_observed_stops *stops);

#endif
