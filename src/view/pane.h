/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PANE_H
#define CEDUO_PANE_H

#include "page.h"
#include "plot.h"
#include "report.h"

/* Texts of the panes of the terminal program, as blocks of a page: the column of figures next to every view, and the tables
 * of views. */

struct ceduo_pane {
    const struct ceduo_report *report;
    const struct ceduo_year *year; /* year of the column; NULL: today */
    size_t option;
    int height; /* visible lines */
};

/* Append the column: arrivals with and without forest, three tests, the index, warnings. Return the number of warning blocks
 * at its end. */
size_t ceduo_pane_column(struct ceduo_page *page, const struct ceduo_pane *pane);

/* Append all results of an option in words, and remarks about the run. */
void ceduo_pane_words(struct ceduo_page *page, const struct ceduo_pane *pane);

/* Append the effect of uncertainty on the option: both errors, inputs to measure, ranking, causes of failing tests. */
void ceduo_pane_uncertainty(struct ceduo_page *page, const struct ceduo_pane *pane);

/* Append the remarks below the table of options. */
void ceduo_pane_message(struct ceduo_page *page, const struct ceduo_pane *pane);

#endif
