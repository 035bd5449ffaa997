/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Level ground to sweep, forests to plant on it, and what rocks meet there. */
#ifndef STEMS_SCENE_H
#define STEMS_SCENE_H

#include <stdbool.h>

#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"
#include "sample.h"

#define B PAPER_B /* m, mean diameter of the rock of all sweeps */

/* ---- a plane to sweep ---- */

/* Level ground over which a rock flies so fast and low, among stems so tall and light, that its way is a straight line.
 * It points into itself. */
#define KINDS_MAX 3
struct plane {
    struct line_scene line;
    struct ceduo_belt belts[2];
    struct ceduo_stems shoots[2][KINDS_MAX], trees[2][KINDS_MAX];
};

extern struct plane plane;

void clear_ground(size_t vertices, const double *x, const double *z, double rn, double friction);
/* Without a forest yet. The rock starts at x = 0 and falls 5 cm on its way. */
void clear_plane(double length);
struct ceduo_belt *plant_belt(double from, double to, double stools, double spacing);
struct ceduo_stems *plant_shoots(struct ceduo_belt *belt, double per_ha, double dbh);
struct ceduo_stems *plant_trees(struct ceduo_belt *belt, double per_ha, double dbh);
/* A plot of the paper's Table 1, its stems tall and light. */
void plant_plot(int number, double from, double to);

/* Things of which so many stand on a hectare, met by a strip of such a width: per metre. */
double per_metre(double per_ha, double width);

/* ---- sweeping it ---- */

#define STEMS_MAX 4096
struct sweep {
    struct ceduo_tracer *follower;
    struct ceduo_trajectory way;
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
/* for (SWEEP(rock, 5000)): rocks 0 to 4999, each of which has been swept; not to be left early. */
#define SWEEP(rock, rocks)                                                                                                     \
    uint64_t rock = (sweep_begin(), 0);                                                                                        \
    sweep_next(rock, rocks);                                                                                                   \
    rock++
bool sweep_next(uint64_t rock, uint64_t rocks);

/* Different numbers among the stems that were hit, all or of shoots only. */
size_t different(bool shoots_only);

/* What rocks meet of the forest that was planted, per metre of it. */
struct met {
    struct spread stems, both, stools; /* stools and trees; stools alone */
    struct spread sum;                 /* stems and stools, for their covariance */
};

/* The share of the largest energy by eccentricity as Dorren et al. 2006 print it, cut to 0…1, and its mean by Simpson's rule. */
double printed_share(double u);
double mean_printed_share(void);

struct met meet(uint64_t rocks, double metres);

#endif
