/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A finder follows a path step by step through the table of keys, and in parallel through the memory of the scene. */
#include "value.h"

#include <math.h>
#include <string.h>

/* Position reached on a path. */
struct finder {
    struct ceduo_scene *scene;
    const char *path;
    size_t length, pos;
    const struct object *object;
    char *item;
    size_t n; /* number of adjacent items that share the value */
};

static bool next(struct finder *f, struct path_step *step)
{
    return ceduo_path_next(f->path, f->length, &f->pos, step);
}

/* Read an index in brackets, below n. */
static bool next_index(struct finder *f, size_t n, size_t *index)
{
    struct path_step step;
    return next(f, &step) && step.bracket && ceduo_path_index(&step, index) && *index < n;
}

/* Enter the item of a list that the next step selects by index or name. A belt has the name of its stand. */
static bool enter_item(struct finder *f, const struct object *object, char *items, size_t n)
{
    const struct field *named = ceduo_schema_field(object, "name");
    struct path_step step;
    size_t i;
    if (!next(f, &step) || !step.bracket || !items) /* an empty list, or segments of invalid materials */
        return false;
    if (!ceduo_path_index(&step, &i))
        for (i = 0; i < n; i++) {
            const char *item = items + i * object->size, *name = NULL;
            if (object == ceduo_schema_belt())
                name = ((const struct ceduo_belt *)(const void *)item)->name;
            else if (named)
                memcpy(&name, item + named->offset, sizeof name);
            if (ceduo_path_is(&step, name))
                break;
        }
    f->object = object;
    f->item = items + i * object->size;
    return i < n;
}

static bool enter_list(struct finder *f, const struct field *list)
{
    struct ceduo_slope *slope = &f->scene->slope;
    char *items;
    size_t n;
    if (list->object ==
        ceduo_schema_segment()) { /* a single segment applies to the whole slope; materials have one per stretch */
        size_t given = slope->segments_given;
        n = given > 0 ? given : slope->vertices - 1;
        f->n = given == 1 ? slope->vertices - 1 : 1;
        if (!enter_item(f, list->object, (char *)slope->segments, n))
            return false;
        if (slope->reversed && given > 1) /* the file lists them in reverse order */
            f->item = (char *)(slope->segments + n - 1) - (f->item - (char *)slope->segments);
        return true;
    }
    if (list->object == ceduo_schema_belt() && list->flags & FIELD_FILE_ONLY) /* the forest is the only option */
        return f->scene->options_count == 1 &&
               enter_item(f, list->object, (char *)f->scene->options[0].belts, f->scene->options[0].belts_count);
    if (list->flags & (FIELD_FILE_ONLY | FIELD_NO_MEMBER))
        return false;
    memcpy(&items, f->item + list->offset, sizeof items);
    memcpy(&n, f->item + list->companion_offset, sizeof n);
    if (list->flags & FIELD_SCALAR_OK && f->path[f->pos] == '.') { /* the only item, without an index */
        f->object = list->object;
        f->item = items;
        return n == 1;
    }
    return enter_item(f, list->object, items, n);
}

/* ---- kinds of numbers ---- */

/* Read "mean", "spread" or the end of the path. */
static bool find_spread_part(struct finder *f, struct value *v)
{
    struct path_step step;
    if (!next(f, &step))
        return f->pos == f->length;
    v->part = ceduo_path_is(&step, "spread") ? VALUE_SPREAD : VALUE_WHOLE;
    return !step.bracket && (v->part == VALUE_SPREAD || ceduo_path_is(&step, "mean")) && f->pos == f->length;
}

static bool find_number(struct finder *f, const struct field *field, struct value *v)
{
    const struct ceduo_slope *s = &f->scene->slope;
    char *member = f->item + field->offset, *items;
    size_t n, i;
    *v = (struct value){.field = field, .member = member, .n = f->n, .stride = f->object->size};
    v->origin = field->flags & FIELD_PLACE ? f->scene->slope.origin_x : 0;
    switch (field->type) {
    case FIELD_NUMBER:
        if (f->object == ceduo_schema_segment() &&
            ceduo_schema_alternative(f->object, field->key)) /* not for stems: their per_ha is recomputed */
            v->alternative =
                (double *)(void *)(f->item +
                                   ceduo_schema_field(f->object, ceduo_schema_alternative(f->object, field->key))->offset);
        v->relative = field->flags & FIELD_PLACE ? (double *)(void *)(f->item + field->companion_offset) : NULL;
        return f->pos == f->length;
    case FIELD_COUNT:
    case FIELD_CHOICE:
        return f->pos == f->length;
    case FIELD_SPREAD:
        return find_spread_part(f, v);
    case FIELD_SPREADS:
        v->member = next_index(f, 3, &i) ? member + i * sizeof(struct ceduo_number) : NULL;
        return v->member && find_spread_part(f, v);
    case FIELD_NUMBERS:
        memcpy(&items, member, sizeof items);
        memcpy(&n, f->item + field->companion_offset, sizeof n);
        v->member = next_index(f, n, &i) ? items + i * sizeof(double) : NULL;
        return v->member && f->pos == f->length;
    case FIELD_POINTS: /* materials may have added vertices; all x are relative to the first */
        if (s->segments_given == 0 || s->simplified_to > 0 || !next_index(f, s->vertices, &i) || !next_index(f, 2, &n) ||
            (n == 0 && i == 0))
            return false;
        v->member = n == 0 ? &s->x[i] : &s->z[i];
        v->origin = n == 0 ? s->origin_x : s->origin_z;
        return f->pos == f->length;
    default:
        return false;
    }
}

bool ceduo_value_find(struct ceduo_scene *scene, const char *path, struct value *value)
{
    struct finder f = {
        .scene = scene, .path = path, .length = strlen(path), .object = ceduo_schema_scene(), .item = (char *)scene, .n = 1};
    struct path_step step;
    while (next(&f, &step)) {
        const struct field *field = ceduo_schema_step(f.object, &step);
        if (field && f.path[f.pos] == '[' && ceduo_schema_list(f.object, field))
            field = ceduo_schema_list(f.object, field);
        if (!field || (field->type == FIELD_LIST && !enter_list(&f, field)))
            return false;
        if (field->type == FIELD_GROUP) {
            f.object = field->object;
            f.item += field->offset;
        } else if (field->type != FIELD_LIST) { /* the path ends here, or continues to a number of the value */
            return !(field->flags & (FIELD_NO_MEMBER | FIELD_FILE_ONLY)) && find_number(&f, field, value);
        }
    }
    return false;
}

/* ---- get and put ---- */

static bool is_spread(const struct field *f)
{
    return f->type == FIELD_SPREAD || f->type == FIELD_SPREADS;
}

double ceduo_value_get(const struct value *v)
{
    const struct field *f = v->field;
    const struct ceduo_number *n = v->member;
    uint64_t count = 0;
    int choice;
    if (f->type == FIELD_COUNT) {
        memcpy(&count, v->member, f->size);
        return (double)count;
    }
    if (f->type == FIELD_CHOICE) {
        memcpy(&choice, v->member, sizeof choice);
        return choice;
    }
    if (v->part == VALUE_SPREAD)
        return n->spread / f->scale;
    double si = is_spread(f) ? n->mean : *(const double *)v->member;
    return (v->relative ? si : si + v->origin) / f->scale;
}

bool ceduo_value_set(const struct value *v, double number)
{
    const struct field *f = v->field;
    bool spread = v->part == VALUE_SPREAD, integer = number == floor(number);
    bool in_range = spread ? number >= 0 && isfinite(number) : ceduo_schema_in_range(f, number);
    double si = number * f->scale, stored = spread || v->relative ? si : si - v->origin;
    int choice = (int)(f->type == FIELD_CHOICE && number >= -1 && number < (double)f->choices->n ? number : -2);
    struct ceduo_number changed = {0};
    if (f->type == FIELD_CHOICE ? !integer || choice < -1 : !in_range || (f->type == FIELD_COUNT && !integer))
        return false;
    if (is_spread(f)) {
        memcpy(&changed, v->member, sizeof changed);
        *(spread ? &changed.spread : &changed.mean) = stored;
        struct ceduo_number given = changed;
        given.mean += v->origin;
        if (!ceduo_schema_spread_fits(f, given))
            return false;
    }
    for (size_t i = 0; i < v->n; i++) {
        char *copy = (char *)v->member + i * v->stride;
        if (f->type == FIELD_CHOICE) /* index of a word; -1: not given */
            memcpy(copy, &choice, sizeof choice);
        else if (is_spread(f))
            memcpy(copy, &changed, sizeof changed);
        else if (f->type == FIELD_COUNT)
            ceduo_schema_set_count(f, copy, (uint64_t)number);
        else
            memcpy(copy, &stored, sizeof stored);
        if (v->alternative)
            *(double *)(void *)((char *)v->alternative + i * v->stride) = NAN;
    }
    if (v->relative)
        *v->relative = si - v->origin;
    return true;
}

void ceduo_value_forget(const struct value *v)
{
    const double nan = NAN; /* of a spread, this is the mean */
    for (size_t i = 0; i < v->n; i++)
        memcpy((char *)v->member + i * v->stride, &nan, sizeof nan); /* never a place along the slope: places are required */
}
