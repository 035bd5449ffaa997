/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROCK_H
#define CEDUO_ROCK_H

#include <stdbool.h>

#include "status.h"

#define CEDUO_SPREAD_KINDS(X)                                                                                                  \
    X(NORMAL, "normal")                                                                                                        \
    X(UNIFORM, "uniform")

enum ceduo_spread_kind {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_SPREAD_KINDS(X)
#undef X
};

/* A number that may vary from rock to rock. `spread` is the standard deviation of a normal distribution, truncated at three
 * standard deviations, or the half-width of a uniform one. If it is 0, every rock has `mean`. */
struct ceduo_number {
    double mean;
    double spread;
    enum ceduo_spread_kind kind;
};

/* Return a number without spread. */
struct ceduo_number ceduo_number(double mean);

/* Return the smallest and the largest value that can be drawn. */
double ceduo_number_min(struct ceduo_number n);
double ceduo_number_max(struct ceduo_number n);

/* Return quantile u (0 < u < 1) of the distribution, truncated to [lo, hi] as well. One draw replaces rejection sampling.
 * Requires that [lo, hi] overlaps the range of the distribution. */
double ceduo_number_draw(struct ceduo_number n, double u, double lo, double hi);

#define CEDUO_SHAPES(X)                                                                                                        \
    X(SPHERE, "sphere")                                                                                                        \
    X(CYLINDER, "cylinder")                                                                                                    \
    X(ELLIPSOID, "ellipsoid")                                                                                                  \
    X(BLOCK, "block")

enum ceduo_shape {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_SHAPES(X)
#undef X
};

/* A rock as a user describes it. Sizes that are not given have mean NaN. A sphere needs one of diameter, volume or mass (with
 * density), a cylinder diameter and height, an ellipsoid or a block three axes. A given mass replaces volume × density. */
struct ceduo_rock_def {
    enum ceduo_shape shape;
    struct ceduo_number diameter; /* m, > 0 */
    struct ceduo_number height;   /* m, > 0 */
    struct ceduo_number volume;   /* m3, > 0 */
    struct ceduo_number mass;     /* kg, > 0 */
    struct ceduo_number density;  /* kg/m3, > 0 */
    struct ceduo_number axes[3];  /* m, > 0 */
};

/* Return a sphere of limestone without a size; the caller sets it. */
struct ceduo_rock_def ceduo_rock_def_default(void);

/* One rock. */
struct ceduo_rock {
    double mass;          /* M, kg */
    double mean_diameter; /* B, m: mean of the axes, as in Ciabocco et al. 2009 (0.68 m there) */
    double radius;        /* R = B/2, m */
    double moment;        /* I, kg m2: sphere and ellipsoid 2/5 MR2, cylinder 1/2 MR2, block M(b2 + c2)/12 */
    double k;             /* I/(MR2) */
    double volume;        /* m3 */
    double axes[3];       /* m; sphere: d, d, d; cylinder: d, d, h */
};

/* Compute the rock of mean sizes. CEDUO_BAD_ROCK if a size is missing or not above 0. */
enum ceduo_status ceduo_rock_from_means(const struct ceduo_rock_def *def, struct ceduo_rock *rock);

/* Return the rock of mean sizes; every member is NaN if the sizes are not valid. */
struct ceduo_rock ceduo_rock_mean(const struct ceduo_rock_def *def);

/* True if some size has a spread. */
bool ceduo_rock_varies(const struct ceduo_rock_def *def);

/* Compute the rock whose sizes are the quantiles u[0…7] of diameter, height, volume, mass, density and the three axes. */
enum ceduo_status ceduo_rock_draw(const struct ceduo_rock_def *def, const double u[8], struct ceduo_rock *rock);

#endif
