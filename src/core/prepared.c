/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "prepared.h"

enum ceduo_status ceduo_prepared_init(struct prepared *to, const struct ceduo_scene *scene,
                                      const struct ceduo_option *option, size_t cells, const double *cell_x)
{
    *to = (struct prepared){.scene = *scene};
    enum ceduo_status status = ceduo_rock_of_means(&scene->rock, &to->mean);
    if (status != CEDUO_OK)
        return status;
    bool good = ceduo_wood_init(&to->wood, &scene->simulation, option, to->mean.mean_diameter) &&
                ceduo_marks_init(&to->marks, scene, cells, cell_x) &&
                ceduo_ground_init(&to->ground, &scene->slope, scene->simulation.gravity, to->mean.radius,
                                  ceduo_rock_varies(&scene->rock));
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

void ceduo_prepared_release(struct prepared *p)
{
    ceduo_wood_release(&p->wood);
    ceduo_marks_release(&p->marks);
    ceduo_ground_release(&p->ground);
}
