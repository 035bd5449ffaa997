/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rock's trajectory on a polyline as rockfall programs usually compute it: each contact tries every segment ahead and keeps
 * the earliest hit, and angles use libm. It shares no code with the program. In long double it is the reference for the fast
 * walk. The benches, which measure the fast walk's speed against it, define SLOW_REAL as double (tests/bench/plain_walk.h). SI
 * units, angles in radians. */
#ifndef SLOW_WALK_H
#define SLOW_WALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef SLOW_REAL
#define SLOW_REAL long double
#endif
typedef SLOW_REAL slow_real;

enum slow_law { SLOW_LUMPED, SLOW_CRSP };
enum slow_facets { SLOW_AGAINST, SLOW_BOTH };
enum slow_end { SLOW_REST, SLOW_LEFT, SLOW_STOPPED, SLOW_UNFINISHED }; /* stopped: by a stem */

/* A direction in the plane. */
struct slow_turn {
    slow_real cosine, sine;
};

struct slow_segment {
    slow_real x0, z0, x1, z1; /* ends, x0 < x1 */
    slow_real slope, angle;   /* dz/dx and its angle, set by slow_segment_between() */
    struct slow_turn turn;    /* direction of the angle */
    slow_real rn, rt, friction, theta_max;
};

/* A stem in the path. A flying rock hits it if its clearance above the ground is less than `height`, a rolling rock always. */
struct slow_stem {
    double x, height;
    double energy; /* J that a hit takes; the rock stops if it has at most this energy */
};

/* The first crossing of a control in +x: velocity and spin before the contact, and clearance above the polyline. */
struct slow_crossing {
    bool reached;
    double vx, vz, spin, height;
};

struct slow_def {
    size_t count;
    const struct slow_segment *segments;
    enum slow_law law;
    enum slow_facets facets;
    bool scale_rn;                                      /* lumped only: Rn decreases with the normal speed */
    bool friction_bound;                                /* false: the published laws and rolling of CRSP */
    double gravity, radius, k;                          /* k = I / (M R^2), unused by the lumped law */
    double mass;                                        /* kg, used only by stems */
    size_t stems_count;                                 /* from the release on; the rock meets each once, moving along +x */
    const struct slow_stem *stems;                      /* in order of x; may be NULL without stems */
    double x0, z0, vx0, vz0, spin0;                     /* the release, on or above ground */
    double (*uniform)(void *context, uint64_t contact); /* facet draw of contact number `contact`, from 0 */
    void *context;
    uint64_t max_contacts; /* a rock that needs more is unfinished */
    double control;        /* its x; NaN: none */
    /* Called after each contact law with the outgoing state, before any rolling; may be NULL. */
    void (*on_contact)(void *context, double x, double z, double vx, double vz, double spin);
};

/* End of the trajectory. */
struct slow_trajectory {
    enum slow_end end;
    double x, z;
    uint64_t contacts, hits; /* contacts with the ground, hits of stems */
    struct slow_crossing crossing;
};

/* A segment between two points, without its ground. */
struct slow_segment slow_segment_between(double x0, double z0, double x1, double z1);

struct slow_trajectory slow_walk(const struct slow_def *def);

#endif
