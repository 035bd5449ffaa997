/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run_key.h"

#include <stddef.h>
#include <string.h>

static void mix(uint64_t *key, uint64_t value)
{
    for (int i = 0; i < 8; i++)
        *key = (*key ^ (value >> (8 * i) & 0xff)) * 1099511628211u;
}

static void mix_double(uint64_t *key, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    mix(key, bits);
}

static void mix_number(uint64_t *key, const struct ceduo_number *n)
{
    mix_double(key, n->mean);
    mix_double(key, n->spread);
    mix(key, n->spread > 0 ? (uint64_t)n->kind : 0);
}

static void mix_slope(uint64_t *key, const struct ceduo_slope *s)
{
    mix(key, (uint64_t)s->facets);
    mix(key, s->vertices);
    for (size_t i = 0; i < s->vertices; i++) {
        mix_double(key, s->x[i]);
        mix_double(key, s->z[i]);
    }
    for (size_t i = 0; i + 1 < s->vertices; i++) {
        mix_number(key, &s->segments[i].rn);
        mix_number(key, &s->segments[i].rt);
        mix_double(key, s->segments[i].roughness_m);
        mix_double(key, s->segments[i].roughness_rad);
        mix_double(key, s->segments[i].friction);
    }
}

uint64_t ceduo_run_key(const struct ceduo_scene *scene)
{
    uint64_t key = 14695981039346656037u;
    const struct ceduo_rock_def *r = &scene->rock;
    const struct ceduo_number *const numbers[] = {
        &r->diameter,       &r->height,           &r->volume,          &r->mass,
        &r->density,        &r->axes[0],          &r->axes[1],         &r->axes[2],
        &scene->release.x,  &scene->release.height, &scene->release.vx, &scene->release.vz,
        &scene->release.spin};
    mix(&key, (uint64_t)r->shape);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        mix_number(&key, numbers[i]);
    mix_slope(&key, &scene->slope);
    for (size_t i = 0; i < scene->controls_count; i++) {
        mix_double(&key, scene->controls[i].x);
        mix_double(&key, scene->controls[i].accepted);
    }
    mix(&key, (uint64_t)scene->simulation.law);
    mix(&key, scene->simulation.seed);
    mix_double(&key, scene->simulation.gravity);
    mix(&key, scene->simulation.scale_rn);
    return key;
}
