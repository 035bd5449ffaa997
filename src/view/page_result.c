/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Page of a result: input, each option at each control, all options together; then warnings of the run, and each assumption
 * with its first place. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "core/runs/assess.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/stand/adc.h"
#include "page_parts.h"
#include "plot.h"
#include "scene/choices.h"
#include "scene/rock.h"
#include "value_text.h"

/* ---- head ---- */

/* Display names of words in files. */
static const char *const shapes[] = {[CEDUO_SHAPE_SPHERE] = N_("sphere"),
                                     [CEDUO_SHAPE_CYLINDER] = N_("cylinder"),
                                     [CEDUO_SHAPE_ELLIPSOID] = N_("ellipsoid"),
                                     [CEDUO_SHAPE_BLOCK] = N_("block")};
static const char *const facets[] = {[CEDUO_FACETS_AGAINST] = N_("against"), [CEDUO_FACETS_BOTH] = N_("both")};

static const char *assumed_mark(const struct ceduo_report *report, const char *path)
{
    return ceduo_notes_print(report->file->notes, "assumed", path) ? "*" : "";
}

void ceduo_page_facts(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_scene *s = r->scene;
    const struct ceduo_slope *slope = &s->slope;
    struct text *line = ceduo_page_item(page, CEDUO_PAGE_FACT, _("Rock"));
    ceduo_text_format(line,
                      s->blocks_count > 0           ? _("%s; sizes as in Blocks; index for a rock of %s kg, mean diameter %s m")
                      : ceduo_rock_varies(&s->rock) ? _("%s, %s kg, mean diameter %s m (means; sizes vary)")
                                                    : _("%s, %s kg, mean diameter %s m"),
                      _(shapes[s->rock.shape]), SIG(r->rock.mass, 4), SIG(r->rock.mean_diameter, 3));
    ceduo_text_append(line, assumed_mark(report, "rock"));
    for (size_t i = 0; i < s->blocks_count; i++)
        ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Blocks")), _("%g a year of %g to %g m3, exponent %g"),
                          s->blocks[i].per_year, s->blocks[i].volumes[0], s->blocks[i].volumes[1], s->blocks[i].exponent);
    double low = 0, high = 0;
    for (size_t i = 0; i < slope->vertices; i++) {
        low = fmin(low, slope->z[i]);
        high = fmax(high, slope->z[i]);
    }
    line = ceduo_page_item(page, CEDUO_PAGE_FACT, _("Slope"));
    ceduo_text_format(line, _("%s m long, %s m high, "), SIG(slope->x[slope->vertices - 1], 4), SIG(high - low, 4));
    ceduo_words_points(line, slope);
    ceduo_text_format(line, _("; law %s, facets %s%s"), ceduo_words_law(ceduo_law_words.names[s->simulation.law]),
                      _(facets[slope->facets]), assumed_mark(report, "slope"));
    if (!s->simulation.friction_bound && s->simulation.law != CEDUO_LAW_ARM)
        ceduo_text_append(line, _("; published law, without the friction bound"));
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Rocks")), _("%llu, seed %llu"),
                      (unsigned long long)ceduo_result_rocks(r), (unsigned long long)s->simulation.seed);
}

/* ---- arrivals at a control ---- */

static void add_place(struct ceduo_page *page, const struct ceduo_report *report, size_t i)
{
    const struct ceduo_control *c = &report->result->scene->controls[i];
    struct text *place = ceduo_page_add(page, CEDUO_PAGE_PLACE);
    LOCAL_TEXT(where);
    ceduo_text_format(place, _("At %s m"), LOCALIZED(c->x_given));
    if (c->name)
        ceduo_text_format(place, ", %s", c->name);
    ceduo_text_format(&where, "controls[%zu].accepted_kJ", i);
    if (!isnan(c->accepted))
        ceduo_text_append_joined(place, ", ", _("limit %s kJ%s"), LOCALIZED(ceduo_words_accepted(c)),
                                 ceduo_scene_assumes_value(report->file, where.bytes) ? "*" : "");
    ceduo_words_topography(place, ceduo_topography_find(&report->result->bare.arrivals[i]), false);
}

/* Append a row: name, with forest, without forest. Each has a short form for narrow columns. */
static void add_texts_row(struct ceduo_page *page, const char *const texts[3][2])
{
    for (int i = 0; i < 3; i++) {
        struct ceduo_page_cell *cell = ceduo_page_cell(page);
        ceduo_text_append(&cell->text, texts[i][i == 0 && page->width < CEDUO_PAGE_WIDTH]); /* panes use short names only */
        ceduo_text_append(&cell->shorter, texts[i][1]);
    }
}

static void add_figure(struct ceduo_page *page, struct ceduo_measure wooded, struct ceduo_measure bare)
{
    bool pane = page->width < CEDUO_PAGE_WIDTH;
    add_texts_row(page, (const char *const[3][2]){
                            {MEASURE_NAME(bare, CEDUO_PHRASE), MEASURE_NAME(bare, CEDUO_ROW)},
                            {INTERVAL(wooded), pane && wooded.digits > 0 ? MEASURE_VALUE(wooded) : WITH_ERROR(wooded, "")},
                            {INTERVAL(bare), pane ? MEASURE_VALUE(bare) : WITH_ERROR(bare, "")}});
}

#define PANE_WIDE 34 /* columns needed for an interval */

void ceduo_page_arrivals(struct ceduo_page *page, const struct ceduo_subject *s, int lines, bool with_bare)
{
    enum { LOW = 15, MIN = 18, ALL = 24, FULL = CEDUO_LINES_ALL };
    static const int min_lines[CEDUO_MEASURE_KINDS] = {LOW, MIN, MIN, LOW, LOW, LOW, FULL, ALL, FULL, FULL};
    const struct ceduo_arrivals *wooded = s->index ? s->wooded : NULL, *bare = with_bare ? s->bare : NULL;
    bool full = lines >= FULL, nothing = !full && ceduo_too_few_arrivals(s->bare), blocks = ceduo_hazard_find(s->bare);
    int width = page->width >= CEDUO_PAGE_WIDTH ? 18 : page->width >= PANE_WIDE ? 14 : 7;
    const struct ceduo_page_column columns[] = {
        {N_("of 1000"), 13, 2, COL_GROW}, {"", -width, 0, 0}, {"", width == 14 ? -8 : -width, 0, 0}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *heads = page->last->cells;
    ceduo_text_append(&heads[1].text, _("with forest"));
    ceduo_text_format(&heads[1].shorter, "%s ", _("forest")); /* gap to the next head */
    ceduo_text_append(&heads[2].text, _("without forest"));
    ceduo_text_append(&heads[2].shorter, _("without"));
    add_figure(page, ceduo_measure_arriving(wooded), ceduo_measure_arriving(bare));
    if (!isnan(s->place->accepted) && !nothing)
        add_figure(page, ceduo_measure_exceeding(s->place, wooded), ceduo_measure_exceeding(s->place, bare));
    if (!full && !nothing && wooded && !isnan(s->today.p5) && page->width < CEDUO_PAGE_WIDTH) {
        const char *range = PLAUSIBLE_RANGE(s->today);
        LOCAL_TEXT(label);
        bool fits = ceduo_utf8_width(range) <= (size_t)width; /* 331–1000 does not: it stands in the place of its name */
        ceduo_text_format(&label, fits ? "%s" : "90 %% %s", fits ? _("  90 % range") : range);
        add_texts_row(page, (const char *const[3][2]){{"", ceduo_text_string(&label)}, {fits ? range : "", ""}, {"", ""}});
    }
    if (blocks && !nothing) /* with block sizes the return period is the relevant figure */
        add_texts_row(page, (const char *const[3][2]){
                                {_("return period of such a rock, years"), _("years apart")},
                                {RETURN_PERIOD_RANGE(ceduo_judged_rate(wooded)), RETURN_PERIOD(ceduo_judged_rate(wooded))},
                                {RETURN_PERIOD_RANGE(ceduo_judged_rate(bare)), RETURN_PERIOD(ceduo_judged_rate(bare))}});
    for (enum ceduo_fence_share what = 0; ceduo_fence_find(s->bare) && what < CEDUO_FENCE_SHARES; what++)
        if (lines >= (what == CEDUO_FENCE_DEFEATED ? LOW : FULL))
            add_figure(page, ceduo_measure_fence(what, wooded), ceduo_measure_fence(what, bare));
    for (enum ceduo_measure_kind what = 0; what < CEDUO_MEASURE_KINDS; what++) {
        const struct ceduo_measure through = ceduo_measure_figure(what, wooded), without = ceduo_measure_figure(what, bare);
        bool any = through.value > 0 || without.value > 0, mean = what >= CEDUO_MEAN_KJ;
        int from = min_lines[what];
        if (blocks && !full && mean) /* mostly large blocks arrive: their mean would make the forest look harmful */
            from = what == CEDUO_RELEASED_KJ ? LOW : FULL;
        if (lines >= from && (any || what == CEDUO_STOPPED || what == CEDUO_RESTED || mean) && !(nothing && mean))
            add_figure(page, through, without);
    }
    if (page->width >= CEDUO_PAGE_WIDTH) /* a pane keeps its columns during the simulation */
        ceduo_page_trim(page);
}

/* Append the lights of a test, today and over the years ahead. The latter fails if any year fails. */
static void add_test(struct ceduo_page *page, const struct ceduo_subject *s, const char *limit, enum ceduo_light today,
                     size_t failing, bool known)
{
    const struct ceduo_choice *c = s->choice ? ceduo_report_years_ahead(s->report, s->option) : NULL;
    ceduo_page_cell_format(page, "%s", limit);
    ceduo_page_light(page, today);
    if (c && page->width < CEDUO_PAGE_WIDTH)
        ceduo_page_light(page, !known || c->last_summary->nothing ? CEDUO_LIGHT_UNKNOWN
                               : failing > 0                      ? CEDUO_LIGHT_FAIL
                                                                  : CEDUO_LIGHT_PASS);
    else
        ceduo_page_cell_format(page, "%s", "");
}

static void add_name(struct ceduo_page *page, const char *name, const char *shorter)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    ceduo_text_append(&cell->text, page->width < CEDUO_PAGE_WIDTH ? shorter : name);
}

static void add_index(struct ceduo_page *page, const char *name, const char *shorter, const char *value)
{
    add_name(page, name, shorter);
    ceduo_page_cell_format(page, "%s", value);
    for (int i = 0; i < 3; i++)
        ceduo_page_cell_format(page, "%s", "");
}

void ceduo_page_tests(struct ceduo_page *page, const struct ceduo_subject *s, int lines)
{
    const struct ceduo_index *index = s->index;
    const struct ceduo_scene *scene = s->report->result->scene;
    const struct ceduo_years_summary no_years = {0};
    const struct ceduo_choice none = {.last_summary = &no_years}, *c = s->choice ? s->choice : &none;
    const struct ceduo_page_column columns[] = {{"", 11, 2, COL_GROW},
                                                {"", page->width < CEDUO_PAGE_WIDTH ? -6 : -18, 0, COL_SHRINK},
                                                {"", -7, 0, 0},
                                                {"", 1, 1, 0},
                                                {"", 1, 0, 0}};
    double threshold = scene->simulation.threshold, limit = ceduo_exceed_limit(scene, s->place), share = s->today.value / 1000;
    bool judged = index->energy != CEDUO_LIGHT_UNKNOWN && s->wooded;
    LOCAL_TEXT(adc_limit);
    LOCAL_TEXT(free_run_limit);
    LOCAL_TEXT(energy_limit);
    ceduo_text_format(&adc_limit, "< %s", LOCALIZED(threshold));
    ceduo_text_format(&free_run_limit, "\xe2\x89\xa4 %g", CEDUO_FREE_RUN_MAX * 100);
    if (judged)
        ceduo_text_format(&energy_limit, "\xe2\x89\xa4 %s", SIG_TRIMMED(limit * 100, 3));
    CEDUO_PAGE_TABLE_OF(page, columns);
    bool gap = index->length > 0 && index->longest_gap > threshold; /* the gap is why both tests fail */
    add_name(page, gap ? _("gap without forest, m") : _("distance between contacts (ADC), m"), gap ? _("gap m") : _("ADC m"));
    ceduo_page_cell_format(page, "%s", gap ? SIG_TRIMMED(index->longest_gap, 6) : VS_LIMIT(index->worst_adc, 3, threshold));
    add_test(page, s, adc_limit.bytes, index->contact, c->last_summary->unprotected_contact, true);
    add_name(page, _("free run: chance of no contact, %"), _("free run %"));
    ceduo_page_cell_format(page, "%s", PERCENT_VS_LIMIT(index->worst_free_run, CEDUO_FREE_RUN_MAX));
    add_test(page, s, free_run_limit.bytes, index->free_run, c->last_summary->unprotected_free_run, true);
    add_name(page, _("energy: too much, % of the rocks"), _("energy %"));
    ceduo_page_cell_format(page, "%s",
                           judged                                                       ? PERCENT_VS_LIMIT(share, limit)
                           : s->report->busy && s->report->result->wooded && !s->wooded ? "\xe2\x80\xa6"
                                                                                        : "-");
    add_test(page, s, ceduo_text_string(&energy_limit), index->energy, c->last_summary->unprotected_energy, c->energy_known);
    if (isnan(index->residual)) /* no rock arrives without forest */
        return;
    if (lines >= CEDUO_LINES_SHORT)
        add_index(page, _("energy taken by stems (index), kJ"), _("taken kJ"), SIG(index->dissipated * J_TO_KJ, 3));
    add_index(page, _("energy left (index), kJ"), _("left kJ"),
              !index->exhausted                ? SIG(index->residual * J_TO_KJ, 3)
              : page->width < CEDUO_PAGE_WIDTH ? "0"
                                               : _("none"));
    if (!isnan(index->measured) && lines >= CEDUO_LINES_SHORT)
        add_index(page, _("energy measured on one rock, kJ"), _("measured kJ"), SIG(index->measured * J_TO_KJ, 3));
}

static void add_arrivals(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control,
                         bool with_bare)
{
    bool forest = report->result->scene->options[option].belts_count > 0;
    const struct ceduo_subject s = ceduo_subject_find(report, forest || !with_bare ? option : SIZE_MAX, control);
    const double *ends = report->result->options[option].wooded.ends.share;
    if (s.wooded || with_bare)
        ceduo_page_arrivals(page, &s, CEDUO_LINES_ALL, with_bare);
    const struct ceduo_measure wooded = ceduo_measure_figure(CEDUO_MEAN_KJ, s.wooded),
                               bare = ceduo_measure_figure(CEDUO_MEAN_KJ, s.bare);
    if (forest && wooded.value - bare.value >
                      hypot(wooded.hi - wooded.value,
                            bare.hi - bare.value)) /* a higher mean is selection, not harm: stems stop slow rocks first */
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("The mean energy is higher with forest because stems stop the slower and smaller rocks first."));
    if (s.index && s.wooded && control == report->result->last_control)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("On the whole profile: of 1000, %.0f are stopped by stems, %.0f come to rest, %.0f leave it."),
                        ends[CEDUO_END_STOPPED_BY_STEMS] * 1000, ends[CEDUO_END_AT_REST] * 1000,
                        ends[CEDUO_END_LEFT_SLOPE] * 1000);
}

static void add_lights(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
    if (ceduo_too_few_arrivals(&r->bare.arrivals[control])) { /* the reason is at the top of the page */
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE, _("Contact, free run and energy cannot be assessed."));
        return;
    }
    for (size_t i = 0; i < 3; i++)
        ceduo_words_test(ceduo_page_add(page, CEDUO_PAGE_SENTENCE), r, option, control, i);
    if (r->options[option].alternatives[control].known && r->options[option].alternatives[control].stems)
        ceduo_words_alternative_law(ceduo_page_add(page, CEDUO_PAGE_SENTENCE), r, option, control);
}

/* ---- belts, by the index ---- */

static void add_belts(struct ceduo_page *page, const struct ceduo_scene *scene, const struct ceduo_option *o,
                      const struct ceduo_option_result *found)
{
    static const struct ceduo_page_column columns[] = {
        {N_("stand"), 10, 2, COL_GROW},
        {NP_("head", "m|from, to, m"), 1, 1, COL_SHRINK | COL_PRIORITY(4)},
        {N_("ADC m|ADC, m"), -5, 1, COL_SHRINK},
        {NULL, -5, 1, COL_SHRINK},
        {NP_("head", "free run|chance of a free run"), -7, 1, COL_SHRINK | COL_PRIORITY(7)},
        {NP_("head", "kJ|energy taken, kJ"), -5, 1, COL_SHRINK | COL_PRIORITY(8)},
        {N_("kJ/100 m|taken per 100 m, kJ"), -5, 1, COL_SHRINK | COL_PRIORITY(9)}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *head = ceduo_page_head(page);
    ceduo_text_format(&head->text, "<%s m", LOCALIZED(scene->simulation.threshold));
    ceduo_text_format(&head->long_text, _("below %s m"), LOCALIZED(scene->simulation.threshold));
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_belt *b = &o->belts[i];
        const struct ceduo_stand_result *s = &found->stands[i];
        LOCAL_TEXT(name);
        ceduo_plot_belt_name(&name, b);
        ceduo_page_cell_role(page, CEDUO_ROLE_BELT, ceduo_text_string(&name));
        ceduo_page_cell_format(page, "%s\xe2\x80\x93%s", LOCALIZED(b->from_given), LOCALIZED(b->to_given));
        ceduo_page_cell_format(page, "%s", VS_LIMIT(s->adc_m, 3, scene->simulation.threshold));
        ceduo_page_light(page, s->passes_threshold ? CEDUO_LIGHT_PASS : CEDUO_LIGHT_FAIL);
        ceduo_page_free_run(page, s->free_run_probability);
        ceduo_page_number(page, s->dissipated * J_TO_KJ, 3);
        ceduo_page_number(page, s->per_100m * J_TO_KJ, 3);
    }
}

/* Return the length of the ground between two positions, m. */
static double ground_length(const struct ceduo_slope *s, double from, double to)
{
    double length = 0;
    for (size_t j = 0; j + 1 < s->vertices; j++) {
        double a = fmax(from, s->x[j]), b = fmin(to, s->x[j + 1]);
        if (b > a)
            length += (b - a) * hypot(1, (s->z[j + 1] - s->z[j]) / (s->x[j + 1] - s->x[j]));
    }
    return length;
}

/* Append each belt's ADC by other forms, and the length on the ground of the threshold, which is horizontal. */
static void add_other_forms(struct ceduo_page *page, const struct ceduo_scene *scene, const struct ceduo_option *o,
                            const struct ceduo_option_result *found)
{
    double threshold = scene->simulation.threshold;
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_stand_result *s = &found->stands[i];
        if (s->bare)
            continue;
        struct text *line = ceduo_page_add(page, CEDUO_PAGE_DETAIL);
        const char *between = "";
        ceduo_text_format(line, _("%s by %s; other forms:"), o->belts[i].name,
                          ceduo_words_law(ceduo_rule_words.names[s->rule]));
        for (enum ceduo_rule rule = CEDUO_RULE_GSTEIGER_STOOLS; rule <= CEDUO_RULE_CROFTON; rule++)
            if (rule != s->rule) {
                ceduo_text_format(line, "%s %s %s m", between, ceduo_words_law(ceduo_rule_words.names[rule]),
                                  SIG(ceduo_adc_value(&s->adc, rule), 3));
                between = ",";
            }
        const struct ceduo_belt *b = &o->belts[i];
        ceduo_text_format(line, _("; %s m on the map are %s m along the ground"), LOCALIZED(threshold),
                          SIG(threshold * ground_length(&scene->slope, b->from, b->to) / (b->to - b->from), 2));
    }
}

static void add_residual(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
#define SAME_DECIMALS(value) SIG(value, (value) > 0 ? decimals + (int)floor(log10(value)) + 1 : 1)
    const struct ceduo_index *index = &r->options[option].controls[control];
    double mean = ceduo_measure_figure(CEDUO_MEAN_KJ, &r->bare.arrivals[control]).value, taken = index->dissipated * J_TO_KJ;
    double remaining = index->residual * J_TO_KJ;
    int decimals = mean > 0 ? (int)fmax(0, 3 - floor(log10(mean))) : 1; /* equal decimals, so that the numbers add up */
    LOCAL_TEXT(rest);
    if (index->exhausted)
        ceduo_text_append(&rest, _("nothing is left on average, some rocks still pass"));
    else
        ceduo_text_format(&rest, _("%s kJ are left"), SAME_DECIMALS(remaining));
    if (index->length > 0 && mean > 0)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("By the index stems could absorb %s kJ (Eq. 4), %s kJ per 100 m; of %s kJ %s (Eq. 5)."),
                        SAME_DECIMALS(taken), SIG(index->per_100m * J_TO_KJ, 3), SAME_DECIMALS(mean), rest.bytes);
    if (!isnan(index->measured))
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("Measured here on one rock: %s kJ (%g m/s). One rock does not validate the model."),
                        SIG(index->measured * J_TO_KJ, 3), r->scene->controls[control].measured_speed);
}

/* ---- other block sizes ---- */

static void add_sizes(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_size_result *blocks)
{
    static const struct ceduo_page_column columns[] = {{"", 3, 0, 0},
                                                       {NP_("head", "m3|volume, m3"), -8, 0, 0},
                                                       {NP_("head", "kg|mass, kg"), -9, 0, 0},
                                                       {NP_("head", "wide m|mean diameter, m"), -8, 0, 0},
                                                       {N_("ADC m|ADC, m"), -8, 0, 0},
                                                       {N_("contacts"), -10, 0, 0},
                                                       {NULL, -18, 0, 0}};
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    double own = NAN;
    for (size_t i = 0; i < CEDUO_SIZES; i++)
        own = blocks[i].own ? blocks[i].volume : own;
    ceduo_page_para(page, CEDUO_PAGE_CAPTION,
                    _("Blocks of other sizes, same shape and release; of 1000 at %s m (> this scene's size):"),
                    LOCALIZED(c->x_given));
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_page_limit(ceduo_page_head(page), c);
    bool skipped = false;
    for (size_t i = 0; i < CEDUO_SIZES; i++) {
        const struct ceduo_size_result *b = &blocks[i];
        if (!b->own && b->volume < 2 * own && 2 * b->volume > own)
            continue; /* skip sizes within a factor 2 of the scene's own */
        ceduo_page_cell_format(page, "%s", b->own ? "  >" : "");
        ceduo_page_number(page, b->volume, 3);
        ceduo_page_number(page, b->mass, 3);
        ceduo_page_number(page, b->diameter, 3);
        ceduo_page_number(page, b->adc, 3);
        ceduo_page_number(page, b->contacts, 3);
        ceduo_page_cell_format(
            page, "%s", INTERVAL(ceduo_measure_exceeding(c, ceduo_rocks_released(&b->arrivals) > 0 ? &b->arrivals : NULL)));
        skipped |= ceduo_rocks_released(&b->arrivals) == 0;
    }
    if (skipped && r->scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX && ceduo_result_rocks(r) > 0)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("A size with a dash was skipped: its rocks meet too many stems to be simulated here."));
}

/* ---- percentiles of speed, energy and height ---- */

/* Fewer digits for heights below 1 m and 0.1 m. */
#define SIG_SHORT(value) SIG(value, (value) < 0.1 ? 1 : (value) < 1 ? 2 : 3)

static void add_percentile(struct ceduo_page *page, double value, double lo, double hi)
{
    struct ceduo_page_cell *both = ceduo_page_cell(page);
    struct text *cell = &both->text;
    ceduo_text_append(cell, SIG_SHORT(value));
    if (isnan(value))
        return;
    ceduo_text_append(&both->shorter, SIG_SHORT(value)); /* without the interval */
    if (!isnan(lo) && !isnan(hi))
        ceduo_text_format(cell, " (%s\xe2\x80\x93%s)", SIG_SHORT(lo), SIG_SHORT(hi));
    else if (!isnan(lo))
        ceduo_text_format(cell, " (> %s)", SIG_SHORT(lo));
    else if (!isnan(hi))
        ceduo_text_format(cell, " (< %s)", SIG_SHORT(hi));
}

static void add_percentiles(struct ceduo_page *page, const char *name, const struct ceduo_distribution *d, double scale)
{
    ceduo_page_cell_format(page, "%s", name);
    add_percentile(page, d->p50 * scale, d->p50_lo * scale, d->p50_hi * scale);
    add_percentile(page, d->p95 * scale, d->p95_lo * scale, d->p95_hi * scale);
    add_percentile(page, d->p99 * scale, d->p99_lo * scale, d->p99_hi * scale);
}

void ceduo_page_percentiles(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control, bool bare)
{
    static const struct ceduo_page_column columns[] = {{NULL, 22, 4, COL_WRAP},
                                                       {N_("50 %"), -18, 0, COL_WRAP},
                                                       {N_("95 %"), -18, 0, COL_WRAP},
                                                       {N_("99 %"), -18, 0, COL_WRAP}};
    const struct ceduo_arrivals *runs[] = {option < SIZE_MAX ? ceduo_result_wooded(r, option, control) : NULL,
                                           bare ? &r->bare.arrivals[control] : NULL};
    if (!runs[0] && !runs[1])
        return;
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, "%s", _("Percentiles of the rocks that arrive (95 % interval):"));
    for (size_t i = 0; i < 2; i++) {
        const struct ceduo_arrivals *a = runs[i];
        if (!a)
            continue;
        CEDUO_PAGE_TABLE_OF(page, columns);
        ceduo_text_format(&ceduo_page_head(page)->text, i == 0 ? _("forest, %llu of %llu") : _("without, %llu of %llu"),
                          (unsigned long long)ceduo_rocks_reached(a), (unsigned long long)ceduo_rocks_released(a));
        add_percentiles(page, _("speed, m/s"), ceduo_arrival_distribution(CEDUO_ARRIVAL_SPEED, a), 1);
        add_percentiles(page, _("energy, kJ"), ceduo_arrival_distribution(CEDUO_ARRIVAL_ENERGY, a), J_TO_KJ);
        add_percentiles(page, _("underside, m up"), ceduo_arrival_distribution(CEDUO_ARRIVAL_HEIGHT, a), 1);
    }
}

/* ---- option ---- */

void ceduo_page_stand_warnings(struct ceduo_page *page, const struct ceduo_result *r, size_t option)
{
    const struct ceduo_option *o = &r->scene->options[option];
    for (size_t k = 0; k < o->belts_count; k++)
        ceduo_words_stand_warnings(r->scene, &o->belts[k], &r->options[option].stands[k], ceduo_page_warn_once, page);
}

void ceduo_page_option(struct ceduo_page *page, const struct ceduo_report *report, size_t i, bool bare)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_option *option = &r->scene->options[i];
    bool full = page->width >= CEDUO_PAGE_WIDTH; /* a pane is next to pictures and a column with the other figures */
    if (option->belts_count > 0 && r->scene->controls_count > 0)
        add_belts(page, r->scene, option, &r->options[i]);
    for (size_t k = 0; k < r->scene->controls_count; k++) {
        add_place(page, report, k);
        add_arrivals(page, report, i, k, bare);
        add_lights(page, r, i, k);
        if (full && r->bare.rocks > 0)
            ceduo_page_percentiles(page, r, i, k, bare);
        ceduo_page_fence(page, report, i, k);
        ceduo_page_design(page, report, i, k);
        if (k == 0)
            add_other_forms(page, r->scene, option, &r->options[i]);
        add_residual(page, r, i, k);
    }
    if (full && report->blocks && !report->years)
        add_sizes(page, r, &report->blocks[i * CEDUO_SIZES]);
    if (full && report->years)
        ceduo_page_years(page, report, i);
    ceduo_page_stand_warnings(page, r, i);
    ceduo_page_stand_rules(page, r, i, true);
}

/* ---- notes ---- */

#define DIGITS "0123456789"

static bool is_shown_note(const struct ceduo_report *report, const struct source_note *note)
{
    return strcmp(note->kind, "assumed") == 0 && (report->years || !ceduo_note_years(note));
}

/* Append the name of an assumed value for a list: "limit of control 1", "bounce Rn". `where`: its place; empty: `sentence` is
 * the source of a whole scene, and its first clause is used. */
static void add_assumed_name(struct ceduo_page *page, const char *path, const char *where, const char *sentence)
{
    const char *dot = strrchr(path, '.');
    if (strncmp(path, "controls[", 9) == 0 && !dot)
        ceduo_page_once(page, CEDUO_PAGE_ITEM, _("limit of %s"), where);
    else if (dot && strcmp(dot, ".stools") == 0)
        ceduo_page_once(page, CEDUO_PAGE_ITEM, "%s", _("stools per ha; shoot spacing"));
    else if (*where)
        ceduo_page_once(page, CEDUO_PAGE_ITEM, "%.*s", (int)strcspn(where, ","), where);
    else
        ceduo_page_once(page, CEDUO_PAGE_ITEM, "%.*s", (int)strcspn(sentence, ";"), sentence);
}

/* A text in three parts: before, in, and after its first number. */
struct split {
    size_t before, number; /* lengths, bytes */
    const char *after;
};

static struct split split_number(const char *text)
{
    struct split s = {.before = strcspn(text, DIGITS)};
    s.number = strspn(text + s.before, DIGITS);
    s.after = text + s.before + s.number;
    return s;
}

/* True if two texts are equal, or differ in their first number only. */
static bool is_like(const char *a, const char *b)
{
    struct split p = split_number(a), q = split_number(b);
    return p.before == q.before && strncmp(a, b, p.before) == 0 && strcmp(p.after, q.after) == 0;
}

/* True if notes are listed together. `places`: one sentence lists the first numbers of like texts. */
static bool is_listed_with(const struct source_note *a, const struct source_note *b, bool places)
{
    return strcmp(a->kind, "assumed") == 0 && (places ? is_like(a->text, b->text) : strcmp(a->text, b->text) == 0);
}

/* Append the first numbers of notes that are listed with `note`, "25, 13, 26", in the order of the files. */
static void append_numbers(struct text *numbers, const struct source_note *notes, const struct source_note *note)
{
    if (!notes)
        return;
    append_numbers(numbers, notes->before, note);
    const char *text = ceduo_in_language(notes->text, notes->text_it);
    struct split s = split_number(text);
    bool repeated = false;
    for (const struct source_note *n = notes->before; n && !repeated; n = n->before)
        repeated = is_listed_with(n, note, true) && strcmp(n->text, notes->text) == 0;
    if (!is_listed_with(notes, note, true) || repeated)
        return;
    ceduo_text_append(numbers, numbers->length > 0 ? ", " : "");
    ceduo_text_append_n(numbers, text + s.before, s.number);
}

/* Append notes in order; the list has the last first. */
static void add_assumption(struct ceduo_page *page, const struct ceduo_report *report, const struct source_note *note,
                           bool places)
{
    if (!note)
        return;
    add_assumption(page, report, note->before, places);
    const struct source_note *first_same = NULL; /* first in the files, last in the list; printed here with the count */
    size_t count = 0;
    for (const struct source_note *n = report->file->notes; n; n = n->before)
        if (is_listed_with(n, note, places)) {
            count++;
            first_same = n;
        }
    if (!is_shown_note(report, note) || first_same != note)
        return;
    const char *sentence = ceduo_in_language(note->text, note->text_it);
    LOCAL_TEXT(where);
    const struct ceduo_scene *scene = report->result->scene;
    const char *dot = strncmp(note->path, "options[", 8) == 0 ? strchr(note->path, '.') : NULL;
    size_t option = dot ? strtoul(note->path + 8, NULL, 10) : SIZE_MAX;
    ceduo_format_path(dot ? dot + 1 : note->path, &where);
    if (!places) {
        add_assumed_name(page, note->path, ceduo_text_string(&where), sentence);
        return;
    }
    if (option < scene->options_count)
        ceduo_text_append_joined(&where, ", ", "%s", scene->options[option].name);
    const char *place = where.length > 0 ? where.bytes : _("the scene");
    const struct split s = split_number(sentence);
    LOCAL_TEXT(numbers);
    LOCAL_TEXT(merged);
    append_numbers(&numbers, report->file->notes, note);
    ceduo_text_append_n(&merged, sentence, s.before);
    ceduo_text_append(&merged, ceduo_text_string(&numbers));
    ceduo_text_append(&merged, s.after);
    if (count > 1)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, ngettext("%s (%s and %zu more)", "%s (%s and %zu more)", count - 1),
                        merged.bytes, place, count - 1);
    else
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s (%s)", sentence, place);
}

void ceduo_page_assumed(struct ceduo_page *page, const struct ceduo_report *report, bool places)
{
    add_assumption(page, report, report->file->notes, places);
}

static void add_table(void *page, const char *line)
{
    ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s", line);
}

void ceduo_page_notes(struct ceduo_page *page, const struct ceduo_report *report)
{
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    const struct ceduo_page_block *gap = page->last;
    ceduo_words_run_warnings(report->result, &report->remarks, ceduo_page_warn, page);
    if (page->last == gap)
        ceduo_page_drop(page);
    const struct source_note *note = report->file->notes;
    if (ceduo_notes_print(note, CEDUO_NOTE_TABLE, ""))
        ceduo_page_para(page, CEDUO_PAGE_SECTION, _("Tables as they were read:"));
    ceduo_notes_each(note, CEDUO_NOTE_TABLE, add_table, page);
    while (note && !is_shown_note(report, note))
        note = note->before;
    if (!note)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("* Assumed, not measured:"));
    ceduo_page_assumed(page, report, true);
}

/* ---- the page ---- */

static void add_full_page(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    ceduo_page_para(page, CEDUO_PAGE_TITLE, "%s", ceduo_in_language(scene->title, scene->title_it));
    ceduo_page_facts(page, report);
    ceduo_page_question(page, report);
    ceduo_page_answer(page, report);
    ceduo_page_certainty(page, report);
    ceduo_uncertainty_warn_outside(report->uncertainty, ceduo_page_warn, page);
    ceduo_page_over_time(page, report);
    ceduo_page_fence_answer(page, report, false);
    if (scene->options_count > 1) /* shared by all options */
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("without forest"));
    for (size_t k = 0; scene->options_count > 1 && k < scene->controls_count; k++) {
        const struct ceduo_subject bare = ceduo_subject_find(report, SIZE_MAX, k);
        add_place(page, report, k);
        ceduo_page_arrivals(page, &bare, CEDUO_LINES_ALL, true);
        if (report->result->bare.rocks > 0)
            ceduo_page_percentiles(page, report->result, SIZE_MAX, k, true);
    }
    for (size_t i = 0; i < scene->options_count; i++) {
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", scene->options[i].name);
        ceduo_page_option(page, report, i, scene->options_count == 1);
    }
    if (scene->options_count > 1 && scene->controls_count > 0)
        ceduo_page_comparison(page, report, CEDUO_COMPARE_ALL);
    for (size_t c = 0; c < scene->controls_count; c++)
        ceduo_page_hazard(page, report, c, c == 0);
    if (report->years && scene->options_count > 1 && scene->controls_count > 0)
        ceduo_page_years_all_options(page, report);
    ceduo_page_notes(page, report);
}

void ceduo_report_page(struct text *text, const struct ceduo_report *report, bool full, bool plain)
{
    LOCAL_PAGE(page, CEDUO_PAGE_WIDTH);
    (full ? add_full_page : ceduo_page_short)(&page, report);
    ceduo_page_print(text, &page, plain);
}
