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

/* A number that may differ from rock to rock. `spread` is the standard deviation of a normal law, which is cut at three
 * of them, or the half-width of a uniform one; 0: every rock has `mean`. */
struct ceduo_number {
    double mean;
    double spread;
    enum ceduo_spread_kind kind;
};

/* A number without spread. */
struct ceduo_number ceduo_number(double mean);

/* The smallest and the largest value that can be drawn. */
double ceduo_number_lowest(struct ceduo_number n);
double ceduo_number_highest(struct ceduo_number n);

/* The value of quantile u (0 < u < 1), the law cut at [lo, hi] as well: what drawing again until the value lies inside
 * gives, in one draw. [lo, hi] must reach into the range of the law. */
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

/* A rock as a user describes it. Sizes that were not given have mean NaN. A sphere is given by one of diameter, volume
 * or mass (with density), a cylinder by diameter and height, an ellipsoid or a block by three axes. Where the sizes are
 * given, a mass replaces volume × density. */
struct ceduo_rock_def {
    enum ceduo_shape shape;
    struct ceduo_number diameter; /* m, > 0 */
    struct ceduo_number height;   /* m, > 0 */
    struct ceduo_number volume;   /* m3, > 0 */
    struct ceduo_number mass;     /* kg, > 0 */
    struct ceduo_number density;  /* kg/m3, > 0 */
    struct ceduo_number axes[3];  /* m, > 0 */
};

/* A sphere of limestone, whose size is the caller's to set. */
struct ceduo_rock_def ceduo_rock_def_default(void);

/* One rock. */
struct ceduo_rock {
    double mass;          /* M, kg */
    double mean_diameter; /* B, m: the mean of its dimensions, as in Ciabocco et al. 2009 (0.68 m there) */
    double radius;        /* R = B/2, m */
    double moment;        /* I, kg m2: sphere and ellipsoid 2/5 MR2, cylinder 1/2 MR2, block M(b2 + c2)/12 */
    double k;             /* I/(MR2) */
    double volume;        /* m3 */
    double axes[3];       /* m, its dimensions: of a sphere d, d, d, of a cylinder d, d, h */
};

/* The rock whose every size is the mean. CEDUO_BAD_ROCK where a size is missing or not above 0. */
enum ceduo_status ceduo_rock_of_means(const struct ceduo_rock_def *def, struct ceduo_rock *rock);

/* The same; every figure is NaN where the sizes make no rock. */
struct ceduo_rock ceduo_rock_mean(const struct ceduo_rock_def *def);

/* True where some size has a spread. */
bool ceduo_rock_varies(const struct ceduo_rock_def *def);

/* The rock whose sizes have the quantiles u[0…7], in the order diameter, height, volume, mass, density, axes. */
enum ceduo_status ceduo_rock_draw(const struct ceduo_rock_def *def, const double u[8], struct ceduo_rock *rock);

#endif
