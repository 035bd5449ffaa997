/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_H
#define CEDUO_REPORT_H

#include "base/arena.h"
#include "io/scene_file.h"
#include "study/goal.h"
#include "study/snapshot.h"
#include "words.h"

enum ceduo_format { CEDUO_TABLE, CEDUO_CSV, CEDUO_JSON, CEDUO_GEOJSON };

/* True for formats with the columns of CSV. */
static inline bool ceduo_format_has_columns(enum ceduo_format format)
{
    return format == CEDUO_CSV || format == CEDUO_GEOJSON;
}

struct ceduo_page;

/* ---- uncertainty of a scene ---- */

/* Effect of the uncertain inputs of a scene. */
struct ceduo_uncertainty_report {
    struct scene_file *file; /* its scene is constant, except through paths */
    const struct scene_inputs *inputs;
    const struct ceduo_uncertainty_result *answer; /* NULL: no input is uncertain, or not computed */
    size_t points;
    uint64_t rocks;
    const struct ceduo_result *finer;  /* figures of the unvaried scene from more rocks; NULL: those of the answer */
    const struct ceduo_verdict *years; /* verdict over the years from more rocks; NULL: that of the answer */
    bool rotation_mean;                /* the main figure is the mean over the rotation; requires it in the answer */
    bool too_much;                     /* not computed because it would take too long */
};

/* Return the main figure of an option: exceedance if an energy is accepted, otherwise mean energy. With `rotation_mean`, its
 * mean over the rotation. */
const struct ceduo_uncertainty_figure *ceduo_uncertainty_main(const struct ceduo_uncertainty_report *report, size_t option);

/* True if the scene disables uncertainty; the reason why there is no answer (disabled, or no uncertain input). */
bool ceduo_uncertainty_is_off(const struct ceduo_uncertainty_report *report);
const char *ceduo_uncertainty_missing_reason(const struct ceduo_uncertainty_report *report);

void ceduo_uncertainty_value(struct text *text, enum ceduo_uncertainty_kind kind,
                             double value); /* shares per 1000, energies in kJ */

/* Return the share of an input in the variance of a figure, clamped to 0..1. */
double ceduo_uncertainty_share(const struct ceduo_uncertainty_figure *figure, size_t group);

/* Append the name of an input for people: "diameter, ADS 1", "energy law". */
void ceduo_uncertainty_input_name(struct text *text, const struct ceduo_uncertainty_report *report, size_t group);

/* Return end 0 or 1 of an input's range in the unit of files. For words: NaN, and `*word` is the first or the last word. */
double ceduo_uncertainty_input_value(const struct ceduo_uncertainty_report *report, size_t group, int end, const char **word);
void ceduo_uncertainty_input_end(struct text *text, const struct ceduo_uncertainty_report *report, size_t group, int end);

/* Report a warning for each input whose value in the scene is outside its range. Nothing without an answer; `report` may be
 * NULL. */
void ceduo_uncertainty_warn_outside(const struct ceduo_uncertainty_report *report, ceduo_sentence_sink *sink, void *context);

/* Return what measures an input, marked for translation; NULL: unknown. */
const char *ceduo_uncertainty_measured_by(const struct ceduo_uncertainty_report *report, size_t group);

/* Append a section with tables and the inputs to measure first. `all`: also the mean over a rotation, and the ranking of
 * options. */
void ceduo_uncertainty_blocks(struct ceduo_page *page, const struct ceduo_uncertainty_report *report, bool all);
/* Return the option that advice refers to: the one with the lowest mean over plausible cases today. */
size_t ceduo_uncertainty_advised_option(const struct ceduo_uncertainty_report *report);

/* Return the input with rank n (from 0) to measure for a figure, by the width that remains if it is known. Skips inputs that
 * cannot be measured, and repeated names. SIZE_MAX: fewer than n + 1 inputs. */
size_t ceduo_uncertainty_advised_input(const struct ceduo_uncertainty_report *report,
                                       const struct ceduo_uncertainty_figure *figure, size_t n);

/* Append at most `max` of these inputs, each with what measures it. */
void ceduo_uncertainty_advice(struct text *text, const struct ceduo_uncertainty_report *report,
                              const struct ceduo_uncertainty_figure *figure, size_t max);

/* Append the number of points if it is smaller than usual. */
void ceduo_uncertainty_points(struct text *text, const struct ceduo_uncertainty_report *report);

/* Append the probability that one of two options is better, equal or worse, and the resulting ranking. */
void ceduo_uncertainty_order_words(struct text *text, const struct ceduo_uncertainty_report *report, size_t order);

/* Append the inputs that dominate a light: "energy law and friction". False if no plausible case changes the light. */
bool ceduo_uncertainty_causes(struct text *text, const struct ceduo_uncertainty_report *report, size_t option,
                              enum ceduo_uncertainty_kind light);

/* Append "Whether the test of energy passes depends on …"; nothing if no plausible case changes the light. */
void ceduo_uncertainty_light_words(struct text *text, const struct ceduo_uncertainty_report *report, size_t option,
                                   size_t light);
extern const enum ceduo_uncertainty_kind ceduo_uncertainty_lights[3]; /* contact, free run, energy */

void ceduo_uncertainty_page(struct text *text, const struct ceduo_uncertainty_report *report, bool plain);

/* ---- measures ---- */

/* A figure of an answer with its names, shared by pages, pictures, panes and the column. */

enum ceduo_measure_name {
    CEDUO_HEAD,       /* head of a wide column: "of 1000 > 50 kJ" */
    CEDUO_SHORT_HEAD, /* "> 50 kJ" */
    CEDUO_ROW,        /* label of a row: "above 50 kJ" */
    CEDUO_PHRASE,     /* part of a sentence: "arrive with more than 50 kJ" */
    CEDUO_MEASURE_NAMES
};

struct ceduo_measure {
    double value, lo, hi;                   /* in the unit shown; NaN: unknown, or no interval */
    double half_width;                      /* half the width of the interval, not rounded */
    double p5, p95;                         /* 90 % range; NaN: unknown, see ceduo_measure_uncertainty() */
    int digits;                             /* significant digits; 0: print an integer */
    const char *names[CEDUO_MEASURE_NAMES]; /* marked for translation; %s in a name is the limit */
    double limit;
};

/* Rocks per 1000 that reach the control, or that reach it with more than the accepted energy (all, if none is set).
 * `arrivals` may be NULL (unknown). */
struct ceduo_measure ceduo_measure_arriving(const struct ceduo_arrivals *arrivals);
struct ceduo_measure ceduo_measure_exceeding(const struct ceduo_control *control, const struct ceduo_arrivals *arrivals);

/* Return a share per 1000 with its interval. */
struct ceduo_measure ceduo_measure_share(struct ceduo_mean_share share);

/* Set the 90 % range from a fit, widened to include the measure's value. `scale` converts to the unit shown. */
void ceduo_measure_range(struct ceduo_measure *measure, const struct ceduo_surface_fit *fit, double scale);

/* Set the 90 % range of an option at a control; it is known at the last control only. `uncertainty` may be NULL. */
void ceduo_measure_uncertainty(struct ceduo_measure *measure, const struct ceduo_uncertainty_report *uncertainty, size_t option,
                               size_t control);

/* Set the 90 % range of the mean over the years, if it was computed. */
void ceduo_measure_mean_uncertainty(struct ceduo_measure *measure, const struct ceduo_uncertainty_report *uncertainty,
                                    size_t option);

/* Figures of arrivals. Rocks that end before the control, per 1000 released, by kind of end. For arriving rocks: mean energy,
 * 95th percentiles of energy and height, mean speed, mean number of stems hit. For released rocks: mean energy. */
enum ceduo_measure_kind {
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
    CEDUO_MEASURE_KINDS
};
struct ceduo_measure ceduo_measure_figure(enum ceduo_measure_kind kind, const struct ceduo_arrivals *arrivals);

/* Rocks per 1000 released at the fence of a control: above it, through it, both, either, or held with much energy. */
enum ceduo_fence_share {
    CEDUO_FENCE_ABOVE,
    CEDUO_FENCE_THROUGH,
    CEDUO_FENCE_BOTH,
    CEDUO_FENCE_DEFEATED,
    CEDUO_FENCE_WORN,
    CEDUO_FENCE_SHARES
};
struct ceduo_measure ceduo_measure_fence(enum ceduo_fence_share what, const struct ceduo_arrivals *arrivals);

/* Return the rocks at the fence; NULL without a fence, or if `arrivals` is NULL. */
const struct ceduo_fence_arrivals *ceduo_fence_find(const struct ceduo_arrivals *arrivals);

/* Return numbers of rocks; 0 if NULL. */
uint64_t ceduo_rocks_released(const struct ceduo_arrivals *arrivals);
uint64_t ceduo_rocks_reached(const struct ceduo_arrivals *arrivals);
uint64_t ceduo_rocks_unfinished(const struct ceduo_arrivals *arrivals);

/* Distribution over arriving rocks: m/s, J, m above ground. */
enum ceduo_spread { CEDUO_ARRIVAL_SPEED, CEDUO_ARRIVAL_ENERGY, CEDUO_ARRIVAL_HEIGHT };
const struct ceduo_distribution *ceduo_arrival_distribution(enum ceduo_spread kind, const struct ceduo_arrivals *arrivals);

/* True if more rocks may change the test of energy. `arrivals` may be NULL. */
bool ceduo_is_close_call(const struct ceduo_arrivals *arrivals);
const struct ceduo_topography *ceduo_topography_find(const struct ceduo_arrivals *arrivals);

/* Return frequency and energy per year, and the rate that is judged. NULL and CEDUO_NO_ESTIMATE without blocks, or if
 * `arrivals` is NULL. */
const struct ceduo_hazard *ceduo_hazard_find(const struct ceduo_arrivals *arrivals);
struct ceduo_estimate ceduo_judged_rate(const struct ceduo_arrivals *arrivals);

/* Format a measure; the string lives until the end of the caller's block. Name; value, "-" if unknown; interval "453–501";
 * both "480 (453–501)". Error: "480 ±27", "480±27" if `between` is empty, or "480" if the error is unknown. PLAUSIBLE_RANGE:
 * union of sampling interval and 90 % range. */
const char *ceduo_measure_name(struct ceduo_measure m, enum ceduo_measure_name name, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_measure_value(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_measure_span(struct ceduo_measure m, double lo, double hi, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_measure_interval(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_measure_error(struct ceduo_measure m, const char *between, char buffer[CEDUO_WORDS_SIZE]);
const char *ceduo_measure_plausible_range(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE]);
#define MEASURE_NAME(m, name)  ceduo_measure_name(m, name, (char[CEDUO_WORDS_SIZE]){0})
#define MEASURE_VALUE(m)       ceduo_measure_value(m, (char[CEDUO_WORDS_SIZE]){0})
#define SPAN(m, lo, hi)        ceduo_measure_span(m, lo, hi, (char[CEDUO_WORDS_SIZE]){0})
#define INTERVAL(m)            ceduo_measure_interval(m, (char[CEDUO_WORDS_SIZE]){0})
#define WITH_ERROR(m, between) ceduo_measure_error(m, between, (char[CEDUO_WORDS_SIZE]){0})
#define PLAUSIBLE_RANGE(m)     ceduo_measure_plausible_range(m, (char[CEDUO_WORDS_SIZE]){0})

/* ---- the answer ---- */

/* The answer for one scene: the source of all pages, panes and figures. */
struct ceduo_report {
    const struct scene_file *file;
    const struct ceduo_result *result;   /* NULL: not computed yet */
    const struct ceduo_verdict *verdict; /* verdict on all options; NULL: unknown */
    const struct ceduo_uncertainty_report
        *uncertainty;                       /* NULL: not computed; in the terminal program perhaps of one option only */
    struct ceduo_years *const *years;       /* one per option; NULL: not requested */
    struct ceduo_years *const *years_ahead; /* one per option, for pictures; NULL, or an element NULL: unknown */
    const struct ceduo_snapshot *snapshot;  /* for pictures; NULL: no pictures */
    const struct ceduo_size_result *blocks; /* CEDUO_SIZES per option; NULL: none to show */
    struct ceduo_run_remarks remarks;
    struct ceduo_work work;
    double seconds;       /* run time, s */
    uint64_t rocks_asked; /* rocks of a run that was replaced by rows of stands; 0: simulated */
    const char *command;  /* command that reproduces the page to hand in */
    bool reproducible;    /* the reproduced page is equal byte by byte */
    bool details;         /* JSON includes long lists */
    bool busy;            /* more precise figures are being computed */
};

/* Judge an option at a control, see ceduo_outcome_compute(). */
struct ceduo_outcome ceduo_report_outcome(const struct ceduo_report *report, size_t option, size_t control);

/* An option at a control, with its results. */
struct ceduo_subject {
    const struct ceduo_report *report;
    size_t option, control;
    const struct ceduo_control *place;
    const struct ceduo_arrivals *bare, *wooded;         /* wooded: NULL: not simulated */
    const struct ceduo_index *index;                    /* NULL: without forest */
    const struct ceduo_choice *choice;                  /* NULL: unknown */
    const struct ceduo_alternative_energy *alternative; /* NULL: unknown, or no stem stands */
    struct ceduo_outcome outcome;
    struct ceduo_measure today, mean; /* judged share today, and its mean over the years, with 90 % ranges */
    bool mean_shown;                  /* the caller shows mean, worst year and today elsewhere */
    bool preliminary;                 /* the uncertainty is still being computed */
};
/* Collect the results of an option at a control. `option` SIZE_MAX: without forest. */
struct ceduo_subject ceduo_subject_find(const struct ceduo_report *report, size_t option, size_t control);
/* Collect the results of a year of an option, at the last control. */
struct ceduo_subject ceduo_subject_find_year(const struct ceduo_report *report, size_t option, const struct ceduo_year *year);

/* Return the years at the fence of a control; NULL if unknown. */
const struct ceduo_fence_years *ceduo_report_fence_years(const struct ceduo_report *report, size_t option, size_t control);

/* Design values of a fence: of the rocks that arrive, and of forest and fence as one system; worst: in the worst year. */
enum ceduo_design_kind {
    CEDUO_DESIGN_BARE,
    CEDUO_DESIGN_ARRIVING,
    CEDUO_DESIGN_SYSTEM,
    CEDUO_DESIGN_WORST_ARRIVING,
    CEDUO_DESIGN_WORST_SYSTEM,
    CEDUO_DESIGN_KINDS
};
struct ceduo_designs {
    struct ceduo_fence_factors factors;
    bool calibrated;                                      /* the model is fitted to observations */
    struct ceduo_fence_design values[CEDUO_DESIGN_KINDS]; /* NaN and -1: unknown */
};
/* Compute the design values at a control. `wooded` may be NULL. False if the scene does not request them. */
bool ceduo_designs_compute(const struct ceduo_report *report, size_t option, size_t control,
                           const struct ceduo_arrivals *wooded, struct ceduo_designs *designs);

/* Return the years ahead of an option; NULL if unknown, or if all years are equal. */
static inline const struct ceduo_choice *ceduo_report_years_ahead(const struct ceduo_report *report, size_t option)
{
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_choice *c = v && option < v->n ? &v->choices[option] : NULL;
    return c && c->last_summary->years > 0 && c->window.kind != CEDUO_WINDOW_CONSTANT ? c : NULL;
}

/* True if the scene has no control, or if too few rocks reach the last one. */
bool ceduo_page_is_unassessable(const struct ceduo_result *result);

/* Print the short page, or the full one; 80 columns. `plain`: ASCII only. */
void ceduo_report_page(struct text *text, const struct ceduo_report *report, bool full, bool plain);

/* Page to hand in: question, answer, evidence, and the command that reproduces it. */

#define CEDUO_PAGE_REPORT_WIDTH 120 /* columns of a page of chapters: full tables, no text shortened */

/* Append a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_report *report);

/* Profiles of one slope, one scene each. Initialize with zeros; caller frees. */
struct ceduo_profiles {
    size_t count;
    struct ceduo_profile *items;
    struct arena arena; /* memory of the items */
};
/* Add a scene. `name` NULL: its title. */
void ceduo_profiles_add(struct ceduo_profiles *profiles, const struct ceduo_report *report, const char *name);
/* Sort the worst first. Write the original indices, from 0, to `order`; return their number. */
size_t ceduo_profiles_sort(struct ceduo_profiles *profiles, size_t *order);
/* Append the answer for each option and profile. If all profiles have one control, its overall answer comes first. */
void ceduo_profiles_page(struct ceduo_page *page, const struct ceduo_profiles *profiles);
void ceduo_profiles_free(struct ceduo_profiles *profiles);

/* A region: lines of one scene, each a row of --each. Initialize with zeros; caller frees. */
struct ceduo_region {
    const char *title, *place; /* as in the first line; place NULL: without name */
    double accepted;
    size_t options_count;
    const char **options; /* names; NULL: no line was computed */
    size_t count, failed, capacity;
    struct ceduo_region_line *lines;
    size_t rated; /* lines with a rate, and their sums without forest, 1/y */
    double bare_reach, bare_exceed;
    struct arena arena;
};
struct ceduo_region_origin {
    const char *table;
    uint64_t table_hash, run; /* run: of all scenes */
    const char *command;
    size_t chapters; /* number of chapters */
};
/* Add a line; one that failed, with its reason. `scene`: number for the caller. */
void ceduo_region_add(struct ceduo_region *region, const struct ceduo_report *report, const char *name, size_t scene);
void ceduo_region_add_failed(struct ceduo_region *region, const char *name, size_t scene, const char *reason);
/* Sort the worst first and the failed last. Return the number of lines that did not fail. */
size_t ceduo_region_sort(struct ceduo_region *region);
/* Return the scene of line i, and set its name. */
size_t ceduo_region_scene(const struct ceduo_region *region, size_t i, const char **name);
/* Append the page of a sorted region. */
void ceduo_region_page(struct ceduo_page *page, const struct ceduo_region *region, const struct ceduo_region_origin *origin);
void ceduo_region_free(struct ceduo_region *region);

/* Result of a search. */
struct ceduo_find_report {
    const struct scene_file *file;
    const struct ceduo_search *search;
    const struct ceduo_found *found;
    const struct ceduo_yield *yield; /* at the value found; NaN: unknown; NULL: none */
    bool yield_depends;              /* true if the yield varies with the value */
    const struct ceduo_reliability *reliability;
};
void ceduo_page_find(struct text *text, const struct ceduo_find_report *report);
/* Append the values that reach the goal, and the limit if `limit_wanted`; the reliable value. The unit is the field's
 * display unit; `field` NULL: the unit of files. */
void ceduo_find_words(struct text *text, const struct ceduo_search *search, const struct ceduo_found *found,
                      const struct field *field, bool limit_wanted);
void ceduo_find_reliable(struct text *text, const struct ceduo_search *search, const struct ceduo_reliability *reliability,
                         const struct field *field);

/* ---- calibration ---- */

/* Values fitted to observations. */
struct ceduo_calibration_report {
    size_t scenes_count;
    const struct scene_file *files;
    const struct ceduo_input *inputs; /* fitted values */
    uint64_t rocks;
    const struct ceduo_calibration *answer;
    bool fix_named; /* the caller names the values to fix */
};

/* Append the name of a fitted value, "bounce Rn, talus"; its number in the display unit. */
void ceduo_calibration_name(struct text *text, const char *path);
void ceduo_calibration_number(struct text *text, const char *path, double value);
/* Append the names of the selected values, separated by ", ". `selected` NULL: all. */
void ceduo_calibration_names(struct text *text, const struct ceduo_input *inputs, size_t n, const bool *selected);

/* Convert an observed value to the unit of files: m, m/s, kJ, count. */
double ceduo_observed_shown(const struct scene_file *file, const struct ceduo_predicted *p, double value);
const struct ceduo_observation *ceduo_observed_find(const struct ceduo_calibration_report *report,
                                                    const struct ceduo_predicted *p);
size_t ceduo_observed_number(const struct ceduo_observation *o);

void ceduo_calibration_page(struct text *text, const struct ceduo_calibration_report *report, bool plain);
/* Append misfit, unidentified values and correlated pairs as sentences. */
void ceduo_calibration_words(struct ceduo_page *page, const struct ceduo_calibration_report *report);

/* Append the draws as a table for `uncertainty: {draws: …}`. Each fitted value of the first scene has a
 * column; its head is the path. */
void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration_report *report);

/* Append the source of the fitted values: "48 stops; 95 % .44–.51". */
void ceduo_calibration_sources(struct text *text, const struct ceduo_calibration_report *report);

#endif
