/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_REPORT_H
#define CEDUO_PAGE_REPORT_H

#include "page.h"
#include "plot.h"
#include "report.h"
#include "report_doubt.h"

/* A page to hand in: the question and its answer first, then what it rests on, and how to compute it again. */

struct ceduo_chapter {
    const struct ceduo_report *report;
    const struct ceduo_snapshot *snapshot;  /* for the pictures */
    struct ceduo_years *const *years;       /* one for each option; NULL, or NULL of an option: none */
    const struct ceduo_doubt_report *doubt; /* NULL: not computed */
    const char *command;                    /* that gives the same page */
};

#define CEDUO_PAGE_REPORT_WIDTH 80 /* of a page that chapters are added to: tables, not sentences */

/* Adds a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_chapter *chapter);

/* The question and the answer (page_answer.c): how many rocks get through, the error of the rocks, and the doubt. */
void ceduo_page_answer(struct ceduo_page *page, const struct ceduo_chapter *chapter);

/* The option to show: the best one today. */
size_t ceduo_chapter_option(const struct ceduo_chapter *chapter);

#endif
