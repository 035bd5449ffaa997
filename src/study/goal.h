/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GOAL_H
#define CEDUO_GOAL_H

#include "base/text.h"
#include "ceduo/find.h"
#include "ceduo/surface.h"
#include "ceduo/years.h"

/* What a search for one number of a scene can ask for at the worst control. A goal is a name here, a row in goal.c and its
 * value in ceduo_goal_reached(). */
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
    const char *unit;    /* of its value; "%": a share, 0…1 */
    bool below;          /* reached below the value; otherwise at most at it */
    bool flies;          /* rocks answer it; otherwise the index of a forest alone answers */
    const char *meaning; /* for the manual */
    const char *usual;   /* what the value is where none is given; NULL: it must be given */
};

extern const struct ceduo_goal_row ceduo_goals[CEDUO_GOALS];

/* Whether the value is a share. */
bool ceduo_goal_is_share(enum ceduo_goal goal);

/* True if the goal is a share of the rocks in the worst year: it is asked of the years, never of today. */
bool ceduo_goal_is_worst(enum ceduo_goal goal);

/* True if the goal counts rocks with more than the accepted energy. */
bool ceduo_goal_needs_accepted(enum ceduo_goal goal);

/* Adds the words of all goals, with commas between them. */
void ceduo_goal_words(struct text *text);

/* The limit of the light that the goal belongs to; NaN where there is none. */
double ceduo_goal_limit(enum ceduo_goal goal, const struct ceduo_scene *scene);

/* What an option reaches at its worst control, in the goal's unit; NaN where that is not known. `years`: over them, of shares of the
 * rocks the mean, of the others the worst year; NULL: today. */
bool ceduo_goal_is_mean(enum ceduo_goal goal);
double ceduo_goal_reached(enum ceduo_goal goal, const struct ceduo_result *result, size_t option,
                          const struct ceduo_years *years);

enum ceduo_goal_reading { CEDUO_GOAL_GOOD, CEDUO_GOAL_UNKNOWN, CEDUO_GOAL_NO_NUMBER, CEDUO_GOAL_NEGATIVE, CEDUO_GOAL_NO_SHARE };

/* Reads "energy=50": `*value` is NaN without a value. `text` is cut at the sign. */
enum ceduo_goal_reading ceduo_goal_read(char *text, enum ceduo_goal *goal, double *value);

/* A search for the value of one parameter for which one option reaches a goal. */
struct ceduo_search {
    const char *path; /* of the parameter, as for --set */
    size_t option;
    enum ceduo_goal goal;
    double target; /* in the goal's unit; NaN: the light's limit, and set to it */
    double lo, hi; /* in the file's units */
    uint64_t rocks;
    bool rotation; /* over one whole rotation, not today: set where the parameter decides about the years alone, or the goal
                          * is of the worst year */
    double sure;   /* in how much of what may be true the goal is to be reached as well, up to 1; 0: it is not asked */
    uint64_t sure_rocks; /* of each point of that; 0: CEDUO_UNCERTAINTY_ROCKS */
};

/* What a search under uncertainty came to. */
struct ceduo_reliability {
    double sure;              /* what was asked for; 0: nothing */
    size_t inputs;            /* what is uncertain of the option, but for the value itself; 0: nothing, nothing was computed */
    struct ceduo_found found; /* its goals are those of no one */
    double lo, hi;            /* 95 % interval of the value found, by the points and by the rocks; NaN: not known */
    struct ceduo_share share; /* the share in which it is, at the value found or else comes nearest */
    size_t points;
    uint64_t rocks; /* of each */
};

#endif
