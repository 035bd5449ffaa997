/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURVEY_H
#define CEDUO_SURVEY_H

#include <stdbool.h>
#include <stddef.h>

#include "naslund.h"
#include "stand.h"
#include "statistics.h"
#include "status.h"

/* From the stems on sample plots to a stand. Each plot gives its own figures per hectare; a stand has their mean, and the
 * standard error of that mean over the plots. */

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
    int species;    /* index into ceduo_species_list(); -1: not said */
    size_t stool;   /* of a shoot: which one of all plots */
    double dbh;     /* m, > 0; of a stump: its diameter */
    double height;  /* m; NaN: not measured */
    double spacing; /* m, of a shoot: between neighbouring shoots of its stool; NaN: not measured */
    double energy;  /* J, of a stump: what it takes from a rock; NaN: not said */
};

struct ceduo_survey {
    size_t plots_count;  /* >= 1 */
    const double *areas; /* m2, horizontal, > 0 */
    size_t stools_count; /* at most CEDUO_SURVEY_STOOLS */
    size_t stems_count;
    const struct ceduo_survey_stem *stems;
};

/* A plot of `area` m2 laid along a slope covers this on the map. */
double ceduo_survey_horizontal(double area, double slope_rad);

#define CEDUO_SURVEY_ALL (-2)

/* The basal area per hectare of a species (-1: not said), or of CEDUO_SURVEY_ALL, stumps left out, summed over the plots: for shares
 * of it. In m2 of the squares of the diameters, per m2. */
double ceduo_survey_basal_area(const struct ceduo_survey *survey, int species);

#define CEDUO_SURVEY_CLASS   0.05 /* m of dbh: the width of a class */
#define CEDUO_SURVEY_SPACING 0.35 /* m between the shoots of a stool where nobody measured it: assumed, as in the presets */

/* Stems of one kind and one class of dbh. */
struct ceduo_survey_class {
    enum ceduo_survey_kind kind;
    double from; /* m: its lower end, which is in it */
    size_t stems;
    struct ceduo_estimate per_ha;
    double dbh, dbh_sd;      /* m; sd: 0 with one stem */
    double height;           /* m */
    double volume;           /* m3, mean of each stem's by its own species; NaN: of stumps */
    size_t form_factor;      /* stems whose volume is outside of the equation of their species, */
    size_t form_factor_main; /* of these of the main species */
};

enum ceduo_survey_heights_from {
    CEDUO_HEIGHTS_MEASURED, /* all of them */
    CEDUO_HEIGHTS_CURVE,    /* those that are missing lie on Näslund's curve */
    CEDUO_HEIGHTS_MEAN,     /* those that are missing are the mean of those given: assumed */
    CEDUO_HEIGHTS_SHOOTS,   /* none is given, and all lie on the curve of the shoots: assumed */
    CEDUO_HEIGHTS_USUAL     /* none is given, and all are as usual: assumed */
};

/* Heights of shoots, and of standards and trees together. */
struct ceduo_survey_heights {
    size_t given, missing;
    enum ceduo_survey_heights_from from;
    struct ceduo_naslund curve; /* CEDUO_HEIGHTS_CURVE, _SHOOTS, _USUAL; of the first two also: */
    size_t beyond;              /* of those that are missing: stems thicker than any that was measured */
    double thickest;            /* m, the largest dbh of those on the curve, which is of the tallest, too */
    double mean;                /* m, of those given; NaN: none is */
};

/* Heights are not known better than that where none was measured: so much less or more, assumed. */
#define CEDUO_SURVEY_HEIGHT_UNCERTAINTY 0.3

struct ceduo_survey_result {
    struct ceduo_estimate per_ha[CEDUO_SURVEY_KINDS_COUNT], stools;
    struct ceduo_estimate spacing; /* m, over the stools where it was measured; its mean is NaN where it was not */
    size_t stools_measured;        /* those stools */
    int species;                   /* that has most basal area; -1: none is said */
    struct ceduo_survey_heights shoots, trees;
    size_t classes_count; /* by kind, then by dbh */
    struct ceduo_survey_class *classes;
    double stump_diameter, stump_height; /* m, the mean; NaN: there are none, not measured */
    double stump_energy;                 /* J, the mean; NaN: not said */
};

/* CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK; release it in the latter case. */
enum ceduo_status ceduo_survey_compute(const struct ceduo_survey *survey, struct ceduo_survey_result *answer);
void ceduo_survey_free(struct ceduo_survey_result *answer);

#endif
