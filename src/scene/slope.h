/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SLOPE_H
#define CEDUO_SLOPE_H

#include "ceduo/scene.h"

/* True if two segments have the same ground. */
bool ceduo_segment_same(const struct ceduo_segment *a, const struct ceduo_segment *b);

/* Return the segment that contains x, the right-hand one at a vertex. */
size_t ceduo_slope_segment(const struct ceduo_slope *slope, double x);

/* Convert a place of the profile (m, with origin) to the direction of its file, which may be `reversed`, or back. */
double ceduo_slope_mirrored(const struct ceduo_slope *slope, double x);

/* Return the fall of the ground at x: metres down per metre along, < 0 if it rises. */
double ceduo_slope_fall(const struct ceduo_slope *slope, double x);

/* Return the likely place of release: the upper end of the first segment steeper than CEDUO_FACE_FALL; NaN if there is none. */
double ceduo_slope_face(const struct ceduo_slope *slope);

/* Return the topography of the place x beyond `release_x` (m, relative). Rocks start `release_height` above the ground. The
 * foot is the lower end of the last face, the top of the talus; Evans and Hungr 1993 measure the shadow angle from there. */
struct ceduo_topography ceduo_slope_topography(const struct ceduo_slope *slope, double release_x, double release_height,
                                               double x);

/* Return CEDUO_BAD_SLOPE if a member breaks a rule above. */
enum ceduo_status ceduo_slope_check(const struct ceduo_slope *slope);

#endif
