/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SLOPE_H
#define CEDUO_SLOPE_H

#include <stdbool.h>
#include <stddef.h>

#include "rock.h"

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
    size_t vertices;                /* >= 2; of the profile that is simulated */
    double *x, *z;                  /* m, x strictly increasing */
    struct ceduo_segment *segments; /* vertices - 1 */
    double tolerance;               /* m, >= 0: distance within which points of the profile are left out; 0: none is */
    double simplified_to;           /* the tolerance that x, z were made with; 0: they are all points, */
    double simplified_at;           /* and the place of the release that was kept, m */
    size_t points;                  /* of the profile before that; 0: x, z are all that is known */
    double *points_x, *points_z;    /* likewise, relative as x, z */
    size_t segments_given;          /* as the files have them: 1 is for all; 0: they follow from something else */
    bool reversed;                  /* its file has it upward: it was mirrored as it was read, with its ground */
    double origin_x, origin_z;
};

/* Simplify a profile to slope->tolerance (Douglas and Peucker 1973, perpendicular distance). Vertices between different grounds,
 * the place `release_x`, and both ends are kept.
 * `to`: a copy whose x, z and segments are its own; x is NULL if the profile is simplified already: use `slope` itself.
 * Free it by ceduo_slope_simplified_free() in either case. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_slope_simplify(const struct ceduo_slope *slope, double release_x, struct ceduo_slope *to);
void ceduo_slope_simplified_free(struct ceduo_slope *slope);

/* True if two segments have the same ground. */
bool ceduo_segment_same(const struct ceduo_segment *a, const struct ceduo_segment *b);

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

/* How a place lies below the release. Angles are inclinations of straight lines, rad, > 0 if the place lies lower. */
struct ceduo_topography {
    double reach;  /* from the release */
    double shadow; /* from the foot of the face; NaN: there is no face between */
    double foot;   /* m, relative; NaN likewise */
    double bench;  /* m: longest stretch of at most CEDUO_BENCH_INCLINATION between foot (or release) and place; 0: none */
};
#define CEDUO_FACE_LENGTH       5.0   /* m of ground: a face is as long at least, and steeper than CEDUO_FACE_FALL throughout */
#define CEDUO_BENCH_INCLINATION 0.268 /* metres down for each along, 15 degrees; ground that rises is flat, too */

/* Topography of the place x beyond `release_x`, where rocks start `release_height` above the ground (m, relative). The foot is the
 * lower end of the last face (Evans and Hungr 1993 measure the shadow angle from there, the top of the talus). */
struct ceduo_topography ceduo_slope_topography(const struct ceduo_slope *slope, double release_x, double release_height,
                                               double x);

/* CEDUO_BAD_SLOPE where it is not as described above. */
enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope);

/* ---- grounds of the library ---- */

/* A ground of the library. Restitutions are the means of published ranges. Roughness and friction are assumed: no source has
 * them for a rock that keeps its motion while it rolls; they follow two bare field sites (ceduo-validation(7)). */
struct ceduo_material {
    const char *name;
    const char *what; /* it is, marked for translation */
    double rn, rn_lo, rn_hi;
    double rt, rt_lo, rt_hi;
    double roughness, roughness_lo, roughness_hi; /* m: the height S of CRSP */
    double friction, friction_lo, friction_hi;    /* tan of the angle of friction */
    double mu;                                    /* Coulomb's, for the law arm; assumed */
    bool literature;                              /* false: an assumption of ours */
    const char *source;
};

/* The library: `*count` rows, static. */
const struct ceduo_material *ceduo_materials(size_t *count);

/* Row of the ground that is assumed if none is given. */
const struct ceduo_material *ceduo_material_talus(void);

#endif
