/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a scene by their paths. A finder follows the path step by step through the table of keys and at the same
 * time through the scene's memory, until it holds one number. A value only points into the scene, which owns everything. */
#include "value.h"

#include <math.h>
#include <string.h>

/* Where a path has led to. */
struct finder {
    struct ceduo_scene *scene;
    const char *path;
    size_t length, at;
    const struct object *object;
    char *item;
    size_t n; /* items alike that stand side by side */
};

static bool next(struct finder *f, struct path_step *step)
{
    return ceduo_path_next(f->path, f->length, &f->at, step);
}

static bool ended(const struct finder *f)
{
    return f->at == f->length;
}

/* A place in brackets, of n. */
static bool next_index(struct finder *f, size_t n, size_t *index)
{
    struct path_step step;
    return next(f, &step) && step.bracket && ceduo_path_index(&step, index) && *index < n;
}

/* The name of an item; a belt has its stand's. */
static const char *name_of(const struct object *object, const char *item)
{
    const struct field *f = ceduo_schema_field(object, "name");
    const char *name = NULL;
    if (object == ceduo_schema_belt())
        return ((const struct ceduo_belt *)(const void *)item)->name;
    if (f)
        memcpy(&name, item + f->offset, sizeof name);
    return name;
}

/* Goes into the item of a list that the next step means. */
static bool enter_item(struct finder *f, const struct object *object, char *items, size_t n)
{
    struct path_step step;
    size_t i;
    if (!next(f, &step) || !step.bracket || !items) /* an empty list, or segments of materials that cannot be used */
        return false;
    if (!ceduo_path_index(&step, &i))
        for (i = 0; i < n && !ceduo_path_is(&step, name_of(object, items + i * object->size));)
            i++;
    f->object = object;
    f->item = items + i * object->size;
    return i < n;
}

static bool enter_list(struct finder *f, const struct field *list)
{
    struct ceduo_slope *slope = &f->scene->slope;
    char *items;
    size_t n;
    if (list->object == ceduo_schema_segment()) { /* one may be for all; materials give one for each stretch */
        size_t given = slope->segments_given;
        n = given > 0 ? given : slope->vertices - 1;
        f->n = given == 1 ? slope->vertices - 1 : 1;
        if (!enter_item(f, list->object, (char *)slope->segments, n))
            return false;
        if (slope->reversed && given > 1) /* its file has them in the other order */
            f->item = (char *)(slope->segments + n - 1) - (f->item - (char *)slope->segments);
        return true;
    }
    if (list->object == ceduo_schema_belt() && list->flags & FIELD_DRAFT) /* the forest is the only option */
        return f->scene->options_count == 1 &&
               enter_item(f, list->object, (char *)f->scene->options[0].belts, f->scene->options[0].belts_count);
    if (list->flags & (FIELD_DRAFT | FIELD_NOWHERE))
        return false;
    memcpy(&items, f->item + list->offset, sizeof items);
    memcpy(&n, f->item + list->beside, sizeof n);
    if (list->flags & FIELD_OR_ONE && f->path[f->at] == '.') { /* the only one, without a place */
        f->object = list->object;
        f->item = items;
        return n == 1;
    }
    return enter_item(f, list->object, items, n);
}

/* The field that the path ends in, or that holds the numbers that it goes on to. */
static const struct field *find_leaf(struct finder *f)
{
    struct path_step step;
    const struct field *field;
    while (next(f, &step)) {
        if (!(field = ceduo_schema_step(f->object, &step)))
            return NULL;
        if (field->type == FIELD_GROUP) {
            f->object = field->object;
            f->item += field->offset;
        } else if (field->type != FIELD_LIST) {
            return field;
        } else if (!enter_list(f, field)) {
            return NULL;
        }
    }
    return NULL;
}

/* ---- kinds of numbers ---- */

/* mean, spread, or nothing more. */
static bool find_part(struct finder *f, struct value *v)
{
    struct path_step step;
    if (!next(f, &step))
        return ended(f);
    v->part = ceduo_path_is(&step, "spread") ? VALUE_SPREAD : VALUE_WHOLE;
    return !step.bracket && (v->part == VALUE_SPREAD || ceduo_path_is(&step, "mean")) && ended(f);
}

static bool find_vertex(struct finder *f, struct value *v)
{
    struct ceduo_slope *s = &f->scene->slope;
    size_t i, k;
    if (s->segments_given == 0) /* materials may have put vertices of their own between */
        return false;
    if (!next_index(f, s->vertices, &i) || !next_index(f, 2, &k) || (k == 0 && i == 0)) /* all is relative to that x */
        return false;
    v->at = k == 0 ? &s->x[i] : &s->z[i];
    v->origin = k == 0 ? s->origin_x : s->origin_z;
    return ended(f);
}

static bool find_number(struct finder *f, const struct field *field, struct value *v)
{
    char *at = f->item + field->offset, *items;
    size_t n, i;
    *v = (struct value){.field = field, .at = at, .n = f->n, .stride = f->object->size};
    v->origin = field->flags & FIELD_PLACE ? f->scene->slope.origin_x : 0;
    switch (field->type) {
    case FIELD_NUMBER:
        v->relative = field->flags & FIELD_PLACE ? (double *)(void *)(f->item + field->beside) : NULL;
        return ended(f);
    case FIELD_COUNT:
    case FIELD_CHOICE:
        return ended(f);
    case FIELD_SPREAD:
        return find_part(f, v);
    case FIELD_SPREADS:
        v->at = next_index(f, 3, &i) ? at + i * sizeof(struct ceduo_number) : NULL;
        return v->at && find_part(f, v);
    case FIELD_NUMBERS:
        memcpy(&items, at, sizeof items);
        memcpy(&n, f->item + field->beside, sizeof n);
        v->at = next_index(f, n, &i) ? items + i * sizeof(double) : NULL;
        return v->at && ended(f);
    case FIELD_POINTS:
        return find_vertex(f, v);
    default:
        return false;
    }
}

bool ceduo_value_find(struct ceduo_scene *scene, const char *path, struct value *value)
{
    struct finder f = {
        .scene = scene, .path = path, .length = strlen(path), .object = ceduo_schema_scene(), .item = (char *)scene, .n = 1};
    const struct field *field = find_leaf(&f);
    return field && !(field->flags & (FIELD_NOWHERE | FIELD_DRAFT)) && find_number(&f, field, value);
}

/* ---- get and put ---- */

static bool is_spread(const struct field *f)
{
    return f->type == FIELD_SPREAD || f->type == FIELD_SPREADS;
}

static double get_count(const struct field *f, const void *at)
{
    uint64_t count = 0;
    memcpy(&count, at, f->size);
    return (double)count;
}

static double get_choice(const void *at)
{
    int choice;
    memcpy(&choice, at, sizeof choice);
    return choice;
}

double ceduo_value_get(const struct value *v)
{
    const struct ceduo_number *n = v->at;
    if (v->field->type == FIELD_COUNT)
        return get_count(v->field, v->at);
    if (v->field->type == FIELD_CHOICE)
        return get_choice(v->at);
    if (v->part == VALUE_SPREAD)
        return n->spread / v->field->scale;
    double si = is_spread(v->field) ? n->mean : *(const double *)v->at;
    return (v->relative ? si : si + v->origin) / v->field->scale;
}

/* The number with its mean or its spread at a value; false where that lies outside the range. */
static bool change(const struct value *v, double number, struct ceduo_number *n)
{
    bool spread = v->part == VALUE_SPREAD;
    bool good = spread ? number >= 0 && isfinite(number) : ceduo_schema_in_range(v->field, number);
    double si = number * v->field->scale;
    *(spread ? &n->spread : &n->mean) = spread ? si : si - v->origin;
    struct ceduo_number given = *n;
    given.mean += v->origin;
    return good && ceduo_schema_spread_fits(v->field, given);
}

/* To the word of that index; -1: not said. */
static bool put_choice(const struct value *v, double number)
{
    if (!(number >= -1) || number != floor(number) || !(number < (double)v->field->choices->n))
        return false;
    int choice = (int)number;
    memcpy(v->at, &choice, sizeof choice);
    return true;
}

bool ceduo_value_put(const struct value *v, double number)
{
    const struct field *f = v->field;
    struct ceduo_number changed = {0};
    if (f->type == FIELD_CHOICE)
        return put_choice(v, number);
    if (is_spread(f)) {
        memcpy(&changed, v->at, sizeof changed);
        if (!change(v, number, &changed))
            return false;
    } else if (!ceduo_schema_in_range(f, number) || (f->type == FIELD_COUNT && number != floor(number))) {
        return false;
    }
    double si = number * f->scale, here = v->relative ? si : si - v->origin;
    for (size_t i = 0; i < v->n; i++) {
        char *at = (char *)v->at + i * v->stride;
        if (is_spread(f))
            memcpy(at, &changed, sizeof changed);
        else if (f->type == FIELD_COUNT)
            ceduo_schema_put_count(f, at, (uint64_t)number);
        else
            memcpy(at, &here, sizeof here);
    }
    if (v->relative)
        *v->relative = si - v->origin;
    return true;
}

void ceduo_value_forget(const struct value *v)
{
    const double none = NAN; /* of a spread its mean */
    for (size_t i = 0; i < v->n; i++)
        memcpy((char *)v->at + i * v->stride, &none, sizeof none); /* no place along the slope: all these must be given */
}
