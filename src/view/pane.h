/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PANE_H
#define CEDUO_PANE_H

#include "page.h"
#include "plot.h"
#include "report.h"

/* What the panes of the terminal program say, as blocks of a page: the column of figures that stands beside every view, and the
 * tables of the views. */

struct ceduo_pane {
    const struct ceduo_report *report;
    const struct ceduo_year *year; /* that the column is of; NULL: today */
    size_t option;
    int height; /* lines that are seen at once */
};

/* The column: what arrives with the wood and without, the three tests, what the index says, warnings. Returns how many blocks
 * at its end are warnings. */
size_t ceduo_pane_column(struct ceduo_page *page, const struct ceduo_pane *pane);

/* All of an option in words, and what is to be said of the run. */
void ceduo_pane_words(struct ceduo_page *page, const struct ceduo_pane *pane);

/* What uncertainty means for the option: both errors, what to measure first, whether it separates from others, what tests depend on. */
void ceduo_pane_uncertainty(struct ceduo_page *page, const struct ceduo_pane *pane);

/* What is to be said of the options below their table. */
void ceduo_pane_message(struct ceduo_page *page, const struct ceduo_pane *pane);

#endif
