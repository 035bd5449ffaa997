/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TRAJECTORY_H
#define CEDUO_TRAJECTORY_H

#include <stdint.h>

#include "scene.h"

/* End of a trajectory. */
enum ceduo_end { CEDUO_AT_REST, CEDUO_LEFT_SLOPE, CEDUO_UNFINISHED, CEDUO_STOPPED_BY_STEMS, CEDUO_ENDS };

/* A rock with more ground contacts or more drawn stems counts as unfinished. */
#define CEDUO_CONTACTS_MAX 1000000
#define CEDUO_STEMS_MAX    1000000

/* A segment of a trajectory from (x, z) to (x1, z1). In flight it is a parabola that starts with (vx, vz). In a roll it is a
 * straight line along the ground, with speeds (vx, vz) at its start and (vx1, vz1) at its end. */
struct ceduo_trajectory_segment {
    bool rolls;
    double x, z, vx, vz;
    double x1, z1, vx1, vz1;
    double spin;       /* rad/s; constant in flight, at the start in a roll */
    double seconds;    /* of a flight; 0 in a roll */
    uint64_t contacts; /* ground contacts before it */
};

/* A stem that a rock reached. Coordinates relative to the slope's first vertex. */
struct ceduo_stem_encounter {
    double x, y;          /* m: place along the trajectory, lateral offset; y NaN: a log */
    double dbh, height;   /* m; dbh NaN: a log */
    bool shoot;           /* shoot of a stool; false: single tree */
    uint64_t stool;       /* number of the stool, equal for all its shoots */
    bool hit;             /* false: the rock flew over it */
    double clearance;     /* m: clearance of the rock's underside above the ground */
    double before, taken; /* J: energy of the rock before the hit, and energy taken by the stem; 0 if not hit */
};

/* Callbacks for a trajectory; any may be NULL. */
struct ceduo_trajectory_callbacks {
    bool (*is_cancelled)(void *context); /* called every few milliseconds; true cancels: CEDUO_CANCELLED */
    void (*segment)(void *context, const struct ceduo_trajectory_segment *segment); /* each segment, in order */
    void (*stem)(void *context, const struct ceduo_stem_encounter *stem); /* each stem, after the segment that leads to it */
    void *context;
};

/* State of a rock as it passes a control. Coordinates relative to the slope's first vertex. */
struct ceduo_crossing {
    bool reached;
    double vx, vz, spin; /* m/s, rad/s; on arrival */
    double height;       /* m, clearance of the underside above the ground */
    uint64_t stems_hit;  /* before it */
};

struct ceduo_trajectory {
    struct ceduo_rock rock;
    double x0, z0, vx0, vz0, spin0; /* as released */
    enum ceduo_end end;
    double x, z;       /* end point */
    uint64_t contacts; /* with the ground */
    uint64_t stems_hit;
    uint64_t stools_met; /* stools and single trees with a stem hit */
    uint64_t stems_drawn;
};

/* Simulate rock number `rock` of a scene through the forest of `option` (NULL: without forest), as a run does. `callbacks` may
 * be NULL. `crossings` (may be NULL) has one entry per control, in their order. Requires a scene that has passed
 * ceduo_scene_check(). Return CEDUO_NO_MEMORY, CEDUO_CANCELLED (`trajectory` ends early) or CEDUO_OK. */
enum ceduo_status ceduo_trajectory_run(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rock,
                                       const struct ceduo_trajectory_callbacks *callbacks, struct ceduo_trajectory *trajectory,
                                       struct ceduo_crossing *crossings);

/* Simulates many rocks, one at a time, of a scene that is prepared once. NULL without memory, or for a bad scene. */
struct ceduo_tracer;
struct ceduo_tracer *ceduo_tracer_create(const struct ceduo_scene *scene, const struct ceduo_option *option);
enum ceduo_status ceduo_tracer_run(struct ceduo_tracer *tracer, uint64_t rock,
                                   const struct ceduo_trajectory_callbacks *callbacks, struct ceduo_trajectory *trajectory,
                                   struct ceduo_crossing *crossings);
void ceduo_tracer_free(struct ceduo_tracer *tracer);

#endif
