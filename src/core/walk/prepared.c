/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "prepared.h"
#include "scene/derived.h"
#include "scene/rock.h"
#include "scene/slope.h"

#include <math.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "base/random.h"

/* ---- sizes of blocks ---- */

#define GOLDEN 0x9E3779B97F4A7C15u /* 2^64 over the golden ratio */

bool ceduo_sizes_init(struct sizes *s, const struct ceduo_scene *scene)
{
    uint64_t bits[2];
    *s = (struct sizes){.n = scene->blocks_count};
    if (s->n == 0)
        return true;
    random_bits(scene->simulation.seed, 0, 0, RANDOM_SIZE, bits);
    s->start = bits[0];
    s->classes = calloc(s->n, sizeof *s->classes);
    if (!s->classes)
        return false;
    for (size_t i = 0; i < s->n; i++) {
        const struct ceduo_size_class *b = &scene->blocks[i];
        double from = ceduo_log(b->volumes[0]), length = ceduo_log(b->volumes[1]) - from;
        double at_start = b->exponent > 0 ? b->exponent / (1 - ceduo_exp(-b->exponent * length)) : 1 / length; /* density */
        s->classes[i] = (struct size_class){from, length, b->exponent, b->per_year * at_start};
        s->length += length;
        s->per_year += b->per_year;
    }
    for (size_t i = 0; i < s->n; i++)
        s->classes[i].weight *= s->length / s->per_year;
    return true;
}

void ceduo_sizes_release(struct sizes *s)
{
    free(s->classes);
}

struct size ceduo_rock_size(const struct sizes *s, uint64_t rock)
{
    uint64_t place = s->start + rock * GOLDEN;
    double along = ((double)(place >> 11) * 0x1p-53 + 0x1p-54) * s->length;
    size_t i = 0;
    for (; i + 1 < s->n && along >= s->classes[i].length; i++)
        along -= s->classes[i].length;
    const struct size_class *c = &s->classes[i];
    return (struct size){ceduo_exp(c->from + along), c->weight * ceduo_exp(-c->exponent * along)};
}

bool ceduo_rock_is_typical(const struct sizes *s, uint64_t seed, uint64_t rock)
{
    double max = 0;
    for (size_t i = 0; i < s->n; i++)
        max = s->classes[i].weight > max ? s->classes[i].weight : max;
    return random_pair(seed, rock, 1, RANDOM_SIZE).u[0] * max < ceduo_rock_size(s, rock).weight;
}

void ceduo_rock_resize(struct ceduo_rock *rock, double volume)
{
    double factor = ceduo_cbrt(volume / rock->volume);
    rock->mass *= volume / rock->volume;
    rock->volume = volume;
    rock->mean_diameter *= factor;
    for (size_t i = 0; i < 3; i++)
        rock->axes[i] *= factor;
    rock->radius = rock->mean_diameter / 2;
    rock->moment = rock->k * rock->mass * rock->radius * rock->radius;
}

/* ---- scenes ---- */

static int by_x(const void *a, const void *b)
{
    const struct mark *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->control > q->control) - (p->control < q->control);
}

static bool make_marks(struct marks *marks, const struct ceduo_scene *scene)
{
    size_t n = marks->n = scene->controls_count;
    marks->items = malloc((n + 1) * sizeof *marks->items);
    if (!marks->items)
        return false;
    for (size_t i = 0; i < n; i++)
        marks->items[i] = (struct mark){scene->controls[i].x, ceduo_slope_height(&scene->slope, scene->controls[i].x), i};
    qsort(marks->items, n, sizeof *marks->items, by_x);
    return true;
}

enum ceduo_status ceduo_prepared_init(struct prepared_scene *to, const struct ceduo_scene *scene,
                                      const struct ceduo_option *option)
{
    *to = (struct prepared_scene){.scene = *scene, .varies = ceduo_rock_varies(&scene->rock)};
    enum ceduo_status status = ceduo_rock_from_means(&scene->rock, &to->mean);
    if (status != CEDUO_OK)
        return status;
    status = ceduo_slope_simplify(&scene->slope, scene->release.x.mean, &to->simplified);
    if (status != CEDUO_OK)
        return status;
    if (to->simplified.x)
        to->scene.slope = to->simplified;
    bool good = ceduo_sizes_init(&to->sizes, scene) && ceduo_forest_init(&to->forest, &scene->simulation, option, &to->mean) &&
                make_marks(&to->marks, &to->scene) &&
                ceduo_ground_init(&to->ground, &to->scene.slope, scene->simulation.gravity, to->mean.radius,
                                  ceduo_scene_rock_varies(scene));
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

struct ceduo_topography ceduo_prepared_topography(const struct prepared_scene *prepared, size_t control)
{
    const struct ceduo_scene *scene = &prepared->scene;
    return ceduo_slope_topography(&scene->slope, scene->release.x.mean, scene->release.height.mean, scene->controls[control].x);
}

enum ceduo_status ceduo_prepared_rock(const struct prepared_scene *prepared, uint64_t number, struct ceduo_rock *rock)
{
    const struct ceduo_rock_def *def = &prepared->scene.rock;
    enum ceduo_status status = CEDUO_OK;
    *rock = prepared->mean;
    if (prepared->varies) {
        double u[8];
        for (uint64_t i = 0; i < 8; i++)
            u[i] = random_open(prepared->scene.simulation.seed, number, i, RANDOM_ROCK);
        status = ceduo_rock_draw(def, u, rock);
    }
    if (prepared->sizes.n > 0)
        ceduo_rock_resize(rock, ceduo_rock_size(&prepared->sizes, number).volume);
    return status;
}

void ceduo_prepared_release(struct prepared_scene *p)
{
    ceduo_sizes_release(&p->sizes);
    ceduo_forest_release(&p->forest);
    free(p->marks.items);
    ceduo_ground_release(&p->ground);
    ceduo_slope_simplified_release(&p->simplified);
}
