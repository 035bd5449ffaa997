/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <stdlib.h>

#include "alternative_law.h"
#include "run.h"
#include "run_state.h"
#include "scene/stand.h"

enum ceduo_energy_model ceduo_alternative_law(const struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        if (!ceduo_stand_is_bare(stand) && stand->energy != CEDUO_ENERGY_MODEL_DORREN)
            return CEDUO_ENERGY_MODEL_DORREN;
    }
    return CEDUO_ENERGY_MODEL_BRAUNER;
}

bool ceduo_alternative_scene(const struct ceduo_scene *scene, struct ceduo_scene *alternative)
{
    size_t n = scene->options_count, belts = 0;
    for (size_t i = 0; i < n; i++)
        belts += scene->options[i].belts_count;
    *alternative = *scene;
    alternative->options = calloc(1, (n + 1) * sizeof *alternative->options + belts * sizeof(struct ceduo_belt));
    if (!alternative->options)
        return false;
    struct ceduo_belt *to = (void *)(alternative->options + n + 1); /* after the options */
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_option *option = &scene->options[i];
        alternative->options[i] = *option;
        alternative->options[i].belts = to;
        for (size_t k = 0; k < option->belts_count; k++) {
            *to = option->belts[k];
            to++->stand.energy = ceduo_alternative_law(option);
        }
    }
    return true;
}

void ceduo_alternative_scene_release(struct ceduo_scene *alternative)
{
    free(alternative->options);
    *alternative = (struct ceduo_scene){0};
}

enum ceduo_status ceduo_alternative_read(const struct ceduo_scene *scene, size_t index, const struct ceduo_run *run,
                                         const struct ceduo_run *first, size_t control,
                                         struct ceduo_alternative_energy *alternative)
{
    const struct ceduo_option *option = &scene->options[index];
    *alternative =
        (struct ceduo_alternative_energy){.known = run && ceduo_run_rocks(run) > 0, .model = ceduo_alternative_law(option)};
    for (size_t i = 0; i < option->belts_count; i++)
        alternative->stems |= !ceduo_stand_is_bare(&option->belts[i].stand);
    if (!alternative->known)
        return CEDUO_OK;
    alternative->to_first = ceduo_run_difference(run, first, control);
    enum ceduo_status status = ceduo_run_arrivals(run, control, &alternative->arrivals);
    if (status == CEDUO_OK)
        ceduo_arrivals_set_limit(&alternative->arrivals, scene, control);
    return status;
}
