/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/trajectory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "prepared.h"
#include "walk.h"

struct noter {
    const struct marks *marks;
    struct ceduo_crossing *crossings;
};

static void note_crossing(void *context, const struct walker *w, size_t mark, const struct ceduo_crossing *crossing)
{
    (void)w;
    struct noter *noter = context;
    if (noter->crossings)
        noter->crossings[noter->marks->at[mark].what] = *crossing;
}

struct ceduo_tracer {
    struct prepared ready;
    struct stems stems;
};

struct ceduo_tracer *ceduo_tracer_create(const struct ceduo_scene *scene, const struct ceduo_option *option)
{
    struct ceduo_tracer *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    if (ceduo_prepared_init(&f->ready, scene, option) == CEDUO_OK &&
        ceduo_stems_init(&f->stems, &f->ready.wood, CEDUO_KERNEL_BEST))
        return f;
    ceduo_tracer_free(f);
    return NULL;
}

enum ceduo_status ceduo_tracer_run(struct ceduo_tracer *f, uint64_t rock, const struct ceduo_trajectory_callbacks *watch,
                                   struct ceduo_trajectory *to, struct ceduo_crossing *crossings)
{
    const struct ceduo_scene *scene = &f->ready.scene;
    struct noter noter = {&f->ready.marks, crossings};
    struct walker w = {
        .watch = watch, .cross = note_crossing, .context = &noter, .stems = f->ready.wood.bare ? NULL : &f->stems};
    if (crossings)
        memset(crossings, 0, scene->controls_count * sizeof *crossings);
    enum ceduo_status status = ceduo_walk_release(&w, &f->ready, rock);
    if (status != CEDUO_OK)
        return status;
    *to =
        (struct ceduo_trajectory){.rock = w.rock, .x0 = w.at.x, .z0 = w.at.z, .vx0 = w.at.vx, .vz0 = w.at.vz, .spin0 = w.spin};
    to->end = ceduo_walk(&w, scene->simulation.law);
    to->x = w.at.x;
    to->z = w.at.z;
    to->contacts = w.contacts;
    to->stems_hit = w.stems_hit;
    to->stools_met = w.stools_met;
    to->stems_drawn = w.stems ? w.stems->drawn : 0;
    if (f->stems.no_memory) /* be it for stems that the rock does not come to */
        return CEDUO_NO_MEMORY;
    return w.cancelled ? CEDUO_CANCELLED : CEDUO_OK;
}

void ceduo_tracer_free(struct ceduo_tracer *f)
{
    if (!f)
        return;
    ceduo_stems_release(&f->stems);
    ceduo_prepared_release(&f->ready);
    free(f);
}

enum ceduo_status ceduo_trajectory_follow(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rock,
                                          const struct ceduo_trajectory_callbacks *watch, struct ceduo_trajectory *to,
                                          struct ceduo_crossing *crossings)
{
    if (isnan(ceduo_rock_mean(&scene->rock).mass))
        return CEDUO_BAD_ROCK;
    struct ceduo_tracer *f = ceduo_tracer_create(scene, option);
    if (!f)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = ceduo_tracer_run(f, rock, watch, to, crossings);
    ceduo_tracer_free(f);
    return status;
}
