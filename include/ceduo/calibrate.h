/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CALIBRATE_H
#define CEDUO_CALIBRATE_H

#include "doubt.h"
#include "flag.h"
#include "observe.h"

/* Values of scenes that are fitted to what was seen there. The likelihood of a list is multinomial, of a count binomial, of a
 * mean normal (observe.h); their logarithms add. Every evaluation simulates the same rocks. From the best of some Sobol'
 * points adaptive Metropolis chains (Haario, Saksman and Tamminen 2001) draw from the posterior, with a uniform prior within
 * the bounds. */

#define CEDUO_CALIBRATION_MOST   12 /* values fitted at once */
#define CEDUO_CALIBRATION_CHAINS 4
#define CEDUO_CALIBRATION_DRAWS  200 /* that predictions are made from */
#define CEDUO_CALIBRATION_ROCKS  2000
#define CEDUO_CALIBRATION_STEPS  1000000 /* of a chain, at most */
#define CEDUO_RHAT_MOST          1.05    /* chains agree (Gelman and Rubin 1992) */
#define CEDUO_EFFECTIVE_LEAST    200     /* independent draws that theirs are worth */
#define CEDUO_NOT_DETERMINED     0.8     /* of the bounds: a wider range says nothing */
#define CEDUO_MISFIT             0.05    /* p below it: the model cannot give what was seen */

/* One scene, with the places of the fitted values in it: inputs of kind CEDUO_INPUT_RANGE, the same number in each scene, of
 * the same bounds. One that the scene does not have has no places. */
struct ceduo_calibration_scene {
    const struct ceduo_scene *scene;
    const struct ceduo_input *inputs;
    size_t observations_count;
    const struct ceduo_observation *observations;
};

enum ceduo_calibration_stage { CEDUO_SEARCH, CEDUO_CHAINS };

/* How far it is: the best values so far, in the files' units. */
struct ceduo_calibration_state {
    enum ceduo_calibration_stage stage;
    uint64_t evaluations;
    double best[CEDUO_CALIBRATION_MOST], log_likelihood;
    double rhat, effective_size; /* NaN before the chains */
};

struct ceduo_calibration_def {
    size_t scenes_count;
    const struct ceduo_calibration_scene *scenes;
    size_t parameters_count; /* 1…CEDUO_CALIBRATION_MOST */
    uint64_t rocks;          /* of each evaluation and setting */
    uint64_t seed;
    unsigned threads;         /* at most CEDUO_THREADS_MOST; 0: one */
    size_t steps_most;        /* of each chain, at most CEDUO_CALIBRATION_STEPS; 0: the usual number */
    const ceduo_flag *cancel; /* may be NULL */
    void (*progress)(void *context, const struct ceduo_calibration_state *state); /* may be NULL; by one thread at a time */
    void *context;
};

/* No scenes and no parameters; CEDUO_CALIBRATION_ROCKS, seed 1, one thread. */
struct ceduo_calibration_def ceduo_calibration_def_default(void);

struct ceduo_fitted {
    double lo, hi, best, p2_5, p50, p97_5; /* in the file's unit; NaN: not known yet */
    bool determined, at_bound;
};

/* One observation beside what the fit says of it. */
struct ceduo_predicted {
    size_t scene, observation;
    struct ceduo_counterpart at_best;
    double p_value;      /* share of samples from the fit that lie as far from it as what was seen, or further */
    double seen, lo, hi; /* the mean that was seen, or the count; 95 % of what the fit predicts of it */
    bool inside;
    double one_lo, one_hi; /* 95 % of the values of single rocks; NaN: not known */
    size_t one_inside;     /* of the values that were seen */
};

struct ceduo_calibration {
    size_t parameters_count;
    struct ceduo_fitted parameters[CEDUO_CALIBRATION_MOST];
    double correlation[CEDUO_CALIBRATION_MOST][CEDUO_CALIBRATION_MOST];
    size_t predicted_count;
    struct ceduo_predicted *predicted; /* of all scenes */
    bool misfit;                       /* of something that was to be fitted */
    bool refuted;                      /* something that was to check the fit is not as predicted */
    bool
        settled; /* the chains agree and are long enough; otherwise they were ended, early where they would not have come to that */
    uint64_t evaluations;
    double rhat, effective_size;
    size_t draws_count;
    double *draws; /* [draw][parameter], in the file's unit */
};

/* Whether the rocks that were seen, to be fitted, are of two shapes: only then does what was seen tell mu of the law arm, as that
 * acts through the shape. */
bool ceduo_calibration_tells_mu(const struct ceduo_calibration_scene *scenes, size_t n);

/* What a scene as it is says of what was seen there, without any fit: `to` has one for each observation, p_value and range of new
 * samples as large as those seen. Simulates `rocks` rocks of each setting on this thread. CEDUO_NO_MEMORY, CEDUO_CANCELLED, or what
 * ceduo_scene_check() says. */
enum ceduo_status ceduo_calibration_as_it_is(const struct ceduo_calibration_scene *scene, uint64_t rocks,
                                             const ceduo_flag *cancel, struct ceduo_predicted *to);

/* Which values to leave as they are, so that what was seen tells the others: first those that may be anything within their bounds,
 * then one of each two that are known only together. One value stays. Returns how many. */
size_t ceduo_calibration_loose(const struct ceduo_calibration *answer, bool loose[CEDUO_CALIBRATION_MOST]);

/* CEDUO_NO_MEMORY, CEDUO_CANCELLED (at once, of whatever is known), CEDUO_BAD_ARGUMENT, or what ceduo_scene_check() says; then nothing
 * is to be freed. */
enum ceduo_status ceduo_calibrate(const struct ceduo_calibration_def *def, struct ceduo_calibration *answer);
void ceduo_calibration_free(struct ceduo_calibration *answer);

#endif
