/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --shard: a part of the run of a scene. */
#include <stdlib.h>

#include "base/clock.h"
#include "base/intl.h"
#include "batch.h"
#include "io/part_file.h"

enum exit_status ceduo_batch_shard(const struct arguments *a, const char *path, const struct shelf *shelf,
                                   const struct scene_file *file, size_t place, struct text *out)
{
    struct progress progress = ceduo_progress_begin(a);
    const struct ceduo_question q = ceduo_batch_question(a, file, &progress);
    struct part part = {.scene = (char *)(uintptr_t)path, /* only read */
                        .shard = a->shard,
                        .shards = a->shards,
                        .place = place,
                        .rocks = q.rocks,
                        .key = ceduo_part_key(file, q.rocks)};
    const struct part_inputs inputs = {.path = path,
                                       .sets = a->sets,
                                       .options = a->options,
                                       .sets_count = a->sets_count,
                                       .options_count = a->options_count,
                                       .shelf = *shelf};
    unsigned char *runs, *texts = NULL;
    enum ceduo_status status = ceduo_ask_part(&q, a->shard, a->shards, &runs, &part.runs_length);
    ceduo_progress_end(&progress);
    part.seconds = ceduo_clock() - progress.start;
    if (status == CEDUO_OK && part.key == 0)
        status = CEDUO_NO_MEMORY;
    if (status == CEDUO_OK && part.shard == 1 && !(texts = ceduo_part_inputs(&inputs, &part.inputs_length)))
        status = CEDUO_NO_MEMORY;
    part.runs = runs;
    part.inputs = texts;
    if (status == CEDUO_OK)
        ceduo_part_write(out, &part);
    free(runs);
    free(texts);
    return status == CEDUO_OK ? EXIT_DONE : ceduo_batch_failed(file, status);
}
