/* SPDX-License-Identifier: GPL-3.0-or-later */

#include "ceduo/calibrate.h"
#ifndef QUARRY_SITE_H
#define QUARRY_SITE_H

/* A site with known ground, because ceduo makes its observations: a quarry face, its scree and the level ground below. Its
 * values are drawn within their bounds. Some rocks are released; their stops and passages are observed, and the values fitted
 * to them. */
#define QUARRY_VALUES_MAX 4
#define QUARRY_KINDS      3 /* stops; speeds and heights at a place */
#define QUARRY_VERTICES   6

extern const char *const quarry_names[QUARRY_VALUES_MAX];

/* Contains pointers into itself: never copy it. */
struct quarry_site {
    struct ceduo_scene scene;
    double x[QUARRY_VERTICES], z[QUARRY_VERTICES];
    struct ceduo_segment segments[QUARRY_VERTICES - 1];
    struct ceduo_option option;
    char paths[QUARRY_VALUES_MAX][QUARRY_VERTICES - 1][40];
    const char *places[QUARRY_VALUES_MAX][QUARRY_VERTICES - 1];
    struct ceduo_input inputs[QUARRY_VALUES_MAX];
};

/* Settings of one trial of a site. */
struct quarry_trial {
    size_t number;            /* seed of the site's truth and rocks */
    size_t values, kinds;     /* fitted: the first of quarry_names; observed: stops alone, with speeds, or also with heights */
    enum ceduo_law made_by;   /* law of the observations; the fit uses lumped */
    uint64_t observed, rocks; /* rocks released and observed; rocks per evaluation */
    size_t steps_max;         /* per chain; 0: default */
    unsigned threads;         /* 0: one */
};

/* Return false if too few rocks pass or stop; then there is nothing to free. `truth`: all drawn values; those not fitted are
 * fixed. */
bool quarry_fit(const struct quarry_trial *trial, double truth[QUARRY_VALUES_MAX], struct ceduo_calibration *answer);

/* Compute p of each kind on the true ground without a fit. Returns false as above. */
bool quarry_compare(const struct quarry_trial *trial, double p[QUARRY_KINDS]);

#endif
