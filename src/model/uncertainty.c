/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "jobs.h"

#include <stdlib.h>

#include "base/language.h"

const char *ceduo_uncertainty_no_rotation(const struct ceduo_scene *scene)
{
    if (scene->simulation.contact_model == CEDUO_INDEX)
        return N_("not computed: by the index years have no doubt");
    for (size_t i = 0; i < scene->options_count; i++)
        if (ceduo_window_in(scene, &scene->options[i]).kind != CEDUO_WINDOW_ALIKE)
            return NULL;
    return N_("not computed: all years are alike");
}

enum ceduo_status ceduo_uncertainty_make(const struct scene_file *file, size_t option, size_t level, unsigned threads,
                                         const atomic_bool *cancel, struct uncertainty *u)
{
    *u = (struct uncertainty){.file = *file, .level = level};
    enum ceduo_status status = ceduo_inputs_of(&u->file, &u->inputs) ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (u->file.scene.controls_count == 0)
        u->inputs.n = 0;
    if (level == 0 && u->file.scene.options_count == 1)
        u->level = UNCERTAINTY_LEVELS - 1;
    u->last = u->inputs.n == 0 ||
              u->level + 1 == (ceduo_uncertainty_no_rotation(&u->file.scene) ? UNCERTAINTY_LEVELS : UNCERTAINTY_ROTATION);
    const struct ceduo_doubt_def def = {.scene = &u->file.scene,
                                        .inputs_count = u->inputs.n,
                                        .inputs = u->inputs.items,
                                        .points = CEDUO_DOUBT_POINTS,
                                        .rocks = CEDUO_DOUBT_ROCKS,
                                        .rotation = u->level + 1 == UNCERTAINTY_ROTATION,
                                        .alone = u->level == 0,
                                        .option = option,
                                        .threads = threads,
                                        .cancel = cancel};
    return status == CEDUO_OK && u->inputs.n > 0 ? ceduo_doubt_ask(&def, &u->answer) : status;
}

void ceduo_uncertainty_free(void *uncertainty)
{
    struct uncertainty *u = uncertainty;
    if (u->answer.figures)
        ceduo_doubt_free(&u->answer);
    ceduo_arena_free(&u->file.arena);
    free(u);
}
