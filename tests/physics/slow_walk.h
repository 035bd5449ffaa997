/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rock's way down a polyline, computed slowly and plainly, in long double: the reference that the fast walk is
 * compared with. It shares no code with it. SI units, angles in radians. */
#ifndef SLOW_WALK_H
#define SLOW_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum slow_law { SLOW_LUMPED, SLOW_CRSP };
enum slow_facets { SLOW_AGAINST, SLOW_BOTH };
enum slow_end { SLOW_REST, SLOW_LEFT, SLOW_UNFINISHED };

/* The first crossing of a control going +x: velocity and spin as the rock comes in, and its clearance above the
 * polyline. */
struct slow_crossing {
    bool reached;
    double vx, vz, spin, height;
};

struct slow_def {
    size_t vertices;                                  /* at least 2 */
    const double *x, *z;                              /* x strictly increasing */
    const double *rn, *rt, *theta_max_rad, *friction; /* vertices - 1 of each */
    enum slow_law law;
    enum slow_facets facets;
    bool scale_rn; /* lumped only: Rn falls with the normal speed */
    double gravity;
    double radius, k;                                   /* k = I / (M R^2), ignored by the lumped law */
    double x0, z0, vx0, vz0, spin0;                     /* the release, on or above the ground */
    double (*uniform)(void *context, uint64_t contact); /* the facet draw of contact number `contact`, from 0 */
    void *context;
    uint64_t max_contacts; /* a rock that would need one more is unfinished */
    size_t controls;
    const double *control_x; /* rising */
    /* Called after each contact law with the outgoing state, before any rolling; may be NULL. */
    void (*on_contact)(void *context, double x, double z, double vx, double vz, double spin);
};

/* Where and how the way ended. At rest the velocity is 0; for a rock that left, the state is that at the end of the
 * profile; for an unfinished one, the state in which it comes into the contact it was not given. */
struct slow_way {
    enum slow_end end;
    double x, z;
    uint64_t contacts;
    double vx, vz, spin;
};

/* `crossings` has room for def->controls and may be NULL where there are none. */
void slow_walk(const struct slow_def *def, struct slow_way *way, struct slow_crossing *crossings);

#endif
