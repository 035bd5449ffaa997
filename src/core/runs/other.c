/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/other.h"

#include <stdlib.h>

enum ceduo_energy_model ceduo_other_law(const struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        if (!ceduo_stand_is_bare(stand) && stand->energy != CEDUO_DORREN)
            return CEDUO_DORREN;
    }
    return CEDUO_BRAUNER;
}

bool ceduo_other_scene(const struct ceduo_scene *scene, struct ceduo_scene *other)
{
    *other = *scene;
    other->options = calloc(scene->options_count + 1, sizeof *other->options);
    bool good = other->options != NULL;
    for (size_t i = 0; good && i < scene->options_count; i++) {
        const struct ceduo_option *option = &scene->options[i];
        struct ceduo_option *to = &other->options[i];
        *to = *option;
        to->belts = calloc(option->belts_count + 1, sizeof *to->belts);
        good = to->belts != NULL;
        for (size_t k = 0; good && k < option->belts_count; k++) {
            to->belts[k] = option->belts[k];
            to->belts[k].stand.energy = ceduo_other_law(option);
        }
    }
    return good;
}

void ceduo_other_scene_release(struct ceduo_scene *other)
{
    for (size_t i = 0; other->options && i < other->options_count; i++)
        free(other->options[i].belts);
    free(other->options);
    *other = (struct ceduo_scene){0};
}

enum ceduo_status ceduo_other_read(const struct ceduo_option *option, const struct ceduo_run *run,
                                   const struct ceduo_run *first, size_t control, struct ceduo_other_energy *other)
{
    *other = (struct ceduo_other_energy){.known = run && ceduo_run_rocks(run) > 0, .model = ceduo_other_law(option)};
    for (size_t i = 0; i < option->belts_count; i++)
        other->stems |= !ceduo_stand_is_bare(&option->belts[i].stand);
    if (!other->known)
        return CEDUO_OK;
    other->to_first = ceduo_run_difference(run, first, control);
    return ceduo_run_arrivals(run, control, &other->arrivals);
}
