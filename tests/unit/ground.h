/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sphere of 1 m on one straight slope, for closed forms: it flies from a height, or rolls. */
#ifndef GROUND_H
#define GROUND_H

#include <math.h>

#include "ceduo/ceduo.h"

/* Contains pointers into itself: never copy it. */
struct ground {
    struct ceduo_scene scene;
    double x[2], z[2];
    struct ceduo_segment segment;
    struct ceduo_option option;
};

/* Make a slope of length `along` that falls by `fall`; the rock leaves `height` above its top with vx, vz. */
static inline void ground_make(struct ground *g, double along, double fall, double height, double vx, double vz)
{
    *g = (struct ground){.scene = ceduo_scene_default(), .x = {0, along}, .z = {0, -fall}};
    g->segment = (struct ceduo_segment){
        .rn = ceduo_number(0), .rt = ceduo_number(1), .roughness_m = NAN, .roughness_rad = 0, .friction = 0.25};
    g->scene.slope = (struct ceduo_slope){.vertices = 2, .x = g->x, .z = g->z, .segments = &g->segment, .segments_given = 1};
    g->scene.simulation.law = CEDUO_LAW_LUMPED;
    g->scene.rock.shape = CEDUO_SHAPE_SPHERE;
    g->scene.rock.diameter = ceduo_number(1);
    g->scene.rock.density = ceduo_number(2600);
    g->scene.release.height = ceduo_number(height);
    g->scene.release.vx = ceduo_number(vx);
    g->scene.release.vz = ceduo_number(vz);
    g->option = (struct ceduo_option){.name = (char *)(uintptr_t) "bare"};
    g->scene.options = &g->option;
    g->scene.options_count = 1;
}

#endif
