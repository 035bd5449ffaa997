/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PREPARED_H
#define CEDUO_PREPARED_H

#include "core/forest/forest.h"
#include "ground.h"

/* Sizes of the blocks that come down. Their logarithms are uniform over all classes, so that rare large blocks are as precise
 * as frequent small ones. The weight of a rock is the natural frequency of its size over the frequency of drawing it. The mean
 * weight is 1.
 *
 * Within a class the number above v is proportional to v^-b, truncated at its upper end; b = 0 is the limit of uniform
 * logarithms. Rock i has the position frac(u + i g) in the whole range, with g the golden ratio and u from the seed (Weyl
 * 1916), so that any sequence of rocks has all sizes. */
struct sizes {
    size_t n;        /* classes; 0: all rocks are the scene's rock */
    double length;   /* of all classes together, in ln(volume) */
    double per_year; /* of all classes together */
    uint64_t start;
    struct size_class {
        double from, length; /* ln(volume) */
        double exponent;
        double weight; /* at `from`; proportional to exp(-exponent (ln v - from)) */
    } * classes;
};

struct size {
    double volume, weight;
};

/* False without memory. */
bool ceduo_sizes_init(struct sizes *sizes, const struct ceduo_scene *scene);
void ceduo_sizes_release(struct sizes *sizes);

/* True if a rock belongs to a fixed subset with natural size frequencies. Its probability is weight over largest weight. */
bool ceduo_rock_is_typical(const struct sizes *sizes, uint64_t seed, uint64_t rock);

struct size ceduo_rock_size(const struct sizes *sizes, uint64_t rock);

/* Scale a rock to a volume, with the same shape and density. */
void ceduo_rock_resize(struct ceduo_rock *rock, double volume);

/* A control. It records the first passage of a rock along +x. */
struct mark {
    double x, z;    /* m; z: the ground */
    size_t control; /* index in the scene */
};

struct marks {
    size_t n;
    struct mark *items; /* sorted by x */
};

/* A scene prepared for one forest. Walkers read it. */
struct prepared_scene {
    struct ceduo_scene scene;      /* with the simulated profile */
    struct ceduo_slope simplified; /* owns this profile; x NULL: the caller owns it */
    struct ceduo_rock mean;
    bool varies; /* rocks vary, apart from the sizes of blocks */
    struct sizes sizes;
    struct ground ground;
    struct marks marks;
    struct forest forest;
};

/* `option` may be NULL (without forest). Return CEDUO_OK, CEDUO_BAD_ROCK or CEDUO_NO_MEMORY. Caller releases it in any case. */
enum ceduo_status ceduo_prepared_init(struct prepared_scene *to, const struct ceduo_scene *scene,
                                      const struct ceduo_option *option);
void ceduo_prepared_release(struct prepared_scene *p);

/* Return the topography of a control (in the scene's order) below the mean release, on the simulated profile. */
struct ceduo_topography ceduo_prepared_topography(const struct prepared_scene *prepared, size_t control);

/* Draw rock `number` of a run, with its size. Return the status of ceduo_rock_draw(). */
enum ceduo_status ceduo_prepared_rock(const struct prepared_scene *prepared, uint64_t number, struct ceduo_rock *rock);

#endif
