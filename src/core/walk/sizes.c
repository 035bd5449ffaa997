/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sizes.h"

#include <stdlib.h>

#include "base/elementary.h"
#include "random.h"

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
        const struct ceduo_block_class *b = &scene->blocks[i];
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

struct size ceduo_size_of(const struct sizes *s, uint64_t rock)
{
    uint64_t place = s->start + rock * GOLDEN;
    double along = ((double)(place >> 11) * 0x1p-53 + 0x1p-54) * s->length;
    size_t i = 0;
    for (; i + 1 < s->n && along >= s->classes[i].length; i++)
        along -= s->classes[i].length;
    const struct size_class *c = &s->classes[i];
    return (struct size){ceduo_exp(c->from + along), c->weight * ceduo_exp(-c->exponent * along)};
}

bool ceduo_size_is_typical(const struct sizes *s, uint64_t seed, uint64_t rock)
{
    double most = 0;
    for (size_t i = 0; i < s->n; i++)
        most = s->classes[i].weight > most ? s->classes[i].weight : most;
    return random_pair(seed, rock, 1, RANDOM_SIZE).u[0] * most < ceduo_size_of(s, rock).weight;
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
