/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table of options: every page, pane and picture shows some of its columns. A row is an option, a year of an option, or the
 * slope without forest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "core/runs/hazard.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "core/runs/year_runs.h"
#include "page_parts.h"
#include "plot.h"
#include "scene/choices.h"
#include "scene/derived.h"
#include "scene/stand.h"
#include "study/verdict.h"

/* Name, head, width, flags. BAR draws the column after it. */
#define COLUMN_LIST(X)                                                                                                         \
    X(NUMBER, "", -1, COL_SHRINK)                                                                                              \
    X(NAME, N_("option"), 10, COL_GROW)                                                                                        \
    X(BAR, "", 6, COL_GROW | COL_PRIORITY(5))                                                                                  \
    X(TODAY, NULL, -5, COL_SHRINK)                                                                                             \
    X(RANGE, NP_("head", "range"), -5, COL_SHRINK | COL_PRIORITY(5))                                                           \
    X(TO_FIRST, NP_("head", "to first|difference to the first option"), -8, COL_SHRINK)                                        \
    X(ENERGY, NP_("light", "E|test of energy"), 1, COL_SHRINK | COL_PRIORITY(6))                                               \
    X(MEAN_KJ, NP_("head", "mean kJ|mean energy of those that arrive, kJ"), -5, COL_SHRINK)                                    \
    X(ADC, N_("ADC m|ADC of the worst belt, m"), -5, COL_SHRINK)                                                               \
    X(CONTACT, NP_("light", "C|test of contact"), 1, COL_SHRINK | COL_PRIORITY(6))                                             \
    X(FREE_RUN_SHARE, NP_("head", "free run|chance of a free run"), -7, COL_SHRINK)                                            \
    X(FREE_RUN, NP_("light", "F|test of free runs"), 1, COL_SHRINK | COL_PRIORITY(6))                                          \
    X(PER_100M, N_("kJ/100 m|taken per 100 m, kJ"), -5, COL_SHRINK)                                                            \
    X(RESIDUAL, NP_("head", "left kJ|energy left, kJ"), -5, COL_SHRINK)                                                        \
    X(MEAN, N_("mean"), -5, COL_SHRINK | COL_PRIORITY(1))                                                                      \
    X(MEAN_RANGE, NP_("head", "range"), -5, COL_SHRINK | COL_PRIORITY(5))                                                      \
    X(WORST, NP_("head", "worst|in the worst year (which)"), -5, COL_SHRINK | COL_PRIORITY(4))                                 \
    X(WORST_ADC, NP_("head", "worst ADC m|ADC in the worst year, m (which)"), -5, COL_SHRINK | COL_PRIORITY(4))                \
    X(FAIL, NULL, -4, COL_SHRINK | COL_PRIORITY(2))                                                                            \
    X(FAIL_CONTACT, NP_("head", "fail C|years in which contact fails"), -4, COL_SHRINK | COL_PRIORITY(2))                      \
    X(FAIL_FREE_RUN, NP_("head", "fail F|years in which free runs fail"), -4, COL_SHRINK | COL_PRIORITY(2))                    \
    X(FENCE, NP_("head", "fence|smallest fence that is enough: class, height"), -6, COL_SHRINK | COL_PRIORITY(4))              \
    X(FELLED, NP_("head", "m3/y|felled, m3 per ha and year"), -4, COL_SHRINK | COL_PRIORITY(3))                                \
    X(ROTATION, NP_("head", "rotation|mean over a whole rotation"), -5, COL_SHRINK | COL_PRIORITY(5))                          \
    X(STANDING, NP_("head", "m3/ha|standing, m3 per ha"), -4, COL_SHRINK)                                                      \
    X(MARK, "", 1, COL_SHRINK | COL_PRIORITY(8))                                                                               \
    X(YEARS, "", 1, COL_SHRINK | COL_PRIORITY(9))                                                                              \
    X(LAW, NP_("head", "law of the scene"), 7, COL_SHRINK)                                                                     \
    X(ALT_LAW, NP_("head", "other law"), 7, COL_SHRINK)                                                                        \
    X(ALT_SHARE, N_("of 1000"), -5, COL_SHRINK)                                                                                \
    X(ALT_KJ, NP_("head", "mean kJ|mean energy of those that arrive, kJ"), -5, COL_SHRINK)                                     \
    X(PERIOD, N_("today"), -5, COL_SHRINK)                                                                                     \
    X(WEAK, NP_("head", "% weak"), -6, COL_SHRINK)                                                                             \
    X(MEDIUM, NP_("head", "% medium"), -6, COL_SHRINK)                                                                         \
    X(STRONG, NP_("head", "% strong"), -6, COL_SHRINK)                                                                         \
    X(RETURN_1, NULL, -17, 0)                                                                                                  \
    X(RETURN_2, NULL, -17, 0)                                                                                                  \
    X(RETURN_3, NULL, -17, 0)

enum column {
    END,
#define X(NAME_, head, width, flags) NAME_,
    COLUMN_LIST(X)
#undef X
        COLUMNS
};

static const struct ceduo_page_column columns[COLUMNS] = {
#define X(NAME_, head, width, flags) [NAME_] = {head, width, NAME_ == NAME ? 2 : 1, flags},
    COLUMN_LIST(X)
#undef X
};

#define COLUMNS_SHOWN 16

/* Columns of each table, by the index and with rocks through the forest. Columns that are empty in all rows are dropped. */
static const enum column column_sets[CEDUO_OPTIONS_KINDS][2][COLUMNS_SHOWN] = {
    [CEDUO_OPTIONS_SHORT] = {{NAME, ADC, CONTACT, FREE_RUN_SHARE, FREE_RUN, PER_100M, RESIDUAL},
                             {NAME, TODAY, RANGE, MEAN, MEAN_RANGE, WORST, FAIL, FENCE, ADC, FELLED}},
    [CEDUO_OPTIONS_TODAY] = {{NAME, ADC, CONTACT, FREE_RUN_SHARE, FREE_RUN, PER_100M, RESIDUAL},
                             {NAME, TODAY, ENERGY, TO_FIRST, ADC, CONTACT, FREE_RUN_SHARE, FREE_RUN}},
    [CEDUO_OPTIONS_YEARS] = {{NAME, WORST_ADC, FAIL_CONTACT, FAIL_FREE_RUN, FELLED, STANDING},
                             {NAME, MEAN, ROTATION, WORST, FAIL, FAIL_CONTACT, FAIL_FREE_RUN, FELLED, STANDING}},
    [CEDUO_OPTIONS_PANE] = {{NUMBER, NAME, ADC, PER_100M, WORST_ADC, FAIL_CONTACT, FELLED, CONTACT, FREE_RUN},
                            {NUMBER, NAME, TODAY, RANGE, MEAN, MEAN_RANGE, WORST, FAIL, FENCE, FELLED, MARK, ENERGY, CONTACT,
                             FREE_RUN, YEARS}},
    [CEDUO_OPTIONS_BARS] = {{NAME, BAR, ADC, CONTACT, BAR, PER_100M, BAR, RESIDUAL},
                            {NAME, BAR, TODAY, ENERGY, BAR, MEAN_KJ, BAR, ADC, CONTACT}},
    [CEDUO_OPTIONS_LAWS] = {{NAME}, {NAME, LAW, TODAY, MEAN_KJ, ALT_LAW, ALT_SHARE, ALT_KJ}},
    [CEDUO_OPTIONS_RATES] = {{NAME, PERIOD, WEAK, MEDIUM, STRONG}, {NAME, PERIOD, WEAK, MEDIUM, STRONG}},
    [CEDUO_OPTIONS_RETURNS] = {{NAME, RETURN_1, RETURN_2, RETURN_3}, {NAME, RETURN_1, RETURN_2, RETURN_3}},
    [CEDUO_OPTIONS_OF_YEARS] = {{NAME, ADC, CONTACT, FREE_RUN_SHARE, FREE_RUN, PER_100M},
                                {NAME, TODAY, ENERGY, MEAN_KJ, ADC, CONTACT, FREE_RUN_SHARE, FREE_RUN, PER_100M}},
    [CEDUO_OPTIONS_REST] = {
        {NAME, WORST_ADC, FAIL_CONTACT, FAIL_FREE_RUN, FELLED, STANDING},
        {NAME, ENERGY, TO_FIRST, CONTACT, FREE_RUN_SHARE, FREE_RUN, FAIL_CONTACT, FAIL_FREE_RUN, ROTATION, STANDING}}};

/* ---- cells ---- */

#define YEARS_MAX 26 /* columns of the sparkline of years */
#define PENDING   "\xe2\x80\xa6"

/* True if options are judged by return periods, because the scene has blocks. */
static bool has_rates(const struct ceduo_report *report)
{
    return report->result->scene->blocks_count > 0 && report->verdict && report->verdict->accepted;
}

__attribute__((format(printf, 2, 3))) static const char *format_to(char buffer[CEDUO_WORDS_SIZE], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(buffer, CEDUO_WORDS_SIZE, format, args);
    va_end(args);
    return buffer;
}

/* Write a sparkline: a character per year, or per group of years with the maximum; its height is the judged share. */
static const char *format_sparkline(const struct ceduo_subject *s, char buffer[CEDUO_WORDS_SIZE])
{
    const struct ceduo_years *years = s->report->years_ahead ? s->report->years_ahead[s->option] : NULL;
    int n = years ? (int)years->count : 0, blocks = n < YEARS_MAX ? n : YEARS_MAX;
    size_t length = 0;
    for (int x = 0; x < blocks; x++) {
        double max = 0;
        for (int k = x * n / blocks; k < (x + 1) * n / blocks; k++)
            if (years->years[k].wooded.rocks > 0)
                max = fmax(max, ceduo_measure_exceeding(s->place, &years->years[k].wooded.arrivals[s->control]).value);
        uint32_t eighths = (uint32_t)fmin(8, ceil(max * 8 / 1000)); /* U+2581 … U+2588 */
        length += ceduo_utf8_encode(eighths > 0 ? 0x2580 + eighths : ' ', buffer + length);
    }
    buffer[length] = '\0';
    return buffer;
}

static const char *format_difference(const struct ceduo_subject *s, char buffer[CEDUO_WORDS_SIZE])
{
    const struct ceduo_estimate e = ceduo_share_to_first(s->report->result, s->option);
    if (ceduo_pairs_are_equal(&e))
        return format_to(buffer, "< %.0f", ceil(e.hi * 1000));
    if (s->option == 0 || isnan(e.mean))
        return "-";
    if (e.mean == 0 && e.se == 0)
        return _("the same");
    return format_to(buffer, isnan(e.se) ? "%+.0f" : "%+.0f\xc2\xb1%.0f", e.mean * 1000, ceil(CEDUO_Z95 * e.se * 1000));
}

/* Return "best" if an option is clearly better than all others over the years, "worst" if it is clearly worse. */
static const char *choose_mark(const struct ceduo_verdict *v, size_t i)
{
    bool known = v->rotation.known && !v->rotation.uneven && v->rotation.rivals + 1 < v->n, worst = known;
    for (size_t k = 0; k < v->n; k++)
        worst &=
            k == i || v->choices[k].mean.mean + v->choices[k].mean.half < v->choices[i].mean.mean - v->choices[i].mean.half;
    return known && i == v->rotation.best && v->rotation.rivals == 0 ? _("best") : worst ? _("worst") : "";
}

/* Return the law of the option's stands, or "several". */
static const char *find_law(const struct ceduo_option *option)
{
    const char *law = NULL;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        const char *belt_law = ceduo_stand_is_bare(stand) ? law : ceduo_words_law(ceduo_energy_words.names[stand->energy]);
        if (law && law != belt_law)
            return _("several");
        law = belt_law;
    }
    return law ? law : "-";
}

/* Return the figure of a column for its bar; NaN: unknown. */
static double get_value(enum column column, const struct ceduo_subject *s)
{
    const struct ceduo_index none = {.worst_adc = NAN, .per_100m = NAN}, *index = s->index ? s->index : &none;
    const struct ceduo_yield *yield = s->choice ? &s->choice->yield : NULL;
    const double values[COLUMNS] = {
        [TODAY] = s->today.value,
        [ADC] = index->worst_adc,
        [MEAN_KJ] = ceduo_measure_figure(CEDUO_MEAN_KJ, s->wooded).value,
        [ALT_KJ] = ceduo_measure_figure(CEDUO_MEAN_KJ, s->alternative ? &s->alternative->arrivals : NULL).value,
        [PER_100M] = index->per_100m * J_TO_KJ,
        [RESIDUAL] = s->index ? index->residual * J_TO_KJ : ceduo_measure_figure(CEDUO_MEAN_KJ, s->bare).value,
        [FELLED] = yield ? yield->cut_per_year : NAN,
        [STANDING] = yield ? yield->standing : NAN};
    return values[column];
}

static enum ceduo_light get_light(enum column column, const struct ceduo_subject *s)
{
    bool contact = column == ADC || column == CONTACT, energy = column == TODAY || column == ENERGY;
    return !s->index            ? CEDUO_LIGHT_UNKNOWN
           : contact            ? s->index->contact
           : energy             ? s->index->energy
           : column == FREE_RUN ? s->index->free_run
                                : CEDUO_LIGHT_UNKNOWN;
}

/* Return a share with its error, or the return period if `rates`. */
static const char *format_share(struct ceduo_measure share, struct ceduo_estimate rate, bool rates, const char *unknown,
                                char buffer[CEDUO_WORDS_SIZE])
{
    if (isnan(rates ? rate.mean : share.value))
        return unknown;
    return rates ? ceduo_words_return_period_range(rate, buffer) : ceduo_measure_error(share, "", buffer);
}

/* Return class and height of the smallest fence that is enough, in all years if they are known. */
static const char *format_fence(const struct ceduo_subject *s, char buffer[CEDUO_WORDS_SIZE])
{
    const struct ceduo_fence_arrivals *f = ceduo_fence_find(s->index ? s->wooded : s->bare);
    const struct ceduo_fence_years *years = s->index ? ceduo_report_fence_years(s->report, s->option, s->control) : NULL;
    if (!f)
        return "";
    const struct ceduo_fence_choice *c = ceduo_fence_smallest(years ? years->enough : f->enough);
    return c ? format_to(buffer, "%d, %u m", c->class_index, c->height) : _("none");
}

static const char *format_cell(enum column column, const struct ceduo_subject *s, char buffer[CEDUO_WORDS_SIZE])
{
    const struct ceduo_choice *c = s->choice && s->choice->last_summary->years > 0 ? s->choice : NULL;
    const struct ceduo_hazard *h = ceduo_hazard_find(s->wooded);
    const char *unknown = s->report->busy && !c && s->index ? PENDING : "-";
    bool rates = has_rates(s->report), judged = c && !c->last_summary->nothing;
    double remaining = h && column >= WEAK && column <= STRONG ? h->intensity[column - WEAK].remaining_share : NAN;
    switch (column) {
    case NUMBER:
        return s->report->result->scene->options_count > 1 ? format_to(buffer, "%zu", s->option + 1) : "";
    case TODAY:
        return rates && s->wooded ? ceduo_words_return_period(ceduo_judged_rate(s->wooded), buffer)
                                  : format_share(s->today, CEDUO_NO_ESTIMATE, false, unknown, buffer);
    case PERIOD:
        return format_share(s->today, ceduo_judged_rate(s->wooded), true, unknown, buffer);
    case RANGE:
        return isnan(s->today.p5) || !isnan(s->mean.p5) || rates ? "" : ceduo_measure_plausible_range(s->today, buffer);
    case MEAN:
        return format_share(s->mean, c ? s->outcome.rate : CEDUO_NO_ESTIMATE, rates, unknown, buffer);
    case MEAN_RANGE:
        return isnan(s->mean.p5) || rates ? "" : ceduo_measure_plausible_range(s->mean, buffer);
    case WORST:
        return !c || c->last_summary->simulated == 0
                   ? unknown
                   : format_to(buffer, "%s (%u)",
                               rates ? SIG(1 / (c->worst.mean * ceduo_hazard_find(s->bare)->per_year), 2)
                                     : SIG(1000 * c->worst.mean, 0),
                               c->last_summary->worst_year);
    case ROTATION:
        return c ? ceduo_measure_error(ceduo_measure_share(c->rotation), "", buffer) : "-";
    case WORST_ADC:
        return c ? format_to(buffer, "%s (%u)", SIG(c->worst.mean, 3), c->last_summary->worst_year) : unknown;
    case FAIL:
        if (rates)
            return ceduo_words_judgement_mark(s->outcome.answer, buffer);
        return c && c->energy_known ? format_to(buffer, "%zu/%zu", c->last_summary->unprotected_energy, c->last_summary->years)
                                    : unknown;
    case FENCE:
        return format_fence(s, buffer);
    case FAIL_CONTACT:
        return judged ? format_to(buffer, "%zu/%zu", c->last_summary->unprotected_contact, c->last_summary->years) : unknown;
    case FAIL_FREE_RUN:
        return judged ? format_to(buffer, "%zu/%zu", c->last_summary->unprotected_free_run, c->last_summary->years) : unknown;
    case ADC:
        return ceduo_words_against_limit(s->index->worst_adc, 3, s->report->result->scene->simulation.threshold, buffer);
    case FREE_RUN_SHARE:
        return format_to(buffer, "%s %%", PERCENT_VS_LIMIT(s->index->worst_free_run, CEDUO_FREE_RUN_MAX));
    case ENERGY:
    case CONTACT:
    case FREE_RUN:
        return ceduo_plot_light_mark(get_light(column, s));
    case TO_FIRST:
        return format_difference(s, buffer);
    case MARK:
        return s->choice ? choose_mark(s->report->verdict, s->option) : "";
    case YEARS:
        return format_sparkline(s, buffer);
    case LAW:
        return find_law(&s->report->result->scene->options[s->option]);
    case ALT_LAW:
        return s->alternative ? ceduo_words_law(ceduo_energy_words.names[s->alternative->model]) : "-";
    case ALT_SHARE:
        return s->alternative ? ceduo_measure_value(ceduo_measure_exceeding(s->place, &s->alternative->arrivals), buffer) : "-";
    case WEAK:
    case MEDIUM:
    case STRONG:
        return isnan(remaining) ? _("none") : ceduo_words_sig(s->index ? 100 * remaining : 100, s->index ? 2 : 3, buffer);
    case RESIDUAL:
        if (s->index && s->index->exhausted)
            return _("used up");
        return ceduo_words_sig(get_value(column, s), 3, buffer);
    default:
        return ceduo_words_sig(get_value(column, s), column == FELLED ? 2 : 3, buffer);
    }
}

/* ---- bars ---- */

struct bar_scale {
    double lo, hi, limit; /* lo 0: linear; limit NaN: none */
};

static struct bar_scale make_scale(enum column column, const struct ceduo_subject *s)
{
    const struct ceduo_scene *scene = s->report->result->scene;
    double threshold = scene->simulation.threshold, accepted = ceduo_words_accepted(s->place);
    if (column == ADC)
        return (struct bar_scale){threshold / 10, threshold * 2, threshold};
    if (column == TODAY)
        return (struct bar_scale){0, 1000, isnan(accepted) ? NAN : 1000 * ceduo_exceed_limit(scene, s->place)};
    return (struct bar_scale){0, 0, column == PER_100M ? NAN : accepted};
}

static void widen_scale(struct bar_scale *scale, double value)
{
    bool logarithmic = scale->lo > 0;
    if (logarithmic && isfinite(value) && value > 0)
        scale->lo = fmin(scale->lo, value / 1.5);
    if (!logarithmic || isfinite(value))
        scale->hi = fmax(scale->hi, logarithmic ? value * 1.1 : value);
}

static void add_bar(struct ceduo_page *page, enum column column, const struct ceduo_subject *s, double limit)
{
    double value = get_value(column, s);
    enum ceduo_light light = get_light(column, s);
    if (column == RESIDUAL && s->index && !isnan(limit))
        light = value <= limit ? CEDUO_LIGHT_PASS : CEDUO_LIGHT_FAIL;
    ceduo_page_bar(page, value,
                   !s->index                      ? CEDUO_ROLE_BARE
                   : light == CEDUO_LIGHT_UNKNOWN ? CEDUO_ROLE_FOREST
                                                  : ceduo_plot_light_role(light))
        ->limit = limit;
}

/* ---- tables ---- */

/* Append a row with the name of its option or year, or "without forest". */
static void add_option_row(struct ceduo_page *page, const enum column *set, const struct ceduo_subject *s,
                           const struct bar_scale *scales, enum ceduo_role role, const char *name)
{
    for (size_t i = 0; set[i]; i++) {
        enum column column = set[i];
        char buffer[CEDUO_WORDS_SIZE] = "";
        if (column == NAME)
            ceduo_page_cell_role(page, role, name);
        else if (column == BAR)
            add_bar(page, set[i + 1], s, scales[i].limit);
        else if (column >= RETURN_1)
            ceduo_page_return(page, ceduo_hazard_find(s->wooded), (size_t)(1 + column - RETURN_1));
        else if (!s->index &&
                 !(column == TODAY || column == MEAN_KJ || column == RESIDUAL || column == FENCE || column >= PERIOD))
            ceduo_page_cell_format(page, "%s", "");
        else
            ceduo_page_cell_role(page,
                                 column == ENERGY || column == CONTACT || column == FREE_RUN
                                     ? ceduo_plot_light_role(get_light(column, s))
                                 : column == MARK  ? CEDUO_ROLE_TITLE
                                 : column == YEARS ? CEDUO_ROLE_MEAN
                                                   : CEDUO_ROLE_BLANK,
                                 format_cell(column, s, buffer));
    }
}

static void begin_table(struct ceduo_page *page, const struct ceduo_report *report, size_t control, const enum column *set)
{
    struct ceduo_page_column chosen[COLUMNS_SHOWN] = {0};
    const struct ceduo_control *c = &report->result->scene->controls[control];
    size_t n = 0;
    bool years_ahead = false;
    for (; set[n]; n++) {
        chosen[n] = columns[set[n]];
        chosen[n].gap = n > 0 && set[n] == NAME ? 1 : chosen[n].gap; /* after its number */
        years_ahead |= set[n] == MEAN;
    }
    ceduo_page_table(page, chosen, n);
    for (size_t i = 0; i < n; i++) {
        struct ceduo_page_cell *head = &page->last->cells[i];
        if (set[i] == TODAY && years_ahead)
            ceduo_text_append(&head->text, _("today"));
        else if (set[i] == TODAY)
            ceduo_page_limit(head, c);
        else if (set[i] == FAIL)
            ceduo_text_append(&head->text, has_rates(report) ? _("accepted") : _("fail"));
        else if (set[i] >= RETURN_1)
            ceduo_text_format(&head->text, _("%u years"), ceduo_return_years[1 + set[i] - RETURN_1]);
    }
}

void ceduo_page_options(struct ceduo_page *page, const struct ceduo_report *report, enum ceduo_options kind, size_t control,
                        size_t cursor, size_t first, size_t rows)
{
    const struct ceduo_result *r = report->result;
    const enum column *set = column_sets[kind][r->wooded];
    struct bar_scale scales[COLUMNS_SHOWN];
    struct ceduo_subject bare = ceduo_subject_find(report, SIZE_MAX, control);
    size_t end = rows < r->scene->options_count - first ? first + rows : r->scene->options_count;
    begin_table(page, report, control, set);
    for (size_t k = 0; set[k]; k++)
        scales[k] = make_scale(set[k + 1], &bare);
    for (size_t i = 0; i <= r->scene->options_count; i++) {
        struct ceduo_subject s = i < r->scene->options_count ? ceduo_subject_find(report, i, control) : bare;
        for (size_t k = 0; set[k]; k++)
            widen_scale(&scales[k], get_value(set[k + 1], &s));
        if (s.index && i >= first && i < end && (kind != CEDUO_OPTIONS_LAWS || s.wooded))
            add_option_row(page, set, &s, scales, i == cursor ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, r->scene->options[i].name);
    }
    if (kind != CEDUO_OPTIONS_TODAY && kind != CEDUO_OPTIONS_YEARS && kind != CEDUO_OPTIONS_REST &&
        kind != CEDUO_OPTIONS_PANE && kind != CEDUO_OPTIONS_LAWS)
        add_option_row(page, set, &bare, scales, CEDUO_ROLE_TEXT, _("without forest"));
    for (size_t k = 0; set[k]; k++)
        if (set[k] == BAR) { /* the limit is the head of its bars */
            struct bar_scale *scale = &scales[k];
            if (scale->limit <= 2 * scale->hi)
                scale->hi = fmax(scale->hi, scale->limit);
            if (!isnan(scale->limit))
                ceduo_text_format(&page->last->cells[k].text, "\xe2\x94\x82 %s", SIG_TRIMMED(scale->limit, 6));
            ceduo_page_scale(page, k, scale->lo, scale->hi);
        }
    ceduo_page_trim(page);
}

const char *ceduo_plot_compare(struct ceduo_drawing *d)
{
    const struct ceduo_scene *scene = d->scene;
    struct ceduo_result *result;
    size_t rows, n = scene->options_count;
    if (!d->control || !d->bare)
        return !d->control ? _("no control") : _("not computed yet");
    bool nothing = ceduo_rocks_reached(d->bare_arrivals) == 0;
    const struct ceduo_simulated **wooded = ceduo_check_memory(calloc(n, sizeof *wooded));
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_run_snapshot *run = ceduo_snapshot_find(d->picture->snapshot, scene, i);
        wooded[i] = run ? &run->simulated : NULL;
    }
    if (ceduo_result_assess(scene, &d->bare->simulated, wooded, NULL, NULL, &result) != CEDUO_OK)
        result = NULL;
    ceduo_check_memory(result);
    const struct ceduo_report report = {.result = result};
    rows = d->height > 4 ? (size_t)d->height - (nothing ? 3 : 2) : 2; /* lines without the head and the bare slope */
    rows = n <= rows ? n : rows - 1;
    ceduo_page_options(d->page, &report, CEDUO_OPTIONS_BARS, d->picture->control, d->picture->option, 0, rows);
    if (nothing)
        ceduo_page_para_role(d->page, CEDUO_ROLE_DIM, "%s", _("no rock arrives"));
    if (rows < n)
        ceduo_page_para(d->page, CEDUO_PAGE_NOTE, _("and %d more options"), (int)(n - rows));
    ceduo_result_free(result);
    free(wooded);
    return NULL;
}

void ceduo_page_shares(struct ceduo_page *page, const struct ceduo_report *report, bool years)
{
    const struct ceduo_control *c = last_control(report->result);
    const struct ceduo_choice *years_ahead = years ? ceduo_report_years_ahead(report, 0) : NULL;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_CAPTION);
    const char *name = MEASURE_NAME(ceduo_measure_exceeding(c, NULL), CEDUO_SHORT_HEAD), *place = LOCALIZED(c->x_given);
    if (has_rates(report))
        ceduo_text_format(text, _("Years between two rocks %s at %s m (accepted: %s)"), name, place,
                          LOCALIZED(ceduo_accepted_return(c)));
    else if (report->result->wooded)
        ceduo_text_format(text, _("Of 1000 rocks: %s at %s m"), name, place);
    else
        ceduo_text_format(text, _("At %s m"), place);
    if (years_ahead)
        ceduo_text_append_joined(text, "; ", _("years %u to %u"), years_ahead->window.first, years_ahead->window.last);
}

/* Append the tests that n options pass, all or none: a test with the same result for all options does not help to choose. */
static void add_equal_tests(struct ceduo_page *page, const struct ceduo_result *r, const size_t passes[3], size_t n)
{
    size_t tests = r->wooded && !isnan(last_control(r)->accepted) ? 3 : 2, equal = 0, named = 0;
    LOCAL_TEXT(names);
    if (n == 0 && ceduo_result_last_index(r, 0)->contact == CEDUO_LIGHT_UNKNOWN)
        return;
    for (size_t k = 0; k < tests; k++)
        equal += passes[k] == n;
    for (size_t k = 0; k < tests; k++)
        if (passes[k] == n) {
            ceduo_text_append(&names, named == 0 ? "" : named + 1 == equal ? _(" and ") : ", ");
            ceduo_text_append(&names, _(ceduo_light_names[k]));
            named++;
        }
    if (equal > 0 && n > 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE,
                        ngettext("Today all options pass the test of %s: it does not distinguish them.",
                                 "Today all options pass the tests of %s: they do not distinguish them.", equal),
                        names.bytes);
    else if (equal > 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE,
                        ngettext("Today no option passes the test of %s: it does not distinguish them.",
                                 "Today no option passes the tests of %s: they do not distinguish them.", equal),
                        names.bytes);
}

void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_report *report, enum ceduo_comparison what)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    size_t best = ceduo_result_best(r, v);
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("Side by side, up to %s m"), LOCALIZED(last_control(r)->x_given));
    if (what == CEDUO_COMPARE_REST)
        ceduo_page_para(page, CEDUO_PAGE_CAPTION, "%s", _("Tests today, and years that fail them:"));
    else if (what == CEDUO_COMPARE_ALL)
        ceduo_page_shares(page, report, false);
    if (what != CEDUO_COMPARE_WORDS)
        ceduo_page_options(page, report, what == CEDUO_COMPARE_REST ? CEDUO_OPTIONS_REST : CEDUO_OPTIONS_TODAY, r->last_control,
                           best, 0, SIZE_MAX);
    size_t n = r->scene->options_count, passes[3] = {0};
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_index *s = ceduo_result_last_index(r, i);
        const enum ceduo_light lights[3] = {s->contact, s->free_run, s->energy};
        for (size_t k = 0; k < 3; k++)
            passes[k] += lights[k] == CEDUO_LIGHT_PASS;
    }
    for (int all = 1; all >= 0; all--)
        add_equal_tests(page, r, passes, all ? n : 0);
    if (!v)
        return;
    bool known = false;
    if (what == CEDUO_COMPARE_ALL && ceduo_report_years_ahead(report, 0)) {
        ceduo_page_para(page, CEDUO_PAGE_CAPTION, _("Over years %u to %u, counted from today:"), v->choices[0].window.first,
                        v->choices[0].window.last);
        ceduo_page_options(page, report, CEDUO_OPTIONS_YEARS, r->last_control, best, 0, SIZE_MAX);
    }
    for (size_t i = 0; v->choices[0].last_summary->years > 0 && i < v->n; i++) { /* limits of the yield model */
        known |= !isnan(v->choices[i].yield.cut_per_year);
        if (v->choices[i].yield.space > 1)
            ceduo_page_para(page, CEDUO_PAGE_NOTE,
                            _("'%s': the standards would take %.0f %% of the growing space, so its yield is not computed."),
                            r->scene->options[i].name, 100 * v->choices[i].yield.space);
    }
    if (known)
        ceduo_page_note(page, _("Yield: standards take growing space from the shoots (assumed). Side light, roots and the "
                                "quality of the wood are not modelled."));
    ceduo_words_rank_reversals(r, v, ceduo_page_note, page); /* the best option is named at the top of the page */
    if (v->choices[0].last_summary->years > 0)
        ceduo_words_windows(r->scene, ceduo_page_note, page);
    if (v->wooded && !v->accepted)
        ceduo_page_note(page, _(ceduo_words_unjudged));
}

/* ---- one option year by year ---- */

void ceduo_page_years_words(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years *years)
{
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
    double felled = ceduo_years_felled(years);
    ceduo_words_years_summary(line, r, years);
    if (felled > 0)
        ceduo_text_append_joined(line, " ", _("Felled: %g m of forest along the slope."), felled);
    if (r->scene->options_count < 2) { /* otherwise printed below the table of all options */
        ceduo_text_append_char(line, ' ');
        ceduo_words_year_numbering(line, years->rocks);
    }
}

void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_years *years = report->years[option];
    const enum column *set = column_sets[CEDUO_OPTIONS_OF_YEARS][r->wooded];
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, _("Year by year, up to %s m:"), LOCALIZED(last_control(r)->x_given));
    begin_table(page, report, r->last_control, set);
    ceduo_text_cut(&page->last->cells[0].text, 0);
    ceduo_text_append(&page->last->cells[0].text, _("year"));
    for (const struct ceduo_year *y = years->years; y < years->years + years->count; y++) {
        char name[CEDUO_WORDS_SIZE];
        const struct ceduo_subject s = ceduo_subject_find_year(report, option, y);
        add_option_row(page, set, &s, NULL, CEDUO_ROLE_TEXT,
                       format_to(name, "%4u %s", y->year, y->cut ? P_("head", "cut") : ""));
    }
    ceduo_page_trim(page);
    ceduo_page_years_words(page, r, years);
}

#define TABLE_OPTIONS_MAX 8 /* options per table */

void ceduo_page_years_all_options(struct ceduo_page *page, const struct ceduo_report *report)
{
    static const struct ceduo_page_column year_columns[1 + TABLE_OPTIONS_MAX] = {
        {N_("year"), 15, 2, 0}, {"", -7, 0, 0}, {"", -7, 0, 0}, {"", -7, 0, 0}, {"", -7, 0, 0},
        {"", -7, 0, 0},         {"", -7, 0, 0}, {"", -7, 0, 0}, {"", -7, 0, 0}};
    const struct ceduo_result *r = report->result;
    const struct ceduo_control *control = last_control(r);
    size_t n = r->scene->options_count;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("All options year by year, %s, up to %s m"),
                    MEASURE_NAME(ceduo_measure_exceeding(control, NULL), CEDUO_HEAD), LOCALIZED(control->x_given));
    for (size_t from = 0; from < n; from += TABLE_OPTIONS_MAX) {
        size_t to = from + TABLE_OPTIONS_MAX < n ? from + TABLE_OPTIONS_MAX : n;
        ceduo_page_table(page, year_columns, 1 + to - from);
        for (size_t i = from; i < to; i++)
            ceduo_text_format(&page->last->cells[1 + i - from].text, "%zu", i + 1);
        for (size_t k = 0; k < report->years[0]->count; k++) {
            ceduo_page_cell_format(page, "%4u", report->years[0]->years[k].year);
            for (size_t i = from; i < to; i++) {
                const struct ceduo_year *y = &report->years[i]->years[k];
                ceduo_page_cell_format(
                    page, "%s",
                    y->wooded.rocks > 0 ? MEASURE_VALUE(ceduo_measure_exceeding(control, &y->wooded.arrivals[r->last_control]))
                                        : VS_LIMIT(y->controls[r->last_control].worst_adc, 3, r->scene->simulation.threshold));
            }
        }
        ceduo_page_cell_format(page, "%s", _("mean"));
        for (size_t i = from; i < to; i++)
            ceduo_page_cell_format(page, "%s", MEASURE_VALUE(ceduo_measure_share(report->verdict->choices[i].mean)));
        ceduo_page_cell_format(page, "%s", _("without forest"));
        for (size_t i = from; i < to; i++)
            ceduo_page_cell_format(page, "%s",
                                   MEASURE_VALUE(ceduo_measure_exceeding(control, &r->bare.arrivals[r->last_control])));
        struct text *names = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
        for (size_t i = from; i < to; i++)
            ceduo_text_format(names, i == from ? "%zu %s" : ", %zu %s", i + 1, r->scene->options[i].name);
        ceduo_text_append_char(names, '.');
    }
}

/* ---- comparison of energy laws ---- */

void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    bool any = false; /* in the terminal program results by the other law may arrive first */
    for (size_t i = 0; r->wooded && i < r->scene->options_count; i++)
        any |= ceduo_subject_find(report, i, r->last_control).alternative && ceduo_result_wooded(r, i, r->last_control);
    if (!any)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("Comparison of the energy laws"));
    ceduo_page_note(page, _("Two published laws disagree on the energy that thin stems absorb (Brauner et al. 2005; Dorren et "
                            "al. 2006). Neither has been validated for them. More rocks do not decide between them."));
    ceduo_page_para(
        page, CEDUO_PAGE_CAPTION, _("The same rocks at %s m: how many of 1000 %s, and the mean energy of those that arrive:"),
        LOCALIZED(last_control(r)->x_given), MEASURE_NAME(ceduo_measure_exceeding(last_control(r), NULL), CEDUO_PHRASE));
    size_t best = r->scene->options_count > 1 ? ceduo_result_best(r, report->verdict) : SIZE_MAX;
    ceduo_page_options(page, report, CEDUO_OPTIONS_LAWS, r->last_control, best, 0, SIZE_MAX);
}
