/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "schema.h"
#include "rock.h"

#include <math.h>
#include <string.h>

bool ceduo_path_next(const char *path, size_t length, size_t *pos, struct path_step *step)
{
    size_t i = *pos;
    if (i >= length)
        return false;
    if (path[i] == '[') {
        const char *end = memchr(path + i, ']', length - i);
        if (!end || end == path + i + 1)
            return false;
        *step = (struct path_step){path + i + 1, (size_t)(end - path) - i - 1, true};
        *pos = (size_t)(end - path) + 1;
        return true;
    }
    if (i > 0) {
        if (path[i] != '.')
            return false;
        i++;
    }
    size_t from = i;
    while (i < length && path[i] != '.' && path[i] != '[')
        i++;
    if (i == from)
        return false;
    *step = (struct path_step){path + from, i - from, false};
    *pos = i;
    return true;
}

const char *ceduo_paths_next(const char **rest, size_t *n)
{
    const char *path = *rest + strspn(*rest, " ");
    bool inside = false;
    for (*n = 0; path[*n] && (inside || path[*n] != ' '); ++*n)
        inside = path[*n] == '[' || (inside && path[*n] != ']');
    *rest = path + *n;
    return *n > 0 ? path : NULL;
}

bool ceduo_path_is(const struct path_step *step, const char *word)
{
    return word && strlen(word) == step->n && memcmp(step->p, word, step->n) == 0;
}

bool ceduo_path_index(const struct path_step *step, size_t *index)
{
    *index = 0;
    for (size_t i = 0; i < step->n; i++) {
        if (step->p[i] < '0' || step->p[i] > '9' || i > 8)
            return false;
        *index = *index * 10 + (size_t)(step->p[i] - '0');
    }
    return true;
}

const struct field *ceduo_schema_field(const struct object *object, const char *key)
{
    return ceduo_schema_step(object, &(const struct path_step){.p = key, .n = strlen(key)});
}

const struct field *ceduo_schema_unit(const struct object *object, const struct field *field)
{
    const char *key = ceduo_schema_alternative(object, field->key);
    const struct field *pair = key ? ceduo_schema_field(object, key) : NULL;
    return pair && pair->offset == field->offset ? pair : NULL;
}

const struct field *ceduo_schema_step(const struct object *object, const struct path_step *step)
{
    for (size_t i = 0; i < object->n; i++)
        if (!step->bracket && ceduo_path_is(step, object->fields[i].key))
            return &object->fields[i];
    return NULL;
}

const struct field *ceduo_schema_list(const struct object *object, const struct field *f)
{
    bool is_list = f + 1 < object->fields + object->n && strcmp(f->key, f[1].key) == 0;
    return is_list ? f + 1 : NULL;
}

/* Return the row of the first n bytes of a path. *flags: of the row and the enclosing rows. */
static const struct field *find_row(const char *path, size_t n, unsigned *flags)
{
    const struct object *object = ceduo_schema_scene();
    const struct field *f = NULL, *list = NULL;
    struct path_step step;
    size_t pos = 0;
    while (ceduo_path_next(path, n, &pos, &step)) {
        if (step.bracket && list) {
            f = list;
            object = NULL;
        }
        bool item = f && f->type == FIELD_LIST && object == NULL;
        if (item && !step.bracket && f->flags & FIELD_SCALAR_OK) {
            item = false;
            object = f->object;
        }
        if (step.bracket != item)
            return NULL;
        const struct field *found = item ? f : object ? ceduo_schema_step(object, &step) : NULL;
        if (!found)
            return NULL;
        list = item ? NULL : ceduo_schema_list(object, found);
        f = found;
        *flags |= (unsigned)f->flags;
        object = item || f->type == FIELD_GROUP ? f->object : NULL;
    }
    return pos == n ? f : NULL;
}

const struct field *ceduo_schema_row(const char *path)
{
    unsigned flags = 0;
    return find_row(path, strlen(path), &flags);
}

const struct field *ceduo_schema_at(const char *path)
{
    const struct field *f = ceduo_schema_row(path);
    return f && !f->object ? f : NULL;
}

const struct field *ceduo_schema_fitted(const char *path)
{
    static const char ground[] = "slope.materials[";
    const char *rest = path;
    size_t n;
    LOCAL_TEXT(first);
    if (ceduo_paths_next(&rest, &n) && rest[strspn(rest, " ")]) {
        ceduo_text_append_n(&first, path + strspn(path, " "), n);
        path = ceduo_text_string(&first);
    }
    const char *end = strncmp(path, ground, sizeof ground - 1) == 0 ? strchr(path, ']') : NULL;
    return end && end[1] == '.' ? ceduo_schema_field(ceduo_schema_segment(), end + 2) : ceduo_schema_at(path);
}

bool ceduo_schema_is_settled(const char *path)
{
    unsigned flags = 0;
    return find_row(path, strlen(path), &flags) && flags & FIELD_CERTAIN;
}

/* ---- paths of --set ---- */

static enum path_value path_kind(const struct field *f)
{
    switch (f->type) {
    case FIELD_TEXT:
        return PATH_TEXT;
    case FIELD_FILE:
        return PATH_FILE;
    case FIELD_NUMBER:
    case FIELD_SPREAD:
    case FIELD_COUNT:
        return PATH_NUMBER;
    case FIELD_CHOICE:
    case FIELD_FLAG:
        return PATH_WORD;
    default:
        return f->flags & FIELD_FOLLOWS ? PATH_FILE : PATH_OTHER;
    }
}

/* Return the kind of the value at `rest` below a mapping or list item: its source, or a part of the source. */
static enum path_value source_part(const char *rest)
{
    size_t n = strlen("source");
    if (strncmp(rest, "source", n) != 0 || (rest[n] && rest[n] != '.'))
        return PATH_UNKNOWN;
    return strcmp(rest, "source.text") == 0 ? PATH_TEXT : PATH_OTHER;
}

/* Return the kind of the value at `rest` below a value: a number of a list or point, a part of a spread. */
static enum path_value value_part(const struct field *f, const char *rest)
{
    size_t pos = 0, n = strlen(rest), item;
    struct path_step step;
    bool spread = f->type == FIELD_SPREAD || f->type == FIELD_SPREADS;
    size_t depth = f->type == FIELD_POINTS ? 2 : f->type >= FIELD_NUMBERS || f->type == FIELD_SPREADS ? 1 : 0, steps = 0;
    while (steps < depth && rest[pos] == '[' && ceduo_path_next(rest, n, &pos, &step)) {
        if (!ceduo_path_index(&step, &item)) /* numbers have no names */
            return PATH_UNKNOWN;
        steps++;
    }
    if (pos == n)
        return steps < depth ? PATH_OTHER : f->type == FIELD_WORDS ? PATH_TEXT : PATH_NUMBER;
    if (!spread || steps < depth)
        return PATH_UNKNOWN;
    if (strcmp(rest + pos, ".mean") == 0 || strcmp(rest + pos, ".spread") == 0)
        return PATH_NUMBER;
    return strcmp(rest + pos, ".kind") == 0 ? PATH_WORD : PATH_UNKNOWN;
}

enum path_value ceduo_schema_value(const char *path)
{
    unsigned flags = 0;
    size_t n = strlen(path);
    const struct field *f = find_row(path, n, &flags);
    if (f)
        return f->type == FIELD_LIST && path[n - 1] == ']' ? PATH_OTHER : path_kind(f);
    for (; n > 0 && !f; n -= !f) /* the longest prefix with a row */
        f = path[n] == '.' || path[n] == '[' ? find_row(path, n, &flags) : NULL;
    if (!f)
        return source_part(path);
    if (f->type != FIELD_GROUP && f->type != FIELD_LIST)
        return value_part(f, path + n);
    bool list = f->type == FIELD_LIST && path[n - 1] != ']' && !(f->flags & FIELD_SCALAR_OK);
    return path[n] == '.' && !list ? source_part(path + n + 1) : PATH_UNKNOWN;
}

/* ---- defaults ---- */

double ceduo_schema_default(const struct field *f)
{
    double value = f->flags & FIELD_ZERO ? 0 : NAN;
    if (f->value)
        ceduo_number_read(f->value, &value);
    return value * f->scale;
}

static void init_fields(const struct object *object, char *item)
{
    for (const struct field *f = object->fields; f < object->fields + object->n; f++) {
        void *to = item + f->offset;
        struct ceduo_number *numbers = to;
        double number = f->flags & FIELD_ONE_OF ? NAN : ceduo_schema_default(f);
        uint64_t count = 0;
        int choice = f->value && f->choices ? ceduo_choice_find(f->choices, f->value) : -1;
        bool flag = f->value && strcmp(f->value, "true") == 0;
        if (f->type == FIELD_GROUP)
            init_fields(f->object, to);
        if (f->flags & FIELD_NO_MEMBER)
            continue;
        switch (f->type) {
        case FIELD_NUMBER:
            memcpy(to, &number, sizeof number);
            break;
        case FIELD_SPREAD:
            *numbers = ceduo_number(number);
            break;
        case FIELD_SPREADS:
            numbers[0] = numbers[1] = numbers[2] = ceduo_number(number);
            break;
        case FIELD_COUNT:
            if (f->value)
                ceduo_count_read(f->value, f->lo, f->hi, &count);
            ceduo_schema_set_count(f, to, count);
            break;
        case FIELD_CHOICE:
            memcpy(to, &choice, sizeof choice);
            break;
        case FIELD_FLAG:
            memcpy(to, &flag, sizeof flag);
            break;
        default: /* texts and lists have no default */
            break;
        }
    }
}

void ceduo_schema_init(const struct object *object, void *item)
{
    memset(item, 0, object->size);
    init_fields(object, item);
}

void ceduo_schema_set_count(const struct field *f, void *to, uint64_t count)
{
    unsigned small = (unsigned)count;
    if (f->size == sizeof small)
        memcpy(to, &small, sizeof small);
    else
        memcpy(to, &count, sizeof count);
}

struct ceduo_scene ceduo_scene_default(void)
{
    struct scene_draft draft;
    ceduo_schema_init(ceduo_schema_scene(), &draft);
    draft.scene.size = sizeof draft.scene;
    draft.scene.release.x.mean = 0;  /* the first vertex */
    draft.scene.slope.tolerance = 0; /* the default is for ground from the library */
    return draft.scene;
}

struct ceduo_option ceduo_option_default(void)
{
    return (struct ceduo_option){0};
}

/* Defaults of a part, from the table of keys. */
#define DEFAULT(name, schema)                                                                                                  \
    struct ceduo_##name ceduo_##name##_default(void)                                                                           \
    {                                                                                                                          \
        struct ceduo_##name item;                                                                                              \
        ceduo_schema_init(schema, &item);                                                                                      \
        return item;                                                                                                           \
    }
DEFAULT(segment, ceduo_schema_segment())
DEFAULT(belt, ceduo_schema_belt())
DEFAULT(stand, ceduo_schema_stand())
DEFAULT(stems, ceduo_schema_field(ceduo_schema_stand(), "trees")->object)
DEFAULT(rock_def, ceduo_schema_field(ceduo_schema_scene(), "rock")->object)
DEFAULT(control, ceduo_schema_field(ceduo_schema_scene(), "controls")->object)

/* ---- ranges ---- */

bool ceduo_schema_in_range(const struct field *f, double value)
{
    bool low = f->flags & FIELD_ABOVE ? value > f->lo : value >= f->lo;
    bool high = f->flags & FIELD_UNDER ? value < f->hi : value <= f->hi;
    return low && high;
}

bool ceduo_schema_is_usual(const struct field *f, double value)
{
    return value == 0 || (value >= f->shown.usual_min && value <= f->shown.usual_max);
}

bool ceduo_schema_spread_fits(const struct field *f, struct ceduo_number n)
{
    double lowest = ceduo_number_min(n) / f->scale, highest = ceduo_number_max(n) / f->scale;
    bool below = f->flags & FIELD_ABOVE ? !(lowest > f->lo) : lowest < f->lo;
    bool clamped = f->lo == 0 && f->hi == 1; /* draws are truncated to the range */
    return clamped || isnan(n.mean) || !(below || highest > f->hi);
}

#define CONVERTED_MAX 1e4 /* × the maximum in files */

static bool holds_number(const struct field *f, double si)
{
    bool zero = f->flags & FIELD_ZERO, optional = f->flags & FIELD_ONE_OF || (!zero && !f->value);
    /* converted from another key: 10^4 shoots on each of 10^6 stools */
    bool converted = f->flags & FIELD_ONE_OF && si >= f->lo * f->scale && si <= CONVERTED_MAX * f->hi * f->scale;
    return converted || (optional && isnan(si)) || ((optional || zero) && si == 0) || ceduo_schema_in_range(f, si / f->scale);
}

bool ceduo_schema_field_holds(const struct field *f, const void *item)
{
    const char *member = (const char *)item + f->offset, *items;
    size_t n;
    if (f->flags & (FIELD_NO_MEMBER | FIELD_FILE_ONLY))
        return true;
    switch (f->type) {
    case FIELD_NUMBER:
        return f->flags & FIELD_PLACE || holds_number(f, *(const double *)(const void *)member);
    case FIELD_COUNT: { /* 0: not given */
        uint64_t count =
            f->size == sizeof(unsigned) ? *(const unsigned *)(const void *)member : *(const uint64_t *)(const void *)member;
        return count == 0 || f->flags & FIELD_CERTAIN || ceduo_schema_in_range(f, (double)count); /* any seed is valid */
    }
    case FIELD_CHOICE:
        return *(const int *)(const void *)member >= (f->value ? 0 : -1) &&
               *(const int *)(const void *)member < (int)f->choices->n;
    case FIELD_GROUP:
        return ceduo_schema_holds(f->object, member);
    case FIELD_NUMBERS:
    case FIELD_LIST:
        memcpy(&items, member, sizeof items);
        memcpy(&n, (const char *)item + f->companion_offset, sizeof n);
        for (size_t i = 0; items && i < n; i++)
            if (f->type == FIELD_LIST ? !ceduo_schema_holds(f->object, items + i * f->object->size)
                                      : !ceduo_schema_in_range(f, ((const double *)(const void *)items)[i] / f->scale))
                return false;
        return items || n == 0;
    default:
        return true;
    }
}

bool ceduo_schema_holds(const struct object *object, const void *item)
{
    for (size_t i = 0; i < object->n; i++)
        if (!ceduo_schema_field_holds(&object->fields[i], item))
            return false;
    return true;
}

bool ceduo_schema_range_text(const struct field *f, struct text *text)
{
    bool low = isfinite(f->lo), high = isfinite(f->hi);
    if (low && !high)
        ceduo_text_append(text, f->flags & FIELD_ABOVE ? "> " : ">= ");
    else if (low && f->flags & FIELD_ABOVE)
        ceduo_text_append(text, ">");
    if (low)
        ceduo_text_format(text, "%.5g", f->lo);
    if (high)
        ceduo_text_format(text, f->hi > 1e15 ? "\xe2\x80\xa6%s%.17g" : "\xe2\x80\xa6%s%.5g", f->flags & FIELD_UNDER ? "<" : "",
                          f->hi);
    return low || high;
}

/* ---- listing the table ---- */

void ceduo_schema_visit(const struct object *object, const char *prefix,
                        void (*visit)(void *context, const char *path, const struct field *field), void *context)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *f = &object->fields[i];
        struct text path = {0};
        ceduo_text_format(&path, "%s%s%s%s", prefix, prefix[0] ? "." : "", f->key, f->type == FIELD_LIST ? "[]" : "");
        if (path.failed) /* untaken: memory */
            return;
        if (f->type == FIELD_GROUP || f->type == FIELD_LIST)
            ceduo_schema_visit(f->object, path.bytes, visit, context);
        else
            visit(context, path.bytes, f);
        ceduo_text_free(&path);
    }
}

bool ceduo_schema_is_place(const struct field *field)
{
    static const char *const keys[] = {"x_m", "from_m", "to_m", "controls_m"};
    bool place = field->flags & FIELD_PLACE;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        place |= strcmp(field->key, keys[i]) == 0;
    return place;
}

bool ceduo_schema_place_read(const char *text, double *back)
{
    *back = 0;
    bool end = strncmp(text, "end", 3) == 0;
    return end && (!text[3] || (text[3] == '-' && ceduo_number_read(text + 4, back) == CEDUO_NUMBER_GOOD && *back >= 0));
}
