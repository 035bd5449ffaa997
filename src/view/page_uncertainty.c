/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Page of --sensitivity: the 90 % range of each option, the inputs that cause it, the ranking, and what to measure first.
 * Its picture shows the range and sampling error of each option, and the shares of inputs as bars. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "plot.h"
#include "report.h"
#include "scene/derived.h"
#include "scene/ranges.h"
#include "scene/value.h"
#include "study/dominant_inputs.h"
#include "value_text.h"

#define SHARE_MIN   0.01 /* min share of a listed input */
#define NO_GAIN_MIN 0.995

bool ceduo_uncertainty_is_off(const struct ceduo_uncertainty_report *r)
{
    return ceduo_node_text(r->file->root, "uncertainty") != NULL;
}

const char *ceduo_uncertainty_missing_reason(const struct ceduo_uncertainty_report *r)
{
    return ceduo_uncertainty_is_off(r) ? _("Uncertainty was not computed: the scene has 'uncertainty: none'")
                                       : _("Nothing in this scene is marked as assumed");
}

/* ---- names of inputs ---- */

#define GROUND_PATH "slope.materials["

void ceduo_uncertainty_input_name(struct text *text, const struct ceduo_uncertainty_report *r, size_t i)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    const char *place = input->places[0], *ground = input->path + sizeof GROUND_PATH - 1;
    struct value v;
    if (input->kind == CEDUO_INPUT_DRAWS) {
        ceduo_text_append(text, _("calibration draws"));
        return;
    }
    if (!ceduo_value_find(&r->file->scene, place, &v)) {
        ceduo_text_append_escaped(text, input->path);
        return;
    }
    /* values of stems are named with their class if there are several: "trees 2: diameter, cm" */
    const struct ceduo_belt *belt = ceduo_input_belt(&r->file->scene, place), *stand = belt;
    const char *label = _(v.field->shown.label), *shoots = strstr(place, ".shoots["), *trees = strstr(place, ".trees[");
    size_t count = !belt ? 0 : shoots ? belt->stand.shoots_count : belt->stand.trees_count;
    if (!shoots && !trees)
        ceduo_text_append(text, label);
    else if (count < 2)
        ceduo_text_format(text, shoots ? _("shoots: %s") : _("trees: %s"), label);
    else
        ceduo_text_format(text, shoots ? _("shoots %lu: %s") : _("trees %lu: %s"),
                          strtoul(strchr(shoots ? shoots : trees, '[') + 1, NULL, 10) + 1, label);
    for (size_t k = 1; stand && k < input->places_count; k++) /* stand shared by all places */
        stand = ceduo_input_belt(&r->file->scene, input->places[k]) == belt ? stand : NULL;
    LOCAL_TEXT(material);
    if (strncmp(input->path, GROUND_PATH, sizeof GROUND_PATH - 1) == 0) {
        ceduo_text_append_n(&material, ground, strcspn(ground, "]"));
        ceduo_text_format(text, ", %s", _(ceduo_text_string(&material)));
    } else if (stand && stand->name && input->kind != CEDUO_INPUT_WORDS) {
        ceduo_text_append(text, ", ");
        ceduo_text_append_escaped(text, stand->name);
    } else if (strncmp(place, "slope.segments[", 15) == 0 && input->places_count > 1) {
        ceduo_text_append_joined(text, ", ", _("%zu stretches"), input->places_count);
    }
}

double ceduo_uncertainty_input_value(const struct ceduo_uncertainty_report *r, size_t i, int end, const char **word)
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

void ceduo_uncertainty_input_end(struct text *text, const struct ceduo_uncertainty_report *r, size_t i, int end)
{
    const char *word;
    double value = ceduo_uncertainty_input_value(r, i, end, &word);
    if (word || !isnan(value))
        ceduo_text_append(text, word ? word : ceduo_number_shortest(value, (char[CEDUO_NUMBER_SIZE]){0}));
}

/* Append a value or a word in the display unit, briefly. */
static void append_display_value(struct text *text, const struct field *field, double value, const char *word)
{
    value *= field->shown.per;
    if (word)
        ceduo_format_value(field, word, text);
    else if (!isnan(value)) /* up to 4 digits; avoids 6.300, which is 6300 in Italian */
        ceduo_text_append(text, fabs(value) < 1e4 ? SIG_TRIMMED(value, 4) : SIG(value, 4));
}

static void append_input_end(struct text *text, const struct ceduo_uncertainty_report *r, size_t i, int end)
{
    const char *word;
    double value = ceduo_uncertainty_input_value(r, i, end, &word);
    struct value v;
    if (ceduo_value_find(&r->file->scene, r->inputs->items[i].places[0], &v))
        append_display_value(text, v.field, value, word);
}

static bool is_outside(const struct ceduo_input *input, double value)
{
    bool word = input->kind == CEDUO_INPUT_WORDS;
    if (input->kind == CEDUO_INPUT_FACTOR ||
        input->kind == CEDUO_INPUT_DRAWS) /* factors are relative to the value; draws have no range */
        return false;
    for (size_t k = 0; word && k < input->words_count; k++)
        if (input->words[k] == (int)value)
            return false;
    return word || value < input->lo || value > input->hi;
}

void ceduo_uncertainty_warn_outside(const struct ceduo_uncertainty_report *r, ceduo_sentence_sink *sink, void *context)
{
    for (size_t i = 0; r && r->answer && i < r->inputs->n; i++) {
        const struct ceduo_input *input = &r->inputs->items[i];
        struct value v;
        size_t k = 0;
        while (k < input->places_count &&
               !(ceduo_value_find(&r->file->scene, input->places[k], &v) && is_outside(input, ceduo_value_get(&v))))
            k++;
        if (k == input->places_count)
            continue;
        LOCAL_TEXT(name);
        LOCAL_TEXT(value_text);
        LOCAL_TEXT(ends);
        LOCAL_TEXT(sentence);
        double value = ceduo_value_get(&v);
        ceduo_uncertainty_input_name(&name, r, i);
        append_display_value(&value_text, v.field, value,
                             input->kind == CEDUO_INPUT_WORDS ? v.field->choices->names[(int)value] : NULL);
        append_input_end(&ends, r, i, 0);
        ceduo_text_append(&ends, "\xe2\x80\x93");
        append_input_end(&ends, r, i, 1);
        ceduo_text_format(&sentence, _("%s is %s, outside its range %s; the range is used."), name.bytes, value_text.bytes,
                          ends.bytes);
        sink(context, sentence.bytes);
    }
}

static const struct range *find_range(const struct ceduo_uncertainty_report *r, const struct ceduo_input *input)
{
    struct value v;
    return ceduo_value_find(&r->file->scene, input->places[0], &v) ? ceduo_range_find(v.field) : NULL;
}

const char *ceduo_uncertainty_measured_by(const struct ceduo_uncertainty_report *r, size_t i)
{
    const struct ceduo_input *input = &r->inputs->items[i];
    const struct range *range = find_range(r, input);
    if (input->kind == CEDUO_INPUT_DRAWS)
        return N_("more observations");
    return range ? range->measured : input->kind == CEDUO_INPUT_WORDS ? NULL : N_("on the ground");
}

/* ---- figures ---- */

const struct ceduo_uncertainty_figure *ceduo_uncertainty_main(const struct ceduo_uncertainty_report *r, size_t option)
{
    return ceduo_uncertainty_find_figure(r->answer, option, r->rotation_mean ? CEDUO_UNCERTAINTY_MEAN : r->answer->main, false);
}

/* Return the factor of the main figure: per 1000 rocks, or kJ. */
static double get_factor(const struct ceduo_uncertainty_report *r)
{
    return ceduo_uncertainty_main(r, 0)->kind == CEDUO_UNCERTAINTY_ENERGY ? J_TO_KJ : 1000;
}

void ceduo_uncertainty_value(struct text *t, enum ceduo_uncertainty_kind kind, double value)
{
    bool energy = kind == CEDUO_UNCERTAINTY_ENERGY;
    ceduo_words_number(t, energy ? value * J_TO_KJ : round(value * 1000), energy ? 3 : 0);
}

/* ---- figures of an option ---- */

/* Return the main figure, per 1000 or in kJ per released rock, with sampling error and 90 % range (NaN: computed for another
 * option only). `*rocks`: number of rocks, over a rotation per year; may be NULL. */
static struct ceduo_measure make_measure(const struct ceduo_uncertainty_report *r, size_t option, uint64_t *rocks)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_main(r, option);
    const struct ceduo_result *finer = r->rotation_mean ? NULL : r->finer;
    const struct ceduo_arrivals *a = finer ? ceduo_result_wooded(finer, option, finer->last_control) : NULL;
    const struct ceduo_choice *c = r->rotation_mean && r->years && option < r->years->n ? &r->years->choices[option] : NULL;
    bool energy = f->kind == CEDUO_UNCERTAINTY_ENERGY;
    double scale = get_factor(r);
    uint64_t own = r->answer->own_rocks;
    own = r->rotation_mean && own > CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS ? CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS : own;
    struct ceduo_measure m = ceduo_measure_share((struct ceduo_mean_share){NAN, NAN});
    if (a && ceduo_rocks_released(a) >= own) {
        own = ceduo_rocks_released(a);
        m = energy ? ceduo_measure_figure(CEDUO_RELEASED_KJ, a)
                   : ceduo_measure_exceeding(&s->controls[ceduo_scene_last_control(s)], a);
    } else if (c && c->last_summary->simulated > 0 && c->rocks > own) {
        own = c->rocks;
        m = ceduo_measure_share(c->mean);
    } else {
        m.value = f->value * scale;
        m.lo = energy ? f->sampling_lo * scale : round(f->sampling_lo * scale);
        m.hi = energy ? f->sampling_hi * scale : round(f->sampling_hi * scale);
    }
    m.digits = energy ? 3 : 0;
    ceduo_measure_range(&m, &f->fit, scale);
    if (rocks)
        *rocks = own;
    return m;
}

void ceduo_uncertainty_points(struct text *text, const struct ceduo_uncertainty_report *r)
{
    size_t n = r->answer->points;
    if (n < CEDUO_UNCERTAINTY_MIN)
        ceduo_text_format(text, ngettext("%zu point is too few for a range.", "%zu points are too few for a range.", n), n);
    else if (n < CEDUO_UNCERTAINTY_POINTS)
        ceduo_text_format(text, ngettext("Uncertainty from %zu point.", "Uncertainty from %zu points.", n), n);
}

/* Append at most n options from `first` on: today, or mean of the years and failing years. `bars`: draw sampling error and
 * 90 % range. */
static void add_options(struct ceduo_page *page, const struct ceduo_uncertainty_report *r, bool bars, size_t first, size_t n)
{
    static const struct ceduo_page_column columns[] = {{NULL, 10, 2, COL_GROW},
                                                       {"", 12, 1, COL_GROW},
                                                       {"", -5, 1, COL_SHRINK},
                                                       {N_("sampling"), -5, 1, COL_SHRINK | COL_PRIORITY(2)},
                                                       {N_("90 % range"), -5, 1, COL_SHRINK},
                                                       {N_("years fail"), -5, 1, COL_SHRINK | COL_PRIORITY(1)}};
    const struct ceduo_scene *scene = &r->file->scene;
    const struct ceduo_measure judged = ceduo_measure_exceeding(&scene->controls[ceduo_scene_last_control(scene)], NULL);
    double end = 0; /* end of the axis */
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_append(&page->last->cells[0].text, get_factor(r) > 1 ? MEASURE_NAME(judged, CEDUO_HEAD) : _("kJ a rock"));
    ceduo_text_append(&page->last->cells[2].text, r->rotation_mean ? _("mean") : _("today"));
    for (size_t i = 0; i < scene->options_count; i++) {
        const struct ceduo_measure m = make_measure(r, i, NULL);
        const struct ceduo_uncertainty_figure *years =
            ceduo_uncertainty_find_figure(r->answer, i, CEDUO_UNCERTAINTY_FAILING, false);
        double lo = floor(years->fit.p5), hi = ceil(years->fit.p95); /* round outwards */
        end = fmax(end, fmax(m.p95, m.hi));
        if (i < first || i - first >= n)
            continue;
        ceduo_page_cell_format(page, "%s", scene->options[i].name);
        struct ceduo_page_bar *bar = ceduo_page_bar(page, bars ? m.hi : NAN, CEDUO_ROLE_TITLE);
        bar->from = fmax(1e-9, m.lo); /* the sampling error is at least one cell wide, also at 0 */
        bar->error_lo = m.p5;
        bar->error_hi = m.p95;
        ceduo_page_cell_format(page, "%s", MEASURE_VALUE(m));
        ceduo_page_cell_format(page, "%s", SPAN(m, m.lo, m.hi));
        ceduo_page_cell_format(page, "%s", SPAN(m, m.p5, m.p95));
        if (!r->rotation_mean || r->answer->main != CEDUO_UNCERTAINTY_EXCEED || isnan(years->value))
            ceduo_page_cell_format(page, "%s", "");
        else
            ceduo_page_cell_format(page, lo == hi || isnan(lo) ? "%.0f" : "%.0f, %.0f\xe2\x80\x93%.0f", years->value, lo, hi);
    }
    end = end > 0 ? ceduo_plot_round(end, true) : 1;
    end = get_factor(r) > 1 ? fmin(1000, end) : end;
    if (bars)
        ceduo_text_format(&page->last->cells[1].text, "0\xe2\x80\x93%s", SIG_TRIMMED(end, 4));
    ceduo_page_scale(page, 1, 0, end);
    ceduo_page_trim(page);
}

/* ---- inputs ---- */

double ceduo_uncertainty_share(const struct ceduo_uncertainty_figure *figure, size_t group)
{
    return fmin(1, fmax(0, figure->fit.total[group].value));
}

/* True if the share of an input is significant and large enough. */
static bool has_effect(const struct ceduo_uncertainty_figure *f, size_t g)
{
    return f->fit.total[g].value > 2 * f->fit.total[g].se && f->fit.total[g].value >= SHARE_MIN;
}

/* Append the width of a figure's range if an input is known, in `format`; "no gain" if it hardly changes. */
static void append_known_width(struct text *text, const struct ceduo_uncertainty_figure *f, size_t input, const char *format)
{
    double known_width = f->fit.width_if_known[input];
    LOCAL_TEXT(width);
    ceduo_uncertainty_value(&width, f->kind, known_width);
    if (known_width > NO_GAIN_MIN * (f->fit.p95 - f->fit.p5))
        ceduo_text_append(text, _("no gain"));
    else
        ceduo_text_append_with(text, format, width.bytes);
}

static void add_inputs(struct ceduo_page *page, const struct ceduo_uncertainty_report *r,
                       const struct ceduo_uncertainty_figure *f)
{
    static const struct ceduo_page_column columns[] = {{N_("it depends on"), 34, 2, 0},
                                                       {N_("from"), -9, 1, 0},
                                                       {N_("to"), -9, 1, 0},
                                                       {N_("share"), -6, 1, 0},
                                                       {N_("width if known"), -14, 2, 0}};
    size_t rest = 0;
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    if (r->file->scene.options_count > 1)
        ceduo_page_para(page, f->fit.enough_points ? CEDUO_PAGE_CAPTION : CEDUO_PAGE_SENTENCE, _("Inputs that decide '%s':"),
                        r->file->scene.options[f->option].name);
    if (f->fit.p5 == f->fit.p95) {
        ceduo_page_note(page, _("Nine of ten plausible cases have the same result. No input decides."));
        return;
    }
    if (!f->fit.enough_points) {
        ceduo_page_note(page, _("Too few points to rank the inputs; use more (--sensitivity=N)."));
        return;
    }
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < f->uses; i++) {
        size_t g = f->order[i];
        if (!has_effect(f, g)) {
            rest++;
            continue;
        }
        ceduo_uncertainty_input_name(ceduo_page_text(page), r, g);
        for (int end = 0; end < 2; end++)
            append_input_end(ceduo_page_text(page), r, g, end);
        ceduo_page_cell_format(page, "%.0f %%", ceduo_uncertainty_share(f, g) * 100);
        append_known_width(ceduo_page_text(page), f, g, "%s");
    }
    if (f->fit.unexplained.value >= SHARE_MIN && f->fit.unexplained.value > 2 * f->fit.unexplained.se) {
        ceduo_page_cell_format(page, "%s", _("not explained by a smooth surface"));
        ceduo_page_cell_format(page, "%s", "");
        ceduo_page_cell_format(page, "%s", "");
        ceduo_page_cell_format(page, "%.0f %%", f->fit.unexplained.value * 100);
        ceduo_page_cell_format(page, "%s", "");
    }
    if (rest == f->uses)
        ceduo_page_note(page, _("No input is dominant; more points may show one (--sensitivity=N)."));
    else if (rest > 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE,
                        ngettext("%zu other input has hardly any effect.", "%zu other inputs have hardly any effect.", rest),
                        rest);
}

size_t ceduo_uncertainty_advised_option(const struct ceduo_uncertainty_report *r)
{
    size_t chosen = SIZE_MAX;
    double min = INFINITY;
    for (size_t i = 0; i < r->file->scene.options_count; i++) {
        const struct ceduo_surface_fit *fit = &ceduo_uncertainty_find_figure(r->answer, i, r->answer->main, false)->fit;
        if (fit->values && (chosen == SIZE_MAX || fit->mean < min))
            chosen = i, min = fit->mean;
    }
    return chosen;
}

/* True if a reader can measure the input, and it matters for the figure. */
static bool is_advised(const struct ceduo_uncertainty_report *r, const struct ceduo_uncertainty_figure *f, size_t g)
{
    const struct range *range = find_range(r, &r->inputs->items[g]);
    return has_effect(f, g) && ceduo_uncertainty_measured_by(r, g) && !(range && range->research);
}

/* True if an advised input ranked before i has the same name. */
static bool is_named_before(const struct ceduo_uncertainty_report *r, const struct ceduo_uncertainty_figure *f, size_t i)
{
    bool named = false;
    LOCAL_TEXT(name);
    ceduo_uncertainty_input_name(&name, r, f->order[i]);
    for (size_t k = 0; k < i && !named; k++) {
        LOCAL_TEXT(earlier);
        ceduo_uncertainty_input_name(&earlier, r, f->order[k]);
        named = is_advised(r, f, f->order[k]) && strcmp(ceduo_text_string(&name), ceduo_text_string(&earlier)) == 0;
    }
    return named;
}

size_t ceduo_uncertainty_advised_input(const struct ceduo_uncertainty_report *r, const struct ceduo_uncertainty_figure *f,
                                       size_t n)
{
    for (size_t i = 0; f->fit.enough_points && i < f->uses; i++)
        if (is_advised(r, f, f->order[i]) && !is_named_before(r, f, i) && n-- == 0)
            return f->order[i];
    return SIZE_MAX;
}

void ceduo_uncertainty_advice(struct text *text, const struct ceduo_uncertainty_report *r,
                              const struct ceduo_uncertainty_figure *f, size_t max)
{
    for (size_t i = 0, g; i < max && (g = ceduo_uncertainty_advised_input(r, f, i)) != SIZE_MAX; i++) {
        LOCAL_TEXT(name);
        ceduo_uncertainty_input_name(&name, r, g);
        ceduo_text_append_joined(text, text->length > 0 ? " " : "", i == 0 ? _("Measure first: %s (%s).") : _("Then: %s (%s)."),
                                 ceduo_text_string(&name), _(ceduo_uncertainty_measured_by(r, g)));
    }
}

bool ceduo_uncertainty_causes(struct text *text, const struct ceduo_uncertainty_report *r, size_t option,
                              enum ceduo_uncertainty_kind light)
{
    size_t inputs[2], n = ceduo_uncertainty_dominant_inputs(&r->file->scene, r->answer, option, light, inputs);
    LOCAL_TEXT(first);
    LOCAL_TEXT(second);
    if (n == 0)
        return false;
    ceduo_uncertainty_input_name(&first, r, inputs[0]);
    if (n == 2)
        ceduo_uncertainty_input_name(&second, r, inputs[1]);
    if (n == 2)
        ceduo_text_format(text, _("%s and %s"), ceduo_text_string(&first), ceduo_text_string(&second));
    else
        ceduo_text_append(text, ceduo_text_string(&first));
    return true;
}

const enum ceduo_uncertainty_kind ceduo_uncertainty_lights[3] = {CEDUO_UNCERTAINTY_CONTACT, CEDUO_UNCERTAINTY_FREE_RUN,
                                                                 CEDUO_UNCERTAINTY_EXCEED};

void ceduo_uncertainty_light_words(struct text *text, const struct ceduo_uncertainty_report *r, size_t option, size_t light)
{
    LOCAL_TEXT(causes);
    if (ceduo_uncertainty_causes(&causes, r, option, ceduo_uncertainty_lights[light]))
        ceduo_text_format(text, _("The test of %s depends on %s."), _(ceduo_light_names[light]), ceduo_text_string(&causes));
}

/* Append a light that changes in plausible cases, with all options that have the same causes, at the first of them. */
static void add_light(struct ceduo_page *page, const struct ceduo_uncertainty_report *r, size_t option, size_t light)
{
    const struct ceduo_scene *s = &r->file->scene;
    LOCAL_TEXT(sentence);
    LOCAL_TEXT(options);
    ceduo_uncertainty_light_words(&sentence, r, option, light);
    for (size_t i = 0; sentence.length > 0 && i < s->options_count; i++) {
        LOCAL_TEXT(compared);
        ceduo_uncertainty_light_words(&compared, r, i, light);
        if (strcmp(ceduo_text_string(&compared), sentence.bytes) != 0)
            continue;
        if (i < option)
            return;
        ceduo_text_append_joined(&options, options.length > 0 ? ", " : "", "'%s'", s->options[i].name);
    }
    if (sentence.length > 0 && s->options_count > 1)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s: %s", options.bytes, sentence.bytes);
    else if (sentence.length > 0)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s", sentence.bytes);
}

/* ---- ranking of options ---- */

#define CLEAR_MIN  0.95
#define LIKELY_MIN 0.8

void ceduo_uncertainty_order_words(struct text *text, const struct ceduo_uncertainty_report *r, size_t i)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_uncertainty_order *o = &r->answer->orders[i];
    ceduo_text_format(text,
                      r->answer->rotation ? _("Over the years '%s' beats '%s' in %.0f %% of plausible cases")
                                          : _("Today '%s' beats '%s' in %.0f %% of plausible cases"),
                      s->options[o->better].name, s->options[o->than].name, o->probability * 100);
    if (o->probability < 0.995)
        ceduo_text_format(text, _(", equal in %.0f %%, worse in %.0f %%"), o->equal * 100, o->worse * 100);
    ceduo_text_format(text, ": %s.", /* options that rarely differ are neither ranked nor undecided */
                      o->probability >= CLEAR_MIN              ? _("clear")
                      : o->probability >= LIKELY_MIN           ? _("likely")
                      : o->equal >= CLEAR_MIN                  ? _("no difference")
                      : o->probability + o->equal >= CLEAR_MIN ? _("hardly ever worse")
                                                               : _("undecided"));
}

/* Append the comparison of each option with the next one, and the range of their difference. */
static void add_orders(struct ceduo_page *page, const struct ceduo_uncertainty_report *r)
{
    enum ceduo_uncertainty_kind kind = r->answer->rotation ? CEDUO_UNCERTAINTY_MEAN : r->answer->main;
    for (size_t i = 0; i < r->answer->orders_count; i++) {
        struct text *text = ceduo_page_add(page, CEDUO_PAGE_ITEM);
        LOCAL_TEXT(lo);
        LOCAL_TEXT(hi);
        ceduo_uncertainty_value(&lo, kind, r->answer->orders[i].p5);
        ceduo_uncertainty_value(&hi, kind, r->answer->orders[i].p95);
        ceduo_uncertainty_order_words(text, r, i);
        if (isnan(r->answer->orders[i].p5))
            continue;
        ceduo_text_append_joined(text, " ",
                                 kind == CEDUO_UNCERTAINTY_ENERGY
                                     ? _("Difference: %s to %s kJ per released rock (90 %% range).")
                                     : _("Difference: %s to %s per 1000 (90 %% range)."),
                                 lo.bytes, hi.bytes);
    }
}

/* ---- all ---- */

void ceduo_uncertainty_blocks(struct ceduo_page *page, const struct ceduo_uncertainty_report *r, bool all)
{
    const struct ceduo_scene *s = &r->file->scene;
    const struct ceduo_control *c = &s->controls[ceduo_scene_last_control(s)];
    const char *place = c->name ? c->name : "";
    if (r->answer->main == CEDUO_UNCERTAINTY_EXCEED)
        ceduo_page_para(page, CEDUO_PAGE_SECTION, _("How sure is it? %s at %g m: rocks of 1000 with more than %g kJ"), place,
                        c->x_given, ceduo_words_accepted(c));
    else
        ceduo_page_para(page, CEDUO_PAGE_SECTION, _("How sure is it? %s at %g m: kJ per released rock"), place, c->x_given);
    add_options(page, r, false, 0, SIZE_MAX);
    ceduo_uncertainty_warn_outside(r, ceduo_page_warn, page);
    size_t chosen = ceduo_uncertainty_advised_option(r);
    const struct ceduo_uncertainty_figure *figure = ceduo_uncertainty_find_figure(r->answer, chosen, r->answer->main, false);
    add_inputs(page, r, figure);
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    LOCAL_TEXT(advice);
    ceduo_uncertainty_advice(&advice, r, figure, 3);
    if (advice.length > 0)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s", advice.bytes);
    for (size_t light = 0; light < 3; light++)
        for (size_t i = 0; i < s->options_count; i++)
            add_light(page, r, i, light);
    if (r->answer->rotation && all) {
        ceduo_page_add(page, CEDUO_PAGE_GAP);
        struct ceduo_uncertainty_report rotation = *r;
        rotation.rotation_mean = true;
        add_options(page, &rotation, false, 0, SIZE_MAX);
        add_inputs(page, r, ceduo_uncertainty_find_figure(r->answer, chosen, CEDUO_UNCERTAINTY_MEAN, false));
        ceduo_page_add(page, CEDUO_PAGE_GAP);
    }
    if (all)
        add_orders(page, r);
    uint64_t rocks;
    make_measure(r, 0, &rocks);
    ceduo_page_para(page, CEDUO_PAGE_NOTE,
                    ngettext("Sampling error: %lu rock; more rocks reduce it. 90 %% range: uncertain inputs; only measurements "
                             "reduce it. Scenes computed: %llu.",
                             "Sampling error: %lu rocks; more rocks reduce it. 90 %% range: uncertain inputs; only "
                             "measurements reduce it. Scenes computed: %llu.",
                             (unsigned long)rocks),
                    (unsigned long)rocks, (unsigned long long)r->answer->evaluations);
    LOCAL_TEXT(points);
    ceduo_uncertainty_points(&points, r);
    if (points.length > 0)
        ceduo_text_append_joined(&page->last->text, " ", "%s", points.bytes);
}

void ceduo_uncertainty_page(struct text *text, const struct ceduo_uncertainty_report *r, bool plain)
{
    LOCAL_PAGE(page, CEDUO_PAGE_WIDTH);
    ceduo_text_append_escaped(ceduo_page_add(&page, CEDUO_PAGE_TITLE),
                              ceduo_in_language(r->file->scene.title, r->file->scene.title_it));
    if (r->answer)
        ceduo_uncertainty_blocks(&page, r, true);
    else
        ceduo_page_note(&page, ceduo_uncertainty_missing_reason(r));
    ceduo_page_print(text, &page, plain);
}

/* ---- picture ---- */

#define BAR_SHARE_MIN 0.005 /* min share of an input with a bar */
#define INPUTS_MIN    2     /* lines: head and one input */

/* Append the options; return the number of lines. */
static int add_option_bars(struct ceduo_page *page, const struct ceduo_uncertainty_report *r, size_t option, int height)
{
    size_t n = r->file->scene.options_count, lines = height > 4 ? (size_t)height - 1 : 3;
    size_t max = lines * 2 / 3, rows = n + INPUTS_MIN <= lines ? n : max > 1 ? max - 1 : 1;
    add_options(page, r, true, option >= rows ? option - rows + 1 : 0, rows);
    if (n > rows)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, ngettext("%zu more option: ] goes on", "%zu more options: ] goes on", n - rows),
                        n - rows);
    return 1 + (int)(n > rows ? rows + 1 : n);
}

static void add_input_bars(struct ceduo_page *page, const struct ceduo_uncertainty_report *r, size_t option, int lines)
{
    static const struct ceduo_page_column columns[] = {
        {N_("it depends on"), 18, 0, COL_GROW}, {"", 6, 1, COL_GROW}, {"", -5, 1, COL_SHRINK}, {"", -8, 2, COL_SHRINK}};
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_main(r, option);
    if (lines < 2)
        return;
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_format(&page->last->cells[3].text, _("width %.3g"), (f->fit.p95 - f->fit.p5) * get_factor(r));
    for (size_t i = 0, n = 1; f->fit.enough_points && i < f->uses && n < (size_t)lines; i++)
        if (f->fit.total[f->order[i]].value >= BAR_SHARE_MIN) {
            double share = ceduo_uncertainty_share(f, f->order[i]);
            ceduo_uncertainty_input_name(ceduo_page_text(page), r, f->order[i]);
            ceduo_page_bar(page, share, CEDUO_ROLE_MEAN);
            ceduo_page_cell_format(page, "%.0f %%", share * 100);
            append_known_width(ceduo_page_text(page), f, f->order[i], _("%s if known"));
            n++;
        }
}

const char *ceduo_plot_uncertainty(struct ceduo_drawing *d)
{
    const struct ceduo_uncertainty_report *r = d->picture->uncertainty;
    if (!r)
        return _("not computed yet");
    if (!r->answer)
        return ceduo_uncertainty_missing_reason(r);
    int used = add_option_bars(d->page, r, d->picture->option, d->height);
    add_input_bars(d->page, r, d->picture->option, d->height - used);
    return NULL;
}
