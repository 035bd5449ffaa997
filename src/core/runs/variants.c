/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/variants.h"

#include <stdlib.h>

#include "ceduo/key.h"

/* What decides about the trajectories of a variant. */
struct variant_key {
    uint64_t scene, forest;
};

enum ceduo_status ceduo_variants_run(const struct ceduo_variants *all)
{
    struct variant_key *keys = calloc(all->n + 1, sizeof *keys);
    enum ceduo_status status = keys ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0, first; i < all->n && status == CEDUO_OK; i++) {
        struct ceduo_variant variant = {0};
        status = all->make(all->context, i, &variant);
        if (status != CEDUO_OK || variant.skip)
            continue;
        first = i;
        if (all->same) {
            keys[i].scene = ceduo_scene_key(variant.run.scene);
            keys[i].forest = variant.run.option ? ceduo_option_key(variant.run.scene, variant.run.option) : 0;
            variant.run.option = keys[i].forest != 0 ? variant.run.option : NULL;
            for (first = 0; keys[first].scene != keys[i].scene || keys[first].forest != keys[i].forest;)
                first++;
        }
        if (first < i) {
            all->same(all->context, i, first);
            continue;
        }
        struct ceduo_run *run = NULL;
        status = all->pool ? ceduo_pool_run(all->pool, variant.run.option, &run) : ceduo_run_create(&variant.run, &run);
        uint64_t rocks = variant.rocks;
        for (bool again = true; again && status == CEDUO_OK;) {
            uint64_t more = rocks;
            status = ceduo_run_extend(run, rocks);
            if (status == CEDUO_OK)
                status = all->read(all->context, i, run, &more);
            again = more > rocks;
            rocks = more;
        }
        if (!all->pool)
            ceduo_run_free(run);
    }
    free(keys);
    return status;
}
