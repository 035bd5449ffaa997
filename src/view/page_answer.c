/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First part of the short page, the full page and the report: question, answer, its certainty, what would improve it, and
 * its development over the years. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "core/runs/assess.h"
#include "core/runs/result.h"
#include "page_parts.h"
#include "plot.h"

bool ceduo_page_is_unassessable(const struct ceduo_result *r)
{
    return r->scene->controls_count == 0 || ceduo_too_few_arrivals(&r->bare.arrivals[r->last_control]);
}

/* Append the question about one option and the years that are judged. */
static void ask_about_years(struct text *text, const char *place, struct ceduo_window w)
{
    if (w.kind == CEDUO_WINDOW_CONSTANT)
        ceduo_text_format(text, _("Does the forest protect %s?"), place);
    else if (w.kind == CEDUO_WINDOW_AHEAD || (w.first == 1 && w.step == 1))
        ceduo_text_format(text,
                          ngettext("Does the forest protect %s over the next %u year?",
                                   "Does the forest protect %s over the next %u years?", w.last),
                          place, w.last);
    else if (w.first == w.last)
        ceduo_text_format(text, _("Does the forest protect %s in year %u?"), place, w.first);
    else
        ceduo_text_format(text, _("Does the forest protect %s in the years %u to %u?"), place, w.first, w.last);
}

void ceduo_page_question(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    if (r->scene->controls_count == 0)
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_QUESTION);
    const char *x = LOCALIZED(last_control(r)->x_given), *withstands = LOCALIZED(ceduo_words_accepted(last_control(r)));
    size_t n = r->scene->options_count;
    bool accepted = !isnan(last_control(r)->accepted), named = last_control(r)->name;
    LOCAL_TEXT(place);
    if (named && accepted)
        ceduo_text_format(&place, _("'%s' (%s m, limit %s kJ)"), NAME_OF(last_control(r)), x, withstands);
    else if (named)
        ceduo_text_format(&place, _("'%s' (%s m)"), NAME_OF(last_control(r)), x);
    else if (accepted)
        ceduo_text_format(&place, _("the place at %s m (limit %s kJ)"), x, withstands);
    else
        ceduo_text_format(&place, _("the place at %s m"), x);
    if (n == 1 && accepted)
        ask_about_years(text, place.bytes, report->verdict ? report->verdict->choices[0].window : ceduo_scene_window(r->scene));
    else if (n == 1)
        ceduo_text_format(text, _("How many rocks does the forest keep from %s?"), place.bytes);
    else if (accepted)
        ceduo_text_format(text, _("Which of %zu treatments best protects %s?"), n, place.bytes);
    else
        ceduo_text_format(text, _("Which of %zu treatments keeps the most rocks from %s?"), n, place.bytes);
}

/* ---- the answer ---- */

/* Append the names of options with a judgement, today or over the years; "none" if there are none. */
static void append_judged_options(struct text *text, const struct ceduo_report *report, bool today,
                                  enum ceduo_judgement judgement)
{
    const struct ceduo_result *r = report->result;
    size_t n = 0;
    for (size_t i = 0; i < r->scene->options_count; i++) {
        const struct ceduo_outcome o = ceduo_report_outcome(report, i, r->last_control);
        if ((today ? o.today : o.answer) == judgement)
            ceduo_text_format(text, n++ > 0 ? ", '%s'" : "'%s'", r->scene->options[i].name);
    }
    if (n == 0)
        ceduo_text_append(text, _("none"));
}

/* "In every year: none. Uncertain: 'simple coppice'." */
static void append_within_limit(struct text *text, const struct ceduo_report *report, bool today, const char *sentence)
{
    LOCAL_TEXT(passing);
    LOCAL_TEXT(depends);
    append_judged_options(&passing, report, today, CEDUO_JUDGEMENT_YES);
    append_judged_options(&depends, report, today, CEDUO_JUDGEMENT_DEPENDS);
    ceduo_text_append_char(text, ' ');
    ceduo_text_append_with(text, sentence, ceduo_text_string(&passing));
    if (strcmp(ceduo_text_string(&depends), _("none")) != 0)
        ceduo_text_append_joined(text, " ", _("For %s it depends on uncertain inputs."), ceduo_text_string(&depends));
}

static void add_ranking(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_verdict *v = report->verdict;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    ceduo_words_best(text, report->result->scene, v);
    for (char *second = text->bytes ? strchr(text->bytes, '\n') : NULL; second; second = NULL)
        *second = ' ';
    if (!v->accepted || !v->wooded)
        return;
    bool blocks = report->result->scene->blocks_count > 0;
    if (ceduo_report_years_ahead(report, 0))
        append_within_limit(text, report, false,
                            blocks ? _("Within the limit over these years: %s.") : _("Within the limit in every year: %s."));
    else
        append_within_limit(text, report, true, _("Within the limit today: %s."));
}

size_t ceduo_result_best(const struct ceduo_result *r, const struct ceduo_verdict *v)
{
    size_t best = 0;
    if (v && v->rotation.known && v->choices[0].window.kind != CEDUO_WINDOW_CONSTANT)
        return v->rotation.best;
    if (v && v->today.known)
        return v->today.best;
    for (size_t i = 1; r->scene->controls_count > 0 && i < r->scene->options_count; i++)
        if (ceduo_result_last_index(r, i)->dissipated > ceduo_result_last_index(r, best)->dissipated)
            best = i;
    return best;
}

/* Append "mean 190 ±9 of 1000, worst 489 in year 1; today 31 (YES)" below the answer over years. */
static void add_mean(struct ceduo_page *page, const struct ceduo_subject *s)
{
    const struct ceduo_choice *c = ceduo_report_years_ahead(s->report, 0);
    if (!c || c->last_summary->simulated == 0)
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    LOCAL_TEXT(range);
    if (!isnan(s->mean.p5))
        ceduo_text_format(&range, _(" (range %s)"), PLAUSIBLE_RANGE(s->mean));
    ceduo_text_format(text, _("mean %s%s of 1000, worst %.0f in year %u"), WITH_ERROR(s->mean, " "), ceduo_text_string(&range),
                      1000 * c->worst.mean, c->last_summary->worst_year);
    ceduo_text_format(text, _("; today %s"), MEASURE_VALUE(s->today));
    if (s->outcome.today != CEDUO_JUDGEMENT_UNANSWERED)
        ceduo_text_format(text, " (%s)", ceduo_words_judgement_name(s->outcome.today));
}

void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    if (r->scene->controls_count == 0)
        return;
    if (ceduo_page_is_unassessable(r)) /* holds whatever the errors are */
        ceduo_words_too_few_arrivals(ceduo_page_add(page, CEDUO_PAGE_ANSWER), r, r->last_control);
    else if (n > 1 && !r->wooded)
        ceduo_text_append(ceduo_page_add(page, CEDUO_PAGE_ANSWER), _(ceduo_words_by_index));
    else if (n > 1 && report->verdict)
        add_ranking(page, report);
    /* one option: a line for each judged control and for the last one */
    for (size_t k = 0; n == 1 && !ceduo_page_is_unassessable(r) && k < r->scene->controls_count; k++) {
        if (k != r->last_control && isnan(r->scene->controls[k].accepted))
            continue;
        struct ceduo_subject subject = ceduo_subject_find(report, 0, k);
        subject.mean_shown = k == r->last_control;
        ceduo_words_answer(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &subject, page->width - CEDUO_ANSWER_INDENT);
        if (subject.mean_shown)
            add_mean(page, &subject);
    }
}

/* ---- certainty ---- */

/* Append "447–510 by the number of rocks (999)". */
static void append_sampling(struct text *text, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    unsigned long rocks = (unsigned long)ceduo_result_rocks(r);
    const struct ceduo_arrivals *bare = &r->bare.arrivals[r->last_control];
    double today = 0, mean = 0;
    LOCAL_TEXT(error);
    for (size_t i = 0; v && i < v->n; i++) {
        today = fmax(today, v->choices[i].today.half);
        if (v->choices[i].window.kind != CEDUO_WINDOW_CONSTANT)
            mean = fmax(mean, v->choices[i].mean.half);
    }
    if (!r->wooded) {
        double half_width = ceduo_measure_figure(CEDUO_MEAN_KJ, bare).half_width;
        if (isnan(half_width))
            ceduo_text_append(&error, _("the mean of a single rock has none"));
        else
            ceduo_text_format(&error, _("mean \xc2\xb1%s kJ"), SIG(half_width, 2));
    } else if (r->scene->options_count == 1) {
        const struct ceduo_measure m = ceduo_measure_exceeding(last_control(r), ceduo_result_wooded(r, 0, r->last_control));
        ceduo_text_append(&error, SPAN(m, m.lo, m.hi));
    } else if (mean > 0) {
        ceduo_text_format(text,
                          ngettext("Sampling error: \xc2\xb1%.0f today (%lu rock), \xc2\xb1%.0f over years (%lu each).",
                                   "Sampling error: \xc2\xb1%.0f today (%lu rocks), \xc2\xb1%.0f over years (%lu each).",
                                   rocks),
                          ceil(1000 * today), rocks, ceil(1000 * mean), (unsigned long)v->choices[0].rocks);
    } else {
        ceduo_text_format(&error, "\xc2\xb1%.0f", ceil(1000 * today));
    }
    if (error.length > 0)
        ceduo_text_format(text, ngettext("Sampling error (%lu rock): %s.", "Sampling error (%lu rocks): %s.", rocks), rocks,
                          error.bytes);
}

/* True if a control before the last has an answer. */
static bool judges_others(const struct ceduo_result *r)
{
    bool any = false;
    for (size_t k = 0; k < r->scene->controls_count; k++)
        any |= k != r->last_control && !isnan(r->scene->controls[k].accepted);
    return any;
}

/* Append the uncertainty of the best option, over the rotation if known. */
static void append_uncertainty(struct text *text, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_uncertainty_report *uncertainty = report->uncertainty;
    const struct ceduo_verdict *v = report->verdict && report->verdict->n > 1 ? report->verdict : NULL;
    bool by_rotation = v && v->rotation.known && uncertainty && uncertainty->answer && uncertainty->answer->rotation;
    size_t option = by_rotation ? v->rotation.best : v ? v->today.best : 0;
    const struct ceduo_measure m = ceduo_subject_find(report, option, r->last_control).today;
    if (!uncertainty || !uncertainty->answer) {
        ceduo_text_append_joined(text, " ", "%s.",
                                 uncertainty && (ceduo_uncertainty_is_off(uncertainty) || uncertainty->inputs->n == 0)
                                     ? ceduo_uncertainty_missing_reason(uncertainty)
                                 : uncertainty && uncertainty->too_much
                                     ? _("Uncertainty was not computed, because it takes long; --sensitivity computes it")
                                     : _("Uncertainty was not computed"));
        return;
    }
    if (r->scene->options_count == 1 && r->wooded && !isnan(m.p5)) {
        LOCAL_TEXT(place);
        ceduo_words_place(&place, last_control(r));
        if (judges_others(r))
            ceduo_text_append_joined(text, " ", _("Uncertain inputs: %s, considered for %s alone."), SPAN(m, m.p5, m.p95),
                                     ceduo_text_string(&place));
        else
            ceduo_text_append_joined(text, " ", _("Uncertain inputs: %s."), SPAN(m, m.p5, m.p95));
    }
    if (uncertainty->answer->orders_count > 0) {
        ceduo_text_append_char(text, ' ');
        ceduo_uncertainty_order_words(text, uncertainty, 0); /* certainty of the ranking */
    }
    const struct ceduo_uncertainty_result *a = uncertainty->answer;
    ceduo_uncertainty_advice(
        text, uncertainty, ceduo_uncertainty_find_figure(a, ceduo_uncertainty_advised_option(uncertainty), a->main, false), 1);
    LOCAL_TEXT(points);
    ceduo_uncertainty_points(&points, uncertainty);
    ceduo_text_append_joined(text, points.length > 0 ? " " : "", "%s", ceduo_text_string(&points));
}

void ceduo_page_certainty(struct ceduo_page *page, const struct ceduo_report *report)
{
    if (ceduo_page_is_unassessable(report->result))
        return;
    struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, _("HOW SURE"));
    append_sampling(text, report);
    append_uncertainty(text, report);
}

/* ---- over the years ---- */

void ceduo_page_over_time(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_choice *c = v && v->n == 1 ? &v->choices[0] : NULL; /* several options have a table */
    const struct ceduo_option *option = report->result->scene->options;
    if (!c || c->last_summary->years == 0 || ceduo_page_is_unassessable(report->result))
        return;
    if (c->window.kind == CEDUO_WINDOW_CONSTANT) {
        ceduo_words_window(ceduo_page_item(page, CEDUO_PAGE_POINT, _("OVER TIME")), option);
        return;
    }
    if (c->last_summary->simulated > 0) /* included in the answer */
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_POINT);
    ceduo_text_format(text, ngettext("OVER %zu YEAR", "OVER %zu YEARS", c->last_summary->years), c->last_summary->years);
    ceduo_text_append_char(text, '\t');
    ceduo_text_format(text, _("ADC %s m at the most, in year %u; contact fails in %zu of %zu."), SIG(c->worst.mean, 3),
                      c->last_summary->worst_year, c->last_summary->unprotected_contact, c->last_summary->years);
}

/* ---- sentences and cells shared by pages ---- */

void ceduo_page_limit(struct ceduo_page_cell *head, const struct ceduo_control *c)
{
    const struct ceduo_measure m = ceduo_measure_exceeding(c, NULL);
    bool in_kJ = fabs(c->accepted) < 1e6;
    ceduo_text_append(&head->text, MEASURE_NAME(m, CEDUO_SHORT_HEAD));
    ceduo_text_append(&head->long_text, MEASURE_NAME(m, CEDUO_HEAD));
    if (!isnan(c->accepted))
        ceduo_text_format(&head->shorter, in_kJ ? "> %s kJ" : "> %s MJ", SIG_TRIMMED(c->accepted * (in_kJ ? 1e-3 : 1e-6), 3));
}

void ceduo_page_free_run(struct ceduo_page *page, double share)
{
    ceduo_page_cell_format(page, "%s %%", PERCENT_VS_LIMIT(share, CEDUO_FREE_RUN_MAX));
}

void ceduo_page_yes_no(struct ceduo_page *page, bool yes)
{
    ceduo_page_cell_role(page, yes ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD, yes ? _("yes") : _("NO"));
}

void ceduo_page_warn(void *page, const char *sentence)
{
    ceduo_page_para(page, CEDUO_PAGE_WARNING, "%s", sentence);
}

void ceduo_page_once(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...)
{
    const struct ceduo_page_block *b = page->first;
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(ceduo_page_add(page, kind), format, args);
    va_end(args);
    while (b && strcmp(ceduo_text_string(&b->text), ceduo_text_string(&page->last->text)) != 0)
        b = b->next;
    if (b && b != page->last)
        ceduo_page_drop(page);
}

void ceduo_page_warn_once(void *page, const char *sentence)
{
    ceduo_page_once(page, CEDUO_PAGE_WARNING, "%s", sentence);
}

void ceduo_page_note(void *page, const char *sentence)
{
    ceduo_page_para(page, CEDUO_PAGE_NOTE, "%s", sentence);
}
