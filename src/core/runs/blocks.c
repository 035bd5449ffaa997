/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "assess.h"
#include "base/elementary.h"
#include "blocks.h"
#include "check.h"
#include "run.h"
#include "scene/derived.h"
#include "scene/rock.h"
#include "scene/schema.h"
#include "variants.h"

static struct ceduo_number scale_number(struct ceduo_number n, double factor)
{
    n.mean *= factor;
    n.spread *= factor;
    return n;
}

struct ceduo_rock_def ceduo_rock_scaled(const struct ceduo_rock_def *def, double factor)
{
    struct ceduo_rock_def to = *def;
    double cube = factor * factor * factor;
    to.diameter = scale_number(def->diameter, factor);
    to.height = scale_number(def->height, factor);
    for (int i = 0; i < 3; i++)
        to.axes[i] = scale_number(def->axes[i], factor);
    to.volume = scale_number(def->volume, cube);
    to.mass = scale_number(def->mass, cube);
    return to;
}

#define EFFORT_MAX 5e6 /* per size; keeps report pages fast */

/* Minimum number of rocks; with fewer a size is skipped, because their share is meaningless. */
#define ROCKS_MIN 10

/* A size is skipped if its rocks meet more than this times the stems of the scene's own rock. */
#define STEMS_RATIO_MAX 100

/* Sizes as variants of a scene. */
struct sizes_run {
    const struct ceduo_sizes_def *def;
    struct ceduo_size_result *blocks;
    struct ceduo_scene scene; /* with the current size */
    double volume, contacts;  /* of the scene's own rock */
};

static enum ceduo_status make_size(void *context, size_t i, struct ceduo_variant *variant)
{
    struct sizes_run *r = context;
    const struct ceduo_sizes_def *def = r->def;
    struct ceduo_size_result *b = &r->blocks[i];
    struct ceduo_rock rock;
    r->scene = *def->scene;
    r->scene.blocks_count = 0;
    if (!b->own)
        r->scene.rock = ceduo_rock_scaled(&def->scene->rock, ceduo_cbrt(b->volume / r->volume));
    enum ceduo_status status = ceduo_rock_from_means(&r->scene.rock, &rock);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_index index = ceduo_assess_index(&r->scene, def->option, &def->scene->controls[def->control], NAN);
    b->mass = rock.mass;
    b->diameter = rock.mean_diameter;
    b->adc = index.worst_adc;
    b->contacts = index.contacts;
    bool simulates = def->scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    bool reuses_run = b->own && def->own && def->own->released >= def->rocks && def->scene->blocks_count == 0;
    if (simulates && reuses_run)
        b->arrivals = *def->own;
    variant->skip = !simulates || reuses_run || index.contacts > STEMS_RATIO_MAX * r->contacts;
    variant->rocks = 1;
    variant->run = ceduo_run_def_default(&r->scene);
    variant->run.option = def->option;
    variant->run.threads = def->threads;
    variant->run.rocks_max = def->rocks;
    variant->run.cancel = def->cancel;
    variant->run.arrivals_only = true;
    return CEDUO_OK;
}

/* Simulate one rock, then four times as many each time, because the first may be untypical. Skip sizes over the work limit. */
static enum ceduo_status read_size(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    struct sizes_run *r = context;
    const struct ceduo_sizes_def *def = r->def;
    double effort = (double)ceduo_run_contacts(run) + (double)ceduo_run_stems(run).drawn, max = fmin(def->effort, EFFORT_MAX);
    double n = effort > 0 ? max / effort * (double)ceduo_run_rocks(run) : INFINITY; /* by the work per rock so far */
    uint64_t affordable = (double)def->rocks < n ? def->rocks : (uint64_t)n;
    *rocks = 4 * *rocks < affordable ? 4 * *rocks : affordable;
    if (*rocks > ceduo_run_rocks(run) || ceduo_run_rocks(run) < (def->rocks < ROCKS_MIN ? def->rocks : ROCKS_MIN))
        return CEDUO_OK;
    return ceduo_run_arrivals(run, def->control, &r->blocks[i].arrivals);
}

struct ceduo_sizes_def ceduo_sizes_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_sizes_def){.scene = scene,
                                    .option = scene->options,
                                    .control = ceduo_scene_last_control(scene),
                                    .rocks = scene->simulation.rocks,
                                    .effort = INFINITY,
                                    .threads = 1};
}

/* As the functions of check.h. */
static enum ceduo_status check_sizes_def(const struct ceduo_sizes_def *def)
{
    enum ceduo_status status = ceduo_scene_check(def->scene, NULL);
    if (status != CEDUO_OK)
        return status;
    bool good = def->option && def->control < def->scene->controls_count && def->rocks <= CEDUO_ROCKS_MAX &&
                def->threads <= CEDUO_THREADS_MAX;
    return good ? ceduo_check_stands(def->option) : CEDUO_BAD_ARGUMENT;
}

enum ceduo_status ceduo_sizes_simulate(const struct ceduo_sizes_def *def, struct ceduo_size_result blocks[CEDUO_SIZES])
{
    static const double volumes[CEDUO_SIZES - 1] = {0.05, 0.2, 1, 5};
    struct ceduo_rock mean;
    size_t own = 0; /* index among the sorted volumes */
    enum ceduo_status status = check_sizes_def(def);
    if (status == CEDUO_OK)
        status = ceduo_rock_from_means(&def->scene->rock, &mean);
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
