/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene for the slow walk, without spreads. */
#ifndef SLOW_SCENE_H
#define SLOW_SCENE_H

#include <math.h>

#include "ceduo/simulate.h"
#include "scene/slope.h"
#include "slow_walk.h"

/* Fill one segment for each stretch between two vertices. A roughness in m is an angle for a rock of this radius. */
static inline void slow_segments(const struct ceduo_slope *slope, double radius, struct slow_segment *to)
{
    for (size_t j = 0; j + 1 < slope->vertices; j++) {
        const struct ceduo_segment *s = &slope->segments[j];
        to[j] = slow_segment_between(slope->x[j], slope->z[j], slope->x[j + 1], slope->z[j + 1]);
        to[j].rn = s->rn.mean;
        to[j].rt = s->rt.mean;
        to[j].friction = s->friction;
        to[j].theta_max = isnan(s->roughness_rad) ? atan(s->roughness_m / radius) : s->roughness_rad;
    }
}

/* Return the rock of mean sizes on its slope, to the first control. The caller sets `uniform`, `context` and the stems. */
static inline struct slow_def slow_scene(const struct ceduo_scene *scene, struct slow_segment *segments)
{
    const struct ceduo_slope *slope = &scene->slope;
    const struct ceduo_release *r = &scene->release;
    const struct ceduo_rock rock = ceduo_rock_mean(&scene->rock);
    slow_segments(slope, rock.radius, segments);
    return (struct slow_def){.count = slope->vertices - 1,
                             .segments = segments,
                             .law = scene->simulation.law == CEDUO_LAW_CRSP ? SLOW_CRSP : SLOW_LUMPED,
                             .facets = slope->facets == CEDUO_FACETS_BOTH ? SLOW_BOTH : SLOW_AGAINST,
                             .scale_rn = scene->simulation.scale_rn,
                             .friction_bound = scene->simulation.friction_bound,
                             .gravity = scene->simulation.gravity,
                             .radius = rock.radius,
                             .k = rock.k,
                             .mass = rock.mass,
                             .x0 = r->x.mean,
                             .z0 = ceduo_slope_height(slope, r->x.mean) + r->height.mean,
                             .vx0 = r->vx.mean,
                             .vz0 = r->vz.mean,
                             .spin0 = r->spin.mean,
                             .max_contacts = CEDUO_CONTACTS_MAX,
                             .control = scene->controls_count > 0 ? scene->controls[0].x : NAN};
}

/* Return the kinetic energy (J) at a crossing. */
static inline double slow_energy(const struct slow_def *def, const struct slow_crossing *c)
{
    double rim = c->spin * def->radius;
    return def->mass / 2 * (c->vx * c->vx + c->vz * c->vz + def->k * rim * rim);
}

#endif
