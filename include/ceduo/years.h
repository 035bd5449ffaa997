/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YEARS_H
#define CEDUO_YEARS_H

#include "result.h"
#include "rotation.h"

/* An option year by year. Its stands grow and are cut as their files and belts define. All years have the same rocks. */

struct ceduo_year {
    unsigned year;                     /* 0: the stands as filed */
    bool cut;                          /* some belt is cut in this year */
    struct ceduo_option option;        /* the forest of this year; empty belts are bare */
    struct ceduo_grown_stand *grown;   /* owned; stands of the belts */
    struct ceduo_stand_result *stands; /* one per belt */
    struct ceduo_index *controls;      /* one per control */
    struct ceduo_simulated wooded;     /* rocks == 0: not simulated; always with the contact model index */
};

/* Origin of a window of years. */
enum ceduo_window_kind {
    CEDUO_WINDOW_GIVEN,    /* requested by the caller or the scene */
    CEDUO_WINDOW_AHEAD,    /* the next years from today, the same for all options */
    CEDUO_WINDOW_ROTATION, /* one whole rotation, after all belts with cuts have been cut once */
    CEDUO_WINDOW_CONSTANT  /* no growth and no cuts: year 0, today, represents all years */
};

/* The years first, first + step … last; step >= 1. */
struct ceduo_window {
    enum ceduo_window_kind kind;
    unsigned first, last, step;
};

#define CEDUO_YEARS_MAX       1000 /* per window */
#define CEDUO_YEARS_AHEAD_MIN 20   /* minimum years of CEDUO_WINDOW_AHEAD */
#define CEDUO_AHEAD_MAX       60   /* maximum */
#define CEDUO_PERIOD_MAX      120  /* years; if the common period of several rotations is longer, the longest rotation counts */

/* Return one whole rotation of an option. After its first cut a forest is periodic, so that a rotation has each state once.
 * With several rotations the window is their common period. Without a cut it is the next CEDUO_YEARS_AHEAD_MIN years
 * (CEDUO_WINDOW_AHEAD), or CEDUO_WINDOW_CONSTANT. */
struct ceduo_window ceduo_window_compute(const struct ceduo_option *option);

/* Return at most `max` (> 0) of its years, evenly spread. */
struct ceduo_window ceduo_window_thinned(struct ceduo_window window, unsigned max);

/* Return the years by which all options of a scene are judged and compared. They reach from year 1 to the longest rotation of
 * any belt, at least CEDUO_YEARS_AHEAD_MIN and at most CEDUO_AHEAD_MAX years. If the scene gives the first or last year:
 * CEDUO_WINDOW_GIVEN, at most CEDUO_YEARS_MAX years. CEDUO_WINDOW_CONSTANT if no option has a stand that grows or is cut. */
struct ceduo_window ceduo_scene_window(const struct ceduo_scene *scene);

struct ceduo_years {
    struct ceduo_scene scene; /* everything that it points to must outlive the years */
    struct ceduo_window window;
    uint64_t key; /* for the caller, to identify the input; 0 at first */
    size_t count;
    struct ceduo_year *years; /* sorted by year */
    size_t last_control;      /* the one farthest along x */
    uint64_t rocks;           /* simulated in every year; 0: not all years are simulated yet */
    /* per rock: number of years in which it exceeds the accepted energy at the last control, or reaches it if none is given */
    uint16_t *marks;
    double *weights; /* per rock, if the scene has blocks; otherwise NULL */
};

/* Grow the stands of an option to the years of a window, without simulating or assessing. Everything that the option points to
 * must outlive the years. Return CEDUO_NO_MEMORY, CEDUO_BAD_STAND, CEDUO_BAD_ARGUMENT (a window without a year, with more than
 * CEDUO_YEARS_MAX, or beyond CEDUO_YEAR_MAX) or CEDUO_OK. */
enum ceduo_status ceduo_years_create(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                     struct ceduo_window window, struct ceduo_years **years);
void ceduo_years_free(struct ceduo_years *years);

/* Simulate `rocks` rocks in every year with the runs of the pool, once for years with the same forest. Then assess every year;
 * `bare` are the results without forest. With the contact model index, or 0 rocks, no rock is simulated. On CEDUO_CANCELLED or
 * CEDUO_NO_MEMORY only the earlier years are assessed. */
enum ceduo_status ceduo_years_simulate(struct ceduo_years *years, struct ceduo_pool *pool, const struct ceduo_simulated *bare,
                                       uint64_t rocks);

/* As ceduo_years_simulate(), but each year has independent rocks. A year has the same rocks in every window. The errors cancel
 * out in the mean over the years, so that few rocks suffice. `def` is of the scene. Requires a scene without blocks. */
enum ceduo_status ceduo_years_simulate_independent(struct ceduo_years *years, const struct ceduo_run_def *def,
                                                   const struct ceduo_simulated *bare, uint64_t rocks);

/* Assess simulated years again, for a scene that differs only in settings that do not affect trajectories: threshold, rule of
 * the ADC, rocks per year. Requires controls at the same places; `bare` belongs to them. */
void ceduo_years_assess(struct ceduo_years *years, const struct ceduo_scene *scene, const struct ceduo_simulated *bare);

/* Summary of the years at one control. Every figure is the mean over the computed years. If all years simulate the same rocks,
 * their errors are correlated. The standard error is then given by its upper bound, the mean of the standard errors. For the
 * marked share it is exact, from the mean of each rock over the years. NaN if a figure does not exist. */
struct ceduo_years_summary {
    size_t years, simulated;
    bool nothing; /* the forest cannot be judged (ceduo_too_few_arrivals()): all lights are unknown */
    size_t unprotected_contact, unprotected_free_run, unprotected_energy; /* years in which this light fails */
    size_t thick_contact, thick_free_run;                                 /* likewise, counting stems from CEDUO_THICK_DBH on */
    size_t failing_lo, failing_hi;       /* years whose lower, or upper, 95 % limit of `exceed` is above the control's limit */
    struct ceduo_estimate rate;          /* with blocks: ceduo_hazard_judged_rate(); the interval is an upper bound */
    struct ceduo_estimate reach, exceed; /* of the released */
    struct ceduo_estimate energy_per_released; /* J */
    /* year of the largest exceeding share, or arriving share without an accepted energy; with the index, of the largest ADC */
    unsigned worst_year;
    double worst;                             /* this share, or this ADC in m */
    double passes_per_year, exceeds_per_year; /* expected, if the scene gives rocks_per_year */
};
struct ceduo_years_summary ceduo_years_summarize(const struct ceduo_years *years, size_t control);

/* Read the years at the fence of a control; `today`: arrivals with the forest of today. The loads are known without a fence, too,
 * if the scene requests design values. */
struct ceduo_fence_years ceduo_years_fence(const struct ceduo_years *years, size_t control, const struct ceduo_arrivals *today);

/* Return the difference of the mean marked shares of two options, over the rocks that both have. NaN if unknown. */
struct ceduo_estimate ceduo_years_difference(const struct ceduo_years *years, const struct ceduo_years *less);

/* Return the felled length of belts, m, summed over all cuts in the computed years: m2 per metre of width. */
double ceduo_years_felled(const struct ceduo_years *years);

#endif
