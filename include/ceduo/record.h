/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RECORD_H
#define CEDUO_RECORD_H

#include "flag.h"
#include "trajectory.h"

/* What rocks do on their way, beside what they bring to controls: for what was seen of real rocks. The rocks are those of a
 * run, followed one by one: it takes several times as long. */

struct ceduo_stretch {
    double from, to; /* m, relative */
};

/* Means along a stretch, over the horizontal metres that a rock covers of it. */
struct ceduo_stretch_means {
    double length;                /* those metres; 0: it did not enter it, and the others are NaN */
    double speed, height, energy; /* m/s; clearance of the underside, m; J */
};

struct ceduo_stem_impact {
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
    bool blows;               /* on stems */
    const ceduo_flag *cancel; /* may be NULL */
};

/* Without forest, as many rocks as the scene says, no stretches, no blows. */
struct ceduo_record_def ceduo_record_def_default(const struct ceduo_scene *scene);

struct ceduo_rock_record {
    double mass, moment;
    double stop_x;                        /* NaN: it did not stop on the slope */
    double largest_speed, largest_height; /* m/s; clearance of the underside, m; from its release on */
};

struct ceduo_record {
    uint64_t rocks_count;
    struct ceduo_rock_record *rocks;
    struct ceduo_crossing *crossings;  /* [rock][control] */
    struct ceduo_stretch_means *means; /* [rock][stretch] */
    size_t blows_count;
    struct ceduo_stem_impact *blows; /* in the order of the rocks */
};

/* CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT or what ceduo_scene_check() says, with nothing to release, or CEDUO_OK. */
enum ceduo_status ceduo_record(const struct ceduo_record_def *def, struct ceduo_record *record);
void ceduo_record_release(struct ceduo_record *record);

#endif
