/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WORDS_H
#define CEDUO_WORDS_H

#include "base/text.h"
#include "ceduo/result.h"
#include "ceduo/years.h"
#include "study/verdict.h"

#define J_TO_KJ 1e-3

/* Bytes of a string that lives as long as the block that asks for it. */
#define CEDUO_WORDS_ROOM 160

/* Results as sentences that a forester understands. Each function adds to `text`. */

/* Takes sentences one by one. */
typedef void ceduo_sentence_sink(void *context, const char *sentence);
void ceduo_words_format(ceduo_sentence_sink *say, void *context, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Append "271 points, 13 after simplifying to 0.5 m" of a profile, or its points alone if none is left out. */
void ceduo_words_points(struct text *text, const struct ceduo_slope *slope);

/* Append "reach angle 37°, shadow angle 34°" of a control, after a comma if the text is not empty; `brief`: without "angle". */
void ceduo_words_topography(struct text *text, const struct ceduo_topography *topography, bool brief);

#define DEGREES (180 / M_PI)

/* What is to be said of a belt: one sentence for each bit of its warnings, handed to `say` one by one. */
void ceduo_words_stand_warnings(const struct ceduo_scene *scene, const struct ceduo_belt *belt,
                                const struct ceduo_stand_result *stand, ceduo_sentence_sink *say, void *context);

/* Of these what is unlikely about a stand, so that it may be a mistake. */
void ceduo_words_unlikely(const struct ceduo_belt *belt, const struct ceduo_stand_result *r, ceduo_sentence_sink *say,
                          void *context);

/* Print a warning if a stem is thicker than those that the volumes of its species were measured on. */
void ceduo_words_thick_stems(const struct ceduo_belt *belt, ceduo_sentence_sink *say, void *context);

/* What is to be said of a run as a whole, but for ceduo_words_still_moving(). `tolerance` is 0 where none was asked for. */
struct ceduo_run_remarks {
    double tolerance;
    bool tolerance_met;
    bool ground_assumed;
};
void ceduo_words_run_warnings(const struct ceduo_result *result, const struct ceduo_run_remarks *remarks,
                              ceduo_sentence_sink *say, void *context);

/* Why nothing can be said of a control (ceduo_too_few_arrivals()): what arrives, how far rocks come, from where, and what to do. The
 * same of the first control of which that holds, as a warning. */
void ceduo_words_nothing(struct text *text, const struct ceduo_result *result, size_t control);
void ceduo_words_still_moving(const struct ceduo_result *result, ceduo_sentence_sink *say, void *context);

/* What is said of a control: the word of files, NULL where it is not answered; and why, in a sentence. */
const char *ceduo_words_judgement(enum ceduo_judgement judgement);
void ceduo_words_because(struct text *text, const struct ceduo_result *result, size_t control,
                         const struct ceduo_arrivals *wooded); /* NULL: not known */

struct ceduo_subject; /* measure.h */

const char *ceduo_words_decided(enum ceduo_judgement judgement); /* "NO", translated; not of CEDUO_UNANSWERED */
const char *ceduo_words_decision(enum ceduo_judgement judgement, char room[CEDUO_WORDS_ROOM]); /* "✘ NO"; "": not answered */
#define DECISION(judgement) ceduo_words_decision(judgement, (char[CEDUO_WORDS_ROOM]){0})

/* Why, without the verdict: "in 17 of 25 years more than 50 of 1000 rocks exceed 50 kJ: mean 190, worst 489 in year 1; today 31
 * (YES)." */
void ceduo_words_reason(struct text *text, const struct ceduo_subject *subject);

/* The answer in one line of at most `width` columns, over the years ahead where they are known: "✘ NO: in 17 of 25 years more than 50
 * of 1000 rocks arrive with more than 50 kJ: mean 190, worst 489 in year 1; today 31 (YES)". A cut that is due has the answers before
 * and after it; one of several controls is named. Where there is less room whole clauses are left out; the verdict always stands. */
void ceduo_words_answer(struct text *text, const struct ceduo_subject *subject, size_t width);

/* Which options have lights that thin shoots alone make green today. */
void ceduo_words_thin_stems(const struct ceduo_result *result, ceduo_sentence_sink *say, void *context);

/* One of the tests of an option at a control, as ceduo_light_names has them, with its reason. */
void ceduo_words_test(struct text *text, const struct ceduo_result *result, size_t option, size_t control, size_t test);

/* What the same rocks do under the other energy law; nothing where that is not known, or no stem stands. */
void ceduo_words_other(struct text *text, const struct ceduo_result *result, size_t option, size_t control);

/* Which options the two energy laws put in another order, one sentence for each pair, of the first few. */
void ceduo_words_rank_reversals(const struct ceduo_result *result, const struct ceduo_verdict *verdict,
                                ceduo_sentence_sink *say, void *context);

/* Which option is best over the years and which today, at the last control, in one or two sentences, each in a line of its
 * own; nothing of what is not known. Then which options have no rotation, and why. */
void ceduo_words_best(struct text *text, const struct ceduo_scene *scene, const struct ceduo_verdict *verdict);
void ceduo_words_windows(const struct ceduo_scene *scene, ceduo_sentence_sink *say, void *context);

/* Why an option has no rotation; nothing if it has one. */
void ceduo_words_window(struct text *text, const struct ceduo_option *option);

/* What is to be said of the years of an option together, up to the last control: how much gets through, in how many a test fails,
 * what is to be expected. */
void ceduo_words_years_sum(struct text *text, const struct ceduo_result *result, const struct ceduo_years *years);

/* How years are numbered, and with how many rocks in each they were simulated (0: by the index). */
void ceduo_words_year_numbering(struct text *text, uint64_t rocks);

/* How often what is feared at a control happens, in one sentence; "13" and "13 (9–14)" years. */
const char *ceduo_words_interval_years(struct ceduo_estimate rate, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_words_years(struct ceduo_estimate rate, char room[CEDUO_WORDS_ROOM]);
#define EVERY(rate) ceduo_words_interval_years(rate, (char[CEDUO_WORDS_ROOM]){0})
#define YEARS(rate) ceduo_words_years(rate, (char[CEDUO_WORDS_ROOM]){0})

/* Why energy is not judged; why options cannot be compared by what arrives. Marked for translation. */
extern const char *const ceduo_words_unjudged, *const ceduo_words_by_index;

extern const char *const ceduo_light_names[3];           /* contact, free run, energy; marked for translation */
const char *ceduo_words_light(enum ceduo_light light);   /* pass, fail, unknown */
const char *ceduo_words_verdict(enum ceduo_light light); /* passes, FAILS, unknown */

/* What a place withstands, in kJ, as its file says it: 3.3, which a product with 0.001 makes 3.3000000000000003. */
double ceduo_words_accepted(const struct ceduo_control *control);

/* The word of a law or a rule as people say it; what it is in files where none is known. */
const char *ceduo_words_law(const char *word);

/* The name of an option, a belt or a control: that of the language, but in JSON and CSV as the file has it. */
#define NAME_OF(x) ((x)->name_given ? ceduo_in_language((x)->name_given, (x)->name) : (x)->name)

/* "end of the forest (135 m)", or "135 m". */
void ceduo_words_place(struct text *text, const struct ceduo_control *control);

/* A sentence with a string in the place of its one %s. */
void ceduo_append_with(struct text *text, const char *sentence, const char *string);

/* A number with so many significant digits, never in exponent form where that can be avoided. "-" where it is NaN,
 * "none" where infinite. */
void ceduo_words_number(struct text *text, double value, int digits);

/* The same in a string, for a sentence: it lives as long as the block in which it is made. */
const char *ceduo_words_shown(double value, int digits, char room[CEDUO_NUMBER_ROOM]);
const char *ceduo_words_rounded(double value, int digits, char room[CEDUO_NUMBER_ROOM]);
#define WRITTEN(value, digits) ceduo_words_shown(value, digits, (char[CEDUO_NUMBER_ROOM]){0})
/* A figure beside the limit that it is judged by, with so many digits or as it takes to lie where it does: 29.98 below 30;
 * a share in percent. */
const char *ceduo_words_against_limit(double value, int digits, double limit, char room[CEDUO_NUMBER_ROOM]);
const char *ceduo_words_percent(double share, double limit, char room[CEDUO_NUMBER_ROOM]);
#define BESIDE(value, digits, limit) ceduo_words_against_limit(value, digits, limit, (char[CEDUO_NUMBER_ROOM]){0})
#define PERCENT(share, limit)        ceduo_words_percent(share, limit, (char[CEDUO_NUMBER_ROOM]){0})
/* With so many digits at most: 12, 0.5, 3e+06. */
#define ROUNDED(value, digits) ceduo_words_rounded(value, digits, (char[CEDUO_NUMBER_ROOM]){0})
#define SHORTEST(value)        ceduo_number_spoken(ceduo_number_shortest(value, (char[CEDUO_NUMBER_ROOM]){0}))

#endif
