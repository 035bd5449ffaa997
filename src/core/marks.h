/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MARKS_H
#define CEDUO_MARKS_H

#include <stdbool.h>

#include "ceduo/scene.h"

/* Places, rising along x, where something is noted of a rock's first passage going +x: the scene's controls and the
 * cells of the envelopes. */
struct marks {
    size_t n;
    double *x, *z; /* m; z: the ground */
    size_t *what;  /* a control's index, or the number of controls plus a cell's */
};

/* False without memory. */
bool ceduo_marks_init(struct marks *marks, const struct ceduo_scene *scene, size_t cells, const double *cell_x);
void ceduo_marks_release(struct marks *marks);

#endif
