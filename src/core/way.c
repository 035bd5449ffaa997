/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/way.h"

#include <string.h>

#include "walk.h"

struct watcher {
    void (*visit)(void *context, const struct ceduo_piece *piece);
    void *context;
    const struct marks *marks;
    struct ceduo_crossing *crossings;
};

static void watch_piece(void *context, const struct ceduo_piece *piece)
{
    struct watcher *watcher = context;
    if (watcher->visit)
        watcher->visit(watcher->context, piece);
}

static void watch_crossing(void *context, size_t mark, const struct ceduo_crossing *crossing)
{
    struct watcher *watcher = context;
    if (watcher->crossings)
        watcher->crossings[watcher->marks->what[mark]] = *crossing;
}

enum ceduo_status ceduo_way_follow(const struct ceduo_scene *scene, uint64_t rock,
                                   void (*visit)(void *context, const struct ceduo_piece *piece), void *context,
                                   struct ceduo_way *way, struct ceduo_crossing *crossings)
{
    struct ceduo_rock mean;
    enum ceduo_status status = ceduo_rock_of_means(&scene->rock, &mean);
    if (status != CEDUO_OK)
        return status;
    struct ground ground;
    struct marks marks;
    if (!ceduo_marks_init(&marks, scene, 0, NULL))
        return CEDUO_NO_MEMORY;
    if (!ceduo_ground_init(&ground, &scene->slope, scene->simulation.gravity, mean.radius,
                           ceduo_rock_varies(&scene->rock))) {
        ceduo_marks_release(&marks);
        return CEDUO_NO_MEMORY;
    }
    struct watcher watcher = {visit, context, &marks, crossings};
    struct walker w = {.visit = watch_piece, .cross = watch_crossing, .context = &watcher};
    if (crossings)
        memset(crossings, 0, scene->controls_count * sizeof *crossings);
    status = ceduo_walk_release(&w, scene, &ground, &marks, &mean, rock);
    if (status == CEDUO_OK) {
        *way = (struct ceduo_way){.rock = w.rock,
                                  .x0 = w.at.x,
                                  .z0 = w.at.z,
                                  .vx0 = w.at.vx,
                                  .vz0 = w.at.vz,
                                  .spin0 = w.spin};
        way->end = ceduo_walk(&w, scene->simulation.law);
        way->x = w.at.x;
        way->z = w.at.z;
        way->contacts = w.contacts;
    }
    ceduo_ground_release(&ground);
    ceduo_marks_release(&marks);
    return status;
}

double ceduo_way_facet_draw(uint64_t seed, uint64_t rock, uint64_t contact)
{
    return random_pair(seed, rock, contact >> 1, RANDOM_FACET).u[contact & 1];
}
