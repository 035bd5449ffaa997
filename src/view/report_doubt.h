/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_DOUBT_H
#define CEDUO_REPORT_DOUBT_H

#include "ceduo/doubt.h"
#include "ceduo/result.h"
#include "io/scene_file.h"
#include "study/verdict.h"
#include "words.h"

struct ceduo_measure; /* measure.h, which needs this file */

/* What doubt does to a scene. */
struct ceduo_doubt_report {
    struct scene_file *file; /* its scene is only read, but by paths */
    const struct scene_inputs *inputs;
    const struct ceduo_doubt_answer *answer; /* NULL: nothing is in doubt, nothing was computed */
    size_t points;
    uint64_t rocks;
    const struct ceduo_result *finer;  /* figures of the scene as it is from more rocks; NULL: those of the answer */
    const struct ceduo_verdict *years; /* likewise those of its years */
    bool over;                         /* the main figure is the mean over the rotation, which the answer has */
    bool too_much;                     /* it was not computed because it would take too long */
};

/* The figure that all is about: too much energy where that is known, otherwise energy; or its mean over the rotation. */
const struct ceduo_doubt_figure *ceduo_doubt_main(const struct ceduo_doubt_report *report, size_t option);

/* Whether the scene asks for no answer; why there is none: that, or nothing is in doubt. */
bool ceduo_doubt_is_off(const struct ceduo_doubt_report *report);
const char *ceduo_doubt_none(const struct ceduo_doubt_report *report);

/* It in the unit shown, of 1000 rocks or kJ per released rock: in the scene as it is, with the error of the rocks, and what may be
 * true (NaN: perhaps one option alone was asked for). `*rocks`, where given: of how many it is; over a rotation of each year. */
struct ceduo_measure ceduo_doubt_measure(const struct ceduo_doubt_report *report, size_t option, uint64_t *rocks);

/* By what the main figure is shown, of 1000 rocks or kJ per released rock. */
double ceduo_doubt_scale(const struct ceduo_doubt_report *report);
void ceduo_doubt_value(struct text *text, enum ceduo_doubt_kind kind, double value); /* of any figure, so shown */

/* The share of an input in a figure as it is shown, from 0 to 1: an estimate may lie outside. */
double ceduo_doubt_share(const struct ceduo_doubt_figure *figure, size_t group);

/* What people call an input: "diameter, ADS 1"; "energy law". */
void ceduo_doubt_input_name(struct text *text, const struct ceduo_doubt_report *report, size_t group);

/* An end of an input's range, 0 or 1, as files have it; of words `*word` is the first or the last, and the value NaN. */
double ceduo_doubt_input_value(const struct ceduo_doubt_report *report, size_t group, int end, const char **word);
void ceduo_doubt_input_end(struct text *text, const struct ceduo_doubt_report *report, size_t group, int end);

/* A warning for each input whose value in the scene is not among those that it may have. */
void ceduo_doubt_outside(const struct ceduo_doubt_report *report, ceduo_words_say *say, void *context);

/* What would measure an input, marked for translation; NULL: nothing that is known. */
const char *ceduo_doubt_measured(const struct ceduo_doubt_report *report, size_t group);

struct ceduo_page;

/* Adds what was found as blocks: a section with tables and what to measure first; of `all` also the mean over a rotation, and how
 * sure the order of the options is. */
void ceduo_doubt_blocks(struct ceduo_page *page, const struct ceduo_doubt_report *report, bool all);
/* "469 of 1000 (rocks 438–501; doubt 92–740)": the main figure of an option with both errors. */
void ceduo_doubt_both(struct text *text, const struct ceduo_doubt_report *report, size_t option);

/* The option that advice is about: the one that lets least pass today in the mean of plausible cases. */
size_t ceduo_doubt_chosen(const struct ceduo_doubt_report *report);

/* Input n of those to be measured first for a figure, in the order of what is left if they are known. Only inputs that a reader can
 * measure, each name once. SIZE_MAX: there are fewer. */
size_t ceduo_doubt_advised(const struct ceduo_doubt_report *report, const struct ceduo_doubt_figure *figure, size_t n);

/* Adds at most `most` of these inputs, each with what would measure it. */
void ceduo_doubt_advice(struct text *text, const struct ceduo_doubt_report *report, const struct ceduo_doubt_figure *figure,
                        size_t most);

/* Adds the width that is left of a figure's range if an input is known, put into `format`; "no gain" if that is all of it. */
void ceduo_doubt_left(struct text *text, const struct ceduo_doubt_figure *figure, size_t input, const char *format);

/* Adds the number of points, if it is smaller than usual. */
void ceduo_doubt_points(struct text *text, const struct ceduo_doubt_report *report);

/* In how much of what may be true one of two options is better, equal or worse, and how sure that makes the order. */
void ceduo_doubt_order_words(struct text *text, const struct ceduo_doubt_report *report, size_t order);

/* "energy law and friction": what a light depends on above all; false where it does not change within what may be true. */
bool ceduo_doubt_causes(struct text *text, const struct ceduo_doubt_report *report, size_t option, enum ceduo_doubt_kind light);

/* "Whether the test of energy passes depends on …"; nothing where the light does not change within what may be true. */
void ceduo_doubt_light_words(struct text *text, const struct ceduo_doubt_report *report, size_t option, size_t light);
extern const enum ceduo_doubt_kind ceduo_doubt_lights[3]; /* contact, free run, energy */

void ceduo_doubt_page(struct text *text, const struct ceduo_doubt_report *report, bool plain);

#endif
