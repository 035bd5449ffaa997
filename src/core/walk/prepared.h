/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PREPARED_H
#define CEDUO_PREPARED_H

#include "ceduo/scene.h"
#include "core/wood/wood.h"
#include "ground.h"
#include "sizes.h"

/* A place where something is noted of a rock's first passage going +x: a control. */
struct mark {
    double x, z; /* m; z: the ground */
    size_t what; /* the control's index */
};

/* Controls, and cells of the envelopes, where rocks are noted many at once. */
struct marks {
    size_t n, cells;
    struct mark *at;         /* rising along x */
    double *cell_x, *cell_z; /* likewise; behind the last NaN, as many as a vector reads: compare with isless() and its like,
                              * which raise no exception */
};

/* A scene made ready to simulate rocks through one forest: what a walker reads. */
struct prepared {
    struct ceduo_scene scene;
    struct ceduo_rock mean;
    bool varies; /* so do rocks from one to the next, besides the sizes of blocks */
    struct sizes sizes;
    struct ground ground;
    struct marks marks;
    struct wood wood;
};

/* `option` NULL: without forest. `cell_x`: places of envelopes. CEDUO_BAD_ROCK or CEDUO_NO_MEMORY; release it in any
 * case. */
enum ceduo_status ceduo_prepared_init(struct prepared *to, const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      size_t cells, const double *cell_x);
void ceduo_prepared_release(struct prepared *p);

/* Rock `number` of a run, of its own size. What ceduo_rock_draw() says. */
enum ceduo_status ceduo_prepared_rock(const struct prepared *ready, uint64_t number, struct ceduo_rock *rock);

#endif
