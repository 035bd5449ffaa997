/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "uncertainty.h"

#include "base/must.h"

static const struct {
    size_t points;
    uint64_t rocks;
    bool rotation;
} levels[UNCERTAINTY_ROTATION] = {
    {64, 100, false}, {CEDUO_DOUBT_POINTS, CEDUO_DOUBT_ROCKS, false}, {CEDUO_DOUBT_POINTS, CEDUO_DOUBT_ROCKS, true}};

enum ceduo_status ceduo_uncertainty_make(const struct scene_file *file, size_t level, unsigned threads,
                                         const atomic_bool *cancel, struct uncertainty **uncertainty)
{
    struct uncertainty *u = ceduo_must(calloc(1, sizeof *u));
    *u = (struct uncertainty){.file = *file, .points = levels[level].points, .rocks = levels[level].rocks, .level = level};
    enum ceduo_status status = ceduo_inputs_of(&u->file, &u->inputs) ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (u->file.scene.controls_count == 0)
        u->inputs.n = 0;
    const struct ceduo_doubt_def def = {.scene = &u->file.scene,
                                        .inputs_count = u->inputs.n,
                                        .inputs = u->inputs.items,
                                        .points = u->points,
                                        .rocks = u->rocks,
                                        .rotation = levels[level].rotation,
                                        .threads = threads,
                                        .cancel = cancel};
    if (status == CEDUO_OK && u->inputs.n > 0)
        status = ceduo_doubt_ask(&def, &u->answer);
    *uncertainty = u;
    if (status != CEDUO_OK) {
        ceduo_uncertainty_free(u);
        *uncertainty = NULL;
    }
    return status;
}

void ceduo_uncertainty_free(struct uncertainty *u)
{
    if (u->answer.figures)
        ceduo_doubt_free(&u->answer);
    ceduo_arena_free(&u->file.arena);
    free(u);
}
