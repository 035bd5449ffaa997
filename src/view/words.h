/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WORDS_H
#define CEDUO_WORDS_H

#include "ceduo/result.h"
#include "base/text.h"

#define KILO 1e-3 /* J in kJ */

/* Results as sentences that a forester understands. Each function adds to `text`. */

/* Takes sentences one by one. */
typedef void ceduo_words_say(void *context, const char *sentence);

/* What is to be said of a belt: one sentence for each bit of its warnings, handed to `say` one by one. */
void ceduo_words_stand_warnings(const struct ceduo_scene *scene, const struct ceduo_belt *belt,
                                const struct ceduo_stand_result *stand, ceduo_words_say *say, void *context);

/* What is to be said of a run as a whole. `tolerance` is 0 where none was asked for. */
struct ceduo_run_remarks {
    double tolerance;
    bool tolerance_met;
    bool ground_assumed;
};
void ceduo_words_run_warnings(const struct ceduo_result *result, const struct ceduo_run_remarks *remarks,
                              ceduo_words_say *say, void *context);

/* The three lights of an option at a control, each with its reason: contact, free run, energy. */
void ceduo_words_contact(struct text *text, const struct ceduo_result *result, size_t option, size_t control);
void ceduo_words_free_run(struct text *text, const struct ceduo_result *result, size_t option, size_t control);
void ceduo_words_energy(struct text *text, const struct ceduo_result *result, size_t option, size_t control);

/* Which option is best by contact and which by energy at the last control, where that can be said; nothing otherwise. */
void ceduo_words_best(struct text *text, const struct ceduo_result *result);

const char *ceduo_words_light(enum ceduo_light light);   /* pass, fail, unknown */
const char *ceduo_words_verdict(enum ceduo_light light); /* passes, FAILS, unknown */

/* What a place bears, in kJ, as its file says it: 3.3, which a product with 0.001 makes 3.3000000000000003. */
double ceduo_words_accepted(const struct ceduo_control *control);

/* "991 (984–995)": of 1000 rocks, with the 95 % interval. */
void ceduo_words_of_1000(struct text *text, double probability, double lo, double hi);

/* A number with so many significant digits, never in exponent form where that can be avoided. "-" where it is NaN,
 * "none" where infinite. */
void ceduo_words_number(struct text *text, double value, int digits);

#endif
