/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What people and files call the inputs of a scene that are in doubt. */
#include "report_doubt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "scene/ranges.h"
#include "scene/value.h"
#include "words.h"

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

void ceduo_doubt_input_name(struct text *text, const struct ceduo_doubt_report *r, size_t i)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    struct value v;
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

double ceduo_doubt_input_value(const struct ceduo_doubt_report *r, size_t i, int end, const char **word)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    struct value v;
    *word = NULL;
    if (!ceduo_value_find(&r->file->scene, input->places[0], &v))
        return NAN;
    if (input->kind == CEDUO_INPUT_WORDS)
        *word = v.field->choices->names[input->words[end == 0 ? 0 : input->words_count - 1]];
    double value = end == 0 ? input->lo : input->hi;
    return *word ? NAN : input->kind == CEDUO_INPUT_FACTOR ? value * ceduo_value_get(&v) : value;
}

void ceduo_doubt_input_end(struct text *text, const struct ceduo_doubt_report *r, size_t i, int end)
{
    const char *word;
    double value = ceduo_doubt_input_value(r, i, end, &word);
    if (word || !isnan(value))
        ceduo_text_put(text, word ? word : SHORTEST(value));
}

void ceduo_doubt_input_shown(struct text *text, const struct ceduo_doubt_report *r, size_t i, int end)
{
    const char *word;
    double value = ceduo_doubt_input_value(r, i, end, &word);
    struct value v;
    if (word)
        ceduo_text_put(text, word);
    else if (!isnan(value) && ceduo_value_find(&r->file->scene, r->inputs->items[i].places[0], &v))
        ceduo_text_put(text, SHORTEST(strtod(WRITTEN(value * v.field->shown.per, 4), NULL))); /* 6.300 is 6300 in Italian */
}

const char *ceduo_doubt_measured(const struct ceduo_doubt_report *r, size_t i)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    struct value v;
    if (input->kind == CEDUO_INPUT_WORDS)
        return NULL;
    if (input->kind == CEDUO_INPUT_DRAWS)
        return N_("more of what was seen");
    const struct range *range = ceduo_value_find(&r->file->scene, input->places[0], &v) ? ceduo_range_of(v.field) : NULL;
    return range ? range->measured : N_("on the ground");
}
