/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side at the last control, today and over the years; one option year by year; one energy law against the
 * other. */
#include <math.h>
#include <stdio.h>

#include "base/language.h"
#include "page_parts.h"
#include "scene/choices.h"
#include "study/verdict.h"

static const struct ceduo_control *last_control(const struct ceduo_result *r)
{
    return &r->scene->controls[r->last_control];
}

/* ---- today ---- */

/* ADC and free run with their tests. */
static void add_contacts(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_index *s)
{
    ceduo_page_cell_format(page, "%s", BESIDE(s->worst_adc, 3, r->scene->simulation.threshold));
    ceduo_page_verdict(page, s->contact);
    ceduo_page_free_run(page, s->worst_free_run);
    ceduo_page_verdict(page, s->free_run);
}

#define OPTION   N_("option"), 23, 2, 0
#define ADC      N_("ADC m|ADC of the worst belt, m"), -7, 0, 0
#define CONTACT  NP_("head", "|test of contact"), 5, 1, 0
#define FREE_RUN NP_("head", "free run|chance of a free run"), -7, 0, CEDUO_SPAN

/* What arrives with more than is withstood comes first. */
void ceduo_page_today(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column wooded[] = {{OPTION},
                                                      {NULL, -10, 0, 0},
                                                      {NP_("head", "to first|difference to the first option"), -11, 0, 0},
                                                      {NP_("head", "energy|test of energy"), 6, 2, 0},
                                                      {ADC},
                                                      {CONTACT},
                                                      {FREE_RUN},
                                                      {NP_("head", "|test of free runs"), 0, 1, 0}};
    static const struct ceduo_page_column by_index[] = {{OPTION},
                                                        {ADC},
                                                        {CONTACT},
                                                        {FREE_RUN},
                                                        {NP_("head", "|test of free runs"), 5, 1, 0},
                                                        {N_("kJ/100 m|taken per 100 m, kJ"), -10, 0, 0},
                                                        {NP_("head", "left kJ|energy left, kJ"), -10, 0, 0}};
    if (r->wooded) {
        CEDUO_PAGE_TABLE_OF(page, wooded);
        ceduo_page_limit(page, last_control(r), CEDUO_SHORT_HEAD);
    } else {
        CEDUO_PAGE_TABLE_OF(page, by_index);
    }
    for (size_t i = 0; i < r->scene->options_count; i++) {
        const struct ceduo_index *s = ceduo_result_last_index(r, i);
        ceduo_page_cell_format(page, "%s", r->scene->options[i].name);
        if (r->wooded) {
            const struct ceduo_mean_share share = ceduo_share_at(ceduo_result_wooded(r, i, r->last_control));
            struct ceduo_estimate to_first = ceduo_share_to_first(r, i);
            ceduo_page_cell_format(page, "%s", WITH_ERROR(ceduo_share(share), " "));
            if (ceduo_pairs_are_equal(&to_first))
                ceduo_page_cell_format(page, "< %.0f", ceil(to_first.hi * 1000));
            else if (i > 0 && to_first.mean == 0 && to_first.se == 0)
                ceduo_page_cell_format(page, "%s", _("the same"));
            else if (i == 0 || isnan(to_first.mean))
                ceduo_page_cell_format(page, "-");
            else
                ceduo_page_cell_format(page, isnan(to_first.se) ? "%+.0f" : "%+.0f \xc2\xb1%.0f", to_first.mean * 1000,
                                       ceil(CEDUO_Z95 * to_first.se * 1000));
            ceduo_page_verdict(page, ceduo_result_last_index(r, i)->energy);
        }
        add_contacts(page, r, s);
        if (r->wooded)
            continue;
        ceduo_page_number(page, s->per_100m * J_TO_KJ, 3);
        if (s->exhausted)
            ceduo_page_cell_format(page, "%s", _("used up"));
        else
            ceduo_page_number(page, s->residual * J_TO_KJ, 3);
    }
}

/* ---- over the years ---- */

void ceduo_page_worst(struct ceduo_page *page, const struct ceduo_choice *c)
{
    ceduo_page_cell_format(page, c->last_summary->years > 0 ? "%s (%u)" : "-",
                           c->last_summary->simulated > 0 ? WRITTEN(1000 * c->worst.mean, 0) : WRITTEN(c->worst.mean, 3),
                           c->last_summary->worst_year);
}

void ceduo_page_fails(struct ceduo_page *page, const struct ceduo_choice *c, size_t fails, bool known)
{
    ceduo_page_cell_format(page, known && c->last_summary->years > 0 ? "%zu/%zu" : "-", fails, c->last_summary->years);
}

static void add_choice(struct ceduo_page *page, const char *name, const struct ceduo_choice *c)
{
    ceduo_page_cell_format(page, "%s", name);
    if (c->last_summary->simulated > 0)
        ceduo_page_cell_format(page, "%s", WITH_ERROR(ceduo_share(c->mean), " "));
    ceduo_page_worst(page, c);
    ceduo_page_fails(page, c, c->last_summary->unprotected_contact, !c->last_summary->nothing);
    ceduo_page_fails(page, c, c->last_summary->unprotected_free_run, !c->last_summary->nothing);
    if (c->last_summary->simulated > 0)
        ceduo_page_fails(page, c, c->last_summary->unprotected_energy, c->energy_known);
    ceduo_page_number(page, c->yield.cut_per_year, 2);
    ceduo_page_number(page, c->yield.standing, 3);
}

static void add_rotations(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_verdict *v)
{
    static const struct ceduo_page_column simulated[] = {{N_("option"), 22, 2, 0},
                                                         {NULL, -10, 0, 0},
                                                         {NP_("head", "worst year|in the worst year (which)"), -11, 0, 0},
                                                         {NP_("head", "contact|years in which contact fails"), -8, 0, 0},
                                                         {NP_("head", "free run|years in which free runs fail"), -9, 0, 0},
                                                         {NP_("head", "energy|years in which energy fails"), -7, 0, 0},
                                                         {NP_("head", "m3/y|felled, m3 per ha and year"), -5, 0, 0},
                                                         {NP_("head", "m3|standing, m3 per ha"), -6, 0, 0}};
    static const struct ceduo_page_column by_index[] = {
        {OPTION},
        {NP_("head", "ADC m, worst|ADC in the worst year, m (which)"), -14, 0, 0},
        {NP_("head", "contact|years in which contact fails"), -8, 0, 0},
        {NP_("head", "free run|years in which free runs fail"), -9, 0, 0},
        {NP_("head", "m3/y|felled, m3 per ha and year"), -6, 0, 0},
        {NP_("head", "m3|standing, m3 per ha"), -7, 0, 0}};
    char span[CEDUO_WORDS_ROOM];
    snprintf(span, sizeof span, _("years %u to %u"), v->choices[0].window.first, v->choices[0].window.last);
    if (v->wooded)
        ceduo_page_para(
            page, CEDUO_PAGE_CAPTION,
            _("Over %s: of 1000 released, in the mean and in the worst of these years, counted from today, with %llu "
              "rocks in each; years in which a test fails; wood felled per hectare and year, and standing:"),
            span, (unsigned long long)v->choices[0].rocks);
    else
        ceduo_page_para(
            page, CEDUO_PAGE_CAPTION,
            _("Over %s: the worst year, counted from today; years in which a test fails; wood felled per hectare and "
              "year, and standing:"),
            span);
    if (v->choices[0].last_summary->simulated > 0) {
        CEDUO_PAGE_TABLE_OF(page, simulated);
        ceduo_page_limit(page, last_control(r), CEDUO_SHORT_HEAD);
    } else {
        CEDUO_PAGE_TABLE_OF(page, by_index);
    }
    for (size_t i = 0; i < v->n; i++)
        add_choice(page, r->scene->options[i].name, &v->choices[i]);
}

void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("Side by side, up to %s m"), SHORTEST(last_control(r)->x_given));
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, _("Today:"));
    ceduo_page_today(page, r);
    size_t n = r->scene->options_count, passes[3] = {0};
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_index *s = ceduo_result_last_index(r, i);
        const enum ceduo_light lights[3] = {s->contact, s->free_run, s->energy};
        for (size_t k = 0; k < 3; k++)
            passes[k] += lights[k] == CEDUO_PASS;
    }
    /* a test that all options pass, or none, says nothing about which to choose */
    for (size_t k = 0; k < (r->wooded && !isnan(last_control(r)->accepted) ? 3u : 2u); k++)
        if (passes[k] == n || (passes[k] == 0 && ceduo_result_last_index(r, 0)->contact != CEDUO_UNKNOWN))
            ceduo_page_para(page, CEDUO_PAGE_NOTE,
                            passes[k] == n ? _("Today all options pass the test of %s: it does not separate them.")
                                           : _("Today no option passes the test of %s: it does not separate them."),
                            _(ceduo_light_names[k]));
    if (!v)
        return;
    bool known = false;
    if (ceduo_report_ahead(report, 0))
        add_rotations(page, r, v);
    for (size_t i = 0; v->choices[0].last_summary->years > 0 && i < v->n; i++) { /* what a yield leaves out */
        known |= !isnan(v->choices[i].yield.cut_per_year);
        if (v->choices[i].yield.space > 1)
            ceduo_page_para(
                page, CEDUO_PAGE_NOTE,
                _("'%s' keeps more standards than the ground bears (%.0f %% of the growing space): its yield is not computed."),
                r->scene->options[i].name, 100 * v->choices[i].yield.space);
    }
    for (size_t i = 0; i < v->n; i++) {
        struct ceduo_window w = ceduo_window_compute(&r->scene->options[i]);
        if (w.kind != CEDUO_WINDOW_ROTATION || isnan(v->choices[i].rotation.mean))
            continue;
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("'%s', mean over a whole rotation, years %u to %u: %s of 1000."),
                        r->scene->options[i].name, w.first, w.last, WITH_ERROR(ceduo_share(v->choices[i].rotation), " "));
    }
    if (known)
        ceduo_page_note(page, _("Yield: standards take growing space from the shoots (assumed). Side light, roots and the "
                                "quality of the wood are not modelled."));
    ceduo_words_rank_reversals(r, v, ceduo_page_note, page); /* which is best stands at the head of the page */
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
    ceduo_words_years_sum(line, r, years);
    if (felled > 0)
        ceduo_text_append_joined(line, " ", _("Felled: %g m of forest along the slope."), felled);
    if (r->scene->options_count < 2) { /* otherwise it stands below the table of all */
        ceduo_text_char(line, ' ');
        ceduo_words_year_numbering(line, years->rocks);
    }
}

void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    static const struct ceduo_page_column columns[] = {{N_("year"), 9, 4, 0},
                                                       {ADC},
                                                       {CONTACT},
                                                       {FREE_RUN},
                                                       {NP_("head", "|test of free runs"), 5, 1, 0},
                                                       {N_("kJ/100 m|taken per 100 m, kJ"), -9, 0, 0},
                                                       {NULL, -16, 0, 0},
                                                       {NP_("head", "arr. kJ|mean of those that arrive, kJ"), -8, 0, 0},
                                                       {NP_("head", "energy|test of energy"), 0, 2, 0}};
    const struct ceduo_result *r = report->result;
    const struct ceduo_years *years = report->years[option];
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, _("Year by year, up to %s m:"), SHORTEST(last_control(r)->x_given));
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_page_limit(page, last_control(r), CEDUO_HEAD);
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *y = &years->years[i];
        const struct ceduo_index *s = &y->controls[r->last_control];
        const struct ceduo_arrivals *a = y->wooded.rocks > 0 ? &y->wooded.arrivals[r->last_control] : NULL;
        ceduo_page_cell_format(page, "%4u %s", y->year, y->cut ? P_("head", "cut") : "");
        add_contacts(page, r, s);
        ceduo_page_number(page, s->per_100m * J_TO_KJ, 3);
        ceduo_page_cell_format(page, "%s", INTERVAL(ceduo_measure_exceeding(last_control(r), a)));
        ceduo_page_number(page, a ? a->energy.mean * J_TO_KJ : NAN, 3);
        ceduo_page_verdict(page, s->energy);
    }
    ceduo_page_years_words(page, r, years);
}

#define BESIDE_MAX 8 /* options in one table */

void ceduo_page_years_beside(struct ceduo_page *page, const struct ceduo_report *report)
{
    static const struct ceduo_page_column columns[1 + BESIDE_MAX] = {{N_("year"), 15, 2, 0}, {"", -7, 0, 0}, {"", -7, 0, 0},
                                                                     {"", -7, 0, 0},         {"", -7, 0, 0}, {"", -7, 0, 0},
                                                                     {"", -7, 0, 0},         {"", -7, 0, 0}, {"", -7, 0, 0}};
    const struct ceduo_result *r = report->result;
    const struct ceduo_control *control = last_control(r);
    size_t n = r->scene->options_count;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("All options year by year, %s, up to %s m"),
                    NAMED(ceduo_measure_exceeding(control, NULL), CEDUO_HEAD), SHORTEST(control->x_given));
    for (size_t from = 0; from < n; from += BESIDE_MAX) {
        size_t to = from + BESIDE_MAX < n ? from + BESIDE_MAX : n;
        ceduo_page_table(page, columns, 1 + to - from);
        for (size_t i = from; i < to; i++)
            ceduo_text_format(&page->last->cells[1 + i - from].text, "%zu", i + 1);
        for (size_t k = 0; k < report->years[0]->count; k++) {
            ceduo_page_cell_format(page, "%4u", report->years[0]->years[k].year);
            for (size_t i = from; i < to; i++) {
                const struct ceduo_year *y = &report->years[i]->years[k];
                ceduo_page_cell_format(page, "%s",
                                       y->wooded.rocks > 0
                                           ? VALUE_OF(ceduo_measure_exceeding(control, &y->wooded.arrivals[r->last_control]))
                                           : BESIDE(y->controls[r->last_control].worst_adc, 3, r->scene->simulation.threshold));
            }
        }
        ceduo_page_cell_format(page, "%s", _("mean"));
        for (size_t i = from; i < to; i++)
            ceduo_page_cell_format(page, "%s", VALUE_OF(ceduo_share(report->verdict->choices[i].mean)));
        ceduo_page_cell_format(page, "%s", _("without forest"));
        for (size_t i = from; i < to; i++)
            ceduo_page_cell_format(page, "%s", VALUE_OF(ceduo_measure_exceeding(control, &r->bare.arrivals[r->last_control])));
        struct text *names = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
        for (size_t i = from; i < to; i++)
            ceduo_text_format(names, i == from ? "%zu %s" : ", %zu %s", i + 1, r->scene->options[i].name);
        ceduo_text_char(names, '.');
    }
}

/* ---- one energy law of stems against the other ---- */

/* NULL: not known, or of no stems. */
static const struct ceduo_alternative_energy *other_of(const struct ceduo_result *r, size_t option)
{
    const struct ceduo_alternative_energy *other = &r->options[option].others[r->last_control];
    return other->known && other->stems ? other : NULL;
}

/* The law of the scene, or that its stands have several. */
static const char *law_of(const struct ceduo_option *option)
{
    const char *law = NULL;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        const char *here = ceduo_stand_is_bare(stand) ? law : ceduo_words_law(ceduo_energy_words.names[stand->energy]);
        if (law && law != here)
            return _("several");
        law = here;
    }
    return law ? law : "-";
}

void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {{OPTION},
                                                       {NP_("head", "law of the scene"), 16, 1, 0},
                                                       {N_("of 1000"), -8, 0, 0},
                                                       {NP_("head", "mean kJ|mean energy, kJ"), -8, 0, 0},
                                                       {NP_("head", "other law"), 11, 2, 0},
                                                       {N_("of 1000"), -8, 0, 0},
                                                       {NP_("head", "mean kJ|mean energy, kJ"), -8, 0, 0}};
    bool any = false; /* in the terminal program the figures by the other law may be there before those of the scene's own */
    for (size_t i = 0; r->wooded && i < r->scene->options_count; i++)
        any |= other_of(r, i) && ceduo_result_wooded(r, i, r->last_control);
    if (!any)
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("One energy law against the other"));
    ceduo_page_note(page,
                    _("Two published laws disagree about what thin stems take from a rock (Brauner et al. 2005; Dorren et "
                      "al. 2006), and nobody knows yet which of them holds there. What differs here, more rocks cannot "
                      "decide."));
    ceduo_page_para(page, CEDUO_PAGE_CAPTION,
                    _("The same rocks at %s m: how many of 1000 %s, and the mean energy of those that arrive:"),
                    SHORTEST(last_control(r)->x_given), NAMED(ceduo_measure_exceeding(last_control(r), NULL), CEDUO_PHRASE));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < r->scene->options_count; i++) {
        const struct ceduo_arrivals *a = ceduo_result_wooded(r, i, r->last_control);
        const struct ceduo_alternative_energy *other = other_of(r, i);
        if (!a)
            continue;
        ceduo_page_cell_format(page, "%s", r->scene->options[i].name);
        ceduo_page_cell_format(page, "%s", law_of(&r->scene->options[i]));
        ceduo_page_cell_format(page, "%.0f", 1000 * ceduo_share_at(a).mean);
        ceduo_page_number(page, a->energy.mean * J_TO_KJ, 3);
        ceduo_page_cell_format(page, "%s", other ? ceduo_words_law(ceduo_energy_words.names[other->model]) : "-");
        ceduo_page_cell_format(page, "%s", other ? WRITTEN(1000 * ceduo_judged_share(&other->arrivals).mean, 0) : "-");
        ceduo_page_number(page, other ? other->arrivals.energy.mean * J_TO_KJ : NAN, 3);
    }
}
