/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_PARTS_H
#define CEDUO_PAGE_PARTS_H

#include "page.h"
#include "report.h"

/* Page of a result, one file for each subject. Each function appends blocks. */

/* Return the control at which options are compared. */
static inline const struct ceduo_control *last_control(const struct ceduo_result *r)
{
    return &r->scene->controls[r->last_control];
}

/* First part of a page (page_answer.c): question, answer, its certainty, and its development over the years. Nothing without
 * a control, or if it cannot be judged. */
void ceduo_page_question(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_certainty(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_over_time(struct ceduo_page *page, const struct ceduo_report *report);
/* Return the best option over the years, or today if they are unknown. By the index: the option whose stems absorb most.
 * `verdict` may be NULL. */
size_t ceduo_result_best(const struct ceduo_result *result, const struct ceduo_verdict *verdict);

/* Append the whole answer on one screen, with its assumptions. */
void ceduo_page_short(struct ceduo_page *page, const struct ceduo_report *report);

/* Append warnings about an option's stands, and the regional rules that they break; `all`: each rule. Sentences of belts
 * with one stand are merged. */
void ceduo_page_stand_warnings(struct ceduo_page *page, const struct ceduo_result *result, size_t option);
void ceduo_page_stand_rules(struct ceduo_page *page, const struct ceduo_result *result, size_t option, bool all);

/* Append the rules for the stands of all options as a table with sources; nothing if no coppice has rules. */
void ceduo_page_rules(struct ceduo_page *page, const struct ceduo_result *result);

/* Append rock, slope and rocks, a line each. */
void ceduo_page_facts(struct ceduo_page *page, const struct ceduo_report *report);

/* Append all figures of an option at each control, without heading; arrivals without forest if there is one option only. */
void ceduo_page_option(struct ceduo_page *page, const struct ceduo_report *report, size_t option, bool bare);

/* Append the table of options, or `rows` of them from `first` on. The name of `cursor` is in its role (SIZE_MAX: none). */
enum ceduo_options {
    CEDUO_OPTIONS_SHORT,
    CEDUO_OPTIONS_TODAY,
    CEDUO_OPTIONS_YEARS,
    CEDUO_OPTIONS_PANE,
    CEDUO_OPTIONS_BARS,
    CEDUO_OPTIONS_LAWS,    /* by both energy laws */
    CEDUO_OPTIONS_RATES,   /* rates of rocks, by intensity */
    CEDUO_OPTIONS_RETURNS, /* energies of return periods */
    CEDUO_OPTIONS_OF_YEARS,
    CEDUO_OPTIONS_REST, /* columns of today and of the years that the short table lacks */
    CEDUO_OPTIONS_KINDS
};
void ceduo_page_options(struct ceduo_page *page, const struct ceduo_report *report, enum ceduo_options kind, size_t control,
                        size_t cursor, size_t first, size_t rows);
/* Append the caption of that table: the meaning of its shares, at the last control. `years`: also the years. */
void ceduo_page_shares(struct ceduo_page *page, const struct ceduo_report *report, bool years);
/* Append the energy of return period i. `hazard` may be NULL. */
void ceduo_page_return(struct ceduo_page *page, const struct ceduo_hazard *hazard, size_t i);

/* Append the years of an option with their summary; the summary only; all options in one table with a row per year; all
 * options today and over the years, with all columns, with those that the short table lacks, or without tables. */
void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option);
void ceduo_page_years_words(struct ceduo_page *page, const struct ceduo_result *result, const struct ceduo_years *years);
void ceduo_page_years_all_options(struct ceduo_page *page, const struct ceduo_report *report);
enum ceduo_comparison { CEDUO_COMPARE_ALL, CEDUO_COMPARE_REST, CEDUO_COMPARE_WORDS };
void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_report *report, enum ceduo_comparison what);

/* Append a comparison of both energy laws; nothing if unknown. */
void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_report *report);
/* Append frequency and energy at a control; nothing if the scene has no blocks. `first`: also the method. */
bool ceduo_report_has_hazard(const struct ceduo_report *report);
void ceduo_page_hazard(struct ceduo_page *page, const struct ceduo_report *report, size_t control, bool first);

/* Append arrivals at a control with forest and, if `with_bare`, without. The number of figures fits a screen of `lines`
 * lines. */
#define CEDUO_LINES_SHORT 17 /* lines of the short page */
#define CEDUO_LINES_ALL   1000
void ceduo_page_arrivals(struct ceduo_page *page, const struct ceduo_subject *subject, int lines, bool with_bare);

/* Append the three tests of an option with their limits, and the result by the index. */
void ceduo_page_tests(struct ceduo_page *page, const struct ceduo_subject *subject, int lines);

/* Append percentiles of arriving rocks with intervals, with forest (SIZE_MAX: none) and without. */
void ceduo_page_percentiles(struct ceduo_page *page, const struct ceduo_result *result, size_t option, size_t control,
                            bool bare);

/* Append the answer about the fences (page_fence.c): the fence that is enough without and with forest, today and over the
 * years. With several options: of the best one. Nothing without a fence. `brief`: without rates. */
void ceduo_page_fence_answer(struct ceduo_page *page, const struct ceduo_report *report, bool brief);
/* Append which class of each height is enough at a control; nothing without a fence. */
void ceduo_page_fence(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control);
/* Append design values and their factors, if the scene requests them. */
void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control);

/* Append energies to compare with the limit of the last control: of the rocks of an option, of a car, and of the classes of
 * fences. */
void ceduo_page_energies(struct ceduo_page *page, const struct ceduo_report *report, size_t option);

/* Append warnings of the whole run and assumptions; assumptions only, with or without their places in the scene. */
void ceduo_page_notes(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_assumed(struct ceduo_page *page, const struct ceduo_report *report, bool places);

/* ---- shared sentences and cells ---- */

/* Write the head of the column of the judged share: "> 50 kJ", or "arrive" without an accepted energy. */
void ceduo_page_limit(struct ceduo_page_cell *head, const struct ceduo_control *control);
void ceduo_page_free_run(struct ceduo_page *page, double share);
void ceduo_page_yes_no(struct ceduo_page *page, bool yes); /* yes, NO */

/* Append a warning or a note; the context is the page. */
void ceduo_page_warn(void *page, const char *sentence);
void ceduo_page_note(void *page, const char *sentence);
void ceduo_page_warn_once(void *page, const char *sentence);
/* Append a sentence unless the page contains it. */
void ceduo_page_once(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...) CEDUO_PAGE_FORMAT(3);

#endif
