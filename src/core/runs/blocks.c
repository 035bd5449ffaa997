/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/blocks.h"

#include <math.h>

#include "base/elementary.h"

#include "ceduo/assess.h"

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

#define EFFORT_MOST 5e6 /* of any size: a page is not waited for */

/* Below so many rocks a size is left out: their share would say nothing. */
#define FEWEST 10

/* Of a size whose rocks meet so many times the stems of the scene's own not even the first is simulated. */
#define TIMES_MOST 100

/* How many rocks a size may have, by what those so far cost in contacts and stems drawn. */
static uint64_t affordable(const struct ceduo_run *run, uint64_t rocks, double most)
{
    double effort = (double)ceduo_run_contacts(run) + (double)ceduo_run_stems(run).drawn;
    double n = effort > 0 ? most / effort * (double)ceduo_run_rocks(run) : INFINITY;
    return (double)rocks < n ? rocks : (uint64_t)n;
}

/* One rock, then four times as many each time: the first may stop where the others go on. What cannot be paid is left out. */
static enum ceduo_status fly_block(const struct ceduo_scene *scene, const struct ceduo_option *option, size_t control,
                                   uint64_t rocks, double effort, unsigned threads, const atomic_bool *cancel,
                                   struct ceduo_block *b)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.option = option;
    def.threads = threads;
    def.rocks_most = rocks;
    def.cancel = cancel;
    def.arrivals_only = true;
    struct ceduo_run *run;
    enum ceduo_status status = ceduo_run_create(&def, &run);
    if (status != CEDUO_OK)
        return status;
    uint64_t most = rocks;
    for (uint64_t n = 1; n > ceduo_run_rocks(run) && status == CEDUO_OK; n = n < most ? n : most) {
        status = ceduo_run_extend(run, n);
        most = affordable(run, rocks, effort);
        n *= 4;
    }
    if (status == CEDUO_OK && ceduo_run_rocks(run) >= (rocks < FEWEST ? rocks : FEWEST))
        status = ceduo_run_arrivals(run, control, &b->arrivals);
    ceduo_run_free(run);
    return status;
}

/* The volumes to show, rising: `own` in its place. */
static void sort_volumes(double own, struct ceduo_block blocks[CEDUO_BLOCKS])
{
    static const double volumes[CEDUO_BLOCKS - 1] = {0.05, 0.2, 1, 5};
    size_t n = 0;
    bool placed = false;
    for (size_t i = 0; i < CEDUO_BLOCKS - 1; i++) {
        if (!placed && own <= volumes[i]) {
            blocks[n++] = (struct ceduo_block){.volume = own, .own = true};
            placed = true;
        }
        blocks[n++] = (struct ceduo_block){.volume = volumes[i]};
    }
    if (!placed)
        blocks[n] = (struct ceduo_block){.volume = own, .own = true};
}

enum ceduo_status ceduo_blocks(const struct ceduo_scene *scene, const struct ceduo_option *option, size_t control,
                               uint64_t rocks, double effort, const struct ceduo_arrivals *own, unsigned threads,
                               const atomic_bool *cancel, struct ceduo_block blocks[CEDUO_BLOCKS])
{
    struct ceduo_rock mean, rock;
    enum ceduo_status status = ceduo_rock_of_means(&scene->rock, &mean);
    if (status != CEDUO_OK)
        return status;
    sort_volumes(mean.volume, blocks);
    effort = fmin(effort, EFFORT_MOST);
    double contacts = ceduo_assess_index(scene, option, &scene->controls[control], NAN).contacts;
    bool flies = scene->simulation.contact_model != CEDUO_INDEX;
    for (size_t i = 0; i < CEDUO_BLOCKS && status == CEDUO_OK; i++) {
        struct ceduo_block *b = &blocks[i];
        struct ceduo_scene other = *scene;
        other.blocks_count = 0;
        if (!b->own)
            other.rock = ceduo_rock_scaled(&scene->rock, ceduo_cbrt(b->volume / mean.volume));
        status = ceduo_rock_of_means(&other.rock, &rock);
        if (status != CEDUO_OK)
            break;
        struct ceduo_index index = ceduo_assess_index(&other, option, &scene->controls[control], NAN);
        b->mass = rock.mass;
        b->diameter = rock.mean_diameter;
        b->adc = index.worst_adc;
        b->contacts = index.contacts;
        if (flies && b->own && own && own->released >= rocks && scene->blocks_count == 0)
            b->arrivals = *own;
        else if (flies && index.contacts <= TIMES_MOST * contacts)
            status = fly_block(&other, option, control, rocks, effort, threads, cancel, b);
    }
    return status;
}
