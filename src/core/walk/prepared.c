/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "prepared.h"

#include <math.h>
#include <stdlib.h>

#include "envelope.h"
#include "random.h"

static int by_x(const void *a, const void *b)
{
    const struct mark *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->what > q->what) - (p->what < q->what);
}

/* The controls, and the cells. */
static bool make_marks(struct marks *marks, const struct ceduo_scene *scene, size_t cells, const double *cell_x)
{
    size_t n = scene->controls_count, room = cells + ENVELOPE_VECTOR;
    marks->at = malloc((n + 1) * sizeof *marks->at);
    marks->cell_x = malloc(2 * room * sizeof *marks->cell_x);
    if (!marks->at || !marks->cell_x)
        return false;
    marks->n = n;
    for (size_t i = 0; i < n; i++)
        marks->at[i] = (struct mark){scene->controls[i].x, ceduo_slope_height(&scene->slope, scene->controls[i].x), i};
    qsort(marks->at, n, sizeof *marks->at, by_x);
    marks->cells = cells;
    marks->cell_z = marks->cell_x + room;
    for (size_t i = 0; i < room; i++) {
        marks->cell_x[i] = i < cells ? cell_x[i] : NAN;
        marks->cell_z[i] = i < cells ? ceduo_slope_height(&scene->slope, cell_x[i]) : NAN;
    }
    return true;
}

enum ceduo_status ceduo_prepared_init(struct prepared *to, const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      size_t cells, const double *cell_x)
{
    *to = (struct prepared){.scene = *scene, .varies = ceduo_rock_varies(&scene->rock)};
    enum ceduo_status status = ceduo_rock_of_means(&scene->rock, &to->mean);
    if (status != CEDUO_OK)
        return status;
    bool good = ceduo_sizes_init(&to->sizes, scene) && ceduo_wood_init(&to->wood, &scene->simulation, option, &to->mean) &&
                make_marks(&to->marks, scene, cells, cell_x) &&
                ceduo_ground_init(&to->ground, &scene->slope, scene->simulation.gravity, to->mean.radius,
                                  ceduo_scene_rock_varies(scene));
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

enum ceduo_status ceduo_prepared_rock(const struct prepared *ready, uint64_t number, struct ceduo_rock *rock)
{
    const struct ceduo_rock_def *def = &ready->scene.rock;
    enum ceduo_status status = CEDUO_OK;
    *rock = ready->mean;
    if (ready->varies) {
        double u[8];
        for (uint64_t i = 0; i < 8; i++)
            u[i] = random_open(ready->scene.simulation.seed, number, i, RANDOM_ROCK);
        status = ceduo_rock_draw(def, u, rock);
    }
    if (ready->sizes.n > 0)
        ceduo_rock_resize(rock, ceduo_size_of(&ready->sizes, number).volume);
    return status;
}

void ceduo_prepared_release(struct prepared *p)
{
    ceduo_sizes_release(&p->sizes);
    ceduo_wood_release(&p->wood);
    free(p->marks.at);
    free(p->marks.cell_x);
    ceduo_ground_release(&p->ground);
}
