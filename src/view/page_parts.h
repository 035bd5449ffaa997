/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_PARTS_H
#define CEDUO_PAGE_PARTS_H

#include "page.h"
#include "report.h"

/* The page of a result, one file for each subject; each function adds blocks. */

/* What is read first (page_answer.c): the question of a scene; its answer, a line or some sentences; how sure that is, and what it
 * becomes over the years. Nothing where no place is asked for, or nothing can be said. */
void ceduo_page_question(struct ceduo_page *page, const struct ceduo_result *result);
void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_sure(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_over(struct ceduo_page *page, const struct ceduo_report *report);
/* The option that is best over the years, or today if they are not known; by the index the one whose stems take most. `verdict` may
 * be NULL. */
size_t ceduo_result_best(const struct ceduo_result *result, const struct ceduo_verdict *verdict);

/* All of that on one screen, with what is assumed. */
void ceduo_page_short(struct ceduo_page *page, const struct ceduo_report *report);

/* What is to be warned of in the stands of an option, and what of the rules of a region they do not meet; `all`: what those ask of
 * them. Belts of one stand share such sentences: each stands on a page once. */
void ceduo_page_stand_warnings(struct ceduo_page *page, const struct ceduo_result *result, size_t option);
void ceduo_page_stand_rules(struct ceduo_page *page, const struct ceduo_result *result, size_t option, bool all);

/* What the rules ask of the stands of all options, as a table with their sources; nothing where no coppice has rules. */
void ceduo_page_rules(struct ceduo_page *page, const struct ceduo_result *result);

/* Rock, slope and rocks, a line each. */
void ceduo_page_facts(struct ceduo_page *page, const struct ceduo_report *report);

/* All of an option at each control, but for its heading; what arrives without forest where there is one option alone. */
void ceduo_page_option(struct ceduo_page *page, const struct ceduo_report *report, size_t option, bool bare);

/* The table of options, or the part of it that a page, a pane or a picture shows: at a control, `rows` options from `first` on, the
 * name of `cursor` (SIZE_MAX: none) in its role. */
enum ceduo_options {
    CEDUO_OPTIONS_SHORT,
    CEDUO_OPTIONS_TODAY,
    CEDUO_OPTIONS_YEARS,
    CEDUO_OPTIONS_PANE,
    CEDUO_OPTIONS_BARS,
    CEDUO_OPTIONS_LAWS,    /* by both energy laws */
    CEDUO_OPTIONS_RATES,   /* of rocks, by their intensity */
    CEDUO_OPTIONS_RETURNS, /* energies of return periods */
    CEDUO_OPTIONS_OF_YEARS,
    CEDUO_OPTIONS_KINDS
};
void ceduo_page_options(struct ceduo_page *page, const struct ceduo_report *report, enum ceduo_options kind, size_t control,
                        size_t cursor, size_t first, size_t rows);
/* The caption of that table: what its shares are of, at the last control; with `years` also which years. */
void ceduo_page_shares(struct ceduo_page *page, const struct ceduo_report *report, bool years);
/* Cell of the energy of return period i; `hazard` may be NULL (not known). */
void ceduo_page_return(struct ceduo_page *page, const struct ceduo_hazard *hazard, size_t i);

/* An option year by year, with what is to be said of the years together, and these words alone; all options in one table, a row for
 * each year; all options side by side, today and over the years. */
void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option);
void ceduo_page_years_words(struct ceduo_page *page, const struct ceduo_result *result, const struct ceduo_years *years);
void ceduo_page_years_beside(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_report *report);

/* The energy law of the scene against the other one; nothing where that is not known. */
void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_report *report);
/* How often, and with how much, at a control; nothing where the scene has no blocks. The first also says how that is known. */
bool ceduo_report_has_hazard(const struct ceduo_report *report);
void ceduo_page_hazard(struct ceduo_page *page, const struct ceduo_report *report, size_t control, bool first);

/* What arrives at a control through the forest of a subject and, `with_bare`, without it: as many figures as a screen of so many lines
 * has room for, or all of them. */
#define CEDUO_LINES_SHORT 17 /* of the short page */
#define CEDUO_LINES_WHOLE 1000
void ceduo_page_arrivals(struct ceduo_page *page, const struct ceduo_subject *subject, int lines, bool with_bare);

/* The three tests of an option with their limits, and what the index says. */
void ceduo_page_tests(struct ceduo_page *page, const struct ceduo_subject *subject, int lines);

/* Percentiles of the rocks that arrive at a control, with their intervals: through the forest of an option (SIZE_MAX: none), and
 * without forest. */
void ceduo_page_percentiles(struct ceduo_page *page, const struct ceduo_result *result, size_t option, size_t control,
                            bool bare);

/* Design values, each factor named, where the scene asks for them. */
void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control);

/* Warnings of the whole run, and assumptions; these alone, with the places in the scene that make them or without. */
void ceduo_page_notes(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_assumed(struct ceduo_page *page, const struct ceduo_report *report, bool places);

/* ---- words and cells that several of them use ---- */

/* Write the head of a column of the share that a control is judged by: "> 50 kJ", or "arrive" without an accepted energy. */
void ceduo_page_limit(struct ceduo_page_cell *head, const struct ceduo_control *control);
void ceduo_page_free_run(struct ceduo_page *page, double share);
void ceduo_page_yes(struct ceduo_page *page, bool yes); /* yes, NO */

/* Adds a warning, or a note; the context is the page. */
void ceduo_page_warn(void *page, const char *sentence);
void ceduo_page_note(void *page, const char *sentence);
void ceduo_page_warn_once(void *page, const char *sentence);
/* Adds a sentence unless the page has it already. */
void ceduo_page_once(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...) CEDUO_PAGE_FORMAT(3);

#endif
