/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <stdlib.h>

#include "key.h"
#include "pool.h"
#include "run.h"
#include "variants.h"

/* Keys of the trajectories of a variant. */
struct variant_key {
    uint64_t scene, forest;
};

enum ceduo_status ceduo_variants_run(const struct ceduo_variants *variants)
{
    struct variant_key *keys = calloc(variants->n + 1, sizeof *keys);
    enum ceduo_status status = keys ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0, first; i < variants->n && status == CEDUO_OK; i++) {
        struct ceduo_variant variant = {0};
        status = variants->make(variants->context, i, &variant);
        if (status != CEDUO_OK || variant.skip)
            continue;
        first = i;
        if (variants->same) {
            keys[i].scene = ceduo_scene_key(variant.run.scene);
            keys[i].forest = variant.run.option ? ceduo_option_key(variant.run.scene, variant.run.option) : 0;
            variant.run.option = keys[i].forest != 0 ? variant.run.option : NULL;
            for (first = 0; keys[first].scene != keys[i].scene || keys[first].forest != keys[i].forest;)
                first++;
        }
        if (first < i) {
            variants->same(variants->context, i, first);
            continue;
        }
        struct ceduo_run *run = NULL;
        status =
            variants->pool ? ceduo_pool_run(variants->pool, variant.run.option, &run) : ceduo_run_create(&variant.run, &run);
        uint64_t rocks = variant.rocks;
        for (bool extend = true; extend && status == CEDUO_OK;) {
            uint64_t wanted = rocks;
            status = ceduo_run_extend(run, rocks);
            if (status == CEDUO_OK)
                status = variants->read(variants->context, i, run, &wanted);
            extend = wanted > rocks;
            rocks = wanted;
        }
        if (!variants->pool)
            ceduo_run_free(run);
    }
    free(keys);
    return status;
}
