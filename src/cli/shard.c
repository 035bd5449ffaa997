/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --shard: a part of the run of a scene. */
#include <stdlib.h>

#include "batch.h"
#include "ceduo/part.h"
#include "interrupt.h"
#include "base/intl.h"
#include "io/part_file.h"

/* The line of a part whose runs are done. */
static enum ceduo_status add_line(const struct ceduo_pool *pool, const struct part_inputs *inputs, struct part *part,
                                  struct text *out)
{
    unsigned char *runs = NULL, *texts = NULL;
    enum ceduo_status status = ceduo_pool_save(pool, &runs, &part->runs_length);
    if (status == CEDUO_OK && part->shard == 1 && !(texts = ceduo_part_inputs(inputs, &part->inputs_length)))
        status = CEDUO_NO_MEMORY;
    part->runs = runs;
    part->inputs = texts;
    if (status == CEDUO_OK)
        ceduo_part_write(out, part);
    free(runs);
    free(texts);
    return status;
}

enum exit_status ceduo_batch_shard(const struct arguments *a, const char *path, const struct shelf *shelf,
                                   const struct scene_file *file, size_t place, struct text *out)
{
    uint64_t end;
    struct ceduo_run_def def = ceduo_run_def_default(&file->scene);
    def.threads = a->threads;
    def.rocks_most = ceduo_batch_rocks(a, file);
    def.cancel = ceduo_interrupt_flag();
    def.part = true;
    ceduo_part_range(def.rocks_most, a->shard, a->shards, &def.first, &end);
    struct progress progress = ceduo_progress_begin(a, def.first);
    def.progress = ceduo_progress_show;
    def.context = &progress;
    struct ceduo_pool *pool;
    enum ceduo_status status = ceduo_pool_create(&def, &pool);
    if (status == CEDUO_OK)
        status = ceduo_pool_fill(pool);
    if (status == CEDUO_OK)
        status = ceduo_pool_extend(pool, end);
    ceduo_progress_end(&progress);
    struct part part = {.scene = (char *)(uintptr_t)path, /* only read */
                        .shard = a->shard,
                        .shards = a->shards,
                        .place = place,
                        .rocks = def.rocks_most,
                        .key = ceduo_part_key(file, def.rocks_most),
                        .seconds = ceduo_batch_now() - progress.start};
    const struct part_inputs inputs = {.path = path,
                                       .sets = a->sets,
                                       .options = a->options,
                                       .sets_count = a->sets_count,
                                       .options_count = a->options_count,
                                       .shelf = *shelf};
    if (status == CEDUO_OK)
        status = add_line(pool, &inputs, &part, out);
    if (status != CEDUO_OK && status != CEDUO_CANCELLED)
        ceduo_batch_complain(file->path, status == CEDUO_NO_MEMORY ? _("out of memory") : _("cannot be computed"));
    ceduo_pool_free(pool);
    return status == CEDUO_OK ? EXIT_DONE : EXIT_RUN;
}
