/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UNCERTAINTY_H
#define CEDUO_UNCERTAINTY_H

#include "years.h"

/* ---- surrogate ---- */

/* A figure at one point for each group of the rocks. Groups have the same rocks at every point. Equal values: no noise. The
 * product of two groups has no bias by noise. */
#define CEDUO_SURFACE_GROUPS 16
struct ceduo_replicates {
    double value[CEDUO_SURFACE_GROUPS];
};

struct ceduo_share {
    double value, se; /* se: bootstrap over points and jackknife over rocks */
};

struct ceduo_surface_fit {
    double mean, variance; /* over the plausible cases, without sampling noise */
    double noise;          /* sampling variance of a value at a point */
    double q2;             /* share of the total variance that the surface predicts, by leave-one-out cross-validation */
    double explained;      /* share of the variance without noise that the surface explains */
    bool enough_points;    /* true if points suffice for the terms; otherwise shares are NaN */
    bool linear;           /* terms of degree 1 and their products only */
    struct ceduo_share unexplained;    /* unexplained share */
    double p5, p50, p95;               /* percentiles of the values */
    double p5_se, p95_se;              /* over other points and other rocks */
    struct ceduo_share share_below;    /* share of the values at or below the limit */
    double *values;                    /* for each point the surface plus its residual, shrunk by noise */
    struct ceduo_share *first, *total; /* for each input: alone, and with all interactions */
    double *width_if_known;            /* for each input the expected p95 - p5 if it were known; at most p95 - p5 */
};

/* ---- inverse search ---- */

/* Inverse search: find the value for which a goal stays at or below its target. The search depends on nothing but the goals
 * that were evaluated, and evaluates no value twice. */

#define CEDUO_FIND_SCAN      8    /* interior values, evaluated if both ends pass or both fail */
#define CEDUO_FIND_TOLERANCE 1e-9 /* share of hi - lo */

struct ceduo_find_def {
    size_t size;   /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    double lo, hi; /* finite, lo <= hi */
    bool whole;    /* only whole values; |lo|, |hi| <= 2^53 */
    double target; /* a value passes if its goal is <= target; may be infinite; a goal of NaN never passes */
    /* Set *goal for a value. Any status but CEDUO_OK ends the search. Equal values must have equal goals. */
    enum ceduo_status (*goal)(void *context, double value, double *goal);
    void *context;
    double tolerance;         /* share of hi - lo; not used for whole values; 0: CEDUO_FIND_TOLERANCE */
    const ceduo_flag *cancel; /* may be NULL; if set, the search returns after the current evaluation */
};

/* From 0 to 1, target 0. The caller sets `goal`. */
struct ceduo_find_def ceduo_find_def_default(void);

enum ceduo_side { CEDUO_SIDE_SMALLEST, CEDUO_SIDE_LARGEST };

struct ceduo_found {
    bool found;
    bool whole_range;                /* every evaluated value passes */
    double value, goal_at_value;     /* evaluated, and passes; NaN if not found */
    enum ceduo_side side;            /* `value` is the smallest or the largest that passes */
    bool monotone;                   /* the evaluated goals only rise or only fall with the value */
    double nearest, goal_at_nearest; /* smallest evaluated goal; NaN if all goals are NaN */
    unsigned evaluations;
};

/* Find the value in [lo, hi] at which the goal crosses its target: both ends pass   lo (smallest) if all interior values
 * pass, too. Otherwise the smallest value above which all evaluated values pass; not monotone only hi passes   the smallest
 * value that passes only lo passes   the largest value that passes neither passes   if an interior value passes, the
 * crossing below the first such value; not monotone. Otherwise not found The value passes. The next whole number beyond the
 * crossing, or a value within the tolerance, was evaluated and fails. A goal that is not monotone may have further
 * crossings. Changes of the goal below 1e-12 of it count as rounding. Without a whole number in [lo, hi] nothing is
 * evaluated. Bisection takes at most 55 evaluations for whole values up to 10^12 and for the default tolerance. Return
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or the status of the goal. Unless CEDUO_OK, *found covers
 * the evaluated values only. */
enum ceduo_status ceduo_find(const struct ceduo_find_def *def, struct ceduo_found *found);

/* ---- uncertain inputs ---- */

/* Uncertainty of inputs, and its effect on results. Sampling error shrinks with more rocks; this uncertainty shrinks only with
 * measurement. Each uncertain value is an input with a range. Many scenes are drawn from the ranges. All are computed with the
 * same rocks. */

/* One uncertain input. It may stand at several places of the scene, which then change together. */
struct ceduo_input {
    const char *path; /* path of its first place, or the common part of its places */
    enum ceduo_input_kind kind;
    double lo, hi;   /* in the unit of files */
    double mean, sd; /* CEDUO_INPUT_NORMAL, CEDUO_INPUT_GAMMA: sd at most CEDUO_GAMMA_MAX of the mean */
    size_t words_count;
    const int *words; /* values of the choice */
    size_t places_count;
    size_t draws_count;
    /* CEDUO_INPUT_DRAWS: the values of each place, row by row; places are sorted by name */
    const double *const *draws;
    const char *const *places; /* paths with indices: forest[0].stand.trees[0].per_ha */
    const char *source;        /* origin of the range, marked for translation; NULL: not given */
};

#define CEDUO_GAMMA_MAX 2.0

/* Figures at the last control, with forest (without forest if the contact model is index). The judged share is EXCEED if an
 * accepted energy is given, otherwise REACH. */
enum ceduo_uncertainty_kind {
    CEDUO_UNCERTAINTY_REACH,
    CEDUO_UNCERTAINTY_EXCEED,
    CEDUO_UNCERTAINTY_ENERGY,
    CEDUO_UNCERTAINTY_MEAN,                              /* mean of the judged share over a rotation */
    CEDUO_UNCERTAINTY_FAILING,                           /* years of a rotation whose judged share exceeds CEDUO_EXCEED_MAX */
    CEDUO_UNCERTAINTY_DEFEATED,                          /* share that defeats the fence, today */
    CEDUO_UNCERTAINTY_SHOWN,                             /* kinds below this are reported; the lights depend on the others: */
    CEDUO_UNCERTAINTY_CONTACT = CEDUO_UNCERTAINTY_SHOWN, /* 1/m, reciprocal of the longest ADC of a belt */
    CEDUO_UNCERTAINTY_FREE_RUN,                          /* highest probability of a free run */
    CEDUO_UNCERTAINTY_KINDS
};

/* Points at which figures are computed, to fit a polynomial surface through them (Sudret 2008). Their number is doubled until
 * the surface explains CEDUO_UNCERTAINTY_EXPLAINED of the variance. */
#define CEDUO_UNCERTAINTY_POINTS     256
#define CEDUO_UNCERTAINTY_POINTS_MAX 1024
#define CEDUO_UNCERTAINTY_EXPLAINED  0.9
#define CEDUO_UNCERTAINTY_ROCKS      400 /* per point, by default */
#define CEDUO_UNCERTAINTY_MIN        20  /* points that a 90 % range requires */

/* Two options are equal if their shares differ by at most this. With blocks: by a tenth of `limit` of struct
 * ceduo_arrivals. Mean energies per released rock are equal if they differ by at most this share of the energy without
 * forest. */
#define CEDUO_UNCERTAINTY_EQUAL 0.005

/* Rocks of each year of a rotation at a point, different in each year. An option with more than YEARS_MAX years is thinned to
 * them. The scene as given has OWN_YEAR_ROCKS in each year. */
#define CEDUO_UNCERTAINTY_YEAR_ROCKS     32
#define CEDUO_UNCERTAINTY_YEARS_MAX      60
#define CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS 1000

struct ceduo_uncertainty_def {
    size_t size; /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    const struct ceduo_scene *scene;
    size_t inputs_count; /* >= 1 */
    const struct ceduo_input *inputs;
    size_t points;      /* 2…CEDUO_UNCERTAINTY_POINTS_MAX */
    size_t points_max;  /* limit of the doubling; 0: CEDUO_UNCERTAINTY_POINTS_MAX */
    uint64_t rocks;     /* per evaluation; raised to CEDUO_SURFACE_GROUPS */
    uint64_t own_rocks; /* for the scene as given; 0: `rocks` */
    /* Results of the scene as given, with the years of each option if `rotation` is true. Requires `brief`. NULL: computed here
     * with own_rocks. */
    const struct ceduo_results *own;
    size_t years_max; /* years of each option at a point, at most CEDUO_UNCERTAINTY_YEARS_MAX; 0: that number */
    /* Leave out differences between options, values at the ends of inputs, and figures that pages do not show: their fit.p5 and
     * fit.p95 are NaN. */
    bool brief;
    bool rotation;              /* compute each option over its rotation, too; not with the contact model index */
    bool one_option;            /* evaluate only `option`; the other options have p5, p95 NaN, and there is no ranking */
    size_t option;              /* if `one_option` */
    struct ceduo_window window; /* years; step 0: those of ceduo_scene_window() */
    uint64_t effort_max;        /* contacts + stems + 2 * stems hit of all points; above it CEDUO_CANCELLED; 0: unlimited */
    unsigned threads;           /* at most CEDUO_THREADS_MAX; 0: one */
    const ceduo_flag *cancel;   /* may be NULL */
    void (*progress)(void *context, uint64_t done, uint64_t all); /* may be NULL; called by one thread at a time */
    void *context;
};

/* CEDUO_UNCERTAINTY_POINTS points of CEDUO_UNCERTAINTY_ROCKS rocks, one thread. The caller sets inputs_count and inputs. */
struct ceduo_uncertainty_def ceduo_uncertainty_def_default(const struct ceduo_scene *scene);

/* A range from 0 to 1 without places. */
struct ceduo_input ceduo_input_default(void);

/* A figure of an option, or its difference to that of the first option. Shares are 0…1, energies J per released rock. */
struct ceduo_uncertainty_figure {
    size_t option;
    enum ceduo_uncertainty_kind kind;
    bool difference;
    double value, sampling_lo, sampling_hi; /* scene as given, with sampling error; NaN: not computed */
    /* Over the plausible cases. fit.below is the share of them whose judged share is at most CEDUO_EXCEED_MAX. p5 and p95 are
     * widened to include `value`; NaN with fewer than CEDUO_UNCERTAINTY_MIN points. */
    struct ceduo_surface_fit fit;
    double (*at_ends)[2]; /* for each input the figure at its lower and upper end, all others as given; over a rotation NaN */
    size_t uses;          /* inputs of the figure's options */
    size_t *order; /* these inputs, sorted by the width of p5…p95 that remains if the input were known, smallest first */
};

/* Probabilities that one option is better than another, worse, or equal (CEDUO_UNCERTAINTY_EQUAL). They add up to 1. */
struct ceduo_uncertainty_order {
    size_t better, than; /* options */
    double probability, equal, worse;
    double p5, p95; /* 90 % range of the difference of the figure that ranks them */
};

struct ceduo_uncertainty_result {
    size_t points;
    uint64_t rocks; /* per point */
    uint64_t own_rocks;
    bool rotation; /* figures over a rotation were computed */
    size_t figures_count;
    struct ceduo_uncertainty_figure
        *figures;                     /* by option and kind, then the differences; see ceduo_uncertainty_find_figure() */
    enum ceduo_uncertainty_kind main; /* EXCEED if an accepted energy is given, otherwise ENERGY */
    size_t orders_count;              /* options - 1; 0: one option, or not computed */
    /* Each option and the next one, ranked by the scene as given: by the mean over the rotation if computed, otherwise by
     * today's main figure. */
    struct ceduo_uncertainty_order *orders;
    uint64_t evaluations; /* scenes computed, each with all options and their years */
};

/* Compute the uncertainty of all figures. The result does not depend on the number of threads, bit for bit. Return CEDUO_OK,
 * CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT (a member of the def out of range, an input without words or draws, a
 * scene without control) or the status of ceduo_scene_check(). The caller releases *answer in any case. */
enum ceduo_status ceduo_uncertainty_compute(const struct ceduo_uncertainty_def *def, struct ceduo_uncertainty_result *answer);

/* Release a result. A second call has no effect. */
void ceduo_uncertainty_release(struct ceduo_uncertainty_result *answer);

/* Return a figure; NULL if there is no such option or figure. Figures over a rotation require answer->rotation. */
const struct ceduo_uncertainty_figure *ceduo_uncertainty_find_figure(const struct ceduo_uncertainty_result *answer,
                                                                     size_t option, enum ceduo_uncertainty_kind kind,
                                                                     bool difference);

#endif
