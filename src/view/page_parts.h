/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_PARTS_H
#define CEDUO_PAGE_PARTS_H

#include "page.h"
#include "report.h"

/* The page of a result, cut by subject: each of these adds blocks. Tables need so many columns; a page with fewer says the same
 * in sentences. */
#define CEDUO_PAGE_WIDTH 80

void ceduo_page_option(struct ceduo_page *page, const struct ceduo_report *report, size_t option);

/* The belts of an option and what their stems could take, by the index. */
void ceduo_page_belts(struct ceduo_page *page, const struct ceduo_report *report, size_t option);
void ceduo_page_residual(struct ceduo_page *page, const struct ceduo_result *result, size_t option, size_t control);

/* Blocks of other sizes; CEDUO_BLOCKS of them. */
void ceduo_page_sizes(struct ceduo_page *page, const struct ceduo_result *result, const struct ceduo_block *blocks);

/* An option year by year; all options side by side, over the years and as filed. */
void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option);
void ceduo_page_rotations(struct ceduo_page *page, const struct ceduo_report *report);
void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_result *result);

/* What the whole run warns of, and what is assumed. */
void ceduo_page_notes(struct ceduo_page *page, const struct ceduo_report *report);

/* ---- words that several of them use ---- */

/* Of those that arrive with too much energy, or where that is not said of all; a cell with "-" for NULL. */
void ceduo_page_share(struct ceduo_page *page, const struct ceduo_arrivals *arrivals);
/* "480 ±10": of 1000, with its sign where it is a difference; "-" for NaN. */
void ceduo_page_per_1000(struct ceduo_page *page, double mean, double half, bool sign);
/* The head of a column of shares: what is too much at a place, or where that is not said, `otherwise`. */
void ceduo_page_limit(struct ceduo_page *page, const struct ceduo_control *control, const char *otherwise);
void ceduo_page_percent(struct ceduo_page *page, double share);
void ceduo_page_verdict(struct ceduo_page *page, enum ceduo_light light); /* pass, FAIL, ? */

/* A warning of the page that is the context. */
void ceduo_page_warn(void *page, const char *sentence);

#endif
