/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OBSERVE_H
#define CEDUO_OBSERVE_H

#include "flag.h"
#include "scene.h"

/* What was seen of real rocks on a slope, and what simulated rocks do there: the ground between them is fitted to the one
 * by the other, see calibrate.h. */

struct ceduo_observed_row {
    const char *path, *list;
    enum ceduo_where where;
    enum ceduo_quantity quantity;
};

struct ceduo_quantity_row {
    const char *unit;          /* in files and for people; "": of a count */
    double scale;              /* SI per unit */
    const char *column, *also; /* name of the column of a table that holds the values; other names, separated by | */
};

const struct ceduo_observed_row *ceduo_observed_row(enum ceduo_observed_kind kind);
const struct ceduo_quantity_row *ceduo_observed_quantity(enum ceduo_observed_kind kind);

/* One thing that was seen. Places are relative to the slope's first vertex, all is SI. */
struct ceduo_observation {
    enum ceduo_observed_kind kind;
    enum ceduo_observed_use use;
    const char *name_given;              /* as the scene has it, or made from what it is */
    const char *name;                    /* in the language of pages */
    size_t option;                       /* through whose forest */
    const struct ceduo_rock_def *rock;   /* NULL: the scene's */
    const struct ceduo_release *release; /* NULL: the scene's */
    double x;                            /* of passed, speed, height, energy */
    double from, to;      /* of a stretch; `from` of stops: what stopped before it was not looked for; NaN: everywhere */
    size_t n;             /* values, or what the mean is of */
    const double *values; /* NULL: only their mean and sd are known */
    double mean, sd;
    uint64_t count;    /* of passed */
    uint64_t of;       /* rocks released; 0: not known */
    double share_seen; /* of scars; NaN: not known */
};

/* Places where one rock stopped, to be fitted; all numbers are unknown. */
struct ceduo_observation ceduo_observation_default(void);

/* A list is compared in classes between its own quantiles: as many as there are times five values, at most ten, at least
 * two. One more is for rocks that have no value: those that did not stop, where it is known how many were released. */
#define CEDUO_CLASSES_MAX     11
#define CEDUO_CLASS_ROCKS_MIN 10 /* simulated rocks for each class, below which a list counts as rarer than it is */

/* What simulated rocks say of one observation. */
#define CEDUO_SOME_VALUES 40
struct ceduo_observation_fit {
    uint64_t rocks;                                           /* simulated rocks that it is of */
    size_t classes;                                           /* 0: compared by their means */
    double seen[CEDUO_CLASSES_MAX], count[CEDUO_CLASSES_MAX]; /* in each class: seen, simulated */
    double mean, sd;                                          /* of the simulated values */
    size_t some_count; /* the first of them: rocks are alike, so that they stand for all */
    double some[CEDUO_SOME_VALUES];
    double seen_mean;
    double variance;                 /* of the difference of the means: the error of both sides */
    double scars, scars_variance;    /* expected, of the rocks released; NaN: not asked for */
    double log_likelihood, deviance; /* deviance: twice the logarithm that is missing to a model that fits perfectly */
};

/* Twice the logarithm that a multinomial law with shares as the simulated rocks misses to one with shares as seen. `seen`,
 * `simulated`: numbers in each class. */
double ceduo_classes_deviance(const double *seen, const double *simulated, size_t classes);

/* Observations made ready: what differs in nothing but what was seen of it shares its rocks. */
struct ceduo_observer;

/* The lists of the observations must outlive the observer. CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_observer_create(const struct ceduo_observation *observations, size_t n,
                                        struct ceduo_observer **observer);
void ceduo_observer_free(struct ceduo_observer *observer);

/* Simulates `rocks` rocks of each kind in a scene, always the same, on this thread, and fills `to`, one counterpart for each
 * observation. `cancel` may be NULL. CEDUO_CANCELLED, CEDUO_NO_MEMORY or what ceduo_scene_check() says. */
enum ceduo_status ceduo_observer_simulate(const struct ceduo_observer *observer, const struct ceduo_scene *scene,
                                          uint64_t rocks, const ceduo_flag *cancel, struct ceduo_observation_fit *to);

/* The same of one observation, value by value: *values is the caller's to free, NaN where a rock has none. Of scars one value
 * for each blow. */
enum ceduo_status ceduo_observer_values(const struct ceduo_observer *observer, const struct ceduo_scene *scene, size_t which,
                                        uint64_t rocks, double **values, size_t *n);

#endif
