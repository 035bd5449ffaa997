/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a scene and its stands say is not known: each row becomes an input, with the places that it stands for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "derive.h"
#include "inputs.h"
#include "resolve.h"
#include "scene/value.h"

/* A row, where it stands, and what its path begins at: "" or a stand and a dot. */
struct said {
    const struct doubt *row;
    const char *at, *within;
};

/* ---- places ---- */

struct places {
    struct deriver *d;
    const char **items;
    size_t n, room;
};

/* For so many more. False without memory. */
static bool make_room(struct places *p, size_t more)
{
    const char **items = ceduo_bind_room(p->d->arena, p->items, p->n, more, &p->room, sizeof *items, p->d->problems);
    p->items = items ? items : p->items;
    return items != NULL;
}

/* The list that a path before its [*] leads to; NULL: none. */
static const struct node *list_at(const struct node *root, const char *path)
{
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(root, path, &within, &used);
    return path[used] == '\0' && node->kind == NODE_LIST ? node : NULL;
}

/* The path with the number of an item in place of its name: paths of one place are alike. */
static const char *with_numbers(struct deriver *d, const char *path)
{
    struct path_step step;
    size_t at = 0, place;
    while (ceduo_path_next(path, strlen(path), &at, &step)) {
        if (!step.bracket || ceduo_path_index(&step, &place))
            continue;
        int before = (int)(step.p - path);
        const struct node *list = list_at(d->root, ceduo_derive_text(d, "%.*s", before - 1, path));
        if (list && ceduo_resolve_item(list, &step, &place))
            return with_numbers(d, ceduo_derive_text(d, "%.*s%zu%s", before, path, place, step.p + step.n));
    }
    return path;
}

static void add_place(struct places *p, const char *path)
{
    if (make_room(p, 1))
        p->items[p->n++] = ceduo_derive_text(p->d, "%s", with_numbers(p->d, path));
}

/* The path, with every [*] replaced by each item in turn; where there is no such list nothing is added. */
static void add_all(struct places *p, const char *path)
{
    const char *star = strstr(path, "[*]");
    if (!star) {
        add_place(p, path);
        return;
    }
    const char *before = ceduo_derive_text(p->d, "%.*s", (int)(star - path), path);
    const struct node *list = list_at(p->d->root, before);
    for (size_t i = 0; list && i < list->n; i++)
        add_all(p, ceduo_derive_text(p->d, "%s[%zu]%s", before, i, star + 3));
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
    if (name && make_room(p, p->d->draft.scene.slope.vertices))
        p->n = ceduo_input_ground(p->d->arena, p->d->root, &p->d->draft.scene, name, key, p->items);
    return name != NULL;
}

/* The path of the first item where it says [*]. */
static const char *first_of(struct deriver *d, const char *path)
{
    char *first = ceduo_arena_string(d->arena, path);
    for (char *p = first; p && *p; p++)
        if (p[0] == '[' && p[1] == '*')
            p[1] = '0';
    return first ? first : "";
}

/* The row of the table of keys that a path means, whether the scene has such an item or not; NULL: there is none. */
static const struct field *row_of(struct deriver *d, const char *path)
{
    const char *key, *ground = ground_of(d, path, &key);
    if (ground)
        return ceduo_choice_find(&ceduo_material_words, ground) < 0 ? NULL : ceduo_schema_field(ceduo_schema_segment(), key);
    return ceduo_schema_at(first_of(d, path));
}

static bool is_number_or_word(const struct field *f)
{
    return f && (f->type == FIELD_NUMBER || f->type == FIELD_SPREAD || f->type == FIELD_COUNT || f->type == FIELD_CHOICE);
}

/* Only those of its places that the scene has. */
static void keep_there(struct places *p)
{
    struct value v;
    size_t there = 0;
    for (size_t i = 0; i < p->n; i++)
        if (ceduo_value_find(&p->d->draft.scene, p->items[i], &v))
            p->items[there++] = p->items[i];
    p->n = there;
}

/* All places of a path, which are one kind of value: that is returned. NULL where there are none: the path may be of
 * something that this scene has not, as a stand that was exchanged; if it is of nothing at all, that is told. */
static const struct field *find_places(struct deriver *d, const struct said *said, struct places *p)
{
    const char *path = ceduo_derive_text(d, "%s%s", said->within, said->row->path);
    const struct field *field = row_of(d, path);
    if (!is_number_or_word(field)) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.path", said->at),
                              said->within[0] ? _("'%s' is not a number or a word of a stand")
                                              : _("'%s' is not a number or a word of a scene"),
                              said->row->path);
        return NULL;
    }
    if (ceduo_schema_is_settled(first_of(d, path))) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.path", said->at),
                              _("no answer is in doubt because of '%s'; name a value of the rock, its release, the slope, a "
                                "stand or the law"),
                              said->row->path);
        return NULL;
    }
    if (!add_ground(p, path))
        add_all(p, path);
    keep_there(p);
    return p->n > 0 ? field : NULL;
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
    bool normal = !isnan(row->mean), gamma = normal && field->lo >= 0 && row->mean > 0 && row->sd > row->mean / 3;
    input->kind = gamma ? CEDUO_INPUT_GAMMA : normal ? CEDUO_INPUT_NORMAL : CEDUO_INPUT_RANGE;
    input->mean = row->mean;
    input->sd = row->sd;
    input->lo = row->lo;
    input->hi = row->hi;
    if (gamma && row->sd > CEDUO_GAMMA_MOST * row->mean) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.sd", at), _("sd is more than %g times the mean; give lo and hi"),
                              CEDUO_GAMMA_MOST);
        return false;
    }
    if (normal) {
        input->lo = gamma ? ceduo_input_quantile(input, 0) : row->mean - 3 * row->sd;
        input->hi = gamma ? ceduo_input_quantile(input, 1) : row->mean + 3 * row->sd;
    }
    if (!(input->lo < input->hi)) {
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.%s", at, normal ? "sd" : "hi"),
                              normal ? _("the range is empty; sd must be above 0")
                                     : _("the range is empty; hi must be above lo"));
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
        ceduo_derive_complain(d, at,
                              choice ? _("'%s' is a word; give one_of") : _("'%s' is a number; give lo and hi, or mean and sd"),
                              field->key);
    return one && words == choice;
}

/* One input of a row. False where it is none, as what it is about is not there, or it is wrong, which is told. */
static bool make_input(struct deriver *d, const struct said *said, struct ceduo_input *input)
{
    struct places places = {.d = d};
    const struct field *field = find_places(d, said, &places);
    if (!field || !check_form(d, said->at, said->row, field))
        return false;
    *input = (struct ceduo_input){
        .path = said->within[0] ? places.items[0] : said->row->path, .places = places.items, .places_count = places.n};
    return field->type == FIELD_CHOICE ? read_words(d, said->at, said->row, field, input)
                                       : read_range(d, said->at, said->row, field, input);
}

static void complain_twice(struct deriver *d, const struct said *said)
{
    ceduo_derive_complain(d, ceduo_derive_text(d, "%s.path", said->at), _("'%s' is given twice"), said->row->path);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Whether an input before a row has its path, by whatever name of an item, or is draws of one of its places. */
static bool is_said(struct deriver *d, const struct ceduo_input *before, const struct ceduo_input *row)
{
    if (before->kind != CEDUO_INPUT_DRAWS)
        return ceduo_schema_same(with_numbers(d, before->path), with_numbers(d, row->path));
    for (size_t i = 0; i < row->places_count; i++)
        if (bsearch(&row->places[i], before->places, before->places_count, sizeof *before->places, by_name))
            return true;
    return false;
}

static void derive_row(struct deriver *d, size_t i, struct ceduo_input *inputs, size_t *n)
{
    const struct said said = {&d->draft.doubts[i], ceduo_derive_text(d, "doubt[%zu]", i), ""};
    struct ceduo_input input;
    if (!make_input(d, &said, &input))
        return;
    for (size_t k = 0; k < *n; k++)
        if (is_said(d, &inputs[k], &input)) {
            complain_twice(d, &said);
            return;
        }
    inputs[(*n)++] = input;
}

/* ---- of stands ---- */

/* A row of a stand. Many belts may have the stand: then it stands for the places in all of them. */
struct stand_row {
    const struct node *node;
    size_t input; /* SIZE_MAX: it is none, as it is wrong or about what the stand has not */
};

struct stand_rows {
    struct deriver *d;
    struct stand_row *items;
    size_t n, of_scene; /* inputs that the scene itself names come first */
    struct ceduo_input *inputs;
    size_t inputs_count;
};

static bool is_of_scene(const struct stand_rows *s, const char *place)
{
    for (size_t i = 0; i < s->of_scene; i++)
        for (size_t k = 0; k < s->inputs[i].places_count; k++)
            if (ceduo_schema_same(s->inputs[i].places[k], place))
                return true;
    return false;
}

/* Adds the places of one input to those of another, but for what the scene itself names. */
static void join(struct stand_rows *s, struct ceduo_input *to, const struct ceduo_input *from)
{
    const char **all = ceduo_bind_take(s->d->arena, to->places_count + from->places_count, sizeof *all, s->d->problems);
    size_t n = 0;
    for (size_t i = 0; all && i < to->places_count; i++)
        all[n++] = to->places[i];
    for (size_t i = 0; all && i < from->places_count; i++)
        if (!is_of_scene(s, from->places[i]))
            all[n++] = from->places[i];
    to->places = all;
    to->places_count = n;
}

static void add_stand_row(struct stand_rows *s, const struct said *said, const struct node *node)
{
    struct stand_row *known = s->items;
    struct ceduo_input input;
    while (known < s->items + s->n && known->node != node)
        known++;
    bool is_new = known == s->items + s->n;
    if (is_new) {
        *known = (struct stand_row){node, SIZE_MAX};
        s->n++;
    } else if (known->input == SIZE_MAX) {
        return;
    }
    if (!make_input(s->d, said, &input))
        return;
    if (is_new) {
        known->input = s->inputs_count;
        s->inputs[s->inputs_count] = input;
        s->inputs[s->inputs_count++].places_count = 0;
    }
    join(s, &s->inputs[known->input], &input);
}

static void take_stand(struct stand_rows *s, const char *path, const struct node *stand)
{
    const struct object *object = ceduo_schema_field(ceduo_schema_stand(), "doubt")->object;
    const struct node *rows = ceduo_node_get(stand, "doubt");
    const char *within = ceduo_derive_text(s->d, "%s.", path);
    for (size_t i = 0; rows && rows->kind == NODE_LIST && i < rows->n; i++) {
        struct doubt row;
        const struct source_note *notes = NULL;
        const char *at = ceduo_derive_text(s->d, "%sdoubt[%zu]", within, i);
        if (!ceduo_derive_sound(s->d, at))
            continue;
        ceduo_schema_init(object, &row);
        ceduo_bind(s->d->arena, object, rows->items[i], &row, s->d->problems, &notes, &s->d->bad);
        const struct said said = {&row, at, within};
        bool twice = false;
        for (size_t k = 0; k < i; k++) {
            const char *other = ceduo_node_text(rows->items[k], "path");
            twice |= other && ceduo_schema_same(other, row.path);
        }
        if (twice)
            complain_twice(s->d, &said);
        else
            add_stand_row(s, &said, rows->items[i]);
    }
}

/* Calls `one` for the stand of each belt. */
static void each_stand(struct deriver *d, void (*one)(struct stand_rows *s, const char *path, const struct node *stand),
                       struct stand_rows *s)
{
    const struct node *options = ceduo_node_get(d->root, "options");
    bool many = options && options->kind == NODE_LIST;
    for (size_t i = 0; i < (many ? options->n : 1); i++) {
        const struct node *forest = ceduo_node_get(many ? options->items[i] : d->root, "forest");
        const char *in = many ? ceduo_derive_text(d, "options[%zu].", i) : "";
        for (size_t k = 0; forest && forest->kind == NODE_LIST && k < forest->n; k++)
            one(s, ceduo_derive_text(d, "%sforest[%zu].stand", in, k), ceduo_node_get(forest->items[k], "stand"));
    }
}

static void count_rows(struct stand_rows *s, const char *path, const struct node *stand)
{
    const struct node *rows = ceduo_node_get(stand, "doubt");
    (void)path;
    s->n += rows && rows->kind == NODE_LIST ? rows->n : 0;
}

void ceduo_derive_doubts(struct deriver *d)
{
    size_t n = ceduo_derive_sound(d, "doubt") ? d->draft.doubts_count : 0;
    struct stand_rows s = {.d = d};
    each_stand(d, count_rows, &s);
    if (n + s.n + (d->draws != NULL) == 0 || !d->profile || ceduo_derive_too_many(d, "doubt", n))
        return;
    s.items = ceduo_bind_take(d->arena, s.n, sizeof *s.items, d->problems);
    s.inputs = ceduo_bind_take(d->arena, n + s.n + 1, sizeof *s.inputs, d->problems);
    if (!s.items || !s.inputs)
        return;
    s.inputs_count = d->draws && ceduo_derive_draws(d, s.inputs) ? 1 : 0;
    for (size_t i = 0; i < n; i++)
        derive_row(d, i, s.inputs, &s.inputs_count);
    s.n = 0;
    s.of_scene = s.inputs_count;
    each_stand(d, take_stand, &s);
    d->inputs = s.inputs;
    d->inputs_count = s.inputs_count;
    d->inputs_of_scene = s.of_scene;
}

/* ---- values to be fitted ---- */

#define SEGMENTS "slope.segments[*]."

/* A ground that stands in no list of segments: one place for each stretch. */
static void add_stretches(struct places *p, const char *key)
{
    size_t stretches = p->d->draft.scene.slope.vertices - 1;
    for (size_t j = 0; j < stretches; j++)
        add_place(p, ceduo_derive_text(p->d, "slope.segments[%zu].%s", j, key));
}

static void find_ground(struct places *p, bool talus, const char *path)
{
    const char *key = NULL, *name = ground_of(p->d, path, &key);
    bool listed = p->d->draft.scene.slope.segments_given > 0;
    if (name && talus && strcmp(name, ceduo_material_talus()->name) == 0)
        add_stretches(p, key);
    else if (!name && !listed && strncmp(path, SEGMENTS, sizeof SEGMENTS - 1) == 0)
        add_stretches(p, path + sizeof SEGMENTS - 1);
    else if (!add_ground(p, path))
        add_all(p, path);
}

const struct field *ceduo_derive_find(struct deriver *d, const char *path, bool talus, struct ceduo_input *input)
{
    struct places p = {.d = d};
    const struct field *field = row_of(d, path);
    *input = (struct ceduo_input){.path = path, .kind = CEDUO_INPUT_RANGE};
    if (!is_number_or_word(field) || field->type == FIELD_CHOICE || ceduo_schema_is_settled(first_of(d, path)))
        return NULL;
    find_ground(&p, talus, path);
    keep_there(&p);
    input->places = p.items;
    input->places_count = p.n;
    return d->arena->failed ? NULL : field;
}

const struct field *ceduo_input_find(struct scene_file *file, const char *path, struct ceduo_input *input)
{
    struct problems problems = {0};
    struct deriver d = {.arena = &file->arena, .root = file->root, .problems = &problems};
    d.draft.scene = file->scene;
    return ceduo_derive_find(&d, path, file->ground_assumed, input);
}
