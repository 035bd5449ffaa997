/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SIZES_H
#define CEDUO_SIZES_H

#include "ceduo/scene.h"

/* Sizes of the blocks that come down. Their logarithms are spread evenly over all classes, so that rare large blocks are
 * as well known as frequent small ones, and each rock has a weight: how many times more often such a size comes down than
 * it is drawn. On the mean weights are 1.
 *
 * Within a class the number above v goes with v^-b, cut at its upper end; b = 0 is the limit, where the logarithms are
 * even. Rock i takes the place frac(u + i g) of the whole range, g the golden ratio and u of the seed (Weyl 1916): any
 * rocks that follow each other have all sizes. */
struct sizes {
    size_t n;        /* classes; 0: all rocks are of the scene's rock */
    double length;   /* of all classes together, in ln(volume) */
    double per_year; /* of all together */
    uint64_t start;
    struct size_class {
        double from, length; /* ln(volume) */
        double exponent;
        double weight; /* at `from`; it goes with exp(-exponent (ln v - from)) */
    } * classes;
};

struct size {
    double volume, weight;
};

/* False without memory. */
bool ceduo_sizes_init(struct sizes *sizes, const struct ceduo_scene *scene);
void ceduo_sizes_release(struct sizes *sizes);

/* Whether a rock is one of those whose sizes are as frequent as those of the blocks that come down: the same rocks every
 * time, so many of each size as its weight is to the largest. */
bool ceduo_size_is_typical(const struct sizes *sizes, uint64_t seed, uint64_t rock);

struct size ceduo_size_of(const struct sizes *sizes, uint64_t rock);

/* Scales a rock to a volume; shape and density stay. */
void ceduo_rock_resize(struct ceduo_rock *rock, double volume);

#endif
