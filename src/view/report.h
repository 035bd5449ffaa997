/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_H
#define CEDUO_REPORT_H

#include "base/arena.h"
#include "ceduo/blocks.h"
#include "ceduo/calibrate.h"
#include "ceduo/find.h"
#include "ceduo/surface.h"
#include "ceduo/uncertainty.h"
#include "io/scene_file.h"
#include "study/goal.h"
#include "study/snapshot.h"
#include "words.h"

enum ceduo_format { CEDUO_TABLE, CEDUO_CSV, CEDUO_JSON };

struct ceduo_page;

/* ---- how sure a scene is ---- */

/* What uncertainty does to a scene. */
struct ceduo_uncertainty_report {
    struct scene_file *file; /* its scene is only read, but by paths */
    const struct scene_inputs *inputs;
    const struct ceduo_uncertainty_result *answer; /* NULL: nothing is uncertain, nothing was computed */
    size_t points;
    uint64_t rocks;
    const struct ceduo_result *finer;  /* figures of the scene as it is from more rocks; NULL: those of the answer */
    const struct ceduo_verdict *years; /* likewise those of its years */
    bool over;                         /* the main figure is the mean over the rotation, which the answer has */
    bool too_much;                     /* it was not computed because it would take too long */
};

/* The figure that all is about: too much energy where that is known, otherwise energy; or its mean over the rotation. */
const struct ceduo_uncertainty_figure *ceduo_uncertainty_main(const struct ceduo_uncertainty_report *report, size_t option);

/* Whether the scene asks for no answer; why there is none: that, or nothing is uncertain. */
bool ceduo_uncertainty_is_off(const struct ceduo_uncertainty_report *report);
const char *ceduo_uncertainty_none(const struct ceduo_uncertainty_report *report);

void ceduo_uncertainty_value(struct text *text, enum ceduo_uncertainty_kind kind,
                             double value); /* shares of 1000, energies in kJ */

/* The share of an input in a figure as it is shown, from 0 to 1: an estimate may lie outside. */
double ceduo_uncertainty_share(const struct ceduo_uncertainty_figure *figure, size_t group);

/* What people call an input: "diameter, ADS 1"; "energy law". */
void ceduo_uncertainty_input_name(struct text *text, const struct ceduo_uncertainty_report *report, size_t group);

/* An end of an input's range, 0 or 1, as files have it; of words `*word` is the first or the last, and the value NaN. */
double ceduo_uncertainty_input_value(const struct ceduo_uncertainty_report *report, size_t group, int end, const char **word);
void ceduo_uncertainty_input_end(struct text *text, const struct ceduo_uncertainty_report *report, size_t group, int end);

/* A warning for each input whose value in the scene is not among those that it may have. */
void ceduo_uncertainty_outside(const struct ceduo_uncertainty_report *report, ceduo_sentence_sink *say, void *context);

/* What would measure an input, marked for translation; NULL: nothing that is known. */
const char *ceduo_uncertainty_measured(const struct ceduo_uncertainty_report *report, size_t group);

/* Adds what was found as blocks: a section with tables and what to measure first; of `all` also the mean over a rotation, and how
 * sure the order of the options is. */
void ceduo_uncertainty_blocks(struct ceduo_page *page, const struct ceduo_uncertainty_report *report, bool all);
/* The option that advice is about: the one that lets least pass today in the mean of plausible cases. */
size_t ceduo_uncertainty_chosen(const struct ceduo_uncertainty_report *report);

/* Input n of those to be measured first for a figure, in the order of what is left if they are known. Only inputs that a reader can
 * measure, each name once. SIZE_MAX: there are fewer. */
size_t ceduo_uncertainty_advised(const struct ceduo_uncertainty_report *report, const struct ceduo_uncertainty_figure *figure,
                                 size_t n);

/* Adds at most `most` of these inputs, each with what would measure it. */
void ceduo_uncertainty_advice(struct text *text, const struct ceduo_uncertainty_report *report,
                              const struct ceduo_uncertainty_figure *figure, size_t most);

/* Adds the number of points, if it is smaller than usual. */
void ceduo_uncertainty_points(struct text *text, const struct ceduo_uncertainty_report *report);

/* In how much of what may be true one of two options is better, equal or worse, and how sure that makes the order. */
void ceduo_uncertainty_order_words(struct text *text, const struct ceduo_uncertainty_report *report, size_t order);

/* "energy law and friction": what a light depends on above all; false where it does not change within what may be true. */
bool ceduo_uncertainty_causes(struct text *text, const struct ceduo_uncertainty_report *report, size_t option,
                              enum ceduo_uncertainty_kind light);

/* "Whether the test of energy passes depends on …"; nothing where the light does not change within what may be true. */
void ceduo_uncertainty_light_words(struct text *text, const struct ceduo_uncertainty_report *report, size_t option,
                                   size_t light);
extern const enum ceduo_uncertainty_kind ceduo_uncertainty_lights[3]; /* contact, free run, energy */

void ceduo_uncertainty_page(struct text *text, const struct ceduo_uncertainty_report *report, bool plain);

/* ---- measures ---- */

/* A figure of an answer and what people call it: made here once, for pages, pictures, panes and the column. */

enum ceduo_measure_name {
    CEDUO_HEAD,       /* of a column that has room: "of 1000 > 50 kJ" */
    CEDUO_SHORT_HEAD, /* "> 50 kJ" */
    CEDUO_ROW,        /* before the figure: "above 50 kJ" */
    CEDUO_PHRASE,     /* in a sentence: "arrive with more than 50 kJ" */
    CEDUO_MEASURE_NAMES
};

struct ceduo_measure {
    double value, lo, hi;                   /* in the unit shown; NaN: not known, or no interval */
    double half;                            /* half the width of the interval, not rounded */
    double may_lo, may_hi;                  /* 90 % of what may be true; NaN: not known, see ceduo_measure_uncertainty() */
    int digits;                             /* significant; 0: a whole number */
    const char *names[CEDUO_MEASURE_NAMES]; /* marked for translation; %s in a name is the limit */
    double limit;
};

/* Of 1000 rocks released those that arrive, and those that a control is judged by: that arrive with more than it withstands, or
 * at all where that is not given. `arrivals` NULL: not known. */
struct ceduo_measure ceduo_measure_arriving(const struct ceduo_arrivals *arrivals);
struct ceduo_measure ceduo_measure_exceeding(const struct ceduo_control *control, const struct ceduo_arrivals *arrivals);

/* Such a share with half its interval, as that of years is known. */
struct ceduo_measure ceduo_share(struct ceduo_mean_share share);

/* Sets the 90 % range of a fit, `scale` being units shown; it holds the measure's value. */
void ceduo_measure_range(struct ceduo_measure *measure, const struct ceduo_surface_fit *fit, double scale);

/* Sets what uncertainty makes of such a share of an option at a control; of any but the last it is not known. `uncertainty` may be NULL. */
void ceduo_measure_uncertainty(struct ceduo_measure *measure, const struct ceduo_uncertainty_report *uncertainty, size_t option,
                               size_t control);

/* The same of its mean over the years, which is known where that was asked for. */
void ceduo_measure_uncertainty_over(struct ceduo_measure *measure, const struct ceduo_uncertainty_report *uncertainty,
                                    size_t option);

/* Of 1000 those that end before the control, by how they end; of those that arrive the mean and the 95th percentile of the energy,
 * the 95th percentile of the height under them, the mean speed, the mean of the stems hit; the mean energy of all released. */
enum ceduo_measured {
    CEDUO_STOPPED,
    CEDUO_RESTED,
    CEDUO_GONE,
    CEDUO_ENDLESS,
    CEDUO_MEAN_KJ,
    CEDUO_P95_KJ,
    CEDUO_RELEASED_KJ,
    CEDUO_P95_HEIGHT,
    CEDUO_SPEED,
    CEDUO_STEMS_HIT,
    CEDUO_P95_TOP, /* of the height of the rocks' tops */
    CEDUO_MEASURED
};
struct ceduo_measure ceduo_measured(enum ceduo_measured what, const struct ceduo_arrivals *arrivals);

/* Numbers of rocks; 0 of NULL. */
uint64_t ceduo_released(const struct ceduo_arrivals *arrivals);
uint64_t ceduo_reached(const struct ceduo_arrivals *arrivals);
uint64_t ceduo_unfinished(const struct ceduo_arrivals *arrivals);

/* Distribution of those that arrive: m/s, J, m above ground. */
enum ceduo_spread { CEDUO_SPREAD_SPEED, CEDUO_SPREAD_ENERGY, CEDUO_SPREAD_HEIGHT };
const struct ceduo_distribution *ceduo_spread(enum ceduo_spread what, const struct ceduo_arrivals *arrivals);

/* True if more rocks may change the test of energy. `arrivals` may be NULL. */
bool ceduo_is_close_call(const struct ceduo_arrivals *arrivals);
const struct ceduo_topography *ceduo_topography_at(const struct ceduo_arrivals *arrivals);

/* How often, and with how much; the rate of what is feared. Without blocks, or of NULL, NULL and NaN. */
const struct ceduo_hazard *ceduo_hazard_at(const struct ceduo_arrivals *arrivals);
struct ceduo_estimate ceduo_feared(const struct ceduo_arrivals *arrivals);

/* Strings of a measure, which live as long as the block that calls: a name; its value, "-" if it is not known; an interval, "453–501";
 * both, "480 (453–501)"; shorter, "480 ±27" or "480±27" with nothing `between`, and "480" of one rock, whose error is not known. MAY_BE:
 * the interval by both errors, as the uncertain inputs may leave less open than the number of rocks. */
const char *ceduo_measure_name(struct ceduo_measure m, enum ceduo_measure_name name, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_value(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_span(struct ceduo_measure m, double lo, double hi, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_interval(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_error(struct ceduo_measure m, const char *between, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_plausible_range(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
#define NAMED(m, name)         ceduo_measure_name(m, name, (char[CEDUO_WORDS_ROOM]){0})
#define VALUE_OF(m)            ceduo_measure_value(m, (char[CEDUO_WORDS_ROOM]){0})
#define SPAN(m, lo, hi)        ceduo_measure_span(m, lo, hi, (char[CEDUO_WORDS_ROOM]){0})
#define INTERVAL(m)            ceduo_measure_interval(m, (char[CEDUO_WORDS_ROOM]){0})
#define WITH_ERROR(m, between) ceduo_measure_error(m, between, (char[CEDUO_WORDS_ROOM]){0})
#define MAY_BE(m)              ceduo_measure_plausible_range(m, (char[CEDUO_WORDS_ROOM]){0})

/* ---- the answer ---- */

/* The answer for one scene: all that pages, panes and figures are made from. */
struct ceduo_report {
    const struct scene_file *file;
    const struct ceduo_result *result;   /* NULL: nothing is computed yet */
    const struct ceduo_verdict *verdict; /* of all options; NULL: not known */
    const struct ceduo_uncertainty_report
        *uncertainty;                       /* NULL: not computed; in the terminal program perhaps of one option alone */
    struct ceduo_years *const *years;       /* one for each option; NULL: not asked for */
    struct ceduo_years *const *ahead;       /* likewise, for pictures; NULL, or NULL of an option: not known */
    const struct ceduo_snapshot *snapshot;  /* for pictures; NULL: there are none */
    const struct ceduo_size_result *blocks; /* CEDUO_SIZES for each option; NULL: none to show */
    struct ceduo_run_remarks remarks;
    struct ceduo_work work;
    double seconds;       /* that the runs took */
    uint64_t rocks_asked; /* where rows of stands are wanted and none is flown; otherwise 0 */
    const char *command;  /* of a page to hand in: gives the same page, */
    bool same;            /* to the last byte */
    bool details;         /* JSON has the lists that are long */
    bool busy;            /* finer figures are on their way */
};

/* Judge an option at a control, by what the report knows; see ceduo_outcome_compute(). */
struct ceduo_outcome ceduo_report_outcome(const struct ceduo_report *report, size_t option, size_t control);

/* An option at a control, with what a report knows of it. */
struct ceduo_subject {
    const struct ceduo_report *report;
    size_t option, control;
    const struct ceduo_control *place;
    const struct ceduo_arrivals *bare, *wooded;   /* wooded: NULL: not known */
    const struct ceduo_index *index;              /* NULL: without forest */
    const struct ceduo_choice *choice;            /* NULL: not known */
    const struct ceduo_alternative_energy *other; /* NULL: not known, or no stem stands */
    struct ceduo_outcome outcome;
    struct ceduo_measure today,
        mean;    /* share by which the place is judged, and its mean over the years; with what may be true */
    bool apart;  /* the caller shows mean, worst year and today elsewhere */
    bool so_far; /* the uncertainty is still being computed */
};
/* `option` SIZE_MAX: without forest. */
struct ceduo_subject ceduo_subject_find(const struct ceduo_report *report, size_t option, size_t control);
/* In a year of an option, at the last control. */
struct ceduo_subject ceduo_subject_in(const struct ceduo_report *report, size_t option, const struct ceduo_year *year);

/* An option over the years ahead; NULL if they are not known, or are all as today. */
static inline const struct ceduo_choice *ceduo_report_ahead(const struct ceduo_report *report, size_t option)
{
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_choice *c = v && option < v->n ? &v->choices[option] : NULL;
    return c && c->over->years > 0 && c->window.kind != CEDUO_WINDOW_CONSTANT ? c : NULL;
}

/* Whether no place is asked for, or nothing can be said of the last one. */
bool ceduo_page_is_unassessable(const struct ceduo_result *result);

/* The page that a forester reads first, or the `whole` one with every figure; 80 columns. `plain`: ASCII alone. */
void ceduo_report_page(struct text *text, const struct ceduo_report *report, bool whole, bool plain);

/* A page to hand in: the question and its answer first, then what it rests on, and how to compute it again. */

#define CEDUO_PAGE_REPORT_WIDTH 120 /* of a page that chapters are added to: tables, not sentences, and nothing shortened */

/* Adds a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_report *report);

/* Several scenes, as profiles of one slope. Zeroed at first; to be freed in any case. */
struct ceduo_profiles {
    size_t count;
    struct ceduo_profile *items;
    struct arena arena; /* of what they hold */
};
/* `name`: NULL: the scene's title. */
void ceduo_profiles_add(struct ceduo_profiles *profiles, const struct ceduo_report *report, const char *name);
/* Puts the worst first. Their numbers as they were added, from 0, to `order`; how many. */
size_t ceduo_profiles_sort(struct ceduo_profiles *profiles, size_t *order);
/* Adds what is said of each option of each, and before it, where all are about one place, of that as a whole. */
void ceduo_profiles_page(struct ceduo_page *page, const struct ceduo_profiles *profiles);
void ceduo_profiles_free(struct ceduo_profiles *profiles);

/* What a search found. */
struct ceduo_find_report {
    const struct scene_file *file;
    const struct ceduo_search *search;
    const struct ceduo_found *found;
    const struct ceduo_yield *yield; /* at that value; NaN where it is not known; NULL: none */
    bool yield_depends;              /* on the value; otherwise it is the same over the whole range */
    const struct ceduo_reliability *sure;
};
void ceduo_page_find(struct text *text, const struct ceduo_find_report *report);
/* Which values reach the goal, and if wanted which limit that is; the value that is sure. Both in the unit in which the field is
 * shown (NULL: that of the file). */
void ceduo_find_words(struct text *text, const struct ceduo_search *search, const struct ceduo_found *found,
                      const struct field *field, bool wanted);
void ceduo_find_reliable(struct text *text, const struct ceduo_search *search, const struct ceduo_reliability *sure,
                         const struct field *field);

/* ---- what was fitted to what was seen ---- */

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
double ceduo_observed_shown(const struct scene_file *file, const struct ceduo_predicted *p, double value);
const struct ceduo_observation *ceduo_observed_find(const struct ceduo_calibration_report *report,
                                                    const struct ceduo_predicted *p);
size_t ceduo_observed_number(const struct ceduo_observation *o);

void ceduo_calibration_page(struct text *text, const struct ceduo_calibration_report *report, bool plain);
/* What the page says in words: misfit, what is not determined, what is known only together. */
void ceduo_calibration_words(struct ceduo_page *page, const struct ceduo_calibration_report *report);

/* The draws as a table for `uncertainty: {draws: …}`: a column for each fitted value, whose head is its places in the first scene. */
void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration_report *report);

/* "48 stops; 95 % .44–.51": where the fitted values come from. */
void ceduo_calibration_sources(struct text *text, const struct ceduo_calibration_report *report);

#endif
