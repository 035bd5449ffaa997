/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page that --batch prints: the answer, how sure it is, what it becomes over the years, what was assumed, on one screen.
 * Of several options a table comes first. What is assumed and what is to be noted takes the lines that are left; how much more
 * there is is said. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "page_parts.h"
#include "plot.h"

#define LINES        24 /* of one option */
#define LINES_SHARED 14 /* of several … */
#define LINES_OPTION 2  /* … and for each */
#define LINES_BLOCKS 2  /* … and to say how often, where that is known */

/* ---- head ---- */

/* With as much of the rocks as keeps it in one line. */
static void add_title(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_scene *s = r->scene;
    const char *title = ceduo_in_language(s->title, s->title_it), *about = ceduo_rock_varies(&s->rock) ? "~" : "";
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_TITLE);
    LOCAL_TEXT(rocks);
    ceduo_text_format(&rocks, " \xe2\x80\x93 ");
    ceduo_text_format(&rocks, s->blocks_count > 0 ? _("%llu rocks of many sizes") : _("%llu rocks of %s%s m (%s kg)"),
                      (unsigned long long)ceduo_result_rocks(r), about, WRITTEN(r->rock.mean_diameter, 2),
                      WRITTEN(r->rock.mass, 3));
    ceduo_text_append(text, title);
    for (char *end = rocks.bytes; *end && ceduo_utf8_width(title) + ceduo_utf8_width(rocks.bytes) > page->width;) {
        end = strrchr(rocks.bytes, '(');
        end = end ? end - 1 : rocks.bytes;
        *end = '\0';
    }
    ceduo_text_append(text, rocks.bytes);
}

/* ---- one option ---- */

/* What arrives with stems on the way (NULL: not known) beside what arrives without them; where none stand that alone. */
static void add_arrivals(struct ceduo_page *page, const struct ceduo_result *r, bool stems)
{
    static const struct ceduo_page_column columns[] = {
        {N_("of 1000 rocks"), 40, 2, 0}, {NP_("head", "without wood"), -14, 0, 0}, {NP_("head", "with the wood"), -16, 0, 0}};
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    const struct ceduo_arrivals *arrivals[] = {&r->bare.arrivals[r->last_control], ceduo_result_wooded(r, 0, r->last_control)};
    struct ceduo_measure figures[2][4];
    for (size_t i = 0; i < 2; i++) {
        figures[i][0] = ceduo_measure_arriving(arrivals[i]);
        figures[i][1] = ceduo_measure_exceeding(c, arrivals[i]);
        figures[i][2] = ceduo_mean_energy(arrivals[i]);
        figures[i][3] = ceduo_energy_p95(arrivals[i]);
        figures[i][2].digits = 3; /* as many as the other one */
    }
    ceduo_page_table(page, columns, stems ? 3 : 2);
    for (size_t k = 0; k < 4; k++) {
        if (k == 1 && isnan(c->accepted))
            continue;
        ceduo_page_cell_format(page, "%s", NAMED(figures[0][k], CEDUO_PHRASE));
        for (size_t i = 0; i < (stems ? 2 : 1); i++)
            ceduo_page_cell_format(page, "%s", VALUE_OF(figures[i][k]));
    }
    ceduo_page_cell_format(page, "%s", _("stopped by stems, at rest before"));
    for (size_t i = 0; i < (stems ? 2 : 1); i++)
        ceduo_page_cell_format(page, arrivals[i] ? "%.0f, %.0f" : "-",
                               arrivals[i] ? 1000 * arrivals[i]->missed[CEDUO_STOPPED_BY_STEMS] : 0,
                               arrivals[i] ? 1000 * arrivals[i]->missed[CEDUO_AT_REST] : 0);
}

static void add_wood(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("on the way"), 40, 2, 0}, {"", -14, 0, 0}, {NP_("head", "limit"), -15, 0, 0}, {NP_("head", "kept"), -7, 0, 0}};
    const struct ceduo_index *s = ceduo_result_last_index(r, 0);
    const char *threshold = SHORTEST(r->scene->simulation.threshold);
    CEDUO_PAGE_TABLE_OF(page, columns);
    if (s->length > 0 && s->longest_gap > r->scene->simulation.threshold) { /* the reason why neither is kept */
        ceduo_page_cell_format(page, "%s", _("gap without forest, m"));
        ceduo_page_cell_format(page, "%s", ROUNDED(s->longest_gap, 6));
        ceduo_page_cell_format(page, _("at most %s"), threshold);
        ceduo_page_yes(page, false);
    }
    ceduo_page_cell_format(page, "%s", _("distance between contacts (ADC), m"));
    ceduo_page_cell_format(page, "%s", BESIDE(s->length > 0 ? s->worst_adc : NAN, 3, r->scene->simulation.threshold));
    ceduo_page_cell_format(page, _("below %s"), threshold);
    ceduo_page_yes(page, s->worst_adc < r->scene->simulation.threshold);
    ceduo_page_cell_format(page, _("chance of %s m without a contact"), threshold);
    ceduo_page_free_run(page, s->worst_free_run);
    ceduo_page_cell_format(page, _("at most %.0f %%"), 100 * CEDUO_FREE_RUN_MAX);
    ceduo_page_yes(page, s->worst_free_run <= CEDUO_FREE_RUN_MAX);
    ceduo_page_cell_format(page, "%s", _("energy taken by stems, left (index), kJ"));
    ceduo_page_cell_format(page, "%s, %s", WRITTEN(s->dissipated * J_TO_KJ, 3), WRITTEN(s->residual * J_TO_KJ, 3));
    ceduo_page_cell_format(page, "%s", "");
    ceduo_page_cell_format(page, "%s", "");
}

/* ---- several ---- */

/* AHEAD: over the years and today. RATES: the same with blocks, in years from one rock to the next. TODAY: today alone, and its
 * range. */
enum form { AHEAD, RATES, TODAY };

static enum form form_of(const struct ceduo_report *report)
{
    if (report->result->scene->blocks_count > 0 && report->verdict->accepted)
        return RATES;
    return ceduo_report_ahead(report, 0) ? AHEAD : TODAY;
}

static void add_option(struct ceduo_page *page, const struct ceduo_report *report, enum form form, size_t i)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_subject s = ceduo_subject_find(report, i, r->last_control);
    ceduo_page_cell_format(page, "%s", r->scene->options[i].name);
    if (form == RATES) { /* how often, with both errors; whether that is accepted; the same today */
        ceduo_page_cell_format(page, "%s", YEARS(s.outcome.rate));
        ceduo_page_cell_format(page, "%s", DECISION(s.outcome.answer));
        ceduo_page_cell_format(page, "%s", EVERY(s.wooded ? ceduo_hazard_feared(&s.wooded->hazard) : s.outcome.rate));
    } else if (form == AHEAD) {
        ceduo_page_cell_format(page, "%s", VALUE_OF(s.mean));
        ceduo_page_cell_format(page, "%s", isnan(s.mean.may_lo) ? "-" : MAY_BE(s.mean));
        ceduo_page_worst(page, s.choice);
        ceduo_page_fails(page, s.choice, s.choice->last_summary->unprotected_energy, s.choice->energy_known);
    }
    if (form != RATES)
        ceduo_page_cell_format(page, "%s", VALUE_OF(s.today));
    if (form == TODAY)
        ceduo_page_cell_format(page, "%s", isnan(s.today.may_lo) ? "-" : MAY_BE(s.today));
    ceduo_page_cell_format(page, "%s", BESIDE(s.index->worst_adc, 3, r->scene->simulation.threshold));
    if (form != TODAY)
        ceduo_page_number(page, s.choice->yield.cut_per_year, 2);
}

/* What differs between the options: over the years, and today. */
static void add_options(struct ceduo_page *page, const struct ceduo_report *report)
{
#define OPTION "", 26, 2, 0
#define TODAY_ N_("today"), -6, 0, 0
#define ADC    N_("ADC"), -6, 0, 0
#define FELLED NP_("head", "felled"), -7, 0, 0
    static const struct ceduo_page_column ahead[] = {{OPTION},        {"", -5, 0, CEDUO_SPAN},
                                                     {"", -10, 0, 0}, {"", -10, 0, 0},
                                                     {"", -8, 0, 0},  {TODAY_},
                                                     {ADC},           {FELLED}},
                                          rates[] = {{OPTION}, {"", -14, 0, CEDUO_SPAN}, {"", 14, 2, 0}, {TODAY_}, {ADC},
                                                     {FELLED}},
                                          alone[] = {{OPTION}, {TODAY_}, {"", -10, 0, 0}, {ADC}};
    const char *const below[][8] = {{_("mean"), _("range"), _("worst"), _("failing"), "", "m", P_("head", "m3/y"), NULL},
                                    {_("mean, years"), _("accepted"), "", "m", P_("head", "m3/y"), NULL},
                                    {"", _("range"), "m", NULL}};
    static const struct {
        const struct ceduo_page_column *columns;
        size_t n, today; /* columns behind the name; the one of today */
    } forms[] = {[AHEAD] = {ahead, 8, 4}, [RATES] = {rates, 6, 2}, [TODAY] = {alone, 4, 0}};
    const struct ceduo_result *r = report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[r->last_control];
    const struct ceduo_measure share = ceduo_measure_exceeding(c, bare);
    const struct ceduo_window *w = &report->verdict->choices[0].window;
    enum form form = form_of(report);
    ceduo_page_table(page, forms[form].columns, forms[form].n);
    if (w->kind != CEDUO_WINDOW_CONSTANT)
        ceduo_text_format(&page->last->cells[1].text, form == TODAY ? "" : _("years %u to %u"), w->first, w->last);
    if (form == RATES)
        ceduo_text_format(ceduo_page_text(page), _("years between > %s kJ"), SHORTEST(ceduo_words_accepted(c)));
    else
        ceduo_page_cell_format(page, "%s", NAMED(share, CEDUO_HEAD));
    for (size_t i = 0; below[form][i]; i++)
        ceduo_page_cell_format(page, "%s", below[form][i]);
    for (size_t i = 0; i < r->scene->options_count; i++)
        add_option(page, report, form, i);
    ceduo_page_cell_format(page, "%s", _("without forest"));
    for (size_t i = 0; below[form][i]; i++) {
        struct text *text = ceduo_page_text(page);
        if (i == forms[form].today && form == RATES)
            ceduo_text_append(text, EVERY(ceduo_hazard_feared(&bare->hazard)));
        else if (i == forms[form].today)
            ceduo_text_append(text, VALUE_OF(share));
    }
}

/* ---- what is assumed, and what is to be noted ---- */

static void gather_notes(struct ceduo_page *notes, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    if (report->uncertainty && report->uncertainty->answer)
        ceduo_uncertainty_outside(report->uncertainty, ceduo_page_warn_once, notes);
    if (r->scene->controls_count > 0 && !isnan(ceduo_result_last_index(r, 0)->measured))
        ceduo_page_para(notes, CEDUO_PAGE_WARNING, _("One rock that was measured here had %s kJ."),
                        WRITTEN(ceduo_result_last_index(r, 0)->measured * J_TO_KJ, 3));
    ceduo_words_thin_stems(r, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_rules(notes, r, i, false);
    if (n > 1 && report->verdict && report->verdict->choices[0].last_summary->years > 0)
        ceduo_words_windows(r->scene, ceduo_page_warn_once, notes);
    for (size_t i = 0; i < n; i++)
        ceduo_page_stand_warnings(notes, r, i);
    ceduo_words_run_warnings(r, &report->remarks, ceduo_page_warn_once, notes);
    if (r->scene->slope.points > r->scene->slope.vertices) {
        struct text *points = ceduo_page_add(notes, CEDUO_PAGE_WARNING);
        ceduo_text_append(points, _("Profile: "));
        ceduo_words_points(points, &r->scene->slope);
        ceduo_text_char(points, '.');
    }
}

/* A point of sentences (warnings) or of other texts, and how many more there are. */
static void add_point(struct ceduo_page *page, const char *label, const struct text *said, size_t more)
{
    struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, label);
    ceduo_text_append(text, ceduo_text_string(said));
    if (more > 0)
        ceduo_text_append_joined(text, said->length > 0 ? " " : "", _("(%zu more)"), more);
}

/* Adds those of the sentences, whole ones, that keep within so many lines. False where none has room, or not even how many more. */
static bool add_sentences(struct ceduo_page *page, const char *label, const struct ceduo_page *sentences, size_t lines)
{
    LOCAL_PAGE(tried, page->width);
    LOCAL_TEXT(said);
    size_t more = 0;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next)
        more++;
    for (const struct ceduo_page_block *b = sentences->first; b; b = b->next) {
        size_t before = said.length; /* the first goes before how many more */
        ceduo_text_append_joined(&said, before == 0 ? "" : b->kind == CEDUO_PAGE_WARNING ? " " : "; ", "%s", b->text.bytes);
        add_point(&tried, label, &said, before == 0 ? 0 : more - 1);
        if (ceduo_page_lines(&tried) > lines)
            ceduo_text_cut(&said, before);
        else
            more--;
        ceduo_page_free(&tried);
    }
    if (said.length == 0)
        return more == 0;
    add_point(&tried, label, &said, more);
    bool counted = ceduo_page_lines(&tried) <= lines;
    add_point(page, label, &said, counted ? more : 0);
    return counted;
}

/* What is to be noted goes before what is assumed, but for a line or two. False where not all of it, or how much more, is said. */
static bool add_rest(struct ceduo_page *page, const struct ceduo_report *report, size_t lines)
{
    LOCAL_PAGE(assumed, 0);
    LOCAL_PAGE(notes, 0);
    LOCAL_PAGE(tried, page->width);
    size_t taken = ceduo_page_lines(page) + 1; /* and a last one for what more there is */
    size_t left = lines > taken + 1 ? lines - taken : 1;
    ceduo_page_assumed(&assumed, report, false);
    gather_notes(&notes, report);
    add_sentences(&tried, _("NOTE"), &notes, left - (left > 3 ? 2 : 1));
    bool said = add_sentences(page, _("ASSUMED *"), &assumed, left - ceduo_page_lines(&tried));
    return add_sentences(page, _("NOTE"), &notes, left + taken - 1 - ceduo_page_lines(page)) && said;
}

void ceduo_page_short(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    bool nothing = ceduo_page_is_unassessable(r);
    add_title(page, report);
    ceduo_page_question(page, r);
    if (n == 1)
        ceduo_page_add(page, CEDUO_PAGE_GAP);
    if (n > 1 && !nothing && r->wooded)
        add_options(page, report);
    else if (n > 1 && !nothing)
        ceduo_page_today(page, r);
    ceduo_page_answer(page, report);
    if (r->scene->blocks_count > 0 && !nothing)
        ceduo_words_hazard(ceduo_page_add(page, CEDUO_PAGE_ANSWER), r, ceduo_result_best(r, report->verdict), r->last_control);
    if (n == 1 && !nothing) {
        ceduo_page_add(page, CEDUO_PAGE_GAP);
        add_arrivals(page, r, ceduo_plot_has_stems(&r->scene->options[0]));
        if (ceduo_plot_has_stems(&r->scene->options[0]))
            add_wood(page, r);
    }
    ceduo_page_sure(page, report);
    ceduo_page_over(page, report);
    size_t shared = LINES_SHARED + (r->scene->blocks_count > 0 ? LINES_BLOCKS : 0);
    bool noted = add_rest(page, report, n > 1 ? shared + LINES_OPTION * n : LINES);
    for (size_t i = 0; report->years && !nothing && i < n; i++) { /* they were asked for */
        ceduo_page_para(page, CEDUO_PAGE_SECTION, "%s", r->scene->options[i].name);
        ceduo_page_years(page, report, i);
    }
    if (report->years && !nothing && n > 1)
        ceduo_page_years_beside(page, report);
    ceduo_text_format(ceduo_page_item(page, CEDUO_PAGE_POINT, _("MORE")), "--details%s, --sensitivity, --report page.html; %s",
                      noted ? "" : _(" (notes)"), noted ? _("as screens: ceduo SCENE") : _("or ceduo SCENE"));
}
