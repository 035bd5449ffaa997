/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/way.h"

#include <stdlib.h>
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

struct ceduo_follower {
    const struct ceduo_scene *scene;
    struct ceduo_rock mean;
    struct ground ground;
    struct marks marks;
};

struct ceduo_follower *ceduo_follower_create(const struct ceduo_scene *scene)
{
    struct ceduo_follower *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->scene = scene;
    bool good = ceduo_rock_of_means(&scene->rock, &f->mean) == CEDUO_OK && ceduo_marks_init(&f->marks, scene, 0, NULL) &&
                ceduo_ground_init(&f->ground, &scene->slope, scene->simulation.gravity, f->mean.radius,
                                  ceduo_rock_varies(&scene->rock));
    if (good)
        return f;
    ceduo_follower_free(f);
    return NULL;
}

enum ceduo_status ceduo_follower_follow(const struct ceduo_follower *f, uint64_t rock,
                                        void (*visit)(void *context, const struct ceduo_piece *piece), void *context,
                                        struct ceduo_way *way, struct ceduo_crossing *crossings)
{
    struct watcher watcher = {visit, context, &f->marks, crossings};
    struct walker w = {.visit = watch_piece, .cross = watch_crossing, .context = &watcher};
    if (crossings)
        memset(crossings, 0, f->scene->controls_count * sizeof *crossings);
    enum ceduo_status status = ceduo_walk_release(&w, f->scene, &f->ground, &f->marks, &f->mean, rock);
    if (status != CEDUO_OK)
        return status;
    *way = (struct ceduo_way){.rock = w.rock,
                              .x0 = w.at.x,
                              .z0 = w.at.z,
                              .vx0 = w.at.vx,
                              .vz0 = w.at.vz,
                              .spin0 = w.spin};
    way->end = ceduo_walk(&w, f->scene->simulation.law);
    way->x = w.at.x;
    way->z = w.at.z;
    way->contacts = w.contacts;
    return CEDUO_OK;
}

void ceduo_follower_free(struct ceduo_follower *f)
{
    if (!f)
        return;
    ceduo_ground_release(&f->ground);
    ceduo_marks_release(&f->marks);
    free(f);
}

enum ceduo_status ceduo_way_follow(const struct ceduo_scene *scene, uint64_t rock,
                                   void (*visit)(void *context, const struct ceduo_piece *piece), void *context,
                                   struct ceduo_way *way, struct ceduo_crossing *crossings)
{
    struct ceduo_rock mean;
    if (ceduo_rock_of_means(&scene->rock, &mean) != CEDUO_OK)
        return CEDUO_BAD_ROCK;
    struct ceduo_follower *f = ceduo_follower_create(scene);
    if (!f)
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = ceduo_follower_follow(f, rock, visit, context, way, crossings);
    ceduo_follower_free(f);
    return status;
}

double ceduo_way_facet_draw(uint64_t seed, uint64_t rock, uint64_t contact)
{
    return random_pair(seed, rock, contact >> 1, RANDOM_FACET).u[contact & 1];
}
