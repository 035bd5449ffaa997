/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OBSERVE_H
#define CEDUO_OBSERVE_H

#include "flag.h"
#include "scene.h"

/* Observations of real rocks on a slope, and their comparison with simulated rocks. calibrate.h fits values to them. */

struct ceduo_observed_row {
    const char *path, *list;
    enum ceduo_location location;
    enum ceduo_quantity quantity;
};

struct ceduo_quantity_row {
    const char *unit;          /* in files and for people; "": a count */
    double scale;              /* SI per unit */
    const char *column, *also; /* head of the column in a table of values; other heads, separated by | */
};

const struct ceduo_observed_row *ceduo_observed_row(enum ceduo_observed_kind kind);
const struct ceduo_quantity_row *ceduo_observed_quantity(enum ceduo_observed_kind kind);

/* One observation. Positions are relative to the first vertex of the slope, in SI. */
struct ceduo_observation {
    enum ceduo_observed_kind kind;
    enum ceduo_observed_use use;
    const char *name_given;              /* as in the scene, or made from its kind */
    const char *name;                    /* in the language of pages */
    size_t option;                       /* whose forest the rocks passed */
    const struct ceduo_rock_def *rock;   /* NULL: the scene's */
    const struct ceduo_release *release; /* NULL: the scene's */
    double x;                            /* m; for passed, speed, height, energy */
    double from, to;                     /* m, ends of a stretch; stops before `from` were not surveyed; NaN: all were */
    size_t n;                            /* number of values, or of rocks that `mean` covers */
    const double *values;                /* NULL: only mean and sd are given */
    double mean, sd;
    uint64_t count;          /* rocks passed */
    uint64_t released_count; /* rocks released; 0: not given */
    double share_seen;       /* share of the scars that a survey finds; NaN: not given */
};

/* An observation of stops, to be fitted; all numbers are NaN or 0. */
struct ceduo_observation ceduo_observation_default(void);

/* A list of n values is binned at its own quantiles into n/5 classes, at least 2 and at most 10. If the number released is
 * given, one more class holds the rocks without a value. */
#define CEDUO_CLASSES_MAX     11
#define CEDUO_CLASS_ROCKS_MIN 10 /* simulated rocks per class; fewer overstate the deviance */

/* Simulated rocks compared with one observation. */
#define CEDUO_SAMPLE_VALUES 40
struct ceduo_observation_fit {
    uint64_t rocks;                                               /* simulated rocks */
    size_t classes;                                               /* 0: means are compared */
    double observed[CEDUO_CLASSES_MAX], count[CEDUO_CLASSES_MAX]; /* in each class: observed, simulated */
    double mean, sd;                                              /* mean and standard deviation of the simulated values */
    size_t sample_count; /* the first values; rocks are exchangeable, so these are a random sample */
    double sample[CEDUO_SAMPLE_VALUES];
    double observed_mean;
    double variance;                 /* variance of the difference of the means */
    double scars, scars_variance;    /* expected number for the rocks released; NaN: not a count of scars */
    double log_likelihood, deviance; /* deviance: twice the log-likelihood ratio against the saturated model */
};

/* Return the deviance of a multinomial law with the simulated shares against one with the observed shares. `observed`,
 * `simulated`: numbers in each class. */
double ceduo_classes_deviance(const double *observed, const double *simulated, size_t classes);

/* Prepared observations. Observations with the same rock, release and option share one simulation. */
struct ceduo_observer;

/* The lists of the observations must outlive the observer. CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_observer_create(const struct ceduo_observation *observations, size_t n,
                                        struct ceduo_observer **observer);
void ceduo_observer_free(struct ceduo_observer *observer);

/* Simulate `rocks` rocks for each setting on this thread, always the same rocks. Sets to[] for each observation. `cancel`
 * may be NULL. Return CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or the status of ceduo_scene_check(). */
enum ceduo_status ceduo_observer_simulate(const struct ceduo_observer *observer, const struct ceduo_scene *scene,
                                          uint64_t rocks, const ceduo_flag *cancel, struct ceduo_observation_fit *to);

/* Simulate one observation and return its values; NaN: the rock has no value. Scars have one value for each impact on a
 * stem. The caller frees *values. */
enum ceduo_status ceduo_observer_values(const struct ceduo_observer *observer, const struct ceduo_scene *scene, size_t which,
                                        uint64_t rocks, double **values, size_t *n);

#endif
