/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GOAL_H
#define CEDUO_GOAL_H

#include "base/text.h"
#include "ceduo/uncertainty.h"

/* Goals of a search for one value of a scene, at the worst control. A goal has a name here, a row in goal.c, and its value in
 * ceduo_goal_reached(). */
enum ceduo_goal {
    CEDUO_GOAL_ADC,
    CEDUO_GOAL_FREE_RUN,
    CEDUO_GOAL_ENERGY,
    CEDUO_GOAL_EXCEED,
    CEDUO_GOAL_ARRIVE,
    CEDUO_GOAL_WORST_EXCEED,
    CEDUO_GOAL_WORST_ARRIVE,
    CEDUO_GOALS
};

struct ceduo_goal_row {
    const char *word;    /* on the command line */
    const char *name;    /* in sentences */
    const char *unit;    /* unit of the target; "%": a share, 0…1 */
    bool below;          /* reached below the target; otherwise at or below it */
    bool needs_rocks;    /* computed from simulated rocks; otherwise from the index alone */
    const char *meaning; /* for the manual */
    const char *usual;   /* default target, for the manual; NULL: none */
};

extern const struct ceduo_goal_row ceduo_goals[CEDUO_GOALS];

/* True if the goal is a share. */
bool ceduo_goal_is_share(enum ceduo_goal goal);

/* True if the goal is a share in the worst year. Such a goal requires years. */
bool ceduo_goal_is_worst(enum ceduo_goal goal);

/* True if the goal requires an accepted energy. */
bool ceduo_goal_needs_accepted(enum ceduo_goal goal);

/* Append the words of all goals, separated by commas. */
void ceduo_goal_words(struct text *text);

/* Return the limit of the goal's light; NaN: the goal has no light. */
double ceduo_goal_limit(enum ceduo_goal goal, const struct ceduo_scene *scene);

/* True if the goal over years is the mean of the years; otherwise it is the worst year. */
bool ceduo_goal_is_mean(enum ceduo_goal goal);

/* Return the goal of an option at its worst control, in the goal's unit; NaN: unknown. `years` NULL: today. */
double ceduo_goal_reached(enum ceduo_goal goal, const struct ceduo_result *result, size_t option,
                          const struct ceduo_years *years);

enum ceduo_goal_reading { CEDUO_GOAL_GOOD, CEDUO_GOAL_UNKNOWN, CEDUO_GOAL_NO_NUMBER, CEDUO_GOAL_NEGATIVE, CEDUO_GOAL_NO_SHARE };

/* Parse "energy=50". *value is NaN without a value. Overwrites the sign in `text`. */
enum ceduo_goal_reading ceduo_goal_read(char *text, enum ceduo_goal *goal, double *value);

/* Search for the value of one parameter at which an option reaches a goal. */
struct ceduo_search {
    const char *path; /* parameter, as for --set */
    size_t option;
    enum ceduo_goal goal;
    double target; /* in the goal's unit; NaN: replaced by ceduo_goal_limit() */
    double lo, hi; /* in the file's units */
    uint64_t rocks;
    bool rotation;       /* not today; set if the parameter affects only the years, or the goal is of the worst year */
    double sure;         /* probability of reaching the goal under uncertain inputs, at most 1; 0: not required */
    uint64_t sure_rocks; /* rocks per point for it; 0: CEDUO_UNCERTAINTY_ROCKS */
};

/* Result of a search under uncertainty. */
struct ceduo_reliability {
    double sure;              /* required probability; 0: not required */
    size_t inputs;            /* uncertain inputs of the option, without the searched one; 0: nothing was computed */
    struct ceduo_found found; /* its goals are reliability_result.above */
    double lo, hi;            /* 95 % interval of the value found, by points and rocks; NaN: unknown */
    struct ceduo_share share; /* probability of reaching the goal at the value found, otherwise at the nearest */
    size_t points;
    uint64_t rocks; /* per point */
};

#endif
