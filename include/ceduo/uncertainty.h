/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UNCERTAINTY_H
#define CEDUO_UNCERTAINTY_H

#include "flag.h"
#include "scene.h"
#include "surface.h"
#include "years.h"

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

/* Return the quantile u (0…1) of an input that is a range, normal or gamma. */
double ceduo_input_quantile(const struct ceduo_input *input, double u);

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

/* Points of a surface (ceduo/surface.h). Their number is doubled until the surface explains CEDUO_UNCERTAINTY_EXPLAINED of the
 * variance. */
#define CEDUO_UNCERTAINTY_POINTS     256
#define CEDUO_UNCERTAINTY_POINTS_MAX 1024
#define CEDUO_UNCERTAINTY_EXPLAINED  0.9
#define CEDUO_UNCERTAINTY_ROCKS      400 /* per point, by default */
#define CEDUO_UNCERTAINTY_MIN        20  /* points that a 90 % range requires */

/* Two options are equal if their shares differ by at most this. With blocks the limit is a tenth of ceduo_exceed_limit(). Mean
 * energies per released rock are equal if they differ by at most this share of the energy without forest. */
#define CEDUO_UNCERTAINTY_EQUAL 0.005

/* Rocks of each year of a rotation at a point, different in each year. An option with more than YEARS_MAX years is thinned to
 * them. The scene as given has OWN_YEAR_ROCKS in each year. */
#define CEDUO_UNCERTAINTY_YEAR_ROCKS     32
#define CEDUO_UNCERTAINTY_YEARS_MAX      60
#define CEDUO_UNCERTAINTY_OWN_YEAR_ROCKS 1000

struct ceduo_results; /* request.h */

struct ceduo_uncertainty_def {
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
 * scene without control) or the status of ceduo_scene_check(). The caller frees *answer after CEDUO_OK only. */
enum ceduo_status ceduo_uncertainty_compute(const struct ceduo_uncertainty_def *def, struct ceduo_uncertainty_result *answer);
void ceduo_uncertainty_free(struct ceduo_uncertainty_result *answer);

/* Return a figure; NULL if there is no such option or figure. Figures over a rotation require answer->rotation. */
const struct ceduo_uncertainty_figure *ceduo_uncertainty_find_figure(const struct ceduo_uncertainty_result *answer,
                                                                     size_t option, enum ceduo_uncertainty_kind kind,
                                                                     bool difference);

/* Find the inputs that decide a light of the last control: contact, free run, energy (CEDUO_UNCERTAINTY_EXCEED) or its fence. Return the
 * number of dominant inputs, 1 or 2, the largest share first. Return 0 if the light does not change within the 90 % range, or
 * if there are too few points. */
size_t ceduo_uncertainty_dominant_inputs(const struct ceduo_scene *scene, const struct ceduo_uncertainty_result *answer,
                                         size_t option, enum ceduo_uncertainty_kind light, size_t inputs[2]);

#endif
