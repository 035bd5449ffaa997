/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the uncertain inputs of a scene. Walks the table of keys and the scene's document together. A value that is marked as
 * assumed and has a range becomes a place of an input. Places with one origin are one input. */
#include "scene/slope.h"
#include "scene/stand.h"
#include "scene_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/text.h"
#include "scene/ranges.h"
#include "scene/value.h"
#include "study/inputs.h"

/* An input and its places, which have one origin. */
struct found {
    const char *origin;
    struct ceduo_input input;
    const char **places;
    size_t capacity;
};

struct input_finder {
    struct scene_file *file;
    struct arena *arena;
    struct found *found;
    size_t n, capacity;
    struct text path;
    bool brauner; /* the energy law of the current stand is, or may be, brauner */
};

bool ceduo_inputs_have(const struct ceduo_input *inputs, size_t n, const char *place)
{
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < inputs[i].places_count; k++)
            if (ceduo_schema_same(inputs[i].places[k], place))
                return true;
    return false;
}

bool ceduo_input_is_library_ground(const struct ceduo_scene *scene, const struct ceduo_input *input)
{
    static const char segments[] = "slope.segments[";
    return scene->slope.segments_given == 0 && input->places_count > 0 &&
           strncmp(input->places[0], segments, sizeof segments - 1) == 0;
}

bool ceduo_input_overlaps(const struct ceduo_input *a, const struct ceduo_input *b)
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
    bool inside = sscanf(place, "options[%zu].forest[%zu].", &i, &k) == 2 ||
                  (s->options_count == 1 && sscanf(place, "forest[%zu].", &k) == 1);
    return inside && i < s->options_count && k < s->options[i].belts_count ? &s->options[i].belts[k] : NULL;
}

/* ---- inputs and their places ---- */

/* Make an input for the places of one origin. `path`: of the first. */
static struct ceduo_input make_input(struct input_finder *f, const char *path, const struct range *range)
{
    struct ceduo_input input = {.kind = range->kind, .lo = range->lo, .hi = range->hi, .source = range->source};
    if (range->kind != CEDUO_INPUT_WORDS)
        return input;
    int *words = ceduo_arena_alloc(f->arena, sizeof range->words / sizeof range->words[0] * sizeof *words);
    for (size_t i = 0; words && range->words[i]; i++)
        words[input.words_count++] = ceduo_choice_find(ceduo_schema_at(path)->choices, range->words[i]);
    input.words = words;
    return input;
}

/* Add a place to the input of its origin, unless a row of `uncertainty` names it. */
static void add_place(struct input_finder *f, const char *path, const char *origin, struct range range)
{
    size_t i = 0;
    if (!path || !origin)
        return;
    while (i < f->n && strcmp(f->found[i].origin, origin) != 0)
        i++;
    if (i == f->n) {
        struct found *all = ceduo_arena_grow(f->arena, f->found, f->n, 1, &f->capacity, sizeof *all);
        if (!all)
            return;
        f->found = all;
        f->found[f->n++] = (struct found){.origin = origin, .input = make_input(f, path, &range)};
    }
    struct found *to = &f->found[i];
    size_t n = to->input.places_count;
    const char **places = ceduo_arena_grow(f->arena, to->places, n, 1, &to->capacity, sizeof *places);
    if (!places)
        return;
    to->input.places = to->places = places;
    places[n] = path;
    to->input.places_count += !ceduo_inputs_have(f->file->inputs, f->file->inputs_count, path);
}

/* ---- values marked as assumed ---- */

/* True if the scene's law of contacts uses a value of the ground. */
static bool law_uses(const struct input_finder *f, const char *key)
{
    bool arm = f->file->scene.simulation.law == CEDUO_LAW_ARM;
    return strcmp(key, "mu") == 0 ? arm : strcmp(key, "rt") != 0 || !arm;
}

/* Return the key of a value that all stands of a species share: strength of wood, or growth. NULL if it is neither. */
static const char *get_species_key(const struct field *field, const char *path)
{
    const char *growth = strstr(path, ".growth.");
    bool strength = strcmp(field->key, "u_J_m3") == 0 || strcmp(field->key, "fracture_ratio") == 0;
    return growth ? growth + 1 : strength ? field->key : NULL;
}

/* Add a value if it is uncertain. All stands share one input for the energy law and one for its offset, which only brauner
 * uses. Stands of one species share strength of wood and growth. Other values share an input if they come from one place of one
 * file. A factor of 0 has no effect. */
static void add_value(struct input_finder *f, const struct field *field, const struct node *node)
{
    const char *key = field->key;
    bool replaced = !node && field->flags & FIELD_ONE_OF && !field->value; /* by another key */
    const struct range *range = replaced ? NULL : ceduo_range_find(field);
    const char *path = range ? ceduo_arena_string(f->arena, ceduo_text_string(&f->path)) : NULL, *origin = path;
    struct value v;
    if (!path || !law_uses(f, key) || !ceduo_value_find(&f->file->scene, path, &v) || isnan(ceduo_value_get(&v)))
        return;
    if (range->kind == CEDUO_INPUT_FACTOR && !(ceduo_value_get(&v) > 0))
        return;
    const struct ceduo_belt *belt = ceduo_input_belt(&f->file->scene, path);
    bool law = !node && range->kind == CEDUO_INPUT_WORDS; /* a default */
    bool is_model = strcmp(key, "model") == 0, is_offset = strcmp(key, "offset") == 0;
    bool in_uncertainty = ceduo_scene_assumes_value(f->file, path) || (law && !ceduo_stand_is_bare(&belt->stand));
    if (is_model)
        f->brauner = belt->stand.energy == CEDUO_ENERGY_MODEL_BRAUNER || in_uncertainty ||
                     ceduo_inputs_have(f->file->inputs, f->file->inputs_count, path);
    if (!in_uncertainty || (is_offset && !f->brauner))
        return;
    if (is_model || is_offset)
        origin = key;
    else if (belt && get_species_key(field, path))
        origin = ceduo_arena_format(f->arena, "%s of %d", get_species_key(field, path), belt->stand.species);
    else if (node)
        origin = ceduo_arena_format(f->arena, "%s:%u:%u", node->source->name, node->line, node->column);
    struct range clipped = *range;
    if (strcmp(key, "per_stool") == 0) /* a stool has at least one shoot */
        clipped.lo = fmin(1, fmax(clipped.lo, 1 / ceduo_value_get(&v)));
    add_place(f, path, origin, clipped);
}

/* `map` may be NULL: the document does not have the object. */
static void walk(struct input_finder *f, const struct object *object, const struct node *map)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *field = &object->fields[i];
        const struct field *alias = ceduo_schema_unit(object, field);
        const struct node *node = ceduo_node_get(map, field->key);
        node = node || !alias ? node : ceduo_node_get(map, alias->key);
        bool list = field->type == FIELD_LIST, group = field->type == FIELD_GROUP;
        size_t before = f->path.length;
        bool is_list = node && node->kind == NODE_LIST ? ceduo_schema_list(object, field) != NULL : false;
        if (field->flags & FIELD_OR_NONE || is_list) /* the next row describes the list */
            continue;
        ceduo_text_format(&f->path, "%s%s", before > 0 ? "." : "", field->key);
        size_t field_end = f->path.length;
        if (!list && !group)
            add_value(f, field, node);
        else if (list ? field->flags & FIELD_SCALAR_OK && node && node->kind == NODE_MAP
                      : node || ceduo_schema_field(field->object, "model"))
            walk(f, field->object, node);
        for (size_t k = 0; list && node && node->kind == NODE_LIST && k < node->n; k++) {
            ceduo_text_format(&f->path, "[%zu]", k);
            walk(f, field->object, node->items[k]);
            ceduo_text_cut(&f->path, field_end);
        }
        ceduo_text_cut(&f->path, before);
    }
}

/* ---- grounds of the library ---- */

size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, bool assumed, const char **places)
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
        if (listed && assumed && ceduo_node_get(rows->items[row], key))
            continue;
        int known = name ? ceduo_choice_find(&ceduo_material_words, name) : -1;
        if (known >= 0 && strcmp(ceduo_material_words.names[known], material) == 0)
            places[n++] = ceduo_arena_format(arena, "slope.segments[%zu].%s", j, key);
    }
    return n;
}

static void add_ground(struct input_finder *f, const struct ceduo_material *m)
{
    static const char *const keys[] = {"rn", "rt", "roughness_m", "friction", "mu"};
    const struct scene_file *file = f->file;
    const char **places = ceduo_arena_alloc(f->arena, file->scene.slope.vertices * sizeof *places);
    for (size_t k = 0; places && k < sizeof keys / sizeof keys[0]; k++) {
        size_t n = law_uses(f, keys[k]) ? ceduo_input_ground(f->arena, file->ground_assumed ? NULL : file->root, &file->scene,
                                                             m->name, keys[k], true, places)
                                        : 0;
        for (size_t i = 0; i < n; i++)
            add_place(f, places[i], ceduo_arena_format(f->arena, "slope.materials[%s].%s", m->name, keys[k]),
                      ceduo_range_find_material(m, keys[k]));
    }
}

/* ---- paths ---- */

const char *ceduo_input_path(struct scene_file *file, const char *place)
{
    size_t option;
    /* untaken: bound */
    if (!place || !file->kept || sscanf(place, "options[%zu]", &option) != 1 || option >= file->scene.options_count)
        return place;
    return ceduo_arena_format(&file->arena, "options[%zu%s", file->kept[option], strchr(place, ']'));
}

/* Return the text after bracket n of a path, from 0; NULL: it has fewer. */
static const char *find_bracket(const char *path, size_t n)
{
    for (path = strchr(path, '['); path && n > 0; n--)
        path = strchr(path + 1, '[');
    return path ? path + 1 : NULL;
}

/* Return a path for all places (at least one) of an input, with [*] for differing items. If it selects other places, too,
 * return the path of the first place. */
static const char *make_common_path(struct scene_file *file, const struct ceduo_input *input)
{
    LOCAL_TEXT(path);
    const char *from = input->places[0];
    for (size_t n = 0; find_bracket(input->places[0], n); n++) {
        const char *item = find_bracket(input->places[0], n);
        bool same = true;
        for (size_t k = 1; k < input->places_count; k++) {
            const char *bracket = find_bracket(input->places[k], n);
            /* untaken: bound */
            same &= bracket && strtoul(bracket, NULL, 10) == strtoul(item, NULL, 10);
        }
        ceduo_text_append_n(&path, from, (size_t)(item - from));
        if (same)
            ceduo_text_format(&path, "%lu", strtoul(item, NULL, 10));
        else
            ceduo_text_append_char(&path, '*');
        from = strchr(item, ']');
    }
    ceduo_text_append(&path, from);
    bool all = input->places_count > 1 && path.bytes && ceduo_input_count_places(file, path.bytes) == input->places_count;
    return all ? ceduo_input_path(file, ceduo_arena_string(&file->arena, path.bytes))
               : ceduo_input_path(file, input->places[0]);
}

bool ceduo_inputs_collect(struct scene_file *file, struct scene_inputs *inputs)
{
    struct input_finder f = {.file = file, .arena = &file->arena};
    size_t count;
    const struct ceduo_material *library = ceduo_materials(&count);
    *inputs = (struct scene_inputs){0};
    if (ceduo_node_text(file->root, "uncertainty")) /* none */
        return true;
    walk(&f, ceduo_schema_scene(), file->root);
    for (size_t i = 0; file->scene.slope.segments_given == 0 && i < count; i++)
        add_ground(&f, &library[i]);
    ceduo_text_free(&f.path);
    inputs->items = ceduo_arena_alloc(f.arena, (file->inputs_count + f.n + 1) * sizeof *inputs->items);
    for (size_t i = 0; inputs->items && i < file->inputs_count; i++)
        if (file->inputs[i].places_count > 0) /* a row of the scene replaces a row without places */
            inputs->items[inputs->n++] = file->inputs[i];
    /* inputs of future years last, so that they do not change the points of the others */
    for (int future = 0; inputs->items && future < 2; future++)
        for (size_t i = 0; i < f.n; i++) {
            struct ceduo_input *input = &f.found[i].input;
            if (input->places_count == 0 || ceduo_input_is_future(input) != future)
                continue;
            const char *origin = f.found[i].origin;
            input->path = strncmp(origin, "slope.materials", 15) == 0 ? origin : make_common_path(file, input);
            inputs->items[inputs->n++] = *input;
        }
    return !f.arena->failed;
}

void ceduo_inputs_keep_today(struct scene_inputs *inputs)
{
    size_t n = 0;
    for (size_t i = 0; i < inputs->n; i++)
        if (!ceduo_input_is_future(&inputs->items[i]))
            inputs->items[n++] = inputs->items[i];
    inputs->n = n;
}
