/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PREPARED_H
#define CEDUO_PREPARED_H

#include "ceduo/scene.h"
#include "core/wood/wood.h"
#include "ground.h"

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

struct size ceduo_size_find(const struct sizes *sizes, uint64_t rock);

/* Scales a rock to a volume; shape and density stay. */
void ceduo_rock_resize(struct ceduo_rock *rock, double volume);

/* A place where something is noted of a rock's first passage going +x: a control. */
struct mark {
    double x, z; /* m; z: the ground */
    size_t what; /* the control's index */
};

struct marks {
    size_t n;
    struct mark *at; /* rising along x */
};

/* A scene made ready to simulate rocks through one forest: what a walker reads. */
struct prepared {
    struct ceduo_scene scene;      /* with the profile that is simulated */
    struct ceduo_slope simplified; /* owns that profile; x NULL: it is the caller's */
    struct ceduo_rock mean;
    bool varies; /* so do rocks from one to the next, besides the sizes of blocks */
    struct sizes sizes;
    struct ground ground;
    struct marks marks;
    struct wood wood;
};

/* `option` NULL: without forest. CEDUO_BAD_ROCK or CEDUO_NO_MEMORY; release it in any case. */
enum ceduo_status ceduo_prepared_init(struct prepared *to, const struct ceduo_scene *scene, const struct ceduo_option *option);
void ceduo_prepared_release(struct prepared *p);

/* How a control (in the scene's order) lies below the mean release, on the profile that is simulated. */
struct ceduo_topography ceduo_prepared_topography(const struct prepared *ready, size_t control);

/* Rock `number` of a run, of its own size. What ceduo_rock_draw() says. */
enum ceduo_status ceduo_prepared_rock(const struct prepared *ready, uint64_t number, struct ceduo_rock *rock);

#endif
