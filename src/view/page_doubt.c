/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of --sensitivity: how far each option may be off, what that depends on, whether the order of the options
 * holds, and what to measure first. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "report_doubt.h"
#include "scene/ranges.h"
#include "scene/value.h"
#include "typed.h"

#define FIRST 3    /* inputs that are named as what to measure first */
#define SHOWN 0.01 /* shares from this on are shown */

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

/* ---- what people and files call the inputs ---- */

#define GROUND "slope.materials["

void ceduo_doubt_input_name(struct text *text, const struct ceduo_doubt_report *r, size_t i)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    const char *place = input->places[0], *ground = input->path + sizeof GROUND - 1;
    struct value v;
    if (input->kind == CEDUO_INPUT_DRAWS) {
        ceduo_text_put(text, _("left open by calibration"));
        return;
    }
    if (!ceduo_value_find(&r->file->scene, place, &v)) {
        ceduo_text_safe(text, input->path);
        return;
    }
    /* a value of stems with whose it is, for several may have one: "trees 2: diameter, cm" */
    const struct ceduo_belt *belt = ceduo_input_belt(&r->file->scene, place), *stand = belt;
    const char *label = _(v.field->shown.label), *shoots = strstr(place, ".shoots["), *trees = strstr(place, ".trees[");
    size_t count = !belt ? 0 : shoots ? belt->stand.shoots_count : belt->stand.trees_count;
    if (!shoots && !trees)
        ceduo_text_put(text, label);
    else if (count < 2)
        ceduo_text_format(text, shoots ? _("shoots: %s") : _("trees: %s"), label);
    else
        ceduo_text_format(text, shoots ? _("shoots %lu: %s") : _("trees %lu: %s"),
                          strtoul(strchr(shoots ? shoots : trees, '[') + 1, NULL, 10) + 1, label);
    for (size_t k = 1; stand && k < input->places_count; k++) /* of the stand that all places are in */
        stand = ceduo_input_belt(&r->file->scene, input->places[k]) == belt ? stand : NULL;
    if (strncmp(input->path, GROUND, sizeof GROUND - 1) == 0)
        ceduo_text_format(text, ", %.*s", (int)strcspn(ground, "]"), ground);
    else if (stand && stand->name && input->kind != CEDUO_INPUT_WORDS) {
        ceduo_text_put(text, ", ");
        ceduo_text_safe(text, stand->name);
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
        ceduo_text_put(text, word ? word : ceduo_number_shortest(value, (char[CEDUO_NUMBER_ROOM]){0}));
}

/* An end of its range in the unit that people use, and short. */
static void append_input_end(struct text *text, const struct ceduo_doubt_report *r, size_t i, int end)
{
    const char *word;
    double value = ceduo_doubt_input_value(r, i, end, &word);
    struct value v;
    if (!ceduo_value_find(&r->file->scene, r->inputs->items[i].places[0], &v))
        return;
    value *= v.field->shown.per;
    if (word)
        ceduo_shown_value(v.field, word, text);
    else if (!isnan(value)) /* 6.300 is 6300 in Italian */
        ceduo_text_put(text, fabs(value) < 1e4 ? ROUNDED(value, 4) : WRITTEN(value, 4));
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

/* ---- figures ---- */

const struct ceduo_doubt_figure *ceduo_doubt_main(const struct ceduo_doubt_report *r, size_t option)
{
    return ceduo_doubt_figure_of(r->answer, option, r->over ? CEDUO_DOUBT_MEAN : r->answer->main, false);
}

bool ceduo_doubt_knows(const struct ceduo_doubt_report *r, size_t option)
{
    return !isnan(ceduo_doubt_main(r, option)->fit.p5);
}

double ceduo_doubt_scale(const struct ceduo_doubt_report *r)
{
    return ceduo_doubt_main(r, 0)->kind == CEDUO_DOUBT_ENERGY ? J_TO_KJ : 1000;
}

/* A value of a kind of figure: shares of 1000, energies in kJ. */
void ceduo_doubt_value(struct text *t, enum ceduo_doubt_kind kind, double value)
{
    bool energy = kind == CEDUO_DOUBT_ENERGY;
    ceduo_words_number(t, energy ? value * J_TO_KJ : round(value * 1000), energy ? 3 : 0);
}

static void append_range(struct text *t, enum ceduo_doubt_kind kind, double lo, double hi)
{
    ceduo_doubt_value(t, kind, lo);
    ceduo_text_put(t, "\xe2\x80\x93");
    ceduo_doubt_value(t, kind, hi);
}

/* ---- what an option may be ---- */

/* A share, its ends outwards, as in the other views. */
static struct ceduo_doubt_now share_now(double value, double lo, double hi, uint64_t rocks)
{
    return (struct ceduo_doubt_now){value, floor(fmax(0, lo) * 1000) / 1000, ceil(fmin(1, hi) * 1000) / 1000, rocks};
}

struct ceduo_doubt_now ceduo_doubt_now_of(const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    if (r->over) {
        const struct ceduo_choice *c = r->years && option < r->years->n ? &r->years->choices[option] : NULL;
        uint64_t own = r->answer->own_rocks < CEDUO_DOUBT_OWN_YEAR_ROCKS ? r->answer->own_rocks : CEDUO_DOUBT_OWN_YEAR_ROCKS;
        if (!c || c->flown == 0 || c->rocks <= own)
            return (struct ceduo_doubt_now){f->value, f->sampling_lo, f->sampling_hi, own};
        return share_now(c->mean.mean, c->mean.mean - c->mean.half, c->mean.mean + c->mean.half, c->rocks);
    }
    const struct ceduo_result *finer = r->finer;
    const struct ceduo_arrivals *a = finer ? ceduo_result_wooded(finer, option, finer->last_control) : NULL;
    if (!a || a->released <= r->answer->own_rocks)
        return (struct ceduo_doubt_now){f->value, f->sampling_lo, f->sampling_hi, r->answer->own_rocks};
    if (r->answer->main == CEDUO_DOUBT_EXCEED)
        return share_now(a->exceed_probability, a->exceed_lo, a->exceed_hi, a->released);
    double mean = a->energy_per_released, half = ceduo_half_width(a->energy_per_released_se, a->released);
    return (struct ceduo_doubt_now){mean, mean - half, mean + half, a->released};
}

void ceduo_doubt_range(struct text *text, const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    double now = ceduo_doubt_now_of(r, option).value;
    ceduo_doubt_value(text, f->kind, now);
    if (!ceduo_doubt_knows(r, option))
        return;
    ceduo_text_put(text, " (");
    append_range(text, f->kind, fmin(now, f->fit.p5), fmax(now, f->fit.p95)); /* a doubt less than the rocks' error holds it */
    ceduo_text_char(text, ')');
}

/* What a reader takes along: both errors. */
void ceduo_doubt_both(struct text *text, const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    struct ceduo_doubt_now now = ceduo_doubt_now_of(r, option);
    LOCAL_TEXT(value);
    LOCAL_TEXT(rocks);
    LOCAL_TEXT(doubt);
    ceduo_doubt_value(&value, f->kind, now.value);
    append_range(&rocks, f->kind, now.lo, now.hi);
    append_range(&doubt, f->kind, f->fit.p5, f->fit.p95);
    ceduo_text_format(text,
                      r->over                                 ? _("Over the rotation %s of 1000 (rocks %s; doubt %s)")
                      : r->answer->main == CEDUO_DOUBT_EXCEED ? _("%s of 1000 (rocks %s; doubt %s)")
                                                              : _("%s kJ per released rock (rocks %s; doubt %s)"),
                      value.bytes, rocks.bytes, doubt.bytes);
}

static void add_options(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("option"), 32, 2, 0}, {N_("now"), -7, 0, 0}, {N_("rocks"), -13, 2, 0}, {N_("doubt (90 %)"), -15, 2, 0}};
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_control *c = &s->controls[ceduo_scene_last_control(s)];
    LOCAL_TEXT(name);
    ceduo_text_safe(&name, c->name ? c->name : "");
    if (r->answer->main == CEDUO_DOUBT_EXCEED)
        ceduo_page_say(page, CEDUO_PAGE_SECTION, _("How sure is it? %s at %g m, of 1000 rocks those with more than %g kJ"),
                       ceduo_text_string(&name), c->x_given, ceduo_words_accepted(c));
    else
        ceduo_page_say(page, CEDUO_PAGE_SECTION, _("How sure is it? %s at %g m, kJ per released rock"),
                       ceduo_text_string(&name), c->x_given);
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < s->options_count; i++) {
        const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, i);
        struct ceduo_doubt_now now = ceduo_doubt_now_of(r, i);
        ceduo_text_safe(ceduo_page_text(page), s->options[i].name);
        ceduo_doubt_value(ceduo_page_text(page), f->kind, now.value);
        append_range(ceduo_page_text(page), f->kind, now.lo, now.hi);
        append_range(ceduo_page_text(page), f->kind, f->fit.p5, f->fit.p95);
    }
}

/* In the mean of a rotation, and the years that fail. */
static void add_rotation(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    static const struct ceduo_page_column columns[] = {{N_("over the rotation, of 1000"), 32, 2, 0},
                                                       {N_("mean"), -5, 0, 0},
                                                       {N_("rocks"), -9, 2, 0},
                                                       {N_("doubt (90 %)"), -13, 2, 0},
                                                       {N_("years fail"), -11, 2, 0}};
    const struct ceduo_scene *s = &r->file->scene;
    bool judged = r->answer->main == CEDUO_DOUBT_EXCEED;
    struct ceduo_doubt_report over = *r;
    over.over = true;
    ceduo_page_table(page, columns, judged ? 5 : 4);
    for (size_t i = 0; i < s->options_count; i++) {
        const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(r->answer, i, CEDUO_DOUBT_MEAN, false),
                                        *years = ceduo_doubt_figure_of(r->answer, i, CEDUO_DOUBT_FAILING, false);
        struct ceduo_doubt_now now = ceduo_doubt_now_of(&over, i);
        ceduo_text_safe(ceduo_page_text(page), s->options[i].name);
        ceduo_doubt_value(ceduo_page_text(page), f->kind, now.value);
        append_range(ceduo_page_text(page), f->kind, now.lo, now.hi);
        append_range(ceduo_page_text(page), f->kind, f->fit.p5, f->fit.p95);
        double lo = judged ? floor(years->fit.p5) : 0, hi = judged ? ceil(years->fit.p95) : 0; /* outwards */
        if (judged && lo == hi)
            ceduo_page_write(page, "%.0f", years->value);
        else if (judged)
            ceduo_page_write(page, "%.0f, %.0f\xe2\x80\x93%.0f", years->value, lo, hi);
    }
}

/* ---- what it depends on ---- */

double ceduo_doubt_share(const struct ceduo_doubt_figure *figure, size_t group)
{
    return fmin(1, fmax(0, figure->fit.total[group].value));
}

/* An input matters where its share is more than its error. */
static bool matters(const struct ceduo_doubt_figure *f, size_t g)
{
    return f->fit.total[g].value > 2 * f->fit.total[g].se && f->fit.total[g].value >= SHOWN;
}

static void add_inputs(struct ceduo_page *page, const struct ceduo_doubt_report *r, const struct ceduo_doubt_figure *f)
{
    static const struct ceduo_page_column columns[] = {{N_("it depends on"), 34, 2, 0},
                                                       {N_("from"), -9, 1, 0},
                                                       {N_("to"), -9, 1, 0},
                                                       {N_("share"), -6, 1, 0},
                                                       {N_("width if known"), -14, 2, 0}};
    size_t rest = 0;
    if (!f->fit.enough) {
        ceduo_page_note(page, _("There are too few points to say what it depends on; take more (--sensitivity=N)."));
        return;
    }
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < f->uses; i++) {
        size_t g = f->order[i];
        if (!matters(f, g)) {
            rest++;
            continue;
        }
        ceduo_doubt_input_name(ceduo_page_text(page), r, g);
        for (int end = 0; end < 2; end++)
            append_input_end(ceduo_page_text(page), r, g, end);
        ceduo_page_write(page, "%.0f %%", ceduo_doubt_share(f, g) * 100);
        ceduo_doubt_value(ceduo_page_text(page), f->kind, f->fit.left[g]);
    }
    if (f->fit.whole.value >= SHOWN && f->fit.whole.value > 2 * f->fit.whole.se) {
        ceduo_page_write(page, "%s", _("together, in ways not told apart"));
        ceduo_page_write(page, "%s", "");
        ceduo_page_write(page, "%s", "");
        ceduo_page_write(page, "%.0f %%", f->fit.whole.value * 100);
        ceduo_page_write(page, "%s", "");
    }
    if (rest == f->uses)
        ceduo_page_note(page, _("No input stands out; more points (--sensitivity=N) may tell."));
    else if (rest > 0)
        ceduo_page_say(page, CEDUO_PAGE_NOTE,
                       ngettext("%zu other input has hardly any effect.", "%zu other inputs have hardly any effect.", rest),
                       rest);
}

/* The name of an input and what would measure it: that of an energy law is known, though no value of it is. */
static const char *name_measured(struct text *name, const struct ceduo_doubt_report *r, size_t g)
{
    if (r->inputs->items[g].kind == CEDUO_INPUT_WORDS) {
        ceduo_text_put(name, _("what stems take from a rock"));
        return N_("pulling tests on such stems");
    }
    ceduo_doubt_input_name(name, r, g);
    return ceduo_doubt_measured(r, g);
}

bool ceduo_doubt_advice(struct text *text, const struct ceduo_doubt_report *r, size_t option, size_t nth)
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    double scale = ceduo_doubt_scale(r);
    size_t named = 0;
    for (size_t i = 0; f->fit.enough && i < f->uses; i++) {
        size_t g = f->order[i];
        LOCAL_TEXT(name);
        const char *how = name_measured(&name, r, g);
        if (!matters(f, g) || !how || named++ < nth)
            continue;
        ceduo_text_format(text,
                          nth == 0 ? _("Measure first: %s (%s); of a doubt %.3g wide it would leave %.3g.")
                                   : _("then: %s (%s); of a doubt %.3g wide it would leave %.3g."),
                          ceduo_text_string(&name), _(how), (f->fit.p95 - f->fit.p5) * scale, f->fit.left[g] * scale);
        return true;
    }
    return false;
}

bool ceduo_doubt_heaviest(struct text *name, const char **how, const struct ceduo_doubt_report *r, size_t option)
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_main(r, option);
    for (size_t i = 0; f->fit.enough && i < f->uses; i++) {
        if (!matters(f, f->order[i]))
            continue;
        *how = name_measured(name, r, f->order[i]);
        return true;
    }
    return false;
}

/* "dbh, ADS 1 and per hectare, ADS 1" */
bool ceduo_doubt_causes(struct text *text, const struct ceduo_doubt_report *r, size_t option, enum ceduo_doubt_kind light)
{
    size_t inputs[2], n = ceduo_doubt_depends(&r->file->scene, r->answer, option, light, inputs);
    LOCAL_TEXT(first);
    LOCAL_TEXT(second);
    if (n == 0)
        return false;
    ceduo_doubt_input_name(&first, r, inputs[0]);
    if (n == 2)
        ceduo_doubt_input_name(&second, r, inputs[1]);
    if (n == 2)
        ceduo_text_format(text, _("%s and %s"), ceduo_text_string(&first), ceduo_text_string(&second));
    else
        ceduo_text_put(text, ceduo_text_string(&first));
    return true;
}

const enum ceduo_doubt_kind ceduo_doubt_lights[3] = {CEDUO_DOUBT_CONTACT, CEDUO_DOUBT_FREE_RUN, CEDUO_DOUBT_EXCEED};

void ceduo_doubt_light_words(struct text *text, const struct ceduo_doubt_report *r, size_t option, size_t light)
{
    LOCAL_TEXT(causes);
    if (ceduo_doubt_causes(&causes, r, option, ceduo_doubt_lights[light]))
        ceduo_text_format(text, _("Whether the test of %s passes depends on %s."), _(ceduo_light_names[light]),
                          ceduo_text_string(&causes));
}

/* ---- the order of the options ---- */

#define SURE   0.95
#define LIKELY 0.8

void ceduo_doubt_order_words(struct text *text, const struct ceduo_doubt_report *r, size_t i)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_doubt_ranking *ranking = ceduo_doubt_verdict(r->answer);
    const struct ceduo_doubt_order *o = &ranking->orders[i];
    LOCAL_TEXT(better);
    LOCAL_TEXT(than);
    ceduo_text_safe(&better, s->options[o->better].name);
    ceduo_text_safe(&than, s->options[o->than].name);
    ceduo_text_format(text,
                      ranking->rotation ? _("Over the rotation %s is better than %s in %.0f %% of what may be true")
                                        : _("Today %s is better than %s in %.0f %% of what may be true"),
                      ceduo_text_string(&better), ceduo_text_string(&than), o->probability * 100);
    if (o->probability < 0.995)
        ceduo_text_format(text, _(", equal in %.0f %%, worse in %.0f %%"), o->equal * 100, o->worse * 100);
    ceduo_text_format(text, ": %s.", /* of two that differ in few cases the order is not sure, but neither is it open */
                      o->probability >= SURE              ? _("clear")
                      : o->probability >= LIKELY          ? _("likely")
                      : o->equal >= SURE                  ? _("no difference")
                      : o->probability + o->equal >= SURE ? _("hardly ever worse")
                                                          : _("undecided"));
}

/* Each option and the next one, and how far apart they may lie. */
static void add_orders(struct ceduo_page *page, const struct ceduo_doubt_report *r)
{
    const struct ceduo_doubt_ranking *ranking = ceduo_doubt_verdict(r->answer);
    enum ceduo_doubt_kind kind = ranking->rotation ? CEDUO_DOUBT_MEAN : r->answer->main;
    for (size_t i = 0; i < ranking->count; i++) {
        struct text *text = ceduo_page_add(page, CEDUO_PAGE_ITEM);
        LOCAL_TEXT(lo);
        LOCAL_TEXT(hi);
        ceduo_doubt_value(&lo, kind, ranking->orders[i].p5);
        ceduo_doubt_value(&hi, kind, ranking->orders[i].p95);
        ceduo_doubt_order_words(text, r, i);
        ceduo_text_then(text, " ",
                        kind == CEDUO_DOUBT_ENERGY ? _("The difference may be %s to %s kJ per released rock.")
                                                   : _("The difference may be %s to %s of 1000."),
                        lo.bytes, hi.bytes);
    }
}

/* ---- all ---- */

void ceduo_doubt_blocks(struct ceduo_page *page, const struct ceduo_doubt_report *r, enum ceduo_doubt_extent extent)
{
    bool several = r->file->scene.options_count > 1;
    add_options(page, r);
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    if (several)
        ceduo_page_say(page, CEDUO_PAGE_SENTENCE, _("What the first option depends on:"));
    add_inputs(page, r, ceduo_doubt_main(r, 0));
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    for (size_t i = 0; i < FIRST; i++) {
        LOCAL_TEXT(words);
        if (ceduo_doubt_advice(&words, r, 0, i))
            ceduo_page_say(page, CEDUO_PAGE_ITEM, "%s", words.bytes);
    }
    for (size_t i = 0; i < 3 * r->file->scene.options_count; i++) { /* lights that change within what may be true */
        LOCAL_TEXT(words);
        LOCAL_TEXT(name);
        ceduo_doubt_light_words(&words, r, i / 3, i % 3);
        ceduo_text_safe(&name, r->file->scene.options[i / 3].name);
        if (words.length > 0)
            ceduo_page_say(page, CEDUO_PAGE_ITEM, "%s%s%s", several ? ceduo_text_string(&name) : "", several ? ": " : "",
                           words.bytes);
    }
    if (r->answer->rotation && extent >= CEDUO_DOUBT_ORDER) {
        ceduo_page_add(page, CEDUO_PAGE_GAP);
        add_rotation(page, r);
        ceduo_page_add(page, CEDUO_PAGE_GAP);
        if (several)
            ceduo_page_say(page, CEDUO_PAGE_SENTENCE, _("What the mean of the first option depends on:"));
        add_inputs(page, r, ceduo_doubt_figure_of(r->answer, 0, CEDUO_DOUBT_MEAN, false));
        ceduo_page_add(page, CEDUO_PAGE_GAP);
    }
    if (extent >= CEDUO_DOUBT_ORDER)
        add_orders(page, r);
    if (!several) /* of several the table has it */
        ceduo_doubt_both(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, 0);
    ceduo_page_say(page, CEDUO_PAGE_NOTE,
                   _("'rocks' is the error of %llu rocks; more rocks reduce it. 'doubt' is what is not known; only measuring "
                     "reduces it. %llu scenes were computed."),
                   (unsigned long long)ceduo_doubt_now_of(r, 0).rocks, (unsigned long long)r->answer->evaluations);
}

void ceduo_doubt_page(struct text *text, const struct ceduo_doubt_report *r, bool plain)
{
    struct ceduo_page page = {.width = CEDUO_PAGE_WIDTH};
    ceduo_text_safe(ceduo_page_add(&page, CEDUO_PAGE_TITLE), ceduo_in_language(r->file->scene.title, r->file->scene.title_it));
    if (r->answer)
        ceduo_doubt_blocks(&page, r, CEDUO_DOUBT_ALL);
    else
        ceduo_page_note(&page, ceduo_doubt_none(r));
    ceduo_page_print(text, &page, plain);
    ceduo_page_free(&page);
}
