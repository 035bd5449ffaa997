/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RECORD_H
#define CEDUO_RECORD_H

#include "flag.h"
#include "trajectory.h"

/* Statistics of whole trajectories, for comparison with observed rocks. The rocks are those of a run, simulated one by one,
 * which takes several times as long. */

struct ceduo_stretch {
    double from, to; /* m, relative */
};

/* Means along a stretch, over the horizontal metres that a rock covers in it. */
struct ceduo_stretch_means {
    double length;                /* m covered, >= 0; 0: the rock did not enter, and the means are NaN */
    double speed, height, energy; /* m/s; clearance of the underside, m; J */
};

struct ceduo_blow {
    uint64_t rock;
    double x;      /* m, relative */
    double height; /* m: of the rock's centre above the ground */
};

struct ceduo_record_def {
    const struct ceduo_scene *scene;   /* checked */
    const struct ceduo_option *option; /* NULL: without forest */
    uint64_t rocks;
    size_t stretches_count;
    const struct ceduo_stretch *stretches;
    bool blows;               /* record impacts on stems */
    const ceduo_flag *cancel; /* may be NULL */
};

/* Return the default: without forest, the scene's number of rocks, no stretches, no blows. */
struct ceduo_record_def ceduo_record_def_default(const struct ceduo_scene *scene);

struct ceduo_rock_record {
    double mass, moment;
    double stop_x;                        /* m, relative; NaN: did not stop on the slope */
    double largest_speed, largest_height; /* m/s; clearance of the underside, m; maxima from the release on */
};

struct ceduo_record {
    uint64_t rocks_count;
    struct ceduo_rock_record *rocks;
    struct ceduo_crossing *crossings;  /* [rock][control] */
    struct ceduo_stretch_means *means; /* [rock][stretch] */
    size_t blows_count;
    struct ceduo_blow *blows; /* sorted by rock */
};

/* Simulate and record. Return CEDUO_OK, or CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT or a status of
 * ceduo_scene_check() with nothing to release. */
enum ceduo_status ceduo_record(const struct ceduo_record_def *def, struct ceduo_record *record);
void ceduo_record_release(struct ceduo_record *record);

#endif
