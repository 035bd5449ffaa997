/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which values of a scene are in doubt. The table of keys and the scene's document are followed together; a value that is
 * marked as assumed and has a range becomes a place of an input. Places with the same origin are one input. */
#include "inputs.h"

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

static char *text_of(struct finder *f, const char *format, ...) __attribute__((format(printf, 2, 3)));

static char *text_of(struct finder *f, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = ceduo_arena_vformat(f->arena, format, args);
    va_end(args);
    return text;
}

static void add(struct finder *f, const char *path, const char *origin, struct range range)
{
    struct found *found = ceduo_arena_take(f->arena, sizeof *found);
    if (!found || !path || !origin)
        return;
    *found = (struct found){path, origin, range, NULL};
    *f->last = found;
    f->last = &found->next;
}

bool ceduo_input_shares(const struct ceduo_input *a, const struct ceduo_input *b)
{
    for (size_t i = 0; i < a->places_count; i++)
        for (size_t k = 0; k < b->places_count; k++)
            if (strcmp(a->places[i], b->places[k]) == 0)
                return true;
    return false;
}

/* ---- where a value comes from ---- */

const struct ceduo_belt *ceduo_input_belt(const struct ceduo_scene *s, const char *place)
{
    size_t i = 0, k;
    bool within = sscanf(place, "options[%zu].forest[%zu].", &i, &k) == 2 ||
                  (s->options_count == 1 && sscanf(place, "forest[%zu].", &k) == 1);
    return within && i < s->options_count && k < s->options[i].belts_count ? &s->options[i].belts[k] : NULL;
}

static const struct ceduo_stand *stand_of(struct finder *f, const char *path)
{
    const struct ceduo_belt *belt = ceduo_input_belt(&f->file->scene, path);
    return belt ? &belt->stand : NULL;
}

/* The energy law is the same question for all stands, the strength of wood for all of one species; any other value is one
 * with those from the same place of the same file. */
static const char *origin_of(struct finder *f, const char *key, const char *path, const struct node *node)
{
    const struct ceduo_stand *stand = stand_of(f, path);
    if (strcmp(key, "model") == 0)
        return "energy law";
    if (stand && (strcmp(key, "u_J_m3") == 0 || strcmp(key, "fracture_ratio") == 0))
        return text_of(f, "%s of %d", key, stand->species);
    return node ? text_of(f, "%s:%u:%u", node->source->name, node->line, node->column) : path;
}

/* ---- what is marked as assumed ---- */

static bool is_assumed(struct finder *f, const char *path)
{
    return ceduo_scene_assumes_value(f->file, path);
}

/* Whether the scene's law of contacts knows a value of the ground. */
static bool law_knows(const struct finder *f, const char *key)
{
    bool arm = f->file->scene.simulation.law == CEDUO_LAW_ARM;
    return strcmp(key, "mu") == 0 ? arm : strcmp(key, "rt") != 0 || !arm;
}

static void consider(struct finder *f, const struct field *field, const struct node *node)
{
    bool instead = !node && field->flags & FIELD_ONE_OF && !field->value; /* another key says it */
    /* today is in doubt, not the years */
    const struct range *range = instead || field->flags & FIELD_YEARS ? NULL : ceduo_range_of(field);
    const char *path = range ? text_of(f, "%s", ceduo_text_string(&f->path)) : NULL;
    struct value v;
    if (!path || !law_knows(f, field->key) || !ceduo_value_find(&f->file->scene, path, &v) || isnan(ceduo_value_get(&v)))
        return;
    bool law = !node && range->kind == CEDUO_INPUT_WORDS; /* nobody chose it */
    const struct ceduo_stand *stand = law ? stand_of(f, path) : NULL;
    if (is_assumed(f, path) || (stand && !ceduo_stand_is_bare(stand)))
        add(f, path, origin_of(f, field->key, path, node), *range);
}

static void walk(struct finder *f, const struct object *object, const struct node *map);

static void cut(struct text *text, size_t length)
{
    text->length = length;
    if (text->bytes)
        text->bytes[length] = '\0';
}

static void walk_child(struct finder *f, const struct field *field, const struct node *node)
{
    if (field->type == FIELD_LIST && field->flags & FIELD_OR_ONE && node && node->kind == NODE_MAP)
        walk(f, field->object, node);
    else if (field->type == FIELD_GROUP && (node || ceduo_schema_field(field->object, "model")))
        walk(f, field->object, node);
    else if (field->type == FIELD_LIST && node && node->kind == NODE_LIST)
        for (size_t i = 0; i < node->n; i++) {
            size_t before = f->path.length;
            ceduo_text_format(&f->path, "[%zu]", i);
            walk(f, field->object, node->items[i]);
            cut(&f->path, before);
        }
    else if (field->type != FIELD_GROUP && field->type != FIELD_LIST)
        consider(f, field, node);
}

/* `map` may be NULL: nothing of the object is written. */
static void walk(struct finder *f, const struct object *object, const struct node *map)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *field = &object->fields[i];
        size_t before = f->path.length;
        if (field->flags & FIELD_OR_NONE)
            continue;
        ceduo_text_format(&f->path, "%s%s", before > 0 ? "." : "", field->key);
        walk_child(f, field, ceduo_node_get(map, field->key));
        cut(&f->path, before);
    }
}

/* ---- grounds of the library ---- */

size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, const char **places)
{
    const struct ceduo_slope *s = &scene->slope;
    const struct node *rows = ceduo_node_get(ceduo_node_get(root, "slope"), "materials");
    struct finder f = {.arena = arena};
    size_t n = 0;
    for (size_t j = 0; rows && rows->kind == NODE_LIST && rows->n > 0 && j + 1 < s->vertices; j++) {
        double middle = ceduo_slope_mirrored(s, s->origin_x + (s->x[j] + s->x[j + 1]) / 2);
        size_t row = 0;
        while (row + 1 < rows->n && middle >= ceduo_node_number(rows->items[row + 1], "from_m"))
            row++;
        const char *name = ceduo_node_text(rows->items[row], "material");
        if (name && strcmp(name, material) == 0)
            places[n++] = text_of(&f, "slope.segments[%zu].%s", j, key);
    }
    return n;
}

static void add_ground(struct finder *f, const struct ceduo_material *m, bool everywhere)
{
    static const char *const keys[] = {"rn", "rt", "roughness_rad", "friction", "mu"};
    size_t stretches = f->file->scene.slope.vertices - 1;
    const char **places = ceduo_arena_take(f->arena, (stretches + 1) * sizeof *places);
    for (size_t k = 0; places && k < sizeof keys / sizeof keys[0]; k++) {
        if (!law_knows(f, keys[k]))
            continue;
        size_t n = ceduo_input_ground(f->arena, f->file->root, &f->file->scene, m->name, keys[k], places);
        for (size_t j = 0; everywhere && j < stretches; j++)
            places[n++] = text_of(f, "slope.segments[%zu].%s", j, keys[k]);
        for (size_t i = 0; i < n; i++)
            add(f, places[i], text_of(f, "slope.materials[%s].%s", m->name, keys[k]), ceduo_range_of_material(m, keys[k]));
    }
}

static void walk_grounds(struct finder *f)
{
    size_t count;
    const struct ceduo_material *library = ceduo_materials(&count);
    if (f->file->ground_assumed)
        add_ground(f, ceduo_material_talus(), true);
    else if (f->file->scene.slope.segments_given == 0)
        for (size_t i = 0; i < count; i++)
            add_ground(f, &library[i], false);
}

/* ---- putting together ---- */

static bool is_named(const struct scene_file *file, const char *path)
{
    for (size_t i = 0; i < file->inputs_count; i++)
        for (size_t k = 0; k < file->inputs[i].places_count; k++)
            if (ceduo_schema_same(file->inputs[i].places[k], path))
                return true;
    return false;
}

static void put_words(struct finder *f, struct ceduo_input *input, const struct range *range, const struct field *field)
{
    int *words = ceduo_arena_take(f->arena, sizeof range->words / sizeof range->words[0] * sizeof *words);
    input->words = words;
    for (size_t i = 0; words && range->words[i]; i++)
        words[input->words_count++] = ceduo_choice_find(field->choices, range->words[i]);
}

/* All places of one origin. */
static bool make_input(struct finder *f, const struct found *first, size_t most, struct ceduo_input *input)
{
    const char **places = ceduo_arena_take(f->arena, (most + 1) * sizeof *places);
    size_t n = 0;
    for (const struct found *one = first; places && one; one = one->next)
        if (strcmp(one->origin, first->origin) == 0 && !is_named(f->file, one->path))
            places[n++] = one->path;
    bool ground = strncmp(first->origin, "slope.materials", 15) == 0;
    *input = (struct ceduo_input){.path = ground  ? first->origin
                                          : n > 0 ? places[0]
                                                  : first->path,
                                  .kind = first->range.kind,
                                  .lo = first->range.lo,
                                  .hi = first->range.hi,
                                  .places = places,
                                  .places_count = n};
    if (first->range.kind == CEDUO_INPUT_WORDS)
        put_words(f, input, &first->range, ceduo_schema_at(first->path));
    return n > 0;
}

static bool is_first(const struct finder *f, const struct found *found)
{
    const struct found *one = f->first;
    while (strcmp(one->origin, found->origin) != 0)
        one = one->next;
    return one == found;
}

static bool put_together(struct finder *f, struct scene_inputs *inputs)
{
    size_t most = f->file->inputs_count, named = most;
    for (const struct found *one = f->first; one; one = one->next)
        most++;
    inputs->items = ceduo_arena_take(f->arena, (most + 1) * sizeof *inputs->items);
    inputs->sources = ceduo_arena_take(f->arena, (most + 1) * sizeof *inputs->sources);
    if (!inputs->items || !inputs->sources)
        return false;
    for (size_t i = 0; i < named; i++) {
        if (f->file->inputs[i].places_count == 0) /* of a stand, and the scene says otherwise */
            continue;
        inputs->items[inputs->n] = f->file->inputs[i];
        inputs->sources[inputs->n++] = i < f->file->inputs_of_scene ? N_("doubt, in the scene") : N_("doubt, in the stand");
    }
    for (const struct found *one = f->first; one; one = one->next)
        if (is_first(f, one) && make_input(f, one, most, &inputs->items[inputs->n]))
            inputs->sources[inputs->n++] = one->range.source;
    return !f->arena->failed;
}

bool ceduo_inputs_of(struct scene_file *file, struct scene_inputs *inputs)
{
    struct finder f = {.file = file, .arena = &file->arena};
    *inputs = (struct scene_inputs){0};
    f.last = &f.first;
    if (ceduo_node_text(file->root, "doubt")) /* none */
        return true;
    walk(&f, ceduo_schema_scene(), file->root);
    walk_grounds(&f);
    bool good = !f.path.failed && !f.arena->failed && put_together(&f, inputs);
    ceduo_text_free(&f.path);
    return good;
}
