/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SLOPE_H
#define CEDUO_SLOPE_H

#include <stdbool.h>
#include <stddef.h>

#include "rock.h"

/* Orientation of the ground's facets: always against the rock, or to both sides. */
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
    double roughness_m;     /* a height S >= 0: largest facet angle atan(S/R) (CRSP); NaN if given as an angle */
    double roughness_rad;   /* largest facet angle, 0…<pi/2; NaN if given as a height */
    double friction;        /* tan of the angle of rolling friction, >= 0 */
    double mu;              /* Coulomb friction at the point of contact, >= 0; for the arm law only */
};

/* A polyline with its ground. Coordinates are relative to the first vertex, so that survey coordinates keep all digits.
 * `origin_x`, `origin_z` are the subtracted offsets. */
struct ceduo_slope {
    enum ceduo_facets facets;
    size_t vertices;                /* >= 2; of the simulated profile */
    double *x, *z;                  /* m, x strictly increasing */
    struct ceduo_segment *segments; /* vertices - 1 */
    double tolerance;               /* m, >= 0: points this near to the simplified profile are left out; 0: none */
    double simplified_to;           /* m: tolerance of x, z; 0: not simplified */
    double simplified_at;           /* m: place of the release, kept as a vertex */
    size_t points;                  /* of the original profile; 0: same as x, z */
    double *points_x, *points_z;    /* points of the original profile, relative like x, z */
    size_t segments_given;          /* number in the files; 1: one for all; 0: derived from other input */
    bool reversed;                  /* the file lists it uphill: profile and ground were mirrored when read */
    double origin_x, origin_z;
};

/* Simplify a profile to slope->tolerance (Douglas and Peucker 1973, perpendicular distance). Keeps both ends, the vertices
 * between different grounds, and `release_x`. `to` becomes a copy with its own x, z and segments. Its x is NULL if the profile
 * is already simplified: use `slope` then. Caller frees `to` by ceduo_slope_simplified_free() in either case. Return
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_slope_simplify(const struct ceduo_slope *slope, double release_x, struct ceduo_slope *to);
void ceduo_slope_simplified_free(struct ceduo_slope *slope);

/* True if two segments have the same ground. */
bool ceduo_segment_same(const struct ceduo_segment *a, const struct ceduo_segment *b);

/* Return a segment with the default friction; restitution and roughness are NaN. */
struct ceduo_segment ceduo_segment_default(void);

/* Return the height of the polyline at x (m, relative). x must lie on the slope. */
double ceduo_slope_height(const struct ceduo_slope *slope, double x);

/* Return the segment that contains x, the right-hand one at a vertex. */
size_t ceduo_slope_segment(const struct ceduo_slope *slope, double x);

/* Convert a place of the profile (m, with origin) to the direction of its file, which may be `reversed`, or back. */
double ceduo_slope_mirrored(const struct ceduo_slope *slope, double x);

/* Return the fall of the ground at x: metres down per metre along, < 0 if it rises. */
double ceduo_slope_fall(const struct ceduo_slope *slope, double x);

/* Return the likely place of release: the upper end of the first segment steeper than CEDUO_FACE_FALL; NaN if there is none. */
#define CEDUO_FACE_FALL 1.0 /* metres down per metre along, 45 degrees: steeper than any scree; assumed */
double ceduo_slope_face(const struct ceduo_slope *slope);

/* Position of a place below the release. Angles are inclinations of straight lines, rad, > 0 if the place lies lower. */
struct ceduo_topography {
    double reach;  /* from the release */
    double shadow; /* from the foot of the face; NaN: no face between */
    double foot;   /* m, relative; NaN likewise */
    double bench;  /* m: longest stretch of at most CEDUO_BENCH_INCLINATION between foot (or release) and place; 0: none */
};
#define CEDUO_FACE_LENGTH       5.0   /* m along the ground: minimum length of a face, all steeper than CEDUO_FACE_FALL */
#define CEDUO_BENCH_INCLINATION 0.268 /* metres down per metre along, 15 degrees; rising ground counts as flat */

/* Return the topography of the place x beyond `release_x` (m, relative). Rocks start `release_height` above the ground. The
 * foot is the lower end of the last face, the top of the talus; Evans and Hungr 1993 measure the shadow angle from there. */
struct ceduo_topography ceduo_slope_topography(const struct ceduo_slope *slope, double release_x, double release_height,
                                               double x);

/* Return CEDUO_BAD_SLOPE if a member breaks a rule above. */
enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope);

/* ---- library of grounds ---- */

/* A ground of the library. Restitutions are the means of published ranges. Roughness and friction are assumed, because no
 * source has them for a rock that keeps its motion while it rolls. They follow two bare field sites (ceduo-validation(7)). */
struct ceduo_material {
    const char *name;
    const char *what; /* description, marked for translation */
    double rn, rn_lo, rn_hi;
    double rt, rt_lo, rt_hi;
    double roughness, roughness_lo, roughness_hi; /* m: the height S of CRSP */
    double friction, friction_lo, friction_hi;    /* tan of the angle of friction */
    double mu;                                    /* Coulomb friction, for the arm law; assumed */
    bool literature;                              /* false: assumed */
    const char *source;
};

/* Return the library: `*count` static rows. */
const struct ceduo_material *ceduo_materials(size_t *count);

/* Return the ground that is assumed if none is given. */
const struct ceduo_material *ceduo_material_talus(void);

#endif
