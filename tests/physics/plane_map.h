/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PLANE_MAP_H
#define PLANE_MAP_H

#include <gsl/gsl_rng.h>

#include "ceduo/scene.h"

/* A forest as a map in the plane, made and swept in the simplest way: every stool and tree that can reach a strip gets a place,
 * then each stem is checked. It is the reference for the stems that the program draws lazily along a trajectory. It shares no
 * code and no random numbers with it. */

struct map_stem {
    double x, y, dbh;
    bool shoot;
    uint64_t stool; /* equal for all shoots of one stool */
    double height;  /* m */
    double energy;  /* J that a hit takes, by printed_energy() */
};

/* Share of the largest energy by eccentricity as printed by Dorren et al. 2006, clamped to 0…1. */
double printed_share(double u);

/* Energy (J) by Eq. 3 of Ciabocco et al. 2009 of a stem that a rock of diameter b hits at the offset y, with that share if the
 * stand has it; NaN if the volume or U is not given. */
double printed_energy(const struct ceduo_stand *stand, const struct ceduo_stems *kind, double b, double y);

/* Make a new map of `option` and write the stems that touch a strip of width `b` about y = 0 from x = `start`, in order of x.
 * Writes at most `max`; returns the number of stems. Diameters are the means of their kinds. */
size_t plane_map_sweep(const struct ceduo_option *option, double b, double start, gsl_rng *rng, struct map_stem *stems,
                       size_t max);

#endif
