/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The question that a scene asks and its answer in three sentences: what gets through, the error of the rocks, which
 * more rocks reduce, and the doubt, which only measuring reduces. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "ceduo/assess.h"
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
    size_t index;      /* of the option */
    bool accepted;     /* what the place withstands is given */
    struct text where; /* "road (135 m)" */
    char withstands[CEDUO_NUMBER_ROOM];
};

static double share_of(const struct subject *s, const struct ceduo_arrivals *a)
{
    return 1000 * (s->accepted ? a->exceed_probability : a->reach_probability);
}

/* ---- the question ---- */

static void ask(struct ceduo_page *page, const struct subject *s)
{
    struct text *text = ceduo_page_add(page, CEDUO_PAGE_QUESTION);
    const char *where = ceduo_text_string(&s->where);
    size_t n = s->result->scene->options_count;
    if (n == 1 && s->accepted)
        ceduo_text_format(text, _("Does the forest protect what lies at %s and withstands %s kJ?"), where, s->withstands);
    else if (n == 1)
        ceduo_text_format(text, _("How many rocks does the forest keep from what lies at %s?"), where);
    else if (s->accepted)
        ceduo_text_format(text, _("Which of %zu ways to treat the forest protects best what lies at %s and withstands %s kJ?"),
                          n, where, s->withstands);
    else
        ceduo_text_format(text, _("Which of %zu ways to treat the forest keeps most rocks from what lies at %s?"), n, where);
}

/* ---- the first sentence ---- */

/* "125 of 1000 rocks arrive with more than 50 kJ, 894 without forest": whether that is little enough. */
static void answer_one(struct text *text, const struct subject *s)
{
    enum ceduo_judgement judgement = ceduo_judge(s->bare, s->arrivals);
    double through = share_of(s, s->arrivals), bare = share_of(s, s->bare), most = 1000 * CEDUO_EXCEED_MOST;
    if (!s->accepted)
        ceduo_text_format(text, _("Of 1000 rocks %.0f arrive through the forest, and %.0f would without it."), through, bare);
    else if (judgement == CEDUO_NOT_DECIDED)
        ceduo_text_format(
            text,
            _("Not decided by so many rocks: of 1000 rocks %.0f arrive through the forest with more than that, where %.0f are "
              "allowed; without forest %.0f would."),
            through, most, bare);
    else if (judgement == CEDUO_YES)
        ceduo_text_format(text,
                          _("Yes: of 1000 rocks %.0f arrive through the forest with more than that, where %.0f are allowed; "
                            "without forest %.0f would."),
                          through, most, bare);
    else
        ceduo_text_format(text,
                          _("No: of 1000 rocks %.0f arrive through the forest with more than that, where %.0f are allowed; "
                            "without forest %.0f would."),
                          through, most, bare);
}

/* By the index (Eq. 4 and 5). */
static void answer_by_index(struct text *text, const struct subject *s)
{
    const struct ceduo_index *index = ceduo_result_last_index(s->result, s->index);
    char taken[PLOT_NUMBER_ROOM], mean[PLOT_NUMBER_ROOM], left[PLOT_NUMBER_ROOM];
    ceduo_plot_number(index->dissipated * KILO, 3, taken);
    ceduo_plot_number(s->bare->energy.mean * KILO, 3, mean);
    ceduo_plot_number(index->residual * KILO, 3, left);
    if (s->result->scene->options_count > 1)
        ceduo_text_format(text,
                          _("By the index (Eq. 4 and 5) '%s' leaves least of the %s kJ that a rock brings in the mean: %s "
                            "kJ."),
                          s->option->name, mean, left);
    else
        ceduo_text_format(text,
                          _("By the index (Eq. 4 and 5) stems could take %s of the %s kJ that a rock brings in the mean: %s "
                            "kJ are left."),
                          taken, mean, left);
}

static void answer_many(struct text *text, const struct subject *s)
{
    struct text best = {0};
    ceduo_words_best(&best, s->result->scene, s->chapter->report->verdict);
    for (size_t i = 0; i < best.length; i++)
        best.bytes[i] = best.bytes[i] == '\n' ? ' ' : best.bytes[i];
    ceduo_text_put(text, ceduo_text_string(&best));
    text->failed |= best.failed;
    ceduo_text_free(&best);
}

/* ---- the second: the error of the rocks ---- */

static void say_sampling(struct text *text, const struct subject *s)
{
    const struct ceduo_arrivals *a = s->arrivals;
    unsigned long long rocks = (unsigned long long)ceduo_result_rocks(s->result);
    if (!a) {
        char half[PLOT_NUMBER_ROOM];
        ceduo_plot_number(ceduo_half_width(s->bare->energy.se, s->bare->reached) * KILO, 2, half);
        ceduo_text_format(text,
                          _("Error of the rocks: %llu were simulated, which gives the mean to within %s kJ (95 %%); more "
                            "rocks make that less."),
                          rocks, half);
        return;
    }
    double lo = 1000 * (s->accepted ? a->exceed_lo : a->reach_lo), hi = 1000 * (s->accepted ? a->exceed_hi : a->reach_hi);
    if (s->result->scene->options_count > 1)
        ceduo_text_format(
            text,
            _("Error of the rocks: %llu were simulated, which gives the figure of '%s' today as %.0f\xe2\x80\x93%.0f "
              "of 1000 (95 %%); more rocks make that less."),
            rocks, s->option->name, lo, hi);
    else
        ceduo_text_format(text,
                          _("Error of the rocks: %llu were simulated, which gives the figure as %.0f\xe2\x80\x93%.0f of 1000 "
                            "(95 %%); more rocks make that less."),
                          rocks, lo, hi);
}

/* ---- the third: the doubt ---- */

/* The two ends of what may be true, and how sure the best option is, if there are others. */
static void say_range(struct text *text, const struct subject *s, const struct ceduo_doubt_figure *f)
{
    const struct ceduo_doubt_answer *answer = s->chapter->doubt->answer;
    char lo[PLOT_NUMBER_ROOM], hi[PLOT_NUMBER_ROOM];
    bool energy = answer->main == CEDUO_DOUBT_ENERGY;
    if (energy) {
        ceduo_plot_number(f->p5 * KILO, 3, lo);
        ceduo_plot_number(f->p95 * KILO, 3, hi);
    } else {
        snprintf(lo, sizeof lo, "%.0f", 1000 * f->p5);
        snprintf(hi, sizeof hi, "%.0f", 1000 * f->p95);
    }
    ceduo_text_format(text,
                      energy ? _("Doubt: what is not known of the scene makes the energy per released rock anything from %s to "
                                 "%s kJ (90 %% of what may be true); only measuring makes that less.")
                             : _("Doubt: what is not known of the scene makes it anything from %s to %s of 1000 (90 %% of what "
                                 "may be true); only measuring makes that less."),
                      lo, hi);
    if (answer->orders_count == 0 || answer->orders[0].better != s->index)
        return;
    ceduo_text_char(text, ' ');
    ceduo_doubt_order_words(text, s->chapter->doubt, 0);
}

static void say_doubt(struct text *text, const struct subject *s)
{
    const struct ceduo_doubt_report *doubt = s->chapter->doubt;
    const struct ceduo_doubt_figure *f = ceduo_chapter_doubt(s->chapter, s->index);
    if (f)
        say_range(text, s, f);
    else if (doubt)
        ceduo_text_put(text, ceduo_doubt_none(doubt));
    else
        ceduo_text_put(text, _("Doubt: what is not known of the scene was not computed for this page; the command at its end "
                               "does."));
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

const struct ceduo_doubt_figure *ceduo_chapter_doubt(const struct ceduo_chapter *c, size_t option)
{
    const struct ceduo_doubt_answer *answer = c->doubt ? c->doubt->answer : NULL;
    return answer ? ceduo_doubt_figure_of(answer, option, answer->main, false) : NULL;
}

void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_chapter *c)
{
    const struct ceduo_result *r = c->report->result;
    const struct ceduo_control *control = &r->scene->controls[r->last_control];
    struct subject s = {.chapter = c,
                        .result = r,
                        .control = control,
                        .bare = &r->bare.arrivals[r->last_control],
                        .index = ceduo_chapter_option(c),
                        .accepted = !isnan(control->accepted)};
    s.option = &r->scene->options[s.index];
    s.arrivals = ceduo_result_wooded(r, s.index, r->last_control);
    ceduo_plot_control_name(&s.where, control);
    if (s.accepted)
        ceduo_number_shortest(ceduo_words_accepted(control), s.withstands);
    ask(page, &s);
    struct text *first = ceduo_page_add(page, CEDUO_PAGE_ANSWER);
    bool nothing = ceduo_says_nothing(s.bare);
    if (nothing)
        ceduo_words_nothing(first, r, r->last_control);
    else if (!s.arrivals)
        answer_by_index(first, &s);
    else if (r->scene->options_count > 1 && c->report->verdict)
        answer_many(first, &s);
    else
        answer_one(first, &s);
    if (!nothing) { /* neither error changes that */
        say_sampling(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &s);
        say_doubt(ceduo_page_add(page, CEDUO_PAGE_ANSWER), &s);
    }
    page->failed |= s.where.failed;
    ceduo_text_free(&s.where);
}
