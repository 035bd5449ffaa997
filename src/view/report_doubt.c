/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What doubt does to the figures of a scene, as JSON and CSV; and the words that the page shares with them. */
#include "report_doubt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/language.h"
#include "ceduo/version.h"
#include "scene/ranges.h"
#include "scene/value.h"
#include "words.h"

static const char *const keys[CEDUO_DOUBT_SHOWN] = {"reach_probability", "exceed_probability", "energy_per_released_kJ"};

bool ceduo_doubt_is_off(const struct ceduo_doubt_report *r)
{
    return ceduo_node_text(r->file->root, "doubt") != NULL;
}

const char *ceduo_doubt_none(const struct ceduo_doubt_report *r)
{
    return ceduo_doubt_is_off(r) ? _("Doubt: not computed, because the scene says 'doubt: none'. What is not known may change "
                                     "the answer more than "
                                     "chance does.")
                                 : _("Doubt: nothing in this scene is marked as assumed or named by 'doubt', so its values are "
                                     "taken as they are.");
}

/* ---- inputs ---- */

/* NULL: the last group, of several inputs together. */
static const struct ceduo_input *input_of(const struct ceduo_doubt_report *r, size_t group)
{
    bool several = r->answer->together > 0 && group + 1 == r->answer->groups;
    return several ? NULL : &r->inputs->items[r->answer->input[group]];
}

#define GROUND "slope.materials["

/* The stand that all places are in; NULL: none, or several. */
static const char *stand_name(const struct ceduo_doubt_report *r, const struct ceduo_input *input)
{
    const struct ceduo_belt *first = ceduo_input_belt(&r->file->scene, input->places[0]);
    for (size_t i = 1; first && i < input->places_count; i++)
        if (ceduo_input_belt(&r->file->scene, input->places[i]) != first)
            return NULL;
    return first ? first->name : NULL;
}

/* "trees 2: diameter, cm": a value of stems with whose it is, for several may have one. */
static void put_stems(struct text *text, const struct ceduo_doubt_report *r, const char *place, const char *label)
{
    const struct ceduo_belt *belt = ceduo_input_belt(&r->file->scene, place);
    const char *shoots = strstr(place, ".shoots["), *trees = strstr(place, ".trees[");
    size_t count = !belt ? 0 : shoots ? belt->stand.shoots_count : belt->stand.trees_count;
    const char *bracket = shoots ? shoots + 8 : trees ? trees + 7 : NULL;
    if (!bracket)
        ceduo_text_put(text, label);
    else if (count < 2)
        ceduo_text_format(text, shoots ? _("shoots: %s") : _("trees: %s"), label);
    else
        ceduo_text_format(text, shoots ? _("shoots %lu: %s") : _("trees %lu: %s"), strtoul(bracket, NULL, 10) + 1, label);
}

void ceduo_doubt_input_name(struct text *text, const struct ceduo_doubt_report *r, size_t group)
{
    const struct ceduo_input *input = input_of(r, group);
    struct value v;
    if (!input) {
        ceduo_text_format(text, _("%zu others together"), r->answer->together);
        return;
    }
    const char *place = input->places[0], *stand = stand_name(r, input);
    if (input->kind == CEDUO_INPUT_DRAWS) {
        ceduo_text_put(text, _("left open by calibration"));
        return;
    }
    if (!ceduo_value_find(&r->file->scene, place, &v)) {
        ceduo_text_safe(text, input->path);
        return;
    }
    put_stems(text, r, place, _(v.field->shown.label));
    bool law = input->kind == CEDUO_INPUT_WORDS;
    if (strncmp(input->path, GROUND, sizeof GROUND - 1) == 0)
        ceduo_text_format(text, ", %.*s", (int)strcspn(input->path + sizeof GROUND - 1, "]"), input->path + sizeof GROUND - 1);
    else if (stand && !law) {
        ceduo_text_put(text, ", ");
        ceduo_text_safe(text, stand);
    } else if (strncmp(place, "slope.segments[", 15) == 0 && input->places_count > 1) {
        ceduo_text_then(text, ", ", _("%zu stretches"), input->places_count);
    }
}

/* The value of an end; of words their text, and NaN. */
static double end_of(const struct ceduo_doubt_report *r, size_t group, int end, struct value *v, const char **word)
{
    const struct ceduo_input *input = input_of(r, group);
    *word = NULL;
    if (!input || !ceduo_value_find(&r->file->scene, input->places[0], v))
        return NAN;
    if (input->kind == CEDUO_INPUT_WORDS)
        *word = v->field->choices->names[input->words[end == 0 ? 0 : input->words_count - 1]];
    double value = end == 0 ? input->lo : input->hi;
    return *word ? NAN : input->kind == CEDUO_INPUT_FACTOR ? value * ceduo_value_get(v) : value;
}

void ceduo_doubt_input_end(struct text *text, const struct ceduo_doubt_report *r, size_t group, int end)
{
    char room[CEDUO_NUMBER_ROOM];
    struct value v;
    const char *word;
    double value = end_of(r, group, end, &v, &word);
    if (word || !isnan(value))
        ceduo_text_put(text, word ? word : ceduo_number_shortest(value, room));
}

void ceduo_doubt_input_shown(struct text *text, const struct ceduo_doubt_report *r, size_t group, int end)
{
    struct value v;
    const char *word;
    char room[CEDUO_NUMBER_ROOM];
    double value = end_of(r, group, end, &v, &word);
    if (word)
        ceduo_text_put(text, word);
    else if (!isnan(value)) /* 6.3, not 6.300, which is six thousand in Italian */
        ceduo_text_put(text, ceduo_number_shortest(strtod(WRITTEN(value * v.field->shown.per, 4), NULL), room));
}

const char *ceduo_doubt_measured(const struct ceduo_doubt_report *r, size_t group)
{
    const struct ceduo_input *input = input_of(r, group);
    struct value v;
    if (!input || input->kind == CEDUO_INPUT_WORDS)
        return NULL;
    if (input->kind == CEDUO_INPUT_DRAWS)
        return N_("more of what was seen");
    const struct range *range = ceduo_value_find(&r->file->scene, input->places[0], &v) ? ceduo_range_of(v.field) : NULL;
    return range ? range->measured : N_("on the ground");
}

/* ---- JSON ---- */

static double scale_of(const struct ceduo_doubt_figure *f)
{
    return f->kind == CEDUO_DOUBT_ENERGY ? KILO : 1;
}

static void put_end(struct json *j, const char *key, const struct ceduo_doubt_report *r, size_t group, int end)
{
    struct text text = {0};
    double value;
    ceduo_doubt_input_end(&text, r, group, end);
    if (text.length > 0 && ceduo_number_read(text.bytes, &value) == CEDUO_NUMBER_GOOD)
        ceduo_json_number(j, key, value);
    else
        ceduo_json_string(j, key, text.length > 0 ? text.bytes : NULL);
    ceduo_text_free(&text);
}

static void put_input(struct json *j, const struct ceduo_doubt_report *r, const struct ceduo_doubt_figure *f, size_t g)
{
    const struct ceduo_input *input = input_of(r, g);
    struct text together = {0};
    ceduo_text_format(&together, "%zu inputs together", r->answer->together);
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "path", input ? input->path : ceduo_text_string(&together));
    ceduo_json_count(j, "places", input ? input->places_count : r->answer->together);
    ceduo_json_string(j, "source", input ? r->inputs->sources[r->answer->input[g]] : NULL);
    ceduo_json_string(j, "measured_by", ceduo_doubt_measured(r, g));
    put_end(j, "lo", r, g, 0);
    put_end(j, "hi", r, g, 1);
    ceduo_json_number(j, "first", f->indices.first[g].value);
    ceduo_json_number(j, "first_se", f->indices.first[g].se);
    ceduo_json_number(j, "total", f->indices.total[g].value);
    ceduo_json_number(j, "total_se", f->indices.total[g].se);
    ceduo_json_number(j, "at_lo", f->at[g][0] * scale_of(f));
    ceduo_json_number(j, "at_hi", f->at[g][1] * scale_of(f));
    ceduo_json_number(j, "width_if_known", f->left[g] * scale_of(f));
    if (!input) {
        ceduo_json_open(j, "together", '[');
        for (size_t i = 0; i < r->answer->together; i++)
            ceduo_json_string(j, NULL, r->inputs->items[r->answer->moved[i]].path);
        ceduo_json_close(j, ']');
    }
    ceduo_json_close(j, '}');
    ceduo_text_free(&together);
}

static double last_x(const struct ceduo_scene *s)
{
    return s->controls[ceduo_scene_last_control(s)].x_given;
}

static void put_figure(struct json *j, const struct ceduo_doubt_report *r, const struct ceduo_doubt_figure *f)
{
    const struct ceduo_scene *s = &r->file->scene;
    double scale = scale_of(f);
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "option", s->options[f->option].name);
    ceduo_json_string(j, "against", f->difference ? s->options[0].name : NULL);
    ceduo_json_number(j, "x_m", last_x(s));
    ceduo_json_string(j, "figure", keys[f->kind]);
    ceduo_json_number(j, "value", f->value * scale);
    ceduo_json_number(j, "sampling_lo", f->sampling_lo * scale);
    ceduo_json_number(j, "sampling_hi", f->sampling_hi * scale);
    ceduo_json_number(j, "doubt_p5", f->p5 * scale);
    ceduo_json_number(j, "doubt_p50", f->p50 * scale);
    ceduo_json_number(j, "doubt_p95", f->p95 * scale);
    ceduo_json_open(j, "inputs", '[');
    size_t order[CEDUO_SENSITIVITY_GROUPS];
    ceduo_doubt_order_of(r->answer, f, order);
    for (size_t g = 0; g < r->answer->groups; g++)
        put_input(j, r, f, order[g]);
    ceduo_json_close(j, ']');
    ceduo_json_close(j, '}');
}

void ceduo_doubt_json(struct text *text, const struct ceduo_doubt_report *r)
{
    const struct ceduo_doubt_answer *a = r->answer;
    const struct ceduo_scene *s = &r->file->scene;
    struct json j = {.text = text};
    ceduo_json_open(&j, NULL, '{');
    ceduo_json_string(&j, "format", "ceduo-sensitivity-1");
    ceduo_json_string(&j, "version", CEDUO_VERSION);
    ceduo_json_string(&j, "scene", r->file->path);
    ceduo_json_string(&j, "title", s->title);
    ceduo_json_count(&j, "seed", s->simulation.seed);
    ceduo_json_count(&j, "rocks", r->rocks);
    ceduo_json_count(&j, "points", r->points);
    ceduo_json_open(&j, "figures", '[');
    for (size_t i = 0; a && i < a->figures_count; i++)
        if (a->figures[i].kind < CEDUO_DOUBT_SHOWN)
            put_figure(&j, r, &a->figures[i]);
    ceduo_json_close(&j, ']');
    ceduo_json_open(&j, "ranking", '[');
    for (size_t i = 0; a && i < a->orders_count; i++) {
        ceduo_json_open(&j, NULL, '{');
        ceduo_json_string(&j, "better", s->options[a->orders[i].better].name);
        ceduo_json_string(&j, "than", s->options[a->orders[i].than].name);
        ceduo_json_number(&j, "x_m", last_x(s));
        ceduo_json_number(&j, "probability", a->orders[i].probability);
        ceduo_json_number(&j, "equal", a->orders[i].equal);
        ceduo_json_number(&j, "worse", a->orders[i].worse);
        ceduo_json_close(&j, '}');
    }
    ceduo_json_close(&j, ']');
    ceduo_json_count(&j, "evaluations", a ? a->evaluations : 0);
    ceduo_json_close(&j, '}');
    ceduo_text_char(text, '\n');
}

/* ---- CSV ---- */

void ceduo_doubt_csv_header(struct text *text)
{
    ceduo_text_put(text, "scene,title,seed,rocks,points,option,against,x_m,figure,value,sampling_lo,sampling_hi,doubt_p5,"
                         "doubt_p50,doubt_p95,path,lo,hi,first,first_se,total,total_se,at_lo,at_hi,width_if_known\n");
}

static void put_number(struct text *text, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_char(text, ',');
    if (isfinite(value))
        ceduo_text_put(text, ceduo_number_shortest(value, room));
}

static void put_text(struct text *text, const char *value)
{
    ceduo_text_char(text, ',');
    ceduo_text_csv(text, value ? value : "");
}

static void put_row(struct text *text, const struct ceduo_doubt_report *r, const struct ceduo_doubt_figure *f, size_t g)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_input *input = input_of(r, g);
    double scale = scale_of(f);
    struct text name = {0}, ends[2] = {{0}, {0}};
    ceduo_text_format(&name, "%zu inputs together", r->answer->together);
    ceduo_text_csv(text, r->file->path);
    put_text(text, s->title);
    ceduo_text_format(text, ",%llu,%llu,%zu", (unsigned long long)s->simulation.seed, (unsigned long long)r->rocks, r->points);
    put_text(text, s->options[f->option].name);
    put_text(text, f->difference ? s->options[0].name : NULL);
    put_number(text, last_x(s));
    put_text(text, keys[f->kind]);
    const double of_figure[] = {f->value, f->sampling_lo, f->sampling_hi, f->p5, f->p50, f->p95};
    for (size_t i = 0; i < 6; i++)
        put_number(text, of_figure[i] * scale);
    put_text(text, input ? input->path : ceduo_text_string(&name));
    for (int end = 0; end < 2; end++) {
        ceduo_doubt_input_end(&ends[end], r, g, end);
        put_text(text, ceduo_text_string(&ends[end]));
        ceduo_text_free(&ends[end]);
    }
    const double indices[] = {f->indices.first[g].value, f->indices.first[g].se, f->indices.total[g].value,
                              f->indices.total[g].se};
    for (size_t i = 0; i < 4; i++)
        put_number(text, indices[i]);
    const double at[] = {f->at[g][0], f->at[g][1], f->left[g]};
    for (size_t i = 0; i < 3; i++)
        put_number(text, at[i] * scale);
    ceduo_text_char(text, '\n');
    ceduo_text_free(&name);
}

void ceduo_doubt_csv(struct text *text, const struct ceduo_doubt_report *r)
{
    for (size_t i = 0; r->answer && i < r->answer->figures_count; i++) {
        size_t order[CEDUO_SENSITIVITY_GROUPS];
        ceduo_doubt_order_of(r->answer, &r->answer->figures[i], order);
        for (size_t g = 0; g < r->answer->groups && r->answer->figures[i].kind < CEDUO_DOUBT_SHOWN; g++)
            put_row(text, r, &r->answer->figures[i], order[g]);
    }
}
