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

#define CEDUO_PAGE_REPORT_WIDTH 120 /* of a page that chapters are added to: tables, not sentences, and nothing shortened */

/* Adds a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_chapter *chapter);

#endif
