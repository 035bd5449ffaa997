/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef LINE_SCENE_H
#define LINE_SCENE_H

#include "ceduo/ceduo.h"

/* A small scene in one struct: a sphere on a polyline, one control. It contains pointers into itself: never copy it. */
#define LINE_SEGMENTS_MAX 200
#define LINE_PIECES_MAX   20000

struct line_scene {
    struct ceduo_scene scene;
    double x[LINE_SEGMENTS_MAX + 1], z[LINE_SEGMENTS_MAX + 1];
    struct ceduo_segment segments[LINE_SEGMENTS_MAX];
    struct ceduo_control control;
    struct ceduo_option option;
};

struct line_ground {
    double rn, rt, friction;
};

/* A smooth slope of one ground; the rock at rest on its first vertex, no control, gravity 9.81. */
void line_scene_init(struct line_scene *s, size_t vertices, const double *x, const double *z, struct line_ground ground,
                     double radius, enum ceduo_law law);

/* Set place, height and velocity of the release. */
void line_scene_release(struct line_scene *s, double x, double height, double vx, double vz, double spin);

/* Release over level ground at 3 m/s with gravity 4 m/s2: after 1 s the rock is 3 m on, at the control, falls at 4 m/s and has
 * 5 m/s. */
void line_scene_drop(struct line_scene *s, double radius, double accepted);

/* Allocate a slope with this many vertices; caller frees. */
struct ceduo_slope slope_new(size_t vertices);
void slope_free(struct ceduo_slope *s);
/* Cut `from` along its own lines as evenly as its vertices allow. The new vertices include the old ones, to the bit. */
struct ceduo_slope slope_cut(const struct ceduo_slope *from, size_t vertices);

/* A simple random number generator for tests (splitmix64; Steele, Lea and Flood 2014). */
struct line_random {
    uint64_t state;
};
double line_uniform(struct line_random *r, double lo, double hi);
double line_log_uniform(struct line_random *r, double lo, double hi);
bool line_chance(struct line_random *r, double p);
double line_normal(struct line_random *r); /* mean 0, sd 1: the sum of 12, within 6 */

/* Facet draw of a contact as in the walk: Threefry 2x64 gives two at once. */
double line_facet_draw(uint64_t seed, uint64_t rock, uint64_t contact);

/* Build random scene `number`: 1 to 200 segments; noise of 5 cm to 5 m, long slopes, walls and slivers of 1e-9 m, or level
 * steps; survey coordinates; rocks of 1 cm to 10 m; both laws, with and without the friction bound; facets on either side;
 * friction, Rn and Rt from 0. One in `lasting_every` (0: none) has Rn or Rt 1, so that a rock may never stop. */
void line_scene_random(struct line_scene *s, uint64_t number, unsigned lasting_every);

/* Change the scene to the law arm, usually with a rock that is not round. */
void line_scene_arm(struct line_scene *s, uint64_t number);

/* True if some ground need not take energy from a rock: it may bounce or roll for ever. */
bool line_scene_lasts(const struct line_scene *s);

/* Trajectory segments of rock 0, at most LINE_PIECES_MAX. */
struct line_trace {
    struct ceduo_trajectory trajectory;
    struct ceduo_crossing crossing;
    size_t count;
    struct ceduo_trajectory_segment pieces[LINE_PIECES_MAX];
};
void line_keep_piece(void *trace, const struct ceduo_trajectory_segment *piece);
enum ceduo_status line_scene_follow(const struct line_scene *s, struct line_trace *to);

#endif
