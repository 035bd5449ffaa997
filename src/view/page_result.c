/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of a result: what was simulated, then each option at each control, then the options side by side; below, warnings of
 * the whole run, and each assumption with the first place that makes it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "plot.h"
#include "scene/choices.h"
#include "typed.h"

/* ---- head ---- */

/* Words of files, as they are shown. */
static const char *const shapes[] = {[CEDUO_SPHERE] = N_("sphere"),
                                     [CEDUO_CYLINDER] = N_("cylinder"),
                                     [CEDUO_ELLIPSOID] = N_("ellipsoid"),
                                     [CEDUO_BLOCK] = N_("block")};
static const char *const facets[] = {[CEDUO_AGAINST] = N_("against"), [CEDUO_BOTH] = N_("both")};

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
                      s->blocks_count > 0 ? _("%s; rocks are the blocks below, the index is of %s kg, mean diameter %s m")
                      : ceduo_rock_varies(&s->rock) ? _("%s, %s kg, mean diameter %s m (means of its spread)")
                                                    : _("%s, %s kg, mean diameter %s m"),
                      _(shapes[s->rock.shape]), WRITTEN(r->rock.mass, 4), WRITTEN(r->rock.mean_diameter, 3));
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
    ceduo_text_format(line, _("%s m long, %s m high, "), WRITTEN(slope->x[slope->vertices - 1], 4), WRITTEN(high - low, 4));
    ceduo_words_points(line, slope);
    ceduo_text_format(line, _("; law %s, facets %s%s"), ceduo_words_law(ceduo_law_words.names[s->simulation.law]),
                      _(facets[slope->facets]), assumed_mark(report, "slope"));
    if (!s->simulation.friction_bound && s->simulation.law != CEDUO_LAW_ARM)
        ceduo_text_append(line, _("; published law, without the friction bound"));
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_FACT, _("Rocks")), _("%llu, seed %llu"),
                      (unsigned long long)ceduo_result_rocks(r), (unsigned long long)s->simulation.seed);
}

/* ---- what arrives at a control ---- */

static void add_place(struct ceduo_page *page, const struct ceduo_report *report, size_t i)
{
    const struct ceduo_control *c = &report->result->scene->controls[i];
    struct text *place = ceduo_page_add(page, CEDUO_PAGE_PLACE);
    LOCAL_TEXT(where);
    ceduo_text_format(place, _("At %s m"), SHORTEST(c->x_given));
    if (c->name)
        ceduo_text_format(place, ", %s", c->name);
    ceduo_text_format(&where, "controls[%zu].accepted_kJ", i);
    if (!isnan(c->accepted))
        ceduo_text_append_joined(place, ", ", _("withstands %s kJ%s"), SHORTEST(ceduo_words_accepted(c)),
                                 ceduo_scene_assumes_value(report->file, where.bytes) ? "*" : "");
    ceduo_words_topography(place, ceduo_topography_at(&report->result->bare.arrivals[i]), false);
}

/* A row: name, through the forest, without it; each shorter where its column is narrow. */
static void add_row(struct ceduo_page *page, const char *const texts[3][2])
{
    for (int i = 0; i < 3; i++) {
        struct ceduo_page_cell *cell = ceduo_page_cell(page);
        ceduo_text_append(&cell->text, texts[i][i == 0 && page->width < CEDUO_PAGE_WIDTH]); /* names of a pane are all brief */
        ceduo_text_append(&cell->shorter, texts[i][1]);
    }
}

static void add_figure(struct ceduo_page *page, struct ceduo_measure wood, struct ceduo_measure bare)
{
    add_row(page, (const char *const[3][2]){{NAMED(bare, CEDUO_PHRASE), NAMED(bare, CEDUO_ROW)},
                                            {INTERVAL(wood), WITH_ERROR(wood, "")},
                                            {INTERVAL(bare), VALUE_OF(bare)}});
}

#define PANE_WIDE 34 /* columns that hold an interval */

void ceduo_page_arrivals(struct ceduo_page *page, const struct ceduo_subject *s, int lines, bool with_bare)
{
    enum { LOW = 15, MIN = 18, ALL = 24, WHOLE = CEDUO_LINES_WHOLE };
    static const int least[CEDUO_P95_TOP] = {LOW, MIN, MIN, LOW, LOW, LOW, WHOLE, ALL, WHOLE, WHOLE};
    const struct ceduo_arrivals *wood = s->index ? s->wooded : NULL, *bare = with_bare ? s->bare : NULL;
    bool whole = lines >= WHOLE, nothing = !whole && ceduo_too_few_arrivals(s->bare), blocks = ceduo_hazard_at(s->bare);
    int width = page->width >= CEDUO_PAGE_WIDTH ? 18 : page->width >= PANE_WIDE ? 14 : 7;
    const struct ceduo_page_column columns[] = {
        {N_("of 1000"), 13, 2, CEDUO_FILLS}, {"", -width, 0, 0}, {"", width == 14 ? -8 : -width, 0, 0}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *heads = page->last->cells;
    ceduo_text_append(&heads[1].text, _("with forest"));
    ceduo_text_format(&heads[1].shorter, "%s ", _("forest")); /* apart from the next one */
    ceduo_text_append(&heads[2].text, _("without forest"));
    ceduo_text_append(&heads[2].shorter, _("without"));
    add_figure(page, ceduo_measure_arriving(wood), ceduo_measure_arriving(bare));
    if (!isnan(s->place->accepted) && !nothing)
        add_figure(page, ceduo_measure_exceeding(s->place, wood), ceduo_measure_exceeding(s->place, bare));
    if (!whole && !nothing && wood && !isnan(s->today.may_lo) && page->width < CEDUO_PAGE_WIDTH)
        add_row(page, (const char *const[3][2]){{"", _("  90 % range")}, {MAY_BE(s->today), ""}, {"", ""}});
    if (blocks && !nothing) /* what matters if blocks of all sizes come down */
        add_row(page, (const char *const[3][2]){{_("years from one such rock to the next"), _("years apart")},
                                                {YEARS(ceduo_feared(wood)), EVERY(ceduo_feared(wood))},
                                                {YEARS(ceduo_feared(bare)), EVERY(ceduo_feared(bare))}});
    for (enum ceduo_measured what = 0; what < CEDUO_P95_TOP; what++) {
        const struct ceduo_measure through = ceduo_measured(what, wood), without = ceduo_measured(what, bare);
        bool any = through.value > 0 || without.value > 0, mean = what >= CEDUO_MEAN_KJ;
        int from = least[what];
        if (blocks && !whole && mean) /* the large arrive: a mean of those would read as if the forest did harm */
            from = what == CEDUO_RELEASED_KJ ? LOW : WHOLE;
        if (lines >= from && (any || what == CEDUO_STOPPED || what == CEDUO_RESTED || mean) && !(nothing && mean))
            add_figure(page, through, without);
    }
    if (page->width >= CEDUO_PAGE_WIDTH) /* a pane keeps its columns while rocks fall */
        ceduo_page_trim(page);
}

/* Signs of a test today and in the worst year ahead: it fails if it does so in any of n years. */
static void add_test(struct ceduo_page *page, const struct ceduo_subject *s, const char *limit, enum ceduo_light today,
                     size_t failing, bool known)
{
    const struct ceduo_choice *c = s->choice ? ceduo_report_ahead(s->report, s->option) : NULL;
    ceduo_page_cell_format(page, "%s", limit);
    ceduo_page_light(page, today);
    if (c && page->width < CEDUO_PAGE_WIDTH)
        ceduo_page_light(page, !known || c->over->nothing ? CEDUO_UNKNOWN : failing > 0 ? CEDUO_FAIL : CEDUO_PASS);
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
    const struct ceduo_choice none = {0}, *c = s->choice ? s->choice : &none;
    const struct ceduo_page_column columns[] = {{"", 11, 2, CEDUO_FILLS},
                                                {"", page->width < CEDUO_PAGE_WIDTH ? -6 : -18, 0, 0},
                                                {"", -7, 0, 0},
                                                {"", 1, 1, 0},
                                                {"", 1, 0, 0}};
    double threshold = scene->simulation.threshold, limit = ceduo_exceed_limit(scene, s->place), share = s->today.value / 1000;
    bool judged = index->energy != CEDUO_UNKNOWN && s->wooded;
    LOCAL_TEXT(below);
    LOCAL_TEXT(most);
    LOCAL_TEXT(accepted);
    ceduo_text_format(&below, "< %s", SHORTEST(threshold));
    ceduo_text_format(&most, "\xe2\x89\xa4 %g", CEDUO_FREE_RUN_MAX * 100);
    ceduo_text_format(&accepted, judged ? "\xe2\x89\xa4 %s" : "", ROUNDED(limit * 100, 3));
    CEDUO_PAGE_TABLE_OF(page, columns);
    bool gap = index->length > 0 && index->longest_gap > threshold; /* the reason why neither is kept */
    add_name(page, gap ? _("gap without forest, m") : _("distance between contacts (ADC), m"), gap ? _("gap m") : _("ADC m"));
    ceduo_page_cell_format(page, "%s", gap ? ROUNDED(index->longest_gap, 6) : BESIDE(index->worst_adc, 3, threshold));
    add_test(page, s, below.bytes, index->contact, c->over->unprotected_contact, true);
    add_name(page, _("free run: chance of no contact, %"), _("free run %"));
    ceduo_page_cell_format(page, "%s", PERCENT(index->worst_free_run, CEDUO_FREE_RUN_MAX));
    add_test(page, s, most.bytes, index->free_run, c->over->unprotected_free_run, true);
    add_name(page, _("energy: too much, % of the rocks"), _("energy %"));
    ceduo_page_cell_format(page, "%s", judged ? PERCENT(share, limit) : s->report->busy && !s->wooded ? "\xe2\x80\xa6" : "-");
    add_test(page, s, ceduo_text_string(&accepted), index->energy, c->over->unprotected_energy, c->energy_known);
    if (isnan(index->residual)) /* no rock arrives without forest */
        return;
    if (lines >= CEDUO_LINES_SHORT)
        add_index(page, _("energy taken by stems (index), kJ"), _("taken kJ"), WRITTEN(index->dissipated * J_TO_KJ, 3));
    add_index(page, _("energy left (index), kJ"), _("left kJ"),
              index->exhausted ? _("none") : WRITTEN(index->residual * J_TO_KJ, 3));
    if (!isnan(index->measured) && lines >= CEDUO_LINES_SHORT)
        add_index(page, _("energy measured on one rock, kJ"), _("measured kJ"), WRITTEN(index->measured * J_TO_KJ, 3));
}

static void add_arrivals(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control,
                         bool with_bare)
{
    bool forest = report->result->scene->options[option].belts_count > 0;
    const struct ceduo_subject s = ceduo_subject_find(report, forest || !with_bare ? option : SIZE_MAX, control);
    const double *ends = report->result->options[option].wooded.ends.share;
    if (s.wooded || with_bare)
        ceduo_page_arrivals(page, &s, CEDUO_LINES_WHOLE, with_bare);
    const struct ceduo_measure wood = ceduo_measured(CEDUO_MEAN_KJ, s.wooded), bare = ceduo_measured(CEDUO_MEAN_KJ, s.bare);
    if (forest && wood.value - bare.value > hypot(wood.hi - wood.value, bare.hi - bare.value)) /* reads as harm */
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("The mean energy is higher with forest because stems stop the slower and smaller rocks first."));
    if (s.index && s.wooded && control == report->result->last_control)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("On the whole profile: of 1000, %.0f are stopped by stems, %.0f come to rest, %.0f leave it."),
                        ends[CEDUO_STOPPED_BY_STEMS] * 1000, ends[CEDUO_AT_REST] * 1000, ends[CEDUO_LEFT_SLOPE] * 1000);
}

static void say_lights(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
    if (ceduo_too_few_arrivals(&r->bare.arrivals[control])) { /* why stands at the head of the page */
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE, _("Contact, free run and energy cannot be assessed."));
        return;
    }
    for (size_t i = 0; i < 3; i++)
        ceduo_words_test(ceduo_page_add(page, CEDUO_PAGE_SENTENCE), r, option, control, i);
    if (r->options[option].others[control].known && r->options[option].others[control].stems)
        ceduo_words_other(ceduo_page_add(page, CEDUO_PAGE_SENTENCE), r, option, control);
}

/* ---- belts, by the index ---- */

static void add_belts(struct ceduo_page *page, const struct ceduo_scene *scene, const struct ceduo_option *o,
                      const struct ceduo_option_result *found)
{
    static const struct ceduo_page_column columns[] = {
        {N_("stand"), 10, 2, CEDUO_FILLS},
        {NP_("head", "m|from, to, m"), 1, 1, CEDUO_FITS | CEDUO_DROPPED(4)},
        {N_("ADC m|ADC, m"), -5, 1, CEDUO_FITS},
        {NULL, -5, 1, CEDUO_FITS},
        {NP_("head", "free run|chance of a free run"), -7, 1, CEDUO_FITS | CEDUO_DROPPED(7)},
        {NP_("head", "kJ|energy taken, kJ"), -5, 1, CEDUO_FITS | CEDUO_DROPPED(8)},
        {N_("kJ/100 m|taken per 100 m, kJ"), -5, 1, CEDUO_FITS | CEDUO_DROPPED(9)}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *head = ceduo_page_head(page);
    ceduo_text_format(&head->text, "<%s m", SHORTEST(scene->simulation.threshold));
    ceduo_text_format(&head->written, _("below %s m"), SHORTEST(scene->simulation.threshold));
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_belt *b = &o->belts[i];
        const struct ceduo_stand_result *s = &found->stands[i];
        LOCAL_TEXT(name);
        ceduo_plot_belt_name(&name, b);
        ceduo_page_cell_role(page, CEDUO_ROLE_BELT, ceduo_text_string(&name));
        ceduo_page_cell_format(page, "%s\xe2\x80\x93%s", SHORTEST(b->from_given), SHORTEST(b->to_given));
        ceduo_page_cell_format(page, "%s", BESIDE(s->adc_m, 3, scene->simulation.threshold));
        ceduo_page_light(page, s->passes_threshold ? CEDUO_PASS : CEDUO_FAIL);
        ceduo_page_free_run(page, s->free_run_probability);
        ceduo_page_number(page, s->dissipated * J_TO_KJ, 3);
        ceduo_page_number(page, s->per_100m * J_TO_KJ, 3);
    }
}

/* Length of the ground between two places, m. */
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

/* The ADC by the other rules, of each belt, and how long the threshold, which is of the map, is on its ground. */
static void say_other_forms(struct ceduo_page *page, const struct ceduo_scene *scene, const struct ceduo_option *o,
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
        for (enum ceduo_rule rule = CEDUO_GSTEIGER_STOOLS; rule <= CEDUO_CROFTON; rule++)
            if (rule != s->rule) {
                ceduo_text_format(line, "%s %s %s m", between, ceduo_words_law(ceduo_rule_words.names[rule]),
                                  WRITTEN(ceduo_adc_value(&s->adc, rule), 3));
                between = ",";
            }
        const struct ceduo_belt *b = &o->belts[i];
        ceduo_text_format(line, _("; %s m of the map are %s m along the ground"), SHORTEST(threshold),
                          WRITTEN(threshold * ground_length(&scene->slope, b->from, b->to) / (b->to - b->from), 2));
    }
}

static void say_residual(struct ceduo_page *page, const struct ceduo_result *r, size_t option, size_t control)
{
#define SAME(value) WRITTEN(value, (value) > 0 ? decimals + (int)floor(log10(value)) + 1 : 1)
    const struct ceduo_index *index = &r->options[option].controls[control];
    double mean = ceduo_measured(CEDUO_MEAN_KJ, &r->bare.arrivals[control]).value, taken = index->dissipated * J_TO_KJ;
    double left = index->residual * J_TO_KJ;
    int decimals = mean > 0 ? (int)fmax(0, 3 - floor(log10(mean))) : 1; /* of all three, so that what is written is true */
    LOCAL_TEXT(rest);
    if (index->exhausted)
        ceduo_text_append(&rest, _("nothing is left on average, some rocks still pass"));
    else
        ceduo_text_format(&rest, _("%s kJ are left"), SAME(left));
    if (index->length > 0 && mean > 0)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("By the index stems could absorb %s kJ (Eq. 4), %s kJ per 100 m; of %s kJ %s (Eq. 5)."), SAME(taken),
                        WRITTEN(index->per_100m * J_TO_KJ, 3), SAME(mean), rest.bytes);
    if (!isnan(index->measured))
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE, _("Measured here on one rock: %s kJ (%g m/s). One rock is no validation."),
                        WRITTEN(index->measured * J_TO_KJ, 3), r->scene->controls[control].measured_speed);
}

/* ---- blocks of other sizes ---- */

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
                    _("Blocks of other sizes, same shape and release, of 1000 to %s m (> this scene's):"),
                    SHORTEST(c->x_given));
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_page_limit(ceduo_page_head(page), c);
    bool left_out = false;
    for (size_t i = 0; i < CEDUO_SIZES; i++) {
        const struct ceduo_size_result *b = &blocks[i];
        if (!b->own && b->volume < 2 * own && 2 * b->volume > own)
            continue; /* less than an octave apart the order would be chance: the scene's own stands for it */
        ceduo_page_cell_format(page, "%s", b->own ? "  >" : "");
        ceduo_page_number(page, b->volume, 3);
        ceduo_page_number(page, b->mass, 3);
        ceduo_page_number(page, b->diameter, 3);
        ceduo_page_number(page, b->adc, 3);
        ceduo_page_number(page, b->contacts, 3);
        ceduo_page_cell_format(page, "%s",
                               INTERVAL(ceduo_measure_exceeding(c, ceduo_released(&b->arrivals) > 0 ? &b->arrivals : NULL)));
        left_out |= ceduo_released(&b->arrivals) == 0;
    }
    if (left_out && r->scene->simulation.contact_model != CEDUO_INDEX && ceduo_result_rocks(r) > 0)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("A size with a dash was skipped: its rocks meet too many stems to be simulated here."));
}

/* ---- what an office expects: percentiles of speed, energy and height with their intervals, and design values ---- */

/* Heights below a metre have no third digit, those below a decimetre no second. */
#define SHOWN(value) WRITTEN(value, (value) < 0.1 ? 1 : (value) < 1 ? 2 : 3)

static void add_percentile(struct ceduo_page *page, double value, double lo, double hi)
{
    struct ceduo_page_cell *both = ceduo_page_cell(page);
    struct text *cell = &both->text;
    ceduo_text_append(cell, SHOWN(value));
    if (isnan(value))
        return;
    ceduo_text_append(&both->shorter, SHOWN(value)); /* where the interval has no room */
    if (!isnan(lo) && !isnan(hi))
        ceduo_text_format(cell, " (%s\xe2\x80\x93%s)", SHOWN(lo), SHOWN(hi));
    else if (!isnan(lo))
        ceduo_text_format(cell, " (> %s)", SHOWN(lo));
    else if (!isnan(hi))
        ceduo_text_format(cell, " (< %s)", SHOWN(hi));
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
    static const struct ceduo_page_column columns[] = {{NULL, 22, 4, CEDUO_WHOLE},
                                                       {N_("50 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("95 %"), -18, 0, CEDUO_WHOLE},
                                                       {N_("99 %"), -18, 0, CEDUO_WHOLE}};
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
                          (unsigned long long)ceduo_reached(a), (unsigned long long)ceduo_released(a));
        add_percentiles(page, _("speed, m/s"), ceduo_spread(CEDUO_SPREAD_SPEED, a), 1);
        add_percentiles(page, _("energy, kJ"), ceduo_spread(CEDUO_SPREAD_ENERGY, a), J_TO_KJ);
        add_percentiles(page, _("underside, m up"), ceduo_spread(CEDUO_SPREAD_HEIGHT, a), 1);
    }
}

/* ---- design values ---- */

/* The factors of speed and energy of UNI 11211-4, 1.02 where it was done well, otherwise 1.10. */
#define FACTOR(good) ((good) ? 1.02 : 1.10)

/* No factor of the height was found in a text that could be opened: it is printed without one, and that is said. The height is
 * that of the blocks' tops: a work as high as their undersides would stop none. */
void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_design_values *d = &r->scene->design;
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control), *bare = &r->bare.arrivals[control];
    bool calibrated = ceduo_notes_print(report->file->notes, "calibrated", "slope");
    double survey = FACTOR(d->survey == CEDUO_SURVEY_GOOD), blocks = FACTOR(d->blocks == CEDUO_SURVEY_GOOD);
    double model = FACTOR(calibrated), speed = survey * model, energy = speed * speed * blocks;
    if (d->survey < 0 || d->blocks < 0 || ceduo_reached(bare) == 0)
        return;
    for (const struct ceduo_arrivals *a = ceduo_reached(wooded) > 0 ? wooded : bare; a; a = a == bare ? NULL : bare)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("Design values of UNI 11211-4, %s: speed %s m/s, energy %s kJ, height of the block's top %s m."),
                        a == bare ? _("without forest") : _("with the forest of this option"),
                        WRITTEN(ceduo_spread(CEDUO_SPREAD_SPEED, a)->p95 * speed, 3),
                        WRITTEN(ceduo_measured(CEDUO_P95_KJ, a).value * energy, 3),
                        SHOWN(ceduo_measured(CEDUO_P95_TOP, a).value));
    ceduo_page_para(
        page, CEDUO_PAGE_DETAIL,
        _("Speed: 95th percentile times %.2f for the survey of the ground and %.2f for the model, %s. Energy: 95th "
          "percentile times the square of both and %.2f for the survey of the blocks. Height: 95th percentile of the "
          "block's top, its underside and its mean diameter, without a factor."),
        survey, model, calibrated ? _("fitted to observations") : _("not fitted here"), blocks);
}

/* ---- an option ---- */

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
    bool whole = page->width >= CEDUO_PAGE_WIDTH; /* a pane stands beside pictures and a column that say the rest */
    if (option->belts_count > 0 && r->scene->controls_count > 0)
        add_belts(page, r->scene, option, &r->options[i]);
    for (size_t k = 0; k < r->scene->controls_count; k++) {
        add_place(page, report, k);
        add_arrivals(page, report, i, k, bare);
        say_lights(page, r, i, k);
        if (whole && r->bare.rocks > 0)
            ceduo_page_percentiles(page, r, i, k, bare);
        ceduo_page_design(page, report, i, k);
        if (k == 0)
            say_other_forms(page, r->scene, option, &r->options[i]);
        say_residual(page, r, i, k);
    }
    if (whole && report->blocks && !report->years)
        add_sizes(page, r, &report->blocks[i * CEDUO_SIZES]);
    if (whole && report->years)
        ceduo_page_years(page, report, i);
    ceduo_page_stand_warnings(page, r, i);
    ceduo_page_stand_rules(page, r, i, true);
}

/* ---- notes ---- */

static bool is_shown(const struct ceduo_report *report, const struct source_note *note)
{
    return strcmp(note->kind, "assumed") == 0 && (report->years || !ceduo_note_years(note));
}

/* The notes are kept last first. */
static void add_assumed(struct ceduo_page *page, const struct ceduo_report *report, const struct source_note *note, bool places)
{
    if (!note)
        return;
    add_assumed(page, report, note->before, places);
    const struct source_note *first_same = NULL; /* in the files, that is, the last in the list: said there, how often */
    size_t times = 0;
    for (const struct source_note *n = report->file->notes; n; n = n->before)
        if (strcmp(n->kind, "assumed") == 0 && strcmp(n->text, note->text) == 0) {
            times++;
            first_same = n;
        }
    if (!is_shown(report, note) || first_same != note)
        return;
    const char *said = ceduo_in_language(note->text, note->text_it);
    LOCAL_TEXT(where);
    if (!places) {
        ceduo_page_once(page, CEDUO_PAGE_ITEM, "%.*s", (int)strcspn(said, ";"), said); /* its first clause */
        return;
    }
    const struct ceduo_scene *scene = report->result->scene;
    const char *dot = strncmp(note->path, "options[", 8) == 0 ? strchr(note->path, '.') : NULL;
    size_t option = dot ? strtoul(note->path + 8, NULL, 10) : SIZE_MAX;
    ceduo_shown_path(dot ? dot + 1 : note->path, &where);
    if (option < scene->options_count)
        ceduo_text_append_joined(&where, ", ", "%s", scene->options[option].name);
    const char *place = where.length > 0 ? where.bytes : _("the scene");
    if (times > 1)
        ceduo_page_para(page, CEDUO_PAGE_ITEM, ngettext("%s (%s and %zu more)", "%s (%s and %zu more)", times - 1), said, place,
                        times - 1);
    else
        ceduo_page_para(page, CEDUO_PAGE_ITEM, "%s (%s)", said, place);
}

void ceduo_page_assumed(struct ceduo_page *page, const struct ceduo_report *report, bool places)
{
    add_assumed(page, report, report->file->notes, places);
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
    while (note && !is_shown(report, note))
        note = note->before;
    if (!note)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("* Assumed, not measured:"));
    ceduo_page_assumed(page, report, true);
}

/* ---- the page ---- */

static void add_whole(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_scene *scene = report->result->scene;
    ceduo_page_para(page, CEDUO_PAGE_TITLE, "%s", ceduo_in_language(scene->title, scene->title_it));
    ceduo_page_facts(page, report);
    ceduo_page_question(page, report->result);
    ceduo_page_answer(page, report);
    ceduo_page_sure(page, report);
    ceduo_page_over(page, report);
    if (scene->options_count > 1) /* what they share */
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", _("without forest"));
    for (size_t k = 0; scene->options_count > 1 && k < scene->controls_count; k++) {
        const struct ceduo_subject bare = ceduo_subject_find(report, SIZE_MAX, k);
        add_place(page, report, k);
        ceduo_page_arrivals(page, &bare, CEDUO_LINES_WHOLE, true);
        if (report->result->bare.rocks > 0)
            ceduo_page_percentiles(page, report->result, SIZE_MAX, k, true);
    }
    for (size_t i = 0; i < scene->options_count; i++) {
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", scene->options[i].name);
        ceduo_page_option(page, report, i, scene->options_count == 1);
    }
    if (scene->options_count > 1 && scene->controls_count > 0)
        ceduo_page_comparison(page, report);
    for (size_t c = 0; c < scene->controls_count; c++)
        ceduo_page_hazard(page, report, c, c == 0);
    if (report->years && scene->options_count > 1 && scene->controls_count > 0)
        ceduo_page_years_beside(page, report);
    ceduo_page_notes(page, report);
}

void ceduo_report_page(struct text *text, const struct ceduo_report *report, bool whole, bool plain)
{
    LOCAL_PAGE(page, CEDUO_PAGE_WIDTH);
    (whole ? add_whole : ceduo_page_short)(&page, report);
    ceduo_page_print(text, &page, plain);
}
