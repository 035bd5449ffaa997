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

bool ceduo_other_option(const struct ceduo_option *option, struct ceduo_option *other)
{
    enum ceduo_energy_model law = ceduo_other_law(option);
    *other = *option;
    other->belts = calloc(option->belts_count + 1, sizeof *other->belts);
    if (!other->belts)
        return false;
    for (size_t i = 0; i < option->belts_count; i++) {
        other->belts[i] = option->belts[i];
        other->belts[i].stand.energy = law;
    }
    return true;
}

void ceduo_other_release(struct ceduo_option *other)
{
    free(other->belts);
    other->belts = NULL;
}

bool ceduo_other_scene(const struct ceduo_scene *scene, struct ceduo_scene *other)
{
    *other = *scene;
    other->options = calloc(scene->options_count + 1, sizeof *other->options);
    bool good = other->options != NULL;
    for (size_t i = 0; good && i < scene->options_count; i++)
        good = ceduo_other_option(&scene->options[i], &other->options[i]);
    return good;
}

void ceduo_other_scene_release(struct ceduo_scene *other)
{
    for (size_t i = 0; other->options && i < other->options_count; i++)
        ceduo_other_release(&other->options[i]);
    free(other->options);
    *other = (struct ceduo_scene){0};
}

static bool has_stems(const struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++)
        if (!ceduo_stand_is_bare(&option->belts[i].stand))
            return true;
    return false;
}

struct ceduo_other_energy ceduo_other_read(const struct ceduo_option *option, const struct ceduo_run *run,
                                           const struct ceduo_run *first, size_t control)
{
    struct ceduo_other_energy other = {.known = run && ceduo_run_rocks(run) > 0,
                                       .stems = has_stems(option),
                                       .model = ceduo_other_law(option)};
    if (!other.known)
        return other;
    struct ceduo_brief brief = ceduo_run_brief(run, control);
    other.reach_probability = brief.reach_probability;
    other.exceed_probability = brief.exceed_probability;
    other.energy = brief.energy;
    other.to_first = ceduo_run_difference(run, first, control);
    return other;
}
