/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_CALIBRATION_H
#define CEDUO_REPORT_CALIBRATION_H

#include "base/text.h"
#include "ceduo/calibrate.h"
#include "io/scene_file.h"

/* What was fitted to what was seen. */
struct ceduo_calibration_report {
    size_t scenes_count;
    const struct scene_file *files;
    const struct ceduo_input *inputs; /* the fitted values */
    uint64_t rocks;
    const struct ceduo_calibration *answer;
};

/* What people call a fitted value: "bounce Rn, talus"; a number of it in the unit that people use. */
void ceduo_calibration_name(struct text *text, const char *path);
void ceduo_calibration_number(struct text *text, const char *path, double value);

/* What was seen, in the unit that files have: m, m/s, kJ, a count. */
double ceduo_seen_shown(const struct scene_file *file, const struct ceduo_predicted *p, double value);
const struct ceduo_observation *ceduo_seen_of(const struct ceduo_calibration_report *report, const struct ceduo_predicted *p);
size_t ceduo_seen_number(const struct ceduo_observation *o);

void ceduo_calibration_page(struct text *text, const struct ceduo_calibration_report *report, bool plain);
/* What the page says in words: misfit, what is not determined, what is known only together. */
struct ceduo_page;
void ceduo_calibration_words(struct ceduo_page *page, const struct ceduo_calibration_report *report);

/* The draws as a table for `doubt: {draws: …}`: a column for each fitted value, whose head is its places in the first scene. */
void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration_report *report);

/* "48 stops; 95 % .44–.51": where the fitted values come from. */
void ceduo_calibration_sources(struct text *text, const struct ceduo_calibration_report *report);

#endif
