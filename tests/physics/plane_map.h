/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PLANE_MAP_H
#define PLANE_MAP_H

#include <gsl/gsl_rng.h>

#include "ceduo/scene.h"

/* A forest as a full map in the plane, made and swept in the plainest way: every stool and tree of a wide rectangle gets
 * a place, then each stem is looked at. The reference for what the program draws lazily along a way; it shares no code
 * and no random numbers with it. */

struct map_stem {
    double x, y, dbh;
    bool shoot;
    uint64_t stool; /* the same number for the shoots of one stool */
};

/* Makes a new map of `option` and writes the stems that touch a strip as wide as `b` about y = 0, from x = `start` on, in
 * the order of x. At most `most`; returns how many there are. Diameters are the means of their kinds. */
size_t plane_map_sweep(const struct ceduo_option *option, double b, double start, gsl_rng *rng, struct map_stem *stems,
                       size_t most);

#endif
