/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inputs.h"
#include "scene/derived.h"
#include "scene/stand.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
#include "scene/value.h"

#define CUT 3 /* normal and gamma inputs are truncated at this normal score */

struct input_place {
    struct value value;
    double given; /* value of the scene as given, in the unit of files */
};

struct ceduo_input ceduo_input_default(void)
{
    return (struct ceduo_input){.kind = CEDUO_INPUT_RANGE, .hi = 1};
}

/* ---- the copy ---- */

/* Replace *items by a copy of n items. */
static void copy_items(struct arena *arena, void *items, size_t n, size_t size)
{
    void *from, *to = ceduo_arena_alloc(arena, n * size + 1);
    memcpy(&from, items, sizeof from);
    if (to && n > 0)
        memcpy(to, from, n * size);
    memcpy(items, &to, sizeof to);
}

static void copy_stand(struct arena *arena, struct ceduo_stand *stand)
{
    copy_items(arena, &stand->shoots, stand->shoots_count, sizeof *stand->shoots);
    copy_items(arena, &stand->trees, stand->trees_count, sizeof *stand->trees);
}

/* Copy everything that an input may change. */
static bool copy_scene(struct arena *arena, struct ceduo_scene *scene)
{
    struct ceduo_slope *s = &scene->slope;
    copy_items(arena, &s->x, s->vertices, sizeof *s->x);
    copy_items(arena, &s->z, s->vertices, sizeof *s->z);
    copy_items(arena, &s->segments, s->vertices - 1, sizeof *s->segments);
    copy_items(arena, &scene->controls, scene->controls_count, sizeof *scene->controls);
    copy_items(arena, &scene->options, scene->options_count, sizeof *scene->options);
    for (size_t i = 0; !arena->failed && i < scene->options_count; i++) {
        struct ceduo_option *option = &scene->options[i];
        copy_items(arena, &option->belts, option->belts_count, sizeof *option->belts);
        for (size_t k = 0; !arena->failed && k < option->belts_count; k++)
            copy_stand(arena, &option->belts[k].stand);
    }
    copy_items(arena, &scene->releases, scene->releases_count, sizeof *scene->releases);
    copy_items(arena, &scene->blocks, scene->blocks_count, sizeof *scene->blocks);
    for (size_t i = 0; !arena->failed && i < scene->blocks_count; i++)
        copy_items(arena, &scene->blocks[i].volumes, scene->blocks[i].volumes_count, sizeof(double));
    return !arena->failed;
}

/* Remove per_stool of shoots whose per_ha is an input. */
static void drop_per_stool(struct input_scene *copy, const char *place)
{
    const char *key = strrchr(place, '.');
    struct text path = {0};
    struct value value;
    if (!key || strcmp(key, ".per_ha") != 0)
        return;
    ceduo_text_format(&path, "%.*s.per_stool", (int)(key - place), place);
    if (path.bytes && ceduo_value_find(&copy->scene, path.bytes, &value))
        ceduo_value_forget(&value);
    copy->arena.failed |= path.failed;
    ceduo_text_free(&path);
}

enum ceduo_status ceduo_inputs_open(struct input_scene *copy, const struct ceduo_scene *scene, const struct ceduo_input *inputs,
                                    size_t n)
{
    size_t places = 0;
    *copy = (struct input_scene){.scene = *scene, .given = scene, .inputs = inputs, .inputs_count = n};
    for (size_t i = 0; i < n; i++)
        places += inputs[i].places_count;
    copy->places = ceduo_arena_alloc(&copy->arena, (places + 1) * sizeof *copy->places);
    if (!copy_scene(&copy->arena, &copy->scene))
        return CEDUO_NO_MEMORY;
    struct input_place *p = copy->places;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < inputs[i].places_count; k++, p++) {
            if (!ceduo_value_find(&copy->scene, inputs[i].places[k], &p->value))
                return CEDUO_BAD_PLACE;
            p->given = ceduo_value_get(&p->value);
            drop_per_stool(copy, inputs[i].places[k]);
        }
    return copy->arena.failed ? CEDUO_NO_MEMORY : CEDUO_OK;
}

void ceduo_inputs_release(struct input_scene *copy)
{
    ceduo_arena_free(&copy->arena);
}

bool ceduo_input_affects(const struct ceduo_input *input, size_t option)
{
    for (size_t i = 0; i < input->places_count; i++) {
        const char *place = input->places[i];
        if (strncmp(place, "options[", 8) != 0 || strtoul(place + 8, NULL, 10) == option)
            return true;
    }
    return false;
}

bool ceduo_input_is_future(const struct ceduo_input *input)
{
    for (size_t i = 0; i < input->places_count; i++) {
        const struct field *f = ceduo_schema_at(input->places[i]);
        if (!f || !(f->flags & FIELD_YEARS) || f->choices)
            return false;
    }
    return true;
}

/* ---- setting ---- */

double ceduo_input_quantile(const struct ceduo_input *input, double u)
{
    GSL_RETURNS_ERRORS;
    double tail = gsl_cdf_ugaussian_P(-CUT), p = tail + u * (1 - 2 * tail), ratio = input->sd / input->mean;
    if (input->kind == CEDUO_INPUT_NORMAL)
        return input->mean + input->sd * gsl_cdf_ugaussian_Pinv(p);
    if (input->kind == CEDUO_INPUT_GAMMA)
        return gsl_cdf_gamma_Pinv(p, 1 / (ratio * ratio), input->mean * (ratio * ratio));
    return input->lo + u * (input->hi - input->lo);
}

static double place_value(const struct ceduo_input *input, size_t k, const struct input_place *place, double u)
{
    switch (input->kind) {
    case CEDUO_INPUT_FACTOR:
        return place->given * ceduo_input_quantile(input, u);
    case CEDUO_INPUT_WORDS:
        return input->words[(size_t)fmin(u * (double)input->words_count, (double)(input->words_count - 1))];
    case CEDUO_INPUT_DRAWS:
        return input->draws[k][(size_t)fmin(u * (double)input->draws_count, (double)(input->draws_count - 1))];
    default:
        return ceduo_input_quantile(input, u);
    }
}

/* Set a value, clamped to its range; NaN: not given. */
static void set_value(const struct value *value, double number)
{
    const struct field *f = value->field;
    if (f->type == FIELD_COUNT)
        number = round(number);
    if (isnan(number))
        ceduo_value_forget(value);
    else if (!ceduo_value_set(value, number))
        ceduo_value_set(value, fmin(fmax(number, nextafter(f->lo, INFINITY)), nextafter(f->hi, -INFINITY)));
}

static void limit_stools(struct ceduo_scene *scene)
{
    for (size_t i = 0; i < scene->options_count; i++)
        for (size_t k = 0; k < scene->options[i].belts_count; k++) {
            struct ceduo_stand *stand = &scene->options[i].belts[k].stand;
            ceduo_stand_update_shoot_density(stand);
            if (stand->shoots_count > 0) /* stools just cut have no shoots, and live on */
                stand->stools_per_ha = fmin(stand->stools_per_ha, ceduo_stand_shoots(stand));
        }
}

/* Restore the densities that the last ceduo_inputs_set() derived. */
static void restore_stools(struct input_scene *copy)
{
    for (size_t i = 0; i < copy->scene.options_count; i++)
        for (size_t k = 0; k < copy->scene.options[i].belts_count; k++) {
            struct ceduo_stand *stand = &copy->scene.options[i].belts[k].stand;
            const struct ceduo_stand *given = &copy->given->options[i].belts[k].stand;
            stand->stools_per_ha = given->stools_per_ha;
            for (size_t s = 0; s < stand->shoots_count; s++)
                stand->shoots[s].per_ha = given->shoots[s].per_ha;
        }
}

void ceduo_inputs_set(struct input_scene *copy, const double *u)
{
    const struct input_place *p = copy->places;
    restore_stools(copy);
    for (size_t i = 0; i < copy->inputs_count; i++)
        for (size_t k = 0; k < copy->inputs[i].places_count; k++, p++)
            set_value(&p->value, isnan(u[i]) ? p->given : place_value(&copy->inputs[i], k, p, u[i]));
    limit_stools(&copy->scene);
    ceduo_scene_average_releases(&copy->scene);
}
