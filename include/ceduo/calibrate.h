/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CALIBRATE_H
#define CEDUO_CALIBRATE_H

#include "uncertainty.h"

/* ---- observations ---- */

/* Observations of real rocks on a slope, and their comparison with simulated rocks. calibrate.h fits values to them. */

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

/* ---- calibration ---- */

/* Fit of scene values to observations. The likelihood of a list is multinomial, of a count binomial, of a
 * mean normal; their logarithms add. Every evaluation simulates the same rocks. Adaptive Metropolis
 * chains (Haario, Saksman and Tamminen 2001) start at the best Sobol' points and draw from the posterior. The prior is uniform
 * within the bounds. */

#define CEDUO_CALIBRATION_MAX      12 /* values fitted at once */
#define CEDUO_CALIBRATION_CHAINS   4
#define CEDUO_CALIBRATION_DRAWS    200 /* for predictions */
#define CEDUO_CALIBRATION_ROCKS    2000
#define CEDUO_CALIBRATION_STEPS    1000000 /* per chain */
#define CEDUO_RHAT_MAX             1.05    /* convergence of the chains (Gelman and Rubin 1992) */
#define CEDUO_EFFECTIVE_MIN        200     /* effective sample size that the chains must reach */
#define CEDUO_IDENTIFIED_WIDTH_MAX 0.8     /* share of the bounds: a value with a wider range is not identified */
#define CEDUO_MISFIT               0.05    /* p-value below which the model cannot reproduce an observation */

/* One scene, with the places of the fitted values in it: inputs of kind CEDUO_INPUT_RANGE. Number and bounds are the same in
 * each scene. A value that the scene does not have has no places. */
struct ceduo_calibration_scene {
    const struct ceduo_scene *scene;
    const struct ceduo_input *inputs;
    size_t observations_count;
    const struct ceduo_observation *observations;
};

enum ceduo_calibration_stage { CEDUO_CALIBRATION_STAGE_SEARCH, CEDUO_CALIBRATION_STAGE_CHAINS };

/* Progress: the best values up to now, in the units of files. */
struct ceduo_calibration_state {
    enum ceduo_calibration_stage stage;
    uint64_t evaluations;
    double best[CEDUO_CALIBRATION_MAX], log_likelihood;
    double rhat, effective_size; /* NaN before the chains */
};

struct ceduo_calibration_def {
    size_t size; /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    size_t scenes_count;
    const struct ceduo_calibration_scene *scenes;
    size_t parameters_count; /* 1…CEDUO_CALIBRATION_MAX */
    uint64_t rocks;          /* per evaluation and setting */
    uint64_t seed;
    unsigned threads;         /* at most CEDUO_THREADS_MAX; 0: one */
    size_t steps_max;         /* per chain, at most CEDUO_CALIBRATION_STEPS; 0: default */
    const ceduo_flag *cancel; /* may be NULL */
    void (*progress)(void *context,
                     const struct ceduo_calibration_state *state); /* may be NULL; called by one thread at a time */
    void *context;
};

/* No scenes and no parameters; CEDUO_CALIBRATION_ROCKS, seed 1, one thread. */
struct ceduo_calibration_def ceduo_calibration_def_default(void);

struct ceduo_fitted {
    double lo, hi, best, p2_5, p50, p97_5; /* in the unit of files; NaN: not computed yet */
    bool identified, at_bound;
};

/* An observation and its prediction by the fit. */
struct ceduo_predicted {
    size_t scene, observation;
    struct ceduo_observation_fit at_best;
    double p_value;          /* share of predicted samples with a deviation of at least the observed one */
    double observed, lo, hi; /* observed mean or count; its predicted 95 % interval */
    bool inside;
    double one_lo, one_hi; /* predicted 95 % interval of single rocks; NaN: not computed */
    size_t one_inside;     /* observed values within it */
};

struct ceduo_calibration {
    size_t parameters_count;
    struct ceduo_fitted parameters[CEDUO_CALIBRATION_MAX];
    double correlation[CEDUO_CALIBRATION_MAX][CEDUO_CALIBRATION_MAX];
    size_t predicted_count;
    struct ceduo_predicted *predicted; /* observations of all scenes */
    bool misfit;                       /* a fitted observation contradicts the fit */
    bool check_failed;                 /* an observation held back for checking contradicts the fit */
    bool converged; /* converged; otherwise stopped at the step limit, or early if convergence was out of reach */
    uint64_t evaluations;
    double rhat, effective_size;
    size_t draws_count;
    double *draws; /* [draw][parameter], in the unit of files */
};

/* Fit. Return CEDUO_OK, CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT or the status of ceduo_scene_check(). The caller
 * releases *answer in any case. */
enum ceduo_status ceduo_calibrate(const struct ceduo_calibration_def *def, struct ceduo_calibration *answer);

/* Release a fit. A second call has no effect. */
void ceduo_calibration_release(struct ceduo_calibration *answer);

#endif
