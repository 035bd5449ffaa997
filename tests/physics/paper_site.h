/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PAPER_SITE_H
#define PAPER_SITE_H

#include "ceduo/ceduo.h"

/* The test site of Ciabocco, Boccia and Ripa 2009: Table 2 (rock, release), Table 3 (slope), Table 1 (plots ADS 1 and ADS 2,
 * 67.5 m each), one control at x = 135 m with a measured 15.6 m/s. */
#define PAPER_VERTICES 14
#define PAPER_SEGMENTS (PAPER_VERTICES - 1)
#define PAPER_TOP      126.0 /* y of the first vertex */
#define PAPER_U        102800.0
#define PAPER_B        0.68

enum paper_theta { PAPER_ANGLE, PAPER_HEIGHT }; /* reading of Table 3's column theta: radians, or metres over R */

/* Stems of one plot: the shoots of the stools and the single trees, all with the plot's means. */
struct paper_plot {
    struct ceduo_stand stand;
    struct ceduo_stems shoots, trees;
};

struct paper_site {
    struct ceduo_scene scene;
    double x[PAPER_VERTICES], z[PAPER_VERTICES];
    struct ceduo_segment segments[PAPER_SEGMENTS];
    struct ceduo_control control;
    struct ceduo_option option;
    struct ceduo_belt belts[2];
    struct paper_plot plots[2];
};

/* x, y and theta of Table 3. */
extern const double paper_x[PAPER_VERTICES], paper_y[PAPER_VERTICES];
double paper_theta(size_t segment);

/* Plot ADS `number` (1 or 2) of Table 1. `plot` contains pointers into itself: never copy it. */
void paper_plot_init(struct paper_plot *plot, int number);

/* The whole site: lumped without the friction bound, theta in radians, facets against the rock, friction 0.5. Never copy it. */
void paper_site_init(struct paper_site *site);

/* Growth of hop hornbeam and of its standards; D, k, H and m are assumed. */
extern const struct ceduo_growth paper_growth;

/* A simple coppice of hop hornbeam with this growth and a cut: 2500 stools, volumes by the species' equation; two classes
 * remain. */
struct ceduo_stems paper_stems(double per_ha, double dbh, double height);
struct ceduo_stand paper_coppice(struct ceduo_stems *shoots, struct ceduo_stems *trees, size_t trees_count, unsigned rotation,
                                 double *stay);

/* Apply another reading of theta, or 0 everywhere. */
void paper_site_read_theta(struct paper_site *site, enum paper_theta theta);
void paper_site_smooth(struct paper_site *site);

/* Replace the rock by a sphere of the same mean diameter. */
void paper_site_sphere(struct paper_site *site);

#endif
