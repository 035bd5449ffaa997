/* SPDX-License-Identifier: GPL-3.0-or-later */

#include "key.h"
#include "base/hash.h"
#include "core/forest/forest.h"
#include "scene/derived.h"
#include "scene/schema.h"

/* Ground, rock, release and controls are hashed by the table of keys, so that a new row is in the key unless a flag excludes
 * it. A forest is hashed in its prepared form. */

#define NOT_HASHED (FIELD_NO_MEMBER | FIELD_FILE_ONLY | FIELD_FOREST | FIELD_NO_RUN)

/* Hash the members of `object` that affect future years, or that affect trajectories now. */
static void hash_fields(uint64_t *key, const struct object *object, const char *item, bool years)
{
    for (const struct field *f = object->fields; f < object->fields + object->n; f++) {
        bool nested = f->type == FIELD_GROUP || f->type == FIELD_LIST;
        if (f->flags & NOT_HASHED || (!nested && !(f->flags & FIELD_YEARS) == years))
            continue;
        const char *member = item + (f->flags & FIELD_PLACE && f->type == FIELD_NUMBER ? f->companion_offset : f->offset);
        const struct ceduo_number *numbers = (const void *)member;
        uint64_t word = 0;
        size_t n;
        char *items;
        double *doubles, number;
        memcpy(&n, item + f->companion_offset, sizeof n);
        switch (f->type) { /* untaken: table */
        case FIELD_GROUP:
            hash_fields(key, f->object, member, years);
            break;
        case FIELD_LIST:
            memcpy(&items, member, sizeof items);
            hash_count(key, n);
            for (size_t i = 0; i < n; i++)
                hash_fields(key, f->object, items + i * f->object->size, years);
            break;
        case FIELD_NUMBERS:
        case FIELD_POINTS:
            hash_count(key, n);
            for (size_t k = 0; k < f->size; k += sizeof doubles) {
                memcpy(&doubles, member + k, sizeof doubles);
                hash_doubles(key, doubles, n);
            }
            break;
        case FIELD_NUMBER:
            memcpy(&number, member, sizeof number);
            hash_double(key, number);
            break;
        case FIELD_SPREAD:
        case FIELD_SPREADS:
            for (size_t i = 0; i < f->size / sizeof *numbers; i++) {
                hash_double(key, numbers[i].mean);
                hash_double(key, numbers[i].spread);
                hash_count(key, numbers[i].spread > 0 ? (uint64_t)numbers[i].kind : 0);
            }
            break;
        case FIELD_COUNT:
        case FIELD_CHOICE:
        case FIELD_FLAG:
            memcpy(&word, member, f->size);
            hash_count(key, word);
            break;
        /* pointers: fields.h excludes such rows */
        case FIELD_TAG:   /* untaken: table */
        case FIELD_TEXT:  /* untaken: table */
        case FIELD_FILE:  /* untaken: table */
        case FIELD_WORDS: /* untaken: table */
            break;
        }
    }
}

uint64_t ceduo_scene_key(const struct ceduo_scene *original)
{
    uint64_t key = HASH_START;
    struct ceduo_scene scene = *original; /* with the simulated profile; without memory the key differs */
    struct ceduo_slope simplified;
    ceduo_scene_average_releases(&scene);
    /* untaken: memory */
    if (ceduo_slope_simplify(&original->slope, scene.release.x.mean, &simplified) == CEDUO_OK && simplified.x)
        scene.slope = simplified;
    hash_fields(&key, ceduo_schema_scene(), (const char *)&scene, false);
    for (size_t i = 0; i + 1 < scene.slope.vertices; i++)
        hash_fields(&key, ceduo_schema_segment(), (const char *)&scene.slope.segments[i], false);
    ceduo_slope_simplified_release(&simplified);
    return key;
}

uint64_t ceduo_controls_key(const struct ceduo_scene *scene)
{
    uint64_t key = HASH_START;
    for (size_t i = 0; i < scene->controls_count; i++) {
        const struct ceduo_control *c = &scene->controls[i];
        const double parts[] = {c->fence.height, c->fence.energy, c->fence.life, ceduo_accepted_return(c)};
        hash_doubles(&key, parts, sizeof parts / sizeof parts[0]);
    }
    hash_count(&key, ceduo_design_is_requested(&scene->design));
    return key;
}

uint64_t ceduo_option_key(const struct ceduo_scene *scene, const struct ceduo_option *option)
{
    uint64_t key = HASH_START;
    return ceduo_forest_hash(&key, &scene->simulation, option) ? key : 0;
}

uint64_t ceduo_years_key(const struct ceduo_option *option)
{
    uint64_t key = HASH_START;
    const struct ceduo_simulation stems = {.contact_model = CEDUO_CONTACT_MODEL_STEMS};
    ceduo_forest_hash(&key, &stems, option);
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        hash_double(&key, belt->from);
        hash_double(&key, belt->to);
        hash_fields(&key, ceduo_schema_belt(), (const char *)belt, true);
    }
    return key;
}
