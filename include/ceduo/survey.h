/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURVEY_H
#define CEDUO_SURVEY_H

#include "simulate.h"

/* ---- curve of heights ---- */

/* Näslund's curve of height over diameter: h = 1.3 + d2/(a + b d)2, h in m, d in cm. */
struct ceduo_naslund {
    double a, b;
    double rmse; /* m */
};

/* ---- sample plots ---- */

/* Stand from the stems on sample plots. Each plot has its own figures per hectare. The stand has their mean, and the standard
 * error of the mean over the plots. */

#define CEDUO_SURVEY_KINDS(X)                                                                                                  \
    X(SHOOT, "shoot")                                                                                                          \
    X(STANDARD, "standard")                                                                                                    \
    X(TREE, "tree")                                                                                                            \
    X(STUMP, "stump")

enum ceduo_survey_kind {
#define X(NAME, word) CEDUO_SURVEY_##NAME,
    CEDUO_SURVEY_KINDS(X)
#undef X
        CEDUO_SURVEY_KINDS_COUNT
};

#define CEDUO_SURVEY_STOOLS 10000000

struct ceduo_survey_stem {
    size_t plot;
    enum ceduo_survey_kind kind;
    int species;    /* index into ceduo_species_list(); -1: not given */
    size_t stool;   /* for a shoot: index among the stools of all plots */
    double dbh;     /* m, > 0; for a stump its diameter */
    double height;  /* m; NaN: not measured */
    double spacing; /* m; for a shoot: to the next shoots of its stool; NaN: not measured */
    double energy;  /* J; for a stump: energy that it absorbs; NaN: not given */
};

struct ceduo_survey {
    size_t plots_count;  /* >= 1 */
    const double *areas; /* m2, horizontal, > 0 */
    size_t stools_count; /* at most CEDUO_SURVEY_STOOLS */
    size_t stems_count;
    const struct ceduo_survey_stem *stems;
};

/* Stems of one kind and one class of dbh. */
struct ceduo_survey_class {
    enum ceduo_survey_kind kind;
    double from; /* m: lower end, inclusive */
    size_t stems;
    struct ceduo_estimate per_ha;
    double dbh, dbh_sd;      /* m; sd is 0 for one stem */
    double height;           /* m */
    double volume;           /* m3, mean over the stems, each by its species; NaN: stumps */
    size_t form_factor;      /* stems outside the range of the equation of their species, */
    size_t form_factor_main; /* and those of the main species among them */
};

enum ceduo_survey_heights_from {
    CEDUO_SURVEY_HEIGHTS_MEASURED, /* all */
    CEDUO_SURVEY_HEIGHTS_CURVE,    /* missing heights by Näslund's curve */
    CEDUO_SURVEY_HEIGHTS_MEAN,     /* missing heights are the mean of the given ones; assumed */
    CEDUO_SURVEY_HEIGHTS_SHOOTS,   /* none given; all by the curve of the shoots; assumed */
    CEDUO_SURVEY_HEIGHTS_USUAL     /* none given; all by a default curve; assumed */
};

/* Heights of shoots, and of standards and trees together. */
struct ceduo_survey_heights {
    size_t given, missing;
    enum ceduo_survey_heights_from from;
    struct ceduo_naslund curve; /* for CEDUO_SURVEY_HEIGHTS_CURVE, _SHOOTS, _USUAL; the first two also set: */
    size_t beyond;              /* stems without height that are thicker than all with height */
    double thickest;            /* m, largest dbh of the stems whose height is by the curve */
    double mean;                /* m, of the given heights; NaN: none given */
};

struct ceduo_survey_result {
    struct ceduo_estimate per_ha[CEDUO_SURVEY_KINDS_COUNT], stools;
    struct ceduo_estimate spacing; /* m, over the stools with a measurement; mean NaN: no measurement */
    size_t stools_measured;        /* stools with a measurement */
    int species;                   /* with the largest basal area; -1: not given */
    struct ceduo_survey_heights shoots, trees;
    size_t classes_count; /* by kind, then by dbh */
    struct ceduo_survey_class *classes;
    double stump_diameter, stump_height; /* m, mean; NaN: no stumps, or not measured */
    double stump_energy;                 /* J, mean; NaN: not given */
};

/* Compute the stand. Return CEDUO_OK, CEDUO_NO_MEMORY or CEDUO_BAD_ARGUMENT. The caller releases *answer in any case. */
enum ceduo_status ceduo_survey_compute(const struct ceduo_survey *survey, struct ceduo_survey_result *answer);

/* Release a result. A second call has no effect. */
void ceduo_survey_release(struct ceduo_survey_result *answer);

#endif
