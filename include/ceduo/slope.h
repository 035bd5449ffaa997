/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SLOPE_H
#define CEDUO_SLOPE_H

#include <stdbool.h>
#include <stddef.h>

#include "number.h"
#include "status.h"

/* Which way the ground's small facets are turned: always against the rock, or to both sides. */
#define CEDUO_FACETS(X)                                                                                                        \
    X(AGAINST, "against")                                                                                                      \
    X(BOTH, "both")

enum ceduo_facets {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_FACETS(X)
#undef X
};

/* The ground of one segment. */
struct ceduo_segment {
    struct ceduo_number rn; /* normal restitution, 0…1 */
    struct ceduo_number rt; /* tangential restitution, 0…1 */
    double roughness_m;     /* a height S >= 0: largest facet angle atan(S/R) (CRSP); NaN where given as an angle */
    double roughness_rad;   /* the largest facet angle itself, 0…<pi/2; NaN where given as a height */
    double friction;        /* tan of the angle of rolling friction, >= 0 */
    double mu;              /* Coulomb's friction at the point of contact, >= 0; the law arm's alone */
};

/* A polyline with its ground. Coordinates are relative to the first vertex, so that survey coordinates lose no digit;
 * `origin_x`, `origin_z` are what was taken off. */
struct ceduo_slope {
    enum ceduo_facets facets;
    size_t vertices;                /* >= 2 */
    double *x, *z;                  /* m, x strictly increasing */
    struct ceduo_segment *segments; /* vertices - 1 */
    size_t segments_given;          /* as the files have them: 1 is for all; 0: they follow from something else */
    bool reversed;                  /* its file has it upward: it was mirrored as it was read, with its ground */
    double origin_x, origin_z;
};

/* Friction by default; restitution and roughness are not known. */
struct ceduo_segment ceduo_segment_default(void);

/* Height of the polyline at x (m, relative), which must lie on the slope; at a vertex, the vertex. */
double ceduo_slope_height(const struct ceduo_slope *slope, double x);

/* The segment that x lies on, the right-hand one at a vertex. */
size_t ceduo_slope_segment(const struct ceduo_slope *slope, double x);

/* A place of the profile (m, with its origin) as its file has it, which may be `reversed`; and back. */
double ceduo_slope_mirrored(const struct ceduo_slope *slope, double x);

/* How the ground falls at x: metres down for each along, below 0 where it rises. */
double ceduo_slope_fall(const struct ceduo_slope *slope, double x);

/* Where rocks are likely to start: the upper end of the first segment that falls by more than CEDUO_FACE_FALL. NaN: there is none. */
#define CEDUO_FACE_FALL 1.0 /* metres down for each along, 45 degrees: more than any scree; assumed */
double ceduo_slope_face(const struct ceduo_slope *slope);

/* CEDUO_BAD_SLOPE where it is not as described above. */
enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope);

#endif
