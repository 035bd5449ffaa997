/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/blocks.h"

#include <math.h>

#include "base/elementary.h"
#include "ceduo/assess.h"
#include "ceduo/variants.h"
#include "check.h"

static struct ceduo_number scaled(struct ceduo_number n, double factor)
{
    n.mean *= factor;
    n.spread *= factor;
    return n;
}

struct ceduo_rock_def ceduo_rock_scaled(const struct ceduo_rock_def *def, double factor)
{
    struct ceduo_rock_def to = *def;
    double cube = factor * factor * factor;
    to.diameter = scaled(def->diameter, factor);
    to.height = scaled(def->height, factor);
    for (int i = 0; i < 3; i++)
        to.axes[i] = scaled(def->axes[i], factor);
    to.volume = scaled(def->volume, cube);
    to.mass = scaled(def->mass, cube);
    return to;
}

#define EFFORT_MAX 5e6 /* of any size: a page is not waited for */

/* Below so many rocks a size is left out: their share would say nothing. */
#define FEWEST 10

/* Of a size whose rocks meet so many times the stems of the scene's own not even the first is simulated. */
#define TIMES_MAX 100

/* Sizes as variants of a scene. */
struct sizes_run {
    const struct ceduo_blocks_def *def;
    struct ceduo_size_result *blocks;
    struct ceduo_scene scene; /* with the size at hand */
    double volume, contacts;  /* of the scene's own rock */
};

static enum ceduo_status make_size(void *context, size_t i, struct ceduo_variant *variant)
{
    struct sizes_run *r = context;
    const struct ceduo_blocks_def *def = r->def;
    struct ceduo_size_result *b = &r->blocks[i];
    struct ceduo_rock rock;
    r->scene = *def->scene;
    r->scene.blocks_count = 0;
    if (!b->own)
        r->scene.rock = ceduo_rock_scaled(&def->scene->rock, ceduo_cbrt(b->volume / r->volume));
    enum ceduo_status status = ceduo_rock_of_means(&r->scene.rock, &rock);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_index index = ceduo_assess_index(&r->scene, def->option, &def->scene->controls[def->control], NAN);
    b->mass = rock.mass;
    b->diameter = rock.mean_diameter;
    b->adc = index.worst_adc;
    b->contacts = index.contacts;
    bool simulates = def->scene->simulation.contact_model != CEDUO_INDEX;
    bool known = b->own && def->own && def->own->released >= def->rocks && def->scene->blocks_count == 0;
    if (simulates && known)
        b->arrivals = *def->own;
    variant->skip = !simulates || known || index.contacts > TIMES_MAX * r->contacts;
    variant->rocks = 1;
    variant->run = ceduo_run_def_default(&r->scene);
    variant->run.option = def->option;
    variant->run.threads = def->threads;
    variant->run.rocks_most = def->rocks;
    variant->run.cancel = def->cancel;
    variant->run.arrivals_only = true;
    return CEDUO_OK;
}

/* One rock, then four times as many each time: the first may stop where the others go on. What cannot be paid is left out. */
static enum ceduo_status read_size(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    struct sizes_run *r = context;
    const struct ceduo_blocks_def *def = r->def;
    double effort = (double)ceduo_run_contacts(run) + (double)ceduo_run_stems(run).drawn, max = fmin(def->effort, EFFORT_MAX);
    double n = effort > 0 ? max / effort * (double)ceduo_run_rocks(run) : INFINITY; /* by what those so far cost */
    uint64_t affordable = (double)def->rocks < n ? def->rocks : (uint64_t)n;
    *rocks = 4 * *rocks < affordable ? 4 * *rocks : affordable;
    if (*rocks > ceduo_run_rocks(run) || ceduo_run_rocks(run) < (def->rocks < FEWEST ? def->rocks : FEWEST))
        return CEDUO_OK;
    return ceduo_run_arrivals(run, def->control, &r->blocks[i].arrivals);
}

struct ceduo_blocks_def ceduo_blocks_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_blocks_def){.scene = scene,
                                     .option = scene->options,
                                     .control = ceduo_scene_last_control(scene),
                                     .rocks = scene->simulation.rocks,
                                     .effort = INFINITY,
                                     .threads = 1};
}

enum ceduo_status ceduo_blocks(const struct ceduo_blocks_def *def, struct ceduo_size_result blocks[CEDUO_SIZES])
{
    static const double volumes[CEDUO_SIZES - 1] = {0.05, 0.2, 1, 5};
    struct ceduo_rock mean;
    size_t own = 0; /* its place among them, which rise */
    enum ceduo_status status = ceduo_check_blocks_def(def);
    if (status == CEDUO_OK)
        status = ceduo_rock_of_means(&def->scene->rock, &mean);
    if (status != CEDUO_OK)
        return status;
    while (own < CEDUO_SIZES - 1 && !(mean.volume <= volumes[own]))
        own++;
    for (size_t i = 0; i < CEDUO_SIZES; i++)
        blocks[i] = (struct ceduo_size_result){.volume = i == own ? mean.volume : volumes[i - (i > own)], .own = i == own};
    struct sizes_run r = {.def = def, .blocks = blocks, .volume = mean.volume};
    r.contacts = ceduo_assess_index(def->scene, def->option, &def->scene->controls[def->control], NAN).contacts;
    return ceduo_variants_run(
        &(const struct ceduo_variants){.n = CEDUO_SIZES, .make = make_size, .read = read_size, .context = &r});
}
