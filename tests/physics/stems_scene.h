/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Level ground, forests on it, and the stems that rocks meet there. */
#ifndef STEMS_SCENE_H
#define STEMS_SCENE_H

#include <stdbool.h>

#include "ceduo/simulate.h"
#include "line_scene.h"
#include "paper_site.h"
#include "plane_map.h"
#include "runs.h"
#include "sample.h"

#define B PAPER_B /* m, mean diameter of the rock in all sweeps */

/* ---- a plane to sweep ---- */

/* Level ground, and a rock so fast and low, among stems so tall and light, that its trajectory is a straight line. Contains
 * pointers into itself: never copy it. */
#define KINDS_MAX 3
struct plane {
    struct line_scene line;
    struct ceduo_belt belts[2];
    struct ceduo_stems shoots[2][KINDS_MAX], trees[2][KINDS_MAX];
};

extern struct plane plane;

void clear_ground(size_t vertices, const double *x, const double *z, double rn, double friction);
/* Clear the forest. The rock starts at x = 0 and falls 5 cm over the length. */
void clear_plane(double length);
struct ceduo_belt *plant_belt(double from, double to, double stools, double spacing);
struct ceduo_stems *plant_shoots(struct ceduo_belt *belt, double per_ha, double dbh);
struct ceduo_stems *plant_trees(struct ceduo_belt *belt, double per_ha, double dbh);
/* Plant a plot of the paper's Table 1, with tall and light stems. */
void plant_plot(int number, double from, double to);

/* Return how many of per_ha objects on a hectare a strip of this width meets, per metre. */
double per_metre(double per_ha, double width);

/* ---- sweep ---- */

#define STEMS_MAX 4096
struct sweep {
    struct ceduo_tracer *follower;
    struct ceduo_trajectory trajectory;
    size_t count;
    struct ceduo_stem_encounter stems[STEMS_MAX];
};

extern struct sweep sweep;

void note_stem(void *context, const struct ceduo_stem_encounter *stem);
void sweep_begin(void);
void sweep_end(void);
void sweep_watched(uint64_t rock, const struct ceduo_trajectory_callbacks *watch);
void sweep_rock(uint64_t rock);
void sweep_one(uint64_t rock);
/* for (SWEEP(rock, 5000)): sweep rocks 0 to 4999; do not leave the loop early. */
#define SWEEP(rock, rocks)                                                                                                     \
    uint64_t rock = (sweep_begin(), 0);                                                                                        \
    sweep_next(rock, rocks);                                                                                                   \
    rock++
bool sweep_next(uint64_t rock, uint64_t rocks);

/* Count different numbers among the hit stems, all or only shoots. */
size_t count_different(bool shoots_only);

/* Stems and stools that rocks met in the planted forest, per metre. */
struct met {
    struct spread stems, both, stools; /* stools and trees; stools alone */
    struct spread sum;                 /* stems and stools, for their covariance */
};

/* Mean of printed_share() by Simpson's rule. */
double mean_printed_share(void);

struct met meet(uint64_t rocks, double metres);

#endif
