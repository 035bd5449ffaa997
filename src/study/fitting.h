/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FITTING_H
#define CEDUO_FITTING_H

#include <pthread.h>

#include "base/parallel.h"
#include "ceduo/calibrate.h"
#include "guess.h"
#include "inputs.h"

/* A calibration from inside: calibrate.c fits, predict.c reads what the fit says of all that was seen. */

struct fitting_scene {
    size_t fit_count;
    struct ceduo_observer *fit, *all; /* fit: of those that are not only to check */
};

/* What a worker needs for itself. */
struct fitting_worker {
    struct input_scene *copies; /* [scene] */
    struct ceduo_observation_fit *counterparts;
};

struct fitting {
    const struct ceduo_calibration_def *def;
    struct arena memory;
    struct fitting_scene *scenes;
    size_t fit_count, all_count; /* observations of all scenes */
    size_t workers_count;
    struct fitting_worker *workers;
    struct guess guess;
    double *known, *known_values; /* what it learns from: Sobol' points, then what the chains have tried; log-likelihoods */
    size_t known_count, known_capacity;
    double starts[CEDUO_CALIBRATION_CHAINS * CEDUO_CALIBRATION_MAX];
    pthread_mutex_t lock;
    struct talk talk;
    double best[CEDUO_CALIBRATION_MAX], best_log_likelihood; /* under `lock`, as are: */
    uint64_t evaluations;
    const double *draws;                 /* that predictions are made from: [draw][parameter] in 0…1; the last is the best */
    struct ceduo_observation_fit *drawn; /* [draw][observation] */
};

/* What rocks do at a place: one counterpart for each observation, of all, or of those that are fitted. */
enum ceduo_status ceduo_fitting_look(struct fitting *f, size_t worker, const double *u, bool all,
                                     struct ceduo_observation_fit *to);

/* Fills what a calibration says of its observations, from its draws. */
enum ceduo_status ceduo_fitting_predict(struct fitting *f, struct ceduo_calibration *answer);

#endif
