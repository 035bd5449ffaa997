/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a scene says is not known: each row becomes an input, with the places that it stands for. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "derive.h"
#include "inputs.h"
#include "resolve.h"
#include "scene/value.h"

/* ---- places ---- */

struct places {
    struct deriver *d;
    const char **items;
    size_t n, room;
};

static void add_place(struct places *p, const char *path)
{
    if (p->n < p->room)
        p->items[p->n++] = ceduo_derive_text(p->d, "%s", path);
}

/* The list that a path before its [*] leads to; NULL: none. */
static const struct node *list_at(const struct node *root, const char *path)
{
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(root, path, &within, &used);
    return node && path[used] == '\0' && node->kind == NODE_LIST ? node : NULL;
}

/* The path, with every [*] replaced by each item in turn. False where there is no such list. */
static bool add_all(struct places *p, const char *path)
{
    const char *star = strstr(path, "[*]");
    if (!star) {
        add_place(p, path);
        return true;
    }
    const char *before = ceduo_derive_text(p->d, "%.*s", (int)(star - path), path);
    const struct node *list = list_at(p->d->root, before);
    for (size_t i = 0; list && i < list->n; i++)
        if (!add_all(p, ceduo_derive_text(p->d, "%s[%zu]%s", before, i, star + 3)))
            return false;
    return list != NULL;
}

#define GROUND "slope.materials["

/* The name and the key of slope.materials[NAME].KEY; NULL: the path is not of that form. */
static const char *ground_of(struct deriver *d, const char *path, const char **key)
{
    const size_t before = sizeof GROUND - 1;
    const char *end = strchr(path, ']');
    if (strncmp(path, GROUND, before) != 0 || !end || end[1] != '.')
        return NULL;
    *key = end + 2;
    return ceduo_derive_text(d, "%.*s", (int)(end - path - (ptrdiff_t)before), path + before);
}

/* That ground wherever it is. */
static bool add_ground(struct places *p, const char *path)
{
    const char *key, *name = ground_of(p->d, path, &key);
    if (name)
        p->n = ceduo_input_ground(p->d->arena, p->d->root, &p->d->draft.scene, name, key, p->items);
    return name != NULL;
}

/* The row of the table of keys that a path means, whether the scene has such an item or not; NULL: there is none. */
static const struct field *row_of(struct deriver *d, const char *path)
{
    const char *key, *ground = ground_of(d, path, &key);
    if (ground)
        return ceduo_choice_find(&ceduo_material_words, ground) < 0 ? NULL
                                                                   : ceduo_schema_field(ceduo_schema_segment(), key);
    char *first = ceduo_arena_string(d->arena, path);
    for (char *p = first; p && *p; p++)
        if (p[0] == '[' && p[1] == '*')
            p[1] = '0';
    return first ? ceduo_schema_at(first) : NULL;
}

static bool is_number_or_word(const struct field *f)
{
    return f && !(f->flags & (FIELD_NOWHERE | FIELD_DRAFT)) &&
           (f->type == FIELD_NUMBER || f->type == FIELD_SPREAD || f->type == FIELD_SPREADS || f->type == FIELD_COUNT ||
            f->type == FIELD_CHOICE || f->type == FIELD_NUMBERS || f->type == FIELD_POINTS);
}

/* All places of a path, which are one kind of value: that is returned. NULL where there are none: the path may be of
 * something that this scene has not, as a stand that was exchanged; if it is of nothing at all, that is told. */
static const struct field *find_places(struct deriver *d, const char *at, const char *path, struct places *p)
{
    const struct field *field = NULL;
    struct value v;
    size_t stretches = d->draft.scene.slope.vertices;
    p->room = stretches + CEDUO_ITEMS_MOST;
    p->items = ceduo_bind_take(d->arena, p->room, sizeof *p->items, d->problems);
    size_t found = 0;
    if (!is_number_or_word(row_of(d, path))) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.path", at), _("'%s' is not a number or a word of a scene"), path);
        return NULL;
    }
    if (!p->items || (!add_ground(p, path) && !add_all(p, path)))
        return NULL;
    for (size_t i = 0; i < p->n; i++)
        if (ceduo_value_find(&d->draft.scene, p->items[i], &v) && (!field || v.field == field) && v.part == VALUE_WHOLE) {
            field = v.field;
            p->items[found++] = p->items[i];
        }
    p->n = found;
    return field;
}

/* ---- ranges ---- */

static bool complain_range(struct deriver *d, const char *at, const char *key, const struct field *field, double value)
{
    struct text range = {0};
    char room[CEDUO_NUMBER_ROOM];
    if (ceduo_schema_in_range(field, value))
        return false;
    ceduo_schema_range_text(field, &range);
    ceduo_derive_complain(d, ceduo_derive_text(d, "%s.%s", at, key), _("%s is outside the range of %s: %s"),
                          ceduo_number_shortest(value, room), field->key, ceduo_text_string(&range));
    ceduo_text_free(&range);
    return true;
}

static bool read_range(struct deriver *d, const char *at, const struct doubt *row, const struct field *field,
                       struct ceduo_input *input)
{
    bool normal = !isnan(row->mean);
    input->kind = normal ? CEDUO_INPUT_NORMAL : CEDUO_INPUT_RANGE;
    input->mean = row->mean;
    input->sd = row->sd;
    input->lo = normal ? row->mean - 3 * row->sd : row->lo;
    input->hi = normal ? row->mean + 3 * row->sd : row->hi;
    if (!(input->lo < input->hi)) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.%s", at, normal ? "sd" : "hi"),
                              normal ? _("the range is empty; sd must be above 0") : _("the range is empty; hi must be above lo"));
        return false;
    }
    return !complain_range(d, at, normal ? "mean" : "lo", field, input->lo) &&
           !complain_range(d, at, normal ? "sd" : "hi", field, input->hi);
}

static bool read_words(struct deriver *d, const char *at, const struct doubt *row, const struct field *field,
                       struct ceduo_input *input)
{
    int *words = ceduo_bind_take(d->arena, row->one_of_count, sizeof *words, d->problems);
    input->kind = CEDUO_INPUT_WORDS;
    input->words = words;
    input->words_count = row->one_of_count;
    if (row->one_of_count < 2)
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.one_of", at), _("name at least two words"));
    for (size_t i = 0; words && i < row->one_of_count; i++) {
        struct text all = {0};
        words[i] = ceduo_choice_find(field->choices, row->one_of[i]);
        if (words[i] >= 0)
            continue;
        ceduo_text_words(&all, field->choices->names, field->choices->n, ", ");
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.one_of[%zu]", at, i), _("'%s' is unknown; one of: %s"),
                              row->one_of[i], ceduo_text_string(&all));
        ceduo_text_free(&all);
        return false;
    }
    return words && row->one_of_count >= 2;
}

/* Which of its three forms a row has; exactly one. */
static bool check_form(struct deriver *d, const char *at, const struct doubt *row, const struct field *field)
{
    int range = !isnan(row->lo) + !isnan(row->hi), normal = !isnan(row->mean) + !isnan(row->sd);
    bool words = row->one_of != NULL, choice = field->type == FIELD_CHOICE;
    bool one = range == 2 ? normal == 0 && !words : normal == 2 ? range == 0 && !words : words && range + normal == 0;
    if (!one)
        ceduo_derive_complain(d, at, choice ? _("give one_of: the words that it may be") : _("give lo and hi, or mean and sd"));
    else if (words != choice)
        ceduo_derive_complain(d, at, choice ? _("'%s' is a word; give one_of") : _("'%s' is a number; give lo and hi, or mean and sd"),
                              field->key);
    return one && words == choice;
}

static void derive_row(struct deriver *d, size_t i, struct ceduo_input *inputs, size_t *n)
{
    const struct doubt *row = &d->draft.doubts[i];
    const char *at = ceduo_derive_text(d, "doubt[%zu]", i);
    struct places places = {.d = d};
    struct ceduo_input input = {.path = row->path};
    const struct field *field = find_places(d, at, row->path, &places);
    if (!field || !check_form(d, at, row, field))
        return;
    bool good = field->type == FIELD_CHOICE ? read_words(d, at, row, field, &input) : read_range(d, at, row, field, &input);
    for (size_t k = 0; k < *n; k++)
        if (strcmp(inputs[k].path, row->path) == 0) {
            ceduo_derive_complain(d, ceduo_derive_text(d, "%s.path", at), _("'%s' is given twice"), row->path);
            good = false;
        }
    input.places = places.items;
    input.places_count = places.n;
    if (good)
        inputs[(*n)++] = input;
}

void ceduo_derive_doubts(struct deriver *d)
{
    size_t n = d->draft.doubts_count;
    if (n == 0 || !ceduo_derive_sound(d, "doubt") || !d->profile || ceduo_derive_too_many(d, "doubt", n))
        return;
    struct ceduo_input *inputs = ceduo_bind_take(d->arena, n, sizeof *inputs, d->problems);
    for (size_t i = 0; inputs && i < n; i++)
        derive_row(d, i, inputs, &d->inputs_count);
    d->inputs = inputs;
}
