/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/key.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define START 14695981039346656037u

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

uint64_t ceduo_scene_key(const struct ceduo_scene *scene)
{
    uint64_t key = START;
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

/* ---- forests ---- */

/* What a hit takes goes in by what a hit of the mean stem takes. */
static void mix_stems(uint64_t *key, const struct ceduo_stand *stand, const struct ceduo_stems *s)
{
    mix_double(key, s->per_ha);
    mix_double(key, s->dbh);
    mix_double(key, s->dbh_sd);
    mix_double(key, s->height);
    mix_double(key, ceduo_contact_energy(stand, s));
    mix(key, s->dbh_sd > 0 ? (uint64_t)(int64_t)stand->species : 0);
    mix(key, s->dbh_sd > 0 && !isnan(s->volume));
}

static void mix_stand(uint64_t *key, const struct ceduo_stand *s)
{
    mix(key, (uint64_t)s->energy);
    mix(key, s->shoots_count);
    mix(key, s->trees_count);
    if (s->shoots_count > 0) {
        mix_double(key, s->stools_per_ha);
        mix_double(key, s->spacing);
    }
    for (size_t i = 0; i < s->shoots_count; i++)
        mix_stems(key, s, &s->shoots[i]);
    for (size_t i = 0; i < s->trees_count; i++)
        mix_stems(key, s, &s->trees[i]);
}

uint64_t ceduo_option_key(const struct ceduo_simulation *simulation, const struct ceduo_option *option)
{
    uint64_t key = START;
    size_t stems = 0;
    mix(&key, (uint64_t)simulation->contact_model);
    mix(&key, simulation->contact_model == CEDUO_POISSON ? (uint64_t)simulation->rule : 0);
    for (size_t i = 0; option && simulation->contact_model != CEDUO_INDEX && i < option->belts_count; i++) {
        const struct ceduo_belt *b = &option->belts[i];
        if (ceduo_stand_is_bare(&b->stand))
            continue;
        mix_double(&key, b->from);
        mix_double(&key, b->to);
        mix_stand(&key, &b->stand);
        stems++;
    }
    return stems > 0 ? key : 0;
}

/* ---- years ---- */

static void mix_curve(uint64_t *key, const struct ceduo_curve *c)
{
    mix_double(key, c->dbh_most);
    mix_double(key, c->dbh_rate);
    mix_double(key, c->height_most);
    mix_double(key, c->height_rate);
}

static void mix_future(uint64_t *key, const struct ceduo_stand *s)
{
    mix_curve(key, &s->growth.shoots);
    mix_curve(key, &s->growth.trees);
    mix_double(key, s->growth.shoots_young);
    mix_double(key, s->growth.shoots_old);
    mix_double(key, s->growth.sdi_most);
    mix(key, s->cutting.rotation);
    mix(key, s->cutting.cohorts);
    mix(key, s->cutting.stay_count);
    for (size_t i = 0; i < s->cutting.stay_count; i++)
        mix_double(key, s->cutting.stay_per_ha[i]);
    for (size_t i = 0; i < s->shoots_count; i++)
        mix_double(key, s->shoots[i].age);
    for (size_t i = 0; i < s->trees_count; i++)
        mix_double(key, s->trees[i].age);
    mix(key, (uint64_t)(int64_t)s->species);
}

uint64_t ceduo_years_key(const struct ceduo_option *option)
{
    uint64_t key = START;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *b = &option->belts[i];
        mix_double(&key, b->from);
        mix_double(&key, b->to);
        mix_double(&key, b->cut_year);
        mix_stand(&key, &b->stand);
        mix_future(&key, &b->stand);
    }
    return key;
}
