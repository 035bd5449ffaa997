/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rocks down a polyline as a rockfall program is usually written: for each rock, at each contact, every segment is tried
 * by both roots of its quadratic and the earliest kept; angles go through libm; random numbers come one after another
 * from one generator. The same model as the core's, to measure the core's speed against; it shares no code with it.
 * Simplified: a rock that stands still in a pit steeper than its friction is not looked for, so the ground must have no
 * such pit; only facets turned against the rock; no spreads. SI units, angles in radians. */
#ifndef PLAIN_LOOP_H
#define PLAIN_LOOP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum plain_law { PLAIN_LUMPED, PLAIN_CRSP };

struct plain_segment {
    double x0, z0, x1, z1; /* its ends, x0 < x1 */
    double slope, angle;   /* dz/dx and its angle; these are set by plain_segment_between() */
    double cosine, sine;   /* of the angle */
    double rn, rt, friction;
    double roughness; /* the largest facet angle; a height over the radius where the def says so */
};

/* Where a rock starts. */
struct plain_start {
    double x, z, vx, vz;
};

/* Random numbers from elsewhere, and what passes the control to be kept. */
struct plain_source {
    void *context;
    void (*begin)(void *context, uint64_t rock, struct plain_start *start); /* a rock begins; may move its start */
    double (*draw)(void *context, uint64_t contact);                        /* in [0, 1), for a contact of this rock */
    void (*passes)(void *context, double energy);
};

struct plain_def {
    size_t count;
    const struct plain_segment *segments;
    enum plain_law law;
    bool roughness_is_height;
    double gravity, mass, radius, k; /* k = I/(MR2); lumped: not used */
    double x, z, vx, vz;             /* the release, above the ground or on it, without spin */
    double control;                  /* x at which speed and energy are noted, first passage going +x */
    uint64_t seed;
    const struct plain_source *source; /* NULL: numbers of its own, all rocks start alike */
};

/* Added to by plain_loop(), so that runs of several seeds can be summed. */
struct plain_sums {
    uint64_t rocks, passed, contacts;
    double contacts2;       /* squares of the contacts of each rock */
    double speed, speed2;   /* of those that passed: sums, and sums of squares */
    double energy, energy2; /* with rotation */
};

/* A segment between two points, without its ground. */
struct plain_segment plain_segment_between(double x0, double z0, double x1, double z1);

/* Flies `rocks` rocks one after another. */
void plain_loop(const struct plain_def *def, uint64_t rocks, struct plain_sums *sums);

#endif
