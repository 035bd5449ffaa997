/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/scene.h"

#include <math.h>

enum ceduo_status ceduo_scene_check(const struct ceduo_scene *scene, size_t *where)
{
    struct ceduo_rock rock;
    enum ceduo_status status = ceduo_rock_of_means(&scene->rock, &rock);
    for (size_t i = 0; i < scene->blocks_count && status == CEDUO_OK; i++) {
        const struct ceduo_block_class *b = &scene->blocks[i];
        bool volumes = b->volumes_count == 2 && b->volumes[0] > 0 && b->volumes[1] > b->volumes[0];
        status = volumes && b->per_year > 0 && b->exponent >= 0 ? CEDUO_OK : CEDUO_BAD_ROCK;
    }
    if (status == CEDUO_OK)
        status = ceduo_slope_check(&scene->slope);
    if (status != CEDUO_OK)
        return status;
    double end = scene->slope.x[scene->slope.vertices - 1];
    double first = ceduo_number_lowest(scene->release.x), last = ceduo_number_highest(scene->release.x);
    if (!(first >= 0) || !(last < end))
        return CEDUO_RELEASE_OFF_SLOPE;
    if (!(ceduo_number_lowest(scene->release.height) >= 0))
        return CEDUO_RELEASE_BELOW;
    for (size_t i = 0; i < scene->controls_count; i++) {
        if (where)
            *where = i;
        if (!(scene->controls[i].x <= end))
            return CEDUO_CONTROL_OFF_SLOPE;
        if (!(scene->controls[i].x > last))
            return CEDUO_CONTROL_BEHIND;
    }
    return CEDUO_OK;
}

bool ceduo_scene_rock_varies(const struct ceduo_scene *scene)
{
    return scene->blocks_count > 0 || ceduo_rock_varies(&scene->rock);
}

double ceduo_option_stems_from(const struct ceduo_option *option)
{
    double from = INFINITY;
    for (size_t i = 0; i < option->belts_count; i++)
        if (option->belts[i].from < from && !ceduo_stand_is_bare(&option->belts[i].stand))
            from = option->belts[i].from;
    return from;
}

size_t ceduo_scene_last_control(const struct ceduo_scene *scene)
{
    size_t last = 0;
    for (size_t c = 1; c < scene->controls_count; c++)
        if (scene->controls[c].x > scene->controls[last].x)
            last = c;
    return last;
}
