/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TRAJECTORY_H
#define CEDUO_TRAJECTORY_H

#include <stdint.h>

#include "scene.h"

/* How a trajectory ends. */
enum ceduo_end { CEDUO_AT_REST, CEDUO_LEFT_SLOPE, CEDUO_UNFINISHED, CEDUO_STOPPED_BY_STEMS, CEDUO_ENDS };

/* More contacts than this, or more stems drawn along its trajectory, and a rock counts as unfinished. */
#define CEDUO_CONTACTS_MAX 1000000
#define CEDUO_STEMS_MAX    1000000

/* A piece of a trajectory, from (x, z) to (x1, z1): in flight the parabola that starts with (vx, vz), in a roll the
 * straight line along the ground, speeds (vx, vz) at its start and (vx1, vz1) at its end. */
struct ceduo_trajectory_segment {
    bool rolls;
    double x, z, vx, vz;
    double x1, z1, vx1, vz1;
    double spin;       /* rad/s over the piece of a flight, at its start in a roll */
    double seconds;    /* of a flight; 0 in a roll */
    uint64_t contacts; /* ground contacts before it */
};

/* A stem that a rock reached. Coordinates relative to the slope's first vertex. */
struct ceduo_stem_encounter {
    double x, y;          /* m: place along the trajectory, offset to the side; y NaN of a lying log */
    double dbh, height;   /* m; dbh NaN of a lying log */
    bool shoot;           /* of a stool; otherwise a single tree */
    uint64_t stool;       /* the same number for the shoots of one stool */
    bool hit;             /* otherwise the rock flew over it */
    double clearance;     /* m: the rock's underside above the ground there */
    double before, taken; /* J: energy of the rock as it came, and what the stem took of it; 0 where it was not hit */
};

/* Who watches a trajectory as it is computed: each may be NULL. */
struct ceduo_trajectory_callbacks {
    bool (*enough)(void *context); /* asked every few milliseconds: true ends it there, CEDUO_CANCELLED */
    void (*piece)(void *context, const struct ceduo_trajectory_segment *piece); /* each piece, in order */
    void (*stem)(void *context, const struct ceduo_stem_encounter *stem); /* each stem, after the piece that leads to it */
    void *context;
};

/* What a rock brings to a place. Coordinates relative to the slope's first vertex. */
struct ceduo_crossing {
    bool reached;
    double vx, vz, spin; /* as it comes in */
    double height;       /* m, clearance of the underside above the ground */
    uint64_t stems_hit;  /* before it */
};

struct ceduo_trajectory {
    struct ceduo_rock rock;
    double x0, z0, vx0, vz0, spin0; /* as released */
    enum ceduo_end end;
    double x, z;       /* where it ended */
    uint64_t contacts; /* with the ground */
    uint64_t stems_hit;
    uint64_t stools_met;  /* stools and single trees of which a stem was hit */
    uint64_t stems_drawn; /* drawn for this trajectory */
};

/* Follows rock number `rock` of a scene through the forest of `option` (NULL: without forest), the same rock that a run
 * simulates. `watch` may be NULL. `crossings` (may be NULL) holds one entry for each control, in their order. The scene must
 * have passed ceduo_scene_check(). CEDUO_NO_MEMORY, CEDUO_CANCELLED (`trajectory` is what is known up to there), otherwise
 * CEDUO_OK. */
enum ceduo_status ceduo_trajectory_follow(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rock,
                                          const struct ceduo_trajectory_callbacks *watch, struct ceduo_trajectory *trajectory,
                                          struct ceduo_crossing *crossings);

/* The same for many rocks, one at a time: what they share of the scene is prepared once. NULL without memory, or where
 * the scene has not passed ceduo_scene_check(). */
struct ceduo_tracer;
struct ceduo_tracer *ceduo_tracer_create(const struct ceduo_scene *scene, const struct ceduo_option *option);
enum ceduo_status ceduo_tracer_run(struct ceduo_tracer *follower, uint64_t rock, const struct ceduo_trajectory_callbacks *watch,
                                   struct ceduo_trajectory *trajectory, struct ceduo_crossing *crossings);
void ceduo_tracer_free(struct ceduo_tracer *follower);

#endif
