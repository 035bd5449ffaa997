/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YEARS_H
#define CEDUO_YEARS_H

#include "result.h"
#include "rotation.h"

/* An option year by year: its stands grow and are cut as their files and belts say, and the same rocks go through each
 * year's forest. */

struct ceduo_year {
    unsigned year;                     /* counted from the stands as filed */
    bool cut;                          /* some belt is cut in it */
    struct ceduo_option option;        /* the forest of this year; belts bare of stems where nothing stands */
    struct ceduo_grown_stand *grown;   /* what its belts hold: owned */
    struct ceduo_stand_result *stands; /* one for each belt */
    struct ceduo_index *controls;      /* one for each control */
    struct ceduo_simulated wooded;     /* rocks 0: not simulated; with the contact model index never */
};

/* Why these years and no others. */
enum ceduo_window_kind {
    CEDUO_WINDOW_GIVEN,    /* the caller or the scene asks for them */
    CEDUO_WINDOW_AHEAD,    /* the next years from today, the same for all options */
    CEDUO_WINDOW_ROTATION, /* one whole rotation, from the year on in which every belt that is ever cut has been cut */
    CEDUO_WINDOW_CONSTANT  /* nothing grows and nothing is cut: year 0, today, represents all years */
};

/* The years first, first + step … last; step >= 1. */
struct ceduo_window {
    enum ceduo_window_kind kind;
    unsigned first, last, step;
};

#define CEDUO_YEARS_MAX   1000 /* computed at a time */
#define CEDUO_YEARS_AHEAD 20   /* of a window of CEDUO_WINDOW_AHEAD, at least, */
#define CEDUO_AHEAD_MAX   60   /* and at most */
#define CEDUO_PERIOD_MAX  120  /* years: beyond it belts of several rotations count as repeating with the longest */

/* One whole rotation of an option: after its first cut a forest repeats itself, so a rotation has each of its states once. If its
 * belts have several rotations, all of them must have ended together. Without a cut the next CEDUO_YEARS_AHEAD years
 * (CEDUO_WINDOW_AHEAD), or CEDUO_WINDOW_CONSTANT. */
struct ceduo_window ceduo_window_compute(const struct ceduo_option *option);

/* At the most so many (> 0) of its years, evenly spread. */
struct ceduo_window ceduo_window_thinned(struct ceduo_window window, unsigned max);

/* The years by which all options of a scene are judged and compared: from year 1 to the longest rotation of any belt, at least
 * CEDUO_YEARS_AHEAD and at most CEDUO_AHEAD_MAX years. The scene may name the first year, the last, or both: CEDUO_WINDOW_GIVEN, at
 * most CEDUO_YEARS_MAX years. CEDUO_WINDOW_CONSTANT if no option has a stand that grows or is cut. */
struct ceduo_window ceduo_window_in(const struct ceduo_scene *scene);

struct ceduo_years {
    struct ceduo_scene scene; /* what it points to must outlive the years */
    struct ceduo_window window;
    uint64_t key; /* for the caller, to tell what they were made of; 0 at first */
    size_t count;
    struct ceduo_year *years; /* rising */
    size_t last_control;      /* the one farthest along x */
    uint64_t rocks;           /* simulated in every year; 0: not in all of them yet */
    uint16_t *marks;          /* of each rock the years in which it reaches the last control with more than is
                               * accepted, or reaches it where that is not said */
    double *weights;          /* of those rocks, where the scene has blocks; otherwise NULL */
};

/* Grows the stands of an option to the years of a window; nothing is simulated and nothing assessed yet. What the
 * option points to must outlive it. CEDUO_NO_MEMORY, CEDUO_BAD_STAND, CEDUO_BAD_ARGUMENT (a window without a year, of more than
 * CEDUO_YEARS_MAX, or beyond CEDUO_YEAR_MAX) or CEDUO_OK. */
enum ceduo_status ceduo_years_create(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                     struct ceduo_window window, struct ceduo_years **years);
void ceduo_years_free(struct ceduo_years *years);

/* Has the pool make the runs of all years, as long as `rocks`, those of years with the same forest once; then
 * assesses every year, `bare` being what arrives without forest. With the contact model index, or 0 rocks, no rock is
 * simulated. CEDUO_CANCELLED, CEDUO_NO_MEMORY: the years before are assessed. */
enum ceduo_status ceduo_years_simulate(struct ceduo_years *years, struct ceduo_pool *pool, const struct ceduo_simulated *bare,
                                       uint64_t rocks);

/* The same with rocks of its own in each year, which are those of the same year of another window: in the mean over the years
 * their errors cancel out, so that few rocks tell it. `def` is of the scene, which has no blocks. */
enum ceduo_status ceduo_years_simulate_independent(struct ceduo_years *years, const struct ceduo_run_def *def,
                                                   const struct ceduo_simulated *bare, uint64_t rocks);

/* Assesses simulated years once more, for a scene that differs in what no rock sees: the threshold, the rule of the
 * ADC, how many rocks come down a year. It has as many controls, at the same places, and `bare` is of them. */
void ceduo_years_assess(struct ceduo_years *years, const struct ceduo_scene *scene, const struct ceduo_simulated *bare);

/* The years together, at one control. Every figure is a plain mean over the years computed. Where all years
 * simulate the same rocks, their errors go together: the standard error of a mean is at most the mean of the standard
 * errors, and that is given; of the share that is marked the error itself, from each rock's own mean over the years.
 * NaN where a figure does not exist. */
struct ceduo_years_summary {
    size_t years, simulated;
    bool nothing; /* nothing can be said of the forest (ceduo_too_few_arrivals()): no light fails and none passes */
    size_t unprotected_contact, unprotected_free_run, unprotected_energy; /* years in which that light fails */
    size_t thick_contact, thick_free_run; /* and where only stems from CEDUO_THICK_DBH on count */
    size_t failing_lo, failing_hi;        /* years whose 95 % interval of the energy's share lies above the limit; whose upper
                                        * end does */
    struct ceduo_estimate rate;           /* with blocks: ceduo_hazard_feared() a year; its interval is at most this wide */
    struct ceduo_estimate reach, exceed;  /* of the released */
    struct ceduo_estimate energy_per_released; /* J */
    unsigned worst_year;                       /* with the largest share that exceeds, or arrives if no energy is accepted; by
                                        * the index the year with the largest ADC */
    double worst;                              /* that share, or that ADC in m */
    double passes_per_year, exceeds_per_year;  /* expected, where the scene says how many rocks come down a year */
};
struct ceduo_years_summary ceduo_years_sum(const struct ceduo_years *years, size_t control);

/* The mean share of the released that is marked, of one option less that of another, rock by rock over the rocks that
 * both have. NaN where it is not known. */
struct ceduo_estimate ceduo_years_difference(const struct ceduo_years *years, const struct ceduo_years *less);

/* Metres of belts that are felled in the years computed, each time they are: square metres for each metre of width. */
double ceduo_years_felled(const struct ceduo_years *years);

#endif
