/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WORDS_H
#define CEDUO_WORDS_H

#include "base/text.h"
#include "study/verdict.h"

#define J_TO_KJ 1e-3

/* Size of a formatted string, bytes. */
#define CEDUO_WORDS_SIZE 160

/* Sentences about results, for foresters. Each function appends to `text`. */

/* Callback for each sentence. */
typedef void ceduo_sentence_sink(void *context, const char *sentence);
void ceduo_words_format(ceduo_sentence_sink *sink, void *context, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Append "271 points, 13 after simplifying to 0.5 m" of a profile, or its points alone if none is left out. */
void ceduo_words_points(struct text *text, const struct ceduo_slope *slope);

/* Append "reach angle 37°, shadow angle 34°" of a control, after a comma if the text is not empty; `brief`: without "angle". */
void ceduo_words_topography(struct text *text, const struct ceduo_topography *topography, bool brief);

#define DEGREES (180 / M_PI)

/* Report one sentence for each warning bit of a belt. */
void ceduo_words_stand_warnings(const struct ceduo_scene *scene, const struct ceduo_belt *belt,
                                const struct ceduo_stand_result *stand, ceduo_sentence_sink *sink, void *context);

/* Report only implausible sizes, which may be typing errors. */
void ceduo_words_implausible(const struct ceduo_belt *belt, const struct ceduo_stand_result *r, ceduo_sentence_sink *sink,
                             void *context);

/* Report a stem thicker than the measured range of its species' volume function. */
void ceduo_words_thick_stems(const struct ceduo_belt *belt, ceduo_sentence_sink *sink, void *context);

/* Report warnings of the whole run, except ceduo_words_warn_no_answer(). `tolerance` 0: none requested. */
struct ceduo_run_remarks {
    double tolerance;
    bool tolerance_met;
    bool ground_assumed;
};
void ceduo_words_run_warnings(const struct ceduo_result *result, const struct ceduo_run_remarks *remarks,
                              ceduo_sentence_sink *sink, void *context);

/* Append why a control cannot be judged (ceduo_too_few_arrivals()), and the remedy. The second function reports it for the
 * first such control. */
void ceduo_words_too_few_arrivals(struct text *text, const struct ceduo_result *result, size_t control);
void ceduo_words_warn_no_answer(const struct ceduo_result *result, ceduo_sentence_sink *sink, void *context);

/* Return the judgement's word in files; NULL: unanswered. Append the reason as a sentence. */
const char *ceduo_words_judgement(enum ceduo_judgement judgement);
void ceduo_words_judgement_reason(struct text *text, const struct ceduo_result *result, size_t control,
                                  const struct ceduo_arrivals *wooded); /* may be NULL */

struct ceduo_subject; /* measure.h */

const char *
ceduo_words_judgement_name(enum ceduo_judgement judgement); /* "NO", translated; not for CEDUO_JUDGEMENT_UNANSWERED */
const char *ceduo_words_judgement_mark(enum ceduo_judgement judgement,
                                       char buffer[CEDUO_WORDS_SIZE]); /* "✘ NO"; "": unanswered */
#define JUDGEMENT_MARK(judgement) ceduo_words_judgement_mark(judgement, (char[CEDUO_WORDS_SIZE]){0})

/* Append the reason without the verdict: "in 17 of 25 years more than 50 of 1000 rocks exceed 50 kJ: mean 190, worst 489 in
 * year 1; today 31 (YES)." */
void ceduo_words_reason(struct text *text, const struct ceduo_subject *subject);

/* Append the answer in at most `width` columns, over the years ahead if known: "✘ NO: in 17 of 25 years more than 50 of 1000
 * rocks arrive with more than 50 kJ: mean 190, worst 489 in year 1; today 31 (YES)". A due cut has answers before and after
 * it. The control is named if there are several. Clauses that do not fit are dropped, but never the verdict. */
void ceduo_words_answer(struct text *text, const struct ceduo_subject *subject, size_t width);

/* Report the options whose lights are green today because of thin shoots only. */
void ceduo_words_thin_stems(const struct ceduo_result *result, ceduo_sentence_sink *sink, void *context);

/* Append a test (index into ceduo_light_names) of an option at a control, with its reason. */
void ceduo_words_test(struct text *text, const struct ceduo_result *result, size_t option, size_t control, size_t test);

/* Append the result of the same rocks under the other energy law; nothing if unknown, or if no stem stands. */
void ceduo_words_alternative_law(struct text *text, const struct ceduo_result *result, size_t option, size_t control);

/* Report pairs of options that the energy laws rank differently, up to a maximum number. */
void ceduo_words_rank_reversals(const struct ceduo_result *result, const struct ceduo_verdict *verdict,
                                ceduo_sentence_sink *sink, void *context);

/* Append the best option over the years and today, at the last control, one sentence a line; nothing if unknown. The second
 * function reports options without a rotation. */
void ceduo_words_best(struct text *text, const struct ceduo_scene *scene, const struct ceduo_verdict *verdict);
void ceduo_words_windows(const struct ceduo_scene *scene, ceduo_sentence_sink *sink, void *context);

/* Append why an option has no rotation; nothing if it has one. */
void ceduo_words_window(struct text *text, const struct ceduo_option *option);

/* Append a summary of an option's years: passage, failed tests and expected energy. */
void ceduo_words_years_summary(struct text *text, const struct ceduo_result *result, const struct ceduo_years *years);

/* Append the numbering of years and the rocks simulated in each year (0: by the index). */
void ceduo_words_year_numbering(struct text *text, uint64_t rocks);

/* Return the interval between judged events as a sentence; "13" and "13 (9–14)" years. */
const char *ceduo_words_return_period(struct ceduo_estimate rate, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_words_return_period_range(struct ceduo_estimate rate, char buffer[CEDUO_WORDS_SIZE]);
#define RETURN_PERIOD(rate)       ceduo_words_return_period(rate, (char[CEDUO_WORDS_SIZE]){0})
#define RETURN_PERIOD_RANGE(rate) ceduo_words_return_period_range(rate, (char[CEDUO_WORDS_SIZE]){0})

/* Reasons why energy is not judged, and why options cannot be compared by arrivals. Marked for translation. */
extern const char *const ceduo_words_unjudged, *const ceduo_words_by_index;

extern const char *const ceduo_light_names[3];           /* contact, free run, energy; marked for translation */
const char *ceduo_words_light(enum ceduo_light light);   /* pass, fail, unknown */
const char *ceduo_words_verdict(enum ceduo_light light); /* passes, FAILS, unknown */

/* Return the accepted energy in kJ as written in the file, 3.3; multiplying by 0.001 gives 3.3000000000000003. */
double ceduo_words_accepted(const struct ceduo_control *control);

/* Return the name of a law or rule for people; an unknown word is returned unchanged. */
const char *ceduo_words_law(const char *word);

/* Name of an option, belt or control in the current language; JSON and CSV keep the name of the file. */
#define NAME_OF(x) ((x)->name_given ? ceduo_in_language((x)->name_given, (x)->name) : (x)->name)

/* Append "end of the forest (135 m)" or "135 m". */
void ceduo_words_place(struct text *text, const struct ceduo_control *control);

/* Append a sentence with a string in place of its one %s. */
void ceduo_text_append_with(struct text *text, const char *sentence, const char *string);

/* Append a number with `digits` significant digits, without an exponent if possible. "-": NaN; "none": infinite. */
void ceduo_words_number(struct text *text, double value, int digits);

/* Return the number as a string that lives until the end of the caller's block. */
const char *ceduo_words_sig(double value, int digits, char buffer[CEDUO_NUMBER_SIZE]);
const char *ceduo_words_sig_trimmed(double value, int digits, char buffer[CEDUO_NUMBER_SIZE]);
#define SIG(value, digits) ceduo_words_sig(value, digits, (char[CEDUO_NUMBER_SIZE]){0})
/* Return a figure with enough digits to stay on its side of the limit: 29.98 below 30; a share in percent. */
const char *ceduo_words_against_limit(double value, int digits, double limit, char buffer[CEDUO_NUMBER_SIZE]);
const char *ceduo_words_percent(double share, double limit, char buffer[CEDUO_NUMBER_SIZE]);
#define VS_LIMIT(value, digits, limit) ceduo_words_against_limit(value, digits, limit, (char[CEDUO_NUMBER_SIZE]){0})
#define PERCENT_VS_LIMIT(share, limit) ceduo_words_percent(share, limit, (char[CEDUO_NUMBER_SIZE]){0})
/* Return at most `digits` digits: 12, 0.5, 3e+06. */
#define SIG_TRIMMED(value, digits) ceduo_words_sig_trimmed(value, digits, (char[CEDUO_NUMBER_SIZE]){0})
#define LOCALIZED(value)           ceduo_number_localize(ceduo_number_shortest(value, (char[CEDUO_NUMBER_SIZE]){0}))

#endif
