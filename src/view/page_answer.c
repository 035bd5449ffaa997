/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read first, on the short page as in the whole one and in the report: the question that a scene asks, its answer, how
 * sure that is, which more rocks and which only measuring makes surer, and what it becomes over the years. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "page_parts.h"
#include "plot.h"

/* The last control, up to which all is compared. */
static const struct ceduo_control *place_of(const struct ceduo_result *r)
{
    return &r->scene->controls[r->last_control];
}

bool ceduo_page_is_unassessable(const struct ceduo_result *r)
{
    return r->scene->controls_count == 0 || ceduo_too_few_arrivals(&r->bare.arrivals[r->last_control]);
}

void ceduo_page_question(struct ceduo_page *page, const struct ceduo_result *r)
{
    if (r->scene->controls_count == 0)
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_QUESTION);
    LOCAL_TEXT(place);
    ceduo_words_place(&place, place_of(r));
    const char *where = ceduo_text_string(&place), *withstands = SHORTEST(ceduo_words_accepted(place_of(r)));
    size_t n = r->scene->options_count;
    bool accepted = !isnan(place_of(r)->accepted);
    LOCAL_TEXT(limited);
    if (place_of(r)->name)
        ceduo_text_format(&limited, _("%s (%s m, limit %s kJ)"), NAME_OF(place_of(r)), SHORTEST(place_of(r)->x_given),
                          withstands);
    else
        ceduo_text_format(&limited, _("%s m (limit %s kJ)"), SHORTEST(place_of(r)->x_given), withstands);
    struct ceduo_window window = ceduo_window_in(r->scene);
    unsigned years = window.kind == CEDUO_WINDOW_AHEAD ? window.last : 0;
    if (n == 1 && accepted && years > 0)
        ceduo_text_format(text,
                          ngettext("Does the forest protect %s over the next %u year?",
                                   "Does the forest protect %s over the next %u years?", years),
                          limited.bytes, years);
    else if (n == 1 && accepted)
        ceduo_text_format(text, _("Does the forest protect %s?"), limited.bytes);
    else if (n == 1)
        ceduo_text_format(text, _("How many rocks does the forest keep from %s?"), where);
    else if (accepted)
        ceduo_text_format(text, _("Which of %zu treatments is best for %s?"), n, limited.bytes);
    else
        ceduo_text_format(text, _("Which of %zu treatments keeps most rocks from %s?"), n, where);
}

/* ---- the answer ---- */

/* Which options get one judgement, "none" or their names: today, or over the years. */
static void append_judged(struct text *text, const struct ceduo_report *report, bool today, enum ceduo_judgement judgement)
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
static void append_keepers(struct text *text, const struct ceduo_report *report, bool today, const char *sentence)
{
    LOCAL_TEXT(keepers);
    LOCAL_TEXT(open);
    append_judged(&keepers, report, today, CEDUO_YES);
    append_judged(&open, report, today, CEDUO_DEPENDS);
    ceduo_text_char(text, ' ');
    ceduo_append_with(text, sentence, ceduo_text_string(&keepers));
    if (strcmp(ceduo_text_string(&open), _("none")) != 0)
        ceduo_text_append_joined(text, " ", _("It depends on uncertain inputs for %s."), ceduo_text_string(&open));
}

static void answer_many(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_verdict *v = report->verdict;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    ceduo_words_best(text, report->result->scene, v);
    for (char *second = text->bytes ? strchr(text->bytes, '\n') : NULL; second; second = NULL)
        *second = ' ';
    if (!v->accepted || !v->wooded)
        return;
    bool blocks = report->result->scene->blocks_count > 0;
    if (ceduo_report_ahead(report, 0))
        append_keepers(text, report, false,
                       blocks ? _("Within the limit over these years: %s.") : _("Within the limit in every year: %s."));
    else
        append_keepers(text, report, true, _("Within the limit today: %s."));
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

/* Below the answer over years: "mean 190 ±9 of 1000, worst 489 in year 1; today 31 (YES)". */
static void say_mean(struct ceduo_page *page, const struct ceduo_subject *s)
{
    const struct ceduo_choice *c = ceduo_report_ahead(s->report, 0);
    if (!c || c->over->simulated == 0)
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    LOCAL_TEXT(range);
    if (!isnan(s->mean.may_lo))
        ceduo_text_format(&range, _(" (range %s)"), MAY_BE(s->mean));
    ceduo_text_format(text, _("mean %s%s of 1000, worst %.0f in year %u"), WITH_ERROR(s->mean, " "), ceduo_text_string(&range),
                      1000 * c->worst.mean, c->over->worst_year);
    ceduo_text_format(text, _("; today %s"), VALUE_OF(s->today));
    if (s->outcome.today != CEDUO_UNANSWERED)
        ceduo_text_format(text, " (%s)", ceduo_words_decided(s->outcome.today));
}

void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    if (r->scene->controls_count == 0)
        return;
    if (ceduo_page_is_unassessable(r)) /* neither error changes that */
        ceduo_words_nothing(ceduo_page_add(page, CEDUO_PAGE_ANSWER), r, r->last_control);
    else if (n > 1 && !r->wooded)
        ceduo_text_append(ceduo_page_add(page, CEDUO_PAGE_ANSWER), _(ceduo_words_by_index));
    else if (n > 1 && report->verdict)
        answer_many(page, report);
    /* of one option a line for each place that is judged, and for the last one */
    for (size_t k = 0; n == 1 && !ceduo_page_is_unassessable(r) && k < r->scene->controls_count; k++) {
        if (k != r->last_control && isnan(r->scene->controls[k].accepted))
            continue;
        struct ceduo_subject subject = ceduo_subject_find(report, 0, k);
        subject.apart = k == r->last_control;
        ceduo_words_answer(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &subject, page->width - CEDUO_ANSWER_INDENT);
        if (subject.apart)
            say_mean(page, &subject);
    }
}

/* ---- how sure ---- */

/* "447–510 by the number of rocks (999)" */
static void say_sampling(struct text *text, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    unsigned long long rocks = (unsigned long long)ceduo_result_rocks(r);
    const struct ceduo_arrivals *bare = &r->bare.arrivals[r->last_control];
    double today = 0, mean = 0;
    LOCAL_TEXT(error);
    for (size_t i = 0; v && i < v->n; i++) {
        today = fmax(today, v->choices[i].today.half);
        if (v->choices[i].window.kind != CEDUO_WINDOW_CONSTANT)
            mean = fmax(mean, v->choices[i].mean.half);
    }
    if (!r->wooded) {
        ceduo_text_format(&error, _("mean \xc2\xb1%s kJ"), WRITTEN(ceduo_measured(CEDUO_MEAN_KJ, bare).half, 2));
    } else if (r->scene->options_count == 1) {
        const struct ceduo_measure m = ceduo_measure_exceeding(place_of(r), ceduo_result_wooded(r, 0, r->last_control));
        ceduo_text_append(&error, SPAN(m, m.lo, m.hi));
    } else if (mean > 0) {
        ceduo_text_format(text, _("Sampling error: \xc2\xb1%.0f today (%llu rocks), \xc2\xb1%.0f over years (%llu each)."),
                          ceil(1000 * today), rocks, ceil(1000 * mean), (unsigned long long)v->choices[0].rocks);
    } else {
        ceduo_text_format(&error, "\xc2\xb1%.0f", ceil(1000 * today));
    }
    if (error.length > 0)
        ceduo_text_format(text, _("Sampling error (%llu rocks): %s."), rocks, error.bytes);
}

/* Of the best option; over the rotation where its uncertainty is known. */
static void say_uncertainty(struct text *text, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_uncertainty_report *uncertainty = report->uncertainty;
    const struct ceduo_verdict *v = report->verdict && report->verdict->n > 1 ? report->verdict : NULL;
    bool over = v && v->rotation.known && uncertainty && uncertainty->answer && uncertainty->answer->rotation;
    size_t option = over ? v->rotation.best : v ? v->today.best : 0;
    const struct ceduo_measure m = ceduo_subject_find(report, option, r->last_control).today;
    if (!uncertainty || !uncertainty->answer) {
        ceduo_text_append_joined(text, " ", "%s.",
                                 uncertainty && (ceduo_uncertainty_is_off(uncertainty) || uncertainty->inputs->n == 0)
                                     ? ceduo_uncertainty_none(uncertainty)
                                 : uncertainty && uncertainty->too_much
                                     ? _("Uncertainty was not computed, because it takes long; --sensitivity computes it")
                                     : _("Uncertainty was not computed"));
        return;
    }
    if (r->scene->options_count == 1 && r->wooded && !isnan(m.may_lo)) {
        ceduo_text_append_joined(text, " ", _("Uncertain inputs: %s."), SPAN(m, m.may_lo, m.may_hi));
    }
    if (uncertainty->answer->orders_count > 0) {
        ceduo_text_char(text, ' ');
        ceduo_uncertainty_order_words(text, uncertainty, 0); /* how sure the best option is */
    }
    const struct ceduo_uncertainty_result *a = uncertainty->answer;
    ceduo_uncertainty_advice(text, uncertainty,
                             ceduo_uncertainty_find_figure(a, ceduo_uncertainty_chosen(uncertainty), a->main, false), 1);
    LOCAL_TEXT(points);
    ceduo_uncertainty_points(&points, uncertainty);
    ceduo_text_append_joined(text, points.length > 0 ? " " : "", "%s", ceduo_text_string(&points));
}

void ceduo_page_sure(struct ceduo_page *page, const struct ceduo_report *report)
{
    if (ceduo_page_is_unassessable(report->result))
        return;
    struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, _("HOW SURE"));
    say_sampling(text, report);
    say_uncertainty(text, report);
}

/* ---- over the years ---- */

void ceduo_page_over(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_choice *c = v && v->n == 1 ? &v->choices[0] : NULL; /* of several a table says it */
    const struct ceduo_option *option = report->result->scene->options;
    if (!c || c->over->years == 0 || ceduo_page_is_unassessable(report->result))
        return;
    if (c->window.kind == CEDUO_WINDOW_CONSTANT) {
        ceduo_words_window(ceduo_page_item(page, CEDUO_PAGE_POINT, _("OVER TIME")), option);
        return;
    }
    if (c->over->simulated > 0) /* the answer says it */
        return;
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_POINT);
    ceduo_text_format(text, ngettext("OVER %zu YEAR", "OVER %zu YEARS", c->over->years), c->over->years);
    ceduo_text_char(text, '\t');
    ceduo_text_format(text, _("ADC %s m at the most, in year %u; contact fails in %zu of %zu."), WRITTEN(c->worst.mean, 3),
                      c->over->worst_year, c->over->unprotected_contact, c->over->years);
}

/* ---- words and cells that several pages use ---- */

void ceduo_page_limit(struct ceduo_page_cell *head, const struct ceduo_control *c)
{
    const struct ceduo_measure m = ceduo_measure_exceeding(c, NULL);
    bool kilo = fabs(c->accepted) < 1e6;
    ceduo_text_append(&head->text, NAMED(m, CEDUO_SHORT_HEAD));
    ceduo_text_append(&head->written, NAMED(m, CEDUO_HEAD));
    if (!isnan(c->accepted))
        ceduo_text_format(&head->shorter, kilo ? "> %s kJ" : "> %s MJ", ROUNDED(c->accepted * (kilo ? 1e-3 : 1e-6), 3));
}

void ceduo_page_free_run(struct ceduo_page *page, double share)
{
    ceduo_page_cell_format(page, "%s %%", PERCENT(share, CEDUO_FREE_RUN_MAX));
}

void ceduo_page_yes(struct ceduo_page *page, bool yes)
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
