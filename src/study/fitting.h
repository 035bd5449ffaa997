/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FITTING_H
#define CEDUO_FITTING_H

#include <pthread.h>

#include "base/parallel.h"
#include "inputs.h"
#include "observe.h"
#include "surrogate.h"

/* State of a calibration: calibrate.c fits, predict.c predicts the observations. */

struct fitting_scene {
    size_t fit_count;
    struct ceduo_observer *fit, *all; /* fit: without the observations held back for checking */
};

struct fitting_worker {
    struct input_scene *copies; /* [scene] */
    struct ceduo_observation_fit *fits;
};

struct fitting {
    const struct ceduo_calibration_def *def;
    struct arena memory;
    struct fitting_scene *scenes;
    size_t fit_count, all_count; /* observations of all scenes */
    size_t workers_count;
    struct fitting_worker *workers;
    struct surrogate surrogate;
    double *training,
        *training_values; /* training points of the surrogate, with log-likelihoods: Sobol' points, then proposals */
    size_t training_count, training_capacity;
    double starts[CEDUO_CALIBRATION_CHAINS * CEDUO_CALIBRATION_MAX];
    pthread_mutex_t lock;
    struct talk talk;
    double best[CEDUO_CALIBRATION_MAX], best_log_likelihood; /* guarded by `lock` */
    uint64_t evaluations;                                    /* guarded by `lock` */
    const double *draws;                 /* for predictions: [draw][parameter] in (0, 1); the last row is the best point */
    struct ceduo_observation_fit *drawn; /* [draw][observation] */
};

/* Simulate the scenes at a point. Sets to[] for each observation; `all`: also for those held back for checking. */
enum ceduo_status ceduo_fitting_simulate(struct fitting *f, size_t worker, const double *u, bool all,
                                         struct ceduo_observation_fit *to);

/* Predict all observations from the draws of a calibration. */
enum ceduo_status ceduo_fitting_predict(struct fitting *f, struct ceduo_calibration *answer);

#endif
