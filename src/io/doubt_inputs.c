/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which values of a scene are in doubt. The table of keys and the scene's document are followed together; a value that is
 * marked as assumed and has a range becomes a place of an input. Places with the same origin are one input. */
#include "doubt_inputs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "base/text.h"
#include "scene/ranges.h"
#include "scene/value.h"

/* A place that is in doubt, before places are put together. */
struct found {
    const char *path, *origin; /* places with one origin are one input */
    struct range range;
    struct found *next;
};

struct finder {
    struct scene_file *file;
    struct arena *arena;
    struct found *first, **last;
    struct text path;
};

static void add(struct finder *f, const char *path, const char *origin, struct range range)
{
    struct found *found = ceduo_arena_take(f->arena, sizeof *found);
    if (!found || !path || !origin)
        return;
    *found = (struct found){path, origin, range, NULL};
    *f->last = found;
    f->last = &found->next;
}

bool ceduo_inputs_have(const struct ceduo_input *inputs, size_t n, const char *place)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < inputs[i].places_count; k++)
            if (ceduo_schema_same(inputs[i].places[k], place))
                return true;
    return false;
}

bool ceduo_input_shares(const struct ceduo_input *a, const struct ceduo_input *b)
{
    for (size_t i = 0; i < a->places_count; i++)
        for (size_t k = 0; k < b->places_count; k++)
            if (strcmp(a->places[i], b->places[k]) == 0)
                return true;
    return false;
}

const struct ceduo_belt *ceduo_input_belt(const struct ceduo_scene *s, const char *place)
{
    size_t i = 0, k;
    bool within = sscanf(place, "options[%zu].forest[%zu].", &i, &k) == 2 ||
                  (s->options_count == 1 && sscanf(place, "forest[%zu].", &k) == 1);
    return within && i < s->options_count && k < s->options[i].belts_count ? &s->options[i].belts[k] : NULL;
}

/* ---- what is marked as assumed ---- */

/* Whether the scene's law of contacts knows a value of the ground. */
static bool law_knows(const struct finder *f, const char *key)
{
    bool arm = f->file->scene.simulation.law == CEDUO_LAW_ARM;
    return strcmp(key, "mu") == 0 ? arm : strcmp(key, "rt") != 0 || !arm;
}

/* The energy law is the same question for all stands, the strength of wood for all of one species; any other value is one
 * with those from the same place of the same file. */
static void consider(struct finder *f, const struct field *field, const struct node *node)
{
    const char *key = field->key;
    bool instead = !node && field->flags & FIELD_ONE_OF && !field->value; /* another key says it */
    /* today is in doubt, not the years */
    const struct range *range = instead || field->flags & FIELD_YEARS ? NULL : ceduo_range_of(field);
    const char *path = range ? ceduo_arena_string(f->arena, ceduo_text_string(&f->path)) : NULL, *origin = path;
    struct value v;
    if (!path || !law_knows(f, key) || !ceduo_value_find(&f->file->scene, path, &v) || isnan(ceduo_value_get(&v)))
        return;
    const struct ceduo_belt *belt = ceduo_input_belt(&f->file->scene, path);
    bool law = !node && range->kind == CEDUO_INPUT_WORDS; /* nobody chose it */
    if (!ceduo_scene_assumes_value(f->file, path) && !(law && belt && !ceduo_stand_is_bare(&belt->stand)))
        return;
    if (strcmp(key, "model") == 0)
        origin = "energy law";
    else if (belt && (strcmp(key, "u_J_m3") == 0 || strcmp(key, "fracture_ratio") == 0))
        origin = ceduo_arena_format(f->arena, "%s of %d", key, belt->stand.species);
    else if (node)
        origin = ceduo_arena_format(f->arena, "%s:%u:%u", node->source->name, node->line, node->column);
    add(f, path, origin, *range);
}

/* `map` may be NULL: nothing of the object is written. */
static void walk(struct finder *f, const struct object *object, const struct node *map)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *field = &object->fields[i];
        const struct field *other = ceduo_schema_unit(object, field);
        const struct node *node = ceduo_node_get(map, field->key);
        node = node || !other ? node : ceduo_node_get(map, other->key);
        bool list = field->type == FIELD_LIST, group = field->type == FIELD_GROUP;
        size_t before = f->path.length;
        if (field->flags & FIELD_OR_NONE)
            continue;
        ceduo_text_format(&f->path, "%s%s", before > 0 ? "." : "", field->key);
        size_t here = f->path.length;
        if (!list && !group)
            consider(f, field, node);
        else if (list ? field->flags & FIELD_OR_ONE && node && node->kind == NODE_MAP
                      : node || ceduo_schema_field(field->object, "model"))
            walk(f, field->object, node);
        for (size_t k = 0; list && node && node->kind == NODE_LIST && k < node->n; k++) {
            ceduo_text_format(&f->path, "[%zu]", k);
            walk(f, field->object, node->items[k]);
            ceduo_text_cut(&f->path, here);
        }
        ceduo_text_cut(&f->path, before);
    }
}

/* ---- grounds of the library ---- */

size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, const char **places)
{
    const struct ceduo_slope *s = &scene->slope;
    const struct node *rows = ceduo_node_get(ceduo_node_get(root, "slope"), "materials");
    bool listed = rows && rows->kind == NODE_LIST && rows->n > 0;
    size_t n = 0;
    for (size_t j = 0; (listed || !root) && j + 1 < s->vertices; j++) {
        double middle = ceduo_slope_mirrored(s, s->origin_x + (s->x[j] + s->x[j + 1]) / 2);
        size_t row = 0;
        while (listed && row + 1 < rows->n && middle >= ceduo_node_number(rows->items[row + 1], "from_m"))
            row++;
        const char *name = listed ? ceduo_node_text(rows->items[row], "material") : ceduo_material_talus()->name;
        int known = name ? ceduo_choice_find(&ceduo_material_words, name) : -1;
        if (known >= 0 && strcmp(ceduo_material_words.names[known], material) == 0)
            places[n++] = ceduo_arena_format(arena, "slope.segments[%zu].%s", j, key);
    }
    return n;
}

static void add_ground(struct finder *f, const struct ceduo_material *m)
{
    static const char *const keys[] = {"rn", "rt", "roughness_rad", "friction", "mu"};
    const struct scene_file *file = f->file;
    const char **places = ceduo_arena_take(f->arena, file->scene.slope.vertices * sizeof *places);
    for (size_t k = 0; places && k < sizeof keys / sizeof keys[0]; k++) {
        size_t n = law_knows(f, keys[k]) ? ceduo_input_ground(f->arena, file->ground_assumed ? NULL : file->root, &file->scene,
                                                              m->name, keys[k], places)
                                         : 0;
        for (size_t i = 0; i < n; i++)
            add(f, places[i], ceduo_arena_format(f->arena, "slope.materials[%s].%s", m->name, keys[k]),
                ceduo_range_of_material(m, keys[k]));
    }
}

/* ---- putting together ---- */

/* All places of one origin, but for those that the scene names itself. */
static bool make_input(struct finder *f, const struct found *first, size_t max, struct ceduo_input *input)
{
    const struct scene_file *file = f->file;
    const struct range *range = &first->range;
    const char **places = ceduo_arena_take(f->arena, (max + 1) * sizeof *places);
    size_t n = 0;
    for (const struct found *one = first; places && one; one = one->next)
        if (strcmp(one->origin, first->origin) == 0 && !ceduo_inputs_have(file->inputs, file->inputs_count, one->path))
            places[n++] = one->path;
    bool ground = strncmp(first->origin, "slope.materials", 15) == 0;
    *input = (struct ceduo_input){.path = ground  ? first->origin
                                          : n > 0 ? places[0]
                                                  : first->path,
                                  .kind = range->kind,
                                  .lo = range->lo,
                                  .hi = range->hi,
                                  .places = places,
                                  .places_count = n};
    if (range->kind == CEDUO_INPUT_WORDS) {
        int *words = ceduo_arena_take(f->arena, sizeof range->words / sizeof range->words[0] * sizeof *words);
        const struct choices *choices = ceduo_schema_at(first->path)->choices;
        input->words = words;
        for (size_t i = 0; words && range->words[i]; i++)
            words[input->words_count++] = ceduo_choice_find(choices, range->words[i]);
    }
    return n > 0;
}

static bool put_together(struct finder *f, struct scene_inputs *inputs)
{
    size_t named = f->file->inputs_count, max = named;
    for (const struct found *one = f->first; one; one = one->next)
        max++;
    inputs->items = ceduo_arena_take(f->arena, (max + 1) * sizeof *inputs->items);
    inputs->sources = ceduo_arena_take(f->arena, (max + 1) * sizeof *inputs->sources);
    if (!inputs->items || !inputs->sources)
        return false;
    for (size_t i = 0; i < named; i++) {
        if (f->file->inputs[i].places_count == 0) /* of a stand, and the scene says otherwise */
            continue;
        inputs->items[inputs->n] = f->file->inputs[i];
        inputs->sources[inputs->n++] = i < f->file->inputs_of_scene ? N_("doubt, in the scene") : N_("doubt, in the stand");
    }
    for (const struct found *one = f->first; one; one = one->next) {
        const struct found *same = f->first; /* the first of its origin */
        while (strcmp(same->origin, one->origin) != 0)
            same = same->next;
        if (same == one && make_input(f, one, max, &inputs->items[inputs->n]))
            inputs->sources[inputs->n++] = one->range.source;
    }
    return true;
}

bool ceduo_inputs_of(struct scene_file *file, struct scene_inputs *inputs)
{
    struct finder f = {.file = file, .arena = &file->arena};
    size_t count;
    const struct ceduo_material *library = ceduo_materials(&count);
    *inputs = (struct scene_inputs){0};
    f.last = &f.first;
    if (ceduo_node_text(file->root, "doubt")) /* none */
        return true;
    walk(&f, ceduo_schema_scene(), file->root);
    for (size_t i = 0; file->scene.slope.segments_given == 0 && i < count; i++)
        add_ground(&f, &library[i]);
    bool good = put_together(&f, inputs);
    ceduo_text_free(&f.path);
    return good;
}
