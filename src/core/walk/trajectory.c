/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "prepared.h"
#include "walk.h"

struct crossing_writer {
    const struct marks *marks;
    struct ceduo_crossing *crossings;
};

static void store_crossing(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *crossing)
{
    (void)w;
    struct crossing_writer *crossing_writer = context;
    if (crossing_writer->crossings)
        crossing_writer->crossings[crossing_writer->marks->items[mark].control] = *crossing;
}

struct ceduo_tracer {
    struct prepared_scene prepared;
    struct stems *stems;
};

struct ceduo_tracer *ceduo_tracer_create(const struct ceduo_scene *scene, const struct ceduo_option *option)
{
    struct ceduo_tracer *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    if (ceduo_prepared_init(&f->prepared, scene, option) == CEDUO_OK &&
        (f->stems = ceduo_stems_create(&f->prepared.forest, CEDUO_KERNEL_BEST)))
        return f;
    ceduo_tracer_free(f);
    return NULL;
}

enum ceduo_status ceduo_tracer_run(struct ceduo_tracer *f, uint64_t rock, const struct ceduo_trajectory_callbacks *callbacks,
                                   struct ceduo_trajectory *to, struct ceduo_crossing *crossings)
{
    const struct ceduo_scene *scene = &f->prepared.scene;
    struct crossing_writer crossing_writer = {&f->prepared.marks, crossings};
    struct walker w = {.callbacks = callbacks,
                       .cross = store_crossing,
                       .context = &crossing_writer,
                       .stems = f->prepared.forest.bare ? NULL : f->stems};
    if (crossings)
        memset(crossings, 0, scene->controls_count * sizeof *crossings);
    enum ceduo_status status = ceduo_walk_release(&w, &f->prepared, rock);
    if (status != CEDUO_OK)
        return status;
    *to = (struct ceduo_trajectory){
        .rock = w.rock, .x0 = w.flight.x, .z0 = w.flight.z, .vx0 = w.flight.vx, .vz0 = w.flight.vz, .spin0 = w.spin};
    to->end = ceduo_walk(&w, scene->simulation.law);
    to->x = w.flight.x;
    to->z = w.flight.z;
    to->contacts = w.contacts;
    to->stems_hit = w.stems_hit;
    to->stools_met = w.stools_met;
    to->stems_drawn = w.stems ? w.stems->drawn : 0;
    if (f->stems->no_memory) /* also for stems that the rock does not reach */
        return CEDUO_NO_MEMORY;
    return w.cancelled ? CEDUO_CANCELLED : CEDUO_OK;
}

void ceduo_tracer_free(struct ceduo_tracer *f)
{
    if (!f)
        return;
    ceduo_stems_free(f->stems);
    ceduo_prepared_release(&f->prepared);
    free(f);
}

enum ceduo_status ceduo_trajectory_run(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rock,
                                       const struct ceduo_trajectory_callbacks *callbacks, struct ceduo_trajectory *to,
                                       struct ceduo_crossing *crossings)
{
    if (isnan(ceduo_rock_mean(&scene->rock).mass))
        return CEDUO_BAD_ROCK;
    struct ceduo_tracer *f = ceduo_tracer_create(scene, option);
    if (!f)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = ceduo_tracer_run(f, rock, callbacks, to, crossings);
    ceduo_tracer_free(f);
    return status;
}
