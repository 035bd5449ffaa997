/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "doubted.h"

#include <stdlib.h>

static const struct {
    size_t points, first;
    uint64_t rocks;
} levels[DOUBT_LEVELS] = {{8, 4, 100}, {32, 8, 400}, {64, 32, 1000}};

enum ceduo_status ceduo_doubted_make(const struct scene_file *file, size_t level, unsigned threads, const atomic_bool *cancel,
                                     struct doubted **doubted)
{
    struct scene_file own = *file;
    struct doubted *d = calloc(1, sizeof *d);
    *doubted = NULL;
    if (!d) {
        ceduo_arena_free(&own.arena);
        return CEDUO_NO_MEMORY;
    }
    *d = (struct doubted){.file = own, .points = levels[level].points, .rocks = levels[level].rocks, .level = level};
    enum ceduo_status status = ceduo_inputs_of(&d->file, &d->inputs) ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (d->file.scene.controls_count == 0)
        d->inputs.n = 0;
    const struct ceduo_doubt_def def = {.scene = &d->file.scene,
                                        .inputs_count = d->inputs.n,
                                        .inputs = d->inputs.items,
                                        .points = d->points,
                                        .first = levels[level].first,
                                        .rocks = d->rocks,
                                        .threads = threads,
                                        .cancel = cancel};
    if (status == CEDUO_OK && d->inputs.n > 0)
        status = ceduo_doubt_ask(&def, &d->answer);
    if (status == CEDUO_OK)
        *doubted = d;
    else
        ceduo_doubted_free(d);
    return status;
}

void ceduo_doubted_free(struct doubted *d)
{
    if (!d)
        return;
    if (d->answer.figures)
        ceduo_doubt_free(&d->answer);
    ceduo_arena_free(&d->file.arena);
    free(d);
}
