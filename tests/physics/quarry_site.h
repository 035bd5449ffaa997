/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef QUARRY_SITE_H
#define QUARRY_SITE_H

#include "ceduo/calibrate.h"

/* A site whose ground is known, because ceduo made what was seen on it: a quarry face, its scree and the level ground below. Its
 * values are drawn in their bounds, some rocks are released and seen to stop and to pass a place, and the values are to be found
 * again. */
#define QUARRY_VALUES_MAX 4
#define QUARRY_KINDS      3 /* stops, speeds and heights at a place */
#define QUARRY_VERTICES   6

extern const char *const quarry_names[QUARRY_VALUES_MAX];

/* It points into itself: never copy it. */
struct quarry_site {
    struct ceduo_scene scene;
    double x[QUARRY_VERTICES], z[QUARRY_VERTICES];
    struct ceduo_segment segments[QUARRY_VERTICES - 1];
    struct ceduo_option option;
    char paths[QUARRY_VALUES_MAX][QUARRY_VERTICES - 1][40];
    const char *places[QUARRY_VALUES_MAX][QUARRY_VERTICES - 1];
    struct ceduo_input inputs[QUARRY_VALUES_MAX];
};

/* How a site is tried. */
struct quarry_trial {
    size_t number;          /* of the site: its truth and its rocks follow from it */
    size_t values, kinds;   /* fitted: the first of quarry_names; seen: stops alone, or with speeds, or with heights as well */
    enum ceduo_law made_by; /* the fit is by lumped */
    uint64_t seen, rocks;   /* rocks released and seen; in each evaluation */
    size_t steps_max;       /* of each chain; 0: as many as is usual */
    unsigned threads;       /* 0: one */
};

/* False where too few rocks pass or stop; then nothing is to be freed. `truth`: the values drawn, of which those that are not
 * fitted are known. */
bool quarry_try(const struct quarry_trial *trial, double truth[QUARRY_VALUES_MAX], struct ceduo_calibration *answer);

/* p of each kind seen, on the true ground without a fit. False as above. */
bool quarry_look(const struct quarry_trial *trial, double p[QUARRY_KINDS]);

#endif
