/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OBSERVE_H
#define CEDUO_OBSERVE_H

#include "ceduo/calibrate.h"

struct ceduo_observed_row {
    const char *path, *list;
    enum ceduo_location location;
    enum ceduo_quantity quantity;
};

struct ceduo_quantity_row {
    const char *unit;          /* in files and for people; "": a count */
    const char *units;         /* the same unit in heads of tables, in all its forms, separated by | */
    double scale;              /* SI per unit */
    const char *column, *also; /* head of the column in a table of values; other heads, separated by | */
};

const struct ceduo_observed_row *ceduo_observed_row(enum ceduo_observed_kind kind);
const struct ceduo_quantity_row *ceduo_observed_quantity(enum ceduo_observed_kind kind);

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
