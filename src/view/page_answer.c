/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The question that a scene asks and its answer in three sentences: what gets through, the error of the rocks, which
 * more rocks reduce, and the doubt, which only measuring reduces. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "page_parts.h"
#include "page_report.h"
#include "plot_parts.h"

/* What the sentences are about. */
struct subject {
    const struct ceduo_chapter *chapter;
    const struct ceduo_result *result;
    const struct ceduo_control *control;
    const struct ceduo_option *option;
    const struct ceduo_arrivals *arrivals; /* through the forest; NULL: by the index */
    const struct ceduo_arrivals *bare;
    size_t index; /* of the option */
};

static void ask(struct ceduo_page *page, const struct subject *s)
{
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_QUESTION);
    LOCAL_TEXT(place);
    ceduo_plot_control_name(&place, s->control);
    const char *where = ceduo_text_string(&place), *withstands = SHORTEST(ceduo_words_accepted(s->control));
    size_t n = s->result->scene->options_count;
    bool accepted = !isnan(s->control->accepted);
    if (n == 1 && accepted)
        ceduo_text_format(text, _("Does the forest protect what lies at %s and withstands %s kJ?"), where, withstands);
    else if (n == 1)
        ceduo_text_format(text, _("How many rocks does the forest keep from what lies at %s?"), where);
    else if (accepted)
        ceduo_text_format(text, _("Which of %zu ways to treat the forest protects best what lies at %s and withstands %s kJ?"),
                          n, where, withstands);
    else
        ceduo_text_format(text, _("Which of %zu ways to treat the forest keeps most rocks from what lies at %s?"), n, where);
}

/* ---- the first sentence ---- */

/* "125 of 1000 rocks arrive with more than 50 kJ, 894 without forest": whether that is little enough. */
static void answer_one(struct text *text, const struct subject *s)
{
    enum ceduo_judgement judgement = ceduo_judge(s->bare, s->arrivals);
    double through = ceduo_judged(s->control, s->arrivals).value, bare = ceduo_judged(s->control, s->bare).value;
    if (isnan(s->control->accepted))
        ceduo_text_format(text, _("Of 1000 rocks %.0f arrive through the forest, and %.0f would without it."), through, bare);
    else
        ceduo_text_format(text,
                          _("%s: of 1000 rocks %.0f arrive through the forest with more than that, where %.0f are allowed; "
                            "without forest %.0f would."),
                          judgement == CEDUO_NOT_DECIDED ? _("Not decided by so many rocks")
                          : judgement == CEDUO_YES       ? _("Yes")
                                                         : _("No"),
                          through, 1000 * CEDUO_EXCEED_MOST, bare);
}

/* By the index (Eq. 4 and 5). */
static void answer_by_index(struct text *text, const struct subject *s)
{
    const struct ceduo_index *index = ceduo_result_last_index(s->result, s->index);
    const char *mean = WRITTEN(s->bare->energy.mean * J_TO_KJ, 3), *left = WRITTEN(index->residual * J_TO_KJ, 3);
    if (s->result->scene->options_count > 1)
        ceduo_text_format(text,
                          _("By the index (Eq. 4 and 5) '%s' leaves least of the %s kJ that a rock brings in the mean: %s "
                            "kJ."),
                          s->option->name, mean, left);
    else
        ceduo_text_format(text,
                          _("By the index (Eq. 4 and 5) stems could take %s of the %s kJ that a rock brings in the mean: %s "
                            "kJ are left."),
                          WRITTEN(index->dissipated * J_TO_KJ, 3), mean, left);
}

static void answer_many(struct text *text, const struct subject *s)
{
    LOCAL_TEXT(best);
    ceduo_words_best(&best, s->result->scene, s->chapter->report->verdict);
    for (size_t i = 0; i < best.length; i++)
        ceduo_text_char(text, best.bytes[i] == '\n' ? ' ' : best.bytes[i]);
}

/* ---- the second: the error of the rocks; the third: the doubt ---- */

static void say_sampling(struct text *text, const struct subject *s)
{
    unsigned long long rocks = (unsigned long long)ceduo_result_rocks(s->result);
    const struct ceduo_measure m = ceduo_judged(s->control, s->arrivals);
    if (!s->arrivals)
        ceduo_text_format(text,
                          _("Error of the rocks: %llu were simulated, which gives the mean to within %s kJ (95 %%); more "
                            "rocks make that less."),
                          rocks, WRITTEN(ceduo_half_width(s->bare->energy.se, s->bare->reached) * J_TO_KJ, 2));
    else if (s->result->scene->options_count > 1)
        ceduo_text_format(
            text,
            _("Error of the rocks: %llu were simulated, which gives the figure of '%s' today as %.0f\xe2\x80\x93%.0f "
              "of 1000 (95 %%); more rocks make that less."),
            rocks, s->option->name, m.lo, m.hi);
    else
        ceduo_text_format(text,
                          _("Error of the rocks: %llu were simulated, which gives the figure as %.0f\xe2\x80\x93%.0f of 1000 "
                            "(95 %%); more rocks make that less."),
                          rocks, m.lo, m.hi);
}

static void say_doubt(struct text *text, const struct subject *s)
{
    const struct ceduo_doubt_report *doubt = s->chapter->doubt;
    const struct ceduo_doubt_answer *a = doubt ? doubt->answer : NULL;
    if (!a) {
        ceduo_text_put(text, doubt
                                 ? ceduo_doubt_none(doubt)
                                 : _("Doubt: what is not known of the scene was not computed for this page; the command at its "
                                     "end does."));
        return;
    }
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(a, s->index, a->main, false);
    LOCAL_TEXT(lo);
    LOCAL_TEXT(hi);
    ceduo_doubt_value(&lo, doubt, f->fit.p5);
    ceduo_doubt_value(&hi, doubt, f->fit.p95);
    ceduo_text_format(
        text,
        a->main == CEDUO_DOUBT_ENERGY
            ? _("Doubt: what is not known of the scene makes the energy per released rock anything from %s to %s "
                "kJ (90 %% of what may be true); only measuring makes that less.")
            : _("Doubt: what is not known of the scene makes it anything from %s to %s of 1000 (90 %% of what may "
                "be true); only measuring makes that less."),
        lo.bytes, hi.bytes);
    const struct ceduo_doubt_ranking *ranking = ceduo_doubt_verdict(a);
    if (ranking->count == 0 || ranking->orders[0].better != s->index)
        return;
    ceduo_text_char(text, ' ');
    ceduo_doubt_order_words(text, doubt, 0); /* how sure the best option is */
}

/* ---- all ---- */

size_t ceduo_chapter_option(const struct ceduo_chapter *c)
{
    const struct ceduo_result *r = c->report->result;
    const struct ceduo_verdict *v = c->report->verdict;
    size_t best = 0;
    if (v && v->today.known)
        return v->today.best;
    for (size_t i = 1; r->scene->controls_count > 0 && i < r->scene->options_count; i++)
        if (ceduo_result_last_index(r, i)->dissipated > ceduo_result_last_index(r, best)->dissipated)
            best = i;
    return best;
}

void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_chapter *c)
{
    const struct ceduo_result *r = c->report->result;
    struct subject s = {.chapter = c,
                        .result = r,
                        .control = &r->scene->controls[r->last_control],
                        .bare = &r->bare.arrivals[r->last_control],
                        .index = ceduo_chapter_option(c)};
    s.option = &r->scene->options[s.index];
    s.arrivals = ceduo_result_wooded(r, s.index, r->last_control);
    ask(page, &s);
    struct text *first = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    if (ceduo_says_nothing(s.bare)) { /* neither error changes that */
        ceduo_words_nothing(first, r, r->last_control);
        return;
    }
    if (!s.arrivals)
        answer_by_index(first, &s);
    else if (r->scene->options_count > 1 && c->report->verdict)
        answer_many(first, &s);
    else
        answer_one(first, &s);
    say_sampling(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &s);
    say_doubt(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &s);
}
