/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PLANE_MAP_H
#define PLANE_MAP_H

#include <gsl/gsl_rng.h>

#include "ceduo/scene.h"

/* A forest as a full map in the plane, made and swept in the simplest way: every stool and tree of a wide rectangle gets a
 * place, then each stem is checked. It is the reference for the stems that the program draws lazily along a trajectory. It
 * shares no code and no random numbers with it. */

struct map_stem {
    double x, y, dbh;
    bool shoot;
    uint64_t stool; /* equal for all shoots of one stool */
};

/* Make a new map of `option` and write the stems that touch a strip of width `b` about y = 0 from x = `start`, in order of x.
 * Writes at most `max`; returns the number of stems. Diameters are the means of their kinds. */
size_t plane_map_sweep(const struct ceduo_option *option, double b, double start, gsl_rng *rng, struct map_stem *stems,
                       size_t max);

#endif
