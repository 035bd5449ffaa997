/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOUBT_H
#define CEDUO_DOUBT_H

#include "flag.h"
#include "scene.h"
#include "surface.h"
#include "years.h"

/* Doubt: what is not known of a scene's values, and what that does to its figures. It is not the error of the sample,
 * which more rocks reduce; only measuring reduces it. Every value that is in doubt is an input with a range; many scenes are
 * drawn from the ranges, and each is computed with the same rocks. */

/* One thing that is not known. It may stand at several places of the scene, which then change together. */
struct ceduo_input {
    const char *path; /* of its first place, or what its places have in common */
    enum ceduo_input_kind kind;
    double lo, hi;   /* in the unit of the file */
    double mean, sd; /* CEDUO_INPUT_NORMAL, CEDUO_INPUT_GAMMA: sd at most CEDUO_GAMMA_MOST of the mean */
    size_t words_count;
    const int *words; /* values of the choice */
    size_t places_count;
    size_t draws_count;
    /* CEDUO_INPUT_DRAWS: of each place its values, row by row; the places are sorted by their names */
    const double *const *draws;
    const char *const *places; /* paths, each with its place in brackets: forest[0].stand.trees[0].per_ha */
    const char *source;        /* where its range comes from, marked for translation; NULL: not said */
};

#define CEDUO_GAMMA_MOST 2.0

/* The quantile u (0…1) of an input that is a range, normal or gamma. */
double ceduo_input_quantile(const struct ceduo_input *input, double u);

/* What is asked for at the last control, of the rocks through the forest (without forest where the contact model is
 * index). The share that a place is judged by is EXCEED where an accepted energy is given, otherwise REACH. */
enum ceduo_doubt_kind {
    CEDUO_DOUBT_REACH,
    CEDUO_DOUBT_EXCEED,
    CEDUO_DOUBT_ENERGY,
    CEDUO_DOUBT_MEAN,                        /* the share that the place is judged by, in the mean of a rotation */
    CEDUO_DOUBT_FAILING,                     /* years of a rotation in which it is above CEDUO_EXCEED_MOST */
    CEDUO_DOUBT_SHOWN,                       /* so many are figures of a report; the lights hang on the others: */
    CEDUO_DOUBT_CONTACT = CEDUO_DOUBT_SHOWN, /* 1 over the longest ADC of a belt, 1/m */
    CEDUO_DOUBT_FREE_RUN,                    /* the largest chance of a free run */
    CEDUO_DOUBT_KINDS
};

/* Points of a surface (ceduo/surface.h). As many as are asked for; where they explain less than CEDUO_DOUBT_EXPLAINED of what
 * varies, twice as many, and so on. */
#define CEDUO_DOUBT_POINTS     256
#define CEDUO_DOUBT_POINTS_MAX 1024
#define CEDUO_DOUBT_EXPLAINED  0.9
#define CEDUO_DOUBT_ROCKS      400 /* of each, where they are not said */
#define CEDUO_DOUBT_LEAST      20  /* points; of fewer there is no 90 % range */

/* Two options are equal if their shares differ by at most this, or with blocks by at most a tenth of ceduo_exceed_limit(). Two
 * mean energies per released rock are equal if they differ by at most this share of the energy without forest. */
#define CEDUO_DOUBT_EQUAL 0.005

/* Over a rotation each point has so many rocks in each of its years, others in each year; of an option with more years these many
 * are taken. In the scene as it is each year has more. */
#define CEDUO_DOUBT_YEAR_ROCKS     32
#define CEDUO_DOUBT_YEARS_MAX      60
#define CEDUO_DOUBT_OWN_YEAR_ROCKS 1000

struct ceduo_answer; /* question.h */

struct ceduo_doubt_def {
    const struct ceduo_scene *scene;
    size_t inputs_count; /* >= 1 */
    const struct ceduo_input *inputs;
    size_t points;      /* 2…CEDUO_DOUBT_POINTS_MAX */
    size_t points_max;  /* no more are taken where these explain too little; 0: CEDUO_DOUBT_POINTS_MAX */
    uint64_t rocks;     /* of each evaluation; CEDUO_SURFACE_GROUPS at least are taken */
    uint64_t own_rocks; /* of the scene as it is; 0: as many */
    /* The scene as it is, computed before; with the years of each option if `rotation` is true. Requires `brief`. NULL: computed
     * here, from own_rocks. */
    const struct ceduo_answer *own;
    size_t years_max; /* years of each option at a point, at most CEDUO_DOUBT_YEARS_MAX; 0: as many */
    /* Neither differences between options nor values at the ends of the inputs; of each option only the figures that pages
     * show. The others have fit.p5 and fit.p95 NaN. */
    bool brief;
    bool rotation;              /* each option over its rotation as well; not with the contact model index */
    bool alone;                 /* of one option alone: the surfaces of the others are not there (p5, p95 NaN), nor ranks */
    size_t option;              /* alone: this one */
    struct ceduo_window window; /* these years instead; step 0: those of ceduo_window_in() */
    uint64_t effort_max; /* contacts, stems and twice the stems hit, of all points: beyond, CEDUO_CANCELLED; 0: unlimited */
    unsigned threads;    /* at most CEDUO_THREADS_MOST; 0: one */
    const ceduo_flag *cancel;                                     /* may be NULL */
    void (*progress)(void *context, uint64_t done, uint64_t all); /* may be NULL; by one thread at a time */
    void *context;
};

/* All inputs of `scene` are the caller's to set: inputs_count and inputs. CEDUO_DOUBT_POINTS of CEDUO_DOUBT_ROCKS, one thread. */
struct ceduo_doubt_def ceduo_doubt_def_default(const struct ceduo_scene *scene);

/* A range from 0 to 1 without places. */
struct ceduo_input ceduo_input_default(void);

/* A figure of an option, or its difference to that of the first option. Shares are 0…1, energies J per released rock. */
struct ceduo_doubt_figure {
    size_t option;
    enum ceduo_doubt_kind kind;
    bool difference;
    double value, sampling_lo, sampling_hi; /* of the scene as it is, with the error of the rocks; NaN: not known */
    struct ceduo_surface_fit fit; /* over what may be true; `below`: of the share that the place is judged by, how much
                                             * of that keeps within CEDUO_EXCEED_MOST. p5 and p95 are widened until they hold
                                             * `value`; NaN if there are fewer than CEDUO_DOUBT_LEAST points */
    double (*at)[2];              /* of each input: with it at its lower, at its upper end, all others as they are;
                                             * over a rotation NaN */
    size_t uses;                  /* inputs that the figure's options have */
    size_t *order;                /* these by what is left of p95 - p5 if they are known, least first */
};

/* Of two options: the share of plausible cases in which the first is better, in which it is worse, and in which they are equal
 * (CEDUO_DOUBT_EQUAL). The three add up to 1. */
struct ceduo_doubt_order {
    size_t better, than; /* options */
    double probability, equal, worse;
    double p5, p95; /* doubt of the figure that ranks them, the one less the other; as those of a figure */
};

struct ceduo_doubt_answer {
    size_t points;
    uint64_t rocks; /* of each point */
    uint64_t own_rocks;
    bool rotation; /* figures over a rotation are there */
    size_t figures_count;
    struct ceduo_doubt_figure *figures; /* by option and kind, then the differences; see ceduo_doubt_figure_of() */
    enum ceduo_doubt_kind main;         /* too much energy where that is known, otherwise energy */
    size_t orders_count;                /* one less than options; 0: one option alone, or not known */
    struct ceduo_doubt_order
        *orders;          /* each option and the next one in rank by the scene as it is: by the mean over the rotation if
                                       * that is there, otherwise by today's main figure */
    uint64_t evaluations; /* scenes computed; each is of all options, and of their years */
};

/* Computes all. Bits do not depend on the number of threads. CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT (a number of the
 * def outside its range, an input without words or draws, a scene without control) or what ceduo_scene_check() says: then nothing
 * is to be freed. */
enum ceduo_status ceduo_doubt_ask(const struct ceduo_doubt_def *def, struct ceduo_doubt_answer *answer);
void ceduo_doubt_free(struct ceduo_doubt_answer *answer);

/* The figures over a rotation are there if answer->rotation is true. NULL: there is no such option or figure. */
const struct ceduo_doubt_figure *ceduo_doubt_figure_of(const struct ceduo_doubt_answer *answer, size_t option,
                                                       enum ceduo_doubt_kind kind, bool difference);

/* Whether a light of the last control changes within the 90 % band of doubt: contact, free run, or energy
 * (CEDUO_DOUBT_EXCEED). Returns how many inputs it depends on above all, 1 or 2, the heaviest first; 0: it does not change, or
 * there are too few points to say by what. */
size_t ceduo_doubt_depends(const struct ceduo_scene *scene, const struct ceduo_doubt_answer *answer, size_t option,
                           enum ceduo_doubt_kind light, size_t inputs[2]);

#endif
